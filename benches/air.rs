//! Cost of the air for each cell and substep, with rock in it: `cargo bench --no-default-features --bench air`.
//!
//! Criterion's `thrpt` is cells × substeps a second; its inverse is the time of one (250 Melem/s are 4 ns).
//!
//! Medians on one thread of a shared AMD EPYC (family 26), to first order, interleaved with what was before, which knew SSE2
//! only:
//!
//! | cells | AVX-512 | AVX2 | SSE2 | scalar | before |
//! |---|---|---|---|---|---|
//! | 64 × 64 | 3.4 ns | 3.8 ns | 5.1 ns | 14.3 ns | 5.7 ns |
//! | 153 × 96 | 3.3 ns | 3.7 ns | 4.8 ns | 15.3 ns | 5.0 ns |
//! | 512 × 512 | 3.5 ns | 3.7 ns | 4.8 ns | 16.7 ns | 4.9 ns |
//!
//! Second order takes twice as long. (The Powder Toy: 22.5 ns.)

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{IVec2, Vec2};
use powder_master::kernel::air::{Air, Rousing};
use powder_master::kernel::element::{ElementId, ElementParams};
use powder_master::kernel::forces::{LaterDrag, apply_drag};
use powder_master::kernel::parallel::Team;
use powder_master::kernel::params::{AIR_DENSITY, AirAdvection, AirParams, AirScheme, OpenSides};
use powder_master::kernel::particles::Particles;
use powder_master::kernel::random::Random;
use powder_master::kernel::simd::InstructionSet;
use powder_master::kernel::solids::Solids;
use powder_master::kernel::units::TICK_SECONDS;
use std::time::{Duration, Instant};

const CELL: f32 = 4.0;
const SOUND: f32 = 1000.0;
const SCHEME: AirScheme = AirScheme { courant: 0.7, advection: AirAdvection::SecondOrder };

fn params() -> AirParams {
    AirParams { sound_speed: SOUND, density: AIR_DENSITY, open: OpenSides::default() }
}

/// A windy box with a tenth of its cells rock: two walls with gaps and lone particles.
fn windy(columns: usize, rows: usize) -> Air {
    let mut solids = Solids::new(columns as u32 * 4, rows as u32 * 4);
    let mut random = Random::new(1);
    for k in 0..columns * rows {
        let (column, row) = (k % columns, k / columns);
        let wall = (column == columns / 3 && row % 16 > 3) || (row == rows / 2 && column % 20 > 4);
        if random.below(256) < 18 || wall {
            solids.insert(IVec2::new(column as i32, row as i32) * 4, ElementId(0), 0);
        }
    }
    let size = Vec2::new(columns as f32, rows as f32) * CELL;
    let mut air = Air::new(size, CELL, params());
    air.set_solids(&solids);
    stir(&mut air, size);
    air
}

fn stir(air: &mut Air, size: Vec2) {
    air.blow(size * 0.3, size.y * 0.3, Vec2::new(150.0, 60.0));
    air.blow(size * 0.7, size.y * 0.3, Vec2::new(-90.0, 120.0));
}

fn substep(c: &mut Criterion) {
    let mut group = c.benchmark_group("air");
    for (columns, rows) in [(64, 64), (153, 96), (512, 512)] {
        group.throughput(Throughput::Elements((columns * rows) as u64));
        let alone = InstructionSet::available().into_iter().map(|instructions| Team { instructions, threads: 1 });
        let together = Team { instructions: InstructionSet::detect(), threads: rayon::current_num_threads() };
        let schemes = AirAdvection::ALL.map(|advection| AirScheme { advection, ..SCHEME });
        for (team, scheme) in alone.chain([together]).flat_map(|team| schemes.map(|scheme| (team, scheme))) {
            let name = format!("{}, {} on {}", scheme.advection.name(), team.instructions.name(), team.threads);
            group.bench_function(BenchmarkId::new(name, format!("{columns} × {rows}")), |bencher| {
                let mut air = windy(columns, rows);
                let size = Vec2::new(columns as f32, rows as f32) * CELL;
                bencher.iter_custom(|iterations| {
                    let (mut substeps, mut spent) = (0_u64, Duration::ZERO);
                    while substeps < iterations {
                        stir(&mut air, size);
                        let start = Instant::now();
                        substeps += u64::from(air.step(&[], scheme, team, TICK_SECONDS).substeps);
                        spent += start.elapsed();
                    }
                    spent.div_f64(substeps as f64 / iterations as f64)
                });
            });
        }
    }
    group.finish();
}

/// A gust in a corner of 512 × 512 cells that has half a second, where tiles sleep and where they don't. A tick each.
fn gust(c: &mut Criterion) {
    const TICKS: u64 = 30;
    let team = Team { instructions: InstructionSet::detect(), threads: 1 };
    let mut group = c.benchmark_group("air with a gust in a corner");
    group.sample_size(10);
    for (name, sleeps) in [("tiles sleep", true), ("all awake", false)] {
        group.bench_function(name, |bencher| {
            bencher.iter_custom(|iterations| {
                let (mut ticks, mut spent) = (0, Duration::ZERO);
                while ticks < iterations {
                    let mut air = Air::new(Vec2::splat(512.0 * CELL), CELL, params());
                    air.allow_sleep(sleeps);
                    air.blow(Vec2::splat(100.0), 40.0, Vec2::new(6.0, 3.0));
                    let start = Instant::now();
                    for _ in 0..TICKS {
                        air.step(&[], SCHEME, team, TICK_SECONDS);
                    }
                    spent += start.elapsed();
                    ticks += TICKS;
                }
                spent.div_f64(ticks as f64 / iterations as f64)
            });
        });
    }
    group.finish();
}

/// Drag of water in strips, as the bins sort it, in moving air: of the particles alone, and of particles and air.
fn drag(c: &mut Criterion) {
    const COUNT: usize = 50_000;
    let team = Team { instructions: InstructionSet::detect(), threads: 1 };
    let size = Vec2::new(500.0, 300.0);
    let mut air = Air::new(size, CELL, params());
    air.blow(size * 0.5, 400.0, Vec2::new(60.0, 20.0));
    air.step(&[], SCHEME, team, TICK_SECONDS);
    let mut particles = Particles::default();
    for i in 0..COUNT {
        let (strip, place) = (i / 1500, i % 1500);
        let at = Vec2::new((place / 3) as f32 + 0.5, (strip * 3 + place % 3) as f32 + 0.5);
        particles.push(i as u32, ElementId(0), at, Vec2::new((i % 90) as f32, -50.0));
    }
    let water = ElementParams { drag: vec![0.0045], mass: vec![1000.0], ..ElementParams::default() };
    let mut later = LaterDrag::default();
    let mut group = c.benchmark_group("drag");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function("of particles", |bencher| {
        let mut particles = particles.clone();
        bencher.iter(|| apply_drag(&air, &water, &mut particles, &mut later, 1, 1.0e-6));
    });
    group.bench_function("of particles and air", |bencher| {
        let (mut air, mut particles) = (air.clone(), particles.clone());
        bencher.iter(|| {
            air.meet(&water, &particles, &mut later, Rousing::Gusts, team, 1.0e-6);
            air.drag_along(&mut particles, &mut later, team);
        });
    });
    group.finish();
}

criterion_group!(benches, substep, gust, drag);
criterion_main!(benches);
