//! Icons of editing: what the brush does to what is there, and stamps.

use crate::game::icons::Pen;

/// A circle that is not filled.
fn ring(pen: &Pen<'_>, x: f32, y: f32, radius: f32, width: f32) {
    pen.line(&pen.arc(x, y, radius, 0.0, 1.0), width);
}

/// Into free room: a drop beside an empty place.
pub fn draw_free(pen: &Pen<'_>) {
    pen.disc(0.3, 0.5, 0.22);
    ring(pen, 0.74, 0.5, 0.18, 0.08);
}

/// One thing in the place of another: two arrows that go round.
pub fn replace(pen: &Pen<'_>) {
    for way in [1.0, -1.0] {
        let at = |x: f32, y: f32| (0.5 + way * (x - 0.5), 0.5 + way * (y - 0.5));
        pen.line(&[at(0.1, 0.5), at(0.1, 0.3), at(0.66, 0.3)], 0.1);
        pen.fill(&[at(0.96, 0.3), at(0.64, 0.08), at(0.64, 0.52)]);
    }
}

/// One thing out of others: a drop that is struck out between two.
pub fn erase_only(pen: &Pen<'_>) {
    pen.disc(0.5, 0.5, 0.2);
    ring(pen, 0.1, 0.5, 0.1, 0.07);
    ring(pen, 0.9, 0.5, 0.1, 0.07);
    pen.line(&[(0.22, 0.86), (0.78, 0.14)], 0.09);
}

/// What flows on: drops below an outlet.
pub fn spring(pen: &Pen<'_>) {
    pen.line(&[(0.12, 0.1), (0.12, 0.34), (0.88, 0.34), (0.88, 0.1)], 0.1);
    pen.disc(0.5, 0.54, 0.1);
    pen.disc(0.5, 0.82, 0.13);
}

/// A frame with a piece of the world in it.
pub fn stamp(pen: &Pen<'_>) {
    for (x, y) in [(0.12, 0.12), (0.88, 0.12), (0.12, 0.88), (0.88, 0.88)] {
        let (inward, upward) = (x + 0.4 * (0.5 - x), y + 0.4 * (0.5 - y));
        pen.line(&[(inward, y), (x, y), (x, upward)], 0.09);
    }
    pen.bar(0.3, 0.42, 0.4, 0.28);
}

/// One sheet over another.
pub fn copy(pen: &Pen<'_>) {
    pen.line(&[(0.62, 0.3), (0.62, 0.1), (0.1, 0.1), (0.1, 0.66), (0.32, 0.66)], 0.09);
    pen.bar(0.38, 0.38, 0.52, 0.54);
}

/// Scissors.
pub fn cut(pen: &Pen<'_>) {
    ring(pen, 0.26, 0.8, 0.13, 0.09);
    ring(pen, 0.74, 0.8, 0.13, 0.09);
    pen.line(&[(0.34, 0.68), (0.72, 0.06)], 0.1);
    pen.line(&[(0.66, 0.68), (0.28, 0.06)], 0.1);
}

/// A quarter turn to the left.
pub fn turn(pen: &Pen<'_>) {
    pen.line(&pen.arc(0.52, 0.56, 0.32, -0.25, 0.4), 0.1);
    pen.fill(&[(0.2, 0.24), (0.54, 0.02), (0.54, 0.46)]);
}

/// Left and right change places.
pub fn mirror(pen: &Pen<'_>) {
    pen.line(&[(0.5, 0.06), (0.5, 0.94)], 0.07);
    pen.fill(&[(0.38, 0.22), (0.38, 0.78), (0.04, 0.78)]);
    pen.line(&[(0.62, 0.22), (0.62, 0.78), (0.96, 0.78), (0.62, 0.22)], 0.07);
}

/// Top and bottom change places.
pub fn flip(pen: &Pen<'_>) {
    pen.line(&[(0.06, 0.5), (0.94, 0.5)], 0.07);
    pen.fill(&[(0.22, 0.38), (0.78, 0.38), (0.78, 0.04)]);
    pen.line(&[(0.22, 0.62), (0.78, 0.62), (0.78, 0.96), (0.22, 0.62)], 0.07);
}

/// A cup for who wins.
pub fn cup(pen: &Pen<'_>) {
    pen.fill(&[(0.28, 0.12), (0.72, 0.12), (0.66, 0.5), (0.5, 0.62), (0.34, 0.5)]);
    pen.line(&[(0.28, 0.2), (0.1, 0.2), (0.14, 0.38), (0.32, 0.46)], 0.08);
    pen.line(&[(0.72, 0.2), (0.9, 0.2), (0.86, 0.38), (0.68, 0.46)], 0.08);
    pen.bar(0.46, 0.58, 0.08, 0.2);
    pen.bar(0.28, 0.78, 0.44, 0.1);
}
