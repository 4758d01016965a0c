//! What a piece holds, and how it is taken out of a world.

use crate::{
    brush::Stroke,
    element::{ElementId, ElementTable},
    particles::Particles,
    solids::{Solids, centre},
    spawn::Occupancy,
};
use glam::{IVec2, Vec2};
use serde::{Deserialize, Serialize};

/// Longest side of a piece, d.
const LONGEST_SIDE: i32 = 32_768;
/// Most cells of a piece.
const MOST_CELLS: i64 = 64_000_000;
/// Range of spacings, m.
const SPACINGS: [f32; 2] = [1e-5, 1e3];

/// Whatever stands in a rectangle of whole cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Length of its d, m.
    pub spacing: f32,
    /// Cells along x and y.
    pub size: IVec2,
    /// What moves, in the order of its ids, which count from 0. Places are from the lower left corner, d.
    pub particles: Particles,
    /// How near to each particle the nearest other lump was, of those that it was taken from among, d², or the square of what
    /// a free site takes: it fits wherever it has as much room.
    pub(crate) room: Vec<f32>,
    /// Rock, row by row.
    pub rock: Vec<PieceRock>,
}

/// A cell of rock in a piece.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PieceRock {
    /// Which, from the lower left corner.
    pub cell: IVec2,
    /// What it is made of.
    pub element: ElementId,
    /// Heat, quanta.
    pub heat: i32,
    /// As that of a particle, d².
    pub(crate) room: f32,
}

impl Piece {
    /// What stands in the cells from `low` up to, but not with, `high`: all that erasing the same rectangle takes away.
    /// `spacing`: the d of the world, m.
    pub fn of(particles: &Particles, solids: &Solids, low: IVec2, high: IVec2, spacing: f32) -> Self {
        let stroke = Stroke::rectangle(low.as_vec2(), high.as_vec2());
        let mut near = Occupancy::default();
        near.look(particles, low, high - 1);
        near.look_at_rock(solids, low, high - 1);
        let mut piece =
            Self { spacing, size: high - low, particles: Particles::default(), room: Vec::new(), rock: Vec::new() };
        for i in particles.in_id_order() {
            let (mut particle, at) = (particles.get(i as usize), particles.position(i as usize));
            if stroke.covers(at) {
                particle.id = piece.particles.len() as u32;
                (particle.x, particle.y) = (at - low.as_vec2()).into();
                piece.particles.add(particle);
                piece.room.push(near.room_at(at));
            }
        }
        for cell in stroke.cells(IVec2::new(solids.columns(), solids.rows())) {
            if let Some((element, _)) = solids.get(cell) {
                let room = near.room_at(centre(cell));
                piece.rock.push(PieceRock { cell: cell - low, element, heat: solids.heat(cell), room });
            }
        }
        piece
    }

    /// Lumps in it.
    pub fn count(&self) -> usize {
        self.particles.len() + self.rock.len()
    }

    /// Whether nothing is in it.
    pub fn is_empty(&self) -> bool {
        self.count() == 0
    }

    /// Its rock in a box of its size.
    pub fn solids(&self) -> Solids {
        let mut solids = Solids::new(self.size.x as u32, self.size.y as u32);
        for (id, rock) in self.rock.iter().enumerate() {
            solids.insert(rock.cell, rock.element, id as u32);
            solids.set_heat(rock.cell, rock.heat);
        }
        solids
    }

    /// The elements that it has, each once.
    pub fn elements(&self) -> Vec<ElementId> {
        let mut elements: Vec<ElementId> =
            self.particles.element.iter().copied().chain(self.rock.iter().map(|rock| rock.element)).collect();
        elements.sort_unstable();
        elements.dedup();
        elements
    }

    /// The same with other numbers of its elements.
    #[must_use]
    pub fn with_elements(mut self, number: impl Fn(ElementId) -> ElementId) -> Self {
        self.particles.element.iter_mut().for_each(|element| *element = number(*element));
        self.rock.iter_mut().for_each(|rock| rock.element = number(rock.element));
        self
    }

    /// Bytes held, to a good approximation.
    pub fn memory(&self) -> usize {
        self.particles.memory() + 4 * self.room.capacity() + size_of::<PieceRock>() * self.rock.capacity()
    }

    /// Whether its numbers are within all bounds.
    ///
    /// # Errors
    /// If not: what is wrong, in a few words.
    pub fn check(&self) -> Result<(), String> {
        let demand = |holds: bool, what: &str| if holds { Ok(()) } else { Err(what.to_owned()) };
        let [least, most] = SPACINGS;
        demand(self.spacing >= least && self.spacing <= most, "its spacing is out of range")?;
        let sides = IVec2::ONE..=IVec2::splat(LONGEST_SIDE);
        let fits = self.size.cmpge(*sides.start()).all() && self.size.cmple(*sides.end()).all();
        let cells = i64::from(self.size.x) * i64::from(self.size.y);
        demand(fits && cells <= MOST_CELLS, "its size is out of range")?;
        let count = self.particles.len();
        demand(self.particles.has_equal_columns() && self.room.len() == count, "its arrays differ in length")?;
        let of_particles = 0..count;
        let sound = of_particles.clone().all(|i| self.particles.get(i).values().iter().all(|value| value.is_sound()));
        demand(sound, "a value of a particle is no number, or too large")?;
        let inside = |at: Vec2| at.cmpge(Vec2::ZERO).all() && at.cmple(self.size.as_vec2()).all();
        demand(of_particles.clone().all(|i| inside(self.particles.position(i))), "a particle is outside of it")?;
        let within = |cell: IVec2| cell.cmpge(IVec2::ZERO).all() && cell.cmplt(self.size).all();
        demand(self.rock.iter().all(|rock| within(rock.cell)), "rock is outside of it")?;
        let mut rooms = self.room.iter().copied().chain(self.rock.iter().map(|rock| rock.room));
        demand(rooms.all(|room| room >= 0.0), "the room of a lump is no number")
    }

    /// Whether a table of elements has what it is made of, and moves what moves in it.
    ///
    /// # Errors
    /// If not: what is wrong, in a few words.
    pub fn check_elements(&self, elements: &ElementTable) -> Result<(), String> {
        let fixed = |id: ElementId| (id.index() < elements.len()).then(|| elements.get(id).fixed);
        let moves = self.particles.element.iter().all(|id| fixed(*id) == Some(false));
        let stays = self.rock.iter().all(|rock| fixed(rock.element) == Some(true));
        if moves && stays { Ok(()) } else { Err("it is of elements that are not there".to_owned()) }
    }
}

/// The lower left cell of a piece of `size` cells whose middle is as near to a point (d) as whole cells allow.
pub fn lowest_cell(middle: Vec2, size: IVec2) -> IVec2 {
    (middle - 0.5 * size.as_vec2()).round().as_ivec2()
}
