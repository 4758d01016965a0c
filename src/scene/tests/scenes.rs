//! What the fields of a scene file do.

use super::{build, read, scene, settings};
use crate::{
    kernel::{params::*, sources::Rect},
    scene::{
        blueprint::PressurePatch,
        effects::{Effect, EffectModes, Mode},
        image::tests::png,
    },
};
use glam::{IVec2, Vec2};

#[test]
fn what_is_not_given_has_its_default() {
    let world = build(&scene("")).expect("a box");
    assert_eq!((world.name.as_str(), world.title.as_str()), ("test", "Test"));
    assert_eq!(world.domain.size, Vec2::new(10.0, 8.0));
    assert_eq!(world.domain.gravity, Vec2::new(0.0, -19.62));
    assert_eq!(world.fluid, FluidParams::default());
    assert_eq!(world.air, AirParams { sound_speed: 80.0, density: AIR_DENSITY, open: OpenSides::default() });
    assert_eq!((world.quality, world.particle_limit, world.next_id), (Preset::Balanced.quality(), 200_000, 0));
    assert!(world.effects.is_empty() && world.first_element.is_none());
}

#[test]
fn later_placements_fill_gaps_unless_they_replace() {
    let rock = "(element: \"rock\", shape: Rect(min: (0, 0), max: (1, 0.5)))";
    let water = |replace: &str| {
        format!("(element: \"water\", shape: Rect(min: (0, 0), max: (2, 0.5)), velocity: (1, \"2 * d\"){replace})")
    };
    let world = build(&scene(&format!("contents: [{rock}, {}]", water("")))).expect("rock, then water");
    assert_eq!((world.solids.count(), world.particles.len()), (2, 2));
    assert_eq!(world.solids.get(IVec2::new(1, 0)).map(|(_, id)| id), Some(1));
    assert_eq!((world.particles.position(0), world.particles.id[0]), (Vec2::new(2.5, 0.5), 2));
    assert_eq!(world.particles.velocity(0), Vec2::new(2.0, 2.0));
    let world = build(&scene(&format!("contents: [{rock}, {}]", water(", replace: true")))).expect("water for rock");
    assert_eq!((world.solids.count(), world.particles.len(), world.next_id), (0, 4, 4));
    let none = "(element: \"none\", shape: Rect(min: (0.5, 0), max: (9, 9)))";
    let world = build(&scene(&format!("contents: [{rock}, {}, {none}]", water("")))).expect("all but one erased");
    assert_eq!((world.solids.count(), world.particles.len(), world.next_id), (1, 0, 1));
}

