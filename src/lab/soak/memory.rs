//! Whether the memory of a soak grows.
//!
//! Once the first hour has filled pools and buffers, nothing needs more but buffers that hold something of each particle:
//! those of cells have the box's size or that of its wet part, over which the player has poured by then. A buffer that
//! overflows doubles. As long as the count does not, none does so twice; one that was empty, as the sleepers' where none slept,
//! fills once. So all of them together grow by no more than they hold then. A resumed soak is another process, whose first hour fills it anew.

use super::{creep::Creep, period::Totals, sitting::Sitting};
use crate::lab::stats::{largest, mean};

/// What the buffers of a world hold of each particle, bytes: the most from 10,000 particles on in docs/performance.md.
const BYTES_A_PARTICLE: f64 = 150.0;

/// Steps in which an allocator takes memory for a thread's small blocks, bytes (glibc's `M_TOP_PAD` and `M_MMAP_THRESHOLD`): a
/// step for each thread, and one for blocks of all.
const STEP: f64 = 131_072.0;

/// The growth in one sitting, whose periods these are; `None` if there is none after its first hour, or if this system does
/// not tell.
pub(super) fn judge(periods: &[Totals], sitting: &Sitting) -> Option<Creep> {
    let first = periods.first()?.until.max(sitting.from + 60);
    let (filling, later) = periods.split_at(periods.partition_point(|totals| totals.until <= first));
    let of = |totals: &[Totals]| totals.iter().filter_map(|totals| totals.resident).collect::<Vec<_>>();
    let (before, after) = (largest(of(filling))?, largest(of(later))?);
    let most = largest(periods.iter().map(|totals| totals.particles_peak))?;
    let allowed = BYTES_A_PARTICLE * most + STEP * (sitting.threads + 1) as f64;
    let change = after - before;
    let faults = if change > allowed {
        let [before, after, allowed] = [before, after, allowed].map(|bytes| bytes / 1e6);
        vec![format!("memory: {before:.2} MB became {after:.2} MB; buffers may grow by {allowed:.2} MB")]
    } else {
        Vec::new()
    };
    Some(Creep { measure: "memory, bytes", mean: mean(of(later))?, change, allowed, faults })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grown(megabytes: [f64; 4], particles: f64) -> Option<bool> {
        let hour = |(k, megabytes): (usize, f64)| Totals {
            until: 60 * (k as u64 + 1),
            particles_peak: particles,
            resident: Some(1e6 * megabytes),
            ..Totals::default()
        };
        let periods: Vec<Totals> = megabytes.into_iter().enumerate().map(hour).collect();
        let sitting = Sitting { threads: 2, ..Sitting::default() };
        judge(&periods, &sitting).map(|creep| !creep.faults.is_empty())
    }

    #[test]
    fn buffers_may_double_and_nothing_more() {
        assert_eq!(grown([30.0, 30.0, 31.5, 31.8], 10_000.0), Some(false));
        assert_eq!(grown([30.0, 30.0, 31.5, 32.0], 10_000.0), Some(true));
        assert_eq!(grown([30.0, 30.0, 31.5, 31.9], 1_000.0), Some(true), "fewer particles have smaller buffers");
        assert_eq!(grown([32.0, 30.0, 30.0, 30.0], 10_000.0), Some(false));
    }

    #[test]
    fn the_first_hour_alone_tells_nothing() {
        let one = Totals { until: 60, resident: Some(1.0), ..Totals::default() };
        assert_eq!(judge(&[one], &Sitting::default()), None);
        assert_eq!(judge(&[], &Sitting::default()), None);
        let unknown = [1, 2, 3].map(|hour| Totals { until: 60 * hour, ..Totals::default() });
        assert_eq!(judge(&unknown, &Sitting::default()), None, "a system that does not tell");
    }
}
