//! A source of sound that is spread over the world.

use super::listener::Arrival;

/// Lowest level: −60 dB of full scale. What is fainter is silent.
const FAINT: f32 = 1e-3;

/// Power that arrives at the listener, and what is known of it on average.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Source {
    power: f32,
    /// The sum of each part's power times its side.
    side: f32,
    /// The sum of each part's power times its speed.
    pace: f32,
}

impl Source {
    /// One more part of it.
    pub(super) fn add(&mut self, power: f32, arrival: Arrival) {
        self.add_moving(power, 0.0, arrival);
    }

    /// One more part of it, which moves at a speed (m/s).
    pub(super) fn add_moving(&mut self, power: f32, speed: f32, arrival: Arrival) {
        let power = power * arrival.share;
        self.power += power;
        self.side += power * arrival.pan;
        self.pace += power * speed;
    }

    /// Both together.
    pub(super) fn plus(self, other: Self) -> Self {
        let [power, side, pace] = [self.power + other.power, self.side + other.side, self.pace + other.pace];
        Self { power, side, pace }
    }

    /// Between this one and another: all of the other at 1.
    pub(super) fn towards(self, other: Self, share: f32) -> Self {
        let mix = |from: f32, to: f32| from + (to - from) * share;
        Self { power: mix(self.power, other.power), side: mix(self.side, other.side), pace: mix(self.pace, other.pace) }
    }

    /// Share of its highest value that it gives something: half at a power of `half`.
    pub(super) fn share(self, half: f32) -> f32 {
        self.power / (self.power + half)
    }

    /// Where it is, −1 … 1.
    pub(super) fn pan(self) -> f32 {
        if self.power > 0.0 { (self.side / self.power).clamp(-1.0, 1.0) } else { 0.0 }
    }

    /// How fast it is on average, m/s.
    pub(super) fn speed(self) -> f32 {
        if self.power > 0.0 { self.pace / self.power } else { 0.0 }
    }

    /// Its level: amplitude grows as the root of power, up to `most`, half of which a power of `half` has. Nothing that would be
    /// below [`FAINT`].
    pub(super) fn level(self, half: f32, most: f32) -> f32 {
        let amplitude = (self.power / half).max(0.0).sqrt();
        let level = most * amplitude / (1.0 + amplitude);
        if level < FAINT { 0.0 } else { level }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::sound::Listener;
    use glam::Vec2;

    #[test]
    fn more_power_is_louder_up_to_a_limit_and_the_faintest_is_silent() {
        let listener = Listener::of_box(Vec2::new(24.0, 12.0));
        let level = |power: f32| {
            let mut source = Source::default();
            source.add(power, listener.hears(Vec2::new(12.0, 6.0)));
            source.level(100.0, 0.3)
        };
        let levels: Vec<f32> = [0.0, 1e-6, 1.0, 10.0, 100.0, 1e4, 1e9].map(level).to_vec();
        assert!(levels.is_sorted() && levels[2] < levels[3] && levels[3] < levels[4]);
        assert_eq!(levels[..2], [0.0, 0.0]);
        assert!((levels[4] - 0.15).abs() < 1e-3 && levels[6] <= 0.3);
    }

    #[test]
    fn a_source_is_where_most_of_its_power_is_and_as_fast_as_most_of_it() {
        let listener = Listener::of_box(Vec2::new(24.0, 12.0));
        let mut source = Source::default();
        assert_eq!((source.pan(), source.speed()), (0.0, 0.0));
        source.add_moving(1.0, 2.0, listener.hears(Vec2::new(2.0, 6.0)));
        assert!(source.pan() < -0.5 && source.speed() == 2.0);
        source.add_moving(9.0, 4.0, listener.hears(Vec2::new(22.0, 6.0)));
        assert!(source.pan() > 0.3 && source.speed() > 3.5);
        source.add_moving(9.0, 4.0, listener.hears(Vec2::new(2.0, 6.0)));
        source.add_moving(1.0, 4.0, listener.hears(Vec2::new(22.0, 6.0)));
        assert!(source.pan().abs() < 1e-5);
    }
}
