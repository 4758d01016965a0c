//! What placing and taking away must hold to.

use super::{occupancy::CLEARANCE, *};
use crate::{
    brush::{BrushShape, Stroke},
    element::{Element, ElementId, ElementTable},
    heat::table::HeatTable,
    params::Domain,
    particles::{Particle, Particles},
    solids::Solids,
    sources::{Drain, Emitter, Rect},
};
use glam::{IVec2, Vec2};

struct Bench {
    domain: Domain,
    elements: ElementTable,
    heat: HeatTable,
    particles: Particles,
    solids: Solids,
    next_id: u32,
    limit: u32,
}

const ROCK: ElementId = ElementId(0);
const WATER: ElementId = ElementId(1);
const OIL: ElementId = ElementId(2);

impl Bench {
    fn new() -> Self {
        Self::of(vec![Element::plain("rock", true), Element { flow: 0.25, ..Element::plain("water", false) }])
    }

    fn with_oil() -> Self {
        Self::of(vec![Element::plain("rock", true), Element::plain("water", false), Element::plain("oil", false)])
    }

    fn of(rows: Vec<Element>) -> Self {
        let elements = ElementTable::new(rows);
        Self {
            domain: Domain { size: Vec2::new(60.0, 40.0), gravity: Vec2::ZERO },
            heat: HeatTable::new(&elements),
            elements,
            particles: Particles::default(),
            solids: Solids::new(60, 40),
            next_id: 0,
            limit: 10_000,
        }
    }

    fn matter(&mut self) -> Matter<'_> {
        Matter {
            domain: &self.domain,
            elements: &self.elements,
            heat: &self.heat,
            particles: &mut self.particles,
            solids: &mut self.solids,
            next_id: &mut self.next_id,
            limit: self.limit,
        }
    }

    /// Particles of an element.
    fn count(&self, element: ElementId) -> usize {
        self.particles.element.iter().filter(|other| **other == element).count()
    }

    fn nearest(&self) -> f32 {
        let mut nearest = f32::MAX;
        for i in 0..self.particles.len() {
            for j in 0..i {
                nearest = nearest.min(self.particles.position(i).distance(self.particles.position(j)));
            }
        }
        nearest
    }
}

/// Pours for a whole tick, at rest.
const STILL: Pouring = Pouring { velocity: Vec2::ZERO, share: 1.0 };

fn disc(x: f32, y: f32, radius: f32) -> Stroke {
    Stroke::dab(BrushShape::Disc, Vec2::new(x, y), radius)
}

/// A stroke of a second at a speed (d/s), to the right, in the middle of the bench; what is poured gets half of the speed, and goes
/// on without a force. `pieces` of the way make a tick.
fn swing(speed: f32, radius: f32, pieces: u32) -> Bench {
    let mut bench = Bench::new();
    let (step, begin, velocity) = (speed / 60.0 / pieces as f32, 2.0 + radius, Vec2::new(0.5 * speed, 0.0));
    for piece in 0..(40.0 / step) as u32 {
        let at = Vec2::new(begin + step * piece as f32, 20.0);
        let stroke = Stroke { shape: BrushShape::Disc, from: at, to: at + Vec2::new(step, 0.0), radius };
        bench.matter().pour(WATER, &stroke, Pouring { velocity, share: 1.0 / pieces as f32 }, piece.into());
        if (piece + 1) % pieces == 0 {
            for i in 0..bench.particles.len() {
                bench.particles.x[i] += bench.particles.vx[i] / 60.0;
            }
        }
    }
    bench
}

/// A stream has no hole wider than two particles: each place in it is nearer to one of them than this, d.
const HOLE: f32 = 1.0;

