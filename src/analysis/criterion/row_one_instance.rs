//! Whether a printed row, as a whole, could be that of one more of our instances.

use super::{Criterion, Entry, without};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::Evidence;
use crate::analysis::number::{Ends, Number, parts, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{Case, Instance, Selection};
use crate::analysis::selection_spec::{Labels, SelectionSpec};
use crate::analysis::statistic::InstanceStatistic;
use crate::analysis::verdict::{Estimate, Quantity};
use base::settings::{Accepted, Faults, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::rows::{Level, Place, monotone_probability};
use std::collections::BTreeMap;
use study::key::SweepKey;
use study::sweeps_of;
use toml::Value;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "row_one_instance",
    about: "is a printed row as near to our mean row as our own instances are, in shape and in level?",
    revision: |_| 2,
    question: |settings| {
        without(settings, &["refused_below"]);
        let rows = settings.get_mut("rows").and_then(Value::as_array_mut);
        rows.into_iter().flatten().filter_map(Value::as_table_mut).for_each(|row| without(row, &["claims"]));
        Some("rows of instances 1")
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
refused_below = 0.05
[select]
study = "compare"
problems = "maps"
metric = "opened"
[[rows]]
contender = "Weighted A*"
against = "A*"
statistics = ["mean"]
claims = ["table1.weighted.saving"]
"#,
    build: |context| Ok(Box::new(RowOneInstance::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at: study, problems and metric.
    select: SelectionSpec,
    /// One row, or several that come from one instance and are ranked as one.
    rows: Vec<RowSpec>,
    /// The row is refused if fewer than this share of our instances are as far from the mean row, or if its mean is as far out
    /// on one side: the size of either test.
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0))]
    refused_below: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RowSpec {
    /// The contender, by its label.
    contender: String,
    /// The contender that its savings are against.
    against: Option<String>,
    /// The statistic of each cell; without, the share of solved queries at each point of the study's sweep.
    #[serde(default)]
    statistics: Vec<InstanceStatistic>,
    /// The claim that prints each cell.
    claims: Vec<String>,
}

/// One printed row.
struct Row<'a> {
    selection: Selection<'a>,
    cells: Cells,
}

enum Cells {
    Statistics(Vec<InstanceStatistic>),
    Sweep(Vec<SweepKey>),
}

struct RowOneInstance<'a> {
    rows: Vec<Row<'a>>,
    printed: Vec<f64>,
    refused_below: f64,
}

impl<'a> RowOneInstance<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let mut printed = Vec::new();
        let mut faults = Faults::default();
        let mut read = |(index, row): (usize, &RowSpec)| {
            let contender = Labels::One(row.contender.clone());
            let spec = SelectionSpec { contender, against: row.against.clone(), ..settings.select.clone() };
            let selection = Selection::new(context, &spec)?;
            let (cells, count) = if row.statistics.is_empty() {
                let points = selection.sweep_points();
                let count = points.len();
                (Cells::Sweep(points), count)
            } else {
                selection.metric(context)?;
                (Cells::Statistics(row.statistics.clone()), row.statistics.len())
            };
            if row.claims.len() != count {
                let message = format!("the row has {} claims for {count} cells", row.claims.len());
                let error = context.settings.error_at(&format!("rows.{index}.claims"), message);
                let error = error.about("claims").about("statistics").about("select");
                return Err(error.about(&sweeps_of(&selection.study.name)));
            }
            for id in &row.claims {
                printed.push(context.print_of("rows.claims", id)?.printed.value());
            }
            Ok(Row { selection, cells })
        };
        let rows: Vec<Row<'a>> =
            settings.rows.iter().enumerate().filter_map(|row| faults.keep(read(row))).collect();
        faults.done()?;
        if rows.is_empty() {
            return Err(context.settings.error_at("rows", "at least one row is needed").about("rows"));
        }
        Ok(Self { rows, printed, refused_below: settings.refused_below })
    }
}

/// What was drawn once for every row: a problem group's instance, and the contender's seed.
type Unit<'e> = (&'e str, u32, u32);

