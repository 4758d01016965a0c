//! What copying and pasting must hold to.

use super::*;
use crate::{
    brush::Stroke,
    element::{Element, ElementId, ElementTable},
    heat::{held, table::HeatTable},
    params::Domain,
    particles::Particles,
    random::Random,
    solids::{Solids, centre},
    spawn::{EditReport, Matter},
};
use glam::{IVec2, Vec2};

const ROCK: ElementId = ElementId(0);
const WATER: ElementId = ElementId(1);
const LOW: IVec2 = IVec2::new(10, 5);
const HIGH: IVec2 = IVec2::new(22, 14);

/// Bits of the particles; row, column, element and heat of rock.
type Lumps = (Vec<[u32; 9]>, Vec<(i32, i32, ElementId, i32)>);

struct Bench {
    domain: Domain,
    elements: ElementTable,
    heat: HeatTable,
    particles: Particles,
    solids: Solids,
    next_id: u32,
    limit: u32,
}

impl Bench {
    fn empty() -> Self {
        let elements = ElementTable::new(vec![Element::plain("rock", true), Element::plain("water", false)]);
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

    /// Water in disorder, as it is where it runs, among rock; some of both warm. Both go on beyond the cells from `LOW` to `HIGH`.
    fn full() -> Self {
        let mut bench = Self::empty();
        let mut random = Random::new(3);
        for cell in (0..18).flat_map(|y| (0..30).map(move |x| IVec2::new(x, y))) {
            let id = bench.next_id;
            bench.next_id += 1;
            let (dice, aside) = (random.share(), 0.45 * (Vec2::new(random.share(), random.share()) - 0.5));
            let heat = (2000.0 * random.share()) as i32 - 1000;
            if dice < 0.2 {
                bench.solids.insert(cell, ROCK, id);
                bench.solids.set_heat(cell, heat);
            } else {
                let velocity = Vec2::new(random.share(), -random.share());
                bench.particles.push_warm(id, WATER, centre(cell) + aside, velocity, heat);
                bench.particles.push_x[id as usize - bench.solids.count()] = random.share();
            }
        }
        bench
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

    fn piece(&self) -> Piece {
        Piece::of(&self.particles, &self.solids, LOW, HIGH, 0.1)
    }

    fn cut(&mut self) -> Piece {
        let piece = self.piece();
        let report = self.matter().erase(&Stroke::rectangle(LOW.as_vec2(), HIGH.as_vec2()));
        assert_eq!(report.removed as usize, piece.count(), "it erases something else than it copies");
        piece
    }

    /// All lumps without their numbers, in an order of their own.
    fn lumps(&self) -> Lumps {
        let bits = |i: usize| self.particles.get(i).values().map(|value| value.word());
        let mut moving: Vec<_> = (0..self.particles.len()).map(bits).collect();
        moving.iter_mut().for_each(|values| values[0] = 0);
        moving.sort_unstable();
        let rock = |(cell, element, _): (IVec2, ElementId, u32)| (cell.y, cell.x, element, self.solids.heat(cell));
        (moving, self.solids.iter().map(rock).collect())
    }
}

/// All ways in which a piece can lie.
fn turns() -> Vec<Turn> {
    let quarters = |turn: Turn| std::iter::successors(Some(turn), |turn| Some(turn.quarter())).take(4);
    quarters(Turn::default()).chain(quarters(Turn::default().mirrored())).collect()
}

#[test]
fn turned_four_times_or_mirrored_twice_it_lies_as_before() {
    for (k, turn) in turns().into_iter().enumerate() {
        assert_eq!(turn.quarter().quarter().quarter().quarter(), turn);
        assert_eq!((turn.mirrored().mirrored(), turn.flipped().flipped()), (turn, turn));
        assert_eq!(turn.mirrored().flipped(), turn.quarter().quarter());
        assert!(turns()[..k].iter().all(|other| *other != turn), "{turn:?} is there twice");
    }
}

#[test]
fn a_quarter_turn_is_to_the_left_and_turns_cells_places_and_speeds_alike() {
    let (size, turn) = (IVec2::new(5, 3), Turn::default().quarter());
    assert_eq!(turn.size(size), IVec2::new(3, 5));
    assert_eq!(turn.direction(Vec2::X), Vec2::Y);
    assert_eq!(turn.place(Vec2::ZERO, size), Vec2::new(3.0, 0.0));
    for turn in turns() {
        for cell in (0..3).flat_map(|y| (0..5).map(move |x| IVec2::new(x, y))) {
            assert_eq!(turn.place(centre(cell), size), centre(turn.cell(cell, size)));
        }
        let way = turn.place(Vec2::new(3.0, 1.5), size) - turn.place(Vec2::new(2.0, 1.0), size);
        assert_eq!(way, turn.direction(Vec2::new(1.0, 0.5)));
    }
}

#[test]
fn cut_and_pasted_in_place_all_is_as_it_was_to_the_bit() {
    let mut bench = Bench::full();
    let (before, heat) = (bench.lumps(), held(&bench.particles, &bench.solids));
    let piece = bench.cut();
    assert!(piece.particles.len() > 50 && piece.rock.len() > 10 && bench.lumps() != before);
    let report = bench.matter().paste(&piece, LOW, Turn::default());
    assert_eq!(report, EditReport { placed: piece.count() as u64, ..EditReport::default() });
    assert!(bench.lumps() == before, "some lumps are others");
    assert_eq!(held(&bench.particles, &bench.solids), heat);
}

#[test]
fn a_copy_elsewhere_has_as_many_lumps_and_as_much_heat_however_it_lies() {
    for turn in turns() {
        let mut bench = Bench::full();
        let (count, heat) = (bench.particles.len() + bench.solids.count(), held(&bench.particles, &bench.solids));
        let piece = bench.piece();
        let within = |at: Vec2| at.cmpge(LOW.as_vec2()).all() && at.cmplt(HIGH.as_vec2()).all();
        let inside = (0..bench.particles.len()).filter(|i| within(bench.particles.position(*i)));
        assert_eq!(piece.particles.len(), inside.count());
        let own = held(&piece.particles, &piece.solids());
        assert_ne!(own, 0);
        bench.matter().paste(&piece, IVec2::new(35, 20), turn);
        assert_eq!(bench.particles.len() + bench.solids.count(), count + piece.count(), "{turn:?}");
        assert_eq!(held(&bench.particles, &bench.solids), heat + own, "{turn:?}");
        // Taken again and turned back, it is the first one.
        let low = IVec2::new(35, 20);
        let again = Piece::of(&bench.particles, &bench.solids, low, low + turn.size(piece.size), 0.1);
        assert_eq!((again.particles.len(), again.rock.len()), (piece.particles.len(), piece.rock.len()));
        let mut ids: Vec<u32> =
            bench.particles.id.iter().copied().chain(bench.solids.iter().map(|(.., id)| id)).collect();
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| pair[0] < pair[1]), "an id was given twice");
    }
}

