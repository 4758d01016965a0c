//! The plot: one quantity of all gauges over the last half minute.

use crate::{
    game::{
        hud::{gauges::colour, panels::gauges::scale::Scale, style},
        language::spoken,
    },
    kernel::units::TICKS_PER_SECOND,
    lab::gauges::{
        quantity::{Of, Quantity},
        set::{Gauge, Gauges},
    },
};
use bevy_egui::egui::{self, Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use tr::tr;

/// Time that is shown, s.
pub const SECONDS: u32 = 30;
/// The same in ticks.
const TICKS: u64 = (SECONDS * TICKS_PER_SECOND) as u64;
/// Ticks that a line's flow is a mean of: particles cross one by one.
const FLOW: usize = TICKS_PER_SECOND as usize / 2;
/// Ticks that other numbers are a mean of: what changes faster can't be read.
const CALM: usize = TICKS_PER_SECOND as usize / 4;
/// Ticks that one point of a curve stands for.
const BUCKET: u64 = 5;
/// Beside the field: numbers on the left, times below, points.
const LEFT: f32 = 52.0;
const BELOW: f32 = 17.0;

/// Ticks of which a value is shown as a mean.
fn span(quantity: &Quantity) -> usize {
    if matches!(quantity.of, Of::Line(_)) { FLOW } else { CALM }
}

/// What a gauge reads of a quantity at a tick: the mean of the last moment, or nothing if its last reading has none.
pub fn now(gauge: &Gauge, quantity: &Quantity, tick: u64) -> Option<f64> {
    let mut latest = gauge.samples().rev().skip_while(|sample| sample.tick > tick);
    let values = latest.by_ref().take(span(quantity)).map_while(|sample| quantity.value(&sample.reading));
    mean(values)
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (count, sum) = values.fold((0_u32, 0.0), |(count, sum), value| (count + 1, sum + value));
    (count > 0).then(|| sum / f64::from(count))
}

/// The curve of a gauge up to a tick: ticks before it, and values; in pieces, between which there is nothing to measure.
pub fn curve(gauge: &Gauge, quantity: &Quantity, tick: u64) -> Vec<Vec<(f32, f64)>> {
    let first = (tick + 1).saturating_sub(TICKS);
    // Points stand for the same ticks in each frame: else the curve would flicker as it moves on.
    let width = if matches!(quantity.of, Of::Line(_)) { FLOW as u64 } else { BUCKET };
    let mut pieces: Vec<Vec<(f32, f64)>> = vec![Vec::new()];
    let (mut bucket, mut values): (u64, Vec<f64>) = (first / width, Vec::new());
    let mut end = |bucket: u64, values: &mut Vec<f64>| match mean(values.drain(..)) {
        Some(value) => {
            let middle = bucket * width + width / 2;
            let before = (tick as f32 - middle as f32).clamp(0.0, TICKS as f32);
            if let Some(piece) = pieces.last_mut() {
                piece.push((before, value));
            }
        }
        None => pieces.push(Vec::new()),
    };
    for sample in gauge.samples().filter(|sample| (first..=tick).contains(&sample.tick)) {
        if sample.tick / width != bucket {
            end(bucket, &mut values);
            bucket = sample.tick / width;
        }
        values.extend(quantity.value(&sample.reading));
    }
    end(bucket, &mut values);
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// Least length of the axis of a quantity, in its unit.
fn least(quantity: &Quantity) -> f64 {
    match quantity.unit {
        "Pa" => 10.0,
        "kg/m²" => 10.0,
        "°C" => 2.0,
        "m/s" => 0.1,
        _ => 0.01,
    }
}

/// Shows it in a field of `size` points.
pub fn show(ui: &mut Ui, size: egui::Vec2, gauges: &Gauges, quantity: &Quantity, tick: u64, selected: Option<u32>) {
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let field = Rect::from_min_max(rect.min + vec2(LEFT, 4.0), rect.max - vec2(6.0, BELOW));
    let curves: Vec<_> = gauges.iter().map(|gauge| (gauge.number, curve(gauge, quantity, tick))).collect();
    let values = curves.iter().flat_map(|(_, pieces)| pieces.iter().flatten().map(|(_, value)| *value));
    let scale = Scale::around(values, least(quantity));
    let painter = ui.painter_at(rect);
    grid(&painter, field, &scale);
    let at = |(before, value): (f32, f64)| {
        let across = 1.0 - before / TICKS as f32;
        pos2(field.left() + across * field.width(), field.bottom() - scale.share(value) * field.height())
    };
    let inside = painter.with_clip_rect(field.expand(2.0));
    for (number, pieces) in &curves {
        let stands_out = selected == Some(*number);
        for piece in pieces {
            draw(&inside, piece.iter().map(|point| at(*point)).collect(), colour(*number), stands_out);
        }
    }
    if curves.iter().all(|(_, pieces)| pieces.is_empty()) {
        let name = spoken(quantity.name);
        let text = tr!("no {} to show yet", name);
        painter.text(field.center(), Align2::CENTER_CENTER, text, FontId::proportional(12.5), style::WEAK);
    }
    response.on_hover_text(spoken(quantity.about));
}

fn draw(painter: &Painter, points: Vec<Pos2>, colour: Color32, stands_out: bool) {
    if let [point] = points[..] {
        painter.circle_filled(point, 1.8, colour);
        return;
    }
    let width = if stands_out { 2.2 } else { 1.4 };
    let end = points.last().copied();
    painter.add(Shape::line(points, Stroke::new(width, colour)));
    if let Some(end) = end {
        painter.circle_filled(end, if stands_out { 3.2 } else { 2.4 }, colour);
    }
}

fn grid(painter: &Painter, field: Rect, scale: &Scale) {
    painter.rect_filled(field, 4.0, Color32::from_rgb(12, 15, 21));
    let (font, decimals) = (FontId::proportional(style::SMALL), scale.decimals());
    for mark in scale.marks() {
        let y = field.bottom() - scale.share(mark) * field.height();
        let is_zero = mark.abs() < 1e-9 * scale.range().end().abs().max(1e-9);
        let line = if is_zero { style::LINE } else { style::LINE.gamma_multiply(0.5) };
        painter.hline(field.x_range(), y, Stroke::new(1.0, line));
        let text = format!("{:.decimals$}", if is_zero { 0.0 } else { mark });
        painter.text(pos2(field.left() - 5.0, y), Align2::RIGHT_CENTER, text, font.clone(), style::WEAK);
    }
    for seconds in (0..=SECONDS).step_by(10) {
        let x = field.right() - seconds as f32 / SECONDS as f32 * field.width();
        painter.vline(x, field.y_range(), Stroke::new(1.0, style::LINE.gamma_multiply(0.5)));
        let (align, text) = match seconds {
            0 => (Align2::RIGHT_TOP, tr!("now")),
            SECONDS => (Align2::LEFT_TOP, tr!("{} s ago", seconds)),
            _ => (Align2::CENTER_TOP, format!("{seconds} s")),
        };
        painter.text(pos2(x, field.bottom() + 3.0), align, text, font.clone(), style::WEAK);
    }
}
