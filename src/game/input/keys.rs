//! The keyboard: presses become commands, held arrows move the picture.

use crate::game::{
    camera::WorldCamera,
    input::bindings::{Action, BINDINGS, Mods, Trigger},
    orders::{Order, Orders},
};
use bevy::prelude::{ButtonInput, KeyCode, Real, Res, ResMut, Resource, Time};
use glam::Vec2;

/// Speed of the picture under a held arrow, pixels a second.
const PAN_SPEED: f32 = 700.0;

/// Whether the player is typing into a text field: then keys are letters.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Typing(pub bool);

/// Reads the keys.
pub fn read_keys(
    keys: Res<ButtonInput<KeyCode>>,
    typing: Res<Typing>,
    time: Res<Time<Real>>,
    mut camera: ResMut<WorldCamera>,
    mut orders: ResMut<Orders>,
) {
    if typing.0 {
        return;
    }
    let mods = Mods::held(&keys);
    for binding in BINDINGS {
        let Trigger::Key(key) = binding.trigger else { continue };
        if binding.mods != mods {
            continue;
        }
        match binding.action {
            Action::Pan(right, up) if keys.pressed(key) => {
                let way = Vec2::new(-right as f32, up as f32);
                camera.pan(way * PAN_SPEED * time.delta_secs());
            }
            Action::Pan(..) => {}
            action if keys.just_pressed(key) => orders.push(Order::Act(action)),
            _ => {}
        }
    }
}
