//! What a scene keeps adding and taking: emitters, winds, drains, and the air's pressure and temperature at the start.

use crate::{
    kernel::{
        element::ElementTable,
        heat::units::{COLDEST, HOTTEST, ROOM},
        sources::{Drain, Emitter, Rect, Wind},
        units::TICKS_PER_SECOND,
    },
    scene::{
        blueprint::{PressurePatch, scaled_count},
        error::{SceneError, choices},
        file::{Area, EmitterText, PressureText, WindText},
        knobs::PARTICLE_LIMIT,
        number::{Evaluator, Pair, Range},
        shape::corners,
    },
};
use glam::{DVec2, Vec2};
use std::fmt::Display;

/// Cells that the emitters of a scene may cover together, and its winds: each is looked at in every tick. As many as a box has
/// at most.
pub const MOST_COVERED: f64 = 64e6;

/// Cells that the patches of pressure of a scene may cover together, so that none hangs the program.
const MOST_FILLED: f64 = 1e9;

/// Velocities that a file may give, m/s.
pub(super) const VELOCITY: Range = Range::real(-300.0, 300.0);

/// The box that flows are cut to.
pub(super) struct Bounds<'a> {
    pub(super) values: &'a Evaluator<'a>,
    /// Spacing d of the run, m.
    pub(super) spacing: f64,
    /// The scene's own spacing over it.
    pub(super) detail: f64,
    /// Size of the box, d.
    pub(super) size: Vec2,
}

impl Bounds<'_> {
    /// The part of a rectangle that is in the box, grown by `margin` (d).
    fn area(&self, field: &dyn Display, min: &Pair, max: &Pair, margin: f64) -> Result<Rect, SceneError> {
        let (min, max) = corners(self.values, self.spacing, field, min, max)?;
        let min = min.max(DVec2::splat(-margin)).as_vec2();
        let max = max.min(self.size.as_dvec2() + margin).as_vec2();
        if min.cmplt(max).all() && max.cmpgt(Vec2::ZERO).all() && min.cmplt(self.size).all() {
            return Ok(Rect { min, max });
        }
        let box_size = self.size.as_dvec2() * self.spacing;
        let what =
            format!("outside the box; allowed: between (0, 0) and ({}, {})", box_size.x as f32, box_size.y as f32);
        Err(self.values.fault(field, what))
    }

    fn velocity(&self, field: &dyn Display, velocity: &Pair) -> Result<Vec2, SceneError> {
        let velocity = self.values.pair(format_args!("{field}.velocity"), velocity, VELOCITY)?;
        Ok((velocity / self.spacing).as_vec2())
    }

    /// The entries of a list, which together may cover `most` cells.
    fn list<T, U>(
        &self,
        name: &str,
        texts: &[T],
        read: impl Fn(&dyn Display, &T) -> Result<U, SceneError>,
        area: fn(&U) -> Rect,
        most: f64,
    ) -> Result<Vec<U>, SceneError> {
        let entry = |(i, text)| read(&format_args!("{name}[{i}]"), text);
        let entries: Vec<U> = texts.iter().enumerate().map(entry).collect::<Result<_, _>>()?;
        let areas = entries.iter().map(area);
        let cells: f64 = areas.map(|area| (area.max - area.min).as_dvec2().element_product()).sum();
        if cells <= most {
            return Ok(entries);
        }
        Err(self.values.fault(name, format!("they cover {cells:.0} cells; allowed: at most {most} together")))
    }

    pub(super) fn emitters(&self, elements: &ElementTable, texts: &[EmitterText]) -> Result<Vec<Emitter>, SceneError> {
        let emitter = |field: &dyn Display, text: &EmitterText| self.emitter(elements, field, text);
        self.list("emitters", texts, emitter, |emitter| emitter.area, MOST_COVERED)
    }

    fn emitter(&self, elements: &ElementTable, field: &dyn Display, text: &EmitterText) -> Result<Emitter, SceneError> {
        let values = self.values;
        let Some(element) = elements.find(&text.element).filter(|id| !elements.get(*id).fixed) else {
            let movable =
                elements.iter().filter(|(_, element)| !element.fixed).map(|(_, element)| element.name.as_str());
            let what = format!("no movable element `{}`; {}", text.element, choices(&text.element, movable));
            return Err(values.fault(format_args!("{field}.element"), what));
        };
        let area = self.area(field, &text.min, &text.max, 0.0)?;
        // The first site at or above the lower left corner, in each direction.
        let site = (area.min - 0.5).ceil() + 0.5;
        if !site.cmplt(area.max).all() {
            return Err(values.fault(field, "too small; allowed: a rectangle with the centre of a lattice site in it"));
        }
        let rate = values.number(format_args!("{field}.rate"), &text.rate, Range::real(0.001, 1e6))?;
        let total = text.total.as_ref();
        let total = total.map(|total| values.number(format_args!("{field}.total"), total, PARTICLE_LIMIT));
        let start = text.start.as_ref();
        let start = start.map(|start| values.number(format_args!("{field}.start"), start, Range::real(0.0, 1e6)));
        Ok(Emitter {
            element,
            area,
            velocity: self.velocity(field, &text.velocity)?,
            // In particles of the run: the same area a second, and in all.
            rate: (rate * self.detail * self.detail) as f32,
            total: total.transpose()?.map(|total| scaled_count(total as u32, self.detail)),
            start: (start.transpose()?.unwrap_or(0.0) * f64::from(TICKS_PER_SECOND)).round() as u64,
            given: 0,
            due: 0.0,
        })
    }

    pub(super) fn winds(&self, texts: &[WindText]) -> Result<Vec<Wind>, SceneError> {
        let wind = |field: &dyn Display, text: &WindText| {
            Ok(Wind {
                area: self.area(field, &text.min, &text.max, 0.0)?,
                velocity: self.velocity(field, &text.velocity)?,
                rate: self.values.number(format_args!("{field}.rate"), &text.rate, Range::real(0.001, 1000.0))? as f32,
            })
        };
        self.list("winds", texts, wind, |wind| wind.area, MOST_COVERED)
    }

    /// Drains may reach past the box by a spacing, so that they hold what lies at its wall.
    pub(super) fn drains(&self, texts: &[Area]) -> Result<Vec<Drain>, SceneError> {
        let drain = |field: &dyn Display, text: &Area| Ok(Drain { area: self.area(field, &text.min, &text.max, 1.0)? });
        self.list("drains", texts, drain, |drain| drain.area, f64::INFINITY)
    }

    pub(super) fn pressures(&self, texts: &[PressureText]) -> Result<Vec<PressurePatch>, SceneError> {
        let patch = |field: &dyn Display, text: &PressureText| {
            let path = format_args!("{field}.pressure");
            let pressure = self.values.number(path, &text.pressure, Range::real(0.1, 10.0))? as f32;
            let kelvin = text.temperature.as_ref().map(|at| {
                let range = Range::real(f64::from(COLDEST), f64::from(HOTTEST));
                self.values.number(format_args!("{field}.temperature"), at, range)
            });
            let kelvin = kelvin.transpose()?.map_or(ROOM, |at| at as f32);
            Ok(PressurePatch { area: self.area(field, &text.min, &text.max, 0.0)?, pressure, kelvin })
        };
        self.list("pressures", texts, patch, |patch| patch.area, MOST_FILLED)
    }
}
