//! The shared parts of paper.toml: what it says for all studies of its paper, and the choices that a study inherits.

use super::super::choice::Choice;
use super::super::name::slug;
use super::super::planner;
use super::super::spec::{BudgetSpec, ChoiceSpec, ExploreSpec, OptionSpec};
use super::{Contender, Group, Study, columns_of, labels_of};
use base::settings::{Document, Faults, Spanned, none_called};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use toml::Table;

/// The word that stands for every choice, in `leaves_out` and on the command line.
const ALL: &str = "all";

/// What paper.toml says for all studies.
#[derive(Debug, Clone, Default)]
pub struct Shared {
    /// What the paper leaves open.
    pub choices: Vec<Choice>,
    /// How far that is explored.
    pub explore: Option<ExploreSpec>,
    /// The root of every seed when `replan confirm` runs a study once more.
    pub second_seed: Option<u64>,
    /// Limits on each trial.
    pub budget: Option<BudgetSpec>,
    /// Problem groups that groups of studies may be like.
    pub groups: Vec<Group>,
    /// Contenders that those of studies may be like.
    pub contenders: Vec<Contender>,
}

impl Shared {
    /// The choices in `document`; what is wrong with one by itself goes to `faults`, and with it the choice.
    pub fn choices(specs: Vec<ChoiceSpec>, document: &Arc<Document>, faults: &mut Faults) -> Vec<Choice> {
        let mut kept: Vec<Choice> = Vec::new();
        for (index, spec) in specs.into_iter().enumerate() {
            let choice = Choice::read(spec, document, index);
            let id = slug(&choice.id);
            let wrong = if id.is_empty() {
                Some((vec!["id"], format!("choice `{}` has no letter or digit in its name", choice.id)))
            } else if id == ALL {
                Some((vec!["id"], format!("a choice is called `{ALL}`, which stands for every choice")))
            } else if kept.iter().any(|known| slug(&known.id) == id) {
                Some((vec!["id"], format!("choice `{}` stands twice", choice.id)))
            } else if !choice.options.contains_key(&choice.default) {
                Some((vec!["default"], choice.lacks(&choice.default)))
            } else if !choice.can_run(&choice.default) {
                let reason = format!(
                    "the default of choice `{}` cannot be run; another option is accepted",
                    choice.id
                );
                Some((vec!["default"], reason))
            } else {
                None
            };
            check_entries(&choice, faults);
            match wrong {
                None => kept.push(choice),
                Some((place, message)) => {
                    faults.add(choice.error(&place, message));
                    faults.unread(&choice.id);
                }
            }
        }
        kept
    }
}

/// Refuses options that set something of a planner or stage that does not exist.
fn check_entries(choice: &Choice, faults: &mut Faults) {
    for (name, option) in &choice.options {
        let of_stages = option.stage.keys().map(|entry| (vec!["stage"], entry));
        let of_contenders = option
            .contender
            .iter()
            .flat_map(|(label, own)| own.keys().map(move |entry| (vec!["contender", label], entry)));
        for (way, entry) in of_stages.chain(of_contenders) {
            if planner::find(entry).is_none() {
                let known = planner::all().map(|entry| entry.name);
                let place = [vec!["option", name], way, vec![entry.as_str()]].concat();
                faults.add(choice.error(&place, none_called("planner or stage", entry, known)));
            }
        }
    }
}

/// The settings of an option that touch a study.
#[derive(Debug, PartialEq)]
pub struct Sets<'o> {
    /// Settings of problems.
    problem: Option<&'o Table>,
    /// Settings of planners and stages.
    stage: BTreeMap<&'o str, &'o Table>,
    /// Settings of single contenders, by label and by planner or stage.
    contender: BTreeMap<(&'o str, &'o str), &'o Table>,
}

impl Sets<'_> {
    /// Whether it is nothing.
    pub fn is_empty(&self) -> bool {
        self.problem.is_none() && self.stage.is_empty() && self.contender.is_empty()
    }
}

