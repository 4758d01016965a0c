//! What a hard case is: a scene, what is done to it, and what must hold all the while.

use crate::{
    kernel::{params::Preset, units::TICKS_PER_SECOND},
    lab::{
        cases::{Over, Size, line},
        gauntlet::{
            arrange::arrange,
            confines::Confines,
            end::End,
            ends,
            examiner::Terms,
            rule::{Rule, SWOLLEN},
            script::Act,
        },
    },
    scene::{
        self, SceneError,
        blueprint::Blueprint,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{checkpoint::Checkpoint, numbers::figure, script::Script, state::Setup},
};
use bevy::ecs::world::World;
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
    /// What it is allowed beyond the rules that hold everywhere, and why, in Markdown. Made of what follows.
    #[serde(skip)]
    pub allowed: &'static str,
    /// How long it takes.
    pub size: Size,
    /// What it depends on.
    pub over: Over,
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
    /// Why it may move at its end, in a word or two; without, it must be at rest.
    pub(super) moves: Option<&'static str>,
    /// Ticks after which the shock of its start is over.
    pub(super) shock: u64,
    /// Bounds of its own.
    pub(super) bounds: BTreeMap<Rule, Bound>,
    /// The fastest that a particle may be, m/s, where that is less than the limiters leave.
    pub(super) fastest: Option<Bound>,
    /// Rules that can't apply, and why, in a word or two.
    pub(super) waived: BTreeMap<Rule, &'static str>,
    /// What `classic`, the original's plain method, is known to do, by the rule that it breaks.
    pub(super) known: BTreeMap<Rule, Known>,
    /// What `classic` is known to do that breaks what is the case's own: its end, or that no limiter acts.
    pub(super) known_own: Option<Known>,
    /// Where a particle may be: beyond it, it has passed through something.
    pub(super) confines: Option<Confines>,
    /// Whether no limiter may act.
    pub(super) calm: bool,
    /// Particles that are no number and have to be taken away.
    pub(super) removed: u64,
    /// What else must hold at the end.
    pub(super) end: Option<End>,
    /// Whether what is at rest may sleep, as it does in the game. All other cases are judged awake.
    pub(super) sleeps: bool,
}

/// A bound of a case's own.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Bound {
    /// The most that is allowed, in the unit of the rule.
    pub most: f64,
    /// Where it follows from, in Markdown.
    #[serde(deserialize_with = "line")]
    pub why: &'static str,
}

/// What the plain method is known to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(super) enum Known {
    /// To water that is deep or pressed hard.
    Boils,
    /// To water at rest.
    Trembles,
    /// To particles inside one another.
    Bursts,
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
            Self::Bursts => {
                "plain PBF takes every correction for motion, and what is set apart by up to .5 d a tick flies apart"
            }
        }
    }
}

impl GauntletCase {
    /// Whether it can be watched in the game: it is not too long, and ticks come in time.
    pub fn is_watchable(&self) -> bool {
        self.late.is_none() && self.size < Size::Long
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
        if !self.sleeps {
            // Whether something is at rest is seen only where nothing is held still.
            blueprint.effects.insert(Effect::Sleep, Mode::Off);
        }
        Ok(blueprint)
    }

    /// On what terms its world is judged, where particles are `spacing` m apart.
    pub(super) fn terms(&self, spacing: f64) -> Terms {
        let fastest = self.fastest.map(|bound| (Rule::Speed, bound.most / spacing));
        Terms {
            length: u64::from(self.ticks),
            restless: self.moves.map_or(Ok(()), Err),
            shock: self.shock,
            given_back: SWOLLEN,
            bounds: self.bounds.iter().map(|(rule, bound)| (*rule, bound.most)).chain(fastest).collect(),
            waived: self.waived.clone(),
            confines: self.confines.clone(),
            removed: self.removed,
            lenient: false,
        }
    }

    /// What it is allowed beyond the rules that hold everywhere, and why.
    pub(super) fn exceptions(&self) -> String {
        let moves = self.moves.map(|why| (Rule::Rest, why));
        let waived = self.waived.iter().map(|(rule, why)| (*rule, *why)).chain(moves);
        let bounds = self.bounds.iter().map(|(rule, Bound { most, why })| {
            format!("*{}* up to {} {}: {why}", rule.name(), figure(*most), rule.value())
        });
        let fastest = self.fastest.map(|Bound { most, why }| format!("*speed* up to {} m/s: {why}", figure(most)));
        let waived = waived.map(|(rule, why)| format!("*{}* is not judged: {why}.", rule.name()));
        let own: Vec<String> = bounds.chain(fastest).chain(waived).collect();
        if own.is_empty() { "The bounds that hold everywhere.".to_owned() } else { own.join(" ") }
    }

    /// Time from a frame to the one before; `None` where ticks come in time.
    pub(super) fn frame(&self, frame: u64) -> Option<Duration> {
        let late = self.late.as_ref()?;
        let usual = 1.0 / f64::from(TICKS_PER_SECOND);
        Some(Duration::from_secs_f64(late.get(&frame).copied().unwrap_or(usual)))
    }
}
