//! Choices: what a paper leaves open, the options that settle it, and interpretations, which take one option of each.

use super::family::lay;
use super::key::InterpretationKey;
use super::name;
use super::spec::{BoundsSpec, ChoiceSpec, Digits, OptionSpec, ROBOT_WITH, SCENE_WITH};
use base::settings::{Document, Place, Settings, SettingsError, did_you_mean, none_called};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use toml::{Table, Value};

/// Something that the paper leaves open.
#[derive(Debug, Clone)]
pub struct Choice {
    /// Its name in specs, columns and on the command line.
    pub id: String,
    /// What it settles, in a few words, where the spec gives them.
    pub title: Option<String>,
    /// What the paper leaves open, and why the default was taken.
    pub why: String,
    /// The option taken unless another is named.
    pub default: String,
    /// Its default was chosen so that claims hold, and is chosen again for each setting of the others.
    pub fitted: bool,
    /// Of options that are numbers: which of them vote.
    pub bounds: Option<BoundsSpec>,
    /// What each option changes.
    pub options: BTreeMap<String, Arc<OptionSpec>>,
    /// Whether trials depend on it: of some study for a paper's choice, of the study for one that a study inherits.
    pub touches_trials: bool,
    /// Where it stands, if a file holds it.
    pub place: Option<Place>,
}

impl Choice {
    /// The choice that `spec` writes, number `index` in `document`.
    pub fn read(spec: ChoiceSpec, document: &Arc<Document>, index: usize) -> Self {
        let ChoiceSpec { id, title, why, default, fitted, bounds, paper, practice, option } = spec;
        // A source of the whole choice is that of every option that has none of its own; what is laid over files is a setting of
        // the problems that name them.
        let sourced = |mut option: OptionSpec| {
            if !option.probe && option.paper.is_none() && option.practice.is_none() {
                (option.paper, option.practice) = (paper.clone(), practice.clone());
            }
            let files = [
                (ROBOT_WITH, std::mem::take(&mut option.robot)),
                (SCENE_WITH, std::mem::take(&mut option.scene)),
            ];
            for (key, over) in files.into_iter().filter(|(_, over)| !over.is_empty()) {
                option.problem.insert(key.to_owned(), over.into());
            }
            Arc::new(option)
        };
        let options = option.into_inner().into_iter().map(|(name, option)| (name, sourced(option)));
        let options: BTreeMap<_, _> = options.collect();
        Self {
            id: id.into_inner(),
            title,
            why,
            default: default.into_inner(),
            fitted,
            bounds,
            touches_trials: options.values().any(|option| option.sets_trials()),
            options,
            place: Some(Place::of_table(document, &["choice", &index.to_string()])),
        }
    }

    /// An error at the value that `steps` lead to inside the choice, if a file holds it.
    pub fn error(&self, steps: &[&str], message: String) -> SettingsError {
        match &self.place {
            Some(place) => place.inside(steps).error(message),
            None => SettingsError::Composed { origin: format!("choice `{}`", self.id), message },
        }
    }

    /// Whether the option called `name` can be run.
    pub fn can_run(&self, name: &str) -> bool {
        self.options.get(name).is_some_and(|option| option.cannot_run.is_none())
    }

    /// Whether the paper may mean the option called `name`, so that it is no probe: it cites the paper or a practice,
    /// or is a number within sourced bounds. If no option of a choice is cited, the default alone counts.
    pub fn is_meant(&self, name: &str) -> bool {
        let is_cited = |option: &OptionSpec| {
            let is_within =
                |(bounds, value): (&BoundsSpec, f64)| (bounds.least..=bounds.greatest).contains(&value);
            option.paper.is_some()
                || option.practice.is_some()
                || self.bounds.as_ref().zip(option.value).is_some_and(is_within)
        };
        let option = self.options.get(name);
        option.is_some_and(|option| is_cited(option))
            || (*name == *self.default && !self.options.values().any(|option| is_cited(option)))
    }

    /// Whether the option called `name` votes: the paper may mean it, and it can be run.
    pub fn votes(&self, name: &str) -> bool {
        self.can_run(name) && self.is_meant(name)
    }

