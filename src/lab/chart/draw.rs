//! Draws a chart. All is placed in pixels on axes that are linear in what they show: values or their logarithms.

use super::types::{Axis, Chart, Look, Point, Scale, Series};
use crate::{lab::picture::write_png, sim::numbers};
use plotters::{
    coord::{
        Shift,
        ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter},
        types::RangedCoordf64,
    },
    element::DashedPathElement,
    prelude::*,
    style::{
        FontStyle, register_font,
        text_anchor::{HPos, Pos, VPos},
    },
};
use std::{
    io::{self, Write},
    ops::Range,
};

/// Size of the SVG, and of the PNG at a scale of 1, pixels.
const SIZE: (u32, u32) = (880, 560);

/// Font families by preference. The first is the one that is measured, and the one in the PNG.
const FAMILY: &str = "Ubuntu Light, Ubuntu, Helvetica, Arial, sans-serif";

/// Height of a line of words, pixels.
const WORDS: f64 = 16.0;

/// Colours of series, told apart by the colour-blind, too (after Okabe & Ito 2008), dark enough for words on white.
const HUES: [u32; 7] = [0x0072b2, 0xd55e00, 0x008a64, 0xb5568c, 0x333333, 0xb07800, 0x2f8fc4];
const INK: RGBColor = rgb(0x22262a);
const PALE_INK: RGBColor = rgb(0x5c6670);
const FAINT: RGBColor = rgb(0x8a939b);
const FRONT: RGBColor = rgb(0xc3ccd4);
const GRID: RGBColor = rgb(0xdfe3e6);
const FINE_GRID: RGBColor = rgb(0xf1f3f4);

const fn rgb(hex: u32) -> RGBColor {
    let [_, red, green, blue] = hex.to_be_bytes();
    RGBColor(red, green, blue)
}

impl Chart {
    /// The chart as SVG. Equal charts give equal bytes.
    ///
    /// # Errors
    /// If it can't be drawn.
    pub fn svg(&self) -> io::Result<String> {
        let mut text = String::new();
        self.draw(SVGBackend::with_string(&mut text, SIZE), 1.0).map_err(io::Error::other)?;
        Ok(text)
    }

    /// Writes the chart as PNG, `scale` pixels for each of the SVG's.
    ///
    /// # Errors
    /// If it can't be drawn or written.
    pub fn write_png(&self, out: impl Write, scale: u8) -> io::Result<()> {
        let (width, height) = (u32::from(scale) * SIZE.0, u32::from(scale) * SIZE.1);
        let mut pixels = vec![0; 3 * (width * height) as usize];
        let backend = BitMapBackend::with_buffer(&mut pixels, (width, height));
        self.draw(backend, f64::from(scale)).map_err(io::Error::other)?;
        write_png(out, width, height, &pixels)
    }

