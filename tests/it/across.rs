//! Classes across interpretations, on a small paper through the whole program: run, explore, confirm, judge.

use crate::paper::Bench;
use replan::analysis::across::Stored;
use replan::analysis::across::stored::Exploration;
use replan::analysis::estimates::Estimates;
use replan::analysis::outcome::Outcome;
use replan::analysis::polylines::Polylines;
use replan::analysis::verdict::{ClaimVerdict, Verdicts};
use std::fs;
use study::Inputs;
use study::paper::Paper;

/// Where its runs are.
pub const RUNS: &str = "target/replan/toy/data/runs/toy";

const PAPER: &str = r#"
[source]
title = "A toy"

[explore]
sample = 20
trials = 100_000
instances = { draws = 20, room = 1 }

[[claim]]
id = "fewer"
at = "section 1"
says = "A* expands fewer nodes than the search from two sides"
check.lower.select = { study = "draws", problems = "drawn", metric = "expansions", contender = "A*", against = "Two-sided" }

[[claim]]
id = "shorter"
at = "section 1"
says = "the search from two sides is no shorter"
check.lower = { is = "higher", select = { study = "draws", problems = "drawn", metric = "expansions", contender = "Two-sided", against = "Lazy" } }

[[claim]]
id = "witness"
at = "section 2"
printed = "24"
check.exists = { metric = "expansions", contenders = "A*", in = [{ study = "room", problems = "room" }] }

[[claim]]
id = "calibrated"
at = "section 3"
printed = "4"
check.prints_as.select = { study = "room", problems = "room", metric = "expansions", contender = "A*" }
"#;

/// The choices of the paper: `hurry` touches A* alone, `idle` gives a name a meaning that no claim speaks of.
pub const CHOICES: &str = r#"
[[choice]]
id = "hurry"
why = "the weight is not printed"
default = "three"
[choice.option.three]
paper = "section 1: the weight is three"
stage.astar = { weight = 3 }
[choice.option.none]
stage.astar = { weight = 0 }

[[choice]]
id = "idle"
why = "nobody asks"
default = "a"
paper = "section 1"
[choice.option]
a = { metric = { idle = "expansions" } }
b = { metric = { idle = "opened" } }
c = { metric = { idle = "closed" } }
"#;

const DRAWS: &str = r#"
paper = "toy"
question = "Who expands fewer?"
seed = 7
second_seed = 8
[budget]
expansions = 10_000
[[problems]]
label = "drawn"
family = "random_cells"
instances = 40
settings = { size_cells = [12, 12], start = [0, 0], goal = [11, 9], blocked_share = 0.2, corner_rule = "allow" }
[[contender]]
label = "A*"
planner = "astar"
settings = { weight = 3, ties = "fifo" }
[[contender]]
label = "Two-sided"
planner = "bidirectional"
settings = { weight = "one", meeting = "generated_any", side = "alternate", ties = "fifo" }
[[contender]]
label = "Lazy"
planner = "lazy_theta_star"
settings = { line_of_sight = "exact_interior" }
"#;

const ROOM: &str = r#"
paper = "toy"
question = "What does A* do in an empty room?"
seed = 7
second_seed = 8
fitted_to = []
[budget]
expansions = 10_000
[[problems]]
label = "room"
family = "grid_map"
settings = { map = "room.txt", start = [0, 0], goal = [4, 4], corner_rule = "allow" }
[[contender]]
label = "A*"
planner = "astar"
settings = { weight = 3, ties = "fifo" }
"#;

/// The toy, with every `from` of its files replaced.
pub struct Toy(pub Bench);

impl Toy {
    pub fn new(edits: &[(&str, &str)]) -> Self {
        let toy = Self::unexplored(edits);
        toy.0.done(&["explore", "./toy"]);
        toy
    }

    /// The toy with its default run alone.
    pub fn unexplored(edits: &[(&str, &str)]) -> Self {
        let toy = Self::written(edits);
        toy.0.done(&["run", "./toy"]);
        toy
    }

