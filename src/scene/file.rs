//! The scene format: what stands in `assets/scenes/*.ron`. Lengths in m, times in s; x points right, y up, and (0, 0) is
//! the lower left corner of the box.
//!
//! Every [`Number`] is a literal or an expression in quotes over the scene's parameters and the spacing `d`. All
//! numbers keep their meaning when the scene is run at another detail ([`SceneFile::at_detail`]): `d` and what is
//! counted in particles are of the scene's own spacing.
//!
//! [`SceneFile::at_detail`]: crate::scene::SceneFile::at_detail

use crate::{
    kernel::params::OpenSides,
    scene::{
        category::SceneCategory,
        effects::EffectModes,
        error::SceneError,
        expression::{is_name, is_reserved},
        knobs::{FluidText, Knob, QualityText},
        number::{Number, Pair, Range},
    },
};
use ron::{Options, error::SpannedError, extensions::Extensions};
use serde::{Deserialize, de::DeserializeOwned};
use std::collections::BTreeMap;

/// A whole scene file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "Scene")]
pub(super) struct SceneText {
    /// Title in the scene menu, 1 … 60 characters.
    pub(super) title: String,
    /// One sentence for the scene menu, at most 300 characters. Default: empty.
    #[serde(default)]
    pub(super) description: String,
    /// Where the gallery shows it: `water`, `powders`, `heat`, `air` or `proofs`. Default: among the player's own.
    pub(super) category: Option<SceneCategory>,
    /// One thing to do in it, for its tile in the gallery, at most 60 characters. Default: empty.
    #[serde(default)]
    pub(super) invitation: String,
    /// When it looks best, for its picture in the gallery, s: 0 … 60. Default: `3`.
    #[serde(default = "default_moment")]
    pub(super) moment: f64,
    /// Numbers that the command line and the menu can set, by name. A name is made of letters, digits and `_`, and is
    /// neither a knob's nor `d`, `min`, `max`, `sqrt`. At most 32. Default: none.
    #[serde(default)]
    pub(super) parameters: BTreeMap<String, ParameterSpec>,
    /// The scene's own particle spacing d, m: 0.001 … 100. The only number whose expression can't use `d`.
    pub(super) spacing: Number,
    /// Width and height of the box, m; each 4 … 32 768 spacings of the run, together at most 64 million cells.
    pub(super) size: Pair,
    /// Gravity, m/s²: −1000 … 1000 each. Default: `(0, -9.81)`.
    #[serde(default = "earth")]
    pub(super) gravity: Pair,
    /// What stands in the box at the start. A placement fills the sites that the ones before it left free. At most
    /// 10 000. Default: nothing.
    #[serde(default)]
    pub(super) contents: Vec<Placement>,
    /// Emitters, at most 1000, on 64 million cells together. Default: none.
    #[serde(default)]
    pub(super) emitters: Vec<EmitterText>,
    /// Winds, at most 1000, on 64 million cells together. Default: none.
    #[serde(default)]
    pub(super) winds: Vec<WindText>,
    /// Drains, at most 1000. Default: none.
    #[serde(default)]
    pub(super) drains: Vec<Area>,
    /// Air that starts at another pressure or temperature than the surroundings', at most 1000 patches, on 1000 million cells
    /// together; where they overlap the last one counts. Default: none.
    #[serde(default)]
    pub(super) pressures: Vec<PressureText>,
    /// Sides of the box that are open to the surroundings' air. Default: none.
    #[serde(default)]
    pub(super) open: OpenSides,
    /// Speed of sound in the air, m/s: 1 … 400. Raising it makes the air stiffer and costs substeps. Real air's 340 is
    /// expensive and looks no different. Default: `40`.
    #[serde(default = "default_sound_speed")]
    pub(super) sound_speed: Number,
    /// Density of the air at pressure 1, kg/m²: 0.01 … 1000. Raising it lets particles drag it along less
    /// (`air_feedback`). Default: `1.2`, that of real air 1 m deep.
    #[serde(default = "default_air_density")]
    pub(super) air_density: Number,
    /// Liquid parameters, see `knobs`. Default: those of `FluidParams`.
    #[serde(default)]
    pub(super) fluid: FluidText,
    /// Wanted effects, `auto`, `on` or `off`: `{air: off}`. Default: `auto` each.
    #[serde(default)]
    pub(super) effects: EffectModes,
    /// Accuracy, see `knobs`. Default: the preset `balanced`.
    #[serde(default)]
    pub(super) quality: QualityText,
    /// Most particles of the scene's own spacing, rock included: 1 … 4 000 000. Default: `200000`. A run of another
    /// detail may have detail² times as many, up to 4 000 000.
    pub(super) particle_limit: Option<Number>,
    /// The element that the palette starts with. Default: the palette's first.
    pub(super) first_element: Option<String>,
}