    fn draw<DB: DrawingBackend>(&self, backend: DB, unit: f64) -> Outcome<DB> {
        // The font is the program's own, so that words are as wide everywhere. Without it there is a chart without words.
        let _ = register_font(FAMILY, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
        let paper = Paper { area: backend.into_drawing_area(), unit };
        paper.area.fill(&WHITE)?;
        paper.text(&self.title, (18.0, 28.0), 24.0, INK, HPos::Left)?;
        paper.text(&self.subtitle, (18.0, 52.0), WORDS, PALE_INK, HPos::Left)?;
        let [x, y] = self.spans();
        // Viewers of an SVG may show a wider font than the one that is measured.
        let legend = 60.0 + 1.06 * self.series.iter().map(|series| paper.width(&series.name)).fold(0.0, f64::max);
        let mut plot = ChartBuilder::on(&paper.area)
            .margin_top(paper.px(70.0))
            .margin_right(paper.px(legend))
            .margin_bottom(paper.px(10.0))
            .margin_left(paper.px(10.0))
            .x_label_area_size(paper.px(50.0))
            .y_label_area_size(paper.px(70.0))
            .build_cartesian_2d(x.clone(), y.clone())?;
        plot.configure_mesh()
            .x_desc(self.x.label.as_str())
            .y_desc(self.y.label.as_str())
            .label_style((FAMILY, WORDS * unit, &PALE_INK))
            .axis_desc_style((FAMILY, 17.0 * unit, &INK))
            .bold_line_style(paper.stroke(GRID, 1.0))
            .light_line_style(paper.stroke(FINE_GRID, 1.0))
            .axis_style(paper.stroke(FAINT, 1.0))
            .draw()?;
        let pixel = |point: &Point| Some(plot.backend_coord(&(x.place(point.x)?, y.place(point.y)?)));
        let left = f64::from(SIZE.0) - legend + 14.0;
        for (row, (series, pen)) in self.series.iter().zip(self.pens()).enumerate() {
            for run in series.points.split(|point| pixel(point).is_none()) {
                paper.line(pen, run.iter().filter_map(pixel).collect())?;
            }
            for point in &series.points {
                let Some(at) = pixel(point) else { continue };
                let bar = |from, to| paper.area.draw(&PathElement::new([from, to], paper.stroke(pen.colour, 1.0)));
                if let Some([low, high]) = point.x_range {
                    let end = |value| (plot.backend_coord(&(x.nearest(value), y.low)).0, at.1);
                    bar(end(low), end(high))?;
                }
                if let Some([low, high]) = point.y_range {
                    let end = |value| (at.0, plot.backend_coord(&(x.low, y.nearest(value))).1);
                    bar(end(low), end(high))?;
                }
                paper.marker(pen, at)?;
            }
            paper.legend(pen, &series.name, left, row)?;
        }
        let points = self.series.iter().flat_map(|series| &series.points);
        paper.note(points.filter(|point| pixel(point).is_none()).count())?;
        paper.area.present()
    }

    /// The axes over all that is shown.
    fn spans(&self) -> [Span; 2] {
        let points = || self.series.iter().flat_map(|series| &series.points);
        let along_x = points().flat_map(|point| [[point.x; 2], point.x_range.unwrap_or([point.x; 2])]).flatten();
        let along_y = points().flat_map(|point| [[point.y; 2], point.y_range.unwrap_or([point.y; 2])]).flatten();
        [Span::new(&self.x, along_x), Span::new(&self.y, along_y)]
    }

    /// How each series is drawn.
    fn pens(&self) -> Vec<Pen> {
        let (mut hues, mut faint) = (0, 0);
        let pen = |series: &Series| {
            let look = series.look;
            hues += usize::from(matches!(look, Look::Scatter | Look::Line));
            faint += usize::from(look == Look::Faint);
            let colour = match look {
                Look::Front => FRONT,
                Look::Cloud | Look::Faint => FAINT,
                Look::Scatter | Look::Line | Look::Dashed => rgb(HUES[(hues + HUES.len() - 1) % HUES.len()]),
            };
            Pen { look, colour, shape: faint % 4 }
        };
        self.series.iter().map(pen).collect()
    }
}

/// What drawing on a backend comes to.
type Outcome<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// How a series is drawn.
#[derive(Clone, Copy)]
struct Pen {
    look: Look,
    colour: RGBColor,
    shape: usize,
}

/// Where a chart is drawn, `unit` pixels for each of the SVG's.
struct Paper<DB: DrawingBackend> {
    area: DrawingArea<DB, Shift>,
    unit: f64,
}

impl<DB: DrawingBackend> Paper<DB> {
    fn px(&self, length: f64) -> i32 {
        (length * self.unit).round() as i32
    }

    fn stroke(&self, colour: RGBColor, width: f64) -> ShapeStyle {
        colour.stroke_width((width * self.unit).round() as u32)
    }

    fn width(&self, words: &str) -> f64 {
        let style = TextStyle::from((FAMILY, WORDS * self.unit));
        self.area.estimate_text_size(words, &style).map_or(0.0, |(width, _)| f64::from(width) / self.unit)
    }

    /// Words whose middle is at a height.
    fn text(&self, words: &str, (x, y): (f64, f64), size: f64, colour: RGBColor, side: HPos) -> Outcome<DB> {
        let style = TextStyle::from((FAMILY, size * self.unit)).color(&colour).pos(Pos::new(side, VPos::Center));
        if words.is_empty() { Ok(()) } else { self.area.draw_text(words, &style, (self.px(x), self.px(y))) }
    }

    /// An entry of the legend.
    fn legend(&self, pen: Pen, name: &str, left: f64, row: usize) -> Outcome<DB> {
        let middle = 84.0 + 21.0 * row as f64;
        let sample = |x: f64| (self.px(left + x), self.px(middle));
        self.line(pen, vec![sample(0.0), sample(24.0)])?;
        self.marker(pen, sample(12.0))?;
        self.text(name, (left + 32.0, middle), WORDS, INK, HPos::Left)
    }

    /// Says how many values are not shown.
    fn note(&self, left_out: usize) -> Outcome<DB> {
        let note = match left_out {
            0 => String::new(),
            1 => "1 value has no place on these axes".to_owned(),
            count => format!("{count} values have no place on these axes"),
        };
        let corner = (f64::from(SIZE.0) - 18.0, f64::from(SIZE.1) - 14.0);
        self.text(&note, corner, 14.0, PALE_INK, HPos::Right)
    }

    /// The line of a series.
    fn line(&self, Pen { look, colour, .. }: Pen, points: Vec<(i32, i32)>) -> Outcome<DB> {
        let width = match look {
            Look::Cloud | Look::Scatter => return Ok(()),
            Look::Front => 7.0,
            Look::Faint => 1.0,
            Look::Line | Look::Dashed => 2.0,
        };
        let style = self.stroke(colour, width);
        match look {
            _ if points.len() < 2 => Ok(()),
            Look::Dashed => self.area.draw(&DashedPathElement::new(points, self.px(6.0), self.px(4.0), style)),
            _ => self.area.draw(&PathElement::new(points, style)),
        }
    }

