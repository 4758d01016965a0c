//! What comes of a case.

use crate::kernel::params::Preset;
use serde::{Deserialize, Serialize, Serializer, de::DeserializeOwned};
use std::{collections::BTreeMap, fmt::Debug};

/// How a row came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Within what is allowed.
    Pass,
    /// Beyond it at a quality that promises nothing: `classic`, `draft` or `fast`.
    Miss,
    /// Beyond it where that is known: written down with the reason.
    Known,
    /// Not judged: shown to be compared with.
    Shown,
    /// Beyond it.
    Fail,
}

impl Verdict {
    /// In a table.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Miss => "miss",
            Self::Known => "known",
            Self::Shown => "–",
            Self::Fail => "FAIL",
        }
    }
}

/// What the rows of a suite say beside case, setting and verdict.
pub trait Figures: Clone + Debug + PartialEq + Serialize + DeserializeOwned + Send + Sync + 'static {
    /// The key of the setting in JSON.
    const SETTING: &'static str;

    /// What broke, each in a few words with what was allowed.
    fn broken(&self) -> &[String] {
        &[]
    }

    /// Counts what took too long among what broke, on a machine that does nothing else; whether anything did.
    fn count_time(&mut self) -> bool {
        false
    }

    /// What is to be said about the row beside its figures.
    fn remark(&self) -> Option<String> {
        None
    }

    /// Why that was to be expected, if it was.
    fn known(&self) -> Option<&'static str> {
        None
    }
}

/// A result of a case in a setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<F> {
    /// Name of the case.
    pub case: &'static str,
    /// Heading of the case.
    pub title: &'static str,
    /// Name of the setting.
    pub setting: String,
    /// The named quality of the setting.
    pub preset: Preset,
    /// How it came out.
    pub verdict: Verdict,
    /// What was found.
    pub figures: F,
}

impl<F: Figures> Serialize for Row<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Flat<'a, F> {
            case: &'static str,
            verdict: Verdict,
            #[serde(flatten)]
            setting: BTreeMap<&'static str, &'a str>,
            #[serde(flatten)]
            figures: &'a F,
        }
        let setting = BTreeMap::from([(F::SETTING, self.setting.as_str())]);
        Flat { case: self.case, verdict: self.verdict, setting, figures: &self.figures }.serialize(serializer)
    }
}
