//! Answers to a planner's questions, by the collision checks that our own planners use.
//!
//! **What `motion` accepts, the verifier accepts**: exactly, but in an arm's cell for contacts thinner than the engine's own checks
//! can see (`space::cell::line` says how thin). A motion is answered as a leg of a path by itself:
//! it ends in the configuration requested, whatever a study's paths may end in.

use super::clear;
use super::describe::pose;
use super::message::{Answer, Ask};
use super::world::Pose;
use base::grid::{CornerRule, corners_see};
use engine::geometry::{Frame, Segment, Vec2, Vec3};
use engine::kinematics::{Arm, Joints};
use engine::shorten::path_length;
use engine::space::cell::{EdgeEnd, LineRules, Lines, Path, Scratch};
use engine::space::roadmap::{Local, RASTER_MM, joints};
use engine::space::{LatticeWorld, World};
use nalgebra::Matrix3;

const CM_PER_M: f64 = 100.0;

/// A share of a motion that is known no better than this is not looked at more closely.
const FRACTION: f64 = 1e-3;

/// The most questions in one message.
pub const MOST_QUESTIONS: u64 = 100_000;

/// How many quick questions are answered between two looks at the clock.
const SLICE: usize = 64;

/// Why a batch was not answered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unanswered {
    /// Its time was over.
    Stopped,
    /// It holds too much, or something that is no question about this world: a sentence.
    Refused(String),
}

/// The answers to `all`, so many at a time while `goes_on` holds.
fn sliced<Q, A>(
    all: &[Q],
    size: usize,
    goes_on: &dyn Fn() -> bool,
    mut answers: impl FnMut(&[Q]) -> Result<Vec<A>, String>,
) -> Result<Vec<A>, Unanswered> {
    let mut found = Vec::with_capacity(all.len());
    for slice in all.chunks(size) {
        if !goes_on() {
            return Err(Unanswered::Stopped);
        }
        found.extend(answers(slice).map_err(Unanswered::Refused)?);
    }
    Ok(found)
}

/// How many questions were answered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct QuestionCounts {
    /// Batches of questions.
    pub batches: u64,
    /// Configurations that were checked.
    pub valid: u64,
    /// Motions that were checked.
    pub motion: u64,
    /// Configurations with the poses that were computed from them.
    pub fk: u64,
    /// Poses with the configurations that were computed from them.
    pub ik: u64,
}

/// A world under question.
pub struct Space<'a> {
    world: &'a World,
    any_angle: bool,
    /// The local paths of a cell with the end that was requested.
    lines: Option<Lines>,
    scratch: Scratch,
    questions: QuestionCounts,
}

impl<'a> Space<'a> {
    /// `world`; on a grid, whether steps may go at any angle is the caller's word.
    pub fn new(world: &'a World, any_angle: bool) -> Self {
        let lines = world.as_roadmap().and_then(|roadmap| match roadmap.local() {
            Local::Arm(lines) => {
                let rules = LineRules { end: EdgeEnd::Own, ..*lines.rules() };
                Some(Lines::new(lines.cell().clone(), rules))
            }
            Local::Joints(_) | Local::Plane(_) => None,
        });
        Self { world, any_angle, lines, scratch: Scratch::default(), questions: QuestionCounts::default() }
    }

    /// How many questions were answered.
    pub fn question_counts(&self) -> QuestionCounts {
        self.questions
    }

    /// How many numbers make a configuration.
    pub fn width(&self) -> usize {
        match self.world {
            World::Lattice(_) | World::Arm(_) => 2,
            World::Polyhedra(_) => 3,
            World::Roadmap(roadmap) => roadmap.local().width(),
        }
    }

    /// The answers to a batch.
    ///
    /// # Errors
    /// A sentence about the first question that cannot be answered.
    pub fn answer(&mut self, ask: &Ask) -> Result<Answer, String> {
        self.answer_while(ask, &|| true).map_err(|error| match error {
            Unanswered::Stopped => unreachable!("nothing stops it"),
            Unanswered::Refused(why) => why,
        })
    }

