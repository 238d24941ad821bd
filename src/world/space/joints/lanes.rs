//! Robots made of spheres, eight configurations at once.
//!
//! Places and distances run in f32. Two kinds of comparison leave configurations in doubt: those inside an obstacle's
//! error band, and those with a solid that lanes only bound (a cylinder's prism, a hull). The scalar code decides these
//! solids there, so a verdict from here is the scalar code's. Spheres of one link are first compared by a ball around
//! them all, and obstacles by balls around them; obstacles out of a link's reach are left out. Links go from the last
//! to the first, since the far ones meet most.
//!
//! A closure over lanes, or `map` over them, would be compiled for every machine's instructions and call each operation
//! of theirs, so none is used here.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use crate::geometry::Vec3;
use crate::geometry::lanes::{
    ExtractToken, Frames, Point, ROUGH_LANES, ROUGHNESS, Rough, RoughRow, Select, Simd, SimdBase, SimdFloat,
    SimdMask, sincos_rough,
};
use crate::kinematics::open_chain::{OpenChain, OpenJoint, frame};
use base::robot::{Kind, Robot};
use base::solid::{Form, Solid, prism_radius_m};
use nalgebra::Matrix3;

/// The largest absolute joint value that is taken to f32, radians or metres.
const MOST: f64 = 7.0;
/// What rounding may take from a bound.
const ROUNDED: f64 = 1.001;
/// How far f32 may put a sphere of a robot off, metres.
const PLACED_M: f64 = 2e-5;

/// Two solids that may touch in some of eight configurations, by their numbers: what the scalar code decides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Doubt {
    /// The robot's solid.
    pub(super) solid: usize,
    /// Another of the robot's, or an obstacle.
    pub(super) other: SecondSolid,
    /// In which configurations.
    pub(super) is_at: [bool; ROUGH_LANES],
}

/// What a solid of a robot may touch, by its number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum SecondSolid {
    /// An obstacle.
    Still(usize),
    /// Another solid of the robot.
    Own(usize),
}

/// A joint: the fixed turn and place before it, after which it turns about or slides along z.
#[derive(Debug, Clone)]
struct LaneJoint {
    axes: [[f32; 3]; 3],
    origin: [f32; 3],
    slides: bool,
}

/// The spheres of one link of the file.
#[derive(Debug, Clone)]
struct Link {
    /// The joint that moves it, from 1; 0 is the base.
    moved_by: usize,
    /// How far its spheres can be from the pivots of the joints that move it, base first, metres; 1 for a joint that slides.
    arms: Vec<f64>,
    /// The radius of its smallest sphere, metres.
    least_m: f64,
    ball: Ball,
    spheres: Vec<Ball>,
    /// The number of its first sphere among all.
    first: usize,
    /// The obstacles that it can come near to.
    near: Vec<usize>,
}

#[derive(Debug, Clone, Copy)]
struct Ball {
    centre: [f32; 3],
    radius: f32,
}

/// An obstacle, and how far distances from it may be off.
#[derive(Debug, Clone)]
struct Still {
    axes: [[f32; 3]; 3],
    origin: [f32; 3],
    form: StillForm,
    /// How far its farthest point and the clearance about it are from its origin.
    reach: f32,
    /// How near nothing may come to it.
    clearance: f32,
    band: f32,
}

#[derive(Debug, Clone)]
enum StillForm {
    Box([f32; 3]),
    /// The radius of the cylinder, that of the prism's corners, and half the length.
    Cylinder([f32; 2], f32),
    Sphere(f32),
    /// All that is known is a ball around it.
    Within(f32),
}

/// Two links, by their numbers, some of whose spheres must not touch.
#[derive(Debug, Clone)]
struct LinkPair {
    links: [usize; 2],
    spheres: Vec<SpherePair>,
}

/// Two spheres, by their numbers among all, and the sum of their radii.
#[derive(Debug, Clone)]
struct SpherePair {
    spheres: [usize; 2],
    reach: f32,
}

/// A robot of spheres among obstacles.
#[derive(Debug, Clone)]
pub(super) struct Spheres {
    joints: Vec<LaneJoint>,
    links: Vec<Link>,
    /// The robot's solid that each sphere is.
    solids: Vec<usize>,
    stills: Vec<Still>,
    pairs: Vec<LinkPair>,
}

/// Buffers that are reused from block to block.
#[derive(Debug, Default, Clone)]
pub(super) struct Memory {
    frames: Vec<[RoughRow; 12]>,
    balls: Vec<[RoughRow; 3]>,
    spheres: Vec<[RoughRow; 3]>,
    is_placed: Vec<bool>,
    /// How much room the spheres of each link need for what lies between two configurations, metres.
    rooms: Vec<f32>,
    /// What the last block left to the scalar code.
    pub(super) doubts: Vec<Doubt>,
}

