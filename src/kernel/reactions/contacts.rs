//! Who touches whom, and which contacts' dice fell.

use super::table::ReactionTable;
use crate::{
    cells::{Cells, mark},
    element::ElementId,
    heat::Warm,
    parallel::{WORTH_A_PIECE, spread},
    random::mix,
    solids::{Solids, centre},
};
use glam::IVec2;

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
    /// Particles that may react, in cells as wide as their reach.
    cells: Cells,
    /// The lowest contact of each particle.
    lowest: Vec<Option<Fallen>>,
    /// What each element may react with.
    wanted: Vec<Wanted>,
}

/// What an element may react with, among what is there.
#[derive(Clone, Copy, Debug, Default)]
struct Wanted {
    /// The elements, as [`mark`] has them.
    marks: u64,
    /// Whether one of them is fixed.
    rock: bool,
}

impl Contacts {
    /// Finds the lowest contact of each particle among those whose dice fell. `counts`: lumps of each element.
    pub fn find(&mut self, warm: &Warm, reactions: &ReactionTable, counts: &[u32], tick: u64, threads: usize) {
        self.find_wanted(warm, reactions, counts);
        let Self { cells, lowest, wanted } = self;
        let wanted = &wanted[..];
        cells.sort(warm.particles, warm.domain.size, TOUCH, |element| wanted[element.index()].marks != 0);
        let cells = &*cells;
        let (particles, solids) = (&*warm.particles, &*warm.solids);
        lowest.clear();
        lowest.resize(cells.order().len(), None);
        let die = Dice { warm, reactions, tick: mix(tick as u32) };
        spread([&mut lowest[..]], PIECE, threads, &|first, [lowest]| {
            for (k, lowest) in lowest.iter_mut().enumerate() {
                let i = cells.order()[first + k] as usize;
                let (at, own) = (particles.position(i), die.particle(i));
                let wanted = wanted[own.element.index()];
                let mut take = |fallen: Option<Fallen>| {
                    let lower = fallen.filter(|fallen| lowest.is_none_or(|lowest| fallen.rank < lowest.rank));
                    *lowest = lower.or(*lowest);
                };
                for (_, near) in cells.around(at).filter(|(marks, _)| marks & wanted.marks != 0) {
                    for &j in near {
                        let other = j as usize;
                        let touches = || particles.position(other).distance_squared(at) <= TOUCH * TOUCH;
                        if other != i {
                            take(die.throw(own, die.particle(other), Partner::Particle(j), touches));
                        }
                    }
                }
                if !wanted.rock {
                    continue;
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
        self.cells.order().iter().zip(&self.lowest).filter_map(|(i, fallen)| Some((*i as usize, (*fallen)?)))
    }

    /// Notes what each element may react with.
    fn find_wanted(&mut self, warm: &Warm, reactions: &ReactionTable, counts: &[u32]) {
        self.wanted.clear();
        self.wanted.resize(counts.len(), Wanted::default());
        for [a, b] in reactions.pairs() {
            if counts[a.index()] == 0 || counts[b.index()] == 0 {
                continue;
            }
            for [own, other] in [[a, b], [b, a]] {
                let wanted = &mut self.wanted[own.index()];
                wanted.marks |= mark(*other);
                wanted.rock |= warm.elements.get(*other).fixed;
            }
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.cells.memory()
            + size_of::<Option<Fallen>>() * self.lowest.capacity()
            + size_of::<Wanted>() * self.wanted.capacity()
    }
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
