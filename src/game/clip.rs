//! A recording as a film: run again without a window and drawn as the game draws it, frame by frame.

use crate::{
    game::{
        playback,
        render::{film::Film, offscreen::Offscreen},
    },
    kernel::units::TICKS_PER_SECOND,
    sim::{file::FileError, recording::Recording},
};
use glam::{UVec2, Vec2};
use std::io::{self, Write};

/// Longer side of a film of which no size is asked for, pixels.
const LONG_SIDE: f32 = 480.0;

/// Why there is no film.
#[derive(Debug, thiserror::Error)]
pub enum ClipError {
    /// The recording is not sound.
    #[error(transparent)]
    Recording(#[from] FileError),
    /// There is nothing to draw with.
    #[error("{0}")]
    Graphics(String),
    /// The file can't be written.
    #[error(transparent)]
    Unwritten(io::Error),
}

impl From<gif::EncodingError> for ClipError {
    fn from(error: gif::EncodingError) -> Self {
        Self::Unwritten(match error {
            gif::EncodingError::Io(error) => error,
            other => io::Error::other(other),
        })
    }
}

/// Writes a recording as a GIF of so many frames a second and, if one is asked for, of a size; how many frames it has.
/// `told` hears of every tick.
///
/// # Errors
/// If it is not sound, nothing can draw it, or the file can't be written.
pub fn write(
    recording: Recording,
    size: Option<UVec2>,
    rate: u32,
    out: impl Write,
    mut told: impl FnMut(),
) -> Result<u64, ClipError> {
    let ticks = recording.ticks();
    let start = recording.segments[0].start()?;
    let size = size.unwrap_or_else(|| fitted(start.setup.blueprint.domain.size));
    let mut offscreen = Offscreen::new(&start, size).map_err(ClipError::Graphics)?;
    playback::begin(offscreen.world_mut(), recording);
    let mut film = Film::begin(out, size, rate)?;
    let (mut done, mut frame) = (0, 0);
    while done <= ticks {
        film.add(offscreen.pixels().all())?;
        frame += 1;
        // In time, not in a whole number of ticks a frame.
        let until = frame * u64::from(TICKS_PER_SECOND) / u64::from(rate);
        for _ in done..until.min(ticks) {
            offscreen.tick();
            told();
        }
        done = until;
    }
    let (frames, mut out) = film.finish()?;
    out.flush().map_err(ClipError::Unwritten)?;
    Ok(frames)
}

/// The size of a film of a box.
fn fitted(size: Vec2) -> UVec2 {
    let side = |length: f32| (length / size.max_element() * LONG_SIDE).round().max(16.0) as u32;
    UVec2::new(side(size.x), side(size.y))
}