    /// The options that the paper may mean and that cannot be run, each with the reason.
    pub fn not_run(&self) -> impl Iterator<Item = (&str, &str)> {
        let meant = self.options.iter().filter(|(name, _)| self.is_meant(name));
        meant.filter_map(|(name, option)| Some((name.as_str(), option.cannot_run.as_deref()?)))
    }

    /// The option called `name`, or why there is none that can be run.
    fn option(&self, name: &str) -> Result<&Arc<OptionSpec>, String> {
        let option = self.options.get(name).ok_or_else(|| self.lacks(name))?;
        match &option.cannot_run {
            Some(why) => Err(format!("option `{name}` of choice `{}` cannot be run: {why}", self.id)),
            None => Ok(option),
        }
    }

    /// That it has no option called `name`, in words.
    pub fn lacks(&self, name: &str) -> String {
        let known: Vec<&str> = self.options.keys().map(String::as_str).collect();
        let hint = did_you_mean(name, known.iter().copied());
        format!("choice `{}` has no option `{name}`{hint}; it has {}", self.id, known.join(", "))
    }
}

impl OptionSpec {
    /// Whether it sets something that trials depend on.
    pub fn sets_trials(&self) -> bool {
        !self.problem.is_empty() || !self.stage.is_empty() || !self.contender.is_empty()
    }

    /// Whether it changes the meaning of claims, whatever ran.
    pub fn sets_claims(&self) -> bool {
        !self.metric.is_empty() || self.digits.is_some()
    }
}

/// One option of every choice.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Interpretation {
    options: BTreeMap<String, String>,
    name: String,
    changes: Vec<Change>,
}

/// What an option changes, who says so, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    by: String,
    option: Arc<OptionSpec>,
    place: Option<Place>,
}

impl Change {
    /// The settings of planners and stages, by their names, that the problem group `label` at `place` lays over them.
    pub fn by_problems(label: &str, stage: BTreeMap<String, Table>, place: Place) -> Self {
        let option = Arc::new(OptionSpec { stage, ..OptionSpec::default() });
        Self { by: format!("problems `{label}`"), option, place: Some(place) }
    }

    /// What it lays over planners and stages, by their names.
    pub fn stage(&self) -> &BTreeMap<String, Table> {
        &self.option.stage
    }

    /// `settings` with `over`, which stands under `steps` in the option, laid on top.
    fn over(&self, settings: &Settings, over: &Table, steps: &[&str]) -> Settings {
        let of_file = |place: &Place| {
            [("robot", ROBOT_WITH), ("scene", SCENE_WITH)]
                .map(|(key, laid)| place.of_value(laid, &[key], &[key]))
        };
        let places =
            self.place.iter().flat_map(|place| [place.inside(steps)].into_iter().chain(of_file(place)));
        // Options of several choices may be laid over one file, each over other parts of it.
        let mut over = over.clone();
        for file in [ROBOT_WITH, SCENE_WITH] {
            if let (Some(Value::Table(under)), Some(Value::Table(own))) =
                (settings.table().get(file), over.get_mut(file))
            {
                let mut both = under.clone();
                // What cannot be laid is refused where the file is read.
                if lay(&mut both, own, file).is_ok() {
                    *own = both;
                }
            }
        }
        settings.overlaid_from(&over, &self.by, places.collect())
    }
}

impl Interpretation {
    /// The interpretation that takes each choice's default, but for the options in `other`.
    ///
    /// Its name lists only what differs from the defaults, in the order of the choices' names; that of the defaults is called
    /// `default`.
    ///
    /// # Errors
    /// A message that names the unknown choice or option and those that exist, or an option that cannot be run.
    pub fn new(choices: &[Choice], other: &BTreeMap<String, String>) -> Result<Self, String> {
        let ids: BTreeSet<&str> = choices.iter().map(|choice| choice.id.as_str()).collect();
        if let Some(id) = other.keys().find(|id| !ids.contains(id.as_str())) {
            return Err(none_called("choice", id, choices.iter().map(|choice| choice.id.as_str())));
        }
        let mut interpretation = Self::default();
        let mut differs = Vec::new();
        for choice in choices {
            let name = other.get(&choice.id).unwrap_or(&choice.default);
            let option = choice.option(name)?.clone();
            if *name != choice.default {
                differs.push((choice.id.as_str(), name.as_str()));
            }
            interpretation.options.insert(choice.id.clone(), name.clone());
            let place = choice.place.as_ref().map(|place| place.inside(&["option", name]));
            let by = format!("choice {}={name}", choice.id);
            interpretation.changes.push(Change { by, option, place });
        }
        interpretation.name = name::choice(differs.into_iter());
        Ok(interpretation)
    }

