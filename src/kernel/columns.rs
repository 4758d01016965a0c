//! What every column of the particles can do, whatever its type.

use crate::{element::ElementId, parallel::spread};
use bytemuck::cast_vec;
use std::{
    mem::{swap, take},
    ops::Range,
};

/// Fewer entries than this are not handed to another thread to be brought into an order.
const WORTH_REORDERING: usize = 2048;
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

    /// Lets `work` use the buffer for columns of this type.
    #[doc(hidden)]
    fn with_spare(spares: &mut Spares, work: impl FnOnce(&mut Vec<Self>));
}

/// Buffers in which columns are brought into another order: one for all whose entries take four bytes. It is swapped with the
/// column, so it then holds the column as it was.
#[derive(Debug)]
pub struct Spares<'a> {
    pub(crate) words: &'a mut Vec<u32>,
    pub(crate) elements: &'a mut Vec<ElementId>,
}

impl Spares<'_> {
    /// The words as numbers of another type.
    fn with_words<T: bytemuck::Pod>(&mut self, work: impl FnOnce(&mut Vec<T>)) {
        let mut words = cast_vec(take(self.words));
        work(&mut words);
        *self.words = cast_vec(words);
    }
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

    fn with_spare(spares: &mut Spares, work: impl FnOnce(&mut Vec<Self>)) {
        spares.with_words(work);
    }
}

impl Column for u32 {
    #[inline(always)]
    fn word(self) -> u32 {
        self
    }

    fn with_spare(spares: &mut Spares, work: impl FnOnce(&mut Vec<Self>)) {
        spares.with_words(work);
    }
}

impl Column for i32 {
    #[inline(always)]
    fn word(self) -> u32 {
        self as u32
    }

    fn with_spare(spares: &mut Spares, work: impl FnOnce(&mut Vec<Self>)) {
        spares.with_words(work);
    }
}

impl Column for ElementId {
    #[inline(always)]
    fn word(self) -> u32 {
        u32::from(self.0)
    }

    fn with_spare(spares: &mut Spares, work: impl FnOnce(&mut Vec<Self>)) {
        work(spares.elements);
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
    T::with_spare(spares, |spare| {
        spare.resize(column.len(), T::default());
        spread([&mut spare[..]], WORTH_REORDERING, threads, &|base, [sorted]| {
            fetch(sorted, column, &order[base..base + sorted.len()]);
        });
        swap(column, spare);
    });
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
