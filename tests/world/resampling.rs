//! A running world goes on at another detail: with the same matter, no worse a liquid and no jolt.

use crate::support::*;
use glam::{DVec2, Vec2};
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
        simd::InstructionSet,
        solids::Solids,
    },
    lab::density::DensityError,
    scene::effects::{Effect, Mode},
    sim::{checkpoint::Checkpoint, control, intent::Intent, simulation::Simulation, state::*, workers::Workers},
};

/// Details that are gone to from 1: what the game offers, and some between.
const DETAILS: [f64; 6] = [0.25, 0.5, 0.7, 1.3, 2.0, 4.0];

/// What of a world must not change with the detail, in SI units, a metre deep.
struct Totals {
    area: f64,
    mass: f64,
    energy: f64,
    momentum: DVec2,
    /// Σ m |v|.
    momentum_sum: f64,
    spacing: f64,
}

impl Totals {
    fn of(simulation: &Simulation) -> Self {
        let Setup { blueprint, domain, .. } = simulation.get::<Setup>();
        let (d, particles) = (f64::from(blueprint.scale.spacing), simulation.particles());
        let mass = 1000.0 * d * d;
        let (mut energy, mut momentum, mut momentum_sum) = (0.0, DVec2::ZERO, 0.0);
        for i in 0..particles.len() {
            let velocity = particles.velocity(i).as_dvec2() * d;
            momentum += mass * velocity;
            momentum_sum += mass * velocity.length();
            energy += 0.5 * mass * velocity.length_squared();
            energy -= mass * d * d * domain.gravity.as_dvec2().dot(particles.position(i).as_dvec2());
        }
        let count = particles.len() as f64;
        Self { area: count * d * d, mass: count * mass, energy, momentum, momentum_sum, spacing: d }
    }
}

fn error(simulation: &Simulation) -> f64 {
    DensityError::of_world(simulation.world()).map_or(0.0, |error| error.mean)
}

fn at(start: &Checkpoint, detail: f64) -> Simulation {
    let mut simulation = Simulation::resume(start, Workers::default());
    simulation.push(Intent::Detail { detail });
    simulation.apply_edits();
    assert_eq!(f64::from(simulation.get::<Setup>().blueprint.scale.detail), f64::from(detail as f32));
    simulation
}

fn assert_in_the_open(simulation: &Simulation) {
    let (particles, domain, rock) =
        (simulation.particles(), simulation.get::<Setup>().domain, simulation.get::<Rock>());
    for i in 0..particles.len() {
        let place = particles.position(i);
        assert!(!rock.is_solid(Solids::cell_of(place)) && domain.keep_inside(place) == place, "{place} is in rock");
    }
    let mut ids: Vec<u32> = particles.id.iter().copied().chain(rock.iter().map(|rock| rock.2)).collect();
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] < pair[1]), "an id is there twice");
    assert!(ids.last().is_none_or(|last| *last < simulation.get::<Clock>().next_id), "an id is not given yet");
}

/// Momentum is a sum of numbers that are rounded once more: n roundings of 2⁻²⁴, at random, are far below 10⁻⁶ of Σ m
/// |v|. Area goes by whole particles. The density error may be half a percent above that of the world that goes on as
/// it is (a quarter of a percent of a spacing, less than what a preset gives up to the next) once the solver had ten
/// ticks, and two and a half times that before. A jolt is what energy gives beyond what the world that goes on as it is
/// gains in that time: as the speed of all matter together it stays below the 0.02 d a tick that is calm to the eye
/// (`lab::coarse`), of the coarser world's d.
#[test]
fn mass_momentum_and_calm_are_kept_at_every_detail() {
    for (scene, ticks) in [("dam_break", 90), ("hydrostatic", 200)] {
        let mut own = Simulation::scene(scene, &[]);
        own.run(ticks);
        let start = Checkpoint::of(own.world());
        let before = Totals::of(&own);
        let mut usual_gain: f64 = 0.0;
        for _ in 0..10 {
            usual_gain = usual_gain.max(Totals::of(own.run(1)).energy - before.energy);
        }
        let usual = error(&own);
        for detail in DETAILS {
            let what = format!("{scene} at {detail}");
            let mut world = at(&start, detail);
            let after = Totals::of(&world);
            assert_in_the_open(&world);
            assert!((after.area - before.area).abs() <= after.spacing.powi(2), "{what}: area {}", after.area);
            let lost = (after.momentum - before.momentum).length();
            assert!(lost <= 1e-6 * before.momentum_sum.max(1.0), "{what}: momentum {}", after.momentum);
            assert!(error(&world) <= usual + 0.0125, "{what}: density error {} after {usual}", error(&world));
            let mut gained = after.energy - before.energy - usual_gain;
            for _ in 0..10 {
                gained = gained.max(Totals::of(world.run(1)).energy - before.energy - usual_gain);
            }
            let (jolt, calm) =
                ((2.0 * gained.max(0.0) / after.mass).sqrt(), 0.02 * after.spacing.max(before.spacing) * 60.0);
            assert!(jolt <= calm, "{what}: energy for {jolt} m/s, {calm} is calm");
            assert!(error(&world) <= usual + 0.005, "{what}: density error {} after {usual}", error(&world));
            assert_eq!(world.get::<Counters>().escaped, 0, "{what}");
        }
    }
}

