//! How a challenge ended, and what can come next.

use super::{stars, strip::button};
use crate::{
    game::{
        actions::Action,
        hud::{panels::challenges::PANEL, style::weak, widgets::main_button},
        language::spoken,
        orders::{Order, Orders},
        panels::Panels,
        tools::spaced,
    },
    kernel::units::TICKS_PER_SECOND,
    scene::challenges::{Challenge, challenges},
    sim::{
        judge::{Judge, Loss, Stars, Trial, Verdict},
        numbers::trimmed,
    },
};
use bevy::prelude::{Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, Color32, RichText, Ui, vec2},
};
use std::sync::Arc;
use tr::tr;

/// Width of its card, points.
const WIDTH: f32 = 330.0;
/// Side of a star, points.
const STAR: f32 = 40.0;

/// Shows it until another try begins, or it is put away.
pub fn show(
    mut contexts: EguiContexts,
    (judge, panels): (Res<Judge>, Res<Panels>),
    mut orders: ResMut<Orders>,
) -> Result {
    let shown = judge.trial().filter(|trial| !trial.is_running() && panels.visible && !panels.shows(PANEL.id));
    let Some(trial) = shown else { return Ok(()) };
    let context = contexts.ctx_mut()?;
    egui::Area::new("verdict".into()).anchor(Align2::CENTER_CENTER, vec2(0.0, -40.0)).order(egui::Order::Middle).show(
        context,
        |ui| {
            egui::Frame::window(ui.style()).inner_margin(egui::Margin::symmetric(22, 18)).show(ui, |ui| {
                ui.set_width(WIDTH);
                ui.spacing_mut().item_spacing = vec2(8.0, 10.0);
                ui.vertical_centered(|ui| card(ui, trial, &mut orders));
            });
        },
    );
    Ok(())
}

fn card(ui: &mut Ui, trial: &Trial, orders: &mut Orders) {
    let stars = if let Verdict::Won(stars) = trial.verdict { stars } else { Stars::default() };
    let (heading, about) = words(trial);
    ui.label(RichText::new(heading).size(22.0).color(Color32::WHITE));
    stars::row(ui, stars, STAR);
    ui.label(about);
    if stars.done {
        ui.label(weak(missing(trial, stars)));
    }
    ui.add_space(2.0);
    let next = next(&trial.challenge).filter(|_| stars.done);
    let (text, order) = match next {
        Some(next) => (tr!("Next"), Order::Challenge(next.name.clone())),
        None if stars.done => (tr!("All challenges"), Order::Act(Action::Panel(PANEL.id))),
        None => (tr!("Again"), Order::ChallengeAgain),
    };
    if main_button(ui, &text).clicked() {
        orders.push(order);
    }
    ui.horizontal(|ui| {
        let mut others = vec![
            (tr!("All challenges"), Order::Act(Action::Panel(PANEL.id))),
            (tr!("Play on here"), Order::LeaveChallenge),
        ];
        if stars.done {
            others.insert(0, (tr!("Again"), Order::ChallengeAgain));
        }
        others.retain(|(other, _)| *other != text);
        // In the middle, as all above.
        let width: f32 = others.iter().map(|(text, _)| 20.0 + 6.6 * text.chars().count() as f32).sum::<f32>() + 8.0;
        ui.add_space(((WIDTH - width) / 2.0).max(0.0));
        for (text, order) in others {
            if button(ui, &text, &text, false) {
                orders.push(order);
            }
        }
    });
}

/// What is said of the end.
fn words(trial: &Trial) -> (String, String) {
    let seconds = trimmed(trial.ticks as f64 / f64::from(TICKS_PER_SECOND), 1);
    match &trial.verdict {
        Verdict::Won(stars) if *stars == Stars::ALL => (tr!("Perfect!"), tr!("All three stars, in {} s", seconds)),
        Verdict::Won(_) => (tr!("Done!"), tr!("It took {} s", seconds)),
        Verdict::Lost(Loss::Means(means)) => {
            let means = spoken(&spaced(means));
            (tr!("Not this way"), tr!("There is no {} here", means))
        }
        Verdict::Lost(Loss::Time) | Verdict::Running => (tr!("Time is up"), tr!("Never mind: the next try is free")),
    }
}

/// What the stars went by.
fn missing(trial: &Trial, stars: Stars) -> String {
    let line = |count: String, most: u32, earned: bool| {
        if earned { count } else { tr!("{count}: a star for {most} or fewer", count, most) }
    };
    let challenge = &trial.challenge;
    let particles = tr!("{n} particle" | "{n} particles" % trial.poured());
    let strokes = tr!("{n} stroke" | "{n} strokes" % trial.strokes);
    let particles = line(particles, challenge.particles, stars.particles);
    format!("{particles}\n{}", line(strokes, challenge.strokes, stars.strokes))
}

/// The challenge behind one.
fn next(challenge: &Challenge) -> Option<&'static Arc<Challenge>> {
    challenges().unwrap_or_default().iter().find(|other| other.number == challenge.number + 1)
}
