//! Sounds of a moment: the bubbles that water closes over, and the snaps of what bursts or strikes.
//!
//! A bubble of radius r rings at `f = 3/r` (Minnaert 1933: 3.26 m/s over r, near the surface somewhat less) and dies away at
//! `δ = 0.13/r + 0.0072 r^(−3/2)`, while its pitch rises as it comes to the surface: `f(t) = f (1 + ξ δ t)` (van den Doel 2005,
//! "Physically based models for liquid sounds", eq. 1–3).

use crate::{
    block::{Block, LEN},
    math::{decay, pan_gains},
    noise::Chance,
};

/// Most grains that sound at once; further ones are not heard.
pub const MOST_GRAINS: usize = 48;

/// Rise of a bubble's pitch ξ, in its own decay; van den Doel has 0 … 0.1 for most of them.
const RISE: f32 = 0.1;

/// Below this a grain has died away: −80 dB of full scale.
const DEAD: f32 = 1e-4;

/// A sound of a moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grain {
    /// Pitch, Hz.
    pub(crate) pitch: f32,
    /// What the pitch has gained after a second, Hz.
    pub(crate) rise: f32,
    /// How fast it dies away, 1/s.
    pub(crate) decay: f32,
    /// Share of it that is noise.
    pub(crate) noise: f32,
    /// Its peak, of full scale.
    pub(crate) level: f32,
    /// Where it is, −1 … 1.
    pub(crate) pan: f32,
}

impl Grain {
    /// A bubble of radius `r` (m).
    pub(crate) fn bubble(r: f32, level: f32, pan: f32) -> Self {
        let (pitch, decay) = (3.0 / r, 0.13 / r + 0.0072 / (r * r.sqrt()));
        Self { pitch, rise: pitch * RISE * decay, decay, noise: 0.0, level, pan }
    }
}

/// A grain that sounds.
#[derive(Clone, Copy, Debug)]
struct Voice {
    /// Where in its turn it is, in 2⁻³² turns.
    phase: u32,
    /// What a frame adds to that.
    step: u32,
    /// What a frame adds to the step.
    rise: u32,
    /// Its envelope, and what is left of it after a block.
    level: f32,
    fade: f32,
    tone: f32,
    noise: f32,
    gains: [f32; 2],
    /// Frames of the next block before it begins.
    wait: usize,
}

/// All grains that sound.
#[derive(Clone, Debug)]
pub(crate) struct Grains {
    voices: [Option<Voice>; MOST_GRAINS],
    chance: Chance,
    rate: f32,
}

impl Grains {
    pub(crate) fn new(rate: f32) -> Self {
        Self { voices: [None; MOST_GRAINS], chance: Chance::new(1), rate }
    }

    /// Whether none sounds.
    #[cfg(test)]
    pub(crate) fn is_silent(&self) -> bool {
        self.voices.iter().all(Option::is_none)
    }

    /// Lets a grain sound from somewhere in the next block on, if there is room for it.
    pub(crate) fn add(&mut self, grain: Grain) {
        let wait = (self.chance.unit() * LEN as f32) as usize;
        let rate = self.rate;
        // What is above the half of the sample rate would come back as another pitch.
        if grain.pitch > 0.45 * rate || grain.level < DEAD {
            return;
        }
        let Some(place) = self.voices.iter_mut().find(|voice| voice.is_none()) else { return };
        let turns = |hertz: f32| (hertz / rate * 4_294_967_296.0) as u32;
        *place = Some(Voice {
            phase: 0,
            step: turns(grain.pitch),
            rise: turns(grain.rise / rate),
            level: grain.level,
            fade: decay(grain.decay * LEN as f32 / rate),
            tone: 1.0 - grain.noise,
            noise: grain.noise,
            gains: pan_gains(grain.pan.clamp(-1.0, 1.0)),
            wait: wait.min(LEN - 1),
        });
    }

    /// Adds what sounds in the next block. `noise` is white.
    pub(crate) fn render(&mut self, noise: &Block, out: &mut Block) {
        for place in &mut self.voices {
            let Some(voice) = place else { continue };
            voice.render(noise, out);
            if voice.level < DEAD {
                *place = None;
            }
        }
    }
}

impl Voice {
    fn render(&mut self, noise: &Block, out: &mut Block) {
        let mut phases = [0_u32; LEN];
        let frames = self.wait..LEN;
        for phase in &mut phases[frames.clone()] {
            *phase = self.phase;
            self.phase = self.phase.wrapping_add(self.step);
            self.step = self.step.wrapping_add(self.rise);
        }
        // Within a block the envelope falls straight.
        let fall = self.level * (1.0 - self.fade) / LEN as f32;
        let [left, right] = self.gains;
        for k in frames {
            let envelope = self.level - fall * (k - self.wait) as f32;
            let sound = envelope * (self.tone * sine(phases[k]) + self.noise * noise[k][0]);
            out[k][0] += left * sound;
            out[k][1] += right * sound;
        }
        self.level -= fall * (LEN - self.wait) as f32;
        self.wait = 0;
    }
}

/// Sine of a phase in 2⁻³² turns, to 10⁻³: two parabolas, bent to the third harmonic.
#[inline(always)]
fn sine(phase: u32) -> f32 {
    let half_turns = phase as i32 as f32 * (1.0 / 2_147_483_648.0);
    let y = 4.0 * half_turns * (1.0 - half_turns.abs());
    y * (0.775 + 0.225 * y.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::SILENCE;

    #[test]
    fn a_bubble_has_its_pitch_and_dies_away() {
        let mut grains = Grains::new(48_000.0);
        grains.add(Grain::bubble(0.006, 0.5, -1.0));
        let mut samples = Vec::new();
        for _ in 0..600 {
            let mut block = SILENCE;
            grains.render(&SILENCE, &mut block);
            samples.extend(block.map(|[left, right]| {
                assert!(right.abs() < 1e-6);
                left
            }));
        }
        let crossings = samples[..2400].windows(2).filter(|pair| pair[0] <= 0.0 && pair[1] > 0.0).count();
        // 500 Hz for 50 ms are 25 turns, and the pitch rises a little.
        assert!((25..=31).contains(&crossings), "{crossings}");
        assert!(samples.iter().fold(0.0_f32, |peak, x| peak.max(x.abs())) > 0.3);
        assert!(grains.is_silent(), "it sounds after 400 ms");
    }

    #[test]
    fn those_beyond_the_limit_are_not_heard() {
        let mut grains = Grains::new(48_000.0);
        for _ in 0..10 * MOST_GRAINS {
            grains.add(Grain::bubble(0.02, 0.001, 0.0));
        }
        assert_eq!(grains.voices.iter().flatten().count(), MOST_GRAINS);
    }

    #[test]
    fn what_is_too_high_for_the_samples_is_left_out() {
        let mut grains = Grains::new(8000.0);
        grains.add(Grain::bubble(0.0005, 0.5, 0.0));
        assert!(grains.is_silent());
    }
}
