//! A share with its interval: of trials solved or with a mark, of events, of instances on which something holds throughout.

use super::{Criterion, Entry, without};
use crate::analysis::censored::{not_posed, outside_in_words};
use crate::analysis::context::Context;
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::evidence::Evidence;
use crate::analysis::number::{Ends, Number, ended, whole};
use crate::analysis::outcome::Outcome;
use crate::analysis::selection::{Case, Instance, Selection, cases, is_unended, most_cases};
use crate::analysis::selection_spec::SelectionSpec;
use crate::analysis::statistic::{SHARE_INTERVAL, Share, narrows, needs};
use crate::analysis::verdict::Quantity;
use base::settings::{Accepted, SettingsError};
use base::text::computed;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::interval::Interval;
use stats::paired::EQUAL;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use study::column;
use study::key::SweepKey;
use study::record::Row;
use toml::{Table, Value};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "share",
    about: "does a share lie within bounds: of trials solved or with a mark, of events, of instances?",
    revision: |settings| if is_of_solved(settings) { 4 } else { 3 },
    question: |settings| {
        without(settings, &["accepted"]);
        Some("share 1")
    },
    settings: Accepted::shape::<Settings>(),
    example: r#"
select = { study = "compare", problems = ["maps"], contender = "A*" }
hits = "solved"
accepted = [0.995, 1.0]
"#,
    build: |context| Ok(Box::new(Counted::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at.
    select: SelectionSpec,
    /// What is counted.
    hits: Hits,
    /// The columns that are all above 0 where it is hit (`marked`), or the one that counts events (`events`).
    #[serde(default)]
    columns: Vec<String>,
    /// The column that counts the chances for `events`.
    per: Option<String>,
    /// The number that the metric is above (`above`), or the share of its cases, from 0 to 1, that an instance solves at least
    /// (`solved_at_least`).
    bound: Option<f64>,
    /// The least and the greatest share under which the claim holds; without, it is shown and decides nothing.
    accepted: Option<[f64; 2]>,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Hits {
    /// Trials that are solved.
    Solved,
    /// Paths that the verifier refuses, of those that come back.
    Rejected,
    /// Trials with marks.
    Marked,
    /// Events, of the chances that `per` counts.
    Events,
    /// Solved trials whose metric is above `bound`.
    Above,
    /// Cases that both solve, with the metric below the other contender's.
    Lower,
    /// Cases that both solve, with the metric above the other contender's.
    Higher,
    /// Instances with the metric below the other contender's on every case that both solve.
    LowerThroughout,
    /// Instances with more cases solved than by the other contender.
    SolvedMore,
    /// Instances with more cases solved than by the other contender at every point of the sweep.
    SolvedMoreThroughout,
    /// Cases that the other contender leaves unsolved and this one solves.
    Cured,
    /// Instances with at least the share `bound` of their cases solved.
    SolvedAtLeast,
}

/// Whether a claim with these settings is about what is solved by everyone who is compared.
fn is_of_solved(settings: &Table) -> bool {
    let hits = settings.get("hits").and_then(Value::as_str).unwrap_or_default();
    ["above", "lower", "higher", "lower_throughout"].contains(&hits)
}

impl Hits {
    fn label(self) -> &'static str {
        match self {
            Self::Solved => "trials solved",
            Self::Rejected => "paths refused by the verifier",
            Self::Marked => "trials marked",
            Self::Events => "events",
            Self::Above => "trials above",
            Self::Lower => "cases on which it is lower",
            Self::Higher => "cases on which it is higher",
            Self::LowerThroughout => "instances where it is lower in every case",
            Self::SolvedMore => "instances where it solves more cases",
            Self::SolvedMoreThroughout => "instances where it solves more at every point of the sweep",
            Self::Cured => "cases that it solves of those that the other fails",
            Self::SolvedAtLeast => "instances where it solves at least",
        }
    }
}

struct Counted<'a> {
    selection: Selection<'a>,
    settings: Settings,
}

