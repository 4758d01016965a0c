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
    allowances::Allow,
    exchanged::Exchanged,
    lattice::{FlowAcross, Lattice, LookAcross, Steps},
    lumps::Lumps,
    matter::Warm,
    passes::{Flow, LookAround, Nearby},
    rates::Rates,
    settle::Settle,
    sorted::Sorted,
    states::FindStates,
    table::HeatTable,
    walls::Walls,
    weights::WEIGHT,
};
use crate::{
    air::Contact,
    parallel::{Team, WORTH_A_PIECE, cut, spread},
    simd::{Lanes, MOST_LANES, Pass},
};
use glam::Vec2;
use std::sync::atomic::{AtomicI64, Ordering};

/// Most steps of a tick.
const MOST_STEPS: f32 = 8.0;
/// Lumps that are worth a part of their own, where each looks at those around it.
const WORTH_A_PART: usize = WORTH_A_PIECE / 8;

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
    /// √k′, √(W/mK); 0 at sites without rock.
    conduction: Vec<f32>,
    /// Part of what it asks for in a step that it can take; 1 all. Before it is known, the weights around it times √k′.
    allowance: Vec<f32>,
    /// 1 if it can take at once what it asks for in a tick, 0 if it takes steps.
    once: Vec<f32>,
    /// Length of its surface, d; of gases as many times as much as it gives more, of what exchanges nothing 0. Before it is known,
    /// the weights around it.
    surface: Vec<f32>,
    /// Heat that makes it a degree warmer, at least, quanta.
    held: Vec<f32>,
    /// What it gains from others, quanta.
    gained: Vec<i32>,
    /// Cells with lumps that take steps, and those around them.
    stepping: Vec<bool>,
    /// Whether any of [`MOST_LANES`] lumps that follow each other is in one, or stands in the air; an entry for so many.
    later: Vec<bool>,
    shore: Shore,
    walls: Walls,
    steps: Steps,
}

/// The fields of rock that something that moves may reach, which stand among others there: an entry for each of it.
#[derive(Clone, Debug, Default)]
struct Shore {
    kelvin: Vec<f32>,
    conduction: Vec<f32>,
    allowance: Vec<f32>,
    once: Vec<f32>,
    /// What it finds of what moves: weights, and weights times √k′, together.
    found: [Vec<f32>; 2],
    /// What it gains from what moves, quanta.
    gained: Vec<i32>,
}

impl Exchange {
    /// Lets heat flow between the lumps for a tick.
    pub fn run(&mut self, lumps: &mut Lumps, warm: &Warm, rates: &Rates, team: Team) -> Flowed {
        let count = lumps.len();
        let Self { kelvin, conduction, allowance, once, surface, held, .. } = self;
        for field in [kelvin, conduction, allowance, once, surface, held] {
            field.resize(count, 0.0);
        }
        self.gained.resize(count, 0);
        self.warm_up(lumps, warm.table, 0, team);
        self.look_around(lumps, team);
        self.allow(lumps, warm.domain.size, rates, team);
        let (steps, cuts) = self.divide(lumps, team);
        let mut to_air = 0;
        let rates = rates.over(steps);
        for step in 0..steps as u32 {
            if step > 0 {
                self.warm_up(lumps, warm.table, step, team);
            }
            let more = if step == 0 { steps - 1.0 } else { -1.0 };
            self.flow(lumps, &rates, more, team);
            to_air += self.settle(lumps, rates.air, more, team);
        }
        Flowed { cuts, to_air }
    }

    /// Finds how warm the lumps are; in a later step those that may have changed.
    fn warm_up(&mut self, lumps: &Lumps, table: &HeatTable, step: u32, team: Team) {
        let Lumps { heat, element, present, grid, .. } = lumps;
        let (slopes, changes) = (&grid.slopes, if step == 0 { &[][..] } else { &self.later });
        spread([&mut self.kelvin[..], &mut self.conduction], WORTH_A_PIECE, team.threads, &|base, out| {
            team.instructions.run(FindStates { table, slopes, heat, element, present, changes, base, out });
        });
    }

