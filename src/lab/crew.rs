//! Jobs side by side.

use std::{
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

/// Does all jobs, `side_by_side` at a time, and gives what came of them in their order. The dearest by `dearness` are
/// begun first, so that nothing long is left for the end. `says` hears how many are done of how many, and which one is
/// begun.
pub fn work<J: Sync, R: Send>(
    jobs: &[J],
    side_by_side: usize,
    dearness: impl Fn(&J) -> u64,
    says: impl Fn(usize, usize, &J) + Sync,
    doing: impl Fn(&J) -> R + Sync,
) -> Vec<R> {
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(dearness(&jobs[k])));
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let results = Mutex::new(Vec::with_capacity(jobs.len()));
    let work = || {
        while let Some(&k) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
            says(done.load(Ordering::Relaxed), jobs.len(), &jobs[k]);
            let result = doing(&jobs[k]);
            results.lock().unwrap_or_else(PoisonError::into_inner).push((k, result));
            done.fetch_add(1, Ordering::Relaxed);
        }
    };
    thread::scope(|scope| {
        for _ in 1..side_by_side.min(jobs.len()) {
            // Where there are no more threads, those that there are do it all.
            if thread::Builder::new().spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_unstable_by_key(|(k, _)| *k);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_the_order_of_the_jobs_whatever_was_begun_first() {
        let jobs: Vec<u64> = (0..40).collect();
        let begun = Mutex::new(Vec::new());
        let squares =
            work(&jobs, 1, |&job| job % 7, |_, of, &job| begun.lock().unwrap().push((of, job)), |&job| job * job);
        assert_eq!(squares, jobs.iter().map(|job| job * job).collect::<Vec<_>>());
        assert_eq!(begun.lock().unwrap()[0], (40, 6), "the dearest goes first");
        assert_eq!(squares, work(&jobs, 5, |&job| job % 7, |_, _, _| {}, |&job| job * job));
        assert!(work(&[0_u8; 0], 3, |_| 0, |_, _, _| {}, |_| ()).is_empty());
    }
}
