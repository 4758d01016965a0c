//! The pipelines of the picture, made for the format of the window's target.

use crate::game::render::{extract::Pictures, features::Features, instances::ROW, uniform::WorldUniform};
use bevy::{
    asset::Handle,
    prelude::{Commands, Query, Res, ResMut, Resource, With},
    render::{
        camera::ExtractedCamera,
        render_resource::{
            AddressMode, BindGroupLayoutDescriptor, BindGroupLayoutEntries, BlendComponent, BlendFactor,
            BlendOperation, BlendState, CachedPipelineState, CachedRenderPipelineId, ColorTargetState, ColorWrites,
            FilterMode, FragmentState, PipelineCache, RenderPipelineDescriptor, Sampler, SamplerBindingType,
            SamplerDescriptor, ShaderStages, TextureFormat, TextureSampleType, VertexState,
            binding_types::{sampler, texture_2d, uniform_buffer},
        },
        renderer::RenderDevice,
        view::ViewTarget,
    },
    shader::{Shader, ShaderDefVal},
};

/// Format of the fields that matter is drawn into. Their bytes are sRGB, but they are blended and sampled as they are.
pub const FIELD_FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;

/// Passes that draw into the fields.
const INTO_FIELDS: [&str; 4] = ["coloured", "body", "more", "gas"];

/// Adds up to 1 − Π(1 − w) in each channel, in whatever order.
const UNION: BlendState =
    BlendState { color: beyond(BlendFactor::OneMinusSrc), alpha: beyond(BlendFactor::OneMinusSrcAlpha) };

/// Adds up.
const SUM: BlendState = BlendState { color: beyond(BlendFactor::One), alpha: beyond(BlendFactor::One) };

/// Takes what is lighter, in whatever order.
const LIGHTER: BlendState = {
    let lighter =
        BlendComponent { src_factor: BlendFactor::One, dst_factor: BlendFactor::One, operation: BlendOperation::Max };
    BlendState { color: lighter, alpha: lighter }
};

/// What comes is added to this share of what is there.
const fn beyond(dst_factor: BlendFactor) -> BlendComponent {
    BlendComponent { src_factor: BlendFactor::One, dst_factor, operation: BlendOperation::Add }
}

/// The shader of the picture.
#[derive(Resource)]
pub struct WorldShader(pub Handle<Shader>);

/// Layouts of the two bind groups, and the sampler that is in one of them.
#[derive(Resource)]
pub struct Layouts {
    /// Group 0: the uniform, and the numbers of instances.
    pub world: BindGroupLayoutDescriptor,
    /// Group 1: sampler, maps (air, depth, rock, bodies, glow, light) and fields (bodies, more, gases); repeating sampler, noise.
    pub textures: BindGroupLayoutDescriptor,
    /// Group 2: what was drawn before on a sheet as large as the picture.
    pub sheet: BindGroupLayoutDescriptor,
    /// Samples between texels, up to the edge.
    pub sampler: Sampler,
    /// Samples between texels, over the edge again from the other side.
    pub repeating: Sampler,
}

/// A pass over many pixels, with a pipeline for each set of features that pictures had so far.
pub struct Variants {
    /// What it asks pictures for.
    reads: Features,
    made: Vec<(Features, CachedRenderPipelineId)>,
}

impl Variants {
    /// The pipeline for a picture of these features; until it is ready, the one that is most like it, if any is.
    pub fn fitting(&self, features: Features, cache: &PipelineCache) -> Option<CachedRenderPipelineId> {
        let features = features.and(self.reads);
        let ready = self.made.iter().filter(|(_, id)| cache.get_render_pipeline(*id).is_some());
        ready.max_by_key(|(of, _)| (*of == features, of.and(features).count())).map(|(_, id)| *id)
    }

    /// Whether that for a picture of these features is still being made.
    fn is_awaited(&self, features: Features, cache: &PipelineCache) -> bool {
        let features = features.and(self.reads);
        // One that can't be made is not awaited: another draws for it, and the log says why.
        let is_done = |id| {
            matches!(cache.get_render_pipeline_state(id), CachedPipelineState::Ok(_) | CachedPipelineState::Err(_))
        };
        self.made.iter().any(|(of, id)| *of == features && !is_done(*id))
    }
}

