//! The output: a thread that connects to the system's sound when something is first to be heard, and plays what lies on the desk
//! while it is told to.

use super::desk::Desk;
#[cfg(any(windows, target_os = "macos"))]
use super::device::play;
#[cfg(not(any(windows, target_os = "macos")))]
use super::pulse::play;
use crate::sound::Controls;
use bevy::{log::warn, prelude::Resource};
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering::Relaxed},
        mpsc::{Sender, channel},
    },
    thread,
    time::Duration,
};

/// The way to the system's sound. By default there is none: only the window's game asks for it.
#[derive(Resource, Debug, Default)]
pub struct Output {
    desk: Arc<Desk>,
    /// Whether there may be one: it was not looked for yet, or found.
    may_play: Arc<AtomicBool>,
    wishes: Option<Sender<bool>>,
}

impl Output {
    /// The system's.
    pub fn of_system() -> Self {
        Self { may_play: Arc::new(AtomicBool::new(true)), ..Self::default() }
    }

    /// Leaves what is to be heard.
    pub(super) fn leave(&self, controls: &Controls) {
        self.desk.put(controls);
    }

    /// Frames that were played, and the time that took.
    pub(super) fn played(&self) -> (u64, Duration) {
        self.desk.played()
    }

    /// Whether there may be one: it was not looked for yet, or found.
    pub fn may_play(&self) -> bool {
        self.may_play.load(Relaxed)
    }

    /// Lets it play, or rest.
    pub(super) fn wish(&mut self, plays: bool) {
        if self.wishes.is_none() && plays {
            self.begin();
        }
        if let Some(wishes) = &self.wishes {
            // One that has ended has said so.
            let _ = wishes.send(plays);
        }
    }

    /// One that no system hears.
    #[cfg(test)]
    pub(super) fn of_desk() -> Self {
        let (wishes, _) = channel();
        Self { wishes: Some(wishes), ..Self::of_system() }
    }

    fn begin(&mut self) {
        let (wishes, heard) = channel();
        let (desk, may_play) = (self.desk.clone(), self.may_play.clone());
        self.wishes = Some(wishes);
        let run = move || {
            if let Err(reason) = play(&desk, &heard) {
                warn!("no sound: {reason}");
                may_play.store(false, Relaxed);
            }
        };
        if let Err(error) = thread::Builder::new().name("sound".into()).spawn(run) {
            warn!("no sound: {error}");
            self.may_play.store(false, Relaxed);
        }
    }
}
