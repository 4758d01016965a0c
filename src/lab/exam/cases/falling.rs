//! Free fall, of single drops and of a blob.

use crate::{
    lab::exam::{
        case::{
            ExamCase, Finding, Over, Setting, Size,
            Tolerance::{Share, Within},
        },
        world::{CaseSimulation, GRAVITY, Stopwatch, own},
    },
    scene::SceneError,
};
use glam::DVec2;

pub(super) const FREE_FALL: ExamCase = ExamCase {
    name: "free_fall",
    title: "Free fall",
    setup: "Six single drops, at rest or thrown to the side, up and down, fall for 1 s without air \
            (assets/exam/free_fall.ron). The worst drop counts.",
    answer: "`v = v₀ − g t`, `y = y₀ + v₀ t − ½ g t²`.",
    tolerance: "Speed: the sum of 60 equal steps in f32, 10⁻⁵. Distance: positions follow the speed at the end of each \
                step, so that a fall from rest is ahead by `½ g t Δt`: Δt/t = 1/60 at one step a tick, 1.7 %. The error \
                falls with the number of substeps.",
    over: Over::Qualities,
    size: Size::Quick,
    run: |setting, stopwatch| Box::pin(free_fall(setting, stopwatch)),
};

pub(super) const BLOB_FALL: ExamCase = ExamCase {
    name: "blob_fall",
    title: "Fall of a blob",
    setup: "A disc of water of 4 m across, thrown to the side with 2 m/s, falls for 1 s without air \
            (assets/exam/blob_fall.ron).",
    answer: "Nothing acts from outside but gravity: the centre of mass gains `g t` and keeps its speed to the side; seen \
             from it nothing moves.",
    tolerance: "Momentum: 1 %; the constraint pushes pairs alike, but the predictor's way from particles to grid and \
                back does so only on average over the cells of the surface, of which the disc has 50: runs that differ \
                by nothing but its iterations scatter by 0.7 %. Inner motion: 0.02 d a tick (0.12 m/s), which is calm \
                to the eye.",
    over: Over::Qualities,
    size: Size::Quick,
    run: |setting, stopwatch| Box::pin(blob_fall(setting, stopwatch)),
};

async fn free_fall(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/free_fall.ron"));
    let mut simulation = CaseSimulation::new(own("free_fall", text, &[], &setting)?, &stopwatch);
    let start = drops(&simulation);
    simulation.run(1.0).await;
    let (t, end) = (simulation.seconds(), drops(&simulation));
    let gained = worst(start.iter().zip(&end).map(|(start, end)| start.1.y - end.1.y), GRAVITY * t);
    let fallen =
        worst(start.iter().zip(&end).map(|(start, end)| start.0.y + start.1.y * t - end.0.y), 0.5 * GRAVITY * t * t);
    let sideways = worst(start.iter().zip(&end).map(|(start, end)| end.1.x - start.1.x), 0.0);
    Ok(vec![
        Finding {
            quantity: "speed gained in 1 s",
            unit: "m/s",
            expected: GRAVITY * t,
            got: gained,
            tolerance: Share(1e-5),
        },
        Finding {
            quantity: "distance fallen in 1 s",
            unit: "m",
            expected: 0.5 * GRAVITY * t * t,
            got: fallen,
            tolerance: Share(0.017),
        },
        Finding {
            quantity: "change of the speed to the side",
            unit: "m/s",
            expected: 0.0,
            got: sideways,
            tolerance: Within(1e-5),
        },
    ])
}

async fn blob_fall(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/blob_fall.ron"));
    let mut simulation = CaseSimulation::new(own("blob_fall", text, &[], &setting)?, &stopwatch);
    let start = simulation.matter().balance();
    simulation.run(1.0).await;
    let end = simulation.matter().balance();
    let gained = (end.momentum - start.momentum) / end.mass;
    let centre = end.momentum / end.mass;
    let inner = 2.0 * end.kinetic / end.mass - centre.length_squared();
    Ok(vec![
        Finding {
            quantity: "speed gained by the centre of mass",
            unit: "m/s",
            expected: GRAVITY * simulation.seconds(),
            got: -gained.y,
            tolerance: Share(0.01),
        },
        Finding {
            quantity: "its speed to the side",
            unit: "m/s",
            expected: start.momentum.x / start.mass,
            got: centre.x,
            tolerance: Share(0.01),
        },
        Finding {
            quantity: "rms speed seen from it",
            unit: "m/s",
            expected: 0.0,
            got: inner.max(0.0).sqrt(),
            tolerance: Within(0.12),
        },
    ])
}

/// Position (m) and velocity (m/s) of each particle, by id.
pub(super) fn drops(simulation: &CaseSimulation) -> Vec<(DVec2, DVec2)> {
    let (particles, d) = (simulation.particles(), simulation.spacing());
    let of = |i: u32| {
        let i = i as usize;
        (particles.position(i).as_dvec2() * d, particles.velocity(i).as_dvec2() * d)
    };
    particles.in_id_order().into_iter().map(of).collect()
}

/// The value that is furthest from what is expected; no number without any.
pub(super) fn worst(values: impl Iterator<Item = f64>, expected: f64) -> f64 {
    values.max_by(|a, b| (a - expected).abs().total_cmp(&(b - expected).abs())).unwrap_or(f64::NAN)
}
