//! What decays must hold to.

use super::{Decays, ignite_under, table::DecayTable};
use crate::{
    brush::Stroke,
    element::{Category, Element, ElementChange, ElementDecay, ElementId, ElementTable},
    heat::{Exposure, HeatRecord, Warm, chemical, held, table::HeatTable},
    params::Domain,
    particles::Particles,
    relabel::Relabelled,
    solids::{Solids, centre},
    units::{Scale, TICK_SECONDS},
};
use glam::{IVec2, Vec2};

const OIL: ElementId = ElementId(0);
const FIRE: ElementId = ElementId(1);
const ASH: ElementId = ElementId(2);
const EMBER: ElementId = ElementId(3);
const WOOD: ElementId = ElementId(4);
const SMOKE: ElementId = ElementId(5);
const WATER: ElementId = ElementId(6);
const SAND: ElementId = ElementId(7);
const SCALE: Scale = Scale { spacing: 0.1, detail: 1.0 };

fn decay(above: Option<f32>, seconds: f32, needs_air: bool, into: &[&str]) -> Option<ElementDecay> {
    Some(ElementDecay { above, seconds, needs_air, into: into.iter().map(|name| (*name).to_owned()).collect() })
}

fn rows() -> Vec<Element> {
    let row =
        |name: &str, capacity, energy, decays| Element { capacity, energy, decays, ..Element::plain(name, false) };
    let gas = |row: Element| Element { category: Category::Gases, ..row };
    vec![
        row("oil", 1.8, 2000.0, decay(Some(520.0), 0.02, true, &["fire"])),
        gas(row("fire", 1.4, 0.0, None)),
        row("ash", 0.3, 0.0, None),
        row("ember", 1.0, 1000.0, decay(Some(500.0), 1.0, false, &["fire", "fire", "fire", "ash"])),
        Element { fixed: true, ..row("wood", 1.0, 2000.0, decay(Some(570.0), 0.02, true, &["ember"])) },
        gas(row("smoke", 0.3, 0.0, decay(None, 2.0, false, &["air"]))),
        row("water", 4.2, 0.0, None),
        Element { friction: 35.0, ..row("sand", 0.8, 0.0, None) },
    ]
}

/// A box of matter at rest.
struct Bench {
    elements: ElementTable,
    heat: HeatTable,
    table: DecayTable,
    domain: Domain,
    particles: Particles,
    solids: Solids,
    decays: Decays,
    record: HeatRecord,
    relabelled: Relabelled,
    tick: u64,
}

impl Bench {
    /// A box with a lump of an element and temperature (K) in each cell.
    fn new(side: u32, what: impl Fn(IVec2) -> Option<(ElementId, f32)>) -> Self {
        let elements = ElementTable::new(rows());
        let heat = HeatTable::new(&elements);
        let (mut particles, mut solids) = (Particles::default(), Solids::new(side, side));
        for k in 0..side * side {
            let cell = IVec2::new((k % side) as i32, (k / side) as i32);
            let Some((element, kelvin)) = what(cell) else { continue };
            let holds = heat.curve(element).heat(kelvin);
            if elements.get(element).fixed {
                assert!(solids.insert(cell, element, k));
                solids.set_heat(cell, holds);
            } else {
                particles.push_warm(k, element, centre(cell), Vec2::ZERO, holds);
            }
        }
        Self {
            table: DecayTable::new(&elements, 1.0),
            heat,
            elements,
            domain: Domain { size: Vec2::splat(side as f32), gravity: Vec2::ZERO },
            particles,
            solids,
            decays: Decays::default(),
            record: HeatRecord::default(),
            relabelled: Relabelled::default(),
            tick: 0,
        }
    }

    fn run(&mut self, ticks: u32) {
        for _ in 0..ticks {
            let Self { elements, heat, table, domain, particles, solids, .. } = self;
            let mut warm = Warm { particles, solids, elements, table: heat, domain, scale: SCALE };
            self.decays.run(&mut warm, table, &mut self.record, &mut self.relabelled, self.tick);
            self.tick += 1;
        }
    }

    /// Sets fire to all.
    fn ignite(&mut self) {
        let Self { elements, heat, table, domain, particles, solids, .. } = self;
        let stroke = Stroke::rectangle(Vec2::ZERO, domain.size);
        let mut warm = Warm { particles, solids, elements, table: heat, domain, scale: SCALE };
        ignite_under(&mut warm, table, &stroke, &mut self.record);
    }

    /// Length of the open surface of wood in a cell, d.
    fn exposure(&self, cell: IVec2) -> f32 {
        let Self { elements, domain, particles, solids, .. } = self;
        let mut exposure = Exposure::default();
        exposure.gather(particles, domain.size);
        exposure.of((particles, solids, elements), WOOD, centre(cell))
    }

