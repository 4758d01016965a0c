//! The accuracy panel: the running world on the curve of error against time, the presets to choose on it, the survey
//! that measures the curve here and now, the autopilot, the A/B split and the truth lens, what each stage takes of a tick, and on demand all
//! else that is measured.

use crate::{
    game::{
        actions::{Action, PanelId},
        hud::{
            panels::accuracy::{
                axis::percent,
                canvas::Live,
                curves::{Curves, Situation, source},
                dial, measures, pilot,
                plot::{Plot, Pressed},
            },
            style::{self, weak},
            widgets::{action_button, detail_row, main_button, quality_name},
            window::{PanelWindow, scroll},
        },
        icons,
        input::bindings::{Bindings, Group, NONE},
        lens::Lens,
        orders::{Order, Orders},
        panels::{Panel, Panels},
    },
    lab::{
        autopilot::Autopilot,
        dial::Step,
        live::{
            accuracy::{Curve, LiveError, Survey, SurveyRequest, fingerprint},
            measures::Measures,
        },
        split::Split,
    },
    scene::{blueprint::Blueprint, passes::Pass},
    sim::{
        effects::Effects,
        generation::Generation,
        ledger::PassLedger,
        numbers::short,
        pace::Pace,
        state::{Clock, ParticleStore, Setup},
    },
};
use bevy::prelude::{App, KeyCode, Res, ResMut, Resource, Result};
use bevy_egui::egui::{self, Align2, Color32, FontId, RichText, Sense, Ui, vec2};
use tr::tr;

/// Width of the panel's contents, points.
const WIDTH: f32 = 396.0;
/// Places of the live point that are remembered: two seconds.
const TRAIL: usize = 40;
/// Ticks from one of them to the next.
const TRAIL_EVERY: u64 = 3;
/// Stages that take less of a tick than this share are summed up.
const SMALL: f32 = 0.02;

/// What the panel remembers.
#[derive(Resource, Default)]
pub struct AccuracyPanel {
    curves: Curves,
    /// The scene that is played (`Generation::scene`), with its d (m).
    scene: Option<(u64, f32)>,
    trail: Vec<Live>,
    trail_tick: u64,
    bounds: pilot::Bounds,
    /// Whether all measures are shown.
    pub measures: bool,
    /// Whether all of them were in sight since they were opened.
    measures_seen: bool,
}

impl AccuracyPanel {
    /// Takes up the scene that is played; the trail of another, or of another detail, ends.
    fn turn_to(&mut self, scene: u64, blueprint: &Blueprint) {
        let played = Some((scene, blueprint.scale.spacing));
        if self.scene != played {
            self.scene = played;
            self.trail.clear();
            self.curves.turn_to(fingerprint(blueprint), blueprint);
        }
    }

    /// Takes up what was measured since.
    fn follow(&mut self, survey: &Survey, clock: &Clock, now: Option<Live>) {
        self.curves.follow(survey);
        if clock.tick < self.trail_tick || now.is_none() {
            self.trail.clear();
        } else if clock.tick < self.trail_tick + TRAIL_EVERY && !self.trail.is_empty() {
            return;
        }
        self.trail_tick = clock.tick;
        if self.trail.len() == TRAIL {
            self.trail.remove(0);
        }
        self.trail.extend(now);
    }
}

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("accuracy"),
    title: "Accuracy",
    icon: icons::curve,
    keys: &[(KeyCode::KeyA, NONE)],
    group: Group::Look,
    help: "accuracy: what it costs, and the autopilot",
    in_bar: true,
    in_list: Some("Accuracy and cost"),
    stays: true,
};

/// Adds the panel.
pub fn plugin(app: &mut App) {
    app.init_resource::<AccuracyPanel>();
    Panels::add(app, PANEL, show);
}

