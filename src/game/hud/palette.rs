//! The bar at the bottom: elements and tools, the brush, time.

use crate::{
    game::{
        actions::Action,
        frame::SPEED_RANGE,
        history::History,
        hud::{
            layout::Bars,
            style,
            widgets::{action_button, tile},
        },
        icons::{self, Icon},
        input::bindings::Bindings,
        orders::{Order, Orders},
        panels::Panels,
        tools::{BRUSH_RANGE, TOOLS, Tool, Toolbox},
    },
    sim::{pace::Pace, state::Setup},
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Local, Res, ResMut, Result},
};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align, Align2, Layout, RichText, Ui, vec2},
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
    mut seen: Local<Option<Tool>>,
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
                    brush(ui, screen.width() < NARROW, &mut tools, &shows.bindings, &mut orders);
                    ui.separator();
                });
                let left = row.with_max_x(right.response.rect.left() - 6.0);
                let new = seen.replace(tools.tool) != Some(tools.tool);
                tiles(ui, left, &shows, (tools.tool, new), &mut orders);
            });
        });
    bars.bottom = screen.bottom() - shown.response.rect.top();
    Ok(())
}

/// The elements and the other tools, in as many rows as it takes. `row` is the space of the first row. More rows than
/// [`MOST_ROWS`] scroll, and what is chosen is scrolled into sight when it is new.
fn tiles(ui: &mut Ui, row: egui::Rect, shows: &Shows, (chosen, new): (Tool, bool), orders: &mut Orders) {
    let elements = shows.setup.elements();
    let places = (((row.width() - SCROLL_BAR) / (TILE.x + GAP)) as usize).max(1);
    let rows = (elements.len() + TOOLS.len()).div_ceil(places);
    let height = rows.min(MOST_ROWS) as f32 * (TILE.y + GAP) - GAP;
    if rows > 1 {
        ui.allocate_space(vec2(0.0, height - TILE.y - ui.spacing().item_spacing.y));
    }
    let place = egui::UiBuilder::new().max_rect(row.with_max_y(row.top() + height));
    ui.scope_builder(place.layout(Layout::left_to_right(Align::Min)), |ui| {
        ui.spacing_mut().item_spacing = egui::Vec2::splat(GAP);
        egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                for tool in Tool::all(elements) {
                    if tool == Tool::Other(TOOLS[0]) && rows == 1 {
                        ui.separator();
                    }
                    let (key, about) = said(tool, shows);
                    let (rect, response) = tile(ui, TILE, 1.0, tool, elements, tool == chosen);
                    let colour = if tool == chosen { style::ACCENT } else { style::WEAK };
                    let at = rect.right_top() + vec2(-5.0, 3.0);
                    ui.painter().text(at, Align2::RIGHT_TOP, key, egui::FontId::proportional(11.0), colour);
                    if new && tool == chosen {
                        response.scroll_to_me(None);
                    }
                    if response.on_hover_text(about).clicked() {
                        orders.push(Order::Act(Action::Tool(tool)));
                    }
                }
            });
        });
    });
}

/// The key of a tool, if it has one, and what there is to say of it.
fn said(tool: Tool, shows: &Shows) -> (String, String) {
    let Tool::Element(id) = tool else {
        return (shows.bindings.key(Action::Tool(tool)), shows.bindings.tip(Action::Tool(tool)));
    };
    let (element, spacing) = (shows.setup.elements().get(id), shows.setup.blueprint.scale.spacing);
    let mass = element.density * spacing * spacing;
    let kind = if element.fixed { "stays where it is" } else { "flows" };
    let key = element.key.map(String::from).unwrap_or_default();
    let in_brackets = if key.is_empty() { String::new() } else { format!(" ({key})") };
    (key, format!("{}{in_brackets}: {kind}, {} kg/m², {mass:.3} kg a particle", element.name, element.density))
}

/// Shape and size of the brush, from right to left.
fn brush(ui: &mut Ui, narrow: bool, tools: &mut ResMut<Toolbox>, bindings: &Bindings, orders: &mut Orders) {
    if !narrow {
        let mut radius = tools.radius();
        ui.spacing_mut().slider_width = 90.0;
        let slider = egui::Slider::new(&mut radius, BRUSH_RANGE).logarithmic(true).show_value(false);
        let slider = ui.add(slider).on_hover_text("size of the brush (wheel, [ and ])");
        slider.widget_info(|| egui::WidgetInfo::slider(true, f64::from(radius), "size of the brush"));
        if slider.changed() {
            tools.set_radius(radius);
        }
    }
    ui.add_sized(
        vec2(34.0, 20.0),
        egui::Label::new(RichText::new(format!("{:.0} d", 2.0 * tools.radius())).color(style::WEAK)),
    )
    .on_hover_text("width of the brush in particle spacings");
    action_button(ui, tools.shape_icon(), "", Action::BrushShape, false, (bindings, orders));
}

/// Pause, steps, speed, undo, reset; from right to left.
fn time(ui: &mut Ui, shows: &Shows, orders: &mut Orders) {
    let Shows { pace, history, bindings, .. } = shows;
    ui.spacing_mut().item_spacing.x = 4.0;
    let (back, forth) = history.reach();
    let (slowest, fastest) = (*SPEED_RANGE.start(), *SPEED_RANGE.end());
    let mut press = |ui: &mut Ui, icon: Icon, action: Action, active: bool, enabled: bool| {
        ui.add_enabled_ui(enabled, |ui| action_button(ui, icon, "", action, active, (bindings, orders)));
    };
    press(ui, icons::reset, Action::Reset, false, true);
    press(ui, icons::redo, Action::Redo, false, forth);
    press(ui, icons::undo, Action::Undo, false, back);
    ui.add_space(8.0);
    press(ui, icons::step, Action::Step, false, true);
    press(ui, if pace.paused { icons::play } else { icons::pause }, Action::Pause, pace.paused, true);
    ui.add_space(4.0);
    press(ui, icons::plus, Action::Speed(1), false, pace.speed < fastest);
    ui.add_sized(vec2(36.0, 20.0), egui::Label::new(RichText::new(speed_text(pace.speed)).color(style::TEXT)));
    press(ui, icons::minus, Action::Speed(-1), false, pace.speed > slowest);
}

fn speed_text(speed: f32) -> String {
    if speed < 1.0 { format!("1/{:.0}×", 1.0 / speed) } else { format!("{speed:.0}×") }
}
