//! Random scene files from the whole space of valid ones: every number at both ends of its range and in between.

use glam::Vec2;
use powder_master::{
    kernel::params::Preset,
    scene::{KNOBS, Knob, Part, Range, Values, effects::Effect},
};
use proptest::prelude::*;
use std::fmt::Write;

/// A scene: its file, and what of it decides how a world is run and judged.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Text of the file.
    pub text: String,
    /// Size of the box, d.
    pub size: Vec2,
    /// Substeps that a tick takes at most, times the work of one, for each particle or cell.
    pub work: f64,
}

/// A number of a range: an end, or anything between, even over its logarithm where it has one.
fn number(low: f64, high: f64) -> BoxedStrategy<f64> {
    let between = if low > 0.0 && high / low > 100.0 {
        (low.ln()..high.ln()).prop_map(move |log| log.exp().clamp(low, high)).boxed()
    } else {
        (low..high).boxed()
    };
    prop_oneof![1 => Just(low), 1 => Just(high), 2 => between].boxed()
}

fn whole(low: u32, high: u32) -> BoxedStrategy<u32> {
    prop_oneof![1 => Just(low), 1 => Just(high), 3 => low..=high].boxed()
}

/// A name and a number of a range, left out half the time.
fn field(name: &'static str, values: BoxedStrategy<f64>) -> BoxedStrategy<String> {
    prop_oneof![Just(String::new()), values.prop_map(move |value| format!("{name}: {value:?}, ")),].boxed()
}

fn fields(list: Vec<BoxedStrategy<String>>) -> BoxedStrategy<String> {
    list.prop_map(|fields| fields.concat()).boxed()
}

/// A point in d, in the box or somewhat outside, as an expression over the spacing.
fn point(size: Vec2) -> BoxedStrategy<String> {
    let axis = |length: f32| (-0.2 * length..1.2 * length).prop_map(|at| format!("\"{at:?} * d\""));
    (axis(size.x), axis(size.y)).prop_map(|(x, y)| format!("({x}, {y})")).boxed()
}

/// Both corners of a rectangle in the box that holds at least one site.
fn area(size: Vec2) -> BoxedStrategy<String> {
    let axis = |length: f32| {
        let cells = length as u32;
        (0..cells - 1).prop_flat_map(move |low| (Just(low), low + 1..=cells))
    };
    (axis(size.x), axis(size.y))
        .prop_map(|((left, right), (low, high))| {
            format!("min: (\"{left} * d\", \"{low} * d\"), max: (\"{right} * d\", \"{high} * d\")")
        })
        .boxed()
}

fn velocity() -> BoxedStrategy<String> {
    let axis = || prop_oneof![2 => Just(0.0), 1 => number(-300.0, 300.0), 2 => -10.0..10.0];
    (axis(), axis()).prop_map(|(x, y): (f64, f64)| format!("velocity: ({x:?}, {y:?})")).boxed()
}

fn shape(size: Vec2) -> BoxedStrategy<String> {
    let length = 0.3_f32..size.max_element();
    prop_oneof![
        3 => area(size).prop_map(|area| format!("Rect({area})")),
        2 => (point(size), length.clone()).prop_map(|(at, r)| format!("Disc(centre: {at}, radius: \"{:?} * d\")", 0.4 * r)),
        2 => (point(size), point(size), 0.2_f32..6.0)
            .prop_map(|(from, to, width)| format!("Line(from: {from}, to: {to}, width: \"{width:?} * d\")")),
        1 => prop::collection::vec(point(size), 3..7)
            .prop_map(|points| format!("Polygon(points: [{}])", points.join(", "))),
    ]
    .boxed()
}

fn placement(size: Vec2) -> BoxedStrategy<String> {
    let element = prop_oneof![4 => Just("water"), 3 => Just("rock"), 1 => Just("none")];
    (element, shape(size), any::<bool>(), velocity())
        .prop_map(|(element, shape, replace, velocity)| {
            let velocity = if element == "water" { format!(", {velocity}") } else { String::new() };
            format!("(element: \"{element}\", shape: {shape}, replace: {replace}{velocity})")
        })
        .boxed()
}

