//! The air as a picture (one texel a cell, colours laid over the empty box) and as arrows.

use crate::{
    kernel::air::Air,
    lab::colours::{Reference, Rgb},
};
use glam::Vec2;

/// Tail and head (four f32) and colour (four bytes) of a streak.
pub type Streak = [u32; 5];

/// A streak from a tail to a head; the colour's last byte is its opacity.
pub fn streak(tail: Vec2, head: Vec2, colour: [u8; 4]) -> Streak {
    [tail.x.to_bits(), tail.y.to_bits(), head.x.to_bits(), head.y.to_bits(), u32::from_le_bytes(colour)]
}

/// Packs the air's colours, premultiplied by their opacity, row by row from the bottom.
pub fn pack(air: &Air, colour: fn(Reference, f32, Vec2) -> (Rgb, f32), reference: Reference, out: &mut Vec<u8>) {
    out.clear();
    for row in 0..air.rows() {
        let velocity = air.velocity_x_row(row).iter().zip(air.velocity_y_row(row));
        for (column, (&u, &v)) in velocity.enumerate() {
            let pressure = if air.is_solid_cell(column, row) {
                pressure_beside(air, column, row)
            } else {
                air.pressing_at_cell(column, row)
            };
            let (rgb, opacity) = colour(reference, pressure, Vec2::new(u, v));
            out.extend(rgb.map(|channel| (f32::from(channel) * opacity) as u8));
            out.push((255.0 * opacity) as u8);
        }
    }
}

/// Mean pressure of the open cells beside a cell of rock, so that the picture doesn't fade towards rock.
fn pressure_beside(air: &Air, column: usize, row: usize) -> f32 {
    let beside = [(column.wrapping_sub(1), row), (column + 1, row), (column, row.wrapping_sub(1)), (column, row + 1)];
    let open = beside.into_iter().filter(|&(c, r)| c < air.columns() && r < air.rows() && !air.is_solid_cell(c, r));
    let (sum, count) = open.fold((0.0, 0), |(sum, count), (c, r)| (sum + air.pressing_at_cell(c, r), count + 1));
    if count == 0 { 1.0 } else { sum / count as f32 }
}

/// Arrows on a lattice of `spacing` d over the box: as long as the spacing in a strong wind, gone in still air.
pub fn arrows(air: &Air, size: Vec2, spacing: f32, reference: Reference, out: &mut Vec<Streak>) {
    let count = (size / spacing).floor().max(Vec2::ONE).as_uvec2();
    let step = size / count.as_vec2();
    for row in 0..count.y {
        for column in 0..count.x {
            let at = (Vec2::new(column as f32, row as f32) + 0.5) * step;
            let velocity = air.sample_velocity(at);
            let strength = 6.0 * velocity.length() / reference.wind;
            let length = 1.2 * spacing * strength / (1.0 + strength);
            if length > 0.08 * spacing {
                let half = velocity.normalize_or_zero() * length * 0.5;
                let opacity = 90.0 + 165.0 * strength / (1.0 + strength);
                out.push(streak(at - half, at + half, [222, 246, 240, opacity as u8]));
            }
        }
    }
}
