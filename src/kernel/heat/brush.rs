//! Tools that warm, cool, and set a temperature.

use super::{curve::HeatCurve, matter::Warm, record::HeatRecord};
use crate::{brush::Stroke, element::ElementId};
use glam::IVec2;

/// Warms matter under the stroke by so many degrees, cools it if negative: what changes at a temperature gets as much heat as
/// others would to be so much warmer. No further than to the ends of temperature; the rest is for the next touch.
pub fn warm_under(warm: &mut Warm, stroke: &Stroke, degrees: f32, record: &mut HeatRecord) {
    let table = warm.table;
    reheat_under(warm, stroke, record, |element, held| warmed(table.curve(element), held, degrees));
}

/// Sets matter under the stroke to a temperature, K. What changes on the way there gets all heat of that change, or gives it, and
/// no more; what comes of it is for the next touch.
pub fn set_under(warm: &mut Warm, stroke: &Stroke, kelvin: f32, record: &mut HeatRecord) {
    let table = warm.table;
    reheat_under(warm, stroke, record, |element, _| table.curve(element).heat_towards(kelvin));
}

/// Gives matter under the stroke the heat that `becomes` says for its element and the heat that it holds, quanta, and books the
/// difference as given by hand.
pub fn reheat_under(
    warm: &mut Warm,
    stroke: &Stroke,
    record: &mut HeatRecord,
    becomes: impl Fn(ElementId, i32) -> i32,
) {
    let Warm { particles, solids, .. } = warm;
    let mut given = 0;
    for i in 0..particles.len() {
        if stroke.covers(particles.position(i)) {
            let held = particles.heat_of(i);
            let heat = becomes(particles.element[i], held);
            particles.set_heat(i, heat);
            given += i64::from(heat) - i64::from(held);
        }
    }
    for cell in stroke.cells(IVec2::new(solids.columns(), solids.rows())) {
        let Some((element, _)) = solids.get(cell) else { continue };
        let held = solids.heat(cell);
        let heat = becomes(element, held);
        solids.set_heat(cell, heat);
        given += i64::from(heat) - i64::from(held);
    }
    record.by_hand += given;
}

fn warmed(curve: &HeatCurve, heat: i32, degrees: f32) -> i32 {
    let [lowest, highest] = curve.range();
    let to = heat.saturating_add(curve.quanta_for(degrees));
    // What is beyond its range by heat of its own stays there.
    to.clamp(lowest.min(heat), highest.max(heat))
}
