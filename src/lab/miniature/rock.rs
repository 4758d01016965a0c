//! What stays where it is, baked: smooth outlines in place of the stairs of its cells.

use crate::{
    kernel::{element::ElementTable, solids::Solids},
    lab::{
        colours::rock_colour,
        maps::BurialMap,
        miniature::frame::{Frame, light},
    },
};

/// Opacity and light by pixel, made anew when the rock changes.
pub(super) struct RockPicture {
    pixels: Vec<[f32; 4]>,
    /// What it was made of.
    version: Option<u64>,
    burial: BurialMap,
    cells: Vec<Option<[f32; 3]>>,
}

impl RockPicture {
    /// None, for so many pixels.
    pub(super) fn new(pixels: usize) -> Self {
        Self { pixels: vec![[0.0; 4]; pixels], version: None, burial: BurialMap::default(), cells: Vec::new() }
    }

    /// Opacity and light at a pixel.
    pub(super) fn at(&self, pixel: usize) -> (f32, [f32; 3]) {
        let [opacity, red, green, blue] = self.pixels[pixel];
        (opacity, [red, green, blue])
    }

    /// Follows the rock.
    pub(super) fn follow(&mut self, rock: &Solids, elements: &ElementTable, frame: &Frame) {
        if self.version == Some(rock.version()) {
            return;
        }
        self.version = Some(rock.version());
        self.burial.measure(rock);
        self.cells.clear();
        self.cells.resize((rock.columns() * rock.rows()) as usize, None);
        for (cell, element, id) in rock.iter() {
            let colour = rock_colour(elements.get(element), cell, id, self.burial.at(cell));
            self.cells[(cell.y * rock.columns() + cell.x) as usize] = Some(light(colour));
        }
        for (k, pixel) in self.pixels.iter_mut().enumerate() {
            let at = frame.place(k) - 0.5;
            let cell = at.floor();
            let (right, up) = (at.x - cell.x, at.y - cell.y);
            let mut sum = [0.0_f32; 4];
            for (x, y, weight) in [
                (0, 0, (1.0 - right) * (1.0 - up)),
                (1, 0, right * (1.0 - up)),
                (0, 1, (1.0 - right) * up),
                (1, 1, right * up),
            ] {
                // Beyond the box it goes on as at its edge.
                let column = (cell.x as i32 + x).clamp(0, rock.columns() - 1);
                let row = (cell.y as i32 + y).clamp(0, rock.rows() - 1);
                if let Some(light) = self.cells[(row * rock.columns() + column) as usize] {
                    sum[0] += weight;
                    (0..3).for_each(|k| sum[k + 1] += weight * light[k]);
                }
            }
            let [weight, lights @ ..] = sum;
            // The outline is where half of the weight is rock: a pixel or so wide.
            let opacity = (0.5 + (weight - 0.5) * frame.pixels()).clamp(0.0, 1.0);
            let [red, green, blue] = lights.map(|light| if weight > 0.0 { light / weight } else { 0.0 });
            *pixel = [opacity, red, green, blue];
        }
    }
}
