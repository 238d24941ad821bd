//! Which readings count for a claim, on the small paper of [`across`](crate::across): those that it can tell apart, and those that
//! say something.

use crate::across::{CITED, FITTED, Toy, pair};
use replan::analysis::across::glance::Sight;
use replan::analysis::outcome::Outcome;
use replan::analysis::verdict::Effect;

/// The room's own reading table, so that the study of random maps alone has the weight as a reading.
const OTHERS: &str = r#"
[[reading]]
id = "hurry"
why = "the weight is not printed"
default = "three"
[reading.option.three]
paper = "section 1: the weight is three"
stage.astar = { weight = 3 }
[reading.option.none]
practice = "textbooks"
stage.astar = { weight = 0 }

[[reading]]
id = "reach"
why = "how the sides meet is not printed"
default = "any"
[reading.option.any]
paper = "section 1"
stage.bidirectional = { meeting = "generated_any" }
[reading.option.both]
paper = "section 1"
stage.bidirectional = { meeting = "both_closed" }
"#;

/// The small paper, in which the study of random maps alone has readings; contenders of the room are those of `room`.
fn readings_of_one_study(room: &str, more: &[(&str, &str)]) -> Toy {
    let toy = Toy::written(more);
    let text = |name: &str| std::fs::read_to_string(toy.0.at("toy").join(name)).unwrap();
    let without = |text: String| text.split("\n[[reading]]").next().unwrap().to_owned();
    toy.0.write("toy/draws.toml", (without(text("draws.toml")) + OTHERS).as_bytes());
    let rest = without(text("room.toml")).replace("[explore]\ndraws = 1\n", "");
    toy.0.write("toy/room.toml", (rest + room).as_bytes());
    toy.0.done(&["run", "./toy"]);
    toy.0.done(&["explore", "./toy"]);
    toy
}

#[test]
fn a_reading_that_the_study_of_a_witness_does_not_have_is_not_looked_at_if_it_touches_its_contender() {
    let toy = readings_of_one_study("", &[]);
    let first = toy.stored("explored.toml.gz");
    let claim = &first.claims["witness"];
    let sights: Vec<(Sight, usize)> =
        claim.results.iter().map(|found| (found.sight, found.readings.len())).collect();
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
    let toy = readings_of_one_study("", &[]);
    assert_eq!(toy.said("calibrated"), pair("supported", "not varied: hurry"));
    // With the reading in the room too, its other option was asked.
    assert_eq!(Toy::new(&[CITED, FITTED]).said("calibrated"), pair("fitted", "met under 1 of 2"));
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
    let toy = readings_of_one_study(DEPARTS, &[EITHER]);
    assert_eq!(toy.said("witness"), pair("attainable", "met under 1 of 2, hurry = none among them"));
    let judged = toy.claim("witness");
    assert_eq!(judged.outcome, Outcome::Open);
    let because = judged.findings[0].because.join("; ");
    assert!(because.contains("met by none of 1 trial"), "{because}");
    assert!(
        because.contains("met under another reading, hurry=none, where it counts: room/room/"),
        "{because}"
    );
}

#[test]
fn what_contenders_depart_to_together_is_explored() {
    let both = DEPARTS.replace("{ hurry = \"none\" }", "{ hurry = \"none\", reach = \"both\" }");
    let toy = readings_of_one_study(&both, &[EITHER, ("sample = 20", "sample = 0")]);
    let first = toy.stored("explored.toml.gz");
    let together =
        [("hurry", "none"), ("reach", "both")].map(|(id, option)| (id.to_owned(), option.to_owned()));
    assert!(first.place(&together.into()).is_some(), "{:?}", first.readings);
    assert_eq!(toy.said("witness").1, "met under 1 of 2, hurry = none, reach = both among them");
}

