//! What moves: what its kinetic energy loses where it strikes, and what rubs and rushes.

use super::{
    audible::Audible,
    crowd::Crowd,
    kinds::{Kind, Voice},
    listener::Listener,
    memory::Memory,
    source::Source,
};
use glam::Vec2;

/// Change of velocity, beside gravity's, from which a lump strikes, m/s: less is the push and pull of its neighbours.
const STRIKE: f32 = 0.6;

/// Speed below which a lump that touches others makes no sound, m/s.
const CREEP: f32 = 0.3;

/// Change of velocity beside gravity's, as a share of it, up to which a lump falls freely.
const FREE: f32 = 0.5;

/// What presses grains together, N/kg: their weight.
const WEIGHT: f32 = 9.81;

/// What is heard of what moves; powers in W for each metre of depth.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moving {
    /// Energy that liquids lose where they strike.
    pub(super) splash: Source,
    /// The same of grains.
    pub(super) clatter: Source,
    /// Energy of liquid that runs, in a second.
    pub(super) stream: Source,
    /// Power of friction of grains that slide.
    pub(super) hiss: Source,
    /// Matter that boils away, kg/s.
    pub(super) boil: Source,
    /// Power of what burns.
    pub(super) fire: Source,
}

/// What is kept from one time to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Matter {
    memory: Memory,
    crowd: Crowd,
}

/// A lump, and how it moved over the time that was listened to.
struct Lump {
    kind: Kind,
    /// Where it is, m.
    at: Vec2,
    /// Mass, kg.
    mass: f32,
    /// Velocity, m/s.
    velocity: Vec2,
    /// What it would be if nothing but gravity had acted, m/s.
    free: Vec2,
    /// Whether it touches something that it may rub against: others are near, and it does not fall freely.
    touches: bool,
}

impl Matter {
    /// Forgets how all moved.
    pub(super) fn clear(&mut self) {
        self.memory.clear();
    }

    /// Listens to what moved within `seconds`.
    pub(super) fn listen(&mut self, audible: &Audible, kinds: &[Kind], listener: Listener, seconds: f32) -> Moving {
        let (particles, spacing) = (audible.particles, audible.scale.spacing);
        let mut moving = Moving::default();
        self.memory.fit(particles.len().max(1));
        self.crowd.count(particles, audible.air.size());
        let fall = audible.gravity * (spacing * seconds);
        let (touch, area) = (FREE * fall.length(), spacing * spacing);
        for i in 0..particles.len() {
            let (element, position) = (particles.element[i], particles.position(i));
            let kind = kinds[element.index()];
            let before = self.memory.replace(particles.id[i], element, particles.velocity(i));
            let at = position * spacing;
            if kind.burning > 0.0 {
                moving.fire.add(kind.burning * area, listener.hears(at));
            }
            let Some(before) = before else { continue };
            if kind.voice == Voice::Mute {
                let was = kinds[before.element.index()];
                if before.element != element && was.steam == Some(element) {
                    moving.boil.add(was.density * area / seconds, listener.hears(at));
                }
                continue;
            }
            let (velocity, free) = (particles.velocity(i) * spacing, before.velocity * spacing + fall);
            let touches = (velocity - free).length_squared() >= touch * touch && self.crowd.has_company(position);
            moving.hear(&Lump { kind, at, mass: kind.density * area, velocity, free, touches }, listener, seconds);
        }
        moving
    }
}

impl Moving {
    /// What a lump sounds like that moves.
    #[inline(always)]
    fn hear(&mut self, lump: &Lump, listener: Listener, seconds: f32) {
        let Lump { kind, at, mass, velocity, free, touches } = *lump;
        let speed_squared = velocity.length_squared();
        let lost = 0.5 * mass * (free.length_squared() - speed_squared);
        let thin = 1.0 - kind.thickness;
        let strikes = lost > 0.0 && (velocity - free).length_squared() > STRIKE * STRIKE;
        let rubs = touches && speed_squared > CREEP * CREEP;
        if !strikes && !rubs {
            return;
        }
        let arrival = listener.hears(at);
        if strikes {
            let source = if kind.voice == Voice::Liquid { &mut self.splash } else { &mut self.clatter };
            source.add(thin * lost / seconds, arrival);
        }
        if !rubs {
            return;
        }
        let speed = speed_squared.sqrt();
        match kind.voice {
            Voice::Liquid => {
                let power = thin * mass * (speed_squared - CREEP * CREEP);
                self.stream.add_moving(power, speed, arrival);
            }
            Voice::Grain => {
                let power = kind.friction * mass * WEIGHT * (speed - CREEP);
                self.hiss.add_moving(power, speed, arrival);
            }
            Voice::Mute => {}
        }
    }
}
