//! The picture of the world, in passes over what is there of it:
//!
//! ```text
//! bodies, more ─► fields ─► surface ┐
//! gases ────────► field ──► cloud   │    backdrop, streaks, surface, grains, rock, clouds
//! grains, rock, streaks ────────────┴──► the window, from back to front
//! ```
//! `extract` copies what a frame needs out of a world (a `scene`, and how it is looked at) into a `picture`: the `source` of matter
//! and rock (in the views that show a number `particles` and `rock`), and `air`. The world goes on while the picture packs the source:
//! `matter` and `rock` in the layout that the graphics read, `body` and `glow` as maps that the shaders look at, `tiles` where there is
//! anything at all, `features` what its passes can't leave out; `level` says how much of it the graphics can do in time; `moved` knows
//! where things were between two ticks, `look` which element is drawn how, `noise` is a texture that never changes. `gpu` uploads it, as
//! `texture`s, also what is drawn many times (`instances`); `pipelines` has what its features ask for; `draw` draws it before the HUD.
//! `offscreen` draws without a window, for `bench frame` and tests. `tracers` make wind visible. Everything here runs on WebGL2: no
//! storage buffers, no compute, targets of eight bits.

pub mod air;
pub mod body;
pub mod cost;
pub mod draw;
pub mod extract;
pub mod features;
#[cfg(not(target_arch = "wasm32"))]
pub mod film;
#[cfg(not(target_arch = "wasm32"))]
pub mod frame_cost;
pub mod glow;
pub mod gpu;
pub mod instances;
pub mod level;
pub mod look;
pub mod matter;
pub mod moved;
pub mod noise;
#[cfg(not(target_arch = "wasm32"))]
pub mod offscreen;
pub mod particles;
pub mod picture;
pub mod pipelines;
pub mod rock;
mod scene;
pub mod source;
#[cfg(test)]
mod tests;
pub mod texture;
pub mod tiles;
pub mod tracers;
pub mod uniform;

use bevy::{
    asset::Assets,
    core_pipeline::{Core2d, Core2dSystems, core_2d::main_transparent_pass_2d},
    prelude::{App, ExtractSchedule, IntoScheduleConfigs, Plugin, PostUpdate},
    render::{Render, RenderApp, RenderStartup, RenderSystems},
    shader::Shader,
};

/// One module of all passes: they share the numbers of the frame.
const SHADER: &str = concat!(
    include_str!("../../../assets/shaders/common.wgsl"),
    include_str!("../../../assets/shaders/backdrop.wgsl"),
    include_str!("../../../assets/shaders/coloured.wgsl"),
    include_str!("../../../assets/shaders/matter.wgsl"),
    include_str!("../../../assets/shaders/grains.wgsl"),
    include_str!("../../../assets/shaders/gases.wgsl"),
    include_str!("../../../assets/shaders/rock.wgsl"),
    include_str!("../../../assets/shaders/streaks.wgsl"),
);

/// Draws the world of the simulation.
pub struct WorldRenderPlugin;

impl Plugin for WorldRenderPlugin {
    fn build(&self, app: &mut App) {
        let cost = cost::RenderCost::default();
        let shader = Shader::from_wgsl(SHADER, "shaders/world.wgsl");
        let shader = app.world_mut().resource_mut::<Assets<Shader>>().add(shader);
        app.insert_resource(cost.clone())
            .init_resource::<level::PictureLevel>()
            .init_resource::<tracers::Tracers>()
            .add_systems(PostUpdate, (tracers::drift, level::follow_frames));
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        render_app
            .insert_resource(cost)
            .insert_resource(pipelines::WorldShader(shader))
            .init_resource::<extract::Pictures>()
            .init_resource::<gpu::GpuPictures>()
            .init_resource::<cost::Repeat>()
            .init_resource::<pipelines::Pipelines>()
            .add_systems(RenderStartup, pipelines::make_layouts)
            .add_systems(ExtractSchedule, extract::extract)
            .add_systems(
                Render,
                (
                    extract::pack.in_set(RenderSystems::PrepareAssets),
                    (gpu::upload, pipelines::prepare).in_set(RenderSystems::PrepareResources),
                    gpu::bind.in_set(RenderSystems::PrepareBindGroups),
                ),
            )
            .add_systems(Core2d, draw::draw.after(main_transparent_pass_2d).in_set(Core2dSystems::MainPass));
    }
}
