//! Positions that did not hold, and when each may be tried again: after a pause that doubles each time that it fails.

/// Pause after the first failure, s. A change for the better that shows at once ends it sooner.
const FIRST: f32 = 4.0;
/// The longest pause, s.
const LONGEST: f32 = 256.0;

/// Who failed, and how long it rests.
#[derive(Clone, Debug)]
pub struct Backoff {
    rests: Vec<Rest>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Rest {
    /// Time that is left of the pause, s.
    left: f32,
    /// The last pause, s; 0 without a failure.
    pause: f32,
}

impl Backoff {
    /// None of `positions` has failed.
    pub fn new(positions: usize) -> Self {
        Self { rests: vec![Rest::default(); positions] }
    }

    /// Lets `seconds` pass.
    pub fn pass(&mut self, seconds: f32) {
        for rest in &mut self.rests {
            rest.left = (rest.left - seconds).max(0.0);
        }
    }

    /// `position` was left because it did not hold.
    pub fn fail(&mut self, position: usize) {
        let rest = &mut self.rests[position];
        rest.pause = (2.0 * rest.pause).clamp(FIRST, LONGEST);
        rest.left = rest.pause;
    }

    /// Forgets all failures: they were of another situation.
    pub fn forget(&mut self) {
        self.rests.fill(Rest::default());
    }

    /// The first position before `at` that may be tried, or `at` if none may. What relieves less than one that failed
    /// would fail as well, so the last that failed is tried before them.
    pub fn first_allowed(&self, at: usize) -> usize {
        let failed = self.rests[..at].iter().rposition(|rest| rest.pause > 0.0);
        failed.map_or(0, |failed| if self.rests[failed].left > 0.0 { failed + 1 } else { failed })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_failure_doubles_the_pause_up_to_a_longest() {
        let mut backoff = Backoff::new(3);
        for pause in [4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 256.0] {
            backoff.fail(1);
            backoff.pass(pause - 0.5);
            assert_eq!(backoff.first_allowed(2), 2, "it is tried before its {pause} s are over");
            backoff.pass(0.5);
            assert_eq!(backoff.first_allowed(2), 1, "it rests for longer than {pause} s");
        }
        backoff.fail(1);
        backoff.forget();
        assert_eq!(backoff.first_allowed(2), 0);
        backoff.fail(1);
        backoff.pass(FIRST);
        assert_eq!(backoff.first_allowed(2), 1, "what is forgotten still doubles its pause");
    }
}
