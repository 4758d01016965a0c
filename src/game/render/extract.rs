//! What a frame needs of the world, copied out once a frame into memory that is used again.

use crate::{
    game::{
        camera::{Area, WorldCamera},
        orders::Shown,
        render::{
            RenderCost, air,
            blobs::{self, ColourBy, ColourTable},
            stone,
            wisps::Wisps,
        },
    },
    kernel::units::TICK_SECONDS,
    sim::{
        difference::{self, Difference, Half},
        generation::Generation,
        pace::Pace,
        split::Split,
        stages::TickPlan,
        state::{AirGrid, Clock, ParticleStore, PredictorState, Rock, Setup, SolverState},
        view::{self, BurialMap, DepthMap, Limited, Reference, Rgb, StrainMap, View},
    },
};
use bevy::platform::time::Instant;
use bevy::{
    math::URect,
    prelude::{Fixed, Query, Res, ResMut, Resource, Time, With, World},
    render::{
        Extract,
        render_resource::{BufferUsages, RawBufferVec, ShaderType},
    },
    window::{PrimaryWindow, Window},
};
use glam::{UVec2, Vec2, Vec4};
use std::sync::atomic::Ordering;

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

/// One frame's pictures, on the processor's side: the world's, and in an A/B split the second world's and the
/// difference's.
#[derive(Resource, Default)]
pub struct Pictures {
    panes: [Picture; 3],
    count: usize,
    difference: Difference,
}

impl Pictures {
    /// The pictures of this frame.
    pub fn shown(&self) -> &[Picture] {
        &self.panes[..self.count]
    }

    /// The same, to hand them over.
    pub fn shown_mut(&mut self) -> &mut [Picture] {
        &mut self.panes[..self.count]
    }
}

/// A picture of a world.
pub struct Picture {
    /// Size of the window, physical pixels.
    pub window: UVec2,
    /// Physical pixels of one d.
    pub pixels_per_d: f32,
    /// The part of the window that it is confined to, physical pixels; the whole if there is none.
    pub part: Option<URect>,
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
    /// Where limiters act; of the last time that the view showed it.
    strain: StrainMap,
    table: ColourTable,
    table_of: Option<(View, u64)>,
    stones_of: Option<(Generation, u64)>,
}

impl Default for Picture {
    fn default() -> Self {
        Self {
            window: UVec2::ONE,
            pixels_per_d: 1.0,
            part: None,
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
            strain: StrainMap::default(),
            table: ColourTable::default(),
            table_of: None,
            stones_of: None,
        }
    }
}

/// Where and how everything is seen.
#[derive(Clone, Copy)]
struct Sight<'a> {
    window: &'a Window,
    camera: &'a WorldCamera,
    view: View,
    /// The moment that is drawn, s before the last tick.
    back: f32,
}

/// A world, and what is drawn into it.
#[derive(Clone, Copy)]
struct Scene<'a> {
    generation: Generation,
    setup: &'a Setup,
    particles: &'a ParticleStore,
    rock: &'a Rock,
    air: &'a AirGrid,
    solver: Option<&'a SolverState>,
    /// What the limiters work on.
    limited: Limited<'a>,
    wisps: Option<&'a Wisps>,
}

impl<'a> Scene<'a> {
    /// What is compared with another world.
    fn half(self) -> Half<'a> {
        Half { particles: self.particles, air: self.air }
    }

    /// What there is of the second world of a split.
    fn of(world: &'a World) -> Option<Self> {
        Some(Self {
            generation: *world.get_resource()?,
            setup: world.get_resource()?,
            particles: world.get_resource()?,
            rock: world.get_resource()?,
            air: world.get_resource()?,
            solver: world.get_resource(),
            limited: Limited::of(world)?,
            wisps: None,
        })
    }
}

/// What the last tick left besides the world: the predictor's grid, the tick's plan and its number.
type LastTick<'w, 's> = (
    Extract<'w, 's, Option<Res<'static, PredictorState>>>,
    Extract<'w, 's, Option<Res<'static, TickPlan>>>,
    Extract<'w, 's, Option<Res<'static, Clock>>>,
);

