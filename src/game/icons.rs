//! Icons drawn with the painter: sharp at any scale, in any colour, no files. An icon is a function; a table row names one
//! of these or brings its own.

use bevy_egui::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, pos2, vec2};

/// Draws an icon.
pub type Icon = fn(&Pen<'_>);

/// Draws an icon into the square in the middle of `rect`.
pub fn draw(painter: &Painter, rect: Rect, icon: Icon, colour: Color32) {
    let side = rect.width().min(rect.height());
    icon(&Pen { painter, origin: rect.center() - Vec2::splat(side / 2.0), side, colour });
}

/// Draws in a unit square with y down.
pub struct Pen<'a> {
    painter: &'a Painter,
    origin: Pos2,
    side: f32,
    colour: Color32,
}

impl Pen<'_> {
    /// A point, from the upper left corner.
    pub fn at(&self, x: f32, y: f32) -> Pos2 {
        self.origin + vec2(x, y) * self.side
    }

    fn stroke(&self, width: f32) -> Stroke {
        Stroke::new((width * self.side).max(1.0), self.colour)
    }

    fn points(&self, points: &[(f32, f32)]) -> Vec<Pos2> {
        points.iter().map(|&(x, y)| self.at(x, y)).collect()
    }

    /// Fills a convex outline.
    pub fn fill(&self, points: &[(f32, f32)]) {
        self.fill_in(self.colour, points);
    }

    /// Fills a convex outline in another colour.
    fn fill_in(&self, colour: Color32, points: &[(f32, f32)]) {
        self.painter.add(Shape::convex_polygon(self.points(points), colour, Stroke::NONE));
    }

    /// Fills a disc.
    pub fn disc(&self, x: f32, y: f32, radius: f32) {
        self.painter.circle_filled(self.at(x, y), radius * self.side, self.colour);
    }

    /// Draws a line through points.
    pub fn line(&self, points: &[(f32, f32)], width: f32) {
        self.painter.add(Shape::line(self.points(points), self.stroke(width)));
    }

    /// Fills a rectangle.
    pub fn bar(&self, x: f32, y: f32, width: f32, height: f32) {
        let rect = Rect::from_min_size(self.at(x, y), vec2(width, height) * self.side);
        self.painter.rect_filled(rect, self.side * 0.04, self.colour);
    }

    /// Points on an arc; angles in turns, 0 to the right, growing clockwise.
    pub fn arc(&self, x: f32, y: f32, radius: f32, from: f32, to: f32) -> Vec<(f32, f32)> {
        let steps = 18;
        (0..=steps)
            .map(|k| {
                let (sin, cos) = sin_cos(from + (to - from) * k as f32 / steps as f32);
                (x + radius * cos, y + radius * sin)
            })
            .collect()
    }

    /// An arrow that bends back, to the left (1) or to the right (−1).
    fn bow(&self, way: f32) {
        let x = |x: f32| 0.5 + (x - 0.5) * way;
        self.line(
            &[
                (x(0.3), 0.36),
                (x(0.6), 0.36),
                (x(0.76), 0.42),
                (x(0.82), 0.56),
                (x(0.76), 0.7),
                (x(0.6), 0.76),
                (x(0.36), 0.76),
            ],
            0.1,
        );
        self.fill(&[(x(0.1), 0.36), (x(0.36), 0.14), (x(0.36), 0.58)]);
    }

    /// The box and the cone of a loudspeaker.
    fn loudspeaker(&self) {
        self.bar(0.06, 0.36, 0.2, 0.28);
        self.fill(&[(0.22, 0.4), (0.5, 0.14), (0.5, 0.86), (0.22, 0.6)]);
    }

    /// A tray with an arrow into it (1) or out of it (−1).
    fn tray(&self, way: f32) {
        self.line(&[(0.14, 0.6), (0.14, 0.86), (0.86, 0.86), (0.86, 0.6)], 0.1);
        let y = |y: f32| 0.38 + (y - 0.38) * way;
        self.line(&[(0.5, y(0.1)), (0.5, y(0.44))], 0.1);
        self.fill(&[(0.5, y(0.7)), (0.28, y(0.4)), (0.72, y(0.4))]);
    }
}

