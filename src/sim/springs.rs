//! Emitters and drains apart from a world: those of a stamp, and those that are pasted.

use crate::{
    kernel::{
        element::ElementId,
        piece::Turn,
        sources::{Drain, Emitter, Rect},
    },
    scene::blueprint::scaled_count,
};
use glam::{IVec2, Vec2};
use serde::{Deserialize, Serialize};

/// Most of each that there can be: as many as a scene may have.
const MOST: usize = 1000;
/// What a frame cuts off of one counts from so many sites on.
const LEAST: f32 = 0.5;

/// Emitters and drains.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Springs {
    /// What flows.
    pub emitters: Vec<Emitter>,
    /// What takes away.
    pub drains: Vec<Drain>,
}

impl Springs {
    /// What of these is in the cells from `low` up to, but not with, `high`, from `low` on. An emitter that is cut gives as much less
    /// as it is smaller, and what one has given already it does not give again.
    pub fn of(emitters: &[Emitter], drains: &[Drain], low: IVec2, high: IVec2) -> Self {
        let frame = Rect { min: low.as_vec2(), max: high.as_vec2() };
        let cut = |area: Rect| {
            let part = area.within(frame).filter(|part| part.sites() >= LEAST.min(area.sites()))?;
            Some((Rect { min: part.min - frame.min, max: part.max - frame.min }, part.sites() / area.sites()))
        };
        let emitter = |emitter: &Emitter| {
            let (area, share) = cut(emitter.area)?;
            let left = |total: u32| (f64::from(total.saturating_sub(emitter.given)) * f64::from(share)).round() as u32;
            let total = emitter.total.map(left);
            let rest = Emitter { area, rate: emitter.rate * share, total, start: 0, given: 0, due: 0.0, ..*emitter };
            (total != Some(0)).then_some(rest)
        };
        let drain = |drain: &Drain| cut(drain.area).map(|(area, _)| Drain { area });
        Self {
            emitters: emitters.iter().filter_map(emitter).collect(),
            drains: drains.iter().filter_map(drain).collect(),
        }
    }

    /// How many they are.
    pub fn count(&self) -> usize {
        self.emitters.len() + self.drains.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count() == 0
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.emitters.capacity() * size_of::<Emitter>() + self.drains.capacity() * size_of::<Drain>()
    }

    /// Where they are, d.
    pub fn areas(&self) -> impl Iterator<Item = Rect> {
        self.emitters.iter().map(|emitter| emitter.area).chain(self.drains.iter().map(|drain| drain.area))
    }

    /// What flows.
    pub fn elements(&self) -> impl Iterator<Item = ElementId> {
        self.emitters.iter().map(|emitter| emitter.element)
    }

    /// The same with other numbers of their elements.
    #[must_use]
    pub fn with_elements(mut self, number: impl Fn(ElementId) -> ElementId) -> Self {
        self.emitters.iter_mut().for_each(|emitter| emitter.element = number(emitter.element));
        self
    }

    /// The same where there are `factor` new d in one old.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            emitters: self.emitters.iter().map(|emitter| scaled(emitter, factor)).collect(),
            drains: self.drains.iter().map(|drain| Drain { area: scaled_area(drain.area, factor) }).collect(),
        }
    }

    /// The same in a piece of `size` cells that lies so, and with its lowest cell at `low`.
    #[must_use]
    pub fn placed(mut self, low: IVec2, size: IVec2, turn: Turn) -> Self {
        let area = |area: Rect| {
            let [a, b] = [area.min, area.max].map(|corner| low.as_vec2() + turn.place(corner, size));
            Rect { min: a.min(b), max: a.max(b) }
        };
        for emitter in &mut self.emitters {
            (emitter.area, emitter.velocity) = (area(emitter.area), turn.direction(emitter.velocity));
        }
        self.drains.iter_mut().for_each(|drain| drain.area = area(drain.area));
        self
    }

    /// Whether they can have been.
    ///
    /// # Errors
    /// If not: what is wrong, in a few words.
    pub fn check(&self) -> Result<(), String> {
        let demand = |holds: bool, what: &str| if holds { Ok(()) } else { Err(what.to_owned()) };
        let counts = [self.emitters.len(), self.drains.len()];
        demand(counts.iter().all(|count| *count <= MOST), "it has too many emitters or drains")?;
        let is_area = |area: Rect| area.min.is_finite() && area.max.is_finite() && area.min.cmplt(area.max).all();
        demand(self.areas().all(is_area), "the area of an emitter or drain is none")?;
        let flows = |emitter: &Emitter| emitter.velocity.is_finite() && emitter.rate.is_finite() && emitter.rate >= 0.0;
        demand(self.emitters.iter().all(flows), "an emitter has a velocity or rate that is no number")
    }
}

