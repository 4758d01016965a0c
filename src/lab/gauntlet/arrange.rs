//! What the start of a case has that its scene's text can't say. Lengths are in m or in the scene's own spacings, so
//! that a quality of another detail has the same start.

use crate::{
    kernel::{
        element::{Element, ElementId, ElementTable},
        heat::{table::HeatTable, units::ROOM},
        random::{mix, unit},
        solids::centre,
        sources::Rect,
    },
    scene::blueprint::{Blueprint, PressurePatch},
};
use glam::{IVec2, Vec2};
use std::sync::Arc;

/// Changes a start.
type Arrange = fn(&mut Blueprint);

/// By the names of the cases.
pub(super) const STARTS: [(&str, Arrange); 27] = [
    ("two_at_a_point", |blueprint| {
        for at in [Vec2::new(2.0, 1.0), Vec2::new(4.03, 0.025)] {
            (0..2).for_each(|_| water(blueprint, at, Vec2::ZERO));
        }
    }),
    ("point_64", |blueprint| (0..64).for_each(|_| water(blueprint, Vec2::new(3.02, 0.84), Vec2::ZERO))),
    ("point_10000", |blueprint| (0..10_000).for_each(|_| water(blueprint, Vec2::new(9.02, 7.04), Vec2::ZERO))),
    ("grid_tenth", |blueprint| grid(blueprint, 0.01)),
    ("grid_third", |blueprint| grid(blueprint, 0.03)),
    ("spawn_over_water", |blueprint| {
        for k in 0..300 {
            let at = Vec2::new(3.0, 0.75) + noise(k) * Vec2::new(5.9, 1.4);
            water(blueprint, at, Vec2::ZERO);
        }
    }),
    ("close_pairs", close_pairs),
    ("overfull_shaft", |blueprint| {
        for k in 0..80 {
            let at = Vec2::new(1.1 + 0.1 * (k % 3) as f32, 1.1 + 9.8 * k as f32 / 80.0);
            water(blueprint, at, Vec2::ZERO);
        }
    }),
    ("overfull_file", |blueprint| {
        for k in 0..20 {
            water(blueprint, Vec2::new(1.05, 1.1 + 9.8 * k as f32 / 20.0), Vec2::ZERO);
        }
    }),
    ("shots", shots),
    ("bullet", |blueprint| {
        for k in 0..30 {
            let at = Vec2::new(0.5 + 0.1 * (k / 3) as f32, 2.15 + 0.1 * (k % 3) as f32);
            water(blueprint, at, Vec2::new(1000.0, 0.0));
        }
    }),
    ("weightless", |blueprint| {
        for k in 0..120 {
            let cell = Vec2::new((k % 12) as f32, (k / 12) as f32);
            water(blueprint, Vec2::splat(0.05) + Vec2::new(0.535, 0.54) * cell, Vec2::ZERO);
        }
    }),
    ("vacuum", |blueprint| {
        let d = blueprint.scale.detail;
        let area = Rect { min: d * Vec2::new(40.0, 0.0), max: d * Vec2::new(80.0, 60.0) };
        blueprint.pressures.push(PressurePatch { area, pressure: 0.0, kelvin: ROOM });
    }),
    ("one_cell_hole", |blueprint| {
        for y in 8..12 {
            for x in 8..13 {
                if x < 12 || y == 9 {
                    for cell in finer(blueprint, IVec2::new(x, y)) {
                        blueprint.solids.remove(cell);
                    }
                }
            }
        }
    }),
    ("vorticity_bound", |blueprint| {
        change_water(blueprint, |water| water.vorticity = 1.0);
        turn(blueprint);
    }),
    ("vorticity_beyond", |blueprint| {
        change_water(blueprint, |water| water.vorticity = 100.0);
        turn(blueprint);
    }),
    ("viscosity_bound", |blueprint| change_water(blueprint, |water| water.smoothing = 0.5)),
    ("viscosity_beyond", |blueprint| change_water(blueprint, |water| water.smoothing = 50.0)),
    ("drag_huge", |blueprint| change_water(blueprint, |water| water.drag = 1e9)),
    ("drag_light", |blueprint| change_water(blueprint, |water| (water.density, water.drag) = (1.0, 1000.0))),
    ("heavy_above_light", heavy_above_light),
    ("every_pair", |blueprint| every_pair(blueprint, None)),
    ("every_pair_cold", |blueprint| every_pair(blueprint, Some(77.0))),
    ("every_pair_hot", |blueprint| every_pair(blueprint, Some(2000.0))),
    ("crowded_changes", |blueprint| {
        for (x, name) in [(0.85, "sand"), (1.95, "water"), (3.05, "brine")] {
            (0..64).for_each(|_| lump(blueprint, name, Vec2::new(x, 0.84), Vec2::ZERO));
        }
    }),
    ("thin_walls", thin_walls),
    ("strong_grains", |blueprint| {
        change(blueprint, "sand", |sand| (sand.friction, sand.cohesion) = (60.0, 50_000.0));
    }),
];

