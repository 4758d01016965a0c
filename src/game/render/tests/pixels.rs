//! What is seen, as properties of pixels: of worlds as they begin, which stand. One picture serves all, as graphics take
//! seconds to be set up.

use super::graphics;
use crate::{
    game::{
        lens,
        render::{
            cost::PicturePass,
            extract::Pictures,
            features::Features,
            instances::ROW,
            level::Level,
            offscreen::{Offscreen, Pixels},
        },
        views::table::{ELEMENTS, TEMPERATURE, View},
    },
    kernel::{element::ElementId, particles::Particles},
    lab::{
        colours::Rgb,
        split::Split,
        vision::{KINDS, oklab},
    },
    scene::{self, effects::EffectModes},
    sim::{
        checkpoint::Checkpoint,
        state::{ParticleStore, Rock, Setup},
    },
};
use bevy::{
    prelude::{IntoScheduleConfigs, Res, ResMut, Resource},
    render::{Render, RenderSystems},
};
use glam::{IVec2, UVec2, Vec2};
use std::sync::Arc;

/// 10 pixels to a d in a box of 64 × 40 d, which the window has some room around.
const SIZE: UVec2 = UVec2::new(650, 406);

/// A world of these contents.
fn world(contents: &str) -> Checkpoint {
    let text = format!("(title: \"T\", description: \"D\", spacing: 0.1, size: (6.4, 4), contents: [{contents}])");
    let scene = scene::from_text("test", text).expect("the scene is sound");
    Checkpoint::of_scene(Arc::new(scene.build(&[], None, &EffectModes::new()).expect("its numbers are sound")))
}

struct Seen {
    picture: Offscreen,
}

impl Seen {
    fn show(&mut self, contents: &str) -> Pixels {
        self.show_at(contents, Level::Full, &ELEMENTS)
    }

    fn show_at(&mut self, contents: &str, level: Level, view: &'static View) -> Pixels {
        world(contents).restore(self.picture.world_mut());
        self.picture.show(view, level);
        // The first follows the new world, and bakes its rock.
        self.picture.frame();
        self.picture.pixels()
    }

    /// Colour at a point of the world in metres.
    fn at(&self, pixels: &Pixels, x: f32, y: f32) -> Rgb {
        pixels.at(self.picture.pixel_of(Vec2::new(x, y) * 10.0))
    }

    fn drawn(&self, pass: PicturePass) -> u32 {
        self.picture.drawn()[pass as usize]
    }
}

fn lab(colour: Rgb) -> [f32; 3] {
    oklab(colour, &KINDS[0].1)
}

/// How far the hues of two colours are apart, whatever their lightness.
fn hue_apart(a: Rgb, b: Rgb) -> f32 {
    let (a, b) = (lab(a), lab(b));
    (a[1] - b[1]).hypot(a[2] - b[2])
}

#[test]
fn the_picture_shows_what_is_there() {
    let Some(picture) = graphics(|| Offscreen::new(&world(""), SIZE)) else { return };
    let mut seen = Seen { picture };
    an_empty_box_is_no_black_hole(&mut seen);
    two_liquids_do_not_mix_their_colours(&mut seen);
    the_bulk_of_a_liquid_is_no_brighter_than_its_surface(&mut seen);
    nothing_shimmers_when_particles_are_sorted(&mut seen);
    light_falls_off_from_lava(&mut seen);
    what_is_not_there_is_not_drawn(&mut seen);
    more_than_a_row_of_numbers_is_drawn_where_it_is(&mut seen);
    plain_and_full_have_the_same_silhouettes(&mut seen);
    rock_is_where_it_is(&mut seen);
    rock_that_changes_is_baked_where_it_changed(&mut seen);
    the_lens_shows_the_second_world_inside_its_ring_and_nowhere_else(&mut seen);
    what_a_picture_lacks_is_left_out_without_a_trace(&mut seen);
}

fn an_empty_box_is_no_black_hole(seen: &mut Seen) {
    let pixels = seen.show("");
    let (top, bottom) = (lab(seen.at(&pixels, 3.2, 3.6))[0], lab(seen.at(&pixels, 3.2, 0.4))[0]);
    assert!(top > bottom && bottom > 0.2, "lightness {top} at the top, {bottom} at the bottom");
}

