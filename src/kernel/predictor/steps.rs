//! The steps of a prediction, in their order.

use crate::{
    parallel::Team,
    params::Domain,
    particles::Particles,
    predictor::{
        conjugate::Conjugate,
        flow::Flow,
        grid::MacGrid,
        letting_go::LettingGo,
        matter::Buoyancy,
        multigrid::Hierarchy,
        pockets::Pockets,
        pressure,
        report::PredictorReport,
        rock::ClosedFaces,
        transfer::Faces,
        way_back::{WayBack, hand_back},
    },
    simd::InstructionSet,
    solids::Solids,
};
use glam::Vec2;

/// Share of the difference to the grid's velocity that a particle gives up in a second. It damps what the grid can't
/// see; 0.02 a tick. At a surface the mean of one side is no velocity to be drawn to: it would brake what turns.
const BLEND_PER_SECOND: f32 = 1.2;

/// Grid fields and solver of the predictor. Buffers are kept from substep to substep; the pressure, too, as the first
/// guess of the next solve.
#[derive(Clone, Debug, Default)]
pub struct Predictor {
    grid: MacGrid,
    closed: ClosedFaces,
    faces: Faces,
    hierarchy: Hierarchy,
    conjugate: Conjugate,
    pockets: Pockets,
    letting_go: LettingGo,
    /// Whether the last run found liquid.
    liquid: bool,
}

/// What the prediction is told.
#[derive(Clone, Copy, Debug)]
pub struct PredictorParams<'a> {
    /// Box.
    pub domain: &'a Domain,
    /// Edge of a cell that is aimed at, d: about the kernel radius.
    pub cell: f32,
    /// Rest density as a multiple of the lattice's.
    pub rest_density: f32,
    /// Masses of the elements, as shares of the heaviest; none where all are alike.
    pub masses: Option<&'a [f32]>,
    /// Lanes in use.
    pub instructions: InstructionSet,
    /// Threads to use.
    pub threads: usize,
    /// Substep, s.
    pub dt: f32,
}

impl Predictor {
    /// A predictor that takes `pressure` (see [`Predictor::pressure`]) as the first guess of its first run.
    pub fn resume(pressure: Vec<f32>) -> Self {
        let mut predictor = Self::default();
        predictor.conjugate.solution = pressure;
        predictor
    }

    /// The pressure of the last run, which the next one sets out from. A world that is put back goes on to the bit only
    /// together with it.
    pub fn pressure(&self) -> &[f32] {
        &self.conjugate.solution
    }

    /// Makes the moves of the particles nearly keep the volume where they are liquid, by their velocities, and moves
    /// them to where it is too thin from where it is too dense, which leaves velocities as they are.
    pub fn run(&mut self, particles: &mut Particles, solids: &Solids, params: &PredictorParams) -> PredictorReport {
        let grid = MacGrid::new(params.domain.size, params.cell);
        if self.grid != grid {
            let pressure = std::mem::take(&mut self.conjugate.solution);
            let is_resumed = self.grid == MacGrid::default() && pressure.len() == grid.len();
            *self = Self { grid, hierarchy: Hierarchy::new(grid.columns, grid.rows), ..Self::default() };
            if is_resumed {
                self.conjugate.resume(pressure, 1..grid.rows + 1, 1..grid.columns + 1);
            }
        }
        let team = Team { instructions: params.instructions, threads: params.threads };
        self.closed.update(&grid, solids);
        self.faces.collect(&grid, particles, params.masses, team);
        let mut report = PredictorReport::default();
        params.instructions.run(pressure::Projection {
            grid: &grid,
            closed: &self.closed,
            faces: &mut self.faces,
            hierarchy: &mut self.hierarchy,
            conjugate: &mut self.conjugate,
            pockets: &mut self.pockets,
            letting_go: &mut self.letting_go,
            target: params.rest_density,
            dt: params.dt,
            team,
            report: &mut report,
        });
        self.liquid = report.liquid;
        if report.liquid {
            let PredictorParams { domain, dt, .. } = *params;
            self.faces.find_beside(&grid, particles, team);
            let way = WayBack { blend: (BLEND_PER_SECOND * dt).min(1.0), dt, domain, solids };
            hand_back(&self.faces, &grid, particles, &way, team);
        }
        report
    }

    /// What the liquid does around a place, as the last run left it.
    pub fn flow(&self) -> Flow<'_> {
        Flow::new(&self.grid, &self.closed, &self.faces, self.liquid.then_some(&self.conjugate.liquid))
    }

    /// How matter rises and sinks in the liquid, as the last run left it; `None` where all is as heavy, or nothing is liquid.
    pub fn buoyancy(&self) -> Option<Buoyancy<'_>> {
        self.faces.buoyancy(&self.grid).filter(|_| self.liquid)
    }

    /// Shows `visit` the centre (d) of every liquid cell of the last run, and how much of the feedback's range its density
    /// error uses: past 1 it was cut.
    pub fn limit_shares(&self, mut visit: impl FnMut(Vec2, f32)) {
        let Self { grid, closed, faces, conjugate, .. } = self;
        if conjugate.rows.is_empty() || faces.filled.len() != grid.len() {
            return;
        }
        pressure::feedback_shares(grid, closed, faces, conjugate, |[column, row], share| {
            visit((Vec2::new(column as f32, row as f32) + 0.5) * grid.cell, share);
        });
    }

    /// Edge of a cell, d; 0 before the first run.
    pub fn cell(&self) -> f32 {
        self.grid.cell
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.closed.memory()
            + self.faces.memory()
            + self.hierarchy.memory()
            + self.conjugate.memory()
            + self.pockets.memory()
            + self.letting_go.memory()
    }
}
