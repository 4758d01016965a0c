//! Miniatures that move in step with time, and the images that show them.

use crate::{
    kernel::units::TICK_SECONDS,
    lab::miniature::{HEIGHT, Miniature, WIDTH},
};
use bevy::{
    asset::{Assets, Handle, RenderAssetUsages},
    image::{Image, ImageSampler},
    platform::time::Instant,
    render::render_resource::{Extent3d, TextureDimension, TextureFormat},
};
use bevy_egui::{EguiTextureHandle, EguiUserTextures, egui::TextureId};
use std::time::Duration;

/// Most time of a frame that one takes, unless a tick alone takes longer.
const BUDGET: Duration = Duration::from_millis(4);
/// Ticks from one of its pictures to the next: 30 Hz.
const BETWEEN: u32 = 2;
/// Most time that it makes up for in a frame, s.
const LONGEST: f32 = 3.0 * TICK_SECONDS;

/// A miniature that moves.
pub struct LivePicture {
    miniature: Box<Miniature>,
    /// Time that it is behind, s.
    due: f32,
    undrawn: u32,
}

impl LivePicture {
    /// One that goes on from where it is.
    pub fn new(miniature: Box<Miniature>) -> Self {
        Self { miniature, due: 0.0, undrawn: 0 }
    }

    /// Ticks that it has run.
    pub fn age(&self) -> u64 {
        self.miniature.age()
    }

    /// Runs as fast as time goes by, as far as the frame affords it; its picture, if it is time for a new one.
    pub fn run(&mut self, seconds: f32) -> Option<&[u8]> {
        self.due = (self.due + seconds).min(LONGEST);
        let begun = Instant::now();
        while self.due >= TICK_SECONDS && begun.elapsed() < BUDGET {
            self.miniature.tick();
            self.due -= TICK_SECONDS;
            self.undrawn += 1;
        }
        (self.undrawn >= BETWEEN).then(|| {
            self.undrawn = 0;
            self.miniature.draw()
        })
    }
}

/// Where pictures are put.
pub struct Screen<'a> {
    /// The images.
    pub images: &'a mut Assets<Image>,
    /// What egui calls them.
    pub textures: &'a mut EguiUserTextures,
}

/// The image of a miniature, and what egui calls it.
pub struct Shown {
    image: Handle<Image>,
    /// What egui calls it.
    pub id: TextureId,
}

impl Screen<'_> {
    /// Shows a picture for the first time.
    pub fn add(&mut self, picture: &[u8]) -> Shown {
        let size = Extent3d { width: WIDTH as u32, height: HEIGHT as u32, depth_or_array_layers: 1 };
        let (format, usage) = (TextureFormat::Rgba8UnormSrgb, RenderAssetUsages::default());
        let mut image = Image::new(size, TextureDimension::D2, picture.to_vec(), format, usage);
        image.sampler = ImageSampler::linear();
        let image = self.images.add(image);
        // The image goes, and its name with it, when its handle does.
        let id = self.textures.add_image(EguiTextureHandle::Weak(image.id()));
        Shown { image, id }
    }

    /// Shows the next one in its place. A new image would be seen a frame later, and nothing until then.
    pub fn change(&mut self, shown: &Shown, picture: &[u8]) {
        if let Some(mut image) = self.images.get_mut(&shown.image) {
            image.data = Some(picture.to_vec());
        }
    }
}
