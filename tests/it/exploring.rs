//! How `explore` and `confirm` spend their budget of trials, and how they go on after they were stopped.

use crate::across::{CITED, ON_HURRY, RUNS, Toy, pair};
use crate::counted_interpretations::CROWD;
use crate::paper::ProgramOutput;
use replan::analysis::across::stored::Exploration;
use replan::analysis::outcome::Polarity;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::Duration;

pub const MORE: (&str, &str) = (
    "instances = { draws = 20, room = 1 }",
    "instances = { draws = 12, room = 1 }\nmore_instances = { draws = 30 }",
);
/// What the default interpretation gives, so that no claim is open under it.
pub const MET: (&str, &str) = ("printed = \"24\"", "printed = \"4\"");

/// How many instances the claim `fewer` was judged by, with and without a weight.
fn instances(first: &Exploration) -> [BTreeSet<usize>; 2] {
    let has_weight = |place: &usize| !first.interpretations[*place].contains_key("hurry");
    let of = |wanted: bool| {
        let is_of = |interpretations: &[usize]| interpretations.iter().all(|at| has_weight(at) == wanted);
        let results = first.claims["fewer"].results.iter();
        results.filter(|result| is_of(&result.interpretations)).map(|result| result.n).collect()
    };
    [of(true), of(false)]
}

/// What `--plan` prints, and the trials of the first round in it.
fn planned(toy: &Toy) -> (String, u64) {
    let plan = toy.0.done(&["explore", "./toy", "--plan"]);
    let first_round = plan.split([',', ' ']).find_map(|word| word.parse().ok().filter(|n| *n > 10)).unwrap();
    (plan, first_round)
}

#[test]
fn a_second_round_draws_more_only_where_a_class_is_near_a_flip() {
    let toy = Toy::unexplored(&[CITED, MORE, MET]);
    let (_, first_round) = planned(&toy);
    toy.0.done(&["explore", "./toy"]);
    let explored = toy.first();
    // The interpretation that is near a flip, and the defaults beside it.
    assert_eq!(instances(&explored), [BTreeSet::from([30]), BTreeSet::from([30])]);
    // Each once more: three contenders on 30 instances, and one on the room.
    assert_eq!(explored.trials, first_round + 2 * (3 * 30 + 1));
    // Without room in the budget there is no second round.
    let toy =
        Toy::unexplored(&[CITED, MORE, MET, ("trials = 100_000", &format!("trials = {}", first_round + 90))]);
    toy.0.done(&["explore", "./toy"]);
    let explored = toy.first();
    assert_eq!(
        (instances(&explored), explored.trials),
        ([BTreeSet::from([12]), BTreeSet::from([12])], first_round)
    );
}

#[test]
fn an_option_that_few_instances_do_not_tell_apart_keeps_their_outcome_and_is_not_counted() {
    // It is no whole number, so other trials; on this map it expands what the default does.
    let nearly = "stage.astar = { weight = 0 }\n[choice.option.nearly]\npractice = \"textbooks\"\nstage.astar = { weight = 3.000001 }";
    let toy = Toy::new(&[CITED, MORE, MET, ("stage.astar = { weight = 0 }", nearly)]);
    let first = toy.first();
    let place = first.place(&[("hurry".to_owned(), "nearly".to_owned())].into()).unwrap();
    let [own, default] = [place, 0].map(|place| first.result("fewer", place).unwrap());
    assert!(own.is_as_far_as_seen(default) && (own.n, default.n) == (12, 30), "{own:?} {default:?}");
    // Of nine interpretations three ran with few instances alone; the meaning of an unused name needs no trial.
    let across = toy.claim("fewer").across.unwrap();
    assert_eq!((across.counted, across.looked, across.not_looked_at), (2, 6, 3), "{across:?}");
    assert_eq!(across.effects.keys().collect::<Vec<_>>(), ["hurry"]);
}