impl Row<'_> {
    /// The numbers of all cells of each instance that lacks none.
    fn values<'e>(&self, instances: &[Instance<'e>], unended_solved: bool) -> BTreeMap<Unit<'e>, Vec<f64>> {
        let of_instance = |instance: &Instance<'e>| -> Option<Vec<f64>> {
            match &self.cells {
                Cells::Statistics(statistics) => {
                    statistics.iter().map(|statistic| statistic.value(instance)).collect()
                }
                Cells::Sweep(points) => {
                    let is_hit =
                        |case: &Case<'_>| case.row.is_solved() || unended_solved && case.is_unended();
                    points.iter().map(|point| instance.at(point).percent(is_hit)).collect()
                }
            }
        };
        let unit = |instance: &Instance<'e>| {
            let row = instance.cases.first()?.row;
            Some((instance.group, row.instance(), row.key.repeat))
        };
        instances.iter().filter_map(|instance| Some((unit(instance)?, of_instance(instance)?))).collect()
    }
}

/// On which side the row lies, in words.
fn level_sentence(level: &Level, refused_below: f64) -> String {
    let Level { short: [short, cells], difference, rank, dominating } = level;
    format!(
        "on which side: our mean is below the printed value in {short} of {cells} cells, by {difference:+.1} points on average; \
             the row's mean is at or above that of {} of {} instances (two-sided rank {:.3}, refused below {refused_below}); \
             {dominating} instances are at or above the printed row in every cell",
        rank.below + rank.equal,
        rank.instances(),
        rank.p_two_sided()
    )
}

impl RowOneInstance<'_> {
    /// The numbers of all cells of all rows, one list a cell, of the instances that have them all.
    fn cells(&self, drawn: &[Vec<Instance<'_>>], unended_solved: bool) -> Vec<Vec<f64>> {
        let rows: Vec<BTreeMap<Unit<'_>, Vec<f64>>> = self
            .rows
            .iter()
            .zip(drawn)
            .map(|(row, instances)| row.values(instances, unended_solved))
            .collect();
        let whole = |unit: &Unit<'_>| -> Option<Vec<f64>> {
            let each: Option<Vec<_>> = rows.iter().map(|row| row.get(unit).cloned()).collect();
            each.map(|each| each.concat())
        };
        let units: Vec<Vec<f64>> =
            rows.first().into_iter().flat_map(BTreeMap::keys).filter_map(whole).collect();
        (0..self.printed.len()).map(|cell| units.iter().map(|unit| unit[cell]).collect()).collect()
    }

    /// How many cases without an end could turn the outcome. They are taken as solved, since nothing else is known of them.
    fn censored(&self, numbers: &[Number], (level, outcome): (&Level, Outcome)) -> usize {
        let unended = whole(numbers).unended;
        if unended == 0 {
            return 0;
        }
        let filled = self.placed(&listed(numbers, Ends::Most));
        // A level that passes the row's on the way could be its.
        let is_turned = filled.is_none_or(|(_, other, _, filled)| {
            filled != outcome || (level.difference < 0.0) != (other.difference < 0.0)
        });
        if is_turned { unended } else { 0 }
    }

    /// Where the printed row stands among our instances.
    fn placed(&self, cells: &[Vec<f64>]) -> Option<Placed> {
        placed(&self.printed, cells, self.refused_below)
    }

    /// The first trial of the instance whose first row is nearest to what is printed: one that is refused is far from all of ours.
    fn shown(&self, evidence: &Evidence<'_>, instances: &[Instance<'_>]) -> Option<String> {
        let row = &self.rows[0];
        let apart = |instance: &Instance<'_>| -> Option<f64> {
            let (_, values) = row.values(std::slice::from_ref(instance), false).pop_first()?;
            Some(values.iter().zip(&self.printed).map(|(own, printed)| (own - printed).powi(2)).sum())
        };
        let known = instances.iter().filter_map(|instance| Some((instance, apart(instance)?)));
        let nearest = known.min_by(|a, b| a.1.total_cmp(&b.1));
        row.selection.trial(evidence, nearest.and_then(|(instance, _)| instance.cases.first()))
    }

    /// Fewest instances with which either test can refuse any row: the least two-sided rank is 2 / (n + 1).
    fn fewest(&self) -> usize {
        (2.0 / self.refused_below).floor() as usize
    }

    /// Of a row that prints a least and a greatest value, how many of our instances have all their cases between the two, in words.
    fn inside(&self, cells: &[Vec<f64>]) -> Option<String> {
        let [Row { cells: Cells::Statistics(statistics), .. }] = &self.rows[..] else { return None };
        let ([InstanceStatistic::Least, InstanceStatistic::Greatest], [least, greatest]) =
            (&statistics[..], cells)
        else {
            return None;
        };
        let reaches = |value: &&f64| **value >= self.printed[0];
        let is_inside = |(least, greatest): &(&f64, &f64)| reaches(least) && **greatest <= self.printed[1];
        Some(format!(
            "all cases lie between the printed least and greatest on {} of {} instances; the least reaches the printed one on {}",
            least.iter().zip(greatest).filter(is_inside).count(),
            least.len(),
            least.iter().filter(reaches).count()
        ))
    }

    fn because(&self, place: &Place, level: &Level, rank: f64, cells: &[Vec<f64>]) -> Vec<String> {
        let who = self.rows.iter().map(|row| row.selection.description()).collect::<Vec<_>>().join(" and ");
        let below = self.refused_below;
        let mut because = vec![
            format!(
                "{who}: the printed row is {:.2} standard deviations a cell from our mean row; {} of {} instances of ours, each against \
                 the others' mean, are as far (rank {rank:.3}; refused below {below}, so that an ordinary row is refused with \
                 probability {:.2} at most by both tests together)",
                place.distance,
                place.as_far,
                place.instances,
                2.0 * below
            ),
            level_sentence(level, below),
        ];
        because.extend(self.inside(cells));
        let is_sweep = self.rows.iter().all(|row| matches!(row.cells, Cells::Sweep(_)));
        because.extend(monotone_probability(cells).filter(|_| self.rows.len() == 1 && is_sweep).map(|chance| {
            format!(
                "if each cell came from an instance of its own, a row that never falls would have probability {chance:.1e}: the printed row \
                 looks like one instance that grows"
            )
        }));
        because
    }
}

