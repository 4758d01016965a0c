//! Draws the picture: the field of the liquid first, then everything in the window from back to front.

use crate::game::render::{extract::Picture, gpu::GpuPicture, pipelines::Pipelines};
use bevy::{
    prelude::Res,
    render::{
        render_phase::TrackedRenderPass,
        render_resource::{
            Buffer, CachedRenderPipelineId, LoadOp, Operations, PipelineCache, RenderPassColorAttachment,
            RenderPassDescriptor, StoreOp,
        },
        renderer::{RenderContext, ViewQuery},
        view::ViewTarget,
    },
};

/// Draws the world of the frame.
pub fn draw(
    view: ViewQuery<&ViewTarget>,
    picture: Res<Picture>,
    gpu: Res<GpuPicture>,
    pipelines: Res<Pipelines>,
    cache: Res<PipelineCache>,
    mut context: RenderContext,
) {
    let target = view.into_inner();
    let (Some(ids), Some(world), Some(textures), Some(field), true) =
        (pipelines.ids(), &gpu.world_group, &gpu.texture_group, &gpu.field, picture.ready)
    else {
        return;
    };
    {
        let mut pass = context.begin_tracked_render_pass(RenderPassDescriptor {
            label: Some("liquid field"),
            color_attachments: &[Some(RenderPassColorAttachment {
                view: &field.view,
                depth_slice: None,
                resolve_target: None,
                ops: Operations { load: LoadOp::Clear(Default::default()), store: StoreOp::Store },
            })],
            ..RenderPassDescriptor::default()
        });
        pass.set_bind_group(0, world, &[]);
        instances(&mut pass, &cache, ids.blobs, picture.blobs.buffer(), picture.blobs.len());
    }
    let mut pass = context.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("world"),
        color_attachments: &[Some(target.get_color_attachment())],
        ..RenderPassDescriptor::default()
    });
    pass.set_bind_group(0, world, &[]);
    pass.set_bind_group(1, textures, &[]);
    screen(&mut pass, &cache, ids.backdrop);
    let streaks = (picture.streaks.buffer(), picture.streaks.len());
    if !picture.streaks_on_top {
        instances(&mut pass, &cache, ids.streaks, streaks.0, streaks.1);
    }
    screen(&mut pass, &cache, ids.liquid);
    instances(&mut pass, &cache, ids.stones, picture.stones.buffer(), picture.stones.len());
    if picture.streaks_on_top {
        instances(&mut pass, &cache, ids.streaks, streaks.0, streaks.1);
    }
}

/// Draws something over the whole screen.
fn screen<'a>(pass: &mut TrackedRenderPass<'a>, cache: &'a PipelineCache, id: CachedRenderPipelineId) {
    if let Some(pipeline) = cache.get_render_pipeline(id) {
        pass.set_render_pipeline(pipeline);
        pass.draw(0..3, 0..1);
    }
}

/// Draws one quad for each of `count` instances.
fn instances<'a>(
    pass: &mut TrackedRenderPass<'a>,
    cache: &'a PipelineCache,
    id: CachedRenderPipelineId,
    buffer: Option<&'a Buffer>,
    count: usize,
) {
    if let (Some(pipeline), Some(buffer), true) = (cache.get_render_pipeline(id), buffer, count > 0) {
        pass.set_render_pipeline(pipeline);
        pass.set_vertex_buffer(0, buffer.slice(..));
        pass.draw(0..4, 0..count as u32);
    }
}
