//! Recorded input: which intent the edit stage took in which tick, so that a run can be repeated to the last bit.
//!
//! A replay file is text, one JSON object a line: first the [`Header`], then one [`Entry`] for each intent in the order
//! in which they were taken.

use crate::{
    kernel::{
        brush::Stroke,
        element::ElementTable,
        params::{FluidParams, Preset, Quality},
    },
    scene::blueprint::{Blueprint, EffectModes},
    sim::{intent::Intent, save::check},
};
use bevy::prelude::Resource;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, fmt::Write};

/// Version of the format that this program writes and reads.
pub const FORMAT: u32 = 1;

/// The first line: the world that the input belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// [`FORMAT`].
    pub powder_master_replay: u32,
    /// The scene that was played.
    pub scene: String,
    /// Values of the scene's parameters.
    pub parameters: BTreeMap<String, f64>,
    /// The named quality.
    pub preset: Preset,
    /// The numbers in force.
    pub quality: Quality,
    /// The liquid's parameters.
    pub fluid: FluidParams,
    /// Most particles.
    pub particle_limit: u32,
    /// Wanted effects.
    pub effects: EffectModes,
    /// Names of the elements that the entries count: a replay fits a program that knows these and perhaps more.
    pub elements: Vec<String>,
    /// Ticks that were played.
    pub ticks: u64,
}

/// A line after the first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Ticks that were done when the intent was taken.
    pub tick: u64,
    /// The intent.
    pub intent: Intent,
}

/// A world and the input to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// The world.
    pub header: Header,
    /// The input, oldest first.
    pub entries: Vec<Entry>,
}

/// What is wrong with a replay file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {what}")]
pub struct ReplayError {
    /// Line, counted from 1.
    pub line: usize,
    /// What is wrong there and what is allowed.
    pub what: String,
}

impl Replay {
    /// Reads a replay file's text. `elements` is the table of the program that reads.
    pub fn read(text: &str, elements: &ElementTable) -> Result<Self, ReplayError> {
        let mut lines = (1..).zip(text.lines());
        let (_, first) = lines.next().unwrap_or((1, ""));
        let header: Header = parse(1, first)?;
        header.check(elements).map_err(|what| ReplayError { line: 1, what })?;
        let mut entries: Vec<Entry> = Vec::new();
        for (line, text) in lines.filter(|(_, text)| !text.trim().is_empty()) {
            let entry: Entry = parse(line, text)?;
            let last = entries.last().map_or(0, |entry| entry.tick);
            check_entry(&entry, last, header.elements.len()).map_err(|what| ReplayError { line, what })?;
            entries.push(entry);
        }
        Ok(Self { header, entries })
    }

    /// The text of the replay file.
    pub fn write(&self) -> Result<String, serde_json::Error> {
        let mut text = serde_json::to_string(&self.header)?;
        text.push('\n');
        for entry in &self.entries {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{}", serde_json::to_string(entry)?);
        }
        Ok(text)
    }
}

impl Header {
    /// The header for a world that was built from `blueprint` and has done `ticks`.
    pub fn new(blueprint: &Blueprint, ticks: u64) -> Self {
        Self {
            powder_master_replay: FORMAT,
            scene: blueprint.name.clone(),
            parameters: blueprint.parameters.clone(),
            preset: blueprint.preset,
            quality: blueprint.quality,
            fluid: blueprint.fluid,
            particle_limit: blueprint.particle_limit,
            effects: blueprint.effects.clone(),
            elements: blueprint.elements.iter().map(|(_, element)| element.name.clone()).collect(),
            ticks,
        }
    }

    /// The scene's parameters as a scene file takes them.
    pub fn settings(&self) -> Vec<(String, String)> {
        self.parameters.iter().map(|(name, value)| (name.clone(), value.to_string())).collect()
    }

    /// The blueprint that was played, from the one that the scene builds with the same parameters and preset: with the
    /// recorded numbers of the liquid, and of the quality too if `exact`.
    pub fn restore(&self, built: Blueprint, exact: bool) -> Blueprint {
        let quality = if exact { self.quality } else { built.quality };
        Blueprint { quality, fluid: self.fluid, particle_limit: self.particle_limit, ..built }
    }

    fn check(&self, elements: &ElementTable) -> Result<(), String> {
        if self.powder_master_replay != FORMAT {
            return Err(format!("replay format {}, but this program reads {FORMAT}", self.powder_master_replay));
        }
        let mut known = elements.iter().map(|(_, element)| &element.name);
        match self.elements.iter().find(|name| known.next() != Some(name)) {
            Some(name) => Err(format!("element \"{name}\" is not at this place of the element table")),
            None => Ok(()),
        }
    }
}

