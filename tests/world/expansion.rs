//! Gas that matter gives off, in a world: how much, what it throws, and that it can be left out.

use super::burning::{energy, room, stamp};
use crate::support::{Furnish, SimulationExt, assert_goes_on_from_a_save, assert_same_bits_everywhere, blueprint};
use glam::{IVec2, Vec2};
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        heat::{GAS_PARTS, table::HeatTable, units::ROOM},
        sources::Rect,
    },
    scene::{
        blueprint::PressurePatch,
        effects::{Effect, Mode},
    },
    sim::{
        effects::Effects,
        intent::Intent,
        simulation::Simulation,
        state::{AirGrid, Books, Rock},
    },
};

/// Gas that a lump of gunpowder holds, d².
const POWDER: f64 = 30.0;

/// A barrel of metal, 20 × 40 d inside, in a high box, with `powder` rows of gunpowder and `stone` rows of stone in it.
fn barrel(powder: u32, stone: u32, mode: Mode) -> Simulation {
    let mut start = room(60, 240);
    start.effects.insert(Effect::Expansion, mode);
    let mut simulation = Simulation::of(start);
    stamp(&mut simulation, "metal", [16.0, 0.0], [20.0, 40.0]);
    stamp(&mut simulation, "metal", [40.0, 0.0], [44.0, 40.0]);
    let (top, full) = (powder as f32, (powder + stone) as f32);
    stamp(&mut simulation, "gunpowder", [20.0, 0.0], [40.0, top]);
    stamp(&mut simulation, "stone", [20.0, top], [40.0, full]);
    simulation
}

fn ignite(simulation: &mut Simulation, at: Vec2) {
    simulation.push(Intent::Ignite { stroke: Stroke::dab(BrushShape::Disc, at, 3.0) }).apply_edits();
}

/// Gas that the air got so far, d².
fn given(simulation: &Simulation) -> f64 {
    simulation.get::<Books>().gas as f64 / GAS_PARTS
}

/// Highest stone, d.
fn highest(simulation: &Simulation) -> f32 {
    let (particles, stone) = (simulation.particles(), simulation.element("stone"));
    let stones = particles.y.iter().zip(&particles.element).filter(|(_, element)| **element == stone);
    stones.map(|(y, _)| *y).fold(0.0, f32::max)
}

#[test]
fn gunpowder_that_is_shut_in_gives_the_air_its_gas_and_no_energy_is_made() {
    let mut simulation = Simulation::of(room(64, 48));
    stamp(&mut simulation, "gunpowder", [24.0, 0.0], [40.0, 4.0]);
    let (before, mass) = (energy(&simulation), simulation.get::<AirGrid>().mass());
    ignite(&mut simulation, Vec2::new(32.0, 2.0));
    simulation.run(600);
    let burnt = 64 - simulation.count("gunpowder");
    assert!(burnt > 48, "{burnt} of 64 burnt");
    assert!((given(&simulation) - POWDER * burnt as f64).abs() < 1e-3);
    let more = simulation.get::<AirGrid>().mass() - mass;
    assert!((more / given(&simulation) - 1.0).abs() < 1e-3, "{more} d² more of {}", given(&simulation));
    assert_eq!(energy(&simulation), before);
}

#[test]
fn a_shot_throws_what_lies_on_the_powder_unless_it_is_off() {
    let shoot = |mode| {
        let mut simulation = barrel(6, 6, mode);
        ignite(&mut simulation, Vec2::new(30.0, 1.0));
        let mut most = 0.0_f32;
        for _ in 0..120 {
            most = most.max(highest(simulation.run(1)));
        }
        (most, simulation.count("fire") + simulation.count("smoke"), given(&simulation))
    };
    let (thrown, burnt, gas) = shoot(Mode::Auto);
    assert!(thrown > 60.0 && gas > 0.0, "thrown {thrown} d high");
    // The gas alone throws: what expands of the heat stays within the barrel.
    let (thrown, burnt_without, gas) = shoot(Mode::Off);
    assert!(thrown < 40.0 && gas == 0.0, "thrown {thrown} d high");
    assert!(burnt > 20 && burnt_without > 20, "{burnt} and {burnt_without} burnt");
}

