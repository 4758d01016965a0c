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
            Column::text("", |row| row.verdict.word().to_owned()),
            Column::figure("ms", |row| format!("{:.0}", row.figures.milliseconds)),
        ],
        failure: |Row { case, setting, figures, .. }| format!("{case}, {} at {setting}", figures.quantity),
        rows: "rows",
        excused: (Verdict::Miss, "miss below `balanced`"),
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
        Ok(findings.into_iter().map(|finding| finding.judge(setting, stopwatch.milliseconds())).collect())
    }
}

fn introduction(command: &str, processor: &str) -> String {
    format!(
        "# The physics exam\n\n\
         Answers that are known from theory or experiment, computed by the program as it is shipped at each quality, and \
         compared. `{command}` writes this file; `powder-master exam` prints the table and ends with exit code 1 if a row \
         at `balanced` or better is beyond its tolerance. Rows beyond it at `classic`, `draft` or `fast` are marked `miss` \
         and stay.\n\n\
         Lengths in m; d = 0.1 m is the spacing of the particles, a tick is 1/60 s. *ms* is the processor time of one \
         thread for the whole simulation of a case in one setting ({processor}, all processors busy); the rows of a case \
         share it."
    )
}
