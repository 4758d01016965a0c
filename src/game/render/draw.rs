//! Draws the picture: the fields of matter first, then everything in the window from back to front.

use crate::game::render::{
    extract::Pictures,
    gpu::{GpuPicture, GpuPictures, Stone},
    picture::Picture,
    pipelines::{Ids, Pipelines},
};
use bevy::{
    prelude::Res,
    render::{
        render_phase::TrackedRenderPass,
        render_resource::{
            BindGroup, Buffer, CachedRenderPipelineId, LoadOp, Operations, PipelineCache, RenderPassColorAttachment, RenderPassDescriptor, StoreOp, TextureView,
        },
        renderer::{RenderContext, ViewQuery},
        view::ViewTarget,
    },
};
use std::sync::atomic::Ordering;

/// The buffer of instances, and their number.
macro_rules! all {
    ($instances:expr) => {
        ($instances.buffer(), $instances.len())
    };
}

/// Draws the worlds of the frame.
pub fn draw(
    view: ViewQuery<&ViewTarget>,
    pictures: Res<Pictures>,
    gpu: Res<GpuPictures>,
    pipelines: Res<Pipelines>,
    cache: Res<PipelineCache>,
    mut context: RenderContext,
) {
    let target = view.into_inner();
    let Some(ids) = pipelines.ids() else { return };
    let panes: Vec<Pane<'_>> = pictures.shown().iter().zip(gpu.panes()).filter_map(Pane::new).collect();
    if panes.is_empty() {
        return;
    }
    for pane in &panes {
        pane.draw_fields(&mut context, &cache, ids);
        pane.bake(&mut context, &cache, ids);
    }
    let mut pass = context.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("world"),
        color_attachments: &[Some(target.get_color_attachment())],
        ..RenderPassDescriptor::default()
    });
    for pane in &panes {
        pane.draw(&mut pass, &cache, ids);
    }
}

/// A picture that has everything to be drawn.
struct Pane<'a> {
    picture: &'a Picture,
    fields: [&'a TextureView; 3],
    groups: &'a [BindGroup; 2],
    stone: &'a Stone,
}

impl<'a> Pane<'a> {
    fn new((picture, gpu): (&'a Picture, &'a GpuPicture)) -> Option<Self> {
        let ((fields, groups), stone) = (gpu.parts()?, gpu.stone()?);
        Some(Self { picture, fields, groups, stone })
    }

    /// Draws the fields: those of what is there.
    fn draw_fields(&self, context: &mut RenderContext<'_, '_>, cache: &PipelineCache, ids: Ids) {
        let Picture { particles, matter, as_it_is, .. } = self.picture;
        let first = if *as_it_is { (ids.body, all!(matter.bodies)) } else { (ids.coloured, all!(particles)) };
        let all = [first, (ids.more, all!(matter.more)), (ids.gas, all!(matter.gases))];
        for (view, (pipeline, what)) in self.fields.into_iter().zip(all) {
            let mut pass = into(context, "field", view);
            pass.set_bind_group(0, &self.groups[0], &[]);
            instances(&mut pass, cache, pipeline, what);
        }
    }

    /// Bakes the rock anew if it looks otherwise.
    fn bake(&self, context: &mut RenderContext<'_, '_>, cache: &PipelineCache, ids: Ids) {
        if self.stone.baked.load(Ordering::Relaxed) || cache.get_render_pipeline(ids.stone).is_none() {
            return;
        }
        let mut pass = into(context, "stone", &self.stone.view);
        for (k, group) in self.groups.iter().enumerate() {
            pass.set_bind_group(k, group, &[]);
        }
        instances(&mut pass, cache, ids.stone, all!(self.picture.tiles.rock));
        self.stone.baked.store(true, Ordering::Relaxed);
    }

    fn draw(&self, pass: &mut TrackedRenderPass<'a>, cache: &'a PipelineCache, ids: Ids) {
        let picture = self.picture;
        if let Some(part) = picture.part {
            let size = part.size();
            if size.min_element() == 0 {
                return;
            }
            pass.set_scissor_rect(part.min.x, part.min.y, size.x, size.y);
        }
        for (k, group) in self.groups.iter().enumerate() {
            pass.set_bind_group(k, group, &[]);
        }
        screen(pass, cache, ids.backdrop);
        let tiles = &picture.tiles;
        let streaks = all!(picture.streaks);
        if !picture.streaks_on_top {
            instances(pass, cache, ids.streaks, streaks);
        }
        instances(pass, cache, if picture.as_it_is { ids.surface } else { ids.shape }, all!(tiles.bodies));
        instances(pass, cache, ids.grain, all!(picture.matter.grains));
        if let Some(group) = &self.stone.group {
            pass.set_bind_group(2, group, &[]);
            instances(pass, cache, ids.rock, all!(tiles.rock));
        }
        instances(pass, cache, ids.cloud, all!(tiles.gases));
        if picture.streaks_on_top {
            instances(pass, cache, ids.streaks, streaks);
        }
    }
}

/// A pass into an empty texture.
fn into<'a>(context: &'a mut RenderContext<'_, '_>, label: &'static str, view: &TextureView) -> TrackedRenderPass<'a> {
    context.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: Operations { load: LoadOp::Clear(Default::default()), store: StoreOp::Store },
        })],
        ..RenderPassDescriptor::default()
    })
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
    (buffer, count): (Option<&'a Buffer>, usize),
) {
    if let (Some(pipeline), Some(buffer), true) = (cache.get_render_pipeline(id), buffer, count > 0) {
        pass.set_render_pipeline(pipeline);
        pass.set_vertex_buffer(0, buffer.slice(..));
        pass.draw(0..4, 0..count as u32);
    }
}
