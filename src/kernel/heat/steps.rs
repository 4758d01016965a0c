//! How heat flows in a tick, step by step.

use super::{conduction::Exchange, lumps::Lumps, matter::Warm, rates::Rates, record::HeatRecord};
use crate::{air::Contact, parallel::Team};

/// What the limiters of the exchange did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HeatReport {
    /// Lumps that would have given or taken more than evens them out, and were held to that.
    pub cuts: u64,
}

/// Buffers of the exchange, which are kept.
#[derive(Clone, Debug, Default)]
pub struct Heat {
    lumps: Lumps,
    exchange: Exchange,
    /// What the air gets for each K of a length d of surface in the last tick, quanta; 0 if none.
    of_air: f32,
}

impl Heat {
    /// Lets heat flow for `dt` s. What goes to the air is booked. `team` changes the time it takes and not a bit of the result.
    pub fn flow(&mut self, warm: &mut Warm, record: &mut HeatRecord, team: Team, dt: f32) -> HeatReport {
        let Self { lumps, exchange, of_air } = self;
        let rates = Rates::new(warm.scale.spacing, dt);
        lumps.gather(warm, &rates);
        *of_air = 0.0;
        if lumps.is_empty() {
            return HeatReport::default();
        }
        *of_air = rates.of_air();
        let flowed = exchange.run(lumps, warm, &rates, team);
        lumps.hand_back(warm);
        record.to_air += flowed.to_air;
        HeatReport { cuts: flowed.cuts }
    }

    /// The lumps that stood in the air in the last tick.
    pub fn contacts(&self) -> impl Iterator<Item = Contact> + Clone {
        let flowed = (self.of_air > 0.0).then(|| self.exchange.contacts(&self.lumps, self.of_air));
        flowed.into_iter().flatten()
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.lumps.memory() + self.exchange.memory()
    }
}