#[test]
fn a_contender_cannot_depart_from_a_reading_that_its_study_has() {
    let departs = ("label = \"A*\"\nplanner", "label = \"A*\"\ndeparts = { hurry = \"none\" }\nplanner");
    let toy = Toy::written(&[CITED, departs]);
    let said = toy.0.run(&["check", "./toy"]);
    assert_eq!(said.code, Some(2));
    assert!(said.err.contains("departs from reading `hurry`, which its study has"), "{}", said.err);
    toy.0.edit("toy/room.toml", "hurry = \"none\"", "haste = \"none\"");
    let said = toy.0.run(&["check", "./toy"]);
    assert!(said.err.contains("there is no reading `haste`; there are hurry, idle"), "{}", said.err);
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
    assert_eq!(toy.said("best"), pair("attainable", "met under 2 of 2"));
    let across = judged.across.unwrap();
    let effect = &across.effects["hurry"];
    assert_eq!(
        (effect.effect, effect.option.as_str(), effect.outcome),
        (Effect::Outcome, "none", Outcome::Attainable)
    );
}

#[test]
fn a_reading_under_which_too_few_draws_are_solved_has_no_power_and_is_not_looked_at() {
    let crowd = "[[reading]]\nid = \"crowd\"\nwhy = \"how much is blocked is not printed\"\ndefault = \"fifth\"\n\
         [reading.option.fifth]\npaper = \"section 4\"\nproblem = { blocked_share = 0.2 }\n\
         [reading.option.most]\npaper = \"section 4\"\nproblem = { blocked_share = 0.65 }\n[[contender]]\nlabel = \"Lazy\"";
    let toy = Toy::new(&[("[[contender]]\nlabel = \"Lazy\"", crowd)]);
    let first = toy.stored("explored.toml.gz");
    let powerless: Vec<_> =
        first.claims["fewer"].results.iter().filter(|found| found.sight == Sight::Powerless).collect();
    assert!(!powerless.is_empty() && powerless.iter().all(|found| found.n < 10), "{powerless:?}");
    let across = toy.claim("fewer").across.unwrap();
    assert_eq!(toy.said("fewer"), pair("reproduced", "same under all 3"));
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
    assert_eq!(toy.said("fewer").0, "reproduced");
    assert_eq!(toy.claim("fewer").findings[0].premises, ["hurry is three"]);
    let path = toy.0.at("toy/paper.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    for (from, to, refused) in [
        ("hurry = [\"three\"]", "hurri = [\"three\"]", "holds_when: there is no reading `hurri`"),
        ("\"three\"", "\"tree\"", "holds_when.hurry: there is no option `tree` (did you mean `three`?)"),
        ("[\"three\"]", "[]", "holds_when.hurry: names no option; the options are none, three"),
    ] {
        std::fs::write(&path, text.replace(from, to)).unwrap();
        let said = toy.0.run(&["check", "./toy"]);
        let line = text.lines().position(|line| line.starts_with("holds_when")).unwrap() + 1;
        let place = format!("paper.toml:{line}:");
        assert!(said.err.contains(refused) && said.err.contains(&place), "{to}: {}", said.err);
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

/// A reading whose options are numbers, of which the room and the maps have the table.
const NUMBERS: &str = "[[reading]]\nid = \"hurry\"\nwhy = \"the weight is not printed\"\ndefault = \"three\"\n\
     bounds = { least = 1.0, greatest = 4.0, source = \"a handbook\" }\n\
     [reading.option.three]\nvalue = 3\nstage.astar = { weight = 3 }\n[reading.option.none]\nvalue = 0\nstage.astar = { weight = 0 }\n";

#[test]
fn numbers_vote_within_their_bounds_and_bounds_that_are_not_whole_are_refused() {
    let table = crate::across::READINGS.split("\n[[reading]]\nid = \"idle\"").next().unwrap();
    let toy = Toy::new(&[(table, NUMBERS)]);
    assert_eq!(toy.said("fewer"), pair("reproduced", "same under all 3"));
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
        ("value = 0\n", "value = 0\nonly_with = { haste = [] }\n", "only_with: there is no reading `haste`"),
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
        let before = ["draws", "room"].map(|name| {
            let path = toy.0.at(&format!("toy/{name}.toml"));
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(text.contains(from), "{from}");
            std::fs::write(&path, text.replace(from, to)).unwrap();
            (path, text)
        });
        let said = toy.0.run(&["check", "./toy"]);
        assert_eq!(said.code, Some(2), "{to}");
        assert!(said.err.contains(refused), "{to}: {}", said.err);
        for (path, text) in before {
            std::fs::write(path, text).unwrap();
        }
    }
}

/// An arm among one obstacle, of whose starts one reading has that within the obstacle.
const ARM: &str = r#"
paper = "toy"
question = "How long is the way?"
seed = 7
second_seed = 8
[explore]
draws = 1
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
[[reading]]
id = "start"
why = "the start is not printed"
default = "free"
[reading.option.free]
paper = "section 5"
problem = { start_cm = [49, 3] }
[reading.option.blocked]
paper = "section 5"
problem = { start_cm = [35, 18] }
"#;

const REACH: (&str, &str) = (
    "[[claim]]\nid = \"calibrated\"",
    "[[claim]]\nid = \"reach\"\nat = \"section 5\"\nsays = \"the way is short\"\n\
     check.on_every = { that = \"at_most\", bound = 100.0, \
     of = { study = \"arm\", problems = \"arm\", contender = \"A*\", metric = \"path_length_cm\" } }\n\
     [[claim]]\nid = \"calibrated\"",
);

#[test]
fn a_reading_under_which_the_problem_cannot_be_posed_is_not_looked_at() {
    let toy = Toy::written(&[REACH]);
    toy.0.write("toy/arm.toml", ARM.as_bytes());
    toy.0.done(&["run", "./toy"]);
    toy.0.done(&["explore", "./toy"]);
    let first = toy.stored("explored.toml.gz");
    let sights: Vec<(Sight, Outcome)> =
        first.claims["reach"].results.iter().map(|found| (found.sight, found.outcome)).collect();
    assert_eq!(sights, [(Sight::Looked, Outcome::Holds), (Sight::Powerless, Outcome::Open)]);
    // Under one reading it holds, and the other says nothing: it is no vote that leaves it open.
    let judged = toy.claim("reach");
    assert_eq!(judged.verdict.name(), "reproduced");
    let across = judged.across.unwrap();
    assert_eq!((across.counted, across.holds, across.looked, across.not_looked_at), (1, 1, 3, 3));
}

/// A line of sight that cuts through blocked cells, as one of two options.
const SIGHT: &str = "[[reading]]\nid = \"sight\"\nwhy = \"the line of sight is not printed\"\ndefault = \"exact\"\n\
     [reading.option.exact]\npaper = \"section 4\"\nstage.lazy_theta_star = { line_of_sight = \"exact_interior\" }\n\
     [reading.option.cutting]\npaper = \"section 4\"\nstage.lazy_theta_star = { line_of_sight = \"bresenham\" }\n\
     [[contender]]\nlabel = \"Lazy\"";

#[test]
fn a_reading_whose_paths_the_verifier_refuses_is_set_apart_where_the_paper_calls_its_paths_free() {
    let sight = ("[[contender]]\nlabel = \"Lazy\"", SIGHT);
    let free = ("sample = 20", "sample = 20\nrefused_above_percent = 5");
    let (toy, free) = (Toy::new(&[sight]), Toy::new(&[sight, free]));
    let refused = |toy: &Toy| toy.claim("shorter").across.map(|across| across.refused).unwrap_or_default();
    let first = toy.stored("explored.toml.gz");
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
        let said = toy.0.done(&["judge", "./toy"]);
        assert!(said.contains("the verifier refuses many paths under sight = cutting"), "{said}");
    }
}
