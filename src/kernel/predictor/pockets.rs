//! Pockets: connected liquid that touches no air, as in a sealed chamber or a full box.
//!
//! There the pressure equation fixes p only up to a constant, and it has a solution only if its right-hand side adds up
//! to 0. The divergences do (what flows out of one cell flows into the next), the density feedback does not: a pocket
//! that holds too much liquid can't get rid of it. So the mean of the right-hand side is taken out of each pocket.

use crate::predictor::{grid::MacGrid, level::Level};

/// Couplings that differ by less than this are equal: rounding of the sums of open shares.
pub(super) const ROUNDING: f32 = 1e-4;

/// Whether the couplings of a cell, of the diagonal given, are all to liquid cells, so that it touches no air. As much as light
/// matter makes couplings larger, it does so with their rounding.
#[inline(always)]
pub(super) fn is_sealed(diagonal: f32, coupled: f32) -> bool {
    let light = 0.25 * coupled;
    diagonal - coupled <= if light > 1.0 { light * ROUNDING } else { ROUNDING }
}

/// Cells that are looked at together.
const LOOKED_AT: usize = 16;

/// Parts that there is room for at least: there are few but for spray.
const FEWEST_PARTS: usize = 64;

/// The connected parts of the liquid. The buffers are kept. Each cell's label, or the number of the way that led to it, stands in the
/// level's `work`, as a number that single precision holds exactly.
#[derive(Clone, Debug, Default)]
pub(super) struct Pockets {
    parts: Vec<Part>,
    /// Cells that a way to air may lead on from.
    next: Vec<u32>,
}

/// A connected part of the liquid.
#[derive(Clone, Debug)]
struct Part {
    /// Label that this one was found to be connected with; its own if it is the first of them.
    parent: u32,
    /// Number of cells, or [`OPEN`] if one of them touches air.
    cells: u32,
    sum: f64,
}

/// In place of a number of cells: more than any grid has, and no less with more cells.
const OPEN: u32 = u32::MAX;

impl Pockets {
    /// Whether there is any pocket: liquid from which no way leads to air. That is looked for from where no liquid is above and no
    /// air beside, as there is such a cell in every pocket; most others are near air.
    #[inline(always)]
    pub fn are_there(&mut self, grid: &MacGrid, level: &mut Level) -> bool {
        let Level { wet, operator, work: seen, .. } = level;
        let [diagonal, _, right, upper] = operator.fields();
        for j in wet.rows() {
            wet.runs(j).for_each(|run| seen[grid.row(j)..][run].fill(0.0));
        }
        self.next.clear();
        let cells = wet.rows().len() * wet.per_row();
        if cells > self.next.capacity() {
            // As many as there can be, and some to spare: room is made when water comes, not when it moves.
            self.next.reserve_exact(cells + cells / 2);
        }
        let coupled = |k: usize| right[k - 1] + upper[k - grid.stride] + right[k] + upper[k];
        let touches_air = |k: usize| !is_sealed(diagonal[k], coupled(k));
        let mut ways = 0.0;
        for j in wet.rows() {
            for run in wet.runs(j) {
                for start in run.clone().step_by(LOOKED_AT) {
                    let cells = grid.row(j) + start..grid.row(j) + run.end.min(start + LOOKED_AT);
                    // Inside the liquid all have some above them.
                    if upper[cells.clone()].iter().fold(true, |all, coupling| all & (*coupling > 0.0)) {
                        continue;
                    }
                    let ends = cells.filter(|k| diagonal[*k] > 0.0 && upper[*k] == 0.0);
                    for k in ends {
                        if seen[k] == 0.0 && !touches_air(k) {
                            ways += 1.0;
                            if !self.leads_to_air(k, ways, grid.stride, [right, upper], seen, touches_air) {
                                return true;
                            }
                        }
                    }
                }
            }
        }
        false
    }

