//! The rules that every world is judged by, and their bounds: the same at every quality, each with its derivation.

use crate::{lab::cases::figure_or_nan, sim::numbers::figure};
use serde::{Deserialize, Serialize};

macro_rules! rules {
    ($($(#[$doc:meta])* $Variant:ident: $name:literal, $value:literal, $bound:literal, $why:literal;)+) => {
        /// A rule.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Rule { $($(#[$doc])* $Variant,)+ }

        impl Rule {
            /// All, in the order in which they are shown.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$Variant),+];

            /// Its name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$Variant => $name,)+ }
            }

            /// What is measured, with its unit.
            pub fn value(self) -> &'static str {
                match self { $(Self::$Variant => $value,)+ }
            }

            /// What is allowed, in words.
            pub fn bound(self) -> &'static str {
                match self { $(Self::$Variant => $bound,)+ }
            }

            /// Where that follows from.
            pub fn why(self) -> &'static str {
                match self { $(Self::$Variant => $why,)+ }
            }
        }
    };
}

rules! {
    /// A scene is read, or refused in one line that says what is allowed; and no part of the program panics.
    Reads: "reads", "faults", "0", "What a player can write must not break the program.";
    /// Every position, speed, wind and pressure is a number, and no pressure below 0.
    Finite: "finite", "faults", "0", "One number that is none spreads to every neighbour.";
    /// Nobody is outside the box or in rock.
    Inside: "inside", "particles astray", "0", "Rock and walls are swept exactly.";
    /// Nobody goes missing or comes from nowhere; ids are unique; census and limits are right.
    Lost: "lost", "faults", "0", "Matter is counted, not weighed.";
    /// Air that is shut in keeps its mass but for rounding.
    Air: "air", "share of the mass", "2⁻²⁰ (10⁻⁶), for each time that hands changed it",
        "Each room keeps its mass to 16 roundings of an f32, however many steps it takes, from each time on that hands changed it.";
    /// Nobody is faster than the limiters leave.
    Speed: "speed", "d/s", "longest move, correction, half of gravity",
        "A substep moves nothing further than its longest move, corrects it by no more than the limit, and ends with half a kick.";
    /// Matter has no energy that nobody put in.
    Energy: "energy", "m/s for all matter", "√((5 d/s)² + 2 s E + (½ g Δt)²)",
        "5 d/s is what overlaps may part with: half a metre a second at 0.1 m, which rises by less than a particle's width. \
         Of the energy E of its height, for each kg, water holds a share s by standing too high: 1 %, as much as its mean \
         density may be off; in random worlds, whose hands press it to the bound of its density, 14 % of all that can become \
         motion. What comes to a stop within a substep does so half of gravity's kick early or late. What is taken away takes \
         along what it has, and the gain stays in the book: held against it is the most that was allowed so far.";
    /// Liquid is not pressed together once the shock is over.
    Density: "density", "share too dense, 99th percentile", "0.14; still water 0.02",
        "0.14 is a particle's own share of the density where it stands: below, less than one particle too many stands around 99 \
         of a hundred. Still water may be as much too dense as its surface may stand off.";
    /// What has no reason to move rests, with sleep off.
    Rest: "rest", "d a tick, rms", "0.02",
        "With 17 pixels a particle, as in the game's window, one pixel in three frames. Fewer particles than fill a cell of \
         the predictor's grid, 7, are drops: they have no pressure, nothing keeps them on a slope, and in random worlds they \
         are not judged.";
    /// No tick takes much more than a calm one.
    Cost: "cost", "calm ticks", "10",
        "A game whose calm tick takes a tenth of its time, to have room for what players do, is never late.";
}

impl Rule {
    /// Whether plain PBF, without the pressure predictor, is known not to hold it: `classic`, and whatever switches the effect
    /// off. There every correction becomes motion, and pressure reaches a few particles down an iteration, which is the method,
    /// and what a substep may correct is the only bound. What is finite, where matter is, what there is of it, its speed and the
    /// air are held by any method.
    pub fn is_beyond_plain(self) -> bool {
        matches!(self, Self::Energy | Self::Density | Self::Rest | Self::Cost)
    }
}

