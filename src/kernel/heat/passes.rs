//! The two passes of the exchange over lumps that stand in the order of their cells: lanes over lumps that follow each other, and
//! those around them one by one.
//!
//! What is beyond a lump's reach has no weight, and adds 0 to its sums: so a lane finds what its lump would by itself, to the bit.

use super::{
    lumps::Lumps,
    rates::Rates,
    surface::open_length,
    table::HeatTable,
    units::{QUANTUM, ROOM},
    walls::Walls,
    weights::{WEIGHT, weight},
};
use crate::simd::{Lanes, MOST_LANES, Pass, rounded};
use glam::Vec2;
use std::ops::Range;

/// Lumps that are worked on side by side, and all those around any of them.
struct Group {
    lumps: Range<usize>,
    around: [Range<usize>; 3],
}

/// The lumps `range` in groups of up to `width`, each in one row of cells and with any in one of `cells`.
#[inline(always)]
fn groups(lumps: &Lumps, cells: &[bool], range: Range<usize>, width: usize) -> impl Iterator<Item = Group> {
    let mut next = range.start;
    std::iter::from_fn(move || {
        while next < range.end {
            let first = next;
            let end = lumps.row_end(first).min(range.end).min(first + width);
            next = end;
            if lumps.cell[first..end].iter().any(|cell| cells[*cell as usize]) {
                return Some(Group { lumps: first..end, around: lumps.around(first..end) });
            }
        }
        None
    })
}

/// Places of a group's lumps, d.
#[derive(Clone, Copy)]
struct Places<L>([L; 2]);

impl<L: Lanes> Places<L> {
    #[inline(always)]
    fn load(lumps: &Lumps, group: &Group) -> Self {
        Self([&lumps.x, &lumps.y].map(|field| L::load(&field[group.lumps.clone()])))
    }

    /// The weights of lump `j` beside each.
    #[inline(always)]
    fn weights_of(self, lumps: &Lumps, j: usize) -> L {
        let [x, y] = self.0;
        weight(L::splat(lumps.x[j]) - x, L::splat(lumps.y[j]) - y)
    }
}

/// Finds how much each lump can exchange, and how much of its surface is open. Those of groups in which nothing flows are left as
/// they are.
pub(super) struct LookAround<'a> {
    pub lumps: &'a Lumps,
    pub table: &'a HeatTable,
    pub walls: &'a Walls,
    pub size: Vec2,
    pub rates: &'a Rates,
    pub conduction: &'a [f32],
    /// The first lump of those that are written.
    pub base: usize,
    /// Out: allowance and surface.
    pub out: [&'a mut [f32]; 2],
}

impl Pass for LookAround<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { lumps, table, walls, size, rates, conduction, base, out: [allowance, surface] } = self;
        for group in groups(lumps, &lumps.flows, base..base + allowance.len(), L::WIDTH) {
            let places = Places::<L>::load(lumps, &group);
            let (mut whole, mut through) = (L::splat(0.0), L::splat(0.0));
            for run in &group.around {
                for j in run.clone() {
                    let weight = places.weights_of(lumps, j);
                    whole = whole + weight;
                    through = through + weight * L::splat(conduction[j]);
                }
            }
            let mut sums = [[0.0; MOST_LANES]; 2];
            whole.store(&mut sums[0]);
            through.store(&mut sums[1]);
            for (lane, i) in group.lumps.enumerate() {
                // It is its own neighbour in that sum.
                let [whole, through] = [sums[0][lane] - WEIGHT, sums[1][lane] - WEIGHT * conduction[i]];
                let beyond = walls.around(Vec2::new(lumps.x[i], lumps.y[i]), size);
                let curve = table.curve(lumps.element[i]);
                let open = curve.openness() * open_length(whole + beyond);
                // What the air may take is not there for the others.
                let asked = rates.pairs * conduction[i] * through;
                let held = curve.least_capacity() / QUANTUM;
                let left = held / (1.0 + rates.air * open / held);
                surface[i - base] = open;
                allowance[i - base] = if asked > 0.0 { left / asked } else { f32::MAX };
            }
        }
    }
}

/// Finds what flows in a step.
pub(super) struct Flow<'a> {
    pub lumps: &'a Lumps,
    pub table: &'a HeatTable,
    /// Those of a step.
    pub rates: &'a Rates,
    /// Cells in which anything flows in this step.
    pub cells: &'a [bool],
    pub kelvin: &'a [f32],
    pub conduction: &'a [f32],
    pub allowance: &'a [f32],
    /// 1 for lumps that take a whole tick's exchange at once, else 0.
    pub once: &'a [f32],
    /// How many steps' exchange two of those have in this step beside its own: that of all others in the first, −1 in the others, 0
    /// where a tick is one step.
    pub more: f32,
    pub surface: &'a [f32],
    /// The first lump of those that are written.
    pub base: usize,
    /// Out: what they gain from pairs, and give to the air, quanta.
    pub out: [&'a mut [i32]; 2],
}

impl Pass for Flow<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { lumps, table, rates, cells, kelvin, conduction, allowance, once, more, surface, base, out } = self;
        let [gained, given] = out;
        gained.fill(0);
        given.fill(0);
        for group in groups(lumps, cells, base..base + gained.len(), L::WIDTH) {
            let places = Places::<L>::load(lumps, &group);
            let own = |field: &[f32]| L::load(&field[group.lumps.clone()]);
            let (own_kelvin, own_conduction, most) = (own(kelvin), own(conduction), own(allowance));
            let own_more = own(once) * L::splat(more);
            let mut sums = L::no_sums();
            for run in &group.around {
                for j in run.clone() {
                    let share = L::splat(allowance[j]).min(most);
                    // The product of both comes first, so that the other lump finds the same to the bit.
                    let mut rate = own_conduction * L::splat(conduction[j]) * L::splat(rates.pairs) * share;
                    if more != 0.0 {
                        rate = rate * (L::splat(1.0) + own_more * L::splat(once[j]));
                    }
                    let flow = rate * places.weights_of(lumps, j) * (L::splat(kelvin[j]) - own_kelvin);
                    sums = flow.add_rounded(sums);
                }
            }
            gained[group.lumps.start - base..group.lumps.end - base]
                .copy_from_slice(&L::sums(sums)[..group.lumps.len()]);
            for i in group.lumps.filter(|i| cells[lumps.cell[*i] as usize]) {
                let open = rates.air * (1.0 + more * once[i]) * surface[i];
                let held = table.curve(lumps.element[i]).least_capacity() / QUANTUM;
                given[i - base] = rounded(open / (1.0 + open / held) * (kelvin[i] - ROOM));
            }
        }
    }
}