    /// The toy's files, of which nothing was run.
    pub fn written(edits: &[(&str, &str)]) -> Self {
        let bench = Bench::new();
        fs::create_dir(bench.at("toy")).unwrap();
        let mut unused: Vec<&str> = edits.iter().map(|(from, _)| *from).collect();
        let files = [
            ("paper.toml", format!("{PAPER}{CHOICES}")),
            ("draws.toml", DRAWS.to_owned()),
            ("room.toml", ROOM.to_owned()),
            ("room.txt", ".....\n".repeat(5)),
        ];
        for (name, mut text) in files {
            for (from, to) in edits {
                unused.retain(|edit| edit != from || !text.contains(from));
                text = text.replace(from, to);
            }
            fs::write(bench.at("toy").join(name), text).unwrap();
        }
        assert!(unused.is_empty(), "nothing to replace: {unused:?}");
        Self(bench)
    }

    /// What its explorations amount to.
    fn stored(&self) -> Stored {
        let folder = self.0.at("toy");
        let paper = Paper::load(&folder, &Inputs::below(vec![folder.clone()])).unwrap();
        Stored::read(&paper, &self.0.at(RUNS), &Polylines::default()).unwrap()
    }

    /// That of the first one.
    pub fn first(&self) -> Exploration {
        self.stored().first.unwrap()
    }

    /// That on the second seed.
    pub fn second(&self) -> Exploration {
        self.stored().second.unwrap()
    }

    fn verdicts(&self) -> Verdicts {
        Verdicts::read(&self.0.at(RUNS)).unwrap()
    }

    pub fn claim(&self, id: &str) -> ClaimVerdict {
        self.verdicts().claim(id).unwrap().clone()
    }

    /// The verdict of a claim and what stands beside it.
    pub fn class_and_across(&self, id: &str) -> (String, String) {
        let judged = self.claim(id);
        (judged.verdict_text(), judged.rests_on().unwrap_or_default())
    }
}

pub fn pair(verdict: &str, counts: &str) -> (String, String) {
    (verdict.to_owned(), counts.to_owned())
}

/// What stands beside a claim that the weight turns.
pub const ON_HURRY: &str = "1/0/1 for/open/against; contradicted only if hurry = none (1 of 1)";

/// A claim before another that looks at no trial.
const LOST: (&str, &str) = (
    "[[claim]]\nid = \"witness\"",
    "[[claim]]\nid = \"lost\"\nat = \"section 2\"\nsays = \"it is good\"\nuntestable = \"no measure is \
     named\"\n\n[[claim]]\nid = \"witness\"",
);

/// A source for the option without a weight.
pub const CITED: (&str, &str) = ("[choice.option.none]", "[choice.option.none]\npractice = \"textbooks\"");

#[test]
fn a_silly_reading_does_not_veto_and_is_printed() {
    let toy = Toy::new(&[]);
    assert_eq!(toy.class_and_across("fewer"), pair("reproduced", "same under all 3"));
    let across = toy.claim("fewer").across.unwrap();
    assert_eq!(across.probes, ["hurry = none: contradicted"]);
    assert!(across.effects.is_empty(), "{:?}", across.effects);
}

#[test]
fn a_claim_depends_on_a_default_once_a_second_seed_agrees_and_is_inconclusive_before() {
    let toy = Toy::new(&[CITED, LOST]);
    // What turns it has not turned twice: it is open, and more than a tenth of what counts.
    assert_eq!(toy.class_and_across("fewer"), pair("inconclusive", "1/1/0 for/open/against"));
    assert_eq!(toy.claim("fewer").across.unwrap().unconfirmed, 1);
    toy.0.done(&["confirm", "./toy"]);
    assert_eq!(toy.class_and_across("fewer"), pair("depends on hurry", ON_HURRY));
    let judged = toy.claim("fewer");
    assert_eq!((judged.second, judged.outcome), (Some(Outcome::Holds), Outcome::Holds));
    // The room is a file and A* draws nothing; what looks at no trial has no seed at all.
    let seed = |id: &str| toy.claim(id).beside_with_seed().unwrap_or_default();
    let seeds = ["calibrated", "lost"]
        .map(|id| (seed(id).contains("the seed moves nothing"), seed(id).contains("seed")));
    assert_eq!(seeds, [(true, true), (false, false)]);
    // What is stored is what judging gives, and a report says so.
    toy.0.done(&["judge", "./toy", "--check"]);
}

