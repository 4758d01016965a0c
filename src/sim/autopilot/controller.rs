//! Holds a measured quantity under a bound by choosing among positions that relieve it more and more. It knows no
//! clock, no world and no quality: the same observations give the same decisions.
//!
//! What each position does to the quantity is a model at first and learned from every move. A move aims well below the
//! bound, and back up only goes what is believed to stay well below it, so that a position that was left because it did
//! not hold is not tried again until the quantity itself has changed.

use bevy::math::ops;
use std::collections::VecDeque;

/// Over the bound by this factor, the short window decides.
const GROSS: f32 = 1.25;
/// Soon after a move, a value over this share of the bound moves it on: what stays is clear of the noise.
const CLEAR: f32 = 0.87;
/// Soon after the quantity fell, a move back is made if it is believed to stay below this share of the bound; …
const EASE: f32 = 0.78;
/// … otherwise only below this one: noise alone must not move it, nor a move that relieved more than it had to.
const EASE_LATE: f32 = 0.65;
/// How long "soon" is, s.
const SOON: f32 = 0.9;
/// In another situation what was learned counts less by this share.
const FORGET: f32 = 0.2;
/// What one move teaches is at most this factor: it may have met with a change from outside.
const LESSON: f32 = 2.0;
/// Share of the observations that a trimmed mean leaves out at either end.
const TRIM: f32 = 0.08;

/// Time (s) and least number of observations of the means that decisions rest on.
const NEWEST: (f32, usize) = (0.06, 3);
const SHORT: (f32, usize) = (0.12, 3);
const FAIR: (f32, usize) = (0.38, 5);
/// Least number of observations where there is no haste.
const LEAST_PATIENT: usize = 8;

/// What the quantity is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Character {
    /// Time after a move whose observations still belong to the old position, s.
    pub settle: f32,
    /// Share of the bound that a move which relieves aims at: the less the model is worth, the lower.
    pub aim: f32,
    /// Change at one position that is more than noise: a factor.
    pub drift: f32,
    /// Time over which it is averaged where there is no haste, s.
    pub patience: f32,
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
    /// Observations since the last move: seconds and value.
    seen: VecDeque<(f32, f32)>,
    /// Time since the last move, s.
    age: f32,
    /// Time since the last move or change of the quantity, s.
    stirred: f32,
    /// The position before the last move and the value there, until that has taught something.
    lesson: Option<(usize, f32)>,
    /// The value that this position settled at.
    settled: Option<f32>,
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
            model,
            seen: VecDeque::new(),
            age: 0.0,
            stirred: 0.0,
            lesson: None,
            settled: None,
            eager: true,
            misses: 0,
            verdict: Verdict::Settling,
        }
    }

    /// Holds another bound from now on; what was learned stays.
    pub fn set_bound(&mut self, bound: f32) {
        if self.bound != bound {
            self.bound = bound;
            (self.stirred, self.eager, self.misses, self.verdict) = (0.0, true, 0, Verdict::Settling);
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
        if self.age <= self.character.settle {
            return None;
        }
        self.seen.push_back((seconds, value));
        while self.seen.len() > LEAST_PATIENT
            && self.seen.iter().map(|seen| seen.0).sum::<f32>() > self.character.patience + seconds
        {
            self.seen.pop_front();
        }
        let short = self.mean_over(SHORT)?;
        if short > GROSS * self.bound {
            // The window may reach back to before the change: what is newest counts, and it teaches nothing.
            self.lesson = None;
            let moved = self.relieve(short.max(self.mean_over(NEWEST)?));
            self.lesson = None;
            return moved;
        }
        let fair = self.mean_over(FAIR)?;
        if fair > self.bound {
            return self.relieve(fair);
        }
        (self.verdict, self.misses) = (Verdict::Holds, 0);
        let long = self.mean_over((self.character.patience, LEAST_PATIENT))?;
        self.learn(long);
        self.notice_drift(long);
        let soon = self.stirred < SOON;
        if soon && long > CLEAR * self.bound && self.at + 1 < self.model.len() {
            return self.relieve(long);
        }
        // While it still falls, the first step back would be too short.
        if long > self.character.drift * fair {
            return None;
        }
        self.ease(long.max(fair), if soon && self.eager { EASE } else { EASE_LATE })
    }

    /// The trimmed mean of the observations of the last `window.0` s, if there are enough.
    fn mean_over(&self, window: (f32, usize)) -> Option<f32> {
        let mut span = 0.0;
        let mut values: Vec<f32> = Vec::new();
        for &(seconds, value) in self.seen.iter().rev() {
            values.push(value);
            span += seconds;
            if span >= window.0 - 1e-4 && values.len() >= window.1 {
                values.sort_unstable_by(f32::total_cmp);
                let trim = (TRIM * values.len() as f32).ceil() as usize;
                let kept = &values[trim..values.len() - trim];
                return Some(kept.iter().sum::<f32>() / kept.len() as f32);
            }
        }
        None
    }

    /// What `position` is believed to make of a value that is measured here.
    fn expect(&self, position: usize, value: f32) -> f32 {
        value * self.believed[position] / self.believed[self.at]
    }

    /// Moves to the first position that is believed to hold, or to the last.
    fn relieve(&mut self, value: f32) -> Option<usize> {
        self.learn(value);
        let last = self.model.len() - 1;
        if self.at == last {
            self.verdict = Verdict::Beyond;
            return None;
        }
        // What fell short once is not trusted as far again.
        let gross = value > GROSS * self.bound;
        let aim = self.bound * self.character.aim / if gross { (1 << self.misses.min(8)) as f32 } else { 1.0 };
        self.misses += u32::from(gross);
        self.eager = false;
        let enough = (self.at + 1..last).find(|&position| self.expect(position, value) <= aim);
        Some(self.move_to(enough.unwrap_or(last), value))
    }

    /// Moves back to where less relief is believed to do, if there is such a position.
    fn ease(&mut self, value: f32, share: f32) -> Option<usize> {
        let enough = (0..self.at).find(|&position| self.expect(position, value) <= share * self.bound);
        self.eager |= enough.is_some();
        enough.map(|position| self.move_to(position, value))
    }

    fn move_to(&mut self, position: usize, value: f32) -> usize {
        self.lesson = Some((self.at, value));
        self.at = position;
        self.seen.clear();
        (self.age, self.stirred, self.settled, self.verdict) = (0.0, 0.0, None, Verdict::Settling);
        position
    }

    /// Learns from the last move, once: positions beyond this one are believed to be off by the same factor.
    fn learn(&mut self, value: f32) {
        let Some((from, before)) = self.lesson.take() else { return };
        let expected = before * self.believed[self.at] / self.believed[from];
        if !(expected > 0.0 && value > 0.0) {
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

    /// Notices that the value is another than the one that this position settled at: then it is looked at as closely as
    /// after a move, and the model counts more again.
    fn notice_drift(&mut self, value: f32) {
        let settled = *self.settled.get_or_insert(value);
        let drift = self.character.drift;
        if value <= drift * settled && drift * value >= settled {
            return;
        }
        let (here, model_here) = (self.believed[self.at], self.model[self.at]);
        for (believed, model) in self.believed.iter_mut().zip(&self.model) {
            let lesson = (*believed / here) / (model / model_here);
            *believed = here * model / model_here * ops::powf(lesson, 1.0 - FORGET);
        }
        self.eager |= value < settled;
        (self.settled, self.stirred) = (Some(value), 0.0);
    }
}
