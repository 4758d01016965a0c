//! Particles to grid and back, with bilinear weights.

use crate::kernel::{
    particles::Particles,
    predictor::{grid::MacGrid, rock::fold_at_walls},
};

/// Which faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// Left faces: they stand on columns' edges and rows' middles.
    U,
    /// Lower faces: they stand on columns' middles and rows' edges.
    V,
}

/// The four faces around a point: index of the lower left one, and the shares of the right and upper ones.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stencil {
    corner: usize,
    right: f32,
    upper: f32,
}

impl Stencil {
    /// The faces around a point, d.
    #[inline(always)]
    pub fn new(grid: &MacGrid, x: f32, y: f32, axis: Axis) -> Self {
        let (x, y) = (x * grid.per_cell + 1.0, y * grid.per_cell + 1.0);
        let on_edge = |at: f32, cells: usize| {
            let index = (at as i32).clamp(1, cells as i32);
            (index as usize, at - index as f32)
        };
        let on_middle = |at: f32, cells: usize| {
            let index = ((at - 0.5) as i32).clamp(0, cells as i32);
            (index as usize, at - 0.5 - index as f32)
        };
        let ((i, right), (j, upper)) = match axis {
            Axis::U => (on_edge(x, grid.columns), on_middle(y, grid.rows)),
            Axis::V => (on_middle(x, grid.columns), on_edge(y, grid.rows)),
        };
        Self { corner: grid.row(j) + i, right, upper }
    }

    /// Calls `add(entry, weight)` for the four entries of a field.
    #[inline(always)]
    pub fn add<T>(&self, field: &mut [T], stride: usize, add: impl Fn(&mut T, f32)) {
        let (left, lower) = (1.0 - self.right, 1.0 - self.upper);
        let [a, b] = &mut field[self.corner..self.corner + 2] else { return };
        add(a, left * lower);
        add(b, self.right * lower);
        let above = self.corner + stride;
        let [a, b] = &mut field[above..above + 2] else { return };
        add(a, left * self.upper);
        add(b, self.right * self.upper);
    }

    /// The bilinear mean of a field of pairs.
    #[inline(always)]
    fn mean(&self, field: &[[f32; 2]], stride: usize) -> [f32; 2] {
        let (left, lower) = (1.0 - self.right, 1.0 - self.upper);
        let above = self.corner + stride;
        let (a, b, c, d) = (field[self.corner], field[self.corner + 1], field[above], field[above + 1]);
        let mean =
            |k: usize| lower * (left * a[k] + self.right * b[k]) + self.upper * (left * c[k] + self.right * d[k]);
        [mean(0), mean(1)]
    }
}

/// Fields on the faces.
#[derive(Clone, Debug, Default)]
pub(super) struct Faces {
    /// Number of particles (as weights) and mean velocity, d/s, at the left faces.
    pub u: Vec<[f32; 2]>,
    /// The same at the lower faces.
    pub v: Vec<[f32; 2]>,
    /// Density at the cells, particles per d².
    pub density: Vec<f32>,
    /// Change of velocity and new velocity, d/s, at the left faces.
    pub new_u: Vec<[f32; 2]>,
    /// The same at the lower faces.
    pub new_v: Vec<[f32; 2]>,
    /// How much steeper than between liquid cells the pressure falls at the left faces.
    pub steep_u: Vec<f32>,
    /// The same at the lower faces.
    pub steep_v: Vec<f32>,
    /// Change on each face and whether it is known (1) or to be filled in from its neighbours (0).
    pub change: Vec<f32>,
    /// See `change`.
    pub known: Vec<f32>,
}

impl Faces {
    /// Shares out the particles' velocities on the faces.
    pub fn collect(&mut self, grid: &MacGrid, particles: &Particles) {
        let Self { u, v, density, new_u, new_v, steep_u, steep_v, change, known } = self;
        for field in [&mut *u, v, new_u, new_v] {
            field.clear();
            field.resize(grid.len(), [0.0; 2]);
        }
        for field in [density, steep_u, steep_v, change, known] {
            field.resize(grid.len(), 0.0);
        }
        let velocities = particles.vx.iter().zip(&particles.vy);
        for ((&x, &y), (&vx, &vy)) in particles.x.iter().zip(&particles.y).zip(velocities) {
            let deposit = |value: f32| {
                move |face: &mut [f32; 2], weight: f32| {
                    face[0] += weight;
                    face[1] += weight * value;
                }
            };
            Stencil::new(grid, x, y, Axis::U).add(u, grid.stride, deposit(vx));
            Stencil::new(grid, x, y, Axis::V).add(v, grid.stride, deposit(vy));
        }
        fold_at_walls(grid, u, v);
    }

    /// Adds the change of velocity at each particle, and moves its velocity towards the grid's by the share `blend`.
    pub fn hand_back(&self, grid: &MacGrid, particles: &mut Particles, blend: f32) {
        let velocities = particles.vx.iter_mut().zip(&mut particles.vy);
        for ((&x, &y), (vx, vy)) in particles.x.iter().zip(&particles.y).zip(velocities) {
            let [change_x, grid_x] = Stencil::new(grid, x, y, Axis::U).mean(&self.new_u, grid.stride);
            let [change_y, grid_y] = Stencil::new(grid, x, y, Axis::V).mean(&self.new_v, grid.stride);
            let (moved_x, moved_y) = (*vx + change_x, *vy + change_y);
            *vx = moved_x + blend * (grid_x - moved_x);
            *vy = moved_y + blend * (grid_y - moved_y);
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let pairs = [&self.u, &self.v, &self.new_u, &self.new_v].iter().map(|field| field.capacity()).sum::<usize>();
        8 * pairs
            + 4 * (self.density.capacity()
                + self.steep_u.capacity() * 2
                + self.change.capacity()
                + self.known.capacity())
    }
}
