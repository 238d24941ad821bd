//! A robot of any number of joints among convex solids: where it can be, and which straight motions it can make.
//!
//! Solids are points and a radius ([`Rounded`]); a cylinder is a prism around it. Touching is contact. Links that a joint joins
//! are never held against each other, unless an SRDF file says which links may touch. A motion straight in joint space is checked
//! at both ends and wherever the joint that moves most has gone one more step. A metre of a joint that slides counts as a radian,
//! and a joint that turns without end goes the shorter way round.

mod lanes;
#[cfg(test)]
mod tests;

use crate::geometry::lanes::{ROUGH_LANES, RoughRow, dispatch, level};
use crate::geometry::{Frame, Placed, Rounded, Vec3, intersects_placed_placed};
use crate::kinematics::open_chain::OpenChain;
use base::robot::{MayTouch, Robot};
use base::solid::Solid;
use lanes::{Doubt, SecondSolid, Spheres};

/// How often a step is halved at most where a path that is returned is checked.
const HALVINGS: u32 = 6;

/// A robot among obstacles.
#[derive(Debug, Clone)]
pub struct JointSpace {
    robot: Robot,
    chain: OpenChain,
    /// Each with its link.
    parts: Vec<(usize, Rounded)>,
    obstacles: Vec<Solid>,
    stills: Vec<Rounded>,
    self_pairs: Vec<[usize; 2]>,
    step_rad: f64,
    /// The robot in lanes, if it is made of spheres.
    spheres: Option<Spheres>,
}

/// Buffers that are reused from motion to motion.
#[derive(Debug, Default, Clone)]
pub struct MotionMemory {
    changes: Vec<f64>,
    rows: Vec<RoughRow>,
    lanes: lanes::Memory,
}

/// Which parts of a robot must not touch each other.
#[derive(Debug, Clone)]
pub enum SelfContact {
    /// None: the robot may touch itself.
    Unchecked,
    /// Those of links that no joint joins.
    Apart,
    /// Those of links that are not one and may not touch.
    Except(MayTouch),
}

impl SelfContact {
    fn is_checked(&self, robot: &Robot, [a, b]: [usize; 2]) -> bool {
        let apart = robot.solids[a].0.abs_diff(robot.solids[b].0);
        match self {
            Self::Unchecked => false,
            Self::Apart => apart > 1,
            Self::Except(may_touch) => apart > 0 && !may_touch.allows(&robot.owners[a], &robot.owners[b]),
        }
    }
}

/// Writes the joints at the share of a motion that each lane has.
fn fill(rows: &mut Vec<RoughRow>, from: &[f64], changes: &[f64], share: impl Fn(usize) -> f64) {
    rows.resize(from.len(), [0.0; ROUGH_LANES]);
    for (row, (a, by)) in rows.iter_mut().zip(from.iter().zip(changes)) {
        *row = std::array::from_fn(|lane| (a + by * share(lane)) as f32);
    }
}

fn is_touched(part: &Placed<'_>, still: &Rounded) -> bool {
    intersects_placed_placed(part, &Placed { solid: still, frame: &Frame::IDENTITY })
}

/// A solid with a margin of so many metres around it.
fn rounded(solid: &Solid, margin_m: f64) -> Rounded {
    let (points, radius_m) = solid.rounded();
    Rounded::new(points.into_iter().map(Vec3::from).collect(), radius_m + margin_m)
}

impl JointSpace {
    /// The robot among these obstacles, its motions checked every `step_rad`; it must not touch itself as `contact` says.
    pub fn new(robot: Robot, obstacles: Vec<Solid>, contact: &SelfContact, step_rad: f64) -> Self {
        Self::with_clearance(robot, obstacles, contact, step_rad, 0.0)
    }

    /// The same, where the robot must also be farther than `clearance_m` metres from every obstacle.
    pub fn with_clearance(
        robot: Robot,
        obstacles: Vec<Solid>,
        contact: &SelfContact,
        step_rad: f64,
        clearance_m: f64,
    ) -> Self {
        let count = robot.solids.len();
        let pairs = (0..count).flat_map(|b| (0..b).map(move |a| [a, b]));
        let self_pairs: Vec<_> = pairs.filter(|pair| contact.is_checked(&robot, *pair)).collect();
        let chain = OpenChain::new(&robot);
        Self {
            spheres: Spheres::new(&robot, &chain, (&obstacles, clearance_m), &self_pairs),
            chain,
            parts: robot.solids.iter().map(|(link, solid)| (*link, rounded(solid, 0.0))).collect(),
            stills: obstacles.iter().map(|solid| rounded(solid, clearance_m)).collect(),
            robot,
            obstacles,
            self_pairs,
            step_rad,
        }
    }

