//! Futures that yield after each tick, and what drives them. They wait for nothing: polled again, they go on.

use std::{
    future::Future,
    pin::{Pin, pin},
    task::{Context, Poll, Waker},
};

/// Lets the code that drives the future do something else once.
pub(crate) fn pause() -> Pause {
    Pause { paused: false }
}

/// See [`pause`].
pub(crate) struct Pause {
    paused: bool,
}

impl Future for Pause {
    type Output = ();

    fn poll(mut self: Pin<&mut Self>, _context: &mut Context<'_>) -> Poll<()> {
        if std::mem::replace(&mut self.paused, true) { Poll::Ready(()) } else { Poll::Pending }
    }
}

/// Goes on with a future up to its next pause.
pub(crate) fn step<F: Future + ?Sized>(future: Pin<&mut F>) -> Poll<F::Output> {
    future.poll(&mut Context::from_waker(Waker::noop()))
}

/// Drives a future to its end, asking at each pause whether to go on; `None` if not.
pub(crate) fn finish<T>(future: impl Future<Output = T>, mut go_on: impl FnMut() -> bool) -> Option<T> {
    let mut future = pin!(future);
    loop {
        match step(future.as_mut()) {
            Poll::Ready(result) => return Some(result),
            Poll::Pending if !go_on() => return None,
            Poll::Pending => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    async fn count(to: u32) -> u32 {
        for _ in 0..to {
            pause().await;
        }
        to
    }

    #[test]
    fn a_future_goes_on_until_it_is_done_or_stopped() {
        let mut pauses = 0;
        let mut counting = |limit| {
            finish(count(5), || {
                pauses += 1;
                pauses < limit
            })
        };
        assert_eq!(counting(100), Some(5));
        assert_eq!(counting(8), None, "the third pause of the second future was its last");
        assert_eq!(pauses, 8);
    }
}
