//! How far back the world is while it runs backwards.

use crate::{
    game::{
        camera::WorldCamera,
        hud::style::{self, weak},
        icons,
        language::spoken,
        rewind::{Rewind, seconds},
    },
    sim::recorder::REWIND_TICKS,
};
use bevy::prelude::{Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, CornerRadius, Sense, vec2},
};
use tr::tr;

/// Size of the bar that shows how much is left, points.
const BAR: egui::Vec2 = vec2(150.0, 6.0);

/// Shows it over the world.
pub fn show(mut contexts: EguiContexts, rewind: Res<Rewind>, camera: Res<WorldCamera>) -> Result {
    let Some((ticks, end)) = rewind.progress() else { return Ok(()) };
    let context = contexts.ctx_mut()?;
    let top = camera.free().min.y / context.zoom_factor();
    egui::Area::new("rewind".into())
        .anchor(Align2::CENTER_TOP, [0.0, top + 12.0])
        .order(egui::Order::Foreground)
        .interactable(false)
        .show(context, |ui| {
            let card = egui::Frame::new().fill(style::PANEL).stroke(egui::Stroke::new(1.0, style::LINE));
            card.corner_radius(8).inner_margin(egui::Margin::symmetric(14, 8)).show(ui, |ui| {
                ui.horizontal(|ui| {
                    let (place, _) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::hover());
                    icons::draw(ui.painter(), place, icons::rewind, style::ACCENT);
                    ui.label(tr!("{} s back", format_args!("{:.1}", seconds(ticks))));
                    let (place, _) = ui.allocate_exact_size(BAR, Sense::hover());
                    ui.painter().rect_filled(place, CornerRadius::same(3), style::BUTTON);
                    let left = 1.0 - (ticks as f32 / REWIND_TICKS as f32).min(1.0);
                    let left = egui::Rect::from_min_size(place.min, vec2(BAR.x * left, BAR.y));
                    ui.painter().rect_filled(left, CornerRadius::same(3), style::ACCENT);
                });
                if let Some(why) = end {
                    ui.label(weak(spoken(why)).small());
                }
            });
        });
    Ok(())
}
