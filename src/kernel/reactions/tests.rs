//! What reactions must hold to.

use super::{
    Reactions,
    table::{ReactionTable, TouchFault},
};
use crate::{
    element::{Element, ElementId, ElementTable, ElementTouch},
    heat::{HeatRecord, Warm, held, table::HeatTable},
    params::Domain,
    particles::Particles,
    relabel::Relabelled,
    solids::{Solids, centre},
    units::{Scale, TICK_SECONDS},
};
use glam::{IVec2, Vec2};
use std::collections::BTreeMap;

const WATER: ElementId = ElementId(0);
const SALT: ElementId = ElementId(1);
const BRINE: ElementId = ElementId(2);
const ACID: ElementId = ElementId(3);
const ROCK: ElementId = ElementId(4);
const PLANT: ElementId = ElementId(5);
const SAND: ElementId = ElementId(6);

fn touch(with: &str, into: [&str; 2], rate: f32) -> ElementTouch {
    ElementTouch {
        with: with.to_owned(),
        into: (into[0].to_owned(), into[1].to_owned()),
        rate,
        between: None,
        light: false,
    }
}

fn rows() -> Vec<Element> {
    let row = |name: &str, fixed, touches| Element { touches, ..Element::plain(name, fixed) };
    vec![
        row("water", false, vec![]),
        row("salt", false, vec![touch("water", ["brine", "brine"], 2.0)]),
        row("brine", false, vec![]),
        row("acid", false, vec![touch("rock", ["air", "sand"], 60.0)]),
        row("rock", true, vec![]),
        row(
            "plant",
            true,
            vec![ElementTouch { between: Some((278.0, 320.0)), ..touch("water", ["plant", "plant"], 60.0) }],
        ),
        row("sand", false, vec![]),
    ]
}

/// A box of matter at rest.
#[derive(Clone)]
struct Bench {
    elements: ElementTable,
    heat: HeatTable,
    table: ReactionTable,
    domain: Domain,
    particles: Particles,
    solids: Solids,
    reactions: Reactions,
    record: HeatRecord,
    relabelled: Relabelled,
    tick: u64,
}

impl Bench {
    fn new(side: u32, what: impl Fn(IVec2) -> Option<ElementId>) -> Self {
        let elements = ElementTable::new(rows());
        let (mut particles, mut solids) = (Particles::default(), Solids::new(side, side));
        for k in 0..side * side {
            let cell = IVec2::new((k % side) as i32, (k / side) as i32);
            match what(cell) {
                Some(element) if elements.get(element).fixed => assert!(solids.insert(cell, element, k)),
                Some(element) => particles.push(k, element, centre(cell), Vec2::ZERO),
                None => {}
            }
        }
        Self {
            heat: HeatTable::new(&elements),
            table: ReactionTable::new(&elements, 1.0),
            elements,
            domain: Domain { size: Vec2::splat(side as f32), gravity: Vec2::ZERO },
            particles,
            solids,
            reactions: Reactions::default(),
            record: HeatRecord::default(),
            relabelled: Relabelled::default(),
            tick: 0,
        }
    }

    fn counts(&self) -> Vec<u32> {
        let mut counts = vec![0; self.elements.len()];
        let rock = self.solids.iter().map(|(_, element, _)| element);
        self.particles.element.iter().copied().chain(rock).for_each(|element| counts[element.index()] += 1);
        counts
    }

    fn tick(&mut self, threads: usize) {
        let counts = self.counts();
        let Self { elements, heat, table, domain, particles, solids, reactions, record, relabelled, tick, .. } = self;
        let mut warm = Warm { particles, solids, elements, table: heat, domain, scale: Scale::own(0.1) };
        reactions.react(&mut warm, (&*table, &counts), record, relabelled, *tick, threads);
        *tick += 1;
    }

    /// Every lump by its id: what it is.
    fn lumps(&self) -> BTreeMap<u32, ElementId> {
        let moves = (0..self.particles.len()).map(|i| (self.particles.id[i], self.particles.element[i]));
        moves.chain(self.solids.iter().map(|(_, element, id)| (id, element))).collect()
    }

    fn count(&self, element: ElementId) -> u32 {
        self.counts()[element.index()]
    }
}

fn checked(cell: IVec2) -> bool {
    (cell.x + cell.y) % 2 == 0
}

#[test]
fn a_pair_reacts_at_its_rate() {
    // Pairs that touch nobody else: of N a share of (1 + r Δt)⁻ⁿ is left after n ticks.
    let pair = |cell: IVec2| match (cell.x % 5, cell.y % 4) {
        (0, 0) => Some(SALT),
        (1, 0) => Some(WATER),
        _ => None,
    };
    let mut bench = Bench::new(200, pair);
    let pairs = f64::from(bench.count(SALT));
    for _ in 0..30 {
        bench.tick(1);
    }
    let left = pairs * (1.0 + 2.0 * f64::from(TICK_SECONDS)).powi(-30);
    let is = f64::from(bench.count(SALT));
    // Four standard deviations of a binomial count.
    let most = 4.0 * (left * (1.0 - left / pairs)).sqrt();
    assert!((is - left).abs() < most, "{is} of {pairs} pairs are left, {left:.0} ± {most:.0} expected");
    assert_eq!((bench.count(SALT), bench.count(BRINE)), (bench.count(WATER), 2 * (pairs as u32 - bench.count(SALT))));
}

