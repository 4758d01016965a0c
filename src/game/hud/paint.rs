//! What puts the HUD on the screen: egui, with what is better for this game.

use bevy::{
    app::App,
    asset::{AssetEventSystems, Assets},
    log::error,
    prelude::{IntoScheduleConfigs, PostUpdate},
    shader::Shader,
};
use bevy_egui::{EguiPlugin, EguiPostUpdateSet, render::EGUI_SHADER_HANDLE};

/// egui, drawn by a shader that comes to the same colours with less work.
pub fn plugin(app: &mut App) {
    // The shader has one texture at a time: there are only letters, and a picture now and then.
    app.add_plugins(EguiPlugin { bindless_mode_array_size: None, ..EguiPlugin::default() });
    // A letter that was never shown comes with the frame that shows it, and not with the next.
    app.configure_sets(PostUpdate, AssetEventSystems.after(EguiPostUpdateSet::PostProcessOutput));
    let shader = Shader::from_wgsl(include_str!("../../../assets/shaders/hud.wgsl"), "shaders/hud.wgsl");
    if let Err(error) = app.world_mut().resource_mut::<Assets<Shader>>().insert(EGUI_SHADER_HANDLE.id(), shader) {
        error!("the HUD keeps the shader that it came with: {error}");
    }
}
