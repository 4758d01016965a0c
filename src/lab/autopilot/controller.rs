//! Holds a measured quantity under a bound by choosing a level of a ladder. Each level relieves the quantity more than the
//! one before it. The controller knows no clock, no world and no quality: the same observations give the same decisions.
//!
//! - **Up** (more relief): a mean over the bound is a breach. The level goes up to the first that the model expects below
//!   [`AIM`] of the bound.
//! - **Down** (less relief): to the first level that the model expects below [`AIM`] of the bound. The room between the two
//!   is the hysteresis.
//! - **Cool-down**: a level that was left because of a breach is not tried again for some seconds, twice as many each time.
//!   All cool-downs end when the quantity itself falls.

use super::window::{Mean, Window};

/// Share of the bound that every move aims at. Higher: closer to the bound, with more breaches and moves.
const AIM: f32 = 0.7;
/// Over the bound by this factor, a mean over [`SHORT`] is a breach.
const GROSS: f32 = 1.25;
/// Windows of the means, s: for a gross breach, …
const SHORT: f32 = 0.15;
/// … for any breach, …
const LONG: f32 = 0.4;
/// … and for a move that has no haste.
const CALM: f32 = 2.0;
/// Time after a move or a fall in which [`Tuning::quick`] does in place of [`CALM`], s.
const SOON: f32 = 1.1;
/// The quantity has fallen if its mean is less by this factor, …
const FELL: f32 = 1.25;
/// … and by so many standard errors.
const SURE: f32 = 4.0;
/// Cool-down after the first breach at a level, s.
const FIRST: f32 = 4.0;
/// The longest cool-down, s.
const LONGEST: f32 = 256.0;

/// What the quantity is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Time after a move whose observations still belong to the old level, s.
    pub settle: f32,
    /// Window of the mean that a move down soon after another one goes by, s. Shorter: faster, more moves by noise.
    pub quick: f32,
    /// Window of the means whose fall ends all cool-downs, s. Longer: smaller falls are seen, later.
    pub usual: f32,
    /// Share of the observations that a mean leaves out at either end: for a quantity whose outliers are no part of it.
    pub trim: f32,
    /// Standard errors by which a mean is doubted. 0: none.
    pub doubt: f32,
}

/// How it stands with the bound.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Verdict {
    /// Not known yet, after a move or at the start.
    #[default]
    Settling,
    /// The quantity keeps to the bound.
    Holds,
    /// No level holds it: the last one is in force.
    Beyond,
}

/// When a level may be tried again.
#[derive(Clone, Copy, Debug, Default)]
struct CoolDown {
    /// Time that is left, s.
    left: f32,
    /// The last cool-down, s; 0 without a breach.
    whole: f32,
}

/// Chooses the level that relieves least and still holds the bound.
#[derive(Clone, Debug)]
pub struct Controller {
    bound: f32,
    tuning: Tuning,
    /// The quantity at each level in units of its own; falls from each to the next.
    model: Vec<f32>,
    level: usize,
    /// Observations at this level.
    seen: Window,
    /// Time since the last move, s.
    age: f32,
    /// Time since the last move, fall or change of the bound, s.
    stirred: f32,
    /// The first mean over [`Tuning::usual`] at this level.
    usual: Option<Mean>,
    cool_downs: Vec<CoolDown>,
    verdict: Verdict,
}

impl Controller {
    /// Holds `bound` from `level` on. `model` falls strictly and has at least one entry.
    pub fn new(bound: f32, tuning: Tuning, model: Vec<f32>, level: usize) -> Self {
        debug_assert!(!model.is_empty() && model.windows(2).all(|pair| pair[1] < pair[0]), "{model:?}");
        Self {
            bound,
            tuning,
            level: level.min(model.len() - 1),
            cool_downs: vec![CoolDown::default(); model.len()],
            model,
            seen: Window::default(),
            age: 0.0,
            stirred: 0.0,
            usual: None,
            verdict: Verdict::Settling,
        }
    }

