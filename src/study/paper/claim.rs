//! What a paper says: claims, what they ask, and the claims that they are made of.

use super::{Digits, Interpretation};
use base::settings::{AnyTable, Document, Faults, Settings, SettingsError, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;
use toml::Table;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ClaimSpec {
    /// Its name.
    pub(super) id: Spanned<String>,
    /// Where it stands in the paper.
    pub(super) at: String,
    /// The sentence, where it is not a number alone.
    pub(super) says: Option<String>,
    /// The paper's own words, where they are given word for word.
    pub(super) quote: Option<String>,
    /// The number as printed, digits and all.
    pub(super) printed: Option<Spanned<String>>,
    /// The number's unit; absent if the paper gives none.
    pub(super) unit: Option<String>,
    /// How the number's digits end, where the claim says so; otherwise the interpretation decides.
    pub(super) digits: Option<Digits>,
    /// What the paper leaves out, if that makes it untestable; checks then only show what can be shown.
    pub(super) untestable: Option<String>,
    /// Why it must hold whatever the paper says, if it must: it is then asserted, and no evidence for anything.
    pub(super) theorem: Option<String>,
    /// What was changed in how it is judged after a run had been seen, and why.
    pub(super) changed_after_run: Option<String>,
    /// The choices under some of whose options alone it is meant, each with those options: a premise that the paper states.
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
    /// The claims all of which the sentence says.
    #[serde(default)]
    pub(super) all_of: Vec<Spanned<String>>,
    /// The claims some one of which the sentence says.
    #[serde(default)]
    pub(super) any_of: Vec<Spanned<String>>,
    /// The claims one of which the sentence means, without saying which.
    #[serde(default)]
    pub(super) means_one_of: Vec<Spanned<String>>,
    /// The claims that are the cells of this row of a table.
    #[serde(default)]
    pub(super) cells: Vec<Spanned<String>>,
}

/// What the paper says.
#[derive(Debug, Clone)]
pub struct Claim {
    /// Its name.
    pub id: String,
    /// Where it stands in the paper.
    pub at: String,
    /// The sentence, where it is not a number alone.
    pub says: Option<String>,
    /// The paper's own words, where they are given word for word.
    pub quote: Option<String>,
    /// The number as printed.
    pub printed: Option<String>,
    /// The number's unit; absent if the paper gives none.
    pub unit: Option<String>,
    /// How the number's digits end, where the claim says so; otherwise the interpretation decides.
    pub digits: Option<Digits>,
    /// What the paper leaves out, if that makes it untestable; checks then only show what can be shown.
    pub untestable: Option<String>,
    /// Why it must hold whatever the paper says, if it must: it is then asserted, and no evidence for anything.
    pub theorem: Option<String>,
    /// What was changed in how it is judged after a run had been seen, and why.
    pub changed_after_run: Option<String>,
    /// The choices under some of whose options alone it is meant, each with those options.
    pub holds_when: BTreeMap<String, Vec<String>>,
    /// How it is judged, and what is shown beside: rules and criteria by name.
    asked: Vec<(Asked, String, Settings)>,
    /// The claims that it is made of.
    pub parts: Parts,
}

/// What a claim asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// A rule: arithmetic on printed numbers.
    Rule,
    /// A criterion that decides.
    Decides,
    /// A criterion that is shown and decides nothing.
    Shown,
}

/// The claims that a claim is made of; they count with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Parts {
    /// None.
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
    pub fn asked(&self) -> impl Iterator<Item = (Asked, &str, &Settings)> {
        self.asked.iter().map(|(asked, name, settings)| (*asked, name.as_str(), settings))
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
    pub fn asks_as(&self, other: &Self) -> bool {
        let asked = self.criteria().map(|(name, settings)| (name, settings.table()));
        self.printed == other.printed
            && asked.eq(other.criteria().map(|(name, settings)| (name, settings.table())))
    }

    /// Every criterion that decides or is shown, with its settings.
    pub fn criteria(&self) -> impl Iterator<Item = (&str, &Settings)> {
        let criteria = self.asked().filter(|(asked, ..)| *asked != Asked::Rule);
        criteria.map(|(_, name, settings)| (name, settings))
    }

    /// The settings of the criterion called `name` that it is judged by.
    pub fn check(&self, name: &str) -> Option<&Settings> {
        let mut decides = self.asked().filter(|(asked, own, _)| *asked == Asked::Decides && *own == name);
        decides.next().map(|(.., settings)| settings)
    }
}

