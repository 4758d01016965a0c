//! What a file must keep to before anything is made of it. The ranges are those of scenes and elements.

use super::contents::Contents;
use crate::{
    kernel::{
        air::Air,
        columns::ABSURD,
        element::{ElementId, ElementTable},
        params::{AirParams, Domain, Quality},
        particles::Particles,
        solids::Solids,
        sources::Rect,
        units::Scale,
    },
    scene::{
        DETAIL, MOST_COVERED, MOST_DETAIL, Tuning,
        blueprint::Blueprint,
        elements::{self, Fault},
    },
    sim::state::Clock,
};
use glam::Vec2;
use std::collections::HashSet;

/// Most cells of a box.
const MOST_CELLS: f32 = 64e6;
/// Longest side of a box, d.
const LONGEST_SIDE: f32 = 32_768.0;
/// Highest pressure of the predictor, d/s: that of the fastest moves over the longest side in cells, and more.
const ABSURD_POTENTIAL: f32 = 1e12;
/// Most ticks and edits that a world has seen, and ticks until an emitter flows: some five million years, and far from where
/// counting on would come to the end of the numbers.
const LAST_TICK: u64 = 1 << 53;
/// Most emitters, winds and drains each, and parameters: as many as a scene may have.
const MOST_ENTRIES: usize = 1000;
/// Longest text, bytes.
const LONGEST_TEXT: usize = 10_000;
/// Rounding allowance of what went through another unit.
const ROUNDING: f32 = 1.001;

type Verdict = Result<(), String>;

fn demand(holds: bool, what: impl FnOnce() -> String) -> Verdict {
    if holds { Ok(()) } else { Err(what()) }
}

fn within(name: &str, value: f32, low: f32, high: f32) -> Verdict {
    demand(value >= low && value <= high, || format!("{name} is {value}; allowed: {low} to {high}"))
}

/// A place or a velocity of a world.
pub(in crate::sim) fn finite(name: &str, value: Vec2) -> Verdict {
    demand(value.abs().max_element() < ABSURD && value.is_finite(), || {
        format!("{name} is {value}; allowed: less than {ABSURD:e} d, or d/s")
    })
}

/// Everything that needs no rock grid.
pub(super) fn contents(contents: &Contents) -> Verdict {
    texts(contents)?;
    numbers(contents)?;
    element_rows(contents)?;
    clock(&contents.clock)?;
    books(contents)?;
    particles(contents)?;
    sources(contents)?;
    air(contents)
}

fn texts(contents: &Contents) -> Verdict {
    let Blueprint { name, title, description, parameters, .. } = &*contents.scene;
    for text in [name, title, description] {
        demand(text.len() <= LONGEST_TEXT, || format!("a text of {} bytes; allowed: {LONGEST_TEXT}", text.len()))?;
    }
    demand(parameters.len() <= MOST_ENTRIES, || "too many parameters".to_owned())?;
    demand(parameters.values().all(|value| value.is_finite()), || "a parameter is not a number".to_owned())
}

fn numbers(contents: &Contents) -> Verdict {
    let Contents { scene, domain, quality, .. } = contents;
    let Blueprint { scale, fluid, air, particle_limit, .. } = **scene;
    within("detail", scale.detail, DETAIL.min as f32 / ROUNDING, MOST_DETAIL as f32 * ROUNDING)?;
    within("spacing", scale.own_spacing(), 0.001 / ROUNDING, 100.0 * ROUNDING)?;
    within("width", domain.size.x, 4.0, LONGEST_SIDE)?;
    within("height", domain.size.y, 4.0, LONGEST_SIDE)?;
    let cells = domain.size.ceil();
    within("number of cells", cells.x * cells.y, 16.0, MOST_CELLS)?;
    gravity(domain.gravity, scale)?;
    Tuning { fluid, quality: *quality, particle_limit }.check()?;
    within("sound_speed", air.sound_speed * scale.spacing, 1.0 / ROUNDING, 400.0 * ROUNDING)?;
    within("air_density", air.density, 0.01, 1000.0)
}

/// Gravity in d/s² at a spacing: in m/s² it keeps to the range of scenes.
pub(in crate::sim) fn gravity(gravity: Vec2, scale: Scale) -> Verdict {
    within("gravity", gravity.length() * scale.spacing, 0.0, 1500.0)
}

/// The numbers of a quality.
pub(crate) fn quality(quality: &Quality) -> Verdict {
    Tuning::from(*quality).check()
}

fn element_rows(contents: &Contents) -> Verdict {
    let (elements, first) = (&contents.elements, &contents.scene.first_element);
    within("number of elements", elements.len() as f32, 1.0, ElementTable::MOST as f32)?;
    elements::check(elements).map_err(|Fault { row, field, what }| format!("{field} of element {row}: {what}"))?;
    let known = first.as_ref().is_none_or(|first| elements.iter().any(|element| element.name == *first));
    demand(known, || "its first element is none of its elements".to_owned())
}

fn clock(clock: &Clock) -> Verdict {
    let Clock { tick, edits, next_id: _ } = *clock;
    for (name, count) in [("its tick", tick), ("its number of edits", edits)] {
        demand(count <= LAST_TICK, || format!("{name} is {count}; allowed: 0 to {LAST_TICK}"))?;
    }
    Ok(())
}

fn books(contents: &Contents) -> Verdict {
    let (turns, elements) = (contents.books.turns.len(), contents.elements.len());
    demand(turns <= elements, || format!("turns of {turns} elements; allowed: of its {elements} at most"))
}

fn is_movable(contents: &Contents, element: ElementId) -> bool {
    contents.elements.get(element.index()).is_some_and(|element| !element.fixed)
}

