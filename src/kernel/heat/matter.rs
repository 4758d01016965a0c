//! The matter of a world.

use crate::{
    element::ElementTable, heat::table::HeatTable, params::Domain, particles::Particles, solids::Solids, units::Scale,
};

/// The matter of a world, with what its heat, its changes and its reactions go by.
pub struct Warm<'a> {
    /// Movable particles.
    pub particles: &'a mut Particles,
    /// Rock.
    pub solids: &'a mut Solids,
    /// All elements.
    pub elements: &'a ElementTable,
    /// How warm they are by their heat.
    pub table: &'a HeatTable,
    /// The box.
    pub domain: &'a Domain,
    /// The run's spacing.
    pub scale: Scale,
}

/// Chemical energy that all lumps have together, quanta.
pub fn chemical(particles: &Particles, solids: &Solids, table: &HeatTable) -> i64 {
    let lumps: i64 = particles.element.iter().map(|element| i64::from(table.energy(*element))).sum();
    lumps + solids.iter().map(|(_, element, _)| i64::from(table.energy(element))).sum::<i64>()
}

/// Heat that all lumps hold together, quanta.
pub fn held(particles: &Particles, solids: &Solids) -> i64 {
    let lumps: i64 = particles.heat.iter().map(|heat| i64::from(*heat)).sum();
    lumps + solids.heats().iter().map(|heat| i64::from(*heat)).sum::<i64>()
}
