//! The tests of a claim under an interpretation: its criteria and rules, built; their numbers, and the outcome of
//! these.

use super::across::touched::Touched;
use super::censored::refused_share;
use super::context::Context;
use super::criterion::{self, Criterion, Entry, table_means};
use super::criterion_result::CriterionResult;
use super::evidence::{Evidence, Run};
use super::number::{Number, Numbers};
use super::outcome::{self, Caps, Outcome, Sessions};
use super::polylines::Polylines;
use super::rule;
use super::settle::settles;
use super::verdict::{CriterionFinding, Estimate};
use base::hash::sha256;
use base::settings::{Settings, SettingsError, in_first_words, none_called};
use study::paper::{Claim, Paper, Parts, TestRole};
use study::{Interpretation, Study};

/// A criterion or rule of a claim, built.
pub struct ClaimTest<'a> {
    role: TestRole,
    entry: &'static Entry,
    context: Context<'a>,
    criterion: Box<dyn Criterion + 'a>,
}

/// A finding, how the trials behind it came about, and what they are.
pub struct CappedFinding {
    /// The finding.
    pub finding: CriterionFinding,
    /// The printed number that is farthest from ours, in words.
    pub farthest: Option<String>,
    /// What lowers its outcome.
    pub caps: Caps,
    /// The share of the paths that come back which the verifier refuses.
    pub refused: f64,
    /// Whether trials of all studies that it looks at ran under the interpretation.
    pub is_covered: bool,
    /// Every problem group that it looks at could be posed.
    pub is_posed: bool,
    /// A hash of the results that it rests on, if it is wanted.
    pub results: String,
    /// The studies that it looks at.
    pub studies: Vec<String>,
}

/// Every criterion and rule of `claim`, built under `point`.
///
/// # Errors
/// One that does not exist, or whose settings are wrong.
pub fn claim_tests<'a>(
    paper: &'a Paper,
    claim: &'a Claim,
    point: &'a Interpretation,
) -> impl Iterator<Item = Result<ClaimTest<'a>, SettingsError>> {
    claim.tests().map(move |(role, name, settings)| {
        ClaimTest::new(role, name, Context { claim, settings, paper, point })
    })
}

impl<'a> ClaimTest<'a> {
    fn new(role: TestRole, name: &str, context: Context<'a>) -> Result<Self, SettingsError> {
        let (what, key, registry, found) = match role {
            TestRole::Rule => ("rule", "rule", rule::REGISTRY, rule::find(name)),
            TestRole::Decides => ("criterion", "check", criterion::REGISTRY, criterion::find(name)),
            TestRole::Shown => ("criterion", "shows", criterion::REGISTRY, criterion::find(name)),
        };
        let unknown = || {
            let known = registry.iter().map(|entry| entry.name);
            let message = format!("claim `{}`: {}", context.claim.id, none_called(what, name, known));
            context.error_at_name(key, name, message)
        };
        let entry = found.ok_or_else(unknown)?;
        Ok(Self { role, entry, criterion: (entry.build)(&context)?, context })
    }

    /// Whether it is shown alone.
    pub fn is_shown(&self) -> bool {
        self.role == TestRole::Shown
    }

    /// What it looks at.
    pub fn criterion(&self) -> &dyn Criterion {
        &*self.criterion
    }