/// The claim that `spec` writes; a number that is none and a claim that nothing can judge go to `faults`.
pub(super) fn claim(document: &Arc<Document>, spec: &ClaimSpec, faults: &mut Faults) -> Claim {
    let id = spec.id.get_ref();
    if let Some(printed) = &spec.printed
        && printed.get_ref().parse::<f64>().is_err()
    {
        let message = format!(
            "claim `{id}`: printed is `{}`; the digits of one number as the paper prints them are accepted",
            printed.get_ref()
        );
        faults.add(document.error(printed.span(), message));
        faults.unread(printed_by(id));
    }
    let parts = faults.keep(parts(document, spec)).unwrap_or(Parts::None);
    let asked = asked(document, spec);
    if asked.is_empty()
        && spec.untestable.is_none()
        && given(spec).next().is_none()
        && !document.is_part("claim")
    {
        let message = format!(
            "claim `{id}` needs `check`, `rule`, parts, or `untestable` with what the paper leaves out"
        );
        faults.add(document.error(spec.id.span(), message));
    }
    Claim {
        id: id.clone(),
        at: spec.at.clone(),
        says: spec.says.clone(),
        quote: spec.quote.clone(),
        printed: spec.printed.as_ref().map(|printed| printed.get_ref().clone()),
        unit: spec.unit.clone(),
        digits: spec.digits,
        untestable: spec.untestable.clone(),
        theorem: spec.theorem.clone(),
        changed_after_run: spec.changed_after_run.clone(),
        holds_when: spec.holds_when.clone(),
        asked,
        parts,
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

/// What the number that the claim `id` prints is called where it may be unread.
pub fn printed_by(id: &str) -> String {
    format!("printed by {id}")
}

fn asked(document: &Arc<Document>, spec: &ClaimSpec) -> Vec<(Asked, String, Settings)> {
    let one = |asked: Asked| {
        move |(name, table): (&String, &Spanned<Table>)| {
            (asked, name.clone(), Settings::written(document, table))
        }
    };
    let shown = spec.shows.iter().flat_map(|(name, tables)| tables.iter().map(move |table| (name, table)));
    let rules = spec.rule.iter().map(one(Asked::Rule));
    rules.chain(spec.check.iter().map(one(Asked::Decides))).chain(shown.map(one(Asked::Shown))).collect()
}

/// The kinds of parts that a claim is given, with their ids.
fn given(spec: &ClaimSpec) -> impl Iterator<Item = (&Vec<Spanned<String>>, fn(Vec<String>) -> Parts)> {
    let kinds = [
        (&spec.all_of, Parts::AllOf as fn(Vec<String>) -> Parts),
        (&spec.any_of, Parts::AnyOf),
        (&spec.means_one_of, Parts::MeansOneOf),
        (&spec.cells, Parts::Cells),
    ];
    kinds.into_iter().filter(|(ids, _)| !ids.is_empty())
}

fn parts(document: &Arc<Document>, spec: &ClaimSpec) -> Result<Parts, SettingsError> {
    let mut given = given(spec);
    match (given.next(), given.next()) {
        (None, _) => Ok(Parts::None),
        (Some((ids, of)), None) => Ok(of(ids.iter().map(|id| id.get_ref().clone()).collect())),
        _ => {
            let message = format!(
                "claim `{}`: one of `all_of`, `any_of`, `means_one_of` and `cells` is accepted",
                spec.id.get_ref()
            );
            Err(document.error(spec.id.span(), message))
        }
    }
}
