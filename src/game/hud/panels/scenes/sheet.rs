//! The page of a scene: what there is to say and to set about it.

use super::{
    grid::{picture, picture_height},
    menu::SceneMenu,
    pictures::Pictures,
};
use crate::game::{
    hud::{
        style::{self, weak},
        widgets::{BUTTON, detail_row, field, main_button},
    },
    language::spoken,
    orders::Order,
};
use bevy_egui::egui::{self, Align2, Color32, Rect, RichText, Sense, Slider, TextStyle, Ui, vec2};
use tr::tr;

/// Width of the picture and of what stands beside it, points.
const WIDTH: f32 = 330.0;

/// What the player wants.
#[derive(Default)]
pub(super) struct Wish {
    /// To play the scene as it is set up.
    pub(super) play: bool,
    /// To go back to the gallery.
    pub(super) back: bool,
}

/// Shows the page of the scene that is being set up.
pub(super) fn show(ui: &mut Ui, menu: &mut SceneMenu, pictures: &Pictures) -> Wish {
    let (Some(set_up), mut wish) = (&mut menu.set_up, Wish::default()) else { return Wish::default() };
    let entry = &menu.entries[set_up.index];
    ui.horizontal_wrapped(|ui| {
        ui.vertical(|ui| {
            let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, picture_height(WIDTH)), Sense::hover());
            picture(ui, Rect::from_min_size(rect.min, rect.size()), pictures.of(&entry.call));
        });
        ui.vertical(|ui| {
            ui.set_width(WIDTH);
            ui.label(RichText::new(spoken(entry.scene.title())).heading().color(Color32::WHITE));
            ui.label(weak(spoken(entry.scene.description())));
            if !entry.scene.invitation().is_empty() {
                ui.label(RichText::new(spoken(entry.scene.invitation())).color(style::ACCENT));
            }
            ui.add_space(8.0);
            for (name, spec) in entry.scene.parameters() {
                let Some(value) = set_up.values.get_mut(name) else { continue };
                ui.label(weak(spoken(&spec.description)).small());
                let mut slider = Slider::new(value, spec.min..=spec.max).text(name.as_str());
                if spec.integer {
                    slider = slider.integer();
                }
                // A range over orders of magnitude is felt by its logarithm.
                ui.add(slider.logarithmic(spec.min > 0.0 && spec.max / spec.min > 100.0));
            }
            if let Some(detail) = detail_row(ui, set_up.detail) {
                set_up.detail = detail;
            }
            ui.add_space(10.0);
            ui.horizontal(|ui| {
                wish.play = main_button(ui, &tr!("Play")).on_hover_text(tr!("key" => "Enter")).clicked();
                wish.back = button(ui, &tr!("All scenes")).on_hover_text(tr!("key" => "Esc")).clicked();
            });
        });
    });
    wish
}

fn button(ui: &mut Ui, text: &str) -> egui::Response {
    let (rect, response) = field(ui, vec2(100.0, 32.0), text, false, BUTTON);
    let font = TextStyle::Button.resolve(ui.style());
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, text, font, style::TEXT);
    response
}

/// What playing it as it is set up asks for.
pub(super) fn order(menu: &SceneMenu) -> Option<Order> {
    let set_up = menu.set_up.as_ref()?;
    let name = menu.entries.get(set_up.index)?.call.clone();
    let settings = set_up.values.iter().map(|(name, value)| (name.clone(), value.to_string())).collect();
    Some(Order::Scene { name, settings, detail: set_up.detail })
}
