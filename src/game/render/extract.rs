//! What a frame needs of the world, copied out once a frame into memory that is used again.

use crate::{
    game::{
        camera::WorldCamera,
        orders::Shown,
        render::{
            RenderCost, air,
            blobs::{self, ColourBy, ColourTable},
            stone,
            wisps::Wisps,
        },
    },
    kernel::units::TICK_SECONDS,
    scene::blueprint::Blueprint,
    sim::{
        pace::Pace,
        state::{AirGrid, ParticleStore, Rock, Setup, SolverState},
        view::{self, BurialMap, DepthMap, Reference, Rgb, View},
    },
};
use bevy::platform::time::Instant;
use bevy::{
    prelude::{Fixed, Query, Res, ResMut, Resource, Time, With},
    render::{
        Extract,
        render_resource::{BufferUsages, RawBufferVec, ShaderType},
    },
    window::{PrimaryWindow, Window},
};
use glam::{UVec2, Vec2, Vec4};
use std::sync::{Arc, atomic::Ordering};

/// Radius of a particle's soft disc, d.
const BLOB_RADIUS: f32 = 1.35;
/// Spacing of the arrows, logical pixels.
const ARROW_SPACING: f32 = 30.0;

/// What the shader knows of the world as a whole; the fields are explained there.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub struct WorldUniform {
    to_clip: Vec4,
    size: Vec4,
    extent: Vec4,
    look: Vec4,
    pen: Vec4,
    surroundings: Vec4,
    box_top: Vec4,
    box_bottom: Vec4,
    frame: Vec4,
    abyss: Vec4,
}

/// One frame's picture, on the processor's side.
#[derive(Resource)]
pub struct Picture {
    /// Whether there is a world to draw.
    pub ready: bool,
    /// Size of the window, physical pixels.
    pub window: UVec2,
    /// Physical pixels of one d.
    pub pixels_per_d: f32,
    /// The shader's numbers.
    pub uniform: WorldUniform,
    /// Movable particles.
    pub blobs: RawBufferVec<blobs::Blob>,
    /// Rock.
    pub stones: RawBufferVec<stone::Stone>,
    /// Whether `stones` is new in this frame.
    pub stones_new: bool,
    /// Streaks of wind.
    pub streaks: RawBufferVec<air::Streak>,
    /// Whether they lie over the liquid.
    pub streaks_on_top: bool,
    /// Texels of the air, and their columns and rows; empty if the view doesn't show it.
    pub air: (Vec<u8>, UVec2),
    /// Depth of the liquid; empty if the view doesn't show it.
    pub depth: DepthMap,
    /// Whether `depth` is of this frame.
    pub depth_new: bool,
    burial: BurialMap,
    table: ColourTable,
    table_of: Option<(View, Arc<Blueprint>)>,
    stones_of: Option<(u64, Arc<Blueprint>, u32)>,
}

impl Default for Picture {
    fn default() -> Self {
        Self {
            ready: false,
            window: UVec2::ONE,
            pixels_per_d: 1.0,
            uniform: WorldUniform::default(),
            blobs: RawBufferVec::new(BufferUsages::VERTEX),
            stones: RawBufferVec::new(BufferUsages::VERTEX),
            stones_new: false,
            streaks: RawBufferVec::new(BufferUsages::VERTEX),
            streaks_on_top: false,
            air: (Vec::new(), UVec2::ONE),
            depth: DepthMap::default(),
            depth_new: false,
            burial: BurialMap::default(),
            table: ColourTable::default(),
            table_of: None,
            stones_of: None,
        }
    }
}

/// Counts how often the world's state was replaced as a whole: then nothing derived from the old one is valid.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Epoch(pub u32);

