//! The exam in the background of the game: a thread of its own, or, where there are none, a slice of each frame. It
//! simulates worlds of its own and leaves the one that is played alone.

use crate::{
    lab::exam::{case::CASES, job::Job, job::jobs},
    sim::exam::{ExamDesk, Progress, Row},
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

/// Sits the exam when the desk wants one, and lays its rows there.
pub fn plugin(app: &mut App) {
    app.init_resource::<ExamDesk>().init_resource::<Examiner>().add_systems(Update, attend);
    #[cfg(target_arch = "wasm32")]
    app.add_systems(Update, slices::go_on);
}

/// What the one who sits the exam tells.
enum Note {
    /// A job is begun: how many are done, of how many, what it is.
    Begun(usize, usize, String),
    /// A job is done.
    Rows(Vec<Row>),
    /// All are done.
    Done,
    /// It can't go on.
    Broken(String),
}

/// Who sits the exam, if one runs.
#[derive(Resource, Default)]
struct Examiner {
    running: Option<Running>,
}

struct Running {
    /// Held so that it is stopped when it is let go.
    _sitting: Sitting,
    notes: Mutex<Receiver<Note>>,
}

/// Begins, follows and stops the exam.
fn attend(mut desk: ResMut<ExamDesk>, mut examiner: ResMut<Examiner>) {
    let is_wanted = desk.wanted.is_some();
    match (&examiner.running, &desk.wanted) {
        (None, Some(presets)) => {
            let (notes, received) = channel();
            let jobs = jobs(CASES, |_| true, presets);
            let of = jobs.len();
            let begun = Sitting::begin(jobs, notes);
            desk.rows.clear();
            match begun {
                Ok(sitting) => {
                    desk.progress = Progress::Running { done: 0, of, now: String::new() };
                    examiner.running = Some(Running { _sitting: sitting, notes: Mutex::new(received) });
                }
                Err(why) => (desk.wanted, desk.progress) = (None, Progress::Broken(why)),
            }
        }
        (Some(_), None) => {
            examiner.running = None;
            desk.progress = Progress::Stopped;
        }
        _ => {}
    }
    if !is_wanted {
        return;
    }
    let Some(running) = &examiner.running else { return };
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
        examiner.running = None;
    }
}

/// Sits the jobs one after the other.
async fn sit(jobs: Vec<Job>, notes: Sender<Note>) {
    let of = jobs.len();
    // Nobody listens any more: then nobody needs the rest.
    for (done, job) in jobs.into_iter().enumerate() {
        if notes.send(Note::Begun(done, of, job.title())).is_err() {
            return;
        }
        let note = match job.sit().await {
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
    use crate::kernel::params::Preset;
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
        app.add_plugins(plugin);
        app.update();
        assert_eq!(*app.world().resource::<ExamDesk>(), ExamDesk::default(), "nobody asked");
        app.world_mut().resource_mut::<ExamDesk>().wanted = Some(vec![Preset::Draft]);
        wait(&mut app, |desk| !desk.rows.is_empty());
        let desk = app.world().resource::<ExamDesk>();
        assert_eq!(desk.rows[0].case, CASES[0].name);
        assert!(matches!(desk.progress, Progress::Running { of, .. } if of == CASES.len()), "{:?}", desk.progress);
        app.world_mut().resource_mut::<ExamDesk>().wanted = None;
        wait(&mut app, |desk| desk.progress == Progress::Stopped);
        assert!(app.world().resource::<Examiner>().running.is_none(), "the thread was not let go");
    }
}
