//! Choosing keys, in the window of the help: a layout, and single keys by a press on what is to be another.

use crate::game::{
    hud::{
        style::{self, weak},
        widgets::name,
        window::scroll,
    },
    input::{
        bindings::{Binding, Bindings, Group, Slot},
        keymap::Keymap,
        layouts::Layout,
        rebind::{KeyEditor, KeyOrder},
    },
    language::spoken,
    orders::{Order, Orders},
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Res, ResMut},
};
use bevy_egui::egui::{self, Align, Color32, Grid, Layout as Direction, RichText, Ui, vec2};
use tr::tr;

/// Width of the column of names, points.
const NAMES: f32 = 236.0;
/// Width of all, points, if the screen has it.
const WIDTH: f32 = 960.0;
/// Between two keys of an action, points.
const GAP: f32 = 6.0;
/// Smallest size of a key, points.
const KEY: egui::Vec2 = vec2(58.0, 22.0);
/// Height of all but the list, points.
const REST: f32 = 268.0;

/// What keys are chosen with.
#[derive(SystemParam)]
pub struct KeyChoice<'w> {
    bindings: Res<'w, Bindings>,
    keymap: Res<'w, Keymap>,
    editor: ResMut<'w, KeyEditor>,
    orders: ResMut<'w, Orders>,
}

impl KeyChoice<'_> {
    /// The keys as they are.
    pub fn bindings(&self) -> &Bindings {
        &self.bindings
    }

    /// Whether keys are being chosen.
    pub fn is_open(&self) -> bool {
        self.editor.open
    }

    /// The button that leads here.
    pub fn way_in(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            if ui.button(tr!("Change keys")).clicked() {
                self.editor.open = true;
            }
            let layout = self.keymap.layout().name();
            let told = match self.keymap.is_changed() {
                true => tr!("Layout: {}, with changes of your own. Keys stand where a US keyboard has them.", layout),
                false => tr!("Layout: {}. Keys stand where a US keyboard has them.", layout),
            };
            ui.label(weak(told).small());
        });
        ui.add_space(2.0);
    }

    /// Shows the list in which each key can be pressed.
    pub fn show(&mut self, ui: &mut Ui) {
        ui.set_width(WIDTH.min(ui.ctx().content_rect().width() - 48.0));
        self.choose_layout(ui);
        self.say(ui);
        ui.separator();
        scroll(ui, REST, |ui| {
            ui.set_min_width(ui.available_width());
            columns(ui, |ui, group| self.section(ui, group));
        });
    }

    fn choose_layout(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.label(weak(tr!("Layout")));
            let now = self.keymap.layout();
            for layout in Layout::ALL {
                if ui.selectable_label(layout == now, layout.name()).clicked() && layout != now {
                    self.orders.push(Order::Keys(KeyOrder::Layout(layout)));
                }
            }
            ui.add_space(12.0);
            let reset = ui.add_enabled(self.keymap.is_changed(), egui::Button::new(tr!("Reset all")));
            if reset.on_hover_text(tr!("every key as the layout has it")).clicked() {
                self.orders.push(Order::Keys(KeyOrder::Reset));
            }
            ui.with_layout(Direction::right_to_left(Align::Center), |ui| {
                if ui.button(tr!("Done")).clicked() {
                    *self.editor = KeyEditor::default();
                }
            });
        });
    }

    /// What to do now, or what was done.
    fn say(&self, ui: &mut Ui) {
        let (text, colour) = match (self.editor.told(), self.editor.asked()) {
            (Some(told), _) if told.warning => (told.text.clone(), style::WARN),
            (Some(told), _) => (told.text.clone(), style::GOOD),
            (None, Some(slot)) => {
                let action = slot.action.label(&self.bindings.help(slot.action));
                (
                    tr!("Press a key for “{action}”, with Ctrl, Shift or Alt if you like. Esc leaves it", action),
                    style::ACCENT,
                )
            }
            (None, None) => (tr!("Press what is to be on another key. A key in use changes places."), style::WEAK),
        };
        ui.label(RichText::new(text).color(colour));
    }

    fn section(&mut self, ui: &mut Ui, group: Group) {
        let rows: Vec<Binding> =
            self.bindings.changeable().into_iter().filter(|row| row.group == group).copied().collect();
        ui.add_space(4.0);
        ui.label(RichText::new(spoken(group.title())).heading().color(style::ACCENT));
        Grid::new(("keys", group.title())).num_columns(2).min_col_width(NAMES).spacing([10.0, 3.0]).show(ui, |ui| {
            for row in rows {
                self.row(ui, &row);
                ui.end_row();
            }
        });
        ui.add_space(6.0);
    }

    fn row(&mut self, ui: &mut Ui, row: &Binding) {
        let help = spoken(row.help);
        let label = row.action.label(&help);
        let changed = self.keymap.has_changed(row.action);
        ui.label(if changed { RichText::new(&label).color(style::ACCENT) } else { RichText::new(&label) })
            .on_hover_text(help);
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            for (place, chord) in self.bindings.chords(row.action).into_iter().enumerate() {
                let slot = Slot { action: row.action, place };
                let asked = self.editor.asked() == Some(slot);
                let (text, colour) = match asked {
                    true => (tr!("press a key …"), Color32::WHITE),
                    false => (chord.to_string(), if changed { style::ACCENT } else { style::TEXT }),
                };
                let button = egui::Button::new(RichText::new(text).color(colour)).selected(asked).min_size(KEY);
                let response = ui.add(button);
                name(&response, &format!("{label}: {chord}"), asked);
                if response.clicked() {
                    self.editor.ask(slot);
                }
            }
        });
    }
}

/// The groups in two columns.
pub fn columns(ui: &mut Ui, mut show: impl FnMut(&mut Ui, Group)) {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 28.0;
        for groups in [&Group::ALL[..2], &Group::ALL[2..]] {
            ui.vertical(|ui| groups.iter().for_each(|group| show(ui, *group)));
        }
    });
}
