//! A whole tick of `dam_break` in mid-fall, at every preset, on one and on two threads.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use powder_master::{
    kernel::params::Preset,
    scene::{self, effects::EffectModes},
    sim::{checkpoint::Checkpoint, simulation::Simulation, state::ParticleStore, workers::Workers},
};
use std::{sync::Arc, time::Duration};

/// Ticks before the first that is timed: the front has reached the far wall at none, and all water moves.
const WARM_UP: u32 = 30;
/// Ticks that are timed before the world goes back to where the timing began.
const STRETCH: u64 = 20;

fn world(columns: u32, preset: Preset, threads: usize) -> Simulation {
    let settings = [("columns".to_owned(), columns.to_string())];
    let blueprint = scene::load("dam_break")
        .and_then(|file| file.build(&settings, Some(preset), &EffectModes::new()))
        .unwrap_or_else(|error| panic!("{error}"));
    Simulation::new(Arc::new(blueprint), Workers::new(threads).unwrap_or_else(|error| panic!("{error}")))
}

fn ticks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("tick");
    for columns in [27, 71, 224] {
        for preset in Preset::ALL {
            // The reference is not meant for real time: its smallest size stands for all.
            if preset == Preset::Reference && columns > 27 {
                continue;
            }
            for threads in [1, 2] {
                let mut kept: Option<(Simulation, Checkpoint, u64)> = None;
                group.throughput(Throughput::Elements(u64::from(2 * columns * columns)));
                group.bench_function(format!("{columns}/{}/{threads}", preset.name()), |bencher| {
                    let (simulation, start, done) = kept.get_or_insert_with(|| {
                        let mut simulation = world(columns, preset, threads);
                        simulation.run(if columns > 100 { 5 } else { WARM_UP });
                        let start = Checkpoint::of(simulation.world());
                        assert_eq!(simulation.get::<ParticleStore>().len(), (2 * columns * columns) as usize);
                        (simulation, start, 0)
                    });
                    bencher.iter_custom(|iterations| {
                        let mut time = Duration::ZERO;
                        for _ in 0..iterations {
                            if *done == STRETCH {
                                start.restore(simulation.world_mut());
                                *done = 0;
                            }
                            *done += 1;
                            let before = std::time::Instant::now();
                            simulation.tick();
                            time += before.elapsed();
                        }
                        time
                    });
                });
            }
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800))
        .without_plots();
    targets = ticks
}
criterion_main!(benches);