/// The arrow of the key Enter.
pub fn enter(pen: &Pen<'_>) {
    pen.line(&[(0.9, 0.14), (0.9, 0.62), (0.3, 0.62)], 0.12);
    pen.fill(&[(0.02, 0.62), (0.38, 0.34), (0.38, 0.9)]);
}

/// A drop of something.
pub fn droplet(pen: &Pen<'_>) {
    // A disc with a point on top: the tangents from the point touch it 30° above its middle line.
    let mut outline = vec![(0.5, 0.08)];
    outline.extend(pen.arc(0.5, 0.6, 0.29, -0.07, 0.57));
    pen.fill(&outline);
    let shine = pen.colour.lerp_to_gamma(Color32::WHITE, 0.55);
    let points = pen.points(&pen.arc(0.5, 0.6, 0.18, 0.3, 0.45));
    pen.painter.add(Shape::line(points, Stroke::new((0.07 * pen.side).max(1.0), shine)));
}

/// A cloud.
pub fn cloud(pen: &Pen<'_>) {
    pen.disc(0.3, 0.62, 0.19);
    pen.disc(0.52, 0.44, 0.25);
    pen.disc(0.74, 0.6, 0.2);
    pen.bar(0.3, 0.6, 0.44, 0.2);
    let shine = pen.colour.lerp_to_gamma(Color32::WHITE, 0.4);
    let points = pen.points(&pen.arc(0.52, 0.44, 0.16, 0.5, 0.72));
    pen.painter.add(Shape::line(points, Stroke::new((0.07 * pen.side).max(1.0), shine)));
}

/// A piece of stone.
pub fn stone(pen: &Pen<'_>) {
    pen.fill(&[(0.1, 0.72), (0.2, 0.38), (0.46, 0.2), (0.74, 0.28), (0.92, 0.6), (0.84, 0.8), (0.2, 0.82)]);
    let light = pen.colour.lerp_to_gamma(Color32::WHITE, 0.28);
    pen.fill_in(light, &[(0.2, 0.38), (0.46, 0.2), (0.74, 0.28), (0.54, 0.46)]);
    let dark = pen.colour.lerp_to_gamma(Color32::BLACK, 0.3);
    pen.fill_in(dark, &[(0.54, 0.46), (0.74, 0.28), (0.92, 0.6), (0.84, 0.8), (0.6, 0.81)]);
}

/// A heap of grains, as steep as dry sand stands: 34°. It is so flat that it takes all the width, and a bit more.
pub fn heap(pen: &Pen<'_>) {
    pen.fill(&[(-0.06, 0.86), (0.5, 0.48), (1.06, 0.86)]);
    for (x, y) in [(0.5, 0.5), (0.35, 0.6), (0.65, 0.6), (0.2, 0.7), (0.8, 0.7), (0.06, 0.8), (0.94, 0.8)] {
        pen.disc(x, y, 0.085);
    }
    pen.disc(0.47, 0.12, 0.065);
    pen.disc(0.55, 0.28, 0.065);
    let light = pen.colour.lerp_to_gamma(Color32::WHITE, 0.4);
    let dark = pen.colour.lerp_to_gamma(Color32::BLACK, 0.35);
    for (colour, grains) in
        [(light, [(0.47, 0.56), (0.27, 0.72), (0.62, 0.73)]), (dark, [(0.44, 0.73), (0.78, 0.76), (0.63, 0.6)])]
    {
        for (x, y) in grains {
            pen.painter.circle_filled(pen.at(x, y), 0.065 * pen.side, colour);
        }
    }
}

/// All there is: dots in rows.
pub fn all(pen: &Pen<'_>) {
    for (row, column) in (0..9).map(|k| (k / 3, k % 3)) {
        pen.disc(0.2 + 0.3 * column as f32, 0.2 + 0.3 * row as f32, 0.1);
    }
}

/// Wind.
pub fn wind(pen: &Pen<'_>) {
    for (y, end, radius) in [(0.34, 0.6, 0.13), (0.52, 0.74, 0.15), (0.7, 0.46, 0.11)] {
        let (turn, way) = if y < 0.6 { (0.25, -1.0) } else { (-0.25, 1.0) };
        let mut path = vec![(0.08, y)];
        path.extend(pen.arc(end, y + way * radius, radius, turn, turn + way * 0.62));
        pen.line(&path, 0.085);
    }
}

