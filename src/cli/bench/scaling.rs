//! `bench scaling`: what a tick costs and how exact it is, from a thousand particles to a million.

use crate::{
    cli::{
        args::BenchArguments,
        bench::row,
        failure::Failure,
        output::{self, STDOUT},
        progress, threads,
    },
    lab::{
        machine::processor,
        scaling::{self, Beside, Fit, Plan, Row, SCENE, ScalingError, Skipped},
    },
    sim::{numbers::grouped, workers::Workers},
};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Measures, draws and prints.
pub(super) fn scaling(arguments: &BenchArguments) -> Result<(), Failure> {
    let options = &arguments.scaling;
    let json = arguments.json.as_deref();
    let to_stdout = json == Some(Path::new(STDOUT));
    let beside = match &options.beside {
        None => Vec::new(),
        Some(path) => Beside::read(path).map_err(|error| Failure::Usage(format!("{}: {error}", path.display())))?,
    };
    // The names of the pictures are known before anything is measured.
    let drawings: Vec<PathBuf> =
        (options.svg.iter()).flat_map(|folder| scaling::CHARTS.map(|name| file(folder, name))).collect();
    let outputs = drawings.iter().map(PathBuf::as_path).chain(json.filter(|_| !to_stdout));
    output::check(&outputs.collect::<Vec<_>>())?;
    if options.svg.is_some() {
        output::note_missing_charts("bench scaling --svg");
    }
    threads::start(arguments.threads)?;
    let mut plan = if options.quick { Plan::quick() } else { Plan::full() };
    plan = plan.up_to(options.up_to.unwrap_or(u64::MAX));
    plan.cap = options.cap.unwrap_or(plan.cap);

    let line = progress::status();
    let (rows, skipped) = scaling::measure(&plan, &Workers::default(), &mut |text| line.set_message(text.to_owned()))
        .map_err(|error| match error {
        ScalingError::Scene(error) => Failure::from(error),
        ScalingError::Threads(_) => Failure::Outcome(error.to_string()),
    })?;
    drop(line);
    let fits = scaling::fits(&rows);
    #[cfg(feature = "charts")]
    if let Some(folder) = &options.svg {
        for (name, chart) in scaling::charts(&rows, &beside, &format!("{SCENE}, {}", processor())) {
            output::write(&file(folder, name), |out| std::io::Write::write_all(out, chart.svg()?.as_bytes()))?;
        }
    }
    if let Some(path) = json {
        let report = json!({
            "processor": processor(),
            "scene": SCENE,
            "rows": rows,
            "exponents": fits,
            "left_out": skipped,
            "cap_seconds": plan.cap,
            "beside": beside,
        });
        output::write_json(path, &report)?;
    }
    if to_stdout { Ok(()) } else { output::print(&text(&rows, &fits, &skipped, plan.cap)) }
}

fn file(folder: &Path, name: &str) -> PathBuf {
    folder.join(name).with_extension("svg")
}

/// The tables in Markdown.
fn text(rows: &[Row], fits: &[Fit], skipped: &[Skipped], cap: f64) -> String {
    let all = rows.iter().flat_map(|row| &row.threads).copied().max().unwrap_or(1);
    let mut text = format!("`{SCENE}`, {}:\n\n", processor());
    let heads =
        ["particles", "quality", "ms, 1 thread", &format!("ms, {all} threads"), "ratio", "error, mean", "error, p99"];
    let more = ["bytes a particle", "same hash", "ticks", "runs"];
    let columns: Vec<bool> = (0..heads.len() + more.len()).map(|k| all > 1 || !(3..5).contains(&k)).collect();
    let kept = |cells: Vec<String>| -> String {
        let cells: Vec<String> =
            cells.into_iter().zip(&columns).filter(|(_, kept)| **kept).map(|(cell, _)| cell).collect();
        row(&cells)
    };
    text += &kept(heads.into_iter().chain(more).map(str::to_owned).collect());
    let rule = (0..columns.len()).map(|k| if matches!(k, 1 | 8) { "---" } else { "---:" }.to_owned()).collect();
    text += &kept(rule).replace(' ', "");
    rows.iter().for_each(|row| text += &kept(cells(row)));
    text += "\nA time is the median of the runs' medians over the ticks; error: what exceeds rest density, over the same ticks.\n";
    text += "Cost grows as (least squares over the sizes measured):\n\n";
    text += "| quality | threads | exponent | particles |\n|---|---:|---:|---|\n";
    for Fit { setting, threads, exponent, particles } in fits {
        let range = particles.map(grouped).join(" … ");
        text += &row(&[format!("`{setting}`"), threads.to_string(), format!("{exponent:.3}"), range]);
    }
    if !skipped.is_empty() {
        text += &format!("\nLeft out, since a row may take {cap} s (--cap):\n\n");
        for Skipped { setting, particles, seconds } in skipped {
            text += &format!("- {} × `{setting}`: about {seconds:.0} s\n", grouped(particles));
        }
    }
    text
}

fn cells(row: &Row) -> Vec<String> {
    let ms = |k: usize| {
        row.ms
            .get(k)
            .map_or_else(|| "–".to_owned(), |ms| if *ms < 10.0 { format!("{ms:.3}") } else { format!("{ms:.1}") })
    };
    let error = |error: Option<f64>| error.map_or_else(|| "–".to_owned(), |error| format!("{error:.4}"));
    vec![
        grouped(row.particles),
        format!("`{}`", row.setting),
        ms(0),
        ms(1),
        row.speedup.map_or_else(|| "–".to_owned(), |ratio| format!("{ratio:.2}")),
        error(row.error_mean),
        error(row.error_p99),
        format!("{:.0}", row.bytes_per_particle),
        if row.same_hash { "yes" } else { "NO" }.to_owned(),
        format!("{}–{}", row.window.first, row.window.last),
        row.rounds.to_string(),
    ]
}
