//! Random hands: what tools and keys can ask of a world, sensible or not.

use super::dice::Dice;
use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::{ElementId, ElementTable},
        params::Preset,
    },
    scene::effects::{Effect, Mode},
    sim::{intent::Intent, recording::Entry},
};
use glam::Vec2;

/// Most that hands do in a world.
const MOST: u32 = 10;

/// The hands on a world.
pub(super) struct Hands<'a> {
    /// Size of the box, d.
    pub size: Vec2,
    /// What there is to draw with.
    pub elements: &'a ElementTable,
}

impl Hands<'_> {
    /// A place in the box or a little outside; now and then far from it.
    fn place(&self, dice: &mut Dice) -> Vec2 {
        if dice.comes(1, 31) {
            return dice.vector(1e9);
        }
        (Vec2::new(dice.share(), dice.share()) * 1.2 - 0.1) * self.size
    }

    fn stroke(&self, dice: &mut Dice) -> Stroke {
        let shape = dice.one(&[BrushShape::Disc, BrushShape::Square, BrushShape::Rectangle]);
        let (from, to) = (self.place(dice), self.place(dice));
        let radius = match dice.below(23) {
            0 | 1 => 0.0,
            2 => 1e9,
            _ => 12.0 * dice.share(),
        };
        // A line over half the box would leave nothing of it.
        let to = if to.abs().max_element() < 1e6 { from + 0.3 * (to - from) } else { to };
        Stroke { shape, from, to, radius }
    }

    fn element(&self, dice: &mut Dice) -> ElementId {
        let fixed = dice.comes(1, 4);
        let wanted: Vec<ElementId> =
            self.elements.iter().filter(|(_, element)| element.fixed == fixed).map(|(id, _)| id).collect();
        if wanted.is_empty() { ElementId::default() } else { dice.one(&wanted) }
    }

    fn intent(&self, dice: &mut Dice) -> Intent {
        match dice.below(24) {
            0..5 => Intent::Draw { element: self.element(dice), stroke: self.stroke(dice) },
            5 | 6 => Intent::Stamp { element: self.element(dice), stroke: self.stroke(dice) },
            7 => Intent::Fill { element: self.element(dice), at: self.place(dice) },
            8..11 => Intent::Erase { stroke: self.stroke(dice) },
            11 | 12 => {
                let strength = dice.one(&[0.0, 30.0, 2000.0, 1e6, 1e30]);
                Intent::Blow { stroke: self.stroke(dice), velocity: dice.vector(1.0) * strength }
            }
            13 | 14 => {
                let stroke = self.stroke(dice);
                let amount = match dice.below(7) {
                    0..4 => 8.0 * dice.share() - 3.0,
                    4 => 1e6,
                    5 => -1e6,
                    _ => 1e30,
                };
                Intent::Press { stroke, amount }
            }
            20 | 21 => {
                let degrees = dice.one(&[5.0, 300.0, 4000.0, 1e30]) * dice.one(&[1.0, -1.0]);
                Intent::Warm { stroke: self.stroke(dice), degrees }
            }
            22 => {
                let kelvin = dice.one(&[-1e30, 0.0, 77.0, 293.0, 700.0, 4000.0, 1e30]);
                Intent::SetTemperature { stroke: self.stroke(dice), kelvin }
            }
            23 => Intent::Ignite { stroke: self.stroke(dice) },
            15 => Intent::ClearAir,
            16 => quality(dice, &Preset::ALL, 1.0),
            17 | 18 => {
                let effect = dice.one(&Effect::ALL);
                Intent::Effect { effect, mode: dice.one(&MODES) }
            }
            _ => Intent::Gravity { gravity: dice.vector(200.0) },
        }
    }

    /// What is done in the first `ticks` ticks, oldest first.
    pub fn act(&self, dice: &mut Dice, ticks: u32) -> Vec<Entry> {
        in_order(dice, ticks, |dice| self.intent(dice))
    }
}

const MODES: [Mode; 3] = [Mode::Auto, Mode::On, Mode::Off];

/// Another quality, of such a detail.
fn quality(dice: &mut Dice, of: &[Preset], detail: f64) -> Intent {
    let same: Vec<Preset> = of.iter().copied().filter(|preset| preset.detail() == detail).collect();
    let preset = dice.one(&same);
    Intent::Quality { preset, quality: preset.quality() }
}

/// Hands that change nothing which moves the still water of a world that begins at `preset`: other qualities with the
/// predictor, other effects of the air, calm air.
pub(super) fn idle(dice: &mut Dice, preset: Preset, ticks: u32) -> Vec<Entry> {
    in_order(dice, ticks, |dice| match dice.below(4) {
        0 => Intent::ClearAir,
        1 | 2 => quality(dice, &Preset::ALL[1..], preset.detail()),
        _ => {
            let effect = dice.one(&[Effect::Air, Effect::AirFeedback, Effect::Drag]);
            Intent::Effect { effect, mode: dice.one(&MODES) }
        }
    })
}

fn in_order(dice: &mut Dice, ticks: u32, mut intent: impl FnMut(&mut Dice) -> Intent) -> Vec<Entry> {
    let count = dice.whole(0, MOST - 1);
    let mut input: Vec<Entry> =
        (0..count).map(|_| Entry { tick: u64::from(dice.whole(0, ticks.max(1) - 1)), intent: intent(dice) }).collect();
    input.sort_by_key(|entry| entry.tick);
    input
}
