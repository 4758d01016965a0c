//! The world of a miniature: a scene with few particles, so that a tick takes a fraction of a millisecond.

use crate::{
    kernel::{
        params::Preset,
        units::{TICK_SECONDS, TICKS_PER_SECOND},
    },
    lab::{jobs::pause, miniature::painter::Painter},
    scene::{SceneError, SceneFile, blueprint::Blueprint, effects::EffectModes},
    sim::{intent::Intent, simulation::Simulation, workers::Workers},
};
use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
    mpsc::Sender,
};

/// Particles that a miniature is to have.
const MANY: f64 = 2500.0;
/// Coarsest detail: walls as thick as scenes have them still hold.
const COARSEST: f64 = 0.4;
/// How long after its moment a miniature is mostly looked at, s.
const LOOK: f64 = 8.0;
/// Ticks of the run-up between two pictures: half a second.
const BETWEEN: u64 = 30;

/// A scene as a small moving picture.
pub struct Miniature {
    simulation: Simulation,
    painter: Painter,
    moment: u64,
    tick: u64,
    /// Counts the ticks of all miniatures of one owner.
    ticks: Arc<AtomicU64>,
}

impl Miniature {
    /// The start of a scene. `ticks` is counted up by each of its ticks.
    ///
    /// # Errors
    /// If the scene can't be built: one line that says why.
    pub fn begin(scene: &SceneFile, ticks: Arc<AtomicU64>) -> Result<Self, SceneError> {
        let moment = (scene.moment() * f64::from(TICKS_PER_SECOND)).round() as u64;
        Ok(Self::of_blueprint(build(scene)?, moment, ticks))
    }

    /// The start of a world that is shown up to a moment, in ticks, in its run-up.
    pub(super) fn of_blueprint(blueprint: Blueprint, moment: u64, ticks: Arc<AtomicU64>) -> Self {
        let painter = Painter::new(&blueprint);
        let simulation = Simulation::new(Arc::new(blueprint), Workers::single());
        Self { simulation, painter, moment, tick: 0, ticks }
    }

    /// Has the next tick do something.
    pub(super) fn push(&mut self, intent: Intent) {
        self.simulation.push(intent);
    }

    /// Ticks that it has run.
    pub fn age(&self) -> u64 {
        self.tick
    }

    /// Runs a tick.
    pub fn tick(&mut self) {
        self.simulation.tick();
        self.tick += 1;
        self.ticks.fetch_add(1, Ordering::Relaxed);
    }

    /// Draws it: [`WIDTH`](super::WIDTH) × [`HEIGHT`](super::HEIGHT) pixels of red, green, blue and opacity, row by row from the top.
    pub fn draw(&mut self) -> &[u8] {
        self.painter.draw(self.simulation.world())
    }

    fn is_before_its_moment(&self) -> bool {
        self.tick < self.moment
    }
}

/// The scene at a detail at which it is cheap; one whose emitters are too thin for that has few particles at its own.
fn build(scene: &SceneFile) -> Result<Blueprint, SceneError> {
    let at = |detail| scene.clone().at_detail(detail).build(&[], Some(Preset::Fast), &EffectModes::new());
    let blueprint = at(1.0)?;
    let detail = (MANY / expected(&blueprint, scene.moment() + LOOK)).sqrt().clamp(COARSEST, 1.0);
    Ok(at(detail).unwrap_or(blueprint))
}

/// Movable particles that a world may have after so many seconds, at least 1.
fn expected(blueprint: &Blueprint, seconds: f64) -> f64 {
    let flows = blueprint.emitters.iter().map(|emitter| {
        let flowed = f64::from(emitter.rate) * (seconds - emitter.start as f64 * f64::from(TICK_SECONDS)).max(0.0);
        emitter.total.map_or(flowed, |total| flowed.min(f64::from(total)))
    });
    blueprint.particles.len().max(1) as f64 + flows.sum::<f64>()
}

/// How far a run-up is.
pub enum Progress {
    /// A picture from the way there.
    Picture(Vec<u8>),
    /// It looks its best; this is its picture.
    Ready(Box<Miniature>, Vec<u8>),
    /// It can't be built: why.
    Failed(SceneError),
}

/// Runs a scene up to the moment at which it looks its best, and shows the way there.
pub async fn run_up(scene: SceneFile, ticks: Arc<AtomicU64>, sender: Sender<Progress>) {
    let mut miniature = match Miniature::begin(&scene, ticks) {
        Ok(miniature) => miniature,
        Err(error) => return drop(sender.send(Progress::Failed(error))),
    };
    while miniature.is_before_its_moment() {
        if miniature.tick.is_multiple_of(BETWEEN) && sender.send(Progress::Picture(miniature.draw().to_vec())).is_err()
        {
            return;
        }
        pause().await;
        miniature.tick();
    }
    pause().await;
    let picture = miniature.draw().to_vec();
    drop(sender.send(Progress::Ready(Box::new(miniature), picture)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        lab::{
            jobs::finish,
            miniature::{HEIGHT, WIDTH},
        },
        scene,
    };
    use std::sync::mpsc::channel;

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "heavy: natively only")]
    fn every_scene_is_cheap_and_its_run_up_ends_with_a_picture_of_its_moment() {
        for name in scene::builtin_names() {
            let scene = scene::load(name).expect(name);
            let blueprint = build(&scene).expect(name);
            let count = expected(&blueprint, scene.moment() + LOOK);
            assert!(count < 1.7 * MANY, "{name}: {count} particles");
            let ticks = Arc::new(AtomicU64::new(0));
            let (sender, messages) = channel();
            finish(run_up(scene.clone(), ticks.clone(), sender), || true).expect("nothing stops it");
            let ran = (60.0 * scene.moment()).round() as u64;
            assert_eq!(ticks.load(Ordering::Relaxed), ran, "{name}");
            let told: Vec<Progress> = messages.into_iter().collect();
            assert_eq!(
                told.len() as u64,
                1 + ran.div_ceil(BETWEEN),
                "{name}: a picture at the start, then each half second"
            );
            let Some(Progress::Ready(mut miniature, picture)) = told.into_iter().last() else {
                panic!("{name}: no end")
            };
            assert_eq!(picture.len(), 4 * WIDTH * HEIGHT);
            assert_eq!(miniature.draw(), picture, "{name}: the same world gives the same picture");
        }
    }

    #[test]
    fn a_scene_that_can_t_be_built_says_so() {
        let text = "(title: \"x\", spacing: 1, size: (9, 9), contents: [(element: \"magma\", shape: Disc(centre: (1, 1), radius: 1))])";
        let scene = scene::from_text("bad", text).expect("it is well-formed");
        let (sender, messages) = channel();
        finish(run_up(scene, Arc::default(), sender), || true).expect("nothing stops it");
        let Ok(Progress::Failed(error)) = messages.recv() else { panic!("it is told") };
        assert!(error.to_string().contains("magma"), "{error}");
    }
}
