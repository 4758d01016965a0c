//! How far a run goes from the reference over time.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::{coarse::Distance, reference::Point},
};
use std::io::{self, Write};

/// Writes the table; the parts of the distance are those of [`Distance`].
///
/// # Errors
/// If it can't be written.
pub fn write(points: &[Point], out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(["tick", "seconds", "share", "momentum", "air", "energy_ratio"])?;
    for Point { tick, distance: Distance { share, momentum, air }, energy_ratio } in points {
        let seconds = *tick as f64 / f64::from(TICKS_PER_SECOND);
        let ratio = Some(*energy_ratio).filter(|ratio| ratio.is_finite());
        let figures = [*share, *momentum, *air, ratio].map(|figure| figure.map(|figure| figure.to_string()));
        let record = [Some(tick.to_string()), Some(seconds.to_string())].into_iter().chain(figures);
        table.write_record(record.map(Option::unwrap_or_default))?;
    }
    table.flush()
}
