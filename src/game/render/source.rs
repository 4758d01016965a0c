//! What a world's matter is packed of, copied out of it so that the world may go on meanwhile.

use crate::{
    game::render::{
        glow::{self, GlowingRock, Warmth},
        look::Looks,
        scene::Scene,
    },
    kernel::{heat::table::HeatTable, particles::Particles},
    sim::generation::Generation,
};

/// The copy.
#[derive(Default)]
pub struct Source {
    /// Movable particles.
    pub particles: Particles,
    /// Looks of the elements.
    pub looks: Looks,
    curves: HeatTable,
    glowing: Vec<GlowingRock>,
    /// The world, and its tick.
    pub of: (Generation, u64),
    /// Ticks since the frame before; none if that showed another world, or none at all.
    pub ticks: Option<u64>,
    /// Metres of a d.
    pub spacing: f32,
    /// The moment that is drawn, s before the last tick.
    pub back: f32,
    /// Whether grains are large enough to be drawn one by one.
    pub fine: bool,
    is_begun: bool,
}

impl Source {
    /// Copies a world.
    pub(super) fn take(&mut self, scene: Scene<'_>, back: f32, fine: bool) {
        let (blueprint, of) = (&scene.setup.blueprint, (scene.generation, scene.tick));
        let is_known = self.is_begun && self.of.0 == scene.generation;
        self.ticks = is_known.then(|| scene.tick.saturating_sub(self.of.1));
        if !is_known {
            self.looks = Looks::new(&blueprint.elements, scene.curves);
            self.curves.clone_from(scene.curves);
        }
        self.particles.clone_from(scene.particles);
        glow::find_glowing(scene.rock, &self.curves, &self.looks, &mut self.glowing);
        (self.of, self.is_begun) = (of, true);
        (self.spacing, self.back, self.fine) = (blueprint.scale.spacing, back, fine);
    }

    /// How warm its matter is.
    pub fn warmth(&self) -> Warmth<'_> {
        Warmth { particles: &self.particles, rock: &self.glowing, curves: &self.curves, looks: &self.looks }
    }
}
