//! Gauges against what is known: the weight of water, counts of what went by, and worlds that must not feel them.

use super::{
    crossings::{Crossings, Moved, crosses},
    place::Place,
    quantity::{QUANTITIES, Quantity},
    set::{Gauge, Gauges, MOST, Reading, flow},
    spot::SpotReading,
    table::{self, Readings},
};
use crate::{
    kernel::{element::ElementId, params::Preset, particles::Particles},
    lab::{
        run::{self, Observer, Plan},
        testing,
    },
    scene::{
        self,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{
        checkpoint::Checkpoint,
        simulation::Simulation,
        state::{Clock, ParticleStore, Setup, SleepState},
        workers::Workers,
    },
};
use bevy::prelude::World;
use glam::Vec2;
use std::sync::Arc;

/// Standard gravity, m/s², and the density of water, kg/m².
const WEIGHT: f64 = 9.81 * 1000.0;

fn simulation(scene: &str, settings: &[(&str, &str)], preset: Option<Preset>, modes: &[(Effect, Mode)]) -> Simulation {
    let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let modes: EffectModes = modes.iter().copied().collect();
    let blueprint = scene::load(scene).unwrap().build(&settings, preset, &modes).unwrap();
    Simulation::new(Arc::new(blueprint), Workers::single())
}

fn spot(x: f32, y: f32, radius: f32) -> Place {
    Place::Spot { at: Vec2::new(x, y), radius }
}

fn line(from: (f32, f32), to: (f32, f32)) -> Place {
    Place::Line { from: from.into(), to: to.into() }
}

/// Runs so many ticks, and reads after each.
fn run(simulation: &mut Simulation, gauges: &mut Gauges, ticks: u32) {
    for _ in 0..ticks {
        simulation.tick();
        gauges.read(simulation.world());
    }
}

fn read(gauge: &Gauge) -> SpotReading {
    match gauge.latest() {
        Some(Reading::Spot(reading)) => *reading,
        other => panic!("{other:?} is no reading of a place"),
    }
}

#[test]
fn in_still_water_the_pressure_is_the_weight_above() {
    for (preset, sleep) in [
        (Preset::Fast, Mode::Off),
        (Preset::Balanced, Mode::Off),
        (Preset::Balanced, Mode::Auto),
        (Preset::Fine, Mode::Off),
    ] {
        let mut simulation =
            simulation("hydrostatic", &[("columns", "30"), ("depth", "30")], Some(preset), &[(Effect::Sleep, sleep)]);
        let mut gauges = Gauges::default();
        let depths = [0.2_f32, 0.5, 1.0, 1.7, 2.5, 2.9];
        for depth in depths {
            gauges.set(simulation.world(), spot(1.5, 3.0 - depth, 0.3)).unwrap();
        }
        run(&mut simulation, &mut gauges, 900);
        let asleep = simulation.get::<SleepState>().asleep();
        assert_eq!(asleep > 0, sleep == Mode::Auto, "{preset:?}: {asleep} sleep");
        for (gauge, depth) in gauges.iter().zip(depths) {
            let last: Vec<f64> = gauge.samples().rev().take(60).map(|sample| pressure(&sample.reading)).collect();
            let expected = WEIGHT * f64::from(depth);
            let worst = last.iter().map(|found| (found - expected).abs()).fold(0.0, f64::max);
            println!(
                "{preset:?} {sleep:?} depth {depth}: {:.0} Pa, expected {expected:.0}, off by {worst:.0} at most",
                last[0]
            );
            assert!(worst < 490.0, "{preset:?} {sleep:?}, {depth} m deep: off by {worst} Pa, half a spacing is 490");
            let reading = read(gauge);
            assert!((reading.density.unwrap() - 1000.0).abs() < 60.0, "{depth} m deep: {reading:?}");
            assert!((reading.temperature.unwrap() - 20.0).abs() < 0.01 && reading.speed.unwrap() < 0.05, "{reading:?}");
        }
    }
}

fn pressure(reading: &Reading) -> f64 {
    value("pressure_pa", reading).expect("there is liquid")
}

fn value(column: &str, reading: &Reading) -> Option<f64> {
    QUANTITIES.iter().find(|quantity| quantity.column == column).and_then(|quantity| quantity.value(reading))
}

#[test]
fn a_world_that_stands_can_be_read_at_once_also_where_it_sleeps() {
    let mut simulation = simulation("hydrostatic", &[("columns", "30"), ("depth", "20")], None, &[]);
    simulation.run(900);
    assert!(simulation.get::<SleepState>().asleep() > 0);
    let again = Simulation::resume(&Checkpoint::of(simulation.world()), Workers::single());
    for world in [simulation.world(), again.world()] {
        let mut gauges = Gauges::default();
        gauges.set(world, spot(1.5, 1.0, 0.3)).unwrap();
        let found = pressure(gauges.iter().next().unwrap().latest().unwrap());
        assert!((found - WEIGHT).abs() < 490.0, "{found} Pa, a metre deep");
    }
}

#[test]
fn without_the_predictor_there_is_no_pressure_but_all_else() {
    let mut simulation = simulation("hydrostatic", &[("columns", "20"), ("depth", "10")], Some(Preset::Classic), &[]);
    let mut gauges = Gauges::default();
    gauges.set(simulation.world(), spot(1.0, 0.5, 0.3)).unwrap();
    run(&mut simulation, &mut gauges, 60);
    let reading = read(gauges.iter().next().unwrap());
    assert_eq!(reading.pressure, None);
    assert!(reading.density.is_some_and(|density| density > 800.0) && reading.count > 10, "{reading:?}");
}

#[test]
fn what_is_empty_or_rock_says_so_and_nothing_is_no_number() {
    let mut simulation = simulation("waterfall", &[], None, &[]);
    let mut gauges = Gauges::default();
    // High up in the air, and deep in the cliff.
    gauges.set(simulation.world(), spot(16.0, 12.0, 0.3)).unwrap();
    gauges.set(simulation.world(), spot(1.0, 6.0, 0.3)).unwrap();
    run(&mut simulation, &mut gauges, 30);
    let [air, rock] = [0, 1].map(|k| read(gauges.iter().nth(k).unwrap()));
    assert_eq!((air.count, air.density, air.velocity, air.speed), (0, Some(0.0), None, None));
    assert_eq!((air.temperature, air.pressure), (None, None));
    assert!(air.air.is_some_and(|air| (air.temperature - 20.0).abs() < 1.0), "{air:?}");
    assert_eq!(rock, SpotReading::default());
    let text = table::text(&gauges);
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
}

#[test]
fn a_gauge_reads_what_moves_by_it() {
    let mut simulation = simulation("empty", &[("columns", "40"), ("rows", "40")], None, &[]);
    let velocity = Vec2::new(30.0, -20.0);
    let element = simulation.get::<Setup>().elements().find("mercury").unwrap();
    let sites = testing::lattice(40, 40, 1.0).into_iter().filter(|at| at.distance(Vec2::new(20.0, 20.0)) < 8.0);
    let mut particles = Particles::default();
    sites.enumerate().for_each(|(id, at)| particles.push(id as u32, element, at, velocity));
    simulation.get_mut::<ParticleStore>().0 = particles;
    let mut gauges = Gauges::default();
    gauges.set(simulation.world(), spot(2.0, 2.0, 0.3)).unwrap();
    let reading = read(gauges.iter().next().unwrap());
    assert!(reading.velocity.unwrap().distance(Vec2::new(3.0, -2.0)) < 1e-4, "{reading:?}");
    assert!((reading.speed.unwrap() - 13.0_f32.sqrt()).abs() < 1e-4, "{reading:?}");
    assert!((reading.density.unwrap() / 13_534.0 - 1.0).abs() < 0.01, "{reading:?}");
}

#[test]
fn a_wall_takes_no_density_away() {
    let mut simulation = simulation("empty", &[("columns", "40"), ("rows", "40")], None, &[]);
    let water = simulation.get::<Setup>().elements().find("water").unwrap();
    let mut particles = Particles::default();
    testing::lattice(40, 40, 1.0).into_iter().enumerate().for_each(|(id, at)| {
        particles.push(id as u32, water, at, Vec2::ZERO);
    });
    simulation.get_mut::<ParticleStore>().0 = particles;
    let mut gauges = Gauges::default();
    for at in [(0.0, 2.0), (2.0, 4.0), (0.0, 0.0), (2.03, 2.01)] {
        gauges.set(simulation.world(), spot(at.0, at.1, 0.3)).unwrap();
        let density = read(gauges.iter().last().unwrap()).density.unwrap();
        assert!((density - 1000.0).abs() < 20.0, "{at:?}: {density}");
    }
}

/// Water in a dam that breaks: between two walls nothing comes and nothing goes, so what went through a line from floor to ceiling
/// is what there is more of beyond it.
#[test]
fn what_crosses_a_line_is_what_is_beyond_it() {
    let mut simulation = simulation("dam_break", &[("columns", "20")], None, &[]);
    let mut gauges = Gauges::default();
    let top = 2.1 * 20.0 * 0.1;
    let places: [f32; 3] = [1.0, 2.5, 6.03];
    let beyond = |world: &World, x: f32| -> i64 {
        world.resource::<ParticleStore>().x.iter().filter(|at| **at > 10.0 * x).count() as i64
    };
    let before = places.map(|x| beyond(simulation.world(), x));
    for x in places {
        gauges.set(simulation.world(), line((x, 0.0), (x, top))).unwrap();
        gauges.set(simulation.world(), line((x, top), (x, 0.0))).unwrap();
    }
    let mut sums = [0.0; 3];
    for _ in 0..200 {
        run(&mut simulation, &mut gauges, 1);
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += value("flow_m2_per_s", gauges.iter().nth(2 * k).unwrap().latest().unwrap()).unwrap();
        }
    }
    for (k, x) in places.into_iter().enumerate() {
        let went = beyond(simulation.world(), x) - before[k];
        let [there, back] =
            [0, 1].map(|way| value("crossed", gauges.iter().nth(2 * k + way).unwrap().latest().unwrap()));
        assert_eq!((there, back), (Some(went as f64), Some(-went as f64)), "at {x} m");
        // d² each, over 200 ticks.
        let volume = went as f64 * 0.01;
        assert!((sums[k] / 60.0 - volume).abs() < 1e-5, "at {x} m: {} m² and not {volume}", sums[k] / 60.0);
        let mean = value("mean_flow_m2_per_s", gauges.iter().nth(2 * k).unwrap().latest().unwrap()).unwrap();
        assert!((mean - volume * 60.0 / 200.0).abs() < 1e-5, "at {x} m: {mean}");
    }
    assert!(value("crossed", gauges.iter().nth(2).unwrap().latest().unwrap()).unwrap() > 100.0, "the dam breaks");
}

