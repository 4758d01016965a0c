//! The dark pixels of a PNG picture as a mask.

use png::{ColorType, Decoder, Info, Limits, Transformations};
use std::io::Cursor;

/// Most pixels along a side.
const MOST: u32 = 4096;

/// Most bytes that decoding may take.
const LARGEST: usize = 128 << 20;

/// Which pixels of a picture are dark, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mask {
    columns: usize,
    rows: usize,
    dark: Vec<bool>,
}

impl Mask {
    /// Decodes a PNG picture.
    pub(super) fn decode(bytes: &[u8]) -> Result<Self, String> {
        let fault = |error: png::DecodingError| format!("not a PNG picture that can be read: {error}");
        let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: LARGEST });
        decoder.set_transformations(Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(fault)?;
        let (width, height) = reader.info().size();
        if width > MOST || height > MOST {
            return Err(format!("{width} × {height} pixels; allowed: at most {MOST} × {MOST}"));
        }
        check_palette(reader.info())?;
        let size = reader.output_buffer_size().ok_or("the picture is too large")?;
        let mut buffer = vec![0; size];
        let frame = reader.next_frame(&mut buffer).map_err(fault)?;
        let channels = frame.color_type.samples();
        // The frame's own size: an animation's first frame may be smaller than the picture.
        let (columns, rows) = (frame.width as usize, frame.height as usize);
        let dark = buffer
            .chunks_exact(frame.line_size)
            .take(rows)
            .flat_map(|row| row[..columns * channels].chunks_exact(channels))
            .map(|pixel| is_dark(frame.color_type, pixel))
            .collect();
        let mask = Self { columns, rows, dark };
        debug_assert_eq!(mask.dark.len(), mask.columns * mask.rows, "one entry a pixel");
        Ok(mask)
    }

    /// Number of its pixels.
    pub(super) fn pixels(&self) -> usize {
        self.dark.len()
    }

    /// Whether the pixel at the point is dark; (0, 0) is the picture's lower left corner and (1, 1) its upper right one.
    pub(super) fn is_dark(&self, x: f64, y: f64) -> bool {
        let (column, row) = ((x * self.columns as f64).floor(), ((1.0 - y) * self.rows as f64).ceil() - 1.0);
        let inside = column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64;
        inside && self.dark[row as usize * self.columns + column as usize]
    }
}

/// The decoder takes it for granted that a palette holds whole colours. How many it may hold it looks at itself.
fn check_palette(info: &Info<'_>) -> Result<(), String> {
    let bytes = info.palette.as_ref().map_or(0, |palette| palette.len());
    if info.color_type == ColorType::Indexed && !bytes.is_multiple_of(3) {
        return Err(format!("a palette of {bytes} bytes; allowed: up to 256 colours of 3 bytes each"));
    }
    Ok(())
}

/// More black than white (Rec. 601 luma) and more opaque than transparent.
fn is_dark(kind: ColorType, pixel: &[u8]) -> bool {
    let luma = |p: &[u8]| 299 * u32::from(p[0]) + 587 * u32::from(p[1]) + 114 * u32::from(p[2]) < 127_500;
    match kind {
        ColorType::Grayscale => pixel[0] < 128,
        ColorType::GrayscaleAlpha => pixel[0] < 128 && pixel[1] >= 128,
        ColorType::Rgba => luma(pixel) && pixel[3] >= 128,
        ColorType::Rgb | ColorType::Indexed => luma(pixel),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A PNG file of the pixels, row by row from the top.
    pub(in crate::scene) fn png(kind: ColorType, width: u32, pixels: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let height = pixels.len() as u32 / width / kind.samples() as u32;
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(kind);
        encoder.write_header().and_then(|mut writer| writer.write_image_data(pixels)).expect("a picture");
        bytes
    }

    #[test]
    fn the_picture_is_upright_and_dark_means_dark_and_opaque() {
        let mask = Mask::decode(&png(ColorType::Grayscale, 2, &[0, 255, 255, 255])).expect("a picture");
        assert!(mask.is_dark(0.25, 0.75), "the upper left pixel is black");
        assert!(!mask.is_dark(0.75, 0.75) && !mask.is_dark(0.25, 0.25));
        assert!(!mask.is_dark(-0.1, 0.75) && !mask.is_dark(0.25, 1.1) && !mask.is_dark(f64::NAN, 0.75));
        let clear = Mask::decode(&png(ColorType::Rgba, 1, &[0, 0, 0, 10])).expect("a picture");
        assert!(!clear.is_dark(0.5, 0.5), "transparent black isn't there");
    }

    #[test]
    fn a_broken_picture_is_an_error() {
        assert!(Mask::decode(b"").is_err());
        let mut bytes = png(ColorType::Rgb, 4, &[7; 48]);
        bytes.truncate(bytes.len() / 2);
        assert!(Mask::decode(&bytes).is_err());
        let wide = png(ColorType::Grayscale, 5000, &[0; 5000]);
        assert!(Mask::decode(&wide).expect_err("too wide").contains("at most 4096"));
    }

    /// Such a palette made the decoder panic.
    #[test]
    fn a_palette_that_is_not_whole_is_an_error() {
        let file = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/corpus/picture/palette-cut"));
        let error = Mask::decode(file).expect_err("no whole colours");
        assert!(error.contains("a palette of 13 bytes; allowed: up to 256 colours"), "{error}");
    }
}
