//! The exam in slices of a frame, for where there are no threads.

use super::{Note, sit};
use crate::lab::{drive::step, exam::job::Job};
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::params::Preset,
        lab::exam::{CASES, jobs, sit_all},
    };
    use std::sync::mpsc::channel;

    #[test]
    fn slices_give_the_rows_of_a_whole() {
        let jobs = || jobs(CASES, |case| case.name == "free_fall", &[Preset::Draft]);
        let (notes, received) = channel();
        let sitting = Sitting::begin(jobs(), notes).unwrap();
        let mut slices = 0;
        while RUNNING.with_borrow(Option::is_some) {
            go_on();
            slices += 1;
        }
        drop(sitting);
        let rows: Vec<_> =
            received.iter().filter_map(|note| if let Note::Rows(rows) = note { Some(rows) } else { None }).collect();
        let whole = sit_all(&jobs(), 1, |_, _, _| {}).unwrap();
        assert!(slices > 0 && rows.concat().iter().map(|row| row.got).eq(whole.iter().map(|row| row.got)));
    }

    #[test]
    fn what_is_let_go_is_forgotten() {
        let (notes, _received) = channel();
        drop(Sitting::begin(jobs(CASES, |_| true, &Preset::ALL), notes));
        assert!(RUNNING.with_borrow(Option::is_none));
    }
}
