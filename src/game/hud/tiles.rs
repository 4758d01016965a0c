//! Tiles of elements and tools, the same in the palette, the panel of elements and the tools for fingers; and the card that
//! says what an element is.

use crate::{
    game::{
        actions::Action,
        favourites::Favourites,
        hud::{
            fates::fates,
            labels::lines,
            style::{self, weak},
            widgets::{BUTTON, field},
        },
        icons::{self, Icon},
        input::{bindings::Bindings, pointer::HudCover},
        language::{grouped, spoken},
        tools::{TOOLS, Tool, spaced},
    },
    kernel::element::{Element, ElementTable},
    sim::state::Setup,
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Res, ResMut},
};
use bevy_egui::egui::{self, Color32, FontId, Response, RichText, Stroke, StrokeKind, Ui, Vec2, vec2};
use tr::tr;

/// A tile below this width is narrow, points.
const NARROW: f32 = 52.0;
/// Height of each line of a name that takes two, points.
const LINE: f32 = 13.0;
/// Width of a card, points.
const CARD: f32 = 230.0;

/// What a tile shows.
pub struct Face<'a> {
    /// Its icon and the icon's colour.
    pub icon: (Icon, Color32),
    /// What is written on it.
    pub label: &'a str,
    /// What it is called for scripts and screen readers.
    pub name: &'a str,
    /// The key that does the same; nothing if none does.
    pub key: &'a str,
    /// Whether it is chosen.
    pub chosen: bool,
}

/// Shows a tile. Lengths are times `unit` points.
pub fn tile(ui: &mut Ui, size: Vec2, unit: f32, face: &Face) -> Response {
    let (rect, response) = field(ui, size * unit, face.name, face.chosen, BUTTON);
    let painter = ui.painter();
    if face.chosen {
        let stroke = Stroke::new(1.5 * unit, style::ACCENT);
        painter.rect_stroke(rect, style::BUTTON_CORNER, stroke, StrokeKind::Inside);
    }
    let (text, corner) = if face.chosen { (Color32::WHITE, style::ACCENT) } else { (style::TEXT, style::WEAK) };
    let label = lines(painter, face.label, rect.width() - unit, unit, text);
    let is_long = label.len() > 1;
    let (icon, colour) = face.icon;
    // Beside the letter of a key there is not always room for the icon in the middle, and never beside a longer one.
    let (place, side) = match face.key.chars().count() {
        0 if is_long => (vec2(0.0, size.y / 2.0 - 12.0), 17.0),
        _ if is_long => (vec2(size.x / 2.0 - 12.0, size.y / 2.0 - 12.0), 17.0),
        3.. => (vec2(0.0, 1.5), 15.0),
        1.. if size.x < NARROW => (vec2(3.0, 7.0), 22.0),
        _ => (vec2(0.0, 7.0), 24.0),
    };
    icons::draw(painter, icons::square(rect.center() - place * unit, side * unit), icon, colour);
    let key = painter.layout_no_wrap(face.key.to_owned(), FontId::proportional(style::SMALL * unit), corner);
    // A key that is too long stands in the tooltip.
    let taken = if is_long { 24.0 } else { 4.0 };
    if key.size().x <= rect.width() - taken * unit {
        painter.galley(rect.right_top() + vec2(-3.0 * unit - key.size().x, 2.0 * unit), key, corner);
    }
    let bottom = if is_long { 2.0 } else { 4.0 };
    let mut at = rect.center_bottom() - vec2(0.0, bottom * unit);
    for line in label.into_iter().rev() {
        at.y -= if is_long { LINE * unit } else { line.size().y };
        painter.galley(at - vec2(line.size().x / 2.0, 0.0), line, text);
    }
    response
}

/// The elements and tools that tiles may show.
#[derive(SystemParam)]
pub struct Tiles<'w> {
    setup: Res<'w, Setup>,
    favourites: Res<'w, Favourites>,
    bindings: Res<'w, Bindings>,
    cover: ResMut<'w, HudCover>,
}

impl Tiles<'_> {
    /// The table of elements that is in force.
    pub fn elements(&self) -> &ElementTable {
        self.setup.elements()
    }

    /// The first key of an action.
    pub fn key(&self, action: Action) -> String {
        self.bindings.key(action)
    }

    /// What is said of an action in a tooltip.
    pub fn tip(&self, action: Action) -> String {
        self.bindings.tip(action)
    }

    /// What a bar has: the favourites in the order of their digits, the tools, and what is chosen if it is none of these.
    pub fn in_bar(&self, chosen: Tool) -> Vec<Tool> {
        let slots = self.favourites.slots(self.elements());
        let favourites = slots.into_iter().flatten().map(Tool::Element);
        let mut tools: Vec<Tool> = favourites.chain(TOOLS.into_iter().map(Tool::Other)).collect();
        if !tools.contains(&chosen) {
            tools.push(chosen);
        }
        tools
    }

    /// Shows the tile of an element or a tool. Lengths are times `unit` points.
    pub fn show(&mut self, ui: &mut Ui, size: Vec2, unit: f32, tool: Tool, chosen: bool) -> Response {
        let elements = self.setup.elements();
        let key = match tool {
            Tool::Element(id) => {
                let digit = self.favourites.digit(id, elements);
                digit.map(|digit| self.bindings.key(Action::Element(digit))).unwrap_or_default()
            }
            Tool::Other(_) => self.bindings.key(Action::Tool(tool)),
        };
        let label = tool.label(elements);
        let face = Face { icon: tool.icon(elements), label: &label, name: &label, key: &key, chosen };
        let response = tile(ui, size, unit, &face);
        let Tool::Element(id) = tool else { return response.on_hover_text(self.bindings.tip(Action::Tool(tool))) };
        let element = elements.get(id);
        response.on_hover_ui(|ui| card(ui, elements, element, &key))
    }

    /// A digit puts the element of this tile on itself while the pointer is over it.
    pub fn keep_by_digit(&mut self, tool: Tool, response: &Response) {
        if let Tool::Element(id) = tool
            && is_under_pointer(response)
        {
            self.cover.element = Some(self.setup.elements().get(id).name.clone());
        }
    }
}

