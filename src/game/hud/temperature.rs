//! The temperature of the tool that sets one, as a number to drag or to type: beside the brush's size, for the mouse and for fingers.

use crate::{
    game::toolbox::{TEMPERATURE_RANGE, Toolbox},
    kernel::heat::units::CELSIUS,
};
use bevy::prelude::ResMut;
use bevy_egui::egui::{self, Ui, Vec2};
use tr::tr;

/// Degrees of a point of a drag.
const SPEED: f64 = 5.0;

/// Shows it in a field of a size (points), if the chosen tool has one.
pub fn show(ui: &mut Ui, size: Vec2, tools: &mut ResMut<Toolbox>) {
    let Some(kelvin) = tools.kelvin() else { return };
    let mut degrees = kelvin - CELSIUS;
    let range = TEMPERATURE_RANGE.start() - CELSIUS..=TEMPERATURE_RANGE.end() - CELSIUS;
    let value = egui::DragValue::new(&mut degrees).range(range).speed(SPEED).max_decimals(0).suffix(" °C");
    let response = ui.add_sized(size, value).on_hover_text(tr!("temperature to set: drag, or click and type"));
    response.widget_info(|| egui::WidgetInfo::slider(true, f64::from(degrees), tr!("temperature to set")));
    if response.changed() {
        tools.set_kelvin(degrees + CELSIUS);
    }
}
