//! Rock that comes and goes: which cells are solid, and what becomes of the air in them.
//!
//! A cell is solid when any rock stands in it, so that a wall one particle thick stops the air. New rock squeezes its air
//! out to the nearest open cells; air flows in from the cells beside when rock goes. Both move mass and make none.

use super::grid::Air;
use crate::solids::Solids;
use std::ops::Range;

/// Steps from the nearest cell that a flood started from.
const FAR: u32 = u32::MAX;

impl Air {
    /// Follows the rock. Does nothing while `solids.shape()` is the one it last followed, or to air that is not built.
    ///
    /// Air that has not followed any rock yet keeps its pressure: a scene starts with rock and still air. Resampled air
    /// in a closed box keeps its mass instead. From then on,
    /// - a cell that becomes solid gives its mass in equal parts to the nearest open cells, through others that became
    ///   solid with it if it must, without momentum (the rock took it). Where no open cell can be reached the mass is
    ///   lost and the next report counts it;
    /// - a cell that becomes open again draws from the open cells beside it: one of those with k such neighbours keeps
    ///   1/(k + 1) of its mass and gives as much to each. Where several open at once this goes on inwards. A hollow
    ///   without any open neighbour starts as a vacuum: no air was there.
    pub fn set_solids(&mut self, solids: &Solids) {
        if self.solids_shape == Some(solids.shape()) || !self.is_built() {
            return;
        }
        let first = self.solids_shape.is_none();
        self.solids_shape = Some(solids.shape());
        let mut next = self.solid.clone();
        self.cells().for_each(|k| next[k] = false);
        self.mark(solids, &mut next);
        if next == self.solid {
            self.keep_mass = false;
            return;
        }
        self.scratch.shape = None;
        self.scratch.watch.forget();
        self.rests.clear();
        let before = std::mem::replace(&mut self.solid, next);
        if first {
            self.take_shape(&before);
        } else {
            self.squeeze(&before);
            self.draw(&before);
        }
        for k in self.cells().filter(|k| self.solid[*k]) {
            (self.pressure[k], self.velocity_x[k], self.velocity_y[k]) = (0.0, 0.0, 0.0);
            if self.is_warm() {
                self.warmth[k] = 0.0;
            }
        }
    }

    fn mark(&self, solids: &Solids, mask: &mut [bool]) {
        let cells_of = |site: i32, count: usize| {
            let low = (site as f32 / self.cell).floor() as usize;
            // The site's upper end may be the next cell's lower end, which it then doesn't reach into.
            let high = (((site + 1) as f32 / self.cell).ceil() as usize).min(count);
            low.min(count)..high
        };
        let columns: Vec<Range<usize>> = (0..solids.columns()).map(|x| cells_of(x, self.columns())).collect();
        let rows: Vec<Range<usize>> = (0..solids.rows()).map(|y| cells_of(y, self.rows())).collect();
        solids.iter().for_each(|(site, ..)| {
            for row in rows[site.y as usize].clone() {
                for column in columns[site.x as usize].clone() {
                    mask[self.index(column, row)] = true;
                }
            }
        });
    }

    pub(super) fn in_ring(&self, k: usize) -> bool {
        self.tiling().in_ring(k)
    }

    fn beside(&self, k: usize) -> [usize; 4] {
        [k - 1, k + 1, k - self.stride(), k + self.stride()]
    }

    /// Breadth-first distance of each cell in `region` from the cells in `seeds` (whose own is 0), sideways and up and
    /// down only, and the cells in the order in which they were reached.
    fn flood(&self, seeds: impl Fn(usize) -> bool, region: impl Fn(usize) -> bool) -> (Vec<u32>, Vec<usize>) {
        let mut distance = vec![FAR; self.solid.len()];
        let mut queue: Vec<usize> = self.cells().filter(|k| seeds(*k)).collect();
        for k in &queue {
            distance[*k] = 0;
        }
        let seeded = queue.len();
        let mut next = 0;
        while next < queue.len() {
            let k = queue[next];
            next += 1;
            for beside in self.beside(k) {
                if !self.in_ring(beside) && distance[beside] == FAR && region(beside) {
                    distance[beside] = distance[k] + 1;
                    queue.push(beside);
                }
            }
        }
        queue.drain(..seeded);
        (distance, queue)
    }

