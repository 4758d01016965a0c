//! `bench scaling`: what a tick costs and how exact it is, from a thousand particles to a million.

use crate::{
    cli::{args::ScalingOptions, failure::Failure, output, progress, threads},
    lab::{
        machine::processor,
        markdown,
        scaling::{self, Beside, Fit, Plan, Row, SCENE, Skipped},
    },
    sim::{
        numbers::{fixed, grouped},
        workers::Workers,
    },
};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Measures, draws and prints.
pub(in crate::cli) fn scaling(options: &ScalingOptions, json: Option<&Path>) -> Result<(), Failure> {
    let beside = match &options.beside {
        None => Vec::new(),
        Some(path) => Beside::read(path).map_err(|error| Failure::Usage(format!("{}: {error}", path.display())))?,
    };
    // The names of the pictures are known before anything is measured.
    let drawings: Vec<PathBuf> =
        (options.svg.iter()).flat_map(|folder| scaling::CHARTS.map(|name| file(folder, name))).collect();
    let outputs = drawings.iter().map(PathBuf::as_path).chain(json);
    output::check(&outputs.collect::<Vec<_>>())?;
    if options.svg.is_some() {
        output::note_missing_charts("bench scaling --svg");
    }
    threads::start(options.threads)?;
    let mut plan = if options.quick { Plan::quick() } else { Plan::full() };
    plan = plan.up_to(options.up_to.unwrap_or(u64::MAX));
    plan.cap = options.cap.unwrap_or(plan.cap);

    let line = progress::status();
    let (rows, skipped) = scaling::measure(&plan, &Workers::default(), &mut |text| line.set_message(text.to_owned()))?;
    drop(line);
    let fits = scaling::fits(&rows);
    #[cfg(feature = "charts")]
    if let Some(folder) = &options.svg {
        for (name, chart) in scaling::charts(&rows, &beside, &format!("{SCENE}, {}", processor())) {
            output::write(&file(folder, name), |out| std::io::Write::write_all(out, chart.svg()?.as_bytes()))?;
        }
    }
    let value = || {
        json!({
            "processor": processor(),
            "scene": SCENE,
            "rows": rows,
            "exponents": fits,
            "left_out": skipped,
            "cap_seconds": plan.cap,
            "beside": beside,
        })
    };
    output::report(json, value, || text(&rows, &fits, &skipped, plan.cap))
}

fn file(folder: &Path, name: &str) -> PathBuf {
    folder.join(name).with_extension("svg")
}

/// The tables in Markdown.
fn text(rows: &[Row], fits: &[Fit], skipped: &[Skipped], cap: f64) -> String {
    let all = rows.iter().flat_map(|row| &row.threads).copied().max().unwrap_or(1);
    // With one thread there is no ratio.
    let of_all = if all > 1 { format!("| >ms, {all} threads | >ratio ") } else { String::new() };
    let headings = format!(
        ">particles | quality | >ms, 1 thread {of_all}| >error, mean | >error, p99 | >bytes a particle | same hash | >ticks | \
         >runs"
    );
    let fit = |Fit { setting, threads, exponent, particles }: &Fit| {
        format!("`{setting}` | {threads} | {exponent:.3} | {}", particles.map(grouped).join(" … "))
    };
    let mut text = format!(
        "`{SCENE}`, {}:\n\n{}\nA time is the median of the runs' medians over the ticks; error: that of the density, \
         over the same ticks.\nCost grows as (least squares over the sizes measured):\n\n{}",
        processor(),
        markdown::rows(&headings, rows.iter().map(|row| line(row, all))),
        markdown::rows("quality | >threads | >exponent | particles", fits.iter().map(fit))
    );
    if !skipped.is_empty() {
        text += &format!("\nLeft out, since a row may take {cap} s (--cap):\n\n");
        for Skipped { setting, particles, seconds } in skipped {
            text += &format!("- {} × `{setting}`: about {seconds:.0} s\n", grouped(particles));
        }
    }
    text
}

fn line(row: &Row, threads: usize) -> String {
    let ms = |k: usize| fixed(row.ms.get(k).copied(), if row.ms.get(k).is_some_and(|ms| *ms < 10.0) { 3 } else { 1 });
    let of_all = if threads > 1 { format!("| {} | {} ", ms(1), fixed(row.speedup, 2)) } else { String::new() };
    let Row { setting, bytes_per_particle: bytes, window, rounds, .. } = row;
    let [mean, p99] = [row.error_mean, row.error_p99].map(|error| fixed(error, 4));
    let same = if row.same_hash { "yes" } else { "NO" };
    let (particles, one) = (grouped(row.particles), ms(0));
    let (first, last) = (window.first, window.last);
    format!(
        "{particles} | `{setting}` | {one} {of_all}| {mean} | {p99} | {bytes:.0} | {same} | {first}–{last} | {rounds}"
    )
}