    fn count(&self, element: ElementId) -> usize {
        let rock = self.solids.iter().filter(|(_, other, _)| *other == element).count();
        self.particles.element.iter().filter(|other| **other == element).count() + rock
    }

    /// All energy, with what the air got, quanta.
    fn energy(&self) -> i64 {
        let Self { particles, solids, heat, record, .. } = self;
        held(particles, solids) + chemical(particles, solids, heat) + record.outside()
    }

    fn kelvin(&self, element: ElementId) -> Vec<f32> {
        let of = (0..self.particles.len()).filter(|i| self.particles.element[*i] == element);
        of.map(|i| self.heat.curve(element).temperature(self.particles.heat_of(i))).collect()
    }
}

#[test]
fn what_decays_does_so_at_its_rate() {
    let mut bench = Bench::new(64, |_| Some((SMOKE, 300.0)));
    bench.run(60);
    // A share of (1 + Δt/τ)⁻¹ is left after each tick; four standard deviations of the count.
    let left = (1.0 + f64::from(TICK_SECONDS) / 2.0).powi(-60);
    let deviation = (4096.0 * left * (1.0 - left)).sqrt();
    let off = bench.count(SMOKE) as f64 - 4096.0 * left;
    assert!(off.abs() < 4.0 * deviation, "{off} of {}", 4.0 * deviation);
    assert_eq!(bench.record.gone as usize, 4096 - bench.count(SMOKE));
}

#[test]
fn what_is_too_cold_stays() {
    for (kelvin, burns) in [(519.0, false), (521.0, true)] {
        let mut bench = Bench::new(8, |cell| (cell.y < 6).then_some((OIL, kelvin)));
        bench.run(300);
        assert_eq!(bench.count(FIRE) > 0, burns, "at {kelvin} K");
    }
}

#[test]
fn energy_is_the_same_to_the_bit_and_what_comes_of_a_lump_is_as_hot() {
    let mut bench = Bench::new(32, |cell| Some((EMBER, 600.0 + 15.0 * (cell.x + cell.y) as f32)));
    let before = bench.energy();
    bench.run(600);
    assert!(bench.count(EMBER) < 10);
    assert_eq!(bench.energy(), before);
    // Three of fire for one of ash, to a lump.
    let [fire, ash] = [FIRE, ASH].map(|element| bench.count(element));
    assert!(fire.abs_diff(3 * ash) <= 3, "{fire} of fire, {ash} of ash");
    // An ember of 600 to 1,530 K: four hold 4 (c (T − 293) + 1000), and three of fire and one of ash 4.5 for each degree.
    let flame = |kelvin: f32| 293.0 + 4.0 * (kelvin - 293.0 + 1000.0) / (3.0 * 1.4 + 0.3);
    for kelvin in bench.kelvin(ASH) {
        assert!((flame(599.0)..flame(1531.0)).contains(&kelvin), "ash of {kelvin} K");
    }
    // What the ash could not hold is the air's.
    assert!(bench.record.to_air > 0);
}

#[test]
fn wood_burns_from_its_surface_to_ember_where_it_stands() {
    let beam = |cell: IVec2| (4..12).contains(&cell.x) && (4..12).contains(&cell.y);
    let mut bench = Bench::new(16, |cell| beam(cell).then_some((WOOD, 600.0)));
    let before = bench.energy();
    bench.run(1);
    let burnt = bench.count(EMBER);
    assert!((5..=28).contains(&burnt), "{burnt} of a surface of 28");
    for i in 0..bench.particles.len() {
        let IVec2 { x, y } = Solids::cell_of(bench.particles.position(i));
        assert!(x == 4 || x == 11 || y == 4 || y == 11, "it burns inside, at {x}, {y}");
    }
    bench.run(600);
    assert_eq!((bench.count(WOOD), bench.solids.count()), (0, 0));
    assert_eq!(bench.energy(), before);
}

#[test]
fn what_is_open_follows_from_what_lies_on_it() {
    // Wood up to the middle of the box, and what lies on it to the top. Of its neighbours a lump at a plane surface misses .3484
    // and one in the corner at a wall, which covers as matter does, .2500; a tenth of all may be missing inside; grains cover half.
    for (cover, open, corner) in [
        (None, 1.0, 0.604),
        (Some(SMOKE), 1.0, 0.604),
        (Some(SAND), 0.299, 0.101),
        (Some(WATER), 0.0, 0.0),
        (Some(WOOD), 0.0, 0.0),
    ] {
        let bench =
            Bench::new(16, |cell| if cell.y < 8 { Some((WOOD, 300.0)) } else { cover.map(|cover| (cover, 300.0)) });
        for (x, open) in [(8, open), (0, corner), (15, corner)] {
            let [first, second] = [7, 6].map(|y| bench.exposure(IVec2::new(x, y)));
            assert!((first - open).abs() < 0.001, "{first} of {open} is open at {x} under {cover:?}");
            assert_eq!(second, 0.0, "the second row is open at {x} under {cover:?}");
        }
    }
}

