//! The rim of the truth lens, which glows with how far the worlds are apart inside, and what that and the truth cost.

use crate::{
    game::{
        camera::WorldCamera,
        hud::{
            split::{amounts, nothing},
            style::{self, weak},
        },
        lens::{Lens, TRUTH},
        panels::Panels,
    },
    kernel::units::Scale,
    lab::{
        difference::{self, Difference, Half, Part},
        split::Split,
    },
    sim::{
        ledger::PassLedger,
        state::{AirGrid, ParticleStore, Setup},
    },
};
use bevy::prelude::{Local, Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Color32, Painter, Pos2, RichText, Stroke, pos2},
};
use std::time::Duration;
use tr::tr;

/// Strokes that the glow is made of.
const GLOW: usize = 7;
/// Width of the glow of the largest difference, of the radius.
const WIDTH: f32 = 0.22;
/// Room for the label, points.
const LABEL: egui::Vec2 = egui::vec2(230.0, 54.0);

/// Shows it.
pub fn show(
    mut contexts: EguiContexts,
    (lens, split, panels): (Res<Lens>, Res<Split>, Res<Panels>),
    camera: Res<WorldCamera>,
    setup: Res<Setup>,
    ledger: Res<PassLedger>,
    contents: (Res<ParticleStore>, Res<AirGrid>),
    mut difference: Local<Difference>,
) -> Result {
    let (Some(ring), Some(second)) = (lens.ring(&camera), split.world()) else {
        *difference = Difference::default();
        return Ok(());
    };
    let context = contexts.ctx_mut()?;
    let (particles, air) = contents;
    let first = Half { particles: &particles, air: &air, scale: setup.blueprint.scale };
    difference.measure(&setup.blueprint, first, Half::of(second));
    let part = difference.within(camera.to_world(ring.centre), ring.radius / camera.pixels_per_d());
    let zoom = context.zoom_factor();
    let (centre, radius) = (pos2(ring.centre.x / zoom, ring.centre.y / zoom), ring.radius / zoom);
    rim(&context.layer_painter(egui::LayerId::background()), centre, radius, part.heat);
    if panels.visible {
        let own: &Setup = second.resource();
        let equal = (own.quality, own.blueprint.scale) == (setup.quality, setup.blueprint.scale);
        let cost = times(split.tick_time(), ledger.tick().median());
        label(
            context,
            place(context, (centre, radius), camera.free().max.y / zoom),
            cost.as_deref(),
            &told(part, equal, setup.blueprint.scale),
        );
    }
    Ok(())
}

/// A ring that can be seen on light and on dark, and around it the glow of a difference.
fn rim(painter: &Painter, centre: Pos2, radius: f32, heat: f32) {
    let ([r, g, b], opacity) = difference::colour(heat);
    let width = WIDTH * radius * opacity;
    for k in 0..GLOW {
        let share = (k + 1) as f32 / GLOW as f32;
        let colour = Color32::from_rgba_unmultiplied(r, g, b, (255.0 * opacity * (1.0 - 0.8 * share) * 0.4) as u8);
        // Outward only: inside, the truth is to be seen as it is.
        painter.circle_stroke(centre, radius + 0.5 * share * width, Stroke::new(share * width, colour));
    }
    let neutral = Color32::from_rgb(190, 200, 212);
    let warm = neutral.lerp_to_gamma(Color32::from_rgb(r, g, b), opacity);
    painter.circle_stroke(centre, radius, Stroke::new(3.2, Color32::from_black_alpha(120)));
    painter.circle_stroke(centre, radius, Stroke::new(1.4 + 1.6 * opacity, warm));
}

/// How many times as long a tick at reference takes, once there is one.
fn times(second: Duration, first: Duration) -> Option<String> {
    let is_known = !second.is_zero() && !first.is_zero();
    is_known.then(|| format!("× {:.1}", second.as_secs_f32() / first.as_secs_f32()))
}

/// The difference in words, with its units.
fn told(part: Part, equal: bool, scale: Scale) -> String {
    let is_nothing = part.liquid.unwrap_or(0.0) == 0.0 && part.wind.unwrap_or(0.0) == 0.0;
    if is_nothing {
        return nothing(equal);
    }
    amounts(part.liquid, part.wind, scale).collect::<Vec<_>>().join(", ")
}

/// The upper left corner of the label: below the ring, or above it if there is no room before `bottom`.
fn place(context: &egui::Context, (centre, radius): (Pos2, f32), bottom: f32) -> Pos2 {
    let apart = (1.0 + 0.5 * WIDTH) * radius + 8.0;
    let below = centre.y + apart;
    let top = if below + LABEL.y < bottom { below } else { (centre.y - apart - LABEL.y).max(0.0) };
    let left = (centre.x - LABEL.x / 2.0).clamp(0.0, (context.content_rect().right() - LABEL.x).max(0.0));
    pos2(left, top)
}

fn label(context: &egui::Context, at: Pos2, cost: Option<&str>, difference: &str) {
    let area = egui::Area::new("lens".into()).fixed_pos(at).order(egui::Order::Middle).interactable(false);
    area.constrain(false).show(context, |ui| {
        ui.set_width(LABEL.x);
        ui.vertical_centered(|ui| {
            let card = egui::Frame::new().fill(style::PANEL).stroke(Stroke::new(1.0, style::LINE)).corner_radius(8);
            card.inner_margin(egui::Margin::symmetric(10, 4)).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                let cost = cost.map_or_else(String::new, |cost| format!("  {}", tr!("{cost} the time", cost)));
                ui.label(RichText::new(format!("{}{cost}", TRUTH.name())).color(style::ACCENT));
                ui.label(weak(tr!("difference: {difference}", difference)).small());
            });
        });
    });
}
