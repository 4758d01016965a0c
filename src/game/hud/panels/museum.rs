//! The museum: known answers as worlds to look at. It stays beside the world that is looked at.

use crate::{
    game::{
        actions::{Action, PanelId},
        hud::{
            museum::THEORY,
            panels::cases::window::Suite,
            style::weak,
            widgets::{menu, name, row},
            window::{PanelWindow, scroll},
        },
        icons,
        input::bindings::{Bindings, Group, SHIFT},
        language::spoken,
        museum::Museum,
        orders::{Order, Orders},
        panels::Panel,
    },
    lab::exam::{
        ExamCase,
        exhibits::{EXHIBITS, Exhibit},
    },
    sim::generation::Generation,
};
use bevy::prelude::{KeyCode, Res, ResMut, Result};
use bevy_egui::egui::{Align2, Color32, RichText, Ui, vec2};
use tr::tr;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("museum"),
    title: "Museum of known answers",
    icon: icons::check,
    keys: &[(KeyCode::F6, SHIFT)],
    group: Group::Look,
    help: "museum: known answers, with theory drawn over the world",
    in_bar: false,
    in_list: Some("Museum of known answers"),
    stays: true,
};

/// Width of its contents, points.
const WIDTH: f32 = 280.0;

/// Shows it.
pub fn show(
    mut window: PanelWindow,
    (museum, generation, bindings): (Res<Museum>, Res<Generation>, Res<Bindings>),
    mut orders: ResMut<Orders>,
) -> Result {
    let shown = museum.shown(*generation);
    window.show(&PANEL, (Align2::RIGHT_TOP, vec2(-14.0, 60.0)), |ui| {
        ui.set_width(WIDTH);
        match shown {
            // Small, so that the world has room.
            Some(exhibit) => about(ui, exhibit, (&bindings, &mut orders)),
            None => {
                ui.label(weak(tr!("Worlds of which the answer is known, and the answer drawn over them.")));
                scroll(ui, 240.0, |ui| orders.extend(list(ui, None)));
            }
        }
    })
}

/// All answers; what is asked for by one that is pressed.
fn list(ui: &mut Ui, shown: Option<&Exhibit>) -> Option<Order> {
    ui.spacing_mut().item_spacing.y = 2.0;
    let mut pressed = None;
    for exhibit in &EXHIBITS {
        if row(ui, &title(exhibit), "", shown.is_some_and(|shown| shown.name == exhibit.name)) {
            pressed = Some(Order::Visit(exhibit.name));
        }
    }
    pressed
}

/// What is to be seen, and what it rests on.
fn about(ui: &mut Ui, exhibit: &'static Exhibit, (bindings, orders): (&Bindings, &mut Orders)) {
    ui.spacing_mut().item_spacing.y = 5.0;
    ui.label(RichText::new(title(exhibit)).size(15.0).color(Color32::WHITE));
    ui.label(RichText::new(spoken(exhibit.drawn)).color(THEORY));
    // Of its Markdown, a line on the screen needs no marks.
    let answer = exhibit.case().map(|case| case.answer.replace('`', "")).unwrap_or_default();
    ui.label(weak(answer).small());
    ui.horizontal(|ui| {
        for (text, action) in [(tr!("Again"), Action::Reset), (tr!("Examine"), Action::Panel(ExamCase::PANEL.id))] {
            let button = ui.button(&text);
            name(&button, &text, false);
            if button.on_hover_text(bindings.tip(action)).clicked() {
                orders.push(Order::Act(action));
            }
        }
        let others = ui.button(tr!("Others …"));
        name(&others, &tr!("other answers"), false);
        menu(&others, &tr!("Known answers"), |ui| {
            scroll(ui, 240.0, |ui| {
                if let Some(order) = list(ui, Some(exhibit)) {
                    orders.push(order);
                    ui.close();
                }
            });
        });
    });
}

fn title(exhibit: &Exhibit) -> String {
    spoken(exhibit.case().map_or(exhibit.name, |case| case.title))
}
