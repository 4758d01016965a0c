//! Water at rest in a tank.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::{
        density::surroundings,
        exam::{
            case::{
                ExamCase, Finding, Over, Setting, Size,
                Tolerance::{Share, Within},
            },
            world::{CaseSimulation, Stopwatch, builtin},
        },
        stats,
    },
    scene::SceneError,
    sim::state::Rock,
};

pub(super) const HYDROSTATIC: ExamCase = ExamCase {
    name: "hydrostatic",
    title: "Hydrostatic column",
    setup: "The scene `hydrostatic`, 40 particles wide and 60 deep. After 8 s of rest, means over 2 s.",
    answer: "Water is incompressible: the density is 1 at every depth, the surface stands where the volume puts it, and \
             nothing moves.",
    tolerance: "Density and height: 2 %, the project's bound; the predictor itself aims 1 % under rest density. Motion: \
                0.02 d a tick, which is calm to the eye.",
    over: Over::Qualities,
    size: Size::Usual,
    run: |setting, stopwatch| Box::pin(hydrostatic(setting, stopwatch)),
};

/// Particles along the width and the depth.
const SIZE: (u32, u32) = (40, 60);

async fn hydrostatic(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let (columns, depth) = (f64::from(SIZE.0), f64::from(SIZE.1));
    let blueprint = builtin("hydrostatic", &[("columns", columns), ("depth", depth)], &setting)?;
    let mut simulation = CaseSimulation::new(blueprint, &stopwatch);
    simulation.run(8.0).await;
    let (mut surface, mut motion, mut low, mut high) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for _ in 0..12 {
        simulation.run(1.0 / 6.0).await;
        let matter = simulation.matter();
        surface.push(matter.surface().unwrap_or(f64::NAN));
        let balance = matter.balance();
        motion.push((2.0 * balance.kinetic / balance.mass).sqrt() / simulation.spacing() / f64::from(TICKS_PER_SECOND));
        low.push(density(&simulation, 0.0, depth / 3.0));
        high.push(density(&simulation, depth * 2.0 / 3.0, depth));
    }
    let mean = |values: &[f64]| stats::mean(values).unwrap_or(f64::NAN);
    Ok(vec![
        Finding {
            quantity: "height of the surface",
            unit: "m",
            expected: depth * simulation.spacing(),
            got: mean(&surface),
            tolerance: Share(0.02),
        },
        Finding { quantity: "density, lowest third", unit: "", expected: 1.0, got: mean(&low), tolerance: Share(0.02) },
        Finding {
            quantity: "density, highest third",
            unit: "",
            expected: 1.0,
            got: mean(&high),
            tolerance: Share(0.02),
        },
        Finding { quantity: "rms speed", unit: "d/tick", expected: 0.0, got: mean(&motion), tolerance: Within(0.02) },
    ])
}

/// Mean density of the particles inside the liquid between two heights, d.
fn density(simulation: &CaseSimulation, from: f64, to: f64) -> f64 {
    let matter = simulation.matter();
    let locals = surroundings(matter.particles, simulation.world().resource::<Rock>(), matter.domain.size);
    let inside = (locals.iter().zip(&matter.particles.y))
        .filter(|(local, y)| local.interior && (from..to).contains(&f64::from(**y)))
        .map(|(local, _)| local.density);
    stats::mean(&inside.collect::<Vec<_>>()).unwrap_or(f64::NAN)
}
