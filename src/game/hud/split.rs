//! The lines over the parts of an A/B split: which quality each has, what it costs, and how far they are apart.

use crate::{
    game::{
        camera::{Area, WorldCamera},
        hud::{
            HudState,
            bar::{icon_button, quality_menu, quality_name, tip},
            icons::Icon,
            style,
        },
        input::bindings::Action,
        orders::{Order, Orders},
        split::LABEL,
    },
    kernel::params::Preset,
    sim::{
        accuracy::LiveError,
        difference::{self, Difference},
        ledger::PassLedger,
        split::Split,
        state::{ParticleStore, Setup},
    },
};
use bevy::prelude::{Local, Res, ResMut, Result, World};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align, Color32, Layout, RichText, Sense, Ui, vec2},
};

/// Size of the scale of the heat map, points.
const SCALE: egui::Vec2 = vec2(96.0, 9.0);
/// Shades of it that are drawn.
const SHADES: usize = 24;

/// What a line says of a world.
struct Facts<'a> {
    name: &'static str,
    setup: &'a Setup,
    ledger: &'a PassLedger,
    error: &'a LiveError,
}

/// Shows the lines.
pub fn show(
    mut contexts: EguiContexts,
    state: Res<HudState>,
    camera: Res<WorldCamera>,
    split: Res<Split>,
    setup: Res<Setup>,
    ledger: Res<PassLedger>,
    error: Res<LiveError>,
    particles: Res<ParticleStore>,
    mut difference: Local<Difference>,
    mut orders: ResMut<Orders>,
) -> Result {
    let panes: Vec<Area> = camera.panes().collect();
    let (Some(second), &[at_a, at_b, at_c], true) = (split.world(), panes.as_slice(), state.visible) else {
        return Ok(());
    };
    let context = contexts.ctx_mut()?;
    let first = Facts { name: "A", setup: &setup, ledger: &ledger, error: &error };
    line(context, "split a", at_a, |ui| {
        if let Some(preset) = facts(ui, &first) {
            orders.push(Order::Quality(preset));
        }
    });
    if let Some(facts_of_second) = Facts::of("B", second) {
        line(context, "split b", at_b, |ui| {
            if let Some(preset) = facts(ui, &facts_of_second) {
                orders.push(Order::SecondQuality(preset));
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if icon_button(ui, Icon::Close, None, false).on_hover_text(tip(Action::Split)).clicked() {
                    orders.push(Order::Act(Action::Split));
                }
            });
        });
    }
    difference.measure(&setup.blueprint, &particles, second.resource::<ParticleStore>());
    line(context, "split difference", at_c, |ui| apart(ui, &difference));
    Ok(())
}

impl<'a> Facts<'a> {
    fn of(name: &'static str, world: &'a World) -> Option<Self> {
        Some(Self { name, setup: world.get_resource()?, ledger: world.get_resource()?, error: world.get_resource()? })
    }
}

/// A bar over a part.
fn line(context: &egui::Context, id: &'static str, area: Area, add: impl FnOnce(&mut Ui)) {
    let zoom = context.zoom_factor();
    let (left, top) = (area.min.x / zoom, area.min.y / zoom - LABEL);
    let width = (area.max.x - area.min.x) / zoom;
    egui::Area::new(id.into()).fixed_pos(egui::pos2(left, top)).order(egui::Order::Middle).constrain(false).show(
        context,
        |ui| {
            egui::Frame::new().fill(style::PANEL).inner_margin(egui::Margin::symmetric(8, 2)).show(ui, |ui| {
                ui.set_width(width - 16.0);
                ui.horizontal(|ui| {
                    ui.set_height(LABEL - 4.0);
                    ui.spacing_mut().item_spacing.x = 10.0;
                    add(ui);
                });
            });
        },
    );
}

/// Name, quality and cost of a world; the quality that is chosen for it, if one is.
fn facts(ui: &mut Ui, facts: &Facts<'_>) -> Option<Preset> {
    let (rect, _) = ui.allocate_exact_size(vec2(22.0, 22.0), Sense::hover());
    ui.painter().rect_filled(rect, style::BUTTON_CORNER, style::ACCENT_FILL);
    let font = egui::TextStyle::Button.resolve(ui.style());
    ui.painter().text(rect.center(), egui::Align2::CENTER_CENTER, facts.name, font, Color32::WHITE);
    let name = quality_name(facts.setup.preset, &facts.setup.quality);
    let button = icon_button(ui, Icon::Gauge, Some(&name), false);
    let chosen = quality_menu(&button, facts.setup.preset);
    ui.label(format!("{:.2} ms", facts.ledger.tick().median().as_secs_f32() * 1000.0));
    if let (Some(mean), true) = (facts.error.mean(), ui.available_width() > 130.0) {
        let text = format!("error {}", super::accuracy::percent(mean));
        ui.label(RichText::new(text).color(style::WEAK));
    }
    chosen
}

/// How far the worlds are apart, and what the colours mean.
fn apart(ui: &mut Ui, difference: &Difference) {
    ui.label("Difference");
    let text = match difference.is_nothing() {
        true => "none".to_owned(),
        false => format!("{} on average", super::accuracy::percent(difference.mean())),
    };
    ui.label(RichText::new(text).color(style::WEAK)).on_hover_text(
        "In each cell of 4 d: liquid that one world has there and the other not, or flow in another way",
    );
    if ui.available_width() > SCALE.x + 20.0 {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let (rect, _) = ui.allocate_exact_size(SCALE, Sense::hover());
            for k in 0..SHADES {
                let share = |k: usize| k as f32 / SHADES as f32;
                let ([r, g, b], opacity) = difference::colour(share(k + 1));
                let part = egui::Rect::from_x_y_ranges(
                    rect.left() + rect.width() * share(k)..=rect.left() + rect.width() * share(k + 1),
                    rect.y_range(),
                );
                let alpha = (255.0 * opacity) as u8;
                ui.painter().rect_filled(part, 0.0, Color32::from_rgba_unmultiplied(r, g, b, alpha));
            }
        });
    }
}
