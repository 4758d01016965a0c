//! The census, from which the gate and the HUD know what is there.

use crate::{
    kernel::checks,
    sim::state::{Census, ParticleStore, Rock, Setup},
};
use bevy::prelude::{Res, ResMut};

/// Counts the particles of each element.
pub(super) fn count_particles(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    rock: Res<Rock>,
    mut census: ResMut<Census>,
) {
    let elements = setup.elements().len();
    let census = &mut *census;
    // A look at every site of the box: only where rock came or went.
    if census.rock_version != Some(rock.version()) {
        census.rock_version = Some(rock.version());
        census.rock.clear();
        census.rock.resize(elements, 0);
        rock.iter().for_each(|(_, element, _)| census.rock[element.index()] += 1);
    }
    census.by_element.clone_from(&census.rock);
    checks::count_elements(&particles.element, &mut census.by_element);
    census.total = (particles.len() + rock.count()) as u32;
}
