//! A scene of polyhedra as the exhibits of a prepared object hold it, and the views it is seen from.

use crate::analysis::evidence::Run;
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::{Axis, Key, Panel, Trim};
use crate::render::scene3::{Camera, Paint, ScaleBar, Scene, SceneMark, Vec3};
use crate::render::style::{BLACK, SKY, Stroke, WHITE};
use crate::study::key::{DrawKey, Owner};
use engine::planner::Exhibit;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// From where a scene is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum View {
    /// From the front, a little from above: x to the right.
    Front,
    /// From the side: y to the left, towards the front.
    Side,
    /// From a corner, above.
    Corner,
}

impl View {
    fn camera(self) -> Camera {
        match self {
            Self::Front => Camera::parallel(-80.0, 14.0),
            Self::Side => Camera::parallel(-10.0, 14.0),
            Self::Corner => Camera::parallel(-52.0, 24.0),
        }
    }

    /// Its name in a panel's title.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Side => "side",
            Self::Corner => "corner",
        }
    }
}

/// The exhibit called `name` of `of`.
pub(super) fn stored<'a>(
    run: &'a Run<'_>,
    of: impl Into<Owner>,
    name: &str,
) -> Result<&'a Exhibit, RenderError> {
    let of = of.into();
    run.exhibit(of.clone(), name).ok_or_else(|| RenderError::NotStored {
        what: format!("the exhibit `{name}` of `{}`", run.owner(&of)),
    })
}

/// The points of an exhibit three numbers wide.
pub(super) fn points(exhibit: &Exhibit) -> Vec<Vec3> {
    exhibit.values.chunks(exhibit.width).map(|point| [point[0], point[1], point[2]]).collect()
}

/// Adds the obstacles of the prepared object `of`, and with `frame` the edges of the domain.
pub(super) fn add_obstacles(
    scene: &mut Scene,
    run: &Run<'_>,
    of: &Arc<DrawKey>,
    frame: bool,
) -> Result<(), RenderError> {
    let vertices = points(stored(run, of, "bodies_vertices")?);
    let listed = stored(run, of, "bodies_faces")?;
    let mut faces: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for pair in listed.values.chunks(listed.width) {
        faces.entry(pair[0] as usize).or_default().push(pair[1] as usize);
    }
    for (vertices, faces) in solids(&vertices, faces.into_values().collect()) {
        scene.polyhedron(vertices, faces, Paint::sheer(SKY.mixed(WHITE, 0.25), 0.82));
    }
    if frame {
        let corners = points(stored(run, of, "domain")?);
        for edge in edges(corners[0], corners[1]) {
            scene.polyline(edge.to_vec(), Stroke::solid(BLACK.mixed(WHITE, 0.7), 0.4));
        }
    }
    Ok(())
}

/// Faces that share vertices, taken together with vertices numbered from 0.
fn solids(vertices: &[Vec3], faces: Vec<Vec<usize>>) -> Vec<(Vec<Vec3>, Vec<Vec<usize>>)> {
    let mut solids: Vec<(usize, usize, Vec<Vec<usize>>)> = Vec::new();
    for face in faces {
        let (low, high) = (face.iter().min().copied(), face.iter().max().copied());
        let (low, high) = (low.unwrap_or(0), high.unwrap_or(0));
        match solids.last_mut().filter(|solid| low <= solid.1) {
            Some(solid) => {
                (solid.0, solid.1) = (solid.0.min(low), solid.1.max(high));
                solid.2.push(face);
            }
            None => solids.push((low, high, vec![face])),
        }
    }
    let own = |(low, high, faces): (usize, usize, Vec<Vec<usize>>)| {
        let faces = faces.into_iter().map(|face| face.into_iter().map(|v| v - low).collect()).collect();
        (vertices[low..=high].to_vec(), faces)
    };
    solids.into_iter().map(own).collect()
}

/// The twelve edges of a box.
fn edges(low: Vec3, high: Vec3) -> Vec<[Vec3; 2]> {
    let corner =
        |index: usize| [0, 1, 2].map(|axis| if index >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let pairs = (0..8).flat_map(|index| (0..3).map(move |axis| (index, index | 1 << axis)));
    pairs.filter(|(from, to)| from != to).map(|(from, to)| [corner(from), corner(to)]).collect()
}

/// A panel that shows `scene`.
pub(super) fn panel(
    title: String,
    scene: Scene,
    view: View,
    mut keys: Vec<Key>,
) -> Result<Panel, RenderError> {
    let bare = || Axis::linear("", 0.0, 1.0);
    let mut panel = Panel::new(title, bare()?, bare()?).trimmed(Trim::Bare);
    keys.push(cell_key("obstacle", SKY.mixed(WHITE, 0.25)));
    let bar = Some(ScaleBar { length: 20.0, label: "20 cm".to_owned() });
    panel.add(SceneMark { scene, camera: view.camera(), bar, keys });
    Ok(panel)
}
