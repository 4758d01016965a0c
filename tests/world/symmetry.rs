//! A world has no favourite direction: mirrored, upside down or turned by a quarter, it runs so.
//!
//! To the bit where nothing is added up in another order and nothing is rounded otherwise. That is so of two particles, but
//! not of three, whose sums depend on their order; and `x` and `size − x` are equally fine only where both lie between the
//! same two powers of two. Elsewhere the two runs part by rounding, and a dam break doubles any difference every two or
//! three ticks. docs/stability.md derives the bounds.

use crate::support::{Furnish, Random, SimulationExt, apart, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::{Preset, Quality},
        solids::Solids,
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{intent::Intent, simulation::Simulation, state::AirGrid},
};

/// Edge of the box of the dam, d: a whole number of the predictor's cells, and of those 16, which pair the same from both
/// sides on every coarser grid.
const SIDE: u32 = 40;
const GRAVITY: f32 = 98.1;

/// One of the eight ways in which a square box fits itself.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Image {
    /// Whether left and right are exchanged, before it is turned.
    mirrored: bool,
    /// Quarters by which it is turned to the left.
    quarters: u32,
    /// Edge of the box, d.
    side: u32,
}

impl Image {
    /// The world itself.
    fn own(side: u32) -> Self {
        Self { mirrored: false, quarters: 0, side }
    }

    /// All others.
    fn others(side: u32) -> impl Iterator<Item = Self> {
        (1..8).map(move |k| Self { mirrored: k >= 4, quarters: k % 4, side })
    }

    /// Where a point comes to. Exact if `side − x` is.
    fn of(self, at: Vec2) -> Vec2 {
        let side = self.side as f32;
        let at = if self.mirrored { Vec2::new(side - at.x, at.y) } else { at };
        (0..self.quarters).fold(at, |at, _| Vec2::new(side - at.y, at.x))
    }

    /// Which way one leads.
    fn way(self, way: Vec2) -> Vec2 {
        let way = if self.mirrored { Vec2::new(-way.x, way.y) } else { way };
        (0..self.quarters).fold(way, |way, _| way.perp())
    }

    /// A closed box with gravity, d/s².
    fn square(self, quality: (Preset, Quality), gravity: f32) -> Blueprint {
        let mut blueprint = empty_box(self.side, self.side);
        (blueprint.preset, blueprint.quality) = quality;
        blueprint.domain.gravity = self.way(Vec2::new(0.0, -gravity));
        blueprint
    }
}

fn without(blueprint: &mut Blueprint, effects: &[Effect]) {
    for effect in effects {
        blueprint.effects.insert(*effect, Mode::Off);
    }
}

/// A column of water against one wall and a block of rock in its way.
fn dam(image: Image, quality: (Preset, Quality)) -> Blueprint {
    let mut blueprint = image.square(quality, GRAVITY);
    without(&mut blueprint, &[Effect::Air, Effect::Drag]);
    let place = |x: i32, y: i32| image.of(Vec2::new(x as f32 + 0.5, y as f32 + 0.5));
    for y in 0..20 {
        for x in 0..10 {
            blueprint.water(place(x, y), Vec2::ZERO);
        }
    }
    for y in 0..4 {
        for x in 16..19 {
            let cell = Solids::cell_of(place(x, y));
            blueprint.rock((cell.x, cell.y), (cell.x + 1, cell.y + 1));
        }
    }
    blueprint
}

/// How far the dam and its image may be apart after so many ticks by rounding alone, root of the mean square, d.
///
/// Positions are rounded to the spacing u of the numbers below the box's edge, 2⁻¹⁸ between 32 and 64: once by the move, once
/// by the predictor and once by each iteration, in each of the two worlds. Each rounding is off by anything up to u/2 either
/// way, u²/12 in the mean square, u²/6 for the two; and since velocity comes from positions it is there once more in
/// the next tick. So a tick of s substeps of i iterations adds 2 u √(s (2 + i)/6). What was there grows meanwhile, at most
/// twofold in two ticks, which is 2 in the mean square in each: together 2 u √(s (2 + i)/6) √(2^ticks − 1).
fn rounding(quality: &Quality, ticks: i32) -> f64 {
    let roundings = f64::from(quality.substeps * (2 + quality.iterations));
    2.0 * 2.0_f64.powi(-18) * (roundings / 6.0).sqrt() * (2.0_f64.powi(ticks) - 1.0).sqrt()
}

