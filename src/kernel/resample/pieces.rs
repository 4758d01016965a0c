//! Particles of another size: each is cut into equal pieces, and pieces are joined until they weigh a new particle.

use super::curve::along;
use crate::{
    element::ElementId,
    params::Domain,
    particles::{Particle, Particles},
    solids::Solids,
};
use glam::{DVec2, IVec2, Vec2};

/// Joined pieces that reach further from their middle than this (d) are drops of their own: the new particle takes the
/// place of one of them instead of the empty middle. Four in a square of 1 d reach 0.35 d.
const FURTHEST: f64 = 1.0;
/// Rounding of a weight.
const SLACK: f64 = 1e-6;
/// Distance of a particle that is moved out of rock from its face, d.
const FACE_GAP: f32 = 1.0 / 256.0;

/// A part of a particle, in the new d.
#[derive(Clone, Copy)]
struct Piece {
    element: ElementId,
    at: Vec2,
    velocity: DVec2,
    push: DVec2,
    /// Quanta.
    heat: i32,
}

/// What was joined so far.
#[derive(Default)]
struct Heap {
    weight: f64,
    /// Sums, each piece by its weight.
    at: DVec2,
    velocity: DVec2,
    push: DVec2,
    heat: f64,
    places: Vec<Vec2>,
}

impl Heap {
    fn add(&mut self, piece: &Piece, weight: f64) {
        self.weight += weight;
        self.at += weight * piece.at.as_dvec2();
        self.velocity += weight * piece.velocity;
        self.push += weight * piece.push;
        self.heat += weight * f64::from(piece.heat);
        self.places.push(piece.at);
    }

    /// Where its particle stands: in the middle, or at the piece that is nearest to it if the pieces lie far apart.
    fn place(&self) -> Vec2 {
        let middle = self.at / self.weight;
        let from = |place: &Vec2| place.as_dvec2().distance_squared(middle);
        let nearest = self.places.iter().min_by(|a, b| from(a).total_cmp(&from(b)));
        let is_apart = self.places.iter().any(|place| from(place) > FURTHEST * FURTHEST);
        nearest.filter(|_| is_apart).copied().unwrap_or(middle.as_vec2())
    }
}

/// The same matter in particles of another size, in a box `domain` with `solids`, both of the new d. Ids count from
/// `next_id` on.
///
/// With a whole factor n each particle becomes n × n in a square around it: mass, momentum and centre of mass are the
/// same to the rounding of a sum, but for those that rock or a wall moves aside. Otherwise the pieces of ⌈factor⌉² each
/// are joined in the order of a Hilbert curve, element by element, a piece being cut where a particle is full: mass and
/// momentum are carried from particle to particle and none is lost. What is left over at the end is a particle if it is
/// half of one, else its momentum goes to the one before.
pub fn resample_particles(
    old: &Particles,
    factor: f64,
    solids: &Solids,
    domain: &Domain,
    next_id: &mut u32,
) -> Particles {
    let parts = (factor - SLACK).ceil().max(1.0);
    let weight = factor * factor / (parts * parts);
    let mut pieces = Vec::with_capacity(old.len() * (parts * parts) as usize);
    for i in old.in_id_order() {
        cut(&old.get(i as usize), factor, parts as i32, solids, domain, &mut pieces);
    }
    let mut made = Maker { solids, domain, next_id, particles: Particles::default() };
    if (weight - 1.0).abs() < SLACK {
        pieces.iter().for_each(|piece| made.add(piece.element, piece.at, [piece.velocity, piece.push], piece.heat));
    } else {
        pieces.sort_by_key(|piece| (piece.element, along(piece.at)));
        pieces.chunk_by(|a, b| a.element == b.element).for_each(|pieces| join(pieces, weight, &mut made));
    }
    made.particles
}

