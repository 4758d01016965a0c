//! What breaking must hold to.

use super::{fracture, table::FractureTable};
use crate::{
    air::Air,
    element::{Element, ElementBreak, ElementId, ElementTable},
    heat::{HeatRecord, Warm, held, table::HeatTable, units::ROOM},
    params::{AirParams, Domain, OpenSides},
    particles::Particles,
    relabel::Relabelled,
    solids::{Solids, centre},
    sources::Rect,
    units::Scale,
};
use glam::{IVec2, Vec2};

const BRICK: ElementId = ElementId(0);
const STEEL: ElementId = ElementId(1);
const RUBBLE: ElementId = ElementId(2);
const SCALE: Scale = Scale { spacing: 0.1, detail: 1.0 };
const PARAMS: AirParams = AirParams {
    sound_speed: 400.0,
    density: 1.2,
    open: OpenSides { left: false, right: false, bottom: false, top: false },
};
/// What a metre of brick bears, Pa.
const STRENGTH: f32 = 1e5;
/// Side of the box, d.
const SIDE: i32 = 64;

fn rows() -> Vec<Element> {
    let breaks = Some(ElementBreak { above: STRENGTH, into: "rubble".to_owned() });
    vec![
        Element { breaks, ..Element::plain("brick", true) },
        Element::plain("steel", true),
        Element::plain("rubble", false),
    ]
}

/// What air pushes with, e, whose overpressure is this (Pa): `ρ c² ½ (e² − 1)`.
fn pushing(overpressure: f32) -> f32 {
    (1.0 + 2.0 * overpressure / PARAMS.stiffness(SCALE)).sqrt()
}

/// A box that a wall divides, with air of an overpressure (Pa) before and behind it.
struct Bench {
    elements: ElementTable,
    heat: HeatTable,
    table: FractureTable,
    domain: Domain,
    particles: Particles,
    solids: Solids,
    air: Air,
    record: HeatRecord,
    relabelled: Relabelled,
}

impl Bench {
    /// The wall has these layers from the cell 20 on. `turned`: it lies, in place of standing.
    fn new(layers: &[ElementId], turned: bool, [before, behind]: [f32; 2]) -> Self {
        let elements = ElementTable::new(rows());
        let size = Vec2::splat(SIDE as f32);
        let mut solids = Solids::new(SIDE as u32, SIDE as u32);
        let place =
            |along: i32, across: i32| if turned { IVec2::new(across, along) } else { IVec2::new(along, across) };
        let cells =
            (20..).zip(layers).flat_map(|(along, element)| (0..SIDE).map(move |across| (along, across, *element)));
        for (id, (along, across, element)) in (0..).zip(cells) {
            assert!(solids.insert(place(along, across), element, id));
        }
        let mut air = Air::new(size, 4.0, PARAMS);
        air.set_solids(&solids);
        for (from, to, overpressure) in [(0.0, 20.0, before), (20.0 + layers.len() as f32, size.x, behind)] {
            let place =
                |along: f32, across: f32| if turned { Vec2::new(across, along) } else { Vec2::new(along, across) };
            let area = Rect { min: place(from, 0.0), max: place(to, size.y) };
            air.fill(area, pushing(overpressure), ROOM);
        }
        Self {
            heat: HeatTable::new(&elements),
            table: FractureTable::new(&elements),
            elements,
            domain: Domain { size, gravity: Vec2::ZERO },
            particles: Particles::default(),
            solids,
            air,
            record: HeatRecord::default(),
            relabelled: Relabelled::default(),
        }
    }

    fn warm(&mut self) -> Warm<'_> {
        let Self { particles, solids, elements, heat, domain, .. } = self;
        Warm { particles, solids, elements, table: heat, domain, scale: SCALE }
    }

    /// A tick. Returns how many layers of the wall are whole.
    fn run(&mut self) -> usize {
        let Self { particles, solids, elements, heat, domain, .. } = self;
        let mut warm = Warm { particles, solids, elements, table: heat, domain, scale: SCALE };
        fracture(&mut warm, &self.table, &self.air, &mut self.record, &mut self.relabelled);
        let side = SIDE as usize;
        assert_eq!(self.solids.count() % side, 0, "a layer that is broken in part");
        self.solids.count() / side
    }
}

#[test]
fn a_wall_bears_its_strength_for_each_metre_and_goes_at_once() {
    for (layers, turned) in [(1, false), (3, false), (3, true), (7, true), (19, false)] {
        let bears = STRENGTH * SCALE.spacing * layers as f32;
        for sides in [[1.01, 0.0], [0.0, 1.01], [1.51, 0.5]] {
            let pressed = |share: f32| sides.map(|side| side * share * bears);
            let wall = |pressures| Bench::new(&vec![BRICK; layers], turned, pressures).run();
            assert_eq!(wall(pressed(0.98)), layers, "{layers} layers, {sides:?}");
            assert_eq!(wall(pressed(1.0)), 0, "{layers} layers, {sides:?}");
        }
    }
}

