//! `bench frame`: what a frame's picture costs.

use crate::cli::failure::Failure;
use std::path::Path;

/// Measures scenes at each level and prints a row for each.
#[cfg(feature = "app")]
pub(in crate::cli) fn frame(quick: bool, json: Option<&Path>) -> Result<(), Failure> {
    use crate::{
        cli::{output, progress},
        game::render::frame_cost::{LevelCost, SCENES, SIZE, SceneCost, measure},
        lab::{machine::processor, markdown},
    };
    use serde_json::json;

    output::check(json.as_slice())?;
    let line = progress::bar(SCENES.len() as u64);
    let (mut costs, mut adapter) = (Vec::new(), String::new());
    for scene in SCENES {
        line.set_message(scene.0);
        let (found, cost) = measure(scene, if quick { 5 } else { 31 })?.map_err(Failure::Usage)?;
        adapter = found;
        costs.push(cost);
        line.inc(1);
    }
    drop(line);
    let value = || json!({ "processor": processor(), "graphics": adapter, "size": SIZE.to_array(), "scenes": costs });
    output::report(json, value, || {
        let name = |SceneCost { scene, detail, .. }: &SceneCost| match detail {
            1.0 => format!("`{scene}`"),
            _ => format!("`{scene}`, detail {detail}"),
        };
        let level = |name: &str, cost: &LevelCost| {
            let pass = |(name, drawn, ms): &(&str, u32, f64)| format!("{name} {ms:.2} ({drawn})");
            let passes: Vec<String> = cost.passes.iter().map(pass).collect();
            format!("{name} | {} | {:.1} | {}", cost.level, cost.frame, passes.join(", "))
        };
        let levels = costs.iter().flat_map(|cost| cost.levels.iter().map(move |own| level(&name(cost), own)));
        let running = costs.iter().map(|cost| {
            let SceneCost { particles, rock, extract, pack, upload, .. } = cost;
            format!("{} | {particles} | {rock} | {extract:.2} | {pack:.2} | {upload:.2}", name(cost))
        });
        let [width, height] = SIZE.to_array();
        format!(
            "{width} × {height} pixels, {adapter}, {}; medians of frames while the world stands.\n\n{}\n\
             Processor time at `full` for what a frame needs of a world that runs: to copy it out, for which the world waits, to \
             pack it, and to hand it to the graphics; medians of frames with a tick each.\n\n{}",
            processor(),
            markdown::rows("scene | level | >frame, ms | passes: ms (instances)", levels),
            markdown::rows("scene | >particles | >rock | >extraction, ms | >packing, ms | >upload, ms", running),
        )
    })
}

/// A build without graphics says so.
#[cfg(not(feature = "app"))]
pub(in crate::cli) fn frame(_: bool, _: Option<&Path>) -> Result<(), Failure> {
    Err(Failure::Usage("this build draws nothing (it lacks the cargo feature `app`)".to_owned()))
}
