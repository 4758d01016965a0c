//! The air follows the rock.

use crate::sim::state::{AirGrid, Counters, Rock};
use bevy::prelude::{Res, ResMut};

/// Shows the air what rock came and went in the tick, so that it passes where rock melted, burned, broke or was eaten, and stops
/// where matter became rock.
pub(super) fn show_to_air(mut air: ResMut<AirGrid>, mut counters: ResMut<Counters>, rock: Res<Rock>) {
    air.set_solids(&rock);
    counters.add_air(&air.take_report());
}
