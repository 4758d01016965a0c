//! The bar at the bottom: elements and tools, the brush, time.

use crate::{
    game::{
        frame::SPEED_RANGE,
        history::History,
        hud::{
            HudState,
            bar::{icon_button, tip},
            icons::{self, Icon},
            settings::Room,
            style,
        },
        input::bindings::{self, Action},
        orders::{Order, Orders},
        tools::{BRUSH_RANGE, Tool, Toolbox},
    },
    kernel::{brush::BrushShape, element::Element},
    sim::{pace::Pace, state::Setup},
};
use bevy::prelude::{Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align, Align2, Color32, Layout, RichText, Ui, vec2},
};

/// Size of a tile, points.
const TILE: egui::Vec2 = vec2(54.0, 50.0);
/// Below this width the brush has no slider, points.
const NARROW: f32 = 760.0;

/// Shows the palette.
pub fn show(
    mut contexts: EguiContexts,
    state: Res<HudState>,
    setup: Res<Setup>,
    pace: Res<Pace>,
    history: Res<History>,
    mut tools: ResMut<Toolbox>,
    mut room: ResMut<Room>,
    mut orders: ResMut<Orders>,
) -> Result {
    room.bottom = 0.0;
    if !state.visible {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let screen = context.content_rect();
    let shown = egui::Area::new("palette".into())
        .anchor(Align2::LEFT_BOTTOM, vec2(0.0, 0.0))
        .order(egui::Order::Middle)
        .constrain(false)
        .show(context, |ui| {
            style::bar_frame().show(ui, |ui| {
                ui.set_width(screen.width() - 24.0);
                let chosen = tools.tool;
                let (whole, _) = ui.allocate_exact_size(vec2(ui.available_width(), TILE.y), egui::Sense::hover());
                let right = egui::UiBuilder::new().max_rect(whole).layout(Layout::right_to_left(Align::Center));
                let right = ui.scope_builder(right, |ui| {
                    time(ui, &pace, &history, &mut orders);
                    ui.separator();
                    brush(ui, screen.width() < NARROW, &mut tools);
                    ui.separator();
                });
                let left = whole.with_max_x(right.response.rect.left() - 6.0);
                let left = egui::UiBuilder::new().max_rect(left).layout(Layout::left_to_right(Align::Min));
                let pressed = ui.scope_builder(left, |ui| {
                    let scroll = egui::ScrollArea::horizontal().max_height(TILE.y);
                    scroll.show(ui, |ui| ui.horizontal(|ui| tiles(ui, &setup, chosen)).inner).inner
                });
                let pressed = pressed.inner;
                if let Some(tool) = pressed {
                    orders.push(Order::Choose(tool));
                }
            });
        });
    room.bottom = screen.bottom() - shown.response.rect.top();
    Ok(())
}

/// The elements and the other tools; says which one was pressed.
fn tiles(ui: &mut Ui, setup: &Setup, chosen: Tool) -> Option<Tool> {
    ui.spacing_mut().item_spacing.x = 4.0;
    let mut pressed = None;
    for (id, element) in setup.elements().iter() {
        let key = element.key.map(String::from).unwrap_or_default();
        let look = Look { icon: icon_of(element), colour: colour_of(element), name: &element.name, key: &key };
        let tool = Tool::Element(id);
        if tile(ui, look, chosen == tool).on_hover_text(about(element, setup)).clicked() {
            pressed = Some(tool);
        }
    }
    ui.separator();
    for (tool, icon) in Tool::OTHERS.into_iter().zip([Icon::Eraser, Icon::Wind, Icon::Pressure]) {
        let action = Action::Tool(tool);
        let key = bindings::of(action).map(ToString::to_string).unwrap_or_default();
        let look = Look { icon, colour: style::TEXT, name: tool.name(setup.elements()), key: &key };
        if tile(ui, look, chosen == tool).on_hover_text(tip(action)).clicked() {
            pressed = Some(tool);
        }
    }
    pressed
}

/// Icon of an element.
pub fn icon_of(element: &Element) -> Icon {
    if element.fixed { Icon::Stone } else { Icon::Drop }
}

/// Colour of an element.
pub fn colour_of(element: &Element) -> Color32 {
    let [r, g, b] = element.colour;
    Color32::from_rgb(r, g, b)
}

fn about(element: &Element, setup: &Setup) -> String {
    let mass = element.density * setup.blueprint.scale.spacing * setup.blueprint.scale.spacing;
    let kind = if element.fixed { "stays where it is" } else { "flows" };
    let key = element.key.map(|key| format!(" ({key})")).unwrap_or_default();
    format!("{}{key}: {kind}, {} kg/m², {mass:.3} kg a particle", element.name, element.density)
}

struct Look<'a> {
    icon: Icon,
    colour: Color32,
    name: &'a str,
    key: &'a str,
}

