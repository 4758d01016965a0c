//! The element table out of `assets/elements.ron`.

use crate::{
    kernel::{
        decay::table::{DecayFault, DecayTable},
        element::{Element, ElementNumber, ElementTable},
        fracture::table::{FractureFault, FractureTable},
        heat::table::{CurveFault, curves},
        reactions::table::{ReactionTable, TouchFault},
    },
    scene::{builtin::ELEMENTS, error::SceneError, file::parse},
};
use std::sync::Arc;

/// Name of the file in errors.
const FILE: &str = "assets/elements.ron";

/// What a scene writes to clear a shape, so no element may be called that.
pub(super) const NONE: &str = "none";

/// All elements.
pub fn elements() -> Result<Arc<ElementTable>, SceneError> {
    table(ELEMENTS.as_bytes()).map(Arc::new)
}

pub(super) fn table(bytes: &[u8]) -> Result<ElementTable, SceneError> {
    let rows: Vec<Element> = parse(FILE, bytes)?;
    let most = ElementTable::MOST;
    if rows.len() > most {
        return Err(SceneError::file(FILE, format!("{} elements; allowed: at most {most}", rows.len())));
    }
    check(&rows)
        .map_err(|Fault { row, field, what }| SceneError::value(FILE, format_args!("[{row}].{field}"), what))?;
    for fixed in [true, false] {
        if rows.iter().all(|row| row.fixed != fixed) {
            return Err(SceneError::file(FILE, format!("no element with `fixed: {fixed}`; allowed: at least one")));
        }
    }
    Ok(ElementTable::new(rows))
}

/// What is wrong with a row.
pub(crate) struct Fault {
    /// Index of the row.
    pub row: usize,
    /// Field.
    pub field: &'static str,
    /// What it is, and what is allowed.
    pub what: String,
}

/// Checks every row by itself and beside those before it.
pub(crate) fn check(rows: &[Element]) -> Result<(), Fault> {
    for (i, row) in rows.iter().enumerate() {
        check_row(row, &rows[..i]).map_err(|(field, what)| Fault { row: i, field, what })?;
    }
    curves(rows).map_err(|CurveFault { row, what }| Fault { row, field: "changes", what })?;
    ReactionTable::of_rows(rows, 1.0).map_err(|TouchFault { row, what }| Fault { row, field: "touches", what })?;
    DecayTable::of_rows(rows, 1.0).map_err(|DecayFault { row, what }| Fault { row, field: "decays", what })?;
    FractureTable::of_rows(rows).map_err(|FractureFault { row, what }| Fault { row, field: "breaks", what })?;
    Ok(())
}

fn check_row(row: &Element, before: &[Element]) -> Result<(), (&'static str, String)> {
    let word = row.name.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_');
    if row.name.is_empty() || row.name.len() > 32 || !word || row.name == NONE {
        let what = format!(
            "`{}`; allowed: 1 to 32 lower-case letters, digits and `_`, but not `{NONE}`",
            row.name.escape_debug()
        );
        return Err(("name", what));
    }
    if before.iter().any(|other| other.name == row.name) {
        return Err(("name", format!("`{}` is taken; allowed: a name for each element", row.name)));
    }
    if let Some(key) = row.key {
        if !key.is_ascii_digit() {
            return Err(("key", format!("`{}`; allowed: '0' to '9', or none", key.escape_debug())));
        }
        if before.iter().any(|other| other.key == row.key) {
            return Err(("key", format!("`{key}` is taken; allowed: a key of its own, or none")));
        }
    }
    for ElementNumber { name, value, min, max } in row.numbers() {
        if !(min..=max).contains(&value) {
            let allowed =
                if min == f32::MIN_POSITIVE { "above 0, at most 1".to_owned() } else { format!("{min} to {max}") };
            return Err((name, format!("{value} is out of range; allowed: {allowed}")));
        }
    }
    if row.diffusion > 0.0 && !row.is_gas() {
        return Err(("diffusion", format!("{} of what is no gas; allowed: 0", row.diffusion)));
    }
    if row.cohesion > 0.0 && row.friction == 0.0 {
        return Err(("cohesion", format!("{} without friction; allowed: 0 for what is no powder", row.cohesion)));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROCK: &str = "(name: \"rock\", category: solids, key: '1', colour: (1, 2, 3), fixed: true, density: 2500)";
    const WATER: &str =
        "(name: \"water\", category: liquids, key: '2', colour: (1, 2, 3), fixed: false, density: 1000)";

    fn error(text: &str) -> String {
        table(text.as_bytes()).expect_err(text).to_string()
    }

    #[test]
    fn water_falls_through_still_air_at_a_speed_of_raindrops() {
        let table = elements().expect("the built-in table");
        let water = table.get(table.find("water").expect("water"));
        // dv/dt = g − C v²/(ρ d²) = 0 at d = 0.1 m.
        let terminal = (9.81 * water.density * 0.01 / water.drag).sqrt();
        assert!((12.0..20.0).contains(&terminal), "{terminal} m/s");
    }

    #[test]
    fn faults_say_where_and_what_is_allowed() {
        let with = |from: &str, to: &str| format!("[{ROCK}, {}]", WATER.replace(from, to));
        assert!(table(with("", "").as_bytes()).is_ok());
        for (text, expected) in [
            (with("water", "rock"), "assets/elements.ron: [1].name: `rock` is taken"),
            (with("'2'", "'1'"), "[1].key: `1` is taken"),
            (with("'2'", "'x'"), "[1].key: `x`; allowed: '0' to '9', or none"),
            (with("liquids", "liquid"), "assets/elements.ron:1:"),
            (with("1000", "0"), "[1].density: 0 is out of range; allowed: 0.05 to 100000"),
            (with("1000", "NaN"), "[1].density"),
            (
                with("1000)", "1000, cohesion: 10)"),
                "[1].cohesion: 10 without friction; allowed: 0 for what is no powder",
            ),
            (with("1000)", "1000, diffusion: 0.1)"), "[1].diffusion: 0.1 of what is no gas; allowed: 0"),
            (
                with("1000)", "1000, breaks: (above: 1e5, into: \"rock\"))"),
                "[1].breaks: of `water`, which moves; allowed: only of what is fixed",
            ),
            (with("1000)", "1000, flow: 0)"), "[1].flow: 0 is out of range; allowed: above 0, at most 1"),
            (with("water", "none"), "[1].name"),
            (with("false", "true"), "no element with `fixed: false`"),
            (with("1000)", "1000, colr: 3)"), "assets/elements.ron:1:"),
            (String::new(), "assets/elements.ron: the file is empty"),
        ] {
            assert!(error(&text).contains(expected), "{}", error(&text));
        }
    }

    #[test]
    fn a_table_may_have_as_many_rows_as_there_are_ids() {
        let rows = |count: usize| {
            let rows: Vec<String> =
                (1..count).map(|row| WATER.replace("water", &format!("w{row}")).replace("'2'", "None")).collect();
            format!("[{ROCK}, {}]", rows.join(","))
        };
        assert_eq!(table(rows(255).as_bytes()).map(|table| table.len()).map_err(|error| error.to_string()), Ok(255));
        assert!(error(&rows(256)).contains("256 elements; allowed: at most 255"));
    }
}