    /// The answers to a batch, which is given up as soon as `goes_on` does not hold: it is looked at before every few questions.
    ///
    /// # Errors
    /// [`Unanswered`].
    pub fn answer_while(&mut self, ask: &Ask, goes_on: &dyn Fn() -> bool) -> Result<Answer, Unanswered> {
        let Ask { id, valid, motion, fractions, fk, ik } = ask;
        self.questions.batches += 1;
        self.questions.valid += count(valid.as_ref());
        self.questions.motion += count(motion.as_ref());
        self.questions.fk += count(fk.as_ref());
        self.questions.ik += count(ik.as_ref());
        let all = count(valid.as_ref()) + count(motion.as_ref()) + count(fk.as_ref()) + count(ik.as_ref());
        if all > MOST_QUESTIONS {
            let why = format!("the planner asks {all} questions at once; {MOST_QUESTIONS} are accepted");
            return Err(Unanswered::Refused(why));
        }
        let valid = valid.as_ref().map(|all| sliced(all, SLICE, goes_on, |some| self.are_valid(some)));
        let valid = valid.transpose()?;
        let are_free = motion.as_ref().map(|all| {
            sliced(all, 1, goes_on, |one| one.iter().map(|[from, to]| self.is_free(from, to)).collect())
        });
        let are_free = are_free.transpose()?;
        let ends = motion.as_ref().zip(are_free.as_ref()).filter(|_| *fractions);
        let free_until = ends.map(|(all, are_free)| {
            let both: Vec<_> = all.iter().zip(are_free).collect();
            sliced(&both, 1, goes_on, |one| {
                let until = |([from, to], is_free): &(&[Vec<f64>; 2], &bool)| {
                    if **is_free { 1.0 } else { self.free_until(from, to) }
                };
                Ok(one.iter().map(until).collect())
            })
        });
        let free_until = free_until.transpose()?;
        let fk = fk
            .as_ref()
            .map(|all| sliced(all, SLICE, goes_on, |some| some.iter().map(|q| self.forward(q)).collect()));
        let fk = fk.transpose()?;
        let ik = ik
            .as_ref()
            .map(|all| sliced(all, 1, goes_on, |one| one.iter().map(|pose| self.inverse(pose)).collect()));
        let ik = ik.transpose()?;
        Ok(Answer { id: *id, valid, motion: are_free, free_until, fk, ik })
    }

    /// Whether the configuration is free.
    ///
    /// # Errors
    /// It has not as many numbers as configurations of this world.
    pub fn is_valid(&self, at: &[f64]) -> Result<bool, String> {
        self.check(at)?;
        Ok(match self.world {
            World::Lattice(lattice) => lattice.free_cell("", at).is_ok(),
            World::Arm(arm) => arm.free_cell("", at).is_ok(),
            World::Polyhedra(polyhedra) => polyhedra.free_point("", at).is_ok(),
            World::Roadmap(roadmap) => match roadmap.local() {
                Local::Arm(lines) => joints(at).is_some_and(|q| lines.cell().is_free(&q)),
                Local::Joints(_) => roadmap.local().refusal(at).is_none(),
                Local::Plane(_) => {
                    at.iter().all(|x| (x / RASTER_MM).fract() == 0.0) && roadmap.local().refusal(at).is_none()
                }
            },
        })
    }

    /// Whether each of the configurations is free; those of a cell are looked at together.
    ///
    /// # Errors
    /// As [`is_valid`](Self::is_valid).
    fn are_valid(&self, configurations: &[Vec<f64>]) -> Result<Vec<bool>, String> {
        if let Some(lines) = &self.lines {
            let states =
                configurations.iter().map(|at| self.check(at).map(|()| joints(at).unwrap_or_default()));
            return Ok(lines.cell().are_free(&states.collect::<Result<Vec<_>, _>>()?));
        }
        configurations.iter().map(|at| self.is_valid(at)).collect()
    }

