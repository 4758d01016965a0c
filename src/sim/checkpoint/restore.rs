//! A world between two ticks: taken, and put back.

use crate::{
    kernel::{
        heat::table::HeatTable,
        params::{Preset, Quality},
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{
        control,
        effects::Effects,
        generation::Generation,
        ledger::PassLedger,
        snapshot::Snapshot,
        state::{Counters, Elements, HeatCurves, Recipes, Setup},
    },
};
use bevy::prelude::World;
use std::sync::Arc;

/// A world between two ticks. A clone shares the scene and the state.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// Scene, gravity and quality.
    pub setup: Setup,
    /// The wanted effects.
    pub modes: EffectModes,
    /// Everything that a tick changes.
    pub state: Arc<Snapshot>,
}

impl Checkpoint {
    /// The world as it is.
    pub fn of(world: &World) -> Self {
        Self {
            setup: world.resource::<Setup>().clone(),
            modes: world.resource::<Effects>().modes(),
            state: Arc::new(control::freeze(world)),
        }
    }

    /// The start of a scene.
    pub fn of_scene(blueprint: Arc<Blueprint>) -> Self {
        let state = Arc::new(Snapshot::of_blueprint(&blueprint, blueprint.quality.air_cell));
        Self {
            modes: blueprint.effects.clone(),
            setup: Setup {
                preset: blueprint.preset,
                quality: blueprint.quality,
                origin: state.clone(),
                domain: blueprint.domain,
                opened: blueprint.clone(),
                blueprint,
            },
            state,
        }
    }

    /// Makes `world` what it was. What was counted goes on if it is the same scene that is played on, as after an undo, and
    /// begins anew with another. Waiting intents are forgotten.
    pub fn restore(&self, world: &mut World) {
        let blueprint = &self.setup.blueprint;
        let known = world.get_resource::<Setup>().is_some_and(|setup| Arc::ptr_eq(&setup.origin, &self.setup.origin));
        world.insert_resource(Elements::of(blueprint));
        world.insert_resource(HeatCurves(HeatTable::new(&blueprint.elements)));
        world.insert_resource(Recipes::of(blueprint));
        if known {
            world.resource_mut::<Effects>().set_modes(&self.modes);
        } else {
            Generation::count_scene(world);
            world.insert_resource(Effects::new(&self.modes));
            world.insert_resource(Counters::default());
            world.insert_resource(PassLedger::default());
        }
        world.insert_resource(self.setup.clone());
        control::thaw(world, &self.state);
    }

    /// The same world, to go on at another quality. To a preset of another detail it is resampled.
    ///
    /// # Errors
    /// If it does not fit the detail: one line that says why, and what is allowed.
    pub fn at_quality(mut self, preset: Preset, quality: Quality) -> Result<Self, String> {
        if preset.detail() != self.setup.preset.detail() {
            let asked = self.setup.asked_detail();
            self = self.resampled(asked, preset)?;
        }
        (self.setup.preset, self.setup.quality) = (preset, quality);
        Ok(self)
    }

    /// The same world, to go on at another quality and another detail, beside which the preset has its own. It is resampled
    /// once, straight to what both come to, and not at all where that is the detail that it has: on a way by a coarser
    /// world matter and walls would get lost.
    ///
    /// # Errors
    /// If it does not fit the detail: one line that says why, and what is allowed.
    pub fn at(mut self, preset: Preset, quality: Quality, detail: f64) -> Result<Self, String> {
        let setup = self.setup.at_detail(detail, preset)?;
        let [to, from] = [&setup, &self.setup].map(|setup| f64::from(setup.blueprint.scale.detail));
        if (to / from - 1.0).abs() > 1e-6 {
            self = self.resampled(detail, preset)?;
        }
        (self.setup.preset, self.setup.quality) = (preset, quality);
        Ok(self)
    }

    /// The same world at another detail, beside which a preset has its own.
    ///
    /// # Errors
    /// If it does not fit the detail: one line that says why, and what is allowed.
    pub fn at_detail(self, detail: f64) -> Result<Self, String> {
        let preset = self.setup.preset;
        self.resampled(detail, preset)
    }

    fn resampled(self, detail: f64, preset: Preset) -> Result<Self, String> {
        let setup = self.setup.at_detail(detail, preset)?;
        let state = self.state.resampled(&self.setup.blueprint, &setup.blueprint, self.state.air.cell())?;
        Ok(Self { setup, state: Arc::new(state), ..self })
    }

    /// Bytes that it takes, to a good approximation, without what it shares with others: the scene and its start.
    pub fn bytes(&self) -> usize {
        self.state.size_in_memory()
    }

    /// Whether air may move here.
    pub fn has_air(&self) -> bool {
        self.mode(Effect::Air) != Mode::Off
    }

    /// Whether nothing but gravity acts from outside: no emitters, drains or winds, and no air that pushes. Then the energy
    /// of the particles can't grow.
    pub fn is_closed(&self) -> bool {
        let sources = &self.state.sources;
        let fed = !sources.emitters.is_empty() || !sources.drains.is_empty() || !sources.winds.is_empty();
        !fed && (!self.has_air() || self.mode(Effect::Drag) == Mode::Off)
    }

    /// Whether nothing is here that could move, and nothing will come.
    pub fn is_idle(&self) -> bool {
        let Snapshot { particles, air, sources, .. } = &*self.state;
        let still = air.is_quiet() || !self.has_air();
        particles.is_empty() && still && sources.emitters.is_empty() && sources.winds.is_empty()
    }

    fn mode(&self, effect: Effect) -> Mode {
        self.modes.get(&effect).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::simd::InstructionSet,
        scene,
        sim::{simulation::Simulation, workers::Workers},
    };

    #[test]
    fn a_simulation_from_a_checkpoint_goes_the_way_of_the_first_to_the_bit() {
        let settings = [("flow".to_owned(), "900".to_owned())];
        let modes = EffectModes::from([(Effect::Vorticity, Mode::Off), (Effect::Sleep, Mode::Off)]);
        let blueprint = scene::load("waterfall").unwrap().build(&settings, None, &modes).unwrap();
        let mut first = Simulation::new(Arc::new(blueprint), Workers::default());
        first.run(30);
        let checkpoint = Checkpoint::of(first.world());
        let again = Simulation::resume(&checkpoint, Workers::single());
        let mut again = again.with_instructions(InstructionSet::detect());
        assert_eq!(again.hash(), first.hash(), "the copy differs");
        assert_eq!(again.get::<Effects>().modes(), first.get::<Effects>().modes());
        first.run(30);
        again.run(30);
        assert_eq!(again.hash(), first.hash(), "it went another way");
    }

    #[test]
    fn only_what_gravity_alone_drives_is_closed() {
        let of = |name: &str| {
            let blueprint = scene::load(name).unwrap().build(&[], None, &EffectModes::new()).unwrap();
            Checkpoint::of_scene(Arc::new(blueprint))
        };
        assert!(of("dam_break").is_closed() && !of("dam_break").has_air());
        assert!(!of("rest_density").is_closed(), "an emitter lifts water in");
        assert!(!of("waterfall").is_closed() && of("waterfall").has_air());
        assert!(!of("sealed_air").is_closed(), "its air pushes drops");
    }
}
