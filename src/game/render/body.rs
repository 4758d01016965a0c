//! Matter on a grid of 2 d: how full a place is, the colour of its powders, how its liquid foams. What the shaders need to know
//! of a place's surroundings, and too much to find pixel by pixel.

use crate::{
    game::render::look::Looks,
    kernel::{particles::Particles, solids::Solids, units::TICK_SECONDS},
};
use glam::{UVec2, Vec2};

/// Edge of a cell, d.
pub const CELL: f32 = 2.0;
/// Particles that a full cell holds.
const FULL: f32 = CELL * CELL;
/// Time in which foam fades to 1/e, s.
const FOAM_LIFE: f32 = 0.8;
/// Foam that the wildest place makes, shares a second.
const FOAM_RATE: f32 = 7.0;
/// Speeds against the mean of its cell from which liquid takes air in, and at which it takes all it can, m/s (Ihmsen et al.
/// 2012, "Unified spray, foam and air bubbles for particle-based fluids", section 4.1: trapped air).
const TUMBLE: (f32, f32) = (0.25, 1.3);
/// Speeds from which it has the energy for that (their potential of kinetic energy), m/s.
const FAST: (f32, f32) = (0.8, 3.5);

/// Mark of a cell that matter fills little of.
const SPARSE: u8 = 1;
/// Mark of a cell with foam in it or beside it.
const FOAMY: u8 = 2;
/// Less foam than this is none: it is less than a step of the eight bits that a body has for it.
const LEAST_FOAM: f32 = 0.001;

/// The grid.
#[derive(Clone, Debug, Default)]
pub struct BodyMap {
    columns: usize,
    rows: usize,
    /// Rock of each cell, particles, and the shape that it was counted of.
    rock: Vec<u8>,
    rock_of: Option<u64>,
    /// What moves in each cell and is no gas, particles.
    moving: Vec<f32>,
    /// Of that the liquid that foams: particles, the sum of their velocities, d/s, and of the squares of those.
    liquid: Vec<[f32; 4]>,
    /// And the powders: particles, and the sum of their colours.
    powder: Vec<[f32; 4]>,
    /// Cells in which something moves.
    occupied: Vec<u32>,
    /// How full each cell is by itself, weighed with those beside it, and with those below and above, too.
    own: Vec<f32>,
    across: Vec<f32>,
    fill: Vec<f32>,
    foam: Vec<f32>,
    foam_after: Vec<f32>,
    /// What is to be looked at more closely in each cell, as [`SPARSE`] and [`FOAMY`].
    marks: Vec<u8>,
    texels: Vec<u8>,
}

impl BodyMap {
    /// Begins with the rock of a world in a box of `size` d: another world than before if it `is_new`.
    pub fn follow_rock(&mut self, size: Vec2, rock: &Solids, is_new: bool) {
        let (columns, rows) = (((size.x / CELL).ceil() as usize).max(1), ((size.y / CELL).ceil() as usize).max(1));
        if is_new || (columns, rows) != (self.columns, self.rows) {
            let cells = columns * rows;
            *self = Self {
                columns,
                rows,
                moving: vec![0.0; cells],
                liquid: vec![[0.0; 4]; cells],
                powder: vec![[0.0; 4]; cells],
                foam: vec![0.0; cells],
                marks: vec![0; cells],
                ..Self::default()
            };
        }
        if self.rock_of != Some(rock.shape()) {
            self.count_rock(rock);
            self.rock_of = Some(rock.shape());
        }
    }

    /// Measures movable particles beside the rock, and lets the foam go on by `ticks`. `metres`: those of a d.
    pub fn measure(&mut self, metres: f32, particles: &Particles, looks: &Looks, ticks: u64) {
        self.count(particles, looks);
        self.fill();
        if ticks > 0 {
            self.spread_foam((ticks.min(8) as f32) * TICK_SECONDS, metres);
        }
        self.mark();
        self.pack();
    }

    fn count_rock(&mut self, rock: &Solids) {
        self.rock.clear();
        self.rock.resize(self.columns * self.rows, 0);
        let edge = CELL as i32;
        rock.iter().for_each(|(cell, ..)| {
            self.rock[(cell.y / edge) as usize * self.columns + (cell.x / edge) as usize] += 1;
        });
    }

