//! The air at any point: what particles feel.

use super::{
    grid::Air,
    stencils::{LANES, Stencils},
};
use glam::Vec2;

impl Air {
    /// Velocity at a point (d), d/s: bilinear between cell centres, and that of the nearest centre line beyond the
    /// outermost centres. Rock counts as air at rest.
    pub fn sample_velocity(&self, p: Vec2) -> Vec2 {
        let (mut u, mut v) = ([0.0], [0.0]);
        self.sample_velocities(&[p.x], &[p.y], &mut u, &mut v);
        Vec2::new(u[0], v[0])
    }

    /// [`Air::sample_velocity`] at many points, with the same bits.
    #[inline(always)]
    pub fn sample_velocities(&self, x: &[f32], y: &[f32], out_u: &mut [f32], out_v: &mut [f32]) {
        debug_assert!(x.len() == y.len() && x.len() == out_u.len() && x.len() == out_v.len());
        if !self.is_built() {
            out_u.fill(0.0);
            out_v.fill(0.0);
            return;
        }
        let places = x.chunks(LANES).zip(y.chunks(LANES));
        for ((x, y), (out_u, out_v)) in places.zip(out_u.chunks_mut(LANES).zip(out_v.chunks_mut(LANES))) {
            let [u, v] = self.velocities_around(x, y);
            out_u.copy_from_slice(&u[..x.len()]);
            out_v.copy_from_slice(&v[..x.len()]);
        }
    }
    /// The same at up to [`LANES`] points, and 0 for the others. The air must be built.
    #[inline(always)]
    pub(super) fn velocities_around(&self, x: &[f32], y: &[f32]) -> [[f32; LANES]; 2] {
        Stencils::new(self, x, y).blend(x.len(), |k| {
            let (u, v) = (&self.velocity_x[k..k + 2], &self.velocity_y[k..k + 2]);
            [[u[0], v[0]], [u[1], v[1]]]
        })
    }
}
