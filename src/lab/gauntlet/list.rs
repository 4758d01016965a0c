//! The hard cases: what `assets/gauntlet` says, in the order in which they are shown.

use crate::lab::{
    cases::{Size, line, read},
    gauntlet::{case::GauntletCase, ends, script},
};
use serde::Deserialize;
use std::{collections::BTreeMap, sync::LazyLock};

/// All cases, by what is hard about them.
pub static CASES: LazyLock<Vec<GauntletCase>> =
    LazyLock::new(|| FILES.iter().flat_map(|(file, text)| read::<Kind>(file, text).cases()).collect());

const FILES: [(&str, &str); 13] = [
    ("crowd", include_str!("../../../assets/gauntlet/crowd.ron")),
    ("depth", include_str!("../../../assets/gauntlet/depth.ron")),
    ("impact", include_str!("../../../assets/gauntlet/impact.ron")),
    ("gravity", include_str!("../../../assets/gauntlet/gravity.ron")),
    ("air", include_str!("../../../assets/gauntlet/air.ron")),
    ("matter", include_str!("../../../assets/gauntlet/matter.ron")),
    ("layers", include_str!("../../../assets/gauntlet/layers.ron")),
    ("grains", include_str!("../../../assets/gauntlet/grains.ron")),
    ("elements", include_str!("../../../assets/gauntlet/elements.ron")),
    ("heat", include_str!("../../../assets/gauntlet/heat.ron")),
    ("rock", include_str!("../../../assets/gauntlet/rock.ron")),
    ("ends", include_str!("../../../assets/gauntlet/ends.ron")),
    ("play", include_str!("../../../assets/gauntlet/play.ron")),
];

/// The cases of one kind.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "'de: 'static"))]
struct Kind {
    /// Scenes that several cases have, by the names that stand in their place.
    #[serde(default)]
    shared: BTreeMap<&'static str, Text>,
    cases: Vec<GauntletCase>,
}

#[derive(Deserialize)]
#[serde(transparent)]
struct Text(#[serde(deserialize_with = "line")] &'static str);

impl Kind {
    fn cases(self) -> impl Iterator<Item = GauntletCase> {
        let Self { shared, cases } = self;
        cases.into_iter().flat_map(runs).map(move |case| {
            let text = |own: &'static str| shared.get(own).map_or(own, |shared| shared.0);
            let allowed = case.exceptions().leak();
            GauntletCase { scene: text(case.scene), allowed, act: script::of(case.name), ..case }
        })
    }
}

/// The runs of a case: of the one that turns knobs to the ends of their ranges seven, of any other itself.
fn runs(case: GauntletCase) -> Vec<GauntletCase> {
    if case.name != ends::CASE {
        return vec![case];
    }
    ends::RUNS
        .iter()
        .enumerate()
        .map(|(run, (name, title))| {
            // The runs in which a tick has 64 substeps or iterations take longer.
            let size = if ends::is_long(run) { Size::Usual } else { Size::Quick };
            GauntletCase { name, title, size, ends: Some(run), ..case.clone() }
        })
        .collect()
}
