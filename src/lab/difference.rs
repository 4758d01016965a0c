//! How far two worlds of the same scene are apart, on a coarse field: share of liquid, its velocity and that of the air in
//! square cells. A flow is chaotic, particles soon stand elsewhere; what they add up to is compared.

use crate::{
    kernel::{air::Air, particles::Particles, units::Scale},
    lab::colours::{Reference, Rgb, ramp},
    scene::blueprint::Blueprint,
    sim::state::{AirGrid, ParticleStore, Setup},
};
use bevy::ecs::world::World;
use glam::Vec2;

/// Edge of a cell, d of the coarser world.
const CELL: f32 = 4.0;

/// A difference of all the liquid that a cell holds, or of this share of a long fall's speed, is the end of the scale; in
/// the air, one of a strong wind ([`Reference`]).
pub const FULL_SPEED: f32 = 0.25;
/// Most points along the edge of a cell at which the air is looked at.
const MOST_POINTS: f32 = 2.0;

/// Colours of the heat map from a little to all.
const STOPS: [Rgb; 4] = [[64, 24, 110], [176, 40, 110], [244, 112, 48], [255, 232, 150]];

/// What of a world is compared.
#[derive(Clone, Copy)]
pub struct Half<'a> {
    /// Movable particles.
    pub particles: &'a Particles,
    /// The air, on cells of any size.
    pub air: &'a Air,
    /// Its d.
    pub scale: Scale,
}

impl<'a> Half<'a> {
    /// That of a world.
    pub fn of(world: &'a World) -> Self {
        Self {
            particles: world.resource::<ParticleStore>(),
            air: world.resource::<AirGrid>(),
            scale: world.resource::<Setup>().blueprint.scale,
        }
    }
}

/// Square cells over a box.
#[derive(Clone, Copy)]
struct Cells {
    /// Edge in d of the world that is measured.
    edge: f32,
    columns: usize,
    rows: usize,
    /// d of the world that is measured, in d of the one that it is compared in.
    unit: f32,
}

/// What one world adds up to, cell by cell.
#[derive(Clone, Debug, Default)]
struct Field {
    /// Particles over those at rest, a share.
    share: Vec<f32>,
    /// Sum of the velocities over the particles at rest, d/s.
    flow: Vec<Vec2>,
    /// Velocity of the air, d/s.
    wind: Vec<Vec2>,
}

impl Field {
    fn measure(&mut self, Half { particles, air, .. }: Half<'_>, cells: Cells) {
        let Cells { edge, columns, rows, unit } = cells;
        self.share.clear();
        self.share.resize(columns * rows, 0.0);
        self.flow.clear();
        self.flow.resize(columns * rows, Vec2::ZERO);
        for i in 0..particles.len() {
            let place = particles.position(i) / edge;
            let (column, row) = ((place.x as usize).min(columns - 1), (place.y as usize).min(rows - 1));
            let cell = row * columns + column;
            self.share[cell] += 1.0;
            self.flow[cell] += unit * particles.velocity(i);
        }
        let full = edge * edge;
        self.share.iter_mut().for_each(|share| *share /= full);
        self.flow.iter_mut().for_each(|flow| *flow /= full);
        self.wind.clear();
        self.wind.resize(columns * rows, Vec2::ZERO);
        if !air.is_quiet() {
            for (cell, wind) in self.wind.iter_mut().enumerate() {
                *wind = unit * mean_wind(air, edge, Vec2::new((cell % columns) as f32, (cell / columns) as f32));
            }
        }
    }
}

/// Mean velocity of the air in a cell of edge `edge` (d), d/s, from one point or, where the air's cells are finer,
/// four.
fn mean_wind(air: &Air, edge: f32, cell: Vec2) -> Vec2 {
    let points = (edge / air.cell()).round().clamp(1.0, MOST_POINTS);
    let along = 0..points as usize;
    let at = |k: usize| (k as f32 + 0.5) / points;
    let winds = along.clone().flat_map(|y| along.clone().map(move |x| Vec2::new(at(x), at(y))));
    winds.map(|part| air.sample_velocity((cell + part) * edge)).sum::<Vec2>() / (points * points)
}

