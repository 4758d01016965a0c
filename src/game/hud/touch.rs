//! The tools for fingers: in place of bar and palette while the player uses fingers. All that can be pressed is at least
//! 48 pixels in size.

use crate::{
    game::{
        actions::Action,
        brush_mode::BrushMode,
        history::History,
        hud::{
            layout::Bars,
            panels::{elements, scenes::panel as scenes},
            stats::{Reading, Readings},
            style::{self, weak},
            temperature,
            tiles::{Face, Tiles, tile},
            widgets::{BUTTON, field},
        },
        icons::{self, Icon},
        input::touch::Fingers,
        language::spoken,
        orders::{Order, Orders},
        panels::{Panel, Panels},
        toolbox::Toolbox,
        tools::Tool,
        views::table::{Shown, VIEWS, View},
    },
    kernel::params::Preset,
    sim::{pace::Pace, state::Setup},
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Local, Res, ResMut, Result},
};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, Color32, RichText, Ui, Vec2, vec2},
};
use tr::tr;

/// Side of what can be pressed, pixels.
const TARGET: f32 = 48.0;
/// Size of a tile, pixels.
const TILE: Vec2 = vec2(60.0, TARGET);

/// What has no button of its own, below the panels in the list.
const MORE: &[(&str, Action)] = &[
    ("Save", Action::Save),
    #[cfg(target_arch = "wasm32")]
    ("Copy a link to this world", Action::CopyLink),
    ("One tick", Action::Step),
    ("Two qualities side by side", Action::Split),
    ("Truth lens: this moment at reference", Action::Lens),
    ("Slower", Action::Speed(-1)),
    ("Faster", Action::Speed(1)),
    ("Bring the air to rest", Action::ClearAir),
];

/// A list that is open above the tools.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Sheet {
    /// None.
    #[default]
    Closed,
    /// All elements and tools.
    Elements,
    /// The views.
    Views,
    /// The qualities.
    Qualities,
    /// The panels, and what else has no button of its own.
    More,
}

/// What the tools show.
#[derive(SystemParam)]
pub struct Scene<'w> {
    panels: Res<'w, Panels>,
    setup: Res<'w, Setup>,
    pace: Res<'w, Pace>,
    history: Res<'w, History>,
    readings: Res<'w, Readings>,
    shown: Res<'w, Shown>,
}

/// Run condition: the player uses fingers.
pub fn in_use(fingers: Res<Fingers>) -> bool {
    fingers.in_use
}

/// Shows the tools, or the one button that brings them back.
pub fn show(
    mut contexts: EguiContexts,
    scene: Scene,
    mut tiles: Tiles,
    mut tools: ResMut<Toolbox>,
    mut bars: ResMut<Bars>,
    mut orders: ResMut<Orders>,
    mut sheet: Local<Sheet>,
) -> Result {
    let Scene { panels, pace, history, readings, .. } = &scene;
    *bars = Bars::default();
    let context = contexts.ctx_mut()?;
    let screen = context.content_rect();
    let unit = 1.0 / context.zoom_factor();
    if !panels.visible {
        *sheet = Sheet::Closed;
        let corner = egui::Area::new("touch again".into()).anchor(Align2::RIGHT_BOTTOM, vec2(-8.0, -8.0) * unit);
        corner.show(context, |ui| {
            if button(ui, unit, (&tr!("Show the tools"), icons::droplet), true, true) {
                orders.push(Order::Act(Action::Hud));
            }
        });
        return Ok(());
    }
    let bar = egui::Area::new("touch".into())
        .anchor(Align2::LEFT_BOTTOM, vec2(0.0, 0.0))
        .order(egui::Order::Middle)
        .constrain(false)
        .show(context, |ui| {
            egui::Frame::new().fill(style::PANEL).inner_margin(4.0).show(ui, |ui| {
                ui.set_width(screen.width() - 8.0);
                ui.spacing_mut().item_spacing = vec2(4.0, 4.0) * unit;
                ui.horizontal_wrapped(|ui| {
                    choose(ui, unit, (&mut tiles, tools.tool), &mut sheet, &mut orders);
                });
                ui.horizontal_wrapped(|ui| {
                    act(ui, unit, pace, history, &mut orders);
                    size(ui, unit, &mut tools, &mut orders);
                    menus(ui, unit, panels, &mut sheet, &mut orders);
                });
            });
        });
    bars.bottom = screen.bottom() - bar.response.rect.top();
    if *sheet != Sheet::Closed {
        let above = screen.with_max_y(bar.response.rect.top());
        let pressed = list(context, above, unit, |ui, width| match *sheet {
            Sheet::Elements => all(ui, width, unit, &mut tiles, tools.tool),
            sheet => press(ui, width, unit, lines(sheet, &scene)),
        });
        if let Some(order) = pressed {
            orders.push(order);
            *sheet = Sheet::Closed;
        }
    }
    egui::Area::new("touch numbers".into()).fixed_pos(egui::pos2(8.0, 6.0)).interactable(false).show(context, |ui| {
        ui.set_max_width(screen.width() - 16.0);
        ui.spacing_mut().item_spacing = vec2(10.0, 2.0) * unit;
        ui.horizontal_wrapped(|ui| {
            for Reading { value, unit: what, .. } in [&readings.total].into_iter().chain(&readings.pace) {
                let text = weak(format!("{value} {what}")).size(12.0 * unit);
                // A number stays with its unit.
                ui.add(egui::Label::new(text).extend());
            }
        });
    });
    Ok(())
}

