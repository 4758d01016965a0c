//! Long work in the background of the game: a thread of its own, or, where there are none, a slice of each frame. It
//! simulates worlds of its own and leaves the one that is played alone.

use crate::{
    kernel::params::Preset,
    scene::SceneError,
    sim::desk::{Desk, Progress},
};
use bevy::prelude::{App, DetectChangesMut, ResMut, Resource, Update};
use std::sync::{
    Mutex, PoisonError,
    mpsc::{Receiver, Sender, TryRecvError, channel},
};

#[cfg(any(test, target_arch = "wasm32"))]
mod slices;
#[cfg(not(target_arch = "wasm32"))]
mod thread;

#[cfg(target_arch = "wasm32")]
use slices::Sitting;
#[cfg(not(target_arch = "wasm32"))]
use thread::Sitting;

/// A piece of such work: a case of the exam or of the gauntlet.
pub(super) trait Task: Sized + Send + 'static {
    /// What comes of it.
    type Row: Send + Sync + 'static;

    /// Everything that there is to do at these qualities.
    fn all(presets: &[Preset]) -> Vec<Self>;

    /// What is said while it runs.
    fn title(&self) -> String;

    /// Does it. Yields now and then.
    fn run(self) -> impl Future<Output = Result<Vec<Self::Row>, SceneError>>;
}

/// Does the work when its desk wants it, and lays its rows there.
pub(super) fn plugin<T: Task>(app: &mut App) {
    app.init_resource::<Desk<T::Row>>().init_resource::<Worker<T>>().add_systems(Update, attend::<T>);
    #[cfg(target_arch = "wasm32")]
    app.add_systems(Update, slices::go_on::<T>);
}

/// What the one who works tells.
enum Note<R> {
    /// A task is begun: how many are done, of how many, what it is.
    Begun(usize, usize, String),
    /// A task is done.
    Rows(Vec<R>),
    /// All are done.
    Done,
    /// It can't go on.
    Broken(String),
}

/// Who works, if somebody does.
#[derive(Resource)]
struct Worker<T: Task> {
    running: Option<Running<T>>,
}

impl<T: Task> Default for Worker<T> {
    fn default() -> Self {
        Self { running: None }
    }
}

struct Running<T: Task> {
    /// Held so that it is stopped when it is let go.
    _sitting: Sitting<T>,
    notes: Mutex<Receiver<Note<T::Row>>>,
}

/// Begins, follows and stops the work.
fn attend<T: Task>(mut desk: ResMut<Desk<T::Row>>, mut worker: ResMut<Worker<T>>) {
    let is_wanted = desk.wanted.is_some();
    match (&worker.running, &desk.wanted) {
        (None, Some(presets)) => {
            let (notes, received) = channel();
            let tasks = T::all(presets);
            let of = tasks.len();
            let begun = Sitting::begin(tasks, notes);
            desk.rows.clear();
            match begun {
                Ok(sitting) => {
                    desk.progress = Progress::Running { done: 0, of, now: String::new() };
                    worker.running = Some(Running { _sitting: sitting, notes: Mutex::new(received) });
                }
                Err(why) => (desk.wanted, desk.progress) = (None, Progress::Broken(why)),
            }
        }
        (Some(_), None) => {
            worker.running = None;
            desk.progress = Progress::Stopped;
        }
        _ => {}
    }
    if !is_wanted {
        return;
    }
    let Some(running) = &worker.running else { return };
    let notes = running.notes.lock().unwrap_or_else(PoisonError::into_inner);
    loop {
        match notes.try_recv() {
            Ok(Note::Begun(done, of, now)) => desk.progress = Progress::Running { done, of, now },
            Ok(Note::Rows(rows)) => desk.rows.extend(rows),
            Ok(Note::Done) => (desk.wanted, desk.progress) = (None, Progress::Done),
            Ok(Note::Broken(why)) => (desk.wanted, desk.progress) = (None, Progress::Broken(why)),
            Err(TryRecvError::Empty) => break,
            Err(TryRecvError::Disconnected) => {
                if desk.wanted.is_some() {
                    (desk.wanted, desk.progress) = (None, Progress::Broken("it ended before its time".into()));
                }
                break;
            }
        }
    }
    drop(notes);
    if desk.bypass_change_detection().wanted.is_none() {
        worker.running = None;
    }
}

/// Does the tasks one after the other.
async fn work<T: Task>(tasks: Vec<T>, notes: Sender<Note<T::Row>>) {
    let of = tasks.len();
    // Nobody listens any more: then nobody needs the rest.
    for (done, task) in tasks.into_iter().enumerate() {
        if notes.send(Note::Begun(done, of, task.title())).is_err() {
            return;
        }
        let note = match task.run().await {
            Ok(rows) => Note::Rows(rows),
            Err(error) => Note::Broken(error.to_string()),
        };
        if notes.send(note).is_err() {
            return;
        }
    }
    let _ = notes.send(Note::Done);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::params::Preset,
        lab::exam::{CASES, Job},
        sim::exam::ExamDesk,
    };
    use std::time::Duration;

    /// Lets the examiner work until `until` holds, for half a minute at most.
    fn wait(app: &mut App, until: impl Fn(&ExamDesk) -> bool) {
        for _ in 0..6000 {
            app.update();
            if until(app.world().resource::<ExamDesk>()) {
                return;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("{:?}", app.world().resource::<ExamDesk>());
    }

    #[test]
    fn rows_come_to_the_desk_until_it_is_stopped() {
        let mut app = App::new();
        app.add_plugins(plugin::<Job>);
        app.update();
        assert_eq!(*app.world().resource::<ExamDesk>(), ExamDesk::default(), "nobody asked");
        app.world_mut().resource_mut::<ExamDesk>().wanted = Some(vec![Preset::Draft]);
        wait(&mut app, |desk| !desk.rows.is_empty());
        let desk = app.world().resource::<ExamDesk>();
        assert_eq!(desk.rows[0].case, CASES[0].name);
        assert!(matches!(desk.progress, Progress::Running { of, .. } if of == CASES.len()), "{:?}", desk.progress);
        app.world_mut().resource_mut::<ExamDesk>().wanted = None;
        wait(&mut app, |desk| desk.progress == Progress::Stopped);
        assert!(app.world().resource::<Worker<Job>>().running.is_none(), "the thread was not let go");
    }
}
