//! How heat flows: between lumps that are near each other, and from those at a surface to the air.
//!
//! **Pairs.** Lump i gets from j `q = √k′ᵢ √k′ⱼ w(r) (Tⱼ − Tᵢ) Δt/d²` per area, with `w = W (1 − r²/h²)²` and W such that on the
//! lattice it is `k′ ∇²T` (`½ Σ w x² = 1`). Rounded to whole quanta, half away from zero, it is what j gets with the other sign.
//!
//! **The bound.** A lump's new temperature is an average of old ones while `Δt/d² Σ √k′ᵢ √k′ⱼ w ≤ cᵢ`. Where it is not, as between
//! metal and ash, or in a crowd, what a pair exchanges is cut by the smaller of both lumps' allowances, `cᵢ d²/(Δt Σ …)`: the
//! same on both sides. So no temperature leaves the range of those around it, at any spacing and any step. What asks for more
//! than one step can do takes as many, 8 at most; what is then left to cut is counted. cᵢ is the lowest capacity among that of
//! the lump and those of what may come of it, or water would boil to steam that is hotter than what boiled it. What a table makes
//! hotter than 4,000 K by a change exchanges heat as if it were no hotter, so that no sum of quanta overflows.
//!
//! **Only where it is so fast.** Two lumps that can both exchange all of a tick at once do so in the first step, and only pairs with
//! one that can't go on: beside a bar of metal a forest costs one step. Each step of a lump asks for no more than all of its
//! pairs do at once, so the bound holds in each.
//!
//! **The air** takes `h′ (T − 293 K) Δt` for each length of a lump's surface, which is what its neighbours leave open, solved for
//! the end of the step; gases give five times as much. It is as warm as the room, whatever it
//! takes: what becomes of it is the air's own (`air/warmth`).

use super::{
    lumps::Lumps,
    matter::Warm,
    passes::{Flow, LookAround},
    rates::Rates,
    table::HeatTable,
    units::HOTTEST,
    walls::Walls,
};
use crate::parallel::{Team, WORTH_A_PIECE, spread};

/// Most steps of a tick.
const MOST_STEPS: f32 = 8.0;
/// Lumps that are worth a piece of their own.
const PIECE: usize = WORTH_A_PIECE / 8;

/// What flowed in a tick.
pub(super) struct Flowed {
    /// Lumps that were held to what evens them out.
    pub cuts: u64,
    /// What the air got, less what it gave, quanta.
    pub to_air: i64,
}

/// Buffers of the exchange, an entry a lump.
#[derive(Clone, Debug, Default)]
pub(super) struct Exchange {
    /// Temperature, K.
    kelvin: Vec<f32>,
    /// √k′, √(W/mK).
    conduction: Vec<f32>,
    /// Part of what it asks for in a step that it can take; 1 all.
    allowance: Vec<f32>,
    /// 1 if it can take at once what it asks for in a tick, 0 if it takes steps.
    once: Vec<f32>,
    /// Cells with lumps that take steps, and those around them.
    stepping: Vec<bool>,
    /// Length of its surface, d; of gases as many times as much as it gives more.
    surface: Vec<f32>,
    /// What it gains from pairs, and gives to the air, quanta.
    gained: Vec<i32>,
    given: Vec<i32>,
    walls: Walls,
}

impl Exchange {
    /// Lets heat flow between the lumps for a tick.
    pub fn run(&mut self, lumps: &mut Lumps, warm: &Warm, rates: &Rates, team: Team) -> Flowed {
        let count = lumps.len();
        for field in [&mut self.kelvin, &mut self.conduction, &mut self.allowance, &mut self.surface] {
            field.resize(count, 0.0);
        }
        self.gained.resize(count, 0);
        self.given.resize(count, 0);
        self.warm_up(lumps, warm.table, team.threads);
        self.look_around(lumps, warm, rates, team);
        let steps = self.divide(lumps);
        let flowing = self.allowance.iter().zip(&lumps.cell).filter(|(_, cell)| lumps.flows[**cell as usize]);
        let cuts = flowing.filter(|(allowance, _)| **allowance < 1.0).count() as u64;
        let mut to_air = 0;
        let rates = rates.over(steps);
        for step in 0..steps as u32 {
            if step > 0 {
                self.warm_up(lumps, warm.table, team.threads);
            }
            self.flow(lumps, warm.table, &rates, (step, steps), team);
            for (heat, (gained, given)) in lumps.heat.iter_mut().zip(self.gained.iter().zip(&self.given)) {
                *heat = heat.saturating_add(gained.saturating_sub(*given));
                to_air += i64::from(*given);
            }
        }
        Flowed { cuts, to_air }
    }

