//! A cell in f32: what eight rough lanes read of the arm, its body and the scene.

use crate::geometry::lanes::{ROUGH_LANES, ROUGH_LEAST, ROUGHNESS, RoughRow, RoughSolid};
use crate::geometry::{Aabb, Capsule, Solid, Vec3};
use crate::kinematics::robot::Body;
use crate::kinematics::{AXES, Chain, RoughChain};
use crate::space::cell::Scene;
use std::ops::Range;

/// The share of its axis's length below which a part's radius is too small for distances from boxes in f32.
const SLENDER: f64 = 0.01;

/// Two parts that are kept apart.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub(super) parts: [usize; 2],
    /// The sum of the radii; NaN, with which every comparison is a doubt, if it is too little to be compared in f32.
    pub(super) touch_m: f32,
    /// How far apart the middles must be for the balls about the parts not to meet.
    pub(super) balls_m: f32,
}

/// A point.
pub(super) type End = [f32; 3];

/// What lanes read instead of a cell.
#[derive(Debug, Clone)]
pub(in crate::space::cell) struct Outline {
    pub(super) chain: RoughChain,
    /// Parts with the ends of their axes, those of one link next to each other.
    pub(super) axes: Vec<(usize, [End; 2])>,
    /// Where each link's are in `axes`.
    pub(super) on_link: [Range<usize>; AXES + 1],
    pub(super) radii_m: Vec<f32>,
    /// How far from the axis of each joint an end of a part can be, at most; 0 for a joint that does not move it.
    levers_m: Vec<[f32; AXES]>,
    /// As in the cell.
    pub(super) exposed: Vec<usize>,
    /// The obstacles; `None` for one that has no lanes.
    pub(super) solids: Vec<Option<RoughSolid>>,
    /// Which of them are half-spaces, and which are not.
    pub(super) walls: Vec<usize>,
    pub(super) bounded: Vec<usize>,
    /// The least and the greatest corner of the box about each.
    pub(super) boxes: Vec<[[f32; 3]; 2]>,
    /// The same, eight obstacles a block: the least x, y and z, then the greatest.
    pub(super) bounds: Vec<[RoughRow; 6]>,
    pub(super) pairs: Vec<Pair>,
    /// How close a comparison may be before the scalar code decides.
    pub(super) band_m: f32,
}

fn end(point: &Vec3) -> End {
    [point.x as f32, point.y as f32, point.z as f32]
}

impl Outline {
    pub(in crate::space::cell) fn new(
        chain: &Chain,
        body: &Body,
        scene: &Scene,
        exposed: &[usize],
        self_pairs: &[[usize; 2]],
    ) -> Self {
        let mut axes = Vec::new();
        let on_link = std::array::from_fn(|link| {
            let first = axes.len();
            for (index, part) in body.parts().iter().enumerate().filter(|(_, part)| part.link() == link) {
                let segment = &part.capsule().segment;
                axes.push((index, [end(&segment.a), end(&segment.b)]));
            }
            first..axes.len()
        });
        let solids = scene.obstacles().iter().map(|obstacle| &obstacle.solid);
        let reach_m = reach_m(chain, body);
        let extent_m = solids.clone().map(far_m).fold(reach_m, f64::max);
        let thinnest_m =
            exposed.iter().map(|part| body.parts()[*part].capsule().radius).fold(f64::INFINITY, f64::min);
        // Near an edge that a slender part grazes, the distance from a box is worse than elsewhere.
        let has_slender = exposed.iter().any(|part| is_slender(body.parts()[*part].capsule()));
        let rough_solid = |solid: &Solid| match solid {
            Solid::Box(_) if has_slender => None,
            Solid::Capsule(shape) if shape.radius + thinnest_m < ROUGH_LEAST * extent_m => None,
            _ => RoughSolid::from_solid(solid),
        };
        let boxes: Vec<_> = solids.clone().map(corners).collect();
        let (walls, bounded) = (0..scene.obstacles().len())
            .partition(|obstacle| matches!(scene.obstacles()[*obstacle].solid, Solid::HalfSpace(_)));
        Self {
            chain: RoughChain::from_chain(chain),
            axes,
            on_link,
            radii_m: body.parts().iter().map(|part| part.capsule().radius as f32).collect(),
            levers_m: body.parts().iter().map(|part| levers_m(chain, part.link(), part.capsule())).collect(),
            exposed: exposed.to_vec(),
            solids: solids.map(rough_solid).collect(),
            walls,
            bounded,
            bounds: boxes.chunks(ROUGH_LANES).map(block).collect(),
            boxes,
            pairs: self_pairs.iter().map(|parts| pair(body, *parts, reach_m)).collect(),
            band_m: (ROUGHNESS * extent_m) as f32,
        }
    }
}

