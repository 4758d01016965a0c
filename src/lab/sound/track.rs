//! The sound of a run, as WAV.

use super::{Audible, Ear, Listener, wav::Wav};
use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::run::Observer,
    sound::{Controls, DEFAULT_RATE, Synthesiser},
};
use bevy::ecs::world::World;
use std::io::{self, Write};

/// Frames of a tick.
const FRAMES: usize = (DEFAULT_RATE / TICKS_PER_SECOND) as usize;

/// Writes what a run sounds like before the whole of its box.
#[derive(Debug)]
pub struct Track<W: Write> {
    wav: Wav<W>,
    sound: Sound,
    samples: [f32; 2 * FRAMES],
    /// Why it can't be written on. The world goes on, for what else is to be known of it.
    fault: Option<io::Error>,
}

impl<W: Write> Track<W> {
    /// The sound of so many ticks.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn begin(out: W, ticks: u64) -> io::Result<Self> {
        let wav = Wav::begin(out, DEFAULT_RATE, ticks * FRAMES as u64)?;
        Ok(Self { wav, sound: Sound::default(), samples: [0.0; 2 * FRAMES], fault: None })
    }

    /// Ends it and returns what it was written to.
    ///
    /// # Errors
    /// If it could not be written.
    pub fn finish(self) -> io::Result<W> {
        self.fault.map_or_else(|| Ok(self.wav.into_inner()), Err)
    }
}

impl<W: Write> Observer for Track<W> {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        self.sound.next(world, &mut self.samples);
        if self.fault.is_none() {
            self.fault = self.wav.write(&self.samples).err();
        }
        Ok(())
    }
}

/// An ear before the whole of a box, and what makes it heard.
#[derive(Debug, Default)]
pub(super) struct Sound {
    ear: Ear,
    synthesiser: Synthesiser,
}

impl Sound {
    /// The samples of a tick that was just done.
    pub(super) fn next(&mut self, world: &World, samples: &mut [f32; 2 * FRAMES]) -> Controls {
        let audible = Audible::of(world);
        let controls = self.ear.listen(&audible, Listener::of_box(audible.size()));
        self.synthesiser.render(&controls, samples);
        controls
    }
}
