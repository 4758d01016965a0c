//! A run, one line a tick.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::{balance::matter, run::Observer},
    scene::effects::Pass,
    sim::{
        ledger::PassLedger,
        state::{AirGrid, Clock, Rock},
    },
};
use bevy::ecs::world::World;
use std::io::{self, Write};

/// Names of the columns. Times in s and ms, lengths in m, speeds in m/s; energy (J), momentum (kg m/s) of the movable
/// particles for each metre of depth; the air's mass in its own unit (one cell of air at rest is 1).
pub const COLUMNS: [&str; 12] = [
    "tick",
    "seconds",
    "ms",
    "substeps",
    "particles",
    "energy",
    "momentum_x",
    "momentum_y",
    "front_x",
    "surface_y",
    "max_speed",
    "air_mass",
];

/// Writes the table.
pub struct Trace<W: Write> {
    table: csv::Writer<W>,
    predictions: u64,
}

impl<W: Write> Trace<W> {
    /// Begins with the names of the columns.
    pub fn new(out: W) -> io::Result<Self> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(COLUMNS)?;
        Ok(Self { table, predictions: 0 })
    }

    /// Ends the table.
    pub fn finish(mut self) -> io::Result<()> {
        self.table.flush()
    }
}

impl<W: Write> Observer for Trace<W> {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        let (ledger, tick) = (world.resource::<PassLedger>(), world.resource::<Clock>().tick);
        let (matter, air) = (matter(world), world.resource::<AirGrid>());
        let balance = matter.balance();
        let predictions = ledger.record(Pass::Predict).calls;
        let substeps = predictions - self.predictions;
        self.predictions = predictions;
        let or_empty = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        let record: [String; COLUMNS.len()] = [
            tick.to_string(),
            (tick as f64 / f64::from(TICKS_PER_SECOND)).to_string(),
            (ledger.last_tick().as_secs_f64() * 1e3).to_string(),
            substeps.to_string(),
            (matter.particles.len() + world.resource::<Rock>().count()).to_string(),
            balance.energy().to_string(),
            balance.momentum.x.to_string(),
            balance.momentum.y.to_string(),
            or_empty(matter.front()),
            or_empty(matter.surface()),
            balance.max_speed.to_string(),
            air.with_grid(world.resource::<Rock>()).mass().to_string(),
        ];
        Ok(self.table.write_record(record)?)
    }

    fn after_warmup(&mut self, _world: &World) {
        // The ledger begins anew.
        self.predictions = 0;
    }
}
