//! The one table of views. Keys, menus, help and the picture follow from it.

use crate::{
    game::views::{fire::fire_colour, strain::strain_colour},
    kernel::{element::Element, heat::units::ROOM, particles::Particles},
    lab::colours::{Reference, Rgb, particle_colour, ramp, wind_colour},
};
use bevy::prelude::{KeyCode, Resource};
use glam::Vec2;
use std::fmt;

/// Every view, in the order of the menu and of the key that goes through them. A new one is a new row.
pub static VIEWS: [&View; 8] = [&ELEMENTS, &SPEED, &DENSITY, &PRESSURE, &WIND, &STABILITY, &TEMPERATURE, &BURNING];

/// Elements in their own colours.
pub static ELEMENTS: View = View {
    name: "Elements",
    key: KeyCode::Digit1,
    quantity: Quantity::Of(speeds),
    colour: particle_colour,
    air: Layer::Nothing,
    streaks: Streaks::Tracers,
    shaded: true,
    ..PLAIN
};

static SPEED: View = View {
    name: "Speed",
    key: KeyCode::Digit2,
    quantity: Quantity::Of(speeds),
    colour: |_, speed| ramp(&SPEED_STOPS, speed * 1.25),
    legend: &[(0.0, "at rest"), (0.8, "a fall through the box")],
    ..PLAIN
};

static DENSITY: View = View {
    name: "Density error",
    key: KeyCode::Digit3,
    quantity: Quantity::Density,
    colour: |_, share| ramp(&DENSITY_STOPS, share),
    legend: &[(0.0, "−50 %"), (0.5, "0"), (1.0, "+10 %")],
    ..PLAIN
};

/// Pressure of the air.
pub static PRESSURE: View =
    View { name: "Air pressure", key: KeyCode::Digit4, air: Layer::Air(pressure_colour), ..PLAIN };

static WIND: View = View {
    name: "Air velocity",
    key: KeyCode::Digit5,
    air: Layer::Air(|reference, _, velocity| wind_colour(reference, velocity)),
    streaks: Streaks::Arrows,
    ..PLAIN
};

/// Where limiters act, and how near to it the particles are.
pub static STABILITY: View = View {
    name: "Stability",
    key: KeyCode::Digit6,
    quantity: Quantity::Strain,
    colour: |_, share| strain_colour(share),
    legend: &[(0.0, "far from a limit"), (1.0, "at a limit")],
    air: Layer::Strain,
    ..PLAIN
};

/// How warm matter is, rock as well, and the air behind it where it is not as warm as the room.
pub static TEMPERATURE: View = View {
    name: "Temperature",
    key: KeyCode::Digit7,
    quantity: Quantity::Temperature,
    colour: |_, share| ramp(&TEMPERATURE_STOPS, share),
    legend: &[(0.0, "−200"), (0.25, "0"), (0.5, "100"), (0.75, "700"), (1.0, "1,700 °C")],
    air: Layer::Warmth(warmth_colour),
    ..PLAIN
};

/// What burns, what can burn, and what is hot enough to light it, rock as well.
pub static BURNING: View = View {
    name: "Burning",
    key: KeyCode::Digit8,
    quantity: Quantity::Fire,
    colour: |_, share| fire_colour(share),
    legend: &[(0.125, "can't burn"), (0.375, "can burn"), (0.625, "hot"), (0.875, "burns")],
    ..PLAIN
};

/// What most views have in common.
const PLAIN: View = View {
    name: "",
    key: KeyCode::Digit0,
    quantity: Quantity::Of(speeds),
    colour: particle_colour,
    air: Layer::Nothing,
    streaks: Streaks::None,
    shaded: false,
    legend: &[],
};

/// A row of the table: what the colours of the picture mean.
pub struct View {
    /// Name in menus.
    pub name: &'static str,
    /// The key that shows it, pressed with Shift.
    pub key: KeyCode,
    /// What the particles are coloured by.
    pub quantity: Quantity,
    /// Colour of a movable particle for a value of the quantity.
    pub colour: fn(&Element, f32) -> Rgb,
    /// What lies over the empty box.
    pub air: Layer,
    /// Which streaks are drawn.
    pub streaks: Streaks,
    /// Whether the liquid is shaded by its depth and by light.
    pub shaded: bool,
    /// What stands below the scale of its colours, at which share of it; none shows no scale.
    pub legend: &'static [(f32, &'static str)],
}

