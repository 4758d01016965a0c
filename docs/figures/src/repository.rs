//! The repository, by way of git.

use crate::fault::Fault;
use std::{path::Path, process::Command};

/// Tests can't change a figure.
const TESTS: [&str; 2] = [":(exclude,glob)**/tests/**", ":(exclude,glob)**/tests.rs"];

/// A checkout.
pub struct Repository<'a> {
    /// Its root.
    pub root: &'a Path,
}

impl Repository<'_> {
    /// What git says, or the first line of its complaint.
    fn git(&self, arguments: &[&str]) -> Result<String, Fault> {
        let output = Command::new("git").arg("-C").arg(self.root).args(arguments).output();
        let output = output.map_err(|error| Fault::Usage(format!("git can't be run ({error}); figures need it")))?;
        if output.status.success() {
            return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
        }
        let complaint = String::from_utf8_lossy(&output.stderr);
        let line = complaint.lines().next().unwrap_or("no reason given");
        Err(Fault::Usage(format!("{}: git {}: {line}", self.root.display(), arguments[0])))
    }

    /// The commit that is checked out, short.
    ///
    /// # Errors
    /// If this is no repository, or it has no commit.
    pub fn head(&self) -> Result<String, Fault> {
        Ok(self.git(&["rev-parse", "--short=7", "HEAD"])?.trim().to_owned())
    }

    /// Files that are not as the commit has them, new ones included.
    ///
    /// # Errors
    /// If this is no repository.
    pub fn changes(&self) -> Result<Vec<String>, Fault> {
        let status = self.git(&["status", "--porcelain", "-z", "--no-renames", "--untracked-files=all"])?;
        Ok(status.split('\0').filter_map(|line| line.get(3..)).map(str::to_owned).collect())
    }

    /// Whether a commit is known.
    pub fn knows(&self, commit: &str) -> bool {
        self.git(&["cat-file", "-e", &format!("{commit}^{{commit}}")]).is_ok()
    }

    /// Files among these that changed from a commit to the one that is checked out, tests left out.
    ///
    /// # Errors
    /// If the commit is not known.
    pub fn changed_since(&self, commit: &str, sources: &[&str]) -> Result<Vec<String>, Fault> {
        let arguments = [&["diff", "--name-only", "--no-renames", commit, "HEAD", "--"], sources, &TESTS].concat();
        Ok(self.git(&arguments)?.lines().map(str::to_owned).collect())
    }
}
