//! The rest-density study: what becomes of 300 particles poured into a corner when the liquid's rest density does not
//! suit the spacing of its particles. The original report has it in section 4.2.1.

use crate::{
    kernel::{
        params::Preset,
        particles::Particles,
        units::{Scale, TICKS_PER_SECOND},
    },
    lab::{balance::matter, picture::Picture, stats},
    scene::{self, SceneError, effects::EffectModes},
    sim::{simulation::Simulation, workers::Workers},
};
use serde::Serialize;
use std::{array, sync::Arc};

/// Rest densities as multiples of the one that suits the spacing: 100, 300, 600 and 5000 of the original, where 300 was
/// found to suit.
pub const RATIOS: [f64; 4] = [1.0 / 3.0, 1.0, 2.0, 50.0 / 3.0];

/// The qualities that are studied: the original's method, and the default.
pub const PRESETS: [Preset; 2] = [Preset::Classic, Preset::Balanced];

const SCENE: &str = "rest_density";

/// Simulated time until the liquid should be at rest: 3.3 s of pouring, the rest to settle, s.
pub const SETTLED_AFTER: u32 = 20;

/// Time over which the settled liquid is observed, s.
pub const OBSERVED_FOR: u32 = 4;

/// Ticks from one observation to the next.
const OBSERVE_EVERY: u32 = 10;

/// Width of the columns in which density is counted, d.
const COLUMN: f64 = 3.0;

/// Longer side of a picture of the study, pixels.
const PICTURE_SIDE: u32 = 420;

/// Radius of the discs there, d: small enough to show how densely particles stand.
const PICTURE_DISC: f32 = 0.3;

/// What became of the liquid: means over the observations.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// Name of the quality.
    pub quality: &'static str,
    /// Rest density as a multiple of the lattice's.
    pub ratio: f64,
    /// Kinetic energy of a particle, J for each metre of depth.
    pub kinetic_energy: f64,
    /// Root mean square speed, d a tick: .02 is calm to the eye.
    pub jitter: f64,
    /// Particles in each d² of the lower half of the liquid.
    pub density_bottom: f64,
    /// Particles in each d² of its upper half.
    pub density_top: f64,
    /// Rise of the surface for each metre to the right.
    pub slope: f64,
    /// Height of the surface, m.
    pub surface: f64,
}

/// Runs the study: what became of the liquid for each quality and ratio, with a picture of its last tick. `report` is
/// called with the name of each run.
pub fn study(workers: &Workers, report: &mut dyn FnMut(&str)) -> Result<Vec<(Outcome, Picture)>, SceneError> {
    let cases = PRESETS.into_iter().flat_map(|preset| RATIOS.map(|ratio| (preset, ratio)));
    cases
        .map(|(preset, ratio)| {
            report(&format!("{}, ratio {ratio:.2}", preset.name()));
            observe(preset, ratio, workers)
        })
        .collect()
}

fn observe(preset: Preset, ratio: f64, workers: &Workers) -> Result<(Outcome, Picture), SceneError> {
    let settings = [("ratio".to_owned(), ratio.to_string())];
    let blueprint = scene::load(SCENE)?.build(&settings, Some(preset), &EffectModes::new())?;
    let mut simulation = Simulation::new(Arc::new(blueprint), workers.clone());
    for _ in 0..SETTLED_AFTER * TICKS_PER_SECOND {
        simulation.tick();
    }
    let mut looks = Vec::new();
    for tick in 1..=OBSERVED_FOR * TICKS_PER_SECOND {
        simulation.tick();
        if tick.is_multiple_of(OBSERVE_EVERY) {
            looks.push(look(&simulation));
        }
    }
    let [kinetic_energy, jitter, density_bottom, density_top, slope, surface] =
        array::from_fn(|k| looks.iter().map(|look: &[f64; 6]| look[k]).sum::<f64>() / looks.len() as f64);
    let quality = preset.name();
    let outcome = Outcome { quality, ratio, kinetic_energy, jitter, density_bottom, density_top, slope, surface };
    Ok((outcome, Picture::of_world(simulation.world(), PICTURE_SIDE, PICTURE_DISC)))
}

/// The figures of an [`Outcome`] at one start, in their order.
fn look(simulation: &Simulation) -> [f64; 6] {
    let matter = matter(simulation.world());
    let balance = matter.balance();
    let particles = matter.particles.len().max(1) as f64;
    let Scale { spacing, .. } = matter.scale;
    let rms_speed = (2.0 * balance.kinetic / balance.mass.max(f64::MIN_POSITIVE)).sqrt();
    let [bottom, top] = halves(matter.particles, f64::from(matter.domain.size.x));
    let tops: Vec<(f64, f64)> = (matter.column_tops().into_iter().enumerate())
        .filter(|(_, top)| top.is_finite())
        .map(|(column, top)| (column as f64, top))
        .collect();
    [
        balance.kinetic / particles,
        rms_speed / f64::from(spacing) / f64::from(TICKS_PER_SECOND),
        bottom,
        top,
        stats::line(&tops).map_or(0.0, |(slope, _)| slope),
        matter.surface().unwrap_or(0.0),
    ]
}

/// Particles in each d² of the lower and of the upper half of the liquid. Its height is taken column by column, so that
/// a heap counts as well as a pool.
fn halves(particles: &Particles, width: f64) -> [f64; 2] {
    let mut columns = vec![Vec::new(); (width / COLUMN).ceil().max(1.0) as usize];
    let last = columns.len() - 1;
    for (&x, &y) in particles.x.iter().zip(&particles.y) {
        columns[((f64::from(x) / COLUMN) as usize).min(last)].push(f64::from(y));
    }
    let (mut counts, mut area) = ([0_usize; 2], 0.0);
    for heights in columns.iter().filter(|heights| !heights.is_empty()) {
        let height = heights.iter().copied().fold(0.0, f64::max) + 0.5;
        let low = heights.iter().filter(|y| **y < 0.5 * height).count();
        counts[0] += low;
        counts[1] += heights.len() - low;
        area += 0.5 * height * COLUMN;
    }
    counts.map(|count| count as f64 / area.max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::element::ElementId;
    use glam::Vec2;

    #[test]
    fn density_is_counted_in_each_half_of_the_liquid() {
        let mut particles = Particles::default();
        for id in 0..30 * 8 {
            let at = Vec2::new((id % 30) as f32 + 0.5, (id / 30) as f32 + 0.5);
            particles.push(id, ElementId(1), at, Vec2::ZERO);
        }
        assert_eq!(halves(&particles, 30.0), [1.0, 1.0], "a lattice holds one in each d²");
        for i in 0..30 * 8 {
            particles.y[i] = (particles.y[i] / 8.0) * particles.y[i];
        }
        let [bottom, top] = halves(&particles, 30.0);
        assert!(bottom > 1.5 * top, "what sank is denser below: {bottom} against {top}");
    }
}
