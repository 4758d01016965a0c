//! A run that others are held against, at `reference` quality or finer, and how far others that set out from the same
//! checkpoint go from it over time.

use crate::{
    kernel::params::{Preset, Quality},
    lab::{
        balance::matter,
        coarse::{CoarseField, Distance, Magnitude},
        run::{Observer, Plan, run},
        sampler::SAMPLE_EVERY,
        shake::{UNSEEN, shake},
    },
    sim::{checkpoint::Checkpoint, simulation::Simulation, workers::Workers},
};
use bevy::ecs::world::World;
use std::io;

/// What the reference run was like: one sample every [`SAMPLE_EVERY`] ticks and one at the end.
#[derive(Clone, Debug)]
pub struct Reference {
    ticks: u64,
    samples: Vec<Sample>,
    magnitude: Magnitude,
    floor: Distance,
}

/// How many times finer than the start a converged run is.
pub const CONVERGED_DETAIL: f64 = 4.0;

#[derive(Clone, Debug)]
struct Sample {
    field: CoarseField,
    /// Energy of the particles, J for each metre of depth.
    energy: f64,
}

impl Sample {
    fn of(world: &World) -> Self {
        Self { field: CoarseField::of(world), energy: matter(world).balance().energy() }
    }
}

/// How far a run was from the reference after so many ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Ticks from the start of the run.
    pub tick: u64,
    /// How far.
    pub distance: Distance,
    /// Energy of the particles as a multiple of the reference's; not a number where that has none.
    pub energy_ratio: f64,
}

/// Whether a sample is due after `tick` of `ticks`.
fn is_due(tick: u64, ticks: u64) -> bool {
    tick.is_multiple_of(SAMPLE_EVERY) || tick == ticks
}

impl Reference {
    /// Runs `plan` from `start` at `reference` quality; `watcher` sees each tick, too.
    pub fn record(start: &Checkpoint, plan: &Plan, workers: Workers, watcher: &mut dyn Observer) -> io::Result<Self> {
        let start = start.clone().at_quality(Preset::Reference, Preset::Reference.quality());
        let mut simulation = Simulation::resume(&start.map_err(io::Error::other)?, workers);
        let samples = record(&mut simulation, plan, watcher)?;
        Ok(Self::of(samples, plan, Distance::default()))
    }

    /// What stands for the truth: the mean of two runs at `fine`, [`CONVERGED_DETAIL`] times as fine as the start and with as
    /// many more substeps, that are equally good: nothing goes further in a substep, in spacings, than it does at `fine`
    /// (with `fine`'s substeps a dam break goes on otherwise after its impact on the far wall). All velocities of the second are shaken a little at its start, so that where the flow is
    /// chaotic they come apart. The warm-up counts for the floor alone: it is the mean after it.
    pub fn converged(start: &Checkpoint, plan: &Plan, workers: &Workers) -> io::Result<Self> {
        let detail = CONVERGED_DETAIL * start.setup.asked_detail();
        let fine = Preset::Fine.quality();
        let quality = Quality { substeps: fine.substeps * CONVERGED_DETAIL as u32, ..fine };
        let start = start.clone().at_quality(Preset::Fine, quality);
        let start = start.and_then(|start| start.at_detail(detail)).map_err(io::Error::other)?;
        let mut simulation = Simulation::resume(&start, workers.clone());
        let first = Self::of(record(&mut simulation, plan, &mut ())?, plan, Distance::default());
        let mut simulation = Simulation::resume(&start, workers.clone());
        shake(simulation.world_mut(), UNSEEN, 1);
        let mut follower = Follower::new(&first);
        let samples = record(&mut simulation, plan, &mut follower)?;
        let apart = follower.mean(plan.warmup);
        // Two that are each off by as much, each its own way, are √2 of that apart, and their mean is off by a half of
        // it.
        let half = |distance: Option<f64>| distance.map(|distance| 0.5 * distance);
        let floor = Distance { share: half(apart.share), momentum: half(apart.momentum), air: half(apart.air) };
        let mean =
            |(a, b): (&Sample, &Sample)| Sample { field: a.field.mean(&b.field), energy: 0.5 * (a.energy + b.energy) };
        Ok(Self::of(first.samples.iter().zip(&samples).map(mean).collect(), plan, floor))
    }

    fn of(samples: Vec<Sample>, plan: &Plan, floor: Distance) -> Self {
        let fields: Vec<CoarseField> = samples.iter().map(|sample| sample.field.clone()).collect();
        Self { ticks: plan.ticks, magnitude: CoarseField::magnitudes(&fields), samples, floor }
    }

    /// How far it may itself be from the truth by chance: below that no difference is told from none. Nothing is known
    /// of a single run.
    pub fn floor(&self) -> Distance {
        self.floor
    }
}

/// Runs the plan; returns a sample every [`SAMPLE_EVERY`] ticks and one at the end.
fn record(simulation: &mut Simulation, plan: &Plan, watcher: &mut dyn Observer) -> io::Result<Vec<Sample>> {
    let mut recorder = Recorder { tick: 0, ticks: plan.ticks, samples: Vec::new() };
    run(simulation, plan, &mut [&mut recorder, watcher])?;
    Ok(recorder.samples)
}