impl<'a> Counted<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let selection = Selection::new(context, &settings.select)?;
        selection.some_contender(context)?;
        let hits = settings.hits;
        for name in settings.columns.iter().chain(&settings.per) {
            if column::find(name).is_none() {
                return Err(context.settings.error_about(
                    &["columns", "per"],
                    name,
                    format!("there is no column `{name}`"),
                ));
            }
        }
        let needs_columns = matches!(hits, Hits::Marked | Hits::Events);
        if needs_columns == settings.columns.is_empty() || (hits == Hits::Events) != settings.per.is_some() {
            let message = "`marked` and `events` take `columns`, and `events` takes `per`; nothing else does";
            return Err(context.settings.error_at("hits", message).about("columns").about("per"));
        }
        if matches!(hits, Hits::Above | Hits::SolvedAtLeast) != settings.bound.is_some() {
            let message = "`above` and `solved_at_least` take a `bound`; nothing else does";
            return Err(context.settings.error_at("hits", message).about("bound"));
        }
        if matches!(hits, Hits::Above | Hits::Lower | Hits::Higher | Hits::LowerThroughout) {
            selection.metric(context)?;
        }
        let is_alone =
            needs_columns || settings.bound.is_some() || matches!(hits, Hits::Solved | Hits::Rejected);
        if !is_alone {
            selection.against(context)?;
        }
        if let Some(accepted) = settings.accepted {
            context.rising("accepted", accepted, [0.0, 1.0])?;
            if accepted == [0.0, 1.0] {
                let message = "every share lies between 0 and 1; bounds that refuse some are accepted";
                return Err(context.settings.error_at("accepted", message));
            }
        }
        Ok(Self { selection, settings })
    }

    /// Hits and chances of one case; `None` if the claim does not look at it.
    fn counts(&self, case: &Case<'_>) -> Option<[f64; 2]> {
        let row: &Row = case.row;
        let hit = |is: bool| Some([f64::from(u8::from(is)), 1.0]);
        let gap = || case.pair().map(|(base, own)| own - base);
        match self.settings.hits {
            Hits::Solved | Hits::SolvedAtLeast => hit(row.is_solved()),
            Hits::Rejected => hit(!row.is_solved()).filter(|_| row.is_returned()),
            Hits::Marked => {
                let marks: Option<Vec<f64>> =
                    self.settings.columns.iter().map(|name| row.value(name)).collect();
                hit(marks?.iter().all(|mark| *mark > 0.0))
            }
            Hits::Events => {
                let chances = row.value(self.settings.per.as_deref()?)?;
                Some([row.value(&self.settings.columns[0])?, chances])
            }
            Hits::Above => hit(case.value? > self.settings.bound? + EQUAL),
            Hits::Lower | Hits::LowerThroughout => hit(gap()? < -EQUAL),
            Hits::Higher => hit(gap()? > EQUAL),
            Hits::SolvedMore | Hits::SolvedMoreThroughout => hit(row.is_solved() && !case.base?.is_solved()),
            Hits::Cured => hit(row.is_solved())
                .filter(|_| case.base.is_some_and(|base| !base.is_solved() && !is_unended(base))),
        }
    }

    /// Whether a case might be a hit and is not known to be: one without an end. One that a side ended unsolved is outside of a claim
    /// about what is solved, whatever the other might have found.
    fn is_unknown(&self, case: &Case<'_>) -> bool {
        match self.settings.hits {
            // What ended without a path, or with a refused one, has no marks; what did not end might have had some.
            Hits::Marked | Hits::Events => case.is_unended() && self.counts(case).is_none(),
            // What the other solves is none of its failures.
            Hits::Cured => case.is_unended() && !case.base.is_some_and(Row::is_solved),
            Hits::Above | Hits::Lower | Hits::Higher | Hits::LowerThroughout => case.might_be_solved(),
            Hits::Solved
            | Hits::Rejected
            | Hits::SolvedMore
            | Hits::SolvedMoreThroughout
            | Hits::SolvedAtLeast => case.is_unended(),
        }
    }

    /// How many cases are outside of a claim about what is solved, in words.
    fn outside(&self, count: usize) -> Option<String> {
        let is_of_solved =
            matches!(self.settings.hits, Hits::Above | Hits::Lower | Hits::Higher | Hits::LowerThroughout);
        outside_in_words(&self.selection, count).filter(|_| is_of_solved)
    }

    /// Hits and chances of one instance; its unknown cases left out, or all as hits or as misses.
    fn of_instance(&self, instance: &Instance<'_>, unknown: Option<bool>) -> [f64; 2] {
        let is_throughout = self.settings.hits == Hits::SolvedMoreThroughout;
        if (is_throughout || self.settings.hits == Hits::SolvedMore) && !instance.cases.is_empty() {
            let mut more: BTreeMap<Option<&SweepKey>, i32> = BTreeMap::new();
            for case in &instance.cases {
                *more.entry(is_throughout.then_some(&case.row.key.sweep)).or_default() +=
                    solved_more(case, unknown);
            }
            return [f64::from(u8::from(more.values().all(|more| *more > 0))), 1.0];
        }
        let of_case = |case: &Case<'_>| match unknown.filter(|_| self.is_unknown(case)) {
            Some(is_hit) => Some([f64::from(u8::from(is_hit)), 1.0]),
            None => self.counts(case),
        };
        let counts = instance.cases.iter().filter_map(of_case);
        let [hits, chances] = counts.fold([0.0, 0.0], |sum, [h, c]| [sum[0] + h, sum[1] + c]);
        let least = match self.settings.hits {
            Hits::LowerThroughout => chances,
            Hits::SolvedAtLeast => self.settings.bound.unwrap_or(1.0) * chances - EQUAL,
            _ => return [hits, chances],
        };
        if chances > 0.0 { [f64::from(u8::from(hits >= least)), 1.0] } else { [hits, chances] }
    }

    /// The most chances that an instance could have had: of events the most that were seen, as they have no bound.
    fn most(&self, instances: &[Instance<'_>]) -> f64 {
        match self.settings.hits {
            Hits::LowerThroughout | Hits::SolvedMore | Hits::SolvedMoreThroughout | Hits::SolvedAtLeast => {
                1.0
            }
            Hits::Events => 0.0,
            _ => most_cases(instances),
        }
    }

    /// The share of instances whose unknown cases are left out, or all hits or misses.
    fn share(&self, instances: &[Instance<'_>], unknown: Option<bool>) -> (Vec<[f64; 2]>, Option<Share>) {
        let counts: Vec<[f64; 2]> =
            instances.iter().map(|instance| self.of_instance(instance, unknown)).collect();
        let share = Share::new(&counts, self.most(instances));
        (counts, share)
    }

    /// How many unknown cases could turn what was found: all are counted as misses, then all as hits.
    fn censored(&self, numbers: &[Number], outcome: Option<Outcome>) -> usize {
        let unknown = whole(numbers).unended;
        // How many events there would have been is not known even as a bound.
        if unknown == 0 || self.settings.hits == Hits::Events {
            return unknown;
        }
        // All that the share may be: anything from the one interval to the other.
        let ends: Vec<Interval> = ended(numbers).collect();
        let turned = match &ends[..] {
            [none, all] => self.outcome(Interval::new(none.low, all.high)) != outcome,
            _ => false,
        };
        if turned { unknown } else { 0 }
    }

    fn outcome(&self, interval: Interval) -> Option<Outcome> {
        let [low, high] = self.settings.accepted?;
        let accepted = Interval::new(low, high);
        Some(if accepted.contains(interval.low) && accepted.contains(interval.high) {
            Outcome::Holds
        } else if accepted.meets(interval) {
            Outcome::Open
        } else {
            Outcome::Fails
        })
    }

    /// A trial of the kind that is too rare or too frequent; where the share is accepted, of the rarer kind.
    fn shown(&self, evidence: &Evidence<'_>, instances: &[Instance<'_>], share: f64) -> Option<String> {
        let is_miss_shown = match self.settings.accepted {
            Some([low, _]) if share < low => true,
            Some([_, high]) if share > high => false,
            _ => share > 0.5,
        };
        let counted = || cases(instances).filter(|case| self.counts(case).is_some());
        let is_shown = |case: &&Case<'_>| {
            self.counts(case).is_some_and(|[hits, chances]| (hits < chances) == is_miss_shown)
        };
        self.selection.trial(evidence, counted().find(is_shown).or_else(|| counted().next()))
    }
}

