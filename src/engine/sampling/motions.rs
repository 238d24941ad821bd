//! A robot's configurations as a space: distances, points between, and which straight motions are free.

use super::Draw;
use std::f64::consts::TAU;
use world::space::roadmap::{Local, MotionScratch};

/// The space of a query, which counts its checks.
#[derive(Debug)]
pub struct Motions<'a> {
    local: &'a Local,
    limits: Vec<[f64; 2]>,
    turn_on: Vec<bool>,
    scratch: MotionScratch,
    tried: u64,
    /// Whether every motion is checked as finely as a path that is returned.
    is_fine: bool,
}

impl<'a> Motions<'a> {
    /// The space of a robot and its local paths.
    pub fn new(local: &'a Local) -> Self {
        Self {
            limits: local.limits(),
            turn_on: local.turn_on(),
            local,
            scratch: MotionScratch::default(),
            tried: 0,
            is_fine: false,
        }
    }

    /// The same space, which checks every motion as finely as a path that is returned.
    pub fn finely(local: &'a Local) -> Self {
        Self { is_fine: true, ..Self::new(local) }
    }

    /// The least and the greatest value of each coordinate.
    pub fn limits(&self) -> &[[f64; 2]] {
        &self.limits
    }

    /// The next sample within the limits.
    pub fn sample(&self, draw: &mut Draw) -> Vec<f64> {
        self.settled(draw.next(&self.limits))
    }

    /// A computed configuration as planners may use it: in the plane, the nearest point of the raster.
    pub fn settled(&self, config: Vec<f64>) -> Vec<f64> {
        self.local.settled(config)
    }

    /// Which coordinates are angles of joints that turn without end.
    pub fn turn_on(&self) -> &[bool] {
        &self.turn_on
    }

    /// How many motions were checked.
    pub fn motions(&self) -> u64 {
        self.tried
    }

    /// How many configurations were checked for contact.
    pub fn checked(&self) -> u64 {
        self.scratch.checked()
    }

    /// How far each coordinate goes, with a sign.
    pub fn change(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        let change = |((a, b), turns_on): ((&f64, &f64), &bool)| {
            if *turns_on { libm::remainder(b - a, TAU) } else { b - a }
        };
        from.iter().zip(to).zip(&self.turn_on).map(change).collect()
    }

    /// How far two configurations are apart.
    pub fn distance(&self, from: &[f64], to: &[f64]) -> f64 {
        self.change(from, to).iter().map(|by| by * by).sum::<f64>().sqrt()
    }

    /// The length of a path.
    pub fn length(&self, path: &[Vec<f64>]) -> f64 {
        path.windows(2).fold(0.0, |length, leg| length + self.distance(&leg[0], &leg[1]))
    }

    /// The configuration at a share of the way.
    pub fn between(&self, from: &[f64], to: &[f64], share: f64) -> Vec<f64> {
        self.settled(from.iter().zip(self.change(from, to)).map(|(a, by)| a + by * share).collect())
    }

    /// `to`, or the point at distance `range` on the way to it if `to` is farther.
    pub fn toward(&self, from: &[f64], to: &[f64], range: f64) -> Vec<f64> {
        let distance = self.distance(from, to);
        if distance < range { to.to_vec() } else { self.between(from, to, range / distance) }
    }

    /// Whether a motion passes the configuration in the middle of its ends.
    pub fn pass_middles(&self) -> bool {
        matches!(self.local, Local::Joints(_))
    }

    /// Whether the straight motion from a free configuration to another is free.
    pub fn goes(&mut self, from: &[f64], to: &[f64]) -> bool {
        self.tried += 1;
        self.local.goes([from, to], self.is_fine, &mut self.scratch)
    }

    /// The first leg of a path that a finer check refuses. A contact between two checked configurations may be missed,
    /// so every path is checked again before it is returned.
    pub fn refused_leg(&mut self, path: &[Vec<f64>]) -> Option<usize> {
        path.windows(2).position(|leg| !self.local.goes([&leg[0], &leg[1]], true, &mut self.scratch))
    }
}
