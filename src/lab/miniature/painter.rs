//! Draws a world of few particles as if it had many: liquids and heaps with smooth outlines, gases as clouds, light around
//! what glows. All in the elements' own colours.

use crate::{
    kernel::element::{Category, Element},
    lab::{
        colours::{self, Reference, incandescence},
        maps::DepthMap,
        miniature::{
            frame::{Frame, HEIGHT, WIDTH, light},
            layer::Layer,
            rock::RockPicture,
            shine::Shine,
        },
    },
    scene::blueprint::Blueprint,
    sim::state::{AirGrid, HeatCurves, ParticleStore, Rock, Setup},
};
use bevy::{ecs::world::World, math::ops};
use glam::Vec2;

/// How far a particle of a liquid or a heap reaches, d.
const BODY: f32 = 1.5;
/// How far a lump of gas reaches, d.
const CLOUD: f32 = 2.6;
/// Weights between which the outline of a body lies.
const OUTLINE: [f32; 2] = [0.22, 0.42];
/// A grain is lighter or darker than its element by up to this share.
const GRAIN: f32 = 0.16;
/// What a surface has more of light than what lies below it.
const RIM: f32 = 0.22;
/// Strength of the wind's tint.
const WIND: f32 = 0.3;
/// Edge of a square of pixels with one tint of wind.
const TINT: usize = 4;
/// Light of a lump that glows white, by d² on the picture.
const GAIN: f32 = 1.0;

/// The buffers of a picture.
pub(super) struct Painter {
    frame: Frame,
    bodies: Layer,
    clouds: Layer,
    rock: RockPicture,
    shine: Shine,
    depths: DepthMap,
    /// Light and strength of the wind's tint by square.
    tints: Vec<([f32; 3], f32)>,
    picture: Vec<u8>,
}

impl Painter {
    /// For pictures of the world that a blueprint begins.
    pub(super) fn new(blueprint: &Blueprint) -> Self {
        Self {
            frame: Frame::new(blueprint.domain.size),
            bodies: Layer::new(WIDTH, HEIGHT),
            clouds: Layer::new(WIDTH, HEIGHT),
            rock: RockPicture::new(WIDTH * HEIGHT),
            shine: Shine::new(WIDTH, HEIGHT),
            depths: DepthMap::default(),
            tints: Vec::new(),
            picture: vec![255; 4 * WIDTH * HEIGHT],
        }
    }

    /// Draws the world.
    pub(super) fn draw(&mut self, world: &World) -> &[u8] {
        let setup = world.resource::<Setup>();
        let rock = world.resource::<Rock>();
        self.rock.follow(rock, setup.elements(), &self.frame);
        self.shine.clear();
        self.take_particles(world, setup);
        let curves = world.resource::<HeatCurves>();
        if !rock.heats().is_empty() {
            for (cell, element, _) in rock.iter() {
                let glow = incandescence(curves.curve(element).temperature(rock.heat(cell)));
                self.light_up(cell.as_vec2() + 0.5, glow);
            }
        }
        self.shine.spread();
        self.take_wind(world.resource::<AirGrid>(), setup);
        self.compose();
        &self.picture
    }

    fn light_up(&mut self, place: Vec2, glow: [f32; 3]) {
        if glow[0] > 0.0 {
            let area = GAIN * self.frame.pixels() * self.frame.pixels() / 64.0;
            self.shine.add(self.frame.pixel(place), glow.map(|light| area * light));
        }
    }

