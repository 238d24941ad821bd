//! The trials that a criterion, a figure or a table looks at: resolved once, then taken from the runs under any
//! interpretation.

use super::context::Context;
use super::evidence::{Evidence, Run, paired};
use super::metric::Metric;
use super::selection_spec::{Labels, SelectionSpec};
use base::settings::{Faults, SettingsError};
use std::collections::BTreeMap;
use study::key::SweepKey;
use study::name;
use study::record::{Row, Status};
use study::{Study, labels_of, sweeps_of};

/// A selection whose every name was found.
#[derive(Clone)]
pub struct Selection<'a> {
    /// The study.
    pub study: &'a Study,
    /// The problem groups, in the order that they are named in.
    pub groups: Vec<String>,
    /// The contenders.
    pub contenders: Vec<String>,
    /// The contender that they are compared with.
    pub against: Option<String>,
    /// The metric; absent if statuses alone are looked at.
    pub metric: Option<&'static Metric>,
    /// The queries; all if `None`.
    pub query: Option<Vec<String>>,
    /// The points of the sweeps; all if `None`.
    pub sweep: Option<Vec<SweepKey>>,
    /// Whether only instances count that are solved as a whole.
    pub whole_instances: bool,
    /// Whether what ends without a path, or with a refused one, has a number too.
    pub all_ends: bool,
}

/// One trial, and the trial that it is held against.
#[derive(Clone, Copy)]
pub struct Case<'e> {
    /// The trial.
    pub row: &'e Row,
    /// The trial of the other contender on the same problem.
    pub base: Option<&'e Row>,
    /// The metric, if the trial counts and it was measured.
    pub value: Option<f64>,
    /// The metric of the other trial, likewise.
    pub base_value: Option<f64>,
}

/// An independent draw (a map, a roadmap, a seed of a contender that draws), with all its queries.
pub struct Instance<'e> {
    /// The problem group.
    pub group: &'e str,
    /// Its trials.
    pub cases: Vec<Case<'e>>,
}

impl Case<'_> {
    /// Whether the trial is one of the contender called `label`.
    pub fn is_by(&self, label: &str) -> bool {
        *self.row.key.contender == *label
    }

    /// Both numbers, the other contender's first.
    pub fn pair(&self) -> Option<(f64, f64)> {
        self.base_value.zip(self.value)
    }

    /// What is saved against the other contender, in per cent; none if its number is not above 0.
    pub fn saving_percent(&self) -> Option<f64> {
        self.pair().filter(|(base, _)| *base > 0.0).map(|(base, own)| 100.0 * (1.0 - own / base))
    }

    /// Whether some side lacks a number that it might have had. Two reasons do not count: no path exists for either
    /// side, or the clock, which is read for some trials only, was not read where both are solved.
    pub fn is_censored(&self) -> bool {
        let no_path = |row: &Row| row.status == Status::NoPath;
        match self.base {
            Some(base) => self.pair().is_none() && !(no_path(self.row) && no_path(base)) && !self.is_solved(),
            None => self.value.is_none() && !no_path(self.row) && !self.is_solved(),
        }
    }

    /// Whether some side did not come to an end: what it would have given is not known.
    pub fn is_unended(&self) -> bool {
        is_unended(self.row) || self.base.is_some_and(is_unended)
    }

    /// Whether everyone who is compared might have solved it: some side did not come to an end, and none ended without a path that holds.
    pub fn might_be_solved(&self) -> bool {
        let might = |row: &Row| row.is_solved() || is_unended(row);
        self.is_unended() && might(self.row) && self.base.is_none_or(might)
    }

    /// Whether everyone who is compared solved it.
    pub fn is_solved(&self) -> bool {
        self.row.is_solved() && self.base.is_none_or(Row::is_solved)
    }
}

impl<'a> Selection<'a> {
    /// All trials of `contenders` on `groups` of `study`.
    pub fn all(study: &'a Study, groups: &[String], contenders: &[String]) -> Self {
        let groups = groups.to_vec();
        let contenders = contenders.to_vec();
        let against = None;
        let metric = None;
        let query = None;
        let sweep = None;
        let whole_instances = false;
        let all_ends = false;
        Self { study, groups, contenders, against, metric, query, sweep, whole_instances, all_ends }
    }

