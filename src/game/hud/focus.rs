//! What belongs to the HUD and what to the world: parts of the window, and keys.

use crate::game::{
    camera::Area,
    input::{keys::HudKeys, mouse_keys::MouseKeys, pointer::HudCover, rebind::KeyEditor},
};
use bevy::prelude::{Query, Res, ResMut, Result};
use bevy_egui::{EguiContext, EguiContexts, EguiInput, egui};
use glam::Vec2;

/// Forgets what the pointer was over: the tiles that are shown say it anew.
pub fn forget_element(mut cover: ResMut<HudCover>) {
    cover.element = None;
}

/// Notes which parts of the window the HUD has.
pub fn note_cover(mut cover: ResMut<HudCover>, mut contexts: EguiContexts) -> Result {
    let context = contexts.ctx_mut()?;
    let zoom = context.zoom_factor();
    cover.menu = egui::Popup::is_any_open(context);
    cover.parts.clear();
    for layer in context.memory(|memory| memory.areas().visible_layer_ids()) {
        // The root, behind everything, fills the window.
        if layer.order == egui::Order::Background {
            continue;
        }
        if let Some(area) = egui::AreaState::load(context, layer.id).filter(|area| area.interactable) {
            let (min, max) = (area.rect().min, area.rect().max);
            cover.parts.push(Area { min: Vec2::new(min.x, min.y) * zoom, max: Vec2::new(max.x, max.y) * zoom });
        }
    }
    Ok(())
}

/// Keys belong to the game unless a text field has them; egui would move its focus with Tab and press what is focused
/// with Space. What else is in focus has the arrows; with mouse keys Tab moves the focus, and the pointer with it. A key that is
/// to be chosen for an action is nobody's.
pub fn keep_keys(
    mut contexts: Query<(&mut EguiContext, &mut EguiInput)>,
    (cover, editor, mouse_keys): (Res<HudCover>, Res<KeyEditor>, Res<MouseKeys>),
    mut hud: ResMut<HudKeys>,
) {
    for (mut context, mut input) in &mut contexts {
        let context = context.get_mut();
        *hud = match context.memory(|memory| memory.focused()) {
            _ if context.text_edit_focused() && cover.element.is_some() => HudKeys::AllButDigits,
            _ if context.text_edit_focused() => HudKeys::All,
            _ if mouse_keys.0 => HudKeys::Tab,
            Some(_) => HudKeys::Arrows,
            _ => HudKeys::None,
        };
        let is_kept = |event: &egui::Event| match event {
            egui::Event::Key { key: egui::Key::Escape, .. } => true,
            egui::Event::Key { key: egui::Key::Tab, .. } => *hud == HudKeys::Tab,
            egui::Event::Key { key, .. } => *hud == HudKeys::Arrows && is_arrow(*key),
            egui::Event::Text(_) => false,
            _ => true,
        };
        match *hud {
            _ if editor.asked().is_some() => {
                input.events.retain(|event| !matches!(event, egui::Event::Key { .. } | egui::Event::Text(_)));
            }
            HudKeys::All => {}
            HudKeys::AllButDigits => drop_digits(&mut input.events),
            HudKeys::None | HudKeys::Arrows | HudKeys::Tab => input.events.retain(is_kept),
        }
    }
}

/// Drops what the digit keys type. Keys are physical: what they type need not be a digit, and comes in the same frame.
fn drop_digits(events: &mut Vec<egui::Event>) {
    let is_digit = |key: egui::Key| key.name().len() == 1 && key.name().as_bytes()[0].is_ascii_digit();
    let typed = events.iter().any(|event| match event {
        egui::Event::Key { physical_key, pressed, .. } => *pressed && physical_key.is_some_and(is_digit),
        _ => false,
    });
    events.retain(|event| match event {
        egui::Event::Text(text) => !typed && !text.chars().all(|c| c.is_ascii_digit()),
        egui::Event::Key { key, .. } => !is_digit(*key),
        _ => true,
    });
}

fn is_arrow(key: egui::Key) -> bool {
    matches!(key, egui::Key::ArrowLeft | egui::Key::ArrowRight | egui::Key::ArrowUp | egui::Key::ArrowDown)
}
