//! A part of a long work, of so many that different machines do.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Most shards of a work.
pub const MOST_SHARDS: u64 = 1_000_000;

/// Shard K of N: of all that has an index, every Nth from the Kth on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Shard {
    of: u64,
    number: u64,
}

impl Shard {
    /// What `text` means: K/N, K from 1 to N.
    ///
    /// # Errors
    /// What is allowed, if it means nothing.
    pub fn read(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse().ok().filter(|number| (1..=MOST_SHARDS).contains(number));
        let shard = text.split_once('/').and_then(|(k, n)| Some(Self { of: number(n)?, number: number(k)? }));
        shard.filter(|shard| shard.number <= shard.of).ok_or_else(|| {
            format!("allowed: K/N, whole numbers with K from 1 to N, such as 2/8, and N up to {MOST_SHARDS}")
        })
    }

    /// Whether what has this index, from 0, belongs to it.
    pub fn has(self, index: u64) -> bool {
        index % self.of == self.number - 1
    }

    /// Checks that these are all shards of a work, each once.
    ///
    /// # Errors
    /// Which is missing or there twice, and what is allowed.
    pub fn check_complete(shards: impl IntoIterator<Item = Option<Self>>) -> Result<(), String> {
        let shards: Vec<Option<Self>> = shards.into_iter().collect();
        let Some(mut known) = shards.iter().copied().collect::<Option<Vec<Self>>>() else {
            // What is whole needs no other.
            return if shards.len() == 1 { Ok(()) } else { Err("a whole run beside others; allowed: shards".into()) };
        };
        known.sort_unstable();
        let Some(of) = known.first().map(|shard| shard.of) else { return Err("nothing; allowed: all shards".into()) };
        let allowed = format!("allowed: the shards 1/{of} to {of}/{of}, each once");
        if let Some(other) = known.iter().find(|shard| shard.of != of) {
            return Err(format!("shard {other} beside shards of {of}; {allowed}"));
        }
        if let Some(twice) = known.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(format!("shard {} is there twice; {allowed}", twice[0]));
        }
        match (1..=of).find(|number| !known.contains(&Self { of, number: *number })) {
            Some(missing) => Err(format!("shard {missing}/{of} is missing; {allowed}")),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.number, self.of)
    }
}

impl TryFrom<String> for Shard {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        Self::read(&text)
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shards(texts: &[&str]) -> Vec<Option<Shard>> {
        texts.iter().map(|text| Some(Shard::read(text).unwrap())).collect()
    }

    #[test]
    fn every_index_belongs_to_one_shard() {
        let all: Vec<Shard> = (1..=5).map(|k| Shard::read(&format!("{k}/5")).unwrap()).collect();
        assert!((0..50).all(|index| all.iter().filter(|shard| shard.has(index)).count() == 1));
        assert!((0..50).all(|index| Shard::read("1/1").unwrap().has(index)));
        for bad in ["", "1", "0/3", "4/3", "1/0", "a/b", "-1/3", "1/2/3", "1/9999999"] {
            assert!(Shard::read(bad).is_err_and(|message| message.contains("allowed")), "{bad} passed");
        }
    }

    #[test]
    fn only_all_shards_make_the_whole() {
        assert_eq!(Shard::check_complete(shards(&["2/3", "1/3", "3/3"])), Ok(()));
        assert_eq!(Shard::check_complete([None]), Ok(()), "a whole is whole");
        for (bad, says) in [
            (&["1/2"][..], "2/2 is missing"),
            (&["1/2", "1/2"], "twice"),
            (&["1/2", "2/3"], "beside"),
            (&[], "nothing"),
        ] {
            assert!(Shard::check_complete(shards(bad)).is_err_and(|error| error.contains(says)), "{bad:?}");
        }
        assert!(Shard::check_complete([None, None]).is_err());
    }
}
