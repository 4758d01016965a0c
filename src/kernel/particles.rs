//! The store of movable particles: one array per quantity, sorted by cell each substep, with ids that survive the sort.
//!
//! The columns are declared once, in the list below. Appending, copying, sorting, hashing, marks, saves, the checks of a
//! file, the table of particles and the count of memory follow from it. A new column is a line there and one in
//! [`Particles::push`]; a new type of column implements [`Column`], and a new kind of quantity is a variant of [`Value`].

use crate::{
    columns::{Column, ColumnVisitor, Spares, are_sound, reorder},
    element::{ElementId, ElementTable},
    simd::{InstructionSet, Lanes, MOST_LANES, Pass},
    units::Scale,
};
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A number of a particle, with what it counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number that stays.
    Id(u32),
    /// A row of the element table.
    Element(ElementId),
    /// A coordinate, d.
    Length(f32),
    /// A component of a velocity, d/s.
    Velocity(f32),
}

impl Value {
    /// Its bits.
    pub fn word(self) -> u32 {
        match self {
            Self::Id(value) => value.word(),
            Self::Element(value) => value.word(),
            Self::Length(value) | Self::Velocity(value) => value.word(),
        }
    }

    /// How tables write it: elements by name, all else in SI units.
    pub fn text(self, elements: &ElementTable, scale: Scale) -> String {
        match self {
            Self::Id(value) => value.to_string(),
            Self::Element(value) => elements.get(value).name.clone(),
            Self::Length(value) | Self::Velocity(value) => scale.to_metres(value).to_string(),
        }
    }

    /// Whether it is a number within all bounds.
    pub fn is_sound(self) -> bool {
        match self {
            Self::Id(_) | Self::Element(_) => true,
            Self::Length(value) | Self::Velocity(value) => value.is_sound(),
        }
    }
}

