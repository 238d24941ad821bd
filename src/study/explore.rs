//! Which interpretations of a paper are explored: points in the product of its choices.

use super::checked::Study;
use super::choice::{Choice, Interpretation, single_options};
use super::contender::{Contender, StageUse, Sweep, Swept};
use super::group::Group;
use super::spec::OptionSpec;
use base::hash::sha256;
use base::seed::{self, Stream};
use base::settings::in_first_words;
use rand::RngExt as _;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The interpretations to explore: those that must be, and those to be added in this order while the budget lasts.
#[derive(Debug)]
pub struct Interpretations {
    /// The defaults, every other option by itself, and those that are named.
    pub alone: Vec<Interpretation>,
    /// Those drawn from the product of options that vote.
    pub drawn: Vec<Vec<Interpretation>>,
}

/// The interpretations of `choices`: `sample` settings drawn from `seed` with equal chance for every voting option. Each setting
/// of the choices that are not fitted stands with every option of those that are.
///
/// `named` are explored as well: what contenders depart to, whose trials count there alone, and what a paper names together.
///
/// # Errors
/// A choice whose default is not among its options.
pub fn interpretations(
    choices: &[Choice],
    named: Vec<Interpretation>,
    sample: u32,
    seed: u64,
) -> Result<Interpretations, String> {
    let mut known = BTreeSet::new();
    let mut new = |all: Vec<Interpretation>| -> Vec<Interpretation> {
        all.into_iter().filter(|one| known.insert(one.name().to_owned())).collect()
    };
    let mut alone = Vec::new();
    for single in single_options(choices)?.into_iter().chain(named) {
        alone.extend(new(with_fitted(choices, &single)?));
    }
    let moving: Vec<&Choice> = choices.iter().filter(|choice| !choice.fitted).collect();
    let voting = |choice: &&Choice| choice.options.keys().filter(|name| choice.votes(name)).count();
    let product = moving.iter().map(voting).fold(1_usize, usize::saturating_mul);
    let mut drawn = Vec::new();
    let mut seen = BTreeSet::new();
    let mut stream = seed::stream(seed);
    while seen.len() < product && drawn.len() < sample as usize {
        let options = draw(&moving, &mut stream);
        if seen.insert(options.clone()) {
            let all = new(with_fitted(choices, &Interpretation::new(choices, &options)?)?);
            if !all.is_empty() {
                drawn.push(all);
            }
        }
    }
    Ok(Interpretations { alone, drawn })
}

/// A voting option of each choice; the default of one that none votes in.
fn draw(choices: &[&Choice], stream: &mut Stream) -> BTreeMap<String, String> {
    let pick = |choice: &&Choice| {
        let voting: Vec<&String> = choice.options.keys().filter(|name| choice.votes(name)).collect();
        let option = match voting.len() {
            0 => &choice.default,
            count => voting[stream.random_range(0..count)],
        };
        (choice.id.clone(), option.clone())
    };
    choices.iter().map(pick).collect()
}

