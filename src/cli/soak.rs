//! `soak`: hours of a scene with a player that follows a script.

use crate::{
    cli::{
        args::{Minutes, SoakArguments},
        failure::Failure,
        journal::{self, StateFile},
        output, progress,
        start::{Start, Wanted, bad},
        threads,
    },
    lab::soak::{Creep, Entry, Report, Soak},
    scene::DEFAULT_SCENE,
    sim::{checkpoint::Checkpoint, snapshot::hash_bytes, workers::Workers},
};
use bevy::platform::time::Instant;
use serde_json::{Value, json};
use std::path::Path;

/// Soaks the scene and prints what was seen, period by period. A fault fails it. A file of figures is written anew at the
/// end of each period, so that a soak that is stopped leaves what it has seen; from a journal it goes on.
pub(super) fn soak(arguments: &SoakArguments) -> Result<(), Failure> {
    let json = arguments.json.as_deref();
    output::check(&json.into_iter().chain(arguments.journal.as_deref()).collect::<Vec<_>>())?;
    let SoakArguments { settings, quality, detail, .. } = arguments;
    let wanted = Wanted { settings, quality: *quality, detail: *detail, ..Wanted::default() };
    let subject = Subject::of(arguments, Start::of_soak(scene(arguments), wanted)?.checkpoint);
    let mut journal = arguments.journal.as_deref().map(|path| Journal::open(path, &subject)).transpose()?;
    threads::start(arguments.machine.threads)?;
    let mut soak = begin(&subject, arguments, journal.as_mut())?;

    let begun = Instant::now();
    let line = progress::bar(subject.minutes).with_message("minutes");
    let most = arguments.within.map_or(f64::INFINITY, |Minutes(minutes)| minutes as f64 * 60.0);
    let file = json.filter(|path| !output::is_stdout(Some(path)));
    let mut rows = soak.report().periods.len();
    while !soak.is_over() && begun.elapsed().as_secs_f64() < most {
        soak.minute();
        line.set_position(soak.report().minutes);
        let is_last = begun.elapsed().as_secs_f64() >= most;
        if let Some(journal) = journal.as_mut().filter(|_| is_last || soak.is_entry_due()) {
            journal.note(&soak, &subject)?;
        }
        if let Some(path) = file.filter(|_| soak.report().periods.len() > rows) {
            rows = soak.report().periods.len();
            // What can't be written now is written with the next period, and at the end its loss is told.
            let _ = output::write_json(path, &subject.figures(soak.report(), soak.hash()));
        }
    }
    drop(line);

    let hash = soak.hash();
    let report = soak.finish();
    output::report(json, || subject.figures(&report, hash), || subject.text(&report, hash))?;
    match &report.faults()[..] {
        [] => Ok(()),
        faults @ [first, ..] => Err(Failure::Outcome(format!("{} faults, the first: {first}", faults.len()))),
    }
}

fn scene(arguments: &SoakArguments) -> &str {
    arguments.scene.as_deref().unwrap_or(DEFAULT_SCENE)
}

/// The soak at its beginning, or where its journal has it.
fn begin(subject: &Subject, arguments: &SoakArguments, journal: Option<&mut Journal<'_>>) -> Result<Soak, Failure> {
    let Subject { start, minutes, .. } = subject;
    let (workers, simd) = (Workers::default(), arguments.machine.simd);
    let Some(journal) = journal else { return Ok(Soak::new(start, arguments.seed, *minutes, workers, simd)) };
    match journal.left.take() {
        Some(entry) => Soak::resume(start, entry, *minutes, workers, simd).map_err(|what| bad(journal.path, &what)),
        None => {
            let soak = Soak::new(start, arguments.seed, *minutes, workers, simd);
            // A place that can't be written is found before anything is simulated.
            journal.note(&soak, subject)?;
            Ok(soak)
        }
    }
}

/// What is soaked.
struct Subject {
    start: Checkpoint,
    minutes: u64,
    /// The command by names and values: all that the bits depend on.
    command: Vec<(String, String)>,
}

