//! summary.md: what a reader should choose, and what the knobs buy.

use super::{
    design::effective,
    error::ErrorMeasure,
    presets::{self, Order},
    row::Row,
    truth,
};
use crate::{
    kernel::params::{Preset, Quality},
    lab::{machine::processor, markdown},
    sim::numbers::fixed,
};

/// Times that a reader may have, ms a tick.
pub const BUDGETS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];

/// What the summary is of.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Name of the scene.
    pub scene: &'a str,
    /// Parameters of the scene.
    pub parameters: &'a str,
    /// What the error is.
    pub measure: ErrorMeasure,
    /// Whether the scene has air.
    pub has_air: bool,
    /// Tick of the scene at the moment that all runs set out from.
    pub start: u64,
    /// Ticks of a run.
    pub ticks: u64,
    /// Ticks left out.
    pub warmup: u64,
    /// Threads of the settings that don't stand for threads.
    pub threads: usize,
}

impl Subject<'_> {
    /// Whether the presets are in order.
    pub fn order(&self, rows: &[Row]) -> Order {
        presets::judge(rows, self.measure, self.has_air && self.measure == ErrorMeasure::Density)
    }
}

/// The summary in Markdown.
pub fn text(subject: &Subject, rows: &[Row]) -> String {
    let own: Vec<&Row> = rows.iter().filter(|row| row.setting.threads == subject.threads).collect();
    // Density errors are shares of the run's own spacing: those of finer and coarser runs are of something else.
    let as_fine: Vec<&Row> = own.iter().copied().filter(|row| row.setting.detail() == 1.0).collect();
    let sections = [
        heading(subject, &as_fine),
        budgets(subject, &as_fine),
        preset_table(subject, rows),
        truth::text(&own, &BUDGETS),
        knobs(subject, &as_fine),
        threads(rows),
        excluded(rows),
    ];
    sections.into_iter().filter(|section| !section.is_empty()).collect::<Vec<_>>().join("\n")
}

fn heading(subject: &Subject, rows: &[&Row]) -> String {
    let Subject { scene, parameters, start, ticks, warmup, threads, .. } = subject;
    let (runs, means) = match rows.iter().map(|row| row.runs).max() {
        Some(runs @ 2..) => (
            format!("{runs} times"),
            ", errors the mean over the runs ± its standard error: each but the first starts a rounding off",
        ),
        _ => ("once".to_owned(), ""),
    };
    let particles = rows.iter().map(|row| row.found.particles).max().unwrap_or(0);
    let what = match subject.measure {
        ErrorMeasure::Density => {
            "Error: the density error, a fraction, from positions alone; its mean is what the front goes by."
        }
        ErrorMeasure::Air => "Error: the distance of the air's mean velocity to that of the reference, a fraction.",
    };
    let of_threads = if *threads == 1 { "1 thread".to_owned() } else { format!("{threads} threads") };
    format!(
        "# {scene}: what accuracy costs\n\n{}, {of_threads}; {particles} particles, rock included{parameters}. Every \
         setting ran {ticks} ticks {runs}, from the same moment (tick {start} of the scene) and interleaved; the first \
         {warmup} don't count. Times are the median over the runs of the median tick{means}.\n\n{what}\n",
        processor()
    )
}

fn budgets(subject: &Subject, rows: &[&Row]) -> String {
    let lines = BUDGETS.map(|budget| {
        let best = |wanted: &dyn Fn(&Row) -> bool| {
            let fitting = rows.iter().filter(|row| row.is_valid() && row.ms <= budget && wanted(row));
            let best = fitting.min_by(|a, b| a.error.total_cmp(&b.error).then(a.ms.total_cmp(&b.ms)));
            best.map_or_else(
                || "none | – | –".to_owned(),
                |row| format!("{} | {:.2} | {:.5}", row.title(), row.ms, row.error),
            )
        };
        // A setting with coarser air than the presets' own coarsest is no choice for the liquid's sake.
        let coarsest = Preset::Draft.quality().air_cell;
        let any = |row: &Row| {
            subject.measure == ErrorMeasure::Air || !subject.has_air || row.setting.quality.air_cell <= coarsest
        };
        format!("{budget} | {} | {}", best(&any), best(&|row| row.setting.preset.is_some()))
    });
    let headings = ">at most, ms | setting | >ms | >error | best preset | >ms | >error";
    format!("## What to choose\n\n{}", markdown::rows(headings, lines))
}