/// The pipelines' ids in the cache.
pub struct Ids {
    /// Box and air.
    pub backdrop: Variants,
    /// Coloured particles into the first field.
    pub coloured: CachedRenderPipelineId,
    /// What comes of them.
    pub shape: CachedRenderPipelineId,
    /// Bodies into the first field.
    pub body: CachedRenderPipelineId,
    /// Bodies into the second.
    pub more: CachedRenderPipelineId,
    /// The surface of the bodies.
    pub surface: Variants,
    /// Grains.
    pub grain: CachedRenderPipelineId,
    /// Gases into their field.
    pub gas: CachedRenderPipelineId,
    /// What comes of them.
    pub cloud: Variants,
    /// Rock as the window shows it.
    pub stone: CachedRenderPipelineId,
    /// Rock in the light of the frame.
    pub rock: Variants,
    /// Streaks of wind.
    pub streaks: CachedRenderPipelineId,
    /// What was drawn for the truth lens, in its ring.
    pub lens: CachedRenderPipelineId,
    /// A picture of fewer pixels than the window over all of it.
    pub enlarged: CachedRenderPipelineId,
}

impl Ids {
    /// Whether something for a picture of these features is still being made.
    pub fn are_awaited(&self, features: Features, cache: &PipelineCache) -> bool {
        let passes = [&self.backdrop, &self.surface, &self.cloud, &self.rock];
        passes.into_iter().any(|pass| pass.is_awaited(features, cache))
    }
}

/// The pipelines, once there are any, and the format that they are made for.
#[derive(Resource, Default)]
pub struct Pipelines(Option<(TextureFormat, Ids)>);

impl Pipelines {
    /// Their ids, once there are any.
    pub fn ids(&self) -> Option<&Ids> {
        self.0.as_ref().map(|(_, ids)| ids)
    }

    /// The format that they are made for.
    pub fn format(&self) -> Option<TextureFormat> {
        self.0.as_ref().map(|(format, _)| *format)
    }
}

/// Makes the layouts and the sampler.
pub fn make_layouts(mut commands: Commands, device: Res<RenderDevice>) {
    let texture = || texture_2d(TextureSampleType::Float { filterable: true });
    let sampler_of = |address| {
        device.create_sampler(&SamplerDescriptor {
            address_mode_u: address,
            address_mode_v: address,
            mag_filter: FilterMode::Linear,
            min_filter: FilterMode::Linear,
            ..SamplerDescriptor::default()
        })
    };
    commands.insert_resource(Layouts {
        world: BindGroupLayoutDescriptor::new(
            "world",
            &BindGroupLayoutEntries::sequential(
                ShaderStages::VERTEX,
                (
                    uniform_buffer::<WorldUniform>(false).visibility(ShaderStages::VERTEX_FRAGMENT),
                    texture_2d(TextureSampleType::Uint),
                ),
            ),
        ),
        textures: BindGroupLayoutDescriptor::new(
            "world textures",
            &BindGroupLayoutEntries::sequential(
                ShaderStages::VERTEX_FRAGMENT,
                (
                    sampler(SamplerBindingType::Filtering),
                    texture(),
                    texture(),
                    texture(),
                    texture(),
                    texture(),
                    texture(),
                    texture(),
                    texture(),
                    texture(),
                    sampler(SamplerBindingType::Filtering),
                    texture(),
                ),
            ),
        ),
        sheet: BindGroupLayoutDescriptor::new(
            "sheet",
            &BindGroupLayoutEntries::single(ShaderStages::FRAGMENT, texture()),
        ),
        sampler: sampler_of(AddressMode::ClampToEdge),
        repeating: sampler_of(AddressMode::Repeat),
    });
}

/// How a pass is drawn.
struct Recipe {
    vertex: &'static str,
    name: &'static str,
    format: TextureFormat,
    blend: Option<BlendState>,
}

/// What makes pipelines.
struct Maker<'a> {
    layouts: &'a Layouts,
    cache: &'a PipelineCache,
    shader: &'a WorldShader,
}

