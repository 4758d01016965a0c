//! How hard a wall holds viscous liquid, by how much of a particle's kernel reaches into it.
//!
//! Liquid that has a viscosity does not slip: at the wall it is as fast as the wall, which stands. XSPH's sum goes on behind it
//! over liquid that runs the other way, as the straight line through both would have it (Takeda, Miyama & Sekiya 1994; Morris,
//! Fox & Zhu 1997, §3.4): at a depth y′ behind a wall, `−v y′/y` for a particle y before it. With the difference to v that is
//!
//! `−v ∫ W (1 + y′/y) = −v (R(y) + 1/y ∫ R(y″) dy″)`, y″ from y to h,
//!
//! with the kernel's reach R(y) into a half plane at a distance y: an even shear is not braked at all, whatever its distance.
//! Around corners of rock there is no y, but always a reach; so the sum is tabulated by that.

use crate::{params::WALL_GAP, smoothing::Smoothing};

/// Entries of the table.
const ENTRIES: usize = 48;

/// Weight of a wall in a particle's mean of velocities, by the kernel's reach into it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grip {
    /// Reach and weight, both from 0 on rising: those of a particle ever nearer to a wall.
    entries: [[f32; 2]; ENTRIES + 1],
}

impl Grip {
    /// The table of a kernel.
    pub fn new(smoothing: &Smoothing) -> Self {
        let step = (smoothing.radius - WALL_GAP) / ENTRIES as f32;
        let (mut entries, mut integral) = ([[0.0; 2]; ENTRIES + 1], 0.0);
        for k in 1..=ENTRIES {
            let distance = smoothing.radius - step * k as f32;
            let reach = smoothing.wall(distance).0;
            integral += 0.5 * step * (entries[k - 1][0] + reach);
            entries[k] = [reach, reach + integral / distance];
        }
        Self { entries }
    }

    /// The weight at a reach; beyond that of a particle as near to a plane wall as it can be, as in corners, in proportion.
    #[inline(always)]
    pub fn at(&self, reach: f32) -> f32 {
        let entries = &self.entries;
        let next = entries.partition_point(|[entry, _]| *entry < reach);
        let Some([far, far_weight]) = entries.get(next) else {
            let [last, weight] = entries[ENTRIES];
            return weight * reach / last;
        };
        let [near, near_weight] = entries[next.saturating_sub(1)];
        if far > &near { near_weight + (far_weight - near_weight) * (reach - near) / (far - near) } else { *far_weight }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::GradientKernel;

    #[test]
    fn an_even_shear_is_not_braked_by_the_wall_that_it_stands_on() {
        let smoothing = Smoothing::new(2.5, GradientKernel::Rational);
        let grip = Grip::new(&smoothing);
        let h = 2.5_f32;
        for distance in [0.3, 0.5, 1.0, 1.5, 2.2] {
            // Its liquid before the wall, v = y: the differences that pull it on, in strips along the wall.
            let strips = 4000;
            let width = (h + distance) / strips as f32;
            let pull: f32 = (0..strips)
                .map(|k| {
                    let y = (k as f32 + 0.5) * width;
                    // What lies in a strip is by how much less the reach is behind it.
                    let beyond = |at: f32| match at {
                        at if at >= 0.0 => smoothing.wall(at).0,
                        at => 1.0 - smoothing.wall(-at).0,
                    };
                    let off = y - distance;
                    (beyond(off - 0.5 * width) - beyond(off + 0.5 * width)) * off
                })
                .sum();
            let hold = grip.at(smoothing.wall(distance).0) * distance;
            assert!((pull - hold).abs() < 0.01, "{distance} d before it: pulled on by {pull}, held by {hold}");
        }
    }

    #[test]
    fn a_wall_holds_the_harder_the_further_a_kernel_reaches_into_it() {
        let grip = Grip::new(&Smoothing::new(2.5, GradientKernel::Rational));
        let weights: Vec<f32> = (0..=100).map(|k| grip.at(0.01 * k as f32)).collect();
        assert!(weights[0] == 0.0 && weights.is_sorted() && weights[100].is_finite(), "{weights:?}");
        assert!(weights[28] > 0.4, "half a spacing before a wall more than its share: {}", weights[28]);
    }
}
