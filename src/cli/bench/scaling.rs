//! `bench scaling`: what a tick costs and how exact it is, from a thousand particles to a million.

use crate::{
    cli::{args::BenchArguments, failure::Failure, output, progress, threads},
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
pub(super) fn scaling(arguments: &BenchArguments) -> Result<(), Failure> {
    let options = &arguments.scaling;
    let json = arguments.json.as_deref();
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
    threads::start(arguments.threads)?;
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
    let columns: Vec<usize> = (0..11).filter(|column| all > 1 || !matches!(column, 3 | 4)).collect();
    let of_all = format!("ms, {all} threads");
    let headings = [
        "particles",
        "quality",
        "ms, 1 thread",
        &of_all,
        "ratio",
        "error, mean",
        "error, p99",
        "bytes a particle",
        "same hash",
        "ticks",
        "runs",
    ];
    let headings: Vec<&str> = columns.iter().map(|column| headings[*column]).collect();
    let shown = |row: &Row| columns.iter().map(|column| cells(row)[*column].clone()).collect::<Vec<_>>();
    let fit = |Fit { setting, threads, exponent, particles }: &Fit| {
        let range = particles.map(grouped).join(" … ");
        vec![format!("`{setting}`"), threads.to_string(), format!("{exponent:.3}"), range]
    };
    let mut text = format!(
        "`{SCENE}`, {}:\n\n{}\nA time is the median of the runs' medians over the ticks; error: what exceeds rest density, \
         over the same ticks.\nCost grows as (least squares over the sizes measured):\n\n{}",
        processor(),
        markdown::table(
            &headings,
            |column| !matches!(columns[column], 1 | 8),
            &rows.iter().map(shown).collect::<Vec<_>>()
        ),
        markdown::table(
            &["quality", "threads", "exponent", "particles"],
            |column| matches!(column, 1 | 2),
            &fits.iter().map(fit).collect::<Vec<_>>()
        )
    );
    if !skipped.is_empty() {
        text += &format!("\nLeft out, since a row may take {cap} s (--cap):\n\n");
        for Skipped { setting, particles, seconds } in skipped {
            text += &format!("- {} × `{setting}`: about {seconds:.0} s\n", grouped(particles));
        }
    }
    text
}

fn cells(row: &Row) -> [String; 11] {
    let ms = |k: usize| fixed(row.ms.get(k).copied(), if row.ms.get(k).is_some_and(|ms| *ms < 10.0) { 3 } else { 1 });
    [
        grouped(row.particles),
        format!("`{}`", row.setting),
        ms(0),
        ms(1),
        fixed(row.speedup, 2),
        fixed(row.error_mean, 4),
        fixed(row.error_p99, 4),
        format!("{:.0}", row.bytes_per_particle),
        if row.same_hash { "yes" } else { "NO" }.to_owned(),
        format!("{}–{}", row.window.first, row.window.last),
        row.rounds.to_string(),
    ]
}
