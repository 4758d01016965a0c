//! The bar at the bottom: favourites and tools, the brush, time.

use crate::{
    game::{
        actions::Action,
        brush_mode::BrushMode,
        favourites::DIGITS,
        frame::SPEED_RANGE,
        history::History,
        hud::{
            layout::Bars,
            panels::elements,
            style, temperature,
            tiles::{Face, Tiles, tile},
            widgets::{BUTTON, action_button, field},
        },
        icons::{self, Icon},
        input::bindings::Bindings,
        language::spoken,
        orders::{Order, Orders},
        panels::Panels,
        toolbox::{BRUSH_RANGE, Toolbox},
        tools::{TOOLS, Tool},
    },
    sim::pace::Pace,
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Local, Res, ResMut, Result},
};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align, Align2, Layout, RichText, Ui, vec2},
};
use tr::tr;

/// Size of a tile where there is room for it, points.
const TILE: egui::Vec2 = vec2(54.0, 50.0);
/// Least width of a tile, points.
const LEAST: f32 = 37.0;
/// Between tiles, points.
const GAP: f32 = 3.0;
/// Between favourites and tools, points.
const SPLIT: f32 = 6.0;
/// Places for tiles: all favourites, one that is none, the tools, and the way to all others.
const PLACES: usize = DIGITS.len() + 1 + TOOLS.len() + 1;
/// Most rows of tiles that are seen at once.
const MOST_ROWS: usize = 3;
/// What a scroll bar takes of the width, points.
const SCROLL_BAR: f32 = 16.0;
/// Width of what sets the brush's size and temperature, and height of one of them, points.
const BRUSH: f32 = 56.0;
const FIELD: f32 = 20.0;
/// Size of the buttons for what the brush is and does, points.
const SMALL: egui::Vec2 = vec2(32.0, 24.0);
/// Below this width the brush has no slider, points.
const NARROW: f32 = 760.0;

/// What the palette shows.
#[derive(SystemParam)]
pub struct Shows<'w> {
    panels: Res<'w, Panels>,
    pace: Res<'w, Pace>,
    history: Res<'w, History>,
    bindings: Res<'w, Bindings>,
}

/// Shows the palette.
pub fn show(
    mut contexts: EguiContexts,
    shows: Shows,
    mut tiles: Tiles,
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
                choose(ui, left, (&shows, &mut tiles), (tools.tool, new), &mut orders);
            });
        });
    bars.bottom = screen.bottom() - shown.response.rect.top();
    Ok(())
}

/// How many rows [`PLACES`] tiles take in a `width`, and how wide each is, points. One row is taken as soon as it can be, and
/// tiles of several rows are as wide as those.
fn fit(width: f32) -> (usize, f32) {
    let beside = |width: f32| (((width + GAP) / (LEAST + GAP)) as usize).max(1);
    if width - SPLIT >= PLACES as f32 * (LEAST + GAP) - GAP {
        return (1, ((width - SPLIT + GAP) / PLACES as f32 - GAP).min(TILE.x).floor());
    }
    let room = if PLACES.div_ceil(beside(width)) > MOST_ROWS { width - SCROLL_BAR } else { width };
    let rows = PLACES.div_ceil(beside(room)).max(2);
    (rows, ((room + GAP) / PLACES.div_ceil(rows) as f32 - GAP).min(TILE.x).floor())
}

/// Favourites, tools and the way to all others, in as many rows as it takes. `row` is the space of the first row. More rows
/// than [`MOST_ROWS`] scroll, and what is chosen is scrolled into sight when it is new.
fn choose(
    ui: &mut Ui,
    row: egui::Rect,
    (shows, tiles): (&Shows, &mut Tiles),
    (chosen, new): (Tool, bool),
    orders: &mut Orders,
) {
    let (rows, width) = fit(row.width());
    let size = vec2(width, TILE.y);
    let height = rows.min(MOST_ROWS) as f32 * (TILE.y + GAP) - GAP;
    if rows > 1 {
        ui.allocate_space(vec2(0.0, height - TILE.y - ui.spacing().item_spacing.y));
    }
    let place = egui::UiBuilder::new().max_rect(row.with_max_y(row.top() + height));
    ui.scope_builder(place.layout(Layout::left_to_right(Align::Min)), |ui| {
        ui.spacing_mut().item_spacing = egui::Vec2::splat(GAP);
        egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                for tool in tiles.in_bar(chosen) {
                    if rows == 1 && tool == Tool::Other(TOOLS[0]) {
                        ui.add_space(SPLIT);
                    }
                    let response = tiles.show(ui, size, 1.0, tool, tool == chosen);
                    if new && tool == chosen {
                        response.scroll_to_me(None);
                    }
                    if response.clicked() {
                        orders.push(Order::Act(Action::Tool(tool)));
                    }
                }
                all(ui, size, shows, orders);
            });
        });
    });
}