/// Pressure: arrows from a middle.
pub fn pressure(pen: &Pen<'_>) {
    pen.disc(0.5, 0.5, 0.1);
    for turn in [0.125, 0.375, 0.625, 0.875] {
        let (sin, cos) = sin_cos(turn);
        let point = |along: f32, across: f32| (0.5 + cos * along - sin * across, 0.5 + sin * along + cos * across);
        pen.line(&[point(0.2, 0.0), point(0.4, 0.0)], 0.085);
        pen.fill(&[point(0.52, 0.0), point(0.34, 0.13), point(0.34, -0.13)]);
    }
}

/// A flame.
pub fn flame(pen: &Pen<'_>) {
    // Three tongues from one body.
    pen.fill(&[(0.4, 0.04), (0.6, 0.26), (0.72, 0.5), (0.4, 0.56), (0.38, 0.3)]);
    pen.fill(&[(0.2, 0.36), (0.34, 0.5), (0.3, 0.66), (0.18, 0.6)]);
    pen.fill(&[(0.72, 0.5), (0.82, 0.36), (0.86, 0.6), (0.76, 0.7)]);
    let body =
        [(0.18, 0.58), (0.4, 0.5), (0.72, 0.48), (0.86, 0.58), (0.82, 0.76), (0.66, 0.92), (0.36, 0.92), (0.2, 0.76)];
    pen.fill(&body);
    let inner = pen.colour.lerp_to_gamma(Color32::BLACK, 0.5);
    pen.fill_in(inner, &[(0.54, 0.52), (0.66, 0.68), (0.62, 0.82), (0.52, 0.86), (0.42, 0.82), (0.4, 0.7)]);
}

/// A flask with something in it.
pub fn flask(pen: &Pen<'_>) {
    pen.line(&[(0.36, 0.08), (0.64, 0.08)], 0.09);
    pen.line(
        &[(0.42, 0.1), (0.42, 0.4), (0.16, 0.84), (0.24, 0.92), (0.76, 0.92), (0.84, 0.84), (0.58, 0.4), (0.58, 0.1)],
        0.08,
    );
    pen.fill(&[(0.34, 0.6), (0.66, 0.6), (0.78, 0.86), (0.22, 0.86)]);
}

/// A thermometer.
pub fn thermometer(pen: &Pen<'_>) {
    pen.line(&pen.arc(0.42, 0.18, 0.12, -0.5, 0.0), 0.08);
    pen.line(&[(0.3, 0.18), (0.3, 0.62)], 0.08);
    pen.line(&[(0.54, 0.18), (0.54, 0.62)], 0.08);
    pen.line(&pen.arc(0.42, 0.76, 0.19, -0.14, 0.64), 0.08);
    pen.disc(0.42, 0.76, 0.11);
    pen.bar(0.38, 0.36, 0.08, 0.4);
    for y in [0.2, 0.36, 0.52] {
        pen.bar(0.66, y - 0.03, 0.16, 0.07);
    }
}

/// A match that burns.
pub fn burning_match(pen: &Pen<'_>) {
    pen.line(&[(0.14, 0.94), (0.56, 0.5)], 0.1);
    let mut outline = vec![(0.74, 0.02)];
    outline.extend(pen.arc(0.64, 0.4, 0.2, -0.04, 0.56));
    pen.fill(&outline);
    let inner = pen.colour.lerp_to_gamma(Color32::BLACK, 0.5);
    pen.fill_in(inner, &[(0.68, 0.26), (0.73, 0.42), (0.64, 0.52), (0.55, 0.44)]);
}

/// An eraser.
pub fn eraser(pen: &Pen<'_>) {
    pen.fill(&[(0.56, 0.16), (0.86, 0.42), (0.66, 0.64), (0.36, 0.38)]);
    let pale = pen.colour.gamma_multiply(0.55);
    pen.fill_in(pale, &[(0.33, 0.415), (0.63, 0.675), (0.5, 0.82), (0.34, 0.82), (0.16, 0.66), (0.16, 0.6)]);
    pen.line(&[(0.5, 0.86), (0.9, 0.86)], 0.08);
}

