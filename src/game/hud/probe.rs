//! What is under the pointer, and what the colours of the view mean, in the lower corners of the world.

use crate::{
    game::{
        camera::WorldCamera,
        hud::style::{LINE, PANEL, SMALL, TEXT, WEAK},
        input::pointer::{HudCover, Pointer},
        language::spoken,
        lump::Lump,
        panels::Panels,
        tools::spaced,
        views::table::{Shown, View},
    },
    kernel::{element::Element, heat::units::CELSIUS},
    sim::state::{HeatCurves, ParticleStore, Rock, Setup},
};
use bevy::prelude::{Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, Color32, FontId, Rect, RichText, Ui, pos2, vec2},
};

/// Distance from the corner, points.
const MARGIN: f32 = 10.0;
/// Width of the scale of colours, points.
const SCALE: f32 = 260.0;
/// Steps of it.
const STEPS: usize = 52;

/// Shows both.
pub fn show(
    mut contexts: EguiContexts,
    (panels, view, cover): (Res<Panels>, Res<Shown>, Res<HudCover>),
    pointer: Res<Pointer>,
    camera: Res<WorldCamera>,
    (setup, curves): (Res<Setup>, Res<HeatCurves>),
    particles: Res<ParticleStore>,
    rock: Res<Rock>,
) -> Result {
    if !panels.visible {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let bottom = (camera.window().y - camera.free().max.y) / context.zoom_factor();
    let area = |name: &'static str, corner: Align2| {
        let margin = if corner == Align2::LEFT_BOTTOM { MARGIN } else { -MARGIN };
        egui::Area::new(name.into())
            .anchor(corner, [margin, -bottom - MARGIN])
            .order(egui::Order::Background)
            .interactable(false)
    };
    if !view.0.legend.is_empty() {
        area("legend", Align2::RIGHT_BOTTOM).show(context, |ui| card(ui, |ui| legend(ui, view.0)));
    }
    let Some(pixel) = pointer.at.filter(|pixel| !cover.covers(*pixel)) else { return Ok(()) };
    let Some(lump) = Lump::at(&particles, &rock, camera.to_world(pixel)) else { return Ok(()) };
    let text = describe(&setup, &curves, lump);
    area("probe", Align2::LEFT_BOTTOM).show(context, |ui| {
        card(ui, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 10.0;
                let [name, rest @ ..] = &text[..] else { return };
                ui.label(RichText::new(name).color(TEXT));
                rest.iter().for_each(|text| {
                    ui.label(RichText::new(text).color(WEAK));
                });
            });
        });
    });
    Ok(())
}

fn card(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    egui::Frame::new()
        .fill(PANEL.gamma_multiply(0.96))
        .stroke(egui::Stroke::new(1.0, LINE))
        .corner_radius(7)
        .inner_margin(egui::Margin::symmetric(10, 5))
        .show(ui, add);
}

/// Name, temperature, what it is changing into, and speed.
fn describe(setup: &Setup, curves: &HeatCurves, lump: Lump) -> Vec<String> {
    let (elements, curve) = (setup.elements(), curves.curve(lump.element));
    let mut text = vec![
        spoken(&spaced(&elements.get(lump.element).name)),
        format!("{:.0} °C", curve.temperature(lump.heat) - CELSIUS),
    ];
    if let Some((change, share)) = curve.begun(lump.heat) {
        let into = change.into.iter().flatten().next().map(|id| spoken(&spaced(&elements.get(*id).name)));
        text.push(format!("{:.0} % {}", 100.0 * share, into.unwrap_or_default()));
    }
    if let Some(velocity) = lump.velocity {
        text.push(format!("{:.1} m/s", setup.blueprint.scale.to_metres(velocity.length())));
    }
    text
}

/// The scale of the view's colours with its marks.
fn legend(ui: &mut Ui, view: &View) {
    let font = FontId::proportional(SMALL);
    let (rect, _) = ui.allocate_exact_size(vec2(SCALE, 27.0), egui::Sense::hover());
    let painter = ui.painter();
    // The marks' texts stand below their places: half of the last would be outside.
    let bar = Rect::from_min_max(rect.min + vec2(14.0, 0.0), pos2(rect.max.x - 24.0, rect.min.y + 9.0));
    let at = |share: f32| bar.min.x + share * bar.width();
    let any = Element::plain("", false);
    for k in 0..STEPS {
        let (from, to) = (k as f32 / STEPS as f32, (k + 1) as f32 / STEPS as f32);
        let [r, g, b] = (view.colour)(&any, 0.5 * (from + to));
        let step = Rect::from_min_max(pos2(at(from), bar.min.y), pos2(at(to) + 0.5, bar.max.y));
        painter.rect_filled(step, 0.0, Color32::from_rgb(r, g, b));
    }
    for (share, text) in view.legend {
        painter.vline(at(*share), bar.min.y..=bar.max.y + 3.0, egui::Stroke::new(1.0, TEXT));
        // Below its mark, and never beyond the card.
        let text = painter.layout_no_wrap(spoken(text), font.clone(), TEXT);
        let room = rect.max.x - text.size().x;
        let left = (at(*share) - 0.5 * text.size().x).clamp(rect.min.x, room.max(rect.min.x));
        painter.galley(pos2(left, rect.max.y - text.size().y), text, TEXT);
    }
}
