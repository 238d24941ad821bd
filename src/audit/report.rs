//! Runs every check on an input and says of each application what was found, under which readings of the digits, with
//! which power, what would mend it, and whether the table's ranking hangs on it.

use super::asked;
use super::checks::{Entry, Proof, REGISTRY, Test, Window};
use super::exact::{Exact, Print, ceil, floor, whole};
use super::input::Input;
use super::printed::{Digits, Printed};
use super::table::{Fault, Place};
use super::witness::{Budget, Witness};
use std::collections::BTreeMap;

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

/// The share of printable values that a check would have refused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Power {
    /// The least printable value that was tried …
    pub low: Printed,
    /// … and the greatest.
    pub high: Printed,
    /// How many were tried: all of them, or a spread-out sample.
    pub tried: usize,
    /// How many of them the check refuses.
    pub refused: usize,
    /// Why this range.
    pub why: &'static str,
}

impl Power {
    /// The share refused.
    pub fn share(self) -> f64 {
        self.refused as f64 / self.tried.max(1) as f64
    }
}

/// The least change of one printed number that makes the finding possible.
#[derive(Debug, Clone, PartialEq)]
pub struct Mend {
    /// Which number.
    pub name: String,
    /// As printed.
    pub from: Printed,
    /// As it would have to be.
    pub to: Printed,
    /// Whether the order of the rows by that column changes with it; none where there is no column.
    pub changes_ranking: Option<bool>,
}

/// What a check found in one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The check.
    pub check: &'static str,
    /// What it is.
    pub class: Class,
    /// Where the first number stands.
    pub place: Place,
    /// What the first number is called.
    pub name: String,
    /// What holds, with the numbers that show it.
    pub said: String,
    /// What it rests on.
    pub premises: Vec<String>,
    /// The readings of the digits, the same for all numbers involved, that allow it.
    pub readings: Vec<&'static str>,
    /// How much the check can refuse here.
    pub power: Option<Power>,
    /// What would mend it.
    pub mend: Option<Mend>,
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
    /// The search for data behind what is possible; none if it is not asked for.
    pub witness: Option<Budget>,
}

/// The result of an audit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    /// What was found, in the order of places.
    pub findings: Vec<Finding>,
    /// What each check did.
    pub tally: BTreeMap<&'static str, Tally>,
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
/// How many changed prints are tried for a mend.
const MENDS: i64 = 2000;