#[test]
fn rock_air_and_sources_of_the_waterfall_come_along() {
    let mut own = Simulation::scene("waterfall", &[]);
    own.run(240);
    let start = Checkpoint::of(own.world());
    let air = |simulation: &Simulation| {
        let d = f64::from(simulation.get::<Setup>().blueprint.scale.spacing);
        simulation.get::<AirGrid>().mass() * d * d
    };
    let before = Totals::of(&own);
    own.run(30);
    let grown = Totals::of(&own).area - before.area;
    for detail in [0.5, 2.0] {
        let mut world = at(&start, detail);
        let (rock, old) = (world.get::<Rock>(), &start.state.solids);
        let share = rock.count() as f64 / old.count() as f64 / detail.powi(2);
        // Twice as fine it is the same; half as fine a cell of the outline is rock if half of it was.
        assert!(if detail > 1.0 { share == 1.0 } else { (share - 1.0).abs() < 0.02 }, "{detail}: {share} of the rock");
        assert_in_the_open(&world);
        // The open top lets no more in or out than the rim of a row of cells.
        let (mass, cell) = (air(&world), f64::from(world.get::<AirGrid>().cell()));
        let start_mass = air(&Simulation::resume(&start, Workers::default()));
        let rim = cell * Totals::of(&world).spacing * 40.0;
        assert!((mass - start_mass).abs() < rim, "{detail}: {mass} m² of air, {start_mass} before");
        let (from, until) = (Totals::of(&world).area, {
            world.run(30);
            Totals::of(&world).area
        });
        // The spring gives the same area a second; a particle more or less is due at both ends, and drops leave.
        assert!(
            (until - from - grown).abs() < 0.1 * grown.abs(),
            "{detail}: grew by {} m², {grown} at 1",
            until - from
        );
        assert_eq!(world.get::<Counters>().escaped, 0);
    }
}

#[test]
fn the_reference_quality_is_twice_as_fine_and_a_lower_one_merges_again() {
    let mut world = Simulation::scene("dam_break", &[("columns", "24")]);
    world.run(30);
    let (count, area) = (world.particles().len(), Totals::of(&world).area);
    for (preset, times) in [(Preset::Reference, 4), (Preset::Fine, 1), (Preset::Draft, 1), (Preset::Reference, 4)] {
        world.push(Intent::Quality { preset, quality: preset.quality() }).run(5);
        let Setup { preset: now, quality, .. } = *world.get::<Setup>();
        assert_eq!((now, quality, world.particles().len()), (preset, preset.quality(), times * count));
        assert!((Totals::of(&world).area - area).abs() < 1e-9);
    }
    // The detail that is asked for goes beside it.
    world.push(Intent::Detail { detail: 0.5 }).run(5);
    assert_eq!(world.particles().len(), count);
    control::reset(world.world_mut());
    assert_eq!((world.particles().len(), world.get::<Clock>().tick), (count, 0), "a reset keeps the detail");
    // The hash goes over air cells, too, and these are the quality's.
    world.push(Intent::Quality { preset: Preset::Balanced, quality: Preset::Balanced.quality() });
    world.push(Intent::Detail { detail: 1.0 }).run(1);
    control::reset(world.world_mut());
    let start = Simulation::scene("dam_break", &[("columns", "24")]);
    assert_eq!(world.hash(), start.hash(), "at its own detail it starts as it was opened, to the bit");
}

