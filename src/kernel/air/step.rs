//! A step of the air: how many substeps, in which order, and when the air has come to rest.

use super::{
    band::{Band, BandPass},
    grid::{Air, MAX_PRESSURE, Scratch},
    law::{self, SURELY_PLAIN},
    lift::{Lift, highest},
    pressure::{Peaks, Push, STILL_MACH, peak, stable_courant},
    report::AirReport,
    rooms::{QUIET_MACH, Room, count_rooms},
    shape::Shape,
    source::{FACE_FILTER, Source},
    tiling::{Block, WATCH},
};
use crate::{
    parallel::{Rows, Team, fork, worth},
    params::{AirAdvection, AirScheme},
    simd::InstructionSet,
    sources::Wind,
    units::TICKS_PER_SECOND,
};

/// Most substeps of one step, whatever [`STRONGEST`] allows. Changing this affects the longest time that a step can take.
pub const MAX_SUBSTEPS: u32 = 64;

/// Most substeps of strong air, in those of air at rest; where these are fewer than one a tick, in that. Past it speeds are
/// clamped and sound is slowed, and both are counted. So all that shares a world with a storm waits for it no longer than
/// for eight quiet airs, however the tick is divided; with what fast particles ask for, a tick stays within ten calm ones.
/// Sound needs no more than half of it (`law`), the rest is for winds. Those that are clamped keep half a cell a substep
/// along either axis, at a Courant number of .7 six times the speed of sound. Changing this affects the strongest wind
/// that a scene can have, and what a storm costs.
const STRONGEST: f32 = 8.0;

/// Largest stable Courant number of sound, c·dt/cell, in air at rest at pressure 1 ([`stable_courant`]).
pub const STABLE_COURANT: f32 = std::f32::consts::SQRT_2 - 2.0 * FACE_FILTER;

/// Courant number of sound that is kept to when the substeps don't suffice: what is stable beside any wind that is left
/// then, half a cell a substep along both axes (`pressure`).
const LIMITED_COURANT: f32 = 0.5;

/// Bands that a thread gets: one may be held up. Changing this affects speed only.
const BANDS_PER_THREAD: usize = 2;

/// Fewest rows of a band: two more are made beside it. Changing this affects speed only.
const FEWEST_ROWS: usize = 16;

/// Cells from which on threads gain more than waking them costs (some 30 µs each time).
const WORTH_WAKING: usize = 32 * 1024;

/// Cells from which on a crew gains more than handing bands to it costs (half a microsecond).
pub(super) const WORTH_BANDS: usize = 512;

impl Scratch {
    fn prepare(&mut self, air: &Air) {
        let cells = air.pressure.len();
        if self.next_pressure.len() != cells {
            self.next_pressure = vec![1.0; cells];
            self.next_x = vec![0.0; cells];
            self.next_y = vec![0.0; cells];
            self.watch.forget();
        }
        self.next_warmth.resize(air.warmth.len(), 0.0);
    }
}

/// A substep's length and the speed of sound in it.
#[derive(Clone, Copy, Debug)]
struct Substep {
    dt: f32,
    sound_speed: f32,
}

impl Air {
    /// Whether so much of the air is awake that threads are worth waking for it.
    pub fn is_worth_waking(&self) -> bool {
        let (awake, tiles) = self.awake_tiles();
        let awake = if self.scratch.sleeps { awake } else { tiles };
        awake > 0 && self.columns() * self.rows() * awake >= WORTH_WAKING * tiles
    }

