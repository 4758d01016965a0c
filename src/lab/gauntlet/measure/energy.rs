//! The book of energy: what a world has, and what was put into it.
//!
//! Matter has kinetic and potential energy, air has that of motion and of pressure (`Air::pressure_energy`): with `∂u/∂t =
//! −c² ∇p` and `∂p/∂t = −∇(p u)` the sum of `½ p u² + ½ c² (p − 1)²` can only fall, in a closed box and in one that is open
//! to air at rest at pressure 1. So no matter can have more than
//!
//! - what matter and air had at the start,
//! - what edits put into both and take out of matter, measured around each edit,
//! - what emitters give: the kinetic energy of what they let in, at the highest place of their area; drains take theirs,
//! - what winds give: at most `½ p w² · rate · T` a tick over their area, the power that brings air to `w` anew all the time,
//! - what heat gives by making matter heavier or lighter where it is, and takes with what it makes air of: measured lump by lump,
//!   as that comes last in a tick,
//! - what gas gives that matter gives off: at most c² e for each part of its mass, e being the highest pressure of all air, as the
//!   head that it comes in at is no higher,
//! - what matter gives by taking gas: a cell at a pressure p that loses δ gains `c² (1 − p + ½ δ)` for each part of its mass, as the
//!   air around can rush in; as δ ≤ p, that is at most c²,
//! - what heat gives by warming air: it presses harder by `½ ρ c² p² Δτ` at most, which is what it can do as it spreads to the
//!   pressure around; with p ≤ e that is less than c² e for each part of its mass times Δτ. What the air loses of warmth
//!   meanwhile is left out,
//! - what gases gain by wandering: it moves them and is no velocity of theirs, so what it lifts nothing pays for,
//! - where the air does not yield to the particles that it drags (no feedback), what it gives them: a drag that closes a
//!   share s of the way from v to the wind w adds `½ m s (w² − v²)` at most, the square being convex.

use crate::{
    kernel::{diffusion, element::ElementId, heat::GAS_PARTS, units::TICK_SECONDS},
    lab::balance::matter,
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        stages::TickPlan,
        state::{AirGrid, Books, Clock, Elements, ParticleStore, Rock, Setup, Sources},
    },
};
use bevy::ecs::world::World;
use glam::{DVec2, Vec2};
use std::collections::{BTreeMap, BTreeSet};

/// Energy, J.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::lab::gauntlet) struct Stored {
    /// Of matter.
    matter: f64,
    /// Of air.
    pub air: f64,
}

impl Stored {
    /// What a world has.
    pub fn of(world: &World) -> Self {
        let matter = matter(world);
        let air = world.resource::<AirGrid>().with_grid(world.resource::<Rock>());
        let d = f64::from(matter.scale.spacing);
        // The unit of the air's mass is d² at pressure 1.
        let joule = f64::from(air.params().density) * d * d * d * d;
        Self { matter: matter.balance().energy(), air: joule * (air.kinetic_energy() + air.pressure_energy()) }
    }

    /// Notes what an edit put in, and what it took out of matter. What it takes out of the air stays in the book: where sound
    /// was slowed ([`AirReport`](crate::kernel::air::AirReport)) the air has less than its pressure says.
    pub fn edited(&mut self, before: Self, after: Self) {
        self.matter += after.matter - before.matter;
        self.air += (after.air - before.air).max(0.0);
    }

    /// Notes what a tick put in.
    pub fn add(&mut self, put_in: f64) {
        self.matter += put_in;
    }

    /// All of it.
    pub fn all(self) -> f64 {
        self.matter + self.air
    }
}

/// What is known before a tick of what the tick may put in.
#[derive(Clone, Debug)]
pub(in crate::lab::gauntlet) struct Due {
    /// Energy of what drains take, J.
    drained: f64,
    /// What each emitter gave so far.
    given: Vec<u32>,
    /// Energy that winds give at the pressures before the tick, J.
    winds: f64,
    /// Fastest wind, d/s.
    wind: f64,
    /// Masses (kg) and speeds (m/s) of the particles, with their rates of drag (1/d).
    dragged: Vec<[f64; 3]>,
    /// Gas that matter gave off so far, in its parts.
    gas: i64,
    /// Warmth of the air, d² at pressure 1 and 293 K.
    warmth: f64,
    /// Whether touch, time or heat may change what matter is made of.
    may_change: bool,
    /// Element and energy (J) of the particles that no drain takes, by their ids.
    kinds: BTreeMap<u32, (ElementId, f64)>,
    /// The first id that is free.
    next: u32,
}