    /// Finds how much is around each lump.
    fn look_around(&mut self, lumps: &Lumps, team: Team) {
        let Self { conduction, allowance, surface, shore, steps, .. } = self;
        let (grid, flows, sites) = (&lumps.grid, &lumps.grid.flows[..], lumps.sites.len());
        let (of_sites, of_moving) = cut([&mut surface[..], allowance], sites);
        let (conduction, lattice) = (&conduction[..], Lattice { lumps, steps, flows });
        spread(of_sites, WORTH_A_PART, team.threads, &|base, out| {
            team.instructions.run(LookAcross { lattice, conduction, base, out });
        });
        let look = |own: &Sorted, others: &[(&Sorted, &[f32])], out: [&mut [f32]; 2]| {
            spread(out, WORTH_A_PART, team.threads, &|base, out| {
                let nearby = Nearby { grid, flows, own };
                team.instructions.run(LookAround { nearby, others, base, out });
            });
        };
        let of_shore = lumps.shore.source.iter().map(|k| conduction[*k as usize]);
        shore.conduction.clear();
        shore.conduction.extend(of_shore);
        let moving = (&lumps.moving, &conduction[sites..]);
        look(&lumps.moving, &[moving, (&lumps.shore, &shore.conduction)], of_moving);
        let [whole, through] = &mut shore.found;
        [&mut *whole, through].into_iter().for_each(|found| found.resize(lumps.shore.len(), 0.0));
        look(&lumps.shore, &[moving], [whole, through]);
        for (k, (whole, through)) in lumps.shore.source.iter().zip(whole.iter().zip(&*through)) {
            surface[*k as usize] += whole;
            allowance[*k as usize] += through;
        }
        // What moves is its own neighbour in those sums.
        for (k, conduction) in conduction.iter().enumerate().skip(sites) {
            surface[k] -= WEIGHT;
            allowance[k] -= WEIGHT * conduction;
        }
    }

    /// Finds how much each lump can exchange, and how much of its surface is open, by what is around it.
    fn allow(&mut self, lumps: &Lumps, size: Vec2, rates: &Rates, team: Team) {
        let Self { conduction, allowance, surface, held, walls, .. } = self;
        let (conduction, walls) = (&conduction[..], &*walls);
        spread([&mut allowance[..], surface, held], WORTH_A_PIECE, team.threads, &|base, out| {
            team.instructions.run(Allow { lumps, walls, size, rates, conduction, base, out });
        });
    }

    /// Finds how many steps the tick takes, who takes them, and how much of what each asks for in a step it can take. How many can't
    /// take all is given, too.
    fn divide(&mut self, lumps: &Lumps, team: Team) -> (f32, u64) {
        let Self { allowance, once, surface, stepping, later, .. } = self;
        // What exchanges nothing in the first step must not in a later one, either: it has no allowance.
        let least = least(allowance);
        if least >= 1.0 {
            return (1.0, 0);
        }
        let steps = (1.0 / least.max(1.0 / MOST_STEPS)).ceil();
        stepping.clear();
        stepping.resize(lumps.grid.len(), false);
        let cell = |k: usize| lumps.cell_of(k);
        for (first, allowance) in (0..).step_by(MOST_LANES).zip(allowance.chunks(MOST_LANES)) {
            let is_slow = |allowance: f32| (allowance > 0.0) & (allowance < 1.0);
            if !allowance.iter().fold(false, |any, allowance| any | is_slow(*allowance)) {
                continue;
            }
            let mut last = None;
            for (k, _) in (first..).zip(allowance).filter(|(_, allowance)| is_slow(**allowance)) {
                // Those of a cell follow each other.
                if last != Some(cell(k)) {
                    lumps.grid.mark_around(cell(k), stepping);
                    last = Some(cell(k));
                }
            }
        }
        // All that is slow, and all that exchanges with it, is in such a cell; of what stands in the air the air asks how warm it is.
        later.clear();
        later.extend((0..lumps.len()).step_by(MOST_LANES).map(|first| {
            let end = (first + MOST_LANES).min(lumps.len());
            (first..end).any(|k| surface[k] > 0.0 || stepping[cell(k)])
        }));
        let mut cuts = 0;
        team.instructions.run(Divide { steps, allowance, once, cuts: &mut cuts });
        (steps, cuts)
    }

    /// Finds what flows between lumps in a step.
    fn flow(&mut self, lumps: &Lumps, rates: &Rates, more: f32, team: Team) {
        let Self { kelvin, conduction, allowance, once, gained, stepping, shore, steps, .. } = self;
        let (grid, sites, pairs) = (&lumps.grid, lumps.sites.len(), rates.pairs);
        let flows = if more < 0.0 { &stepping[..] } else { &grid.flows[..] };
        let all = Exchanged { pairs, kelvin, conduction, allowance, once, more };
        let moving = Exchanged {
            kelvin: &kelvin[sites..],
            conduction: &conduction[sites..],
            allowance: &allowance[sites..],
            once: &once[sites..],
            ..all
        };
        shore.follow(&all, &lumps.shore.source);
        let Shore { kelvin, conduction, allowance, once, gained: of_shore, .. } = shore;
        let shore = Exchanged { kelvin, conduction, allowance, once, ..all };
        let (of_sites, of_moving) = gained.split_at_mut(sites);
        let lattice = Lattice { lumps, steps, flows };
        spread([of_sites], WORTH_A_PART, team.threads, &|base, [gained]| {
            team.instructions.run(FlowAcross { lattice, exchanged: all, base, gained });
        });
        let flow = |(own, exchanged): (&Sorted, Exchanged), others: &[(&Sorted, Exchanged)], gained: &mut [i32]| {
            spread([gained], WORTH_A_PART, team.threads, &|base, [gained]| {
                let nearby = Nearby { grid, flows, own };
                team.instructions.run(Flow { nearby, exchanged, others, base, gained });
            });
        };
        let (moving, shore) = ((&lumps.moving, moving), (&lumps.shore, shore));
        flow(moving, &[moving, shore], of_moving);
        flow(shore, &[moving], of_shore);
        for (k, more) in lumps.shore.source.iter().zip(&*of_shore) {
            gained[*k as usize] = gained[*k as usize].saturating_add(*more);
        }
    }