#[test]
fn what_does_not_fit_changes_nothing() {
    let mut world = Simulation::scene("dam_break", &[("columns", "24"), ("particle_limit", "1200")]);
    world.run(3);
    let hash = world.hash();
    for (detail, told) in [(0.1, "0.125 to 8"), (f64::NAN, "0.125 to 8"), (9.0, "0.125 to 8")] {
        let error = control::check_detail(world.world(), detail, Preset::Fine).expect_err("no such detail");
        assert!(error.contains(told), "{error}");
        world.push(Intent::Detail { detail });
        world.apply_edits();
        assert_eq!((world.hash(), world.get::<Setup>().blueprint.scale.detail), (hash, 1.0));
    }
    let error = |detail, preset| control::check_detail(world.world(), detail, preset).unwrap_err();
    // 2000 × 2000 particles are all that any world holds.
    let wide = Simulation::scene("dam_break", &[("columns", "1300")]);
    let full = control::check_detail(wide.world(), 2.0, Preset::Fine).expect_err("too many particles");
    assert_eq!(full, "13520000 particles at detail 2, but the limit is 4000000; allowed: a lower detail");
    assert!(error(9.0, Preset::Reference).starts_with("detail 9 is out of range"));
    assert!(control::check_detail(world.world(), 8.0, Preset::Reference).is_ok());
    let small = Simulation::scene("dam_break", &[("columns", "6")]);
    let error = control::check_detail(small.world(), 0.25, Preset::Fine).expect_err("too few cells");
    assert!(error.contains("the box has 6 × 4 cells; allowed: 4 to 32768 along a side"), "{error}");
}

#[test]
fn the_same_changes_make_the_same_world_on_all_threads_and_instruction_sets() {
    let play = |workers: Workers, instructions: InstructionSet| {
        let start = Checkpoint::of_scene(std::sync::Arc::new(blueprint("waterfall", &[])));
        let mut world = Simulation::resume(&start, workers).with_instructions(instructions);
        world.run(40).push(Intent::Detail { detail: 1.5 });
        let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(120.0, 150.0), 6.0);
        world.push(Intent::Draw { element: WATER, stroke }).run(5);
        world.push(Intent::Quality { preset: Preset::Reference, quality: Preset::Reference.quality() }).run(2);
        world.push(Intent::Effect { effect: Effect::Vorticity, mode: Mode::Off });
        world.push(Intent::Quality { preset: Preset::Draft, quality: Preset::Draft.quality() });
        world.push(Intent::Detail { detail: 0.5 }).run(10);
        world.hash()
    };
    let one = play(Workers::single(), InstructionSet::Baseline);
    assert_eq!(play(Workers::new(3).expect("three threads"), InstructionSet::detect()), one);
}

#[test]
fn a_saved_world_of_another_detail_goes_on_and_an_earlier_state_comes_back() {
    let mut world = Simulation::scene("waterfall", &[]);
    world.run(20);
    let earlier = Checkpoint::of(world.world());
    world.push(Intent::Detail { detail: 2.0 }).run(10);
    let later = Checkpoint::of(world.world());
    let read = Checkpoint::decode(&later.encode()).expect("what was saved");
    let mut again = Simulation::resume(&read, Workers::default());
    assert_eq!((again.hash(), read.setup.asked_detail()), (world.hash(), 2.0));
    assert_eq!(again.run(10).hash(), world.run(10).hash(), "it goes the same way");
    // Undo and redo.
    for (state, detail) in [(&earlier, 1.0), (&later, 2.0)] {
        state.restore(world.world_mut());
        let mut alone = Simulation::resume(state, Workers::default());
        assert_eq!((world.hash(), world.get::<Setup>().blueprint.scale.detail), (alone.hash(), detail));
        assert_eq!(world.run(5).hash(), alone.run(5).hash(), "the elements are of this detail");
    }
}
