//! How often the printed distance of a segment and a polyhedron is wrong, on random segments beside each obstacle.
//!
//! One row an instance: the counts of that instance's samples. A sample is separated if the exact distance is above 0. It is
//! overestimated if the printed distance is longer by more than a millionth of the obstacle's extent. A
//! collision is missed if the printed distance is not 0. The clamped formula for two segments is compared with the
//! exact one on pairs of segments of the same samples. So is the same formula to the letter, with s and t as eqs. 11 and 12 name
//! them and the ends as the text after eq. 18 takes them. `overestimated_listed` has the diagonals that the text lists, not all;
//! `overestimated_listed_first` has the first list of the text, which leaves out the face's closing edge too.
//! A rod within the repulsive potential's range (eq. 21) moves a little along the force that eqs. 23 and 24 print; `pushed_uphill`
//! counts where the potential does not fall.

use super::{Entry, Task};
use crate::record::{Batch, Status, Values};
use crate::unit::Unit;
use base::seed::{self, Stream};
use base::settings::{Accepted, Settings};
use engine::geometry::{
    Convex, Nearest, Segment, Vec3, distance_segment_convex, distance_segment_segment,
    nearest_segment_convex, nearest_segment_convex_listed, nearest_segment_convex_listed_first,
    nearest_segment_convex_printed, nearest_segment_segment_literal, nearest_segment_segment_printed,
};
use engine::planner::Value;
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "formula_error",
    about: "how often the printed distance of a segment and a polyhedron is wrong, on random segments",
    revision: 4,
    columns: &[
        "separated",
        "overestimated",
        "colliding",
        "missed",
        "overestimated_listed",
        "overestimated_listed_first",
        "segment_pairs",
        "segment_pairs_wrong",
        "segment_pairs_wrong_literal",
        "largest_excess_cm",
        "pushed",
        "pushed_uphill",
    ],
    settings: Accepted::shape::<FormulaError>(),
    example: "
samples = 500
reach = 0.5
range_cm = 5.0
",
    build: |settings: &Settings| {
        let read: FormulaError = settings.read()?;
        Ok(Box::new(read))
    },
};

/// Distances that differ by less than this share of the obstacle's extent are the same.
const SAME: f64 = 1e-6;

/// How far a rod moves along the force, as a share of its distance.
const SHIFT: f64 = 1e-3;

/// What stands in a contender's place.
const LABEL: &str = "Printed distance";

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct FormulaError {
    /// Segments drawn beside each obstacle.
    #[schemars(range(min = 1, max = 10_000_000))]
    samples: u32,
    /// Their ends lie in the box about the obstacle, grown by this share of its extent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    reach: f64,
    /// The range of the repulsive potential, its d0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    range_cm: f64,
}

#[derive(Default)]
struct Counted {
    separated: u64,
    overestimated: u64,
    colliding: u64,
    missed: u64,
    overestimated_listed: u64,
    overestimated_listed_first: u64,
    pairs: u64,
    pairs_wrong: u64,
    pairs_wrong_literal: u64,
    largest_excess: f64,
    pushed: u64,
    pushed_uphill: u64,
}

/// Eq. 21 with a gain of 1.
fn potential(d: f64, range: f64) -> f64 {
    if d > range { 0.0 } else { 0.5 * (1.0 / d - 1.0 / range).powi(2) }
}

/// Eq. 24 with a gain of 1, for a rod that moves as a whole: the distance changes along the line between the nearest points.
fn force(nearest: &Nearest, range: f64) -> Vec3 {
    let d = nearest.distance;
    (nearest.on_a - nearest.on_b) / d * (1.0 / range - 1.0 / d) / (d * d)
}

impl Counted {
    /// How the potential changes along the printed force on a rod that is off the obstacle.
    fn push(&mut self, segment: &Segment, convex: &Convex, range: f64) {
        let nearest = nearest_segment_convex(segment, convex);
        let step = force(&nearest, range).normalize() * (SHIFT * nearest.distance);
        let moved = distance_segment_convex(&Segment::new(segment.a + step, segment.b + step), convex);
        self.pushed += 1;
        self.pushed_uphill += u64::from(potential(moved, range) >= potential(nearest.distance, range));
    }

