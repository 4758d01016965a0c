//! Tools that warm and cool.

use super::{curve::HeatCurve, matter::Warm, record::HeatRecord};
use crate::brush::Stroke;
use glam::IVec2;

/// Warms matter under the stroke by so many degrees, cools it if negative: what changes at a temperature gets as much heat as
/// others would to be so much warmer. No further than to the ends of temperature; the rest is for the next touch.
pub fn warm_under(warm: &mut Warm, stroke: &Stroke, degrees: f32, record: &mut HeatRecord) {
    let Warm { particles, solids, table, .. } = warm;
    let mut given = 0;
    for i in 0..particles.len() {
        if stroke.covers(particles.position(i)) {
            let held = particles.heat_of(i);
            let heat = warmed(table.curve(particles.element[i]), held, degrees);
            particles.set_heat(i, heat);
            given += i64::from(heat) - i64::from(held);
        }
    }
    for cell in stroke.cells(IVec2::new(solids.columns(), solids.rows())) {
        let Some((element, _)) = solids.get(cell) else { continue };
        let held = solids.heat(cell);
        let heat = warmed(table.curve(element), held, degrees);
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
