//! Where everything of a chart stands, in pixels from its upper left corner.

use crate::lab::plot::{
    chart::{Axis, Chart, Naming, Point, Scale, Series},
    labels::Area,
    text,
    ticks::{Tick, ticks},
};

/// Size of a chart, pixels.
pub(super) const SIZE: [f64; 2] = [880.0, 560.0];
/// Sizes of its words, pixels.
pub(super) const TITLE: f64 = 19.0;
pub(super) const WORDS: f64 = 14.0;
pub(super) const SMALL: f64 = 12.5;

/// Empty border, pixels.
pub(super) const BORDER: f64 = 16.0;
/// Baselines of title and subtitle.
pub(super) const TITLE_LINE: f64 = 34.0;
pub(super) const SUBTITLE_LINE: f64 = 55.0;
/// Height of a row of the legend, and width of the sample in it.
pub(super) const LEGEND_ROW: f64 = 21.0;
pub(super) const SAMPLE: f64 = 30.0;
/// Room between entries of the legend.
const LEGEND_GAP: f64 = 22.0;
/// Room under the plot for the marks' labels and the axis' own.
const BELOW: f64 = 62.0;
/// Distance of a name from the last point of its series.
const NAME_GAP: f64 = 10.0;
/// Most of the width that names beside the plot may take.
const MOST_FOR_NAMES: f64 = 0.3;

/// Share of its span by which an axis reaches past its values.
const SLACK: f64 = 0.04;
/// A linear axis begins with 0 if its lowest value is a smaller share of the highest.
const BEGINS_AT_ZERO: f64 = 0.4;

/// An axis on the screen.
#[derive(Clone, Debug)]
pub(super) struct Ruler {
    scale: Scale,
    low: f64,
    high: f64,
    /// Pixels at `low` and at `high`.
    pub from: f64,
    pub to: f64,
    pub ticks: Vec<Tick>,
}

impl Ruler {
    fn new(axis: &Axis, values: impl Iterator<Item = f64>, wanted: usize) -> Self {
        let (low, high) = axis.limits(values);
        let ticks = ticks(axis.scale, low, high, wanted);
        Self { scale: axis.scale, low, high, from: 0.0, to: 0.0, ticks }
    }

    /// The pixel of a value; `None` if it has no place on the axis.
    pub fn pixel(&self, value: f64) -> Option<f64> {
        let place = self.scale.place(value)?;
        let slack = 1e-9 * (self.high - self.low);
        (self.low - slack..=self.high + slack).contains(&place).then(|| self.pixel_of_place(place))
    }

    /// The pixel of a value, at the end of the axis if it lies beyond.
    pub fn nearest_pixel(&self, value: f64) -> f64 {
        let place = self.scale.place(value).unwrap_or(if value > 0.0 { self.high } else { self.low });
        self.pixel_of_place(place.clamp(self.low, self.high))
    }

    /// The pixel of a place in the unit of the axis.
    pub fn pixel_of_place(&self, place: f64) -> f64 {
        self.from + (place - self.low) / (self.high - self.low) * (self.to - self.from)
    }
}

