//! A lamp for each effect that works: it lights up when the scene wakes the effect, says what that costs a tick, and goes out
//! when it sleeps. After some seconds it is no news any more, and only a dim name. Only to look at: the world below takes the pointer.
//! The details (F3) have all of it.

use crate::{
    game::{
        hud::{layout::Bars, style},
        panels::Panels,
        tools::spaced,
    },
    scene::effects::Effect,
    sim::{
        effects::{
            Effects,
            status::{EffectStatus, Sleepers},
        },
        ledger::PassLedger,
        state::{AirGrid, ParticleStore, SleepState},
    },
};
use bevy::prelude::{Real, Res, ResMut, Resource, Result, Time};
use bevy_egui::{
    EguiContexts,
    egui::{Color32, FontId, Galley, LayerId, Painter, Pos2, Rect, TextFormat, text::LayoutJob, vec2},
};
use std::sync::Arc;

/// Time between two readings, s: numbers that change faster can't be read.
const INTERVAL: f32 = 0.25;
/// Time in which a lamp comes on or goes out, s.
const FADE: f32 = 0.6;
/// Time for which it is news that an effect works, s.
const NEWS: f32 = 4.0;
/// Brightness of what is no news.
const CALM: f32 = 0.8;
/// Widest that the rows of lamps get, as a share of the window.
const WIDTH: f32 = 0.5;
/// Around the rows, within a lamp beside its text, between lamps, points.
const MARGIN: f32 = 12.0;
const INNER: f32 = 6.0;
const GAP: f32 = 4.0;
/// Height of a row, and the room that a lamp takes before its text, points.
const ROW: f32 = 19.0;
const DOT: f32 = 11.0;

/// A lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lamp {
    /// Whether its effect works.
    works: bool,
    /// How bright it is, 0 … 1.
    light: f32,
    /// For how much of its time it is still news that it works, 0 … 1.
    news: f32,
    /// What the effect's own passes take of a tick, ms; `None` if it is a part of another's pass.
    cost: Option<f32>,
}

const DARK: Lamp = Lamp { works: false, light: 0.0, news: 0.0, cost: None };

/// The lamps, in the order of the table of effects.
#[derive(Resource, Clone, Debug)]
pub struct Lamps {
    lamps: [Lamp; Effect::ALL.len()],
    next: f32,
}

impl Default for Lamps {
    fn default() -> Self {
        Self { lamps: [DARK; Effect::ALL.len()], next: 0.0 }
    }
}

impl Lamps {
    /// Lets so many seconds pass: lamps come on and go out.
    fn fade(&mut self, seconds: f32) {
        for lamp in &mut self.lamps {
            let step = if lamp.works { seconds } else { -seconds } / FADE;
            if lamp.works && lamp.light == 0.0 {
                lamp.news = 1.0;
            }
            lamp.light = (lamp.light + step).clamp(0.0, 1.0);
            lamp.news = (lamp.news - seconds / NEWS).max(0.0);
        }
        self.next -= seconds;
    }

    /// Takes what the gate and the ledger have noted.
    fn take(&mut self, effects: &Effects, ledger: &PassLedger, sleepers: Sleepers) {
        self.next = INTERVAL;
        for (lamp, effect) in self.lamps.iter_mut().zip(Effect::ALL) {
            lamp.works = EffectStatus::of(effect, effects, sleepers).works;
            // What it cost stands until it is dark.
            if lamp.works {
                lamp.cost = cost(effect, ledger);
            }
        }
    }

    fn lit(&self) -> impl Iterator<Item = (Effect, Lamp)> {
        Effect::ALL.into_iter().zip(self.lamps).filter(|(_, lamp)| lamp.light > 0.0)
    }
}

/// What the passes of an effect take of a tick, ms: medians of the ledger.
fn cost(effect: Effect, ledger: &PassLedger) -> Option<f32> {
    let passes = effect.row().passes;
    let sum = || passes.iter().map(|pass| ledger.record(*pass).median().as_secs_f32() * 1000.0).sum();
    (!passes.is_empty()).then(sum)
}

/// Looks what works.
pub fn read(
    mut lamps: ResMut<Lamps>,
    time: Res<Time<Real>>,
    effects: Res<Effects>,
    ledger: Res<PassLedger>,
    sleepers: (Res<SleepState>, Res<ParticleStore>, Res<AirGrid>),
) {
    lamps.fade(time.delta_secs());
    if lamps.next <= 0.0 {
        lamps.take(&effects, &ledger, Sleepers::of(&sleepers.0, &sleepers.1, &sleepers.2));
    }
}

