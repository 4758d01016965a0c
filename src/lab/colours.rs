//! The colours of a world that every picture of it has: box, particles, rock and wind. Numbers only, so that the window
//! and the headless picture show the same. Colours are sRGB bytes.

use crate::kernel::{
    element::Element,
    params::{AirParams, Domain},
    random::{mix as scramble, share},
};
use glam::{IVec2, Vec2};

/// An sRGB colour.
pub type Rgb = [u8; 3];

/// Around the box.
pub const SURROUNDINGS: Rgb = [15, 18, 25];
/// The empty box at its top.
pub const BOX_TOP: Rgb = [52, 66, 92];
/// The empty box at its bottom.
pub const BOX_BOTTOM: Rgb = [27, 33, 48];
/// The frame of the box.
pub const FRAME: Rgb = [74, 86, 108];

/// Moving liquid whitens towards this.
const FOAM: Rgb = [226, 240, 250];
/// Deep liquid darkens towards this.
pub const ABYSS: Rgb = [4, 16, 46];
/// Most that depth takes of an element's own colour.
pub const DEPTH_SHADE: f32 = 0.75;

const WIND: Rgb = [72, 208, 190];

/// Below this nothing glows, K: the Draper point is 798 K.
pub const DULL: f32 = 780.0;
/// Colours of glowing matter by its temperature (K), after the locus of black bodies; brightness is compressed for the screen.
const GLOW: [(f32, [f32; 3]); 7] = [
    (DULL, [0.0, 0.0, 0.0]),
    (900.0, [0.28, 0.03, 0.0]),
    (1100.0, [0.68, 0.13, 0.02]),
    (1350.0, [0.98, 0.34, 0.05]),
    (1700.0, [1.0, 0.62, 0.18]),
    (2200.0, [1.0, 0.84, 0.48]),
    (3200.0, [1.0, 0.96, 0.86]),
];

/// The speeds that the colours are measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Speed of a fall through the whole box, d/s.
    pub fall: f32,
    /// A strong wind, d/s.
    pub wind: f32,
}

impl Reference {
    /// The references of a world.
    pub fn of(domain: &Domain, air: &AirParams) -> Self {
        let fall = (2.0 * domain.gravity.length() * domain.size.y).sqrt();
        Self { fall: if fall > 0.0 { fall } else { 100.0 }, wind: (0.2 * air.sound_speed).max(1.0) }
    }
}

/// Colour of a movable particle in its element's own colour: foam is lighter. `speed` is a share of [`Reference::fall`].
pub fn particle_colour(element: &Element, speed: f32) -> Rgb {
    mix(element.colour, FOAM, 0.6 * smoothstep(0.22, 0.95, speed))
}

/// A colour under `depth`, the share of [`DepthMap`](crate::lab::maps::DepthMap).
pub fn darken(colour: Rgb, depth: f32) -> Rgb {
    mix(colour, ABYSS, DEPTH_SHADE * depth)
}

/// Colour of the rock in `cell`: light at its surface, darker inside (`BurialMap` of the game). Neighbouring cells share broad
/// bands, each cell has its own grain.
pub fn rock_colour(element: &Element, cell: IVec2, id: u32, burial: f32) -> Rgb {
    let at = cell.as_vec2();
    let broad = value_noise(at * Vec2::new(0.045, 0.11), 1) - 0.5;
    let fine = value_noise(at * 0.31, 2) - 0.5;
    let grain = share(scramble(id ^ scramble(cell.x as u32 ^ (cell.y as u32).rotate_left(16)))) - 0.5;
    let light = (1.0 + 0.30 * broad + 0.20 * fine + 0.13 * grain) * (1.08 - 0.50 * smoothstep(0.0, 1.0, burial));
    element.colour.map(|channel| (f32::from(channel) * light).clamp(0.0, 255.0) as u8)
}