#[test]
fn the_title_of_a_choice_stands_on_the_first_screen_and_changes_nothing_that_is_stored() {
    let toy = Toy::new(&[CITED]);
    toy.0.done(&["confirm", "./toy"]);
    toy.0.done(&["repro", "./toy"]);
    let stored = toy.0.tree(RUNS);
    toy.0.edit("toy/paper.toml", "id = \"hurry\"", "id = \"hurry\"\ntitle = \"weight of A*\"");
    let output = toy.0.done(&["repro", "./toy"]);
    let words = output.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains("contradicted only if weight of A* (hurry) = none")
            && words.contains("nothing to run"),
        "{output}"
    );
    assert!(toy.0.tree(RUNS) == stored, "a title changed what is stored");
    toy.0.done(&["judge", "./toy", "--check"]);
}

#[test]
fn an_axis_that_cannot_touch_a_claim_does_not_inflate_its_count() {
    let with = Toy::new(&[CITED]);
    let across = with.claim("fewer").across.unwrap();
    // Two weights by three idle options: six interpretations, two results.
    assert_eq!((across.looked, across.counted), (6, 2));
    assert_eq!(across.effects.keys().collect::<Vec<_>>(), ["hurry"]);
    assert_eq!(with.class_and_across("shorter").1, "same under all 6");
}

#[test]
fn a_witness_under_one_reading_makes_a_claim_attainable_and_names_the_reading() {
    let toy = Toy::new(&[CITED]);
    assert_eq!(
        toy.class_and_across("witness"),
        pair("attainable", "met under 1 of 2, hurry = none among them")
    );
    assert_eq!(toy.claim("witness").outcome, Outcome::Open);
    // Without a source for that interpretation nothing attains it.
    assert_eq!(Toy::new(&[]).class_and_across("witness"), pair("inconclusive", "no example found"));
}

/// What stands beside a claim where the calibration leaves one weight.
const SETTLED: &str = "same under all 3; calibrated: hurry = three";

#[test]
fn a_choice_that_the_calibration_settles_caps_nothing_whether_refused_options_ran_or_not() {
    let late = (", room = 1 }", ", room = 1 }\nwhere_compatible = [\"draws\"]");
    let toy = Toy::new(&[CITED, FITTED, late]);
    assert_eq!(toy.class_and_across("fewer"), pair("reproduced", SETTLED));
    assert!(toy.claim("fewer").not_varied.is_empty());
    // Where nobody asked the number of the calibration under the other weight, nothing is settled.
    let toy =
        Toy::new(&[CITED, FITTED, ("instances = { draws = 20, room = 1 }", "instances = { draws = 20 }")]);
    assert!(toy.claim("fewer").calibrated.is_empty());
    let unexplored = ("instances = { draws = 20, room = 1 }", "instances = { room = 1 }");
    let alone = Toy::new(&[CITED, unexplored]);
    assert_eq!(alone.class_and_across("fewer"), pair("supported", "choices not varied: hurry"));
    let alone = Toy::new(&[CITED, FITTED, unexplored]);
    assert_eq!(alone.class_and_across("fewer"), pair("reproduced", SETTLED));
}

pub const FITTED: (&str, &str) = ("fitted_to = []", "fitted_to = [\"calibrated\"]");

#[test]
fn a_reading_that_contradicts_what_the_study_was_calibrated_to_is_not_counted() {
    let toy = Toy::new(&[CITED, FITTED]);
    assert_eq!(toy.class_and_across("fewer"), pair("reproduced", SETTLED));
    assert_eq!(toy.claim("fewer").across.unwrap().incompatible, 3);
    // A claim never filters itself.
    toy.0.done(&["confirm", "./toy"]);
    assert_eq!(toy.class_and_across("calibrated"), pair("fitted", "met under 1 of 2"));
}

