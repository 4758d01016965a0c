//! Recordings as files.
//!
//! ```text
//! "PowderMaster recording\n" │ version, u16 │ chunk …                                  (numbers little-endian)
//!
//! chunk:  kind, u8 │ length of the body, u32 │ hash of the body, u64 │ body
//!   'S'   a state: a save file (`sim::checkpoint`). It begins a segment; one behind another stands where something put
//!         another world in the place of the one at hand (undo, reset, another scene)
//!   'T'   ticks: postcard of (the intents that were taken, `Vec<Entry>`; the mark of each tick, `Vec<Mark>`)
//!   'E'   the end: postcard of `End`. Nothing stands behind it
//! ```
//!
//! Everything is checked on reading, as a save file is. A file takes memory in proportion to its length; of the worlds in
//! it, only one is unfolded at a time. A program that was killed leaves a file without an end: `decode` refuses it,
//! `salvage` takes what is whole.

use crate::{
    kernel::{brush::Stroke, element::ElementTable, units::Scale},
    scene::{DETAIL, MOST_DETAIL},
    sim::{
        checkpoint::{Checkpoint, check},
        file::{FileError, Kind, VERSION},
        intent::Intent,
        mark::Mark,
        recording::segment::{End, Entry, Recording, Segment},
        snapshot::hash_bytes,
    },
};
use glam::Vec2;
use serde::{Serialize, de::DeserializeOwned};
use std::ops::RangeInclusive;

/// Ending of recordings.
pub const RECORDING_ENDING: &str = "pmr";
/// A recording.
pub(super) const RECORDING: Kind = Kind { name: "recording", magic: b"PowderMaster recording\n", version: VERSION };
/// What a file of format 1 begins with: text, input only, from the start of a scene.
const TEXT_FORMAT: &[u8] = b"{\"powder_master_replay\":";

/// Longest name of a challenge, bytes.
const LONGEST_NAME: usize = 100;

pub(super) const STATE: u8 = b'S';
pub(super) const TICKS: u8 = b'T';
const END: u8 = b'E';

impl Recording {
    /// Whether bytes are meant to be a recording, of whatever format.
    pub fn is_meant(bytes: &[u8]) -> bool {
        bytes.starts_with(RECORDING.magic) || bytes.starts_with(TEXT_FORMAT)
    }

    /// Reads a whole recording.
    ///
    /// # Errors
    /// If it is not one, was cut or changed, or holds what can't have been.
    pub fn decode(bytes: &[u8]) -> Result<Self, FileError> {
        let recording = Self::read(bytes, false)?;
        if recording.end.is_some() { Ok(recording) } else { Err(RECORDING.damaged("it has no end")) }
    }

    /// Reads what is whole of a recording that may break off.
    ///
    /// # Errors
    /// If not even its first state is whole.
    pub fn salvage(bytes: &[u8]) -> Result<Self, FileError> {
        Self::read(bytes, true)
    }

    /// It as a file; one that still runs ends with `end`. A segment that follows the one before needs no state of its own
    /// there.
    pub fn encode(&self, end: End) -> Vec<u8> {
        let mut writer = Writer::new();
        for (nth, segment) in self.segments.iter().enumerate() {
            if !self.follows(nth) {
                writer.start(&segment.save());
            }
            writer.ticks(&segment.entries, &segment.marks);
        }
        writer.end(self.end.unwrap_or(end));
        writer.take()
    }

    fn read(bytes: &[u8], lenient: bool) -> Result<Self, FileError> {
        if bytes.starts_with(TEXT_FORMAT) {
            return Err(FileError::Version(RECORDING.name, 1, VERSION));
        }
        let mut rest = RECORDING.open(bytes)?;
        let mut reader =
            Reader { segments: Vec::new(), elements: ElementTable::default(), scale: Scale::own(1.0), end: None };
        while !rest.is_empty() && reader.end.is_none() {
            match reader.chunk(&mut rest) {
                Err(_) if lenient && !reader.segments.is_empty() => break,
                outcome => outcome?,
            }
        }
        let Reader { segments, end, .. } = reader;
        match (&segments[..], end) {
            ([], _) => Err(RECORDING.damaged("it holds no state")),
            (_, Some(_)) if !rest.is_empty() && !lenient => Err(RECORDING.damaged("something stands behind its end")),
            _ => Ok(Self { segments, end }),
        }
    }
}

