//! What must hold at the end of some cases.

use crate::{
    kernel::particles::Particles,
    lab::balance::matter,
    sim::state::{AirGrid, ParticleStore, Setup},
};
use bevy::ecs::world::World;
use serde::Deserialize;

/// How far from its height a surface may stand, as a share of it.
const HEIGHT_OFF: f64 = 0.02;

/// What must hold in a world at the end of a case.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) enum End {
    /// This share of the particles has its nearest neighbour at least so far away, d.
    Apart { share: f64, least: f32 },
    /// The water's surface stands at this height, in the scene's own spacings, to 2 %: twice the mean height of the
    /// particles.
    Stands { height: f64 },
    /// At most such a share is left of the energy of a gust of 200 of the scene's own spacings a second.
    GustLeft(f64),
    /// No particle is faster, m/s.
    Slower(f64),
    /// Every particle stands where the scene put it, to the bit.
    Unmoved,
    /// There is as much movable matter as the scene began with, give or take so many particles of its own spacing.
    Amount {
        /// How many.
        off: f64,
    },
}

impl End {
    /// Looks at the world; the error is what does not hold.
    pub fn check(self, world: &World) -> Result<(), String> {
        let particles = &world.resource::<ParticleStore>().0;
        let detail = f64::from(matter(world).scale.detail);
        let (holds, found) = match self {
            Self::Apart { share, least } => {
                let gaps = gaps(particles);
                let rank = ((1.0 - share) * gaps.len() as f64).round() as usize;
                let gap = gaps.get(rank).copied().unwrap_or(f32::INFINITY);
                let percent = (100.0 * (1.0 - share)).round();
                let found = "the nearest neighbour of";
                (gap >= least, format!("{found} {percent} in a hundred is within {gap:.3} d, allowed {least}"))
            }
            Self::Stands { height } => {
                let sum = particles.y.iter().map(|y| f64::from(*y)).sum::<f64>();
                let mean = sum / detail / particles.len().max(1) as f64;
                let found = format!("stands {:.2} d high, allowed {height} ± {}", 2.0 * mean, HEIGHT_OFF * height);
                ((2.0 * mean / height - 1.0).abs() <= HEIGHT_OFF, found)
            }
            Self::GustLeft(share) => {
                let air = world.resource::<AirGrid>();
                // The gust is a cone 16 wide, which holds a sixth of a cylinder's ½ v² π r²; in d, detail⁴ times as
                // much.
                let gust = 0.5 * 200.0 * 200.0 * 804.0 / 6.0 * detail.powi(4);
                let left = (air.kinetic_energy() + air.pressure_energy()) / gust;
                (left <= share, format!("{left:.3} of the gust's energy left"))
            }
            Self::Slower(most) => {
                let fastest = matter(world).balance().max_speed;
                (fastest <= most, format!("{fastest:.1} m/s at the end, allowed {most}"))
            }
            Self::Unmoved => {
                let start = &world.resource::<Setup>().origin.particles;
                let moved = (particles.in_id_order().into_iter().zip(start.in_id_order()))
                    .filter(|&(i, j)| particles.position(i as usize) != start.position(j as usize))
                    .count();
                (moved == 0, format!("{moved} particles moved"))
            }
            Self::Amount { off } => {
                let Setup { origin, opened, .. } = world.resource::<Setup>();
                let own = |count: usize, detail: f64| count as f64 / detail.powi(2);
                let start = own(origin.particles.len(), f64::from(opened.scale.detail));
                let found = own(particles.len(), detail);
                ((found - start).abs() <= off, format!("{found:.1} particles' worth of {start:.1}, allowed ± {off}"))
            }
        };
        if holds { Ok(()) } else { Err(found) }
    }
}

/// Distance of each particle to its nearest neighbour, d, shortest first.
fn gaps(particles: &Particles) -> Vec<f32> {
    let mut order: Vec<usize> = (0..particles.len()).collect();
    order.sort_unstable_by(|&a, &b| particles.x[a].total_cmp(&particles.x[b]));
    let nearest = |own: usize| {
        let mut nearest = f32::MAX;
        let mut look = |others: &mut dyn Iterator<Item = &usize>| {
            for &other in others {
                if (particles.x[other] - particles.x[order[own]]).abs() >= nearest {
                    break;
                }
                nearest = nearest.min(particles.position(other).distance(particles.position(order[own])));
            }
        };
        look(&mut order[own + 1..].iter());
        look(&mut order[..own].iter().rev());
        nearest
    };
    let mut gaps: Vec<f32> = (0..order.len()).map(nearest).collect();
    gaps.sort_unstable_by(f32::total_cmp);
    gaps
}