#[test]
fn liquid_covers_what_needs_air_and_gas_does_not() {
    let burns = |around: Option<(ElementId, f32)>| {
        let mut bench = Bench::new(9, |cell| if cell == IVec2::splat(4) { Some((OIL, 800.0)) } else { around });
        bench.run(120);
        bench.count(OIL) == 0
    };
    assert!(burns(None));
    assert!(burns(Some((FIRE, 300.0))));
    assert!(!burns(Some((WATER, 300.0))));
    assert!(!burns(Some((WOOD, 300.0))));
}

#[test]
fn what_would_be_hotter_than_anything_gives_the_rest_to_the_air() {
    let mut bench = Bench::new(6, |cell| (cell.y < 3).then_some((WOOD, 3900.0)));
    let before = bench.energy();
    for element in [EMBER, FIRE] {
        while bench.count(element) == 0 {
            bench.run(1);
        }
        assert!(bench.kelvin(element).iter().all(|kelvin| *kelvin <= 4000.01), "{:?}", bench.kelvin(element));
        assert!(bench.record.to_air > 0);
    }
    assert_eq!(bench.energy(), before);
}

#[test]
fn a_match_lights_all_that_can_burn_and_warms_nothing_else() {
    let fuels = [OIL, EMBER, WOOD];
    let all = [OIL, FIRE, ASH, EMBER, WOOD, SMOKE, WATER, SAND];
    for element in all {
        let mut bench = Bench::new(6, |cell| (cell.y < 3).then_some((element, 300.0)));
        let (before, energy) = (held(&bench.particles, &bench.solids), bench.energy());
        bench.ignite();
        assert_eq!(bench.energy(), energy, "{element:?}: what it gives is not booked");
        assert_eq!(bench.record.by_hand > 0, fuels.contains(&element), "{element:?}");
        assert_eq!(held(&bench.particles, &bench.solids) - before, bench.record.by_hand);
        let count = bench.count(element);
        bench.run(240);
        // Smoke fades at any temperature.
        assert_eq!(bench.count(element) < count, fuels.contains(&element) || element == SMOKE, "{element:?}");
    }
    // What burns is not cooled.
    let mut bench = Bench::new(6, |_| Some((EMBER, 1300.0)));
    bench.ignite();
    assert_eq!(bench.record.by_hand, 0);
}

#[test]
fn what_can_burn_is_known_with_the_temperature_that_it_takes() {
    let mut rows = rows();
    let coal = ElementId(rows.len() as u8);
    rows.push(Element {
        changes: vec![ElementChange { above: Some(520.0), below: None, into: vec!["ember".into()], latent: Some(0.0) }],
        ..Element { name: "charcoal".into(), energy: 1000.0, ..rows[ASH.index()].clone() }
    });
    let table = DecayTable::of_rows(&rows, 1.0).expect("sound");
    let all = [OIL, FIRE, ASH, EMBER, WOOD, SMOKE, WATER, coal];
    let expected = [Some(520.0), None, None, Some(500.0), Some(570.0), None, None, Some(520.0)];
    assert_eq!(all.map(|element| table.ignition(element)), expected);
    assert_eq!((table.lowest_ignition(), DecayTable::default().lowest_ignition()), (Some(500.0), None));
}

#[test]
fn a_table_that_leads_nowhere_or_makes_energy_is_refused() {
    for (row, decays, expected) in [
        (0, decay(Some(520.0), 0.001, true, &["fire"]), "after 0.001 s; allowed: 0.02 to 1000"),
        (0, decay(Some(5000.0), 1.0, true, &["fire"]), "above 5000 K; allowed: 1 to 4000"),
        (0, decay(Some(f32::NAN), 1.0, true, &["fire"]), "above NaN K"),
        (0, decay(None, f32::NAN, true, &["fire"]), "after NaN s"),
        (0, decay(None, 1.0, true, &[]), "into 0 lumps in turn; allowed: 1 to 16"),
        (0, decay(None, 1.0, true, &["oil"]), "into `oil`; allowed: another element, or `air`"),
        (0, decay(None, 1.0, true, &["wine"]), "into `wine`; allowed: another element, or `air`"),
        (
            3,
            decay(None, 1.0, true, &["wood"]),
            "into `wood`, which has 2000 MJ/m² of energy; allowed: at most its own 1000",
        ),
    ] {
        let mut rows = rows();
        rows[row].decays = decays;
        let fault = DecayTable::of_rows(&rows, 1.0).expect_err("a fault");
        assert_eq!(fault.row, row);
        assert!(fault.what.contains(expected), "{fault:?}");
    }
}