/// When a scene may look best, s.
const MOMENT: Range = Range::real(0.0, 60.0);

fn earth() -> Pair {
    (Number::Literal(0.0), Number::Literal(-9.81))
}

fn default_moment() -> f64 {
    3.0
}

fn default_sound_speed() -> Number {
    Number::Literal(40.0)
}

fn default_air_density() -> Number {
    Number::Literal(1.2)
}

fn zero() -> Pair {
    (Number::Literal(0.0), Number::Literal(0.0))
}

/// A number of the scene that the command line and the menu can set.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParameterSpec {
    /// Value unless it is set.
    pub default: f64,
    /// Smallest value allowed.
    pub min: f64,
    /// Largest value allowed.
    pub max: f64,
    /// Whether it must be a whole number. Default: `false`.
    #[serde(default)]
    pub integer: bool,
    /// What it means, with its unit.
    pub description: String,
}

impl ParameterSpec {
    /// The values allowed.
    pub fn range(&self) -> Range {
        Range { min: self.min, max: self.max, integer: self.integer }
    }
}

/// An element in a shape. Particles and rock stand on the square lattice of spacing d whose first site is (d/2, d/2):
/// on the sites whose centre is inside the shape.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Placement {
    /// Name of the element, or `none` to clear what stands there.
    pub(super) element: String,
    /// Where.
    pub(super) shape: Shape,
    /// Whether it takes the place of what stands there. Default: `false`.
    #[serde(default)]
    pub(super) replace: bool,
    /// Velocity at the start, m/s: −300 … 300 each; only for what moves. Default: `(0, 0)`.
    #[serde(default = "zero")]
    pub(super) velocity: Pair,
    /// Temperature at the start, K: 1 … 4000, within that at which the element stays what it is. Default: the element's own, of
    /// most 293.
    pub(super) temperature: Option<Number>,
}

/// A region of the plane; it may reach past the box. All coordinates in m, −1e6 … 1e6.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) enum Shape {
    /// A rectangle.
    Rect {
        /// Lower left corner, m.
        min: Pair,
        /// Upper right corner, m; beyond `min` in both components.
        max: Pair,
    },
    /// A disc.
    Disc {
        /// Centre, m.
        centre: Pair,
        /// Radius, m; above 0.
        radius: Number,
    },
    /// A line with round ends.
    Line {
        /// One end, m.
        from: Pair,
        /// The other end, m.
        to: Pair,
        /// Width, m; above 0.
        width: Number,
    },
    /// The inside of a closed outline (where it crosses itself: the even-odd rule).
    Polygon {
        /// Corners, m; 3 … 1000.
        points: Vec<Pair>,
    },
    /// The dark pixels of a picture: those that are more black than white and more opaque than transparent. All pictures
    /// of a scene together: at most 4 × 4096 × 4096 pixels.
    Image {
        /// A PNG file of at most 4096 × 4096 pixels, its path relative to the scene file.
        file: String,
        /// Where the picture's lower left corner comes to lie, m.
        min: Pair,
        /// Where its upper right corner comes to lie, m; beyond `min` in both components.
        max: Pair,
    },
}

/// A rectangle that lies at least in part in the box.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Area {
    /// Lower left corner, m.
    pub(super) min: Pair,
    /// Upper right corner, m; beyond `min` in both components.
    pub(super) max: Pair,
}

/// An emitter: fills the free sites of its rectangle.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EmitterText {
    /// Name of a movable element.
    pub(super) element: String,
    /// Lower left corner, m.
    pub(super) min: Pair,
    /// Upper right corner, m; beyond `min` in both components.
    pub(super) max: Pair,
    /// Velocity of a new particle, m/s: −300 … 300 each. Default: `(0, 0)`.
    #[serde(default = "zero")]
    pub(super) velocity: Pair,
    /// Particles of the scene's own spacing a second at most: 0.001 … 1 000 000.
    pub(super) rate: Number,
    /// Particles of the scene's own spacing in all: a whole number, 1 … 4 000 000. Default: no end.
    pub(super) total: Option<Number>,
    /// When it starts to flow, s: 0 … 1 000 000. Default: `0`.
    pub(super) start: Option<Number>,
}

