//! The gauntlet as a suite: its columns, its words, and how a case is run.

use crate::{
    lab::{
        cases::{About, Case, CaseSimulation, Column, Row, Setting, Stopwatch, Suite, Verdict},
        gauntlet::{
            CASES, GauntletCase, Stability,
            judge::{Judge, Totals},
        },
    },
    scene::SceneError,
    sim::numbers::figure,
};

impl Case for GauntletCase {
    type Figures = Stability;

    const SUITE: Suite<Self> = Suite {
        command: "gauntlet",
        which: "Case to run, again for more: a name of `list cases` [default: all]",
        cases: || &CASES,
        introduction,
        labels: ["Guards against", "Allowed"],
        columns: &[
            Column::text("case", |row| row.case.to_owned()),
            Column::text("at", |row| row.setting.clone()),
            Column::text("", |row| row.verdict.word().to_owned()),
            Column::figure("particles", |row| row.figures.particles.to_string()),
            Column::figure("gain, m/s", |row| figure(row.figures.gain)),
            Column::figure("density", |row| if_any(row.figures.density_worst)),
            Column::figure("at the end", |row| if_any(row.figures.density_end)),
            Column::figure("motion", |row| figure(row.figures.motion)),
            Column::figure("work", |row| figure(row.figures.work)),
            Column::figure("clamps", |row| {
                row.figures.clamps.acted().map(|acted| acted.count).sum::<u64>().to_string()
            }),
            Column::figure("ms", |row| format!("{:.2}/{:.1}", row.figures.ms_median, row.figures.ms_max)),
        ],
        failure: |Row { case, setting, figures, .. }| format!("{case} at {setting}: {}", figures.broken.join("; ")),
        rows: "runs",
        excused: &[(Verdict::Known, "known of `classic`")],
        failing: "",
    };

    fn about(&self) -> About {
        let Self { name, title, what, guards, allowed, size, over, .. } = *self;
        About { name, title, what, why: [guards, allowed], size, over }
    }

    async fn run(
        &'static self,
        setting: &Setting,
        stopwatch: &Stopwatch,
    ) -> Result<Vec<(Verdict, Stability)>, SceneError> {
        let mut simulation = CaseSimulation::new(self.blueprint(setting.preset, setting.detail)?, stopwatch);
        let mut judge = Judge::new(self, simulation.world());
        for tick in 0..u64::from(self.ticks) {
            if let Some(act) = self.act {
                // What the script puts in is counted apart from what the tick does with it.
                let before = Totals::of(simulation.world());
                act(simulation.world_mut(), tick);
                simulation.edit();
                judge.edited(before, Totals::of(simulation.world()));
            }
            let before = Totals::of(simulation.world());
            let ticks = match self.frame(tick) {
                Some(time) => simulation.frame(time).await,
                None => {
                    simulation.tick().await;
                    1
                }
            };
            judge.inspect(before, ticks, simulation.world());
        }
        Ok(vec![judge.finish(self, setting.preset, simulation.world(), stopwatch.milliseconds())])
    }

    fn length(&self) -> u64 {
        u64::from(self.ticks)
    }
}

fn if_any(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), figure)
}

fn introduction(command: &str, processor: &str) -> String {
    format!(
        "# The gauntlet\n\n\
         Every hard case at every quality, run by the program as it is shipped. `{command}` writes this file; \
         `powder-master gauntlet` prints the table and ends with exit code 1 if a case fails. What it is for and what it \
         leaves open stands in [stability.md](stability.md).\n\n\
         *gain*: kinetic and potential energy above what was there and was put in, as the speed that all particles \
         together would have of it. *density*: 99th percentile of how far it is too dense, the worst after the shock and over \
         the last tenth of the case. *motion*: rms speed over the last tenth, d a tick. *work*: the most expensive tick as \
         a multiple of a calm one (candidate pairs a particle × substeps × iterations; the same on every machine). \
         *clamps*: what all limiters did, summed over particles, cells and substeps. *ms*: median and longest tick, one \
         thread ({processor}, all processors busy).\n\n\
         In every case: every value is finite and no pressure below 0 after every tick, no particle is ever outside the \
         box or inside rock, and none gets lost. Runs that differ in nothing are done once: `ends_1` to `ends_7` set every \
         number of the quality, so that they stand for all qualities from `draft` on, and `quality_changes` chooses its \
         qualities by itself."
    )
}
