//! The format of a solution: what stands in `assets/challenges/solutions/*.ron`. Lengths in m, times in s of the world.

use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::{ElementId, ElementTable},
        units::{TICK_SECONDS, TICKS_PER_SECOND},
    },
    lab::{
        colours::Reference,
        hand::{self, AIR_BRUSH, PRESS_STEP, WARM_STEP},
    },
    sim::{intent::Intent, recording::Entry, state::Setup},
};
use glam::{DVec2, Vec2};
use include_dir::{Dir, include_dir};
use serde::Deserialize;

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/challenges/solutions");

/// What a player's hand does from a press to its release.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Move {
    /// When it begins, s.
    at: f64,
    /// How long it takes, s; at least a tick. A line and a rectangle are done in one tick, at its end.
    #[serde(default)]
    takes: f64,
    /// With what.
    with: With,
    /// Its way: at least one point, m. The hand goes along it at one speed.
    along: Vec<DVec2>,
    /// Half the width of the brush, m. One that moves air is at least as wide as the tool's.
    #[serde(default)]
    radius: f64,
}

/// The tool in hand.
#[derive(Clone, Debug, Deserialize)]
enum With {
    /// Pours an element along the way.
    Pour(String),
    /// Draws a line of an element, from the first point to the last.
    Line(String),
    /// Fills a rectangle with an element, from the first corner to the last.
    Rectangle(String),
    /// Erases along the way.
    Erase,
    /// Blows along the way.
    Wind,
    /// Adds pressure along the way.
    Press,
    /// Sucks along the way.
    Suck,
    /// Warms along the way.
    Warm,
    /// Cools along the way.
    Cool,
    /// Sets fire along the way.
    Ignite,
}

/// The strokes that solve a challenge.
#[derive(Clone, Debug, Deserialize)]
#[serde(transparent)]
pub struct Solution(Vec<Move>);

/// The solution of the challenge of a name.
///
/// # Errors
/// If there is none, or it is not what the format asks for: one line.
pub fn solution(name: &str) -> Result<Solution, String> {
    let path = format!("{name}.ron");
    let file = FILES.get_file(&path).ok_or_else(|| format!("there is no solution of {name}"))?;
    Solution::read(file.contents()).map_err(|what| format!("assets/challenges/solutions/{path}: {what}"))
}

impl Solution {
    /// Reads it from the bytes of its file.
    fn read(bytes: &[u8]) -> Result<Self, String> {
        let solution: Self = ron::de::from_bytes(bytes).map_err(|error| error.to_string())?;
        let mut free = 0;
        for (k, stroke) in solution.0.iter().enumerate() {
            let numbers = [stroke.at, stroke.takes, stroke.radius];
            if stroke.along.is_empty() || !numbers.iter().all(|number| (0.0..=600.0).contains(number)) {
                return Err(format!("stroke {k}: allowed: a way of at least one point, times and radius 0 … 600"));
            }
            let (begins, ticks) = stroke.ticks();
            if begins < free {
                return Err(format!("stroke {k} begins before the one before it ends; allowed: one after the other"));
            }
            free = begins + ticks;
        }
        Ok(solution)
    }

    /// The intents of its strokes in a world, each at its tick.
    ///
    /// # Errors
    /// If an element is none of the world's.
    pub fn entries(&self, setup: &Setup) -> Result<Vec<Entry>, String> {
        let mut entries = Vec::new();
        for stroke in &self.0 {
            stroke.write(setup, &mut entries)?;
        }
        Ok(entries)
    }
}

impl Move {
    /// Its first tick, and how many there are.
    fn ticks(&self) -> (u64, u64) {
        let ticks = |seconds: f64| (seconds * f64::from(TICKS_PER_SECOND)).round() as u64;
        (ticks(self.at), ticks(self.takes).max(1))
    }

    fn write(&self, setup: &Setup, entries: &mut Vec<Entry>) -> Result<(), String> {
        let (begins, ticks) = self.ticks();
        let scale = setup.blueprint.scale;
        let length = |metres: f64| (metres / f64::from(scale.spacing)) as f32;
        let way: Vec<Vec2> = self.along.iter().map(|at| Vec2::new(length(at.x), length(at.y))).collect();
        let reference = Reference::of(&setup.blueprint.domain, &setup.blueprint.air);
        let least = if self.with.moves_air() { AIR_BRUSH * scale.detail } else { 0.0 };
        let radius = length(self.radius).max(least);
        let mut note = |tick: u64, intent: Intent| entries.push(Entry { tick, intent });
        note(begins, Intent::Stroke);
        if let Some(whole) = self.with.whole(&way, radius, setup.elements())? {
            note(begins + ticks - 1, whole);
            return Ok(());
        }
        for k in 0..ticks {
            let place = |k: u64| along(&way, k as f32 / ticks as f32);
            let (from, to) = (place(k), place(k + 1));
            let stroke = Stroke { shape: BrushShape::Disc, from, to, radius };
            let drag = (to - from) / TICK_SECONDS;
            if let Some(intent) = self.with.intent(stroke, drag, reference, setup.elements())? {
                note(begins + k, intent);
            }
        }
        Ok(())
    }
}

impl With {
    fn moves_air(&self) -> bool {
        matches!(self, Self::Wind | Self::Press | Self::Suck)
    }

    /// What is done at once, if it is that.
    fn whole(&self, way: &[Vec2], radius: f32, elements: &ElementTable) -> Result<Option<Intent>, String> {
        let (Some(&from), Some(&to)) = (way.first(), way.last()) else { return Ok(None) };
        let (name, stroke) = match self {
            Self::Line(name) => (name, Stroke { shape: BrushShape::Disc, from, to, radius }),
            Self::Rectangle(name) => (name, Stroke::rectangle(from, to)),
            _ => return Ok(None),
        };
        Ok(Some(Intent::Stamp { element: find(name, elements)?, stroke }))
    }

    /// What is done in a tick of a drag of a velocity, d/s.
    fn intent(
        &self,
        stroke: Stroke,
        drag: Vec2,
        reference: Reference,
        elements: &ElementTable,
    ) -> Result<Option<Intent>, String> {
        Ok(Some(match self {
            Self::Pour(name) => {
                let (element, velocity) = (find(name, elements)?, hand::throw(drag, reference));
                Intent::Pour { element, stroke, velocity, share: 1.0 }
            }
            Self::Wind => return Ok(hand::wind(drag, reference).map(|velocity| Intent::Blow { stroke, velocity })),
            Self::Press => Intent::Press { stroke, amount: PRESS_STEP },
            Self::Suck => Intent::Press { stroke, amount: -PRESS_STEP },
            Self::Warm => Intent::Warm { stroke, degrees: WARM_STEP },
            Self::Cool => Intent::Warm { stroke, degrees: -WARM_STEP },
            Self::Ignite => Intent::Ignite { stroke },
            Self::Erase => Intent::Erase { stroke },
            Self::Line(_) | Self::Rectangle(_) => return Ok(None),
        }))
    }
}

fn find(name: &str, elements: &ElementTable) -> Result<ElementId, String> {
    elements.find(name).ok_or_else(|| format!("no element `{name}`"))
}

/// The point at a share of the length of a way.
fn along(way: &[Vec2], share: f32) -> Vec2 {
    let lengths = way.windows(2).map(|pair| pair[0].distance(pair[1]));
    let mut rest = share * lengths.sum::<f32>();
    for pair in way.windows(2) {
        let length = pair[0].distance(pair[1]);
        if rest <= length && length > 0.0 {
            return pair[0].lerp(pair[1], rest / length);
        }
        rest -= length;
    }
    way[way.len() - 1]
}
