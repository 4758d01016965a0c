//! Grains: the slopes of heaps, and what slides.

use crate::{
    kernel::units::{TICK_SECONDS, TICKS_PER_SECOND},
    lab::{
        exam::{
            finding::{Findings, Run, found},
            set_up::{CaseSimulation, GRAVITY, SetUp},
        },
        gauges::spot,
    },
    scene::SceneError,
};
use glam::Vec2;

pub(super) const RUNS: &[(&str, Run)] = &[
    ("repose", |set_up| Box::pin(repose(set_up))),
    ("collapse", |set_up| Box::pin(collapse(set_up))),
    ("incline", |set_up| Box::pin(incline(set_up))),
    ("hopper", |set_up| Box::pin(hopper(set_up))),
    ("cliff", |set_up| Box::pin(cliff(set_up))),
    ("submerged_heap", |set_up| Box::pin(submerged_heap(set_up))),
];

/// Angle of friction of the sand, degrees.
fn angle(simulation: &CaseSimulation) -> f64 {
    let elements = simulation.matter().elements;
    elements.find("sand").map_or(f64::NAN, |sand| f64::from(elements.get(sand).friction))
}

/// Width of a column that is counted, m.
const COLUMN: f64 = 0.4;

/// Depth of the sand in columns from the left wall on, m: what it takes up at its own density.
fn depths(simulation: &CaseSimulation) -> Vec<f64> {
    let d = simulation.spacing();
    let mut depths = Vec::new();
    for x in &simulation.particles().x {
        let column = (f64::from(*x) * d / COLUMN) as usize;
        if depths.len() <= column {
            depths.resize(column + 1, 0.0);
        }
        depths[column] += d * d / COLUMN;
    }
    depths
}

/// Slope of the sand to one side of its top, degrees, by the columns of 20 to 85 % of its height: not the top, which is round,
/// and not the foot, where grains lie about.
fn slope(depths: &[f64], top: usize, side: impl Fn(usize) -> bool) -> f64 {
    let among = |depth: f64| (0.2 * depths[top]..0.85 * depths[top]).contains(&depth);
    let points: Vec<_> = (0..depths.len())
        .filter(|column| side(*column) && among(depths[*column]))
        .map(|column| (column as f64 * COLUMN, depths[column]))
        .collect();
    let count = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let (across, along) = points.iter().fold((0.0, 0.0), |(across, along), point| {
        (across + (point.0 - x) * (point.1 - y), along + (point.0 - x).powi(2))
    });
    (across / along).atan().to_degrees().abs()
}

/// Places of the particles in the order of their ids, m.
fn places(simulation: &CaseSimulation) -> Vec<[f64; 2]> {
    let (particles, d) = (simulation.particles(), simulation.spacing());
    let mut order: Vec<usize> = (0..particles.len()).collect();
    order.sort_by_key(|i| particles.id[*i]);
    order.into_iter().map(|i| [particles.x[i], particles.y[i]].map(|at| f64::from(at) * d)).collect()
}

/// Mean way between two times, m.
fn mean_way(before: &[[f64; 2]], after: &[[f64; 2]]) -> f64 {
    let ways = before.iter().zip(after).map(|(from, to)| (to[0] - from[0]).hypot(to[1] - from[1]));
    ways.sum::<f64>() / before.len() as f64
}

/// Grains of the heaps.
const HEAPS: [(f64, [&str; 4]); 2] = [
    (
        1500.0,
        [
            "slope to the left, 1,500 grains",
            "slope to the right, 1,500 grains",
            "creep, 1,500 grains",
            "fastest, 1,500 grains",
        ],
    ),
    (
        6000.0,
        [
            "slope to the left, 6,000 grains",
            "slope to the right, 6,000 grains",
            "creep, 6,000 grains",
            "fastest, 6,000 grains",
        ],
    ),
];

async fn repose(set_up: SetUp) -> Findings {
    let mut findings = Vec::new();
    for (grains, [left, right, creep, fastest]) in HEAPS {
        let mut simulation = set_up.open("repose", &[("grains", grains)])?;
        simulation.run(grains / 150.0 + 40.0).await;
        let before = places(&simulation);
        simulation.run(10.0).await;
        let depths = depths(&simulation);
        let top = (0..depths.len()).max_by(|a, b| depths[*a].total_cmp(&depths[*b])).unwrap_or(0);
        let known = angle(&simulation);
        findings.push(found(left, known, slope(&depths, top, |column| column < top)));
        findings.push(found(right, known, slope(&depths, top, |column| column > top)));
        findings.push(found(creep, 0.0, 6.0 * mean_way(&before, &places(&simulation))));
        let particles = simulation.particles();
        let speeds = particles.vx.iter().zip(&particles.vy).map(|(vx, vy)| f64::from(vx.hypot(*vy)));
        findings.push(found(fastest, 0.0, speeds.fold(0.0, f64::max) * simulation.spacing()));
    }
    Ok(findings)
}

