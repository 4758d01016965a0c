//! Grid to particles: what the faces around each do to it, with bilinear weights.

use crate::{
    element::ElementId,
    parallel::{Team, WORTH_A_PIECE, spread},
    params::{Domain, WALL_GAP},
    particles::Particles,
    predictor::{
        grains::{GrainWay, Grains},
        grid::MacGrid,
        matter::{Beside, Matter},
        stencil::{Axis, LANES, Stencils},
        transfer::Faces,
    },
    simd::{Lanes, Pass, padded},
    solids::Solids,
};
use glam::{Vec2, Vec4, Vec4Swizzles};

/// How the particles follow the faces.
pub(super) struct WayBack<'a> {
    /// Particles (as weights) from which on they stand on both sides of a face, so that they are drawn to their mean velocity.
    pub whole: f32,
    /// Share of the difference to the grid's velocity that a particle gives up.
    pub blend: f32,
    /// What share of that particles of each element give up; none where all give up all of it.
    pub drawn: Option<&'a [f32]>,
    /// How grains do, if there are any.
    pub grains: Option<RubOff<'a>>,
    /// Substep, s.
    pub dt: f32,
    pub domain: &'a Domain,
    pub solids: &'a Solids,
}

/// How grains follow those around them.
#[derive(Clone, Copy)]
pub(super) struct RubOff<'a> {
    pub grains: &'a Grains,
    /// Share of the difference to the others' velocity that a grain gives up.
    pub blend: f32,
    /// Difference that is given up as a whole, and speed below which a grain stops, d/s.
    pub arrest: f32,
}

/// Longest move of the density feedback along an axis in a substep, d. It is no motion and has no speed, so that no
/// harm comes of it but that particles get among others; half a spacing keeps them beside their neighbours.
const LONGEST_DRIFT: f32 = 0.5;

/// A coordinate of a way, cut to [`LONGEST_DRIFT`].
#[inline(always)]
fn shorten(way: f32) -> f32 {
    keep(way, -LONGEST_DRIFT, LONGEST_DRIFT)
}

/// A number, cut to `low … high`.
#[inline(always)]
fn keep(number: f32, low: f32, high: f32) -> f32 {
    let number = if number > low { number } else { low };
    if number < high { number } else { high }
}

/// Adds the change of velocity at each particle, and half of it to what is added after the move; moves the velocity
/// towards the grid's by the share `blend`, and the particle as the density feedback wants it.
pub(super) fn hand_back(faces: &Faces, grid: &MacGrid, particles: &mut Particles, way: &WayBack, team: Team) {
    let Particles { x, y, vx, vy, push_x, push_y, element, .. } = particles;
    let elements = &element[..];
    let arrays = [&mut x[..], y, vx, vy, push_x, push_y];
    let beside = faces.matter.as_ref().map(Matter::beside);
    spread(arrays, WORTH_A_PIECE, team.threads, &|first, [x, y, vx, vy, push_x, push_y]| {
        let (position, velocity, push) = ([x, y], [vx, vy], [push_x, push_y]);
        let instructions = team.instructions;
        let beside = beside.map(|beside| beside.from(first));
        let grains = way.grains.map(|off| (&off.grains.sines()[first..], off));
        let drawn = way.drawn.map(|drawn| (drawn, &elements[first..]));
        match beside.is_some() || grains.is_some() || drawn.is_some() {
            false => {
                let (beside, drawn, grains) = (None, None, None);
                instructions.run(HandBack::<false> {
                    grid,
                    faces,
                    beside,
                    drawn,
                    grains,
                    way,
                    position,
                    velocity,
                    push,
                });
            }
            true => {
                instructions.run(HandBack::<true> {
                    grid,
                    faces,
                    beside,
                    drawn,
                    grains,
                    way,
                    position,
                    velocity,
                    push,
                });
            }
        }
    });
}