/// Run.
pub fn play(pen: &Pen<'_>) {
    pen.fill(&[(0.28, 0.16), (0.84, 0.5), (0.28, 0.84)]);
}

/// Stop.
pub fn pause(pen: &Pen<'_>) {
    pen.bar(0.24, 0.18, 0.18, 0.64);
    pen.bar(0.58, 0.18, 0.18, 0.64);
}

/// One tick.
pub fn step(pen: &Pen<'_>) {
    pen.fill(&[(0.18, 0.18), (0.64, 0.5), (0.18, 0.82)]);
    pen.bar(0.68, 0.18, 0.14, 0.64);
}

/// More.
pub fn plus(pen: &Pen<'_>) {
    pen.bar(0.44, 0.22, 0.12, 0.56);
    minus(pen);
}

/// Less.
pub fn minus(pen: &Pen<'_>) {
    pen.bar(0.22, 0.44, 0.56, 0.12);
}

/// Back to the start.
pub fn reset(pen: &Pen<'_>) {
    let radius = 0.34;
    pen.line(&pen.arc(0.5, 0.52, radius, -0.12, 0.66), 0.1);
    let (sin, cos) = sin_cos(-0.12);
    let (x, y) = (0.5 + radius * cos, 0.52 + radius * sin);
    pen.fill(&[(x - 0.2, y + 0.04), (x + 0.13, y + 0.1), (x + 0.06, y - 0.24)]);
}

/// Take back.
pub fn undo(pen: &Pen<'_>) {
    pen.bow(1.0);
}

/// Make again.
pub fn redo(pen: &Pen<'_>) {
    pen.bow(-1.0);
}

/// Scenes.
pub fn scenes(pen: &Pen<'_>) {
    for (x, y) in [(0.14, 0.16), (0.54, 0.16), (0.14, 0.54), (0.54, 0.54)] {
        pen.bar(x, y, 0.32, 0.3);
    }
}

/// Save.
pub fn save(pen: &Pen<'_>) {
    pen.tray(1.0);
}

/// Load.
pub fn load(pen: &Pen<'_>) {
    pen.tray(-1.0);
}

/// Views.
pub fn eye(pen: &Pen<'_>) {
    let mut outline = pen.arc(0.5, 0.86, 0.52, -0.39, -0.11);
    outline.extend(pen.arc(0.5, 0.14, 0.52, 0.11, 0.39));
    outline.push(outline[0]);
    pen.line(&outline, 0.08);
    pen.disc(0.5, 0.5, 0.14);
}

/// Quality.
pub fn gauge(pen: &Pen<'_>) {
    pen.line(&pen.arc(0.5, 0.6, 0.38, -0.55, 0.05), 0.1);
    pen.line(&[(0.5, 0.6), (0.7, 0.36)], 0.09);
    pen.disc(0.5, 0.6, 0.08);
}

/// Sound: a loudspeaker.
pub fn sound(pen: &Pen<'_>) {
    pen.loudspeaker();
    pen.line(&pen.arc(0.5, 0.5, 0.2, -0.13, 0.13), 0.09);
    pen.line(&pen.arc(0.5, 0.5, 0.38, -0.14, 0.14), 0.09);
}

/// No sound: a loudspeaker, and a cross.
pub fn muted(pen: &Pen<'_>) {
    pen.loudspeaker();
    pen.line(&[(0.64, 0.36), (0.92, 0.64)], 0.09);
    pen.line(&[(0.64, 0.64), (0.92, 0.36)], 0.09);
}

/// Settings.
pub fn gear(pen: &Pen<'_>) {
    pen.painter.circle_stroke(pen.at(0.5, 0.5), 0.23 * pen.side, pen.stroke(0.13));
    for k in 0..8 {
        let (sin, cos) = sin_cos(k as f32 / 8.0);
        pen.line(&[(0.5 + 0.27 * cos, 0.5 + 0.27 * sin), (0.5 + 0.42 * cos, 0.5 + 0.42 * sin)], 0.13);
    }
}

