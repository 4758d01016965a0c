//! All particles, in the order of their ids.

use crate::{
    kernel::solids,
    sim::state::{ParticleStore, Rock, Setup},
};
use bevy::ecs::world::World;
use glam::Vec2;
use std::io::{self, Write};

/// Names of the columns: id, name of the element, position in m, velocity in m/s (0 for rock).
pub const COLUMNS: [&str; 6] = ["id", "element", "x", "y", "vx", "vy"];

/// Writes the table.
pub fn write(world: &World, out: impl Write) -> io::Result<()> {
    let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
    let setup = world.resource::<Setup>();
    let movable = (0..particles.len())
        .map(|i| (particles.id[i], particles.element[i], particles.position(i), particles.velocity(i)));
    let fixed = rock.iter().map(|(cell, element, id)| (id, element, solids::centre(cell), Vec2::ZERO));
    let mut all: Vec<_> = movable.chain(fixed).collect();
    all.sort_unstable_by_key(|(id, ..)| *id);
    let mut table = csv::Writer::from_writer(out);
    table.write_record(COLUMNS)?;
    for (id, element, position, velocity) in all {
        let [p, v] = [position, velocity].map(|vector| setup.blueprint.scale.vec_to_metres(vector));
        let figures = [p.x, p.y, v.x, v.y].map(|figure| figure.to_string());
        let name = setup.elements().get(element).name.as_str();
        table.write_record([&id.to_string(), name].into_iter().chain(figures.iter().map(String::as_str)))?;
    }
    table.flush()
}
