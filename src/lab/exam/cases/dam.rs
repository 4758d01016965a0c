//! The dam break of Martin and Moyce.

use super::GRAVITY;
use crate::{
    lab::{
        exam::{
            case::{Case, Finding, Over, Setting, Tolerance::Share},
            fit::between,
            world::{Clockwork, Stage, builtin},
        },
        stats,
    },
    scene::SceneError,
};

pub(in crate::lab::exam) const DAM_BREAK: Case = Case {
    name: "dam_break",
    title: "Dam break",
    setup: "The scene `dam_break`: a column of 10,082 particles, twice as high as its base a, collapses. \
            `Z = x/a` is the front, `H = η/2a` the height at the wall, `T = t √(2g/a)`.",
    answer: "J. C. Martin and W. J. Moyce, An experimental study of the collapse of liquid columns on a rigid horizontal \
             plane, Phil. Trans. R. Soc. A 244 (1952): Z and H over T for n² = 2, a = 1.125 in. The gate of the experiment \
             takes time to open and shifts T, so the slopes count: of Z over T = 1.602 … 2.950, of H over \
             T = 1.08 … 2.45.",
    tolerance: "Front: 6 %. The experiments with a = 1.125 in and 2.25 in differ by 1 % in this slope, the first by 3 % \
                between its parts; drag at the floor, which the program has not, takes about as much. Height: 10 %, the \
                readings are of two digits.",
    over: Over::Qualities,
    quick: false,
    run: |setting, clockwork| Box::pin(dam_break(setting, clockwork)),
};

/// Particles along the base.
const COLUMNS: f64 = 71.0;

/// Front Z over T.
const FRONT: [(f64, f64); 10] = [
    (0.849, 1.245),
    (1.212, 1.443),
    (1.602, 1.884),
    (2.283, 2.689),
    (2.950, 3.728),
    (3.598, 4.528),
    (3.905, 4.999),
    (4.592, 5.841),
    (4.961, 6.271),
    (5.316, 6.717),
];

/// Height H at the wall over T.
const HEIGHT: [(f64, f64); 17] = [
    (0.56, 0.94),
    (0.77, 0.89),
    (0.93, 0.83),
    (1.08, 0.78),
    (1.28, 0.72),
    (1.46, 0.67),
    (1.66, 0.61),
    (1.84, 0.56),
    (2.00, 0.50),
    (2.21, 0.44),
    (2.45, 0.39),
    (2.70, 0.33),
    (3.06, 0.28),
    (3.44, 0.22),
    (4.20, 0.17),
    (5.25, 0.11),
    (7.40, 0.06),
];

/// Times T over which the front and the height are compared.
const FRONT_OVER: (f64, f64) = (1.602, 2.950);
const HEIGHT_OVER: (f64, f64) = (1.08, 2.45);

async fn dam_break(setting: Setting, clockwork: Clockwork) -> Result<Vec<Finding>, SceneError> {
    let mut stage = Stage::new(builtin("dam_break", &[("columns", COLUMNS)], &setting)?, &clockwork);
    let base = COLUMNS * stage.spacing();
    let per_second = (2.0 * GRAVITY / base).sqrt();
    let (mut front, mut height) = (Vec::new(), Vec::new());
    while stage.seconds() * per_second < FRONT_OVER.1 {
        stage.tick().await;
        let time = stage.seconds() * per_second;
        front.push((time, stage.matter().front().unwrap_or(f64::NAN) / base));
        height.push((time, at_wall(&stage) / (2.0 * base)));
    }
    let compare = |quantity, known: &[(f64, f64)], found: &[(f64, f64)], (from, to), tolerance| Finding {
        quantity,
        unit: "",
        expected: slope(&between(known, from, to)),
        got: slope(&between(found, from, to)),
        tolerance,
    };
    Ok(vec![
        compare("slope of the front, dZ/dT", &FRONT, &front, FRONT_OVER, Share(0.06)),
        compare("slope of the height at the wall, dH/dT", &HEIGHT, &height, HEIGHT_OVER, Share(0.10)),
    ])
}

fn slope(points: &[(f64, f64)]) -> f64 {
    stats::line(points).map_or(f64::NAN, |(slope, _)| slope)
}

/// Height of the liquid at the left wall, m: the mean over its first three columns.
fn at_wall(stage: &Stage) -> f64 {
    let tops = stage.matter().column_tops();
    (stats::mean(&tops[..3]).unwrap_or(f64::NAN) + 0.5) * stage.spacing()
}
