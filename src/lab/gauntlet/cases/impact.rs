//! Fast matter against rock.

use super::common::{element, noise, water};
use crate::lab::gauntlet::case::{Density, Gain, GauntletCase, Rules, Size};
use glam::Vec2;

pub(super) const SHOTS: GauntletCase = GauntletCase {
    name: "shots",
    title: "Shots at rock one layer thick",
    what: "2,000 particles in a closed room of rock one particle thick: a straight wall, and a stair whose stones only touch \
           at their corners. They fly in all directions at 0.5 to 50 d a tick.",
    guards: "Tunnelling: a move longer than the wall is thick ends behind it.",
    allowed: "None through. Speeds that a tick's substeps can't follow are cut, and counted.",
    size: Size::Quick,
    scene: "(title: \"Shots\", spacing: 0.1, size: (10, 10), gravity: (0, 0), effects: {air: off, drag: off})",
    arrange: Some(|blueprint| {
        use glam::IVec2;
        let rock = element(&blueprint.elements, "rock");
        let stones = (0..100).map(|y| IVec2::new(60, y)).chain((0..60).map(|k| IVec2::new(k, 60 - k)));
        for stone in stones {
            if blueprint.solids.insert(stone, rock, blueprint.next_id) {
                blueprint.next_id += 1;
            }
        }
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
    }),
    ticks: 60,
    rules: Rules {
        confines: Some(|at| at.x <= 6.0 && at.x + at.y >= 6.1),
        gain: Some(Gain::Speed(8.0)),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const FALLING_BLOCK: GauntletCase = GauntletCase {
    name: "falling_block",
    title: "A block at 100 m/s onto thin rock",
    what: "A block of 20 × 20 particles falls at 100 m/s onto a floor of rock one particle thick.",
    guards: "The same as the shots, for a body: those behind push those in front through.",
    allowed: "None through; the energy is what it fell with, and a hundredth (10 m/s).",
    size: Size::Quick,
    scene: "(title: \"Falling block\", spacing: 0.1, size: (10, 10), effects: {air: off, drag: off}, contents: [
        (element: \"rock\", shape: Rect(min: (0, 3), max: (10, 3.1))),
        (element: \"water\", shape: Rect(min: (4, 6), max: (6, 8)), velocity: (0, -100))])",
    ticks: 240,
    rules: Rules {
        confines: Some(|at| at.y >= 3.1),
        gain: Some(Gain::Speed(10.0)),
        density: Some(Density { shock: 60, worst: 0.5, end: 0.2 }),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const BULLET: GauntletCase = GauntletCase {
    name: "bullet",
    title: "A bullet along a wall",
    what: "A bullet of 30 particles flies at 1,000 m/s along a wall of rock with a pool behind it, into a corner.",
    guards: "Moves of 160 d a tick: corners that are jumped, and a limiter that can't hold.",
    allowed: "None through, and no faster than it came.",
    size: Size::Quick,
    scene: "(title: \"Bullet\", spacing: 0.1, size: (20, 6), effects: {air: off, drag: off}, contents: [
        (element: \"rock\", shape: Rect(min: (0, 2), max: (20, 2.1))),
        (element: \"water\", shape: Rect(min: (0, 0), max: (20, 1)))])",
    arrange: Some(|blueprint| {
        for k in 0..30 {
            let at = Vec2::new(0.5 + 0.1 * (k / 3) as f32, 2.15 + 0.1 * (k % 3) as f32);
            water(blueprint, at, Vec2::new(1000.0, 0.0));
        }
    }),
    ticks: 180,
    rules: Rules {
        confines: Some(|at| at.y <= 2.0 || at.y >= 2.1),
        gain: Some(Gain::Speed(1.0)),
        fastest: Some(1001.0),
        density: Some(Density { shock: 30, worst: 0.3, end: 0.1 }),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};
