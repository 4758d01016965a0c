//! Moving pictures as GIF files. A pixel that looks as it did is left out of a frame: it takes less, and what stands
//! still does not flicker with the colours that each frame chooses for itself.

use crate::lab::colours::Rgb;
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use glam::UVec2;
use std::io::Write;

/// Most by which the channels of a pixel may differ together from what is shown, of 255 each, before it is drawn again.
const UNSEEN: u32 = 6;
/// How hastily the colours of a frame are chosen, 1 … 30.
const HASTE: i32 = 10;
/// Units in which a GIF counts time, in a second.
const UNITS: u64 = 100;

/// A GIF that is written frame by frame, and shown over and over.
pub struct Film<W: Write> {
    encoder: Encoder<W>,
    size: UVec2,
    rate: u64,
    frames: u64,
    /// What is shown so far.
    shown: Vec<Rgb>,
}

impl<W: Write> Film<W> {
    /// Begins a film of so many frames a second.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn begin(out: W, size: UVec2, rate: u32) -> Result<Self, EncodingError> {
        let mut encoder = Encoder::new(out, size.x as u16, size.y as u16, &[])?;
        encoder.set_repeat(Repeat::Infinite)?;
        Ok(Self { encoder, size, rate: u64::from(rate), frames: 0, shown: Vec::new() })
    }

    /// Adds a frame, given as rows from the top.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn add(&mut self, pixels: &[Rgb]) -> Result<(), EncodingError> {
        let whole = self.shown.len() != pixels.len();
        self.shown.resize(pixels.len(), Rgb::default());
        let mut rgba = Vec::with_capacity(4 * pixels.len());
        for (&now, shown) in pixels.iter().zip(&mut self.shown) {
            let differs: u32 = now.iter().zip(&*shown).map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
            let is_drawn = whole || differs > UNSEEN;
            if is_drawn {
                *shown = now;
            }
            rgba.extend(now);
            rgba.push(if is_drawn { 255 } else { 0 });
        }
        let mut frame = Frame::from_rgba_speed(self.size.x as u16, self.size.y as u16, &mut rgba, HASTE);
        frame.dispose = DisposalMethod::Keep;
        // So that a whole number of units each adds up to the right time.
        let until = |frames: u64| (frames * UNITS + self.rate / 2) / self.rate;
        frame.delay = (until(self.frames + 1) - until(self.frames)) as u16;
        self.frames += 1;
        self.encoder.write_frame(&frame)
    }

    /// Ends the file; how many frames it has.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn finish(self) -> Result<(u64, W), EncodingError> {
        let frames = self.frames;
        Ok((frames, self.encoder.into_inner()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A dot of 2 × 2 pixels that goes over a dark ground.
    fn picture(at: usize) -> Vec<Rgb> {
        let dot = |k: usize| (at..at + 2).contains(&(k % 24)) && k / 24 < 2;
        (0..24 * 10).map(|k| if dot(k) { [250, 120, 40] } else { [20, 24 + (k % 3) as u8, 40] }).collect()
    }

    #[test]
    fn a_film_shows_what_was_added_for_as_long_as_it_took() {
        let mut film = Film::begin(Vec::new(), UVec2::new(24, 10), 30).unwrap();
        (0..30).for_each(|k| film.add(&picture(k % 20)).unwrap());
        let (frames, bytes) = film.finish().unwrap();
        assert_eq!(frames, 30);
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut reader = options.read_info(&bytes[..]).unwrap();
        let mut canvas = vec![[0_u8; 3]; 240];
        let (mut k, mut time) = (0, 0);
        while let Some(frame) = reader.read_next_frame().unwrap() {
            for (k, pixel) in frame.buffer.chunks_exact(4).enumerate().filter(|(_, pixel)| pixel[3] > 0) {
                canvas[k] = [pixel[0], pixel[1], pixel[2]];
            }
            let drawn = frame.buffer.chunks_exact(4).filter(|pixel| pixel[3] > 0).count();
            assert!(k == 0 || drawn <= 8, "frame {k} draws {drawn} pixels, of which at most 8 differ");
            let off = canvas.iter().zip(picture(k % 20)).flat_map(|(a, b)| (0..3).map(move |c| a[c].abs_diff(b[c])));
            assert!(off.max().unwrap() <= UNSEEN as u8, "frame {k}");
            time += u64::from(frame.delay);
            k += 1;
        }
        assert_eq!((k, time), (30, 100), "thirty frames a second, a second");
    }
}