impl OptionSpec {
    /// What it sets of these problems and of these contenders.
    fn sets(&self, groups: &[&Group], contenders: &[&Contender]) -> Sets<'_> {
        let uses = |own: &Contender, entry: &str| own.stages.iter().any(|stage| stage.entry.name == entry);
        let stage = self.stage.iter().filter(|(entry, _)| contenders.iter().any(|own| uses(own, entry)));
        let of_one = self.contender.iter().flat_map(|(label, own)| {
            own.iter().map(move |(entry, table)| ((label.as_str(), entry.as_str()), table))
        });
        let is_used = |((label, entry), _): &((&str, &str), &Table)| {
            contenders.iter().any(|own| own.label == **label && uses(own, entry))
        };
        let is_posed = groups.iter().any(|group| group.accepts(&self.problem));
        Sets {
            problem: is_posed.then_some(&self.problem),
            stage: stage.map(|(entry, table)| (entry.as_str(), table)).collect(),
            contender: of_one.filter(is_used).collect(),
        }
    }
}

impl Choice {
    /// Whether the option called `name` sets otherwise than the default these problems, or what these contenders run with.
    pub fn moves(&self, name: &str, groups: &[&Group], contenders: &[&Contender]) -> bool {
        let sets = |name: &str| Some(self.options.get(name)?.sets(groups, contenders));
        sets(name) != sets(&self.default)
    }
}

impl Study {
    /// The settings of `option` that touch what the study runs.
    pub fn what_sets<'o>(&self, option: &'o OptionSpec) -> Sets<'o> {
        let (groups, contenders): (Vec<_>, Vec<_>) =
            (self.groups.iter().collect(), self.contenders.iter().collect());
        option.sets(&groups, &contenders)
    }

    /// Whether `choice` sets something that the study runs.
    fn is_touched_by(&self, choice: &Choice) -> bool {
        choice.options.values().any(|option| !self.what_sets(option).is_empty())
    }

    /// Takes over those of the paper's `choices` that touch what it runs or how it is judged, but for those that it leaves out.
    pub(super) fn inherit(
        &mut self,
        choices: &[Choice],
        leaves_out: &[Spanned<String>],
        faults: &mut Faults,
    ) {
        let touching: Vec<&Choice> = choices.iter().filter(|choice| self.is_touched_by(choice)).collect();
        let ids: BTreeSet<&str> = touching.iter().map(|choice| choice.id.as_str()).collect();
        let mut left: BTreeSet<&str> = BTreeSet::new();
        for word in leaves_out {
            let id = word.get_ref().as_str();
            if id == ALL && !ids.is_empty() {
                left.extend(&ids);
            } else if !ids.contains(id) || !left.insert(id) {
                let message = self.not_left_out(id, choices, &ids);
                let error = self.document.error(word.span(), message).about(id).about("choice").about("id");
                faults.add(error.about(&labels_of(&self.name)).about(&columns_of(&self.name)));
            }
        }
        let sets_claims = |choice: &Choice| choice.options.values().any(|option| option.sets_claims());
        let inherited = choices.iter().filter(|choice| {
            let is_touching = ids.contains(choice.id.as_str());
            if is_touching { !left.contains(choice.id.as_str()) } else { sets_claims(choice) }
        });
        let own = |choice: &Choice| {
            let touches_trials = ids.contains(choice.id.as_str());
            Choice { touches_trials, ..choice.clone() }
        };
        let inherited: Vec<Choice> = inherited.map(own).collect();
        self.leaves_out = left.into_iter().map(str::to_owned).collect();
        self.choices = inherited;
    }

    /// Why the choice called `id` cannot be left out, in words.
    fn not_left_out(&self, id: &str, choices: &[Choice], touching: &BTreeSet<&str>) -> String {
        let listed = touching.iter().copied().collect::<Vec<_>>().join(", ");
        let accepted = if listed.is_empty() {
            "no choice of the paper does, so there is nothing to leave out".to_owned()
        } else {
            format!("those that do are {listed}")
        };
        if touching.contains(id) {
            format!("choice `{id}` is left out already")
        } else if id == ALL || choices.iter().any(|choice| choice.id == id) {
            format!("choice `{id}` sets nothing that study `{}` runs; {accepted}", self.name)
        } else {
            none_called("choice", id, touching.iter().copied())
        }
    }
}