    /// Whether a way leads from a cell to air, or to where another did. Marks where it goes along with its number.
    fn leads_to_air(
        &mut self,
        from: usize,
        number: f32,
        stride: usize,
        [right, upper]: [&[f32]; 2],
        seen: &mut [f32],
        touches_air: impl Fn(usize) -> bool,
    ) -> bool {
        let Self { next, .. } = self;
        next.clear();
        next.push(from as u32);
        seen[from] = number;
        while let Some(k) = next.pop().map(|k| k as usize) {
            if touches_air(k) {
                return true;
            }
            // What comes last is gone first: up.
            let down_and_aside = [(k - stride, upper[k - stride]), (k - 1, right[k - 1]), (k + 1, right[k])];
            for (other, coupling) in down_and_aside.into_iter().chain([(k + stride, upper[k])]) {
                if coupling == 0.0 || seen[other] == number {
                    continue;
                }
                if seen[other] > 0.0 {
                    return true;
                }
                seen[other] = number;
                next.push(other as u32);
            }
        }
        false
    }

    /// Takes the mean of the right-hand side out of every pocket.
    pub fn balance(&mut self, grid: &MacGrid, level: &mut Level) {
        self.parts.clear();
        let s = grid.stride;
        let Level { wet, operator, b, work, .. } = level;
        let [diagonal, _, right, upper] = operator.fields();
        for j in wet.rows() {
            for k in wet.runs(j).flat_map(|run| grid.row(j) + run.start..grid.row(j) + run.end) {
                if diagonal[k] == 0.0 {
                    continue;
                }
                let (left, lower) = (right[k - 1], upper[k - s]);
                let label = match (left > 0.0, lower > 0.0) {
                    (true, true) => self.join(work[k - 1] as u32, work[k - s] as u32),
                    (true, false) => self.root(work[k - 1] as u32),
                    (false, true) => self.root(work[k - s] as u32),
                    (false, false) => self.found(),
                };
                work[k] = label as f32;
                let coupled = left + lower + right[k] + upper[k];
                let touches_air = !is_sealed(diagonal[k], coupled);
                let part = &mut self.parts[label as usize];
                part.cells = part.cells.saturating_add(if touches_air { OPEN } else { 1 });
                part.sum += f64::from(b[k]);
            }
        }
        self.gather();
        for j in wet.rows() {
            for k in wet.runs(j).flat_map(|run| grid.row(j) + run.start..grid.row(j) + run.end) {
                if diagonal[k] == 0.0 {
                    continue;
                }
                let part = &self.parts[self.root(work[k] as u32) as usize];
                if part.cells != OPEN {
                    b[k] -= (part.sum / f64::from(part.cells)) as f32;
                }
            }
        }
    }

    fn found(&mut self) -> u32 {
        let label = self.parts.len() as u32;
        if self.parts.len() == self.parts.capacity() {
            self.parts.reserve_exact(label as usize / 2 + FEWEST_PARTS);
        }
        self.parts.push(Part { parent: label, cells: 0, sum: 0.0 });
        label
    }

    fn root(&self, mut label: u32) -> u32 {
        while self.parts[label as usize].parent != label {
            label = self.parts[label as usize].parent;
        }
        label
    }

    /// Connects two parts; the older label stays.
    fn join(&mut self, a: u32, b: u32) -> u32 {
        let (a, b) = (self.root(a), self.root(b));
        let (older, newer) = (a.min(b), a.max(b));
        self.parts[newer as usize].parent = older;
        older
    }

    /// Adds what was noted under a newer label to its root.
    fn gather(&mut self) {
        for label in (0..self.parts.len() as u32).rev() {
            let root = self.root(label) as usize;
            if root == label as usize {
                continue;
            }
            let Part { cells, sum, .. } = self.parts[label as usize].clone();
            let part = &mut self.parts[root];
            part.cells = part.cells.saturating_add(cells);
            part.sum += sum;
        }
        // Points every label straight at its root and lets it know what the root knows.
        for label in 0..self.parts.len() as u32 {
            let root = self.root(label);
            let cells = self.parts[root as usize].cells;
            let part = &mut self.parts[label as usize];
            (part.parent, part.cells) = (root, cells);
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<Part>() * self.parts.capacity() + 4 * self.next.capacity()
    }
}
