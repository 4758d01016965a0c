//! Tests of the air as a whole: each name says what would be wrong if it failed.

mod balance;
mod crowd;
mod energy;
mod expansion;
mod feedback;
mod law;
mod limits;
mod scheme;
mod sleep;
mod tools;
mod walls;
mod warmth;
mod waves;
mod work;

use super::Air;
use crate::element::ElementId;
use crate::parallel::{Team, in_pool};
use crate::params::{AIR_DENSITY, AirAdvection, AirParams, AirScheme, OpenSides};
use crate::random::Random;
use crate::simd::InstructionSet;
use crate::solids::Solids;
use crate::sources::Rect;
use glam::{IVec2, Vec2};

/// Speed of sound of the tests, d/s.
const SOUND: f32 = 1000.0;
const DT: f32 = 1.0 / 60.0;
const COURANT: f32 = 0.7;
const SCHEME: AirScheme = AirScheme { courant: COURANT, advection: AirAdvection::SecondOrder };
const ALONE: Team = Team { instructions: InstructionSet::Baseline, threads: 1 };

fn params(open: OpenSides) -> AirParams {
    AirParams { sound_speed: SOUND, density: AIR_DENSITY, open }
}

fn closed(columns: u32, rows: u32, cell: f32) -> Air {
    Air::new(Vec2::new(columns as f32, rows as f32) * cell, cell, params(OpenSides::default()))
}

/// Random pressures 1 ± `pressure` and velocities ± `speed` in the open cells.
fn stir(air: &mut Air, pressure: f32, speed: f32, noise: &mut Random) {
    for row in 0..air.rows() {
        for k in air.row_range(row) {
            if !air.solid[k] {
                air.pressure[k] = 1.0 + pressure * noise.offset();
                air.velocity_x[k] = speed * noise.offset();
                air.velocity_y[k] = speed * noise.offset();
            }
        }
    }
    air.quiet = false;
}

/// Gravity of the tests, d/s².
const GRAVITY: Vec2 = Vec2::new(30.0, -98.1);

/// Random temperatures of 88 to 1,172 K in the open cells.
fn warm(air: &mut Air, noise: &mut Random) {
    air.warmth = air.solid.iter().map(|solid| if *solid { 0.0 } else { 1.15 + 1.85 * noise.offset() }).collect();
    air.set_gravity(GRAVITY);
    air.quiet = false;
}

/// Rock on the cells of a box of `columns × rows` d for which `wanted` holds.
fn rock(columns: u32, rows: u32, mut wanted: impl FnMut(i32, i32) -> bool) -> Solids {
    let mut solids = Solids::new(columns, rows);
    for y in 0..rows as i32 {
        for x in 0..columns as i32 {
            if wanted(x, y) {
                solids.insert(IVec2::new(x, y), ElementId(0), 0);
            }
        }
    }
    solids
}

fn rect(x0: f32, y0: f32, x1: f32, y1: f32) -> Rect {
    Rect { min: Vec2::new(x0, y0), max: Vec2::new(x1, y1) }
}

fn run(air: &mut Air, ticks: u32) {
    for _ in 0..ticks {
        air.step(&[], SCHEME, ALONE, DT);
    }
}

fn energy(air: &Air) -> f64 {
    air.kinetic_energy() + air.pressure_energy()
}

fn assert_sane(air: &Air) {
    let finite = |field: &[f32]| field.iter().all(|value| value.is_finite());
    assert!(finite(&air.pressure) && finite(&air.velocity_x) && finite(&air.velocity_y));
    assert!(air.pressure.iter().all(|p| *p >= 0.0), "a pressure is negative");
}

fn bits(air: &Air) -> Vec<u32> {
    let fields = [&air.pressure, &air.velocity_x, &air.velocity_y, &air.warmth, &air.outside];
    fields.into_iter().flatten().map(|value| value.to_bits()).collect()
}