/// Where a row stands, in shape and in level, its rank of shape among our instances and itself, and what both ranks say: each is
/// exact, however few the instances.
type Placed = (Place, Level, f64, Outcome);

fn placed(row: &[f64], cells: &[Vec<f64>], refused_below: f64) -> Option<Placed> {
    let place = Place::new(row, cells).filter(|_| cells.len() == row.len())?;
    let level = Level::new(row, cells)?;
    let rank = (place.as_far + 1) as f64 / (place.instances + 1) as f64;
    let is_ordinary = rank.min(level.rank.p_two_sided()) >= refused_below;
    Some((place, level, rank, if is_ordinary { Outcome::Holds } else { Outcome::Fails }))
}

/// How far `row` would have had to lie below or above in every cell to be refused, in whole points of shares, as far as these go, or in
/// hundredths of its largest cell. What passes lies between: the distance from a mean has one minimum along the way.
fn power(row: &[f64], are_shares: bool, cells: &[Vec<f64>], refused_below: f64) -> String {
    let largest = row.iter().fold(0.0_f64, |most, cell| most.max(cell.abs()));
    let step = if are_shares { 1.0 } else { largest / 100.0 };
    let is_refused = |steps: i32| {
        let shifted = row.iter().map(|cell| cell + step * f64::from(steps));
        let shifted: Vec<f64> =
            shifted.map(|cell| if are_shares { cell.clamp(0.0, 100.0) } else { cell }).collect();
        placed(&shifted, cells, refused_below).is_none_or(|(.., outcome)| outcome == Outcome::Fails)
    };
    let refused_from = |way: i32| {
        let steps: Vec<i32> = (1..=100).map(|steps| way * steps).collect();
        let passing = steps.partition_point(|steps| !is_refused(*steps));
        let by = steps.get(passing).map(|steps| step * f64::from(steps.abs()));
        let unit = if are_shares { " points" } else { "" };
        by.map(|by| format!("{by:.0}{unit} {}", if way < 0 { "lower" } else { "higher" }))
    };
    match [-1, 1].into_iter().filter_map(refused_from).reduce(|a, b| format!("{a} or {b}")) {
        Some(by) => format!("power: a printed row that is {by} in every cell would have been refused"),
        None => "power: no printed row that differs alike in every cell would have been refused".to_owned(),
    }
}