/// Copies the worlds out.
#[expect(clippy::too_many_arguments, reason = "a system's parameters are its data flow")]
pub fn extract(
    mut pictures: ResMut<Pictures>,
    cost: Res<RenderCost>,
    windows: Extract<Query<&Window, With<PrimaryWindow>>>,
    camera: Extract<Res<WorldCamera>>,
    shown: Extract<Res<Shown>>,
    generation: Extract<Res<Generation>>,
    setup: Extract<Option<Res<Setup>>>,
    particles: Extract<Option<Res<ParticleStore>>>,
    rock: Extract<Option<Res<Rock>>>,
    air: Extract<Option<Res<AirGrid>>>,
    solver: Extract<Option<Res<SolverState>>>,
    (predictor, plan, clock): LastTick<'_, '_>,
    wisps: Extract<Res<Wisps>>,
    split: Extract<Res<Split>>,
    pace: Extract<Res<Pace>>,
    time: Extract<Res<Time<Fixed>>>,
) {
    let begin = Instant::now();
    pictures.count = 0;
    let (Some(setup), Some(particles), Some(rock), Some(air), Ok(window)) =
        (&*setup, &*particles, &*rock, &*air, windows.single())
    else {
        return;
    };
    if window.resolution.physical_size().min_element() == 0 {
        return;
    }
    // Half a tick after a tick the world is drawn half a tick before it: it then moves evenly at any frame rate.
    let back = if pace.paused { 0.0 } else { TICK_SECONDS * (1.0 - time.overstep_fraction().clamp(0.0, 1.0)) };
    let sight = Sight { window, camera: &camera, view: shown.0, back };
    let solver = solver.as_deref();
    let limited = Limited {
        particles,
        solver: solver.map(|solver| &solver.0),
        predictor: predictor.as_deref().map(|predictor| &predictor.0),
        air,
        quality: &setup.quality,
        dt: plan.as_deref().map_or(TICK_SECONDS, TickPlan::substep_seconds),
        tick: clock.as_deref().map_or(0, |clock| clock.tick),
    };
    let first = Scene { generation: **generation, setup, particles, rock, air, solver, limited, wisps: Some(&**wisps) };
    let Pictures { panes: [a, b, c], count, difference } = &mut *pictures;
    let areas: Vec<Area> = camera.panes().collect();
    match (split.world().and_then(Scene::of), areas.as_slice()) {
        (Some(second), &[at_a, at_b, at_c]) => {
            a.fill(Scene { wisps: None, ..first }, sight, at_a, true);
            b.fill(second, sight, at_b, true);
            difference.measure(&setup.blueprint, first.half(), second.half());
            c.fill_with_difference(difference, first, sight, at_c);
            *count = 3;
        }
        _ => {
            a.fill(first, sight, camera.free(), false);
            *count = 1;
        }
    }
    cost.extract.store(begin.elapsed().as_micros() as u32, Ordering::Relaxed);
}

impl Picture {
    /// Draws a world into `area`, and into nothing else if it is `confined`.
    fn fill(&mut self, scene: Scene<'_>, sight: Sight<'_>, area: Area, confined: bool) {
        let (view, blueprint) = (sight.view, &scene.setup.blueprint);
        let reference = Reference::of(&blueprint.domain, &blueprint.air);
        let table_of = Some((view, scene.generation.scene));
        if self.table_of != table_of {
            self.table.fill(view, &blueprint.elements);
            self.table_of = table_of;
        }
        if view == View::Stability {
            self.strain.measure(blueprint.domain.size, scene.limited);
        }
        let by = match (view, scene.solver) {
            (View::Stability, _) => ColourBy::Strain { share: self.strain.shares() },
            (View::Density, Some(solver)) => {
                ColourBy::Density { density: &solver.density, rest: blueprint.fluid.rest_density }
            }
            _ => ColourBy::Speed,
        };
        blobs::pack(scene.particles, &self.table, reference, by, sight.back, self.blobs.values_mut());
        self.fill_stones(scene);
        self.depth_new = view == View::Elements;
        if self.depth_new {
            self.depth.measure(blueprint.domain.size, scene.particles);
        }
        self.fill_air(scene, sight, reference);
        let air = scene.air;
        let air_extent = match view {
            View::Stability => self.strain.extent(),
            _ => Vec2::new(air.columns() as f32, air.rows() as f32) * air.cell(),
        };
        self.look(scene.setup, sight, view, air_extent);
        self.place(sight, area, confined);
    }

