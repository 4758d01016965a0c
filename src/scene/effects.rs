//! The table of effects: the parts of the simulation that a scene can switch. The gate decides by it, and the command line,
//! the HUD, the metrics and docs/effects.md say what stands here.

use super::{passes::Pass, table::table};
use crate::kernel::params::Preset;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

pub use super::facts::{Facts, Mode};

/// Wanted mode of each effect; those that are not named are `auto`.
pub type EffectModes = BTreeMap<Effect, Mode>;

/// Whether an effect is called for, and why or why not.
type Verdict = (bool, &'static str);

fn verdict(called: bool, yes: &'static str, no: &'static str) -> Verdict {
    (called, if called { yes } else { no })
}

/// An effect.
#[derive(Debug)]
pub struct EffectRow {
    /// Name on the command line, in scenes and on the screen.
    pub name: &'static str,
    /// What it does, in half a sentence.
    pub meaning: &'static str,
    /// The passes that it adds: nothing else calls them. None where it is a part of another's pass.
    pub passes: &'static [Pass],
    /// The pass that it is a part of, where it has none of its own.
    pub part_of: Option<Pass>,
    /// The effects without which its passes have nothing to do, and are not called even if it is `on`.
    pub needs: &'static [Effect],
    /// When `auto` runs it, after "runs in `auto` while".
    pub when: &'static str,
    /// Its parameters, as scene and element files name them.
    pub parameters: &'static [&'static str],
    /// What `off` means.
    pub off: &'static str,
    /// Whether liquid at rest has to move again to find out where it rests when this starts or stops to run.
    pub wakes: bool,
    /// Whether the world calls for it in a tick, and why or why not: what `auto` goes by.
    pub called_for: fn(&Facts<'_>) -> Verdict,
    /// When `on` makes another world than `auto`, after "`on` is another world". Empty if never.
    pub another: &'static str,
    /// Whether `on` may make another world of a tick than `auto`. Where it may not in any tick of a run, both are the same
    /// to the bit: either `auto` runs it, or there is nothing for it to do.
    pub differs_from_on: fn(&Facts<'_>) -> bool,
}

/// Whether matter may give off gas: [`Effect::Expansion`] is called for.
fn expands(facts: &Facts<'_>) -> Verdict {
    if Effect::Air.mode(facts) == Mode::Off {
        (false, "the air is switched off")
    } else if Effect::Heat.mode(facts) == Mode::Off {
        (false, "no heat makes anything of anything")
    } else if facts.elements.iter().all(|(_, element)| element.gas == 0.0) {
        (false, "no element holds gas")
    } else {
        verdict(facts.has_heat, "what is warm or cold may give off gas", "all is at the room's temperature")
    }
}

/// What an effect is in what its row does not say.
const PLAIN: EffectRow = EffectRow {
    name: "",
    meaning: "",
    passes: &[],
    part_of: None,
    needs: &[],
    when: "",
    parameters: &[],
    off: "",
    wakes: false,
    called_for: |_| (false, ""),
    another: "",
    differs_from_on: |_| false,
};

table! {
    /// An effect: a group of passes that a scene can switch. In the order in which their passes run.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "snake_case")]
    Effect: EffectRow;

    /// The air grid moves.
    Air {
        name: "air",
        meaning: "the air moves",
        passes: &[Pass::Air],
        when: "the air moves, a wind drives it, or particles drag it along",
        parameters: &["winds", "pressures", "open", "sound_speed", "air_cell", "air_courant", "air_advection"],
        off: "the air stands, whatever moved it before; no grid of it is even built",
        called_for: |facts| {
            if facts.has_winds {
                (true, "a wind drives the air")
            } else if !facts.air_moves && Effect::AirFeedback.runs(facts) {
                (true, "particles drag it along")
            } else {
                verdict(facts.air_moves, "the air moves", "the air is still")
            }
        },
        ..PLAIN
    }
    /// The air drags particles.
    Drag {
        name: "drag",
        meaning: "the air drags particles",
        passes: &[Pass::Drag],
        when: "a particle of an element with drag is there",
        parameters: &["drag of an element"],
        off: "particles don't feel the air",
        called_for: |facts| verdict(facts.feels_air(), "particles feel the air", "no particle feels the air"),
        another: "only particles without drag are in moving air (their velocities are rounded)",
        differs_from_on: |facts| !facts.feels_air() && facts.has_liquid() && facts.air_moves,
        ..PLAIN
    }
    /// Particles drag the air.
    AirFeedback {
        name: "air_feedback",
        meaning: "particles drag the air: what drag takes from one, the other gets",
        passes: &[Pass::Feedback],
        needs: &[Effect::Air, Effect::Drag],
        when: "particles that feel the air are fast enough to move it, or it moves; never in `classic`",
        parameters: &["air_density", "density of an element"],
        off: "the air loses nothing by what it carries",
        called_for: |facts| {
            if Effect::Air.mode(facts) == Mode::Off {
                (false, "the air is switched off")
            } else if !facts.feels_air() {
                (false, "no particle feels the air")
            } else if !Effect::Drag.runs(facts) {
                (false, "the drag is switched off")
            } else if facts.preset == Preset::Classic {
                (false, "not in this quality")
            } else {
                verdict(
                    facts.stirs_air || facts.air_moves,
                    "the air moves, or particles could move it",
                    "particles and air are still",
                )
            }
        },
        another: "a particle feels the air: the faintest breath of it wakes air that sleeps",
        differs_from_on: |facts| Effect::Air.mode(facts) != Mode::Off && Effect::Drag.runs(facts) && facts.feels_air(),
        ..PLAIN
    }
    /// The pressure predictor.
    Predictor {
        name: "predictor",
        meaning: "pressure is predicted on a coarse grid before the density constraint",
        passes: &[Pass::Pressure],
        when: "there is liquid, in every quality but `classic`",
        parameters: &["kernel_radius", "rest_density"],
        off: "pressure travels one kernel radius an iteration",
        wakes: true,
        called_for: |facts| {
            if facts.predicts {
                verdict(facts.has_liquid(), "a liquid is there", "no liquid")
            } else {
                (false, "not in this quality")
            }
        },
        another: "there is liquid in `classic`",
        differs_from_on: |facts| facts.has_liquid() && !facts.predicts,
        ..PLAIN
    }
    /// The air lifts gases.
    Buoyancy {
        name: "buoyancy",
        meaning: "gases weigh what they have more than the air that they displace: most of them rise",
        part_of: Some(Pass::Gravity),
        when: "a gas is there",
        parameters: &["density of an element", "air_density"],
        off: "gases fall as all else does",
        wakes: true,
        called_for: |facts| verdict(facts.has_gases(), "a gas is there", "no gas"),
        ..PLAIN
    }
    /// Masses in pressure and constraint.
    Masses {
        name: "masses",
        meaning: "what is heavier sinks: pressure and contact move particles by their masses",
        part_of: Some(Pass::Pressure),
        when: "movable particles of different densities are there",
        parameters: &["density of an element"],
        off: "all that moves is as heavy, and lies where it came to lie",
        wakes: true,
        called_for: |facts| verdict(facts.densities().is_some(), "densities differ", "all that moves is as heavy"),
        ..PLAIN
    }
    /// Friction among grains.
    Friction {
        name: "friction",
        meaning: "grains rub on one another and on walls: they pile up",
        part_of: Some(Pass::Pressure),
        needs: &[Effect::Predictor],
        when: "grains are there, and the predictor runs",
        parameters: &["friction of an element", "cohesion of an element"],
        off: "grains flow as a liquid does",
        wakes: true,
        called_for: |facts| {
            if !facts.has_grains() {
                (false, "no grains")
            } else {
                verdict(Effect::Predictor.runs(facts), "grains are there", "the predictor does not run")
            }
        },
        ..PLAIN
    }
    /// The tensile correction `s_corr`.
    Tension {
        name: "tension",
        meaning: "particles keep their distance at a surface (s_corr)",
        part_of: Some(Pass::Solve),
        when: "there is liquid with a tension",
        parameters: &["tension_strength", "tension_distance"],
        off: "no `s_corr`",
        wakes: true,
        called_for: |facts| {
            verdict(facts.has_liquid() && facts.has_tension, "a liquid is there", "no liquid, or its tension is 0")
        },
        ..PLAIN
    }
    /// XSPH viscosity.
    Viscosity {
        name: "viscosity",
        meaning: "neighbouring particles even out their velocities (XSPH)",
        passes: &[Pass::Viscosity],
        when: "an element that has it is there",
        parameters: &["viscosity of an element", "smoothing of an element"],
        off: "neighbours keep their own velocities",
        wakes: true,
        called_for: |facts| {
            let is_viscous = facts.present(|element| element.viscosity > 0.0 || element.smoothing > 0.0);
            verdict(is_viscous, "a viscous liquid is there", "nothing is viscous")
        },
        ..PLAIN
    }
    /// Vorticity confinement.
    Vorticity {
        name: "vorticity",
        meaning: "eddies keep turning (vorticity confinement)",
        passes: &[Pass::Vorticity],
        when: "an element that has it is there",
        parameters: &["vorticity of an element"],
        off: "eddies die away in the solver",
        wakes: true,
        called_for: |facts| {
            let keeps_eddies = facts.present(|element| element.vorticity > 0.0);
            verdict(keeps_eddies, "a liquid keeps its eddies", "nothing keeps its eddies")
        },
        ..PLAIN
    }
    /// Wandering of gases.
    Diffusion {
        name: "diffusion",
        meaning: "gases spread in the air: lumps that are not among their like wander",
        passes: &[Pass::Diffusion],
        when: "a gas that spreads is there",
        parameters: &["diffusion of an element"],
        off: "lumps of gas keep together as those of a liquid do",
        called_for: |facts| {
            verdict(facts.present(|element| element.diffusion > 0.0), "a gas that spreads is there", "no gas that spreads")
        },
        ..PLAIN
    }
    /// Rock that breaks.
    Fracture {
        name: "fracture",
        meaning: "rock breaks where the air presses on it harder than it bears",
        passes: &[Pass::Fracture],
        needs: &[Effect::Air],
        when: "the air presses harder than a layer of the weakest of the rock that is there bears",
        parameters: &["breaks of an element"],
        off: "rock bears everything",
        called_for: |facts| {
            verdict(facts.presses, "the air presses harder than something bears", "nothing is pressed hard enough to break")
        },
        ..PLAIN
    }
    /// What touches reacts.
    Reactions {
        name: "reactions",
        meaning: "what touches becomes something else: it dissolves, eats or grows",
        passes: &[Pass::React],
        when: "elements are there that react with each other",
        parameters: &["touches of an element"],
        off: "everything lies beside everything and stays what it is",
        called_for: |facts| {
            verdict(facts.can_react, "elements that react are there", "nothing is there that reacts")
        },
        ..PLAIN
    }
    /// What burns and what fades.
    Decay {
        name: "decay",
        meaning: "what is hot enough burns, and smoke fades",
        passes: &[Pass::Decay],
        when: "something is there that burns, and something is or was warmer than the room; or something that fades",
        parameters: &["decays of an element", "energy of an element"],
        off: "nothing burns, and smoke stays",
        called_for: |facts| {
            verdict(facts.may_decay, "something may burn or fade", "nothing is there that burns or fades")
        },
        ..PLAIN
    }
    /// Heat that flows, and what it makes of matter.
    Heat {
        name: "heat",
        meaning: "heat flows from warm to cold; what is hot or cold enough melts, boils, freezes or condenses",
        passes: &[Pass::Heat],
        when: "something is or was warmer or colder than the room",
        parameters: &[
            "temperature of contents",
            "capacity of an element",
            "conductivity of an element",
            "spawn of an element",
            "changes of an element",
        ],
        off: "everything keeps the heat that it has, and stays what it is",
        called_for: |facts| {
            verdict(facts.has_heat, "something is warmer or colder than the room", "all is at the room's temperature")
        },
        ..PLAIN
    }
    /// Warm air.
    Convection {
        name: "convection",
        meaning: "what is warm warms the air, which presses harder and rises",
        part_of: Some(Pass::Heat),
        needs: &[Effect::Heat],
        when: "something is or was warmer or colder than the room, the air itself or matter, and the air is not switched off; \
               never in `classic`",
        parameters: &["air_density", "temperature of pressures"],
        off: "what the air gets of heat is lost at once, and none of it starts warm",
        called_for: |facts| {
            if Effect::Air.mode(facts) == Mode::Off {
                (false, "the air is switched off")
            } else if facts.preset == Preset::Classic {
                (false, "not in this quality")
            } else if facts.air_is_warm {
                (true, "the air is warmer or colder than the room")
            } else {
                verdict(Effect::Heat.runs(facts), "heat flows", "no heat flows")
            }
        },
        another: "heat flows in `classic`",
        differs_from_on: |facts| Effect::Heat.runs(facts) && facts.preset == Preset::Classic,
        ..PLAIN
    }
    /// Gas that matter gives off.
    Expansion {
        name: "expansion",
        meaning: "what burns or boils gives off gas that presses, and what condenses takes it back",
        passes: &[Pass::Expand],
        when: "something is or was warmer or colder than the room; unless `heat` or `air` is off, or no element holds gas",
        parameters: &["gas of an element"],
        off: "what burns or boils leaves the air as it is, and air passes heaps and pools freely",
        called_for: expands,
        another: "nothing calls for it, and air moves about matter: it passes heaps and pools as it passes lone lumps",
        differs_from_on: |facts| !expands(facts).0 && facts.air_moves && facts.has_liquid(),
        ..PLAIN
    }
    /// Bodies of liquid and tiles of air that have come to rest sleep.
    Sleep {
        name: "sleep",
        meaning: "what has come to rest is left alone until something touches it",
        passes: &[Pass::Sleep],
        when: "there is liquid or moving air; never in `reference`, and in `classic` only air sleeps",
        off: "everything is simulated in every tick",
        called_for: |facts| {
            if facts.preset == Preset::Reference {
                (false, "the reference simulates all")
            } else if facts.particles == 0 {
                verdict(facts.air_moves, "calm air sleeps by tiles", "nothing moves")
            } else if !facts.predicts {
                // The plain method simmers: its water never rests.
                verdict(facts.air_moves, "calm air sleeps by tiles", "without the predictor nothing rests")
            } else if facts.asleep == 0 {
                (true, "nothing rests yet")
            } else if facts.asleep < facts.particles {
                (true, "some of it rests")
            } else {
                (true, "all of it rests")
            }
        },
        another: "there is liquid in `classic`, or anything in `reference`",
        differs_from_on: |facts| {
            let is_reference = facts.preset == Preset::Reference;
            facts.has_liquid() && (is_reference || !facts.predicts)
                || is_reference && (facts.has_winds || facts.air_moves)
        },
        ..PLAIN
    }
}

impl Effect {
    /// The effect called `name`.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.name() == name)
    }

    /// The effect that a pass belongs to, if it does to one.
    pub fn of(pass: Pass) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.row().passes.contains(&pass))
    }

    fn mode(self, facts: &Facts<'_>) -> Mode {
        facts.modes[self as usize]
    }

    fn runs(self, facts: &Facts<'_>) -> bool {
        self.decide(facts).0
    }

    /// Whether it runs in a tick with these facts, and why or why not.
    pub fn decide(self, facts: &Facts<'_>) -> (bool, &'static str) {
        match self.mode(facts) {
            Mode::Auto => (self.row().called_for)(facts),
            Mode::On => (true, "switched on"),
            Mode::Off => (false, "switched off"),
        }
    }

    /// Where its work is done: its own passes, or the one that it is a part of.
    pub fn place(self, part_of: &str) -> String {
        let EffectRow { passes, part_of: host, .. } = self.row();
        let own: Vec<&str> = passes.iter().map(|pass| pass.name()).collect();
        host.map_or_else(|| own.join(", "), |host| format!("{part_of} {}", host.name()))
    }
}
