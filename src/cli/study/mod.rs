//! `study`: experiments that end in a table and pictures.

mod rest_density;
mod truth;

use crate::cli::{
    args::{Study, StudyArguments},
    failure::Failure,
};

/// Runs a study and prints what it found.
pub(super) fn study(arguments: &StudyArguments) -> Result<(), Failure> {
    let StudyArguments { what, out, threads, beside } = arguments;
    let unfit = |option: &str, other: &str| Err(Failure::Usage(format!("{option} is of study {other} only")));
    match what {
        Study::RestDensity if beside.is_some() => unfit("--beside", "truth"),
        Study::Truth if threads.is_some() => unfit("--threads", "rest-density"),
        Study::RestDensity => rest_density::rest_density(*threads, out),
        Study::Truth => truth::truth(out, beside.as_deref()),
    }
}