    fn count(&mut self, particles: &Particles, looks: &Looks) {
        for k in self.occupied.drain(..).map(|k| k as usize) {
            (self.moving[k], self.liquid[k], self.powder[k]) = (0.0, [0.0; 4], [0.0; 4]);
        }
        let Particles { element, x, y, vx, vy, .. } = particles;
        for ((element, (x, y)), (vx, vy)) in element.iter().zip(x.iter().zip(y)).zip(vx.iter().zip(vy)) {
            let look = looks.of(*element);
            if look.is_gas() {
                continue;
            }
            let cell = self.cell_of(Vec2::new(*x, *y));
            let moving = &mut self.moving[cell];
            if *moving == 0.0 {
                self.occupied.push(cell as u32);
            }
            *moving += 1.0;
            if look.foams {
                add(&mut self.liquid[cell], [1.0, *vx, *vy, vx * vx + vy * vy]);
            }
            if look.is_powder() {
                let [r, g, b] = look.colour.map(f32::from);
                add(&mut self.powder[cell], [1.0, r, g, b]);
            }
        }
    }

    /// How full each place is: the mean of three by three cells, weighed 1 2 1; beyond the box counts as what is at its edge.
    fn fill(&mut self) {
        let share = |matter: f32| (matter / FULL).min(1.25);
        let Self { rock, own, across, fill, .. } = self;
        own.clear();
        own.extend(rock.iter().map(|rock| share(f32::from(*rock))));
        for k in self.occupied.iter().map(|k| *k as usize) {
            own[k] = share(f32::from(rock[k]) + self.moving[k]);
        }
        across.resize(own.len(), 0.0);
        for (own, across) in own.chunks_exact(self.columns).zip(across.chunks_exact_mut(self.columns)) {
            let last = own.len() - 1;
            for (across, beside) in across[1..].iter_mut().zip(own.windows(3)) {
                *across = beside[0] + 2.0 * beside[1] + beside[2];
            }
            across[0] = 3.0 * own[0] + own[last.min(1)];
            across[last] = own[last.saturating_sub(1)] + 3.0 * own[last];
        }
        fill.resize(own.len(), 0.0);
        let row = |y: usize| &across[y * self.columns..][..self.columns];
        for (y, fill) in fill.chunks_exact_mut(self.columns).enumerate() {
            let rows = row(y.saturating_sub(1)).iter().zip(row(y)).zip(row((y + 1).min(self.rows - 1)));
            for (fill, ((below, own), above)) in fill.iter_mut().zip(rows) {
                *fill = (below + 2.0 * own + above) / 16.0;
            }
        }
    }

    /// Foam is carried with the liquid (backwards along its mean velocity), made where it tumbles, and fades.
    fn spread_foam(&mut self, seconds: f32, metres: f32) {
        let kept = 1.0 / (1.0 + seconds / FOAM_LIFE);
        self.foam_after.clear();
        self.foam_after.resize(self.foam.len(), 0.0);
        for k in self.occupied.iter().map(|k| *k as usize) {
            let [liquid, vx, vy, square] = self.liquid[k];
            if liquid == 0.0 {
                continue;
            }
            let (mean, square) = (Vec2::new(vx, vy) / liquid, square / liquid);
            let tumble = (square - mean.length_squared()).max(0.0).sqrt() * metres;
            let speed = square.sqrt() * metres;
            let carried = self.foam_at(self.centre(k) - mean * seconds) * kept;
            // What flies by itself is spray: white as it is, with nothing to tumble in.
            let spray = if liquid < 0.6 * FULL && self.fill[k] < 0.5 { 0.5 } else { 0.0 };
            let made = (ramp(TUMBLE, tumble).max(spray)) * ramp(FAST, speed) * FOAM_RATE * seconds;
            let foam = carried + (1.0 - carried) * made.min(1.0);
            self.foam_after[k] = if foam < LEAST_FOAM { 0.0 } else { foam };
        }
        std::mem::swap(&mut self.foam, &mut self.foam_after);
    }

    /// Marks the cells that are to be looked at more closely.
    fn mark(&mut self) {
        for (mark, fill) in self.marks.iter_mut().zip(&self.fill) {
            *mark = if *fill < 0.3 { SPARSE } else { 0 };
        }
        for k in self.occupied.iter().map(|k| *k as usize).filter(|k| self.foam[*k] > 0.0) {
            around(k, self.columns, self.rows).for_each(|k| self.marks[k] |= FOAMY);
        }
    }