    /// Moves the air on by `dt` (s) in as many substeps as the scheme calls for. `team` changes the time it takes and not a
    /// bit of the result. Quiet air that no wind drives is left untouched, as is air that is not built.
    pub fn step(&mut self, winds: &[Wind], scheme: AirScheme, team: Team, dt: f32) -> AirReport {
        debug_assert!(dt.is_finite() && scheme.courant.is_finite());
        let mut report = std::mem::take(&mut self.pending);
        let driven = self.is_built() && self.is_driven(winds);
        if (self.quiet && !driven) || dt.is_nan() || dt <= 0.0 {
            return report;
        }
        self.quiet = false;
        let courant = scheme.courant.clamp(0.01, STABLE_COURANT);
        let shape = self.scratch.shape.take();
        let mut shape = shape.unwrap_or_else(|| Shape::new(self.tiling(), &self.solid, self.params.open));
        let mut scratch = std::mem::take(&mut self.scratch);
        (self.scratch.sleeps, self.scratch.gravity) = (scratch.sleeps, scratch.gravity);
        scratch.prepare(self);

        let mut peaks = Peaks::default();
        let (mut left, most) = (dt, self.most_substeps(courant, dt));
        loop {
            if report.substeps.is_multiple_of(WATCH) {
                let changed = self.update_tiles(winds, &mut shape, &mut scratch);
                if scratch.watch.blocks.is_empty() {
                    self.fall_asleep(&shape, &mut scratch);
                    break;
                }
                if changed || report.substeps == 0 {
                    peaks = self.peaks(&scratch.watch.blocks);
                }
                scratch.crowd.close(&shape, self.stride());
                report.cells = report.cells.max(scratch.watch.cells());
            }
            let (count, substep) = self.next_substep(peaks, courant, left, most, &mut report);
            let strong = peaks.pressure > SURELY_PLAIN || self.is_warm();
            self.refresh_outside(&scratch.watch.active, substep.sound_speed);
            peaks = self.substep(substep, scheme.advection, strong, &shape, &mut scratch, team);
            self.settle_edges(&scratch.watch.active, substep.sound_speed, substep.dt);
            peaks = peaks.max(self.blow_winds(winds, substep.dt, &mut report));
            report.substeps += 1;
            report.worked += scratch.watch.cells() as u64;
            left -= substep.dt;
            if count == 1 {
                break;
            }
        }
        if !self.quiet {
            self.balance(&shape, &mut scratch);
            self.lose_warmth(dt);
        }
        let still = !scratch.sleeps
            && !driven
            && !self.is_warm()
            && peaks.x.max(peaks.y) <= QUIET_MACH * self.params.sound_speed;
        if still {
            count_rooms(&shape, &self.pressure, &mut scratch.rooms);
            if scratch.rooms.iter().all(Room::is_even) {
                self.fall_asleep(&shape, &mut scratch);
            }
        }
        scratch.shape = Some(shape);
        self.scratch = scratch;
        report
    }

    /// Substeps that a step of `dt` s with such a `courant` would take in air at rest at pressure 1: the fewest.
    pub fn substeps_at_rest(&self, courant: f32, dt: f32) -> u32 {
        let rate = self.params.sound_speed / (courant.clamp(0.01, STABLE_COURANT) * self.cell);
        (dt * rate).ceil().clamp(1.0, MAX_SUBSTEPS as f32) as u32
    }

    /// Most substeps that a step of `dt` s may take with such a `courant`. Rounded down, so that many short steps have no
    /// more between them than one.
    pub fn most_substeps(&self, courant: f32, dt: f32) -> u32 {
        let at_rest = self.params.sound_speed / (courant.clamp(0.01, STABLE_COURANT) * self.cell);
        (STRONGEST * dt * at_rest.max(TICKS_PER_SECOND as f32)).clamp(1.0, MAX_SUBSTEPS as f32) as u32
    }

    /// The lanes for blocks, which must fill a register, and the rows of a band.
    fn division(&self, team: Team, cells: usize) -> (InstructionSet, usize) {
        let instructions = team.instructions.filled_by(self.columns());
        let shared = team.threads > 1 && cells >= worth(WORTH_BANDS);
        let bands = if shared { team.threads * BANDS_PER_THREAD } else { 1 };
        (instructions, self.rows().div_ceil(bands).max(FEWEST_ROWS))
    }

