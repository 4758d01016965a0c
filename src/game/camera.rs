//! Which part of the world the window shows: fit, zoom and pan, and the way between pixels and the world.
//!
//! Pixels are logical ones with y down, as the window counts them; the world is in d with y up.

use bevy::prelude::Resource;
use glam::Vec2;

/// Most that the player may zoom in.
const ZOOM_LIMIT: f32 = 24.0;
/// Share of the free area that the box fills at zoom 1.
const FIT: f32 = 0.985;

/// A rectangle of the window in logical pixels, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Upper left corner.
    pub min: Vec2,
    /// Lower right corner.
    pub max: Vec2,
}

impl Area {
    /// Whether the point is inside.
    pub fn contains(self, pixel: Vec2) -> bool {
        pixel.cmpge(self.min).all() && pixel.cmplt(self.max).all()
    }
}

/// The part of the world that the window shows.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct WorldCamera {
    /// Size of the window, logical pixels.
    window: Vec2,
    /// Part of the window that no bar of the HUD covers.
    free: Area,
    /// Size of the box, d.
    world: Vec2,
    /// 1 shows the whole box.
    zoom: f32,
    /// Point of the world in the middle of the free area, d.
    centre: Vec2,
    /// Further areas of the same size that show the same part of the box (an A/B split).
    others: Option<[Area; 2]>,
    /// The area in which a drag began, while it goes on: 0 is the free one.
    dragged: Option<usize>,
}

impl Default for WorldCamera {
    fn default() -> Self {
        Self::new(Vec2::new(1280.0, 800.0), Vec2::new(160.0, 90.0))
    }
}

impl WorldCamera {
    /// A camera that shows the whole of a box of `world` d in a window of `window` pixels.
    pub fn new(window: Vec2, world: Vec2) -> Self {
        Self {
            window,
            free: Area { min: Vec2::ZERO, max: window },
            world,
            zoom: 1.0,
            centre: world / 2.0,
            others: None,
            dragged: None,
        }
    }

    /// Follows the window and the HUD. A window without a size (minimised) leaves things as they are.
    pub fn set_window(&mut self, window: Vec2, free: Area) {
        if window.cmplt(Vec2::ONE).any() {
            return;
        }
        let free = if (free.max - free.min).cmplt(Vec2::splat(16.0)).any() {
            Area { min: Vec2::ZERO, max: window }
        } else {
            free
        };
        (self.window, self.free) = (window, free);
        self.settle();
    }

    /// Shows the whole of another box.
    pub fn set_world(&mut self, world: Vec2) {
        if self.world != world {
            self.world = world;
            self.fit();
        }
    }

    /// Shows the same part of the same box where that has `factor` new d in one old, and `world` new d in all.
    pub fn rescale(&mut self, world: Vec2, factor: f32) {
        (self.world, self.centre) = (world, self.centre * factor);
        self.settle();
    }

    /// Size of the window, logical pixels.
    pub fn window(&self) -> Vec2 {
        self.window
    }

    /// Size of the box, d.
    pub fn world(&self) -> Vec2 {
        self.world
    }

    /// Part of the window that no bar of the HUD covers, logical pixels.
    pub fn free(&self) -> Area {
        self.free
    }

    /// How far it is zoomed in; 1 shows the whole box.
    pub fn zoom(&self) -> f32 {
        self.zoom
    }

    /// Logical pixels of one d.
    pub fn pixels_per_d(&self) -> f32 {
        let room = (self.free.max - self.free.min) * FIT / self.world;
        room.min_element() * self.zoom
    }

    /// Shows the same in two more areas of the size of the free one, or in that alone.
    pub fn set_others(&mut self, others: Option<[Area; 2]>) {
        if self.others != others {
            (self.others, self.dragged) = (others, None);
        }
    }