    /// Gives the lumps what they gain in a step, and the air what it takes of them. What that is together is given, quanta.
    fn settle(&self, lumps: &mut Lumps, air: f32, more: f32, team: Team) -> i64 {
        let Self { kelvin, once, surface, held, gained, later, .. } = self;
        let (to_air, changes) = (&AtomicI64::new(0), if more < 0.0 { &later[..] } else { &[] });
        spread([&mut lumps.heat[..]], WORTH_A_PIECE, team.threads, &|base, [heat]| {
            let work = Settle { kelvin, once, surface, held, gained, air, more, changes, base, heat, to_air };
            team.instructions.run(work);
        });
        to_air.load(Ordering::Relaxed)
    }

    /// The lumps that stood in the air in the last tick, with what the air gets of each for each K and length d of surface.
    pub fn contacts(&self, lumps: &Lumps, of_air: f32) -> impl Iterator<Item = Contact> + Clone {
        (0..lumps.len()).filter(|k| self.surface[*k] > 0.0).filter_map(move |k| {
            let conductance = of_air * self.surface[k];
            lumps.position(k).map(|at| Contact { at, conductance, kelvin: self.kelvin[k] })
        })
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { kelvin, conduction, allowance, once, surface, held, gained, stepping, later, shore, .. } = self;
        let floats = [kelvin, conduction, allowance, once, surface, held].map(Vec::capacity).iter().sum::<usize>();
        4 * (floats + gained.capacity()) + stepping.capacity() + later.capacity() + shore.memory()
    }
}

impl Shore {
    /// Follows the fields of all lumps; `source`: which of those it is.
    fn follow(&mut self, all: &Exchanged, source: &[u32]) {
        let Self { kelvin, conduction, allowance, once, gained, .. } = self;
        let fields = [(kelvin, all.kelvin), (conduction, all.conduction), (allowance, all.allowance), (once, all.once)];
        for (own, all) in fields {
            own.clear();
            own.extend(source.iter().map(|k| all[*k as usize]));
        }
        gained.resize(source.len(), 0);
    }

    /// Bytes held.
    fn memory(&self) -> usize {
        let Self { kelvin, conduction, allowance, once, found: [whole, through], gained } = self;
        let floats = [kelvin, conduction, allowance, once, whole, through].map(Vec::capacity).iter().sum::<usize>();
        4 * (floats + gained.capacity())
    }
}

/// Says who takes steps, and how much of what each asks for in one it can take; counts those that can't take all.
struct Divide<'a> {
    steps: f32,
    allowance: &'a mut [f32],
    once: &'a mut [f32],
    cuts: &'a mut u64,
}

impl Pass for Divide<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { steps, allowance, once, cuts } = self;
        for (allowance, once) in allowance.chunks_mut(MOST_LANES).zip(once.chunks_mut(MOST_LANES)) {
            let mut cut = 0_u32;
            for (allowance, once) in allowance.iter_mut().zip(once) {
                *once = if *allowance == 1.0 { 1.0 } else { 0.0 };
                let share = *allowance * steps;
                *allowance = if share < 1.0 { share } else { 1.0 };
                cut += u32::from((share > 0.0) & (share < 1.0));
            }
            *cuts += u64::from(cut);
        }
    }
}

/// The least of some numbers up to 1 that is above 0; 1 if there is none.
fn least(numbers: &[f32]) -> f32 {
    let (pieces, rest) = numbers.as_chunks::<MOST_LANES>();
    let less = |least: f32, number: f32| if number > 0.0 && number < least { number } else { least };
    let mut lanes = [1.0_f32; MOST_LANES];
    for piece in pieces {
        // Side by side, as the lanes of a register.
        for (lane, number) in lanes.iter_mut().zip(piece) {
            *lane = less(*lane, *number);
        }
    }
    lanes.iter().chain(rest).fold(1.0, |least, number| less(least, *number))
}
