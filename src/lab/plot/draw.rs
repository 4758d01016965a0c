//! Draws a chart as SVG.

use crate::lab::plot::{
    chart::{Chart, Look, Naming, Series},
    labels::{Area, Place, Room},
    layout::{BORDER, Layout, SAMPLE, SIZE, SMALL, SUBTITLE_LINE, TITLE, TITLE_LINE, WORDS},
    text::{self, FAMILY},
};
use svg::node::element::{Circle, Group, Line, Path, Polygon, Polyline, Rectangle, SVG, Text, Title};

/// Colours of series, told apart by the colour-blind, too (after Okabe & Ito 2008), dark enough for words on white.
const HUES: [&str; 7] = ["#0072b2", "#d55e00", "#008a64", "#b5568c", "#333333", "#b07800", "#2f8fc4"];
const PAPER: &str = "#ffffff";
const INK: &str = "#22262a";
const PALE_INK: &str = "#5c6670";
const AXIS: &str = "#7b858e";
const GRID: &str = "#dfe3e6";
const FINE_GRID: &str = "#f1f3f4";
const FAINT: &str = "#98a1a9";
const FAINT_INK: &str = "#747d86";
const FRONT: &str = "#c3ccd4";

/// Radii of markers, pixels.
const MARKER: f64 = 4.4;
const FAINT_MARKER: f64 = 3.2;
/// A line with more points has no markers.
const MOST_MARKERS: usize = 24;
/// Half the length of the bar at the end of an error bar, pixels.
const SERIF: f64 = 3.5;
/// Pixels from one sample of a line to the next, for labels to stand clear of it.
const INK_EVERY: f64 = 3.0;

impl Chart {
    /// The chart as SVG. Equal charts give equal bytes.
    pub fn svg(&self) -> String {
        let layout = Layout::new(self);
        let [width, height] = SIZE;
        let mut svg = SVG::new()
            .set("width", width)
            .set("height", height)
            .set("viewBox", (0, 0, width as i32, height as i32))
            .set("role", "img")
            .set("font-family", FAMILY)
            .add(Title::new(self.title.as_str()))
            .add(Rectangle::new().set("width", width).set("height", height).set("fill", PAPER));
        let fitting =
            |words: &str, size: f64| size.min(size * (width - 2.0 * BORDER) / text::width(words, size).max(1.0));
        svg = svg.add(words(&self.title, BORDER, TITLE_LINE, fitting(&self.title, TITLE), INK));
        if !self.subtitle.is_empty() {
            let size = fitting(&self.subtitle, SMALL);
            svg = svg.add(words(&self.subtitle, BORDER, SUBTITLE_LINE, size, PALE_INK));
        }
        svg = svg.add(grid(&layout)).add(axes(self, &layout));
        let hues = self.hues();
        let order = |series: &Series| match series.look {
            Look::Front => 0,
            Look::Faint => 1,
            _ => 2,
        };
        for turn in 0..3 {
            for (series, hue) in self.series.iter().zip(&hues).filter(|(series, _)| order(series) == turn) {
                svg = svg.add(drawn(series, *hue, &layout));
            }
        }
        for (index, [left, middle]) in &layout.legend {
            svg = svg.add(legend_entry(&self.series[*index], hues[*index], *left, *middle));
        }
        svg = svg.add(labels(self, &hues, &layout));
        if let Some(note) = self.left_out(&layout) {
            let end = words(&note, layout.plot.right, SIZE[1] - BORDER, SMALL, FAINT_INK).set("text-anchor", "end");
            svg = svg.add(end);
        }
        format!("{svg}\n")
    }

    /// The number of each series' colour and marker.
    fn hues(&self) -> Vec<usize> {
        let mut next = 0;
        let mut hue_of = |series: &Series| {
            let own = next;
            next += usize::from(!matches!(series.look, Look::Faint | Look::Front) && series.hue.is_none());
            series.hue.unwrap_or(own)
        };
        self.series.iter().map(&mut hue_of).collect()
    }

