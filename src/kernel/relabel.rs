//! A lump becomes another element, and keeps its energy, its place and its number. What the other has less of chemical energy is
//! heat then. What does not move and what does are kept in different stores, so some lumps change over; some go into the air.

use crate::{
    element::ElementId,
    heat::{HeatRecord, Warm, table::HeatTable},
    particles::Particles,
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};

/// What became of lumps in a tick. Buffers are kept.
#[derive(Clone, Debug, Default)]
pub struct Relabelled {
    /// Where lumps are another element than before, or gone, d.
    pub places: Vec<Vec2>,
    /// Particles that go.
    gone: Vec<bool>,
    /// Particles in each cell of the box, where one of them may become rock.
    crowd: Vec<u8>,
}

impl Relabelled {
    /// Begins a tick.
    pub fn begin(&mut self) {
        self.places.clear();
        self.gone.clear();
        self.crowd.clear();
    }

    /// Whether a particle can become this where it is: rock stands alone in a cell of the box.
    pub fn can_be(&mut self, warm: &Warm, i: usize, product: Option<ElementId>) -> bool {
        if !product.is_some_and(|product| warm.elements.get(product).fixed) {
            return true;
        }
        let Warm { particles, solids, .. } = warm;
        let index = |cell: IVec2| cell.y as usize * solids.columns() as usize + cell.x as usize;
        if self.crowd.is_empty() {
            self.crowd.resize(solids.columns() as usize * solids.rows() as usize, 0);
            let cells = (0..particles.len()).map(|other| Solids::cell_of(particles.position(other)));
            for cell in cells.filter(|cell| solids.contains(*cell)) {
                let count = &mut self.crowd[index(cell)];
                *count = count.saturating_add(1);
            }
        }
        let cell = Solids::cell_of(particles.position(i));
        solids.contains(cell) && !solids.is_solid(cell) && self.crowd[index(cell)] == 1
    }

    /// Gives a particle that [can be it](Relabelled::can_be) another element; none is air.
    pub fn particle(&mut self, warm: &mut Warm, record: &mut HeatRecord, i: usize, product: Option<ElementId>) {
        let Warm { particles, solids, elements, .. } = warm;
        let at = particles.position(i);
        self.places.push(at);
        let heat = heat_as(warm.table, record, particles.element[i], product, particles.heat_of(i));
        let stays = match product {
            Some(product) if elements.get(product).fixed => {
                let cell = Solids::cell_of(at);
                solids.insert(cell, product, particles.id[i]);
                solids.set_heat(cell, heat);
                record.turned += 1;
                false
            }
            Some(product) => {
                particles.element[i] = product;
                particles.set_heat(i, heat);
                true
            }
            None => {
                record.gone += 1;
                false
            }
        };
        if !stays {
            self.gone.resize(particles.len(), false);
            self.gone[i] = true;
        }
    }

    /// Gives rock another element; none is air.
    pub fn rock(&mut self, warm: &mut Warm, record: &mut HeatRecord, cell: IVec2, product: Option<ElementId>) {
        let Warm { particles, solids, elements, domain, .. } = warm;
        let Some((element, id)) = solids.get(cell) else { return };
        let heat = heat_as(warm.table, record, element, product, solids.heat(cell));
        self.places.push(centre(cell));
        solids.remove(cell);
        match product {
            Some(product) if elements.get(product).fixed => {
                solids.insert(cell, product, id);
                solids.set_heat(cell, heat);
            }
            Some(product) => {
                // A cell that the box ends in may have its centre beyond the wall.
                particles.push_warm(id, product, domain.keep_inside(centre(cell)), Vec2::ZERO, heat);
            }
            None => record.gone += 1,
        }
        record.turned += 1;
    }

    /// Takes away what went. Particles have other places in their store from then on.
    pub fn end(&mut self, particles: &mut Particles) {
        if !self.gone.is_empty() {
            self.gone.resize(particles.len(), false);
            particles.retain(|_, i| !self.gone[i]);
        }
    }
}

/// Heat that a lump has as another element, quanta. What that has less of chemical energy is heat, what it has more is of light.
/// What the air gets is booked: all of what goes into it, and what would be hotter than anything may be, or colder.
fn heat_as(table: &HeatTable, record: &mut HeatRecord, from: ElementId, to: Option<ElementId>, heat: i32) -> i32 {
    let freed = i64::from(table.energy(from)) - to.map_or(0, |to| i64::from(table.energy(to)));
    record.by_light += (-freed).max(0);
    let heat = i64::from(heat) + freed.max(0);
    let within = |to: ElementId| {
        let [least, most] = table.curve(to).bounds().map(i64::from);
        heat.clamp(least, most)
    };
    let keeps = to.map_or(0, within);
    record.to_air += heat - keeps;
    keeps as i32
}
