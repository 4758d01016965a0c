//! The numbers that every scene has and `--set` reaches by name: accuracy, liquid, particle limit.

use crate::{
    kernel::params::{AirAdvection, FluidParams, GradientKernel, Quality},
    scene::{
        error::SceneError,
        file::{FluidText, QualityText},
        number::{Evaluator, Number, Range},
    },
};

/// What the knobs turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tuning {
    pub(super) fluid: FluidParams,
    pub(super) quality: Quality,
    pub(super) particle_limit: u32,
}

/// Particle limit of a scene that doesn't set it.
pub(super) const DEFAULT_PARTICLE_LIMIT: u32 = 200_000;

/// A number that every scene has.
#[derive(Debug)]
pub struct Knob {
    /// Name in scenes and for `--set`.
    pub name: &'static str,
    /// Values allowed.
    pub range: Range,
    /// What it means, with its unit.
    pub meaning: &'static str,
    turn: fn(&mut Tuning, f64),
}

impl Knob {
    /// Sets it to a value of its range.
    pub(super) fn turn(&self, tuning: &mut Tuning, value: f64) {
        (self.turn)(tuning, value);
    }
}

/// A knob of every scene that is a word.
#[derive(Debug)]
pub struct WordKnob {
    /// Name in scenes and for `--set`.
    pub name: &'static str,
    /// Words allowed.
    pub words: [&'static str; 2],
    turn: fn(&mut Tuning, usize),
}

impl WordKnob {
    /// Sets it to one of its words.
    pub(super) fn turn(&self, tuning: &mut Tuning, word: usize) {
        (self.turn)(tuning, word);
    }
}

/// All knobs that are words.
pub static WORD_KNOBS: [WordKnob; 2] = [
    WordKnob {
        name: "gradient",
        words: [GradientKernel::ALL[0].name(), GradientKernel::ALL[1].name()],
        turn: |tuning, word| tuning.quality.gradient = GradientKernel::ALL[word],
    },
    WordKnob {
        name: "air_advection",
        words: [AirAdvection::ALL[0].name(), AirAdvection::ALL[1].name()],
        turn: |tuning, word| tuning.quality.air_advection = AirAdvection::ALL[word],
    },
];

const SUBSTEPS: Knob = Knob {
    name: "substeps",
    range: Range::whole(1.0, 64.0),
    meaning: "substeps a tick",
    turn: |tuning, value| tuning.quality.substeps = value as u32,
};
const ITERATIONS: Knob = Knob {
    name: "iterations",
    range: Range::whole(1.0, 64.0),
    meaning: "solver iterations a substep",
    turn: |tuning, value| tuning.quality.iterations = value as u32,
};
const KERNEL_RADIUS: Knob = Knob {
    name: "kernel_radius",
    range: Range::real(2.0, 4.0),
    meaning: "kernel radius, d",
    turn: |tuning, value| tuning.quality.kernel_radius = value as f32,
};
const CORRECTION_LIMIT: Knob = Knob {
    name: "correction_limit",
    range: Range::real(0.05, 0.5),
    meaning: "furthest correction in a substep, d",
    turn: |tuning, value| tuning.quality.correction_limit = value as f32,
};
const AIR_CELL: Knob = Knob {
    name: "air_cell",
    range: Range::real(1.0, 32.0),
    meaning: "edge of an air cell, d",
    turn: |tuning, value| tuning.quality.air_cell = value as f32,
};
const AIR_COURANT: Knob = Knob {
    name: "air_courant",
    range: Range::real(0.1, 0.9),
    meaning: "Courant number of the air's substeps",
    turn: |tuning, value| tuning.quality.air_courant = value as f32,
};
const REST_DENSITY: Knob = Knob {
    name: "rest_density",
    range: Range::real(0.1, 100.0),
    meaning: "rest density, multiples of the lattice's",
    turn: |tuning, value| tuning.fluid.rest_density = value as f32,
};
const RELAXATION: Knob = Knob {
    name: "relaxation",
    range: Range::real(1e-4, 10.0),
    meaning: "relaxation ε of the constraint, 1/d²; with the predictor at least 0.2",
    turn: |tuning, value| tuning.fluid.relaxation = value as f32,
};
const CONSTRAINT_FLOOR: Knob = Knob {
    name: "constraint_floor",
    range: Range::real(-1.0, 0.0),
    meaning: "lowest value of the constraint",
    turn: |tuning, value| tuning.fluid.constraint_floor = value as f32,
};
const TENSION_STRENGTH: Knob = Knob {
    name: "tension_strength",
    range: Range::real(0.0, 1.0),
    meaning: "strength of the tensile correction",
    turn: |tuning, value| tuning.fluid.tension_strength = value as f32,
};
const TENSION_DISTANCE: Knob = Knob {
    name: "tension_distance",
    range: Range::real(0.1, 0.3),
    meaning: "distance of the tensile correction, kernel radii",
    turn: |tuning, value| tuning.fluid.tension_distance = value as f32,
};
pub(super) const PARTICLE_LIMIT: Knob = Knob {
    name: "particle_limit",
    range: Range::whole(1.0, 4_000_000.0),
    meaning: "most particles, rock included",
    turn: |tuning, value| tuning.particle_limit = value as u32,
};

/// All knobs that are numbers.
pub static KNOBS: [Knob; 12] = [
    SUBSTEPS,
    ITERATIONS,
    KERNEL_RADIUS,
    CORRECTION_LIMIT,
    AIR_CELL,
    AIR_COURANT,
    REST_DENSITY,
    RELAXATION,
    CONSTRAINT_FLOOR,
    TENSION_STRENGTH,
    TENSION_DISTANCE,
    PARTICLE_LIMIT,
];

/// Names of all knobs.
pub(super) fn names<'a>() -> impl Iterator<Item = &'a str> {
    KNOBS.iter().map(|knob| knob.name).chain(WORD_KNOBS.iter().map(|knob| knob.name))
}

/// Turns the knobs that the scene's `fluid`, `quality` and `particle_limit` set.
pub(super) fn apply_scene(
    values: &Evaluator<'_>,
    fluid: &FluidText,
    quality: &QualityText,
    particle_limit: Option<&Number>,
    tuning: &mut Tuning,
) -> Result<(), SceneError> {
    let numbers = [
        ("fluid.", REST_DENSITY, fluid.rest_density.as_ref()),
        ("fluid.", RELAXATION, fluid.relaxation.as_ref()),
        ("fluid.", CONSTRAINT_FLOOR, fluid.constraint_floor.as_ref()),
        ("fluid.", TENSION_STRENGTH, fluid.tension_strength.as_ref()),
        ("fluid.", TENSION_DISTANCE, fluid.tension_distance.as_ref()),
        ("quality.", SUBSTEPS, quality.substeps.as_ref()),
        ("quality.", ITERATIONS, quality.iterations.as_ref()),
        ("quality.", KERNEL_RADIUS, quality.kernel_radius.as_ref()),
        ("quality.", CORRECTION_LIMIT, quality.correction_limit.as_ref()),
        ("quality.", AIR_CELL, quality.air_cell.as_ref()),
        ("quality.", AIR_COURANT, quality.air_courant.as_ref()),
        ("", PARTICLE_LIMIT, particle_limit),
    ];
    for (section, knob, number) in numbers {
        if let Some(number) = number {
            let value = values.number(format_args!("{section}{}", knob.name), number, knob.range)?;
            knob.turn(tuning, value);
        }
    }
    if let Some(gradient) = quality.gradient {
        tuning.quality.gradient = gradient;
    }
    if let Some(advection) = quality.air_advection {
        tuning.quality.air_advection = advection;
    }
    Ok(())
}
