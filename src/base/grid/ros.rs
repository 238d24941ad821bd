//! Occupancy maps of ROS: an image with a YAML file beside it.
//!
//! With `p` the darkness of a pixel from 0 to 1 (its brightness with `negate`), a cell is blocked where `p > occupied_thresh`, free
//! where `p < free_thresh`, unknown in between; what is unknown is blocked. The brightness is the mean of the colour channels, and of
//! the opacity if the image has one. `map_server` and nav2 up to Humble do so in the mode `trinary`, the only one that is read. Cells are
//! counted from the lower left pixel. A map that is turned, by a yaw in its `origin`, is refused.
//!
//! Every key but `mode` must be there: `map_server` and nav2 load no map without one, and have no default for it.
//!
//! Source: the page "Map format" of <https://wiki.ros.org/map_server>; `loadMapFromYaml` in `main.cpp` and `loadMapFromFile` in
//! `image_loader.cpp` of ros-planning/navigation (noetic-devel, 9ad64419); `loadMapYaml` and `loadMapFromFile` in `map_io.cpp` of
//! ros-navigation/navigation2 (humble), which agree but for palettes. In nav2 from Jazzy on (8d694833, pull request 5071) colours are
//! weighed by luminance and what is transparent is unknown; maps for which that matters are noted.

use super::image::Image;
use crate::ignored::{ignored_note, is_ignored};
use crate::settings::{Document, SettingsError};
use crate::solid::Source;
use crate::yaml::{Node, Yaml};
use std::path::{Path, PathBuf};

/// What the YAML file of a ROS map says.
pub(super) struct Head {
    /// The image.
    pub(super) image: PathBuf,
    is_negated: bool,
    /// What is ignored of the file, in a sentence.
    ignored: Option<String>,
    free_below: f64,
}

/// The keys that are read; for those that are passed over see the table of ignored keys.
const READ: [&str; 7] = ["image", "mode", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"];

impl Head {
    /// The head in the file at `path`.
    pub(super) fn read(path: &Path) -> Result<Self, SettingsError> {
        let document = Document::open(path)?;
        let root = Yaml::parse(&document)?;
        let yaml = Yaml(Source(&document));
        yaml.only(&root, &READ)?;
        let resolution = yaml.get(&root, "resolution")?;
        yaml.0.sizes(&resolution.at, "resolution", [yaml.number(resolution, "resolution")?])?;
        check_origin(yaml, &root)?;
        if let Some(mode) = yaml.find(&root, "mode")?
            && yaml.word(mode)? != "trinary"
        {
            let found = if mode.is_empty() {
                "nothing".to_owned()
            } else {
                format!("`{}`", crate::text::brief(yaml.word(mode)?))
            };
            let message =
                format!("mode is {found}; `trinary` is accepted, in small letters as map_server reads it");
            return Err(yaml.0.fault(&mode.at, message));
        }
        let named = yaml.get(&root, "image")?;
        let image = path.parent().unwrap_or(Path::new("")).join(yaml.word(named)?);
        if !image.exists() {
            let message =
                format!("there is no image `{}`; looked for {}", yaml.word(named)?, image.display());
            return Err(yaml.0.fault(&named.at, message));
        }
        let is_negated = yaml.truth(yaml.get(&root, "negate")?, "negate")?;
        let ignored = root.keys().filter(|key| is_ignored("ROS map", key)).map(str::to_owned).collect();
        let ignored = ignored_note(&ignored).map(|note| format!("{}: {note}", path.display()));
        Ok(Self { image, is_negated, ignored, free_below: free_below(yaml, &root)? })
    }

    /// Whether a pixel as bright as this is free.
    pub(super) fn is_free(&self, bright: f64) -> bool {
        let dark = if self.is_negated { bright } else { 1.0 - bright };
        dark < self.free_below
    }

    /// What a reader of results should know of how `image` is taken.
    pub(super) fn notes(&self, image: &Image) -> Vec<String> {
        let name = self.image.display();
        let opacity = image.has_opacity().then(|| {
            format!(
                "{name}: opacity counts as a fourth colour, as in map_server and in nav2 up to Humble; later ones take what is \
                 transparent for unknown"
            )
        });
        let colours = image.is_coloured().then(|| {
            format!(
                "{name}: colours count by their mean, as in map_server and in nav2 up to Humble; later ones weigh them by luminance"
            )
        });
        let palette = image.has_palette.then(|| {
            format!("{name}: its palette's colours are taken, as in nav2; map_server takes the numbers of the colours")
        });
        opacity.into_iter().chain(colours).chain(palette).chain(self.ignored.clone()).collect()
    }
}

/// The place of the lower left pixel is not used, but the map's axes are those of the world.
fn check_origin(yaml: Yaml<'_>, root: &Node) -> Result<(), SettingsError> {
    let origin = yaml.get(root, "origin")?;
    let [_, _, yaw] = yaml.exactly::<3>(origin, "origin")?;
    if yaw == 0.0 {
        return Ok(());
    }
    let message = format!("origin turns the map by the yaw {yaw}; 0 is accepted, a map along its own axes");
    Err(yaml.0.fault(&origin.at, message))
}

/// The darkness below which a cell is free; what is darker than `occupied_thresh` must not be.
fn free_below(yaml: Yaml<'_>, root: &Node) -> Result<f64, SettingsError> {
    let share = |key: &str| {
        let node = yaml.get(root, key)?;
        match yaml.number(node, key)? {
            share if (0.0..=1.0).contains(&share) => Ok((node, share)),
            other => {
                let question = if other > 1.0 { "is it in per cent or a pixel's value? " } else { "" };
                let message = format!("{key} is {other}; {question}a number from 0 to 1 is accepted");
                Err(yaml.0.fault(&node.at, message))
            }
        }
    };
    let (_, blocked) = share("occupied_thresh")?;
    let (node, free) = share("free_thresh")?;
    if free <= blocked {
        return Ok(free);
    }
    let message = format!("free_thresh is {free}; at most occupied_thresh, {blocked}, is accepted");
    Err(yaml.0.fault(&node.at, message))
}
