//! What heat must hold to as it spreads; `change`: what becomes of matter by it.

use super::{table::HeatTable, units::*, *};
use crate::{
    brush::{BrushShape, Stroke},
    element::{Category, Element, ElementChange, ElementId, ElementTable},
    parallel::Team,
    params::Domain,
    particles::Particles,
    random::Random,
    relabel::Relabelled,
    simd::InstructionSet,
    solids::{Solids, centre},
    units::{Scale, TICK_SECONDS},
};
use glam::{IVec2, Vec2};

mod change;

/// A box of matter, tick after tick.
struct Bench {
    elements: ElementTable,
    table: HeatTable,
    domain: Domain,
    scale: Scale,
    particles: Particles,
    solids: Solids,
    heat: Heat,
    record: HeatRecord,
    relabelled: Relabelled,
    report: HeatReport,
}

const ROCK: ElementId = ElementId(0);
const WATER: ElementId = ElementId(1);
const ICE: ElementId = ElementId(2);
const STEAM: ElementId = ElementId(3);
const ASH: ElementId = ElementId(4);
const METAL: ElementId = ElementId(5);
const LAVA: ElementId = ElementId(6);
const SNOW: ElementId = ElementId(7);
const GLASS: ElementId = ElementId(8);
const BRINE: ElementId = ElementId(9);
/// As glass, but that it moves.
const SHARDS: ElementId = ElementId(10);

fn row_change(above: Option<f32>, below: Option<f32>, into: &[&str], latent: Option<f32>) -> ElementChange {
    ElementChange { above, below, into: into.iter().map(|name| (*name).to_owned()).collect(), latent }
}

impl Bench {
    fn new(size: Vec2, spacing: f32) -> Self {
        let row = |name: &str, fixed, capacity, conductivity, changes| Element {
            capacity,
            conductivity,
            changes,
            ..Element::plain(name, fixed)
        };
        let elements = ElementTable::new(vec![
            row("rock", true, 2.2, 2.5, vec![row_change(Some(1430.0), None, &["lava"], Some(900.0))]),
            row(
                "water",
                false,
                4.19,
                0.6,
                vec![
                    row_change(None, Some(273.0), &["ice"], Some(334.0)),
                    row_change(Some(373.0), None, &["steam"], Some(452.0)),
                ],
            ),
            row("ice", false, 1.93, 2.2, vec![row_change(Some(273.0), None, &["water"], None)]),
            row("steam", false, 0.3, 0.025, vec![row_change(None, Some(373.0), &["water"], None)]),
            row("ash", false, 0.3, 0.07, vec![]),
            row("metal", false, 3.5, 80.0, vec![]),
            row("lava", false, 2.9, 1.5, vec![row_change(None, Some(1000.0), &["glass"], None)]),
            row("snow", false, 0.42, 0.1, vec![row_change(Some(273.0), None, &["water", "air", "air"], Some(67.0))]),
            row("glass", true, 2.1, 1.0, vec![]),
            row("brine", false, 4.0, 0.6, vec![row_change(Some(375.0), None, &["steam", "ash"], None)]),
            row("shards", false, 2.1, 1.0, vec![]),
        ]);
        let cells = size.ceil().as_uvec2();
        Self {
            table: HeatTable::new(&elements),
            elements,
            domain: Domain { size, gravity: Vec2::ZERO },
            scale: Scale::own(spacing),
            particles: Particles::default(),
            solids: Solids::new(cells.x, cells.y),
            heat: Heat::default(),
            record: HeatRecord::default(),
            relabelled: Relabelled::default(),
            report: HeatReport::default(),
        }
    }

    /// Fills the box with lumps, off the lattice by up to `scatter` d. `what`: element and temperature at a place.
    fn fill(mut self, scatter: f32, what: impl Fn(Vec2) -> Option<(ElementId, f32)>) -> Self {
        let mut random = Random::new(7);
        for y in 0..self.solids.rows() {
            for x in 0..self.solids.columns() {
                let at = centre(IVec2::new(x, y));
                let off = scatter * Vec2::new(random.offset(), random.offset());
                if let Some((element, kelvin)) = what(at) {
                    let heat = self.table.curve(element).heat(kelvin);
                    self.particles.push_warm(self.particles.len() as u32, element, at + off, Vec2::ZERO, heat);
                }
            }
        }
        self
    }