    /// The robot as its file gives it.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Its chain.
    pub fn chain(&self) -> &OpenChain {
        &self.chain
    }

    /// What stands around it.
    pub fn obstacles(&self) -> &[Solid] {
        &self.obstacles
    }

    /// Pairs of the robot's solids that must not touch, by index.
    pub fn self_pairs(&self) -> &[[usize; 2]] {
        &self.self_pairs
    }

    /// How far a joint may move between two configurations that are checked.
    pub fn step_rad(&self) -> f64 {
        self.step_rad
    }

    /// Why the robot cannot be at `q`; `None` if it can.
    pub fn refusal(&self, q: &[f64]) -> Option<String> {
        if let Some(joint) = self.chain.outside(q) {
            return self.robot.joints[joint].refusal(q[joint]);
        }
        let frames = self.chain.frames(q);
        let name = |part: usize| &self.robot.solids[part].1.name;
        if let Some((part, still)) = self.touched(&frames) {
            return Some(format!(
                "part `{}` is in contact with `{}`",
                name(part),
                self.obstacles[still].name
            ));
        }
        let pair = self.self_touching(&frames)?;
        Some(format!("parts `{}` and `{}` are in contact", name(pair[0]), name(pair[1])))
    }

    /// Whether the robot can be at `q`.
    pub fn is_free(&self, q: &[f64]) -> bool {
        if self.chain.outside(q).is_some() {
            return false;
        }
        self.is_clear(q)
    }

    /// Whether nothing touches at `q`, whatever the joints' limits.
    pub fn is_clear(&self, q: &[f64]) -> bool {
        let frames = self.chain.frames(q);
        self.touched(&frames).is_none() && self.self_touching(&frames).is_none()
    }

    /// Whether it can go straight from one configuration to another; counts every configuration that is checked.
    pub fn joins(&self, from: &[f64], to: &[f64], checked: &mut u64) -> bool {
        let changes: Vec<f64> = self.chain.change(from, to).collect();
        let change = changes.iter().map(|change| change.abs()).fold(0.0, f64::max);
        let steps = (change / self.step_rad).ceil().max(1.0) as u32;
        (0..=steps).all(|step| {
            *checked += 1;
            let share = f64::from(step) / f64::from(steps);
            let q: Vec<f64> = from.iter().zip(&changes).map(|(a, change)| a + change * share).collect();
            self.is_free(&q)
        })
    }

    /// Whether it can go straight from one configuration, where it can be, to another; counts every configuration that is checked.
    ///
    /// As often as in [`joins`](Self::joins), times `finer`, or oftener, eight at once that are spread over the whole motion, as in VAMP: a motion that
    /// meets something is refused early. What does not fit eight at once is checked one at a time, with the same verdict.
    ///
    /// # Source
    /// Thomason, Kingston & Kavraki, *Motions in Microseconds via Vectorized Sampling-Based Planning*, ICRA 2024, section IV ("rakes").
    pub fn goes(
        &self,
        [from, to]: [&[f64]; 2],
        finer: f64,
        memory: &mut MotionMemory,
        checked: &mut u64,
    ) -> bool {
        if self.chain.outside(to).is_some() {
            return false;
        }
        let MotionMemory { changes, rows, lanes, .. } = memory;
        changes.clear();
        changes.extend(self.chain.change(from, to));
        let changes: &[f64] = changes;
        let blocks = self.blocks(changes, finer);
        let at =
            |share: f64| -> Vec<f64> { from.iter().zip(changes).map(|(a, by)| a + by * share).collect() };
        let in_lanes = self.in_lanes(from, changes);
        (0..blocks).all(|block| {
            *checked += ROUGH_LANES as u64;
            let back = f64::from(block) / f64::from(blocks);
            let share = |lane: usize| (lane as f64 + 1.0 - back) / ROUGH_LANES as f64;
            let Some(spheres) = in_lanes else {
                return (0..ROUGH_LANES).all(|lane| self.is_clear(&at(share(lane))));
            };
            fill(rows, from, changes, share);
            !dispatch!(level(), simd => spheres.touches(simd, rows, false, lanes))
                && (lanes.doubts.is_empty()
                    || (0..ROUGH_LANES).all(|lane| self.settles(lane, &lanes.doubts, || at(share(lane)))))
        })
    }

    /// How many times eight configurations of a motion are checked at least.
    fn blocks(&self, changes: &[f64], finer: f64) -> u32 {
        let change = changes.iter().map(|change| change.abs()).fold(0.0, f64::max);
        (finer * change / self.step_rad / ROUGH_LANES as f64).ceil().max(1.0) as u32
    }

