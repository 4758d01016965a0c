//! The state of a world between two ticks: what undo, reset and save files hold.

use crate::{
    kernel::{
        air::Air,
        brush::Stroke,
        element::ElementId,
        heat::{HeatRecord, units::ROOM},
        params::Preset,
        particles::Particles,
        predictor::Kept,
        sleep::SleepRecord,
        solids::Solids,
        sources::{Drain, Emitter, Rect, Wind},
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::springs::Springs,
};
use bevy::prelude::{Deref, DerefMut, Resource};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Most particles a second of an emitter, of the scene's own size: as a scene may say.
const MOST_RATE: f32 = 1e6;

/// What the scene keeps adding and taking away. Written by the source stage.
#[derive(Resource, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sources {
    /// Emitters.
    pub emitters: Vec<Emitter>,
    /// Winds.
    pub winds: Vec<Wind>,
    /// Drains.
    pub drains: Vec<Drain>,
}

impl Sources {
    /// Most emitters, and most drains, to which a player may add: each is looked at in every tick.
    pub const MOST: usize = 64;
    /// Most sites of the scene's own spacing that one of them may cover: the largest brush has 6,400. At the finest detail all of them
    /// together are as many as a save file may have.
    const MOST_SITES: f32 = 15_000.0;

    /// Adds what goes on pouring under a brush, if the element flows and it [`fits`](Self::fits).
    pub fn add_emitter(&mut self, element: ElementId, stroke: &Stroke, scene: &Blueprint) {
        let emitter = Emitter::of_brush(element, stroke, &scene.elements);
        let flows = !scene.elements.get(element).fixed;
        if flows && self.emitters.len() < Self::MOST && Self::fits(emitter.area, scene) {
            self.emitters.push(emitter);
        }
    }

    /// Adds what takes away all that moves under a brush, if it [`fits`](Self::fits).
    pub fn add_drain(&mut self, stroke: &Stroke, scene: &Blueprint) {
        let area = Rect::under(stroke);
        if self.drains.len() < Self::MOST && Self::fits(area, scene) {
            self.drains.push(Drain { area });
        }
    }

    /// Adds emitters and drains that were taken elsewhere: those that [`fit`](Self::fits), are in the box, and where none was
    /// before, as matter is pasted into free room.
    pub fn add_springs(&mut self, springs: &Springs, scene: &Blueprint) {
        let there = self.emitters.iter().map(|emitter| emitter.area).chain(self.drains.iter().map(|drain| drain.area));
        let there: Vec<Rect> = there.collect();
        let in_box = Rect { min: Vec2::ZERO, max: scene.domain.size };
        let is_free = |area: Rect| area.meets(in_box) && !there.iter().any(|other| other.meets(area));
        let fits = |area: Rect| is_free(area) && Self::fits(area, scene);
        let most_rate = MOST_RATE * scene.scale.particles_per_own();
        let flows = |id: ElementId| id.index() < scene.elements.len() && !scene.elements.get(id).fixed;
        for emitter in springs.emitters.iter().filter(|emitter| fits(emitter.area) && emitter.rate <= most_rate) {
            if flows(emitter.element) && self.emitters.len() < Self::MOST {
                self.emitters.push(Emitter { start: 0, given: 0, due: 0.0, ..emitter.clone() });
            }
        }
        for drain in springs.drains.iter().filter(|drain| fits(drain.area)) {
            if self.drains.len() < Self::MOST {
                self.drains.push(*drain);
            }
        }
    }

    /// Whether an area is small enough for one that a player adds.
    pub fn fits(area: Rect, scene: &Blueprint) -> bool {
        area.sites() <= Self::MOST_SITES * scene.scale.particles_per_own()
    }

    /// Takes away all emitters and drains that a brush touches.
    pub fn remove_under(&mut self, stroke: &Stroke) {
        let under = Rect::under(stroke);
        self.emitters.retain(|emitter| !emitter.area.meets(under));
        self.drains.retain(|drain| !drain.area.meets(under));
    }
}

/// How far the world has come.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Clock {
    /// Ticks done since the scene began.
    pub tick: u64,
    /// Edits applied since the scene began: seeds the choice of sites that pouring fills.
    pub edits: u64,
    /// The next free particle id.
    pub next_id: u32,
}

