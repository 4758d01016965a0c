//! Worlds that were saved at one quality and detail, and are opened at another.
//!
//! What is demanded, at whatever quality it was saved and is opened:
//!
//! - **Nothing lost.** A resampling gives the area of the movable matter to half a new particle (what is left over when the
//!   last one is made, `kernel::resample`), and where each is split into a whole number, all of it. At the setting that it was
//!   saved at, the world is the same to the bit.
//! - **Finite, and inside**: no limiter takes a particle away or puts one back.
//! - **Calm stays calm.** Carrying over takes means of velocities, and a mean has no more energy than what it is of; it moves
//!   particles as far as the density constraint asks. A jolt is calm to the eye below 0.02 of the coarser world's d a tick
//!   (`lab::coarse`), as where a running world is resampled: so much may be added to the motion that was saved. Not where it
//!   is opened at the plain method, whose water trembles at .06 to .10 d a tick by itself (docs/gauntlet.md, `known`).
//! - **No worse a liquid** than a tank that has always stood at that quality and detail: by half a percent of the density at
//!   most, which is a quarter of a percent of a spacing, less than one preset gives up to the next.

use crate::support::*;
use powder_master::{
    kernel::{params::Preset, solids::Solids},
    lab::density::DensityError,
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{checkpoint::Checkpoint, simulation::Simulation, state::*, workers::Workers},
};
use std::{collections::HashMap, sync::Arc};

/// A quality, and the detail that is asked for beside it.
type Setting = (Preset, f64);

/// What a player may save at: every quality, and the lowest step of the dial.
const SAVED: [Setting; 7] = [
    (Preset::Classic, 1.0),
    (Preset::Draft, 0.5),
    (Preset::Draft, 1.0),
    (Preset::Fast, 1.0),
    (Preset::Balanced, 1.0),
    (Preset::Fine, 1.0),
    (Preset::Reference, 1.0),
];

/// What it may be opened at: every quality at half, at the own and at twice the detail.
fn opened() -> impl Iterator<Item = Setting> {
    Preset::ALL.into_iter().flat_map(|preset| [0.5, 1.0, 2.0].map(|detail| (preset, detail)))
}

/// A scene at a setting, kept awake: what sleeps is still anyway.
fn awake(scene: &str, settings: &[(&str, &str)], (preset, detail): Setting) -> Checkpoint {
    let settings: Vec<(String, String)> = settings.iter().map(|&(key, value)| (key.into(), value.into())).collect();
    let file = powder_master::scene::load(scene).unwrap_or_else(|error| panic!("{error}")).at_detail(detail);
    let modes = [(Effect::Sleep, Mode::Off)].into_iter().collect();
    let blueprint: Blueprint = file.build(&settings, Some(preset), &modes).unwrap_or_else(|error| panic!("{error}"));
    Checkpoint::of_scene(Arc::new(blueprint))
}

/// What comes back of a world from a file, at another setting, as the command line opens it.
fn open(file: &[u8], (preset, detail): Setting) -> Simulation {
    let saved = Checkpoint::decode(file).unwrap_or_else(|error| panic!("{error}"));
    let other = saved.at(preset, preset.quality(), detail);
    Simulation::resume(&other.unwrap_or_else(|error| panic!("{error}")), Workers::default())
}

fn spacing(simulation: &Simulation) -> f64 {
    f64::from(simulation.get::<Setup>().blueprint.scale.spacing)
}

/// Area of the movable matter, m².
fn area(simulation: &Simulation) -> f64 {
    simulation.particles().len() as f64 * spacing(simulation).powi(2)
}

/// Root of the mean square of the speeds, m/s.
fn motion(simulation: &Simulation) -> f64 {
    simulation.rms_speed() * 60.0 * spacing(simulation)
}

fn density_error(simulation: &Simulation) -> f64 {
    DensityError::of_world(simulation.world()).map_or(0.0, |error| error.mean)
}

fn assert_sound(simulation: &Simulation, what: &str) {
    let (particles, domain, rock) = (simulation.particles(), simulation.get::<Setup>().domain, simulation.rock());
    for i in 0..particles.len() {
        let (at, velocity) = (particles.position(i), particles.velocity(i));
        assert!(at.is_finite() && velocity.is_finite(), "{what}: {at}, {velocity}");
        assert!(domain.keep_inside(at) == at && !rock.is_solid(Solids::cell_of(at)), "{what}: {at} is outside");
    }
    let counters = simulation.counters();
    assert_eq!((counters.escaped, counters.non_finite), (0, 0), "{what}");
}

