//! Draws the picture: the fields of matter first, then everything in the window from back to front.

use crate::game::render::{
    cost::{PicturePass, RenderCost, Repeat},
    extract::Pictures,
    gpu::{GpuPicture, GpuPictures, Stone},
    instances::{Instances, PictureInstances},
    picture::Picture,
    pipelines::{Ids, Pipelines, Variants},
};
use bevy::{
    prelude::Res,
    render::{
        render_phase::TrackedRenderPass,
        render_resource::{
            BindGroup, CachedRenderPipelineId, LoadOp, Operations, PipelineCache, RenderPassColorAttachment,
            RenderPassDescriptor, RenderPipeline, StoreOp, TextureView,
        },
        renderer::{RenderContext, ViewQuery},
        view::ViewTarget,
    },
};
use std::sync::atomic::Ordering;

/// Draws the worlds of the frame.
pub fn draw(
    view: ViewQuery<&ViewTarget>,
    pictures: Res<Pictures>,
    gpu: Res<GpuPictures>,
    pipelines: Res<Pipelines>,
    cache: Res<PipelineCache>,
    cost: Res<RenderCost>,
    repeat: Res<Repeat>,
    mut context: RenderContext,
) {
    let target = view.into_inner();
    let Some(ids) = pipelines.ids() else { return };
    let panes = pictures.shown().iter().zip(gpu.panes()).filter_map(Pane::new);
    let (lenses, panes): (Vec<Pane<'_>>, Vec<Pane<'_>>) = panes.partition(|pane| pane.picture.is_lens);
    cost.note_wait(panes.iter().chain(&lenses).any(|pane| ids.are_awaited(pane.picture.features, &cache)));
    if panes.is_empty() {
        return;
    }
    cost.begin();
    let with = With { cache: &cache, ids, cost: &cost, repeat: *repeat };
    for pane in panes.iter().chain(&lenses) {
        pane.draw_fields(&mut context, with);
        pane.bake(&mut context, with);
    }
    let group = gpu.lens().and_then(|sheet| {
        let mut pass = into(&mut context, "lens", &sheet.view);
        lenses.iter().for_each(|pane| pane.draw(&mut pass, with));
        sheet.group.as_ref()
    });
    let Some(reduced) = gpu.reduced() else {
        let mut pass = over(&mut context, target);
        panes.iter().for_each(|pane| pane.draw(&mut pass, with));
        lenses.iter().zip(group).for_each(|(pane, group)| pane.draw_ring(&mut pass, group, with));
        return;
    };
    let mut pass = into(&mut context, "reduced", &reduced.view);
    panes.iter().for_each(|pane| pane.draw(&mut pass, with));
    lenses.iter().zip(group).for_each(|(pane, group)| pane.draw_ring(&mut pass, group, with));
    drop(pass);
    if let Some(group) = &reduced.group {
        let mut pass = over(&mut context, target);
        panes[0].bind(&mut pass);
        pass.set_bind_group(2, group, &[]);
        with.screen(&mut pass, PicturePass::Enlarged, ids.enlarged);
    }
}

/// A pass over what the window's target holds.
fn over<'a>(context: &'a mut RenderContext<'_, '_>, target: &ViewTarget) -> TrackedRenderPass<'a> {
    context.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("world"),
        color_attachments: &[Some(target.get_color_attachment())],
        ..RenderPassDescriptor::default()
    })
}

/// A picture that has everything to be drawn.
struct Pane<'a> {
    picture: &'a Picture,
    instances: &'a PictureInstances,
    fields: [&'a TextureView; 3],
    textures: &'a BindGroup,
    stone: &'a Stone,
}

impl<'a> Pane<'a> {
    fn new((picture, gpu): (&'a Picture, &'a GpuPicture)) -> Option<Self> {
        let ((fields, textures), stone) = (gpu.parts()?, gpu.stone()?);
        Some(Self { picture, instances: &gpu.instances, fields, textures, stone })
    }

    /// Binds its numbers, and its maps and fields.
    fn bind(&self, pass: &mut TrackedRenderPass<'a>) {
        // A pass over all of the screen reads the numbers only, and they are in the group of any of its instances.
        if let Some(numbers) = self.instances.bodies.group() {
            pass.set_bind_group(0, numbers, &[]);
        }
        pass.set_bind_group(1, self.textures, &[]);
    }

    /// Draws the fields of what is there.
    fn draw_fields(&self, context: &mut RenderContext<'_, '_>, with: With<'_>) {
        let PictureInstances { particles, bodies, more, gases, .. } = self.instances;
        let ids = with.ids;
        let first = if self.picture.as_it_is { (ids.body, bodies) } else { (ids.coloured, particles) };
        let all = [
            (PicturePass::Bodies, first),
            (PicturePass::Bodies, (ids.more, more)),
            (PicturePass::Gases, (ids.gas, gases)),
        ];
        for (view, (of, (pipeline, what))) in self.fields.into_iter().zip(all) {
            if what.count() > 0 {
                with.instances(&mut into(context, "field", view), of, pipeline, what);
            }
        }
    }

