//! The A/B split as a player has it: on and off, and where in the window its parts are.

use crate::{
    game::{
        camera::Area,
        hud::panels::accuracy::panel::{AccuracyPanel, PANEL},
        lens::{self, Lens},
        panels::Panels,
        toasts::Toasts,
    },
    kernel::params::Preset,
    lab::{
        autopilot::Autopilot,
        live::{
            accuracy::{LiveError, Watched},
            measures::Measures,
        },
        split::Split,
    },
    sim::state::Setup,
};
use bevy::prelude::{Res, ResMut, World};
use glam::Vec2;
use tr::tr;

/// Height of the line over each part, points.
pub const LABEL: f32 = 30.0;
/// Room between the parts, points.
const GAP: f32 = 4.0;

/// Puts a second world beside the one that is played, or lets it go: then the first goes on alone.
pub fn toggle(world: &mut World) {
    // A second world that is seen through the lens gives way to one that is seen whole.
    if !lens::lay_down(world) && world.resource::<Split>().is_on() {
        world.resource_mut::<Split>().end();
        return;
    }
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let preset = if setup.preset == Preset::Draft { Preset::Fine } else { Preset::Draft };
    begin(world, preset, tr!("The same world at two qualities; B again goes on with A alone"));
}

/// Starts the second world again from the first, at this quality.
pub fn choose(world: &mut World, preset: Preset) {
    if world.resource::<Split>().is_on() {
        begin(world, preset, tr!("B starts again from A as it is now"));
    }
}

fn begin(world: &mut World, preset: Preset, told: String) {
    let begun = Split::begin(world, preset, preset.quality());
    let mut toasts = world.resource_mut::<Toasts>();
    match begun {
        Ok(()) => toasts.say(told),
        Err(error) => toasts.warn(error),
    }
}

/// Lets the error of the world be sampled, and all else be measured, while somebody looks at it.
pub fn watch(
    (panels, accuracy): (Res<Panels>, Res<AccuracyPanel>),
    autopilot: Res<Autopilot>,
    (split, lens): (Res<Split>, Res<Lens>),
    mut watched: ResMut<Watched>,
    mut error: ResMut<LiveError>,
    mut measures: ResMut<Measures>,
) {
    let wanted = panels.shows(PANEL.id) && accuracy.measures;
    if measures.wanted() != wanted {
        measures.want(wanted);
    }
    let looks = panels.shows(PANEL.id) || autopilot.goal().is_some() || split.is_on() && !lens.is_on();
    if watched.0 != looks {
        watched.0 = looks;
        // What was measured before somebody looked away is of another time.
        error.clear();
    }
}

/// Where first world, second world and their difference go in `free`, all in the same size, with a line of
/// [`LABEL`] × `zoom` pixels over each: side by side, in two rows, or below each other, whatever shows them largest.
pub fn areas(free: Area, world: Vec2, zoom: f32) -> [Area; 3] {
    let (label, gap) = (LABEL * zoom, (GAP * zoom).max(2.0));
    let arrange = |columns: usize| {
        let rows = 3_usize.div_ceil(columns);
        let grid = Vec2::new(columns as f32, rows as f32);
        let cell = (free.max - free.min - gap * (grid - 1.0)) / grid;
        let size = cell - Vec2::new(0.0, label);
        let areas: [Area; 3] = std::array::from_fn(|k| {
            let in_row = if k / columns + 1 < rows { columns } else { 3 - (rows - 1) * columns };
            // A row that is not full stands in the middle.
            let indent = (columns - in_row) as f32 / 2.0;
            let place = Vec2::new((k % columns) as f32 + indent, (k / columns) as f32);
            let min = free.min + place * (cell + gap) + Vec2::new(0.0, label);
            Area { min, max: min + size }
        });
        ((size / world).min_element(), areas)
    };
    let all = [arrange(2), arrange(3), arrange(1)];
    let best = all.iter().max_by(|(a, _), (b, _)| a.total_cmp(b));
    best.map_or([free; 3], |(_, areas)| *areas)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free() -> Area {
        Area { min: Vec2::new(0.0, 44.0), max: Vec2::new(1280.0, 720.0) }
    }

    #[test]
    fn the_parts_are_alike_apart_and_inside() {
        for world in [Vec2::new(160.0, 90.0), Vec2::new(40.0, 200.0), Vec2::new(400.0, 30.0)] {
            let areas = areas(free(), world, 1.05);
            for (k, area) in areas.iter().enumerate() {
                let size = area.max - area.min;
                assert!((size - (areas[0].max - areas[0].min)).length() < 1e-2);
                assert!(size.min_element() > 100.0, "{world}: {area:?} is too small");
                let (min, max) = (free().min.y + LABEL, free().max + 0.1);
                assert!(area.min.y >= min && area.max.cmple(max).all(), "{world}: {area:?} sticks out");
                for other in &areas[k + 1..] {
                    let apart = area.max.x < other.min.x || area.max.y < other.min.y;
                    assert!(apart, "{world}: {area:?} covers {other:?}");
                }
            }
        }
    }

    #[test]
    fn wide_worlds_lie_below_each_other_and_tall_ones_stand_side_by_side() {
        let tall = areas(free(), Vec2::new(40.0, 200.0), 1.0);
        assert!(tall[0].min.y == tall[2].min.y, "{tall:?}");
        let wide = areas(free(), Vec2::new(400.0, 30.0), 1.0);
        assert!(wide[0].min.x == wide[2].min.x, "{wide:?}");
        let usual = areas(free(), Vec2::new(160.0, 90.0), 1.0);
        assert!(usual[0].min.y == usual[1].min.y && usual[2].min.y > usual[0].max.y, "{usual:?}");
        assert!((usual[2].min.x + usual[2].max.x - 1280.0).abs() < 1.0, "{usual:?}");
    }
}