/// How much a file holds and where it was saved, and what became of that at a setting.
fn assert_nothing_lost(before: (f64, f64), world: &Simulation, what: &str) {
    let (area_before, d_before) = before;
    let (after, d) = (area(world), spacing(world));
    let factor = d_before / d;
    let splits = factor >= 1.0 && (factor - factor.round()).abs() < 1e-6;
    // 10⁻⁶: a spacing is a number of 24 bits.
    let left_over = 1e-6 * area_before + if splits { 0.0 } else { 0.5 * d.powi(2) };
    assert!((after - area_before).abs() <= left_over, "{what}: {after} m² of {area_before} m²");
}

#[test]
fn calm_water_opened_at_any_quality_stays_calm_and_whole() {
    let tank = [("columns", "24"), ("depth", "20")];
    // What a tank is like that has always stood there.
    let mut own = HashMap::new();
    for setting @ (preset, detail) in opened() {
        let mut world = Simulation::resume(&awake("hydrostatic", &tank, setting), Workers::default());
        world.run(150);
        own.insert((preset.name(), detail.to_bits()), density_error(&world));
    }
    for saved in SAVED {
        let mut world = Simulation::resume(&awake("hydrostatic", &tank, saved), Workers::default());
        world.run(150);
        let (before, moved) = ((area(&world), spacing(&world)), motion(&world));
        let file = Checkpoint::of(world.world()).encode();
        assert_eq!(open(&file, saved).hash(), world.hash(), "{}", saved.0.name());
        for setting @ (preset, detail) in opened() {
            let what = format!("{} at {}, opened as {} at {detail}", saved.0.name(), saved.1, preset.name());
            let mut world = open(&file, setting);
            assert_eq!(world.get::<Setup>().quality, preset.quality(), "{what}");
            assert_nothing_lost(before, &world, &what);
            assert_sound(&world, &what);
            let count = world.particles().len();
            let mut most: f64 = 0.0;
            for _ in 0..120 {
                most = most.max(motion(world.run(1)));
            }
            assert_eq!(world.particles().len(), count, "{what}");
            assert_sound(&world, &what);
            if preset == Preset::Classic {
                continue;
            }
            // What `classic` saves is crushed: it comes apart, at no more than 5 d/s (docs/gauntlet.md).
            let still = if saved.0 == Preset::Classic { 5.0 } else { 0.02 * 60.0 };
            let calm = still * before.1.max(spacing(&world));
            assert!(most <= moved + calm, "{what}: {most} m/s, {moved} before, and {calm} is calm");
            let (error, own) = (density_error(&world), own[&(preset.name(), detail.to_bits())]);
            assert!(error <= own + 0.005, "{what}: density error {error}, {own} in a tank that always stood there");
        }
    }
}

/// Scenes in motion, some of them fed and drained, with air in it and without.
const SCENES: [(&str, &[(&str, &str)]); 7] = [
    ("communicating_vessels", &[]),
    ("dam_break", &[("columns", "24")]),
    ("empty", &[]),
    ("rest_density", &[]),
    ("sealed_air", &[]),
    ("waterfall", &[]),
    ("wind_tunnel", &[]),
];

#[test]
fn every_scene_in_motion_is_whole_at_every_other_quality() {
    for (k, (scene, settings)) in SCENES.into_iter().enumerate() {
        let saved = SAVED[(3 * k + 1) % SAVED.len()];
        let mut world = Simulation::resume(&awake(scene, settings, saved), Workers::default());
        world.run(60);
        let before = (area(&world), spacing(&world));
        let rock = world.rock().count();
        let file = Checkpoint::of(world.world()).encode();
        for setting @ (preset, detail) in opened() {
            let what = format!("{scene} at {} × {}, opened as {} × {detail}", saved.0.name(), saved.1, preset.name());
            let mut world = open(&file, setting);
            assert_nothing_lost(before, &world, &what);
            assert_sound(&world, &what);
            assert_eq!(rock > 0, world.rock().count() > 0, "{what}");
            let air = world.get::<AirGrid>().mass();
            world.run(20);
            assert_sound(&world, &what);
            let Setup { blueprint, .. } = world.get::<Setup>();
            if blueprint.emitters.is_empty() && blueprint.drains.is_empty() {
                assert_nothing_lost(before, &world, &what);
            }
            if scene == "sealed_air" {
                let drift = (world.get::<AirGrid>().mass() / air - 1.0).abs();
                assert!(drift <= 1e-5, "{what}: the air's mass is off by {drift:e}, more than its rounding");
            }
        }
    }
}
