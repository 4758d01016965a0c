//! What is under the pointer.

use crate::kernel::{element::ElementId, particles::Particles, solids::Solids};
use glam::Vec2;

/// How far from the pointer a particle is still meant, d.
const REACH: f32 = 1.5;

/// A lump of matter: a particle or a cell of rock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lump {
    /// What it is made of.
    pub element: ElementId,
    /// Heat, quanta.
    pub heat: i32,
    /// Velocity, d/s; none of rock.
    pub velocity: Option<Vec2>,
}

impl Lump {
    /// The rock at a point (d), or else the particle that is nearest within reach.
    pub fn at(particles: &Particles, rock: &Solids, at: Vec2) -> Option<Self> {
        let cell = Solids::cell_of(at);
        if let Some((element, _)) = rock.get(cell) {
            return Some(Self { element, heat: rock.heat(cell), velocity: None });
        }
        let away = |i: usize| particles.position(i).distance_squared(at);
        let near = (0..particles.len()).map(|i| (i, away(i))).filter(|(_, away)| *away < REACH * REACH);
        let (i, _) = near.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(Self { element: particles.element[i], heat: particles.heat_of(i), velocity: Some(particles.velocity(i)) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::IVec2;

    #[test]
    fn rock_comes_first_then_the_nearest_particle_within_reach() {
        let (mut particles, mut rock) = (Particles::default(), Solids::new(20, 20));
        rock.insert(IVec2::new(3, 3), ElementId(0), 0);
        rock.set_heat(IVec2::new(3, 3), 7);
        particles.push(1, ElementId(1), Vec2::new(4.2, 3.5), Vec2::X);
        particles.push_warm(2, ElementId(2), Vec2::new(5.5, 3.5), Vec2::Y, 9);
        let at = |x: f32| Lump::at(&particles, &rock, Vec2::new(x, 3.5));
        assert_eq!(at(3.9), Some(Lump { element: ElementId(0), heat: 7, velocity: None }));
        assert_eq!(at(4.6), Some(Lump { element: ElementId(1), heat: 0, velocity: Some(Vec2::X) }));
        assert_eq!(at(6.5), Some(Lump { element: ElementId(2), heat: 9, velocity: Some(Vec2::Y) }));
        assert_eq!(at(7.5), None);
        assert_eq!(at(f32::NAN), None);
    }
}