#[test]
fn where_matter_is_in_the_way_lumps_are_left_out() {
    let mut bench = Bench::full();
    let (before, piece) = (bench.lumps(), bench.piece());
    // On itself, and beside itself by a cell.
    for low in [LOW, LOW + IVec2::new(1, 0)] {
        let report = bench.matter().paste(&piece, low, Turn::default());
        let (left_out, all) = (report.crowded, piece.count() as u64);
        assert_eq!(report.placed + report.crowded, all);
        assert!(50 * left_out >= 49 * all, "{left_out} of {all} are left out at {low}");
    }
    let mut bench = Bench::full();
    assert_eq!(bench.matter().paste(&piece, LOW, Turn::default()).placed, 0);
    assert!(bench.lumps() == before);
}

#[test]
fn what_would_be_outside_the_box_or_beyond_its_limit_is_left_out() {
    let piece = Bench::full().piece();
    let all = piece.count() as u64;
    for low in
        [IVec2::new(-4, 30), IVec2::new(55, -3), IVec2::new(1000, 0), IVec2::splat(i32::MAX), IVec2::splat(i32::MIN)]
    {
        let mut bench = Bench::empty();
        let report = bench.matter().paste(&piece, low, Turn::default().quarter());
        assert_eq!(report.placed + report.crowded, all);
        assert!(
            report.placed < all && (report.placed == 0) == (low.as_vec2().abs().max_element() > 100.0),
            "{report:?} at {low}"
        );
        let size = bench.domain.size;
        let inside = |at: Vec2| at.cmpge(Vec2::ZERO).all() && at.cmple(size).all();
        assert!((0..bench.particles.len()).all(|i| inside(bench.particles.position(i))));
    }
    let mut bench = Bench::empty();
    bench.limit = 30;
    let report = bench.matter().paste(&piece, LOW, Turn::default());
    assert_eq!((report.placed, report.refused, report.crowded), (30, all - 30, 0));
}

#[test]
fn made_up_pieces_are_refused() {
    let good = Bench::full().piece();
    let elements = Bench::empty().elements;
    assert_eq!((good.check(), good.check_elements(&elements)), (Ok(()), Ok(())));
    let changes: [fn(&mut Piece); 10] = [
        |piece| piece.spacing = f32::NAN,
        |piece| piece.size.x = 0,
        |piece| piece.size.y = i32::MAX,
        |piece| piece.particles.x[0] = f32::INFINITY,
        |piece| piece.particles.y[0] = -1.0,
        |piece| piece.particles.vx[0] = f32::NAN,
        |piece| _ = piece.particles.vy.pop(),
        |piece| _ = piece.room.pop(),
        |piece| piece.rock[0].cell.x = 12,
        |piece| piece.rock[0].room = f32::NAN,
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let mut piece = good.clone();
        change(&mut piece);
        assert!(piece.check().is_err(), "change {k}");
    }
    for element in [ROCK, ElementId(7)] {
        let mut piece = good.clone();
        piece.particles.element[0] = element;
        assert!(piece.check_elements(&elements).is_err());
    }
}
