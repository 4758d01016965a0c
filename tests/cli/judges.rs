//! What measures and judges: `bench scaling`, `exam`, `gauntlet`.

use crate::{folder, good, refused};
use serde_json::Value;

/// A document without its line breaks.
fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn bench_scaling_writes_table_json_and_curves() {
    let here = folder("scaling");
    std::fs::write(
        here.join("others.json"),
        r#"[{"name": "another program", "figures": [{"particles": 1500, "ms": 9, "error_p99": 0.2}, {"particles": 1e4, "ms": 61}]}]"#,
    )
    .unwrap();
    refused(
        &here,
        &["bench", "scaling", "--quick", "--beside", "others.json"],
        2,
        &["others.json", "10000", "allowed"],
    );
    let good_one = r#"[{"name": "another program", "figures": [{"particles": 1500, "ms": 9, "error_p99": 0.2}]}]"#;
    std::fs::write(here.join("others.json"), good_one).unwrap();
    // The smallest size only.
    let options =
        ["--quick", "--up-to", "1458", "--threads", "2", "--json", "out.json", "--svg", ".", "--beside", "others.json"];
    let table = good(&here, &[&["bench", "scaling"], &options[..]].concat());
    let report: Value = serde_json::from_slice(&std::fs::read(here.join("out.json")).unwrap()).unwrap();
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 6, "the presets and the plain method at its best");
    for row in rows {
        assert_eq!(row["particles"], 1458);
        assert_eq!(row["threads"], serde_json::json!([1, 2]));
        assert_eq!(row["same_hash"], true);
        assert_eq!(row["escaped"], 0);
        assert!(row["ms"].as_array().unwrap().iter().all(|ms| ms.as_f64().unwrap() > 0.0));
        assert!(row["error_p99"].as_f64().unwrap() < 0.5);
        let name = row["setting"].as_str().unwrap();
        assert!(
            table.lines().any(|line| line.split('|').map(str::trim).take(3).eq(["", "1,458", &format!("`{name}`")])),
            "no row of {name} in\n{table}"
        );
    }
    let error = |name: &str| rows.iter().find(|row| row["setting"] == name).unwrap()["error_p99"].as_f64().unwrap();
    assert!(error("fine") < error("draft"), "accuracy is bought");
    if cfg!(feature = "charts") {
        for name in ["scaling-time.svg", "scaling-error.svg", "scaling-threads.svg"] {
            let svg = std::fs::read_to_string(here.join(name)).unwrap();
            assert!(svg.contains("balanced") && svg.trim_end().ends_with("</svg>"), "{name}");
        }
        assert!(std::fs::read_to_string(here.join("scaling-time.svg")).unwrap().contains("another program"));
    }
}

#[test]
fn the_exam_prints_its_rows_and_fails_if_one_does() {
    let here = folder("exam");
    let arguments = ["exam", "--case", "free_fall", "--case", "pulse", "--quality", "draft", "--quality", "balanced"];
    let table = good(&here, &[&arguments[..], &["--json", "rows.json", "--markdown", "rows.md"]].concat());
    assert!(table.contains("| free_fall") && table.contains("| balanced") && table.contains("0 fail"), "{table}");
    let rows: Value = serde_json::from_str(&std::fs::read_to_string(here.join("rows.json")).unwrap()).unwrap();
    let rows = rows["rows"].as_array().unwrap();
    assert_eq!(
        rows.len(),
        table.lines().filter(|line| line.starts_with("| free_fall") || line.starts_with("| pulse")).count()
    );
    for row in rows {
        let [expected, got, error] = ["expected", "got", "error"].map(|key| row[key].as_f64().unwrap());
        let error_of = (got - expected).abs() / if row["relative"] == true { expected.abs() } else { 1.0 };
        assert!((error - error_of).abs() <= 1e-12 && row["milliseconds"].as_f64().unwrap() > 0.0, "{row}");
        assert_eq!(row["verdict"] == "pass", error <= row["tolerance"].as_f64().unwrap(), "{row}");
    }
    let document = std::fs::read_to_string(here.join("rows.md")).unwrap();
    assert!(document.contains("## Free fall (`free_fall`)") && document.contains("**Tolerance:**"), "{document}");
    let command = "`powder-master exam --case free_fall --case pulse --quality draft --quality balanced --json rows.json \
                   --markdown rows.md` writes this file";
    assert!(on_one_line(&document).contains(command), "the command that was given: {document}");
    let json = good(&here, &[&arguments[..], &["--json", "-"]].concat());
    assert!(serde_json::from_str::<Value>(&json).is_ok(), "stdout has the JSON alone: {json}");
}