#[test]
fn another_number_of_instances_is_explored_anew() {
    let toy = Toy::unexplored(&[CITED, MORE, MET]);
    toy.0.done(&["explore", "./toy"]);
    let file = toy.0.at("toy/paper.toml");
    let text = fs::read_to_string(&file).unwrap();
    let [before, after] = ["more_instances = { draws = 30 }", "more_instances = { draws = 36 }"];
    assert!(text.contains(before));
    fs::write(&file, text.replace(before, after)).unwrap();
    toy.0.done(&["explore", "./toy"]);
    assert_eq!(instances(&toy.first()), [BTreeSet::from([36]), BTreeSet::from([36])]);
}

#[test]
fn a_second_round_draws_more_where_too_few_instances_are_solved() {
    let toy = Toy::unexplored(&[CROWD, MORE]);
    let (_, first_round) = planned(&toy);
    toy.0.done(&["explore", "./toy"]);
    // The crowd and the defaults beside it; the room has no crowd and runs once.
    assert_eq!(toy.first().trials, first_round + 2 * 3 * 30 + 1);
}

#[test]
fn a_plan_counts_the_second_round_within_the_budget_and_gives_its_time() {
    let (plan, first_round) = planned(&Toy::unexplored(&[CITED, MORE, MET]));
    // Under each interpretation three contenders, on 12 instances and on 30, and one on the room.
    let again = first_round / (3 * 12 + 1) * (3 * 30 + 1);
    let more = |trials: u64| {
        format!("with more instances where an outcome is near a flip, at most {trials} trials\n")
    };
    assert!(plan.contains(&more(again)), "{plan}");
    assert!(plan.ends_with(" s of one core, by what the first instances take\n"), "{plan}");
    let short = format!("trials = {}", first_round + 90);
    let (plan, _) = planned(&Toy::unexplored(&[CITED, MORE, MET, ("trials = 100_000", &short)]));
    assert!(plan.contains(&more(90)), "{plan}");
    let (plan, _) = planned(&Toy::unexplored(&[CITED, MET]));
    assert!(plan.contains(&more(0)), "{plan}");
}

#[test]
fn a_plan_says_which_choices_need_new_trials_and_how_many_of_all_run() {
    let (plan, all) = planned(&Toy::unexplored(&[CITED, MET]));
    assert!(plan.contains("toy: hurry: new trials of `A*`\n"), "{plan}");
    assert!(plan.contains("toy: idle: no new trial; stored ones are counted anew\n"), "{plan}");
    // Of the contenders, A* alone runs under both options of `hurry`: on 20 instances, and on the room.
    let different = 2 * (20 + 1) + 2 * 20;
    assert!(plan.contains(&format!("toy: {different} different trials run for these {all}")), "{plan}");
}

