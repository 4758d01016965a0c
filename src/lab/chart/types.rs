//! What a chart shows.

/// How values are laid along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    Linear,
    /// By their logarithms; values of 0 and below have no place.
    Logarithmic,
}

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// How values are laid along it.
    pub scale: Scale,
    /// Lowest and highest value that are shown; by default all there are. Values outside are left out.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// A linear axis over all values.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, range: None }
    }

    /// A logarithmic axis over all values.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Logarithmic, range: None }
    }

    /// The same axis from `low` to `high`.
    #[must_use]
    pub fn within(self, low: f64, high: f64) -> Self {
        Self { range: Some((low, high)), ..self }
    }
}

/// A point of a series.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// Value along x.
    pub x: f64,
    /// Value along y.
    pub y: f64,
    /// Error bar along x: its lower and its upper end.
    pub x_range: Option<[f64; 2]>,
    /// Error bar along y: its lower and its upper end.
    pub y_range: Option<[f64; 2]>,
}

impl Point {
    /// A bare point.
    pub fn new(x: f64, y: f64) -> Self {
        Self { x, y, ..Self::default() }
    }
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// A broad grey line without markers: the front of what can be had.
    Front,
    /// Small grey markers: what is there for comparison.
    Cloud,
    /// Grey markers joined by a thin line: what others have found.
    Faint,
    /// Markers of a colour of their own.
    Scatter,
    /// Markers joined by a line.
    Line,
    /// Hollow markers joined by a dashed line, in the colour of the series before: a variant of it.
    Dashed,
}

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// How it is drawn.
    pub look: Look,
    /// The points, in the order in which they are joined. A value that has no place on its axis interrupts the line.
    pub points: Vec<Point>,
}

impl Series {
    /// A series.
    pub fn new(name: impl Into<String>, look: Look, points: impl IntoIterator<Item = Point>) -> Self {
        Self { name: name.into(), look, points: points.into_iter().collect() }
    }
}

/// A chart.
#[derive(Clone, Debug)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// The circumstances: machine, date, settings. May be empty.
    pub subtitle: String,
    /// Along the bottom.
    pub x: Axis,
    /// Along the left side.
    pub y: Axis,
    /// What is shown, the first below the others.
    pub series: Vec<Series>,
}
