//! Particles to grid and back: constants and linear fields, and the sums that have to stay.

use super::{CELL, DT, LATTICE, lattice, noise, room, size, solids, team};
use crate::{
    element::ElementId,
    params::Domain,
    particles::Particles,
    predictor::{
        Predictor, PredictorParams,
        grid::MacGrid,
        transfer::Faces,
        way_back::{self, WayBack},
    },
    solids::Solids,
};
use glam::Vec2;

/// Particles at random places of a box, `gap` d or more from its walls.
fn cloud(count: usize, box_size: Vec2, gap: f32, mut velocity: impl FnMut(Vec2) -> Vec2) -> Particles {
    let mut random = noise(17);
    let mut particles = Particles::default();
    for id in 0..count {
        let share = Vec2::new(random(), random()) * 0.5 + 0.5;
        let at = Vec2::splat(gap) + share * (box_size - 2.0 * gap);
        particles.push(id as u32, ElementId(1), at, velocity(at));
    }
    particles
}

fn collect(grid: &MacGrid, particles: &Particles) -> Faces {
    let mut faces = Faces::default();
    faces.collect(grid, particles, None, team());
    faces.ways = [(); 2].map(|()| vec![[0.0; 2]; grid.len()]);
    faces
}

fn hand_back(faces: &Faces, grid: &MacGrid, particles: &mut Particles) {
    let size = Vec2::new(grid.columns as f32, grid.rows as f32) * grid.cell;
    let domain = Domain { size, gravity: Vec2::ZERO };
    let whole = f32::INFINITY;
    let way =
        WayBack { whole, blend: 0.0, drawn: None, grains: None, dt: DT, domain: &domain, solids: &Solids::new(1, 1) };
    way_back::hand_back(faces, grid, particles, &way, team());
}

/// Points of the left and of the lower face of a cell, d.
fn face_points(grid: &MacGrid, column: usize, row: usize) -> [Vec2; 2] {
    let corner = Vec2::new(column as f32, row as f32) * grid.cell;
    [corner + Vec2::new(0.0, 0.5 * grid.cell), corner + Vec2::new(0.5 * grid.cell, 0.0)]
}

#[test]
fn a_uniform_velocity_is_uniform_on_the_grid_up_to_the_walls() {
    let box_size = Vec2::new(50.0, 40.0);
    let grid = MacGrid::new(box_size, CELL);
    let faces = collect(&grid, &cloud(3000, box_size, 0.25, |_| Vec2::new(3.0, -7.0)));
    for (field, velocity) in [(&faces.u, 3.0), (&faces.v, -7.0)] {
        for face in field.iter().filter(|face| face[0] > 1e-6) {
            assert!((face[1] / face[0] - velocity).abs() < 1e-4, "{} and not {velocity}", face[1] / face[0]);
        }
    }
}

#[test]
fn weight_and_momentum_are_shared_out_whole() {
    let box_size = Vec2::new(50.0, 40.0);
    let grid = MacGrid::new(box_size, CELL);
    let mut random = noise(2);
    // Away from the walls: on those, a face stands for twice what it sees.
    let particles = cloud(4000, box_size, CELL, |_| Vec2::new(random(), random()) * 20.0);
    let faces = collect(&grid, &particles);
    let sums = |field: &[[f32; 2]]| {
        field.iter().fold([0.0; 2], |[w, p], face| [w + f64::from(face[0]), p + f64::from(face[1])])
    };
    for (field, velocity) in [(&faces.u, &particles.vx), (&faces.v, &particles.vy)] {
        let [weight, momentum] = sums(field);
        let expected: f64 = velocity.iter().map(|v| f64::from(*v)).sum();
        let scale: f64 = velocity.iter().map(|v| f64::from(v.abs())).sum();
        assert!((weight - 4000.0).abs() < 1e-2, "a weight of {weight}");
        assert!((momentum - expected).abs() < 1e-6 * scale, "{momentum} and not {expected}");
    }
}

#[test]
fn a_full_box_is_as_dense_at_its_walls_as_inside() {
    // Along a wall, deposits beyond it are folded back; on it, they count twice.
    let walls = solids(50, 40, |_| false);
    let grid = MacGrid::new(size(&walls), CELL);
    let faces = collect(&grid, &lattice(&walls, |_| Some(Vec2::ZERO)));
    let full = grid.cell * grid.cell;
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            let k = grid.row(row + 1) + column + 1;
            for weight in [faces.u[k][0], faces.u[k + 1][0], faces.v[k][0], faces.v[k + grid.stride][0]] {
                assert!((weight / full - 1.0).abs() < 0.05, "({column}, {row}): {} of full", weight / full);
            }
            let mean = (faces.u[k][0] + faces.u[k + 1][0] + faces.v[k][0] + faces.v[k + grid.stride][0]) / (4.0 * full);
            assert!((mean - 1.0).abs() < 0.03, "({column}, {row}): the cell is {mean} full");
        }
    }
}

