//! The tick, and the way between SI units and the kernel's own.

use glam::Vec2;

/// Ticks in a second of simulated time. Input, replay, hash and speed count in ticks; changing this changes every world.
pub const TICKS_PER_SECOND: u32 = 60;

/// Simulated time of one tick, s.
pub const TICK_SECONDS: f32 = 1.0 / TICKS_PER_SECOND as f32;

/// Density of the reference liquid (water), kg/m² of the plane. A particle of it has mass 1 in the kernel.
pub const REFERENCE_DENSITY: f32 = 1000.0;

/// Converts between SI units and the kernel's, in which the particle spacing is 1.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Scale {
    /// Particle spacing d of the run, m.
    pub spacing: f32,
    /// The scene's own spacing over the run's, 1/8 … 16: at 2 a particle stands for a quarter of the matter.
    pub detail: f32,
}

impl Scale {
    /// The scale of a scene at its own spacing, m.
    pub fn own(spacing: f32) -> Self {
        Self { spacing, detail: 1.0 }
    }

    /// The scene's own spacing, m.
    pub fn own_spacing(self) -> f32 {
        self.spacing * self.detail
    }

    /// Particles of the run in the area of one of the scene's own.
    pub fn particles_per_own(self) -> f32 {
        self.detail * self.detail
    }

    /// Metres (or m/s, m/s²) to spacings (d/s, d/s²).
    pub fn to_kernel(self, metres: f32) -> f32 {
        metres / self.spacing
    }

    /// Spacings (or d/s, d/s²) to metres (m/s, m/s²).
    pub fn to_metres(self, spacings: f32) -> f32 {
        spacings * self.spacing
    }

    /// [`Scale::to_kernel`] of both components.
    pub fn vec_to_kernel(self, metres: Vec2) -> Vec2 {
        metres / self.spacing
    }

    /// [`Scale::to_metres`] of both components.
    pub fn vec_to_metres(self, spacings: Vec2) -> Vec2 {
        spacings * self.spacing
    }

    /// Mass of a particle of the reference liquid, kg: `ρ₀ d²`.
    pub fn particle_mass(self) -> f32 {
        REFERENCE_DENSITY * self.spacing * self.spacing
    }
}
