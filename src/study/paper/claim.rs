//! The claims of a paper: its sentences and cells, their tests, and their parts.

use super::{Digits, Interpretation};
use base::settings::{AnyTable, Document, Faults, Part, Place, Settings, SettingsError, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;
use toml::Table;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ClaimSpec {
    /// Its name, without the paper's.
    pub(super) id: Spanned<String>,
    /// Where it stands in the paper.
    pub(super) at: String,
    /// The sentence, where it is not a number alone.
    pub(super) says: Option<String>,
    /// The sentence in a few words, for the first screens.
    pub(super) short: Option<String>,
    /// The paper's own words, where they are given word for word.
    pub(super) quote: Option<String>,
    /// The number as printed, digits and all.
    pub(super) printed: Option<Spanned<String>>,
    /// The number's unit; absent if the paper gives none.
    pub(super) unit: Option<String>,
    /// How the number's digits end, where the claim says so; otherwise the interpretation decides.
    pub(super) digits: Option<Digits>,
    /// Whether it is one of the few claims that say what the paper is about.
    #[serde(default)]
    pub(super) headline: bool,
    /// What the paper leaves out, if the claim cannot be tested without it; checks then only show what can be shown.
    pub(super) untestable: Option<String>,
    /// Why it must hold whatever is drawn, if it must: it is then asserted, and counts as no evidence.
    pub(super) theorem: Option<String>,
    /// What was changed in how it is judged after a run had been seen, and why.
    pub(super) changed_after_run: Option<String>,
    /// Premises that the paper states: choices, each with the options under which alone the claim is meant.
    #[serde(default)]
    pub(super) holds_when: BTreeMap<String, Vec<String>>,
    /// How it is judged: the settings of each criterion, by the criterion's name.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, AnyTable>")]
    pub(super) check: BTreeMap<String, Spanned<Table>>,
    /// What is shown beside it and decides nothing: the settings of criteria, by the criterion's name.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Vec<AnyTable>>")]
    pub(super) shows: BTreeMap<String, Vec<Spanned<Table>>>,
    /// What arithmetic on printed numbers says of it: the settings of each rule, by the rule's name.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, AnyTable>")]
    pub(super) rule: BTreeMap<String, Spanned<Table>>,
    /// The claims that the sentence makes together.
    #[serde(default)]
    pub(super) all_of: Vec<Spanned<String>>,
    /// The claims that make the sentence true if one of them holds.
    #[serde(default)]
    pub(super) any_of: Vec<Spanned<String>>,
    /// The meanings that the sentence may have, each a claim; the paper does not say which it has.
    #[serde(default)]
    pub(super) means_one_of: Vec<Spanned<String>>,
}

impl ClaimSpec {
    /// The claims that it is made of, by the ways in which it can be.
    pub(super) fn kinds(&self) -> [&Vec<Spanned<String>>; 3] {
        [&self.all_of, &self.any_of, &self.means_one_of]
    }
}

/// What the paper says.
#[derive(Debug, Clone)]
pub struct Claim {
    /// Its name, without the paper's.
    pub id: String,
    /// Where it stands in the paper.
    pub at: String,
    /// The sentence, where it is not a number alone.
    pub says: Option<String>,
    /// The sentence in a few words, for the first screens.
    pub short: Option<String>,
    /// The paper's own words, where they are given word for word.
    pub quote: Option<String>,
    /// The number as printed.
    pub printed: Option<String>,
    /// The number's unit; absent if the paper gives none.
    pub unit: Option<String>,
    /// How the number's digits end, where the claim says so; otherwise the interpretation decides.
    pub digits: Option<Digits>,
    /// Whether it is one of the few claims that say what the paper is about.
    pub headline: bool,
    /// What the paper leaves out, if the claim cannot be tested without it; checks then only show what can be shown.
    pub untestable: Option<String>,
    /// Why it must hold whatever is drawn, if it must: it is then asserted, and counts as no evidence.
    pub theorem: Option<String>,
    /// Two claims whose printed numbers differ by this claim's number, the first less the second; the paper does not print it
    /// itself.
    pub difference: Option<[String; 2]>,
    /// What was changed in how it is judged after a run had been seen, and why.
    pub changed_after_run: Option<String>,
    /// Premises that the paper states: choices, each with the options under which alone the claim is meant.
    pub holds_when: BTreeMap<String, Vec<String>>,
    /// How it is judged, and what is shown beside: rules and criteria by name.
    pub(super) tests: Vec<(TestRole, String, Settings)>,
    /// The claims that it is made of.
    pub parts: Parts,
    /// Where it is written.
    pub written: Written,
}

/// Where a claim is written: keys and numbers of elements from 0, joined by dots.
#[derive(Debug, Clone)]
pub struct Written {
    /// Its own keys.
    pub own: String,
    /// Its name, or the cell that gives it one.
    pub id: String,
    /// The number that it prints.
    pub printed: String,
    /// Tables that say how it is judged, the one whose values win first.
    pub layers: Vec<String>,
}

impl Written {
    /// The row and the table that it is a cell of, if it is one.
    pub(super) fn around(&self) -> impl Iterator<Item = &str> {
        let row = self.own.split_once(".cell.").map(|(row, _)| row);
        row.into_iter().chain(row.and_then(|row| row.split_once(".row.")).map(|(table, _)| table))
    }

    /// As the claim that stands where `own` leads to.
    pub(super) fn claim(own: String) -> Self {
        Self { id: format!("{own}.id"), printed: format!("{own}.printed"), layers: vec![own.clone()], own }
    }
}

/// What a claim asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TestRole {
    /// A rule: arithmetic on printed numbers.
    Rule,
    /// A criterion that decides.
    Decides,
    /// A criterion that is shown and decides nothing.
    Shown,
}

