//! Whether a printed table of means, as a whole, could be that of so many instances like ours.
//!
//! The cells of a row share their instances, so they are judged jointly; rows draw instances of their own, so their probabilities
//! are taken together. A cell that is the same on all of our instances is exact and must print as the paper's. The paper means
//! one interpretation and does not say which, so the size of the test is shared out among all that it may mean. Where a study is
//! calibrated to one table, that table bears this alone, and others are judged as they are.

use super::mean_of::{self, MeanOf};
use super::{Criterion, Entry, without};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::Evidence;
use crate::analysis::joint_test::{Apart, JointTest, Products};
use crate::analysis::number::{Ends, Number, parts, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{self, Instance, Selection, by_instance};
use crate::analysis::statistic::mean;
use crate::analysis::verdict::{CORRECTED, Estimate, Quantity, p_text};
use base::settings::{Accepted, Faults, SettingsError};
use nalgebra::DMatrix;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::beta::combined;
use stats::means::FEWEST_NORMAL;
use std::collections::BTreeMap;
use study::Choice;
use study::paper::{Claim, Paper};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "table_means",
    about: "could the printed means of a table, taken together, be those of so many instances like ours?",
    revision: |_| 1,
    question: |settings| {
        without(settings, &["refused_below"]);
        Some("means of a table 1")
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
in = [{ study = "compare", claims = ["table1.astar.length"] }]
refused_below = 0.05
"#,
    build: |context| Ok(Box::new(TableMeans::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The studies with the claims of each that print the means: those that `mean_of` judges. Claims that are not testable and
    /// differences of two cells are left out.
    #[serde(rename = "in")]
    places: Vec<PlaceSpec>,
    /// The table is refused where its probability is below this. It is multiplied by the interpretations that the paper may mean,
    /// unless studies are `fitted_to` other claims, which then say which interpretations are judged.
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0))]
    refused_below: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlaceSpec {
    /// The study whose instances the means are held against.
    study: String,
    /// The claims that print them.
    claims: Vec<String>,
}

struct Cell<'a> {
    id: &'a str,
    at: &'a str,
    mean: MeanOf<'a>,
}

struct TableMeans<'a> {
    /// The cells of each study and its problem groups.
    rows: Vec<Vec<Cell<'a>>>,
    refused_below: f64,
    interpretations: usize,
}

/// By how many interpretations the probability of `claim` is multiplied: those that the paper may mean and that trials of the studies
/// tell apart; 1 if other claims chose among them.
pub fn interpretations(paper: &Paper, claim: &Claim) -> usize {
    let mut calibration = paper.studies.iter().flat_map(|study| &study.fitted_to).peekable();
    if calibration.peek().is_some() && calibration.all(|id| *id != claim.id) {
        return 1;
    }
    let voting = |choice: &Choice| choice.options.keys().filter(|name| choice.votes(name)).count().max(1);
    touching(paper, claim).values().map(|choice| voting(choice)).product()
}

/// The choices that set something of the trials that the cells of `claim` look at, by id.
pub fn touching<'p>(paper: &'p Paper, claim: &Claim) -> BTreeMap<&'p str, &'p Choice> {
    let mut found = BTreeMap::new();
    for place in places(claim) {
        let Some(study) = paper.study(&place.study) else { continue };
        let cells = paper.claims.iter().filter(|cell| place.claims.contains(&cell.id));
        let labels: Vec<String> = cells.flat_map(mean_of::contenders).collect();
        let contenders = || study.contenders.iter().filter(|contender| labels.contains(&contender.label));
        let sets = |choice: &&Choice| contenders().any(|contender| contender.is_set_by(choice));
        let choices = study.choices.iter().filter(|choice| choice.touches_trials).filter(sets);
        found.extend(choices.map(|choice| (choice.id.as_str(), choice)));
    }
    found
}

impl<'a> TableMeans<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let mut faults = Faults::default();
        let mut rows: BTreeMap<(String, Vec<String>, usize), Vec<Cell<'a>>> = BTreeMap::new();
        for (index, place) in settings.places.iter().enumerate() {
            let Some(study) = faults.keep(context.study(&format!("in.{index}.study"), &place.study)) else {
                continue;
            };
            for (at, id) in place.claims.iter().enumerate() {
                let at = format!("in.{index}.claims.{at}");
                let Some(cell) = faults.keep(cell(context, &at, id)).flatten() else { continue };
                if cell.mean.selection.study.name != study.name {
                    let message = format!("claim `{id}` looks at study `{}`", cell.mean.selection.study.name);
                    faults.add(context.settings.error_at(&at, message));
                }
                let key = (study.name.clone(), cell.mean.selection.groups.clone(), cell.mean.instances);
                rows.entry(key).or_default().push(cell);
            }
        }
        faults.done()?;
        if rows.is_empty() {
            let message = "no claim that `mean_of` judges is named; at least one is needed";
            return Err(context.settings.error_at("in", message).about("in").about("claims"));
        }
        let interpretations = interpretations(context.paper, context.claim);
        Ok(Self {
            rows: rows.into_values().collect(),
            refused_below: settings.refused_below,
            interpretations,
        })
    }
}

