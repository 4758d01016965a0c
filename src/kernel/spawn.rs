//! Placing and taking away matter: what tools, taps and outlets do.
//!
//! New particles stand on the sites of the lattice (the centres of the cells), a little off them when poured, and only
//! where no other particle is near: nothing is ever put into something.

use crate::kernel::{
    brush::Stroke,
    element::{ElementId, ElementTable},
    particles::Particles,
    pbf::{mix, unit},
    solids::{Solids, centre},
    sources::{Drain, Emitter},
};
use glam::{IVec2, Vec2};

/// A site is free if no particle is nearer than this, d.
const CLEARANCE: f32 = 0.8;
/// Poured particles stand off their site by up to this in each coordinate, d: a stream without it falls in files.
const SCATTER: f32 = 0.08;

/// Everything that placing and taking away touches.
pub struct Matter<'a> {
    /// All elements.
    pub elements: &'a ElementTable,
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
    /// Pours under the stroke at the element's flow. Fixed elements fill it at once and take the place of what is there.
    pub fn pour(&mut self, element: ElementId, stroke: &Stroke, seed: u64) -> EditReport {
        let row = self.elements.get(element);
        if row.fixed {
            return self.place_fixed(element, stroke);
        }
        let filling = Filling {
            share: row.flow,
            seed: mix(seed as u32 ^ (seed >> 32) as u32),
            scatter: SCATTER,
            velocity: Vec2::ZERO,
            most: u32::MAX,
        };
        self.place_movable(element, stroke.bounds(self.size()), stroke.cells(self.size()), filling)
    }

    /// Fills all free sites under the stroke at once, each particle right on its site.
    pub fn stamp(&mut self, element: ElementId, stroke: &Stroke) -> EditReport {
        if self.elements.get(element).fixed {
            return self.place_fixed(element, stroke);
        }
        self.place_movable(element, stroke.bounds(self.size()), stroke.cells(self.size()), Filling::all())
    }

    /// Fills the connected free cells around a point.
    pub fn fill(&mut self, element: ElementId, at: Vec2) -> EditReport {
        let whole = Some((IVec2::ZERO, self.size() - 1));
        let room = Occupancy::new(self.particles, IVec2::ZERO, self.size() - 1);
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
            return self.place_movable(element, whole, cells.into_iter(), Filling::all());
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

    /// Lets a tap flow for `dt` s at tick `tick`.
    pub fn emit(&mut self, emitter: &mut Emitter, tick: u64, dt: f32) -> EditReport {
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
        let sites: Vec<IVec2> = (low.y..=high.y)
            .flat_map(|y| (low.x..=high.x).map(move |x| IVec2::new(x, y)))
            .filter(|&cell| area.contains(centre(cell)))
            .collect();
        if sites.is_empty() {
            return EditReport::default();
        }
        // Start somewhere else each tick, so that a wide tap flows evenly.
        let seed = mix(tick as u32);
        let turn = seed as usize % sites.len();
        let turned = sites[turn..].iter().chain(&sites[..turn]).copied();
        let filling = Filling { share: 1.0, seed, scatter: SCATTER, velocity: emitter.velocity, most };
        let report = self.place_movable(emitter.element, Some((low, high)), turned, filling);
        emitter.given += report.placed as u32;
        emitter.due = (emitter.due - report.placed as f32).max(0.0);
        report
    }

    /// Takes away the movable particles in an outlet.
    pub fn drain(&mut self, drain: &Drain) -> EditReport {
        let removed = self.particles.retain(|particles, i| !drain.area.contains(particles.position(i)));
        EditReport { removed: removed as u64, ..EditReport::default() }
    }

    fn size(&self) -> IVec2 {
        IVec2::new(self.solids.columns(), self.solids.rows())
    }

    fn room_left(&self) -> u64 {
        u64::from(self.limit).saturating_sub((self.particles.len() + self.solids.count()) as u64)
    }

    fn take_id(&mut self) -> u32 {
        let id = *self.next_id;
        *self.next_id = id.wrapping_add(1);
        id
    }

    fn place_movable(
        &mut self,
        element: ElementId,
        bounds: Option<(IVec2, IVec2)>,
        cells: impl Iterator<Item = IVec2>,
        filling: Filling,
    ) -> EditReport {
        let mut report = EditReport::default();
        let Some((low, high)) = bounds else { return report };
        let mut occupancy = Occupancy::new(self.particles, low, high);
        for cell in cells {
            if report.placed >= u64::from(filling.most) {
                break;
            }
            let chance = mix(filling.seed ^ mix(cell.x as u32 ^ (cell.y as u32) << 16));
            if unit(chance) * 0.5 + 0.5 >= filling.share && filling.share < 1.0 {
                continue;
            }
            let scatter = mix(chance);
            let at = centre(cell) + filling.scatter * Vec2::new(unit(scatter), unit(scatter >> 16));
            if self.solids.is_solid(cell) || occupancy.is_near(at) {
                continue;
            }
            if self.room_left() == 0 {
                report.refused += 1;
                continue;
            }
            let id = self.take_id();
            self.particles.push(id, element, at, filling.velocity);
            occupancy.insert(at);
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
        report.placed += 1;
    }
}

impl Filling {
    /// Every free site, right on it, at rest.
    fn all() -> Self {
        Self { share: 1.0, seed: 0, scatter: 0.0, velocity: Vec2::ZERO, most: u32::MAX }
    }
}

/// Which points near a region are taken: particles in lists by cell.
struct Occupancy {
    low: IVec2,
    columns: i32,
    rows: i32,
    newest: Vec<u32>,
    points: Vec<(Vec2, u32)>,
}

/// End of a list.
const NONE: u32 = u32::MAX;

impl Occupancy {
    /// The particles in the cells `low … high` and those around them.
    fn new(particles: &Particles, low: IVec2, high: IVec2) -> Self {
        let (low, high) = (low - 1, high + 1);
        let (columns, rows) = (high.x - low.x + 1, high.y - low.y + 1);
        let mut occupancy =
            Self { low, columns, rows, newest: vec![NONE; (columns * rows) as usize], points: Vec::new() };
        for i in 0..particles.len() {
            occupancy.insert(particles.position(i));
        }
        occupancy
    }

    fn index(&self, cell: IVec2) -> Option<usize> {
        let cell = cell - self.low;
        let inside = cell.x >= 0 && cell.y >= 0 && cell.x < self.columns && cell.y < self.rows;
        inside.then(|| (cell.y * self.columns + cell.x) as usize)
    }

    fn insert(&mut self, point: Vec2) {
        if let Some(k) = self.index(Solids::cell_of(point)) {
            self.points.push((point, self.newest[k]));
            self.newest[k] = self.points.len() as u32 - 1;
        }
    }

    fn is_near(&self, point: Vec2) -> bool {
        let cell = Solids::cell_of(point);
        (-1..=1).any(|dy| (-1..=1).any(|dx| self.cell_holds_near(cell + IVec2::new(dx, dy), point)))
    }

    fn cell_holds_near(&self, cell: IVec2, point: Vec2) -> bool {
        let mut entry = self.index(cell).map_or(NONE, |k| self.newest[k]);
        while let Some(&(other, older)) = self.points.get(entry as usize) {
            if (other - point).length_squared() < CLEARANCE * CLEARANCE {
                return true;
            }
            entry = older;
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{brush::BrushShape, element::Element, sources::Rect};

    struct Bench {
        elements: ElementTable,
        particles: Particles,
        solids: Solids,
        next_id: u32,
        limit: u32,
    }

    const ROCK: ElementId = ElementId(0);
    const WATER: ElementId = ElementId(1);

    impl Bench {
        fn new() -> Self {
            let element = |name: &str, fixed: bool, flow: f32| Element {
                name: name.into(),
                key: '1',
                colour: [0; 3],
                fixed,
                density: 1000.0,
                viscosity: 0.0,
                vorticity: 0.0,
                drag: 0.0,
                flow,
            };
            Self {
                elements: ElementTable::new(vec![element("rock", true, 1.0), element("water", false, 0.25)]),
                particles: Particles::default(),
                solids: Solids::new(60, 40),
                next_id: 0,
                limit: 10_000,
            }
        }

        fn matter(&mut self) -> Matter<'_> {
            Matter {
                elements: &self.elements,
                particles: &mut self.particles,
                solids: &mut self.solids,
                next_id: &mut self.next_id,
                limit: self.limit,
            }
        }

        fn nearest(&self) -> f32 {
            let mut nearest = f32::MAX;
            for i in 0..self.particles.len() {
                for j in 0..i {
                    nearest = nearest.min(self.particles.position(i).distance(self.particles.position(j)));
                }
            }
            nearest
        }
    }

    fn disc(x: f32, y: f32, radius: f32) -> Stroke {
        Stroke::dab(BrushShape::Disc, Vec2::new(x, y), radius)
    }

    #[test]
    fn pouring_fills_up_and_never_puts_two_in_one_place() {
        let mut bench = Bench::new();
        let first = bench.matter().pour(WATER, &disc(30.0, 20.0, 6.0), 0);
        assert!((10..=50).contains(&first.placed), "one tick poured {} particles", first.placed);
        for edit in 1..200 {
            bench.matter().pour(WATER, &disc(30.0 + 0.01 * edit as f32, 20.0, 6.0), edit);
        }
        assert!(bench.particles.len() > 80, "the brush did not fill up: {}", bench.particles.len());
        assert!(bench.nearest() >= CLEARANCE, "two particles {} d apart", bench.nearest());
    }

    #[test]
    fn rock_takes_the_place_of_water_and_ids_stay_unique() {
        let mut bench = Bench::new();
        bench.matter().stamp(WATER, &Stroke::rectangle(Vec2::new(10.0, 10.0), Vec2::new(20.0, 20.0)));
        assert_eq!(bench.particles.len(), 100);
        let report = bench.matter().pour(ROCK, &disc(10.0, 10.0, 3.0), 1);
        assert_eq!(report.placed as usize, bench.solids.count());
        assert!(report.removed > 0);
        assert_eq!(bench.particles.len() as u64, 100 - report.removed);
        let mut ids: Vec<u32> = bench.particles.id.clone();
        ids.extend(bench.solids.iter().map(|(.., id)| id));
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| pair[0] < pair[1]), "an id was given twice");
    }

    #[test]
    fn water_is_not_poured_into_rock() {
        let mut bench = Bench::new();
        bench.matter().pour(ROCK, &disc(30.0, 20.0, 5.0), 0);
        let report = bench.matter().stamp(WATER, &disc(30.0, 20.0, 4.0));
        assert_eq!(report.placed, 0);
    }

    #[test]
    fn erasing_takes_everything_under_the_brush_and_nothing_else() {
        let mut bench = Bench::new();
        bench.matter().stamp(WATER, &Stroke::rectangle(Vec2::new(5.0, 5.0), Vec2::new(15.0, 15.0)));
        bench.matter().pour(ROCK, &disc(40.0, 20.0, 3.0), 1);
        let rock = bench.solids.count();
        let report = bench.matter().erase(&disc(10.0, 10.0, 3.0));
        assert!(report.removed > 20 && bench.particles.len() as u64 == 100 - report.removed);
        assert_eq!(bench.solids.count(), rock);
        bench.matter().erase(&Stroke::rectangle(Vec2::ZERO, Vec2::new(60.0, 40.0)));
        assert_eq!((bench.particles.len(), bench.solids.count()), (0, 0));
    }

    #[test]
    fn at_the_limit_placing_stops_and_is_counted() {
        let mut bench = Bench::new();
        bench.limit = 50;
        let report = bench.matter().stamp(WATER, &Stroke::rectangle(Vec2::new(5.0, 5.0), Vec2::new(15.0, 15.0)));
        assert_eq!((report.placed, report.refused), (50, 50));
        assert_eq!(bench.matter().pour(ROCK, &disc(40.0, 20.0, 0.0), 1).refused, 1);
    }

    #[test]
    fn filling_stops_at_rock() {
        let mut bench = Bench::new();
        for k in 0..40 {
            bench.solids.insert(IVec2::new(20, k), ROCK, 1000 + k as u32);
        }
        let report = bench.matter().fill(WATER, Vec2::new(5.0, 5.0));
        assert_eq!(report.placed, 20 * 40);
        assert_eq!(bench.matter().fill(WATER, Vec2::new(5.0, 5.0)).placed, 0, "a full room was filled again");
        assert_eq!(bench.matter().fill(WATER, Vec2::new(-5.0, f32::NAN)).placed, 0);
    }

    #[test]
    fn a_tap_keeps_its_rate_and_its_total() {
        let mut bench = Bench::new();
        let area = Rect { min: Vec2::new(10.0, 30.0), max: Vec2::new(30.0, 34.0) };
        let mut emitter = Emitter {
            element: WATER,
            area,
            velocity: Vec2::new(0.0, -1.0),
            rate: 30.0,
            total: Some(40),
            start: 10,
            given: 0,
            due: 0.0,
        };
        for tick in 0..10 {
            bench.matter().emit(&mut emitter, tick, 1.0 / 60.0);
        }
        assert_eq!(emitter.given, 0, "it flowed before its start");
        for tick in 10..70 {
            bench.matter().emit(&mut emitter, tick, 1.0 / 60.0);
        }
        assert!((29..=31).contains(&emitter.given), "{} particles in a second at 30/s", emitter.given);
        for tick in 70..300 {
            bench.matter().emit(&mut emitter, tick, 1.0 / 60.0);
        }
        assert_eq!((emitter.given, bench.particles.len()), (40, 40));
        assert!(bench.nearest() >= CLEARANCE);
        assert_eq!(bench.matter().drain(&Drain { area }).removed, 40);
    }
}
