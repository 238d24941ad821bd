//! The scope of a claim, and the choices that touch it: from the spec alone, so that an unexplored choice is known too.

use super::super::criterion::EXISTS;
use super::super::evidence::default_point;
use base::settings::Settings;
use std::collections::BTreeSet;
use study::paper::{Claim, Paper, TestRole};
use study::{Choice, Contender, Group, Study};
use toml::Value;

/// What the criteria of a claim, or of its parts, name.
#[derive(Default)]
pub struct Touched<'p> {
    /// The claim and its parts.
    claims: Vec<&'p Claim>,
    /// The studies.
    studies: Vec<&'p Study>,
    /// Every word of their settings: contenders, problem groups and metrics are among them.
    words: BTreeSet<&'p str>,
}

impl<'p> Touched<'p> {
    /// What `claim` looks at.
    pub fn new(paper: &'p Paper, claim: &'p Claim) -> Self {
        let parts = claim.parts.ids().iter().filter_map(|id| paper.claim(id));
        let claims: Vec<&Claim> = std::iter::once(claim).chain(parts).collect();
        let decides = |claim: &&'p Claim| claim.tests().filter(|(role, ..)| *role != TestRole::Shown);
        let settings = claims.iter().flat_map(decides).map(|(.., settings)| settings);
        Self { claims: claims.clone(), ..Self::by(paper, settings) }
    }

    /// What one criterion looks at.
    pub fn by_test(paper: &'p Paper, settings: &'p Settings) -> Self {
        Self::by(paper, std::iter::once(settings))
    }

    fn by(paper: &'p Paper, settings: impl Iterator<Item = &'p Settings>) -> Self {
        let mut names = BTreeSet::new();
        let mut words = BTreeSet::new();
        for (key, value) in settings.flat_map(Settings::table) {
            gather(key, value, &mut names, &mut words);
        }
        let studies = paper.studies.iter().filter(|study| names.contains(study.name.as_str())).collect();
        Self { claims: Vec::new(), studies, words }
    }

    /// Whether it looks at trials that were recorded elsewhere.
    pub fn is_elsewhere(&self) -> bool {
        self.studies.iter().any(|study| self.contenders(study).iter().any(|own| own.is_elsewhere()))
    }

    /// Whether it states a size that can be missed: a printed number, or a margin.
    pub fn states_size(&self) -> bool {
        const SIZES: [&str; 5] = ["by_percent", "margin", "margin_percent", "printed_ratio", "accepted"];
        self.claims.iter().any(|claim| {
            let has_size =
                |key: &&str| claim.tests().any(|(.., settings)| settings.table().contains_key(*key));
            claim.printed.is_some() || SIZES.iter().any(has_size)
        })
    }

    /// Whether it looks at trials at all: arithmetic on what is printed does not.
    pub fn looks_at_trials(&self) -> bool {
        !self.studies.is_empty()
    }

    /// Whether no seed decides anything of it: neither its problems nor a contender's trials.
    pub fn draws_nothing(&self, paper: &Paper) -> bool {
        self.studies.iter().all(|study| {
            let groups = self.groups(study);
            let contenders = self.contenders(study);
            // A study without contenders draws whatever its task draws.
            !contenders.is_empty()
                && !groups.iter().any(|group| group.is_drawn || group.instances > 1)
                && !contenders.iter().any(|own| draws(paper, study, own))
        })
    }

    /// Whether some voting option of `choice`, other than its default, changes the trials or numbers that the claim
    /// looks at.
    pub fn is_touched_by(&self, choice: &Choice) -> bool {
        others(choice).any(|option| self.is_meant_otherwise(choice, option))
            || self.studies.iter().any(|study| self.changes(choice, study))
    }

