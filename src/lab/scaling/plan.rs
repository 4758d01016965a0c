//! What is measured: sizes, settings, and how long a row may take.

use crate::kernel::params::Preset;

/// The scene that is measured; its parameter `columns` = c stands for 2 c² particles.
pub const SCENE: &str = "dam_break";

/// Names of all charts that there may be.
pub const CHARTS: [&str; 3] = ["scaling-time", "scaling-error", "scaling-threads"];

/// A quality, perhaps with numbers of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// Name in tables.
    pub name: &'static str,
    /// The quality.
    pub preset: Preset,
    /// Numbers that differ from it, as `--set` has them.
    pub changes: &'static [(&'static str, &'static str)],
}

impl Setting {
    const fn plain(name: &'static str, preset: Preset) -> Self {
        Self { name, preset, changes: &[] }
    }
}

/// All settings: the presets, and the plain method where it is at its best. Not `reference`: at a number of particles
/// it is `fine`.
const SETTINGS: [Setting; 6] = [
    Setting::plain("classic", Preset::Classic),
    Setting {
        name: "classic, 4 substeps × 2 iterations",
        preset: Preset::Classic,
        changes: &[("substeps", "4"), ("iterations", "2")],
    },
    Setting::plain("draft", Preset::Draft),
    Setting::plain("fast", Preset::Fast),
    Setting::plain("balanced", Preset::Balanced),
    Setting::plain("fine", Preset::Fine),
];

/// Columns of the block: 1,458, 10,082, 49,928, 100,352, 315,218 and 999,698 particles.
const SIZES: [u32; 6] = [27, 71, 158, 224, 397, 707];

/// What is to be measured.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Columns of the block, ascending.
    pub sizes: Vec<u32>,
    /// Settings.
    pub settings: Vec<Setting>,
    /// Most rounds of a row.
    pub rounds: usize,
    /// Time that the rounds of a row share, s. A row has at least one.
    pub share: f64,
    /// Time from which on a row is left out, s, by what the size before it took.
    pub cap: f64,
    /// Whether every row is measured over the short window.
    pub is_short: bool,
}

impl Plan {
    /// Everything, from 1,458 to 999,698 particles.
    pub fn full() -> Self {
        Self { sizes: SIZES.to_vec(), settings: SETTINGS.to_vec(), rounds: 5, share: 6.0, cap: 40.0, is_short: false }
    }

    /// A look at the same in less than a minute: three sizes, over the short window.
    pub fn quick() -> Self {
        Self { sizes: vec![27, 71, 224], rounds: 3, share: 1.0, cap: 5.0, is_short: true, ..Self::full() }
    }

    /// The same up to a number of particles.
    #[must_use]
    pub fn up_to(mut self, most: u64) -> Self {
        self.sizes.retain(|columns| particles(*columns) as u64 <= most);
        self
    }
}

/// Particles of a block of `columns`.
pub fn particles(columns: u32) -> usize {
    2 * columns as usize * columns as usize
}