/// What was read so far.
struct Reader {
    segments: Vec<Segment>,
    /// Elements of the newest segment, and its spacing.
    elements: ElementTable,
    scale: Scale,
    end: Option<End>,
}

impl Reader {
    /// Reads a chunk; nothing changes if it is not good.
    fn chunk(&mut self, rest: &mut &[u8]) -> Result<(), FileError> {
        let (kind, body, behind) = cut_chunk(rest)?;
        match kind {
            STATE => self.state(body)?,
            TICKS => self.ticks(parse(body)?)?,
            END => self.end = Some(parse(body)?),
            _ => return Err(RECORDING.damaged(format_args!("a part of the unknown kind {kind}"))),
        }
        *rest = behind;
        Ok(())
    }

    fn state(&mut self, body: &[u8]) -> Result<(), FileError> {
        let start = Checkpoint::decode(body).map_err(|error| FileError::State(Box::new(error)))?;
        (self.elements, self.scale) = (start.setup.elements().clone(), start.setup.blueprint.scale);
        let tick = start.state.clock.tick;
        self.segments.push(Segment::read(body.to_vec(), tick));
        Ok(())
    }

    fn ticks(&mut self, (entries, marks): (Vec<Entry>, Vec<Mark>)) -> Result<(), FileError> {
        let Some(segment) = self.segments.last_mut() else {
            return Err(RECORDING.damaged("it does not begin with a state"));
        };
        // The states' ticks are bounded (`checkpoint::check`), and so many marks are in no file.
        let done = segment.now() + marks.len() as u64;
        let mut last = segment.entries.last().map_or(segment.tick, |entry| entry.tick);
        for entry in &entries {
            check_entry(entry, last..=done, &self.elements, self.scale).map_err(|what| RECORDING.unsound(what))?;
            last = entry.tick;
        }
        segment.entries.extend(entries);
        segment.marks.extend(marks);
        Ok(())
    }
}

/// Kind and body of the first chunk, and what stands behind it.
fn cut_chunk(bytes: &[u8]) -> Result<(u8, &[u8], &[u8]), FileError> {
    let short = || RECORDING.damaged("it breaks off");
    let (&[kind], bytes) = bytes.split_first_chunk().ok_or_else(short)?;
    let (length, bytes) = bytes.split_first_chunk().ok_or_else(short)?;
    let (hash, bytes) = bytes.split_first_chunk().ok_or_else(short)?;
    let (body, behind) = bytes.split_at_checked(u32::from_le_bytes(*length) as usize).ok_or_else(short)?;
    if u64::from_le_bytes(*hash) != hash_of(kind, body) {
        return Err(RECORDING.damaged("a part does not fit its checksum"));
    }
    Ok((kind, body, behind))
}

/// The kind is part of what is checked.
fn hash_of(kind: u8, body: &[u8]) -> u64 {
    hash_bytes(body) ^ u64::from(kind)
}

fn parse<T: DeserializeOwned>(body: &[u8]) -> Result<T, FileError> {
    match postcard::take_from_bytes(body) {
        Ok((value, [])) => Ok(value),
        Ok(_) => Err(RECORDING.damaged("a part is longer than what it holds")),
        Err(error) => Err(RECORDING.damaged(error)),
    }
}

