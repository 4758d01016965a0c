//! The picture without a window: a world that is drawn into an image, for `bench frame` and for tests of what is seen.

use crate::{
    game::{
        GamePlugin,
        camera::{Area, WorldCamera},
        render::{
            WorldRenderPlugin,
            cost::{PicturePass, RenderCost, Repeat},
            level::{Level, PictureLevel},
        },
        views::table::{Shown, View},
    },
    lab::colours::Rgb,
    sim::{SimulationPlugin, checkpoint::Checkpoint, fault, generation::Generation, pace::Pace, state::Clock},
};
use bevy::{
    DefaultPlugins,
    app::{App, PluginsState, SubApp},
    asset::{Assets, Handle},
    camera::{Camera2d, RenderTarget},
    image::Image,
    log::LogPlugin,
    prelude::{On, PluginGroup, ResMut, Resource, World},
    render::{
        RenderApp,
        pipelined_rendering::PipelinedRenderingPlugin,
        render_resource::{PipelineCache, PollType, TextureFormat},
        renderer::{RenderAdapterInfo, RenderDevice},
        view::{
            Msaa,
            screenshot::{Screenshot, ScreenshotCaptured},
        },
    },
    time::TimeUpdateStrategy,
    window::{ExitCondition, Window, WindowPlugin, WindowResolution},
    winit::WinitPlugin,
};
use glam::{UVec2, Vec2};
use std::{
    panic::{self, AssertUnwindSafe},
    thread,
    time::{Duration, Instant},
};

/// Frames in which the graphics have to make the pipelines.
const PATIENCE: u32 = 2000;

/// The pixels that were asked for.
#[derive(Resource, Default)]
struct Captured(Option<Image>);

/// A world and its picture of a fixed size.
pub struct Offscreen {
    app: App,
    image: Handle<Image>,
    size: UVec2,
}

impl Offscreen {
    /// Draws the world of a checkpoint, the whole of its box. Fails with what the graphics say if there are none.
    pub fn new(checkpoint: &Checkpoint, size: UVec2) -> Result<Self, String> {
        let hook = panic::take_hook();
        panic::set_hook(Box::new(|_| {}));
        let made = panic::catch_unwind(AssertUnwindSafe(|| Self::make(checkpoint, size)));
        panic::set_hook(hook);
        made.map_err(|cause| {
            format!("no graphics: {}", fault::message(&*cause).lines().next().unwrap_or("unknown reason"))
        })
    }

    fn make(checkpoint: &Checkpoint, size: UVec2) -> Self {
        let mut app = App::new();
        let window = Window { resolution: WindowResolution::new(size.x, size.y), ..Window::default() };
        app.add_plugins(
            DefaultPlugins
                .build()
                .disable::<WinitPlugin>()
                .disable::<LogPlugin>()
                .disable::<PipelinedRenderingPlugin>()
                .set(WindowPlugin {
                    primary_window: Some(window),
                    exit_condition: ExitCondition::DontExit,
                    ..WindowPlugin::default()
                }),
        )
        .add_plugins((SimulationPlugin, GamePlugin, WorldRenderPlugin))
        .init_resource::<Captured>()
        .insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
        while app.plugins_state() == PluginsState::Adding {
            thread::sleep(Duration::from_millis(1));
        }
        app.finish();
        app.cleanup();
        let target = Image::new_target_texture(size.x, size.y, TextureFormat::Rgba8UnormSrgb, None);
        let image = app.world_mut().resource_mut::<Assets<Image>>().add(target);
        app.world_mut().spawn((Camera2d, Msaa::Off, RenderTarget::Image(image.clone().into())));
        checkpoint.restore(app.world_mut());
        let mut offscreen = Self { app, image, size };
        offscreen.pause(true);
        offscreen.app.update();
        let whole = Area { min: Vec2::ZERO, max: size.as_vec2() };
        offscreen.app.world_mut().resource_mut::<WorldCamera>().set_window(size.as_vec2(), whole);
        offscreen.wait_for_pipelines();
        offscreen
    }

    fn render_app(&self) -> &SubApp {
        self.app.sub_app(RenderApp)
    }

    /// The graphics' own world, to be changed.
    pub fn render_app_mut(&mut self) -> &mut SubApp {
        self.app.sub_app_mut(RenderApp)
    }