    /// Substeps still to make in the time `left`, and the next of them. In one of them sound and wind may cross
    /// `courant` cells together, and no velocity more than half a cell, so that two faces of a cell can't give away more
    /// than it has. Past the limit of substeps velocities are clamped to that, and sound is slowed to what is stable.
    fn next_substep(
        &mut self,
        peaks: Peaks,
        courant: f32,
        left: f32,
        most: u32,
        report: &mut AirReport,
    ) -> (u32, Substep) {
        let sound_speed = self.params.sound_speed;
        let sound = sound_speed * law::sound(peaks.pressure);
        let courant = courant.min(stable_courant(peaks.pressure));
        let rate = ((peaks.x + peaks.y + sound) / courant).max(2.0 * peaks.x.max(peaks.y)) / self.cell;
        let budget = most.saturating_sub(report.substeps).max(1);
        let wanted = (left * rate).ceil().max(1.0);
        if wanted <= budget as f32 {
            let count = wanted as u32;
            return (count, Substep { dt: left / wanted, sound_speed });
        }
        let dt = left / budget as f32;
        report.speed_clamps += self.clamp_speeds(0.5 * self.cell / dt);
        let stable = LIMITED_COURANT * self.cell / dt;
        let slowed = sound > stable;
        report.slowed += u64::from(slowed);
        let sound_speed = if slowed { sound_speed * (stable / sound) } else { sound_speed };
        (budget, Substep { dt, sound_speed })
    }

    /// How much of what a step of `dt` s with such a `courant` can follow a cell uses: 1 where a limiter acts. Of its wind
    /// and its sound at the most substeps, and of the highest pressure, whichever comes nearest.
    pub fn limit_share(&self, column: usize, row: usize, courant: f32, dt: f32) -> f32 {
        let crossing = dt / (self.most_substeps(courant, dt) as f32 * self.cell);
        let (pressure, velocity) = (self.pressing_at_cell(column, row), self.velocity_at_cell(column, row));
        let wind = 2.0 * velocity.abs().max_element() * crossing;
        let sound = self.params.sound_speed * law::sound(pressure) * crossing / LIMITED_COURANT;
        wind.max(sound).max(pressure / MAX_PRESSURE)
    }

    fn clamp_speeds(&mut self, limit: f32) -> u64 {
        let mut clamps = 0;
        for velocities in [&mut self.velocity_x, &mut self.velocity_y] {
            // Without a branch, so that the compiler uses lanes.
            for velocity in velocities {
                let fast = velocity.abs() > limit;
                *velocity = if fast { limit.copysign(*velocity) } else { *velocity };
                clamps += u64::from(fast);
            }
        }
        clamps
    }

