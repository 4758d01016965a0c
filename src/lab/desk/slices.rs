//! Work in slices of a frame, for where there are no threads.

use super::{Note, Task, work};
use crate::lab::drive::step;
use bevy::platform::time::Instant;
use std::{
    any::TypeId, cell::RefCell, future::Future, marker::PhantomData, pin::Pin, sync::mpsc::Sender, time::Duration,
};

/// Time that a kind of work takes of a frame. A tick that takes longer is not cut.
const SLICE: Duration = Duration::from_millis(4);

/// What runs, by the kind of its tasks.
type Running = Vec<(TypeId, Pin<Box<dyn Future<Output = ()>>>)>;

thread_local! {
    /// A world of its own can't leave its thread, and so no resource either.
    static RUNNING: RefCell<Running> = const { RefCell::new(Vec::new()) };
}

/// Takes out what runs of a kind.
fn take<T: 'static>() -> Option<Pin<Box<dyn Future<Output = ()>>>> {
    RUNNING.with_borrow_mut(|running| {
        let place = running.iter().position(|(kind, _)| *kind == TypeId::of::<T>())?;
        Some(running.swap_remove(place).1)
    })
}

/// Work that goes on with [`go_on`]; let go, it is forgotten.
pub(super) struct Sitting<T: 'static>(PhantomData<fn() -> T>);

impl<T: Task> Sitting<T> {
    /// Begins to work.
    pub(super) fn begin(tasks: Vec<T>, notes: Sender<Note<T::Row>>) -> Result<Self, String> {
        let begun: Pin<Box<dyn Future<Output = ()>>> = Box::pin(work(tasks, notes));
        drop(take::<T>());
        RUNNING.with_borrow_mut(|running| running.push((TypeId::of::<T>(), begun)));
        Ok(Self(PhantomData))
    }
}

impl<T: 'static> Drop for Sitting<T> {
    fn drop(&mut self) {
        drop(take::<T>());
    }
}

/// Goes on for a slice.
pub(super) fn go_on<T: Task>() {
    let begun = Instant::now();
    let Some(mut work) = take::<T>() else { return };
    while begun.elapsed() < SLICE {
        if step(work.as_mut()).is_ready() {
            return;
        }
    }
    RUNNING.with_borrow_mut(|running| running.push((TypeId::of::<T>(), work)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::params::Preset,
        lab::exam::{CASES, Job, jobs, sit_all},
    };
    use std::sync::mpsc::channel;

    #[test]
    fn slices_give_the_rows_of_a_whole() {
        let jobs = || jobs(CASES, |case| case.name == "free_fall", &[Preset::Draft]);
        let (notes, received) = channel();
        let sitting = Sitting::begin(jobs(), notes).unwrap();
        let mut slices = 0;
        while RUNNING.with_borrow(|running| !running.is_empty()) {
            go_on::<Job>();
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
        assert!(RUNNING.with_borrow(Vec::is_empty));
    }
}