/// Shows the panel.
fn show(
    mut window: PanelWindow,
    mut panel: ResMut<AccuracyPanel>,
    (setup, generation): (Res<Setup>, Res<Generation>),
    (clock, pace, particles, effects): (Res<Clock>, Res<Pace>, Res<ParticleStore>, Res<Effects>),
    measured: (Res<PassLedger>, Res<LiveError>, Res<Measures>),
    survey: Res<Survey>,
    autopilot: Res<Autopilot>,
    (split, lens, bindings): (Res<Split>, Res<Lens>, Res<Bindings>),
    mut orders: ResMut<Orders>,
) -> Result {
    let (ledger, error, measures) = measured;
    let milliseconds = ledger.tick().median().as_secs_f32() * 1000.0;
    let live = (milliseconds > 0.0).then(|| Live { milliseconds, error: error.mean() });
    panel.turn_to(generation.scene, &setup.blueprint);
    panel.follow(&survey, &clock, live);
    panel.curves.calibrate(&setup, &ledger, &effects);
    let situation = Situation { runs: !pace.paused, particles: particles.len(), timed: ledger.tick().calls };
    orders.extend(panel.curves.wants(&survey, situation).map(Order::Survey));
    window.show(&PANEL, (Align2::RIGHT_TOP, vec2(-14.0, 54.0)), |ui| {
        let screen = ui.ctx().content_rect();
        scroll(ui, 215.0, |ui| {
            ui.set_width(WIDTH.min(screen.width() - 60.0));
            ui.spacing_mut().button_padding = vec2(7.0, 2.0);
            headline(ui, &setup, milliseconds, &error);
            dial::show(ui, &setup, autopilot.goal().is_some(), &mut orders);
            let AccuracyPanel { curves, trail, bounds, measures: open, measures_seen: seen, .. } = &mut *panel;
            let (curve, kind, has_both) = curves.shown();
            let scale = curve.and_then(Curve::scale);
            let plot = Plot {
                curve,
                scale: scale.unwrap_or(1.0),
                kind,
                has_both,
                trail,
                goal: autopilot.goal(),
                now: (setup.preset, setup.quality),
                detail: setup.asked_detail(),
                looked: error.latest().is_some(),
                is_measuring: survey.is_running(),
            };
            let size = vec2(ui.available_width(), (0.34 * screen.height()).clamp(150.0, 240.0));
            let pressed = plot.show(ui, size).or(plot.chips(ui).map(Pressed::Preset));
            orders.extend(detail_row(ui, setup.asked_detail()).map(Order::Detail));
            let second = (split.is_on() && !lens.is_on(), lens.is_on());
            measure(ui, &survey, (curve, scale), second, (&bindings, &mut orders));
            match pressed {
                Some(Pressed::Preset(preset)) => orders.push(Order::Quality(preset)),
                Some(Pressed::Detail(preset, detail)) => orders.push(Order::Accuracy(Step { preset, detail })),
                Some(Pressed::Kind(kind)) => curves.want(kind),
                None => {}
            }
            ui.separator();
            pilot::show(ui, &autopilot, bounds, &mut orders);
            pilot::status(ui, &autopilot, &setup, (milliseconds, error.mean()), &mut orders);
            ui.separator();
            stages(ui, &ledger, &error);
            ui.separator();
            measures::show(ui, open, seen, &measures);
        });
    })
}

fn headline(ui: &mut Ui, setup: &Setup, milliseconds: f32, error: &LiveError) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        ui.label(RichText::new(format!("{milliseconds:.2}")).heading().color(Color32::WHITE));
        ui.label(weak(tr!("ms a tick")));
        ui.add_space(10.0);
        let (mean, p99) = (error.mean(), error.p99());
        let mean = mean.map_or_else(|| tr!("headline" => "none"), percent);
        ui.label(RichText::new(mean).heading().color(Color32::WHITE));
        ui.label(weak(tr!("error")));
        if let Some(p99) = p99 {
            ui.label(weak(format!("(p99 {})", percent(p99))));
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.label(RichText::new(quality_name(setup.preset, &setup.quality)).color(style::ACCENT));
        });
    })
    .response
    .on_hover_text(tr!(
        "Mean and 99th percentile of how much too dense the liquid stands, from a sample of its particles over half a \
         second; the time is the median of the last ticks"
    ));
}

/// The survey, and a second world, whole or through the lens.
fn measure(
    ui: &mut Ui,
    survey: &Survey,
    (curve, scale): (Option<&Curve>, Option<f32>),
    (split, lens): (bool, bool),
    (bindings, orders): (&Bindings, &mut Orders),
) {
    ui.horizontal(|ui| {
        match survey.progress {
            Some(progress) => {
                let bar = egui::ProgressBar::new(progress).desired_width(130.0).desired_height(22.0);
                let told = tr!("measuring, {} %", format_args!("{:.0}", 100.0 * progress));
                ui.add(bar.text(told).fill(style::ACCENT_FILL));
                if ui.button(tr!("cancel")).clicked() {
                    orders.push(Order::Survey(SurveyRequest::Cancel));
                }
            }
            None => {
                let button = main_button(ui, &tr!("Measure here"));
                let told = tr!(
                    "Takes the world as it is and runs every quality from it for two seconds, the ends of them at half \
                     and at twice the detail, too, on one thread beside the game, which plays on"
                );
                if button.on_hover_text(told).clicked() {
                    orders.push(Order::Survey(SurveyRequest::Begin));
                }
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            action_button(ui, icons::split, &tr!("A/B split"), Action::Split, split, (bindings, orders));
            action_button(ui, icons::lens, &tr!("Lens"), Action::Lens, lens, (bindings, orders));
        });
    });
    if let Some(curve) = curve {
        ui.label(weak(source(curve, scale)).small());
    }
}

