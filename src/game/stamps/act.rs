//! What is done with stamps, between ticks.

use crate::{
    game::{
        actions::{Action, Take},
        history,
        input::bindings::Bindings,
        language::grouped,
        springs,
        stamps::{hand::Hand, shelf::Shelf},
        toasts::Toasts,
    },
    kernel::{brush::Stroke, piece::Turn, sources::Rect},
    sim::{
        control,
        intent::{Intent, IntentQueue},
        stamp::{Stamp, fitted},
        state::{ParticleStore, Rock, Setup, Sources},
    },
};
use bevy::prelude::World;
use glam::{IVec2, Vec2};
use std::sync::Arc;
use tr::tr;

/// Takes up a frame; or lays it down, if it is in hand.
pub fn take_up_frame(world: &mut World, take: Take) {
    let mut hand = world.resource_mut::<Hand>();
    *hand = if *hand == Hand::Frame(take) { Hand::Empty } else { Hand::Frame(take) };
}

/// Takes up the newest stamp.
pub fn take_up_last(world: &mut World) {
    if let Some(newest) = world.resource_mut::<Shelf>().stamps().first().cloned() {
        *world.resource_mut::<Hand>() = Hand::Stamp(newest, Turn::default());
        return;
    }
    let key = world.resource::<Bindings>().key(Action::Take(Take::Copy));
    world.resource_mut::<Toasts>().say(tr!("There is no stamp yet: {key} and a drag copy a piece of the world", key));
}

/// Takes up a stamp of the shelf.
pub fn take_up(world: &mut World, number: u64) {
    let found = world.resource_mut::<Shelf>().stamps().iter().find(|kept| kept.number == number).cloned();
    if let Some(kept) = found {
        *world.resource_mut::<Hand>() = Hand::Stamp(kept, Turn::default());
    }
}

/// Lays down what is in hand; `false` if nothing is.
pub fn lay_down(world: &mut World) -> bool {
    !std::mem::take(&mut *world.resource_mut::<Hand>()).is_empty()
}

/// Turns or mirrors the stamp in hand.
pub fn turn(world: &mut World, turned: fn(Turn) -> Turn) {
    if let Hand::Stamp(_, turn) = &mut *world.resource_mut::<Hand>() {
        *turn = turned(*turn);
    }
}

/// The whole cells of a box of `size` cells that a rectangle touches: the lowest, and the one behind the highest.
pub fn cells_between(a: Vec2, b: Vec2, size: IVec2) -> (IVec2, IVec2) {
    let (low, high) = (a.min(b).floor().as_ivec2(), a.max(b).ceil().as_ivec2());
    let low = low.clamp(IVec2::ZERO, size - 1);
    (low, high.clamp(low + 1, size))
}

/// Makes a stamp of what is in a rectangle between two corners, d, and takes it up. It is one step of undo if it is cut.
pub fn take(world: &mut World, (from, to): (Vec2, Vec2), take: Take) {
    // Esc may have laid the frame down while it was dragged.
    let in_hand = *world.resource::<Hand>() == Hand::Frame(take);
    let Some(rock) = world.get_resource::<Rock>().filter(|_| in_hand) else { return };
    let (low, high) = cells_between(from, to, IVec2::new(rock.columns(), rock.rows()));
    let stamp = Stamp::of(world, low, high);
    if stamp.is_empty() {
        world.resource_mut::<Toasts>().say(tr!("Nothing is in there"));
        return;
    }
    let count = grouped(stamp.piece.count() as u64);
    let springs = stamp.springs.count();
    let told = match (take, springs) {
        (Take::Copy, 0) => tr!("Copied: {} particles", count),
        (Take::Cut, 0) => tr!("Cut: {} particles", count),
        (Take::Copy, _) => tr!("Copied: {count} particles, springs and drains: {springs}", count, springs),
        (Take::Cut, _) => tr!("Cut: {count} particles, springs and drains: {springs}", count, springs),
    };
    if take == Take::Cut {
        history::checkpoint(world);
        cut(world, Rect { min: low.as_vec2(), max: high.as_vec2() });
    }
    let (kept, written) = world.resource_mut::<Shelf>().add(stamp);
    *world.resource_mut::<Hand>() = Hand::Stamp(kept, Turn::default());
    let mut toasts = world.resource_mut::<Toasts>();
    match written {
        Ok(()) => toasts.say(told),
        Err(error) => toasts.warn(tr!("{told}, but not kept for the next session: {error}", told, error)),
    }
}

