//! Which interpretations count for a claim, on the small paper of [`across`](crate::across): those that it can tell apart, and those that
//! say something.

use crate::across::{CHOICES, CITED, FITTED, Toy, pair};
use replan::analysis::across::glance::Sight;
use replan::analysis::outcome::Outcome;
use replan::analysis::verdict::Effect;

/// Choices of which the first touches A* and the other the search from two sides.
const OTHERS: &str = r#"
[[choice]]
id = "hurry"
why = "the weight is not printed"
default = "three"
[choice.option.three]
paper = "section 1: the weight is three"
stage.astar = { weight = 3 }
[choice.option.none]
practice = "textbooks"
stage.astar = { weight = 0 }

[[choice]]
id = "reach"
why = "how the sides meet is not printed"
default = "any"
paper = "section 1"
[choice.option]
any = { stage.bidirectional = { meeting = "generated_any" } }
both = { stage.bidirectional = { meeting = "both_closed" } }
"#;

/// The small paper, in which the study of random maps alone inherits choices; contenders of the room are those of `room`.
fn choices_of_one_study(room: &str, more: &[(&str, &str)]) -> Toy {
    let toy = Toy::written(&[&[(CHOICES, OTHERS), (", room = 1 }", " }")], more].concat());
    toy.0.edit("toy/room.toml", "fitted_to = []\n", "fitted_to = []\nleaves_out = [\"hurry\"]\n");
    let rest = std::fs::read_to_string(toy.0.at("toy/room.toml")).unwrap();
    toy.0.write("toy/room.toml", (rest + room).as_bytes());
    toy.0.done(&["run", "./toy"]);
    toy.0.done(&["explore", "./toy"]);
    toy
}

#[test]
fn a_reading_that_the_study_of_a_witness_does_not_have_is_not_looked_at_if_it_touches_its_contender() {
    let toy = choices_of_one_study("", &[]);
    let first = toy.first();
    let claim = &first.claims["witness"];
    let sights: Vec<(Sight, usize)> =
        claim.results.iter().map(|found| (found.sight, found.interpretations.len())).collect();
    // The meeting touches no A*, so that the room's trials speak for both meetings.
    assert_eq!(sights, [(Sight::Looked, 2), (Sight::Unexplored, 2)]);
    let across = toy.claim("witness").across.unwrap();
    assert_eq!((across.counted, across.looked, across.not_looked_at), (1, 2, 2));
    // The weight touches A*, and the room was not run without one.
    assert_eq!(toy.claim("witness").not_varied, ["hurry"]);
    assert!(across.effects.is_empty(), "{:?}", across.effects);
}

#[test]
fn a_reading_that_touches_a_claim_and_was_not_varied_caps_it_at_supported() {
    let toy = choices_of_one_study("", &[]);
    assert_eq!(toy.class_and_across("calibrated"), pair("supported", "choices not varied: hurry"));
    // With the interpretation in the room too, its other option was asked.
    assert_eq!(Toy::new(&[CITED, FITTED]).class_and_across("calibrated"), pair("fitted", "met under 1 of 2"));
}

/// The weight touches the second of them alone.
const STARRED: &str = r#"
[[contender]]
label = "B*"
planner = "bidirectional"
settings = { weight = "one", meeting = "generated_any", side = "alternate", ties = "fifo" }
[[contender]]
label = "B* with weight"
planner = "astar"
settings = { weight = 3, ties = "fifo" }
"#;

#[test]
fn a_contender_whose_label_ends_in_a_star_stands_for_itself_alone() {
    let of = ["A*", "B*"].map(|label| format!("metric = \"expansions\", contender = \"{label}\" }}"));
    let toy = choices_of_one_study(STARRED, &[(&of[0], &of[1])]);
    assert_eq!(toy.claim("calibrated").not_varied, ["reach"]);
}

const DEPARTS: &str = r#"
[[contender]]
label = "A* without weight"
departs = { hurry = "none" }
planner = "astar"
settings = { weight = 0, ties = "fifo" }
"#;

const EITHER: (&str, &str) = ("contenders = \"A*\", in", "contenders = [\"A*\", \"A* without weight\"], in");

#[test]
fn a_witness_by_a_contender_that_departs_counts_under_the_reading_that_it_departs_to() {
    let toy = choices_of_one_study(DEPARTS, &[EITHER]);
    assert_eq!(
        toy.class_and_across("witness"),
        pair("attainable", "met under 1 of 2, hurry = none among them")
    );
    let judged = toy.claim("witness");
    assert_eq!(judged.outcome, Outcome::Open);
    let because = judged.findings[0].because.join("; ");
    assert!(because.contains("met by none of 1 trial"), "{because}");
    assert!(
        because.contains("met under another interpretation, hurry=none, where it counts: room/room/"),
        "{because}"
    );
}

