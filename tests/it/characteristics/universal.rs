//! Criteria that ask of every trial, or of any: equals, exists, `on_every`, `prints_as`.

use super::numbers::{never_firm, never_reproduced};
use super::scenario::{Bounds, Scenario, World};
use super::synthetic::{ASKED, End, Made, Sample};
use base::seed::Stream;
use rand::RngExt as _;

/// Trials of an ordinary study.
const MANY: usize = 100;

/// Trials of one that says little.
const FEW: usize = 5;

/// The shares of trials that contradict a claim: none, many, few.
const KINDS: [(&str, usize, f64); 4] = [
    ("true", MANY, 0.0),
    ("false", MANY, 0.3),
    ("false by a little", MANY, 0.01),
    ("underpowered", FEW, 0.3),
];

pub fn scenarios() -> Vec<Scenario> {
    let every = [EQUALS, ON_EVERY, SOLVED].into_iter().flat_map(of_every);
    every.chain(exists()).chain(prints_as()).collect()
}

/// A criterion that one counterexample ends.
struct Every {
    criterion: &'static str,
    settings: &'static str,
    /// What is claimed of A.
    says: &'static str,
    /// What A does where it is not so, and the optimum costs this.
    wrong: fn(f64) -> End,
}

const COSTLY: fn(f64) -> End = |optimal| End::At(1.1 * optimal);

const EQUALS: Every = Every {
    criterion: "equals",
    settings: "select = { study = \"drawn\", problems = \"map\", contender = \"A\", metric = \"path_cost_cells\" }\ntruth = \
               \"optimal_cost_cells\"\n",
    says: "A's cost is the optimal one on every map",
    wrong: COSTLY,
};

const ON_EVERY: Every = Every {
    criterion: "on_every",
    settings: "select = { study = \"drawn\", problems = \"map\", contender = \"A\", against = \"B\", metric = \
               \"path_cost_cells\" }\nthat = \"at_most_times\"\nbound = 1.0\n",
    says: "A costs no more than B on every map",
    wrong: COSTLY,
};

const SOLVED: Every = Every {
    criterion: "on_every",
    settings: "select = { study = \"drawn\", problems = \"map\", contender = \"A\", against = \"B\" }\nthat = \"solved\"\n",
    says: "A solves every map that B solves",
    wrong: |_| End::NoPath,
};

fn claim(criterion: &str, settings: &str) -> String {
    format!(
        "[[claim]]\nid = \"{ASKED}\"\nat = \"here\"\nprinted = \"0\"\n[claim.check.{criterion}]\n{settings}"
    )
}

/// `instances` maps, on a share `share` of which A does not find the optimum that B finds but ends `wrong`; where the budget is
/// spent, it would have.
fn drawn(stream: &mut Stream, instances: usize, share: f64, wrong: fn(f64) -> End, is_spent: bool) -> Sample {
    let mut sample = Sample::default();
    for index in 0..instances {
        let optimal = 10.0 + stream.random::<f64>();
        let is_wrong = stream.random::<f64>() < share;
        let own = if is_wrong { wrong(optimal) } else { End::At(optimal) };
        sample.instance();
        let is_spent = is_spent && (is_wrong || index == 0);
        for (label, end) in [("A", if is_spent { End::Spent } else { own }), ("B", End::At(optimal))] {
            sample.trial(label, end);
            sample.with("optimal_cost_cells", optimal);
        }
    }
    sample
}

fn of_every(Every { criterion, settings, says, wrong }: Every) -> Vec<Scenario> {
    let scenario = |truth, instances, share: f64, made, bounds| {
        let is_spent = truth == "censored";
        let world = move |stream: &mut Stream| {
            World::new(drawn(stream, instances, share, wrong, is_spent).records(), share == 0.0)
        };
        let tail = if is_spent { ", those that would contradict it without an end" } else { "" };
        let about = format!("{says}; {} % contradict it{tail}; {instances} maps", 100.0 * share);
        let claim = claim(criterion, settings);
        let world = Box::new(world);
        Scenario { criterion, truth, about, claim, made, world, bounds }
    };
    let plain = |(truth, instances, share): (&'static str, usize, f64)| {
        // It is missed if no trial shows it.
        let bounds = Bounds {
            false_for: Some(libm::pow(1.0 - share, instances as f64)),
            false_against: Some(0.0),
            right: (truth == "true" || truth == "false").then_some(1.0),
            ..Bounds::default()
        };
        scenario(truth, instances, share, Made::Plainly, bounds)
    };
    let mut all: Vec<Scenario> = KINDS.into_iter().map(plain).collect();
    all.push(scenario("fitted", MANY, 0.0, Made::Fitted, never_reproduced()));
    all.push(scenario("searched", MANY, 0.0, Made::Searched, never_reproduced()));
    all.push(scenario("censored", MANY, 0.3, Made::Plainly, never_firm()));
    all
}

