//! What is on fire, what can be, and what lights it. Found from the state as it stands, and only while somebody looks.

use crate::{
    kernel::{
        decay::table::{DecayTable, OPEN},
        element::{ElementId, ElementTable},
        heat::{Exposure, table::HeatTable},
        particles::Particles,
        solids::{Solids, centre},
    },
    lab::colours::Rgb,
};
use glam::{IVec2, Vec2};

/// Colours of the kinds of [`Fire`]. Blue beside orange and yellow is told apart by every kind of colour vision, and each is lighter
/// than the one before.
const COLOURS: [Rgb; 4] = [[70, 74, 84], [40, 116, 214], [236, 128, 48], [250, 232, 96]];

/// What a lump is to a fire, in the order of the scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fire {
    /// It can't burn.
    Never,
    /// It can burn, but is too cold or has no air.
    Fuel,
    /// It can't burn, but is so hot that it lights what can.
    Hot,
    /// It burns.
    Burns,
}

impl Fire {
    /// Its place on the scale of colours, 0 … 1.
    pub fn share(self) -> f32 {
        (f32::from(self as u8) + 0.5) / COLOURS.len() as f32
    }
}

/// Colour of a place on the scale, 0 … 1.
pub fn fire_colour(share: f32) -> Rgb {
    COLOURS[((share * COLOURS.len() as f32) as usize).min(COLOURS.len() - 1)]
}

/// What the matter of a world is to a fire.
pub struct Burning<'a> {
    /// Movable particles.
    pub particles: &'a Particles,
    /// Rock.
    pub rock: &'a Solids,
    /// What they are made of.
    pub elements: &'a ElementTable,
    /// How warm they are by their heat.
    pub curves: &'a HeatTable,
    /// What becomes of them in time.
    pub decays: &'a DecayTable,
    /// Temperature from which on something lights what lights first, K.
    pub lights: Option<f32>,
    /// What stands in the air, gathered from these particles.
    pub exposure: &'a Exposure,
}

impl Burning<'_> {
    /// That of a particle.
    pub fn of_particle(&self, i: usize) -> Fire {
        self.of(self.particles.element[i], self.particles.heat_of(i), self.particles.position(i))
    }

    /// That of the rock in a cell.
    pub fn of_rock(&self, cell: IVec2, element: ElementId) -> Fire {
        self.of(element, self.rock.heat(cell), centre(cell))
    }

    fn of(&self, element: ElementId, heat: i32, at: Vec2) -> Fire {
        let kelvin = self.curves.curve(element).temperature(heat);
        let Some(ignition) = self.decays.ignition(element) else {
            return if self.lights.is_some_and(|lights| kelvin >= lights) { Fire::Hot } else { Fire::Never };
        };
        let needs_air = self.decays.of(element).is_none_or(|decay| decay.needs_air);
        let matter = (self.particles, self.rock, self.elements);
        let burns = kelvin >= ignition && (!needs_air || self.exposure.of(matter, element, at) >= OPEN);
        if burns { Fire::Burns } else { Fire::Fuel }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{game::views::table::BURNING, scene::elements};

    /// Relative luminance, 0 … 1 (WCAG 2.1; a square is near enough to its curve).
    fn luminance(colour: Rgb) -> f32 {
        let [r, g, b] = colour.map(|channel| (f32::from(channel) / 255.0) * (f32::from(channel) / 255.0));
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn each_kind_has_its_colour_and_they_are_told_apart_by_lightness_alone() {
        let kinds = [Fire::Never, Fire::Fuel, Fire::Hot, Fire::Burns];
        let shares: Vec<f32> = BURNING.legend.iter().map(|(share, _)| *share).collect();
        assert_eq!(kinds.map(Fire::share).to_vec(), shares, "the legend's marks are elsewhere");
        let lightness = kinds.map(|kind| luminance(fire_colour(kind.share())));
        for pair in lightness.windows(2) {
            // With the hue beside it less will do than the contrast of 3 that WCAG asks of what has lightness alone.
            assert!((pair[1] + 0.05) / (pair[0] + 0.05) > 1.4, "{lightness:?}");
        }
    }

    #[test]
    fn what_burns_is_hot_and_has_air_and_what_lights_it_is_hot() {
        let table = elements().expect("the elements");
        let (curves, decays) = (HeatTable::new(&table), DecayTable::new(&table, 1.0));
        let find = |name: &str| table.find(name).expect(name);
        let (mut particles, mut rock) = (Particles::default(), Solids::new(40, 20));
        let lump = |particles: &mut Particles, name: &str, kelvin: f32, x: f32, y: f32| {
            let (element, id) = (find(name), particles.len() as u32);
            particles.push_warm(id, element, Vec2::new(x, y), Vec2::ZERO, curves.curve(element).heat(kelvin));
        };
        for (k, (name, kelvin)) in
            [("water", 293.0), ("oil", 293.0), ("lava", 1600.0), ("fire", 1500.0), ("ember", 1300.0), ("metal", 293.0)]
                .into_iter()
                .enumerate()
        {
            lump(&mut particles, name, kelvin, 3.5 + 5.0 * k as f32, 16.5);
        }
        // Hot tar in the middle of hot tar has no air.
        for k in 0..49 {
            lump(&mut particles, "tar", 900.0, 10.5 + (k % 7) as f32, 2.5 + (k / 7) as f32);
        }
        let wood = [IVec2::new(30, 5), IVec2::new(35, 5)];
        for (id, (cell, kelvin)) in wood.into_iter().zip([300.0, 700.0]).enumerate() {
            rock.insert(cell, find("wood"), 100 + id as u32);
            rock.set_heat(cell, curves.curve(find("wood")).heat(kelvin));
        }
        let mut exposure = Exposure::default();
        exposure.gather(&particles, Vec2::new(40.0, 20.0));
        let lights = decays.lowest_ignition();
        let burning = Burning {
            particles: &particles,
            rock: &rock,
            elements: &table,
            curves: &curves,
            decays: &decays,
            lights,
            exposure: &exposure,
        };
        let is: Vec<Fire> = (0..6).map(|i| burning.of_particle(i)).collect();
        assert_eq!(is, [Fire::Never, Fire::Fuel, Fire::Hot, Fire::Hot, Fire::Burns, Fire::Never]);
        assert_eq!([6, 6 + 24].map(|i| burning.of_particle(i)), [Fire::Burns, Fire::Fuel]);
        assert_eq!(wood.map(|cell| burning.of_rock(cell, find("wood"))), [Fire::Fuel, Fire::Burns]);
    }
}
