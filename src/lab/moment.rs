//! A moment of a world, from which any number of runs can set out, each at a quality of its own.

use crate::{
    kernel::params::{Domain, Preset, Quality},
    lab::headless::Headless,
    scene::{
        blueprint::Blueprint,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{
        control,
        effects::Effects,
        save,
        snapshot::{Snapshot, hash_bytes},
        state::Setup,
        workers::Workers,
    },
};
use bevy::ecs::world::World;
use std::sync::Arc;

/// A world between two ticks.
#[derive(Clone, Debug)]
pub struct Moment {
    blueprint: Arc<Blueprint>,
    domain: Domain,
    snapshot: Snapshot,
    effects: EffectModes,
    fingerprint: u64,
}

impl Moment {
    /// The world as it is.
    pub fn of(world: &World) -> Self {
        let Setup { blueprint, domain, .. } = world.resource::<Setup>();
        Self {
            blueprint: blueprint.clone(),
            domain: *domain,
            snapshot: control::freeze(world),
            effects: world.resource::<Effects>().modes(),
            fingerprint: hash_bytes(&save::encode(world)),
        }
    }

    /// The scene that it is a moment of.
    pub fn blueprint(&self) -> &Blueprint {
        &self.blueprint
    }

    /// The state.
    pub fn snapshot(&self) -> &Snapshot {
        &self.snapshot
    }

    /// A hash over everything that decides how it goes on, but for quality and program.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Whether air may move here.
    pub fn has_air(&self) -> bool {
        self.mode(Effect::Air) != Mode::Off
    }

    /// Whether nothing but gravity acts from outside: no taps, outlets or fans, and no air that pushes. Then the energy
    /// of the particles can't grow.
    pub fn is_closed(&self) -> bool {
        let sources = &self.snapshot.sources;
        let fed = !sources.emitters.is_empty() || !sources.drains.is_empty() || !sources.winds.is_empty();
        !fed && (!self.has_air() || self.mode(Effect::Drag) == Mode::Off)
    }

    /// Whether nothing is here that could move, and nothing will come.
    pub fn is_idle(&self) -> bool {
        let Snapshot { particles, air, sources, .. } = &self.snapshot;
        let still = air.is_quiet() || !self.has_air();
        particles.is_empty() && still && sources.emitters.is_empty() && sources.winds.is_empty()
    }

    fn mode(&self, effect: Effect) -> Mode {
        self.effects.get(&effect).copied().unwrap_or_default()
    }

    /// A world that goes on from here at a quality, for `workers` to run.
    pub fn go_on(&self, preset: Preset, quality: Quality, workers: Workers) -> Headless {
        Headless::begin(workers, |world| {
            control::load(world, self.blueprint.clone());
            world.resource_mut::<Setup>().domain = self.domain;
            control::set_quality(world, preset, quality);
            control::thaw(world, &self.snapshot);
            let mut effects = world.resource_mut::<Effects>();
            for (effect, mode) in &self.effects {
                effects.get_mut(*effect).mode = *mode;
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    #[test]
    fn a_run_that_sets_out_from_a_moment_is_the_run_that_went_on() {
        let settings = [("flow".to_owned(), "900".to_owned())];
        let modes = EffectModes::from([(Effect::Vorticity, Mode::Off), (Effect::Sleep, Mode::Off)]);
        let blueprint = scene::load("waterfall").unwrap().build(&settings, None, &modes).unwrap();
        let mut headless = Headless::new(Arc::new(blueprint), Workers::default());
        for _ in 0..10 {
            headless.tick();
        }
        let moment = Moment::of(headless.world());
        let setup = headless.world().resource::<Setup>();
        let mut again = moment.go_on(setup.preset, setup.quality, Workers::default());
        assert_eq!(control::hash(again.world()), control::hash(headless.world()));
        for _ in 0..5 {
            headless.tick();
            again.tick();
        }
        assert_eq!(control::hash(again.world()), control::hash(headless.world()));
        assert_eq!(Moment::of(again.world()).fingerprint(), Moment::of(headless.world()).fingerprint());
        assert_ne!(Moment::of(again.world()).fingerprint(), moment.fingerprint());
    }

    #[test]
    fn only_what_gravity_alone_drives_is_closed() {
        let of = |name: &str| {
            let blueprint = scene::load(name).unwrap().build(&[], None, &EffectModes::new()).unwrap();
            Moment::of(Headless::new(Arc::new(blueprint), Workers::default()).world())
        };
        assert!(of("dam_break").is_closed() && !of("dam_break").has_air());
        assert!(!of("rest_density").is_closed(), "a tap lifts water in");
        assert!(!of("waterfall").is_closed() && of("waterfall").has_air());
        assert!(!of("sealed_air").is_closed(), "its air pushes drops");
    }
}
