//! The worlds of the cases: scenes at a quality.

pub(super) use crate::lab::cases::CaseSimulation;
use crate::{
    kernel::params::Preset,
    lab::cases::{Setting, Stopwatch},
    scene::{
        self, SceneError, SceneFile,
        blueprint::Blueprint,
        effects::{Effect, EffectModes, Mode},
    },
};
use include_dir::{Dir, include_dir};

/// Acceleration of gravity of the scenes, m/s².
pub(super) const GRAVITY: f64 = 9.81;

/// The scenes of the exam's own.
static SCENES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/exam");

/// A scene of `assets/exam`, or else of the game's menu.
pub(super) fn scene(name: &str) -> Result<SceneFile, SceneError> {
    match SCENES.get_file(format!("{name}.ron")).and_then(|file| file.contents_utf8()) {
        Some(text) => scene::from_text(name, text),
        None => scene::load(name),
    }
}

/// What the world of a case is made with.
pub(super) struct SetUp {
    pub setting: Setting,
    pub stopwatch: Stopwatch,
}

impl SetUp {
    /// At the quality whose runs at a finer spacing stand for the truth, also for those of another: `balanced`.
    pub fn of_the_truth(&self) -> Self {
        let setting = Setting { preset: Preset::Balanced, ..self.setting.clone() };
        Self { setting, stopwatch: self.stopwatch.clone() }
    }

    /// A scene of `assets/exam`, or else of the game's menu, with these parameters.
    pub fn blueprint(&self, name: &str, parameters: &[(&str, f64)]) -> Result<Blueprint, SceneError> {
        let settings: Vec<_> = parameters.iter().map(|(key, value)| ((*key).to_owned(), value.to_string())).collect();
        // What rests has to come to rest, and stay there, by the method alone.
        let awake = EffectModes::from([(Effect::Sleep, Mode::Off)]);
        scene(name)?.at_detail(self.setting.detail).build(&settings, Some(self.setting.preset), &awake)
    }

    /// The world of a blueprint.
    pub fn simulation(&self, blueprint: Blueprint) -> CaseSimulation {
        CaseSimulation::new(blueprint, &self.stopwatch)
    }

    /// The world of a scene, with these parameters.
    pub fn open(&self, name: &str, parameters: &[(&str, f64)]) -> Result<CaseSimulation, SceneError> {
        Ok(self.simulation(self.blueprint(name, parameters)?))
    }

    /// The same from this start.
    pub fn open_from(
        &self,
        name: &str,
        parameters: &[(&str, f64)],
        start: Start,
    ) -> Result<CaseSimulation, SceneError> {
        let mut blueprint = self.blueprint(name, parameters)?;
        start.arrange(&mut blueprint);
        Ok(self.simulation(blueprint))
    }
}

/// How the particles of a start stand. Runs that differ in nothing else are of equal accuracy: how far they come apart
/// is the floor of what can be measured with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Start {
    /// On the square lattice, as a scene places them.
    Lattice,
    /// Every other row half a spacing beside it: the same particles, the same density, other neighbours.
    Staggered,
}

impl Start {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Lattice, Self::Staggered];

    /// Moves the particles of a start on the lattice.
    pub fn arrange(self, blueprint: &mut Blueprint) {
        if self == Self::Staggered {
            let particles = &mut blueprint.particles;
            for (x, y) in particles.x.iter_mut().zip(&particles.y) {
                // A quarter to one side or to the other, so that the first and the last stay inside the walls.
                *x += if (*y as i32) % 2 == 0 { 0.25 } else { -0.25 };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::effects::EffectModes;

    #[test]
    fn the_staggered_start_has_the_same_rows_and_stays_inside() {
        let build = || scene::load("dam_break").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        let (lattice, mut staggered) = (build(), build());
        Start::Lattice.arrange(&mut staggered);
        assert_eq!(staggered.particles.x, lattice.particles.x);
        Start::Staggered.arrange(&mut staggered);
        assert_eq!(staggered.particles.y, lattice.particles.y);
        let moved: Vec<f32> = staggered.particles.x.iter().zip(&lattice.particles.x).map(|(a, b)| a - b).collect();
        assert!(moved.iter().all(|by| by.abs() == 0.25), "a quarter to either side");
        assert_eq!(moved.iter().sum::<f32>(), 0.0, "as many to one side as to the other");
        assert!(staggered.particles.x.iter().all(|x| (0.25..=70.75).contains(x)), "inside the block");
    }
}
