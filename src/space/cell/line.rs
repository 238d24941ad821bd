//! Local paths: what joins two configurations without a search.
//!
//! The tool goes on a straight line, its orientation about one axis (slerp), both at even steps; the joints follow by
//! inverse kinematics. At each step the configuration on the branch in hand is taken, of copies by whole turns the nearest
//! one. A path is refused for a change of branch, a pose out of reach or limits, a jump of a joint, a joint too
//! fast under the tool's time law, an end in another configuration than the one asked for, or a contact.
//!
//! **What can slip through.** Every checked configuration is checked with each part thickened by 0.51 of the longest
//! way that an end of its axis goes to the next checked ones. A contact between two that are clear is
//! then possible only where an axis end travels 2 % further than its chord. Where a thickened part is near an obstacle the
//! step is halved, three times at most; what then slips is thinner than the way of a part in an eighth of a
//! step (2.5 mm of the tool at 20 mm).
//!
//! # Source
//! Fu et al., *Robotics and Autonomous Systems* 106 (2018), section 3.1.

use super::{Cell, Standing};
use crate::geometry::{Capsule, Frame, Vec3};
use crate::kinematics::ik::Branch;
use crate::kinematics::{AXES, Joints, Missed};
use nalgebra::Matrix3;
use std::f64::consts::TAU;

/// How far a configuration at the end of an edge may be from the one asked for: radians.
const SAME_RAD: f64 = 1e-6;
/// Half a chord with room for the arc above it.
const HALF_WAY: f64 = 0.51;
/// How often a doubtful step is halved.
const HALVINGS: u32 = 3;

/// Why there is no local path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rejection {
    /// The ends are on different branches of the inverse kinematics.
    Branch,
    /// The orientation turns by more than is allowed on one edge.
    Turn,
    /// The wrist is out of reach on the way.
    Unreachable,
    /// A joint would leave its limits.
    Limits,
    /// A joint jumps within one step.
    Jump,
    /// A joint is faster than it can be under the tool's time law.
    Speed,
    /// The joints arrive in another configuration.
    End,
    /// The robot touches something.
    Contact,
}

impl Rejection {
    /// Every reason, in the order in which they are counted.
    pub const ALL: [Self; 8] = [
        Self::Branch,
        Self::Turn,
        Self::Unreachable,
        Self::Limits,
        Self::Jump,
        Self::Speed,
        Self::End,
        Self::Contact,
    ];
}

/// What the end of an edge must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeEnd {
    /// The configuration itself.
    Own,
    /// The configuration, joints 4 and 6 up to whole turns.
    WholeTurns,
    /// Any configuration with the tool in the same pose.
    PoseOnly,
}

/// What is straight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Path {
    /// The tool's way.
    Tool,
    /// The way in the space of joint angles.
    Joints,
}

/// A tool's time law: rest to rest with one acceleration and one greatest speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedRule {
    /// The greatest speed of the tool.
    pub speed_m_s: f64,
    /// Its acceleration.
    pub acceleration_m_s2: f64,
}

impl SpeedRule {
    /// When the tool is `way_m` from its start on a path `length_m` long.
    fn time_s(&self, way_m: f64, length_m: f64) -> f64 {
        let ramp_m = (self.speed_m_s * self.speed_m_s / (2.0 * self.acceleration_m_s2)).min(length_m / 2.0);
        let peak_m_s = (2.0 * self.acceleration_m_s2 * ramp_m).sqrt();
        let ramp_s = peak_m_s / self.acceleration_m_s2;
        let cruise_s = (length_m - 2.0 * ramp_m) / peak_m_s;
        if way_m <= ramp_m {
            (2.0 * way_m / self.acceleration_m_s2).sqrt()
        } else if way_m <= length_m - ramp_m {
            ramp_s + (way_m - ramp_m) / peak_m_s
        } else {
            let left_m = (length_m - way_m).max(0.0);
            2.0 * ramp_s + cruise_s - (2.0 * left_m / self.acceleration_m_s2).sqrt()
        }
    }
}

/// What a local path must keep to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineRules {
    /// What is straight.
    pub path: Path,
    /// The longest step of the tool's place.
    pub step_m: f64,
    /// The longest step of its orientation; of any joint on a path that is straight in joint space.
    pub step_rad: f64,
    /// The most that a joint may change in one step.
    pub jump_rad: f64,
    /// The most that the orientation may change on one edge.
    pub turn_rad: f64,
    /// The time law under which joint speeds are checked, if they are.
    pub speed: Option<SpeedRule>,
    /// What the end must be.
    pub end: EdgeEnd,
}

/// A configuration with what local paths ask of it.
#[derive(Debug, Clone, Copy)]
pub struct Pose {
    /// The joint angles.
    pub q: Joints,
    /// The tool in the world.
    pub tool: Frame,
    /// The branch it is on.
    pub branch: Branch,
}

