//! Judges a world tick by tick, by every rule, on terms that say what is its own.

use super::{
    confines::Confines,
    measure::{
        air::{AirMass, Held},
        cost,
        energy::{self, Due, Stored},
        place::{astray, speeds},
        roll::Roll,
        sound::unsound,
        still::is_plain,
        work::Work,
    },
    rule::{Finding, MOST_WORK, Measured, ONE_TOO_MANY, OVERLAP_SPEED, Rule, STILL, STILL_DENSITY},
};
use crate::{
    kernel::units::TICK_SECONDS,
    lab::{balance::matter, density::DensityError, stats},
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        stages::TickPlan,
        state::{Books, Counters, ParticleStore, Rock, Setup},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;
use std::collections::BTreeMap;

/// Ticks from one measurement of the density to the next.
const DENSITY_EVERY: u64 = 10;
/// Ticks after which a shock is over: half a second, in which what was pressed by hands or limits has come apart.
pub(super) const SHOCK: u64 = 30;
/// Fewest particles inside a liquid of which one in a hundred can be told.
const ENOUGH: usize = 100;
/// Fewer particles than this are drops: as many as fill a cell of the predictor's grid, which is 2.5 d wide.
const DROPS: usize = 7;
/// Share of the free room that liquid may fill and still have room to give way.
const FULL: f64 = 0.9;

/// On what terms a world is judged.
#[derive(Clone, Debug)]
pub struct Terms {
    /// Ticks or frames that it runs.
    pub(super) length: u64,
    /// Why it may move at its end; nothing if it may not.
    pub(super) restless: Result<(), &'static str>,
    /// Ticks after which the shock of the start is over.
    pub(super) shock: u64,
    /// Share of the energy that can become motion which liquid may hold besides.
    pub(super) given_back: f64,
    /// Bounds of its own.
    pub(super) bounds: BTreeMap<Rule, f64>,
    /// Rules that can't apply, and why.
    pub(super) waived: BTreeMap<Rule, &'static str>,
    /// Where particles may be besides.
    pub(super) confines: Option<Confines>,
    /// Particles that are no number and have to be taken away.
    pub(super) removed: u64,
    /// Whether liquid may be as dense as it gets where there is no predictor, no room, or a load that no step can follow.
    pub(super) lenient: bool,
}

/// What is noted before a tick.
struct Before {
    roll: Roll,
    count: usize,
    air: Held,
    due: Due,
    cuts: u64,
}

/// Judges a world tick by tick.
pub struct Examiner {
    findings: [Result<Measured, &'static str>; Rule::ALL.len()],
    before: Option<Before>,
    seen: u64,
    air: AirMass,
    is_sealed: bool,
    /// Energy that was there and was put in.
    put_in: Stored,
    is_plain: bool,
    /// Ticks seen when hands, limits or jets last shook it.
    shaken: u64,
    terms: Terms,
    /// Most potential energy so far, above that of all matter in the lowest corner, J.
    height: f64,
    /// Most energy that it was ever allowed to gain, J.
    most_gained: f64,
    /// Particles that ticks took away.
    missing: i64,
    motion: Vec<f64>,
    /// How often lumps had become other elements when the second half began.
    turned: Option<u64>,
    work: Work,
}

impl Examiner {
    /// Of a world as it is.
    pub fn new(world: &World, terms: Terms) -> Self {
        let blueprint = &world.resource::<Setup>().blueprint;
        let open = blueprint.air.open;
        let mut findings = Rule::ALL.map(|_| Err("not reached"));
        findings[Rule::Reads as usize] = Ok(Measured { value: 0.0, bound: 0.0, tick: 0, what: String::new() });
        for (rule, why) in &terms.waived {
            findings[*rule as usize] = Err(why);
        }
        Self {
            findings,
            before: None,
            seen: 0,
            air: AirMass::of(world),
            is_sealed: !(open.left || open.right || open.bottom || open.top),
            put_in: Stored::of(world),
            is_plain: is_plain(&blueprint.fluid),
            shaken: 0,
            terms,
            height: 0.0,
            most_gained: 0.0,
            missing: 0,
            motion: Vec::new(),
            turned: None,
            work: Work::default(),
        }
    }

    /// Notes what hands put in or took out, and, if that is so, that they shook the world.
    pub fn edited(&mut self, before: Stored, world: &World, shaken: bool) {
        let after = Stored::of(world);
        if after.air != before.air {
            self.air.edited();
        }
        self.put_in.edited(before, after);
        if shaken {
            self.shaken = self.seen;
        }
    }

    /// Notes the world before a tick.
    pub fn begin(&mut self, world: &World) {
        self.before = Some(Before {
            roll: Roll::of(world),
            count: world.resource::<ParticleStore>().len(),
            air: Held::of(world),
            due: Due::of(world),
            cuts: cuts(world),
        });
    }

    /// Judges the world after a tick.
    pub fn look(&mut self, world: &World) {
        let Some(before) = self.before.take() else { return };
        self.seen += 1;
        let count = |what: Option<String>| match what {
            Some(what) => Measured::fault(self.seen, what),
            None => self.measured(0.0, 0.0),
        };
        let finite = count(unsound(world).map(str::to_owned));
        let inside = match astray(world).or_else(|| self.through(world)) {
            Some((count, at)) => {
                let value = count as f64;
                Measured {
                    value,
                    ..Measured::fault(self.seen, format!("{count} astray, one at ({}, {}) d", at.x, at.y))
                }
            }
            None => self.measured(0.0, 0.0),
        };
        // Of those that have to be taken away it is known at the end whether they were all.
        let called = if self.terms.removed > 0 { Ok(()) } else { before.roll.call(world) };
        let lost = count(called.err());
        self.missing += before.count as i64 - world.resource::<ParticleStore>().len() as i64;
        for (rule, measured) in [(Rule::Finite, finite), (Rule::Inside, inside), (Rule::Lost, lost)] {
            self.note(rule, measured);
        }
        self.air.ticked(before.air, world);
        if self.is_sealed {
            self.note(Rule::Air, self.measured(self.air.drift(), self.air.most()));
        } else {
            self.waive(Rule::Air, "open");
        }
        let (fastest, most) = speeds(world);
        self.note(Rule::Speed, self.measured(fastest, most));
        self.put_in.add(before.due.put_in(world));
        self.energy(world);
        // What crosses a spacing in a step meets others before any of them sees it.
        let step = f64::from(world.resource::<TickPlan>().substep_seconds());
        if cuts(world) > before.cuts || fastest * step > 1.0 {
            self.shaken = self.seen;
        }
        if self.seen.is_multiple_of(DENSITY_EVERY) || self.seen == self.terms.length {
            self.density(world);
        }
        if self.seen * 2 > self.terms.length {
            self.turned.get_or_insert(turns(world));
        }
        if self.is_ending() {
            let balance = matter(world).balance();
            let speed = if balance.mass > 0.0 { (2.0 * balance.kinetic / balance.mass).sqrt() } else { 0.0 };
            self.motion.push(speed / f64::from(matter(world).scale.own_spacing()) * f64::from(TICK_SECONDS));
        }
        let work = cost::of_tick(&mut self.work, world);
        self.note(Rule::Cost, self.measured(work, MOST_WORK));
    }

    /// What was found of each rule.
    pub fn finish(mut self, world: &World) -> Vec<Finding> {
        if self.terms.removed > 0 {
            let removed = world.resource::<Counters>().non_finite;
            let (missing, wanted) = (self.missing, self.terms.removed);
            let what = format!("{missing} particles went, {removed} as no number, where {wanted} should");
            let holds = missing == removed as i64 && removed == wanted;
            let measured = if holds { self.measured(0.0, 0.0) } else { Measured::fault(self.seen, what) };
            self.note(Rule::Lost, measured);
        }
        let is_drops = self.terms.lenient && world.resource::<ParticleStore>().len() < DROPS;
        let restless = match self.terms.restless {
            Ok(()) if is_drops => Err("a few drops"),
            Ok(()) if self.is_turning(world) => Err("matter changes"),
            restless => restless,
        };
        match (restless, stats::mean(&self.motion)) {
            (Ok(()), Some(motion)) => self.note(Rule::Rest, self.measured(motion, STILL)),
            (Err(why), _) => self.waive(Rule::Rest, why),
            (Ok(()), None) => {}
        }
        Rule::ALL.into_iter().zip(self.findings).map(|(rule, measured)| Finding { rule, measured }).collect()
    }

    fn measured(&self, value: f64, bound: f64) -> Measured {
        Measured { value, bound, tick: self.seen, what: String::new() }
    }

    /// Whether this is the last tenth, in which what shall be at rest is so.
    fn is_ending(&self) -> bool {
        self.seen * 10 > self.terms.length * 9
    }

    /// Whether matter became other matter since half of the time: what melts has another weight, or leaves room behind, and what
    /// lies on it moves.
    fn is_turning(&self, world: &World) -> bool {
        self.turned.is_some_and(|before| before != turns(world))
    }

    /// Particles beyond where the terms let them be: how many, and where the first of them is, d.
    fn through(&self, world: &World) -> Option<(usize, Vec2)> {
        let confines = self.terms.confines.as_ref()?;
        let matter = matter(world);
        let spacing = f64::from(matter.scale.spacing);
        let places = (0..matter.particles.len()).map(|i| matter.particles.position(i));
        let mut through = places.filter(|at| !confines.hold(at.as_dvec2() * spacing));
        let first = through.next()?;
        Some((1 + through.count(), first))
    }

    /// Keeps what is nearest to its bound: that of the terms, if they have one.
    fn note(&mut self, rule: Rule, mut measured: Measured) {
        if self.terms.waived.contains_key(&rule) {
            return;
        }
        measured.bound = self.terms.bounds.get(&rule).copied().unwrap_or(measured.bound);
        let kept = &mut self.findings[rule as usize];
        if kept.as_ref().is_ok_and(|kept| kept.share() >= measured.share()) {
            return;
        }
        *kept = Ok(measured);
    }

    /// Says why a rule does not apply, unless it did before.
    fn waive(&mut self, rule: Rule, why: &'static str) {
        let kept = &mut self.findings[rule as usize];
        if kept.is_err() {
            *kept = Err(why);
        }
    }

    /// The energy of matter above what was there and was put in, as a speed. Allowed is what overlaps may part with, a share
    /// of what can become motion at all, which liquid holds that stands too high or was pressed together, and half of
    /// gravity's kick: what comes to a stop within a substep does so half a kick early or late. Drains and hands take matter away
    /// with the energy that it has, what it gained included, and the gain stays in the book: so what is allowed, as energy, is the
    /// most that was so far, and not what the rest of the matter would be.
    fn energy(&mut self, world: &World) {
        let balance = matter(world).balance();
        if !self.is_plain {
            return self.waive(Rule::Energy, "no plain liquid");
        }
        if balance.mass == 0.0 {
            return self.waive(Rule::Energy, "no matter");
        }
        if lets_masses_be(world) {
            return self.waive(Rule::Energy, "masses are off");
        }
        let gained = (balance.energy() - self.put_in.all()).max(0.0);
        let lowest = energy::lowest(world);
        self.height = self.height.max(balance.potential - lowest);
        // What hands press is pressed by motion, too; other water only stands too high.
        let can_move = if self.terms.lenient { (self.put_in.all() - lowest).max(0.0) } else { self.height };
        let overlap = OVERLAP_SPEED * f64::from(matter(world).scale.spacing);
        let (setup, plan) = (world.resource::<Setup>(), world.resource::<TickPlan>());
        let kick =
            f64::from(0.5 * setup.domain.gravity.length() * plan.substep_seconds() * setup.blueprint.scale.spacing);
        let allowed = 0.5 * balance.mass * (overlap * overlap + kick * kick) + self.terms.given_back * can_move;
        self.most_gained = self.most_gained.max(allowed);
        let speed = |energy: f64| (2.0 * energy / balance.mass).sqrt();
        self.note(Rule::Energy, self.measured(speed(gained), speed(self.most_gained)));
    }

    /// How far liquid is too dense, where nothing presses it beyond what a step can follow.
    fn density(&mut self, world: &World) {
        let (setup, rock) = (world.resource::<Setup>(), world.resource::<Rock>());
        let free = f64::from(setup.domain.size.x * setup.domain.size.y) - rock.count() as f64;
        let tick = f64::from(TICK_SECONDS);
        let is_lenient = self.terms.lenient;
        let is_still = self.terms.restless.is_ok() && !self.is_turning(world);
        let bound = if is_still && self.is_ending() { STILL_DENSITY } else { ONE_TOO_MANY };
        let why = if !self.is_plain {
            "no plain liquid"
        } else if is_lenient
            && (!world.resource::<Effects>().get(Effect::Predictor).running || !setup.quality.predictor)
        {
            "no predictor"
        } else if is_lenient && world.resource::<ParticleStore>().len() as f64 > FULL * free {
            "no room to give way"
        } else if is_lenient && energy::load(world) * tick * tick > 1.0 {
            "pressed by more than a spacing a tick²"
        } else if self.seen < self.shaken + self.terms.shock {
            "shaken to the end"
        } else {
            match DensityError::of_world(world).filter(|error| error.interior >= ENOUGH) {
                Some(error) => return self.note(Rule::Density, self.measured(error.pressed, bound)),
                None => "too little liquid",
            }
        };
        self.waive(Rule::Density, why);
    }
}

/// How often limits cut what was too fast for the substeps: such a tick is a shock.
fn cuts(world: &World) -> u64 {
    let Counters { speed_clamps, substeps_short, .. } = *world.resource::<Counters>();
    speed_clamps + substeps_short
}

/// How often lumps became other elements.
fn turns(world: &World) -> u64 {
    let books = world.resource::<Books>();
    books.reacted + books.turns.iter().flatten().map(|count| u64::from(*count)).sum::<u64>()
}

/// Whether matter of different densities is pushed as if it were equally heavy: then neither momentum nor energy is kept.
fn lets_masses_be(world: &World) -> bool {
    if world.resource::<Effects>().get(Effect::Masses).mode != Mode::Off {
        return false;
    }
    let matter = matter(world);
    let mut masses = matter.particles.element.iter().map(|element| matter.mass(*element));
    masses.next().is_some_and(|first| masses.any(|mass| mass != first))
}
