//! The knobs: the numbers and words that every scene has, and that scene files, `--set`, saves and sweeps know by name. One
//! row each; only the defaults stand elsewhere, with the fields (`kernel::params`).

use crate::{
    kernel::params::{AirAdvection, FluidParams, GradientKernel, Preset, Quality},
    scene::{
        error::{SceneError, choices},
        number::{Evaluator, Number, Range},
    },
};
use serde::Deserialize;

/// What the knobs set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Liquid parameters.
    pub fluid: FluidParams,
    /// Accuracy.
    pub quality: Quality,
    /// Most particles, rock included.
    pub particle_limit: u32,
}

impl Tuning {
    /// Whether all values are allowed, or which is not and what is.
    pub fn check(&self) -> Result<(), String> {
        KNOBS.iter().try_for_each(|knob| knob.check(self))
    }
}

impl From<Quality> for Tuning {
    fn from(quality: Quality) -> Self {
        Self { fluid: FluidParams::default(), quality, particle_limit: 200_000 }
    }
}

/// A number or a word that every scene has.
#[derive(Debug)]
pub struct Knob {
    /// Name in scenes and for `--set`.
    pub name: &'static str,
    /// What it belongs to.
    pub part: Part,
    /// Values allowed.
    pub values: Values,
    /// What it means, with its unit.
    pub meaning: &'static str,
    get: fn(&Tuning) -> f64,
    set: fn(&mut Tuning, f64),
}

/// What a knob belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The accuracy of the liquid.
    Solver,
    /// The accuracy of the air: without air it makes no difference.
    Air,
    /// The liquid itself.
    Liquid,
    /// The world.
    World,
}

/// Values of a knob.
#[derive(Clone, Copy, Debug)]
pub enum Values {
    /// A number.
    Number(Range),
    /// One of these words. As a number it is its index.
    Words(&'static [&'static str]),
}

impl Values {
    /// The numbers allowed.
    pub fn range(self) -> Range {
        match self {
            Self::Number(range) => range,
            Self::Words(words) => Range::whole(0.0, words.len() as f64 - 1.0),
        }
    }
}

const fn whole(min: f64, max: f64) -> Values {
    Values::Number(Range::whole(min, max))
}

const fn real(min: f64, max: f64) -> Values {
    Values::Number(Range::real(min, max))
}

const GRADIENTS: [&str; 2] = [GradientKernel::ALL[0].name(), GradientKernel::ALL[1].name()];
const ADVECTIONS: [&str; 2] = [AirAdvection::ALL[0].name(), AirAdvection::ALL[1].name()];

/// Range of numbers of particles.
pub(super) const PARTICLE_LIMIT: Range = Range::whole(1.0, 4_000_000.0);

