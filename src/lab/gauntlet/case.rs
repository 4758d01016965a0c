//! What a hard case is: a scene, what is done to it, and what must hold all the while.

pub(super) use crate::lab::cases::{Over, Size};
use crate::{
    kernel::{
        params::{Preset, Quality},
        units::TICKS_PER_SECOND,
    },
    scene::{self, SceneError, blueprint::Blueprint, effects::EffectModes},
    sim::{checkpoint::Checkpoint, script::Script, state::Setup},
};
use bevy::ecs::world::World;
use glam::DVec2;
use std::{sync::Arc, time::Duration};

/// A hard case.
#[derive(Debug)]
pub struct GauntletCase {
    /// Name on the command line.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What happens, in Markdown.
    pub what: &'static str,
    /// What it guards against, in Markdown.
    pub guards: &'static str,
    /// Why the rules allow what they allow, in Markdown.
    pub allowed: &'static str,
    /// How long it takes.
    pub size: Size,
    /// What it depends on.
    pub over: Over,
    /// The scene.
    pub(super) scene: &'static str,
    /// Knobs of the scene that are turned, on top of the quality.
    pub(super) settings: fn() -> Vec<(String, String)>,
    /// What the start has that a scene's text can't say.
    pub(super) arrange: Option<fn(&mut Blueprint)>,
    /// What is done before each tick.
    pub(super) act: Option<fn(&mut World, u64)>,
    /// Time since the last frame, for each frame of the game that it stands for; without it, ticks come in time.
    pub(super) frames: Option<fn(u64) -> Duration>,
    /// How long it runs, ticks (frames where these are given). What shall be at rest is so in the last tenth.
    pub(super) ticks: u32,
    /// What must hold.
    pub(super) rules: Rules,
    /// Why `classic`, the original's plain method, is known to break a rule here, if it is.
    pub known: Option<&'static str>,
}

/// What must hold in a case. These hold in each: every value is finite, pressures are at least 0, no particle is
/// outside the box or inside rock, none goes missing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules {
    /// Where a particle may be, m: beyond it, it has passed through something.
    pub confines: Option<fn(DVec2) -> bool>,
    /// The most that kinetic and potential energy may be above what was there and was put in, as the speed that all
    /// particles together would have of it.
    pub gain: Option<Gain>,
    /// The fastest that a particle may be, m/s.
    pub fastest: Option<f64>,
    /// The density error after the shock.
    pub density: Option<Density>,
    /// The root of the mean square of the speeds in the last tenth, d a tick.
    pub rest: Option<f64>,
    /// The most expensive tick, as a multiple of a calm one.
    pub work: f64,
    /// The most by which the mass of air that is shut in may change, as a share of it.
    pub air: Option<f64>,
    /// Whether no limiter may act.
    pub calm: bool,
    /// Particles that are no number and have to be taken away.
    pub removed: u64,
    /// What else must hold at the end; else what broke.
    pub also: Option<Look>,
}

/// A bound on the energy gained.
#[derive(Clone, Copy, Debug)]
pub(super) enum Gain {
    /// A speed, m/s.
    Speed(f64),
    /// A multiple of the speed that corrections can give: the correction limit in each of the quality's substeps. It is
    /// 6 d/s for `draft` and `fast`, 12 for `balanced` and `fine`, 48 for `reference` and 30 for `classic`.
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

/// Bounds of the 99th percentile of the density error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Density {
    /// Ticks after which the shock is over.
    pub shock: u64,
    /// Bound from there on.
    pub worst: f64,
    /// Bound in the last tenth.
    pub end: f64,
}

/// Looks at a world; what is wrong with it is the error.
pub type Look = fn(&World) -> Result<(), String>;

impl Rules {
    /// Rounding of the air's mass where it is shut in.
    pub const SEALED: Option<f64> = Some(1e-5);

    /// What must hold in every case.
    pub const ALWAYS: Self = Self {
        confines: None,
        gain: None,
        fastest: None,
        density: None,
        rest: None,
        work: 8.0,
        air: None,
        calm: false,
        removed: 0,
        also: None,
    };
}

impl GauntletCase {
    /// What most cases have in common.
    pub(super) const USUAL: Self = Self {
        name: "",
        title: "",
        what: "",
        guards: "",
        allowed: "",
        size: Size::Usual,
        over: Over::Qualities,
        scene: "",
        settings: Vec::new,
        arrange: None,
        act: None,
        frames: None,
        ticks: 0,
        rules: Rules::ALWAYS,
        known: None,
    };

    /// Whether it can be watched in the game: it is not too long, and the world tells all of it.
    pub fn is_watchable(&self) -> bool {
        self.frames.is_none() && self.size != Size::Long
    }

    /// Makes `world` the case's at a quality, and lets what is done to it begin.
    pub fn play(&self, world: &mut World, preset: Preset) -> Result<(), SceneError> {
        let blueprint = self.blueprint(preset)?;
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

    /// Its world at a quality.
    pub(super) fn blueprint(&self, preset: Preset) -> Result<Blueprint, SceneError> {
        let settings = (self.settings)();
        let mut blueprint =
            scene::from_text(&self.scene_name(), self.scene)?.build(&settings, Some(preset), &EffectModes::new())?;
        if let Some(arrange) = self.arrange {
            arrange(&mut blueprint);
        }
        Ok(blueprint)
    }
}