fn emitter(size: Vec2) -> BoxedStrategy<String> {
    let rate = number(0.001, 1e6);
    let rest = fields(vec![
        prop_oneof![Just(String::new()), (1..5000_u32).prop_map(|total| format!("total: {total}, "))].boxed(),
        field("start", (0.0..0.5).boxed()),
    ]);
    (area(size), velocity(), rate, rest)
        .prop_map(|(area, velocity, rate, rest)| {
            format!("(element: \"water\", {area}, {velocity}, rate: {rate:?}, {rest})")
        })
        .boxed()
}

fn wind(size: Vec2) -> BoxedStrategy<String> {
    (area(size), velocity(), number(0.001, 1000.0))
        .prop_map(|(area, velocity, rate)| format!("({area}, {velocity}, rate: {rate:?})"))
        .boxed()
}

fn pressure(size: Vec2) -> BoxedStrategy<String> {
    (area(size), number(0.1, 10.0)).prop_map(|(area, pressure)| format!("({area}, pressure: {pressure:?})")).boxed()
}

fn list(name: &'static str, entry: BoxedStrategy<String>, most: usize) -> BoxedStrategy<String> {
    prop::collection::vec(entry, 0..=most)
        .prop_map(move |entries| match entries.is_empty() {
            true => String::new(),
            false => format!("    {name}: [\n        {},\n    ],\n", entries.join(",\n        ")),
        })
        .boxed()
}

fn gravity() -> BoxedStrategy<String> {
    let axis = || number(-1000.0, 1000.0);
    prop_oneof![
        2 => Just(String::new()),
        1 => Just("    gravity: (0, 0),\n".to_owned()),
        2 => (-20.0..20.0, -20.0..20.0).prop_map(|(x, y): (f64, f64)| format!("    gravity: ({x:?}, {y:?}),\n")),
        1 => (axis(), axis()).prop_map(|(x, y)| format!("    gravity: ({x:?}, {y:?}),\n")),
    ]
    .boxed()
}

fn open() -> BoxedStrategy<String> {
    any::<[bool; 4]>()
        .prop_map(|[left, right, bottom, top]| {
            format!("    open: (left: {left}, right: {right}, bottom: {bottom}, top: {top}),\n")
        })
        .boxed()
}

fn effects() -> BoxedStrategy<String> {
    let mode = || prop_oneof![3 => Just("auto"), 1 => Just("on"), 1 => Just("off")];
    prop::collection::vec(mode(), Effect::ALL.len())
        .prop_map(move |modes| {
            let named = Effect::ALL.iter().zip(modes);
            let pairs: Vec<String> = named.map(|(effect, mode)| format!("{}: {mode}", effect.name())).collect();
            format!("    effects: {{{}}},\n", pairs.join(", "))
        })
        .boxed()
}

/// A value of a knob as a scene has it.
fn value(knob: &'static Knob) -> BoxedStrategy<String> {
    let Range { min, max, integer } = knob.values.range();
    match knob.values {
        Values::Words(words) => prop::sample::select(words).prop_map(str::to_owned).boxed(),
        Values::Number(_) if integer => whole(min as u32, max as u32).prop_map(|value| value.to_string()).boxed(),
        Values::Number(_) => number(min, max).prop_map(|value| format!("{value:?}")).boxed(),
    }
}

/// Values of knobs, each left out half the time.
fn knobs(knobs: impl Iterator<Item = &'static Knob>) -> BoxedStrategy<String> {
    let named = |knob: &'static Knob| value(knob).prop_map(|value| format!("{}: {value}, ", knob.name));
    fields(knobs.map(|knob| prop_oneof![Just(String::new()), named(knob)].boxed()).collect())
}

