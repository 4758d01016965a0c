//! What a soak showed, and whether it passes.

use crate::{
    lab::{
        markdown,
        stats::{largest, mean, quantile},
    },
    sim::{numbers::fixed, state::Counters},
};
use serde::Serialize;

/// How much more memory the last quarter may need than the second: what an allocator's fragments may, and no leak of a
/// byte a tick in a day (5 MB).
const MEMORY_GROWTH: f64 = 2e6;

/// How far the mean count of the last quarter may be from that of the second: several times what hours of the waterfall
/// scatter.
const COUNT_DRIFT: f64 = 0.05;

/// How many times the mean kinetic energy of the second quarter that of the last may be.
const ENERGY_GROWTH: f64 = 2.0;

/// What is measured of a world once a second.
#[derive(Clone, Debug, Default)]
pub(super) struct Look {
    /// Movable particles.
    pub particles: f64,
    /// Kinetic energy of the particles, J for each metre of depth.
    pub kinetic: f64,
    /// The same with the potential energy, J for each metre of depth.
    pub energy: f64,
    /// Mass of the air, in cells at the surroundings' pressure.
    pub air_mass: f64,
    /// Kinetic energy of the air, in its own units.
    pub air_energy: f64,
    /// Memory of the process, bytes; only on Linux.
    pub resident: Option<f64>,
}

/// The samples of a period.
#[derive(Clone, Debug, Default)]
pub(super) struct Period {
    /// Times of the ticks, ms.
    pub tick_ms: Vec<f64>,
    /// The world, once a second.
    pub looks: Vec<Look>,
}

impl Period {
    /// What is kept of it, if it ends after `minutes` of the soak.
    pub fn close(mut self, minutes: u64) -> Totals {
        let of = |what: fn(&Look) -> f64| mean(self.looks.iter().map(what)).unwrap_or_default();
        Totals {
            until: minutes,
            particles: of(|look| look.particles),
            kinetic: of(|look| look.kinetic),
            kinetic_peak: largest(self.looks.iter().map(|look| look.kinetic)).unwrap_or_default(),
            energy: of(|look| look.energy),
            air_mass: of(|look| look.air_mass),
            air_energy: of(|look| look.air_energy),
            resident: largest(self.looks.iter().filter_map(|look| look.resident)),
            ms: quantile(&mut self.tick_ms, 0.5).unwrap_or_default(),
            ms_p99: quantile(&mut self.tick_ms, 0.99).unwrap_or_default(),
        }
    }
}

/// What is kept of a period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Totals {
    /// Minutes from the start of the soak to its end.
    pub until: u64,
    /// Median tick, ms.
    pub ms: f64,
    /// 99th percentile of the ticks, ms.
    pub ms_p99: f64,
    /// Mean number of movable particles.
    pub particles: f64,
    /// Mean kinetic energy of the particles, J for each metre of depth.
    pub kinetic: f64,
    /// The highest.
    pub kinetic_peak: f64,
    /// Mean kinetic and potential energy, J for each metre of depth.
    pub energy: f64,
    /// Mean mass of the air, in cells at the surroundings' pressure.
    pub air_mass: f64,
    /// Mean kinetic energy of the air.
    pub air_energy: f64,
    /// Most memory of the process, bytes; only on Linux.
    pub resident: Option<f64>,
}

/// A soak from its start to its end.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Minutes simulated.
    pub minutes: u64,
    /// Rock at the start and at the end.
    pub rock_before: usize,
    /// See `rock_before`.
    pub rock_after: usize,
    /// What the limiters did.
    pub counters: Counters,
    /// Periods of the same length, but perhaps the last.
    pub periods: Vec<Totals>,
}

