//! What the player holds in place of a brush: nothing, a frame to take a piece of the world with, or a stamp.

use crate::{
    game::{
        actions::{Gesture, Take},
        stamps::shelf::Kept,
    },
    kernel::piece::Turn,
};
use bevy::prelude::Resource;

/// What is held. Written by `act`, read by the pointer and the HUD.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub enum Hand {
    /// Nothing: the brush works.
    #[default]
    Empty,
    /// A frame: the next drag takes what is in it.
    Frame(Take),
    /// A stamp, and how it lies: the next click pastes it.
    Stamp(Kept, Turn),
}

impl Hand {
    /// Whether the brush works.
    pub fn is_empty(&self) -> bool {
        *self == Self::Empty
    }

    /// What the left button does in place of the brush.
    pub fn gesture(&self) -> Option<Gesture> {
        match self {
            Self::Empty => None,
            Self::Frame(take) => Some(Gesture::Take(*take)),
            Self::Stamp(..) => Some(Gesture::Paste),
        }
    }
}