/// `interpretation` with every option of the fitted choices that can be run and stands with the others.
fn with_fitted(choices: &[Choice], interpretation: &Interpretation) -> Result<Vec<Interpretation>, String> {
    let mut all = vec![interpretation.options().clone()];
    for choice in choices.iter().filter(|choice| choice.fitted) {
        let each = |options: &BTreeMap<String, String>| {
            let with = |option: &String| {
                let mut options = options.clone();
                options.insert(choice.id.clone(), option.clone());
                options
            };
            // The option in hand comes first, so that an interpretation stands before its variations.
            let own = options[&choice.id].clone();
            let others = choice.options.keys().filter(|option| **option != own && choice.can_run(option));
            std::iter::once(with(&own)).chain(others.map(with)).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(each).collect();
    }
    let found: Result<Vec<_>, _> = all.iter().map(|options| Interpretation::new(choices, options)).collect();
    Ok(found?.into_iter().filter(Interpretation::is_allowed).collect())
}

/// A hash of all that trials of `study`, and the meaning of what they counted, depend on under any interpretation, as the specs and
/// the program say; words and figures do not count.
pub fn stamp(study: &Study) -> String {
    let stage = |stage: &StageUse| {
        format!("{} {} {:?}", stage.entry.name, stage.entry.revision, stage.settings.table())
    };
    let group = |group: &Group| {
        let family = group.family;
        let settings = in_first_words(group.settings.table());
        format!(
            "{} {:?} {} {} {settings:?}",
            group.label, group.shared_instances, family.name, family.revision
        )
    };
    let contender = |contender: &Contender| {
        let stages: Vec<String> = contender.stages.iter().map(stage).collect();
        format!("{} {stages:?} {:?}", contender.label, contender.departs)
    };
    let option = |(name, option): (&String, &Arc<OptionSpec>)| {
        let OptionSpec { metric, digits, .. } = option.as_ref();
        format!("{name} {:?} {metric:?} {digits:?}", study.what_sets(option))
    };
    let choice = |choice: &Choice| {
        let options: Vec<String> = choice.options.iter().map(option).collect();
        format!("{} {} {options:?}", choice.id, choice.default)
    };
    let sweeps = study.sweeps.iter().map(swept).collect::<Vec<_>>().join(", ");
    let text = format!(
        "{} {} {} {:?} {} {} {:?} {:?} {:?}\n{:?}\n{:?}\n[{sweeps}]\n{:?}",
        study.paper,
        study.name,
        study.seed,
        study.second_seed,
        study.task.name,
        study.task.revision,
        study.task_settings.table(),
        study.budget,
        study.explore,
        study.groups.iter().map(group).collect::<Vec<_>>(),
        study.contenders.iter().map(contender).collect::<Vec<_>>(),
        study.choices.iter().map(choice).collect::<Vec<_>>(),
    );
    sha256(text.as_bytes())[..16].to_owned()
}

/// A sweep as stamps always had it: where it stands is no part of it.
fn swept(Sweep { key, whose, values, .. }: &Sweep) -> String {
    let whose = match whose {
        Swept::Stage(name) => format!("of: {name:?}"),
        Swept::Problems(labels) => format!("problems: {labels:?}"),
    };
    format!("Sweep {{ key: {key:?}, {whose}, values: {values:?} }}")
}

#[cfg(test)]
mod tests {
    use super::super::spec::BoundsSpec;
    use super::*;

    /// A choice with the options 0 to `count - 1`; those below `cited` cite the paper.
    fn choice(id: &str, count: usize, cited: usize, fitted: bool) -> Choice {
        let option = |i: usize| {
            let paper = (i < cited).then(|| "section 1".to_owned());
            (i.to_string(), Arc::new(OptionSpec { paper, ..OptionSpec::default() }))
        };
        Choice {
            place: None,
            id: id.to_owned(),
            title: None,
            why: String::new(),
            default: "0".to_owned(),
            fitted,
            bounds: None,
            options: (0..count).map(option).collect(),
            touches_trials: false,
        }
    }

    fn names(all: &[Interpretation]) -> Vec<&str> {
        all.iter().map(Interpretation::name).collect()
    }

    #[test]
    fn a_sample_of_the_product_repeats_nothing_and_holds_no_probe() {
        let choices = [choice("a", 3, 2, false), choice("b", 4, 4, false), choice("c", 2, 0, false)];
        for seed in 0..20 {
            let found = interpretations(&choices, Vec::new(), 5, seed).unwrap();
            let alone = ["default", "a=1", "a=2", "b=1", "b=2", "b=3", "c=1"];
            assert_eq!(names(&found.alone), alone, "seed {seed}");
            let all: Vec<Interpretation> =
                interpretations(&choices, Vec::new(), 1000, seed).unwrap().drawn.concat();
            // Of 2 x 4 settings that vote, 5 are the defaults or one option by itself.
            assert_eq!(
                names(&all).iter().collect::<BTreeSet<_>>().len(),
                3,
                "seed {seed}: {:?}",
                names(&all)
            );
            assert!(names(&all).iter().all(|name| !name.contains("a=2") && !name.contains("c=1")));
        }
        let some = |seed| interpretations(&choices, Vec::new(), 2, seed).unwrap().drawn.concat();
        assert!((1..20).any(|seed| some(seed) != some(0)), "every seed draws the same");
    }

    #[test]
    fn a_fitted_choice_stands_with_every_setting_of_the_others() {
        let choices = [choice("a", 2, 2, false), choice("f", 3, 3, true)];
        let found = interpretations(&choices, Vec::new(), 9, 1).unwrap();
        assert_eq!(names(&found.alone), ["default", "f=1", "f=2", "a=1", "a=1,f=1", "a=1,f=2"]);
        assert!(found.drawn.is_empty());
    }

    #[test]
    fn what_is_named_together_is_explored_with_every_option_of_a_fitted_choice() {
        let choices = [choice("a", 2, 2, false), choice("b", 2, 2, false), choice("f", 2, 2, true)];
        let both = ["a", "b"].map(|id| (id.to_owned(), "1".to_owned()));
        let named = Interpretation::new(&choices, &both.into()).unwrap();
        let found = interpretations(&choices, vec![named], 0, 1).unwrap();
        assert_eq!(names(&found.alone)[6..], ["a=1,b=1", "a=1,b=1,f=1"]);
    }

    #[test]
    fn an_option_is_explored_only_with_those_that_it_names() {
        let only = |choice: &mut Choice, id: &str| {
            let only_with = [(id.to_owned(), vec!["1".to_owned()])].into();
            let paper = Some("section 1".to_owned());
            let option = OptionSpec { paper, only_with, ..OptionSpec::default() };
            choice.options.insert("2".to_owned(), Arc::new(option));
        };
        let mut fitted = choice("f", 3, 3, true);
        only(&mut fitted, "a");
        let choices = [choice("a", 3, 3, false), fitted.clone()];
        let found = interpretations(&choices, Vec::new(), 9, 1).unwrap();
        assert_eq!(names(&found.alone), ["default", "f=1", "a=1", "a=1,f=1", "a=1,f=2", "a=2", "a=2,f=1"]);
        let mut moving = choice("b", 3, 3, false);
        only(&mut moving, "a");
        let all = interpretations(&[choice("a", 2, 2, false), moving], Vec::new(), 99, 1).unwrap();
        assert_eq!(names(&all.alone), ["default", "a=1", "b=1"]);
        let drawn: BTreeSet<String> = all.drawn.concat().iter().map(|one| one.name().to_owned()).collect();
        assert_eq!(drawn, ["a=1,b=1", "a=1,b=2"].map(str::to_owned).into());
        // A study without the other choice asks for all options.
        assert_eq!(interpretations(&[fitted], Vec::new(), 9, 1).unwrap().alone.len(), 3);
    }

    #[test]
    fn an_option_votes_by_its_words_or_within_bounds_and_a_choice_without_any_keeps_its_default() {
        let votes = |choice: &Choice| -> Vec<String> {
            choice.options.keys().filter(|name| choice.votes(name)).cloned().collect()
        };
        assert_eq!(votes(&choice("a", 3, 2, false)), ["0", "1"]);
        assert_eq!(votes(&choice("a", 3, 0, false)), ["0"]);
        let mut numbers = choice("a", 4, 0, false);
        numbers.bounds = Some(BoundsSpec { least: 1.0, greatest: 2.0, source: "a handbook".to_owned() });
        for (name, option) in &mut numbers.options {
            let value = name.parse().ok();
            *option = Arc::new(OptionSpec { value, ..OptionSpec::default() });
        }
        assert_eq!(votes(&numbers), ["1", "2"]);
    }
}