fn preset_table(subject: &Subject, rows: &[Row]) -> String {
    let find = |preset: Preset| rows.iter().find(|row| row.setting.preset == Some(preset));
    let line = |row: &Row| {
        let Row { ms, ms_range: [low, high], found, .. } = row;
        let (accuracy, distance) = (found.accuracy, found.accuracy.distance.unwrap_or_default());
        let of = |measure| row.error_scatter.filter(|_| subject.measure == measure);
        let figures = [
            scattered(accuracy.density_error_mean, of(ErrorMeasure::Density), 5),
            fixed(accuracy.density_error_p99, 5),
            fixed(accuracy.density_mean, 3),
            fixed(found.energy_gain, 4),
            scattered(distance.share, row.true_error_scatter, 3),
            fixed(distance.momentum, 3),
            scattered(distance.air, of(ErrorMeasure::Air), 3),
        ];
        let front = if row.front { "yes" } else { "no" };
        format!("{} | {ms:.3} | {low:.3} … {high:.3} | {} | {front}", row.title(), figures.join(" | "))
    };
    let headings = "preset | >ms | >fastest … slowest run | >error mean | >p99 | >mean density | >energy gained | \
                    >liquid elsewhere | >momentum | >air | on the front";
    let table = markdown::rows(headings, Preset::ALL.into_iter().filter_map(find).map(line));
    format!("## The presets\n\n{table}\n{}", subject.order(rows))
}

/// A mean with its standard error, if that is known.
fn scattered(mean: Option<f64>, error: Option<f64>, digits: usize) -> String {
    let error = error.filter(|_| mean.is_some()).map(|error| format!(" ± {error:.digits$}"));
    fixed(mean, digits) + &error.unwrap_or_default()
}

/// One knob turned, from one row to another.
fn knobs(subject: &Subject, rows: &[&Row]) -> String {
    let mut lines = Vec::new();
    for from in rows.iter().filter(|row| row.setting.preset.is_some()) {
        for to in rows {
            let qualities = [from, to].map(|row| effective(row.setting.quality, subject.has_air));
            if let Some(change) = one_change(qualities[0], qualities[1]) {
                let error = fixed(Some(to.error / from.error).filter(|ratio| ratio.is_finite()), 2);
                let (name, time, faults) = (from.title(), to.ms / from.ms, to.faults.join(", "));
                lines.push(format!("{name} | {change} | {time:.2} | {error} | {faults}"));
            }
        }
    }
    let what = "## What a knob buys\n\nOne knob turned, the others left: time and error as multiples of the preset's.";
    section(what, "from | to | >time | >error | not valid", lines)
}

/// A table with what stands above it; nothing without lines.
fn section(above: &str, headings: &str, lines: Vec<String>) -> String {
    if lines.is_empty() { String::new() } else { format!("{above}\n\n{}", markdown::rows(headings, lines)) }
}

/// The knob that differs, if it is one.
fn one_change(from: Quality, to: Quality) -> Option<String> {
    let changes = [
        (from.substeps != to.substeps).then(|| format!("{} substeps", to.substeps)),
        (from.iterations != to.iterations).then(|| format!("{} iterations", to.iterations)),
        (from.kernel_radius != to.kernel_radius).then(|| format!("h {}", to.kernel_radius)),
        (from.correction_limit != to.correction_limit).then(|| format!("correction limit {}", to.correction_limit)),
        (from.predictor != to.predictor).then(|| if to.predictor { "predictor" } else { "no predictor" }.to_owned()),
        (from.gradient != to.gradient).then(|| to.gradient.name().to_owned()),
        (from.air_cell != to.air_cell).then(|| format!("air cell {}", to.air_cell)),
        (from.air_courant != to.air_courant).then(|| format!("Courant {}", to.air_courant)),
        (from.air_advection != to.air_advection).then(|| to.air_advection.words().to_owned()),
    ];
    let mut changes = changes.into_iter().flatten();
    changes.next().filter(|_| changes.next().is_none())
}

