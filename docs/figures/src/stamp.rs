//! Where and when figures were made: a line below them that a reader sees and that is read again.

use std::{
    fmt,
    time::{SystemTime, UNIX_EPOCH},
};

const BEGIN: &str = "*Commit ";
const END: &str = ".*";
const UNKNOWN: &str = "not noted";
const CHANGES: &str = " with changes";

/// Where and when figures were made.
#[derive(Clone, Debug, PartialEq)]
pub struct Stamp {
    /// The commit of the program, if it is known.
    pub commit: Option<String>,
    /// Whether there were changes that no commit has.
    pub with_changes: bool,
    /// Machine, date and what else is said.
    pub rest: Vec<String>,
}

impl Stamp {
    /// The stamp that a line is.
    pub fn parse(line: &str) -> Option<Self> {
        let mut parts = line.strip_prefix(BEGIN)?.strip_suffix(END)?.split("; ").map(str::to_owned);
        let first = parts.next()?;
        let commit = first.strip_suffix(CHANGES).unwrap_or(&first);
        let is_commit = commit.len() >= 7 && commit.chars().all(|letter| letter.is_ascii_hexdigit());
        if !is_commit && commit != UNKNOWN {
            return None;
        }
        let with_changes = first.ends_with(CHANGES);
        Some(Self { commit: is_commit.then(|| commit.to_owned()), with_changes, rest: parts.collect() })
    }
}

impl fmt::Display for Stamp {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let changes = if self.with_changes { CHANGES } else { "" };
        write!(formatter, "{BEGIN}{}{changes}", self.commit.as_deref().unwrap_or(UNKNOWN))?;
        self.rest.iter().try_for_each(|part| write!(formatter, "; {part}"))?;
        formatter.write_str(END)
    }
}

/// Today, such as 21 November 2026 (UTC).
pub fn today() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs());
    date(seconds / 86_400)
}

/// The date so many days after 1 January 1970, counted in years that begin with March, so that the day of a leap year comes last.
fn date(days: u64) -> String {
    const MONTHS: [&str; 12] = [
        "March",
        "April",
        "May",
        "June",
        "July",
        "August",
        "September",
        "October",
        "November",
        "December",
        "January",
        "February",
    ];
    // From 1 March of the year 0 on, in eras of 400 years.
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let (year, day) = (400 * era + year + month / 10, day - (153 * month + 2) / 5 + 1);
    format!("{day} {} {year}", MONTHS[month as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stamp_is_read_as_it_was_written() {
        let rest = ["AMD EPYC (family 26, model 2)", "21 November 2026", "other work 0.1 of 2 processors"];
        for (commit, with_changes) in [(Some("f2793d7"), false), (Some("0123abcdef"), true), (None, false)] {
            let stamp =
                Stamp { commit: commit.map(str::to_owned), with_changes, rest: rest.map(str::to_owned).to_vec() };
            assert_eq!(Stamp::parse(&stamp.to_string()), Some(stamp));
        }
    }

    #[test]
    fn what_is_no_stamp_is_none() {
        for line in
            ["", "*Commit f2793d7", "Commit f2793d7.", "*Commit HEAD; x.*", "*Commit to this.*", "*Commit abc.*"]
        {
            assert_eq!(Stamp::parse(line), None, "{line}");
        }
    }

    #[test]
    fn days_become_dates() {
        let of = |days| date(days);
        assert_eq!(of(0), "1 January 1970");
        assert_eq!([of(11_015), of(11_016), of(11_017)], ["28 February 2000", "29 February 2000", "1 March 2000"]);
        assert_eq!([of(20_513), of(20_818)], ["1 March 2026", "31 December 2026"]);
        // 2100 is no leap year.
        assert_eq!([of(47_540), of(47_541)], ["28 February 2100", "1 March 2100"]);
    }
}