#[test]
fn thick_rock_and_what_lies_before_what_bears_all_is_crushed_layer_by_layer() {
    let bears = 2.0 * STRENGTH;
    for wall in [&[BRICK; 30][..], &[BRICK, BRICK, BRICK, BRICK, STEEL]] {
        for turned in [false, true] {
            assert_eq!(Bench::new(wall, turned, [0.99 * bears, 0.0]).run(), wall.len());
            let mut bench = Bench::new(wall, turned, [1.01 * bears, 0.0]);
            for layer in 1..4 {
                // 6 m/s.
                assert_eq!(bench.run(), wall.len() - layer);
            }
        }
    }
}

#[test]
fn steel_bears_everything() {
    assert_eq!(Bench::new(&[STEEL; 2], false, [100.0 * STRENGTH, 0.0]).run(), 2);
}

#[test]
fn what_the_box_all_but_cuts_off_comes_loose_only_where_there_is_room() {
    let (wall, last) = (IVec2::new(20, 9), IVec2::new(21, 9));
    let mut bench = Bench::new(&[BRICK; 2], false, [0.0, 0.0]);
    let can_be = |bench: &mut Bench, into, beside| Relabelled::rock_can_be(&bench.warm(), last, into, beside);
    for (share, expected) in [(0.14, false), (0.5, true), (1.0, true)] {
        bench.domain.size.x = 21.0 + share;
        assert_eq!(can_be(&mut bench, Some(RUBBLE), None), expected, "{share} of the cell is in the box");
    }
    bench.domain.size.x = 21.14;
    assert!(can_be(&mut bench, Some(STEEL), None) && can_be(&mut bench, None, None), "nothing comes loose");
    assert!(bench.solids.remove(wall));
    assert!(can_be(&mut bench, Some(RUBBLE), None), "there is room beside it");
    assert!(!can_be(&mut bench, Some(RUBBLE), Some(wall)), "a particle hardens there");
}

#[test]
fn what_breaks_keeps_its_number_its_heat_and_its_place() {
    let mut bench = Bench::new(&[BRICK; 2], false, [STRENGTH, 0.0]);
    let warm = IVec2::new(21, 40);
    bench.solids.set_heat(warm, 1234);
    let before: Vec<(u32, Vec2)> = bench.solids.iter().map(|(cell, _, id)| (id, centre(cell))).collect();
    let heat = held(&bench.particles, &bench.solids);
    assert_eq!(bench.run(), 0);
    let particles = &bench.particles;
    let mut after: Vec<(u32, Vec2)> = (0..particles.len()).map(|i| (particles.id[i], particles.position(i))).collect();
    let mut expected = before;
    after.sort_by_key(|(id, _)| *id);
    expected.sort_by_key(|(id, _)| *id);
    assert_eq!(after, expected);
    assert!(particles.element.iter().all(|element| *element == RUBBLE));
    assert!((0..particles.len()).all(|i| particles.velocity(i) == Vec2::ZERO));
    assert_eq!((held(&bench.particles, &bench.solids), bench.record.outside()), (heat, 0));
    assert_eq!(bench.relabelled.places.len(), particles.len());
}

#[test]
fn rows_that_break_into_what_they_may_not_are_refused() {
    let fault = |change: fn(&mut Vec<Element>)| {
        let mut rows = rows();
        change(&mut rows);
        FractureTable::of_rows(&rows).expect_err("a fault").what
    };
    let into = |name: &str| Some(ElementBreak { above: STRENGTH, into: name.to_owned() });
    assert!(FractureTable::of_rows(&rows()).is_ok());
    for (what, found) in [
        ("of `rubble`, which moves", fault(|rows| rows[2].breaks = rows[0].breaks.clone())),
        (
            "above 99 Pa/m; allowed: 100 to 10000000",
            fault(|rows| rows[0].breaks.iter_mut().for_each(|b| b.above = 99.0)),
        ),
        ("above NaN Pa/m", fault(|rows| rows[0].breaks.iter_mut().for_each(|b| b.above = f32::NAN))),
        ("as much `energy` and `gas`", fault(|rows| rows[2].energy = 1.0)),
        ("as much `energy` and `gas`", fault(|rows| rows[0].gas = 1.0)),
    ] {
        assert!(found.contains(what), "{found}");
    }
    for name in ["steel", "brick", "nothing", "air", ""] {
        let mut rows = rows();
        rows[0].breaks = into(name);
        let found = FractureTable::of_rows(&rows).expect_err("a fault");
        assert_eq!((found.row, found.what), (0, format!("into `{name}`; allowed: an element that moves")));
    }
}
