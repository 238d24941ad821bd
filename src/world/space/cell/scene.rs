//! Scenes from files: where the robot stands and still obstacles by name, in millimetres as drawings give them.

use crate::geometry::{Capsule, Convex, Frame, GeometryError, OrientedBox, Solid, Sphere, Vec3};
use crate::kinematics::FARTHEST_MM;
use crate::space::SupportEntry;
use base::settings::{Accepted, Document, Faults, SettingsError, Spanned};
use base::units::{points_in_metres, radius_in_metres, seems_in_metres, seems_in_radians, unbent};
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
pub const SCENE_FILE: Accepted = Accepted::shape::<SceneFile>();

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
    /// The name of the sphere.
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

/// What is wrong with an obstacle: the way to it from the obstacle's table, and a sentence.
type Wrong = (String, String);

/// What is wrong with a shape whose corners are called `vertices_mm`, and a radius `radius_mm`.
fn wrong(error: &GeometryError) -> Wrong {
    let place = match error.place("vertices_mm") {
        radius if radius == "radius" => "radius_mm".to_owned(),
        other => other,
    };
    (place, format!("{error} (lengths in metres)"))
}

/// A solid that can be, if no length seems to be in metres: what is wrong with those that do, by their keys.
fn in_mm<const N: usize>(
    in_metres: [(&str, Option<String>); N],
    solid: Result<Solid, GeometryError>,
) -> Result<Solid, Vec<Wrong>> {
    let questions = in_metres.into_iter().filter_map(|(key, message)| Some((key.to_owned(), message?)));
    let faults: Vec<Wrong> = questions.chain(solid.as_ref().err().map(wrong)).collect();
    solid.ok().filter(|_| faults.is_empty()).ok_or(faults)
}

/// The longest side of a box is longer.
const SMALL_MM: f64 = 2.0;

impl BoxEntry {
    fn solid(&self) -> Result<Solid, Vec<Wrong>> {
        let turned_over = |axis: &usize| self.min_mm[*axis] >= self.max_mm[*axis];
        let fault = |axis: usize| {
            let (low, high) = (self.min_mm[axis], self.max_mm[axis]);
            let message =
                format!("`max_mm[{axis}]` is {high}; a number above `min_mm[{axis}]`, {low}, is accepted");
            (format!("max_mm.{axis}"), message)
        };
        let in_radians =
            seems_in_radians("yaw_deg", &[self.yaw_deg]).map(|(_, message)| ("yaw_deg".to_owned(), message));
        let sides: [f64; 3] = std::array::from_fn(|axis| self.max_mm[axis] - self.min_mm[axis]);
        let longest = unbent(sides.into_iter().fold(0.0, f64::max));
        let in_metres = (f64::MIN_POSITIVE..SMALL_MM).contains(&longest).then(|| {
            let message = format!(
                "no side is longer than {longest} mm; are lengths in metres? millimetres are accepted ({longest} m is {} mm)",
                unbent(longest * 1e3)
            );
            ("max_mm".to_owned(), message)
        });
        let faults = (0..3).filter(turned_over).map(fault).chain(in_radians).chain(in_metres);
        let faults: Vec<Wrong> = faults.collect();
        if !faults.is_empty() {
            return Err(faults);
        }
        let (min, max) = (metres(self.min_mm), metres(self.max_mm));
        let turn = Frame::turned(&Vec3::z(), self.yaw_deg.to_radians());
        let solid = OrientedBox::new(Frame::at((min + max) * 0.5) * turn, max - min);
        solid.map(Solid::Box).map_err(|error| vec![wrong(&error)])
    }
}

impl SphereEntry {
    fn solid(&self) -> Result<Solid, Vec<Wrong>> {
        let solid = Sphere::new(metres(self.center_mm), self.radius_mm * 1e-3);
        in_mm([("radius_mm", radius_in_metres("radius_mm", self.radius_mm))], solid.map(Solid::Sphere))
    }
}

