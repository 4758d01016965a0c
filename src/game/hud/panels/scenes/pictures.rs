//! The pictures of the gallery. Each is a world of its own that is run up to the moment at which it looks its best, in the
//! background, one after the other, those in sight first; the one that is looked at goes on from there. While the gallery is
//! closed nothing of it is kept, and nothing runs.

use super::menu::Entry;
use crate::{
    game::hud::live_picture::{LivePicture, Screen, Shown},
    lab::{
        jobs::{Handle, Share},
        miniature::{Progress, run_up},
    },
    scene::SceneFile,
};
use bevy::prelude::Resource;
use bevy_egui::egui::TextureId;
use std::{
    collections::{BTreeMap, BTreeSet},
    sync::{Arc, atomic::AtomicU64},
};

/// What there is of pictures.
#[derive(Resource, Default)]
pub struct Pictures {
    shown: BTreeMap<String, Shown>,
    /// Scenes whose pictures are made, or can't be.
    done: BTreeSet<String>,
    /// Makes a picture.
    still: Option<RunUp>,
    /// Makes the one that is looked at ready to move.
    coming: Option<RunUp>,
    moving: Option<Moving>,
    /// Ticks of all of them so far.
    ticks: Arc<AtomicU64>,
}

/// A run-up in the background.
struct RunUp {
    call: String,
    handle: Handle<Progress>,
}

impl RunUp {
    fn of(entry: &Entry, ticks: &Arc<AtomicU64>) -> Self {
        let (scene, ticks): (SceneFile, _) = (entry.scene.clone(), ticks.clone());
        let handle = Handle::start(Share::Half, move |sender| run_up(scene, ticks, sender));
        Self { call: entry.call.clone(), handle }
    }
}

/// The one that moves.
struct Moving {
    call: String,
    picture: LivePicture,
}

impl Pictures {
    /// The picture of a scene, if there is one yet.
    pub(super) fn of(&self, call: &str) -> Option<TextureId> {
        self.shown.get(call).map(|shown| shown.id)
    }

    /// Whether a picture is in the making or moves.
    pub fn is_busy(&self) -> bool {
        self.still.is_some() || self.coming.is_some() || self.moving.is_some()
    }

    /// Whether anything of it is kept.
    pub(super) fn is_empty(&self) -> bool {
        !self.is_busy() && self.shown.is_empty() && self.done.is_empty()
    }

    /// Goes on for a frame of `seconds`. `wanted` are the scenes in sight, the first one first; `focus` is the one that is
    /// looked at.
    pub(super) fn advance(&mut self, screen: &mut Screen, wanted: &[&Entry], focus: Option<&Entry>, seconds: f32) {
        self.look_at(focus);
        if self.still.is_none() {
            let next = wanted.iter().find(|entry| !self.done.contains(&entry.call));
            self.still = next.map(|entry| RunUp::of(entry, &self.ticks));
        }
        let (still, coming) = (self.still.take(), self.coming.take());
        // A picture in the making goes on; of one that moves, or is about to, the other run-up shows nothing.
        self.still = still.and_then(|run_up| self.take(screen, run_up, false));
        self.coming = coming.and_then(|run_up| self.take(screen, run_up, true));
        self.run(screen, seconds);
    }

    /// Lets go of what is no longer looked at, and makes ready what is.
    fn look_at(&mut self, focus: Option<&Entry>) {
        let call = focus.map(|entry| entry.call.as_str());
        self.moving.take_if(|moving| Some(moving.call.as_str()) != call);
        self.coming.take_if(|coming| Some(coming.call.as_str()) != call);
        if let Some(entry) = focus
            && self.moving.is_none()
            && self.coming.is_none()
            && !self.fails(entry)
        {
            self.coming = Some(RunUp::of(entry, &self.ticks));
        }
    }

    /// Whether it is known that a scene has no picture.
    fn fails(&self, entry: &Entry) -> bool {
        self.done.contains(&entry.call) && !self.shown.contains_key(&entry.call)
    }

    /// Takes what a run-up tells; gives it back if it goes on.
    fn take(&mut self, screen: &mut Screen, mut run_up: RunUp, is_looked_at: bool) -> Option<RunUp> {
        for told in run_up.handle.advance() {
            match told {
                // What has its picture keeps it until it moves.
                Progress::Picture(picture) if !self.done.contains(&run_up.call) => {
                    self.show(screen, &run_up.call, &picture);
                }
                Progress::Picture(_) => {}
                Progress::Ready(miniature, picture) => {
                    if is_looked_at {
                        let call = run_up.call.clone();
                        self.moving = Some(Moving { call, picture: LivePicture::new(miniature) });
                    }
                    self.show(screen, &run_up.call, &picture);
                    self.done.insert(run_up.call.clone());
                }
                Progress::Failed(_) => drop(self.done.insert(run_up.call.clone())),
            }
        }
        (!run_up.handle.is_over()).then_some(run_up)
    }

