//! A scene file with its parameters put in becomes a [`Blueprint`].

use crate::{
    kernel::{
        element::ElementTable,
        heat::table::HeatTable,
        params::{AirParams, Domain, Preset},
        units::Scale,
    },
    scene::{
        blueprint::{Blueprint, scaled_count},
        builtin::{self, Origin, Source},
        category::SceneCategory,
        effects::EffectModes,
        elements::elements,
        error::{SceneError, choices},
        file::{ParameterSpec, SceneText, parse},
        flow::Bounds,
        knobs::{KNOBS, Knob, PARTICLE_LIMIT, Tuning},
        number::{Evaluator, Range},
        place::{Room, fill},
    },
};
use std::{
    borrow::Cow,
    collections::BTreeMap,
    hash::{DefaultHasher, Hash, Hasher},
};

/// Most cells of a box.
pub(crate) const MOST_CELLS: f64 = 64e6;

/// Cells along a side of the box. Beyond 32 768 a position in f32 is coarser than 1/500 of a spacing.
pub(crate) const SIDE: Range = Range::real(4.0, 32_768.0);

/// Details that a run may ask for: how many times finer than the scene's own its particle spacing is.
pub const DETAIL: Range = Range::real(0.125, 8.0);

/// The highest detail of a run: the highest that may be asked for at the finest preset.
pub(crate) const MOST_DETAIL: f64 = 2.0 * DETAIL.max;

/// A scene file that was read and is well-formed; what depends on its parameters is checked by [`SceneFile::build`].
#[derive(Clone, Debug)]
pub struct SceneFile {
    name: String,
    file: String,
    origin: Origin,
    text: SceneText,
    /// Of the text: see [`Blueprint::origin`].
    mark: u64,
    detail: f64,
}

/// Reads the scene called `name_or_path`: a name of [`builtin_names`](crate::scene::builtin_names) or a path to a `.ron` file.
pub fn load(name_or_path: &str) -> Result<SceneFile, SceneError> {
    SceneFile::from_source(builtin::find(name_or_path)?)
}

/// The scene with this text, called `name`. It can't name pictures.
pub fn from_text(name: &str, text: impl Into<Cow<'static, str>>) -> Result<SceneFile, SceneError> {
    SceneFile::from_bytes(
        name,
        match text.into() {
            Cow::Borrowed(text) => Cow::Borrowed(text.as_bytes()),
            Cow::Owned(text) => Cow::Owned(text.into_bytes()),
        },
    )
}

/// What `--set` sets: the scene's parameters (those that it does not set have their defaults), and knobs.
struct Settings {
    parameters: BTreeMap<String, f64>,
    knobs: Vec<(&'static Knob, f64)>,
}

impl SceneFile {
    pub(super) fn from_source(source: Source) -> Result<Self, SceneError> {
        let text: SceneText = parse(&source.file, &source.bytes)?;
        Self::new(source.name, source.file, source.origin, text, &source.bytes)
    }

    /// The scene called `name` that is a part of a file: that of a challenge. It can't name pictures.
    pub(super) fn of_part(name: &str, file: &str, text: SceneText, bytes: &[u8]) -> Result<Self, SceneError> {
        Self::new(name.to_owned(), file.to_owned(), Origin::Builtin, text, bytes)
    }

    fn new(name: String, file: String, origin: Origin, text: SceneText, bytes: &[u8]) -> Result<Self, SceneError> {
        text.check(&file)?;
        let mut hasher = DefaultHasher::new();
        bytes.hash(&mut hasher);
        Ok(Self { name, file, origin, text, mark: hasher.finish(), detail: 1.0 })
    }

    /// The scene called `name` that `bytes` are the file of. It can't name pictures.
    pub(super) fn from_bytes(name: &str, bytes: Cow<'static, [u8]>) -> Result<Self, SceneError> {
        let (name, file) = (name.to_owned(), format!("{name}.ron"));
        Self::from_source(Source { name, file, bytes, origin: Origin::Builtin })
    }

