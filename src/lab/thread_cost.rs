//! What more threads bring: ticks of a world on 1, 2, 4 … threads, pass by pass, and what as many threads would bring that the
//! machine does not have.

use crate::{
    kernel::params::Preset,
    lab::{
        experiment::{ExperimentError, Run, interleaved, time},
        run::{Observer, Plan},
        sampler::ms,
        stats,
    },
    scene::{self, blueprint::Blueprint, effects::EffectModes, passes::Pass},
    sim::{ledger::PassLedger, simulation::Simulation, state::ParticleStore, workers::Workers},
};
use bevy::ecs::world::World;
use serde::Serialize;
use std::{io, sync::Arc};

/// Ticks that are not timed, and that are: the second second. A dam's front then runs to the far wall.
const WARMUP: u64 = 60;
const TIMED: u64 = 60;

/// What a tick takes on some numbers of threads. Every run has the same work in the same tick and other programs only ever add to its
/// time, so of each tick the shortest of the rounds counts. Times are means over the ticks, ms; those of the passes are of the same
/// rounds, so that the difference to the whole tick is what passes between them.
#[derive(Clone, Debug, Serialize)]
pub struct ThreadCost {
    /// Name of the scene.
    pub scene: &'static str,
    /// Movable particles at the end.
    pub particles: usize,
    /// Numbers of threads, ascending from 1.
    pub threads: Vec<usize>,
    /// The whole tick, on each of them.
    pub ms: Vec<f64>,
    /// The passes that ran, in their order.
    pub passes: Vec<PassTimes>,
    /// Whether all runs ended in the same world.
    pub same_hash: bool,
}

/// What a pass takes of a tick on each number of threads, ms.
#[derive(Clone, Debug, Serialize)]
pub struct PassTimes {
    /// Its name.
    pub pass: &'static str,
    /// Times.
    pub ms: Vec<f64>,
}

impl ThreadCost {
    /// The speed-up on each number of threads: how many times faster a tick is than on one.
    pub fn speedups(&self) -> impl Iterator<Item = f64> {
        self.ms.iter().map(|ms| self.ms[0] / ms)
    }

    /// The speed-up on `threads` by Amdahl's law, from the times on one and on two; `None` without two.
    pub fn predicted(&self, threads: usize) -> Option<f64> {
        let serial = (serial(&self.ms)? / self.ms[0]).clamp(0.0, 1.0);
        Some(1.0 / (serial + (1.0 - serial) / threads as f64))
    }
}

/// What of the time on one thread a second one does not shorten, ms, from the times on one and on two: Amdahl's law, t(n) = s + (t(1) − s)/n.
/// Below 0 where two are more than twice as fast. `None` without two.
pub fn serial(ms: &[f64]) -> Option<f64> {
    let [one, two, ..] = ms else { return None };
    Some(2.0 * two - one)
}

/// 1, 2, 4 … up to `most`, and that.
pub fn counts(most: usize) -> Vec<usize> {
    let doubled = std::iter::successors(Some(1), |count| Some(2 * count));
    doubled.take_while(|count| *count < most).chain([most.max(1)]).collect()
}

/// Measures a built-in scene on each number of threads in so many rounds, in turn.
///
/// # Errors
/// If there is no such scene, or if the system gives no threads.
pub fn measure(
    name: &'static str,
    settings: &[(String, String)],
    preset: Preset,
    threads: &[usize],
    rounds: usize,
) -> Result<ThreadCost, ExperimentError> {
    let blueprint = Arc::new(scene::load(name)?.build(settings, Some(preset), &EffectModes::new())?);
    let pools = threads.iter().map(|threads| Workers::new(*threads)).collect::<Result<Vec<_>, _>>()?;
    let mut shortest = vec![Vec::new(); pools.len()];
    let (mut hashes, mut particles) = (Vec::new(), 0);
    for (_, k) in interleaved(pools.len(), rounds) {
        // Within the pool, where a tick need not enter it, as in a run.
        let (run, times, count) = pools[k].run(|_| run(&blueprint, &pools[k]))?;
        keep_shortest(&mut shortest[k], times);
        hashes.push(run.hash);
        particles = count;
    }
    let mean = |column: usize| {
        let of = |times: &Vec<[f64; COLUMNS]>| stats::mean(times.iter().map(|times| times[column]));
        shortest.iter().filter_map(of).collect::<Vec<_>>()
    };
    let passes = Pass::ALL.into_iter().map(|pass| PassTimes { pass: pass.row().name, ms: mean(pass as usize) });
    Ok(ThreadCost {
        scene: name,
        particles,
        threads: threads.to_vec(),
        ms: mean(COLUMNS - 1),
        passes: passes.filter(|times| times.ms[0] > 0.0).collect(),
        same_hash: hashes.iter().all(|hash| *hash == hashes[0]),
    })
}

