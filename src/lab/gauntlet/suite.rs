//! The gauntlet as a suite: its columns, its words, and how a case is run.

use crate::{
    lab::{
        cases::{About, Case, CaseSimulation, Column, Row, Setting, Stopwatch, Suite, Verdict},
        gauntlet::{
            CASES, GauntletCase, Stability,
            calm::calm_ms,
            judge::{Judge, LEAST_MS},
            measure::energy::Stored,
            rule::Rule,
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
        labels: ["Guards against", "Bounds"],
        columns: &[
            Column::text("case", |row| row.case.to_owned()),
            Column::text("at", |row| row.setting.clone()),
            Column::text("", |row| row.verdict.word().to_owned()),
            Column::figure("particles", |row| row.figures.particles.to_string()),
            Column::figure("energy", |row| row.figures.cell(Rule::Energy)),
            Column::figure("density", |row| row.figures.cell(Rule::Density)),
            Column::figure("rest", |row| row.figures.cell(Rule::Rest)),
            Column::figure("speed", |row| row.figures.cell(Rule::Speed)),
            Column::figure("air", |row| row.figures.cell(Rule::Air)),
            Column::figure("cost", |row| row.figures.cell(Rule::Cost)),
            Column::figure("time", |row| figure(row.figures.time)),
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
        let blueprint = self.blueprint(setting.preset, setting.detail)?;
        let mut simulation = CaseSimulation::new(blueprint.clone(), stopwatch);
        let mut judge = Judge::new(self, simulation.world());
        for tick in 0..u64::from(self.ticks) {
            if let Some(act) = self.act {
                // What the script puts in is counted apart from what the tick does with it.
                let before = Stored::of(simulation.world());
                act(simulation.world_mut(), tick);
                simulation.edit();
                judge.edited(before, simulation.world());
            }
            judge.begin(simulation.world());
            let ticks = match self.frame(tick) {
                Some(time) => simulation.frame(time).await,
                None => {
                    simulation.tick().await;
                    1
                }
            };
            judge.look(ticks, simulation.world());
        }
        let ms = stopwatch.milliseconds();
        let calm = calm_ms(&blueprint, simulation.world()).await;
        Ok(vec![judge.finish(self, setting.preset, simulation.world(), [calm, ms])])
    }

    fn length(&self) -> u64 {
        u64::from(self.ticks)
    }
}

fn introduction(command: &str, processor: &str) -> String {
    let bounds = [Rule::Energy, Rule::Density, Rule::Rest, Rule::Speed, Rule::Air, Rule::Cost];
    let bounds = bounds.map(|rule| format!("- *{}*: {}. {}", rule.name(), rule.bound(), rule.why())).join("\n\n");
    let least = LEAST_MS;
    format!(
        "# The gauntlet\n\n\
         Every hard case at every quality, run by the program as it is shipped. `{command}` writes this file; \
         `powder-master gauntlet` prints the table and ends with exit code 1 if a case fails. What it is for and what it \
         leaves open stands in [stability.md](stability.md).\n\n\
         Each case is judged by every rule, at the tick at which it came nearest to the bound; where a rule can't apply, a \
         word says why. *energy*: kinetic and potential energy of the matter above what was there and was put in, as the \
         speed that all of it together would have of it, m/s. *density*: 99th percentile of how far liquid is too dense. \
         *rest*: rms speed over the last tenth, d a tick. *speed*: the fastest, d/s. *air*: change of the mass of air \
         that is shut in, as a share of it. *cost*: the most expensive tick's pairs and steps of the air, as a multiple of a \
         calm tick's in the same world (the same on every machine). *time*: the time that nine in ten ticks do not exceed, as \
         a multiple of a calm tick's with the same effects in the same run, {least} ms at least. \
         *clamps*: what all limiters did, summed over particles, cells and substeps. *ms*: median and longest tick, one \
         thread ({processor}, all processors busy).\n\n\
         The bounds are the same everywhere and at every quality, but where a case says otherwise and why:\n\n{bounds}\n\n\
         In every case, and whatever is `known`: every value is finite and no pressure below 0 after every tick, no particle is ever \
         outside the box or inside rock, and none gets lost. All are judged with nothing asleep but `pool_asleep`. Runs that differ in nothing are done once: `ends_1` to `ends_7` set every \
         number of the quality, so that they stand for all qualities from `draft` on, and `quality_changes` and \
         `quality_and_detail_changes` choose their qualities by themselves."
    )
}
