//! The five pipelines of the picture, made for the format of the window's target.

use crate::game::render::picture::WorldUniform;
use bevy::{
    asset::Handle,
    mesh::VertexBufferLayout,
    prelude::{Query, Res, ResMut, Resource, With},
    render::{
        camera::ExtractedCamera,
        render_resource::{
            BindGroupLayoutDescriptor, BindGroupLayoutEntries, BlendState, CachedRenderPipelineId, ColorTargetState,
            ColorWrites, FragmentState, PipelineCache, PrimitiveState, PrimitiveTopology, RenderPipelineDescriptor,
            SamplerBindingType, ShaderStages, TextureFormat, TextureSampleType, VertexFormat, VertexState,
            VertexStepMode,
            binding_types::{sampler, texture_2d, uniform_buffer},
        },
        view::ViewTarget,
    },
    shader::Shader,
};

/// Format of the field that the liquid is drawn into. Its bytes are sRGB, but it is blended and sampled as they are.
pub const FIELD_FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;

/// The shader of the picture.
#[derive(Resource)]
pub struct WorldShader(pub Handle<Shader>);

/// Layouts of the two bind groups.
pub struct Layouts {
    /// Group 0: the uniform.
    pub world: BindGroupLayoutDescriptor,
    /// Group 1: sampler, air, depth, field.
    pub textures: BindGroupLayoutDescriptor,
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

/// Pipelines and their layouts.
#[derive(Resource, Default)]
pub struct Pipelines {
    layouts: Option<Layouts>,
    made: Option<(TextureFormat, Ids)>,
}

impl Pipelines {
    /// The bind groups' layouts, once there are any.
    pub fn layouts(&self) -> Option<&Layouts> {
        self.layouts.as_ref()
    }

    /// The pipelines, once there are any.
    pub fn ids(&self) -> Option<Ids> {
        self.made.map(|(_, ids)| ids)
    }
}

/// Makes the pipelines when the window's format is known or has changed.
pub fn prepare(
    mut pipelines: ResMut<Pipelines>,
    cache: Res<PipelineCache>,
    shader: Res<WorldShader>,
    targets: Query<&ViewTarget, With<ExtractedCamera>>,
) {
    let Some(target) = targets.iter().next() else { return };
    let format = target.main_texture_format();
    if pipelines.made.is_some_and(|(of, _)| of == format) {
        return;
    }
    let layouts = pipelines.layouts.get_or_insert_with(make_layouts);
    let maker = Maker { cache: &cache, shader: &shader.0, layouts };
    let quad = PrimitiveTopology::TriangleStrip;
    let screen = PrimitiveTopology::TriangleList;
    let alpha = Some(BlendState::ALPHA_BLENDING);
    let instances = |formats: &[VertexFormat]| {
        vec![VertexBufferLayout::from_vertex_formats(VertexStepMode::Instance, formats.iter().copied())]
    };
    use VertexFormat as F;
    let ids = Ids {
        backdrop: maker.make("backdrop", "screen_vertex", screen, vec![], format, None),
        particles: maker.make(
            "particle",
            "particle_vertex",
            quad,
            instances(&[F::Float32x2, F::Unorm8x4]),
            FIELD_FORMAT,
            Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING),
        ),
        liquid: maker.make("liquid", "screen_vertex", screen, vec![], format, alpha),
        rock: maker.make("rock", "rock_vertex", quad, instances(&[F::Uint16x2, F::Uint8x4]), format, alpha),
        streaks: maker.make("streak", "streak_vertex", quad, instances(&[F::Float32x4, F::Unorm8x4]), format, alpha),
    };
    pipelines.made = Some((format, ids));
}

struct Maker<'a> {
    cache: &'a PipelineCache,
    shader: &'a Handle<Shader>,
    layouts: &'a Layouts,
}

impl Maker<'_> {
    /// Queues the pipeline whose fragment shader is `{name}_fragment`.
    fn make(
        &self,
        name: &'static str,
        vertex: &'static str,
        topology: PrimitiveTopology,
        buffers: Vec<VertexBufferLayout>,
        format: TextureFormat,
        blend: Option<BlendState>,
    ) -> CachedRenderPipelineId {
        // The pass that draws into the field must not have the field bound.
        let mut layout = vec![self.layouts.world.clone()];
        if name != "particle" {
            layout.push(self.layouts.textures.clone());
        }
        self.cache.queue_render_pipeline(RenderPipelineDescriptor {
            label: Some(name.into()),
            layout,
            vertex: VertexState {
                shader: self.shader.clone(),
                shader_defs: vec![],
                entry_point: Some(vertex.into()),
                buffers,
            },
            primitive: PrimitiveState { topology, ..PrimitiveState::default() },
            fragment: Some(FragmentState {
                shader: self.shader.clone(),
                shader_defs: vec![],
                entry_point: Some(format!("{name}_fragment").into()),
                targets: vec![Some(ColorTargetState { format, blend, write_mask: ColorWrites::ALL })],
            }),
            ..RenderPipelineDescriptor::default()
        })
    }
}

fn make_layouts() -> Layouts {
    let texture = || texture_2d(TextureSampleType::Float { filterable: true });
    Layouts {
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
    }
}