impl Subject {
    fn of(arguments: &SoakArguments, start: Checkpoint) -> Self {
        let SoakArguments { hours: Minutes(minutes), seed, detail, settings, .. } = arguments;
        let settings: Vec<String> = settings.iter().map(|(key, value)| format!("{key}={value}")).collect();
        let settings = if settings.is_empty() { "as shipped".to_owned() } else { settings.join(" ") };
        let command = [
            ("program", journal::program()),
            ("scene", scene(arguments).to_owned()),
            ("quality", start.setup.preset.name().to_owned()),
            ("detail", detail.unwrap_or(1.0).to_string()),
            ("settings", settings),
            ("start", format!("{:016x}", hash_bytes(&start.encode()))),
            ("seed", seed.to_string()),
            ("minutes", minutes.to_string()),
        ];
        let command = command.map(|(name, value)| (name.to_owned(), value)).to_vec();
        Self { start, minutes: *minutes, command }
    }

    fn told(&self, name: &str) -> &str {
        self.command.iter().find(|(key, _)| key == name).map_or("", |(_, value)| value)
    }

    fn text(&self, report: &Report, hash: u64) -> String {
        let [scene, quality, detail, settings, seed] =
            ["scene", "quality", "detail", "settings", "seed"].map(|name| self.told(name));
        let (hours, seconds) = (report.minutes as f64 / 60.0, report.seconds());
        let verdict = if report.faults().is_empty() { "sound" } else { "NOT sound" };
        format!(
            "{}{scene} at {quality}, detail {detail}, settings {settings}, seed {seed}: {hours:.2} h of simulated time in \
             {seconds:.0} s, hash {hash:016x}: {verdict}\n",
            report.text()
        )
    }

    fn figures(&self, report: &Report, hash: u64) -> Value {
        let [scene, quality, detail, settings, seed] =
            ["scene", "quality", "detail", "settings", "seed"].map(|name| self.told(name));
        let creeps: Vec<Creep> = report.creeps().into_iter().flatten().collect();
        let not_judged: Vec<(&str, &str)> = report.creeps().into_iter().filter_map(Result::err).collect();
        json!({
            "scene": scene, "quality": quality, "detail": detail, "settings": settings, "seed": seed,
            "minutes": report.minutes, "minutes_wanted": self.minutes, "wall_seconds": report.seconds(),
            "sittings": report.sittings, "resumed": report.sittings.len() > 1, "hash": format!("{hash:016x}"),
            "periods": report.periods, "rock": [report.rock_before, report.rock_after], "turned": report.turned, "counters": report.counters,
            "creeps": creeps, "not_judged": not_judged, "faults": report.faults(),
        })
    }
}

/// The journal of this soak.
struct Journal<'a> {
    path: &'a Path,
    file: StateFile,
    /// What was left to go on from.
    left: Option<Entry>,
}

impl<'a> Journal<'a> {
    /// Opens a journal; one of another soak is refused.
    fn open(path: &'a Path, subject: &Subject) -> Result<Self, Failure> {
        let (file, bytes) = StateFile::open(path)?;
        if bytes.is_empty() {
            return Ok(Self { path, file, left: None });
        }
        let other = |what: &dyn std::fmt::Display| {
            bad(
                path,
                &format_args!("{what}; allowed: the journal of the same command, or a file that is not there yet"),
            )
        };
        let entry = Entry::decode(&bytes).map_err(|error| other(&error))?;
        if let Some([name, was, is]) = entry.differs(&subject.command) {
            return Err(other(&format_args!("the journal of another soak: its {name} is {was}, this one's {is}")));
        }
        Ok(Self { path, file, left: Some(entry) })
    }

    /// Keeps what it takes to go on from here. A world that no save holds leaves the entry before.
    fn note(&mut self, soak: &Soak, subject: &Subject) -> Result<(), Failure> {
        soak.entry(&subject.command).map_or(Ok(()), |entry| self.file.replace(&entry.encode()))
    }
}