    /// All areas: the free one, and the others if there are any.
    pub fn panes(&self) -> impl Iterator<Item = Area> + use<> {
        std::iter::once(self.free).chain(self.others.into_iter().flatten())
    }

    /// A drag begins at `pixel`: until its end, the pointer counts as in the area of that pixel.
    pub fn begin_drag(&mut self, pixel: Vec2) {
        self.dragged = self.panes().position(|pane| pane.contains(pixel));
    }

    /// The drag ends: the pointer is in the area that it is over.
    pub fn end_drag(&mut self) {
        self.dragged = None;
    }

    /// How far the area that the pointer is in, or began its drag in, lies from the free one, pixels.
    fn shift(&self, pixel: Vec2) -> Vec2 {
        let pane = match self.dragged {
            Some(pane) => self.panes().nth(pane),
            None => self.panes().find(|pane| pane.contains(pixel)),
        };
        pane.map_or(Vec2::ZERO, |pane| pane.min - self.free.min)
    }

    /// The pixel at which a point of the world stands in the area that the pointer is in, or began its drag in.
    pub fn to_pixel_beside(&self, point: Vec2, pointer: Vec2) -> Vec2 {
        self.to_pixel(point) + self.shift(pointer)
    }

    /// The point of the world under a pixel, d.
    pub fn to_world(&self, pixel: Vec2) -> Vec2 {
        let pixel = pixel - self.shift(pixel);
        let middle = (self.free.min + self.free.max) / 2.0;
        self.centre + (pixel - middle) * Vec2::new(1.0, -1.0) / self.pixels_per_d()
    }

    /// The pixel at which a point of the world stands.
    pub fn to_pixel(&self, point: Vec2) -> Vec2 {
        let middle = (self.free.min + self.free.max) / 2.0;
        middle + (point - self.centre) * Vec2::new(1.0, -1.0) * self.pixels_per_d()
    }

    /// Zooms by `factor`; the point of the world under `pixel` stays there as far as the box allows.
    pub fn zoom_at(&mut self, pixel: Vec2, factor: f32) {
        let point = self.to_world(pixel);
        self.zoom = (self.zoom * factor).clamp(1.0, ZOOM_LIMIT);
        self.centre += point - self.to_world(pixel);
        self.settle();
    }

    /// Moves the picture by `pixels`, as if the world were dragged.
    pub fn pan(&mut self, pixels: Vec2) {
        self.centre -= pixels * Vec2::new(1.0, -1.0) / self.pixels_per_d();
        self.settle();
    }

    /// Shows the whole box.
    pub fn fit(&mut self) {
        (self.zoom, self.centre) = (1.0, self.world / 2.0);
    }

    /// Scale and offset that take a point of the world to clip space, shown in `pane`.
    pub fn clip_transform(&self, pane: Area) -> (Vec2, Vec2) {
        let scale = 2.0 * self.pixels_per_d() / self.window;
        let origin = (self.to_pixel(Vec2::ZERO) + pane.min - self.free.min) / self.window;
        (scale, Vec2::new(2.0 * origin.x - 1.0, 1.0 - 2.0 * origin.y))
    }

