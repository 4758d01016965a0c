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
    orders::{Order, Orders},
    panels::Panel,
    render::level::{Level, PictureLevel},
};
use bevy::prelude::{KeyCode, MouseButton, Res, ResMut, Result};

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
    mut scale: ResMut<UiScale>,
    mut level: ResMut<PictureLevel>,
    mut hints: ResMut<Hints>,
    (mouse_keys, bindings): (Res<MouseKeys>, Res<Bindings>),
    mut motion: ResMut<ReducedMotion>,
    mut orders: ResMut<Orders>,
) -> Result {
    window.show(&PANEL, MIDDLE, |ui| {
        ui.label(weak("Size of the HUD"));
        ui.horizontal(|ui| {
            for choice in CHOICES {
                ui.selectable_value(&mut scale.factor, choice, format!("{:.0} %", choice * 100.0));
            }
        });
        ui.label(weak("100 % follows the size of the window.").small());
        ui.label(weak("Picture"));
        ui.horizontal(|ui| {
            let wanted = level.wanted();
            let automatic = format!("automatic ({})", level.now().name());
            let choices = Level::ALL.map(|level| (Some(level), level.name().to_owned()));
            for (choice, name) in [(None, automatic)].into_iter().chain(choices) {
                if ui.selectable_label(wanted == choice, name).clicked() {
                    level.want(choice);
                }
            }
        });
        ui.label(weak("Automatic draws less where frames take longer than 20 ms. The simulation is the same.").small());
        let mut on = hints.are_on();
        if ui.checkbox(&mut on, "Hints").changed() {
            hints.switch(on);
        }
        ui.label(weak("Each is told once. Switched off and on again, all are told anew.").small());
        if ui.checkbox(&mut { mouse_keys.0 }, "Mouse keys").changed() {
            orders.push(Order::Act(Action::MouseKeys));
        }
        let [left, right] = [MouseButton::Left, MouseButton::Right].map(|button| bindings.key(Action::Press(button)));
        ui.label(
            weak(format!(
                "The arrows move the pointer, {left} and {right} are its buttons, Tab takes it to the next control."
            ))
            .small(),
        );
        let mut reduced = motion.is_on();
        if ui.checkbox(&mut reduced, "Reduced motion").changed() {
            motion.chosen = Some(reduced);
        }
        ui.label(weak("Messages don't fade, lists don't glide, and pictures in the gallery stand.").small());
    })
}
