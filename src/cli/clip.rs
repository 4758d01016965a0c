//! `clip`: a recording as a moving picture.

use crate::cli::{args::ClipArguments, failure::Failure};

/// Draws a recording and writes it as a GIF.
#[cfg(feature = "app")]
pub(super) fn clip(arguments: &ClipArguments) -> Result<(), Failure> {
    use crate::{
        cli::{
            output, progress,
            start::{bad, read},
        },
        game::clip::{self, ClipError},
        sim::recording::Recording,
    };

    let ClipArguments { file, gif, size, fps } = arguments;
    output::check(&[gif])?;
    let recording = Recording::decode(&read(file)?).map_err(|error| bad(file, &error))?;
    let line = progress::bar(recording.ticks());
    let mut out = output::create(gif)?;
    let frames = clip::write(recording, *size, *fps, &mut out, || line.inc(1)).map_err(|error| match error {
        ClipError::Recording(error) => bad(file, &error),
        ClipError::Graphics(reason) => Failure::Usage(reason),
        ClipError::Unwritten(error) => Failure::unwritten(gif, error),
    })?;
    out.finish().map_err(|error| Failure::unwritten(gif, error))?;
    output::print(&format!("{}: {frames} frames\n", gif.display()))
}

/// A build without graphics says so.
#[cfg(not(feature = "app"))]
pub(super) fn clip(_: &ClipArguments) -> Result<(), Failure> {
    Err(Failure::Usage("this build draws nothing (it lacks the cargo feature `app`)".to_owned()))
}