impl Axis {
    /// First and last place of the axis, in its unit.
    fn limits(&self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        if let Some((low, high)) = self.range
            && let (Some(low), Some(high)) = (self.scale.place(low), self.scale.place(high))
            && low < high
        {
            return (low, high);
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for place in values.filter_map(|value| self.scale.place(value)) {
            (low, high) = (low.min(place), high.max(place));
        }
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        if self.scale == Scale::Linear && low > 0.0 && low < BEGINS_AT_ZERO * high {
            low = 0.0;
        }
        // All at one place: some room around it.
        let span = if high > low { high - low } else { low.abs().max(1.0) };
        let below = if self.scale == Scale::Linear && low == 0.0 { 0.0 } else { SLACK * span };
        (low - below, high + SLACK * span)
    }
}

/// A chart with places for all that it shows.
pub(super) struct Layout {
    /// Where the data is.
    pub plot: Area,
    pub x: Ruler,
    pub y: Ruler,
    /// Series in the legend: index, left end and middle line.
    pub legend: Vec<(usize, [f64; 2])>,
}

impl Layout {
    pub fn new(chart: &Chart) -> Self {
        let points = || chart.series.iter().flat_map(|series| &series.points);
        let ends = |value: fn(&Point) -> f64, range: fn(&Point) -> Option<(f64, f64)>| {
            points().flat_map(move |point| {
                let (low, high) = range(point).unwrap_or((f64::NAN, f64::NAN));
                [value(point), low, high]
            })
        };
        let mut x = Ruler::new(&chart.x, ends(|point| point.x, |point| point.x_range), 6);
        let mut y = Ruler::new(&chart.y, ends(|point| point.y, |point| point.y_range), 6);
        let (legend, rows) = legend(chart);
        let title = if chart.subtitle.is_empty() { TITLE_LINE } else { SUBTITLE_LINE };
        let marks = y.ticks.iter().filter_map(|tick| tick.label.as_ref());
        let widest = marks.map(|label| text::width(label, SMALL)).fold(0.0, f64::max);
        let plot = Area {
            left: BORDER + WORDS + 14.0 + widest,
            top: title + LEGEND_ROW * rows as f64 + if rows > 0 { 24.0 } else { 18.0 },
            right: SIZE[0] - BORDER - 8.0,
            bottom: SIZE[1] - BELOW,
        };
        (x.from, x.to) = (plot.left, plot.right);
        (y.from, y.to) = (plot.bottom, plot.top);
        let legend = legend.into_iter().map(|(index, [left, row])| (index, [left, title + 21.0 + row])).collect();
        let mut layout = Self { plot, x, y, legend };
        // Names stand beside the last points; what sticks out makes the plot narrower, which moves the points once more.
        for _ in 0..3 {
            layout.make_room_for_names(chart);
        }
        layout
    }

    fn make_room_for_names(&mut self, chart: &Chart) {
        let edge = SIZE[0] - BORDER;
        let sticks_out = |series: &Series| {
            let end = self.last_pixel(series)?[0];
            Some(end + NAME_GAP + text::width(&series.name, WORDS) - edge)
        };
        let names = chart.series.iter().filter(|series| series.naming == Naming::AtEnd);
        let most = names.filter_map(sticks_out).fold(0.0, f64::max);
        self.plot.right = (self.plot.right - most).max((1.0 - MOST_FOR_NAMES) * SIZE[0]);
        self.x.to = self.plot.right;
    }

    /// Where a point is, if it is shown.
    pub fn pixel(&self, point: &Point) -> Option<[f64; 2]> {
        Some([self.x.pixel(point.x)?, self.y.pixel(point.y)?])
    }

    /// Where the last point of a series is that is shown.
    pub fn last_pixel(&self, series: &Series) -> Option<[f64; 2]> {
        series.points.iter().rev().find_map(|point| self.pixel(point))
    }
}

/// Left ends and middles of the legend's entries under its top, and its number of rows.
fn legend(chart: &Chart) -> (Vec<(usize, [f64; 2])>, usize) {
    let mut entries = Vec::new();
    let (mut left, mut row) = (BORDER, 0);
    for (index, series) in chart.series.iter().enumerate() {
        if series.naming != Naming::Legend || series.name.is_empty() {
            continue;
        }
        let width = SAMPLE + 6.0 + text::width(&series.name, WORDS);
        if left > BORDER && left + width > SIZE[0] - BORDER {
            (left, row) = (BORDER, row + 1);
        }
        entries.push((index, [left, LEGEND_ROW * row as f64]));
        left += width + LEGEND_GAP;
    }
    let rows = if entries.is_empty() { 0 } else { row + 1 };
    (entries, rows)
}
