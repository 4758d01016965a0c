//! A run, one line a tick.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::{balance::matter, run::Observer},
    scene::passes::Pass,
    sim::{
        ledger::PassLedger,
        state::{AirGrid, Clock, Rock},
    },
};
use bevy::ecs::world::World;
use std::{
    io::{self, Write},
    mem,
};

/// Writes the table. Times in s and ms, lengths in m, speeds in m/s; energy (J), momentum (kg m/s) of the movable particles
/// for each metre of depth; the air's mass in its own unit (one cell of air at rest is 1).
pub struct Trace<W: Write> {
    table: csv::Writer<W>,
    /// Whether the names of the columns are written.
    is_begun: bool,
    predictions: u64,
    /// Why it can't be written on. The world goes on, for what else is to be known of it.
    fault: Option<io::Error>,
}

impl<W: Write> Trace<W> {
    /// A table without lines.
    pub fn new(out: W) -> Self {
        Self { table: csv::Writer::from_writer(out), is_begun: false, predictions: 0, fault: None }
    }

    /// Ends the table and returns what it was written to.
    ///
    /// # Errors
    /// If it could not be written.
    pub fn finish(self) -> io::Result<W> {
        match self.fault {
            Some(fault) => Err(fault),
            None => self.table.into_inner().map_err(csv::IntoInnerError::into_error),
        }
    }

    fn write(&mut self, columns: &[(&str, String)]) -> csv::Result<()> {
        if !mem::replace(&mut self.is_begun, true) {
            self.table.write_record(columns.iter().map(|(name, _)| name))?;
        }
        self.table.write_record(columns.iter().map(|(_, value)| value))
    }
}

impl<W: Write> Observer for Trace<W> {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        let (ledger, tick) = (world.resource::<PassLedger>(), world.resource::<Clock>().tick);
        let (matter, rock) = (matter(world), world.resource::<Rock>());
        let balance = matter.balance();
        let predictions = ledger.record(Pass::Predict).calls;
        let or_empty = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        let columns = [
            ("tick", tick.to_string()),
            ("seconds", (tick as f64 / f64::from(TICKS_PER_SECOND)).to_string()),
            ("ms", (ledger.last_tick().as_secs_f64() * 1e3).to_string()),
            ("substeps", (predictions - self.predictions).to_string()),
            ("particles", (matter.particles.len() + rock.count()).to_string()),
            ("energy", balance.energy().to_string()),
            ("momentum_x", balance.momentum.x.to_string()),
            ("momentum_y", balance.momentum.y.to_string()),
            ("front_x", or_empty(matter.front())),
            ("surface_y", or_empty(matter.surface())),
            ("max_speed", balance.max_speed.to_string()),
            ("air_mass", world.resource::<AirGrid>().with_grid(rock).mass().to_string()),
        ];
        self.predictions = predictions;
        if self.fault.is_none() {
            self.fault = self.write(&columns).err().map(|error| match error.into_kind() {
                csv::ErrorKind::Io(fault) => fault,
                kind => io::Error::other(format!("{kind:?}")),
            });
        }
        Ok(())
    }

    fn after_warmup(&mut self, _world: &World) {
        // The ledger begins anew.
        self.predictions = 0;
    }
}