fn two_liquids_do_not_mix_their_colours(seen: &mut Seen) {
    let pixels = seen.show(
        r#"(element: "water", shape: Rect(min: (0, 0), max: (3.2, 2))), (element: "lava", shape: Rect(min: (3.2, 0), max: (6.4, 2)))"#,
    );
    // At one height: deeper is darker. 3 pixels to either side of the line are its own.
    let (water, lava) = (seen.at(&pixels, 1.0, 1.0), seen.at(&pixels, 5.4, 1.0));
    assert!(hue_apart(water, lava) > 0.1, "{water:?} {lava:?}");
    for k in 3..60 {
        let off = k as f32 * 0.01 + 0.005;
        let (left, right) = (seen.at(&pixels, 3.2 - off, 1.0), seen.at(&pixels, 3.2 + off, 1.0));
        let is = |colour, own, other| hue_apart(colour, own) < hue_apart(colour, other) / 2.0;
        assert!(is(left, water, lava) && is(right, lava, water), "{k} pixels off the line: {left:?} | {right:?}");
    }
}

fn the_bulk_of_a_liquid_is_no_brighter_than_its_surface(seen: &mut Seen) {
    let pixels = seen.show(r#"(element: "water", shape: Rect(min: (0, 0), max: (6.4, 2)))"#);
    let light = |x: f32, y: f32| lab(seen.at(&pixels, x, y))[0];
    let columns = || (10..54).map(|k| 0.1 * k as f32 + 0.03);
    let surface = columns().flat_map(|x| (0..5).map(move |k| light(x, 1.8 + 0.05 * k as f32))).fold(0.0, f32::max);
    let bulk = columns().flat_map(|x| (0..15).map(move |k| light(x, 0.2 + 0.1 * k as f32))).fold(0.0, f32::max);
    assert!(bulk < surface, "lightness {bulk} in the bulk, {surface} at the surface");
}

fn nothing_shimmers_when_particles_are_sorted(seen: &mut Seen) {
    let before = seen.show(
        r#"(element: "water", shape: Rect(min: (0, 0), max: (3.2, 1.5))), (element: "sand", shape: Rect(min: (3.2, 0), max: (5, 2))),
           (element: "steam", shape: Rect(min: (1, 2.5), max: (4, 3)))"#,
    );
    let store = &mut seen.picture.world_mut().resource_mut::<ParticleStore>().0;
    let mut turned = Particles::default();
    for i in (0..store.len()).rev() {
        turned.add(store.get(i));
    }
    *store = turned;
    let after = seen.picture.pixels();
    // What is blended in another order is rounded in another order: by up to a step of eight bits for each of the six discs over a
    // pixel. An edge makes more of it, in a pixel here and there; that surfaces or grains flicker is what must not be.
    let apart = |(a, b): (&Rgb, &Rgb)| (0..3).map(|k| a[k].abs_diff(b[k])).max().unwrap_or(0);
    let changed: Vec<u8> = before.all().iter().zip(after.all()).map(apart).filter(|step| *step > 6).collect();
    let (count, all) = (changed.len(), before.all().len());
    assert!(1000 * count < all, "{count} of {all} pixels changed, by up to {:?}", changed.iter().max());
}

fn light_falls_off_from_lava(seen: &mut Seen) {
    let rock = r#"(element: "rock", shape: Rect(min: (0, 0), max: (6.4, 1)))"#;
    let cold = seen.show(rock);
    let lit = seen.show(&format!(r#"{rock}, (element: "lava", shape: Rect(min: (0, 1), max: (0.8, 1.8)))"#));
    // Of the same stretch of rock: its grain and cracks are no light.
    let red = |pixels: &Pixels, from: f32| {
        let all = (0..8).flat_map(|k| (0..8).map(move |j| (from + 0.1 * k as f32, 0.1 + 0.1 * j as f32)));
        all.map(|(x, y)| f32::from(seen.at(pixels, x, y)[0])).sum::<f32>()
    };
    let [near, middle, far] = [0.9, 1.9, 5.0].map(|from| red(&lit, from) / red(&cold, from));
    assert!(
        near > 1.1 && near > middle && middle > far && far < 1.01,
        "{near} beside lava, {middle} further, {far} far off"
    );
}

fn what_is_not_there_is_not_drawn(seen: &mut Seen) {
    use PicturePass::{Bake, Bodies, Clouds, Gases, Grains, Rock, Streaks, Surface};
    seen.show("");
    for pass in [Bodies, Gases, Bake, Streaks, Surface, Grains, Rock, Clouds] {
        assert_eq!(seen.drawn(pass), 0, "{pass:?} of an empty box");
    }
    seen.show(r#"(element: "water", shape: Rect(min: (1, 0), max: (2, 1)))"#);
    assert!(
        seen.drawn(Bodies) == 100 + 10 && seen.drawn(Surface) > 0,
        "a hundred drops, ten with an image in the floor"
    );
    assert_eq!([Gases, Grains, Rock, Clouds].map(|pass| seen.drawn(pass)), [0; 4]);
    seen.show(r#"(element: "sand", shape: Rect(min: (1, 1), max: (2, 2))), (element: "smoke", shape: Rect(min: (3, 1), max: (4, 2)))"#);
    assert!(seen.drawn(Grains) == 100 && seen.drawn(Gases) == 100 && seen.drawn(Clouds) > 0);
    seen.show(r#"(element: "rock", shape: Rect(min: (1, 1), max: (2, 2)))"#);
    assert!(seen.drawn(Rock) > 0 && seen.drawn(Bake) == 0, "baked once, in the frame before");
}

fn more_than_a_row_of_numbers_is_drawn_where_it_is(seen: &mut Seen) {
    let pixels = seen.show(r#"(element: "water", shape: Rect(min: (0, 0), max: (6.4, 3.7)))"#);
    assert!(seen.drawn(PicturePass::Bodies) > ROW + 200, "{}", seen.drawn(PicturePass::Bodies));
    let (water, empty) = (seen.at(&pixels, 3.2, 1.0), seen.at(&pixels, 3.2, 3.95));
    for (x, y) in (0..31).flat_map(|x| (0..18).map(move |y| (0.1 + 0.2 * x as f32, 0.1 + 0.2 * y as f32))) {
        let there = seen.at(&pixels, x, y);
        assert!(hue_apart(there, water) < hue_apart(there, empty), "{there:?} at {x}, {y}");
    }
    assert!(hue_apart(empty, water) > 0.05, "{empty:?} above it");
}

fn plain_and_full_have_the_same_silhouettes(seen: &mut Seen) {
    let contents = r#"(element: "water", shape: Disc(centre: (2, 2), radius: 1)), (element: "sand", shape: Rect(min: (4, 0), max: (5.5, 2)))"#;
    // What differs from an empty box that is drawn in the same way.
    let [full, plain] = [Level::Full, Level::Plain].map(|level| {
        let empty = seen.show_at("", level, &ELEMENTS);
        let pixels = seen.show_at(contents, level, &ELEMENTS);
        let is_matter = |(shown, empty): (&Rgb, &Rgb)| {
            let (a, b) = (lab(*shown), lab(*empty));
            (0..3).map(|c| (a[c] - b[c]).abs()).sum::<f32>() > 0.08
        };
        pixels.all().iter().zip(empty.all()).map(is_matter).collect::<Vec<bool>>()
    });
    let count = full.len();
    let other = full.iter().zip(&plain).filter(|(a, b)| a != b).count();
    let matter = full.iter().filter(|is_matter| **is_matter).count();
    assert!(matter > count / 10 && other * 100 < count, "{other} of {count} pixels differ, {matter} show matter");
}

fn rock_is_where_it_is(seen: &mut Seen) {
    let contents = r#"(element: "rock", shape: Rect(min: (2, 1), max: (4, 2)))"#;
    for view in [&ELEMENTS, &TEMPERATURE] {
        let empty = seen.show_at("", Level::Full, view);
        let pixels = seen.show_at(contents, Level::Full, view);
        let is_rock = |x: f32, y: f32| seen.at(&pixels, x, y) != seen.at(&empty, x, y);
        // Its picture is within a third of a d of its body.
        for (x, y, there) in [
            (3.0, 1.5, true),
            (2.04, 1.5, true),
            (3.96, 1.5, true),
            (3.0, 1.04, true),
            (3.0, 1.96, true),
            (1.96, 1.5, false),
            (4.04, 1.5, false),
            (3.0, 0.96, false),
            (3.0, 2.04, false),
        ] {
            assert_eq!(is_rock(x, y), there, "{view:?}: at {x}, {y}");
        }
    }
}

fn rock_that_changes_is_baked_where_it_changed(seen: &mut Seen) {
    seen.show(r#"(element: "rock", shape: Rect(min: (1, 1), max: (5, 3)))"#);
    let all = seen.drawn(PicturePass::Rock);
    let mut rock = seen.picture.world_mut().resource_mut::<Rock>();
    assert!(rock.remove(IVec2::new(20, 29)) && rock.remove(IVec2::new(49, 10)));
    assert!(rock.insert(IVec2::new(45, 32), ElementId(0), 1));
    seen.picture.frame();
    let some = seen.drawn(PicturePass::Bake);
    assert!(0 < some && some < all, "{some} of {all} tiles are baked");
    let changed = seen.picture.pixels();
    assert_eq!(seen.drawn(PicturePass::Bake), 0, "nothing changed since");
    // A view with colours of its own lets all of it be baked.
    seen.picture.show(&TEMPERATURE, Level::Full);
    seen.picture.frame();
    seen.picture.show(&ELEMENTS, Level::Full);
    seen.picture.frame();
    assert!(seen.drawn(PicturePass::Bake) >= all);
    assert!(seen.picture.pixels() == changed);
}

fn the_lens_shows_the_second_world_inside_its_ring_and_nowhere_else(seen: &mut Seen) {
    let contents = r#"(element: "water", shape: Rect(min: (1, 0.5), max: (5.4, 3.5)))"#;
    let other = |a: &Pixels, b: &Pixels| {
        let apart = |(a, b): (&Rgb, &Rgb)| (0..3).any(|k| a[k].abs_diff(b[k]) > 6);
        a.all().iter().zip(b.all()).map(apart).collect::<Vec<bool>>()
    };
    for level in [Level::Full, Level::Plain] {
        let alone = seen.show_at(contents, level, &ELEMENTS);
        let world = seen.picture.world_mut();
        lens::toggle(world);
        let Setup { preset, quality, .. } = *world.resource::<Setup>();
        Split::begin(world, preset, quality).expect("it fits");
        let equal = seen.picture.pixels();
        assert_eq!(seen.drawn(PicturePass::Lens), 1);
        let changed = other(&alone, &equal).into_iter().filter(|other| *other).count();
        assert!(1000 * changed < alone.all().len(), "{changed} pixels show a difference of equal worlds at {level:?}");
        let world = seen.picture.world_mut();
        let mut split = world.resource_mut::<Split>();
        split.world_mut().expect("it is on").resource_mut::<ParticleStore>().0 = Particles::default();
        let ring = world.resource::<lens::Lens>().ring(world.resource()).expect("it is taken up");
        let through = seen.picture.pixels();
        let far =
            |k: usize| (Vec2::new((k as u32 % SIZE.x) as f32, (k as u32 / SIZE.x) as f32) + 0.5).distance(ring.centre);
        // A pixel of the plain picture is two wide, and is smoothed with the next.
        let (mut inside, mut outside) = (0, 0);
        for (k, other) in other(&equal, &through).into_iter().enumerate() {
            inside += u32::from(!other && far(k) < ring.radius - 4.0);
            outside += u32::from(other && far(k) > ring.radius + 4.0);
        }
        // The ring lies all over the water.
        assert_eq!(
            (inside, outside),
            (0, 0),
            "pixels inside that are as before, and outside that are not, at {level:?}"
        );
        assert!(lens::lay_down(seen.picture.world_mut()));
        seen.picture.frame();
        assert_eq!(seen.drawn(PicturePass::Lens), 0);
    }
}

/// Features that pictures are taken to have, beside those that they have.
#[derive(Resource)]
struct Taken(Features);

fn take(taken: Res<Taken>, mut pictures: ResMut<Pictures>) {
    pictures.shown_mut().iter_mut().for_each(|picture| picture.features = picture.features.or(taken.0));
}

fn what_a_picture_lacks_is_left_out_without_a_trace(seen: &mut Seen) {
    // No air in sight, nothing that glows, one liquid.
    let contents = r#"(element: "water", shape: Rect(min: (0, 0), max: (3.2, 1.5))), (element: "steam", shape: Rect(min: (1, 2.5), max: (4, 3))),
                      (element: "rock", shape: Rect(min: (5, 0), max: (6, 3)))"#;
    let all = Features::AIR.or(Features::GLOW).or(Features::MORE);
    seen.picture
        .render_app_mut()
        .insert_resource(Taken(Features::default()))
        .add_systems(Render, take.in_set(RenderSystems::Queue));
    for level in [Level::Full, Level::Plain] {
        for view in [&ELEMENTS, &TEMPERATURE] {
            let mut drawn = |features| {
                seen.picture.render_app_mut().insert_resource(Taken(features));
                seen.show_at(contents, level, view);
                seen.picture.wait_for_pipelines();
                let pixels = seen.picture.pixels();
                (seen.picture.render_app_mut().world().resource::<Pictures>().shown()[0].features, pixels)
            };
            let ((lean, without), (full, with)) = (drawn(Features::default()), drawn(all));
            assert_ne!(lean, full, "a picture that has all proves nothing");
            // Backdrop, surface, clouds and rock each round once.
            let apart = |(a, b): (&Rgb, &Rgb)| (0..3).map(|k| a[k].abs_diff(b[k])).max().unwrap_or(0);
            let most = without.all().iter().zip(with.all()).map(apart).max().unwrap_or(0);
            assert!(most <= 4, "{lean:?} and {full:?} are {most} of 255 apart at {level:?}, {view:?}");
        }
    }
}
