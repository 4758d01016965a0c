//! Hands a job to threads that look out for it: a work crew (Butenhof 1997, "Programming with POSIX Threads", ch. 4). To wake a
//! thread of a pool takes some ten microseconds, and to have one that is awake find a task there some three; most sweeps of a tick
//! are shorter than that. Threads that look at one number, again and again, see a job as soon as that number has come to their
//! caches, and are done with it in 0.3 to 0.5 µs (docs/performance.md).

use std::{
    any::Any,
    cell::RefCell,
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    ptr::null_mut,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicPtr, AtomicUsize, Ordering::SeqCst},
    },
    thread::panicking,
};

/// What each of a crew does of a job, told whether it leads: take parts of it until none is left.
type Job<'a> = &'a (dyn Fn(bool) + Sync);

/// Has the cache line, or two that are fetched together, to itself.
#[derive(Default)]
#[repr(align(128))]
struct OwnLine<T>(T);

/// A thread that hands out jobs, and those that look out for them.
#[derive(Default)]
pub(crate) struct Crew {
    /// Odd while there is a job; never the same for two jobs.
    number: AtomicUsize,
    /// The job, while the number is odd.
    job: AtomicPtr<Job<'static>>,
    /// How many of the others are at the job, or about to see whether there is one.
    inside: OwnLine<AtomicUsize>,
    /// What the first of the others that failed at the job failed with.
    fault: Mutex<Option<Box<dyn Any + Send>>>,
}

thread_local! {
    static OWN: Arc<Crew> = Arc::default();
    /// The crew that this thread leads, while it has no job.
    static LED: RefCell<Option<Arc<Crew>>> = const { RefCell::new(None) };
}

/// Makes a crew the one that this thread leads, or none, when it is dropped: however work ends.
struct Leads(Option<Arc<Crew>>);

impl Drop for Leads {
    fn drop(&mut self) {
        LED.set(self.0.take());
    }
}

/// Looks in vain after which a thread that waits lets others of the system go first: they may be those that it waits for.
const POLITENESS: u32 = 256;

/// Waits a moment, the `nth` in a row.
pub(crate) fn wait_a_moment(nth: u32) {
    std::hint::spin_loop();
    if nth.is_multiple_of(POLITENESS) {
        std::thread::yield_now();
    }
}

impl Crew {
    /// The crew that only this thread may lead.
    pub fn of_this_thread() -> Arc<Self> {
        OWN.with(Arc::clone)
    }

    /// Runs `work` on this thread, whose jobs ([`share`]) the crew then does. It is led by one thread at a time.
    pub fn lead<T>(self: &Arc<Self>, work: impl FnOnce() -> T) -> T {
        let _before = Leads(LED.replace(Some(self.clone())));
        work()
    }

    /// Helps with the job that there is, if it is not the one with the number `last`. Returns the number of that which it helped with.
    pub fn help(&self, last: usize) -> Option<usize> {
        let number = self.number.load(SeqCst);
        if number.is_multiple_of(2) || number == last {
            return None;
        }
        self.inside.0.fetch_add(1, SeqCst);
        // Whoever ends the job changes the number first, and then waits until none is inside: either this sees that, or is waited for.
        let helps = self.number.load(SeqCst) == number;
        if helps {
            // SAFETY: the number is that of a job which is not over, and its owner lets it live until this is no longer inside.
            let job = unsafe { *self.job.load(SeqCst) };
            if let Err(fault) = catch_unwind(AssertUnwindSafe(|| job(false))) {
                self.fault().get_or_insert(fault);
            }
        }
        self.inside.0.fetch_sub(1, SeqCst);
        helps.then_some(number)
    }

