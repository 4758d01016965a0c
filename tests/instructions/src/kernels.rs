//! The hot kernels, each on a fixed state, on one thread and the lanes of AVX2 (valgrind 3.19 has no AVX-512).

use crate::{
    tank::{SUBSTEP, Tank},
    warm::WarmTank,
};
use glam::{IVec2, Vec2};
use powder_master::kernel::{
    air::Air,
    element::{ElementId, ElementParams},
    forces::{self, LaterDrag},
    parallel::Team,
    params::{AIR_DENSITY, AirAdvection, AirParams, AirScheme, OpenSides},
    predictor::{GrainParams, Predictor},
    simd::InstructionSet,
    solids::Solids,
    velocity,
};
use std::hint::black_box;

/// Names of the kernels.
pub const NAMES: [&str; 10] =
    ["bin", "solve", "velocity", "viscosity", "vorticity", "predictor", "grains", "drag", "air", "heat"];

/// The instruction set that is counted, if this processor has it.
pub fn counted_set() -> Option<InstructionSet> {
    InstructionSet::available().into_iter().find(|set| set.name() == "avx2")
}

/// What is counted: callgrind collects from here on and up to the return.
#[inline(never)]
pub fn counted<S>(state: &mut S, kernel: impl FnOnce(&mut S)) {
    kernel(black_box(state));
}

/// Runs a kernel once on its state. `false` if there is none of that name.
pub fn run(name: &str, set: InstructionSet) -> bool {
    let mut tank = Tank::new(set);
    let liquid = ElementParams {
        drag: vec![0.001],
        viscosity: vec![0.02],
        vorticity: vec![0.01],
        mass: vec![1000.0],
        ..ElementParams::default()
    };
    match name {
        "bin" => {
            // Sorting what is sorted is cheaper than what a tick does.
            tank.predict();
            counted(&mut tank, Tank::bin);
        }
        "solve" => counted(&mut tank, |tank| tank.solve(1)),
        "velocity" => counted(&mut tank, Tank::update_velocities),
        "viscosity" => counted(&mut tank, |tank| {
            velocity::apply_viscosity(&mut tank.particles, &mut tank.solver, &tank.domain, &liquid, 1, SUBSTEP);
        }),
        "vorticity" => counted(&mut tank, |tank| {
            velocity::apply_vorticity(&mut tank.particles, &mut tank.solver, &liquid, f64::MAX, 1, SUBSTEP);
        }),
        // The first run sets out from no pressure.
        "predictor" => {
            tank.predictor = Predictor::default();
            counted(&mut tank, Tank::project);
        }
        // A heap of sand, some 200 lumps, in a corner of the water.
        "grains" => {
            for i in 0..tank.particles.len() {
                let at = tank.particles.position(i);
                tank.particles.element[i] = ElementId(u8::from(at.x + at.y < 20.0));
            }
            let of = GrainParams { sines: &[0.0, 0.5], cohesion: &[0.0; 2] };
            tank.project_with(Some(of));
            counted(&mut tank, |tank| tank.project_with(Some(of)));
        }
        "drag" => {
            let air = windy();
            counted(&mut tank, |tank| {
                forces::apply_drag(&air, &liquid, &mut tank.particles, &mut LaterDrag::default(), 1, SUBSTEP);
            });
        }
        "air" => counted(&mut windy(), |air| {
            let scheme = AirScheme { courant: 0.7, advection: AirAdvection::SecondOrder };
            air.step(&[], scheme, Team { instructions: set, threads: 1 }, SUBSTEP);
        }),
        "heat" => counted(&mut WarmTank::new(set), WarmTank::flow),
        _ => return false,
    }
    true
}

/// Wind about a wall with gaps, on 64 × 48 cells.
fn windy() -> Air {
    let mut solids = Solids::new(256, 192);
    for y in (0..192).filter(|y| y % 64 > 16) {
        solids.insert(IVec2::new(100, y), ElementId(0), 0);
    }
    let mut air = Air::new(
        Vec2::new(256.0, 192.0),
        4.0,
        AirParams { sound_speed: 1000.0, density: AIR_DENSITY, open: OpenSides::default() },
    );
    air.set_solids(&solids);
    air.blow(Vec2::new(80.0, 60.0), 60.0, Vec2::new(150.0, 60.0));
    air
}
