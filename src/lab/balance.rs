//! What the movable particles carry and how far they reach, in SI units and f64, summed in the order of the store.

use crate::{
    kernel::{
        element::{ElementId, ElementTable},
        params::Domain,
        particles::Particles,
        solids::{Solids, centre},
        units::Scale,
    },
    lab::stats,
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        state::{Elements, ParticleStore, Setup},
    },
};
use bevy::ecs::world::World;
use glam::{DVec2, IVec2, Vec2};

/// The parts of a world that mechanics needs.
#[derive(Clone, Copy)]
pub struct Matter<'a> {
    /// Movable particles.
    pub particles: &'a Particles,
    /// What they are made of.
    pub elements: &'a ElementTable,
    /// Box and gravity.
    pub domain: &'a Domain,
    /// Particle spacing.
    pub scale: Scale,
    /// Density of the air, kg/m².
    pub air_density: f32,
    /// What the elements feel of gravity, as a share; none where the air lifts no gas.
    pub weights: Option<&'a [f32]>,
}

/// The movable particles with what mechanics needs to know of them.
pub(crate) fn matter(world: &World) -> Matter<'_> {
    let Setup { blueprint, domain, .. } = world.resource::<Setup>();
    Matter {
        particles: world.resource::<ParticleStore>(),
        elements: &blueprint.elements,
        domain,
        scale: blueprint.scale,
        air_density: blueprint.air.density,
        // Whether gases are there makes no difference here.
        weights: (world.resource::<Effects>().get(Effect::Buoyancy).mode != Mode::Off)
            .then_some(&world.resource::<Elements>().weight[..]),
    }
}

/// Mass, energy and momentum of the movable particles, for each metre of depth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// Mass, kg, with the air that moves with gases.
    pub mass: f64,
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Potential energy over the origin (the lower left corner of the box), J.
    pub potential: f64,
    /// Momentum, kg m/s.
    pub momentum: DVec2,
    /// Σ m |v|, what a momentum is compared with, kg m/s.
    pub momentum_sum: f64,
    /// Highest speed, m/s.
    pub max_speed: f64,
}

impl Balance {
    /// Kinetic and potential energy together, J.
    pub fn energy(&self) -> f64 {
        self.kinetic + self.potential
    }
}

impl Matter<'_> {
    /// Mass of a particle of an element, kg, with the air that moves with a gas.
    pub fn mass(self, element: ElementId) -> f64 {
        let d = f64::from(self.scale.spacing);
        f64::from(self.elements.get(element).inertia(self.air_density)) * d * d
    }

    /// What a particle of an element feels of gravity, m/s².
    pub fn gravity(self, element: ElementId) -> DVec2 {
        let share = self.weights.map_or(1.0, |weights| f64::from(weights[element.index()]));
        share * self.domain.gravity.as_dvec2() * f64::from(self.scale.spacing)
    }

    /// Mass, energy and momentum.
    pub fn balance(self) -> Balance {
        let d = f64::from(self.scale.spacing);
        let of: Vec<_> = self.elements.iter().map(|(id, _)| (self.mass(id), self.gravity(id))).collect();
        let mut sum = Balance::default();
        for i in 0..self.particles.len() {
            let (mass, gravity) = of[self.particles.element[i].index()];
            let (p, v) = (self.particles.position(i).as_dvec2() * d, self.particles.velocity(i).as_dvec2() * d);
            let speed = v.length();
            sum.mass += mass;
            sum.kinetic += 0.5 * mass * speed * speed;
            sum.potential -= mass * gravity.dot(p);
            sum.momentum += mass * v;
            sum.momentum_sum += mass * speed;
            sum.max_speed = sum.max_speed.max(speed);
        }
        sum
    }

    /// How far the foot of the liquid has come along x, m: the 99.5th percentile of x, and half a spacing, among the
    /// particles below a quarter of √(N/2) d (in `dam_break`: a quarter of the block's width). `None` without any.
    pub fn front(self) -> Option<f64> {
        let low = 0.25 * (self.particles.len() as f64 / 2.0).sqrt();
        let mut foot: Vec<f64> = (self.particles.x.iter().zip(&self.particles.y))
            .filter(|(_, y)| f64::from(**y) < low)
            .map(|(x, _)| f64::from(*x))
            .collect();
        stats::quantile(&mut foot, 0.995).map(|x| (x + 0.5) * f64::from(self.scale.spacing))
    }

    /// Height of the surface, m: the median over the columns (d wide) that hold particles of their highest one, and half
    /// a spacing. `None` without any.
    pub fn surface(self) -> Option<f64> {
        let mut tops = self.column_tops();
        tops.retain(|top| top.is_finite());
        stats::quantile(&mut tops, 0.5).map(|y| (y + 0.5) * f64::from(self.scale.spacing))
    }

    /// y of the highest particle in each column of width d, d; −∞ where there is none.
    pub fn column_tops(self) -> Vec<f64> {
        let mut tops = vec![f64::NEG_INFINITY; self.domain.size.x.ceil().max(1.0) as usize];
        let last = tops.len() - 1;
        for (&x, &y) in self.particles.x.iter().zip(&self.particles.y) {
            let top = &mut tops[(x as usize).min(last)];
            *top = top.max(f64::from(y));
        }
        tops
    }
}