    /// The selection `spec` with every name looked up.
    ///
    /// # Errors
    /// A study, problem group, contender, metric or sweep point that does not exist, at its own place.
    pub fn new(context: &Context<'a>, spec: &SelectionSpec) -> Result<Self, SettingsError> {
        let contenders = spec.contender.listed();
        let named: Vec<&str> = contenders.iter().chain(&spec.against).map(String::as_str).collect();
        let study = context.study("select.study", &spec.study)?;
        let mut faults = Faults::default();
        faults.keep(context.check_contenders(&["select.contender", "select.against"], study, &named));
        let groups =
            faults.keep(context.groups("select.problems", study, &spec.problems)).unwrap_or_default();
        let metric =
            spec.metric.as_ref().and_then(|name| faults.keep(context.metric("select.metric", name, study)));
        let labels: Vec<&str> = groups.iter().map(String::as_str).collect();
        let query = spec.query.as_ref().map(Labels::listed);
        let lacking = query.iter().flatten().find_map(|query| study.lacks_query(&labels, query));
        if let Some(message) = lacking {
            faults.add(context.settings.error_at("select.query", message));
        }
        let sweep = spec
            .sweep
            .as_ref()
            .and_then(|texts| faults.keep(sweep_keys(context, (study, &groups), &texts.listed())));
        if let Some(own) = spec.against.as_ref().filter(|against| contenders.contains(against)) {
            let message = format!("`{own}` is held against itself; another contender is accepted");
            faults.add(context.settings.error_at("select.against", message));
        }
        faults.done()?;
        let against = spec.against.clone();
        let whole_instances = spec.whole_instances;
        let all_ends = spec.all_ends;
        Ok(Self { study, groups, contenders, against, metric, query, sweep, whole_instances, all_ends })
    }

    /// The one contender.
    ///
    /// # Errors
    /// There is none, or more.
    pub fn contender(&self, context: &Context<'_>) -> Result<&str, SettingsError> {
        match &self.contenders[..] {
            [one] => Ok(one),
            [] => self.some_contender(context).map(|()| ""),
            all => Err(context.settings.error_at(
                "select.contender",
                format!("`select` names {} contenders; one is accepted", all.len()),
            )),
        }
    }

    /// Refuses a selection that names no contender, and so selects nothing.
    ///
    /// # Errors
    /// It names none.
    pub fn some_contender(&self, context: &Context<'_>) -> Result<(), SettingsError> {
        if !self.contenders.is_empty() {
            return Ok(());
        }
        let message = format!(
            "`select` names no contender, so it selects nothing; study `{}` has {}",
            self.study.name,
            self.study.labels().join(", ")
        );
        let error = context.settings.error_at("select", message).about("contender");
        Err(error.about(&labels_of(&self.study.name)))
    }

    /// Whether it looks at a point of the sweeps.
    fn is_at(&self, point: &SweepKey) -> bool {
        self.sweep.as_ref().is_none_or(|wanted| wanted.iter().any(|own| point.has(own)))
    }

    /// The contender that it is held against.
    ///
    /// # Errors
    /// There is none.
    pub fn against(&self, context: &Context<'_>) -> Result<&str, SettingsError> {
        let message = "`select` needs `against`: the contender that it is held against";
        let missing = || context.settings.error_at("select", message).about("against");
        self.against.as_deref().ok_or_else(missing)
    }

