//! The A/B split: a second world beside the one that is played, from the same state on at a quality of its own. Both
//! take the same input in the same tick, so that all that differs between them is what the qualities make of it.

use crate::{
    kernel::params::{Preset, Quality},
    sim::{
        accuracy::LiveError,
        effects::Effects,
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        pace::Pace,
        schedule::TickSystems,
        state::{Clock, Setup},
        twin::{Seed, Twin},
        workers::Workers,
    },
};
use bevy::prelude::{App, FixedUpdate, IntoScheduleConfigs, Mut, Res, ResMut, Resource, World};
use std::{sync::Arc, time::Duration};

/// The second world, while there is one.
#[derive(Resource, Default)]
pub struct Split {
    second: Option<Twin>,
}

impl Split {
    /// Puts a second world beside `world`, from its state on.
    pub fn begin(world: &mut World, preset: Preset, quality: Quality) {
        let seed = Seed::of(world);
        let mut twin = Twin::new(&seed, world.resource::<Workers>().clone());
        twin.world_mut().init_resource::<LiveError>();
        twin.set_quality(preset, quality);
        world.resource_mut::<Self>().second = Some(twin);
    }

    /// Lets the second world go.
    pub fn end(&mut self) {
        self.second = None;
    }

    /// Whether there is a second world.
    pub fn is_on(&self) -> bool {
        self.second.is_some()
    }

    /// The second world.
    pub fn world(&self) -> Option<&World> {
        self.second.as_ref().map(Twin::world)
    }

    /// The second world, to change between ticks.
    pub fn world_mut(&mut self) -> Option<&mut World> {
        self.second.as_mut().map(Twin::world_mut)
    }

    /// Name and numbers of its quality.
    pub fn quality(&self) -> Option<(Preset, Quality)> {
        self.world().map(|world| world.resource::<Setup>()).map(|setup| (setup.preset, setup.quality))
    }

    /// Goes on with the second world at another quality.
    pub fn set_quality(&mut self, preset: Preset, quality: Quality) {
        if let Some(twin) = &mut self.second {
            twin.set_quality(preset, quality);
        }
    }

    /// What a tick of the second world takes: median over the last ticks; nothing without one.
    pub fn tick_time(&self) -> Duration {
        self.world().map_or(Duration::ZERO, |world| world.resource::<PassLedger>().tick().median())
    }
}

/// Adds the split to a simulation.
pub fn plugin(app: &mut App) {
    app.init_resource::<Split>().add_systems(
        FixedUpdate,
        (
            copy_input.after(TickSystems::Script).before(TickSystems::Edit).run_if(is_on),
            tick_second_world.after(TickSystems::Measure).run_if(is_on),
        ),
    );
}

/// Run condition: there is a second world.
pub fn is_on(split: Res<Split>) -> bool {
    split.is_on()
}

/// Gives the second world what the first is about to take.
fn copy_input(world: &mut World) {
    world.resource_scope(|world, mut split: Mut<Split>| {
        let Some(second) = split.second.as_mut() else { return };
        if !are_in_step(world, second.world()) {
            start_again(world, second);
        }
        let own = second.world().resource::<Setup>();
        let own = Intent::Quality { preset: own.preset, quality: own.quality };
        // A change of the first one's quality is an edit to be counted, no more: edits choose the sites of pouring.
        let input: Vec<Intent> = world.resource::<IntentQueue>().iter().copied().collect();
        let mut queue = second.world_mut().resource_mut::<IntentQueue>();
        for intent in input {
            queue.push(if matches!(intent, Intent::Quality { .. }) { own } else { intent });
        }
        *second.world_mut().resource_mut::<Pace>() = *world.resource::<Pace>();
        second.world_mut().resource_mut::<Effects>().take_modes(world.resource::<Effects>());
    });
}

/// Whether the worlds have seen the same: not after a reset, an undo or another scene.
fn are_in_step(first: &World, second: &World) -> bool {
    let same_scene = Arc::ptr_eq(&first.resource::<Setup>().blueprint, &second.resource::<Setup>().blueprint);
    let seen = |world: &World| world.resource::<Clock>().seen();
    same_scene && seen(first) == seen(second)
}

/// Both worlds are the same again; the second keeps its quality.
fn start_again(world: &World, second: &mut Twin) {
    let setup = second.world().resource::<Setup>();
    let (preset, quality) = (setup.preset, setup.quality);
    *second = Twin::new(&Seed::of(world), world.resource::<Workers>().clone());
    second.world_mut().init_resource::<LiveError>();
    second.set_quality(preset, quality);
}

