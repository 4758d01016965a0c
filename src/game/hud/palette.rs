//! The bar at the bottom: elements and tools, the brush, time.

use crate::{
    game::{
        actions::Action,
        frame::SPEED_RANGE,
        history::History,
        hud::{layout::Bars, style, widgets::icon_button},
        icons::{self, Icon},
        input::bindings::Bindings,
        orders::{Order, Orders},
        panels::Panels,
        tools::{BRUSH_RANGE, TOOLS, Tool, Toolbox},
    },
    kernel::brush::BrushShape,
    sim::{pace::Pace, state::Setup},
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Res, ResMut, Result},
};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align, Align2, Color32, Layout, RichText, Ui, vec2},
};

/// Size of a tile, points.
const TILE: egui::Vec2 = vec2(54.0, 50.0);
/// Between tiles, points.
const GAP: f32 = 4.0;
/// Most rows of tiles that are seen at once.
const MOST_ROWS: usize = 3;
/// What a scroll bar takes of the width, points.
const SCROLL_BAR: f32 = 16.0;
/// Below this width the brush has no slider, points.
const NARROW: f32 = 760.0;

/// What the palette shows.
#[derive(SystemParam)]
pub struct Shows<'w> {
    panels: Res<'w, Panels>,
    setup: Res<'w, Setup>,
    pace: Res<'w, Pace>,
    history: Res<'w, History>,
    bindings: Res<'w, Bindings>,
}

/// Shows the palette.
pub fn show(
    mut contexts: EguiContexts,
    shows: Shows,
    mut tools: ResMut<Toolbox>,
    mut bars: ResMut<Bars>,
    mut orders: ResMut<Orders>,
) -> Result {
    bars.bottom = 0.0;
    if !shows.panels.visible {
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
                let (row, _) = ui.allocate_exact_size(vec2(ui.available_width(), TILE.y), egui::Sense::hover());
                let right = egui::UiBuilder::new().max_rect(row).layout(Layout::right_to_left(Align::Center));
                let right = ui.scope_builder(right, |ui| {
                    time(ui, &shows, &mut orders);
                    ui.separator();
                    brush(ui, screen.width() < NARROW, &mut tools, &shows.bindings);
                    ui.separator();
                });
                let left = row.with_max_x(right.response.rect.left() - 6.0);
                if let Some(tool) = tiles(ui, left, &shows, tools.tool) {
                    orders.push(Order::Choose(tool));
                }
            });
        });
    bars.bottom = screen.bottom() - shown.response.rect.top();
    Ok(())
}

/// The elements and the other tools, in as many rows as it takes; says which one was pressed. `row` is the space of the
/// first row. More rows than [`MOST_ROWS`] scroll.
fn tiles(ui: &mut Ui, row: egui::Rect, shows: &Shows, chosen: Tool) -> Option<Tool> {
    let elements = shows.setup.elements();
    let places = (((row.width() - SCROLL_BAR) / (TILE.x + GAP)) as usize).max(1);
    let rows = (elements.len() + TOOLS.len()).div_ceil(places);
    let height = rows.min(MOST_ROWS) as f32 * (TILE.y + GAP) - GAP;
    if rows > 1 {
        ui.allocate_space(vec2(0.0, height - TILE.y - ui.spacing().item_spacing.y));
    }
    let place = egui::UiBuilder::new().max_rect(row.with_max_y(row.top() + height));
    let mut pressed = None;
    ui.scope_builder(place.layout(Layout::left_to_right(Align::Min)), |ui| {
        ui.spacing_mut().item_spacing = egui::Vec2::splat(GAP);
        egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                for tool in Tool::all(elements) {
                    if tool == Tool::Other(TOOLS[0]) && rows == 1 {
                        ui.separator();
                    }
                    if tile(ui, tool, shows, tool == chosen).on_hover_text(about(tool, shows)).clicked() {
                        pressed = Some(tool);
                    }
                }
            });
        });
    });
    pressed
}

