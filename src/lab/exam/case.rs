//! What a case is: a question with a known answer.

use crate::{
    kernel::params::{Preset, Quality},
    lab::exam::{cases, world::Clockwork},
    scene::SceneError,
};
use std::{future::Future, pin::Pin};

/// All cases, in the order in which they are shown.
pub const CASES: &[Case] = &[
    cases::falling::FREE_FALL,
    cases::falling::BLOB_FALL,
    cases::drag::WIND,
    cases::drag::TERMINAL_SPEED,
    cases::rest::HYDROSTATIC,
    cases::vessels::VESSELS,
    cases::dam::DAM_BREAK,
    cases::sloshing::SLOSHING,
    cases::orifice::ORIFICE,
    cases::turning::ROTATING_BLOB,
    cases::turning::COLLISION,
    cases::shear::SHEAR_LAYER,
    cases::vortex::VORTEX,
    cases::pulse::PULSE,
];

/// A question with a known answer.
pub struct Case {
    /// Name on the command line.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// The setup and what is measured, in Markdown.
    pub setup: &'static str,
    /// The known answer and where it comes from, in Markdown.
    pub answer: &'static str,
    /// Why the tolerances are what they are, in Markdown.
    pub tolerance: &'static str,
    /// What it depends on.
    pub over: Over,
    /// Whether it takes so little time that it belongs to the quick exam.
    pub quick: bool,
    /// Simulates it.
    pub(super) run: fn(Setting, Clockwork) -> Run,
}

/// A case at work.
pub(super) type Run = Pin<Box<dyn Future<Output = Result<Vec<Finding>, SceneError>>>>;

/// What a case depends on, and so is run over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// The named qualities.
    Qualities,
    /// The air's own settings among these: cell, Courant number and advection.
    Air,
}

/// A quality that a case is run at.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// How it is called.
    pub name: String,
    /// The named quality, the first of those that share the air's settings.
    pub preset: Preset,
    /// Whether rows must pass: at `balanced` and better.
    pub binding: bool,
}

impl Setting {
    /// A named quality.
    pub(super) fn of(preset: Preset) -> Self {
        Self { name: preset.name().to_owned(), preset, binding: is_binding(preset) }
    }

    /// The settings of the air that these qualities have, each once.
    pub(super) fn airs(presets: &[Preset]) -> Vec<Self> {
        let air = |preset: Preset| {
            let Quality { air_cell, air_courant, air_advection, .. } = preset.quality();
            (air_cell, air_courant, air_advection)
        };
        let mut settings: Vec<Self> = Vec::new();
        for &preset in presets {
            match settings.iter_mut().find(|setting| air(setting.preset) == air(preset)) {
                Some(setting) => setting.binding |= is_binding(preset),
                None => {
                    let (cell, courant, advection) = air(preset);
                    let name = format!("cell {cell} d, Courant {courant}, {}", advection.words());
                    settings.push(Self { name, ..Self::of(preset) });
                }
            }
        }
        settings.sort_by(|a, b| air(b.preset).0.total_cmp(&air(a.preset).0));
        settings
    }
}

fn is_binding(preset: Preset) -> bool {
    matches!(preset, Preset::Balanced | Preset::Fine | Preset::Reference)
}

/// How far from the known answer still passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Tolerance {
    /// A share of the answer.
    Share(f64),
    /// In the unit of the answer.
    Within(f64),
}

/// What a case found out about one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Finding {
    pub quantity: &'static str,
    pub unit: &'static str,
    pub expected: f64,
    pub got: f64,
    pub tolerance: Tolerance,
}