    /// Holds another bound from now on.
    pub fn set_bound(&mut self, bound: f32) {
        if self.bound != bound {
            self.bound = bound;
            self.verdict = Verdict::Settling;
            self.begin_anew();
        }
    }

    /// The level in force.
    pub fn level(&self) -> usize {
        self.level
    }

    /// How it stands with the bound.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Takes a value that was measured over the last `seconds`; the new level if it moves.
    pub fn observe(&mut self, value: f32, seconds: f32) -> Option<usize> {
        if !(value.is_finite() && seconds > 0.0) {
            return None;
        }
        for cool_down in &mut self.cool_downs {
            cool_down.left = (cool_down.left - seconds).max(0.0);
        }
        self.age += seconds;
        self.stirred += seconds;
        if self.age <= self.tuning.settle {
            return None;
        }
        self.seen.push(value, seconds, self.tuning.usual.max(CALM));
        let short = self.mean(SHORT)?;
        if self.at_least(short) > GROSS * self.bound {
            return self.move_up(short);
        }
        let long = self.mean(LONG)?;
        if self.at_least(long) > self.bound {
            return self.move_up(long);
        }
        self.verdict = Verdict::Holds;
        let quick = self.mean(self.tuning.quick)?;
        self.notice_fall();
        let mean = if self.stirred < SOON { quick } else { self.mean(CALM)? };
        if self.at_least(mean) > self.bound {
            return self.move_up(mean);
        }
        self.move_down(mean.value.max(long.value) + self.tuning.doubt * mean.error)
    }

    fn mean(&mut self, seconds: f32) -> Option<Mean> {
        self.seen.mean(seconds, self.tuning.trim)
    }

    fn at_least(&self, mean: Mean) -> f32 {
        mean.value - self.tuning.doubt * mean.error
    }

    /// The first of `levels` that the model expects well below the bound where `value` is measured at this one.
    fn first_that_holds(&self, mut levels: impl Iterator<Item = usize>, value: f32) -> Option<usize> {
        levels.find(|&level| value * self.model[level] / self.model[self.level] <= AIM * self.bound)
    }

    /// Moves up after a breach.
    fn move_up(&mut self, mean: Mean) -> Option<usize> {
        let last = self.model.len() - 1;
        if self.level == last {
            self.verdict = Verdict::Beyond;
            return None;
        }
        let cool_down = &mut self.cool_downs[self.level];
        cool_down.whole = (2.0 * cool_down.whole).clamp(FIRST, LONGEST);
        cool_down.left = cool_down.whole;
        let level = self.first_that_holds(self.level + 1..last, mean.value).unwrap_or(last);
        Some(self.move_to(level))
    }

    /// Moves down if a lower level is expected to hold and has no cool-down. The highest level that had a breach is tried
    /// before those below it, which relieve less.
    fn move_down(&mut self, value: f32) -> Option<usize> {
        let breached = self.cool_downs[..self.level].iter().rposition(|cool_down| cool_down.whole > 0.0);
        let lowest = breached.map_or(0, |level| level + usize::from(self.cool_downs[level].left > 0.0));
        let level = self.first_that_holds(lowest..self.level, value)?;
        Some(self.move_to(level))
    }

    fn move_to(&mut self, level: usize) -> usize {
        self.level = level;
        self.seen.clear();
        (self.age, self.stirred, self.usual, self.verdict) = (0.0, 0.0, None, Verdict::Settling);
        level
    }

    /// Begins anew if the quantity fell at this level: what had a breach before may hold now.
    fn notice_fall(&mut self) {
        let Some(now) = self.mean(self.tuning.usual) else { return };
        let usual = *self.usual.get_or_insert(now);
        let noise = SURE * self.tuning.doubt * usual.error;
        if usual.value > FELL * now.value && usual.value - now.value > noise {
            self.usual = Some(now);
            self.begin_anew();
        }
    }

    fn begin_anew(&mut self) {
        self.stirred = 0.0;
        self.cool_downs.fill(CoolDown::default());
    }
}
