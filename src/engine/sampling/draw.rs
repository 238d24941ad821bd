//! Where samples come from.

use base::seed::{self, Stream};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::TAU;

/// The bases of the Halton sequence, an axis each: VAMP's, which leaves out 2.
const BASES: [u32; 16] = [3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59];

/// Where samples come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DrawSetting {
    /// The Halton sequence in the bases 3, 5, 7, ..., from its first point at every query.
    Halton,
    /// Even random numbers from the trial's seed.
    Seeded,
}

/// A source of samples.
#[derive(Debug, Clone)]
pub struct Draw {
    stream: Stream,
    /// The number of the last point of the sequence; none if samples are random.
    halton: Option<u32>,
}

/// The digits of `index` in `base`, mirrored at the point.
fn radical_inverse(mut index: u32, base: u32) -> f64 {
    let mut value = 0.0;
    let mut unit = 1.0;
    while index > 0 {
        unit /= f64::from(base);
        value += unit * f64::from(index % base);
        index /= base;
    }
    value
}

impl Draw {
    /// The source of a trial.
    pub fn new(setting: DrawSetting, seed: u64) -> Self {
        Self { stream: seed::stream(seed), halton: (setting == DrawSetting::Halton).then_some(0) }
    }

    /// The next sample within limits; beyond sixteen coordinates all are random.
    ///
    /// # Source
    /// Halton, *Numerische Mathematik* 2 (1960), 84.
    pub fn next(&mut self, limits: &[[f64; 2]]) -> Vec<f64> {
        if let Some(index) = &mut self.halton {
            *index = index.wrapping_add(1);
        }
        let share = |(axis, [low, high]): (usize, &[f64; 2])| {
            let share = match (self.halton, BASES.get(axis)) {
                (Some(index), Some(base)) => radical_inverse(index, *base),
                _ => self.stream.random::<f64>(),
            };
            low + (high - low) * share
        };
        limits.iter().enumerate().map(share).collect()
    }

    /// A random share, from 0 to 1.
    pub fn share(&mut self) -> f64 {
        self.stream.random::<f64>()
    }

    /// A random whole number in a range, both ends included.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        self.stream.random_range(low..=high)
    }

    /// A random point evenly from the ball of radius 1 about the origin.
    pub fn in_ball(&mut self, axes: usize) -> Vec<f64> {
        let gauss = |draw: &mut Self| {
            let radius = (-2.0 * libm::log(1.0 - draw.share())).sqrt();
            radius * libm::cos(TAU * draw.share())
        };
        let direction: Vec<f64> = (0..axes).map(|_| gauss(self)).collect();
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let radius = libm::pow(self.share(), 1.0 / axes as f64);
        direction.iter().map(|x| x / length * radius).collect()
    }
}
