//! What heat must hold to.

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
    let run = |threads: usize| {
        let filled =
            |at: Vec2| Some((if at.y < 20.0 { WATER } else { LAVA }, if at.y < 20.0 { 293.0 } else { 1600.0 }));
        let mut bench = Bench::new(Vec2::new(60.0, 40.0), 0.1).fill(0.2, filled);
        (0..30).for_each(|_| bench.flow(threads));
        bench.particles
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    assert_eq!(pool.install(|| run(3)), run(1));
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
        for y in 0..20 {
            bench.solids.insert(IVec2::new(30, y), ROCK, 10_000 + y as u32);
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
fn boiling_takes_as_long_as_the_heat_takes_to_come() {
    let mut bench =
        Bench::new(Vec2::new(20.0, 20.0), 0.1).fill(0.0, |at| ((at - 10.0).length() < 3.0).then_some((WATER, 293.0)));
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::splat(10.0), 5.0);
    let mut ticks = 0;
    while bench.count(WATER) > 0 {
        let (mut warm, _, record, _) = bench.warm();
        warm_under(&mut warm, &stroke, 10.0, record);
        bench.change();
        ticks += 1;
    }
    // 80 K of slope and 452 MJ/m² at 4.19 MJ/m²K are 187.9 K.
    assert_eq!(ticks, 19);
    assert_eq!(bench.total(), 0);
    // Nothing is hotter than it can be, nor colder.
    let (mut warm, _, record, _) = bench.warm();
    warm_under(&mut warm, &stroke, 1e9, record);
    assert!((0..bench.particles.len()).all(|i| bench.kelvin(i) <= HOTTEST + 1.0));
    let (mut warm, _, record, _) = bench.warm();
    warm_under(&mut warm, &stroke, -1e9, record);
    assert!((0..bench.particles.len()).all(|i| bench.kelvin(i) >= COLDEST - 1.0));
    assert_eq!(bench.total(), 0);
}

#[test]
fn a_temperature_that_is_set_holds_whatever_matter_becomes_on_the_way() {
    let mut bench = Bench::new(Vec2::new(20.0, 20.0), 0.1).fill(0.0, |at| {
        let of_row = |row: u32| [WATER, ICE, STEAM, ASH, METAL, LAVA, SNOW, BRINE][row as usize % 8];
        let element = of_row(at.y as u32);
        (at.x < 12.0).then_some((element, [293.0, 200.0, 500.0, 293.0, 293.0, 1600.0, 250.0, 293.0][at.y as usize % 8]))
    });
    for x in 12..20 {
        for y in 0..20 {
            bench.solids.insert(IVec2::new(x, y), ROCK, 1000 + 20 * x as u32 + y as u32);
        }
    }
    let (before, stroke) = (bench.total(), Stroke::rectangle(Vec2::ZERO, Vec2::splat(20.0)));
    for kelvin in [3000.0, 320.0, 600.0, 250.0, 20.0, 400.0] {
        for _ in 0..4 {
            let (mut warm, _, record, _) = bench.warm();
            set_under(&mut warm, &stroke, kelvin, record);
            bench.change();
        }
        for i in 0..bench.particles.len() {
            let (is, element) = (bench.kelvin(i), bench.particles.element[i]);
            assert!((is - kelvin).abs() < 0.01, "{element:?} has {is} K of {kelvin}");
        }
        for (cell, element, _) in bench.solids.iter() {
            let is = bench.table.curve(element).temperature(bench.solids.heat(cell));
            assert!((is - kelvin).abs() < 0.01, "rock {element:?} has {is} K of {kelvin}");
        }
        assert_eq!(bench.total(), before, "at {kelvin} K");
    }
    // Under the stroke alone.
    let dab = Stroke::dab(BrushShape::Disc, Vec2::splat(6.0), 2.0);
    let held: Vec<i32> = bench.particles.heat.to_vec();
    let (mut warm, _, record, _) = bench.warm();
    set_under(&mut warm, &dab, 350.0, record);
    for i in 0..bench.particles.len() {
        let is_changed = bench.particles.heat_of(i) != held[i];
        assert_eq!(is_changed, dab.covers(bench.particles.position(i)), "{:?}", bench.particles.position(i));
    }
}

#[test]
fn what_is_set_to_the_temperature_of_the_room_at_rest_has_no_heat() {
    let mut bench = Bench::new(Vec2::new(10.0, 10.0), 0.1).fill(0.0, |_| Some((WATER, ROOM)));
    bench.solids.insert(IVec2::new(3, 3), ROCK, 1000);
    let (mut warm, _, record, _) = bench.warm();
    set_under(&mut warm, &Stroke::rectangle(Vec2::ZERO, Vec2::splat(10.0)), ROOM, record);
    assert!(!bench.particles.has_heat() && bench.solids.heats().is_empty());
}

#[test]
fn what_splits_is_dealt_in_turn() {
    let mut bench = Bench::new(Vec2::new(30.0, 30.0), 0.1).fill(0.0, |_| Some((SNOW, 280.0)));
    let (count, total) = (bench.particles.len(), bench.total());
    for heat in 0..count {
        let molten = bench.table.curve(SNOW).heat(280.0) + (68e6 / QUANTUM) as i32;
        bench.particles.set_heat(heat, molten);
        bench.record.by_hand += i64::from(molten - bench.table.curve(SNOW).heat(280.0));
    }
    bench.change();
    assert_eq!((bench.particles.len(), bench.count(WATER)), (count / 3, count / 3));
    assert_eq!(bench.total(), total, "what goes into the air takes its heat along");
}

#[test]
fn what_splits_into_two_is_equally_warm_and_makes_no_heat() {
    let mut bench = Bench::new(Vec2::new(30.0, 31.0), 0.1).fill(0.0, |_| Some((BRINE, ROOM)));
    let Some(boils) = bench.table.curve(BRINE).above.clone() else { panic!("it stays what it is") };
    let boiled = boils.plateau[1] + 1;
    for i in 0..bench.particles.len() {
        bench.particles.set_heat(i, boiled);
        bench.record.by_hand += i64::from(boiled);
    }
    bench.change();
    assert_eq!((bench.count(STEAM), bench.count(ASH)), (465, 465));
    assert_eq!(bench.total(), 0);
    let all = 0..bench.particles.len();
    let (coldest, hottest) = all.map(|i| bench.kelvin(i)).fold((f32::MAX, 0.0_f32), |(a, b), k| (a.min(k), b.max(k)));
    assert!(hottest - coldest < 0.01 && (coldest - 375.0).abs() < 0.01, "{coldest} to {hottest} K");
}

#[test]
fn rock_melts_and_lava_sets_only_where_it_is_alone() {
    let mut bench = Bench::new(Vec2::new(10.0, 10.0), 0.1);
    bench.solids.insert(IVec2::new(4, 4), ROCK, 77);
    bench.solids.set_heat(IVec2::new(4, 4), bench.table.curve(ROCK).heat(1430.0) + (950e6 / QUANTUM) as i32);
    let total = bench.total();
    bench.tick();
    assert_eq!((bench.solids.count(), bench.particles.len()), (0, 1));
    assert_eq!((bench.particles.id[0], bench.particles.element[0]), (77, LAVA));
    assert_eq!(bench.total(), total);
    // Cold lava, one alone and two in one cell.
    let [cold, _] = bench.table.curve(LAVA).range();
    bench.particles.set_heat(0, cold);
    for id in [1, 2] {
        bench.particles.push_warm(id, LAVA, Vec2::new(7.3, 7.2 + 0.2 * id as f32), Vec2::ZERO, cold);
    }
    bench.change();
    assert_eq!((bench.solids.get(IVec2::new(4, 4)), bench.particles.len()), (Some((GLASS, 77)), 2));
    assert_eq!(bench.solids.heat(IVec2::new(4, 4)), cold);
}

#[test]
fn a_gas_gives_its_heat_to_the_air_five_times_as_fast() {
    let mut elements = Bench::new(Vec2::splat(20.0), 0.1).elements.rows().to_vec();
    elements.push(Element {
        category: Category::Gases,
        ..Element { name: "smoke".into(), ..elements[ASH.index()].clone() }
    });
    let smoke = elements.len() as u8 - 1;
    let elements = ElementTable::new(elements);
    let mut bench = Bench { table: HeatTable::new(&elements), elements, ..Bench::new(Vec2::splat(20.0), 0.1) };
    for (id, x) in [(ASH.0, 5.0), (smoke, 15.0)] {
        let heat = bench.table.curve(ElementId(id)).heat(400.0);
        bench.particles.push_warm(id.into(), ElementId(id), Vec2::new(x, 10.0), Vec2::ZERO, heat);
    }
    let start = bench.particles.clone();
    bench.flow(1);
    // Solved for the end of the step, what is warmer than the room by 1 is so by 1/(1 + x) after it.
    let given = [0, 1].map(|i| {
        let left = f64::from(bench.particles.heat_of(i)) / f64::from(start.heat_of(i));
        1.0 / left - 1.0
    });
    assert!((given[1] / given[0] - 5.0).abs() < 1e-3, "{given:?}");
}