    /// A marker of a series.
    fn marker(&self, Pen { look, colour, shape }: Pen, at: (i32, i32)) -> Outcome<DB> {
        let circle = |radius: f64, style: ShapeStyle| self.area.draw(&Circle::new(at, self.px(radius), style));
        let line = self.stroke(colour, 1.4);
        match (look, shape) {
            (Look::Front, _) => Ok(()),
            (Look::Cloud, _) => circle(3.0, colour.filled()),
            (Look::Faint, 1) => self.area.draw(&TriangleMarker::new(at, self.px(5.0), colour.filled())),
            (Look::Faint, 2) => self.area.draw(&Cross::new(at, self.px(4.0), line)),
            (Look::Dashed, _) | (Look::Faint, 3) => {
                circle(4.0, WHITE.filled())?;
                circle(4.0, line)
            }
            _ => circle(4.0, colour.filled()),
        }
    }
}

/// An axis over values, in its own unit: the values or their logarithms.
#[derive(Clone)]
struct Span {
    scale: Scale,
    low: f64,
    high: f64,
}

impl Span {
    fn new(&Axis { scale, range, .. }: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let places = |values: &mut dyn Iterator<Item = f64>| {
            let places = values.filter_map(|value| scale.place(value));
            places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| (low.min(place), high.max(place)))
        };
        let (low, high) = match range {
            Some((low, high)) => places(&mut [low, high].into_iter()),
            None => places(&mut { values }),
        };
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        // Some room around what is there; on a logarithmic axis enough for a mark with a label in any case.
        let around = if range.is_some() { 0.0 } else { 0.04 * (high - low) };
        let least = if scale == Scale::Logarithmic { 0.5 * (0.31 - (high - low)) } else { 0.0 };
        let room = if low < high { around.max(least) } else { least.max(0.01 * high.abs()).max(0.01) };
        Self { scale, low: low - room, high: high + room }
    }

    /// The place of a value, if it is on the axis.
    fn place(&self, value: f64) -> Option<f64> {
        self.scale.place(value).filter(|place| (self.low..=self.high).contains(place))
    }

    /// The place of a value, or the end of the axis that it is beyond.
    fn nearest(&self, value: f64) -> f64 {
        let end = if value > 0.0 { self.high } else { self.low };
        self.scale.place(value).unwrap_or(end).clamp(self.low, self.high)
    }

    /// The places of some digits of each decade.
    fn digits(&self, wanted: &[u32]) -> Vec<f64> {
        let powers = self.low.floor() as i32..=self.high.floor() as i32;
        let places =
            powers.flat_map(|power| wanted.iter().map(move |digit| f64::from(power) + f64::from(*digit).log10()));
        places.filter(|place| (self.low..=self.high).contains(place)).collect()
    }
}

impl Ranged for Span {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, limit: (i32, i32)) -> i32 {
        RangedCoordf64::from(self.range()).map(place, limit)
    }

    /// The marks: of a logarithmic axis all digits, with labels at those for which there is room.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match (self.scale, self.high - self.low) {
            (Scale::Linear, _) => RangedCoordf64::from(self.range()).key_points(hint),
            _ if hint.weight().allow_light_points() => self.digits(&[1, 2, 3, 4, 5, 6, 7, 8, 9]),
            (_, decades) if decades < 1.2 => self.digits(&[1, 2, 3, 5, 7]),
            (_, decades) if decades < 3.0 => self.digits(&[1, 2, 5]),
            _ => self.digits(&[1]),
        }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Span {
    fn format_ext(&self, place: &f64) -> String {
        let is_linear = self.scale == Scale::Linear;
        let power = (place + 1e-9).floor();
        if !is_linear && !(-4.0..7.0).contains(&power) {
            return format!("{:.0}e{power}", 10_f64.powf(place - power)).replace('-', "−");
        }
        let value = if is_linear { *place } else { 10_f64.powf(*place) };
        // Enough decimals for the step of linear marks, and for the first figure of logarithmic ones.
        let decimals = if is_linear { -(0.1 * (self.high - self.low)).log10().floor() } else { -power };
        numbers::grouped(numbers::trimmed(value, decimals.clamp(0.0, 9.0) as usize)).replace('-', "−")
    }
}

impl Scale {
    /// The place of a value, in the unit of the axis; `None` where it has none.
    fn place(self, value: f64) -> Option<f64> {
        let place = match self {
            Self::Linear => value,
            Self::Logarithmic if value > 0.0 => value.log10(),
            Self::Logarithmic => return None,
        };
        // The differences of values beyond might not be finite.
        (place.abs() < 1e300).then_some(place)
    }
}
