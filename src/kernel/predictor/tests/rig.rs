//! The pressure equation on its own, and the projection with all its fields in view.

use super::{DT, team};
use crate::{
    particles::Particles,
    predictor::{
        PredictorReport,
        conjugate::{Conjugate, tolerance},
        equation::{Around, Sides, couple, steepness},
        grid::MacGrid,
        letting_go::LettingGo,
        level::{RowSums, damping},
        multigrid::Hierarchy,
        pockets::Pockets,
        pressure::{Projection, beside},
        rock::ClosedFaces,
        stencil::Axis,
        transfer::Faces,
    },
    solids::Solids,
};
use glam::Vec2;

/// Rounds of correction after which nothing but rounding in double precision is left: each takes nine tenths away.
const ROUNDS: usize = 14;

/// The equation over the liquid cells of a grid, to be solved in double precision: the solver under test corrects the
/// residual that is found here, again and again.
pub(super) struct Equation {
    pub grid: MacGrid,
    pub hierarchy: Hierarchy,
    pub conjugate: Conjugate,
}

impl Equation {
    /// The equation of cells that are filled as `filled(column, row)` says and liquid where `liquid(column, row)` does.
    pub fn new(
        size: Vec2,
        cell: f32,
        solids: &Solids,
        liquid: impl Fn(usize, usize) -> bool,
        filled: impl Fn(usize, usize) -> f32,
    ) -> Self {
        let grid = MacGrid::new(size, cell);
        let mut closed = ClosedFaces::default();
        closed.update(&grid, solids, super::DOWN);
        let Open { u: open_u, v: open_v, liquid_from } = Open::new(&grid, &closed);
        let mut conjugate = Conjugate::default();
        conjugate.resize(grid.len());
        let (mut fill, [mut steep_u, mut steep_v]) = (vec![0.0; grid.len()], [(); 2].map(|()| vec![0.0; grid.len()]));
        for (column, row, k) in cells(&grid) {
            fill[k] = filled(column, row);
            let is_open = liquid_from[k].is_finite();
            conjugate.liquid[k] = if is_open && liquid(column, row) { 1.0 } else { 0.0 };
        }
        conjugate.rows = 1..grid.rows + 1;
        let mut hierarchy = Hierarchy::new(grid.columns, grid.rows);
        let (finest, stride) = (hierarchy.finest(), grid.stride);
        finest.borrow([(); 3].map(|()| Vec::new()).each_mut(), grid.len(), 0);
        finest.wet.find(&conjugate.liquid, stride, conjugate.rows.clone(), 1..grid.columns + 1);
        finest.take();
        for (axis, steep) in [(Axis::U, &mut steep_u), (Axis::V, &mut steep_v)] {
            for j in 1..grid.rows + 2 {
                let (first, n) = (grid.row(j) + 1, grid.columns + 1);
                let of = |field| beside(field, first, n, axis.step(&grid));
                let around = closed.beside(&grid, axis, first, n);
                steepness(&mut steep[first..first + n], of(&conjugate.liquid), of(&fill), around);
            }
        }
        let [diagonal, _, right, upper] = finest.operator.fields_mut();
        for j in 1..grid.rows + 1 {
            let row = grid.row(j) + 1..grid.row(j) + 1 + grid.columns;
            couple(
                &mut diagonal[row.clone()],
                &mut right[row.clone()],
                &mut upper[row.clone()],
                Around::new(&conjugate.liquid, row.clone(), stride),
                Sides::new(&open_u, &open_v, row.clone(), stride),
                Sides::new(&steep_u, &steep_v, row, stride),
            );
        }
        coarsen(&mut hierarchy);
        Self { grid, hierarchy, conjugate }
    }

