//! The lumps that exchange heat, and those around them: gathered cell by cell, so that what is near stands together.

use super::{curve::HeatCurve, matter::Warm, rates::Rates, table::HeatTable, units::ROOM, weights::REACH};
use crate::{element::ElementId, solids::centre};
use glam::{IVec2, Vec2};
use std::ops::Range;

/// Marks a lump as rock; the rest is its place in the list of rock.
const ROCK: u32 = 1 << 31;

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
    /// Of a lump that holds so many quanta.
    fn of_lump(curve: &HeatCurve, heat: i32) -> Self {
        let kelvin = curve.temperature(heat);
        Self { coldest: kelvin, hottest: kelvin, conduction: curve.conduction(heat) }
    }

    fn join(&mut self, other: Self) {
        self.coldest = self.coldest.min(other.coldest);
        self.hottest = self.hottest.max(other.hottest);
        self.conduction = self.conduction.max(other.conduction);
    }
}

/// Lumps in cells of the exchange's reach, in the order of the cells. The arrays have an entry a lump.
#[derive(Clone, Debug, Default)]
pub(super) struct Lumps {
    /// Cells of a row, with one before and one behind the box.
    pub stride: usize,
    rows: usize,
    /// Place, d.
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    /// Heat, quanta.
    pub heat: Vec<i32>,
    pub element: Vec<ElementId>,
    /// Cell.
    pub cell: Vec<u32>,
    /// Particle, or place in `rock` with [`ROCK`].
    source: Vec<u32>,
    /// The first lump of each cell, and the end.
    starts: Vec<u32>,
    /// Whether anything may flow in a cell.
    pub flows: Vec<bool>,
    /// Cells whose lumps are needed: those in which anything flows, and those around them.
    needed: Vec<bool>,
    spans: Vec<Span>,
    /// Those of each cell and the one on either side together.
    beside: Vec<Span>,
    /// How warm lumps of each element are that hold no heat, as most do.
    without_heat: Vec<Span>,
    /// Cell of each particle.
    of_particles: Vec<u32>,
    /// Rock that is needed.
    rock: Vec<IVec2>,
}

impl Lumps {
    /// Whether nothing flows anywhere.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Number of lumps.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// The cells that reach what is in a cell, three of each row.
    pub fn cells_around(&self, cell: usize) -> [Range<usize>; 3] {
        around(cell, self.stride)
    }

    /// The end of the lumps in a lump's row of cells.
    #[inline(always)]
    pub fn row_end(&self, i: usize) -> usize {
        let row = self.cell[i] as usize / self.stride;
        self.starts[(row + 1) * self.stride] as usize
    }

    /// The lumps in the three rows of cells around lumps that follow each other in a row.
    #[inline(always)]
    pub fn around(&self, lumps: Range<usize>) -> [Range<usize>; 3] {
        let [first, last] = [lumps.start, lumps.end - 1].map(|i| self.cell[i] as usize);
        let run = |first: usize, last: usize| self.starts[first - 1] as usize..self.starts[last + 2] as usize;
        let stride = self.stride;
        [run(first - stride, last - stride), run(first, last), run(first + stride, last + stride)]
    }

    /// Gathers the lumps.
    pub fn gather(&mut self, warm: &Warm, rates: &Rates) {
        let size = warm.domain.size;
        (self.stride, self.rows) = ((size.x / REACH) as usize + 3, (size.y / REACH) as usize + 3);
        let cells = self.stride * self.rows;
        self.spans.clear();
        self.spans.resize(cells, NOTHING);
        self.measure(warm);
        self.find_flows(rates);
        [&mut self.x, &mut self.y].into_iter().for_each(Vec::clear);
        self.heat.clear();
        self.element.clear();
        self.cell.clear();
        self.source.clear();
        self.rock.clear();
        if self.flows.contains(&true) {
            self.collect(warm);
        }
    }

    fn cell_of(&self, at: Vec2) -> usize {
        let along = |at: f32, most: usize| ((at * (1.0 / REACH)) as usize + 1).min(most - 2);
        along(at.y, self.rows) * self.stride + along(at.x, self.stride)
    }

