//! From what is heard of a world to controls.

use super::{
    audible::Audible,
    blast::{Blast, Pressures},
    fires,
    kinds::{Kind, kinds},
    listener::Listener,
    matter::{Matter, Moving},
    source::Source,
    wind::{self, Wind},
};
use crate::{kernel::units::TICK_SECONDS, sim::generation::Generation, sound::Controls};

/// Power, W a metre of depth, at which a sound has half of its highest level. A lump of water of 0.1 m that strikes at 10 m/s loses
/// 500 J; what falls down the `waterfall` some 50 kW.
mod half {
    pub(super) const SPLASH: f32 = 4.0e5;
    pub(super) const STREAM: f32 = 1.0e6;
    pub(super) const HISS: f32 = 2.0e5;
    pub(super) const CLATTER: f32 = 3.0e5;
    pub(super) const FIRE: f32 = 5.0e8;
    /// kg/s.
    pub(super) const BOIL: f32 = 400.0;
    /// Speed of the air, m/s.
    pub(super) const WIND: f32 = 16.0;
    /// Change of pressure, Pa.
    pub(super) const BLAST: f32 = 4000.0;
}

/// Changes of pressure below this are the air's own, Pa.
const CALM: f32 = 150.0;
/// Wind below this is not heard, m/s.
const BREEZE: f32 = 0.5;
/// Time over which what comes in single lumps is evened out, s.
const EVEN: f32 = 0.15;
/// Longest time that is heard at once, s: what lies further back is another moment.
const LONGEST: f32 = 0.25;

/// What has listened to a world before, and so hears what changes.
#[derive(Clone, Debug, Default)]
pub struct Ear {
    matter: Matter,
    pressures: Pressures,
    kinds: Vec<Kind>,
    /// The world that it listened to last, and when.
    last: Option<(Generation, u64)>,
    boil: Source,
    fire: Source,
    controls: Controls,
}

impl Ear {
    /// What a world sounds like to a listener. In a world that it has not heard before, nothing has changed yet; in one in which
    /// no time has passed, it sounds as before.
    pub fn listen(&mut self, audible: &Audible, listener: Listener) -> Controls {
        let ticks = match self.last {
            Some((generation, tick)) if generation == audible.generation && tick <= audible.tick => audible.tick - tick,
            _ => self.begin(audible),
        };
        if self.last.is_some() && ticks == 0 {
            return self.controls;
        }
        self.last = Some((audible.generation, audible.tick));
        let seconds = (ticks.max(1) as f32 * TICK_SECONDS).min(LONGEST);
        let moving = self.matter.listen(audible, &self.kinds, listener, seconds);
        let fire = moving.fire.plus(fires::listen(audible, &self.kinds, listener));
        let share = seconds / (seconds + EVEN);
        self.fire = self.fire.towards(fire, share);
        self.boil = self.boil.towards(moving.boil, share);
        let (wind, blast) = (wind::listen(audible, listener), self.pressures.listen(audible, listener));
        self.controls = self.controls(&moving, wind, blast);
        self.controls
    }

    /// Another world.
    fn begin(&mut self, audible: &Audible) -> u64 {
        self.matter.clear();
        self.pressures.clear();
        self.kinds = kinds(audible.elements);
        (self.last, self.boil, self.fire) = (None, Source::default(), Source::default());
        0
    }

    fn controls(&self, moving: &Moving, wind: Wind, blast: Blast) -> Controls {
        let (splash, stream, hiss) = (moving.splash, moving.stream, moving.hiss);
        let speed = (wind.square.sqrt() - BREEZE).max(0.0);
        let gust = (speed / half::WIND) * (speed / half::WIND);
        let shock = (blast.change - CALM).max(0.0) / half::BLAST;
        let fire_level = self.fire.level(half::FIRE, 0.25);
        let boil_level = self.boil.level(half::BOIL, 0.2);
        Controls {
            splash_rate: 30.0 + 220.0 * splash.share(half::SPLASH),
            splash_radius: 0.0016 + 0.007 * splash.share(half::SPLASH),
            splash_level: splash.level(half::SPLASH, 0.4),
            splash_pan: splash.pan(),
            stream_level: stream.level(half::STREAM, 0.25),
            stream_pitch: 260.0 + 130.0 * stream.speed(),
            stream_pan: stream.pan(),
            wind_level: 0.3 * gust / (1.0 + gust),
            wind_pitch: 110.0 + 22.0 * speed,
            wind_pan: wind.pan,
            hiss_level: hiss.level(half::HISS, 0.25),
            hiss_pitch: 2200.0 + 700.0 * hiss.speed(),
            hiss_pan: hiss.pan(),
            clatter_level: moving.clatter.level(half::CLATTER, 0.4),
            clatter_pan: moving.clatter.pan(),
            fire_crackle: 90.0 * self.fire.share(0.3 * half::FIRE),
            fire_level,
            fire_pan: self.fire.pan(),
            boil_rate: 200.0 * self.boil.share(half::BOIL),
            boil_level,
            boil_pan: self.boil.pan(),
            blast_level: shock / (1.0 + shock),
            blast_pan: blast.pan,
            gain: 1.0,
        }
        .within()
    }
}