    /// What its numbers are called.
    pub fn statistic(&self) -> &'static str {
        stripped(self.entry, self.context.settings).map_or("", |(statistic, _)| statistic)
    }

    /// The name of its numbers: a hash of everything that they depend on but for the trials. Margins, printed values and names of
    /// claims are not part of it. None of a rule.
    pub fn question(&self) -> Option<String> {
        let Context { paper, settings, .. } = self.context;
        let (statistic, own) = stripped(self.entry, settings)?;
        let of_other = |place: usize| {
            let Claim { untestable, difference, printed, digits, .. } = &paper.claims[place];
            let decides = paper.claims[place].tests().filter(|(role, ..)| *role == TestRole::Decides);
            let texts = decides.filter_map(|(_, name, settings)| stripped(criterion::find(name)?, settings));
            let texts: Vec<String> = texts.map(|(statistic, text)| format!("{statistic} {text}\n")).collect();
            // Where a number is looked for on problems that meet others, what those print decides which problems these are.
            let is_met = self.entry.name == criterion::EXISTS.name;
            let print = if is_met { format!(" {printed:?} {digits:?}") } else { String::new() };
            format!("{} {difference:?}{print}\n{}", untestable.is_some(), texts.concat())
        };
        // The text writes every name between quotes; in place of another claim's name stands what that claim asks.
        let meant = |text: &str| paper.place_of(text).map_or_else(|| text.to_owned(), of_other);
        let own: Vec<String> = own.split('"').map(meant).collect();
        Some(sha256(format!("{statistic} {}", own.join("\"")).as_bytes())[..16].to_owned())
    }

    /// Its numbers under the evidence's interpretation; with a hash of what they rest on only if `is_hashed`.
    pub fn numbers(&self, evidence: &Evidence<'_>, is_hashed: bool) -> Numbers {
        let criterion = &*self.criterion;
        let stored = || {
            criterion.studies().iter().filter_map(|study| evidence.run(&study.name)).map(Run::sessions).min()
        };
        let sessions = if criterion.is_clock() { stored().unwrap_or(0) } else { 0 };
        let others = (2..=sessions).map(|session| criterion.numbers(&evidence.in_session(session as u32)));
        let hash = || sha256(criterion.results(evidence).as_bytes())[..16].to_owned();
        Numbers {
            by_session: std::iter::once(criterion.numbers(evidence)).chain(others).collect(),
            sessions,
            is_covered: criterion.is_covered(evidence),
            is_posed: criterion.is_posed(evidence),
            refused: refused_share(&criterion.selections(), evidence),
            left_out: criterion
                .selections()
                .iter()
                .map(|selection| selection.unended_left_out(evidence))
                .sum(),
            trials: if is_hashed && !criterion.studies().is_empty() { hash() } else { String::new() },
        }
    }

    /// The outcome of the claim by `numbers`; `evidence` adds the trial that shows it.
    pub fn weighed(
        &self,
        numbers: &Numbers,
        polylines: &Polylines,
        evidence: Option<&Evidence<'_>>,
    ) -> CappedFinding {
        let criterion = &*self.criterion;
        let Context { paper, claim, point, .. } = self.context;
        let weigh = |one: &[Number]| {
            criterion.proof(polylines, evidence.is_some()).unwrap_or_else(|| criterion.weigh(one))
        };
        let first = &numbers.by_session[0];
        let mut found = weigh(first);
        if let Some(evidence) = evidence {
            criterion.show(evidence, first, &mut found);
        }
        found.censored += numbers.left_out;
        let clock = criterion.is_clock().then(|| {
            let each = numbers.by_session.iter().take(numbers.sessions).map(|one| weigh(one));
            let (agreement, because) = sessions(&each.collect::<Vec<_>>());
            found.because.extend(because);
            if !paper.choices.is_empty() {
                found.because.push("the clock was read under the defaults alone".to_owned());
            }
            if paper.source.ours { agreement } else { Sessions::OfAnother }
        });
        // Where nothing is drawn, no other instance could be: the number has no interval.
        if evidence.is_some() && Touched::by_test(paper, self.context.settings).draws_nothing(paper) {
            found.ours = found.ours.map(|ours| Estimate { interval: None, ..ours });
        }
        let studies = criterion.studies();
        let not_run = paper.not_run(claim, &studies);
        let caps = Caps {
            searched: studies.iter().any(|study| study.searched),
            fitted: is_fitted(paper, claim, &studies),
            existential: found.existential,
            powerless: found.powerless,
            censored: found.censored > 0,
            few: found.needs.is_some(),
            clock,
            without_premises: !claim.is_meant(point),
            not_run: !not_run.is_empty(),
        };
        found.premises.extend(premises(claim));
        let farthest = found.farthest.take();
        let mut finding = finding(self.entry.name, found, caps, &not_run);
        if self.is_shown() {
            (finding.outcome, finding.settles) = (None, None);
        }
        CappedFinding {
            finding,
            farthest,
            caps,
            refused: numbers.refused,
            is_covered: numbers.is_covered,
            is_posed: numbers.is_posed,
            results: numbers.trials.clone(),
            studies: studies.iter().map(|study| study.name.clone()).collect(),
        }
    }
}

