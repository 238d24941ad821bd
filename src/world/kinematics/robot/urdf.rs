//! Six-axis robots from URDF files: Denavit–Hartenberg rows from the axes of the joints, so that the closed forms fit them.
//!
//! The rows are those of the common normals of neighbouring axes; where two are parallel, the normal through the frame before.
//! What stands before the first axis is the base, what stands behind the last the flange. Each solid becomes the capsule around
//! it, exactly for spheres and with round ends for cylinders. Boxes and meshes become the least one along their longest side.
//! Contact is never missed and sometimes seen too early. An SRDF file says which links may touch. Without one, two links that a
//! joint joins are never held against each other, nor two parts that touch in every one of 200 configurations drawn from a
//! written seed.

use super::{Body, Part, Robot};
use crate::geometry::{Capsule, Frame, Vec3};
use crate::kinematics::open_chain::{OpenChain, frame};
use crate::kinematics::serial::{AXES, Chain, Joint};
use crate::kinematics::{Arm, KinematicsError};
use base::robot::{Kind, MayTouch};
use base::seed;
use base::solid::{Form, Solid};
use nalgebra::Matrix3;
use rand::RngExt as _;

/// What the only body of a URDF robot is called.
pub const URDF_BODY: &str = "urdf";

/// Below this sine two axes are parallel.
const PARALLEL: f64 = 1e-9;

/// Configurations in which two parts that always touch are found out.
const DRAWS: usize = 200;

/// The robot in a URDF file that was read, with what an SRDF file says of its links, if there is one.
pub(super) fn robot(
    read: &base::robot::Robot,
    may_touch: Option<&MayTouch>,
) -> Result<Robot, KinematicsError> {
    let open = OpenChain::new(read);
    let count = open.joints().len();
    if count != AXES {
        return Err(KinematicsError::Axes { robot: read.name.clone(), found: count });
    }
    let mut speeds = [0.0; AXES];
    for (speed, joint) in speeds.iter_mut().zip(&read.joints) {
        *speed = speed_rad_s(joint)?;
    }
    let zero = [0.0; AXES];
    let frames = open.frames(&zero);
    let links = links_at_zero(&open);
    let joints = std::array::from_fn(|i| Joint {
        lower_rad: limits_rad(&read.joints[i])[0],
        upper_rad: limits_rad(&read.joints[i])[1],
        speed_rad_s: speeds[i],
        ..row(&links[i], &links[i + 1])
    });
    let flange = links[AXES].inverse() * open.forward(&zero);
    let chain = Chain::new(joints, links[0], flange)?;
    let parts = read.solids.iter().map(|(link, solid)| {
        let into = links[*link].inverse() * frames[*link];
        let capsule = capsule_around(solid, &into)?;
        Ok(Part { name: solid.name.clone(), link: *link, tool_share: None, self_only: *link == 0, capsule })
    });
    let parts: Vec<Part> = parts.collect::<Result<_, KinematicsError>>()?;
    let self_pairs =
        may_touch.map_or_else(|| self_pairs(&chain, &parts), |may_touch| listed_pairs(read, may_touch));
    let body = Body { name: URDF_BODY.to_owned(), parts, self_pairs };
    Ok(Robot {
        name: read.name.clone(),
        arm: Arm::new(chain, None)?,
        flange,
        tool_length_m: 0.0,
        bodies: vec![body],
        files: read.files.clone(),
        notes: enclosed(&read.solids)
            .into_iter()
            .chain(read.notes.iter().cloned())
            .chain(may_touch.iter().flat_map(|file| file.notes.clone()))
            .collect(),
    })
}

/// The greatest speed of a joint that a work cell's arm may have.
fn speed_rad_s(joint: &base::robot::Joint) -> Result<f64, KinematicsError> {
    let unfit = |why| KinematicsError::Unfit { joint: joint.name.clone(), why };
    match (joint.kind, joint.speed) {
        (Kind::Slides, _) => Err(unfit("slides, which inverse kinematics does not know")),
        (_, None) => Err(unfit("has no `velocity` above 0, which a cell's arm needs")),
        (_, Some(_)) if joint.is_too_fast() => Err(unfit(
            "has a `velocity` that no joint has, is it in degrees a second? A cell's arm needs one in radians",
        )),
        (_, Some(speed)) => Ok(speed),
    }
}

/// The limits of a joint; a continuous one has none.
fn limits_rad(joint: &base::robot::Joint) -> [f64; 2] {
    if joint.kind == Kind::TurnsOn { [f64::NEG_INFINITY, f64::INFINITY] } else { joint.limits }
}

/// What capsules stand for, unless every solid is a sphere.
fn enclosed(solids: &[(usize, Solid)]) -> Option<String> {
    let count = |is_it: fn(&Form) -> bool| solids.iter().filter(|(_, solid)| is_it(&solid.form)).count();
    let kinds = [
        ("boxes", count(|form| matches!(form, Form::Box(_)))),
        ("cylinders", count(|form| matches!(form, Form::Cylinder(..)))),
        ("meshes, by the hulls of their STL vertices", count(|form| matches!(form, Form::Hull(_)))),
    ];
    let found: Vec<String> = kinds
        .iter()
        .filter(|(_, count)| *count > 0)
        .map(|(name, count)| format!("{name}: {count}"))
        .collect();
    (!found.is_empty()).then(|| {
        format!(
            "the capsules around them stand for its solids ({}); contact is never missed and sometimes seen too early",
            found.join("; ")
        )
    })
}

