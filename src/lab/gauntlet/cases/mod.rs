//! The hard cases, by what is hard about them.

mod air;
mod common;
mod crowd;
mod depth;
pub(super) mod ends;
mod gravity;
mod impact;
mod matter;
mod play;
mod rock;

use crate::lab::gauntlet::case::GauntletCase;

/// All cases, in the order in which they are shown.
pub const CASES: &[GauntletCase] = &[
    crowd::TWO_AT_A_POINT,
    crowd::POINT_64,
    crowd::POINT_10000,
    crowd::GRID_TENTH,
    crowd::GRID_THIRD,
    crowd::SPAWN_OVER_WATER,
    crowd::CLOSE_PAIRS,
    depth::DAM_BREAK,
    depth::CLUMPS,
    depth::POOL,
    depth::FULL_BOX,
    depth::DEEP_TANK,
    depth::SHAFT,
    depth::NARROW_SHAFT,
    depth::OVERFULL_SHAFT,
    depth::CORNER_100G,
    depth::WEDGE,
    impact::SHOTS,
    impact::FALLING_BLOCK,
    impact::BULLET,
    gravity::FLIPPING,
    gravity::TURNING,
    gravity::WEIGHTLESS,
    gravity::FLOATING,
    air::WIND_1000,
    air::PRESSURE_1E6,
    air::SUCTION,
    air::VACUUM,
    air::ONE_CELL,
    air::ONE_CELL_HOLE,
    air::SEALED_ROCK,
    air::VORTEX,
    air::OPEN_BOX,
    matter::VORTICITY_BOUND,
    matter::VORTICITY_BEYOND,
    matter::VISCOSITY_BOUND,
    matter::VISCOSITY_BEYOND,
    matter::DRAG_HUGE,
    matter::DRAG_LIGHT,
    matter::HEAVY_ABOVE_LIGHT,
    rock::ROCK_OVER_WATER,
    rock::ROCK_ERASED,
    ends::ENDS_1,
    ends::ENDS_2,
    ends::ENDS_3,
    ends::ENDS_4,
    ends::ENDS_5,
    ends::ENDS_6,
    ends::ENDS_7,
    ends::SPACING_1_MM,
    ends::SPACING_10_M,
    ends::FAR_AWAY,
    ends::MILLION,
    ends::NOBODY,
    play::HITCHES,
    play::QUALITY_CHANGES,
    play::EFFECTS_TOGGLE,
    play::MOUSE_MINUTE,
    play::POISON,
];
