//! A fault in a file or a setting is one line that says where, what is wrong and what is allowed.

use super::{build, read, scene, settings};
use crate::scene::{effects::EffectModes, load};

fn error(text: &str) -> String {
    let error = build(text).err().map(|error| error.to_string());
    let error = error.unwrap_or_else(|| panic!("no fault found in {text}"));
    assert!(!error.contains('\n'), "{error}");
    error
}

/// The fault of a scene with these fields starts with `test.ron` and contains what is expected.
fn check(fields: &str, expected: &str) {
    let found = error(&scene(fields));
    assert!(
        found.starts_with("test.ron:") && found.contains(expected),
        "{fields}\n  gives    {found}\n  expected {expected}"
    );
}

#[test]
fn malformed_text_says_line_and_column() {
    for (text, expected) in [
        (
            "(\n  title: \"x\",\n  spacing: 0.5\n  size: (5, 4),\n)",
            "test.ron:4:3: expected a comma or the closing bracket",
        ),
        ("(\n  title: \"x\",\n  spasing: 0.5,\n)", "test.ron:3:3: Unexpected field named `spasing`"),
        ("(title: \"x\", spacing: \"2 * (\", size: (5, 4))", "character 6: expected a number"),
        ("(title: \"x\", spacing: true, size: (5, 4))", "a number or an expression in quotes"),
        ("(title: \"x\", spacing: 1)", "missing field named `size`"),
        ("(title: \"x\", spacing: 1, size: (5, 4)", "test.ron:1:38: the text ends too early"),
        ("[", "test.ron:1:1: Expected opening `(`"),
        ("(\n  title: \"x", "test.ron:2:10: Expected end of string"),
        (" \n ", "test.ron: the file is empty; allowed: "),
    ] {
        assert!(error(text).contains(expected), "{}", error(text));
    }
    let whole = scene("contents: [(element: \"water\", shape: Disc(centre: (1, 1), radius: 1))]");
    for half in 0..whole.len() {
        assert!(read(&whole.as_bytes()[..half]).is_err(), "{}", &whole[..half]);
    }
    check("contents: [(element: \"water\", shape: Blob(radius: 1))]", "test.ron:2:38: Unexpected variant named `Blob`");
    check("effects: {air: maybe}", "one of `auto`, `on`, or `off`");
    check("effects: {gravity: on}", "`vorticity`");
    check("quality: (preset: best)", "`reference`");
    check("category: watery", "Unexpected variant named `watery`");
    check("category: watery", "`proofs`");
    check("moment: 61", "moment: 61 is out of range; allowed: 0 to 60");
    check(&format!("invitation: \"{}\"", "x".repeat(61)), "invitation: allowed: at most 60 characters");
    check("quality: (sub_steps: 3)", "`substeps`");
    assert!(error(&"(".repeat(100_000)).starts_with("test.ron:1:"));
    assert!(error(&scene(&format!("contents: {}", "[".repeat(100_000)))).starts_with("test.ron:2:"));
}

#[test]
fn values_out_of_range_say_which_and_what_is_allowed() {
    let water = |shape: &str| {
        format!(
            "contents: [(element: \"rock\", shape: Disc(centre: (1, 1), radius: 1)), (element: \"water\", shape: {shape})]"
        )
    };
    check(
        &water("Disc(centre: (1, 1), radius: 0)"),
        "contents[1].disc.radius: 0 is out of range; allowed: 0.000001 to",
    );
    check(&water("Disc(centre: (1, NaN), radius: 1)"), "contents[1].disc.centre.y: NaN isn't finite");
    check(&water("Disc(centre: (1, inf), radius: 1)"), "contents[1].disc.centre.y: inf isn't finite");
    check(
        &water("Rect(min: (1, 1), max: (2, 1))"),
        "contents[1].rect.max: (2, 1) isn't beyond min; allowed: above 1 and 1",
    );
    check(&water("Polygon(points: [(0, 0), (1, 1)])"), "contents[1].polygon.points: 2 points; allowed: 3 to 1000");
    check(
        &water("Polygon(points: [(0, 0), (1, 1), (0, 1e9)])"),
        "contents[1].polygon.points[2].y: 1000000000 is out of range",
    );
    check(&water("Line(from: (0, 0), to: (1, 1), width: \"-d\")"), "contents[1].line.width: -0.5 is out of range");
    check("gravity: (0, -9999)", "gravity.y: -9999 is out of range; allowed: -1000 to 1000");
    check("sound_speed: 0", "sound_speed: 0 is out of range; allowed: 1 to 400");
    check("fluid: (rest_density: 101)", "fluid.rest_density: 101 is out of range; allowed: 0.1 to 100");
    check(
        "quality: (substeps: 2.5)",
        "quality.substeps: 2.5 isn't a whole number; allowed: a whole number from 1 to 64",
    );
    check("particle_limit: 0", "particle_limit: 0 is out of range");
    check(
        "pressures: [(min: (1, 1), max: (2, 2), pressure: 0)]",
        "pressures[0].pressure: 0 is out of range; allowed: 0.1 to 10",
    );
    for kelvin in ["0", "4001"] {
        check(
            &format!("pressures: [(min: (1, 1), max: (2, 2), pressure: 1, temperature: {kelvin})]"),
            &format!("pressures[0].temperature: {kelvin} is out of range; allowed: 1 to 4000"),
        );
    }
    check(
        "winds: [(min: (1, 1), max: (2, 2), velocity: (301, 0), rate: 1)]",
        "winds[0].velocity.x: 301 is out of range",
    );
    check("drains: [(min: (6, 1), max: (7, 2))]", "drains[0]: outside the box; allowed: between (0, 0) and (5, 4)");
    check("drains: [(min: (1, 1), max: (7, \"1e308 * 10\"))]", "drains[0].max.y: the expression has no finite value");
    assert!(error("(title: \"\", spacing: 1, size: (5, 5))").contains("title: allowed: 1 to 60 characters"));
}