    /// The same scene at another detail, see [`DETAIL`]: at 2 with half the particle spacing and four times the
    /// particles, all else equal. The preset's own detail comes on top of it ([`Preset::detail`]).
    ///
    /// The file keeps its meaning: its `spacing`, and `d` in its expressions, stay the scene's own, and so do the
    /// numbers that it counts in particles (an emitter's `rate` and `total`, `particle_limit`): they stand for the same
    /// matter, of detail² as many particles. What a quality gives in d (kernel radius, correction limit, air cell) is
    /// resolution and goes with the spacing of the run.
    pub fn at_detail(self, detail: f64) -> Self {
        Self { detail, ..self }
    }

    /// Name under `assets/scenes`, or the file's stem.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Title in the scene menu.
    pub fn title(&self) -> &str {
        &self.text.title
    }

    /// One sentence for the scene menu.
    pub fn description(&self) -> &str {
        &self.text.description
    }

    /// Where the gallery shows it; nowhere of its own if the file does not say.
    pub fn category(&self) -> Option<SceneCategory> {
        self.text.category
    }

    /// One thing to do in it; may be empty.
    pub fn invitation(&self) -> &str {
        &self.text.invitation
    }

    /// When it looks best, s.
    pub fn moment(&self) -> f64 {
        self.text.moment
    }