#[test]
fn what_contenders_depart_to_together_is_explored() {
    let both = DEPARTS.replace("{ hurry = \"none\" }", "{ hurry = \"none\", reach = \"both\" }");
    let toy = choices_of_one_study(&both, &[EITHER, ("sample = 20", "sample = 0")]);
    let first = toy.first();
    let together =
        [("hurry", "none"), ("reach", "both")].map(|(id, option)| (id.to_owned(), option.to_owned()));
    assert!(first.place(&together.into()).is_some(), "{:?}", first.interpretations);
    assert_eq!(toy.class_and_across("witness").1, "met under 1 of 2, hurry = none, reach = both among them");
}

#[test]
fn a_contender_cannot_depart_from_a_reading_that_its_study_has() {
    let departs = ("label = \"A*\"\nplanner", "label = \"A*\"\ndeparts = { hurry = \"none\" }\nplanner");
    let toy = Toy::written(&[CITED, departs]);
    let output = toy.0.run(&["check", "./toy"]);
    assert_eq!(output.code, Some(2));
    assert!(output.err.contains("departs from choice `hurry`, which its study inherits"), "{}", output.err);
    toy.0.edit("toy/room.toml", "hurry = \"none\"", "haste = \"none\"");
    let output = toy.0.run(&["check", "./toy"]);
    assert!(output.err.contains("there is no choice `haste`; there are hurry, idle"), "{}", output.err);
}

/// A row that takes the best of its parts: a number that is met with a weight of three, or an input on which one is met.
const BEST: (&str, &str) = (
    "[[claim]]\nid = \"calibrated\"",
    "[[claim]]\nid = \"best\"\nat = \"section 3\"\nsays = \"four or twenty-four nodes\"\nany_of = [\"calibrated\", \"some\"]\n\
     [[claim]]\nid = \"some\"\nat = \"section 2\"\nprinted = \"24\"\n\
     check.exists = { metric = \"expansions\", contenders = \"A*\", in = [{ study = \"room\", problems = \"room\" }] }\n\
     [[claim]]\nid = \"calibrated\"",
);

#[test]
fn a_sentence_that_holds_by_a_searched_input_under_one_reading_is_attainable() {
    let toy = Toy::new(&[CITED, BEST]);
    let judged = toy.claim("best");
    assert_eq!(judged.outcome, Outcome::Holds);
    assert_eq!(toy.class_and_across("best"), pair("attainable", "met under 2 of 2"));
    let across = judged.across.unwrap();
    let effect = &across.effects["hurry"];
    assert_eq!(
        (effect.effect, effect.option.as_str(), effect.outcome),
        (Effect::Outcome, "none", Outcome::Attainable)
    );
}

/// The choice of how much is blocked; under one option few instances are solved.
pub const CROWD: (&str, &str) = (
    "[[claim]]\nid = \"fewer\"",
    "[[choice]]\nid = \"crowd\"\nwhy = \"how much is blocked is not printed\"\ndefault = \"fifth\"\npaper = \"section 4\"\n\
     [choice.option]\nfifth = { problem = { blocked_share = 0.2 } }\nmost = { problem = { blocked_share = 0.65 } }\n\
     [[claim]]\nid = \"fewer\"",
);

#[test]
fn a_reading_under_which_too_few_draws_are_solved_has_no_power_and_is_not_looked_at() {
    let toy = Toy::new(&[CROWD]);
    let first = toy.first();
    let powerless: Vec<_> =
        first.claims["fewer"].results.iter().filter(|found| found.sight == Sight::Few).collect();
    assert!(!powerless.is_empty() && powerless.iter().all(|found| found.n < 10), "{powerless:?}");
    let across = toy.claim("fewer").across.unwrap();
    assert_eq!(toy.class_and_across("fewer"), pair("reproduced", "same under all 3"));
    // The other weight is a probe here: three idle options by two crowds.
    assert_eq!((across.counted, across.looked, across.not_looked_at), (1, 3, 3));
}

const FEWER: &str = "says = \"A* expands fewer nodes than the search from two sides\"\n";

