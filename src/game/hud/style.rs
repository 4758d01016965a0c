//! The look of the HUD: colours, sizes, spacing.

use bevy::prelude::{Added, Query};
use bevy_egui::{
    EguiContext,
    egui::{
        self, Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle,
        Vec2, style::ScrollStyle,
    },
};
use epaint_default_fonts::UBUNTU_LIGHT;
use std::sync::Arc;

/// Behind bars and windows.
pub const PANEL: Color32 = Color32::from_rgb(19, 23, 32);
/// Lines between things.
pub const LINE: Color32 = Color32::from_rgb(43, 51, 68);
/// Things that can be pressed.
pub const BUTTON: Color32 = Color32::from_rgb(31, 38, 52);
/// The same under the pointer.
pub const BUTTON_HOVER: Color32 = Color32::from_rgb(44, 54, 74);
/// Text.
pub const TEXT: Color32 = Color32::from_rgb(216, 223, 234);
/// Text of less weight.
pub const WEAK: Color32 = Color32::from_rgb(150, 162, 183);
/// What is chosen.
pub const ACCENT: Color32 = Color32::from_rgb(86, 168, 255);
/// Behind what is chosen.
pub const ACCENT_FILL: Color32 = Color32::from_rgb(28, 56, 92);
/// What needs attention.
pub const WARN: Color32 = Color32::from_rgb(255, 184, 92);

/// What came out right.
pub const GOOD: Color32 = Color32::from_rgb(104, 211, 145);
/// What came out wrong.
pub const BAD: Color32 = Color32::from_rgb(255, 122, 122);

/// Size of the smallest text, points.
pub const SMALL: f32 = 12.0;

/// How long widgets take to change, s.
pub const FADE: f32 = 0.08;

/// Corner of buttons and tiles.
pub const BUTTON_CORNER: u8 = 6;
/// Corner of windows.
pub const WINDOW_CORNER: u8 = 10;

/// Gives egui this look. It draws no text before it has fonts, so that is done before its first frame.
pub fn apply_to_new(mut contexts: Query<&mut EguiContext, Added<EguiContext>>) {
    for mut context in &mut contexts {
        apply(context.get_mut());
    }
}

/// Fonts, sizes and colours.
pub fn apply(context: &egui::Context) {
    context.set_fonts(fonts());
    context.set_theme(egui::Theme::Dark);
    // The frame that a press wakes has the time at which the game fell asleep: no press is too long for a click.
    context.options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
    context.all_styles_mut(|style| {
        style.text_styles = [
            (TextStyle::Small, FontId::proportional(SMALL)),
            (TextStyle::Body, FontId::proportional(13.5)),
            (TextStyle::Button, FontId::proportional(13.5)),
            (TextStyle::Monospace, FontId::monospace(13.5)),
            (TextStyle::Heading, FontId::proportional(17.0)),
        ]
        .into();
        // A bar beside what it scrolls, not over it.
        style.spacing.scroll = ScrollStyle::solid();
        style.spacing.item_spacing = Vec2::new(8.0, 6.0);
        style.spacing.button_padding = Vec2::new(9.0, 4.0);
        style.spacing.interact_size = Vec2::new(32.0, 24.0);
        style.spacing.window_margin = Margin::same(14);
        style.spacing.menu_margin = Margin::same(8);
        style.spacing.slider_width = 150.0;
        style.spacing.tooltip_width = 320.0;
        style.interaction.selectable_labels = false;
        style.interaction.tooltip_delay = 0.35;
        style.animation_time = FADE;

        let visuals = &mut style.visuals;
        visuals.override_text_color = None;
        visuals.weak_text_color = Some(WEAK);
        visuals.window_fill = PANEL;
        visuals.panel_fill = PANEL;
        visuals.extreme_bg_color = Color32::from_rgb(12, 15, 21);
        visuals.faint_bg_color = Color32::from_rgb(25, 30, 41);
        visuals.window_stroke = Stroke::new(1.0, LINE);
        visuals.window_corner_radius = CornerRadius::same(WINDOW_CORNER);
        visuals.menu_corner_radius = CornerRadius::same(WINDOW_CORNER);
        visuals.window_highlight_topmost = false;
        visuals.window_shadow = Shadow { offset: [0, 6], blur: 22, spread: 0, color: Color32::from_black_alpha(110) };
        visuals.popup_shadow = visuals.window_shadow;
        visuals.selection.bg_fill = ACCENT_FILL;
        visuals.selection.stroke = Stroke::new(1.0, ACCENT);
        visuals.slider_trailing_fill = true;
        visuals.warn_fg_color = WARN;
        let widgets = &mut visuals.widgets;
        for (widget, fill, text) in [
            (&mut widgets.noninteractive, PANEL, TEXT),
            (&mut widgets.inactive, BUTTON, TEXT),
            (&mut widgets.hovered, BUTTON_HOVER, Color32::WHITE),
            (&mut widgets.active, ACCENT_FILL, Color32::WHITE),
            (&mut widgets.open, BUTTON_HOVER, Color32::WHITE),
        ] {
            widget.bg_fill = fill;
            widget.weak_bg_fill = fill;
            widget.bg_stroke = Stroke::NONE;
            widget.fg_stroke = Stroke::new(1.0, text);
            widget.corner_radius = CornerRadius::same(BUTTON_CORNER);
            widget.expansion = 0.0;
        }
        widgets.noninteractive.bg_stroke = Stroke::new(1.0, LINE);
    });
}

