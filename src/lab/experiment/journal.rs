//! The journal of an experiment: a line for every finished run, so that an experiment that was stopped goes on.
//!
//! Lines of another campaign (another program, processor, scene or length of run) stay where they are and don't count. A
//! line that can't be read, such as the last one of a program that was killed, doesn't either. The file is locked while the
//! experiment runs, and is only ever appended to: no other one can come between its lines, and nothing is lost.

use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::{
    collections::BTreeMap,
    fs::{File, OpenOptions, TryLockError},
    io::{self, Read, Seek, Write},
    path::Path,
};

#[derive(Serialize, Deserialize)]
struct Line<R> {
    campaign: String,
    setting: String,
    round: u32,
    #[serde(flatten)]
    record: R,
}

/// Why a journal can't be had.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// Another run writes it.
    #[error("another run writes here")]
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

    /// Whether it holds something else: it does not begin as lines do.
    ///
    /// # Errors
    /// If it can't be read.
    pub fn is_foreign(&mut self) -> io::Result<bool> {
        let mut start = Vec::new();
        Read::take(&mut self.0, BEGINNING.len() as u64).read_to_end(&mut start)?;
        self.0.rewind()?;
        Ok(!BEGINNING.starts_with(&start))
    }
}

/// What each line begins with.
const BEGINNING: &[u8] = b"{\"campaign\":";

/// The runs of one campaign, and the file that they are kept in. A run is known by its setting and its round.
pub struct Journal<R> {
    file: File,
    campaign: String,
    records: BTreeMap<(String, u32), R>,
}

impl<R: Serialize + DeserializeOwned> Journal<R> {
    /// Reads what the file has of `campaign`, to go on from there.
    ///
    /// # Errors
    /// If it can't be read or written.
    pub fn read(JournalFile(mut file): JournalFile, campaign: String) -> io::Result<Self> {
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        // Half a line of a program that was killed ends here, so that the next stands on its own.
        if bytes.last().is_some_and(|last| *last != b'\n') {
            file.write_all(b"\n")?;
        }
        let records = (bytes.split(|byte| *byte == b'\n'))
            .filter_map(|line| serde_json::from_slice::<Line<R>>(line).ok())
            .filter(|line| line.campaign == campaign)
            .map(|line| ((line.setting, line.round), line.record))
            .collect();
        Ok(Self { file, campaign, records })
    }

    /// A run of a setting.
    pub fn find(&self, setting: &str, round: u32) -> Option<&R> {
        self.records.get(&(setting.to_owned(), round))
    }

    /// All runs of a setting, by their rounds.
    pub fn all(&self, setting: &str) -> impl Iterator<Item = &R> {
        let of = |round| (setting.to_owned(), round);
        self.records.range(of(0)..=of(u32::MAX)).map(|(_, record)| record)
    }

    /// Keeps a run.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn add(&mut self, setting: &str, round: u32, record: R) -> io::Result<()> {
        let line = Line { campaign: self.campaign.clone(), setting: setting.to_owned(), round, record };
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

    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    struct Record {
        ms: f64,
        found: Option<u64>,
    }

    fn record(ms: f64, sampled: bool) -> Record {
        Record { ms, found: sampled.then_some(2) }
    }

    fn path(test: &str) -> std::path::PathBuf {
        let folder = std::env::temp_dir().join(format!("powder-master-journal-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join(test);
        let _ = std::fs::remove_file(&path);
        path
    }

    fn open(path: &Path, campaign: &str) -> Journal<Record> {
        Journal::read(JournalFile::open(path).unwrap(), campaign.to_owned()).unwrap()
    }

    #[test]
    fn what_was_added_is_there_again_and_only_for_its_campaign() {
        let path = path("again");
        let mut journal = open(&path, "one");
        journal.add("a", 0, record(1.1, true)).unwrap();
        journal.add("a", 1, record(1.3, false)).unwrap();
        drop(journal);
        let mut journal = open(&path, "one");
        assert_eq!(journal.find("a", 0), Some(&record(1.1, true)));
        assert_eq!(journal.find("a", 1), Some(&record(1.3, false)));
        assert_eq!(journal.all("a").count(), 2);
        assert_eq!(journal.find("a b", 0), None, "a longer name is another setting");
        journal.add("a b", 0, record(0.7, false)).unwrap();
        drop(journal);
        assert_eq!(open(&path, "two").find("a", 0), None);
        assert_eq!(open(&path, "one").find("a b", 0), Some(&record(0.7, false)), "the other campaign did no harm");
    }

    #[test]
    fn half_a_line_does_not_count_and_what_comes_next_stands_on_its_own() {
        let path = path("half");
        let mut journal = open(&path, "one");
        journal.add("a", 0, record(1.1, true)).unwrap();
        journal.add("a", 1, record(1.3, false)).unwrap();
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        // From all but the closing brace to nothing but the opening one.
        for cut in 2..whole.iter().rev().skip(1).position(|byte| *byte == b'\n').unwrap() {
            std::fs::write(&path, &whole[..whole.len() - cut]).unwrap();
            let mut journal = open(&path, "one");
            assert_eq!(journal.find("a", 0), Some(&record(1.1, true)));
            assert_eq!(journal.find("a", 1), None, "{cut} bytes are missing");
            journal.add("a", 1, record(1.4, false)).unwrap();
            drop(journal);
            let journal = open(&path, "one");
            assert_eq!(journal.find("a", 1), Some(&record(1.4, false)));
        }
        std::fs::write(&path, b"\xff\xfe\nno json\n").unwrap();
        assert!(open(&path, "one").records.is_empty());
    }

    #[test]
    fn a_journal_is_one_sweep_s_alone_until_that_ends() {
        let path = path("locked");
        let mut journal = open(&path, "one");
        assert!(matches!(JournalFile::open(&path), Err(OpenError::InUse)));
        journal.add("a", 0, record(1.1, false)).unwrap();
        drop(journal);
        assert_eq!(open(&path, "one").find("a", 0), Some(&record(1.1, false)));
    }
}
