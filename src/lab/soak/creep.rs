//! Whether a mean creeps, period by period, or one period stands out.
//!
//! A scene that lets in and takes out forgets its past within the time that what is in it stays there: some 15 s in the waterfall
//! (its water over its inflow). Periods are minutes to hours long and the player's bouts alike, so the means of the periods
//! after the first hour scatter about one value, independently and (by the central limit theorem) normally. From their own
//! scatter follows what may be by chance: Student's t for the slope of their line, and for each against all others. No bound
//! is a number of ours but the chance that a sound soak fails.

use super::period::Totals;
use crate::lab::{stats, student};
use serde::Serialize;

/// The chance that a soak fails in which nothing creeps: half of it for the slopes, half for the single periods, shared out
/// evenly (Bonferroni).
const FALSE_ALARM: f64 = 1e-3;

/// Means below this share of themselves apart are the same: what sums of 10⁷ figures in f64 round.
const ROUNDING: f64 = 1e-9;

/// Fewest periods that are judged: their scatter is then known to some 30 % (1/√(2 · 6)).
pub(super) const FEWEST: usize = 8;

/// A mean that is judged.
struct Measure {
    name: &'static str,
    of: fn(&Totals) -> f64,
    /// Whether a fall is a fault, too: matter or air that gets lost. An energy may fall.
    both_ways: bool,
    /// Whether it is the air's.
    of_air: bool,
}

const MEASURES: [Measure; 5] = [
    Measure { name: "particles", of: |totals| totals.particles, both_ways: true, of_air: false },
    Measure { name: "kinetic energy, J", of: |totals| totals.kinetic, both_ways: false, of_air: false },
    Measure { name: "energy, J", of: |totals| totals.energy, both_ways: false, of_air: false },
    Measure { name: "air mass", of: |totals| totals.air_mass, both_ways: true, of_air: true },
    Measure { name: "energy of the air", of: |totals| totals.air_energy, both_ways: false, of_air: true },
];

/// What was found of a mean, or of the memory.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Creep {
    /// Of what.
    pub measure: &'static str,
    /// Its mean over the periods that are judged.
    pub mean: f64,
    /// By how much it rose over them.
    pub change: f64,
    /// How much it may by chance, or (memory) by what buffers may grow: the least creep that is seen.
    pub allowed: f64,
    /// What does not hold.
    pub faults: Vec<String>,
}

/// Why the means of matter or air are not judged: `None` where they are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Exempt {
    pub matter: Option<&'static str>,
    pub air: Option<&'static str>,
}

/// The means of `periods`, which are all of the same length, from the first hour on; and why others are not judged.
pub(super) fn judge(periods: &[Totals], exempt: Exempt) -> Vec<Result<Creep, (&'static str, &'static str)>> {
    let one = |measure: &Measure| match if measure.of_air { exempt.air } else { exempt.matter } {
        Some(why) => Err((measure.name, why)),
        None => Ok(measure.creep(periods)),
    };
    MEASURES.iter().map(one).collect()
}