impl Clock {
    /// Ticks and edits: what a world was put through, whatever it made of it.
    pub fn seen(&self) -> (u64, u64) {
        (self.tick, self.edits)
    }
}

/// What the heat of the world was booked as. Written by the edit and heat stages.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Books(pub HeatRecord);

/// Everything in a world that a tick changes. What only an intent changes (gravity, quality, effects) is not in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Movable particles.
    pub particles: Particles,
    /// Rock.
    pub solids: Solids,
    /// The air.
    pub air: Air,
    /// What the predictor sets out from.
    pub kept: Kept,
    /// Which particles and tiles sleep, and which may soon.
    pub sleep: SleepRecord,
    /// Emitters, winds and drains with their state.
    pub sources: Sources,
    /// Tick, edits, next id.
    pub clock: Clock,
    /// What heat went where.
    pub books: Books,
}

impl Snapshot {
    /// The state in which a scene starts, with the air on cells of `air_cell` d. Air that may not be warm starts at the pressure
    /// and not the temperature that the scene gives it: so it pushes no harder than in any other quality.
    pub fn of_blueprint(blueprint: &Blueprint, air_cell: f32) -> Self {
        let mut air = Air::unbuilt(blueprint.domain.size, air_cell, blueprint.air);
        let is_off = |effect| blueprint.effects.get(&effect) == Some(&Mode::Off);
        if !blueprint.pressures.is_empty() && !is_off(Effect::Air) {
            air.build(&blueprint.solids);
            let may_be_warm = !is_off(Effect::Convection) && blueprint.preset != Preset::Classic;
            for patch in &blueprint.pressures {
                air.fill(patch.area, patch.pressure, if may_be_warm { patch.kelvin } else { ROOM });
            }
        }
        Self {
            particles: blueprint.particles.clone(),
            solids: blueprint.solids.clone(),
            air,
            kept: Kept::default(),
            sleep: SleepRecord::default(),
            sources: Sources {
                emitters: blueprint.emitters.clone(),
                winds: blueprint.winds.clone(),
                drains: blueprint.drains.clone(),
            },
            clock: Clock { tick: 0, edits: 0, next_id: blueprint.next_id },
            books: Books::default(),
        }
    }

    /// Bytes that it takes, to a good approximation.
    pub fn size_in_memory(&self) -> usize {
        let air = self.air.columns() * self.air.rows() * if self.air.is_warm() { 16 } else { 12 };
        self.particles.len() * Particles::BYTES + self.solids.memory() + air + self.kept.values().count() * 4
    }

    /// A hash over the exact bits of the state in the order of the ids (64-bit FNV-1a): equal hashes mean equal
    /// particles, rock and air.
    pub fn hash(&self) -> u64 {
        hash_state(&self.particles, &self.solids, &self.air)
    }
}

/// [`Snapshot::hash`] of the parts, without copying them.
pub fn hash_state(particles: &Particles, solids: &Solids, air: &Air) -> u64 {
    let mut hash = EMPTY;
    let mut take = |word: u32| hash = word.to_le_bytes().into_iter().fold(hash, fnv);
    for i in particles.in_id_order() {
        let values = particles.get(i as usize).values().into_iter();
        values.filter(|value| !value.is_absent()).for_each(|value| take(value.word()));
    }
    for (cell, ElementId(element), id) in solids.iter() {
        [cell.x as u32, cell.y as u32, u32::from(element), id].into_iter().for_each(&mut take);
        let heat = solids.heat(cell);
        (heat != 0).then_some(heat as u32).into_iter().for_each(&mut take);
    }
    // Air that is at rest has one hash, with a grid or without.
    let air = air.with_grid(solids);
    for row in 0..air.rows() {
        let fields = [air.pressure_row(row), air.velocity_x_row(row), air.velocity_y_row(row), air.warmth_row(row)];
        fields.into_iter().flatten().for_each(|value| take(value.to_bits()));
    }
    hash
}

/// The same hash over bytes.
pub(crate) fn hash_bytes(bytes: &[u8]) -> u64 {
    bytes.iter().copied().fold(EMPTY, fnv)
}

/// The hash of nothing.
const EMPTY: u64 = 0xcbf2_9ce4_8422_2325;

/// A hash with one more byte (FNV-1a).
fn fnv(hash: u64, byte: u8) -> u64 {
    (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
}
