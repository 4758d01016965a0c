//! How warm matter is by the heat that it holds.
//!
//! Heat is enthalpy per area, counted in whole quanta from what matter of the room's temperature holds. What an element's
//! temperature is follows from it by a curve: a slope of its capacity, broken by a plateau where it melts, boils, freezes or
//! condenses. A change gives a lump another element and leaves its heat as it is, so that nothing is made or lost by it, and
//! nothing flickers: at either end of a plateau both elements are of one temperature.

use crate::{
    element::ElementId,
    heat::units::{COLDEST, HOTTEST, QUANTUM, ROOM},
};

/// A change of an element at a temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Temperature, K.
    pub at: f32,
    /// Heat at which the plateau begins, and at which the change is done, quanta: rising for what melts or boils, falling for
    /// what freezes or condenses.
    pub plateau: [i32; 2],
    /// What comes of it, in turn. `None` is air: the lump goes, and leaves its heat to the air.
    pub into: Vec<Option<ElementId>>,
    /// Heat that each of them gets beside what the lump has, quanta, so that all of them are as warm as it was. Together 0.
    pub shares: Vec<i32>,
}

impl Change {
    /// How much of it is done at a heat, 0 … 1.
    #[inline(always)]
    fn share(&self, heat: i32) -> f32 {
        let [begin, end] = self.plateau;
        if end > begin && heat <= begin || end < begin && heat >= begin {
            return 0.0;
        }
        let whole = end.saturating_sub(begin) as f32;
        if whole == 0.0 { 0.0 } else { (heat.saturating_sub(begin) as f32 / whole).min(1.0) }
    }
}

/// How warm an element is by its heat.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatCurve {
    /// Heat at [`ROOM`] on the element's own slope, quanta.
    pub(super) base: i32,
    /// Capacity, J/m²K.
    pub(super) capacity: f32,
    /// See [`HeatCurve::least_capacity`].
    pub(super) least_capacity: f32,
    /// See [`HeatCurve::openness`].
    pub(super) openness: f32,
    /// √k′ of it, of what comes of it below and of what comes of it above, √(W/mK) ([`conduction_of`]).
    pub(super) conduction: [f32; 3],
    /// What it becomes when it is cold enough.
    pub(super) below: Option<Change>,
    /// What it becomes when it is hot enough.
    pub(super) above: Option<Change>,
}

/// √k′, √(W/mK), of matter that has the conductivity k in life, W/mK: `k′ = 6·10⁴ √(0.6 k)`. Heat is to be seen moving: it goes
/// far faster than in life, as if all were stirred in eddies, and metals are no longer ten thousand times ahead of air.
pub(super) fn conduction_of(conductivity: f32) -> f32 {
    (6e4 * (0.6 * conductivity).sqrt()).sqrt()
}

impl HeatCurve {
    /// An element that stays what it is. Capacity in J/m²K, conductivity in W/mK.
    pub fn plain(capacity: f32, conductivity: f32) -> Self {
        Self {
            base: 0,
            capacity,
            least_capacity: capacity,
            openness: 1.0,
            conduction: [conduction_of(conductivity); 3],
            below: None,
            above: None,
        }
    }

    /// Capacity, J/m²K: the lowest among it and what comes of it. What is to be no hotter than what heats it must not be so
    /// after a change, either.
    #[inline(always)]
    pub fn least_capacity(&self) -> f32 {
        self.least_capacity
    }

    /// How many times as much its surface gives to the air as that of liquids and solids does.
    #[inline(always)]
    pub fn openness(&self) -> f32 {
        self.openness
    }

    /// Temperatures between which it is what it is, K.
    pub fn stays_between(&self) -> [f32; 2] {
        let at = |change: &Option<Change>, end: f32| change.as_ref().map_or(end, |change| change.at);
        [at(&self.below, COLDEST), at(&self.above, HOTTEST)]
    }

    /// Least and most heat that it can come to have, quanta: those of the ends of temperature, unless it changes before.
    pub fn bounds(&self) -> [i32; 2] {
        let [lowest, highest] = self.range();
        [if self.below.is_some() { i32::MIN } else { lowest }, if self.above.is_some() { i32::MAX } else { highest }]
    }

