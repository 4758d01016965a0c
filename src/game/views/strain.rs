//! Where limiters act, and how near to it everything else is. Found from the state as it stands, and only while somebody
//! looks: the simulation keeps nothing for it.

use crate::{
    kernel::{
        air::Air, params::Quality, particles::Particles, pbf::Solver, predict::longest_move, predictor::Predictor,
        units::TICK_SECONDS,
    },
    lab::colours::{Rgb, ramp},
    sim::{
        stages::TickPlan,
        state::{AirGrid, Clock, ParticleStore, PredictorState, Setup, SolverState},
    },
};
use bevy::prelude::World;
use glam::{UVec2, Vec2};

/// Edge of a cell of the map, d.
const CELL: f32 = 4.0;
/// From this share of a limit on its limiter counts as acting: less the rounding of what it left.
const ACTS: f32 = 0.999;
/// How long a cell glows after a limiter acted in it, ticks.
const GLOW: f32 = 40.0;

/// Colours of a share of a limit, from none to all.
const STOPS: [Rgb; 6] = [[40, 48, 66], [46, 66, 96], [54, 92, 118], [120, 110, 70], [190, 110, 50], [255, 60, 92]];

/// What the limiters of a world work on.
#[derive(Clone, Copy, Debug)]
pub struct Limited<'a> {
    /// Movable particles.
    pub particles: &'a Particles,
    /// Their solver, after the tick.
    pub solver: Option<&'a Solver>,
    /// The pressure predictor, after the tick.
    pub predictor: Option<&'a Predictor>,
    /// The air.
    pub air: &'a Air,
    /// The numbers in force.
    pub quality: &'a Quality,
    /// Length of a substep of the last tick, s.
    pub dt: f32,
    /// Ticks done.
    pub tick: u64,
}

impl<'a> Limited<'a> {
    /// Those of `world`, if it has been loaded.
    pub fn of(world: &'a World) -> Option<Self> {
        Some(Self {
            particles: world.get_resource::<ParticleStore>()?,
            solver: world.get_resource::<SolverState>().map(|solver| &solver.0),
            predictor: world.get_resource::<PredictorState>().map(|predictor| &predictor.0),
            air: world.get_resource::<AirGrid>()?,
            quality: &world.get_resource::<Setup>()?.quality,
            dt: world.get_resource::<TickPlan>().map_or(TICK_SECONDS, TickPlan::substep_seconds),
            tick: world.get_resource::<Clock>()?.tick,
        })
    }
}

/// How much of its limits every particle uses, and the places where a limiter acted not long ago.
#[derive(Clone, Debug, Default)]
pub struct StrainMap {
    columns: usize,
    rows: usize,
    /// 1 where a limiter acted in the last tick, less for [`GLOW`] ticks after it, 0 elsewhere.
    glow: Vec<f32>,
    /// Share of the nearest limit of each particle, 1 where its limiter acts or did so a moment ago.
    share: Vec<f32>,
    tick: u64,
}

impl StrainMap {
    /// Looks at a world in a box of `size` d; what glows from the last look fades by the ticks since.
    pub fn measure(&mut self, size: Vec2, limited: Limited<'_>) {
        let cells = (size / CELL).ceil().max(Vec2::ONE);
        let dimensions = (cells.x as usize, cells.y as usize);
        if (self.columns, self.rows) != dimensions || limited.tick < self.tick {
            (self.columns, self.rows) = dimensions;
            self.glow.clear();
            self.glow.resize(self.columns * self.rows, 0.0);
        }
        let faded = (limited.tick.saturating_sub(self.tick)) as f32 / GLOW;
        self.tick = limited.tick;
        self.glow.iter_mut().for_each(|glow| *glow = (*glow - faded).max(0.0));
        self.look_at_air(limited.air, limited.quality.air_courant, limited.dt);
        if let Some(predictor) = limited.predictor {
            let reach = 0.5 * predictor.cell();
            predictor.limit_shares(|centre, share| {
                if share > 1.0 {
                    self.light(centre - reach, centre + reach);
                }
            });
        }
        self.look_at_particles(limited);
    }

    fn look_at_air(&mut self, air: &Air, courant: f32, dt: f32) {
        if air.is_quiet() {
            return;
        }
        for row in 0..air.rows() {
            for column in 0..air.columns() {
                if air.limit_share(column, row, courant, dt) >= ACTS {
                    let low = Vec2::new(column as f32, row as f32) * air.cell();
                    self.light(low, low + air.cell());
                }
            }
        }
    }

    fn look_at_particles(&mut self, Limited { particles, solver, quality, dt, .. }: Limited<'_>) {
        let per_move = dt / longest_move(quality);
        self.share.clear();
        for i in 0..particles.len() {
            let at = particles.position(i);
            let corrected = solver.and_then(|solver| solver.correction_share(i, at)).unwrap_or(0.0);
            let share = (particles.velocity(i).length() * per_move).max(corrected);
            if share >= ACTS {
                self.light(at, at);
            }
            self.share.push(share.min(1.0));
        }
        for (i, share) in self.share.iter_mut().enumerate() {
            let at = (particles.position(i) / CELL).max(Vec2::ZERO);
            let (column, row) = ((at.x as usize).min(self.columns - 1), (at.y as usize).min(self.rows - 1));
            *share = share.max(self.glow[row * self.columns + column]);
        }
    }

