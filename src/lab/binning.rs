//! The binning table: how many particles a tick may hold at a given tick rate, with every particle looking at every
//! other and with bins. The original report has the same table for its own machine (section 4.1).

use crate::{
    kernel::{bins::Neighbours, params::Preset, pbf::Solver, simd::InstructionSet},
    lab::{
        experiment::{ExperimentError, time},
        run::Plan,
        stats,
    },
    scene::{self, effects::EffectModes},
    sim::{simulation::Simulation, state::SolverState, workers::Workers},
};
use serde::Serialize;
use std::sync::Arc;

/// Tick rates of the table, 1/s. The original's frame rate was capped at the first.
pub const RATES: [f64; 5] = [75.0, 70.0, 60.0, 45.0, 30.0];

/// What the original's authors found for all rates but the first: without bins, with bins.
pub const ORIGINAL: [[f64; 4]; 2] = [[170.0, 185.0, 215.0, 260.0], [1500.0, 1550.0, 1650.0, 1750.0]];

/// The quality that is measured: the original's method.
pub const PRESET: Preset = Preset::Classic;

/// The scene that is measured; its parameter `columns` = c stands for 2 c² particles.
const SCENE: &str = "dam_break";

/// Columns to begin with.
const FEWEST_COLUMNS: usize = 8;

/// Columns at which the search gives up.
const MOST_COLUMNS: usize = 1000;

/// Ticks before the clock counts, and ticks that it counts.
const WARMUP: u64 = 5;
const TICKS: u64 = 21;

/// Rounds of a measurement. Every round has the same work in the same tick and other programs only ever add to it, so
/// the shortest of the rounds counts for each tick.
const ROUNDS: u32 = 3;

/// Points of the fit cost at least this share of the most expensive one: below, the overhead of a tick bends the line.
const FIT_SHARE: f64 = 0.1;

/// A measured number of particles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point {
    /// Particles.
    pub particles: usize,
    /// Median time of a tick, ms.
    pub ms: f64,
}

/// A way to find neighbours, measured.
#[derive(Clone, Debug, Serialize)]
pub struct Growth {
    /// Name in the table.
    pub name: String,
    /// Threads.
    pub threads: usize,
    /// Particles at which the tick rate falls to each of [`RATES`].
    pub particles_at_rate: Vec<Option<f64>>,
    /// b of the fit `ms = a nᵇ` (least squares on the logarithms).
    pub exponent: Option<f64>,
    /// What was measured, by number of particles.
    pub points: Vec<Point>,
}

/// Measures the three ways: brute force and bins on one thread, bins on `workers`. `report` is called with the name of each
/// measurement.
pub fn measure(workers: &Workers, report: &mut dyn FnMut(&str)) -> Result<Vec<Growth>, ExperimentError> {
    let one = Workers::new(1)?;
    let all = format!("bins, {} threads", workers.threads());
    [
        ("brute force", Neighbours::Brute, &one),
        ("bins, 1 thread", Neighbours::Binned, &one),
        (&all, Neighbours::Binned, workers),
    ]
    .into_iter()
    .map(|(name, neighbours, workers)| {
        grow(name, workers.threads(), |columns| {
            report(&format!("{name}: {} particles", 2 * columns * columns));
            Ok(Point { particles: 2 * columns * columns, ms: median_ms(columns, neighbours, workers)? })
        })
    })
    .collect()
}

fn median_ms(columns: usize, neighbours: Neighbours, workers: &Workers) -> Result<f64, ExperimentError> {
    let settings = [("columns".to_owned(), columns.to_string())];
    let blueprint = Arc::new(scene::load(SCENE)?.build(&settings, Some(PRESET), &EffectModes::new())?);
    let plan = Plan { ticks: WARMUP + TICKS, warmup: WARMUP, ..Plan::default() };
    let mut shortest = vec![f64::INFINITY; TICKS as usize];
    for _ in 0..ROUNDS {
        let mut simulation = Simulation::new(blueprint.clone(), workers.clone());
        simulation.world_mut().insert_resource(SolverState(Solver::new(InstructionSet::detect(), neighbours)));
        let run = time(&mut simulation, &plan, &mut [])?;
        shortest.iter_mut().zip(run.ms).for_each(|(shortest, ms)| *shortest = shortest.min(ms));
    }
    Ok(stats::quantile(&mut shortest, 0.5).unwrap_or(f64::NAN))
}

