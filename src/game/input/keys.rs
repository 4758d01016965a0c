//! The keyboard: held arrows move the picture, text fields have the letters.

use crate::game::{
    actions::Action,
    camera::WorldCamera,
    input::bindings::{Bindings, Trigger},
};
use bevy::prelude::{ButtonInput, KeyCode, Real, Res, ResMut, Resource, Time};
use glam::Vec2;

/// Speed of the picture under a held arrow, pixels a second.
const PAN_SPEED: f32 = 700.0;

/// Which keys the HUD has for now; the others are the game's.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HudKeys {
    /// None.
    #[default]
    None,
    /// The arrows: they move what is in focus.
    Arrows,
    /// All but the digits: the player is typing, and the pointer is over the tile of an element that they are to keep.
    AllButDigits,
    /// All: the player is typing into a text field.
    All,
}

impl HudKeys {
    /// Whether the game may do this by a key.
    pub fn leave(self, action: Action) -> bool {
        match self {
            Self::None | Self::Arrows => true,
            Self::AllButDigits => matches!(action, Action::Element(_)),
            Self::All => false,
        }
    }
}

/// Whether a key of an action is held.
pub fn is_held(action: Action, keys: &ButtonInput<KeyCode>, bindings: &Bindings) -> bool {
    bindings.iter().any(|binding| match binding.trigger {
        Trigger::Key(key) => binding.action == action && keys.pressed(key),
        _ => false,
    })
}

/// Moves the picture while an arrow is held.
pub fn pan(
    keys: Res<ButtonInput<KeyCode>>,
    hud: Res<HudKeys>,
    bindings: Res<Bindings>,
    time: Res<Time<Real>>,
    mut camera: ResMut<WorldCamera>,
) {
    if *hud != HudKeys::None || camera.zoom() == 1.0 {
        return;
    }
    for binding in bindings.iter() {
        if let (Trigger::Key(key), Action::Pan(right, up)) = (binding.trigger, binding.action)
            && keys.pressed(key)
        {
            camera.pan(Vec2::new(-right as f32, up as f32) * PAN_SPEED * time.delta_secs());
        }
    }
}