#[test]
fn a_confirmation_keeps_to_the_budget_of_trials_and_says_what_it_left_out() {
    let toy = Toy::new(&[CITED]);
    // The default on the second seed: three contenders on 40 instances, and one on the room.
    let budget = |trials: u64| {
        let text = fs::read_to_string(toy.0.at("toy/paper.toml")).unwrap();
        let line = text.lines().find(|line| line.starts_with("trials = ")).unwrap();
        fs::write(toy.0.at("toy/paper.toml"), text.replace(line, &format!("trials = {trials}"))).unwrap();
    };
    budget(120);
    let output = toy.0.run(&["confirm", "./toy"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    let refused = "./toy/paper.toml:7:10: the default interpretation takes 121 trials on the second seed; `trials` is 120";
    assert!(output.err.contains(refused), "{}", output.err);
    assert!(!toy.0.at("target/replan/confirm").exists(), "trials were run");
    budget(181);
    let output = toy.0.done(&["confirm", "./toy"]);
    assert!(
        output.contains("toy: interpretations that turn a claim and for which the budget has no room: 1\n"),
        "{output}"
    );
    assert_eq!(toy.second().trials, 121);
    assert_eq!(toy.claim("fewer").across.unwrap().unconfirmed, 1);
    budget(182);
    toy.0.done(&["confirm", "./toy"]);
    assert_eq!(toy.second().trials, 121 + 61);
    assert_eq!(toy.class_and_across("fewer"), pair("depends on hurry", ON_HURRY));
}

/// Enough trials that a command can be caught at work.
const SLOW: [(&str, &str); 4] =
    [CITED, ("[12, 12]", "[150, 150]"), ("[11, 9]", "[149, 120]"), ("instances = 40", "instances = 200")];

/// Sends Ctrl-C once `file` has `bytes`, or says that the command was over before.
fn interrupt(toy: &Toy, mut child: Child, file: &Path, bytes: u64) -> ProgramOutput {
    while fs::metadata(file).map_or(0, |file| file.len()) < bytes {
        assert!(child.try_wait().unwrap().is_none(), "over before {} was seen", file.display());
        sleep(Duration::from_micros(200));
    }
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap();
    assert!(sent.success());
    toy.0.output(&child.wait_with_output().unwrap())
}

/// The units that a message says are kept.
fn kept(output: &ProgramOutput) -> u32 {
    let (before, _) =
        output.err.split_once(" units of study `draws` are kept").unwrap_or_else(|| panic!("{}", output.err));
    before.split_whitespace().rev().nth(2).unwrap().parse().unwrap()
}

#[test]
fn interrupted_explorations_and_confirmations_end_with_the_same_bytes() {
    let calm = Toy::new(&SLOW);
    calm.0.done(&["confirm", "./toy"]);
    let toy = Toy::unexplored(&SLOW);
    let file = |toy: &Toy| fs::read(toy.0.at(RUNS).join("estimates.parquet")).ok();
    for (command, journal) in
        [("explore", "explore/toy/round-1/draws.journal"), ("confirm", "confirm/toy/default/draws.journal")]
    {
        let before = file(&toy);
        let child = toy.0.command(&[command, "./toy"]).spawn().unwrap();
        let output = interrupt(&toy, child, &toy.0.at("target/replan").join(journal), 10_000);
        assert_eq!(output.code, Some(130), "{}", output.err);
        assert!(kept(&output) > 0 && file(&toy) == before, "{}", output.err);
        toy.0.done(&[command, "./toy"]);
    }
    assert!(file(&toy).is_some() && file(&toy) == file(&calm), "other bytes after an interruption");
}

#[test]
fn an_exploration_that_is_interrupted_while_readings_are_judged_runs_no_trial_again() {
    let toy = noisy();
    let child = toy.0.command(&["explore", "./toy"]).spawn().unwrap();
    let output = interrupt(&toy, child, &toy.0.at("target/replan/explore/toy/round-1/room.manifest.toml"), 1);
    assert_eq!(output.code, Some(130), "{}", output.err);
    assert!(
        output.err.ends_with("interrupted: the trials are kept; the same command goes on from there\n"),
        "{}",
        output.err
    );
    let trials = toy.0.at("target/replan/explore/toy/round-1/draws.trials.parquet");
    let written = fs::metadata(&trials).unwrap().modified().unwrap();
    toy.0.done(&["explore", "./toy"]);
    assert_eq!(fs::metadata(&trials).unwrap().modified().unwrap(), written);
}

/// A claim that asks for a polyline, which takes a search.
const ROW: (&str, &str) = (
    "[[claim]]\nid = \"fewer\"",
    "[[claim]]\nid = \"length\"\nat = \"table 1\"\nprinted = \"4.00\"\nunit = \"cells\"\nuntestable = \"no map\"\n\
     [[claim]]\nid = \"turn\"\nat = \"table 1\"\nprinted = \"90.0\"\nunit = \"deg\"\nuntestable = \"no map\"\n\
     [[claim]]\nid = \"row\"\nat = \"table 1\"\nsays = \"one path has both\"\n\
     rule.joint_length_turn = { size = [5, 5], start = [0, 0], goal = [2, 2], length = \"length\", turn = \"turn\", \
     metric = \"turn_exterior_deg\", exterior = \"turn_exterior_deg\", interior = \"turn_interior_deg\", longest = 6.0 }\n\
     [[claim]]\nid = \"fewer\"",
);

#[test]
fn polylines_that_were_found_are_kept_and_not_searched_for_again() {
    let toy = Toy::unexplored(&[ROW]);
    let cache = toy.0.at("target/replan/cache/polylines.json");
    let class = || {
        toy.0.done(&["explore", "./toy"]);
        toy.claim("row").outcome.polarity()
    };
    assert_eq!(class(), Polarity::Open);
    // What was kept is believed: an exploration that searched anew would find the path.
    let kept: serde_json::Map<String, serde_json::Value> =
        serde_json::from_slice(&fs::read(&cache).unwrap()).unwrap();
    assert!(kept.values().any(|answer| !answer.is_null()));
    let none: serde_json::Map<_, _> =
        kept.into_iter().map(|(name, _)| (name, serde_json::Value::Null)).collect();
    fs::write(&cache, serde_json::to_vec(&none).unwrap()).unwrap();
    assert_eq!(class(), Polarity::Against);
}

/// A claim that one unlucky map breaks, under a hundred sizes of the map, which only draw other maps.
fn noisy() -> Toy {
    let mut world =
        "[[choice]]\nid = \"world\"\nwhy = \"the size is not printed\"\ndefault = \"w10\"\npaper = \"section 1\"\n[choice.option]\n"
            .to_owned();
    for width in 10..110 {
        world += &format!("w{width} = {{ problem = {{ size_cells = [{width}, 12] }} }}\n");
    }
    let claim = "[[claim]]\nid = \"near\"\nat = \"section 4\"\nsays = \"the search from two sides costs at most a tenth more\"\n\
         check.on_every = { select = { study = \"draws\", problems = \"drawn\", metric = \"path_cost_cells\", \
         contender = \"Two-sided\", against = \"A*\" }, that = \"at_most_times\", bound = 1.1 }\n[[claim]]\nid = \"fewer\"";
    let edits = [
        ("[[claim]]\nid = \"fewer\"", &*format!("{world}{claim}")),
        ("goal = [11, 9]", "goal = [9, 9]"),
        ("draws = 20, room", "draws = 10, room"),
        ("size_cells = [12, 12]", "size_cells = [10, 12]"),
    ];
    Toy::unexplored(&edits)
}

#[test]
fn noise_among_a_hundred_readings_does_not_turn_a_verdict() {
    let toy = noisy();
    toy.0.done(&["explore", "./toy"]);
    let first = toy.first();
    let against = |all: &Exploration| {
        let results = all.claims["near"].results.iter();
        results.filter(|found| found.outcome.polarity() == Polarity::Against).count()
    };
    let flips = against(&first);
    assert!((1..9).contains(&flips), "the sample shows nothing: {flips} of 100 maps break the claim");
    let verdict = |toy: &Toy| {
        let across = toy.claim("near").across.unwrap();
        (toy.class_and_across("near").0, across.fails, across.unconfirmed)
    };
    let expected = ("reproduced".to_owned(), 0, flips);
    toy.0.done(&["confirm", "./toy"]);
    assert_eq!(verdict(&toy), expected);
    let second = toy.second();
    assert_eq!((second.interpretations.len(), against(&second)), (1 + flips, 0), "each was asked once more");
}

/// The commands that a text advises to run again.
fn advised(text: &str) -> Vec<String> {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let each = text.split("run `replan ").skip(1).filter_map(|rest| rest.split_once("` again"));
    each.map(|(command, _)| command.to_owned()).collect()
}

#[test]
fn the_advice_after_a_changed_claim_works_as_it_is_printed() {
    let toy = Toy::new(&[CITED]);
    fs::create_dir(toy.0.at("own")).unwrap();
    fs::rename(toy.0.at("toy"), toy.0.at("own/toy")).unwrap();
    assert_eq!(advised(&toy.0.done(&["confirm", "own/toy"])), Vec::<String>::new());
    toy.0.edit(
        "own/toy/paper.toml",
        "metric = \"expansions\", contender = \"A*\", against",
        "metric = \"opened\", contender = \"A*\", against",
    );
    let mut output = toy.0.done(&["repro", "own/toy"]);
    let mut ran = Vec::new();
    while let Some(command) = advised(&output).into_iter().next() {
        assert!(!ran.contains(&command), "`{command}` changes nothing: {output}");
        output = toy.0.done(&command.split(' ').collect::<Vec<_>>());
        ran.push(command);
    }
    assert_eq!(ran, ["explore own/toy", "confirm own/toy"]);
    assert_ne!(toy.class_and_across("fewer").1, "");
}
