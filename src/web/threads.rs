//! Threads for rayon, one a Web Worker. The page's own thread is one of the pool: a pool beside it would have it spin for
//! as long as the others work, for a page's thread may not sleep.

use crate::web::host;
use rayon::{ThreadBuilder, ThreadPoolBuilder};
use std::{
    arch::wasm32,
    hint,
    sync::{Mutex, MutexGuard, PoisonError, TryLockError},
};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// The page's own thread in the pool.
const PAGE: usize = 0;

/// Threads that wait for a worker to run them.
static WAITING: Mutex<Vec<ThreadBuilder>> = Mutex::new(Vec::new());

/// The page's thread may not sleep on a lock, so it asks again; the lock is held for an instant.
fn waiting() -> MutexGuard<'static, Vec<ThreadBuilder>> {
    loop {
        match WAITING.try_lock() {
            Ok(guard) => return guard,
            Err(TryLockError::Poisoned(poisoned)) => return PoisonError::into_inner(poisoned),
            Err(TryLockError::WouldBlock) => hint::spin_loop(),
        }
    }
}

/// Makes the pool of the caller and `workers` workers, each of which is at [`work`] or about to be.
///
/// # Errors
/// If there is a pool already.
#[wasm_bindgen(js_name = buildPool)]
pub fn build_pool(workers: usize) -> Result<(), JsError> {
    let hire = |thread| {
        waiting().push(thread);
        Ok(())
    };
    ThreadPoolBuilder::new().num_threads(workers + 1).use_current_thread().spawn_handler(hire).build_global()?;
    Ok(())
}

/// What a worker does: it waits for a thread of the pool, then runs it.
#[wasm_bindgen]
pub fn work() {
    host::tell_of_panics();
    loop {
        let thread = waiting().pop();
        match thread {
            Some(thread) => return thread.run(),
            None => hint::spin_loop(),
        }
    }
}

/// A worker's script calls this when its thread panicked. The page's thread would wait for that thread's work for ever, and
/// runs nothing but work of the pool meanwhile; so it gets the message, and ends, as work of the pool.
#[wasm_bindgen]
pub fn fallen(message: String) {
    // A thread outside the pool has no work that anything waits for.
    if rayon::current_thread_index().is_none() {
        return;
    }
    rayon::spawn_broadcast(move |place| {
        if place.index() == PAGE {
            host::failed(&message);
            wasm32::unreachable();
        }
    });
}