/// A short file that asks for more than a tick, or the start, can take in bounded time.
#[test]
fn flows_that_cover_too_much_are_refused() {
    let large = |fields: String| format!("(title: \"Large\", spacing: 0.001, size: (8, 8), {fields})");
    let many = |entry: &str, count: usize| vec![entry; count].join(", ");
    let area = "min: (0, 0), max: (8, 8)";
    for (list, entry, most, fault) in [
        ("emitters", format!("(element: \"water\", {area}, rate: 9)"), 1, "emitters: they cover 128000000 cells"),
        ("winds", format!("({area}, velocity: (1, 0), rate: 9)"), 1, "winds: they cover 128000000 cells"),
        ("pressures", format!("({area}, pressure: 2)"), 15, "pressures: they cover 1024000000 cells"),
    ] {
        assert!(build(&large(format!("{list}: [{}]", many(&entry, most)))).is_ok(), "{list}");
        let error = error(&large(format!("{list}: [{}]", many(&entry, most + 1))));
        assert!(error.contains(fault) && error.contains("; allowed: at most "), "{error}");
    }
}

#[test]
fn unknown_elements_are_named_with_the_known_ones() {
    let fault = "contents[0].element: no element `watr`; did you mean `water`? allowed: rock, water, ";
    check("contents: [(element: \"watr\", shape: Disc(centre: (1, 1), radius: 1))]", fault);
    let flow = "min: (1, 1), max: (2, 2), rate: 9";
    check(
        &format!("emitters: [(element: \"rock\", {flow})]"),
        "emitters[0].element: no movable element `rock`; allowed: water",
    );
    check("emitters: [(element: \"water\", min: (1, 1), max: (1.2, 2), rate: 9)]", "emitters[0]: too small");
    check("first_element: \"magma\"", "first_element: no element `magma`; allowed: rock, water");
    check(
        "contents: [(element: \"rock\", shape: Disc(centre: (1, 1), radius: 1), velocity: (1, 0))]",
        "contents[0].velocity: `rock` doesn't move; allowed: (0, 0)",
    );
}

#[test]
fn what_is_to_be_warmer_than_its_element_can_be_is_refused() {
    let water = |kelvin: &str| {
        format!("contents: [(element: \"water\", shape: Disc(centre: (1, 1), radius: 1), temperature: {kelvin})]")
    };
    check(&water("3000"), "contents[0].temperature: 3000 is out of range; allowed: 273 to 373");
    check(&water("-1"), "contents[0].temperature: -1 is out of range; allowed: 273 to 373");
    check(&water("\"1/0\""), "contents[0].temperature");
}

#[test]
fn parameters_and_expressions_are_checked() {
    let with = |name: &str, numbers: &str, more: &str| {
        format!("parameters: {{\"{name}\": ({numbers}, description: \"\")}}, {more}")
    };
    let good = "default: 2, min: 0, max: 9";
    check(
        &with("columns", good, "sound_speed: \"colums\""),
        "sound_speed: no parameter `colums`; did you mean `columns`? allowed: columns, d",
    );
    check(&with("n", good, "sound_speed: \"1 / (n - 2)\""), "sound_speed: the expression divides by zero");
    check(&with("substeps", good, ""), "parameters.substeps: the name has a meaning already");
    check(&with("d", good, ""), "parameters.d: the name has a meaning already");
    check(&with("1n", good, ""), "parameters.1n: not a name");
    check(&with("n", "default: 2, min: 3, max: 9", ""), "parameters.n: default 2 is out of range; allowed: 3 to 9");
    check(&with("n", "default: NaN, min: 3, max: 9", ""), "parameters.n: default NaN isn't finite");
    check(&with("n", "default: 2, min: 9, max: 3", ""), "parameters.n: min 9 and max 3");
    let error = error("(title: \"x\", spacing: \"d\", size: (5, 4))");
    assert_eq!(error, "test.ron: spacing: no parameter `d`; allowed: none");
}

