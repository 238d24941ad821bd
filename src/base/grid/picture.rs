//! Maps from pictures: PNG and PGM images, and the occupancy maps of ROS, which are an image with a YAML file beside it.
//!
//! An image alone is free where it is brighter than half, blocked elsewhere; what is transparent is white. The first row of pixels is the
//! highest y. A ROS map has thresholds of its own: with `p` the darkness of a pixel from 0 to 1 (its brightness with `negate`), a cell is
//! blocked where `p > occupied_thresh`, free where `p < free_thresh`, unknown in between; what is unknown is blocked. Its `resolution`
//! must be a length and is not used, nor is the place in its `origin`: cells are cells here, counted from the lower left pixel. A map that
//! is turned, by a yaw in its `origin`, is refused, and so is a key that the format does not have.
//!
//! Source: the page "Map format" of <https://wiki.ros.org/map_server>.

use super::{Grid2, GridError, parse_text_map, read_movingai_map, read_text_map};
use crate::settings::{Document, SettingsError};
use crate::solid::Source;
use crate::yaml::{Node, Yaml};
use std::io::{BufReader, Cursor};
use std::path::{Path, PathBuf};

/// Above this brightness a pixel of an image alone is free.
const HALF: u8 = 127;

/// The map in the file at `path` and the files that it was read from: an image (`.png`, `.pgm`), a ROS map (`.yaml`), a Moving AI map
/// (`.map`), or a text map.
///
/// # Errors
/// [`GridError::InFile`] or [`GridError::Told`] around what is wrong.
pub fn read_map(path: &Path) -> Result<(Grid2, Vec<PathBuf>), GridError> {
    let ending = path.extension().map(|end| end.to_string_lossy().to_lowercase()).unwrap_or_default();
    let alone = |grid: Grid2| (grid, vec![path.to_owned()]);
    match ending.as_str() {
        "png" | "pgm" => {
            Picture::open(path).and_then(|picture| picture.grid(|bright| bright > HALF)).map(alone)
        }
        "yaml" | "yml" => read_ros_map(path),
        // A text map may be called `.map` too; the format of Moving AI begins with its type.
        "map" => read_movingai_map(path)
            .or_else(|error| {
                let text = crate::file::read_text(path).unwrap_or_default();
                if text.trim_start().starts_with("type") {
                    Err(error)
                } else {
                    parse_text_map(&text).map_err(|_| error)
                }
            })
            .map(alone),
        _ => read_text_map(path).map(alone),
    }
}

/// The ROS map whose YAML file is at `path`, and both of its files.
fn read_ros_map(path: &Path) -> Result<(Grid2, Vec<PathBuf>), GridError> {
    let head = Head::read(path).map_err(|error| GridError::Told { said: error.to_string() })?;
    let grid = Picture::open(&head.image)?.grid(|bright| {
        let share = f64::from(bright) / 255.0;
        let dark = if head.is_negated { share } else { 1.0 - share };
        dark < head.free_below
    })?;
    Ok((grid, vec![path.to_owned(), head.image]))
}

/// What the YAML file of a ROS map says.
struct Head {
    image: PathBuf,
    is_negated: bool,
    free_below: f64,
}