impl TestRole {
    /// The key that the settings stand under in a claim.
    pub fn key(self) -> &'static str {
        match self {
            Self::Rule => "rule",
            Self::Decides => "check",
            Self::Shown => "shows",
        }
    }
}

/// The claims that a claim is made of; they count with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Parts {
    /// It stands by itself.
    None,
    /// A sentence that says all of them.
    AllOf(Vec<String>),
    /// A sentence that says some one of them.
    AnyOf(Vec<String>),
    /// A sentence that means one of them and does not say which.
    MeansOneOf(Vec<String>),
    /// The cells of a row of a table.
    Cells(Vec<String>),
}

impl Parts {
    /// Their ids.
    pub fn ids(&self) -> &[String] {
        match self {
            Self::None => &[],
            Self::AllOf(ids) | Self::AnyOf(ids) | Self::MeansOneOf(ids) | Self::Cells(ids) => ids,
        }
    }
}

impl Claim {
    /// Every rule and criterion with its settings.
    pub fn tests(&self) -> impl Iterator<Item = (TestRole, &str, &Settings)> {
        self.tests.iter().map(|(role, name, settings)| (*role, name.as_str(), settings))
    }

    /// The meanings that the sentence may have, a claim each, if it is judged by them and has no test of its own.
    pub fn meanings(&self) -> Option<&[String]> {
        match &self.parts {
            Parts::MeansOneOf(ids) if self.untestable.is_none() && self.tests.is_empty() => Some(ids),
            _ => None,
        }
    }

    /// Whether it is meant under `interpretation`: what it takes for granted holds there.
    pub fn is_meant(&self, interpretation: &Interpretation) -> bool {
        let taken = interpretation.options();
        let mut premises = self.holds_when.iter();
        premises.all(|(id, options)| taken.get(id).is_some_and(|option| options.contains(option)))
    }

    /// The names of the studies that its criteria look at.
    pub fn studies(&self) -> Vec<&str> {
        self.criteria().flat_map(|(_, settings)| studies_in(settings.table())).collect()
    }

    /// Whether it holds the same number against the same trials, in the same way.
    pub fn tests_alike(&self, other: &Self) -> bool {
        let criteria = self.criteria().map(|(name, settings)| (name, settings.table()));
        self.printed == other.printed
            && criteria.eq(other.criteria().map(|(name, settings)| (name, settings.table())))
    }

    /// Every criterion that decides or is shown, with its settings.
    pub fn criteria(&self) -> impl Iterator<Item = (&str, &Settings)> {
        let criteria = self.tests().filter(|(role, ..)| *role != TestRole::Rule);
        criteria.map(|(_, name, settings)| (name, settings))
    }

    /// The settings of the criterion called `name` that it is judged by.
    pub fn check(&self, name: &str) -> Option<&Settings> {
        let mut decides = self.tests().filter(|(role, own, _)| *role == TestRole::Decides && *own == name);
        decides.next().map(|(.., settings)| settings)
    }
}

/// The claim that `spec` writes as the one of this `number`; a number that is none and a claim that nothing can judge go to
/// `faults`. Among `cells` are those that a name ending in `.*` stands for.
pub(super) fn claim(
    document: &Arc<Document>,
    (number, spec): (usize, &ClaimSpec),
    cells: &[String],
    faults: &mut Faults,
) -> Claim {
    let id = spec.id.get_ref();
    if let Some(printed) = &spec.printed {
        check_printed(document, id, printed, faults);
    }
    let parts = faults.keep(parts(document, spec)).unwrap_or(Parts::None);
    let tests = tests(document, (number, spec), cells);
    if tests.is_empty() && spec.untestable.is_none() && given(spec).next().is_none() {
        let message = format!(
            "claim `{id}` needs `check`, `rule`, parts, or `untestable` with what the paper leaves out"
        );
        faults.add(document.error(spec.id.span(), message));
    }
    Claim {
        id: id.clone(),
        at: spec.at.clone(),
        says: spec.says.clone(),
        short: spec.short.clone(),
        quote: spec.quote.clone(),
        printed: spec.printed.as_ref().map(|printed| printed.get_ref().clone()),
        unit: spec.unit.clone(),
        digits: spec.digits,
        headline: spec.headline,
        untestable: spec.untestable.clone(),
        theorem: spec.theorem.clone(),
        difference: None,
        changed_after_run: spec.changed_after_run.clone(),
        holds_when: spec.holds_when.clone(),
        tests,
        parts,
        written: Written::claim(format!("claim.{number}")),
    }
}