    fn warm(&mut self) -> (Warm<'_>, &mut Heat, &mut HeatRecord, &mut Relabelled) {
        let Self { elements, table, domain, scale, particles, solids, heat, record, relabelled, .. } = self;
        (Warm { particles, solids, elements, table, domain, scale: *scale }, heat, record, relabelled)
    }

    fn flow(&mut self, threads: usize) {
        self.flow_on(InstructionSet::detect(), threads);
    }

    fn flow_on(&mut self, instructions: InstructionSet, threads: usize) {
        let (mut warm, heat, record, _) = self.warm();
        let report = heat.flow(&mut warm, record, Team { instructions, threads }, TICK_SECONDS);
        self.report.cuts += report.cuts;
    }

    fn change(&mut self) {
        let (mut warm, _, record, relabelled) = self.warm();
        change(&mut warm, record, relabelled);
    }

    fn tick(&mut self) {
        self.change();
        self.flow(1);
    }

    /// All heat, also that of the air and less that of tools, quanta.
    fn total(&self) -> i64 {
        held(&self.particles, &self.solids) + self.record.outside()
    }

    /// Heat of an element at a temperature that it can have, to 3,050 K.
    fn any_heat(&self, element: ElementId, random: &mut Random) -> i32 {
        let curve = self.table.curve(element);
        let [coldest, hottest] = curve.stays_between().map(|kelvin| kelvin.clamp(50.0, 3050.0));
        curve.heat(coldest + (hottest - coldest) * random.share())
    }

    fn kelvin(&self, i: usize) -> f32 {
        self.table.curve(self.particles.element[i]).temperature(self.particles.heat_of(i))
    }

    fn count(&self, element: ElementId) -> usize {
        self.particles.element.iter().filter(|other| **other == element).count()
    }
}

/// The error function (Abramowitz & Stegun 7.1.26), to 1.5·10⁻⁷.
fn erf(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x.abs());
    let sum = [1.061_405_429, -1.453_152_027, 1.421_413_741, -0.284_496_736, 0.254_829_592];
    let series = sum.into_iter().fold(0.0, |sum, term| (sum + term) * t);
    (1.0 - series * (-x * x).exp()).copysign(x)
}

#[test]
fn heat_in_a_bar_spreads_as_the_law_has_it() {
    let (length, spacing) = (80.0, 0.1);
    let filled = |at: Vec2| Some((METAL, if at.x < 0.5 * length { 400.0 } else { 300.0 }));
    let mut bench = Bench::new(Vec2::new(length, 12.0), spacing).fill(0.1, filled);
    let seconds = 2.0;
    (0..(seconds / TICK_SECONDS) as u32).for_each(|_| bench.tick());
    let diffusivity = 6e4 * (0.6_f64 * 80.0).sqrt() / 3.5e6;
    let spread = 2.0 * (diffusivity * f64::from(seconds)).sqrt() / f64::from(spacing);
    let error = |i: usize| {
        let at = bench.particles.position(i);
        let expected = 350.0 - 50.0 * erf(f64::from(at.x - 0.5 * length) / spread);
        f64::from(bench.kelvin(i)) - expected
    };
    let square = (0..bench.particles.len()).map(|i| error(i).powi(2)).sum::<f64>() / bench.particles.len() as f64;
    // 1 % of the difference.
    assert!(square.sqrt() < 1.0, "{} K rms", square.sqrt());
    assert_eq!(bench.report.cuts, 0);
}