macro_rules! knobs {
    ($($(#[$about:meta])* $Text:ident $section:ident $(($preset:ident))? {
        $($field:ident: $Type:ty, $Part:ident, $values:expr, $meaning:literal;)+
    })+) => {
        $(
            $(#[$about])*
            #[derive(Clone, Debug, Default, Deserialize)]
            #[serde(deny_unknown_fields, default)]
            pub(super) struct $Text {
                $(pub(super) $preset: Option<Preset>,)?
                $($field: Option<<$Type as Field>::Text>,)+
            }

            impl $Text {
                /// Sets the knobs that the file sets.
                pub(super) fn apply(&self, values: &Evaluator<'_>, tuning: &mut Tuning) -> Result<(), SceneError> {
                    $(if let Some(text) = &self.$field {
                        let path = concat!(stringify!($section), ".", stringify!($field));
                        tuning.$section.$field = Field::of_text(text, values, path, $values)?;
                    })+
                    Ok(())
                }
            }
        )+

        /// All knobs.
        pub static KNOBS: &[Knob] = &[
            $($(Knob {
                name: stringify!($field),
                part: Part::$Part,
                values: $values,
                meaning: $meaning,
                get: |tuning| tuning.$section.$field.to_number(),
                set: |tuning, value| tuning.$section.$field = Field::of_number(value),
            },)+)+
            Knob {
                name: "particle_limit",
                part: Part::World,
                values: Values::Number(PARTICLE_LIMIT),
                meaning: "most particles of the scene's own spacing, rock included",
                get: |tuning| f64::from(tuning.particle_limit),
                set: |tuning, value| tuning.particle_limit = value as u32,
            },
        ];
    };
}

knobs! {
    /// Accuracy: a preset and what is different from it. The command line's preset takes the place of this one; the
    /// differences stay.
    QualityText quality (preset) {
        substeps: u32, Solver, whole(1.0, 64.0), "substeps a tick";
        iterations: u32, Solver, whole(1.0, 64.0), "solver iterations a substep";
        kernel_radius: f32, Solver, real(2.0, 4.0), "kernel radius h, d";
        gradient: GradientKernel, Solver, Values::Words(&GRADIENTS), "gradient kernel: spiky or rational";
        correction_limit: f32, Solver, real(0.05, 0.5), "furthest correction in a substep, d";
        air_cell: f32, Air, real(1.0, 32.0), "edge of an air cell, d";
        air_courant: f32, Air, real(0.1, 0.9), "Courant number of the air's substeps";
        air_advection: AirAdvection, Air, Values::Words(&ADVECTIONS), "advection of the air: first_order or second_order";
    }
    /// Liquid parameters.
    FluidText fluid {
        rest_density: f32, Liquid, real(0.1, 100.0), "rest density, multiples of the lattice's";
        relaxation: f32, Liquid, real(1e-4, 10.0), "relaxation ε of the constraint, 1/d²; with the predictor at least 0.2";
        constraint_floor: f32, Liquid, real(-1.0, 0.0), "lowest value of the constraint";
        tension_strength: f32, Liquid, real(0.0, 1.0), "strength of the tensile correction";
        tension_distance: f32, Liquid, real(0.1, 0.3), "distance of the tensile correction, kernel radii";
    }
}

impl Knob {
    /// The knob called `name`.
    pub fn find(name: &str) -> Option<&'static Self> {
        KNOBS.iter().find(|knob| knob.name == name)
    }

    /// Those of a quality: all of `Quality` but the predictor, which is the preset's.
    pub fn of_quality() -> impl Iterator<Item = &'static Self> {
        KNOBS.iter().filter(|knob| [Part::Solver, Part::Air].contains(&knob.part))
    }

    /// Its value; of a word its index.
    pub fn get(&self, tuning: &Tuning) -> f64 {
        (self.get)(tuning)
    }

    /// Its value as scene files and `--set` have it.
    pub fn text(&self, tuning: &Tuning) -> String {
        self.text_of(self.get(tuning))
    }

    /// The high or the low end of its values, as scene files and `--set` have it.
    pub fn end(&self, is_high: bool) -> String {
        let Range { min, max, .. } = self.values.range();
        self.text_of(if is_high { max } else { min })
    }

    fn text_of(&self, value: f64) -> String {
        match self.values {
            Values::Number(_) => (value as f32).to_string(),
            Values::Words(words) => words[value as usize].to_owned(),
        }
    }

    /// Sets it to a value that is allowed.
    pub fn set(&self, tuning: &mut Tuning, value: f64) {
        (self.set)(tuning, value);
    }

    /// The value that `--set` means by `text`, or what is wrong with it and what is allowed.
    pub(super) fn read(&self, text: &str) -> Result<f64, String> {
        match self.values {
            Values::Number(range) => range.read(text),
            Values::Words(words) => {
                let word = words.iter().position(|word| *word == text.trim());
                word.map(|word| word as f64).ok_or_else(|| choices(text, words.iter().copied()))
            }
        }
    }

    /// Whether its value is allowed, or what is. The ends of the range are rounded as a value is.
    fn check(&self, tuning: &Tuning) -> Result<(), String> {
        let Range { min, max, .. } = self.values.range();
        let value = self.get(tuning) as f32;
        let holds = (min as f32..=max as f32).contains(&value);
        if holds { Ok(()) } else { Err(format!("{} is {value}; allowed: {min} to {max}", self.name)) }
    }
}

/// The type of a field that a knob sets.
trait Field: Copy {
    /// What stands for it in a scene file.
    type Text;

    fn to_number(self) -> f64;
    fn of_number(number: f64) -> Self;
    fn of_text(text: &Self::Text, values: &Evaluator<'_>, path: &str, allowed: Values) -> Result<Self, SceneError>;
}

macro_rules! field {
    ($($Type:ty, $Text:ty: $to_number:expr, $of_number:expr, $of_text:expr;)+) => {$(
        impl Field for $Type {
            type Text = $Text;

            fn to_number(self) -> f64 {
                $to_number(self)
            }

            fn of_number(number: f64) -> Self {
                $of_number(number)
            }

            fn of_text(text: &$Text, values: &Evaluator<'_>, path: &str, allowed: Values) -> Result<Self, SceneError> {
                $of_text(text, values, path, allowed)
            }
        }
    )+};
}

fn evaluate<T: Field>(text: &Number, values: &Evaluator<'_>, path: &str, allowed: Values) -> Result<T, SceneError> {
    values.number(path, text, allowed.range()).map(T::of_number)
}

field! {
    u32, Number: f64::from, |number| number as u32, evaluate;
    f32, Number: f64::from, |number| number as f32, evaluate;
    GradientKernel, Self: |kernel| f64::from(kernel as u8), |number| Self::ALL[number as usize], |text: &Self, _, _, _| Ok(*text);
    AirAdvection, Self: |order| f64::from(order as u8), |number| Self::ALL[number as usize], |text: &Self, _, _, _| Ok(*text);
}
