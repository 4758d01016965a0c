//! No scene flashes more than three times a second over an area that could harm (WCAG 2.2, 2.3.1; the definition of general and
//! red flash there): the fieriest scenes, seen for some seconds each.

use super::graphics;
use crate::{
    game::{
        render::{level::Level, offscreen::Offscreen},
        views::table::ELEMENTS,
    },
    lab::{colours::Rgb, vision::linear},
    scene::{self, effects::EffectModes},
    sim::checkpoint::Checkpoint,
};
use glam::UVec2;
use std::sync::Arc;

/// A quarter of the window of 1280 × 800 each way: a flash that can harm has an area.
const SIZE: UVec2 = UVec2::new(320, 200);
/// The field of vision of ten degrees, 341 × 256 pixels of such a window.
const FIELD: UVec2 = UVec2::new(85, 64);
/// Of such a field so much must flash at once to harm, as a share.
const HARMFUL: f32 = 0.25;
/// Frames in a second, and ticks from one to the next.
const RATE: usize = 20;
const TICKS: u64 = 3;
/// Most flashes in a second, a flash being two opposing changes.
const MOST_CHANGES: usize = 2 * 3;

/// What of a colour may flash.
#[derive(Clone, Copy)]
struct Signal {
    /// How much of it there is.
    of: fn([f32; 3]) -> f32,
    /// The least change of it that counts.
    step: f32,
    /// Whether a change from one colour to another counts at all.
    counts: fn([f32; 3], [f32; 3]) -> bool,
}

/// Relative luminance.
fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn is_saturated_red([r, g, b]: [f32; 3]) -> bool {
    r > 0.0 && r >= 0.8 * (r + g + b)
}

const SIGNALS: [Signal; 2] = [
    Signal { of: luminance, step: 0.1, counts: |a, b| luminance(a).min(luminance(b)) < 0.8 },
    Signal {
        of: |[r, g, b]| (320.0 * (r - g - b)).max(0.0),
        step: 20.0,
        counts: |a, b| is_saturated_red(a) || is_saturated_red(b),
    },
];

/// A pixel as it changes.
#[derive(Clone, Default)]
struct Watch {
    /// The colour at the last turn, and which way it has gone since.
    turn: [f32; 3],
    way: i8,
    /// Frames in which it changed the other way.
    changes: Vec<usize>,
}

impl Watch {
    fn see(&mut self, signal: Signal, frame: usize, colour: [f32; 3]) {
        let change = (signal.of)(colour) - (signal.of)(self.turn);
        let way = if change < 0.0 { -1 } else { 1 };
        if frame == 0 || way == self.way {
            // Further the same way: it turns from there.
            self.turn = colour;
        } else if change.abs() >= signal.step && (signal.counts)(self.turn, colour) {
            self.changes.push(frame);
            (self.turn, self.way) = (colour, way);
        }
    }

    /// Whether it flashes too often in the second from a frame on.
    fn is_restless(&self, from: usize) -> bool {
        self.changes.iter().filter(|frame| (from..from + RATE).contains(frame)).count() > MOST_CHANGES
    }
}

/// The largest share of a field of vision that flashes more than three times in a second.
fn worst(film: &[Vec<[f32; 3]>], size: UVec2, field: UVec2) -> f32 {
    let mut worst = 0.0_f32;
    for signal in SIGNALS {
        let mut watches = vec![Watch::default(); (size.x * size.y) as usize];
        for (frame, pixels) in film.iter().enumerate() {
            watches.iter_mut().zip(pixels).for_each(|(watch, colour)| watch.see(signal, frame, *colour));
        }
        for from in 0..film.len().saturating_sub(RATE).max(1) {
            let restless: Vec<bool> = watches.iter().map(|watch| watch.is_restless(from)).collect();
            if !restless.contains(&true) {
                continue;
            }
            for y in (0..=size.y - field.y).step_by(8) {
                for x in (0..=size.x - field.x).step_by(8) {
                    let rows = (y..y + field.y).map(|y| (y * size.x + x) as usize);
                    let count: usize = rows
                        .map(|k| restless[k..k + field.x as usize].iter().filter(|restless| **restless).count())
                        .sum();
                    worst = worst.max(count as f32 / (field.x * field.y) as f32);
                }
            }
        }
    }
    worst
}

/// A picture of a field that changes between two colours so often a second, over so much of it.
fn blinking(colours: [[f32; 3]; 2], flashes: usize, share: f32) -> Vec<Vec<[f32; 3]>> {
    let all = (FIELD.x * FIELD.y) as usize;
    let lit = (all as f32 * share) as usize;
    let frame = |k: usize| {
        let colour = colours[k * 2 * flashes / RATE % 2];
        (0..all).map(|pixel| if pixel < lit { colour } else { colours[0] }).collect()
    };
    (0..2 * RATE).map(frame).collect()
}

#[test]
fn what_flashes_is_found_and_what_may_flash_is_not() {
    let seen = |film: &[Vec<[f32; 3]>]| worst(film, FIELD, FIELD) >= HARMFUL;
    let (dark, bright, red) = ([0.05; 3], [0.6; 3], [0.4, 0.02, 0.02]);
    assert!(seen(&blinking([dark, bright], 5, 0.5)));
    assert!(seen(&blinking([[0.02; 3], red], 5, 0.5)), "its luminance changes by less than a tenth");
    assert!(!seen(&blinking([dark, bright], 3, 1.0)), "three are allowed");
    assert!(!seen(&blinking([dark, bright], 5, 0.2)), "too small");
    assert!(!seen(&blinking([dark, [0.13; 3]], 5, 1.0)), "too faint");
    assert!(!seen(&blinking([[0.85; 3], [1.0; 3]], 5, 1.0)), "too bright to be seen");
}

#[test]
fn no_scene_flashes_more_than_three_times_a_second() {
    let of = |name: &str| {
        let scene = scene::load(name).expect("it comes with the game");
        Checkpoint::of_scene(Arc::new(scene.build(&[], None, &EffectModes::new()).expect("it is sound")))
    };
    let Some(mut picture) = graphics(|| Offscreen::new(&of("empty"), SIZE)) else { return };
    picture.show(&ELEMENTS, Level::Full);
    for (name, seconds) in [("fireworks", 4), ("ember_rain", 2), ("burning_house", 2), ("volcano", 2)] {
        of(name).restore(picture.world_mut());
        let see = |picture: &mut Offscreen| {
            picture.run(TICKS);
            picture.pixels().all().iter().map(|colour: &Rgb| linear(*colour)).collect::<Vec<_>>()
        };
        let film: Vec<_> = (0..seconds * RATE).map(|_| see(&mut picture)).collect();
        let share = worst(&film, SIZE, FIELD);
        eprintln!("{name}: {share}");
        assert!(share < HARMFUL, "{name}: {:.0} % of a field of vision flashes", 100.0 * share);
    }
}
