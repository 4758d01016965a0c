//! Movable particles as instances: position between two ticks and colour.

use crate::{
    kernel::{element::ElementTable, particles::Particles},
    sim::view::{Reference, Sample, View, colour},
};

/// Colours of each element over the range of what is shown, precomputed.
const LEVELS: usize = 64;

/// Position (two f32) and colour (four bytes) of a particle.
pub type Blob = [u32; 3];

/// A table of colours: a row of [`LEVELS`] for each element.
#[derive(Clone, Debug, Default)]
pub struct ColourTable {
    colours: Vec<u32>,
}

impl ColourTable {
    /// The colours of a view: over speed, or over density error from −0.1 to 0.1.
    pub fn fill(&mut self, view: View, elements: &ElementTable) {
        self.colours.clear();
        for (_, element) in elements.iter() {
            self.colours.extend((0..LEVELS).map(|level| {
                let share = level as f32 / (LEVELS - 1) as f32;
                let sample = match view {
                    View::Density => Sample { density_error: (share - 0.5) * 0.2, ..Sample::default() },
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

/// Packs all particles as they stood `back` seconds ago (straight back along their velocities). With `density_error`,
/// one ρ/ρ₀ − 1 for each particle, they are coloured by it, else by speed.
pub fn pack(
    particles: &Particles,
    table: &ColourTable,
    reference: Reference,
    density_error: Option<&[f32]>,
    back: f32,
    out: &mut Vec<Blob>,
) {
    let count = particles.len();
    out.resize(count, Blob::default());
    let (x, y) = (&particles.x[..count], &particles.y[..count]);
    let (vx, vy, element) = (&particles.vx[..count], &particles.vy[..count], &particles.element[..count]);
    let scale = 1.0 / reference.fall;
    let error = density_error.filter(|error| error.len() == count);
    for (i, blob) in out.iter_mut().enumerate() {
        let share = match error {
            Some(error) => 0.5 + error[i] * 5.0,
            None => (vx[i] * vx[i] + vy[i] * vy[i]).sqrt() * scale,
        };
        *blob = [
            (x[i] - vx[i] * back).to_bits(),
            (y[i] - vy[i] * back).to_bits(),
            table.at(element[i].index(), share),
        ];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::element::{Element, ElementId};
    use glam::Vec2;

    fn elements() -> ElementTable {
        ElementTable::new(vec![Element {
            name: "water".into(),
            key: '1',
            colour: [40, 130, 220],
            fixed: false,
            density: 1000.0,
            viscosity: 0.0,
            vorticity: 0.0,
            drag: 0.0,
            flow: 1.0,
        }])
    }

    fn packed(view: View, velocity: Vec2, error: Option<&[f32]>) -> Blob {
        let mut particles = Particles::default();
        particles.push(0, ElementId(0), Vec2::new(10.0, 20.0), velocity);
        let mut table = ColourTable::default();
        table.fill(view, &elements());
        let mut out = Vec::new();
        pack(&particles, &table, Reference { fall: 100.0, wind: 1.0 }, error, 0.01, &mut out);
        out[0]
    }

    #[test]
    fn a_blob_stands_where_the_particle_was_a_moment_ago() {
        let blob = packed(View::Elements, Vec2::new(50.0, -100.0), None);
        assert_eq!(f32::from_bits(blob[0]), 9.5);
        assert_eq!(f32::from_bits(blob[1]), 21.0);
    }

    #[test]
    fn colours_follow_what_the_view_shows() {
        let at_rest = packed(View::Elements, Vec2::ZERO, None)[2];
        assert_eq!(at_rest.to_le_bytes(), [40, 130, 220, 255]);
        assert_ne!(packed(View::Elements, Vec2::new(90.0, 0.0), None)[2], at_rest);
        let (low, high) = (
            packed(View::Density, Vec2::ZERO, Some(&[-0.1]))[2].to_le_bytes(),
            packed(View::Density, Vec2::ZERO, Some(&[0.1]))[2].to_le_bytes(),
        );
        assert!(low[2] > low[0] && high[0] > high[2], "{low:?} {high:?}");
    }

    #[test]
    fn absurd_values_do_not_leave_the_table() {
        for speed in [f32::NAN, f32::INFINITY, 1e30] {
            packed(View::Speed, Vec2::new(speed, 0.0), None);
        }
        packed(View::Density, Vec2::ZERO, Some(&[f32::NEG_INFINITY]));
    }
}