#[test]
fn through_lines_that_meet_all_goes_once_and_elements_add_up() {
    let mut simulation = simulation("dam_break", &[("columns", "20")], None, &[]);
    let elements = simulation.get::<Setup>().elements().clone();
    let [water, oil] = ["water", "oil"].map(|name| elements.find(name).unwrap());
    simulation.get_mut::<ParticleStore>().element.iter_mut().step_by(3).for_each(|element| *element = oil);
    let mut gauges = Gauges::default();
    for (from, to) in [(0.0, 4.2), (0.0, 0.333), (0.333, 1.7), (1.7, 4.2)] {
        gauges.set(simulation.world(), line((2.5, from), (2.5, to))).unwrap();
    }
    run(&mut simulation, &mut gauges, 150);
    let crossed = |element| gauges.iter().map(|gauge| gauge.crossed(element)[0]).collect::<Vec<_>>();
    let (of_water, of_oil) = (crossed(water), crossed(oil));
    for (k, gauge) in gauges.iter().enumerate() {
        let all = value("crossed", gauge.latest().unwrap()).unwrap() as i64;
        assert_eq!(of_water[k] + of_oil[k], all, "gauge {k}");
    }
    assert!(of_water[0] > 0 && of_oil[0] > 0, "{of_water:?} {of_oil:?}");
    for of in [of_water, of_oil] {
        assert_eq!(of[0], of[1] + of[2] + of[3], "{of:?}");
    }
    assert!((flow(simulation.get(), 3) - 3.0 * 0.01 * 60.0).abs() < 1e-6);
}