/// Changes particles as the faces around them say.
struct HandBack<'a, const MIXED: bool> {
    grid: &'a MacGrid,
    faces: &'a Faces,
    /// What particles gain beside the liquid, if masses differ; not read without `MIXED`.
    beside: Option<Beside<'a>>,
    /// What share of the difference the elements take, and the particles' elements, if not all take all; not read without `MIXED`.
    drawn: Option<(&'a [f32], &'a [ElementId])>,
    /// sin φ of the particles, and how they follow if any is a grain; not read without `MIXED`.
    grains: Option<(&'a [f32], RubOff<'a>)>,
    way: &'a WayBack<'a>,
    position: [&'a mut [f32]; 2],
    velocity: [&'a mut [f32]; 2],
    push: [&'a mut [f32]; 2],
}

impl<const MIXED: bool> Pass for HandBack<'_, MIXED> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, faces, beside, drawn, grains, way, .. } = self;
        let ([x, y], [vx, vy], [push_x, push_y]) = (self.position, self.velocity, self.push);
        let (low, high) = (Vec2::splat(WALL_GAP), way.domain.highest());
        let rock = (way.solids.count() > 0).then_some(way.solids);
        for at in (0..x.len()).step_by(LANES) {
            let [from_x, from_y]: [[f32; LANES]; 2] = [&x[at..], &y[at..]].map(padded);
            let own = at..x.len().min(at + LANES);
            let count = own.len();
            let around = |axis| Stencils::new(grid, &from_x, &from_y, axis);
            let (around_u, around_v) = (around(Axis::U), around(Axis::V));
            let mut means_x = mean_of_faces([&faces.ways[0], &faces.u], way.whole, grid, &around_u, count);
            let mut means_y = mean_of_faces([&faces.ways[1], &faces.v], way.whole, grid, &around_v, count);
            if let Some(beside) = beside.filter(|_| MIXED) {
                for (axis, around, means) in [(Axis::U, &around_u, &mut means_x), (Axis::V, &around_v, &mut means_y)] {
                    for lane in 0..count {
                        let share = [around.right[lane], around.upper[lane]];
                        let more = beside.more(at + lane, axis, grid.stride, around.corner[lane] as usize, share);
                        means[lane] = beside_the_liquid(means[lane], more);
                    }
                }
            }
            if let Some((drawn, elements)) = drawn.filter(|_| MIXED) {
                for (element, (mean_x, mean_y)) in
                    elements[own.clone()].iter().zip(means_x.iter_mut().zip(&mut means_y))
                {
                    draw_less(drawn[element.index()], [mean_x, mean_y]);
                }
            }
            let (x, y) = (&mut x[own.clone()], &mut y[own.clone()]);
            let grains = grains.filter(|_| MIXED).map(|(sines, off)| (&sines[own.clone()], off));
            if let Some((sines, _)) = grains {
                // What grains are drawn to is found below.
                for (sine, (mean_x, mean_y)) in sines.iter().zip(means_x.iter_mut().zip(&mut means_y)) {
                    draw_less(if *sine > 0.0 { 0.0 } else { 1.0 }, [mean_x, mean_y]);
                }
            }
            change(&means_x, [x, &mut vx[own.clone()], &mut push_x[own.clone()]], way, [low.x, high.x]);
            change(&means_y, [y, &mut vy[own.clone()], &mut push_y[own.clone()]], way, [low.y, high.y]);
            if let Some((sines, off)) = grains {
                let ways = off.grains.ways();
                let velocities = vx[own.clone()].iter_mut().zip(&mut vy[own]);
                for (lane, (_, (vx, vy))) in
                    sines.iter().zip(velocities).enumerate().filter(|(_, (sine, _))| **sine > 0.0)
                {
                    let at = |axis: Axis, around: &Stencils| mean_of_ways(&ways[axis as usize], grid, around, lane);
                    [*vx, *vy] = rub([*vx, *vy], [at(Axis::U, &around_u), at(Axis::V, &around_v)], off);
                }
            }
            if let Some(rock) = rock {
                rock.sweep_all([&from_x[..count], &from_y[..count]], [x, y]);
            }
        }
    }
}

/// Lets the faces draw a particle only by a share.
#[inline(always)]
fn draw_less(share: f32, means: [&mut Mean; 2]) {
    for mean in means {
        (mean[2], mean[3]) = (share * mean[2], share * mean[3]);
    }
}

/// Share of what the liquid gains from which on a particle that gains as much more moves beside it.
const BESIDE: f32 = 0.02;

