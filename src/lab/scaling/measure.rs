//! The runs: sizes in ascending order; at each size all settings in interleaved rounds, on one thread and on several.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::{
        experiment::{ExperimentError, Spread, interleaved, time},
        run,
        sampler::Sampler,
        scaling::plan::{Plan, SCENE, Setting, particles},
    },
    scene::{self, SceneError, blueprint::Blueprint, effects::EffectModes},
    sim::{simulation::Simulation, workers::Workers},
};
use bevy::platform::time::Instant;
use serde::Serialize;
use std::{io, sync::Arc};

/// Ticks that are timed, and from which the error is sampled: after the first of them, up to the last, the scene's start
/// being tick 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Window {
    /// First tick.
    pub first: u64,
    /// Last tick.
    pub last: u64,
}

impl Window {
    /// The window of the comparison with other programs: from the first second to the fifth.
    const LONG: Self = Self { first: 60, last: 299 };
    /// The second second, while the front runs to the far wall: for what takes long.
    const SHORT: Self = Self { first: 60, last: 119 };

    /// Ticks to run for it, with those before.
    fn ticks(self) -> u64 {
        self.last + 1
    }
}

/// One setting at one size.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Setting.
    pub setting: &'static str,
    /// Particles.
    pub particles: usize,
    /// Threads of each of the following times: 1, and all.
    pub threads: Vec<usize>,
    /// Time of a tick, ms: the median over the rounds of the median over the window.
    pub ms: Vec<f64>,
    /// The least and the greatest of the rounds' medians, ms.
    pub ms_range: Vec<[f64; 2]>,
    /// How many times faster all threads are than one: the median of the rounds' ratios. `None` with one thread only.
    pub speedup: Option<f64>,
    /// Mean density error (see `lab::density`) over the window.
    pub error_mean: Option<f64>,
    /// 99th percentile of the density error.
    pub error_p99: Option<f64>,
    /// Bytes that the simulation holds for each particle.
    pub bytes_per_particle: f64,
    /// Particles found outside the box.
    pub escaped: u64,
    /// Hash of the final state, 16 hex digits.
    pub hash: String,
    /// Whether all runs ended in that state.
    pub same_hash: bool,
    /// Ticks that were timed.
    pub window: Window,
    /// Rounds.
    pub rounds: usize,
}

/// A row that was left out, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Skipped {
    /// Setting.
    pub setting: &'static str,
    /// Particles.
    pub particles: usize,
    /// What it would have taken, s, by the size before.
    pub seconds: f64,
}

/// Runs the plan on one thread and on `workers`. `report` is called with the name of each run.
///
/// # Errors
/// If the scene can't be built or one thread can't be started.
pub fn measure(
    plan: &Plan,
    workers: &Workers,
    report: &mut dyn FnMut(&str),
) -> Result<(Vec<Row>, Vec<Skipped>), ExperimentError> {
    let mut pools = vec![Workers::new(1)?];
    if workers.threads() > 1 {
        pools.push(workers.clone());
    }
    let (mut rows, mut skipped) = (Vec::new(), Vec::new());
    // Time that a tick of each setting took at the size before, s, on one thread and on all.
    let mut before: Vec<Option<(usize, f64)>> = vec![None; plan.settings.len()];
    for &columns in &plan.sizes {
        let count = particles(columns);
        let mut series: Vec<Series> = Vec::new();
        for (setting, before) in plan.settings.iter().zip(&before) {
            let tick = before.map_or(0.0, |(size, seconds)| seconds * count as f64 / size as f64);
            let window = if plan.is_short || tick * Window::LONG.ticks() as f64 > plan.share {
                Window::SHORT
            } else {
                Window::LONG
            };
            let seconds = tick * window.ticks() as f64;
            if seconds > plan.cap {
                skipped.push(Skipped { setting: setting.name, particles: count, seconds });
                continue;
            }
            let rounds = (plan.share / seconds.max(1e-9)).floor().clamp(1.0, plan.rounds as f64) as usize;
            // Medians of an odd number are measured ones.
            series.push(Series::new(*setting, columns, window, (rounds - 1) / 2 * 2 + 1, pools.len())?);
        }
        for (round, k) in interleaved(series.len(), plan.rounds) {
            let series = &mut series[k];
            if round < series.rounds {
                for (k, pool) in pools.iter().enumerate() {
                    let (setting, round, threads) = (series.setting.name, round + 1, pool.threads());
                    report(&format!("{count} particles, {setting}, round {round}, threads {threads}"));
                    series.run(k, pool)?;
                }
            }
        }
        for (setting, before) in plan.settings.iter().zip(&mut before) {
            let own = series.iter().find(|series| series.setting == *setting);
            // What was left out once stays out: it only takes longer.
            let tick = own.map(|series| series.tick_seconds());
            let grown = before.map(|(size, seconds)| seconds / size as f64);
            *before = tick.or(grown.map(|each| each * count as f64)).map(|tick| (count, tick));
        }
        let threads: Vec<usize> = pools.iter().map(Workers::threads).collect();
        rows.extend(series.into_iter().map(|series| series.finish(&threads)));
    }
    Ok((rows, skipped))
}

/// The runs of one setting at one size.
struct Series {
    setting: Setting,
    blueprint: Arc<Blueprint>,
    particles: usize,
    window: Window,
    rounds: usize,
    /// Medians of the runs, ms, for each number of threads.
    ms: Vec<Vec<f64>>,
    /// Error, memory and escapes of the first run.
    error: [Option<f64>; 2],
    bytes: u64,
    escaped: u64,
    hashes: Vec<u64>,
    /// Time of all runs together.
    seconds: f64,
}