/// Length of the columns, m.
const LENGTH: f64 = 8.0;

/// The columns' heights over their lengths.
const COLUMNS: [(f64, [&str; 2]); 3] = [
    (1.0, ["height, as high as long", "run-out, as high as long"]),
    (2.0, ["height, twice as high", "run-out, twice as high"]),
    (4.0, ["height, four times as high", "run-out, four times as high"]),
];

async fn collapse(set_up: SetUp) -> Findings {
    let mut findings = Vec::new();
    for (aspect, [height, front]) in COLUMNS {
        let mut simulation = set_up.open("collapse", &[("aspect", aspect)])?;
        simulation.run(15.0).await;
        let depths = depths(&simulation);
        let law: f64 = if aspect < 0.7 { aspect } else { aspect.cbrt() };
        findings.push(found(height, law * LENGTH, 0.5 * (depths[0] + depths[1])));
        let law = if aspect < 3.0 { 1.2 * aspect } else { 1.9 * aspect.powf(2.0 / 3.0) };
        let last = depths.iter().rposition(|depth| *depth > 0.25).unwrap_or(0);
        findings.push(found(front, law * LENGTH, (last + 1) as f64 * COLUMN - LENGTH));
    }
    Ok(findings)
}

/// Mean speed along the floor of the grains within 4 m of the middle one, m/s.
fn speed_of_the_middle(simulation: &CaseSimulation) -> f64 {
    let (particles, d) = (simulation.particles(), simulation.spacing());
    let mut places: Vec<f32> = particles.x.clone();
    places.sort_by(f32::total_cmp);
    let middle = places[places.len() / 2];
    let near = |i: &usize| f64::from((particles.x[*i] - middle).abs()) * d < 4.0;
    let speeds: Vec<f64> = (0..particles.len()).filter(near).map(|i| f64::from(particles.vx[i]) * d).collect();
    speeds.iter().sum::<f64>() / speeds.len() as f64
}

async fn incline(set_up: SetUp) -> Findings {
    let mut findings = Vec::new();
    let angle = angle(&set_up.open("incline", &[])?);
    for (more, name) in
        [(-2.0, "acceleration, 2° less steep"), (2.0, "acceleration, 2° steeper"), (6.0, "acceleration, 6° steeper")]
    {
        let (sine, cosine) = f64::to_radians(angle + more).sin_cos();
        let gravity = [("along", GRAVITY * sine), ("onto", GRAVITY * cosine)];
        let mut simulation = set_up.open("incline", &gravity)?;
        simulation.run(1.0).await;
        let before = speed_of_the_middle(&simulation);
        simulation.run(0.5).await;
        let known = if more < 0.0 { 0.0 } else { GRAVITY * (sine - angle.to_radians().sin() * cosine) };
        findings.push(found(name, known, (speed_of_the_middle(&simulation) - before) / 0.5));
    }
    Ok(findings)
}

/// When what runs out is counted, s.
const RUNS_OUT: [f64; 2] = [1.5, 4.5];
/// Widths of the holes that the law is tried by, m: the first, the middle one and the last.
const HOLES: [f64; 3] = [0.6, 1.5, 2.4];

/// What runs through a hole (its width, m) of a silo that is filled this high (m), m²/s.
async fn discharge(set_up: &SetUp, hole: f64, fill: f64) -> Result<f64, SceneError> {
    let mut simulation = set_up.open("hopper", &[("hole", hole), ("fill", fill)])?;
    let left = |simulation: &CaseSimulation| simulation.particles().len() as f64 * simulation.spacing().powi(2);
    simulation.run(RUNS_OUT[0]).await;
    let before = left(&simulation);
    simulation.run(RUNS_OUT[1] - RUNS_OUT[0]).await;
    Ok((before - left(&simulation)) / (RUNS_OUT[1] - RUNS_OUT[0]))
}

/// Width of the silo, m.
const SILO: f64 = 8.0;
/// Places on the floor of the silo at which its pressure is read: across it, and above its lower edge, m.
const FLOOR: [f64; 4] = [1.5, 3.5, 5.5, 7.5];
const ABOVE: f64 = 2.8;

