//! How matter is packed.

use crate::{
    game::render::{
        body::{BodyMap, CELL},
        glow::Warmth,
        look::Looks,
        matter::{LIQUIDS, Matter, Sample},
        moved::Moved,
        rock::RockMap,
    },
    kernel::{
        element::{ElementId, ElementTable},
        heat::table::HeatTable,
        particles::Particles,
        solids::{Solids, centre},
    },
    scene::elements,
};
use glam::{IVec2, Vec2};
use std::sync::Arc;

/// Side of the box, d.
const SIDE: f32 = 40.0;

struct Rig {
    table: Arc<ElementTable>,
    curves: HeatTable,
    looks: Looks,
    rock: Solids,
}

impl Rig {
    fn new() -> Self {
        let table = elements().expect("the elements");
        let curves = HeatTable::new(&table);
        let looks = Looks::new(&table, &curves);
        Self { table, curves, looks, rock: Solids::new(SIDE as u32, SIDE as u32) }
    }

    fn find(&self, name: &str) -> ElementId {
        self.table.find(name).expect(name)
    }

    /// A row of these in the middle of the box, 2 d apart, each as it comes.
    fn row(&self, names: &[&str]) -> Particles {
        let mut particles = Particles::default();
        for (k, name) in names.iter().enumerate() {
            let (element, at) = (self.find(name), Vec2::new(4.0 + 2.0 * k as f32, 20.0));
            particles.push_warm(k as u32, element, at, Vec2::ZERO, self.curves.spawn_heat(element));
        }
        particles
    }

    fn pack(&self, particles: &Particles, fine: bool) -> Matter {
        let size = Vec2::splat(SIDE);
        let (mut matter, mut body) = (Matter::default(), BodyMap::default());
        body.follow_rock(size, &self.rock, true);
        body.measure(0.1, particles, &self.looks, 0);
        let warmth = Warmth { particles, rock: &[], curves: &self.curves, looks: &self.looks };
        let (rock, looks, moved) = (&RockMap::default(), &self.looks, &Moved::default());
        let (radii, back) = ([1.35, 4.2], 0.0);
        matter.fill(Sample { particles, rock, looks, moved, body: &body, warmth, size, radii, back, fine });
        matter
    }
}

#[test]
fn each_kind_of_matter_is_drawn_in_its_own_way() {
    let rig = Rig::new();
    let matter = rig.pack(&rig.row(&["water", "sand", "steam", "oil"]), true);
    assert_eq!([matter.bodies.len(), matter.more.len(), matter.grains.len(), matter.gases.len()], [3, 0, 1, 1]);
    assert_eq!(matter.colours(), [rig.table.get(rig.find("water")).colour, rig.table.get(rig.find("oil")).colour]);
    let channels: Vec<u8> = matter.bodies.iter().map(|body| body[2].to_le_bytes()[0]).collect();
    assert_eq!(channels, [1, 0, 2], "water, powder, oil");
    assert_eq!(rig.pack(&rig.row(&["sand"]), false).grains.len(), 0, "too small to be seen one by one");
}

#[test]
fn as_many_liquids_as_channels_keep_apart_and_more_go_with_what_looks_like_them() {
    let rig = Rig::new();
    let mut names = vec!["water", "brine", "oil", "honey", "mercury", "tar"];
    let matter = rig.pack(&rig.row(&names), true);
    assert_eq!((matter.colours().len(), matter.bodies.len(), matter.more.len()), (LIQUIDS, 2, 4));
    // Two of each but one of acid: it is the rarest.
    names = names.repeat(2);
    names.push("acid");
    let matter = rig.pack(&rig.row(&names), true);
    assert_eq!(matter.colours().len(), LIQUIDS);
    assert_eq!(matter.bodies.len() + matter.more.len(), 13);
    assert!(!matter.colours().contains(&rig.table.get(rig.find("acid")).colour));
}

#[test]
fn what_is_drawn_does_not_depend_on_the_order_of_the_particles() {
    let rig = Rig::new();
    let names = ["water", "sand", "steam", "oil", "lava", "ember", "snow", "acid"];
    let particles = rig.row(&names);
    let mut turned = Particles::default();
    for i in (0..particles.len()).rev() {
        turned.add(particles.get(i));
    }
    let all = |particles: &Particles| {
        let matter = rig.pack(particles, true);
        [&matter.bodies, &matter.more, &matter.grains, &matter.gases].map(|buffer| {
            let mut values = buffer.clone();
            values.sort_unstable();
            values
        })
    };
    assert_eq!(all(&particles), all(&turned));
}

