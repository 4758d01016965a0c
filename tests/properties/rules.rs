//! What every world is judged by.

use super::case::Case;
use crate::support::SimulationExt;
use glam::Vec2;
use powder_master::{
    kernel::{predict::longest_move, solids::Solids},
    scene::{self, effects::EffectModes},
    sim::{
        intent::Intent,
        recording::Input,
        simulation::Simulation,
        stages::TickPlan,
        state::{AirGrid, Clock, Setup, Sources},
    },
};

/// A rule that does not hold, in one line.
pub type Fault = String;

/// Plays the case and judges its world in every tick. A scene that the reader refuses is no world: that is `Ok(false)`.
pub fn judge(case: &Case) -> Result<bool, Fault> {
    let blueprint = match scene::from_text("case", case.scene.clone()) {
        Ok(file) => match file.build(&[], None, &EffectModes::new()) {
            Ok(blueprint) => blueprint,
            Err(error) => return refused(&error.to_string()),
        },
        Err(error) => return refused(&error.to_string()),
    };
    let mut simulation = Simulation::of(blueprint);
    let mut judge = Judge::new(&simulation, case);
    let mut waiting = Input::new(case.input.clone());
    for tick in 0..case.ticks {
        waiting.give(simulation.world_mut());
        simulation.tick();
        judge.look(&simulation).map_err(|fault| format!("after tick {tick}: {fault}"))?;
    }
    Ok(true)
}

/// A refusal must be one line that says what is allowed.
fn refused(error: &str) -> Result<bool, Fault> {
    let is_one_line = !error.contains('\n') && error.contains("allowed");
    if is_one_line { Ok(false) } else { Err(format!("a refusal must be one line with what is allowed: {error}")) }
}

fn demand(holds: bool, fault: impl FnOnce() -> Fault) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(fault()) }
}

/// What the world was like before.
struct Judge {
    /// Mass of the air, while it must stay.
    air_mass: Option<f64>,
    /// Energy that the world may have, d²/s² for the mass of a particle, while that is known.
    energy: Option<f64>,
}

impl Judge {
    fn new(simulation: &Simulation, case: &Case) -> Self {
        let setup = simulation.get::<Setup>();
        let (blueprint, sources) = (&setup.blueprint, simulation.get::<Sources>());
        let open = blueprint.air.open;
        let sealed = !(open.left || open.right || open.bottom || open.top);
        let keeps_air = |intent: &Intent| matches!(intent, Intent::Blow { .. });
        let air_stays = sealed && case.input.iter().all(|entry| keeps_air(&entry.intent));
        // Energy comes in by emitters, winds, hands and air that is not at rest; a liquid whose rest density is not that of
        // its lattice stands under pressure from the start, and one that pulls or is pushed by tension has energy of
        // position that nobody counts.
        let alone = case.input.is_empty() && sources.emitters.is_empty() && sources.winds.is_empty();
        let fluid = &blueprint.fluid;
        let plain = fluid.rest_density >= 1.0 && fluid.constraint_floor == 0.0 && fluid.tension_strength <= 0.001;
        let known = alone && plain && blueprint.pressures.is_empty();
        Self { air_mass: air_stays.then(|| air_mass(simulation)), energy: known.then(|| energy(simulation)) }
    }

    fn look(&mut self, simulation: &Simulation) -> Result<(), Fault> {
        numbers(simulation)?;
        places(simulation)?;
        counts(simulation)?;
        self.air(simulation)?;
        speeds(simulation)?;
        self.energy(simulation)
    }

    /// Sealed air is neither lost nor made, but for what f32 rounds off in a storm of 10⁶ d/s (docs/stability.md): up to 6e-8
    /// in each of the 4,096 steps that a tick may take, most of which cancels.
    fn air(&self, simulation: &Simulation) -> Result<(), Fault> {
        let mass = air_mass(simulation);
        demand(self.air_mass.is_none_or(|before| (mass - before).abs() <= 3e-4 * before), || {
            format!("a mass of air of {mass}, not of {:?}", self.air_mass)
        })
    }

