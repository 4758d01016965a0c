//! What gauges read, as comma separated values: a line for each tick. A field is empty where there is nothing to measure.

use crate::{
    kernel::{element::ElementId, units::TICKS_PER_SECOND},
    lab::{
        gauges::{
            place::Place,
            quantity::{Of, QUANTITIES, Quantity},
            set::{Gauge, Gauges, Reading, Sample, flow},
        },
        run::Observer,
    },
    sim::state::{Clock, Setup},
};
use bevy::ecs::world::World;
use std::{
    fmt::Write as _,
    io::{self, Write},
};

/// The quantities of a gauge.
fn columns(place: Place) -> impl Iterator<Item = &'static Quantity> {
    let is_line = matches!(place, Place::Line { .. });
    QUANTITIES.iter().filter(move |quantity| matches!(quantity.of, Of::Line(_)) == is_line)
}

/// The names of the columns of some gauges; of lines also the flow of `elements`, by their names.
fn head(gauges: &Gauges, elements: &[(ElementId, String)]) -> String {
    let mut text = String::from("tick,time_s");
    for Gauge { number, place, .. } in gauges.iter() {
        for quantity in columns(*place) {
            let _ = write!(text, ",gauge{number}_{}", quantity.column);
        }
        if let Place::Line { .. } = place {
            for (_, name) in elements {
                let _ = write!(text, ",gauge{number}_{name}_flow_m2_per_s");
            }
        }
    }
    text.push('\n');
    text
}

/// The first fields of a line.
fn begin(line: &mut String, tick: u64) {
    let _ = write!(line, "{tick},{}", tick as f64 / f64::from(TICKS_PER_SECOND));
}

/// The fields of a gauge's reading, or as many empty ones.
fn put(line: &mut String, place: Place, reading: Option<&Reading>) {
    for quantity in columns(place) {
        line.push(',');
        if let Some(value) = reading.and_then(|reading| quantity.value(reading)) {
            // Readings at places are of f32: no more figures than that has.
            let _ = match quantity.of {
                Of::Spot(_) => write!(line, "{}", value as f32),
                Of::Line(_) => write!(line, "{value}"),
            };
        }
    }
}

/// The table of all readings that are kept.
pub fn text(gauges: &Gauges) -> String {
    let mut text = head(gauges, &[]);
    let mut rows: Vec<_> = gauges.iter().map(|gauge| gauge.samples().peekable()).collect();
    while let Some(tick) = rows.iter_mut().filter_map(|row| row.peek().map(|sample| sample.tick)).min() {
        begin(&mut text, tick);
        for (gauge, row) in gauges.iter().zip(&mut rows) {
            let sample: Option<&Sample> = row.next_if(|sample| sample.tick == tick);
            put(&mut text, gauge.place, sample.map(|sample| &sample.reading));
        }
        text.push('\n');
    }
    text
}

/// Writes the readings of a run as they come.
pub struct Readings<W: Write> {
    gauges: Gauges,
    /// Elements whose flow has a column of its own.
    elements: Vec<(ElementId, String)>,
    out: W,
    line: String,
    /// Why it can't be written on. The world goes on, for what else is to be known of it.
    fault: Option<io::Error>,
}

impl<W: Write> Readings<W> {
    /// A table without lines of gauges that are set.
    pub fn begin(gauges: Gauges, elements: Vec<(ElementId, String)>, mut out: W) -> Self {
        let fault = out.write_all(head(&gauges, &elements).as_bytes()).err();
        Self { gauges, elements, out, line: String::new(), fault }
    }

    /// Ends the table and returns what it was written to.
    ///
    /// # Errors
    /// If it could not be written.
    pub fn finish(mut self) -> io::Result<W> {
        match self.fault {
            Some(fault) => Err(fault),
            None => self.out.flush().map(|()| self.out),
        }
    }
}

impl<W: Write> Observer for Readings<W> {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        let Self { gauges, elements, out, line, fault } = self;
        if fault.is_some() {
            return Ok(());
        }
        gauges.read(world);
        let setup = world.resource::<Setup>();
        line.clear();
        begin(line, world.resource::<Clock>().tick);
        for gauge in gauges.iter() {
            put(line, gauge.place, gauge.latest());
            if let Place::Line { .. } = gauge.place {
                for (element, _) in elements.iter() {
                    let [_, now] = gauge.crossed(*element);
                    let _ = write!(line, ",{}", flow(setup, now));
                }
            }
        }
        line.push('\n');
        *fault = out.write_all(line.as_bytes()).err();
        Ok(())
    }
}
