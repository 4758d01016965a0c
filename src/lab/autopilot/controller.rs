//! Holds a measured quantity under a bound by choosing a level of a ladder. Each level relieves the quantity more than
//! the one before it. The controller knows no clock, no world and no quality: the same observations give the same
//! decisions.
//!
//! - **Up** (more relief): a mean that is surely over the bound is a breach. The level goes up to the first that the
//!   model expects below [`Tuning::aim`] of the bound.
//! - **Down** (less relief): to the first level that the model expects below [`Tuning::aim`] of the bound. The room
//!   between the two is the hysteresis.
//! - **Cool-down**: a level that was left because of a breach is not tried again for some seconds, twice as many each
//!   time.
//! - **Budget**: the time that the quantity may still be over the bound. It earns a small share of the time that passes
//!   and pays for the time over the bound. A move down waits until the budget holds the price of a failure ([`PRICE`]).
//!   When the budget is spent, and soon after a move, the quantity need not be surely over the bound: over it is a
//!   breach.
//!
//! When the quantity itself falls, all cool-downs end and the budget holds that price at once.

use super::window::{Mean, Window};

/// Over the bound by this factor, a mean over [`SHORT`] is a breach.
const GROSS: f32 = 1.25;
/// Windows of the means, s: for how far a move up goes, so that what was before a sudden change has no part in it, …
const NEWEST: f32 = 0.1;
/// … for a gross breach, …
const SHORT: f32 = 0.15;
/// … for any breach, …
const LONG: f32 = 0.4;
/// … and for a move that has no haste. For so long after a move, over the bound is a breach.
const CALM: f32 = 2.0;
/// Time after a move or a fall in which [`Tuning::quick`] does in place of [`CALM`], s.
const SOON: f32 = 1.1;
/// Time after a move in which the quantity still comes to what is usual at the level, s.
const SETTLED: f32 = 1.0;
/// The quantity has fallen if its mean is less by this factor, …
const FELL: f32 = 1.25;
/// … and by so many times what both means are doubted by.
const SURE: f32 = 2.7;
/// Window of the mean that is to stay under the bound, s.
const HELD: f32 = 0.5;
/// Budget that a move down waits for, s: about the time over the bound if it fails. Higher: later and rarer moves down.
const PRICE: f32 = 0.5;
/// The largest budget, s. Higher: more failures in a row after a long time under the bound. The smallest is -[`PRICE`].
const LARGEST: f32 = 2.0;
/// Levels that a move down goes at most: of those farther away the model knows less.
const FARTHEST: usize = 2;
/// The longest cool-down, s.
const LONGEST: f32 = 256.0;

