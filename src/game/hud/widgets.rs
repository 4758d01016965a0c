//! Buttons, lines and menus that several parts of the HUD have. What is painted by hand gets its name for scripts and screen
//! readers here.

use crate::{
    game::{
        actions::Action,
        hud::style::{self, weak},
        icons::{self, Icon},
        input::bindings::Bindings,
        orders::{Order, Orders},
    },
    kernel::params::{Preset, Quality},
    sim::numbers,
};
use bevy_egui::egui::{self, Align2, Color32, Rect, Response, RichText, TextStyle, Ui, Vec2, vec2};
use tr::tr;

/// What a line of a list is filled with, and what under the pointer.
pub const LINE: [Color32; 2] = [Color32::TRANSPARENT, style::BUTTON_HOVER];
/// The same of a button.
pub const BUTTON: [Color32; 2] = [style::BUTTON, style::BUTTON_HOVER];

/// Gives what is painted by hand a name for scripts and screen readers, and says whether it is chosen.
pub fn name(response: &Response, name: &str, chosen: bool) {
    let enabled = response.enabled();
    response.widget_info(|| egui::WidgetInfo::selected(egui::WidgetType::Button, enabled, chosen, name));
}

/// An empty field to press, of `size` points.
pub fn field(ui: &mut Ui, size: Vec2, called: &str, chosen: bool, [rest, hovered]: [Color32; 2]) -> (Rect, Response) {
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click());
    let fill = if response.hovered() { hovered } else { rest };
    ui.painter().rect_filled(rect, style::BUTTON_CORNER, if chosen { style::ACCENT_FILL } else { fill });
    name(&response, called, chosen);
    (rect, response)
}

/// A line of a list, `height` points high, with its text `indent` points from the left.
pub fn line(ui: &mut Ui, height: f32, indent: f32, (text, colour): (&str, Color32), chosen: bool) -> (Rect, Response) {
    let (rect, response) = field(ui, vec2(ui.available_width(), height), text, chosen, LINE);
    let font = TextStyle::Button.resolve(ui.style());
    ui.painter().text(rect.left_center() + vec2(indent, 0.0), Align2::LEFT_CENTER, text, font, colour);
    (rect, response)
}

/// A text at the right of its cell: numbers in a column stand one under the other.
pub fn to_the_right(ui: &mut Ui, text: impl Into<egui::WidgetText>) -> Response {
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label(text)).inner
}

