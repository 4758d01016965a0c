//! What glows, and what it lights: two grids over the box. Light is no part of the simulation; nothing reads it but the
//! shaders.

use crate::{
    game::render::body::CELL,
    kernel::{element::ElementId, heat::table::HeatTable, particles::Particles, solids::Solids},
    lab::colours::incandescence,
};
use glam::Vec2;

/// Particles that a full cell holds.
const FULL: f32 = CELL * CELL;
/// Cells of the map of glow along one of light.
const COARSE: usize = 2;
/// Cells to either side that a pass of the blur reaches.
const REACH: usize = 3;
/// Passes of the blur: three boxes make nearly a bell.
const PASSES: usize = 3;
/// Light of a large area that glows white.
const GAIN: f32 = 5.0;

/// Temperatures of a world's matter.
#[derive(Clone, Copy)]
pub struct Warmth<'a> {
    /// Movable particles.
    pub particles: &'a Particles,
    /// Rock.
    pub rock: &'a Solids,
    /// Temperature by heat.
    pub curves: &'a HeatTable,
}

impl Warmth<'_> {
    /// Whether anything could be warmer than the room.
    pub fn is_there(&self) -> bool {
        self.particles.has_heat() || !self.rock.heats().is_empty()
    }

    /// Colour that a particle glows in.
    pub fn glow(&self, i: usize) -> [f32; 3] {
        self.of(self.particles.element[i], self.particles.heat_of(i))
    }

    fn of(&self, element: ElementId, heat: i32) -> [f32; 3] {
        incandescence(self.curves.curve(element).temperature(heat))
    }
}

/// The two grids.
#[derive(Clone, Debug, Default)]
pub struct GlowMap {
    columns: usize,
    rows: usize,
    /// Sum of glow, and particles that are no gas, by cell.
    glow: Vec<[f32; 4]>,
    light: Vec<[f32; 3]>,
    sums: Vec<f32>,
    glow_texels: Vec<u8>,
    light_texels: Vec<u8>,
    shines: bool,
}

impl GlowMap {
    /// Measures a world. `is_gas` by element.
    pub fn measure(&mut self, size: Vec2, warmth: Warmth<'_>, is_gas: impl Fn(ElementId) -> bool) {
        self.shines = false;
        if !warmth.is_there() {
            return;
        }
        self.columns = ((size.x / CELL).ceil() as usize).max(1);
        self.rows = ((size.y / CELL).ceil() as usize).max(1);
        self.glow.clear();
        self.glow.resize(self.columns * self.rows, [0.0; 4]);
        self.light.clear();
        self.light.resize(self.coarse_columns() * self.coarse_rows(), [0.0; 3]);
        let particles = warmth.particles;
        for i in 0..particles.len() {
            let gas = is_gas(particles.element[i]);
            self.add(particles.position(i), warmth.glow(i), !gas);
        }
        if !warmth.rock.heats().is_empty() {
            warmth.rock.iter().for_each(|(cell, element, _)| {
                self.add(cell.as_vec2() + 0.5, warmth.of(element, warmth.rock.heat(cell)), true);
            });
        }
        if self.shines {
            self.spread();
            self.pack();
        }
    }

    fn add(&mut self, at: Vec2, glow: [f32; 3], body: bool) {
        let (x, y) = (((at.x / CELL) as usize).min(self.columns - 1), ((at.y / CELL) as usize).min(self.rows - 1));
        let shines = glow[0] > 0.0;
        self.shines |= shines;
        if body {
            let sum = &mut self.glow[y * self.columns + x];
            for (sum, glow) in sum.iter_mut().zip(glow) {
                *sum += glow;
            }
            sum[3] += 1.0;
        }
        if shines {
            let coarse = (y / COARSE) * self.coarse_columns() + x / COARSE;
            for (sum, glow) in self.light[coarse].iter_mut().zip(glow) {
                *sum += glow / (FULL * (COARSE * COARSE) as f32);
            }
        }
    }

    /// Light falls off with distance: box filters along rows and columns.
    fn spread(&mut self) {
        let row = 3 * self.coarse_columns();
        let light = self.light.as_flattened_mut();
        for _ in 0..PASSES {
            blur(light, &mut self.sums, row, 3);
            blur(light, &mut self.sums, light.len(), row);
        }
    }

    fn pack(&mut self) {
        let byte = |value: f32| (255.0 * value.min(1.0)) as u8;
        self.glow_texels.clear();
        for [r, g, b, count] in &self.glow {
            let share = 1.0 / count.max(1.0);
            self.glow_texels.extend([byte(r * share), byte(g * share), byte(b * share), 255]);
        }
        self.light_texels.clear();
        for [r, g, b] in &self.light {
            self.light_texels.extend([byte(GAIN * r), byte(GAIN * g), byte(GAIN * b), 255]);
        }
    }

    /// Whether anything glows.
    pub fn shines(&self) -> bool {
        self.shines
    }

