//! A case: a scene file and what is done to its world. On disk it is `NAME.ron`, which the program itself opens
//! (`powder-master run tests/cases/NAME.ron`), and beside it, if anything is done, `NAME.jsonl` with one [`Entry`] a line.

use powder_master::sim::recording::Entry;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// Ticks that a case from a file without input runs.
const TICKS: u32 = 60;

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

/// Where cases are kept.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases")
}

impl Case {
    /// Reads the case of a scene file.
    pub fn read(scene: &Path) -> io::Result<Self> {
        let input = match fs::read_to_string(scene.with_extension("jsonl")) {
            Ok(text) => text.lines().map(serde_json::from_str).collect::<Result<Vec<Entry>, _>>()?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(error) => return Err(error),
        };
        let ticks = TICKS + input.last().map_or(0, |entry| entry.tick as u32);
        Ok(Self { scene: fs::read_to_string(scene)?, input, ticks })
    }

    /// Keeps it as `found-HASH`; returns the scene file.
    pub fn keep(&self) -> io::Result<PathBuf> {
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
        let scene = folder().join(format!("found-{hash:016x}.ron"));
        fs::create_dir_all(folder())?;
        fs::write(&scene, &self.scene)?;
        if !input.is_empty() {
            fs::write(scene.with_extension("jsonl"), input)?;
        }
        Ok(scene)
    }
}