#[test]
fn worlds_too_large_are_refused_before_they_take_memory() {
    let large = |spacing: &str, size: &str| error(&format!("(title: \"x\", spacing: {spacing}, size: {size})"));
    assert!(
        large("0.001", "(20, 20)").contains("size: 20000 × 20000 cells of 0.001 m; allowed: at most 64000000 cells")
    );
    assert!(
        large("0.001", "(1e9, 1)")
            .contains("size.x: in spacings of 0.001 m, 1000000000000 is out of range; allowed: 4 to 32768")
    );
    assert!(large("1", "(5, 3)").contains("size.y: in spacings of 1 m, 3 is out of range"));
    assert!(large("0", "(5, 3)").contains("spacing: 0 is out of range; allowed: 0.001 to 100"));
    let rock = "contents: [(element: \"rock\", shape: Rect(min: (0, 0), max: (5, 4)))], particle_limit: ";
    assert!(build(&scene(&format!("{rock}80"))).is_ok());
    check(&format!("{rock}79"), "contents: 80 particles, but particle_limit is 79; allowed: fewer particles");
    let many = "(element: \"rock\", shape: Rect(min: (0, 0), max: (20, 2))),".repeat(100);
    let work = format!("(title: \"x\", spacing: 0.001, size: (20, 2), contents: [{many}])");
    assert!(error(&work).contains("too many large shapes"));
}

#[test]
fn settings_say_what_is_allowed() {
    let file = load("dam_break").expect("a scene");
    let fault = |key: &str, value: &str| {
        let result = file.build(&settings(&[(key, value)]), None, &EffectModes::new());
        result.expect_err("a fault").to_string()
    };
    let at = "assets/scenes/dam_break.ron: --set";
    assert_eq!(
        fault("columns", "1"),
        format!("{at} columns=1: 1 is out of range; allowed: a whole number from 2 to 2000")
    );
    assert_eq!(
        fault("columns", "many"),
        format!("{at} columns=many: `many` isn't a number; allowed: a whole number from 2 to 2000")
    );
    assert_eq!(
        fault("columns", "7.5"),
        format!("{at} columns=7.5: 7.5 isn't a whole number; allowed: a whole number from 2 to 2000")
    );
    assert_eq!(fault("air_cell", "NaN"), format!("{at} air_cell=NaN: NaN isn't finite; allowed: 1 to 32"));
    assert_eq!(
        fault("gradient", "spikey"),
        format!("{at} gradient=spikey: did you mean `spiky`? allowed: spiky, rational")
    );
    let unknown = fault("substep", "3");
    assert!(
        unknown.starts_with(&format!(
            "{at} substep=3: no parameter or knob `substep`; did you mean `substeps`? allowed: columns, substeps,"
        )),
        "{unknown}"
    );
    assert!(fault("columns", "2000").contains("8000000 particles, but particle_limit is 4000000"));
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn files_that_cannot_be_read_say_why() {
    let fault = |name: &str| load(name).expect_err(name).to_string();
    assert!(
        fault("waterfal").starts_with("waterfal: no such scene; did you mean `waterfall`? allowed: waterfall, acid,")
    );
    assert_eq!(fault("no/such.ron"), "no/such.ron: no such file");
    let folder = std::env::temp_dir().join(format!("powder-master-faults-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("folder.ron")).expect("a folder");
    let path = |name: &str| folder.join(name).to_str().expect("a plain path").to_owned();
    assert!(fault(&path("folder.ron")).ends_with("folder.ron: a folder; allowed: a file"));
    std::fs::write(folder.join("bad.ron"), b"(\ntitle: \"\xff\")").expect("a file");
    assert!(fault(&path("bad.ron")).ends_with("bad.ron:2:9: not UTF-8; allowed: a RON text in UTF-8"));
    std::fs::write(folder.join("none.ron"), b"").expect("a file");
    assert!(fault(&path("none.ron")).contains("none.ron: the file is empty; allowed: "));
    std::fs::remove_dir_all(folder).expect("the folder");
}
