//! State-variable filters of two poles, which stay stable however their frequencies move (Zavalishin 2012, "The art of VA filter
//! design", ch. 4; in the form of Simper 2013, "Linear trapezoidal integrated state variable filter").

use crate::{
    block::{Block, LEN},
    math::tangent,
    smooth::Ramp,
};

/// Two filters of both sides: as many as a register of four lanes has room for.
const LANES: usize = 4;

/// The part of a sound that is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// What is below the frequency.
    Low,
    /// What is around it; there it passes as loud as it came.
    Band,
}

/// A filter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// What it lets through.
    pub(crate) part: Part,
    /// Quality Q: raising it makes a band narrower, and a low part ring.
    pub(crate) q: f32,
    /// Effective value of white noise behind it; that of [`Chance::fill`](crate::noise::Chance::fill), which has the same power
    /// in a band at every sample rate.
    pub(crate) level: f32,
}

/// Two filters side by side, of which the sum is heard.
#[derive(Clone, Debug)]
pub(crate) struct Filters {
    shapes: [Shape; 2],
    rate: f32,
    frequencies: [f32; 2],
    /// The integrators: left and right of the first, left and right of the second.
    states: [[f32; LANES]; 2],
    /// What follows from the frequencies: Simper's a₁ … a₃, and his m₁ and m₂.
    a: [[f32; LANES]; 3],
    m: [[f32; LANES]; 2],
}

impl Filters {
    /// Frequencies beyond this share of the sample rate are cut to it.
    const HIGHEST: f32 = 0.4;

    pub(crate) fn new(shapes: [Shape; 2], rate: f32) -> Self {
        let none = [0.0; LANES];
        Self { shapes, rate, frequencies: [0.0; 2], states: [none; 2], a: [none; 3], m: [none; 2] }
    }

    /// Sets the frequencies, Hz.
    pub(crate) fn tune(&mut self, frequencies: [f32; 2]) {
        for k in 0..2 {
            if self.frequencies[k] != frequencies[k] {
                self.frequencies[k] = frequencies[k];
                self.set(k);
            }
        }
    }

    fn set(&mut self, k: usize) {
        let (Shape { part, q, level }, frequency) = (self.shapes[k], self.frequencies[k]);
        let g = tangent(0.5 * (frequency / self.rate).min(Self::HIGHEST));
        let damping = 1.0 / q;
        let a1 = 1.0 / (1.0 + g * (g + damping));
        let scale = level * evens(part, q, frequency);
        let mix = match part {
            Part::Low => [0.0, scale],
            Part::Band => [damping * scale, 0.0],
        };
        for lane in [2 * k, 2 * k + 1] {
            for (values, value) in self.a.iter_mut().zip([a1, g * a1, g * g * a1]) {
                values[lane] = value;
            }
            for (values, value) in self.m.iter_mut().zip(mix) {
                values[lane] = value;
            }
        }
    }

    /// Adds what is left of `sound`, as loud as `gains` say.
    pub(crate) fn render(&mut self, sound: &Block, gains: &[Ramp; 2], out: &mut Block) {
        let ([a1, a2, a3], [m1, m2]) = (self.a, self.m);
        let [mut s1, mut s2] = self.states;
        let mut frames = [[0.0; LANES]; LEN];
        for (frame, [left, right]) in frames.iter_mut().zip(sound) {
            let x = [*left, *right, *left, *right];
            for i in 0..LANES {
                let v3 = x[i] - s2[i];
                let v1 = a1[i] * s1[i] + a2[i] * v3;
                let v2 = s2[i] + a2[i] * s1[i] + a3[i] * v3;
                s1[i] = 2.0 * v1 - s1[i];
                s2[i] = 2.0 * v2 - s2[i];
                frame[i] = m1[i] * v1 + m2[i] * v2;
            }
        }
        self.states = [s1, s2];
        for (k, (out, frame)) in out.iter_mut().zip(frames).enumerate() {
            out[0] += gains[0].at(k) * (frame[0] + frame[2]);
            out[1] += gains[1].at(k) * (frame[1] + frame[3]);
        }
    }
}

/// By what white noise must be multiplied to have an effective value of 1 behind a filter.
fn evens(part: Part, q: f32, frequency: f32) -> f32 {
    // Equivalent widths of the noise: π/2 f/Q of a band, π/2 f Q of a low part (Zavalishin, ibid.).
    let width = match part {
        Part::Low => std::f32::consts::FRAC_PI_2 * frequency * q,
        Part::Band => std::f32::consts::FRAC_PI_2 * frequency / q,
    };
    // Numbers between −1 and 1 have a third of the power that ±1 has.
    (3.0 * 24_000.0 / width.clamp(1.0, 24_000.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{block::SILENCE, math::sine};

    const AS_IT_IS: [Ramp; 2] = [Ramp { from: 1.0, step: 0.0 }; 2];

    fn one(part: Part, q: f32, rate: f32) -> Filters {
        Filters::new([Shape { part, q, level: 1.0 }, Shape { part, q, level: 0.0 }], rate)
    }

    /// Loudness behind the filter of a sound of one frequency.
    fn response(part: Part, q: f32, frequency: f32, sound: f32) -> f32 {
        let mut filters = one(part, q, 48_000.0);
        filters.tune([frequency; 2]);
        let mut peak = 0.0_f32;
        for start in (0..48_000).step_by(LEN) {
            let (mut block, mut out) = (SILENCE, SILENCE);
            for (k, frame) in block.iter_mut().enumerate() {
                *frame = [sine(((start + k) as f32 * sound / 48_000.0).fract()); 2];
            }
            filters.render(&block, &AS_IT_IS, &mut out);
            for [left, right] in out {
                assert_eq!(left, right);
                if start > 24_000 {
                    peak = peak.max(left.abs());
                }
            }
        }
        peak / evens(part, q, frequency)
    }

    #[test]
    fn each_part_passes_what_it_is_called() {
        for frequency in [60.0, 700.0, 9000.0] {
            assert!((response(Part::Band, 3.0, frequency, frequency) - 1.0).abs() < 0.01);
            assert!(response(Part::Band, 3.0, frequency, frequency / 4.0) < 0.15);
            assert!(response(Part::Low, 0.7, frequency, frequency / 8.0) > 0.95);
            assert!(response(Part::Low, 0.7, frequency, frequency * 2.2) < 0.25);
        }
    }

    #[test]
    fn they_bear_any_frequency() {
        let mut filters = one(Part::Band, 20.0, 8000.0);
        let mut wild = SILENCE;
        for (k, frame) in wild.iter_mut().enumerate() {
            *frame = [if k % 2 == 0 { 1.0 } else { -1.0 }; 2];
        }
        for k in 0..2000 {
            filters.tune([if k % 3 == 0 { 1e9 } else { 0.1 }; 2]);
            let mut out = SILENCE;
            filters.render(&wild, &AS_IT_IS, &mut out);
            assert!(out.iter().flatten().all(|sample| sample.abs() < 1e5), "after {k}");
        }
    }
}
