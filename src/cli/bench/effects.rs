//! `bench effects`: what each effect costs, and what it saves to run only those that a scene calls for.

use crate::{
    cli::{
        args::BenchArguments,
        bench::row,
        failure::Failure,
        output::{self, STDOUT},
        progress,
    },
    kernel::params::Preset,
    lab::{
        gating::{self, Plan, SceneCost},
        machine::processor,
    },
    scene,
    sim::numbers::grouped,
};
use serde_json::json;
use std::path::Path;

/// Measures every built-in scene and prints the tables.
pub(super) fn effects(arguments: &BenchArguments) -> Result<(), Failure> {
    let other = arguments.scaling.first_given(&["--quick"]).or(arguments.threads.map(|_| "--threads"));
    if let Some(option) = other {
        return Err(Failure::Usage(format!(
            "{option} does not belong to bench effects; allowed here: --quick, --json"
        )));
    }
    let json = arguments.json.as_deref();
    let to_stdout = json == Some(Path::new(STDOUT));
    output::check(&json.into_iter().filter(|_| !to_stdout).collect::<Vec<_>>())?;
    let plan = Plan { preset: Preset::Balanced, rounds: if arguments.scaling.quick { 1 } else { 5 } };
    let names = scene::builtin_names();
    let line = progress::bar(names.len() as u64);
    let mut costs = Vec::new();
    for name in names {
        line.set_message(name);
        costs.push(gating::measure(name, plan)?);
        line.inc(1);
    }
    drop(line);
    if let Some(path) = json {
        let report = json!({ "processor": processor(), "quality": plan.preset.name(), "scenes": costs });
        output::write_json(path, &report)?;
    }
    if to_stdout { Ok(()) } else { output::print(&text(&costs, plan)) }
}

/// The tables in Markdown.
fn text(costs: &[SceneCost], plan: Plan) -> String {
    let mut text = format!(
        "At `{}`, one thread, {}; medians of a tick in ms.\n\n| scene | particles | air cells | as it is | everything on | \
         saved | same world | everything off | spread |\n|---|---:|---:|---:|---:|---:|---|---:|---:|\n",
        plan.preset.name(),
        processor()
    );
    for cost in costs {
        text += &row(&[
            format!("`{}`", cost.scene),
            grouped(cost.particles),
            grouped(cost.cells),
            format!("{:.3}", cost.ms),
            format!("{:.3}", cost.ms_all),
            format!("{:.0} %", 100.0 * cost.saved()),
            if cost.same { "yes" } else { "no" }.to_owned(),
            format!("{:.3}", cost.ms_none),
            format!("{:.0} %", 100.0 * cost.spread),
        ]);
    }
    text += "\n| scene | effect | alone, ms | together, ms | together, ns a particle | ns a cell |\n\
             |---|---|---:|---:|---:|---:|\n";
    for cost in costs {
        let each = |ms: f64, of: usize| if of > 0 { format!("{:.1}", 1e6 * ms / of as f64) } else { "–".to_owned() };
        for effect in &cost.effects {
            text += &row(&[
                format!("`{}`", cost.scene),
                format!("`{}`", effect.effect),
                format!("{:.3}", effect.alone),
                format!("{:.3}", effect.together),
                each(effect.together, cost.particles),
                each(effect.together, cost.cells),
            ]);
        }
    }
    text
}
