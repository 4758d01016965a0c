//! The air as a picture (one texel a cell, colours laid over the empty box) and as arrows.

use crate::{
    kernel::{air::Air, heat::units::ROOM},
    lab::colours::{Reference, Rgb},
};
use glam::Vec2;

/// Tail and head (four f32) and colour (four bytes) of a streak; the rest is not used.
pub type Streak = [u32; 8];

/// A streak from a tail to a head; the colour's last byte is its opacity.
pub fn streak(tail: Vec2, head: Vec2, colour: [u8; 4]) -> Streak {
    let [from, to] = [tail, head].map(|end| end.to_array().map(f32::to_bits));
    [from[0], from[1], to[0], to[1], u32::from_le_bytes(colour), 0, 0, 0]
}

/// Packs the air's colours by its pressure and velocity, premultiplied by their opacity, row by row from the bottom.
pub fn pack(air: &Air, colour: fn(Reference, f32, Vec2) -> (Rgb, f32), reference: Reference, out: &mut Vec<u8>) {
    out.clear();
    for row in 0..air.rows() {
        let velocity = air.velocity_x_row(row).iter().zip(air.velocity_y_row(row));
        for (column, (&u, &v)) in velocity.enumerate() {
            let pressure = open_at(air, [column, row], 1.0, Air::pressing_at_cell);
            push(colour(reference, pressure, Vec2::new(u, v)), out);
        }
    }
}

/// Packs its colours by its temperature (K) in the same way; nothing where all of it is as warm as the room.
pub fn pack_warmth(air: &Air, colour: fn(f32) -> (Rgb, f32), out: &mut Vec<u8>) {
    out.clear();
    if !air.is_warm() {
        return;
    }
    for row in 0..air.rows() {
        for column in 0..air.columns() {
            push(colour(open_at(air, [column, row], ROOM, Air::kelvin_at_cell)), out);
        }
    }
}

/// Adds a texel.
fn push((rgb, opacity): (Rgb, f32), out: &mut Vec<u8>) {
    out.extend(rgb.map(|channel| (f32::from(channel) * opacity) as u8));
    out.push((255.0 * opacity) as u8);
}

/// What there is at a cell; in rock the mean of the open cells beside it, so that the picture doesn't fade towards rock, or `none`
/// where none is.
fn open_at(air: &Air, [column, row]: [usize; 2], none: f32, of: impl Fn(&Air, usize, usize) -> f32) -> f32 {
    if !air.is_solid_cell(column, row) {
        return of(air, column, row);
    }
    let beside = [(column.wrapping_sub(1), row), (column + 1, row), (column, row.wrapping_sub(1)), (column, row + 1)];
    let open = beside.into_iter().filter(|&(c, r)| c < air.columns() && r < air.rows() && !air.is_solid_cell(c, r));
    let (sum, count) = open.fold((0.0, 0), |(sum, count), (c, r)| (sum + of(air, c, r), count + 1));
    if count == 0 { none } else { sum / count as f32 }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        game::views::table::{Layer, TEMPERATURE},
        kernel::{
            air::Contact,
            element::ElementId,
            params::{AirParams, OpenSides},
            solids::Solids,
        },
    };
    use glam::IVec2;

    #[test]
    fn air_that_is_warm_is_seen_where_it_is_and_that_of_the_room_is_not_even_packed() {
        let Layer::Warmth(colour) = TEMPERATURE.air else { panic!("the view of temperature shows the air's") };
        let params = AirParams { sound_speed: 80.0, density: 1.2, open: OpenSides::default() };
        let mut air = Air::new(Vec2::new(24.0, 16.0), 4.0, params);
        let mut texels = vec![7; 3];
        pack_warmth(&air, colour, &mut texels);
        assert!(texels.is_empty(), "no air is warm");
        let mut solids = Solids::new(24, 16);
        (0..4).for_each(|x| assert!((0..4).all(|y| solids.insert(IVec2::new(x, y), ElementId(0), 0))));
        air.set_solids(&solids);
        let contact = Contact { at: Vec2::new(6.0, 2.0), conductance: 1e9, kelvin: 800.0 };
        air.warm_up([contact].into_iter(), &solids);
        pack_warmth(&air, colour, &mut texels);
        assert_eq!(texels.len(), 4 * air.columns() * air.rows());
        let opacity = |column: usize, row: usize| texels[4 * (row * air.columns() + column) + 3];
        assert!(opacity(1, 0) > 150 && opacity(0, 0) > 60, "hot air, and the rock beside it: {texels:?}");
        assert_eq!([opacity(3, 0), opacity(1, 2), opacity(5, 3)], [0; 3]);
        assert!(texels[4] > texels[6], "it is red more than blue");
    }
}