/// Memory that one attempt after another uses.
#[derive(Debug, Default)]
pub struct Scratch {
    states: Vec<Joints>,
    placed: Vec<Capsule>,
    ways: Vec<f64>,
    checked: u64,
}

impl Scratch {
    /// How many configurations were checked for contact.
    pub fn checked(&self) -> u64 {
        self.checked
    }
}

/// The local path planner of a cell.
#[derive(Debug, Clone)]
pub struct Lines {
    cell: Cell,
    rules: LineRules,
}

/// The tool's way from one pose to another: `R(t) = even + cos · cos(tθ) + sin · sin(tθ)`.
struct Way {
    from: Vec3,
    along: Vec3,
    even: Matrix3<f64>,
    cos: Matrix3<f64>,
    sin: Matrix3<f64>,
    turn_rad: f64,
}

impl Way {
    fn between(from: &Frame, to: &Frame) -> Self {
        let (axis, turn_rad) = axis_angle(&(to.rotation * from.rotation.transpose()));
        let sin = axis.cross_matrix() * from.rotation;
        let even = axis * (axis.transpose() * from.rotation);
        Self {
            from: from.origin,
            along: to.origin - from.origin,
            cos: from.rotation - even,
            even,
            sin,
            turn_rad,
        }
    }

    #[inline]
    fn at(&self, share: f64) -> Frame {
        let (s, c) = libm::sincos(self.turn_rad * share);
        Frame { rotation: self.even + self.cos * c + self.sin * s, origin: self.from + self.along * share }
    }
}