/// Cuts a particle into `parts` × `parts` pieces around it, none of which a wall parts from it.
fn cut(particle: &Particle, factor: f64, parts: i32, solids: &Solids, domain: &Domain, pieces: &mut Vec<Piece>) {
    let Particle { element, x, y, vx, vy, push_x, push_y, heat, .. } = *particle;
    let scaled = |x: f32, y: f32| factor * DVec2::new(f64::from(x), f64::from(y));
    let middle = scaled(x, y);
    let inside = domain.keep_inside(middle.as_vec2());
    let is_free = !solids.is_solid(Solids::cell_of(inside));
    let edge = factor / f64::from(parts);
    for k in 0..parts * parts {
        let step = DVec2::new(f64::from(k % parts), f64::from(k / parts)) + 0.5 - 0.5 * f64::from(parts);
        let target = domain.keep_inside((middle + edge * step).as_vec2());
        let at = if is_free { solids.sweep(inside, target) } else { target };
        pieces.push(Piece { element, at, velocity: scaled(vx, vy), push: scaled(push_x, push_y), heat });
    }
}

/// Joins pieces of `weight` to particles, in their order.
fn join(pieces: &[Piece], weight: f64, made: &mut Maker) {
    let Some(element) = pieces.first().map(|piece| piece.element) else { return };
    let before = made.particles.len();
    let mut heap = Heap::default();
    for piece in pieces {
        let mut left = weight;
        while heap.weight + left >= 1.0 - SLACK {
            let part = 1.0 - heap.weight;
            heap.add(piece, part);
            made.add(element, heap.place(), [heap.velocity, heap.push], heap.heat.round() as i32);
            heap = Heap::default();
            left -= part;
        }
        if left > SLACK {
            heap.add(piece, left);
        }
    }
    // The sums are momenta: as velocities of a whole particle, or as what a whole one gains, they keep theirs.
    let last = made.particles.len();
    if heap.weight >= 0.5 || heap.weight > 0.0 && last == before {
        made.add(element, heap.place(), [heap.velocity, heap.push], (heap.heat / heap.weight).round() as i32);
    } else if last > before {
        let Particles { vx, vy, push_x, push_y, .. } = &mut made.particles;
        for (own, more) in [(vx, heap.velocity.x), (vy, heap.velocity.y), (push_x, heap.push.x), (push_y, heap.push.y)]
        {
            own[last - 1] += more as f32;
        }
        let held = f64::from(made.particles.heat_of(last - 1));
        made.particles.set_heat(last - 1, (held + heap.heat).round() as i32);
    }
}

/// Puts new particles into the box.
struct Maker<'a> {
    solids: &'a Solids,
    domain: &'a Domain,
    next_id: &'a mut u32,
    particles: Particles,
}

impl Maker<'_> {
    fn add(&mut self, element: ElementId, at: Vec2, [velocity, push]: [DVec2; 2], heat: i32) {
        let at = nearest_free(self.domain.keep_inside(at), self.solids, self.domain);
        let (id, [vx, vy], [push_x, push_y]) =
            (*self.next_id, velocity.as_vec2().to_array(), push.as_vec2().to_array());
        self.particles.add(Particle { id, element, x: at.x, y: at.y, vx, vy, push_x, push_y, heat });
        *self.next_id += 1;
    }
}

/// The place itself if it is free, else the nearest one in a free cell.
fn nearest_free(at: Vec2, solids: &Solids, domain: &Domain) -> Vec2 {
    let cell = Solids::cell_of(at);
    if !solids.is_solid(cell) {
        return at;
    }
    let mut best: Option<(f32, Vec2)> = None;
    for ring in 1..solids.columns().max(solids.rows()) {
        // A cell of a ring is at least `ring` − 1 away.
        if best.is_some_and(|(distance, _)| distance <= (ring - 1) as f32) {
            break;
        }
        for step in around(ring).filter(|step| !solids.is_solid(cell + *step)) {
            let low = (cell + step).as_vec2();
            let place = domain.keep_inside(at.clamp(low + FACE_GAP, low + 1.0 - FACE_GAP));
            let distance = place.distance(at);
            if !solids.is_solid(Solids::cell_of(place)) && best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, place));
            }
        }
    }
    best.map_or(at, |(_, place)| place)
}

/// The cells of a square ring around a cell.
fn around(ring: i32) -> impl Iterator<Item = IVec2> {
    let square = (-ring..=ring).flat_map(move |y| (-ring..=ring).map(move |x| IVec2::new(x, y)));
    square.filter(move |step| step.abs().max_element() == ring)
}
