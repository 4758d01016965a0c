//! `bench frame`: what a frame's picture costs.

use crate::cli::failure::Failure;
use std::path::Path;

/// Measures scenes at each level and prints a row for each.
#[cfg(feature = "app")]
pub(in crate::cli) fn frame(quick: bool, json: Option<&Path>) -> Result<(), Failure> {
    use crate::{
        cli::{output, progress},
        game::render::frame_cost::{SCENES, SIZE, measure},
        lab::{machine::processor, markdown},
    };
    use serde_json::json;

    output::check(json.as_slice())?;
    let line = progress::bar(SCENES.len() as u64);
    let (mut costs, mut adapter) = (Vec::new(), String::new());
    for (name, ticks) in SCENES {
        line.set_message(name);
        let (found, more) = measure(name, ticks, if quick { 5 } else { 31 })?.map_err(Failure::Usage)?;
        adapter = found;
        costs.extend(more);
        line.inc(1);
    }
    drop(line);
    let value = || json!({ "processor": processor(), "graphics": adapter, "size": SIZE.to_array(), "frames": costs });
    output::report(json, value, || {
        let row = |cost: &crate::game::render::frame_cost::FrameCost| {
            let pass = |(name, drawn, ms): &(&str, u32, f64)| format!("{name} {ms:.2} ({drawn})");
            let passes: Vec<String> = cost.passes.iter().map(pass).collect();
            format!("`{}` | {} | {:.1} | {}", cost.scene, cost.level, cost.frame, passes.join(", "))
        };
        let rows = markdown::rows("scene | level | >frame, ms | passes: ms (instances)", costs.iter().map(row));
        let [width, height] = SIZE.to_array();
        format!(
            "{width} × {height} pixels, {adapter}, {}; medians of frames while the world stands.\n\n{rows}",
            processor()
        )
    })
}

/// A build without graphics says so.
#[cfg(not(feature = "app"))]
pub(in crate::cli) fn frame(_: bool, _: Option<&Path>) -> Result<(), Failure> {
    Err(Failure::Usage("this build draws nothing (it lacks the cargo feature `app`)".to_owned()))
}
