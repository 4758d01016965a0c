//! `bench`: tables of what things cost.

mod effects;
mod neighbours;
mod scaling;

use crate::cli::{
    args::{Bench, BenchArguments},
    failure::Failure,
};

/// Measures a table and prints it.
pub(super) fn bench(arguments: &BenchArguments) -> Result<(), Failure> {
    match arguments.what {
        Bench::Effects => effects::effects(arguments),
        Bench::Neighbours => neighbours::neighbours(arguments),
        Bench::Scaling => scaling::scaling(arguments),
    }
}

/// A count with commas between the thousands.
fn thousands(count: f64) -> String {
    let digits = format!("{count:.0}");
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A row of a Markdown table.
fn row(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}
