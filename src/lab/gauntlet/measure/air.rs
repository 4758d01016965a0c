//! The mass of air that is shut in.

use crate::{
    kernel::heat::GAS_PARTS,
    lab::gauntlet::rule::AIR_ROUNDINGS,
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        state::{AirGrid, Books, Clock, Counters, Rock},
    },
};
use bevy::ecs::world::World;

/// Most by which the mass of air that is shut in may differ from what it was, as a share of it: 2⁻²⁰.
const MOST_DRIFT: f64 = AIR_ROUNDINGS / (1 << 24) as f64;

/// What is made of the mass of air in a world.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::lab::gauntlet) struct AirMass {
    /// Share of the mass that ticks made, each of what there was before it: edits change no share.
    drift: f64,
    /// How often hands changed the air or rock, or it was switched on: from then on its mass is kept anew.
    begun: u32,
    /// Whether it was off.
    was_off: bool,
    /// Whether it had a grid.
    was_built: bool,
}

impl AirMass {
    /// Of a world before its first tick or after any. Air that has moved before may be off by as much the other way already.
    pub fn of(world: &World) -> Self {
        let is_built = world.resource::<AirGrid>().is_built();
        Self { begun: u32::from(world.resource::<Clock>().tick > 0), was_built: is_built, ..Self::default() }
    }

    /// Notes a tick before which the world held this. Air that is switched off stands, and is brought to rest at
    /// the pressure around: what that makes is the hand's that switched it. Air without a grid is at the pressure around
    /// wherever there is no rock: rock that melts makes room for some, as rock that is taken away does, also in the tick in
    /// which its heat calls for the grid.
    pub fn ticked(&mut self, before: Held, world: &World) {
        let is_off = world.resource::<Effects>().get(Effect::Air).mode == Mode::Off;
        self.begun += u32::from(self.was_off && !is_off);
        self.was_off = is_off;
        let Held { mass, gas, rock } = Held::of(world);
        let changed = rock != before.rock;
        self.begun += u32::from(changed);
        // Gas is rounded where it comes in.
        self.begun += u32::from(gas != before.gas);
        let is_built = world.resource::<AirGrid>().is_built();
        let was_built = std::mem::replace(&mut self.was_built, is_built);
        if before.mass == 0.0 || is_off || !is_built || (changed && !was_built) {
            return;
        }
        self.drift += (mass - (gas - before.gas) as f64 / GAS_PARTS) / before.mass - 1.0;
    }

    /// Notes that hands changed the air.
    pub fn edited(&mut self) {
        self.begun += 1;
    }

    /// The most that the drift may be by now.
    pub fn most(&self) -> f64 {
        MOST_DRIFT * f64::from(1 + self.begun)
    }

    /// The share that ticks made of it so far.
    pub fn drift(&self) -> f64 {
        self.drift.abs()
    }
}

/// The air of a world.
#[derive(Clone, Copy, Debug)]
pub(in crate::lab::gauntlet) struct Held {
    /// Mass, with what rock buried of it, d² at pressure 1.
    mass: f64,
    /// Gas that matter gave off so far, in its parts.
    gas: i64,
    /// The rock's version.
    rock: u64,
}

impl Held {
    /// What a world has, of whose air there may be no grid yet.
    pub fn of(world: &World) -> Self {
        let mass = world.resource::<AirGrid>().with_grid(world.resource::<Rock>()).mass();
        let buried = world.resource::<Counters>().air_buried;
        Self { mass: mass + buried, gas: world.resource::<Books>().gas, rock: world.resource::<Rock>().version() }
    }
}
