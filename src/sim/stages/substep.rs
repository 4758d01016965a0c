//! The stages of a substep.

use crate::{
    kernel::{
        air::Rousing,
        diffusion, forces,
        parallel::{Team, are_awake},
        params::Preset,
        pbf, predict, predictor, velocity,
    },
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        ledger::Call,
        stages::TickPlan,
        state::{
            AirGrid, Apart, Clock, Counters, DragState, Elements, MassShares, ParticleStore, PredictorState, Rock,
            Setup, SolverState, Sources, StartEnergy,
        },
        workers::Workers,
    },
};
use bevy::prelude::{Res, ResMut};

/// The air moves.
pub(super) fn step_air(
    mut air: ResMut<AirGrid>,
    sources: Res<Sources>,
    setup: Res<Setup>,
    solver: Res<SolverState>,
    effects: Res<Effects>,
    rock: Res<Rock>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
) -> Call {
    let dt = plan.substep_seconds();
    if !sources.winds.is_empty() {
        air.build(&rock);
    }
    let sleep = effects.get(Effect::Sleep).mode;
    air.set_gravity(setup.domain.gravity);
    if !effects.acts(Effect::Expansion) {
        air.uncrowd();
    }
    air.allow_sleep(sleep == Mode::On || sleep == Mode::Auto && setup.preset != Preset::Reference);
    let worth = air.is_worth_waking() || are_awake();
    let instructions = solver.instructions;
    let report = workers.run_if(worth, |threads| {
        air.step(&sources.winds, setup.quality.air_scheme(), Team { instructions, threads }, dt)
    });
    counters.add_air(&report);
    let all = u64::from(report.substeps) * (air.columns() * air.rows()) as u64;
    Call { touched: report.worked, spared: all - report.worked }
}

/// Gravity changes velocities: the first half of the kick. From here on the energy is counted that vorticity confinement
/// may give back.
pub(super) fn begin_kick(
    mut particles: ResMut<ParticleStore>,
    mut start: ResMut<StartEnergy>,
    (elements, apart): (Res<Elements>, Res<Apart>),
    (setup, solver): (Res<Setup>, Res<SolverState>),
    effects: Res<Effects>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
) -> usize {
    let (gravity, dt, weights) = (setup.domain.gravity, plan.substep_seconds(), apart.of(&elements).weights);
    if effects.get(Effect::Vorticity).running {
        start.0 = velocity::energy(&particles, &elements, gravity, weights, solver.instructions);
    }
    workers.run_for(particles.len(), |threads| forces::begin_kick(gravity, weights, &mut particles, threads, dt));
    particles.len()
}

/// Particles drag the air. How much it is to drag each of them is noted on the way.
pub(super) fn drag_air(
    particles: Res<ParticleStore>,
    mut air: ResMut<AirGrid>,
    mut later: ResMut<DragState>,
    elements: Res<Elements>,
    solver: Res<SolverState>,
    effects: Res<Effects>,
    rock: Res<Rock>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
) -> usize {
    air.build(&rock);
    let rousing = if effects.get(Effect::AirFeedback).mode == Mode::On { Rousing::Breaths } else { Rousing::Gusts };
    let instructions = solver.instructions;
    workers.run_for(particles.len(), |threads| {
        let team = Team { instructions, threads };
        air.meet(&elements, &particles, &mut later, rousing, team, plan.substep_seconds());
    });
    particles.len()
}

/// The air drags particles, by what [`drag_air`] noted if they have dragged it. Half of it comes after the move.
pub(super) fn apply_drag(
    mut particles: ResMut<ParticleStore>,
    mut air: ResMut<AirGrid>,
    mut later: ResMut<DragState>,
    elements: Res<Elements>,
    solver: Res<SolverState>,
    effects: Res<Effects>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
) -> usize {
    let instructions = solver.instructions;
    let (dt, feedback) = (plan.substep_seconds(), effects.acts(Effect::AirFeedback));
    workers.run_for(particles.len(), |threads| match feedback {
        true => air.drag_along(&mut particles, &mut later, Team { instructions, threads }),
        false => forces::apply_drag(&air, &elements, &mut particles, &mut later, threads, dt),
    });
    particles.len()
}

/// The pressure predictor makes velocities nearly divergence-free.
pub(super) fn predict_pressure(
    mut particles: ResMut<ParticleStore>,
    mut predictor: ResMut<PredictorState>,
    mut solver: ResMut<SolverState>,
    (elements, shares, apart): (Res<Elements>, Res<MassShares>, Res<Apart>),
    rock: Res<Rock>,
    setup: Res<Setup>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
) -> usize {
    let report = workers.run_for(particles.len(), |threads| {
        let params = predictor::PredictorParams {
            domain: &setup.domain,
            cell: setup.quality.kernel_radius,
            rest_density: setup.blueprint.fluid.rest_density,
            masses: shares.get(),
            grains: apart.of(&elements).sines.map(|sines| {
                let cohesion = &elements.cohesion[..];
                predictor::GrainParams { sines, cohesion }
            }),
            drawn: apart.of(&elements).drawn,
            instructions: solver.instructions,
            threads,
            dt: plan.substep_seconds(),
        };
        predictor.run(&mut particles, &rock, &params, solver.room())
    });
    counters.pressure_clamps += report.cuts;
    counters.pressure_unsolved += u64::from(report.unsolved);
    particles.len()
}