fn tile(ui: &mut Ui, look: Look<'_>, chosen: bool) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(TILE, egui::Sense::click());
    let fill = if chosen {
        style::ACCENT_FILL
    } else if response.hovered() {
        style::BUTTON_HOVER
    } else {
        style::BUTTON
    };
    let painter = ui.painter();
    painter.rect_filled(rect, style::BUTTON_CORNER, fill);
    if chosen {
        let stroke = egui::Stroke::new(1.5, style::ACCENT);
        painter.rect_stroke(rect, style::BUTTON_CORNER, stroke, egui::StrokeKind::Inside);
    }
    icons::draw(painter, icons::square(rect.center() - vec2(0.0, 7.0), 24.0), look.icon, look.colour);
    let font = egui::FontId::proportional(11.0);
    let text = if chosen { Color32::WHITE } else { style::TEXT };
    painter.text(rect.center_bottom() - vec2(0.0, 4.0), Align2::CENTER_BOTTOM, look.name, font.clone(), text);
    let key = if chosen { style::ACCENT } else { style::WEAK };
    painter.text(rect.right_top() + vec2(-5.0, 3.0), Align2::RIGHT_TOP, look.key, font, key);
    response
}

/// Shape and size of the brush, from right to left.
fn brush(ui: &mut Ui, narrow: bool, tools: &mut ResMut<Toolbox>) {
    if !narrow {
        let mut radius = tools.radius();
        ui.spacing_mut().slider_width = 90.0;
        let slider = egui::Slider::new(&mut radius, BRUSH_RANGE).logarithmic(true).show_value(false);
        if ui.add(slider).on_hover_text("size of the brush (wheel, [ and ])").changed() {
            tools.set_radius(radius);
        }
    }
    ui.add_sized(
        vec2(34.0, 20.0),
        egui::Label::new(RichText::new(format!("{:.0} d", 2.0 * tools.radius())).color(style::WEAK)),
    )
    .on_hover_text("width of the brush in particle spacings");
    let icon = match tools.shape {
        BrushShape::Disc => Icon::Round,
        BrushShape::Square | BrushShape::Rectangle => Icon::Square,
    };
    if icon_button(ui, icon, None, false).on_hover_text(tip(Action::BrushShape)).clicked() {
        tools.turn_shape();
    }
}

/// Pause, steps, speed, undo, reset; from right to left.
fn time(ui: &mut Ui, pace: &Pace, history: &History, orders: &mut Orders) {
    ui.spacing_mut().item_spacing.x = 4.0;
    let mut press = |ui: &mut Ui, icon: Icon, action: Action, active: bool, enabled: bool| {
        let button = ui.add_enabled_ui(enabled, |ui| icon_button(ui, icon, None, active)).inner;
        if button.on_hover_text(tip(action)).clicked() {
            orders.push(Order::Act(action));
        }
    };
    let (back, forth) = history.reach();
    press(ui, Icon::Reset, Action::Reset, false, true);
    press(ui, Icon::Redo, Action::Redo, false, forth);
    press(ui, Icon::Undo, Action::Undo, false, back);
    ui.add_space(8.0);
    press(ui, Icon::Step, Action::Step, false, true);
    let (icon, active) = if pace.paused { (Icon::Play, true) } else { (Icon::Pause, false) };
    press(ui, icon, Action::Pause, active, true);
    ui.add_space(4.0);
    let (slowest, fastest) = (*SPEED_RANGE.start(), *SPEED_RANGE.end());
    let mut step = |ui: &mut Ui, text: &str, action: Action, enabled: bool| {
        let button = egui::Button::new(text).min_size(vec2(24.0, 26.0));
        if ui.add_enabled(enabled, button).on_hover_text(tip(action)).clicked() {
            orders.push(Order::Act(action));
        }
    };
    step(ui, "+", Action::Speed(1), pace.speed < fastest);
    ui.add_sized(vec2(36.0, 20.0), egui::Label::new(RichText::new(speed_text(pace.speed)).color(style::TEXT)));
    step(ui, "−", Action::Speed(-1), pace.speed > slowest);
}

fn speed_text(speed: f32) -> String {
    if speed < 1.0 { format!("1/{:.0}×", 1.0 / speed) } else { format!("{speed:.0}×") }
}
