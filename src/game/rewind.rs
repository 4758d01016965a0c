//! Rewinding: while a key or a button is held the world runs backwards, as fast as it runs forward; let go, it goes on
//! from there. An order that changes the world, such as a stroke, ends it as letting go does.
//!
//! The states come from the last minute that is always recorded ([`Reel`]). What is shown of them is only looked at; the one
//! at which it ends is put in the place of the world, to the bit what it was, and undo has the world before.

use crate::{
    game::{
        actions::Action,
        history,
        input::{keys, strokes::DragState},
        orders::Order,
        toasts::Toasts,
    },
    kernel::units::TICKS_PER_SECOND,
    sim::{
        checkpoint::Checkpoint,
        control,
        effects::Effects,
        pace::{FRAME_BUDGET, MOST_TICKS, Pace},
        recorder::REWIND_TICKS,
        recording::KEY_TICKS,
        reel::{Frame, Reel, Step},
        state::Setup,
    },
};
use bevy::{
    platform::time::Instant,
    prelude::{ButtonInput, KeyCode, Real, Resource, Time, World},
};
use std::{mem, sync::Arc};
use tr::tr;

/// The past, while it is looked at.
#[derive(Resource, Default)]
pub struct Rewind {
    running: Option<Running>,
    /// Whether a button asked for it in this frame.
    asked: bool,
}

/// A past that is looked at.
struct Running {
    reel: Reel,
    /// The world when it began.
    before: Checkpoint,
    /// What is shown.
    frame: Option<Frame>,
    /// States gone back.
    back: u64,
    /// Why it goes no further.
    end: Option<&'static str>,
    /// Ticks that are due, of less than a whole one.
    due: f64,
}

impl Rewind {
    /// How many ticks it has gone back, and why it goes no further, if it does not; nothing while it is not used.
    pub fn progress(&self) -> Option<(u64, Option<&'static str>)> {
        self.running.as_ref().map(|running| (running.back, running.end))
    }

    /// Bytes that the states take that are looked at, to a good approximation.
    pub fn bytes(&self) -> usize {
        self.running.as_ref().map_or(0, |running| running.reel.bytes() + running.before.bytes())
    }
}

/// Begins to go back, or goes on with it for a frame.
pub fn ask(world: &mut World) {
    if world.resource::<Rewind>().running.is_none() && world.contains_resource::<Setup>() {
        let before = Checkpoint::of(world);
        let Some(reel) = Reel::begin(world, &before) else { return };
        // A stroke that goes on ends here.
        world.resource_mut::<DragState>().release();
        world.resource_mut::<Pace>().rewinds = true;
        let running = Running { reel, before, frame: None, back: 0, end: None, due: 0.0 };
        world.resource_mut::<Rewind>().running = Some(running);
    }
    world.resource_mut::<Rewind>().asked = true;
}

/// Whether an order can only be carried out in a world that goes on.
pub fn ends_with(order: &Order) -> bool {
    use Action as A;
    match order {
        Order::Act(action) => !matches!(
            action,
            A::Rewind
                | A::Hold(_)
                | A::Pan(..)
                | A::Zoom(_)
                | A::View(_)
                | A::NextView
                | A::Hud
                | A::Panel(_)
                | A::Close
                | A::Mute
                | A::FullScreen
                | A::Brush(_)
                | A::BrushShape
                | A::Tool(_)
                | A::Element(_)
                | A::Speed(_)
        ),
        Order::Volume(_) | Order::Keys(_) => false,
        _ => true,
    }
}

/// Goes back as far as is due in this frame, or ends if nobody asks for more. After the orders.
pub fn run(world: &mut World) {
    let asked = mem::take(&mut world.resource_mut::<Rewind>().asked);
    let Some(mut running) = world.resource_mut::<Rewind>().running.take() else { return };
    if asked || is_held(world) {
        running.go_back(world);
        world.resource_mut::<Rewind>().running = Some(running);
    } else {
        end(world, running);
    }
}

fn is_held(world: &World) -> bool {
    let keys = world.get_resource::<ButtonInput<KeyCode>>();
    keys.is_some_and(|keys| keys::is_held(Action::Rewind, keys, world.resource()))
}

/// Goes on from what is shown, if the past is looked at.
pub fn finish(world: &mut World) {
    if let Some(running) = world.resource_mut::<Rewind>().running.take() {
        end(world, running);
    }
}

fn end(world: &mut World, running: Running) {
    world.resource_mut::<Pace>().rewinds = false;
    let Running { reel, before, frame, back, .. } = running;
    let Some(Frame { spot, state }) = frame else { return reel.put_away() };
    state.restore(world);
    reel.go_on_from(world, spot);
    history::remember(world, before);
    world
        .resource_mut::<Toasts>()
        .say(tr!("Back by {} s (undo goes forward again)", format_args!("{:.1}", seconds(back))));
}

/// Ticks as seconds.
pub fn seconds(ticks: u64) -> f64 {
    ticks as f64 / f64::from(TICKS_PER_SECOND)
}

impl Running {
    fn go_back(&mut self, world: &mut World) {
        let speed = f64::from(world.resource::<Pace>().speed);
        // A late frame is no reason to leap.
        let elapsed = world.resource::<Time<Real>>().delta_secs_f64().min(0.1);
        self.due = (self.due + elapsed * f64::from(TICKS_PER_SECOND) * speed).min(f64::from(MOST_TICKS));
        if self.back == 0 {
            // However short it is held, it goes back.
            self.due = self.due.max(1.0);
        }
        let begun = Instant::now();
        let mut seen = None;
        // What adds up to a whole tick but for rounding is one.
        while self.due > 0.999 && self.end.is_none() {
            // A stretch is made while the one behind it is looked at: a tick for each.
            self.reel.prepare();
            match self.reel.step() {
                _ if self.back >= REWIND_TICKS => self.end = Some("as far back as it is kept"),
                Step::Frame(frame) => {
                    (self.due, self.back) = (self.due - 1.0, self.back + 1);
                    seen = Some(*frame);
                }
                // The first stretch, or one that many edits were made in.
                Step::Wait if begun.elapsed() < FRAME_BUDGET => continue,
                Step::Wait => break,
                Step::End => self.end = Some(why(&self.frame, seen.as_ref())),
            }
            if begun.elapsed() >= FRAME_BUDGET {
                break;
            }
        }
        // What a frame was too late for is left out.
        self.due = self.due.fract();
        if let Some(frame) = seen {
            show(world, &frame.state);
            self.frame = Some(frame);
        }
    }
}

/// Why there is nothing before a state.
fn why(shown: &Option<Frame>, seen: Option<&Frame>) -> &'static str {
    let spot = seen.or(shown.as_ref()).map(|frame| frame.spot);
    let begins = spot.is_none_or(|spot| spot.segment == 0 && spot.done < KEY_TICKS);
    if begins { "this is where it began" } else { "as far back as memory reaches" }
}

/// Shows a state. As long as it is of the same scene and quality, only that is changed which a tick changes.
fn show(world: &mut World, state: &Checkpoint) {
    let (now, then) = (world.resource::<Setup>(), &state.setup);
    let is_like = Arc::ptr_eq(&now.blueprint, &then.blueprint)
        && (now.domain, now.preset, now.quality) == (then.domain, then.preset, then.quality)
        && world.resource::<Effects>().modes() == state.modes;
    if is_like {
        control::show(world, &state.state);
    } else {
        state.restore(world);
    }
}
