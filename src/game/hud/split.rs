//! The lines over the parts of an A/B split: which quality each has, what it costs, and how far they are apart.

use crate::{
    game::{
        actions::Action,
        camera::{Area, WorldCamera},
        hud::{
            panels::accuracy::axis::percent,
            style::{self, weak},
            widgets::{action_button, icon_button, quality_menu, quality_name},
        },
        icons,
        input::bindings::Bindings,
        orders::{Order, Orders},
        panels::Panels,
        split::LABEL,
    },
    kernel::{
        params::Preset,
        units::{Scale, TICK_SECONDS},
    },
    lab::{
        difference::{self, Difference, FULL_SPEED, Half},
        live::accuracy::LiveError,
        split::Split,
    },
    sim::{
        ledger::PassLedger,
        numbers::short,
        state::{AirGrid, Clock, ParticleStore, Setup},
    },
};
use bevy::prelude::{Local, Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align, Color32, Layout, Sense, Ui, vec2},
};
use tr::tr;

/// Size of the scale of the heat map, points.
const SCALE: egui::Vec2 = vec2(96.0, 9.0);
/// Shades of it that are drawn.
const SHADES: usize = 24;

/// Shows the lines.
pub fn show(
    mut contexts: EguiContexts,
    (panels, bindings): (Res<Panels>, Res<Bindings>),
    camera: Res<WorldCamera>,
    split: Res<Split>,
    setup: Res<Setup>,
    ledger: Res<PassLedger>,
    error: Res<LiveError>,
    contents: (Res<ParticleStore>, Res<AirGrid>, Res<Clock>),
    mut difference: Local<Difference>,
    mut orders: ResMut<Orders>,
) -> Result {
    let panes: Vec<Area> = camera.panes().collect();
    let (Some(second), &[at_a, at_b, at_c], true) = (split.world(), panes.as_slice(), panels.visible) else {
        return Ok(());
    };
    let context = contexts.ctx_mut()?;
    line(context, "split a", at_a, |ui| {
        orders.extend(facts(ui, "A", &setup, &ledger, &error).map(Order::Quality));
    });
    line(context, "split b", at_b, |ui| {
        let chosen = facts(ui, "B", second.resource(), second.resource(), second.resource());
        orders.extend(chosen.map(Order::SecondQuality));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            action_button(ui, icons::close, "", Action::Split, false, (&bindings, &mut orders));
        });
    });
    let (particles, air, clock) = contents;
    let of_first = Half { particles: &particles, air: &air, scale: setup.blueprint.scale };
    difference.measure(&setup.blueprint, of_first, Half::of(second));
    let own: &Setup = second.resource();
    let equal = (own.quality, own.blueprint.scale) == (setup.quality, setup.blueprint.scale);
    let apart = apart(&difference, equal, setup.blueprint.scale, split.age(clock.tick));
    line(context, "split difference", at_c, |ui| {
        ui.label(tr!("Difference"));
        ui.label(weak(apart)).on_hover_text(tr!(
            "In each cell of 4 d: liquid that one world has there and the other not, or flow in another way, on average; \
             and the air's velocity, root mean square. Full heat: all the liquid, or {} % of the speed of a fall \
             through the box; where there is no liquid, a strong wind.\nB starts again from A when you choose its \
             quality, or both come to have the same.",
            100.0 * FULL_SPEED
        ));
        if ui.available_width() > SCALE.x + 20.0 {
            ui.with_layout(Layout::right_to_left(Align::Center), scale);
        }
    });
    Ok(())
}

/// A bar over a part.
fn line(context: &egui::Context, id: &'static str, area: Area, add: impl FnOnce(&mut Ui)) {
    let zoom = context.zoom_factor();
    let (left, top) = (area.min.x / zoom, area.min.y / zoom - LABEL);
    let width = (area.max.x - area.min.x) / zoom;
    let bar = egui::Area::new(id.into()).fixed_pos(egui::pos2(left, top)).order(egui::Order::Middle).constrain(false);
    bar.show(context, |ui| {
        egui::Frame::new().fill(style::PANEL).inner_margin(egui::Margin::symmetric(8, 2)).show(ui, |ui| {
            ui.set_width(width - 16.0);
            ui.horizontal(|ui| {
                ui.set_height(LABEL - 4.0);
                ui.spacing_mut().item_spacing.x = 10.0;
                add(ui);
            });
        });
    });
}

/// Name, quality and cost of a world; the quality that is chosen for it, if one is.
fn facts(ui: &mut Ui, name: &str, setup: &Setup, ledger: &PassLedger, error: &LiveError) -> Option<Preset> {
    let (rect, _) = ui.allocate_exact_size(vec2(22.0, 22.0), Sense::hover());
    ui.painter().rect_filled(rect, style::BUTTON_CORNER, style::ACCENT_FILL);
    let font = egui::TextStyle::Button.resolve(ui.style());
    ui.painter().text(rect.center(), egui::Align2::CENTER_CENTER, name, font, Color32::WHITE);
    let quality = quality_name(setup.preset, &setup.quality);
    let button = icon_button(ui, (icons::gauge, &tr!("quality of {}", name)), &quality, false);
    let chosen = quality_menu(&button, setup.preset);
    ui.label(format!("{:.2} ms", ledger.tick().median().as_secs_f32() * 1000.0));
    if let (Some(mean), true) = (error.mean(), ui.available_width() > 130.0) {
        ui.label(weak(tr!("error {}", percent(mean))));
    }
    chosen
}

/// How far the worlds are apart, in words, if their qualities are `equal` or not, `age` ticks after they were the same.
fn apart(difference: &Difference, equal: bool, scale: Scale, age: Option<u64>) -> String {
    if difference.is_nothing() {
        return nothing(equal);
    }
    let age = age.map(|ticks| tr!("after {} s", format_args!("{:.1}", ticks as f32 * TICK_SECONDS)));
    let parts: Vec<String> = amounts(difference.liquid(), difference.wind(), scale).chain(age).collect();
    parts.join(", ")
}

/// That worlds do not differ, and whether they could.
pub(super) fn nothing(equal: bool) -> String {
    if equal { tr!("none, the qualities are equal") } else { tr!("difference" => "none") }
}

/// A difference of liquid and of air (d/s), each with its unit.
pub(super) fn amounts(liquid: Option<f32>, wind: Option<f32>, scale: Scale) -> impl Iterator<Item = String> {
    let liquid = liquid.map(|mean| tr!("liquid {}", percent(mean)));
    let air = wind.map(|wind| tr!("air {} m/s", short(scale.to_metres(wind))));
    [liquid, air].into_iter().flatten()
}

/// The colours of the heat map, from a little to all.
fn scale(ui: &mut Ui) {
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
}
