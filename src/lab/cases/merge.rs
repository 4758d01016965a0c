//! Rows that were written as JSON, read again: those of the shards of a run become the rows of the run.

use crate::{
    kernel::params::Preset,
    lab::cases::{
        case::Case,
        job::jobs,
        row::{Figures, Row, Verdict},
    },
};
use serde::{Deserialize, de::DeserializeOwned};
use serde_json::Value;

/// The rows that `values` are the JSON of, in the order in which a run at these qualities and this detail gives them.
///
/// # Errors
/// Which is no row of such a run.
pub fn read_rows<C: Case>(values: Vec<Value>, presets: &[Preset], detail: f64) -> Result<Vec<Row<C::Figures>>, String> {
    let jobs = jobs((C::SUITE.cases)(), |_| true, presets, detail);
    let read = |value: Value| {
        let (case, setting): (String, String) = (field(&value, "case")?, field(&value, C::Figures::SETTING)?);
        let place = jobs.iter().position(|job| job.case.about().name == case && job.setting.name == setting);
        let place = place.ok_or_else(|| format!("{case} at {setting} is no run of `{}`", C::SUITE.command))?;
        let (about, job) = (jobs[place].case.about(), &jobs[place]);
        let verdict: Verdict = field(&value, "verdict")?;
        let figures = C::Figures::deserialize(value).map_err(|error| format!("{case} at {setting}: {error}"))?;
        let preset = job.setting.preset;
        Ok((place, Row { case: about.name, title: about.title, setting, preset, verdict, figures }))
    };
    let mut rows: Vec<(usize, Row<C::Figures>)> = values.into_iter().map(read).collect::<Result<_, String>>()?;
    // Rows of one job came together, and stay so.
    rows.sort_by_key(|(place, _)| *place);
    Ok(rows.into_iter().map(|(_, row)| row).collect())
}

/// A field of a JSON object.
fn field<T: DeserializeOwned>(value: &Value, name: &str) -> Result<T, String> {
    let field = value.get(name).ok_or_else(|| format!("a row lacks `{name}`"))?;
    T::deserialize(field).map_err(|error| format!("`{name}` of a row: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{cases::run_all, gauntlet::GauntletCase};

    #[test]
    fn rows_come_back_as_they_were_in_the_order_of_the_run() {
        let presets = [Preset::Draft, Preset::Fast];
        let wanted = |case: &GauntletCase| ["suction", "two_at_a_point"].contains(&case.about().name);
        let jobs = jobs((GauntletCase::SUITE.cases)(), wanted, &presets, 1.0);
        let rows = run_all(&jobs, 1, |_, _| {}).unwrap();
        assert_eq!(rows.len(), 4);
        let mut values: Vec<Value> =
            rows.iter().map(|row| serde_json::from_str(&serde_json::to_string(row).unwrap()).unwrap()).collect();
        values.reverse();
        assert_eq!(read_rows::<GauntletCase>(values.clone(), &presets, 1.0), Ok(rows));
        let says = |values: Vec<Value>| read_rows::<GauntletCase>(values, &[Preset::Fine], 1.0).unwrap_err();
        assert!(says(values).contains("is no run of `gauntlet`"), "at other qualities");
        assert!(says(vec![Value::Null]).contains("lacks `case`"));
    }
}