/// What the numbers of a criterion are called, and its settings without what only weighs them, as text. None of a rule.
fn stripped(entry: &Entry, settings: &Settings) -> Option<(&'static str, String)> {
    let mut settings = settings.table().clone();
    let statistic = (entry.question)(&mut settings)?;
    let text = serde_json::to_value(in_first_words(&settings))
        .expect("settings are tables of plain values")
        .to_string();
    Some((statistic, text))
}

fn finding(criterion: &str, found: CriterionResult, caps: Caps, not_run: &[String]) -> CriterionFinding {
    let outcome = found.outcome.and_then(|outcome| outcome::of_finding(outcome, caps));
    let settles = (outcome == Some(Outcome::Open)).then(|| match not_run {
        [] => settles(&found, caps),
        options => format!("trials under what cannot be run here: {}", options.join("; ")),
    });
    let mut because = found.because;
    if caps.clock == Some(Sessions::OfAnother) {
        because.push("a time of the authors' on their machine: our clock does not test it; what is counted is a claim of its own".to_owned());
    }
    let is_met = matches!(outcome, Some(Outcome::Holds | Outcome::Fitted | Outcome::Attainable));
    because.extend(found.power.filter(|_| is_met));
    let has_interval = found.ours.as_ref().is_some_and(|ours| ours.interval.is_some());
    let about_interval = if has_interval { found.about_interval } else { String::new() };
    let ours = found.ours.map(|ours| Estimate { what: ours.what.clone() + &about_interval, ..ours });
    CriterionFinding {
        criterion: criterion.to_owned(),
        outcome,
        ours,
        trial: found.trial,
        settles,
        because,
        premises: found.premises,
    }
}

/// Whether something in `studies` was chosen to meet `claim`: it, the row or joint test that has it as a cell, a claim that repeats its
/// number, or both cells of its difference.
fn is_fitted(paper: &Paper, claim: &Claim, studies: &[&Study]) -> bool {
    let fitted = studies.iter().flat_map(|study| &study.fitted_to).filter_map(|id| paper.claim(id));
    let mut met = fitted.flat_map(|fitted| {
        let cells = match &fitted.parts {
            Parts::Cells(ids) => &ids[..],
            _ => &[],
        };
        let is_own = |id: &&String| paper.whole_of(id).is_some_and(|whole| whole.id == fitted.id);
        let joint = table_means::cells(fitted);
        let own = cells.iter().filter(is_own).chain(&joint).filter_map(|id| paper.claim(id));
        std::iter::once(fitted).chain(own).collect::<Vec<_>>()
    });
    let is_cell = |id: &String| paper.claim(id).is_some_and(|cell| is_fitted(paper, cell, studies));
    met.any(|met| met.tests_alike(claim))
        || claim.difference.as_ref().is_some_and(|cells| cells.iter().all(is_cell))
}

/// Where alone a claim is meant, an interpretation each.
pub(super) fn premises(claim: &Claim) -> impl Iterator<Item = String> {
    let listed = |(id, options): (&String, &Vec<String>)| format!("{id} is {}", options.join(" or "));
    claim.holds_when.iter().map(listed)
}

/// What the stored sessions of the clock say together, from what each `found` by itself, and that in words.
fn sessions(found: &[CriterionResult]) -> (Sessions, Option<String>) {
    let first = found.first().map(|found| found.outcome);
    let agreement = if found.len() < outcome::SESSIONS {
        Sessions::TooFew
    } else if found.iter().all(|found| Some(found.outcome) == first) {
        Sessions::Agree
    } else {
        Sessions::Disagree
    };
    let in_words = |ours: &Estimate| {
        let interval = ours.interval.map(|[low, high]| format!(" [{low:.2}, {high:.2}]"));
        format!("{:.2}{}", ours.value, interval.unwrap_or_default())
    };
    let numbers: Option<Vec<String>> = found.iter().map(|found| found.ours.as_ref().map(in_words)).collect();
    let because = numbers
        .filter(|numbers| !numbers.is_empty())
        .map(|numbers| format!("sessions of the clock, each judged by itself: {}", numbers.join("; ")));
    (agreement, because)
}