/// The tile that opens the panel with all elements.
fn all(ui: &mut Ui, size: egui::Vec2, shows: &Shows, orders: &mut Orders) {
    let Shows { panels, bindings, .. } = shows;
    let (panel, action) = (&elements::PANEL, Action::Panel(elements::PANEL.id));
    let face = Face {
        icon: (panel.icon, style::TEXT),
        label: &tr!("elements"),
        name: &bindings.help(action),
        key: &bindings.key(action),
        chosen: panels.shows(panel.id),
    };
    if tile(ui, size, 1.0, &face).on_hover_text(bindings.tip(action)).clicked() {
        orders.push(Order::Act(action));
    }
}

/// Shape, mode and size of the brush, from right to left, and the temperature that it sets.
fn brush(ui: &mut Ui, narrow: bool, tools: &mut ResMut<Toolbox>, bindings: &Bindings, orders: &mut Orders) {
    // One above the other, so that the tiles keep their room whichever tool is chosen.
    let size = vec2(BRUSH, if narrow || tools.kelvin().is_none() { FIELD } else { 2.0 * FIELD + GAP });
    if !narrow || tools.kelvin().is_some() {
        ui.allocate_ui_with_layout(size, Layout::top_down(Align::Center), |ui| {
            let spacing = ui.spacing_mut();
            (spacing.item_spacing.y, spacing.interact_size.y, spacing.button_padding.y) = (GAP, FIELD, 1.0);
            if !narrow {
                size_of_brush(ui, tools, bindings);
            }
            temperature::show(ui, vec2(BRUSH, FIELD), tools);
        });
    }
    ui.add_sized(
        vec2(30.0, 20.0),
        egui::Label::new(RichText::new(format!("{:.0} d", 2.0 * tools.radius())).color(style::WEAK)),
    )
    .on_hover_text(tr!("width of the brush in particle spacings"));
    // One above the other, as high as a tile together.
    ui.allocate_ui_with_layout(vec2(SMALL.x, TILE.y), Layout::top_down(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.y = TILE.y - 2.0 * SMALL.y;
        let (name, tip) = (bindings.help(Action::BrushShape), bindings.tip(Action::BrushShape));
        if small_button(ui, tools.shape_icon(), (&name, &tip), false) {
            orders.push(Order::Act(Action::BrushShape));
        }
        let (mode, is_element) = (tools.mode(), matches!(tools.tool, Tool::Element(_)));
        ui.add_enabled_ui(is_element, |ui| {
            let mode_name = spoken(mode.name());
            let name = tr!("what the brush does: {}", mode_name);
            if small_button(ui, mode.icon(), (&name, &modes_tip(bindings)), mode != BrushMode::Draw) {
                orders.push(Order::Act(Action::NextBrushMode));
            }
        });
    });
}

/// What the brush can do, with the keys.
fn modes_tip(bindings: &Bindings) -> String {
    let key = |mode| bindings.key(Action::BrushMode(mode));
    let [replace, only, spring] = [BrushMode::Replace, BrushMode::EraseOnly, BrushMode::Spring].map(key);
    tr!(
        "What the brush does: draw; replace what is there ({replace}); erase only the chosen element ({only}); \
         set springs and drains ({spring})",
        replace,
        only,
        spring
    )
}

/// How the size of the brush is changed by wheel and keys.
fn size_tip(bindings: &Bindings) -> String {
    let [smaller, larger] = [-1, 1].map(|steps| bindings.chords(Action::Brush(steps)));
    let keys: Vec<String> = smaller.iter().chain(&larger).map(ToString::to_string).collect();
    let keys = keys.join(&tr!(" and "));
    tr!("size of the brush (wheel, {})", keys)
}

/// A button with an icon, half as high as a tile; whether it was pressed.
fn small_button(ui: &mut Ui, icon: Icon, (name, tip): (&str, &str), active: bool) -> bool {
    let (rect, response) = field(ui, SMALL, name, active, BUTTON);
    let colour = if active { style::ACCENT } else { ui.style().interact(&response).fg_stroke.color };
    icons::draw(ui.painter(), icons::square(rect.center(), 15.0), icon, colour);
    response.on_hover_text(tip).clicked()
}

fn size_of_brush(ui: &mut Ui, tools: &mut ResMut<Toolbox>, bindings: &Bindings) {
    let mut radius = tools.radius();
    ui.spacing_mut().slider_width = BRUSH;
    let slider = egui::Slider::new(&mut radius, BRUSH_RANGE).logarithmic(true).show_value(false);
    let slider = ui.add(slider).on_hover_text(size_tip(bindings));
    slider.widget_info(|| egui::WidgetInfo::slider(true, f64::from(radius), tr!("size of the brush")));
    if slider.changed() {
        tools.set_radius(radius);
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_in_one_row_where_they_can_be_and_never_beyond_the_space() {
        for width in (60..1200).map(|width| width as f32) {
            let (rows, tile) = fit(width);
            let in_row = PLACES.div_ceil(rows) as f32;
            let split = if rows == 1 { SPLIT } else { 0.0 };
            assert!(in_row * (tile + GAP) - GAP + split <= width + 0.01, "{width}: {rows} rows of {tile}");
            assert!((LEAST..=TILE.x).contains(&tile), "{width}: {rows} rows of {tile}");
        }
        // What a window of 1,280 points leaves, and two smaller ones.
        assert_eq!((fit(724.0).0, fit(500.0).0, fit(300.0).0), (1, 2, 3));
    }
}
