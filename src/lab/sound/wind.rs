//! The air that moves in view.

use super::{audible::Audible, listener::Listener};
use glam::Vec2;

/// Most places along each axis at which the wind is heard.
const PLACES: usize = 24;

/// What is heard of the wind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Wind {
    /// Mean of the square of its speed where it is heard, m²/s².
    pub(super) square: f32,
    /// Where it blows hardest, −1 … 1.
    pub(super) pan: f32,
}

/// Cells along an axis that are listened to: those in view, or some of them.
pub(super) fn heard_cells(
    centre: f32,
    half: f32,
    cell: f32,
    count: usize,
    most: usize,
) -> impl Iterator<Item = usize> + Clone {
    let at = |edge: f32| ((edge / cell).max(0.0) as usize).min(count);
    let (low, high) = (at(centre - half), at(centre + half + cell).max(1));
    let low = low.min(high - 1);
    let step = (high - low).div_ceil(most).max(1);
    // Even about the middle: a mirrored world is heard at mirrored places.
    let rest = (high - low - 1) % step;
    (low + rest / 2..high).step_by(step)
}

/// Listens to the air in view.
pub(super) fn listen(audible: &Audible, listener: Listener) -> Wind {
    let air = audible.air;
    if air.is_quiet() {
        return Wind::default();
    }
    let spacing = audible.scale.spacing;
    let cell = air.cell() * spacing;
    let half = 0.5 * listener.width;
    let columns = heard_cells(listener.centre.x, half, cell, air.columns(), PLACES);
    let (mut squares, mut sides, mut count) = (0.0, 0.0, 0.0);
    for row in heard_cells(listener.centre.y, half, cell, air.rows(), PLACES) {
        for column in columns.clone() {
            let square = air.velocity_at_cell(column, row).length_squared() * spacing * spacing;
            let at = Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * cell;
            squares += square;
            sides += square * listener.hears(at).pan;
            count += 1.0;
        }
    }
    if squares > 0.0 { Wind { square: squares / count, pan: sides / squares } } else { Wind::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_view_is_heard_evenly() {
        let heard = |centre: f32, half: f32, most: usize| heard_cells(centre, half, 0.5, 40, most).collect::<Vec<_>>();
        assert_eq!(heard(10.0, 1.0, 24), [18, 19, 20, 21, 22]);
        assert_eq!(heard(10.0, 100.0, 4), [4, 14, 24, 34], "as far from either end");
        assert_eq!(heard(-50.0, 1.0, 24).len(), 1, "a view beside the box hears its edge");
        assert!(heard(1e9, 1.0, 24).iter().all(|cell| *cell < 40));
    }
}