/// The frames of base and links where every joint is at 0, as rows lead from each to the next; the last is that before it.
///
/// # Panics
/// If there is no joint.
pub fn links_at_zero(open: &OpenChain) -> Vec<Frame> {
    let frames = open.frames(&vec![0.0; open.joints().len()]);
    let axis = |i: usize| frames[i + 1].rotation * open.joints()[i].axis;
    let first = axis(0);
    let side = if first.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
    let x = (side - first * side.dot(&first)).normalize();
    let mut at = framed(frames[1].origin, x, first);
    let mut links = vec![at];
    for i in 1..open.joints().len() {
        at = ahead(&at, frames[i + 1].origin, axis(i));
        links.push(at);
    }
    links.push(at);
    links
}

fn framed(origin: Vec3, x: Vec3, z: Vec3) -> Frame {
    Frame { rotation: Matrix3::from_columns(&[x, z.cross(&x), z]), origin }
}

/// The frame on the axis through `point` along `z`, whose x leads away from the z of `at`.
fn ahead(at: &Frame, point: Vec3, z: Vec3) -> Frame {
    let before = at.axis(2);
    let across = at.axis(2).cross(&z);
    let apart = point - at.origin;
    if across.norm() > PARALLEL {
        let x = across.normalize();
        // How far along `z` the common normal meets the second axis.
        let along = before.cross(&apart).dot(&across) / across.norm_squared();
        return framed(point - z * along, x, z);
    }
    let z = before * before.dot(&z).signum();
    let normal = apart - before * apart.dot(&before);
    let x = if normal.norm() > 1e-12 { normal.normalize() } else { at.axis(0) };
    framed(at.origin + normal, x, z)
}

/// The row that leads from one frame to the next; limits and speed are its caller's.
fn row(from: &Frame, to: &Frame) -> Joint {
    let apart = to.origin - from.origin;
    let turned = |a: &Vec3, b: &Vec3, about: &Vec3| libm::atan2(a.cross(b).dot(about), a.dot(b));
    Joint {
        alpha_rad: turned(&from.axis(2), &to.axis(2), &to.axis(0)),
        a_m: apart.dot(&to.axis(0)),
        d_m: apart.dot(&from.axis(2)),
        offset_rad: turned(&from.axis(0), &to.axis(0), &from.axis(2)),
        lower_rad: 0.0,
        upper_rad: 0.0,
        speed_rad_s: 0.0,
    }
}

/// The capsule around a solid that is given in the frame `into`.
///
/// # Errors
/// [`KinematicsError::Shape`] if it encloses nothing.
pub fn capsule_around(solid: &Solid, into: &Frame) -> Result<Capsule, KinematicsError> {
    let at = *into * frame(&solid.pose);
    let (points, middle, along, radius) = match &solid.form {
        Form::Sphere(radius) => (vec![Vec3::zeros()], Vec3::zeros(), Vec3::z(), *radius),
        Form::Cylinder(radius, length) => {
            let ends = [0.5, -0.5].map(|share| Vec3::z() * (share * length));
            return Ok(Capsule::new(at.point(&ends[0]), at.point(&ends[1]), *radius)?);
        }
        Form::Box(half) => {
            let corner =
                |i: usize| Vec3::from_fn(|axis, _| if i >> axis & 1 == 1 { half[axis] } else { -half[axis] });
            around((0..8).map(corner).collect())
        }
        Form::Hull(points) => around(points.iter().copied().map(Vec3::from).collect()),
    };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for point in &points {
        let share = (point - middle).dot(&along);
        let off = (point - middle - along * share).norm();
        let spare = (radius * radius - off * off).max(0.0).sqrt();
        (low, high) = (low.min(share + spare), high.max(share - spare));
    }
    let [low, high] = if low > high { [0.5 * (low + high); 2] } else { [low, high] };
    let ends = [low, high].map(|share| at.point(&(middle + along * share)));
    Ok(Capsule::new(ends[0], ends[1], radius)?)
}

/// Points with the middle and the direction of the longest side of the box around them, and how far they are from that line.
fn around(points: Vec<Vec3>) -> (Vec<Vec3>, Vec3, Vec3, f64) {
    let low = points.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let high = points.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
    let middle = (low + high) * 0.5;
    let size = high - low;
    let mut along = Vec3::zeros();
    along[size.imax()] = 1.0;
    let off = |point: &Vec3| (point - middle - along * (point - middle).dot(&along)).norm();
    let radius = points.iter().map(off).fold(0.0, f64::max);
    (points, middle, along, radius)
}

/// The pairs of parts of different links that an SRDF file does not let touch.
pub fn listed_pairs(read: &base::robot::Robot, may_touch: &MayTouch) -> Vec<[usize; 2]> {
    let pairs = (0..read.solids.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    let is_held = |[a, b]: &[usize; 2]| {
        read.solids[*a].0 != read.solids[*b].0 && !may_touch.allows(&read.owners[*a], &read.owners[*b])
    };
    pairs.filter(is_held).collect()
}

fn self_pairs(chain: &Chain, parts: &[Part]) -> Vec<[usize; 2]> {
    use crate::geometry::intersects_capsule_capsule;
    let mut pairs: Vec<([usize; 2], bool)> = Vec::new();
    for b in 0..parts.len() {
        pairs.extend((0..b).filter(|a| parts[*a].link.abs_diff(parts[b].link) > 1).map(|a| ([a, b], true)));
    }
    let mut stream = seed::stream(seed::derive(0, &["urdf", "pairs that always touch"]));
    for _ in 0..DRAWS {
        let q = chain.joints().map(|joint| {
            let [lower, upper] = joint.range_rad();
            stream.random_range(lower..upper)
        });
        let frames = chain.frames(&q);
        for ([a, b], always) in &mut pairs {
            let [one, other] = [&parts[*a], &parts[*b]].map(|part| part.placed(&frames));
            *always &= intersects_capsule_capsule(&one, &other);
        }
    }
    pairs.into_iter().filter(|(_, always)| !always).map(|(pair, _)| pair).collect()
}
