//! The store of movable particles: one array per quantity, sorted by cell each substep, with ids that survive the sort.
//!
//! The columns are declared once, in the list below. Appending, copying, sorting, hashing, marks, saves, the checks of a
//! file, the table of particles and the count of memory follow from it. A new column is a line there and one in
//! [`Particles::push`]; those that most worlds do without are sparse, and take no room there. A new type of column implements [`Column`], and a new kind of quantity is a variant of [`Value`].

use crate::{
    columns::{Column, ColumnVisitor, Spares, Sparse, are_sound, reorder},
    element::{ElementId, ElementTable},
    heat::units::QUANTUM,
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
    /// Heat, quanta.
    Heat(i32),
}

impl Value {
    /// Its bits.
    pub fn word(self) -> u32 {
        match self {
            Self::Id(value) => value.word(),
            Self::Element(value) => value.word(),
            Self::Length(value) | Self::Velocity(value) => value.word(),
            Self::Heat(value) => value.word(),
        }
    }

    /// How tables write it: elements by name, all else in SI units.
    pub fn text(self, elements: &ElementTable, scale: Scale) -> String {
        match self {
            Self::Id(value) => value.to_string(),
            Self::Element(value) => elements.get(value).name.clone(),
            Self::Length(value) | Self::Velocity(value) => scale.to_metres(value).to_string(),
            Self::Heat(value) => (i64::from(value) * i64::from(QUANTUM as i32)).to_string(),
        }
    }

    /// Whether it is a number within all bounds.
    pub fn is_sound(self) -> bool {
        match self {
            Self::Id(_) | Self::Element(_) | Self::Heat(_) => true,
            Self::Length(value) | Self::Velocity(value) => value.is_sound(),
        }
    }

    /// Whether it is what most worlds do without, and not to be counted as a part of their state: heat where there is none.
    pub fn is_absent(self) -> bool {
        self == Self::Heat(0)
    }
}