    /// The metric.
    ///
    /// # Errors
    /// There is none.
    pub fn metric(&self, context: &Context<'_>) -> Result<&'static Metric, SettingsError> {
        let missing = || context.settings.error_at("select", "`select` needs a `metric`").about("metric");
        self.metric.ok_or_else(missing)
    }

    /// Whether it reads a clock.
    pub fn is_clock(&self) -> bool {
        self.metric.is_some_and(Metric::is_clock)
    }

    /// The points of the sweeps that its trials can have; those that are drawn within an instance are one.
    pub fn sweep_points(&self) -> Vec<SweepKey> {
        let mut points = self.study.pooled_points_of(|label| self.groups.iter().any(|group| group == label));
        let wanted = self.sweep.iter().flatten();
        points.retain(|point| self.sweep.is_none() || wanted.clone().any(|own| own.has(point)));
        points
    }

    /// The stored run that it looks at.
    pub fn run<'e, 'p>(&self, evidence: &'e Evidence<'p>) -> Option<&'e Run<'p>> {
        evidence.run(&self.study.name)
    }

    /// The name of a case's trial, as `--trial` takes it.
    pub fn trial(&self, evidence: &Evidence<'_>, case: Option<&Case<'_>>) -> Option<String> {
        Some(self.run(evidence)?.trial(case?.row))
    }

    /// The trials of its contenders, by instance; problems that could not be posed are left out, and so, if only whole instances
    /// count, are instances that are not solved as a whole.
    pub fn instances<'e>(&self, evidence: &'e Evidence<'_>) -> Vec<Instance<'e>> {
        let mut instances = self.all_instances(evidence);
        instances.retain(|instance| !self.whole_instances || instance.is_whole());
        instances
    }

    /// How many cases without an end are in instances that do not count, as only whole ones do: these might have been whole.
    pub fn unended_left_out(&self, evidence: &Evidence<'_>) -> usize {
        if !self.whole_instances {
            return 0;
        }
        let instances = self.all_instances(evidence);
        instances
            .iter()
            .filter(|instance| instance.might_be_whole())
            .map(|instance| unended(std::slice::from_ref(instance)))
            .sum()
    }

    /// The instances of groups that are drawn; none if no group is, or if they were searched for: one then shows what can be.
    pub fn drawn(&self, instances: &[Instance<'_>]) -> Option<usize> {
        let is_drawn = |group: &String| !self.study.searched && self.study.is_drawn(group);
        let drawn: Vec<&String> = self.groups.iter().filter(|group| is_drawn(group)).collect();
        let of_drawn = |instance: &&Instance<'_>| drawn.iter().any(|group| *group == instance.group);
        (!drawn.is_empty()).then(|| instances.iter().filter(of_drawn).count())
    }

    fn all_instances<'e>(&self, evidence: &'e Evidence<'_>) -> Vec<Instance<'e>> {
        let Some(run) = evidence.run(&self.study.name) else { return Vec::new() };
        let mut instances: Vec<Instance<'e>> = Vec::new();
        let reader = self.metric.map(|metric| run.reader(metric));
        let value = |row: Option<&Row>| reader.as_ref()?(row.filter(|row| self.counts(row))?);
        for group in &self.groups {
            let is_drawn = self.study.is_drawn(group);
            let mut places = BTreeMap::<(u32, u32), usize>::new();
            for (row, base) in self.compared(run, group) {
                // Seeds on a problem that is drawn are no instances of it.
                let seed = row.key.repeat.max(base.map_or(0, |base| base.key.repeat));
                let seed = if is_drawn { 0 } else { seed };
                let place = *places.entry((row.instance(), seed)).or_insert(instances.len());
                if place == instances.len() {
                    instances.push(Instance { group: &row.key.on.group, cases: Vec::new() });
                }
                let case = Case { row, base, value: value(Some(row)), base_value: value(base) };
                instances[place].cases.push(case);
            }
        }
        instances
    }

    /// The trials of its contenders in one group, each with the trial that it is compared with.
    fn compared<'e>(&self, run: &'e Run<'_>, group: &str) -> Vec<(&'e Row, Option<&'e Row>)> {
        let of = |contender: &String| {
            let own = self.rows(run, group, contender);
            let Some(against) = &self.against else {
                return own.into_iter().map(|row| (row, None)).collect();
            };
            let pairs = paired(own, self.rows(run, group, against)).into_iter();
            pairs.map(|(row, base)| (row, Some(base))).collect::<Vec<_>>()
        };
        self.contenders.iter().flat_map(of).collect()
    }

    /// The trials of `contender` in one group that are looked at.
    pub fn rows<'e>(&self, run: &'e Run<'_>, group: &str, contender: &str) -> Vec<&'e Row> {
        let mut rows = run.rows(group, contender);
        rows.retain(|row| {
            row.status != Status::InvalidProblem
                && self.query.as_ref().is_none_or(|queries| queries.iter().any(|query| row.query() == query))
                && self.is_at(&row.key.sweep)
                && self.is_read(row)
        });
        rows
    }

    /// Whether each of its groups has a trial that could be posed, or no trials at all.
    pub fn is_posed(&self, evidence: &Evidence<'_>) -> bool {
        let Some(run) = self.run(evidence) else { return true };
        self.groups.iter().all(|group| {
            let rows: Vec<&Row> = self.contenders.iter().flat_map(|own| run.rows(group, own)).collect();
            rows.is_empty() || rows.iter().any(|row| row.status != Status::InvalidProblem)
        })
    }

    /// Whether trials with refused paths have numbers although not all ends do.
    pub fn counts_refused(&self) -> bool {
        !self.all_ends && self.metric.is_some_and(|metric| metric.is_of_search)
    }

    /// Whether a trial has a number.
    fn counts(&self, row: &Row) -> bool {
        self.metric.is_some_and(|metric| metric.is_given_by(row))
            || self.all_ends && matches!(row.status, Status::NoPath | Status::Rejected)
    }

    /// Whether the metric was looked for on a trial's instance: the clock is read on the first instances of each group alone, so that
    /// what failed on the others is no failure among the timed.
    fn is_read(&self, row: &Row) -> bool {
        let timed = self.study.timing.filter(|_| self.is_clock());
        timed.is_none_or(|timing| row.instance() < timing.problems)
    }

    /// What is looked at, in a sentence: `A against B on X, Y of study`.
    pub fn description(&self) -> String {
        let who = self.contenders.join(", ");
        let against = self.against.as_ref().map_or_else(String::new, |other| format!(" against {other}"));
        let query = self.query.as_ref().map_or_else(String::new, |queries| match &queries[..] {
            [one] => format!(", query {one}"),
            all => format!(", queries {}", all.join(", ")),
        });
        let points = self.sweep.iter().flatten().map(name::sweep).collect::<Vec<_>>();
        let at = match &points[..] {
            [] => String::new(),
            [first, _, _, _, .., last] => format!(", {first} to {last}, {} points", points.len()),
            few => format!(", {}", few.join(" and ")),
        };
        let ends = if self.all_ends { ", whether a path is found or not" } else { "" };
        format!("{who}{against} on {} of {}{query}{at}{ends}", self.groups_text(), self.study.name)
    }

    /// Which cases have numbers of both contenders, in words.
    pub fn given_in_words(&self) -> &'static str {
        match (self.all_ends, self.counts_refused()) {
            (true, _) => "",
            (false, true) => " in which both find a path",
            (false, false) => " that both solve",
        }
    }