    /// Says how many points are not shown.
    fn left_out(&self, layout: &Layout) -> Option<String> {
        let points = self.series.iter().flat_map(|series| &series.points);
        match points.filter(|point| layout.pixel(point).is_none()).count() {
            0 => None,
            1 => Some("1 value has no place on these axes".to_owned()),
            count => Some(format!("{count} values have no place on these axes")),
        }
    }
}

/// To a hundredth of a pixel.
fn px(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

fn words(words: &str, x: f64, y: f64, size: f64, colour: &str) -> Text {
    Text::new(words).set("x", px(x)).set("y", px(y)).set("font-size", px(size)).set("fill", colour)
}

fn line([x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) -> Line {
    Line::new().set("x1", px(x1)).set("y1", px(y1)).set("x2", px(x2)).set("y2", px(y2))
}

fn grid(layout: &Layout) -> Group {
    let Area { left, top, right, bottom } = layout.plot;
    let mut grid = Group::new().set("stroke-width", 1);
    for major in [false, true] {
        let colour = if major { GRID } else { FINE_GRID };
        let mut lines = Group::new().set("stroke", colour);
        for tick in layout.x.ticks.iter().filter(|tick| tick.label.is_some() == major) {
            let x = layout.x.pixel_of_place(tick.place);
            lines = lines.add(line([x, top], [x, bottom]));
        }
        for tick in layout.y.ticks.iter().filter(|tick| tick.label.is_some() == major) {
            let y = layout.y.pixel_of_place(tick.place);
            lines = lines.add(line([left, y], [right, y]));
        }
        grid = grid.add(lines);
    }
    grid
}

fn axes(chart: &Chart, layout: &Layout) -> Group {
    let Area { left, top, right, bottom } = layout.plot;
    let mut lines = Group::new().set("stroke", AXIS).set("stroke-width", 1.2);
    lines = lines.add(line([left, top], [left, bottom])).add(line([left, bottom], [right, bottom]));
    let mut marks = Group::new().set("font-size", SMALL).set("fill", PALE_INK);
    for tick in &layout.x.ticks {
        let (x, length) = (layout.x.pixel_of_place(tick.place), if tick.label.is_some() { 6.0 } else { 3.0 });
        lines = lines.add(line([x, bottom], [x, bottom + length]));
        if let Some(label) = &tick.label {
            marks = marks.add(words(label, x, bottom + 20.0, SMALL, PALE_INK).set("text-anchor", "middle"));
        }
    }
    for tick in &layout.y.ticks {
        let (y, length) = (layout.y.pixel_of_place(tick.place), if tick.label.is_some() { 6.0 } else { 3.0 });
        lines = lines.add(line([left - length, y], [left, y]));
        if let Some(label) = &tick.label {
            marks = marks.add(words(label, left - 9.0, y + 0.35 * SMALL, SMALL, PALE_INK).set("text-anchor", "end"));
        }
    }
    let (middle, height) = ((left + right) / 2.0, (top + bottom) / 2.0);
    let across = words(&chart.x.label, middle, bottom + 43.0, WORDS, INK).set("text-anchor", "middle");
    let up = words(&chart.y.label, 0.0, 0.0, WORDS, INK)
        .set("text-anchor", "middle")
        .set("transform", format!("translate({}, {}) rotate(-90)", px(BORDER + 10.0), px(height)));
    Group::new().add(lines).add(marks).add(across).add(up)
}

/// Line, error bars and markers of a series.
fn drawn(series: &Series, hue: usize, layout: &Layout) -> Group {
    let colour = colour_of(series, hue);
    let mut group = Group::new().set("stroke", colour).set("fill", "none");
    if series.look != Look::Scatter {
        for run in series.points.split(|point| layout.pixel(point).is_none()).filter(|run| run.len() > 1) {
            let ends: Vec<String> = run
                .iter()
                .filter_map(|point| layout.pixel(point))
                .map(|[x, y]| format!("{},{}", px(x), px(y)))
                .collect();
            group = group.add(stroke(series.look, Polyline::new().set("points", ends.join(" "))));
        }
    }
    for point in &series.points {
        let Some([x, y]) = layout.pixel(point) else { continue };
        if let Some((low, high)) = point.y_range.filter(|(low, high)| !low.is_nan() && !high.is_nan()) {
            group = group.add(bar([x, layout.y.nearest_pixel(low)], [x, layout.y.nearest_pixel(high)]));
        }
        if let Some((low, high)) = point.x_range.filter(|(low, high)| !low.is_nan() && !high.is_nan()) {
            group = group.add(bar([layout.x.nearest_pixel(low), y], [layout.x.nearest_pixel(high), y]));
        }
    }
    if series.points.len() > MOST_MARKERS && series.look != Look::Scatter {
        return group;
    }
    let places = series.points.iter().filter_map(|point| layout.pixel(point));
    places.fold(group, |group, place| marked(group, series.look, hue, place))
}

fn colour_of(series: &Series, hue: usize) -> &'static str {
    match series.look {
        Look::Front => FRONT,
        Look::Faint => FAINT,
        _ => HUES[hue % HUES.len()],
    }
}

fn stroke(look: Look, line: Polyline) -> Polyline {
    let line = line.set("stroke-linejoin", "round").set("stroke-linecap", "round");
    match look {
        Look::Front => line.set("stroke-width", 7),
        Look::Faint => line.set("stroke-width", 1),
        Look::Dashed => line.set("stroke-width", 1.8).set("stroke-dasharray", "6 5"),
        Look::Line | Look::Scatter => line.set("stroke-width", 2.2),
    }
}

/// An error bar.
fn bar([x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) -> Path {
    let (along, across) = if x1 == x2 { (SERIF, 0.0) } else { (0.0, SERIF) };
    let mut strokes = format!("M{} {}L{} {}", px(x1), px(y1), px(x2), px(y2));
    for [x, y] in [[x1, y1], [x2, y2]] {
        strokes += &format!("M{} {}L{} {}", px(x - along), px(y - across), px(x + along), px(y + across));
    }
    Path::new().set("d", strokes).set("stroke-width", 1.2)
}

/// A marker: its shape goes with the hue, so that it can be told without the colour.
fn marked(group: Group, look: Look, hue: usize, [x, y]: [f64; 2]) -> Group {
    let (radius, fill, edge) = match look {
        Look::Front => return group,
        Look::Faint => (FAINT_MARKER, FAINT, PAPER),
        Look::Dashed => (MARKER - 0.6, PAPER, HUES[hue % HUES.len()]),
        Look::Line | Look::Scatter => (MARKER, HUES[hue % HUES.len()], PAPER),
    };
    let width = if look == Look::Dashed { 1.6 } else { 0.9 };
    let corners: &[[f64; 2]] = match (look, hue % 5) {
        (Look::Faint, _) | (_, 0) => {
            let disc = Circle::new().set("cx", px(x)).set("cy", px(y)).set("r", radius);
            return group.add(disc.set("fill", fill).set("stroke", edge).set("stroke-width", width));
        }
        (_, 1) => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
        (_, 2) => &[[0.0, -1.25], [1.15, 0.85], [-1.15, 0.85]],
        (_, 3) => &[[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]],
        (_, _) => &[[0.0, 1.25], [1.15, -0.85], [-1.15, -0.85]],
    };
    let corner = |[right, down]: &[f64; 2]| format!("{},{}", px(x + right * radius), px(y + down * radius));
    let shape = Polygon::new().set("points", corners.iter().map(corner).collect::<Vec<_>>().join(" "));
    group.add(shape.set("fill", fill).set("stroke", edge).set("stroke-width", width))
}

fn legend_entry(series: &Series, hue: usize, left: f64, middle: f64) -> Group {
    let mut sample = Group::new().set("stroke", colour_of(series, hue)).set("fill", "none");
    if series.look != Look::Scatter {
        let points = format!("{},{} {},{}", px(left + 4.0), px(middle), px(left + SAMPLE - 4.0), px(middle));
        sample = sample.add(stroke(series.look, Polyline::new().set("points", points)));
    }
    sample = marked(sample, series.look, hue, [left + SAMPLE / 2.0, middle]);
    Group::new().add(sample).add(words(&series.name, left + SAMPLE + 4.0, middle + 0.35 * WORDS, WORDS, INK))
}

/// Names beside the series and words beside points, each where it covers the least.
fn labels(chart: &Chart, hues: &[usize], layout: &Layout) -> Group {
    let bounds = Area { right: SIZE[0] - 4.0, left: layout.plot.left + 2.0, ..layout.plot };
    let mut room = Room::new(bounds);
    chart.series.iter().for_each(|series| note_ink(series, layout, &mut room));
    let mut wanted: Vec<Label> =
        chart.series.iter().zip(hues).flat_map(|(series, hue)| labels_of(series, *hue, layout)).collect();
    // From the top, so that those of one place stand in the order of their points.
    wanted.sort_by(|a, b| a.anchor[1].total_cmp(&b.anchor[1]));
    room.anchors = wanted.iter().map(|label| label.anchor).collect();
    wanted.iter().fold(Group::new(), |group, label| {
        let place = room.place(label.anchor, [text::width(label.words, label.size), label.size + 2.0]);
        group.add(label_at(label, &place))
    })
}

/// Words that belong to a point.
struct Label<'a> {
    words: &'a str,
    anchor: [f64; 2],
    size: f64,
    colour: &'static str,
}

fn labels_of<'a>(series: &'a Series, hue: usize, layout: &Layout) -> Vec<Label<'a>> {
    let is_faint = series.look == Look::Faint;
    let colour = if is_faint { FAINT_INK } else { colour_of(series, hue) };
    let name = (series.naming == Naming::AtEnd).then_some(series.name.as_str());
    let name = name.zip(layout.last_pixel(series)).map(|(name, end)| (name, end, if is_faint { SMALL } else { WORDS }));
    let points = series.points.iter().filter_map(|point| Some((point.label.as_deref()?, layout.pixel(point)?, SMALL)));
    name.into_iter()
        .chain(points)
        .filter(|(words, ..)| !words.is_empty())
        .map(|(words, anchor, size)| Label { words, anchor, size, colour })
        .collect()
}

