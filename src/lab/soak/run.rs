//! A soak from its start to its end.

use crate::{
    lab::{
        balance::matter,
        machine,
        soak::{
            player::{BOUT, Player},
            report::{Look, Period, Report},
        },
    },
    sim::{
        intent::IntentQueue,
        ledger::PassLedger,
        simulation::Simulation,
        state::{AirGrid, Clock, Counters, ParticleStore, Rock, Setup},
    },
};
use bevy::ecs::world::World;

/// Ticks from one look to the next.
const LOOK_EVERY: u64 = 60;

/// Plays `bouts` minutes and looks at them, in `periods` of as many minutes each; `go_on` sees after each minute what
/// there is of the report, and may end it there.
pub fn soak(
    simulation: &mut Simulation,
    seed: u64,
    bouts: u64,
    periods: u64,
    mut go_on: impl FnMut(&Report) -> bool,
) -> Report {
    let mut player = Player::new(&simulation.world().resource::<Setup>().blueprint, seed);
    let rock_before = simulation.world().resource::<Rock>().count();
    let per_period = bouts.div_ceil(periods).max(1);
    let mut report = Report { rock_before, rock_after: rock_before, ..Report::default() };
    let mut period = Period::default();
    for bout in 1..=bouts {
        for _ in 0..BOUT {
            let tick = simulation.world().resource::<Clock>().tick;
            if let Some(intent) = player.act(tick) {
                simulation.world_mut().resource_mut::<IntentQueue>().push(intent);
            }
            simulation.tick();
            let tick_time = simulation.world().resource::<PassLedger>().last_tick();
            period.tick_ms.push(tick_time.as_secs_f64() * 1e3);
            if (tick + 1).is_multiple_of(LOOK_EVERY) {
                period.looks.push(look(simulation.world()));
            }
        }
        report.minutes = bout;
        report.rock_after = simulation.world().resource::<Rock>().count();
        report.counters = *simulation.world().resource::<Counters>();
        if bout % per_period == 0 || bout == bouts {
            report.periods.push(std::mem::take(&mut period).close(bout));
        }
        if !go_on(&report) {
            break;
        }
    }
    // One that was ended early.
    if !period.looks.is_empty() {
        report.periods.push(period.close(report.minutes));
    }
    report
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