/// An area where there are `factor` new d in one old.
pub(super) fn scaled_area(area: Rect, factor: f64) -> Rect {
    Rect { min: scaled_place(area.min, factor), max: scaled_place(area.max, factor) }
}

/// A place or a velocity there.
pub(super) fn scaled_place(at: Vec2, factor: f64) -> Vec2 {
    (at.as_dvec2() * factor).as_vec2()
}

/// An emitter there: it gives as much matter, in lumps of another size.
pub(super) fn scaled(emitter: &Emitter, factor: f64) -> Emitter {
    Emitter {
        area: scaled_area(emitter.area, factor),
        velocity: scaled_place(emitter.velocity, factor),
        rate: (f64::from(emitter.rate) * factor * factor) as f32,
        total: emitter.total.map(|total| scaled_count(total, factor)),
        given: (f64::from(emitter.given) * factor * factor).round() as u32,
        due: (f64::from(emitter.due) * factor * factor) as f32,
        ..*emitter
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rect(min: (f32, f32), max: (f32, f32)) -> Rect {
        Rect { min: min.into(), max: max.into() }
    }

    fn emitter(area: Rect) -> Emitter {
        let velocity = Vec2::new(3.0, -1.0);
        let element = ElementId(2);
        Emitter { element, area, velocity, rate: 60.0, total: Some(100), start: 9, given: 40, due: 0.5 }
    }

    #[test]
    fn a_frame_cuts_them_and_what_was_given_is_not_given_again() {
        let all = [emitter(rect((4.0, 2.0), (8.0, 4.0))), emitter(rect((9.0, 2.0), (12.0, 4.0)))];
        let drains = [Drain { area: rect((0.0, 0.0), (4.1, 3.0)) }, Drain { area: rect((5.0, 3.0), (6.0, 4.0)) }];
        let taken = Springs::of(&all, &drains, IVec2::new(4, 1), IVec2::new(7, 6));
        let [part] = &taken.emitters[..] else { panic!("{taken:?}") };
        assert_eq!((part.area, part.rate, part.total), (rect((0.0, 1.0), (3.0, 3.0)), 45.0, Some(45)));
        assert_eq!((part.start, part.given, part.due, part.velocity), (0, 0, 0.0, all[0].velocity));
        assert_eq!(taken.drains, [Drain { area: rect((1.0, 2.0), (2.0, 3.0)) }], "of the other there is hardly any");
        let spent = Emitter { given: 100, ..all[0].clone() };
        assert!(Springs::of(&[spent], &[], IVec2::ZERO, IVec2::splat(20)).is_empty());
    }

    #[test]
    fn they_turn_with_their_piece_and_four_quarters_are_none() {
        let springs = Springs { emitters: vec![emitter(rect((1.0, 0.0), (3.0, 1.0)))], drains: Vec::new() };
        let (size, quarter) = (IVec2::new(5, 3), Turn::default().quarter());
        let turned = springs.clone().placed(IVec2::new(10, 20), size, quarter);
        assert_eq!(turned.emitters[0].area, rect((12.0, 21.0), (13.0, 23.0)));
        assert_eq!(turned.emitters[0].velocity, Vec2::new(1.0, 3.0));
        let all_round = quarter.quarter().quarter().quarter();
        assert_eq!(springs.clone().placed(IVec2::ZERO, size, all_round), springs);
        let mirrored = springs.clone().placed(IVec2::ZERO, size, Turn::default().mirrored());
        assert_eq!(mirrored.emitters[0].velocity, Vec2::new(-3.0, -1.0));
        let small = springs.scaled(2.0);
        assert_eq!((small.emitters[0].rate, small.emitters[0].velocity), (240.0, Vec2::new(6.0, -2.0)));
    }

    #[test]
    fn what_can_t_have_been_is_refused() {
        let springs = |emitter: Emitter| Springs { emitters: vec![emitter], drains: Vec::new() };
        let sound = emitter(rect((1.0, 0.0), (3.0, 1.0)));
        assert_eq!(springs(sound.clone()).check(), Ok(()));
        for wrong in [
            Emitter { area: rect((1.0, 0.0), (1.0, 1.0)), ..sound.clone() },
            Emitter { area: rect((f32::NAN, 0.0), (1.0, 1.0)), ..sound.clone() },
            Emitter { velocity: Vec2::splat(f32::INFINITY), ..sound.clone() },
            Emitter { rate: -1.0, ..sound.clone() },
        ] {
            assert!(springs(wrong.clone()).check().is_err(), "{wrong:?}");
        }
        assert!(Springs { emitters: vec![sound; 1001], drains: Vec::new() }.check().is_err());
    }
}
