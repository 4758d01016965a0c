//! The scale of the HUD, and the room that it leaves to the world.

use crate::{
    game::{
        camera::{Area, WorldCamera},
        hud::{HudState, style},
        split,
    },
    sim::split::Split,
};
use bevy::{
    prelude::{Query, Res, ResMut, Resource, Result, With},
    window::{PrimaryWindow, Window},
};
use bevy_egui::{
    EguiContexts,
    egui::{self, RichText},
};
use glam::Vec2;

/// Scales that the player may choose on top of the automatic one.
const CHOICES: [f32; 6] = [0.75, 0.9, 1.0, 1.15, 1.3, 1.6];
/// Window in which the automatic scale is 1, logical pixels.
const DESIGNED_FOR: Vec2 = Vec2::new(1200.0, 750.0);

/// Size of the HUD.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct UiScale {
    /// The player's factor on top of the automatic scale.
    pub factor: f32,
}

impl Default for UiScale {
    fn default() -> Self {
        Self { factor: 1.0 }
    }
}

/// What the bars cover, points.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct Room {
    /// Height of the bar on top.
    pub top: f32,
    /// Height of the palette.
    pub bottom: f32,
}

/// Scale that suits a window of this size in logical pixels (the system's own scale comes on top): larger windows get a
/// larger HUD, but not in full proportion; small ones a little smaller, but readable.
pub fn automatic_scale(window: Vec2) -> f32 {
    let share = (window / DESIGNED_FOR).min_element();
    let scale = if share > 1.0 { 1.0 + 0.72 * (share - 1.0) } else { share };
    scale.clamp(0.8, 3.0)
}

/// Scales the HUD.
pub fn scale_to_window(
    mut contexts: EguiContexts,
    scale: Res<UiScale>,
    windows: Query<&Window, With<PrimaryWindow>>,
) -> Result {
    let Ok(window) = windows.single() else { return Ok(()) };
    let wanted = automatic_scale(window.resolution.size()) * scale.factor;
    let wanted = (wanted * 20.0).round() / 20.0;
    let context = contexts.ctx_mut()?;
    if context.zoom_factor() != wanted {
        context.set_zoom_factor(wanted);
    }
    Ok(())
}

/// Gives the world the room between the bars.
pub fn make_room(
    mut contexts: EguiContexts,
    room: Res<Room>,
    split: Res<Split>,
    state: Res<HudState>,
    windows: Query<&Window, With<PrimaryWindow>>,
    mut camera: ResMut<WorldCamera>,
) -> Result {
    let Ok(window) = windows.single() else { return Ok(()) };
    let zoom = contexts.ctx_mut()?.zoom_factor();
    let size = window.resolution.size();
    let free = Area { min: Vec2::new(0.0, room.top * zoom), max: Vec2::new(size.x, size.y - room.bottom * zoom) };
    let (first, others) = match split.is_on() {
        true => {
            let [first, second, third] = split::areas(free, camera.world(), if state.visible { zoom } else { 0.0 });
            (first, Some([second, third]))
        }
        false => (free, None),
    };
    camera.set_others(others);
    if camera.window() != size || camera.free() != first {
        camera.set_window(size, first);
    }
    Ok(())
}

/// Shows the settings.
pub fn show(mut contexts: EguiContexts, mut state: ResMut<HudState>, mut scale: ResMut<UiScale>) -> Result {
    if !state.settings {
        return Ok(());
    }
    let mut open = true;
    let context = contexts.ctx_mut()?;
    let place = (egui::Align2::CENTER_CENTER, context.content_rect().center());
    style::window(context, "Settings", &mut open, place, |ui| {
        ui.label(RichText::new("Size of the HUD").color(style::WEAK));
        ui.horizontal(|ui| {
            for choice in CHOICES {
                let text = format!("{:.0} %", choice * 100.0);
                if ui.selectable_label(scale.factor == choice, text).clicked() {
                    scale.factor = choice;
                }
            }
        });
        ui.label(RichText::new("100 % follows the size of the window.").small().color(style::WEAK));
    });
    if !open {
        state.settings = false;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hud_is_readable_in_small_and_large_windows() {
        let at = |x, y| automatic_scale(Vec2::new(x, y));
        assert_eq!(at(800.0, 600.0), 0.8);
        assert!((at(1280.0, 800.0) - 1.05).abs() < 0.05);
        assert!(at(3840.0, 2160.0) > 2.0 && at(3840.0, 2160.0) < 3.0);
        assert_eq!(at(100.0, 50.0), 0.8);
    }
}