/// Adds to the start of a case what belongs to it.
pub(super) fn arrange(case: &str, blueprint: &mut Blueprint) {
    STARTS.iter().filter(|(name, _)| *name == case).for_each(|(_, start)| start(blueprint));
}

/// The element called `name`; every table has those of the built-in scenes.
pub(super) fn element(elements: &ElementTable, name: &str) -> ElementId {
    elements.find(name).unwrap_or_default()
}

/// The cells of the run that a cell of the scene's own spacing covers, at least in part.
fn finer(blueprint: &Blueprint, cell: IVec2) -> impl Iterator<Item = IVec2> + use<> {
    let d = blueprint.scale.detail;
    let (low, high) = ((cell.as_vec2() * d).floor().as_ivec2(), ((cell + 1).as_vec2() * d).ceil().as_ivec2());
    (low.y..high.y).flat_map(move |y| (low.x..high.x).map(move |x| IVec2::new(x, y)))
}

/// Adds a particle of water, at a place and a velocity in m.
fn water(blueprint: &mut Blueprint, at: Vec2, velocity: Vec2) {
    lump(blueprint, "water", at, velocity);
}

/// Adds a particle of an element, at a place and a velocity in m.
fn lump(blueprint: &mut Blueprint, name: &str, at: Vec2, velocity: Vec2) {
    let id = element(&blueprint.elements, name);
    let (at, velocity) = (blueprint.scale.vec_to_kernel(at), blueprint.scale.vec_to_kernel(velocity));
    blueprint.particles.push(blueprint.next_id, id, at, velocity);
    blueprint.next_id += 1;
}

/// Puts rock into cells of the scene's own spacing that are free.
fn rock(blueprint: &mut Blueprint, cells: impl IntoIterator<Item = IVec2>) {
    let rock = element(&blueprint.elements, "rock");
    for cell in cells.into_iter().flat_map(|cell| finer(blueprint, cell)).collect::<Vec<_>>() {
        if blueprint.solids.insert(cell, rock, blueprint.next_id) {
            blueprint.next_id += 1;
        }
    }
}

/// Changes what water is.
fn change_water(blueprint: &mut Blueprint, to: impl Fn(&mut Element)) {
    change(blueprint, "water", to);
}

/// Changes what an element is.
fn change(blueprint: &mut Blueprint, name: &str, to: impl Fn(&mut Element)) {
    let mut rows: Vec<Element> = blueprint.elements.iter().map(|(_, element)| element.clone()).collect();
    rows.iter_mut().filter(|row| row.name == name).for_each(to);
    blueprint.elements = Arc::new(ElementTable::new(rows));
}

/// Two numbers in −½ … ½ that belong to `seed`.
fn noise(seed: u32) -> Vec2 {
    let mixed = mix(seed);
    Vec2::new(unit(mixed), unit(mixed >> 16)) * 0.5
}

/// A block of 40 × 40 particles, `spacing` m apart.
fn grid(blueprint: &mut Blueprint, spacing: f32) {
    for k in 0..1600 {
        let cell = Vec2::new((k % 40) as f32 - 19.5, (k / 40) as f32 - 19.5);
        water(blueprint, Vec2::new(3.0, 2.0) + spacing * cell, Vec2::ZERO);
    }
}

fn close_pairs(blueprint: &mut Blueprint) {
    let gaps = [1e-38, 1e-30, 1e-20, 1e-12, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.249, 0.25, 0.3];
    for (k, gap) in gaps.into_iter().enumerate() {
        // At the left wall's corner such gaps are not rounded away.
        for (row, way) in [Vec2::X, Vec2::Y, Vec2::new(0.6, 0.8)].into_iter().enumerate() {
            let at = Vec2::new(0.5 + 1.1 * k as f32, 1.5 + 2.0 * row as f32);
            water(blueprint, at, Vec2::ZERO);
            water(blueprint, at + gap * way, Vec2::ZERO);
            if row == 2 {
                water(blueprint, at - gap * way, Vec2::ZERO);
            }
        }
    }
}

fn shots(blueprint: &mut Blueprint) {
    rock(blueprint, (0..100).map(|y| IVec2::new(60, y)).chain((0..60).map(|k| IVec2::new(k, 60 - k))));
    let mut seed = 0;
    while blueprint.particles.len() < 2000 {
        let at = Vec2::splat(5.0) + 9.8 * noise(seed);
        let way = noise(seed + 1).normalize_or(Vec2::X);
        seed += 2;
        if at.x < 5.95 && at.x + at.y > 6.25 {
            let per_tick = [0.5, 1.0, 3.0, 7.0, 20.0, 50.0][seed as usize / 2 % 6];
            water(blueprint, at, way * per_tick * 0.1 * 60.0);
        }
    }
}

