//! What glows, and what it lights: two grids over the box. Light is no part of the simulation; nothing reads it but the
//! shaders.

use crate::{
    game::render::{
        body::CELL,
        look::{Look, Looks},
    },
    kernel::{element::ElementId, heat::table::HeatTable, particles::Particles, solids::Solids},
    lab::colours::incandescence,
};
use glam::{IVec2, Vec2};
use std::ops::Range;

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
    /// Rock that glows.
    pub rock: &'a [GlowingRock],
    /// Temperature by heat.
    pub curves: &'a HeatTable,
    /// Looks of the elements.
    pub looks: &'a Looks,
}

impl Warmth<'_> {
    /// Whether anything could be warmer than the room.
    pub fn is_there(&self) -> bool {
        self.particles.has_heat() || !self.rock.is_empty()
    }

    /// Colour that a particle of a look glows in.
    pub fn glow(&self, i: usize, look: Look) -> [f32; 3] {
        glow(self.particles.element[i], look, self.particles.heat_of(i), self.curves)
    }
}

/// Colour that matter of a look glows in.
fn glow(element: ElementId, look: Look, heat: i32, curves: &HeatTable) -> [f32; 3] {
    if heat < look.glows_from { [0.0; 3] } else { incandescence(curves.curve(element).temperature(heat)) }
}

/// A cell of rock that glows, and in which colour.
pub type GlowingRock = (IVec2, [f32; 3]);

/// Finds the rock that glows.
pub fn find_glowing(rock: &Solids, curves: &HeatTable, looks: &Looks, out: &mut Vec<GlowingRock>) {
    out.clear();
    if rock.heats().is_empty() {
        return;
    }
    rock.iter().for_each(|(cell, element, _)| {
        let glow = glow(element, looks.of(element), rock.heat(cell), curves);
        if glow[0] > 0.0 {
            out.push((cell, glow));
        }
    });
}

/// The two grids.
#[derive(Clone, Debug, Default)]
pub struct GlowMap {
    columns: usize,
    rows: usize,
    /// Sum of glow of what is no gas, by cell, and the cells where there is any.
    glow: Vec<[f32; 3]>,
    glowing: Vec<u32>,
    /// Sum of light by cell, and those that it reaches.
    sources: Vec<[f32; 3]>,
    lit: Region,
    /// Light of those that it reaches.
    light: Vec<f32>,
    sums: Vec<f32>,
    glow_texels: Vec<u8>,
    light_texels: Vec<u8>,
    shines: bool,
}

/// Columns and rows of a grid.
#[derive(Clone, Debug, Default)]
struct Region {
    columns: Range<usize>,
    rows: Range<usize>,
}

impl Region {
    /// Takes a cell and those within `reach` of it in, as far as the grid goes.
    fn include(&mut self, (x, y): (usize, usize), reach: usize, (columns, rows): (usize, usize)) {
        let extend = |range: &mut Range<usize>, at: usize, all: usize| {
            let (from, to) = (at.saturating_sub(reach), (at + reach + 1).min(all));
            *range = if range.start >= range.end { from..to } else { range.start.min(from)..range.end.max(to) };
        };
        extend(&mut self.columns, x, columns);
        extend(&mut self.rows, y, rows);
    }

    /// Each row's cells in a grid of so many columns.
    fn runs(&self, columns: usize) -> impl Iterator<Item = Range<usize>> {
        self.rows.clone().map(move |y| y * columns + self.columns.start..y * columns + self.columns.end)
    }
}

impl GlowMap {
    /// Measures a world. `held`: how many particles of what is no gas a cell holds.
    pub fn measure(&mut self, size: Vec2, warmth: Warmth<'_>, held: impl Fn(usize) -> f32) {
        self.shines = false;
        if !warmth.is_there() {
            return;
        }
        self.begin(size);
        let particles = warmth.particles;
        for i in 0..particles.len() {
            let look = warmth.looks.of(particles.element[i]);
            self.add(particles.position(i), warmth.glow(i, look), !look.is_gas());
        }
        for (cell, glow) in warmth.rock {
            self.add(cell.as_vec2() + 0.5, *glow, true);
        }
        if self.shines {
            self.spread();
            self.pack(held);
        }
    }

    /// Takes everything out.
    fn begin(&mut self, size: Vec2) {
        let (columns, rows) = (((size.x / CELL).ceil() as usize).max(1), ((size.y / CELL).ceil() as usize).max(1));
        if (columns, rows) != (self.columns, self.rows) {
            *self = Self { columns, rows, ..Self::default() };
            let dark = |cells: usize| [0, 0, 0, 255].repeat(cells);
            let coarse = self.coarse_columns() * self.coarse_rows();
            self.glow.resize(columns * rows, [0.0; 3]);
            self.sources.resize(coarse, [0.0; 3]);
            (self.glow_texels, self.light_texels) = (dark(columns * rows), dark(coarse));
        }
        for cell in self.glowing.drain(..).map(|cell| cell as usize) {
            self.glow[cell] = [0.0; 3];
            self.glow_texels[4 * cell..][..3].fill(0);
        }
        for run in self.lit.runs(self.coarse_columns()) {
            self.sources[run.clone()].fill([0.0; 3]);
            self.light_texels[4 * run.start..4 * run.end].as_chunks_mut().0.fill([0, 0, 0, 255]);
        }
        self.lit = Region::default();
    }

