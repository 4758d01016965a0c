//! A world seen coarsely, and how far two of them are apart.
//!
//! Particles of a chaotic flow go their own ways after the smallest difference, however exact each run is; what a
//! picture shows of them does not. So runs are compared on square cells of [`CELL`] over the box, from its lower left
//! corner on. A cell holds
//!
//! - the area of liquid in it, m² (d²/ρ₀ a particle),
//! - the momentum of the particles in it, kg m/s for each metre of depth, both shared out to the four cells whose
//!   middles are around a particle, bilinearly, so that one that crosses an edge makes no step,
//! - the mean velocity of the air in it, m/s: over 4 × 4 points, bilinear, those in rock left out.
//!
//! The distance of a field to a reference's is, from 0 to 1 for the first and around 1 for "nothing in common" in the
//! others:
//!
//! ```text
//! share     Σ |a − a'| / Σ (a + a')                       liquid that is in another cell, as a share
//! momentum  Σ |m − m'| / max(⟨Σ |m'|⟩, M' u₀)             difference of momentum, against the reference's
//! air       √( Σ |u − u'|² / max(⟨Σ |u'|²⟩, n u₀²) )      root mean square difference of air velocity, likewise
//! ```
//!
//! Eddies of air are shed at another moment in each run. Over a whole run the air is therefore compared by its mean over the
//! run's samples, not sample by sample: two runs of the same wake have that in common.
//!
//! Here ' is the reference, ⟨ ⟩ the mean over its samples, M' its mass, n its cells with air and u₀ a speed that is calm
//! to the eye, 0.02 d a tick, so that what rests is not compared with nothing.

use crate::{
    kernel::{solids::Solids, units::TICKS_PER_SECOND},
    lab::{balance::matter, stats},
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        state::{AirGrid, Rock, Setup},
    },
};
use bevy::ecs::world::World;
use glam::{DVec2, UVec2, Vec2};
use serde::{Deserialize, Serialize};

/// Edge of a cell, in the scene's own spacings: three kernel radii, two air cells of `balanced`. Runs of any detail are
/// compared on the same cells.
pub const CELL: f32 = 8.0;

/// A box that reaches into a cell by no more than this share of it, a rounding, has not that cell.
const SLACK: f32 = 1e-4;

/// Points of a cell along each axis at which the air is looked at.
const POINTS: u32 = 4;

/// Speed that is calm to the eye, of the scene's own spacings a tick.
const CALM: f64 = 0.02;

/// A world seen coarsely.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CoarseField {
    area: Vec<f64>,
    momentum: Vec<DVec2>,
    /// Empty where the air is switched off.
    air: Vec<DVec2>,
    mass: f64,
    /// u₀, m/s.
    calm: f64,
}

/// Sums over a reference that differences are held against.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Magnitude {
    momentum: f64,
    air: f64,
}

/// How far two worlds are apart. `None` where there is nothing to compare.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Distance {
    /// Share of the liquid that is in another cell.
    pub share: Option<f64>,
    /// Difference of momentum against the reference's.
    pub momentum: Option<f64>,
    /// Root mean square difference of air velocity against the reference's; over a run, of its mean.
    pub air: Option<f64>,
}

impl Distance {
    /// The mean of several, each part over those that have it.
    pub fn mean(distances: &[Self]) -> Self {
        let part = |part: fn(&Self) -> Option<f64>| stats::mean(distances.iter().filter_map(part));
        Self { share: part(|d| d.share), momentum: part(|d| d.momentum), air: part(|d| d.air) }
    }
}

impl CoarseField {
    /// The world as it is. Particles that are not finite or outside the box are in no cell.
    pub fn of(world: &World) -> Self {
        let matter = matter(world);
        let d = f64::from(matter.scale.spacing);
        let fluid = &world.resource::<Setup>().blueprint.fluid;
        let edge = CELL * matter.scale.detail;
        let cells = (matter.domain.size / edge - SLACK).ceil().as_uvec2();
        let count = (cells.x * cells.y) as usize;
        let mut field = Self {
            area: vec![0.0; count],
            momentum: vec![DVec2::ZERO; count],
            calm: CALM * f64::from(TICKS_PER_SECOND) * f64::from(matter.scale.own_spacing()),
            ..Self::default()
        };
        let area = d * d / f64::from(fluid.rest_density);
        let masses: Vec<f64> = matter.elements.iter().map(|(id, _)| matter.mass(id)).collect();
        for i in 0..matter.particles.len() {
            let (position, velocity) = (matter.particles.position(i), matter.particles.velocity(i));
            let at = position / edge;
            let inside = at.cmpge(Vec2::ZERO).all() && at.cmplt(cells.as_vec2()).all();
            if inside && velocity.is_finite() {
                let mass = masses[matter.particles.element[i].index()];
                for (k, share) in around(at, cells) {
                    field.area[k] += share * area;
                    field.momentum[k] += share * mass * d * velocity.as_dvec2();
                }
                field.mass += mass;
            }
        }
        if world.resource::<Effects>().get(Effect::Air).mode != Mode::Off {
            let (air, rock) = (world.resource::<AirGrid>(), world.resource::<Rock>());
            let places = (0..cells.y).flat_map(|y| (0..cells.x).map(move |x| Vec2::new(x as f32, y as f32) * edge));
            field.air = places.map(|corner| mean_velocity(air, rock, corner, edge, matter.domain.size) * d).collect();
        }
        field
    }

