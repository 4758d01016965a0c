//! Whatever acts on a sleeping body wakes it first, and no other.

use super::{apart, asleep, disc, dry_box, gap, lake, lake_in_air, two_ponds, until_asleep, without_sleep, work};
use crate::support::{Furnish, ROCK, SimulationExt, WATER};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::Stroke,
        params::Preset,
        sources::{Drain, Rect},
    },
    scene::{
        effects::{Effect, Mode},
        passes::Pass,
    },
    sim::{
        effects::Effects,
        intent::Intent,
        simulation::Simulation,
        state::{Clock, Sources},
    },
};

#[test]
fn a_drop_wakes_a_lake_that_has_slept_for_an_hour() {
    let (mut simulation, mut reference) = (Simulation::of(lake()), without_sleep(lake()));
    until_asleep(&mut simulation, 400);
    reference.run(400);
    let lake = simulation.particles().len();
    let before = (work(&simulation), simulation.hash());
    simulation.run(60 * 60 * 60);
    assert_eq!((work(&simulation), simulation.hash()), before, "an hour of sleep leaves traces");
    let drop = Intent::Stamp { element: WATER, stroke: disc(Vec2::new(40.0, 60.0), 3.0) };
    for world in [&mut simulation, &mut reference] {
        world.push(drop.clone());
    }
    let radius = Preset::Balanced.quality().kernel_radius;
    let mut woke = None;
    for tick in 1..=360 {
        simulation.run(1);
        reference.run(1);
        if asleep(&simulation) > 0 {
            assert_eq!(asleep(&simulation), lake, "the lake is one body");
            assert!(gap(&simulation) > 2.0 * radius, "tick {tick}: the drop is in the lake, and it sleeps");
        } else {
            woke.get_or_insert(tick);
        }
        // How high the surface stands says nothing while the drops of the crown fly, each its own way.
        let (share, _) = apart(&simulation, &reference);
        assert!(share < 0.06, "tick {tick}: a share of {share} is elsewhere");
    }
    // From 57 d to 28 d at 98.1 d/s² takes 46 ticks.
    let woke = woke.expect("a drop fell into the lake");
    assert!((40..=50).contains(&woke), "the lake woke after {woke} ticks");
}

#[test]
fn the_fastest_shot_does_not_get_in_unseen() {
    for speed in [60.0, 600.0, 3000.0] {
        let mut simulation = Simulation::of(lake());
        until_asleep(&mut simulation, 400);
        let at = Vec2::new(40.0, 65.0);
        let id = 1_000_000;
        simulation.particles_mut().push(id, WATER, at, Vec2::new(0.0, -speed));
        for tick in 0..120 {
            simulation.run(1);
            if asleep(&simulation) == 0 {
                break;
            }
            assert!(gap(&simulation) > 5.0, "{speed} d/s, tick {tick}: {} d", gap(&simulation));
        }
        assert_eq!(asleep(&simulation), 0, "{speed} d/s: nothing woke");
    }
}

#[test]
fn a_brush_wakes_the_pond_that_it_takes_from_and_no_other() {
    let (mut simulation, mut reference) = (Simulation::of(two_ponds()), without_sleep(two_ponds()));
    until_asleep(&mut simulation, 600);
    assert_eq!(asleep(&simulation), 1400);
    reference.run(simulation.get::<Clock>().tick as u32);
    let left_alone: Vec<u32> = {
        let particles = simulation.particles();
        (0..1400).filter(|&i| particles.x[i] > 79.0).map(|i| particles.id[i]).collect()
    };
    let stroke = Stroke::rectangle(Vec2::new(0.0, 10.0), Vec2::new(15.0, 40.0));
    for world in [&mut simulation, &mut reference] {
        world.push(Intent::Erase { stroke }).run(1);
    }
    let sleepers = simulation.particles().id[..asleep(&simulation)].to_vec();
    assert_eq!(sleepers, left_alone, "the right pond sleeps on, in its order");
    for _ in 0..6 {
        simulation.run(10);
        reference.run(10);
        assert_eq!(asleep(&simulation), 800);
        let (share, _) = apart(&simulation, &reference);
        println!("share {share}");
        assert!(share < 0.08, "a share of {share} is elsewhere");
    }
}

