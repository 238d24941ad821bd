//! How often lengths that were not printed would have been met by some pair of lattice points just as well.

use super::{Entry, Task};
use crate::endpoint_variants::{self as endpoints, Case, Question, Variant};
use crate::name::slug;
use crate::record::{Batch, Row, Status, Values};
use crate::unit::Unit;
use base::grid::Moves;
use base::settings::Accepted;
use engine::length_inversion::{Match, Met, NeverLowered, Targets, union};
use engine::planner::Value;
use engine::search::Ties;
use engine::space::ArmRules;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "null_rate",
    about: "the share of targets of equal parity near two printed lengths that some pair of points meets",
    revision: 6,
    columns: &[
        "targets",
        "targets_hit",
        "hit_share_percent",
        "targets_attainable",
        "attainable_hit_share_percent",
    ],
    settings: Accepted::shape::<NullRate>(),
    example: r#"
window_cm = 5.0
excess_steps = 3.0
cases = [
    { obstacles_cm = [[25, 20], [-10, 30]], hops = [12, 20] },
    { obstacles_cm = [[30, 10], [0, 40]], hops = [16, 9] },
]
variants = [
    { label = "circles", shape = "circle", diameter_cm = 8 },
    { label = "squares", shape = "square", diameter_cm = 8 },
]
"#,
    build: |settings| {
        let read: NullRate = settings.read()?;
        if !(read.window_cm > 0.0 && read.window_cm < 50.0) {
            let message = format!("window_cm is {}; above 0 and below 50 is accepted", read.window_cm);
            return Err(settings.error_at("window_cm", message));
        }
        if let Some((key, message)) = read.fault() {
            return Err(settings.error_at(&key, message));
        }
        Ok(Box::new(read))
    },
};

/// The label of the row over all variants.
const ANY: &str = "any of the above";

#[derive(Deserialize, JsonSchema)]
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
}

impl NullRate {
    /// The key at fault and what is wrong with it, if anything.
    fn fault(&self) -> Option<(String, String)> {
        if let Some(fault) = endpoints::fault(&self.cases, &self.variants) {
            return Some(fault);
        }
        if let Some(index) = self.variants.iter().position(|variant| slug(&variant.label) == slug(ANY)) {
            let label = &self.variants[index].label;
            let message = format!("variant `{label}` has the name of the row over all variants");
            return Some((format!("variants.{index}.label"), message));
        }
        let never = self.variants.iter().position(|variant| variant.never_lowered().is_some());
        match (never, self.excess_steps) {
            (Some(index), None) => {
                let label = &self.variants[index].label;
                let message = format!("variant `{label}` never lowers open nodes; excess_steps is needed");
                Some((format!("variants.{index}.open_node"), message))
            }
            (_, excess) => excess.and_then(endpoints::fault_of_excess),
        }
    }
}

/// What a variant meets.
struct Hits {
    hits: Vec<bool>,
    /// Not known where only some pairs are tried.
    attainable: Option<Vec<bool>>,
}

/// The settings with what they ask of grids.
struct NullRateQuestion<'a> {
    null: &'a NullRate,
    targets: Targets,
}

impl Question for NullRateQuestion<'_> {
    /// Which targets are met, by number, and which are attainable where that is known.
    type Answer = Hits;

    fn shortest(&self, cases: &[Vec<Moves>], rule: Match) -> Vec<Hits> {
        let cases = cases.first_chunk().expect("there are two cases");
        let met = self.targets.met(cases, rule).into_iter();
        met.map(|Met { hits, attainable }| Hits { hits, attainable: Some(attainable) }).collect()
    }

    fn never_lowered(&self, cases: &[Moves], ties: &[Ties]) -> Vec<Hits> {
        let cases = cases.first_chunk().expect("there are two cases");
        let excess = self.null.excess_steps.expect("a study without it has no such variant");
        let hits = NeverLowered::hits(&self.targets, cases, excess, ties).into_iter();
        hits.map(|hits| Hits { hits, attainable: None }).collect()
    }
}

