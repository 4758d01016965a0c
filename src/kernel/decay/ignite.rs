//! The tool that sets fire.

use super::table::DecayTable;
use crate::{
    brush::Stroke,
    heat::{HeatRecord, Warm, reheat_under},
};

/// By how much what is set on fire is made hotter than it must be to burn, K: it goes on losing heat until its die falls. Raising it
/// lights what is slow to light with a shorter touch, and gives more heat that is not its own.
const MARGIN: f32 = 60.0;

/// Sets fire to what can burn under the stroke: makes it hot enough to burn, unless it is. All else is left as it is.
pub fn ignite_under(warm: &mut Warm, decays: &DecayTable, stroke: &Stroke, record: &mut HeatRecord) {
    let table = warm.table;
    reheat_under(warm, stroke, record, |element, held| match decays.ignition(element) {
        Some(ignition) => held.max(table.curve(element).heat_towards(ignition + MARGIN)),
        None => held,
    });
}