/// Turns all water about the middle of the box, once in 2 s.
fn turn(blueprint: &mut Blueprint) {
    for i in 0..blueprint.particles.len() {
        let arm = blueprint.particles.position(i) - blueprint.scale.detail * Vec2::splat(40.0);
        let velocity = std::f32::consts::PI * arm.perp();
        (blueprint.particles.vx[i], blueprint.particles.vy[i]) = (velocity.x, velocity.y);
    }
}

/// Makes the lower half of the water a liquid of a thousandth of its density.
fn heavy_above_light(blueprint: &mut Blueprint) {
    let mut rows: Vec<Element> = blueprint.elements.iter().map(|(_, element)| element.clone()).collect();
    let water_row = blueprint.elements.get(element(&blueprint.elements, "water")).clone();
    rows.push(Element { name: "light".into(), density: 1.0, key: None, colour: [240, 220, 130], ..water_row });
    blueprint.elements = Arc::new(ElementTable::new(rows));
    let light = element(&blueprint.elements, "light");
    for i in 0..blueprint.particles.len() {
        if blueprint.particles.y[i] < 10.0 * blueprint.scale.detail {
            blueprint.particles.element[i] = light;
        }
    }
    water(blueprint, Vec2::new(2.05, 2.55), Vec2::ZERO);
}

/// Basins of water, with upright walls below and slanting ones above: their cells of the predictor's grid, which are two and a half
/// spacings wide, cut the walls wherever they can.
fn thin_walls(blueprint: &mut Blueprint) {
    const DEEP: i32 = 18;
    for (row, steep, thick) in [(0, 0, 2), (1, 6, 3)] {
        for k in 0..5 {
            let floor = IVec2::new(36 * k + 18, 30 * row + 4) + k;
            let half = |y: i32| -> i32 { 5 + steep * y.max(0) / 10 };
            for (x, y) in (-thick..DEEP + 4).flat_map(|y| (-18_i32..18).map(move |x| (x, y))) {
                let outside = (2 * x + 1).abs() / 2 - half(y);
                let cell = floor + IVec2::new(x, y);
                if outside < thick && (outside >= 0 || y < 0) {
                    rock(blueprint, [cell]);
                } else if outside < 0 && y < DEEP {
                    for cell in finer(blueprint, cell) {
                        water(blueprint, blueprint.scale.vec_to_metres(centre(cell)), Vec2::ZERO);
                    }
                }
            }
        }
    }
}

/// A basin for any two elements that move, one over the other: as warm as they come, or as near to a temperature (K) as they stay
/// what they are.
fn every_pair(blueprint: &mut Blueprint, kelvin: Option<f32>) {
    const INSIDE: IVec2 = IVec2::new(6, 12);
    const DEEP: i32 = 4;
    let rows = blueprint.elements.iter();
    let movable: Vec<ElementId> = rows.filter(|(_, element)| !element.fixed).map(|(id, _)| id).collect();
    let pairs = movable.iter().flat_map(|lower| movable.iter().map(move |upper| [*lower, *upper]));
    let across = movable.len() as i32;
    let table = HeatTable::new(&blueprint.elements);
    let heat = |element: ElementId| {
        let curve = table.curve(element);
        let [coldest, hottest] = curve.stays_between();
        kelvin.map_or_else(|| table.spawn_heat(element), |kelvin| curve.heat(kelvin.clamp(coldest, hottest)))
    };
    for (k, pair) in pairs.filter(|[lower, upper]| lower != upper).enumerate() {
        let corner = IVec2::new(k as i32 % across, k as i32 / across) * (INSIDE + 1);
        let walls = (0..=INSIDE.x + 1).flat_map(|x| (0..=INSIDE.y + 1).map(move |y| IVec2::new(x, y)));
        let walls = walls.filter(|at| at.x == 0 || at.y == 0 || at.x == INSIDE.x + 1 || at.y == INSIDE.y + 1);
        rock(blueprint, walls.map(|cell| corner + cell));
        for (row, element) in (0..2 * DEEP).map(|row| (row, pair[(row / DEEP) as usize])) {
            for column in 0..INSIDE.x {
                for cell in finer(blueprint, corner + IVec2::new(1 + column, 1 + row)).collect::<Vec<_>>() {
                    let (id, heat) = (blueprint.next_id, heat(element));
                    blueprint.particles.push_warm(id, element, centre(cell), Vec2::ZERO, heat);
                    blueprint.next_id += 1;
                }
            }
        }
    }
}
