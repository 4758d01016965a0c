//! Where heat may flow: cells of the exchange's reach, and how warm it is in each.

use super::{matter::Warm, rates::Rates, slopes::Slopes, units::ROOM, weights::REACH};
use crate::{element::ElementId, solids::Stride};
use glam::Vec2;
use std::ops::Range;

/// How warm it is in a cell.
#[derive(Clone, Copy, Debug)]
struct Span {
    coldest: f32,
    hottest: f32,
    /// Highest √k′, √(W/mK).
    conduction: f32,
}

const NOTHING: Span = Span { coldest: f32::MAX, hottest: f32::MIN, conduction: 0.0 };

impl Span {
    /// Of a lump of this temperature (K) and √k′ (√(W/mK)).
    #[inline(always)]
    fn of_lump((kelvin, conduction): (f32, f32)) -> Self {
        Self { coldest: kelvin, hottest: kelvin, conduction }
    }

    #[inline(always)]
    fn join(&mut self, other: Self) {
        // All are numbers: `min` and `max` would ask whether they are.
        *self = Self {
            coldest: if other.coldest < self.coldest { other.coldest } else { self.coldest },
            hottest: if other.hottest > self.hottest { other.hottest } else { self.hottest },
            conduction: if other.conduction > self.conduction { other.conduction } else { self.conduction },
        };
    }
}

/// Cells of the exchange's reach, row by row, with one before and one behind each row, and a row below and above the box.
#[derive(Clone, Debug, Default)]
pub(super) struct HeatGrid {
    /// Cells of a row.
    stride: usize,
    rows: usize,
    /// Whether anything may flow in a cell.
    pub flows: Vec<bool>,
    /// Cells whose lumps are needed: those in which anything flows, and those around them.
    pub needed: Vec<bool>,
    /// Cell of each particle.
    pub of_particles: Vec<u32>,
    spans: Vec<Span>,
    /// Those of each cell and the one on either side together.
    beside: Vec<Span>,
    /// How warm elements are by their heat.
    pub slopes: Slopes,
    /// Where the sites of each column are in a row of cells.
    of_columns: Vec<u32>,
}

impl HeatGrid {
    /// Number of cells.
    pub fn len(&self) -> usize {
        self.flows.len()
    }

    /// The row of a cell.
    #[inline(always)]
    pub fn row(&self, cell: usize) -> usize {
        cell / self.stride
    }

    /// The first cell of a row.
    #[inline(always)]
    pub fn first_of(&self, row: usize) -> usize {
        row * self.stride
    }

    /// The cells that reach what is in some cells of a row, a run of each of three rows.
    #[inline(always)]
    pub fn around(&self, first: usize, last: usize) -> [Range<usize>; 3] {
        let stride = self.stride;
        [first - stride..last - stride, first..last, first + stride..last + stride]
            .map(|run| run.start - 1..run.end + 2)
    }

    /// Marks a cell, and those around it.
    pub fn mark_around(&self, cell: usize, marks: &mut [bool]) {
        self.around(cell, cell).into_iter().for_each(|cells| marks[cells].fill(true));
    }

    /// The cells of the sites of a stride.
    #[inline(always)]
    pub fn of_stride(&self, stride: &Stride) -> impl DoubleEndedIterator<Item = usize> {
        let [x, y] = stride.first.to_array();
        let row = self.first_of(along(y as f32 + 0.5, self.rows));
        let columns = &self.of_columns[x as usize..x as usize + stride.len()];
        columns.iter().map(move |column| row + *column as usize)
    }

    /// Whether lumps of a stride are needed.
    pub fn needs(&self, stride: &Stride) -> bool {
        let (first, last) = (self.of_stride(stride).next(), self.of_stride(stride).next_back());
        first.zip(last).is_some_and(|(first, last)| self.needed[first..=last].contains(&true))
    }