    /// Names of the elements that stand or flow in it, in the order of the file, each once.
    pub fn elements(&self) -> Vec<&str> {
        let stands = self.text.contents.iter().map(|placement| placement.element.as_str());
        let flows = self.text.emitters.iter().map(|emitter| emitter.element.as_str());
        let mut names = Vec::new();
        for name in stands.chain(flows).filter(|name| *name != "none") {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// The scene's own parameters, by name.
    pub fn parameters(&self) -> &BTreeMap<String, ParameterSpec> {
        &self.text.parameters
    }

    /// The world that the scene describes. `settings` (KEY, VALUE) set its parameters and the knobs that every scene has,
    /// the last one of a key counts; `preset` takes the place of the scene's, `effects` those of the scene's that it
    /// names.
    pub fn build(
        &self,
        settings: &[(String, String)],
        preset: Option<Preset>,
        effects: &EffectModes,
    ) -> Result<Blueprint, SceneError> {
        let text = &self.text;
        let elements = elements()?;
        let settings = self.read_settings(settings)?;
        let mut values = Evaluator { file: &self.file, names: settings.parameters.clone() };
        let own_spacing = values.number("spacing", &text.spacing, Range::real(0.001, 100.0))?;
        values.names.insert("d".to_owned(), own_spacing);

        let preset = preset.or(text.quality.preset).unwrap_or(Preset::Balanced);
        let detail = DETAIL.check(self.detail).map_err(|what| values.fault("detail", what))? * preset.detail();
        let spacing = own_spacing / detail;
        let scale = Scale { spacing: spacing as f32, detail: detail as f32 };
        let tuning = self.tune(&values, preset, &settings)?;
        let domain = self.domain(&values, spacing)?;
        let sound_speed = values.number("sound_speed", &text.sound_speed, Range::real(1.0, 400.0))?;
        let air_density = values.number("air_density", &text.air_density, Range::real(0.01, 1000.0))?;
        let bounds = Bounds { values: &values, spacing, detail, size: domain.size };
        let (winds, drains) = (bounds.winds(&text.winds)?, bounds.drains(&text.drains)?);
        let (emitters, pressures) = (bounds.emitters(&elements, &text.emitters)?, bounds.pressures(&text.pressures)?);
        self.check_first_element(&values, &elements)?;
        let filled = fill(
            &Room {
                elements: &elements,
                table: &HeatTable::new(&elements),
                origin: &self.origin,
                spacing,
                size: domain.size,
                particle_limit: scaled_count(tuning.particle_limit, detail),
            },
            &values,
            &text.contents,
        )?;
        Ok(Blueprint {
            name: self.name.clone(),
            title: text.title.clone(),
            description: text.description.clone(),
            parameters: settings.parameters,
            scale,
            domain,
            elements,
            particles: filled.particles,
            solids: filled.solids,
            next_id: filled.next_id,
            emitters,
            winds,
            drains,
            pressures,
            fluid: tuning.fluid,
            air: AirParams {
                sound_speed: (sound_speed / spacing) as f32,
                density: air_density as f32,
                open: text.open,
            },
            effects: text.effects.iter().chain(effects).map(|(effect, mode)| (*effect, *mode)).collect(),
            preset,
            quality: tuning.quality,
            particle_limit: tuning.particle_limit,
            origin: self.mark,
            first_element: text.first_element.clone(),
        })
    }

    fn read_settings(&self, settings: &[(String, String)]) -> Result<Settings, SceneError> {
        let defaults = self.text.parameters.iter().map(|(name, spec)| (name.clone(), spec.default));
        let mut read = Settings { parameters: defaults.collect(), knobs: Vec::new() };
        for (key, value) in settings {
            let fault = |what: String| SceneError::value(&self.file, format_args!("--set {key}={value}"), what);
            if let Some(spec) = self.text.parameters.get(key) {
                read.parameters.insert(key.clone(), spec.range().read(value).map_err(fault)?);
            } else if let Some(knob) = Knob::find(key) {
                read.knobs.push((knob, knob.read(value).map_err(fault)?));
            } else {
                let known = self.text.parameters.keys().map(String::as_str).chain(KNOBS.iter().map(|knob| knob.name));
                return Err(fault(format!("no parameter or knob `{key}`; {}", choices(key, known))));
            }
        }
        Ok(read)
    }

    /// Preset, then what the scene sets, then what the command line sets.
    fn tune(&self, values: &Evaluator<'_>, preset: Preset, settings: &Settings) -> Result<Tuning, SceneError> {
        let text = &self.text;
        let mut tuning = Tuning::from(preset.quality());
        text.fluid.apply(values, &mut tuning)?;
        text.quality.apply(values, &mut tuning)?;
        if let Some(limit) = &text.particle_limit {
            tuning.particle_limit = values.number("particle_limit", limit, PARTICLE_LIMIT)? as u32;
        }
        for (knob, value) in &settings.knobs {
            knob.set(&mut tuning, *value);
        }
        Ok(tuning)
    }

    fn domain(&self, values: &Evaluator<'_>, spacing: f64) -> Result<Domain, SceneError> {
        let metres = values.pair("size", &self.text.size, Range::real(1e-3, 1e9))?;
        // "4 * columns * d" over d may miss the whole number by a rounding error.
        let cells = (metres / spacing * 1e6).round() / 1e6;
        for (axis, cells) in [("x", cells.x), ("y", cells.y)] {
            let fault =
                |what: String| values.fault(format_args!("size.{axis}"), format!("in spacings of {spacing} m, {what}"));
            SIDE.check(cells).map_err(fault)?;
        }
        let size = cells.as_vec2();
        let cells = size.ceil().as_dvec2();
        if cells.x * cells.y > MOST_CELLS {
            let what = format!("{} × {} cells of {spacing} m; allowed: at most {MOST_CELLS} cells", cells.x, cells.y);
            return Err(values.fault("size", what));
        }
        let gravity = values.pair("gravity", &self.text.gravity, Range::real(-1000.0, 1000.0))?;
        Ok(Domain { size, gravity: (gravity / spacing).as_vec2() })
    }

    fn check_first_element(&self, values: &Evaluator<'_>, elements: &ElementTable) -> Result<(), SceneError> {
        match &self.text.first_element {
            Some(name) if elements.find(name).is_none() => {
                let known = elements.iter().map(|(_, element)| element.name.as_str());
                Err(values.fault("first_element", format!("no element `{name}`; {}", choices(name, known))))
            }
            _ => Ok(()),
        }
    }
}
