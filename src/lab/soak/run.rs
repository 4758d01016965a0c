//! A soak from its start to its end, minute by minute.

use super::{
    journal::Entry,
    period::{Look, Period},
    player::{BOUT, Player},
    report::Report,
    sitting::Sitting,
};
use crate::{
    kernel::simd::InstructionSet,
    lab::{balance::matter, machine},
    sim::{
        checkpoint::Checkpoint,
        ledger::PassLedger,
        simulation::Simulation,
        snapshot::Snapshot,
        state::{AirGrid, Books, Clock, Counters, ParticleStore, Rock, SolverState},
        workers::Workers,
    },
};
use bevy::{ecs::world::World, platform::time::Instant};

/// Ticks from one look to the next.
const LOOK_EVERY: u64 = 60;

/// Rows of the table.
const PERIODS: u64 = 24;

/// Most minutes between two entries of a journal, and how many parts of a soak there are between them: ten minutes of a day.
const MOST_BETWEEN: u64 = 60;
/// See `MOST_BETWEEN`.
const ENTRIES: u64 = 144;

/// A scene that is played.
pub struct Soak {
    simulation: Simulation,
    player: Player,
    /// Minutes to play.
    minutes: u64,
    report: Report,
    period: Period,
    begun: Instant,
}

impl Soak {
    /// A soak of `minutes` from the start of a scene, with the player's random choices by `seed`.
    pub fn new(start: &Checkpoint, seed: u64, minutes: u64, workers: Workers, instructions: InstructionSet) -> Self {
        let blueprint = &start.setup.blueprint;
        let rock = start.state.solids.count();
        let open = blueprint.air.open;
        let report = Report {
            rock_before: rock,
            rock_after: rock,
            drained: !start.state.sources.drains.is_empty(),
            open: open.left || open.right || open.bottom || open.top,
            ..Report::default()
        };
        let player = Player::new(blueprint, seed);
        Self { player, report, ..Self::sit(start, minutes, workers, instructions) }.seated()
    }

    /// Goes on from an entry of the same soak: `start` and `minutes` are those of its beginning.
    ///
    /// # Errors
    /// If its world is no sound save: one line that says why.
    pub fn resume(
        start: &Checkpoint,
        entry: Entry,
        minutes: u64,
        workers: Workers,
        instructions: InstructionSet,
    ) -> Result<Self, String> {
        let Entry { report, mut period, hand, world, .. } = entry;
        let saved = Checkpoint::decode(&world).map_err(|error| error.to_string())?;
        // What a soak never changes is the start's: a save has the world at hand in the place of the scene's.
        let now = Checkpoint { state: saved.state, ..start.clone() };
        let mut player = Player::new(&start.setup.blueprint, 0);
        player.hand = hand;
        period.forget_memory();
        let counters = report.counters;
        let mut soak = Self { player, report, period, ..Self::sit(&now, minutes, workers, instructions) };
        *soak.simulation.get_mut::<Counters>() = counters;
        Ok(if soak.is_over() { soak } else { soak.seated() })
    }

    fn sit(start: &Checkpoint, minutes: u64, workers: Workers, instructions: InstructionSet) -> Self {
        Self {
            simulation: Simulation::resume(start, workers).with_instructions(instructions),
            player: Player::new(&start.setup.blueprint, 0),
            minutes,
            report: Report::default(),
            period: Period::default(),
            begun: Instant::now(),
        }
    }

    /// Notes who runs it from here on.
    fn seated(mut self) -> Self {
        self.report.sittings.push(Sitting {
            from: self.report.minutes,
            processor: machine::processor(),
            threads: self.simulation.get::<Workers>().threads(),
            instructions: self.simulation.get::<SolverState>().instructions.name().to_owned(),
            seconds: 0.0,
        });
        self
    }

    /// Whether all minutes are played.
    pub fn is_over(&self) -> bool {
        self.report.minutes >= self.minutes
    }

    /// Plays a minute and looks at it.
    pub fn minute(&mut self) {
        for _ in 0..BOUT {
            let tick = self.simulation.get::<Clock>().tick;
            if let Some(intent) = self.player.act(tick) {
                self.simulation.push(intent);
            }
            self.simulation.tick();
            let tick_time = self.simulation.get::<PassLedger>().last_tick();
            self.period.tick(tick_time.as_secs_f64() * 1e3);
            if (tick + 1).is_multiple_of(LOOK_EVERY) {
                self.period.look(look(self.simulation.world()));
            }
        }
        let report = &mut self.report;
        report.minutes += 1;
        report.rock_after = self.simulation.get::<Rock>().count();
        report.turned = self.simulation.get::<Books>().turned;
        report.counters = *self.simulation.get::<Counters>();
        if let Some(sitting) = report.sittings.last_mut() {
            sitting.seconds = self.begun.elapsed().as_secs_f64();
        }
        if self.in_period() == 0 || self.is_over() {
            self.close();
        }
    }

    /// Minutes of a period.
    fn per_period(&self) -> u64 {
        self.minutes.div_ceil(PERIODS).max(1)
    }

    /// Minutes of the period at hand; 0 at its end.
    fn in_period(&self) -> u64 {
        self.report.minutes % self.per_period()
    }

    fn close(&mut self) {
        let until = self.report.minutes;
        let begun = self.report.periods.last().map_or(0, |before| before.until);
        if until > begun {
            self.report.periods.push(self.period.close(until - begun, until));
        }
    }

    /// What there is of the report by the last period's end.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// What there is of the report, with the period at hand.
    pub fn finish(mut self) -> Report {
        self.close();
        self.report
    }

    /// Hash of the world.
    pub fn hash(&self) -> u64 {
        self.simulation.hash()
    }

    /// Whether a journal gets an entry after this minute.
    pub fn is_entry_due(&self) -> bool {
        let between = (self.minutes / ENTRIES).clamp(1, MOST_BETWEEN);
        self.report.minutes.is_multiple_of(between) || self.is_over()
    }

    /// What it takes to go on from here. `None` if a save does not hold this world to the bit: a particle is no number, outside
    /// or in rock. The next minute counts it as what it is.
    pub fn entry(&self, command: &[(String, String)]) -> Option<Entry> {
        let now = Checkpoint::of(self.simulation.world());
        let world = now.encode();
        let back = Checkpoint::decode(&world).ok()?.state;
        are_same(&now.state, &back).then(|| Entry {
            command: command.to_vec(),
            report: self.report.clone(),
            period: self.period.clone(),
            hand: self.player.hand.clone(),
            world,
        })
    }
}

/// Whether two states are the same to the bit, but for the marks by which a history tells its rock from what it was before.
pub(super) fn are_same(a: &Snapshot, b: &Snapshot) -> bool {
    a.hash() == b.hash() && a.kept == b.kept && a.sleep == b.sleep && a.sources == b.sources && a.clock == b.clock
}

fn look(world: &World) -> Look {
    let air = world.resource::<AirGrid>().with_grid(world.resource::<Rock>());
    let liquid = matter(world).balance();
    Look {
        particles: world.resource::<ParticleStore>().len() as f64,
        kinetic: liquid.kinetic,
        energy: liquid.energy(),
        air_mass: air.mass(),
        air_energy: air.kinetic_energy(),
        resident: machine::memory().map(|memory| memory.resident as f64),
    }
}
