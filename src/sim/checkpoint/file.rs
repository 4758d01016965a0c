//! Save files: a world with everything that it needs to go on without its scene file.
//!
//! ```text
//! "PowderMaster\n" │ version, u16 │ hash of the rest, u64 │ postcard of `Contents`     (numbers little-endian)
//! ```
//!
//! Reading checks every byte and value. A file is as long as what it holds: reading one takes memory in proportion to it,
//! and no more than its box may have.

use crate::{
    kernel::{checks::remove_non_finite, element::ElementTable, solids::Solids},
    scene::blueprint::Blueprint,
    sim::{
        checkpoint::{
            check,
            contents::{Contents, RockCell},
            restore::Checkpoint,
        },
        file::{FileError, Kind, VERSION},
        snapshot::Snapshot,
        state::{Setup, Sources},
    },
};
use glam::IVec2;
use std::{borrow::Cow, sync::Arc};

/// A save file.
pub(super) const SAVE: Kind = Kind { name: "save file", magic: b"PowderMaster\n", version: VERSION };

impl Checkpoint {
    /// It as a save file.
    pub fn encode(&self) -> Vec<u8> {
        let Snapshot { mut particles, solids, air, kept, sleep, sources, clock, books } = Snapshot::clone(&self.state);
        // A file with them would be refused: those that are no number (the next tick would take them away) and, which never
        // happens, those in rock or outside. Better a world without them than none.
        remove_non_finite(&mut particles, 1);
        particles.retain(|particles, i| !solids.is_solid(Solids::cell_of(particles.position(i))));
        let rock = solids.iter().map(|(cell, element, id)| RockCell {
            column: cell.x as u32,
            row: cell.y as u32,
            element,
            id,
            heat: solids.heat(cell),
        });
        let Setup { blueprint, domain, preset, quality, .. } = &self.setup;
        seal(&Contents {
            scene: Cow::Borrowed(blueprint),
            domain: *domain,
            effects: self.modes.clone(),
            preset: *preset,
            quality: *quality,
            elements: blueprint.elements.iter().map(|(_, element)| element.clone()).collect(),
            particles,
            rock: rock.collect(),
            air,
            kept,
            sleep,
            sources,
            clock,
            books,
        })
    }

    /// Reads a save file.
    ///
    /// # Errors
    /// If it is not one, was cut or changed, or holds what no world can.
    pub fn decode(bytes: &[u8]) -> Result<Self, FileError> {
        let (contents, hash) = SAVE.unseal::<Contents>(bytes)?;
        check::contents(&contents).and_then(|()| open(contents, hash)).map_err(|what| SAVE.unsound(what))
    }
}

pub(super) fn seal(contents: &Contents) -> Vec<u8> {
    SAVE.seal(contents)
}

/// Turns checked contents into a world that is marked as of this file. What needs the whole rock is checked here.
fn open(contents: Contents, origin: u64) -> Result<Checkpoint, String> {
    let Contents { scene, domain, effects, preset, quality, elements, .. } = contents;
    let Contents { particles, rock, mut air, kept, sleep, sources, clock, books, .. } = contents;
    let cells = domain.size.ceil().as_uvec2();
    let mut solids = Solids::new(cells.x, cells.y);
    for RockCell { column, row, element, id, heat } in rock {
        let cell = IVec2::new(column as i32, row as i32);
        if !solids.insert(cell, element, id) {
            return Err(format!("the rock at {column}, {row} is outside the box or there twice"));
        }
        solids.set_heat(cell, heat);
    }
    if let Some(i) = (0..particles.len()).find(|&i| solids.is_solid(Solids::cell_of(particles.position(i)))) {
        return Err(format!("particle {} is inside rock or outside the box", particles.id[i]));
    }
    check::air_follows_rock(&air, &solids, &domain, scene.air)?;
    air.set_solids(&solids);
    let Sources { emitters, winds, drains } = sources.clone();
    let blueprint = Blueprint {
        domain,
        elements: Arc::new(ElementTable::new(elements)),
        particles: particles.clone(),
        solids: solids.clone(),
        next_id: clock.next_id,
        emitters,
        winds,
        drains,
        effects: effects.clone(),
        preset,
        quality,
        origin,
        ..scene.into_owned()
    };
    let state = Arc::new(Snapshot { particles, solids, air, kept, sleep, sources, clock, books });
    let blueprint = Arc::new(blueprint);
    Ok(Checkpoint {
        setup: Setup { opened: blueprint.clone(), blueprint, domain, preset, quality, origin: state.clone() },
        modes: effects,
        state,
    })
}
