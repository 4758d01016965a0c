//! Lanes: one source for every width of vector registers, and the choice of the width at run time.
//!
//! A pass over particles is written once, generic over [`Lanes`]. Lanes are plain arrays; inside a function with
//! `#[target_feature]` the compiler turns them into vector registers. Every operation is the IEEE one on each lane (no
//! fused multiply-add, no estimates), so every width gives the same bits.

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod quads;

use std::ops::{Add, Div, Mul, Sub};

/// Lanes of [`InstructionSet::Baseline`].
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
type BaselineLanes = quads::Quads;
#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
type BaselineLanes = Array<8>;

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

impl<const N: usize> Add for Array<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for Array<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Array<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Div for Array<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl<const N: usize> Lanes for Array<N> {
    const WIDTH: usize = N;

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
}

#[cold]
#[inline(never)]
fn too_short() -> ! {
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

/// Work that is generic over the lane width.
pub(crate) trait Pass {
    /// Does the work. Implementations are `#[inline(always)]`, so that they are compiled for the caller's registers.
    fn run<L: Lanes>(self);
}

/// Name of what every processor of the target has.
const BASELINE: &str = if cfg!(target_arch = "x86_64") {
    "sse2"
} else if cfg!(target_arch = "aarch64") {
    "neon"
} else if cfg!(all(target_arch = "wasm32", target_feature = "simd128")) {
    "simd128"
} else {
    "baseline"
};

/// Instruction set that the passes are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// 16 lanes. Nobody else can name it, as it may only be had where the processor has it.
    #[cfg(target_arch = "x86_64")]
    #[non_exhaustive]
    Avx512,
    /// 8 lanes; the same.
    #[cfg(target_arch = "x86_64")]
    #[non_exhaustive]
    Avx2,
    /// What every processor of the target has; 8 lanes in registers of its own width.
    Baseline,
    /// One lane: the slow reference.
    Scalar,
}

impl InstructionSet {
    /// The widest that this processor has.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") {
                return Self::Avx512;
            }
            if is_x86_feature_detected!("avx2") {
                return Self::Avx2;
            }
        }
        Self::Baseline
    }

    /// All sets that this processor has, widest first.
    pub fn available() -> Vec<Self> {
        let mut sets = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") {
                sets.push(Self::Avx512);
            }
            if is_x86_feature_detected!("avx2") {
                sets.push(Self::Avx2);
            }
        }
        sets.extend([Self::Baseline, Self::Scalar]);
        sets
    }

    /// Its name, as the command line takes it and the metrics give it.
    pub fn name(self) -> &'static str {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => "avx512",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => "avx2",
            Self::Baseline => BASELINE,
            Self::Scalar => "scalar",
        }
    }

    /// Particles that a pass works on side by side.
    pub(crate) fn width(self) -> usize {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => 16,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => 8,
            Self::Baseline => BaselineLanes::WIDTH,
            Self::Scalar => 1,
        }
    }

    /// Runs `pass` on the lanes of this set. The processor must have it: sets come from [`Self::detect`] and
    /// [`Self::available`].
    #[inline]
    pub(crate) fn run(self, pass: impl Pass) {
        match self {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `Avx512` is only made where the processor reports AVX-512F.
            Self::Avx512 => unsafe { run_avx512(pass) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `Avx2` is only made where the processor reports AVX2.
            Self::Avx2 => unsafe { run_avx2(pass) },
            Self::Baseline => pass.run::<BaselineLanes>(),
            Self::Scalar => pass.run::<Array<1>>(),
        }
    }

    /// [`Self::run`] for a pass that needs so many registers at a time that it has no use for two to a number: on lanes
    /// that fill one register of this set.
    #[inline]
    pub(crate) fn run_by_register(self, pass: impl Pass) {
        match self {
            Self::Baseline => pass.run::<Array<4>>(),
            _ => self.run(pass),
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
fn run_avx512(pass: impl Pass) {
    pass.run::<Array<16>>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_avx2(pass: impl Pass) {
    pass.run::<Array<8>>();
}