impl Due {
    /// Looks at a world whose next tick begins.
    pub fn of(world: &World) -> Self {
        let matter = matter(world);
        let (sources, rates) = (world.resource::<Sources>(), &world.resource::<Elements>().0.drag);
        let d = f64::from(matter.scale.spacing);
        let particles = matter.particles;
        let mass = |i: usize| matter.mass(particles.element[i]);
        let speed = |i: usize| particles.velocity(i).as_dvec2().length() * d;
        let height = |i: usize| -matter.gravity(particles.element[i]).dot(particles.position(i).as_dvec2() * d);
        let energy = |i: usize| mass(i) * (0.5 * speed(i) * speed(i) + height(i));
        let drains = |i: &usize| sources.drains.iter().any(|drain| drain.area.contains(particles.position(*i)));
        let rate = |i: usize| f64::from(rates[particles.element[i].index()]);
        Self {
            drained: (0..particles.len()).filter(drains).map(energy).sum(),
            given: sources.emitters.iter().map(|emitter| emitter.given).collect(),
            winds: winds(world),
            wind: fastest_wind(world),
            dragged: (0..particles.len()).map(|i| [mass(i), speed(i), rate(i)]).collect(),
            gas: world.resource::<Books>().gas,
            warmth: world.resource::<AirGrid>().held_warmth(),
            may_change: may_change(world),
            kinds: match may_change(world) {
                true => {
                    let stay = (0..particles.len()).filter(|i| !drains(i));
                    stay.map(|i| (particles.id[i], (particles.element[i], energy(i)))).collect()
                }
                false => BTreeMap::new(),
            },
            next: world.resource::<Clock>().next_id,
        }
    }

    /// The most that the tick put in, J, now that it is over.
    pub fn put_in(self, world: &World) -> f64 {
        let winds = self.winds.max(winds(world));
        self.emitted(world) - self.drained
            + winds
            + self.dragged(world)
            + self.changed(world)
            + self.expanded(world)
            + wandered(world)
    }

    /// The most that gas gave which matter gave off or took, and air that it warmed.
    fn expanded(&self, world: &World) -> f64 {
        let air = world.resource::<AirGrid>();
        let given = (world.resource::<Books>().gas - self.gas) as f64 / GAS_PARTS;
        let warmed = (air.held_warmth() - self.warmth).max(0.0);
        if given == 0.0 && warmed == 0.0 {
            return 0.0;
        }
        let d = f64::from(matter(world).scale.spacing);
        let cells = (0..air.rows()).flat_map(|row| (0..air.columns()).map(move |column| (column, row)));
        let most = cells.map(|(column, row)| air.pressing_at_cell(column, row)).fold(1.0, f32::max);
        let speed = f64::from(air.params().sound_speed);
        let of_unit = speed * speed * f64::from(air.params().density) * d * d * d * d;
        of_unit * ((given.max(0.0) + warmed) * f64::from(most) + (-given).max(0.0))
    }

    /// What heat gave.
    fn changed(&self, world: &World) -> f64 {
        if !self.may_change {
            return 0.0;
        }
        let matter = matter(world);
        let (particles, d) = (matter.particles, f64::from(matter.scale.spacing));
        let energy = |i: usize, element: ElementId| {
            let (at, velocity) = (particles.position(i).as_dvec2() * d, particles.velocity(i).as_dvec2() * d);
            matter.mass(element) * (0.5 * velocity.length_squared() - matter.gravity(element).dot(at))
        };
        let (mut given, mut there) = (0.0, BTreeSet::new());
        for i in (0..particles.len()).filter(|i| particles.id[*i] < self.next) {
            let (id, now) = (particles.id[i], particles.element[i]);
            there.insert(id);
            given += match self.kinds.get(&id) {
                Some((before, _)) if *before == now => 0.0,
                Some((before, _)) => energy(i, now) - energy(i, *before),
                // Rock that melted.
                None => energy(i, now),
            };
        }
        let gone = self.kinds.iter().filter(|(id, _)| !there.contains(id));
        given - gone.map(|(_, (_, energy))| energy).sum::<f64>()
    }

    fn emitted(&self, world: &World) -> f64 {
        let matter = matter(world);
        let d = f64::from(matter.scale.spacing);
        let emitters = world.resource::<Sources>().emitters.iter().zip(&self.given);
        emitters
            .map(|(emitter, before)| {
                let (mass, gravity) = (matter.mass(emitter.element), matter.gravity(emitter.element));
                let speed = emitter.velocity.as_dvec2().length() * d;
                let far = |gravity: f64, low: f32, high: f32| f64::from(if gravity > 0.0 { low } else { high });
                let highest = DVec2::new(
                    far(gravity.x, emitter.area.min.x, emitter.area.max.x),
                    far(gravity.y, emitter.area.min.y, emitter.area.max.y),
                ) * d;
                f64::from(emitter.given - before) * mass * (0.5 * speed * speed - gravity.dot(highest))
            })
            .sum()
    }

