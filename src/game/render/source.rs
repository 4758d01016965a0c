//! What a picture of matter is packed of, copied out of the world so that it may go on meanwhile.

use crate::{
    game::render::{
        glow::{self, GlowingRock, Warmth},
        look::Looks,
        scene::Scene,
    },
    kernel::{heat::table::HeatTable, particles::Particles, solids::Solids},
    scene::blueprint::Blueprint,
    sim::generation::Generation,
};
use std::sync::Arc;

/// The copy.
pub struct Source {
    /// The world, and its tick.
    pub of: (Generation, u64),
    /// Ticks since the frame before; none if that showed another world, or none at all.
    pub ticks: Option<u64>,
    /// What the world began with, at the detail in force.
    pub blueprint: Arc<Blueprint>,
    /// Looks of its elements.
    pub looks: Looks,
    curves: HeatTable,
    /// Movable particles.
    pub particles: Particles,
    /// Rock; its heat may be that of an earlier tick.
    pub rock: Solids,
    glowing: Vec<GlowingRock>,
    /// The moment that is drawn, s before the last tick.
    pub back: f32,
    /// Whether grains are large enough to be drawn one by one.
    pub fine: bool,
}

impl Source {
    /// Copies a world, into the memory of what was copied `before` where that is of the same one.
    pub(super) fn take(before: Option<Self>, scene: Scene<'_>, back: f32, fine: bool) -> Self {
        let spacing = |blueprint: &Blueprint| blueprint.scale.spacing;
        let is_same = |before: &Self| {
            before.of.0 == scene.generation && spacing(&before.blueprint) == spacing(&scene.setup.blueprint)
        };
        let mut source = match before.filter(is_same) {
            Some(before) => Self { ticks: Some(scene.tick.saturating_sub(before.of.1)), ..before },
            None => Self::begin(scene),
        };
        (source.of.1, source.back, source.fine) = (scene.tick, back, fine);
        source.particles.clone_from(scene.particles);
        if source.rock.version() != scene.rock.version() {
            source.rock.clone_from(scene.rock);
        }
        glow::find_glowing(scene.rock, &source.curves, &source.looks, &mut source.glowing);
        source
    }

    fn begin(scene: Scene<'_>) -> Self {
        let curves = scene.curves.0.clone();
        Self {
            of: (scene.generation, scene.tick),
            ticks: None,
            blueprint: Arc::clone(&scene.setup.blueprint),
            looks: Looks::new(scene.setup.elements(), &curves),
            curves,
            particles: Particles::default(),
            rock: scene.rock.0.clone(),
            glowing: Vec::new(),
            back: 0.0,
            fine: false,
        }
    }

    /// How warm its matter is.
    pub fn warmth(&self) -> Warmth<'_> {
        Warmth { particles: &self.particles, rock: &self.glowing, curves: &self.curves, looks: &self.looks }
    }
}
