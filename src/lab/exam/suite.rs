//! The exam as a suite: its columns, its words, and how a case is run.

use crate::{
    lab::{
        cases::{About, Case, Column, Row, Setting, Stopwatch, Suite, Verdict},
        exam::{Answer, CASES, ExamCase, cases::runs, set_up::SetUp},
    },
    scene::SceneError,
};

impl Case for ExamCase {
    type Figures = Answer;

    const SUITE: Suite<Self> = Suite {
        command: "exam",
        which: "Case to examine, again for more [default: all]",
        cases: || &CASES,
        introduction,
        labels: ["Known", "Tolerance"],
        columns: &[
            Column::text("case", |row| row.case.to_owned()),
            Column::text("quantity", |row| row.figures.quantity.to_owned()),
            Column::text("at", |row| row.setting.clone()),
            Column::figure("expected", |row| row.figures.with_unit(row.figures.expected)),
            Column::figure("got", |row| row.figures.with_unit(row.figures.got)),
            Column::figure("error", |row| row.figures.distance(row.figures.error)),
            Column::figure("tolerance", |row| row.figures.distance(row.figures.tolerance)),
            Column::text("", |row| verdict(row.verdict).to_owned()),
            Column::figure("ms", |row| format!("{:.0}", row.figures.milliseconds)),
        ],
        failure: |Row { case, setting, figures, .. }| format!("{case}, {} at {setting}", figures.quantity),
        rows: "rows",
        excused: &[
            (Verdict::Miss, "miss below `balanced`"),
            (Verdict::Known, "known misses"),
            (Verdict::Shown, "not judged"),
        ],
        failing: " at balanced or better",
    };

    fn about(&self) -> About {
        let Self { name, title, setup: what, answer, tolerance, over, size, .. } = *self;
        About { name, title, what, why: [answer, tolerance], size, over }
    }

    async fn run(
        &'static self,
        setting: &Setting,
        stopwatch: &Stopwatch,
    ) -> Result<Vec<(Verdict, Answer)>, SceneError> {
        let set_up = SetUp { setting: setting.clone(), stopwatch: stopwatch.clone() };
        let run = runs().find(|(name, _)| *name == self.name).map(|(_, run)| run(set_up));
        let findings = match run {
            Some(run) => run.await?,
            None => Vec::new(),
        };
        Ok(findings.into_iter().map(|finding| self.judge(finding, setting, stopwatch.milliseconds())).collect())
    }
}

/// A verdict in the table.
fn verdict(verdict: Verdict) -> &'static str {
    if verdict == Verdict::Known { "known miss" } else { verdict.word() }
}

fn introduction(command: &str, processor: &str) -> String {
    format!(
        "# The physics exam\n\n\
         Answers that are known from theory or experiment, computed by the program as it is shipped at each quality, and \
         compared. `{command}` writes this file; `powder-master exam` prints the table and ends with exit code 1 if a row \
         at `balanced` or better is beyond its tolerance and not a known miss. Rows beyond it at `classic`, `draft` or \
         `fast` are marked `miss` and stay.\n\n\
         Tolerances are derived from theory or measurement before a run, as each case says, and only ever get tighter: \
         tests/exam/tolerances.ron has the history of each, and a test holds assets/exam/cases.ron to it. A row that is \
         known to be beyond its tolerance is a *known miss*: it is listed there with the reason, which stands below its \
         table. A test runs every case at `balanced` and the quick ones at every quality, and fails when a miss is new or \
         cured.\n\n\
         Where a row says *d = 0.1 m*, the game's own spacing, the row above it is the same at a finer one; `reference`, \
         of twice the detail, halves both.\n\n\
         The rows *order of the error in the spacing* say how the error falls when particles get finer: the slope of \
         log error over log spacing, by least squares over runs whose lengths grow with the number of particles and whose \
         times with its root (Froude's scaling, the spacing stays). Each spacing is run from two starts of equal accuracy; \
         their distance over √2 is the floor below which nothing is claimed. At least 1 is wanted at `balanced`; `classic` \
         is shown beside and not judged. Errors and floors stand below each table.\n\n\
         Lengths in m; d = 0.1 m is the spacing of the particles, a tick is 1/60 s. *ms* is the processor time of one \
         thread for the whole simulation of a case in one setting ({processor}, all processors busy); the rows of a case \
         share it."
    )
}
