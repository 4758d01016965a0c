//! The keyboard: held arrows move the picture, text fields have the letters.

use crate::game::{
    actions::Action,
    camera::WorldCamera,
    input::bindings::{Bindings, Mods, Trigger},
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
    /// Tab: it goes from one control to the next.
    Tab,
    /// All but the digits: the player is typing, and the pointer is over the tile of an element that they are to keep.
    AllButDigits,
    /// All: the player is typing into a text field.
    All,
}

impl HudKeys {
    /// Whether the game may do this by a key.
    pub fn leave(self, key: KeyCode, action: Action) -> bool {
        match self {
            Self::None => true,
            Self::Arrows => !is_arrow(key),
            Self::Tab => key != KeyCode::Tab,
            Self::AllButDigits => matches!(action, Action::Element(_)) && is_digit(key),
            Self::All => false,
        }
    }
}

fn is_arrow(key: KeyCode) -> bool {
    matches!(key, KeyCode::ArrowLeft | KeyCode::ArrowRight | KeyCode::ArrowUp | KeyCode::ArrowDown)
}

/// Whether a key types a digit, on the row of digits or apart.
fn is_digit(key: KeyCode) -> bool {
    let name = format!("{key:?}");
    let rest = name.strip_prefix("Digit").or_else(|| name.strip_prefix("Numpad"));
    rest.is_some_and(|rest| rest.len() == 1)
}

/// Whether a key of an action is held.
pub fn is_held(action: Action, keys: &ButtonInput<KeyCode>, bindings: &Bindings) -> bool {
    bindings.iter().any(|binding| match binding.trigger {
        Trigger::Key(key) => binding.action == action && keys.pressed(key),
        _ => false,
    })
}

/// Moves the picture while a key for that is held, whatever modifiers are held with it, unless they make it another action's.
pub fn pan(
    keys: Res<ButtonInput<KeyCode>>,
    hud: Res<HudKeys>,
    bindings: Res<Bindings>,
    time: Res<Time<Real>>,
    mut camera: ResMut<WorldCamera>,
) {
    if camera.zoom() == 1.0 {
        return;
    }
    let held = Mods::held(&keys);
    for binding in bindings.iter() {
        if let (Trigger::Key(key), Action::Pan(right, up)) = (binding.trigger, binding.action)
            && keys.pressed(key)
            && hud.leave(key, binding.action)
            && binding.mods.are_among(held)
            && bindings.find(binding.trigger, held).is_none_or(|action| action == binding.action)
        {
            camera.pan(Vec2::new(-right as f32, up as f32) * PAN_SPEED * time.delta_secs());
        }
    }
}
