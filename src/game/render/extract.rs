//! Copies out of the world what a frame needs, once a frame.

use crate::{
    game::{
        camera::{Area, WorldCamera},
        render::{
            cost::RenderCost,
            picture::{Picture, Scene, Sight},
            tracers::Tracers,
        },
        views::{strain::Limited, table::Shown},
    },
    kernel::units::TICK_SECONDS,
    lab::{difference::Difference, split::Split},
    sim::{
        generation::Generation,
        pace::Pace,
        stages::TickPlan,
        state::{AirGrid, Clock, ParticleStore, PredictorState, Rock, Setup, SolverState},
    },
};
use bevy::platform::time::Instant;
use bevy::{
    prelude::{Fixed, Query, Res, ResMut, Resource, Time, With},
    render::Extract,
    window::{PrimaryWindow, Window},
};
use std::sync::atomic::Ordering;

/// One frame's pictures, on the processor's side: the world's, and in an A/B split the second world's and the
/// difference's.
#[derive(Resource, Default)]
pub struct Pictures {
    panes: [Picture; 3],
    count: usize,
    difference: Difference,
}

impl Pictures {
    /// The pictures of this frame.
    pub fn shown(&self) -> &[Picture] {
        &self.panes[..self.count]
    }

    /// The same, to hand them over.
    pub fn shown_mut(&mut self) -> &mut [Picture] {
        &mut self.panes[..self.count]
    }
}

/// What the last tick left besides the world: the predictor's grid, the tick's plan and its number.
type LastTick<'w, 's> = (
    Extract<'w, 's, Option<Res<'static, PredictorState>>>,
    Extract<'w, 's, Option<Res<'static, TickPlan>>>,
    Extract<'w, 's, Option<Res<'static, Clock>>>,
);

/// Copies the worlds out.
#[expect(clippy::too_many_arguments, reason = "a system's parameters are its data flow")]
pub fn extract(
    mut pictures: ResMut<Pictures>,
    cost: Res<RenderCost>,
    windows: Extract<Query<&Window, With<PrimaryWindow>>>,
    camera: Extract<Res<WorldCamera>>,
    shown: Extract<Res<Shown>>,
    generation: Extract<Res<Generation>>,
    setup: Extract<Option<Res<Setup>>>,
    particles: Extract<Option<Res<ParticleStore>>>,
    rock: Extract<Option<Res<Rock>>>,
    air: Extract<Option<Res<AirGrid>>>,
    solver: Extract<Option<Res<SolverState>>>,
    (predictor, plan, clock): LastTick<'_, '_>,
    tracers: Extract<Res<Tracers>>,
    split: Extract<Res<Split>>,
    pace: Extract<Res<Pace>>,
    time: Extract<Res<Time<Fixed>>>,
) {
    let begin = Instant::now();
    pictures.count = 0;
    let (Some(setup), Some(particles), Some(rock), Some(air), Ok(window)) =
        (&*setup, &*particles, &*rock, &*air, windows.single())
    else {
        return;
    };
    if window.resolution.physical_size().min_element() == 0 {
        return;
    }
    // Half a tick after a tick the world is drawn half a tick before it: it then moves evenly at any frame rate.
    let back = if pace.paused { 0.0 } else { TICK_SECONDS * (1.0 - time.overstep_fraction().clamp(0.0, 1.0)) };
    let sight = Sight { window, camera: &camera, view: shown.0, back };
    let solver = solver.as_deref();
    let limited = Limited {
        particles,
        solver: solver.map(|solver| &solver.0),
        predictor: predictor.as_deref().map(|predictor| &predictor.0),
        air,
        quality: &setup.quality,
        dt: plan.as_deref().map_or(TICK_SECONDS, TickPlan::substep_seconds),
        tick: clock.as_deref().map_or(0, |clock| clock.tick),
    };
    let first =
        Scene { generation: **generation, setup, particles, rock, air, solver, limited, tracers: Some(&**tracers) };
    let Pictures { panes: [a, b, c], count, difference } = &mut *pictures;
    let areas: Vec<Area> = camera.panes().collect();
    match (split.world().and_then(Scene::of), areas.as_slice()) {
        (Some(second), &[at_a, at_b, at_c]) => {
            a.fill(Scene { tracers: None, ..first }, sight, at_a, true);
            b.fill(second, sight, at_b, true);
            difference.measure(&setup.blueprint, first.half(), second.half());
            c.fill_with_difference(difference, first, sight, at_c);
            *count = 3;
        }
        _ => {
            a.fill(first, sight, camera.free(), false);
            *count = 1;
        }
    }
    cost.extract.store(begin.elapsed().as_micros() as u32, Ordering::Relaxed);
}
