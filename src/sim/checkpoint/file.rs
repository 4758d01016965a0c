//! Save files: a world with everything that it needs to go on without its scene file.
//!
//! ```text
//! "PowderMaster\n" │ version, u16 │ hash of the rest, u64 │ postcard of `Contents`     (numbers little-endian)
//! ```
//!
//! Reading checks every byte and value. A file is as long as what it holds: reading one takes memory in proportion to it,
//! and no more than its box may have.

use crate::{
    kernel::{checks::remove_non_finite, element::ElementTable, params::Preset, solids::Solids},
    scene::{
        blueprint::Blueprint,
        effects::{Effect, EffectModes},
    },
    sim::{
        checkpoint::{
            check,
            contents::{Contents, RockCell},
            restore::Checkpoint,
        },
        snapshot::{Snapshot, hash_bytes},
        state::{Setup, Sources},
    },
};
use glam::IVec2;
use std::sync::Arc;

/// What every save file begins with.
pub(super) const MAGIC: &[u8] = b"PowderMaster\n";
/// Version of the format. Raise it when [`Contents`] or anything in it changes: old files are refused, not misread.
const VERSION: u16 = 4;

/// Why a file is not loaded, in one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SaveError {
    /// Something else.
    #[error("not a save file of Powder Master")]
    Foreign,
    /// Written by another version.
    #[error("a save file of format {found}; this program reads format {VERSION}")]
    Version {
        /// Its format.
        found: u16,
    },
    /// Cut or changed.
    #[error("the save file is damaged: {0}")]
    Damaged(String),
    /// A value that no world has.
    #[error("the save file is not sound: {0}")]
    Unsound(String),
}

impl Checkpoint {
    /// It as a save file.
    pub fn encode(&self) -> Vec<u8> {
        let Snapshot { mut particles, solids, air, pressure, sleep, sources, clock } = Snapshot::clone(&self.state);
        // A file with them would be refused: those that are no number (the next tick would take them away) and, which never
        // happens, those in rock or outside. Better a world without them than none.
        remove_non_finite(&mut particles, 1);
        particles.retain(|particles, i| !solids.is_solid(Solids::cell_of(particles.position(i))));
        let rock = solids.iter().map(|(cell, element, id)| RockCell {
            column: cell.x as u32,
            row: cell.y as u32,
            element,
            id,
        });
        let Setup { blueprint, domain, preset, quality, .. } = &self.setup;
        seal(&Contents {
            name: blueprint.name.clone(),
            title: blueprint.title.clone(),
            description: blueprint.description.clone(),
            parameters: blueprint.parameters.clone(),
            scale: blueprint.scale,
            domain: *domain,
            elements: blueprint.elements.iter().map(|(_, element)| element.clone()).collect(),
            fluid: blueprint.fluid,
            air_params: blueprint.air,
            effects: self.modes.iter().map(|(effect, mode)| (effect.name().to_owned(), *mode)).collect(),
            preset: preset.name().to_owned(),
            quality: *quality,
            particle_limit: blueprint.particle_limit,
            first_element: blueprint.first_element.clone(),
            particles,
            rock: rock.collect(),
            air,
            pressure,
            sleep,
            sources,
            clock,
        })
    }

    /// Reads a save file.
    ///
    /// # Errors
    /// If it is not one, was cut or changed, or holds what no world can.
    pub fn decode(bytes: &[u8]) -> Result<Self, SaveError> {
        let damaged = |what: &str| SaveError::Damaged(what.to_owned());
        let rest = bytes.strip_prefix(MAGIC).ok_or_else(|| {
            if !bytes.is_empty() && MAGIC.starts_with(bytes) {
                damaged("it ends in its first line")
            } else {
                SaveError::Foreign
            }
        })?;
        let (version, rest) = rest.split_first_chunk().ok_or_else(|| damaged("it ends in its header"))?;
        let found = u16::from_le_bytes(*version);
        if found != VERSION {
            return Err(SaveError::Version { found });
        }
        let (hash, body) = rest.split_first_chunk().ok_or_else(|| damaged("it ends in its header"))?;
        if u64::from_le_bytes(*hash) != hash_bytes(body) {
            return Err(damaged("its contents do not fit its checksum"));
        }
        let (contents, left) =
            postcard::take_from_bytes::<Contents>(body).map_err(|error| damaged(&error.to_string()))?;
        if !left.is_empty() {
            return Err(damaged("something stands behind its end"));
        }
        check::contents(&contents).map_err(SaveError::Unsound)?;
        open(contents).map_err(SaveError::Unsound)
    }
}

pub(super) fn seal(contents: &Contents) -> Vec<u8> {
    // Writing to memory has no way to fail, and every length is known.
    let body = postcard::to_stdvec(contents).unwrap_or_default();
    let mut bytes = MAGIC.to_vec();
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(hash_bytes(&body).to_le_bytes());
    bytes.extend(body);
    bytes
}

/// Turns checked contents into a world. What needs the whole rock is checked here.
fn open(contents: Contents) -> Result<Checkpoint, String> {
    let Contents { particles, rock, air, pressure, sleep, sources, clock, domain, quality, .. } = contents;
    let cells = domain.size.ceil().as_uvec2();
    let mut solids = Solids::new(cells.x, cells.y);
    for RockCell { column, row, element, id } in rock {
        let cell = IVec2::new(column as i32, row as i32);
        if !solids.insert(cell, element, id) {
            return Err(format!("the rock at {column}, {row} is outside the box or there twice"));
        }
    }
    if let Some(i) = (0..particles.len()).find(|&i| solids.is_solid(Solids::cell_of(particles.position(i)))) {
        return Err(format!("particle {} is inside rock or outside the box", particles.id[i]));
    }
    check::air_follows_rock(&air, &solids, &domain, contents.air_params)?;
    let elements = Arc::new(ElementTable::new(contents.elements));
    let effects: EffectModes =
        contents.effects.iter().filter_map(|(name, mode)| Some((Effect::find(name)?, *mode))).collect();
    let Sources { emitters, winds, drains } = sources.clone();
    let mut snapshot = Snapshot { particles, solids, air, pressure, sleep, sources, clock };
    snapshot.air.set_solids(&snapshot.solids);
    let preset = Preset::find(&contents.preset).unwrap_or(Preset::Balanced);
    let blueprint = Blueprint {
        name: contents.name,
        title: contents.title,
        description: contents.description,
        parameters: contents.parameters,
        scale: contents.scale,
        domain,
        elements,
        particles: snapshot.particles.clone(),
        solids: snapshot.solids.clone(),
        next_id: clock.next_id,
        emitters,
        winds,
        drains,
        pressures: Vec::new(),
        fluid: contents.fluid,
        air: contents.air_params,
        effects: effects.clone(),
        preset,
        quality,
        particle_limit: contents.particle_limit,
        first_element: contents.first_element,
    };
    let state = Arc::new(snapshot);
    Ok(Checkpoint {
        setup: Setup { blueprint: Arc::new(blueprint), domain, preset, quality, origin: state.clone() },
        modes: effects,
        state,
    })
}