/// What there is of a difference in a part of the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Of the liquid, as [`Difference::liquid`].
    pub liquid: Option<f32>,
    /// Of the air, as [`Difference::wind`], d/s.
    pub wind: Option<f32>,
    /// How hot it is, 0 (none) … 1 (the end of the scale): of the liquid, and where neither world has any, of the air.
    pub heat: f32,
}

/// The difference between two worlds.
#[derive(Clone, Debug, Default)]
pub struct Difference {
    /// Edge of a cell, d of the first world.
    edge: f32,
    columns: usize,
    rows: usize,
    fields: [Field; 2],
    /// Of the liquid, 0 (none) … 1 (the end of the scale).
    liquid: Vec<f32>,
    /// The same, and of the air where neither world has liquid: elsewhere the air only follows the liquid.
    heat: Vec<f32>,
}

impl Difference {
    /// Compares two worlds of the same scene, in the d of the first, which is `blueprint`'s. They may be of different
    /// details.
    pub fn measure(&mut self, blueprint: &Blueprint, first: Half<'_>, second: Half<'_>) {
        let own = first.scale.spacing;
        let edge = CELL * (second.scale.spacing / own).max(1.0);
        let cells = (blueprint.domain.size / edge).ceil().max(Vec2::ONE);
        (self.edge, self.columns, self.rows) = (edge, cells.x as usize, cells.y as usize);
        for (field, half) in self.fields.iter_mut().zip([first, second]) {
            let unit = half.scale.spacing / own;
            field.measure(half, Cells { edge: edge / unit, columns: self.columns, rows: self.rows, unit });
        }
        let reference = Reference::of(&blueprint.domain, &blueprint.air);
        let speed = FULL_SPEED * reference.fall;
        let [a, b] = &self.fields;
        self.liquid.clear();
        self.liquid.extend((0..a.share.len()).map(|cell| {
            let share = (a.share[cell] - b.share[cell]).abs();
            let flow = (a.flow[cell] - b.flow[cell]).length() / speed;
            share.max(flow).min(1.0)
        }));
        self.heat.clear();
        self.heat.extend(self.liquid.iter().enumerate().map(|(cell, liquid)| {
            let is_dry = a.share[cell] == 0.0 && b.share[cell] == 0.0;
            if is_dry { (a.wind[cell].distance(b.wind[cell]) / reference.wind).min(1.0) } else { *liquid }
        }));
    }

    /// Edge of a cell, d of the first world.
    pub fn edge(&self) -> f32 {
        self.edge
    }

    /// Cells beside each other.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Cells above each other.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether the fields are equal to the bit.
    pub fn is_nothing(&self) -> bool {
        let [a, b] = &self.fields;
        a.share == b.share && a.flow == b.flow && a.wind == b.wind
    }

    /// That of the liquid: mean over the cells in which either world has some, 0 … 1; `None` if neither has any.
    pub fn liquid(&self) -> Option<f32> {
        self.liquid_of(0..self.liquid.len())
    }

    fn liquid_of(&self, cells: impl Iterator<Item = usize>) -> Option<f32> {
        let [a, b] = &self.fields;
        let wet = cells.filter(|&cell| a.share[cell] > 0.0 || b.share[cell] > 0.0);
        let (sum, count) = wet.fold((0.0, 0), |(sum, count), cell| (sum + self.liquid[cell], count + 1));
        (count > 0).then(|| sum / count as f32)
    }

    /// That of the air: root mean square of the difference of its velocities over the box, d/s; `None` if neither moves.
    pub fn wind(&self) -> Option<f32> {
        self.wind_of(0..self.liquid.len())
    }

    fn wind_of(&self, cells: impl ExactSizeIterator<Item = usize>) -> Option<f32> {
        let [a, b] = &self.fields;
        let count = cells.len();
        let (moves, squares) = cells.fold((false, 0.0), |(moves, sum), cell| {
            let (a, b) = (a.wind[cell], b.wind[cell]);
            (moves || a != Vec2::ZERO || b != Vec2::ZERO, sum + a.distance_squared(b))
        });
        moves.then(|| (squares / count as f32).sqrt())
    }