    /// The same options, of those choices alone: the interpretation of a study that inherits no others.
    ///
    /// # Panics
    /// If one of `choices` lacks the option that is taken of it.
    #[must_use]
    pub fn within(&self, choices: &[Choice]) -> Self {
        self.with_options_of(choices.iter(), choices)
    }

    /// Its name in records.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The option taken of each choice.
    pub fn options(&self) -> &BTreeMap<String, String> {
        &self.options
    }

    /// The interpretation of `choices` under which the same trials run: choices that touch no trial are at their defaults.
    ///
    /// # Panics
    /// As [`within`](Self::within).
    #[must_use]
    pub fn for_trials(&self, choices: &[Choice]) -> Self {
        self.with_options_of(choices.iter().filter(|choice| choice.touches_trials), choices)
    }

    /// The interpretation of `choices` that takes the same option of each of `some`.
    fn with_options_of<'c>(&self, some: impl Iterator<Item = &'c Choice>, choices: &[Choice]) -> Self {
        let options = some.filter_map(|choice| self.options.get_key_value(&choice.id));
        Self::new(choices, &options.map(|(id, option)| (id.clone(), option.clone())).collect())
            .expect("a study inherits the choices of its paper as they are")
    }

    /// Whether each option stands with the options of other choices that it names; absent choices are ignored.
    pub fn is_allowed(&self) -> bool {
        let stands = |(id, options): (&String, &Vec<String>)| {
            self.options.get(id).is_none_or(|option| options.contains(option))
        };
        self.changes.iter().all(|change| change.option.only_with.iter().all(stands))
    }

    /// The name of this interpretation in the records of a study with these choices: the option of each choice that
    /// touches trials.
    pub fn key(&self, choices: &[Choice]) -> InterpretationKey {
        let moving = choices.iter().filter(|choice| choice.touches_trials);
        let option =
            |choice: &Choice| self.options.get(&choice.id).unwrap_or(&choice.default).as_str().into();
        InterpretationKey::new(moving.map(|choice| (choice.id.as_str().into(), option(choice))).collect())
    }

    /// The meanings that the options give claims, whatever ran: the metrics of names and how printed digits end.
    pub fn meaning(&self) -> String {
        let options = self.changes.iter().map(|change| &change.option).filter(|option| option.sets_claims());
        options
            .map(|option| format!("{:?} {:?}\n", option.metric, option.digits))
            .collect::<Vec<_>>()
            .concat()
    }

    /// How printed digits end, if an option says so.
    pub fn digits(&self) -> Option<Digits> {
        self.changes.iter().find_map(|change| change.option.digits)
    }

    /// The same options on top of `change`.
    #[must_use]
    pub fn above(&self, change: &Change) -> Self {
        let mut laid = self.clone();
        laid.changes.insert(0, change.clone());
        laid
    }

    /// The settings of a problem with what the options lay over them; `accepts` says whether its family has all of these settings.
    #[must_use]
    pub fn over_problem(&self, settings: Settings, accepts: impl Fn(&Table) -> bool) -> Settings {
        let laid = self.changes.iter().filter(|change| accepts(&change.option.problem));
        laid.fold(settings, |settings, change| change.over(&settings, &change.option.problem, &["problem"]))
    }

    /// The settings of the planner or stage called `entry` of the contender called `label` with what the options lay over them.
    #[must_use]
    pub fn over_stage(&self, label: &str, entry: &str, settings: Settings) -> Settings {
        self.changes.iter().fold(settings, |mut settings, change| {
            if let Some(over) = change.option.stage.get(entry) {
                settings = change.over(&settings, over, &["stage", entry]);
            }
            if let Some(over) = change.option.contender.get(label).and_then(|own| own.get(entry)) {
                settings = change.over(&settings, over, &["contender", label, entry]);
            }
            settings
        })
    }

    /// The metric that `name` stands for.
    pub fn metric<'a>(&'a self, name: &'a str) -> &'a str {
        let found = self.changes.iter().find_map(|change| change.option.metric.get(name));
        found.map_or(name, String::as_str)
    }
}

