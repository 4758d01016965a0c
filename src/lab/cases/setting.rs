//! The qualities that a case is run at.

use crate::kernel::params::{AirAdvection, Preset, Quality};
use serde::Deserialize;

/// What a case depends on. Runs that differ in nothing else are the same run, and done once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Over {
    /// The named qualities.
    #[default]
    Qualities,
    /// The air's own settings among these: cell, Courant number and advection.
    Air,
    /// Whether it is `classic`, which solves no pressure beforehand: the case sets every number of the quality.
    Method,
    /// The spacing: `balanced`, and `classic` beside it, which promises nothing.
    Refinement,
    /// Nothing: the case chooses its qualities by itself.
    Nothing,
}

/// A quality that a case is run at.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// How it is called.
    pub name: String,
    /// The named quality, the first of those that make no difference to the case.
    pub preset: Preset,
    /// How many times finer than its own the spacing of each scene is, beside what the quality brings along
    /// ([`Preset::detail`]).
    pub detail: f64,
    /// Whether the case must hold: at `balanced` and better.
    pub binding: bool,
}

impl Over {
    /// Whether a case has the same runs at both qualities.
    pub fn same(self, a: Preset, b: Preset) -> bool {
        match self {
            Self::Qualities | Self::Refinement => a == b,
            Self::Air => air(a) == air(b),
            Self::Method => (a == Preset::Classic) == (b == Preset::Classic),
            Self::Nothing => true,
        }
    }

    /// The settings that these qualities make at a detail, each once.
    pub(super) fn settings(self, presets: &[Preset], detail: f64) -> Vec<Setting> {
        let mut settings: Vec<Setting> = Vec::new();
        let wanted =
            |preset: &&Preset| self != Self::Refinement || [Preset::Classic, Preset::Balanced].contains(preset);
        for &preset in presets.iter().filter(wanted) {
            let binding = matches!(preset, Preset::Balanced | Preset::Fine | Preset::Reference);
            match settings.iter_mut().find(|setting| self.same(setting.preset, preset)) {
                Some(setting) => setting.binding |= binding,
                None => settings.push(Setting { name: self.name(preset, detail), preset, detail, binding }),
            }
        }
        if self == Self::Air {
            settings.sort_by(|a, b| air(b.preset).0.total_cmp(&air(a.preset).0));
        }
        settings
    }

    fn name(self, preset: Preset, detail: f64) -> String {
        match (self, air(preset)) {
            (Self::Air, (cell, courant, advection)) => {
                format!("cell {} d, Courant {courant}, {}", f64::from(cell) / detail, advection.words())
            }
            _ => preset.name().to_owned(),
        }
    }
}

/// Edge of a cell in the scene's own spacings, Courant number and advection.
fn air(preset: Preset) -> (f32, f32, AirAdvection) {
    let Quality { air_cell, air_courant, air_advection, .. } = preset.quality();
    (air_cell / preset.detail() as f32, air_courant, air_advection)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn air_is_examined_once_for_each_of_its_settings() {
        let count = |presets: &[Preset]| Over::Air.settings(presets, 1.0).len();
        assert_eq!(count(&[Preset::Fast, Preset::Fast]), 1);
        assert_eq!(count(&[Preset::Fast, Preset::Balanced]), 2, "another air is another setting");
        let same_cells = [Preset::Classic, Preset::Balanced];
        assert!(same_cells.iter().all(|preset| preset.quality().air_cell == 4.0));
        assert_eq!(count(&same_cells), 2, "another advection is another setting");
        let binding = Over::Air.settings(&same_cells, 1.0).iter().filter(|setting| setting.binding).count();
        assert_eq!(binding, 1, "classic promises nothing");
    }

    #[test]
    fn what_makes_no_difference_is_run_once() {
        let names = |over: Over, presets: &[Preset]| {
            over.settings(presets, 1.0).into_iter().map(|setting| setting.name).collect::<Vec<_>>()
        };
        assert_eq!(names(Over::Qualities, &Preset::ALL), Preset::ALL.map(Preset::name));
        assert_eq!(names(Over::Method, &Preset::ALL), ["classic", "draft"]);
        assert_eq!(names(Over::Method, &[Preset::Fine, Preset::Reference]), ["fine"]);
        assert_eq!(names(Over::Nothing, &Preset::ALL), ["classic"]);
        assert_eq!(names(Over::Refinement, &Preset::ALL), ["classic", "balanced"]);
        assert_eq!(names(Over::Refinement, &[Preset::Fine]), [""; 0]);
    }
}
