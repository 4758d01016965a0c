//! Cases by which others in the field examine their methods: a drop that is drawn out, a dam break on a wet bed, still
//! water over a wedge.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::{
        exam::{
            finding::{Findings, Run, found},
            fit::between,
            set_up::{CaseSimulation, GRAVITY, SetUp},
        },
        stats,
    },
    scene::blueprint::Blueprint,
    sim::state::Rock,
};

pub(super) const RUNS: &[(&str, Run)] = &[
    ("elliptic_drop", |set_up| Box::pin(elliptic_drop(set_up))),
    ("wet_bed", |set_up| Box::pin(wet_bed(set_up))),
    ("wedge", |set_up| Box::pin(wedge(set_up))),
];

/// Rate A at the start by which the drop is drawn out, 1/s, and time for which it is, s.
const DRAWN: f64 = 1.0;
const DRAWN_SECONDS: f64 = 1.0;

async fn elliptic_drop(set_up: SetUp) -> Findings {
    let mut blueprint = set_up.blueprint("elliptic_drop", &[])?;
    draw_out(&mut blueprint);
    let mut simulation = set_up.simulation(blueprint);
    let (start, energy) = (semi_axes(&simulation), simulation.matter().balance().kinetic);
    simulation.run(DRAWN_SECONDS).await;
    let (end, [a, b]) = (semi_axes(&simulation), ellipse(simulation.seconds()));
    Ok(vec![
        found("long semi-axis", b * start[1], end[1]),
        found("short semi-axis", a * start[0], end[0]),
        found("kinetic energy", 1.0, simulation.matter().balance().kinetic / energy),
    ])
}

/// Sets the disc in motion.
pub(in crate::lab::exam) fn draw_out(blueprint: &mut Blueprint) {
    let centre = blueprint.domain.size * 0.5;
    let particles = &mut blueprint.particles;
    for i in 0..particles.len() {
        let velocity = (particles.position(i) - centre) * DRAWN as f32;
        (particles.vx[i], particles.vy[i]) = (-velocity.x, velocity.y);
    }
}

/// Semi-axes along x and y, m: twice the standard deviations of an ellipse that is filled evenly.
fn semi_axes(simulation: &CaseSimulation) -> [f64; 2] {
    let (particles, d) = (simulation.particles(), simulation.spacing());
    [&particles.x, &particles.y].map(|places| {
        let mean = stats::mean(places.iter().map(|x| f64::from(*x))).unwrap_or(f64::NAN);
        let variance = stats::mean(places.iter().map(|x| (f64::from(*x) - mean).powi(2)));
        2.0 * d * variance.map_or(f64::NAN, f64::sqrt)
    })
}

/// Semi-axes of the ellipse after `seconds`, of the radius at the start: `a' = −A a`, `b' = A b`, `A' = A² (a² −
/// b²)/(a² + b²)`, by the midpoint rule.
pub(in crate::lab::exam) fn ellipse(seconds: f64) -> [f64; 2] {
    let steps = 10_000;
    let dt = seconds / f64::from(steps);
    let change = |[a, b, rate]: [f64; 3]| [-rate * a, rate * b, rate * rate * (a * a - b * b) / (a * a + b * b)];
    let add = |state: [f64; 3], change: [f64; 3], dt: f64| [0, 1, 2].map(|k: usize| state[k] + dt * change[k]);
    let mut state = [1.0, 1.0, DRAWN];
    for _ in 0..steps {
        state = add(state, change(add(state, change(state), 0.5 * dt)), dt);
    }
    [state[0], state[1]]
}

/// Where the dam stands, m, and the depths on both sides, m.
pub(in crate::lab::exam) const DAM: f64 = 36.0;
pub(in crate::lab::exam) const DEEP: f64 = 4.0;
pub(in crate::lab::exam) const SHALLOW: f64 = 1.0;
/// Times between which the bore is followed, s.
const BORE_OVER: (f64, f64) = (2.0, 5.0);

async fn wet_bed(set_up: SetUp) -> Findings {
    let bore = Bore::of(DEEP, SHALLOW);
    let mut simulation = set_up.open("wet_bed", &[])?;
    let (mut front, mut beyond) = (Vec::new(), Vec::new());
    while simulation.seconds() < BORE_OVER.1 {
        simulation.tick().await;
        if simulation.seconds() >= BORE_OVER.0 {
            let depths = depths(&simulation);
            front.push((simulation.seconds(), last_above(&depths, 0.5 * (bore.depth + SHALLOW))));
            let slice = SLICE as f64 * simulation.spacing();
            let volume = depths.iter().filter(|(x, _)| *x > DAM).map(|(_, depth)| depth * slice).sum();
            beyond.push((simulation.seconds(), volume));
        }
    }
    // Half a depth of the deep water away from the dam and from the bore it is still.
    let reach = front.last().map_or(f64::NAN, |(_, x)| *x);
    let plateau = between(&depths(&simulation), DAM + 0.5 * DEEP, reach - DEEP);
    let slope = |curve: &[(f64, f64)]| stats::line(curve).map_or(f64::NAN, |(slope, _)| slope);
    Ok(vec![
        found("speed of the bore", bore.speed, slope(&front)),
        found("depth behind it", bore.depth, stats::mean(plateau.iter().map(|(_, y)| *y)).unwrap_or(f64::NAN)),
        found("flow past the dam", bore.depth * bore.flow, slope(&beyond)),
    ])
}