    /// The robot in lanes, if they take a motion.
    fn in_lanes(&self, from: &[f64], changes: &[f64]) -> Option<&Spheres> {
        let ends = || from.iter().zip(changes).flat_map(|(a, by)| [*a, a + by]);
        self.spheres.as_ref().filter(|_| Spheres::takes(ends()))
    }

    /// Whether nothing touches that is in doubt in one of eight configurations, which `at` gives.
    fn settles(&self, lane: usize, doubts: &[Doubt], at: impl Fn() -> Vec<f64>) -> bool {
        let mut own = doubts.iter().filter(|doubt| doubt.is_at[lane]).peekable();
        own.peek().is_none() || {
            let frames = self.chain.frames(&at());
            own.all(|doubt| {
                let solid = self.placed(doubt.solid, &frames);
                !match doubt.other {
                    SecondSolid::Still(still) => is_touched(&solid, &self.stills[still]),
                    SecondSolid::Own(other) => intersects_placed_placed(&solid, &self.placed(other, &frames)),
                }
            })
        }
    }

    /// Whether a motion of a path that is returned is free. It is checked 64 times in each step. Of a robot of spheres, each configuration after
    /// a step must leave room for what lies between it and the next; around those that do not, steps are halved, up to six times. Counts
    /// as [`goes`](Self::goes) does.
    pub fn holds(&self, ends: [&[f64]; 2], memory: &mut MotionMemory, checked: &mut u64) -> bool {
        let [from, to] = ends;
        let changes: Vec<f64> = self.chain.change(from, to).collect();
        let Some(spheres) = self.in_lanes(from, &changes).filter(|_| self.chain.outside(to).is_none()) else {
            return self.goes(ends, f64::from(1 << HALVINGS), memory, checked);
        };
        let MotionMemory { rows, lanes, .. } = memory;
        let blocks = self.blocks(&changes, 1.0);
        let mut steps = blocks * ROUGH_LANES as u32 - 1;
        let lanes_of = |block| (0..ROUGH_LANES as u32).map(move |lane| lane * blocks + block);
        let mut places: Vec<u32> = (0..blocks).flat_map(lanes_of).collect();
        for _ in 0..=HALVINGS {
            spheres.make_room(&changes, f64::from(steps), lanes);
            let mut narrow = Vec::new();
            for eight in places.chunks(ROUGH_LANES) {
                *checked += ROUGH_LANES as u64;
                let place = |lane: usize| eight[lane.min(eight.len() - 1)];
                let share = |lane: usize| f64::from(place(lane)) / f64::from(steps);
                fill(rows, from, &changes, share);
                dispatch!(level(), simd => spheres.touches(simd, rows, true, lanes));
                if lanes.doubts.is_empty() {
                    continue;
                }
                let lacks_room = |lane: &usize| lanes.doubts.iter().any(|doubt| doubt.is_at[*lane]);
                narrow.extend((0..ROUGH_LANES).filter(lacks_room).map(place));
                let touches = dispatch!(level(), simd => spheres.touches(simd, rows, false, lanes));
                let at = |lane| from.iter().zip(&changes).map(|(a, by)| a + by * share(lane)).collect();
                if touches || !(0..ROUGH_LANES).all(|lane| self.settles(lane, &lanes.doubts, || at(lane))) {
                    return false;
                }
            }
            places =
                narrow.into_iter().flat_map(|k| 2 * k.saturating_sub(1)..=2 * (k + 1).min(steps)).collect();
            places.sort_unstable();
            places.dedup();
            steps *= 2;
        }
        true
    }

    fn placed<'a>(&'a self, part: usize, frames: &'a [Frame]) -> Placed<'a> {
        let (link, solid) = &self.parts[part];
        Placed { solid, frame: &frames[*link] }
    }

    /// The first part and obstacle in contact. What is welded to the base stands as it does, and is not checked.
    fn touched(&self, frames: &[Frame]) -> Option<(usize, usize)> {
        let moving = (0..self.parts.len()).filter(|part| self.parts[*part].0 > 0);
        moving.into_iter().find_map(|part| {
            let placed = self.placed(part, frames);
            let hit = |still: &Rounded| is_touched(&placed, still);
            self.stills.iter().position(hit).map(|still| (part, still))
        })
    }

    fn self_touching(&self, frames: &[Frame]) -> Option<[usize; 2]> {
        let touch = |[a, b]: &&[usize; 2]| {
            intersects_placed_placed(&self.placed(*a, frames), &self.placed(*b, frames))
        };
        self.self_pairs.iter().find(touch).copied()
    }
}
