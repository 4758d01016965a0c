//! Lanes for x86-64, register by register. Left to plain arrays the compiler cuts long passes into pieces of registers: some take
//! two to three times as long.
//!
//! What needs AVX2 or AVX-512 is only used by passes that a function with that feature runs ([`super::set`]), into which all of
//! this is inlined.

use super::lanes::{ENDS, Lanes, MOST_LANES, too_short};
use core::arch::x86_64::{
    __m128, __m128i, __m256, __m256i, __m512, __m512i, _CMP_LT_OQ, _mm_add_epi32, _mm_add_ps, _mm_and_ps,
    _mm_andnot_ps, _mm_cmplt_ps, _mm_cvttps_epi32, _mm_div_ps, _mm_loadu_ps, _mm_loadu_si128, _mm_max_ps, _mm_min_ps,
    _mm_mul_ps, _mm_or_ps, _mm_set1_ps, _mm_sqrt_ps, _mm_storeu_ps, _mm_storeu_si128, _mm_sub_ps, _mm256_add_epi32,
    _mm256_add_ps, _mm256_blendv_ps, _mm256_cmp_ps, _mm256_cvttps_epi32, _mm256_div_ps, _mm256_loadu_ps,
    _mm256_loadu_si256, _mm256_max_ps, _mm256_min_ps, _mm256_mul_ps, _mm256_set1_ps, _mm256_sqrt_ps, _mm256_storeu_ps,
    _mm256_storeu_si256, _mm256_sub_ps, _mm512_add_epi32, _mm512_add_ps, _mm512_cmp_ps_mask, _mm512_cvttps_epi32,
    _mm512_div_ps, _mm512_loadu_ps, _mm512_loadu_si512, _mm512_mask_blend_ps, _mm512_max_ps, _mm512_min_ps,
    _mm512_mul_ps, _mm512_set1_ps, _mm512_sqrt_ps, _mm512_storeu_ps, _mm512_storeu_si512, _mm512_sub_ps,
};
use std::ops::{Add, Div, Mul, Sub};