struct Recorder {
    tick: u64,
    ticks: u64,
    samples: Vec<Sample>,
}

impl Observer for Recorder {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        self.tick += 1;
        if is_due(self.tick, self.ticks) {
            self.samples.push(Sample::of(world));
        }
        Ok(())
    }
}

/// Follows a run that set out from the reference's checkpoint.
pub struct Follower<'a> {
    reference: &'a Reference,
    tick: u64,
    points: Vec<Point>,
    fields: Vec<CoarseField>,
}

impl<'a> Follower<'a> {
    /// A follower of a run that begins.
    pub fn new(reference: &'a Reference) -> Self {
        Self { reference, tick: 0, points: Vec::new(), fields: Vec::new() }
    }

    /// What it saw, in the order of the ticks.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Mean distance over what it saw after the first `warmup` ticks; of the air, distance of the means.
    pub fn mean(&self, warmup: u64) -> Distance {
        let first = self.points.partition_point(|point| point.tick <= warmup);
        let (points, fields) = (&self.points[first..], &self.fields[first..]);
        let samples = &self.reference.samples[first..self.points.len()];
        let (own, reference) =
            (CoarseField::mean_air(fields), CoarseField::mean_air(samples.iter().map(|sample| &sample.field)));
        let liquid = Distance::mean(&points.iter().map(|point| point.distance).collect::<Vec<_>>());
        Distance { air: own.distance(&reference, self.reference.magnitude).air, ..liquid }
    }
}

impl Observer for Follower<'_> {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        self.tick += 1;
        if is_due(self.tick, self.reference.ticks)
            && let Some(reference) = self.reference.samples.get(self.points.len())
        {
            let own = Sample::of(world);
            self.points.push(Point {
                tick: self.tick,
                distance: own.field.distance(&reference.field, self.reference.magnitude),
                energy_ratio: own.energy / reference.energy,
            });
            self.fields.push(own.field);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{self, effects::EffectModes},
        sim::{control, simulation::Simulation},
    };
    use std::sync::Arc;

    fn small_dam_break() -> Checkpoint {
        let settings = [("columns".to_owned(), "16".to_owned())];
        let blueprint = scene::load("dam_break").unwrap().build(&settings, None, &EffectModes::new()).unwrap();
        Checkpoint::of_scene(Arc::new(blueprint))
    }

    fn follow(
        start: &Checkpoint,
        reference: &Reference,
        (preset, quality): (Preset, Quality),
        plan: &Plan,
    ) -> (Vec<Point>, u64) {
        let mut simulation =
            Simulation::resume(&start.clone().at_quality(preset, quality).unwrap(), Workers::default());
        let mut follower = Follower::new(reference);
        run(&mut simulation, plan, &mut [&mut follower]).unwrap();
        (follower.points().to_vec(), control::hash(simulation.world()))
    }

    #[test]
    fn the_reference_stays_with_itself_and_the_rough_go_far() {
        let (start, plan) = (small_dam_break(), Plan { ticks: 90, ..Plan::default() });
        let reference = Reference::record(&start, &plan, Workers::default(), &mut ()).unwrap();
        let (own, _) = follow(&start, &reference, (Preset::Reference, Preset::Reference.quality()), &plan);
        assert_eq!(own.iter().map(|point| point.tick).collect::<Vec<_>>(), [20, 40, 60, 80, 90]);
        let nothing = Distance { share: Some(0.0), momentum: Some(0.0), air: None };
        assert!(own.iter().all(|point| point.distance == nothing && point.energy_ratio == 1.0), "{own:?}");
        let nearly = Quality { iterations: 3, ..Preset::Reference.quality() };
        let (fine, _) = follow(&start, &reference, (Preset::Reference, nearly), &plan);
        let (rough, hash) = follow(&start, &reference, (Preset::Fast, Preset::Classic.quality()), &plan);
        let early = |points: &[Point]| points[1].distance.share.unwrap();
        assert!(early(&fine) > 0.0 && early(&fine) < early(&rough), "{fine:?}\n{rough:?}");
        let mut alone = Simulation::resume(
            &start.clone().at_quality(Preset::Fast, Preset::Classic.quality()).unwrap(),
            Workers::default(),
        );
        run(&mut alone, &plan, &mut []).unwrap();
        assert_eq!(control::hash(alone.world()), hash, "to be followed changes nothing");
    }

    #[test]
    fn the_mean_leaves_the_warm_up_out() {
        let (start, plan) = (small_dam_break(), Plan { ticks: 40, ..Plan::default() });
        let reference = Reference::record(&start, &plan, Workers::default(), &mut ()).unwrap();
        let mut simulation = Simulation::resume(
            &start.clone().at_quality(Preset::Draft, Preset::Draft.quality()).unwrap(),
            Workers::default(),
        );
        let mut follower = Follower::new(&reference);
        run(&mut simulation, &plan, &mut [&mut follower]).unwrap();
        assert_eq!(follower.mean(20), follower.points()[1].distance);
        assert_eq!(follower.mean(40), Distance::default(), "nothing is left");
    }
}
