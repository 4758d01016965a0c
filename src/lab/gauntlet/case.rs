//! What a hard case is: a scene, what is done to it, and what must hold all the while.

use crate::{
    kernel::{
        params::{Preset, Quality},
        units::TICKS_PER_SECOND,
    },
    lab::{
        cases::{Over, Size, line},
        gauntlet::{arrange::arrange, end::End, ends, script::Act},
    },
    scene::{self, SceneError, blueprint::Blueprint, effects::EffectModes},
    sim::{checkpoint::Checkpoint, script::Script, state::Setup},
};
use bevy::ecs::world::World;
use glam::DVec2;
use serde::Deserialize;
use std::{collections::BTreeMap, sync::Arc, time::Duration};

/// A hard case, as `assets/gauntlet/KIND.ron` has it.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GauntletCase {
    /// Name on the command line.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What happens, in Markdown.
    #[serde(deserialize_with = "line")]
    pub what: &'static str,
    /// What it guards against, in Markdown.
    #[serde(deserialize_with = "line")]
    pub guards: &'static str,
    /// Why the rules allow what they allow, in Markdown.
    #[serde(deserialize_with = "line")]
    pub allowed: &'static str,
    /// How long it takes.
    pub size: Size,
    /// What it depends on.
    pub over: Over,
    /// Why `classic`, the original's plain method, is known to break a rule here, if it is.
    pub(super) known: Option<Known>,
    /// The text of the scene. What that can't say is added by `arrange`.
    pub(super) scene: &'static str,
    /// The run in which every knob of the scene is at an end of its range (see `ends`).
    #[serde(skip)]
    pub(super) ends: Option<usize>,
    /// Frames of the game in place of ticks that come in time: those that come late, and the time since the one before, s.
    pub(super) late: Option<BTreeMap<u64, f64>>,
    /// What is done before each tick: by default what `script` has under its name.
    #[serde(skip)]
    pub(super) act: Option<Act>,
    /// How long it runs, ticks (frames where some come late). What shall be at rest is so in the last tenth.
    pub(super) ticks: u32,
    /// What must hold.
    pub(super) rules: Rules,
}

/// What the plain method is known to do.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) enum Known {
    /// To water that is deep or pressed hard.
    Boils,
    /// To water at rest.
    Trembles,
}

impl Known {
    /// In words.
    pub(super) fn why(self) -> &'static str {
        match self {
            Self::Boils => {
                "plain PBF carries pressure a few particles down an iteration; water that is deeper than some 27 \
                 particles, or pressed as hard, is crushed and boils"
            }
            Self::Trembles => {
                "plain PBF takes every correction for motion, and water at rest trembles at .06 to .10 d a tick"
            }
        }
    }
}

/// What must hold in a case. These hold in each: every value is finite, pressures are at least 0, no particle is
/// outside the box or inside rock, none goes missing.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Rules {
    /// Where a particle may be: beyond it, it has passed through something.
    pub confines: Option<Confines>,
    /// The most that kinetic and potential energy may be above what was there and was put in, as the speed that all
    /// particles together would have of it.
    pub gain: Option<Gain>,
    /// The fastest that a particle may be, m/s.
    pub fastest: Option<f64>,
    /// How far the liquid is too dense after the shock.
    pub density: Option<Density>,
    /// The root of the mean square of the speeds in the last tenth, in the scene's own spacings a tick: what is calm to
    /// the eye is so at every detail.
    pub rest: Option<f64>,
    /// The most expensive tick, as a multiple of a calm one. Default: [`Rules::WORK`].
    pub work: Option<f64>,
    /// The most by which the mass of air that is shut in may change, as a share of it: 10⁻⁵ is its rounding.
    pub air: Option<f64>,
    /// Whether no limiter may act.
    pub calm: bool,
    /// Particles that are no number and have to be taken away.
    pub removed: u64,
    /// What else must hold at the end.
    pub end: Option<End>,
}

impl Rules {
    /// The most expensive tick of a case that does not say, as a multiple of a calm one.
    const WORK: f64 = 8.0;

    /// The most expensive tick that is allowed, as a multiple of a calm one.
    pub fn most_work(&self) -> f64 {
        self.work.unwrap_or(Self::WORK)
    }
}

