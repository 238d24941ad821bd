//! The lattice of points at which the tip may stand.

use crate::geometry::Vec2;
use base::grid::Grid2;
use base::text::written;
use std::fmt;

/// How far a coordinate may be from a lattice point, in steps, and still be meant as it.
const SLACK: f64 = 1e-9;

/// The most points of a lattice: every one of them is analysed before anything is planned.
const MAX_POINTS: u64 = 1_000_000;

/// Points `low + step · (column, row)` that fill a rectangle, both rims included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipLattice {
    low_cm: [f64; 2],
    step_cm: f64,
    size: [u32; 2],
}

impl TipLattice {
    /// The lattice of step `step_cm` that fills the ranges `x_cm` and `y_cm`.
    ///
    /// # Errors
    /// The parameter at fault and a sentence if the step is not positive, a range is empty, the step does not divide it, or there are too
    /// many points.
    pub fn new(x_cm: [f64; 2], y_cm: [f64; 2], step_cm: f64) -> Result<Self, (&'static str, String)> {
        if !(step_cm.is_finite() && step_cm > 0.0) {
            return Err(("step_cm", format!("step_cm is {step_cm}; a step above 0 is accepted")));
        }
        let side = |name: &'static str, [low, high]: [f64; 2]| {
            let steps = (high - low) / step_cm;
            if !(steps.is_finite() && steps > 0.0) {
                let message =
                    format!("{name} runs from {low} to {high}; two rising finite numbers are accepted");
                return Err((name, message));
            }
            // So many that a step's own digits say nothing of whether it divides the side.
            if steps > MAX_POINTS as f64 {
                let message = format!(
                    "step_cm is {}, which makes {:.1e} points along {name} alone; at most {MAX_POINTS} in all are accepted",
                    written(&step_cm),
                    steps.round()
                );
                return Err(("step_cm", message));
            }
            if (steps - steps.round()).abs() > SLACK * steps.max(1.0) {
                let message = format!(
                    "step_cm is {step_cm}, which does not divide {name} of {} cm; a whole number of steps is accepted",
                    high - low
                );
                return Err(("step_cm", message));
            }
            Ok(steps.round() as u32 + 1)
        };
        let size = [side("x_cm", x_cm)?, side("y_cm", y_cm)?];
        let points = u64::from(size[0]) * u64::from(size[1]);
        if points > MAX_POINTS {
            let message = format!(
                "step_cm is {}, which makes {} × {} points; at most {MAX_POINTS} in all are accepted",
                written(&step_cm),
                size[0],
                size[1]
            );
            return Err(("step_cm", message));
        }
        Grid2::new(size[0], size[1]).map_err(|e| ("step_cm", e.to_string()))?;
        Ok(Self { low_cm: [x_cm[0], y_cm[0]], step_cm, size })
    }

    /// How far apart points are.
    pub fn step_cm(&self) -> f64 {
        self.step_cm
    }

    /// The lower left point.
    pub fn low_cm(&self) -> [f64; 2] {
        self.low_cm
    }

    /// How many columns and rows there are.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// A grid of this size, all of it free.
    pub fn grid(&self) -> Grid2 {
        Grid2::new(self.size[0], self.size[1]).expect("the size was checked when the lattice was made")
    }

    /// The point of `cell`, row-major from the lower left.
    pub fn point(&self, cell: u32) -> Vec2 {
        let [column, row] = [cell % self.size[0], cell / self.size[0]].map(f64::from);
        Vec2::new(self.low_cm[0] + self.step_cm * column, self.low_cm[1] + self.step_cm * row)
    }

    /// The cell at `point` = [x, y], if it is one of the lattice's points.
    pub fn cell(&self, point: &[f64]) -> Option<u32> {
        let [x, y] = *point else { return None };
        let index = |value: f64, axis: usize| {
            let steps = (value - self.low_cm[axis]) / self.step_cm;
            let is_near = (steps - steps.round()).abs() <= SLACK;
            let is_inside = (0.0..f64::from(self.size[axis])).contains(&steps.round());
            (is_near && is_inside).then_some(steps.round() as u32)
        };
        Some(index(y, 1)? * self.size[0] + index(x, 0)?)
    }
}

impl fmt::Display for TipLattice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let high = [0, 1].map(|axis| self.low_cm[axis] + self.step_cm * f64::from(self.size[axis] - 1));
        let ([x0, y0], [x1, y1]) = (self.low_cm, high);
        write!(f, "its points are x {x0} to {x1} and y {y0} to {y1} in steps of {} cm", self.step_cm)
    }
}
