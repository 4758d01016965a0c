//! The format of a challenge.

use super::goal::{Condition, Means};
use crate::{
    kernel::units::TICKS_PER_SECOND,
    scene::{
        build::SceneFile,
        elements::elements,
        error::SceneError,
        file::{SceneText, parse},
        number::Range,
    },
};
use serde::Deserialize;

/// Time that a challenge may give, s, and that its goal may have to hold.
const SECONDS: Range = Range::real(1.0, 600.0);
const HOLD: Range = Range::real(0.0, 60.0);
/// What names of the scenes of challenges begin with: no scene of the gallery has such a name.
const SCENE: &str = "challenge-";

/// A whole file. Lengths in m, times in s of the world.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "Challenge")]
struct ChallengeText {
    /// Its place among the others, from 1.
    number: u32,
    /// One sentence that says what to do, 1 … 120 characters. What it is called is its scene's title.
    task: String,
    /// Names of the elements and tools that the player has.
    means: Means,
    /// What is asked for: all of it at once.
    goal: Vec<Condition>,
    /// For how long the goal has to hold without a break, s: 0 … 60.
    hold: f64,
    /// Time until it is lost, s: 1 … 600.
    seconds: f64,
    /// Most particles poured for the second star, of the scene's own spacing.
    particles: u32,
    /// Most strokes for the third star.
    strokes: u32,
    /// The world that it begins with.
    scene: SceneText,
}

/// A challenge: a scene, and what has to be reached in it.
#[derive(Clone, Debug)]
pub struct Challenge {
    /// Its file's stem.
    pub name: String,
    /// Its place among the others, from 1.
    pub number: u32,
    /// One sentence that says what to do.
    pub task: String,
    /// What the player has.
    pub means: Means,
    /// What is asked for: all of it at once.
    pub goal: Vec<Condition>,
    /// For how long the goal has to hold without a break, ticks; at least one.
    pub hold: u64,
    /// After so many ticks it is lost.
    pub ticks: u64,
    /// Most particles poured for the second star, of the scene's own spacing.
    pub particles: u32,
    /// Most strokes for the third star.
    pub strokes: u32,
    /// The world that it begins with.
    pub scene: SceneFile,
}

impl Challenge {
    /// Reads a challenge called `name` from the bytes of its file.
    pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Self, SceneError> {
        let file = format!("assets/challenges/{name}.ron");
        let text: ChallengeText = parse(&file, bytes)?;
        let fault = |field: &str, what: String| SceneError::value(&file, field, what);
        if text.task.trim().is_empty() || text.task.chars().count() > 120 {
            return Err(fault("task", "allowed: 1 to 120 characters".to_owned()));
        }
        if text.goal.is_empty() {
            return Err(fault("goal", "empty; allowed: what has to hold".to_owned()));
        }
        let elements = elements()?;
        for (k, condition) in text.goal.iter().enumerate() {
            condition.check(&file, &format!("goal[{k}]"), &elements)?;
        }
        text.means.check(&file, &elements)?;
        let ticks = |field: &str, seconds: f64, range: Range| match range.check(seconds) {
            Ok(seconds) => Ok(((seconds * f64::from(TICKS_PER_SECOND)).round() as u64).max(1)),
            Err(what) => Err(fault(field, what)),
        };
        let (hold, limit) = (ticks("hold", text.hold, HOLD)?, ticks("seconds", text.seconds, SECONDS)?);
        if text.strokes == 0 {
            return Err(fault("strokes", "allowed: whole numbers from 1".to_owned()));
        }
        let ChallengeText { number, task, means, goal, particles, strokes, scene, .. } = text;
        let scene = SceneFile::of_part(&format!("{SCENE}{name}"), &file, scene, bytes)?;
        let name = name.to_owned();
        Ok(Self { name, number, task, means, goal, hold, ticks: limit, particles, strokes, scene })
    }

    /// What it is called.
    pub fn title(&self) -> &str {
        self.scene.title()
    }

    /// Whether a scene called `name` is of a challenge.
    pub fn is_name_of_scene(name: &str) -> bool {
        name.starts_with(SCENE)
    }
}