    /// Lights the cells between two corners, d.
    fn light(&mut self, low: Vec2, high: Vec2) {
        let cell = |at: f32, count: usize| ((at / CELL) as usize).min(count - 1);
        for row in cell(low.y, self.rows)..=cell(high.y, self.rows) {
            for column in cell(low.x, self.columns)..=cell(high.x, self.columns) {
                self.glow[row * self.columns + column] = 1.0;
            }
        }
    }

    /// Share of the nearest limit that each particle uses, 0 … 1, in their order.
    pub fn shares(&self) -> &[f32] {
        &self.share
    }

    /// Columns and rows of the map.
    pub fn dimensions(&self) -> UVec2 {
        UVec2::new(self.columns as u32, self.rows as u32)
    }

    /// What the map covers, d: the box rounded up to whole cells.
    pub fn extent(&self) -> Vec2 {
        self.dimensions().as_vec2() * CELL
    }

    /// How brightly the cell of a point glows, 0 … 1.
    #[cfg(test)]
    fn glow_at(&self, point: Vec2) -> f32 {
        let at = (point / CELL).max(Vec2::ZERO);
        let (column, row) = (at.x as usize, at.y as usize);
        if column < self.columns && row < self.rows { self.glow[row * self.columns + column] } else { 0.0 }
    }

    /// Colours of the glow, premultiplied by their opacity, row by row from the bottom.
    pub fn texels(&self, out: &mut Vec<u8>) {
        out.clear();
        for &glow in &self.glow {
            let opacity = 0.75 * glow;
            out.extend(strain_colour(1.0).map(|channel| (f32::from(channel) * opacity) as u8));
            out.push((255.0 * opacity) as u8);
        }
    }
}

/// Colour of a share of a limit, 0 … 1.
pub fn strain_colour(share: f32) -> Rgb {
    ramp(&STOPS, share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{
        element::ElementId,
        params::{AIR_DENSITY, AirParams, OpenSides, Preset},
        sources::Rect,
    };

    const SIZE: Vec2 = Vec2::new(80.0, 60.0);

    fn air() -> Air {
        Air::new(SIZE, 4.0, AirParams { sound_speed: 500.0, density: AIR_DENSITY, open: OpenSides::default() })
    }

    fn measure(map: &mut StrainMap, particles: &Particles, air: &Air, tick: u64) {
        let quality = Preset::Balanced.quality();
        let limited =
            Limited { particles, solver: None, predictor: None, air, quality: &quality, dt: 1.0 / 120.0, tick };
        map.measure(SIZE, limited);
    }

    #[test]
    fn only_who_is_at_the_speed_limit_glows_and_no_longer_than_a_moment() {
        let limit = longest_move(&Preset::Balanced.quality()) * 120.0;
        let mut particles = Particles::default();
        particles.push(0, ElementId(0), Vec2::new(10.0, 10.0), Vec2::new(0.0, 0.5 * limit));
        particles.push(1, ElementId(0), Vec2::new(50.0, 50.0), Vec2::new(limit, 0.0));
        let mut map = StrainMap::default();
        measure(&mut map, &particles, &air(), 7);
        assert!((map.shares()[0] - 0.5).abs() < 1e-3 && map.shares()[1] == 1.0, "{:?}", map.shares());
        assert_eq!((map.glow_at(Vec2::splat(10.0)), map.glow_at(Vec2::splat(50.0))), (0.0, 1.0));
        particles.vx[1] = 0.0;
        measure(&mut map, &particles, &air(), 7 + GLOW as u64 / 2);
        assert!((map.glow_at(Vec2::splat(50.0)) - 0.5).abs() < 1e-3, "what acted half a glow ago is half as bright");
        measure(&mut map, &particles, &air(), 7 + GLOW as u64);
        assert_eq!((map.glow_at(Vec2::splat(50.0)), map.shares()[1]), (0.0, 0.0));
        let mut texels = Vec::new();
        map.texels(&mut texels);
        assert!(texels.iter().all(|byte| *byte == 0) && texels.len() == 4 * 20 * 15);
    }

    #[test]
    fn air_past_its_limits_glows_where_it_is() {
        let mut air = air();
        air.fill_pressure(Rect { min: Vec2::new(40.0, 20.0), max: Vec2::new(44.0, 24.0) }, 1e6);
        let mut map = StrainMap::default();
        measure(&mut map, &Particles::default(), &air, 1);
        assert_eq!((map.glow_at(Vec2::new(42.0, 22.0)), map.glow_at(Vec2::new(70.0, 50.0))), (1.0, 0.0));
    }

    #[test]
    fn a_world_that_went_back_in_time_forgets_what_glowed() {
        let limit = longest_move(&Preset::Balanced.quality()) * 120.0;
        let mut particles = Particles::default();
        particles.push(0, ElementId(0), Vec2::new(50.0, 50.0), Vec2::new(limit, 0.0));
        let mut map = StrainMap::default();
        measure(&mut map, &particles, &air(), 90);
        measure(&mut map, &Particles::default(), &air(), 2);
        assert_eq!(map.glow_at(Vec2::splat(50.0)), 0.0);
    }
}
