//! The numbers in the upper left corner: read a few times a second, so that they can be read, and formatted only then.

use crate::{
    game::{
        frame::Tempo,
        hud::style,
        language::{grouped, spoken},
        tools::spaced,
    },
    sim::{
        pace::Pace,
        state::{Acted, Census, Counters, Setup},
    },
};
use bevy::prelude::{DetectChanges, Real, Res, ResMut, Resource, Time};
use bevy_egui::egui::{Color32, RichText, Ui};
use tr::tr;

/// Time between two readings, s.
const INTERVAL: f32 = 0.25;

/// A number with its unit.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// The number.
    pub value: String,
    /// Its unit or name.
    pub unit: String,
    /// Whether it needs attention.
    pub warning: bool,
}

/// The numbers as they were read last.
#[derive(Resource, Clone, Debug, Default)]
pub struct Readings {
    /// That it is paused, or frames a second and the speed if it is not 1.
    pub pace: Vec<Reading>,
    /// Particles in all.
    pub total: Reading,
    /// Particles of each element that there are any of: colour, name, number.
    pub elements: Vec<([u8; 3], Reading)>,
    /// The limiters that acted.
    pub limiters: Vec<Acted>,
    next: f32,
}

/// Reads the numbers when it is time.
pub fn read(
    mut readings: ResMut<Readings>,
    time: Res<Time<Real>>,
    tempo: Res<Tempo>,
    pace: Res<Pace>,
    census: Res<Census>,
    counters: Res<Counters>,
    setup: Res<Setup>,
) {
    readings.next -= time.delta_secs();
    if readings.next > 0.0 && !pace.is_changed() {
        return;
    }
    readings.next = INTERVAL;
    readings.pace = pace_readings(&tempo, &pace);
    readings.total = Reading { value: grouped(u64::from(census.total)), unit: tr!("particles"), warning: census.full };
    readings.elements.clear();
    for (id, element) in setup.elements().iter() {
        let count = census.by_element.get(id.index()).copied().unwrap_or(0);
        if count > 0 {
            let reading =
                Reading { value: grouped(u64::from(count)), unit: spoken(&spaced(&element.name)), warning: false };
            readings.elements.push((element.colour, reading));
        }
    }
    readings.limiters = limiters(&counters, &tempo);
}

fn pace_readings(tempo: &Tempo, pace: &Pace) -> Vec<Reading> {
    let reading = |value: String, unit: String, warning| Reading { value, unit, warning };
    if pace.paused {
        // Frames then come when something changes, and at no rate.
        return vec![reading(tr!("paused"), String::new(), true)];
    }
    let mut readings = vec![reading(format!("{:.0}", tempo.frames_per_second), tr!("FPS"), false)];
    if let Some(share) = tempo.lag {
        let speed = share * pace.speed;
        let digits = if speed < 0.1 { 2 } else { 1 };
        readings.push(reading(format!("{speed:.digits$}×"), tr!("pace" => "speed"), true));
    } else if pace.speed != 1.0 {
        readings.push(reading(format!("{}×", pace.speed), tr!("pace" => "speed"), false));
    }
    readings
}

fn limiters(counters: &Counters, tempo: &Tempo) -> Vec<Acted> {
    let (what, meaning) = ("ticks dropped", "ticks that late frames left out: the world ran slower");
    let late = Acted { what, meaning, count: tempo.dropped() as u64 };
    counters.acted().chain((late.count > 0).then_some(late)).collect()
}

/// Shows one number.
pub fn show_reading(ui: &mut Ui, reading: &Reading) {
    let colour = if reading.warning { style::WARN } else { Color32::WHITE };
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label(RichText::new(&reading.value).color(colour));
        if !reading.unit.is_empty() {
            ui.label(RichText::new(&reading.unit).color(style::WEAK));
        }
    });
}

/// The elements as one text, for a window too narrow for them.
pub fn as_text(readings: &Readings) -> String {
    let lines = readings.elements.iter().map(|(_, reading)| format!("{} {}", reading.value, reading.unit));
    lines.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_late_world_says_how_slow_it_is() {
        let mut tempo = Tempo::default();
        (tempo.lag, tempo.ticks_per_second) = (Some(0.8), 48.0);
        let readings = pace_readings(&tempo, &Pace::default());
        assert!(readings.iter().any(|reading| reading.value == "0.8×" && reading.warning), "{readings:?}");
        (tempo.lag, tempo.ticks_per_second) = (None, 60.0);
        assert_eq!(pace_readings(&tempo, &Pace::default()).len(), 1, "at its speed nothing is said of it");
    }

    #[test]
    fn a_world_that_stands_has_no_rate_of_frames() {
        let readings = pace_readings(&Tempo::default(), &Pace { paused: true, ..Pace::default() });
        assert_eq!(readings.len(), 1, "{readings:?}");
        assert_eq!((readings[0].value.as_str(), readings[0].warning), ("paused", true));
    }

    #[test]
    fn only_limiters_that_did_something_are_shown() {
        assert_eq!(limiters(&Counters { substeps_max: 4, ..Counters::default() }, &Tempo::default()), []);
        let counters = Counters { escaped: 3, speed_clamps: 1200, ..Counters::default() };
        let shown = limiters(&counters, &Tempo::default());
        let texts: Vec<String> = shown.iter().map(|acted| format!("{} {}", acted.count, acted.what)).collect();
        assert_eq!(texts, ["3 escaped", "1200 speeds cut"]);
    }
}
