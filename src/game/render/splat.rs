//! Bodies that the game adds up itself, where the graphics are a rasteriser in software and would take the same processor
//! (docs/picture.md). What comes of it is what `body_fragment` and `more_fragment`
//! (assets/shaders/matter.wgsl) draw, but rounded to 16 bits disc by disc, not to 8.

use crate::game::render::matter::Instance;
use bevy::{
    math::ops,
    prelude::{Commands, Res, Resource},
    render::renderer::RenderAdapterInfo,
};
use glam::{UVec2, Vec2, Vec4, Vec4Swizzles};
use std::f32::consts::PI;

/// Weight in the middle of a disc, as `disc` in assets/shaders/coloured.wgsl has it.
const MIDDLE: f32 = 0.8;
/// What hides nothing, Π(1 − w) of no disc.
const CLEAR: u16 = u16::MAX;

/// Who draws bodies.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodiesBy {
    /// The graphics.
    Graphics,
    /// The processor.
    Processor,
}

/// Leaves bodies to the processor where it is the graphics, too.
pub fn choose(mut commands: Commands, adapter: Res<RenderAdapterInfo>) {
    // Bevy has no name for the type of this.
    let in_software = format!("{:?}", adapter.device_type) == "Cpu";
    commands.insert_resource(if in_software { BodiesBy::Processor } else { BodiesBy::Graphics });
}

/// Where the texels of a field are in the world.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Size of the field, texels.
    pub size: UVec2,
    /// World to clip space, as the shaders have it: scale, offset.
    pub to_clip: Vec4,
    /// Radius of a disc, d.
    pub radius: f32,
}

/// A field of four channels, each 1 − Π(1 − w) over its discs, whatever their order.
#[derive(Clone, Debug, Default)]
pub struct Field {
    /// Π(1 − w) of each channel, rows from the top.
    clear: Vec<[u16; 4]>,
    texels: Vec<u8>,
}

impl Field {
    /// Draws bodies into the empty field, each into its channel; with `foams` their foam into the last one.
    pub fn draw(&mut self, frame: Frame, bodies: &[Instance], foams: bool) {
        self.clear.clear();
        self.clear.resize((frame.size.x * frame.size.y) as usize, [CLEAR; 4]);
        for [x, y, traits] in bodies {
            let at = Vec2::new(f32::from_bits(*x), f32::from_bits(*y));
            self.add(frame, at, traits.to_le_bytes(), foams);
        }
        self.texels.clear();
        let byte = |clear: &u16| 255 - ((255 * u32::from(*clear) + 0x8000) >> 16) as u8;
        self.texels.extend(self.clear.as_flattened().iter().map(byte));
    }

    /// The texels, rows from the top.
    pub fn texels(&self) -> &[u8] {
        &self.texels
    }

    /// Adds a disc: its channel, its foam, how far it is drawn out, and the angle along which, as `body_vertex` has them.
    fn add(&mut self, frame: Frame, at: Vec2, [channel, foam, long, angle]: [u8; 4], foams: bool) {
        let size = frame.size.as_vec2();
        // To texels, whose middles are at whole numbers, in rows downwards.
        let half_turned = Vec2::new(0.5, -0.5) * size;
        let scale = frame.to_clip.xy() * half_turned;
        let middle = at * scale + frame.to_clip.zw() * half_turned + 0.5 * size - 0.5;
        let stretch = 1.0 + 2.0 * f32::from(long) / 255.0;
        let (sin, cos) = if long == 0 { (0.0, 1.0) } else { ops::sin_cos(f32::from(angle) / 255.0 * PI) };
        // As large as it was: what it is longer it is slimmer.
        let half = Vec2::new(stretch, stretch.sqrt().recip()) * frame.radius;
        let reach =
            Vec2::new((half * Vec2::new(cos, sin)).length(), (half * Vec2::new(sin, cos)).length()) * scale.abs();
        let (low, high) = ((middle - reach).ceil().max(Vec2::ZERO), (middle + reach).floor().min(size - 1.0));
        if low.cmpgt(high).any() {
            return;
        }
        // How far a step to the right and one down are in the disc, whose edge is at 1.
        let right = Vec2::new(cos, -sin) / (half * scale.x);
        let down = Vec2::new(sin, cos) / (half * scale.y);
        let corner = right * (low.x - middle.x) + down * (low.y - middle.y);
        let (low, high) = (low.as_uvec2(), high.as_uvec2());
        let channel = usize::from(channel & 3);
        let foam = if foams { f32::from(foam) / 255.0 } else { 0.0 };
        let columns = low.x as usize..=high.x as usize;
        for (down_by, row) in (low.y..=high.y).enumerate() {
            let begin = corner + down * down_by as f32;
            let row = &mut self.clear[(row * frame.size.x) as usize..][columns.clone()];
            for (right_by, texel) in row.iter_mut().enumerate() {
                let fall = 1.0 - (begin + right * right_by as f32).length_squared();
                if fall > 0.0 {
                    let weight = MIDDLE * fall * fall;
                    hide(&mut texel[channel], weight);
                    if foam > 0.0 {
                        hide(&mut texel[3], weight * foam);
                    }
                }
            }
        }
    }
}

