//! Work on a thread of its own.

use super::{Note, Task, work};
use crate::lab::drive::finish;
use std::{
    marker::PhantomData,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::Sender,
    },
    thread,
};

/// Work on a thread; let go, it is stopped after its next tick.
pub(super) struct Sitting<T> {
    stop: Arc<AtomicBool>,
    of: PhantomData<fn() -> T>,
}

impl<T: Task> Sitting<T> {
    /// Begins to work.
    pub(super) fn begin(tasks: Vec<T>, notes: Sender<Note<T::Row>>) -> Result<Self, String> {
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = stop.clone();
        let work = move || {
            finish(work(tasks, notes), || !stopped.load(Ordering::Relaxed));
        };
        match thread::Builder::new().name("background".to_owned()).spawn(work) {
            Ok(_) => Ok(Self { stop, of: PhantomData }),
            Err(error) => Err(format!("the system gives no thread: {error}")),
        }
    }
}

impl<T> Drop for Sitting<T> {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}
