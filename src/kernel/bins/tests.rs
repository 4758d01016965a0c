//! Nobody within reach is missed, and everybody is in one group.

use super::*;
use crate::kernel::element::ElementId;

fn scattered(n: usize, size: Vec2) -> (Vec<f32>, Vec<f32>) {
    let mut state = 12345_u32;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state as f32 / u32::MAX as f32
    };
    (0..n).map(|_| (random() * size.x, random() * size.y)).unzip()
}

fn sorted(n: usize, size: Vec2, width: usize) -> (Bins, Vec<f32>, Vec<f32>) {
    let (mut x, mut y) = scattered(n, size);
    let mut bins = Bins::default();
    let mut solids = Solids::new(size.x.ceil() as u32, size.y.ceil() as u32);
    for k in 0..10 {
        solids.insert(glam::IVec2::new(k, k / 2), ElementId(0), k as u32);
    }
    bins.lay(size, 2.5, 0.1, &solids);
    bins.sort(&x, &y, InstructionSet::Baseline, 1);
    let mut spare = Vec::new();
    permute(&mut x, &bins.places, &mut spare);
    permute(&mut y, &bins.places, &mut spare);
    bins.group(&x, width, Neighbours::Binned);
    (bins, x, y)
}

#[test]
fn every_particle_is_in_exactly_one_group() {
    for (n, width) in [(0, 16), (1, 16), (5, 1), (1000, 16), (777, 8)] {
        let (bins, ..) = sorted(n, Vec2::new(50.0, 30.0), width);
        let mut next = 0;
        for group in bins.groups() {
            assert_eq!(group.first as usize, next);
            assert!(group.len as usize <= width && group.len > 0);
            next += group.len as usize;
        }
        assert_eq!(next, n);
    }
}

#[test]
fn no_pair_within_reach_is_missed() {
    for size in [Vec2::new(50.0, 30.0), Vec2::new(3.0, 200.0), Vec2::new(200.0, 1.5), Vec2::new(1.0, 1.0)] {
        let (bins, x, y) = sorted(600, size, 16);
        for group in bins.groups() {
            for i in group.particles() {
                for j in 0..x.len() {
                    let near = (Vec2::new(x[i], y[i]) - Vec2::new(x[j], y[j])).length() < 2.7;
                    let candidate = group.movable.iter().any(|run| run.range().contains(&j));
                    assert!(candidate || !near, "{i} misses {j} in a box of {size}");
                }
                for j in 0..bins.rock().x.len() {
                    let rock = Vec2::new(bins.rock().x[j], bins.rock().y[j]);
                    let near = (Vec2::new(x[i], y[i]) - rock).length() < 2.7;
                    assert!(!near || group.rock.iter().any(|run| run.range().contains(&j)), "{i} misses rock {j}");
                }
            }
        }
    }
}

#[test]
fn candidates_are_few() {
    let size = Vec2::new(100.0, 100.0);
    let (bins, x, _) = sorted(10_000, size, 16);
    let candidates: usize =
        bins.groups().iter().map(|g| g.len as usize * g.movable.iter().map(|r| r.range().len()).sum::<usize>()).sum();
    assert!(candidates / x.len() < 130, "{} candidates a particle", candidates / x.len());
}

#[test]
fn the_sort_is_stable_and_complete() {
    let keys = [3, 0, 3, 1, 0, 3];
    let (mut starts, mut places) = (vec![0; 5], Vec::new());
    count_into_places(&keys, 0, &mut starts, &mut places);
    assert_eq!(places, [3, 0, 4, 2, 1, 5]);
    assert_eq!(starts, [0, 2, 3, 3, 6]);
}
