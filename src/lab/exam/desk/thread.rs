//! The exam on a thread of its own.

use super::{Note, sit};
use crate::lab::{drive::finish, exam::job::Job};
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::Sender,
    },
    thread,
};

/// An exam on a thread; let go, it is stopped after its next tick.
pub(super) struct Sitting {
    stop: Arc<AtomicBool>,
}

impl Sitting {
    /// Begins an exam.
    pub(super) fn begin(jobs: Vec<Job>, notes: Sender<Note>) -> Result<Self, String> {
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = stop.clone();
        let work = move || {
            finish(sit(jobs, notes), || !stopped.load(Ordering::Relaxed));
        };
        match thread::Builder::new().name("exam".to_owned()).spawn(work) {
            Ok(_) => Ok(Self { stop }),
            Err(error) => Err(format!("the system gives no thread: {error}")),
        }
    }
}

impl Drop for Sitting {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}