fn rough(v: &Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

fn columns(turn: &Matrix3<f64>) -> [[f32; 3]; 3] {
    std::array::from_fn(|i| rough(&turn.column(i).into_owned()))
}

/// A turn that takes z to `axis`, a unit vector.
fn from_z(axis: &Vec3) -> Matrix3<f64> {
    let aside = if axis.x.abs() < 0.5 { Vec3::x() } else { Vec3::y() };
    let y = axis.cross(&aside).normalize();
    Matrix3::from_columns(&[y.cross(axis), y, *axis])
}

/// How far the frame of joint `index`, from 1, can be from the place of joint `from`, metres.
fn reach(chain: &OpenChain, from: usize, index: usize) -> f64 {
    let slid = |joint: &OpenJoint| match joint.joint.kind {
        Kind::Slides => joint.joint.limits.iter().fold(0.0_f64, |most, end| most.max(end.abs())),
        Kind::Turns | Kind::TurnsOn => 0.0,
    };
    let joints = chain.joints()[..index].iter().enumerate().skip(from - 1);
    let way = |(i, joint): (usize, &OpenJoint)| {
        slid(joint) + if i < from { 0.0 } else { joint.before.origin.norm() }
    };
    joints.map(way).sum()
}

/// A ball around spheres.
fn around(spheres: &[(Vec3, f64)]) -> Ball {
    let middle = spheres.iter().map(|(at, _)| at).sum::<Vec3>() / spheres.len() as f64;
    let radius = spheres.iter().map(|(at, radius)| (at - middle).norm() + radius).fold(0.0, f64::max);
    Ball { centre: rough(&middle), radius: radius as f32 }
}

impl Spheres {
    /// `None` if a part of the robot is no sphere; it must keep a clearance from obstacles, metres.
    pub(super) fn new(
        robot: &Robot,
        chain: &OpenChain,
        (obstacles, clearance_m): (&[Solid], f64),
        pairs: &[[usize; 2]],
    ) -> Option<Self> {
        let turns: Vec<Matrix3<f64>> = chain.joints().iter().map(|joint| from_z(&joint.axis)).collect();
        let joint = |(index, joint): (usize, &OpenJoint)| {
            let back = index.checked_sub(1).map_or(Matrix3::identity(), |last| turns[last].transpose());
            LaneJoint {
                axes: columns(&(back * joint.before.rotation * turns[index])),
                origin: rough(&(back * joint.before.origin)),
                slides: joint.joint.kind == Kind::Slides,
            }
        };
        let joints = chain.joints().iter().enumerate().map(joint).collect();
        let mut links: Vec<(usize, &str, Vec<(Vec3, f64)>)> = Vec::new();
        let mut places = Vec::new();
        for ((moved_by, solid), owner) in robot.solids.iter().zip(&robot.owners) {
            let Form::Sphere(radius) = solid.form else { return None };
            let back = moved_by.checked_sub(1).map_or(Matrix3::identity(), |last| turns[last].transpose());
            let sphere = (back * Vec3::from(solid.pose.origin_m), radius);
            let known = links.iter().position(|(by, name, _)| by == moved_by && name == owner);
            let link = known.unwrap_or_else(|| {
                links.push((*moved_by, owner, Vec::new()));
                links.len() - 1
            });
            places.push((link, links[link].2.len()));
            links[link].2.push(sphere);
        }
        let stills: Vec<Still> = obstacles.iter().map(|solid| Still::new(solid, clearance_m)).collect();
        let mut first = 0;
        let links: Vec<Link> = links
            .into_iter()
            .map(|(moved_by, _, spheres)| {
                let own = spheres
                    .iter()
                    .map(|(at, radius)| Ball { centre: rough(at), radius: *radius as f32 })
                    .collect();
                first += spheres.len();
                let within = |(at, radius): &(Vec3, f64)| at.norm() + radius;
                let own_reach = spheres.iter().map(within).fold(0.0, f64::max);
                let arm = |from: usize| match chain.joints()[from - 1].joint.kind {
                    Kind::Slides => 1.0,
                    Kind::Turns | Kind::TurnsOn => own_reach + reach(chain, from, moved_by),
                };
                let far = own_reach + if moved_by > 0 { reach(chain, 1, moved_by) } else { 0.0 };
                let pivot = chain.joints().first().map_or(Vec3::zeros(), |joint| joint.before.origin);
                let is_near = |still: &usize| {
                    let solid = &obstacles[*still];
                    let still = &stills[*still];
                    let apart = (Vec3::from(solid.pose.origin_m) - pivot).norm();
                    apart < far + f64::from(still.reach) + 2.0 * f64::from(still.band)
                };
                Link {
                    moved_by,
                    arms: (1..=moved_by).map(arm).collect(),
                    least_m: spheres.iter().map(|(_, radius)| *radius).fold(f64::INFINITY, f64::min),
                    ball: around(&spheres),
                    spheres: own,
                    first: first - spheres.len(),
                    near: (0..stills.len()).filter(is_near).collect(),
                }
            })
            .collect();
        let mut solids = vec![0; first];
        for (solid, (link, place)) in places.iter().enumerate() {
            solids[links[*link].first + place] = solid;
        }
        let mut link_pairs: Vec<LinkPair> = Vec::new();
        for pair in pairs {
            let [(a, i), (b, j)] = pair.map(|solid| places[solid]);
            let radius = |link: usize, place: usize| links[link].spheres[place].radius;
            let spheres = SpherePair {
                spheres: [links[a].first + i, links[b].first + j],
                reach: radius(a, i) + radius(b, j),
            };
            match link_pairs.iter_mut().find(|known| known.links == [a, b]) {
                Some(known) => known.spheres.push(spheres),
                None => link_pairs.push(LinkPair { links: [a, b], spheres: vec![spheres] }),
            }
        }
        Some(Self { joints, links, solids, stills, pairs: link_pairs })
    }

    /// Whether f32 has digits enough for these values.
    pub(super) fn takes(mut values: impl Iterator<Item = f64>) -> bool {
        values.all(|value| value.abs() <= MOST)
    }

    /// Notes how much larger spheres must be for nothing to touch between two configurations if no larger sphere touches at either. From one to
    /// the other joints make one of so many `steps` of `changes`.
    ///
    /// The centre of a sphere of radius r goes at most s from one to the other, and strays from the chord by a/8, where a bounds its
    /// second derivative. A point that is r + m from both ends of a chord s is r from all of it if m is at least s²/8r. For two spheres of the
    /// robot the sum of both rooms is enough, since (s + t)²/(q + r) is at most s²/q + t²/r.
    pub(super) fn make_room(&self, changes: &[f64], steps: f64, memory: &mut Memory) {
        memory.rooms.clear();
        memory.rooms.extend(self.links.iter().map(|link| {
            let (mut way, mut bend, mut turned) = (0.0, 0.0, 0.0);
            for (step, arm) in changes.iter().map(|change| change.abs() / steps).zip(&link.arms) {
                way += step * arm;
                bend += step * arm * (2.0 * turned + step);
                turned += step;
            }
            (ROUNDED * (way * way / link.least_m + bend) / 8.0) as f32
        }));
    }

    /// Whether one of eight configurations at least, whose joints are in `values`, is in contact. If none is, those that may be are
    /// left in the memory's doubts. `with_room`, no contact is sure: those that lack the noted room are in doubt.
    #[inline(always)]
    pub(super) fn touches<S: Simd>(
        &self,
        simd: S,
        values: &[RoughRow],
        with_room: bool,
        memory: &mut Memory,
    ) -> bool {
        self.place(simd, values, memory);
        memory.doubts.clear();
        for (index, link) in self.links.iter().enumerate().rev().filter(|(_, link)| link.moved_by > 0) {
            let centre = point(simd, &memory.balls[index]);
            for number in &link.near {
                let still = &self.stills[*number];
                let room = if with_room { memory.rooms[index] } else { 0.0 };
                let ball = link.ball.radius + room + still.clearance;
                let apart = centre - Point::splat_rough(simd, still.origin);
                let far = square(link.ball.radius + room + still.reach + still.band);
                if !apart.dot(apart).simd_lt(far).any_true()
                    || !still.squares(simd, &apart).0.simd_lt(square(ball + still.band)).any_true()
                {
                    continue;
                }
                self.place_spheres(simd, index, memory);
                let Memory { spheres, doubts, .. } = &mut *memory;
                for (place, (sphere, at)) in link.spheres.iter().zip(&spheres[link.first..]).enumerate() {
                    let apart = point(simd, at) - Point::splat_rough(simd, still.origin);
                    let (least, most) = still.squares(simd, &apart);
                    let radius = sphere.radius + room + still.clearance;
                    let near = least.simd_lt(square(radius + still.band));
                    if near.any_true() {
                        if !with_room && most.simd_lt(square((radius - still.band).max(0.0))).any_true() {
                            return true;
                        }
                        let marks = near.select(Rough::splat(simd, 1.0), Rough::splat(simd, 0.0)).to_array();
                        doubts.push(Doubt {
                            solid: self.solids[link.first + place],
                            other: SecondSolid::Still(*number),
                            is_at: is_marked(marks),
                        });
                    }
                }
            }
        }
        for pair in &self.pairs {
            let [a, b] = pair.links;
            let apart = point(simd, &memory.balls[a]) - point(simd, &memory.balls[b]);
            let room = if with_room { memory.rooms[a] + memory.rooms[b] } else { 0.0 };
            let balls = self.links[a].ball.radius + self.links[b].ball.radius + room + BAND;
            if !apart.dot(apart).simd_lt(square(balls)).any_true() {
                continue;
            }
            self.place_spheres(simd, a, memory);
            self.place_spheres(simd, b, memory);
            let Memory { spheres, doubts, .. } = &mut *memory;
            for SpherePair { spheres: [i, j], reach } in &pair.spheres {
                let apart = point(simd, &spheres[*i]) - point(simd, &spheres[*j]);
                let (gap, reach) = (apart.dot(apart), reach + room);
                let near = gap.simd_lt(square(reach + BAND));
                if near.any_true() {
                    if !with_room && gap.simd_lt(square(reach - BAND)).any_true() {
                        return true;
                    }
                    let marks = near.select(Rough::splat(simd, 1.0), Rough::splat(simd, 0.0)).to_array();
                    doubts.push(Doubt {
                        solid: self.solids[*i],
                        other: SecondSolid::Own(self.solids[*j]),
                        is_at: is_marked(marks),
                    });
                }
            }
        }
        false
    }

    /// Writes the frames of all links and the balls around their spheres.
    #[inline(always)]
    fn place<S: Simd>(&self, simd: S, values: &[RoughRow], memory: &mut Memory) {
        let spheres = self.links.last().map_or(0, |link| link.first + link.spheres.len());
        memory.frames.resize(self.joints.len() + 1, [[0.0; ROUGH_LANES]; 12]);
        memory.balls.resize(self.links.len(), [[0.0; ROUGH_LANES]; 3]);
        memory.spheres.resize(spheres, [[0.0; ROUGH_LANES]; 3]);
        memory.is_placed.clear();
        memory.is_placed.resize(self.links.len(), false);
        let mut at = Frames {
            axes: [
                Point::splat_rough(simd, [1.0, 0.0, 0.0]),
                Point::splat_rough(simd, [0.0, 1.0, 0.0]),
                Point::splat_rough(simd, [0.0, 0.0, 1.0]),
            ],
            origin: Point::splat_rough(simd, [0.0; 3]),
        };
        store_frame(&at, &mut memory.frames[0]);
        for (index, (joint, row)) in self.joints.iter().zip(values).enumerate() {
            let x = direction(simd, &at.axes, joint.axes[0]);
            let y = direction(simd, &at.axes, joint.axes[1]);
            let z = direction(simd, &at.axes, joint.axes[2]);
            let origin = at.origin + direction(simd, &at.axes, joint.origin);
            let value = Rough::load_array_ref(simd, row);
            at = if joint.slides {
                Frames { axes: [x, y, z], origin: origin.plus(value, z) }
            } else {
                let (s, c) = sincos_rough(value);
                Frames { axes: [x.scaled(c).plus(s, y), y.scaled(c) - x.scaled(s), z], origin }
            };
            store_frame(&at, &mut memory.frames[index + 1]);
        }
        for (link, ball) in self.links.iter().zip(&mut memory.balls) {
            let at = load_frame(simd, &memory.frames[link.moved_by]);
            store(at.origin + direction(simd, &at.axes, link.ball.centre), ball);
        }
    }

    /// Writes where the spheres of a link are, unless they are written.
    #[inline(always)]
    fn place_spheres<S: Simd>(&self, simd: S, index: usize, memory: &mut Memory) {
        if std::mem::replace(&mut memory.is_placed[index], true) {
            return;
        }
        let link = &self.links[index];
        let at = load_frame(simd, &memory.frames[link.moved_by]);
        for (sphere, place) in link.spheres.iter().zip(&mut memory.spheres[link.first..]) {
            store(at.origin + direction(simd, &at.axes, sphere.centre), place);
        }
    }
}

/// The band of distances between two spheres of a robot.
const BAND: f32 = PLACED_M as f32;

impl Still {
    fn new(solid: &Solid, clearance_m: f64) -> Self {
        let at = frame(&solid.pose);
        let (form, reach) = match &solid.form {
            Form::Box(half) => (StillForm::Box(half.map(|x| x as f32)), Vec3::from(*half).norm()),
            Form::Cylinder(radius, length) => {
                let corner = prism_radius_m(*radius);
                let radii = [*radius, corner].map(|x| x as f32);
                (StillForm::Cylinder(radii, 0.5 * *length as f32), libm::hypot(corner, 0.5 * length))
            }
            Form::Sphere(radius) => (StillForm::Sphere(*radius as f32), *radius),
            Form::Hull(points) => {
                let reach = points.iter().map(|point| Vec3::from(*point).norm()).fold(0.0, f64::max);
                (StillForm::Within(reach as f32), reach)
            }
        };
        let band = PLACED_M + ROUGHNESS * (at.origin.norm() + reach);
        Self {
            axes: columns(&at.rotation),
            origin: rough(&at.origin),
            form,
            reach: (reach + clearance_m) as f32,
            clearance: clearance_m as f32,
            band: band as f32,
        }
    }

    /// At least and at most the squares of the distances from eight points, which are so far from the origin.
    #[inline(always)]
    fn squares<S: Simd>(&self, simd: S, apart: &Point<Rough<S>>) -> (Rough<S>, Rough<S>) {
        let apart = *apart;
        match self.form {
            StillForm::Box([a, b, c]) => {
                let x = beyond(self.along(simd, apart, 0).abs(), a);
                let y = beyond(self.along(simd, apart, 1).abs(), b);
                let z = beyond(self.along(simd, apart, 2).abs(), c);
                let square = x.mul_add(x, y.mul_add(y, z * z));
                (square, square)
            }
            StillForm::Cylinder([inner, outer], half) => {
                let (x, y) = (self.along(simd, apart, 0), self.along(simd, apart, 1));
                let out = x.mul_add(x, y * y).sqrt();
                let up = beyond(self.along(simd, apart, 2).abs(), half);
                let (most, least) = (beyond(out, inner), beyond(out, outer));
                (least.mul_add(least, up * up), most.mul_add(most, up * up))
            }
            StillForm::Sphere(radius) => {
                let gap = beyond(apart.dot(apart).sqrt(), radius);
                (gap * gap, gap * gap)
            }
            StillForm::Within(radius) => {
                let gap = beyond(apart.dot(apart).sqrt(), radius);
                (gap * gap, Rough::splat(simd, f32::INFINITY))
            }
        }
    }

    #[inline(always)]
    fn along<S: Simd>(&self, simd: S, apart: Point<Rough<S>>, axis: usize) -> Rough<S> {
        apart.dot(Point::splat_rough(simd, self.axes[axis]))
    }
}

fn is_marked(marks: RoughRow) -> [bool; ROUGH_LANES] {
    marks.map(|mark| mark > 0.5)
}

/// By how much lengths are greater than `half`, or 0.
#[inline(always)]
fn beyond<S: Simd>(length: Rough<S>, half: f32) -> Rough<S> {
    (length - half).max(Rough::splat(length.token(), 0.0))
}

fn square(length: f32) -> f32 {
    length * length
}

#[inline(always)]
fn direction<S: Simd>(simd: S, [x, y, z]: &[Point<Rough<S>>; 3], [a, b, c]: [f32; 3]) -> Point<Rough<S>> {
    x.scaled(Rough::splat(simd, a)).plus(Rough::splat(simd, b), *y).plus(Rough::splat(simd, c), *z)
}

#[inline(always)]
fn point<S: Simd>(simd: S, [x, y, z]: &[RoughRow; 3]) -> Point<Rough<S>> {
    Point::load(simd, [x, y, z])
}

#[inline(always)]
fn store<S: Simd>(at: Point<Rough<S>>, [x, y, z]: &mut [RoughRow; 3]) {
    at.x.store_array(x);
    at.y.store_array(y);
    at.z.store_array(z);
}

#[inline(always)]
fn store_frame<S: Simd>(at: &Frames<Rough<S>>, rows: &mut [RoughRow; 12]) {
    let (rows, _) = rows.as_chunks_mut::<3>();
    store(at.axes[0], &mut rows[0]);
    store(at.axes[1], &mut rows[1]);
    store(at.axes[2], &mut rows[2]);
    store(at.origin, &mut rows[3]);
}

#[inline(always)]
fn load_frame<S: Simd>(simd: S, rows: &[RoughRow; 12]) -> Frames<Rough<S>> {
    let (rows, _) = rows.as_chunks::<3>();
    Frames {
        axes: [point(simd, &rows[0]), point(simd, &rows[1]), point(simd, &rows[2])],
        origin: point(simd, &rows[3]),
    }
}