/// The claims whose printed means `claim` judges jointly; none if it is judged otherwise.
pub fn cells(claim: &Claim) -> Vec<String> {
    places(claim).flat_map(|place| place.claims).collect()
}

/// The places of the means that `claim` judges jointly; none if it is judged otherwise.
fn places(claim: &Claim) -> impl Iterator<Item = PlaceSpec> {
    let settings = claim.check(ENTRY.name).and_then(|settings| settings.read::<Settings>().ok());
    settings.into_iter().flat_map(|settings| settings.places)
}

/// The cell that the claim `id` is, `None` if it is not testable or a difference of two others.
fn cell<'a>(context: &Context<'a>, at: &str, id: &str) -> Result<Option<Cell<'a>>, SettingsError> {
    let claim = context.claim_called(at, id)?;
    if claim.untestable.is_some() || claim.difference.is_some() {
        return Ok(None);
    }
    let Some(settings) = claim.check(mean_of::ENTRY.name) else {
        let message = format!("claim `{id}` is not judged by `{}`", mean_of::ENTRY.name);
        return Err(context.settings.error_at(at, message).about("check"));
    };
    let mean = MeanOf::new(&Context { claim, settings, ..*context })?;
    Ok(Some(Cell { id: &claim.id, at: &claim.at, mean }))
}

/// The end of `other` that tells it from `one`, from a comma on.
fn differing<'t>(one: &str, other: &'t str) -> &'t str {
    let common = one.bytes().zip(other.bytes()).take_while(|(one, other)| one == other).count();
    let begins = other.get(..common).and_then(|common| common.rfind(", "));
    &other[begins.map_or(0, |comma| comma + 2)..]
}

/// With how many decimals a number is printed that is rounded by at most this.
fn decimals(half_width: f64) -> usize {
    (-libm::log10(2.0 * half_width)).round().max(0.0) as usize
}

/// What is farthest from what is printed in any row, in words.
fn farthest(rows: Vec<RowResult<'_>>) -> Option<String> {
    let apart = rows.into_iter().filter_map(|row| row.apart);
    apart.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, words)| words)
}

/// What a row gives.
struct RowResult<'a> {
    /// Its problem groups.
    label: String,
    /// The probability of a row that is as far from ours as the printed one.
    p: f64,
    /// T², and its numbers of cells and of instances; `None` if all cells are exact.
    test: Option<(f64, usize, usize)>,
    /// The cells that weigh most in T², in words.
    loudest: Vec<String>,
    /// The cell that is farthest from what is printed, by its place in the row.
    farthest: usize,
    /// What is farthest from what is printed, a cell or the difference of two: by how many standard errors, and in words.
    apart: Option<(f64, String)>,
    /// Exact cells that do not print as the paper's.
    refused: Vec<&'a str>,
    /// The test of the row, and its T² if every number were off by 100 %: the power follows from both.
    power: Option<(JointTest, f64)>,
}

/// What an instance is called where cells are joined.
type Unit<'e> = (&'e str, u32, u32);

