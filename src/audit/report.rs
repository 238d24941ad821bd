//! Runs every check on an input. Each application is reported with its finding, the readings of the digits, its power,
//! the change that would mend it, and whether the table's ranking depends on it.

mod doubt;
mod effort;
mod mend;
mod strength;
mod unseen;

pub use mend::Mend;
pub use strength::Power;
pub use unseen::Unseen;

use super::checks::{Entry, Proof, REGISTRY, Test};
use super::input::Input;
use super::named_check;
use super::table::{Fault, Place};
use super::witness::{Budget, Witness};
use doubt::{doubts, is_of_true_summary};
use effort::Effort;
use mend::Refusal;
use proofs::exact::Print;
use proofs::printed::Digits;
use std::collections::BTreeMap;
use strength::power;
use unseen::Seen;

/// What a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// No data could print this under the premises; there is a certificate.
    Impossible,
    /// A reason to look, and no proof.
    Signal,
    /// Not decided: too many digits or too many cases for exact arithmetic.
    Unchecked,
    /// Some data print this.
    Possible,
}

impl Class {
    /// In one word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Impossible => "impossible",
            Self::Signal => "signal",
            Self::Unchecked => "not checked",
            Self::Possible => "possible",
        }
    }
}

/// What a check found in one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The check's name in the registry.
    pub check: &'static str,
    /// What it is.
    pub class: Class,
    /// Where the first number stands.
    pub place: Place,
    /// What the first number is called.
    pub name: String,
    /// What holds, with the numbers that show it.
    pub text: String,
    /// What it rests on.
    pub premises: Vec<String>,
    /// The readings of the digits, the same for all numbers involved, that allow it.
    pub readings: Vec<&'static str>,
    /// How much the check can refuse here.
    pub power: Option<Power>,
    /// What would mend it.
    pub mend: Option<Mend>,
    /// Whether the budget did not allow to look for power and a mend.
    pub is_cut_short: bool,
    /// Other findings with the same cause, which that change mends too.
    pub follows: Vec<String>,
    /// The proof, as a certificate.
    pub certificate: Option<serde_json::Value>,
    /// Data behind it.
    pub witness: Option<Witness>,
}

/// What one check did on the whole input.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    /// Applications.
    pub applied: usize,
    /// Of them impossible.
    pub impossible: usize,
    /// Of them signals.
    pub signals: usize,
    /// Of these, those whose cause is another finding.
    pub follows: usize,
    /// Of them not decided.
    pub unchecked: usize,
    /// Sum of the powers that were computed …
    pub power_sum: f64,
    /// … and their number.
    pub powers: usize,
}

/// How an audit is made.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Whether findings that are possible are kept.
    pub keeps_possible: bool,
    /// Whether power and mends are left out, which take most of the time.
    pub skips_power: bool,
    /// Whether certificates are left out, which take most of the memory: some kilobytes a finding.
    pub skips_certificates: bool,
    /// The effort of the search for data behind what is possible; `None` for no search.
    pub witness: Option<Budget>,
}

/// The result of an audit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    /// What was found, in the order of places.
    pub findings: Vec<Finding>,
    /// What each check did.
    pub tally: BTreeMap<&'static str, Tally>,
    /// Columns and samples that no check looked at.
    pub unseen: Vec<Unseen>,
    /// Findings whose power or least change the budget did not allow.
    pub cut_short: usize,
}

impl Report {
    /// Whether something is impossible.
    pub fn has_impossible(&self) -> bool {
        self.findings.iter().any(|finding| finding.class == Class::Impossible)
    }
}

/// How many printable values are tried one by one; of more, that many are sampled.
const PRINTS: i128 = 1000;
/// The same where power differs from cell to cell.
const PRINTS_EACH: i128 = 200;
/// Applications of a check whose power is computed if nothing is wrong with them.
const POWERS: usize = 100;