    /// Whether `choice` would change trials of a study that neither has it nor draws it, and no study explored in its
    /// place has it. A witness is judged under the interpretations that its contender ran under, whatever its study
    /// has.
    pub fn is_without(&self, paper: &Paper, choice: &Choice) -> bool {
        let has = |study: &Study| {
            study.choices.iter().any(|own| own.id == choice.id) || study.draws.contains(&choice.id)
        };
        let stands_for = |other: &&Study, study: &Study| {
            let explored = other.explore.as_ref().and_then(|explore| explore.stands_for.as_ref());
            explored == Some(&study.name)
        };
        let is_had = |study: &Study| {
            has(study) || paper.studies.iter().any(|other| stands_for(&other, study) && has(other))
        };
        let is_witness = |claim: &&Claim| {
            claim.tests().all(|(role, name, _)| role != TestRole::Decides || name == EXISTS.name)
        };
        !self.claims.iter().all(is_witness)
            && self.studies.iter().any(|study| !is_had(study) && self.changes(choice, study))
    }

    /// Whether some option of `choice` that votes changes trials of `study`.
    fn changes(&self, choice: &Choice, study: &'p Study) -> bool {
        others(choice).any(|option| self.runs_otherwise(choice, option, study))
    }

    /// Whether an option means another metric by a name of the claim's, or reads its printed digits otherwise.
    fn is_meant_otherwise(&self, choice: &Choice, option: &str) -> bool {
        let [own, default] = [option, &choice.default].map(|name| &choice.options[name]);
        let reads = |claim: &&Claim| claim.printed.is_some() && claim.digits.is_none();
        self.words.iter().any(|word| own.metric.get(*word) != default.metric.get(*word))
            || own.digits != default.digits && self.claims.iter().any(reads)
    }

    /// Whether an option changes trials of `study`, or would if it had not left the choice out.
    fn runs_otherwise(&self, choice: &Choice, option: &str, study: &'p Study) -> bool {
        // What a study measures without contenders, the choices alone touch that it has.
        if study.contenders.is_empty() && study.leaves_out.contains(&choice.id) {
            return false;
        }
        let mut contenders = self.contenders(study);
        contenders.retain(|contender| !contender.departs.contains_key(&choice.id));
        choice.moves(option, &self.groups(study), &contenders)
    }

    fn contenders(&self, study: &'p Study) -> Vec<&'p Contender> {
        named(&study.contenders, |contender| self.words.contains(contender.label.as_str()))
    }

    /// The problem groups of a study; a label that ends in `*` stands for all that begin so.
    fn groups(&self, study: &'p Study) -> Vec<&'p Group> {
        let begins = |word: &&str, group: &Group| {
            word.strip_suffix('*').is_some_and(|begin| group.label.starts_with(begin))
        };
        named(&study.groups, |group| {
            self.words.contains(group.label.as_str()) || self.words.iter().any(|word| begins(word, group))
        })
    }
}

/// Those of `all` that are named; all of them if none is.
fn named<T>(all: &[T], is_named: impl Fn(&T) -> bool) -> Vec<&T> {
    let found: Vec<&T> = all.iter().filter(|one| is_named(one)).collect();
    if found.is_empty() { all.iter().collect() } else { found }
}

/// The options of `choice` that vote, but for its default.
fn others(choice: &Choice) -> impl Iterator<Item = &String> {
    choice.options.keys().filter(|option| **option != choice.default && choice.votes(option))
}

/// Whether a contender draws at random; one that cannot be built is taken to.
fn draws(paper: &Paper, study: &Study, contender: &Contender) -> bool {
    let point = default_point(paper).for_trials(&study.choices);
    let sweep = study.sweep_points().swap_remove(0);
    contender.pipeline(&point, &sweep).map_or(true, |pipeline| pipeline.planner.draws())
}

fn gather<'v>(key: &str, value: &'v Value, names: &mut BTreeSet<&'v str>, words: &mut BTreeSet<&'v str>) {
    match value {
        Value::String(text) => {
            words.insert(text);
            if key == "study" {
                names.insert(text);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| gather(key, value, names, words)),
        Value::Table(table) => table.iter().for_each(|(key, value)| gather(key, value, names, words)),
        _ => {}
    }
}
