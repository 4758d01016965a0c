//! Holds a measured quantity under a bound by choosing among positions that relieve it more and more. It knows no
//! clock, no world and no quality: the same observations give the same decisions.
//!
//! What each position does to the quantity is a model at first and learned from every move. A move aims well below the
//! bound, and back up only goes what is believed to stay well below it. A position that was left because it did not hold
//! rests ([`Backoff`]), each time twice as long, unless the quantity itself changes. A quantity that is known from samples
//! is over the bound only where its mean is by more than its standard error, and changes only by several of them.

use super::{
    backoff::Backoff,
    usual::Usual,
    window::{Estimate, Observations, Window},
};
use bevy::math::ops;

/// Over the bound by this factor, the short window decides.
const GROSS: f32 = 1.25;
/// Soon after a move, a value over this share of the bound moves it on: what stays is clear of the noise.
const CLEAR: f32 = 0.87;
/// Soon after the quantity fell, a move back is made if it is believed to stay below this share of the bound; …
const EASE: f32 = 0.78;
/// … otherwise only below this one: noise alone must not move it, nor a move that relieved more than it had to.
const EASE_LATE: f32 = 0.65;
/// "Soon" is so much longer than what the first look at a position takes, s.
const SOON: f32 = 0.3;
/// A mean whose standard error is below this share of it needs no longer look.
const WELL_KNOWN: f32 = 0.1;
/// In another situation what was learned counts less by this share.
const FORGET: f32 = 0.2;
/// What one move teaches is at most this factor: it may have met with a change from outside.
const LESSON: f32 = 2.0;

/// The newest observations, where a change is under way.
const NEWEST: Window = Window { seconds: 0.06, count: 3 };

/// What the quantity is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Character {
    /// Time after a move whose observations still belong to the old position, s.
    pub settle: f32,
    /// Share of the bound that a move which relieves aims at: the less the model is worth, the lower.
    pub aim: f32,
    /// Change at one position that is more than noise: a factor.
    pub drift: f32,
    /// What a gross breach is seen by.
    pub short: Window,
    /// What any other breach is seen by.
    pub fair: Window,
    /// What is looked at after a move or a change, where there is no haste.
    pub patient: Window,
    /// What is looked at before a move back without a change; not shorter than `patient`.
    pub calm: Window,
    /// Time after the first look at a position over which what is usual there is found, s.
    pub usual: f32,
    /// Share of the observations that a mean leaves out at either end: for a quantity whose outliers are no part of it.
    pub trim: f32,
    /// Standard errors that a mean is doubted by: 0 where it is what it is.
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
    /// No position holds it: the last one is in force.
    Beyond,
}

/// Chooses the position that relieves least and still holds the bound.
#[derive(Clone, Debug)]
pub struct Controller {
    bound: f32,
    character: Character,
    /// The quantity at each position in units of its own; falls from each to the next.
    model: Vec<f32>,
    /// The same as learned.
    believed: Vec<f32>,
    at: usize,
    /// Observations since the last move.
    seen: Observations,
    /// Time since the last move, s.
    age: f32,
    /// Time since the last move or change of the quantity, s.
    stirred: f32,
    /// The position before the last move and the value there, until that has taught something.
    lesson: Option<(usize, f32)>,
    usual: Usual,
    backoff: Backoff,
    /// Whether the quantity fell of late, so that less relief may do.
    eager: bool,
    /// Moves in a row that did not relieve enough.
    misses: u32,
    verdict: Verdict,
}

impl Controller {
    /// Holds `bound` from position `at` on. `model` falls strictly and has at least one entry.
    pub fn new(bound: f32, character: Character, model: Vec<f32>, at: usize) -> Self {
        debug_assert!(!model.is_empty() && model.windows(2).all(|pair| pair[1] < pair[0]), "{model:?}");
        Self {
            bound,
            character,
            at: at.min(model.len() - 1),
            believed: model.clone(),
            backoff: Backoff::new(model.len()),
            model,
            seen: Observations::default(),
            age: 0.0,
            stirred: 0.0,
            lesson: None,
            usual: Usual::default(),
            eager: true,
            misses: 0,
            verdict: Verdict::Settling,
        }
    }

    /// Holds another bound from now on; what was learned stays, but what failed may hold this one.
    pub fn set_bound(&mut self, bound: f32) {
        if self.bound != bound {
            self.bound = bound;
            (self.stirred, self.eager, self.misses, self.verdict) = (0.0, true, 0, Verdict::Settling);
            self.backoff.forget();
        }
    }

    /// The position in force.
    pub fn position(&self) -> usize {
        self.at
    }

    /// How it stands with the bound.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Takes a value that was measured over the last `seconds`; the new position if it moves.
    pub fn observe(&mut self, value: f32, seconds: f32) -> Option<usize> {
        if !(value.is_finite() && seconds > 0.0) {
            return None;
        }
        self.age += seconds;
        self.stirred += seconds;
        self.backoff.pass(seconds);
        let Character { settle, drift, short, fair, patient, calm, .. } = self.character;
        if self.age <= settle {
            return None;
        }
        self.seen.push(value, seconds, Window { seconds: 4.0 * calm.seconds, ..calm });
        let short = self.estimate(short)?;
        if self.at_least(short) > GROSS * self.bound {
            return self.relieve_grossly(short);
        }
        let fair = self.estimate(fair)?;
        if self.at_least(fair) > self.bound {
            return self.relieve(fair);
        }
        (self.verdict, self.misses) = (Verdict::Holds, 0);
        let long = self.estimate(patient)?;
        let calm = self.estimate(calm);
        if let Some(calm) = calm {
            if self.at_least(calm) > self.bound {
                return self.relieve(calm);
            }
            self.learn(calm.mean);
        }
        self.notice_drift(long, seconds);
        let soon = self.stirred < patient.seconds + SOON;
        if soon && self.at_least(long) > CLEAR * self.bound && self.at + 1 < self.model.len() {
            return self.relieve(long);
        }
        // While it still falls, the first step back would be too short.
        if long.mean > drift * fair.mean {
            return None;
        }
        let fell = soon && self.eager;
        let basis = if fell || long.error < WELL_KNOWN * long.mean { long } else { calm? };
        let share = if fell { EASE } else { EASE_LATE };
        self.ease(self.at_most(basis).max(self.at_most(fair)), share)
    }

