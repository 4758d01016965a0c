//! All particles, in the order of their ids.

use crate::{
    kernel::{
        particles::{Particles, Value},
        solids,
    },
    sim::state::{ParticleStore, Rock, Setup},
};
use bevy::ecs::world::World;
use glam::Vec2;
use std::io::{self, Write};

/// Writes the table: the columns of the particles, elements by name; rock stands still.
pub fn write(world: &World, out: impl Write) -> io::Result<()> {
    let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
    let setup = world.resource::<Setup>();
    let mut all = particles.0.clone();
    for (cell, element, id) in rock.iter() {
        all.push(id, element, solids::centre(cell), Vec2::ZERO);
    }
    let mut table = csv::Writer::from_writer(out);
    table.write_record(Particles::COLUMNS)?;
    for i in all.in_id_order() {
        table.write_record(all.get(i as usize).values().map(|value| match value {
            Value::Id(id) => id.to_string(),
            Value::Element(element) => setup.elements().get(element).name.clone(),
            Value::Length(value) | Value::Velocity(value) => setup.blueprint.scale.to_metres(value).to_string(),
        }))?;
    }
    table.flush()
}
