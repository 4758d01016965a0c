//! The judge: inspects the world after every tick, and reports at the end which rules were broken.

use crate::{
    kernel::{params::Preset, particles::Particles, units::TICKS_PER_SECOND},
    lab::{
        balance::matter,
        cases::Verdict,
        density::DensityError,
        gauntlet::{
            case::{GauntletCase, Known, Rules},
            stability::Stability,
        },
        stats,
    },
    sim::{
        ledger::PassLedger,
        pace::MOST_TICKS,
        stages::TickPlan,
        state::{AirGrid, Clock, Counters, ParticleStore, Rock, Setup},
    },
};
use bevy::ecs::world::World;
use glam::DVec2;

/// Ticks from one measurement of the density to the next.
const DENSITY_EVERY: u64 = 10;

/// Edge of the cells that candidate pairs are counted in, d: as far as the widest kernel of a quality reaches.
const REACH: f32 = 3.0;

/// Candidates of a particle in the resting lattice: the particles of nine cells.
const CALM_CANDIDATES: f64 = 9.0 * (REACH * REACH) as f64;

/// What may not get lost: how much of it there is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Totals {
    energy: f64,
    particles: usize,
    air: f64,
}

impl Totals {
    /// The totals of a world.
    pub fn of(world: &World) -> Self {
        Self {
            energy: matter(world).balance().energy(),
            particles: world.resource::<ParticleStore>().len(),
            air: world.resource::<AirGrid>().with_grid(world.resource::<Rock>()).mass(),
        }
    }
}

/// What the judge has seen of a case.
#[derive(Default)]
pub(super) struct Judge {
    rules: Rules,
    /// The most energy that may be gained, as a speed, m/s.
    gain_allowed: Option<f64>,
    /// Ticks or frames that it lasts.
    length: u64,
    seen: u64,
    /// Energy that was there at the start and was put in since, J.
    put_in: f64,
    /// Largest energy above that, as a speed, m/s.
    gain: f64,
    fastest: f64,
    /// Particles that ticks (and not edits) took away or made.
    missing: i64,
    /// Mass of air that ticks made, and the mass that was there.
    air: (f64, f64),
    /// Particles outside the confines, the first of them, and when.
    through: Option<(u64, DVec2)>,
    /// When and what first was no number, or a pressure below 0.
    unsound: Option<(u64, &'static str)>,
    density_worst: Option<f64>,
    density_end: Vec<f64>,
    motion: Vec<f64>,
    work: f64,
    /// Substeps times iterations of a calm tick.
    calm_passes: f64,
    counts: Vec<u32>,
    /// Most ticks in a frame.
    late: u64,
    ms: Vec<f64>,
}

impl Judge {
    /// A judge of the case in its world at the start.
    pub fn new(case: &GauntletCase, world: &World) -> Self {
        let quality = world.resource::<Setup>().quality;
        let totals = Totals::of(world);
        let spacing = f64::from(matter(world).scale.spacing);
        Self {
            rules: case.rules.clone(),
            gain_allowed: case.rules.gain.map(|gain| gain.speed(&quality, spacing)),
            length: u64::from(case.ticks),
            put_in: totals.energy,
            air: (0.0, totals.air),
            calm_passes: f64::from(quality.substeps * quality.iterations),
            ..Self::default()
        }
    }

    /// Notes what an edit put in or took out.
    pub fn edited(&mut self, before: Totals, after: Totals) {
        self.put_in += after.energy - before.energy;
        self.air.1 += after.air - before.air;
    }

    /// Inspects the world after `ticks` ticks since the totals were `before`.
    pub fn inspect(&mut self, before: Totals, ticks: u64, world: &World) {
        let after = Totals::of(world);
        self.seen += 1;
        self.late = self.late.max(ticks);
        self.missing += before.particles as i64 - after.particles as i64;
        self.air.0 += after.air - before.air;
        self.ms.push(world.resource::<PassLedger>().last_tick().as_secs_f64() * 1e3);
        self.check_numbers(world);
        let matter = matter(world);
        let (balance, spacing) = (matter.balance(), f64::from(matter.scale.spacing));
        if balance.mass > 0.0 {
            let gain = (2.0 * (after.energy - self.put_in).max(0.0) / balance.mass).sqrt();
            self.gain = self.gain.max(gain);
            self.fastest = self.fastest.max(balance.max_speed);
        }
        if let (Some(confines), None) = (&self.rules.confines, self.through) {
            let places = (0..matter.particles.len()).map(|i| matter.particles.position(i).as_dvec2() * spacing);
            self.through = places.into_iter().find(|place| !confines.hold(*place)).map(|place| (self.seen, place));
        }
        self.count_pairs(world);
        let ending = self.seen * 10 > self.length * 9;
        if ending {
            let speed = if balance.mass > 0.0 { (2.0 * balance.kinetic / balance.mass).sqrt() } else { 0.0 };
            let own_spacing = f64::from(matter.scale.own_spacing());
            self.motion.push(speed / own_spacing / f64::from(TICKS_PER_SECOND));
        }
        if self.seen.is_multiple_of(DENSITY_EVERY) || self.seen == self.length {
            self.measure_density(world, ending);
        }
    }

    fn check_numbers(&mut self, world: &World) {
        if self.unsound.is_some() {
            return;
        }
        let Particles { x, y, vx, vy, .. } = &world.resource::<ParticleStore>().0;
        let air = world.resource::<AirGrid>();
        let sound = |values: &[f32]| values.iter().fold(true, |all, value| all & value.is_finite());
        let unsound = if ![x, y, vx, vy].into_iter().all(|values| sound(values)) {
            Some("a particle is not finite")
        } else if (0..air.rows()).any(|row| !sound(air.velocity_x_row(row)) || !sound(air.velocity_y_row(row))) {
            Some("a wind is not finite")
        } else if (0..air.rows()).any(|row| !air.pressure_row(row).iter().all(|p| p.is_finite() && *p >= 0.0)) {
            Some("a pressure is not finite or below 0")
        } else {
            None
        };
        self.unsound = unsound.map(|what| (self.seen, what));
    }