/// Declares the columns: `name: type as what it counts`. Those behind `sparse` are empty as long as all entries are the type's
/// default.
macro_rules! columns {
    (
        $($(#[$doc:meta])* $name:ident: $type:ty as $value:ident,)*
        ; sparse $($(#[$few_doc:meta])* $few:ident: $few_type:ty as $few_value:ident,)*
    ) => {
        /// A particle by itself.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Particle {
            $($(#[$doc])* pub $name: $type,)*
            $($(#[$few_doc])* pub $few: $few_type,)*
        }

        impl Particle {
            /// Its numbers, in the order of [`Particles::COLUMNS`].
            pub fn values(&self) -> [Value; Particles::COLUMNS.len()] {
                [$(Value::$value(self.$name),)* $(Value::$few_value(self.$few),)*]
            }
        }

        /// Movable particles. All arrays have one entry per particle, in the same order, or none if they are sparse; the order
        /// changes with every sort.
        #[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Particles {
            $($(#[$doc])* pub $name: Vec<$type>,)*
            $($(#[$few_doc])* pub(crate) $few: Vec<$few_type>,)*
        }

        impl Clone for Particles {
            fn clone(&self) -> Self {
                Self { $($name: self.$name.clone(),)* $($few: self.$few.clone(),)* }
            }

            /// Without new memory where the old is enough; a derived one would ask for it.
            fn clone_from(&mut self, other: &Self) {
                $(self.$name.clone_from(&other.$name);)*
                $(self.$few.clone_from(&other.$few);)*
            }
        }

        impl Particles {
            /// Names of the columns. States are hashed and written in this order.
            pub const COLUMNS: &[&str] = &[$(stringify!($name),)* $(stringify!($few),)*];
            /// Bytes that a particle takes where all columns are there.
            pub const BYTES: usize = 0 $(+ size_of::<$type>())* $(+ size_of::<$few_type>())*;

            /// Particle `i`.
            pub fn get(&self, i: usize) -> Particle {
                Particle { $($name: self.$name[i],)* $($few: self.$few.entry(i),)* }
            }

            /// Appends a particle.
            pub fn add(&mut self, particle: Particle) {
                $(self.$name.push(particle.$name);)*
                let len = self.len();
                $(self.$few.put(len - 1, particle.$few, len);)*
            }

            /// Appends those of `other` in `range`, in their order.
            pub(crate) fn append(&mut self, other: &Self, range: Range<usize>) {
                let len = self.len();
                $(self.$few.join(&other.$few, range.clone(), len);)*
                $(self.$name.extend_from_slice(&other.$name[range.clone()]);)*
            }

            /// Overwrites particle `to` with particle `i`.
            pub(crate) fn copy(&mut self, i: usize, to: usize) {
                $(self.$name[to] = self.$name[i];)*
                let len = self.len();
                $(self.$few.put(to, self.$few.entry(i), len);)*
            }

            /// Overwrites particle `to` with particle `i` of `other`.
            pub(crate) fn copy_from(&mut self, other: &Self, i: usize, to: usize) {
                $(self.$name[to] = other.$name[i];)*
                let len = self.len();
                $(self.$few.put(to, other.$few.entry(i), len);)*
            }

            /// Keeps the first `len`.
            pub(crate) fn truncate(&mut self, len: usize) {
                $(self.$name.truncate(len);)*
                $(self.$few.truncate(len);)*
            }

            /// Brings the particles into an order: at each place comes the one that was at `order[place]`.
            pub(crate) fn reorder(&mut self, order: &[u32], mut spares: Spares, threads: usize) {
                $(reorder(&mut self.$name, order, &mut spares, threads);)*
                $(if !self.$few.is_empty() {
                    reorder(&mut self.$few, order, &mut spares, threads);
                })*
            }

            /// Whether all numbers of the particles in `range` are within all bounds.
            pub(crate) fn are_sound(&self, range: Range<usize>) -> bool {
                true $(&& are_sound(&self.$name[range.clone()]))*
            }

            /// Whether all columns are of one length, and sparse ones empty or so.
            pub fn has_equal_columns(&self) -> bool {
                true $(&& self.$name.len() == self.len())* $(&& [0, self.len()].contains(&self.$few.len()))*
            }

            /// Shows all columns, in the order of [`Particles::COLUMNS`].
            pub fn visit(&self, visitor: &mut impl ColumnVisitor) {
                $(visitor.visit(&self.$name);)*
                $(if !self.$few.is_empty() {
                    visitor.visit(&self.$few);
                })*
            }

            /// Bytes held.
            pub fn memory(&self) -> usize {
                0 $(+ size_of::<$type>() * self.$name.capacity())* $(+ size_of::<$few_type>() * self.$few.capacity())*
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
    ; sparse
    /// Heat beyond what its element holds at the room's temperature, quanta ([`heat`](crate::heat)).
    heat: i32 as Heat,
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
        self.add(Particle { id, element, x, y, vx, vy, push_x: 0.0, push_y: 0.0, heat: 0 });
    }

    /// Appends a new particle that holds heat (quanta).
    pub fn push_warm(&mut self, id: u32, element: ElementId, position: Vec2, velocity: Vec2, heat: i32) {
        self.push(id, element, position, velocity);
        self.set_heat(self.len() - 1, heat);
    }

    /// Heat of particle `i`, quanta.
    #[inline(always)]
    pub fn heat_of(&self, i: usize) -> i32 {
        self.heat.entry(i)
    }

    /// Sets the heat of particle `i`, quanta.
    pub fn set_heat(&mut self, i: usize, heat: i32) {
        let len = self.len();
        self.heat.put(i, heat, len);
    }

    /// Whether any of them is or was not at the room's temperature.
    pub fn has_heat(&self) -> bool {
        !self.heat.is_empty()
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
        // Up to the first that goes, all are where they belong.
        let Some(first) = (0..before).find(|&i| !keep(self, i)) else { return 0 };
        let mut kept = first;
        for i in first + 1..before {
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