/// A wind: drives the air in its rectangle towards a velocity.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WindText {
    /// Lower left corner, m.
    pub(super) min: Pair,
    /// Upper right corner, m; beyond `min` in both components.
    pub(super) max: Pair,
    /// Velocity that the air tends to, m/s: −300 … 300 each.
    pub(super) velocity: Pair,
    /// How fast it tends to it, 1/s: 0.001 … 1000. After a time t the difference is down to 1/(1 + rate·t).
    pub(super) rate: Number,
}

/// Air at another pressure or temperature at the start.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PressureText {
    /// Lower left corner, m.
    pub(super) min: Pair,
    /// Upper right corner, m; beyond `min` in both components.
    pub(super) max: Pair,
    /// Pressure as a multiple of the surroundings', with which the air pushes, however warm it is: 0.1 … 10. At `1` it stands
    /// against the air around it.
    pub(super) pressure: Number,
    /// Temperature, K: 1 … 4000. At one pressure warm air is thin and rises. It stays at its default where the effects `air` or
    /// `convection` are off, and in `classic`. Default: the surroundings', `293`.
    pub(super) temperature: Option<Number>,
}

/// Parses RON; `file` is its name in errors.
pub(super) fn parse<T: DeserializeOwned>(file: &str, bytes: &[u8]) -> Result<T, SceneError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let good = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
        let (line, column) = position(&good);
        SceneError::text(file, line, column, "not UTF-8; allowed: a RON text in UTF-8")
    })?;
    if text.trim().is_empty() {
        return Err(SceneError::file(file, "the file is empty; allowed: a RON text, see assets/scenes/empty.ron"));
    }
    let options = Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    options.from_str(text).map_err(|SpannedError { code, span }| {
        if [position(text), position(text.trim_end())].contains(&(span.end.line, span.end.col)) {
            let what = "the text ends too early; allowed: a RON text with every bracket and quote closed";
            return SceneError::text(file, span.end.line, span.end.col, what);
        }
        let what = match code {
            ron::Error::ExceededRecursionLimit => "nested too deeply; allowed: what the format asks for".to_owned(),
            ron::Error::ExpectedComma => "expected a comma or the closing bracket".to_owned(),
            code => code.to_string(),
        };
        SceneError::text(file, span.start.line, span.start.col, what)
    })
}

/// Line and column, from 1, of what follows the text.
fn position(text: &str) -> (usize, usize) {
    let line = 1 + text.bytes().filter(|byte| *byte == b'\n').count();
    (line, 1 + text.chars().rev().take_while(|c| *c != '\n').count())
}

impl SceneText {
    /// Checks what doesn't depend on the values of the parameters.
    pub(super) fn check(&self, file: &str) -> Result<(), SceneError> {
        let fault = |field: &str, what: String| Err(SceneError::value(file, field, what));
        if self.title.trim().is_empty() || self.title.chars().count() > 60 {
            return fault("title", "allowed: 1 to 60 characters".to_owned());
        }
        if self.description.chars().count() > 300 {
            return fault("description", "allowed: at most 300 characters".to_owned());
        }
        if self.invitation.chars().count() > 60 {
            return fault("invitation", "allowed: at most 60 characters".to_owned());
        }
        if let Err(what) = MOMENT.check(self.moment) {
            return fault("moment", what);
        }
        for (list, len, most) in [
            ("parameters", self.parameters.len(), 32),
            ("contents", self.contents.len(), 10_000),
            ("emitters", self.emitters.len(), 1000),
            ("winds", self.winds.len(), 1000),
            ("drains", self.drains.len(), 1000),
            ("pressures", self.pressures.len(), 1000),
        ] {
            if len > most {
                return fault(list, format!("{len} entries; allowed: at most {most}"));
            }
        }
        self.parameters.iter().try_for_each(|(name, spec)| check_parameter(file, name, spec))
    }
}

fn check_parameter(file: &str, name: &str, spec: &ParameterSpec) -> Result<(), SceneError> {
    let fault = |what: String| Err(SceneError::value(file, format_args!("parameters.{name}"), what));
    if !is_name(name) {
        return fault("not a name; allowed: a letter or `_`, then letters, digits and `_`".to_owned());
    }
    if is_reserved(name) || Knob::find(name).is_some() {
        return fault(
            "the name has a meaning already; allowed: any name but a knob's, `d`, `min`, `max`, `sqrt`".to_owned(),
        );
    }
    if !(spec.min.is_finite() && spec.max.is_finite() && spec.min <= spec.max) {
        return fault(format!("min {} and max {}; allowed: finite numbers, min not above max", spec.min, spec.max));
    }
    spec.range().check(spec.default).map(drop).or_else(|what| fault(format!("default {what}")))
}