impl<'a> TableMeans<'a> {
    /// The number of each cell, of every instance that has them all.
    fn units<'e>(row: &[Cell<'a>], evidence: &'e Evidence<'_>) -> Vec<Vec<f64>> {
        let of_cell = |cell: &Cell<'a>| -> BTreeMap<Unit<'e>, f64> {
            let instances = cell.mean.selection.instances(evidence);
            let number = |instance: &Instance<'e>| {
                let numbers = by_instance(std::slice::from_ref(instance), |case| cell.mean.number(case));
                let first = instance.cases.first()?.row;
                Some(((instance.group, first.instance(), first.key.repeat), mean(numbers.first()?)?))
            };
            instances.iter().filter_map(number).collect()
        };
        let cells: Vec<_> = row.iter().map(of_cell).collect();
        let whole = |unit: &Unit<'e>| cells.iter().map(|cell| cell.get(unit).copied()).collect();
        cells.first().into_iter().flat_map(BTreeMap::keys).filter_map(whole).collect()
    }

    /// The mean of each cell of a row, a part each: one that is the same on all instances is exact, and others come with the products with
    /// them.
    fn means(row: &[Cell<'a>], evidence: &Evidence<'_>) -> Vec<Number> {
        let units = Self::units(row, evidence);
        let first = units.first();
        let is_exact =
            |cell: &usize| units.iter().all(|unit| first.is_some_and(|first| unit[*cell] == first[*cell]));
        let moving: Vec<usize> = (0..row.len()).filter(|cell| !is_exact(cell)).collect();
        let instances: Vec<Vec<f64>> =
            units.iter().map(|unit| moving.iter().map(|cell| unit[*cell]).collect()).collect();
        let Products { means, products, units: n } = Products::new(&instances, moving.len());
        let of_cell = |cell: usize| {
            let at = moving.iter().position(|own| *own == cell);
            Number {
                part: row[cell].id.to_owned(),
                value: at.map(|at| means[at]).or_else(|| Some(first?[cell])),
                is_agreed: at.is_none(),
                n,
                values: at.map_or_else(Vec::new, |at| products.row(at).iter().copied().collect()),
                ..Number::default()
            }
        };
        (0..row.len()).map(of_cell).collect()
    }

    /// What a row gives, from the mean of each of its cells; `None` of too few instances.
    fn row<'s>(row: &'s [Cell<'a>], found: &[&Number]) -> Option<RowResult<'s>> {
        let units = found.first()?.n;
        let ours: Vec<f64> = found.iter().map(|cell| cell.value).collect::<Option<_>>()?;
        let (exact, moving): (Vec<usize>, Vec<usize>) =
            (0..row.len()).partition(|cell| found[*cell].is_agreed);
        let prints = |cell: usize| row[cell].mean.rounded.contains(ours[cell]);
        let refused: Vec<&str> =
            exact.iter().filter(|cell| !prints(**cell)).map(|cell| row[*cell].id).collect();
        let first_refused = exact.iter().copied().find(|cell| !prints(*cell)).unwrap_or_default();
        let label = row[0].mean.selection.groups.join(", ");
        let rounding: Vec<f64> = moving.iter().map(|cell| row[*cell].mean.rounded.half_width()).collect();
        let p_exact = f64::from(u8::from(refused.is_empty()));
        let otherwise = (!refused.is_empty()).then(|| {
            let Cell { at, mean, .. } = &row[first_refused];
            (
                f64::INFINITY,
                format!("{at}: printed {}, ours {} on every instance", mean.printed, ours[first_refused]),
            )
        });
        if moving.is_empty() && units >= FEWEST_NORMAL {
            let loudest = Vec::new();
            return Some(RowResult {
                label,
                p: p_exact,
                test: None,
                loudest,
                farthest: first_refused,
                apart: otherwise,
                refused,
                power: None,
            });
        }
        let means = moving.iter().map(|cell| ours[*cell]).collect();
        let products =
            DMatrix::from_fn(moving.len(), moving.len(), |one, other| found[moving[one]].values[other]);
        let ours = Products { means, products, units };
        let test = JointTest::new(ours, row[0].mean.instances, &rounding)?;
        let apart: Vec<f64> =
            moving.iter().zip(&test.means).map(|(cell, own)| row[*cell].mean.printed - own).collect();
        let statistic = test.statistic(&apart);
        let name = |place: usize| row[moving[place]].id.rsplit('.').next().unwrap_or_default();
        let spoken = |Apart { cell, from, errors }: Apart| match from {
            None => format!("{} {errors:+.1} σ", name(cell)),
            Some(from) => format!("{} less {} {errors:+.1} σ", name(cell), name(from)),
        };
        let loudest = test.loudest(&apart, 3).into_iter().map(spoken).collect();
        let far = test.loudest(&apart, 1).into_iter().next();
        let farthest = far.filter(|_| refused.is_empty()).map_or(first_refused, |far| moving[far.cell]);
        let both = |far: Apart| {
            let of = |place: usize| (&row[moving[place]], test.means[place]);
            let (cell, mean) = of(far.cell);
            let (less, printed, own) = far.from.map(of).map_or((String::new(), 0.0, 0.0), |(from, own)| {
                (format!(" less {}", differing(cell.at, from.at)), from.mean.printed, own)
            });
            let decimals = decimals(cell.mean.rounded.half_width());
            format!(
                "{}{less}: printed {:.decimals$}, ours {:.decimals$} ({:+.1} σ)",
                cell.at,
                cell.mean.printed - printed,
                mean - own,
                far.errors
            )
        };
        let apart = otherwise.or_else(|| far.map(|far| (far.errors.abs(), both(far))));
        let p = test.probability(statistic) * p_exact;
        let at_one = test.statistic(&test.means);
        let shape = Some((statistic, moving.len(), units));
        let power = Some((test, at_one));
        Some(RowResult { label, p, test: shape, loudest, farthest, apart, refused, power })
    }

    /// What each row gives; `None` if one has too few instances.
    fn row_results(&self, numbers: &[Number]) -> Option<Vec<RowResult<'_>>> {
        let mut cells = parts(numbers, Ends::Measured).into_iter();
        let row = |row: &'_ Vec<Cell<'a>>| cells.by_ref().take(row.len()).collect::<Vec<_>>();
        let found: Vec<Vec<&Number>> = self.rows.iter().map(row).collect();
        self.rows.iter().zip(found).map(|(row, found)| Self::row(row, &found)).collect()
    }

    /// From how many per cent on a table that is off by as much in every cell would have been refused.
    fn power_percent(&self, rows: &[RowResult<'_>]) -> Option<f64> {
        let tests: Vec<&(JointTest, f64)> = rows.iter().filter_map(|row| row.power.as_ref()).collect();
        let probability = |percent: f64| {
            let share = percent / 100.0;
            combined(&tests.iter().map(|(test, t)| test.probability(t * share * share)).collect::<Vec<_>>())
        };
        let is_kept = |percent: f64| self.judged(probability(percent)) >= self.refused_below;
        let (mut low, mut high) = (0.0, 100.0);
        if tests.is_empty() || is_kept(high) {
            return None;
        }
        for _ in 0..40 {
            let middle = f64::midpoint(low, high);
            if is_kept(middle) { low = middle } else { high = middle }
        }
        Some(high)
    }

    /// The probability times the interpretations that the paper may mean.
    fn judged(&self, p: f64) -> f64 {
        (p * self.interpretations as f64).min(1.0)
    }

    fn because(&self, rows: &[RowResult<'_>], p: f64) -> Vec<String> {
        let of_row = |row: &RowResult<'_>| {
            let exact = match &row.refused[..] {
                [] => String::new(),
                cells => format!("; the same on all of ours, and printed otherwise: {}", cells.join(", ")),
            };
            let Some((statistic, cells, units)) = row.test else {
                return format!("{}: all cells are exact{exact}", row.label);
            };
            format!(
                "{}: T² = {statistic:.1} of {cells} cells on {units} instances, p = {:.2e}; most apart, printed less ours: {}{exact}",
                row.label,
                row.p,
                row.loudest.join(", ")
            )
        };
        let whole = format!("all rows together (Fisher): p = {p:.2e}, refused below {}", self.refused_below);
        let many = self.interpretations;
        let times = (many > 1)
            .then(|| format!("{CORRECTED}correcting for {many} interpretations: {}", p_text(self.judged(p))));
        std::iter::once(whole).chain(times).chain(rows.iter().map(of_row)).collect()
    }
}

impl TableMeans<'_> {
    /// A trial near our mean in the cell that is farthest from what is printed, of the row that fits least.
    fn shown(&self, rows: &[RowResult<'_>], evidence: &Evidence<'_>) -> Option<String> {
        let (row, cells) = rows.iter().zip(&self.rows).min_by(|one, other| one.0.p.total_cmp(&other.0.p))?;
        let cell = &cells[row.farthest].mean;
        let instances = cell.selection.instances(evidence);
        let numbers = by_instance(&instances, |case| cell.number(case));
        let middle = mean(&numbers.concat())?;
        selection::nearest(&cell.selection, evidence, &instances, |case| cell.number(case), middle)
    }
}

impl Criterion for TableMeans<'_> {
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let drawn: Vec<_> = self.selections().iter().map(|selection| selection.instances(evidence)).collect();
        let ran = drawn.iter().map(Vec::len).min().unwrap_or(0);
        let all = Number { ran, ..Number::of_cases(&drawn.into_iter().flatten().collect::<Vec<_>>()) };
        let cells = self.rows.iter().flat_map(|row| Self::means(row, evidence));
        std::iter::once(all).chain(cells).collect()
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let Some(rows) = self.row_results(numbers) else {
            let widest = self.rows.iter().map(Vec::len).max().unwrap_or(0);
            return CriterionResult::too_few(all.ran, all.ran, widest + FEWEST_NORMAL)
                .hanging_on(all.unended);
        };
        let p = combined(&rows.iter().map(|row| row.p).collect::<Vec<_>>());
        let is_kept = self.judged(p) >= self.refused_below;
        let ours = Estimate::bare(p, "p of the joint test of all cells", all.ran)
            .measures(Quantity::Probability, "the joint test");
        let power = self.power_percent(&rows).map(|percent| {
            format!("power: a table whose cells are all off by {percent:.1} % would have been refused")
        });
        CriterionResult {
            outcome: Some(if is_kept { Outcome::Holds } else { Outcome::Fails }),
            ours: Some(ours.of_cases(all.cases())),
            because: self.because(&rows, p),
            units: "instances",
            censored: all.unended,
            powerless: power.is_none() && is_kept && rows.iter().any(|row| row.test.is_some()),
            power,
            farthest: farthest(rows),
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, numbers: &[Number], found: &mut CriterionResult) {
        let rows = self.row_results(numbers);
        found.trial = rows.and_then(|rows| self.shown(&rows, evidence));
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        self.rows.iter().flatten().map(|cell| &cell.mean.selection).collect()
    }
}
