//! What pressure does: the gas law.
//!
//! Pressure and density are one thing (`mod`), and the air is pushed by the slope of its *head* h(p), the specific enthalpy
//! over c²: `Du/Dt = −c² ∇h`. The report's gas has h = p. Its sound runs at `c √(p h′) = c √p`, without bound: at the 10⁶
//! atmospheres that a tool may set a thousand times as fast as in air at rest, and a step that follows it costs a thousand
//! times as much. So the gas is stiff up to [`STIFF`] and isothermal beyond, as real gas is when it is slowly pressed:
//!
//! ```text
//! h = p                       p ≤ STIFF        sound c √p
//! h = STIFF (1 + ln(p/STIFF)) p > STIFF        sound c √STIFF = 4 c, however high the pressure
//! ```
//!
//! h and its slope are continuous. A push that is the gradient of a function of the density alone makes neither eddies nor
//! energy: what motion gains is lost by the inner energy `c² Σ e(p)`, e′ = h, which is convex because h rises. Below `STIFF`
//! nothing is otherwise than in the report, to the bit.
//!
//! **Why 16.** The face filter (`source`) adds the share `κ s (h₀ − h₁)` of the cell: seen as a part of the pressure,
//! `κ s p h′` per part, which is `κ √(p h′)` of the sound's own Courant number `s √(p h′)`. It is a filter as long as it is a
//! small part of that: κ = 1/16 in air at rest, and with √(p h′) ≤ 4 never more than ¼, which leaves every Courant
//! number up to `√2 − 2 · ¼` stable, .914 (`pressure`), above all that a quality can ask for (.9). In the report's gas it
//! outgrows the sound: from some 30 atmospheres on air at rest is unstable at a Courant number of .7, and storms there
//! never end.

use crate::simd::{Array, InstructionSet, Lanes, MOST_LANES, Pass, lane_starts};

/// Pressure from which on sound gets no faster, in pressures of the surroundings. Changing this affects strong air only:
/// how fast its sound is and what its steps cost.
pub(super) const STIFF: f32 = 16.0;

/// Pressure up to which no cell can have more than [`STIFF`] a substep later: shares are at most a whole of the cell's own,
/// halves of the four beside it and quarters of the four across, four cells' worth.
pub(super) const SURELY_PLAIN: f32 = STIFF / 4.0;

/// The head h of pressures. Plain arithmetic, so that every machine has the same bits.
#[inline(always)]
fn head_of<L: Lanes>(p: L) -> L {
    let (one, stiff) = (L::splat(1.0), L::splat(STIFF));
    // What is above, as m · 2ⁿ with m from 1 to 2.
    let (mut m, mut n) = ((p * L::splat(1.0 / STIFF)).max(one), L::splat(0.0));
    for power in [32_u32, 16, 8, 4, 2, 1] {
        let scale = (1_u64 << power) as f32;
        n = m.if_less(L::splat(scale), n, n + L::splat(power as f32));
        m = m.if_less(L::splat(scale), m, m * L::splat(1.0 / scale));
    }
    // ln m = 2 artanh t, by its series: t is at most 1/3, and the first term that is left out 1e-8.
    let t = (m - one) / (m + one);
    let t2 = t * t;
    let mut series = L::splat(1.0 / 13.0);
    for odd in [11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
        series = series * t2 + L::splat(1.0 / odd);
    }
    let ln = n * L::splat(std::f32::consts::LN_2) + (t + t) * series;
    p.if_less(stiff, p, stiff + stiff * ln)
}

/// The head h of a pressure.
pub(super) fn head(p: f32) -> f32 {
    let mut head = [0.0];
    head_of(Array::<1>::of(&[p], 0)).put(&mut head, 0);
    head[0]
}

/// Heads of a row of air.
struct HeadsPass<'a> {
    pressure: &'a [f32],
    warmth: Option<&'a [f32]>,
    heads: &'a mut [f32],
}

impl Pass for HeadsPass<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { pressure, warmth, heads } = self;
        let pressing = |i: usize| {
            let p = L::of(pressure, i);
            warmth.map_or(p, |warmth| p + p * L::of(warmth, i))
        };
        let mut highest = L::splat(0.0);
        for i in lane_starts::<L>(pressure.len()) {
            highest = highest.max(pressing(i));
            pressing(i).put(heads, i);
        }
        // A row without stiff air, as most are, is done.
        let mut lanes = [0.0; MOST_LANES];
        highest.store(&mut lanes);
        if lanes.iter().any(|highest| *highest > STIFF) {
            for i in lane_starts::<L>(pressure.len()) {
                head_of(pressing(i)).put(heads, i);
            }
        }
    }
}

/// Heads of a row of air, which fills a register of the instruction set. A pass of its own: within another, which has few
/// registers to spare, it takes several times as long.
pub(super) fn heads(instructions: InstructionSet, pressure: &[f32], warmth: Option<&[f32]>, heads: &mut [f32]) {
    instructions.run_by_register(HeadsPass { pressure, warmth, heads });
}

/// Inner energy of a pressure, over `½ c²` and the area: 2 e(p), e′ = h, above that of the same mass at pressure 1.
pub(super) fn inner_energy(p: f64) -> f64 {
    let stiff = f64::from(STIFF);
    if p <= stiff {
        return (p - 1.0) * (p - 1.0);
    }
    stiff * stiff + 2.0 * stiff * p * (p / stiff).ln() - 2.0 * p + 1.0
}

/// Highest speed of sound at pressures up to `highest`, at least that of air at rest; in speeds of sound at pressure 1.
pub(super) fn sound(highest: f32) -> f32 {
    highest.clamp(1.0, STIFF).sqrt()
}
