//! What a frame needs of a world, packed into memory that is used again.

use crate::{
    game::{
        camera::Area,
        render::{
            air::{self, Streak},
            body::BodyMap,
            features::Features,
            glow::GlowMap,
            level::Level,
            look::Finish,
            matter::{Instance, Matter, Sample},
            moved::Moved,
            particles::{self, ColourTable},
            rock::RockMap,
            scene::{Scene, Sight, Within},
            source::Source,
            tiles::{PictureTiles, TILE},
            uniform::{WorldUniform, srgb, two},
        },
        views::{
            strain::StrainMap,
            table::{Layer, PRESSURE, Quantity, Streaks, View, density_share, temperature_share},
        },
    },
    kernel::{
        element::{ElementId, ElementTable},
        heat::Exposure,
        solids::Solids,
    },
    lab::{
        colours::{self, Reference, Rgb, rock_colour},
        difference::Difference,
        maps::DepthMap,
    },
    sim::{generation::Generation, state::Setup},
};
use bevy::math::URect;
use glam::{IVec2, UVec2, Vec2, Vec4, Vec4Swizzles};

/// Radius of a particle's soft disc, d.
const DISC_RADIUS: f32 = 1.35;
/// Radius of a lump of gas, d.
const GAS_RADIUS: f32 = 4.2;
/// Grains are drawn one by one from this size on, physical pixels of a d.
const FINE: f32 = 2.5;
/// Spacing of the arrows, logical pixels.
const ARROW_SPACING: f32 = 30.0;

/// A picture of a world.
pub struct Picture {
    /// Its size, pixels: those of the window, or fewer.
    pub size: UVec2,
    /// Its pixels of one d.
    pub pixels_per_d: f32,
    /// How much of it is drawn.
    pub level: Level,
    /// The part that it is confined to, its pixels; the whole if there is none.
    pub part: Option<URect>,
    /// Whether it is seen in a ring over the one before it.
    pub is_lens: bool,
    /// The shader's numbers.
    pub uniform: WorldUniform,
    /// What it has that not all pictures have.
    pub features: Features,
    /// Movable particles, in the views that colour them one by one.
    pub particles: Vec<Instance>,
    /// Matter, in the view that shows it as it is.
    pub matter: Matter,
    /// Tiles with bodies of matter, with gases, with rock.
    pub tiles: PictureTiles,
    /// Rock, a texel a cell.
    pub rock: RockMap,
    /// Whether all that is baked of the rock is another: it is itself, or where the camera looks.
    pub bake: bool,
    /// Streaks of wind.
    pub streaks: Vec<Streak>,
    /// Whether they lie over the liquid.
    pub streaks_on_top: bool,
    /// Texels of the air, and their columns and rows; empty if the view doesn't show it.
    pub air: (Vec<u8>, UVec2),
    /// Depth of the matter; of the last time that the view showed it.
    pub depth: DepthMap,
    /// How full places are.
    pub body: BodyMap,
    /// What glows, and what it lights.
    pub glow: GlowMap,
    /// Whether matter is shown as it is, so that `depth`, `body` and `glow` are of this frame.
    pub as_it_is: bool,
    source: Option<Source>,
    moved: Moved,
    /// Where limiters act; of the last time that the view showed it.
    strain: StrainMap,
    /// What stands in the air; of the last time that the view showed what burns.
    exposure: Exposure,
    table: ColourTable,
    table_of: Option<(&'static View, Generation)>,
    /// What the particles are coloured by.
    shares: Vec<f32>,
}

impl Default for Picture {
    fn default() -> Self {
        Self {
            size: UVec2::ONE,
            pixels_per_d: 1.0,
            level: Level::Full,
            part: None,
            is_lens: false,
            uniform: WorldUniform::default(),
            features: Features::default(),
            particles: Vec::new(),
            matter: Matter::default(),
            tiles: PictureTiles::default(),
            rock: RockMap::default(),
            bake: false,
            streaks: Vec::new(),
            streaks_on_top: false,
            air: (Vec::new(), UVec2::ONE),
            depth: DepthMap::default(),
            body: BodyMap::default(),
            glow: GlowMap::default(),
            as_it_is: false,
            source: None,
            moved: Moved::default(),
            strain: StrainMap::default(),
            exposure: Exposure::default(),
            table: ColourTable::default(),
            table_of: None,
            shares: Vec::new(),
        }
    }
}

/// Colours and finishes of rock in the colours of its elements, by its cell, element, id and how deep it is buried.
fn own_colours(elements: &ElementTable) -> impl Fn(IVec2, ElementId, u32, f32) -> (Rgb, Finish) {
    |cell, element, id, burial| {
        let element = elements.get(element);
        (rock_colour(element, cell, id, burial), Finish::of(element))
    }
}

impl Picture {
    /// Copies out of a world what it takes to draw it so that `area` shows it; [`Self::pack`] is to follow.
    pub(super) fn fill(&mut self, scene: Scene<'_>, sight: Sight<'_>, area: Area, within: Within) {
        let blueprint = &scene.setup.blueprint;
        let reference = Reference::of(&blueprint.domain, &blueprint.air);
        self.as_it_is = sight.view.shaded;
        if self.as_it_is {
            self.particles.clear();
            let fine = sight.camera.pixels_per_d() * sight.scale() >= FINE;
            self.source = Some(Source::take(self.source.take(), scene, sight.back, fine));
        } else {
            self.matter.clear();
            self.moved.follow((scene.generation, scene.tick), scene.particles);
            self.fill_particles(scene, sight, reference);
            self.fill_rock(scene, sight.view);
        }
        let air_extent = self.fill_air(scene, sight, reference);
        self.fill_streaks(scene, sight, reference);
        self.look(scene.setup, sight, sight.view, air_extent, (area, within));
    }

