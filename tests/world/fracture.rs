//! Walls that break under the pressure of the air, in a world.

use super::burning::{energy, room};
use crate::support::{Furnish, SimulationExt, assert_goes_on_from_a_save, assert_same_bits_everywhere};
use glam::{IVec2, Vec2};
use powder_master::{
    kernel::{heat::units::ROOM, sources::Rect},
    scene::{
        blueprint::{Blueprint, PressurePatch},
        effects::{Effect, Mode},
    },
    sim::{
        effects::Effects,
        simulation::Simulation,
        state::{AirGrid, Rock},
    },
};

/// Overpressure that a wall of wood of 0.4 m bears, Pa.
const BEARS: f32 = 4e4;

/// A vault of metal with a door of wood, and air of an overpressure (Pa) in it.
fn vault(overpressure: f32) -> Blueprint {
    let mut start = room(160, 64);
    let (metal, wood) = (start.element("metal"), start.element("wood"));
    let shell = |cell: &IVec2| cell.y >= 20 || cell.x < 4 || cell.x >= 32;
    let cells = (0..24).flat_map(|y| (0..36).map(move |x| IVec2::new(x, y)));
    for cell in cells.filter(shell) {
        let is_door = cell.x >= 32 && (4..20).contains(&cell.y);
        start.solids.insert(cell, if is_door { wood } else { metal }, start.next_id);
        start.next_id += 1;
    }
    let stiffness = start.air.stiffness(start.scale);
    let area = Rect { min: Vec2::new(4.0, 0.0), max: Vec2::new(32.0, 20.0) };
    let pressure = (1.0 + 2.0 * overpressure / stiffness).sqrt();
    start.pressures.push(PressurePatch { area, pressure, kelvin: ROOM });
    start
}

/// Lowest pressure in the vault.
fn within(simulation: &Simulation) -> f32 {
    let air = simulation.get::<AirGrid>();
    (1..8).flat_map(|column| (0..5).map(move |row| air.pressure_at_cell(column, row))).fold(f32::MAX, f32::min)
}

#[test]
fn a_door_holds_what_it_bears_and_flies_open_beyond() {
    for (share, mode, breaks) in [(0.98, Mode::Auto, false), (1.02, Mode::Auto, true), (1.02, Mode::Off, false)] {
        let mut start = vault(share * BEARS);
        start.effects.insert(Effect::Fracture, mode);
        let mut simulation = Simulation::of(start);
        let (rock, pressure) = (simulation.get::<Rock>().count(), within(&simulation));
        let heat = energy(&simulation);
        simulation.run(60);
        let chips = simulation.count("chips");
        assert_eq!(chips, if breaks { 64 } else { 0 }, "{share} of what it bears, {mode:?}");
        assert_eq!(simulation.get::<Rock>().count(), rock - chips);
        // It holds the air, too, to the rounding of 16 sums.
        assert_eq!((within(&simulation) / pressure - 1.0).abs() > 1e-6, breaks, "{share}, {mode:?}");
        let furthest = simulation.particles().x.iter().copied().fold(0.0, f32::max);
        // 4 × 10⁴ Pa on 280 kg/m²: it is gone in a tenth of a second.
        assert!(!breaks || furthest > 60.0, "thrown to {furthest} d");
        assert_eq!(energy(&simulation), heat);
        assert_eq!(simulation.get::<Effects>().get(Effect::Fracture).active_ticks > 0, mode == Mode::Auto);
    }
}

#[test]
fn a_burst_is_the_same_on_any_threads_with_it_on_and_from_a_save() {
    let mut start = vault(1.5 * BEARS);
    let sand = start.element("sand");
    // Enough to be shared among threads.
    for (x, y) in (60..160).flat_map(|x| (0..62).map(move |y| (x, y))) {
        start.particles.push(start.next_id, sand, Vec2::new(x as f32 + 0.5, y as f32 + 0.5), Vec2::ZERO);
        start.next_id += 1;
    }
    assert_same_bits_everywhere(&start, 20);
    let mut forced = start.clone();
    forced.effects.insert(Effect::Fracture, Mode::On);
    let [mut simulation, mut forced] = [start, forced].map(Simulation::of);
    for _ in 0..20 {
        assert_eq!(simulation.run(1).hash(), forced.run(1).hash());
    }
    assert!(simulation.count("chips") > 0);
    assert_goes_on_from_a_save(&mut simulation, 20);
}
