//! The density error: how much too dense or too thin the liquid stands, from positions only and apart from the solver's
//! own kernel, so that any other program's particles can be held against it.
//!
//! ρᵢ = Σⱼ (R² − r²)³ with R = 3 d, over the same sum in the square lattice of spacing d. The error of a particle is
//! |ρ/ρ₀ − 1|, ρ₀ being the scene's rest density. Only particles inside the liquid count: those with a neighbour at 2 d or
//! more (and less than R) in each of the eight 45° sectors. The surface is so far away then that what the sum misses
//! beyond it is little: of the lattice's sum 4 % come from 2 d on in each half plane. Rock is a neighbour like any
//! other; the walls of the box are none.
//!
//! What is missing may be missing beyond rock, which may be thin, or in a bubble. So liquid is too thin only where it
//! is all around: where each sector has a neighbour that is no rock, and each quarter one nearer than 2 d. Elsewhere it
//! may be too dense, but not too thin.

use crate::{
    kernel::{particles::Particles, solids},
    lab::stats,
    sim::state::{ParticleStore, Rock, Setup},
};
use bevy::ecs::world::World;
use glam::Vec2;
use rayon::prelude::*;

/// Support R of the estimate, d.
pub const SUPPORT: f64 = 3.0;

const R2: f64 = SUPPORT * SUPPORT;

/// Distance from which on a neighbour shows that there is liquid on its side, d.
const FAR: f64 = 2.0;

/// All eight sectors seen.
const ALL_SECTORS: u8 = u8::MAX;
/// The first sector of each quarter.
const ALL_QUARTERS: u8 = 0b0101_0101;

/// Σ (R² − r²)³ over the square lattice of spacing 1 around one of its points, itself included.
const LATTICE_SUM: f64 = {
    let reach = SUPPORT as i64;
    let mut sum = 0.0;
    let mut y = -reach;
    while y <= reach {
        let mut x = -reach;
        while x <= reach {
            let q = R2 - (x * x + y * y) as f64;
            if q > 0.0 {
                sum += q * q * q;
            }
            x += 1;
        }
        y += 1;
    }
    sum
};

/// What stands around one particle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Local {
    /// Density; 1 in the square lattice of spacing d.
    pub density: f64,
    /// Whether there is a neighbour at [`FAR`] or more in each of the eight sectors.
    pub interior: bool,
    /// Whether there is one that is liquid in each, and a nearer one in each quarter.
    pub immersed: bool,
}

/// The density error of a world at one moment, as fractions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DensityError {
    /// Mean over the interior particles.
    pub mean: f64,
    /// 99th percentile.
    pub p99: f64,
    /// 99th percentile of what is too dense alone: how far the liquid is pressed together.
    pub pressed: f64,
    /// Largest.
    pub max: f64,
    /// Mean density of the interior particles, 1 at rest density.
    pub density: f64,
    /// How many these are.
    pub interior: usize,
}

/// The density error, `rest_density` (a multiple of the lattice's) counting as none. `None` without interior particles.
pub fn density_error(
    particles: &Particles,
    rock: &solids::Solids,
    size: Vec2,
    rest_density: f64,
) -> Option<DensityError> {
    DensityError::of(&surroundings(particles, rock, size), rest_density)
}

impl DensityError {
    /// The error of a world as it is. `None` without interior particles.
    pub fn of_world(world: &World) -> Option<Self> {
        let blueprint = &world.resource::<Setup>().blueprint;
        let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
        density_error(particles, rock, blueprint.domain.size, f64::from(blueprint.fluid.rest_density))
    }

