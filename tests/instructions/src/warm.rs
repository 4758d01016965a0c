//! A tank in which every lump exchanges heat.

use crate::tank::Tank;
use powder_master::kernel::{
    element::{Element, ElementId, ElementTable},
    heat::{Heat, HeatRecord, Warm, table::HeatTable},
    parallel::Team,
    simd::InstructionSet,
    units::{Scale, TICK_SECONDS},
};

/// How much colder than the room the water is at the top, K, and how much warmer at the bottom.
const UNLIKE: f32 = 20.0;

/// Water that is colder the higher it lies.
pub struct WarmTank {
    tank: Tank,
    elements: ElementTable,
    table: HeatTable,
    heat: Heat,
}

impl WarmTank {
    /// The tank before its first tick of heat.
    pub fn new(instructions: InstructionSet) -> Self {
        let mut tank = Tank::new(instructions);
        let water = Element { conductivity: 0.6, capacity: 4.2, ..Element::plain("water", false) };
        let elements = ElementTable::new(vec![water]);
        let table = HeatTable::new(&elements);
        let height = tank.domain.size.y;
        for i in 0..tank.particles.len() {
            let above = 2.0 * tank.particles.position(i).y / height - 1.0;
            tank.particles.set_heat(i, table.curve(ElementId(0)).heat(293.0 - UNLIKE * above));
        }
        Self { tank, elements, table, heat: Heat::default() }
    }

    /// Lets heat flow for a tick.
    pub fn flow(&mut self) {
        let Self { tank, elements, table, heat } = self;
        let team = Team { instructions: tank.solver.instructions, threads: 1 };
        let Tank { particles, solids, domain, .. } = tank;
        let mut warm = Warm { particles, solids, elements, table, domain, scale: Scale::own(0.1) };
        heat.flow(&mut warm, &mut HeatRecord::default(), team, TICK_SECONDS);
    }
}
