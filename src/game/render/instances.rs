//! What a picture draws many times, each time with other numbers: one triangle or two for each, all in one call.
//!
//! The vertex shader looks the numbers up in a texture. Instances as graphics know them would say the same, but rasterisers in
//! software begin each as if it were a call of its own: with eight thousand discs, that was most of a frame.

use crate::game::render::texture::Map;
use bevy::render::{
    render_resource::{BindGroup, BindGroupEntries, BindGroupLayout, BindingResource, TextureFormat},
    renderer::{RenderDevice, RenderQueue},
};
use bytemuck::NoUninit;
use glam::UVec2;

/// Texels in a row of the texture: no more than the least that WebGL2 allows.
pub const ROW: u32 = 2048;
/// Discs: a triangle around each, as most of what it takes to draw a small one is spent on triangles, not on pixels.
pub type Discs = Instances<3>;
/// Quads: two triangles each.
pub type Quads = Instances<6>;

/// Instances of one kind, each of so many vertices.
#[derive(Default)]
pub struct Instances<const VERTICES: u32> {
    texels: Map,
    group: Option<BindGroup>,
    count: u32,
}

impl<const VERTICES: u32> Instances<VERTICES> {
    /// Group 0 for those who draw them, once it is there.
    pub fn group(&self) -> Option<&BindGroup> {
        self.group.as_ref()
    }

    /// How many there are.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// How many vertices they have.
    pub fn vertices(&self) -> u32 {
        VERTICES * self.count
    }

    /// Hands them over, each of one number or of four for each of its texels. What is more than a texture can hold is left out.
    pub fn fill<T: NoUninit>(&mut self, instances: &[T], device: &RenderDevice, queue: &RenderQueue) {
        const { assert!(size_of::<T>() == 4 || size_of::<T>().is_multiple_of(16), "texels have one number or four") };
        let (bytes, format) =
            if size_of::<T>() == 4 { (4, TextureFormat::R32Uint) } else { (16, TextureFormat::Rgba32Uint) };
        let row = bytes * ROW as usize;
        let most = row * device.limits().max_texture_dimension_2d as usize / size_of::<T>();
        let instances = &instances[..instances.len().min(most)];
        self.count = instances.len() as u32;
        let texels: &[u8] = bytemuck::cast_slice(instances);
        // It grows in powers of two, so that pouring doesn't make a new one each frame.
        let room = ((texels.len() / bytes) as u32).next_power_of_two();
        let size = UVec2::new(room.min(ROW), room.div_ceil(ROW)).max(self.texels.size());
        if self.texels.make(size, format, device) {
            self.group = None;
        }
        let (rows, rest) = texels.split_at(texels.len() / row * row);
        let whole = (rows.len() / row) as u32;
        self.texels.write(rows, 0..whole, ROW, queue);
        self.texels.write(rest, whole..whole + 1, (rest.len() / bytes) as u32, queue);
    }

    /// Makes the bind group if there is none.
    fn bind(&mut self, layout: &BindGroupLayout, uniform: BindingResource<'_>, device: &RenderDevice) {
        if let (None, Some(texels)) = (&self.group, self.texels.view()) {
            let entries = BindGroupEntries::sequential((uniform, texels));
            self.group = Some(device.create_bind_group("world", layout, &entries));
        }
    }
}

/// All that a picture draws many times.
#[derive(Default)]
pub struct PictureInstances {
    /// Particles, in the views that colour them one by one.
    pub particles: Discs,
    /// Bodies in the first field.
    pub bodies: Discs,
    /// Bodies in the second field.
    pub more: Discs,
    /// Grains.
    pub grains: Discs,
    /// Gases.
    pub gases: Discs,
    /// Streaks of wind.
    pub streaks: Quads,
    /// Tiles with bodies.
    pub body_tiles: Quads,
    /// Tiles with gases.
    pub gas_tiles: Quads,
    /// Tiles with rock.
    pub rock_tiles: Quads,
    /// Tiles with rock that looks otherwise than in the frame before.
    pub changed_tiles: Quads,
}

impl PictureInstances {
    /// Makes the bind groups that there are not.
    pub fn bind(&mut self, layout: &BindGroupLayout, uniform: &BindingResource<'_>, device: &RenderDevice) {
        let Self { particles, bodies, more, grains, gases, streaks, body_tiles, gas_tiles, rock_tiles, changed_tiles } =
            self;
        let discs = [particles, bodies, more, grains, gases];
        discs.into_iter().for_each(|discs| discs.bind(layout, uniform.clone(), device));
        let quads = [streaks, body_tiles, gas_tiles, rock_tiles, changed_tiles];
        quads.into_iter().for_each(|quads| quads.bind(layout, uniform.clone(), device));
    }
}