/// The menu of qualities under a button; says which one is chosen.
pub fn quality_menu(button: &Response, now: Preset) -> Option<Preset> {
    let mut chosen = None;
    menu(button, &tr!("Quality"), |ui| {
        for preset in Preset::ALL {
            if row(ui, preset.name(), &about(preset), preset == now) {
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

fn about(preset: Preset) -> String {
    match preset {
        Preset::Classic => tr!("the plain method"),
        Preset::Draft => tr!("for weak machines"),
        Preset::Fast => tr!("cheap and calm"),
        Preset::Balanced => tr!("the default"),
        Preset::Fine => tr!("even density, fine air"),
        Preset::Reference => tr!("fine, twice the detail"),
    }
}

/// Details to choose from, beside which a quality may have its own.
const DETAILS: [(f64, &str); 5] = [(0.25, "¼"), (0.5, "½"), (1.0, "1"), (2.0, "2"), (4.0, "4")];

/// A detail on the screen.
pub fn detail_name(detail: f64) -> String {
    let known = DETAILS.iter().find(|(known, _)| (detail / known - 1.0).abs() < 1e-3);
    known.map_or_else(|| numbers::short(detail as f32), |(_, name)| (*name).to_owned())
}

/// The row of details; says which one is chosen.
pub fn detail_row(ui: &mut Ui, now: f64) -> Option<f64> {
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.label(weak(tr!("Detail"))).on_hover_text(tr!(
            "How many times finer than the scene's own the particles are. Twice the detail takes four times the \
             particles, and time eight times as much or more; the error of the shape falls to a quarter at best"
        ));
        for (detail, text) in DETAILS {
            let response = ui.selectable_label((now / detail - 1.0).abs() < 1e-3, text);
            name(&response, &tr!("detail {}", text), false);
            if response.clicked() {
                chosen = Some(detail);
            }
        }
    });
    chosen
}

/// A menu under a button.
pub fn menu(button: &Response, title: &str, add: impl FnOnce(&mut Ui)) {
    egui::Popup::menu(button).gap(8.0).width(220.0).show(|ui| {
        ui.label(RichText::new(title).small().color(style::WEAK));
        ui.spacing_mut().item_spacing.y = 2.0;
        add(ui);
    });
}

/// A line of a menu: a name and something about it. Whether it was pressed.
pub fn row(ui: &mut Ui, name: &str, about: &str, chosen: bool) -> bool {
    let colour = if chosen { Color32::WHITE } else { style::TEXT };
    let (rect, response) = line(ui, 26.0, 9.0, (name, colour), chosen);
    let font = TextStyle::Small.resolve(ui.style());
    ui.painter().text(rect.right_center() - vec2(9.0, 0.0), Align2::RIGHT_CENTER, about, font, style::WEAK);
    response.clicked()
}

/// The button that a window is about.
pub fn main_button(ui: &mut Ui, text: &str) -> Response {
    let (rect, response) =
        field(ui, vec2(120.0, 32.0), text, false, [style::ACCENT.gamma_multiply(0.8), style::ACCENT]);
    let font = TextStyle::Button.resolve(ui.style());
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, text, font, Color32::WHITE);
    response
}

/// A button with an icon and a name, and a text if that is not empty.
pub fn icon_button(ui: &mut Ui, (icon, name): (Icon, &str), text: &str, active: bool) -> Response {
    let font = TextStyle::Button.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
    let width = if text.is_empty() { 32.0 } else { 40.0 + galley.size().x };
    let (rect, response) = field(ui, vec2(width, 26.0), name, active, BUTTON);
    let colour = if active { style::ACCENT } else { ui.style().interact(&response).fg_stroke.color };
    icons::draw(ui.painter(), icons::square(rect.left_center() + vec2(16.0, 0.0), 15.0), icon, colour);
    ui.painter().galley(rect.left_center() + vec2(29.0, -galley.size().y / 2.0), galley, colour);
    response
}

/// A button for what is done as long as a key or it is held.
pub fn hold_button(
    ui: &mut Ui,
    icon: Icon,
    action: Action,
    active: bool,
    (bindings, orders): (&Bindings, &mut Orders),
) {
    let button = icon_button(ui, (icon, &bindings.help(action)), "", active);
    if button.on_hover_text(bindings.tip(action)).is_pointer_button_down_on() {
        orders.push(Order::Act(action));
    }
}

/// A button for what a key does, too: the table of keys says what it is called.
pub fn action_button(
    ui: &mut Ui,
    icon: Icon,
    text: &str,
    action: Action,
    active: bool,
    (bindings, orders): (&Bindings, &mut Orders),
) {
    let button = icon_button(ui, (icon, &bindings.help(action)), text, active);
    if button.on_hover_text(bindings.tip(action)).clicked() {
        orders.push(Order::Act(action));
    }
}

/// Gives a text field the keys while its panel is open. Asked for again in each frame, egui would end what an input method
/// composes, and lead the focus away with the arrows: the next key would be nobody's.
pub fn keep_focus(field: &Response) {
    if !field.has_focus() {
        field.request_focus();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy_egui::egui::{Context, Event, Id, Key, Modifiers, RawInput, TextEdit};

    #[test]
    fn a_field_that_keeps_the_focus_keeps_it_from_arrows_and_escape() {
        let context = Context::default();
        let mut text = String::new();
        let mut frame = |key: Option<Key>| {
            let press =
                |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
            let input = RawInput { events: key.map(press).into_iter().collect(), ..RawInput::default() };
            let mut field = Id::NULL;
            let _ = context.run_ui(input, |ui| {
                ui.horizontal(|ui| {
                    let response = ui.add(TextEdit::singleline(&mut text));
                    keep_focus(&response);
                    field = response.id;
                    let _ = ui.button("beside it");
                });
            });
            context.memory(|memory| memory.focused()) == Some(field)
        };
        for key in [None, None, Some(Key::ArrowRight), None, Some(Key::Escape), None, Some(Key::ArrowRight)] {
            assert!(frame(key), "{key:?} took it away");
        }
    }
}
