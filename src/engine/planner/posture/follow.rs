//! Following a tip path with the whole arm, turning the tip where a rod comes near.

use super::place::Place;
use super::potential::{Field, direction, field, inverse};
use super::rotation::{exp, log};
use super::settings::{Bounds, Pose, Posture};
use nalgebra::{Matrix3, Vector6};
use world::geometry::{Capsule, Vec3};
use world::kinematics::ik::Branch;
use world::kinematics::{AXES, Joints};
use world::space::PolyhedraWorld;
use world::space::polyhedra::{Apart, CarriedArm, DOWN};

/// A joint that moves more than this between two stored configurations has jumped.
const JUMP_RAD: f64 = 0.35;
/// Between stored configurations rods are checked at least this often.
const CHECK_RAD: f64 = 0.01;
/// How far around it a configuration is looked at: what is left of it serves the next ones.
const FAR_CM: f64 = 6.0;

/// The arm on its way.
pub(super) struct Follower<'a> {
    pub(super) settings: &'a Posture,
    pub(super) world: &'a PolyhedraWorld,
    /// What is remembered of where obstacles are.
    pub(super) apart: Apart,
    pub(super) arm: &'a CarriedArm,
    pub(super) branch: Branch,
    pub(super) here: Place,
    /// Where the arm would be next, if that was looked at.
    ahead: Option<Place>,
    pub(super) rotation: Matrix3<f64>,
    /// Every configuration stored.
    pub(super) trail: Vec<Joints>,
    /// Where the tip is at each.
    pub(super) tips: Vec<[f64; 3]>,
    /// Steps of adjustment taken.
    pub(super) adjustments: u64,
}

