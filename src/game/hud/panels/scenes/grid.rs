//! The tiles of the gallery.

use super::{menu::SceneMenu, pictures::Pictures};
use crate::{
    game::{
        hud::{
            style,
            widgets::{BUTTON, LINE, field, name},
        },
        icons,
        language::spoken,
    },
    lab::miniature::{HEIGHT, WIDTH},
    scene::SceneCategory,
};
use bevy_egui::egui::{
    self, Align, Color32, FontId, Pos2, Rect, RichText, Sense, Stroke, StrokeKind, TextStyle, TextureId, Ui, Vec2,
    epaint::RectShape, pos2, vec2,
};
use tr::tr;

/// Width of a tile, points.
const TILE: f32 = 176.0;
/// Between the edge of a tile and its picture, points.
const EDGE: f32 = 5.0;
/// Height of the text below the picture, points.
const TEXT: f32 = 55.0;
/// Between tiles, points.
const GAP: f32 = 6.0;
/// Side of the button that leads to a scene's page, points.
const GEAR: f32 = 26.0;
/// A pointer that moved so long ago moves still, s.
const MOVED: f32 = 0.2;
/// Most tiles in a row.
const COLUMNS: f32 = 5.0;
/// Of the screen's width this is never tiles, points.
const MARGIN: f32 = 72.0;

/// What was pressed.
pub(super) enum Pressed {
    /// This scene is to be played.
    Play(usize),
    /// The page of this scene is to be shown.
    SetUp(usize),
}

/// The height of a picture `width` points wide.
pub(super) fn picture_height(width: f32) -> f32 {
    width * HEIGHT as f32 / WIDTH as f32
}

/// Width of all tiles of a row on such a screen, points.
pub(super) fn width(screen: f32) -> f32 {
    let columns = ((screen - MARGIN + GAP) / (TILE + GAP)).floor().clamp(1.0, COLUMNS);
    columns * (TILE + GAP) - GAP
}

/// Shows a picture with round corners, or a shade where it will be.
pub(super) fn picture(ui: &Ui, rect: Rect, texture: Option<TextureId>) {
    ui.painter().rect_filled(rect, style::BUTTON_CORNER, style::PANEL);
    if let Some(id) = texture {
        let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        ui.painter().add(RectShape::filled(rect, style::BUTTON_CORNER, Color32::WHITE).with_texture(id, whole));
    }
}

/// Shows what was found, by category unless it was searched for; notes the tiles, and which of them are in sight.
pub(super) fn show(
    ui: &mut Ui,
    menu: &mut SceneMenu,
    (found, pictures): (&[usize], &Pictures),
    (playing, fingers): (&str, bool),
) -> Option<Pressed> {
    let mut pressed = None;
    menu.tiles.clear();
    for (title, group) in groups(menu, found) {
        ui.add_space(4.0);
        ui.label(RichText::new(title).color(style::WEAK));
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing = Vec2::splat(GAP);
            ui.horizontal_wrapped(|ui| {
                for index in group {
                    pressed = tile(ui, menu, index, pictures, (playing, fingers)).or(pressed.take());
                }
            });
        });
    }
    menu.follow = false;
    pressed
}

/// The headings and what stands under them.
fn groups(menu: &SceneMenu, found: &[usize]) -> Vec<(String, Vec<usize>)> {
    if !menu.text.trim().is_empty() {
        return if found.is_empty() { Vec::new() } else { vec![(tr!("Found"), found.to_vec())] };
    }
    let of = |category| {
        found.iter().copied().filter(|index| menu.entries[*index].scene.category() == category).collect::<Vec<_>>()
    };
    let all = SceneCategory::ALL.map(|category| (Some(category), spoken(category.title())));
    let headings = [(None, tr!("Yours"))].into_iter().chain(all);
    headings.map(|(category, title)| (title, of(category))).filter(|(_, group)| !group.is_empty()).collect()
}

fn tile(
    ui: &mut Ui,
    menu: &mut SceneMenu,
    index: usize,
    pictures: &Pictures,
    (playing, fingers): (&str, bool),
) -> Option<Pressed> {
    let looked_at = menu.focus == Some(index);
    let title = spoken(menu.entries[index].scene.title());
    let height = EDGE + picture_height(TILE - 2.0 * EDGE) + TEXT;
    let (rect, response) = field(ui, vec2(TILE, height), &title, looked_at, BUTTON);
    if looked_at && menu.follow {
        ui.scroll_to_rect(rect.expand(GAP), None);
    }
    menu.tiles.push((index, rect));
    if !ui.is_rect_visible(rect) {
        return None;
    }
    menu.in_sight.push(index);
    let entry = &menu.entries[index];
    let frame =
        Rect::from_min_size(rect.min + Vec2::splat(EDGE), vec2(TILE - 2.0 * EDGE, picture_height(TILE - 2.0 * EDGE)));
    picture(ui, frame, pictures.of(&entry.call));
    if looked_at {
        let stroke = Stroke::new(1.5, style::ACCENT);
        ui.painter().rect_stroke(rect, style::BUTTON_CORNER, stroke, StrokeKind::Inside);
    }
    let colour = if entry.scene.name() == playing { style::ACCENT } else { Color32::WHITE };
    write(ui, frame.left_bottom() + vec2(3.0, 5.0), &title, TextStyle::Button.resolve(ui.style()), colour);
    write(
        ui,
        frame.left_bottom() + vec2(3.0, 22.0),
        &spoken(entry.scene.invitation()),
        FontId::proportional(style::SMALL),
        style::WEAK,
    );
    // Where the pointer moves it is looked at; it may rest on a tile while arrows lead to another.
    if response.hovered() && ui.input(|input| input.pointer.time_since_last_movement() < MOVED) {
        menu.focus = Some(index);
    }
    let side = if fingers { 48.0 / ui.ctx().zoom_factor() } else { GEAR };
    let corner = Rect::from_min_size(frame.right_top() + vec2(-side - 3.0, 3.0), Vec2::splat(side));
    if (looked_at || fingers) && gear(ui, corner, (index, &title)) {
        return Some(Pressed::SetUp(index));
    }
    response.clicked().then_some(Pressed::Play(index))
}

/// A text of up to two lines.
fn write(ui: &Ui, at: Pos2, text: &str, font: FontId, colour: Color32) {
    let mut job = egui::text::LayoutJob::simple(text.to_owned(), font, colour, TILE - 2.0 * EDGE - 6.0);
    job.wrap.max_rows = 2;
    job.halign = Align::LEFT;
    let galley = ui.painter().layout_job(job);
    ui.painter().galley(at, galley, colour);
}

/// The button that leads to a scene's page.
fn gear(ui: &mut Ui, rect: Rect, (index, title): (usize, &str)) -> bool {
    let called = tr!("settings of {}", title);
    let response = ui.interact(rect, ui.id().with(("gear", index)), Sense::click());
    name(&response, &called, false);
    let [_, hovered] = LINE;
    let fill = if response.hovered() { hovered } else { style::PANEL.gamma_multiply(0.8) };
    ui.painter().rect_filled(rect, style::BUTTON_CORNER, fill);
    icons::draw(ui.painter(), icons::square(rect.center(), 15.0), icons::gear, Color32::WHITE);
    response.on_hover_text(tr!("its parameters and detail (Shift+Enter)")).clicked()
}