#[test]
fn what_one_gets_the_other_gives_to_the_last_quantum() {
    for spacing in [0.01, 0.1, 1.0] {
        let mut random = Random::new(3);
        let mut bench = Bench::new(Vec2::new(40.0, 30.0), spacing);
        for id in 0..1500 {
            let element = [WATER, ICE, STEAM, ASH, METAL, LAVA, SNOW][random.below(7)];
            // Crowds among them.
            let at = Vec2::new(20.0 * random.share(), 30.0 * random.share() * random.share());
            let heat = bench.any_heat(element, &mut random);
            bench.particles.push_warm(id, element, at, Vec2::ZERO, heat);
        }
        for x in 20..40 {
            for y in 0..30 {
                let (cell, element) = (IVec2::new(x, y), [ROCK, GLASS][random.below(2)]);
                bench.solids.insert(cell, element, 10_000 + (30 * x + y) as u32);
                bench.solids.set_heat(cell, bench.any_heat(element, &mut random));
            }
        }
        let total = bench.total();
        for _ in 0..200 {
            bench.tick();
            assert_eq!(bench.total(), total, "at d = {spacing}");
        }
        for i in 0..bench.particles.len() {
            assert!((49.0..3100.0).contains(&bench.kelvin(i)), "{} K at d = {spacing}", bench.kelvin(i));
        }
    }
}

#[test]
fn rock_exchanges_what_it_would_if_it_could_move() {
    // A block with holes and thin walls. At the finer spacings a tick has several steps, and not all gets what it asks for.
    let is_there =
        |x: i32, y: i32| !(x % 11 == 5 && y < 20 || (x - 30).abs() + (y - 12).abs() < 4 || x > 50 && x % 4 > 1);
    let ticks = 40;
    for spacing in [0.1, 0.03, 0.01] {
        let run = |is_rock: fn(i32, i32) -> bool| {
            let mut random = Random::new(9);
            let mut bench = Bench::new(Vec2::new(67.0, 30.0), spacing);
            let sites = (0..30).flat_map(|y| (0..67).map(move |x| (x, y))).filter(|(x, y)| is_there(*x, *y));
            for (id, (x, y)) in (0..).zip(sites.clone()) {
                let (cell, heat) = (IVec2::new(x, y), bench.any_heat(GLASS, &mut random));
                if is_rock(x, y) {
                    bench.solids.insert(cell, GLASS, id);
                    bench.solids.set_heat(cell, heat);
                } else {
                    bench.particles.push_warm(id, SHARDS, centre(cell), Vec2::ZERO, heat);
                }
            }
            (0..ticks).for_each(|_| bench.flow(1));
            let mut heats: Vec<i32> = sites.map(|(x, y)| bench.solids.heat(IVec2::new(x, y))).collect();
            for i in 0..bench.particles.len() {
                heats[bench.particles.id[i] as usize] = bench.particles.heat_of(i);
            }
            heats
        };
        let moves = run(|_, _| false);
        assert!(moves.iter().any(|heat| *heat > 1_000_000));
        for (name, is_rock) in [
            ("all", (|_, _| true) as fn(i32, i32) -> bool),
            ("every other", |x, y| (x + y) % 2 == 0),
            ("a half", |x, y| x + y > 40),
            ("thin walls", |x, _| x % 9 < 2),
        ] {
            // Sums in another order differ by roundings: of what is cut and of what the air takes, a quantum a step at most.
            let furthest = run(is_rock).iter().zip(&moves).map(|(own, other)| own.abs_diff(*other)).max();
            let allowed = 8 * ticks;
            assert!(furthest.is_some_and(|most| most <= allowed), "{furthest:?} quanta, {name} at d = {spacing}");
        }
    }
}

#[test]
fn no_temperature_leaves_the_range_of_those_around_it() {
    // Metal beside ash at a spacing at which a step is far too long for it, and a crowd.
    for spacing in [0.1, 0.03, 0.01] {
        let warmth = |at: Vec2| if (at.x as u32 + at.y as u32).is_multiple_of(2) { 1000.0 } else { 293.0 };
        let filled = |at: Vec2| Some((if at.x < 10.0 { METAL } else { ASH }, warmth(at)));
        let mut bench = Bench::new(Vec2::new(20.0, 20.0), spacing).fill(0.3, filled);
        for id in 0..50 {
            let heat = bench.table.curve(ASH).heat(1000.0);
            bench.particles.push_warm(10_000 + id, ASH, Vec2::splat(15.0), Vec2::ZERO, heat);
        }
        for _ in 0..20 {
            bench.flow(1);
            for i in 0..bench.particles.len() {
                assert!((292.99..1000.01).contains(&bench.kelvin(i)), "{} K at d = {spacing}", bench.kelvin(i));
            }
        }
        assert!(spacing > 0.05 || bench.report.cuts > 0, "what is held back at d = {spacing} is not counted");
    }
}