/// What the quantity is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Time after a move whose observations still belong to the old level, s.
    pub settle: f32,
    /// Window of the mean that a move down soon after another one goes by, s. Shorter: faster, more moves by noise.
    pub quick: f32,
    /// Window of the means whose fall ends all cool-downs, beside [`CALM`], s. Longer: smaller falls are seen, later.
    pub usual: f32,
    /// Share of the observations that a mean leaves out at either end: for a quantity whose outliers are no part of it.
    pub trim: f32,
    /// Share of the bound that every move aims at. Higher: closer to the bound, with more breaches and moves.
    pub aim: f32,
    /// Standard errors by which a mean is doubted. 0: none.
    pub doubt: f32,
    /// Share of the time in which it may be over the bound. Higher: cheaper levels, more moves. 1: the budget never
    /// falls.
    pub allowed: f32,
    /// Cool-down after the first breach at a level, s.
    pub first: f32,
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
    /// The first settled means at this level, over [`CALM`] and [`Tuning::usual`].
    usual: [Option<Mean>; 2],
    /// What the model expected of this level when it was moved down to; else 0. Much less is a fall, too.
    expected: f32,
    cool_downs: Vec<CoolDown>,
    /// Observations of the last [`HELD`] seconds, whatever the level.
    held: Window,
    /// Time for which it may still be over the bound, s.
    budget: f32,
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
            usual: [None; 2],
            expected: 0.0,
            held: Window::default(),
            budget: 0.0,
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
        let over = self.keep_account(value, seconds);
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
        let strict = self.budget <= 0.0 || self.age < CALM;
        if self.at_least(long) > self.bound || over && strict {
            return self.move_up(long);
        }
        self.verdict = Verdict::Holds;
        let quick = self.mean(self.tuning.quick)?;
        self.notice_fall();
        let hasty = self.stirred < SOON && self.budget >= PRICE;
        let mean = if hasty { quick } else { self.mean(CALM)? };
        if self.at_least(mean) > self.bound {
            return self.move_up(mean);
        }
        self.move_down(mean.value.max(long.value) + self.tuning.doubt * mean.error)
    }

    /// Adds to the budget, or takes from it; whether the quantity is over the bound.
    fn keep_account(&mut self, value: f32, seconds: f32) -> bool {
        self.held.push(value, seconds, HELD);
        let over = self.held.mean(HELD, self.tuning.trim).is_some_and(|mean| mean.value > self.bound);
        let spent = if over { seconds } else { 0.0 };
        self.budget = (self.budget + self.tuning.allowed * seconds - spent).clamp(-PRICE, LARGEST);
        over
    }

    fn mean(&mut self, seconds: f32) -> Option<Mean> {
        self.seen.mean(seconds, self.tuning.trim)
    }

    fn at_least(&self, mean: Mean) -> f32 {
        mean.value - self.tuning.doubt * mean.error
    }

    /// The first of `levels` that the model expects well below the bound where `value` is measured at this one.
    fn first_that_holds(&self, mut levels: impl Iterator<Item = usize>, value: f32) -> Option<usize> {
        levels.find(|&level| value * self.model[level] / self.model[self.level] <= self.tuning.aim * self.bound)
    }

    /// Moves up after a breach.
    fn move_up(&mut self, mean: Mean) -> Option<usize> {
        let last = self.model.len() - 1;
        if self.level == last {
            self.verdict = Verdict::Beyond;
            return None;
        }
        let cool_down = &mut self.cool_downs[self.level];
        cool_down.whole = (2.0 * cool_down.whole).clamp(self.tuning.first, LONGEST);
        cool_down.left = cool_down.whole;
        let newest = self.mean(NEWEST).map_or(0.0, |newest| self.at_least(newest));
        let level = self.first_that_holds(self.level + 1..last, mean.value.max(newest)).unwrap_or(last);
        Some(self.move_to(level))
    }

    /// Moves down if a lower level is expected to hold and has no cool-down. The highest level that had a breach is
    /// tried before those below it, which relieve less. While the budget holds less than the price, it goes down only
    /// from a level that relieves more than it had to: one level at a time, and not to the one next to that breach.
    fn move_down(&mut self, value: f32) -> Option<usize> {
        let breached = self.cool_downs[..self.level].iter().rposition(|cool_down| cool_down.whole > 0.0);
        let lowest = if self.budget >= PRICE {
            breached.map_or(0, |level| level + usize::from(self.cool_downs[level].left > 0.0))
        } else {
            self.level.checked_sub(1).filter(|next| breached.is_some_and(|breached| breached + 1 < *next))?
        };
        let lowest = lowest.max(self.level.saturating_sub(FARTHEST));
        let level = self.first_that_holds(lowest..self.level, value)?;
        let expected = value * self.model[level] / self.model[self.level];
        self.move_to(level);
        self.expected = expected;
        Some(level)
    }

    fn move_to(&mut self, level: usize) -> usize {
        self.level = level;
        self.seen.clear();
        (self.age, self.stirred, self.usual, self.verdict) = (0.0, 0.0, [None; 2], Verdict::Settling);
        self.expected = 0.0;
        level
    }

    /// Begins anew if the quantity fell at this level: what had a breach before may hold now.
    fn notice_fall(&mut self) {
        for (k, window) in [CALM, self.tuning.usual].into_iter().enumerate() {
            let Some(now) = self.mean(window).filter(|_| self.age > SETTLED + window) else { return };
            // What was expected may be off by as much as a fall is.
            let first = Mean { value: now.value.max(self.expected / FELL), ..now };
            let usual = *self.usual[k].get_or_insert(first);
            let noise = SURE * self.tuning.doubt * (usual.error + now.error);
            if usual.value > FELL * now.value && usual.value - now.value > noise {
                self.usual = [None; 2];
                self.begin_anew();
                return;
            }
        }
    }

    fn begin_anew(&mut self) {
        self.stirred = 0.0;
        self.budget = self.budget.max(PRICE);
        self.cool_downs.fill(CoolDown::default());
    }
}
