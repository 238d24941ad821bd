//! Images as their files give them: PNG, and PGM in text (P2) and bytes (P5), 8 or 16 bits a sample. What an image is, its bytes say.
//!
//! Source of PGM: <https://netpbm.sourceforge.net/doc/pgm.html>.

use super::{GridError, check_size};
use std::io::{BufReader, Cursor};
use std::path::Path;

/// The samples of every pixel, row by row from the top.
#[derive(Debug)]
pub(super) struct Image {
    /// Width and height.
    pub(super) size: [u32; 2],
    /// Whether colours come from a palette.
    pub(super) has_palette: bool,
    /// Samples a pixel: grey, grey and opacity, three colours, three colours and opacity.
    channels: usize,
    /// The sample of white.
    full: u16,
    samples: Vec<u16>,
}

/// A pixel, 0 to 1 each.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pixel {
    /// The mean of its colours.
    pub(super) bright: f64,
    /// The mean of its colours and its opacity.
    pub(super) bright_with_opacity: f64,
    /// Its opacity.
    pub(super) opaque: f64,
}

type Read = Result<Image, String>;

/// How other images begin, and what they are called.
const OTHERS: [(&[u8], &str); 12] = [
    (b"\xff\xd8\xff", "a JPEG image"),
    (b"BM", "a BMP image"),
    (b"GIF8", "a GIF image"),
    (b"II*\0", "a TIFF image"),
    (b"MM\0*", "a TIFF image"),
    (b"RIFF", "a WebP image"),
    (b"P1", "a bitmap (P1)"),
    (b"P3", "a coloured image (P3)"),
    (b"P4", "a bitmap (P4)"),
    (b"P6", "a coloured image (P6)"),
    (b"P7", "a PAM image"),
    (b"", "no image that is known"),
];

impl Image {
    /// The image in the file at `path`.
    pub(super) fn open(path: &Path) -> Result<Self, GridError> {
        let read = crate::file::read(path).map_err(|error| error.to_string()).and_then(read);
        read.map_err(|reason| GridError::InFile {
            path: path.to_owned(),
            source: Box::new(GridError::Unreadable { reason }),
        })
    }

    /// Whether its pixels have an opacity.
    pub(super) fn has_opacity(&self) -> bool {
        self.channels.is_multiple_of(2)
    }

    /// Whether some pixel is no grey.
    pub(super) fn is_coloured(&self) -> bool {
        let is_colour = |pixel: &[u16]| pixel[..3].iter().any(|sample| *sample != pixel[0]);
        self.channels > 2 && self.samples.chunks_exact(self.channels).any(is_colour)
    }

    /// Its pixels.
    pub(super) fn pixels(&self) -> impl Iterator<Item = Pixel> {
        let full = f64::from(self.full);
        // A grey stands for three colours.
        let weight = if self.channels < 3 { 3.0 } else { 1.0 };
        self.samples.chunks_exact(self.channels).map(move |pixel| {
            let (colours, opacity) = pixel.split_at(self.channels - usize::from(self.has_opacity()));
            let sum = weight * colours.iter().copied().map(f64::from).sum::<f64>();
            let opacity = opacity.first().copied().map(f64::from);
            Pixel {
                bright: sum / (3.0 * full),
                bright_with_opacity: opacity
                    .map_or(sum / (3.0 * full), |opacity| (sum + opacity) / (4.0 * full)),
                opaque: opacity.map_or(1.0, |opacity| opacity / full),
            }
        })
    }
}

fn read(bytes: Vec<u8>) -> Read {
    match bytes.get(..2) {
        Some(b"P2") => pgm(&bytes, true),
        Some(b"P5") => pgm(&bytes, false),
        Some(b"\x89P") => png(bytes),
        _ => {
            let found =
                OTHERS.iter().find(|(begin, _)| bytes.starts_with(begin)).map_or("no image", |other| other.1);
            Err(format!("it is {found}; PNG and PGM (P2, P5) are accepted"))
        }
    }
}

fn png(bytes: Vec<u8>) -> Read {
    let damaged = |error: png::DecodingError| format!("the PNG image is damaged: {error}");
    let mut decoder = png::Decoder::new(BufReader::new(Cursor::new(bytes)));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(damaged)?;
    let (width, height) = reader.info().size();
    check_size(width, height).map_err(|error| format!("the PNG image is {error}"))?;
    let has_palette = reader.info().color_type == png::ColorType::Indexed;
    let size = reader.output_buffer_size().ok_or(png::DecodingError::LimitsExceeded).map_err(damaged)?;
    let mut bytes = vec![0; size];
    let frame = reader.next_frame(&mut bytes).map_err(damaged)?;
    bytes.truncate(frame.buffer_size());
    let (samples, full) = if frame.bit_depth == png::BitDepth::Sixteen {
        (wide(&bytes), u16::MAX)
    } else {
        (bytes.into_iter().map(u16::from).collect(), 255)
    };
    let size = [frame.width, frame.height];
    Ok(Image { size, has_palette, channels: frame.color_type.samples(), full, samples })
}

/// Samples of two bytes, the greater one first.
fn wide(bytes: &[u8]) -> Vec<u16> {
    bytes.chunks_exact(2).map(|two| u16::from_be_bytes([two[0], two[1]])).collect()
}