    /// Goes on with the one that moves.
    fn run(&mut self, screen: &mut Screen, seconds: f32) {
        let Some(moving) = &mut self.moving else { return };
        if let Some(picture) = moving.picture.run(seconds)
            && let Some(shown) = self.shown.get(&moving.call)
        {
            screen.change(shown, picture);
        }
    }

    fn show(&mut self, screen: &mut Screen, call: &str, picture: &[u8]) {
        match self.shown.get(call) {
            Some(shown) => screen.change(shown, picture),
            None => drop(self.shown.insert(call.to_owned(), screen.add(picture))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{super::menu::SceneMenu, *};
    use crate::kernel::units::TICK_SECONDS;
    use bevy::{asset::Assets, platform::time::Instant};
    use bevy_egui::EguiUserTextures;
    use std::{sync::atomic::Ordering, thread, time::Duration};

    fn entry<'a>(menu: &'a SceneMenu, call: &str) -> &'a Entry {
        menu.entries.iter().find(|entry| entry.call == call).expect("it comes with the game")
    }

    /// Goes on for a frame.
    fn advance(pictures: &mut Pictures, wanted: &[&Entry], focus: Option<&Entry>, seconds: f32) {
        let (mut images, mut textures) = (Assets::default(), EguiUserTextures::default());
        pictures.advance(&mut Screen { images: &mut images, textures: &mut textures }, wanted, focus, seconds);
    }

    /// Goes on until something is so.
    fn wait(pictures: &mut Pictures, wanted: &[&Entry], focus: Option<&Entry>, until: impl Fn(&Pictures) -> bool) {
        let begun = Instant::now();
        while !until(pictures) {
            advance(pictures, wanted, focus, TICK_SECONDS);
            thread::sleep(Duration::from_millis(1));
            assert!(begun.elapsed() < Duration::from_secs(60), "it takes too long");
        }
    }

    fn ticks(pictures: &Pictures) -> u64 {
        pictures.ticks.load(Ordering::Relaxed)
    }

    #[test]
    fn pictures_come_in_order_and_then_nothing_runs() {
        let menu = SceneMenu::of_game();
        let wanted = ["dam_break", "hydrostatic"].map(|call| entry(&menu, call));
        let mut pictures = Pictures::default();
        wait(&mut pictures, &wanted, None, |pictures| pictures.of("dam_break").is_some());
        assert!(pictures.of("hydrostatic").is_none(), "one after the other");
        wait(&mut pictures, &wanted, None, |pictures| pictures.done.len() == 2 && !pictures.is_busy());
        let ran = ticks(&pictures);
        assert_eq!(ran, 66 + 60, "each up to its moment");
        (0..50).for_each(|_| advance(&mut pictures, &wanted, None, TICK_SECONDS));
        assert_eq!(ticks(&pictures), ran, "they stand");
    }

    #[test]
    fn what_is_looked_at_moves_in_step_with_time_and_stops_when_it_is_left() {
        let menu = SceneMenu::of_game();
        let focus = Some(entry(&menu, "dam_break"));
        let mut pictures = Pictures::default();
        wait(&mut pictures, &[], focus, |pictures| pictures.moving.is_some());
        assert!(!pictures.is_empty());
        let before = ticks(&pictures);
        (0..30).for_each(|_| advance(&mut pictures, &[], focus, 0.5 * TICK_SECONDS));
        let ran = ticks(&pictures) - before;
        assert!((14..=16).contains(&ran), "{ran} ticks in the time of 15");
        advance(&mut pictures, &[], focus, 10.0);
        assert!(ticks(&pictures) - before - ran <= 4, "a late frame is not made up for");
        advance(&mut pictures, &[], None, TICK_SECONDS);
        assert!(!pictures.is_busy());
    }

    #[test]
    fn what_is_let_go_of_runs_no_more() {
        let menu = SceneMenu::of_game();
        let mut pictures = Pictures::default();
        let (wanted, focus) = (entry(&menu, "layers"), Some(entry(&menu, "volcano")));
        wait(&mut pictures, &[wanted], focus, |pictures| ticks(pictures) > 0 && pictures.still.is_some());
        let counter = pictures.ticks.clone();
        pictures = Pictures::default();
        assert!(pictures.is_empty());
        // A tick that has begun ends; of the two threads each has one.
        let begun = Instant::now();
        while Arc::strong_count(&counter) > 1 {
            assert!(begun.elapsed() < Duration::from_secs(20), "a run-up goes on");
        }
        let ran = counter.load(Ordering::Relaxed);
        thread::sleep(Duration::from_millis(50));
        assert_eq!(counter.load(Ordering::Relaxed), ran);
    }
}