/// Lanes in some registers, by the intrinsics for each. `$k`: which registers.
macro_rules! registers {
    (
        $(#[$doc:meta])* $Lanes:ident: [$($k:literal),+] of $Register:ty [$per:literal] and $Whole:ty;
        $splat:ident $load:ident $store:ident $add:ident $sub:ident $mul:ident $div:ident $max:ident $min:ident $sqrt:ident,
        whole: $truncate:ident $load_whole:ident $store_whole:ident $add_whole:ident,
        if_less: |$a:ident, $b:ident, $yes:ident, $no:ident| $if_less:expr
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub(crate) struct $Lanes([$Register; [$($k),+].len()]);

        impl $Lanes {
            #[inline(always)]
            fn from_array(lanes: &[f32; Self::WIDTH]) -> Self {
                let at = lanes.as_ptr();
                // SAFETY: the numbers fill the registers, and these load from any address.
                unsafe { Self([$($load(at.add($k * $per))),+]) }
            }

            #[inline(always)]
            fn write(self, lanes: &mut [f32; Self::WIDTH]) {
                let at = lanes.as_mut_ptr();
                // SAFETY: the numbers fill the registers, and these store to any address.
                unsafe { $($store(at.add($k * $per), self.0[$k]));+ }
            }
        }

        registers!(@ $Lanes [$($k),+] Add add $add);
        registers!(@ $Lanes [$($k),+] Sub sub $sub);
        registers!(@ $Lanes [$($k),+] Mul mul $mul);
        registers!(@ $Lanes [$($k),+] Div div $div);

        impl Lanes for $Lanes {
            const WIDTH: usize = [$($k),+].len() * $per;
            type Sums = [$Whole; [$($k),+].len()];

            #[inline(always)]
            fn splat(value: f32) -> Self {
                // SAFETY: the passes that use these lanes run where the processor has the registers.
                unsafe { Self([$splat(value); [$($k),+].len()]) }
            }

            #[inline(always)]
            fn load(from: &[f32]) -> Self {
                if let Some(full) = from.first_chunk() {
                    return Self::from_array(full);
                }
                let mut lanes = [0.0; Self::WIDTH];
                lanes[..from.len()].copy_from_slice(from);
                Self::from_array(&lanes)
            }

            #[inline(always)]
            fn store(self, to: &mut [f32]) {
                if let Some(full) = to.first_chunk_mut() {
                    self.write(full);
                } else {
                    let mut lanes = [0.0; Self::WIDTH];
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

            // Both give the second of two that are alike or of which one is not a number, as the comparison of the trait does.
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // SAFETY: as in `splat`.
                unsafe { Self([$($max(self.0[$k], other.0[$k])),+]) }
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // SAFETY: as in `splat`.
                unsafe { Self([$($min(self.0[$k], other.0[$k])),+]) }
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: as in `splat`.
                unsafe { Self([$($sqrt(self.0[$k])),+]) }
            }

            #[inline(always)]
            fn if_less(self, other: Self, yes: Self, no: Self) -> Self {
                // SAFETY: as in `splat`.
                unsafe {
                    Self([$({
                        let ($a, $b, $yes, $no) = (self.0[$k], other.0[$k], yes.0[$k], no.0[$k]);
                        $if_less
                    }),+])
                }
            }

            #[inline(always)]
            fn no_sums() -> Self::Sums {
                let zeros = [0_i32; Self::WIDTH];
                let at: *const $Whole = zeros.as_ptr().cast();
                // SAFETY: as in `from_array`.
                unsafe { [$($load_whole(at.add($k))),+] }
            }

            #[inline(always)]
            fn add_rounded(self, sums: Self::Sums) -> Self::Sums {
                let (zero, half) = (Self::splat(0.0), Self::splat(0.5));
                let away = self + self.if_less(zero, zero - half, half);
                // What is not a number becomes the lowest.
                let away = away.max(Self::splat(ENDS[0])).min(Self::splat(ENDS[1]));
                // SAFETY: as in `splat`.
                unsafe { [$($add_whole(sums[$k], $truncate(away.0[$k]))),+] }
            }

            #[inline(always)]
            fn sums(sums: Self::Sums) -> [i32; MOST_LANES] {
                let mut all = [0; MOST_LANES];
                let at: *mut $Whole = all.as_mut_ptr().cast();
                // SAFETY: there is room for as many registers and more, and these store to any address.
                unsafe { $($store_whole(at.add($k), sums[$k]));+ }
                all
            }
        }
    };
    (@ $Lanes:ident [$($k:literal),+] $Operator:ident $name:ident $intrinsic:ident) => {
        impl $Operator for $Lanes {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: as in `splat`.
                unsafe { Self([$($intrinsic(self.0[$k], other.0[$k])),+]) }
            }
        }
    };
}

registers! {
    /// Sixteen lanes of AVX-512.
    Zmm: [0] of __m512 [16] and __m512i;
    _mm512_set1_ps _mm512_loadu_ps _mm512_storeu_ps _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps _mm512_max_ps
    _mm512_min_ps _mm512_sqrt_ps,
    whole: _mm512_cvttps_epi32 _mm512_loadu_si512 _mm512_storeu_si512 _mm512_add_epi32,
    if_less: |a, b, yes, no| _mm512_mask_blend_ps(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b), no, yes)
}

registers! {
    /// Eight lanes of AVX2.
    Ymm: [0] of __m256 [8] and __m256i;
    _mm256_set1_ps _mm256_loadu_ps _mm256_storeu_ps _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps _mm256_max_ps
    _mm256_min_ps _mm256_sqrt_ps,
    whole: _mm256_cvttps_epi32 _mm256_loadu_si256 _mm256_storeu_si256 _mm256_add_epi32,
    if_less: |a, b, yes, no| _mm256_blendv_ps(no, yes, _mm256_cmp_ps::<_CMP_LT_OQ>(a, b))
}

registers! {
    /// Eight lanes of SSE2, in two registers.
    Xmms: [0, 1] of __m128 [4] and __m128i;
    _mm_set1_ps _mm_loadu_ps _mm_storeu_ps _mm_add_ps _mm_sub_ps _mm_mul_ps _mm_div_ps _mm_max_ps _mm_min_ps _mm_sqrt_ps,
    whole: _mm_cvttps_epi32 _mm_loadu_si128 _mm_storeu_si128 _mm_add_epi32,
    if_less: |a, b, yes, no| {
        let less = _mm_cmplt_ps(a, b);
        _mm_or_ps(_mm_and_ps(less, yes), _mm_andnot_ps(less, no))
    }
}
