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
        atomic::{AtomicU8, Ordering::Relaxed},
        mpsc::{Sender, channel},
    },
    thread,
    time::Duration,
};

/// What became of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
enum Fate {
    /// Nothing was to be heard yet.
    Unasked,
    /// It is being connected, or plays.
    There,
    /// There is none.
    Absent,
}

/// The way to the system's sound.
#[derive(Resource, Debug)]
pub struct Output {
    desk: Arc<Desk>,
    fate: Arc<AtomicU8>,
    wishes: Option<Sender<bool>>,
}

impl Default for Output {
    fn default() -> Self {
        Self { desk: Arc::default(), fate: Arc::new(AtomicU8::new(Fate::Unasked as u8)), wishes: None }
    }
}

impl Output {
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
        self.fate.load(Relaxed) != Fate::Absent as u8
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
        Self { wishes: Some(wishes), ..Self::default() }
    }

    /// One of a machine that has none.
    #[cfg(test)]
    pub(super) fn absent() -> Self {
        Self { fate: Arc::new(AtomicU8::new(Fate::Absent as u8)), ..Self::default() }
    }

    fn begin(&mut self) {
        let (wishes, heard) = channel();
        let (desk, fate) = (self.desk.clone(), self.fate.clone());
        fate.store(Fate::There as u8, Relaxed);
        self.wishes = Some(wishes);
        let run = move || {
            if let Err(reason) = play(&desk, &heard) {
                warn!("no sound: {reason}");
                fate.store(Fate::Absent as u8, Relaxed);
            }
        };
        if let Err(error) = thread::Builder::new().name("sound".into()).spawn(run) {
            warn!("no sound: {error}");
            self.fate.store(Fate::Absent as u8, Relaxed);
        }
    }
}