/// Whether the pointer is over what is shown of a widget. egui's own answer may be no in the pass after a card came up: how large
/// that is is not known before, and the room that it may take at most lies over the tile.
fn is_under_pointer(response: &Response) -> bool {
    response.ctx.pointer_hover_pos().is_some_and(|pointer| response.interact_rect.contains(pointer))
}

/// What an element is, and what becomes of it.
fn card(ui: &mut Ui, elements: &ElementTable, element: &Element, key: &str) {
    ui.set_width(CARD);
    ui.spacing_mut().item_spacing.y = 4.0;
    ui.spacing_mut().interact_size.y = 0.0;
    let name = RichText::new(spoken(&spaced(&element.name))).size(15.0).color(Color32::WHITE);
    let key = if key.is_empty() { String::new() } else { tr!("key {}", key) };
    egui::Sides::new().show(ui, |ui| ui.label(name), |ui| ui.label(weak(key)));
    if !element.card.is_empty() {
        ui.label(spoken(&element.card));
    }
    ui.add_space(2.0);
    egui::Grid::new("numbers").num_columns(2).spacing([16.0, 2.0]).show(ui, |ui| {
        for (what, number) in numbers(element) {
            ui.label(weak(spoken(what)));
            ui.label(number);
            ui.end_row();
        }
    });
    if element.fixed {
        ui.label(weak(tr!("stays where it is")));
    }
    let fates = fates(elements, element);
    if !fates.is_empty() {
        ui.add_space(2.0);
        egui::Grid::new("fates").num_columns(2).spacing([16.0, 2.0]).show(ui, |ui| {
            for (when, what) in fates {
                ui.label(weak(when));
                ui.label(what);
                ui.end_row();
            }
        });
    }
}

/// The numbers that matter for a player, with their units.
fn numbers(element: &Element) -> Vec<(&'static str, String)> {
    let mut numbers = vec![("density", format!("{} kg/m²", grouped(element.density)))];
    if element.viscosity > 0.0 {
        numbers.push(("viscosity", format!("{} m²/s", element.viscosity)));
    }
    if element.friction > 0.0 {
        numbers.push(("angle of friction", format!("{}°", element.friction)));
    }
    if element.diffusion > 0.0 {
        numbers.push(("diffusion", format!("{} m²/s", element.diffusion)));
    }
    if element.cohesion > 0.0 {
        numbers.push(("cohesion", format!("{} Pa", grouped(element.cohesion))));
    }
    if element.energy > 0.0 {
        numbers.push(("energy", format!("{} MJ/m²", grouped(element.energy))));
    }
    if element.gas > 0.0 {
        numbers.push(("gas", format!("{} m²/m²", element.gas)));
    }
    if let Some(breaks) = &element.breaks {
        numbers.push(("strength", format!("{} kPa/m", grouped(breaks.above / 1000.0))));
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::element::ElementBreak;

    #[test]
    fn a_tile_is_under_the_pointer_also_as_its_card_comes_up() {
        let context = egui::Context::default();
        // Where neither below nor above it there is the room that a card may take.
        let (corner, size) = (egui::pos2(240.0, 280.0), vec2(60.0, 60.0));
        let (mut shown, mut own, mut of_egui) = (0, 0, 0);
        for frame in 0..40 {
            let events = if frame == 0 { vec![egui::Event::PointerMoved(corner + size / 2.0)] } else { Vec::new() };
            let screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, vec2(1100.0, 700.0)));
            let time = Some(f64::from(frame) / 20.0);
            let input = egui::RawInput { events, screen_rect, time, ..egui::RawInput::default() };
            let _output = context.run_ui(input, |ui| {
                let at = egui::UiBuilder::new().max_rect(egui::Rect::from_min_size(corner, size));
                let face = Face { icon: (icons::cloud, style::TEXT), label: "", name: "", key: "", chosen: false };
                let response = ui.scope_builder(at, |ui| tile(ui, size, 1.0, &face)).inner;
                let has_begun = frame > 1;
                shown += u32::from(response.is_tooltip_open());
                own += u32::from(has_begun && !is_under_pointer(&response));
                of_egui += u32::from(has_begun && !response.hovered());
                response.on_hover_ui(|ui| {
                    ui.set_width(CARD);
                    (0..12).for_each(|_| drop(ui.label("what it is")));
                });
            });
        }
        assert!(shown > 0, "no card comes up");
        assert_eq!(own, 0, "the tile is left in {own} passes");
        assert!(of_egui > 0, "egui itself knows what is under a new card: ask it");
    }

    #[test]
    fn a_card_has_the_numbers_that_matter() {
        let mut element = Element { density: 13534.0, ..Element::plain("x", false) };
        assert_eq!(numbers(&element), [("density", "13,534 kg/m²".to_owned())]);
        (element.viscosity, element.friction, element.cohesion) = (0.08, 40.0, 2000.0);
        (element.energy, element.gas) = (1500.0, 30.0);
        element.breaks = Some(ElementBreak { above: 1.5e5, into: "y".to_owned() });
        let told: Vec<String> = numbers(&element).into_iter().map(|(_, number)| number).collect();
        assert_eq!(told, ["13,534 kg/m²", "0.08 m²/s", "40°", "2,000 Pa", "1,500 MJ/m²", "30 m²/m²", "150 kPa/m"]);
    }
}
