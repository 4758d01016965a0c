//! The world's matter, to be edited.

use super::occupancy::Occupancy;
use crate::{
    brush::Stroke,
    element::{ElementId, ElementTable},
    heat::table::HeatTable,
    params::Domain,
    particles::Particles,
    random::{mix, unit},
    solids::{Solids, centre, is_whole},
    sources::{Drain, Emitter},
};
use glam::{IVec2, Vec2};

/// Poured particles stand off their site by up to this in each coordinate, d: a stream without it falls in files.
const SCATTER: f32 = 0.08;

/// A brush that moves by its radius fills twice the free sites under it: a stream that is drawn has no holes, however fast. What a
/// place is swept by altogether is two radii, in one piece or in many: of many at most e⁻⁴ of its sites stay free, 2 %.
const SWEEP: f32 = 2.0;

/// Everything that placing and taking away touches.
pub struct Matter<'a> {
    /// The box.
    pub domain: &'a Domain,
    /// All elements.
    pub elements: &'a ElementTable,
    /// How warm they are by their heat.
    pub heat: &'a HeatTable,
    /// Movable particles.
    pub particles: &'a mut Particles,
    /// Rock.
    pub solids: &'a mut Solids,
    /// The next free id.
    pub next_id: &'a mut u32,
    /// Most particles, rock included.
    pub limit: u32,
}

/// What an edit did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EditReport {
    /// Particles placed.
    pub placed: u64,
    /// Particles taken away.
    pub removed: u64,
    /// Particles not placed for want of room under the limit.
    pub refused: u64,
    /// Lumps of a piece left out for want of free room.
    pub crowded: u64,
    /// Whether an emitter could not give what was due for want of free sites.
    pub blocked: bool,
}

/// How a brush pours.
#[derive(Clone, Copy, Debug)]
pub struct Pouring {
    /// Velocity of what is poured, d/s.
    pub velocity: Vec2,
    /// How long, of a tick, 0 … 1.
    pub share: f32,
}

/// How many of the free sites are used, and how.
#[derive(Clone, Copy, Debug)]
struct Filling {
    /// Share of the free sites.
    share: f32,
    /// Seed of the choice among them and of the scatter.
    seed: u32,
    /// Furthest from the site in each coordinate, d.
    scatter: f32,
    /// Velocity of the new particles, d/s.
    velocity: Vec2,
    /// Most particles to place.
    most: u32,
}