/// Runs every check on `input`.
///
/// # Errors
/// Every relation that is wrong, with its place.
pub fn audit(input: &Input, options: &Options) -> Result<Report, Vec<Fault>> {
    let mut run = Run { input, options, report: Report::default(), powers: BTreeMap::new() };
    for entry in REGISTRY {
        (entry.tests)(input, &mut |test| run.take(entry, test.as_ref()));
    }
    let mut faults = Vec::new();
    for relation in &input.relations {
        match asked::test(relation, input) {
            Ok((entry, test)) => run.take(entry, test.as_ref()),
            Err(fault) => faults.push(fault),
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    run.report.findings.sort_by(|a, b| (a.place, a.class, a.check).cmp(&(b.place, b.class, b.check)));
    Ok(run.report)
}

struct Run<'a> {
    input: &'a Input,
    options: &'a Options,
    report: Report,
    powers: BTreeMap<String, Option<Power>>,
}

/// What is known of a test when its finding is written.
struct Told {
    class: Class,
    answer: Option<bool>,
    is_odd: bool,
    readings: Vec<&'static str>,
    power: Option<Power>,
    proof: Option<Proof>,
}

impl Run<'_> {
    fn take(&mut self, entry: &'static Entry, test: &dyn Test) {
        let prints: Vec<Print> = test.numbers().iter().map(|number| number.print).collect();
        let answer = test.is_possible(&prints);
        let readings = if test.is_about_digits() { allowing(test, &prints) } else { Vec::new() };
        let is_free = prints.iter().all(|print| print.digits == Digits::Any);
        let is_odd =
            is_free && answer == Some(true) && test.is_about_digits() && !readings.contains(&"nearest");
        let proof = if answer == Some(false) { test.proof(&prints) } else { None };
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
        self.count(entry.name, class, power);
        if class != Class::Possible || self.options.keeps_possible || self.options.witness.is_some() {
            let finding = Told { class, answer, is_odd, readings, power, proof };
            self.tell(entry.name, test, &prints, finding);
        }
    }

    /// Adds what was found about `test` to the findings.
    fn tell(&mut self, check: &'static str, test: &dyn Test, prints: &[Print], told: Told) {
        let Told { class, answer, is_odd, readings, power, proof } = told;
        let first = &test.numbers()[0];
        let mut said = match answer {
            Some(is_possible) => test.said(prints, is_possible),
            None => format!("not decided: {}", test.undecided(prints)),
        };
        if answer == Some(false) {
            said += as_typed(test, prints);
        }
        if is_odd {
            said += &format!("; not if digits are rounded to nearest, only by: {}", listed(&readings));
        }
        let mut budget = self.options.witness.clone();
        let witness = match (answer, budget.as_mut()) {
            (Some(true), Some(budget)) => test.witness(prints, budget),
            _ => None,
        };
        let certificate = proof.map(|proof| super::certificate::of(check, test, prints, &proof));
        let mend =
            (answer == Some(false) && !self.options.skips_power).then(|| self.mend(test, prints)).flatten();
        self.report.findings.push(Finding {
            check,
            class,
            place: first.place,
            name: first.name.clone(),
            said,
            premises: test.premises(),
            readings,
            power,
            mend,
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
            return power(test, prints, test.power_prints().unwrap_or(PRINTS_EACH));
        };
        let first = prints[0];
        let key = format!("{} {key} {} {:?}", entry.name, first.printed.decimals(), first.digits);
        *self.powers.entry(key).or_insert_with(|| power(test, prints, PRINTS))
    }

    /// The least change, in units of the last place, of one number.
    fn mend(&self, test: &dyn Test, prints: &[Print]) -> Option<Mend> {
        let tries = MENDS / (2 * prints.len().max(1) as i64);
        let (index, to) = (1..=tries).find_map(|by| {
            (0..prints.len()).find_map(|index| {
                [by, -by].into_iter().find_map(|by| {
                    let printed = prints[index].printed;
                    let changed = printed.with_units(printed.units().checked_add(by)?)?;
                    let mut all = prints.to_vec();
                    all[index].printed = changed;
                    (test.is_possible(&all) == Some(true)).then_some((index, changed))
                })
            })
        })?;
        let number = &test.numbers()[index];
        let changes_ranking =
            number.cell.and_then(|cell| self.changes_ranking(cell, number.print.printed, to));
        Some(Mend { name: number.name.clone(), from: number.print.printed, to, changes_ranking })
    }

    fn changes_ranking(&self, [table, row, column]: [usize; 3], from: Printed, to: Printed) -> Option<bool> {
        let table = self.input.tables.get(table)?;
        if table.columns.iter().any(|column| column.meaning.kind == super::meaning::Kind::Statistics) {
            return None;
        }
        let value = |printed: Printed| Print { printed, digits: Digits::Rounded }.value();
        let mut others = (0..table.rows.len()).filter(|other| *other != row);
        let (from, to) = (value(from), value(to));
        Some(others.any(|other| {
            let Some(other) = table.print(other, column) else { return false };
            from.cmp(&other.value()) != to.cmp(&other.value())
        }))
    }
}

/// The readings of the digits, one for all numbers, that allow `prints`.
fn allowing(test: &dyn Test, prints: &[Print]) -> Vec<&'static str> {
    let uniform = Digits::NAMED.iter().filter(|(_, digits)| !matches!(digits, Digits::Any | Digits::Unknown));
    let allows = uniform.filter(|(_, digits)| {
        let read: Vec<Print> = prints.iter().map(|print| Print { digits: *digits, ..*print }).collect();
        test.is_possible(&read) == Some(true)
    });
    allows.map(|(name, _)| *name).collect()
}

/// How much of what could be printed instead of the first number the test refuses.
pub fn power(test: &dyn Test, prints: &[Print], most: i128) -> Option<Power> {
    let first = prints[0].printed;
    let (low, high, why) = window(test, first)?;
    let count = i128::from(high - low) + 1;
    let is_sampled = count > most;
    let (mut tried, mut refused) = (0, 0);
    let mut all = prints.to_vec();
    for index in 0..count.min(most) {
        // Multiples of the golden section spread evenly and fall in step with no grid.
        let share = (index as f64 * 0.618_033_988_749_894_9).fract();
        let at = if is_sampled { (share * count as f64) as i64 } else { index as i64 };
        let Some(printed) = first.with_units(low + at) else { continue };
        all[0].printed = printed;
        tried += 1;
        refused += usize::from(test.is_possible(&all) == Some(false));
    }
    let end = |units| Printed::from_units(units, first.decimals());
    Some(Power { low: end(low), high: end(high), tried, refused, why })
}

/// The least and the greatest print of the first number, in units of its last place, and why these.
pub fn window(test: &dyn Test, first: Printed) -> Option<(i64, i64, &'static str)> {
    let limit = 10_i64.pow(15) - 1;
    let (low, high, why) = if let Some(Window { ends: [low, high], why }) = test.window() {
        let units = |end: Exact| super::exact::mul(end, whole(first.scale()));
        (i64::try_from(ceil(units(low)?)).ok()?, i64::try_from(floor(units(high)?)).ok()?, why)
    } else {
        let around = first.units().abs().max(100);
        let why = if first.units().abs() < 100 {
            "100 units of the last place to either side"
        } else {
            "as far to either side as it is from 0"
        };
        (first.units() - around, first.units() + around, why)
    };
    let (low, high) = (low.max(-limit), high.min(limit));
    (low <= high).then_some((low, high, why))
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

#[cfg(test)]
mod pages;
#[cfg(test)]
mod power;
#[cfg(test)]
mod said;
#[cfg(test)]
mod simulation;
#[cfg(test)]
mod tests;