/// Shows those that are lit, in rows below the bar.
pub fn show(mut contexts: EguiContexts, lamps: Res<Lamps>, bars: Res<Bars>, panels: Res<Panels>) -> Result {
    if !panels.visible {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let painter = context.layer_painter(LayerId::background());
    let (left, right) = (MARGIN, MARGIN + WIDTH * context.content_rect().width());
    let mut at = Pos2::new(left, bars.top + MARGIN);
    for (effect, lamp) in lamps.lit() {
        let text = painter.layout_job(lamp.label(effect));
        let size = vec2(text.size().x + DOT + 2.0 * INNER, ROW);
        if at.x > left && at.x + size.x > right {
            at = Pos2::new(left, at.y + ROW + GAP);
        }
        lamp.paint(&painter, Rect::from_min_size(at, size), text);
        at.x += size.x + GAP;
    }
    Ok(())
}

impl Lamp {
    /// The name of its effect, and while that is news, what it costs.
    fn label(self, effect: Effect) -> LayoutJob {
        let mut job = LayoutJob::default();
        let part =
            |colour: Color32, light: f32| TextFormat::simple(FontId::proportional(12.0), colour.gamma_multiply(light));
        job.append(&spaced(effect.name()), 0.0, part(style::TEXT, self.light * (CALM + (1.0 - CALM) * self.news)));
        if let Some(cost) = self.cost.filter(|_| self.news > 0.0) {
            job.append(&format!("{cost:.2} ms"), 6.0, part(style::WEAK, self.light * self.news));
        }
        job
    }

    fn paint(self, painter: &Painter, rect: Rect, text: Arc<Galley>) {
        let fill = style::PANEL.gamma_multiply(self.light * (0.5 + 0.3 * self.news));
        painter.rect_filled(rect, f32::from(style::BUTTON_CORNER), fill);
        let centre = rect.left_center() + vec2(INNER + 2.0, 0.0);
        painter.circle_filled(centre, 6.0, style::ACCENT.gamma_multiply(0.3 * self.light * self.news));
        painter.circle_filled(
            centre,
            3.0,
            style::ACCENT.gamma_multiply(self.light * (CALM + (1.0 - CALM) * self.news)),
        );
        let place = rect.left_center() + vec2(INNER + DOT, -0.5 * text.size().y);
        painter.galley(place, text, style::TEXT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{self, effects::EffectModes},
        sim::{SimulationPlugin, checkpoint::Checkpoint},
    };
    use bevy::{MinimalPlugins, app::App, time::TimeUpdateStrategy};
    use std::time::Duration;

    fn lamps_after(name: &str, ticks: u32) -> (App, Lamps) {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, SimulationPlugin)).insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
        let scene = scene::load(name).expect("it is one of ours");
        let blueprint = scene.build(&[], None, &EffectModes::new()).expect("it is sound");
        Checkpoint::of_scene(Arc::new(blueprint)).restore(app.world_mut());
        (0..ticks).for_each(|_| app.update());
        let mut lamps = Lamps::default();
        let world = app.world();
        lamps.take(world.resource(), world.resource(), Sleepers::in_world(world));
        (app, lamps)
    }

    #[test]
    fn a_lamp_is_lit_for_what_works_and_says_what_the_ledger_says() {
        let (app, mut lamps) = lamps_after("hourglass", 5);
        lamps.fade(10.0);
        let lit: Vec<&str> = lamps.lit().map(|(effect, _)| effect.name()).collect();
        assert!(lit.contains(&"friction") && !lit.contains(&"heat"), "{lit:?}");
        let ledger = app.world().resource::<PassLedger>();
        let milliseconds = |time: Duration| time.as_secs_f32() * 1000.0;
        for (effect, lamp) in lamps.lit() {
            let own: Vec<f32> =
                effect.row().passes.iter().map(|pass| milliseconds(ledger.record(*pass).median())).collect();
            assert_eq!(lamp.cost, (!own.is_empty()).then(|| own.iter().sum()), "{}", effect.name());
        }
    }

    #[test]
    fn a_lamp_goes_out_when_its_effect_stops_and_costs_nothing_then() {
        let (_, mut lamps) = lamps_after("hourglass", 2);
        lamps.fade(FADE);
        let before = lamps.lit().count();
        assert!(before > 0);
        lamps.lamps.iter_mut().for_each(|lamp| lamp.works = false);
        lamps.fade(0.5 * FADE);
        assert_eq!(lamps.lit().count(), before, "it fades");
        lamps.fade(0.6 * FADE);
        assert_eq!(lamps.lit().count(), 0);
        lamps.lamps[0].works = true;
        lamps.fade(0.1);
        assert!(lamps.lamps[0].news > 0.9, "that it works again is news");
    }
}
