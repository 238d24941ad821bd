//! Any chain of six axes, by a search: what it finds is right, what it does not find may exist.
//!
//! From a start, Levenberg–Marquardt steps lower the distance to the pose, until it is rounding or no step helps. The starts are
//! the reference and then configurations drawn once, from a written seed, within the limits; so the same question has the
//! same answer. A pose counts as out of reach if no start leads to it.
//!
//! Branches are the sides of the singularities: the sign of the Jacobian's determinant, as the first of the three signs. One side
//! may hold several configurations (an arm of this kind has at most 16 in all); [`solve`](Solver::solve) gives the first that is
//! found, which from a near reference is the near one.
//!
//! What a singular pose leaves free is near the reference, since the steps are the shortest ones that help.
//!
//! # Source
//! Levenberg–Marquardt: Nocedal & Wright, *Numerical Optimization* (2006), section 10.3; at most 16: Primrose, *On the
//! input-output equation of the general 7R-mechanism*, Mechanism and Machine Theory 21 (1986).

use super::{AXES, Branch, Chain, Family, Frame, Joints, KinematicsError, SOLUTIONS, Solutions, Solver};
use crate::geometry::Vec3;
use crate::kinematics::angle::wrapped;
use base::seed;
use nalgebra::{Matrix6, Vector6};
use rand::RngExt as _;
use std::{f64::consts::PI, f64::consts::TAU, sync::Arc};

pub(super) const FAMILY: Family = Family { name: "numerical", is_complete: false, build };

/// Starts beside the reference.
const STARTS: usize = 96;
/// The seed that they are drawn from.
const SEED: u64 = 6;
/// Steps from one start.
const STEPS: usize = 100;
/// Where steps end: metres over the arm's length, and radians.
const CLOSE: f64 = 1e-13;
/// What counts as the pose, in the same measure.
const REACHED: f64 = 1e-11;
/// Configurations that differ by less are one, radians.
const SAME_RAD: f64 = 1e-5;

#[derive(Debug)]
struct Numerical {
    chain: Chain,
    starts: Vec<Joints>,
    /// One over the length that counts as much as a radian.
    per_m: f64,
}

fn build(chain: &Chain) -> Result<Arc<dyn Solver>, KinematicsError> {
    let joints = *chain.joints();
    let chain = Chain::new(joints, Frame::IDENTITY, Frame::IDENTITY)?;
    let mut stream = seed::stream(SEED);
    let draw = |_| {
        joints.map(|joint| {
            let [lower_rad, upper_rad] = joint.range_rad();
            stream.random_range(lower_rad..upper_rad.min(lower_rad + TAU))
        })
    };
    let length_m: f64 = joints.iter().map(|joint| libm::hypot(joint.a_m, joint.d_m)).sum();
    if length_m == 0.0 {
        let accepted = "another number than 0 in some row, for the solver `numerical`";
        return Err(KinematicsError::joint(0, "d_mm", 0.0, accepted));
    }
    Ok(Arc::new(Numerical { starts: (0..STARTS).map(draw).collect(), per_m: 3.0 / length_m, chain }))
}

/// The rotation vector of the turn from `from` to `to`.
fn turn(from: &Frame, to: &Frame) -> Vec3 {
    let r = to.rotation * from.rotation.transpose();
    let across = Vec3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) * 0.5;
    let (sine, cosine) = (across.norm(), (r.trace() - 1.0) * 0.5);
    if sine < 1e-9 {
        // Half a turn is as good about one of the axes as about the true one: the next step is measured anew.
        return if cosine > 0.0 { across } else { Vec3::z() * PI };
    }
    across * (libm::atan2(sine, cosine) / sine)
}

/// A configuration on the way, and what is left to the pose.
struct State {
    q: Joints,
    frames: [Frame; AXES + 1],
    left: Vector6<f64>,
    left2: f64,
}

