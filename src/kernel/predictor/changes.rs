//! From the potentials to the faces: what the pressure changes there, and how the density feedback moves what is near.

use crate::{
    parallel::{Rows, Sweep, Team, sweep},
    predictor::{
        conjugate::Conjugate,
        equation::{Around, CHUNK, fill_in, lighten, marked, steepness, touch},
        grid::MacGrid,
        level::{Level, WORTH_A_PIECE},
        rock::ClosedFaces,
        stencil::Axis,
        transfer::{Faces, Way},
    },
};
use std::ops::Range;

/// Finds what the faces do to particles.
pub(super) struct Changes<'a> {
    pub grid: &'a MacGrid,
    pub closed: &'a ClosedFaces,
    pub conjugate: &'a Conjugate,
    /// Pressure and potential of the density feedback, d/s; 0 where there is no liquid.
    pub potentials: [&'a [f32]; 2],
    pub team: Team,
}

impl Changes<'_> {
    /// Finds the change on every face that touches liquid, and fills one layer around them in from its neighbours. Of
    /// `finest`, the solver is done with the unknowns, the right-hand side and the products, which are used up, and with the
    /// operator, whose memory becomes that of the ways.
    pub fn find(&self, faces: &mut Faces, finest: &mut Level) {
        let Self { grid, closed, conjugate: Conjugate { liquid, rows, .. }, potentials, team } = *self;
        finest.operator.exchange(&mut faces.ways);
        let Faces { u, v, ways: [ways_u, ways_v], filled, reached, area, matter, .. } = faces;
        let columns = &grid.padded(area);
        // The changes on each face, and whether they are known (1) or to be filled in from its neighbours (0).
        let Level { x: gained, b: drift, work: known, .. } = finest;
        // Rows of faces that touch liquid, with the layer around them, and with what is read around that.
        let touching = rows.start..rows.end + 1;
        let near = (rows.start - 1).max(1)..(rows.end + 2).min(grid.rows + 2);
        let around = near.start - 1..near.end + 1;
        let all = reached.start.min(near.start)..reached.end.max(near.end);
        for (axis, means, ways, open) in
            [(Axis::U, &*u, ways_u, &closed.open_u), (Axis::V, &*v, ways_v, &closed.open_v)]
        {
            let matter = matter.as_ref().map(|matter| matter.of(axis));
            let (touching, near) = (&touching, &near);
            let work = Touch { grid, touching, columns, liquid, potentials, filled, closed, open, means, matter, axis };
            let band = |field| Rows::new(field, grid.stride, &around);
            let band = (band(known), (band(gained), band(drift)));
            sweep(&work, around.clone(), band, columns.len(), WORTH_A_PIECE, team);
            let work = FillIn { grid, near, columns, known, changes: [gained, drift], matter };
            sweep(&work, all.clone(), Rows::new(ways, grid.stride, &all), columns.len(), WORTH_A_PIECE, team);
        }
    }
}

/// Fields on faces: what is known of them, and the changes by both potentials.
type Touched<'a> = (Rows<'a, f32>, (Rows<'a, f32>, Rows<'a, f32>));

struct Touch<'a> {
    grid: &'a MacGrid,
    touching: &'a Range<usize>,
    /// Columns that are looked at, with the padding.
    columns: &'a Range<usize>,
    liquid: &'a [f32],
    potentials: [&'a [f32]; 2],
    filled: &'a [f32],
    closed: &'a ClosedFaces,
    /// Open shares, as `closed` stores them.
    open: &'a [f32],
    /// Velocities from before the solve, which closed faces stop.
    means: &'a [[f32; 2]],
    /// Densities and their inverses, where they differ.
    matter: Option<&'a [[f32; 2]]>,
    axis: Axis,
}