/// Declares the columns: `name: type as what it counts`.
macro_rules! columns {
    ($($(#[$doc:meta])* $name:ident: $type:ty as $value:ident,)*) => {
        /// A particle by itself.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Particle {
            $($(#[$doc])* pub $name: $type,)*
        }

        impl Particle {
            /// Its numbers, in the order of [`Particles::COLUMNS`].
            pub fn values(&self) -> [Value; Particles::COLUMNS.len()] {
                [$(Value::$value(self.$name)),*]
            }
        }

        /// Movable particles. All arrays have one entry per particle, in the same order; the order changes with every
        /// sort.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Particles {
            $($(#[$doc])* pub $name: Vec<$type>,)*
        }

        impl Particles {
            /// Names of the columns. States are hashed and written in this order.
            pub const COLUMNS: &[&str] = &[$(stringify!($name)),*];
            /// Bytes that a particle takes.
            pub const BYTES: usize = 0 $(+ size_of::<$type>())*;

            /// Particle `i`.
            pub fn get(&self, i: usize) -> Particle {
                Particle { $($name: self.$name[i]),* }
            }

            /// Appends a particle.
            pub fn add(&mut self, particle: Particle) {
                $(self.$name.push(particle.$name);)*
            }

            /// Appends those of `other` in `range`, in their order.
            pub(crate) fn append(&mut self, other: &Self, range: Range<usize>) {
                $(self.$name.extend_from_slice(&other.$name[range.clone()]);)*
            }

            /// Overwrites particle `to` with particle `i`.
            pub(crate) fn copy(&mut self, i: usize, to: usize) {
                $(self.$name[to] = self.$name[i];)*
            }

            /// Overwrites particle `to` with particle `i` of `other`.
            pub(crate) fn copy_from(&mut self, other: &Self, i: usize, to: usize) {
                $(self.$name[to] = other.$name[i];)*
            }

            /// Keeps the first `len`.
            pub(crate) fn truncate(&mut self, len: usize) {
                $(self.$name.truncate(len);)*
            }

            /// Brings the particles into an order: at each place comes the one that was at `order[place]`.
            pub(crate) fn reorder(&mut self, order: &[u32], mut spares: Spares, threads: usize) {
                $(reorder(&mut self.$name, order, &mut spares, threads);)*
            }

            /// Whether all numbers of the particles in `range` are within all bounds.
            pub(crate) fn are_sound(&self, range: Range<usize>) -> bool {
                true $(&& are_sound(&self.$name[range.clone()]))*
            }

            /// Whether all columns are of one length.
            pub fn has_equal_columns(&self) -> bool {
                true $(&& self.$name.len() == self.len())*
            }

            /// Shows all columns, in the order of [`Particles::COLUMNS`].
            pub fn visit(&self, visitor: &mut impl ColumnVisitor) {
                $(visitor.visit(&self.$name);)*
            }

            /// Bytes held.
            pub fn memory(&self) -> usize {
                0 $(+ size_of::<$type>() * self.$name.capacity())*
            }
        }
    };
}

columns! {
    /// Number that stays with the particle for life, unique in its world.
    id: u32 as Id,
    /// What it is made of.
    element: ElementId as Element,
    /// Position, d.
    x: f32 as Length,
    /// Position, d.
    y: f32 as Length,
    /// Velocity, d/s.
    vx: f32 as Velocity,
    /// Velocity, d/s.
    vy: f32 as Velocity,
    /// What pressure and contact add to the velocity in the second half of a substep, d/s: as much as in the first. The
    /// next substep begins without it (see [`forces::begin_kick`](crate::forces::begin_kick)).
    push_x: f32 as Velocity,
    /// The same along y, d/s.
    push_y: f32 as Velocity,
}

impl Particles {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Appends a new particle.
    pub fn push(&mut self, id: u32, element: ElementId, position: Vec2, velocity: Vec2) {
        let (Vec2 { x, y }, Vec2 { x: vx, y: vy }) = (position, velocity);
        self.add(Particle { id, element, x, y, vx, vy, push_x: 0.0, push_y: 0.0 });
    }

    /// Position of particle `i`, d.
    pub fn position(&self, i: usize) -> Vec2 {
        Vec2::new(self.x[i], self.y[i])
    }

    /// Velocity of particle `i`, d/s.
    pub fn velocity(&self, i: usize) -> Vec2 {
        Vec2::new(self.vx[i], self.vy[i])
    }

    /// Keeps the particles for which `keep(i)` holds, in their order; returns how many went.
    pub fn retain(&mut self, keep: impl Fn(&Self, usize) -> bool) -> usize {
        let before = self.len();
        let mut kept = 0;
        for i in 0..before {
            if keep(self, i) {
                self.copy(i, kept);
                kept += 1;
            }
        }
        self.truncate(kept);
        before - kept
    }

    /// Forgets all.
    pub(crate) fn clear(&mut self) {
        self.truncate(0);
    }

    /// Indices in the order of the ids: the order in which states are hashed and written.
    pub fn in_id_order(&self) -> Vec<u32> {
        let mut order: Vec<u32> = (0..self.len() as u32).collect();
        order.sort_unstable_by_key(|&i| self.id[i as usize]);
        order
    }
}

/// The lowest and the highest of some numbers; the other way round if there is none.
pub(crate) fn extent(numbers: &[f32], instructions: InstructionSet) -> [f32; 2] {
    let mut ends = [f32::MAX, f32::MIN];
    instructions.run(Extent { numbers, ends: &mut ends });
    ends
}

struct Extent<'a> {
    numbers: &'a [f32],
    /// Out: the lowest and the highest.
    ends: &'a mut [f32; 2],
}

impl Pass for Extent<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (mut low, mut high) = (L::splat(f32::MAX), L::splat(f32::MIN));
        let blocks = self.numbers.chunks_exact(L::WIDTH);
        let rest = blocks.remainder();
        for block in blocks {
            let block = L::load(block);
            (low, high) = (low.min(block), high.max(block));
        }
        let mut lanes = [[0.0; MOST_LANES]; 2];
        low.store(&mut lanes[0]);
        high.store(&mut lanes[1]);
        let [low, high] = lanes.map(|lanes| lanes.into_iter().take(L::WIDTH).chain(rest.iter().copied()));
        *self.ends = [low.fold(f32::MAX, f32::min), high.fold(f32::MIN, f32::max)];
    }
}
