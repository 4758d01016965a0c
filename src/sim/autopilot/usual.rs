//! What is usual at a position, and whether what is seen now is something else.

use super::window::Estimate;
use bevy::math::ops;

/// Standard errors that a change is more than.
const SURE: f32 = 4.0;

/// The mean of a window's estimates over the first time at a position.
#[derive(Clone, Copy, Debug, Default)]
pub struct Usual {
    estimate: Estimate,
    /// Estimates that it is the mean of.
    count: u32,
    /// Time from the first of them on, s.
    seconds: f32,
}

impl Usual {
    /// Takes an estimate after another `seconds`: the first one, and those of the first `time`, s, are what is usual.
    /// Returns the time since that is known, s.
    pub fn note(&mut self, estimate: Estimate, seconds: f32, time: f32) -> Option<f32> {
        if self.count > 0 {
            self.seconds += seconds;
            if self.seconds > time {
                return Some(self.seconds - time);
            }
        }
        self.count += 1;
        let weight = 1.0 / self.count as f32;
        self.estimate.mean += weight * (estimate.mean - self.estimate.mean);
        self.estimate.error += weight * (estimate.error - self.estimate.error);
        None
    }

    /// Whether `mean`, over `windows` times the window of the estimates, is another by the factor `drift` and by more than
    /// noise, which is `doubt` times the standard error; and if so, whether it is less.
    pub fn changed(&self, mean: f32, windows: f32, drift: f32, doubt: f32) -> Option<bool> {
        let usual = self.estimate.mean;
        let noise = SURE * doubt * self.estimate.error / ops::sqrt(windows);
        let (low, high) = if mean < usual { (mean, usual) } else { (usual, mean) };
        (high > drift * low && high - low > noise).then_some(mean < usual)
    }
}
