//! The SVG as a picture, with a font of the program's own so that it looks the same everywhere.

use crate::lab::plot::{chart::Chart, text::FONT};
use resvg::{
    tiny_skia::{Pixmap, Transform},
    usvg::{self, Options, Tree},
};
use std::io::{self, Write};

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The SVG is not one, or too large.
    #[error("the chart can't be drawn: {0}")]
    Drawing(#[from] usvg::Error),
    /// The picture would have no pixels, or too many.
    #[error("the chart can't be drawn at a scale of {0}")]
    Scale(f32),
    /// The picture can't be written.
    #[error(transparent)]
    Writing(#[from] io::Error),
}

impl Chart {
    /// Writes the chart as PNG, `scale` pixels for each of the SVG's.
    ///
    /// # Errors
    /// If the picture has no size or can't be written.
    pub fn write_png(&self, out: impl Write, scale: f32) -> Result<(), PngError> {
        let mut options = Options::default();
        options.fontdb_mut().load_font_data(FONT.to_vec());
        let tree = Tree::from_str(&self.svg(), &options)?;
        let size = tree.size().to_int_size().scale_by(scale).ok_or(PngError::Scale(scale))?;
        let mut pixels = Pixmap::new(size.width(), size.height()).ok_or(PngError::Scale(scale))?;
        resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
        let mut encoder = png::Encoder::new(out, size.width(), size.height());
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        // The paper is opaque, so nothing shows through.
        let bytes: Vec<u8> = pixels.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        let mut writer = encoder.write_header().map_err(io::Error::from)?;
        writer.write_image_data(&bytes).map_err(io::Error::from)?;
        Ok(writer.finish().map_err(io::Error::from)?)
    }
}