/// What a particle's colour stands for, as a share of a scale, 0 … 1.
pub enum Quantity {
    /// What this finds for each particle.
    Of(fn(&Particles, Reference, &mut Vec<f32>)),
    /// Density against its rest density, as the solver has it ([`density_share`]).
    Density,
    /// Share of the nearest limit, from the map of the limiters.
    Strain,
    /// Temperature, of rock as well ([`temperature_share`]).
    Temperature,
    /// What it is to a fire, of rock as well ([`Fire::share`](super::fire::Fire::share)).
    Fire,
}

/// What lies over the empty box.
pub enum Layer {
    /// The box alone is seen.
    Nothing,
    /// Colour and opacity (0 … 1) of the air from its pressure and velocity.
    Air(fn(Reference, f32, Vec2) -> (Rgb, f32)),
    /// Colour and opacity (0 … 1) of the air from its temperature, K; nothing where all of it is as warm as the room.
    Warmth(fn(f32) -> (Rgb, f32)),
    /// The glow of the places where limiters acted.
    Strain,
}

/// Lines that show the wind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Streaks {
    /// None.
    None,
    /// Tracers that drift with the wind, behind the liquid.
    Tracers,
    /// Arrows on a lattice, over the liquid.
    Arrows,
}

impl View {
    /// Whether the air is what it shows.
    pub fn shows_air(&self) -> bool {
        matches!(self.air, Layer::Air(_))
    }

    /// The view after this one.
    pub fn next(&self) -> &'static Self {
        let place = VIEWS.iter().position(|view| *view == self).unwrap_or(0);
        VIEWS[(place + 1) % VIEWS.len()]
    }
}