/// The way of a particle that gains `more` times what the liquid gains. It moves beside the liquid: it is not drawn to the
/// velocity of that, which is what it rises or sinks against.
#[inline(always)]
fn beside_the_liquid([gained, drift, known, mean]: Mean, more: f32) -> Mean {
    let moves = more.abs() * (1.0 / BESIDE);
    let drawn = if moves < 1.0 { 1.0 - moves } else { 0.0 };
    [gained + gained * more, drift, drawn * known, drawn * mean]
}

/// Bilinear means of what the faces around a point do to a particle there: change of velocity, velocity of the density
/// feedback, share of faces with particles on both sides, and their velocity of before times that, d/s.
type Mean = [f32; 4];

/// The means around the first `count` points, of the faces' ways and of their weights with the velocities of before.
#[inline(always)]
fn mean_of_faces(
    fields: [&[[f32; 2]]; 2],
    whole: f32,
    grid: &MacGrid,
    stencils: &Stencils,
    count: usize,
) -> [Mean; LANES] {
    let mut means = [[0.0; 4]; LANES];
    for lane in 0..count {
        let corner = stencils.corner[lane] as usize;
        let (right, upper) = (stencils.right[lane], stencils.upper[lane]);
        let (left, lower) = (1.0 - right, 1.0 - upper);
        let (below, above) = (pair(fields, whole, corner), pair(fields, whole, corner + grid.stride));
        let [ways, known] = [0, 1].map(|of| {
            let [left_x, left_y, right_x, right_y] = (lower * below[of] + upper * above[of]).to_array();
            left * Vec2::new(left_x, left_y) + right * Vec2::new(right_x, right_y)
        });
        means[lane] = [ways.x, ways.y, known.x, known.y];
    }
    means
}

/// The bilinear mean of the faces around a point.
#[inline(always)]
fn mean_of_ways(field: &[GrainWay], grid: &MacGrid, stencils: &Stencils, lane: usize) -> GrainWay {
    let (corner, right, upper) = (stencils.corner[lane] as usize, stencils.right[lane], stencils.upper[lane]);
    let mean = |of: usize| {
        let along = |at: usize| (1.0 - right) * field[at][of] + right * field[at + 1][of];
        (1.0 - upper) * along(corner) + upper * along(corner + grid.stride)
    };
    [mean(0), mean(1)]
}

/// The velocity of a grain that rubs on those around it, d/s: next to none is none.
#[inline(always)]
fn rub([vx, vy]: [f32; 2], [[mean_x, known_x], [mean_y, known_y]]: [GrainWay; 2], off: RubOff) -> [f32; 2] {
    let RubOff { blend, arrest, .. } = off;
    let (x, y) = (mean_x - known_x * vx, mean_y - known_y * vy);
    let share = (arrest / (x * x + y * y + f32::MIN_POSITIVE).sqrt()).max(blend).min(1.0);
    let (vx, vy) = (vx + share * x, vy + share * y);
    if vx * vx + vy * vy < arrest * arrest { [0.0; 2] } else { [vx, vy] }
}

/// Two faces side by side, left and right: their ways, and (1, mean velocity of before) where a face is whole, else (0, 0).
#[inline(always)]
fn pair([ways, means]: [&[[f32; 2]]; 2], whole: f32, at: usize) -> [Vec4; 2] {
    let [ways, means] = [ways, means].map(|field| Vec4::from_slice(field[at..at + 2].as_flattened()));
    let weights = means.xxzz();
    let known = Vec4::new(1.0, means.y, 1.0, means.w);
    [ways, Vec4::select(weights.cmplt(Vec4::splat(whole)), Vec4::ZERO, known)]
}

/// Changes one coordinate of some particles: position, velocity and push.
#[inline(always)]
fn change(means: &[Mean; LANES], particles: [&mut [f32]; 3], way: &WayBack, [low, high]: [f32; 2]) {
    let [at, velocity, push] = particles;
    for (((at, velocity), push), mean) in at.iter_mut().zip(velocity).zip(push).zip(means) {
        let [gained, drift, known, grid] = *mean;
        *velocity += gained + way.blend * (grid - known * *velocity);
        *push += 0.5 * gained;
        *at = keep(*at + shorten(drift * way.dt), low, high);
    }
}
