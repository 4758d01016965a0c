//! Matter on a grid of 2 d: how full a place is, the colour of its powders, how its liquid foams. What the shaders need to know
//! of a place's surroundings, and too much to find pixel by pixel.

use crate::{
    game::render::look::Looks,
    kernel::{particles::Particles, solids::Solids, units::TICK_SECONDS},
};
use glam::{IVec2, Vec2};

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

/// What is found in a cell of what moves; of a gas nothing.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    /// Matter of all kinds, particles.
    matter: f32,
    /// Liquid that foams, particles; its velocity, d/s, and the square of it.
    liquid: f32,
    velocity: Vec2,
    square: f32,
    /// Powders, particles, and the sum of their colours.
    powder: f32,
    colour: [f32; 3],
}

/// The grid.
#[derive(Clone, Debug, Default)]
pub struct BodyMap {
    columns: usize,
    rows: usize,
    /// Rock of each cell, particles, and the shape that it was counted of.
    rock: Vec<u8>,
    rock_of: Option<u64>,
    found: Vec<Found>,
    /// Cells in which something was found.
    occupied: Vec<u32>,
    /// How full each cell is by itself, weighed with those beside it, and with those below and above, too.
    own: Vec<f32>,
    across: Vec<f32>,
    fill: Vec<f32>,
    foam: Vec<f32>,
    /// Whether there is any.
    foams: bool,
    moved: Vec<f32>,
    texels: Vec<u8>,
}

impl BodyMap {
    /// Measures movable particles and rock in a box of `size` d, and lets the foam go on by `ticks`; without, the world is another, and
    /// there is none yet. `metres`: those of a d.
    pub fn measure(
        &mut self,
        size: Vec2,
        metres: f32,
        (particles, rock): (&Particles, &Solids),
        looks: &Looks,
        ticks: Option<u64>,
    ) {
        self.columns = ((size.x / CELL).ceil() as usize).max(1);
        self.rows = ((size.y / CELL).ceil() as usize).max(1);
        let cells = self.columns * self.rows;
        if ticks.is_none() || self.foam.len() != cells {
            self.foam.clear();
            self.foam.resize(cells, 0.0);
            self.foams = false;
            self.found.clear();
            self.found.resize(cells, Found::default());
            self.occupied.clear();
            self.rock_of = None;
        }
        if self.rock_of != Some(rock.shape()) {
            self.count_rock(rock);
            self.rock_of = Some(rock.shape());
        }
        self.count(particles, looks);
        self.fill();
        if let Some(ticks) = ticks.filter(|ticks| *ticks > 0) {
            self.spread_foam((ticks.min(8) as f32) * TICK_SECONDS, metres);
        }
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
        for k in self.occupied.drain(..) {
            self.found[k as usize] = Found::default();
        }
        for i in 0..particles.len() {
            let look = looks.of(particles.element[i]);
            if look.is_gas() {
                continue;
            }
            let cell = self.cell_of(particles.position(i));
            let found = &mut self.found[cell];
            if found.matter == 0.0 {
                self.occupied.push(cell as u32);
            }
            found.matter += 1.0;
            if look.foams {
                let velocity = particles.velocity(i);
                found.liquid += 1.0;
                found.velocity += velocity;
                found.square += velocity.length_squared();
            }
            if look.is_powder() {
                found.powder += 1.0;
                for (sum, channel) in found.colour.iter_mut().zip(look.colour) {
                    *sum += f32::from(channel);
                }
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
            own[k] = share(f32::from(rock[k]) + self.found[k].matter);
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
        self.moved.clear();
        self.moved.resize(self.found.len(), 0.0);
        let mut foams = false;
        for k in self.occupied.iter().map(|k| *k as usize) {
            let Found { liquid, velocity, square, .. } = self.found[k];
            if liquid == 0.0 {
                continue;
            }
            let mean = velocity / liquid;
            let tumble = (square / liquid - mean.length_squared()).max(0.0).sqrt() * metres;
            let speed = (square / liquid).sqrt() * metres;
            let centre = Vec2::new((k % self.columns) as f32 + 0.5, (k / self.columns) as f32 + 0.5) * CELL;
            let carried = self.foam_at(centre - mean * seconds) / (1.0 + seconds / FOAM_LIFE);
            // What flies by itself is spray: white as it is, with nothing to tumble in.
            let spray = if liquid < 0.6 * FULL && self.fill[k] < 0.5 { 0.5 } else { 0.0 };
            let made = (ramp(TUMBLE, tumble).max(spray)) * ramp(FAST, speed) * FOAM_RATE * seconds;
            self.moved[k] = carried + (1.0 - carried) * made.min(1.0);
            foams |= self.moved[k] > 0.0;
        }
        std::mem::swap(&mut self.foam, &mut self.moved);
        self.foams = foams;
    }

    fn pack(&mut self) {
        self.texels.clear();
        self.texels.extend(self.fill.iter().flat_map(|fill| [0, 0, 0, (255.0 * fill.min(1.0)) as u8]));
        for k in self.occupied.iter().map(|k| *k as usize) {
            let found = &self.found[k];
            if found.powder == 0.0 {
                continue;
            }
            self.texels[4 * k..][..3].copy_from_slice(&found.colour.map(|sum| (sum / found.powder) as u8));
            for beside in around(k, self.columns, self.rows).filter(|k| self.found[*k].powder == 0.0) {
                let colour = self.beside(beside).map(|channel| channel as u8);
                self.texels[4 * beside..][..3].copy_from_slice(&colour);
            }
        }
    }

    /// Mean colour of the powders in the cells beside one, so that the picture doesn't fade at the edge of a heap.
    fn beside(&self, k: usize) -> [f32; 3] {
        let (mut sum, mut parts) = ([0.0; 3], 0.0);
        for found in around(k, self.columns, self.rows).map(|k| &self.found[k]) {
            parts += found.powder;
            for (sum, channel) in sum.iter_mut().zip(found.colour) {
                *sum += channel;
            }
        }
        if parts > 0.0 { sum.map(|channel| channel / parts) } else { [0.0; 3] }
    }

    fn cell_of(&self, at: Vec2) -> usize {
        let column = (at.x / CELL) as u32 as usize;
        let row = (at.y / CELL) as u32 as usize;
        row.min(self.rows - 1) * self.columns + column.min(self.columns - 1)
    }

    /// Share of foam at a point, smooth between the cells.
    pub fn foam_at(&self, at: Vec2) -> f32 {
        if !self.foams {
            return 0.0;
        }
        let most = IVec2::new(self.columns as i32 - 1, self.rows as i32 - 1);
        let p = at / CELL - 0.5;
        let low = Solids::cell_of(p);
        let t = p - low.as_vec2();
        let value = |dx: i32, dy: i32| {
            let cell = (low + IVec2::new(dx, dy)).clamp(IVec2::ZERO, most);
            self.foam[cell.y as usize * self.columns + cell.x as usize]
        };
        let bottom = value(0, 0) * (1.0 - t.x) + value(1, 0) * t.x;
        let top = value(0, 1) * (1.0 - t.x) + value(1, 1) * t.x;
        bottom * (1.0 - t.y) + top * t.y
    }

    /// Whether a point lies in matter that fills little of its surroundings.
    pub fn is_sparse(&self, at: Vec2) -> bool {
        self.fill[self.cell_of(at)] < 0.3
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

/// From 0 at the first of `bounds` to 1 at the second.
fn ramp((from, to): (f32, f32), x: f32) -> f32 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}
