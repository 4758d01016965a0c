//! The numbers of a frame that all shaders share.

use crate::{game::render::matter::LIQUIDS, lab::colours::Rgb};
use bevy::render::render_resource::ShaderType;
use glam::{Vec2, Vec4};

/// What the shaders know of the world as a whole; `assets/shaders/common.wgsl` explains the fields.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub struct WorldUniform {
    pub(super) to_clip: Vec4,
    pub(super) size: Vec4,
    pub(super) extent: Vec4,
    pub(super) fine_extent: Vec4,
    pub(super) look: Vec4,
    pub(super) pen: Vec4,
    pub(super) parts: Vec4,
    pub(super) lens: Vec4,
    pub(super) surroundings: Vec4,
    pub(super) box_top: Vec4,
    pub(super) box_bottom: Vec4,
    pub(super) frame: Vec4,
    pub(super) abyss: Vec4,
    pub(super) liquids: [Vec4; LIQUIDS],
}

/// Two points in one.
pub(super) fn two(a: Vec2, b: Vec2) -> Vec4 {
    Vec4::new(a.x, a.y, b.x, b.y)
}

/// A colour, each part 0 … 1.
pub(super) fn srgb(rgb: Rgb) -> Vec4 {
    let [r, g, b] = rgb.map(|channel| f32::from(channel) / 255.0);
    Vec4::new(r, g, b, 1.0)
}