#[test]
fn a_claim_is_judged_only_under_the_readings_under_which_it_is_meant() {
    let when = |option: &str| format!("{FEWER}holds_when = {{ hurry = [\"{option}\"] }}\n");
    let toy = Toy::new(&[CITED, (FEWER, &when("three"))]);
    // Without a weight it is contradicted, and the claim would depend on it.
    let across = toy.claim("fewer").across.unwrap();
    assert_eq!((across.counted, across.fails), (1, 0));
    assert_eq!(toy.class_and_across("fewer").0, "reproduced");
    assert_eq!(toy.claim("fewer").findings[0].premises, ["hurry is three"]);
    let path = toy.0.at("toy/paper.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    for (from, to, refused) in [
        ("hurry = [\"three\"]", "hurri = [\"three\"]", "holds_when: there is no choice `hurri`"),
        ("[\"three\"]", "[\"tree\"]", "holds_when.hurry: there is no option `tree` (did you mean `three`?)"),
        ("[\"three\"]", "[]", "holds_when.hurry: names no option; the options are none, three"),
    ] {
        std::fs::write(&path, text.replace(from, to)).unwrap();
        let output = toy.0.run(&["check", "./toy"]);
        let line = text.lines().position(|line| line.starts_with("holds_when")).unwrap() + 1;
        let place = format!("paper.toml:{line}:");
        assert!(output.err.contains(refused) && output.err.contains(&place), "{to}: {}", output.err);
    }
}

#[test]
fn what_a_claim_would_fail_under_a_reading_under_which_it_is_not_meant_is_not_held_against_it() {
    let more = format!("{FEWER}check.lower.is = \"higher\"\n");
    let held = ["", "holds_when = { hurry = [\"none\"] }\n"].map(|when| {
        let toy = Toy::unexplored(&[(FEWER, &format!("{more}{when}"))]);
        toy.0.done(&["judge", "./toy"]);
        toy.claim("fewer").outcome
    });
    assert_eq!(held, [Outcome::Fails, Outcome::Open]);
}

/// A choice whose options are numbers.
const NUMBERS: &str = "[[choice]]\nid = \"hurry\"\nwhy = \"the weight is not printed\"\ndefault = \"three\"\n\
     bounds = { least = 1.0, greatest = 4.0, source = \"a handbook\" }\n\
     [choice.option.three]\nvalue = 3\nstage.astar = { weight = 3 }\n[choice.option.none]\nvalue = 0\nstage.astar = { weight = 0 }\n";

#[test]
fn numbers_vote_within_their_bounds_and_bounds_that_are_not_whole_are_refused() {
    let table = CHOICES.split("\n[[choice]]\nid = \"idle\"").next().unwrap();
    let toy = Toy::new(&[(table, NUMBERS)]);
    assert_eq!(toy.class_and_across("fewer"), pair("reproduced", "same under all 3"));
    assert_eq!(toy.claim("fewer").across.unwrap().probes, ["hurry = none: contradicted"]);
    for (from, to, refused) in [
        ("least = 1.0", "least = 5.0", "least 5 is above greatest 4; rising bounds are accepted"),
        ("value = 0\n", "", "option `none` needs `value`: the number held against the bounds, 1 to 4"),
        (
            "bounds = { least = 1.0, greatest = 4.0, source = \"a handbook\" }\n",
            "",
            "option `three` has a `value`, which needs `bounds` to be held against",
        ),
        ("value = 0\n", "value = 0\npractice = \" \"\n", "option `none` cites nothing"),
        ("value = 0\n", "value = 0\nonly_with = { haste = [] }\n", "only_with: there is no choice `haste`"),
        (
            "value = 0\n",
            "value = 0\nonly_with = { hurry = [\"ten\"] }\n",
            "only_with.hurry: there is no option `ten`",
        ),
        (
            "least = 1.0, greatest = 4.0",
            "least = 0.0, greatest = 1.0",
            "the default `three` needs `paper` or `practice`",
        ),
    ] {
        let text = std::fs::read(toy.0.at("toy/paper.toml")).unwrap();
        toy.0.edit("toy/paper.toml", from, to);
        let output = toy.0.run(&["check", "./toy"]);
        assert_eq!(output.code, Some(2), "{to}");
        assert!(output.err.contains(refused), "{to}: {}", output.err);
        toy.0.write("toy/paper.toml", &text);
    }
}

