//! The picture on the graphics' side: numbers and textures, filled once a frame.

use crate::game::render::{
    cost::RenderCost,
    extract::Pictures,
    instances::PictureInstances,
    noise,
    picture::Picture,
    pipelines::{FIELD_FORMAT, Layouts, Pipelines},
    rock::RockMap,
    texture::{Map, descriptor},
    uniform::WorldUniform,
};
use bevy::{
    platform::time::Instant,
    prelude::{Res, ResMut, Resource},
    render::{
        render_resource::{
            BindGroup, BindGroupEntries, BindGroupLayout, PipelineCache, Texture, TextureFormat, TextureUsages,
            TextureView, TextureViewDescriptor, UniformBuffer,
        },
        renderer::{RenderDevice, RenderQueue},
        texture::{CachedTexture, TextureCache},
    },
};
use glam::UVec2;
use std::sync::atomic::{AtomicBool, Ordering};

/// The pictures of a frame, in the order of [`Pictures::shown`].
#[derive(Resource, Default)]
pub struct GpuPictures {
    panes: [GpuPicture; 3],
    /// Where the picture in the ring of the lens is drawn, if there is one.
    lens: Option<Sheet>,
    /// Where they are drawn if they have fewer pixels than the window.
    reduced: Option<Sheet>,
}

impl GpuPictures {
    /// The pictures.
    pub fn panes(&self) -> &[GpuPicture] {
        &self.panes
    }

    /// Where the picture in the ring of the lens is drawn, if there is one.
    pub fn lens(&self) -> Option<&Sheet> {
        self.lens.as_ref()
    }

    /// Where they are drawn if they have fewer pixels than the window.
    pub fn reduced(&self) -> Option<&Sheet> {
        self.reduced.as_ref()
    }
}

/// Uniform, textures and bind groups of a picture.
#[derive(Default)]
pub struct GpuPicture {
    uniform: UniformBuffer<WorldUniform>,
    /// What is drawn many times, and group 0 (the uniform, and those of one kind) for each.
    pub instances: PictureInstances,
    /// Air, depth, rock, bodies, glow and light.
    maps: [Map; 6],
    noise: Map,
    /// What is baked of the rock.
    stone: Option<Stone>,
    /// Bodies, more of them, gases: of this frame.
    fields: Option<[CachedTexture; 3]>,
    /// Group 1: sampler, maps, fields.
    textures: Option<BindGroup>,
}

/// A texture as large as the picture that is drawn into, and looked up later.
pub struct Sheet {
    texture: Texture,
    /// What is drawn into.
    pub view: TextureView,
    /// Group 2.
    pub group: Option<BindGroup>,
}

impl Sheet {
    /// The one that is held, or a new one if that has another size or format.
    fn fitting(
        held: Option<Self>,
        label: &'static str,
        size: UVec2,
        format: TextureFormat,
        device: &RenderDevice,
    ) -> Self {
        let fits = |sheet: &Self| {
            (sheet.texture.width(), sheet.texture.height(), sheet.texture.format()) == (size.x, size.y, format)
        };
        held.filter(fits).unwrap_or_else(|| {
            let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
            let texture = device.create_texture(&descriptor(label, size, format, usage));
            let view = texture.create_view(&TextureViewDescriptor::default());
            Self { texture, view, group: None }
        })
    }

    /// Makes its bind group if there is none.
    fn bind(&mut self, layout: &BindGroupLayout, device: &RenderDevice) {
        let view = &self.view;
        self.group.get_or_insert_with(|| device.create_bind_group("sheet", layout, &BindGroupEntries::single(view)));
    }
}

/// Rock as the picture shows it, kept until it looks otherwise.
pub struct Stone {
    /// What it is drawn on.
    pub sheet: Sheet,
    /// Whether all of it is to be drawn, and not only what changed in this frame.
    pub whole: bool,
    /// Whether it is drawn.
    pub baked: AtomicBool,
}

impl GpuPicture {
    /// The three fields, and group 1, once they are there.
    pub fn parts(&self) -> Option<([&TextureView; 3], &BindGroup)> {
        let fields = self.fields.as_ref()?;
        Some((fields.each_ref().map(|field| &field.default_view), self.textures.as_ref()?))
    }

    /// What is baked of the rock.
    pub fn stone(&self) -> Option<&Stone> {
        self.stone.as_ref()
    }

    /// Makes room for the baked rock of a picture.
    fn make_stone(&mut self, picture: &Picture, device: &RenderDevice) {
        let held = self.stone.take();
        // A frame that was not drawn has left out what changed in it.
        let baked = held.as_ref().is_some_and(|stone| stone.baked.load(Ordering::Relaxed));
        let sheet = Sheet::fitting(held.map(|stone| stone.sheet), "stone", picture.size, FIELD_FORMAT, device);
        // A new one has no group yet.
        let whole = picture.bake || !baked || sheet.group.is_none();
        let baked = AtomicBool::new(!whole && picture.rock.rows.is_empty());
        self.stone = Some(Stone { sheet, whole, baked });
    }
}

