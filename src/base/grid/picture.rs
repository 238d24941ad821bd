//! Maps from files of every kind: images, the occupancy maps of ROS, Moving AI maps, text.
//!
//! An image alone is free where it is brighter than half by the mean of its colours, blocked elsewhere; what is transparent is white.
//! The first row of pixels is the highest y.

use super::image::{Image, Pixel};
use super::ros::Head;
use super::{Grid2, GridError, parse_text_map, read_movingai_map, read_text_map};
use std::path::{Path, PathBuf};

/// A map as it was read.
#[derive(Debug)]
pub struct FileMap {
    /// The map.
    pub grid: Grid2,
    /// The files that it was read from.
    pub files: Vec<PathBuf>,
    /// What a reader of results should know of how they were taken, a sentence each.
    pub notes: Vec<String>,
}

/// The map in the file at `path`: an image (`.png`, `.pgm`), a ROS map (`.yaml`), a Moving AI map (`.map`), or a text map.
///
/// # Errors
/// [`GridError::InFile`] or [`GridError::Reported`] around what is wrong.
pub fn read_map(path: &Path) -> Result<FileMap, GridError> {
    let ending = path.extension().map(|end| end.to_string_lossy().to_lowercase()).unwrap_or_default();
    let alone = |grid: Grid2| FileMap { grid, files: vec![path.to_owned()], notes: Vec::new() };
    match ending.as_str() {
        "png" | "pgm" | "pnm" | "pbm" | "ppm" | "jpg" | "jpeg" | "bmp" | "gif" | "tif" | "tiff" | "webp" => {
            let on_white = |pixel: Pixel| pixel.bright * pixel.opaque + (1.0 - pixel.opaque);
            grid(path, &Image::open(path)?, |pixel| on_white(pixel) > 0.5).map(alone)
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
fn read_ros_map(path: &Path) -> Result<FileMap, GridError> {
    let head = Head::read(path).map_err(|error| GridError::Reported { message: error.to_string() })?;
    let image = Image::open(&head.image)?;
    let grid = grid(&head.image, &image, |pixel| head.is_free(pixel.bright_with_opacity))?;
    let notes = head.notes(&image);
    Ok(FileMap { grid, files: vec![path.to_owned(), head.image], notes })
}

/// The grid whose cells are free where `is_free` says so of their pixel.
fn grid(path: &Path, image: &Image, is_free: impl Fn(Pixel) -> bool) -> Result<Grid2, GridError> {
    let [width, height] = image.size;
    let mut grid = Grid2::new(width, height)
        .map_err(|source| GridError::InFile { path: path.to_owned(), source: Box::new(source) })?;
    for (index, pixel) in (0..).zip(image.pixels()) {
        let x = index % width;
        let row = index / width;
        grid.set_blocked((height - 1 - row) * width + x, !is_free(pixel));
    }
    Ok(grid)
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
            let FileMap { grid, files, .. } = read_map(&path).unwrap();
            assert_eq!((free(&grid), files), (vec![[1, 0], [0, 1], [1, 1]], vec![path]), "{name}");
        }
    }

    /// A change of the head of a ROS map, and the message about it.
    const WRONG_HEADS: &[(&str, &str, &str)] = &[
        ("room.png", "hall.png", "/room.yaml:1:8: there is no image `hall.png`; looked for /hall.png"),
        (
            "resolution: 0.05\n",
            "",
            "/room.yaml:1:1: there is no `resolution`; found are `image`, `origin`, `negate`",
        ),
        (
            "negate: 0\n",
            "",
            "/room.yaml:1:1: there is no `negate`; found are `image`, `resolution`, `origin`, ",
        ),
        ("occupied_thresh: 0.65\n", "", "/room.yaml:1:1: there is no `occupied_thresh`; found are `image`, "),
        ("free_thresh: 0.196\n", "", "/room.yaml:1:1: there is no `free_thresh`; found are `image`, `resol"),
        ("origin: [-1.0, -2.0, 0.0]\n", "", "/room.yaml:1:1: there is no `origin`; found are `image`, `res"),
        ("room.png", "/dev/zero", "it is a device, a pipe or a socket; a regular file is accepted"),
        (
            "negate: 0",
            "negate:",
            "/room.yaml:4:7: negate is nothing; true or false, yes or no, 1 or 0 is accepted",
        ),
        ("0.05", "0", "/room.yaml:2:13: resolution has the size 0; sizes above 0 are accepted"),
        ("0.05", "50", "/room.yaml:2:13: resolution has the length 50 m; is it in millimetres?"),
        (
            "0.65",
            "65",
            "occupied_thresh is 65; is it in per cent or a pixel's value? a number from 0 to 1 is accepted",
        ),
        ("negate", "mode:\nnegate", "mode is nothing; `trinary` is accepted"),
        ("negate", "mode: scale\nnegate", "/room.yaml:4:7: mode is `scale`; `trinary` is accepted"),
        (
            "negate",
            "mode: Trinary\nnegate",
            "mode is `Trinary`; `trinary` is accepted, in small letters as map_server",
        ),
        (
            "-2.0, 0.0]",
            "-2.0, 0.7]",
            "/room.yaml:3:9: origin turns the map by the yaw 0.7; 0 is accepted, a map along its own axes",
        ),
        ("-2.0, 0.0]", "-2.0]", "/room.yaml:3:9: origin has 2 numbers; 3 are accepted"),
        ("-2.0, 0.0]", "nan, 0.0]", "/room.yaml:3:16: origin is `nan`; a finite number is accepted"),
        (
            "negate: 0",
            "negate: 2",
            "/room.yaml:4:9: negate is `2`; true or false, yes or no, 1 or 0 is accepted",
        ),
        (
            "negate: 0",
            "negated: 1",
            "/room.yaml:4:10: unknown key `negated` (did you mean `negate`?); accepted: image, mode, reso",
        ),
        ("negate: 0", "negate: 0\nnegate: 1", "/room.yaml:5:9: `negate` is given twice; once is accepted"),
        ("0.196\n", "0.196\n---\nnegate: 1\n", "/room.yaml:7:1: a second document begins here"),
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
        let FileMap { grid, files, .. } = read(head).unwrap();
        assert_eq!((free(&grid), files.len()), (vec![[0, 0], [2, 0], [0, 1]], 2), "205 is unknown to ROS");
        let marked = read(&format!("\u{feff}{}", head.replace('\n', "\r\n"))).unwrap();
        assert_eq!(free(&marked.grid), free(&grid), "a byte-order mark, and ends of lines of another system");
        for word in ["1", "true", "Yes", "on", "'1'", "\"true\""] {
            let negated = read(&head.replace("negate: 0", &format!("negate: {word}"))).unwrap();
            assert_eq!(free(&negated.grid), vec![[2, 1]], "{word}");
        }
        for word in ["false", "No", "OFF", "'0'"] {
            let kept = read(&head.replace("negate: 0", &format!("negate: {word}"))).unwrap();
            assert_eq!(free(&kept.grid), free(&grid), "{word}");
        }
        for (from, to, expected) in WRONG_HEADS {
            let error = read(&head.replace(from, to)).unwrap_err();
            assert!(error.contains(expected), "should say {expected}\nsays {error}");
        }
    }

    /// The YAML file of a map of one row of three pixels, whose middle one may be free or not, and that it is free.
    fn middle_is_free(colour: png::ColorType, middle: &[u8], negate: bool) -> (bool, Vec<String>) {
        let folder = tempfile::tempdir().unwrap();
        let white = vec![255; middle.len()];
        let row = [&white[..], middle, &white].concat();
        fs::write(folder.path().join("room.png"), image(colour, &[&row[..], &row].concat())).unwrap();
        let path = folder.path().join("room.yaml");
        let head = format!(
            "image: room.png\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: {negate}\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
        );
        fs::write(&path, head).unwrap();
        let map = read_map(&path).unwrap();
        let folder = folder.path().display().to_string();
        (map.grid.is_free_xy(1, 0), map.notes.iter().map(|note| note.replace(&folder, "")).collect())
    }

    #[test]
    fn colours_of_a_ros_map_count_by_their_mean_as_map_server_and_nav2_take_them() {
        use png::ColorType::{GrayscaleAlpha, Rgb, Rgba};
        for (colour, pixel, negate, is_free) in [
            (Rgb, &[255, 255, 0][..], false, false), // yellow: 170, unknown, though it seems bright
            (Rgb, &[0, 255, 255], false, false),
            (Rgb, &[255, 165, 0], false, false),
            (Rgb, &[255, 255, 106], false, true), // 205.3 of 255: dark by 0.195, and the threshold is 0.196
            (Rgb, &[255, 255, 105], false, false),
            (Rgb, &[0, 0, 255], true, false),
            (Rgb, &[0, 0, 140], true, true),
            (Rgba, &[255, 255, 255, 0], false, false), // transparent white: 191.25
            (GrayscaleAlpha, &[255, 60], false, true),
            (GrayscaleAlpha, &[255, 40], false, false),
        ] {
            assert_eq!(middle_is_free(colour, pixel, negate).0, is_free, "{pixel:?}, negate: {negate}");
        }
        let (_, notes) = middle_is_free(Rgba, &[255; 4], false);
        assert_eq!(notes.len(), 2, "{notes:?}");
        assert!(
            notes[0].starts_with("/room.png: opacity counts as a fourth colour, as in map_server"),
            "{notes:?}"
        );
        let ignored = "/room.yaml: ignored keys: `origin`, `resolution`; docs/FILES.md has the reasons";
        assert_eq!(middle_is_free(Rgb, &[255; 3], false).1, [ignored]);
        let (_, notes) = middle_is_free(Rgb, &[255, 255, 254], false);
        assert!(
            notes[0].starts_with("/room.png: colours count by their mean, as in map_server"),
            "{notes:?}"
        );
        assert_eq!(notes.len(), 2, "{notes:?}");
    }
}