    fn groups_text(&self) -> String {
        if self.groups.len() > 3 {
            return format!("{} problem groups", self.groups.len());
        }
        self.groups.join(", ")
    }
}

fn sweep_keys(
    context: &Context<'_>,
    (study, groups): (&Study, &[String]),
    texts: &[String],
) -> Result<Vec<SweepKey>, SettingsError> {
    study.sweeps_called(groups, texts).map_err(|(place, message)| {
        let error = context.settings.error_at(&format!("select.sweep.{place}"), message);
        error.about(&sweeps_of(&study.name))
    })
}

impl Instance<'_> {
    /// What it holds of one contender.
    #[must_use]
    pub fn by(&self, contender: &str) -> Self {
        let own = self.cases.iter().filter(|case| case.is_by(contender));
        Self { group: self.group, cases: own.copied().collect() }
    }

    /// What it holds at one point of the sweeps.
    #[must_use]
    pub fn at(&self, sweep: &SweepKey) -> Self {
        let is_own = |case: &&Case<'_>| case.row.key.sweep.has(sweep);
        Self { group: self.group, cases: self.cases.iter().filter(is_own).copied().collect() }
    }

    /// The share of its cases, in per cent, for which `is_hit` holds; none without cases.
    pub fn percent(&self, is_hit: impl Fn(&Case<'_>) -> bool) -> Option<f64> {
        let hits = self.cases.iter().filter(|case| is_hit(case)).count();
        (!self.cases.is_empty()).then(|| 100.0 * hits as f64 / self.cases.len() as f64)
    }

    /// The numbers of its cases.
    pub fn values(&self) -> Vec<f64> {
        self.cases.iter().filter_map(|case| case.value).collect()
    }

    /// Whether all that is compared is solved on it.
    pub fn is_whole(&self) -> bool {
        self.cases.iter().all(Case::is_solved)
    }

    /// Whether it is not whole, and would be if trials without an end had been solved.
    fn might_be_whole(&self) -> bool {
        !self.is_whole() && self.cases.iter().all(|case| case.is_solved() || case.might_be_solved())
    }
}