/// A time for each pass, and the whole tick's.
const COLUMNS: usize = Pass::ALL.len() + 1;

/// Runs the world once; returns the run, what its ticks took, and how many particles there are at its end.
fn run(blueprint: &Arc<Blueprint>, workers: &Workers) -> io::Result<(Run, Vec<[f64; COLUMNS]>, usize)> {
    let mut world = Simulation::new(blueprint.clone(), workers.clone());
    let mut passes = Passes::default();
    let plan = Plan { ticks: WARMUP + TIMED, warmup: WARMUP, ..Plan::default() };
    let run = time(&mut world, &plan, &mut [&mut passes])?;
    Ok((run, passes.ms, world.get::<ParticleStore>().len()))
}

/// Keeps each tick of a round that was shorter as a whole than in those before.
fn keep_shortest(shortest: &mut Vec<[f64; COLUMNS]>, round: Vec<[f64; COLUMNS]>) {
    if shortest.is_empty() {
        *shortest = round;
        return;
    }
    for (shortest, tick) in shortest.iter_mut().zip(round) {
        if tick[COLUMNS - 1] < shortest[COLUMNS - 1] {
            *shortest = tick;
        }
    }
}

/// Notes what each pass takes of each tick after the warm-up, ms.
#[derive(Default)]
struct Passes {
    ms: Vec<[f64; COLUMNS]>,
}

impl Observer for Passes {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        let ledger = world.resource::<PassLedger>();
        let mut times = [ms(ledger.last_tick()); COLUMNS];
        for (time, pass) in times.iter_mut().zip(Pass::ALL) {
            *time = ms(ledger.record(pass).last.time);
        }
        self.ms.push(times);
        Ok(())
    }

    fn after_warmup(&mut self, _world: &World) {
        self.ms.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tick_is_made_of_its_passes_and_the_same_on_all_threads() {
        let columns = [("columns".to_owned(), "60".to_owned())];
        let cost = measure("dam_break", &columns, Preset::Draft, &[1, 2], 1).unwrap();
        assert!(cost.same_hash && cost.particles == 7_200 && cost.ms.len() == 2, "{cost:?}");
        for (k, tick) in cost.ms.iter().enumerate() {
            let passes: f64 = cost.passes.iter().map(|pass| pass.ms[k]).sum();
            assert!(passes > 0.5 * tick && passes <= *tick, "{cost:?}");
        }
        let named = |name: &str| cost.passes.iter().any(|pass| pass.pass == name);
        assert!(named("solve") && named("pressure") && !named("air"), "{cost:?}");
        assert!(measure("no such scene", &[], Preset::Draft, &[1], 1).is_err());
    }

    #[test]
    fn a_tick_counts_as_a_whole_where_it_was_shortest() {
        let tick = |solve: f64, whole: f64| {
            let mut times = [0.0; COLUMNS];
            (times[Pass::Solve as usize], times[COLUMNS - 1]) = (solve, whole);
            times
        };
        let mut shortest = Vec::new();
        keep_shortest(&mut shortest, vec![tick(2.0, 5.0), tick(3.0, 4.0)]);
        keep_shortest(&mut shortest, vec![tick(1.0, 6.0), tick(3.5, 3.8)]);
        assert_eq!(shortest, [tick(2.0, 5.0), tick(3.5, 3.8)]);
    }

    #[test]
    fn more_threads_are_predicted_by_amdahls_law() {
        // A fifth is serial.
        let amdahl = |threads: f64| 0.2 + 0.8 / threads;
        let cost = ThreadCost {
            scene: "a world",
            particles: 1,
            threads: vec![1, 2],
            ms: [1.0, 2.0].map(|threads| 3.0 * amdahl(threads)).to_vec(),
            passes: Vec::new(),
            same_hash: true,
        };
        for threads in [1, 2, 4, 16] {
            let predicted = cost.predicted(threads).unwrap();
            assert!((predicted * amdahl(threads as f64) - 1.0).abs() < 1e-12, "{threads}: {predicted}");
        }
        let of = |ms: &[f64]| ThreadCost { ms: ms.to_vec(), ..cost.clone() };
        assert_eq!(of(&[1.0]).predicted(4), None);
        assert_eq!(of(&[1.0, 0.4]).predicted(4), Some(4.0), "more than twice as fast is no serial part below nothing");
        assert_eq!(of(&[1.0, 1.5]).predicted(4), Some(1.0));
    }

    #[test]
    fn threads_double_up_to_all() {
        assert_eq!([0, 1, 2, 3, 16].map(counts), [vec![1], vec![1], vec![1, 2], vec![1, 2, 3], vec![1, 2, 4, 8, 16]]);
    }
}
