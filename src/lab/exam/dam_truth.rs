//! How far a dam break is from a converged run of it: the share of the liquid that stands elsewhere, at the same
//! dimensionless times `T = t √(2g/a)` (a: the base of the block). A run of more columns is Froude's model of one of fewer.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::exam::{
        set_up::{GRAVITY, SetUp, Start},
        shares::Shares,
    },
    scene::SceneError,
};
use std::collections::{BTreeMap, BTreeSet};

/// Particles along the base of the converged run.
pub(super) const CONVERGED: u32 = 284;

/// Times T at which it is looked at.
pub const TIMES: [f64; 3] = [1.0, 1.75, 2.5];

/// The box, in bases of the block.
const BOX: [f64; 2] = [4.0, 2.1];

/// Spacing of the scene, m.
const SPACING: f64 = 0.1;

/// Ticks at which a block of so many columns is looked at.
fn ticks(columns: u32) -> [u32; 3] {
    let base = f64::from(columns) * SPACING;
    TIMES.map(|time| (time * (base / (2.0 * GRAVITY)).sqrt() * f64::from(TICKS_PER_SECOND)).round() as u32)
}

/// The same moments in ticks of the converged run.
fn converged_at(columns: u32) -> [f64; 3] {
    ticks(columns).map(|tick| f64::from(tick) * f64::from(CONVERGED).sqrt() / f64::from(columns).sqrt())
}

/// Where the liquid of a dam break stands at each time.
pub(super) async fn looks(set_up: &SetUp, columns: u32, start: Start) -> Result<Vec<Shares>, SceneError> {
    Ok(looks_at(set_up, columns, ticks(columns), start).await?.into_values().collect())
}

/// Where it stands after these ticks, in ascending order.
async fn looks_at(
    set_up: &SetUp,
    columns: u32,
    ticks: impl IntoIterator<Item = u32>,
    start: Start,
) -> Result<BTreeMap<u32, Shares>, SceneError> {
    let mut simulation = set_up.open_from("dam_break", &[("columns", f64::from(columns))], start)?;
    let mut looks = BTreeMap::new();
    for tick in ticks {
        while simulation.ticks < tick {
            simulation.tick().await;
        }
        looks.insert(tick, Shares::of(&simulation, f64::from(columns) * SPACING, BOX));
    }
    Ok(looks)
}

/// A converged run, where blocks of some columns are compared with it.
pub(super) struct Converged(BTreeMap<u32, Shares>);

impl Converged {
    /// Runs it for the comparison with blocks of these columns.
    pub async fn run(set_up: &SetUp, columns: &[u32]) -> Result<Self, SceneError> {
        let moments = columns.iter().flat_map(|columns| converged_at(*columns));
        // What lies between two ticks is interpolated.
        let ticks: BTreeSet<u32> = moments.flat_map(|tick| [tick as u32, tick as u32 + 1]).collect();
        looks_at(set_up, CONVERGED, ticks, Start::Lattice).await.map(Self)
    }

    /// Shares of the liquid that stand elsewhere, at each time.
    pub fn errors(&self, columns: u32, looks: &[Shares]) -> Vec<f64> {
        let error = |(look, tick): (&Shares, f64)| {
            let below = tick as u32;
            look.distance(&self.0[&below].towards(&self.0[&(below + 1)], tick.fract()))
        };
        looks.iter().zip(converged_at(columns)).map(error).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_sizes_are_looked_at_at_the_same_dimensionless_times() {
        for columns in [18, 71, CONVERGED] {
            let base = f64::from(columns) * SPACING;
            for (tick, time) in ticks(columns).into_iter().zip(TIMES) {
                let found = f64::from(tick) / f64::from(TICKS_PER_SECOND) * (2.0 * GRAVITY / base).sqrt();
                // Half a tick.
                let half = 0.5 / f64::from(TICKS_PER_SECOND) * (2.0 * GRAVITY / base).sqrt();
                assert!((found - time).abs() <= half, "{columns} columns: {found}, not {time}");
            }
        }
        assert_eq!(
            converged_at(71).map(|tick| tick / 2.0),
            ticks(71).map(f64::from),
            "four times the size, twice the time"
        );
    }
}
