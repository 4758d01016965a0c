//! The judge of a case: every rule in every tick, what is the case's own at the end, and the times.

use crate::{
    kernel::params::Preset,
    lab::{
        balance::matter,
        cases::Verdict,
        gauntlet::{
            case::{GauntletCase, Known},
            examiner::Examiner,
            measure::energy::Stored,
            rule::{MOST_WORK, Rule},
            stability::{Came, Stability},
        },
        stats,
    },
    sim::{
        ledger::PassLedger,
        numbers::figure,
        pace::MOST_TICKS,
        state::{Clock, Counters, ParticleStore},
    },
};
use bevy::ecs::world::World;

/// The usual share of ticks that the time is judged by: one in ten may be late because of what else the machine does.
const USUAL: f64 = 0.9;

/// A calm tick is taken for this long if it is shorter, ms: below, the clock and the schedule are most of it.
pub(super) const LEAST_MS: f64 = 0.1;

/// What the judge has seen of a case.
pub(super) struct Judge {
    examiner: Examiner,
    /// Most ticks in a frame.
    late: u64,
    ms: Vec<f64>,
}

impl Judge {
    /// A judge of the case in its world at the start.
    pub fn new(case: &GauntletCase, world: &World) -> Self {
        let spacing = f64::from(matter(world).scale.spacing);
        Self { examiner: Examiner::new(world, case.terms(spacing)), late: 0, ms: Vec::new() }
    }

    /// Notes what an edit put in or took out, of a world that had `before`.
    pub fn edited(&mut self, before: Stored, world: &World) {
        self.examiner.edited(before, world, false);
    }

    /// Notes the world before a tick or frame.
    pub fn begin(&mut self, world: &World) {
        self.examiner.begin(world);
    }

    /// Inspects the world after the `ticks` ticks of a frame.
    pub fn look(&mut self, ticks: u64, world: &World) {
        self.late = self.late.max(ticks);
        self.ms.push(world.resource::<PassLedger>().last_tick().as_secs_f64() * 1e3);
        self.examiner.look(world);
    }

    /// The verdict at the end, and what was found. A calm tick of the same world takes `calm_ms`, simulating took `ms_total`.
    pub fn finish(
        mut self,
        case: &GauntletCase,
        preset: Preset,
        world: &World,
        [calm_ms, ms_total]: [f64; 2],
    ) -> (Verdict, Stability) {
        let clamps = *world.resource::<Counters>();
        let findings = self.examiner.finish(world);
        let time = stats::quantile(&mut self.ms, USUAL).unwrap_or(0.0) / calm_ms.max(LEAST_MS);
        let mut late = Vec::new();
        if self.late > u64::from(MOST_TICKS) {
            late.push(format!("{} ticks in a frame, allowed {MOST_TICKS}", self.late));
        }
        let mut own = Vec::new();
        if case.calm {
            own.extend(clamps.acted().map(|acted| format!("{} {}", acted.count, acted.what)));
        }
        if let Some(Err(what)) = case.end.map(|end| end.check(world)) {
            own.push(what);
        }
        let slow = (time > MOST_WORK).then(|| format!("time: {} calm ticks, allowed {MOST_WORK}", figure(time)));
        let is_classic = preset == Preset::Classic;
        let why = |rule: Option<Rule>| match rule {
            Some(rule) => case.known.get(&rule).copied(),
            None => case.known_own,
        };
        let ruled = findings.iter().filter_map(|finding| Some((Some(finding.rule), finding.fault()?)));
        let faults: Vec<(Option<Rule>, String)> = ruled.chain(own.into_iter().map(|what| (None, what))).collect();
        let mut known: Vec<&str> =
            faults.iter().filter_map(|(rule, _)| why(*rule)).filter(|_| is_classic).map(Known::why).collect();
        let verdict = match (late.is_empty() && known.len() == faults.len(), faults.is_empty()) {
            (false, _) => Verdict::Fail,
            (true, false) => Verdict::Known,
            (true, true) => Verdict::Pass,
        };
        known.dedup();
        let known = (!known.is_empty()).then(|| &*known.join("; ").leak());
        let broken = faults.into_iter().map(|(_, fault)| fault).chain(late).collect();
        let stability = Stability {
            broken,
            late: slow,
            known,
            ticks: world.resource::<Clock>().tick,
            particles: world.resource::<ParticleStore>().len(),
            rules: findings.into_iter().filter(|finding| finding.rule != Rule::Reads).map(Came::of).collect(),
            clamps,
            time,
            ms_max: stats::largest(&self.ms).unwrap_or(0.0),
            ms_median: stats::quantile(&mut self.ms, 0.5).unwrap_or(0.0),
            ms_total,
        };
        (verdict, stability)
    }
}