fn particles(contents: &Contents) -> Verdict {
    let (particles, rock, clock) = (&contents.particles, &contents.rock, &contents.clock);
    demand(particles.has_equal_columns(), || "the particles' arrays differ in length".to_owned())?;
    let total = particles.len() + rock.len();
    demand(total <= contents.scene.most_particles() as usize, || format!("{total} particles are more than its limit"))?;
    // Places are checked against the cells of the box, where there are some.
    for i in 0..particles.len() {
        for (name, value) in Particles::COLUMNS.iter().zip(particles.get(i).values()) {
            demand(value.is_sound(), || format!("{name} of a particle is no number, or {ABSURD:e} and more"))?;
        }
    }
    let known = particles.element.iter().all(|&element| is_movable(contents, element));
    demand(known, || "a particle is of no movable element".to_owned())?;
    let fixed = |element: ElementId| contents.elements.get(element.index()).is_some_and(|element| element.fixed);
    demand(rock.iter().all(|rock| fixed(rock.element)), || "rock is of no fixed element".to_owned())?;
    let size = contents.domain.size.ceil().as_uvec2();
    let inside = rock.iter().all(|rock| rock.column < size.x && rock.row < size.y);
    demand(inside, || "rock is outside the box".to_owned())?;
    let fits = contents.sleep.fits(particles, contents.domain.size);
    demand(fits, || "its sleepers are not its first particles at rest".to_owned())?;
    let mut ids = HashSet::with_capacity(total);
    for id in particles.id.iter().copied().chain(rock.iter().map(|rock| rock.id)) {
        demand(id < clock.next_id, || format!("particle {id} has an id that is not given yet"))?;
        demand(ids.insert(id), || format!("two particles have the id {id}"))?;
    }
    Ok(())
}

fn sources(contents: &Contents) -> Verdict {
    let sources = &contents.sources;
    let lengths = [sources.emitters.len(), sources.winds.len(), sources.drains.len()];
    demand(lengths.iter().all(|&len| len <= MOST_ENTRIES), || "too many emitters, winds or drains".to_owned())?;
    let area = |area: &Rect| {
        finite("a corner of an area", area.min)?;
        finite("a corner of an area", area.max)?;
        demand(area.min.cmplt(area.max).all(), || format!("an area from {} to {}", area.min, area.max))
    };
    for emitter in &sources.emitters {
        area(&emitter.area)?;
        finite("the velocity of an emitter", emitter.velocity)?;
        let most = 1e6 * contents.scene.scale.particles_per_own() * ROUNDING;
        within("the rate of an emitter", emitter.rate, 0.0, most)?;
        within("what is due of an emitter", emitter.due, 0.0, 1e6)?;
        demand(emitter.start <= LAST_TICK, || {
            format!("the start of an emitter is tick {}; allowed: 0 to {LAST_TICK}", emitter.start)
        })?;
        demand(is_movable(contents, emitter.element), || "an emitter gives no movable element".to_owned())?;
    }
    for wind in &sources.winds {
        area(&wind.area)?;
        finite("the velocity of a wind", wind.velocity)?;
        within("the rate of a wind", wind.rate, 0.0, 1000.0 * ROUNDING)?;
    }
    sources.drains.iter().try_for_each(|drain| area(&drain.area))?;
    let cover = |areas: &mut dyn Iterator<Item = Rect>| -> f64 {
        let inside = |at: Vec2| at.clamp(Vec2::ZERO, contents.domain.size).as_dvec2();
        areas.map(|area| (inside(area.max) - inside(area.min)).element_product()).sum()
    };
    let emitters = cover(&mut sources.emitters.iter().map(|emitter| emitter.area));
    let winds = cover(&mut sources.winds.iter().map(|wind| wind.area));
    let most = emitters.max(winds);
    demand(most <= MOST_COVERED, || format!("emitters or winds cover {most:.0} cells; allowed: at most {MOST_COVERED}"))
}

fn air(contents: &Contents) -> Verdict {
    let Contents { air, domain, quality, .. } = contents;
    air.check()?;
    demand(air.cell() == quality.air_cell, || "its air stands on other cells than its quality's".to_owned())?;
    demand(*air.params() == contents.scene.air, || "its air has other parameters than its scene".to_owned())?;
    demand(air.size() == domain.size, || {
        format!("its air fills a box of {} d, its scene has one of {} d", air.size(), domain.size)
    })?;
    for value in air.values() {
        demand(value.abs() < ABSURD, || format!("a pressure or wind is {value}; allowed: less than {ABSURD:e}"))?;
    }
    for value in contents.kept.values() {
        demand(value.abs() < ABSURD_POTENTIAL, || {
            format!("a pressure of its water is {value}; allowed: less than {ABSURD_POTENTIAL:e}")
        })?;
    }
    // The predictor's cells are no smaller than half a kernel radius, and it keeps some empty ones around the box.
    let most = (domain.size.x + 64.0) * (domain.size.y + 64.0);
    let [fields, entries] = contents.kept.size();
    within("number of fields of its pressure", fields as f32, 1.0, 9.0)?;
    within("number of pressures", entries as f32, 0.0, most)
}

/// The air is closed where the rock is, and nowhere else. Air without a grid knows no rock.
pub(super) fn air_follows_rock(air: &Air, solids: &Solids, domain: &Domain, params: AirParams) -> Verdict {
    if !air.is_built() {
        return Ok(());
    }
    let mut expected = Air::new(domain.size, air.cell(), params);
    expected.set_solids(solids);
    let differ = |row: usize| {
        (0..air.columns()).any(|column| air.is_solid_cell(column, row) != expected.is_solid_cell(column, row))
    };
    demand(!(0..air.rows()).any(differ), || "its air does not follow its rock".to_owned())
}