/// What threads do to each preset.
fn threads(rows: &[Row]) -> String {
    let mut lines = Vec::new();
    for from in rows.iter().filter(|row| row.setting.preset.is_some()) {
        for to in rows.iter().filter(|to| to.setting.detail() == from.setting.detail()) {
            let (one, other) = (from.setting.threads, to.setting.threads);
            if to.setting.quality == from.setting.quality && other != one {
                let gain = from.ms / to.ms;
                lines.push(format!("{} | {one} | {:.3} | {other} | {:.3} | {gain:.2}", from.title(), from.ms, to.ms));
            }
        }
    }
    let headings = "preset | >threads | >ms | >threads | >ms | >speed-up";
    section("## Threads\n\nThe result is the same to the bit.", headings, lines)
}

fn excluded(rows: &[Row]) -> String {
    let line = |row: &Row| {
        format!("- {} ({:.2} ms, error {:.5}): {}\n", row.title(), row.ms, row.error, row.faults.join(", "))
    };
    let lines: String = rows.iter().filter(|row| !row.is_valid()).map(line).collect();
    if lines.is_empty() {
        return lines;
    }
    format!(
        "## Not valid\n\nError alone misleads: these lose particles, gain energy or stand too thin or too dense, and count \
         for nothing above.\n\n{lines}"
    )
}

#[cfg(test)]
mod tests {
    use super::{
        super::row::tests::{row, subject},
        *,
    };

    #[test]
    fn each_budget_gets_the_exactest_setting_that_fits_and_is_valid() {
        let mut rows =
            [row("draft", 0.5, 0.03), row("2×1", 1.5, 0.001), row("fine", 1.9, 0.005), row("4×4", 0.9, 1e-4)];
        rows[3].faults.push("energy up by 9.0 %".to_owned());
        let text = text(&subject(1), &rows);
        for line in [
            "| 1 | `draft` | 0.50 | 0.03000 | `draft` | 0.50 | 0.03000 |",
            "| 2 | 2×1 | 1.50 | 0.00100 | `fine` | 1.90 | 0.00500 |",
            "- 4×4 (0.90 ms, error 0.00010): energy up by 9.0 %",
        ] {
            assert!(unpadded(&text).contains(line), "no line {line} in\n{text}");
        }
        let nothing = unpadded(&text_of_slow());
        assert!(nothing.contains("| 1 | none | – | – | none | – | – |"), "{nothing}");
    }

    /// The text without what aligns its tables.
    fn unpadded(text: &str) -> String {
        let line = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        text.lines().map(line).collect::<Vec<_>>().join("\n")
    }

    fn text_of_slow() -> String {
        text(&subject(1), &[row("reference", 9.0, 0.0)])
    }

    #[test]
    fn a_turned_knob_and_other_threads_show_as_ratios() {
        let mut rows = ["fast", "fast, h 3", "both", "t", "finer"].map(|name| row(name, 1.0, 0.02));
        (rows[1].ms, rows[1].error, rows[3].ms) = (1.3, 0.01, 0.5);
        rows[1].setting.quality.kernel_radius = 3.0;
        (rows[2].setting.quality.kernel_radius, rows[2].setting.quality.substeps) = (3.0, 2);
        rows[3].setting.threads = 2;
        (rows[4].setting.threads, rows[4].setting.asked_detail) = (2, 2.0);
        (rows[0].found.particles, rows[4].found.particles) = (10, 40);
        let text = unpadded(&text(&subject(1), &rows));
        assert!(text.contains("| `fast` | h 3 | 1.30 | 0.50 | |"), "{text}");
        assert!(text.contains("| `fast` | 1 | 1.000 | 2 | 0.500 | 2.00 |"), "{text}");
        assert!(!text.contains("| `fast` | 1 | 1.000 | 2 | 1.000 |"), "another detail is another world: {text}");
        assert!(text.contains("; 10 particles, rock included"), "the scene's own: {text}");
        let rows_of_knobs = text.lines().filter(|line| line.starts_with("| `fast` |") && line.contains("h 3")).count();
        assert_eq!(rows_of_knobs, 1, "two knobs at once tell nothing");
    }

    #[test]
    fn presets_out_of_order_are_named() {
        let mut rows = ["draft", "fast", "balanced", "fine", "reference"].map(|name| row(name, 0.5, 0.01));
        for (k, row) in rows.iter_mut().enumerate() {
            row.ms = 0.5 + k as f64;
        }
        rows[1].error = 0.02;
        let text = text(&subject(1), &rows);
        assert!(text.contains("\n\nOrder: not ok.\n\n- `draft` → `fast`: the error rises"), "{text}");
    }
}
