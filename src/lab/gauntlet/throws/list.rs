//! What can be thrown.

use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::ElementId,
        units::TICKS_PER_SECOND,
    },
    sim::{intent::Intent, recording::Entry, state::Setup},
};
use glam::Vec2;

/// Something to throw at a world.
#[derive(Debug)]
pub struct Throw {
    /// Name by which orders call it.
    pub name: &'static str,
    /// What it is, in a word or two.
    pub title: &'static str,
    /// What happens, in a sentence.
    pub what: &'static str,
    /// Elements that it needs.
    needs: &'static [&'static str],
    /// What is done after how many ticks, oldest first.
    act: fn(&Target) -> Vec<(u64, Intent)>,
}

/// The world that something is thrown at.
struct Target<'a> {
    setup: &'a Setup,
    /// Size of the box, d.
    size: Vec2,
}

/// A second and two of them, ticks.
const SECOND: u64 = TICKS_PER_SECOND as u64;
const TWO_SECONDS: u64 = 2 * SECOND;

/// All, in the order in which they are shown.
pub static THROWS: [Throw; 9] = [
    Throw {
        name: "storm",
        title: "A storm",
        what: "Wind of 1,000 m/s in all of the box, four times in a second, this way and that.",
        needs: &[],
        act: |target| {
            let blow = |k: u64| {
                let turn = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
                let velocity = turn * Vec2::new(1000.0, 200.0) / target.setup.blueprint.scale.spacing;
                (k * SECOND / 4, Intent::Blow { stroke: target.everywhere(), velocity })
            };
            (0..4).map(blow).collect()
        },
    },
    Throw {
        name: "blast",
        title: "A blast",
        what: "Air of a million times the pressure of the surroundings, in the middle.",
        needs: &[],
        act: |target| {
            let stroke = Stroke::dab(BrushShape::Disc, 0.5 * target.size, 0.1 * target.size.min_element());
            vec![(0, Intent::Press { stroke, amount: 1e6 })]
        },
    },
    Throw {
        name: "jet",
        title: "A jet of mercury",
        what: "Mercury from above, at 100 m/s, for a second.",
        needs: &["mercury"],
        act: |target| {
            let at = Vec2::new(0.5, 0.92) * target.size;
            let stroke = Stroke::dab(BrushShape::Disc, at, (0.04 * target.size.min_element()).max(2.0));
            let velocity = Vec2::new(0.0, -100.0 / target.setup.blueprint.scale.spacing);
            let element = target.element("mercury");
            (0..SECOND).map(|tick| (tick, Intent::Pour { element, stroke, velocity, share: 1.0 })).collect()
        },
    },
    Throw {
        name: "tumble",
        title: "Up and down",
        what: "What pulls down pulls up in every other tick, for two seconds.",
        needs: &[],
        act: |target| target.pull(|tick| if tick.is_multiple_of(2) { -1.0 } else { 1.0 }),
    },
    Throw {
        name: "weight",
        title: "A hundred g",
        what: "All weighs a hundred times as much, for two seconds.",
        needs: &[],
        act: |target| {
            let gravity = target.setup.domain.gravity;
            [(0, 100.0 * gravity), (TWO_SECONDS, gravity)]
                .map(|(tick, gravity)| (tick, Intent::Gravity { gravity }))
                .into()
        },
    },
    Throw {
        name: "hammer",
        title: "A hammer of rock",
        what: "A block of rock that comes and goes in every tick, and goes through the lower half of the box.",
        needs: &["rock"],
        act: |target| {
            let side = 0.08 * target.size.min_element();
            let stroke = |tick: u64| {
                let share = tick as f32 / TWO_SECONDS as f32;
                let at = Vec2::new(share, 0.1 + 0.3 * (8.0 * share).fract()) * target.size;
                Stroke::dab(BrushShape::Square, at, side)
            };
            let element = target.element("rock");
            let strike = |tick: u64| match tick % 2 {
                0 => (tick, Intent::Draw { element, stroke: stroke(tick) }),
                _ => (tick, Intent::Erase { stroke: stroke(tick - 1) }),
            };
            (0..TWO_SECONDS).map(strike).collect()
        },
    },
    Throw {
        name: "furnace",
        title: "A furnace",
        what: "All becomes 4,000 K hotter at once: ice, water, rock.",
        needs: &[],
        act: |target| vec![(0, Intent::Warm { stroke: target.everywhere(), degrees: 4000.0 })],
    },
    Throw {
        name: "flood",
        title: "A flood of mercury",
        what: "Mercury fills whatever is free, over all that is lighter.",
        needs: &["mercury"],
        act: |target| vec![(0, Intent::Stamp { element: target.element("mercury"), stroke: target.everywhere() })],
    },
    Throw {
        name: "keg",
        title: "A powder keg",
        what: "A heap of gunpowder in the middle, and a match to it.",
        needs: &["gunpowder"],
        act: |target| {
            let stroke = Stroke::dab(BrushShape::Disc, 0.5 * target.size, 0.12 * target.size.min_element());
            let element = target.element("gunpowder");
            vec![(0, Intent::Stamp { element, stroke }), (SECOND / 2, Intent::Ignite { stroke: target.everywhere() })]
        },
    },
];

impl Throw {
    /// That of a name.
    pub fn find(name: &str) -> Option<&'static Self> {
        THROWS.iter().find(|throw| throw.name == name)
    }

    /// The first element that it needs and a world lacks.
    pub fn lacks(&self, setup: &Setup) -> Option<&'static str> {
        self.needs.iter().copied().find(|name| setup.elements().find(name).is_none())
    }

    /// What is done to a world that has done `now` ticks, oldest first. The world lacks nothing of what it needs.
    pub fn input(&self, setup: &Setup, now: u64) -> Vec<Entry> {
        let target = Target { setup, size: setup.domain.size };
        (self.act)(&target).into_iter().map(|(tick, intent)| Entry { tick: now + tick, intent }).collect()
    }
}

impl Target<'_> {
    fn element(&self, name: &str) -> ElementId {
        self.setup.elements().find(name).unwrap_or_default()
    }

    /// A brush over all of the box.
    fn everywhere(&self) -> Stroke {
        Stroke::dab(BrushShape::Disc, 0.5 * self.size, self.size.length())
    }

    /// Gravity that is so many times its own in each tick of two seconds, and itself again after them.
    fn pull(&self, times: impl Fn(u64) -> f32) -> Vec<(u64, Intent)> {
        let own = self.setup.domain.gravity;
        let gravity = |tick: u64| if tick == TWO_SECONDS { own } else { times(tick) * own };
        (0..=TWO_SECONDS).map(|tick| (tick, Intent::Gravity { gravity: gravity(tick) })).collect()
    }
}