#[test]
fn a_sentence_that_repeats_a_number_which_the_study_was_fitted_to_is_fitted() {
    const CALIBRATED: &str = "id = \"calibrated\"\nat = \"section 3\"\nprinted = \"4\"\n\
        check.prints_as.select = { study = \"room\", problems = \"room\", metric = \"expansions\", contender = \"A*\" }\n";
    let again = CALIBRATED.replace("calibrated", "repeated");
    let other = CALIBRATED.replace("calibrated", "other").replace("expansions", "path_cost_cells");
    let three = format!("{CALIBRATED}[[claim]]\n{again}[[claim]]\n{}", other.replace("\"4\"", "\"5.66\""));
    let toy = Toy::unexplored(&[FITTED, (CALIBRATED, &three)]);
    toy.0.done(&["judge", "./toy"]);
    let [calibrated, repeated, other] =
        ["calibrated", "repeated", "other"].map(|id| toy.class_and_across(id).0);
    assert_eq!([calibrated, repeated, other], ["fitted", "fitted", "reproduced"].map(str::to_owned));
}

#[test]
fn where_nothing_is_compatible_all_voting_options_are_judged_and_this_is_reported() {
    let toy = Toy::new(&[CITED, FITTED, ("printed = \"4\"", "printed = \"7\"")]);
    toy.0.done(&["confirm", "./toy"]);
    assert_eq!(toy.class_and_across("fewer").1, ON_HURRY);
    let across = toy.claim("fewer").across.unwrap();
    assert!(across.none_compatible && across.incompatible == 0, "{across:?}");
    assert!(toy.verdicts().explored.unwrap().none_compatible);
}

#[test]
fn a_calibration_claim_whose_study_is_not_explored_filters_nothing() {
    let unexplored = (", room = 1 }", " }");
    let toy = Toy::new(&[CITED, FITTED, unexplored, ("printed = \"4\"", "printed = \"7\"")]);
    let across = toy.claim("fewer").across.unwrap();
    // By the default run it is contradicted; under the other weight nobody asked, and nothing is filtered.
    assert_eq!((across.counted, across.incompatible, across.none_compatible), (1, 3, false), "{across:?}");
    let own = toy.claim("calibrated").across.unwrap();
    assert_eq!((own.looked, own.not_looked_at), (3, 3), "{own:?}");
}

#[test]
fn a_fitted_reading_is_fitted_again_for_each_setting_of_the_others() {
    let fitted = ("default = \"three\"", "default = \"three\"\nfitted = true");
    let toy = Toy::new(&[CITED, fitted, ("fitted_to = []", "fitted_to = [\"witness\"]")]);
    // Only without a weight is the witness met: that option is what the paper means, whatever the default.
    let across = toy.claim("fewer").across.unwrap();
    assert_eq!((across.looked, across.incompatible), (3, 3));
    assert_eq!(toy.class_and_across("fewer").0, "not reproduced");
}

/// A second number that was calibrated to, which any weight gives.
const SECOND: (&str, &str) = (
    "[[claim]]\nid = \"calibrated\"",
    "[[claim]]\nid = \"any_weight\"\nat = \"section 3\"\nprinted = \"5.66\"\n\
     check.prints_as.select = { study = \"room\", problems = \"room\", metric = \"path_cost_cells\", contender = \"A*\" }\n\
     [[claim]]\nid = \"calibrated\"",
);

#[test]
fn a_calibration_claim_takes_the_best_fit_of_all_and_does_not_vote_where_the_others_alone_fit() {
    let both = ("fitted_to = []", "fitted_to = [\"any_weight\", \"calibrated\"]");
    let fitted = ("default = \"three\"", "default = \"three\"\nfitted = true");
    let toy = Toy::new(&[CITED, SECOND, both, fitted]);
    for claim in ["calibrated", "any_weight"] {
        assert_eq!(toy.class_and_across(claim), pair("fitted", SETTLED), "{claim}");
        let across = toy.claim(claim).across.unwrap();
        assert_eq!((across.looked, across.incompatible), (3, 3), "{claim}");
    }
    // Where the weight is not fitted, the same two weights are two interpretations of the paper.
    let toy = Toy::new(&[CITED, SECOND, both]);
    toy.0.done(&["confirm", "./toy"]);
    assert_eq!(toy.class_and_across("calibrated"), pair("fitted", "met under 1 of 2"));
}