    /// Moves the mass of the cells that became solid out of them, the furthest first.
    fn squeeze(&mut self, before: &[bool]) {
        let squeezed = |k: usize| self.solid[k] && !before[k];
        let (distance, order) = self.flood(|k| !self.solid[k], squeezed);
        for k in 0..self.solid.len() {
            if self.solid[k] && !before[k] && distance[k] == FAR {
                let mass = f64::from(self.pressure[k]) * self.cell_area();
                self.pending.buried += mass;
            }
        }
        for k in order.into_iter().rev() {
            let nearer = self.beside(k).map(|beside| (beside, distance[beside] == distance[k] - 1));
            let count = nearer.iter().filter(|(_, nearer)| *nearer).count();
            let part = self.pressure[k] / count as f32;
            for (target, _) in nearer.into_iter().filter(|(_, nearer)| *nearer) {
                let sum = self.pressure[target] + part;
                if part > 0.0 {
                    let kept = self.pressure[target] / sum;
                    self.velocity_x[target] *= kept;
                    self.velocity_y[target] *= kept;
                    if self.is_warm() {
                        self.warmth[target] = self.warmth[target] * kept + self.warmth[k] * (1.0 - kept);
                    }
                    self.touch(target);
                }
                self.pressure[target] = sum;
            }
            self.pressure[k] = 0.0;
        }
    }

    /// Lets air into the cells that became open, the nearest to the others first.
    fn draw(&mut self, before: &[bool]) {
        let opened = |k: usize| !self.solid[k] && before[k];
        let (distance, order) = self.flood(|k| !self.solid[k] && !before[k], opened);
        for layer in order.chunk_by(|a, b| distance[*a] == distance[*b]) {
            let depth = distance[layer[0]];
            let takers = |air: &Self, donor: usize| {
                1.0 + air.beside(donor).iter().filter(|beside| distance[**beside] == depth).count() as f32
            };
            let mut donors = Vec::new();
            for k in layer {
                let (mut mass, mut x, mut y, mut warmth) = (0.0, 0.0, 0.0, 0.0);
                for donor in self.beside(*k).into_iter().filter(|donor| distance[*donor] == depth - 1) {
                    let part = self.pressure[donor] / takers(self, donor);
                    mass += part;
                    x += part * self.velocity_x[donor];
                    y += part * self.velocity_y[donor];
                    warmth += part * self.warmth_of(donor);
                    donors.push(donor);
                }
                // What new rock pushed in here has no speed.
                let sum = self.pressure[*k] + mass;
                if sum > 0.0 {
                    self.velocity_x[*k] = x / sum;
                    self.velocity_y[*k] = y / sum;
                    if self.is_warm() {
                        self.warmth[*k] = (self.warmth[*k] * self.pressure[*k] + warmth) / sum;
                    }
                }
                self.pressure[*k] = sum;
                self.touch(*k);
            }
            donors.sort_unstable();
            donors.dedup();
            for donor in donors {
                self.pressure[donor] /= takers(self, donor);
                self.touch(donor);
            }
        }
    }

    /// The first rock: it squeezes nothing. Cells that resampling took for rock get the mean of the open cells beside
    /// them, and air that was resampled is scaled to its mass.
    fn take_shape(&mut self, before: &[bool]) {
        let mass = self.mass_where(|k| !before[k]);
        let (distance, order) = self.flood(|k| !self.solid[k] && !before[k], |k: usize| !self.solid[k] && before[k]);
        for k in order {
            let nearer = self.beside(k).into_iter().filter(|beside| distance[*beside] == distance[k] - 1);
            let (sum, count) = nearer.fold((0.0, 0.0), |(sum, count), k| (sum + self.pressure[k], count + 1.0_f32));
            self.pressure[k] = sum / count;
        }
        if std::mem::take(&mut self.keep_mass) {
            self.scale_to(mass);
            self.wake_all();
        }
    }

    /// Scales the pressure of a closed box to a mass, d². A box with an open side keeps its pressure: it has the
    /// surroundings to even out with.
    pub(super) fn scale_to(&mut self, mass: f64) {
        let now = self.mass();
        if self.is_open() || now <= 0.0 {
            return;
        }
        let factor = mass / now;
        for k in 0..self.solid.len() {
            if !self.solid[k] {
                self.pressure[k] = (f64::from(self.pressure[k]) * factor) as f32;
            }
        }
    }
}