/// Colour and opacity (0 … 1) that moving air lays over the empty box.
pub fn wind_colour(reference: Reference, velocity: Vec2) -> (Rgb, f32) {
    let x = 2.0 * velocity.length() / reference.wind;
    (WIND, 0.55 * x / (1.0 + x))
}

/// Colour of the empty box at a height given as a share of the box.
pub fn box_colour(height: f32) -> Rgb {
    mix(BOX_BOTTOM, BOX_TOP, height)
}

/// Colour that matter of a temperature glows in, each channel 0 … 1.
pub fn incandescence(kelvin: f32) -> [f32; 3] {
    let Some(k) = GLOW.iter().rposition(|(from, _)| kelvin >= *from) else { return [0.0; 3] };
    let (from, low) = GLOW[k];
    let Some((to, high)) = GLOW.get(k + 1) else { return low };
    let t = (kelvin - from) / (to - from);
    std::array::from_fn(|c| low[c] + (high[c] - low[c]) * t)
}

/// `a` at 0, `b` at 1.
pub fn mix(a: Rgb, b: Rgb, t: f32) -> Rgb {
    let t = t.clamp(0.0, 1.0);
    std::array::from_fn(|k| (f32::from(a[k]) + (f32::from(b[k]) - f32::from(a[k])) * t + 0.5) as u8)
}

/// The colour at `t`, 0 … 1, of a scale of evenly spaced `stops`.
pub fn ramp(stops: &[Rgb], t: f32) -> Rgb {
    let last = stops.len() - 1;
    let at = t.clamp(0.0, 1.0) * last as f32;
    let below = (at as usize).min(last - 1);
    mix(stops[below], stops[below + 1], at - below as f32)
}

fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn value_noise(at: Vec2, seed: u32) -> f32 {
    let cell = at.floor();
    let t = at - cell;
    let t = t * t * (Vec2::splat(3.0) - 2.0 * t);
    let corner = |dx: i32, dy: i32| {
        let (x, y) = (cell.x as i32 + dx, cell.y as i32 + dy);
        share(scramble(x as u32 ^ scramble(y as u32 ^ scramble(seed))))
    };
    let low = corner(0, 0) * (1.0 - t.x) + corner(1, 0) * t.x;
    let high = corner(0, 1) * (1.0 - t.x) + corner(1, 1) * t.x;
    low * (1.0 - t.y) + high * t.y
}

#[cfg(test)]
mod tests {
    use super::*;

    fn water() -> Element {
        Element::plain("water", false)
    }

    fn brightness(rgb: Rgb) -> u32 {
        rgb.iter().map(|&c| u32::from(c)).sum()
    }

    #[test]
    fn water_at_rest_at_the_surface_has_the_colour_of_its_element() {
        assert_eq!(darken(particle_colour(&water(), 0.0), 0.0), water().colour);
    }

    #[test]
    fn fast_water_is_lighter_and_deep_water_is_darker() {
        let still = particle_colour(&water(), 0.0);
        let (fast, deep) = (particle_colour(&water(), 0.9), darken(still, 0.9));
        assert!(brightness(fast) > brightness(still) && brightness(deep) < brightness(still), "{fast:?} {deep:?}");
    }

    #[test]
    fn rock_varies_from_cell_to_cell_but_never_in_time() {
        let at = |x| rock_colour(&water(), IVec2::new(x, 7), x as u32, 0.5);
        assert_eq!(at(3), at(3));
        let distinct: std::collections::HashSet<_> = (0..20).map(at).collect();
        assert!(distinct.len() > 10, "only {} shades in 20 cells", distinct.len());
    }

    #[test]
    fn still_air_is_invisible() {
        let reference = Reference { fall: 100.0, wind: 50.0 };
        assert_eq!(wind_colour(reference, Vec2::ZERO).1, 0.0);
        assert!(wind_colour(reference, Vec2::X * 50.0).1 > 0.3);
    }
}