impl Measure {
    /// At least three periods.
    fn creep(&self, periods: &[Totals]) -> Creep {
        let hours = |totals: &Totals| totals.until as f64 / 60.0;
        let points: Vec<(f64, f64)> = periods.iter().map(|totals| (hours(totals), (self.of)(totals))).collect();
        let freedom = points.len().saturating_sub(2).max(1);
        let share = 0.5 * FALSE_ALARM / MEASURES.len() as f64 / if self.both_ways { 2.0 } else { 1.0 };
        let mean = stats::mean(points.iter().map(|(_, value)| *value)).unwrap_or_default();
        let rounding = ROUNDING * mean.abs();
        let mut faults = Vec::new();

        let (slope, start) = stats::line(&points).unwrap_or_default();
        let middle = stats::mean(points.iter().map(|(hour, _)| *hour)).unwrap_or_default();
        let spread: f64 = points.iter().map(|(hour, _)| (hour - middle).powi(2)).sum();
        let left: f64 = points.iter().map(|(hour, value)| (value - start - slope * hour).powi(2)).sum();
        let span = points.last().zip(points.first()).map_or(0.0, |(last, first)| last.0 - first.0);
        let change = slope * span;
        let error = span * (left / freedom as f64 / spread).sqrt();
        let allowed = rounding.max(student::quantile(share, freedom) * error);
        if self.is_beyond(change, allowed) {
            faults.push(format!("{}: {change:+.4e} in {span:.1} h, by chance up to {allowed:.1e}", self.name));
        }

        let far = student::quantile(share / points.len() as f64, freedom);
        for (k, (hour, value)) in points.iter().enumerate() {
            let others = || points.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, (_, value))| *value);
            let count = points.len() as f64 - 1.0;
            let mean = stats::mean(others()).unwrap_or_default();
            let variance = others().map(|other| (other - mean).powi(2)).sum::<f64>() / freedom as f64;
            let allowed = rounding.max(far * (variance * (1.0 + 1.0 / count)).sqrt());
            if self.is_beyond(value - mean, allowed) {
                faults.push(format!(
                    "{}: {value:.4e} in the period until {hour:.2} h, in the others {mean:.4e}, by chance {allowed:.1e} off",
                    self.name
                ));
            }
        }
        Creep { measure: self.name, mean, change, allowed, faults }
    }

    fn is_beyond(&self, change: f64, allowed: f64) -> bool {
        change > allowed || self.both_ways && -change > allowed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::random::Random;

    const KINETIC: &Measure = &MEASURES[1];
    const PARTICLES: &Measure = &MEASURES[0];

    /// 23 hours about 1,000 that scatter by 10 (the sum of 12 even numbers is nearly normal), with what is added to each.
    fn day(seed: u64, more: impl Fn(f64) -> f64) -> Vec<Totals> {
        let mut random = Random::new(seed);
        let mut scatter = || (0..12).map(|_| f64::from(random.share())).sum::<f64>() - 6.0;
        let hour = |hour: u64| {
            let value = 1000.0 + 10.0 * scatter() + more(hour as f64);
            Totals { until: 60 * hour, minutes: 60, particles: value, kinetic: value, ..Totals::default() }
        };
        (2..=24).map(hour).collect()
    }

    fn faulty(measure: &Measure, more: impl Fn(f64) -> f64) -> usize {
        (0..200).filter(|seed| !measure.creep(&day(*seed, &more)).faults.is_empty()).count()
    }

    #[test]
    fn what_only_scatters_passes() {
        // One in 5,000 of each measure; more than one in 200 has a chance of 1 in 1,000.
        assert!(faulty(KINETIC, |_| 0.0) <= 1 && faulty(PARTICLES, |_| 0.0) <= 1);
        assert!(KINETIC.creep(&day(1, |_| 0.0)).allowed < 50.0, "a creep of 5 % in a day is seen");
    }

    #[test]
    fn a_creep_of_the_size_that_is_told_is_seen_and_so_is_one_bad_hour() {
        assert_eq!(faulty(KINETIC, |hour| 4.0 * hour), 200, "9 % in a day");
        assert_eq!(faulty(KINETIC, |hour| if hour == 9.0 { 150.0 } else { 0.0 }), 200);
        assert_eq!(faulty(KINETIC, |hour| (hour - 18.0).exp()), 200, "an explosion at the end");
    }

    #[test]
    fn only_what_can_get_lost_may_not_fall() {
        assert!(faulty(KINETIC, |hour| -4.0 * hour) <= 1);
        assert_eq!(faulty(PARTICLES, |hour| -4.0 * hour), 200);
    }

    #[test]
    fn what_never_changes_is_no_creep_but_the_least_step_is() {
        let still: Vec<Totals> = day(1, |_| 0.0).into_iter().map(|totals| Totals { kinetic: 0.1, ..totals }).collect();
        assert_eq!(KINETIC.creep(&still).faults, [""; 0]);
        let mut step = still;
        step[20].kinetic += 1e-3;
        assert_ne!(KINETIC.creep(&step).faults, [""; 0]);
    }
}
