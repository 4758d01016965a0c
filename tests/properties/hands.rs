//! Random hands: what tools and keys can ask of a world, sensible or not.

use crate::support::{ROCK, WATER};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::ElementId,
        params::Preset,
    },
    scene::effects::{Effect, Mode},
    sim::{intent::Intent, recording::Entry},
};
use proptest::prelude::*;

/// A place in a box of `size` d or a little outside; now and then far from it.
fn place(size: Vec2) -> impl Strategy<Value = Vec2> {
    let near = (-0.1_f32..1.1, -0.1_f32..1.1).prop_map(move |(x, y)| Vec2::new(x, y) * size);
    let far = (-1_f32..1.0, -1_f32..1.0).prop_map(|(x, y)| Vec2::new(x, y) * 1e9);
    prop_oneof![30 => near, 1 => far]
}

fn stroke(size: Vec2) -> impl Strategy<Value = Stroke> {
    let shape = prop_oneof![Just(BrushShape::Disc), Just(BrushShape::Square), Just(BrushShape::Rectangle)];
    let radius = prop_oneof![20 => 0.0_f32..12.0, 2 => Just(0.0), 1 => Just(1e9_f32)];
    (shape, place(size), place(size), radius).prop_map(|(shape, from, to, radius)| {
        // A line over half the box would leave nothing of it.
        let to = if to.abs().max_element() < 1e6 { from + 0.3 * (to - from) } else { to };
        Stroke { shape, from, to, radius }
    })
}

fn element() -> impl Strategy<Value = ElementId> {
    prop_oneof![3 => Just(WATER), 1 => Just(ROCK)]
}

fn wind() -> impl Strategy<Value = Vec2> {
    let scale = prop_oneof![Just(0.0_f32), Just(30.0), Just(2000.0), Just(1e6), Just(1e30)];
    (-1_f32..1.0, -1_f32..1.0, scale).prop_map(|(x, y, scale)| Vec2::new(x, y) * scale)
}

fn intent(size: Vec2) -> impl Strategy<Value = Intent> {
    let amount = prop_oneof![4 => -3_f32..5.0, 1 => Just(1e6_f32), 1 => Just(-1e6_f32), 1 => Just(1e30_f32)];
    prop_oneof![
        5 => (element(), stroke(size)).prop_map(|(element, stroke)| Intent::Draw { element, stroke }),
        2 => (element(), stroke(size)).prop_map(|(element, stroke)| Intent::Stamp { element, stroke }),
        1 => (element(), place(size)).prop_map(|(element, at)| Intent::Fill { element, at }),
        3 => stroke(size).prop_map(|stroke| Intent::Erase { stroke }),
        2 => (stroke(size), wind()).prop_map(|(stroke, velocity)| Intent::Blow { stroke, velocity }),
        2 => (stroke(size), amount).prop_map(|(stroke, amount)| Intent::Press { stroke, amount }),
        1 => Just(Intent::ClearAir),
        1 => (0..Preset::ALL.len() - 1).prop_map(|k| {
            let preset = Preset::ALL[k];
            Intent::Quality { preset, quality: preset.quality() }
        }),
        2 => (0..Effect::ALL.len(), mode()).prop_map(|(k, mode)| Intent::Effect { effect: Effect::ALL[k], mode }),
        1 => (-200_f32..200.0, -200_f32..200.0).prop_map(|(x, y)| Intent::Gravity { gravity: Vec2::new(x, y) }),
    ]
}

fn mode() -> impl Strategy<Value = Mode> {
    prop_oneof![Just(Mode::Auto), Just(Mode::On), Just(Mode::Off)]
}

/// What is done to a world of `size` d in `ticks` ticks, oldest first.
pub fn input(size: Vec2, ticks: u32) -> impl Strategy<Value = Vec<Entry>> {
    let entry = (0..u64::from(ticks.max(1)), intent(size)).prop_map(|(tick, intent)| Entry { tick, intent });
    prop::collection::vec(entry, 0..10).prop_map(|mut input| {
        input.sort_by_key(|entry| entry.tick);
        input
    })
}