/// The key of a tool, if it has one.
fn key_of(tool: Tool, shows: &Shows) -> String {
    match tool {
        Tool::Element(id) => shows.setup.elements().get(id).key.map(String::from).unwrap_or_default(),
        Tool::Other(_) => shows.bindings.key(Action::Tool(tool)),
    }
}

/// What there is to say of a tool.
fn about(tool: Tool, shows: &Shows) -> String {
    let Tool::Element(id) = tool else { return shows.bindings.tip(Action::Tool(tool)) };
    let (element, spacing) = (shows.setup.elements().get(id), shows.setup.blueprint.scale.spacing);
    let mass = element.density * spacing * spacing;
    let kind = if element.fixed { "stays where it is" } else { "flows" };
    let key = element.key.map(|key| format!(" ({key})")).unwrap_or_default();
    format!("{}{key}: {kind}, {} kg/m², {mass:.3} kg a particle", element.name, element.density)
}

fn tile(ui: &mut Ui, tool: Tool, shows: &Shows, chosen: bool) -> egui::Response {
    let ((icon, colour), name) = (tool.icon(shows.setup.elements()), tool.name(shows.setup.elements()));
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
    icons::draw(painter, icons::square(rect.center() - vec2(0.0, 7.0), 24.0), icon, colour);
    let font = egui::FontId::proportional(11.0);
    let text = if chosen { Color32::WHITE } else { style::TEXT };
    painter.text(rect.center_bottom() - vec2(0.0, 4.0), Align2::CENTER_BOTTOM, name, font.clone(), text);
    let key = if chosen { style::ACCENT } else { style::WEAK };
    painter.text(rect.right_top() + vec2(-5.0, 3.0), Align2::RIGHT_TOP, key_of(tool, shows), font, key);
    style::name(&response, name, chosen);
    response
}

/// Shape and size of the brush, from right to left.
fn brush(ui: &mut Ui, narrow: bool, tools: &mut ResMut<Toolbox>, bindings: &Bindings) {
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
    let icon: Icon = match tools.shape {
        BrushShape::Disc => icons::round_brush,
        BrushShape::Square | BrushShape::Rectangle => icons::square_brush,
    };
    if icon_button(ui, icon, None, false).on_hover_text(bindings.tip(Action::BrushShape)).clicked() {
        tools.turn_shape();
    }
}

/// Pause, steps, speed, undo, reset; from right to left.
fn time(ui: &mut Ui, shows: &Shows, orders: &mut Orders) {
    let Shows { pace, history, bindings, .. } = shows;
    ui.spacing_mut().item_spacing.x = 4.0;
    let mut press = |ui: &mut Ui, icon: Icon, action: Action, active: bool, enabled: bool| {
        let button = ui.add_enabled_ui(enabled, |ui| icon_button(ui, icon, None, active)).inner;
        if button.on_hover_text(bindings.tip(action)).clicked() {
            orders.push(Order::Act(action));
        }
    };
    let (back, forth) = history.reach();
    press(ui, icons::reset, Action::Reset, false, true);
    press(ui, icons::redo, Action::Redo, false, forth);
    press(ui, icons::undo, Action::Undo, false, back);
    ui.add_space(8.0);
    press(ui, icons::step, Action::Step, false, true);
    let (icon, active): (Icon, bool) = if pace.paused { (icons::play, true) } else { (icons::pause, false) };
    press(ui, icon, Action::Pause, active, true);
    ui.add_space(4.0);
    let (slowest, fastest) = (*SPEED_RANGE.start(), *SPEED_RANGE.end());
    let mut step = |ui: &mut Ui, text: &str, action: Action, enabled: bool| {
        let button = egui::Button::new(text).min_size(vec2(24.0, 26.0));
        if ui.add_enabled(enabled, button).on_hover_text(bindings.tip(action)).clicked() {
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