    /// The error over the interior ones of `locals`; `None` if there are none.
    pub(super) fn of(locals: &[Local], rest_density: f64) -> Option<Self> {
        let (mut errors, mut pressed, mut sum) = (Vec::new(), Vec::new(), 0.0);
        for local in locals.iter().filter(|local| local.interior) {
            let excess = local.density / rest_density - 1.0;
            sum += excess;
            pressed.push(excess.max(0.0));
            errors.push(if local.immersed { excess.abs() } else { excess.max(0.0) });
        }
        Some(Self {
            interior: errors.len(),
            density: 1.0 + sum / errors.len() as f64,
            mean: stats::mean(&errors)?,
            max: stats::largest(&errors)?,
            p99: stats::quantile(&mut errors, 0.99)?,
            pressed: stats::quantile(&mut pressed, 0.99)?,
        })
    }
}

/// What stands around each movable particle, in the order of the store. Particles that are not finite or further than d
/// outside the box have no neighbours and are no neighbours of others.
pub fn surroundings(particles: &Particles, rock: &solids::Solids, size: Vec2) -> Vec<Local> {
    let lattice = Lattice::new(size);
    let movable = (0..particles.len()).map(|i| (particles.position(i), i as u32));
    let fixed = rock.iter().map(|(cell, _, _)| (solids::centre(cell), ROCK));
    let grid = Grid::new(&lattice, movable.chain(fixed).filter(|(p, _)| lattice.holds(*p)).collect());
    let found: Vec<Local> = (0..grid.x.len()).into_par_iter().with_min_len(1024).map(|k| grid.look_around(k)).collect();
    let mut locals = vec![Local::default(); particles.len()];
    for (&source, local) in grid.source.iter().zip(found) {
        if source != ROCK {
            locals[source as usize] = local;
        }
    }
    locals
}

/// Source of a point of rock.
pub(super) const ROCK: u32 = u32::MAX;
/// Source of a particle that is only a neighbour.
pub(super) const NEIGHBOUR: u32 = u32::MAX - 1;

/// Square cells of edge R over the box and d around it.
pub(super) struct Lattice {
    size: Vec2,
    pub(super) columns: usize,
    pub(super) rows: usize,
}

impl Lattice {
    /// The cells of a box of `size` d.
    pub(super) fn new(size: Vec2) -> Self {
        let cells_along = |length: f32| ((f64::from(length) + 2.0) / SUPPORT).ceil().max(1.0) as usize;
        Self { size, columns: cells_along(size.x), rows: cells_along(size.y) }
    }

    /// Whether a point lies where cells are.
    pub(super) fn holds(&self, p: Vec2) -> bool {
        p.cmpge(Vec2::splat(-1.0)).all() && p.cmple(self.size + 1.0).all()
    }

    /// Column and row of a point that it holds.
    pub(super) fn place(&self, p: Vec2) -> (usize, usize) {
        let along = |x: f32, cells: usize| (((f64::from(x) + 1.0) / SUPPORT) as usize).min(cells - 1);
        (along(p.x, self.columns), along(p.y, self.rows))
    }

    fn cell_of(&self, p: Vec2) -> usize {
        let (column, row) = self.place(p);
        row * self.columns + column
    }
}

/// Points sorted into the cells of a lattice. A point's neighbours lie in three runs of consecutive points.
pub(super) struct Grid {
    columns: usize,
    rows: usize,
    /// First point of each cell, row by row, and the number of points.
    start: Vec<u32>,
    x: Vec<f64>,
    y: Vec<f64>,
    /// Index in the particle store, [`NEIGHBOUR`] or [`ROCK`].
    pub(super) source: Vec<u32>,
}

impl Grid {
    /// Sorts points that the lattice holds.
    pub(super) fn new(lattice: &Lattice, points: Vec<(Vec2, u32)>) -> Self {
        let (columns, rows) = (lattice.columns, lattice.rows);
        let cell_of = |p| lattice.cell_of(p);
        let mut start = vec![0_u32; columns * rows + 1];
        for (p, _) in &points {
            start[cell_of(*p) + 1] += 1;
        }
        for k in 1..start.len() {
            start[k] += start[k - 1];
        }
        let mut next = start.clone();
        let mut grid = Self {
            columns,
            rows,
            start,
            x: vec![0.0; points.len()],
            y: vec![0.0; points.len()],
            source: vec![0; points.len()],
        };
        for (p, source) in points {
            let slot = &mut next[cell_of(p)];
            let k = *slot as usize;
            *slot += 1;
            (grid.x[k], grid.y[k], grid.source[k]) = (f64::from(p.x), f64::from(p.y), source);
        }
        grid
    }

