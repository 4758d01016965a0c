//! What is shown while a file hangs over the window: that it can be dropped, and what becomes of it.

use crate::game::{
    drop::Hovering,
    hud::style::{ACCENT, PANEL, TEXT, WEAK},
};
use bevy::prelude::{Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, Color32, CornerRadius, FontId, LayerId, Order, Stroke, StrokeKind, vec2},
};
use tr::tr;

/// Longest name that is shown, characters.
const LONGEST: usize = 48;

/// Shows the hint over everything.
pub fn show(mut contexts: EguiContexts, hovering: Res<Hovering>) -> Result {
    let Some(first) = hovering.0.first() else { return Ok(()) };
    let context = contexts.ctx_mut()?;
    let screen = context.content_rect();
    let painter = context.layer_painter(LayerId::new(Order::Tooltip, "drop".into()));
    painter.rect_filled(screen, 0.0, Color32::from_black_alpha(140));
    let border = Stroke::new(3.0, ACCENT);
    painter.rect_stroke(screen.shrink(10.0), CornerRadius::same(12), border, StrokeKind::Inside);
    let card = egui::Rect::from_center_size(screen.center(), vec2(440.0_f32.min(screen.width() - 40.0), 92.0));
    painter.rect_filled(card, CornerRadius::same(10), PANEL);
    let (upper, lower) = (card.center() - vec2(0.0, 16.0), card.center() + vec2(0.0, 18.0));
    let text = if hovering.0.len() == 1 {
        tr!("Drop to open {}", shortened(first))
    } else {
        tr!("Drop to open {} files, one after the other", hovering.0.len())
    };
    painter.text(upper, Align2::CENTER_CENTER, text, FontId::proportional(16.0), TEXT);
    let what = tr!("a save, a picture with its world, a recording or a scene; undo goes back");
    painter.text(lower, Align2::CENTER_CENTER, what, FontId::proportional(12.0), WEAK);
    Ok(())
}

/// A name that fits, with its ending.
fn shortened(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= LONGEST {
        return name.to_owned();
    }
    let (first, last) = (&letters[..LONGEST - 12], &letters[letters.len() - 11..]);
    first.iter().chain(&['…']).chain(last).collect()
}

#[cfg(test)]
mod tests {
    use super::shortened;

    #[test]
    fn a_long_name_keeps_beginning_and_ending() {
        assert_eq!(shortened("a.pms"), "a.pms");
        let long = format!("{}.pms", "é".repeat(90));
        let short = shortened(&long);
        assert!(short.chars().count() == 48 && short.ends_with("é.pms") && short.contains('…'), "{short}");
    }
}