/// Runs the second world as far as the first one went.
fn tick_second_world(mut split: ResMut<Split>) {
    if let Some(second) = &mut split.second {
        second.tick();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::brush::{BrushShape, Stroke},
        lab::headless::Headless,
        scene::{self, blueprint::EffectModes},
        sim::{control, difference::Difference, state::ParticleStore},
    };
    use glam::Vec2;

    /// A waterfall that has run for a while, with a second world at `preset`.
    fn split(preset: Preset) -> Headless {
        let blueprint = scene::load("waterfall").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        let mut headless = Headless::begin_with(Workers::default(), plugin, |world| {
            control::load(world, Arc::new(blueprint));
        });
        (0..40).for_each(|_| headless.tick());
        Split::begin(headless.world_mut(), preset, preset.quality());
        headless
    }

    fn push(headless: &mut Headless, intent: Intent) {
        headless.world_mut().resource_mut::<IntentQueue>().push(intent);
    }

    fn play(headless: &mut Headless) {
        let middle = headless.world().resource::<Setup>().blueprint.domain.size / 2.0;
        let water = headless.world().resource::<Setup>().elements().find("water").unwrap();
        for k in 0..30 {
            let stroke = Stroke::dab(BrushShape::Disc, middle + Vec2::new(k as f32, 0.0), 4.0);
            push(headless, Intent::Draw { element: water, stroke });
            push(headless, Intent::Blow { stroke, velocity: Vec2::new(80.0, 20.0) });
            headless.tick();
        }
    }

    fn hashes(headless: &Headless) -> (u64, u64) {
        let second = headless.world().resource::<Split>().world().expect("it is on");
        (control::hash(headless.world()), control::hash(second))
    }

    fn difference(headless: &Headless) -> Difference {
        let mut difference = Difference::default();
        let (first, second) = (headless.world(), headless.world().resource::<Split>().world().expect("it is on"));
        let particles = |world: &World| world.resource::<ParticleStore>().0.clone();
        difference.measure(&first.resource::<Setup>().blueprint, &particles(first), &particles(second));
        difference
    }

    #[test]
    fn two_equal_settings_show_exactly_nothing() {
        let mut headless = split(Preset::Balanced);
        play(&mut headless);
        // A change of the first one's quality and back is an edit to both.
        for preset in [Preset::Fine, Preset::Balanced] {
            push(&mut headless, Intent::Quality { preset, quality: preset.quality() });
        }
        play(&mut headless);
        let (first, second) = hashes(&headless);
        let shown = difference(&headless);
        assert!(shown.columns() * shown.rows() > 100, "there must be a field to compare");
        if Preset::Fine.quality().air_cell == Preset::Balanced.quality().air_cell {
            assert_eq!(first, second);
            assert!(shown.is_nothing(), "equal worlds differ by {}", shown.mean());
        }
        let mut headless = split(Preset::Balanced);
        play(&mut headless);
        let (first, second) = hashes(&headless);
        assert_eq!(first, second);
        assert!(difference(&headless).is_nothing());
    }

    #[test]
    fn other_settings_show_a_difference_and_the_first_world_does_not_feel_it() {
        let mut headless = split(Preset::Draft);
        play(&mut headless);
        let (first, second) = hashes(&headless);
        assert_ne!(first, second);
        assert!(!difference(&headless).is_nothing() && difference(&headless).mean() > 0.0);
        let mut alone = split(Preset::Draft);
        alone.world_mut().resource_mut::<Split>().end();
        play(&mut alone);
        assert_eq!(control::hash(alone.world()), first, "the second world changes the first");
        assert!(alone.world().resource::<Split>().world().is_none());
    }

    #[test]
    fn what_goes_back_in_the_first_world_starts_both_anew() {
        let mut headless = split(Preset::Fine);
        let before = control::freeze(headless.world());
        play(&mut headless);
        control::thaw(headless.world_mut(), &before);
        headless.tick();
        let second = headless.world().resource::<Split>();
        assert_eq!(second.quality(), Some((Preset::Fine, Preset::Fine.quality())), "it keeps its quality");
        let ticks = |world: &World| world.resource::<Clock>().seen();
        assert_eq!(ticks(second.world().unwrap()), ticks(headless.world()));
        control::reset(headless.world_mut());
        headless.tick();
        let second = headless.world().resource::<Split>().world().unwrap();
        assert_eq!(ticks(second), ticks(headless.world()));
    }

    #[test]
    fn both_stand_while_time_stands_and_take_edits() {
        let mut headless = split(Preset::Balanced);
        headless.world_mut().resource_mut::<Pace>().paused = true;
        let ticks = headless.world().resource::<Clock>().tick;
        play(&mut headless);
        headless.world_mut().resource_mut::<Pace>().steps_due = 1;
        (0..3).for_each(|_| headless.tick());
        let second = headless.world().resource::<Split>().world().unwrap();
        assert_eq!(second.resource::<Clock>().tick, ticks + 1);
        let (first, second) = hashes(&headless);
        assert_eq!(first, second);
    }
}