#[test]
fn a_dam_break_and_its_images_part_by_rounding_only() {
    let substeps = |substeps: u32, preset: Preset| (preset, Quality { substeps, ..preset.quality() });
    for quality in [
        substeps(1, Preset::Classic),
        substeps(1, Preset::Draft),
        substeps(2, Preset::Draft),
        substeps(1, Preset::Fast),
        substeps(1, Preset::Balanced),
    ] {
        let what = format!("{} × {}", quality.0.name(), quality.1.substeps);
        let mut upright = Simulation::of(dam(Image::own(SIDE), quality));
        let mut others: Vec<_> =
            Image::others(SIDE).map(|image| (image, Simulation::of(dam(image, quality)))).collect();
        let nudged = |seed: u64| {
            let mut nudged = dam(Image::own(SIDE), quality);
            nudged.nudge(seed);
            Simulation::of(nudged)
        };
        let mut nudged: Vec<Simulation> = (0..others.len() as u64).map(nudged).collect();
        for tick in 1..=24 {
            upright.run(1);
            // A difference that is put in at the start has to go together with them. How fast it grows is a matter of
            // luck: the largest of as many counts.
            let other = nudged.iter_mut().map(|nudged| apart(&upright, nudged.run(1), |at| at)).fold(0.0, f64::max);
            let most = rounding(&quality.1, tick);
            let mut all = Vec::new();
            for (image, world) in &mut others {
                let apart = apart(&upright, world.run(1), |at| image.of(at));
                assert!(
                    apart < most,
                    "{what}, {image:?}, tick {tick}: {apart:e} d apart, rounding makes {most:e} at most"
                );
                all.push(apart);
            }
            // A density a rounding above the bound from which on it is iterated again sets one or two of them off at once. What
            // prefers a direction would do so to the four that are turned by quarters, or to more.
            all.sort_by(f64::total_cmp);
            let middle = all[all.len() / 2];
            assert!(middle < 8.0 * other, "{what}, tick {tick}: {all:?} d apart, a nudge makes {other:e}");
        }
        let fallen = upright.particles().x.iter().copied().fold(0.0, f32::max);
        assert!(fallen > 10.5, "{what}: nothing moved, to {fallen} at most");
    }
}

/// Edge of a box in whose middle third, from 16 to 32 d, a coordinate and its image are numbers equally fine.
const THIRDS: u32 = 48;

/// Nine flocks of so many particles in the middle third, further apart than they reach, thrown about.
fn flocks(image: Image, preset: Preset, each: usize, effects_off: &[Effect]) -> Blueprint {
    let mut blueprint = image.square((preset, preset.quality()), 30.0);
    without(&mut blueprint, effects_off);
    let mut random = Random::new(3);
    // 2⁻¹⁹ d from one number to the next.
    let on_grid = |at: Vec2| (at * 524_288.0).round() / 524_288.0;
    for flock in 0..9 {
        let middle = Vec2::new(19.0 + 5.0 * (flock % 3) as f32, 21.0 + 5.0 * (flock / 3) as f32);
        let thrown = random.point(Vec2::splat(2.0)) - 1.0;
        for _ in 0..each {
            let at = on_grid(middle + random.point(Vec2::splat(1.0)) - 0.5);
            let velocity = thrown + random.point(Vec2::splat(1.0)) - 0.5;
            blueprint.water(image.of(at), image.way(velocity));
        }
    }
    blueprint
}