/// Favourites, tools and the way to all others.
fn choose(ui: &mut Ui, unit: f32, (tiles, chosen): (&mut Tiles, Tool), sheet: &mut Sheet, orders: &mut Orders) {
    for tool in tiles.in_bar(chosen) {
        if tiles.show(ui, TILE, unit, tool, chosen == tool).clicked() {
            orders.push(Order::Act(Action::Tool(tool)));
        }
    }
    let icon = (elements::PANEL.icon, style::TEXT);
    let chosen = *sheet == Sheet::Elements;
    let face = Face { icon, label: &tr!("elements"), name: &tr!("All elements"), key: "", chosen };
    if tile(ui, TILE, unit, &face).clicked() {
        *sheet = if chosen { Sheet::Closed } else { Sheet::Elements };
    }
}

/// A button with an icon; whether it is pressed.
fn button(ui: &mut Ui, unit: f32, face: (&str, Icon), active: bool, enabled: bool) -> bool {
    enabled && pressable(ui, unit, face, active, enabled).clicked()
}

/// A button with an icon, for more than to press it.
fn pressable(ui: &mut Ui, unit: f32, (name, icon): (&str, Icon), active: bool, enabled: bool) -> egui::Response {
    let (rect, response) = field(ui, vec2(TARGET, TARGET) * unit, name, active, BUTTON);
    let colour = match (enabled, active) {
        (false, _) => style::LINE,
        (true, true) => style::ACCENT,
        (true, false) => style::TEXT,
    };
    icons::draw(ui.painter(), icons::square(rect.center(), 22.0 * unit), icon, colour);
    response
}

fn act(ui: &mut Ui, unit: f32, pace: &Pace, history: &History, orders: &mut Orders) {
    let (back, forth) = history.reach();
    let time: Icon = if pace.paused { icons::play } else { icons::pause };
    for (name, icon, action, active, enabled) in [
        (tr!("Hide the tools"), icons::close as Icon, Action::Hud, false, true),
        (tr!("Pause"), time, Action::Pause, pace.paused, true),
        (tr!("Undo"), icons::undo, Action::Undo, false, back),
        (tr!("Redo"), icons::redo, Action::Redo, false, forth),
        (tr!("Reset"), icons::reset, Action::Reset, false, true),
    ] {
        if button(ui, unit, (&name, icon), active, enabled) {
            orders.push(Order::Act(action));
        }
    }
    let rewind = pressable(ui, unit, (&tr!("Back in time"), icons::rewind), pace.rewinds, true);
    if rewind.is_pointer_button_down_on() {
        orders.push(Order::Act(Action::Rewind));
    }
}

/// Size, shape and mode of the brush, and the temperature that it sets.
fn size(ui: &mut Ui, unit: f32, tools: &mut ResMut<Toolbox>, orders: &mut Orders) {
    let mut step = |ui: &mut Ui, text: &str, steps: i32| {
        let text = RichText::new(text).size(20.0 * unit);
        if ui.add_sized(vec2(TARGET, TARGET) * unit, egui::Button::new(text)).clicked() {
            tools.grow(steps);
        }
    };
    step(ui, "−", -1);
    step(ui, "+", 1);
    if button(ui, unit, (&tr!("Shape of the brush"), tools.shape_icon()), false, true) {
        tools.turn_shape();
    }
    let (mode, has_modes) = (tools.mode(), matches!(tools.tool, Tool::Element(_)));
    let mode_name = spoken(mode.name());
    let name = tr!("What the brush does: {}", mode_name);
    if button(ui, unit, (&name, mode.icon()), mode != BrushMode::Draw, has_modes) {
        orders.push(Order::Act(Action::NextBrushMode));
    }
    temperature::show(ui, vec2(1.75 * TARGET, TARGET) * unit, tools);
}

