//! Every number that a scene or a quality can set, with its meaning and default. The ranges of those that have a knob stand
//! in the table of knobs (`src/scene/knobs.rs`).

use crate::units::Scale;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Liquid parameters of a scene (Position Based Fluids, Macklin & Müller 2013).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FluidParams {
    /// Rest density as a multiple of the density of the square lattice of spacing d. Below 1 the particles push each
    /// other further apart than d, above 1 they stand closer. Default: `1.0`.
    pub rest_density: f32,
    /// Relaxation ε in the denominator of λ (eq. 11), 1/d². Raising it softens the constraint and calms it. Where the
    /// pressure predictor runs it is at least [`PREDICTED_RELAXATION`](crate::pbf::PREDICTED_RELAXATION).
    /// Default: `0.01`.
    pub relaxation: f32,
    /// Lowest value of the constraint C. 0: the liquid only pushes; lower, it also pulls and holds together, and
    /// particles clump. Default: `0.0`.
    pub constraint_floor: f32,
    /// Strength k of the tensile correction `s_corr` (eq. 13), in the unit of λ. Raising it keeps particles apart at
    /// free surfaces. The paper's 0.1 swells them (docs/deviations.md). Default: `0.001`.
    pub tension_strength: f32,
    /// Distance Δq of `s_corr` as a share of the kernel radius. Default: `0.2`.
    pub tension_distance: f32,
}

impl Default for FluidParams {
    fn default() -> Self {
        Self {
            rest_density: 1.0,
            relaxation: 0.01,
            constraint_floor: 0.0,
            tension_strength: 0.001,
            tension_distance: 0.2,
        }
    }
}

/// Which sides of the box let air in and out. An open side stands at the pressure of the surroundings, 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OpenSides {
    /// x = 0. Default: `false`.
    pub left: bool,
    /// x = width. Default: `false`.
    pub right: bool,
    /// y = 0. Default: `false`.
    pub bottom: bool,
    /// y = height. Default: `false`.
    pub top: bool,
}

/// Air parameters of a scene, in kernel units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AirParams {
    /// Speed of sound c, d/s: pressure differences accelerate the air by `−c² ∇p`. Raising it makes the air stiffer and
    /// costs substeps.
    pub sound_speed: f32,
    /// Density at pressure 1, kg/m²: what the air weighs against the particles that drag it (`air_feedback`). 0.01 … 1000.
    pub density: f32,
    /// Sides that are open to the surroundings.
    pub open: OpenSides,
}

impl AirParams {
    /// What air of pressure 1 resists with, `ρ c²`, Pa.
    pub fn stiffness(&self, scale: Scale) -> f32 {
        let sound = scale.to_metres(self.sound_speed);
        self.density * sound * sound
    }
}

/// Density of real air of a depth of 1 m at pressure 1, kg/m².
pub const AIR_DENSITY: f32 = 1.2;

/// An enum whose variants have names.
macro_rules! named {
    ($(#[$about:meta])* $Enum:ident: $($(#[$doc:meta])* $Variant:ident = $name:literal,)+) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        pub enum $Enum { $($(#[$doc])* #[serde(rename = $name)] $Variant,)+ }

        impl $Enum {
            /// All, in the order in which they are shown.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$Variant),+];

            /// Name in files, on the command line and on the screen.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$Variant => $name,)+
                }
            }
        }
    };
}
pub(crate) use named;

named! {
    /// The gradient kernel of the density constraint.
    GradientKernel:

    /// `−30/(π h⁵) (h − r)² r̂`, the paper's: a square root and a division a pair.
    Spiky = "spiky",
    /// `(h² − r²)² / (3.84 h (r² + 0.043 h²))` in place of `(h − r)²/r`: within 3 % of spiky for r > 0.3 h, zero and
    /// smooth at r = 0, one division a pair.
    Rational = "rational",
}

named! {
    /// How the air's velocity is carried along with it.
    AirAdvection:

    /// The original's: what leaves a cell has the cell's mean velocity. Cheapest, and smears an eddy as a viscosity of
    /// 0.18 times its speed times a cell's edge would.
    FirstOrder = "first_order",
    /// What leaves a cell has the velocity of the part of the cell that leaves (limited slopes, van Leer 1979). A step costs
    /// twice as much and smears a thirtieth of that at cells of 4 d (docs/accuracy.md).
    SecondOrder = "second_order",
}

impl AirAdvection {
    /// What it is called on the screen and in texts.
    pub const fn words(self) -> &'static str {
        match self {
            Self::FirstOrder => "first order",
            Self::SecondOrder => "second order",
        }
    }
}

/// How the air is moved on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirScheme {
    /// Wind plus sound stay below so many cells a substep; up to
    /// [`STABLE_COURANT`](crate::air::STABLE_COURANT) is taken.
    pub courant: f32,
    /// How velocity is carried along.
    pub advection: AirAdvection,
}

