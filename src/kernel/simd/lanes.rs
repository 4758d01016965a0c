//! Numbers that are computed side by side, as plain arrays.

use std::ops::{Add, Div, Mul, Sub};

/// Most lanes of any instruction set.
pub(crate) const MOST_LANES: usize = 16;

/// `WIDTH` numbers that are computed side by side.
pub(crate) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Number of lanes.
    const WIDTH: usize;

    /// The same number in every lane.
    fn splat(value: f32) -> Self;

    /// The first numbers of the slice; lanes past its end are 0.
    fn load(from: &[f32]) -> Self;

    /// Writes the first lanes into the slice, as many as it holds.
    fn store(self, to: &mut [f32]);

    /// The numbers of a row from `first` on, which must fill the lanes. Cheaper than [`Lanes::load`], which must be
    /// ready for fewer.
    fn of(row: &[f32], first: usize) -> Self;

    /// Writes the lanes into a row from `first` on, which must hold them all.
    fn put(self, row: &mut [f32], first: usize);

    /// `if self > other { self } else { other }` in each lane.
    fn max(self, other: Self) -> Self;

    /// `if self < other { self } else { other }` in each lane.
    fn min(self, other: Self) -> Self;

    /// Square root of each lane.
    fn sqrt(self) -> Self;

    /// `if self < other { yes } else { no }` in each lane.
    fn if_less(self, other: Self, yes: Self, no: Self) -> Self;

    /// Sums of whole numbers, one a lane.
    type Sums: Copy;

    /// Sums of nothing.
    fn no_sums() -> Self::Sums;

    /// Adds the nearest whole number of each lane, of two as near the one away from 0, to the sum of that lane. So `x` and `-x`
    /// come to 0. Sums wrap; what is beyond 32 bits counts as the end of them.
    fn add_rounded(self, sums: Self::Sums) -> Self::Sums;

    /// The sums of the lanes; beyond them 0.
    fn sums(sums: Self::Sums) -> [i32; MOST_LANES];

    /// Magnitude of each lane.
    #[inline(always)]
    fn abs(self) -> Self {
        self.max(Self::splat(0.0) - self)
    }
}

/// `N` lanes as a plain array.
#[derive(Clone, Copy)]
pub(crate) struct Array<const N: usize>([f32; N]);

impl<const N: usize> Array<N> {
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|lane| operation(self.0[lane], other.0[lane])))
    }
}

/// An operator of lanes, from that of two numbers or registers.
macro_rules! operator {
    ($Operator:ident $name:ident [$($generics:tt)*] $Lanes:ty, $of_two:expr) => {
        impl $($generics)* $Operator for $Lanes {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                self.zip(other, $of_two)
            }
        }
    };
}
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(super) use operator;

operator!(Add add [<const N: usize>] Array<N>, |a, b| a + b);
operator!(Sub sub [<const N: usize>] Array<N>, |a, b| a - b);
operator!(Mul mul [<const N: usize>] Array<N>, |a, b| a * b);
operator!(Div div [<const N: usize>] Array<N>, |a, b| a / b);

impl<const N: usize> Lanes for Array<N> {
    const WIDTH: usize = N;
    type Sums = [i32; N];

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        if let Some(full) = from.first_chunk::<N>() {
            return Self(*full);
        }
        let mut lanes = [0.0; N];
        lanes[..from.len()].copy_from_slice(from);
        Self(lanes)
    }

    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        if let Some(full) = to.first_chunk_mut::<N>() {
            *full = self.0;
        } else {
            let lanes = to.len();
            to.copy_from_slice(&self.0[..lanes]);
        }
    }

    #[inline(always)]
    fn of(row: &[f32], first: usize) -> Self {
        match row[first..].first_chunk::<N>() {
            Some(full) => Self(*full),
            None => too_short(),
        }
    }

    #[inline(always)]
    fn put(self, row: &mut [f32], first: usize) {
        match row[first..].first_chunk_mut::<N>() {
            Some(full) => *full = self.0,
            None => too_short(),
        }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(std::array::from_fn(|lane| self.0[lane].sqrt()))
    }

    #[inline(always)]
    fn if_less(self, other: Self, yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|lane| if self.0[lane] < other.0[lane] { yes.0[lane] } else { no.0[lane] }))
    }

    #[inline(always)]
    fn no_sums() -> Self::Sums {
        [0; N]
    }

    #[inline(always)]
    fn add_rounded(self, sums: Self::Sums) -> Self::Sums {
        std::array::from_fn(|lane| sums[lane].wrapping_add(rounded(self.0[lane])))
    }

    #[inline(always)]
    fn sums(sums: Self::Sums) -> [i32; MOST_LANES] {
        let mut all = [0; MOST_LANES];
        all[..N].copy_from_slice(&sums);
        all
    }
}