/// Two rows are the same view if they have the same name.
impl PartialEq for View {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl fmt::Debug for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// The view that is shown.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Shown(pub &'static View);

impl Default for Shown {
    fn default() -> Self {
        Self(&ELEMENTS)
    }
}

const SPEED_STOPS: [Rgb; 6] =
    [[38, 46, 110], [36, 98, 178], [40, 172, 184], [134, 212, 122], [250, 216, 92], [255, 246, 208]];
const DENSITY_STOPS: [Rgb; 5] = [[46, 86, 190], [96, 148, 206], [206, 212, 218], [236, 140, 84], [206, 40, 48]];
/// Lighter all the way: blue up to the freezing point, teal and green to the boiling point, then orange, and white as hot iron.
const TEMPERATURE_STOPS: [Rgb; 9] = [
    [38, 32, 110],
    [44, 66, 170],
    [52, 110, 214],
    [30, 140, 150],
    [70, 165, 110],
    [176, 160, 60],
    [235, 140, 60],
    [255, 176, 120],
    [255, 246, 232],
];
/// Opacity of air that is far from the room's temperature, and how far it is from it at half of that, K.
const HAZE: f32 = 0.8;
const HALF_HAZE: f32 = 40.0;
const LOW_PRESSURE: Rgb = [86, 92, 232];
const HIGH_PRESSURE: Rgb = [240, 132, 60];

/// Speeds as shares of a fall through the whole box.
fn speeds(particles: &Particles, reference: Reference, out: &mut Vec<f32>) {
    let scale = 1.0 / reference.fall;
    out.clear();
    out.extend(particles.vx.iter().zip(&particles.vy).map(|(vx, vy)| (vx * vx + vy * vy).sqrt() * scale));
}

/// Where a density error ρ/ρ₀ − 1 stands on the scale of its colours, 0 … 1: rest in the middle. A surface lacks half of
/// its neighbours by nature, so the scale reaches to −0.5; compression is an error, and 0.1 of it is the end.
pub fn density_share(error: f32) -> f32 {
    (0.5 + if error < 0.0 { error } else { 5.0 * error }).clamp(0.0, 1.0)
}

/// Where a temperature (K) stands on the scale of its colours, 0 … 1: as far from freezing to boiling as from there to 1,000 K and
/// on to 2,000 K.
pub fn temperature_share(kelvin: f32) -> f32 {
    let marks = [73.0, 273.0, 373.0, 1000.0, 2000.0];
    let below = marks[1..4].iter().filter(|mark| kelvin >= **mark).count();
    let (low, high) = (marks[below], marks[below + 1]);
    (0.25 * (below as f32 + (kelvin - low) / (high - low))).clamp(0.0, 1.0)
}

/// Air is coloured as matter of its temperature (K) is, and the fainter the nearer it is to the room's.
fn warmth_colour(kelvin: f32) -> (Rgb, f32) {
    let apart = (kelvin - ROOM).abs();
    (ramp(&TEMPERATURE_STOPS, temperature_share(kelvin)), HAZE * apart / (apart + HALF_HAZE))
}

fn pressure_colour(_: Reference, pressure: f32, _: Vec2) -> (Rgb, f32) {
    let x = (pressure - 1.0) / 0.03;
    let strength = x.abs() / (1.0 + x.abs());
    (if x < 0.0 { LOW_PRESSURE } else { HIGH_PRESSURE }, 0.85 * strength)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::vision::{KINDS, oklab};

    fn water() -> Element {
        Element::plain("water", false)
    }

    #[test]
    fn each_view_has_a_name_and_a_key_of_its_own_and_the_next_goes_round() {
        for (k, view) in VIEWS.iter().enumerate() {
            assert!(!view.name.is_empty());
            assert!(VIEWS[k + 1..].iter().all(|other| view != other && view.key != other.key), "{view:?} stands twice");
            assert_eq!(view.next(), VIEWS[(k + 1) % VIEWS.len()]);
        }
    }

    #[test]
    fn density_error_is_red_above_blue_below_and_neutral_at_rest() {
        let at = |error| (DENSITY.colour)(&water(), density_share(error));
        let (low, rest, high) = (at(-0.5), at(0.0), at(0.1));
        assert!(high[0] > high[2] + 80, "compressed liquid must look red, is {high:?}");
        assert!(low[2] > low[0] + 80, "stretched liquid must look blue, is {low:?}");
        assert!(rest.iter().max().unwrap() - rest.iter().min().unwrap() < 24, "rest must be neutral, is {rest:?}");
    }

    #[test]
    fn the_scale_of_temperature_rises_and_has_its_marks_where_the_legend_says() {
        for ((share, _), kelvin) in TEMPERATURE.legend.iter().zip([73.0, 273.0, 373.0, 1000.0, 2000.0]) {
            assert!((temperature_share(kelvin) - share).abs() < 1e-6, "{kelvin} K");
        }
        let scale: Vec<f32> = (0..50).map(|k| temperature_share(80.0 * k as f32)).collect();
        assert!(scale.is_sorted() && scale[0] == 0.0 && scale[49] == 1.0, "{scale:?}");
    }

    #[test]
    fn scales_of_numbers_get_lighter_all_the_way_or_from_both_ends_to_the_middle() {
        let lightness = |view: &View, share: f32| oklab((view.colour)(&water(), share), &KINDS[0].1)[0];
        let falls = |view: &View, from: f32, to: f32| {
            let scale: Vec<f32> = (0..=64).map(|k| lightness(view, from + (to - from) * k as f32 / 64.0)).collect();
            scale.windows(2).map(|pair| pair[0] - pair[1]).fold(0.0, f32::max)
        };
        // Less than a step of eight bits is rounding.
        for (view, end) in [(&SPEED, 0.8), (&TEMPERATURE, 1.0), (&STABILITY, 1.0)] {
            assert!(falls(view, 0.0, end) < 0.004, "{view:?} gets darker");
        }
        assert!(falls(&DENSITY, 0.0, 0.5) < 0.004 && falls(&DENSITY, 1.0, 0.5) < 0.004);
        for view in [&SPEED, &DENSITY, &STABILITY, &TEMPERATURE, &BURNING] {
            assert!(view.legend.len() > 1, "{view:?} does not say what its colours mean");
        }
    }

    #[test]
    fn a_particle_at_a_limit_is_red_and_one_far_from_it_is_not() {
        let at = |strain| (STABILITY.colour)(&water(), strain);
        let (calm, acted) = (at(0.0), at(1.0));
        assert!(acted[0] > 230 && acted[0] > 2 * acted[1] && calm[0] < calm[2], "{calm:?} {acted:?}");
    }

    #[test]
    fn air_has_the_colours_of_matter_as_warm_and_the_fainter_the_nearer_it_is_to_the_room() {
        assert_eq!(warmth_colour(ROOM).1, 0.0, "the room's own air is not seen");
        for kelvin in [77.0, 250.0, 330.0, 600.0, 1500.0] {
            let (colour, opacity) = warmth_colour(kelvin);
            assert_eq!(colour, (TEMPERATURE.colour)(&water(), temperature_share(kelvin)), "{kelvin} K");
            assert!((0.3..0.9).contains(&opacity), "{opacity} at {kelvin} K");
        }
        assert!(warmth_colour(300.0).1 < warmth_colour(320.0).1 && warmth_colour(280.0).1 < warmth_colour(260.0).1);
    }

    #[test]
    fn still_air_is_invisible_and_pressure_has_two_colours() {
        let reference = Reference { fall: 100.0, wind: 50.0 };
        let at = |pressure| pressure_colour(reference, pressure, Vec2::ZERO);
        assert_eq!(at(1.0).1, 0.0);
        let (high, low) = (at(1.2), at(0.8));
        assert!(high.0 != low.0 && high.1 > 0.3 && low.1 > 0.3);
    }
}
