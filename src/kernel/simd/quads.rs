//! Lanes for the browser: four numbers to a 128-bit register of WebAssembly. Left to plain arrays the compiler puts too
//! few of the operations into registers: a pass takes two to three times as long.

use super::lanes::{ENDS, Lanes, MOST_LANES, operator, too_short};
use core::arch::wasm32::{
    f32x4_add, f32x4_div, f32x4_lt, f32x4_mul, f32x4_pmax, f32x4_pmin, f32x4_splat, f32x4_sqrt, f32x4_sub, i32x4_add,
    i32x4_splat, i32x4_trunc_sat_f32x4, v128, v128_bitselect, v128_load, v128_store,
};
use std::ops::{Add, Div, Mul, Sub};

/// Eight lanes in two registers.
#[derive(Clone, Copy)]
pub(crate) struct Quads([v128; 2]);

impl Quads {
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(v128, v128) -> v128) -> Self {
        Self([operation(self.0[0], other.0[0]), operation(self.0[1], other.0[1])])
    }

    #[inline(always)]
    fn from_array(lanes: &[f32; 8]) -> Self {
        let at: *const v128 = lanes.as_ptr().cast();
        // SAFETY: eight numbers are two registers, and WebAssembly loads from any address.
        unsafe { Self([v128_load(at), v128_load(at.add(1))]) }
    }

    #[inline(always)]
    fn write(self, lanes: &mut [f32; 8]) {
        let at: *mut v128 = lanes.as_mut_ptr().cast();
        // SAFETY: eight numbers are two registers, and WebAssembly stores to any address.
        unsafe {
            v128_store(at, self.0[0]);
            v128_store(at.add(1), self.0[1]);
        }
    }
}

operator!(Add add [] Quads, |a, b| f32x4_add(a, b));
operator!(Sub sub [] Quads, |a, b| f32x4_sub(a, b));
operator!(Mul mul [] Quads, |a, b| f32x4_mul(a, b));
operator!(Div div [] Quads, |a, b| f32x4_div(a, b));

impl Lanes for Quads {
    const WIDTH: usize = 8;
    type Sums = [v128; 2];

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([f32x4_splat(value); 2])
    }

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        if let Some(full) = from.first_chunk() {
            return Self::from_array(full);
        }
        let mut lanes = [0.0; 8];
        lanes[..from.len()].copy_from_slice(from);
        Self::from_array(&lanes)
    }

    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        if let Some(full) = to.first_chunk_mut() {
            self.write(full);
        } else {
            let mut lanes = [0.0; 8];
            self.write(&mut lanes);
            let len = to.len();
            to.copy_from_slice(&lanes[..len]);
        }
    }

    #[inline(always)]
    fn of(row: &[f32], first: usize) -> Self {
        match row[first..].first_chunk() {
            Some(full) => Self::from_array(full),
            None => too_short(),
        }
    }

    #[inline(always)]
    fn put(self, row: &mut [f32], first: usize) {
        match row[first..].first_chunk_mut() {
            Some(full) => self.write(full),
            None => too_short(),
        }
    }

    #[inline(always)]
    fn if_less(self, other: Self, yes: Self, no: Self) -> Self {
        let pick = |k: usize| v128_bitselect(yes.0[k], no.0[k], f32x4_lt(self.0[k], other.0[k]));
        Self([pick(0), pick(1)])
    }

    // `pmax(a, b)` is `if a < b { b } else { a }`, so the operands change places.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| f32x4_pmax(b, a))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| f32x4_pmin(b, a))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(|quad| f32x4_sqrt(quad)))
    }

    #[inline(always)]
    fn no_sums() -> Self::Sums {
        [i32x4_splat(0); 2]
    }

    #[inline(always)]
    fn add_rounded(self, sums: Self::Sums) -> Self::Sums {
        let (zero, half) = (Self::splat(0.0), Self::splat(0.5));
        let away = self + self.if_less(zero, zero - half, half);
        // What is not a number becomes the lowest.
        let away = away.max(Self::splat(ENDS[0])).min(Self::splat(ENDS[1]));
        let add = |k: usize| i32x4_add(sums[k], i32x4_trunc_sat_f32x4(away.0[k]));
        [add(0), add(1)]
    }

    #[inline(always)]
    fn sums(sums: Self::Sums) -> [i32; MOST_LANES] {
        let mut all = [0; MOST_LANES];
        let at: *mut v128 = all.as_mut_ptr().cast();
        for (k, quad) in sums.into_iter().enumerate() {
            // SAFETY: the sums fill two of four registers, and WebAssembly stores to any address.
            unsafe { v128_store(at.add(k), quad) };
        }
        all
    }
}
