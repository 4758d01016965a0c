//! Charts as a whole.

use super::*;

fn chart() -> Chart {
    let law = |scale: f64, power: f64| {
        [1.5e3, 1e4, 1e5, 1e6].map(|n: f64| Point {
            y_range: Some([0.9 * scale * n, 1.2 * scale * n]),
            ..Point::new(n, scale * n.powf(power))
        })
    };
    Chart {
        title: "Cost < all & \"sundry\"".to_owned(),
        subtitle: "a machine".to_owned(),
        x: Axis::logarithmic("particles"),
        y: Axis::logarithmic("time of a tick, ms"),
        series: vec![
            Series::new("front", Look::Front, law(5e-5, 1.0)),
            Series::new("ours", Look::Line, law(7e-5, 1.0)),
            Series::new("ours, two threads", Look::Dashed, law(4e-5, 1.0)),
            Series::new("theirs", Look::Faint, [Point::new(1e4, 3.0), Point::new(1e5, 34.0)]),
            Series::new("runs", Look::Scatter, [Point::new(2e4, 1.0)]),
            Series::new("others", Look::Cloud, [Point::new(3e4, 1.0)]),
        ],
    }
}

/// What stands in the chart, line by line.
fn words(chart: &Chart) -> Vec<String> {
    let svg = chart.svg().unwrap();
    let texts = svg.split("<text ").skip(1).filter_map(|text| text.split_once('>')?.1.split_once("</text>"));
    texts.map(|(words, _)| words.trim().to_owned()).collect()
}

/// Numbers of an attribute of all circles.
fn circles(svg: &str, attribute: &str) -> Vec<f64> {
    let value = |circle: &str| circle.split_once(&format!("{attribute}=\""))?.1.split_once('"')?.0.parse().ok();
    svg.split("<circle ").skip(1).filter_map(value).collect()
}

#[test]
fn everything_is_named_once() {
    let words = words(&chart());
    for name in [
        "Cost &lt; all &amp; &quot;sundry&quot;",
        "a machine",
        "particles",
        "time of a tick, ms",
        "ours",
        "ours, two threads",
        "theirs",
        "runs",
        "others",
        "front",
        "10,000",
        "1,000,000",
        "0.1",
        "10",
    ] {
        assert_eq!(words.iter().filter(|word| *word == name).count(), 1, "{name} in {words:?}");
    }
}

#[test]
fn points_stand_where_their_values_are() {
    let points = [1.0, 2.0, 3.0].map(|x| Point::new(x, 10.0 * x));
    let series = vec![Series::new("", Look::Scatter, points)];
    let svg = |y| {
        let x = Axis::linear("").within(0.0, 4.0);
        Chart { title: String::new(), subtitle: String::new(), x, y, series: series.clone() }.svg().unwrap()
    };
    let linear = svg(Axis::linear("").within(0.0, 40.0));
    // The last circle is the legend's.
    let (x, y) = (circles(&linear, "cx"), circles(&linear, "cy"));
    assert_eq!((x.len(), y.len()), (4, 4));
    assert!((x[1] - x[0] - (x[2] - x[1])).abs() <= 1.0 && x[1] > x[0] + 50.0, "{x:?}");
    assert!((y[1] - y[0] - (y[2] - y[1])).abs() <= 1.0 && y[1] < y[0] - 50.0, "y goes up: {y:?}");
    let y = circles(&svg(Axis::logarithmic("")), "cy");
    let ratio = (y[1] - y[0]) / (y[2] - y[1]);
    assert!((ratio - 2_f64.ln() / 1.5_f64.ln()).abs() < 0.02, "{ratio}");
}

#[test]
fn a_short_axis_has_a_label() {
    let series = vec![Series::new("", Look::Scatter, [Point::new(0.017, 1.3), Point::new(0.0195, 1.4)])];
    let (x, y) = (Axis::logarithmic(""), Axis::logarithmic("").within(1.3, 1.4));
    let mut words = words(&Chart { title: String::new(), subtitle: String::new(), x, y, series });
    words.retain(|word| !word.is_empty());
    assert_eq!(words, ["1", "0.02"], "of y and of x");
}

#[test]
fn what_has_no_place_is_left_out_and_said() {
    let odd = [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e308, 1e-308];
    let odd = odd.map(|v| Point { x_range: Some([v, -v]), y_range: Some([-v, v]), ..Point::new(v, v) });
    let mut chart = chart();
    chart.series.push(Series::new("odd", Look::Line, odd));
    chart.series.push(Series::new("none", Look::Line, []));
    let said = words(&chart);
    assert!(said.iter().any(|word| word == "4 values have no place on these axes"), "{said:?}");
    for (x, y) in [(Axis::linear("x"), Axis::linear("y")), (Axis::linear("x").within(1.0, 1.0), Axis::logarithmic("y"))]
    {
        for series in [vec![], chart.series.clone(), vec![Series::new("one", Look::Line, [Point::new(3.0, 3.0)])]] {
            let svg = Chart { x: x.clone(), y: y.clone(), series, ..chart.clone() }.svg().unwrap();
            assert!(!svg.contains("NaN") && !svg.contains("inf") && svg.trim_end().ends_with("</svg>"), "{svg}");
        }
    }
}

#[test]
fn equal_charts_are_equal_to_the_byte_and_have_ink_where_the_words_are() {
    assert_eq!(chart().svg().unwrap(), chart().svg().unwrap());
    let png = || {
        let mut bytes = Vec::new();
        chart().write_png(&mut bytes, 2).unwrap();
        bytes
    };
    assert_eq!(png(), png());
    let mut reader = ::png::Decoder::new(std::io::Cursor::new(png())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (1760, 1120));
    let row = 1760 * 3;
    let dark = |rows: std::ops::Range<usize>| {
        pixels[rows.start * row..rows.end * row].chunks_exact(3).filter(|pixel| pixel[0] < 100).count()
    };
    assert!(dark(36..72) > 400, "the title has {} dark pixels", dark(36..72));
    assert_eq!(dark(0..20), 0, "the border is empty");
}