    /// Glow of the matter in each cell, with columns and rows; row by row from the bottom.
    pub fn glow(&self) -> (&[u8], (usize, usize)) {
        (&self.glow_texels, (self.columns, self.rows))
    }

    /// Light at each place, likewise.
    pub fn light(&self) -> (&[u8], (usize, usize)) {
        (&self.light_texels, (self.coarse_columns(), self.coarse_rows()))
    }

    /// What the map of light covers, d.
    pub fn light_extent(&self) -> Vec2 {
        Vec2::new(self.coarse_columns() as f32, self.coarse_rows() as f32) * (CELL * COARSE as f32)
    }

    fn coarse_columns(&self) -> usize {
        self.columns.div_ceil(COARSE)
    }

    fn coarse_rows(&self) -> usize {
        self.rows.div_ceil(COARSE)
    }
}

/// The mean of [`REACH`] numbers to either side, `step` apart, and of that between them, in each line of so many numbers; nothing comes
/// from beyond.
fn blur(numbers: &mut [f32], sums: &mut Vec<f32>, line: usize, step: usize) {
    sums.clear();
    sums.resize(numbers.len(), 0.0);
    for (sums, from) in sums.chunks_exact_mut(line).zip(numbers.chunks_exact(line)) {
        let mut add = |sums_from: usize, numbers_from: usize| {
            let (sums, from) = (sums.get_mut(sums_from..), from.get(numbers_from..));
            let pairs = sums.into_iter().flatten().zip(from.into_iter().flatten());
            pairs.for_each(|(sum, number)| *sum += number);
        };
        (1..=REACH).rev().for_each(|away| add(away * step, 0));
        (0..=REACH).for_each(|away| add(0, away * step));
    }
    let width = (2 * REACH + 1) as f32;
    for (number, sum) in numbers.iter_mut().zip(sums) {
        *number = *sum / width;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{kernel::element::ElementTable, scene::elements};
    use glam::IVec2;
    use std::sync::Arc;

    fn table() -> (Arc<ElementTable>, HeatTable) {
        let elements = elements().expect("the elements");
        let curves = HeatTable::new(&elements);
        (elements, curves)
    }

    #[test]
    fn what_is_hotter_glows_brighter_and_what_is_cold_not_at_all() {
        assert_eq!(incandescence(293.0), [0.0; 3]);
        assert_eq!(incandescence(f32::NAN), [0.0; 3]);
        let sums: Vec<f32> = (8..40).map(|k| incandescence(100.0 * k as f32).iter().sum()).collect();
        assert!(sums.is_sorted() && sums[0] < sums[31], "{sums:?}");
        let [r, _, b] = incandescence(1100.0);
        assert!(r > 3.0 * b, "a dull glow is red");
    }

    #[test]
    fn light_falls_off_with_the_distance_from_lava_on_all_sides() {
        let (elements, curves) = table();
        let lava = elements.find("lava").expect("lava");
        let mut particles = Particles::default();
        for k in 0..64 {
            let at = Vec2::new(60.5 + (k % 8) as f32, 60.5 + (k / 8) as f32);
            particles.push_warm(k, lava, at, Vec2::ZERO, curves.spawn_heat(lava));
        }
        let rock = Solids::new(128, 128);
        let mut map = GlowMap::default();
        map.measure(Vec2::splat(128.0), Warmth { particles: &particles, rock: &rock, curves: &curves }, |_| false);
        assert!(map.shines());
        let (texels, (columns, rows)) = map.light();
        let at = |x: usize, y: usize| u32::from(texels[4 * (y * columns + x)]);
        let middle = (columns / 2, rows / 2);
        for (dx, dy) in [(1i32, 0i32), (-1, 0), (0, 1), (0, -1)] {
            let way: Vec<u32> =
                (0..12).map(|k| at((middle.0 as i32 + k * dx) as usize, (middle.1 as i32 + k * dy) as usize)).collect();
            assert!(way.windows(2).all(|pair| pair[0] >= pair[1]) && way[0] > way[4] && way[4] > way[8], "{way:?}");
            assert_eq!(way[11], 0, "light has an end");
        }
    }

    #[test]
    fn hot_rock_shines_and_a_world_at_one_temperature_has_no_light() {
        let (elements, curves) = table();
        let metal = elements.find("metal").expect("metal");
        let (particles, mut rock, mut map) = (Particles::default(), Solids::new(32, 32), GlowMap::default());
        rock.insert(IVec2::new(16, 16), metal, 0);
        let measure = |map: &mut GlowMap, rock: &Solids| {
            map.measure(Vec2::splat(32.0), Warmth { particles: &particles, rock, curves: &curves }, |_| false);
        };
        measure(&mut map, &rock);
        assert!(!map.shines());
        rock.set_heat(IVec2::new(16, 16), curves.curve(metal).heat(1500.0));
        measure(&mut map, &rock);
        assert!(map.shines());
        let (texels, (columns, _)) = map.glow();
        assert!(texels[4 * (8 * columns + 8)] > 200);
    }
}