/// The defaults, and every interpretation that differs from them in one option that can be run and stands with the defaults.
///
/// # Errors
/// A choice whose default is not among its options.
pub fn single_options(choices: &[Choice]) -> Result<Vec<Interpretation>, String> {
    departing(choices, |_| true)
}

/// As [`single_options`], but for the choices that touch no trial: those keep their defaults.
///
/// # Errors
/// As [`single_options`].
pub fn single_options_of_trials(choices: &[Choice]) -> Result<Vec<Interpretation>, String> {
    departing(choices, |choice| choice.touches_trials)
}

fn departing(choices: &[Choice], may_depart: fn(&Choice) -> bool) -> Result<Vec<Interpretation>, String> {
    let mut all = vec![Interpretation::new(choices, &BTreeMap::new())?];
    for choice in choices.iter().filter(|choice| may_depart(choice)) {
        let others = choice.options.keys().filter(|name| **name != choice.default && choice.can_run(name));
        for name in others {
            let single = Interpretation::new(choices, &[(choice.id.clone(), name.clone())].into())?;
            all.extend(single.is_allowed().then_some(single));
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choices() -> Vec<Choice> {
        let option = |metric: &str| OptionSpec {
            metric: BTreeMap::from([("nodes".to_owned(), metric.to_owned())]),
            ..OptionSpec::default()
        };
        let lost = OptionSpec { cannot_run: Some("it needs the lost map".to_owned()), ..option("closed") };
        vec![Choice {
            id: "nodes".to_owned(),
            title: None,
            why: "not stated".to_owned(),
            default: "opened".to_owned(),
            fitted: false,
            bounds: None,
            options: [("opened", option("opened")), ("closed", option("closed")), ("lost", lost)]
                .map(|(name, option)| (name.to_owned(), Arc::new(option)))
                .into(),
            touches_trials: false,
            place: None,
        }]
    }

    #[test]
    fn an_interpretation_is_named_after_what_differs_from_the_defaults() {
        let interpretation = |other: &[(&str, &str)]| {
            let other = other.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
            Interpretation::new(&choices(), &other)
        };
        assert_eq!(interpretation(&[]).unwrap().name(), "default");
        assert_eq!(interpretation(&[("nodes", "opened")]).unwrap().name(), "default");
        let closed = interpretation(&[("nodes", "closed")]).unwrap();
        assert_eq!((closed.name(), closed.metric("nodes")), ("nodes=closed", "closed"));
        assert_eq!(closed.metric("opened"), "opened");
        assert_eq!(
            interpretation(&[("nodes", "all")]).unwrap_err(),
            "choice `nodes` has no option `all`; it has closed, lost, opened"
        );
        assert_eq!(
            interpretation(&[("node", "all")]).unwrap_err(),
            "there is no choice `node` (did you mean `nodes`?); there are nodes"
        );
    }

    #[test]
    fn an_option_that_cannot_be_run_is_refused_with_the_reason_and_is_no_interpretation() {
        let lost = Interpretation::new(&choices(), &[("nodes".to_owned(), "lost".to_owned())].into());
        let reason = "option `lost` of choice `nodes` cannot be run: it needs the lost map";
        assert_eq!(lost.unwrap_err(), reason);
        let names: Vec<String> =
            single_options(&choices()).unwrap().iter().map(|one| one.name().to_owned()).collect();
        assert_eq!(names, ["default", "nodes=closed"]);
    }
}
