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

/// A row of a Markdown table.
fn row(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}