#[test]
fn crossings_do_not_depend_on_the_order_of_particles_nor_on_those_that_come_and_go() {
    let element = ElementId(1);
    let particles = |places: &[(u32, f32)]| {
        let mut particles = Particles::default();
        places.iter().for_each(|(id, x)| particles.push(*id, element, Vec2::new(*x, 1.0), Vec2::ZERO));
        particles
    };
    let (a, b) = (Vec2::new(5.0, 0.0), Vec2::new(5.0, 9.0));
    for shift in 0..5 {
        let turned = |mut places: Vec<(u32, f32)>| {
            places.rotate_left(shift);
            particles(&places)
        };
        let mut crossings = Crossings::default();
        crossings.look(&turned(vec![(1, 4.0), (7, 4.5), (3, 6.0), (9, 4.9), (20, 1.0)]));
        let mut net = Vec::new();
        // 1 and 9 go over, 3 comes back, 7 stays, 20 goes away and 30 comes beyond the line.
        let next = turned(vec![(9, 5.1), (30, 8.0), (3, 4.0), (7, 4.5), (1, 7.0)]);
        crossings.follow(&next, |moved| net.push(crosses(&moved, a, b)));
        assert_eq!(net, [1, -1, 1], "in the order of their numbers: 1, 3, 9");
    }
}

