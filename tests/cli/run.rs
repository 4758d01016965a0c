//! `run`: its metrics, tables and pictures, and that watching changes nothing.

use crate::{folder, good, metrics, refused};
use powder_master::{kernel::particles::Particles, sim::picture};
use serde_json::Value;

const SMALL: [&str; 8] = ["run", "dam_break", "--set", "columns=8", "--ticks", "45", "--effect", "viscosity=on"];

#[test]
fn metrics_have_all_keys() {
    let here = folder("metrics_keys");
    let found = metrics(&here, &SMALL);
    for (group, keys) in [
        ("", "scene quality threads simd ticks sim_seconds wall_seconds hash memory_bytes"),
        ("/particles", "total by_element"),
        ("/particles/by_element", "rock water"),
        ("/ms_per_tick", "median p95 max"),
        ("/stages/solve", "calls ms_total ms_median unit touched spared ms_saved"),
        ("/effects", "air drag tension viscosity vorticity"),
        ("/effects/viscosity", "mode state active_ticks differing_ticks calls ms_total ms_saved why"),
        ("/accuracy", "density_error_mean density_error_p99 density_error_max residual volume_error energy"),
        (
            "/accuracy",
            "air_mass_drift momentum_drift air_divergence_rms density_mean energy_start energy_peak distance",
        ),
        ("/sampling", "ms_total ms_median"),
        ("/stability", "non_finite escaped speed_clamps position_clamps substeps_max"),
    ] {
        for key in keys.split(' ') {
            assert!(found.pointer(&format!("{group}/{key}")).is_some(), "{group}/{key} is missing");
        }
    }
    assert_eq!(found["scene"], "dam_break");
    assert_eq!(found["quality"], "balanced");
    assert_eq!(found["ticks"], 45);
    assert_eq!(metrics(&here, &[&SMALL[..], &["--simd", "scalar"]].concat())["simd"], "scalar");
    assert_eq!(found["sim_seconds"], 0.75);
    assert_eq!(found["particles"]["total"], 8 * 16);
    assert_eq!(found["hash"].as_str().map(str::len), Some(16));
    assert_eq!(found["accuracy"]["samples"], 2, "ticks 20 and 40");
    assert!(found["accuracy"]["density_error_mean"].is_f64());
    assert_eq!(found["accuracy"]["air_mass_drift"], Value::Null, "the scene has no air");
    assert!(found["sampling"]["ms_median"].as_f64().unwrap() > 0.0, "what measuring costs is shown");
    assert_eq!(found["effects"]["air"]["calls"], 0, "what is off is not called");
    assert_eq!(found["effects"]["air"]["state"], "off");
    assert_eq!(found["effects"]["air"]["ms_saved"], Value::Null, "nobody knows what it would have taken");
    assert_eq!(found["effects"]["viscosity"]["active_ticks"], 45);
}

#[test]
fn warmup_is_left_out_of_times_and_samples_but_not_of_the_run() {
    let here = folder("warmup");
    let whole = metrics(&here, &SMALL);
    let part = metrics(&here, &[&SMALL[..], &["--warmup", "30"]].concat());
    assert_eq!(whole["hash"], part["hash"], "the warm-up is run, too");
    assert_eq!(part["ticks"], 45);
    assert_eq!(part["warmup"], 30);
    assert_eq!(part["accuracy"]["samples"], 1, "tick 40");
    assert_eq!(part["effects"]["viscosity"]["active_ticks"], 15);
    assert_eq!(part["stages"]["measure"]["calls"], 15);
    assert_eq!(whole["stages"]["measure"]["calls"], 45);
    let late = metrics(&here, &[&SMALL[..], &["--warmup", "44"]].concat());
    assert_eq!(late["accuracy"]["samples"], 1, "a run too short for a sample is sampled at its end");
}

