//! Copies out of the world what a frame needs, once a frame, and packs it.

use crate::{
    game::{
        camera::{Area, WorldCamera},
        lens::Lens,
        render::{
            cost::RenderCost,
            level::PictureLevel,
            picture::Picture,
            scene::{Scene, Sight, Within},
        },
        views::table::Shown,
    },
    kernel::units::TICK_SECONDS,
    lab::{difference::Difference, split::Split},
    sim::pace::Pace,
};
use bevy::{
    platform::time::Instant,
    prelude::{Fixed, Res, ResMut, Resource, Time, With},
    render::MainWorld,
    window::{PrimaryWindow, Window},
};
use glam::UVec2;

/// Ticks after which the time of what drifts by itself begins again: an hour, so that it stays exact.
const WRAP: u64 = 60 * 60 * 60;

/// One frame's pictures, on the processor's side: the world's, and in an A/B split the second world's and the
/// difference's, or the second world's in the ring of the truth lens.
#[derive(Resource, Default)]
pub struct Pictures {
    panes: [Picture; 3],
    count: usize,
    difference: Difference,
}

impl Pictures {
    /// The pictures of this frame.
    pub fn shown(&self) -> &[Picture] {
        &self.panes[..self.count]
    }

    /// Lets the memory go of those that are no longer shown.
    fn let_go(&mut self) {
        let idle = self.panes[self.count..].iter_mut().filter(|picture| picture.size != UVec2::ONE);
        idle.for_each(|picture| *picture = Picture::default());
    }

    /// The same, to hand them over.
    pub fn shown_mut(&mut self) -> &mut [Picture] {
        &mut self.panes[..self.count]
    }
}

/// Makes of what was copied what the graphics read, while the worlds may go on.
pub fn pack(mut pictures: ResMut<Pictures>, cost: Res<RenderCost>) {
    let begin = Instant::now();
    pictures.shown_mut().iter_mut().for_each(Picture::pack);
    RenderCost::note_time(&cost.pack, begin.elapsed());
}

/// Copies the worlds out.
pub fn extract(main: Res<MainWorld>, mut pictures: ResMut<Pictures>, cost: Res<RenderCost>) {
    let begin = Instant::now();
    pictures.count = 0;
    let windows = main.try_query_filtered::<&Window, With<PrimaryWindow>>();
    let window = windows.and_then(|mut windows| windows.single(&main).ok());
    let (Some(first), Some(window)) = (Scene::of(&main), window) else { return };
    if window.resolution.physical_size().min_element() == 0 {
        return;
    }
    // Half a tick after a tick the world is drawn half a tick before it: it then moves evenly at any frame rate.
    let late = main.resource::<Time<Fixed>>().overstep_fraction().clamp(0.0, 1.0);
    let back = if main.resource::<Pace>().stands() { 0.0 } else { TICK_SECONDS * (1.0 - late) };
    // Clouds stand while the world does.
    let time = (first.tick % WRAP) as f32 * TICK_SECONDS - back;
    let camera = main.resource::<WorldCamera>();
    let sight = Sight {
        window,
        camera,
        view: main.resource::<Shown>().0,
        back,
        time,
        level: main.resource::<PictureLevel>().now(),
    };
    let Pictures { panes: [a, b, c], count, difference } = &mut *pictures;
    let areas: Vec<Area> = camera.panes().collect();
    let own = |second: Scene<'_>| {
        // Its d may be another one.
        let (size, factor) = (second.setup.blueprint.domain.size, second.setup.blueprint.scale.detail);
        let mut own = *camera;
        own.rescale(size, factor / first.setup.blueprint.scale.detail);
        own
    };
    let ring = main.resource::<Lens>().ring(camera);
    match (main.resource::<Split>().world().and_then(Scene::of), areas.as_slice(), ring) {
        (Some(second), _, Some(ring)) => {
            // The second world has no tracers.
            a.fill(Scene { tracers: None, ..first }, sight, camera.free(), Within::Window);
            b.fill(second, Sight { camera: &own(second), ..sight }, camera.free(), Within::Ring(ring));
            *count = 2;
        }
        (Some(second), &[at_a, at_b, at_c], None) => {
            a.fill(Scene { tracers: None, ..first }, sight, at_a, Within::Area);
            b.fill(second, Sight { camera: &own(second), ..sight }, at_b, Within::Area);
            difference.measure(&first.setup.blueprint, first.half(), second.half());
            c.fill_with_difference(difference, first, sight, at_c);
            *count = 3;
        }
        _ => {
            a.fill(first, sight, camera.free(), Within::Window);
            *count = 1;
        }
    }
    pictures.let_go();
    RenderCost::note_time(&cost.extract, begin.elapsed());
}
