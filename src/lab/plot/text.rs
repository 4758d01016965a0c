//! How wide words are. Viewers may show another font than the one that is measured here, so there is some room to spare.

use skrifa::{
    FontRef, MetadataProvider,
    instance::{LocationRef, Size},
};

/// The font of the pictures, Ubuntu Light.
pub(super) const FONT: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;

/// Font families by preference.
pub(super) const FAMILY: &str = "Ubuntu Light, Ubuntu, Helvetica, Arial, sans-serif";

/// Share that other fonts may be wider by.
const SPARE: f64 = 1.12;

/// Width of a character of an unknown font, em.
const GUESS: f64 = 0.6;

/// Width of a line of text, pixels.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let Ok(font) = FontRef::new(FONT) else { return GUESS * size * text.chars().count() as f64 };
    let (characters, metrics) = (font.charmap(), font.glyph_metrics(Size::new(size as f32), LocationRef::default()));
    let advance = |character| characters.map(character).and_then(|glyph| metrics.advance_width(glyph));
    SPARE * text.chars().map(|character| advance(character).map_or(GUESS * size, f64::from)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn width_grows_with_the_text_and_the_size() {
        assert!(width("ii", 12.0) < width("MM", 12.0), "letters have widths of their own");
        assert!((width("word word", 26.0) / width("word word", 13.0) - 2.0).abs() < 0.01);
        assert_eq!(width("", 12.0), 0.0);
        let (known, unknown) = (width("a", 10.0), width("\u{4e00}", 10.0));
        assert!(known > 4.0 && unknown > 4.0);
    }
}