/// Takes away what is in a frame, of springs and drains those that lie in it whole.
fn cut(world: &mut World, frame: Rect) {
    let whole = |area: &Rect| area.within(frame) == Some(*area);
    let springs = springs::areas(world.resource()).map(|(area, _)| area).filter(whole);
    let mut intents = vec![Intent::Erase { stroke: Stroke::rectangle(frame.min, frame.max) }];
    intents.extend(springs.map(|area| Intent::RemoveSources { stroke: Stroke::rectangle(area.min, area.max) }));
    // At once: a tick later something else may be in there.
    world.resource_mut::<IntentQueue>().extend(intents);
    control::apply_edits(world);
}

/// Pastes the stamp in hand with its middle at a point, d, as far as there is free room; says what did not fit.
pub fn paste(world: &mut World, at: Vec2) {
    let (Hand::Stamp(kept, turn), Some(setup)) = (world.resource::<Hand>(), world.get_resource::<Setup>()) else {
        return;
    };
    let turn = *turn;
    let scene = setup.blueprint.clone();
    let found = kept.stamp.piece(&scene.elements);
    let fits = found.and_then(|piece| fitted(&piece, &scene).map(|there| there.count()).map(|count| (piece, count)));
    let springs = kept.stamp.springs_at(&scene, at, turn);
    let ((piece, all), springs) = match fits.and_then(|fits| Ok((fits, springs?))) {
        Ok(fits) => fits,
        Err(what) => {
            world.resource_mut::<Toasts>().warn(tr!("The stamp does not fit: {}", what));
            return;
        }
    };
    history::checkpoint(world);
    let (before, all) = (count(world), [all, springs.count()]);
    let mut queue = world.resource_mut::<IntentQueue>();
    queue.push(Intent::Paste { piece: Arc::new(piece), at, turn });
    // Recordings of stamps without are as they were.
    queue.extend((!springs.is_empty()).then_some(Intent::PasteSources { springs }));
    control::apply_edits(world);
    let after = count(world);
    let left_out = [0, 1].map(|k| (before[k] + all[k]).saturating_sub(after[k]));
    let [some, some_springs] = left_out.map(|count| grouped(count as u64));
    let [all, all_springs] = all.map(|count| grouped(count as u64));
    let mut toasts = world.resource_mut::<Toasts>();
    if left_out[0] > 0 {
        toasts.say(tr!("{some} of {all} particles did not fit: no free room there", some, all));
    }
    if left_out[1] > 0 {
        let most = Sources::MOST;
        toasts.say(tr!(
            "{some} of {all} springs and drains are left out: others are there, they are too large, or there are {most} already",
            some = some_springs,
            all = all_springs,
            most
        ));
    }
}

/// Particles and rock; emitters and drains.
fn count(world: &World) -> [usize; 2] {
    let (particles, rock, sources) =
        (world.resource::<ParticleStore>(), world.resource::<Rock>(), world.resource::<Sources>());
    [particles.len() + rock.count(), sources.emitters.len() + sources.drains.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_takes_whole_cells_of_the_box_and_at_least_one() {
        let cells = |a: (f32, f32), b: (f32, f32)| cells_between(a.into(), b.into(), IVec2::new(20, 10));
        let of = |low: (i32, i32), high: (i32, i32)| (IVec2::from(low), IVec2::from(high));
        assert_eq!(cells((3.2, 4.9), (7.1, 2.0)), of((3, 2), (8, 5)));
        assert_eq!(cells((3.2, 4.9), (3.3, 4.9)), of((3, 4), (4, 5)));
        assert_eq!(cells((-9.0, 5.0), (99.0, 6.0)), of((0, 5), (20, 6)));
        assert_eq!(cells((30.0, 30.0), (40.0, 40.0)), of((19, 9), (20, 10)));
    }
}
