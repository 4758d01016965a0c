//! How warm lumps are by their heat.

use super::{slopes::Slopes, table::HeatTable};
use crate::{
    element::ElementId,
    simd::{Lanes, MOST_LANES, Pass},
};

/// Finds temperature and √k′ of lumps.
pub(super) struct FindStates<'a> {
    pub table: &'a HeatTable,
    pub slopes: &'a Slopes,
    pub heat: &'a [i32],
    pub element: &'a [ElementId],
    /// 1 at sites with rock, 0 at others; sites are the first lumps.
    pub present: &'a [f32],
    /// Whether anything changed among [`MOST_LANES`] lumps that follow each other, an entry for so many; all may have if it is empty.
    pub changes: &'a [bool],
    /// The first lump of those that are written.
    pub base: usize,
    /// Out: temperature, K, and √k′, √(W/mK), 0 at sites without rock.
    pub out: [&'a mut [f32]; 2],
}

impl Pass for FindStates<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { table, slopes, heat, element, present, changes, base, out: [kelvin, conduction] } = self;
        for first in (0..kelvin.len()).step_by(MOST_LANES) {
            let has_changes = changes.get((base + first) / MOST_LANES);
            if !has_changes.is_none_or(|changes| *changes) {
                continue;
            }
            let end = (first + MOST_LANES).min(kelvin.len());
            let (heat, element) = (&heat[base + first..base + end], &element[base + first..base + end]);
            let (kelvin, conduction) = (&mut kelvin[first..end], &mut conduction[first..end]);
            let whole = heat.first_chunk::<MOST_LANES>().zip(kelvin.first_chunk_mut::<MOST_LANES>());
            let alike = element.iter().all(|of| *of == element[0]);
            match whole.filter(|(heat, _)| alike && slopes.are_on(element[0], heat)) {
                Some((heat, kelvin)) => {
                    let of_all = slopes.of(element[0]);
                    heat.iter().zip(kelvin).for_each(|(heat, kelvin)| *kelvin = of_all.temperature(*heat));
                    conduction.fill(of_all.conduction);
                }
                None => {
                    let lumps = heat.iter().zip(element).zip(kelvin.iter_mut().zip(conduction.iter_mut()));
                    lumps.for_each(|((heat, element), (kelvin, conduction))| {
                        (*kelvin, *conduction) = slopes.state(table, *element, *heat);
                    });
                }
            }
            let sites = present.get(base + first..).unwrap_or_default();
            conduction.iter_mut().zip(sites).for_each(|(conduction, present)| *conduction *= present);
        }
    }
}
