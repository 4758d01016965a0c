//! Finds elements and tools by their names.

use crate::{
    game::{
        actions::{Action, PanelId},
        hud::{widgets::line, window::PanelWindow},
        icons,
        input::bindings::{Group, NONE},
        orders::{Order, Orders},
        panels::Panel,
        tools::Tool,
    },
    kernel::element::ElementTable,
    sim::state::Setup,
};
use bevy::prelude::{KeyCode, Local, Res, ResMut, Result};
use bevy_egui::egui::{self, Align2, Color32, Key, Ui, vec2};

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("search"),
    title: "Search",
    icon: icons::question,
    keys: &[(KeyCode::KeyE, NONE)],
    group: Group::Choose,
    help: "search elements and tools",
    in_bar: false,
    in_list: None,
    stays: false,
};

/// Shows the search.
pub fn show(mut window: PanelWindow, mut text: Local<String>, setup: Res<Setup>, mut orders: ResMut<Orders>) -> Result {
    let mut done = false;
    window.show(&PANEL, (Align2::CENTER_TOP, vec2(0.0, 120.0)), |ui| {
        ui.set_width(260.0);
        let field = egui::TextEdit::singleline(&mut *text).hint_text("element or tool").desired_width(f32::INFINITY);
        ui.add(field.char_limit(40)).request_focus();
        let found = find(setup.elements(), &text);
        let entered = ui.input(|input| input.key_pressed(Key::Enter));
        let mut chosen = found.first().filter(|_| entered);
        ui.spacing_mut().item_spacing.y = 2.0;
        egui::ScrollArea::vertical().max_height(ui.ctx().content_rect().height() - 320.0).show(ui, |ui| {
            for tool in &found {
                if row(ui, *tool, setup.elements(), Some(tool) == found.first()) {
                    chosen = Some(tool);
                }
            }
        });
        if found.is_empty() {
            ui.weak("nothing of that name");
        }
        orders.extend(chosen.map(|tool| Order::Act(Action::Tool(*tool))));
        done = entered || chosen.is_some() || ui.input(|input| input.key_pressed(Key::Escape));
    })?;
    if done {
        window.close(PANEL.id);
    }
    if !window.is_open(PANEL.id) {
        text.clear();
    }
    Ok(())
}

fn row(ui: &mut Ui, tool: Tool, elements: &ElementTable, first: bool) -> bool {
    let (rect, response) = line(ui, 28.0, 36.0, (tool.name(elements), Color32::WHITE), first);
    let (icon, colour) = tool.icon(elements);
    icons::draw(ui.painter(), icons::square(rect.left_center() + vec2(18.0, 0.0), 18.0), icon, colour);
    response.clicked()
}

/// Tools whose name holds the text; those that begin with it first.
fn find(elements: &ElementTable, text: &str) -> Vec<Tool> {
    let text = text.trim().to_lowercase();
    let mut found: Vec<Tool> =
        Tool::all(elements).filter(|tool| tool.name(elements).to_lowercase().contains(&text)).collect();
    found.sort_by_key(|tool| !tool.name(elements).to_lowercase().starts_with(&text));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn search_finds_by_part_and_puts_beginnings_first() {
        let elements = crate::scene::elements().expect("the table that comes with the game is valid");
        let names = |text: &str| -> Vec<String> {
            find(&elements, text).into_iter().map(|tool| tool.name(&elements).to_owned()).collect()
        };
        assert_eq!(names("wat")[0], "water");
        assert_eq!(names("W")[..2], ["water", "wind"]);
        assert_eq!(names("xyzzy"), [""; 0]);
    }
}
