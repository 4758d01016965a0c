//! What the plot shows, and what presses on it.

use super::*;

fn plot<'a>(curve: Option<&'a Curve>, trail: &'a [Live]) -> Plot<'a> {
    Plot {
        curve,
        scale: 1.0,
        kind: ErrorKind::Density,
        has_both: false,
        trail,
        goal: None,
        now: (Preset::Fast, Preset::Fast.quality()),
        detail: 1.0,
        looked: true,
        is_measuring: false,
    }
}

/// A curve of all presets, each with twice the cost and half the error of the one before it; `error` is the first
/// one's.
fn curve(error: Option<f32>) -> Curve {
    let point = |preset: Preset| {
        let factor = f32::from(1_u8 << preset as u8);
        let error = error.map(|error| error / factor);
        let (quality, detail) = (preset.quality(), preset.detail());
        CurvePoint { preset, quality, detail, milliseconds: factor, error, p99: error, truth: None, is_sound: true }
    };
    Curve { points: Preset::ALL.map(point).into(), ..Curve::default() }
}

/// What the plot and its chips write in a window, and what a click on the words `on` presses.
fn press(plot: &Plot<'_>, on: &str) -> (Vec<String>, Option<Pressed>) {
    press_on(plot, |shape| matches!(shape, Shape::Text(text) if text.galley.text().starts_with(on)))
}

/// The same of a click on the last of the shapes that are `it`.
fn press_on(plot: &Plot<'_>, it: impl Fn(&Shape) -> bool) -> (Vec<String>, Option<Pressed>) {
    let context = egui::Context::default();
    style::apply(&context);
    let (mut words, mut chosen, mut target) = (Vec::new(), None, None);
    for step in 0..6 {
        let button = |pressed, pos| egui::Event::PointerButton {
            pos,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: egui::Modifiers::NONE,
        };
        let events = match (step, target) {
            (3, Some(at)) => vec![egui::Event::PointerMoved(at)],
            (4, Some(at)) => vec![button(true, at)],
            (5, Some(at)) => vec![button(false, at)],
            _ => Vec::new(),
        };
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(440.0, 400.0)));
        let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
        let output = context.run_ui(input, |ui| {
            let pressed = plot.show(ui, vec2(396.0, 200.0)).or(plot.chips(ui).map(Pressed::Preset));
            chosen = chosen.or(pressed);
        });
        words.clear();
        for shape in output.shapes.into_iter().map(|clipped| clipped.shape) {
            if it(&shape) {
                target = Some(shape.visual_bounding_rect().center());
            }
            if let Shape::Text(text) = shape {
                words.push(text.galley.text().to_owned());
            }
        }
    }
    (words, chosen)
}

#[test]
fn every_preset_can_be_pressed_with_a_curve_without_and_without_liquid() {
    let (full, times) = (curve(Some(0.1)), curve(None));
    let live = [Live { milliseconds: 2.0, error: None }];
    for curve in [None, Some(&full), Some(&times)] {
        for preset in Preset::ALL {
            let (words, chosen) = press(&plot(curve, &live), preset.name());
            assert_eq!(chosen, Some(Pressed::Preset(preset)), "{words:?}");
        }
    }
}

#[test]
fn what_is_missing_is_said() {
    let (full, times) = (curve(Some(0.01)), curve(None));
    let (wet, dry) = (Live { milliseconds: 2.0, error: Some(0.1) }, Live { milliseconds: 2.0, error: None });
    let hints = |curve, live: &[Live]| plot(curve, live).hints().join("; ");
    assert_eq!(hints(Some(&full), &[wet]), "");
    assert!(hints(None, &[wet]).starts_with("no curve of this scene yet"));
    let empty = hints(None, &[dry]);
    assert!(empty.starts_with("no density error to measure") && empty.ends_with("measure here"), "{empty}");
    assert!(hints(Some(&times), &[dry]).ends_with("times only"));
    let measuring = Plot { is_measuring: true, ..plot(None, &[]) };
    assert!(measuring.hints().join("; ").ends_with("it is being measured"));
}

#[test]
fn the_other_error_can_be_chosen_where_there_is_one() {
    let full = curve(Some(0.1));
    let live = [Live { milliseconds: 2.0, error: Some(0.1) }];
    let (words, pressed) = press(&plot(Some(&full), &live), "density error");
    assert!(pressed.is_none() && !words.contains(&"true error".to_owned()), "{words:?}");
    let both = Plot { has_both: true, ..plot(Some(&full), &live) };
    assert_eq!(press(&both, "true error").1, Some(Pressed::Kind(ErrorKind::True)));
    assert_eq!(press(&both, "density error").1, None, "it is shown");
}

#[test]
fn where_the_true_error_is_known_it_is_drawn_over_its_floor() {
    let mut known = curve(Some(0.1));
    known.floor = Some(0.002);
    known.points.iter_mut().for_each(|point| point.truth = point.error);
    let truth = Plot { kind: ErrorKind::True, has_both: true, ..plot(Some(&known), &[]) };
    let (words, pressed) = press(&truth, "fine");
    assert!(words.iter().any(|word| word.starts_with("floor")), "{words:?}");
    assert_eq!(pressed, Some(Pressed::Preset(Preset::Fine)));
    let (words, _) = press(&plot(Some(&known), &[]), "fine");
    assert!(!words.iter().any(|word| word.starts_with("floor")), "the density error has none: {words:?}");
}

#[test]
fn what_is_of_another_detail_is_a_mark_that_asks_for_it() {
    let mut both = curve(Some(0.1));
    let draft = both.points[1];
    both.points.push(CurvePoint { detail: 0.5, milliseconds: 0.25, error: Some(0.5), ..draft });
    let shown = plot(Some(&both), &[]);
    let (words, pressed) = press_on(&shown, |shape| matches!(shape, Shape::Path(path) if path.closed));
    assert_eq!(words.iter().filter(|word| *word == "draft").count(), 1, "{words:?}");
    assert_eq!(pressed, Some(Pressed::Detail(Preset::Draft, 0.5)));
}
