//! Who touches whom, and which contacts' dice fell.

use super::table::ReactionTable;
use crate::{
    element::ElementId,
    heat::Warm,
    parallel::{WORTH_A_PIECE, spread},
    random::mix,
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};

/// Distance up to which lumps touch, d: neighbours on the lattice do, those across a diagonal don't.
const TOUCH: f32 = 1.25;
/// Particles that are worth a piece of their own.
const PIECE: usize = WORTH_A_PIECE / 8;

/// What a particle touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Partner {
    Particle(u32),
    Rock(IVec2),
}

/// A contact whose die fell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fallen {
    /// Its rank, from the lowest, which reacts first: the die, and the ids in rising order.
    pub rank: (u32, [u32; 2]),
    pub partner: Partner,
    pub reaction: usize,
}

/// Buffers of the search, which are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Contacts {
    /// Cells of a row, with one before and one behind the box.
    stride: usize,
    rows: usize,
    /// The first of each cell in `order`, and the end.
    starts: Vec<u32>,
    /// Particles that may react, cell by cell.
    order: Vec<u32>,
    /// The lowest contact of each particle.
    lowest: Vec<Option<Fallen>>,
    /// Whether something is there that each element reacts with.
    takes_part: Vec<bool>,
}

impl Contacts {
    /// Finds the lowest contact of each particle among those whose dice fell. `counts`: lumps of each element.
    pub fn find(&mut self, warm: &Warm, reactions: &ReactionTable, counts: &[u32], tick: u64, threads: usize) {
        self.takes_part.clear();
        self.takes_part.resize(counts.len(), false);
        for [a, b] in reactions.pairs() {
            if counts[a.index()] > 0 && counts[b.index()] > 0 {
                (self.takes_part[a.index()], self.takes_part[b.index()]) = (true, true);
            }
        }
        self.sort(warm);
        let Self { stride, starts, order, lowest, .. } = self;
        let (stride, starts, order) = (*stride, &starts[..], &order[..]);
        let (particles, solids) = (&*warm.particles, &*warm.solids);
        lowest.clear();
        lowest.resize(order.len(), None);
        let die = Dice { warm, reactions, tick: mix(tick as u32) };
        spread([&mut lowest[..]], PIECE, threads, &|first, [lowest]| {
            for (k, lowest) in lowest.iter_mut().enumerate() {
                let i = order[first + k] as usize;
                let (at, own) = (particles.position(i), die.particle(i));
                let mut take = |fallen: Option<Fallen>| {
                    let lower = fallen.filter(|fallen| lowest.is_none_or(|lowest| fallen.rank < lowest.rank));
                    *lowest = lower.or(*lowest);
                };
                let cell = cell_of(at, stride, starts.len() / stride);
                for cell in [cell - stride, cell, cell + stride] {
                    for &j in &order[starts[cell - 1] as usize..starts[cell + 2] as usize] {
                        let other = j as usize;
                        let touches = || particles.position(other).distance_squared(at) <= TOUCH * TOUCH;
                        if other != i {
                            take(die.throw(own, die.particle(other), Partner::Particle(j), touches));
                        }
                    }
                }
                let own_cell = Solids::cell_of(at);
                for place in 0..9 {
                    let cell = own_cell + IVec2::new(place % 3 - 1, place / 3 - 1);
                    let Some((element, id)) = solids.get(cell) else { continue };
                    let rock = Lump { element, id, heat: solids.heat(cell) };
                    take(
                        die.throw(own, rock, Partner::Rock(cell), || {
                            centre(cell).distance_squared(at) <= TOUCH * TOUCH
                        }),
                    );
                }
            }
        });
    }

    /// What was found: particles, and the contact that each takes.
    pub fn fallen(&self) -> impl Iterator<Item = (usize, Fallen)> {
        self.order.iter().zip(&self.lowest).filter_map(|(i, fallen)| Some((*i as usize, (*fallen)?)))
    }

    /// Puts the particles that may react in the order of cells as wide as their reach.
    fn sort(&mut self, warm: &Warm) {
        let (particles, size) = (&*warm.particles, warm.domain.size);
        (self.stride, self.rows) = ((size.x / TOUCH) as usize + 3, (size.y / TOUCH) as usize + 3);
        let (stride, rows) = (self.stride, self.rows);
        let cell = |i: usize| cell_of(particles.position(i), stride, rows);
        let takes_part = |i: &usize| self.takes_part[particles.element[*i].index()];
        self.starts.clear();
        self.starts.resize(stride * rows + 2, 0);
        let mut count = 0;
        for i in (0..particles.len()).filter(takes_part) {
            self.starts[cell(i) + 2] += 1;
            count += 1;
        }
        for cell in 2..stride * rows + 2 {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.order.resize(count, 0);
        for i in (0..particles.len()).filter(takes_part) {
            let next = &mut self.starts[cell(i) + 1];
            self.order[*next as usize] = i as u32;
            *next += 1;
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        4 * (self.starts.capacity() + self.order.capacity())
            + size_of::<Option<Fallen>>() * self.lowest.capacity()
            + self.takes_part.capacity()
    }
}

fn cell_of(at: Vec2, stride: usize, rows: usize) -> usize {
    let along = |at: f32, most: usize| ((at * (1.0 / TOUCH)) as usize + 1).min(most - 2);
    along(at.y, rows) * stride + along(at.x, stride)
}

/// What the dice know of a lump.
#[derive(Clone, Copy)]
struct Lump {
    element: ElementId,
    id: u32,
    heat: i32,
}

/// The dice of a tick.
struct Dice<'a> {
    warm: &'a Warm<'a>,
    reactions: &'a ReactionTable,
    tick: u32,
}

impl Dice<'_> {
    fn particle(&self, i: usize) -> Lump {
        let particles = &*self.warm.particles;
        Lump { element: particles.element[i], id: particles.id[i], heat: particles.heat_of(i) }
    }

    /// Throws the die of a contact: the same from both sides.
    #[inline(always)]
    fn throw(&self, own: Lump, other: Lump, partner: Partner, touches: impl Fn() -> bool) -> Option<Fallen> {
        let reaction = self.reactions.find(own.element, other.element)?;
        let row = self.reactions.get(reaction);
        let ids = [own.id.min(other.id), own.id.max(other.id)];
        let die = mix(ids[0] ^ mix(ids[1] ^ mix(self.tick ^ reaction as u32)));
        let is_between = |lump: Lump| {
            let kelvin = self.warm.table.curve(lump.element).temperature(lump.heat);
            (row.between[0]..=row.between[1]).contains(&kelvin)
        };
        let has_fallen = die < row.threshold && touches() && is_between(own) && is_between(other);
        has_fallen.then_some(Fallen { rank: (die, ids), partner, reaction })
    }
}
