//! What sound costs: to listen to a world once a tick, and to make a second of samples.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use powder_master::{
    lab::sound::{Audible, Ear, Listener},
    scene::{self, effects::EffectModes},
    sim::{simulation::Simulation, workers::Workers},
    sound::{Controls, DEFAULT_RATE, Synthesiser},
};
use std::{hint::black_box, sync::Arc, time::Duration};

fn listen(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("listen");
    for name in ["waterfall", "dam_break", "avalanche", "burning_house"] {
        let blueprint = scene::load(name)
            .and_then(|file| file.build(&[], None, &EffectModes::new()))
            .unwrap_or_else(|error| panic!("{error}"));
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::default());
        simulation.run(120);
        let mut ear = Ear::default();
        let hear = |ear: &mut Ear, simulation: &Simulation| {
            let audible = Audible::of(simulation.world());
            ear.listen(&audible, Listener::of_box(audible.size()))
        };
        hear(&mut ear, &simulation);
        simulation.tick();
        let particles = Audible::of(simulation.world()).particles.len();
        // Each time as after the one tick since the ear listened.
        group.bench_function(format!("{name}/{particles}"), |bencher| {
            bencher.iter_batched_ref(|| ear.clone(), |ear| black_box(hear(ear, &simulation)), BatchSize::LargeInput);
        });
    }
    group.finish();
}

fn render(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a second of");
    let share = |share: f32| {
        let mut values = [0.0; Controls::ALL.len()];
        for (value, control) in values.iter_mut().zip(Controls::ALL) {
            *value = control.min + share * (control.max - control.min);
        }
        Controls::from_array(values)
    };
    let water = Controls { stream_level: 0.1, splash_level: 0.15, splash_rate: 100.0, ..Controls::SILENT };
    let mut frames = vec![0.0; 2 * DEFAULT_RATE as usize];
    for (name, controls) in [("silence", Controls::SILENT), ("water", water), ("everything", share(0.6))] {
        let mut synthesiser = Synthesiser::default();
        group.bench_function(name, |bencher| bencher.iter(|| synthesiser.render(black_box(&controls), &mut frames)));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .without_plots();
    targets = listen, render
}
criterion_main!(benches);