fn parse<T: for<'a> Deserialize<'a>>(line: usize, text: &str) -> Result<T, ReplayError> {
    serde_json::from_str(text).map_err(|error| {
        let text = error.to_string();
        // Every JSON text is one line long: its own line number says nothing, its column stays.
        let what = text.replace(" at line 1 column ", " at column ").replace(" at line 1", "");
        ReplayError { line, what }
    })
}

fn check_entry(entry: &Entry, last: u64, elements: usize) -> Result<(), String> {
    if entry.tick < last {
        return Err(format!("tick {} comes after tick {last}, but ticks never go back", entry.tick));
    }
    let (element, places, numbers): (_, &[Vec2], &[f32]) = match &entry.intent {
        Intent::Draw { element, stroke } | Intent::Stamp { element, stroke } => {
            (Some(element), &places(stroke), &[stroke.radius])
        }
        Intent::Fill { element, at } => (Some(element), &[*at], &[]),
        Intent::Erase { stroke } => (None, &places(stroke), &[stroke.radius]),
        Intent::Blow { stroke, velocity } => (None, &[stroke.from, stroke.to, *velocity], &[stroke.radius]),
        Intent::Press { stroke, amount } => (None, &places(stroke), &[stroke.radius, *amount]),
        Intent::ClearAir => (None, &[], &[]),
        Intent::Quality { quality, .. } => return check::quality(quality),
    };
    if let Some(element) = element.filter(|element| element.index() >= elements) {
        return Err(format!("element {} is not one of the {elements} elements (0 … {})", element.0, elements - 1));
    }
    if !(places.iter().all(|place| place.is_finite()) && numbers.iter().all(|number| number.is_finite())) {
        return Err("a coordinate or amount is too large for a number of the simulation".into());
    }
    Ok(())
}

fn places(stroke: &Stroke) -> [Vec2; 2] {
    [stroke.from, stroke.to]
}

/// Notes what the edit stage takes. Going back to an earlier state of the same scene (undo) and forth again (redo) keeps
/// the record right: the world knows how many edits it has seen, and the record is cut there before it goes on.
#[derive(Resource, Clone, Debug, Default)]
pub struct Recorder {
    entries: Vec<Entry>,
}

impl Recorder {
    /// Notes that the world, `tick` ticks and `edits` edits old, takes `intent`.
    pub fn note(&mut self, tick: u64, edits: u64, intent: Intent) {
        self.entries.truncate(edits as usize);
        self.entries.push(Entry { tick, intent });
    }

    /// The record of a world, `ticks` ticks and `edits` edits old, that was built from `blueprint`.
    pub fn replay(&self, blueprint: &Blueprint, ticks: u64, edits: u64) -> Replay {
        let seen = self.entries.len().min(edits as usize);
        Replay { header: Header::new(blueprint, ticks), entries: self.entries[..seen].to_vec() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{self, blueprint::EffectModes};

    fn blueprint() -> Blueprint {
        scene::load("empty").unwrap().build(&[], None, &EffectModes::new()).unwrap()
    }

    #[test]
    fn undo_cuts_the_record_only_when_something_else_is_done() {
        let mut recorder = Recorder::default();
        let press = |amount| Intent::Press { stroke: Stroke::rectangle(Vec2::ZERO, Vec2::ONE), amount };
        for edits in 0..4 {
            recorder.note(10 * edits, edits, press(edits as f32));
        }
        let ticks = |replay: Replay| replay.entries.iter().map(|entry| entry.tick).collect::<Vec<_>>();
        assert_eq!(ticks(recorder.replay(&blueprint(), 40, 2)), [0, 10], "undone twice");
        assert_eq!(ticks(recorder.replay(&blueprint(), 40, 4)), [0, 10, 20, 30], "done again");
        recorder.note(15, 2, press(7.0));
        assert_eq!(ticks(recorder.replay(&blueprint(), 40, 3)), [0, 10, 15], "what was undone is gone");
    }

    #[test]
    fn a_replay_survives_its_file_to_the_last_bit() {
        let mut recorder = Recorder::default();
        let at = Vec2::new(0.1 + 0.2, 1.0 / 3.0);
        recorder.note(7, 0, Intent::Fill { element: crate::kernel::element::ElementId(1), at });
        recorder.note(7, 1, Intent::ClearAir);
        recorder.note(9, 2, Intent::Blow { stroke: Stroke::rectangle(at, at * 77.7), velocity: at * -1e-7 });
        let blueprint = blueprint();
        let replay = recorder.replay(&blueprint, 9, 3);
        let text = replay.write().unwrap();
        assert_eq!(text.lines().count(), 4);
        assert_eq!(Replay::read(&text, &blueprint.elements).unwrap(), replay);
    }
}
