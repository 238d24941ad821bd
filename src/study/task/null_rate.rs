//! How often lengths that were not printed would have been met by some pair of lattice points just as well.

use super::{Entry, Task};
use crate::planner::Value;
use crate::seed;
use crate::space::{ArmRules, ArmWorld};
use crate::study::checked::Study;
use crate::study::endpoints::{Case, NeverLowered, ShapeChoice, Targets, Variant, drawn_moves};
use crate::study::record::{Batch, Row, Status, Values};
use crate::study::runner::Unit;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "null_rate",
    about: "the share of targets of equal parity near two printed lengths that some pair of points meets",
    revision: 4,
    columns: &["targets", "targets_hit", "hit_share_percent"],
    build: |settings| {
        let read: NullRate = settings.read()?;
        if !(read.window_cm > 0.0 && read.window_cm < 50.0) {
            let message = format!("window_cm is {}; above 0 and below 50 is accepted", read.window_cm);
            return Err(settings.error(message));
        }
        if let Some(fault) = read.variants.iter().find_map(Variant::fault) {
            return Err(settings.error(fault));
        }
        let never = read.variants.iter().find(|variant| variant.never_lowered().is_some());
        match (never, read.excess_steps) {
            (Some(variant), None) => {
                let message =
                    format!("variant `{}` never lowers open nodes; excess_steps is needed", variant.label);
                return Err(settings.error(message));
            }
            (_, Some(excess)) if !(0.0..50.0).contains(&excess) => {
                let message = format!("excess_steps is {excess}; 0 and more, below 50, is accepted");
                return Err(settings.error(message));
            }
            _ => {}
        }
        let free = read.variants.iter().find(|variant| matches!(variant.shape, ShapeChoice::Free(_)));
        if let Some(variant) = free.filter(|_| read.shape_choices == 0) {
            let message =
                format!("variant `{}` leaves shapes open; shape_choices above 0 are needed", variant.label);
            return Err(settings.error(message));
        }
        Ok(Box::new(read))
    },
};

/// The label of the row over all variants.
const ANY: &str = "any of the above";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NullRate {
    /// Obstacles and printed length of both cases.
    cases: [Case; 2],
    /// What is varied.
    variants: Vec<Variant>,
    /// How far from the printed length a target may be.
    window_cm: f64,
    /// How far below a target a shortest path may be where A* never lowers open nodes, in steps.
    excess_steps: Option<f64>,
    /// Where each obstacle may have a shape of its own: how many choices are drawn; a target counts that any of them meets.
    #[serde(default)]
    shape_choices: u32,
}

impl Task for NullRate {
    fn run(&self, _study: &Study, unit: &Unit<'_>) -> Batch {
        let mut batch = Batch::default();
        let prepared = unit.family.prepare(unit.seed);
        batch.prepared.push(super::prepared_row(unit, prepared.as_ref()));
        let Some(base) = prepared.ok().and_then(|prepared| prepared.world.as_arm().map(|arm| *arm.rules()))
        else {
            return batch;
        };
        let targets = Targets::new(&self.cases, self.window_cm / base.lattice.step_cm());
        let mut any: Vec<bool> = Vec::new();
        for variant in &self.variants {
            match self.hits(&targets, &base, variant, unit.seed) {
                Ok(hits) => {
                    batch.rows.push(row(unit, &variant.label, &targets, &hits));
                    any.resize(hits.len(), false);
                    any.iter_mut().zip(hits).for_each(|(any, hit)| *any |= hit);
                }
                Err(reason) => {
                    let mut row = super::variant_row(unit, &variant.label, "");
                    (row.status, row.reason) = (Status::InvalidProblem, Some(reason));
                    batch.rows.push(row);
                }
            }
        }
        batch.rows.push(row(unit, ANY, &targets, &any));
        batch
    }
}

impl NullRate {
    fn hits(
        &self,
        targets: &Targets,
        base: &ArmRules,
        variant: &Variant,
        seed: u64,
    ) -> Result<Vec<bool>, String> {
        if let ShapeChoice::Uniform(shape) = variant.shape {
            let [one, two] = self.cases.each_ref().map(|case| variant.world(base, case, shape));
            let moves = [one?, two?].each_ref().map(ArmWorld::eight_moves);
            return Ok(match (variant.never_lowered(), self.excess_steps) {
                (Some(ties), Some(excess)) => NeverLowered::hits(targets, &moves, excess, ties),
                _ => targets.hits(&moves),
            });
        }
        let mut hits: Vec<bool> = Vec::new();
        for choice in 0..self.shape_choices {
            let names = ["shapes", &variant.label, &choice.to_string()];
            let moves =
                drawn_moves(variant, base, &self.cases, &mut seed::stream(seed::derive(seed, &names)))?;
            let found = targets.hits(&moves);
            hits.resize(found.len(), false);
            hits.iter_mut().zip(found).for_each(|(hit, found)| *hit |= found);
        }
        Ok(hits)
    }
}

fn row(unit: &Unit<'_>, label: &str, targets: &Targets, hits: &[bool]) -> Row {
    let mut row = super::variant_row(unit, label, "");
    let (count, hit) = (targets.count(), hits.iter().filter(|hit| **hit).count());
    row.status = Status::Solved;
    row.values = Values::from([
        ("targets".to_owned(), Value::Count(count as u64)),
        ("targets_hit".to_owned(), Value::Count(hit as u64)),
        ("hit_share_percent".to_owned(), Value::Real(100.0 * hit as f64 / count as f64)),
    ]);
    row
}
