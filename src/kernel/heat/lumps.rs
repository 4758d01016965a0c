//! The lumps that exchange heat, and those around them: rock on its lattice, and what moves, cell by cell.

use super::{
    grid::HeatGrid,
    matter::Warm,
    rates::Rates,
    sites::{PIECE, Sites},
    sorted::Sorted,
};
use crate::{
    element::ElementId,
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};

/// What exchanges heat. Fields of lumps have an entry a lump: first the [`Sites`] of rock, blank ones among them, then what moves.
#[derive(Clone, Debug, Default)]
pub(super) struct Lumps {
    pub grid: HeatGrid,
    pub sites: Sites,
    /// What moves, from its particles.
    pub moving: Sorted,
    /// Rock that something that moves may reach, from its sites.
    pub shore: Sorted,
    /// Heat, quanta.
    pub heat: Vec<i32>,
    /// 0 at sites without rock.
    pub element: Vec<ElementId>,
    /// 1 at sites with rock, 0 at others.
    pub present: Vec<f32>,
    /// Cell of each site.
    pub cell: Vec<u32>,
    /// Cells that reach one with something that moves, and rock in them.
    reached: Vec<bool>,
    near: Vec<u32>,
}

impl Lumps {
    /// Whether nothing flows anywhere.
    pub fn is_empty(&self) -> bool {
        self.heat.is_empty()
    }

    /// Number of lumps.
    pub fn len(&self) -> usize {
        self.heat.len()
    }

    /// Gathers the lumps.
    pub fn gather(&mut self, warm: &Warm, rates: &Rates) {
        self.grid.find(warm, rates);
        self.heat.clear();
        self.element.clear();
        self.cell.clear();
        self.present.clear();
        self.sites.clear(warm.solids.columns(), warm.solids.rows());
        if self.grid.flows.contains(&true) {
            self.gather_rock(warm);
            self.gather_moving(warm);
            self.find_shore(warm.solids);
        } else {
            [&mut self.moving, &mut self.shore].into_iter().for_each(Sorted::clear);
        }
    }

    fn gather_rock(&mut self, warm: &Warm) {
        let Self { grid, sites, heat, element, present, cell, .. } = self;
        warm.solids.strides().filter(|stride| grid.needs(stride)).for_each(|stride| {
            let first = sites.keep(stride.first);
            blank_to(first + PIECE, heat, element, present, cell);
            let (heat, element) = (&mut heat[first..], &mut element[first..]);
            let (present, cell) = (&mut present[first..], &mut cell[first..]);
            for ((k, rock), of) in stride.sites().zip(grid.of_stride(&stride)) {
                heat[k] = stride.heat(k);
                element[k] = rock.unwrap_or_default();
                present[k] = f32::from(u8::from(rock.is_some()));
                cell[k] = of as u32;
            }
        });
        sites.end();
        blank_to(sites.len(), heat, element, present, cell);
    }

    fn gather_moving(&mut self, warm: &Warm) {
        let Self { grid, moving, heat, element, .. } = self;
        let particles = &*warm.particles;
        let needed = grid.of_particles.iter().enumerate().filter(|(_, cell)| grid.needed[**cell as usize]);
        moving.sort(grid.len(), needed.map(|(i, cell)| (*cell as usize, particles.position(i), i as u32)));
        heat.extend(moving.source.iter().map(|i| particles.heat_of(*i as usize)));
        element.extend(moving.source.iter().map(|i| particles.element[*i as usize]));
    }

    fn find_shore(&mut self, solids: &Solids) {
        let Self { grid, sites, moving, shore, present, cell, reached, near, .. } = self;
        reached.clear();
        reached.resize(grid.len(), false);
        moving.cells().for_each(|cell| grid.mark_around(cell, reached));
        near.clear();
        for (first, site) in sites.pieces() {
            let at = |place: u32| site + IVec2::new((place as usize - first) as i32, 0);
            let lanes = first..first + PIECE;
            // Of a row's sites the cells follow each other.
            let last = cell[lanes.clone()].iter().max().copied().unwrap_or_default() as usize;
            if !reached[cell[first] as usize..=last].contains(&true) {
                continue;
            }
            let rock = present[lanes.clone()].iter().zip(&cell[lanes]).zip(first as u32..);
            let rock = rock.filter(|((present, cell), _)| **present != 0.0 && reached[**cell as usize]);
            // What moves is not in rock, and can't reach what stands so deep in it.
            near.extend(rock.map(|(_, place)| place).filter(|place| !solids.is_deep(at(*place))));
        }
        let lump = |place: &u32| {
            let k = *place as usize;
            sites.at(k).map(|site| (cell[k] as usize, centre(site), *place))
        };
        shore.sort(grid.len(), near.iter().filter_map(lump));
    }

    /// The cell of a lump.
    #[inline(always)]
    pub fn cell_of(&self, k: usize) -> usize {
        match k.checked_sub(self.sites.len()) {
            None => self.cell[k] as usize,
            Some(k) => self.moving.cell[k] as usize,
        }
    }

    /// Where a lump is, d; `None` if it is a blank piece's site.
    pub fn position(&self, k: usize) -> Option<Vec2> {
        match k.checked_sub(self.sites.len()) {
            None => self.sites.at(k).map(centre),
            Some(k) => Some(Vec2::new(self.moving.x[k], self.moving.y[k])),
        }
    }

    /// Gives particles and rock what heat they have now.
    pub fn hand_back(&self, warm: &mut Warm) {
        for (first, site) in self.sites.pieces() {
            warm.solids.set_heats(site, &self.heat[first..first + PIECE]);
        }
        for (source, heat) in self.moving.source.iter().zip(&self.heat[self.sites.len()..]) {
            warm.particles.set_heat(*source as usize, *heat);
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { grid, sites, moving, shore, heat, element, present, cell, reached, near } = self;
        let words = heat.capacity() + present.capacity() + cell.capacity() + near.capacity();
        4 * words
            + element.capacity()
            + reached.capacity()
            + grid.memory()
            + sites.memory()
            + [moving, shore].map(Sorted::memory).iter().sum::<usize>()
    }
}

/// Makes fields of sites so long, with nothing at those that are new.
fn blank_to(
    len: usize,
    heat: &mut Vec<i32>,
    element: &mut Vec<ElementId>,
    present: &mut Vec<f32>,
    cell: &mut Vec<u32>,
) {
    heat.resize(len, 0);
    element.resize(len, ElementId(0));
    present.resize(len, 0.0);
    cell.resize(len, 0);
}
