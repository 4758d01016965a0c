//! A tank in which every lump exchanges heat.

use crate::{kernels::counted, tank::Tank};
use glam::Vec2;
use powder_master::kernel::{
    element::{Element, ElementId, ElementTable},
    heat::{Heat, HeatRecord, Warm, table::HeatTable},
    parallel::Team,
    simd::InstructionSet,
    units::{Scale, TICK_SECONDS},
};

/// Colder than the room by no more than this, K, and as much warmer.
const UNLIKE: f32 = 20.0;

/// Lets heat flow for a tick in the water of the tank, which is colder the higher it lies.
pub fn flow(set: InstructionSet) {
    let mut tank = Tank::new(set);
    let elements =
        ElementTable::new(vec![Element { conductivity: 0.6, capacity: 4.2, ..Element::plain("water", false) }]);
    let table = HeatTable::new(&elements);
    let height = tank.domain.size.y;
    for i in 0..tank.particles.len() {
        let above = 2.0 * tank.particles.position(i).y / height - 1.0;
        let heat = table.curve(ElementId(0)).heat(293.0 - UNLIKE * above);
        tank.particles.set_heat(i, heat);
    }
    counted(&mut (tank, Heat::default()), |(tank, heat)| {
        let mut warm = Warm {
            particles: &mut tank.particles,
            solids: &mut tank.solids,
            elements: &elements,
            table: &table,
            domain: &tank.domain,
            scale: Scale::own(0.1),
        };
        heat.flow(&mut warm, &mut HeatRecord::default(), Team { instructions: set, threads: 1 }, TICK_SECONDS);
    });
}