    /// Whether the motion between two configurations is free, both ends included.
    ///
    /// # Errors
    /// As [`is_valid`](Self::is_valid).
    pub fn is_free(&mut self, from: &[f64], to: &[f64]) -> Result<bool, String> {
        Ok(self.is_valid(from)? && self.is_valid(to)? && self.joins(from, to))
    }

    fn check(&self, at: &[f64]) -> Result<(), String> {
        let found = at.len();
        let width = self.width();
        let wrong = || format!("a question has a configuration of {found} numbers; {width} are accepted");
        if found == width { Ok(()) } else { Err(wrong()) }
    }

    /// Whether the motion between two free configurations is.
    fn joins(&mut self, from: &[f64], to: &[f64]) -> bool {
        match self.world {
            World::Lattice(lattice) => joins_cells(lattice, from, to, self.any_angle),
            World::Arm(arm) => match (arm.free_cell("", from), arm.free_cell("", to)) {
                (Ok(from), Ok(to)) => from != to && arm.may_hop(from, to),
                _ => false,
            },
            World::Polyhedra(polyhedra) => {
                let [a, b] = [from, to].map(|p| Vec3::new(p[0], p[1], p[2]));
                polyhedra.is_clear(&Segment::new(a, b))
            }
            World::Roadmap(roadmap) => match (roadmap.local(), &self.lines, joints(from), joints(to)) {
                (_, Some(lines), Some(from), Some(to)) => {
                    lines.join(&lines.pose(&from), &lines.pose(&to), &mut self.scratch).is_ok()
                }
                (Local::Joints(space), ..) => space.joins(from, to, self.scratch.count()),
                (Local::Plane(map), ..) => map.sees([from[0], from[1]], [to[0], to[1]]),
                (Local::Arm(_), ..) => {
                    unreachable!("its local paths and the width of its configurations are known")
                }
            },
        }
    }

    /// A share up to which the motion is free by itself, found by halving; 0 where states between two are none (on lattices)
    /// or are not known beforehand (where the tool goes straight).
    fn free_until(&mut self, from: &[f64], to: &[f64]) -> f64 {
        let is_lattice = matches!(self.world, World::Lattice(_) | World::Arm(_));
        let is_tool = self.lines.as_ref().is_some_and(|lines| lines.rules().path == Path::Tool);
        if is_lattice || is_tool || self.is_valid(from) != Ok(true) {
            return 0.0;
        }
        let is_plane =
            matches!(self.world, World::Roadmap(roadmap) if matches!(roadmap.local(), Local::Plane(_)));
        let mut free = 0.0;
        let mut not = 1.0;
        while not - free > FRACTION {
            let middle = f64::midpoint(free, not);
            let mut at: Vec<f64> = from.iter().zip(to).map(|(a, b)| a + (b - a) * middle).collect();
            if is_plane {
                for x in &mut at {
                    *x = (*x / RASTER_MM).round() * RASTER_MM;
                }
            }
            if self.is_free(from, &at) == Ok(true) { free = middle } else { not = middle }
        }
        free
    }

    /// Forward and inverse kinematics, and how many units of the world make a metre.
    fn arm(&self) -> Option<(&Arm, f64)> {
        match (self.world, &self.lines) {
            (_, Some(lines)) => Some((lines.cell().robot().arm(), 1.0)),
            (World::Polyhedra(polyhedra), _) => polyhedra.arm().map(|arm| (arm.arm(), CM_PER_M)),
            _ => None,
        }
    }

    /// Where the tip is at joint angles `q`.
    fn forward(&self, q: &[f64]) -> Result<Pose, String> {
        if let (World::Arm(world), [q1, q2]) = (self.world, q) {
            let tip = world.rules().arm.forward([*q1, *q2]);
            return Ok(Pose { position: vec![tip.x, tip.y], rotation: None });
        }
        let (arm, scale) = self.arm().ok_or("fk needs an arm, and this world has none")?;
        let q = joints(q).ok_or_else(|| format!("fk is given {} angles; 6 are accepted", q.len()))?;
        Ok(pose(&arm.chain().forward(&q), scale))
    }

