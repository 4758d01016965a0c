//! The table of the effects, from which the gate decides, the schedule's passes are counted, and the command line, the HUD
//! and docs/effects.md tell what there is.

use crate::{
    kernel::params::Preset,
    scene::blueprint::{Effect, Mode},
    sim::{effects::facts::Facts, ledger::Pass},
};

/// Whether something is called for, and why or why not.
type Verdict = (bool, &'static str);

/// An effect.
#[derive(Debug)]
pub struct Row {
    /// Which it is.
    pub effect: Effect,
    /// Name on the command line, in scenes and on the screen.
    pub name: &'static str,
    /// What it does, in half a sentence.
    pub meaning: &'static str,
    /// The passes that it adds: nobody else calls them. None where it is a part of another's pass.
    pub passes: &'static [Pass],
    /// The pass that it is a part of, where it has none of its own.
    pub part_of: Option<Pass>,
    /// When `auto` runs it, after "runs in `auto` while".
    pub when: &'static str,
    /// Its parameters, as scene and element files name them.
    pub parameters: &'static [&'static str],
    /// What `off` means.
    pub off: &'static str,
    /// Whether the world calls for it in a tick: what `auto` goes by.
    pub called_for: fn(&Facts) -> Verdict,
    /// When `on` makes another world than `auto`, after "`on` is another world". Empty if never.
    pub another: &'static str,
    /// Whether `on` may make another world of a tick than `auto`. Where it may not in any tick of a run, both are the same
    /// to the bit: either `auto` runs it, or there is nothing for it to do.
    pub differs_from_on: fn(&Facts) -> bool,
}

fn verdict(called: bool, yes: &'static str, no: &'static str) -> Verdict {
    (called, if called { yes } else { no })
}

fn never(_: &Facts) -> bool {
    false
}

