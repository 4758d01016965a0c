//! The autopilot's part of the panel: what it is to hold, and how it stands with that.

use crate::{
    game::{
        hud::{
            panels::accuracy::axis::percent_or_none,
            style::{self, weak},
            widgets::{detail_name, quality_name},
        },
        orders::{Order, Orders},
    },
    lab::autopilot::{Autopilot, Goal, controller::Verdict},
    sim::{numbers::short, state::Setup},
};
use bevy_egui::egui::{self, RichText, Ui};
use tr::tr;

/// Bounds that can be chosen: ms a tick.
const TIMES: std::ops::RangeInclusive<f32> = 0.2..=33.0;
/// Bounds that can be chosen: density error, %.
const PERCENTS: std::ops::RangeInclusive<f32> = 0.005..=20.0;

/// The bounds on the sliders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// ms a tick.
    time: f32,
    /// Density error, %.
    percent: f32,
}

impl Default for Bounds {
    fn default() -> Self {
        Self { time: 4.0, percent: 0.2 }
    }
}

/// Shows it.
pub fn show(ui: &mut Ui, autopilot: &Autopilot, bounds: &mut Bounds, orders: &mut Orders) {
    let goal = autopilot.goal();
    ui.horizontal(|ui| {
        ui.label(tr!("Autopilot"));
        ui.spacing_mut().item_spacing.x = 3.0;
        let time = matches!(goal, Some(Goal::Time(_)));
        let error = matches!(goal, Some(Goal::Error(_)));
        for (chosen, name, wanted) in [
            (goal.is_none(), tr!("off"), None),
            (time, tr!("hold the time"), Some(Goal::Time(bounds.time))),
            (error, tr!("hold the error"), Some(Goal::Error(bounds.percent / 100.0))),
        ] {
            if ui.selectable_label(chosen, name).clicked() && !chosen {
                orders.push(Order::Hold(wanted));
            }
        }
    });
    let changed = match goal {
        None => return,
        Some(Goal::Time(_)) => slider(ui, &mut bounds.time, TIMES, tr!("ms a tick")).then_some(Goal::Time(bounds.time)),
        Some(Goal::Error(_)) => slider(ui, &mut bounds.percent, PERCENTS, tr!("% density error"))
            .then_some(Goal::Error(bounds.percent / 100.0)),
    };
    if changed.is_some() {
        orders.push(Order::Hold(changed));
    }
}

fn slider(ui: &mut Ui, value: &mut f32, range: std::ops::RangeInclusive<f32>, unit: String) -> bool {
    let slider = egui::Slider::new(value, range).logarithmic(true).text(unit);
    let slider = slider.custom_formatter(|value, _| short(value as f32));
    ui.horizontal(|ui| {
        ui.label(tr!("at most"));
        ui.add(slider).changed()
    })
    .inner
}

/// How it stands: at what quality, and what that costs in the other coin.
pub fn status(
    ui: &mut Ui,
    autopilot: &Autopilot,
    setup: &Setup,
    (milliseconds, error): (f32, Option<f32>),
    orders: &mut Orders,
) {
    let Some(goal) = autopilot.goal() else { return };
    let (text, warn) =
        told(goal, autopilot.verdict(), &quality_name(setup.preset, &setup.quality), milliseconds, error);
    ui.label(RichText::new(text).color(if warn { style::WARN } else { style::WEAK }));
    let Some(advice) = autopilot.advice() else { return };
    ui.horizontal_wrapped(|ui| {
        let (detail, time) = (detail_name(advice.detail), short(advice.milliseconds));
        ui.label(weak(tr!("detail {detail} would take some {time} ms", detail, time)));
        let told = tr!(
            "The autopilot keeps the detail: rock and drops are not the same after a change and back. The change can \
             be undone"
        );
        if ui.button(tr!("go to detail {detail}", detail)).on_hover_text(told).clicked() {
            orders.push(Order::Detail(advice.detail));
        }
    });
}

/// The line, and whether it is a warning.
fn told(goal: Goal, verdict: Verdict, quality: &str, milliseconds: f32, error: Option<f32>) -> (String, bool) {
    let (time, error) = (short(milliseconds), percent_or_none(error));
    let text = match (verdict, goal) {
        (Verdict::Settling, _) => tr!("settling, now at {quality}", quality),
        (Verdict::Holds, Goal::Time(_)) => {
            tr!("held at {quality}: {time} ms, with an error of {error}", quality, time, error)
        }
        (Verdict::Holds, Goal::Error(_)) => {
            tr!("held at {quality}: error {error}, for {time} ms a tick", quality, time, error)
        }
        (Verdict::Beyond, Goal::Time(_)) => tr!("can't be held: {time} ms even at {quality}", quality, time),
        (Verdict::Beyond, Goal::Error(_)) => {
            tr!("can't be held: error {error} even at {quality}, {time} ms", quality, time, error)
        }
    };
    (text, verdict == Verdict::Beyond)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pilot_shows_what_it_costs_and_says_when_it_cannot() {
        let line = |goal, verdict| told(goal, verdict, "fine", 1.64, Some(0.0012));
        let (text, warn) = line(Goal::Time(2.0), Verdict::Holds);
        assert!(text.contains("error of 0.12 %") && !warn, "{text}");
        let (text, warn) = line(Goal::Error(0.002), Verdict::Holds);
        assert!(text.contains("1.6 ms") && !warn, "{text}");
        for goal in [Goal::Time(1.0), Goal::Error(0.0001)] {
            let (text, warn) = line(goal, Verdict::Beyond);
            assert!(text.starts_with("can't be held") && warn, "{text}");
        }
    }
}