/// Unit roundoffs of f32 (2⁻²⁴) by which the mass of a room may differ from what it was, however many steps it takes
/// (`kernel::air`, "balance").
pub(in crate::lab::gauntlet) const AIR_ROUNDINGS: f64 = 16.0;

/// Speed at which particles that stand inside each other may part, d/s: 0.5 m/s at 0.1 m. A corrected overlap is no
/// explosion to a player as long as what flies apart rises by less than its own width under gravity: `½ v²/g` is 1.3 cm.
pub(in crate::lab::gauntlet) const OVERLAP_SPEED: f64 = 5.0;

/// How far liquid may be too dense: a particle's own share of the density where it stands, 729 of the 5,165 that the
/// lattice sums up to ([`crate::lab::density`]). Below that, less than one particle too many stands around 99 of a hundred.
pub(in crate::lab::gauntlet) const ONE_TOO_MANY: f64 = 729.0 / 5165.0;

/// How far still water may be too dense: as far as its surface may stand off, two in a hundred.
pub(in crate::lab::gauntlet) const STILL_DENSITY: f64 = 0.02;

/// Share of the energy that can become motion which water holds that stands too high: its density may be off by one in a
/// hundred on the mean, as the presets promise, and its height with it.
pub(in crate::lab::gauntlet) const SWOLLEN: f64 = 0.01;

/// Speed of still water, the scene's own spacings a tick: with 17 pixels a particle, as in the game's window, one pixel in
/// three frames.
pub(in crate::lab::gauntlet) const STILL: f64 = 0.02;

/// The most expensive tick as a multiple of a calm one: a game whose calm tick takes a tenth of its time, to have room for what
/// players do, is never late. Fast matter takes three times the substeps, heaped as many as make it 8.
pub(in crate::lab::gauntlet) const MOST_WORK: f64 = 10.0;

/// What was measured of a rule, and the most that it may be, at the tick at which it came nearest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// What was measured, in the unit of the rule.
    #[serde(deserialize_with = "figure_or_nan")]
    pub value: f64,
    /// What is allowed.
    #[serde(deserialize_with = "figure_or_nan")]
    pub bound: f64,
    /// After how many ticks.
    pub tick: u64,
    /// What it was, in words, where a number does not say it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub what: String,
}

impl Measured {
    /// What it is of what is allowed; beyond 1 the rule is broken. What is no number is beyond every bound.
    pub fn share(&self) -> f64 {
        match self.value / self.bound {
            _ if self.value == 0.0 => 0.0,
            share if share.is_nan() => f64::INFINITY,
            share => share,
        }
    }

    /// Whether the rule is broken.
    pub fn is_broken(&self) -> bool {
        self.share() > 1.0
    }

    /// A fault, where none is allowed.
    pub(in crate::lab::gauntlet) fn fault(tick: u64, what: impl Into<String>) -> Self {
        Self { value: 1.0, bound: 0.0, tick, what: what.into() }
    }
}

/// What came of a rule in a world.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The rule.
    pub rule: Rule,
    /// What was measured, or why the rule does not apply.
    pub measured: Result<Measured, &'static str>,
}

impl Finding {
    /// What is broken, in a line.
    pub fn fault(&self) -> Option<String> {
        let Measured { value, bound, tick, what } =
            self.measured.as_ref().ok().filter(|measured| measured.is_broken())?;
        let (rule, unit) = (self.rule.name(), self.rule.value());
        Some(match what.as_str() {
            "" => format!("{rule}: {} {unit} at tick {tick}; allowed: {}", figure(*value), figure(*bound)),
            what => format!("{rule}: {what}, at tick {tick}"),
        })
    }
}
