//! How heat flows in a tick, step by step.

use super::{conduction::Exchange, lumps::Lumps, matter::Warm, rates::Rates, record::HeatRecord};

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
}

impl Heat {
    /// Lets heat flow for `dt` s, on up to `threads` threads of the current rayon pool. What goes to the air is booked.
    pub fn flow(&mut self, warm: &mut Warm, record: &mut HeatRecord, threads: usize, dt: f32) -> HeatReport {
        let Self { lumps, exchange } = self;
        let rates = Rates::new(warm.scale.spacing, dt);
        lumps.gather(warm, &rates);
        if lumps.is_empty() {
            return HeatReport::default();
        }
        let flowed = exchange.run(lumps, warm, &rates, threads);
        lumps.hand_back(warm);
        record.to_air += flowed.to_air;
        HeatReport { cuts: flowed.cuts }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.lumps.memory() + self.exchange.memory()
    }
}
