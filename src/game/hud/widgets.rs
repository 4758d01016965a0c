//! Buttons and menus that several parts of the HUD have.

use crate::{
    game::{
        hud::style,
        icons::{self, Icon},
    },
    kernel::params::{Preset, Quality},
};
use bevy_egui::egui::{self, Color32, RichText, Ui, vec2};

/// The menu of qualities under a button; says which one is chosen.
pub fn quality_menu(button: &egui::Response, now: Preset) -> Option<Preset> {
    let mut chosen = None;
    menu(button, "Quality", |ui| {
        for preset in Preset::ALL {
            if row(ui, preset.name(), about(preset), preset == now) {
                chosen = Some(preset);
            }
        }
    });
    chosen
}

/// A quality on the screen: its name, or substeps × iterations where it lies between two names.
pub fn quality_name(preset: Preset, quality: &Quality) -> String {
    if *quality == preset.quality() {
        return preset.name().to_owned();
    }
    format!("{} × {}", quality.substeps, quality.iterations)
}

fn about(preset: Preset) -> &'static str {
    match preset {
        Preset::Classic => "the plain method",
        Preset::Draft => "for weak machines",
        Preset::Fast => "cheap and calm",
        Preset::Balanced => "the default",
        Preset::Fine => "for deep water",
        Preset::Reference => "not in real time",
    }
}

/// A menu under a button.
pub fn menu(button: &egui::Response, title: &str, add: impl FnOnce(&mut Ui)) {
    egui::Popup::menu(button).gap(8.0).width(220.0).show(|ui| {
        ui.label(RichText::new(title).small().color(style::WEAK));
        ui.spacing_mut().item_spacing.y = 2.0;
        add(ui);
    });
}

/// A line of a menu: a name and something about it.
pub fn row(ui: &mut Ui, name: &str, about: &str, chosen: bool) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 26.0), egui::Sense::click());
    if chosen || response.hovered() {
        let fill = if chosen { style::ACCENT_FILL } else { style::BUTTON_HOVER };
        ui.painter().rect_filled(rect, style::BUTTON_CORNER, fill);
    }
    let colour = if chosen { Color32::WHITE } else { style::TEXT };
    let font = |style: egui::TextStyle| style.resolve(ui.style());
    let (left, right) = (rect.left_center() + vec2(9.0, 0.0), rect.right_center() - vec2(9.0, 0.0));
    ui.painter().text(left, egui::Align2::LEFT_CENTER, name, font(egui::TextStyle::Button), colour);
    ui.painter().text(right, egui::Align2::RIGHT_CENTER, about, font(egui::TextStyle::Small), style::WEAK);
    style::name(&response, name, chosen);
    response.clicked()
}

/// A button with an icon, and a text if there is room.
pub fn icon_button(ui: &mut Ui, icon: Icon, text: Option<&str>, active: bool) -> egui::Response {
    let galley = text.map(|text| {
        let font = egui::TextStyle::Button.resolve(ui.style());
        ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER)
    });
    let width = galley.as_ref().map_or(32.0, |galley| 40.0 + galley.size().x);
    let (rect, response) = ui.allocate_exact_size(vec2(width, 26.0), egui::Sense::click());
    let widget = ui.style().interact(&response);
    let (fill, colour) = match active {
        true => (style::ACCENT_FILL, style::ACCENT),
        false => (widget.bg_fill, widget.fg_stroke.color),
    };
    ui.painter().rect_filled(rect, style::BUTTON_CORNER, fill);
    let square = icons::square(rect.left_center() + vec2(16.0, 0.0), 15.0);
    icons::draw(ui.painter(), square, icon, colour);
    if let Some(galley) = galley {
        let at = egui::pos2(rect.left() + 29.0, rect.center().y - galley.size().y / 2.0);
        ui.painter().galley(at, galley, colour);
    }
    if let Some(text) = text {
        style::name(&response, text, active);
    }
    response
}
