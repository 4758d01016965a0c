//! The offer to go on with the world of a game that did not end well.

use crate::{
    game::{
        crash::recovery::{Choice, Recovery},
        hud::{
            style::weak,
            widgets::main_button,
            window::{MIDDLE, window},
        },
        language::{grouped, spoken},
    },
    kernel::units::TICKS_PER_SECOND,
};
use bevy::prelude::{ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Ui},
};
use tr::tr;

/// Width of the window, points.
const WIDTH: f32 = 400.0;

/// Shows the offer while it stands.
pub fn show(mut contexts: EguiContexts, recovery: Option<ResMut<Recovery>>) -> Result {
    let Some(mut recovery) = recovery else { return Ok(()) };
    let Some((found, progress)) = recovery.offer() else { return Ok(()) };
    let (title, tick, ticks) = (found.title.clone(), found.tick, found.ticks());
    let mut choice = None;
    let open = window(contexts.ctx_mut()?, "The game ended unexpectedly", MIDDLE, |ui| {
        ui.set_width(WIDTH);
        let seconds = tick as f64 / f64::from(TICKS_PER_SECOND);
        let (title, tick, seconds) = (spoken(&title), grouped(tick), format!("{seconds:.1}"));
        ui.label(tr!("{title}, tick {tick} ({seconds} s), can be restored; it will be paused.", title, tick, seconds));
        ui.add_space(8.0);
        choice = buttons(ui, progress, ticks);
    });
    // Closing decides nothing: the next start offers it again.
    if !open {
        recovery.put_off();
    } else if choice.is_some() {
        recovery.choice = choice;
    }
    Ok(())
}

fn buttons(ui: &mut Ui, progress: Option<f32>, ticks: u64) -> Option<Choice> {
    let mut choice = None;
    ui.horizontal(|ui| {
        match progress {
            Some(share) => {
                ui.add(egui::ProgressBar::new(share).desired_width(120.0).show_percentage());
            }
            None => {
                if main_button(ui, &tr!("Restore")).on_hover_text(tr!("the world just before the end")).clicked() {
                    choice = Some(Choice::Restore);
                }
            }
        }
        let seconds = ticks as f64 / f64::from(TICKS_PER_SECOND);
        let why = tr!("the state that was kept last, if the end is what went wrong");
        if ticks > 0 && ui.button(tr!("{} s earlier", format_args!("{seconds:.0}"))).on_hover_text(why).clicked() {
            choice = Some(Choice::Earlier);
        }
        if ui.button(weak(tr!("Forget"))).on_hover_text(tr!("delete it")).clicked() {
            choice = Some(Choice::Forget);
        }
    });
    choice
}
