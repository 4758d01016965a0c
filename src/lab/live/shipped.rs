//! The curves that are shipped: what `sweep` wrote into docs/accuracy is in the program as it stands there. Of a table
//! the presets are read, at every detail at which they were measured, as far as their numbers are those of today.

use crate::{
    kernel::params::Preset,
    lab::{
        dial::is_same_detail,
        live::accuracy::{Curve, CurvePoint, fingerprint},
    },
    scene::{self, Knob, Tuning, blueprint::Blueprint, effects::EffectModes},
};
use bevy::log::warn;
use csv::{Reader, StringRecord};
use serde::Deserialize;

/// Bytes of either end of a summary that are kept: at its begin it says what it was measured on, at its end of which
/// commit.
const KEPT: usize = 512;

/// A table that is shipped.
struct Table {
    /// Name of the scene, which was measured with its own settings.
    scene: &'static str,
    /// Its `curve.csv`.
    rows: &'static str,
    /// How its `summary.md` begins and ends.
    summary: &'static [[u8; KEPT]; 2],
}

macro_rules! tables {
    ($($scene:literal),+) => {
        [$(Table {
            scene: $scene,
            rows: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/accuracy/", $scene, "/curve.csv")),
            summary: &const {
                ends(include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/accuracy/", $scene, "/summary.md")))
            },
        }),+]
    };
}

static TABLES: [Table; 4] = tables!["dam_break", "hydrostatic", "waterfall", "wind_tunnel"];

/// The first and the last bytes of a text, so that the program does not hold the rest.
const fn ends(text: &[u8]) -> [[u8; KEPT]; 2] {
    let mut ends = [[b' '; KEPT]; 2];
    let mut k = 0;
    while k < KEPT && k < text.len() {
        ends[0][k] = text[k];
        ends[1][KEPT - 1 - k] = text[text.len() - 1 - k];
        k += 1;
    }
    ends
}

/// What is read of a row. Tables that were measured before there was a detail or a true error have no columns for them.
#[derive(Deserialize)]
struct Row {
    preset: Option<String>,
    detail: Option<f64>,
    threads: usize,
    ms: f32,
    error_mean: Option<f32>,
    error_p99: Option<f32>,
    true_error: Option<f32>,
    true_floor: Option<f32>,
    faults: Option<String>,
}

/// The shipped curve of a scene, if it is one that was measured, as it stands in its file and with its own settings.
pub fn curve(blueprint: &Blueprint) -> Option<Curve> {
    let of = fingerprint(blueprint);
    let table = TABLES.iter().find(|table| table.scene == blueprint.name)?;
    let usual = scene::load(table.scene).and_then(|scene| scene.build(&[], None, &EffectModes::new()));
    if usual.ok().is_none_or(|usual| fingerprint(&usual) != of) {
        return None;
    }
    let file = format!("docs/accuracy/{}/curve.csv", table.scene);
    match points(&file, table.rows) {
        Ok((points, floor)) => Some(Curve {
            scene: table.scene.to_owned(),
            of,
            points,
            floor,
            shipped: Some(measured_on(table.summary)),
            ..Curve::default()
        }),
        Err(error) => {
            warn!("{error}");
            None
        }
    }
}

/// What a summary says that it was measured on, which stands before the first semicolon of its first sentence; and of
/// which commit, if that is noted at its end.
fn measured_on([first, last]: &[[u8; KEPT]; 2]) -> String {
    let (first, last) = (String::from_utf8_lossy(first), String::from_utf8_lossy(last));
    let line = first.lines().find(|line| !line.is_empty() && !line.starts_with('#')).unwrap_or_default();
    let on = line.split([';', '.']).next().unwrap_or_default().trim();
    let commit = last.lines().find_map(|line| line.strip_prefix("*Commit ")?.get(..7));
    commit.map_or_else(|| on.to_owned(), |commit| format!("{on}, commit {commit}"))
}

/// The presets in a table, at each detail and on as many threads as those that go by their names, the fastest first;
/// and the floor of the true error. An error names the file, and the line.
fn points(file: &str, text: &str) -> Result<(Vec<CurvePoint>, Option<f32>), String> {
    let fault = |what: &dyn std::fmt::Display| format!("{file}: {what}");
    let mut table = Reader::from_reader(text.as_bytes());
    let columns = table.headers().map_err(|error| fault(&error))?.clone();
    let mut rows: Vec<(Row, StringRecord)> = Vec::new();
    for record in table.records() {
        let record = record.map_err(|error| fault(&error))?;
        let row: Row = record.deserialize(Some(&columns)).map_err(|error| fault(&error))?;
        let line = record.position().map_or(0, csv::Position::line);
        if !(row.ms.is_finite() && row.ms > 0.0) {
            return Err(fault(&format_args!("line {line}: ms is {}; allowed: above 0", row.ms)));
        }
        if let Some(name) = row.preset.as_ref().filter(|name| Preset::find(name).is_none()) {
            let names = Preset::ALL.map(Preset::name).join(", ");
            return Err(fault(&format_args!("line {line}: no preset `{name}`; there are {names}")));
        }
        rows.push((row, record));
    }
    let threads = rows.iter().find(|(row, _)| row.preset.is_some()).map(|(row, _)| row.threads);
    let mut points: Vec<CurvePoint> = Vec::new();
    // What has a name first: another may have the same numbers.
    rows.sort_by_key(|(row, _)| row.preset.is_none());
    for (row, record) in rows.iter().filter(|(row, _)| Some(row.threads) == threads) {
        let named = row.preset.as_deref().and_then(Preset::find);
        let mut candidates = Preset::ALL.into_iter().filter(|preset| named.is_none_or(|named| named == *preset));
        let Some(preset) = candidates.find(|preset| has_numbers_of(*preset, &columns, record)) else { continue };
        let detail = row.detail.unwrap_or(preset.detail());
        if points.iter().any(|point| point.quality == preset.quality() && is_same_detail(point.detail, detail)) {
            continue;
        }
        points.push(CurvePoint {
            preset,
            quality: preset.quality(),
            detail,
            milliseconds: row.ms,
            error: row.error_mean,
            p99: row.error_p99,
            truth: row.true_error,
            is_sound: row.faults.as_ref().is_none_or(String::is_empty),
        });
    }
    points.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
    Ok((points, rows.iter().find_map(|(row, _)| row.true_floor)))
}

/// Whether a row has the numbers of a preset as it is today, as far as the table has columns for them.
fn has_numbers_of(preset: Preset, columns: &StringRecord, record: &StringRecord) -> bool {
    let tuning = Tuning::from(preset.quality());
    let is_so = |name: &str, value: String| {
        let column = columns.iter().position(|column| column == name);
        column.and_then(|column| record.get(column)).is_none_or(|field| field == value)
    };
    let predictor = tuning.quality.predictor.to_string();
    is_so("predictor", predictor) && Knob::of_quality().all(|knob| is_so(knob.name, knob.text(&tuning)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "setting,preset,detail,threads,substeps,iterations,kernel_radius,gradient,predictor,\
                          air_cell,ms,error_mean,error_p99,true_error,true_floor,faults";

    /// A table of these rows.
    fn table(rows: &[&str]) -> Result<(Vec<CurvePoint>, Option<f32>), String> {
        points("a.csv", &format!("{HEADER}\n{}\n", rows.join("\n")))
    }

    fn built(name: &str, settings: &[(&str, &str)], detail: f64) -> Blueprint {
        let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
        scene::load(name).unwrap().at_detail(detail).build(&settings, None, &EffectModes::new()).unwrap()
    }

    // A page has no files.
    #[cfg(not(target_arch = "wasm32"))]
    #[test]
    fn every_table_in_the_documents_is_shipped() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/accuracy");
        for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            let name = entry.file_name().unwrap().to_string_lossy().into_owned();
            let is_shipped = TABLES.iter().any(|table| table.scene == name);
            assert_eq!(entry.join("curve.csv").exists(), is_shipped, "{folder}/{name}");
        }
    }

    #[test]
    fn every_shipped_table_can_be_read_and_says_what_it_was_measured_on() {
        for table in &TABLES {
            let curve = curve(&built(table.scene, &[], 1.0)).expect(table.scene);
            for preset in [Preset::Draft, Preset::Fast, Preset::Balanced, Preset::Fine] {
                let point = curve.point(preset, 1.0);
                assert!(point.is_some_and(|point| point.error.is_some()), "{}: no {}", table.scene, preset.name());
            }
            let told = curve.shipped.unwrap();
            assert!(told.contains("thread") && told.len() < 120, "{}: measured on `{told}`", table.scene);
        }
    }

    #[test]
    fn only_the_scene_as_it_is_shipped_has_the_shipped_curve_at_any_detail() {
        let has = |name, settings: &[(&str, &str)], detail| curve(&built(name, settings, detail)).is_some();
        assert!(has("dam_break", &[], 1.0) && has("dam_break", &[], 0.5));
        assert!(!has("dam_break", &[("columns", "24")], 1.0), "with other settings it is another scene");
        assert!(!has("sealed_air", &[], 1.0), "nobody measured it");
        let text = include_str!("../../../assets/scenes/dam_break.ron").replacen("2 * columns * d", "columns * d", 1);
        let mine = scene::from_text("dam_break", text).unwrap().build(&[], None, &EffectModes::new()).unwrap();
        assert!(curve(&mine).is_none(), "a file of that name is not the scene");
    }

    #[test]
    fn presets_are_known_by_their_numbers_at_every_detail() {
        let (points, floor) = table(&[
            "\"draft, 2 threads\",,1,2,1,1,2.5,rational,true,6,0.3,0.006,0.04,0.045,0.002,",
            "draft,draft,1,1,1,1,2.5,rational,true,6,0.6,0.006,0.04,0.045,0.002,",
            "\"draft, h 2\",,1,1,1,1,2,rational,true,6,0.5,0.006,0.04,0.045,0.002,",
            "fine,fine,1,1,2,4,2.5,rational,true,3,1.5,0.004,0.03,0.046,0.002,energy up by 2.0 %",
            "reference,reference,2,1,2,4,2.5,rational,true,3,6.5,,,0.043,0.002,",
            "\"draft, detail 0.5\",,0.5,1,1,1,2.5,rational,true,6,0.2,0.008,0.05,0.08,0.002,",
            "fast,fast,1,1,9,9,2.5,rational,true,5,1.1,0.005,0.03,0.04,0.002,",
        ])
        .unwrap();
        let found: Vec<_> =
            points.iter().map(|point| (point.preset.name(), point.detail, point.milliseconds)).collect();
        assert_eq!(found, [("draft", 0.5, 0.2), ("draft", 1.0, 0.6), ("fine", 1.0, 1.5), ("reference", 2.0, 6.5)]);
        assert_eq!((points[0].truth, points[3].error, floor), (Some(0.08), None, Some(0.002)));
        assert_eq!(points.iter().map(|point| point.is_sound).collect::<Vec<_>>(), [true, true, false, true]);
    }

    #[test]
    fn a_table_from_before_there_was_a_true_error_has_none() {
        let old = "setting,preset,threads,substeps,iterations,ms,error_mean\nfast,fast,1,1,2,0.7,0.005\n";
        let (points, floor) = points("a.csv", old).unwrap();
        assert_eq!((points.len(), points[0].detail, points[0].truth, floor), (1, 1.0, None, None));
    }

    #[test]
    fn a_broken_table_is_refused_with_its_line() {
        let row = |preset: &str, ms: &str| table(&[&format!("x,{preset},1,1,1,1,2.5,rational,true,6,{ms},,,,,")]);
        for (found, says) in [
            (row("draft", "soon"), "line: 2"),
            (row("draft", "0"), "line 2: ms is 0; allowed: above 0"),
            (row("daft", "1"), "line 2: no preset `daft`; there are classic, draft"),
            (table(&["draft,draft,1"]), "line: 2"),
            (points("a.csv", "setting,preset,ms\ndraft,draft,1\n"), "threads"),
        ] {
            let error = found.unwrap_err();
            assert!(error.starts_with("a.csv: ") && error.contains(says), "`{error}` does not say `{says}`");
            assert_eq!(error.lines().count(), 1);
        }
    }

    #[test]
    fn what_it_was_measured_on_is_what_a_summary_says_first_and_last() {
        let text = "# pool: what accuracy costs\n\nAMD EPYC (family 26), 1 thread; 9 particles. More.\n";
        assert_eq!(measured_on(&ends(text.as_bytes())), "AMD EPYC (family 26), 1 thread");
        let stamped = format!("{text}{}\n*Commit 0123456789; AMD EPYC; today.*\n", "x ".repeat(KEPT));
        assert_eq!(measured_on(&ends(stamped.as_bytes())), "AMD EPYC (family 26), 1 thread, commit 0123456");
        assert_eq!(measured_on(&ends(b"")), "");
    }
}
