//! Liquids that lie on one another.

use crate::support::{Furnish, SimulationExt, assert_same_bits_everywhere, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{element::ElementId, params::Preset},
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{
        effects::Effects,
        simulation::Simulation,
        state::{MassShares, SleepState},
    },
};

/// Two liquids, `depth` rows of each in a box `width` wide, the first one below.
fn layers(names: [&str; 2], width: i32, depth: i32) -> Blueprint {
    let mut blueprint = empty_box(width as u32, 3 * depth as u32);
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.effects.extend([Effect::Air, Effect::Drag].map(|effect| (effect, Mode::Off)));
    let elements = names.map(|name| blueprint.element(name));
    blueprint.pool((0, 0), (width, 2 * depth));
    for i in 0..blueprint.particles.len() {
        let is_upper = blueprint.particles.y[i] > depth as f32;
        blueprint.particles.element[i] = elements[usize::from(is_upper)];
    }
    blueprint
}

/// Mean height of the particles of an element, d.
fn height(simulation: &Simulation, element: ElementId) -> f64 {
    let particles = simulation.particles();
    let own = (0..particles.len()).filter(|i| particles.element[*i] == element);
    let heights: Vec<f64> = own.map(|i| f64::from(particles.y[i])).collect();
    heights.iter().sum::<f64>() / heights.len() as f64
}

#[test]
fn heavy_liquids_come_to_lie_under_light_ones_and_rest_there() {
    for (names, ticks) in [(["oil", "mercury"], 900), (["water", "brine"], 2400), (["oil", "honey"], 2400)] {
        let blueprint = layers(names, 24, 10);
        let [light, heavy] = names.map(|name| blueprint.element(name));
        let count = blueprint.particles.len();
        let mut simulation = Simulation::of(blueprint);
        simulation.run(ticks);
        assert_eq!(simulation.particles().len(), count, "{names:?}: particles are missing");
        // Half of the box each: the middles of the layers stand at 5 and at 15 d.
        let (low, high) = (height(&simulation, heavy), height(&simulation, light));
        assert!((low - 5.0).abs() < 0.5 && (high - 15.0).abs() < 0.5, "{names:?} stand at {high} and {low} d");
    }
}

#[test]
fn layers_in_their_order_rest_at_every_quality_and_sleep() {
    for preset in Preset::ALL.into_iter().filter(|preset| preset.quality().predictor) {
        for names in [["mercury", "oil"], ["water", "oil"], ["honey", "water"]] {
            let mut blueprint = layers(names, 20, 10);
            (blueprint.preset, blueprint.quality) = (preset, preset.quality());
            blueprint.effects.insert(Effect::Sleep, Mode::Off);
            let mut simulation = Simulation::of(blueprint.clone());
            // A pixel in three frames, as for water.
            let rms = simulation.run(240).rms_speed();
            assert!(rms < 0.02, "{names:?} at {preset:?}: {rms} d a tick");
            blueprint.effects.insert(Effect::Sleep, Mode::On);
            let mut sleeping = Simulation::of(blueprint);
            sleeping.run(240);
            let asleep = sleeping.get::<SleepState>().asleep();
            assert_eq!(asleep, sleeping.particles().len(), "{names:?} at {preset:?} are awake");
        }
    }
}

#[test]
fn a_heavy_layer_over_a_light_one_does_not_sleep() {
    let mut simulation = Simulation::of(layers(["water", "brine"], 20, 10));
    for _ in 0..20 {
        simulation.run(10);
        assert_eq!(simulation.get::<SleepState>().asleep(), 0, "what is not at rest sleeps");
    }
}

#[test]
fn layers_have_the_same_bits_on_every_instruction_set_and_number_of_threads() {
    assert_same_bits_everywhere(&layers(["oil", "mercury"], 60, 55), 60);
}

#[test]
fn masses_are_only_looked_at_where_they_differ() {
    let runs = |simulation: &Simulation| simulation.get::<Effects>().get(Effect::Masses).running;
    let mut alike = Simulation::of(layers(["oil", "oil"], 20, 10));
    alike.run(60);
    assert!(!runs(&alike) && alike.get::<MassShares>().get().is_none(), "one liquid has one mass");
    // What a liquid weighs is nothing to it where there is no other.
    let mut water = Simulation::of(layers(["water", "water"], 20, 10));
    water.run(60);
    assert!(alike.particles().x == water.particles().x && alike.particles().y == water.particles().y);
    let mut forced = layers(["oil", "oil"], 20, 10);
    forced.effects.insert(Effect::Masses, Mode::On);
    assert_eq!(Simulation::of(forced).run(60).hash(), alike.hash(), "`on` is another world than `auto`");
    let mut differ = Simulation::of(layers(["water", "oil"], 20, 10));
    differ.run(60);
    assert!(runs(&differ), "two liquids have two masses");
}