    fn take_particles(&mut self, world: &World, setup: &Setup) {
        let particles = world.resource::<ParticleStore>();
        let curves = world.resource::<HeatCurves>();
        let reference = Reference::of(&setup.blueprint.domain, &setup.blueprint.air);
        self.bodies.clear();
        self.clouds.clear();
        self.depths.measure(self.frame.size(), (0..particles.len()).map(|i| (particles.position(i), 1)));
        for i in 0..particles.len() {
            let (id, place) = (particles.element[i], particles.position(i));
            let element = setup.elements().get(id);
            let speed = particles.velocity(i).length() / reference.fall;
            let glow = if particles.has_heat() {
                incandescence(curves.curve(id).temperature(particles.heat_of(i)))
            } else {
                [0.0; 3]
            };
            let own = own_light(element, particles.id[i], speed, self.depths.at(place), glow);
            let at = self.frame.pixel(place);
            match element.category {
                Category::Gases => self.clouds.add(at, CLOUD * self.frame.pixels(), CLOUD, own),
                _ => self.bodies.add(at, BODY * self.frame.pixels(), BODY, own),
            }
            self.light_up(place, glow);
        }
    }

    /// One tint for each square of pixels; none where the air rests.
    fn take_wind(&mut self, air: &AirGrid, setup: &Setup) {
        self.tints.clear();
        if air.is_quiet() {
            return;
        }
        let reference = Reference::of(&setup.blueprint.domain, &setup.blueprint.air);
        for y in (0..HEIGHT).step_by(TINT) {
            for x in (0..WIDTH).step_by(TINT) {
                let place = self.frame.place((y + TINT / 2) * WIDTH + x + TINT / 2);
                let (tint, strength) = colours::wind_colour(reference, air.sample_velocity(place));
                self.tints.push((light(tint), strength));
            }
        }
    }

    fn compose(&mut self) {
        for y in 0..HEIGHT {
            let height = self.frame.place(y * WIDTH).y / self.frame.size().y;
            let sky = light(colours::box_colour(height.clamp(0.0, 1.0)));
            for x in 0..WIDTH {
                let seen = self.matter(x, y, sky);
                let lit = self.lit(x, y, seen);
                for (out, light) in self.picture[4 * (y * WIDTH + x)..][..3].iter_mut().zip(lit) {
                    *out = (light.clamp(0.0, 1.0).sqrt() * 255.0 + 0.5) as u8;
                }
            }
        }
    }

    /// What is seen at a pixel without light from elsewhere.
    fn matter(&self, x: usize, y: usize, sky: [f32; 3]) -> [f32; 3] {
        let (pixel, mut seen) = (y * WIDTH + x, sky);
        let (opacity, rock) = self.rock.at(pixel);
        if opacity >= 1.0 {
            return rock;
        }
        if let Some((tint, strength)) = self.tints.get(y / TINT * (WIDTH / TINT) + x / TINT) {
            lay(&mut seen, *tint, WIND * strength);
        }
        let (weight, cloud) = self.clouds.at(pixel);
        if weight > 0.0 {
            lay(&mut seen, cloud, 0.85 * (1.0 - ops::exp(-1.4 * weight)));
        }
        let (weight, body) = self.bodies.at(pixel);
        if weight > OUTLINE[0] {
            let above = if y < 3 { 0.0 } else { self.bodies.weight(pixel - 3 * WIDTH) };
            let rim = RIM * (1.0 - above.min(1.0)) * weight.min(1.0);
            lay(&mut seen, body.map(|light| light + rim * (1.0 - light)), smoothstep(OUTLINE, weight));
        }
        lay(&mut seen, rock, opacity);
        seen
    }

    /// The same in the light of what glows, which counts more where there is something that it falls on. Beyond the box it is
    /// dim.
    fn lit(&self, x: usize, y: usize, seen: [f32; 3]) -> [f32; 3] {
        let shine = self.shine.at(x, y);
        let mut lit: [f32; 3] = std::array::from_fn(|k| seen[k] * (1.0 + 1.5 * shine[k]) + 0.35 * shine[k]);
        if !self.frame.holds(self.frame.place(y * WIDTH + x)) {
            lay(&mut lit, light(colours::SURROUNDINGS), 0.75);
        }
        lit
    }
}

