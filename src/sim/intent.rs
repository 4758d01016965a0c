//! What a player wants done to the world, in world units and apart from any device. Input turns mouse and keys into
//! intents, the edit stage consumes them in order, replays store them.

use crate::{
    kernel::{
        brush::Stroke,
        element::ElementId,
        params::{Preset, Quality},
        piece::{Piece, Turn},
    },
    scene::effects::{Effect, Mode},
    sim::springs::Springs,
};
use bevy::prelude::Resource;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A change that is asked for. Lengths in d, velocities in d/s. In recordings they go by their order: new ones stand behind the others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Intent {
    /// Pour or place an element under the stroke, at rest. Movable elements fill free sites at their flow, however far the brush
    /// moves; fixed ones take the place of what is there.
    Draw {
        /// What.
        element: ElementId,
        /// Where.
        stroke: Stroke,
    },
    /// Place an element on all free sites under the stroke at once (lines, rectangles).
    Stamp {
        /// What.
        element: ElementId,
        /// Where.
        stroke: Stroke,
    },
    /// Fill the connected free room around a point with an element.
    Fill {
        /// What.
        element: ElementId,
        /// Where it starts, d.
        at: Vec2,
    },
    /// Take away everything under the stroke.
    Erase {
        /// Where.
        stroke: Stroke,
    },
    /// Set the air under the stroke moving.
    Blow {
        /// Where.
        stroke: Stroke,
        /// How fast, d/s.
        velocity: Vec2,
    },
    /// Add pressure to the air under the stroke.
    Press {
        /// Where.
        stroke: Stroke,
        /// How much; the surroundings' pressure is 1. Negative sucks.
        amount: f32,
    },
    /// Bring the air to rest at the surroundings' pressure.
    ClearAir,
    /// Go on at another quality: chosen by the player, or by the autopilot, whose decisions are recorded like a
    /// player's. To a preset of another detail the world changes as by [`Intent::Detail`]; where that does not fit, it
    /// stays at its own.
    Quality {
        /// Its name; for numbers between two names the nearest below.
        preset: Preset,
        /// Its numbers.
        quality: Quality,
    },
    /// Want an effect always, never, or while something calls for it.
    Effect {
        /// Which.
        effect: Effect,
        /// When.
        mode: Mode,
    },
    /// Let things fall another way from here on.
    Gravity {
        /// Which way and how fast, d/s².
        gravity: Vec2,
    },
    /// Go on at another detail: with particles of another size. Lengths of the intents behind it are in the d from then
    /// on.
    Detail {
        /// The scene's own spacing over that from here on, without what the quality brings along.
        detail: f64,
    },
    /// Warm what is under the stroke, rock and what moves.
    Warm {
        /// Where.
        stroke: Stroke,
        /// By how much, K; negative cools.
        degrees: f32,
    },
    /// Set what is under the stroke, rock and what moves, to a temperature.
    SetTemperature {
        /// Where.
        stroke: Stroke,
        /// To which, K.
        kelvin: f32,
    },
    /// Set fire to what can burn under the stroke.
    Ignite {
        /// Where.
        stroke: Stroke,
    },
    /// Give all that is under the stroke another element.
    Replace {
        /// Which.
        element: ElementId,
        /// Where.
        stroke: Stroke,
    },
    /// Give another element to all that hangs together with what is at a point, and is of the same element as that.
    ReplaceAround {
        /// Which.
        element: ElementId,
        /// Where it starts, d.
        at: Vec2,
    },
    /// Take away one element under the stroke.
    EraseOnly {
        /// Which.
        element: ElementId,
        /// Where.
        stroke: Stroke,
    },
    /// Take away all of an element that hangs together with what is at a point, if that is of it.
    EraseAround {
        /// Which.
        element: ElementId,
        /// Where it starts, d.
        at: Vec2,
    },
    /// Put a piece of a world into free room.
    Paste {
        /// The piece, in its own d.
        #[serde(with = "shared")]
        piece: Arc<Piece>,
        /// Where its middle comes to lie, d; it moves on to whole cells.
        at: Vec2,
        /// How it lies.
        turn: Turn,
    },
    /// Pour or place an element under the stroke, as the hand of a player does: where the brush moves, a stream without holes.
    /// Fixed elements take the place of what is there.
    Pour {
        /// What.
        element: ElementId,
        /// Where.
        stroke: Stroke,
        /// How fast it goes, d/s.
        velocity: Vec2,
        /// How long it is poured, of a tick.
        share: f32,
    },
    /// Take up a challenge, at the start of its scene.
    Begin {
        /// Its name.
        challenge: String,
    },
    /// A press begins, which lasts up to its release: what the intents behind it do, up to the next of these, is one stroke. Only
    /// while a challenge runs.
    Stroke,
    /// Leave the challenge.
    GiveUp,
    /// Let a movable element flow from under the stroke's end from now on, as the brush pours it.
    SetEmitter {
        /// What.
        element: ElementId,
        /// Where.
        stroke: Stroke,
    },
    /// Take away what moves under the stroke's end from now on.
    SetDrain {
        /// Where.
        stroke: Stroke,
    },
    /// Take away the emitters and drains under the stroke's end.
    RemoveSources {
        /// Where.
        stroke: Stroke,
    },
    /// Put emitters and drains where there are none.
    PasteSources {
        /// Which, and where.
        springs: Springs,
    },
}

