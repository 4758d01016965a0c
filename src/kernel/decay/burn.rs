//! Lumps whose die fell become what their decay says.

use super::table::{Decay, DecayTable, OPEN};
use crate::{
    element::ElementId,
    heat::{DECAY, Exposure, HeatRecord, Warm, table::HeatTable, units::ROOM},
    random::mix,
    relabel::{Relabelled, gas_of},
    solids::centre,
};
use glam::{IVec2, Vec2};

/// Sets the dice of decay apart from others of the same lump and tick.
const SALT: u32 = 0x6275_726e;

/// Buffers of the decays, which are kept.
#[derive(Clone, Debug, Default)]
pub struct Decays {
    exposure: Exposure,
    /// Particles and rock that decay in this tick.
    particles: Vec<u32>,
    rock: Vec<IVec2>,
}

impl Decays {
    /// Lets what is hot enough decay for a tick. `relabelled` gets who is another element.
    pub fn run(
        &mut self,
        warm: &mut Warm,
        decays: &DecayTable,
        record: &mut HeatRecord,
        relabelled: &mut Relabelled,
        tick: u64,
    ) {
        relabelled.begin();
        self.throw(warm, decays, mix(tick as u32 ^ SALT));
        self.keep_exposed(warm, decays);
        // What becomes rock and what was rock change places: those that move go first, by their places in the store.
        for i in self.particles.iter().map(|i| *i as usize) {
            let (element, heat) = (warm.particles.element[i], warm.particles.heat_of(i));
            let Some(decay) = decays.of(element) else { continue };
            let product = record.next(element, DECAY, &decay.into);
            if relabelled.can_be(warm, i, product) {
                warm.particles.set_heat(i, settle(warm.table, record, decay, element, product, heat));
                let gas = gas_of(warm.elements, element, &decay.into);
                relabelled.particle(warm, record, i, product, gas);
            }
        }
        relabelled.end(warm.particles);
        for cell in &self.rock {
            let Some((element, _)) = warm.solids.get(*cell) else { continue };
            let (Some(decay), heat) = (decays.of(element), warm.solids.heat(*cell)) else { continue };
            let product = record.next(element, DECAY, &decay.into);
            if !Relabelled::rock_can_be(warm, *cell, product, None) {
                continue;
            }
            warm.solids.set_heat(*cell, settle(warm.table, record, decay, element, product, heat));
            let gas = gas_of(warm.elements, element, &decay.into);
            relabelled.rock(warm, record, *cell, product, gas);
        }
    }

    /// Finds the lumps that are hot enough and whose die falls.
    fn throw(&mut self, warm: &Warm, decays: &DecayTable, tick: u32) {
        let Warm { particles, solids, table, .. } = warm;
        let falls = |element: ElementId, id: u32, heat: i32| {
            let Some(decay) = decays.of(element) else { return false };
            mix(id ^ tick) < decay.threshold && table.curve(element).temperature(heat) >= decay.above
        };
        self.particles.clear();
        let fallen = |i: &u32| {
            let i = *i as usize;
            falls(particles.element[i], particles.id[i], particles.heat_of(i))
        };
        self.particles.extend((0..particles.len() as u32).filter(fallen));
        self.rock.clear();
        solids.iter().for_each(|(cell, element, id)| {
            if falls(element, id, solids.heat(cell)) {
                self.rock.push(cell);
            }
        });
    }

    /// Leaves out those that need air and have none, before any of them is something else.
    fn keep_exposed(&mut self, warm: &Warm, decays: &DecayTable) {
        let Self { exposure, particles, rock } = self;
        let needs_air = |element: ElementId| decays.of(element).is_some_and(|decay| decay.needs_air);
        let of_rock = |cell: IVec2| warm.solids.get(cell).map(|(element, _)| element);
        let of_particle = |i: u32| warm.particles.element[i as usize];
        if !particles.iter().any(|i| needs_air(of_particle(*i)))
            && !rock.iter().any(|cell| of_rock(*cell).is_some_and(needs_air))
        {
            return;
        }
        exposure.gather(warm.particles, warm.domain.size);
        let matter = (&*warm.particles, &*warm.solids, warm.elements);
        let has_air = |element: ElementId, at: Vec2| !needs_air(element) || exposure.of(matter, element, at) >= OPEN;
        particles.retain(|i| has_air(of_particle(*i), warm.particles.position(*i as usize)));
        rock.retain(|cell| of_rock(*cell).is_some_and(|element| has_air(element, centre(*cell))));
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.exposure.memory() + 4 * self.particles.capacity() + size_of::<IVec2>() * self.rock.capacity()
    }
}

/// Notes that a lump of an element decays, and returns what it keeps of its heat, quanta.
fn settle(
    table: &HeatTable,
    record: &mut HeatRecord,
    decay: &Decay,
    element: ElementId,
    product: Option<ElementId>,
    heat: i32,
) -> i32 {
    let spare = spare(table, decay, element, product, heat);
    record.to_air += i64::from(spare);
    record.count(element, DECAY);
    heat - spare
}

/// Heat that a product leaves to the air, quanta. Several of one lump are to be as hot as each other, but each lump becomes one of
/// them and keeps its energy: one that holds little, as ash does beside fire, would come out far hotter than what it is made with.
/// No shares by product, as where matter parts at one temperature, would do: what is given off is the same at any temperature.
fn spare(table: &HeatTable, decay: &Decay, element: ElementId, product: Option<ElementId>, heat: i32) -> i32 {
    let Some(product) = product.filter(|_| decay.into.len() > 1) else { return 0 };
    let energy = |element: ElementId| f64::from(table.energy(element));
    let has = f64::from(heat) + energy(element);
    // At the temperature that all come to, if all of what they have is theirs together.
    let (mut all, mut capacity) = (0.0, 0.0);
    for other in decay.into.iter().flatten() {
        let curve = table.curve(*other);
        all += has - energy(*other) - f64::from(curve.heat(ROOM));
        capacity += curve.quanta_per_kelvin();
    }
    let degrees = all / capacity;
    let curve = table.curve(product);
    let holds = f64::from(curve.heat(ROOM)) + curve.quanta_per_kelvin() * degrees;
    (has - energy(product) - holds).clamp(0.0, f64::from(i32::MAX) / 2.0) as i32
}
