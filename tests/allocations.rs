//! A steady tick allocates nothing: neither the kernel's passes nor the schedules around them. A binary of its own,
//! because the allocator counts for the whole process.
//!
//! On one thread there is none at all. On more, entering the pool costs rayon a block of its waiting list now and then.

use glam::Vec2;
use powder_master::{
    lab::gauges::{place::Place, set::Gauges},
    scene::{self, effects::EffectModes},
    sim::{simulation::Simulation, workers::Workers},
};
use std::{
    alloc::{GlobalAlloc, Layout, System},
    backtrace::Backtrace,
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    thread,
    time::Duration,
};

/// Ticks that are counted.
const TICKS: u64 = 120;

/// The system's allocator, which counts while it is told to and remembers who came first.
struct Counting;

static COUNTS: AtomicBool = AtomicBool::new(false);
static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);
static FIRST: Mutex<String> = Mutex::new(String::new());

fn note() {
    if COUNTS.load(Ordering::Relaxed) && ALLOCATIONS.fetch_add(1, Ordering::Relaxed) == 0 {
        // To write down who it was allocates, too.
        COUNTS.store(false, Ordering::Relaxed);
        if let Ok(mut first) = FIRST.lock() {
            *first = Backtrace::force_capture().to_string();
        }
        COUNTS.store(true, Ordering::Relaxed);
    }
}

// SAFETY: all is left to the system's allocator; counting touches none of the memory.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        note();
        // SAFETY: the caller's promise is the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        note();
        // SAFETY: the caller's promise is the same.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        note();
        // SAFETY: the caller's promise is the same.
        unsafe { System.realloc(block, layout, size) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise is the same.
        unsafe { System.dealloc(block, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of `TICKS` ticks of a scene after `warm_up` ticks, and where the first came from.
fn count(scene: &str, settings: &[(&str, &str)], threads: usize, warm_up: u64) -> (u64, String) {
    let mut simulation = simulation(scene, settings, threads);
    count_ticks(&mut simulation, warm_up, |_| {})
}

/// The same with gauges that are read after each tick.
fn count_with_gauges(scene: &str, warm_up: u64, places: &[Place]) -> (u64, String) {
    let (mut simulation, mut gauges) = (simulation(scene, &[], 1), Gauges::keeping(1));
    for place in places {
        gauges.set(simulation.world(), *place).unwrap_or_else(|error| panic!("{error}"));
    }
    count_ticks(&mut simulation, warm_up, |simulation| gauges.read(simulation.world()))
}

fn simulation(scene: &str, settings: &[(&str, &str)], threads: usize) -> Simulation {
    let settings: Vec<(String, String)> = settings.iter().map(|&(key, value)| (key.into(), value.into())).collect();
    let blueprint = scene::load(scene).and_then(|file| file.build(&settings, None, &EffectModes::new()));
    let blueprint = Arc::new(blueprint.unwrap_or_else(|error| panic!("{error}")));
    let workers = Workers::new(threads).unwrap_or_else(|error| panic!("{error}"));
    Simulation::new(blueprint, workers)
}

fn count_ticks(simulation: &mut Simulation, warm_up: u64, mut after: impl FnMut(&Simulation)) -> (u64, String) {
    for _ in 0..warm_up {
        simulation.tick();
        after(simulation);
    }
    // Threads of the pool may begin later than this one, and the warm-up of an empty world is over in a moment.
    thread::sleep(Duration::from_millis(100));
    ALLOCATIONS.store(0, Ordering::Relaxed);
    COUNTS.store(true, Ordering::Relaxed);
    for _ in 0..TICKS {
        simulation.tick();
        after(simulation);
    }
    COUNTS.store(false, Ordering::Relaxed);
    (ALLOCATIONS.load(Ordering::Relaxed), FIRST.lock().map(|first| first.clone()).unwrap_or_default())
}

/// Scene, settings, ticks of warm-up.
type Case<'a> = (&'a str, &'a [(&'a str, &'a str)], u64);

// Without libtest, whose message after a minute allocates on a thread of its own.
fn main() {
    // The allocator sees what it should.
    COUNTS.store(true, Ordering::Relaxed);
    std::hint::black_box(vec![0_u8; 100]);
    COUNTS.store(false, Ordering::Relaxed);
    assert_eq!(ALLOCATIONS.load(Ordering::Relaxed), 1, "an allocation goes unseen");

    let cases: [Case; 8] = [
        ("communicating_vessels", &[], 300),
        ("dam_break", &[("columns", "30")], 600),
        ("empty", &[], 100),
        ("hydrostatic", &[], 400),
        // All is poured in after 510.
        ("rest_density", &[], 600),
        ("sealed_air", &[], 600),
        ("waterfall", &[], 1500),
        ("wind_tunnel", &[], 600),
    ];
    let mut faults = Vec::new();
    for (scene, settings, warm_up) in cases {
        let (allocations, first) = count(scene, settings, 1, warm_up);
        println!("{scene}: {allocations} allocations in {TICKS} ticks");
        if allocations > 0 {
            faults.push(format!("{scene}: {allocations} allocations in {TICKS} ticks, the first by\n{first}"));
        }
    }
    // Neither do gauges; those of a sleeping pool are read in another way.
    let line = Place::Line { from: Vec2::new(12.0, 0.0), to: Vec2::new(12.0, 4.0) };
    let spot = |x, y| Place::Spot { at: Vec2::new(x, y), radius: 0.3 };
    for (scene, warm_up, places) in [
        ("waterfall", 1500, &[spot(12.0, 2.0), spot(6.0, 7.2), line][..]),
        ("hydrostatic", 1000, &[spot(2.0, 1.0)]),
        ("waterfall", 1500, &[]),
    ] {
        let (allocations, first) = count_with_gauges(scene, warm_up, places);
        println!("{scene} with {} gauges: {allocations} allocations in {TICKS} ticks", places.len());
        if allocations > 0 {
            faults.push(format!("{scene} with gauges: {allocations} allocations, the first by\n{first}"));
        }
    }
    // Rayon keeps those who wait for its threads in blocks of 63, and what its threads take from each other in lists that
    // grow with luck: some blocks, but by far not one a tick.
    let (allocations, first) = count("dam_break", &[("columns", "60")], 2, 300);
    println!("dam_break on two threads: {allocations} allocations in {TICKS} ticks");
    if allocations > TICKS / 8 {
        faults.push(format!("on two threads: {allocations} allocations in {TICKS} ticks, the first by\n{first}"));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