/// What many share is written and read as one's own.
mod shared {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::sync::Arc;

    pub fn serialize<T: Serialize, S: Serializer>(value: &Arc<T>, serializer: S) -> Result<S::Ok, S::Error> {
        T::serialize(value, serializer)
    }

    pub fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<T>, D::Error> {
        T::deserialize(deserializer).map(Arc::new)
    }
}

impl Intent {
    /// Bytes that it takes beside itself.
    pub fn memory(&self) -> usize {
        match self {
            Self::Paste { piece, .. } => piece.memory(),
            Self::PasteSources { springs } => springs.memory(),
            _ => 0,
        }
    }

    /// The same in a world whose d is `factor` times shorter.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        match self {
            Self::Draw { element, stroke } => Self::Draw { element, stroke: stroke.scaled(factor) },
            Self::Stamp { element, stroke } => Self::Stamp { element, stroke: stroke.scaled(factor) },
            Self::Fill { element, at } => Self::Fill { element, at: at * factor },
            Self::Erase { stroke } => Self::Erase { stroke: stroke.scaled(factor) },
            Self::Blow { stroke, velocity } => {
                Self::Blow { stroke: stroke.scaled(factor), velocity: velocity * factor }
            }
            Self::Pour { element, stroke, velocity, share } => {
                Self::Pour { element, stroke: stroke.scaled(factor), velocity: velocity * factor, share }
            }
            Self::Press { stroke, amount } => Self::Press { stroke: stroke.scaled(factor), amount },
            Self::Warm { stroke, degrees } => Self::Warm { stroke: stroke.scaled(factor), degrees },
            Self::SetTemperature { stroke, kelvin } => Self::SetTemperature { stroke: stroke.scaled(factor), kelvin },
            Self::Ignite { stroke } => Self::Ignite { stroke: stroke.scaled(factor) },
            Self::Replace { element, stroke } => Self::Replace { element, stroke: stroke.scaled(factor) },
            Self::ReplaceAround { element, at } => Self::ReplaceAround { element, at: at * factor },
            Self::EraseOnly { element, stroke } => Self::EraseOnly { element, stroke: stroke.scaled(factor) },
            Self::EraseAround { element, at } => Self::EraseAround { element, at: at * factor },
            Self::Paste { piece, at, turn } => Self::Paste { piece, at: at * factor, turn },
            Self::SetEmitter { element, stroke } => Self::SetEmitter { element, stroke: stroke.scaled(factor) },
            Self::SetDrain { stroke } => Self::SetDrain { stroke: stroke.scaled(factor) },
            Self::RemoveSources { stroke } => Self::RemoveSources { stroke: stroke.scaled(factor) },
            Self::PasteSources { springs } => Self::PasteSources { springs: springs.scaled(f64::from(factor)) },
            Self::Gravity { gravity } => Self::Gravity { gravity: gravity * factor },
            Self::ClearAir
            | Self::Quality { .. }
            | Self::Effect { .. }
            | Self::Detail { .. }
            | Self::Begin { .. }
            | Self::Stroke
            | Self::GiveUp => self,
        }
    }
}

/// Intents that wait for the next edit stage.
#[derive(Resource, Debug, Default)]
pub struct IntentQueue {
    waiting: Vec<Intent>,
}

impl IntentQueue {
    /// Queues an intent.
    pub fn push(&mut self, intent: Intent) {
        self.waiting.push(intent);
    }

    /// Queues intents.
    pub fn extend(&mut self, intents: impl IntoIterator<Item = Intent>) {
        self.waiting.extend(intents);
    }

    /// Whether none waits.
    pub fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// All that wait, oldest first.
    pub fn iter(&self) -> std::slice::Iter<'_, Intent> {
        self.waiting.iter()
    }

    /// Takes all that wait, oldest first.
    pub fn drain(&mut self) -> std::vec::Drain<'_, Intent> {
        self.waiting.drain(..)
    }

    /// Forgets all that wait.
    pub fn clear(&mut self) {
        self.waiting.clear();
    }
}
