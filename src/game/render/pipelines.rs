//! The five pipelines of the picture, made for the format of the window's target.

use crate::game::render::picture::WorldUniform;
use bevy::{
    asset::Handle,
    mesh::VertexBufferLayout,
    prelude::{Commands, Query, Res, ResMut, Resource, With},
    render::{
        camera::ExtractedCamera,
        render_resource::{
            BindGroupLayoutDescriptor, BindGroupLayoutEntries, BlendState, CachedRenderPipelineId, ColorTargetState,
            ColorWrites, FilterMode, FragmentState, PipelineCache, PrimitiveState, PrimitiveTopology,
            RenderPipelineDescriptor, Sampler, SamplerBindingType, SamplerDescriptor, ShaderStages, TextureFormat,
            TextureSampleType, VertexFormat, VertexState, VertexStepMode,
            binding_types::{sampler, texture_2d, uniform_buffer},
        },
        renderer::RenderDevice,
        view::ViewTarget,
    },
    shader::Shader,
};

/// Format of the field that the liquid is drawn into. Its bytes are sRGB, but it is blended and sampled as they are.
pub const FIELD_FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;

/// The shader of the picture.
#[derive(Resource)]
pub struct WorldShader(pub Handle<Shader>);

/// Layouts of the two bind groups, and the sampler that is in one of them.
#[derive(Resource)]
pub struct Layouts {
    /// Group 0: the uniform.
    pub world: BindGroupLayoutDescriptor,
    /// Group 1: sampler, air, depth, field.
    pub textures: BindGroupLayoutDescriptor,
    /// Samples between texels, up to the edge.
    pub sampler: Sampler,
}

/// The pipelines' ids in the cache.
#[derive(Clone, Copy)]
pub struct Ids {
    /// Box and air.
    pub backdrop: CachedRenderPipelineId,
    /// Particles into the field.
    pub particles: CachedRenderPipelineId,
    /// The liquid's surface.
    pub liquid: CachedRenderPipelineId,
    /// Rock.
    pub rock: CachedRenderPipelineId,
    /// Streaks of wind.
    pub streaks: CachedRenderPipelineId,
}

/// The pipelines, once there are any, and the format that they are made for.
#[derive(Resource, Default)]
pub struct Pipelines(Option<(TextureFormat, Ids)>);

impl Pipelines {
    /// Their ids, once there are any.
    pub fn ids(&self) -> Option<Ids> {
        self.0.map(|(_, ids)| ids)
    }
}

/// Makes the layouts and the sampler.
pub fn make_layouts(mut commands: Commands, device: Res<RenderDevice>) {
    let texture = || texture_2d(TextureSampleType::Float { filterable: true });
    commands.insert_resource(Layouts {
        world: BindGroupLayoutDescriptor::new(
            "world",
            &BindGroupLayoutEntries::single(ShaderStages::VERTEX_FRAGMENT, uniform_buffer::<WorldUniform>(false)),
        ),
        textures: BindGroupLayoutDescriptor::new(
            "world textures",
            &BindGroupLayoutEntries::sequential(
                ShaderStages::FRAGMENT,
                (sampler(SamplerBindingType::Filtering), texture(), texture(), texture()),
            ),
        ),
        sampler: device.create_sampler(&SamplerDescriptor {
            mag_filter: FilterMode::Linear,
            min_filter: FilterMode::Linear,
            ..SamplerDescriptor::default()
        }),
    });
}

/// Makes the pipelines when the window's format is known or has changed.
pub fn prepare(
    mut pipelines: ResMut<Pipelines>,
    layouts: Res<Layouts>,
    cache: Res<PipelineCache>,
    shader: Res<WorldShader>,
    targets: Query<&ViewTarget, With<ExtractedCamera>>,
) {
    let Some(format) = targets.iter().next().map(ViewTarget::main_texture_format) else { return };
    if pipelines.0.is_some_and(|(of, _)| of == format) {
        return;
    }
    // The pipeline of a quad for each instance of these formats, or of the whole screen if there are none.
    let make = |name: &'static str, instance: &[VertexFormat], format, blend| {
        // The pass that draws into the field must not have the field bound.
        let textures = (name != "particle").then(|| layouts.textures.clone());
        let (vertex, topology) = match instance {
            [] => ("screen", PrimitiveTopology::TriangleList),
            _ => (name, PrimitiveTopology::TriangleStrip),
        };
        let buffer = VertexBufferLayout::from_vertex_formats(VertexStepMode::Instance, instance.iter().copied());
        cache.queue_render_pipeline(RenderPipelineDescriptor {
            label: Some(name.into()),
            layout: [layouts.world.clone()].into_iter().chain(textures).collect(),
            vertex: VertexState {
                shader: shader.0.clone(),
                shader_defs: vec![],
                entry_point: Some(format!("{vertex}_vertex").into()),
                buffers: if instance.is_empty() { vec![] } else { vec![buffer] },
            },
            primitive: PrimitiveState { topology, ..PrimitiveState::default() },
            fragment: Some(FragmentState {
                shader: shader.0.clone(),
                shader_defs: vec![],
                entry_point: Some(format!("{name}_fragment").into()),
                targets: vec![Some(ColorTargetState { format, blend, write_mask: ColorWrites::ALL })],
            }),
            ..RenderPipelineDescriptor::default()
        })
    };
    use VertexFormat as F;
    let (alpha, premultiplied) = (BlendState::ALPHA_BLENDING, BlendState::PREMULTIPLIED_ALPHA_BLENDING);
    let ids = Ids {
        backdrop: make("backdrop", &[], format, None),
        particles: make("particle", &[F::Float32x2, F::Unorm8x4], FIELD_FORMAT, Some(premultiplied)),
        liquid: make("liquid", &[], format, Some(alpha)),
        rock: make("rock", &[F::Uint16x2, F::Uint8x4], format, Some(alpha)),
        streaks: make("streak", &[F::Float32x4, F::Unorm8x4], format, Some(alpha)),
    };
    pipelines.0 = Some((format, ids));
}
