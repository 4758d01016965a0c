//! What the element in the making does: poured into a bowl, again and again while the mixer is open.

use crate::{
    game::{
        hud::live_picture::{LivePicture, Screen, Shown},
        mixer::desk::MixerDesk,
    },
    kernel::element::Element,
    lab::miniature::{BOWL_TICKS, Miniature},
};
use bevy::{
    asset::Assets,
    image::Image,
    prelude::{Real, Res, ResMut, Resource, Time},
};
use bevy_egui::{EguiUserTextures, egui::TextureId};

/// The swatch.
#[derive(Resource, Default)]
pub struct Swatch {
    /// The element that it shows, and its miniature; none of one that can't be.
    of: Option<(Element, Option<LivePicture>)>,
    shown: Option<Shown>,
    /// Whether the player turns a dial: then it waits.
    pub waits: bool,
}

impl Swatch {
    /// Its image, once there is one.
    pub fn image(&self) -> Option<TextureId> {
        self.shown.as_ref().map(|shown| shown.id)
    }

    /// Whether nothing of it is kept.
    pub fn is_empty(&self) -> bool {
        self.of.is_none() && self.shown.is_none()
    }

    /// Goes on with a draft for a frame of `seconds`.
    fn advance(&mut self, draft: &Element, screen: &mut Screen, seconds: f32) {
        // Its name is nothing that is seen.
        let is_of = |element: &Element| Element { name: draft.name.clone(), ..element.clone() } == *draft;
        let is_over = |live: &Option<LivePicture>| live.as_ref().is_some_and(|live| live.age() >= BOWL_TICKS);
        let is_shown = self.of.as_ref().is_some_and(|(element, live)| is_of(element) && !is_over(live));
        if !is_shown && !self.waits {
            let live = Miniature::of_element(draft).ok().map(|miniature| LivePicture::new(Box::new(miniature)));
            self.of = Some((draft.clone(), live));
        }
        let Some(picture) = self.of.as_mut().and_then(|(_, live)| live.as_mut()?.run(seconds)) else { return };
        match &self.shown {
            Some(shown) => screen.change(shown, picture),
            None => self.shown = Some(screen.add(picture)),
        }
    }
}

/// Goes on with what is in the making.
pub fn run(
    desk: Res<MixerDesk>,
    mut swatch: ResMut<Swatch>,
    (mut images, mut textures): (ResMut<Assets<Image>>, ResMut<EguiUserTextures>),
    time: Res<Time<Real>>,
) {
    let Some(draft) = &desk.draft else { return };
    let mut screen = Screen { images: &mut images, textures: &mut textures };
    swatch.advance(draft, &mut screen, time.delta_secs());
}

/// While the mixer is closed nothing runs, and nothing is kept.
pub fn forget(mut swatch: ResMut<Swatch>) {
    if !swatch.is_empty() {
        *swatch = Swatch::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::units::TICK_SECONDS;

    #[test]
    fn it_begins_anew_with_every_change_and_at_its_end_and_waits_while_a_dial_is_turned() {
        let (mut images, mut textures) = (Assets::default(), EguiUserTextures::default());
        let mut screen = Screen { images: &mut images, textures: &mut textures };
        let mut swatch = Swatch::default();
        let age = |swatch: &Swatch| swatch.of.as_ref().and_then(|(_, live)| live.as_ref()).map(LivePicture::age);
        let mut draft = Element::plain("own", false);
        (0..10).for_each(|_| swatch.advance(&draft, &mut screen, TICK_SECONDS));
        assert!(swatch.image().is_some() && age(&swatch) >= Some(8));
        draft.name = "other".to_owned();
        swatch.advance(&draft, &mut screen, 0.0);
        assert!(age(&swatch) >= Some(8), "a name changes nothing");
        (draft.density, swatch.waits) = (500.0, true);
        swatch.advance(&draft, &mut screen, 0.0);
        assert!(age(&swatch) >= Some(8), "the dial is held");
        swatch.waits = false;
        swatch.advance(&draft, &mut screen, 0.0);
        assert_eq!(age(&swatch), Some(0));
        draft.density = -1.0;
        swatch.advance(&draft, &mut screen, TICK_SECONDS);
        assert_eq!(age(&swatch), None, "there can be no such element");
    }
}