    /// Temperature at a heat, K.
    #[inline(always)]
    pub fn temperature(&self, heat: i32) -> f32 {
        let from = |begin: i32, at: f32| at + heat.saturating_sub(begin) as f32 * (QUANTUM / self.capacity);
        match (&self.below, &self.above) {
            (_, Some(Change { at, plateau: [begin, end], .. })) if heat >= *begin => {
                if heat <= *end {
                    *at
                } else {
                    from(*end, *at)
                }
            }
            (Some(Change { at, plateau: [begin, end], .. }), _) if heat <= *begin => {
                if heat >= *end {
                    *at
                } else {
                    from(*end, *at)
                }
            }
            _ => from(self.base, ROOM),
        }
    }

    /// Heat that its changes take, that below and that above, MJ/m²; 0 where there is none.
    pub fn latent(&self) -> [f32; 2] {
        [&self.below, &self.above].map(|change| {
            let quanta = change.as_ref().map_or(0, |change| (change.plateau[1] - change.plateau[0]).abs());
            (f64::from(quanta) * f64::from(QUANTUM) / 1e6) as f32
        })
    }

    /// Least heat with which it is as warm as this (K) or warmer, quanta; the most that there is if it never is.
    pub fn heat_reaching(&self, temperature: f32) -> i32 {
        let (mut colder, mut warmer) = (i32::MIN, i32::MAX);
        while warmer.abs_diff(colder) > 1 {
            let middle = colder.midpoint(warmer);
            if self.temperature(middle) >= temperature {
                warmer = middle;
            } else {
                colder = middle;
            }
        }
        warmer
    }

    /// Heat at a temperature (K) with no change begun, quanta.
    pub fn heat(&self, temperature: f32) -> i32 {
        let more = f64::from(temperature - ROOM) * f64::from(self.capacity) / f64::from(QUANTUM);
        self.base.saturating_add(more.round() as i32)
    }

    /// Heat at a temperature (K), quanta; where a change lies before it, that with which the change is done.
    pub fn heat_towards(&self, temperature: f32) -> i32 {
        let ([coldest, hottest], [lowest, highest]) = (self.stays_between(), self.range());
        if temperature < coldest {
            lowest
        } else if temperature > hottest {
            highest
        } else {
            self.heat(temperature)
        }
    }

    /// Heat of a degree on its slope, quanta.
    pub fn quanta_per_kelvin(&self) -> f64 {
        f64::from(self.capacity) / f64::from(QUANTUM)
    }

    /// Heat that makes it warmer by so many degrees on its slope, quanta.
    pub fn quanta_for(&self, degrees: f32) -> i32 {
        (degrees * (self.capacity / QUANTUM)) as i32
    }

    /// Lowest and highest heat that it can be given: as far as its changes, or to the ends of temperature, quanta.
    pub fn range(&self) -> [i32; 2] {
        let end = |change: &Option<Change>, at: f32| change.as_ref().map_or(self.heat(at), |change| change.plateau[1]);
        [end(&self.below, COLDEST), end(&self.above, HOTTEST)]
    }

    /// √k′ at a heat, √(W/mK): of what is about to be another element the mean of both, by how much of it has changed.
    #[inline(always)]
    pub fn conduction(&self, heat: i32) -> f32 {
        let [own, below, above] = self.conduction;
        let share = |change: &Option<Change>| change.as_ref().map_or(0.0, |change| change.share(heat));
        own + (below - own) * share(&self.below) + (above - own) * share(&self.above)
    }

    /// The change that has begun at a heat, and how much of it is done, 0 … 1.
    pub fn begun(&self, heat: i32) -> Option<(&Change, f32)> {
        let changes = [&self.below, &self.above].into_iter().flatten();
        changes.map(|change| (change, change.share(heat))).find(|(_, share)| *share > 0.0)
    }