impl Report {
    /// What did not hold, each in a line; nothing if all did.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |holds: bool, what: String| {
            if !holds {
                faults.push(what);
            }
        };
        let Counters { non_finite, escaped, .. } = self.counters;
        expect(non_finite == 0, format!("{non_finite} particles stopped being numbers"));
        expect(escaped == 0, format!("{escaped} times a particle was outside the box or in rock at the end of a tick"));
        let (before, after) = (self.rock_before, self.rock_after);
        expect(before == after, format!("{before} particles of rock became {after}"));
        let finite =
            |totals: &Totals| totals.energy.is_finite() && totals.air_mass.is_finite() && totals.air_energy.is_finite();
        expect(self.periods.iter().all(finite), "an energy or the mass of the air is no number".into());
        // The first quarter fills pools and buffers.
        let quarter = self.periods.len() / 4;
        if quarter > 0 {
            let (second, last) = (&self.periods[quarter..2 * quarter], &self.periods[self.periods.len() - quarter..]);
            let of = |what: fn(&Totals) -> f64| {
                [second, last].map(|periods| mean(periods.iter().map(what)).unwrap_or_default())
            };
            let [early, late] = of(|totals| totals.particles);
            expect(
                (late - early).abs() <= COUNT_DRIFT * early.max(1.0),
                format!("{early:.0} particles in the second quarter became {late:.0} in the last"),
            );
            let most = |periods: &[Totals]| largest(periods.iter().filter_map(|totals| totals.resident));
            let [early, late] = [second, last].map(|periods| most(periods).unwrap_or_default());
            expect(
                late <= early + MEMORY_GROWTH,
                format!("{:.1} MB in the second quarter became {:.1} in the last", early / 1e6, late / 1e6),
            );
            let [early, late] = of(|totals| totals.kinetic);
            expect(
                late <= ENERGY_GROWTH * early,
                format!("a kinetic energy of {early:.0} J in the second quarter became {late:.0} J in the last"),
            );
        }
        faults
    }

    /// The periods as a table in Markdown.
    pub fn table(&self) -> String {
        let line = |totals: &Totals| {
            let Totals { until, ms, ms_p99, particles, kinetic, kinetic_peak, energy, air_mass, resident, .. } =
                *totals;
            let (hours, energy, memory) =
                (until as f64 / 60.0, energy / 1e3, fixed(resident.map(|bytes| bytes / 1e6), 1));
            format!(
                "{hours:.2} | {ms:.3} | {ms_p99:.3} | {particles:.0} | {kinetic:.0} | {kinetic_peak:.0} | {energy:.1} | \
                 {air_mass:.1} | {memory}"
            )
        };
        let headings = ">until, h | >ms | >p99 | >particles | >kinetic energy, J | >peak | >energy, kJ | >air mass | \
                        >memory, MB";
        markdown::rows(headings, self.periods.iter().map(line))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn calm() -> Report {
        let totals = Totals {
            ms: 1.0,
            particles: 10_000.0,
            kinetic: 500.0,
            energy: 9e5,
            air_mass: 800.0,
            resident: Some(3e7),
            ..Totals::default()
        };
        Report { minutes: 60, rock_before: 9, rock_after: 9, periods: vec![totals; 8], ..Report::default() }
    }

    fn faults_with(change: impl FnOnce(&mut Report)) -> usize {
        let mut report = calm();
        change(&mut report);
        report.faults().len()
    }

    #[test]
    fn each_fault_is_seen_and_nothing_else() {
        assert_eq!(faults_with(|_| {}), 0);
        assert_eq!(faults_with(|report| report.counters.escaped = 1), 1);
        assert_eq!(faults_with(|report| report.counters.non_finite = 1), 1);
        assert_eq!(faults_with(|report| report.rock_after = 8), 1);
        assert_eq!(faults_with(|report| report.periods[1].air_mass = f64::NAN), 1);
        assert_eq!(faults_with(|report| report.periods[7].particles = 20_000.0), 1);
        assert_eq!(faults_with(|report| report.periods[7].resident = Some(4e7)), 1);
        assert_eq!(faults_with(|report| report.periods[6].kinetic = 5000.0), 1);
        assert_eq!(faults_with(|report| report.periods[0].particles = 20_000.0), 0, "the first quarter fills pools");
    }
}