    /// What stands around point `k`, unless that is only a neighbour itself.
    pub(super) fn look_around(&self, k: usize) -> Local {
        if self.source[k] >= NEIGHBOUR {
            return Local::default();
        }
        let (x, y) = (self.x[k], self.y[k]);
        let along = |x: f64, cells: usize| (((x + 1.0) / SUPPORT) as usize).min(cells - 1);
        let (column, row) = (along(x, self.columns), along(y, self.rows));
        let (left, right) = (column.saturating_sub(1), (column + 1).min(self.columns - 1));
        let mut sum = 0.0;
        let (mut sectors, mut liquid, mut near) = (0, 0, 0);
        for row in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            let first = self.start[row * self.columns + left] as usize;
            let end = self.start[row * self.columns + right + 1] as usize;
            for j in first..end {
                let (dx, dy) = (self.x[j] - x, self.y[j] - y);
                let q = R2 - (dx * dx + dy * dy);
                if q > 0.0 {
                    sum += q * q * q;
                    let (seen, is_far) = (sector(dx, dy), q <= R2 - FAR * FAR);
                    let seen_liquid = if self.source[j] == ROCK { 0 } else { seen };
                    sectors |= if is_far { seen } else { 0 };
                    liquid |= if is_far { seen_liquid } else { 0 };
                    near |= if is_far { 0 } else { seen_liquid };
                }
            }
        }
        Local {
            density: sum / LATTICE_SUM,
            interior: sectors == ALL_SECTORS,
            immersed: liquid == ALL_SECTORS && (near | near >> 1) & ALL_QUARTERS == ALL_QUARTERS,
        }
    }
}