    fn add(&mut self, at: Vec2, glow: [f32; 3], body: bool) {
        // Of all colours red is the first.
        if glow[0] <= 0.0 {
            return;
        }
        self.shines = true;
        let (x, y) = (((at.x / CELL) as usize).min(self.columns - 1), ((at.y / CELL) as usize).min(self.rows - 1));
        if body {
            let cell = y * self.columns + x;
            let sum = &mut self.glow[cell];
            if sum[0] == 0.0 {
                self.glowing.push(cell as u32);
            }
            for (sum, glow) in sum.iter_mut().zip(glow) {
                *sum += glow;
            }
        }
        let (x, y, all) = (x / COARSE, y / COARSE, (self.coarse_columns(), self.coarse_rows()));
        self.lit.include((x, y), PASSES * REACH, all);
        for (sum, glow) in self.sources[y * all.0 + x].iter_mut().zip(glow) {
            *sum += glow / (FULL * (COARSE * COARSE) as f32);
        }
    }

    /// Light falls off with distance: box filters along rows and columns.
    fn spread(&mut self) {
        self.light.clear();
        for run in self.lit.runs(self.coarse_columns()) {
            self.light.extend_from_slice(self.sources[run].as_flattened());
        }
        let row = 3 * self.lit.columns.len();
        for _ in 0..PASSES {
            blur(&mut self.light, &mut self.sums, row, 3);
            blur(&mut self.light, &mut self.sums, row * self.lit.rows.len(), row);
        }
    }

    fn pack(&mut self, held: impl Fn(usize) -> f32) {
        let byte = |value: f32| (255.0 * value.min(1.0)) as u8;
        for cell in self.glowing.iter().map(|cell| *cell as usize) {
            let share = 1.0 / held(cell).max(1.0);
            self.glow_texels[4 * cell..][..3].copy_from_slice(&self.glow[cell].map(|sum| byte(sum * share)));
        }
        let mut lights = self.light.as_chunks().0.iter();
        for run in self.lit.runs(self.coarse_columns()) {
            let texels = self.light_texels[4 * run.start..4 * run.end].as_chunks_mut::<4>().0;
            for (texel, [r, g, b]) in texels.iter_mut().zip(&mut lights) {
                *texel = [byte(GAIN * r), byte(GAIN * g), byte(GAIN * b), 255];
            }
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
        let mut map = GlowMap::default();
        let looks = Looks::new(&elements, &curves);
        let warmth = Warmth { particles: &particles, rock: &[], curves: &curves, looks: &looks };
        map.measure(Vec2::splat(128.0), warmth, |_| 4.0);
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
        let looks = Looks::new(&elements, &curves);
        let measure = |map: &mut GlowMap, rock: &Solids| {
            let mut glowing = Vec::new();
            find_glowing(rock, &curves, &looks, &mut glowing);
            let warmth = Warmth { particles: &particles, rock: &glowing, curves: &curves, looks: &looks };
            map.measure(Vec2::splat(32.0), warmth, |_| 1.0);
        };
        measure(&mut map, &rock);
        assert!(!map.shines());
        rock.set_heat(IVec2::new(16, 16), curves.curve(metal).heat(1500.0));
        measure(&mut map, &rock);
        assert!(map.shines());
        let (texels, (columns, _)) = map.glow();
        assert!(texels[4 * (8 * columns + 8)] > 200);
    }

    #[test]
    fn nothing_is_left_of_the_glow_and_the_light_of_the_frames_before() {
        let (elements, curves) = table();
        let (lava, fire) = (elements.find("lava").expect("lava"), elements.find("fire").expect("fire"));
        let looks = Looks::new(&elements, &curves);
        let mut map = GlowMap::default();
        // Another box, a place further on, a gas, at the edges, nowhere, and back again.
        type Lump = (f32, f32, ElementId);
        let frames: [(f32, &[Lump]); 6] = [
            (90.0, &[(20.0, 20.0, lava), (70.0, 30.0, lava)]),
            (120.0, &[(20.0, 20.0, lava), (70.0, 30.0, lava)]),
            (120.0, &[(23.0, 20.0, lava), (60.0, 80.0, fire)]),
            (120.0, &[(0.0, 0.0, lava), (119.9, 119.9, lava)]),
            (120.0, &[]),
            (120.0, &[(40.0, 41.0, fire)]),
        ];
        for (k, (side, lumps)) in frames.into_iter().enumerate() {
            let mut particles = Particles::default();
            for (id, (x, y, element)) in lumps.iter().enumerate() {
                particles.push_warm(id as u32, *element, Vec2::new(*x, *y), Vec2::ZERO, curves.spawn_heat(*element));
            }
            let warmth = Warmth { particles: &particles, rock: &[], curves: &curves, looks: &looks };
            let mut fresh = GlowMap::default();
            for map in [&mut map, &mut fresh] {
                map.measure(Vec2::splat(side), warmth, |_| 1.0);
            }
            assert_eq!((map.shines(), fresh.shines()), (!lumps.is_empty(), !lumps.is_empty()), "frame {k}");
            if map.shines() {
                assert!(map.glow() == fresh.glow() && map.light() == fresh.light(), "frame {k}");
            }
        }
    }
}