fn fluid() -> BoxedStrategy<String> {
    let liquid = KNOBS.iter().filter(|knob| knob.part == Part::Liquid);
    // Most liquids have the density of the lattice.
    (knobs(liquid), 0..3)
        .prop_map(|(fields, usual)| {
            let fields = fields.split_inclusive(", ").filter(|field| usual == 0 || !field.starts_with("rest_density"));
            format!("    fluid: ({}),\n", fields.collect::<String>())
        })
        .boxed()
}

/// A quality and the work of a tick for each particle: substeps at most, times passes.
fn quality() -> BoxedStrategy<(String, f64, f64)> {
    const COSTLY: [&str; 3] = ["substeps", "iterations", "air_cell"];
    let [substeps, iterations, air_cell] =
        COSTLY.map(|name| Knob::find(name).unwrap_or_else(|| panic!("{name}")).values.range());
    let count = |range: Range| whole(range.min as u32, range.max as u32);
    let preset = (0..Preset::ALL.len()).prop_map(|k| Preset::ALL[k]);
    let counts = prop_oneof![3 => Just(None), 1 => (count(substeps), count(iterations)).prop_map(Some)];
    let cell = prop_oneof![2 => Just(None), 1 => number(air_cell.min, air_cell.max).prop_map(Some)];
    let rest = knobs(Knob::of_quality().filter(|knob| !COSTLY.contains(&knob.name)));
    (preset, counts, cell, rest)
        .prop_map(|(preset, counts, cell, rest)| {
            let mut text = format!("    quality: (preset: {}, {rest}", preset.name());
            let numbers = preset.quality();
            let (substeps, iterations) = counts.unwrap_or((numbers.substeps, numbers.iterations));
            if counts.is_some() {
                let _ = write!(text, "substeps: {substeps}, iterations: {iterations}, ");
            }
            let air_cell = cell.unwrap_or(f64::from(numbers.air_cell));
            if cell.is_some() {
                let _ = write!(text, "air_cell: {air_cell:?}, ");
            }
            text.push_str("),\n");
            let most = 4.0 * f64::from(substeps);
            (text, most * (3.0 + f64::from(iterations)), most * 64.0 / (air_cell * air_cell))
        })
        .boxed()
}

fn texts(size: Vec2) -> BoxedStrategy<Scene> {
    let spacing = prop_oneof![number(0.001, 10.0), Just(0.1)];
    let head = (spacing, gravity(), open(), field("    sound_speed", number(1.0, 400.0)), effects(), fluid());
    let lists = (
        list("contents", placement(size), 5),
        list("emitters", emitter(size), 2),
        list("winds", wind(size), 2),
        list("drains", area(size).prop_map(|area| format!("({area})")).boxed(), 1),
        list("pressures", pressure(size), 2),
    );
    (head, quality(), lists)
        .prop_map(move |(head, (quality, passes, air), (contents, emitters, winds, drains, pressures))| {
            let (spacing, gravity, open, sound, effects, fluid) = head;
            let (width, height) = (size.x, size.y);
            let text = format!(
                "(\n    title: \"Random\",\n    spacing: {spacing:?},\n    size: (\"{width:?} * d\", \"{height:?} * d\"),\n\
                 {gravity}{contents}{emitters}{winds}{drains}{pressures}{open}{sound}\n{fluid}{effects}{quality})\n"
            );
            let cells = f64::from(size.x * size.y);
            // Neighbours of a pass; a cell of air is some twentieth of that.
            Scene { text, size, work: cells * (passes + 0.05 * air) }
        })
        .boxed()
}

/// Any scene.
pub fn scene() -> impl Strategy<Value = Scene> {
    let side = || prop_oneof![1 => Just(4.0_f32), 4 => (4_u32..48).prop_map(|n| n as f32), 1 => 4.0_f32..40.0];
    (side(), side()).prop_flat_map(|(width, height)| texts(Vec2::new(width, height)))
}