#[test]
fn tables_have_their_columns_and_the_picture_is_a_picture() {
    let here = folder("outputs");
    let files = ["--particles", "p.csv", "--trace", "t.csv", "--png", "w.png", "--metrics", "m.json"];
    let said = good(&here, &[&SMALL[..], &files].concat());
    assert!(said.contains("scene=dam_break ticks=45"), "{said}");
    let read = |name: &str| std::fs::read_to_string(here.join(name)).unwrap();
    let numbers = |line: &str, from: usize| -> Vec<f64> {
        line.split(',').skip(from).map(|field| field.parse().unwrap_or_else(|_| panic!("{field} in {line}"))).collect()
    };

    let particles = read("p.csv");
    let mut lines = particles.lines();
    assert_eq!(lines.next(), Some(&*Particles::COLUMNS.join(",")));
    let rows: Vec<&str> = lines.collect();
    assert_eq!(rows.len(), 128);
    let (width, height) = (4.0 * 0.8, 2.1 * 0.8);
    for (id, row) in rows.iter().enumerate() {
        assert!(row.starts_with(&format!("{id},water,")), "in the order of the ids: {row}");
        let values = numbers(row, 2);
        assert!((0.0..=width).contains(&values[0]) && (0.0..=height).contains(&values[1]), "in metres: {row}");
    }

    let trace = read("t.csv");
    let mut lines = trace.lines();
    let header = "tick,seconds,ms,substeps,particles,energy,momentum_x,momentum_y,front_x,surface_y,max_speed,air_mass";
    assert_eq!(lines.next(), Some(header));
    let rows: Vec<Vec<f64>> = lines.map(|line| numbers(line, 0)).collect();
    assert_eq!(rows.len(), 45);
    assert_eq!(rows[44][..2], [45.0, 0.75]);
    assert!(rows.iter().all(|row| row[3] >= 1.0 && row[4] == 128.0));
    assert!(rows[44][8] > rows[0][8] + 0.3, "the front moves on");
    assert!(rows[44][5] < rows[0][5] * 1.02, "the energy does not grow");

    let png = std::fs::read(here.join("w.png")).unwrap();
    assert_eq!(&png[1..4], b"PNG");
    let metrics: Value = serde_json::from_str(&read("m.json")).unwrap();
    assert!(said.contains(metrics["hash"].as_str().unwrap()), "stdout and metrics agree on the hash");
}

#[test]
fn watching_and_threads_never_change_the_world() {
    let here = folder("same_hash");
    let hash = |more: &[&str]| {
        let said = good(&here, &[&SMALL[..], more].concat());
        said.trim_end().rsplit_once("hash=").unwrap().1.to_owned()
    };
    let plain = hash(&[]);
    assert_eq!(hash(&[]), plain, "twice the same");
    assert_eq!(hash(&["--threads", "1"]), plain);
    assert_eq!(hash(&["--threads", "3"]), plain);
    let cores = std::thread::available_parallelism().unwrap().get();
    assert_eq!(hash(&["--threads", &(cores + 2).to_string()]), plain, "two threads more than cores");
    assert_eq!(hash(&["--simd", "auto"]), plain);
    assert_eq!(hash(&["--simd", "scalar"]), plain);
    let watched = hash(
        &[
            ["--metrics", "m.json"],
            ["--trace", "t.csv"],
            ["--png", "w.png"],
            ["--wav", "w.wav"],
            ["--particles", "p.csv"],
            ["--reference", "r.csv"],
            ["--gauge", "0.4,0.3"],
            ["--gauge-line", "1,0,1,1.6"],
            ["--readings", "g.csv"],
        ]
        .concat(),
    );
    assert_eq!(watched, plain);
    assert_ne!(hash(&["--set", "columns=9"]), plain, "another world has another hash");
    assert_ne!(hash(&["--effect", "viscosity=off"]), plain);
}

#[test]
fn the_distance_to_the_reference_is_a_table_over_time() {
    let here = folder("reference");
    let found = metrics(&here, &[&SMALL[..], &["--quality", "draft", "--reference", "r.csv"]].concat());
    let table = std::fs::read_to_string(here.join("r.csv")).unwrap();
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0], ["tick", "seconds", "share", "momentum", "air", "energy_ratio"]);
    assert_eq!(lines[1..].iter().map(|line| line[0]).collect::<Vec<_>>(), ["20", "40", "45"]);
    let shares: Vec<f64> = lines[1..].iter().map(|line| line[2].parse().unwrap()).collect();
    assert!(shares.iter().all(|share| (1e-6..0.5).contains(share)), "{shares:?}");
    assert!(lines[1..].iter().all(|line| line[4].is_empty()), "the scene has no air");
    let mean = shares.iter().sum::<f64>() / 3.0;
    assert!((found["accuracy"]["distance"]["share"].as_f64().unwrap() - mean).abs() < 1e-9);
    let own = metrics(&here, &[&SMALL[..], &["--quality", "reference", "--reference", "r.csv"]].concat());
    assert_eq!(own["accuracy"]["distance"]["momentum"], 0.0, "the reference is no distance from itself");
}