    /// The mean of the air of these samples, without the liquid.
    pub fn mean_air<'a>(samples: impl IntoIterator<Item = &'a Self>) -> Self {
        let (mut mean, mut count) = (Self::default(), 0.0);
        for sample in samples {
            mean.air.resize(sample.air.len(), DVec2::ZERO);
            mean.air.iter_mut().zip(&sample.air).for_each(|(sum, u)| *sum += *u);
            mean.calm = sample.calm;
            count += 1.0;
        }
        mean.air.iter_mut().for_each(|sum| *sum /= count);
        mean
    }

    /// The mean of two worlds of the same box.
    pub fn mean(&self, other: &Self) -> Self {
        let vectors = |a: &[DVec2], b: &[DVec2]| a.iter().zip(b).map(|(a, b)| 0.5 * (*a + *b)).collect();
        Self {
            area: self.area.iter().zip(&other.area).map(|(a, b)| 0.5 * (a + b)).collect(),
            momentum: vectors(&self.momentum, &other.momentum),
            air: vectors(&self.air, &other.air),
            mass: 0.5 * (self.mass + other.mass),
            calm: self.calm,
        }
    }

    /// Sums over this field as a reference.
    fn magnitude(&self) -> Magnitude {
        Magnitude {
            momentum: self.momentum.iter().map(|m| m.length()).sum(),
            air: self.air.iter().map(|u| u.length_squared()).sum(),
        }
    }

    /// What differences to these samples of a reference are held against.
    pub fn magnitudes(samples: &[Self]) -> Magnitude {
        let count = samples.len().max(1) as f64;
        let sums = samples.iter().map(Self::magnitude).fold(Magnitude::default(), |sum, next| Magnitude {
            momentum: sum.momentum + next.momentum,
            air: sum.air + next.air,
        });
        Magnitude { momentum: sums.momentum / count, air: sums.air / count }
    }

    /// How far this world is from a reference of the same box.
    pub fn distance(&self, reference: &Self, against: Magnitude) -> Distance {
        debug_assert_eq!(self.area.len(), reference.area.len());
        let pairs = || self.area.iter().zip(&reference.area);
        let area: f64 = pairs().map(|(a, b)| a + b).sum();
        let moved: f64 = pairs().map(|(a, b)| (a - b).abs()).sum();
        let momenta = self.momentum.iter().zip(&reference.momentum);
        let momentum: f64 = momenta.map(|(a, b)| (*a - *b).length()).sum();
        let air: f64 = self.air.iter().zip(&reference.air).map(|(a, b)| (*a - *b).length_squared()).sum();
        let calm_air = reference.air.len() as f64 * self.calm * self.calm;
        let has_liquid = area > 0.0;
        Distance {
            share: has_liquid.then(|| moved / area),
            momentum: has_liquid.then(|| momentum / against.momentum.max(reference.mass * self.calm)),
            air: (!reference.air.is_empty()).then(|| (air / against.air.max(calm_air)).sqrt()),
        }
    }
}

/// The cells whose middles are around a place (in cells from the lower left corner of the box), and how much of what is
/// there belongs to each. Beyond the outermost middles it all belongs to the cell itself.
fn around(at: Vec2, cells: UVec2) -> impl Iterator<Item = (usize, f64)> {
    let last = cells.as_vec2() - 1.0;
    let at = (at - 0.5).clamp(Vec2::ZERO, last);
    let low = at.floor();
    let share = (at - low).as_dvec2();
    let high = (low + 1.0).min(last);
    let index = move |x: f32, y: f32| (y as u32 * cells.x + x as u32) as usize;
    [
        (index(low.x, low.y), (1.0 - share.x) * (1.0 - share.y)),
        (index(high.x, low.y), share.x * (1.0 - share.y)),
        (index(low.x, high.y), (1.0 - share.x) * share.y),
        (index(high.x, high.y), share.x * share.y),
    ]
    .into_iter()
}