    /// Does a job together with those that look out for it, and returns when all are done.
    fn share(&self, job: Job) {
        /// Takes the job back and waits for those who are at it, however it ends.
        struct Open<'a>(&'a Crew);
        impl Drop for Open<'_> {
            fn drop(&mut self) {
                self.0.number.fetch_add(1, SeqCst);
                let mut nth = 0;
                while self.0.inside.0.load(SeqCst) > 0 {
                    nth += 1;
                    wait_a_moment(nth);
                    if cfg!(target_arch = "wasm32") && nth.is_multiple_of(POLITENESS) {
                        // A fault there ends its thread, and this one hears of it as work of the pool.
                        rayon::yield_now();
                    }
                }
                if panicking() {
                    // One fault is enough, and that of another job is none of the next one's.
                    drop(self.0.fault().take());
                }
            }
        }
        self.job.store((&raw const job).cast_mut().cast(), SeqCst);
        self.number.fetch_add(1, SeqCst);
        let open = Open(self);
        job(true);
        drop(open);
        self.job.store(null_mut(), SeqCst);
        let fault = self.fault().take();
        if let Some(fault) = fault {
            resume_unwind(fault);
        }
    }

    fn fault(&self) -> MutexGuard<'_, Option<Box<dyn Any + Send>>> {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether this thread leads a crew that has no job.
pub(crate) fn leads() -> bool {
    LED.with_borrow(Option::is_some)
}

/// Does a job together with the crew that this thread leads; alone, if it leads none.
pub(crate) fn share(job: Job) {
    let Some(crew) = LED.take() else { return job(true) };
    // What the job shares in turn is no job of the crew, which has one.
    let _after = Leads(Some(crew.clone()));
    crew.share(job);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{
        sync::atomic::AtomicBool,
        thread::{scope, sleep},
        time::Duration,
    };

    /// Runs `work` on this thread with a crew of so many others.
    fn with_others<T>(others: usize, work: impl FnOnce() -> T) -> T {
        let (crew, over) = (Arc::new(Crew::default()), AtomicBool::new(false));
        scope(|scope| {
            for _ in 0..others {
                scope.spawn(|| {
                    let mut last = 0;
                    while !over.load(SeqCst) {
                        last = crew.help(last).unwrap_or(last);
                        wait_a_moment(1);
                    }
                });
            }
            let result = catch_unwind(AssertUnwindSafe(|| crew.lead(work)));
            over.store(true, SeqCst);
            result.unwrap_or_else(|fault| resume_unwind(fault))
        })
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no threads")]
    fn every_part_of_every_job_is_taken_once_and_done_when_the_job_is() {
        for others in [0, 1, 3] {
            with_others(others, || {
                for parts in 0..200 {
                    let left: Vec<_> = (0..parts).map(|_| AtomicUsize::new(1)).collect();
                    let done = AtomicUsize::new(0);
                    share(&|_| {
                        for part in &left {
                            if part.swap(0, SeqCst) == 1 {
                                done.fetch_add(1, SeqCst);
                            }
                        }
                    });
                    assert_eq!(done.into_inner(), parts, "with {others} others");
                }
            });
        }
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no threads")]
    fn a_job_is_not_over_while_one_of_the_others_is_at_it() {
        with_others(1, || {
            let (begun, ended) = (AtomicBool::new(false), AtomicBool::new(false));
            share(&|leads| {
                if leads {
                    while !begun.load(SeqCst) {
                        wait_a_moment(1);
                    }
                } else {
                    begun.store(true, SeqCst);
                    sleep(Duration::from_millis(20));
                    ended.store(true, SeqCst);
                }
            });
            assert!(ended.into_inner());
        });
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no threads")]
    fn a_fault_comes_out_where_the_job_was_shared_and_the_crew_goes_on() {
        for leader_fails in [false, true] {
            with_others(1, || {
                let met = AtomicUsize::new(0);
                let failed = catch_unwind(AssertUnwindSafe(|| {
                    share(&|leads| {
                        met.fetch_add(1, SeqCst);
                        while met.load(SeqCst) < 2 {
                            wait_a_moment(1);
                        }
                        assert!(leads != leader_fails, "a fault");
                    });
                }));
                assert!(failed.is_err(), "the leader fails: {leader_fails}");
                assert!(leads(), "it leads again");
                let done = AtomicBool::new(false);
                share(&|_| done.store(true, SeqCst));
                assert!(done.into_inner());
            });
        }
    }

    #[test]
    fn what_a_job_shares_in_turn_is_done_by_who_shares_it() {
        let crew = Arc::new(Crew::default());
        crew.lead(|| {
            share(&|_| {
                assert!(!leads());
                let done = AtomicBool::new(false);
                share(&|_| done.store(true, SeqCst));
                assert!(done.into_inner());
            });
            assert!(leads());
        });
        assert!(!leads());
    }
}
