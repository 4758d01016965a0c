//! The windows of the HUD, and what a panel shows its own with.

use crate::game::{
    actions::PanelId,
    hud::{
        style,
        widgets::{LINE, field},
    },
    icons,
    language::spoken,
    panels::{Panel, Panels},
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{ResMut, Result},
};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, Color32, RichText, ScrollArea, Ui, Vec2},
};
use tr::tr;

/// The edge or corner of the screen that a window is at, and how far from it, points.
pub type Place = (Align2, Vec2);

/// In the middle of the screen.
pub const MIDDLE: Place = (Align2::CENTER_CENTER, Vec2::ZERO);

/// What a panel shows its window with.
#[derive(SystemParam)]
pub struct PanelWindow<'w, 's> {
    contexts: EguiContexts<'w, 's>,
    panels: ResMut<'w, Panels>,
}

impl PanelWindow<'_, '_> {
    /// Shows the window of a panel; its cross closes the panel.
    pub fn show(&mut self, panel: &Panel, place: Place, add: impl FnOnce(&mut Ui)) -> Result {
        let open = window(self.contexts.ctx_mut()?, panel.title, place, add);
        if !open {
            self.panels.close(panel.id);
        }
        Ok(())
    }

    /// Whether a panel is open still.
    pub fn is_open(&self, id: PanelId) -> bool {
        self.panels.shows(id)
    }

    /// Closes a panel.
    pub fn close(&mut self, id: PanelId) {
        self.panels.close(id);
    }
}

/// Shows a window with a heading of our own, which is its id in English; `false` if its cross was pressed.
pub fn window(context: &egui::Context, title: &str, (align, gap): Place, add: impl FnOnce(&mut Ui)) -> bool {
    let at = align.pos_in_rect(&context.content_rect()) + gap;
    let told = spoken(title);
    let window = egui::Window::new(told.as_str()).id(egui::Id::new(title)).title_bar(false).resizable(false);
    let shown = window.pivot(align).default_pos(at).show(context, |ui| {
        let heading = RichText::new(told.as_str()).heading().color(Color32::WHITE);
        let (_, closed) = egui::Sides::new().show(ui, |ui| ui.label(heading), cross);
        ui.add_space(6.0);
        add(ui);
        closed
    });
    shown.and_then(|shown| shown.inner) != Some(true)
}

/// The cross of a window; whether it was pressed.
fn cross(ui: &mut Ui) -> bool {
    let (rect, response) = field(ui, Vec2::splat(24.0), &tr!("Close"), false, LINE);
    let colour = if response.hovered() { Color32::WHITE } else { style::WEAK };
    icons::draw(ui.painter(), icons::square(rect.center(), 14.0), icons::close, colour);
    response.on_hover_text(tr!("close (Esc)")).clicked()
}

/// What may be as high as the screen less `rest` points, and scrolls beyond that.
pub fn scroll(ui: &mut Ui, rest: f32, add: impl FnOnce(&mut Ui)) {
    let height = ui.ctx().content_rect().height() - rest;
    ScrollArea::vertical().min_scrolled_height(height).max_height(height).show(ui, add);
}
