//! A world at another detail: the scene, the state, and what holds both together. The kernel carries particles, rock
//! and air over (`kernel::resample`); here are the limits, the sources and what has to begin anew.

use crate::{
    kernel::{
        params::{AirParams, Domain, FluidParams, Preset},
        particles::Particles,
        predictor::Kept,
        resample::{make_room, resample_particles, resample_rock, settle},
        sleep::SleepRecord,
        solids::Solids,
        sources::{Drain, Rect, Wind},
        units::Scale,
    },
    scene::{DETAIL, MOST_CELLS, MOST_DETAIL, SIDE, blueprint::Blueprint},
    sim::{
        snapshot::{Clock, Snapshot, Sources},
        springs::{scaled, scaled_area, scaled_place},
        state::Setup,
    },
};
use std::{borrow::Cow, sync::Arc};

/// The largest factor that is done at once.
const LARGEST_STEP: f64 = 2.0;
/// From here on ids count from 0 again, so that no number of changes comes to their end.
const LAST_ID: u32 = u32::MAX / 2;

impl Setup {
    /// The detail that was asked for: without what the quality brings along.
    pub fn asked_detail(&self) -> f64 {
        f64::from(self.blueprint.scale.detail) / self.preset.detail()
    }

    /// The set-up at a preset whose own detail comes on top of one that is `asked` for; the numbers of the quality are
    /// left to the caller.
    ///
    /// # Errors
    /// If there is no such detail, or the box would have too many or too few cells at it: one line that says what is
    /// allowed.
    pub(super) fn at_detail(&self, asked: f64, preset: Preset) -> Result<Self, String> {
        let factor = self.factor(asked, preset)?;
        let own = asked * preset.detail();
        let known = (f64::from(self.opened.scale.detail) - own).abs() < 1e-6 * own;
        let blueprint = if known { self.opened.clone() } else { Arc::new(rescaled(&self.blueprint, factor, preset)?) };
        let domain = Domain { size: blueprint.domain.size, gravity: self.domain.gravity * factor as f32 };
        Ok(Self { blueprint, domain, preset, ..self.clone() })
    }

    /// The state that the scene or the save file begins with, at the detail in force.
    pub(super) fn start(&self) -> Arc<Snapshot> {
        let Self { blueprint, opened, origin, .. } = self;
        if Arc::ptr_eq(blueprint, opened) {
            return origin.clone();
        }
        // A start that does not fit the detail is not one that was ever in it: then there is nothing in the box.
        let start = origin.resampled(opened, blueprint, self.quality.air_cell);
        start.map_or_else(|_| Arc::new(Snapshot::of_blueprint(blueprint, self.quality.air_cell)), Arc::new)
    }

    /// New d in one of the d in force, see [`Setup::at_detail`].
    fn factor(&self, asked: f64, preset: Preset) -> Result<f64, String> {
        let range = DETAIL;
        // What went through another unit may miss the ends by a rounding.
        let holds = asked >= range.min * (1.0 - 1e-6) && asked <= range.max * (1.0 + 1e-6);
        let own = asked * preset.detail();
        if !holds || own > MOST_DETAIL * (1.0 + 1e-6) {
            return Err(format!("detail {asked} is out of range; allowed: {range}"));
        }
        Ok(own / f64::from(self.blueprint.scale.detail))
    }
}

/// The scene with `factor` new d in one of its own. It has no start: [`Setup::opened`] has it.
fn rescaled(scene: &Blueprint, factor: f64, preset: Preset) -> Result<Blueprint, String> {
    let (spacing, detail) = (f64::from(scene.scale.spacing) / factor, f64::from(scene.scale.detail) * factor);
    let scale = Scale { spacing: spacing as f32, detail: detail as f32 };
    // Rounded as a scene's size is, so that whole numbers of cells stay whole.
    let size = (scene.domain.size.as_dvec2() * factor * 1e6).round() / 1e6;
    let cells = size.ceil();
    let fits = |side: f64| (SIDE.min..=SIDE.max).contains(&side);
    if !fits(size.x) || !fits(size.y) || cells.x * cells.y > MOST_CELLS {
        return Err(format!(
            "at detail {detail} the box has {} × {} cells; allowed: {} to {} along a side, at most {MOST_CELLS} in all",
            cells.x, cells.y, SIDE.min, SIDE.max
        ));
    }
    let sources =
        Sources { emitters: scene.emitters.clone(), winds: scene.winds.clone(), drains: scene.drains.clone() };
    let Sources { emitters, winds, drains } = rescaled_sources(&sources, factor);
    Ok(Blueprint {
        scale,
        domain: Domain { size: size.as_vec2(), gravity: scene.domain.gravity * factor as f32 },
        particles: Default::default(),
        solids: Default::default(),
        next_id: 0,
        emitters,
        winds,
        drains,
        pressures: Vec::new(),
        air: AirParams { sound_speed: scene.air.sound_speed * factor as f32, ..scene.air },
        preset,
        ..scene.clone()
    })
}

