//! All elements by their categories, and the tools: to look at, to find by name and to choose from.

use crate::{
    game::{
        actions::{Action, PanelId},
        hud::{
            panels::mixer,
            style::{self, weak},
            tiles::Tiles,
            widgets::{icon_button, keep_focus},
            window::{PanelWindow, scroll},
        },
        icons,
        input::{
            bindings::{Group, NONE},
            mouse_keys::MouseKeys,
        },
        language::spoken,
        orders::{Order, Orders},
        panels::Panel,
        toolbox::Toolbox,
        tools::{Tool, spaced},
    },
    kernel::element::ElementTable,
};
use bevy::prelude::{KeyCode, Local, Res, ResMut, Result};
use bevy_egui::egui::{self, Align, Align2, Key, Layout, Rect, Stroke, StrokeKind, Ui, Vec2, vec2};
use tr::tr;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("elements"),
    title: "Elements",
    icon: icons::all,
    keys: &[(KeyCode::KeyE, NONE)],
    group: Group::Choose,
    help: "all elements and tools, and search",
    in_bar: false,
    in_list: None,
    stays: false,
};

/// Size of a tile, points.
const TILE: Vec2 = vec2(62.0, 52.0);
/// Between tiles, points.
const GAP: f32 = 4.0;
/// Tiles in a row.
const COLUMNS: f32 = 8.0;
/// Height of all but the tiles, the bars among it, points.
const REST: f32 = 290.0;

/// Shows the panel.
pub fn show(
    mut window: PanelWindow,
    mut text: Local<String>,
    mut tiles: Tiles,
    (tools, mouse_keys): (Res<Toolbox>, Res<MouseKeys>),
    mut orders: ResMut<Orders>,
) -> Result {
    let mut done = false;
    window.show(&PANEL, (Align2::CENTER_TOP, vec2(0.0, 64.0)), |ui| {
        // The scroll bar has its own room.
        ui.set_width(COLUMNS * (TILE.x + GAP) + 8.0);
        let field = egui::TextEdit::singleline(&mut *text).hint_text(tr!("search")).desired_width(f32::INFINITY);
        let field = ui.add(field.char_limit(40).margin(vec2(8.0, 5.0)));
        // A field in focus would have the keys that move the pointer.
        if !mouse_keys.0 {
            keep_focus(&field);
        }
        let found = find(tiles.elements(), &text);
        // While nothing is searched, nothing is found first.
        let first = found.first().copied().filter(|_| !text.trim().is_empty());
        let entered = ui.input(|input| input.key_pressed(Key::Enter));
        let mut chosen = first.filter(|_| entered);
        scroll(ui, REST, |ui| {
            for (title, group) in Tool::groups(tiles.elements(), &found) {
                ui.label(weak(spoken(title)).small());
                ui.scope(|ui| {
                    ui.spacing_mut().item_spacing = Vec2::splat(GAP);
                    ui.horizontal_wrapped(|ui| {
                        for tool in group {
                            let response = tiles.show(ui, TILE, 1.0, tool, tool == tools.tool);
                            // Not so in the bar, over which the pointer often rests while a digit is to choose.
                            tiles.keep_by_digit(tool, &response);
                            if first == Some(tool) {
                                mark(ui, response.rect);
                            }
                            chosen = chosen.or(response.clicked().then_some(tool));
                        }
                    });
                });
            }
        });
        if found.is_empty() {
            ui.label(weak(tr!("Nothing of that name.")));
        }
        ui.add_space(4.0);
        let [first, last] = ['1', '0'].map(|digit| tiles.key(Action::Element(digit)));
        ui.horizontal(|ui| {
            let hint = tr!("Point at an element and press one of {first} … {last} to keep it there.", first, last);
            ui.label(weak(hint).small());
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let action = Action::Panel(mixer::PANEL.id);
                if icon_button(ui, (icons::flask, &tr!("mixer")), &tr!("Mix your own"), false)
                    .on_hover_text(tiles.tip(action))
                    .clicked()
                {
                    orders.push(Order::Act(action));
                    done = true;
                }
            });
        });
        orders.extend(chosen.map(|tool| Order::Act(Action::Tool(tool))));
        done |= entered || chosen.is_some() || ui.input(|input| input.key_pressed(Key::Escape));
    })?;
    if done {
        window.close(PANEL.id);
    }
    if !window.is_open(PANEL.id) {
        text.clear();
    }
    Ok(())
}

/// Marks what Enter takes.
fn mark(ui: &Ui, rect: Rect) {
    let painter = ui.painter();
    painter.rect_stroke(rect, style::BUTTON_CORNER, Stroke::new(1.5, style::WARN), StrokeKind::Inside);
    icons::draw(
        painter,
        Rect::from_min_size(rect.left_top() + vec2(4.0, 3.0), Vec2::splat(11.0)),
        icons::enter,
        style::WARN,
    );
}

/// Elements and tools whose name holds the text, and tools of whose help a word begins with it; those whose names begin
/// with it first, and those whose names hold it before the rest. It is looked for in the player's language and in English.
fn find(elements: &ElementTable, text: &str) -> Vec<Tool> {
    let text = text.trim().to_lowercase();
    let rank = |tool: &Tool| {
        let names = [tool.label(elements), spaced(tool.name(elements))].map(|name| name.to_lowercase());
        let helps = [spoken(tool.help()), tool.help().to_owned()].map(|help| help.to_lowercase());
        let begins =
            |help: &String| help.split(|letter: char| !letter.is_alphanumeric()).any(|word| word.starts_with(&text));
        match names.iter().filter_map(|name| name.find(&text)).min() {
            Some(0) => Some(0),
            Some(_) => Some(1),
            None => helps.iter().any(begins).then_some(2),
        }
    };
    let mut found: Vec<(u8, Tool)> = Tool::all(elements).filter_map(|tool| Some((rank(&tool)?, tool))).collect();
    found.sort_by_key(|(rank, _)| *rank);
    found.into_iter().map(|(_, tool)| tool).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<String> {
        let elements = crate::scene::elements().expect("the table that comes with the game is valid");
        find(&elements, text).into_iter().map(|tool| tool.label(&elements)).collect()
    }

    #[test]
    fn search_finds_by_part_and_puts_beginnings_first() {
        assert_eq!(names("wat")[0], "water");
        assert_eq!(names("SAND"), ["sand", "wet sand"]);
        assert!(names("w").iter().take(4).all(|name| name.starts_with('w')), "{:?}", names("w"));
        assert_eq!(names("xyzzy"), [""; 0]);
    }

    #[test]
    fn search_finds_a_tool_by_what_its_help_says_it_does() {
        assert_eq!(names("temp"), ["degrees"]);
        assert_eq!(names("cools"), ["heat"]);
        assert_eq!(names("fire")[0], "fire", "a name comes first");
        assert!(names("fire").contains(&"ignite".to_owned()));
        assert!(!names("emperature").contains(&"degrees".to_owned()), "words count from their beginnings");
    }

    #[test]
    fn names_have_spaces_on_the_screen_and_are_found_by_them() {
        assert_eq!(names("t s"), ["wet sand"]);
        assert!(names("").iter().all(|name| !name.contains('_')));
    }
}
