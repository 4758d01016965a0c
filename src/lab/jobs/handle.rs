//! Work in the background: on a thread of its own, or, where the system gives none (as in a page), in a slice of each
//! frame. It is a future that yields often, and reports by messages how far it is.

use crate::lab::jobs::drive::{finish, step};
use bevy::platform::{cell::SyncCell, time::Instant};
use std::{
    future::Future,
    pin::Pin,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, Sender, TryRecvError, channel},
    },
    thread,
    time::Duration,
};

/// Time that a slice takes of a frame. A step that takes longer is not cut.
const SLICE: Duration = Duration::from_millis(4);

/// How much of its thread's time the work takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    /// All of it.
    Whole,
    /// Half: it rests as long as it works, so that a game on a machine with few processors does not stutter.
    Half,
    /// A quarter, for what nobody asked for.
    Quarter,
}

impl Share {
    /// How long it rests after it has worked for so long.
    fn rest(self, worked: Duration) -> Duration {
        match self {
            Self::Whole => Duration::ZERO,
            Self::Half => worked,
            Self::Quarter => 3 * worked,
        }
    }
}

/// Work in the background that sends messages. Dropped, it stops the work at its next pause.
pub struct Handle<M> {
    messages: SyncCell<Receiver<M>>,
    is_over: bool,
    place: Place,
}

enum Place {
    Thread { cancelled: Arc<AtomicBool> },
    Slices(SyncCell<Work>),
}

type Work = Pin<Box<dyn Future<Output = ()> + Send>>;

impl<M: Send + 'static> Handle<M> {
    /// Starts what `work` makes of the sender of its messages.
    pub fn start<W: Future<Output = ()> + Send + 'static>(share: Share, work: impl FnOnce(Sender<M>) -> W) -> Self {
        let (sender, messages) = channel();
        // Where no thread starts, the work is still here.
        let slot: Arc<Mutex<Option<Work>>> = Arc::new(Mutex::new(Some(Box::pin(work(sender)))));
        let take = |slot: &Mutex<Option<Work>>| slot.lock().unwrap_or_else(PoisonError::into_inner).take();
        let cancelled = Arc::new(AtomicBool::new(false));
        let (theirs, is_cancelled) = (slot.clone(), cancelled.clone());
        let started = thread::Builder::new().name("background".to_owned()).spawn(move || {
            let Some(work) = take(&theirs) else { return };
            let mut begun = Instant::now();
            finish(work, || {
                if share != Share::Whole {
                    thread::sleep(share.rest(begun.elapsed()));
                    begun = Instant::now();
                }
                !is_cancelled.load(Ordering::Relaxed)
            });
        });
        let place = match started.err().and_then(|_| take(&slot)) {
            Some(work) => Place::Slices(SyncCell::new(work)),
            None => Place::Thread { cancelled },
        };
        Self { messages: SyncCell::new(messages), is_over: false, place }
    }

    /// Starts it in slices, as where there are no threads.
    pub fn sliced<W: Future<Output = ()> + Send + 'static>(work: impl FnOnce(Sender<M>) -> W) -> Self {
        let (sender, messages) = channel();
        let place = Place::Slices(SyncCell::new(Box::pin(work(sender))));
        Self { messages: SyncCell::new(messages), is_over: false, place }
    }

    /// Works for a slice where there is no thread, and gives the messages since the last call.
    pub fn advance(&mut self) -> Vec<M> {
        if let Place::Slices(work) = &mut self.place {
            let begun = Instant::now();
            while begun.elapsed() < SLICE && !self.is_over {
                self.is_over = step(work.get().as_mut()).is_ready();
            }
        }
        let mut received = Vec::new();
        loop {
            match self.messages.get().try_recv() {
                Ok(message) => received.push(message),
                Err(error) => {
                    self.is_over |= error == TryRecvError::Disconnected;
                    return received;
                }
            }
        }
    }

    /// Whether the work has ended, well or not, and all its messages were given.
    pub fn is_over(&self) -> bool {
        self.is_over
    }
}

impl<M> Drop for Handle<M> {
    fn drop(&mut self) {
        if let Place::Thread { cancelled } = &self.place {
            cancelled.store(true, Ordering::Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::jobs::drive::pause;

    async fn count(to: u32, sender: Sender<u32>) {
        for k in 0..to {
            thread::sleep(Duration::from_millis(1));
            pause().await;
            if sender.send(k).is_err() {
                return;
            }
        }
    }

    fn collect(mut handle: Handle<u32>) -> Vec<u32> {
        let mut received = Vec::new();
        while !handle.is_over() {
            received.extend(handle.advance());
        }
        received
    }

    #[test]
    fn all_messages_come_from_a_thread_and_from_slices() {
        let expected: Vec<u32> = (0..30).collect();
        for share in [Share::Whole, Share::Half, Share::Quarter] {
            assert_eq!(collect(Handle::start(share, |sender| count(30, sender))), expected);
        }
        let mut handle = Handle::sliced(|sender| count(30, sender));
        assert!(handle.advance().len() < 30, "a slice does not take the whole frame");
        drop(handle);
        assert_eq!(collect(Handle::sliced(|sender| count(30, sender))), expected);
    }

    /// Work that never ends, and holds `kept` as long as it lives.
    async fn endless(kept: Arc<()>, sender: Sender<u32>) {
        count(u32::MAX, sender).await;
        drop(kept);
    }

    #[test]
    fn what_is_dropped_stops() {
        let alive = Arc::new(());
        let kept = [(); 2].map(|()| alive.clone());
        let [threaded, sliced] = kept;
        let handles = [
            Handle::start(Share::Whole, move |sender| endless(threaded, sender)),
            Handle::sliced(move |sender| endless(sliced, sender)),
        ];
        for mut handle in handles {
            handle.advance();
            assert!(!handle.is_over());
        }
        let begun = Instant::now();
        while Arc::strong_count(&alive) > 1 {
            assert!(begun.elapsed() < Duration::from_secs(20), "it goes on");
        }
    }
}
