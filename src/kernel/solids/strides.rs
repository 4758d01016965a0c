//! Rock in strides: some cells of a row at once, passed over where none is rock.

use super::{EMPTY, Solids};
use crate::element::ElementId;
use glam::IVec2;

/// Cells of a row that are looked at together: passed over where none is rock.
pub(crate) const STRIDE: usize = 16;

/// [`STRIDE`] cells of a row, at its end fewer, with rock in any of them.
pub(crate) struct Stride<'a> {
    /// The first cell.
    pub first: IVec2,
    /// Elements, [`EMPTY`] where is no rock.
    elements: &'a [u8],
    /// Heat, quanta; empty if there has been none.
    heats: &'a [i32],
    /// Where the first cell is stored.
    pub(super) place: usize,
}

impl<'a> Stride<'a> {
    /// Number of cells.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// The cells with their elements; `None` where is no rock.
    #[inline(always)]
    pub fn sites(&self) -> impl Iterator<Item = (usize, Option<ElementId>)> + use<'a> {
        let element = |element: &u8| (*element != EMPTY).then_some(ElementId(*element));
        self.elements.iter().map(element).enumerate()
    }

    /// Heat in one of the cells, quanta; 0 where is no rock.
    #[inline(always)]
    pub fn heat(&self, k: usize) -> i32 {
        self.heats.get(k).copied().unwrap_or_default()
    }
}

impl Solids {
    /// The strides with rock, row by row from the bottom.
    #[inline(always)]
    pub(crate) fn strides(&self) -> impl Iterator<Item = Stride<'_>> {
        let columns = self.columns.max(1) as usize;
        let rows = self.element.chunks(columns).enumerate();
        rows.flat_map(move |(y, row)| {
            let strides = row.chunks(STRIDE).zip((0..).step_by(STRIDE));
            let rocky = strides.filter(|(elements, _)| has_rock(elements));
            rocky.map(move |(elements, x)| {
                let place = y * columns + x;
                let heats = self.heat.get(place..place + elements.len()).unwrap_or_default();
                Stride { first: IVec2::new(x as i32, y as i32), elements, heats, place }
            })
        })
    }

    /// Gives the rock of a stride that begins with this cell these heats, quanta; those where is none are 0.
    pub(crate) fn set_heats(&mut self, first: IVec2, heats: &[i32]) {
        let heats = &heats[..heats.len().min((self.columns - first.x).max(0) as usize)];
        if self.heat.is_empty() && heats.iter().any(|heat| *heat != 0) {
            self.heat = vec![0; self.element.len()];
        }
        if let Some(place) = self.index(first).filter(|_| !self.heat.is_empty()) {
            self.heat[place..place + heats.len()].copy_from_slice(heats);
        }
    }
}

/// Whether any of a stride's cells is rock. A whole one is compared at once, for which its length must be known.
#[inline(always)]
fn has_rock(elements: &[u8]) -> bool {
    match elements.first_chunk::<STRIDE>() {
        Some(whole) => *whole != [EMPTY; STRIDE],
        None => elements.iter().any(|element| *element != EMPTY),
    }
}

#[cfg(test)]
mod tests {
    use super::{super::tests::with_rock, *};

    #[test]
    fn a_strides_heat_is_that_of_its_cells() {
        let mut solids = with_rock(&[(96, 7), (99, 7), (3, 7)]);
        solids.set_heats(IVec2::new(96, 7), &[0; STRIDE]);
        assert!(solids.heats().is_empty(), "room for no heat");
        // The last stride of a row is shorter.
        let mut heats = [0; STRIDE];
        (heats[0], heats[3]) = (5, -6);
        solids.set_heats(IVec2::new(96, 7), &heats);
        let found: Vec<_> =
            solids.strides().map(|stride| (stride.first.x, stride.len(), stride.heat(0), stride.heat(3))).collect();
        assert_eq!(found, [(0, 16, 0, 0), (96, 4, 5, -6)]);
        assert_eq!([99, 96, 3].map(|x| solids.heat(IVec2::new(x, 7))), [-6, 5, 0]);
        assert_eq!(solids.heats().iter().filter(|heat| **heat != 0).count(), 2);
    }
}
