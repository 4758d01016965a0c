//! The last half minute backwards: the states of a recording, newest first. Between two that are kept, a world of its own
//! runs the ticks again that lie between them: while one such stretch is looked at, the one before it is made.
//!
//! ```text
//! kept      K . . . . . . . . K . . . . . . . . K . . . now
//!                             └─── coming ────► └ ready ◄─ looked at, newest first
//! ```

use crate::sim::{
    checkpoint::Checkpoint,
    recorder::Recorder,
    recording::{Input, Spot},
    simulation::Simulation,
    state::SolverState,
    workers::Workers,
};
use bevy::prelude::World;

/// A state of the past.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Its place in the recording.
    pub spot: Spot,
    /// The world there.
    pub state: Checkpoint,
}

/// What comes of asking for the state before.
#[derive(Debug)]
pub enum Step {
    /// It.
    Frame(Box<Frame>),
    /// It has to be made first ([`Reel::prepare`]).
    Wait,
    /// There is none: it began here, or what came before is not kept.
    End,
}

/// States that are made.
struct Coming {
    input: Input,
    /// Ticks that are still to be run.
    left: usize,
    at: Spot,
    frames: Vec<Frame>,
}

/// The past, to be looked at from the newest state on. While it is there, the recorder takes nothing.
pub struct Reel {
    recorder: Recorder,
    simulation: Simulation,
    /// The states of a stretch, oldest first.
    ready: Vec<Frame>,
    /// Those of the stretch before.
    coming: Option<Coming>,
    /// Where that begins.
    from: Spot,
}

impl Reel {
    /// The past of `world`, which is at `now`; none if nothing is recorded.
    pub fn begin(world: &World, now: &Checkpoint) -> Option<Self> {
        let recorder = world.resource::<Recorder>().clone();
        // What was put in the place of the world since the last tick is not recorded yet.
        recorder.keep_up(world);
        let from = recorder.hold()?;
        let simulation = Simulation::resume(now, world.resource::<Workers>().clone())
            .with_instructions(world.resource::<SolverState>().instructions);
        let mut reel = Self { recorder, simulation, ready: Vec::new(), coming: None, from };
        reel.load();
        Some(reel)
    }

    /// Begins the stretch before the one that is there.
    fn load(&mut self) {
        self.coming = self.recorder.stretch_before(self.from).map(|stretch| {
            stretch.start.restore(self.simulation.world_mut());
            // The end of a stretch is the beginning of the one behind it, if nothing lies between them.
            let left = if stretch.is_cut { stretch.ticks } else { stretch.ticks - 1 };
            self.from = stretch.begin;
            let frames = vec![Frame { spot: stretch.begin, state: stretch.start }];
            Coming { input: Input::new(stretch.entries), left, at: stretch.begin, frames }
        });
    }

    /// Runs a tick of what will be asked for; `false` if nothing is to be done.
    pub fn prepare(&mut self) -> bool {
        let Some(coming) = self.coming.as_mut().filter(|coming| coming.left > 0) else { return false };
        coming.at.entries += coming.input.give(self.simulation.world_mut()) as usize;
        self.simulation.tick();
        coming.at.done += 1;
        coming.left -= 1;
        coming.frames.push(Frame { spot: coming.at, state: Checkpoint::of(self.simulation.world()) });
        true
    }

    /// The state before the one that was given last.
    pub fn step(&mut self) -> Step {
        if self.ready.is_empty() {
            match &mut self.coming {
                None => return Step::End,
                Some(coming) if coming.left > 0 => return Step::Wait,
                Some(coming) => self.ready = std::mem::take(&mut coming.frames),
            }
            self.load();
        }
        self.ready.pop().map_or(Step::End, |frame| Step::Frame(Box::new(frame)))
    }

    /// Bytes that the states take that were made, to a good approximation.
    pub fn bytes(&self) -> usize {
        let coming = self.coming.iter().flat_map(|coming| &coming.frames);
        self.ready.iter().chain(coming).map(|frame| frame.state.bytes()).sum()
    }

    /// Goes on from a state, at which `world` is: what came after it is forgotten.
    pub fn go_on_from(self, world: &World, spot: Spot) {
        self.recorder.go_on_from(world, spot);
    }

    /// Goes on as if nothing had been looked at.
    pub fn put_away(self) {
        self.recorder.release();
    }
}