/// Costs that are whole numbers; what is printed is one of them, lies between two, or is one that is rare.
fn exists() -> Vec<Scenario> {
    let settings = "metric = \"path_cost_cells\"\ncontenders = \"A\"\nin = [{ study = \"drawn\", problems = \"map\" }]\n";
    let scenario = |truth, instances, share: f64, made, bounds| {
        let is_spent = truth == "censored";
        let is_possible = share > 0.0;
        let world = move |stream: &mut Stream| {
            let mut sample = Sample::default();
            for _ in 0..instances {
                sample.instance();
                let is_met = stream.random::<f64>() < share;
                let other = f64::from(20 + stream.random_range(0..10));
                let end = if is_met { End::At(12.0) } else { End::At(other) };
                sample.trial("A", if is_spent && is_met { End::Spent } else { end });
            }
            let printed = if is_possible { "12" } else { "24.5" };
            World::new(sample.records(), is_possible).printing(printed.to_owned())
        };
        let tail = if is_spent { ", on which the budget is spent" } else { "" };
        let about =
            format!("the printed number is met by {} % of inputs{tail}; {instances} maps", 100.0 * share);
        let claim = claim("exists", settings);
        let world = Box::new(world);
        Scenario { criterion: "exists", truth, about, claim, made, world, bounds }
    };
    let never = Bounds { false_for: Some(0.0), false_against: Some(0.0), ..never_reproduced() };
    let missed = |instances: usize, share: f64| Bounds {
        right: Some(1.0 - libm::pow(1.0 - share, instances as f64)),
        ..never
    };
    vec![
        scenario("true", MANY, 0.1, Made::Plainly, missed(MANY, 0.1)),
        scenario("false", MANY, 0.0, Made::Plainly, never),
        scenario("false by a little", 10 * MANY, 0.0, Made::Plainly, never),
        scenario("underpowered", FEW, 0.1, Made::Plainly, missed(FEW, 0.1)),
        scenario("fitted", MANY, 0.1, Made::Fitted, never),
        scenario("searched", MANY, 0.1, Made::Searched, never),
        scenario("censored", MANY, 0.1, Made::Plainly, never_firm()),
    ]
}

/// One cost on every map; what is printed has one decimal.
fn prints_as() -> Vec<Scenario> {
    let settings = "select = { study = \"drawn\", problems = \"map\", contender = \"A\", metric = \"path_cost_cells\" }\n";
    let scenario = |truth, off: f64, made, bounds| {
        let is_spent = truth == "censored";
        let world = move |stream: &mut Stream| {
            let cost = 100.0 * stream.random::<f64>();
            let mut sample = Sample::default();
            for index in 0..if truth == "underpowered" { 1 } else { 12 } {
                sample.instance();
                sample.trial("A", if is_spent && index == 0 { End::Spent } else { End::At(cost) });
            }
            let printed = format!("{:.1}", cost + off);
            World::new(sample.records(), off == 0.0 && !is_spent).printing(printed)
        };
        let tail = if is_spent { "; on one map the budget is spent" } else { "" };
        let about = format!("the same cost on every map{tail}, printed {off} too high");
        let claim = claim("prints_as", settings).replacen("printed", "digits = \"rounded\"\nprinted", 1);
        Scenario { criterion: "prints_as", truth, about, claim, made, world: Box::new(world), bounds }
    };
    let exact =
        Bounds { false_for: Some(0.0), false_against: Some(0.0), right: Some(1.0), ..Bounds::default() };
    vec![
        scenario("true", 0.0, Made::Plainly, exact),
        scenario("false", 10.0, Made::Plainly, exact),
        scenario("false by a little", 0.1, Made::Plainly, exact),
        scenario("underpowered", 0.1, Made::Plainly, exact),
        scenario("fitted", 0.0, Made::Fitted, never_reproduced()),
        scenario("searched", 0.0, Made::Searched, never_reproduced()),
        scenario("censored", 0.0, Made::Plainly, never_firm()),
    ]
}