/// 5 %: what the faces let through is 2 %, and the gas behind thins by 1 % in three ticks.
#[test]
fn a_plug_is_shot_as_the_pressure_behind_it_has_it() {
    let mut start = room(60, 240);
    start.domain.gravity = Vec2::ZERO;
    // Nothing that burns calls for it, and grains rub on the barrel.
    start.effects.extend([(Effect::Expansion, Mode::On), (Effect::Friction, Mode::Off)]);
    let area = Rect { min: Vec2::new(20.0, 0.0), max: Vec2::new(40.0, 40.0) };
    start.pressures.push(PressurePatch { area, pressure: 8.0, kelvin: ROOM });
    let (metal, stone) = (start.element("metal"), start.element("stone"));
    for cell in (0..200).flat_map(|y| (16..20).chain(40..44).map(move |x| IVec2::new(x, y))) {
        start.solids.insert(cell, metal, start.next_id);
        start.next_id += 1;
    }
    for (x, y) in (20..40).flat_map(|x| (40..60).map(move |y| (x, y))) {
        start.particles.push(start.next_id, stone, Vec2::new(x as f32 + 0.5, y as f32 + 0.5), Vec2::ZERO);
        start.next_id += 1;
    }
    let mut simulation = Simulation::of(start);
    simulation.run(3);
    let vy = &simulation.particles().vy;
    let speed = vy.iter().sum::<f32>() / vy.len() as f32 * 0.1;
    // P = ρ c² ½ (p² − 1) on 2 m of stone, for three ticks.
    let expected = 1.2 * 40.0 * 40.0 * 0.5 * (8.0 * 8.0 - 1.0) / (2700.0 * 2.0) * 3.0 / 60.0;
    assert!((speed / expected - 1.0).abs() < 0.05, "{speed} m/s, not {expected}");
}

#[test]
fn water_that_boils_and_condenses_takes_back_what_it_gave() {
    let mut simulation = Simulation::of(room(48, 48));
    stamp(&mut simulation, "water", [0.0, 0.0], [48.0, 6.0]);
    // Stripe by stripe: what condenses in one place at once is more than the air there has.
    let reach = |simulation: &mut Simulation, kelvin: f32, element: &str| {
        for tick in 0..600 {
            let left = 2.0 * (tick % 24) as f32;
            let stroke = Stroke::rectangle(Vec2::new(left, 0.0), Vec2::new(left + 2.0, 48.0));
            simulation.push(Intent::SetTemperature { stroke, kelvin }).run(1);
            if simulation.count(element) == 288 {
                return;
            }
        }
        panic!("{} are {element} at {kelvin} K", simulation.count(element));
    };
    reach(&mut simulation, 450.0, "steam");
    assert!((given(&simulation) - 12.0 * 288.0).abs() < 1e-3, "{}", given(&simulation));
    reach(&mut simulation, 300.0, "water");
    assert!(given(&simulation).abs() < 1e-2, "{} d² are left", given(&simulation));
}

#[test]
fn an_explosion_is_the_same_on_any_threads_and_goes_on_from_a_save() {
    let mut start = room(120, 120);
    let (powder, sand) = (start.element("gunpowder"), start.element("sand"));
    let hot = HeatTable::new(&start.elements).curve(powder).heat(900.0);
    for (x, y) in (0..120).flat_map(|x| (0..52).map(move |y| (x, y))) {
        let (element, heat) = match (x, y) {
            (60..64, 4..8) => (powder, hot),
            (50..74, 0..20) => (powder, 0),
            _ => (sand, 0),
        };
        let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
        start.particles.push_warm(start.next_id, element, at, Vec2::ZERO, heat);
        start.next_id += 1;
    }
    assert_same_bits_everywhere(&start, 24);
    let mut simulation = Simulation::of(start);
    simulation.run(12);
    assert!(given(&simulation) > 0.0);
    assert_goes_on_from_a_save(&mut simulation, 12);
}

#[test]
fn nothing_of_it_runs_without_heat_or_with_the_air_off() {
    let mut simulation = Simulation::of(blueprint("waterfall", &[]));
    simulation.run(120);
    assert_eq!(simulation.get::<Effects>().get(Effect::Expansion).active_ticks, 0);
    let run = |mode| {
        let mut still = blueprint("volcano", &[]);
        still.effects.extend([(Effect::Air, Mode::Off), (Effect::Expansion, mode)]);
        let mut simulation = Simulation::of(still);
        simulation.run(240);
        assert!(simulation.count("steam") > 0);
        assert_eq!(given(&simulation), 0.0);
        assert!(!simulation.get::<Rock>().heats().is_empty());
        (simulation.get::<Effects>().get(Effect::Expansion).active_ticks, simulation.hash())
    };
    let (ticks, left) = run(Mode::Auto);
    assert_eq!(ticks, 0);
    assert_eq!(run(Mode::On), (240, left), "gas goes into air that is switched off");
}
