//! The steps of a prediction, in their order.

use crate::{
    parallel::Team,
    params::Domain,
    particles::Particles,
    predictor::{
        conjugate::Conjugate,
        feedback,
        flow::Flow,
        grains::{GrainParams, Grains},
        grid::MacGrid,
        letting_go::LettingGo,
        matter::Buoyancy,
        multigrid::Hierarchy,
        pockets::Pockets,
        pressure,
        report::PredictorReport,
        rock::ClosedFaces,
        transfer::Faces,
        way_back::{RubOff, WayBack, hand_back},
    },
    simd::InstructionSet,
    solids::Solids,
};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Share of the difference to the grid's velocity that a particle gives up in a second. It damps what the grid can't
/// see; 0.02 a tick. At a surface the mean of one side is no velocity to be drawn to: it would brake what turns.
/// What has a viscosity of its own takes as much less of it ([`GRID_VISCOSITY`](crate::element::GRID_VISCOSITY)).
const BLEND_PER_SECOND: f32 = 1.2;

/// The same of grains, which rub off what motion they have beside the others; 0.1 a tick.
const GRAINS_BLEND_PER_SECOND: f32 = 6.3;

/// Speed of a grain that stops, of what gravity adds in a substep.
const ARREST: f32 = 0.1;

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
    /// The grains, where there are any.
    grains: Option<Grains>,
    /// What they set out from in the first run.
    resumed: Vec<Vec<f32>>,
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
    /// What friction reads of the elements; none where no grain is.
    pub grains: Option<GrainParams<'a>>,
    /// Share of [`BLEND_PER_SECOND`] that the elements take; none where all take all of it.
    pub drawn: Option<&'a [f32]>,
    /// Lanes in use.
    pub instructions: InstructionSet,
    /// Threads to use.
    pub threads: usize,
    /// Substep, s.
    pub dt: f32,
}

/// What the next substep sets out from. A world that is put back goes on to the bit only together with it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// The pressure, d/s: the first guess of the next solve. Empty before the first.
    pub pressure: Vec<f32>,
    /// Stress and strain among grains and the water between them, d/s; none where no grain is.
    pub grains: Vec<Vec<f32>>,
}

impl Kept {
    /// Its numbers, d/s.
    pub fn values(&self) -> impl Iterator<Item = f32> + '_ {
        self.pressure.iter().chain(self.grains.iter().flatten()).copied()
    }

    /// Fields of it, and entries of the longest.
    pub fn size(&self) -> [usize; 2] {
        [1 + self.grains.len(), self.grains.iter().map(Vec::len).fold(self.pressure.len(), usize::max)]
    }
}

impl Predictor {
    /// A predictor whose first run sets out from what another kept.
    pub fn resume(kept: Kept) -> Self {
        let mut predictor = Self::default();
        predictor.conjugate.solution = kept.pressure;
        predictor.resumed = kept.grains;
        predictor
    }

    /// What the next run sets out from.
    pub fn kept(&self) -> Kept {
        let grains = self.grains.as_ref().map_or_else(|| self.resumed.clone(), Grains::kept);
        Kept { pressure: self.conjugate.solution.clone(), grains }
    }

    /// Makes the moves of the particles nearly keep the volume where they are liquid, by their velocities, and moves
    /// them to where it is too thin from where it is too dense, which leaves velocities as they are. It works in `room`, where
    /// others keep a number of each particle: what is in there does not matter, and nothing that matters is left.
    pub fn run(
        &mut self,
        particles: &mut Particles,
        solids: &Solids,
        params: &PredictorParams,
        mut room: [&mut Vec<f32>; 3],
    ) -> PredictorReport {
        let grid = MacGrid::new(params.domain.size, params.cell);
        if self.grid != grid {
            let pressure = std::mem::take(&mut self.conjugate.solution);
            let is_resumed = self.grid == MacGrid::default() && pressure.len() == grid.len();
            let resumed = std::mem::take(&mut self.resumed);
            *self = Self { grid, hierarchy: Hierarchy::new(grid.columns, grid.rows), resumed, ..Self::default() };
            if is_resumed {
                self.conjugate.resume(pressure, 1..grid.rows + 1, 1..grid.columns + 1);
            }
        }
        let finest = self.hierarchy.finest();
        let is_lent = finest.borrow(room.each_mut().map(|room| &mut **room), grid.len(), particles.len());
        let team = Team { instructions: params.instructions, threads: params.threads };
        self.closed.update(&grid, solids, params.domain.gravity);
        self.faces.collect(&grid, particles, params.masses, team);
        match params.grains {
            Some(of) => {
                let Particles { x, y, element, .. } = &*particles;
                let share = self.faces.share_out(&grid, team);
                let resumed = std::mem::take(&mut self.resumed);
                let grains = self.grains.get_or_insert_with(|| Grains::resume(&grid, resumed));
                grains.collect(&share, [x, y], element, (of, params.masses), params.dt);
            }
            None => (self.grains, self.resumed) = (None, Vec::new()),
        }
        let kick = params.dt * params.domain.gravity;
        let mut report = PredictorReport::default();
        params.instructions.run(pressure::Projection {
            grid: &grid,
            closed: &self.closed,
            faces: &mut self.faces,
            hierarchy: &mut self.hierarchy,
            conjugate: &mut self.conjugate,
            pockets: &mut self.pockets,
            letting_go: &mut self.letting_go,
            grains: self.grains.as_mut(),
            kick,
            target: params.rest_density,
            dt: params.dt,
            team,
            report: &mut report,
        });
        if is_lent {
            self.hierarchy.finest().give_back(room);
        }
        self.liquid = report.liquid;
        if report.liquid {
            let PredictorParams { domain, drawn, dt, .. } = *params;
            self.faces.find_beside(&grid, particles, team);
            let share = |rate: f32| (rate * dt).min(1.0);
            let (blend, arrest) = (share(GRAINS_BLEND_PER_SECOND), ARREST * kick.length());
            let grains = self.grains.as_ref().map(|grains| RubOff { grains, blend, arrest });
            let whole = pressure::whole(&grid, params.rest_density);
            let way = WayBack { whole, blend: share(BLEND_PER_SECOND), drawn, grains, dt, domain, solids };
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
        feedback::shares(grid, closed, faces, conjugate, |[column, row], share| {
            visit((Vec2::new(column as f32, row as f32) + 0.5) * grid.cell, share);
        });
    }

    /// What the last solve worked on and found, if it found liquid.
    pub(super) fn solved(&self) -> Option<(&MacGrid, &ClosedFaces, &Faces, &Conjugate)> {
        self.liquid.then_some((&self.grid, &self.closed, &self.faces, &self.conjugate))
    }

    /// Cells that friction worked on in the last run.
    #[cfg(test)]
    pub(super) fn cells_of_friction(&self) -> usize {
        self.grains.as_ref().map_or(0, |grains| grains.cells(&self.grid))
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
            + self.grains.as_ref().map_or(0, Grains::memory)
    }
}