/// Where particles may be, m.
#[derive(Clone, Debug, Deserialize)]
pub(super) enum Confines {
    /// In a rectangle.
    Inside { min: (f64, f64), max: (f64, f64) },
    /// Not inside a rectangle.
    Outside { min: (f64, f64), max: (f64, f64) },
    /// Where `a x + b y ≥ c` for each of these (a, b, c).
    Sides(Vec<(f64, f64, f64)>),
}

impl Confines {
    /// Whether a particle may be there.
    pub fn hold(&self, at: DVec2) -> bool {
        match self {
            Self::Inside { min, max } => (min.0..=max.0).contains(&at.x) && (min.1..=max.1).contains(&at.y),
            Self::Outside { min, max } => at.x <= min.0 || at.x >= max.0 || at.y <= min.1 || at.y >= max.1,
            Self::Sides(sides) => sides.iter().all(|(a, b, c)| a * at.x + b * at.y >= *c),
        }
    }
}

/// A bound on the energy gained.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) enum Gain {
    /// A speed, m/s.
    Speed(f64),
    /// A multiple of the speed that corrections can give: the correction limit in each of the quality's substeps. It is
    /// 6 d/s for `draft` and `fast`, 12 for `balanced`, `fine` and `reference` (of its own, shorter d), and 30 for
    /// `classic`.
    Corrections(f64),
}

impl Gain {
    /// In m/s, at a quality and a spacing (m).
    pub fn speed(self, quality: &Quality, spacing: f64) -> f64 {
        match self {
            Self::Speed(speed) => speed,
            Self::Corrections(multiple) => {
                let per_tick = f64::from(quality.correction_limit) * f64::from(quality.substeps);
                multiple * per_tick * f64::from(TICKS_PER_SECOND) * spacing
            }
        }
    }
}

/// Bounds of the 99th percentile of how far the liquid is too dense (see `lab::density`): what is pressed together is
/// what flies apart, where what was torn apart only has bubbles in it.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) struct Density {
    /// Ticks after which the shock is over.
    pub shock: u64,
    /// Bound from there on.
    pub worst: f64,
    /// Bound in the last tenth.
    pub end: f64,
}

impl GauntletCase {
    /// Whether it can be watched in the game: it is not too long, and ticks come in time.
    pub fn is_watchable(&self) -> bool {
        self.late.is_none() && self.size != Size::Long
    }

    /// Makes `world` the case's at a quality, and lets what is done to it begin.
    pub fn play(&self, world: &mut World, preset: Preset) -> Result<(), SceneError> {
        let blueprint = self.blueprint(preset, 1.0)?;
        match self.act {
            Some(act) => world.insert_resource(Script { scene: blueprint.name.clone(), act }),
            None => drop(world.remove_resource::<Script>()),
        }
        Checkpoint::of_scene(Arc::new(blueprint)).restore(world);
        Ok(())
    }

    /// Whether it is the case that `setup` is a world of.
    pub fn is_played(&self, setup: &Setup) -> bool {
        setup.blueprint.name == self.scene_name()
    }

    /// Name of its scene: none of a built-in one.
    fn scene_name(&self) -> String {
        format!("gauntlet_{}", self.name)
    }

    /// Its world at a quality, `detail` times finer than its own spacing.
    pub(super) fn blueprint(&self, preset: Preset, detail: f64) -> Result<Blueprint, SceneError> {
        let settings = self.ends.map(ends::settings).unwrap_or_default();
        let scene = scene::from_text(&self.scene_name(), self.scene)?.at_detail(detail);
        let mut blueprint = scene.build(&settings, Some(preset), &EffectModes::new())?;
        arrange(self.name, &mut blueprint);
        Ok(blueprint)
    }

    /// Time from a frame to the one before; `None` where ticks come in time.
    pub(super) fn frame(&self, frame: u64) -> Option<Duration> {
        let late = self.late.as_ref()?;
        let usual = 1.0 / f64::from(TICKS_PER_SECOND);
        Some(Duration::from_secs_f64(late.get(&frame).copied().unwrap_or(usual)))
    }
}
