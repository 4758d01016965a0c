//! Rock on cells of another size.

use crate::{element::ElementId, params::Domain, particles::Particles, solids::Solids};
use glam::{IVec2, Vec2};
use std::collections::BTreeMap;

/// Share of a cell that must be rock.
const HALF: f64 = 0.5;
/// Rounding of a length, d.
const SLACK: f64 = 1e-6;

/// The rock of `old` in a box of `size` (new d): a cell is rock if at least half of what it has in the box was, of the
/// element that most of that was of. With a whole factor that is exactly the old rock. Ids count from `next_id` on.
pub fn resample_rock(old: &Solids, factor: f64, size: Vec2, next_id: &mut u32) -> Solids {
    let cells = size.ceil().as_uvec2();
    let mut new = Solids::new(cells.x, cells.y);
    if old.count() == 0 {
        return new;
    }
    let axis = |k: u32, end: f32, count: i32| -> Vec<(i32, f64)> {
        let (low, high) = (f64::from(k) / factor, f64::from(k + 1).min(f64::from(end)) / factor);
        let (first, last) = ((low + SLACK).floor() as i32, (high - SLACK).ceil() as i32);
        let overlap = |k: i32| (k, high.min(f64::from(k + 1)) - low.max(f64::from(k)));
        (first..last.max(first + 1)).filter(|k| *k < count).map(overlap).collect()
    };
    let columns: Vec<_> = (0..cells.x).map(|x| axis(x, size.x, old.columns())).collect();
    for y in 0..cells.y {
        let rows = axis(y, size.y, old.rows());
        for (x, columns) in columns.iter().enumerate() {
            if let Some((element, heat)) = mostly(old, columns, &rows) {
                let cell = IVec2::new(x as i32, y as i32);
                new.insert(cell, element, *next_id);
                new.set_heat(cell, heat);
                *next_id += 1;
            }
        }
    }
    new
}

/// Rock of which no cell is free gives way where there are `particles` (old d): half a cell of water among rock would have no
/// place in the new one.
pub fn make_room(solids: &mut Solids, particles: &Particles, factor: f64, domain: &Domain) {
    if solids.count() < (solids.columns() * solids.rows()) as usize {
        return;
    }
    for i in 0..particles.len() {
        let at = (particles.position(i).as_dvec2() * factor).as_vec2();
        solids.remove(Solids::cell_of(domain.keep_inside(at)));
    }
}

/// What a cell is of, by the parts of old cells that it covers, and the mean heat of those that were of it, quanta.
fn mostly(old: &Solids, columns: &[(i32, f64)], rows: &[(i32, f64)]) -> Option<(ElementId, i32)> {
    let mut rock: BTreeMap<ElementId, [f64; 2]> = BTreeMap::new();
    let mut whole = 0.0;
    for (y, height) in rows {
        for (x, width) in columns {
            whole += width * height;
            let cell = IVec2::new(*x, *y);
            if let Some((element, _)) = old.get(cell) {
                let [area, heat] = rock.entry(element).or_default();
                *area += width * height;
                *heat += width * height * f64::from(old.heat(cell));
            }
        }
    }
    let most = rock.iter().max_by(|a, b| a.1[0].total_cmp(&b.1[0]));
    let most = most.map(|(element, [area, heat])| (*element, (heat / area).round() as i32));
    most.filter(|_| rock.values().map(|[area, _]| area).sum::<f64>() >= (HALF - SLACK) * whole)
}