/// Copies the world out.
#[expect(clippy::too_many_arguments, reason = "a system's parameters are its data flow")]
pub fn extract(
    mut picture: ResMut<Picture>,
    cost: Res<RenderCost>,
    windows: Extract<Query<&Window, With<PrimaryWindow>>>,
    camera: Extract<Res<WorldCamera>>,
    shown: Extract<Res<Shown>>,
    epoch: Extract<Res<Epoch>>,
    setup: Extract<Option<Res<Setup>>>,
    particles: Extract<Option<Res<ParticleStore>>>,
    rock: Extract<Option<Res<Rock>>>,
    air: Extract<Option<Res<AirGrid>>>,
    solver: Extract<Option<Res<SolverState>>>,
    wisps: Extract<Res<Wisps>>,
    pace: Extract<Res<Pace>>,
    time: Extract<Res<Time<Fixed>>>,
) {
    let begin = Instant::now();
    let picture = &mut *picture;
    let (Some(setup), Some(particles), Some(rock), Some(air), Ok(window)) =
        (&*setup, &*particles, &*rock, &*air, windows.single())
    else {
        picture.ready = false;
        return;
    };
    picture.window = window.resolution.physical_size();
    picture.ready = picture.window.min_element() > 0;
    if !picture.ready {
        return;
    }
    let (view, blueprint) = (shown.0, &setup.blueprint);
    let reference = Reference::of(&blueprint.domain, &blueprint.air);

    if picture.table_of.as_ref().is_none_or(|(old, of)| *old != view || !Arc::ptr_eq(of, blueprint)) {
        picture.table.fill(view, &blueprint.elements);
        picture.table_of = Some((view, blueprint.clone()));
    }
    // Half a tick after a tick the world is drawn half a tick before it: it then moves evenly at any frame rate.
    let back = if pace.paused { 0.0 } else { TICK_SECONDS * (1.0 - time.overstep_fraction().clamp(0.0, 1.0)) };
    let by = match (view, &*solver) {
        (View::Density, Some(solver)) => {
            ColourBy::Density { density: &solver.density, rest: blueprint.fluid.rest_density }
        }
        _ => ColourBy::Speed,
    };
    blobs::pack(particles, &picture.table, reference, by, back, picture.blobs.values_mut());

    picture.stones_new = picture.stones_of.as_ref().is_none_or(|(version, of, during)| {
        *version != rock.version() || !Arc::ptr_eq(of, blueprint) || *during != epoch.0
    });
    if picture.stones_new {
        stone::pack(rock, &blueprint.elements, &mut picture.burial, picture.stones.values_mut());
        picture.stones_of = Some((rock.version(), blueprint.clone(), epoch.0));
    }

    picture.depth_new = view == View::Elements;
    if picture.depth_new {
        picture.depth.measure(blueprint.domain.size, particles);
    }

    picture.air.0.clear();
    picture.streaks.clear();
    picture.streaks_on_top = view.shows_air();
    if view.shows_air() {
        air::pack(air, view, reference, &mut picture.air.0);
        picture.air.1 = UVec2::new(air.columns() as u32, air.rows() as u32);
    }
    let size = blueprint.domain.size;
    match view {
        View::Wind => {
            let spacing = ARROW_SPACING / camera.pixels_per_d();
            air::arrows(air, size, spacing, reference, picture.streaks.values_mut());
        }
        View::Elements => wisps.pack(reference, picture.streaks.values_mut()),
        View::Speed | View::Density | View::Pressure => {}
    }

    let scale_factor = window.resolution.scale_factor();
    picture.pixels_per_d = camera.pixels_per_d() * scale_factor;
    let (to_clip, offset) = camera.clip_transform();
    let air_extent = Vec2::new(air.columns() as f32, air.rows() as f32) * air.cell();
    // Lines that suit a window of this height.
    let lines = (picture.window.y as f32 / 900.0).max(scale_factor).max(1.0);
    let flag = |on: bool| if on { 1.0 } else { 0.0 };
    picture.uniform = WorldUniform {
        to_clip: two(to_clip, offset),
        size: two(size, picture.window.as_vec2()),
        extent: two(picture.depth.extent().max(Vec2::ONE), air_extent),
        look: Vec4::new(
            picture.pixels_per_d,
            if view.shows_air() { 0.42 } else { 0.97 },
            flag(view == View::Elements),
            view::DEPTH_SHADE,
        ),
        pen: Vec4::new(BLOB_RADIUS, 1.5 * lines, flag(view.shows_air()), lines),
        surroundings: srgb(view::SURROUNDINGS),
        box_top: srgb(view::BOX_TOP),
        box_bottom: srgb(view::BOX_BOTTOM),
        frame: srgb(view::FRAME),
        abyss: srgb(view::ABYSS),
    };
    cost.extract.store(begin.elapsed().as_micros() as u32, Ordering::Relaxed);
}

fn two(a: Vec2, b: Vec2) -> Vec4 {
    Vec4::new(a.x, a.y, b.x, b.y)
}

fn srgb(rgb: Rgb) -> Vec4 {
    let [r, g, b] = rgb.map(|channel| f32::from(channel) / 255.0);
    Vec4::new(r, g, b, 1.0)
}