#[test]
fn a_way_to_and_fro_adds_up_to_nothing_and_beside_a_line_nothing_counts() {
    let (a, b) = (Vec2::new(2.0, 0.0), Vec2::new(2.0, 4.0));
    let crosses = |from: (f32, f32), to: (f32, f32)| {
        crosses(&Moved { element: ElementId(0), from: from.into(), to: to.into() }, a, b)
    };
    assert_eq!(crosses((1.0, 1.0), (3.0, 1.0)), 1, "upwards, its right is the world's");
    assert_eq!(crosses((3.0, 1.0), (1.0, 1.0)), -1);
    // Over the line, and onto it and from there on.
    assert_eq!(crosses((1.0, 1.0), (2.0, 1.0)) + crosses((2.0, 1.0), (3.0, 1.0)), 1);
    assert_eq!(crosses((3.0, 1.0), (2.0, 1.0)) + crosses((2.0, 1.0), (3.0, 1.0)), 0);
    assert_eq!(crosses((1.0, 5.0), (3.0, 5.0)), 0, "beyond its end");
    assert_eq!(
        (crosses((1.0, 0.0), (3.0, 0.0)), crosses((1.0, 4.0), (3.0, 4.0))),
        (1, 0),
        "one of its ends is its own"
    );
    assert_eq!(crosses((1.0, 3.0), (1.9, 8.0)), 0);
}

#[test]
fn the_world_does_not_feel_them_and_without_one_nothing_is_held() {
    let hash = |gauges: Option<Gauges>| {
        let mut simulation = simulation("waterfall", &[], None, &[]);
        let mut readings = gauges.map(|mut gauges| {
            for place in [spot(12.0, 2.0, 0.3), spot(6.0, 7.2, 0.5), line((5.0, 6.0), (5.0, 12.0))] {
                gauges.set(simulation.world(), place).unwrap();
            }
            Readings::begin(gauges, Vec::new(), Vec::new())
        });
        let mut observers: Vec<&mut dyn Observer> = Vec::new();
        observers.extend(readings.as_mut().map(|readings| readings as &mut dyn Observer));
        run::run(&mut simulation, &Plan { ticks: 90, ..Plan::default() }, &mut observers).unwrap();
        simulation.hash()
    };
    assert_eq!(hash(Some(Gauges::default())), hash(None));
    let mut gauges = Gauges::default();
    let simulation = simulation("dam_break", &[("columns", "8")], None, &[]);
    gauges.set(simulation.world(), line((1.0, 0.0), (1.0, 1.0))).unwrap();
    assert!(gauges.held() > 0);
    assert!(gauges.remove(1) && !gauges.remove(1));
    gauges.read(simulation.world());
    assert_eq!((gauges.held(), gauges.is_empty()), (0, true));
}

#[test]
fn going_back_forgets_what_came_later_and_a_new_scene_has_no_gauges() {
    let mut simulation = simulation("dam_break", &[("columns", "12")], None, &[]);
    let mut gauges = Gauges::default();
    gauges.set(simulation.world(), spot(1.0, 0.5, 0.3)).unwrap();
    gauges.set(simulation.world(), line((1.5, 0.0), (1.5, 2.0))).unwrap();
    run(&mut simulation, &mut gauges, 30);
    let early = Checkpoint::of(simulation.world());
    run(&mut simulation, &mut gauges, 40);
    let ticks = |gauges: &Gauges| gauges.iter().next().unwrap().samples().map(|sample| sample.tick).collect::<Vec<_>>();
    assert_eq!(ticks(&gauges), (0..=70).collect::<Vec<_>>());
    early.restore(simulation.world_mut());
    gauges.follow(simulation.world());
    assert_eq!(ticks(&gauges), (0..30).collect::<Vec<_>>());
    run(&mut simulation, &mut gauges, 2);
    assert_eq!(ticks(&gauges), (0..30).chain(31..=32).collect::<Vec<_>>());
    assert_eq!(gauges.iter().nth(1).unwrap().since(), 30, "lines count anew from there");
    let other = scene::load("empty").unwrap().build(&[], None, &EffectModes::new()).unwrap();
    Checkpoint::of_scene(Arc::new(other)).restore(simulation.world_mut());
    run(&mut simulation, &mut gauges, 1);
    assert!(gauges.is_empty() && gauges.held() == 0);
}

