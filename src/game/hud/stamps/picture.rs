//! Pictures of stamps: on the shelf, and for the ghost. Each is drawn once.

use crate::{
    game::{
        hud::style,
        stamps::shelf::{Kept, MOST},
    },
    kernel::{element::ElementTable, solids::centre, sources::Rect},
    sim::stamp::Stamp,
};
use bevy::prelude::Resource;
use bevy_egui::egui::{self, Color32, ColorImage, Mesh, Pos2, TextureHandle, TextureOptions, pos2};
use glam::{IVec2, Vec2};
use std::collections::BTreeMap;

/// Most pixels along a side of a picture.
const LONGEST: f32 = 1024.0;
/// Most pixels of a d.
const FINEST: f32 = 6.0;
/// Half the width of a particle, d: those of a square lattice leave no gap.
const RADIUS: f32 = 0.71;
/// How much of its colour has what a spring or a drain covers.
const SHADE: f32 = 0.4;
/// Colour of what this world does not have.
const UNKNOWN: Color32 = Color32::GRAY;

/// The pictures that were drawn, by the numbers of their stamps.
#[derive(Resource, Default)]
pub struct Pictures(BTreeMap<u64, TextureHandle>);

impl Pictures {
    /// The picture of a stamp.
    pub fn of(&mut self, context: &egui::Context, kept: &Kept, elements: &ElementTable) -> egui::TextureId {
        // Those of stamps that are no longer kept go with the rest now and then.
        if self.0.len() > 2 * MOST && !self.0.contains_key(&kept.number) {
            self.0.clear();
        }
        let draw = || {
            let picture = paint(&kept.stamp, elements);
            context.load_texture(format!("stamp {}", kept.number), picture, TextureOptions::LINEAR)
        };
        self.0.entry(kept.number).or_insert_with(draw).id()
    }
}

/// A picture as a mesh; each corner gets the place that `at` says for the same corner of the piece, where (0, 0) is the lower
/// left and (1, 1) the upper right one.
pub fn mesh(texture: egui::TextureId, tint: Color32, at: impl Fn(Vec2) -> Pos2) -> Mesh {
    let mut mesh = Mesh::with_texture(texture);
    for corner in [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y] {
        let uv = pos2(corner.x, 1.0 - corner.y);
        mesh.vertices.push(egui::epaint::Vertex { pos: at(corner), uv, color: tint });
    }
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 2, 3);
    mesh
}

/// Draws a stamp.
fn paint(stamp: &Stamp, elements: &ElementTable) -> ColorImage {
    let piece = &stamp.piece;
    let scale = (LONGEST / piece.size.max_element() as f32).min(FINEST);
    let size = (piece.size.as_vec2() * scale).ceil().as_ivec2().max(IVec2::ONE);
    let colours: Vec<Color32> = stamp.elements.iter().map(|name| colour(name, elements)).collect();
    let mut pixels = vec![Color32::TRANSPARENT; (size.x * size.y) as usize];
    let mut fill = |area: Rect, colour: Color32| {
        let (low, high) = ((area.min * scale).round().as_ivec2(), (area.max * scale).round().as_ivec2());
        for y in low.y.max(0)..high.y.min(size.y) {
            for x in low.x.max(0)..high.x.min(size.x) {
                pixels[((size.y - 1 - y) * size.x + x) as usize] = colour.gamma_multiply(SHADE);
            }
        }
    };
    // What springs and drains cover, behind all else.
    for emitter in &stamp.springs.emitters {
        fill(emitter.area, colours[emitter.element.index()]);
    }
    stamp.springs.drains.iter().for_each(|drain| fill(drain.area, style::TEXT));
    let mut dab = |at: Vec2, half: f32, is_round: bool, colour: Color32| {
        let (low, high) = (((at - half) * scale).floor().as_ivec2(), ((at + half) * scale).ceil().as_ivec2());
        for y in low.y.max(0)..high.y.min(size.y) {
            for x in low.x.max(0)..high.x.min(size.x) {
                let away = (IVec2::new(x, y).as_vec2() + 0.5) / scale - at;
                if !is_round || away.length() <= half.max(0.5 / scale) {
                    pixels[((size.y - 1 - y) * size.x + x) as usize] = colour;
                }
            }
        }
    };
    for rock in &piece.rock {
        dab(centre(rock.cell), 0.5, false, colours[rock.element.index()]);
    }
    for i in 0..piece.particles.len() {
        dab(piece.particles.position(i), RADIUS, true, colours[piece.particles.element[i].index()]);
    }
    ColorImage::new([size.x as usize, size.y as usize], pixels)
}

fn colour(name: &str, elements: &ElementTable) -> Color32 {
    let found = elements.find(name).map(|id| elements.get(id).colour);
    found.map_or(UNKNOWN, |[r, g, b]| Color32::from_rgb(r, g, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::{
            element::{Element, ElementId},
            particles::Particles,
            piece::Piece,
            solids::Solids,
        },
        sim::springs::Springs,
    };

    #[test]
    fn a_picture_shows_what_is_where_with_the_top_above() {
        let table = ElementTable::new(vec![
            Element { colour: [9, 8, 7], ..Element::plain("rock", true) },
            Element { colour: [1, 2, 250], ..Element::plain("water", false) },
        ]);
        let (mut particles, mut solids) = (Particles::default(), Solids::new(10, 5));
        particles.push(0, ElementId(1), Vec2::new(8.5, 0.5), Vec2::ZERO);
        solids.insert(IVec2::new(0, 4), ElementId(0), 1);
        let piece = Piece::of(&particles, &solids, IVec2::ZERO, IVec2::new(10, 5), 0.1);
        let stamp = Stamp { elements: vec!["rock".into(), "water".into()], piece, springs: Springs::default() };
        let picture = paint(&stamp, &table);
        let [width, height] = picture.size;
        let at = |x: f32, y: f32| picture.pixels[(y * height as f32) as usize * width + (x * width as f32) as usize];
        assert_eq!(at(0.05, 0.1), Color32::from_rgb(9, 8, 7), "the rock is at the top left");
        assert_eq!(at(0.85, 0.9), Color32::from_rgb(1, 2, 250), "the water is at the bottom right");
        assert_eq!(at(0.5, 0.5), Color32::TRANSPARENT);
    }

    #[test]
    fn a_large_stamp_has_a_picture_of_bounded_size() {
        let piece = Piece::of(&Particles::default(), &Solids::new(30_000, 3), IVec2::ZERO, IVec2::new(30_000, 3), 0.1);
        let picture =
            paint(&Stamp { elements: Vec::new(), piece, springs: Springs::default() }, &ElementTable::default());
        assert_eq!(picture.size, [1024, 1]);
    }
}
