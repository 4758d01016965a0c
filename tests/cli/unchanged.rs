//! What the program does stays the same to the bit while its house is rebuilt: the hash of every scene at every quality
//! after 600 ticks, written down at commit 111bef1.

use crate::{folder, metrics};
use powder_master::{kernel::params::Preset, scene::builtin_names};

const HASHES: &str = include_str!("unchanged.csv");
const TICKS: &str = "600";

fn comes_to_the_hashes_of(scene: &str) {
    let here = folder(&format!("unchanged_{scene}"));
    let mut qualities = 0;
    for line in HASHES.lines().skip(1).filter(|line| line.split(',').next() == Some(scene)) {
        let [_, quality, hash] = line.split(',').collect::<Vec<_>>()[..] else { panic!("not a row: {line}") };
        let found = metrics(&here, &["run", scene, "--ticks", TICKS, "--quality", quality, "--threads", "1"]);
        assert_eq!(found["hash"], hash, "{scene} at {quality} is another world than before");
        qualities += 1;
    }
    assert_eq!(qualities, Preset::ALL.len(), "qualities of {scene} in the list");
}

macro_rules! scenes {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            comes_to_the_hashes_of(stringify!($name));
        })*

        #[test]
        fn every_scene_is_in_the_list() {
            let known = [$(stringify!($name)),*];
            for scene in builtin_names() {
                assert!(known.contains(&scene), "{scene} has no hashes in unchanged.csv");
            }
        }
    };
}

scenes!(communicating_vessels, dam_break, empty, hydrostatic, rest_density, sealed_air, waterfall, wind_tunnel);
