//! What can be changed of an element in the mixer. A new dial is a new row.

use crate::kernel::{
    element::{Category, Element},
    heat::units::{CELSIUS, COLDEST, HOTTEST},
};
use std::ops::RangeInclusive;

/// A number of an element that the player chooses.
pub struct Dial {
    /// What it is called.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// What more of it does.
    pub help: &'static str,
    /// What can be chosen, in the unit: within what an element may have.
    pub range: RangeInclusive<f32>,
    /// Where the logarithm begins that the dial follows; a dial without one is linear.
    pub smallest: Option<f64>,
    /// Whether an element has it.
    pub fits: fn(&Element) -> bool,
    /// What it stands at, in the unit.
    pub get: fn(&Element) -> f32,
    /// Turns it.
    pub set: fn(&mut Element, f32),
}

/// All of them, in the order of the panel.
pub static DIALS: [Dial; 12] = [
    Dial {
        name: "density",
        unit: "kg/m²",
        help: "what is denser sinks below what is lighter",
        range: 100.0..=20_000.0,
        smallest: Some(100.0),
        fits: |element| !element.fixed && !element.is_gas(),
        get: |element| element.density,
        set: set_density,
    },
    Dial {
        name: "density",
        unit: "kg/m²",
        help: "below 1.2 it rises in air, above it sinks",
        range: 0.05..=6.0,
        smallest: Some(0.05),
        fits: Element::is_gas,
        get: |element| element.density,
        set: set_density,
    },
    Dial {
        name: "viscosity",
        unit: "m²/s",
        help: "water has nearly none, honey .08; walls hold what is thick",
        range: 0.0..=5.0,
        smallest: Some(0.001),
        fits: |element| element.category == Category::Liquids,
        get: |element| element.viscosity,
        set: |element, value| element.viscosity = value,
    },
    Dial {
        name: "friction",
        unit: "°",
        help: "the slope up to which a heap of it stands",
        range: 5.0..=60.0,
        smallest: None,
        fits: |element| element.category == Category::Powders,
        get: |element| element.friction,
        set: |element, value| element.friction = value,
    },
    Dial {
        name: "cohesion",
        unit: "Pa",
        help: "grains that stick together stand as cliffs",
        range: 0.0..=20_000.0,
        smallest: Some(10.0),
        fits: |element| element.category == Category::Powders,
        get: |element| element.cohesion,
        set: |element, value| element.cohesion = value,
    },
    Dial {
        name: "diffusion",
        unit: "m²/s",
        help: "how soon a cloud of it spreads",
        range: 0.0..=1.0,
        smallest: Some(0.001),
        fits: Element::is_gas,
        get: |element| element.diffusion,
        set: |element, value| element.diffusion = value,
    },
    Dial {
        name: "drag",
        unit: "kg/m",
        help: "what has more is carried farther by the wind, and falls more slowly",
        range: 0.0..=100.0,
        smallest: Some(0.001),
        fits: |element| !element.fixed,
        get: |element| element.drag,
        set: |element, value| element.drag = value,
    },
    Dial {
        name: "strength",
        unit: "kPa/m",
        help: "the blast that a wall of it bears",
        range: 0.1..=10_000.0,
        smallest: Some(0.1),
        fits: |element| element.breaks.is_some(),
        get: |element| element.breaks.as_ref().map_or(0.0, |breaks| breaks.above / 1000.0),
        set: |element, value| element.breaks.iter_mut().for_each(|breaks| breaks.above = 1000.0 * value),
    },
    Dial {
        name: "burns for",
        unit: "s",
        help: "how long, on average, until it has burnt or decayed",
        range: 0.02..=1000.0,
        smallest: Some(0.02),
        fits: |element| element.decays.is_some(),
        get: |element| element.decays.as_ref().map_or(0.0, |decay| decay.seconds),
        set: |element, value| element.decays.iter_mut().for_each(|decay| decay.seconds = value),
    },
    Dial {
        name: "warmth",
        unit: "°C",
        help: "how warm it is when it comes into the world",
        range: COLDEST - CELSIUS..=HOTTEST - CELSIUS,
        smallest: None,
        fits: |_| true,
        get: |element| element.spawn - CELSIUS,
        set: |element, value| element.spawn = (value + CELSIUS).clamp(COLDEST, HOTTEST),
    },
    Dial {
        name: "heat capacity",
        unit: "MJ/m²K",
        help: "what holds more heat warms and cools more slowly",
        range: 0.2..=5.0,
        smallest: None,
        fits: |_| true,
        get: |element| element.capacity,
        set: |element, value| element.capacity = value,
    },
    Dial {
        name: "conductivity",
        unit: "W/mK",
        help: "what has more lets heat through sooner",
        range: 0.0..=500.0,
        smallest: Some(0.01),
        fits: |_| true,
        get: |element| element.conductivity,
        set: |element, value| element.conductivity = value,
    },
];

/// What is twice as dense is dragged twice as hard: it falls through air as fast as before.
fn set_density(element: &mut Element, density: f32) {
    element.drag = (element.drag * density / element.density).clamp(0.0, 1000.0);
    element.density = density;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    #[test]
    fn every_dial_turns_what_it_shows_and_its_ends_are_allowed() {
        let elements = scene::elements().unwrap();
        for dial in &DIALS {
            let mut fit = elements.iter().map(|(_, element)| element).filter(|element| (dial.fits)(element));
            let mut element = fit.next().unwrap_or_else(|| panic!("{} fits nothing", dial.name)).clone();
            for end in [*dial.range.start(), *dial.range.end()] {
                (dial.set)(&mut element, end);
                assert!(((dial.get)(&element) - end).abs() <= 1e-4 * end.abs(), "{} at {end}", dial.name);
                let outside =
                    element.numbers().into_iter().find(|number| !(number.min..=number.max).contains(&number.value));
                assert!(outside.is_none(), "{} at {end}: {outside:?}", dial.name);
            }
        }
    }

    #[test]
    fn an_element_has_each_dial_once_and_stands_within_it() {
        let elements = scene::elements().unwrap();
        for (_, element) in elements.iter() {
            let dials: Vec<&Dial> = DIALS.iter().filter(|dial| (dial.fits)(element)).collect();
            for (k, dial) in dials.iter().enumerate() {
                assert!(
                    dials[..k].iter().all(|other| other.name != dial.name),
                    "{}: {} twice",
                    element.name,
                    dial.name
                );
                let value = (dial.get)(element);
                assert!(dial.range.contains(&value), "{}: {} of {value}", element.name, dial.name);
            }
        }
    }
}
