//! The world as a picture, drawn on the processor: discs for what moves, stone squares for rock, the air as a faint tint.

use crate::{
    lab::{
        colours::{self, Reference, Rgb},
        maps::{BurialMap, DepthMap},
    },
    sim::state::{AirGrid, ParticleStore, Rock, Setup},
};
use bevy::ecs::world::World;
use glam::{IVec2, Vec2};
use std::io::{self, Write};

/// Longer side of a picture, pixels.
pub const LONG_SIDE: u32 = 1280;

/// Radius of a particle's disc that closes a liquid at rest, d: a little over half.
pub const DISC_RADIUS: f32 = 0.64;

/// Strength of the wind's tint.
const FAINT: f32 = 0.4;

/// Most pixels of a spacing: a picture of a handful of particles stays small.
const LARGEST_SPACING: f32 = 48.0;

/// A picture, its rows from the top.
pub struct Picture {
    width: u32,
    height: u32,
    /// Light, 0 … 1 a channel: the square of the sRGB value, nearly the true curve.
    light: Vec<[f32; 3]>,
}

impl Picture {
    /// A picture of one colour.
    pub fn plain(width: u32, height: u32, colour: Rgb) -> Self {
        Self { width, height, light: vec![light(colour); width as usize * height as usize] }
    }

    /// Width and height, pixels.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The world in the colours of its elements, `long_side` pixels along the longer side of its box, with discs of `radius` d.
    pub fn of_world(world: &World, long_side: u32, radius: f32) -> Self {
        let setup = world.resource::<Setup>();
        let size = setup.blueprint.domain.size;
        let pixels = (long_side as f32 / size.max_element()).min(LARGEST_SPACING);
        let side = |length: f32| ((length * pixels).round() as u32).max(1);
        let mut canvas = Canvas { picture: Self::plain(side(size.x), side(size.y), colours::SURROUNDINGS), pixels };
        canvas.air(world.resource::<AirGrid>(), setup);
        canvas.rock(world.resource::<Rock>(), setup);
        canvas.particles(world, setup, radius);
        canvas.picture
    }

    /// Pictures in a row, `gap` pixels of the surroundings' colour between them and around.
    pub fn row(pictures: &[Self], gap: u32) -> Self {
        let width = pictures.iter().map(|picture| picture.width + gap).sum::<u32>() + gap;
        let height = pictures.iter().map(|picture| picture.height).max().unwrap_or(0) + 2 * gap;
        let mut row = Self::plain(width, height, colours::SURROUNDINGS);
        let mut left = gap;
        for picture in pictures {
            for (y, line) in (gap..).zip(picture.light.chunks_exact(picture.width as usize)) {
                let at = (y * width + left) as usize;
                row.light[at..at + line.len()].copy_from_slice(line);
            }
            left += picture.width + gap;
        }
        row
    }

    /// Pictures of one width, one below the other.
    pub fn column(pictures: &[Self]) -> Self {
        let width = pictures.iter().map(|picture| picture.width).max().unwrap_or(0);
        let mut column = Self { width, height: 0, light: Vec::new() };
        for picture in pictures.iter().filter(|picture| picture.width == width) {
            column.height += picture.height;
            column.light.extend_from_slice(&picture.light);
        }
        column
    }

    /// Writes the picture as PNG.
    pub fn write_png(&self, out: impl Write) -> io::Result<()> {
        let pixels: Vec<u8> = self.light.iter().flat_map(|light| light.map(srgb)).collect();
        write_png(out, self.width, self.height, &pixels)
    }
}

/// Writes pixels of red, green and blue as PNG, row by row.
pub(super) fn write_png(out: impl Write, width: u32, height: u32, pixels: &[u8]) -> io::Result<()> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    Ok(writer.finish()?)
}

fn light(colour: Rgb) -> [f32; 3] {
    colour.map(|channel| {
        let value = f32::from(channel) / 255.0;
        value * value
    })
}

fn srgb(light: f32) -> u8 {
    (light.max(0.0).sqrt() * 255.0 + 0.5) as u8
}

/// A picture that is being drawn.
struct Canvas {
    picture: Picture,
    /// Pixels of a spacing.
    pixels: f32,
}

impl Canvas {
    /// The empty box with its air.
    fn air(&mut self, air: &AirGrid, setup: &Setup) {
        let reference = Reference::of(&setup.blueprint.domain, &setup.blueprint.air);
        let (width, height) = self.picture.size();
        let moves = !air.is_quiet();
        for y in 0..height {
            let up = (height - y) as f32 - 0.5;
            let empty = light(colours::box_colour(up / height as f32));
            for x in 0..width {
                let pixel = &mut self.picture.light[(y * width + x) as usize];
                *pixel = empty;
                if moves {
                    let p = Vec2::new(x as f32 + 0.5, up) / self.pixels;
                    let (colour, strength) = colours::wind_colour(reference, air.sample_velocity(p));
                    blend(pixel, light(colour), FAINT * strength);
                }
            }
        }
    }

    fn rock(&mut self, rock: &Rock, setup: &Setup) {
        let mut burial = BurialMap::default();
        burial.measure(rock);
        for (cell, element, id) in rock.iter() {
            let colour = colours::rock_colour(setup.elements().get(element), cell, id, burial.at(cell));
            self.fill(cell, light(colour));
        }
    }

