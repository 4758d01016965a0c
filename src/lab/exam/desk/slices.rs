//! The exam in slices of a frame, for where there are no threads.

use super::{Note, sit};
use crate::lab::exam::{drive::step, job::Job};
use bevy::platform::time::Instant;
use std::{cell::RefCell, future::Future, pin::Pin, sync::mpsc::Sender, time::Duration};

/// Time that the exam takes of a frame. A tick that takes longer is not cut.
const SLICE: Duration = Duration::from_millis(4);

thread_local! {
    /// The exam that runs. A world of its own can't leave its thread, and so no resource either.
    static RUNNING: RefCell<Option<Pin<Box<dyn Future<Output = ()>>>>> = const { RefCell::new(None) };
}

/// An exam that goes on with [`go_on`]; let go, it is forgotten.
pub(super) struct Sitting;

impl Sitting {
    /// Begins an exam.
    pub(super) fn begin(jobs: Vec<Job>, notes: Sender<Note>) -> Result<Self, String> {
        RUNNING.set(Some(Box::pin(sit(jobs, notes))));
        Ok(Self)
    }
}

impl Drop for Sitting {
    fn drop(&mut self) {
        RUNNING.set(None);
    }
}

/// Goes on for a slice.
pub(super) fn go_on() {
    let begun = Instant::now();
    let Some(mut exam) = RUNNING.take() else { return };
    while begun.elapsed() < SLICE {
        if step(exam.as_mut()).is_ready() {
            return;
        }
    }
    RUNNING.set(Some(exam));
}