    /// Bakes the rock anew where it looks otherwise.
    fn bake(&self, context: &mut RenderContext<'_, '_>, with: With<'_>) {
        let Self { stone, instances, .. } = self;
        if stone.baked.load(Ordering::Relaxed) || with.cache.get_render_pipeline(with.ids.stone).is_none() {
            return;
        }
        let (mut pass, tiles) = if stone.whole {
            (into(context, "stone", &stone.sheet.view), &instances.rock_tiles)
        } else {
            (onto(context, "stone", &stone.sheet.view), &instances.changed_tiles)
        };
        self.bind(&mut pass);
        with.instances(&mut pass, PicturePass::Bake, with.ids.stone, tiles);
        stone.baked.store(true, Ordering::Relaxed);
    }

    /// Keeps what is drawn to its part; whether there is any.
    fn confine(&self, pass: &mut TrackedRenderPass<'a>) -> bool {
        let Some(part) = self.picture.part else { return true };
        let size = part.size();
        if size.min_element() > 0 {
            pass.set_scissor_rect(part.min.x, part.min.y, size.x, size.y);
        }
        size.min_element() > 0
    }

    /// Draws what is on the sheet of `group` into its ring.
    fn draw_ring(&self, pass: &mut TrackedRenderPass<'a>, group: &'a BindGroup, with: With<'a>) {
        if self.confine(pass) {
            self.bind(pass);
            pass.set_bind_group(2, group, &[]);
            with.screen(pass, PicturePass::Lens, with.ids.lens);
        }
    }

    fn draw(&self, pass: &mut TrackedRenderPass<'a>, with: With<'a>) {
        let (picture, instances, ids) = (self.picture, self.instances, with.ids);
        let fitting = |of: &Variants| of.fitting(picture.features, with.cache);
        if !self.confine(pass) {
            return;
        }
        self.bind(pass);
        with.screen(pass, PicturePass::Backdrop, fitting(&ids.backdrop));
        let streaks = &instances.streaks;
        if !picture.streaks_on_top {
            with.instances(pass, PicturePass::Streaks, ids.streaks, streaks);
        }
        let surface = if picture.as_it_is { fitting(&ids.surface) } else { Some(ids.shape) };
        with.instances(pass, PicturePass::Surface, surface, &instances.body_tiles);
        with.instances(pass, PicturePass::Grains, ids.grain, &instances.grains);
        if let Some(group) = &self.stone.sheet.group {
            pass.set_bind_group(2, group, &[]);
            with.instances(pass, PicturePass::Rock, fitting(&ids.rock), &instances.rock_tiles);
        }
        with.instances(pass, PicturePass::Clouds, fitting(&ids.cloud), &instances.gas_tiles);
        if picture.streaks_on_top {
            with.instances(pass, PicturePass::Streaks, ids.streaks, streaks);
        }
    }
}

/// A pass into an empty texture.
fn into<'a>(context: &'a mut RenderContext<'_, '_>, label: &'static str, view: &TextureView) -> TrackedRenderPass<'a> {
    begin(context, label, view, false)
}

/// A pass over what a texture holds.
fn onto<'a>(context: &'a mut RenderContext<'_, '_>, label: &'static str, view: &TextureView) -> TrackedRenderPass<'a> {
    begin(context, label, view, true)
}

fn begin<'a>(
    context: &'a mut RenderContext<'_, '_>,
    label: &'static str,
    view: &TextureView,
    keeps: bool,
) -> TrackedRenderPass<'a> {
    context.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: Operations {
                load: if keeps { LoadOp::Load } else { LoadOp::Clear(Default::default()) },
                store: StoreOp::Store,
            },
        })],
        ..RenderPassDescriptor::default()
    })
}

/// What it takes to draw, and the ledger of what was drawn.
#[derive(Clone, Copy)]
struct With<'a> {
    cache: &'a PipelineCache,
    ids: &'a Ids,
    cost: &'a RenderCost,
    repeat: Repeat,
}

impl<'a> With<'a> {
    /// A pipeline, if there is one and it is ready.
    fn pipeline(self, id: impl Into<Option<CachedRenderPipelineId>>) -> Option<&'a RenderPipeline> {
        self.cache.get_render_pipeline(id.into()?)
    }

    /// Draws something over the whole screen.
    fn screen(self, pass: &mut TrackedRenderPass<'a>, of: PicturePass, id: impl Into<Option<CachedRenderPipelineId>>) {
        if let Some(pipeline) = self.pipeline(id) {
            pass.set_render_pipeline(pipeline);
            (0..self.repeat.times(of)).for_each(|_| pass.draw(0..3, 0..1));
            self.cost.note(of, 1);
        }
    }

    /// Draws all instances, if there are any.
    fn instances<const VERTICES: u32>(
        self,
        pass: &mut TrackedRenderPass<'a>,
        of: PicturePass,
        id: impl Into<Option<CachedRenderPipelineId>>,
        instances: &'a Instances<VERTICES>,
    ) {
        if let (Some(pipeline), Some(group), true) = (self.pipeline(id), instances.group(), instances.count() > 0) {
            pass.set_render_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            (0..self.repeat.times(of)).for_each(|_| pass.draw(0..instances.vertices(), 0..1));
            self.cost.note(of, instances.count());
        }
    }
}
