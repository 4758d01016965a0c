//! The scale of the HUD, and the space that it leaves to the world.

use crate::{
    game::{
        camera::{Area, WorldCamera},
        lens::Lens,
        panels::Panels,
        split,
    },
    lab::split::Split,
};
use bevy::{
    prelude::{Query, Res, ResMut, Resource, Result, With},
    window::{PrimaryWindow, Window},
};
use bevy_egui::EguiContexts;
use glam::Vec2;

/// Window in which the automatic scale is 1, logical pixels.
const DESIGNED_FOR: Vec2 = Vec2::new(1200.0, 750.0);

/// Scales that the player may choose on top of the automatic one.
pub const CHOICES: [f32; 6] = [0.75, 0.9, 1.0, 1.15, 1.3, 1.6];

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
pub struct Bars {
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

/// Gives the world the space between the bars.
pub fn place_world(
    mut contexts: EguiContexts,
    bars: Res<Bars>,
    (split, lens): (Res<Split>, Res<Lens>),
    panels: Res<Panels>,
    windows: Query<&Window, With<PrimaryWindow>>,
    mut camera: ResMut<WorldCamera>,
) -> Result {
    let Ok(window) = windows.single() else { return Ok(()) };
    let zoom = contexts.ctx_mut()?.zoom_factor();
    let size = window.resolution.size();
    let free = Area { min: Vec2::new(0.0, bars.top * zoom), max: Vec2::new(size.x, size.y - bars.bottom * zoom) };
    let (first, others) = match split.is_on() && !lens.is_on() {
        true => {
            let [first, second, third] = split::areas(free, camera.world(), if panels.visible { zoom } else { 0.0 });
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