fn menus(ui: &mut Ui, unit: f32, panels: &Panels, sheet: &mut Sheet, orders: &mut Orders) {
    let gallery = scenes::PANEL;
    if button(ui, unit, (&spoken(gallery.title), gallery.icon), panels.shows(gallery.id), true) {
        orders.push(Order::Act(Action::Panel(gallery.id)));
        *sheet = Sheet::Closed;
    }
    for (name, icon, own) in [
        (tr!("Views"), icons::eye as Icon, Sheet::Views),
        (tr!("Qualities"), icons::gauge, Sheet::Qualities),
        (tr!("More"), icons::gear, Sheet::More),
    ] {
        if button(ui, unit, (&name, icon), *sheet == own, true) {
            *sheet = if *sheet == own { Sheet::Closed } else { own };
        }
    }
}

/// The lines of a list: text, whether it is what is shown now, and what choosing it asks for.
fn lines(sheet: Sheet, scene: &Scene) -> Vec<(String, bool, Order)> {
    match sheet {
        // Elements are no lines.
        Sheet::Closed | Sheet::Elements => Vec::new(),
        Sheet::Views => {
            let line = |view: &'static View| (spoken(view.name), view == scene.shown.0, Order::Act(Action::View(view)));
            VIEWS.into_iter().map(line).collect()
        }
        Sheet::Qualities => {
            let line =
                |preset: Preset| (preset.name().to_owned(), preset == scene.setup.preset, Order::Quality(preset));
            Preset::ALL.into_iter().map(line).collect()
        }
        Sheet::More => {
            let line = |(panel, open): (&Panel, bool)| {
                Some((spoken(panel.in_list?), open, Order::Act(Action::Panel(panel.id))))
            };
            let actions = MORE.iter().map(|(text, action)| (spoken(text), false, Order::Act(*action)));
            scene.panels.iter().rev().filter_map(line).chain(actions).collect()
        }
    }
}

/// The open list, with what `add` puts into it: it gets the width of a line, and says what was chosen.
fn list(
    context: &egui::Context,
    above: egui::Rect,
    unit: f32,
    add: impl FnOnce(&mut Ui, f32) -> Option<Order>,
) -> Option<Order> {
    let area = egui::Area::new("touch list".into()).pivot(Align2::CENTER_BOTTOM).fixed_pos(above.center_bottom());
    let area = area.default_height(above.height()).order(egui::Order::Foreground);
    let shown = area.show(context, |ui| {
        let frame = egui::Frame::window(ui.style()).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            let scroll = egui::ScrollArea::vertical().max_height(above.height() - 48.0 * unit);
            scroll.show(ui, |ui| add(ui, above.width() - 64.0 * unit)).inner
        });
        frame.inner
    });
    shown.inner
}

/// Lines to press; what was chosen.
fn press(ui: &mut Ui, width: f32, unit: f32, lines: Vec<(String, bool, Order)>) -> Option<Order> {
    let mut pressed = None;
    for (text, chosen, order) in lines {
        let (rect, response) = field(ui, vec2(width.min(320.0 * unit), TARGET * unit), &text, chosen, BUTTON);
        let font = egui::FontId::proportional(16.0 * unit);
        let at = rect.left_center() + vec2(12.0, 0.0) * unit;
        ui.painter().text(at, Align2::LEFT_CENTER, text, font, Color32::WHITE);
        if response.clicked() {
            pressed = Some(order);
        }
    }
    pressed
}

/// All elements by their categories, and the tools; what was chosen.
fn all(ui: &mut Ui, width: f32, unit: f32, tiles: &mut Tiles, chosen: Tool) -> Option<Order> {
    let mut pressed = None;
    ui.set_width(width.min(8.0 * (TILE.x + 4.0) * unit));
    let every: Vec<Tool> = Tool::all(tiles.elements()).collect();
    let groups = Tool::groups(tiles.elements(), &every);
    for (title, group) in groups {
        ui.label(weak(spoken(title)).size(13.0 * unit));
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing = vec2(4.0, 4.0) * unit;
            ui.horizontal_wrapped(|ui| {
                for tool in group {
                    if tiles.show(ui, TILE, unit, tool, chosen == tool).clicked() {
                        pressed = Some(Order::Act(Action::Tool(tool)));
                    }
                }
            });
        });
    }
    pressed
}
