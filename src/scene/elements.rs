//! The element table out of `assets/elements.ron`.

use crate::{
    kernel::element::{Element, ElementTable},
    scene::{builtin::ELEMENTS, error::SceneError, file::parse, number::Range},
};
use std::sync::Arc;

/// Name of the file in errors.
const FILE: &str = "assets/elements.ron";

/// Most elements: an id is one byte, and the rock grid keeps 255 for "no rock".
const MOST: usize = 255;

/// What a scene writes to clear a shape, so no element may be called that.
pub(super) const NONE: &str = "none";

/// All elements.
pub fn elements() -> Result<Arc<ElementTable>, SceneError> {
    table(ELEMENTS.as_bytes()).map(Arc::new)
}

pub(super) fn table(bytes: &[u8]) -> Result<ElementTable, SceneError> {
    let rows: Vec<Element> = parse(FILE, bytes)?;
    if rows.len() > MOST {
        return Err(SceneError::file(FILE, format!("{} elements; allowed: at most {MOST}", rows.len())));
    }
    for (i, row) in rows.iter().enumerate() {
        check(i, row, &rows[..i])?;
    }
    for fixed in [true, false] {
        if rows.iter().all(|row| row.fixed != fixed) {
            return Err(SceneError::file(FILE, format!("no element with `fixed: {fixed}`; allowed: at least one")));
        }
    }
    Ok(ElementTable::new(rows))
}

fn check(i: usize, row: &Element, before: &[Element]) -> Result<(), SceneError> {
    let fault = |field: &str, what: String| Err(SceneError::value(FILE, format_args!("[{i}].{field}"), what));
    let word = row.name.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_');
    if row.name.is_empty() || row.name.len() > 32 || !word || row.name == NONE {
        let what = format!("`{}`; allowed: 1 to 32 lower-case letters, digits and `_`, but not `{NONE}`", row.name);
        return fault("name", what);
    }
    if before.iter().any(|other| other.name == row.name) {
        return fault("name", format!("`{}` is taken; allowed: a name for each element", row.name));
    }
    if !row.key.is_ascii_digit() {
        return fault("key", format!("`{}`; allowed: '0' to '9'", row.key));
    }
    if before.iter().any(|other| other.key == row.key) {
        return fault("key", format!("`{}` is taken; allowed: a key for each element", row.key));
    }
    for (field, value, min, max) in [
        ("density", row.density, 1.0, 100_000.0),
        ("viscosity", row.viscosity, 0.0, 0.5),
        ("vorticity", row.vorticity, 0.0, 1.0),
        ("drag", row.drag, 0.0, 1000.0),
        ("flow", row.flow, f64::from(f32::MIN_POSITIVE), 1.0),
    ] {
        if Range::real(min, max).check(f64::from(value)).is_err() {
            let above = if field == "flow" { "above 0, at most 1".to_owned() } else { format!("{min} to {max}") };
            return fault(field, format!("{value} is out of range; allowed: {above}"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROCK: &str = "(name: \"rock\", key: '1', colour: (1, 2, 3), fixed: true, density: 2500)";
    const WATER: &str = "(name: \"water\", key: '2', colour: (1, 2, 3), fixed: false, density: 1000)";

    fn error(text: &str) -> String {
        table(text.as_bytes()).expect_err(text).to_string()
    }

    #[test]
    fn the_built_in_table_has_rock_and_water() {
        let table = elements().expect("the built-in table");
        let rock = table.get(table.find("rock").expect("rock"));
        let water = table.get(table.find("water").expect("water"));
        assert!(rock.fixed && rock.key == '1');
        assert!(!water.fixed && water.key == '2' && water.density == 1000.0);
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
            (with("'2'", "'x'"), "[1].key: `x`; allowed: '0' to '9'"),
            (with("1000", "0"), "[1].density: 0 is out of range; allowed: 1 to 100000"),
            (with("1000", "NaN"), "[1].density"),
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
    fn more_rows_than_ids_are_an_error() {
        let rows = vec![WATER; 256].join(",");
        assert!(error(&format!("[{rows}]")).contains("256 elements; allowed: at most 255"));
    }
}
