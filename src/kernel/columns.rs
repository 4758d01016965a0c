//! What every column of the particles can do, whatever its type.

use crate::{element::ElementId, parallel::spread};
use std::{mem::swap, ops::Range};

/// Fewer entries than this are not handed to another thread to be brought into an order.
const WORTH_REORDERING: usize = 8192;
/// Entries that are checked together.
const BLOCK: usize = 256;
/// Beyond this, in d or d/s, a value is a fault and not a motion.
pub const ABSURD: f32 = 1e9;

/// Entry of a column.
pub trait Column: Copy + Default + Send + Sync {
    /// Its bits.
    fn word(self) -> u32;

    /// Whether it is a number within all bounds.
    fn is_sound(self) -> bool {
        true
    }

    /// The buffer for columns of this type.
    #[doc(hidden)]
    fn spare<'a>(spares: &'a mut Spares) -> &'a mut Vec<Self>;
}

/// A buffer for a column of each type, in which it is brought into another order. It is swapped with the column, so it then
/// holds the column as it was.
#[derive(Debug)]
pub struct Spares<'a> {
    pub(crate) floats: &'a mut Vec<f32>,
    pub(crate) words: &'a mut Vec<u32>,
    pub(crate) elements: &'a mut Vec<ElementId>,
    pub(crate) heats: &'a mut Vec<i32>,
}

impl Column for f32 {
    #[inline(always)]
    fn word(self) -> u32 {
        self.to_bits()
    }

    #[inline(always)]
    fn is_sound(self) -> bool {
        self.abs() < ABSURD
    }

    fn spare<'a>(spares: &'a mut Spares) -> &'a mut Vec<Self> {
        spares.floats
    }
}

impl Column for u32 {
    #[inline(always)]
    fn word(self) -> u32 {
        self
    }

    fn spare<'a>(spares: &'a mut Spares) -> &'a mut Vec<Self> {
        spares.words
    }
}

impl Column for i32 {
    #[inline(always)]
    fn word(self) -> u32 {
        self as u32
    }

    fn spare<'a>(spares: &'a mut Spares) -> &'a mut Vec<Self> {
        spares.heats
    }
}

impl Column for ElementId {
    #[inline(always)]
    fn word(self) -> u32 {
        u32::from(self.0)
    }

    fn spare<'a>(spares: &'a mut Spares) -> &'a mut Vec<Self> {
        spares.elements
    }
}

/// Looks at columns, whatever their types.
pub trait ColumnVisitor {
    /// Looks at a column.
    fn visit<T: Column>(&mut self, column: &[T]);
}

/// What a sparse column can do: one that is empty as long as all its entries are their type's default, and else has an entry a
/// particle. `len` is how many particles there are.
pub(crate) trait Sparse<T> {
    /// Entry `i`.
    fn entry(&self, i: usize) -> T;

    /// Sets entry `i`.
    fn put(&mut self, i: usize, value: T, len: usize);

    /// Appends the entries `range` of another column.
    fn join(&mut self, other: &Self, range: Range<usize>, len: usize);
}

impl<T: Column + PartialEq> Sparse<T> for Vec<T> {
    #[inline(always)]
    fn entry(&self, i: usize) -> T {
        self.get(i).copied().unwrap_or_default()
    }

    #[inline(always)]
    fn put(&mut self, i: usize, value: T, len: usize) {
        if !self.is_empty() || value != T::default() {
            put_there(self, i, value, len);
        }
    }

    fn join(&mut self, other: &Self, range: Range<usize>, len: usize) {
        match (self.is_empty(), other.is_empty()) {
            (true, true) => {}
            (false, true) => self.resize(len + range.len(), T::default()),
            (_, false) => {
                self.resize(len, T::default());
                self.extend_from_slice(&other[range]);
            }
        }
    }
}

/// A function of its own, as most columns never come to it.
#[inline(never)]
fn put_there<T: Column>(column: &mut Vec<T>, i: usize, value: T, len: usize) {
    column.resize(len, T::default());
    column[i] = value;
}

/// Brings a column into an order: at each place comes the entry that was at `order[place]`.
pub(crate) fn reorder<T: Column>(column: &mut Vec<T>, order: &[u32], spares: &mut Spares, threads: usize) {
    let spare = T::spare(spares);
    spare.resize(column.len(), T::default());
    spread([&mut spare[..]], WORTH_REORDERING, threads, &|base, [sorted]| {
        fetch(sorted, column, &order[base..base + sorted.len()]);
    });
    swap(column, spare);
}

/// Sets each value to that at its place in `order`. A function of its own, so that the compiler knows of slices that do not
/// overlap.
fn fetch<T: Copy>(values: &mut [T], from: &[T], order: &[u32]) {
    for (value, &place) in values.iter_mut().zip(order) {
        *value = from[place as usize];
    }
}

/// Whether all entries are within all bounds.
pub(crate) fn are_sound<T: Column>(column: &[T]) -> bool {
    column.chunks(BLOCK).all(|block| block.iter().fold(true, |all, value| all & value.is_sound()))
}