impl Task for NullRate {
    fn labels(&self) -> Vec<String> {
        let labels = self.variants.iter().map(|variant| variant.label.as_str()).chain([ANY]);
        labels.map(str::to_owned).collect()
    }

    fn run(&self, unit: &Unit<'_>) -> Batch {
        let mut batch = Batch::default();
        let preprocessing = unit.family.prepare(unit.seed);
        batch.preprocessing.push(super::preprocessing_row(unit, preprocessing.as_ref()));
        // The last row is over all variants, so that it takes every one of them.
        let wants_any = super::is_variant_wanted(unit, ANY);
        let is_wanted = |label: &str| wants_any || super::is_variant_wanted(unit, label);
        let variants: Vec<&Variant> = self.variants.iter().filter(|of| is_wanted(&of.label)).collect();
        let labels = variants.iter().map(|variant| variant.label.as_str()).chain(wants_any.then_some(ANY));
        let asked =
            super::arm_rules(preprocessing.as_ref()).and_then(|base| Ok((base, self.question(&base)?)));
        batch.rows = match asked {
            Ok((base, asked)) => self.rows(unit, &base, &asked, &variants, wants_any),
            Err(reason) => labels.map(|label| super::invalid_variant(unit, label, &reason)).collect(),
        };
        batch
    }
}

impl NullRate {
    /// What is asked of grids on the lattice of `base`.
    fn question(&self, base: &ArmRules) -> Result<NullRateQuestion<'_>, String> {
        let lengths = self.cases.each_ref().map(Case::length);
        let targets = Targets::new(lengths, self.window_cm / base.lattice.step_cm());
        if targets.count() == 0 {
            let window = self.window_cm;
            return Err(format!("no two lengths within {window} cm of the printed ones have equal parity"));
        }
        Ok(NullRateQuestion { null: self, targets })
    }

    fn rows(
        &self,
        unit: &Unit<'_>,
        base: &ArmRules,
        asked: &NullRateQuestion<'_>,
        variants: &[&Variant],
        wants_any: bool,
    ) -> Vec<Row> {
        let none = || asked.targets.none();
        let mut any: Result<[Vec<bool>; 2], String> = Ok([none(), none()]);
        let mut rows = Vec::new();
        for (variant, answer) in variants.iter().zip(endpoints::answers(asked, base, &self.cases, variants)) {
            let label = &variant.label;
            rows.push(match &answer {
                Ok(hits) => row(unit, label, &asked.targets, hits),
                Err(reason) => super::invalid_variant(unit, label, reason),
            });
            any = any.and_then(|[hits, attainable]| {
                let answer = answer?;
                let more = answer.attainable.unwrap_or_else(none);
                Ok([union(hits, answer.hits), union(attainable, more)])
            });
        }
        if wants_any {
            rows.push(match any {
                Ok([hits, attainable]) => {
                    row(unit, ANY, &asked.targets, &Hits { hits, attainable: Some(attainable) })
                }
                Err(reason) => super::invalid_variant(unit, ANY, &reason),
            });
        }
        rows
    }
}

fn row(unit: &Unit<'_>, label: &str, targets: &Targets, met: &Hits) -> Row {
    let mut row = super::variant_row(unit, label);
    let counted = |all: &[bool]| all.iter().filter(|is_set| **is_set).count();
    let count = targets.count();
    let hit = counted(&met.hits);
    row.status = Status::Solved;
    row.values = Values::from_iter([
        ("targets", Value::Count(count as u64)),
        ("targets_hit", Value::Count(hit as u64)),
        ("hit_share_percent", Value::Real(100.0 * hit as f64 / count as f64)),
    ]);
    if let Some(attainable) = &met.attainable {
        // A target that is met has two lengths that are attained; those of an A* that lowers nothing are not among these.
        let hit = met.hits.iter().zip(attainable).filter(|(hit, attainable)| **hit && **attainable).count();
        let count = counted(attainable);
        row.values.extend([("targets_attainable", Value::Count(count as u64))]);
        if count > 0 {
            let share = 100.0 * hit as f64 / count as f64;
            row.values.extend([("attainable_hit_share_percent", Value::Real(share))]);
        }
    }
    row
}