    /// Draws how far two worlds are apart, over the rock of one of them.
    fn fill_with_difference(&mut self, difference: &Difference, scene: Scene<'_>, sight: Sight<'_>, area: Area) {
        self.blobs.clear();
        self.streaks.clear();
        self.fill_stones(scene);
        self.depth_new = false;
        difference.texels(&mut self.air.0);
        self.air.1 = UVec2::new(difference.columns() as u32, difference.rows() as u32);
        self.look(scene.setup, sight, View::Pressure, self.air.1.as_vec2() * difference::CELL);
        self.place(sight, area, true);
    }

    fn fill_stones(&mut self, scene: Scene<'_>) {
        let (rock, elements) = (scene.rock, scene.setup.elements());
        let stones_of = Some((scene.generation, rock.version()));
        self.stones_new = self.stones_of != stones_of;
        if self.stones_new {
            stone::pack(rock, elements, &mut self.burial, self.stones.values_mut());
            self.stones_of = stones_of;
        }
    }

    fn fill_air(&mut self, scene: Scene<'_>, sight: Sight<'_>, reference: Reference) {
        let (view, air) = (sight.view, scene.air);
        self.air.0.clear();
        self.streaks.clear();
        self.streaks_on_top = view.shows_air();
        if view.shows_air() {
            air::pack(air, view, reference, &mut self.air.0);
            self.air.1 = UVec2::new(air.columns() as u32, air.rows() as u32);
        }
        match view {
            View::Wind => {
                let spacing = ARROW_SPACING / sight.camera.pixels_per_d();
                let size = scene.setup.blueprint.domain.size;
                air::arrows(air, size, spacing, reference, self.streaks.values_mut());
            }
            View::Elements => {
                if let Some(wisps) = scene.wisps {
                    wisps.pack(reference, self.streaks.values_mut());
                }
            }
            View::Stability => {
                self.strain.texels(&mut self.air.0);
                let (columns, rows) = self.strain.dimensions();
                self.air.1 = UVec2::new(columns as u32, rows as u32);
            }
            View::Speed | View::Density | View::Pressure => {}
        }
    }

    /// The shader's numbers but for where in the window it is.
    fn look(&mut self, setup: &Setup, sight: Sight<'_>, view: View, air_extent: Vec2) {
        let scale_factor = sight.window.resolution.scale_factor();
        self.window = sight.window.resolution.physical_size();
        self.pixels_per_d = sight.camera.pixels_per_d() * scale_factor;
        // Lines that suit a window of this height.
        let lines = (self.window.y as f32 / 900.0).max(scale_factor).max(1.0);
        let flag = |on: bool| if on { 1.0 } else { 0.0 };
        self.uniform = WorldUniform {
            to_clip: Vec4::ZERO,
            size: two(setup.blueprint.domain.size, self.window.as_vec2()),
            extent: two(self.depth.extent().max(Vec2::ONE), air_extent),
            look: Vec4::new(
                self.pixels_per_d,
                if view.shows_air() { 0.42 } else { 0.97 },
                flag(view == View::Elements),
                view::DEPTH_SHADE,
            ),
            pen: Vec4::new(BLOB_RADIUS, 1.5 * lines, flag(view.shows_air() || view == View::Stability), lines),
            surroundings: srgb(view::SURROUNDINGS),
            box_top: srgb(view::BOX_TOP),
            box_bottom: srgb(view::BOX_BOTTOM),
            frame: srgb(view::FRAME),
            abyss: srgb(view::ABYSS),
        };
    }

    fn place(&mut self, sight: Sight<'_>, area: Area, confined: bool) {
        let (to_clip, offset) = sight.camera.clip_transform(area);
        self.uniform.to_clip = two(to_clip, offset);
        let scale_factor = sight.window.resolution.scale_factor();
        let corner = |pixel: Vec2| (pixel * scale_factor).round().max(Vec2::ZERO).as_uvec2().min(self.window);
        self.part = confined.then(|| URect::from_corners(corner(area.min), corner(area.max)));
    }
}

fn two(a: Vec2, b: Vec2) -> Vec4 {
    Vec4::new(a.x, a.y, b.x, b.y)
}

fn srgb(rgb: Rgb) -> Vec4 {
    let [r, g, b] = rgb.map(|channel| f32::from(channel) / 255.0);
    Vec4::new(r, g, b, 1.0)
}
