//! What the game wants of the output: that it plays, or rests.

use std::{sync::mpsc::Receiver, thread, time::Duration};

/// Time that a sound has to fade before the output rests: longer than any way from the desk to the ear.
const FADE: Duration = Duration::from_millis(400);

/// The next wish that changes something, once what it ends has faded; `None` when the game is over.
pub(super) fn next_wish(wishes: &Receiver<bool>, plays: bool) -> Option<bool> {
    loop {
        let mut wish = wishes.recv().ok()?;
        if plays && !wish {
            thread::sleep(FADE);
        }
        while let Ok(later) = wishes.try_recv() {
            wish = later;
        }
        if wish != plays {
            return Some(wish);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    #[test]
    fn only_a_wish_that_changes_something_counts_and_the_last_of_several() {
        let (wishes, heard) = channel();
        let send = |all: &[bool]| all.iter().for_each(|wish| wishes.send(*wish).unwrap());
        send(&[true, false, true, true]);
        assert_eq!(next_wish(&heard, false), Some(true));
        send(&[false, true, false]);
        assert_eq!(next_wish(&heard, true), Some(false));
        send(&[false]);
        drop(wishes);
        assert_eq!(next_wish(&heard, false), None);
    }
}
