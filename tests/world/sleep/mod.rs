//! Water at rest sleeps: it costs nothing, wakes before anything acts on it, and ends where it would have without sleep.

mod falling;
mod kept;
mod waking;

use crate::support::{Furnish, SimulationExt, WATER, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        sources::{Emitter, Rect},
    },
    lab::coarse::{CoarseField, Distance},
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
        passes::Pass,
    },
    sim::{
        simulation::Simulation,
        state::{Setup, SleepState},
    },
};

/// The passes over particles: what sleep saves.
const PASSES: [Pass; 9] = [
    Pass::Gravity,
    Pass::Drag,
    Pass::Pressure,
    Pass::Predict,
    Pass::Bin,
    Pass::Solve,
    Pass::Velocity,
    Pass::Viscosity,
    Pass::Vorticity,
];

/// A box under gravity without air.
fn dry_box(columns: u32, rows: u32) -> Blueprint {
    let mut world = empty_box(columns, rows);
    world.domain.gravity = Vec2::new(0.0, -98.1);
    world.effects.insert(Effect::Air, Mode::Off);
    world.effects.insert(Effect::Drag, Mode::Off);
    world
}

/// A box of 80 × 70 with a lake 20 deep.
fn lake() -> Blueprint {
    let mut world = dry_box(80, 70);
    world.pool((0, 0), (80, 20));
    world
}

fn without_sleep(mut world: Blueprint) -> Simulation {
    world.effects.insert(Effect::Sleep, Mode::Off);
    Simulation::of(world)
}

fn asleep(simulation: &Simulation) -> usize {
    simulation.get::<SleepState>().asleep()
}

/// Runs until all sleeps, `most` ticks at most.
fn until_asleep(simulation: &mut Simulation, most: u32) {
    for _ in 0..most {
        simulation.run(1);
        if asleep(simulation) == simulation.particles().len() {
            return;
        }
    }
    panic!("after {most} ticks {} of {} particles sleep", asleep(simulation), simulation.particles().len());
}

fn work(simulation: &Simulation) -> u64 {
    PASSES.iter().map(|&pass| simulation.calls(pass)).sum()
}

fn disc(at: Vec2, radius: f32) -> Stroke {
    Stroke::dab(BrushShape::Disc, at, radius)
}

/// Distance from the particles that are awake to those that sleep, d.
fn gap(simulation: &Simulation) -> f32 {
    let (particles, asleep) = (simulation.particles(), asleep(simulation));
    let awake = asleep..particles.len();
    let nearest = |i: usize| (0..asleep).map(move |j| particles.position(i).distance(particles.position(j)));
    awake.flat_map(nearest).fold(f32::INFINITY, f32::min)
}

/// Mean height of the four highest particles in each strip of 8 d.
fn surface(simulation: &Simulation) -> Vec<f32> {
    let particles = simulation.particles();
    let strips = (simulation.get::<Setup>().blueprint.domain.size.x / 8.0) as usize;
    (0..strips)
        .map(|strip| {
            let inside = |i: &usize| (particles.x[*i] / 8.0) as usize == strip;
            let mut heights: Vec<f32> = (0..particles.len()).filter(inside).map(|i| particles.y[i]).collect();
            heights.sort_unstable_by(|a, b| b.total_cmp(a));
            heights.iter().take(4).sum::<f32>() / heights.len().clamp(1, 4) as f32
        })
        .collect()
}

fn distance(world: &Simulation, reference: &Simulation) -> Distance {
    let [field, reference] = [world, reference].map(|simulation| CoarseField::of(simulation.world()));
    field.distance(&reference, CoarseField::magnitudes(std::slice::from_ref(&reference)))
}

/// Share of the water that is in another cell of 8 d than without sleep, and the largest difference of the surfaces, d.
fn apart(world: &Simulation, reference: &Simulation) -> (f64, f32) {
    let surfaces = surface(world).into_iter().zip(surface(reference));
    let height = surfaces.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    (distance(world, reference).share.unwrap_or(1.0), height)
}

/// A lake under still air.
fn lake_in_air() -> Blueprint {
    let mut world = lake();
    world.effects.clear();
    world
}

/// A thin jet into the left pond.
fn emitter() -> Emitter {
    Emitter {
        area: Rect { min: Vec2::new(10.0, 33.0), max: Vec2::new(12.0, 35.0) },
        element: WATER,
        velocity: Vec2::new(0.0, -20.0),
        rate: 12.0,
        total: None,
        start: 0,
        given: 0,
        due: 0.0,
    }
}

/// Two ponds with a wall and dry ground between them: the left one of 600 particles, the right one of 800.
fn two_ponds() -> Blueprint {
    let mut world = dry_box(120, 40);
    world.pool((0, 0), (30, 20));
    world.rock((30, 0), (32, 30));
    world.rock((78, 0), (80, 30));
    world.pool((80, 0), (120, 20));
    world
}
