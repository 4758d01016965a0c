//! Movable particles as the picture of the elements draws them: liquids and powders as bodies in channels, grains upon them,
//! gases as clouds.
//!
//! Nothing depends on the order of the particles: channels add up in any order, and grains hardly overlap.

use crate::{
    game::render::{
        body::BodyMap,
        glow::Warmth,
        look::{Look, Looks},
        moved::Moved,
        rock::RockMap,
        tiles::Tiles,
    },
    kernel::{element::ElementId, particles::Particles, random},
    lab::colours::Rgb,
};
use bevy::math::ops;
use glam::Vec2;

/// Liquids that have a channel of their own.
pub const LIQUIDS: usize = 6;
/// Liquids in the first field, beside powders and foam; the others are in the second.
const FIRST: usize = 2;

/// Position (two f32), and four bytes: traits of a body, or a colour; the last is not used.
pub type Instance = [u32; 4];

/// Speed at which a lone drop is drawn out by its own length, d/s.
const STRETCH: f32 = 160.0;
/// What foam must pass to show on a particle goes from 0 to this, by its id.
const FOAM_SPREAD: f32 = 0.55;
/// Share of light of its own of what glows white.
const SELF_LIT: f32 = 0.9;

/// The channel that each element's body goes into.
#[derive(Clone, Debug, Default)]
struct Channels {
    of: Vec<u8>,
    colours: Vec<Rgb>,
    /// Whether any of it glows.
    glows: Vec<bool>,
    counts: Vec<usize>,
}

impl Channels {
    /// A channel for each liquid that is there; if there are more than channels, the rarest go with what looks most like them.
    fn fill(&mut self, elements: &[ElementId], looks: &Looks) {
        self.counts.clear();
        self.counts.resize(256, 0);
        for run in elements.chunk_by(|a, b| a == b) {
            self.counts[run[0].index()] += run.len();
        }
        let liquid = |k: usize| {
            let look = looks.of(ElementId(k as u8));
            !look.is_gas() && !look.is_powder()
        };
        let mut there: Vec<usize> = (0..256).filter(|k| self.counts[*k] > 0 && liquid(*k)).collect();
        there.sort_by_key(|k| std::cmp::Reverse(self.counts[*k]));
        let most = LIQUIDS.min(there.len());
        let (own, rest) = there.split_at_mut(most);
        // In the order of the table, so that channels stay while numbers change.
        own.sort_unstable();
        self.colours = own.iter().map(|k| looks.of(ElementId(*k as u8)).colour).collect();
        self.glows.clear();
        self.glows.resize(own.len(), false);
        self.of.clear();
        self.of.resize(256, 0);
        for (channel, k) in own.iter().enumerate() {
            self.of[*k] = channel as u8;
        }
        for k in rest.iter() {
            let colour = looks.of(ElementId(*k as u8)).colour;
            let nearest = (0..self.colours.len()).min_by_key(|c| apart(self.colours[*c], colour));
            self.of[*k] = nearest.unwrap_or(0) as u8;
        }
    }
}

/// How far two colours are apart, roughly: the square of their distance in sRGB.
fn apart(a: Rgb, b: Rgb) -> i32 {
    (0..3).map(|k| (i32::from(a[k]) - i32::from(b[k])).pow(2)).sum()
}

/// What of the matter is drawn.
#[derive(Default)]
pub struct Matter {
    /// Bodies in the first field.
    pub bodies: Vec<Instance>,
    /// Bodies in the second field.
    pub more: Vec<Instance>,
    /// Grains.
    pub grains: Vec<Instance>,
    /// Gases.
    pub gases: Vec<Instance>,
    /// Tiles that bodies reach into.
    pub body_tiles: Tiles,
    /// Tiles that gases reach into.
    pub gas_tiles: Tiles,
    channels: Channels,
}

/// The world whose matter is drawn.
#[derive(Clone, Copy)]
pub struct Sample<'a> {
    /// Movable particles.
    pub particles: &'a Particles,
    /// Rock, which nothing is drawn in.
    pub rock: &'a RockMap,
    /// Looks of the elements.
    pub looks: &'a Looks,
    /// How far they went.
    pub moved: &'a Moved,
    /// What is around them.
    pub body: &'a BodyMap,
    /// How warm they are.
    pub warmth: Warmth<'a>,
    /// Size of the box, d.
    pub size: Vec2,
    /// Radii of the discs of bodies and of gases, d.
    pub radii: [f32; 2],
    /// The moment that is drawn, s before the last tick.
    pub back: f32,
    /// Whether grains are large enough to be drawn one by one.
    pub fine: bool,
}

impl Matter {
    /// Takes everything out.
    pub fn clear(&mut self) {
        for buffer in [&mut self.bodies, &mut self.more, &mut self.grains, &mut self.gases] {
            buffer.clear();
        }
    }

    /// Colours of the liquids in their channels.
    pub fn colours(&self) -> &[Rgb] {
        &self.channels.colours
    }

    /// Colour of a channel's liquid, each part 0 … 1, and 1 if any of it glows; nothing if there is none.
    pub fn liquid(&self, channel: usize) -> [f32; 4] {
        let Channels { colours, glows, .. } = &self.channels;
        let (Some(colour), Some(glows)) = (colours.get(channel), glows.get(channel)) else { return [0.0; 4] };
        let [r, g, b] = colour.map(|part| f32::from(part) / 255.0);
        [r, g, b, f32::from(*glows)]
    }

