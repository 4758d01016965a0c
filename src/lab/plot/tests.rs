//! Charts as a whole.

use super::*;
use resvg::usvg::roxmltree::Document;

fn chart() -> Chart {
    let law = |scale: f64, power: f64| {
        [1.5e3, 1e4, 1e5, 1e6]
            .map(|n: f64| Point::new(n, scale * n.powf(power)).between_y(0.9 * scale * n, 1.2 * scale * n))
    };
    Chart {
        title: "Cost < all & \"sundry\"".to_owned(),
        subtitle: "a machine".to_owned(),
        x: Axis::logarithmic("particles"),
        y: Axis::logarithmic("time of a tick, ms"),
        series: vec![
            Series::new("front", Look::Front, law(5e-5, 1.0)),
            Series::new("ours", Look::Line, law(7e-5, 1.0)),
            Series::new("ours, two threads", Look::Dashed, law(4e-5, 1.0)).coloured(0),
            Series::new("theirs", Look::Faint, [Point::new(1e4, 3.0), Point::new(1e5, 34.0)]),
            Series::new("runs", Look::Scatter, [Point::new(2e4, 1.0).labelled("a run")]),
        ],
    }
}

fn words(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).unwrap();
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    texts.filter_map(|node| node.text()).map(|text| text.trim().to_owned()).collect()
}

/// Numbers of an attribute of all elements of a name.
fn numbers(svg: &str, element: &str, attribute: &str) -> Vec<f64> {
    let document = Document::parse(svg).unwrap();
    let elements = document.descendants().filter(|node| node.has_tag_name(element));
    elements.filter_map(|node| node.attribute(attribute)?.parse().ok()).collect()
}

#[test]
fn everything_is_named_once() {
    let words = words(&chart().svg());
    for name in [
        "Cost < all & \"sundry\"",
        "a machine",
        "particles",
        "time of a tick, ms",
        "ours",
        "ours, two threads",
        "theirs",
        "runs",
        "a run",
        "front",
    ] {
        assert_eq!(words.iter().filter(|word| *word == name).count(), 1, "{name} in {words:?}");
    }
    for mark in ["10,000", "1,000,000", "0.1", "10"] {
        assert!(words.iter().any(|word| word == mark), "no mark {mark} in {words:?}");
    }
}

#[test]
fn points_stand_where_their_values_are() {
    let points = [1.0, 2.0, 3.0].map(|x| Point::new(x, 10.0 * x));
    let axis = || Axis::linear("").within(0.0, 4.0);
    let series = vec![Series::new("", Look::Line, points)];
    let chart = |y| Chart { title: String::new(), subtitle: String::new(), x: axis(), y, series: series.clone() };
    let svg = chart(Axis::linear("").within(0.0, 40.0)).svg();
    let (x, y) = (numbers(&svg, "circle", "cx"), numbers(&svg, "circle", "cy"));
    assert_eq!((x.len(), y.len()), (3, 3));
    assert!((x[1] - x[0] - (x[2] - x[1])).abs() < 0.03 && x[1] > x[0] + 50.0, "{x:?}");
    assert!((y[1] - y[0] - (y[2] - y[1])).abs() < 0.03 && y[1] < y[0] - 50.0, "y goes up: {y:?}");
    let y = numbers(&chart(Axis::logarithmic("")).svg(), "circle", "cy");
    let ratio = (y[1] - y[0]) / (y[2] - y[1]);
    assert!((ratio - 2_f64.ln() / 1.5_f64.ln()).abs() < 0.01, "{ratio}");
}

#[test]
fn what_has_no_place_is_left_out_and_said() {
    let odd = [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e308, 1e-308];
    let mut chart = chart();
    chart.series.push(Series::new("odd", Look::Line, odd.map(|v| Point::new(v, v).between_x(v, -v).between_y(-v, v))));
    chart.series.push(Series::new("none", Look::Line, []));
    assert!(
        words(&chart.svg()).iter().any(|word| word == "4 values have no place on these axes"),
        "{:?}",
        words(&chart.svg())
    );
    for (x, y) in [(Axis::linear("x"), Axis::linear("y")), (Axis::linear("x").within(1.0, 1.0), Axis::logarithmic("y"))]
    {
        for series in [vec![], chart.series.clone(), vec![Series::new("one", Look::Line, [Point::new(3.0, 3.0)])]] {
            let svg = Chart { x: x.clone(), y: y.clone(), series, ..chart.clone() }.svg();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            Document::parse(&svg).unwrap();
        }
    }
}

#[test]
fn equal_charts_are_equal_to_the_byte() {
    assert_eq!(chart().svg(), chart().svg());
    let png = || {
        let mut bytes = Vec::new();
        chart().write_png(&mut bytes, 1.5).unwrap();
        bytes
    };
    assert_eq!(png(), png());
    assert!(chart().write_png(Vec::new(), f32::NAN).is_err());
}

#[test]
fn the_picture_has_ink_where_the_words_are() {
    let mut bytes = Vec::new();
    chart().write_png(&mut bytes, 1.0).unwrap();
    let mut reader = ::png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (880, 560));
    let dark = |rows: std::ops::Range<usize>| {
        pixels[rows.start * 880 * 3..rows.end * 880 * 3].chunks_exact(3).filter(|pixel| pixel[0] < 100).count()
    };
    assert!(dark(18..36) > 200, "the title has {} dark pixels", dark(18..36));
    assert_eq!(dark(0..10), 0, "the border is empty");
}
