//! What a world looks like: colours of particles, rock and air in each view. Numbers only, so that the window and the
//! headless picture show the same. Colours are sRGB bytes.

mod maps;
mod strain;

use crate::kernel::{
    element::Element,
    params::{AirParams, Domain},
};
use glam::{IVec2, Vec2};

pub use maps::{BurialMap, DepthMap};
pub use strain::{Limited, StrainMap};

/// An sRGB colour.
pub type Rgb = [u8; 3];

/// Around the box.
pub const SURROUNDINGS: Rgb = [11, 13, 18];
/// The empty box at its top.
pub const BOX_TOP: Rgb = [25, 31, 43];
/// The empty box at its bottom.
pub const BOX_BOTTOM: Rgb = [16, 19, 27];
/// The frame of the box.
pub const FRAME: Rgb = [74, 86, 108];

/// Moving liquid whitens towards this.
const FOAM: Rgb = [226, 240, 250];
/// Deep liquid darkens towards this.
pub const ABYSS: Rgb = [4, 16, 46];
/// Most that depth takes of an element's own colour.
pub const DEPTH_SHADE: f32 = 0.75;

const SPEED_STOPS: [Rgb; 6] =
    [[38, 46, 110], [36, 98, 178], [40, 172, 184], [134, 212, 122], [250, 216, 92], [246, 112, 58]];
const DENSITY_STOPS: [Rgb; 5] = [[46, 86, 190], [96, 148, 206], [206, 212, 218], [236, 140, 84], [206, 40, 48]];
const LOW_PRESSURE: Rgb = [86, 92, 232];
const HIGH_PRESSURE: Rgb = [240, 132, 60];
const WIND: Rgb = [72, 208, 190];

/// What the colours of the picture mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum View {
    /// Elements in their own colours.
    #[default]
    Elements,
    /// Speed of the particles.
    Speed,
    /// Density of the liquid against its rest density.
    Density,
    /// Pressure of the air.
    Pressure,
    /// Velocity of the air.
    Wind,
    /// Where limiters act, and how near to it the particles are.
    Stability,
}

impl View {
    /// All views in the order in which a key cycles through them.
    pub const ALL: [Self; 6] =
        [Self::Elements, Self::Speed, Self::Density, Self::Pressure, Self::Wind, Self::Stability];

    /// Name on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Elements => "Elements",
            Self::Speed => "Speed",
            Self::Density => "Density error",
            Self::Pressure => "Air pressure",
            Self::Wind => "Air velocity",
            Self::Stability => "Stability",
        }
    }

    /// The view after this one.
    pub fn next(self) -> Self {
        Self::ALL[(self as usize + 1) % Self::ALL.len()]
    }

    /// Whether the air is coloured.
    pub fn shows_air(self) -> bool {
        matches!(self, Self::Pressure | Self::Wind)
    }
}

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

/// What the colour of a particle is made from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Speed as a share of [`Reference::fall`].
    pub speed: f32,
    /// Depth under the surface as a share, 0 … 1 ([`DepthMap`]).
    pub depth: f32,
    /// ρ/ρ₀ − 1.
    pub density_error: f32,
    /// Share of the nearest limit, 0 … 1 ([`StrainMap`]).
    pub strain: f32,
}

/// Colour of a movable particle.
pub fn colour(view: View, element: &Element, sample: Sample) -> Rgb {
    match view {
        View::Elements | View::Pressure | View::Wind => {
            let foam = 0.6 * smoothstep(0.22, 0.95, sample.speed);
            let lit = mix(element.colour, FOAM, foam);
            mix(lit, ABYSS, DEPTH_SHADE * sample.depth)
        }
        View::Speed => ramp(&SPEED_STOPS, sample.speed * 1.25),
        View::Density => ramp(&DENSITY_STOPS, density_share(sample.density_error)),
        View::Stability => strain::strain_colour(sample.strain),
    }
}

/// Where a density error ρ/ρ₀ − 1 stands on the scale of its colours, 0 … 1: rest in the middle. A surface lacks half of
/// its neighbours by nature, so the scale reaches to −0.5; compression is an error, and 0.1 of it is the end.
pub fn density_share(error: f32) -> f32 {
    (0.5 + if error < 0.0 { error } else { 5.0 * error }).clamp(0.0, 1.0)
}

/// The error at a place of the scale of [`density_share`].
pub fn density_error(share: f32) -> f32 {
    if share < 0.5 { share - 0.5 } else { (share - 0.5) / 5.0 }
}

/// Colour of the rock in `cell`: light at its surface, darker inside ([`BurialMap`]). Neighbouring cells share broad
/// bands, each cell has its own grain.
pub fn rock_colour(element: &Element, cell: IVec2, id: u32, burial: f32) -> Rgb {
    let at = cell.as_vec2();
    let broad = value_noise(at * Vec2::new(0.045, 0.11), 1) - 0.5;
    let fine = value_noise(at * 0.31, 2) - 0.5;
    let grain = unit(hash(id, cell.x as u32 ^ (cell.y as u32).rotate_left(16))) - 0.5;
    let light = (1.0 + 0.30 * broad + 0.20 * fine + 0.13 * grain) * (1.08 - 0.50 * smoothstep(0.0, 1.0, burial));
    element.colour.map(|channel| (f32::from(channel) * light).clamp(0.0, 255.0) as u8)
}

