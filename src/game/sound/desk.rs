//! Where the game leaves what is to be heard, and the output's thread finds it. Neither ever waits for the other.

use crate::sound::{Controls, Synthesiser};
use bevy::platform::time::Instant;
use std::{
    sync::{
        Arc,
        atomic::{AtomicU32, AtomicU64, Ordering::Relaxed},
    },
    time::Duration,
};

/// Time after which what the game left is no longer played, s: it hangs, or no longer draws frames.
const STALE: f32 = 0.25;

/// The latest controls, and what it cost to play them.
#[derive(Debug)]
pub struct Desk {
    controls: [AtomicU32; Controls::ALL.len()],
    /// Frames that were played since the game was here.
    age: AtomicU32,
    frames: AtomicU64,
    nanoseconds: AtomicU64,
}

impl Default for Desk {
    fn default() -> Self {
        let silent = Controls::SILENT.to_array().map(|value| AtomicU32::new(value.to_bits()));
        Self { controls: silent, age: AtomicU32::new(0), frames: AtomicU64::new(0), nanoseconds: AtomicU64::new(0) }
    }
}

impl Desk {
    /// Leaves what is heard. A player that reads meanwhile may get some of the old controls, for one block.
    pub fn put(&self, controls: &Controls) {
        for (place, value) in self.controls.iter().zip(controls.to_array()) {
            place.store(value.to_bits(), Relaxed);
        }
        self.age.store(0, Relaxed);
    }

    fn take(&self, frames: usize, rate: u32) -> Controls {
        let age = self.age.fetch_add(frames as u32, Relaxed);
        let mut values = Controls::SILENT.to_array();
        for (value, place) in values.iter_mut().zip(&self.controls) {
            *value = f32::from_bits(place.load(Relaxed));
        }
        let controls = Controls::from_array(values);
        let is_stale = age as f32 > STALE * rate as f32;
        if is_stale { Controls { gain: 0.0, ..controls } } else { controls }
    }

    /// Frames that were played, and the time that took.
    pub fn played(&self) -> (u64, Duration) {
        (self.frames.load(Relaxed), Duration::from_nanos(self.nanoseconds.load(Relaxed)))
    }
}

/// Plays what lies on a desk.
#[derive(Debug)]
pub struct Player {
    desk: Arc<Desk>,
    synthesiser: Synthesiser,
    rate: u32,
}

impl Player {
    /// One that makes `rate` frames a second.
    pub fn new(desk: Arc<Desk>, rate: u32) -> Self {
        Self { desk, synthesiser: Synthesiser::new(rate), rate }
    }

    /// The next frames: left, right, left, right. `out` has an even length.
    pub fn play(&mut self, out: &mut [f32]) {
        let begun = Instant::now();
        let controls = self.desk.take(out.len() / 2, self.rate);
        self.synthesiser.render(&controls, out);
        self.desk.frames.fetch_add(out.len() as u64 / 2, Relaxed);
        self.desk.nanoseconds.fetch_add(begun.elapsed().as_nanos() as u64, Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_left_is_played_until_it_is_stale() {
        let desk = Arc::new(Desk::default());
        let mut player = Player::new(desk.clone(), 48_000);
        let wind = Controls { wind_level: 0.2, ..Controls::SILENT };
        let mut play = |left: Option<&Controls>| {
            left.into_iter().for_each(|controls| desk.put(controls));
            let mut frames = vec![0.0; 2 * 4800];
            player.play(&mut frames);
            frames.iter().fold(0.0_f32, |peak, sample| peak.max(sample.abs()))
        };
        assert_eq!(play(None), 0.0, "nothing was left yet");
        let peaks: Vec<f32> = (0..10).map(|_| play(Some(&wind))).collect();
        assert!(peaks[9] > 0.05);
        // The game hangs: for a quarter of a second its world sounds on.
        let peaks: Vec<f32> = (0..12).map(|_| play(None)).collect();
        assert!(peaks[1] > 0.05 && peaks[11] == 0.0, "{peaks:?}");
        let peaks: Vec<f32> = (0..5).map(|_| play(Some(&wind))).collect();
        assert!(peaks[4] > 0.05, "the game is back");
        assert_eq!(desk.played().0, 4800 * 28);
    }
}