#[test]
fn a_changed_margin_printed_number_name_or_criterion_of_the_same_numbers_needs_no_trial() {
    let toy = Toy::new(&[CITED]);
    let file = fs::read(toy.0.at(RUNS).join("estimates.parquet")).unwrap();
    let outcome = |id: &str| toy.first().result(id, 0).unwrap().outcome;
    assert_eq!([outcome("witness"), outcome("fewer")], [Outcome::Open, Outcome::Holds]);
    // What is printed.
    toy.0.edit("toy/paper.toml", "printed = \"24\"", "printed = \"4\"");
    // A margin that the weight does not reach.
    toy.0.edit("toy/paper.toml", "check.lower.select", "check.lower.by_percent = 99.0\ncheck.lower.select");
    let output = toy.0.done(&["judge", "./toy"]);
    assert!(!output.contains("default interpretation alone") && !output.contains("trials:"), "{output}");
    assert_eq!(toy.verdicts().explored.unwrap().stale, [""; 0]);
    assert_eq!([outcome("witness"), outcome("fewer")], [Outcome::Attainable, Outcome::SignOnly]);
    // Another criterion of the same numbers: the reduction, held against bounds.
    let lower = "check.lower.by_percent = 99.0\ncheck.lower.select = ";
    let within = "check.within.accepted = [-1e6, 1e6]\ncheck.within.statistic = \"reduction_percent\"\ncheck.within.select = ";
    toy.0.edit("toy/paper.toml", lower, within);
    toy.0.done(&["judge", "./toy"]);
    assert_eq!(toy.verdicts().explored.unwrap().stale, [""; 0]);
    assert_eq!(toy.class_and_across("fewer"), pair("reproduced", "same under all 6"));
    // Another name.
    let interval = toy.claim("fewer").ours().unwrap().interval;
    toy.0.edit("toy/paper.toml", "id = \"fewer\"", "id = \"less\"");
    toy.0.done(&["judge", "./toy"]);
    assert_eq!(toy.verdicts().explored.unwrap().stale, [""; 0]);
    assert_eq!(toy.class_and_across("less"), pair("reproduced", "same under all 6"));
    assert_eq!(toy.claim("less").ours().unwrap().interval, interval);
    assert!(fs::read(toy.0.at(RUNS).join("estimates.parquet")).unwrap() == file, "it was explored again");
    toy.0.done(&["judge", "./toy", "--check"]);
}

/// A number of the drawn maps that A* gives without a weight alone, to which the study is fitted.
const MEAN: [(&str, &str); 2] = [
    (
        "[[claim]]\nid = \"witness\"",
        "[[claim]]\nid = \"mean\"\nat = \"section 2\"\nprinted = \"112\"\n[claim.check.within]\nstatistic = \"mean\"\nmargin = 100.4\n\
         select = { study = \"draws\", problems = \"drawn\", metric = \"expansions\", contender = \"A*\" }\n\n\
         [[claim]]\nid = \"witness\"",
    ),
    ("second_seed = 8\n[budget]", "second_seed = 8\nfitted_to = [\"mean\"]\n[budget]"),
];

#[test]
fn a_claim_that_another_option_than_the_default_meets_names_the_values_that_would_be_refused_there() {
    let beside = |edits: &[(&str, &str)]| {
        let toy = Toy::new(edits);
        let judged = toy.claim("mean");
        (judged.outcome, judged.verdict_text(), judged.beside.join("; "))
    };
    let (outcome, verdict, words) = beside(&[CITED, MEAN[0], MEAN[1]]);
    assert_eq!((outcome, verdict.as_str()), (Outcome::Open, "fitted"), "{words}");
    assert!(words.contains("power under hurry = none: a printed value below "), "{words}");
    // Where the defaults meet it, their own finding has it.
    let met = ("margin = 100.4", "margin = 102.0");
    let (outcome, verdict, words) = beside(&[CITED, MEAN[0], MEAN[1], met]);
    assert!(
        outcome == Outcome::Fitted && verdict == "fitted" && !words.contains("power"),
        "{outcome:?} {words}"
    );
}