impl Matter<'_> {
    /// Drips under the stroke for a tick, at rest and at the element's flow, however far the brush moves. Fixed elements fill it at
    /// once and take the place of what is there.
    pub fn drip(&mut self, element: ElementId, stroke: &Stroke, seed: u64) -> EditReport {
        self.place(element, stroke, Filling::poured(self.elements.get(element).flow, seed))
    }

    /// Pours under the stroke: at the element's flow while the brush stands, and a stream without holes where it moves. Fixed
    /// elements fill it at once and take the place of what is there.
    pub fn pour(&mut self, element: ElementId, stroke: &Stroke, pouring: Pouring, seed: u64) -> EditReport {
        // The smallest brush is a cell.
        let swept = SWEEP * stroke.from.distance(stroke.to) / stroke.radius.max(0.5);
        let share = self.elements.get(element).flow * pouring.share + swept;
        self.place(element, stroke, Filling { velocity: pouring.velocity, ..Filling::poured(share, seed) })
    }

    /// Fills all free sites under the stroke at once, each particle right on its site.
    pub fn stamp(&mut self, element: ElementId, stroke: &Stroke) -> EditReport {
        self.place(element, stroke, Filling::all())
    }

    fn place(&mut self, element: ElementId, stroke: &Stroke, filling: Filling) -> EditReport {
        if self.elements.get(element).fixed {
            return self.place_fixed(element, stroke);
        }
        let (bounds, cells) = (stroke.bounds(self.size()), stroke.cells(self.size()));
        self.place_movable(element, bounds, cells, filling, &mut Occupancy::default())
    }

    /// Fills the connected free cells around a point.
    pub fn fill(&mut self, element: ElementId, at: Vec2) -> EditReport {
        let whole = Some((IVec2::ZERO, self.size() - 1));
        let mut room = Occupancy::default();
        room.look(self.particles, IVec2::ZERO, self.size() - 1);
        let start = Solids::cell_of(at);
        let free = |cell: IVec2, solids: &Solids| !solids.is_solid(cell) && !room.is_near(centre(cell));
        let mut report = EditReport::default();
        if !at.is_finite() || !free(start, self.solids) {
            return report;
        }
        let columns = self.size().x;
        let mut seen = vec![false; (columns * self.size().y) as usize];
        let index = |cell: IVec2| (cell.y * columns + cell.x) as usize;
        let mut cells = vec![start];
        seen[index(start)] = true;
        let mut next = 0;
        let fixed = self.elements.get(element).fixed;
        while let Some(&cell) = cells.get(next) {
            next += 1;
            for step in [IVec2::X, IVec2::NEG_X, IVec2::Y, IVec2::NEG_Y] {
                let neighbour = cell + step;
                if free(neighbour, self.solids) && !seen[index(neighbour)] {
                    seen[index(neighbour)] = true;
                    cells.push(neighbour);
                }
            }
        }
        if !fixed {
            return self.place_movable(element, whole, cells.into_iter(), Filling::all(), &mut room);
        }
        for cell in cells {
            self.place_rock(element, cell, &mut report);
        }
        report
    }

    /// Takes away everything under the stroke.
    pub fn erase(&mut self, stroke: &Stroke) -> EditReport {
        let Some((low, high)) = stroke.bounds(self.size()) else { return EditReport::default() };
        let (low, high) = (low.as_vec2(), (high + 1).as_vec2());
        let size = self.size();
        let mut removed = stroke.cells(size).filter(|&cell| self.solids.remove(cell)).count();
        removed += self.particles.retain(|particles, i| {
            let at = particles.position(i);
            !(at.cmpge(low).all() && at.cmple(high).all() && stroke.covers(at))
        });
        EditReport { removed: removed as u64, ..EditReport::default() }
    }

    /// Lets an emitter flow for `dt` s at tick `tick`. `room` is its buffer.
    pub fn emit(&mut self, emitter: &mut Emitter, room: &mut Occupancy, tick: u64, dt: f32) -> EditReport {
        if tick < emitter.start {
            return EditReport::default();
        }
        let left = emitter.total.map_or(u32::MAX, |total| total.saturating_sub(emitter.given));
        // What could not flow for want of room does not pile up beyond one particle.
        emitter.due = (emitter.due + emitter.rate * dt).min(1.0 + emitter.rate * dt);
        let most = (emitter.due as u32).min(left);
        if most == 0 {
            return EditReport::default();
        }
        let (low, high) = (Solids::cell_of(emitter.area.min), Solids::cell_of(emitter.area.max));
        let (low, high) = (low.max(IVec2::ZERO), high.min(self.size() - 1));
        let area = emitter.area;
        let sites = || {
            let cells = (low.y..=high.y).flat_map(|y| (low.x..=high.x).map(move |x| IVec2::new(x, y)));
            cells.filter(|&cell| area.contains(centre(cell)))
        };
        let count = sites().count();
        if count == 0 {
            return EditReport::default();
        }
        // Start somewhere else each tick, so that a wide emitter flows evenly.
        let seed = mix(tick as u32);
        let turned = sites().cycle().skip(seed as usize % count).take(count);
        let filling = Filling { share: 1.0, seed, scatter: SCATTER, velocity: emitter.velocity, most };
        let mut report = self.place_movable(emitter.element, Some((low, high)), turned, filling, room);
        report.blocked = report.placed + report.refused < u64::from(most);
        // An emitter without a total is not asked how much it has given.
        emitter.given = emitter.given.saturating_add(report.placed as u32);
        emitter.due = (emitter.due - report.placed as f32).max(0.0);
        report
    }

    /// Takes away the movable particles in a drain.
    pub fn drain(&mut self, drain: &Drain) -> EditReport {
        if !drain.area.contains_any([&self.particles.x, &self.particles.y]) {
            return EditReport::default();
        }
        let removed = self.particles.retain(|particles, i| !drain.area.contains(particles.position(i)));
        EditReport { removed: removed as u64, ..EditReport::default() }
    }

    /// Cells of the box.
    pub(super) fn size(&self) -> IVec2 {
        IVec2::new(self.solids.columns(), self.solids.rows())
    }

    /// Particles that may still be placed: a world is full at its limit, or when all ids are given.
    pub(super) fn room_left(&self) -> u64 {
        let room = u64::from(self.limit).saturating_sub((self.particles.len() + self.solids.count()) as u64);
        room.min(u64::from(u32::MAX - *self.next_id))
    }

    /// An id that was never given. Only where there is room left.
    pub(super) fn take_id(&mut self) -> u32 {
        let id = *self.next_id;
        *self.next_id += 1;
        id
    }

    fn place_movable(
        &mut self,
        element: ElementId,
        bounds: Option<(IVec2, IVec2)>,
        cells: impl Iterator<Item = IVec2>,
        filling: Filling,
        room: &mut Occupancy,
    ) -> EditReport {
        let mut report = EditReport::default();
        let Some((low, high)) = bounds else { return report };
        room.look(self.particles, low, high);
        for cell in cells {
            if report.placed + report.refused >= u64::from(filling.most) {
                break;
            }
            let chance = mix(filling.seed ^ mix(cell.x as u32 ^ (cell.y as u32) << 16));
            if unit(chance) * 0.5 + 0.5 >= filling.share && filling.share < 1.0 {
                continue;
            }
            let scatter = mix(chance);
            let at = centre(cell) + filling.scatter * Vec2::new(unit(scatter), unit(scatter >> 16));
            if !is_whole(cell, self.domain.size) || self.solids.is_solid(cell) || room.is_near(at) {
                continue;
            }
            if self.room_left() == 0 {
                report.refused += 1;
                continue;
            }
            let id = self.take_id();
            self.particles.push_warm(id, element, at, filling.velocity, self.heat.spawn_heat(element));
            room.insert(at);
            report.placed += 1;
        }
        report
    }

    fn place_fixed(&mut self, element: ElementId, stroke: &Stroke) -> EditReport {
        let mut report = EditReport::default();
        let version = self.solids.version();
        for cell in stroke.cells(self.size()) {
            if self.solids.get(cell).is_some_and(|(present, _)| present != element) {
                self.solids.remove(cell);
                report.removed += 1;
            }
            self.place_rock(element, cell, &mut report);
        }
        if self.solids.version() != version {
            let solids = &*self.solids;
            let buried = self.particles.retain(|particles, i| !solids.is_solid(Solids::cell_of(particles.position(i))));
            report.removed += buried as u64;
        }
        report
    }

    fn place_rock(&mut self, element: ElementId, cell: IVec2, report: &mut EditReport) {
        if self.solids.is_solid(cell) {
            return;
        }
        if self.room_left() == 0 {
            report.refused += 1;
            return;
        }
        let id = self.take_id();
        self.solids.insert(cell, element, id);
        self.solids.set_heat(cell, self.heat.spawn_heat(element));
        report.placed += 1;
    }
}

impl Filling {
    /// A share of the free sites, a little off them, at rest.
    fn poured(share: f32, seed: u64) -> Self {
        Self { share, seed: mix(seed as u32 ^ (seed >> 32) as u32), scatter: SCATTER, ..Self::all() }
    }

    /// Every free site, right on it, at rest.
    fn all() -> Self {
        Self { share: 1.0, seed: 0, scatter: 0.0, velocity: Vec2::ZERO, most: u32::MAX }
    }
}