    fn estimate(&mut self, window: Window) -> Option<Estimate> {
        self.seen.estimate(window, self.character.trim)
    }

    fn at_least(&self, estimate: Estimate) -> f32 {
        estimate.mean - self.character.doubt * estimate.error
    }

    fn at_most(&self, estimate: Estimate) -> f32 {
        estimate.mean + self.character.doubt * estimate.error
    }

    /// What `position` is believed to make of a value that is measured here.
    fn expect(&self, position: usize, value: f32) -> f32 {
        value * self.believed[position] / self.believed[self.at]
    }

    /// Where the last move came from, if that relieved more and nothing was learned of the move yet.
    fn came_back_from(&self) -> Option<usize> {
        self.lesson.map(|lesson| lesson.0).filter(|&from| from > self.at)
    }

    /// Moves on because of the short window, which may reach back to before a change: what is newest counts. Nothing but
    /// a move back teaches so soon.
    fn relieve_grossly(&mut self, short: Estimate) -> Option<usize> {
        if self.came_back_from().is_none() {
            self.lesson = None;
        }
        let newest = self.estimate(NEWEST)?;
        let moved = self.relieve(if newest.mean > short.mean { newest } else { short });
        self.lesson = None;
        moved
    }

    /// Moves to the first position that is believed to hold, or to the last.
    fn relieve(&mut self, estimate: Estimate) -> Option<usize> {
        let held = self.came_back_from();
        let value = estimate.mean;
        self.learn(value);
        let last = self.model.len() - 1;
        if self.at == last {
            self.verdict = Verdict::Beyond;
            return None;
        }
        self.backoff.fail(self.at);
        // What fell short once is not trusted as far again.
        let gross = value > GROSS * self.bound;
        let aim = self.bound * self.character.aim / if gross { (1 << self.misses.min(8)) as f32 } else { 1.0 };
        self.misses += u32::from(gross);
        self.eager = false;
        let enough = (self.at + 1..last).find(|&position| self.expect(position, value) <= aim).unwrap_or(last);
        // Where it came from held a moment ago.
        Some(self.move_to(held.map_or(enough, |held| enough.min(held)), value))
    }

    /// Moves back to where less relief is believed to do, if there is such a position that does not rest.
    fn ease(&mut self, value: f32, share: f32) -> Option<usize> {
        self.learn(value);
        let first = self.backoff.first_allowed(self.at);
        let enough = (first..self.at).find(|&position| self.expect(position, value) <= share * self.bound);
        enough.map(|position| self.move_to(position, value))
    }

    fn move_to(&mut self, position: usize, value: f32) -> usize {
        self.lesson = Some((self.at, value));
        self.at = position;
        self.seen.clear();
        (self.age, self.stirred, self.usual, self.verdict) = (0.0, 0.0, Usual::default(), Verdict::Settling);
        position
    }

    /// Learns from the last move, once: positions beyond this one are believed to be off by the same factor.
    fn learn(&mut self, value: f32) {
        let Some((from, before)) = self.lesson.take() else { return };
        let expected = before * self.believed[self.at] / self.believed[from];
        if expected <= 0.0 {
            return;
        }
        let factor = (value / expected).clamp(1.0 / LESSON, LESSON);
        let distance = self.at.abs_diff(from) as f32;
        for (position, believed) in self.believed.iter_mut().enumerate() {
            let beyond = (position > from) == (self.at > from) && position != from;
            let share = if beyond { (position.abs_diff(from) as f32 / distance).min(1.0) } else { 0.0 };
            *believed *= ops::powf(factor, share);
        }
    }

    /// Notices that the value is another than what is usual at this position: then it is looked at as closely as after a
    /// move, and the model counts more again. If it fell, what failed rests no longer.
    fn notice_drift(&mut self, long: Estimate, seconds: f32) {
        let Character { drift, patient, usual, doubt, .. } = self.character;
        let Some(since) = self.usual.note(long, seconds, usual) else { return };
        // Longer windows know smaller changes, but none may reach back to what is usual.
        for windows in [1.0, 2.5, 5.0, 10.0] {
            let seconds = windows * patient.seconds;
            if windows > 1.0 && seconds > since.min(2.0 * usual) {
                return;
            }
            let Some(now) = self.estimate(Window { seconds, ..patient }) else { return };
            if let Some(fell) = self.usual.changed(now.mean, windows, drift, doubt) {
                self.usual = Usual::default();
                self.start_anew(fell);
                return;
            }
        }
    }

    /// Takes what comes for another situation, a better one if the quantity `fell`.
    fn start_anew(&mut self, fell: bool) {
        let (here, model_here) = (self.believed[self.at], self.model[self.at]);
        for (believed, model) in self.believed.iter_mut().zip(&self.model) {
            let lesson = (*believed / here) / (model / model_here);
            *believed = here * model / model_here * ops::powf(lesson, 1.0 - FORGET);
        }
        self.stirred = 0.0;
        if fell {
            self.eager = true;
            self.backoff.forget();
        }
    }
}