/// The keys of the format; `mode` is that of its newer versions.
const KEYS: [&str; 7] = ["image", "mode", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"];

impl Head {
    fn read(path: &Path) -> Result<Self, SettingsError> {
        let document = Document::open(path)?;
        let (root, yaml) = (Yaml::parse(&document)?, Yaml(Source(&document)));
        for (key, node) in yaml.table(&root)? {
            if !KEYS.contains(&key.as_str()) {
                let message = format!("unknown key `{key}`; accepted: {}", KEYS.join(", "));
                return Err(yaml.0.fault(&node.at, message));
            }
        }
        let resolution = yaml.get(&root, "resolution")?;
        yaml.0.sizes(&resolution.at, "resolution", [yaml.number(resolution, "resolution")?])?;
        check_origin(yaml, &root)?;
        if let Some(mode) = yaml.find(&root, "mode")?
            && yaml.word(mode)? != "trinary"
        {
            let message = format!("mode is `{}`; `trinary` is accepted", yaml.word(mode)?);
            return Err(yaml.0.fault(&mode.at, message));
        }
        let named = yaml.get(&root, "image")?;
        let image = path.parent().unwrap_or(Path::new("")).join(yaml.word(named)?);
        if !image.is_file() {
            let message =
                format!("there is no image `{}`; looked for {}", yaml.word(named)?, image.display());
            return Err(yaml.0.fault(&named.at, message));
        }
        Ok(Self { image, is_negated: is_negated(yaml, &root)?, free_below: free_below(yaml, &root)? })
    }
}

/// The place of the lower left pixel is not used, but the map's axes are those of the world.
fn check_origin(yaml: Yaml<'_>, root: &Node) -> Result<(), SettingsError> {
    let Some(origin) = yaml.find(root, "origin")? else { return Ok(()) };
    let [_, _, yaw] = yaml.exactly::<3>(origin, "origin")?;
    if yaw == 0.0 {
        return Ok(());
    }
    let message = format!("origin turns the map by the yaw {yaw}; 0 is accepted, a map along its own axes");
    Err(yaml.0.fault(&origin.at, message))
}

fn is_negated(yaml: Yaml<'_>, root: &Node) -> Result<bool, SettingsError> {
    let Some(node) = yaml.find(root, "negate")? else { return Ok(false) };
    match yaml.number(node, "negate")? {
        0.0 => Ok(false),
        1.0 => Ok(true),
        other => Err(yaml.0.fault(&node.at, format!("negate is {other}; 0 or 1 is accepted"))),
    }
}

/// The darkness below which a cell is free; what is darker than `occupied_thresh` must not be.
fn free_below(yaml: Yaml<'_>, root: &Node) -> Result<f64, SettingsError> {
    let share = |key: &str, default: f64| {
        let Some(node) = yaml.find(root, key)? else { return Ok((root, default)) };
        match yaml.number(node, key)? {
            share if (0.0..=1.0).contains(&share) => Ok((node, share)),
            other => {
                Err(yaml.0.fault(&node.at, format!("{key} is {other}; a number from 0 to 1 is accepted")))
            }
        }
    };
    let ((_, blocked), (node, free)) = (share("occupied_thresh", 0.65)?, share("free_thresh", 0.196)?);
    if free <= blocked {
        return Ok(free);
    }
    let message = format!("free_thresh is {free}; at most occupied_thresh, {blocked}, is accepted");
    Err(yaml.0.fault(&node.at, message))
}

/// The brightness of every pixel, row by row from the top.
struct Picture {
    path: PathBuf,
    size: [u32; 2],
    bright: Vec<u8>,
}

impl Picture {
    fn open(path: &Path) -> Result<Self, GridError> {
        let inside = |reason: String| GridError::InFile {
            path: path.to_owned(),
            source: Box::new(GridError::Unreadable { reason }),
        };
        let bytes = crate::file::read(path).map_err(|error| inside(error.to_string()))?;
        let read = if bytes.starts_with(b"P5") { pgm(&bytes) } else { png(bytes) };
        let (size, bright) = read.map_err(inside)?;
        Ok(Self { path: path.to_owned(), size, bright })
    }

    /// The grid whose cells are free where `is_free` says so of their brightness.
    fn grid(&self, is_free: impl Fn(u8) -> bool) -> Result<Grid2, GridError> {
        let [width, height] = self.size;
        let mut grid = Grid2::new(width, height)
            .map_err(|source| GridError::InFile { path: self.path.clone(), source: Box::new(source) })?;
        for (index, bright) in self.bright.iter().enumerate() {
            let (x, row) = (index as u32 % width, index as u32 / width);
            grid.set_blocked((height - 1 - row) * width + x, !is_free(*bright));
        }
        Ok(grid)
    }
}

type Pixels = Result<([u32; 2], Vec<u8>), String>;

fn png(bytes: Vec<u8>) -> Pixels {
    let mut decoder = png::Decoder::new(BufReader::new(Cursor::new(bytes)));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|error| format!("it is no PNG image: {error}"))?;
    let size = reader.output_buffer_size().ok_or("the image does not fit the memory")?;
    let mut pixels = vec![0; size];
    let frame = reader.next_frame(&mut pixels).map_err(|error| format!("it is no PNG image: {error}"))?;
    pixels.truncate(frame.buffer_size());
    let bright = |pixel: &[u8]| {
        let (colour, opaque) = match pixel {
            [grey] => (u32::from(*grey) * 1000, 255),
            [grey, opaque] => (u32::from(*grey) * 1000, u32::from(*opaque)),
            [red, green, blue, rest @ ..] => {
                let sum = 299 * u32::from(*red) + 587 * u32::from(*green) + 114 * u32::from(*blue);
                (sum, rest.first().map_or(255, |opaque| u32::from(*opaque)))
            }
            [] => (0, 255),
        };
        ((colour * opaque + 255_000 * (255 - opaque)) / 255_000) as u8
    };
    let channels = frame.color_type.samples();
    Ok(([frame.width, frame.height], pixels.chunks_exact(channels).map(bright).collect()))
}