/// Whether a trial did not come to an end: what it would have given is not known.
pub fn is_unended(row: &Row) -> bool {
    matches!(row.status, Status::BudgetSpent | Status::TimeSpent | Status::Crashed)
}

/// Every case of every instance.
pub fn cases<'d, 'e>(instances: &'d [Instance<'e>]) -> impl Iterator<Item = &'d Case<'e>> {
    instances.iter().flat_map(|instance| &instance.cases)
}

/// The most cases of any instance, as a number to count chances with.
pub fn most_cases(instances: &[Instance<'_>]) -> f64 {
    instances.iter().map(|instance| instance.cases.len()).max().unwrap_or(0) as f64
}

/// Of all cases those that are solved by everyone who is compared, and all.
pub fn solved(instances: &[Instance<'_>]) -> [usize; 2] {
    [cases(instances).filter(|case| case.is_solved()).count(), cases(instances).count()]
}

/// Cases that have no number on some side although they might.
pub fn censored(instances: &[Instance<'_>]) -> usize {
    cases(instances).filter(|case| case.is_censored()).count()
}

/// Cases that did not come to an end on some side.
pub fn unended(instances: &[Instance<'_>]) -> usize {
    cases(instances).filter(|case| case.is_unended()).count()
}

/// Both numbers of every case that has them, the other contender's first, by instance; instances without any are left out.
pub fn pairs(instances: &[Instance<'_>]) -> Vec<Vec<(f64, f64)>> {
    by_instance(instances, Case::pair)
}

/// What `of` takes of the cases of each instance; instances that give nothing are left out.
pub fn by_instance<'e, T>(instances: &[Instance<'e>], of: impl Fn(&Case<'e>) -> Option<T>) -> Vec<Vec<T>> {
    let of_instance = |instance: &Instance<'e>| instance.cases.iter().filter_map(&of).collect::<Vec<T>>();
    instances.iter().map(of_instance).filter(|all| !all.is_empty()).collect()
}

/// The trial whose number, as `of` takes it, is nearest to `value`.
pub fn nearest(
    selection: &Selection<'_>,
    evidence: &Evidence<'_>,
    instances: &[Instance<'_>],
    of: impl Fn(&Case<'_>) -> Option<f64>,
    value: f64,
) -> Option<String> {
    least(selection, evidence, instances, |case| of(case).map(|number| (number - value).abs()))
}

/// The trial whose number, as `of` takes it, is the least; the first of equal ones.
pub fn least(
    selection: &Selection<'_>,
    evidence: &Evidence<'_>,
    instances: &[Instance<'_>],
    of: impl Fn(&Case<'_>) -> Option<f64>,
) -> Option<String> {
    let numbers = cases(instances).filter_map(|case| Some((case, of(case)?)));
    let least = numbers.min_by(|a, b| a.1.total_cmp(&b.1));
    selection.trial(evidence, least.map(|(case, _)| case))
}
