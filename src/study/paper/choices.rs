//! Rules for a paper's choices and their exploration, checked once all of its studies are known.

use super::{Claim, Paper};
use crate::spec::{BoundsSpec, Count, OptionSpec};
use crate::{Choice, Interpretation, Study, columns_of, labels_of, planner};
use base::settings::{Faults, SettingsError, did_you_mean, none_called};
use std::collections::{BTreeMap, BTreeSet};
use toml::Table;

impl Paper {
    /// What is wrong with choices, and with what names them, goes to `faults`.
    pub(super) fn check_choices(&self, faults: &mut Faults) {
        for choice in &self.choices {
            for error in self.votes(choice).into_iter().chain(self.idle(choice)) {
                faults.add(error);
            }
        }
        self.check_premises(faults);
        self.check_departures(faults);
        self.check_explored(faults);
    }

    /// What is wrong with the sources of `choice`: numbers need sourced bounds, and a default that decides verdicts needs a source.
    fn votes(&self, choice: &Choice) -> Vec<SettingsError> {
        let mut found = Vec::new();
        let mut wrong = |steps: &[&str], message: String, about: &[&str]| {
            let error = choice.error(steps, format!("choice `{}`: {message}", choice.id));
            found.push(about.iter().fold(error, |error, name| error.about(name)));
        };
        if let Some(BoundsSpec { least, greatest, .. }) =
            choice.bounds.as_ref().filter(|b| b.least > b.greatest)
        {
            let message = format!("least {least} is above greatest {greatest}; rising bounds are accepted");
            wrong(&["bounds"], message, &[]);
        }
        for (name, option) in &choice.options {
            for message in option_faults(name, option, choice) {
                wrong(&["option", name], message, &["bounds", "value"]);
            }
            for (other, message) in unknown_options(&option.only_with, &self.choices) {
                let message = format!("option `{name}`, only_with{message}");
                wrong(&["option", name, "only_with", &other], message, &[&other, "id"]);
            }
        }
        if !choice.votes(&choice.default) {
            let message = format!(
                "the default `{}` needs `paper` or `practice`, as other options have: claims are judged by it, so it votes",
                choice.default
            );
            wrong(&["default"], message, &["bounds", "value", "paper", "practice"]);
        }
        if choice.fitted && self.studies.iter().all(|study| study.fitted_to.is_empty()) {
            let message = "is fitted, but no study of the paper says what to; `fitted_to` is needed";
            wrong(&["fitted"], message.to_owned(), &["fitted_to"]);
        }
        found
    }

    /// Settings of `choice` that touch nothing in any study that inherits it.
    fn idle(&self, choice: &Choice) -> Vec<SettingsError> {
        let inherits = |study: &&Study| study.choices.iter().any(|own| own.id == choice.id);
        let studies: Vec<&Study> = self.studies.iter().filter(inherits).collect();
        let mut found = Vec::new();
        let mut idle = |steps: &[&str], message: String| {
            let error = choice.error(steps, format!("choice `{}`: {message}", choice.id));
            // What runs it may be what could not be read.
            let unread =
                self.studies.iter().flat_map(|study| [labels_of(&study.name), columns_of(&study.name)]);
            let error = unread.fold(error, |error, name| error.about(&name));
            found.push(
                ["problems", "contender", "family", "leaves_out"].iter().fold(error, |e, name| e.about(name)),
            );
        };
        let sets_nothing = |option: &OptionSpec| !option.sets_trials() && !option.sets_claims();
        if choice.options.values().all(|option| sets_nothing(option)) {
            idle(&["option"], "no option sets anything".to_owned());
        }
        for (name, option) in &choice.options {
            if !option.problem.is_empty() && !is_posed(&studies, &option.problem) {
                idle(
                    &["option", name, "problem"],
                    format!("option `{name}` sets {}", unposed(&option.problem, &studies)),
                );
            }
            // What does not exist was refused already.
            for entry in option.stage.keys().filter(|entry| planner::find(entry).is_some()) {
                if !studies.iter().any(|study| uses(study, None, entry)) {
                    let message = format!(
                        "option `{name}` sets `{entry}`, which no study that inherits the choice runs"
                    );
                    idle(&["option", name, "stage", entry], message);
                }
            }
            for (label, own) in &option.contender {
                let labels =
                    || studies.iter().flat_map(|study| &study.contenders).map(|own| own.label.as_str());
                if !labels().any(|known| known == label) {
                    let known: BTreeSet<&str> = labels().collect();
                    let message = none_called("contender", label, known);
                    idle(&["option", name, "contender", label], format!("option `{name}`: {message}"));
                    continue;
                }
                for entry in own.keys().filter(|entry| {
                    planner::find(entry).is_some()
                        && !studies.iter().any(|study| uses(study, Some(label), entry))
                }) {
                    let message =
                        format!("option `{name}` sets `{entry}`, which contender `{label}` does not use");
                    idle(&["option", name, "contender", label, entry], message);
                }
            }
        }
        found
    }

