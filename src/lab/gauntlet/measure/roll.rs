//! The roll call: nobody is missing but what heat made air of, nobody came but from an emitter, and the counts that the program
//! keeps are right.

use crate::sim::state::{Books, Census, Clock, ParticleStore, Rock, Setup, Sources};
use bevy::ecs::world::World;

/// Who is there before a tick, and must be after it.
#[derive(Clone, Debug)]
pub(in crate::lab::gauntlet) struct Roll {
    /// Ids of the rock and of the particles that no drain takes, ascending.
    ids: Vec<u32>,
    /// The first id that is free.
    next: u32,
    /// What the emitters gave so far.
    given: u64,
    rock: u64,
    /// Lumps that heat made air of, and that it made rock or melted, so far.
    changed: [u64; 2],
}

impl Roll {
    /// The roll of a world whose next tick begins.
    pub fn of(world: &World) -> Self {
        let particles = &world.resource::<ParticleStore>().0;
        let drains = &world.resource::<Sources>().drains;
        let stays = |i: &usize| !drains.iter().any(|drain| drain.area.contains(particles.position(*i)));
        let rock = &world.resource::<Rock>().0;
        let of_rock = rock.iter().map(|(.., id)| id);
        let mut ids: Vec<u32> = (0..particles.len()).filter(stays).map(|i| particles.id[i]).chain(of_rock).collect();
        ids.sort_unstable();
        Self {
            ids,
            changed: changed(world),
            next: world.resource::<Clock>().next_id,
            given: given(world),
            rock: rock.version(),
        }
    }

    /// Calls the roll after the tick; the error is who is missing, or came from nowhere, or what is counted wrongly.
    pub fn call(&self, world: &World) -> Result<(), String> {
        let particles = &world.resource::<ParticleStore>().0;
        let rock = &world.resource::<Rock>().0;
        let mut ids: Vec<u32> = particles.id.iter().copied().chain(rock.iter().map(|(.., id)| id)).collect();
        ids.sort_unstable();
        let [gone, turned] = [0, 1].map(|k| changed(world)[k] - self.changed[k]);
        let (old, new) = ids.split_at(ids.partition_point(|id| *id < self.next));
        let missing = self.ids.iter().filter(|id| old.binary_search(id).is_err()).count() as u64;
        let (came, gave) = (new.len() as u64, given(world) - self.given);
        demand(came <= gave, || format!("{came} particles came where emitters gave {gave}"))?;
        // What an emitter gave may be gone in the same tick.
        let went = missing + gave - came;
        demand(went == gone, || format!("{went} particles went, {gone} into the air"))?;
        demand(old.len() as u64 + missing == self.ids.len() as u64, || {
            "particles that were gone came back".to_owned()
        })?;
        demand(rock.version() == self.rock || turned > 0, || "rock changed in a tick".to_owned())?;
        counts(ids, gone, world)
    }
}

/// What all emitters gave so far.
fn given(world: &World) -> u64 {
    world.resource::<Sources>().emitters.iter().map(|emitter| u64::from(emitter.given)).sum()
}

/// Lumps that heat made air of, and that it made rock or melted, so far.
fn changed(world: &World) -> [u64; 2] {
    let books = world.resource::<Books>();
    [books.gone, books.turned]
}

/// Ids, ascending, are unique, the census is right but for those that have `gone` since, and limits are kept.
fn counts(ids: Vec<u32>, gone: u64, world: &World) -> Result<(), String> {
    demand(ids.windows(2).all(|pair| pair[0] != pair[1]), || "an id was given twice".to_owned())?;
    let next = world.resource::<Clock>().next_id;
    demand(ids.last().is_none_or(|id| *id < next), || format!("an id above {next} was never given"))?;
    let census = world.resource::<Census>();
    let total: u32 = census.by_element.iter().sum();
    demand(u64::from(census.total) == ids.len() as u64 + gone && total == census.total, || {
        format!("{} particles, but the census has {} and {total}", ids.len(), census.total)
    })?;
    let limit = world.resource::<Setup>().blueprint.most_particles() as usize;
    demand(ids.len() <= limit, || format!("{} particles; the limit is {limit}", ids.len()))?;
    for emitter in &world.resource::<Sources>().emitters {
        let within = emitter.total.is_none_or(|total| emitter.given <= total);
        // Due is at most a particle and what a tick gives: 10⁶ a second at 16 times the detail.
        demand(within && (0.0..1e7).contains(&emitter.due), || format!("an emitter that gave {emitter:?}"))?;
    }
    Ok(())
}

fn demand(holds: bool, fault: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(fault()) }
}