    /// Finds how warm the lumps are.
    fn warm_up(&mut self, lumps: &Lumps, table: &HeatTable, threads: usize) {
        let Lumps { heat, element, .. } = lumps;
        spread([&mut self.kelvin[..], &mut self.conduction], WORTH_A_PIECE, threads, &|first, [kelvin, conduction]| {
            for k in 0..kelvin.len() {
                let (curve, heat) = (table.curve(element[first + k]), heat[first + k]);
                (kelvin[k], conduction[k]) = (curve.temperature(heat).clamp(0.0, HOTTEST), curve.conduction(heat));
            }
        });
    }

    /// Finds how much each lump can exchange, and how much of its surface is open.
    fn look_around(&mut self, lumps: &Lumps, warm: &Warm, rates: &Rates, team: Team) {
        let Self { conduction, allowance, surface, walls, .. } = self;
        let (table, size, conduction, walls) = (warm.table, warm.domain.size, &conduction[..], &*walls);
        spread([&mut allowance[..], &mut surface[..]], PIECE, team.threads, &|base, out| {
            team.instructions.run(LookAround { lumps, table, walls, size, rates, conduction, base, out });
        });
    }

    /// Finds how many steps the tick takes, who takes them, and how much of what each asks for in a step it can take.
    fn divide(&mut self, lumps: &Lumps) -> f32 {
        let Self { allowance, once, stepping, .. } = self;
        let flows = |cell: &u32| lumps.flows[*cell as usize];
        let flowing = allowance.iter().zip(&lumps.cell).filter(|(_, cell)| flows(cell));
        let least = flowing.map(|(allowance, _)| *allowance).fold(1.0, f32::min);
        let steps = (1.0 / least.max(1.0 / MOST_STEPS)).ceil();
        once.clear();
        stepping.clear();
        stepping.resize(lumps.flows.len(), false);
        for (allowance, cell) in allowance.iter_mut().zip(&lumps.cell) {
            let is_whole = *allowance >= 1.0;
            once.push(f32::from(u8::from(is_whole)));
            if !is_whole && flows(cell) {
                lumps.cells_around(*cell as usize).into_iter().for_each(|cells| stepping[cells].fill(true));
            }
            // What does not flow in the first step must not in a later one, either: its cell is not looked at.
            *allowance = if flows(cell) { (*allowance * steps).min(1.0) } else { 0.0 };
        }
        steps
    }

    /// Finds what flows in a step of so many.
    fn flow(&mut self, lumps: &Lumps, table: &HeatTable, rates: &Rates, (step, steps): (u32, f32), team: Team) {
        let Self { kelvin, conduction, allowance, once, stepping, surface, gained, given, .. } = self;
        let (kelvin, conduction, allowance, surface) = (&kelvin[..], &conduction[..], &allowance[..], &surface[..]);
        let (cells, more) = if step == 0 { (&lumps.flows, steps - 1.0) } else { (&*stepping, -1.0) };
        let once = &once[..];
        spread([&mut gained[..], &mut given[..]], PIECE, team.threads, &|base, out| {
            team.instructions.run(Flow {
                lumps,
                table,
                rates,
                cells,
                kelvin,
                conduction,
                allowance,
                once,
                more,
                surface,
                base,
                out,
            });
        });
    }

    /// Length of the surface of a lump (d), and how warm it is (K), as they were in the last step.
    pub fn open(&self, k: usize) -> (f32, f32) {
        (self.surface[k], self.kelvin[k])
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { kelvin, conduction, allowance, once, stepping, surface, gained, given, .. } = self;
        let floats = [kelvin, conduction, allowance, once, surface].iter().map(|field| field.capacity()).sum::<usize>();
        4 * (floats + gained.capacity() + given.capacity()) + stepping.capacity()
    }
}