#[test]
fn readings_are_a_table_that_is_the_same_on_any_number_of_threads() {
    let here = folder("readings");
    let gauges =
        ["--gauge", "0.4,0.3", "--gauge", "3,1.5,0.2", "--gauge-line", "1,0,1,1.68", "--gauge-element", "water"];
    let said = good(&here, &[&SMALL[..], &gauges, &["--readings", "one.csv", "--threads", "1"]].concat());
    assert!(said.contains("hash="), "{said}");
    let table = std::fs::read_to_string(here.join("one.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 46, "a head, and a line for each tick");
    let column =
        |name: &str| rows[0].iter().position(|head| *head == name).unwrap_or_else(|| panic!("{name} in {table}"));
    let numbers = |name: &str| -> Vec<Option<f64>> {
        let at = column(name);
        rows[1..].iter().map(|row| (!row[at].is_empty()).then(|| row[at].parse().unwrap())).collect()
    };
    assert_eq!(numbers("tick")[44], Some(45.0));
    assert_eq!(numbers("time_s")[44], Some(0.75));
    assert!(numbers("gauge1_pressure_pa").iter().flatten().count() > 20, "water is there for a while");
    assert!(numbers("gauge2_speed_m_per_s").iter().all(Option::is_none), "nothing comes up there");
    assert!(numbers("gauge2_particles").iter().all(|count| *count == Some(0.0)));
    assert!(numbers("gauge1_air_pressure_pa").iter().all(Option::is_none), "the scene has no air");
    let (flow, water) = (numbers("gauge3_flow_m2_per_s"), numbers("gauge3_water_flow_m2_per_s"));
    assert_eq!(flow, water, "there is nothing else");
    let crossed = numbers("gauge3_crossed")[44].unwrap();
    let volume: f64 = flow.iter().flatten().sum::<f64>() / 60.0;
    assert!(crossed > 10.0 && (volume - crossed * 0.01).abs() < 1e-6, "{crossed} particles are {volume} m²");
    good(&here, &[&SMALL[..], &gauges, &["--readings", "two.csv", "--threads", "3"]].concat());
    assert_eq!(std::fs::read_to_string(here.join("two.csv")).unwrap(), table);
    let said = good(&here, &[&SMALL[..], &gauges, &["--readings", "-"]].concat());
    assert_eq!(said, table, "stdout has the table and nothing else");
}

/// Two small settings of a small scene, twice each.

#[test]
fn an_error_is_held_the_same_way_each_time_and_a_time_says_how_it_went() {
    let here = folder("hold");
    let run = |arguments: &[&str]| {
        let text = good(&here, &[&["run", "dam_break", "--set", "columns=16", "--ticks", "150"], arguments].concat());
        let field = |name: &str| {
            let value = text.split_whitespace().find_map(|field| field.strip_prefix(name)).map(str::to_owned);
            value.unwrap_or_else(|| panic!("no {name} in {text}"))
        };
        (field("hash="), field("held="), field("moves=").parse::<u32>().unwrap())
    };
    let (hash, held, moves) = run(&["--hold-error", "0.0001"]);
    assert!(moves > 0, "a bound this tight calls for another quality; held={held}");
    assert_eq!(run(&["--hold-error", "0.0001"]).0, hash, "nothing of it depends on the machine");
    assert_eq!(run(&["--hold-ms", "0.01"]).1, "no", "no machine is as fast as that");
}

#[test]
fn an_error_is_held_in_the_waterfall_without_swinging_between_qualities() {
    let here = folder("hold_waterfall");
    let text = good(&here, &["run", "waterfall", "--seconds", "15", "--hold-error", "0.6"]);
    let moves = text.split_whitespace().find_map(|field| field.strip_prefix("moves="));
    let moves: u32 = moves.unwrap_or_else(|| panic!("no moves in {text}")).parse().unwrap();
    assert!(moves <= 4, "one quality does for all of it, but it moved {moves} times: {text}");
    assert!(text.contains("held=yes"), "{text}");
}

#[test]
fn detail_multiplies_particles_by_its_square_and_is_in_the_metrics() {
    let here = folder("detail");
    let block = ["--set", "columns=20"];
    let of = |more: &[&str]| {
        let metrics = metrics(&here, &[&["run", "dam_break", "--ticks", "3"], &block[..], more].concat());
        (metrics["detail"].as_f64().unwrap(), metrics["particles"]["total"].as_u64().unwrap())
    };
    assert_eq!(of(&[]), (1.0, 800));
    assert_eq!(of(&["--detail", "2"]), (2.0, 3200));
    assert_eq!(of(&["--detail", "0.5"]), (0.5, 200));
    assert_eq!(of(&["--quality", "reference"]), (2.0, 3200));
    assert_eq!(of(&["--quality", "reference", "--detail", "0.5"]), (1.0, 800));
    // The particles of a saved world are split or merged.
    good(
        &here,
        &["run", "dam_break", "--set", "columns=20", "--detail", "2", "--ticks", "20", "--snapshot", "fine.pms"],
    );
    let saved = |more: &[&str]| {
        let metrics = metrics(&here, &[&["run", "fine.pms", "--ticks", "3"], more].concat());
        (metrics["detail"].as_f64().unwrap(), metrics["particles"]["total"].as_u64().unwrap())
    };
    assert_eq!(saved(&[]), (2.0, 3200));
    assert_eq!(saved(&["--detail", "1"]), (1.0, 800));
    assert_eq!(saved(&["--quality", "reference", "--detail", "1"]), (2.0, 3200));
}

#[test]
fn a_picture_that_carries_its_world_stands_where_a_save_file_may() {
    let here = folder("shared");
    good(&here, &["run", "volcano", "--ticks", "20", "--snapshot", "here.pms"]);
    let save = std::fs::read(here.join("here.pms")).unwrap();
    let shared = picture::encode(2, 2, &[90; 12], &save).unwrap();
    std::fs::write(here.join("here.png"), &shared).unwrap();
    let on = |file: &str| metrics(&here, &["run", file, "--ticks", "10"])["hash"].clone();
    assert_eq!(on("here.png"), on("here.pms"));
    std::fs::write(here.join("half.png"), &shared[..shared.len() / 2]).unwrap();
    refused(&here, &["run", "half.png"], 2, &["half.png: the picture is damaged: it breaks off"]);
    good(&here, &["run", "dam_break", "--set", "columns=8", "--ticks", "1", "--png", "bare.png"]);
    refused(&here, &["run", "bare.png"], 2, &["bare.png: a picture without a world"]);
}

#[test]
fn the_sound_of_a_run_is_as_long_as_it_and_the_same_on_any_number_of_threads() {
    let here = folder("sound");
    let heard = |name: &str, more: &[&str]| {
        good(&here, &[&SMALL[..], &["--wav", name], more].concat());
        std::fs::read(here.join(name)).unwrap()
    };
    let wav = heard("one.wav", &["--threads", "1"]);
    let number = |at: usize| u32::from_le_bytes(wav[at..at + 4].try_into().unwrap());
    assert_eq!((&wav[..4], &wav[8..16], number(24)), (&b"RIFF"[..], &b"WAVEfmt "[..], 48_000));
    assert_eq!(number(40), 45 * 800 * 4, "45 ticks of 800 frames of two samples");
    assert_eq!(wav.len(), 44 + number(40) as usize);
    let peak = wav[44..].chunks_exact(2).map(|pair| i16::from_le_bytes([pair[0], pair[1]]).unsigned_abs()).max();
    // −1 dB of full scale is 29,204.
    assert!((1000..=29_204).contains(&peak.unwrap()), "{peak:?}");
    assert!(
        heard("two.wav", &["--threads", "2", "--simd", "scalar"]) == wav,
        "another number of threads sounds otherwise"
    );
}
