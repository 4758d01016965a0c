//! What a soak that was stopped goes on from, as a file.
//!
//! ```text
//! "PowderMaster soak\n" │ version, u16 │ hash of the rest, u64 │ postcard of `Entry`      (numbers little-endian)
//! ```

use super::{period::Period, player::Hand, report::Report};
use crate::sim::file::{FileError, Kind, VERSION};
use serde::{Deserialize, Serialize};

const JOURNAL: Kind = Kind { name: "soak's journal", magic: b"PowderMaster soak\n", version: VERSION };

/// A soak between two minutes.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Entry {
    /// What was asked for: names and values. Only the same goes on.
    pub command: Vec<(String, String)>,
    /// What was seen.
    pub report: Report,
    /// What was seen of the period at hand.
    pub(super) period: Period,
    /// The player.
    pub(super) hand: Hand,
    /// The world: a save file.
    pub(super) world: Vec<u8>,
}

impl Entry {
    /// It as a file.
    pub fn encode(&self) -> Vec<u8> {
        JOURNAL.seal(self)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// If it is not one, was cut or changed.
    pub fn decode(bytes: &[u8]) -> Result<Self, FileError> {
        let (entry, _) = JOURNAL.unseal::<Self>(bytes)?;
        if entry.period.is_sound() { Ok(entry) } else { Err(JOURNAL.unsound("its times have other classes".into())) }
    }

    /// The first thing that was asked for otherwise: its name, what it was, and what it is in `command`.
    pub fn differs<'a>(&'a self, command: &'a [(String, String)]) -> Option<[&'a str; 3]> {
        let known = |(name, value): &'a (String, String)| {
            let was = self.command.iter().find(|(other, _)| other == name).map_or("", |(_, was)| was.as_str());
            (was != value).then_some([name.as_str(), was, value.as_str()])
        };
        command.iter().find_map(known)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry() -> Entry {
        let command = [("scene", "waterfall"), ("seed", "1")].map(|(name, value)| (name.into(), value.into()));
        Entry {
            command: command.to_vec(),
            report: Report { minutes: 3, ..Report::default() },
            period: Period::default(),
            hand: Hand::default(),
            world: vec![1, 2, 3],
        }
    }

    #[test]
    fn an_entry_comes_back_whole_or_not_at_all() {
        let bytes = entry().encode();
        let back = Entry::decode(&bytes).unwrap();
        assert_eq!((back.command, back.report, back.world), (entry().command, entry().report, entry().world));
        for cut in 0..bytes.len() {
            assert!(Entry::decode(&bytes[..cut]).is_err(), "{cut} bytes are enough");
        }
        let mut changed = bytes.clone();
        *changed.last_mut().unwrap() ^= 1;
        assert!(Entry::decode(&changed).is_err_and(|error| error.to_string().contains("checksum")));
        assert!(Entry::decode(b"a letter").is_err_and(|error| error.to_string().contains("not a soak's journal")));
    }

    #[test]
    fn only_the_same_command_goes_on() {
        let entry = entry();
        assert_eq!(entry.differs(&entry.command), None);
        let other = [("scene", "waterfall"), ("seed", "2")].map(|(name, value)| (name.to_owned(), value.to_owned()));
        assert_eq!(entry.differs(&other), Some(["seed", "1", "2"]));
        assert_eq!(entry.differs(&[("detail".into(), "2".into())]), Some(["detail", "", "2"]));
    }
}