    /// Nothing is put in: the energy does not rise but by a twentieth of the world's own, and by what rounding and the
    /// particles' finding their places make.
    fn energy(&self, simulation: &Simulation) -> Result<(), Fault> {
        let Some(before) = self.energy else { return Ok(()) };
        let after = energy(simulation);
        let setup = simulation.get::<Setup>();
        let domain = &setup.domain;
        let count = simulation.particles().len() as f64;
        let fall = f64::from(domain.gravity.abs().dot(domain.size));
        // Corrections of a tenth of a spacing a substep, as speeds.
        let jitter = 0.5 * (0.1_f64 * 60.0 * f64::from(setup.quality.substeps)).powi(2);
        let allowed = before + 0.05 * (before + count * fall) + count * jitter;
        demand(after <= allowed, || format!("an energy of {after:.5e} from {before:.5e}; allowed: {allowed:.5e}"))
    }
}

/// Kinetic energy and that of position, from the lowest corner of the box on.
fn energy(simulation: &Simulation) -> f64 {
    let domain = &simulation.get::<Setup>().domain;
    let gravity = domain.gravity;
    let lowest =
        Vec2::new(if gravity.x > 0.0 { domain.size.x } else { 0.0 }, if gravity.y > 0.0 { domain.size.y } else { 0.0 });
    let particles = simulation.particles();
    let of = |i: usize| {
        let speed2 = particles.velocity(i).as_dvec2().length_squared();
        0.5 * speed2 - gravity.as_dvec2().dot((particles.position(i) - lowest).as_dvec2())
    };
    (0..particles.len()).map(of).sum()
}

/// Every value is a number.
fn numbers(simulation: &Simulation) -> Result<(), Fault> {
    let particles = simulation.particles();
    for i in 0..particles.len() {
        let (at, velocity) = (particles.position(i), particles.velocity(i));
        demand(at.is_finite() && velocity.is_finite(), || format!("a particle at {at} with {velocity}"))?;
    }
    let counters = simulation.counters();
    demand(counters.non_finite == 0, || format!("{} particles were no numbers", counters.non_finite))?;
    let air = simulation.get::<AirGrid>();
    for row in 0..air.rows() {
        let fields = [air.pressure_row(row), air.velocity_x_row(row), air.velocity_y_row(row)];
        let sound = fields.iter().all(|field| field.iter().all(|value| value.is_finite()));
        demand(sound && fields[0].iter().all(|p| *p >= 0.0), || format!("row {row} of the air is no longer sound"))?;
    }
    Ok(())
}

/// Nobody is outside or in rock.
fn places(simulation: &Simulation) -> Result<(), Fault> {
    let particles = simulation.particles();
    let size = simulation.get::<Setup>().blueprint.domain.size;
    for i in 0..particles.len() {
        let at = particles.position(i);
        let inside = at.cmpge(Vec2::ZERO).all() && at.cmple(size).all();
        demand(inside && !simulation.rock().is_solid(Solids::cell_of(at)), || format!("a particle at {at}"))?;
    }
    let escaped = simulation.counters().escaped;
    demand(escaped == 0, || format!("{escaped} particles had escaped"))
}

/// Counts add up and ids are unique.
fn counts(simulation: &Simulation) -> Result<(), Fault> {
    let (particles, rock) = (simulation.particles(), simulation.rock());
    let mut ids: Vec<u32> = particles.id.iter().copied().chain(rock.iter().map(|(.., id)| id)).collect();
    ids.sort_unstable();
    demand(ids.windows(2).all(|pair| pair[0] != pair[1]), || "an id was given twice".to_owned())?;
    let next = simulation.get::<Clock>().next_id;
    demand(ids.last().is_none_or(|id| *id < next), || format!("an id above {next} was never given"))?;
    let (census, setup) = (simulation.census(), simulation.get::<Setup>());
    let total: u32 = census.by_element.iter().sum();
    demand(census.total as usize == ids.len() && total == census.total, || {
        format!("{} particles, but the census has {} and {total}", ids.len(), census.total)
    })?;
    let limit = setup.blueprint.particle_limit as usize;
    demand(ids.len() <= limit, || format!("{} particles; the limit is {limit}", ids.len()))?;
    for emitter in &simulation.get::<Sources>().emitters {
        let within = emitter.total.is_none_or(|total| emitter.given <= total);
        demand(within && (0.0..1e6).contains(&emitter.due), || format!("an emitter that gave {emitter:?}"))?;
    }
    Ok(())
}