#[test]
fn a_stroke_is_a_stream_without_holes_however_fast() {
    for (speed, radius, pieces) in [(20.0, 4.0, 1), (80.0, 4.0, 1), (80.0, 2.0, 4), (400.0, 3.0, 1), (400.0, 6.0, 16)] {
        let bench = swing(speed, radius, pieces);
        let ends = bench.particles.x.iter().fold((f32::MAX, f32::MIN), |(a, b), x| (a.min(*x), b.max(*x)));
        assert!(ends.1 - ends.0 > 18.0, "at {speed} d/s the stream is only {ends:?}");
        let (low, high) = ((ends.0 + radius) as i32 + 1, (ends.1 - radius) as i32);
        for at in (low..high).flat_map(|x| (-1..=1).map(move |y| Vec2::new(x as f32, 20.0 + 0.5 * y as f32))) {
            let near = (0..bench.particles.len()).any(|i| bench.particles.position(i).distance(at) < HOLE);
            assert!(near, "at {speed} d/s, radius {radius}, {pieces} pieces there is a hole at {at}");
        }
        assert!(bench.nearest() >= 0.999 * CLEARANCE, "two particles {} d apart", bench.nearest());
    }
}

#[test]
fn pouring_fills_up_and_never_puts_two_in_one_place() {
    let mut bench = Bench::new();
    let first = bench.matter().pour(WATER, &disc(30.0, 20.0, 6.0), STILL, 0);
    assert!((10..=50).contains(&first.placed), "one tick poured {} particles", first.placed);
    for edit in 1..200 {
        bench.matter().pour(WATER, &disc(30.0 + 0.01 * edit as f32, 20.0, 6.0), STILL, edit);
    }
    assert!(bench.particles.len() > 80, "the brush did not fill up: {}", bench.particles.len());
    assert!(bench.nearest() >= CLEARANCE, "two particles {} d apart", bench.nearest());
}

#[test]
fn rock_takes_the_place_of_water_and_ids_stay_unique() {
    let mut bench = Bench::new();
    bench.matter().stamp(WATER, &Stroke::rectangle(Vec2::new(10.0, 10.0), Vec2::new(20.0, 20.0)));
    assert_eq!(bench.particles.len(), 100);
    let report = bench.matter().pour(ROCK, &disc(10.0, 10.0, 3.0), STILL, 1);
    assert_eq!(report.placed as usize, bench.solids.count());
    assert!(report.removed > 0);
    assert_eq!(bench.particles.len() as u64, 100 - report.removed);
    let mut ids: Vec<u32> = bench.particles.id.clone();
    ids.extend(bench.solids.iter().map(|(.., id)| id));
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] < pair[1]), "an id was given twice");
}

#[test]
fn water_is_not_poured_into_rock() {
    let mut bench = Bench::new();
    bench.matter().pour(ROCK, &disc(30.0, 20.0, 5.0), STILL, 0);
    let report = bench.matter().stamp(WATER, &disc(30.0, 20.0, 4.0));
    assert_eq!(report.placed, 0);
}

#[test]
fn erasing_takes_everything_under_the_brush_and_nothing_else() {
    let mut bench = Bench::new();
    bench.matter().stamp(WATER, &Stroke::rectangle(Vec2::new(5.0, 5.0), Vec2::new(15.0, 15.0)));
    bench.matter().pour(ROCK, &disc(40.0, 20.0, 3.0), STILL, 1);
    let rock = bench.solids.count();
    let report = bench.matter().erase(&disc(10.0, 10.0, 3.0));
    assert!(report.removed > 20 && bench.particles.len() as u64 == 100 - report.removed);
    assert_eq!(bench.solids.count(), rock);
    bench.matter().erase(&Stroke::rectangle(Vec2::ZERO, Vec2::new(60.0, 40.0)));
    assert_eq!((bench.particles.len(), bench.solids.count()), (0, 0));
}

#[test]
fn at_the_limit_placing_stops_and_is_counted() {
    let mut bench = Bench::new();
    bench.limit = 50;
    let report = bench.matter().stamp(WATER, &Stroke::rectangle(Vec2::new(5.0, 5.0), Vec2::new(15.0, 15.0)));
    assert_eq!((report.placed, report.refused), (50, 50));
    assert_eq!(bench.matter().pour(ROCK, &disc(40.0, 20.0, 0.0), STILL, 1).refused, 1);
}