#[test]
fn matter_at_a_wall_has_an_image_behind_it() {
    let rig = Rig::new();
    let mut particles = Particles::default();
    let water = rig.find("water");
    for (id, at) in [Vec2::new(0.5, 20.0), Vec2::new(0.5, 39.5), Vec2::splat(20.0)].into_iter().enumerate() {
        particles.push(id as u32, water, at, Vec2::ZERO);
    }
    let matter = rig.pack(&particles, true);
    let places: Vec<[f32; 2]> =
        matter.bodies.iter().map(|[x, y, ..]| [f32::from_bits(*x), f32::from_bits(*y)]).collect();
    assert_eq!(places, [[0.5, 20.0], [-0.5, 20.0], [0.5, 39.5], [-0.5, 39.5], [0.5, 40.5], [-0.5, 40.5], [20.0, 20.0]]);
}

#[test]
fn water_that_tumbles_foams_and_water_at_rest_does_not() {
    let rig = Rig::new();
    let foam = |speed: f32| {
        let mut particles = Particles::default();
        for k in 0..400 {
            let at = Vec2::new(10.5 + (k % 20) as f32, 10.5 + (k / 20) as f32);
            // Each against its neighbours.
            let way = if (k + k / 20) % 2 == 0 { 1.0 } else { -1.0 };
            particles.push(k, rig.find("water"), at, Vec2::new(way * speed, 0.0));
        }
        let mut body = BodyMap::default();
        body.follow_rock(Vec2::splat(SIDE), &rig.rock, true);
        for ticks in [0, 1, 1, 1, 1] {
            body.measure(0.1, &particles, &rig.looks, ticks);
        }
        body.foam_at(Vec2::splat(20.0))
    };
    assert_eq!(foam(0.0), 0.0);
    assert!(foam(30.0) > 0.2, "{}", foam(30.0));
    assert!(foam(60.0) >= foam(30.0));
}

#[test]
fn how_full_a_place_is_follows_from_what_is_around_it_and_from_nothing_before() {
    let mut rig = Rig::new();
    let mut body = BodyMap::default();
    let side = SIDE as i32 / 2;
    let worlds: [(&[&str], &[[i32; 2]]); 4] = [
        (&["water", "sand", "steam", "mercury"], &[]),
        (&["sand", "sand"], &[[0, 0], [1, 0], [39, 39], [8, 19], [8, 20]]),
        (&["steam", "water", "water"], &[[8, 19]]),
        (&[], &[]),
    ];
    for (names, cells) in worlds {
        for (x, y) in (0..SIDE as i32).flat_map(|x| (0..SIDE as i32).map(move |y| (x, y))) {
            let cell = IVec2::new(x, y);
            if cells.contains(&[x, y]) {
                rig.rock.insert(cell, rig.find("stone"), 0);
            } else {
                rig.rock.remove(cell);
            }
        }
        let particles = rig.row(names);
        let measure = |body: &mut BodyMap, is_new: bool| {
            body.follow_rock(Vec2::splat(SIDE), &rig.rock, is_new);
            body.measure(0.1, &particles, &rig.looks, 0);
        };
        let mut fresh = BodyMap::default();
        measure(&mut body, false);
        measure(&mut fresh, true);
        assert_eq!(body.texels(), fresh.texels());

        let full = |x: i32, y: i32| {
            let home = IVec2::new(x, y).clamp(IVec2::ZERO, IVec2::splat(side - 1));
            let is_gas = |i: usize| rig.looks.of(particles.element[i]).is_gas();
            let moves = (0..particles.len()).filter(|i| !is_gas(*i)).map(|i| particles.position(i));
            let stands = rig.rock.iter().map(|(cell, ..)| centre(cell));
            let matter = moves.chain(stands).filter(|at| (*at / CELL).as_ivec2() == home).count();
            (matter as f32 / (CELL * CELL)).min(1.25)
        };
        for (x, y) in (0..side).flat_map(|x| (0..side).map(move |y| (x, y))) {
            let weights = [(-1, 1.0), (0, 2.0), (1, 1.0)];
            let parts = weights.iter().flat_map(|(dy, a)| weights.map(|(dx, b)| a * b * full(x + dx, y + dy)));
            let share = (parts.sum::<f32>() / 16.0).min(1.0);
            assert_eq!(body.texels()[(4 * (y * side + x) + 3) as usize], (255.0 * share) as u8, "{x} {y}");
        }
    }
}
