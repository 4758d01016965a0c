//! The instruction set, chosen at run time.

use super::lanes::{Array, Lanes};
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
use super::quads;
#[cfg(target_arch = "x86_64")]
use super::registers::{Xmms, Ymm, Zmm};

/// Lanes of [`InstructionSet::Baseline`].
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
type BaselineLanes = quads::Quads;
#[cfg(target_arch = "x86_64")]
type BaselineLanes = Xmms;
#[cfg(not(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128"))))]
type BaselineLanes = Array<8>;

/// Lanes that fill one of its registers.
const REGISTER: usize = 4;

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
    /// 16 lanes. Other modules can not make it: it exists only where the processor has it.
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
        Self::available()[0]
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

    /// The widest set of those that this one includes whose registers `entries` fill.
    pub(crate) fn filled_by(self, entries: usize) -> Self {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 if entries < 16 && is_x86_feature_detected!("avx2") => Self::Avx2.filled_by(entries),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 | Self::Avx2 if entries < self.width() => Self::Baseline.filled_by(entries),
            Self::Baseline if entries < REGISTER => Self::Scalar,
            _ => self,
        }
    }

    /// [`Self::run`] for a pass that needs so many registers at a time that it has no use for two to a number: on lanes
    /// that fill one register of this set.
    #[inline]
    pub(crate) fn run_by_register(self, pass: impl Pass) {
        match self {
            Self::Baseline => pass.run::<Array<REGISTER>>(),
            _ => self.run(pass),
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
fn run_avx512(pass: impl Pass) {
    pass.run::<Zmm>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_avx2(pass: impl Pass) {
    pass.run::<Ymm>();
}