    fn add(&mut self, segment: &Segment, other: &Segment, convex: &Convex, range: f64) {
        let extent = (convex.aabb().max - convex.aabb().min).norm();
        let truth = distance_segment_convex(segment, convex);
        let printed = nearest_segment_convex_printed(segment, convex).distance;
        if truth > 0.0 {
            self.separated += 1;
            self.overestimated += u64::from(printed > truth + SAME * extent);
            let listed = nearest_segment_convex_listed(segment, convex).distance;
            self.overestimated_listed += u64::from(listed > truth + SAME * extent);
            let first = nearest_segment_convex_listed_first(segment, convex).distance;
            self.overestimated_listed_first += u64::from(first > truth + SAME * extent);
            self.largest_excess = self.largest_excess.max(printed - truth);
            if truth < range {
                self.push(segment, convex, range);
            }
        } else {
            self.colliding += 1;
            self.missed += u64::from(printed > 0.0);
        }
        let truth = distance_segment_segment(segment, other);
        let printed = nearest_segment_segment_printed(segment, other).distance;
        self.pairs += 1;
        self.pairs_wrong += u64::from((printed - truth).abs() > SAME * extent);
        let literal = nearest_segment_segment_literal(segment, other).distance;
        self.pairs_wrong_literal += u64::from((literal - truth).abs() > SAME * extent);
    }

    fn values(&self) -> Values {
        let counts = [
            ("separated", self.separated),
            ("overestimated", self.overestimated),
            ("colliding", self.colliding),
            ("missed", self.missed),
            ("overestimated_listed", self.overestimated_listed),
            ("overestimated_listed_first", self.overestimated_listed_first),
            ("segment_pairs", self.pairs),
            ("segment_pairs_wrong", self.pairs_wrong),
            ("segment_pairs_wrong_literal", self.pairs_wrong_literal),
            ("pushed", self.pushed),
            ("pushed_uphill", self.pushed_uphill),
        ];
        let counts = counts.into_iter().map(|(name, count)| (name, Value::Count(count)));
        counts.chain([("largest_excess_cm", Value::Real(self.largest_excess))]).collect()
    }
}

impl FormulaError {
    fn segment(&self, stream: &mut Stream, convex: &Convex) -> Segment {
        let (low, high) = (convex.aabb().min, convex.aabb().max);
        let margin = (high - low) * self.reach;
        let mut end = || Vec3::from_fn(|i, _| stream.random_range(low[i] - margin[i]..=high[i] + margin[i]));
        Segment::new(end(), end())
    }
}

impl Task for FormulaError {
    fn labels(&self) -> Vec<String> {
        vec![LABEL.to_owned()]
    }

    fn run(&self, unit: &Unit<'_>) -> Batch {
        let mut row = super::labelled_row(unit, LABEL);
        let preprocessing = unit.family.prepare(unit.seed);
        // Stored units are found by the inputs of their preprocessing: without this row every run would measure anew.
        let preprocessing_row = super::preprocessing_row(unit, preprocessing.as_ref());
        match preprocessing {
            Err(invalid) => (row.status, row.reason) = (Status::InvalidProblem, Some(invalid.0)),
            Ok(preprocessing) => match preprocessing.world.as_polyhedra() {
                None => {
                    let reason = "the task measures polyhedra, and this world has none".to_owned();
                    (row.status, row.reason) = (Status::InvalidProblem, Some(reason));
                }
                Some(world) => {
                    let mut stream = seed::stream(seed::derive(unit.seed, &["segments"]));
                    let mut counted = Counted::default();
                    for convex in world.bodies() {
                        for _ in 0..self.samples {
                            let [one, other] = [0; 2].map(|_| self.segment(&mut stream, convex));
                            counted.add(&one, &other, convex, self.range_cm);
                        }
                    }
                    (row.status, row.values) = (Status::Solved, counted.values());
                }
            },
        }
        Batch { preprocessing: vec![preprocessing_row], rows: vec![row], kept: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_force_is_the_gradient_of_the_potential_and_rods_move_uphill_along_it() {
        let solid = Convex::cuboid(Vec3::zeros(), Vec3::repeat(10.0)).unwrap();
        let rod = |height: f64| {
            let [a, b] = [-3.0, 4.0].map(|x| Vec3::new(x, 1.0, 5.0 + height));
            Segment::new(a, b)
        };
        let mut counted = Counted::default();
        for height in [0.1, 0.5, 2.0, 4.9] {
            let along = force(&nearest_segment_convex(&rod(height), &solid), 5.0);
            let slope = (potential(height + 1e-6, 5.0) - potential(height - 1e-6, 5.0)) / 2e-6;
            let gradient = Vec3::new(0.0, 0.0, slope);
            assert!((along - gradient).norm() < 1e-6 * slope.abs(), "{height}: {along} against {gradient}");
            counted.push(&rod(height), &solid, 5.0);
        }
        assert_eq!([counted.pushed, counted.pushed_uphill], [4, 4]);
    }
}