/// Back in time.
pub fn rewind(pen: &Pen<'_>) {
    for x in [0.06, 0.48] {
        pen.fill(&[(x, 0.5), (x + 0.44, 0.18), (x + 0.44, 0.82)]);
    }
}

/// Statistics.
pub fn chart(pen: &Pen<'_>) {
    for (x, height) in [(0.14, 0.34), (0.42, 0.7), (0.7, 0.5)] {
        pen.bar(x, 0.86 - height, 0.17, height);
    }
}

/// Error against time.
pub fn curve(pen: &Pen<'_>) {
    pen.line(&[(0.14, 0.1), (0.14, 0.86), (0.92, 0.86)], 0.09);
    pen.line(&[(0.26, 0.18), (0.34, 0.46), (0.52, 0.62), (0.9, 0.7)], 0.09);
    pen.disc(0.44, 0.56, 0.12);
}

/// A curve on a screen.
pub fn trace(pen: &Pen<'_>) {
    let corners = [(0.06, 0.12), (0.94, 0.12), (0.94, 0.88), (0.06, 0.88), (0.06, 0.12)];
    pen.line(&corners, 0.08);
    pen.line(&[(0.2, 0.56), (0.34, 0.56), (0.46, 0.3), (0.6, 0.7), (0.68, 0.5), (0.82, 0.5)], 0.08);
}

/// Two halves.
pub fn split(pen: &Pen<'_>) {
    let square = Rect::from_center_size(pen.at(0.5, 0.5), vec2(pen.side * 0.8, pen.side * 0.64));
    pen.painter.rect_stroke(square, pen.side * 0.06, pen.stroke(0.08), StrokeKind::Middle);
    pen.line(&[(0.5, 0.18), (0.5, 0.82)], 0.08);
    pen.bar(0.5, 0.18, 0.4, 0.64);
}

/// A magnifying glass.
pub fn lens(pen: &Pen<'_>) {
    pen.line(&pen.arc(0.42, 0.42, 0.29, 0.0, 1.0), 0.1);
    pen.line(&[(0.64, 0.64), (0.9, 0.9)], 0.13);
}

/// Help.
pub fn question(pen: &Pen<'_>) {
    let mut hook = pen.arc(0.5, 0.34, 0.19, -0.5, 0.14);
    hook.extend([(0.5, 0.55), (0.5, 0.64)]);
    pen.line(&hook, 0.11);
    pen.disc(0.5, 0.82, 0.07);
}

/// Round brush.
pub fn round_brush(pen: &Pen<'_>) {
    pen.painter.circle_stroke(pen.at(0.5, 0.5), pen.side * 0.36, pen.stroke(0.09));
}

/// Square brush.
pub fn square_brush(pen: &Pen<'_>) {
    let square = Rect::from_center_size(pen.at(0.5, 0.5), Vec2::splat(pen.side * 0.68));
    pen.painter.rect_stroke(square, pen.side * 0.08, pen.stroke(0.09), StrokeKind::Middle);
}

/// A check mark.
pub fn check(pen: &Pen<'_>) {
    pen.line(&[(0.12, 0.52), (0.4, 0.8), (0.88, 0.22)], 0.13);
}

/// A shield.
pub fn shield(pen: &Pen<'_>) {
    pen.line(&[(0.5, 0.04), (0.88, 0.2), (0.84, 0.56), (0.5, 0.96), (0.16, 0.56), (0.12, 0.2), (0.5, 0.04)], 0.1);
}

/// A cross: close, or wrong.
pub fn close(pen: &Pen<'_>) {
    pen.line(&[(0.2, 0.2), (0.8, 0.8)], 0.11);
    pen.line(&[(0.2, 0.8), (0.8, 0.2)], 0.11);
}

/// Sine and cosine of an angle in turns.
fn sin_cos(turns: f32) -> (f32, f32) {
    bevy::math::ops::sin_cos(turns * std::f32::consts::TAU)
}

/// A square of `side` points at a place.
pub fn square(centre: Pos2, side: f32) -> Rect {
    Rect::from_center_size(pos2(centre.x, centre.y), Vec2::splat(side))
}