    /// The change that is done at a heat, and its place among the element's: 0 where it is cold, 1 where it is hot.
    #[inline(always)]
    pub fn done(&self, heat: i32) -> Option<(usize, &Change)> {
        match (&self.below, &self.above) {
            (_, Some(change)) if heat >= change.plateau[1] => Some((1, change)),
            (Some(change), _) if heat <= change.plateau[1] => Some((0, change)),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Water: 4.19 MJ/m²K, ice below 273 K for 334 MJ/m², steam above 373 K for 452 MJ/m².
    fn water() -> HeatCurve {
        let quanta = |megajoules: f64| (megajoules * 1e6 / f64::from(QUANTUM)).round() as i32;
        let (cold, hot) = (-20.0 * 4.19, 80.0 * 4.19);
        let change = |at, begin, end, into| Change {
            at,
            plateau: [quanta(begin), quanta(end)],
            into: vec![Some(ElementId(into))],
            shares: vec![0],
        };
        HeatCurve {
            below: Some(change(273.0, cold, cold - 334.0, 1)),
            above: Some(change(373.0, hot, hot + 452.0, 2)),
            conduction: [1.0, 3.0, 0.5],
            ..HeatCurve::plain(4.19e6, 0.6)
        }
    }

    #[test]
    fn temperature_follows_heat_over_slopes_and_plateaus() {
        let (curve, quanta) = (water(), |megajoules: f32| (megajoules * 1e6 / QUANTUM) as i32);
        for (heat, kelvin) in [
            (0.0, 293.0),
            (41.9, 303.0),
            (-41.9, 283.0),
            (-100.0, 273.0),
            (-417.0, 273.0),
            (400.0, 373.0),
            (780.0, 373.0),
            (335.2 + 452.0 + 41.9, 383.0),
            (-83.8 - 334.0 - 41.9, 263.0),
        ] {
            let is = curve.temperature(quanta(heat));
            assert!((is - kelvin).abs() < 1e-2, "{is} K at {heat} MJ/m², {kelvin} expected");
        }
        assert!(curve.temperature(i32::MAX).is_finite());
        assert!(curve.temperature(i32::MIN).is_finite());
    }

    #[test]
    fn temperature_never_falls_where_heat_rises() {
        let curve = water();
        let mut before = f32::MIN;
        for heat in (-200_000_000..200_000_000).step_by(50_001) {
            let now = curve.temperature(heat);
            assert!(now >= before, "{before} K, then {now} K at {heat}");
            before = now;
        }
    }

    #[test]
    fn the_heat_that_reaches_a_temperature_is_the_least_that_does() {
        let curve = water();
        for kelvin in [-1e30, 10.0, 263.0, 273.0, 293.0, 373.0, 780.0, 3000.0] {
            let heat = curve.heat_reaching(kelvin);
            assert!(curve.temperature(heat) >= kelvin, "{heat} quanta do not reach {kelvin} K");
            let less = heat.saturating_sub(1);
            assert!(curve.temperature(less) < kelvin || less < -i32::MAX, "{less} quanta reach {kelvin} K, too");
        }
        assert_eq!(curve.heat_reaching(f32::INFINITY), i32::MAX);
    }

    #[test]
    fn on_the_way_to_a_temperature_a_change_is_gone_through_and_no_further() {
        let curve = water();
        let [cold, hot] = curve.range();
        for (kelvin, heat) in [
            (273.0, curve.heat(273.0)),
            (300.0, curve.heat(300.0)),
            (373.0, curve.heat(373.0)),
            (373.1, hot),
            (4000.0, hot),
            (1e30, hot),
            (272.9, cold),
            (-1e30, cold),
        ] {
            assert_eq!(curve.heat_towards(kelvin), heat, "{kelvin} K");
        }
        assert_eq!(curve.done(curve.heat_towards(373.0)), None, "it boils before it is hotter than that");
        let plain = HeatCurve::plain(1e6, 0.5);
        assert_eq!([-5.0, 5000.0].map(|kelvin| plain.heat_towards(kelvin)), plain.range());
    }

    #[test]
    fn what_has_changed_is_known_by_its_heat() {
        let (curve, quanta) = (water(), |megajoules: f32| (megajoules * 1e6 / QUANTUM) as i32);
        assert_eq!(curve.begun(0), None);
        let half = quanta(-83.8 - 167.0);
        assert!(curve.begun(half).is_some_and(|(change, share)| change.at == 273.0 && (share - 0.5).abs() < 1e-3));
        assert!((curve.conduction(half) - 2.0).abs() < 1e-2, "half ice, half water");
        assert_eq!((curve.conduction(0), curve.done(half)), (1.0, None));
        assert_eq!(curve.done(quanta(-83.8 - 334.1)).map(|(place, _)| place), Some(0));
        assert_eq!(curve.done(quanta(335.2 + 452.1)).map(|(place, _)| place), Some(1));
    }

    #[test]
    fn heat_and_temperature_are_inverse_on_the_slope() {
        let curve = water();
        for kelvin in [273.5, 293.0, 300.25, 372.0] {
            assert!((curve.temperature(curve.heat(kelvin)) - kelvin).abs() < 1e-3);
        }
        assert_eq!(curve.heat(ROOM), 0);
    }
}