impl Sweep<Touched<'_>> for Touch<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut known, (mut gained, mut drift)): Touched) {
        let Self { grid, touching, columns, liquid, potentials, filled, closed, open, means, matter, axis } = *self;
        let step = axis.step(grid);
        // What is filled in reads one face further.
        let around = columns.start.saturating_sub(1)..(columns.end + 1).min(grid.stride);
        let out = known.each().zip(gained.each().zip(drift.each()));
        for (j, (known, (gained, drift))) in rows.zip(out) {
            let fields = [&mut *known, &mut *gained, &mut *drift];
            // Most faces of a wide box touch no liquid.
            for field in fields {
                field[around.clone()].fill(0.0);
            }
            if !touching.contains(&j) {
                continue;
            }
            let end = grid.row(j) + columns.end;
            for start in (grid.row(j) + columns.start.max(1)..end).step_by(CHUNK) {
                let sides = |cells: Range<usize>| [cells.start - step..cells.end - step, cells];
                let [dry, wet] = sides(start..end.min(start + CHUNK)).map(|cells| &liquid[cells]);
                // On the stack, so that nothing that is read can be what is written.
                let mut out = [[0.0_f32; CHUNK]; 4];
                let [steep, touches, velocity, shift] = &mut out;
                for ((touches, dry), wet) in touches.iter_mut().zip(dry).zip(wet) {
                    *touches = if *dry + *wet > 0.0 { 1.0 } else { 0.0 };
                }
                let called_for = marked(&touches[..dry.len()]);
                if called_for.is_empty() {
                    continue;
                }
                let (n, cells) = (called_for.len(), start + called_for.start..start + called_for.end);
                let own = cells.start - grid.row(j)..cells.end - grid.row(j);
                let touches = &touches[called_for];
                let [steep, velocity, shift] = [steep, velocity, shift].map(|field| &mut field[..n]);
                let beside = sides(cells.clone());
                let [liquid, filled] = [liquid, filled].map(|field| beside.clone().map(|cells| &field[cells]));
                steepness(steep, liquid, filled, closed.beside(grid, axis, cells.start, n));
                if let Some(matter) = matter {
                    lighten(steep, &matter[cells.clone()]);
                }
                let (open, means) = (&open[closed.row(j) + own.start..closed.row(j) + own.end], &means[cells]);
                let [pressure, potential] = potentials.map(|field| beside.clone().map(|cells| &field[cells]));
                touch(velocity, pressure, open, steep, means, 1.0);
                touch(shift, potential, open, steep, means, 0.0);
                for i in 0..n {
                    (velocity[i], shift[i]) = (touches[i] * velocity[i], touches[i] * shift[i]);
                }
                known[own.clone()].copy_from_slice(touches);
                gained[own.clone()].copy_from_slice(velocity);
                drift[own].copy_from_slice(shift);
            }
        }
    }
}

struct FillIn<'a> {
    grid: &'a MacGrid,
    near: &'a Range<usize>,
    /// Columns that are looked at, with the padding.
    columns: &'a Range<usize>,
    known: &'a [f32],
    changes: [&'a [f32]; 2],
    /// Densities and their inverses, where they differ.
    matter: Option<&'a [[f32; 2]]>,
}

impl FillIn<'_> {
    /// What a face where the change is not known gains by those around it where it is, d/s: as much as they do, but as much less as
    /// it is heavier. What stops a gas shot at a drop is nothing to the drop.
    #[inline(always)]
    fn gained_beside(&self, matter: &[[f32; 2]], face: usize) -> f32 {
        let (lightness, stride) = (matter[face][1], self.grid.stride);
        let (mut sum, mut count) = (0.0, 0.0);
        for other in [face.wrapping_sub(stride), face.wrapping_sub(1), face + 1, face + stride] {
            if self.known.get(other).is_some_and(|known| *known > 0.0) {
                let share = matter[other][0] * lightness;
                sum += self.changes[0][other] * if share < 1.0 { share } else { 1.0 };
                count += 1.0;
            }
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }
}

impl Sweep<Rows<'_, Way>> for FillIn<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut ways: Rows<Way>) {
        let Self { grid, near, columns, known, changes, matter } = *self;
        for (j, ways) in rows.zip(ways.each()) {
            let ways = &mut ways[columns.clone()];
            let faces = grid.row(j) + columns.start..grid.row(j) + columns.end;
            if near.contains(&j) {
                ways.fill([0.0; 2]);
                for start in faces.clone().step_by(CHUNK) {
                    let around = |field, faces| Around::new(field, faces, grid.stride);
                    let faces = start..faces.end.min(start + CHUNK);
                    let called_for = around(known, faces.clone()).marked();
                    if called_for.is_empty() {
                        continue;
                    }
                    let faces = start + called_for.start..start + called_for.end;
                    let own = faces.start - grid.row(j) - columns.start..faces.end - grid.row(j) - columns.start;
                    let mut out = [[0.0; 2]; CHUNK];
                    let out = &mut out[..faces.len()];
                    fill_in(out, changes.map(|field| around(field, faces.clone())), around(known, faces.clone()));
                    if let Some(matter) = matter {
                        let unknown = out.iter_mut().zip(faces).filter(|(_, face)| known[*face] == 0.0);
                        unknown.for_each(|(way, face)| way[0] = self.gained_beside(matter, face));
                    }
                    ways[own].copy_from_slice(out);
                }
                continue;
            }
            // Beyond the floor stands what stands above it, as `fill_in` finds it beyond the other walls: particles
            // within half a cell of a wall take a part of their velocity along it from there. Elsewhere away from the
            // liquid nothing changes.
            let share = if j == 0 && near.start == 1 { 1.0 } else { 0.0 };
            let [gained, drift] = changes.map(|field| &field[grid.row(1)..][columns.clone()]);
            for (way, (gained, drift)) in ways.iter_mut().zip(gained.iter().zip(drift)) {
                *way = [share * gained, share * drift];
            }
        }
    }
}