fn label_at(label: &Label, place: &Place) -> Group {
    let &Label { anchor: [x, y], size, colour, .. } = label;
    let Area { left, top, right, bottom } = place.area;
    let (middle, near) = ((top + bottom) / 2.0, [x.clamp(left, right), y.clamp(top, bottom)]);
    let mut group = Group::new();
    if place.thread {
        group = group.add(line([x, y], near).set("stroke", colour).set("stroke-width", 0.8).set("opacity", 0.7));
    }
    // Words to the left of their point end there; the room to spare is then on the far side.
    let (at, anchor) = match (left, right) {
        (left, _) if left >= x => (left, "start"),
        (_, right) if right <= x => (right, "end"),
        (left, right) => ((left + right) / 2.0, "middle"),
    };
    let words = words(label.words, at, middle + 0.35 * size, size, colour).set("text-anchor", anchor);
    // A halo keeps words readable on what they can't avoid.
    group.add(
        words.set("paint-order", "stroke").set("stroke", PAPER).set("stroke-width", 3).set("stroke-linejoin", "round"),
    )
}

/// Notes where a series has its markers and line.
fn note_ink(series: &Series, layout: &Layout, room: &mut Room) {
    let mut last: Option<[f64; 2]> = None;
    for point in &series.points {
        let here = layout.pixel(point);
        if let Some([x, y]) = here {
            room.ink.extend([[x, y], [x - 3.0, y], [x + 3.0, y], [x, y - 3.0], [x, y + 3.0]]);
        }
        if let (Some([x1, y1]), Some([x2, y2]), true) = (last, here, series.look != Look::Scatter) {
            let steps = ((x2 - x1).hypot(y2 - y1) / INK_EVERY).ceil().max(1.0);
            let along = (1..steps as usize).map(|step| step as f64 / steps);
            room.ink.extend(along.map(|share| [x1 + share * (x2 - x1), y1 + share * (y2 - y1)]));
        }
        last = here;
    }
}