impl Counted<'_> {
    /// What is counted, in words.
    fn description(&self) -> String {
        if let Some(bound) = self.settings.bound {
            if self.settings.hits == Hits::SolvedAtLeast {
                return format!("{} {} % of its cases", self.settings.hits.label(), computed(100.0 * bound));
            }
            let metric = self.selection.metric.map_or("", |metric| &metric.label).to_lowercase();
            return format!("trials with {metric} above {bound}");
        }
        let named = self.settings.columns.join(" and ");
        let hits = self.settings.hits.label();
        if named.is_empty() { hits.to_owned() } else { format!("{hits} ({named})") }
    }

    fn because(&self, share: &Share, &Number { hits, chances, .. }: &Number) -> String {
        let [low, high] = share.interval.map_or([f64::NAN; 2], |i| [100.0 * i.low, 100.0 * i.high]);
        let interval =
            if low.is_nan() { String::new() } else { format!(" (95 % interval {low:.2} to {high:.2})") };
        let accepted = self.settings.accepted.map_or_else(String::new, |[least, most]| {
            format!("; accepted {} to {} %", computed(100.0 * least), computed(100.0 * most))
        });
        let who = self.selection.description();
        let what = self.description();
        let percent = 100.0 * share.value;
        format!("{who}: {what} {hits} of {chances}, {percent:.2} %{interval}{accepted}")
    }
}