impl<'a> Follower<'a> {
    /// At `q` on `branch`, where the tip has the posture `rotation`.
    pub(super) fn new(
        (settings, world, arm): (&'a Posture, &'a PolyhedraWorld, &'a CarriedArm),
        branch: Branch,
        q: Joints,
        rotation: Matrix3<f64>,
    ) -> Self {
        let here = Place::new(arm, &q);
        Self {
            settings,
            world,
            apart: arm.apart(world.bodies()),
            arm,
            branch,
            tips: vec![arm.tip_in(&here.frames).into()],
            here,
            ahead: None,
            rotation,
            trail: vec![q],
            adjustments: 0,
        }
    }

    /// Follows `nodes` from the second on; the index of the node that could not be reached, if there is one.
    pub(super) fn follow(&mut self, nodes: &[Vec3]) -> Result<(), usize> {
        for (index, pair) in nodes.windows(2).enumerate() {
            self.step(&pair[0], &pair[1]).ok_or(index + 1)?;
        }
        Ok(())
    }

    /// One node on: returns towards the first posture where there is room, turns away where there is not.
    fn step(&mut self, here: &Vec3, next: &Vec3) -> Option<()> {
        if !self.settings.adjust {
            return self.advance(next, self.rotation);
        }
        let recovered = self.recovered();
        let solved = self.solve(next, &recovered, &self.here.q).filter(|q| self.has_room(q));
        if let Some(q) = solved
            && self.turn_and_advance(here, next, recovered, Some(q)).is_some()
        {
            return Some(());
        }
        let turned = self.adjusted(next)?;
        let q = self.solve(next, &turned, &self.here.q);
        self.turn_and_advance(here, next, turned, q)
    }

    /// Whether no adjustment is needed at `q`.
    fn has_room(&mut self, q: &Joints) -> bool {
        if self.settings.uses_printed_distance() {
            let bodies = self.world.bodies();
            return self.arm.is_clear(q, bodies, self.settings.act_cm, true, &self.apart);
        }
        let mut place = Place::after(&self.here, self.arm, q);
        if place.clearance_cm < self.settings.act_cm {
            self.measure(&mut place);
        }
        let has_room = place.clearance_cm >= self.settings.act_cm;
        self.ahead = Some(place);
        has_room
    }

    fn recovered(&self) -> Matrix3<f64> {
        let back = log(&(DOWN * self.rotation.transpose()));
        let share = (self.settings.recovery_rad / back.norm().max(1e-12)).min(1.0);
        exp(&(back * share)) * self.rotation
    }

    fn solve(&self, tip: &Vec3, rotation: &Matrix3<f64>, reference: &Joints) -> Option<Joints> {
        self.arm.arm().inverse_on(&CarriedArm::target(tip, rotation), self.branch, reference)
    }

    fn field(&self, place: &Place) -> Field {
        field(self.settings, self.world, self.arm, &place.rods, &self.apart)
    }

    /// The rod that is nearest to something where the arm would be at `next` with its present posture.
    pub(super) fn blocking(&self, next: &Vec3) -> Option<Capsule> {
        let q = self.solve(next, &self.rotation, &self.here.q)?;
        let place = Place::new(self.arm, &q);
        let found = self.field(&place).contacts;
        let nearest = found.iter().min_by(|a, b| a.clearance.total_cmp(&b.clearance))?;
        Some(place.rods[nearest.rod])
    }

    /// The posture for `next` after descending the potential there, within bounds; `None` if a rod still touches.
    fn adjusted(&mut self, next: &Vec3) -> Option<Matrix3<f64>> {
        let origin = match self.settings.bounds {
            Bounds::PerNode => self.rotation,
            Bounds::FromStart => DOWN,
        };
        let mut rotation = self.rotation;
        let mut place = Place::new(self.arm, &self.solve(next, &rotation, &self.here.q)?);
        let mut now = self.field(&place);
        for _ in 0..self.settings.iterations {
            if now.clearance >= self.settings.act_cm {
                break;
            }
            let Some(direction) = direction(self.settings, self.arm, &place.frames, &now) else { break };
            let tried = (0..=self.settings.halvings).find_map(|halving| {
                let length = self.settings.step_rad / f64::from(1 << halving);
                let turned = self.bounded(&origin, &(exp(&(direction * length)) * rotation));
                let moved = Place::new(self.arm, &self.solve(next, &turned, &place.q)?);
                let then = self.field(&moved);
                let improves = then.potential < now.potential || then.clearance > now.clearance;
                (improves || self.settings.sign == super::settings::Sign::AsPrinted)
                    .then_some((turned, moved, then))
            });
            let Some((turned, moved, then)) = tried else { break };
            self.adjustments += 1;
            (rotation, place, now) = (turned, moved, then);
        }
        place.clearance_cm = now.clearance;
        self.ahead = Some(place);
        (now.clearance >= self.settings.margin_cm).then_some(rotation)
    }

    /// `rotation` with its turn from `origin` cut to the bounds about each axis.
    fn bounded(&self, origin: &Matrix3<f64>, rotation: &Matrix3<f64>) -> Matrix3<f64> {
        let bounds = Vec3::from(self.settings.bounds_rad);
        let turn = log(&(rotation * origin.transpose()));
        exp(&turn.zip_map(&bounds, |angle, bound| angle.clamp(-bound, bound))) * origin
    }

    /// Turns in place and moves on; where there is no room to turn here, turns while moving.
    /// `q` is the configuration at `next` with the posture `rotation`, solved from the present one.
    fn turn_and_advance(
        &mut self,
        here: &Vec3,
        next: &Vec3,
        rotation: Matrix3<f64>,
        q: Option<Joints>,
    ) -> Option<()> {
        if rotation == self.rotation {
            // No turn: neither it nor a way back is to be kept.
            return self.store(q?, rotation);
        }
        let place = self.here.clone();
        let before = self.rotation;
        let stored = self.trail.len();
        let turned = self.turn(here, rotation);
        if turned.is_some() && self.trail.len() > stored && self.advance(next, rotation).is_some() {
            return Some(());
        }
        (self.here, self.rotation) = (place, before);
        self.trail.truncate(stored);
        self.tips.truncate(stored);
        self.store(q?, rotation)
    }

    /// Turns the tip in place, in steps that are stored.
    fn turn(&mut self, here: &Vec3, rotation: Matrix3<f64>) -> Option<()> {
        let whole = log(&(rotation * self.rotation.transpose()));
        let count = (whole.norm() / self.settings.step_rad).ceil() as u32;
        let origin = self.rotation;
        for k in 1..=count {
            let share = f64::from(k) / f64::from(count);
            let turned = exp(&(whole * share)) * origin;
            let q = match self.settings.pose {
                Pose::Inverse => self.solve(here, &turned, &self.here.q)?,
                Pose::Jacobian => self.dead_reckoned(&(whole / f64::from(count)))?,
            };
            self.store(q, turned)?;
        }
        Some(())
    }

    /// The joints after turning by `w`, by the Jacobian alone.
    fn dead_reckoned(&self, w: &Vec3) -> Option<Joints> {
        let inverse = inverse(&self.arm.tip_jacobian(&self.here.frames), self.settings.damping)?;
        let change = inverse * Vector6::new(0.0, 0.0, 0.0, w.x, w.y, w.z);
        Some(std::array::from_fn(|i| self.here.q[i] + change[i]))
    }

    fn advance(&mut self, next: &Vec3, rotation: Matrix3<f64>) -> Option<()> {
        let q = self.solve(next, &rotation, &self.here.q)?;
        self.store(q, rotation)
    }

    /// Goes to `q` if nothing touches on the way.
    fn store(&mut self, q: Joints, rotation: Matrix3<f64>) -> Option<()> {
        let most = (0..AXES).map(|i| (q[i] - self.here.q[i]).abs()).fold(0.0, f64::max);
        if most > JUMP_RAD || !self.arm.arm().chain().allows(&q) {
            return None;
        }
        let ahead = self.ahead.take_if(|ahead| ahead.q == q);
        let mut place = ahead.unwrap_or_else(|| Place::after(&self.here, self.arm, &q));
        if !self.is_surely_clear(&mut place) && !self.is_clear_to(&q, most) {
            return None;
        }
        self.trail.push(q);
        self.tips.push(self.arm.tip_in(&place.frames).into());
        (self.here, self.rotation) = (place, rotation);
        Some(())
    }

    /// Whether what the rods have around them at one end of the way to `place` shows that nothing touches on it.
    fn is_surely_clear(&self, place: &mut Place) -> bool {
        if self.settings.uses_printed_distance() {
            return false;
        }
        let needed = self.settings.margin_cm + place.moved_cm(&self.here, self.arm);
        if self.here.clearance_cm >= needed {
            return true;
        }
        if place.clearance_cm < needed {
            self.measure(place);
        }
        place.clearance_cm >= needed
    }

    fn measure(&self, place: &mut Place) {
        let reach = self.settings.act_cm.max(FAR_CM);
        place.measure(self.arm, self.world.bodies(), reach, &self.apart);
    }

    /// Whether nothing touches on the way to `q`, looked at in steps; no joint moves by more than `most`.
    fn is_clear_to(&self, q: &Joints, most: f64) -> bool {
        let count = (most / CHECK_RAD).ceil().max(1.0) as u32;
        (1..=count).all(|k| {
            let share = f64::from(k) / f64::from(count);
            let between = std::array::from_fn(|i| self.here.q[i] + (q[i] - self.here.q[i]) * share);
            let bodies = self.world.bodies();
            let printed = self.settings.uses_printed_distance();
            self.arm.is_clear(&between, bodies, self.settings.margin_cm, printed, &self.apart)
        })
    }
}
