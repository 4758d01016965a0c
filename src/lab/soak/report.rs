//! What a soak showed, and whether it passes.

use super::{
    creep::{self, Creep, Exempt, FEWEST},
    memory,
    period::Totals,
    sitting::Sitting,
};
use crate::{
    lab::markdown,
    sim::{
        numbers::{figure, fixed},
        state::Counters,
    },
};
use serde::{Deserialize, Serialize};

/// A soak from its start on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Minutes simulated.
    pub minutes: u64,
    /// Rock at the start and at the end.
    pub rock_before: usize,
    /// See `rock_before`.
    pub rock_after: usize,
    /// Lumps that melted, burned, froze or broke from rock, or to it: while there are none, the rock of the start must be there.
    pub turned: u64,
    /// Whether the scene has drains: without any, what the player pours stays.
    pub drained: bool,
    /// Whether the box has an open side: without one, what the player presses into the air stays.
    pub open: bool,
    /// What the limiters did.
    pub counters: Counters,
    /// Periods of the same length, but perhaps the last.
    pub periods: Vec<Totals>,
    /// The processes that ran it, one after the other.
    pub sittings: Vec<Sitting>,
}

/// What was found of a mean; or its name, and why it is not judged.
type Found = Result<Creep, (&'static str, &'static str)>;

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
        expect(before == after || self.turned > 0, format!("{before} particles of rock became {after}"));
        let finite = |totals: &Totals| {
            [totals.kinetic, totals.energy, totals.air_mass, totals.air_energy].into_iter().all(f64::is_finite)
        };
        let all_finite = self.periods.iter().all(finite);
        expect(all_finite, "an energy or the mass of the air is no number".into());
        if all_finite {
            faults.extend(self.creeps().into_iter().flatten().flat_map(|creep| creep.faults));
        }
        faults
    }

    /// What creeps, after the first hour: the means, and the memory of the sitting that grew most beyond what it may.
    pub fn creeps(&self) -> Vec<Found> {
        let whole = |totals: &&Totals| Some(totals.minutes) == self.periods.first().map(|first| first.minutes);
        // The first hour fills pools and buffers.
        let late = |totals: &&Totals| totals.until - totals.minutes >= 60;
        let judged: Vec<Totals> = self.periods.iter().filter(whole).filter(late).copied().collect();
        let too_short = (judged.len() < FEWEST).then_some("too few periods after the first hour");
        let exempt = Exempt {
            matter: too_short.or((!self.drained).then_some("no drain takes away what the player pours")),
            air: too_short.or((!self.open).then_some("the air is sealed and keeps what the player presses in")),
        };
        let mut found = creep::judge(&judged, exempt);
        let excess = |creep: &Creep| creep.change - creep.allowed;
        let memory = (0..self.sittings.len()).filter_map(|nth| memory::judge(self.sat(nth), &self.sittings[nth]));
        let memory = memory.max_by(|a, b| excess(a).total_cmp(&excess(b)));
        found.push(memory.ok_or(("memory, bytes", "no process ran for more than its first hour, or it is unknown")));
        found
    }

    /// The periods that ended in a sitting.
    fn sat(&self, nth: usize) -> &[Totals] {
        let place = |minute| self.periods.partition_point(|totals| totals.until <= minute);
        let end = self.sittings.get(nth + 1).map_or(self.periods.len(), |next| place(next.from));
        &self.periods[place(self.sittings[nth].from).min(end)..end]
    }

    /// Real time of all sittings, s.
    pub fn seconds(&self) -> f64 {
        self.sittings.iter().map(|sitting| sitting.seconds).sum()
    }

    /// The periods as a table in Markdown, the means that are judged as another, and who ran it.
    pub fn text(&self) -> String {
        let sitting = |sitting: &Sitting| {
            let Sitting { from, processor, threads, instructions, seconds } = sitting;
            let (hour, verb) = (*from as f64 / 60.0, if *from > 0 { "resumed" } else { "begun" });
            let plural = if *threads == 1 { "" } else { "s" };
            format!("{verb} at {hour:.2} h: {processor}, {threads} thread{plural}, {instructions}, {seconds:.0} s\n")
        };
        let sittings: String = self.sittings.iter().map(sitting).collect();
        format!("{}\n{}\n{sittings}", self.table(), self.table_of_creeps())
    }

    fn table(&self) -> String {
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

    fn table_of_creeps(&self) -> String {
        let line = |found: Found| match found {
            Ok(Creep { measure, mean, change, allowed, faults }) => {
                let [mean, change, allowed] = [mean, change, allowed].map(figure);
                let verdict = if faults.is_empty() { "holds" } else { "does NOT hold" };
                format!("{measure} | {mean} | {change} | {allowed} | {verdict}")
            }
            Err((measure, why)) => format!("{measure} | – | – | – | not judged: {why}"),
        };
        let headings = "after the first hour | >mean | >change | >allowed | verdict";
        markdown::rows(headings, self.creeps().into_iter().map(line))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn calm() -> Report {
        let hour = |hour: u64| {
            // What scatters by a thousandth.
            let scatter = 1.0 + 1e-3 * ((hour * 7 % 10) as f64 - 4.5) / 4.5;
            Totals {
                until: 60 * hour,
                minutes: 60,
                ms: 1.0,
                particles: 10_000.0 * scatter,
                particles_peak: 10_100.0,
                kinetic: 500.0 * scatter,
                energy: 9e5 * scatter,
                air_mass: 800.0 * scatter,
                air_energy: 3.0 * scatter,
                resident: Some(3e7),
                ..Totals::default()
            }
        };
        Report {
            minutes: 1440,
            rock_before: 9,
            rock_after: 9,
            drained: true,
            open: true,
            periods: (1..=24).map(hour).collect(),
            sittings: vec![Sitting { threads: 2, ..Sitting::default() }],
            ..Report::default()
        }
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
        assert_eq!(faults_with(|report| (report.rock_after, report.turned) = (8, 1)), 0, "rock that melts");
        assert_eq!(faults_with(|report| report.periods[1].air_mass = f64::NAN), 1);
        assert_eq!(faults_with(|report| report.periods[23].particles = 10_200.0), 1);
        assert_eq!(faults_with(|report| report.periods[9].particles = 9_800.0), 1);
        assert_eq!(faults_with(|report| report.periods[23].resident = Some(4e7)), 1);
        assert_eq!(faults_with(|report| report.periods[20].kinetic = 520.0), 1);
        assert_eq!(faults_with(|report| report.periods[20].air_energy = 4.0), 1);
        assert_eq!(faults_with(|report| report.periods[0].particles = 20_000.0), 0, "the first hour fills pools");
    }

    #[test]
    fn what_cannot_be_judged_is_not_and_says_why() {
        let unjudged = |change: fn(&mut Report)| {
            let mut report = calm();
            change(&mut report);
            let count = report.creeps().iter().filter(|found| found.is_err()).count();
            assert_eq!(report.text().matches("not judged: ").count(), count);
            count
        };
        assert_eq!(unjudged(|_| {}), 0);
        assert_eq!(unjudged(|report| report.drained = false), 3);
        assert_eq!(unjudged(|report| report.open = false), 2);
        assert_eq!(unjudged(|report| report.periods.truncate(8)), 5, "the memory is judged from the second hour on");
        assert_eq!(unjudged(|report| report.periods.truncate(1)), 6);
        // Seven after the first hour, and a shorter one that does not count.
        assert_eq!(unjudged(|report| (report.periods.truncate(9), report.periods[8].minutes = 5).0), 5);
    }

    #[test]
    fn each_process_fills_its_own_memory() {
        let resumed = |from: u64| Sitting { from, threads: 2, ..Sitting::default() };
        let grow = |report: &mut Report| report.periods[12..].iter_mut().for_each(|totals| totals.resident = Some(4e7));
        assert_eq!(faults_with(grow), 1);
        assert_eq!(faults_with(|report| (grow(report), report.sittings.push(resumed(12 * 60))).0), 0);
        // Resumed in an hour, whose memory is the second process's.
        assert_eq!(faults_with(|report| (grow(report), report.sittings.push(resumed(12 * 60 + 10))).0), 0);
        assert_eq!(faults_with(|report| (grow(report), report.sittings.push(resumed(10 * 60))).0), 1);
    }
}