/// Runs every check on `input`.
///
/// # Errors
/// Every relation that is wrong, with its place.
pub fn audit(input: &Input, options: &Options) -> Result<Report, Vec<Fault>> {
    let mut run = Run {
        input,
        options,
        report: Report::default(),
        powers: BTreeMap::new(),
        seen: Seen::default(),
        refusals: Vec::new(),
        effort: Effort::default(),
    };
    for entry in REGISTRY {
        (entry.tests)(input, &mut |test| run.take(entry, test, false));
    }
    let mut faults = Vec::new();
    for relation in &input.relations {
        match named_check::test(relation, input) {
            Ok((entry, test)) => run.take(entry, test, true),
            Err(fault) => faults.push(fault),
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    for (check, class) in mend::one_a_cause(&mut run.report.findings, run.refusals) {
        let tally = run.report.tally.entry(check).or_default();
        tally.follows += 1;
        match class {
            Class::Impossible => tally.impossible -= 1,
            _ => tally.signals -= 1,
        }
    }
    run.report.unseen = run.seen.others(input);
    run.report.findings.sort_by(|a, b| (a.place, a.class, a.check).cmp(&(b.place, b.class, b.check)));
    Ok(run.report)
}

struct Run<'a> {
    input: &'a Input,
    options: &'a Options,
    report: Report,
    powers: BTreeMap<String, Option<Power>>,
    seen: Seen,
    refusals: Vec<Refusal>,
    effort: Effort,
}

/// What is known of a test when its finding is written.
struct TestOutcome {
    class: Class,
    answer: Option<bool>,
    is_odd: bool,
    readings: Vec<&'static str>,
    power: Option<Power>,
    proof: Option<Proof>,
    slip: Option<String>,
}

impl Run<'_> {
    fn take(&mut self, entry: &'static Entry, boxed: Box<dyn Test>, is_written: bool) {
        let test = boxed.as_ref();
        self.seen.take(test);
        let prints: Vec<Print> = test.numbers().iter().map(|number| number.print).collect();
        let answer = self.effort.decide(test, &prints);
        if answer == Some(false) && !is_written && is_of_true_summary(self.input, test) {
            return;
        }
        let readings = if test.is_about_digits() && answer.is_some() {
            self.allowing(test, &prints)
        } else {
            Vec::new()
        };
        let is_free = prints.iter().all(|print| print.digits == Digits::Any);
        let is_odd =
            is_free && answer == Some(true) && test.is_about_digits() && !readings.contains(&"nearest");
        let slip = if answer == Some(false) { test.float_slip(&prints) } else { None };
        let is_doubted = answer != Some(false) || slip.is_some() || !doubts(self.input, test).is_empty();
        let proof = if is_doubted { None } else { test.proof(&prints) };
        let class = match answer {
            None => Class::Unchecked,
            Some(false) if proof.is_some() => Class::Impossible,
            Some(false) => Class::Signal,
            Some(true) if is_odd => Class::Signal,
            Some(true) => Class::Possible,
        };
        let applied = self.report.tally.get(entry.name).map_or(0, |tally| tally.applied);
        let power =
            (!self.options.skips_power && answer.is_some() && (class < Class::Unchecked || applied < POWERS))
                .then(|| self.power(entry, test, &prints))
                .flatten();
        let power = power.map(|power| match answer {
            Some(false) => power.beside_a_refusal(prints[0].printed),
            _ => power,
        });
        self.count(entry.name, class, power);
        if class != Class::Possible || self.options.keeps_possible || self.options.witness.is_some() {
            let outcome = TestOutcome { class, answer, is_odd, readings, power, proof, slip };
            self.add_finding(entry.name, test, &prints, outcome);
        }
        if answer == Some(false) {
            let finding = self.report.findings.len() - 1;
            self.refusals.push(Refusal { finding, test: boxed, is_written });
        }
    }

    /// Adds what was found about `test` to the findings.
    fn add_finding(&mut self, check: &'static str, test: &dyn Test, prints: &[Print], outcome: TestOutcome) {
        let TestOutcome { class, answer, is_odd, readings, power, proof, slip } = outcome;
        let first = &test.numbers()[0];
        let mut text = match answer {
            Some(is_possible) => test.sentence(prints, is_possible),
            None if self.effort.is_spent(test) => format!("not decided: {}", effort::spent()),
            None => format!("not decided: {}", test.undecided(prints)),
        };
        if answer == Some(false) {
            text += as_typed(test, prints);
        }
        text.extend(slip.map(|slip| format!("; {slip}")));
        if is_odd {
            text += &format!("; not if digits are rounded to nearest, only by: {}", listed(&readings));
        }
        let mut budget = self.options.witness.clone();
        let witness = match (answer, budget.as_mut()) {
            (Some(true), Some(budget)) => test.witness(prints, budget),
            _ => None,
        };
        let written = proof.filter(|_| !self.options.skips_certificates);
        let certificate = written.map(|proof| super::certificate::certificate(check, test, prints, &proof));
        let is_mended = answer == Some(false) && !self.options.skips_power;
        let mend = is_mended.then(|| mend::least(self.input, test, prints, &self.effort)).flatten();
        let is_cut_short = is_mended && mend.is_none() && self.effort.is_used_up();
        self.report.cut_short += usize::from(is_cut_short);
        let mut premises = test.premises();
        premises.extend(doubts(self.input, test));
        self.report.findings.push(Finding {
            check,
            class,
            place: first.place,
            name: first.name.clone(),
            text,
            premises,
            readings,
            power,
            mend,
            is_cut_short,
            follows: Vec::new(),
            certificate,
            witness,
        });
    }

    fn count(&mut self, check: &'static str, class: Class, power: Option<Power>) {
        let tally = self.report.tally.entry(check).or_default();
        tally.applied += 1;
        tally.impossible += usize::from(class == Class::Impossible);
        tally.signals += usize::from(class == Class::Signal);
        tally.unchecked += usize::from(class == Class::Unchecked);
        if let Some(power) = power {
            tally.power_sum += power.share();
            tally.powers += 1;
        }
    }

    fn power(&mut self, entry: &Entry, test: &dyn Test, prints: &[Print]) -> Option<Power> {
        let Some(key) = test.power_key() else {
            return power(test, prints, test.power_prints().unwrap_or(PRINTS_EACH), &self.effort);
        };
        let first = prints[0];
        let key = format!("{} {key} {} {:?}", entry.name, first.printed.decimals(), first.digits);
        *self.powers.entry(key).or_insert_with(|| power(test, prints, PRINTS, &self.effort))
    }

    /// The readings of the digits, one for all numbers, that allow `prints`.
    fn allowing(&self, test: &dyn Test, prints: &[Print]) -> Vec<&'static str> {
        let uniform =
            Digits::NAMED.iter().filter(|(_, digits)| !matches!(digits, Digits::Any | Digits::Unknown));
        let allows = uniform.filter(|(_, digits)| {
            let read: Vec<Print> = prints.iter().map(|print| Print { digits: *digits, ..*print }).collect();
            self.effort.decide(test, &read) == Some(true)
        });
        allows.map(|(name, _)| *name).collect()
    }
}

/// Whether what is impossible with the zeros that were left out is so as typed, in words; nothing if no zeros were.
fn as_typed(test: &dyn Test, prints: &[Print]) -> &'static str {
    let typed: Vec<Print> =
        prints.iter().map(|print| Print { printed: print.printed.as_typed(), ..*print }).collect();
    if typed.iter().zip(prints).all(|(typed, print)| typed.printed.decimals() == print.printed.decimals()) {
        return "";
    }
    match test.is_possible(&typed) {
        Some(true) => "; possible if the digits as typed are all there are",
        Some(false) => "; impossible as well if the digits as typed are all there are",
        None => "",
    }
}

fn listed(names: &[&str]) -> String {
    if names.is_empty() { "a mixture of ways".to_owned() } else { names.join(", ") }
}