    /// Counts the candidate pairs of the tick. What a tick costs follows from them, and they are the same everywhere.
    fn count_pairs(&mut self, world: &World) {
        let particles = &world.resource::<ParticleStore>().0;
        let setup = world.resource::<Setup>();
        let size = setup.blueprint.domain.size;
        let (columns, rows) = ((size.x / REACH) as usize + 3, (size.y / REACH) as usize + 3);
        self.counts.clear();
        self.counts.resize(columns * rows, 0);
        let place = |i: usize| {
            let along = |x: f32, cells: usize| ((x / REACH) as usize + 1).min(cells - 2);
            along(particles.y[i], rows) * columns + along(particles.x[i], columns)
        };
        (0..particles.len()).for_each(|i| self.counts[place(i)] += 1);
        let around = |k: usize| -> u64 {
            let row = |k: usize| self.counts[k - 1..=k + 1].iter().map(|count| u64::from(*count)).sum::<u64>();
            row(k - columns) + row(k) + row(k + columns)
        };
        let pairs: u64 = (0..particles.len()).map(|i| around(place(i))).sum();
        let passes = world.resource::<TickPlan>().substeps * setup.quality.iterations;
        let calm = CALM_CANDIDATES * particles.len().max(1) as f64 * self.calm_passes;
        self.work = self.work.max(pairs as f64 * f64::from(passes) / calm);
    }

    fn measure_density(&mut self, world: &World, ending: bool) {
        let Some(error) = DensityError::of_world(world) else { return };
        if self.seen >= self.rules.density.map_or(0, |density| density.shock) {
            self.density_worst = Some(self.density_worst.map_or(error.pressed, |worst| worst.max(error.pressed)));
        }
        if ending {
            self.density_end.push(error.pressed);
        }
    }

    /// The verdict at the end, and what was found. Simulating took `ms_total`.
    pub fn finish(mut self, case: &GauntletCase, preset: Preset, world: &World, ms_total: f64) -> (Verdict, Stability) {
        let clamps = *world.resource::<Counters>();
        let broken = self.broken(&clamps, world);
        let known = case.known.filter(|_| preset == Preset::Classic).map(Known::why);
        let verdict = match (broken.is_empty(), known) {
            (true, _) => Verdict::Pass,
            (false, Some(_)) => Verdict::Known,
            (false, None) => Verdict::Fail,
        };
        let stability = Stability {
            broken,
            known,
            ticks: world.resource::<Clock>().tick,
            particles: world.resource::<ParticleStore>().len(),
            gain: self.gain,
            gain_allowed: self.gain_allowed,
            density_worst: self.density_worst,
            density_end: stats::mean(&self.density_end),
            motion: stats::mean(&self.motion).unwrap_or(0.0),
            work: self.work,
            work_allowed: self.rules.most_work(),
            clamps,
            ms_max: stats::largest(&self.ms).unwrap_or(0.0),
            ms_median: stats::quantile(&mut self.ms, 0.5).unwrap_or(0.0),
            ms_total,
        };
        (verdict, stability)
    }

    fn broken(&self, counters: &Counters, world: &World) -> Vec<String> {
        let rules = &self.rules;
        let mut broken = Vec::new();
        if let Some((when, what)) = self.unsound {
            broken.push(format!("{what}, at tick {when}"));
        }
        if counters.escaped > 0 {
            broken.push(format!("{} times outside the box or in rock", counters.escaped));
        }
        if let Some((when, place)) = self.through {
            broken.push(format!("through to ({:.3}, {:.3}) m at tick {when}", place.x, place.y));
        }
        // What is no number is beyond every bound.
        let mut bound = |what: &str, value: f64, allowed: Option<f64>| {
            if let Some(allowed) = allowed.filter(|allowed| value.is_nan() || value > *allowed) {
                broken.push(format!("{what} {value:.3}, allowed {allowed}"));
            }
        };
        bound("energy gained, m/s:", self.gain, self.gain_allowed);
        bound("fastest, m/s:", self.fastest, rules.fastest);
        if let Some(density) = rules.density {
            let seen = |value: Option<f64>| value.unwrap_or(0.0);
            bound("density error", seen(self.density_worst), Some(density.worst));
            bound("density error at the end", seen(stats::mean(&self.density_end)), Some(density.end));
        }
        bound("motion, d a tick:", stats::mean(&self.motion).unwrap_or(0.0), rules.rest);
        bound("work of a tick", self.work, Some(rules.most_work()));
        bound("ticks in a frame", self.late as f64, Some(f64::from(MOST_TICKS)));
        if let Some(allowed) = rules.air {
            let drift = (self.air.0 / self.air.1).abs();
            if drift.is_nan() || drift > allowed {
                broken.push(format!("mass of the air off by {drift:.1e}, allowed {allowed:.0e}"));
            }
        }
        let (missing, removed) = (self.missing, counters.non_finite);
        if missing != removed as i64 || removed != rules.removed {
            broken.push(format!("{missing} particles went, {removed} as no number, where {} should", rules.removed));
        }
        if rules.calm {
            broken.extend(counters.acted().map(|acted| format!("{} {}", acted.count, acted.what)));
        }
        if let Some(Err(what)) = rules.end.map(|end| end.check(world)) {
            broken.push(what);
        }
        broken
    }
}
