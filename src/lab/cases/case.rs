//! What a case is.

use crate::{
    lab::cases::{
        row::{Figures, Row, Verdict},
        setting::{Over, Setting},
        simulation::Stopwatch,
    },
    scene::SceneError,
};
use serde::Deserialize;
use std::fmt::Debug;

/// A case of a suite: of the physics exam or of the stability gauntlet. A new one is a constant of such a type and a line
/// in the suite's list.
pub trait Case: Debug + Send + Sync + Sized + 'static {
    /// What is found in it.
    type Figures: Figures;

    /// What the cases of the suite have in common.
    const SUITE: Suite<Self>;

    /// Its name and what it means.
    fn about(&self) -> About;

    /// Simulates it in a setting and judges. Yields after each tick.
    fn run(
        &'static self,
        setting: &Setting,
        stopwatch: &Stopwatch,
    ) -> impl Future<Output = Result<Vec<(Verdict, Self::Figures)>, SceneError>> + Send;

    /// How long it takes, against others of its size.
    fn length(&self) -> u64 {
        1
    }
}

/// The name of a case and what it means.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Name on the command line.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What happens, in Markdown.
    pub what: &'static str,
    /// What it is for and what is allowed, in Markdown: as the suite's `labels` say.
    pub why: [&'static str; 2],
    /// How long it takes.
    pub size: Size,
    /// What it depends on.
    pub over: Over,
}

/// How long a case takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub enum Size {
    /// So little, even in a debug build, that it belongs to the quick cases.
    Quick,
    /// Some seconds in a release build.
    #[default]
    Usual,
    /// So long that only the command runs it.
    Long,
    /// An hour and more: only the command runs it, and only by its name.
    Hours,
}

/// What the cases of a suite have in common.
pub struct Suite<C: Case> {
    /// The command that runs them.
    pub command: &'static str,
    /// Help text of the option `--case`.
    pub which: &'static str,
    /// All of them, in the order in which they are shown.
    pub cases: fn() -> &'static [C],
    /// The head of the document, for a command and a processor.
    pub introduction: fn(command: &str, processor: &str) -> String,
    /// What the texts in [`About::why`] are called.
    pub labels: [&'static str; 2],
    /// Columns of the table. The first is the case.
    pub columns: &'static [Column<C::Figures>],
    /// How a failed row is named.
    pub failure: fn(&Row<C::Figures>) -> String,
    /// What rows are called in the summary.
    pub rows: &'static str,
    /// The verdicts of rows that neither pass nor fail, and what these are called in the summary.
    pub excused: &'static [(Verdict, &'static str)],
    /// Where failures count, if not everywhere.
    pub failing: &'static str,
}

/// A column of a suite's table.
pub struct Column<F> {
    /// Heading.
    pub heading: &'static str,
    /// Whether it stands at the right.
    pub is_figure: bool,
    /// What stands in it.
    pub cell: fn(&Row<F>) -> String,
}

impl<F> Column<F> {
    /// A column of text.
    pub const fn text(heading: &'static str, cell: fn(&Row<F>) -> String) -> Self {
        Self { heading, is_figure: false, cell }
    }

    /// A column of figures.
    pub const fn figure(heading: &'static str, cell: fn(&Row<F>) -> String) -> Self {
        Self { heading, is_figure: true, cell }
    }
}