#[test]
fn a_linear_flow_is_linear_on_the_grid_and_back() {
    let flow = |at: Vec2| Vec2::new(1.0 + 0.3 * at.x - 0.2 * at.y, -2.0 - 0.1 * at.x + 0.4 * at.y);
    let walls = solids(50, 40, |_| false);
    let grid = MacGrid::new(size(&walls), CELL);
    let mut faces = collect(&grid, &lattice(&walls, |at| Some(flow(at))));
    // The lattice lies within a hundredth of a spacing of evenly around each face.
    for row in 1..grid.rows - 1 {
        for column in 1..grid.columns - 1 {
            let k = grid.row(row + 1) + column + 1;
            let [left, lower] = face_points(&grid, column, row).map(flow);
            let (u, v) = (faces.u[k][1] / faces.u[k][0], faces.v[k][1] / faces.v[k][0]);
            assert!((u - left.x).abs() < 5e-3 && (v - lower.y).abs() < 5e-3, "({column}, {row}): {u}, {v}");
        }
    }
    // A change that is linear on the faces is the same at the particles, wherever they are.
    for row in 0..grid.rows + 1 {
        for column in 0..grid.columns + 1 {
            let [left, lower] = face_points(&grid, column, row).map(flow);
            let k = grid.row(row + 1) + column + 1;
            (faces.ways[0][k], faces.ways[1][k]) = ([left.x, 0.0], [lower.y, 0.0]);
        }
    }
    let mut particles = cloud(3000, size(&walls), CELL, |_| Vec2::ZERO);
    hand_back(&faces, &grid, &mut particles);
    for i in 0..particles.len() {
        let (found, expected) = (particles.velocity(i), flow(particles.position(i)));
        assert!(found.distance(expected) < 1e-3, "{found} and not {expected} at {}", particles.position(i));
    }
}

#[test]
fn what_the_faces_give_is_what_the_particles_get() {
    // The way back is the way there, transposed: Σ_p Δv_p = Σ_f w_f Δu_f for any change of the faces.
    let box_size = Vec2::new(50.0, 40.0);
    let grid = MacGrid::new(box_size, CELL);
    let mut random = noise(8);
    let mut particles = cloud(3000, box_size, CELL, |_| Vec2::ZERO);
    let mut faces = collect(&grid, &particles);
    let mut given = [0.0; 2];
    let [ways_u, ways_v] = &mut faces.ways;
    for (sum, (field, ways)) in given.iter_mut().zip([(&faces.u, ways_u), (&faces.v, ways_v)]) {
        for ([weight, _], way) in field.iter().zip(ways) {
            let change = random();
            *sum += f64::from(*weight) * f64::from(change);
            *way = [change, 0.0];
        }
    }
    hand_back(&faces, &grid, &mut particles);
    for (given, velocity) in given.into_iter().zip([&particles.vx, &particles.vy]) {
        let got: f64 = velocity.iter().map(|v| f64::from(*v)).sum();
        assert!((given - got).abs() < 1e-2, "{given} given, {got} got");
    }
}

#[test]
fn what_is_far_away_changes_nothing_and_leaves_nothing_behind() {
    let rock = solids(2000, 60, |at| at.y < 2.0 && at.x > 900.0);
    let pool = |first: f32| {
        lattice(&rock, move |at| {
            let inside = (first..first + 90.0).contains(&at.x) && at.y < 30.0;
            inside.then(|| Vec2::new(0.3 * (at.y - 9.0), -4.0 + 0.1 * (at.x - first)))
        })
    };
    let domain = Domain { size: size(&rock), gravity: Vec2::ZERO };
    let params = PredictorParams {
        domain: &domain,
        cell: CELL,
        rest_density: LATTICE,
        masses: None,
        grains: None,
        drawn: None,
        instructions: team().instructions,
        threads: 1,
        dt: DT,
    };
    let alone = |first: f32| {
        let mut particles = pool(first);
        assert!(Predictor::default().run(&mut particles, &rock, &params, room().each_mut()).liquid);
        particles
    };
    let mut kept = Predictor::default();
    for first in [0.0, 955.0, 1910.0, 300.0, 0.0] {
        let quiet = alone(first);
        // Two drops at the far ends: the whole grid is looked at.
        let mut among = pool(first);
        let count = among.len();
        for (id, x) in [(1_000_000, 0.5), (1_000_001, 1999.5)] {
            among.push(id, ElementId(1), Vec2::new(x, 55.5), Vec2::new(0.0, -9.0));
        }
        Predictor::default().run(&mut among, &rock, &params, room().each_mut());
        assert_eq!((&among.vx[..count], &among.vy[..count]), (&quiet.vx[..], &quiet.vy[..]), "drops far from {first}");
        // The pool comes from somewhere else: no pressure there is the pressure of no liquid.
        let mut moved = pool(first);
        kept.run(&mut moved, &rock, &params, room().each_mut());
        assert_eq!((moved.vx, moved.vy), (quiet.vx, quiet.vy), "a predictor that has been elsewhere before {first}");
    }
}