/// Leaves a share of 1 − `weight` of what is seen.
#[inline]
fn hide(clear: &mut u16, weight: f32) {
    let left = 0x1_0000 - (65_536.0 * weight) as u32;
    *clear = ((u32::from(*clear) * left) >> 16) as u16;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four texels to a d, the origin in the middle of a field of 64 × 64.
    const FRAME: Frame = Frame { size: UVec2::splat(64), to_clip: Vec4::new(0.125, 0.125, 0.0, 0.0), radius: 1.35 };

    fn body(at: Vec2, traits: [u8; 4]) -> Instance {
        [at.x.to_bits(), at.y.to_bits(), u32::from_le_bytes(traits)]
    }

    fn drawn(bodies: &[Instance], foams: bool) -> Vec<[u8; 4]> {
        let mut field = Field::default();
        field.draw(FRAME, bodies, foams);
        field.texels().as_chunks().0.to_vec()
    }

    /// What the shaders say of a point, of discs that stand in its channels.
    fn by_the_formula(point: Vec2, bodies: &[(Vec2, [u8; 4])], foams: bool) -> [f32; 4] {
        let mut clear = [1.0; 4];
        for (at, [channel, foam, long, angle]) in bodies {
            let long = 1.0 + 2.0 * f32::from(*long) / 255.0;
            let (sin, cos) = ops::sin_cos(f32::from(*angle) / 255.0 * PI);
            let along = Vec2::new(cos, sin);
            let off = (point - at) / FRAME.radius;
            let place = Vec2::new(off.dot(along) / long, off.dot(along.perp()) * long.sqrt());
            let fall = (1.0 - place.length_squared()).max(0.0);
            let weight = 0.8 * fall * fall;
            clear[usize::from(*channel)] *= 1.0 - weight;
            clear[3] *= if foams { 1.0 - weight * f32::from(*foam) / 255.0 } else { 1.0 };
        }
        clear.map(|clear| 255.0 * (1.0 - clear))
    }

    #[test]
    fn texels_are_what_the_shaders_formula_says() {
        // One alone, a crowd in two channels with foam, drops drawn out up, down and aslant, some over an edge.
        let bodies = [
            (Vec2::new(-5.0, 5.0), [0, 0, 0, 0]),
            (Vec2::new(0.1, 0.2), [1, 255, 0, 0]),
            (Vec2::new(0.9, 0.3), [1, 100, 0, 0]),
            (Vec2::new(0.5, -0.6), [2, 30, 0, 0]),
            (Vec2::new(4.0, 4.0), [1, 0, 255, 128]),
            (Vec2::new(4.0, -3.0), [1, 0, 120, 30]),
            (Vec2::new(-7.9, -7.5), [2, 200, 200, 220]),
            (Vec2::new(9.0, 0.0), [0, 0, 255, 0]),
        ];
        let instances = bodies.map(|(at, traits)| body(at, traits));
        for foams in [false, true] {
            let texels = drawn(&instances, foams);
            for (k, texel) in texels.iter().enumerate() {
                let point = (Vec2::new((k % 64) as f32, (63 - k / 64) as f32) + 0.5) / 4.0 - 8.0;
                let expected = by_the_formula(point, &bodies, foams);
                for channel in 0..4 {
                    // Half a step of eight bits, and what 16 bits make of eight discs.
                    let off = (f32::from(texel[channel]) - expected[channel]).abs();
                    assert!(off <= 0.55, "{point}, channel {channel}: {} for {}", texel[channel], expected[channel]);
                }
            }
        }
    }

    #[test]
    fn the_order_of_the_discs_is_of_no_account() {
        let at = |k: u32| Vec2::new((k % 7) as f32 * 0.3, (k / 7) as f32 * 0.4);
        let mut bodies: Vec<Instance> = (0..49).map(|k| body(at(k), [1, k as u8, 0, 0])).collect();
        let before = drawn(&bodies, true);
        bodies.reverse();
        let apart =
            before.as_flattened().iter().zip(drawn(&bodies, true).as_flattened()).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(apart <= Some(1), "{apart:?} of 255");
    }

    #[test]
    fn what_is_out_of_sight_or_nowhere_leaves_nothing() {
        let nowhere = [f32::NAN, f32::INFINITY, -1e30, 11.0].map(|x| body(Vec2::new(x, 0.0), [0, 255, 90, 90]));
        assert!(drawn(&nowhere, true).as_flattened().iter().all(|byte| *byte == 0));
        let mut field = Field::default();
        field.draw(Frame { size: UVec2::ONE, ..FRAME }, &nowhere, true);
        assert_eq!(field.texels(), [0; 4]);
    }
}
