//! How much each lump can exchange, and how much of its surface is open.

use super::{lumps::Lumps, rates::Rates, surface::open_length, walls::Walls, weights::REACH};
use crate::{
    simd::{Lanes, MOST_LANES, Pass},
    solids::centre,
};
use glam::{IVec2, Vec2};
use std::ops::Range;

/// Finds, out of the weights around lumps and of those times √k′, how much they can exchange, and how much of their surface is open.
pub(super) struct Allow<'a> {
    pub lumps: &'a Lumps,
    pub walls: &'a Walls,
    /// The box, d.
    pub size: Vec2,
    pub rates: &'a Rates,
    pub conduction: &'a [f32],
    /// The first lump of those that are written.
    pub base: usize,
    /// In: weights times √k′, and weights. Out: part of what a lump asks for in a tick that it can take, 1 if all and 0 where
    /// nothing flows; its surface, d; and heat that makes it a degree warmer, at least, quanta.
    pub out: [&'a mut [f32]; 3],
}

/// What lanes of lumps go by.
struct Lots {
    /// 1 where something flows, else 0.
    flows: [f32; MOST_LANES],
    /// The weights beyond the walls of the box.
    beyond: [f32; MOST_LANES],
    held: [f32; MOST_LANES],
    openness: [f32; MOST_LANES],
}

const NONE: Lots =
    Lots { flows: [0.0; MOST_LANES], beyond: [0.0; MOST_LANES], held: [1.0; MOST_LANES], openness: [1.0; MOST_LANES] };

impl Allow<'_> {
    /// What lumps in lanes go by, `None` if nothing flows in any.
    #[inline(always)]
    fn lots(&self, lumps: Range<usize>) -> Option<Lots> {
        let Lumps { grid, sites, moving, present, cell, element, .. } = self.lumps;
        let mut lots = NONE;
        let mut take = |lane: usize, i: usize, cell: u32, is_there: bool| {
            lots.flows[lane] = f32::from(u8::from(is_there && grid.flows[cell as usize]));
            let slope = grid.slopes.of(element[i]);
            (lots.held[lane], lots.openness[lane]) = (slope.held, slope.openness);
        };
        if let Some(first) = lumps.start.checked_sub(sites.len()) {
            for (lane, i) in lumps.enumerate() {
                let k = first + lane;
                take(lane, i, moving.cell[k], true);
                lots.beyond[lane] = self.walls.around(Vec2::new(moving.x[k], moving.y[k]), self.size);
            }
        } else {
            let first = sites.at(lumps.start)?;
            let at = |lane: usize| centre(first + IVec2::new(lane as i32, 0));
            for (lane, i) in lumps.clone().enumerate() {
                take(lane, i, cell[i], present[i] != 0.0);
            }
            let is_far =
                |at: Vec2| at.cmpge(Vec2::splat(REACH)).all() && (self.size - at).cmpge(Vec2::splat(REACH)).all();
            if !is_far(at(0)) || !is_far(at(lumps.len() - 1)) {
                (0..lumps.len()).for_each(|lane| lots.beyond[lane] = self.walls.around(at(lane), self.size));
            }
        }
        (lots.flows != NONE.flows).then_some(lots)
    }
}

impl Pass for Allow<'_> {
    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        for first in (0..self.out[0].len()).step_by(L::WIDTH) {
            let (first, end) = (self.base + first, self.base + (first + L::WIDTH).min(self.out[0].len()));
            let lots = self.lots(first..end);
            let Self { rates, conduction, base, out, .. } = &mut self;
            let [allowance, surface, held] = out.each_mut().map(|field| &mut field[first - *base..end - *base]);
            let Some(lots) = lots else {
                allowance.fill(0.0);
                surface.fill(0.0);
                held.fill(1.0);
                continue;
            };
            let [flows, beyond, holds, openness] =
                [&lots.flows, &lots.beyond, &lots.held, &lots.openness].map(|field| L::of(field, 0));
            let (one, none) = (L::splat(1.0), L::splat(0.0));
            let open = openness * open_length(L::load(surface) + beyond);
            // What the air may take is not there for the others.
            let asked = L::splat(rates.pairs) * L::load(&conduction[first..end]) * L::load(allowance);
            let left = holds / (one + L::splat(rates.air) * open / holds);
            // Where nothing is asked for the quotient is no number, and not the one that is taken; nor is what is left from before
            // where nothing flows.
            let share = none.if_less(asked, (left / asked).min(one), one);
            none.if_less(flows, share, none).store(allowance);
            none.if_less(flows, open, none).store(surface);
            holds.store(held);
        }
    }
}
