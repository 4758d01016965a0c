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
    census.by_element.clear();
    census.by_element.resize(setup.elements().len(), 0);
    checks::count_elements(&particles.element, &mut census.by_element);
    for (_, element, _) in rock.iter() {
        census.by_element[element.index()] += 1;
    }
    census.total = (particles.len() + rock.count()) as u32;
}