/// The font: one for all, of a fiftieth of the page's module. Its digits are as wide as one another, so numbers need no other,
/// and the icons need none.
fn fonts() -> FontDefinitions {
    let name = "Ubuntu-Light";
    let mut fonts = FontDefinitions::empty();
    fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(UBUNTU_LIGHT)));
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.insert(family, vec![name.to_owned()]);
    }
    fonts
}

/// Text of less weight.
pub fn weak(text: impl Into<String>) -> egui::RichText {
    egui::RichText::new(text).color(WEAK)
}

/// Frame of a bar at the edge of the window.
pub fn bar_frame() -> egui::Frame {
    egui::Frame::new().fill(PANEL).inner_margin(Margin::symmetric(12, 7))
}

#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests {
    use super::*;
    use crate::lab::exam::exhibits::{EXHIBITS, Exhibit};
    use bevy_egui::egui::epaint::text::{FontsImpl, TextOptions};
    use std::{fs, path::Path};

    /// Texts that the screen shows: code (less its comments), elements, scenes, and all of these in other languages.
    const SHOWN: [&str; 10] = [
        "src/game",
        "src/lab/exam/exhibits.rs",
        "src/lab/live",
        "src/scene/effects.rs",
        "src/sim/effects",
        "src/sim/numbers.rs",
        "assets/elements.ron",
        "assets/scenes",
        "assets/challenges",
        "assets/texts",
    ];

    fn texts(path: &Path) -> Vec<(String, String)> {
        if path.is_dir() {
            let entries = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
            return entries.filter(|path| !path.ends_with("tests")).flat_map(|path| texts(&path)).collect();
        }
        let is_text = path.extension().is_some_and(|kind| kind == "rs" || kind == "ron" || kind == "po");
        let text = if is_text { fs::read_to_string(path).unwrap() } else { String::new() };
        let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        lines.map(|line| (path.display().to_string(), line.to_owned())).collect()
    }

    /// Relative luminance of a colour (WCAG 2.2).
    fn luminance(colour: Color32) -> f32 {
        let linear = egui::Rgba::from(colour);
        0.2126 * linear.r() + 0.7152 * linear.g() + 0.0722 * linear.b()
    }

    #[test]
    fn no_text_is_smaller_than_the_smallest() {
        const FONT: &str = "FontId::proportional(";
        for (file, line) in texts(Path::new("src/game")) {
            let size = line.split(FONT).nth(1).and_then(|size| size.split(')').next());
            if let Some(size) = size.and_then(|size| size.parse::<f32>().ok()) {
                assert!(size >= SMALL, "{file}: a text of {size} points: {line}");
            }
        }
    }

    #[test]
    fn text_stands_out_from_whatever_it_is_on() {
        for text in [TEXT, WEAK, ACCENT, WARN, GOOD, BAD] {
            for behind in [PANEL, BUTTON, BUTTON_HOVER, ACCENT_FILL] {
                let contrast = (luminance(text) + 0.05) / (luminance(behind) + 0.05);
                assert!(contrast >= 4.5, "{text:?} on {behind:?}: {contrast} (WCAG 2.2, 1.4.3, level AA: 4.5)");
            }
        }
    }

    #[test]
    fn the_font_has_all_that_is_shown() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut shown: Vec<_> = SHOWN.iter().flat_map(|path| texts(&root.join(path))).collect();
        let cases = EXHIBITS.iter().filter_map(Exhibit::case);
        shown.extend(cases.map(|case| (case.name.to_owned(), format!("{} {}", case.title, case.answer))));
        assert!(shown.len() > 10_000, "the folders of {SHOWN:?} are others by now");
        let mut all = FontsImpl::new(TextOptions::default(), fonts());
        let mut font = all.font(&FontFamily::Proportional);
        let has = font.characters();
        assert!(!has.contains_key(&'\u{2192}'), "a font with all characters proves nothing");
        for (file, line) in &shown {
            // egui makes narrow spaces itself, from the space.
            let is_narrow = |char: &char| matches!(char, '\u{2009}' | '\u{202f}');
            let missing = line.chars().find(|char| !char.is_control() && !is_narrow(char) && !has.contains_key(char));
            assert_eq!(missing, None, "{file}: {line}");
        }
    }
}