/// Colour and opacity (0 … 1) that the air lays over the empty box.
pub fn air_colour(view: View, reference: Reference, pressure: f32, velocity: Vec2) -> (Rgb, f32) {
    match view {
        View::Pressure => {
            let x = (pressure - 1.0) / 0.03;
            let strength = x.abs() / (1.0 + x.abs());
            (if x < 0.0 { LOW_PRESSURE } else { HIGH_PRESSURE }, 0.85 * strength)
        }
        View::Wind => {
            let x = 2.0 * velocity.length() / reference.wind;
            (WIND, 0.55 * x / (1.0 + x))
        }
        View::Elements | View::Speed | View::Density | View::Stability => ([0; 3], 0.0),
    }
}

/// Colour of the empty box at a height given as a share of the box.
pub fn box_colour(height: f32) -> Rgb {
    mix(BOX_BOTTOM, BOX_TOP, height)
}

/// `a` at 0, `b` at 1.
pub fn mix(a: Rgb, b: Rgb, t: f32) -> Rgb {
    let t = t.clamp(0.0, 1.0);
    std::array::from_fn(|k| (f32::from(a[k]) + (f32::from(b[k]) - f32::from(a[k])) * t + 0.5) as u8)
}

pub(super) fn ramp(stops: &[Rgb], t: f32) -> Rgb {
    let last = stops.len() - 1;
    let at = t.clamp(0.0, 1.0) * last as f32;
    let below = (at as usize).min(last - 1);
    mix(stops[below], stops[below + 1], at - below as f32)
}

fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn hash(a: u32, b: u32) -> u32 {
    let mut h = a.wrapping_mul(0x9E37_79B1) ^ b.wrapping_mul(0x85EB_CA77);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    h ^ (h >> 15)
}

fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1 << 24) as f32
}

fn value_noise(at: Vec2, seed: u32) -> f32 {
    let cell = at.floor();
    let t = at - cell;
    let t = t * t * (Vec2::splat(3.0) - 2.0 * t);
    let corner = |dx: i32, dy: i32| {
        let (x, y) = (cell.x as i32 + dx, cell.y as i32 + dy);
        unit(hash((x as u32).wrapping_add(seed.wrapping_mul(0x0101_0101)), y as u32))
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
        assert_eq!(colour(View::Elements, &water(), Sample::default()), water().colour);
    }

    #[test]
    fn fast_water_is_lighter_and_deep_water_is_darker() {
        let still = brightness(colour(View::Elements, &water(), Sample::default()));
        let fast = brightness(colour(View::Elements, &water(), Sample { speed: 0.9, ..Sample::default() }));
        let deep = brightness(colour(View::Elements, &water(), Sample { depth: 0.9, ..Sample::default() }));
        assert!(fast > still && deep < still, "{fast} > {still} > {deep}");
    }

    #[test]
    fn density_error_is_red_above_blue_below_and_neutral_at_rest() {
        let at = |density_error| colour(View::Density, &water(), Sample { density_error, ..Sample::default() });
        let (low, rest, high) = (at(-0.5), at(0.0), at(0.1));
        assert!(high[0] > high[2] + 80, "compressed liquid must look red, is {high:?}");
        assert!(low[2] > low[0] + 80, "stretched liquid must look blue, is {low:?}");
        assert!(rest.iter().max().unwrap() - rest.iter().min().unwrap() < 24, "rest must be neutral, is {rest:?}");
    }

    #[test]
    fn the_scale_of_density_errors_can_be_read_backwards() {
        for error in [-0.4, -0.01, 0.0, 0.03, 0.1] {
            assert!((density_error(density_share(error)) - error).abs() < 1e-6);
        }
    }

    #[test]
    fn whoever_is_at_a_limit_is_red_and_who_is_far_from_it_is_not() {
        let at = |strain| colour(View::Stability, &water(), Sample { strain, ..Sample::default() });
        let (calm, acted) = (at(0.0), at(1.0));
        assert!(acted[0] > 230 && acted[0] > 2 * acted[1] && calm[0] < calm[2], "{calm:?} {acted:?}");
    }

    #[test]
    fn rock_varies_from_cell_to_cell_but_never_in_time() {
        let at = |x| rock_colour(&water(), IVec2::new(x, 7), x as u32, 0.5);
        assert_eq!(at(3), at(3));
        let distinct: std::collections::HashSet<_> = (0..20).map(at).collect();
        assert!(distinct.len() > 10, "only {} shades in 20 cells", distinct.len());
    }

    #[test]
    fn still_air_is_invisible_and_pressure_has_two_colours() {
        let reference = Reference { fall: 100.0, wind: 50.0 };
        assert_eq!(air_colour(View::Pressure, reference, 1.0, Vec2::ZERO).1, 0.0);
        assert_eq!(air_colour(View::Wind, reference, 1.3, Vec2::ZERO).1, 0.0);
        let (high, low) = (
            air_colour(View::Pressure, reference, 1.2, Vec2::ZERO),
            air_colour(View::Pressure, reference, 0.8, Vec2::ZERO),
        );
        assert!(high.0 != low.0 && high.1 > 0.3 && low.1 > 0.3);
    }
}