/// The numbers of each cell, by cell.
fn listed(numbers: &[Number], ends: Ends) -> Vec<Vec<f64>> {
    parts(numbers, ends).into_iter().map(|cell| cell.values.clone()).collect()
}

impl Criterion for RowOneInstance<'_> {
    /// The numbers of each cell, a part each.
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let drawn: Vec<Vec<Instance<'_>>> =
            self.rows.iter().map(|row| row.selection.instances(evidence)).collect();
        let counts: Vec<Number> = drawn.iter().map(|instances| Number::of_cases(instances)).collect();
        let ran = counts.iter().map(|row| row.ran).max().unwrap_or(0);
        let unended = counts.iter().map(|row| row.unended).sum();
        let is_counted = self.rows.iter().all(|row| matches!(row.cells, Cells::Sweep(_)));
        let cells = |ends: Ends| {
            let cells = self.cells(&drawn, ends == Ends::Most).into_iter().enumerate();
            let of_cell = move |(cell, values): (usize, Vec<f64>)| Number {
                part: format!("cell {}", cell + 1),
                ends,
                n: values.len(),
                values,
                ..Number::default()
            };
            cells.map(of_cell).collect::<Vec<_>>()
        };
        let measured = cells(Ends::Measured);
        let n = measured.iter().map(|cell| cell.n).min().unwrap_or(0);
        let solved = if unended > 0 && is_counted { cells(Ends::Most) } else { Vec::new() };
        let all = counts.into_iter().next().unwrap_or_default();
        let all = Number { n, ran, unended, ..all };
        std::iter::once(all).chain(measured).chain(solved).collect()
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let cells = listed(numbers, Ends::Measured);
        let Some((place, level, rank, outcome)) = self.placed(&cells) else {
            return CriterionResult::too_few(all.n, all.ran, self.fewest());
        };
        let judged = rank.min(level.rank.p_two_sided());
        let n = place.instances;
        let ours = Estimate::bare(judged, "the lesser rank, of shape or level", n)
            .measures(Quantity::Rank, "our instances");
        CriterionResult {
            outcome: Some(outcome),
            censored: self.censored(numbers, (&level, outcome)),
            ours: Some(ours.of_cases(all.cases())),
            because: self.because(&place, &level, rank, &cells),
            units: "instances",
            needs: Some(self.fewest()).filter(|fewest| n < *fewest),
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, numbers: &[Number], found: &mut CriterionResult) {
        if found.ours.is_some() {
            let are_shares = self.rows.iter().all(|row| matches!(row.cells, Cells::Sweep(_)));
            let cells = listed(numbers, Ends::Measured);
            found.power = Some(power(&self.printed, are_shares, &cells, self.refused_below));
            found.trial = self.shown(evidence, &self.rows[0].selection.instances(evidence));
        }
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        self.rows.iter().map(|row| &row.selection).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_refused_from_where_few_instances_are_as_far() {
        let cells = vec![(0..101).map(|at| 30.0 + 0.4 * f64::from(at)).collect(); 3];
        let sentence = power(&[50.0; 3], true, &cells, 0.05);
        assert_eq!(
            sentence,
            "power: a printed row that is 20 points lower or 20 points higher in every cell would have been refused"
        );
        // A share goes no further than 100.
        let near = vec![(0..101).map(|at| (80.0 + 0.4 * f64::from(at)).min(100.0)).collect(); 3];
        let sentence = power(&[100.0; 3], true, &near, 0.05);
        assert!(sentence.contains("lower in every cell") && !sentence.contains("higher"), "{sentence}");
    }
}
