//! The truth lens: inside a ring at the pointer the same moment at `reference`. It is the second world of the A/B split,
//! seen in another way; when it is laid down that world goes.
//!
//! Its key shows it as long as it is held. A tap, or a button, takes it up until the next.

use crate::{
    game::{
        actions::Action,
        camera::{Area, WorldCamera},
        input::{bindings::Bindings, keys, pointer::Pointer},
        toasts::Toasts,
    },
    kernel::params::Preset,
    lab::split::Split,
    sim::{pace::Pace, state::Setup},
};
use bevy::prelude::{ButtonInput, KeyCode, Mut, Real, Res, ResMut, Resource, Time, World};
use glam::Vec2;
use tr::tr;

/// The quality that is seen through it.
pub const TRUTH: Preset = Preset::Reference;
/// A key that is let go within this time was tapped, s.
const TAP: f32 = 0.3;
/// Most of a frame that counts for that: to begin the second world can take long, s.
const FRAME: f32 = 0.1;
/// Radius of the ring at first, and within what bounds the wheel changes it, of the shorter side of the window.
const RADIUS: f32 = 0.15;
const RADII: std::ops::RangeInclusive<f32> = 0.06..=0.45;
/// Factor of one turn of the wheel.
const STEP: f32 = 1.12;
/// Least radius, logical pixels.
const LEAST: f32 = 48.0;

/// The lens.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    on: bool,
    /// For how long its key has been held since it was taken up, s.
    held: Option<f32>,
    /// Where the pointer was last over the world, logical pixels.
    at: Option<Vec2>,
    /// Radius of the ring, of the shorter side of the window.
    radius: f32,
}

impl Default for Lens {
    fn default() -> Self {
        Self { on: false, held: None, at: None, radius: RADIUS }
    }
}

/// The ring, logical pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Its middle.
    pub centre: Vec2,
    /// Its radius.
    pub radius: f32,
}

impl Ring {
    /// The square around it, and around its smooth edge.
    pub fn area(self) -> Area {
        let reach = Vec2::splat(self.radius + 1.0);
        Area { min: self.centre - reach, max: self.centre + reach }
    }
}

impl Lens {
    /// Whether it is taken up.
    pub fn is_on(&self) -> bool {
        self.on
    }

    /// Where it is, if it is taken up: at the pointer, or where that was last over the world.
    pub fn ring(&self, camera: &WorldCamera) -> Option<Ring> {
        let (free, radius) = (camera.free(), (self.radius * camera.window().min_element()).max(LEAST));
        let at = self.at.unwrap_or((free.min + free.max) / 2.0);
        self.on.then(|| Ring { centre: at.clamp(free.min, free.max), radius })
    }

    /// Makes the ring larger or smaller by steps.
    pub fn grow(&mut self, steps: i32) {
        let factor = if steps > 0 { STEP } else { 1.0 / STEP };
        let radius = (0..steps.abs()).fold(self.radius, |radius, _| radius * factor);
        self.radius = radius.clamp(*RADII.start(), *RADII.end());
    }

    fn lay_down(&mut self, split: &mut Split) {
        (self.on, self.held) = (false, None);
        split.end();
    }
}

/// Run condition: it is taken up.
pub fn is_on(lens: Res<Lens>) -> bool {
    lens.on
}

/// Takes it up, or lays it down.
pub fn toggle(world: &mut World) {
    if lay_down(world) {
        return;
    }
    if world.resource::<Split>().is_on() {
        let key = world.resource::<Bindings>().key(Action::Split);
        let told =
            tr!("The A/B split has a second world already: end it ({key}), and the lens has one of its own", key);
        return world.resource_mut::<Toasts>().warn(told);
    }
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let (quality, scale) = (setup.quality, setup.blueprint.scale);
    if let Err(error) = Split::begin(world, TRUTH, TRUTH.quality()) {
        return world.resource_mut::<Toasts>().warn(error);
    }
    let second = world.resource::<Split>().world().map(|second| second.resource::<Setup>());
    let equal = second.is_some_and(|second| (second.quality, second.blueprint.scale) == (quality, scale));
    let told = match equal {
        true => tr!("This world runs at reference itself: the lens shows no difference"),
        false => {
            let key = world.resource::<Bindings>().key(Action::Lens);
            tr!("In the ring: this moment at reference, and on from it. Letting go, or {key}, ends it", key)
        }
    };
    world.resource_mut::<Toasts>().say(told);
    let mut lens = world.resource_mut::<Lens>();
    (lens.on, lens.held) = (true, Some(0.0));
}

/// Lays it down; whether it was taken up.
pub fn lay_down(world: &mut World) -> bool {
    let was_on = world.resource::<Lens>().on;
    if was_on {
        world.resource_scope(|world, mut lens: Mut<Lens>| {
            lens.lay_down(&mut world.resource_mut::<Split>());
        });
    }
    was_on
}

/// Follows the pointer, and ends with the key.
pub fn run(
    mut lens: ResMut<Lens>,
    mut split: ResMut<Split>,
    (pace, time): (Res<Pace>, Res<Time<Real>>),
    (keys, bindings): (Option<Res<ButtonInput<KeyCode>>>, Res<Bindings>),
    (pointer, camera): (Res<Pointer>, Res<WorldCamera>),
) {
    // The past has no second world, and another scene may be too large for one.
    if !split.is_on() || pace.rewinds {
        return lens.lay_down(&mut split);
    }
    if let Some(at) = pointer.at.filter(|at| camera.free().contains(*at)) {
        lens.at = Some(at);
    }
    let Some(held) = lens.held else { return };
    if keys.is_some_and(|keys| keys::is_held(Action::Lens, &keys, &bindings)) {
        lens.held = Some(held + time.delta_secs().min(FRAME));
    } else if held > TAP {
        lens.lay_down(&mut split);
    } else {
        lens.held = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_stays_readable_and_over_the_world() {
        let mut lens = Lens { on: true, ..Lens::default() };
        for (x, y) in [(320.0, 200.0), (1280.0, 800.0), (3840.0, 2160.0)] {
            let window = Vec2::new(x, y);
            let mut camera = WorldCamera::new(window, Vec2::new(160.0, 90.0));
            let free = Area { min: Vec2::new(0.0, 40.0), max: Vec2::new(x, y - 60.0) };
            camera.set_window(window, free);
            for (steps, at) in [(0, None), (-99, Some(Vec2::ZERO)), (99, Some(window))] {
                (lens.radius, lens.at) = (RADIUS, at);
                lens.grow(steps);
                let ring = lens.ring(&camera).expect("it is taken up");
                assert!(ring.radius >= LEAST && ring.radius <= 0.46 * y.max(LEAST / 0.46), "{ring:?} in {window}");
                assert!(ring.centre.cmpge(free.min).all() && ring.centre.cmple(free.max).all(), "{ring:?} in {window}");
            }
        }
        lens.on = false;
        assert_eq!(lens.ring(&WorldCamera::default()), None);
    }
}