/// Positions and velocities in the order of the ids, as the image has them. No number is −0.
fn bits(world: &Simulation, image: Image) -> Vec<[u32; 4]> {
    let particles = world.particles();
    let of = |i: u32| {
        let (at, velocity) = (particles.position(i as usize), particles.velocity(i as usize));
        assert!(at.min_element() >= 16.0 && at.max_element() < 32.0, "{at} has left the middle third");
        let (at, velocity) = (image.of(at), image.way(velocity) + 0.0);
        [at.x, at.y, velocity.x, velocity.y].map(f32::to_bits)
    };
    particles.in_id_order().into_iter().map(of).collect()
}

#[test]
fn two_that_meet_do_so_mirrored_and_turned_to_the_bit() {
    for preset in [Preset::Draft, Preset::Fast, Preset::Balanced, Preset::Fine] {
        let world = |image| Simulation::of(flocks(image, preset, 2, &[Effect::Air, Effect::Drag]));
        let mut upright = world(Image::own(THIRDS));
        let mut others: Vec<_> = Image::others(THIRDS).map(|image| (image, world(image))).collect();
        let free = bits(&upright, Image::own(THIRDS));
        for tick in 1..=24 {
            upright.run(1);
            for (image, other) in &mut others {
                let same = bits(other.run(1), Image::own(THIRDS)) == bits(&upright, *image);
                assert!(same, "{}, {image:?}, tick {tick}", preset.name());
            }
        }
        assert_ne!(bits(&upright, Image::own(THIRDS)), free, "nothing moved");
        // They do meet: what flies freely keeps its velocity along x.
        let (start, particles) = (flocks(Image::own(THIRDS), preset, 2, &[]).particles, upright.particles());
        let pushed = |i: &u32| particles.vx[*i as usize] != start.vx[particles.id[*i as usize] as usize];
        assert!(particles.in_id_order().iter().filter(|i| pushed(i)).count() >= 4, "{}", preset.name());
    }
}

#[test]
fn what_the_wind_carries_goes_mirrored_to_the_bit() {
    // Air on cells of 4 d, whose inverse is a number. It is looked up along x first, so not turned by a quarter; what the
    // particles give back to it is a sum.
    for preset in [Preset::Classic, Preset::Balanced] {
        let world = |image: Image| {
            let mut world = Simulation::of(flocks(image, preset, 1, &[Effect::AirFeedback]));
            let stroke = Stroke::dab(BrushShape::Disc, image.of(Vec2::new(20.0, 28.0)), 9.0);
            world.push(Intent::Blow { stroke, velocity: image.way(Vec2::new(40.0, 25.0)) });
            world
        };
        let mut upright = world(Image::own(THIRDS));
        let mirrored = Image::others(THIRDS).filter(|image| image.quarters % 2 == 0);
        let mut others: Vec<_> = mirrored.map(|image| (image, world(image))).collect();
        assert_eq!(others.len(), 3);
        for tick in 1..=24 {
            upright.run(1);
            for (image, other) in &mut others {
                let same = bits(other.run(1), Image::own(THIRDS)) == bits(&upright, *image);
                assert!(same, "{}, {image:?}, tick {tick}", preset.name());
            }
        }
        assert!(!upright.get::<AirGrid>().is_quiet(), "no wind blows");
    }
}

#[test]
fn a_drop_thrown_any_way_flies_the_same_way() {
    // Nothing to amplify rounding: a free drop holds for as long as it flies.
    let run = |image: Image| {
        let mut blueprint = image.square((Preset::Balanced, Preset::Balanced.quality()), GRAVITY);
        without(&mut blueprint, &[Effect::Air, Effect::Drag]);
        blueprint.water(image.of(Vec2::new(5.25, 10.5)), image.way(Vec2::new(30.0, 60.0)));
        let mut simulation = Simulation::of(blueprint);
        simulation.run(60);
        (simulation.particles().position(0), simulation.particles().velocity(0))
    };
    let (at, velocity) = run(Image::own(SIDE));
    assert!(at.distance(Vec2::new(5.25, 10.5)) > 10.0);
    for image in Image::others(SIDE) {
        let (other, way) = run(image);
        assert!(image.of(at).distance(other) < 1e-3, "{image:?}: {other} and {at}");
        assert!((image.way(velocity) - way).length() < 0.01, "{image:?}: {way} and {velocity}");
    }
}
