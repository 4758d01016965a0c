//! The table of keys, made from the bindings.

use crate::game::{
    actions::PanelId,
    hud::{
        style::{self, weak},
        window::{MIDDLE, PanelWindow, scroll},
    },
    icons,
    input::bindings::{Bindings, Group, NONE, SHIFT},
    panels::Panel,
};
use bevy::prelude::{KeyCode, Res, Result};
use bevy_egui::egui::{self, RichText, Ui};

/// Width of the column of keys, points.
const KEYS_WIDTH: f32 = 132.0;

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

/// Shows the help.
pub fn show(mut window: PanelWindow, bindings: Res<Bindings>) -> Result {
    window.show(&PANEL, MIDDLE, |ui| {
        ui.spacing_mut().interact_size.y = 17.0;
        scroll(ui, 190.0, |ui| {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = 28.0;
                for groups in [&Group::ALL[..2], &Group::ALL[2..]] {
                    ui.vertical(|ui| groups.iter().for_each(|group| section(ui, &bindings, *group)));
                }
            });
        });
    })
}

fn section(ui: &mut Ui, bindings: &Bindings, group: Group) {
    ui.add_space(4.0);
    ui.label(RichText::new(group.title()).heading().color(style::ACCENT));
    egui::Grid::new(group.title()).num_columns(2).min_col_width(KEYS_WIDTH).spacing([14.0, 4.0]).show(ui, |ui| {
        for (keys, help) in rows(bindings, group) {
            ui.label(keys);
            ui.label(weak(help));
            ui.end_row();
        }
    });
    ui.add_space(6.0);
}

/// Keys and meaning; bindings of the same meaning share a row.
fn rows(bindings: &Bindings, group: Group) -> Vec<(String, &'static str)> {
    let mut rows: Vec<(String, &'static str)> = Vec::new();
    for binding in bindings.iter().filter(|binding| binding.group == group) {
        let name = binding.to_string();
        match rows.iter_mut().find(|(_, help)| *help == binding.help) {
            Some((keys, _)) if keys.split(", ").any(|key| key == name) => {}
            Some((keys, _)) => {
                keys.push_str(", ");
                keys.push_str(&name);
            }
            None => rows.push((name, binding.help)),
        }
    }
    for (keys, _) in &mut rows {
        // Ten digits in a row say no more than the first and the last.
        let names: Vec<&str> = keys.split(", ").collect();
        if names.len() > 4 {
            *keys = format!("{} … {}", names[0], names[names.len() - 1]);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy::prelude::App;

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
    }
}