#[test]
fn rock_covers_a_cut_cell_and_water_stays_out_of_it() {
    let text = |element: &str| {
        let contents = format!("contents: [(element: \"{element}\", shape: Rect(min: (-9, -9), max: (9, 9)))]");
        scene(&contents).replace("(5, 4)", "(5.3, 4)")
    };
    assert_eq!(build(&text("rock")).expect("rock").solids.count(), 11 * 8);
    assert_eq!(build(&text("water")).expect("water").particles.len(), 10 * 8);
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn pictures_lie_beside_their_scene() {
    let folder = std::env::temp_dir().join(format!("powder-master-picture-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("dot.png"), png(png::ColorType::Grayscale, 2, &[0, 255, 255, 255])).expect("a picture");
    let contents = "contents: [(element: \"rock\", shape: Image(file: \"dot.png\", min: (1, 1), max: (3, 3)))]";
    let path = folder.join("picture.ron");
    std::fs::write(&path, scene(contents)).expect("a scene");
    let file = crate::scene::load(path.to_str().expect("a plain path")).expect("a scene");
    let world = file.build(&[], None, &EffectModes::new()).expect("a scene");
    assert_eq!((world.name.as_str(), world.solids.count()), ("picture", 4));
    assert!(world.solids.is_solid(IVec2::new(2, 5)) && !world.solids.is_solid(IVec2::new(4, 5)));
    std::fs::remove_file(folder.join("dot.png")).expect("the picture");
    let error = file.build(&[], None, &EffectModes::new()).expect_err("no picture").to_string();
    assert!(error.ends_with("contents[0].image.file: `dot.png`: no such file"), "{error}");
    // A few kilobytes that ask for gigabytes.
    let huge = png(png::ColorType::Grayscale, 4096, &vec![255; 4096 * 4096]);
    assert!(huge.len() < 100_000);
    std::fs::write(folder.join("dot.png"), huge).expect("a picture");
    let picture = "(element: \"rock\", shape: Image(file: \"dot.png\", min: (1, 1), max: (3, 3)))";
    std::fs::write(&path, scene(&format!("contents: [{}]", [picture; 9].join(", ")))).expect("a scene");
    let file = crate::scene::load(path.to_str().expect("a plain path")).expect("a scene");
    let error = file.build(&[], None, &EffectModes::new()).expect_err("too many pixels").to_string();
    assert!(error.contains("contents[4].image: the pictures up to it have 83886080 pixels; allowed"), "{error}");
    std::fs::remove_dir_all(folder).expect("the folder");
}

#[test]
fn flows_come_out_in_spacings_and_ticks() {
    let world = build(&scene(
        "emitters: [(element: \"water\", min: (-1, 1), max: (1, 2), velocity: (1, 0), rate: 30, total: 7, start: 0.5)],
         winds: [(min: (1, 1), max: (2, 20), velocity: (3, -1), rate: 2)],
         drains: [(min: (4, -3), max: (9, 1))],
         pressures: [(min: (1, 1), max: (2, 2), pressure: 1.5),
             (min: (1, 1), max: (2, 2), pressure: 1, temperature: \"2 * 300\")],
         open: (top: true), sound_speed: 10, first_element: \"rock\"",
    ))
    .expect("flows");
    let rect = |x0, y0, x1, y1| Rect { min: Vec2::new(x0, y0), max: Vec2::new(x1, y1) };
    let emitter = &world.emitters[0];
    assert_eq!((emitter.area, emitter.velocity), (rect(0.0, 2.0, 2.0, 4.0), Vec2::new(2.0, 0.0)));
    assert_eq!((emitter.rate, emitter.total, emitter.start, emitter.given), (30.0, Some(7), 30, 0));
    assert_eq!((world.winds[0].area, world.winds[0].velocity), (rect(2.0, 2.0, 4.0, 8.0), Vec2::new(6.0, -2.0)));
    assert_eq!(world.drains[0].area, rect(8.0, -1.0, 11.0, 2.0));
    let patch = |pressure, kelvin| PressurePatch { area: rect(2.0, 2.0, 4.0, 4.0), pressure, kelvin };
    assert_eq!(world.pressures, [patch(1.5, 293.0), patch(1.0, 600.0)]);
    assert_eq!(
        world.air,
        AirParams { sound_speed: 20.0, density: AIR_DENSITY, open: OpenSides { top: true, ..Default::default() } }
    );
    assert_eq!(world.first_element.as_deref(), Some("rock"));
}

#[test]
fn the_command_line_counts_more_than_the_scene_and_the_scene_more_than_the_preset() {
    let file = read(
        scene(
            "parameters: {\"n\": (default: 3, min: 1, max: 9, integer: true, description: \"\")},
             quality: (preset: fine, substeps: \"2 * n\", gradient: spiky), fluid: (relaxation: 0.5),
             effects: {air: off, drag: on}, particle_limit: 5000",
        )
        .as_bytes(),
    )
    .expect("a scene");
    let world = file.build(&[], None, &EffectModes::new()).expect("a scene");
    let expected = Quality { substeps: 6, gradient: GradientKernel::Spiky, ..Preset::Fine.quality() };
    assert_eq!((world.preset, world.quality, world.particle_limit), (Preset::Fine, expected, 5000));
    let set =
        settings(&[("n", "4"), ("iterations", "9"), ("gradient", "rational"), ("rest_density", "0.5"), ("n", "5")]);
    let effects = EffectModes::from([(Effect::Drag, Mode::Auto), (Effect::Tension, Mode::Off)]);
    let world = file.build(&set, Some(Preset::Draft), &effects).expect("a scene");
    let expected = Quality { substeps: 10, iterations: 9, ..Preset::Draft.quality() };
    assert_eq!((world.preset, world.quality), (Preset::Draft, expected));
    assert_eq!((world.fluid.rest_density, world.fluid.relaxation), (0.5, 0.5));
    let modes = [(Effect::Air, Mode::Off), (Effect::Drag, Mode::Auto), (Effect::Tension, Mode::Off)];
    assert_eq!(world.effects, EffectModes::from(modes));
}
