//! A pool of threads that work off a list.

use rayon::{
    ThreadPoolBuilder,
    iter::{ParallelBridge, ParallelIterator},
};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs all jobs, `threads` at a time, and gives what came of them in their order. The most expensive by `cost` are begun
/// first, so that nothing long is left for the end. `report` is called with how many are done, and with the one that begins.
pub fn run<J: Sync, R: Send>(
    jobs: &[J],
    threads: usize,
    cost: impl Fn(&J) -> u64,
    report: impl Fn(usize, &J) + Sync,
    run: impl Fn(&J) -> R + Sync,
) -> Vec<R> {
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(cost(&jobs[k])));
    let done = AtomicUsize::new(0);
    let one = |k: usize| {
        report(done.load(Ordering::Relaxed), &jobs[k]);
        let result = run(&jobs[k]);
        done.fetch_add(1, Ordering::Relaxed);
        (k, result)
    };
    // Where there are no threads, the one that there is does it all.
    let mut results: Vec<(usize, R)> = match ThreadPoolBuilder::new().num_threads(threads.min(jobs.len())).build() {
        Ok(pool) if threads > 1 => pool.install(|| order.into_iter().par_bridge().map(one).collect()),
        _ => order.into_iter().map(one).collect(),
    };
    results.sort_unstable_by_key(|(k, _)| *k);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn results_come_in_the_order_of_the_jobs_whatever_was_begun_first() {
        let jobs: Vec<u64> = (0..40).collect();
        let begun = Mutex::new(Vec::new());
        let squares = run(&jobs, 1, |&job| job % 7, |_, &job| begun.lock().unwrap().push(job), |&job| job * job);
        assert_eq!(squares, jobs.iter().map(|job| job * job).collect::<Vec<_>>());
        assert_eq!(begun.lock().unwrap()[0], 6, "the most expensive goes first");
        assert_eq!(squares, run(&jobs, 5, |&job| job % 7, |_, _| {}, |&job| job * job));
        assert!(run(&[0_u8; 0], 3, |_| 0, |_, _| {}, |_| ()).is_empty());
    }
}