/// What Stoker's solution of the shallow-water equations has between the bore and the water that runs out.
#[derive(Debug)]
pub(in crate::lab::exam) struct Bore {
    /// Depth, m.
    pub(in crate::lab::exam) depth: f64,
    /// Speed of the water, m/s.
    pub(in crate::lab::exam) flow: f64,
    /// Speed of the bore, m/s.
    pub(in crate::lab::exam) speed: f64,
}

impl Bore {
    /// Of a dam between water of these depths, m.
    pub(in crate::lab::exam) fn of(deep: f64, shallow: f64) -> Self {
        let behind = |depth: f64| {
            // Mass and momentum across the bore.
            let speed = (GRAVITY * depth * (depth + shallow) / (2.0 * shallow)).sqrt();
            Self { depth, flow: speed * (1.0 - shallow / depth), speed }
        };
        // What runs out has `u + 2 √(g h)` of the water at rest; the deeper the bore, the more it has too much.
        let (mut low, mut high) = (shallow, deep);
        for _ in 0..100 {
            let middle = behind(0.5 * (low + high));
            let invariant = middle.flow + 2.0 * (GRAVITY * middle.depth).sqrt();
            if invariant < 2.0 * (GRAVITY * deep).sqrt() { low = middle.depth } else { high = middle.depth }
        }
        behind(low)
    }
}

/// Width over which the depth is taken, spacings: that of a kernel.
const SLICE: usize = 5;

/// Depth by the number of particles over each slice of the box: its middle, m, and the depth, m.
fn depths(simulation: &CaseSimulation) -> Vec<(f64, f64)> {
    let (matter, d) = (simulation.matter(), simulation.spacing());
    let mut counts = vec![0.0; (matter.domain.size.x as usize).div_ceil(SLICE)];
    let last = counts.len() - 1;
    matter.particles.x.iter().for_each(|x| counts[(*x as usize / SLICE).min(last)] += 1.0);
    let width = SLICE as f64 * d;
    counts.iter().enumerate().map(|(k, count)| ((k as f64 + 0.5) * width, count * d * d / width)).collect()
}

/// The last place at which a curve comes down to a level, between two points in proportion.
fn last_above(curve: &[(f64, f64)], level: f64) -> f64 {
    let pair = curve.windows(2).rfind(|pair| pair[0].1 > level && pair[1].1 <= level);
    pair.map_or(f64::NAN, |pair| pair[0].0 + (pair[1].0 - pair[0].0) * (pair[0].1 - level) / (pair[0].1 - pair[1].1))
}

/// Rest, and time over which it is looked at, s.
const RESTS: f64 = 8.0;
const LOOKS: u32 = 12;

async fn wedge(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("wedge", &[])?;
    let d = simulation.spacing();
    let rock = simulation.world().resource::<Rock>().count() as f64;
    let width = f64::from(simulation.matter().domain.size.x);
    let level = (simulation.particles().len() as f64 + rock) / width * d;
    let height = |simulation: &CaseSimulation| {
        let balance = simulation.matter().balance();
        balance.potential / (balance.mass * GRAVITY)
    };
    let start = height(&simulation);
    simulation.run(RESTS).await;
    let (mut heights, mut motion, mut off) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..LOOKS {
        simulation.run(1.0 / 6.0).await;
        let balance = simulation.matter().balance();
        heights.push(height(&simulation));
        motion.push((2.0 * balance.kinetic / balance.mass).sqrt() / d / f64::from(TICKS_PER_SECOND));
        // Columns of a kernel's width: single ones have a particle more or less.
        let tops = simulation.matter().column_tops();
        let flat = tops.chunks(SLICE).map(|tops| tops.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        off.push(stats::largest(flat.map(|top| ((top + 0.5) * d - level).abs())).unwrap_or(f64::NAN));
    }
    let mean = |values: &[f64]| stats::mean(values).unwrap_or(f64::NAN);
    Ok(vec![
        found("height of the centre of mass", start, mean(&heights)),
        found("surface, furthest from flat", 0.0, mean(&off)),
        found("rms speed", 0.0, mean(&motion)),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ellipse_keeps_its_area_and_its_energy() {
        for seconds in [0.3, 1.0] {
            let [a, b] = ellipse(seconds);
            assert!((a * b - 1.0).abs() < 1e-7 && b > 1.0, "{a} {b}");
            // `A² (a² + b²)` is the energy: the rate from two ellipses that are close to each other in time.
            let rate = (ellipse(seconds + 1e-4)[1] / ellipse(seconds - 1e-4)[1]).ln() / 2e-4;
            assert!((rate * rate * (a * a + b * b) - 2.0 * DRAWN * DRAWN).abs() < 1e-5, "{rate}");
        }
    }

    #[test]
    fn a_bore_keeps_mass_and_momentum_and_fades_with_the_step() {
        let bore = Bore::of(4.0, 1.0);
        let (h, u, s) = (bore.depth, bore.flow, bore.speed);
        assert!((h * (s - u) - s).abs() < 1e-9, "mass: {bore:?}");
        let push = 0.5 * GRAVITY * (h * h - 1.0);
        assert!((s * u - push).abs() < 1e-9 * push, "momentum: {bore:?}");
        assert!((u + 2.0 * (GRAVITY * h).sqrt() - 2.0 * (GRAVITY * 4.0).sqrt()).abs() < 1e-9, "{bore:?}");
        let small = Bore::of(1.0001, 1.0);
        assert!((small.speed - GRAVITY.sqrt()).abs() < 1e-3, "a small wave: {small:?}");
    }
}
