//! The gauges of a run, and where their readings go.

use crate::{
    cli::{args::RunArguments, failure::Failure, output},
    lab::gauges::{
        place::{Place, usual_radius},
        set::Gauges,
        table::Readings,
    },
    sim::{new_file::NewFile, state::Setup},
};
use bevy::ecs::world::World;
use std::{
    io::{self, BufWriter, Stdout, Write},
    path::Path,
};

/// Where readings go.
pub(super) enum Sink {
    /// Into a file.
    File(NewFile),
    /// To stdout.
    Stdout(BufWriter<Stdout>),
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.write(bytes),
            Self::Stdout(out) => out.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::File(file) => file.flush(),
            Self::Stdout(out) => out.flush(),
        }
    }
}

/// Refuses gauges that nobody reads, and readings without a gauge.
pub(super) fn check(arguments: &RunArguments) -> Result<(), Failure> {
    let bad = |what: &str| Err(Failure::Usage(what.to_owned()));
    match (arguments.readings.is_some(), arguments.gauges.is_empty() && arguments.gauge_lines.is_empty()) {
        (true, true) => {
            bad("--readings has nothing to write; allowed: with --gauge X,Y[,R] or --gauge-line X1,Y1,X2,Y2")
        }
        (false, false) => {
            bad("the gauges are read by nobody; allowed: --gauge and --gauge-line with --readings FILE.csv")
        }
        _ if output::is_stdout(arguments.readings.as_deref()) && output::is_stdout(arguments.metrics.as_deref()) => {
            bad("--readings and --metrics can't both have stdout; allowed: a file for one")
        }
        _ => Ok(()),
    }
}

/// Sets the gauges in a world: those at places, then the lines, each in the order of the command line.
fn set(arguments: &RunArguments, world: &World) -> Result<Gauges, Failure> {
    let setup = world.resource::<Setup>();
    let spots = arguments.gauges.iter().map(|(at, radius)| {
        let place = Place::Spot { at: *at, radius: radius.unwrap_or_else(|| usual_radius(setup)) };
        ("--gauge", place)
    });
    let lines = arguments.gauge_lines.iter().map(|(from, to)| ("--gauge-line", Place::Line { from: *from, to: *to }));
    let mut gauges = Gauges::keeping(1);
    for (option, place) in spots.chain(lines) {
        gauges.set(world, place).map_err(|what| Failure::Usage(format!("{option}: {what}")))?;
    }
    Ok(gauges)
}

/// Begins the table of what is read in a world, if it is asked for.
pub(super) fn begin(arguments: &RunArguments, world: &World) -> Result<Option<Readings<Sink>>, Failure> {
    let Some(path) = &arguments.readings else { return Ok(None) };
    let gauges = set(arguments, world)?;
    let table = world.resource::<Setup>().elements();
    let elements = arguments.gauge_elements.iter().map(|name| {
        let names = || table.rows().iter().map(|row| &row.name[..]).collect::<Vec<_>>().join(", ");
        let bad = || Failure::Usage(format!("--gauge-element {name}: there is no such element; allowed: {}", names()));
        table.find(name).map(|id| (id, name.clone())).ok_or_else(bad)
    });
    let elements = elements.collect::<Result<Vec<_>, _>>()?;
    let sink = match output::is_stdout(Some(path)) {
        true => Sink::Stdout(BufWriter::new(io::stdout())),
        false => Sink::File(output::create(path)?),
    };
    Ok(Some(Readings::begin(gauges, elements, sink)))
}

/// Ends the table. A pipe that its reader has closed is no failure.
pub(super) fn finish(path: &Path, readings: Readings<Sink>) -> Result<(), Failure> {
    let written = readings.finish().and_then(|sink| match sink {
        Sink::File(file) => file.finish().map(drop),
        Sink::Stdout(_) => Ok(()),
    });
    match written {
        Err(error) if output::is_stdout(Some(path)) && error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) if output::is_stdout(Some(path)) => {
            Err(Failure::Outcome(format!("stdout: can't be written: {error}")))
        }
        written => written.map_err(|error| Failure::unwritten(path, error)),
    }
}