impl Series {
    fn new(setting: Setting, columns: u32, window: Window, rounds: usize, pools: usize) -> Result<Self, SceneError> {
        let mut settings = vec![("columns".to_owned(), columns.to_string())];
        settings.extend(setting.changes.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())));
        let blueprint = scene::load(SCENE)?.build(&settings, Some(setting.preset), &EffectModes::new())?;
        Ok(Self {
            setting,
            blueprint: Arc::new(blueprint),
            particles: particles(columns),
            window,
            rounds,
            ms: vec![Vec::new(); pools],
            error: [None; 2],
            bytes: 0,
            escaped: 0,
            hashes: Vec::new(),
            seconds: 0.0,
        })
    }

    /// One run. The error is taken from the first: it is the same in all of them.
    fn run(&mut self, pool: usize, workers: &Workers) -> io::Result<()> {
        let begun = Instant::now();
        let plan = run::Plan { ticks: self.window.ticks(), warmup: self.window.first - 1, ..run::Plan::default() };
        let mut simulation = Simulation::new(self.blueprint.clone(), workers.clone());
        let run = if self.hashes.is_empty() {
            let mut sampler = Sampler::new(simulation.world(), plan.warmup);
            let run = time(&mut simulation, &plan, &mut [&mut sampler])?;
            let metrics = sampler.finish(simulation.world());
            self.error = [metrics.accuracy.density_error_mean, metrics.accuracy.density_error_p99];
            (self.bytes, self.escaped) = (metrics.memory_bytes, metrics.stability.escaped);
            run
        } else {
            time(&mut simulation, &plan, &mut [])?
        };
        self.ms[pool].push(run.quantile(0.5));
        self.hashes.push(run.hash);
        self.seconds += begun.elapsed().as_secs_f64();
        Ok(())
    }

    /// Time that a tick took on all pools together, s, with all that goes around it.
    fn tick_seconds(&self) -> f64 {
        self.seconds / self.rounds as f64 / self.window.ticks() as f64
    }

    fn finish(self, threads: &[usize]) -> Row {
        let ratios = match &self.ms[..] {
            [one, all, ..] => Spread::of(one.iter().zip(all).map(|(one, all)| one / all)),
            _ => None,
        };
        let ms: Vec<Spread> = self.ms.into_iter().filter_map(Spread::of).collect();
        Row {
            setting: self.setting.name,
            particles: self.particles,
            threads: threads.to_vec(),
            ms_range: ms.iter().map(|ms| ms.range).collect(),
            ms: ms.iter().map(|ms| ms.median).collect(),
            speedup: ratios.map(|ratios| ratios.median),
            error_mean: self.error[0],
            error_p99: self.error[1],
            bytes_per_particle: self.bytes as f64 / self.particles as f64,
            escaped: self.escaped,
            hash: format!("{:016x}", self.hashes.first().copied().unwrap_or_default()),
            same_hash: self.hashes.windows(2).all(|pair| pair[0] == pair[1]),
            window: self.window,
            rounds: self.rounds,
        }
    }
}

const _: () = assert!(Window::LONG.last < 5 * TICKS_PER_SECOND as u64, "the window ends with the fifth second");

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(cap: f64) -> Plan {
        let mut plan = Plan { sizes: vec![12, 16], rounds: 2, cap, ..Plan::quick() };
        plan.settings.retain(|setting| ["classic", "draft"].contains(&setting.name));
        plan
    }

    #[test]
    fn rows_have_what_was_asked_for_and_one_world() {
        let mut runs = 0;
        let (rows, skipped) = measure(&plan(10.0), &Workers::new(2).unwrap(), &mut |_| runs += 1).unwrap();
        assert!(skipped.is_empty());
        let names: Vec<_> = rows.iter().map(|row| (row.setting, row.particles)).collect();
        assert_eq!(names, [("classic", 288), ("draft", 288), ("classic", 512), ("draft", 512)]);
        for row in &rows {
            assert_eq!(
                (row.threads.as_slice(), row.ms.len(), row.rounds),
                (&[1, 2][..], 2, 1),
                "an odd number of rounds"
            );
            assert!(row.same_hash && row.escaped == 0 && row.ms.iter().all(|ms| *ms > 0.0), "{row:?}");
            assert!(row.error_mean.is_some() && row.bytes_per_particle > 21.0 && row.speedup.is_some(), "{row:?}");
            assert_eq!(row.window, Window::SHORT);
        }
        assert_eq!(runs, 8);
        assert_ne!(rows[0].hash, rows[1].hash, "the settings differ");
    }

    #[test]
    fn what_takes_too_long_is_named() {
        let (rows, skipped) = measure(&plan(0.0), &Workers::new(1).unwrap(), &mut |_| {}).unwrap();
        assert_eq!(rows.len(), 2, "the first size is always measured");
        assert!(rows.iter().all(|row| row.threads == [1] && row.speedup.is_none()));
        assert_eq!(
            skipped.iter().map(|row| (row.setting, row.particles)).collect::<Vec<_>>(),
            [("classic", 512), ("draft", 512)]
        );
        assert!(skipped.iter().all(|row| row.seconds > 0.0));
    }
}