    fn dragged(&self, world: &World) -> f64 {
        let (effects, plan) = (world.resource::<Effects>(), world.resource::<TickPlan>());
        if !effects.get(Effect::Drag).running || effects.acts(Effect::AirFeedback) {
            return 0.0;
        }
        let d = f64::from(matter(world).scale.spacing);
        let wind = self.wind.max(fastest_wind(world)) * d;
        let (dt, substeps) = (f64::from(plan.substep_seconds()), f64::from(plan.substeps));
        let given = |[mass, speed, rate]: &[f64; 3]| {
            let closed = rate / d * (wind + speed) * dt;
            0.5 * mass * closed / (1.0 + closed) * (wind * wind - speed * speed).max(0.0)
        };
        substeps * self.dragged.iter().map(given).sum::<f64>()
    }
}

/// The most that the gases' wandering lifted in the tick that is over, J.
fn wandered(world: &World) -> f64 {
    if !world.resource::<Effects>().get(Effect::Diffusion).running {
        return 0.0;
    }
    let (matter, spreads) = (matter(world), &world.resource::<Elements>().0.diffusion);
    let (particles, tick) = (matter.particles, world.resource::<Clock>().tick - 1);
    let seconds = f64::from(TICK_SECONDS) * f64::from(matter.scale.spacing);
    let lifted = particles.element.iter().zip(&particles.id).filter(|(element, _)| spreads[element.index()] > 0.0).map(
        |(element, id)| {
            let way = diffusion::velocity(spreads[element.index()], *id, tick).as_dvec2() * seconds;
            (-matter.mass(*element) * matter.gravity(*element).dot(way)).max(0.0)
        },
    );
    lifted.sum()
}

/// Whether touch, time or heat may change what matter is made of, or warm air lift it: heat also in the tick in which the first
/// that is warm comes.
fn may_change(world: &World) -> bool {
    let effects = world.resource::<Effects>();
    let is_wanted = |effect: Effect| effects.get(effect).mode != Mode::Off;
    is_wanted(Effect::Reactions)
        || is_wanted(Effect::Decay)
        || is_wanted(Effect::Heat)
            && (world.resource::<ParticleStore>().has_heat()
                || world.resource::<AirGrid>().is_warm()
                || !world.resource::<Rock>().heats().is_empty()
                || !world.resource::<Sources>().emitters.is_empty())
}

/// The most that the scene's winds can give in a tick, J.
fn winds(world: &World) -> f64 {
    let sources = world.resource::<Sources>();
    if sources.winds.is_empty() {
        return 0.0;
    }
    let air = world.resource::<AirGrid>();
    let d = f64::from(matter(world).scale.spacing);
    let (cell, joule) = (f64::from(air.cell()), f64::from(air.params().density) * d * d * d * d);
    let mut sum = 0.0;
    for wind in &sources.winds {
        let power = 0.5 * f64::from(wind.velocity.length_squared()) * f64::from(wind.rate);
        for row in 0..air.rows() {
            for (column, pressure) in air.pressure_row(row).iter().enumerate() {
                let at = Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * air.cell();
                // A cell that the area only touches may be driven, too.
                let near = at.cmpge(wind.area.min - air.cell()).all() && at.cmple(wind.area.max + air.cell()).all();
                sum += if near { power * f64::from(*pressure) * cell * cell } else { 0.0 };
            }
        }
    }
    sum * joule * f64::from(TICK_SECONDS)
}

/// The fastest wind in the box, d/s.
fn fastest_wind(world: &World) -> f64 {
    std::f64::consts::SQRT_2 * f64::from(world.resource::<AirGrid>().max_speed())
}

/// Energy of all matter of a world if it lay in the lowest corner of the box (gases: in the highest), J: what is above that can
/// become motion.
pub(in crate::lab::gauntlet) fn lowest(world: &World) -> f64 {
    let matter = matter(world);
    let corner = |gravity: f64, size: f32| if gravity > 0.0 { f64::from(size * matter.scale.spacing) } else { 0.0 };
    let size = matter.domain.size;
    let of = |id: ElementId| {
        let gravity = matter.gravity(id);
        -matter.mass(id) * gravity.dot(DVec2::new(corner(gravity.x, size.x), corner(gravity.y, size.y)))
    };
    let of: Vec<f64> = matter.elements.iter().map(|(id, _)| of(id)).collect();
    matter.particles.element.iter().map(|element| of[element.index()]).sum()
}

/// Largest acceleration of matter by gravity and wind, d/s².
pub(in crate::lab::gauntlet) fn load(world: &World) -> f64 {
    let gravity = f64::from(world.resource::<Setup>().domain.gravity.length());
    let particles = &world.resource::<ParticleStore>().0;
    let drags = world.resource::<Effects>().get(Effect::Drag).running && !particles.is_empty();
    let rates = &world.resource::<Elements>().0.drag;
    let of = particles.element.iter().map(|element| rates[element.index()]);
    let rate = of.filter(|rate| rate.is_finite()).fold(0.0, f32::max);
    let wind = if drags { fastest_wind(world) } else { 0.0 };
    gravity + f64::from(rate) * wind * wind
}