    /// A field that is `value(centre)` in the liquid, with lengths in units of `unit`, and 0 elsewhere.
    pub fn field(&self, unit: f64, value: impl Fn([f64; 2]) -> f64) -> Vec<f64> {
        let mut field = vec![0.0; self.grid.len()];
        let edge = f64::from(self.grid.cell) / unit;
        for (column, row, k) in self.liquid() {
            field[k] = value([(column as f64 + 0.5) * edge, (row as f64 + 0.5) * edge]);
        }
        field
    }

    /// Columns, rows and indices of the liquid cells.
    pub fn liquid(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        cells(&self.grid).filter(|(.., k)| self.conjugate.liquid[*k] > 0.0)
    }

    /// A x.
    pub fn apply(&mut self, x: &[f64]) -> Vec<f64> {
        let stride = self.grid.stride;
        let [diagonal, _, right, upper] = self.hierarchy.finest().operator.fields();
        let mut product = vec![0.0; x.len()];
        for (.., k) in cells(&self.grid) {
            product[k] = f64::from(diagonal[k]) * x[k]
                - f64::from(right[k]) * x[k + 1]
                - f64::from(right[k - 1]) * x[k - 1]
                - f64::from(upper[k]) * x[k + stride]
                - f64::from(upper[k - stride]) * x[k - stride];
        }
        product
    }

    /// The preconditioner's answer to a right-hand side.
    pub fn precondition(&mut self, b: &[f64]) -> Vec<f64> {
        self.hierarchy.finest().b.iter_mut().zip(b).for_each(|(single, double)| *single = *double as f32);
        cycle(&mut self.hierarchy);
        let x = self.hierarchy.finest().x.clone();
        let mut answer = vec![0.0; b.len()];
        self.liquid().for_each(|(.., k)| answer[k] = f64::from(x[k]));
        answer
    }

    /// One call of the solver from 0.
    pub fn solve_once(&mut self, b: &[f64]) -> (Vec<f64>, PredictorReport) {
        self.hierarchy.finest().b.iter_mut().zip(b).for_each(|(single, double)| *single = *double as f32);
        let mut solution = vec![0.0; b.len()];
        let report = self.conjugate.solve(&mut self.hierarchy, &mut solution, tolerance(DT), team());
        (solution.iter().map(|x| f64::from(*x)).collect(), report)
    }

    /// The solution to double precision. `is_sealed`: nothing of it touches air, so that only its differences count.
    pub fn solve(&mut self, b: &[f64], is_sealed: bool) -> Vec<f64> {
        let mut x = vec![0.0; b.len()];
        for _ in 0..ROUNDS {
            let mut residual: Vec<f64> = b.iter().zip(self.apply(&x)).map(|(b, product)| b - product).collect();
            if is_sealed {
                self.centre(&mut residual);
            }
            // Near the smallest single-precision numbers a residual would vanish.
            let size = residual.iter().fold(1e-300_f64, |most, r| most.max(r.abs()));
            residual.iter_mut().for_each(|r| *r /= size);
            let (correction, _) = self.solve_once(&residual);
            x.iter_mut().zip(correction).for_each(|(x, correction)| *x += size * correction);
        }
        if is_sealed {
            self.centre(&mut x);
        }
        x
    }

    /// Takes the mean over the liquid out of a field.
    pub fn centre(&self, field: &mut [f64]) {
        let (sum, count) = self.liquid().fold((0.0, 0.0), |(sum, count), (.., k)| (sum + field[k], count + 1.0));
        self.liquid().for_each(|(.., k)| field[k] -= sum / count);
    }
}

/// Builds the coarse levels of an equation whose finest one is set up.
pub(super) fn coarsen(hierarchy: &mut Hierarchy) {
    let finest = hierarchy.finest();
    let [diagonal, damped, ..] = finest.operator.fields_mut();
    damped.iter_mut().zip(diagonal).for_each(|(damped, diagonal)| *damped = damping(*diagonal));
    hierarchy.coarsen(team());
}

/// One cycle of the preconditioner.
fn cycle(hierarchy: &mut Hierarchy) {
    hierarchy.cycle(&mut RowSums::default(), team());
}