#[test]
fn filling_stops_at_rock() {
    let mut bench = Bench::new();
    for k in 0..40 {
        bench.solids.insert(IVec2::new(20, k), ROCK, 1000 + k as u32);
    }
    let report = bench.matter().fill(WATER, Vec2::new(5.0, 5.0));
    assert_eq!(report.placed, 20 * 40);
    assert_eq!(bench.matter().fill(WATER, Vec2::new(5.0, 5.0)).placed, 0, "a full room was filled again");
    assert_eq!(bench.matter().fill(WATER, Vec2::new(-5.0, f32::NAN)).placed, 0);
}

#[test]
fn an_emitter_keeps_its_rate_and_its_total() {
    let mut bench = Bench::new();
    let mut emitter = Emitter { velocity: Vec2::new(0.0, -1.0), total: Some(40), start: 10, ..emitter(30.0) };
    let area = emitter.area;
    for tick in 0..10 {
        bench.matter().emit(&mut emitter, &mut Occupancy::default(), tick, 1.0 / 60.0);
    }
    assert_eq!(emitter.given, 0, "it flowed before its start");
    for tick in 10..70 {
        bench.matter().emit(&mut emitter, &mut Occupancy::default(), tick, 1.0 / 60.0);
    }
    assert!((29..=31).contains(&emitter.given), "{} particles in a second at 30/s", emitter.given);
    for tick in 70..300 {
        bench.matter().emit(&mut emitter, &mut Occupancy::default(), tick, 1.0 / 60.0);
    }
    assert_eq!((emitter.given, bench.particles.len()), (40, 40));
    assert!(bench.nearest() >= CLEARANCE);
    assert_eq!(bench.matter().drain(&Drain { area }).removed, 40);
}

/// An emitter of 20 × 4 sites.
fn emitter(rate: f32) -> Emitter {
    let area = Rect { min: Vec2::new(10.0, 30.0), max: Vec2::new(30.0, 34.0) };
    Emitter { element: WATER, area, velocity: Vec2::ZERO, rate, total: None, start: 0, given: 0, due: 0.0 }
}

#[test]
fn what_moves_is_never_placed_in_a_cell_that_the_box_cuts() {
    let places: [fn(&mut Matter<'_>); 4] = [
        |matter| _ = matter.fill(WATER, Vec2::splat(3.5)),
        |matter| _ = matter.stamp(WATER, &Stroke::rectangle(Vec2::ZERO, Vec2::new(60.0, 40.0))),
        |matter| (0..200).for_each(|seed| _ = matter.pour(WATER, &disc(58.0, 38.0, 6.0), STILL, seed)),
        |matter| {
            let area = Rect { min: Vec2::new(50.0, 30.0), max: Vec2::new(60.0, 40.0) };
            let mut emitter = Emitter { area, ..emitter(6000.0) };
            (0..60).for_each(|tick| _ = matter.emit(&mut emitter, &mut Occupancy::default(), tick, 1.0 / 60.0));
        },
    ];
    for (k, place) in places.into_iter().enumerate() {
        let mut bench = Bench::new();
        // The last column is cut to .4 d, the last row to .9 d.
        bench.domain.size = Vec2::new(59.4, 39.9);
        place(&mut bench.matter());
        let highest = (0..bench.particles.len()).map(|i| bench.particles.position(i)).fold(Vec2::ZERO, Vec2::max);
        assert!(bench.particles.len() > 20, "place {k}");
        assert!(highest.x < 59.0 && highest.y < 39.0 && highest.y > 37.0, "place {k}: {highest}");
    }
}

#[test]
fn an_emitter_in_a_full_world_refuses_what_is_due_and_no_more() {
    let mut bench = Bench::new();
    bench.limit = 0;
    let mut emitter = emitter(90.0);
    let report = bench.matter().emit(&mut emitter, &mut Occupancy::default(), 0, 1.0 / 60.0);
    assert_eq!((report.placed, report.refused, report.blocked), (0, 1, false));
}

/// A block of 10 × 10 of water beside as much oil, and a bar of rock under both.
fn layers() -> Bench {
    let mut bench = Bench::with_oil();
    let block = |x: f32| Stroke::rectangle(Vec2::new(x, 10.0), Vec2::new(x + 10.0, 20.0));
    bench.matter().stamp(WATER, &block(10.0));
    bench.matter().stamp(OIL, &block(20.0));
    bench.matter().stamp(ROCK, &Stroke::rectangle(Vec2::new(10.0, 8.0), Vec2::new(30.0, 10.0)));
    bench
}

#[test]
fn replacing_adds_nothing_where_nothing_is_and_leaves_places_speeds_and_numbers() {
    let mut bench = layers();
    bench.particles.vx.iter_mut().for_each(|speed| *speed = 3.0);
    let (before, mut places) = (bench.particles.clone(), Vec::new());
    bench.matter().replace(OIL, &disc(15.0, 18.0, 4.0), &mut places);
    assert_eq!(bench.particles.len(), before.len());
    assert!(places.len() > 20 && bench.count(OIL) == 100 + places.len());
    assert!(
        (0..before.len())
            .all(|i| bench.particles.get(i) == Particle { element: bench.particles.element[i], ..before.get(i) })
    );
    bench.matter().replace(WATER, &disc(45.0, 30.0, 5.0), &mut places);
    assert_eq!(bench.particles.len(), before.len(), "something came where nothing was");
}

#[test]
fn what_moves_becomes_rock_alone_in_its_cell_and_rock_what_moves() {
    let mut bench = layers();
    let all = Stroke::rectangle(Vec2::ZERO, Vec2::new(60.0, 40.0));
    // Two in one cell.
    bench.particles.push(900, WATER, Vec2::new(50.2, 5.2), Vec2::ZERO);
    bench.particles.push(901, WATER, Vec2::new(50.8, 5.8), Vec2::ZERO);
    let report = bench.matter().replace(ROCK, &all, &mut Vec::new());
    assert_eq!((bench.particles.len(), bench.solids.count(), report.removed), (0, 241, 1));
    let report = bench.matter().replace(WATER, &all, &mut Vec::new());
    assert_eq!((bench.particles.len(), bench.solids.count(), report.removed), (241, 0, 0));
    let mut ids = bench.particles.id.clone();
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] < pair[1]), "an id is there twice");
}

