//! What the player wants done beyond the reach of a tool. Keys and the HUD put orders in; `execute` carries them out
//! between ticks.

use crate::{
    game::{
        actions::{Action, Take},
        gauges::grip::Grip,
        input::rebind::KeyOrder,
    },
    kernel::{brush::Stroke, element::Element, params::Preset},
    lab::{autopilot::Goal, dial::Step, live::accuracy::SurveyRequest},
    scene::effects::{Effect, Mode},
};
use bevy::prelude::{Deref, DerefMut, MouseButton, Resource};
use glam::Vec2;
use std::path::PathBuf;

/// One thing to do.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// What a key or a button does.
    Act(Action),
    /// Remember the state before an edit.
    Checkpoint,
    /// Make a stamp of what is between two corners (d), and take it up.
    TakePiece(Vec2, Vec2, Take),
    /// Paste the stamp in hand with its middle here, d.
    Paste(Vec2),
    /// Take up the stamp of this number.
    TakeUpStamp(u64),
    /// Go on at another quality.
    Quality(Preset),
    /// Go on at another detail, beside which the quality may have its own.
    Detail(f64),
    /// Go on at a step of the dial: at another quality and another detail.
    Accuracy(Step),
    /// Start the second world of the split again from the first, at this quality.
    SecondQuality(Preset),
    /// Let the autopilot hold something, or nothing.
    Hold(Option<Goal>),
    /// Measure what the qualities cost from here on, or give that up.
    Survey(SurveyRequest),
    /// Switch an effect.
    Effect(Effect, Mode),
    /// Open a file: a save file, a picture with its world, a recording or a scene.
    Load(PathBuf),
    /// The same of a file that a page was given.
    LoadBytes {
        /// What it is called.
        name: String,
        /// What is in it.
        bytes: Vec<u8>,
    },
    /// Play another scene, at the quality that is in force.
    Scene {
        /// Its name.
        name: String,
        /// Its parameters.
        settings: Vec<(String, String)>,
        /// Its detail, beside which the quality may have its own.
        detail: f64,
    },
    /// Play a scene as if the game began with it, whatever is in force.
    Open {
        /// Its name.
        name: String,
        /// Its parameters.
        settings: Vec<(String, String)>,
        /// The quality, if it is not to be the scene's own.
        quality: Option<Preset>,
        /// How many times finer than the scene's own its particles are.
        detail: f64,
    },
    /// Begin the challenge of a name.
    Challenge(String),
    /// Begin the challenge again that is tried.
    ChallengeAgain,
    /// Leave it.
    LeaveChallenge,
    /// Play a hard case of the stability gauntlet.
    Watch(&'static str),
    /// Go to the exhibit of the museum of a name.
    Visit(&'static str),
    /// Throw a hard case at the world that is played.
    Throw(&'static str),
    /// Move the slider of the volume, 0 … 1.
    Volume(f32),
    /// Put an element of the player's own into the world.
    Mix(Box<Element>),
    /// Forget the own element of a name.
    ForgetElement(String),
    /// Choose keys.
    Keys(KeyOrder),
    /// Let the gauge of this number stand out, in the panel of all.
    SelectGauge(u32),
    /// Move a gauge that is gripped by this much, d, from where it was then.
    MoveGauge(Grip, Vec2),
    /// Take the gauge of this number away.
    RemoveGauge(u32),
    /// Write what gauges read as a table.
    SaveReadings,
    /// Set what a button sets under a brush, a spring or a drain, or take away what is there of these.
    SetSource(MouseButton, Stroke),
}

/// Orders that wait, oldest first.
#[derive(Resource, Deref, DerefMut, Debug, Default)]
pub struct Orders(Vec<Order>);
