//! Hands work to threads: pieces of arrays and rows of grids.
//!
//! What an entry gets never depends on where the pieces are cut, so the number of threads does not show in the result.

use crate::{
    crew::{self, Crew, wait_a_moment},
    simd::{InstructionSet, Lanes, Pass},
};
use std::{
    ops::Range,
    sync::{
        Mutex, TryLockError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

/// Pieces a thread: some are denser than others, so there is something left to steal.
const PIECES_PER_THREAD: usize = 4;
/// Pieces of arrays begin at multiples of this, so that lanes stay full.
const ALIGNMENT: usize = 16;

/// Work that can be cut in two.
pub(crate) trait Parts: Send + Sized {
    /// How much it is.
    fn size(&self) -> usize;

    /// Cuts it in about half. Only called where there is more than one part to it.
    fn halve(self) -> (Self, Self);
}

/// Shares work out to the crew that this thread leads, or else to the threads of the current rayon pool: halves it until a part is
/// no more than `most`, and calls `run` with each part.
pub(crate) fn fork<P: Parts>(part: P, most: usize, run: &(impl Fn(P) + Sync)) {
    if part.size() <= most {
        return run(part);
    }
    if crew::leads() { fork_among_crew(part, most, run) } else { fork_in_pool(part, most, run) }
}

/// The same among the threads of the current rayon pool.
fn fork_in_pool<P: Parts>(part: P, most: usize, run: &(impl Fn(P) + Sync)) {
    if part.size() <= most {
        return run(part);
    }
    let (left, right) = part.halve();
    rayon::join(|| fork_in_pool(left, most, run), || fork_in_pool(right, most, run));
}

/// Parts of a job of a crew at most; of more threads than that some have none. There is room for all of them on the stack.
const MOST_PARTS: usize = 32;

/// The same among the crew that this thread leads. It takes parts from the first on and the others from the last, so that each mostly
/// gets what its caches have of the sweep before, and no two ask for the same part but where they meet.
fn fork_among_crew<P: Parts>(part: P, most: usize, run: &(impl Fn(P) + Sync)) {
    let mut parts: [Mutex<Option<P>>; MOST_PARTS] = std::array::from_fn(|_| Mutex::new(None));
    let mut places = parts.iter_mut();
    cut_up(part, most, MOST_PARTS, &mut places);
    let count = MOST_PARTS - places.len();
    let parts = &parts[..count];
    let from_last = AtomicUsize::new(0);
    // Whoever comes to a part that is taken has met those from the other end: there is none left beyond.
    crew::share(&|leads| match leads {
        true => parts.iter().map_while(take).for_each(run),
        false => {
            let places = std::iter::from_fn(|| count.checked_sub(1 + from_last.fetch_add(1, Ordering::Relaxed)));
            places.map_while(|place| take(&parts[place])).for_each(run);
        }
    });
}

/// Takes a part, unless another has. Whoever holds its lock is taking it, so there is nothing to wait for; and a page's own thread may
/// not wait: the browser ends it.
fn take<P>(part: &Mutex<Option<P>>) -> Option<P> {
    match part.try_lock() {
        Ok(mut part) => part.take(),
        Err(TryLockError::Poisoned(part)) => part.into_inner().take(),
        Err(TryLockError::WouldBlock) => None,
    }
}

/// Halves a part until none is more than `most`, or there are as many as there is room for.
fn cut_up<'a, P: Parts + 'a>(
    part: P,
    most: usize,
    room: usize,
    places: &mut impl Iterator<Item = &'a mut Mutex<Option<P>>>,
) {
    if part.size() > most && room > 1 {
        let (left, right) = part.halve();
        cut_up(left, most, room / 2, places);
        cut_up(right, most, room / 2, places);
    } else if let Some(place) = places.next() {
        *place = Mutex::new(Some(part));
    }
}

/// Entries that are worth a piece of their own where each takes some nanoseconds; lighter work wants more.
pub(crate) const WORTH_A_PIECE: usize = 512;

/// Runs `work` over pieces of arrays of one length, of `fewest` entries or more, on up to `threads` threads of the
/// current rayon pool. Each call gets the index of its first entry and its piece of each array.
pub(crate) fn spread<const K: usize, T, F>(arrays: [&mut [T]; K], fewest: usize, threads: usize, work: &F)
where
    T: Send,
    F: Fn(usize, [&mut [T]; K]) + Sync,
{
    let len = arrays.first().map_or(0, |array| array.len());
    debug_assert!(arrays.iter().all(|array| array.len() == len), "arrays of one length");
    let most = piece(len, threads, fewest);
    fork(ArrayParts { base: 0, arrays }, most, &|part: ArrayParts<K, T>| work(part.base, part.arrays));
}

/// Pieces of arrays from entry `base` on.
struct ArrayParts<'a, const K: usize, T> {
    base: usize,
    arrays: [&'a mut [T]; K],
}

impl<const K: usize, T: Send> Parts for ArrayParts<'_, K, T> {
    fn size(&self) -> usize {
        self.arrays.first().map_or(0, |array| array.len())
    }

    fn halve(self) -> (Self, Self) {
        let half = (self.size() / 2).next_multiple_of(ALIGNMENT);
        let (left, right) = cut(self.arrays, half);
        (Self { base: self.base, arrays: left }, Self { base: self.base + half, arrays: right })
    }
}

/// Runs `work` over pieces of `0 … len`, of `fewest` or more, on up to `threads` threads of the current rayon pool.
pub(crate) fn over(len: usize, fewest: usize, threads: usize, work: &(impl Fn(Range<usize>) + Sync)) {
    fork(0..len, piece(len, threads, fewest), work);
}

impl Parts for Range<usize> {
    fn size(&self) -> usize {
        self.len()
    }

    fn halve(self) -> (Self, Self) {
        let middle = self.start + self.len() / 2;
        (self.start..middle, middle..self.end)
    }
}

/// Looks for a job in vain, one after the other, after which a watching thread gives up: a millisecond, about.
const PATIENCE: u32 = 40_000;
/// Looks after which it looks for what the pool may have to do, too.
const POOL_LOOKS: u32 = 64;

/// Runs `work` in the current rayon pool while up to `watchers` of its other threads are its [`Crew`] and look out for the parts that
/// `work` hands over. A thread that waits for others in the midst of a part may come to watch, too; that is why no watch lasts.
pub fn watched<T: Send>(watchers: usize, work: impl FnOnce() -> T + Send) -> T {
    if watchers == 0 {
        return work();
    }
    let crew = Crew::of_this_thread();
    // The thread that hands work over. Were it to watch for itself, nothing would come.
    let (done, leader) = (AtomicBool::new(false), rayon::current_thread_index());
    let lead = || {
        let result = crew.lead(work);
        done.store(true, Ordering::Release);
        result
    };
    let look_out = |_: Range<usize>| {
        let (mut in_vain, mut last) = (0, 0);
        while in_vain < PATIENCE && !done.load(Ordering::Acquire) && rayon::current_thread_index() != leader {
            in_vain += 1;
            if let Some(number) = crew.help(last) {
                (last, in_vain) = (number, 0);
            } else if in_vain % POOL_LOOKS == 0 && rayon::yield_now() == Some(rayon::Yield::Executed) {
                in_vain = 0;
            } else {
                wait_a_moment(in_vain);
            }
        }
    };
    rayon::join(lead, || fork_in_pool(0..watchers, 1, &look_out)).0
}

/// What a pass may use.
#[derive(Clone, Copy, Debug)]
pub struct Team {
    /// Lanes in use.
    pub instructions: InstructionSet,
    /// Threads to use of the current rayon pool; 1 is the calling thread alone.
    pub threads: usize,
}

/// Rows that can be cut in two.
pub(crate) trait Band: Send + Sized {
    /// Cuts `rows` rows off the front.
    fn split(self, rows: usize) -> (Self, Self);
}

/// Rows of a field of `stride` entries each; the last may be shorter where no sweep goes over it.
pub(crate) struct Rows<'a, T> {
    pub field: &'a mut [T],
    pub stride: usize,
}

