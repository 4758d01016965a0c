//! Stamps: pieces of worlds that are kept to be put into others, as files.
//!
//! ```text
//! "PowderMaster stamp\n" │ version, u16 │ hash, u64 │ postcard of the names of its elements, the `Piece` and the `Springs`
//! ```
//!
//! Elements go by their names, and lengths by the metres of a d: tables and spacings differ from world to world.

use crate::{
    kernel::{
        element::{ElementId, ElementTable},
        params::Domain,
        particles::Particles,
        piece::{Piece, Turn, lowest_cell},
        resample::resample_rock,
    },
    scene::{MOST_CELLS, blueprint::Blueprint},
    sim::{
        file::{FileError, Kind},
        resample::particles_in,
        springs::Springs,
        state::{ParticleStore, Rock, Setup, Sources},
    },
};
use bevy::prelude::World;
use glam::{IVec2, Vec2};
use serde::{Deserialize, Serialize};
use std::{borrow::Cow, collections::BTreeSet};

/// Ending of the files of stamps.
pub const STAMP_ENDING: &str = "pmt";
/// Least side of a box in which lumps are cut or joined, d: that of a world.
const NARROWEST: f32 = 4.0;
/// Longest name of an element, bytes.
const LONGEST_NAME: usize = 200;
/// Spacings that differ by less than this are the same, as a share.
const SAME: f64 = 1e-5;
/// A stamp. Its version rises by itself with the columns of the particles; raise the first number when anything else changes.
const STAMP: Kind = Kind { name: "stamp", magic: MAGIC, version: 200 + Particles::COLUMNS.len() as u16 };
const MAGIC: &[u8] = b"PowderMaster stamp\n";
/// A stamp as it was before it could have springs: names of its elements and piece. It is read, not written.
const WITHOUT_SPRINGS: Kind = Kind { version: 100 + Particles::COLUMNS.len() as u16, ..STAMP };

/// A piece of a world, by the names of its elements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stamp {
    /// Names of its elements.
    pub elements: Vec<String>,
    /// The piece; its elements are numbers of these.
    pub piece: Piece,
    /// The emitters and drains in it; what flows are numbers of these, places are from its lower left corner.
    pub springs: Springs,
}

impl Stamp {
    /// What stands in the cells of a world from `low` up to, but not with, `high`.
    pub fn of(world: &World, low: IVec2, high: IVec2) -> Self {
        let setup = world.resource::<Setup>();
        let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
        let sources = world.resource::<Sources>();
        let piece = Piece::of(particles, rock, low, high, setup.blueprint.scale.spacing);
        let springs = Springs::of(&sources.emitters, &sources.drains, low, high);
        let ids: BTreeSet<ElementId> = piece.elements().into_iter().chain(springs.elements()).collect();
        let names = ids.iter().map(|id| setup.elements().get(*id).name.clone()).collect();
        let place = |id: ElementId| ElementId(ids.iter().position(|other| *other == id).unwrap_or_default() as u8);
        Self { elements: names, piece: piece.with_elements(place), springs: springs.with_elements(place) }
    }

    /// The piece with the numbers of a world's table of elements.
    ///
    /// # Errors
    /// If the table lacks an element, or it moves there and not here: one line.
    pub fn piece(&self, table: &ElementTable) -> Result<Piece, String> {
        let ids = self.ids(table)?;
        let piece = self.piece.clone().with_elements(|place| ids[place.index()]);
        piece
            .check_elements(table)
            .map_err(|_| "what moves in it stays in this world, or the other way round".to_owned())?;
        Ok(piece)
    }

    /// Its emitters and drains in a world where it lies so and has its middle at a point, d.
    ///
    /// # Errors
    /// If the world's table lacks an element: one line.
    pub fn springs_at(&self, to: &Blueprint, at: Vec2, turn: Turn) -> Result<Springs, String> {
        let ids = self.ids(&to.elements)?;
        let springs = self.springs.scaled(factor(&self.piece, to)).with_elements(|place| ids[place.index()]);
        let size = size_in(&self.piece, to);
        Ok(springs.placed(lowest_cell(at, turn.size(size)), size, turn))
    }

    /// Whether nothing is in it.
    pub fn is_empty(&self) -> bool {
        self.piece.is_empty() && self.springs.is_empty()
    }

    /// Its elements in a world's table.
    fn ids(&self, table: &ElementTable) -> Result<Vec<ElementId>, String> {
        let find = |name: &String| table.find(name).ok_or_else(|| format!("this world has no {name}"));
        self.elements.iter().map(find).collect()
    }