    /// What there is of it in a disc, d of the first world.
    pub fn within(&self, centre: Vec2, radius: f32) -> Part {
        let touches = |cell: usize| {
            let min = self.edge * Vec2::new((cell % self.columns) as f32, (cell / self.columns) as f32);
            centre.clamp(min, min + self.edge).distance(centre) <= radius
        };
        let cells: Vec<usize> = (0..self.liquid.len()).filter(|&cell| touches(cell)).collect();
        let liquid = self.liquid_of(cells.iter().copied());
        let mean = |sum: f32| if cells.is_empty() { 0.0 } else { sum / cells.len() as f32 };
        let heat = liquid.unwrap_or_else(|| mean(cells.iter().map(|&cell| self.heat[cell]).sum()));
        Part { liquid, wind: self.wind_of(cells.into_iter()), heat }
    }

    /// Colours of the cells, premultiplied by their opacity, row by row from the bottom: nothing is transparent.
    pub fn texels(&self, out: &mut Vec<u8>) {
        out.clear();
        for &heat in &self.heat {
            let (rgb, opacity) = colour(heat);
            out.extend(rgb.map(|channel| (f32::from(channel) * opacity) as u8));
            out.push((255.0 * opacity) as u8);
        }
    }
}

/// Colour and opacity (0 … 1) of a heat.
pub fn colour(heat: f32) -> (Rgb, f32) {
    if heat <= 0.0 {
        return ([0; 3], 0.0);
    }
    // The root spreads small differences: most are.
    let root = heat.min(1.0).sqrt();
    (ramp(&STOPS, root), (0.25 + 1.5 * root).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{self, effects::EffectModes};

    #[test]
    fn no_heat_is_nothing_to_see_and_more_is_brighter() {
        assert_eq!(colour(0.0), ([0; 3], 0.0));
        let brightness = |heat| {
            let (rgb, opacity) = colour(heat);
            rgb.iter().map(|&channel| f32::from(channel)).sum::<f32>() * opacity
        };
        let seen: Vec<f32> = [0.001, 0.01, 0.1, 0.5, 1.0].map(brightness).into();
        assert!(seen.windows(2).all(|pair| pair[1] > pair[0]) && seen[0] > 20.0, "{seen:?}");
    }

    /// A box of air in which the left half blows at `speed`, d/s.
    fn air(blueprint: &Blueprint, cell: f32, speed: f32) -> Air {
        let size = blueprint.domain.size;
        let mut air = Air::new(size, cell, blueprint.air);
        air.blow(size * Vec2::new(0.25, 0.5), 0.2 * size.min_element(), Vec2::new(speed, 0.0));
        air
    }

    #[test]
    fn airs_that_differ_are_not_nothing_and_glow_where_they_do() {
        let blueprint = scene::load("sealed_air").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        let particles = Particles::default();
        let mut difference = Difference::default();
        let strong = Reference::of(&blueprint.domain, &blueprint.air).wind;
        let mut measure = |first: &Air, second: &Air| {
            let half = |air| Half { particles: &particles, air, scale: blueprint.scale };
            difference.measure(&blueprint, half(first), half(second));
            difference.clone()
        };
        let still = Air::new(blueprint.domain.size, 4.0, blueprint.air);
        let same = measure(&air(&blueprint, 4.0, strong), &air(&blueprint, 4.0, strong));
        assert!(same.is_nothing() && same.wind() == Some(0.0));
        assert_eq!(measure(&still, &still).wind(), None, "there is no wind to compare");
        let other = measure(&air(&blueprint, 4.0, 2.0 * strong), &still);
        assert!(!other.is_nothing() && other.liquid().is_none());
        assert!(other.wind().is_some_and(|wind| wind > 0.01 * strong && wind < strong), "{:?}", other.wind());
        let (columns, rows) = (other.columns(), other.rows());
        assert_eq!(
            other.heat[rows / 2 * columns + columns / 4],
            1.0,
            "a strong wind against none is the end of the scale"
        );
        assert_eq!(other.heat[rows / 2 * columns + columns - 2], 0.0, "nothing blows on the right");
        let finer = measure(&air(&blueprint, 4.0, 2.0 * strong), &air(&blueprint, 2.0, 2.0 * strong));
        assert!(finer.wind() < other.wind().map(|wind| 0.5 * wind), "the same wind on finer cells: {:?}", finer.wind());
    }
}