impl CapsuleEntry {
    fn solid(&self) -> Result<Solid, Vec<Wrong>> {
        let radius_m = self.radius_mm * 1e-3;
        let solid = Capsule::new(metres(self.from_mm), metres(self.to_mm), radius_m);
        let ends = points_in_metres("from_mm and to_mm", self.from_mm.iter().chain(&self.to_mm));
        let radius = radius_in_metres("radius_mm", self.radius_mm);
        in_mm([("from_mm", ends), ("radius_mm", radius)], solid.map(Solid::Capsule))
    }
}

impl ConvexEntry {
    fn solid(&self) -> Result<Solid, Vec<Wrong>> {
        let vertices = self.vertices_mm.iter().map(|vertex| metres(*vertex)).collect();
        let reach = |axis: usize| {
            let along = self.vertices_mm.iter().map(|vertex| vertex[axis]);
            along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min)
        };
        let widest = (0..3).map(reach).fold(0.0, f64::max);
        let in_metres = seems_in_metres("the greatest extent of vertices_mm", widest);
        in_mm([("vertices_mm", in_metres)], Convex::from_vertices(vertices).map(Solid::Convex))
    }
}

/// An obstacle's name, and its shape if that can be.
type Named<'a> = (&'a str, Result<Solid, Vec<Wrong>>);

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

    /// The obstacles of each kind in the order of the file, by name, as far as they can be.
    fn solids(&self) -> [(&'static str, Vec<Named<'_>>); 4] {
        let boxes = self.boxes.iter().map(Spanned::get_ref).map(|e| (e.name.as_str(), e.solid()));
        let spheres = self.spheres.iter().map(Spanned::get_ref).map(|e| (e.name.as_str(), e.solid()));
        let capsules = self.capsules.iter().map(Spanned::get_ref).map(|e| (e.name.as_str(), e.solid()));
        let convexes = self.convexes.iter().map(Spanned::get_ref).map(|e| (e.name.as_str(), e.solid()));
        [
            ("box", boxes.collect()),
            ("sphere", spheres.collect()),
            ("capsule", capsules.collect()),
            ("convex", convexes.collect()),
        ]
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
                    unbent(length * 1e3)
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
        Self::parse(&*Document::open(path)?)
    }

    /// The scene that `document` describes.
    ///
    /// # Errors
    /// All of them at once, with line and column: an unknown key, a number that is not finite, a size that is not above 0, a
    /// shape that encloses nothing, a name that stands twice. Obstacles that all lie within 10 mm are refused too, as in a file in metres.
    pub fn parse(document: &Document) -> Result<Self, SettingsError> {
        let file: SceneFile = document.read()?;
        let mut faults = Faults::default();
        faults.keep(file.millimetres(document));
        let mut scene =
            Self { name: file.name.clone(), base: Frame::IDENTITY, obstacles: Vec::new(), under: 0 };
        scene.stand_on(document, &file.support, &mut faults);
        for (kind, obstacles) in file.solids() {
            for (index, (name, solid)) in obstacles.into_iter().enumerate() {
                let fault = |key: &str, message: &str| {
                    let message = format!("obstacle `{name}`: {message}");
                    document.error_at(&format!("{kind}.{index}.{key}"), message)
                };
                if scene.obstacles.iter().any(|obstacle| obstacle.name == *name) {
                    faults.add(fault("name", "the name stands twice; accepted: a name of its own"));
                }
                match solid {
                    Ok(solid) => scene.obstacles.push(Obstacle { name: name.to_owned(), solid }),
                    Err(wrong) => {
                        for (key, message) in wrong {
                            faults.add(fault(&key, &message));
                        }
                    }
                }
            }
        }
        faults.or(Some(scene))
    }

    /// Puts the base where `support` says, and what is under it among the obstacles.
    fn stand_on(&mut self, document: &Document, support: &Spanned<SupportEntry>, faults: &mut Faults) {
        let read = match support.get_ref().support() {
            Ok(read) => read,
            Err((key, message)) => return faults.add(document.error_at(&format!("support.{key}"), message)),
        };
        self.base = *read.base();
        match read.solids() {
            Ok(solids) => self
                .obstacles
                .extend(solids.into_iter().map(|(name, solid)| Obstacle { name: name.to_owned(), solid })),
            Err(error) => faults.add(document.error(support.span(), error.to_string())),
        }
        self.under = self.obstacles.len();
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
            let mut frame = *solid.frame();
            let half = *solid.half();
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
mod tests;
