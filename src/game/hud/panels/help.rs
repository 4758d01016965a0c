//! The table of keys, made from the bindings, and the way to choose others.

use crate::game::{
    actions::PanelId,
    hud::{
        panels::keys::{KeyChoice, columns},
        style::{self, weak},
        window::{MIDDLE, PanelWindow, scroll},
    },
    icons,
    input::{
        bindings::{Binding, Bindings, Group, NONE, SHIFT},
        rebind::KeyEditor,
    },
    language::spoken,
    panels::{Panel, Panels, is_open},
};
use bevy::prelude::{App, DetectChangesMut, IntoScheduleConfigs, KeyCode, ResMut, Result, Update, not};
use bevy_egui::egui::{self, RichText, Ui};
use std::collections::BTreeSet;

/// Width that keys take at least, and at most, and their meanings at most, points.
const KEYS_WIDTH: f32 = 132.0;
const KEYS: f32 = 170.0;
const HELP: f32 = 370.0;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("help"),
    title: "Keys and mouse",
    icon: icons::question,
    keys: &[(KeyCode::F1, NONE), (KeyCode::Slash, SHIFT)],
    group: Group::Look,
    help: "this help",
    in_bar: true,
    in_list: None,
    stays: false,
};

/// The same while keys are chosen: a window of another size.
const CHOICE: Panel = Panel { title: "Change keys", ..PANEL };

/// Adds it.
pub fn plugin(app: &mut App) {
    Panels::add(app, PANEL, show);
    app.add_systems(Update, end_choice.run_if(not(is_open(PANEL.id))));
}

/// Whoever opens the help again wants to read.
fn end_choice(mut editor: ResMut<KeyEditor>) {
    editor.set_if_neq(KeyEditor::default());
}

/// Shows the help.
fn show(mut window: PanelWindow, mut choice: KeyChoice) -> Result {
    match choice.is_open() {
        true => window.show(&CHOICE, MIDDLE, |ui| choice.show(ui)),
        false => window.show(&PANEL, MIDDLE, |ui| read(ui, &mut choice)),
    }
}

fn read(ui: &mut Ui, choice: &mut KeyChoice) {
    choice.way_in(ui);
    ui.spacing_mut().interact_size.y = 17.0;
    scroll(ui, 224.0, |ui| {
        columns(ui, |ui, group| section(ui, choice.bindings(), group));
    });
}

fn section(ui: &mut Ui, bindings: &Bindings, group: Group) {
    ui.add_space(4.0);
    ui.label(RichText::new(spoken(group.title())).heading().color(style::ACCENT));
    egui::Grid::new(group.title()).num_columns(2).min_col_width(KEYS_WIDTH).spacing([14.0, 4.0]).show(ui, |ui| {
        for (keys, help) in rows(bindings, group) {
            narrow(ui, KEYS, keys.into());
            narrow(ui, HELP, weak(spoken(help)));
            ui.end_row();
        }
    });
    ui.add_space(6.0);
}

/// A text that wraps where it is wider than it may be.
fn narrow(ui: &mut Ui, most: f32, text: RichText) {
    ui.scope(|ui| {
        ui.set_max_width(most);
        ui.add(egui::Label::new(text).wrap());
    });
}

/// Keys, and meaning in English; bindings of the same meaning share a row.
fn rows(bindings: &Bindings, group: Group) -> Vec<(String, &'static str)> {
    let mut rows: Vec<(Vec<&Binding>, &'static str)> = Vec::new();
    for binding in bindings.iter().filter(|binding| binding.group == group) {
        match rows.iter_mut().find(|(_, help)| *help == binding.help) {
            Some((same, _)) => same.push(binding),
            None => rows.push((vec![binding], binding.help)),
        }
    }
    rows.into_iter().map(|(same, help)| (names(&same), help)).collect()
}

/// What triggers are called, each once. Ten digits in a row say no more than the first and the last.
fn names(bindings: &[&Binding]) -> String {
    let mut names: Vec<String> = Vec::new();
    for run in bindings.chunk_by(|a, b| are_digits(a, b)) {
        match run {
            [first, _, .., last] => names.push(format!("{first} … {last}")),
            _ => names.extend(run.iter().map(ToString::to_string)),
        }
    }
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names.join(", ")
}

fn are_digits(a: &Binding, b: &Binding) -> bool {
    let is_digit =
        |binding: &Binding| binding.chord().is_some_and(|chord| format!("{:?}", chord.key).starts_with("Digit"));
    a.mods == b.mods && is_digit(a) && is_digit(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::{
        actions::Action,
        input::{bindings::Slot, chord::Chord, keymap::Keymap},
    };

    #[test]
    fn help_names_every_binding_once_by_its_meaning() {
        let mut app = App::new();
        crate::game::hud::panels::plugin(&mut app);
        let bindings = app.world().resource::<Bindings>();
        let all: Vec<_> = Group::ALL.into_iter().flat_map(|group| rows(bindings, group)).collect();
        for binding in bindings.iter() {
            let of_meaning = all.iter().filter(|(_, help)| *help == binding.help).count();
            assert_eq!(of_meaning, 1, "`{}` must stand in the help once", binding.help);
        }
        assert!(all.iter().any(|(keys, help)| keys == "Space, P" && *help == "pause"), "{all:?}");
        assert!(all.iter().any(|(keys, _)| keys == "1 … 0"), "{all:?}");
    }

    #[test]
    fn help_names_the_key_that_an_action_was_put_on() {
        let mut app = App::new();
        crate::game::hud::panels::plugin(&mut app);
        let mut bindings = app.world_mut().resource_mut::<Bindings>();
        for (action, place, key) in [
            (Action::Pause, 0, KeyCode::KeyU),
            (Action::Element('3'), 0, KeyCode::F8),
            (Action::Panel(PANEL.id), 0, KeyCode::Comma),
        ] {
            Keymap::default().choose(&mut bindings, Slot { action, place }, Chord::new(key, NONE));
        }
        let all: Vec<_> = Group::ALL.into_iter().flat_map(|group| rows(&bindings, group)).collect();
        for (keys, help) in [("U, P", "pause"), (",, ?", PANEL.help)] {
            assert!(all.contains(&(keys.to_owned(), help)), "{keys}: {all:?}");
        }
        assert!(all.iter().any(|(keys, _)| keys == "1, 2, F8, 4 … 0"), "{all:?}");
        assert!(bindings.tip(Action::Pause).ends_with("(U)"));
    }
}
