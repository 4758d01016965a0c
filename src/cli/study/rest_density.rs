//! `study rest-density`.

use crate::{
    cli::{failure::Failure, output, progress, threads},
    lab::{
        markdown,
        picture::Picture,
        rest_density::{self, OBSERVED_FOR, Outcome, PRESETS, RATIOS, SETTLED_AFTER},
    },
    sim::workers::Workers,
};
use std::path::Path;

/// Gap between the pictures of a study, pixels.
const GAP: u32 = 12;

/// Runs the study and prints what it found.
pub(super) fn rest_density(threads: Option<u64>, folder: &Path) -> Result<(), Failure> {
    let path = folder.join("rest-density.png");
    output::check(&[&path])?;
    threads::start(threads)?;
    let line = progress::status();
    let (outcomes, pictures): (Vec<_>, Vec<_>) =
        rest_density::study(&Workers::default(), &mut |text| line.set_message(text.to_owned()))?.into_iter().unzip();
    drop(line);
    let rows: Vec<Picture> = pictures.chunks(RATIOS.len()).map(|row| Picture::row(row, GAP)).collect();
    output::write(&path, |file| Picture::column(&rows).write_png(file))?;
    output::print(&table(&outcomes))
}

fn table(outcomes: &[Outcome]) -> String {
    let line = |outcome: &Outcome| {
        let Outcome { quality, ratio, kinetic_energy, jitter, density_bottom, density_top, slope, surface } = outcome;
        format!(
            "`{quality}` | {ratio:.2} | {kinetic_energy:.3} | {jitter:.4} | {density_bottom:.2} | {density_top:.2} | \
             {slope:+.3} | {surface:.2}"
        )
    };
    let headings = "quality | >ratio | >kinetic energy a particle, J/m | >rms speed, d a tick | \
                    >particles a d², lower half | >upper half | >slope | >surface, m";
    format!(
        "Means over {OBSERVED_FOR} s after {SETTLED_AFTER} s; rows of the picture: {}.\n\n{}",
        PRESETS.map(|preset| format!("`{}`", preset.name())).join(", "),
        markdown::rows(headings, outcomes.iter().map(line))
    )
}
