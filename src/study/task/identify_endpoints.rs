//! Looks for the pairs of lattice points that have printed lengths in all cases, under every variant asked for.

use super::{Entry, Task};
use crate::endpoint_variants::{self as open, Case, Question, ShapeChoice, Variant};
use crate::key::Owner;
use crate::record::{Batch, Kept, Row, Status, Values};
use crate::unit::Unit;
use base::grid::Moves;
use base::settings::Accepted;
use engine::length_inversion::{self, Match, NeverLowered, Pair};
use engine::planner::{Trace, Value};
use engine::search::Ties;
use engine::space::{ArmRules, ArmWorld, TipLattice};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "identify_endpoints",
    about: "which pairs of lattice points have the printed lengths in all cases, by exact single-source searches",
    revision: 4,
    columns: &[
        "start_x_cm",
        "start_y_cm",
        "goal_x_cm",
        "goal_y_cm",
        "pairs",
        "pairs_on_fives",
        "pairs_on_fives_tried",
        "candidates",
    ],
    settings: Accepted::shape::<Identify>(),
    example: r#"
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
        let read: Identify = settings.read()?;
        let fault = open::fault(&read.cases, &read.variants);
        if let Some((key, message)) = fault.or_else(|| open::fault_of_excess(read.excess_steps)) {
            return Err(settings.error_at(&key, message));
        }
        Ok(Box::new(read))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Identify {
    /// Obstacles and printed length of each case.
    cases: Vec<Case>,
    /// What is varied.
    variants: Vec<Variant>,
    /// How far below the printed length a shortest path may be where A* never lowers open nodes, in steps.
    excess_steps: f64,
}

/// What one variant gave.
struct VariantPairs {
    pairs: Vec<Pair>,
    /// How many had to be tried one by one.
    candidates: Option<usize>,
}

impl Question for Identify {
    type Answer = VariantPairs;

    fn shortest(&self, cases: &[Vec<Moves>], rule: Match) -> Vec<VariantPairs> {
        let found = length_inversion::pairs(cases, &self.lengths(), rule);
        found.into_iter().map(|pairs| VariantPairs { pairs, candidates: None }).collect()
    }

    fn never_lowered(&self, cases: &[Moves], ties: &[Ties]) -> Vec<VariantPairs> {
        let found = NeverLowered::find(cases, &self.lengths(), self.excess_steps, ties).into_iter();
        found.map(|found| VariantPairs { pairs: found.pairs, candidates: Some(found.candidates) }).collect()
    }
}

impl Task for Identify {
    fn labels(&self) -> Vec<String> {
        self.variants.iter().map(|variant| variant.label.clone()).collect()
    }

    fn run(&self, unit: &Unit<'_>) -> Batch {
        let mut batch = Batch::default();
        let preprocessing = unit.family.prepare(unit.seed);
        batch.preprocessing.push(super::preprocessing_row(unit, preprocessing.as_ref()));
        let variants: Vec<&Variant> =
            self.variants.iter().filter(|variant| super::is_variant_wanted(unit, &variant.label)).collect();
        let base = match super::arm_rules(preprocessing.as_ref()) {
            Ok(base) => base,
            Err(reason) => {
                let row = |variant: &&Variant| super::invalid_variant(unit, &variant.label, &reason);
                batch.rows.extend(variants.iter().map(row));
                return batch;
            }
        };
        let answers = open::answers(self, &base, &self.cases, &variants);
        let keeps = unit.is_kept(None, 0);
        for (variant, answer) in variants.into_iter().zip(answers) {
            match answer {
                Ok(found) => {
                    let points = points(&base.lattice, &found.pairs);
                    let tried = self.pairs_on_fives(&base, variant);
                    let mut of_variant = rows(unit, variant, &points, found.candidates);
                    let tried = tried.map(|count| ("pairs_on_fives_tried", Value::Count(count)));
                    of_variant[0].values.extend(tried);
                    batch.rows.extend(of_variant);
                    if keeps {
                        let of = Owner::Trial(super::variant_key(unit, &variant.label, 0));
                        let trace = Trace { name: "pairs".to_owned(), width: 4, values: points.concat() };
                        batch.kept.push(Kept { of, trace });
                    }
                }
                Err(reason) => batch.rows.push(super::invalid_variant(unit, &variant.label, &reason)),
            }
        }
        batch
    }
}

impl Identify {
    /// How many pairs of points on multiples of 5 cm are free in all cases; unknown where shapes are left open.
    fn pairs_on_fives(&self, base: &ArmRules, variant: &Variant) -> Option<u64> {
        let ShapeChoice::Uniform(shape) = variant.shape else { return None };
        let worlds: Vec<ArmWorld> =
            self.cases.iter().map(|case| variant.world(base, case, shape).ok()).collect::<Option<_>>()?;
        let cells = 0..worlds.first()?.grid().cell_count();
        let is_round = |cell: &u32| {
            let at: [f64; 2] = base.lattice.point(*cell).into();
            at.iter().all(|value| value % 5.0 == 0.0)
        };
        let is_free = |cell: &u32| worlds.iter().all(|world| world.grid().is_free(*cell));
        let count = cells.filter(|cell| is_round(cell) && is_free(cell)).count() as u64;
        Some(count * count.saturating_sub(1) / 2)
    }

    /// The printed lengths.
    fn lengths(&self) -> Vec<u32> {
        self.cases.iter().map(Case::target).collect()
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
fn rows(unit: &Unit<'_>, variant: &Variant, points: &[[f64; 4]], candidates: Option<usize>) -> Vec<Row> {
    let on_fives = points.iter().filter(|pair| pair.iter().all(|value| value % 5.0 == 0.0)).count();
    let mut head = super::variant_row(unit, &variant.label);
    head.status = Status::Solved;
    head.values = Values::from_iter([
        ("pairs", Value::Count(points.len() as u64)),
        ("pairs_on_fives", Value::Count(on_fives as u64)),
    ]);
    if let Some(candidates) = candidates {
        head.values.extend([("candidates", Value::Count(candidates as u64))]);
    }
    if points.is_empty() {
        let reason = "no pair of free points has the printed lengths in all cases".to_owned();
        (head.status, head.reason) = (Status::NoPath, Some(reason));
    }
    let columns = ["start_x_cm", "start_y_cm", "goal_x_cm", "goal_y_cm"];
    let pair_row = |(index, pair): (usize, &[f64; 4])| {
        let mut row = super::variant_row(unit, &variant.label);
        row.status = Status::Solved;
        row.key.repeat = index as u32 + 1;
        row.values = columns.into_iter().zip(pair).map(|(name, value)| (name, Value::Real(*value))).collect();
        row
    };
    std::iter::once(head).chain(points.iter().enumerate().map(pair_row)).collect()
}