impl Maker<'_> {
    fn make(&self, recipe: &Recipe, features: Features) -> CachedRenderPipelineId {
        let Self { layouts, cache, shader } = self;
        let Recipe { vertex, name, format, blend } = *recipe;
        // The passes that draw into the fields must not have these bound.
        let textures = (!INTO_FIELDS.contains(&name)).then(|| layouts.textures.clone());
        let sheet = ["rock", "lens", "enlarged"].contains(&name).then(|| layouts.sheet.clone());
        let mut definitions = features.definitions();
        definitions.push(ShaderDefVal::UInt("ROW".into(), ROW));
        cache.queue_render_pipeline(RenderPipelineDescriptor {
            label: Some(name.into()),
            layout: [layouts.world.clone()].into_iter().chain(textures).chain(sheet).collect(),
            vertex: VertexState {
                shader: shader.0.clone(),
                shader_defs: definitions.clone(),
                entry_point: Some(format!("{vertex}_vertex").into()),
                ..VertexState::default()
            },
            fragment: Some(FragmentState {
                shader: shader.0.clone(),
                shader_defs: definitions,
                entry_point: Some(format!("{name}_fragment").into()),
                targets: vec![Some(ColorTargetState { format, blend, write_mask: ColorWrites::ALL })],
            }),
            ..RenderPipelineDescriptor::default()
        })
    }

    /// Makes what a picture of these features wants of a pass.
    fn make_fitting(&self, of: &mut Variants, recipe: &Recipe, features: Features) {
        let features = features.and(of.reads);
        if of.made.iter().all(|(made, _)| *made != features) {
            of.made.push((features, self.make(recipe, features)));
        }
    }
}

/// Makes the pipelines when the window's format is known or has changed, and those that a picture is the first to want.
pub fn prepare(
    mut pipelines: ResMut<Pipelines>,
    layouts: Res<Layouts>,
    cache: Res<PipelineCache>,
    shader: Res<WorldShader>,
    pictures: Res<Pictures>,
    targets: Query<&ViewTarget, With<ExtractedCamera>>,
) {
    let Some(format) = targets.iter().next().map(ViewTarget::main_texture_format) else { return };
    let (alpha, premultiplied) = (BlendState::ALPHA_BLENDING, BlendState::PREMULTIPLIED_ALPHA_BLENDING);
    let recipe = |vertex, name, format, blend| Recipe { vertex, name, format, blend };
    let backdrop = recipe("screen", "backdrop", format, None);
    let surface = recipe("tile", "surface", format, Some(alpha));
    let cloud = recipe("tile", "cloud", format, Some(premultiplied));
    let rock = recipe("tile", "rock", format, Some(alpha));
    let maker = Maker { layouts: &layouts, cache: &cache, shader: &shader };
    if pipelines.format() != Some(format) {
        let make = |recipe: Recipe| maker.make(&recipe, Features::ALL);
        let variants = |reads| Variants { reads, made: Vec::new() };
        let ids = Ids {
            backdrop: variants(Features::AIR.or(Features::GLOW)),
            coloured: make(recipe("coloured", "coloured", FIELD_FORMAT, Some(premultiplied))),
            shape: make(recipe("tile", "shape", format, Some(alpha))),
            body: make(recipe("body", "body", FIELD_FORMAT, Some(UNION))),
            more: make(recipe("body", "more", FIELD_FORMAT, Some(UNION))),
            surface: variants(Features::GLOW.or(Features::RICH).or(Features::MORE)),
            grain: make(recipe("grain", "grain", format, Some(LIGHTER))),
            gas: make(recipe("gas", "gas", FIELD_FORMAT, Some(SUM))),
            cloud: variants(Features::GLOW.or(Features::RICH)),
            stone: make(recipe("tile", "stone", FIELD_FORMAT, None)),
            rock: variants(Features::GLOW),
            streaks: make(recipe("streak", "streak", format, Some(alpha))),
            lens: make(recipe("screen", "lens", format, Some(alpha))),
            enlarged: make(recipe("screen", "enlarged", format, None)),
        };
        pipelines.0 = Some((format, ids));
    }
    let Some((_, ids)) = &mut pipelines.0 else { return };
    for picture in pictures.shown() {
        let passes = [
            (&mut ids.backdrop, &backdrop),
            (&mut ids.surface, &surface),
            (&mut ids.cloud, &cloud),
            (&mut ids.rock, &rock),
        ];
        passes.into_iter().for_each(|(of, recipe)| maker.make_fitting(of, recipe, picture.features));
    }
}