/// A binary PGM image of one byte a pixel.
fn pgm(bytes: &[u8]) -> Pixels {
    let (mut words, mut at) = (Vec::new(), 2);
    while words.len() < 3 {
        let rest = bytes.get(at..).unwrap_or_default();
        let skipped = rest.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        let rest = &rest[skipped..];
        let (is_comment, ends): (bool, fn(&u8) -> bool) = if rest.first() == Some(&b'#') {
            (true, |byte| *byte == b'\n')
        } else {
            (false, u8::is_ascii_whitespace)
        };
        let long = rest.iter().take_while(|byte| !ends(byte)).count();
        if !is_comment {
            let word = std::str::from_utf8(&rest[..long]).ok().and_then(|word| word.parse::<u32>().ok());
            words.push(word.ok_or("the head of the PGM image is not `P5`, width, height and 255")?);
        }
        at += skipped + long;
    }
    let (size, pixels) = ([words[0], words[1]], bytes.get(at + 1..).unwrap_or_default());
    let wanted = u64::from(size[0]) * u64::from(size[1]);
    if words[2] != 255 || pixels.len() as u64 != wanted {
        return Err(format!(
            "the PGM image has {} bytes of pixels up to {}; {wanted} up to 255 are accepted",
            pixels.len(),
            words[2]
        ));
    }
    Ok((size, pixels.to_vec()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// A PNG of 3 × 2 pixels of these brightnesses.
    fn image(color: png::ColorType, pixels: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
        encoder.set_color(color);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.write_header().unwrap().write_image_data(pixels).unwrap();
        bytes
    }

    fn free(grid: &Grid2) -> Vec<[i32; 2]> {
        let cells = (0..2).flat_map(|y| (0..3).map(move |x| [x, y]));
        cells.filter(|[x, y]| grid.is_free_xy(*x, *y)).collect()
    }

    #[test]
    fn bright_pixels_are_free_in_every_kind_of_image_and_the_first_row_is_the_top() {
        let folder = tempfile::tempdir().unwrap();
        let grey = [255, 128, 127, 0, 255, 0];
        let coloured: Vec<u8> = grey.iter().flat_map(|g| [*g, *g, *g]).collect();
        let clear: Vec<u8> = grey.iter().flat_map(|g| [0, 255 - *g]).collect();
        let plain = [&b"P5\n# made here\n3 2\n255\n"[..], &grey].concat();
        for (name, bytes) in [
            ("grey.png", image(png::ColorType::Grayscale, &grey)),
            ("colour.png", image(png::ColorType::Rgb, &coloured)),
            ("clear.png", image(png::ColorType::GrayscaleAlpha, &clear)),
            ("plain.pgm", plain),
        ] {
            let path = folder.path().join(name);
            fs::write(&path, bytes).unwrap();
            let (grid, files) = read_map(&path).unwrap();
            assert_eq!((free(&grid), files), (vec![[1, 0], [0, 1], [1, 1]], vec![path]), "{name}");
        }
    }

    /// A change of the head of a ROS map, and what must be said of it.
    const WRONG_HEADS: &[(&str, &str, &str)] = &[
        ("room.png", "hall.png", "/room.yaml:1:8: there is no image `hall.png`; looked for /hall.png"),
        (
            "resolution: 0.05\n",
            "",
            "/room.yaml:1:1: there is no `resolution`; found are `image`, `origin`, `negate`",
        ),
        ("0.05", "0", "/room.yaml:2:13: resolution has the size 0; sizes above 0 are accepted"),
        ("0.05", "50", "/room.yaml:2:13: resolution has the length 50 m; is it in millimetres?"),
        ("0.65", "65", "/room.yaml:5:18: occupied_thresh is 65; a number from 0 to 1 is accepted"),
        ("negate", "mode: scale\nnegate", "/room.yaml:4:7: mode is `scale`; `trinary` is accepted"),
        (
            "-2.0, 0.0]",
            "-2.0, 0.7]",
            "/room.yaml:3:9: origin turns the map by the yaw 0.7; 0 is accepted, a map along its own axes",
        ),
        ("-2.0, 0.0]", "-2.0]", "/room.yaml:3:9: origin has 2 numbers; 3 are accepted"),
        ("-2.0, 0.0]", "nan, 0.0]", "/room.yaml:3:16: origin has the number NaN; finite numbers"),
        ("negate: 0", "negate: 2", "/room.yaml:4:9: negate is 2; 0 or 1 is accepted"),
        ("negate: 0", "negated: 1", "/room.yaml:4:10: unknown key `negated`; accepted: image, mode, reso"),
        ("negate: 0", "negate: 0\nnegate: 1", "/room.yaml:5:9: `negate` is given twice; once is accepted"),
        ("0.196", "0.7", "/room.yaml:6:14: free_thresh is 0.7; at most occupied_thresh, 0.65, is accepted"),
    ];

    #[test]
    fn a_ros_map_is_blocked_where_it_is_dark_or_unknown_and_its_head_is_checked() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(
            folder.path().join("room.png"),
            image(png::ColorType::Grayscale, &[254, 205, 0, 254, 100, 254]),
        )
        .unwrap();
        let head = "image: room.png\nresolution: 0.05\norigin: [-1.0, -2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
        let read = |head: &str| {
            let path = folder.path().join("room.yaml");
            fs::write(&path, head).unwrap();
            read_map(&path)
                .map_err(|error| error.to_string().replace(&folder.path().display().to_string(), ""))
        };
        let (grid, files) = read(head).unwrap();
        assert_eq!((free(&grid), files.len()), (vec![[0, 0], [2, 0], [0, 1]], 2), "205 is unknown to ROS");
        assert_eq!(free(&read(&head.replace("negate: 0", "negate: 1")).unwrap().0), vec![[2, 1]]);
        for (from, to, said) in WRONG_HEADS {
            let error = read(&head.replace(from, to)).unwrap_err();
            assert!(error.contains(said), "should say {said}\nsays {error}");
        }
    }

    #[test]
    fn what_is_no_image_is_told_with_its_file() {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes, said) in [
            ("a.png", &b"nothing"[..], "a.png: cannot be read: it is no PNG image: "),
            (
                "b.pgm",
                b"P5 3 2 255\n12345",
                "the PGM image has 5 bytes of pixels up to 255; 6 up to 255 are accepted",
            ),
            ("c.pgm", b"P5 3 x", "the head of the PGM image is not `P5`, width, height and 255"),
        ] {
            let path = folder.path().join(name);
            fs::write(&path, bytes).unwrap();
            let error = read_map(&path).unwrap_err().to_string();
            assert!(error.contains(said), "should say {said}\nsays {error}");
        }
    }
}
