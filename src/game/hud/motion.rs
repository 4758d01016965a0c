//! What moves on the screen by itself, for whom that makes unwell: the HUD can do without. The world moves, being what the game
//! is about, and its time can be stopped.

use super::style;
use bevy::prelude::{Query, Res, Resource};
use bevy_egui::{
    EguiContext,
    egui::{self, style::ScrollAnimation},
};

/// Whether the HUD is to move as little as can be.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReducedMotion {
    /// What the player chose, if they did.
    pub chosen: Option<bool>,
    /// What the system asks for.
    pub by_system: bool,
}

impl ReducedMotion {
    /// Whether it is.
    pub fn is_on(self) -> bool {
        self.chosen.unwrap_or(self.by_system)
    }
}

/// Has egui's widgets follow.
pub fn follow(mut contexts: Query<&mut EguiContext>, motion: Res<ReducedMotion>) {
    for mut context in &mut contexts {
        apply(context.get_mut(), motion.is_on());
    }
}

fn apply(context: &egui::Context, is_reduced: bool) {
    context.all_styles_mut(|style| {
        style.animation_time = if is_reduced { 0.0 } else { style::FADE };
        style.scroll_animation = if is_reduced { ScrollAnimation::none() } else { ScrollAnimation::default() };
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_player_chose_comes_before_what_the_system_asks_for() {
        for by_system in [false, true] {
            assert_eq!(ReducedMotion { chosen: None, by_system }.is_on(), by_system);
            for chosen in [false, true] {
                assert_eq!(ReducedMotion { chosen: Some(chosen), by_system }.is_on(), chosen);
            }
        }
    }

    #[test]
    fn widgets_move_no_more_and_move_again() {
        let context = egui::Context::default();
        for (is_reduced, time) in [(true, 0.0), (false, style::FADE)] {
            apply(&context, is_reduced);
            assert_eq!(context.global_style().animation_time, time);
        }
    }
}