fn pgm(bytes: &[u8], is_text: bool) -> Read {
    let mut rest = &bytes[2..];
    let mut number = || -> Result<Option<u32>, String> {
        let Some(word) = word(&mut rest) else { return Ok(None) };
        let text = String::from_utf8_lossy(word);
        let wrong = || format!("the PGM image has `{}` for a number", crate::text::brief(&text));
        text.parse().map(Some).map_err(|_| wrong())
    };
    let [Some(width), Some(height), Some(full)] = [number()?, number()?, number()?] else {
        return Err(
            "the PGM image ends in its head; width, height and the value of white are accepted".to_owned()
        );
    };
    let accepted = u16::try_from(full).ok().filter(|full| *full > 0);
    let full = accepted.ok_or_else(|| format!("white is {full} in the PGM image; 1 to 65535 is accepted"))?;
    let samples: Vec<u16> = if is_text {
        let mut samples = Vec::new();
        while let Some(sample) = number()? {
            samples.push(sample.try_into().unwrap_or(u16::MAX));
        }
        samples
    } else {
        let raster = rest.get(1..).unwrap_or_default();
        if full > 255 { wide(raster) } else { raster.iter().copied().map(u16::from).collect() }
    };
    let found = samples.len() as u64;
    let wanted = u64::from(width) * u64::from(height);
    if found != wanted {
        return Err(format!(
            "the PGM image has {found} pixels; {width} × {height} are accepted, as its head says"
        ));
    }
    match samples.iter().find(|sample| **sample > full) {
        Some(sample) => {
            Err(format!("the PGM image has the sample {sample}; 0 to {full}, its white, is accepted"))
        }
        None => Ok(Image { size: [width, height], has_palette: false, channels: 1, full, samples }),
    }
}

/// The next word of a head or of samples in text; `rest` is then what follows it. A comment goes from `#` to the end of its line.
fn word<'b>(rest: &mut &'b [u8]) -> Option<&'b [u8]> {
    loop {
        *rest = rest.trim_ascii_start();
        let is_comment = rest.first()? == &b'#';
        let ends = |byte: &u8| {
            if is_comment { *byte == b'\n' || *byte == b'\r' } else { byte.is_ascii_whitespace() }
        };
        let (found, after) = rest.split_at(rest.iter().position(ends).unwrap_or(rest.len()));
        *rest = after;
        if !is_comment {
            return Some(found);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image, and the brightnesses of its pixels or the message about it.
    const IMAGES: &[(&[u8], Result<&[f64], &str>)] = &[
        (b"P5\n# by hand\n2 1\n255\n\x00\xff", Ok(&[0.0, 1.0])),
        (b"P5 2 1 65535\n\x80\x00\xff\xff", Ok(&[32768.0 / 65535.0, 1.0])),
        (b"P5 2 1 100 \x32\x0a", Ok(&[0.5, 0.1])),
        (b"P2\n# by hand\n2 2 # two rows\n255\n0 255\n51 # dark\n102\n", Ok(&[0.0, 1.0, 0.2, 0.4])),
        (b"P2 1 1 1000 250", Ok(&[0.25])),
        (b"P2 2 1 255 0", Err("the PGM image has 1 pixels; 2 × 1 are accepted, as its head says")),
        (b"P2 1 1 255 0 7", Err("the PGM image has 2 pixels; 1 × 1 are accepted")),
        (b"P2 1 1 255 256", Err("the PGM image has the sample 256; 0 to 255, its white, is accepted")),
        (b"P2 1 1 255 -1", Err("the PGM image has `-1` for a number")),
        (b"P5 3 2 255\n12345", Err("the PGM image has 5 pixels; 3 × 2 are accepted, as its head says")),
        (b"P5 3 x", Err("the PGM image has `x` for a number")),
        (b"P5 3 2", Err("the PGM image ends in its head; width, height and the value of white are accepted")),
        (b"P5 1 1 0 1", Err("white is 0 in the PGM image; 1 to 65535 is accepted")),
        (b"P5 1 1 70000 1", Err("white is 70000 in the PGM image; 1 to 65535 is accepted")),
        (b"\xff\xd8\xff\xe0\0\x10JFIF", Err("it is a JPEG image; PNG and PGM (P2, P5) are accepted")),
        (b"BM\x3e\0\0\0", Err("it is a BMP image; PNG and PGM (P2, P5) are accepted")),
        (b"P6 1 1 255 abc", Err("it is a coloured image (P6); PNG and PGM (P2, P5) are accepted")),
        (b"P3 1 1 255 1 2 3", Err("it is a coloured image (P3); PNG")),
        (b"nothing", Err("it is no image that is known; PNG and PGM (P2, P5) are accepted")),
        (b"", Err("it is no image that is known")),
        (b"\x89PNG\r\n\x1a\nbroken", Err("the PNG image is damaged: ")),
    ];

    #[test]
    fn what_an_image_is_its_bytes_say_and_others_are_refused_by_name() {
        for (bytes, expected) in IMAGES {
            let shown = String::from_utf8_lossy(bytes);
            match (read(bytes.to_vec()), expected) {
                (Ok(image), Ok(bright)) => {
                    assert_eq!(
                        image.pixels().map(|pixel| pixel.bright).collect::<Vec<_>>(),
                        *bright,
                        "{shown}"
                    );
                }
                (Err(error), Err(refusal)) => {
                    assert!(error.starts_with(refusal), "{shown}: {error}\nis not {refusal}");
                }
                (found, expected) => panic!("{shown}: {found:?} is not {expected:?}"),
            }
        }
    }

    #[test]
    fn samples_of_sixteen_bits_keep_all_of_them() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Sixteen);
        encoder.write_header().unwrap().write_image_data(&[0x80, 0x01, 0xff, 0xff]).unwrap();
        let bright: Vec<f64> = read(bytes).unwrap().pixels().map(|pixel| pixel.bright).collect();
        assert_eq!(bright, [32769.0 / 65535.0, 1.0]);
    }
}
