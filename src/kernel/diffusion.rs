//! Gases spread in the air: each lump wanders by itself, as eddies carry it that are too small to be simulated.
//!
//! A lump's wandering velocity goes along straight lines from one random value to the next, T apart, along each axis with a
//! variance of 2 D/T. Of lumps that set out from one place, `⟨x²⟩ = 2 D (t − 7 T/15)` for t ≥ 2 T: at first they go on as
//! they began, and then as diffusion has it (G. I. Taylor, "Diffusion by continuous movements", Proc. Lond. Math. Soc. 20,
//! 1921). It moves them and is no velocity of theirs: nothing pushes by it. The values are made of a lump's id and the tick, so
//! nothing has to be kept of them.
//!
//! Gas among its like can't be told from gas that has changed places with it: it stays, and only what is thinner wanders.

use crate::{
    parallel::{WORTH_A_PIECE, spread},
    params::{Domain, WALL_GAP},
    particles::Particles,
    random::{mix, unit},
    solids::Solids,
    units::TICK_SECONDS,
};
use glam::Vec2;

/// Time from one random velocity to the next, ticks: about a half second, as long as the eddies last of what rises a metre a
/// second in puffs of half a metre.
pub const TURN: u64 = 32;

/// Density, as a multiple of the one aimed at, up to which lumps wander freely, and from which on not at all.
const THIN: [f32; 2] = [0.5, 1.0];

/// Moves the lumps of gases for `dt` s of a tick, stopped by rock and box. `spreads`: D of each element, d²/s.
/// `density`: that of each particle, and the one aimed at.
pub fn wander(
    particles: &mut Particles,
    (solids, domain): (&Solids, &Domain),
    spreads: &[f32],
    (density, aim): (&[f32], f32),
    tick: u64,
    threads: usize,
    dt: f32,
) {
    let high = domain.highest();
    let Particles { x, y, id, element, .. } = particles;
    spread([&mut x[..], y], WORTH_A_PIECE, threads, &|first, [x, y]| {
        for k in 0..x.len() {
            let i = first + k;
            let thin = share_that_wanders(density[i] / aim);
            let spread = spreads[element[i].index()];
            if spread * thin > 0.0 {
                let way = dt * thin * velocity(spread, id[i], tick);
                let from = Vec2::new(x[k], y[k]);
                let to = solids.sweep(from, (from + way).clamp(Vec2::splat(WALL_GAP), high));
                (x[k], y[k]) = (to.x, to.y);
            }
        }
    });
}

/// How much of its wandering a lump does at a density.
fn share_that_wanders(density: f32) -> f32 {
    ((THIN[1] - density) / (THIN[1] - THIN[0])).clamp(0.0, 1.0)
}

/// Wandering velocity of a lump in a tick, d/s, where it wanders freely. `spread`: D, d²/s.
pub fn velocity(spread: f32, id: u32, tick: u64) -> Vec2 {
    // They do not all turn at once.
    let own = mix(id ^ 0x9e37_79b9);
    let time = tick + u64::from(own) % TURN;
    let (turn, into) = (time / TURN, ((time % TURN) as f32 + 0.5) / TURN as f32);
    let value = |turn: u64| {
        let bits = mix(own ^ mix(turn as u32));
        Vec2::new(unit(bits), unit(bits >> 16))
    };
    // Of numbers evenly in −1 … 1 the variance is ⅓.
    let most = (6.0 * spread / (TURN as f32 * TICK_SECONDS)).sqrt();
    most * value(turn).lerp(value(turn + 1), into)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::ElementId;
    use glam::IVec2;

    /// D, d²/s, as of smoke at d = 0.1 m.
    const SPREAD: f32 = 10.0;

    fn lumps(count: u32, at: Vec2) -> Particles {
        let mut particles = Particles::default();
        (0..count).for_each(|id| particles.push(id, ElementId(0), at, Vec2::new(1.0, 2.0)));
        particles
    }

    #[test]
    fn lumps_part_as_taylor_has_it() {
        let (count, middle) = (20_000, Vec2::splat(500.0));
        let mut particles = lumps(count, middle);
        let around = (&Solids::new(1000, 1000), &Domain { size: Vec2::splat(1000.0), gravity: Vec2::ZERO });
        let density = vec![0.2; count as usize];
        for tick in 0..600 {
            wander(&mut particles, around, &[SPREAD], (&density, 1.0), tick, 1, TICK_SECONDS);
            let time = (tick + 1) as f32 * TICK_SECONDS;
            if [119, 299, 599].contains(&tick) {
                let mean = |of: &dyn Fn(Vec2) -> f32| {
                    let sum: f64 = (0..count as usize).map(|i| f64::from(of(particles.position(i) - middle))).sum();
                    (sum / f64::from(count)) as f32
                };
                let known = 2.0 * SPREAD * (time - 7.0 / 15.0 * TURN as f32 * TICK_SECONDS);
                // The variance of 20,000 is known to 1 %, their mean to 0.7 % of its root.
                for (square, mean) in
                    [(mean(&|way| way.x * way.x), mean(&|way| way.x)), (mean(&|way| way.y * way.y), mean(&|way| way.y))]
                {
                    assert!((square / known - 1.0).abs() < 0.03, "⟨x²⟩ = {square} after {time} s, {known} expected");
                    assert!(mean.abs() < 0.03 * known.sqrt(), "they drift by {mean} d");
                }
                let cross = mean(&|way| way.x * way.y);
                assert!(cross.abs() < 0.03 * known, "x and y go together: {cross} of {known}");
            }
        }
        assert!(particles.vx.iter().all(|v| *v == 1.0), "it is no velocity");
    }

    #[test]
    fn they_keep_to_the_box_and_out_of_rock_and_stay_among_their_like() {
        let (mut solids, size) = (Solids::new(12, 12), Vec2::splat(12.0));
        solids.insert(IVec2::new(5, 5), ElementId(1), 0);
        let domain = Domain { size, gravity: Vec2::ZERO };
        let mut particles = lumps(500, Vec2::new(4.0, 4.0));
        let crowded: Vec<f32> = (0..500).map(|i| if i < 10 { 1.0 } else { 0.1 }).collect();
        for tick in 0..600 {
            wander(&mut particles, (&solids, &domain), &[SPREAD], (&crowded, 1.0), tick, 1, TICK_SECONDS);
            for i in 0..500 {
                let at = particles.position(i);
                assert!(at.min_element() >= WALL_GAP && at.max_element() <= domain.highest().x, "{at} is outside");
                assert!(!solids.is_solid(Solids::cell_of(at)), "{at} is in rock");
            }
        }
        assert!((0..10).all(|i| particles.position(i) == Vec2::new(4.0, 4.0)), "gas among its like stays");
        assert!((10..500).all(|i| particles.position(i) != Vec2::new(4.0, 4.0)));
    }

    #[test]
    fn threads_change_nothing() {
        let around = (&Solids::new(100, 100), &Domain { size: Vec2::splat(100.0), gravity: Vec2::ZERO });
        let density = vec![0.1; 50_000];
        let after = |threads| {
            let mut particles = lumps(50_000, Vec2::splat(50.0));
            wander(&mut particles, around, &[SPREAD], (&density, 1.0), 7777, threads, TICK_SECONDS);
            (particles.x, particles.y)
        };
        assert_eq!(after(1), after(3));
    }
}
