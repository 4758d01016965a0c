//! Warm air: it presses harder, it is lifted, and it cools.
//!
//! Each cell has a *warmth* τ = T/293 K − 1, which the wind carries as it carries velocity: with the mass, by the same shares, to
//! the same order. What pushes is then not the pressure p, which is the density too (`mod`), but `e = p (1 + τ)`, the pressure
//! that so much air has at that temperature. So heated air spreads until e is even, which leaves it thin; in a sealed room e goes
//! with the temperature. Sound runs at `c √e`: thin hot air costs no more substeps than cold air. All air at 293 K is e = p, and
//! costs nothing more.
//!
//! **Lift.** Air in the model has no weight: at c = 8 m/s its pressure would fall by a seventh each metre. What is left is the
//! difference that warmth makes. Two bodies of air of densities 1 and 1/θ, θ = 1 + τ, move each other at `A g`, with the Atwood
//! number `A = (θ − 1)/(θ + 1) = τ/(2 + τ)`, each against the inertia of the other: a cylinder of warm air rises by `½ A g t²`
//! (Batchelor 1967, 6.4), and waves on the surface between both grow at `√(A g k)`. The model's air is pushed by `−c² ∇e`
//! whatever its density, and so both bodies are equally inert: the pull `a = 2 A g` on the warm one gives both that same motion,
//! since half of it goes into the other.
//!
//! **Loss.** Air gives its warmth to all that is not in the picture, within [`LOSS_SECONDS`]. A tile all of which is nearer to
//! its surroundings than [`QUIET_WARMTH`] has theirs.

use super::{expansion::CAPACITY, grid::Air};
use crate::{
    heat::units::{QUANTUM, ROOM},
    solids::Solids,
};
use glam::Vec2;

/// Time within which warm air cools by a factor of e, s. Changing this affects how high it rises, and how long it keeps the air
/// awake.
pub(super) const LOSS_SECONDS: f32 = 10.0;

/// Warmth from which on air that sleeps is woken, 10 K. Changing this affects what convection costs where all is lukewarm.
const ROUSING_WARMTH: f32 = 0.03;

/// Warmth, 0.3 K, that is none in a tile or a box where there is no more. Changing this affects when air that was warm falls asleep.
pub(super) const QUIET_WARMTH: f32 = 1.0e-3;

/// A lump that stands in the air.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Where, d.
    pub at: Vec2,
    /// What it gives to colder air within the tick, quanta/K.
    pub conductance: f32,
    /// How warm it is, K.
    pub kelvin: f32,
}

impl Air {
    /// Whether any of it is warmer or colder than the surroundings.
    pub fn is_warm(&self) -> bool {
        !self.warmth.is_empty()
    }

    /// How warm a cell of the box is, K; in rock as the surroundings.
    pub fn kelvin_at_cell(&self, column: usize, row: usize) -> f32 {
        ROOM * (1.0 + self.warmth_of(self.row_range(row).start + column))
    }

    /// What pulls at air, d/s²: it lifts what is warm. Not part of the state.
    pub fn set_gravity(&mut self, gravity: Vec2) {
        self.scratch.gravity = gravity;
    }

    /// Warmth of a cell of the fields.
    pub(super) fn warmth_of(&self, k: usize) -> f32 {
        self.warmth.get(k).copied().unwrap_or(0.0)
    }

    /// What a cell of the box pushes with, e: its pressure times its temperature over that of the surroundings; 0 in rock.
    pub fn pressing_at_cell(&self, column: usize, row: usize) -> f32 {
        self.pushing(self.row_range(row).start + column)
    }

    /// What a cell of the fields pushes with, e.
    pub(super) fn pushing(&self, k: usize) -> f32 {
        self.pressure[k] + self.pressure[k] * self.warmth_of(k)
    }

    /// Gives what is warm to the surroundings for `dt` s.
    pub(super) fn lose_warmth(&mut self, dt: f32) {
        let (kept, mut most) = (1.0 / (1.0 + dt / LOSS_SECONDS), 0.0_f32);
        for warmth in &mut self.warmth {
            *warmth *= kept;
            most = most.max(warmth.abs());
        }
        if most <= QUIET_WARMTH {
            self.warmth = Vec::new();
        }
    }

    /// Warms air by what stands in it. `contacts` are lumps and what each of them may give within the tick; the air of a cell
    /// ends at the common temperature of its own and theirs, each with its part. Air that sleeps is woken, or built, where it would
    /// be warmer or colder than its surroundings by [`ROUSING_WARMTH`], and is left as it is where not.
    pub fn warm_up(&mut self, contacts: impl Iterator<Item = Contact> + Clone, solids: &Solids) {
        if !self.is_built() {
            if !contacts.clone().any(|contact| (contact.kelvin / ROOM - 1.0).abs() > ROUSING_WARMTH) {
                return;
            }
            self.build(solids);
        }
        let mut met = std::mem::take(&mut self.scratch.warmed);
        met.clear();
        met.resize(self.pressure.len(), [0.0; 2]);
        for Contact { at, conductance, kelvin } in contacts {
            let k = self.cell_at(at);
            let warmth = kelvin / ROOM - 1.0;
            // Rock fills its cell: it warms those beside it.
            let beside = [k - 1, k + 1, k - self.stride(), k + self.stride()];
            let (cells, conductance) =
                if self.solid[k] { (&beside[..], 0.25 * conductance) } else { (&[k][..], conductance) };
            for k in cells.iter().filter(|k| !self.solid[**k]) {
                met[*k][0] += conductance;
                met[*k][1] += conductance * warmth;
            }
        }
        // What a cell of pressure 1 holds, quanta/K of lumps of 1 d².
        let capacity = self.params.density * (CAPACITY / QUANTUM) * (self.cell * self.cell);
        let tiling = self.tiling();
        for (k, [conductance, given]) in met.iter().enumerate().filter(|(_, [conductance, _])| *conductance > 0.0) {
            let (own, before) = (capacity * self.pressure[k], self.warmth_of(k));
            let after = (own * before + given) / (own + conductance);
            let tile = tiling.of(k % self.stride() - 1, k / self.stride() - 1);
            if !self.awake[tile] && after.abs() <= ROUSING_WARMTH {
                continue;
            }
            if self.warmth.is_empty() {
                self.warmth = vec![0.0; self.pressure.len()];
            }
            self.warmth[k] = after;
            self.wake(tile);
        }
        self.scratch.warmed = met;
    }

    /// The cell of the box that a place (d) is in, or is nearest to.
    pub(super) fn cell_at(&self, at: Vec2) -> usize {
        let nearest = |place: f32, count: usize| ((place / self.cell).max(0.0) as usize).min(count - 1);
        self.index(nearest(at.x, self.columns()), nearest(at.y, self.rows()))
    }
}