/// Hands the frame's pictures over.
pub fn upload(
    mut pictures: ResMut<Pictures>,
    mut gpu: ResMut<GpuPictures>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    mut textures: ResMut<TextureCache>,
    pipelines: Res<Pipelines>,
    cost: Res<RenderCost>,
) {
    let begin = Instant::now();
    let GpuPictures { panes, lens, reduced } = &mut *gpu;
    let (shown, idle) = panes.split_at_mut(pictures.shown().len());
    for (picture, gpu) in pictures.shown_mut().iter_mut().zip(shown) {
        hand_over(picture, gpu, &mut textures, &device, &queue);
    }
    idle.iter_mut().filter(|gpu| gpu.stone.is_some()).for_each(|gpu| *gpu = GpuPicture::default());
    let through = pictures.shown().iter().find(|picture| picture.is_lens);
    *lens = through
        .zip(pipelines.format())
        .map(|(picture, format)| Sheet::fitting(lens.take(), "lens", picture.size, format, &device));
    let smaller = pictures.shown().first().filter(|picture| picture.level.resolution() < 1.0);
    *reduced = smaller
        .zip(pipelines.format())
        .map(|(picture, format)| Sheet::fitting(reduced.take(), "reduced", picture.size, format, &device));
    RenderCost::note_time(&cost.upload, begin.elapsed());
}

fn hand_over(
    picture: &mut Picture,
    gpu: &mut GpuPicture,
    textures: &mut TextureCache,
    device: &RenderDevice,
    queue: &RenderQueue,
) {
    let Picture { particles, matter, tiles, streaks, .. } = &*picture;
    let instances = &mut gpu.instances;
    instances.particles.fill(particles, device, queue);
    instances.bodies.fill(&matter.bodies, device, queue);
    instances.more.fill(&matter.more, device, queue);
    instances.grains.fill(&matter.grains, device, queue);
    instances.gases.fill(&matter.gases, device, queue);
    instances.body_tiles.fill(&tiles.bodies, device, queue);
    instances.gas_tiles.fill(&tiles.gases, device, queue);
    instances.streaks.fill(streaks, device, queue);
    gpu.uniform.set(picture.uniform);
    gpu.uniform.write_buffer(device, queue);

    gpu.make_stone(picture, device);
    let size = |(columns, rows): (usize, usize)| UVec2::new(columns as u32, rows as u32);
    if gpu.noise.view().is_none() {
        let size = UVec2::splat(noise::EDGE as u32);
        gpu.noise.fill(&noise::texels(), size, TextureFormat::Rgba8Unorm, device, queue);
    }
    let [air, depth, rock, body, glow, light] = &mut gpu.maps;
    let colours = TextureFormat::Rgba8Unorm;
    air.fill(&picture.air.0, picture.air.1, colours, device, queue);
    if !picture.rock.rows.is_empty() || rock.view().is_none() {
        gpu.instances.rock_tiles.fill(&tiles.rock, device, queue);
        gpu.instances.changed_tiles.fill(&tiles.changed, device, queue);
        let RockMap { texels, size, rows, .. } = &picture.rock;
        rock.fill_rows(texels, *size, rows.clone(), colours, device, queue);
    }
    let as_it_is = picture.as_it_is;
    let shown = |texels| if as_it_is { texels } else { &[][..] };
    depth.fill(shown(picture.depth.shares()), size(picture.depth.dimensions()), TextureFormat::R8Unorm, device, queue);
    body.fill(shown(picture.body.texels()), size(picture.body.dimensions()), colours, device, queue);
    for (map, (texels, dimensions)) in [(glow, picture.glow.glow()), (light, picture.glow.light())] {
        let texels = if as_it_is && picture.glow.shines() { texels } else { &[] };
        map.fill(texels, size(dimensions), colours, device, queue);
    }

    let (body_texels, gas_texels) = picture.level.texels();
    let mut field = |label, texels_per_d: f32, empty: bool| {
        let share = (texels_per_d / picture.pixels_per_d).min(1.0);
        let size = if empty { UVec2::ONE } else { (picture.size.as_vec2() * share).ceil().as_uvec2().max(UVec2::ONE) };
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        textures.get(device, descriptor(label, size, FIELD_FORMAT, usage))
    };
    gpu.fields = Some([
        field("bodies", body_texels, picture.tiles.bodies.is_empty()),
        field("more bodies", body_texels, picture.matter.more.is_empty()),
        field("gases", gas_texels, picture.matter.gases.is_empty()),
    ]);
}

/// Makes the bind groups of the frame.
pub fn bind(mut gpu: ResMut<GpuPictures>, layouts: Res<Layouts>, cache: Res<PipelineCache>, device: Res<RenderDevice>) {
    let [world, textures, sheet] =
        [&layouts.world, &layouts.textures, &layouts.sheet].map(|layout| cache.get_bind_group_layout(layout));
    let GpuPictures { panes, lens, reduced } = &mut *gpu;
    lens.iter_mut().chain(reduced).for_each(|own| own.bind(&sheet, &device));
    for gpu in panes {
        let (Some(uniform), Some(fields)) = (gpu.uniform.binding(), &gpu.fields) else { continue };
        gpu.instances.bind(&world, &uniform, &device);
        let [Some(air), Some(depth), Some(rock), Some(body), Some(glow), Some(light)] =
            gpu.maps.each_ref().map(Map::view)
        else {
            continue;
        };
        let Some(noise) = gpu.noise.view() else { continue };
        let [bodies, more, gases] = fields.each_ref().map(|field| &field.default_view);
        let entries = BindGroupEntries::sequential((
            &layouts.sampler,
            air,
            depth,
            rock,
            body,
            glow,
            light,
            bodies,
            more,
            gases,
            &layouts.repeating,
            noise,
        ));
        if let Some(stone) = &mut gpu.stone {
            stone.sheet.bind(&sheet, &device);
        }
        gpu.textures = Some(device.create_bind_group("world textures", &textures, &entries));
    }
}
