//! The buttons while something is in hand, at the upper edge of the world: for the mouse, and large enough for fingers.

use crate::game::{
    actions::{Action, Take},
    edit_icons,
    hud::{
        layout::Bars,
        style,
        widgets::{BUTTON, field},
    },
    icons::{self, Icon},
    input::{bindings::Bindings, touch::Fingers},
    language::spoken,
    orders::{Order, Orders},
    panels::Panels,
    stamps::hand::Hand,
};
use bevy::prelude::{Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, RichText, Ui, Vec2, vec2},
};
use tr::tr;

/// Size of a button for the mouse, points, and for fingers, pixels.
const BUTTONS: [Vec2; 2] = [vec2(36.0, 28.0), vec2(56.0, 48.0)];
/// From the bar above, points, and from the numbers of the touch layout, pixels.
const GAPS: [f32; 2] = [10.0, 44.0];

/// The buttons of a stamp: what they are called for scripts and screen readers, icon, action.
const OF_STAMP: [(&str, Icon, Action); 3] = [
    ("turn the stamp", edit_icons::turn, Action::TurnStamp),
    ("mirror the stamp", edit_icons::mirror, Action::MirrorStamp),
    ("flip the stamp", edit_icons::flip, Action::FlipStamp),
];

/// Shows them.
pub fn show(
    mut contexts: EguiContexts,
    (panels, hand, fingers): (Res<Panels>, Res<Hand>, Res<Fingers>),
    (bars, bindings): (Res<Bars>, Res<Bindings>),
    mut orders: ResMut<Orders>,
) -> Result {
    if hand.is_empty() || !panels.visible {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let (size, gap) = match fingers.in_use {
        true => (BUTTONS[1] / context.zoom_factor(), GAPS[1] / context.zoom_factor()),
        false => (BUTTONS[0], GAPS[0]),
    };
    egui::Area::new("stamp in hand".into())
        .anchor(Align2::CENTER_TOP, vec2(0.0, bars.top + gap))
        .order(egui::Order::Middle)
        .show(context, |ui| {
            egui::Frame::window(ui.style()).inner_margin(6.0).show(ui, |ui| {
                ui.horizontal(|ui| {
                    ui.spacing_mut().item_spacing.x = 6.0;
                    buttons(ui, size, &hand, &bindings, &mut orders);
                });
            });
        });
    Ok(())
}

fn buttons(ui: &mut Ui, size: Vec2, hand: &Hand, bindings: &Bindings, orders: &mut Orders) {
    let mut button = |ui: &mut Ui, (name, icon): (&str, Icon), action: Action, active: bool| {
        let (rect, response) = field(ui, size, &spoken(name), active, BUTTON);
        let colour = if active { style::ACCENT } else { ui.style().interact(&response).fg_stroke.color };
        icons::draw(ui.painter(), icons::square(rect.center(), 0.6 * size.y), icon, colour);
        if response.on_hover_text(bindings.tip(action)).clicked() {
            orders.push(Order::Act(action));
        }
    };
    let text = |ui: &mut Ui, text: String| ui.label(RichText::new(text).color(style::TEXT));
    match hand {
        Hand::Empty => {}
        Hand::Frame(take) => {
            let told = match take {
                Take::Copy => tr!("Drag a frame to copy"),
                Take::Cut => tr!("Drag a frame to cut"),
            };
            text(ui, told);
            button(ui, ("lay it down", icons::close), Action::Close, false);
        }
        Hand::Stamp(..) => {
            text(ui, tr!("Click to paste"));
            for (name, icon, action) in OF_STAMP {
                button(ui, (name, icon), action, false);
            }
            button(ui, ("lay it down", icons::check), Action::Close, false);
        }
    }
}
