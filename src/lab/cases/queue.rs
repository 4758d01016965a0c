//! The cases of a suite in the background of the game: on a thread of its own, or, where there are none, in a slice of each
//! frame. They simulate worlds of their own and leave the one that is played alone.

use crate::{
    kernel::params::Preset,
    lab::{
        cases::{
            case::{Case, Size},
            job::{Job, jobs},
            row::Row,
        },
        jobs::{Handle, Share},
    },
};
use bevy::prelude::{App, DetectChangesMut, ResMut, Resource, Update};
use std::sync::mpsc::Sender;

/// How far the work has come.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Progress {
    /// Not asked for yet.
    #[default]
    Idle,
    /// It runs.
    Running {
        /// Jobs done: cases, each in one setting.
        done: usize,
        /// Jobs in all.
        of: usize,
        /// What is simulated now.
        now: String,
    },
    /// All rows are there.
    Done,
    /// It was stopped before its end.
    Stopped,
    /// It can't go on: why.
    Broken(String),
}

/// The jobs of a suite in the background, one after the other, and their rows.
#[derive(Resource)]
pub struct JobQueue<C: Case> {
    handle: Option<Handle<Message<C>>>,
    progress: Progress,
    rows: Vec<Row<C::Figures>>,
}

impl<C: Case> Default for JobQueue<C> {
    fn default() -> Self {
        Self { handle: None, progress: Progress::Idle, rows: Vec::new() }
    }
}

/// What the work reports: how far it is, and the rows since the last message.
type Message<C> = (Progress, Vec<Row<<C as Case>::Figures>>);

/// Keeps a queue of the suite's jobs.
pub fn plugin<C: Case>(app: &mut App) {
    app.init_resource::<JobQueue<C>>().add_systems(Update, follow::<C>);
}

impl<C: Case> JobQueue<C> {
    /// Begins all cases that are not too long at these qualities. What runs is stopped, what was found is forgotten.
    pub fn begin(&mut self, presets: &[Preset]) {
        let jobs = jobs((C::SUITE.cases)(), |case| case.about().size < Size::Long, presets, 1.0);
        let progress = Progress::Running { done: 0, of: jobs.len(), now: String::new() };
        let handle = Some(Handle::start(Share::Whole, |messages| run(jobs, messages)));
        *self = Self { handle, progress, rows: Vec::new() };
    }

    /// Stops what runs.
    pub fn stop(&mut self) {
        if self.handle.take().is_some() {
            self.progress = Progress::Stopped;
        }
    }

    /// Whether anything runs.
    pub fn is_running(&self) -> bool {
        self.handle.is_some()
    }

    /// How far it has come.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// The rows that are there, in the order in which they came.
    pub fn rows(&self) -> &[Row<C::Figures>] {
        &self.rows
    }

    /// Works a slice where there is no thread, and takes in the messages.
    fn advance(&mut self) {
        let Some(handle) = &mut self.handle else { return };
        for (progress, rows) in handle.advance() {
            self.progress = progress;
            self.rows.extend(rows);
        }
        if handle.is_over() {
            self.handle = None;
            if let Progress::Running { .. } = self.progress {
                self.progress = Progress::Broken("it ended before its time".into());
            }
        }
    }
}

fn follow<C: Case>(mut queue: ResMut<JobQueue<C>>) {
    queue.bypass_change_detection().advance();
}

/// Runs the jobs one after the other.
async fn run<C: Case>(jobs: Vec<Job<C>>, messages: Sender<Message<C>>) {
    let of = jobs.len();
    let mut rows = Vec::new();
    for (done, job) in jobs.into_iter().enumerate() {
        // Without a receiver the work was stopped.
        if messages.send((Progress::Running { done, of, now: job.title() }, std::mem::take(&mut rows))).is_err() {
            return;
        }
        match job.run().await {
            Ok(found) => rows = found,
            Err(error) => {
                let _ = messages.send((Progress::Broken(error.to_string()), rows));
                return;
            }
        }
    }
    let _ = messages.send((Progress::Done, rows));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::exam::{CASES, ExamCase};
    use std::time::Duration;

    /// Lets the queue work until `until` holds, for half a minute at most.
    fn wait(app: &mut App, until: impl Fn(&JobQueue<ExamCase>) -> bool) {
        for _ in 0..6000 {
            app.update();
            if until(app.world().resource()) {
                return;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("{:?}", app.world().resource::<JobQueue<ExamCase>>().progress);
    }

    #[test]
    fn rows_come_until_it_is_stopped() {
        let mut app = App::new();
        app.add_plugins(plugin::<ExamCase>);
        app.update();
        let mut queue = app.world_mut().resource_mut::<JobQueue<ExamCase>>();
        assert_eq!(*queue.progress(), Progress::Idle, "nothing was asked for");
        queue.begin(&[Preset::Draft]);
        wait(&mut app, |queue| !queue.rows().is_empty());
        let queue = app.world_mut().resource_mut::<JobQueue<ExamCase>>().into_inner();
        assert_eq!(queue.rows()[0].case, CASES[0].name);
        let short = CASES.iter().filter(|case| case.size != Size::Long).count();
        assert!(matches!(queue.progress, Progress::Running { of, .. } if of == short), "{:?}", queue.progress);
        queue.stop();
        assert_eq!((queue.progress(), queue.is_running()), (&Progress::Stopped, false));
        app.update();
        assert_eq!(*app.world().resource::<JobQueue<ExamCase>>().progress(), Progress::Stopped);
    }
}