    /// Finds where anything may flow.
    pub fn find(&mut self, warm: &Warm, rates: &Rates) {
        let size = warm.domain.size;
        (self.stride, self.rows) = ((size.x / REACH) as usize + 3, (size.y / REACH) as usize + 3);
        self.of_columns.clear();
        self.of_columns.extend((0..warm.solids.columns()).map(|x| along(x as f32 + 0.5, self.stride) as u32));
        self.measure(warm);
        self.find_flows(rates);
    }

    fn of(&self, at: Vec2) -> usize {
        along(at.y, self.rows) * self.stride + along(at.x, self.stride)
    }

    /// Finds how warm it is in each cell.
    fn measure(&mut self, warm: &Warm) {
        let Warm { particles, solids, table, .. } = warm;
        self.spans.clear();
        self.spans.resize(self.stride * self.rows, NOTHING);
        self.slopes.follow(table);
        let slopes = std::mem::take(&mut self.slopes);
        let span_of = |element: ElementId, heat: i32| Span::of_lump(slopes.state(table, element, heat));
        let mut spans = std::mem::take(&mut self.spans);
        let mut of_particles = std::mem::take(&mut self.of_particles);
        of_particles.clear();
        for i in 0..particles.len() {
            let cell = self.of(particles.position(i));
            of_particles.push(cell as u32);
            spans[cell].join(span_of(particles.element[i], particles.heat_of(i)));
        }
        // What follows each other in a cell is joined to it at once, and rock that is like the last by itself adds nothing.
        let (mut last, mut joined, mut like) = (0, NOTHING, None);
        solids.strides().for_each(|stride| {
            for ((k, element), cell) in stride.sites().zip(self.of_stride(&stride)) {
                let Some(element) = element else { continue };
                if cell != last {
                    spans[last].join(joined);
                    (last, joined, like) = (cell, NOTHING, None);
                }
                let heat = stride.heat(k);
                if like != Some((element, heat)) {
                    joined.join(span_of(element, heat));
                    like = Some((element, heat));
                }
            }
        });
        spans[last].join(joined);
        (self.spans, self.of_particles, self.slopes) = (spans, of_particles, slopes);
    }

    /// Finds the cells in which anything may flow: where the furthest temperatures nearby, those of the air among them, would
    /// give half a quantum to a pair.
    fn find_flows(&mut self, rates: &Rates) {
        let Self { stride, rows, spans, beside, flows, needed, .. } = self;
        beside.clear();
        beside.resize(spans.len(), NOTHING);
        for (beside, spans) in beside[1..].iter_mut().zip(spans.windows(3)) {
            spans.iter().for_each(|span| beside.join(*span));
        }
        flows.clear();
        flows.resize(spans.len(), false);
        needed.clear();
        needed.resize(spans.len(), false);
        for row in 1..*rows - 1 {
            for column in 1..*stride - 1 {
                let cell = row * *stride + column;
                if spans[cell].conduction == 0.0 && spans[cell].coldest > spans[cell].hottest {
                    continue;
                }
                let mut near = Span { coldest: ROOM, hottest: ROOM, conduction: 0.0 };
                let around = [cell - *stride, cell, cell + *stride];
                around.iter().for_each(|row| near.join(beside[*row]));
                if rates.may_flow(near.hottest - near.coldest, near.conduction) {
                    flows[cell] = true;
                    around.into_iter().for_each(|row| needed[row - 1..row + 2].fill(true));
                }
            }
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { flows, needed, of_particles, spans, beside, slopes, of_columns, .. } = self;
        flows.capacity()
            + needed.capacity()
            + 4 * (of_particles.capacity() + of_columns.capacity())
            + size_of::<Span>() * (spans.capacity() + beside.capacity())
            + slopes.memory()
    }
}

/// Where a place is among so many cells along a side.
#[inline(always)]
fn along(at: f32, cells: usize) -> usize {
    ((at * (1.0 / REACH)) as usize + 1).min(cells - 2)
}
