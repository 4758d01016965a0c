//! The fields on the faces.

use crate::{
    blocks::Blocks,
    parallel::Team,
    particles::{Particles, extent},
    predictor::{
        grid::MacGrid,
        matter::{Buoyancy, Matter},
        operator::Lent,
        share_out::ShareOut,
        stencil::Axis,
    },
};
use std::ops::Range;

/// What the solve does to particles near a face: the change of velocity, and the velocity at which the density feedback moves
/// them, d/s.
pub(super) type Way = [f32; 2];

/// Fields on the faces.
#[derive(Clone, Debug, Default)]
pub(super) struct Faces {
    /// At the left faces: number of particles (as weights) and their momentum, d/s; in the projection their mean
    /// velocity.
    pub u: Vec<[f32; 2]>,
    /// The same at the lower faces.
    pub v: Vec<[f32; 2]>,
    /// At the left and at the lower faces, after the solve: in memory that the solver lends.
    pub ways: Lent,
    /// How full the cells are of liquid and rock, 1 at the density aimed at.
    pub filled: Vec<f32>,
    /// Fills of cells beside thin walls; kept between uses.
    pub made_up: Vec<f32>,
    /// Rows that a particle reaches. `u` and `v` are 0 in the two rows on either side; what is in all fields beyond is
    /// left from before.
    pub reached: Range<usize>,
    /// Columns of cells near particles. Beyond them and the faces next to them, too, all is left from before.
    pub area: Range<usize>,
    /// What is on the faces, where particles differ in their masses.
    pub matter: Option<Matter>,
    blocks: Blocks,
}

impl Faces {
    /// Shares out the particles' velocities on the faces. `masses`: those of the elements, as shares of the heaviest, if they
    /// differ.
    pub fn collect(&mut self, grid: &MacGrid, particles: &Particles, masses: Option<&[f32]>, team: Team) {
        let Self { u, v, filled, reached, area, matter, blocks, .. } = self;
        let Particles { x, y, vx, vy, element, .. } = particles;
        blocks.partition(grid, y, team.instructions, team.threads);
        *reached = blocks.reached();
        *area = grid.columns_near(extent(x, team.instructions));
        filled.resize(grid.len(), 0.0);
        let share = ShareOut { grid, blocks, reached, area, team };
        share.run([x, y], None, [vx, vy], [u, v]);
        match masses {
            Some(masses) => matter.get_or_insert_default().collect(&share, [x, y], [vx, vy], element, masses),
            None => *matter = None,
        }
    }

    /// Shares out on the faces what the particles have that were collected last.
    pub fn share_out<'a>(&'a self, grid: &'a MacGrid, team: Team) -> ShareOut<'a> {
        ShareOut { grid, blocks: &self.blocks, reached: &self.reached, area: &self.area, team }
    }

    /// Turns momenta into mean velocities: those of the mass, where it differs.
    pub fn find_means(&mut self, grid: &MacGrid, team: Team) {
        let Self { u, v, reached, area, matter, blocks, .. } = self;
        match matter {
            Some(matter) => matter.weigh(grid, [u, v], reached, grid.padded(area), team),
            None => ShareOut { grid, blocks, reached, area, team }.find_means([u, v]),
        }
    }

    /// Mean density of what is on the faces of cell `k`, as a share of the heaviest's.
    pub fn density(&self, grid: &MacGrid, k: usize) -> f32 {
        self.matter.as_ref().map_or(1.0, |matter| {
            let [u, v] = [Axis::U, Axis::V].map(|axis| matter.of(axis));
            0.25 * (u[k][0] + u[k + 1][0] + v[k][0] + v[k + grid.stride][0])
        })
    }

    /// Finds what each particle gains beside the liquid, where masses differ.
    pub fn find_beside(&mut self, grid: &MacGrid, particles: &Particles, team: Team) {
        let Self { reached, area, matter, blocks, .. } = self;
        let share = ShareOut { grid, blocks, reached, area, team };
        if let Some(matter) = matter {
            matter.find_beside(&share, [&particles.x, &particles.y]);
        }
    }

    /// What matter gains beside the liquid, where masses differ.
    pub fn buoyancy<'a>(&'a self, grid: &'a MacGrid) -> Option<Buoyancy<'a>> {
        let Self { reached, area, matter, .. } = self;
        matter.as_ref().map(|matter| Buoyancy::new(grid, matter, [reached, area]))
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let [ways_u, ways_v] = &self.ways;
        let on_faces: usize = [&self.u, &self.v, ways_u, ways_v].map(|field| 8 * field.capacity()).iter().sum();
        let matter = self.matter.as_ref().map_or(0, Matter::memory);
        on_faces + matter + 4 * (self.filled.capacity() + self.made_up.capacity()) + self.blocks.memory()
    }
}