#[test]
fn a_drain_wakes_the_pond_that_it_empties() {
    let mut simulation = Simulation::of(two_ponds());
    until_asleep(&mut simulation, 600);
    let area = Rect { min: Vec2::new(0.0, 0.0), max: Vec2::new(3.0, 3.0) };
    simulation.get_mut::<Sources>().drains.push(Drain { area });
    simulation.run(1);
    assert_eq!(asleep(&simulation), 800);
    simulation.run(200);
    let left = simulation.particles().x.iter().filter(|&&x| x < 30.0).count();
    assert!(left < 400, "{left} of 600 are left");
}

#[test]
fn a_lake_whose_wall_is_taken_away_breaks_out_as_if_it_had_never_slept() {
    let world = || {
        let mut world = dry_box(120, 60);
        world.pool((0, 0), (30, 40));
        world.rock((30, 0), (32, 60));
        world
    };
    let (mut simulation, mut reference) = (Simulation::of(world()), without_sleep(world()));
    until_asleep(&mut simulation, 600);
    let ticks = simulation.get::<Clock>().tick;
    reference.run(ticks as u32);
    let wall = Stroke::rectangle(Vec2::new(29.9, 0.0), Vec2::new(32.1, 60.0));
    for world in [&mut simulation, &mut reference] {
        world.push(Intent::Erase { stroke: wall }).run(1);
    }
    assert_eq!(asleep(&simulation), 0, "the wall is gone, and the lake sleeps");
    for _ in 0..6 {
        simulation.run(10);
        reference.run(10);
        let (share, height) = apart(&simulation, &reference);
        println!("share {share}, height {height}");
        assert!(share < 0.08, "a share of {share} is elsewhere, the surface is {height} d off");
    }
}

#[test]
fn rock_drawn_into_sleeping_water_wakes_it() {
    let mut simulation = Simulation::of(lake());
    until_asleep(&mut simulation, 400);
    simulation.push(Intent::Draw { element: ROCK, stroke: disc(Vec2::new(40.0, 60.0), 2.0) }).run(1);
    assert_eq!(asleep(&simulation), 0);
}

#[test]
fn wind_wakes_a_lake_in_the_tick_in_which_it_blows() {
    let mut simulation = Simulation::of(lake_in_air());
    until_asleep(&mut simulation, 2000);
    let lake = asleep(&simulation);
    // Too faint to tilt the lake by a thousandth, and far above it.
    simulation.push(Intent::Blow { stroke: disc(Vec2::new(40.0, 60.0), 3.0), velocity: Vec2::new(0.01, 0.0) }).run(3);
    assert_eq!(asleep(&simulation), lake, "a breath of air wakes it");
    simulation.push(Intent::Blow { stroke: disc(Vec2::new(40.0, 24.0), 6.0), velocity: Vec2::new(120.0, 0.0) }).run(1);
    assert_eq!(asleep(&simulation), 0, "the wind blows, and the lake sleeps");
}

#[test]
fn other_conditions_wake_all() {
    let changes: [fn(&mut Simulation); 3] = [
        |simulation| {
            let quality = Preset::Fine.quality();
            simulation.push(Intent::Quality { preset: Preset::Fine, quality });
        },
        |simulation| simulation.get_mut::<Effects>().get_mut(Effect::Sleep).mode = Mode::Off,
        |simulation| {
            simulation.push(Intent::Gravity { gravity: Vec2::new(98.1, 0.0) });
        },
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let mut simulation = Simulation::of(lake());
        until_asleep(&mut simulation, 400);
        change(&mut simulation);
        simulation.run(1);
        assert_eq!(asleep(&simulation), 0, "change {k}");
        assert!(simulation.calls(Pass::Solve) > 0);
    }
}