impl Outline {
    /// What the joints contribute to [`bend_m`](Self::bend_m) where they change by `step` in a step.
    #[inline]
    pub(super) fn pulls(step: &[f32; AXES]) -> [f32; AXES] {
        let mut before = 0.0;
        step.map(|change| {
            let pull = change.abs() * (change.abs() + 2.0 * before);
            before += change.abs();
            pull
        })
    }

    /// The greatest second difference of an end's place on a line of the joints, per step squared.
    ///
    /// The second derivative by two joints' angles is a vector about the axis of the outer one, turned by the inner one: as
    /// long as the lever of the outer one at most.
    #[inline]
    pub(super) fn bend_m(&self, part: usize, pulls: &[f32; AXES]) -> f32 {
        self.levers_m[part].iter().zip(pulls).map(|(lever, pull)| lever * pull).sum()
    }
}

/// How far from the axis of each joint the ends of a part can be.
fn levers_m(chain: &Chain, link: usize, capsule: &Capsule) -> [f32; AXES] {
    let end_m = capsule.segment.a.norm().max(capsule.segment.b.norm());
    std::array::from_fn(|axis| {
        let rows = chain.joints().get(axis + 1..link).unwrap_or_default();
        let beyond_m: f64 = rows.iter().map(|joint| libm::hypot(joint.a_m, joint.d_m)).sum();
        // What a joint's own row adds along its axis leaves the distance from it.
        if axis < link { (chain.joints()[axis].a_m.abs() + beyond_m + end_m) as f32 } else { 0.0 }
    })
}

fn is_slender(capsule: &Capsule) -> bool {
    capsule.radius < SLENDER * (capsule.segment.b - capsule.segment.a).norm()
}

fn pair(body: &Body, parts: [usize; 2], reach_m: f64) -> Pair {
    let [a, b] = parts.map(|part| body.parts()[part].capsule());
    let half_m = |capsule: &Capsule| (capsule.segment.b - capsule.segment.a).norm() / 2.0;
    let touch_m = a.radius + b.radius;
    let is_thin = touch_m < ROUGH_LEAST * reach_m;
    Pair {
        parts,
        touch_m: if is_thin { f32::NAN } else { touch_m as f32 },
        balls_m: (touch_m + half_m(a) + half_m(b)) as f32,
    }
}

fn corners(solid: &Solid) -> [End; 2] {
    let Aabb { min, max } = solid.aabb();
    [end(&min), end(&max)]
}

/// Up to eight boxes; what is missing overlaps nothing.
fn block(boxes: &[[End; 2]]) -> [RoughRow; 6] {
    let none = [
        f32::INFINITY,
        f32::INFINITY,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NEG_INFINITY,
        f32::NEG_INFINITY,
    ];
    let mut rows = none.map(|bound| [bound; ROUGH_LANES]);
    for (lane, corners) in boxes.iter().enumerate() {
        for (row, bound) in rows.iter_mut().zip(corners.as_flattened()) {
            row[lane] = *bound;
        }
    }
    rows
}

/// How far from the origin the arm reaches, or somewhat more.
fn reach_m(chain: &Chain, body: &Body) -> f64 {
    let links = chain.joints().iter().map(|joint| libm::hypot(joint.a_m, joint.d_m));
    let ends = body.parts().iter().map(|part| part.capsule().segment);
    let end_m = ends.map(|segment| segment.a.norm().max(segment.b.norm())).fold(0.0, f64::max);
    chain.base().origin.norm() + links.sum::<f64>() + end_m
}

/// The greatest number that the distance from a solid is reckoned with.
fn far_m(solid: &Solid) -> f64 {
    if let Solid::HalfSpace(shape) = solid {
        return shape.height(&Vec3::zeros()).abs();
    }
    let Aabb { min, max } = solid.aabb();
    min.abs().sup(&max.abs()).norm()
}