    /// Draws frames until the graphics have made all that the last one asked for, and one more with it.
    pub fn wait_for_pipelines(&mut self) {
        for _ in 0..PATIENCE {
            self.app.update();
            if self.render_app().world().resource::<PipelineCache>().waiting_pipelines().next().is_none() {
                break;
            }
            thread::sleep(Duration::from_millis(2));
        }
        // What could not be drawn before is drawn now.
        self.app.update();
    }

    /// Name of the graphics and of their interface.
    pub fn adapter(&self) -> String {
        let info = self.render_app().world().resource::<RenderAdapterInfo>();
        format!("{} ({})", info.name, info.backend)
    }

    /// The world.
    pub fn world(&self) -> &World {
        self.app.world()
    }

    /// The same, to be changed.
    pub fn world_mut(&mut self) -> &mut World {
        self.app.world_mut()
    }

    /// Lets the world stand, or go on.
    fn pause(&mut self, paused: bool) {
        self.app.world_mut().resource_mut::<Pace>().paused = paused;
    }

    /// Lets the world go on by so many ticks, each with its frame, and stand then.
    pub fn run(&mut self, ticks: u64) {
        self.pause(false);
        let end = self.app.world().resource::<Clock>().tick + ticks;
        while self.app.world().resource::<Clock>().tick < end {
            self.app.update();
        }
        self.pause(true);
    }

    /// Lets the world go on by a tick, which may be one of another world that takes its place, and waits until its frame is done.
    pub fn tick(&mut self) {
        let at = |world: &World| (Generation::of(world), world.resource::<Clock>().tick);
        let before = at(self.world());
        self.pause(false);
        // The first frame that is not late has a tick in it.
        for _ in 0..4 {
            self.frame();
            if at(self.world()) != before {
                break;
            }
        }
        self.pause(true);
    }

    /// Shows a view, at a level.
    pub fn show(&mut self, view: &'static View, level: Level) {
        self.app.world_mut().insert_resource(Shown(view));
        self.app.world_mut().resource_mut::<PictureLevel>().want(Some(level));
    }

    /// Draws a frame and waits until it is done.
    pub fn frame(&mut self) -> Duration {
        let begin = Instant::now();
        self.app.update();
        // Only a lost device does not answer, and then nothing is there to be measured.
        let _ = self.render_app().world().resource::<RenderDevice>().poll(PollType::wait_indefinitely());
        begin.elapsed()
    }

    /// Draws a pass so many times in each frame.
    pub fn repeat(&mut self, pass: PicturePass, times: u32) {
        self.render_app_mut().insert_resource(Repeat(Some((pass, times))));
    }

    /// What each pass drew in the last frame.
    pub fn drawn(&self) -> [u32; PicturePass::ALL.len()] {
        self.app.world().resource::<RenderCost>().drawn()
    }

    /// Processor time of the last frame, ms: to copy out of the world what it needs, to pack that, and to hand it to the graphics.
    pub fn processor_time(&self) -> [f64; 3] {
        self.app.world().resource::<RenderCost>().milliseconds().map(f64::from)
    }

    /// Draws the world as it stands; rows from the top.
    pub fn pixels(&mut self) -> Pixels {
        let target = RenderTarget::Image(self.image.clone().into());
        self.app.world_mut().spawn(Screenshot(target)).observe(
            |captured: On<ScreenshotCaptured>, mut into: ResMut<Captured>| into.0 = Some(captured.image.clone()),
        );
        for _ in 0..PATIENCE {
            self.frame();
            if let Some(image) = self.app.world_mut().resource_mut::<Captured>().0.take() {
                let bytes = image.data.unwrap_or_default();
                let pixels = bytes.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
                return Pixels { size: self.size, pixels };
            }
        }
        Pixels { size: self.size, pixels: vec![[0; 3]; (self.size.x * self.size.y) as usize] }
    }

    /// The pixel of a point of the world, d.
    pub fn pixel_of(&self, at: Vec2) -> UVec2 {
        let pixel = self.app.world().resource::<WorldCamera>().to_pixel(at);
        pixel.clamp(Vec2::ZERO, self.size.as_vec2() - 1.0).as_uvec2()
    }
}

/// A picture's pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// Width and height.
    pub size: UVec2,
    pixels: Vec<Rgb>,
}

impl Pixels {
    /// The colour of a pixel, from the top left.
    pub fn at(&self, pixel: UVec2) -> Rgb {
        self.pixels[(pixel.y * self.size.x + pixel.x) as usize]
    }

    /// All of them, row by row.
    pub fn all(&self) -> &[Rgb] {
        &self.pixels
    }
}
