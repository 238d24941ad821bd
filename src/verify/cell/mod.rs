//! Judges paths of a six-axis arm in its cell: whether the robot can execute the motion that a path stands for.
//!
//! Everything is worked out again by other means than planners use, at a quarter of the planner's step. Forward
//! kinematics are products of 4 × 4 matrices. Joints follow by Newton's method from the arm's true configuration.
//! Orientations are quaternions, and parry3d finds contacts. Lengths are metres and angles radians.

mod chain;
mod contact;
mod follow;
#[cfg(test)]
mod tests;

pub use chain::{Chain, Row};
pub use contact::{Body, Part, Shape};
pub use follow::{Leg, Stop};

use contact::Obstacles;
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard};

/// Joint angles.
pub type Angles = [f64; 6];

/// How many steps of ours make one of the planner's.
const FINER: u32 = 4;

/// What the end of a leg must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LegEnd {
    /// The configuration that the path names.
    Own,
    /// The same up to whole turns of joints 4 and 6.
    WholeTurns,
    /// Any with the tool in the same pose.
    PoseOnly,
}

/// What a leg must keep to; the numbers are those of the planner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rules {
    /// The joints go straight instead of the tool.
    pub straight_joints: bool,
    /// The planner's longest step of the tool.
    pub step_m: f64,
    /// Its longest step of the orientation, or of a joint.
    pub step_rad: f64,
    /// The most that a joint may change in one such step.
    pub jump_rad: f64,
    /// The greatest speed and the acceleration of the tool under which joint speeds are checked.
    pub speed: Option<[f64; 2]>,
    /// What the end of a leg must be.
    pub end: LegEnd,
}

/// A cell with its rules, and the legs that were judged in it.
#[derive(Debug)]
pub struct Case {
    chain: Chain,
    obstacles: Obstacles,
    rules: Rules,
    known: Mutex<Known>,
}

/// Legs by their ends, and what became of them.
type Known = BTreeMap<[[u64; 6]; 2], Result<Leg, String>>;

/// What the motion along a path amounts to.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// The way of the tool's tip.
    pub length_m: f64,
    /// The sum of all joints' changes, there and back.
    pub travel_rad: f64,
    /// The greatest acceleration of a joint under the time law of `follow`.
    pub peak_rad_s2: f64,
    /// Where the arm is when, from leg to leg.
    pub stops: Vec<Stop>,
}

impl Case {
    /// The case of an arm among obstacles.
    pub fn new(chain: Chain, body: Body, shapes: &[Shape], rules: Rules) -> Self {
        Self { chain, obstacles: Obstacles::new(body, shapes), rules, known: Mutex::default() }
    }

    /// The motion along `path`, whose first and last configurations must be `start` and `goal`.
    ///
    /// # Errors
    /// Why the path cannot be executed as claimed.
    pub fn motion(&self, path: &[Angles], [start, goal]: [&Angles; 2]) -> Result<Motion, String> {
        let (Some(first), Some(last)) = (path.first(), path.last()) else {
            return Err("a solved plan without a path".to_owned());
        };
        if first != start || last != goal {
            return Err("the path does not go from start to goal".to_owned());
        }
        let mut motion = Motion { length_m: 0.0, travel_rad: 0.0, peak_rad_s2: 0.0, stops: Vec::new() };
        let mut at = *first;
        let mut time_s = 0.0;
        self.obstacles
            .refusal(&self.chain, &at, &self.chain.frames(&at))
            .map_or(Ok(()), |refusal| Err(format!("at the start, {refusal}")))?;
        for (index, to) in path.iter().enumerate().skip(1) {
            let leg = self.leg(&at, to).map_err(|refusal| format!("leg {index}: {refusal}"))?;
            motion.length_m += leg.length_m;
            motion.travel_rad += leg.travel_rad;
            motion.peak_rad_s2 = motion.peak_rad_s2.max(leg.peak_rad_s2);
            let shifted = leg.stops.iter().skip(usize::from(index > 1));
            motion.stops.extend(shifted.map(|stop| Stop { time_s: stop.time_s + time_s, ..*stop }));
            time_s += leg.duration_s;
            at = leg.end;
        }
        Ok(motion)
    }

    /// The straight distance between the tool's places in two configurations.
    pub fn straight_m(&self, a: &Angles, b: &Angles) -> f64 {
        (self.chain.tool(a).1 - self.chain.tool(b).1).norm()
    }

    fn leg(&self, from: &Angles, to: &Angles) -> Result<Leg, String> {
        let key = [from.map(f64::to_bits), to.map(f64::to_bits)];
        if let Some(known) = self.known().get(&key) {
            return known.clone();
        }
        let found = follow::leg(self, from, to);
        self.known().insert(key, found.clone());
        found
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().expect("no thread panics while it looks a leg up")
    }
}