/// An arm among one obstacle, of whose starts one interpretation has that within the obstacle.
const ARM: &str = r#"
paper = "toy"
question = "How long is the way?"
seed = 7
second_seed = 8
[budget]
expansions = 10_000
[[problems]]
label = "arm"
family = "arm_workspace"
[problems.settings]
links_cm = [30, 20]
x_cm = [-50, 50]
y_cm = [0, 50]
step_cm = 1
inner_radius_cm = 20
elbow = "negative_theta2"
touching = "collides"
hop_check = "end_points"
corner_rule = "allow"
obstacle_diameter_cm = 10
obstacle_shapes = ["circle"]
obstacles_cm = [[35, 18]]
start_cm = [49, 3]
goal_cm = [0, 45]
blocked_ends = "invalid_problem"
[[contender]]
label = "A*"
planner = "lattice_astar"
settings = { neighbourhood = { shape = "square", radius_cells = 1 }, open_node = "lowered", ties = "fifo" }
"#;

/// The choice of its start.
const START: &str = "[[choice]]\nid = \"start\"\nwhy = \"the start is not printed\"\ndefault = \"free\"\npaper = \"section 5\"\n\
     [choice.option]\nfree = { problem = { start_cm = [49, 3] } }\nblocked = { problem = { start_cm = [35, 18] } }\n";

const REACH: (&str, &str) = (
    "[[claim]]\nid = \"calibrated\"",
    "[[claim]]\nid = \"reach\"\nat = \"section 5\"\nsays = \"the way is short\"\n\
     check.on_every = { that = \"at_most\", bound = 100.0, \
     select = { study = \"arm\", problems = \"arm\", contender = \"A*\", metric = \"path_length_cm\" } }\n\
     [[claim]]\nid = \"calibrated\"",
);

#[test]
fn a_reading_under_which_the_problem_cannot_be_posed_is_not_looked_at() {
    let explored = (", room = 1 }", ", room = 1, arm = 1 }");
    let toy = Toy::written(&[REACH, explored, (CHOICES, &format!("{CHOICES}{START}"))]);
    toy.0.write("toy/arm.toml", ARM.as_bytes());
    toy.0.done(&["run", "./toy"]);
    toy.0.done(&["explore", "./toy"]);
    let first = toy.first();
    let sights: Vec<(Sight, Outcome)> =
        first.claims["reach"].results.iter().map(|found| (found.sight, found.outcome)).collect();
    assert_eq!(sights, [(Sight::Looked, Outcome::Holds), (Sight::Powerless, Outcome::Open)]);
    // Under one interpretation it holds, and the other says nothing: it is no vote that leaves it open.
    let judged = toy.claim("reach");
    assert_eq!(judged.verdict.name(), "reproduced");
    let across = judged.across.unwrap();
    assert_eq!((across.counted, across.holds, across.looked, across.not_looked_at), (1, 1, 3, 3));
}

/// A line of sight that cuts through blocked cells, as one of two options.
const SIGHT: &str = "[[choice]]\nid = \"sight\"\nwhy = \"the line of sight is not printed\"\ndefault = \"exact\"\n\
     paper = \"section 4\"\n[choice.option]\n\
     exact = { stage.lazy_theta_star = { line_of_sight = \"exact_interior\" } }\n\
     cutting = { stage.lazy_theta_star = { line_of_sight = \"bresenham\" } }\n";

#[test]
fn a_reading_whose_paths_the_verifier_refuses_is_set_apart_where_the_paper_calls_its_paths_free() {
    let both = format!("{CHOICES}{SIGHT}");
    let sight = (CHOICES, both.as_str());
    let free = ("sample = 20", "sample = 20\nrefused_above_percent = 5");
    let toy = Toy::new(&[sight]);
    let free = Toy::new(&[sight, free]);
    let refused = |toy: &Toy| toy.claim("shorter").across.map(|across| across.refused).unwrap_or_default();
    let first = toy.first();
    let shares: Vec<f64> = first.claims["shorter"].results.iter().map(|found| found.refused).collect();
    assert!(shares.contains(&0.0) && shares.iter().any(|share| *share > 0.05), "one-sided: {shares:?}");
    assert_eq!(refused(&toy), [""; 0]);
    let apart = refused(&free);
    assert!(!apart.is_empty() && apart.iter().all(|name| name.contains("sight = cutting")), "{apart:?}");
    let looked = |toy: &Toy| toy.claim("shorter").across.map_or(0, |across| across.looked);
    assert_eq!((looked(&free), apart.len()), (3, 3));
    // Claims that look at no such path are judged under both.
    assert!(free.claim("fewer").across.unwrap().refused.is_empty());
    for toy in [&toy, &free] {
        for command in ["judge", "check", "explore"] {
            let output = toy.0.done(&[command, "./toy"]);
            assert!(
                output.contains("the verifier refuses many paths under sight = cutting"),
                "{command}: {output}"
            );
        }
    }
}
