//! The picture on the graphics' side: buffers and textures, filled once a frame.

use crate::game::render::{
    cost::RenderCost,
    extract::Pictures,
    picture::{Picture, WorldUniform},
    pipelines::{FIELD_FORMAT, Layouts},
};
use bevy::{
    platform::time::Instant,
    prelude::{Res, ResMut, Resource},
    render::{
        render_resource::{
            BindGroup, BindGroupEntries, Extent3d, PipelineCache, TexelCopyBufferLayout, Texture, TextureDescriptor,
            TextureDimension, TextureFormat, TextureUsages, TextureView, UniformBuffer,
        },
        renderer::{RenderDevice, RenderQueue},
        texture::{CachedTexture, TextureCache},
    },
};
use glam::UVec2;
use std::sync::atomic::Ordering;

/// Texels of the field to one d: enough for a smooth surface; more would only cost.
const FIELD_TEXELS_PER_D: f32 = 6.0;

/// The pictures of a frame, in the order of [`Pictures::shown`].
#[derive(Resource, Default)]
pub struct GpuPictures([GpuPicture; 3]);

impl GpuPictures {
    /// The pictures.
    pub fn panes(&self) -> &[GpuPicture] {
        &self.0
    }
}

/// Uniform, textures and bind groups of a picture.
#[derive(Default)]
pub struct GpuPicture {
    uniform: UniformBuffer<WorldUniform>,
    /// Air, depth and field of the liquid, of this frame.
    textures: Option<[CachedTexture; 3]>,
    /// Group 0 (the uniform) and group 1 (sampler, air, depth, field).
    groups: Option<[BindGroup; 2]>,
}

impl GpuPicture {
    /// The field of the liquid, and the groups 0 and 1; all that drawing needs, once it is there.
    pub fn parts(&self) -> Option<(&TextureView, &[BindGroup; 2])> {
        let [_, _, field] = self.textures.as_ref()?;
        Some((&field.default_view, self.groups.as_ref()?))
    }
}

/// Writes a buffer; grows it in powers of two, so that pouring doesn't make a new one each frame.
macro_rules! write_growing {
    ($buffer:expr, $device:expr, $queue:expr) => {{
        let length = $buffer.len().next_power_of_two();
        $buffer.reserve(length, $device);
        $buffer.write_buffer($device, $queue);
    }};
}

/// Hands the frame's pictures over.
pub fn upload(
    mut pictures: ResMut<Pictures>,
    mut gpu: ResMut<GpuPictures>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    mut textures: ResMut<TextureCache>,
    cost: Res<RenderCost>,
) {
    let begin = Instant::now();
    for (picture, gpu) in pictures.shown_mut().iter_mut().zip(&mut gpu.0) {
        hand_over(picture, gpu, &mut textures, &device, &queue);
    }
    cost.upload.store(begin.elapsed().as_micros() as u32, Ordering::Relaxed);
}

fn hand_over(
    picture: &mut Picture,
    gpu: &mut GpuPicture,
    textures: &mut TextureCache,
    device: &RenderDevice,
    queue: &RenderQueue,
) {
    write_growing!(picture.particles, device, queue);
    write_growing!(picture.streaks, device, queue);
    if picture.rock_new {
        write_growing!(picture.rock, device, queue);
    }
    gpu.uniform.set(picture.uniform);
    gpu.uniform.write_buffer(device, queue);

    let mut texture = |label, size: UVec2, format, usage: TextureUsages| {
        let size = size.max(UVec2::ONE);
        let descriptor = TextureDescriptor {
            label: Some(label),
            size: Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format,
            usage: usage | TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        };
        textures.get(device, descriptor)
    };
    let (texels, size) = (&picture.air.0, if picture.air.0.is_empty() { UVec2::ONE } else { picture.air.1 });
    let air = texture("air", size, TextureFormat::Rgba8Unorm, TextureUsages::COPY_DST);
    write_texels(&air.texture, texels, queue);
    let (columns, rows) = picture.depth.dimensions();
    let size = UVec2::new(columns as u32, rows as u32);
    let depth = texture("depth", size, TextureFormat::R8Unorm, TextureUsages::COPY_DST);
    write_texels(&depth.texture, if picture.depth_new { picture.depth.shares() } else { &[] }, queue);
    let share = (FIELD_TEXELS_PER_D / picture.pixels_per_d).min(1.0);
    let size = (picture.window.as_vec2() * share).ceil().as_uvec2();
    let field = texture("liquid", size, FIELD_FORMAT, TextureUsages::RENDER_ATTACHMENT);
    gpu.textures = Some([air, depth, field]);
}

/// Fills a texture, if there are texels.
fn write_texels(texture: &Texture, texels: &[u8], queue: &RenderQueue) {
    if !texels.is_empty() {
        let bytes_per_row = Some(texels.len() as u32 / texture.height());
        let layout = TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image: None };
        queue.write_texture(texture.as_image_copy(), texels, layout, texture.size());
    }
}

/// Makes the bind groups of the frame.
pub fn bind(mut gpu: ResMut<GpuPictures>, layouts: Res<Layouts>, cache: Res<PipelineCache>, device: Res<RenderDevice>) {
    let [world, textures] = [&layouts.world, &layouts.textures].map(|layout| cache.get_bind_group_layout(layout));
    for gpu in &mut gpu.0 {
        let (Some(uniform), Some(all)) = (gpu.uniform.binding(), &gpu.textures) else { continue };
        let [air, depth, field] = all.each_ref().map(|texture| &texture.default_view);
        let entries = BindGroupEntries::sequential((&layouts.sampler, air, depth, field));
        gpu.groups = Some([
            device.create_bind_group("world", &world, &BindGroupEntries::single(uniform)),
            device.create_bind_group("world textures", &textures, &entries),
        ]);
    }
}