impl<'a, T> Rows<'a, T> {
    /// The rows `rows` of a field.
    pub fn new(field: &'a mut [T], stride: usize, rows: &Range<usize>) -> Self {
        Self { field: &mut field[rows.start * stride..rows.end * stride], stride }
    }

    /// Row by row.
    #[inline(always)]
    pub fn each(&mut self) -> std::slice::ChunksExactMut<'_, T> {
        self.field.chunks_exact_mut(self.stride)
    }
}

impl<T: Send> Band for Rows<'_, T> {
    fn split(self, rows: usize) -> (Self, Self) {
        let (lower, upper) = self.field.split_at_mut(rows * self.stride);
        (Self { field: lower, stride: self.stride }, Self { field: upper, stride: self.stride })
    }
}

impl<A: Band, B: Band> Band for (A, B) {
    fn split(self, rows: usize) -> (Self, Self) {
        let ((lower_a, upper_a), (lower_b, upper_b)) = (self.0.split(rows), self.1.split(rows));
        ((lower_a, lower_b), (upper_a, upper_b))
    }
}

/// Work on rows of a grid, of which each may be done by itself.
pub(crate) trait Sweep<B>: Sync {
    /// Does the rows `rows`; `band` holds what they are written to. Implementations are `#[inline(always)]`, so that they
    /// are compiled for the caller's registers.
    fn run(&self, rows: Range<usize>, band: B);
}

/// Sweeps over `rows` rows of `stride` entries in pieces of `fewest` entries or more.
pub(crate) fn sweep<B: Band>(
    work: &impl Sweep<B>,
    rows: Range<usize>,
    band: B,
    stride: usize,
    fewest: usize,
    team: Team,
) {
    let most = piece(rows.len() * stride, team.threads, fewest) / stride;
    fork((rows, band), most.max(1), &|(rows, band)| team.instructions.run(SweepRows { work, rows, band }));
}

