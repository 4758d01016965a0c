//! WAV: 16-bit samples of two channels (Microsoft & IBM 1991, "Multimedia programming interface and data specifications 1.0").

use std::io::{self, Write};

/// Bytes of a frame: two samples of two bytes.
const FRAME: u32 = 4;
/// Bytes of the header behind the one that counts the others.
const HEADER: u32 = 36;

/// Writes frames behind a header.
#[derive(Debug)]
pub(super) struct Wav<W: Write> {
    out: W,
}

impl<W: Write> Wav<W> {
    /// Begins a file of `frames` frames, `rate` of them a second. Of more than the header can count (6 hours at 48 kHz) it
    /// says the most that it can, which players take for "to the end".
    ///
    /// # Errors
    /// If it can't be written.
    pub(super) fn begin(mut out: W, rate: u32, frames: u64) -> io::Result<Self> {
        let data = frames.saturating_mul(u64::from(FRAME)).min(u64::from(u32::MAX - HEADER)) as u32;
        let (pcm, channels, bits) = (1_u16, 2_u16, 16_u16);
        out.write_all(b"RIFF")?;
        out.write_all(&(HEADER + data).to_le_bytes())?;
        out.write_all(b"WAVEfmt ")?;
        out.write_all(&16_u32.to_le_bytes())?;
        out.write_all(&pcm.to_le_bytes())?;
        out.write_all(&channels.to_le_bytes())?;
        out.write_all(&rate.to_le_bytes())?;
        out.write_all(&(rate * FRAME).to_le_bytes())?;
        out.write_all(&(FRAME as u16).to_le_bytes())?;
        out.write_all(&bits.to_le_bytes())?;
        out.write_all(b"data")?;
        out.write_all(&data.to_le_bytes())?;
        Ok(Self { out })
    }

    /// Adds frames: left, right, left, right, each from −1 to 1.
    pub(super) fn write(&mut self, samples: &[f32]) -> io::Result<()> {
        for sample in samples {
            let value = (sample * f32::from(i16::MAX)).round() as i16;
            self.out.write_all(&value.to_le_bytes())?;
        }
        Ok(())
    }

    /// What it was written to.
    pub(super) fn into_inner(self) -> W {
        self.out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_what_its_header_says() {
        let mut wav = Wav::begin(Vec::new(), 48_000, 2).unwrap();
        wav.write(&[0.0, 1.0, -1.0, 2.0]).unwrap();
        let bytes = wav.into_inner();
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!((&bytes[..4], number(4), &bytes[8..16]), (&b"RIFF"[..], 44, &b"WAVEfmt "[..]));
        assert_eq!((number(24), number(28), number(40), bytes.len()), (48_000, 192_000, 8, 52));
        let samples: Vec<i16> =
            bytes[44..].chunks_exact(2).map(|pair| i16::from_le_bytes([pair[0], pair[1]])).collect();
        assert_eq!(samples, [0, i16::MAX, -i16::MAX, i16::MAX]);
        let long = Wav::begin(Vec::new(), 48_000, u64::MAX).unwrap().into_inner();
        assert_eq!(long[4..8], [255; 4]);
    }
}