    /// Finds how warm it is in each cell.
    fn measure(&mut self, warm: &Warm) {
        let Warm { particles, solids, table, .. } = warm;
        self.without_heat.clear();
        self.without_heat.extend(table.curves().iter().map(|curve| Span::of_lump(curve, 0)));
        let mut of_particles = std::mem::take(&mut self.of_particles);
        of_particles.clear();
        for i in 0..particles.len() {
            let cell = self.cell_of(particles.position(i));
            of_particles.push(cell as u32);
            let lump = self.span_of(table, particles.element[i], particles.heat_of(i));
            self.spans[cell].join(lump);
        }
        self.of_particles = of_particles;
        // Rock comes row by row: what follows each other in a cell is joined to it at once.
        let (mut last, mut joined) = (0, NOTHING);
        solids.iter().for_each(|(place, element, _)| {
            let cell = self.cell_of(centre(place));
            if cell != last {
                self.spans[last].join(joined);
                (last, joined) = (cell, NOTHING);
            }
            joined.join(self.span_of(table, element, solids.heat(place)));
        });
        self.spans[last].join(joined);
    }

    #[inline(always)]
    fn span_of(&self, table: &HeatTable, element: ElementId, heat: i32) -> Span {
        match heat {
            0 => self.without_heat[element.index()],
            _ => Span::of_lump(table.curve(element), heat),
        }
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
                [cell - *stride, cell, cell + *stride].iter().for_each(|row| near.join(beside[*row]));
                if rates.may_flow(near.hottest - near.coldest, near.conduction) {
                    flows[cell] = true;
                    around(cell, *stride).into_iter().for_each(|others| needed[others].fill(true));
                }
            }
        }
    }

    /// Brings what is needed together, cell by cell: in each the particles in their order, and then the rock.
    fn collect(&mut self, warm: &Warm) {
        let Warm { particles, solids, .. } = warm;
        let cells = self.spans.len();
        self.starts.clear();
        self.starts.resize(cells + 2, 0);
        for cell in &self.of_particles {
            self.starts[*cell as usize + 2] += u32::from(self.needed[*cell as usize]);
        }
        solids.iter().for_each(|(place, ..)| {
            let cell = self.cell_of(centre(place));
            if self.needed[cell] {
                self.starts[cell + 2] += 1;
                self.rock.push(place);
            }
        });
        for cell in 2..cells + 2 {
            self.starts[cell] += self.starts[cell - 1];
        }
        let count = self.starts[cells + 1] as usize;
        self.x.resize(count, 0.0);
        self.y.resize(count, 0.0);
        self.heat.resize(count, 0);
        self.element.resize(count, ElementId(0));
        self.cell.resize(count, 0);
        self.source.resize(count, 0);
        let of_particles = std::mem::take(&mut self.of_particles);
        for (i, cell) in of_particles.iter().enumerate() {
            if self.needed[*cell as usize] {
                self.put(*cell, particles.position(i), particles.heat_of(i), particles.element[i], i as u32);
            }
        }
        self.of_particles = of_particles;
        for k in 0..self.rock.len() {
            let place = self.rock[k];
            let Some((element, _)) = solids.get(place) else { continue };
            let cell = self.cell_of(centre(place)) as u32;
            self.put(cell, centre(place), solids.heat(place), element, ROCK | k as u32);
        }
        // Filling moved each start to the end of its cell.
        self.starts.truncate(cells + 1);
    }

    fn put(&mut self, cell: u32, at: Vec2, heat: i32, element: ElementId, source: u32) {
        let next = &mut self.starts[cell as usize + 1];
        let k = *next as usize;
        *next += 1;
        (self.x[k], self.y[k], self.heat[k]) = (at.x, at.y, heat);
        (self.element[k], self.cell[k], self.source[k]) = (element, cell, source);
    }

    /// Gives particles and rock what heat they have now.
    pub fn hand_back(&self, warm: &mut Warm) {
        for (source, heat) in self.source.iter().zip(&self.heat) {
            if source & ROCK == 0 {
                warm.particles.set_heat(*source as usize, *heat);
            } else {
                warm.solids.set_heat(self.rock[(source & !ROCK) as usize], *heat);
            }
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let floats = self.x.capacity() + self.y.capacity() + self.heat.capacity();
        let words = self.cell.capacity() + self.source.capacity() + self.starts.capacity();
        4 * (floats + words + self.of_particles.capacity())
            + self.element.capacity()
            + self.flows.capacity()
            + self.needed.capacity()
            + size_of::<Span>() * (self.spans.capacity() + self.beside.capacity() + self.without_heat.capacity())
            + size_of::<IVec2>() * self.rock.capacity()
    }
}

/// A cell and those around it, three of each row, in rows of `stride`.
fn around(cell: usize, stride: usize) -> [Range<usize>; 3] {
    [cell - stride, cell, cell + stride].map(|cell| cell - 1..cell + 2)
}