    fn particles(&mut self, world: &World, setup: &Setup, radius: f32) {
        let particles = world.resource::<ParticleStore>();
        let reference = Reference::of(&setup.blueprint.domain, &setup.blueprint.air);
        let mut depths = DepthMap::default();
        depths.measure(setup.blueprint.domain.size, (0..particles.len()).map(|i| (particles.position(i), 1)));
        for i in 0..particles.len() {
            let p = particles.position(i);
            let speed = particles.velocity(i).length() / reference.fall;
            let own = colours::particle_colour(setup.elements().get(particles.element[i]), speed);
            let colour = colours::darken(own, depths.at(p));
            self.cover(p, radius, colour, disc);
        }
    }

    /// Fills a cell of edge d, on whole pixels so that no seam shows between neighbours.
    fn fill(&mut self, cell: IVec2, colour: [f32; 3]) {
        let (width, height) = self.picture.size();
        let edge = |cell: i32, side: u32| ((cell as f32 * self.pixels).round() as u32).min(side);
        let columns = edge(cell.x, width)..edge(cell.x + 1, width);
        for y in height - edge(cell.y + 1, height)..height - edge(cell.y, height) {
            let row = (y * width) as usize;
            self.picture.light[row + columns.start as usize..row + columns.end as usize].fill(colour);
        }
    }

    /// Blends a shape of half-width `radius` (d) around `p` into the picture. `coverage` gives, from a pixel's distance to
    /// the centre and the half-width, both in pixels, how much of the pixel lies in the shape.
    fn cover(&mut self, p: Vec2, radius: f32, colour: Rgb, coverage: fn(Vec2, f32) -> f32) {
        if !p.is_finite() {
            return;
        }
        let (width, height) = (self.picture.width as i32, self.picture.height as i32);
        let centre = Vec2::new(p.x, height as f32 / self.pixels - p.y) * self.pixels;
        let radius = radius * self.pixels;
        let (low, high) = (centre - radius - 1.0, centre + radius + 1.0);
        let colour = light(colour);
        for y in (low.y as i32).max(0)..=(high.y as i32).min(height - 1) {
            for x in (low.x as i32).max(0)..=(high.x as i32).min(width - 1) {
                let offset = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - centre;
                let opacity = coverage(offset, radius);
                if opacity > 0.0 {
                    blend(&mut self.picture.light[(y * width + x) as usize], colour, opacity);
                }
            }
        }
    }
}

/// Share of a pixel that lies in a disc. A disc as small as a pixel is drawn as the square of its area.
fn disc(offset: Vec2, radius: f32) -> f32 {
    if radius < 1.0 { square(offset, radius * 0.886_227) } else { (radius + 0.5 - offset.length()).clamp(0.0, 1.0) }
}

/// Share of a pixel that lies in an axis-parallel square.
fn square(offset: Vec2, radius: f32) -> f32 {
    let overlap = |offset: f32| (0.5_f32.min(radius - offset) - (-0.5_f32).max(-radius - offset)).clamp(0.0, 1.0);
    overlap(offset.x) * overlap(offset.y)
}

/// Lays `colour` over a pixel with an opacity of 0 … 1.
fn blend(pixel: &mut [f32; 3], colour: [f32; 3], opacity: f32) {
    for (under, over) in pixel.iter_mut().zip(colour) {
        *under += (over - *under) * opacity;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_cover_their_own_area() {
        for (coverage, area) in [(disc as fn(Vec2, f32) -> f32, std::f32::consts::PI), (square, 4.0)] {
            for radius in [0.3_f32, 0.5, 3.7, 11.2] {
                let reach = radius as i32 + 2;
                let centre = Vec2::new(0.3, -0.2);
                let pixels =
                    (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| Vec2::new(x as f32, y as f32)));
                let covered: f32 = pixels.map(|pixel| coverage(pixel - centre, radius)).sum();
                let expected = area * radius * radius;
                assert!(
                    (covered / expected - 1.0).abs() < 0.15,
                    "{covered} pixels, not {expected}, at radius {radius}"
                );
            }
        }
    }

    #[test]
    fn colours_survive_the_way_to_light_and_back() {
        for value in 0..=255 {
            assert_eq!(light([value, 0, 255]).map(srgb), [value, 0, 255]);
        }
    }

    #[test]
    fn a_png_holds_the_pixels_row_by_row() {
        let row = Picture::row(&[Picture::plain(3, 2, [250, 10, 20]), Picture::plain(1, 4, [0, 0, 0])], 2);
        assert_eq!(row.size(), (10, 8));
        let mut bytes = Vec::new();
        row.write_png(&mut bytes).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        let at = |x: usize, y: usize| &pixels[3 * (y * 10 + x)..][..3];
        assert_eq!(at(2, 2), [250, 10, 20]);
        assert_eq!(at(7, 5), [0, 0, 0]);
        assert_eq!(at(0, 0), colours::SURROUNDINGS);
        assert_eq!(at(2, 4), colours::SURROUNDINGS, "the first picture is only two rows high");
    }
}