#[test]
fn a_front_that_enters_cold_matter_within_a_tick_keeps_all_heat() {
    // At this spacing a tick has several steps, and its later ones reach cells in which nothing flowed in the first.
    let filled = |at: Vec2| Some((METAL, if at.x < 6.0 { 3000.0 } else { 293.0 }));
    let mut bench = Bench::new(Vec2::new(60.0, 6.0), 0.02).fill(0.3, filled);
    let total = bench.total();
    let reach = |bench: &Bench| (0..bench.particles.len()).filter(|i| bench.particles.heat_of(*i) > 0).count();
    let mut reached = reach(&bench);
    for tick in 0..40 {
        bench.flow(1);
        assert_eq!(bench.total(), total, "quanta after tick {tick}");
        assert!(reach(&bench) >= reached);
        reached = reach(&bench);
    }
    assert!(reached > 200, "the front stood: {reached} of 360 warm");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no threads")]
fn any_number_of_threads_finds_the_same() {
    let run = |threads: usize, spacing: f32| {
        let filled = |at: Vec2| match at.y {
            ..20.0 => Some((WATER, 293.0)),
            ..40.0 => Some((LAVA, 1600.0)),
            _ => None,
        };
        let mut bench = Bench::new(Vec2::new(60.0, 80.0), spacing).fill(0.2, filled);
        for (id, (x, y)) in (10_000..).zip((40..80).flat_map(|y| (0..60).map(move |x| (x, y)))) {
            bench.solids.insert(IVec2::new(x, y), ROCK, id);
        }
        (0..30).for_each(|_| bench.flow(threads));
        assert!(bench.solids.heats().iter().filter(|heat| **heat != 0).count() > 300, "no rock is warmed");
        (bench.particles, bench.solids)
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    // At the finer one not all gets what it asks for.
    for spacing in [0.1, 0.01] {
        assert!(pool.install(|| run(3, spacing)) == run(1, spacing), "at d = {spacing}");
    }
}

#[test]
fn any_instruction_set_finds_the_same() {
    let elements = [WATER, STEAM, ASH, METAL, LAVA, SNOW, BRINE];
    let run = |set: InstructionSet, spacing: f32| {
        let mut random = Random::new(3);
        let mut filled = move |_| {
            let (element, kelvin) = (elements[random.below(elements.len())], [280.0, 293.0, 340.0][random.below(3)]);
            (random.below(4) > 0).then_some((element, kelvin))
        };
        let random = std::cell::RefCell::new(&mut filled);
        let mut bench = Bench::new(Vec2::new(61.0, 23.0), spacing).fill(0.45, |at| random.borrow_mut()(at));
        // A wall, and a block through which heat goes of itself.
        let rock = (0..20).flat_map(|y| (0..61).map(move |x| (x, y))).filter(|(x, _)| *x == 30 || (41..59).contains(x));
        for (id, (x, y)) in (10_000..).zip(rock) {
            bench.solids.insert(IVec2::new(x, y), ROCK, id);
            bench.solids.set_heat(IVec2::new(x, y), 1_000 * ((x * 7 + y * 13) % 29) * (x - 30));
        }
        for _ in 0..20 {
            bench.change();
            bench.flow_on(set, 1);
        }
        (bench.particles, bench.solids, bench.record, bench.report)
    };
    for spacing in [0.1, 0.03] {
        let expected = run(InstructionSet::Scalar, spacing);
        for set in InstructionSet::available() {
            assert!(run(set, spacing) == expected, "{} at d = {spacing}", set.name());
        }
    }
}

#[test]
fn where_all_is_as_warm_nothing_is_gathered() {
    let mut bench = Bench::new(Vec2::new(30.0, 30.0), 0.1).fill(0.2, |at| (at.y < 15.0).then_some((WATER, ROOM)));
    bench.tick();
    assert!(!bench.particles.has_heat() && bench.heat.memory() > 0);
    // Even where it has been warmer: less than half a quantum is nothing.
    bench.particles.set_heat(3, 1);
    let before = bench.particles.clone();
    bench.tick();
    assert_eq!((bench.particles, bench.record.to_air), (before, 0));
}

#[test]
fn a_lump_cools_in_the_air_as_newton_has_it() {
    // A plate of metal of 10 d in an empty room; both its faces lose h′ (T − 293 K).
    let filled = |at: Vec2| ((at.y - 15.0).abs() < 5.0).then_some((METAL, 493.0));
    let mut bench = Bench::new(Vec2::new(40.0, 30.0), 0.1).fill(0.0, filled);
    let mean = |bench: &Bench| {
        (0..bench.particles.len()).map(|i| f64::from(bench.kelvin(i))).sum::<f64>() / bench.particles.len() as f64
    };
    (0..1200).for_each(|_| bench.tick());
    // C dT/dt = −2 h′ (T_surface − 293 K); metal is nearly even: its surface is 1 % colder than the mean.
    let expected = 200.0 * (-2.0 * 1e4 * 20.0 / (3.5e6 * 1.0_f64)).exp();
    let left = mean(&bench) - 293.0;
    assert!((left / expected - 1.0).abs() < 0.02, "{left} K left, {expected} expected");
}

#[test]
fn what_one_step_is_enough_for_takes_one_beside_what_takes_more() {
    let lava = |at: Vec2| (at.x < 20.0).then_some((LAVA, if at.y < 8.0 { 1400.0 } else { 1100.0 }));
    let bar_in_ash = |at: Vec2| {
        let element = if at.y < 10.0 { METAL } else { ASH };
        (at.x > 40.0).then_some((element, if at.y < 5.0 { 1500.0 } else { 300.0 }))
    };
    let mut alone = Bench::new(Vec2::new(60.0, 16.0), 0.05).fill(0.2, lava);
    let mut beside = Bench::new(Vec2::new(60.0, 16.0), 0.05).fill(0.2, |at| lava(at).or_else(|| bar_in_ash(at)));
    let heats = |bench: &Bench| -> Vec<i32> {
        let lava = (0..bench.particles.len()).filter(|i| bench.particles.element[*i] == LAVA);
        lava.map(|i| bench.particles.heat_of(i)).collect()
    };
    let (start, total) = (heats(&alone), beside.total());
    assert_eq!(start.len(), 320);
    for tick in 0..60 {
        alone.flow(1);
        beside.flow(1);
        assert!(heats(&alone) == heats(&beside), "in tick {tick} the lava takes other steps beside a bar in ash");
    }
    assert!(heats(&alone) != start, "nothing flows");
    assert_eq!(beside.total(), total);
}

#[test]
fn a_tick_of_several_steps_lets_as_much_flow_as_shorter_ticks_of_one() {
    // A wave as long as two of the box, which dies away by 0.5 % a tick: by so much the steps may differ, and by no more than 1 %.
    let wave = |at: Vec2| Some((METAL, 350.0 - 50.0 * (std::f32::consts::PI / 40.0 * at.x).sin_cos().1));
    let bench = || Bench::new(Vec2::new(40.0, 10.0), 0.05).fill(0.0, wave);
    let gained = |ticks: u32| -> Vec<f64> {
        let mut bench = bench();
        let start = bench.particles.heat.clone();
        for _ in 0..ticks {
            let (mut warm, heat, record, _) = bench.warm();
            let team = Team { instructions: InstructionSet::detect(), threads: 1 };
            heat.flow(&mut warm, record, team, TICK_SECONDS / ticks as f32);
        }
        bench.particles.heat.iter().zip(start).map(|(heat, start)| f64::from(*heat) - f64::from(start)).collect()
    };
    let (whole, halves) = (gained(1), gained(2));
    let size = |of: &[f64]| of.iter().map(|gained| gained.abs()).sum::<f64>();
    let apart: Vec<f64> = whole.iter().zip(&halves).map(|(whole, halves)| whole - halves).collect();
    assert!(size(&halves) > 1e6 && size(&apart) < 0.01 * size(&halves), "{} of {}", size(&apart), size(&halves));
}