    /// Every posture with the tip in `pose`.
    fn inverse(&self, pose: &Pose) -> Result<Vec<Vec<f64>>, String> {
        if let (World::Arm(world), [x, y]) = (self.world, pose.position.as_slice()) {
            let found = world.rules().arm.inverse(&Vec2::new(*x, *y));
            return Ok(found
                .map_or_else(|_| Vec::new(), |both| vec![both.negative.to_vec(), both.positive.to_vec()]));
        }
        let (arm, scale) = self.arm().ok_or("ik needs an arm, and this world has none")?;
        let ([x, y, z], Some(rows)) = (pose.position.as_slice(), pose.rotation) else {
            return Err("ik is given a pose without three coordinates and a rotation".to_owned());
        };
        let rotation = Matrix3::from_fn(|i, j| rows[i][j]);
        let target = Frame { origin: Vec3::new(*x, *y, *z) / scale, rotation };
        let home: Joints = [0.0; 6];
        Ok(arm.inverse(&target, &home).iter().map(|(_, q)| q.to_vec()).collect())
    }

    /// The cost of `path` in the world's unit; none where a path's length is not the length of a polyline.
    pub fn cost(&self, path: &[Vec<f64>]) -> Option<f64> {
        match self.world {
            World::Roadmap(roadmap) if !roadmap.local().is_straight() => None,
            World::Roadmap(roadmap) => {
                let places: Vec<[f64; 3]> = path.iter().map(|at| roadmap.local().place_mm(at)).collect();
                Some(path_length(&places))
            }
            _ => Some(path_length(path)),
        }
    }

    /// The length of a path in the world's unit, also where joints go straight and the tool does not. There the tool's way is
    /// measured at steps of at most half a degree of any joint, which makes it shorter by less than a part in ten thousand.
    pub fn length(&self, path: &[Vec<f64>]) -> Option<f64> {
        self.cost(path).or_else(|| self.cost_of_steps(path))
    }

    fn cost_of_steps(&self, path: &[Vec<f64>]) -> Option<f64> {
        let World::Roadmap(roadmap) = self.world else { return None };
        let leg = |two: &[Vec<f64>]| -> f64 {
            let turn = two[0].iter().zip(&two[1]).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
            let steps = (turn / STEP_RAD).ceil().max(1.0);
            let at = |k: u32| {
                let share = f64::from(k) / steps;
                let between: Vec<f64> =
                    two[0].iter().zip(&two[1]).map(|(a, b)| a + (b - a) * share).collect();
                Vec3::from(roadmap.local().place_mm(&between))
            };
            (0..steps as u32).map(|k| (at(k + 1) - at(k)).norm()).sum()
        };
        Some(path.windows(2).map(leg).sum())
    }
}

/// How many questions a list holds.
fn count<T>(questions: Option<&Vec<T>>) -> u64 {
    questions.map_or(0, |all| all.len() as u64)
}

/// Half a degree.
const STEP_RAD: f64 = std::f64::consts::PI / 360.0;

fn joins_cells(lattice: &LatticeWorld, from: &[f64], to: &[f64], any_angle: bool) -> bool {
    let grid = lattice.grid();
    let rule = lattice.corner_rule();
    let (Ok(from), Ok(to)) = (lattice.free_cell("", from), lattice.free_cell("", to)) else { return false };
    let [[x, y], [to_x, to_y]] = [from, to].map(|cell| grid.xy(cell));
    let [dx, dy] = [to_x - x, to_y - y];
    if [dx, dy] == [0, 0] {
        return false;
    }
    if let Some(cells) = lattice.cornered() {
        let is_step = any_angle || (dx.abs() <= 1 && dy.abs() <= 1);
        return is_step && corners_see(cells, [x, y], [to_x, to_y]);
    }
    if any_angle {
        return clear::is_clear(grid, rule, from, to);
    }
    let permits = |rule: CornerRule| rule.permits([grid.is_free_xy(to_x, y), grid.is_free_xy(x, to_y)]);
    dx.abs() <= 1 && dy.abs() <= 1 && (dx == 0 || dy == 0 || permits(rule))
}