    /// The same for how far two worlds are apart, over the rock of one of them.
    pub(super) fn fill_with_difference(
        &mut self,
        difference: &Difference,
        scene: Scene<'_>,
        sight: Sight<'_>,
        area: Area,
    ) {
        self.particles.clear();
        self.matter.clear();
        self.streaks.clear();
        self.fill_rock(scene, &PRESSURE);
        self.as_it_is = false;
        difference.texels(&mut self.air.0);
        self.air.1 = UVec2::new(difference.columns() as u32, difference.rows() as u32);
        self.look(scene.setup, sight, &PRESSURE, self.air.1.as_vec2() * difference.edge(), (area, Within::Area));
    }

    /// Makes of what was copied what the graphics read. The world is not needed any more.
    pub(super) fn pack(&mut self) {
        let size = self.uniform.size.xy();
        if self.as_it_is {
            self.pack_source(size);
        } else {
            self.matter.mark(size, &self.particles, DISC_RADIUS);
        }
        if !self.rock.rows.is_empty() {
            self.rock.tiles.list(&mut self.tiles.rock);
            self.rock.changed.list(&mut self.tiles.changed);
        }
        self.bake |= self.rock.is_new;
        self.matter.body_tiles.list(&mut self.tiles.bodies);
        self.matter.gas_tiles.list(&mut self.tiles.gases);
        self.uniform.liquids = std::array::from_fn(|channel| Vec4::from(self.matter.liquid(channel)));
        self.uniform.extent = two(self.depth.extent().max(Vec2::ONE), self.uniform.extent.zw());
        self.uniform.fine_extent = two(self.body.extent().max(Vec2::ONE), self.glow.light_extent().max(Vec2::ONE));
        self.features = Features::of([
            (Features::AIR, !self.air.0.is_empty()),
            (Features::GLOW, self.as_it_is && self.glow.shines()),
            (Features::RICH, self.level.is_rich()),
            (Features::MORE, !self.matter.more.is_empty()),
        ]);
    }

    /// Matter as it is, with what it takes to shade it.
    fn pack_source(&mut self, size: Vec2) {
        let Self { source: Some(source), moved, body, glow, matter, depth, rock, .. } = self else { return };
        let Source { of, ticks, blueprint, looks, particles, back, fine, .. } = &*source;
        let spacing = blueprint.scale.spacing;
        rock.follow(&source.rock, (of.0, spacing), own_colours(&blueprint.elements));
        moved.follow(*of, particles);
        body.follow_rock(size, &source.rock, ticks.is_none());
        body.measure(spacing, particles, looks, ticks.unwrap_or_default());
        depth.measure(size, body.matter());
        let (warmth, radii, back, fine) = (source.warmth(), [DISC_RADIUS, GAS_RADIUS], *back, *fine);
        glow.measure(size, warmth, |cell| body.held(cell));
        matter.fill(Sample { particles, rock, looks, moved, body, warmth, size, radii, back, fine });
    }

    fn fill_particles(&mut self, scene: Scene<'_>, sight: Sight<'_>, reference: Reference) {
        let (view, blueprint) = (sight.view, &scene.setup.blueprint);
        let table_of = Some((view, scene.generation));
        if self.table_of != table_of {
            self.table.fill(view, &blueprint.elements);
            self.table_of = table_of;
        }
        let shares = match view.quantity {
            Quantity::Of(measure) => {
                measure(scene.particles, reference, &mut self.shares);
                &self.shares
            }
            Quantity::Density => {
                // Densities that do not fit the particles (edited while time stands) are left out.
                let count = scene.particles.len();
                let density = scene.solver.map(|solver| &solver.density).filter(|density| density.len() == count);
                let rest = blueprint.fluid.rest_density;
                self.shares.clear();
                self.shares.extend(density.into_iter().flatten().map(|density| density_share(density / rest - 1.0)));
                self.shares.resize(count, density_share(0.0));
                &self.shares
            }
            Quantity::Strain => {
                self.strain.measure(blueprint.domain.size, scene.limited);
                self.strain.shares()
            }
            Quantity::Temperature => {
                let (particles, curves) = (scene.particles, scene.curves);
                let kelvin = |i: usize| curves.curve(particles.element[i]).temperature(particles.heat_of(i));
                self.shares.clear();
                self.shares.extend((0..particles.len()).map(|i| temperature_share(kelvin(i))));
                &self.shares
            }
            Quantity::Fire => {
                self.exposure.gather(scene.particles, blueprint.domain.size);
                let burning = scene.burning(&self.exposure);
                self.shares.clear();
                self.shares.extend((0..scene.particles.len()).map(|i| burning.of_particle(i).share()));
                &self.shares
            }
        };
        let is_rock = |at| scene.rock.count() > 0 && scene.rock.is_solid(Solids::cell_of(at));
        let share = self.moved.share(sight.back);
        let at = |i| self.moved.at(scene.particles, is_rock, i, share);
        particles::pack(scene.particles, &self.table, shares, at, &mut self.particles);
    }