/// Mean velocity of the air in the cell of edge `edge` (d) at `corner`, d/s.
fn mean_velocity(air: &AirGrid, rock: &Solids, corner: Vec2, edge: f32, size: Vec2) -> DVec2 {
    let (mut sum, mut count) = (DVec2::ZERO, 0.0);
    for k in 0..POINTS * POINTS {
        let at = corner + (Vec2::new((k % POINTS) as f32, (k / POINTS) as f32) + 0.5) * (edge / POINTS as f32);
        if at.cmplt(size).all() && !rock.is_solid(Solids::cell_of(at)) {
            sum += air.sample_velocity(at).as_dvec2();
            count += 1.0;
        }
    }
    if count > 0.0 { sum / count } else { sum }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{self, effects::EffectModes},
        sim::{simulation::Simulation, state::ParticleStore, workers::Workers},
    };
    use std::sync::Arc;

    fn world(scene: &str) -> Simulation {
        let blueprint = scene::load(scene).unwrap().build(&[], None, &EffectModes::new()).unwrap();
        Simulation::new(Arc::new(blueprint), Workers::default())
    }

    fn to_self(field: &CoarseField, other: &CoarseField) -> Distance {
        field.distance(other, CoarseField::magnitudes(std::slice::from_ref(other)))
    }

    #[test]
    fn a_world_is_no_distance_from_itself() {
        let mut simulation = world("sealed_air");
        (0..20).for_each(|_| simulation.tick());
        let field = CoarseField::of(simulation.world());
        let distance = to_self(&field, &field);
        assert_eq!(distance, Distance { share: Some(0.0), momentum: Some(0.0), air: Some(0.0) });
    }

    #[test]
    fn liquid_in_other_cells_counts_by_its_share_and_its_order_does_not() {
        let mut simulation = world("dam_break");
        let before = CoarseField::of(simulation.world());
        assert!((before.area.iter().sum::<f64>() - 10_082.0 * 0.01).abs() < 1e-3, "a hundredth of a m² a particle");
        let particles = &mut simulation.world_mut().resource_mut::<ParticleStore>().into_inner().0;
        let half = particles.len() / 2;
        particles.x.swap(0, half);
        particles.y.swap(0, half);
        let share = to_self(&CoarseField::of(simulation.world()), &before).share;
        assert!(share.is_some_and(|share| share < 1e-15), "particles are interchangeable, but {share:?}");
        let particles = &mut simulation.world_mut().resource_mut::<ParticleStore>().into_inner().0;
        particles.x.iter_mut().take(half).for_each(|x| *x += 200.0);
        let distance = to_self(&CoarseField::of(simulation.world()), &before);
        assert!((distance.share.unwrap() - 0.5).abs() < 1e-3, "{distance:?}");
        assert_eq!(distance.momentum, Some(0.0), "all is at rest");
        assert_eq!(distance.air, None, "the scene has no air");
    }

    #[test]
    fn air_that_swings_in_another_phase_has_the_same_mean() {
        let sample = |u: f64| CoarseField { air: vec![DVec2::new(3.0, u); 4], calm: 1e-3, ..CoarseField::default() };
        let (own, reference) = ([sample(2.0), sample(-2.0)], [sample(-2.0), sample(2.0)]);
        let against = CoarseField::magnitudes(&reference);
        assert!(own[0].distance(&reference[0], against).air.unwrap() > 1.0);
        let means = [&own, &reference].map(CoarseField::mean_air);
        assert_eq!(means[0].distance(&means[1], against), Distance { air: Some(0.0), ..Distance::default() });
        let slower = [sample(2.0), sample(-1.0)];
        assert!(CoarseField::mean_air(&slower).distance(&means[1], against).air.unwrap() > 0.1);
        assert!(CoarseField::mean_air([]).distance(&CoarseField::mean_air([]), against).air.is_none());
    }

    #[test]
    fn momentum_is_held_against_the_references_or_against_calm() {
        let mut simulation = world("dam_break");
        let still = CoarseField::of(simulation.world());
        let fall = |simulation: &mut Simulation, speed: f32| {
            simulation.world_mut().resource_mut::<ParticleStore>().vy.iter_mut().for_each(|vy| *vy = speed);
            CoarseField::of(simulation.world())
        };
        let (slow, fast) = (fall(&mut simulation, -10.0), fall(&mut simulation, -11.0));
        let found = to_self(&fast, &slow).momentum.unwrap();
        assert!((found - 0.1).abs() < 1e-6, "a tenth faster: {found}");
        let calm = fall(&mut simulation, 0.02 * 60.0);
        let found = to_self(&calm, &still).momentum.unwrap();
        assert!((found - 1.0).abs() < 1e-6, "0.02 d a tick is what rest is held against: {found}");
    }
}