fn rescaled_sources(sources: &Sources, factor: f64) -> Sources {
    let area = |area: Rect| scaled_area(area, factor);
    let wind = |wind: &Wind| Wind { area: area(wind.area), velocity: scaled_place(wind.velocity, factor), ..*wind };
    Sources {
        emitters: sources.emitters.iter().map(|emitter| scaled(emitter, factor)).collect(),
        winds: sources.winds.iter().map(wind).collect(),
        drains: sources.drains.iter().map(|drain| Drain { area: area(drain.area) }).collect(),
    }
}

/// How many particles a number of them becomes, if that is allowed.
pub(super) fn count_at(count: usize, from: &Blueprint, to: &Blueprint) -> Result<f64, String> {
    let count = (count as f64 * (f64::from(from.scale.spacing) / f64::from(to.scale.spacing)).powi(2)).round();
    let most = to.most_particles();
    if count <= f64::from(most) {
        return Ok(count);
    }
    let detail = to.scale.detail;
    Err(format!("{count} particles at detail {detail}, but the limit is {most}; allowed: a lower detail"))
}

impl Snapshot {
    /// The same state from one set-up of a scene in another, with the air on cells of `air_cell` d.
    ///
    /// Matter, momentum, rock, air, and what the sources gave are carried over; ids are fresh, all is awake, and the
    /// first guess of the pressure is none.
    ///
    /// # Errors
    /// If there would be more particles than the world may hold: one line that says what is allowed.
    pub(super) fn resampled(&self, from: &Blueprint, to: &Blueprint, air_cell: f32) -> Result<Self, String> {
        let factor = f64::from(from.scale.spacing) / f64::from(to.scale.spacing);
        // Looked at before memory is taken.
        count_at(self.particles.len() + self.solids.count(), from, to)?;
        let mut next_id = if self.clock.next_id < LAST_ID { self.clock.next_id } else { 0 };
        let mut solids = resample_rock(&self.solids, factor, to.domain.size, &mut next_id);
        make_room(&mut solids, &self.particles, factor, &to.domain);
        let target = (&to.domain, &to.fluid);
        let particles = particles_in(&self.particles, &self.solids, factor, &solids, target, &mut next_id);
        let mut air = self.air.rescaled(factor as f32, to.domain.size, to.air).resized(air_cell);
        air.set_solids(&solids);
        Ok(Self {
            particles,
            solids,
            air,
            kept: Kept::default(),
            sleep: SleepRecord::default(),
            sources: rescaled_sources(&self.sources, factor),
            clock: Clock { next_id, ..self.clock },
            books: self.books.clone(),
        })
    }
}

/// Particles that stand among the rock `old`, among that of a box of other d, `solids`. Where each becomes more than four, this
/// is done in steps: a crowd as wide as a step is settled in as many rounds whatever the factor.
pub(super) fn particles_in(
    particles: &Particles,
    old: &Solids,
    factor: f64,
    solids: &Solids,
    (box_of, fluid): (&Domain, &FluidParams),
    next_id: &mut u32,
) -> Particles {
    let steps = (factor / LARGEST_STEP).log2().ceil().max(0.0) as i32;
    let mut done = factor / LARGEST_STEP.powi(steps);
    let mut particles = Cow::Borrowed(particles);
    for step in 0..=steps {
        let part = if step == 0 { done } else { LARGEST_STEP };
        done = if step == 0 { done } else { done * LARGEST_STEP };
        let size = (box_of.size.as_dvec2() * (done / factor)).as_vec2();
        let domain = Domain { size, ..*box_of };
        let is_last = step == steps;
        // Ids on the way are nobody's.
        let (mut rock_id, mut id) = (0, 0);
        let between = (!is_last).then(|| resample_rock(old, done, size, &mut rock_id));
        let rock = between.as_ref().unwrap_or(solids);
        let ids = if is_last { &mut *next_id } else { &mut id };
        let mut next = resample_particles(&particles, part, rock, &domain, ids);
        settle(&mut next, rock, &domain, fluid);
        particles = Cow::Owned(next);
    }
    particles.into_owned()
}