    fn fill_rock(&mut self, scene: Scene<'_>, view: &View) {
        let (rock, elements) = (scene.rock, scene.setup.elements());
        if matches!(view.quantity, Quantity::Temperature | Quantity::Fire) {
            // It warms and cools without a change of its version.
            let burning = scene.burning(&self.exposure);
            let share = |cell, element| match view.quantity {
                Quantity::Fire => burning.of_rock(cell, element).share(),
                _ => temperature_share(scene.curves.curve(element).temperature(rock.heat(cell))),
            };
            let texel = |cell, element| ((view.colour)(elements.get(element), share(cell, element)), Finish::Polished);
            self.rock.repaint(rock, texel);
        } else {
            self.rock.follow(rock, (scene.generation, scene.setup.blueprint.scale.spacing), own_colours(elements));
        }
    }

    /// Fills the texels of the air, and says what they cover, d.
    fn fill_air(&mut self, scene: Scene<'_>, sight: Sight<'_>, reference: Reference) -> Vec2 {
        let air = scene.air;
        self.air.0.clear();
        if matches!(sight.view.air, Layer::Strain) {
            self.strain.texels(&mut self.air.0);
            self.air.1 = self.strain.dimensions();
            return self.strain.extent();
        }
        match sight.view.air {
            Layer::Air(colour) => air::pack(air, colour, reference, &mut self.air.0),
            Layer::Warmth(colour) => air::pack_warmth(air, colour, &mut self.air.0),
            Layer::Nothing | Layer::Strain => {}
        }
        self.air.1 = UVec2::new(air.columns() as u32, air.rows() as u32);
        self.air.1.as_vec2() * air.cell()
    }

    fn fill_streaks(&mut self, scene: Scene<'_>, sight: Sight<'_>, reference: Reference) {
        self.streaks.clear();
        self.streaks_on_top = sight.view.shows_air();
        match sight.view.streaks {
            Streaks::None => {}
            Streaks::Tracers => {
                if let Some(tracers) = scene.tracers {
                    tracers.pack(reference, &mut self.streaks);
                }
            }
            Streaks::Arrows => {
                let spacing = ARROW_SPACING / sight.camera.pixels_per_d();
                let size = scene.setup.blueprint.domain.size;
                air::arrows(scene.air, size, spacing, reference, &mut self.streaks);
            }
        }
    }

    /// The shader's numbers, and the part of the window that is drawn into.
    fn look(&mut self, setup: &Setup, sight: Sight<'_>, view: &View, air_extent: Vec2, (area, within): (Area, Within)) {
        let scale = sight.scale();
        self.level = sight.level;
        let seen = (self.size, self.uniform.to_clip);
        self.size = sight.size();
        self.pixels_per_d = sight.camera.pixels_per_d() * scale;
        let corner = |pixel: Vec2| (pixel * scale).round().max(Vec2::ZERO).as_uvec2().min(self.size);
        let part = match within {
            Within::Window => None,
            Within::Area => Some(area),
            Within::Ring(ring) => Some(ring.area()),
        };
        self.part = part.map(|part| URect::from_corners(corner(part.min), corner(part.max)));
        let ring = if let Within::Ring(ring) = within { Some(ring) } else { None };
        self.is_lens = ring.is_some();
        // Lines that suit a window of this height.
        let lines = (self.size.y as f32 / 900.0).max(scale).max(sight.level.resolution());
        let (to_clip, offset) = sight.camera.clip_transform(area);
        let dim = if view.shows_air() { 0.42 } else { 0.97 };
        self.uniform = WorldUniform {
            to_clip: two(to_clip, offset),
            size: two(setup.blueprint.domain.size, self.size.as_vec2()),
            extent: two(Vec2::ONE, air_extent),
            look: Vec4::new(self.pixels_per_d, dim, f32::from(view.shaded), colours::DEPTH_SHADE),
            pen: Vec4::new(DISC_RADIUS, 1.5 * lines, 0.0, lines),
            parts: Vec4::new(GAS_RADIUS, TILE, 0.0, sight.time),
            lens: ring.map_or(Vec4::ZERO, |ring| two(ring.centre, Vec2::new(ring.radius, 0.0)) * scale),
            surroundings: srgb(colours::SURROUNDINGS),
            box_top: srgb(colours::BOX_TOP),
            box_bottom: srgb(colours::BOX_BOTTOM),
            frame: srgb(colours::FRAME),
            abyss: srgb(colours::ABYSS),
            ..self.uniform
        };
        self.bake = seen != (self.size, self.uniform.to_clip);
    }
}
