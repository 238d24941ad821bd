//! Looks for the pairs of lattice points that have printed lengths in all cases, under every variant asked for.

use super::{Entry, Task};
use crate::grid::Moves;
use crate::planner::{Exhibit, Value};
use crate::search::ScaledOctile;
use crate::space::{ArmRules, TipLattice};
use crate::study::checked::Study;
use crate::study::endpoints::{self, Case, FreeShapes, NeverLowered, Pair, ShapeChoice, Variant};
use crate::study::record::{Batch, Kept, Row, Status, Values};
use crate::study::runner::Unit;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "identify_endpoints",
    about: "which pairs of lattice points have the printed lengths in all cases, by exact single-source searches",
    revision: 2,
    columns: &["start_x_cm", "start_y_cm", "goal_x_cm", "goal_y_cm", "pairs", "pairs_on_fives", "candidates"],
    build: |settings| {
        let read: Identify = settings.read()?;
        if read.cases.is_empty() || read.variants.is_empty() {
            return Err(settings.error("at least one case and one variant are needed"));
        }
        if let Some(case) = read.cases.iter().find(|case| case.target() < ScaledOctile::STRAIGHT) {
            return Err(
                settings.error(format!("hops is {:?}; a length of at least one hop is needed", case.hops))
            );
        }
        if let Some(fault) = read.variants.iter().find_map(Variant::fault) {
            return Err(settings.error(fault));
        }
        Ok(Box::new(read))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Identify {
    /// Obstacles and printed length of each case.
    cases: Vec<Case>,
    /// What is varied.
    variants: Vec<Variant>,
    /// How far below the printed length a shortest path may be where A* never lowers open nodes, in steps.
    excess_steps: f64,
}

/// What one variant gave: start and goal of each pair, `[x, y, x, y]`.
struct Found {
    points: Vec<[f64; 4]>,
    candidates: Option<usize>,
}

impl Task for Identify {
    fn run(&self, study: &Study, unit: &Unit<'_>) -> Batch {
        let mut batch = Batch::default();
        let prepared = unit.family.prepare(unit.seed);
        batch.prepared.push(super::prepared_row(unit, prepared.as_ref()));
        let world = prepared.as_ref().ok().and_then(|prepared| prepared.world.as_arm());
        let keeps = unit.is_kept(study, None, 0);
        for variant in &self.variants {
            let found = match world {
                Some(world) => self.find(world.rules(), variant),
                None => Err("this task needs the workspace of an arm".to_owned()),
            };
            match found {
                Ok(found) => {
                    if keeps {
                        let of = super::variant_name(unit, &variant.label);
                        let values = found.points.concat();
                        batch.kept.push(Kept {
                            of,
                            exhibit: Exhibit { name: "pairs".to_owned(), width: 4, values },
                        });
                    }
                    batch.rows.extend(rows(unit, variant, &found));
                }
                Err(reason) => {
                    let mut row = super::variant_row(unit, &variant.label, "");
                    (row.status, row.reason) = (Status::InvalidProblem, Some(reason));
                    batch.rows.push(row);
                }
            }
        }
        batch
    }
}

impl Identify {
    fn find(&self, base: &ArmRules, variant: &Variant) -> Result<Found, String> {
        let shape = match variant.shape {
            ShapeChoice::Free(_) => {
                let FreeShapes { pairs, candidates } = FreeShapes::find(variant, base, &self.cases)?;
                return Ok(Found { points: points(&base.lattice, &pairs), candidates: Some(candidates) });
            }
            ShapeChoice::Uniform(shape) => shape,
        };
        let moves = |case: &Case| Ok(variant.world(base, case, shape)?.eight_moves());
        let moves = self.cases.iter().map(moves).collect::<Result<Vec<Moves>, String>>()?;
        let (pairs, candidates) = match variant.never_lowered() {
            Some(ties) => {
                let found = NeverLowered::find(&moves, &self.cases, self.excess_steps, ties);
                (found.pairs, Some(found.candidates))
            }
            None => (endpoints::pairs(&moves, &self.cases), None),
        };
        Ok(Found { points: points(&base.lattice, &pairs), candidates })
    }
}

/// Start and goal of each pair, `[x, y, x, y]`.
fn points(lattice: &TipLattice, pairs: &[Pair]) -> Vec<[f64; 4]> {
    let both = |[start, goal]: &Pair| {
        let (start, goal) = (lattice.point(*start), lattice.point(*goal));
        [start.x, start.y, goal.x, goal.y]
    };
    pairs.iter().map(both).collect()
}

/// One row for the variant with its counts, then one a pair; without pairs the first says so.
fn rows(unit: &Unit<'_>, variant: &Variant, found: &Found) -> Vec<Row> {
    let on_fives = found.points.iter().filter(|pair| pair.iter().all(|value| value % 5.0 == 0.0)).count();
    let mut head = super::variant_row(unit, &variant.label, "");
    head.status = Status::Solved;
    head.values = Values::from([
        ("pairs".to_owned(), Value::Count(found.points.len() as u64)),
        ("pairs_on_fives".to_owned(), Value::Count(on_fives as u64)),
    ]);
    if let Some(candidates) = found.candidates {
        head.values.insert("candidates".to_owned(), Value::Count(candidates as u64));
    }
    if found.points.is_empty() {
        let reason = "no pair of free points has the printed lengths in all cases".to_owned();
        (head.status, head.reason) = (Status::NoPath, Some(reason));
    }
    let columns = ["start_x_cm", "start_y_cm", "goal_x_cm", "goal_y_cm"];
    let pair_row = |(index, pair): (usize, &[f64; 4])| {
        let mut row = super::variant_row(unit, &variant.label, &format!("pair-{index}"));
        row.status = Status::Solved;
        row.repeat = index as u32 + 1;
        row.values = columns
            .into_iter()
            .zip(pair)
            .map(|(name, value)| (name.to_owned(), Value::Real(*value)))
            .collect();
        row
    };
    std::iter::once(head).chain(found.points.iter().enumerate().map(pair_row)).collect()
}
