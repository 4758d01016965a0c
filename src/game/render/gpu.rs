//! The picture on the graphics' side: buffers and textures, filled once a frame.

use crate::game::render::{
    cost::RenderCost,
    extract::Pictures,
    picture::{Picture, WorldUniform},
    pipelines::{FIELD_FORMAT, Layouts, Pipelines},
};
use bevy::platform::time::Instant;
use bevy::{
    prelude::{Res, ResMut, Resource},
    render::{
        render_resource::{
            AddressMode, BindGroup, BindGroupEntries, Extent3d, FilterMode, Origin3d, PipelineCache, Sampler,
            SamplerDescriptor, TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureAspect, TextureDescriptor,
            TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor, UniformBuffer,
        },
        renderer::{RenderDevice, RenderQueue},
    },
};
use glam::UVec2;
use std::sync::atomic::Ordering;

/// Texels of the field to one d: enough for a smooth surface; more would only cost.
const FIELD_TEXELS_PER_D: f32 = 6.0;

/// A texture with its view and size.
pub struct Layer {
    texture: Texture,
    /// What passes read or draw.
    pub view: TextureView,
    size: UVec2,
}

/// The pictures of a frame, in the order of [`Pictures::shown`].
#[derive(Resource, Default)]
pub struct GpuPictures([GpuPicture; 3]);

impl GpuPictures {
    /// The pictures.
    pub fn panes(&self) -> &[GpuPicture] {
        &self.0
    }
}

/// Buffers, textures and bind groups of a picture.
#[derive(Default)]
pub struct GpuPicture {
    uniform: UniformBuffer<WorldUniform>,
    air: Option<Layer>,
    depth: Option<Layer>,
    /// Field of the liquid.
    pub field: Option<Layer>,
    sampler: Option<Sampler>,
    /// Group 0: the uniform.
    pub world_group: Option<BindGroup>,
    /// Group 1: sampler, air, depth, field.
    pub texture_group: Option<BindGroup>,
    stale: bool,
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
    cost: Res<RenderCost>,
) {
    let begin = Instant::now();
    for (picture, gpu) in pictures.shown_mut().iter_mut().zip(&mut gpu.0) {
        hand_over(picture, gpu, &device, &queue);
    }
    cost.upload.store(begin.elapsed().as_micros() as u32, Ordering::Relaxed);
}

fn hand_over(picture: &mut Picture, gpu: &mut GpuPicture, device: &RenderDevice, queue: &RenderQueue) {
    write_growing!(picture.particles, device, queue);
    write_growing!(picture.streaks, device, queue);
    if picture.rock_new {
        write_growing!(picture.rock, device, queue);
    }
    gpu.uniform.set(picture.uniform);
    gpu.uniform.write_buffer(device, queue);

    let (texels, size) = (&picture.air.0, if picture.air.0.is_empty() { UVec2::ONE } else { picture.air.1 });
    gpu.stale |= fit(&mut gpu.air, "air", size, TextureFormat::Rgba8Unorm, TextureUsages::COPY_DST, device);
    if let (Some(layer), false) = (&gpu.air, texels.is_empty()) {
        write_texels(layer, texels, 4, queue);
    }
    let (columns, rows) = picture.depth.dimensions();
    let size = UVec2::new(columns as u32, rows as u32).max(UVec2::ONE);
    gpu.stale |= fit(&mut gpu.depth, "depth", size, TextureFormat::R8Unorm, TextureUsages::COPY_DST, device);
    if let (Some(layer), true) = (&gpu.depth, picture.depth_new) {
        write_texels(layer, picture.depth.shares(), 1, queue);
    }
    let share = (FIELD_TEXELS_PER_D / picture.pixels_per_d).min(1.0);
    let size = (picture.window.as_vec2() * share).ceil().as_uvec2().max(UVec2::ONE);
    gpu.stale |= fit(&mut gpu.field, "liquid", size, FIELD_FORMAT, TextureUsages::RENDER_ATTACHMENT, device);
}

/// Makes the texture if there is none of this size; says whether it is new.
fn fit(
    layer: &mut Option<Layer>,
    label: &'static str,
    size: UVec2,
    format: TextureFormat,
    usage: TextureUsages,
    device: &RenderDevice,
) -> bool {
    if layer.as_ref().is_some_and(|layer| layer.size == size) {
        return false;
    }
    let texture = device.create_texture(&TextureDescriptor {
        label: Some(label),
        size: Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage: usage | TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let view = texture.create_view(&TextureViewDescriptor::default());
    *layer = Some(Layer { texture, view, size });
    true
}

fn write_texels(layer: &Layer, texels: &[u8], bytes_per_texel: u32, queue: &RenderQueue) {
    debug_assert_eq!(texels.len() as u32, layer.size.x * layer.size.y * bytes_per_texel, "one texel a cell");
    queue.write_texture(
        TexelCopyTextureInfo {
            texture: &layer.texture,
            mip_level: 0,
            origin: Origin3d::ZERO,
            aspect: TextureAspect::All,
        },
        texels,
        TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(layer.size.x * bytes_per_texel), rows_per_image: None },
        Extent3d { width: layer.size.x, height: layer.size.y, depth_or_array_layers: 1 },
    );
}

/// Makes the bind groups that are missing or bound to textures of the past.
pub fn bind(
    mut gpu: ResMut<GpuPictures>,
    pipelines: Res<Pipelines>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
) {
    let Some(layouts) = pipelines.layouts() else { return };
    for gpu in &mut gpu.0 {
        bind_one(gpu, layouts, &cache, &device);
    }
}

fn bind_one(gpu: &mut GpuPicture, layouts: &Layouts, cache: &PipelineCache, device: &RenderDevice) {
    if gpu.world_group.is_none()
        && let Some(uniform) = gpu.uniform.binding()
    {
        let layout = cache.get_bind_group_layout(&layouts.world);
        gpu.world_group = Some(device.create_bind_group("world", &layout, &BindGroupEntries::single(uniform)));
    }
    if !gpu.stale {
        return;
    }
    let sampler = gpu.sampler.get_or_insert_with(|| {
        device.create_sampler(&SamplerDescriptor {
            address_mode_u: AddressMode::ClampToEdge,
            address_mode_v: AddressMode::ClampToEdge,
            mag_filter: FilterMode::Linear,
            min_filter: FilterMode::Linear,
            ..SamplerDescriptor::default()
        })
    });
    if let (Some(air), Some(depth), Some(field)) = (&gpu.air, &gpu.depth, &gpu.field) {
        let layout = cache.get_bind_group_layout(&layouts.textures);
        let entries = BindGroupEntries::sequential((&*sampler, &air.view, &depth.view, &field.view));
        gpu.texture_group = Some(device.create_bind_group("world textures", &layout, &entries));
        gpu.stale = false;
    }
}