/// Pressure at the floor of a silo that is shut and filled this high (m): by Janssen's law, and as it comes out, kPa.
async fn floor_pressure(set_up: &SetUp, fill: f64) -> Result<(f64, f64), SceneError> {
    let mut simulation = set_up.open("hopper", &[("hole", 0.0), ("fill", fill)])?;
    simulation.run(6.0).await;
    let mut sum = 0.0;
    for _ in 0..TICKS_PER_SECOND {
        simulation.run(f64::from(TICK_SECONDS)).await;
        let at = |x: f64| Vec2::new(x as f32, ABOVE as f32);
        let read = |x: f64| spot::pressure(simulation.world(), at(x)).map_or(f64::NAN, f64::from);
        sum += FLOOR.map(read).iter().sum::<f64>() / FLOOR.len() as f64 / 1000.0;
    }
    let elements = simulation.matter().elements;
    let weight =
        elements.find("sand").map_or(f64::NAN, |sand| f64::from(elements.get(sand).density) * GRAVITY / 1000.0);
    let (sine, tangent) = (angle(&simulation).to_radians().sin(), angle(&simulation).to_radians().tan());
    let held = 2.0 * tangent * (1.0 - sine * sine) / (1.0 + sine * sine) / SILO;
    let depth = fill + 2.3 - ABOVE;
    Ok((weight / held * (1.0 - (-held * depth).exp()), sum / f64::from(TICKS_PER_SECOND)))
}

async fn hopper(set_up: SetUp) -> Findings {
    let mut rates = [0.0; 3];
    for (rate, hole) in rates.iter_mut().zip(HOLES) {
        *rate = discharge(&set_up, hole, 24.0).await?;
    }
    // Its power of 2/3 grows evenly with the width.
    let known = (0.5 * (rates[0].powf(2.0 / 3.0) + rates[2].powf(2.0 / 3.0))).powf(1.5);
    let full = discharge(&set_up, 1.2, 24.0).await?;
    let half = discharge(&set_up, 1.2, 12.0).await?;
    let (law, pressure) = floor_pressure(&set_up, 24.0).await?;
    Ok(vec![
        found("through 1.5 m", known, rates[1]),
        found("half full", full, half),
        found("pressure at the floor", law, pressure),
    ])
}

async fn submerged_heap(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("submerged", &[])?;
    let sand = simulation.matter().elements.find("sand");
    let grains: Vec<bool> = {
        let particles = simulation.particles();
        let mut order: Vec<usize> = (0..particles.len()).collect();
        order.sort_by_key(|i| particles.id[*i]);
        order.into_iter().map(|i| Some(particles.element[i]) == sand).collect()
    };
    let of_grains = |simulation: &CaseSimulation| -> Vec<[f64; 2]> {
        places(simulation).into_iter().zip(&grains).filter(|(_, is_grain)| **is_grain).map(|(at, _)| at).collect()
    };
    simulation.run(10.0).await;
    let before = of_grains(&simulation);
    simulation.run(7.0).await;
    Ok(vec![found("mean way of the grains in 7 s", 0.0, mean_way(&before, &of_grains(&simulation)))])
}

/// Halvings of the range in which the critical height is sought, and how long a cliff is looked at, s.
const HALVINGS: u32 = 5;
const CLIFF_SECONDS: f64 = 5.0;
/// Sinking of a cliff's edge from which on it has given way, m: what settles in a cliff that stands is less than a grain.
const GAVE_WAY: f64 = 0.1;

async fn cliff(set_up: SetUp) -> Findings {
    let known = {
        let simulation = set_up.open("cliff", &[])?;
        let elements = simulation.matter().elements;
        elements.find("wet_sand").map_or(f64::NAN, |sand| {
            let sand = elements.get(sand);
            let (friction, weight) = (f64::from(sand.friction).to_radians(), f64::from(sand.density) * GRAVITY);
            let critical = |cohesion: f64, friction: f64| {
                3.83 * cohesion / weight * (0.5 * friction + std::f64::consts::FRAC_PI_4).tan()
            };
            let cohesion = f64::from(sand.cohesion);
            0.5 * (critical(cohesion, friction) + critical(cohesion * friction.cos(), friction.sin().atan()))
        })
    };
    let [mut stands, mut falls] = [0.5 * known, 2.0 * known];
    for _ in 0..HALVINGS {
        let height = 0.5 * (stands + falls);
        let mut simulation = set_up.open("cliff", &[("height", height)])?;
        let (edge, start) = (edge(&simulation, height), places(&simulation));
        simulation.run(CLIFF_SECONDS).await;
        let end = places(&simulation);
        let sunk = edge.iter().map(|i| start[*i][1] - end[*i][1]).sum::<f64>() / edge.len() as f64;
        *(if sunk < GAVE_WAY { &mut stands } else { &mut falls }) = height;
    }
    Ok(vec![found("critical height", known, 0.5 * (stands + falls))])
}

/// The grains within half a metre of the edge of a cliff of a height (m), by their ids.
fn edge(simulation: &CaseSimulation, height: f64) -> Vec<usize> {
    let near = |at: &[f64; 2]| at[0] > 14.5 && at[1] > height - 0.5;
    places(simulation).iter().enumerate().filter(|(_, at)| near(at)).map(|(id, _)| id).collect()
}
