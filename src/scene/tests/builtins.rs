//! Every scene in the binary is what its comment and its users say.

use super::settings;
use crate::{
    kernel::{params::Preset, solids::Solids},
    scene::{
        blueprint::Blueprint,
        builtin_names,
        effects::{Effect, EffectModes, Mode},
        load,
    },
};
use glam::Vec2;

fn built(name: &str, pairs: &[(&str, &str)]) -> Blueprint {
    let file = load(name).expect(name);
    file.build(&settings(pairs), None, &EffectModes::new()).expect(name)
}

#[test]
fn the_list_is_complete_and_starts_with_the_default() {
    let names = [
        "waterfall",
        "acid",
        "avalanche",
        "burning_house",
        "campfire",
        "communicating_vessels",
        "dam_break",
        "distillery",
        "dune",
        "dust_mill",
        "ember_rain",
        "empty",
        "fireworks",
        "fountain",
        "frozen_lake",
        "galton_board",
        "garden",
        "geyser",
        "honey_and_mercury",
        "honey_lamp",
        "hourglass",
        "hydrostatic",
        "ice_dam",
        "layers",
        "mercury_maze",
        "oil_lamp",
        "rest_density",
        "sand_castle",
        "sealed_air",
        "silo",
        "snow_globe",
        "u_tube",
        "volcano",
        "wind_tunnel",
        "winter",
    ];
    assert_eq!(builtin_names(), names);
}

#[test]
fn every_scene_builds_at_the_ends_of_its_parameters() {
    for name in builtin_names() {
        let file = load(name).expect(name);
        assert!(!file.title().is_empty() && !file.description().is_empty(), "{name} has no text for the menu");
        for (key, spec) in file.parameters() {
            for value in [spec.min, spec.default, spec.max] {
                let result = file.build(&settings(&[(key, &value.to_string())]), None, &EffectModes::new());
                let too_many = result.as_ref().is_err_and(|error| error.to_string().contains("particle_limit"));
                assert!(result.is_ok() || too_many, "{name} with {key}={value}: {result:?}");
            }
        }
    }
}

#[test]
fn what_stands_in_a_scene_is_in_the_box_and_has_its_own_site_and_id() {
    for name in builtin_names() {
        let world = built(name, &[]);
        let size = world.domain.size;
        assert_eq!((world.solids.columns(), world.solids.rows()), (size.x.ceil() as i32, size.y.ceil() as i32));
        let mut ids: Vec<u32> =
            world.particles.id.iter().copied().chain(world.solids.iter().map(|rock| rock.2)).collect();
        ids.sort_unstable();
        assert!(ids.iter().copied().eq(0..world.next_id), "{name}: ids from 0 without a gap");
        let mut seen = std::collections::BTreeSet::new();
        for i in 0..world.particles.len() {
            let place = world.particles.position(i);
            let cell = Solids::cell_of(place);
            assert!(
                place.cmpge(Vec2::splat(0.5)).all() && place.cmple(size - 0.499).all(),
                "{name}: {place} is outside"
            );
            assert!(!world.solids.is_solid(cell), "{name}: a particle in rock");
            assert!(seen.insert((cell.x, cell.y)), "{name}: two particles at {place}");
        }
    }
}

#[test]
fn dam_break_is_the_lattice_that_other_programs_are_compared_on() {
    let world = built("dam_break", &[]);
    assert_eq!(world.particles.len(), 10_082);
    assert_eq!(world.domain.size, Vec2::new(284.0, 149.1));
    assert_eq!(world.domain.gravity, Vec2::new(0.0, -98.1));
    assert_eq!((world.scale.spacing, world.solids.count(), world.next_id), (0.1, 0, 10_082));
    for i in 0..world.particles.len() {
        let site = Vec2::new((i % 71) as f32 + 0.5, (i / 71) as f32 + 0.5);
        assert_eq!((world.particles.position(i), world.particles.velocity(i)), (site, Vec2::ZERO));
        assert_eq!(world.particles.id[i], i as u32);
    }
    let off = [Effect::Air, Effect::Drag, Effect::Tension, Effect::Viscosity, Effect::Vorticity];
    assert_eq!(
        world.effects,
        EffectModes::from(off.map(|effect| (effect, Mode::Off))),
        "the bare liquid: nothing but the constraint, the predictor where the quality has it, and sleep once it rests"
    );
    assert_eq!((world.preset, world.quality), (Preset::Balanced, Preset::Balanced.quality()));
    for columns in [2, 3, 224, 500] {
        let world = built("dam_break", &[("columns", &columns.to_string())]);
        assert_eq!(world.particles.len(), 2 * columns * columns);
        assert_eq!(world.domain.size, Vec2::new(4.0 * columns as f32, (2.1 * columns as f64) as f32));
        assert_eq!(world.parameters["columns"], columns as f64);
    }
}

#[test]
fn tanks_hold_what_their_parameters_say() {
    let world = built("hydrostatic", &[("columns", "30"), ("depth", "12")]);
    assert_eq!((world.particles.len(), world.domain.size), (360, Vec2::new(30.0, 22.0)));
    let level = |pairs: &[_]| {
        let world = built("communicating_vessels", pairs);
        let rows = |left: bool| {
            let sites = (0..world.particles.len()).map(|i| world.particles.position(i));
            sites.filter(|site| (site.x < 70.0) == left).map(|site| (site.y + 0.5) as i32).max()
        };
        (rows(true), rows(false))
    };
    assert_eq!(level(&[]), (Some(50), Some(15)));
    assert_eq!(level(&[("left", "2"), ("right", "6")]), (Some(20), Some(60)));
}

#[test]
fn rest_density_pours_300_particles_and_turns_the_knob() {
    let world = built("rest_density", &[("ratio", "16.5")]);
    assert_eq!((world.particles.len(), world.fluid.rest_density), (0, 16.5));
    assert_eq!(world.emitters.len(), 1);
    let area = world.emitters[0].area;
    assert_eq!((world.emitters[0].total, area.min.x, area.max.y), (Some(300), 0.0, world.domain.size.y));
}

#[test]
fn moving_air_has_where_to_come_from() {
    let tunnel = built("wind_tunnel", &[("wind", "12")]);
    assert!(tunnel.air.open.left && tunnel.air.open.right && !tunnel.air.open.top && !tunnel.air.open.bottom);
    assert_eq!((tunnel.domain.gravity, tunnel.winds[0].velocity), (Vec2::ZERO, Vec2::new(120.0, 0.0)));
    assert!(tunnel.solids.count() > 0 && !tunnel.emitters.is_empty() && !tunnel.drains.is_empty());
    let sealed = built("sealed_air", &[]);
    assert_eq!((sealed.pressures.len(), sealed.pressures[0].pressure, sealed.air.open), (1, 1.3, Default::default()));
    assert!(sealed.solids.count() > 0 && !sealed.particles.is_empty() && sealed.emitters.is_empty());
}

#[test]
fn the_waterfall_has_all_it_takes_to_run_for_ever() {
    let world = built("waterfall", &[]);
    assert!((5_000..12_000).contains(&world.particles.len()), "{} particles", world.particles.len());
    assert!(!world.emitters.is_empty() && !world.drains.is_empty() && !world.winds.is_empty());
    let mouth = world.emitters[0].area;
    let reach = |from: f32, to: f32| (from as i32..to as i32).collect::<Vec<_>>();
    for y in reach(mouth.min.y, mouth.max.y) {
        for x in reach(mouth.min.x, mouth.max.x) {
            assert!(!world.solids.is_solid(glam::IVec2::new(x, y)), "rock in the spring's mouth");
        }
    }
}