/// Shares of solved trials: on a file, and on what is drawn; each decides, and is shown beside the other.
const SHARES: (&str, &str) = (
    "[[claim]]\nid = \"witness\"",
    "[[claim]]\nid = \"file\"\nat = \"section 2\"\nsays = \"it is solved\"\n\
     check.share = { hits = \"solved\", accepted = [0.5, 1.0], select = { study = \"room\", problems = \"room\", contender = \"A*\" } }\n\
     [[claim.shows.share]]\nhits = \"solved\"\nselect = { study = \"draws\", problems = \"drawn\", contender = \"A*\" }\n\n\
     [[claim]]\nid = \"drawn\"\nat = \"section 2\"\nsays = \"it is solved\"\n\
     check.on_every = { that = \"at_most\", bound = 1e4, select = { study = \"draws\", problems = \"drawn\", contender = \"A*\", metric = \"expansions\" } }\n\
     [[claim.shows.share]]\nhits = \"solved\"\nselect = { study = \"room\", problems = \"room\", contender = \"A*\" }\n\n\
     [[claim]]\nid = \"witness\"",
);

#[test]
fn a_number_has_an_interval_only_where_something_is_drawn() {
    let toy = Toy::new(&[SHARES]);
    let found = |id: &str| -> Vec<(bool, bool)> {
        let ours = toy.claim(id).findings.into_iter().map(|finding| finding.ours.unwrap());
        ours.map(|ours| (ours.interval.is_some(), ours.what.ends_with(", 95 %"))).collect()
    };
    assert_eq!(found("file"), [(false, false), (true, true)]);
    assert_eq!(found("drawn"), [(true, true), (false, false)]);
}

#[test]
fn what_draws_nothing_needs_no_second_seed() {
    let toy = Toy::new(&[CITED]);
    let judged = toy.claim("calibrated");
    let across = judged.across.as_ref().unwrap();
    assert_eq!(
        (judged.second, across.holds, across.fails, across.unconfirmed),
        (None, 1, 1, 0),
        "{judged:?}"
    );
    assert_eq!(judged.verdict_text(), "depends on hurry");
    assert_eq!(toy.claim("fewer").across.unwrap().unconfirmed, 1, "one seed is enough for what is drawn");
}

#[test]
fn another_metric_contender_or_group_is_not_explored_and_the_claim_is_named() {
    let toy = Toy::new(&[]);
    let more = "[[problems]]\nlabel = \"drawn\"";
    let other = DRAWS[DRAWS.find(more).unwrap()..DRAWS.find("[[contender]]").unwrap()]
        .replace("\"drawn\"", "\"more\"");
    let toys = [
        ("contender = \"A*\", against = \"Two-sided\"", "contender = \"Lazy\", against = \"Two-sided\""),
        (
            "contender = \"A*\", against = \"Two-sided\"",
            "contender = \"A*\", whole_instances = true, against = \"Two-sided\"",
        ),
        (
            "problems = \"drawn\", metric = \"expansions\", contender = \"A*\"",
            "problems = \"more\", metric = \"expansions\", contender = \"A*\"",
        ),
    ];
    let with = Toy::new(&[(more, &format!("{other}{more}"))]);
    for (from, to) in toys {
        with.0.edit("toy/paper.toml", from, to);
        with.0.done(&["judge", "./toy"]);
        assert_eq!(with.verdicts().explored.unwrap().stale, ["fewer"], "{to}");
        with.0.edit("toy/paper.toml", to, from);
    }
    with.0.done(&["judge", "./toy"]);
    assert_eq!(with.verdicts().explored.unwrap().stale, [""; 0]);
    toy.0.edit("toy/paper.toml", "metric = \"expansions\", contenders", "metric = \"generated\", contenders");
    let output = toy.0.done(&["judge", "./toy"]);
    let text = fs::read_to_string(toy.0.at("toy/paper.toml")).unwrap();
    let line = text.lines().position(|line| line.starts_with("check.exists")).unwrap() + 1;
    let located =
        format!("./toy/paper.toml:{line}:16: `witness` is judged under the default interpretation alone");
    assert!(output.contains(&located), "{output}");
    assert_eq!(toy.claim("witness").across, None);
    assert!(toy.claim("fewer").across.is_some());
    // Another budget makes other trials of all that look at them.
    toy.0.edit("toy/draws.toml", "expansions = 10_000", "expansions = 9_999");
    toy.0.done(&["run", "./toy"]);
    toy.0.done(&["judge", "./toy"]);
    assert_eq!(toy.verdicts().explored.unwrap().stale, ["fewer", "shorter", "witness"]);
    assert!(toy.verdicts().claims.iter().filter(|judged| judged.across.is_some()).count() == 1);
}

