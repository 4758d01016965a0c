//! Where a liquid stands, coarsely: what runs at different spacings have in common.

use crate::lab::{balance::Matter, exam::set_up::CaseSimulation};

/// Share of the liquid at each node of a grid. A particle is shared out to the four nodes around it, bilinearly.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shares(Vec<f64>);

/// Nodes to a unit of length, along each axis. The first stands half a mesh outside the box.
const NODES_A_UNIT: f64 = 10.0;

impl Shares {
    /// The particles of a box of so many units of length (m).
    pub fn of(simulation: &CaseSimulation, unit: f64, size: [f64; 2]) -> Self {
        let Matter { particles, scale, .. } = simulation.matter();
        let d = f64::from(scale.spacing) / unit;
        let points = particles.x.iter().zip(&particles.y).map(|(x, y)| [f64::from(*x) * d, f64::from(*y) * d]);
        Self::of_points(points, size)
    }

    fn of_points(points: impl ExactSizeIterator<Item = [f64; 2]>, size: [f64; 2]) -> Self {
        let [columns, rows] = size.map(|size| (size * NODES_A_UNIT).ceil() as usize + 2);
        let (mut nodes, share) = (vec![0.0; columns * rows], 1.0 / points.len() as f64);
        for point in points {
            let [x, y] = point.map(|at| at * NODES_A_UNIT + 0.5);
            for (column, wx) in sides(x, columns) {
                for (row, wy) in sides(y, rows) {
                    nodes[row * columns + column] += share * wx * wy;
                }
            }
        }
        Self(nodes)
    }

    /// Share of the liquid that stands elsewhere than in another.
    pub fn distance(&self, other: &Self) -> f64 {
        0.5 * self.0.iter().zip(&other.0).map(|(a, b)| (a - b).abs()).sum::<f64>()
    }

    /// What lies between this one and a later one, `share` of the way.
    pub fn towards(&self, later: &Self, share: f64) -> Self {
        Self(self.0.iter().zip(&later.0).map(|(a, b)| a + (b - a) * share).collect())
    }
}

/// The nodes on both sides of a place, with their weights; places beyond the last belong to it.
fn sides(at: f64, count: usize) -> [(usize, f64); 2] {
    let below = at.floor();
    let index = |node: f64| (node.max(0.0) as usize).min(count - 1);
    [(index(below), 1.0 - (at - below)), (index(below + 1.0), at - below)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_moved_by_a_part_of_a_mesh_is_that_far_away() {
        let at = |x: f64| Shares::of_points([[x, 0.35], [0.55, 0.75]].into_iter(), [2.0, 1.0]);
        assert!((at(0.55).0.iter().sum::<f64>() - 1.0).abs() < 1e-12, "all of it is somewhere");
        assert!(at(0.55).distance(&at(0.55)) == 0.0);
        let [near, far] = [0.57, 1.55].map(|x| at(0.55).distance(&at(x)));
        assert!((near - 0.5 * 0.2).abs() < 1e-9, "half of the liquid, by a fifth of a mesh: {near}");
        assert!((far - 0.5).abs() < 1e-9, "half of it has nothing in common with where it was: {far}");
        let middle = at(0.55).towards(&at(0.65), 0.25);
        assert!((middle.distance(&at(0.55)) - 0.125).abs() < 1e-9, "a quarter of the way");
    }
}
