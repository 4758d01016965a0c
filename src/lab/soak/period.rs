//! What is seen in a period of a soak.

use super::times::Times;
use serde::{Deserialize, Serialize};

/// What is measured of a world once a second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Look {
    /// Movable particles.
    pub particles: f64,
    /// Kinetic energy of the particles, J for each metre of depth.
    pub kinetic: f64,
    /// The same with the potential energy, J for each metre of depth.
    pub energy: f64,
    /// Mass of the air, in cells at the surroundings' pressure.
    pub air_mass: f64,
    /// Kinetic energy of the air, in its own units.
    pub air_energy: f64,
    /// Memory of the process, bytes; only on Linux.
    pub resident: Option<f64>,
}

/// The period at hand: sums, so that it takes the same memory however long it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Period {
    times: Times,
    looks: u64,
    /// Sums over the looks; the memory is the most.
    sum: Look,
    particles_peak: f64,
    kinetic_peak: f64,
}

impl Period {
    /// A tick, ms.
    pub fn tick(&mut self, ms: f64) {
        self.times.add(ms);
    }

    /// A look at the world.
    pub fn look(&mut self, look: Look) {
        let Self { looks, sum, particles_peak, kinetic_peak, .. } = self;
        *looks += 1;
        sum.particles += look.particles;
        sum.kinetic += look.kinetic;
        sum.energy += look.energy;
        sum.air_mass += look.air_mass;
        sum.air_energy += look.air_energy;
        // Of an energy that is no number the mean tells.
        *particles_peak = particles_peak.max(look.particles);
        *kinetic_peak = kinetic_peak.max(look.kinetic);
        sum.resident = sum.resident.into_iter().chain(look.resident).reduce(f64::max);
    }

    /// Another process goes on with it: the memory of the one before tells nothing of this one's.
    pub fn forget_memory(&mut self) {
        self.sum.resident = None;
    }

    /// What is kept of it, `minutes` long, if it ends after `until` minutes of the soak; the next begins.
    pub fn close(&mut self, minutes: u64, until: u64) -> Totals {
        let of = |sum: f64| sum / self.looks as f64;
        let Look { particles, kinetic, energy, air_mass, air_energy, resident } = self.sum;
        let totals = Totals {
            until,
            minutes,
            ms: self.times.quantile(0.5),
            ms_p99: self.times.quantile(0.99),
            particles: of(particles),
            particles_peak: self.particles_peak,
            kinetic: of(kinetic),
            kinetic_peak: self.kinetic_peak,
            energy: of(energy),
            air_mass: of(air_mass),
            air_energy: of(air_energy),
            resident,
        };
        let mut times = std::mem::take(&mut self.times);
        times.clear();
        *self = Self { times, ..Self::default() };
        totals
    }

    /// Whether it is one of this program.
    pub fn is_sound(&self) -> bool {
        self.times.is_sound()
    }
}

/// What is kept of a period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Totals {
    /// Minutes from the start of the soak to its end.
    pub until: u64,
    /// How many it took.
    pub minutes: u64,
    /// Median tick, ms.
    pub ms: f64,
    /// 99th percentile of the ticks, ms.
    pub ms_p99: f64,
    /// Mean number of movable particles.
    pub particles: f64,
    /// The most.
    pub particles_peak: f64,
    /// Mean kinetic energy of the particles, J for each metre of depth.
    pub kinetic: f64,
    /// The highest.
    pub kinetic_peak: f64,
    /// Mean kinetic and potential energy, J for each metre of depth.
    pub energy: f64,
    /// Mean mass of the air, in cells at the surroundings' pressure.
    pub air_mass: f64,
    /// Mean kinetic energy of the air.
    pub air_energy: f64,
    /// Most memory of the process, bytes; only on Linux.
    pub resident: Option<f64>,
}
