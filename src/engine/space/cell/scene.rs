//! Scenes from files: where the robot stands and still obstacles by name, in millimetres as drawings give them.

use crate::geometry::{Capsule, Convex, Frame, GeometryError, OrientedBox, Solid, Sphere, Vec3};
use crate::kinematics::FARTHEST_MM;
use crate::space::SupportEntry;
use base::settings::{Accepted, Document, Faults, SettingsError, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;
use std::ops::Range;
use std::path::Path;

/// What stands still around a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    name: String,
    base: Frame,
    obstacles: Vec<Obstacle>,
    /// How many of them, at the front, are what the robot stands on.
    under: usize,
}

/// One obstacle of a scene, in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// Its name in messages and pictures.
    pub name: String,
    /// Its shape.
    pub solid: Solid,
}

/// What a scene file may hold.
pub const SCENE_FILE: Accepted = Accepted::of::<SceneFile>();

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    /// Its name.
    name: String,
    /// Where the arm's base stands and what is under it.
    support: Spanned<SupportEntry>,
    /// Boxes along the axes, which may be turned about the vertical.
    #[serde(default, rename = "box")]
    boxes: Vec<Spanned<BoxEntry>>,
    /// Spheres.
    #[serde(default, rename = "sphere")]
    spheres: Vec<Spanned<SphereEntry>>,
    /// Capsules: all that is near a line from one point to another.
    #[serde(default, rename = "capsule")]
    capsules: Vec<Spanned<CapsuleEntry>>,
    /// Convex solids by their corners.
    #[serde(default, rename = "convex")]
    convexes: Vec<Spanned<ConvexEntry>>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct BoxEntry {
    /// Its name.
    name: String,
    /// x, y and z of the lowest corner, before it is turned.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    min_mm: [f64; 3],
    /// x, y and z of the highest corner, before it is turned.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    max_mm: [f64; 3],
    /// Turn about the vertical through the middle.
    #[serde(default)]
    yaw_deg: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SphereEntry {
    /// Its name.
    name: String,
    /// x, y and z of the centre.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    center_mm: [f64; 3],
    /// The radius.
    #[schemars(range(max = FARTHEST_MM))]
    radius_mm: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CapsuleEntry {
    /// Its name.
    name: String,
    /// x, y and z of one end of the line.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    from_mm: [f64; 3],
    /// x, y and z of the other end.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    to_mm: [f64; 3],
    /// The radius.
    #[schemars(range(max = FARTHEST_MM))]
    radius_mm: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ConvexEntry {
    /// Its name.
    name: String,
    /// Points whose convex hull it is.
    #[schemars(inner(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM))))]
    vertices_mm: Vec<[f64; 3]>,
}

fn metres(point_mm: [f64; 3]) -> Vec3 {
    Vec3::from(point_mm) * 1e-3
}

impl BoxEntry {
    fn solid(&self) -> Result<Solid, GeometryError> {
        let (min, max) = (metres(self.min_mm), metres(self.max_mm));
        let turn = Frame::turned(&Vec3::z(), self.yaw_deg.to_radians());
        let solid = OrientedBox::new(Frame::at((min + max) * 0.5) * turn, max - min)?;
        Ok(Solid::Box(solid))
    }
}

impl SphereEntry {
    fn solid(&self) -> Result<Solid, GeometryError> {
        Ok(Solid::Sphere(Sphere::new(metres(self.center_mm), self.radius_mm * 1e-3)?))
    }
}

impl CapsuleEntry {
    fn solid(&self) -> Result<Solid, GeometryError> {
        let radius_m = self.radius_mm * 1e-3;
        Ok(Solid::Capsule(Capsule::new(metres(self.from_mm), metres(self.to_mm), radius_m)?))
    }
}

impl ConvexEntry {
    fn solid(&self) -> Result<Solid, GeometryError> {
        let vertices = self.vertices_mm.iter().map(|vertex| metres(*vertex)).collect();
        Ok(Solid::Convex(Convex::from_vertices(vertices)?))
    }
}

impl SceneFile {
    /// Every number of the obstacles, with the place of its obstacle.
    fn lengths_mm(&self) -> impl Iterator<Item = (Range<usize>, f64)> {
        let boxes = self.boxes.iter().map(|e| (e.span(), [e.get_ref().min_mm, e.get_ref().max_mm].concat()));
        let spheres = self.spheres.iter().map(|e| {
            let SphereEntry { center_mm, radius_mm, .. } = e.get_ref();
            (e.span(), [&center_mm[..], &[*radius_mm]].concat())
        });
        let capsules = self.capsules.iter().map(|e| {
            let CapsuleEntry { from_mm, to_mm, radius_mm, .. } = e.get_ref();
            (e.span(), [&from_mm[..], to_mm, &[*radius_mm]].concat())
        });
        let convexes = self.convexes.iter().map(|e| (e.span(), e.get_ref().vertices_mm.concat()));
        let all = boxes.chain(spheres).chain(capsules).chain(convexes);
        all.flat_map(|(at, lengths)| lengths.into_iter().map(move |length| (at.clone(), length.abs())))
    }

    /// That the scene is not a thousandth of its size, as one written in metres is.
    fn millimetres(&self, document: &Document) -> Result<(), SettingsError> {
        const NEAR_MM: f64 = 10.0;
        let farthest = self.lengths_mm().max_by(|a, b| a.1.total_cmp(&b.1));
        match farthest.filter(|(_, length)| (f64::MIN_POSITIVE..NEAR_MM).contains(length)) {
            None => Ok(()),
            Some((at, length)) => Err(document.error(
                at,
                format!(
                    "no obstacle reaches farther than {length} mm from the origin; are lengths in metres? millimetres are \
                     accepted ({length} m is {} mm)",
                    length * 1e3
                ),
            )),
        }
    }
}

impl Scene {
    /// The scene in the file at `path`.
    ///
    /// # Errors
    /// As [`parse`](Self::parse), and if the file cannot be read.
    pub fn load(path: &Path) -> Result<Self, SettingsError> {
        Self::parse(Document::open(path)?.as_ref())
    }

    /// The scene that `document` describes.
    ///
    /// # Errors
    /// All of them at once: the line and column of an unknown key, a number that is not finite, a size that is not above 0, a shape that
    /// encloses nothing, a name that stands twice, or obstacles that all lie within 10 mm, as in a file in metres.
    pub fn parse(document: &Document) -> Result<Self, SettingsError> {
        let file: SceneFile = document.read()?;
        let (support, mut faults) = (&file.support, Faults::default());
        faults.keep(file.millimetres(document));
        let read = support.get_ref().support().map_err(|message| document.error(support.span(), message))?;
        let mut scene = Self { name: file.name, base: *read.base(), obstacles: Vec::new(), under: 0 };
        for (name, solid) in read.solids().map_err(|e| document.error(support.span(), e.to_string()))? {
            faults.keep(scene.add(document, name, support, Ok(solid)));
            scene.under += 1;
        }
        for entry in &file.boxes {
            faults.keep(scene.add(document, &entry.get_ref().name, entry, entry.get_ref().solid()));
        }
        for entry in &file.spheres {
            faults.keep(scene.add(document, &entry.get_ref().name, entry, entry.get_ref().solid()));
        }
        for entry in &file.capsules {
            faults.keep(scene.add(document, &entry.get_ref().name, entry, entry.get_ref().solid()));
        }
        for entry in &file.convexes {
            faults.keep(scene.add(document, &entry.get_ref().name, entry, entry.get_ref().solid()));
        }
        faults.or(Some(scene))
    }

    fn add<T>(
        &mut self,
        document: &Document,
        name: &str,
        entry: &Spanned<T>,
        solid: Result<Solid, GeometryError>,
    ) -> Result<(), SettingsError> {
        let fault = |message: String| document.error(entry.span(), format!("obstacle `{name}`: {message}"));
        if self.obstacles.iter().any(|obstacle| obstacle.name == name) {
            return Err(fault("the name stands twice; accepted: a name of its own".to_owned()));
        }
        let solid = solid.map_err(|error| fault(format!("{error} (lengths in metres)")))?;
        self.obstacles.push(Obstacle { name: name.to_owned(), solid });
        Ok(())
    }

    /// The scene without anything in it, not even a floor.
    pub fn empty() -> Self {
        Self { name: "empty".to_owned(), base: Frame::IDENTITY, obstacles: Vec::new(), under: 0 }
    }

    /// The scene with nothing left in it but what the robot stands on.
    #[must_use]
    pub fn cleared(mut self) -> Self {
        self.obstacles.truncate(self.under);
        self
    }

    /// Where the robot's base stands.
    pub fn base(&self) -> &Frame {
        &self.base
    }

    /// The same scene with the box called `name` as high as this, standing where it stood.
    ///
    /// # Errors
    /// A sentence if there is no such box or the height is not above 0.
    pub fn with_height(&self, name: &str, height_m: f64) -> Result<Self, String> {
        let mut scene = self.clone();
        let is_box = |o: &Obstacle| matches!(o.solid, Solid::Box(_));
        let Some(obstacle) = scene.obstacles.iter_mut().find(|o| o.name == name && is_box(o)) else {
            let boxes = self.obstacles.iter().filter(|o| is_box(o)).map(|o| o.name.as_str());
            let known = boxes.collect::<Vec<_>>().join(", ");
            return Err(format!("there is no box `{name}`; the boxes are {known}"));
        };
        if let Solid::Box(solid) = &obstacle.solid {
            let (mut frame, half) = (*solid.frame(), *solid.half());
            frame.origin.z += 0.5 * height_m - half.z;
            let size = Vec3::new(2.0 * half.x, 2.0 * half.y, height_m);
            obstacle.solid = Solid::Box(OrientedBox::new(frame, size).map_err(|e| e.to_string())?);
        }
        Ok(scene)
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The obstacles, what the robot stands on first, in the order of the file within each kind.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: &str = "[support]\nunder = 'floor'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\n";

    fn refusal(text: &str) -> String {
        let floor = if text.contains("[support]") { "" } else { FLOOR };
        let document = Document::new(Path::new("s.toml"), format!("name = 's'\n{text}{floor}"));
        Scene::parse(&document).unwrap_err().to_string()
    }

    #[test]
    fn a_box_of_another_height_stands_where_it_stood() {
        let block = "[[box]]\nname = 'b'\nmin_mm = [0, 0, 100]\nmax_mm = [10, 20, 400]\nyaw_deg = 90\n";
        let text = format!("name = 's'\n{block}{FLOOR}");
        let scene = Scene::parse(&Document::new(Path::new("s.toml"), text)).unwrap();
        let changed = scene.with_height("b", 0.5).unwrap();
        let Some(Solid::Box(higher)) = changed.obstacles().last().map(|o| &o.solid) else { panic!("no box") };
        let z: Vec<f64> = higher.corners().iter().map(|corner| corner.z).collect();
        let [low, high] = [f64::min, f64::max].map(|of| z.iter().copied().reduce(of).unwrap());
        assert!((low - 0.1).abs() < 1e-12 && (high - 0.6).abs() < 1e-12, "{z:?}");
        assert_eq!(scene.with_height("c", 0.5).unwrap_err(), "there is no box `c`; the boxes are b");
        assert!(scene.with_height("b", 0.0).is_err());
    }

    #[test]
    fn every_kind_of_obstacle_is_read_in_metres() {
        let text = "name = 's'\n[support]\nunder = 'pedestal'\nbase_mm = [0, 0, 100]\nyaw_deg = 90\nfloor_mm = -5\n\
                    sides_mm = [200, 300]\n[[box]]\nname = 'b'\nmin_mm = [0, 0, 0]\nmax_mm = [100, 200, 300]\n\
                    yaw_deg = 90\n[[sphere]]\nname = 'k'\ncenter_mm = [1, 2, 3]\nradius_mm = 50\n[[capsule]]\nname = 'c'\n\
                    from_mm = [0, 0, 0]\nto_mm = [0, 0, 10]\nradius_mm = 5\n[[convex]]\nname = 'p'\n\
                    vertices_mm = [[0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]]\n";
        let scene = Scene::parse(&Document::new(Path::new("s.toml"), text.to_owned())).unwrap();
        let names: Vec<&str> = scene.obstacles().iter().map(|o| o.name.as_str()).collect();
        assert_eq!(names, ["floor", "pedestal", "b", "k", "c", "p"]);
        assert!((scene.base().origin.z - 0.1).abs() < 1e-15 && (scene.base().axis(0).y - 1.0).abs() < 1e-12);
        let turned = scene.obstacles()[2].solid.aabb();
        assert!((turned.max - Vec3::new(0.15, 0.15, 0.3)).norm() < 1e-12, "{turned:?}");
    }

    #[test]
    fn a_scene_that_does_not_say_what_is_under_the_arm_is_refused() {
        let document = Document::new(Path::new("s.toml"), "name = 's'\n".to_owned());
        let refusal = Scene::parse(&document).unwrap_err().to_string();
        let parts = ["s.toml:1:1", "missing key `support`", "what is under it"];
        assert!(parts.iter().all(|part| refusal.contains(part)), "{refusal}");
    }

    #[test]
    fn a_cleared_scene_keeps_what_the_robot_stands_on() {
        let text =
            format!("name = 's'\n{FLOOR}[[sphere]]\nname = 'k'\ncenter_mm = [1, 2, 3]\nradius_mm = 50\n");
        let scene = Scene::parse(&Document::new(Path::new("s.toml"), text)).unwrap().cleared();
        let names: Vec<&str> = scene.obstacles().iter().map(|o| o.name.as_str()).collect();
        assert_eq!(names, ["floor"]);
    }

    #[test]
    fn a_wrong_scene_says_which_obstacle_where_and_what_is_accepted() {
        for (text, parts) in [
            (
                "[[box]]\nname = 'b'\nmin_mm = [0, 0, 0]\nmax_mm = [1, -2, 3]\n",
                ["s.toml:2:1", "`b`", "greater than 0"],
            ),
            (
                "[[box]]\nname = 'b'\nmin_mm = [0.38, -0.04, 0]\nmax_mm = [0.9, 0.04, 0.55]\n",
                ["s.toml:2:1", "than 0.9 mm from the origin; are lengths in metres?", "(0.9 m is 900 mm)"],
            ),
            (
                "[[sphere]]\nname = 'k'\ncenter_mm = [0, nan, 0]\nradius_mm = 1\n",
                ["s.toml:4:17", "`center_mm[1]`", "finite"],
            ),
            (
                "[[sphere]]\nname = 'k'\ncenter_mm = [0, 0, 0]\nradius_mm = -1\n",
                ["s.toml:2:1", "radius", "0"],
            ),
            (
                "[support]\nunder = 'floor'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nfloor_mm = 3\n",
                ["s.toml:6:1", "floor_mm", "base_mm"],
            ),
            (
                "[support]\nunder = 'pedestal'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nfloor_mm = 3\nsides_mm = [1, 1]\n",
                ["s.toml:2:1", "at the base or above it", "a floor below it is accepted"],
            ),
            (
                "[[convex]]\nname = 'p'\nvertices_mm = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]\n",
                ["`p`", "enclose nothing", "plane"],
            ),
            (
                "[[sphere]]\nname = 'k'\ncenter_mm = [0, 0, 0]\nradius_mm = 1\n[[sphere]]\nname = 'k'\n\
                 center_mm = [0, 0, 9]\nradius_mm = 1\n",
                ["s.toml:6:1", "twice", "name of its own"],
            ),
        ] {
            let message = refusal(text);
            assert!(parts.iter().all(|part| message.contains(part)), "{message}");
        }
    }
}
