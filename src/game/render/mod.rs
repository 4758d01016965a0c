//! The picture of the world: one instanced draw for all movable particles, one for all rock, one for streaks of wind,
//! and two passes over the screen (box and air, liquid).
//!
//! `extract` copies what a frame needs out of the world, packed by `particles`, `rock` and `air` into the layout that the
//! processor of the graphics reads; `gpu` uploads it; `draw` draws it before the HUD. `tracers` make wind
//! visible. Everything here runs on WebGL2: no storage buffers, no compute.

pub mod air;
pub mod cost;
pub mod draw;
pub mod extract;
pub mod gpu;
pub mod particles;
pub mod picture;
pub mod pipelines;
pub mod rock;
pub mod tracers;

use bevy::{
    asset::Assets,
    core_pipeline::{Core2d, Core2dSystems, core_2d::main_transparent_pass_2d},
    prelude::{App, ExtractSchedule, IntoScheduleConfigs, Plugin, PostUpdate},
    render::{Render, RenderApp, RenderStartup, RenderSystems},
    shader::Shader,
};

/// Draws the world of the simulation.
pub struct WorldRenderPlugin;

impl Plugin for WorldRenderPlugin {
    fn build(&self, app: &mut App) {
        let cost = cost::RenderCost::default();
        let shader = Shader::from_wgsl(include_str!("../../../assets/shaders/world.wgsl"), "shaders/world.wgsl");
        let shader = app.world_mut().resource_mut::<Assets<Shader>>().add(shader);
        app.insert_resource(cost.clone()).init_resource::<tracers::Tracers>().add_systems(PostUpdate, tracers::drift);
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        render_app
            .insert_resource(cost)
            .insert_resource(pipelines::WorldShader(shader))
            .init_resource::<extract::Pictures>()
            .init_resource::<gpu::GpuPictures>()
            .init_resource::<pipelines::Pipelines>()
            .add_systems(RenderStartup, pipelines::make_layouts)
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
