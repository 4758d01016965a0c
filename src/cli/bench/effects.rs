//! `bench effects`: what each effect costs, and what it saves to run only those that a scene calls for.

use crate::{
    cli::{bench::of_each, failure::Failure, output},
    kernel::params::Preset,
    lab::{
        effect_cost::{self, EffectCost, SceneCost},
        machine::processor,
        markdown,
    },
    scene,
    sim::numbers::{fixed, grouped},
};
use serde_json::json;
use std::path::Path;

/// The quality that is measured.
const PRESET: Preset = Preset::Balanced;

/// Measures every built-in scene and prints the tables.
pub(in crate::cli) fn effects(quick: bool, json: Option<&Path>) -> Result<(), Failure> {
    output::check(json.as_slice())?;
    let rounds = if quick { 1 } else { 5 };
    let scenes: Vec<_> = scene::builtin_names().into_iter().map(|name| (name, &[][..])).collect();
    let costs = of_each(&scenes, |name, _| effect_cost::measure(name, PRESET, rounds))?;
    let value = || json!({ "processor": processor(), "quality": PRESET.name(), "scenes": costs });
    output::report(json, value, || text(&costs))
}

/// The tables in Markdown.
fn text(costs: &[SceneCost]) -> String {
    let scene = |cost: &SceneCost| {
        let SceneCost { scene, ms, ms_all, ms_none, .. } = cost;
        let (particles, cells) = (grouped(cost.particles), grouped(cost.cells));
        let [saved, spread] = [cost.saved(), cost.spread].map(|share| 100.0 * share);
        let same = if cost.same { "yes" } else { "no" };
        format!(
            "`{scene}` | {particles} | {cells} | {ms:.3} | {ms_all:.3} | {saved:.0} % | {same} | {ms_none:.3} | {spread:.0} %"
        )
    };
    let effects = |cost: &SceneCost| {
        let (name, counts) = (cost.scene, [cost.particles, cost.cells]);
        let effect = move |&EffectCost { effect, alone, together }: &EffectCost| {
            let each = counts.map(|count| fixed((count > 0).then(|| 1e6 * together / count as f64), 1)).join(" | ");
            format!("`{name}` | `{effect}` | {alone:.3} | {together:.3} | {each}")
        };
        cost.effects.iter().map(effect).collect::<Vec<_>>()
    };
    let scenes = "scene | >particles | >air cells | >as it is | >everything on | >saved | same world | >everything off | \
                  >spread";
    let of_effects = "scene | effect | >alone, ms | >together, ms | >together, ns a particle | >ns a cell";
    format!(
        "At `{}`, one thread, {}; medians of a tick in ms.\n\n{}\n{}",
        PRESET.name(),
        processor(),
        markdown::rows(scenes, costs.iter().map(scene)),
        markdown::rows(of_effects, costs.iter().flat_map(effects))
    )
}
