//! The picture of the world: one instanced draw for all movable particles, one for all rock, one for streaks of wind,
//! and two passes over the screen (box and air, liquid).
//!
//! `extract` copies what a frame needs out of the world, packed by `blobs`, `stone` and `air` into the layout that the
//! processor of the graphics reads; `gpu` uploads it; `draw` draws it before the HUD. `wisps` are the tracers that make
//! wind visible. Everything here runs on WebGL2: no storage buffers, no compute.

pub mod air;
pub mod blobs;
pub mod draw;
pub mod extract;
pub mod gpu;
pub mod pipelines;
pub mod stone;
pub mod wisps;

use bevy::{
    asset::Assets,
    core_pipeline::{Core2d, Core2dSystems, core_2d::main_transparent_pass_2d},
    prelude::{App, ExtractSchedule, IntoScheduleConfigs, Plugin, PostUpdate, Resource},
    render::{Render, RenderApp, RenderSystems},
    shader::Shader,
};
use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};

/// Draws the world of the simulation.
pub struct WorldRenderPlugin;

impl Plugin for WorldRenderPlugin {
    fn build(&self, app: &mut App) {
        let cost = RenderCost::default();
        let shader = Shader::from_wgsl(include_str!("../../../assets/shaders/world.wgsl"), "shaders/world.wgsl");
        let shader = app.world_mut().resource_mut::<Assets<Shader>>().add(shader);
        app.insert_resource(cost.clone()).init_resource::<wisps::Wisps>().add_systems(PostUpdate, wisps::drift);
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        render_app
            .insert_resource(cost)
            .insert_resource(pipelines::WorldShader(shader))
            .init_resource::<extract::Pictures>()
            .init_resource::<gpu::GpuPictures>()
            .init_resource::<pipelines::Pipelines>()
            .add_systems(ExtractSchedule, extract::extract)
            .add_systems(
                Render,
                (
                    (gpu::upload, pipelines::prepare).in_set(RenderSystems::PrepareResources),
                    gpu::bind.in_set(RenderSystems::PrepareBindGroups),
                ),
            )
            .add_systems(Core2d, draw::draw.after(main_transparent_pass_2d).in_set(Core2dSystems::MainPass));
    }
}

/// Processor time that the last frame's picture cost, µs: written by the render world, shown in the details.
#[derive(Resource, Clone, Default)]
pub struct RenderCost {
    extract: Arc<AtomicU32>,
    upload: Arc<AtomicU32>,
}

impl RenderCost {
    /// Time for copying the world out and for handing it to the graphics, ms.
    pub fn milliseconds(&self) -> (f32, f32) {
        let ms = |micros: &AtomicU32| micros.load(Ordering::Relaxed) as f32 / 1000.0;
        (ms(&self.extract), ms(&self.upload))
    }
}
