//! What a chart shows.

/// Values beyond have no place: their differences might not be finite.
const LARGEST: f64 = 1e300;

/// How values are laid along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    Linear,
    /// By their logarithms; values of 0 and below have no place.
    Logarithmic,
}

impl Scale {
    /// The place of a value, in the unit of the axis; `None` where it has none.
    pub(super) fn place(self, value: f64) -> Option<f64> {
        let place = match self {
            Self::Linear => value,
            Self::Logarithmic if value > 0.0 => value.log10(),
            Self::Logarithmic => return None,
        };
        (place.abs() < LARGEST).then_some(place)
    }
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
    pub x_range: Option<(f64, f64)>,
    /// Error bar along y: its lower and its upper end.
    pub y_range: Option<(f64, f64)>,
    /// Words beside it.
    pub label: Option<String>,
}

impl Point {
    /// A bare point.
    pub fn new(x: f64, y: f64) -> Self {
        Self { x, y, ..Self::default() }
    }

    /// The same point with words beside it.
    #[must_use]
    pub fn labelled(self, label: impl Into<String>) -> Self {
        Self { label: Some(label.into()), ..self }
    }

    /// The same point with an error bar along x.
    #[must_use]
    pub fn between_x(self, low: f64, high: f64) -> Self {
        Self { x_range: Some((low, high)), ..self }
    }

    /// The same point with an error bar along y.
    #[must_use]
    pub fn between_y(self, low: f64, high: f64) -> Self {
        Self { y_range: Some((low, high)), ..self }
    }
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Markers joined by a line; without markers if they are many.
    Line,
    /// Hollow markers joined by a dashed line: a variant of another series.
    Dashed,
    /// Markers.
    Scatter,
    /// Small grey markers joined by a hairline: what others have found.
    Faint,
    /// A broad grey line without markers, below all others: the front of what can be had.
    Front,
}

/// Where the name of a series stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Naming {
    /// Beside its last point.
    AtEnd,
    /// In the legend above the chart.
    Legend,
    /// Nowhere.
    Unnamed,
}

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name.
    pub name: String,
    /// Where the name stands.
    pub naming: Naming,
    /// How it is drawn.
    pub look: Look,
    /// Number of its colour and marker; by default its place among the series that are neither faint nor a front.
    pub hue: Option<usize>,
    /// The points, in the order in which they are joined. A value that has no place on its axis interrupts the line.
    pub points: Vec<Point>,
}

impl Series {
    /// A series with its name beside its last point, or in the legend if it is a cloud or a front.
    pub fn new(name: impl Into<String>, look: Look, points: impl IntoIterator<Item = Point>) -> Self {
        let naming = if matches!(look, Look::Scatter | Look::Front) { Naming::Legend } else { Naming::AtEnd };
        Self { name: name.into(), naming, look, hue: None, points: points.into_iter().collect() }
    }

    /// The same series with its name elsewhere.
    #[must_use]
    pub fn named(self, naming: Naming) -> Self {
        Self { naming, ..self }
    }

    /// The same series in a colour of its choice.
    #[must_use]
    pub fn coloured(self, hue: usize) -> Self {
        Self { hue: Some(hue), ..self }
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