    fn pack(&mut self) {
        self.texels.resize(4 * self.fill.len(), 0);
        for (texel, fill) in self.texels.chunks_exact_mut(4).zip(&self.fill) {
            texel.copy_from_slice(&[0, 0, 0, (255.0 * fill.min(1.0)) as u8]);
        }
        for k in self.occupied.iter().map(|k| *k as usize) {
            let [powder, colour @ ..] = self.powder[k];
            if powder == 0.0 {
                continue;
            }
            self.texels[4 * k..][..3].copy_from_slice(&colour.map(|sum| (sum / powder) as u8));
            for beside in around(k, self.columns, self.rows).filter(|k| self.powder[*k][0] == 0.0) {
                let colour = self.beside(beside).map(|channel| channel as u8);
                self.texels[4 * beside..][..3].copy_from_slice(&colour);
            }
        }
    }

    /// Mean colour of the powders in the cells beside one, so that the picture doesn't fade at the edge of a heap.
    fn beside(&self, k: usize) -> [f32; 3] {
        let mut sums = [0.0; 4];
        around(k, self.columns, self.rows).for_each(|k| add(&mut sums, self.powder[k]));
        let [powder, colour @ ..] = sums;
        colour.map(|sum| sum / powder.max(1.0))
    }

    /// Matter of all kinds that moves and is no gas: places, and how many particles are there.
    pub fn matter(&self) -> impl Iterator<Item = (Vec2, u32)> {
        self.occupied.iter().map(|k| (self.centre(*k as usize), self.moving[*k as usize] as u32))
    }

    /// Matter in a cell that is no gas, particles.
    pub fn held(&self, k: usize) -> f32 {
        f32::from(self.rock[k]) + self.moving[k]
    }

    fn centre(&self, k: usize) -> Vec2 {
        (Vec2::new((k % self.columns) as f32, (k / self.columns) as f32) + 0.5) * CELL
    }

    fn cell_of(&self, at: Vec2) -> usize {
        let column = (at.x / CELL) as u32 as usize;
        let row = (at.y / CELL) as u32 as usize;
        row.min(self.rows - 1) * self.columns + column.min(self.columns - 1)
    }

    /// Share of foam at a point, smooth between the cells.
    pub fn foam_at(&self, at: Vec2) -> f32 {
        if self.marks[self.cell_of(at)] & FOAMY == 0 {
            return 0.0;
        }
        let most = UVec2::new(self.columns as u32 - 1, self.rows as u32 - 1);
        let p = (at / CELL - 0.5).clamp(Vec2::ZERO, most.as_vec2());
        let low = p.as_uvec2();
        let (t, high) = (p - low.as_vec2(), (low + 1).min(most));
        let row = |y: u32| {
            let cells = &self.foam[y as usize * self.columns..][..self.columns];
            cells[low.x as usize] * (1.0 - t.x) + cells[high.x as usize] * t.x
        };
        row(low.y) * (1.0 - t.y) + row(high.y) * t.y
    }

    /// Whether a point lies in matter that fills little of its surroundings.
    pub fn is_sparse(&self, at: Vec2) -> bool {
        self.marks[self.cell_of(at)] & SPARSE != 0
    }

    /// Whether there is no foam at a point, and much matter.
    pub fn is_plain(&self, at: Vec2) -> bool {
        self.marks[self.cell_of(at)] == 0
    }

    /// Columns and rows.
    pub fn dimensions(&self) -> (usize, usize) {
        (self.columns, self.rows)
    }

    /// What it covers, d: the box rounded up to whole cells.
    pub fn extent(&self) -> Vec2 {
        Vec2::new(self.columns as f32, self.rows as f32) * CELL
    }

    /// Colour of the powders and how full it is, cell by cell, row by row from the bottom.
    pub fn texels(&self) -> &[u8] {
        &self.texels
    }
}

/// A cell of a grid and those beside it, row by row.
fn around(k: usize, columns: usize, rows: usize) -> impl Iterator<Item = usize> {
    let near = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
    let (x, y) = (k % columns, k / columns);
    near(y, rows).flat_map(move |y| near(x, columns).map(move |x| y * columns + x))
}

fn add(sums: &mut [f32; 4], numbers: [f32; 4]) {
    for (sum, number) in sums.iter_mut().zip(numbers) {
        *sum += number;
    }
}

/// From 0 at the first of `bounds` to 1 at the second.
fn ramp((from, to): (f32, f32), x: f32) -> f32 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}