    /// Marks what the discs of some instances reach that are drawn as bodies are.
    pub fn mark(&mut self, size: Vec2, bodies: &[Instance], radius: f32) {
        self.body_tiles.clear(size);
        self.gas_tiles.clear(size);
        for [x, y, ..] in bodies {
            self.body_tiles.mark(Vec2::new(f32::from_bits(*x), f32::from_bits(*y)), radius);
        }
    }

    /// Packs a world's matter.
    pub fn fill(&mut self, world: Sample<'_>) {
        self.clear();
        self.body_tiles.clear(world.size);
        self.gas_tiles.clear(world.size);
        self.channels.fill(&world.particles.element, world.looks);
        let (warm, share) = (world.warmth.is_there(), world.moved.share(world.back));
        for i in 0..world.particles.len() {
            let look = world.looks.of(world.particles.element[i]);
            let at = world.moved.at(world.particles, |at| world.rock.is_at(at), i, share);
            let glow = if warm { world.warmth.glow(i, look) } else { [0.0; 3] };
            if look.is_gas() {
                self.gas_tiles.mark(at, world.radii[1]);
                self.gases.push(instance(at, gas(look, glow)));
                continue;
            }
            self.body_tiles.mark(at, world.radii[0]);
            let traits = self.traits(world, look, i, at);
            if glow[0] > 0.0 && !look.is_powder() {
                self.channels.glows[usize::from(traits[0])] = true;
            }
            self.body(world, at, traits, look.is_powder());
            if look.is_powder() && world.fine {
                self.grains.push(instance(at, grain(look, glow, world.particles.id[i])));
            }
        }
    }

    /// Channel, foam, how far it is drawn out, and the angle along which.
    fn traits(&self, world: Sample<'_>, look: Look, i: usize, at: Vec2) -> [u8; 4] {
        let channel = if look.is_powder() { 0 } else { self.channels.of[world.particles.element[i].index()] };
        let [foam, long, angle] = if look.foams { froth(world, i, at) } else { [0; 3] };
        [channel, foam, long, angle]
    }

    /// A body, and its image behind each wall that it touches: a liquid at a wall ends there, not in drops before it.
    fn body(&mut self, world: Sample<'_>, at: Vec2, traits: [u8; 4], powder: bool) {
        let channel = usize::from(traits[0]);
        let (buffer, channel) = match channel {
            _ if powder => (&mut self.bodies, 0),
            k if k < FIRST => (&mut self.bodies, 1 + k),
            k => (&mut self.more, k - FIRST),
        };
        let traits = u32::from_le_bytes([channel as u8, traits[1], traits[2], traits[3]]);
        buffer.push(instance(at, traits));
        let [x, y] = [0, 1].map(|axis| image(at[axis], world.size[axis], world.radii[0]));
        if x.is_none() && y.is_none() {
            return;
        }
        let images = [x.map(|x| Vec2::new(x, at.y)), y.map(|y| Vec2::new(at.x, y)), x.zip(y).map(Vec2::from)];
        images.into_iter().flatten().for_each(|image| {
            buffer.push(instance(image, traits));
        });
    }
}

/// Foam on a liquid, how far it is drawn out, and the angle along which.
fn froth(world: Sample<'_>, i: usize, at: Vec2) -> [u8; 3] {
    if world.body.is_plain(at) {
        return [0; 3];
    }
    let threshold = FOAM_SPREAD * random::share(random::mix(world.particles.id[i]));
    let foam = ((world.body.foam_at(at) - threshold) * 2.2).clamp(0.0, 1.0);
    let (mut long, mut angle) = (0.0, 0.0);
    if world.body.is_sparse(at) {
        let velocity = world.particles.velocity(i);
        long = (velocity.length() / STRETCH).min(1.0);
        angle = (ops::atan2(velocity.y, velocity.x) / std::f32::consts::PI).rem_euclid(1.0);
    }
    [foam, long, angle].map(|share| (255.0 * share) as u8)
}

/// Where the image of a place behind the nearer wall is, along one axis, if it is within `reach` of one.
fn image(at: f32, size: f32, reach: f32) -> Option<f32> {
    if at < reach {
        Some(-at)
    } else if size - at < reach {
        Some(2.0 * size - at)
    } else {
        None
    }
}

fn instance(at: Vec2, bytes: u32) -> Instance {
    [at.x.to_bits(), at.y.to_bits(), bytes, 0]
}

/// Colour of a grain and its share of own light: a shade of its own that its id gives it, and what it glows.
fn grain(look: Look, glow: [f32; 3], id: u32) -> u32 {
    let shade = 0.90 + 0.20 * random::share(random::mix(id));
    let own = glow[0].max(glow[1]).max(glow[2]);
    let rgb: [u8; 3] = std::array::from_fn(|k| {
        let cold = f32::from(look.colour[k]) * shade;
        (cold * (1.0 - 0.7 * own) + 255.0 * glow[k] * (0.8 + 0.2 * shade)).min(255.0) as u8
    });
    u32::from_le_bytes([rgb[0], rgb[1], rgb[2], (255.0 * SELF_LIT * own) as u8])
}

/// Colour of a lump of gas and how much it hides: cold gas hides what is behind it, flames add their light.
fn gas(look: Look, glow: [f32; 3]) -> u32 {
    let own = glow[0].max(glow[1]).max(glow[2]);
    let rgb: [u8; 3] =
        std::array::from_fn(|k| (f32::from(look.colour[k]) * (1.0 - own) + 255.0 * glow[k]).min(255.0) as u8);
    u32::from_le_bytes([rgb[0], rgb[1], rgb[2], (255.0 * (1.0 - 0.85 * own)) as u8])
}
