//! The journal of a running game: its newest state and what happened since then, in a file that is always whole up to
//! the last half second. Written by a thread of its own; the game only copies what is new.
//!
//! A state comes every 30 s of the world's time (see `sim::recorder`) and takes the place of the one before in one step.
//! The file is locked as long as the game lives, so that another game knows whose it is. While the disk is full it stays as
//! it was; the first state for which there is room again goes on.

use crate::{
    game::toasts::Toasts,
    sim::{
        new_file::{NewFile, Unwritten},
        recorder::{Cursor, News, Recorder},
        recording::{End, RECORDING_ENDING, Writer},
    },
};
use bevy::{
    log::error,
    prelude::{App, Last, Res, ResMut, Resource},
};
use std::{
    fs::{self, File, OpenOptions},
    io::{self, Write},
    mem,
    path::{Path, PathBuf},
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        mpsc::{Receiver, Sender, channel},
    },
    thread::{self, JoinHandle},
    time::{Duration, Instant},
};
use tr::tr;

/// What the names of journals begin with.
pub const PREFIX: &str = "running-";
/// Most games of one user that may run at once.
const MOST_GAMES: u32 = 64;
/// Time from one writing to the next: so much input is lost with the machine.
const EVERY: Duration = Duration::from_millis(500);

enum Message {
    News(Box<News>),
    End(End),
}

/// A journal that is written.
#[derive(Debug)]
pub struct Journal {
    recorder: Recorder,
    cursor: Cursor,
    path: PathBuf,
    sender: Option<Sender<Message>>,
    thread: Option<JoinHandle<bool>>,
    /// Why the thread can't write, until that is told.
    fault: Arc<Mutex<Option<Unwritten>>>,
    written: Instant,
}

/// The journal, for the game and for what comes after it.
#[derive(Resource, Clone, Debug)]
pub struct SharedJournal(Arc<Mutex<Journal>>);

impl Journal {
    /// Begins a journal in a folder, which is made if there is none. Nothing if that can't be: the game goes on without.
    pub fn begin(folder: &Path, recorder: Recorder) -> Option<SharedJournal> {
        let (path, file) = match claim(folder) {
            Ok(claimed) => claimed,
            Err(error) => {
                error!("{}: no journal can be kept there: {error}", folder.display());
                return None;
            }
        };
        let (sender, messages) = channel();
        let fault = Arc::<Mutex<Option<Unwritten>>>::default();
        let pen = Pen { path: path.clone(), file, writer: Writer::new(), whole: true, fault: fault.clone() };
        let thread = thread::Builder::new().name("journal".to_owned()).spawn(move || pen.write(&messages));
        let thread = thread.map_err(|error| error!("the journal can't be kept: {error}")).ok()?;
        let (sender, thread) = (Some(sender), Some(thread));
        let journal =
            Self { recorder, cursor: Cursor::default(), path, sender, thread, fault, written: Instant::now() };
        Some(SharedJournal(Arc::new(Mutex::new(journal))))
    }

    /// Hands what is new to the thread.
    fn tell_news(&mut self) {
        self.written = Instant::now();
        if let Some(news) = self.recorder.news(&mut self.cursor) {
            self.tell(Message::News(Box::new(news)));
        }
    }

    fn tell(&mut self, message: Message) {
        // The thread is there as long as the sender is, unless it panicked: then there is nobody to tell.
        let _ = self.sender.as_ref().map(|sender| sender.send(message));
    }

    /// Waits until all is written and the lock is free; whether it could be.
    fn join(&mut self) -> bool {
        self.sender = None;
        self.thread.take().is_some_and(|thread| thread.join().unwrap_or(false))
    }

    /// Why it can't be written, once.
    fn fault(&self) -> Option<Unwritten> {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl SharedJournal {
    fn lock(&self) -> MutexGuard<'_, Journal> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the journal of a game that ended well: nothing is left of it.
    pub fn forget(&self) {
        let mut journal = self.lock();
        journal.join();
        if let Err(error) = fs::remove_file(&journal.path) {
            error!("{}: the journal can't be removed: {error}", journal.path.display());
        }
    }

    /// Ends the journal of a game that crashed; whether it is whole.
    pub fn close(&self) -> bool {
        let mut journal = self.lock();
        journal.tell_news();
        journal.tell(Message::End(End::Crashed));
        journal.join()
    }

    /// Where it is.
    #[cfg(test)]
    pub fn path(&self) -> PathBuf {
        self.lock().path.clone()
    }
}

/// Keeps the journal up while the game runs.
pub fn follow(app: &mut App) {
    app.add_systems(Last, keep_up);
}

fn keep_up(journal: Res<SharedJournal>, mut toasts: ResMut<Toasts>) {
    let mut journal = journal.lock();
    if journal.written.elapsed() >= EVERY {
        journal.tell_news();
    }
    if let Some(fault) = journal.fault() {
        toasts.warn(tr!("Played on, but a crash would lose it: {}", fault));
    }
}

/// A file of our own, locked, and its path.
fn claim(folder: &Path) -> io::Result<(PathBuf, File)> {
    fs::create_dir_all(folder)?;
    for number in 0..MOST_GAMES {
        let path = folder.join(format!("{PREFIX}{number}.{RECORDING_ENDING}"));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            // Whoever was quicker to lock it takes it for one that was left.
            Ok(file) if file.try_lock().is_ok() => return Ok((path, file)),
            Ok(_) => {}
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::other("too many games run, or were left"))
}

/// What the thread has in hand.
struct Pen {
    path: PathBuf,
    /// Locked.
    file: File,
    writer: Writer,
    /// Whether all that came is in the file.
    whole: bool,
    fault: Arc<Mutex<Option<Unwritten>>>,
}

impl Pen {
    /// Writes what it is sent, to the last message; whether the file has all of it.
    fn write(mut self, messages: &Receiver<Message>) -> bool {
        while let Ok(message) = messages.recv() {
            if let Err(error) = self.take(message)
                // It is told once until it is whole again.
                && mem::replace(&mut self.whole, false)
            {
                let fault = Unwritten { path: self.path.clone(), error };
                error!("{fault}");
                *self.fault.lock().unwrap_or_else(PoisonError::into_inner) = Some(fault);
            }
        }
        self.whole
    }

    fn take(&mut self, message: Message) -> io::Result<()> {
        match message {
            Message::News(news) => {
                let News { start, entries, marks } = *news;
                if let Some(start) = start {
                    self.writer = Writer::new();
                    self.writer.start(&start.encode());
                    self.writer.ticks(&entries, &marks);
                    self.file = replace(&self.path, &self.writer.take())?;
                    self.whole = true;
                    return Ok(());
                }
                self.writer.ticks(&entries, &marks);
            }
            Message::End(end) => self.writer.end(end),
        }
        let bytes = self.writer.take();
        // What follows on a gap is of no use.
        if self.whole { self.file.write_all(&bytes) } else { Ok(()) }
    }
}

/// Puts a new file in the place of the old one, in one step, and keeps it open and locked.
fn replace(path: &Path, bytes: &[u8]) -> io::Result<File> {
    let mut file = NewFile::create(path)?;
    file.file().try_lock()?;
    file.write_all(bytes)?;
    file.finish()
}
