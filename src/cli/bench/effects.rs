//! `bench effects`: what each effect costs, and what it saves to run only those that a scene calls for.

use crate::{
    cli::{args::BenchArguments, failure::Failure, output, progress},
    kernel::params::Preset,
    lab::{
        gating::{self, EffectCost, SceneCost},
        machine::processor,
        markdown,
    },
    scene,
    sim::numbers::{fixed, grouped},
};
use serde_json::json;

/// The quality that is measured.
const PRESET: Preset = Preset::Balanced;

const SCENE_HEADINGS: [&str; 9] =
    ["scene", "particles", "air cells", "as it is", "everything on", "saved", "same world", "everything off", "spread"];

const EFFECT_HEADINGS: [&str; 6] =
    ["scene", "effect", "alone, ms", "together, ms", "together, ns a particle", "ns a cell"];

/// Measures every built-in scene and prints the tables.
pub(super) fn effects(arguments: &BenchArguments) -> Result<(), Failure> {
    let other = arguments.scaling.first_given(&["--quick"]).or(arguments.threads.map(|_| "--threads"));
    if let Some(option) = other {
        return Err(Failure::Usage(format!(
            "{option} does not belong to bench effects; allowed here: --quick, --json"
        )));
    }
    let json = arguments.json.as_deref();
    output::check(json.as_slice())?;
    let rounds = if arguments.scaling.quick { 1 } else { 5 };
    let names = scene::builtin_names();
    let line = progress::bar(names.len() as u64);
    let mut costs = Vec::new();
    for name in names {
        line.set_message(name);
        costs.push(gating::measure(name, PRESET, rounds)?);
        line.inc(1);
    }
    drop(line);
    let value = || json!({ "processor": processor(), "quality": PRESET.name(), "scenes": costs });
    output::report(json, value, || text(&costs))
}

/// The tables in Markdown.
fn text(costs: &[SceneCost]) -> String {
    let scene = |cost: &SceneCost| {
        vec![
            format!("`{}`", cost.scene),
            grouped(cost.particles),
            grouped(cost.cells),
            format!("{:.3}", cost.ms),
            format!("{:.3}", cost.ms_all),
            format!("{:.0} %", 100.0 * cost.saved()),
            if cost.same { "yes" } else { "no" }.to_owned(),
            format!("{:.3}", cost.ms_none),
            format!("{:.0} %", 100.0 * cost.spread),
        ]
    };
    let each = |ms: f64, of: usize| fixed((of > 0).then(|| 1e6 * ms / of as f64), 1);
    let effects = |cost: &SceneCost| {
        let effect = |effect: &EffectCost| {
            vec![
                format!("`{}`", cost.scene),
                format!("`{}`", effect.effect),
                format!("{:.3}", effect.alone),
                format!("{:.3}", effect.together),
                each(effect.together, cost.particles),
                each(effect.together, cost.cells),
            ]
        };
        cost.effects.iter().map(effect).collect::<Vec<_>>()
    };
    let scenes: Vec<Vec<String>> = costs.iter().map(scene).collect();
    let effects: Vec<Vec<String>> = costs.iter().flat_map(effects).collect();
    format!(
        "At `{}`, one thread, {}; medians of a tick in ms.\n\n{}\n{}",
        PRESET.name(),
        processor(),
        markdown::table(&SCENE_HEADINGS, |column| !matches!(column, 0 | 6), &scenes),
        markdown::table(&EFFECT_HEADINGS, |column| column > 1, &effects)
    )
}
