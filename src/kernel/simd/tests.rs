//! Every instruction set against numbers one by one.

use super::{InstructionSet, Lanes, MOST_LANES, Pass};

/// All that lanes can do with two numbers.
struct All<'a> {
    a: &'a [f32],
    b: &'a [f32],
    /// Out: what comes of each pair, bit by bit; what is not a number is one and the same.
    out: &'a mut [[u32; 10]],
}

impl Pass for All<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let bits = |value: f32| if value.is_nan() { u32::MAX } else { value.to_bits() };
        for first in (0..self.a.len()).step_by(L::WIDTH) {
            let (a, b) = (L::load(&self.a[first..]), L::load(&self.b[first..]));
            let results =
                [a + b, a - b, a * b, a / b, a.max(b), a.min(b), a.sqrt(), a.if_less(b, b, L::splat(7.0)), a.abs()];
            let sums = L::sums(b.add_rounded(a.add_rounded(L::no_sums())));
            let out = self.out[first..].iter_mut().take(L::WIDTH);
            for (lane, out) in out.enumerate() {
                for (out, result) in out.iter_mut().zip(results) {
                    let mut lanes = [0.0; MOST_LANES];
                    result.store(&mut lanes[..L::WIDTH]);
                    *out = bits(lanes[lane]);
                }
                out[9] = sums[lane] as u32;
            }
        }
    }
}

#[test]
fn every_instruction_set_does_the_same_with_any_numbers() {
    const NUMBERS: [f32; 19] = [
        0.0,
        -0.0,
        0.5,
        -0.5,
        1.5,
        -2.5,
        1.0e-40,
        -1.0e-45,
        3.0e9,
        -3.0e9,
        2_147_483_520.0,
        -2_147_483_648.0,
        8_388_609.0,
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];
    let pairs = NUMBERS.iter().flat_map(|a| NUMBERS.iter().map(move |b| (*a, *b)));
    let (a, b): (Vec<f32>, Vec<f32>) = pairs.unzip();
    let of = |set: InstructionSet| {
        let mut out = vec![[0; 10]; a.len()];
        set.run(All { a: &a, b: &b, out: &mut out });
        out
    };
    let expected = of(InstructionSet::Scalar);
    for set in InstructionSet::available() {
        for (k, (found, expected)) in of(set).iter().zip(&expected).enumerate() {
            assert_eq!(found, expected, "{} of {} and {}", set.name(), a[k], b[k]);
        }
    }
}

#[test]
fn rows_are_read_and_written_where_they_are() {
    struct Copy<'a>(&'a [f32], &'a mut [f32]);
    impl Pass for Copy<'_> {
        #[inline(always)]
        fn run<L: Lanes>(self) {
            let Self(from, to) = self;
            for first in super::lane_starts::<L>(from.len()) {
                L::of(from, first).put(to, first);
            }
        }
    }
    let from: Vec<f32> = (0..37).map(|k| k as f32).collect();
    for set in InstructionSet::available() {
        let mut to = vec![0.0; 37];
        set.run(Copy(&from, &mut to));
        assert_eq!(from, to, "{}", set.name());
    }
}
