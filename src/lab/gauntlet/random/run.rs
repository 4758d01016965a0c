//! Runs many random worlds, a few at a time, and keeps those that fail.

use super::{
    examine::examine,
    shrink::{first_broken, shrink},
    tally::{Failure, Tally},
    world::World,
};
use crate::{
    kernel::params::Preset,
    lab::{cases::Shard, gauntlet::judged::Found, jobs::pool},
};
use std::{io, path::Path};

/// Which worlds are to be run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What they are made from, beside their index.
    pub seed: u64,
    /// How many, of all shards.
    pub count: u64,
    /// Qualities that a world may begin at.
    pub presets: Vec<Preset>,
    /// The part to run, if not all.
    pub shard: Option<Shard>,
    /// Worlds at a time, each on one thread.
    pub threads: usize,
}

impl Plan {
    /// Indices of the worlds to run.
    pub fn worlds(&self) -> Vec<u64> {
        (0..self.count).filter(|index| self.shard.is_none_or(|shard| shard.has(*index))).collect()
    }
}

/// Runs the worlds of a plan and keeps what fails in a folder, which is made if it is needed. `report` is called with how
/// many are done, and with the one that begins.
///
/// # Errors
/// If a file can't be written.
pub fn run(plan: &Plan, folder: &Path, report: impl Fn(usize, u64) + Sync) -> io::Result<Tally> {
    let qualities = plan.presets.iter().map(|preset| preset.name().to_owned()).collect();
    let mut tally = Tally::new(plan.seed, plan.count, qualities, plan.shard);
    let worlds = plan.worlds();
    let one = |&index: &u64| {
        let world = World::new(plan.seed, index, &plan.presets);
        let found = examine(&world.case());
        let failure = keep(&world, plan.seed, index, &found, folder)?;
        Ok::<_, io::Error>((index, world.preset, found, failure))
    };
    for result in pool::run(&worlds, plan.threads, |_| 0, |done, &index| report(done, index), one) {
        let (index, preset, found, failure) = result?;
        tally.add(index, preset.name(), &found, failure);
    }
    Ok(tally)
}

/// Keeps a world that breaks a rule, as small as that is cheap.
fn keep(world: &World, seed: u64, index: u64, found: &Found, folder: &Path) -> io::Result<Option<Failure>> {
    let Some((rule, tick)) = first_broken(found) else { return Ok(None) };
    let broken = found.faults();
    let rules = found.broken().map(|(rule, measured)| (rule, measured.share())).collect();
    let what = format!("World {seed}/{index} at {}: {}", world.preset.name(), broken.join("; "));
    let file = shrink(world, (rule, tick), &what).keep(folder)?.display().to_string();
    Ok(Some(Failure { world: index, quality: world.preset.name().to_owned(), rules, broken, file }))
}