/// The axis and the angle in `[0, π]` of a rotation; of half turns one of the two axes.
fn axis_angle(r: &Matrix3<f64>) -> (Vec3, f64) {
    let (x, y, z) = (r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    let (skew, trace) = (Vec3::new(x, y, z), r.trace());
    let angle = libm::atan2(skew.norm(), trace - 1.0);
    if skew.norm() > 1e-6 {
        return (skew / skew.norm(), angle);
    }
    if trace > 0.0 {
        return (Vec3::x(), 0.0);
    }
    // Near a half turn (R + I) / 2 is the axis times itself; its longest column is read.
    let outer = (r + Matrix3::identity()) * 0.5;
    let column = (0..3).max_by(|a, b| outer[(*a, *a)].total_cmp(&outer[(*b, *b)])).unwrap_or(0);
    let axis = outer.column(column).into_owned();
    let axis = axis / axis.norm();
    (if axis.dot(&skew) < 0.0 { -axis } else { axis }, angle)
}

impl Lines {
    /// The local path planner of `cell` under `rules`.
    pub fn new(cell: Cell, rules: LineRules) -> Self {
        Self { cell, rules }
    }

    /// The cell.
    pub fn cell(&self) -> &Cell {
        &self.cell
    }

    /// The rules.
    pub fn rules(&self) -> &LineRules {
        &self.rules
    }

    /// `q` with what local paths ask of it.
    pub fn pose(&self, q: &Joints) -> Pose {
        let arm = self.cell.robot().arm();
        Pose { q: *q, tool: arm.chain().forward(q), branch: arm.branch_of(q) }
    }

    /// Whether the local path between two free configurations can be executed.
    ///
    /// # Errors
    /// The first reason against it.
    pub fn join(&self, from: &Pose, to: &Pose, scratch: &mut Scratch) -> Result<(), Rejection> {
        let way = match self.rules.path {
            Path::Joints => {
                self.straight_joints(from, to, scratch);
                None
            }
            Path::Tool => {
                if self.rules.end != EdgeEnd::PoseOnly && from.branch != to.branch {
                    return Err(Rejection::Branch);
                }
                let way = Way::between(&from.tool, &to.tool);
                self.follow(from, &way, &mut scratch.states)?;
                let end = scratch.states.last().expect("a path has at least its ends");
                self.arrives(end, &to.q)?;
                Some(way)
            }
        };
        self.clear(way.as_ref(), from.branch, scratch)
    }

    /// The configurations at even steps from `from` along `way`, both ends included.
    fn follow(&self, from: &Pose, way: &Way, states: &mut Vec<Joints>) -> Result<(), Rejection> {
        let rules = &self.rules;
        if way.turn_rad > rules.turn_rad {
            return Err(Rejection::Turn);
        }
        let length_m = way.along.norm();
        let steps = (length_m / rules.step_m).max(way.turn_rad / rules.step_rad).ceil().max(1.0);
        let law_m = length_m.max(way.turn_rad / rules.step_rad * rules.step_m);
        let arm = self.cell.robot().arm();
        states.clear();
        states.push(from.q);
        let mut last = from.q;
        for step in 1..=steps as u32 {
            let share = f64::from(step) / steps;
            let q = arm.follow(&way.at(share), from.branch, &last).map_err(|missed| match missed {
                Missed::Unreachable => Rejection::Unreachable,
                Missed::Limits => Rejection::Limits,
            })?;
            if self.leaves_branch(&q, &last, from.branch, &way.at(share)) {
                return Err(Rejection::Branch);
            }
            let change = largest_change(&q, &last);
            if change > rules.jump_rad {
                // Only a joint that ran into a limit goes back by a turn.
                return Err(if change > 0.9 * TAU { Rejection::Limits } else { Rejection::Jump });
            }
            if let Some(law) = &rules.speed {
                let before = (share - 1.0 / steps) * law_m;
                let duration_s = law.time_s(share * law_m, law_m) - law.time_s(before, law_m);
                let joints = arm.chain().joints().iter().zip(q.iter().zip(&last));
                if joints.into_iter().any(|(j, (a, b))| (a - b).abs() > j.speed_rad_s * duration_s) {
                    return Err(Rejection::Speed);
                }
            }
            states.push(q);
            last = q;
        }
        Ok(())
    }

    /// Whether another branch offers a smaller change than `q`, of `branch`, does from `last`.
    ///
    /// All branches are asked only where the elbow or the wrist the other way round could be as near.
    #[inline]
    fn leaves_branch(&self, q: &Joints, last: &Joints, branch: Branch, target: &Frame) -> bool {
        let arm = self.cell.robot().arm();
        let change: f64 = q.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum();
        let flip_rad = arm.nearest_flip_rad(q, last);
        change >= flip_rad * flip_rad
            && arm.inverse_nearest(target, last).is_none_or(|(nearest, _)| nearest != branch)
    }

    fn arrives(&self, end: &Joints, wanted: &Joints) -> Result<(), Rejection> {
        let far = (0..AXES).any(|i| {
            let gap = end[i] - wanted[i];
            let turns = if i == 3 || i == 5 { (gap / TAU).round() * TAU } else { 0.0 };
            match self.rules.end {
                EdgeEnd::Own => gap.abs() > SAME_RAD,
                EdgeEnd::WholeTurns => (gap - turns).abs() > SAME_RAD,
                EdgeEnd::PoseOnly => false,
            }
        });
        if far { Err(Rejection::End) } else { Ok(()) }
    }

    fn straight_joints(&self, from: &Pose, to: &Pose, scratch: &mut Scratch) {
        let steps = (largest_change(&from.q, &to.q) / self.rules.step_rad).ceil().max(1.0);
        let at = |step: u32| between(&from.q, &to.q, f64::from(step) / steps);
        scratch.states.clear();
        scratch.states.extend((0..=steps as u32).map(at));
    }

    /// Whether no configuration of `scratch` and none between them is in contact: from the middle outwards.
    fn clear(&self, way: Option<&Way>, branch: Branch, scratch: &mut Scratch) -> Result<(), Rejection> {
        let chain = self.cell.robot().arm().chain();
        let parts = self.cell.body().parts();
        let Scratch { states, placed, ways, checked } = scratch;
        placed.clear();
        for q in states.iter() {
            let frames = chain.frames(q);
            placed.extend(parts.iter().map(|part| part.placed(&frames)));
        }
        let at = |state: usize| &placed[state * parts.len()..(state + 1) * parts.len()];
        ways.clear();
        for step in 1..states.len() {
            ways.extend(at(step - 1).iter().zip(at(step)).map(|(a, b)| axis_way_m(a, b)));
        }
        // The way of a part to the state `step` and on from it; there is none before the first and after the last.
        let way_m = |step: usize, part: usize| {
            let before = if step == 0 { 0.0 } else { ways[(step - 1) * parts.len() + part] };
            ways.get(step * parts.len() + part).map_or(before, |after| before.max(*after))
        };
        let mut near = Vec::new();
        for state in middle_outwards(states.len()) {
            let reach = |part| HALF_WAY * way_m(state, part);
            *checked += 1;
            match self.cell.standing(at(state), reach) {
                Standing::Contact => return Err(Rejection::Contact),
                Standing::Near => near.push(state),
                Standing::Clear => {}
            }
        }
        let share = |state: usize| state as f64 / (states.len() - 1) as f64;
        let doubtful = (1..states.len()).filter(|step| near.contains(step) || near.contains(&(step - 1)));
        for step in doubtful {
            let ends = [step - 1, step].map(|state| (share(state), states[state], at(state)));
            let between = Doubt { lines: self, way, branch, states };
            between.settle([ends[0], ends[1]], HALVINGS)?;
        }
        Ok(())
    }
}

/// A path with a step that must be looked at more closely.
struct Doubt<'a> {
    lines: &'a Lines,
    way: Option<&'a Way>,
    branch: Branch,
    states: &'a [Joints],
}

