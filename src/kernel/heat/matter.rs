//! What exchanges heat.

use crate::{
    element::ElementTable, heat::table::HeatTable, params::Domain, particles::Particles, solids::Solids, units::Scale,
};

/// The matter that exchanges heat.
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

/// Heat that all lumps hold together, quanta.
pub fn held(particles: &Particles, solids: &Solids) -> i64 {
    let lumps: i64 = particles.heat.iter().map(|heat| i64::from(*heat)).sum();
    lumps + solids.heats().iter().map(|heat| i64::from(*heat)).sum::<i64>()
}