impl Numerical {
    fn state(&self, q: Joints, flange: &Frame) -> State {
        let frames = self.chain.frames(&q);
        let moved = (flange.origin - frames[AXES].origin) * self.per_m;
        let turned = turn(&frames[AXES], flange);
        let left = Vector6::new(moved.x, moved.y, moved.z, turned.x, turned.y, turned.z);
        State { q, frames, left, left2: left.norm_squared() }
    }

    /// The Jacobian in the measure of the steps.
    fn jacobian(&self, frames: &[Frame; AXES + 1]) -> Matrix6<f64> {
        let mut jacobian = Chain::jacobian(frames, AXES, &frames[AXES].origin);
        jacobian.fixed_rows_mut::<3>(0).scale_mut(self.per_m);
        jacobian
    }

    /// The configuration that steps from `start` lead to, if it has the flange at `flange`.
    fn descend(&self, start: &Joints, flange: &Frame) -> Option<Joints> {
        let mut state = self.state(*start, flange);
        let mut damping = 1e-2;
        for _ in 0..STEPS {
            if state.left2 < CLOSE * CLOSE {
                break;
            }
            let jacobian = self.jacobian(&state.frames);
            let normal = jacobian.tr_mul(&jacobian);
            let slope = jacobian.tr_mul(&state.left);
            let next = self.step(&normal, &slope, &state, flange, &mut damping);
            let Some(next) = next else { break };
            state = next;
        }
        (state.left2 < REACHED * REACHED).then_some(state.q)
    }

    /// A step that comes nearer, by as much damping as it takes.
    fn step(
        &self,
        normal: &Matrix6<f64>,
        slope: &Vector6<f64>,
        state: &State,
        flange: &Frame,
        damping: &mut f64,
    ) -> Option<State> {
        while *damping < 1e8 {
            let damped = normal + Matrix6::identity() * *damping;
            if let Some(factor) = damped.cholesky() {
                let change = factor.solve(slope);
                let next = self.state(std::array::from_fn(|i| state.q[i] + change[i]), flange);
                if next.left2 < state.left2 {
                    *damping = (*damping * 0.1).max(1e-15);
                    return Some(next);
                }
            }
            *damping *= 10.0;
        }
        None
    }

    /// What the reference and then the drawn starts lead to.
    fn found<'a>(&'a self, flange: &'a Frame, reference: &'a Joints) -> impl Iterator<Item = Joints> + 'a {
        let starts = std::iter::once(reference).chain(&self.starts);
        starts.filter_map(move |start| self.descend(start, flange))
    }
}

/// Whether two configurations are one but for whole turns and rounding.
fn is_same(a: &Joints, b: &Joints) -> bool {
    a.iter().zip(b).all(|(a, b)| wrapped(a - b).abs() < SAME_RAD)
}

fn change2(q: &Joints, reference: &Joints) -> f64 {
    q.iter().zip(reference).map(|(a, b)| wrapped(a - b) * wrapped(a - b)).sum()
}

impl Solver for Numerical {
    fn branch_of(&self, q: &Joints) -> Branch {
        let determinant = self.jacobian(&self.chain.frames(q)).determinant();
        Branch::new(determinant >= 0.0, true, true)
    }

    /// Nothing is known of how far the other branch is.
    fn folds_rad(&self, _q: &Joints) -> [f64; 2] {
        [0.0; 2]
    }

    fn solve(&self, flange: &Frame, branch: Branch, reference: &Joints) -> Option<Joints> {
        self.found(flange, reference).find(|q| self.branch_of(q) == branch)
    }

    fn solve_all(&self, flange: &Frame, reference: &Joints) -> Solutions {
        let mut distinct: Vec<Joints> = Vec::new();
        for q in self.found(flange, reference) {
            if distinct.len() < SOLUTIONS && !distinct.iter().any(|known| is_same(known, &q)) {
                distinct.push(q);
            }
        }
        distinct.sort_by(|a, b| change2(a, reference).total_cmp(&change2(b, reference)));
        let mut solutions = Solutions::none();
        for q in distinct {
            solutions.insert(self.branch_of(&q), q);
        }
        solutions
    }
}