/// No particle is faster than what the limiters leave: the longest move, a correction, and what the air or viscosity
/// made of the others' speeds, which is no more.
fn speeds(simulation: &Simulation) -> Result<(), Fault> {
    let (plan, setup) = (simulation.get::<TickPlan>(), simulation.get::<Setup>());
    let dt = plan.substep_seconds();
    let correction = std::f32::consts::SQRT_2 * setup.quality.longest_correction();
    // Confinement adds a tenth of the longest move, and the second half of gravity comes after the cut. The next
    // substep cuts both again.
    let gravity = 0.5 * setup.domain.gravity.length() * dt;
    let most = (1.1 * longest_move(&setup.quality) + correction) / dt + gravity;
    let particles = simulation.particles();
    let fastest = (0..particles.len()).map(|i| particles.velocity(i).length()).fold(0.0, f32::max);
    demand(fastest <= most, || format!("a speed of {fastest} d/s; the limiters leave {most}"))
}

/// A world with a block of water and one of rock.
fn small() -> Case {
    let scene = "(title: \"T\", spacing: 0.1, size: (2, 1), contents: [
        (element: \"rock\", shape: Rect(min: (1, 0), max: (1.2, 0.5))),
        (element: \"water\", shape: Rect(min: (0, 0), max: (0.8, 0.4)))])";
    Case { scene: scene.to_owned(), input: Vec::new(), ticks: 20 }
}

/// Mass of the air, of which there may be no grid yet.
fn air_mass(simulation: &Simulation) -> f64 {
    simulation.get::<AirGrid>().with_grid(simulation.rock()).mass()
}

#[test]
fn a_sound_world_is_found_sound_and_every_fault_is_seen() {
    assert_eq!(judge(&small()), Ok(true));
    assert_ne!(judge(&Case { scene: "(title: 3)".to_owned(), ..small() }), Ok(true));
    type Harm = fn(&mut Simulation);
    let harms: [(&str, Harm); 7] = [
        ("a particle that is no number", |world| world.particles_mut().x[0] = f32::NAN),
        ("a particle in rock", |world| world.particles_mut().x[3] = 11.0),
        ("a particle outside", |world| world.particles_mut().y[3] = -0.5),
        ("an id twice", |world| world.particles_mut().id[1] = 5),
        ("a particle that nobody counted", |world| {
            world.particles_mut().retain(|_, i| i > 0);
        }),
        ("a speed past every limiter", |world| world.particles_mut().vx[2] = 1e6),
        ("air that came from nowhere", |world| {
            let rock = world.rock().clone();
            let air: &mut AirGrid = world.get_mut();
            air.build(&rock);
            air.press(Vec2::new(5.0, 8.0), 2.0, 0.1);
        }),
    ];
    for (what, harm) in harms {
        let case = small();
        let file = scene::from_text("case", case.scene.clone()).unwrap_or_else(|error| panic!("{error}"));
        let blueprint = file.build(&[], None, &EffectModes::new()).unwrap_or_else(|error| panic!("{error}"));
        let mut simulation = Simulation::of(blueprint);
        let mut judge = Judge::new(&simulation, &case);
        simulation.run(2);
        assert_eq!(judge.look(&simulation), Ok(()));
        harm(&mut simulation);
        assert!(judge.look(&simulation).is_err(), "nobody saw {what}");
    }
}