/// The studies that settings name, at any depth.
fn studies_in(table: &Table) -> Vec<&str> {
    let mut found = Vec::new();
    for (key, value) in table {
        match value {
            toml::Value::String(name) if key == "study" => found.push(name.as_str()),
            toml::Value::Table(inner) => found.extend(studies_in(inner)),
            toml::Value::Array(all) => {
                found.extend(all.iter().filter_map(toml::Value::as_table).flat_map(studies_in));
            }
            _ => {}
        }
    }
    found
}

/// The words for the number that the claim `id` prints, where it may be unread.
pub fn printed_by(id: &str) -> String {
    format!("printed by {id}")
}

/// Refuses what the claim `id` prints unless it is a number.
pub(super) fn check_printed(
    document: &Arc<Document>,
    id: &str,
    printed: &Spanned<String>,
    faults: &mut Faults,
) {
    if printed.get_ref().parse::<f64>().is_err() {
        let message = format!(
            "claim `{id}`: printed is `{}`; the digits of one number as the paper prints them are accepted",
            printed.get_ref()
        );
        faults.add(document.error(printed.span(), message));
        faults.unread(printed_by(id));
    }
}

fn tests(
    document: &Arc<Document>,
    (number, spec): (usize, &ClaimSpec),
    cells: &[String],
) -> Vec<(TestRole, String, Settings)> {
    let number = number.to_string();
    let one = |role: TestRole, name: &String, table: &Spanned<Table>, index: Option<usize>| {
        let mut named = table.get_ref().clone();
        if !name_cells(&mut named, cells) {
            return (role, name.clone(), Settings::written(document, table));
        }
        let index = index.map(|index| index.to_string());
        let steps = ["claim", &number, role.key(), name].into_iter().chain(index.as_deref());
        let place = Place::of_table(document, &steps.collect::<Vec<_>>());
        let settings = Settings::layered(document, table.span(), vec![Part { place, key: None }], named);
        (role, name.clone(), settings)
    };
    let rules = spec.rule.iter().map(|(name, table)| one(TestRole::Rule, name, table, None));
    let checks = spec.check.iter().map(|(name, table)| one(TestRole::Decides, name, table, None));
    let shown = spec
        .shows
        .iter()
        .flat_map(|(name, tables)| tables.iter().enumerate().map(move |(index, table)| (name, index, table)));
    let shown = shown.map(|(name, index, table)| one(TestRole::Shown, name, table, Some(index)));
    rules.chain(checks).chain(shown).collect()
}

/// The ids that `name` stands for: those of `cells` that begin with it if it ends in `.*`, otherwise itself.
pub fn cells_named<'a>(name: &'a str, cells: &'a [String]) -> Vec<&'a str> {
    match name.strip_suffix('*').filter(|begin| begin.ends_with('.')) {
        Some(begin) => cells.iter().map(String::as_str).filter(|cell| cell.starts_with(begin)).collect(),
        None => vec![name],
    }
}

/// Puts the ids of cells in the place of names that end in `.*`, in lists under the key `claims`; whether there were any.
pub(super) fn name_cells(table: &mut Table, cells: &[String]) -> bool {
    let mut is_changed = false;
    for (key, value) in table {
        match value {
            toml::Value::Table(inner) => is_changed |= name_cells(inner, cells),
            toml::Value::Array(elements) if key == "claims" => {
                let named = |value: &toml::Value| match value.as_str() {
                    Some(name) => cells_named(name, cells).into_iter().map(Into::into).collect(),
                    None => vec![value.clone()],
                };
                let all: Vec<toml::Value> = elements.iter().flat_map(named).collect();
                is_changed |= all != *elements;
                *elements = all;
            }
            toml::Value::Array(elements) => {
                for inner in elements.iter_mut().filter_map(toml::Value::as_table_mut) {
                    is_changed |= name_cells(inner, cells);
                }
            }
            _ => {}
        }
    }
    is_changed
}

/// The kinds of parts that a claim is given, with their ids.
fn given(spec: &ClaimSpec) -> impl Iterator<Item = (&Vec<Spanned<String>>, fn(Vec<String>) -> Parts)> {
    let made: [fn(Vec<String>) -> Parts; 3] = [Parts::AllOf, Parts::AnyOf, Parts::MeansOneOf];
    let kinds = spec.kinds().into_iter().zip(made);
    kinds.filter(|(ids, _)| !ids.is_empty())
}

fn parts(document: &Arc<Document>, spec: &ClaimSpec) -> Result<Parts, SettingsError> {
    let mut given = given(spec);
    match (given.next(), given.next()) {
        (None, _) => Ok(Parts::None),
        (Some((ids, of)), None) => Ok(of(ids.iter().map(|id| id.get_ref().clone()).collect())),
        _ => {
            let message = format!(
                "claim `{}`: one of `all_of`, `any_of` and `means_one_of` is accepted",
                spec.id.get_ref()
            );
            Err(document.error(spec.id.span(), message))
        }
    }
}
