//! A monkey at the mouse, in every built-in scene: whatever it does, the world stays sound.

use crate::support::{ROCK, Random, SimulationExt, WATER};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
        solids::Solids,
    },
    scene,
    sim::{
        intent::Intent,
        simulation::Simulation,
        state::{AirGrid, Books, Setup},
    },
};

/// Anything that a player's tools can make, sensible or not.
pub fn whim(random: &mut Random, size: Vec2) -> Intent {
    let shape = [BrushShape::Disc, BrushShape::Square, BrushShape::Rectangle][random.index(3)];
    // Now and then from outside the box.
    let mut point = || random.point(size * 1.2) - size * 0.1;
    let (from, to) = (point(), point());
    let to = if shape == BrushShape::Rectangle { from + (to - from) * 0.15 } else { from + (to - from) * 0.3 };
    let stroke = Stroke { shape, from, to, radius: random.within(0.0, 5.0) };
    let element = if random.index(4) == 0 { ROCK } else { WATER };
    match random.index(15) {
        0..=4 => Intent::Draw { element, stroke },
        5 => Intent::Stamp { element, stroke },
        6 | 7 => Intent::Erase { stroke },
        8 | 9 => Intent::Blow { stroke, velocity: (random.point(Vec2::ONE) - 0.5) * random.within(0.0, 2000.0) },
        10 => Intent::Press { stroke, amount: random.within(-2.0, 5.0) },
        11 => Intent::SetEmitter { element, stroke },
        12 => Intent::SetDrain { stroke },
        13 => Intent::RemoveSources { stroke },
        _ if random.index(8) == 0 => Intent::ClearAir,
        _ => Intent::Draw { element: WATER, stroke: Stroke { radius: 0.0, ..stroke } },
    }
}

/// Runs a tick, and looks whether all is sound.
fn run_soundly(simulation: &mut Simulation, what: &str) {
    let gone = |simulation: &Simulation| simulation.get::<Books>().gone;
    let before = gone(simulation);
    simulation.run(1);
    assert_sound(simulation, what, gone(simulation) - before);
}

/// `gone`: lumps that went into the air in the last tick, after they were counted.
fn assert_sound(simulation: &Simulation, what: &str, gone: u64) {
    let counters = simulation.counters();
    assert_eq!(counters.escaped, 0, "{what}: particles left the box or entered rock");
    assert_eq!(counters.non_finite, 0, "{what}: particles stopped being numbers");
    let particles = simulation.particles();
    let size = simulation.get::<Setup>().blueprint.domain.size;
    for i in 0..particles.len() {
        let (at, velocity) = (particles.position(i), particles.velocity(i));
        assert!(velocity.is_finite(), "{what}: {velocity}");
        let inside = at.cmpge(Vec2::ZERO).all() && at.cmple(size).all();
        assert!(inside && !simulation.rock().is_solid(Solids::cell_of(at)), "{what}: a particle at {at}");
    }
    let mut ids = particles.id.clone();
    ids.extend(simulation.rock().iter().map(|(.., id)| id));
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "{what}: an id was given twice");
    assert_eq!(u64::from(simulation.census().total), ids.len() as u64 + gone, "{what}: the count is wrong");
    let air = simulation.get::<AirGrid>();
    assert!(air.mass().is_finite() && air.kinetic_energy().is_finite(), "{what}: the air is not finite");
}

#[test]
#[cfg_attr(debug_assertions, ignore = "heavy: in release only")]
fn no_whim_breaks_a_built_in_scene() {
    let scenes = scene::builtin_names();
    assert!(scenes.len() >= 8);
    for (k, name) in scenes.into_iter().enumerate() {
        // The largest scenes in a small form: what is tested is not their size.
        let settings: &[(&str, &str)] = match name {
            "dam_break" => &[("columns", "20")],
            "empty" => &[("columns", "100"), ("rows", "60")],
            _ => &[],
        };
        let mut simulation = Simulation::scene(name, settings);
        let size = simulation.get::<Setup>().blueprint.domain.size;
        let mut random = Random::new(100 + k as u64);
        for tick in 0..300 {
            for _ in 0..random.index(4) {
                simulation.push(whim(&mut random, size));
            }
            if tick % 60 == 59 {
                let preset = Preset::ALL[random.index(5)];
                simulation.set_quality(preset, preset.quality()).unwrap();
            }
            if tick % 20 == 0 || tick == 299 {
                run_soundly(&mut simulation, &format!("{name}, tick {tick}"));
            } else {
                simulation.run(1);
            }
        }
    }
}

#[test]
fn left_alone_every_built_in_scene_stays_sound() {
    for name in scene::builtin_names() {
        let settings: &[(&str, &str)] = if name == "dam_break" { &[("columns", "20")] } else { &[] };
        let mut simulation = Simulation::scene(name, settings);
        for _ in 0..4 {
            simulation.run(24);
            run_soundly(&mut simulation, name);
        }
    }
}