/// What rock leaves open, a number for each cell of the grid.
pub(super) struct Open {
    /// Open share of left faces.
    pub u: Vec<f32>,
    /// Open share of lower faces.
    pub v: Vec<f32>,
    /// How full a cell has to be.
    pub liquid_from: Vec<f32>,
}

impl Open {
    fn new(grid: &MacGrid, closed: &ClosedFaces) -> Self {
        let each = |field: &[f32]| {
            (0..grid.rows + 3).flat_map(|j| &field[closed.row(j)..closed.row(j) + grid.stride]).copied().collect()
        };
        Self { u: each(&closed.open_u), v: each(&closed.open_v), liquid_from: each(&closed.liquid_from) }
    }
}

/// Columns, rows (from 0) and indices of all cells.
pub(super) fn cells(grid: &MacGrid) -> impl Iterator<Item = (usize, usize, usize)> + use<> {
    let (columns, stride) = (grid.columns, grid.stride);
    (0..grid.rows).flat_map(move |row| (0..columns).map(move |column| (column, row, (row + 1) * stride + column + 1)))
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The projection of particles' velocities on the grid, its fields in view.
pub(super) struct Rig {
    pub grid: MacGrid,
    pub closed: ClosedFaces,
    pub open: Open,
    pub faces: Faces,
    pub hierarchy: Hierarchy,
    pub conjugate: Conjugate,
    /// Substep, s.
    pub dt: f32,
}

impl Rig {
    /// Shares the particles' velocities out.
    pub fn new(particles: &Particles, solids: &Solids, cell: f32) -> Self {
        let grid = MacGrid::new(super::size(solids), cell);
        let mut hierarchy = Hierarchy::new(grid.columns, grid.rows);
        hierarchy.finest().borrow(super::room().each_mut(), grid.len(), 0);
        let (mut closed, mut faces) = (ClosedFaces::default(), Faces::default());
        closed.update(&grid, solids, super::DOWN);
        faces.collect(&grid, particles, None, team());
        let open = Open::new(&grid, &closed);
        Self { grid, closed, open, faces, hierarchy, conjugate: Conjugate::default(), dt: DT }
    }

    /// Projects once, as a tick does. What comes out is `faces.u[k][1]` and `faces.v[k][1]`, the new velocities.
    pub fn project(&mut self, rest_density: f32) -> PredictorReport {
        let mut report = PredictorReport::default();
        team().instructions.run(Projection {
            grid: &self.grid,
            closed: &self.closed,
            faces: &mut self.faces,
            hierarchy: &mut self.hierarchy,
            conjugate: &mut self.conjugate,
            pockets: &mut Pockets::default(),
            letting_go: &mut LettingGo::default(),
            grains: None,
            kick: Vec2::ZERO,
            target: rest_density,
            dt: self.dt,
            team: team(),
            report: &mut report,
        });
        let Faces { u, v, ways: [ways_u, ways_v], reached, area, .. } = &mut self.faces;
        let columns = self.grid.padded(area);
        for face in reached.clone().flat_map(|row| columns.clone().map(move |column| (row, column))) {
            let face = self.grid.row(face.0) + face.1;
            u[face][1] += ways_u[face][0];
            v[face][1] += ways_v[face][0];
        }
        report
    }

    /// Projects the velocities on the grid again and again, until only rounding is left.
    pub fn project_exactly(&mut self, rest_density: f32) {
        let weights = [&self.faces.u, &self.faces.v].map(|faces| faces.iter().map(|face| face[0].max(1e-6)).collect());
        let weights: [Vec<f32>; 2] = weights;
        self.project(rest_density);
        for _ in 0..8 {
            for (faces, weights) in [&mut self.faces.u, &mut self.faces.v].into_iter().zip(&weights) {
                faces.iter_mut().zip(weights).for_each(|(face, weight)| *face = [*weight, weight * face[1]]);
            }
            self.conjugate.solution.fill(0.0);
            self.project(rest_density);
        }
    }
}