/// What accuracy is bought with. A preset is a full set of these.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quality {
    /// Substeps a tick; more in a tick whose speeds call for it. Raising it costs in proportion and lowers the
    /// density error more than iterations do.
    pub substeps: u32,
    /// Solver iterations a substep at most. With the predictor and up to five substeps only the first goes over all
    /// of the liquid, and those after it where it is still too dense: they cost a tenth to a third of the first. Otherwise
    /// raising this costs in proportion.
    pub iterations: u32,
    /// Kernel radius h, d. 2.5 serves best; smaller is rougher, larger more expensive.
    pub kernel_radius: f32,
    /// Furthest that iterating may move a particle from its prediction in a substep along an axis, d. With the
    /// predictor, crowded particles may go 0.2 d if this is less ([`Quality::longest_correction`]).
    pub correction_limit: f32,
    /// Edge of an air cell, d. Smaller sees finer eddies and costs with the inverse cube.
    pub air_cell: f32,
    /// Courant number that the air's substeps keep to: share of a cell that sound and wind cross in one.
    pub air_courant: f32,
    /// Advection of the air.
    pub air_advection: AirAdvection,
    /// Gradient kernel.
    pub gradient: GradientKernel,
    /// Whether the pressure predictor goes before the constraint. It costs about as much as two iterations and makes
    /// the error independent of depth.
    pub predictor: bool,
}

named! {
    /// The named qualities, cheapest first but for `classic`. The others are steps on the curve of error against time: each
    /// costs more and is more exact than the one before it, and no other setting gives more for the same cost
    /// (docs/accuracy.md).
    #[derive(Hash)]
    Preset:

    /// The original's plain method: one substep, four iterations, the exact spiky kernel.
    Classic = "classic",
    /// For the weakest machine: one substep of one iteration, coarse air.
    Draft = "draft",
    /// A second iteration, finer air.
    Fast = "fast",
    /// The default. Up to four iterations, finer air.
    Balanced = "balanced",
    /// A second substep, finer air.
    Fine = "fine",
    /// What the others are compared with; not meant to run in real time: `fine` at twice the detail. More substeps and
    /// a wider kernel cost more and were hardly truer.
    Reference = "reference",
}

/// Furthest that the most crowded particle may be corrected in a substep where the pressure predictor runs, if the correction
/// limit is less, d along each axis. In a corner that a stream presses on, a crowd of particles near one point is held
/// together from outside: it must part faster than more are pressed in.
const CROWDED_LIMIT: f32 = 0.2;

/// Density error, as a share of the density aimed at, from which on liquid is iterated again where the pressure predictor
/// runs: shared by the substeps of a tick, each of which corrects what it finds. What is less dense has been corrected once
/// and is left to the next substep: to iterate there costs as much and buys nothing (docs/accuracy.md, "Iterating where the
/// error is").
const ITERATE_ABOVE: f32 = 0.05;
/// Where a substep's share of that is less than this, next to everything would be iterated again, and all of it is.
const LEAST_TO_LOOK_FOR: f32 = 0.01;

impl Quality {
    /// How the air is moved on.
    pub fn air_scheme(&self) -> AirScheme {
        AirScheme { courant: self.air_courant, advection: self.air_advection }
    }

    /// Density error, as a share of the density aimed at, from which on liquid is iterated again; `None`: whatever it is.
    pub fn iterate_above(&self) -> Option<f32> {
        let error = ITERATE_ABOVE / self.substeps as f32;
        (self.predictor && error >= LEAST_TO_LOOK_FOR).then_some(error)
    }

    /// Furthest that iterating may move the most crowded particle in a substep along an axis, d. The neighbour search
    /// reaches further than the kernel by twice this, so that no pair is missed.
    pub fn longest_correction(&self) -> f32 {
        if self.predictor { self.correction_limit.max(CROWDED_LIMIT) } else { self.correction_limit }
    }
}

impl Preset {
    /// The preset called `name`.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// Detail that the preset adds to the run's: it multiplies the particles along each axis. 2 for `reference`, else
    /// 1.
    pub const fn detail(self) -> f64 {
        match self {
            Self::Reference => 2.0,
            _ => 1.0,
        }
    }

    /// The numbers behind the name.
    pub fn quality(self) -> Quality {
        let base = Quality {
            substeps: 1,
            iterations: 1,
            kernel_radius: 2.5,
            correction_limit: 0.2,
            air_cell: 4.0,
            air_courant: 0.7,
            air_advection: AirAdvection::SecondOrder,
            gradient: GradientKernel::Rational,
            predictor: true,
        };
        match self {
            Self::Classic => Quality {
                iterations: 4,
                correction_limit: 0.5,
                air_advection: AirAdvection::FirstOrder,
                gradient: GradientKernel::Spiky,
                predictor: false,
                ..base
            },
            Self::Draft => Quality { air_cell: 6.0, ..base },
            Self::Fast => Quality { iterations: 2, air_cell: 5.0, ..base },
            Self::Balanced => Quality { iterations: 4, ..base },
            Self::Fine | Self::Reference => {
                Quality { substeps: 2, iterations: 4, correction_limit: 0.1, air_cell: 3.0, ..base }
            }
        }
    }
}

/// The surroundings of a world that never change during a step, in kernel units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// Size of the box `[0, x] × [0, y]`, d.
    pub size: Vec2,
    /// Gravity, d/s².
    pub gravity: Vec2,
}

/// Nearest that a liquid particle comes to a box wall, d.
pub const WALL_GAP: f32 = 0.25;

impl Domain {
    /// Upper right corner of where liquid particles may be, d; the lower left one is `WALL_GAP` in both coordinates.
    pub fn highest(&self) -> Vec2 {
        self.size - Vec2::splat(WALL_GAP)
    }

    /// The nearest place to a point where a liquid particle may be as far as the box's walls go.
    pub fn keep_inside(&self, point: Vec2) -> Vec2 {
        point.max(Vec2::splat(WALL_GAP)).min(self.highest())
    }
}