/// Whether no movable particle is within `reach` (d) of a wall or of rock, so that only gravity changes their momentum.
pub fn floats_free(particles: &Particles, rock: &Solids, size: Vec2, reach: f32) -> bool {
    let span = reach.ceil() as i32 + 1;
    (0..particles.len()).all(|i| {
        let p = particles.position(i);
        let far_from_walls = p.cmpgt(Vec2::splat(reach)).all() && p.cmplt(size - reach).all();
        far_from_walls && (rock.count() == 0 || !near_rock(p, rock, reach, span))
    })
}

fn near_rock(p: Vec2, rock: &Solids, reach: f32, span: i32) -> bool {
    let cell = Solids::cell_of(p);
    (-span..=span).any(|y| {
        (-span..=span).any(|x| {
            let other = cell + IVec2::new(x, y);
            // A rock cell reaches half a spacing beyond its centre.
            rock.get(other).is_some() && (centre(other) - p).abs().max_element() <= reach + 0.5
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::element::Element;

    fn table() -> ElementTable {
        ElementTable::new(
            [1000.0, 500.0]
                .map(|density| Element { density, ..Element::plain(&format!("liquid {density}"), false) })
                .into(),
        )
    }

    fn domain() -> Domain {
        Domain { size: Vec2::new(40.0, 20.0), gravity: Vec2::new(0.0, -98.1) }
    }

    fn of<'a>(particles: &'a Particles, elements: &'a ElementTable, domain: &'a Domain) -> Matter<'a> {
        Matter { particles, elements, domain, scale: Scale::own(0.1), air_density: 1.2, weights: None }
    }

    #[test]
    fn energy_and_momentum_are_those_of_the_mechanics_book() {
        let mut particles = Particles::default();
        particles.push(0, ElementId(0), Vec2::new(5.0, 10.0), Vec2::new(20.0, 0.0));
        particles.push(1, ElementId(1), Vec2::new(5.0, 0.0), Vec2::new(0.0, -40.0));
        let (elements, domain) = (table(), domain());
        // d = 0.1 m: 10 kg and 5 kg, 1 m and 0 m high, 2 m/s and 4 m/s fast, g = 9.81 m/s².
        let matter = of(&particles, &elements, &domain);
        let balance = matter.balance();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-4 * b.abs().max(1.0);
        assert!(near(balance.mass, 15.0), "{balance:?}");
        assert!(near(balance.kinetic, 0.5 * 10.0 * 4.0 + 0.5 * 5.0 * 16.0), "{balance:?}");
        assert!(near(balance.potential, 98.1), "{balance:?}");
        assert!(near(balance.momentum.x, 20.0) && near(balance.momentum.y, -20.0), "{balance:?}");
        assert!(near(balance.momentum_sum, 40.0) && near(balance.max_speed, 4.0), "{balance:?}");
    }

    #[test]
    fn a_block_reaches_to_its_edge_and_stands_as_high_as_it_is() {
        let mut particles = Particles::default();
        for k in 0..200 {
            let cell = IVec2::new(k % 10, k / 10);
            particles.push(k as u32, ElementId(0), centre(cell), Vec2::ZERO);
        }
        let (elements, domain) = (table(), domain());
        let matter = of(&particles, &elements, &domain);
        assert!((matter.front().unwrap() - 1.0).abs() < 1e-6);
        assert!((matter.surface().unwrap() - 2.0).abs() < 1e-6);
        let nothing = Particles::default();
        let empty = Matter { particles: &nothing, ..matter };
        assert_eq!((empty.front(), empty.surface()), (None, None));
    }

    #[test]
    fn only_what_is_far_from_walls_and_rock_floats_free() {
        let mut particles = Particles::default();
        particles.push(0, ElementId(0), Vec2::new(10.0, 10.0), Vec2::ZERO);
        let mut rock = Solids::new(40, 20);
        let free = |particles: &Particles, rock: &Solids| floats_free(particles, rock, domain().size, 3.0);
        assert!(free(&particles, &rock));
        rock.insert(IVec2::new(14, 10), ElementId(1), 5);
        assert!(free(&particles, &rock), "4 d away is far enough");
        rock.insert(IVec2::new(12, 8), ElementId(1), 6);
        assert!(!free(&particles, &rock), "rock 2 d away is not");
        particles.push(1, ElementId(0), Vec2::new(2.0, 10.0), Vec2::ZERO);
        assert!(!free(&particles, &Solids::new(40, 20)), "neither is a wall 2 d away");
    }
}
