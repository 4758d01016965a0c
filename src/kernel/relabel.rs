//! A lump becomes another element, and keeps its energy, its place and its number. What the other has less of chemical energy is
//! heat then. What does not move and what does are kept in different stores, so some lumps change over; some go into the air.

use crate::{
    air::Release,
    element::{ElementId, ElementTable},
    heat::{
        HeatRecord, Warm,
        table::HeatTable,
        units::{COLDEST, HOTTEST},
    },
    particles::Particles,
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};

/// Gas that a lump of an element gives off as it becomes one of these in turn, d²; below 0 what it takes.
pub(crate) fn gas_of(elements: &ElementTable, from: ElementId, into: &[Option<ElementId>]) -> f32 {
    let bound = |id: ElementId| elements.get(id).gas;
    bound(from) - into.iter().flatten().map(|id| bound(*id)).sum::<f32>() / into.len() as f32
}

/// What became of lumps in a tick. Buffers are kept.
#[derive(Clone, Debug, Default)]
pub struct Relabelled {
    /// Where lumps are another element than before, or gone, d.
    pub places: Vec<Vec2>,
    /// Density of the air that takes what gas they give off, kg/m²; none where they give off none.
    pub air: Option<f32>,
    /// Gas that they gave off, or took.
    pub releases: Vec<Release>,
    /// Particles that go.
    gone: Vec<bool>,
    /// Particles in each cell of the box, where one of them may become rock.
    crowd: Vec<u8>,
}

impl Relabelled {
    /// Begins a tick.
    pub fn begin(&mut self) {
        self.places.clear();
        self.releases.clear();
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

    /// Gives a particle that [can be it](Relabelled::can_be) another element; none is air. `gas`: what it gives off, d².
    pub fn particle(
        &mut self,
        warm: &mut Warm,
        record: &mut HeatRecord,
        i: usize,
        product: Option<ElementId>,
        gas: f32,
    ) {
        let Warm { particles, solids, elements, table, .. } = warm;
        let at = particles.position(i);
        self.places.push(at);
        let from = (particles.element[i], particles.heat_of(i));
        let heat = self.give_off(table, record, from, product, (at, gas));
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

    /// Whether rock can become this where it is: what moves is pushed off the walls of the box, out of a cell of which they leave
    /// less than that. There no other rock may stand, or come to stand as a particle `beside` becomes rock.
    pub fn rock_can_be(warm: &Warm, cell: IVec2, product: Option<ElementId>, beside: Option<IVec2>) -> bool {
        if product.is_none_or(|product| warm.elements.get(product).fixed) {
            return true;
        }
        let lands = Solids::cell_of(warm.domain.keep_inside(centre(cell)));
        lands == cell || !warm.solids.is_solid(lands) && beside != Some(lands)
    }

    /// Gives rock that [can be it](Relabelled::rock_can_be) another element; none is air. `gas`: what it gives off, d².
    pub fn rock(
        &mut self,
        warm: &mut Warm,
        record: &mut HeatRecord,
        cell: IVec2,
        product: Option<ElementId>,
        gas: f32,
    ) {
        let Warm { particles, solids, elements, domain, table, .. } = warm;
        let Some((element, id)) = solids.get(cell) else { return };
        let heat = self.give_off(table, record, (element, solids.heat(cell)), product, (centre(cell), gas));
        self.places.push(centre(cell));
        match product {
            Some(product) if elements.get(product).fixed => {
                solids.replace(cell, product);
                solids.set_heat(cell, heat);
            }
            Some(product) => {
                solids.remove(cell);
                // A cell that the box ends in may have its centre beyond the wall.
                particles.push_warm(id, product, domain.keep_inside(centre(cell)), Vec2::ZERO, heat);
            }
            None => {
                solids.remove(cell);
                record.gone += 1;
            }
        }
        record.turned += 1;
    }

    /// Heat that a lump has as another element, quanta, once it gave off what gas it does, which is as warm as it is then.
    fn give_off(
        &mut self,
        table: &HeatTable,
        record: &mut HeatRecord,
        (from, before): (ElementId, i32),
        product: Option<ElementId>,
        (at, amount): (Vec2, f32),
    ) -> i32 {
        let heat = heat_as(table, record, from, product, before);
        let Some(density) = self.air.filter(|_| amount != 0.0) else { return heat };
        let (element, held) = product.map_or((from, before), |product| (product, heat));
        let release = Release { at, amount, kelvin: table.curve(element).temperature(held).clamp(COLDEST, HOTTEST) };
        self.releases.push(release);
        let taken = if product.is_some() { release.heat(density) } else { 0 };
        record.to_air += i64::from(taken);
        heat - taken
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