/// The ends of the whole numbers of 32 bits that are numbers of single precision.
pub(super) const ENDS: [f32; 2] = [i32::MIN as f32, 2_147_483_520.0];

/// The nearest whole number, of two as near the one away from 0. What is beyond those of 32 bits counts as the end of them, what
/// is not a number as the lowest.
#[inline(always)]
pub(crate) fn rounded(value: f32) -> i32 {
    let away = value + if value < 0.0 { -0.5 } else { 0.5 };
    let away = if away > ENDS[0] { away } else { ENDS[0] };
    let away = if away < ENDS[1] { away } else { ENDS[1] };
    // A cast would check its range lane by lane, which takes five times as long.
    // SAFETY: it is a number between both ends, which are whole numbers of 32 bits.
    unsafe { away.to_int_unchecked() }
}

/// A value for each lane. (`array::from_fn` may be left as a function of its own, which is not compiled for the caller's registers.)
#[inline(always)]
pub(crate) fn each_lane<const N: usize, T: Copy + Default>(of: impl Fn(usize) -> T) -> [T; N] {
    let mut lanes = [T::default(); N];
    for (lane, value) in lanes.iter_mut().enumerate() {
        *value = of(lane);
    }
    lanes
}

/// The first `N` numbers, and 0 for what is missing.
#[inline(always)]
pub(crate) fn padded<const N: usize>(numbers: &[f32]) -> [f32; N] {
    numbers.first_chunk().copied().unwrap_or_else(|| {
        let mut lanes = [0.0; N];
        lanes[..numbers.len()].copy_from_slice(numbers);
        lanes
    })
}

/// The whole number at or just below one: 0 for what is below that or not a number, and 2³⁰ for what is beyond.
#[inline(always)]
pub(crate) fn truncated(value: f32) -> u32 {
    const MOST: f32 = 1_073_741_824.0;
    let value = if value > 0.0 { value } else { 0.0 };
    let value = if value < MOST { value } else { MOST };
    // As above.
    // SAFETY: it is a number between 0 and 2³⁰.
    let whole: i32 = unsafe { value.to_int_unchecked() };
    whole as u32
}

#[cold]
#[inline(never)]
pub(super) fn too_short() -> ! {
    panic!("the row ends within the lanes");
}

/// Where lanes begin, until each of `len` entries has been in lanes. The last lanes reach back over those before them
/// rather than past the end, so that no work may read what it writes.
///
/// # Panics
/// If `len` entries don't fill the lanes.
#[inline(always)]
pub(crate) fn lane_starts<L: Lanes>(len: usize) -> impl Iterator<Item = usize> {
    assert!(len >= L::WIDTH, "{len} entries don't fill {} lanes", L::WIDTH);
    (0..len).step_by(L::WIDTH).map(move |first| first.min(len - L::WIDTH))
}

/// The whole number at or just below `at`, within `low …= high`, and what is left. What is not a number counts as low.
///
/// A cast would check its range lane by lane. Here the number is bounded first and then added to 2²³, where the spacing
/// of single precision is 1: the low bits of the sum are the number, rounded. At a whole number either neighbour may
/// come out, with all that is left or none; the result never falls where `at` rises. Bounds are at most 2²².
#[inline(always)]
pub(crate) fn whole_below(at: f32, low: u32, high: u32) -> (u32, f32) {
    const ONES: f32 = 8_388_608.0;
    let (low, high) = (low as f32, high as f32);
    let middle = at - 0.5;
    let middle = if middle > low { middle } else { low };
    let middle = if middle < high { middle } else { high };
    let sum = middle + ONES;
    (sum.to_bits() - ONES.to_bits(), at - (sum - ONES))
}
