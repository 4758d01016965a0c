//! Makes figures: runs their commands, and puts what they say into the page.

use crate::{
    fault::Fault,
    machine::processor,
    manifest::{Entry, How, Manifest, Recipe, Shows},
    others::Moment,
    region::{self, region},
    repository::Repository,
    stamp::{Stamp, today},
};
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Instant,
};

/// Makes the entries that a command makes. `report` is told what happens. Gives a line for each command that said by exit code 1
/// that a check failed: its figures are shown as they came.
///
/// # Errors
/// If something is changed that is not committed and `dirty` does not allow for it, a page has no place for figures, a command
/// can't be run or fails, or a page can't be written.
pub fn make(
    repository: &Repository<'_>,
    manifest: &Manifest,
    entries: &[&Entry],
    dirty: bool,
    report: &mut dyn FnMut(&str),
) -> Result<Vec<String>, Fault> {
    // All that can be refused is, before the first command runs.
    let commit = repository.head()?;
    let changes = changes(repository, manifest)?;
    if let Some(first) = changes.first()
        && !dirty
    {
        return Err(Fault::Usage(format!(
            "{first} is not as commit {commit} has it, and the figures would name that commit; allowed: to commit first, \
             or --dirty, which is noted"
        )));
    }
    for entry in entries {
        region(&entry.page, &read(&repository.root.join(&entry.page))?, &entry.name)?;
    }
    let mut failed = Vec::new();
    for entry in entries {
        let How::Made(recipe) = &entry.how else { continue };
        report(&format!("{}: {} ({})", entry.name, recipe.commands.join("; "), recipe.takes));
        let (clock, begin) = (Instant::now(), Moment::now());
        let (output, checks) = run(repository.root, entry, recipe)?;
        failed.extend(checks);
        let others = begin.zip(Moment::now()).map(|(begin, end)| begin.others_until(end));
        let now = (repository.head()?, self::changes(repository, manifest)?);
        if now != (commit.clone(), changes.clone()) {
            return Err(Fault::Outcome(format!(
                "{}: files or the commit changed while it was made; what it is of can't be told",
                entry.name
            )));
        }
        let took = Some(format!("took {} s", clock.elapsed().as_secs()));
        let note = (!recipe.note.is_empty()).then(|| recipe.note.clone());
        let rest = [Some(processor()), Some(today()), note, took, others].into_iter().flatten().collect();
        let stamp = Stamp { commit: Some(commit.clone()), with_changes: !changes.is_empty(), rest };
        show(repository.root, entry, recipe, &output, &stamp)?;
        report(&format!("{}: {stamp}", entry.name));
        if !entry.quoted.is_empty() {
            report(&format!("{}: read again what quotes it: {}", entry.name, entry.quoted.join(", ")));
        }
    }
    Ok(failed)
}

/// Files that are not as the commit has them, without those that figures write.
fn changes(repository: &Repository<'_>, manifest: &Manifest) -> Result<Vec<String>, Fault> {
    Ok(repository.changes()?.into_iter().filter(|file| !manifest.writes(file)).collect())
}

fn read(path: &Path) -> Result<String, Fault> {
    fs::read_to_string(path).map_err(|error| Fault::unread(path, &error))
}

fn write(path: &Path, text: &str) -> Result<(), Fault> {
    fs::write(path, text).map_err(|error| Fault::unwritten(path, &error))
}

/// Runs the commands of an entry; gives what the last one prints, and a line for each by which a check failed.
fn run(root: &Path, entry: &Entry, recipe: &Recipe) -> Result<(String, Vec<String>), Fault> {
    let (mut printed, mut failed) = (String::new(), Vec::new());
    for command in &recipe.commands {
        let mut words = command.split_whitespace();
        let Some(program) = words.next() else { continue };
        let output = Command::new(program).args(words).current_dir(root).stderr(Stdio::inherit()).output();
        let output =
            output.map_err(|error| Fault::Usage(format!("{}: {program} can't be run: {error}", entry.name)))?;
        match output.status.code() {
            Some(0) => {}
            Some(1) if !output.stdout.is_empty() => failed.push(format!("{}: {command}: a check failed", entry.name)),
            _ => return Err(Fault::Outcome(format!("{}: {command}: {}", entry.name, output.status))),
        }
        let not_text = |_| Fault::Outcome(format!("{}: {command}: what it prints is no text", entry.name));
        printed = String::from_utf8(output.stdout).map_err(not_text)?;
    }
    Ok((printed, failed))
}

/// Puts what came out into the page, and the stamp below it and below the Markdown that was written.
fn show(root: &Path, entry: &Entry, recipe: &Recipe, output: &str, stamp: &Stamp) -> Result<(), Fault> {
    for path in recipe.files.iter().filter(|file| file.ends_with(".md")).map(|file| root.join(file)) {
        write(&path, &format!("{}\n\n{stamp}\n", read(&path)?.trim_end()))?;
    }
    let figures = match &recipe.shows {
        Shows::Output | Shows::Document => output.to_owned(),
        Shows::Section(file, heading) => section(root.join(file), heading, entry)?,
        Shows::Table(file, heading) => {
            let missing = || Fault::Outcome(format!("{}: {file} has no table below {heading}", entry.name));
            region::table(&section(root.join(file), heading, entry)?).ok_or_else(missing)?
        }
    };
    if figures.trim().is_empty() {
        return Err(Fault::Outcome(format!("{}: its commands gave nothing to show", entry.name)));
    }
    let folder = entry.page.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
    let shown =
        |(words, file): &(String, String)| format!("![{words}]({})", file.strip_prefix(&folder).unwrap_or(file));
    // A chart of what a scene does not have is not drawn.
    let drawn = recipe.pictures.iter().filter(|(_, file)| root.join(file).exists());
    let mut parts: Vec<String> = drawn.map(shown).collect();
    match recipe.shows {
        Shows::Document => parts.extend([stamp.to_string(), region::without_title(&figures).to_owned()]),
        _ => parts.extend([figures, stamp.to_string()]),
    }
    let path = root.join(&entry.page);
    let text = read(&path)?;
    write(&path, &region(&entry.page, &text, &entry.name)?.replaced(&text, &parts))
}

fn section(path: PathBuf, heading: &str, entry: &Entry) -> Result<String, Fault> {
    let missing = || Fault::Outcome(format!("{}: {} has no section {heading}", entry.name, path.display()));
    region::section(&read(&path)?, heading).map(str::to_owned).ok_or_else(missing)
}
