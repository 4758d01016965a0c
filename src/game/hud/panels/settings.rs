//! The settings.

use crate::game::{
    actions::{Action, PanelId},
    hints::Hints,
    hud::{
        layout::{CHOICES, UiScale},
        motion::ReducedMotion,
        style::weak,
        window::{MIDDLE, PanelWindow},
    },
    icons,
    input::{
        bindings::{Bindings, Group, NONE},
        mouse_keys::MouseKeys,
    },
    language::{Language, spoken},
    orders::{Order, Orders},
    panels::Panel,
    render::level::{Level, PictureLevel},
};
use bevy::prelude::{KeyCode, MouseButton, Res, ResMut, Result};
use bevy_egui::egui::Ui;
use tr::tr;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("settings"),
    title: "Settings",
    icon: icons::gear,
    keys: &[(KeyCode::F4, NONE)],
    group: Group::Look,
    help: "settings",
    in_bar: true,
    in_list: Some("Settings"),
    stays: false,
};

/// Shows the settings.
pub fn show(
    mut window: PanelWindow,
    mut language: ResMut<Language>,
    mut scale: ResMut<UiScale>,
    mut level: ResMut<PictureLevel>,
    mut hints: ResMut<Hints>,
    (mouse_keys, bindings): (Res<MouseKeys>, Res<Bindings>),
    mut motion: ResMut<ReducedMotion>,
    mut orders: ResMut<Orders>,
) -> Result {
    window.show(&PANEL, MIDDLE, |ui| {
        ui.label(weak(tr!("Language")));
        if let Some(tag) = languages(ui, &language) {
            language.choose(tag);
        }
        ui.label(weak(tr!("Size of the HUD")));
        ui.horizontal(|ui| {
            for choice in CHOICES {
                ui.selectable_value(&mut scale.factor, choice, format!("{:.0} %", choice * 100.0));
            }
        });
        ui.label(weak(tr!("100 % follows the size of the window.")).small());
        ui.label(weak(tr!("Picture")));
        if let Some(wanted) = levels(ui, &level) {
            level.want(wanted);
        }
        ui.label(
            weak(tr!("Automatic draws less where frames take longer than 20 ms. The simulation is the same.")).small(),
        );
        let mut on = hints.are_on();
        if ui.checkbox(&mut on, tr!("Hints")).changed() {
            hints.switch(on);
        }
        ui.label(weak(tr!("Each is told once. Switched off and on again, all are told anew.")).small());
        if ui.checkbox(&mut { mouse_keys.0 }, tr!("Mouse keys")).changed() {
            orders.push(Order::Act(Action::MouseKeys));
        }
        let [left, right] = [MouseButton::Left, MouseButton::Right].map(|button| bindings.key(Action::Press(button)));
        let keys = tr!(
            "The arrows move the pointer, {left} and {right} are its buttons, Tab takes it to the next control.",
            left,
            right
        );
        ui.label(weak(keys).small());
        let mut reduced = motion.is_on();
        if ui.checkbox(&mut reduced, tr!("Reduced motion")).changed() {
            motion.chosen = Some(reduced);
        }
        ui.label(weak(tr!("Messages don't fade, lists don't glide, and pictures in the gallery stand.")).small());
    })
}

/// The row of languages; says which is chosen, `None` in it being the system's.
fn languages(ui: &mut Ui, language: &Language) -> Option<Option<&'static str>> {
    let automatic = tr!("automatic ({})", language.by_system().name);
    let all = Language::all().iter().map(|known| (Some(known.tag), known.name.clone()));
    choices(ui, language.chosen(), [(None, automatic)].into_iter().chain(all))
}

/// The row of levels of the picture, `None` being what frame times ask for.
fn levels(ui: &mut Ui, level: &PictureLevel) -> Option<Option<Level>> {
    let automatic = tr!("automatic ({})", spoken(level.now().name()));
    let all = Level::ALL.map(|level| (Some(level), spoken(level.name())));
    choices(ui, level.wanted(), [(None, automatic)].into_iter().chain(all))
}

fn choices<T: PartialEq>(ui: &mut Ui, now: T, all: impl IntoIterator<Item = (T, String)>) -> Option<T> {
    let mut chosen = None;
    ui.horizontal(|ui| {
        for (choice, name) in all {
            if ui.selectable_label(now == choice, name).clicked() {
                chosen = Some(choice);
            }
        }
    });
    chosen
}