/// Rows of a grid with what belongs to them.
impl<B: Band> Parts for (Range<usize>, B) {
    fn size(&self) -> usize {
        self.0.len()
    }

    fn halve(self) -> (Self, Self) {
        let (lower_rows, upper_rows) = self.0.halve();
        let (lower, upper) = self.1.split(lower_rows.len());
        ((lower_rows, lower), (upper_rows, upper))
    }
}

struct SweepRows<'a, S, B> {
    work: &'a S,
    rows: Range<usize>,
    band: B,
}

impl<B, S: Sweep<B>> Pass for SweepRows<'_, S, B> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        self.work.run(self.rows, self.band);
    }
}

/// Whether other threads are awake for what this one hands over ([`watched`]).
pub fn are_awake() -> bool {
    crew::leads()
}

/// How many times what is worth handing to a crew is worth handing to a pool, which takes as many times longer.
const IN_POOL: usize = 4;

/// Entries that are worth handing to another thread, if `fewest` are with a crew.
pub(crate) fn worth(fewest: usize) -> usize {
    if crew::leads() { fewest } else { IN_POOL * fewest }
}

/// Entries that a piece has at most. `fewest`: those that are worth a piece of their own with a crew.
pub(crate) fn piece(len: usize, threads: usize, fewest: usize) -> usize {
    if threads <= 1 { usize::MAX } else { (len / (threads * PIECES_PER_THREAD)).max(worth(fewest)) }
}

/// Cuts each array in two at `at`.
pub(crate) fn cut<const K: usize, T>(arrays: [&mut [T]; K], at: usize) -> ([&mut [T]; K], [&mut [T]; K]) {
    let mut right: [&mut [T]; K] = std::array::from_fn(|_| Default::default());
    let mut slots = right.iter_mut();
    let left = arrays.map(|array| {
        let (before, after) = array.split_at_mut(at);
        if let Some(slot) = slots.next() {
            *slot = after;
        }
        before
    });
    (left, right)
}

/// Runs `work` in a pool of so many threads, the others of which are its crew. In a module, where a test has no threads, it is done by the caller; pieces are
/// cut as for all of them even so.
#[cfg(test)]
pub(crate) fn in_pool<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    if cfg!(target_arch = "wasm32") {
        return work();
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads")
        .install(|| watched(threads - 1, work))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Waiting for the lock would end a page, and here it would last for ever.
    #[test]
    fn a_part_that_another_is_taking_is_not_waited_for() {
        let part = Mutex::new(Some(1));
        let held = part.lock().unwrap();
        assert_eq!(take(&part), None);
        drop(held);
        assert_eq!([take(&part), take(&part)], [Some(1), None]);
    }

    struct Number {
        stride: usize,
    }

    impl<'b> Sweep<(Rows<'b, u32>, Rows<'b, usize>)> for Number {
        fn run(&self, rows: Range<usize>, (mut cells, sums): (Rows<u32>, Rows<usize>)) {
            assert_eq!((cells.field.len(), sums.field.len()), (rows.len() * self.stride, rows.len()));
            for ((row, cells), sum) in rows.zip(cells.each()).zip(sums.field) {
                cells.iter_mut().for_each(|cell| *cell += 1);
                *sum += row;
            }
        }
    }

    #[test]
    fn a_sweep_does_every_row_once_with_all_of_its_fields() {
        for (threads, fewest) in [(1, 1), (2, 1), (3, 40), (8, 1000)] {
            let (mut cells, mut sums) = (vec![0_u32; 7 * 50], vec![0_usize; 50]);
            let rows = 3..47;
            let band = (Rows::new(&mut cells, 7, &rows), Rows::new(&mut sums, 1, &rows));
            let team = Team { instructions: InstructionSet::Baseline, threads };
            sweep(&Number { stride: 7 }, rows.clone(), band, 7, fewest, team);
            assert!(cells.chunks(7).enumerate().all(|(row, cells)| cells == [u32::from(rows.contains(&row)); 7]));
            assert!((0..50).all(|row| sums[row] == if rows.contains(&row) { row } else { 0 }));
        }
    }

    #[test]
    fn watched_work_gives_its_result_whoever_watches() {
        for (threads, watchers) in [(1, 0), (1, 3), (2, 1), (4, 3), (4, 7)] {
            for len in [10, 10_000] {
                let sum = in_pool(threads, || {
                    watched(watchers, || {
                        let mut field = vec![1_u64; len];
                        for _ in 0..20 {
                            spread([&mut field[..]], 64, threads, &|base, [field]| {
                                (base as u64..).zip(field).for_each(|(k, entry)| *entry += k);
                            });
                        }
                        field.iter().sum::<u64>()
                    })
                });
                assert_eq!(sum, len as u64 + 20 * (len as u64 * (len as u64 - 1) / 2));
            }
        }
    }
}
