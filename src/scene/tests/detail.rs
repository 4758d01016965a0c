//! A scene at another detail is the same scene of finer or coarser particles.

use super::{read, scene, settings};
use crate::{
    kernel::{element::ElementParams, params::Preset},
    scene::{blueprint::Blueprint, effects::EffectModes, error::SceneError, load},
};
use glam::Vec2;

fn at(text: &str, detail: f64) -> Result<Blueprint, SceneError> {
    read(text.as_bytes())?.at_detail(detail).build(&[], None, &EffectModes::new())
}

fn built(name: &str, detail: f64, pairs: &[(&str, &str)], preset: Option<Preset>) -> Blueprint {
    let scene = load(name).expect(name).at_detail(detail);
    scene.build(&settings(pairs), preset, &EffectModes::new()).expect(name)
}

#[test]
fn the_dam_break_at_twice_the_detail_is_that_of_twice_the_columns_at_half_the_size() {
    let (fine, large) = (built("dam_break", 2.0, &[], None), built("dam_break", 1.0, &[("columns", "142")], None));
    assert_eq!((fine.scale.spacing, fine.scale.detail, large.scale.detail), (0.05, 2.0, 1.0));
    assert_eq!((fine.particles.len(), fine.domain.size), (4 * 10_082, large.domain.size));
    assert_eq!((&fine.particles.x, &fine.particles.y), (&large.particles.x, &large.particles.y));
    assert_eq!((&fine.particles.id, fine.next_id), (&large.particles.id, large.next_id));
    // The same 9.81 m/s² in the finer spacings, and the same knobs: they are in d.
    assert_eq!(fine.domain.gravity, 2.0 * large.domain.gravity);
    assert_eq!((fine.quality, fine.fluid, fine.particle_limit), (large.quality, large.fluid, large.particle_limit));
}