/// Doubles the particles until the slowest rate is passed, then looks more closely where each rate is crossed.
fn grow<E>(name: &str, threads: usize, mut measure: impl FnMut(usize) -> Result<Point, E>) -> Result<Growth, E> {
    let slowest = 1e3 / RATES[RATES.len() - 1];
    let mut points: Vec<Point> = Vec::new();
    let mut columns = FEWEST_COLUMNS;
    while columns <= MOST_COLUMNS && points.last().is_none_or(|point| point.ms < slowest) {
        points.push(measure(columns)?);
        columns = (columns as f64 * std::f64::consts::SQRT_2).round() as usize;
    }
    for rate in RATES {
        let Some(particles) = crossing(&points, 1e3 / rate) else { continue };
        let columns = (particles / 2.0).sqrt().round() as usize;
        if let Err(place) = points.binary_search_by_key(&(2 * columns * columns), |point| point.particles) {
            points.insert(place, measure(columns)?);
        }
    }
    let particles_at_rate = RATES.iter().map(|rate| crossing(&points, 1e3 / rate)).collect();
    Ok(Growth { name: name.to_owned(), threads, particles_at_rate, exponent: exponent(&points), points })
}

/// Number of particles at which a tick takes `ms`, on the power law through the measured points around it.
fn crossing(points: &[Point], ms: f64) -> Option<f64> {
    let above = points.iter().position(|point| point.ms >= ms)?;
    let (low, high) = (points.get(above.checked_sub(1)?)?, points[above]);
    let share = (ms / low.ms).ln() / (high.ms / low.ms).ln();
    Some(low.particles as f64 * (high.particles as f64 / low.particles as f64).powf(share))
}

/// b of `1/rate = a nᵇ` through a table of tick rates and particle counts.
pub fn exponent_of(rates: &[f64], counts: &[f64]) -> Option<f64> {
    power(counts.iter().zip(rates).map(|(count, rate)| (*count, 1.0 / rate)))
}

fn exponent(points: &[Point]) -> Option<f64> {
    let most = points.iter().map(|point| point.ms).fold(0.0, f64::max);
    let costly = points.iter().filter(|point| point.ms >= FIT_SHARE * most);
    power(costly.map(|point| (point.particles as f64, point.ms)))
}

/// b of `y = a xᵇ` through points, least squares on the logarithms.
fn power(points: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let logarithms: Vec<(f64, f64)> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
    stats::line(&logarithms).map(|(slope, _)| slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(scale: f64, power: f64) -> Growth {
        let cost = |columns: usize| {
            let particles = 2 * columns * columns;
            Ok::<_, std::convert::Infallible>(Point { particles, ms: scale * (particles as f64).powf(power) })
        };
        grow("a law", 1, cost).unwrap()
    }

    #[test]
    fn the_search_finds_the_counts_of_a_known_law() {
        for (scale, power) in [(1e-5, 2.0), (3e-4, 1.0)] {
            let growth = law(scale, power);
            assert!((growth.exponent.unwrap() - power).abs() < 1e-6, "{growth:?}");
            for (rate, found) in RATES.iter().zip(&growth.particles_at_rate) {
                let expected = (1e3 / rate / scale).powf(1.0 / power);
                assert!((found.unwrap() / expected - 1.0).abs() < 1e-6, "{found:?} at {rate}/s, not {expected}");
            }
            assert!(growth.points.is_sorted_by_key(|point| point.particles));
        }
    }

    #[test]
    fn what_is_always_fast_or_never_has_no_count() {
        assert!(law(1e-9, 1.0).particles_at_rate.iter().all(Option::is_none), "the search ends");
        assert!(law(1e3, 1.0).particles_at_rate.iter().all(Option::is_none));
    }
}