#[test]
fn counts_of_searches_that_left_refused_paths_out_are_explored_again() {
    let toy = Toy::new(&[("line_of_sight = \"exact_interior\"", "line_of_sight = \"bresenham\"")]);
    let folder = toy.0.at("toy");
    let paper = Paper::load(&folder, &Inputs::below(vec![folder.clone()])).unwrap();
    let mut stored = Estimates::read(&paper, &toy.0.at(RUNS)).unwrap();
    assert_eq!(toy.verdicts().explored.unwrap().stale, [""; 0]);
    // As it would be named if solved trials alone were counted: `shorter` looks at refused paths, `fewer` does not.
    for answer in &mut stored.first.as_mut().unwrap().answers {
        answer.question.truncate(16);
    }
    stored.write(&toy.0.at(RUNS)).unwrap();
    toy.0.done(&["judge", "./toy"]);
    assert_eq!(toy.verdicts().explored.unwrap().stale, ["shorter"]);
}

#[test]
fn estimates_that_were_edited_or_are_another_papers_are_refused_until_they_are_made_again() {
    let toy = Toy::new(&[CITED]);
    let path = toy.0.at(RUNS).join("estimates.parquet");
    let whole = fs::read(&path).unwrap();
    let mut turned = whole.clone();
    turned[whole.len() / 2] ^= 1;
    let cut = whole[..whole.len() / 2].to_vec();
    let sealed = "estimates.parquet: is not what replan wrote: damaged, edited";
    let refused = |why: &str| {
        for (command, code) in [(&["judge", "./toy", "--check"][..], 3), (&["judge", "./toy"], 2)] {
            let output = toy.0.run(command);
            assert_eq!(output.code, Some(code), "{}", output.err);
            assert!(output.err.contains(why), "{}", output.err);
        }
    };
    for wrong in [turned, cut, b"by hand".to_vec(), Vec::new()] {
        fs::write(&path, wrong).unwrap();
        refused(sealed);
    }
    let folder = toy.0.at("toy");
    let paper = Paper::load(&folder, &Inputs::below(vec![folder.clone()])).unwrap();
    fs::write(&path, &whole).unwrap();
    let stored = Estimates::read(&paper, &toy.0.at(RUNS)).unwrap();
    Estimates { paper: "another".to_owned(), ..stored }.write(&toy.0.at(RUNS)).unwrap();
    refused("is of the paper `another`, not of `toy`");
    toy.0.done(&["explore", "./toy"]);
    assert!(fs::read(&path).unwrap() == whole, "what was refused is not made again as it was");
    fs::write(&path, whole).unwrap();
    toy.0.done(&["judge", "./toy", "--check"]);
}

#[test]
fn exploring_once_more_runs_nothing_and_writes_the_same_bytes() {
    let toy = Toy::new(&[CITED]);
    let path = toy.0.at(RUNS).join("estimates.parquet");
    let before = fs::read(&path).unwrap();
    let output = toy.0.run(&["explore", "./toy"]);
    assert!(!output.err.contains("trials:"), "{}", output.err);
    assert!(fs::read(&path).unwrap() == before, "another exploration");
}

#[test]
fn a_budget_without_room_and_votes_without_sources_are_refused_where_they_stand() {
    let toy = Toy::new(&[]);
    toy.0.edit("toy/paper.toml", "trials = 100_000", "trials = 10");
    let output = toy.0.run(&["explore", "./toy"]);
    assert_eq!(output.code, Some(2));
    assert!(
        output.err.contains("./toy/paper.toml:7:10: the defaults and every other option"),
        "{}",
        output.err
    );
    toy.0.edit("toy/paper.toml", "paper = \"section 1: the weight is three\"", "");
    toy.0.edit("toy/paper.toml", "[choice.option.none]", "[choice.option.none]\npractice = \"x\"");
    let output = toy.0.run(&["check", "./toy"]);
    assert!(output.err.contains("the default `three` needs `paper` or `practice`"), "{}", output.err);
}
