//! The journal of a sweep: a line for every finished run, so that a sweep that was stopped goes on.
//!
//! Lines of another campaign (another program, processor, scene or length of run) stay where they are and don't count. A
//! line that can't be read, such as the last one of a sweep that was killed, doesn't either. The file is locked as long as
//! the sweep goes on, and is only ever appended to: no other sweep can come between its lines, and nothing of one is lost.

use super::design::Setting;
use crate::lab::coarse::Distance;
use serde::{Deserialize, Serialize};
use std::{
    collections::BTreeMap,
    fs::{File, OpenOptions, TryLockError},
    io::{self, Read, Write},
    path::Path,
};

/// How exact a run was. `None` where a value does not apply; means are over the samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Particles at the end, rock included.
    pub particles: usize,
    /// Mean density error.
    pub error_mean: Option<f64>,
    /// 99th percentile of the density error.
    pub error_p99: Option<f64>,
    /// Largest density error.
    pub error_max: Option<f64>,
    /// Mean density of the interior particles, 1 at rest density.
    pub density_mean: Option<f64>,
    /// Room that the liquid takes too much, as a share.
    pub volume_error: Option<f64>,
    /// The solver's own residual.
    pub residual: Option<f64>,
    /// Highest energy of the particles against the start's, less 1 and less what swelling to the target density takes;
    /// only in a closed scene.
    pub energy_gain: Option<f64>,
    /// Particles that were not finite, and particle-ticks outside the box or in rock.
    pub lost: u64,
    /// Distance to the reference.
    pub distance: Distance,
}

/// What a run left.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Median time of a tick, ms.
    pub ms: f64,
    /// 95th percentile, ms.
    pub ms_p95: f64,
    /// Hash of the final state.
    pub hash: String,
    /// How exact it was; only the first run of a setting is sampled.
    pub found: Option<Found>,
}

#[derive(Serialize, Deserialize)]
struct Line {
    campaign: String,
    setting: String,
    round: u32,
    #[serde(flatten)]
    record: Record,
}

/// Why a journal can't be had.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// Another sweep writes it.
    #[error("another sweep writes here")]
    InUse,
    /// It can't be read or written.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// The file of a journal, locked for this sweep.
#[derive(Debug)]
pub struct JournalFile(File);

impl JournalFile {
    /// Opens the file at `path`, or makes it, and locks it. The lock ends with the process, however that ends.
    ///
    /// # Errors
    /// If it is locked, or can't be opened for reading and writing.
    pub fn open(path: &Path) -> Result<Self, OpenError> {
        let file = OpenOptions::new().read(true).append(true).create(true).open(path)?;
        match file.try_lock() {
            Ok(()) => Ok(Self(file)),
            Err(TryLockError::WouldBlock) => Err(OpenError::InUse),
            // A file system without locks: lines are appended whole all the same.
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => Ok(Self(file)),
            Err(TryLockError::Error(error)) => Err(OpenError::Io(error)),
        }
    }
}

/// The runs of one campaign, and the file that they are kept in.
pub struct Journal {
    file: File,
    campaign: String,
    records: BTreeMap<(String, u32), Record>,
}

impl Journal {
    /// Reads what the file has of `campaign`, to go on from there.
    ///
    /// # Errors
    /// If it can't be read or written.
    pub fn read(JournalFile(mut file): JournalFile, campaign: String) -> io::Result<Self> {
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        // Half a line of a sweep that was killed ends here, so that the next stands on its own.
        if bytes.last().is_some_and(|last| *last != b'\n') {
            file.write_all(b"\n")?;
        }
        let records = (bytes.split(|byte| *byte == b'\n'))
            .filter_map(|line| serde_json::from_slice::<Line>(line).ok())
            .filter(|line| line.campaign == campaign)
            .map(|line| ((line.setting, line.round), line.record))
            .collect();
        Ok(Self { file, campaign, records })
    }

    /// A run of a setting.
    pub fn find(&self, setting: &Setting, round: u32) -> Option<&Record> {
        self.records.get(&(setting.key(), round))
    }

    fn of(&self, setting: &Setting) -> impl Iterator<Item = &Record> {
        let key = setting.key();
        self.records.range((key.clone(), 0)..=(key, u32::MAX)).map(|(_, record)| record)
    }