/// What the stages take of a tick.
fn stages(ui: &mut Ui, ledger: &PassLedger, error: &LiveError) {
    let tick = ledger.tick().median().as_secs_f32() * 1000.0;
    let times = Pass::ALL.map(|pass| (pass.name(), ledger.record(pass).median().as_secs_f32() * 1000.0));
    let longest = times.iter().map(|(_, time)| *time).fold(0.0, f32::max);
    let mut rest = tick;
    for (name, time) in times {
        if time >= SMALL * tick && tick > 0.0 {
            bar(ui, name, time, longest);
            rest -= time;
        }
    }
    if tick > 0.0 {
        bar(ui, &tr!("others"), rest.max(0.0), longest);
    }
    let told = tr!("measuring the error takes {} ms a tick more", short(error.milliseconds_a_tick()));
    ui.label(weak(told).small());
}

fn bar(ui: &mut Ui, name: &str, time: f32, longest: f32) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 14.0), Sense::hover());
    let (names, numbers) = (70.0, 52.0);
    let (painter, left) = (ui.painter(), rect.left_center());
    painter.text(left, Align2::LEFT_CENTER, name, FontId::proportional(12.0), style::TEXT);
    let (number, end) = (format!("{time:.3}"), left + vec2(names + numbers - 8.0, 0.0));
    painter.text(end, Align2::RIGHT_CENTER, number, FontId::proportional(12.0), style::TEXT);
    let room = rect.with_min_x(rect.left() + names + numbers).shrink2(vec2(0.0, 2.0));
    ui.painter().rect_filled(room, 3.0, style::BUTTON);
    if longest > 0.0 {
        let filled = room.with_max_x(room.left() + room.width() * (time / longest).min(1.0));
        ui.painter().rect_filled(filled, 3.0, style::ACCENT.gamma_multiply(0.75));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::params::Preset,
        lab::live::accuracy::CurvePoint,
        scene::{self, effects::EffectModes},
    };

    fn build(columns: &str, preset: Option<Preset>, detail: f64) -> Blueprint {
        let settings = [("columns".to_owned(), columns.to_owned())];
        let scene = scene::load("dam_break").unwrap().at_detail(detail);
        scene.build(&settings, preset, &EffectModes::new()).unwrap()
    }

    /// What a survey leaves that has measured one point.
    fn surveyed(of: u64) -> Survey {
        let (preset, quality) = (Preset::Fast, Preset::Fast.quality());
        let (error, p99) = (Some(0.01), None);
        let point =
            CurvePoint { preset, quality, detail: 1.0, milliseconds: 1.0, error, p99, truth: None, is_sound: true };
        Survey { curve: Curve { of, points: vec![point], ..Curve::default() }, ..Survey::default() }
    }

    #[test]
    fn each_scene_and_each_setting_of_it_has_its_own_curve() {
        let mut panel = AccuracyPanel::default();
        let first = build("10", None, 1.0);
        panel.turn_to(1, &first);
        panel.follow(&surveyed(fingerprint(&first)), &Clock::default(), None);
        panel.trail.push(Live { milliseconds: 1.0, error: None });
        let shows = |panel: &mut AccuracyPanel, scene: u64, blueprint: &Blueprint| {
            panel.turn_to(scene, blueprint);
            panel.curves.shown().0.is_some()
        };
        assert!(shows(&mut panel, 1, &first) && panel.trail.len() == 1);
        assert!(!shows(&mut panel, 2, &build("12", None, 1.0)), "the curve of other settings is shown");
        assert!(panel.trail.is_empty(), "and the trail of another scene");
        assert!(shows(&mut panel, 3, &build("10", Some(Preset::Fine), 1.0)), "the same scene again has lost its curve");
        panel.trail.push(Live { milliseconds: 1.0, error: None });
        assert!(shows(&mut panel, 3, &build("10", None, 0.5)), "a click on another detail has lost the curve");
        assert!(panel.trail.is_empty(), "errors of another detail are others");
    }

    #[test]
    fn a_scene_that_comes_with_a_curve_shows_it_at_once() {
        let mut panel = AccuracyPanel::default();
        let scene = scene::load("dam_break").unwrap();
        panel.turn_to(1, &scene.build(&[], None, &EffectModes::new()).unwrap());
        let (curve, ..) = panel.curves.shown();
        assert!(curve.is_some_and(|curve| curve.shipped.is_some() && curve.point(Preset::Balanced, 1.0).is_some()));
    }

    #[test]
    fn the_panel_keeps_a_short_trail() {
        let mut panel = AccuracyPanel::default();
        let live = Some(Live { milliseconds: 1.0, error: Some(0.01) });
        for (scene, ticks) in [(1, 0..300), (2, 0..300)] {
            for tick in ticks {
                let clock = Clock { tick, ..Clock::default() };
                panel.follow(&surveyed(scene), &clock, live);
            }
        }
        assert_eq!(panel.trail.len(), TRAIL);
        panel.follow(&Survey::default(), &Clock::default(), live);
        assert_eq!(panel.trail.len(), 1, "another history begins a new trail");
        panel.follow(&Survey::default(), &Clock::default(), None);
        assert!(panel.trail.is_empty());
    }
}