#[test]
fn cases_run_at_another_detail_and_say_so() {
    let here = folder("case_detail");
    let rows = |arguments: &[&str]| {
        let json: Value = serde_json::from_str(&good(&here, &[arguments, &["--json", "-"]].concat())).unwrap();
        (json["detail"].as_f64().unwrap(), json["rows"].as_array().unwrap().clone())
    };
    let gauntlet = ["gauntlet", "--case", "falling_block", "--quality", "balanced", "--quality", "reference"];
    let (own, finer) = (rows(&gauntlet), rows(&[&gauntlet[..], &["--detail", "2"]].concat()));
    assert_eq!((own.0, finer.0), (1.0, 2.0));
    let particles = |rows: &[Value]| rows.iter().map(|row| row["particles"].as_u64().unwrap()).collect::<Vec<_>>();
    let (own, finer) = (particles(&own.1), particles(&finer.1));
    assert_eq!(finer, own.iter().map(|count| 4 * count).collect::<Vec<_>>(), "four for each");
    assert_eq!(own[1], 4 * own[0], "reference has its own detail on top");
    let exam = ["exam", "--case", "hydrostatic", "--quality", "draft"];
    let (_, own) = rows(&exam);
    let (_, finer) = rows(&[&exam[..], &["--detail", "2"]].concat());
    assert_ne!(own[0]["got"], finer[0]["got"], "another world");
    assert_eq!(own[0]["expected"], finer[0]["expected"], "of the same size");
    let document = good(&here, &[&exam[..], &["--detail", "0.5", "--markdown", "-"]].concat());
    let document = on_one_line(&document);
    assert!(document.contains("--quality draft --detail 0.5 --markdown -` writes this file"), "{document}");
    assert!(document.contains("At detail 0.5: particles 2 times as wide and 0.25 times as many"), "{document}");
    for bad in ["0", "9", "-1", "nan", "two"] {
        refused(&here, &["exam", "--quick", "--detail", bad], 2, &["allowed: numbers from 0.125 to 8"]);
    }
}

#[test]
fn the_gauntlet_prints_its_rows_and_writes_them() {
    let here = folder("gauntlet");
    let arguments =
        ["gauntlet", "--case", "two_at_a_point", "--case", "suction", "--quality", "draft", "--quality", "fast"];
    let table = good(&here, &[&arguments[..], &["--json", "rows.json", "--markdown", "rows.md"]].concat());
    assert!(table.contains("| two_at_a_point") && table.contains("4 runs: 4 pass, 0 known"), "{table}");
    let rows: Value = serde_json::from_str(&std::fs::read_to_string(here.join("rows.json")).unwrap()).unwrap();
    let rows = rows["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for row in rows {
        assert_eq!(row["verdict"], "pass", "{row}");
        assert!(row["broken"].as_array().unwrap().is_empty(), "{row}");
    }
    assert!(rows[2]["clamps"]["air_clamps"].as_u64().unwrap() > 0, "suction is cut at a vacuum: {}", rows[2]);
    let document = std::fs::read_to_string(here.join("rows.md")).unwrap();
    assert!(document.contains("(`suction`)") && document.contains("**Guards against:**"), "{document}");
    let again = good(&here, &["gauntlet", "--quick", "--case", "suction", "--threads", "1", "--markdown", "-"]);
    let command = "`powder-master gauntlet --case suction --threads 1 --markdown - --quick` writes this file";
    assert!(on_one_line(&again).contains(command), "the command that was given: {again}");
    let json = good(&here, &[&arguments[..], &["--json", "-"]].concat());
    assert!(serde_json::from_str::<Value>(&json).is_ok(), "stdout has the JSON alone: {json}");
}