#[test]
fn gauges_are_refused_where_they_can_not_be() {
    let simulation = simulation("empty", &[("columns", "40"), ("rows", "20")], None, &[]);
    let mut gauges = Gauges::default();
    for (place, says) in [
        (spot(4.1, 1.0, 0.3), "allowed: x from 0 to 4.0000, y from 0 to 2.0000 m"),
        (spot(1.0, -0.1, 0.3), "is not in the box"),
        (spot(1.0, 1.0, 0.0), "allowed: 0.1000 (a spacing) to 4.0000 m"),
        (spot(1.0, 1.0, 5.0), "a radius of 5 m"),
        (spot(1.0, 1.0, f32::NAN), "a radius"),
        (spot(f32::NAN, 1.0, 0.3), "is not in the box"),
        (line((1.0, 1.0), (1.0, 1.01)), "half a spacing"),
        (line((1.0, 1.0), (9.0, 1.0)), "is not in the box"),
    ] {
        let error = gauges.set(simulation.world(), place).unwrap_err();
        assert!(error.contains(says), "{place:?}: {error}");
    }
    let numbers: Vec<u32> = (0..MOST).map(|_| gauges.set(simulation.world(), spot(1.0, 1.0, 0.3)).unwrap()).collect();
    assert_eq!(numbers, (1..=MOST as u32).collect::<Vec<_>>());
    assert!(gauges.set(simulation.world(), spot(1.0, 1.0, 0.3)).unwrap_err().contains("8 at most"));
    gauges.remove(3);
    assert_eq!(gauges.set(simulation.world(), spot(1.0, 1.0, 0.3)), Ok(3), "the lowest number that is free");
    assert!(gauges.iter().map(|gauge| gauge.number).eq(1..=MOST as u32));
}

#[test]
fn a_table_has_a_column_for_each_quantity_and_a_line_for_each_tick() {
    let mut simulation = simulation("dam_break", &[("columns", "8")], None, &[]);
    let mut gauges = Gauges::default();
    gauges.set(simulation.world(), spot(0.4, 0.4, 0.3)).unwrap();
    run(&mut simulation, &mut gauges, 2);
    gauges.set(simulation.world(), line((1.0, 0.0), (1.0, 1.6))).unwrap();
    run(&mut simulation, &mut gauges, 3);
    let text = table::text(&gauges);
    let rows: Vec<Vec<&str>> = text.lines().map(|row| row.split(',').collect()).collect();
    let is_line = |quantity: &&Quantity| quantity.is_of(gauges.iter().nth(1).unwrap().latest().unwrap());
    let lines = QUANTITIES.iter().filter(is_line).count();
    assert_eq!(rows[0].len(), 2 + QUANTITIES.len());
    assert_eq!(rows[0][..4], ["tick", "time_s", "gauge1_speed_m_per_s", "gauge1_velocity_x_m_per_s"]);
    assert_eq!(
        rows[0][rows[0].len() - lines..],
        ["gauge2_flow_m2_per_s", "gauge2_mean_flow_m2_per_s", "gauge2_crossed"]
    );
    assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{text}");
    assert!(rows[1..].iter().map(|row| row[0]).eq(["0", "1", "2", "3", "4", "5"]), "{text}");
    let crossed: Vec<&str> = rows[1..].iter().map(|row| row[row.len() - 1]).collect();
    assert_eq!(crossed, ["", "", "", "0", "0", "0"], "the line was set after the second tick");
    assert!(rows[1..].iter().flatten().all(|field| field.is_empty() || field.parse::<f64>().is_ok()), "{text}");
    let clock = simulation.get::<Clock>().tick as f64;
    assert_eq!(rows[6][1].parse::<f64>().unwrap(), clock / 60.0);
}
