//! A case: a scene file and what is done to its world. On disk it is `NAME.ron`, which the program itself opens
//! (`powder-master run tests/cases/NAME.ron`), and beside it, if anything is done, `NAME.jsonl` with one [`Entry`] a line.

use crate::sim::recording::Entry;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// Ticks that a case runs on after the last of its input, if its file doesn't say how many it runs.
const TICKS: u32 = 60;
/// What stands before the number of ticks in the first line of a scene file that says it.
const SAYS_TICKS: &str = "// Ticks: ";

/// A scene and what is done to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Text of the scene file.
    pub scene: String,
    /// What is done, oldest first.
    pub input: Vec<Entry>,
    /// Ticks to run.
    pub ticks: u32,
}

impl Case {
    /// Reads the case of a scene file.
    ///
    /// # Errors
    /// If the scene can't be read, or what is done is no list of intents.
    pub fn read(scene: &Path) -> io::Result<Self> {
        let input = match fs::read_to_string(scene.with_extension("jsonl")) {
            Ok(text) => text.lines().map(serde_json::from_str).collect::<Result<Vec<Entry>, _>>()?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(error) => return Err(error),
        };
        let scene = fs::read_to_string(scene)?;
        let says = scene.strip_prefix(SAYS_TICKS).and_then(|text| text.lines().next()?.split('.').next()?.parse().ok());
        let ticks = says.unwrap_or_else(|| TICKS + input.last().map_or(0, |entry| entry.tick as u32));
        Ok(Self { scene, input, ticks })
    }

    /// The first line of a scene file that runs so many ticks, with what is to be said of it.
    pub(super) fn head(ticks: u32, what: &str) -> String {
        format!("{SAYS_TICKS}{ticks}. {}\n", what.replace('\n', " "))
    }

    /// Keeps it as `found-HASH` in a folder, which is made if it isn't there; returns the scene file.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn keep(&self, folder: &Path) -> io::Result<PathBuf> {
        let mut input = String::new();
        for entry in &self.input {
            input += &serde_json::to_string(entry)?;
            input.push('\n');
        }
        // 64-bit FNV-1a: the same failure is kept once.
        let hash =
            self.scene.bytes().chain(input.bytes()).fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
            });
        let scene = folder.join(format!("found-{hash:016x}.ron"));
        fs::create_dir_all(folder)?;
        fs::write(&scene, &self.scene)?;
        if !input.is_empty() {
            fs::write(scene.with_extension("jsonl"), input)?;
        }
        Ok(scene)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::intent::Intent;

    #[test]
    fn a_case_survives_its_files() {
        let folder = std::env::temp_dir().join(format!("powder-master-case-{}", std::process::id()));
        let scene = "(title: \"One\", spacing: 1, size: (8, 8))";
        let says = Case {
            scene: Case::head(31, "Breaks\na rule.") + scene,
            input: vec![Entry { tick: 7, intent: Intent::ClearAir }],
            ticks: 31,
        };
        assert_eq!(Case::read(&says.keep(&folder).unwrap()).unwrap(), says);
        let silent = Case { scene: scene.to_owned(), ticks: 67, ..says };
        assert_eq!(Case::read(&silent.keep(&folder).unwrap()).unwrap(), silent);
        let still = Case { input: Vec::new(), ticks: 60, ..silent };
        assert_eq!(Case::read(&still.keep(&folder).unwrap()).unwrap(), still);
        fs::remove_dir_all(folder).unwrap();
    }
}