    /// A claim is meant under options that choices have, and looks at studies that inherit these choices.
    fn check_premises(&self, faults: &mut Faults) {
        for claim in &self.claims {
            let place = |id: &str| format!("{}.holds_when.{id}", claim.written.own);
            for (id, message) in unknown_options(&claim.holds_when, &self.choices) {
                let message = format!("claim `{}`, holds_when{message}", claim.id);
                faults.add(self.document.error_at(&place(&id), message).about(&id).about("id"));
            }
            for (id, study) in self.premises_left_out(claim) {
                let message = format!(
                    "claim `{}` is meant under options of choice `{id}`, which study `{}` leaves out; a study that inherits it is \
                     accepted",
                    claim.id, study.name
                );
                faults.add(self.document.error_at(&place(id), message));
            }
        }
    }

    /// The choices under whose options `claim` is meant, with the studies it looks at that leave them out.
    fn premises_left_out<'p>(&'p self, claim: &'p Claim) -> impl Iterator<Item = (&'p str, &'p Study)> {
        let studies = self.studies_of(&claim.id);
        claim.holds_when.keys().flat_map(move |id| {
            let leaves = |study: &&Study| study.leaves_out.contains(id);
            studies.clone().into_iter().filter(leaves).map(move |study| (id.as_str(), study))
        })
    }

    /// Refuses contenders that depart from a choice that their study inherits: the option of the study would hide theirs.
    fn check_departures(&self, faults: &mut Faults) {
        for study in &self.studies {
            for (index, contender) in study.contenders.iter().enumerate() {
                let mut wrong = |message: String| {
                    let place = format!("contender.{index}.departs");
                    let message = format!("contender `{}`: {message}", contender.label);
                    let error = study.document.error_at(&place, message);
                    let named = contender.departs.iter().flat_map(|(id, option)| [id, option]);
                    faults.add(named.fold(error, |error, name| error.about(name)));
                };
                if let Err(message) = Interpretation::new(&self.choices, &contender.departs) {
                    wrong(message);
                } else if let Some(own) =
                    study.choices.iter().find(|own| contender.departs.contains_key(&own.id))
                {
                    wrong(format!(
                        "departs from choice `{}`, which its study inherits; one in `leaves_out` is accepted",
                        own.id
                    ));
                }
            }
        }
    }

    /// Refuses explored studies that the paper lacks, `more` instances that are not more, and a second seed that equals the first.
    fn check_explored(&self, faults: &mut Faults) {
        for study in self.studies.iter().filter(|study| study.second_seed == Some(study.seed)) {
            let message = format!("the second seed is the first, {}; another one is accepted", study.seed);
            faults.add(study.document.error_at("second_seed", message));
        }
        let Some(explore) = &self.explore else { return };
        let mut wrong = |steps: &[&str], message: String, about: &str| {
            let steps = [&["explore"], steps].concat();
            faults.add(self.document.error_at_key(&steps, message).about(about));
        };
        let studies = || self.studies.iter().map(|study| study.name.as_str());
        let explored = || explore.instances.keys().map(String::as_str);
        for name in explored().filter(|name| self.study(name).is_none()) {
            wrong(&["draws", name], none_called("study", name, studies()), name);
        }
        let counts: [(&str, &BTreeMap<String, Count>); 2] =
            [("more_instances", &explore.more_instances), ("repeats", &explore.repeats)];
        let of_explored = counts.iter().flat_map(|(key, all)| all.keys().map(move |name| (*key, name)));
        let stands = explore.stands_for.keys().map(|name| ("stands_for", name));
        for (key, name) in
            of_explored.chain(stands).filter(|(_, name)| !explore.instances.contains_key(*name))
        {
            wrong(&[key, name], none_called("study among `draws`", name, explored()), name);
        }
        for (name, other) in explore.stands_for.iter().filter(|(_, other)| self.study(other).is_none()) {
            wrong(&["stands_for", name], none_called("study", other, studies()), other);
        }
        for (name, more) in &explore.more_instances {
            if let Some(few) = explore.instances.get(name).filter(|few| *few > more) {
                let message = format!(
                    "`more_instances` of `{name}` is {}, below its `instances`, {}; {1} or more are accepted",
                    more.0, few.0
                );
                wrong(&["more_instances", name], message, name);
            }
        }
        for name in explore.where_compatible.iter().filter(|name| !explore.instances.contains_key(*name)) {
            wrong(&["where_compatible"], none_called("explored study", name, explored()), name);
        }
        for (index, options) in explore.together.iter().enumerate() {
            if let Err(message) = Interpretation::new(&self.choices, options) {
                wrong(&["together", &index.to_string()], message, &self.id);
            }
        }
    }
}

