//! Movable particles as instances: position between two ticks and colour.

use crate::{
    kernel::{element::ElementTable, particles::Particles},
    sim::view::{Reference, Sample, View, colour, density_error, density_share},
};

/// Colours of each element over the range of what is shown, precomputed.
const LEVELS: usize = 64;

/// Position (two f32) and colour (four bytes) of a particle.
pub type Blob = [u32; 3];

/// A table of colours: a row for each element.
#[derive(Clone, Debug, Default)]
pub struct ColourTable {
    colours: Vec<u32>,
}

impl ColourTable {
    /// The colours of a view: over speed, density error or the share of a limit.
    pub fn fill(&mut self, view: View, elements: &ElementTable) {
        self.colours.clear();
        for (_, element) in elements.iter() {
            self.colours.extend((0..LEVELS).map(|level| {
                let share = level as f32 / (LEVELS - 1) as f32;
                let sample = match view {
                    View::Density => Sample { density_error: density_error(share), ..Sample::default() },
                    View::Stability => Sample { strain: share, ..Sample::default() },
                    _ => Sample { speed: share, ..Sample::default() },
                };
                let [r, g, b] = colour(view, element, sample);
                u32::from_le_bytes([r, g, b, 255])
            }));
        }
    }

    fn at(&self, row: usize, share: f32) -> u32 {
        let level = ((share * LEVELS as f32) as usize).min(LEVELS - 1);
        self.colours.get(row * LEVELS + level).copied().unwrap_or(u32::MAX)
    }
}

/// What particles are coloured by.
#[derive(Clone, Copy, Debug)]
pub enum ColourBy<'a> {
    /// Speed.
    Speed,
    /// Density over rest density, one for each particle.
    Density {
        /// ρ of each particle, in the order of the particles.
        density: &'a [f32],
        /// ρ₀ in the same unit.
        rest: f32,
    },
    /// Share of the nearest limit, one for each particle.
    Strain {
        /// The shares, in the order of the particles.
        share: &'a [f32],
    },
}

/// Packs all particles as they stood `back` seconds ago (straight back along their velocities). Densities that do not
/// fit the particles (edited while time stands) are left out.
pub fn pack(
    particles: &Particles,
    table: &ColourTable,
    reference: Reference,
    by: ColourBy<'_>,
    back: f32,
    out: &mut Vec<Blob>,
) {
    let count = particles.len();
    out.resize(count, Blob::default());
    let (x, y) = (&particles.x[..count], &particles.y[..count]);
    let (vx, vy, element) = (&particles.vx[..count], &particles.vy[..count], &particles.element[..count]);
    let scale = 1.0 / reference.fall;
    for (i, blob) in out.iter_mut().enumerate() {
        let share = match by {
            ColourBy::Density { density, rest } => density
                .get(i)
                .filter(|_| density.len() == count)
                .map_or(0.5, |density| density_share(density / rest - 1.0)),
            ColourBy::Strain { share } => share.get(i).copied().unwrap_or(0.0),
            ColourBy::Speed => (vx[i] * vx[i] + vy[i] * vy[i]).sqrt() * scale,
        };
        *blob = [(x[i] - vx[i] * back).to_bits(), (y[i] - vy[i] * back).to_bits(), table.at(element[i].index(), share)];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::element::{Element, ElementId};
    use glam::Vec2;

    fn elements() -> ElementTable {
        ElementTable::new(vec![Element::plain("water", false)])
    }

    fn packed(view: View, velocity: Vec2, by: ColourBy<'_>) -> Blob {
        let mut particles = Particles::default();
        particles.push(0, ElementId(0), Vec2::new(10.0, 20.0), velocity);
        let mut table = ColourTable::default();
        table.fill(view, &elements());
        let mut out = Vec::new();
        pack(&particles, &table, Reference { fall: 100.0, wind: 1.0 }, by, 0.01, &mut out);
        out[0]
    }

    #[test]
    fn a_blob_stands_where_the_particle_was_a_moment_ago() {
        let blob = packed(View::Elements, Vec2::new(50.0, -100.0), ColourBy::Speed);
        assert_eq!(f32::from_bits(blob[0]), 9.5);
        assert_eq!(f32::from_bits(blob[1]), 21.0);
    }

    #[test]
    fn colours_follow_what_the_view_shows() {
        let at_rest = packed(View::Elements, Vec2::ZERO, ColourBy::Speed)[2];
        assert_eq!(at_rest.to_le_bytes(), [40, 130, 220, 255]);
        assert_ne!(packed(View::Elements, Vec2::new(90.0, 0.0), ColourBy::Speed)[2], at_rest);
        let (low, high) = (
            packed(View::Density, Vec2::ZERO, ColourBy::Density { density: &[0.5], rest: 1.0 })[2].to_le_bytes(),
            packed(View::Density, Vec2::ZERO, ColourBy::Density { density: &[1.1], rest: 1.0 })[2].to_le_bytes(),
        );
        assert!(low[2] > low[0] && high[0] > high[2], "{low:?} {high:?}");
    }

    #[test]
    fn absurd_values_do_not_leave_the_table() {
        for speed in [f32::NAN, f32::INFINITY, 1e30] {
            packed(View::Speed, Vec2::new(speed, 0.0), ColourBy::Speed);
        }
        packed(View::Density, Vec2::ZERO, ColourBy::Density { density: &[f32::NAN], rest: 1.0 });
    }
}
