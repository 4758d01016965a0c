//! Water at rest stays at rest, and water that falls comes to it.

use crate::support::{Sandbox, blueprint};
use powder_master::{kernel::params::Preset, sim::state::SolverState};

struct Rest {
    /// Root of the mean square of the speeds, d a tick.
    rms: f64,
    /// Mean height over what it should be.
    height: f64,
    /// Mean of max(0, ρ − 1).
    error: f64,
    /// Distance to the nearest neighbour that 99 % of the particles keep, d.
    gap: f32,
}

/// A still tank after some seconds.
fn rest(preset: Preset, columns: u32, depth: u32, ticks: u32) -> Rest {
    let mut blueprint = blueprint("hydrostatic", &[("columns", &columns.to_string()), ("depth", &depth.to_string())]);
    (blueprint.preset, blueprint.quality) = (preset, preset.quality());
    let mut sandbox = Sandbox::of(blueprint);
    sandbox.tick(ticks);
    let (mut rms, mut height, mut error) = (0.0, 0.0, 0.0);
    for _ in 0..30 {
        sandbox.tick(1);
        let particles = sandbox.particles();
        rms += sandbox.rms_speed() / 30.0;
        let mean = particles.y.iter().map(|&y| f64::from(y)).sum::<f64>() / particles.len() as f64;
        height += mean / (0.5 * f64::from(depth)) / 30.0;
        let density = &sandbox.get::<SolverState>().density;
        error += density.iter().map(|&d| f64::from((d - 1.0).max(0.0))).sum::<f64>() / density.len() as f64 / 30.0;
    }
    let particles = sandbox.particles();
    let gap = |i: usize| {
        let others = (0..particles.len()).filter(|&j| j != i);
        others.map(|j| particles.position(i).distance(particles.position(j))).fold(f32::MAX, f32::min)
    };
    let mut gaps: Vec<f32> = (0..particles.len()).map(gap).collect();
    gaps.sort_unstable_by(f32::total_cmp);
    assert_eq!(sandbox.counters().escaped, 0);
    Rest { rms, height, error, gap: gaps[gaps.len() / 100] }
}

#[test]
fn still_water_stays_still() {
    for preset in Preset::ALL {
        let Rest { rms, height, error, gap } = rest(preset, 30, 30, 300);
        println!("{} rms {rms:.4} height {height:.4} error {error:.4} gap {gap:.3}", preset.name());
    }
}
