//! Elements at the ends of what elements can be, and beyond.

use super::common::{TREMBLES, change_water, element, water};
use crate::{
    kernel::element::{Element, ElementTable},
    lab::gauntlet::case::{Density, Gain, GauntletCase, Rules, Size},
    scene::blueprint::Blueprint,
};
use glam::Vec2;
use std::sync::Arc;

/// A disc of water that turns once in 2 s, without gravity.
const TURNING: &str =
    "(title: \"Eddy\", spacing: 0.1, size: (8, 8), gravity: (0, 0), effects: {air: off, drag: off}, contents: [
    (element: \"water\", shape: Disc(centre: (4, 4), radius: 2))])";

fn turn(blueprint: &mut Blueprint) {
    for i in 0..blueprint.particles.len() {
        let arm = blueprint.particles.position(i) - Vec2::splat(40.0);
        let velocity = std::f32::consts::PI * arm.perp();
        (blueprint.particles.vx[i], blueprint.particles.vy[i]) = (velocity.x, velocity.y);
    }
}

pub(super) const VORTICITY_BOUND: GauntletCase = GauntletCase {
    name: "vorticity_bound",
    title: "Vorticity confinement at its bound",
    what: "A disc of water that turns once in 2 s, with a confinement of 1 m/s² for each 1/s, the most that an element may \
           have, for 10 s.",
    guards: "Confinement adds energy to every eddy: a blob that turns faster and faster.",
    allowed: "Confinement is there to drive eddies, and may do so: in passing by a third of the start's energy (4.4 m/s \
              rms), 2.6 m/s. At the end there is less than a quarter left.",
    scene: TURNING,
    arrange: Some(|blueprint| {
        change_water(blueprint, |water| water.vorticity = 1.0);
        turn(blueprint);
    }),
    ticks: 600,
    rules: Rules { gain: Some(Gain::Speed(2.6)), rest: Some(0.35), ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

pub(super) const VORTICITY_BEYOND: GauntletCase = GauntletCase {
    name: "vorticity_beyond",
    title: "Vorticity confinement a hundred times past its bound",
    what: "The same with 100 m/s² for each 1/s, which no element file can set.",
    guards: "The same, where only a limiter can hold it.",
    allowed: "The limiter cuts it to what a substep can take, and counts. What a substep can take is \
              more a second where there are more of them, at `reference` eight times as much: 10 m/s. It goes on stirring \
              the water: at the end by 0.67 d a tick there.",
    scene: TURNING,
    arrange: Some(|blueprint| {
        change_water(blueprint, |water| water.vorticity = 100.0);
        turn(blueprint);
    }),
    ticks: 300,
    rules: Rules { gain: Some(Gain::Speed(10.0)), rest: Some(0.8), ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

pub(super) const VISCOSITY_BOUND: GauntletCase = GauntletCase {
    name: "viscosity_bound",
    title: "Viscosity at its bound",
    what: "A column of water with half of every difference of velocity evened out each tick, the most that an element may \
           have, collapses.",
    guards: "Explicit viscosity beyond its bound turns differences over and makes them grow.",
    allowed: "Energy: a hundredth of that of the column over the floor (2 m on the mean), 0.63 m/s.",
    size: Size::Quick,
    scene: COLUMN,
    arrange: Some(|blueprint| change_water(blueprint, |water| water.viscosity = 0.5)),
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Speed(0.63)),
        density: Some(Density { shock: 10, worst: 0.3, end: 0.1 }),
        work: 2.0,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const VISCOSITY_BEYOND: GauntletCase = GauntletCase {
    name: "viscosity_beyond",
    title: "Viscosity ten times past its bound",
    what: "The same with ten times as much, which no element file can set.",
    guards: "The same, where only a limiter can hold it.",
    allowed: "Energy: a hundredth of that of the column over the floor (2 m on the mean), 0.63 m/s.",
    size: Size::Quick,
    scene: COLUMN,
    arrange: Some(|blueprint| change_water(blueprint, |water| water.viscosity = 5.0)),
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Speed(0.63)),
        density: Some(Density { shock: 10, worst: 0.3, end: 0.1 }),
        work: 2.0,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

const COLUMN: &str = "(title: \"Column\", spacing: 0.1, size: (8, 5), effects: {air: off, drag: off}, contents: [
    (element: \"water\", shape: Rect(min: (0, 0), max: (2, 4)))])";

/// Water in a wind.
const WIND: &str = "(title: \"Drag\", spacing: 0.1, size: (8, 4), open: (left: true, right: true),
    winds: [(min: (0, 0), max: (8, 4), velocity: (20, 0), rate: 100)], contents: [
    (element: \"water\", shape: Rect(min: (0, 0), max: (3, 1))),
    (element: \"water\", shape: Rect(min: (1, 3), max: (1.1, 3.1)), velocity: (-100, 0))])";

/// Fastest that drag may leave any particle: as fast as the wind blows (20 m/s), with what air that is held up by water does.
const DRAGGED: f64 = 60.0;

pub(super) const DRAG_HUGE: GauntletCase = GauntletCase {
    name: "drag_huge",
    title: "Drag with a huge coefficient",
    what: "Water with a drag of 10⁹ kg/m, a million times the bound, in a wind of 20 m/s; a drop flies against it at \
           100 m/s.",
    guards: "Explicit drag overshoots where C|v|Δt is above 1, and turns velocities round, larger.",
    allowed: "No particle is ever faster than the drop came (100 m/s).",
    size: Size::Quick,
    scene: WIND,
    arrange: Some(|blueprint| change_water(blueprint, |water| water.drag = 1e9)),
    ticks: 240,
    rules: Rules { fastest: Some(100.1), also: Some(|world| slower(world, DRAGGED)), ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

pub(super) const DRAG_LIGHT: GauntletCase = GauntletCase {
    name: "drag_light",
    title: "Drag on next to no mass",
    what: "A liquid of 1 kg/m², the least that an element may have, with a drag of 1,000 kg/m, the most, in the same wind.",
    guards: "The same, by a tiny mass.",
    allowed: "No particle is ever faster than the drop came (100 m/s).",
    size: Size::Quick,
    scene: WIND,
    arrange: Some(|blueprint| {
        change_water(blueprint, |water| (water.density, water.drag) = (1.0, 1000.0));
    }),
    ticks: 240,
    rules: Rules { fastest: Some(100.1), also: Some(|world| slower(world, DRAGGED)), ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

fn slower(world: &bevy::ecs::world::World, most: f64) -> Result<(), String> {
    let fastest = crate::lab::balance::matter(world).balance().max_speed;
    if fastest <= most { Ok(()) } else { Err(format!("{fastest:.1} m/s at the end, allowed {most}")) }
}

pub(super) const HEAVY_ABOVE_LIGHT: GauntletCase = GauntletCase {
    name: "heavy_above_light",
    title: "Heavy above light, 1000 : 1",
    what: "Water lies on a liquid of a thousandth of its density in a closed box.",
    guards: "Densities that differ by a thousand: a light particle under heavy ones is shot away, or the solve does not \
             converge.",
    allowed: "Energy: 1 m/s beyond the start's; density error 30 %.",
    size: Size::Quick,
    scene: "(title: \"Two liquids\", spacing: 0.1, size: (4, 5), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (4, 2)))])",
    arrange: Some(|blueprint| {
        let mut rows: Vec<Element> = blueprint.elements.iter().map(|(_, element)| element.clone()).collect();
        let water_row = blueprint.elements.get(element(&blueprint.elements, "water")).clone();
        rows.push(Element { name: "light".into(), density: 1.0, key: None, colour: [240, 220, 130], ..water_row });
        blueprint.elements = Arc::new(ElementTable::new(rows));
        let light = element(&blueprint.elements, "light");
        for i in 0..blueprint.particles.len() {
            if blueprint.particles.y[i] < 10.0 {
                blueprint.particles.element[i] = light;
            }
        }
        water(blueprint, Vec2::new(2.05, 2.55), Vec2::ZERO);
    }),
    ticks: 420,
    rules: Rules {
        gain: Some(Gain::Speed(1.0)),
        density: Some(Density { shock: 10, worst: 0.3, end: 0.1 }),
        rest: Some(0.05),
        work: 1.5,
        ..Rules::ALWAYS
    },
    known: Some(TREMBLES),
    ..GauntletCase::USUAL
};
