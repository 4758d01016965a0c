//! The A/B split: a second world beside the one that is played, from the same state on at a quality of its own. Both
//! take the same input in the same tick, so that all that differs between them is what the qualities make of it.
//!
//! What the qualities made of it so far stays in the worlds. So where a quality is chosen for the second world, or both
//! come to have the same, it starts again from the first: a difference always grows from a moment in which there was none,
//! and at equal qualities there is none.

use crate::{
    kernel::params::{Preset, Quality},
    lab::live::accuracy::LiveError,
    scene::passes::Pass,
    sim::{
        checkpoint::Checkpoint,
        effects::Effects,
        generation::Generation,
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        pace::Pace,
        script,
        simulation::Simulation,
        state::{Clock, Setup, SolverState},
        workers::Workers,
    },
};
use bevy::prelude::{App, FixedUpdate, IntoScheduleConfigs, Mut, Res, Resource, World};
use std::time::Duration;

/// The second world, while there is one.
#[derive(Resource, Default)]
pub struct Split {
    second: Option<Second>,
}

/// The second world.
struct Second {
    simulation: Simulation,
    /// Tick in which it was the same as the first, and which world that was.
    since: u64,
    generation: Generation,
    /// Whether the first has had its quality since then.
    equal: bool,
}

impl Second {
    /// A world that goes on from the state of `first` at a quality of its own.
    fn new(first: &World, preset: Preset, quality: Quality) -> Result<Self, String> {
        let checkpoint = Checkpoint::of(first).at_quality(preset, quality)?;
        let simulation = Simulation::resume(&checkpoint, first.resource::<Workers>().clone());
        let mut simulation = simulation.with_instructions(first.resource::<SolverState>().instructions);
        simulation.world_mut().init_resource::<LiveError>();
        let (since, generation) = (first.resource::<Clock>().tick, Generation::of(first));
        let mut second = Self { simulation, since, generation, equal: false };
        second.equal = second.is_like(first);
        Ok(second)
    }

    /// Whether both are of the same quality and detail.
    fn is_like(&self, first: &World) -> bool {
        let (own, first) = (self.setup(), first.resource::<Setup>());
        (own.quality, own.blueprint.scale) == (first.quality, first.blueprint.scale)
    }

    fn setup(&self) -> &Setup {
        self.simulation.world().resource()
    }

    /// Both worlds are the same again, but for the quality; none if the first does not fit its detail.
    fn start_again(&self, first: &World) -> Option<Self> {
        let Setup { preset, quality, .. } = *self.setup();
        Self::new(first, preset, quality).ok()
    }
}

impl Split {
    /// Puts a second world beside `world`, from its state on; in the place of the one that is there, if one is.
    ///
    /// # Errors
    /// If it does not fit the preset's detail: one line that says why, and what is allowed.
    pub fn begin(world: &mut World, preset: Preset, quality: Quality) -> Result<(), String> {
        let second = Second::new(world, preset, quality)?;
        world.resource_mut::<Self>().second = Some(second);
        Ok(())
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
        self.second.as_ref().map(|second| second.simulation.world())
    }

    /// The second world, to change between ticks.
    pub fn world_mut(&mut self) -> Option<&mut World> {
        self.second.as_mut().map(|second| second.simulation.world_mut())
    }

    /// Name and numbers of its quality.
    pub fn quality(&self) -> Option<(Preset, Quality)> {
        self.second.as_ref().map(|second| (second.setup().preset, second.setup().quality))
    }

    /// Ticks since both were the same, of the first world's, which has done `tick`.
    pub fn age(&self, tick: u64) -> Option<u64> {
        self.second.as_ref().map(|second| tick.saturating_sub(second.since))
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
            copy_input.after(script::run).before(Pass::Edit).run_if(is_on),
            tick_second_world.after(Pass::Measure).run_if(is_on),
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
        // After a reset, an undo or another scene.
        if let Some(second) = &split.second
            && Generation::of(world) != second.generation
        {
            split.second = second.start_again(world);
        }
        let Some(second) = split.second.as_mut() else { return };
        let own = Intent::Quality { preset: second.setup().preset, quality: second.setup().quality };
        // A change of the first one's quality is an edit to be counted, no more: edits choose the sites of pouring.
        let input: Vec<Intent> = world.resource::<IntentQueue>().iter().cloned().collect();
        let is_quality = |intent: &Intent| matches!(intent, Intent::Quality { .. });
        // Even there and back leaves traces: air that was carried over to other cells and back is not what it was.
        second.equal &= !input.iter().any(is_quality);
        // Both have the detail that is asked for, and beside it their presets' own: lengths are in d of the first.
        let (mut preset, own_preset) = (world.resource::<Setup>().preset, second.setup().preset);
        let simulation = second.simulation.world_mut();
        let mut queue = simulation.resource_mut::<IntentQueue>();
        for intent in input {
            if let Intent::Quality { preset: next, .. } = intent {
                preset = next;
                queue.push(own.clone());
            } else {
                queue.push(intent.scaled((own_preset.detail() / preset.detail()) as f32));
            }
        }
        *simulation.resource_mut::<Pace>() = *world.resource::<Pace>();
        simulation.resource_mut::<Effects>().set_modes(&world.resource::<Effects>().modes());
    });
}