/// All effects, in the order of [`Effect::ALL`].
static TABLE: [Row; Effect::ALL.len()] = [
    Row {
        effect: Effect::Air,
        name: "air",
        meaning: "the air moves",
        passes: &[Pass::Air],
        part_of: None,
        when: "the air moves, a fan drives it, or particles drag it along",
        parameters: &["winds", "pressures", "open", "sound_speed", "air_cell", "air_courant", "air_advection"],
        off: "the air stands, whatever moved it before; no grid of it is even built",
        called_for: |facts| {
            if facts.has_fans {
                (true, "a fan drives the air")
            } else if !facts.air_moves && facts.runs(Effect::AirFeedback) {
                (true, "particles drag it along")
            } else {
                verdict(facts.air_moves, "the air moves", "the air is still")
            }
        },
        another: "",
        differs_from_on: never,
    },
    Row {
        effect: Effect::Drag,
        name: "drag",
        meaning: "the air drags particles",
        passes: &[Pass::Drag],
        part_of: None,
        when: "a particle of an element with drag is there",
        parameters: &["drag of an element"],
        off: "particles don't feel the air",
        called_for: |facts| verdict(facts.feels_air, "particles feel the air", "no particle feels the air"),
        another: "only particles without drag are in moving air (their velocities are rounded)",
        differs_from_on: |facts| !facts.feels_air && facts.has_liquid() && facts.air_moves,
    },
    Row {
        effect: Effect::AirFeedback,
        name: "air_feedback",
        meaning: "particles drag the air: what drag takes from one, the other gets",
        passes: &[Pass::Feedback],
        part_of: None,
        when: "particles that feel the air are fast enough to move it, or it moves; never in `classic`",
        parameters: &["air_density", "density of an element"],
        off: "the air loses nothing by what it carries",
        called_for: |facts| {
            if facts.mode(Effect::Air) == Mode::Off {
                (false, "the air is switched off")
            } else if !facts.feels_air {
                (false, "no particle feels the air")
            } else if !facts.runs(Effect::Drag) {
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
        differs_from_on: |facts| facts.mode(Effect::Air) != Mode::Off && facts.runs(Effect::Drag) && facts.feels_air,
    },
    Row {
        effect: Effect::Predictor,
        name: "predictor",
        meaning: "pressure is predicted on a coarse grid before the density constraint",
        passes: &[Pass::Pressure],
        part_of: None,
        when: "there is liquid, in every quality but `classic`",
        parameters: &["kernel_radius", "rest_density"],
        off: "pressure travels one kernel radius an iteration",
        called_for: |facts| {
            if facts.predicts {
                verdict(facts.has_liquid(), "a liquid is there", "no liquid")
            } else {
                (false, "not in this quality")
            }
        },
        another: "there is liquid in `classic`",
        differs_from_on: |facts| facts.has_liquid() && !facts.predicts,
    },
    Row {
        effect: Effect::Tension,
        name: "tension",
        meaning: "particles keep their distance at a surface (s_corr)",
        passes: &[],
        part_of: Some(Pass::Solve),
        when: "there is liquid with a tension",
        parameters: &["tension_strength", "tension_distance"],
        off: "no `s_corr`",
        called_for: |facts| {
            verdict(facts.has_liquid() && facts.has_tension, "a liquid is there", "no liquid, or its tension is 0")
        },
        another: "",
        differs_from_on: never,
    },
    Row {
        effect: Effect::Viscosity,
        name: "viscosity",
        meaning: "neighbouring particles even out their velocities (XSPH)",
        passes: &[Pass::Viscosity],
        part_of: None,
        when: "an element that has it is there",
        parameters: &["viscosity of an element"],
        off: "neighbours keep their own velocities",
        called_for: |facts| verdict(facts.is_viscous, "a viscous liquid is there", "nothing is viscous"),
        another: "",
        differs_from_on: never,
    },
    Row {
        effect: Effect::Vorticity,
        name: "vorticity",
        meaning: "eddies keep turning (vorticity confinement)",
        passes: &[Pass::Vorticity],
        part_of: None,
        when: "an element that has it is there",
        parameters: &["vorticity of an element"],
        off: "eddies die away in the solver",
        called_for: |facts| verdict(facts.keeps_eddies, "a liquid keeps its eddies", "nothing keeps its eddies"),
        another: "",
        differs_from_on: never,
    },
    Row {
        effect: Effect::Sleep,
        name: "sleep",
        meaning: "what has come to rest is left alone until something touches it",
        passes: &[Pass::Sleep],
        part_of: None,
        when: "there is liquid or moving air; never in `reference`, and in `classic` only air sleeps",
        parameters: &[],
        off: "everything is simulated in every tick",
        called_for: |facts| {
            if facts.preset == Preset::Reference {
                (false, "the reference simulates all")
            } else if facts.particles == 0 {
                verdict(facts.air_moves, "calm air sleeps by tiles", "nothing moves")
            } else if !facts.predicts {
                // The plain method simmers: its water never rests (see `water_may_rest`).
                verdict(facts.air_moves, "calm air sleeps by tiles", "without the predictor nothing rests")
            } else if facts.asleep == 0 {
                (true, "nothing rests yet")
            } else if facts.asleep < facts.particles {
                (true, "some of the water rests")
            } else {
                (true, "all of the water rests")
            }
        },
        another: "there is liquid in `classic`, or anything in `reference`",
        differs_from_on: |facts| {
            let is_reference = facts.preset == Preset::Reference;
            facts.has_liquid() && (is_reference || !facts.predicts)
                || is_reference && (facts.has_fans || facts.air_moves)
        },
    },
];

impl Effect {
    /// Its row of the table.
    pub fn row(self) -> &'static Row {
        &TABLE[self as usize]
    }

    /// Name on the command line, in scenes and on the screen.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The effect called `name`.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table of docs/effects.md.
    fn document() -> String {
        let code = |words: &[&str]| words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
        let or_dash = |text: String| if text.is_empty() { "–".to_owned() } else { text };
        let mut text =
            "| effect | what it does | passes | runs in `auto` while | `off` means | `on` is another world while | \
                        parameters |\n|---|---|---|---|---|---|---|\n"
                .to_owned();
        for effect in Effect::ALL {
            let Row { name, meaning, passes, part_of, when, parameters, off, another, .. } = effect.row();
            let names: Vec<&str> = passes.iter().map(|pass| pass.name()).collect();
            let passes = part_of.map_or_else(|| code(&names), |pass| format!("a part of `{}`", pass.name()));
            let parameters = parameters.iter().map(|name| match name.split_once(' ') {
                Some((name, rest)) => format!("`{name}` {rest}"),
                None => format!("`{name}`"),
            });
            let cells = [
                format!("`{name}`"),
                (*meaning).to_owned(),
                passes,
                (*when).to_owned(),
                (*off).to_owned(),
                or_dash((*another).to_owned()),
                or_dash(parameters.collect::<Vec<_>>().join(", ")),
            ];
            text += &format!("| {} |\n", cells.join(" | "));
        }
        text
    }

    #[test]
    fn the_document_has_the_table() {
        let table = document();
        assert!(include_str!("../../../docs/effects.md").contains(&table), "docs/effects.md does not have\n{table}");
    }

    #[test]
    fn rows_stand_in_the_order_of_the_effects_and_names_are_those_of_the_files() {
        for (effect, row) in Effect::ALL.into_iter().zip(&TABLE) {
            assert_eq!(row.effect, effect);
            assert_eq!(format!("\"{}\"", row.name), serde_json::to_string(&effect).unwrap());
            assert_eq!(Effect::find(row.name), Some(effect));
            assert!(row.passes.is_empty() == row.part_of.is_some(), "{}: where is its work?", row.name);
        }
    }

    #[test]
    fn no_pass_belongs_to_two_effects() {
        for pass in Pass::ALL {
            let owners = TABLE.iter().filter(|row| row.passes.contains(&pass)).count();
            assert_eq!(usize::from(pass.effect().is_some()), owners, "{}", pass.name());
        }
    }
}
