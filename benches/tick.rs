//! A whole tick of `dam_break` in mid-fall, at every preset, on one and on two threads.

use bevy::{MinimalPlugins, app::App, time::TimeUpdateStrategy};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use powder_master::{
    kernel::params::Preset,
    scene::{self, effects::EffectModes},
    sim::{SimulationPlugin, control, snapshot::Snapshot, state::ParticleStore, workers::Workers},
};
use std::{sync::Arc, time::Duration};

/// Ticks before the first that is timed: the front has reached the far wall at none, and all water moves.
const WARM_UP: u32 = 30;
/// Ticks that are timed before the world goes back to where the timing began.
const STRETCH: u64 = 20;

fn world(columns: u32, preset: Preset, threads: usize) -> App {
    let settings = [("columns".to_owned(), columns.to_string())];
    let blueprint = scene::load("dam_break")
        .and_then(|file| file.build(&settings, Some(preset), &EffectModes::new()))
        .unwrap_or_else(|error| panic!("{error}"));
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, SimulationPlugin)).insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
    app.insert_resource(Workers::new(threads).unwrap_or_else(|error| panic!("{error}")));
    control::load(app.world_mut(), Arc::new(blueprint));
    app.finish();
    app.cleanup();
    app.update();
    app
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
                let mut app: Option<(App, Snapshot, u64)> = None;
                group.throughput(Throughput::Elements(u64::from(2 * columns * columns)));
                group.bench_function(format!("{columns}/{}/{threads}", preset.name()), |bencher| {
                    let (app, start, done) = app.get_or_insert_with(|| {
                        let mut app = world(columns, preset, threads);
                        for _ in 0..if columns > 100 { 5 } else { WARM_UP } {
                            app.update();
                        }
                        let start = control::freeze(app.world());
                        assert_eq!(app.world().resource::<ParticleStore>().len(), (2 * columns * columns) as usize);
                        (app, start, 0)
                    });
                    bencher.iter_custom(|iterations| {
                        let mut time = Duration::ZERO;
                        for _ in 0..iterations {
                            if *done == STRETCH {
                                control::thaw(app.world_mut(), start);
                                *done = 0;
                            }
                            *done += 1;
                            let before = std::time::Instant::now();
                            app.update();
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