/// The bit of the sector `[45° s, 45° (s + 1))` that a direction lies in; none for no direction.
fn sector(dx: f64, dy: f64) -> u8 {
    let upper = dy > 0.0 || (dy == 0.0 && dx > 0.0);
    let (a, b) = if upper { (dx, dy) } else { (-dx, -dy) };
    let quarter = if a > 0.0 { u8::from(b >= a) } else { 2 + u8::from(b <= -a) };
    let bit = 1 << (quarter + 4 * u8::from(!upper));
    if dx == 0.0 && dy == 0.0 { 0 } else { bit }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::{element::ElementId, random::Random},
        lab::testing::{lattice, world},
    };
    use glam::IVec2;

    /// The definition, pair by pair.
    fn direct(points: &[Vec2], movable: usize, own: usize) -> Local {
        let mut sum = 0.0;
        let (mut seen, mut liquid, mut near) = ([false; 8], [false; 8], [false; 4]);
        for (j, p) in points.iter().enumerate() {
            let d = (p.as_dvec2() - points[own].as_dvec2()).to_array();
            let r2 = d[0] * d[0] + d[1] * d[1];
            if r2 >= 9.0 {
                continue;
            }
            sum += (9.0 - r2).powi(3);
            let turn = d[1].atan2(d[0]) / std::f64::consts::FRAC_PI_4;
            let sector = (turn.floor() as i32).rem_euclid(8) as usize;
            if r2 >= 4.0 {
                seen[sector] = true;
                liquid[sector] |= j < movable;
            } else if r2 > 0.0 {
                near[sector / 2] |= j < movable;
            }
        }
        let reference: f64 = lattice(7, 7, 1.0)
            .iter()
            .map(|p| (9.0 - f64::from(p.distance_squared(Vec2::splat(3.5)))).max(0.0).powi(3))
            .sum();
        let all = |seen: &[bool]| seen.iter().all(|seen| *seen);
        Local { density: sum / reference, interior: all(&seen), immersed: all(&liquid) && all(&near) }
    }

    #[test]
    fn the_lattice_is_at_rest_and_a_tighter_one_too_dense_by_its_area() {
        let size = Vec2::new(40.0, 30.0);
        let rock = solids::Solids::new(40, 30);
        let error = density_error(&world(lattice(40, 30, 1.0)), &rock, size, 1.0).unwrap();
        assert!(error.max < 1e-12, "the resting lattice has no error, but {}", error.max);
        let error = density_error(&world(lattice(40, 30, 0.8)), &rock, size, 1.0).unwrap();
        assert!((error.mean - (1.0 / 0.64 - 1.0)).abs() < 0.02, "{}", error.mean);
        assert!((error.density - 1.0 / 0.64).abs() < 0.02, "{}", error.density);
        let error = density_error(&world(lattice(40, 30, 0.8)), &rock, size, 1.0 / 0.64).unwrap();
        assert!(error.mean < 0.02, "at its own rest density it is at rest, not {}", error.mean);
        let error = density_error(&world(lattice(30, 20, 1.25)), &rock, size, 1.0).unwrap();
        assert!(
            (error.mean - 0.36).abs() < 0.02 && (error.density - 0.64).abs() < 0.02,
            "too thin is one, too: {error:?}"
        );
    }

    #[test]
    fn the_grid_finds_what_the_definition_finds() {
        let mut random = Random::new(7);
        let size = Vec2::new(24.0, 17.0);
        let mut points: Vec<Vec2> = (0..700).map(|_| Vec2::new(random.share(), random.share()) * size).collect();
        points.extend([Vec2::ZERO, size, Vec2::new(-0.9, 3.0), size + 0.9, points[5]]);
        let mut rock = solids::Solids::new(24, 17);
        for x in 0..24 {
            rock.insert(IVec2::new(x, 4), ElementId(1), 10_000 + x as u32);
        }
        let movable = points.len();
        let found = surroundings(&world(points.clone()), &rock, size);
        points.extend(rock.iter().map(|(cell, _, _)| solids::centre(cell)));
        assert!(found.iter().any(|local| local.interior) && !found.iter().all(|local| local.interior));
        for (i, local) in found.iter().enumerate().take(movable) {
            let expected = direct(&points, movable, i);
            assert!((local.density - expected.density).abs() < 1e-9, "{i}: {local:?} is not {expected:?}");
            let sides = |local: &Local| [local.interior, local.immersed];
            assert_eq!(sides(local), sides(&expected), "{i} at {}", points[i]);
        }
    }

    #[test]
    fn a_particle_under_the_surface_is_not_interior_until_rock_covers_it() {
        let size = Vec2::new(9.0, 9.0);
        let particles = world(lattice(9, 5, 1.0));
        let top_middle = 3 * 9 + 4;
        let mut rock = solids::Solids::new(9, 9);
        assert!(!surroundings(&particles, &rock, size)[top_middle].interior);
        for x in 0..9 {
            rock.insert(IVec2::new(x, 5), ElementId(1), 100 + x as u32);
        }
        let local = surroundings(&particles, &rock, size)[top_middle];
        assert!(local.interior && !local.immersed, "rock is a neighbour, and no liquid: {local:?}");
        // What is missing may be missing beyond the rock.
        let error = DensityError::of(&[Local { density: 0.9, ..local }], 1.0).unwrap();
        assert_eq!((error.max, error.density), (0.0, 0.9));
    }

    #[test]
    fn particles_that_are_not_finite_or_far_outside_do_no_harm() {
        let size = Vec2::new(20.0, 20.0);
        let rock = solids::Solids::new(20, 20);
        let mut points = lattice(20, 20, 1.0);
        let calm = density_error(&world(points.clone()), &rock, size, 1.0);
        points.extend([Vec2::NAN, Vec2::splat(1e30), Vec2::splat(f32::NEG_INFINITY)]);
        assert_eq!(density_error(&world(points), &rock, size, 1.0), calm);
        assert_eq!(density_error(&Particles::default(), &rock, size, 1.0), None);
    }
}