#[test]
fn no_order_and_no_thread_shows() {
    let mixed = |cell: IVec2| Some(if checked(cell) { SALT } else { WATER });
    let run = |threads: usize, turned: bool| {
        let mut bench = Bench::new(40, mixed);
        if turned {
            let old = std::mem::take(&mut bench.particles);
            for i in (0..old.len()).rev() {
                bench.particles.push(old.id[i], old.element[i], old.position(i), Vec2::ZERO);
            }
        }
        (0..20).for_each(|_| bench.tick(threads));
        bench.lumps()
    };
    let once = run(1, false);
    assert!(once.values().any(|element| *element == BRINE), "nothing reacted");
    assert!(once == run(4, false) && once == run(1, true));
}

#[test]
fn nobody_reacts_twice_in_a_tick_and_nobody_is_lost() {
    let mixed = |cell: IVec2| Some(if checked(cell) { ACID } else { ROCK });
    let mut bench = Bench::new(40, mixed);
    let (mut acid, mut rock) = (bench.count(ACID), bench.count(ROCK));
    for _ in 0..10 {
        bench.tick(2);
        let gone = bench.record.gone as u32;
        assert_eq!((bench.count(ACID) + gone, bench.count(ROCK) + bench.count(SAND)), (800, 800));
        assert_eq!(bench.count(SAND), gone, "each acid eats one rock");
        assert!(bench.count(ACID) <= acid && bench.count(ROCK) <= rock);
        (acid, rock) = (bench.count(ACID), bench.count(ROCK));
    }
    assert!(bench.count(SAND) > 600, "{} rocks were eaten", bench.count(SAND));
    assert_eq!(bench.record.turned, bench.record.gone);
}

#[test]
fn what_grows_needs_a_cell_of_its_own_and_warmth() {
    let grown = |kelvin: f32, crowd: u32| {
        let bed = |cell: IVec2| (cell.y == 0).then_some(PLANT);
        let mut bench = Bench::new(3, bed);
        let heat = bench.heat.curve(WATER).heat(kelvin);
        for id in 0..crowd {
            bench.particles.push_warm(100 + id, WATER, Vec2::new(1.5, 1.4), Vec2::ZERO, heat);
        }
        (0..200).for_each(|_| bench.tick(1));
        let warm = held(&bench.particles, &bench.solids);
        assert_eq!(warm, i64::from(heat) * i64::from(crowd), "its heat stays");
        bench.count(PLANT) - 3
    };
    assert_eq!([grown(293.0, 1), grown(293.0, 2), grown(275.0, 1), grown(330.0, 1)], [1, 0, 0, 0]);
}

#[test]
fn lumps_across_a_gap_do_not_react() {
    let apart = |cell: IVec2| match cell.to_array() {
        [1, 1] => Some(ACID),
        [3, 1] | [2, 2] => Some(ROCK),
        _ => None,
    };
    let mut bench = Bench::new(5, apart);
    (0..600).for_each(|_| bench.tick(1));
    assert_eq!((bench.count(ACID), bench.count(ROCK)), (1, 2));
}

#[test]
fn what_leads_nowhere_is_refused() {
    let fault = |row: usize, touches: Vec<ElementTouch>| {
        let mut rows = rows();
        rows[row].touches = touches;
        ReactionTable::of_rows(&rows, 1.0).expect_err("a fault")
    };
    let between =
        |low: f32, high: f32| ElementTouch { between: Some((low, high)), ..touch("acid", ["water", "water"], 1.0) };
    for (row, touches, expected) in [
        (0, vec![touch("wine", ["water", "water"], 1.0)], "with `wine`; allowed: an element"),
        (0, vec![touch("acid", ["wine", "water"], 1.0)], "into `wine`; allowed: an element, or `air`"),
        (0, vec![touch("acid", ["water", "acid"], 1.0)], "into the same"),
        (4, vec![touch("plant", ["air", "air"], 1.0)], "allowed: something that moves"),
        (0, vec![touch("acid", ["brine", "acid"], f32::NAN)], "a rate of NaN; allowed: 0.001 to 60"),
        (0, vec![touch("acid", ["brine", "acid"], 61.0)], "a rate of 61"),
        (0, vec![between(300.0, 300.0)], "between 300 and 300 K"),
        (0, vec![between(f32::NAN, 300.0)], "between NaN and 300 K"),
        (0, vec![between(0.0, 300.0)], "between 0 and 300 K"),
    ] {
        let TouchFault { row: found, what } = fault(row, touches);
        assert_eq!(found, row);
        assert!(what.contains(expected), "{what}");
    }
    let twice = fault(0, vec![touch("acid", ["air", "air"], 1.0), touch("acid", ["air", "brine"], 1.0)]);
    assert!(twice.what.contains("once more"), "{}", twice.what);
    let mirrored = fault(0, vec![touch("salt", ["air", "air"], 1.0)]);
    assert_eq!((mirrored.row, mirrored.what.contains("with `water` once more")), (1, true), "{}", mirrored.what);
}