#[test]
fn erasing_only_one_element_leaves_the_others() {
    let mut bench = layers();
    let all = Stroke::rectangle(Vec2::ZERO, Vec2::new(60.0, 40.0));
    assert_eq!(bench.matter().erase_only(WATER, &all).removed, 100);
    assert_eq!((bench.count(WATER), bench.count(OIL), bench.solids.count()), (0, 100, 40));
    assert_eq!(bench.matter().erase_only(ROCK, &all).removed, 40);
    assert_eq!((bench.count(OIL), bench.solids.count()), (100, 0));
}

#[test]
fn what_hangs_together_ends_at_another_element_at_a_gap_and_at_a_corner_of_rock() {
    let mut bench = layers();
    let water = Vec2::new(12.5, 12.5);
    // Beyond a gap, and beyond a corner between two cells of rock.
    bench.particles.push(900, WATER, Vec2::new(15.5, 25.5), Vec2::ZERO);
    bench.particles.push(901, WATER, Vec2::new(9.5, 20.5), Vec2::ZERO);
    bench.solids.insert(IVec2::new(9, 19), ROCK, 902);
    bench.solids.insert(IVec2::new(10, 20), ROCK, 903);
    assert_eq!(bench.matter().erase_around(OIL, water), EditReport::default(), "the water is no oil");
    assert_eq!(bench.matter().erase_around(WATER, Vec2::NAN), EditReport::default());
    bench.matter().replace_around(OIL, water, &mut Vec::new());
    assert_eq!((bench.count(WATER), bench.count(OIL)), (2, 200));
    assert_eq!(bench.matter().erase_around(OIL, water).removed, 200);
    // Rock that touches at a corner hangs together: the bar and the two cells do not touch.
    assert_eq!(bench.matter().erase_around(ROCK, Vec2::new(15.5, 8.5)).removed, 40);
    assert_eq!(bench.matter().erase_around(ROCK, Vec2::new(9.5, 19.5)).removed, 2);
}