/// Velocities predict positions, and change by what was put off until then.
pub(super) fn predict_positions(
    mut particles: ResMut<ParticleStore>,
    mut later: ResMut<DragState>,
    solver: Res<SolverState>,
    rock: Res<Rock>,
    (elements, apart): (Res<Elements>, Res<Apart>),
    setup: Res<Setup>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
) -> usize {
    let (dt, traits) = (plan.substep_seconds(), apart.of(&elements));
    let around = (&**rock, &setup.domain);
    let report = workers.run_for(particles.len(), |threads| {
        let report = predict::predict(&mut particles, solver.instructions, around, &setup.quality, traits, threads, dt);
        later.end(&mut particles, threads, predict::longest_move(&setup.quality) / dt);
        report
    });
    counters.speed_clamps += report.speed_clamps;
    particles.len()
}

/// Particles are sorted into bins.
pub(super) fn sort_into_bins(
    mut particles: ResMut<ParticleStore>,
    mut solver: ResMut<SolverState>,
    rock: Res<Rock>,
    setup: Res<Setup>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
) -> usize {
    let rest_density = setup.blueprint.fluid.rest_density;
    let report = workers.run_for(particles.len(), |threads| {
        solver.bin(&mut particles, &rock, &setup.domain, &setup.quality, rest_density, threads)
    });
    counters.set_apart += report.set_apart;
    particles.len()
}

/// The density constraint corrects positions.
pub(super) fn solve_density(
    particles: Res<ParticleStore>,
    mut solver: ResMut<SolverState>,
    shares: Res<MassShares>,
    setup: Res<Setup>,
    effects: Res<Effects>,
    workers: Res<Workers>,
) -> usize {
    workers.run_for(particles.len(), |threads| {
        let params = pbf::SolveParams {
            domain: &setup.domain,
            fluid: &setup.blueprint.fluid,
            quality: &setup.quality,
            tension: effects.get(Effect::Tension).running,
            predicted: effects.get(Effect::Predictor).running,
            masses: shares.get(),
            threads,
        };
        solver.solve(&particles, &params);
    });
    particles.len()
}

/// Velocities follow from the moves.
pub(super) fn update_velocities(
    mut particles: ResMut<ParticleStore>,
    mut solver: ResMut<SolverState>,
    rock: Res<Rock>,
    setup: Res<Setup>,
    predictor: Res<PredictorState>,
    (elements, apart): (Res<Elements>, Res<Apart>),
    effects: Res<Effects>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
) -> usize {
    let (gravity, dt, traits) = (setup.domain.gravity, plan.substep_seconds(), apart.of(&elements));
    let flow = effects.get(Effect::Predictor).running.then(|| predictor.flow());
    let report = workers.run_for(particles.len(), |threads| {
        velocity::update_velocities(&mut particles, &mut solver, &rock, gravity, flow, traits, threads, dt)
    });
    counters.position_clamps += report.position_clamps;
    particles.len()
}

/// Viscosity evens velocities out.
pub(super) fn apply_viscosity(
    mut particles: ResMut<ParticleStore>,
    mut solver: ResMut<SolverState>,
    elements: Res<Elements>,
    setup: Res<Setup>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
) -> usize {
    let dt = plan.substep_seconds();
    let report = workers.run_for(particles.len(), |threads| {
        velocity::apply_viscosity(&mut particles, &mut solver, &setup.domain, &elements, threads, dt)
    });
    counters.strength_clamps += report.clamps;
    particles.len()
}

/// Vorticity confinement keeps eddies alive.
pub(super) fn apply_vorticity(
    mut particles: ResMut<ParticleStore>,
    mut solver: ResMut<SolverState>,
    (elements, apart): (Res<Elements>, Res<Apart>),
    setup: Res<Setup>,
    start: Res<StartEnergy>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
) -> usize {
    let dt = plan.substep_seconds();
    let report = workers.run_for(particles.len(), |threads| {
        let weights = apart.of(&elements).weights;
        let lost =
            start.0 - velocity::energy(&particles, &elements, setup.domain.gravity, weights, solver.instructions);
        velocity::apply_vorticity(&mut particles, &mut solver, &elements, lost, threads, dt)
    });
    counters.strength_clamps += report.clamps;
    particles.len()
}

/// Gases spread in the air.
pub(super) fn spread_gases(
    mut particles: ResMut<ParticleStore>,
    solver: Res<SolverState>,
    elements: Res<Elements>,
    rock: Res<Rock>,
    (setup, clock): (Res<Setup>, Res<Clock>),
    plan: Res<TickPlan>,
    workers: Res<Workers>,
) -> usize {
    let (dt, around) = (plan.substep_seconds(), (&**rock, &setup.domain));
    workers.run_for(particles.len(), |threads| {
        diffusion::wander(&mut particles, around, &elements.diffusion, solver.densities(), clock.tick, threads, dt);
    });
    particles.len()
}