    /// It as a file.
    pub fn encode(&self) -> Vec<u8> {
        STAMP.seal(self)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// If it is not one, was cut or changed, or holds what can't have been: one line.
    pub fn decode(bytes: &[u8]) -> Result<Self, FileError> {
        let stamp = match WITHOUT_SPRINGS.unseal(bytes) {
            Ok(((elements, piece), _)) => Self { elements, piece, springs: Springs::default() },
            Err(FileError::Version(..)) => STAMP.unseal(bytes)?.0,
            Err(error) => return Err(error),
        };
        let count = stamp.elements.len();
        if count > ElementTable::MOST || stamp.elements.iter().any(|name| name.len() > LONGEST_NAME) {
            return Err(STAMP.unsound("its names of elements are too many or too long".to_owned()));
        }
        stamp.piece.check().and_then(|()| stamp.springs.check()).map_err(|what| STAMP.unsound(what))?;
        let is_none = |id: ElementId| id.index() >= count;
        if stamp.piece.elements().into_iter().chain(stamp.springs.elements()).any(is_none) {
            return Err(STAMP.unsound("a lump is of none of its elements".to_owned()));
        }
        Ok(stamp)
    }
}

/// Cells along x and y that a piece takes in a world.
pub fn size_in(piece: &Piece, to: &Blueprint) -> IVec2 {
    box_of(piece, factor(piece, to)).ceil().as_ivec2()
}

/// The box of a piece where `factor` d are in one of its own, d.
fn box_of(piece: &Piece, factor: f64) -> Vec2 {
    let size = (piece.size.as_dvec2() * factor).as_vec2();
    if factor == 1.0 { size } else { size.max(Vec2::splat(NARROWEST)) }
}

/// How many d of a world are in one of a piece.
fn factor(piece: &Piece, to: &Blueprint) -> f64 {
    let factor = f64::from(piece.spacing) / f64::from(to.scale.spacing);
    if (factor - 1.0).abs() < SAME { 1.0 } else { factor }
}

/// A piece with the lumps of a world: cut or joined if they are of another size there.
///
/// # Errors
/// If there would be more of them than the world may hold: one line.
pub fn fitted<'a>(piece: &'a Piece, to: &Blueprint) -> Result<Cow<'a, Piece>, String> {
    let factor = factor(piece, to);
    if factor == 1.0 {
        return Ok(Cow::Borrowed(piece));
    }
    let size = box_of(piece, factor);
    let cells = size.ceil().as_dvec2();
    let (count, most) = ((piece.count() as f64 * factor * factor).round(), to.most_particles());
    if count > f64::from(most) || cells.element_product() > MOST_CELLS {
        return Err(format!("it would be {count} particles of this world's size; allowed: {most} in all"));
    }
    let domain = Domain { size, ..to.domain };
    let (mut rock_id, mut id) = (0, 0);
    let old = piece.solids();
    let solids = resample_rock(&old, factor, domain.size, &mut rock_id);
    let particles = particles_in(&piece.particles, &old, factor, &solids, (&domain, &to.fluid), &mut id);
    let high = IVec2::new(solids.columns(), solids.rows());
    Ok(Cow::Owned(Piece::of(&particles, &solids, IVec2::ZERO, high, to.scale.spacing)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::{brush::Stroke, units::Scale},
        scene::{self, effects::EffectModes},
        sim::{
            intent::{Intent, IntentQueue},
            simulation::Simulation,
            snapshot::hash_bytes,
            workers::Workers,
        },
    };
    use std::sync::Arc;

    /// A world with water beside rock, and a stamp of both.
    fn stamp() -> (Simulation, Stamp) {
        let settings = [("columns", "24"), ("rows", "16")].map(|(key, value)| (key.to_owned(), value.to_owned()));
        let blueprint = scene::load("empty").unwrap().build(&settings, None, &EffectModes::new()).unwrap();
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::default());
        for (name, low, high) in [("rock", (4.0, 2.0), (12.0, 4.0)), ("water", (4.0, 4.0), (12.0, 10.0))] {
            let element = simulation.world().resource::<Setup>().elements().find(name).unwrap();
            let stroke = Stroke::rectangle(low.into(), high.into());
            simulation.world_mut().resource_mut::<IntentQueue>().push(Intent::Stamp { element, stroke });
        }
        let element = simulation.world().resource::<Setup>().elements().find("water").unwrap();
        let stroke = Stroke::rectangle(Vec2::new(5.0, 8.0), Vec2::new(7.0, 9.0));
        let mut queue = simulation.world_mut().resource_mut::<IntentQueue>();
        queue.extend([Intent::SetEmitter { element, stroke }, Intent::SetDrain { stroke }]);
        simulation.run(2);
        let stamp = Stamp::of(simulation.world(), IVec2::new(4, 2), IVec2::new(12, 10));
        assert!(stamp.piece.particles.len() > 40 && stamp.piece.rock.len() == 16);
        (simulation, stamp)
    }

    #[test]
    fn what_was_written_is_read_and_what_was_changed_is_refused() {
        let (_, stamp) = stamp();
        let bytes = stamp.encode();
        assert_eq!(Stamp::decode(&bytes), Ok(stamp));
        for len in 0..bytes.len() {
            assert!(Stamp::decode(&bytes[..len]).is_err());
        }
        let mut changed = bytes.clone();
        for bit in 0..8 * bytes.len() {
            changed[bit / 8] ^= 1 << (bit % 8);
            let text = Stamp::decode(&changed).expect_err("a damaged file was read").to_string();
            assert!(!text.contains('\n') && text.len() < 200, "{text}");
            changed[bit / 8] ^= 1 << (bit % 8);
        }
    }

    #[test]
    fn a_file_of_before_there_were_springs_is_read() {
        let (_, stamp) = stamp();
        let stamp = Stamp { springs: Springs::default(), ..stamp };
        let before = WITHOUT_SPRINGS.seal(&(&stamp.elements, &stamp.piece));
        assert_ne!(before, stamp.encode());
        assert_eq!(Stamp::decode(&before), Ok(stamp));
        for len in 0..before.len() {
            assert!(Stamp::decode(&before[..len]).is_err());
        }
    }

    #[test]
    fn what_can_t_have_been_is_refused_behind_a_right_checksum() {
        let (_, stamp) = stamp();
        let changes: [fn(&mut Stamp); 6] = [
            |stamp| stamp.elements.truncate(1),
            |stamp| stamp.elements[0] = "x".repeat(1000),
            |stamp| stamp.piece.spacing = 0.0,
            |stamp| stamp.piece.particles.x[0] = 1e6,
            |stamp| stamp.springs.emitters[0].rate = f32::NAN,
            |stamp| stamp.springs.emitters[0].element = ElementId(9),
        ];
        for change in changes {
            let mut stamp = stamp.clone();
            change(&mut stamp);
            let text = Stamp::decode(&stamp.encode()).expect_err("it was read").to_string();
            assert!(text.starts_with("the stamp is not sound"), "{text}");
        }
        let bytes = stamp.encode();
        let head = STAMP.begin().len() + 8;
        for at in head..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 0x55;
            let hash = hash_bytes(&changed[head..]).to_le_bytes();
            changed[head - 8..head].copy_from_slice(&hash);
            // Whether it is read or not: it never panics, and what is read can be used.
            if let Ok(stamp) = Stamp::decode(&changed) {
                assert!(stamp.piece.solids().count() <= stamp.piece.rock.len());
            }
        }
    }

    #[test]
    fn in_a_world_of_another_spacing_mass_heat_and_momentum_stay() {
        let (simulation, stamp) = stamp();
        let setup = simulation.world().resource::<Setup>();
        let piece = stamp.piece(setup.elements()).unwrap();
        assert!(matches!(fitted(&piece, &setup.blueprint), Ok(Cow::Borrowed(_))));
        for detail in [0.5_f32, 2.0, 3.0] {
            let own = setup.blueprint.scale.spacing;
            let scale = Scale { spacing: own / detail, ..setup.blueprint.scale };
            let to = Blueprint { scale, ..(*setup.blueprint).clone() };
            let there = fitted(&piece, &to).unwrap();
            assert_eq!((there.size, there.check()), (size_in(&piece, &to), Ok(())));
            let masses = [(&piece, 1.0), (&*there, detail * detail)];
            let [before, after] = masses.map(|(piece, parts)| piece.particles.len() as f32 / parts);
            assert!((before - after).abs() <= 4.0, "detail {detail}: {after} of {before}");
            let momentum = |piece: &Piece, parts: f32| piece.particles.vy.iter().sum::<f32>() / parts;
            let [before, after] = [momentum(&piece, 1.0), momentum(&there, detail * detail * detail)];
            assert!((before - after).abs() < 1e-2 * before.abs(), "detail {detail}: {after}, not {before}");
        }
        let far = Blueprint { scale: Scale { spacing: 1e-6, ..setup.blueprint.scale }, ..(*setup.blueprint).clone() };
        assert!(fitted(&piece, &far).is_err_and(|text| text.contains("allowed")));
    }

    #[test]
    fn a_world_without_an_element_says_which() {
        let (simulation, mut stamp) = stamp();
        stamp.elements[1] = "phlogiston".to_owned();
        let table = simulation.world().resource::<Setup>().elements();
        assert_eq!(stamp.piece(table), Err("this world has no phlogiston".to_owned()));
        stamp.elements[1] = "rock".to_owned();
        assert!(stamp.piece(table).is_err(), "water is rock");
    }
}