/// Brings the second world as far as the first one went.
fn tick_second_world(world: &mut World) {
    world.resource_scope(|world, mut split: Mut<Split>| {
        let Some(second) = split.second.as_mut() else { return };
        let equal = second.is_like(world);
        if equal && !second.equal {
            split.second = second.start_again(world);
        } else {
            second.equal = equal;
            second.simulation.tick();
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::brush::{BrushShape, Stroke},
        lab::difference::{Difference, Half},
        scene::{self, effects::EffectModes},
        sim::{control, simulation::Simulation, state::ParticleStore},
    };
    use glam::Vec2;
    use std::sync::Arc;

    /// A waterfall that has run for a while, with a second world at `preset`.
    fn split(preset: Preset) -> Simulation {
        let blueprint = scene::load("waterfall").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        let mut simulation =
            Simulation::with_plugins(&Checkpoint::of_scene(Arc::new(blueprint)), Workers::default(), plugin);
        (0..40).for_each(|_| simulation.tick());
        Split::begin(simulation.world_mut(), preset, preset.quality()).unwrap();
        simulation
    }

    fn push(simulation: &mut Simulation, intent: Intent) {
        simulation.world_mut().resource_mut::<IntentQueue>().push(intent);
    }

    fn play(simulation: &mut Simulation) {
        let middle = simulation.world().resource::<Setup>().blueprint.domain.size / 2.0;
        let water = simulation.world().resource::<Setup>().elements().find("water").unwrap();
        for k in 0..30 {
            let stroke = Stroke::dab(BrushShape::Disc, middle + Vec2::new(k as f32, 0.0), 4.0);
            push(simulation, Intent::Draw { element: water, stroke });
            push(simulation, Intent::Blow { stroke, velocity: Vec2::new(80.0, 20.0) });
            simulation.tick();
        }
    }

    fn hashes(simulation: &Simulation) -> (u64, u64) {
        let second = simulation.world().resource::<Split>().world().expect("it is on");
        (control::hash(simulation.world()), control::hash(second))
    }

    fn difference(simulation: &Simulation) -> Difference {
        let mut difference = Difference::default();
        let (first, second) = (simulation.world(), simulation.world().resource::<Split>().world().expect("it is on"));
        difference.measure(&first.resource::<Setup>().blueprint, Half::of(first), Half::of(second));
        difference
    }

    /// Sets the first world's quality.
    fn set(simulation: &mut Simulation, preset: Preset) {
        push(simulation, Intent::Quality { preset, quality: preset.quality() });
    }

    fn assert_equal(simulation: &Simulation) {
        let (first, second) = hashes(simulation);
        let shown = difference(simulation);
        assert_eq!(first, second);
        assert!(shown.is_nothing(), "equal worlds differ by {:?} and {:?}", shown.liquid(), shown.wind());
        assert!(shown.wind().is_some() && shown.columns() * shown.rows() > 100, "there must be a field to compare");
    }

    #[test]
    fn two_equal_settings_show_exactly_nothing() {
        let mut simulation = split(Preset::Balanced);
        play(&mut simulation);
        assert_equal(&simulation);
        // There and back in a tick: to other iterations, and through air on other cells.
        for other in [Preset::Classic, Preset::Fine] {
            set(&mut simulation, other);
            set(&mut simulation, Preset::Balanced);
            play(&mut simulation);
            assert_equal(&simulation);
        }
    }

    #[test]
    fn qualities_that_become_equal_show_nothing_from_then_on() {
        assert_eq!(Preset::Classic.quality().air_cell, Preset::Balanced.quality().air_cell);
        for other in [Preset::Classic, Preset::Draft] {
            let mut simulation = split(other);
            play(&mut simulation);
            assert!(!difference(&simulation).is_nothing(), "there must be a difference to forget");
            set(&mut simulation, other);
            simulation.tick();
            assert_equal(&simulation);
            play(&mut simulation);
            assert_equal(&simulation);
            let tick = simulation.world().resource::<Clock>().tick;
            assert_eq!(simulation.world().resource::<Split>().age(tick), Some(30));
        }
    }

    #[test]
    fn a_quality_that_is_chosen_for_the_second_world_starts_it_from_the_first() {
        let mut simulation = split(Preset::Draft);
        play(&mut simulation);
        let begin = |simulation: &mut Simulation, preset: Preset| {
            Split::begin(simulation.world_mut(), preset, preset.quality()).unwrap();
        };
        begin(&mut simulation, Preset::Balanced);
        assert_equal(&simulation);
        play(&mut simulation);
        assert_equal(&simulation);
        begin(&mut simulation, Preset::Classic);
        assert_equal(&simulation);
        play(&mut simulation);
        assert!(!difference(&simulation).is_nothing());
    }

    #[test]
    fn worlds_of_two_details_take_the_same_input_in_metres() {
        let mut simulation = split(Preset::Balanced);
        Split::begin(simulation.world_mut(), Preset::Reference, Preset::Reference.quality()).unwrap();
        let apart = difference(&simulation).liquid().expect("water is there");
        // Nothing but where the pieces of a particle lie: half a particle in a cell of 16, at a surface.
        assert!(apart < 0.03, "the same moment differs by {apart}");
        let areas = |simulation: &Simulation| {
            let second = simulation.world().resource::<Split>().world().expect("it is on");
            [simulation.world(), second].map(|world| {
                let d = f64::from(world.resource::<Setup>().blueprint.scale.spacing);
                world.resource::<ParticleStore>().len() as f64 * d * d
            })
        };
        let before = areas(&simulation);
        let middle = simulation.world().resource::<Setup>().blueprint.domain.size / 2.0;
        let water = simulation.world().resource::<Setup>().elements().find("water").unwrap();
        let stroke = Stroke::dab(BrushShape::Disc, middle + Vec2::new(60.0, 40.0), 12.0);
        push(&mut simulation, Intent::Stamp { element: water, stroke });
        simulation.tick();
        let [first, second] = [0, 1].map(|k| areas(&simulation)[k] - before[k]);
        // A disc of 24 d: sites at its edge, and what the spring gave in the tick.
        assert!(first > 2.0 && (second / first - 1.0).abs() < 0.05, "{first} m² and {second} m²");
        push(&mut simulation, Intent::Detail { detail: 0.5 });
        simulation.tick();
        let details = |world: &World| world.resource::<Setup>().blueprint.scale.detail;
        let other = details(simulation.world().resource::<Split>().world().expect("it is on"));
        assert_eq!((details(simulation.world()), other), (0.5, 1.0), "each goes to half of its own");
    }

    #[test]
    fn airs_that_went_other_ways_are_a_difference_without_liquid() {
        let blueprint = scene::load("sealed_air").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        let mut simulation =
            Simulation::with_plugins(&Checkpoint::of_scene(Arc::new(blueprint)), Workers::default(), plugin);
        Split::begin(simulation.world_mut(), Preset::Draft, Preset::Draft.quality()).unwrap();
        (0..20).for_each(|_| simulation.tick());
        let shown = difference(&simulation);
        assert!(!shown.is_nothing() && shown.wind().is_some_and(|wind| wind > 0.0), "{:?}", shown.wind());
    }

    #[test]
    fn other_settings_show_a_difference_and_the_first_world_does_not_feel_it() {
        let mut simulation = split(Preset::Draft);
        play(&mut simulation);
        let (first, second) = hashes(&simulation);
        assert_ne!(first, second);
        assert!(!difference(&simulation).is_nothing() && difference(&simulation).liquid() > Some(0.0));
        let mut alone = split(Preset::Draft);
        alone.world_mut().resource_mut::<Split>().end();
        play(&mut alone);
        assert_eq!(control::hash(alone.world()), first, "the second world changes the first");
        assert!(alone.world().resource::<Split>().world().is_none());
    }

    #[test]
    fn what_goes_back_in_the_first_world_starts_both_anew() {
        let mut simulation = split(Preset::Fine);
        let before = control::freeze(simulation.world());
        play(&mut simulation);
        control::thaw(simulation.world_mut(), &before);
        simulation.tick();
        let second = simulation.world().resource::<Split>();
        assert_eq!(second.quality(), Some((Preset::Fine, Preset::Fine.quality())), "it keeps its quality");
        let ticks = |world: &World| world.resource::<Clock>().seen();
        assert_eq!(ticks(second.world().unwrap()), ticks(simulation.world()));
        control::reset(simulation.world_mut());
        simulation.tick();
        let second = simulation.world().resource::<Split>().world().unwrap();
        assert_eq!(ticks(second), ticks(simulation.world()));
    }

    #[test]
    fn both_stand_while_time_stands_and_take_edits() {
        let mut simulation = split(Preset::Balanced);
        simulation.world_mut().resource_mut::<Pace>().paused = true;
        let ticks = simulation.world().resource::<Clock>().tick;
        play(&mut simulation);
        simulation.world_mut().resource_mut::<Pace>().steps_due = 1;
        (0..3).for_each(|_| simulation.tick());
        let second = simulation.world().resource::<Split>().world().unwrap();
        assert_eq!(second.resource::<Clock>().tick, ticks + 1);
        let (first, second) = hashes(&simulation);
        assert_eq!(first, second);
    }
}