fn check_entry(entry: &Entry, ticks: RangeInclusive<u64>, table: &ElementTable, scale: Scale) -> Result<(), String> {
    let elements = table.len();
    if !ticks.contains(&entry.tick) {
        return Err(format!(
            "an intent is due at tick {}; allowed here: {} to {}",
            entry.tick,
            ticks.start(),
            ticks.end()
        ));
    }
    let (element, places, numbers): (_, &[Vec2], &[f32]) = match &entry.intent {
        Intent::Draw { element, stroke }
        | Intent::Stamp { element, stroke }
        | Intent::Replace { element, stroke }
        | Intent::EraseOnly { element, stroke }
        | Intent::SetEmitter { element, stroke } => (Some(element), &places(stroke), &[stroke.radius]),
        Intent::Fill { element, at } | Intent::ReplaceAround { element, at } | Intent::EraseAround { element, at } => {
            (Some(element), &[*at], &[])
        }
        Intent::Pour { element, stroke, velocity, share } => {
            if !(0.0..=1.0).contains(share) {
                return Err(format!("{share} of a tick; allowed: 0 … 1"));
            }
            check::finite("the velocity of what is poured", *velocity)?;
            (Some(element), &places(stroke), &[stroke.radius])
        }
        Intent::Erase { stroke }
        | Intent::Ignite { stroke }
        | Intent::SetDrain { stroke }
        | Intent::RemoveSources { stroke } => (None, &places(stroke), &[stroke.radius]),
        Intent::Blow { stroke, velocity } => (None, &[stroke.from, stroke.to, *velocity], &[stroke.radius]),
        Intent::Press { stroke, amount } => (None, &places(stroke), &[stroke.radius, *amount]),
        Intent::Warm { stroke, degrees: kelvin } | Intent::SetTemperature { stroke, kelvin } => {
            (None, &places(stroke), &[stroke.radius, *kelvin])
        }
        Intent::Paste { piece, at, .. } => {
            piece.check().and_then(|()| piece.check_elements(table)).map_err(|what| format!("a piece: {what}"))?;
            (None, &[*at], &[])
        }
        Intent::PasteSources { springs } => {
            springs.check()?;
            let strange = springs.elements().find(|element| element.index() >= elements);
            return strange
                .map_or(Ok(()), |element| Err(format!("an emitter of element {}, which is none", element.0)));
        }
        Intent::ClearAir | Intent::Effect { .. } | Intent::Stroke | Intent::GiveUp => (None, &[], &[]),
        // Of another version it may be one that this one lacks: then nothing is judged.
        Intent::Begin { challenge } if challenge.len() > LONGEST_NAME => {
            return Err(format!("the name of a challenge has {} bytes; allowed: {LONGEST_NAME}", challenge.len()));
        }
        Intent::Begin { .. } => (None, &[], &[]),
        Intent::Quality { quality, .. } => return check::quality(quality),
        // Of whichever detail is in force by then: at the highest the d is shortest.
        Intent::Gravity { gravity } => {
            return check::gravity(*gravity, Scale { spacing: scale.own_spacing() / MOST_DETAIL as f32, ..scale });
        }
        Intent::Detail { detail } => {
            let holds = (DETAIL.min..=DETAIL.max).contains(detail);
            return if holds { Ok(()) } else { Err(format!("detail {detail}; allowed: {DETAIL}")) };
        }
    };
    if let Some(element) = element.filter(|element| element.index() >= elements) {
        return Err(format!("element {} is not one of the {elements} elements (0 … {})", element.0, elements - 1));
    }
    if !(places.iter().all(|place| place.is_finite()) && numbers.iter().all(|number| number.is_finite())) {
        return Err("a coordinate or amount of an intent is not a number".to_owned());
    }
    Ok(())
}

fn places(stroke: &Stroke) -> [Vec2; 2] {
    [stroke.from, stroke.to]
}

/// Writes a recording, all at once or as it comes.
#[derive(Clone, Debug)]
pub struct Writer(Vec<u8>);

impl Default for Writer {
    fn default() -> Self {
        Self::new()
    }
}

impl Writer {
    /// The beginning of a file.
    pub fn new() -> Self {
        Self(RECORDING.begin())
    }

    /// A state, given as a save file.
    pub fn start(&mut self, save: &[u8]) {
        self.chunk(STATE, save);
    }

    /// What came after it.
    pub fn ticks(&mut self, entries: &[Entry], marks: &[Mark]) {
        if !(entries.is_empty() && marks.is_empty()) {
            self.chunk(TICKS, &bytes(&(entries, marks)));
        }
    }

    /// How it ended.
    pub fn end(&mut self, end: End) {
        self.chunk(END, &bytes(&end));
    }

    /// What was written since this was asked last.
    pub fn take(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.0)
    }

    pub(super) fn chunk(&mut self, kind: u8, body: &[u8]) {
        self.0.push(kind);
        self.0.extend((body.len() as u32).to_le_bytes());
        self.0.extend(hash_of(kind, body).to_le_bytes());
        self.0.extend(body);
    }
}

fn bytes(value: &impl Serialize) -> Vec<u8> {
    // Writing to memory has no way to fail, and every length is known.
    postcard::to_stdvec(value).unwrap_or_default()
}