#[test]
fn what_is_physical_keeps_its_metres_and_what_is_counted_its_matter() {
    let text = scene(
        "contents: [(element: \"water\", shape: Rect(min: (\"2 * d\", 0), max: (3, 2)), velocity: (1, 0))],
         emitters: [(element: \"water\", min: (1, 3), max: (2, 4), velocity: (0, -3), rate: 30.5, total: 7)],
         winds: [(min: (1, 1), max: (2, 4), velocity: (3, -1), rate: 2)],
         drains: [(min: (4, -3), max: (9, 1))], pressures: [(min: (1, 1), max: (2, 2), pressure: 1.5)],
         particle_limit: 5000",
    );
    let own = at(&text, 1.0).expect("the scene");
    let area = |world: &Blueprint| world.particles.len() as f32 * world.scale.spacing * world.scale.spacing;
    for detail in [0.5, 2.0, 4.0] {
        let world = at(&text, detail).expect("a box of whole cells");
        let (scale, finer) = (world.scale, detail as f32);
        assert_eq!((scale.detail, scale.own_spacing(), scale.spacing * finer), (finer, 0.5, 0.5));
        assert_eq!((world.domain.size, world.domain.gravity), (finer * own.domain.size, finer * own.domain.gravity));
        assert_eq!(area(&world), area(&own), "d in an expression is the scene's own spacing");
        assert_eq!(world.particles.velocity(0), finer * own.particles.velocity(0));
        let (tap, own_tap) = (&world.emitters[0], &own.emitters[0]);
        assert_eq!((tap.area.min, tap.velocity), (finer * own_tap.area.min, finer * own_tap.velocity));
        assert_eq!((tap.rate, tap.start), (finer * finer * own_tap.rate, own_tap.start));
        let total = (7.0 * finer * finer).round() as u32;
        assert_eq!((tap.total, world.particle_limit), (Some(total), 5000));
        assert_eq!(world.most_particles(), (5000.0 * finer * finer) as u32);
        assert_eq!((world.winds[0].velocity, world.winds[0].rate), (finer * own.winds[0].velocity, own.winds[0].rate));
        assert_eq!(world.pressures[0].area.max, finer * own.pressures[0].area.max);
        // A drain reaches past the box by a spacing of the run.
        assert_eq!(world.drains[0].area.min, Vec2::new(4.0 / scale.spacing, -1.0));
        assert_eq!((world.air.sound_speed, world.air.density), (finer * own.air.sound_speed, own.air.density));
        assert_eq!((world.quality, world.fluid), (own.quality, own.fluid), "resolution goes with the spacing");
    }
}

/// Elements keep their behaviour in SI units: `k` of the drag in 1/m, kinematic viscosity ∝ c d², confinement in m/s.
#[test]
fn elements_are_the_same_matter_at_every_detail() {
    let si = |detail: f64| {
        let world = built("waterfall", detail, &[], None);
        let (of, d) = (ElementParams::new(&world.elements, world.scale, world.air.density), world.scale.spacing);
        let water = world.elements.find("water").expect("water").index();
        [of.drag[water] / d, of.viscosity[water] * d * d, of.vorticity[water] * d, of.mass[water]]
    };
    let own = si(1.0);
    for detail in [0.5, 1.3, 2.0] {
        for (value, expected) in si(detail).into_iter().zip(own) {
            // Rounding of six operations in f32.
            assert!((value / expected - 1.0).abs() < 1e-6, "{value} at {detail}, {expected} at 1");
        }
    }
}

#[test]
fn boxes_need_not_come_to_whole_cells() {
    let text = scene("contents: [(element: \"water\", shape: Rect(min: (0, 0), max: (5, 4)))]");
    for detail in [0.7, 1.1, 1.37, 3.3] {
        let world = at(&text, detail).expect("a box with cut cells");
        let size = Vec2::new(10.0, 8.0) * detail as f32;
        // A size is rounded to a millionth of a cell, so that "4 * columns * d" comes to whole ones.
        assert!(world.domain.size.distance(size) < 1e-5, "{}", world.domain.size);
        let whole = size.as_dvec2().floor();
        assert_eq!(world.particles.len(), (whole.x * whole.y) as usize, "liquid stands on the whole cells");
        assert_eq!(world.solids.columns(), size.x.ceil() as i32);
    }
}

#[test]
fn the_preset_brings_its_own_detail_on_top() {
    let reference = built("dam_break", 1.0, &[], Some(Preset::Reference));
    assert_eq!((reference.scale.detail, reference.particles.len()), (2.0, 4 * 10_082));
    assert_eq!(reference.quality, Preset::Fine.quality(), "`fine` at twice the detail");
    let both = built("dam_break", 0.5, &[("columns", "70")], Some(Preset::Reference));
    assert_eq!((both.scale.detail, both.particles.len()), (1.0, 2 * 70 * 70));
    assert!(Preset::ALL.iter().all(|preset| preset.detail() == 1.0 || *preset == Preset::Reference));
}

#[test]
fn a_detail_that_does_not_fit_is_one_clear_line() {
    let error = |text: &str, detail: f64| {
        let error = at(text, detail).expect_err("must be refused").to_string();
        assert_eq!(error.lines().count(), 1, "{error}");
        error
    };
    let full = scene("contents: [(element: \"water\", shape: Rect(min: (0, 0), max: (5, 4)))], particle_limit: 50");
    // 80 particles in a limit of 50 of the scene's own spacing: at any detail the same share.
    for detail in [1.0, 2.0] {
        let count = 80.0 * detail * detail;
        let start = format!("test.ron: contents: {count} particles, but particle_limit is {}", 50.0 * detail * detail);
        assert!(error(&full, detail).starts_with(&start), "{}", error(&full, detail));
    }
    for bad in [0.0, 0.1, 8.1, -1.0, f64::NAN, f64::INFINITY] {
        assert!(error(&scene(""), bad).contains("detail:"), "{bad}: {}", error(&scene(""), bad));
        assert!(error(&scene(""), bad).ends_with("allowed: 0.125 to 8"));
    }
    assert!(error(&scene(""), 0.4).contains("size.y: in spacings of 1.25 m, 3.2 is out of range; allowed: 4 to 32768"));
    let wide = "(title: \"x\", spacing: 1, size: (8000, 5000))";
    assert!(at(wide, 1.0).is_ok());
    assert!(error(wide, 2.0).contains("16000 × 10000 cells of 0.5 m; allowed: at most 64000000 cells"));
    // What no world may hold is not allowed by a scene's limit times detail² either.
    let most = at("(title: \"x\", spacing: 1, size: (8, 8), particle_limit: 4000000)", 2.0).expect("a box");
    assert_eq!(most.most_particles(), 4_000_000);
    let tap = |detail| at(&scene("emitters: [(element: \"water\", min: (1, 1), max: (2, 2), rate: 1)]"), detail);
    assert!(tap(1.0).is_ok() && tap(8.0).is_ok());
}