impl Counted<'_> {
    /// Why paths were refused, where those are counted: the verifier's words without numbers, the most frequent first.
    fn refusals(&self, instances: &[Instance<'_>]) -> Option<String> {
        let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
        for case in
            cases(instances).filter(|case| self.settings.hits == Hits::Rejected && case.row.is_returned())
        {
            if let Some(reason) = &case.row.reason {
                *kinds.entry(without_numbers(reason)).or_default() += 1;
            }
        }
        let mut kinds: Vec<(String, usize)> = kinds.into_iter().collect();
        kinds.sort_by_key(|(_, count)| Reverse(*count));
        let refusals: Vec<String> = kinds.iter().map(|(kind, count)| format!("{kind} ({count})")).collect();
        (!refusals.is_empty())
            .then(|| format!("refused because, first fault of each path: {}", refusals.join("; ")))
    }
}

/// By how many a case is solved more than by the other contender; what did not end counts as solved by this one alone, or by the other
/// alone, if that is `unknown`.
fn solved_more(case: &Case<'_>, unknown: Option<bool>) -> i32 {
    let solved = |row: &Row, unended: bool| i32::from(row.is_solved() || is_unended(row) && unended);
    let base = case.base.map_or(0, |base| solved(base, unknown == Some(false)));
    solved(case.row, unknown == Some(true)) - base
}

/// `text` with an n for every number.
fn without_numbers(text: &str) -> String {
    let mut found = String::new();
    for word in text.split_inclusive(' ') {
        let number = word.trim_matches(|c: char| !c.is_ascii_alphanumeric() && c != '-');
        let is_number = number.ends_with(|c: char| c.is_ascii_digit()) && number.parse::<f64>().is_ok();
        found += &if is_number { word.replacen(number, "n", 1) } else { word.to_owned() };
    }
    found
}

impl Criterion for Counted<'_> {
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number> {
        let instances = self.selection.instances(evidence);
        let unended = cases(&instances).filter(|case| self.is_unknown(case)).count();
        let (counts, share) = self.share(&instances, None);
        let mut numbers =
            vec![Share::counted(share, &counts, Number { unended, ..Number::of_cases(&instances) })];
        if unended > 0 && self.settings.hits != Hits::Events {
            let interval = |is_hit| self.share(&instances, Some(is_hit)).1.and_then(|share| share.interval);
            if let Some((none, all)) = interval(false).zip(interval(true)) {
                numbers.extend([Number::ended(Ends::Least, none), Number::ended(Ends::Most, all)]);
            }
        }
        numbers
    }

    fn weigh(&self, numbers: &[Number]) -> CriterionResult {
        let all = whole(numbers);
        let undecided = self.settings.accepted.map(|_| Outcome::Open);
        let Some(share) = Share::from_number(all) else {
            let because =
                format!("{}: nothing to count {} among", self.selection.description(), self.description());
            return CriterionResult { outcome: undecided, ..CriterionResult::open(because) };
        };
        let outcome = share.interval.map_or(undecided, |interval| self.outcome(interval));
        let description = self.description();
        // Marks and events of other columns are the same kind of number; those beyond other bounds are not.
        let subject = self.settings.bound.map_or(self.settings.hits.label(), |_| description.as_str());
        let ours = share.estimate(&description).measures(Quantity::Share, subject);
        CriterionResult {
            outcome,
            ours: Some(ours.of_cases(all.cases())),
            about_interval: SHARE_INTERVAL.to_owned(),
            because: std::iter::once(self.because(&share, all)).chain(self.outside(all.outside)).collect(),
            limits: self.settings.accepted.map_or_else(Vec::new, |accepted| accepted.to_vec()),
            units: "instances",
            censored: self.censored(numbers, outcome),
            needs: needs(share.instances).filter(|_| !share.is_exact),
            narrows: narrows(share.is_agreed),
            ..CriterionResult::default()
        }
    }

    fn show(&self, evidence: &Evidence<'_>, numbers: &[Number], found: &mut CriterionResult) {
        let Some(share) = whole(numbers).value else { return };
        let instances = self.selection.instances(evidence);
        found.trial = self.shown(evidence, &instances, share);
        found.because.extend(self.refusals(&instances));
        found.because.extend(not_posed(&self.selection, evidence));
    }

    fn selections(&self) -> Vec<&Selection<'_>> {
        vec![&self.selection]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refusals_of_one_kind_read_alike() {
        for (text, kind) in [
            (
                "leg 4: joint 6 is outside its limits at -360.648° at 22.4 % of the way",
                "leg n: joint n is outside its limits at n° at n % of the way",
            ),
            ("leg 5: part 5 touches obstacle 6 at 38.7 %", "leg n: part n touches obstacle n at n %"),
            ("it cuts the corner of `wall2` (3, 4)", "it cuts the corner of `wall2` (n, n)"),
            ("", ""),
        ] {
            assert_eq!(without_numbers(text), kind);
        }
    }
}