    /// Keeps the box in the picture: what is seen never lies outside it while the box is larger than the free area.
    fn settle(&mut self) {
        let half = (self.free.max - self.free.min) / (2.0 * self.pixels_per_d());
        let slack = (self.world / 2.0 - half).max(Vec2::ZERO);
        let middle = self.world / 2.0;
        self.centre = self.centre.clamp(middle - slack, middle + slack);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> WorldCamera {
        let mut camera = WorldCamera::new(Vec2::new(800.0, 600.0), Vec2::new(200.0, 100.0));
        camera.set_window(Vec2::new(800.0, 600.0), Area { min: Vec2::new(0.0, 40.0), max: Vec2::new(800.0, 540.0) });
        camera
    }

    #[test]
    fn pixels_and_world_are_inverse_and_y_turns_over() {
        let mut camera = camera();
        camera.zoom_at(Vec2::new(300.0, 200.0), 3.0);
        let point = Vec2::new(31.0, 77.0);
        assert!((camera.to_world(camera.to_pixel(point)) - point).length() < 1e-3);
        assert!(camera.to_pixel(Vec2::new(0.0, 90.0)).y < camera.to_pixel(Vec2::new(0.0, 10.0)).y);
    }

    #[test]
    fn the_whole_box_fits_between_the_bars() {
        let camera = camera();
        let (low, high) = (camera.to_pixel(Vec2::ZERO), camera.to_pixel(camera.world()));
        assert!(low.x >= 0.0 && high.x <= 800.0 && high.y >= 40.0 && low.y <= 540.0, "{low} {high}");
        assert!(high.x - low.x > 770.0, "the box must fill the width, has {}", high.x - low.x);
    }

    #[test]
    fn zoom_holds_the_point_under_the_pointer() {
        let mut camera = camera();
        let pixel = Vec2::new(420.0, 300.0);
        let before = camera.to_world(pixel);
        camera.zoom_at(pixel, 2.0);
        assert!((camera.to_world(pixel) - before).length() < 1e-3);
        assert_eq!(camera.zoom(), 2.0);
    }

    #[test]
    fn pan_and_zoom_never_lose_the_box() {
        let mut camera = camera();
        camera.zoom_at(Vec2::new(400.0, 300.0), 4.0);
        camera.pan(Vec2::new(1e6, -1e6));
        assert!(camera.to_world(Vec2::new(0.0, 290.0)).x >= -1e-3);
        camera.zoom_at(Vec2::ZERO, 1e-6);
        assert_eq!(camera.zoom(), 1.0);
        assert!((camera.to_world(Vec2::new(400.0, 290.0)) - camera.world() / 2.0).length() < 1e-3);
    }

    #[test]
    fn clip_space_agrees_with_pixels() {
        let camera = camera();
        let point = Vec2::new(150.0, 20.0);
        let (scale, offset) = camera.clip_transform(camera.free());
        let clip = point * scale + offset;
        let pixel = (clip * Vec2::new(0.5, -0.5) + 0.5) * camera.window();
        assert!((pixel - camera.to_pixel(point)).length() < 1e-2);
    }

    #[test]
    fn a_second_area_shows_the_same_and_a_drag_keeps_to_its_own() {
        let mut camera = camera();
        let area = |x: f32| Area { min: Vec2::new(x, 40.0), max: Vec2::new(x + 260.0, 540.0) };
        camera.set_window(Vec2::new(800.0, 600.0), area(0.0));
        camera.set_others(Some([area(270.0), area(540.0)]));
        let (first, second) = (Vec2::new(100.0, 290.0), Vec2::new(370.0, 290.0));
        assert!((camera.to_world(first) - camera.to_world(second)).length() < 1e-3);
        assert!((camera.to_pixel_beside(camera.to_world(second), second) - second).length() < 1e-2);
        camera.begin_drag(first);
        assert!(camera.to_world(second).x > camera.to_world(first).x + 10.0, "a drag must not jump at the divider");
        camera.end_drag();
        let point = camera.to_world(second);
        camera.zoom_at(second, 2.0);
        assert!((camera.to_world(second) - point).length() < 1e-3, "zoom holds the point under the pointer");
        let (scale, offset) = camera.clip_transform(area(270.0));
        let clip = (point * scale + offset) * Vec2::new(0.5, -0.5) + 0.5;
        assert!((clip * camera.window() - second).length() < 0.1);
    }

    #[test]
    fn a_window_without_size_changes_nothing() {
        let mut camera = camera();
        let before = camera;
        camera.set_window(Vec2::ZERO, Area { min: Vec2::ZERO, max: Vec2::ZERO });
        assert_eq!(camera, before);
        assert!(camera.pixels_per_d().is_finite());
    }
}