/// Light of a particle: foam where it is fast, darker below others, a grain by its own shade; what glows shines by itself.
fn own_light(element: &Element, id: u32, speed: f32, depth: f32, glow: [f32; 3]) -> [f32; 3] {
    let own = match element.category {
        Category::Powders => {
            let shade = 1.0 + GRAIN * ((id.wrapping_mul(0x9E37_79B1) >> 16) as f32 / 32_768.0 - 1.0);
            light(element.colour).map(|light| light * shade)
        }
        Category::Liquids => light(colours::darken(colours::particle_colour(element, speed), 1.3 * depth)),
        _ => light(element.colour),
    };
    std::array::from_fn(|k| (own[k] + glow[k]).min(1.2))
}

/// Lays a light over another.
fn lay(under: &mut [f32; 3], over: [f32; 3], opacity: f32) {
    for (under, over) in under.iter_mut().zip(over) {
        *under += (over - *under) * opacity;
    }
}

fn smoothstep([from, to]: [f32; 2], x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{self, effects::EffectModes},
        sim::{simulation::Simulation, workers::Workers},
    };
    use std::sync::Arc;

    /// A picture of a scene of 16 m × 10 m with such contents, at its start: 16 pixels a metre.
    fn draw(contents: &str) -> impl Fn(f32, f32) -> [u8; 3] {
        let text = format!("(title: \"x\", spacing: 0.2, size: (16, 10), contents: [{contents}])");
        let blueprint = scene::from_text("test", text).and_then(|file| file.build(&[], None, &EffectModes::new()));
        let blueprint = Arc::new(blueprint.expect("it is valid"));
        let simulation = Simulation::new(blueprint.clone(), Workers::single());
        let picture = Painter::new(&blueprint).draw(simulation.world()).to_vec();
        move |x, y| {
            let pixel = (HEIGHT - 1 - (16.0 * y) as usize) * WIDTH + (16.0 * x) as usize;
            std::array::from_fn(|k| picture[4 * pixel + k])
        }
    }

    fn brightness(rgb: [u8; 3]) -> u32 {
        rgb.iter().map(|&c| u32::from(c)).sum()
    }

    #[test]
    fn a_body_is_filled_in_its_colour_without_gaps_and_the_air_around_it_is_not() {
        let empty = draw("");
        let water = draw("(element: \"water\", shape: Rect(min: (4, 0), max: (12, 6)))");
        for x in 0..60 {
            let [r, g, b] = water(5.0 + 0.1 * x as f32, 3.0);
            assert!(b > 100 && b > g && g > r, "{r} {g} {b} at {x}");
        }
        assert_eq!(water(2.0, 3.0), empty(2.0, 3.0));
        assert!(brightness(water(8.0, 5.9)) > brightness(water(8.0, 1.0)), "the surface is lighter than what is deep");
    }

    #[test]
    fn what_glows_lights_what_is_near() {
        let ember = draw("(element: \"ember\", shape: Disc(centre: (8, 5), radius: 0.8))");
        let coal = draw("(element: \"coal\", shape: Disc(centre: (8, 5), radius: 0.8))");
        let near = |picture: &dyn Fn(f32, f32) -> [u8; 3]| u32::from(picture(9.4, 5.0)[0]);
        assert!(near(&ember) > near(&coal) + 10, "{} {}", near(&ember), near(&coal));
        assert_eq!(ember(1.0, 9.0), coal(1.0, 9.0), "far away it is dark");
    }

    #[test]
    fn rock_has_an_outline_and_gases_are_veils() {
        let empty = draw("");
        let rock = draw("(element: \"rock\", shape: Rect(min: (4, 0), max: (8, 4)))");
        assert_ne!(rock(6.0, 2.0), empty(6.0, 2.0));
        assert_eq!(rock(9.0, 2.0), empty(9.0, 2.0));
        let steam = draw("(element: \"steam\", shape: Disc(centre: (8, 5), radius: 1.5))");
        let [veil, air] = [brightness(steam(8.0, 5.0)), brightness(empty(8.0, 5.0))];
        assert!(veil > air + 60 && veil < 700, "{veil} over {air}");
    }
}
