//! Textures that the picture is made with.

use bevy::render::{
    render_resource::{
        Extent3d, TexelCopyBufferLayout, Texture, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages,
        TextureView, TextureViewDescriptor,
    },
    renderer::{RenderDevice, RenderQueue},
};
use glam::UVec2;
use std::ops::Range;

/// A texture of one layer and one level.
pub fn descriptor(
    label: &'static str,
    size: UVec2,
    format: TextureFormat,
    usage: TextureUsages,
) -> TextureDescriptor<'static> {
    TextureDescriptor {
        label: Some(label),
        size: Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    }
}

/// A texture that the processor fills, and that stays until it is filled again.
#[derive(Default)]
pub struct Map(Option<(Texture, TextureView)>);

impl Map {
    /// What shaders look it up by, once it has been filled.
    pub fn view(&self) -> Option<&TextureView> {
        self.0.as_ref().map(|(_, view)| view)
    }

    /// Its columns and rows.
    pub fn size(&self) -> UVec2 {
        self.0.as_ref().map_or(UVec2::ZERO, |(texture, _)| UVec2::new(texture.width(), texture.height()))
    }

    /// Fills it; with nothing, it becomes one texel of zeros.
    pub fn fill(
        &mut self,
        texels: &[u8],
        size: UVec2,
        format: TextureFormat,
        device: &RenderDevice,
        queue: &RenderQueue,
    ) {
        let (texels, size) = if texels.is_empty() { (&[0; 4][..], UVec2::ONE) } else { (texels, size) };
        self.fill_rows(texels, size, 0..size.y, format, device, queue);
    }

    /// Fills some rows of it, or all if it is of another size.
    pub fn fill_rows(
        &mut self,
        texels: &[u8],
        size: UVec2,
        rows: Range<u32>,
        format: TextureFormat,
        device: &RenderDevice,
        queue: &RenderQueue,
    ) {
        let rows = if self.make(size, format, device) { 0..size.y } else { rows };
        let bytes = texels.len() / size.y as usize;
        self.write(&texels[bytes * rows.start as usize..bytes * rows.end as usize], rows, size.x, queue);
    }

    /// Makes it anew if it is of another size; whether it was.
    pub fn make(&mut self, size: UVec2, format: TextureFormat, device: &RenderDevice) -> bool {
        let is_new = self.size() != size;
        if is_new {
            let usage = TextureUsages::COPY_DST | TextureUsages::TEXTURE_BINDING;
            let texture = device.create_texture(&descriptor("map", size, format, usage));
            let view = texture.create_view(&TextureViewDescriptor::default());
            self.0 = Some((texture, view));
        }
        is_new
    }

    /// Fills the first `width` texels of some rows.
    pub fn write(&self, texels: &[u8], rows: Range<u32>, width: u32, queue: &RenderQueue) {
        let Some((texture, _)) = self.0.as_ref().filter(|_| !texels.is_empty()) else { return };
        let height = rows.end - rows.start;
        let bytes_per_row = Some(texels.len() as u32 / height);
        let layout = TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image: None };
        let mut part = texture.as_image_copy();
        part.origin.y = rows.start;
        queue.write_texture(part, texels, layout, Extent3d { width, height, depth_or_array_layers: 1 });
    }
}
