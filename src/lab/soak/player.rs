//! A player by script: the same play for the same seed.

use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::{Element, ElementId},
        random::Random,
        solids::Solids,
    },
    scene::blueprint::Blueprint,
    sim::intent::Intent,
};
use glam::{IVec2, Vec2};
use serde::{Deserialize, Serialize};

/// Ticks from one bout to the next: a minute.
pub(super) const BOUT: u64 = 3600;

/// Longest wall that the player builds, and its thickness, in the scene's own spacings.
const WALL: Vec2 = Vec2::new(14.0, 2.0);
/// Thinnest wall, d: two cells of it stop what comes.
const THINNEST: f32 = 2.0;

/// Plays in bouts of a minute: pours for some seconds here and there, builds a wall, blows and sucks, and takes the wall
/// away again. Between these the world is left alone. What it builds stands where the scene has no rock, so
/// that taking it away leaves the scene as it was. At another detail it does the same in metres.
#[derive(Clone, Debug)]
pub(super) struct Player {
    /// What changes as it plays.
    pub hand: Hand,
    size: Vec2,
    /// The scene's own spacing, d.
    unit: f32,
    ground: Solids,
    movable: Vec<ElementId>,
    fixed: Vec<ElementId>,
}

/// The player's hand: with it and the scene's start, a player goes on as if it had never stopped.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Hand {
    random: Random,
    /// The wall that stands.
    wall: Option<Stroke>,
    /// Where the pointer is, d.
    at: Vec2,
}

impl Player {
    /// A player of the scene at its start, with random choices by `seed`.
    pub fn new(blueprint: &Blueprint, seed: u64) -> Self {
        let elements = &blueprint.elements;
        // A day of acid would leave no scene, and a day of plants nothing else.
        let changes_rock = |element: &Element| {
            let is_fixed = |name: &str| elements.find(name).is_some_and(|id| elements.get(id).fixed);
            element.touches.iter().any(|touch| element.fixed || is_fixed(&touch.with))
        };
        let of = |fixed: bool| {
            let wanted = |(_, element): &(_, &Element)| element.fixed == fixed && !changes_rock(element);
            elements.iter().filter(wanted).map(|(id, _)| id).collect()
        };
        Self {
            hand: Hand { random: Random::new(seed), wall: None, at: 0.5 * blueprint.domain.size },
            size: blueprint.domain.size,
            unit: blueprint.scale.detail,
            ground: blueprint.solids.clone(),
            movable: of(false),
            fixed: of(true),
        }
    }

    /// What the player does in a tick.
    pub fn act(&mut self, tick: u64) -> Option<Intent> {
        match tick % BOUT {
            300..600 => self.pour(),
            600 => self.build(),
            900..1080 => Some(self.blow()),
            1200..1212 => Some(self.press()),
            1800 => self.hand.wall.take().map(|stroke| Intent::Erase { stroke }),
            2000 => Some(Intent::ClearAir),
            _ => None,
        }
    }

    fn pour(&mut self) -> Option<Intent> {
        // One tick in four, as a hand dabs; the element of a dab is any that moves.
        if self.hand.random.below(4) > 0 || self.movable.is_empty() {
            return None;
        }
        let choice = self.hand.random.below(self.movable.len());
        let element = self.movable[choice];
        let stroke = self.drag(3.0);
        Some(Intent::Draw { element, stroke })
    }

    fn build(&mut self) -> Option<Intent> {
        let corner = self.point();
        let wall = (WALL * self.unit).max(Vec2::splat(THINNEST));
        let way = if self.hand.random.below(2) == 0 { wall } else { Vec2::new(wall.y, wall.x) };
        let stroke = Stroke::rectangle(corner, (corner + way).min(self.size));
        let size = IVec2::new(self.ground.columns(), self.ground.rows());
        if self.fixed.is_empty() || stroke.cells(size).any(|cell| self.ground.is_solid(cell)) {
            return None;
        }
        self.hand.wall = Some(stroke);
        let choice = self.hand.random.below(self.fixed.len());
        Some(Intent::Stamp { element: self.fixed[choice], stroke })
    }

    fn blow(&mut self) -> Intent {
        let stroke = self.drag(8.0);
        let velocity = (self.point() / self.size - 0.5) * 800.0 * self.unit;
        Intent::Blow { stroke, velocity }
    }

    fn press(&mut self) -> Intent {
        let amount = if self.hand.random.below(2) == 0 { 0.1 } else { -0.1 };
        Intent::Press { stroke: self.drag(6.0), amount }
    }

    /// A short drag of a brush of a radius in the scene's own spacings, from where the pointer is; now and then the
    /// pointer is lifted and set down elsewhere.
    fn drag(&mut self, radius: f32) -> Stroke {
        if self.hand.random.below(20) == 0 {
            self.hand.at = self.point();
        }
        let from = self.hand.at;
        let step = (self.point() / self.size - 0.5) * 8.0 * self.unit;
        self.hand.at = (from + step).clamp(Vec2::ZERO, self.size);
        Stroke { shape: BrushShape::Disc, from, to: self.hand.at, radius: radius * self.unit }
    }

    /// Anywhere in the box, d.
    fn point(&mut self) -> Vec2 {
        Vec2::new(self.hand.random.share(), self.hand.random.share()) * self.size
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{self, effects::EffectModes};

    fn acts(seed: u64, bouts: u64) -> Vec<Intent> {
        let blueprint = scene::load("waterfall").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        let mut player = Player::new(&blueprint, seed);
        (0..bouts * BOUT).filter_map(|tick| player.act(tick)).collect()
    }

    #[test]
    fn the_same_seed_plays_the_same_and_does_everything() {
        let played = acts(1, 20);
        assert_eq!(played, acts(1, 20));
        assert_ne!(played, acts(2, 20));
        let some = |kind: fn(&Intent) -> bool| played.iter().filter(|intent| kind(intent)).count();
        assert!(some(|intent| matches!(intent, Intent::Draw { .. })) > 500);
        assert!(some(|intent| matches!(intent, Intent::Blow { .. })) > 500);
        assert!(some(|intent| matches!(intent, Intent::Press { .. })) > 100);
        let walls = some(|intent| matches!(intent, Intent::Stamp { .. }));
        assert!(walls > 5 && walls == some(|intent| matches!(intent, Intent::Erase { .. })), "{walls} walls");
    }
}