    /// How exact a setting is, if a run of it was sampled.
    pub fn found(&self, setting: &Setting) -> Option<&Found> {
        self.of(setting).find_map(|record| record.found.as_ref())
    }

    /// Hash of the final state of a setting, if it was run.
    pub fn hash(&self, setting: &Setting) -> Option<&str> {
        self.of(setting).map(|record| record.hash.as_str()).next()
    }

    /// Keeps a run.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn add(&mut self, setting: &Setting, round: u32, record: Record) -> io::Result<()> {
        let line = Line { campaign: self.campaign.clone(), setting: setting.key(), round, record };
        let mut text = serde_json::to_string(&line)?;
        text.push('\n');
        self.file.write_all(text.as_bytes())?;
        self.records.insert((line.setting, round), line.record);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::params::Preset;

    fn setting(threads: usize) -> Setting {
        Setting { name: "a".to_owned(), preset: None, quality: Preset::Fast.quality(), threads }
    }

    fn record(ms: f64, sampled: bool) -> Record {
        let found = sampled.then(|| Found { error_p99: Some(0.0123), lost: 2, ..Found::default() });
        Record { ms, ms_p95: 2.0 * ms, hash: "00ff".to_owned(), found }
    }

    fn path(test: &str) -> std::path::PathBuf {
        let folder = std::env::temp_dir().join(format!("powder-master-journal-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join(test);
        let _ = std::fs::remove_file(&path);
        path
    }

    fn open(path: &Path, campaign: &str) -> Journal {
        Journal::read(JournalFile::open(path).unwrap(), campaign.to_owned()).unwrap()
    }

    #[test]
    fn what_was_added_is_there_again_and_only_for_its_campaign() {
        let path = path("again");
        let mut journal = open(&path, "one");
        journal.add(&setting(1), 0, record(1.1, true)).unwrap();
        journal.add(&setting(1), 1, record(1.3, false)).unwrap();
        drop(journal);
        let mut journal = open(&path, "one");
        assert_eq!(journal.find(&setting(1), 0), Some(&record(1.1, true)));
        assert_eq!(journal.find(&setting(1), 1), Some(&record(1.3, false)));
        assert_eq!(journal.found(&setting(1)), record(1.1, true).found.as_ref());
        assert_eq!(journal.find(&setting(2), 0), None, "other threads are another setting");
        assert_eq!(journal.hash(&setting(2)), None);
        journal.add(&setting(2), 0, record(0.7, false)).unwrap();
        drop(journal);
        assert_eq!(open(&path, "two").find(&setting(1), 0), None);
        assert_eq!(
            open(&path, "one").find(&setting(2), 0),
            Some(&record(0.7, false)),
            "the other campaign did no harm"
        );
    }

    #[test]
    fn half_a_line_does_not_count_and_what_comes_next_stands_on_its_own() {
        let path = path("half");
        let mut journal = open(&path, "one");
        journal.add(&setting(1), 0, record(1.1, true)).unwrap();
        journal.add(&setting(1), 1, record(1.3, false)).unwrap();
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        // From all but the closing brace to nothing but the opening one.
        for cut in 2..whole.iter().rev().skip(1).position(|byte| *byte == b'\n').unwrap() {
            std::fs::write(&path, &whole[..whole.len() - cut]).unwrap();
            let mut journal = open(&path, "one");
            assert_eq!(journal.find(&setting(1), 0), Some(&record(1.1, true)));
            assert_eq!(journal.find(&setting(1), 1), None, "{cut} bytes are missing");
            journal.add(&setting(1), 1, record(1.4, false)).unwrap();
            drop(journal);
            let journal = open(&path, "one");
            assert_eq!(journal.find(&setting(1), 1), Some(&record(1.4, false)));
        }
        std::fs::write(&path, b"\xff\xfe\nno json\n").unwrap();
        assert!(open(&path, "one").records.is_empty());
    }

    #[test]
    fn a_journal_is_one_sweep_s_alone_until_that_ends() {
        let path = path("locked");
        let mut journal = open(&path, "one");
        assert!(matches!(JournalFile::open(&path), Err(OpenError::InUse)));
        journal.add(&setting(1), 0, record(1.1, false)).unwrap();
        drop(journal);
        assert_eq!(open(&path, "one").find(&setting(1), 0), Some(&record(1.1, false)));
    }
}