/// A share of the path, the joints there, and the body placed.
type Stop<'a> = (f64, Joints, &'a [Capsule]);

impl Doubt<'_> {
    fn settle(&self, [a, b]: [Stop<'_>; 2], halvings: u32) -> Result<(), Rejection> {
        let cell = &self.lines.cell;
        let share = f64::midpoint(a.0, b.0);
        let q = match self.way {
            Some(way) => cell
                .robot()
                .arm()
                .follow(&way.at(share), self.branch, &a.1)
                .map_err(|_| Rejection::Unreachable)?,
            None => between(&self.states[0], &self.states[self.states.len() - 1], share),
        };
        let mut placed = Vec::with_capacity(a.2.len());
        cell.place(&q, &mut placed);
        let reach = |part: usize| {
            2.0 * HALF_WAY * axis_way_m(&a.2[part], &placed[part]).max(axis_way_m(&placed[part], &b.2[part]))
        };
        match cell.standing(&placed, reach) {
            Standing::Contact => Err(Rejection::Contact),
            Standing::Near if halvings > 1 => {
                let middle: Stop<'_> = (share, q, &placed);
                self.settle([a, middle], halvings - 1)?;
                self.settle([middle, b], halvings - 1)
            }
            Standing::Clear | Standing::Near => Ok(()),
        }
    }
}

/// The longest way that an end of a capsule's axis goes.
#[inline]
fn axis_way_m(from: &Capsule, to: &Capsule) -> f64 {
    let a = (to.segment.a - from.segment.a).norm_squared();
    let b = (to.segment.b - from.segment.b).norm_squared();
    a.max(b).sqrt()
}

fn largest_change(a: &Joints, b: &Joints) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn between(a: &Joints, b: &Joints, share: f64) -> Joints {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
}

/// 0 to `count - 1`, the middle first and the ends last.
fn middle_outwards(count: usize) -> impl Iterator<Item = usize> {
    let middle = count / 2;
    (0..count).map(move |i| if i % 2 == 0 { middle + i / 2 } else { middle - i.div_ceil(2) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_comes_first_and_every_state_once() {
        for count in 1..20 {
            let mut order: Vec<usize> = middle_outwards(count).collect();
            assert_eq!(order[0], count / 2);
            order.sort_unstable();
            assert_eq!(order, (0..count).collect::<Vec<_>>(), "{count}");
        }
    }

    #[test]
    fn the_way_ends_where_it_should_and_turns_evenly_even_by_half_a_turn() {
        let axes = [Vec3::x(), Vec3::new(1.0, 2.0, -2.0) / 3.0, Vec3::new(0.0, 0.6, -0.8)];
        for (axis, angle) in
            axes.iter().flat_map(|axis| [0.0, 1e-8, 0.3, 2.9, std::f64::consts::PI].map(|a| (axis, a)))
        {
            let from = Frame::at(Vec3::new(1.0, 2.0, 3.0)) * Frame::turned(&Vec3::y(), 0.7);
            let to =
                Frame { rotation: Frame::turned(axis, angle).rotation * from.rotation, origin: Vec3::z() };
            let way = Way::between(&from, &to);
            assert!((way.turn_rad - angle).abs() < 1e-6, "{axis:?} {angle}: {}", way.turn_rad);
            for (share, end) in [(0.0, &from), (1.0, &to)] {
                let got = way.at(share);
                assert!((got.rotation - end.rotation).norm() < 1e-6, "{axis:?} {angle} at {share}");
                assert!((got.origin - end.origin).norm() < 1e-12);
            }
            let step = |a: f64, b: f64| (way.at(a).rotation.transpose() * way.at(b).rotation).trace();
            assert!((step(0.1, 0.3) - step(0.6, 0.8)).abs() < 1e-9, "{axis:?} {angle}");
        }
    }

    #[test]
    fn the_time_law_is_rest_to_rest() {
        let law = SpeedRule { speed_m_s: 0.5, acceleration_m_s2: 2.0 };
        // 62.5 mm of ramp at either end, 0.25 s each; 0.875 m at 0.5 m/s between.
        assert!((law.time_s(1.0, 1.0) - (0.5 + 1.75)).abs() < 1e-12);
        assert!((law.time_s(0.0625, 1.0) - 0.25).abs() < 1e-12);
        assert!((law.time_s(0.5, 1.0) * 2.0 - law.time_s(1.0, 1.0)).abs() < 1e-12);
        // Too short to reach the speed: 2 √(length / acceleration).
        assert!((law.time_s(0.02, 0.02) - 0.2).abs() < 1e-12);
    }
}