    /// Both passes over the blocks that are awake, in bands of rows.
    fn substep(
        &mut self,
        substep: Substep,
        advection: AirAdvection,
        strong: bool,
        shape: &Shape,
        scratch: &mut Scratch,
        team: Team,
    ) -> Peaks {
        let (instructions, band_rows) = self.division(team, scratch.watch.cells());
        let stride = self.stride();
        let crossing = substep.dt / self.cell;
        let source = Source {
            pressure: &self.pressure,
            velocity_x: &self.velocity_x,
            velocity_y: &self.velocity_y,
            warmth: self.is_warm().then_some(&self.warmth),
            shape,
            open: scratch.crowd.open(shape),
            stride,
            left: 0,
            width: stride,
            half: 0.5 * crossing,
            filter: FACE_FILTER * substep.sound_speed * crossing,
            second_order: advection == AirAdvection::SecondOrder,
            strong: strong.then_some(instructions),
        };
        let push = Push {
            gain: 0.5 * substep.sound_speed * substep.sound_speed * crossing,
            crossing,
            still: STILL_MACH * self.params.sound_speed,
        };
        let lift = Lift { pull: scratch.gravity * (-2.0 * substep.dt) };
        let count = self.rows().div_ceil(band_rows);
        while scratch.bands.len() < count {
            scratch.bands.push(Band::new(stride));
        }
        let Scratch { next_pressure, next_x, next_y, next_warmth, bands, watch, .. } = scratch;
        let (inner, chunk) = (stride..stride * (self.rows as usize + 1), band_rows * stride);
        let [pressure, x, y] = [&mut *next_pressure, &mut *next_x, &mut *next_y]
            .map(|field| Rows { field: &mut field[inner.clone()], stride: chunk });
        // Cold air has none, whose rows are empty.
        let warmth = if self.is_warm() {
            Rows { field: &mut next_warmth[inner], stride: chunk }
        } else {
            Rows { field: &mut [][..], stride: 0 }
        };
        let parts = ((pressure, x), ((y, warmth), Rows { field: &mut bands[..count], stride: 1 }));
        fork((0..count, parts), 1, &|(nth, ((pressure, velocity_x), ((velocity_y, warmth), bands)))| {
            let [band] = bands.field else { return };
            // Counted with the ring.
            let first = 1 + nth.start * band_rows;
            let end = first + pressure.field.len() / stride;
            let mut peaks = Peaks::default();
            for Block { rows, columns } in &watch.blocks {
                let rows = (rows.start + 1).max(first)..(rows.end + 1).min(end);
                if !rows.is_empty() {
                    let target = [&mut *pressure.field, &mut *velocity_x.field, &mut *velocity_y.field];
                    let source = Source { left: columns.start, width: columns.len() + 2, ..source };
                    let band = &mut *band;
                    let warmth = &mut *warmth.field;
                    let pass = BandPass { band, source, push, lift, rows, first, target, warmth };
                    instructions.run_by_register(pass);
                    peaks = peaks.max(band.peaks);
                }
            }
            band.peaks = peaks;
        });
        std::mem::swap(&mut self.pressure, next_pressure);
        std::mem::swap(&mut self.velocity_x, next_x);
        std::mem::swap(&mut self.velocity_y, next_y);
        std::mem::swap(&mut self.warmth, next_warmth);
        bands[..count].iter().map(|band| band.peaks).fold(Peaks::default(), Peaks::max)
    }

    /// Largest values of the blocks as they stand.
    fn peaks(&self, blocks: &[Block]) -> Peaks {
        let mut peaks = Peaks::default();
        for Block { rows, columns } in blocks {
            // With what lies around them: the air beyond an open side flows in.
            for row in rows.start..rows.end + 2 {
                let cells = row * self.stride() + columns.start..row * self.stride() + columns.end + 2;
                let [x, y, pressure] =
                    [&self.velocity_x, &self.velocity_y, &self.pressure].map(|field| peak(&field[cells.clone()]));
                let warm = self.warmth.get(cells.clone()).map(|warmth| highest(&self.pressure[cells], warmth));
                peaks = peaks.max(Peaks { x, y, pressure: warm.unwrap_or(pressure) });
            }
        }
        peaks
    }

    /// Puts the air to rest: velocities become 0 and the pressure of a room its mean (1 if the room is open), so that a
    /// further step would change nothing. Mass is kept to a rounding, and to what it should be where it has drifted from that
    /// (`balance`).
    fn fall_asleep(&mut self, shape: &Shape, scratch: &mut Scratch) {
        self.know_rests(shape, &mut scratch.rooms);
        count_rooms(shape, &self.pressure, &mut scratch.rooms);
        for (k, room) in shape.room.iter().enumerate().filter(|(_, room)| **room != u32::MAX) {
            let room = *room as usize;
            self.pressure[k] = scratch.rooms[room].settled(self.rests[room]);
        }
        self.stop();
        scratch.watch.forget();
        scratch.ledger.forget();
    }

    /// Stops all wind: from now on nothing moves.
    pub(super) fn stop(&mut self) {
        for velocity in [&mut self.velocity_x, &mut self.velocity_y, &mut self.outside] {
            velocity.fill(0.0);
        }
        self.warmth = Vec::new();
        self.quiet = true;
        self.awake.fill(false);
        self.scratch.watch.forget();
    }
}
