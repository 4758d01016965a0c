//! Powders: heaps that stand, sleep and wake, in air and under water.

use crate::support::{Furnish, SimulationExt, assert_goes_on_from_a_save, assert_same_bits_everywhere, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::params::Preset,
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{
        effects::Effects,
        simulation::Simulation,
        state::{Apart, SleepState},
    },
};

/// A column of sand, `width` × `height` in the middle of a box five times as wide.
fn column(width: i32, height: i32) -> Blueprint {
    let mut blueprint = empty_box(5 * width as u32, height as u32 + 20);
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.effects.extend([Effect::Air, Effect::Drag].map(|effect| (effect, Mode::Off)));
    let sand = blueprint.element("sand");
    blueprint.pool((2 * width, 0), (3 * width, height));
    blueprint.particles.element.fill(sand);
    blueprint
}

/// Height of the heap, d: the mean of the highest grains of its middle.
fn height(simulation: &Simulation) -> f32 {
    let particles = simulation.particles();
    let middle = particles.x.iter().sum::<f32>() / particles.len() as f32;
    let near = (0..particles.len()).filter(|i| (particles.x[*i] - middle).abs() < 4.0);
    let mut heights: Vec<f32> = near.map(|i| particles.y[i]).collect();
    heights.sort_by(f32::total_cmp);
    heights.iter().rev().take(4).sum::<f32>() / 4.0
}

#[test]
fn a_column_becomes_a_heap_that_stands_and_sleeps_at_every_quality() {
    for preset in Preset::ALL.into_iter().filter(|preset| preset.quality().predictor) {
        let mut blueprint = column(24, 24);
        (blueprint.preset, blueprint.quality) = (preset, preset.quality());
        blueprint.effects.insert(Effect::Sleep, Mode::On);
        let mut simulation = Simulation::of(blueprint);
        simulation.run(600);
        let early = height(&simulation);
        // Each half is a column of aspect 2, of which a^⅓ of its length stays: 15.1 d. A liquid would stand at 4.8 d.
        assert!((12.0..19.0).contains(&early), "{preset:?}: {early} d");
        simulation.run(1200);
        let late = height(&simulation);
        assert!((late - early).abs() < 0.5, "{preset:?}: from {early} to {late} d in 20 s");
        let asleep = simulation.get::<SleepState>().asleep();
        assert_eq!(asleep, simulation.particles().len(), "{preset:?}: awake after 30 s");
    }
}

#[test]
fn a_heap_that_is_woken_keeps_its_place() {
    let mut blueprint = column(24, 24);
    blueprint.effects.insert(Effect::Sleep, Mode::On);
    let mut simulation = Simulation::of(blueprint);
    simulation.run(1200);
    let before = simulation.particles().clone();
    assert_eq!(simulation.get::<SleepState>().asleep(), before.len());
    // Without sleep it is simulated again.
    simulation.get_mut::<Effects>().get_mut(Effect::Sleep).mode = Mode::Off;
    simulation.run(120);
    assert_eq!(simulation.get::<SleepState>().asleep(), 0);
    let after = simulation.particles();
    let mut places: Vec<(u32, Vec2)> = (0..after.len()).map(|i| (after.id[i], after.position(i))).collect();
    places.sort_by_key(|(id, _)| *id);
    let ways = (0..before.len()).map(|i| {
        let at = places.binary_search_by_key(&before.id[i], |(id, _)| *id).expect("a grain is gone");
        places[at].1.distance(before.position(i))
    });
    let mean = ways.sum::<f32>() / before.len() as f32;
    assert!(mean < 0.02, "{mean} d on the mean in 2 s");
}

#[test]
fn without_friction_sand_lies_flat() {
    let mut blueprint = column(24, 24);
    blueprint.effects.insert(Effect::Friction, Mode::Off);
    let mut simulation = Simulation::of(blueprint);
    simulation.run(1200);
    assert!(height(&simulation) < 7.0, "{} d", height(&simulation));
    assert!(!simulation.get::<Apart>().grains);
}

#[test]
fn friction_is_only_looked_at_where_grains_are() {
    let mut blueprint = column(24, 24);
    let water = blueprint.element("water");
    blueprint.particles.element.fill(water);
    let mut automatic = Simulation::of(blueprint.clone());
    automatic.run(60);
    assert!(!automatic.get::<Apart>().grains, "there are none");
    blueprint.effects.insert(Effect::Friction, Mode::On);
    assert_eq!(Simulation::of(blueprint).run(60).hash(), automatic.hash(), "`on` is another world than `auto`");
}

/// A block of sand, a fifth as wide as the box, that falls into water.
fn sand_into_water(width: i32, depth: i32) -> Blueprint {
    let mut blueprint = empty_box(width as u32, 2 * depth as u32);
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.effects.extend([Effect::Air, Effect::Drag].map(|effect| (effect, Mode::Off)));
    let sand = blueprint.element("sand");
    blueprint.pool((0, 0), (width, depth));
    let water = blueprint.particles.len();
    blueprint.pool((2 * width / 5, depth + 5), (3 * width / 5, depth + 30));
    blueprint.particles.element[water..].fill(sand);
    blueprint
}

#[test]
fn sand_sinks_in_water_and_piles_up_under_it() {
    let blueprint = sand_into_water(100, 40);
    let (sand, count) = (blueprint.element("sand"), blueprint.particles.len());
    let mut simulation = Simulation::of(blueprint);
    simulation.run(1200);
    let particles = simulation.particles();
    assert_eq!(particles.len(), count, "particles are missing");
    let grains: Vec<Vec2> =
        (0..count).filter(|i| particles.element[*i] == sand).map(|i| particles.position(i)).collect();
    let mean = grains.iter().map(|at| at.y).sum::<f32>() / grains.len() as f32;
    let mut heights: Vec<f32> = grains.iter().map(|at| at.y).collect();
    heights.sort_by(f32::total_cmp);
    // One in fifty may still be on its way.
    let highest = heights[heights.len() * 49 / 50];
    // 500 grains over all of the floor would be 5 d deep with their middle at 2.5 d.
    assert!((2.5..8.0).contains(&mean), "its middle stands at {mean} d");
    assert!(highest > 8.0 && highest < 25.0, "its top stands at {highest} d");
}

#[test]
fn grains_have_the_same_bits_on_every_instruction_set_and_number_of_threads() {
    // Wide enough for the passes over the grid to be shared, too: they are from 4,096 cells on.
    let mut blueprint = sand_into_water(400, 60);
    blueprint.effects.insert(Effect::Sleep, Mode::Off);
    assert_same_bits_everywhere(&blueprint, 30);
}

#[test]
fn a_saved_heap_goes_on_to_the_bit() {
    for ticks in [30, 200] {
        let mut simulation = Simulation::of(sand_into_water(100, 40));
        simulation.run(ticks);
        assert_goes_on_from_a_save(&mut simulation, 60);
    }
}