/// Whether some problem of `studies` has all settings in `over`.
fn is_posed(studies: &[&Study], over: &Table) -> bool {
    studies.iter().flat_map(|study| &study.groups).any(|group| group.accepts(over))
}

/// What no problem of `studies` has of the settings in `over`, in words.
fn unposed(over: &Table, studies: &[&Study]) -> String {
    let families = studies.iter().flat_map(|study| &study.groups).map(|group| group.family);
    let known: BTreeSet<String> = families.flat_map(|family| family.settings.keys()).collect();
    let unknown: Vec<&String> = over.keys().filter(|key| !known.contains(*key)).collect();
    let listed = |keys: &[&String]| keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
    match unknown.as_slice() {
        [] => {
            let all: Vec<&String> = over.keys().collect();
            format!("{}, which no problem has together of a study that inherits the choice", listed(&all))
        }
        unknown => {
            let hint = did_you_mean(unknown[0], known.iter().map(String::as_str));
            format!("{}, which no problem has of a study that inherits the choice{hint}", listed(unknown))
        }
    }
}

/// Whether a contender of `study`, the one called `label` if one is named, uses the planner or stage called `entry`.
fn uses(study: &Study, label: Option<&str>, entry: &str) -> bool {
    let named = study.contenders.iter().filter(|own| label.is_none_or(|label| own.label == label));
    named.flat_map(|own| &own.stages).any(|stage| stage.entry.name == entry)
}

/// What is wrong with an option of `choice`: a number without bounds or bounds without a number, or an empty source.
fn option_faults(name: &str, option: &OptionSpec, choice: &Choice) -> Vec<String> {
    let mut faults = Vec::new();
    match &choice.bounds {
        Some(bounds) if option.value.is_none() => {
            let range = format!("{} to {}", bounds.least, bounds.greatest);
            faults
                .push(format!("option `{name}` needs `value`: the number held against the bounds, {range}"));
        }
        None if option.value.is_some() => {
            faults.push(format!("option `{name}` has a `value`, which needs `bounds` to be held against"));
        }
        _ => {}
    }
    let texts = [&option.paper, &option.practice, &option.cannot_run];
    if texts.into_iter().flatten().any(|text| text.trim().is_empty()) {
        faults.push(format!("option `{name}` cites nothing; the source and its words are accepted"));
    }
    faults
}

/// The faults of options by choice, each with the choice's id and a message: an unknown choice, no option, or an option that it
/// lacks.
fn unknown_options(wanted: &BTreeMap<String, Vec<String>>, all: &[Choice]) -> Vec<(String, String)> {
    let fault = |(id, options): (&String, &Vec<String>)| -> Vec<(String, String)> {
        let Some(choice) = all.iter().find(|choice| choice.id == *id) else {
            let known = all.iter().map(|choice| choice.id.as_str());
            return vec![(id.clone(), format!(": {}", none_called("choice", id, known)))];
        };
        let known = || choice.options.keys().map(String::as_str);
        if options.is_empty() {
            let listed = known().collect::<Vec<_>>().join(", ");
            return vec![(id.clone(), format!(".{id}: names no option; the options are {listed}"))];
        }
        let unknown = options.iter().filter(|option| !choice.options.contains_key(*option));
        let message =
            |option: &String| (id.clone(), format!(".{id}: {}", none_called("option", option, known())));
        unknown.map(message).collect()
    };
    wanted.iter().flat_map(fault).collect()
}
