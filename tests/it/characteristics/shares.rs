//! Criteria of shares and of single instances: share, `one_instance`, `row_one_instance`, and lower along a sweep.

use super::numbers::{never_firm, never_reproduced};
use super::scenario::{Bounds, Scenario, World};
use super::synthetic::{ASKED, End, Made, SWEEP, Sample};
use super::theory::{normal, one_end, taken_for_ordinary};
use base::seed::Stream;
use rand::RngExt as _;

/// Queries of an instance, where it has several.
const QUERIES: u32 = 10;

pub fn scenarios() -> Vec<Scenario> {
    [
        share_of_trials(&SOLVED),
        share_of_trials(&MARKED),
        share_of_instances(),
        one_instance(),
        one_instance_of_shares(),
        rows(),
        curves(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn claim(criterion: &str, settings: &str) -> String {
    format!(
        "[[claim]]\nid = \"{ASKED}\"\nat = \"here\"\nprinted = \"0\"\n[claim.check.{criterion}]\n{settings}"
    )
}

const OF_A: &str = "select = { study = \"drawn\", problems = \"map\", contender = \"A\" }\n";

fn at_most(bound: f64) -> Bounds {
    Bounds { false_for: Some(bound), false_against: Some(bound), ..Bounds::default() }
}

fn right(bounds: Bounds) -> Bounds {
    Bounds { right: Some(0.9), ..bounds }
}

/// What a share counts: the setting, in words, and how a trial ends that is no hit.
struct Counted {
    hits: &'static str,
    label: &'static str,
    missed: End,
}

const SOLVED: Counted = Counted { hits: "hits = \"solved\"", label: "are solved", missed: End::NoPath };

const MARKED: Counted = Counted {
    hits: "hits = \"marked\"\ncolumns = [\"optimal_cost_cells\"]",
    label: "have a mark",
    missed: End::At(1.0),
};

/// One query a map: the share of hits, claimed to be at least nine in ten.
fn share_of_trials(Counted { hits, label, missed }: &'static Counted) -> Vec<Scenario> {
    let scenario = |truth, instances: usize, share: f64, made, bounds| {
        let is_censored = truth == "censored";
        let world = move |stream: &mut Stream| {
            let mut sample = Sample::default();
            for index in 0..instances {
                sample.instance();
                let is_hit = stream.random::<f64>() < share && index > 0;
                let missed = if is_censored { End::Spent } else { *missed };
                sample.trial("A", if is_hit { End::At(1.0) } else { missed });
                if is_hit || missed.is_at() {
                    sample.with("optimal_cost_cells", f64::from(u8::from(is_hit)));
                }
            }
            World::new(sample.records(), share >= 0.9)
        };
        let tail = if is_censored { ", the others without an end" } else { "" };
        let about = format!("{:.2} % {label}{tail}, 90 % claimed; {instances} maps", 100.0 * share);
        let claim = claim("share", &format!("{OF_A}{hits}\naccepted = [0.9, 1.0]\n"));
        Scenario { criterion: "share", truth, about, claim, made, world: Box::new(world), bounds }
    };
    let plain = Made::Plainly;
    vec![
        scenario("true", 200, 0.97, plain, right(at_most(0.025))),
        scenario("false", 200, 0.7, plain, right(at_most(0.025))),
        scenario("true by a little", 200, 0.9001, plain, at_most(0.025)),
        scenario("false by a little", 200, 0.8999, plain, at_most(0.025)),
        scenario("underpowered", 10, 0.8999, plain, at_most(0.025)),
        scenario("fitted", 200, 0.97, Made::Fitted, never_reproduced()),
        scenario("searched", 200, 0.97, Made::Searched, never_reproduced()),
        scenario("censored", 200, 0.7, plain, never_firm()),
    ]
}

/// Ten queries a map, which are solved with a chance that is the map's own: even from 0.6 to 1, so 80 % in all.
fn share_of_instances() -> Vec<Scenario> {
    let scenario = |truth, instances: usize, claimed: f64, bounds| {
        let world = move |stream: &mut Stream| {
            let mut sample = Sample::default();
            for _ in 0..instances {
                sample.instance();
                let chance = 0.6 + 0.4 * stream.random::<f64>();
                queries(&mut sample, stream, "A", None, chance);
            }
            World::new(sample.records(), claimed <= 0.8)
        };
        let about = format!(
            "80 % of ten queries a map are solved, more on some maps than on others; {:.2} % claimed; {instances} maps",
            100.0 * claimed
        );
        let claim = claim("share", &format!("{OF_A}{}\naccepted = [{claimed}, 1.0]\n", SOLVED.hits));
        let made = Made::Plainly;
        let world = Box::new(world);
        Scenario { criterion: "share", truth, about, claim, made, world, bounds }
    };
    vec![
        scenario("true by a little", 30, 0.7999, at_most(one_end(30))),
        scenario("false by a little", 30, 0.8001, at_most(one_end(30))),
        scenario("underpowered", 5, 0.8001, never_firm()),
    ]
}

fn queries(
    sample: &mut Sample,
    stream: &mut Stream,
    contender: &str,
    swept: Option<i64>,
    chance: f64,
) -> u32 {
    let mut solved = 0;
    for query in 0..QUERIES {
        let is_solved = stream.random::<f64>() < chance;
        solved += u32::from(is_solved);
        let end = if is_solved { End::At(1.0) } else { End::NoPath };
        sample.query(contender, Some(query), swept, end);
    }
    solved
}

/// A cost that is normal, 100 give or take 10; printed is one more of ours, so many standard deviations off.
fn one_instance() -> Vec<Scenario> {
    let settings = "select = { study = \"drawn\", problems = \"map\", contender = \"A\", metric = \"path_cost_cells\" }\nstatistic = \
                    \"mean\"\n";
    let scenario = |truth, instances: usize, shift: f64, made, bounds| {
        let is_censored = truth == "censored";
        let world = move |stream: &mut Stream| {
            let mut sample = Sample::default();
            for index in 0..instances {
                sample.instance();
                let own = 100.0 + 10.0 * normal(stream);
                let is_spent = is_censored && (own > 110.0 || index == 0);
                sample.trial("A", if is_spent { End::Spent } else { End::At(own) });
            }
            let printed = 100.0 + 10.0 * (normal(stream) + shift);
            World::new(sample.records(), shift == 0.0).printing(format!("{printed:.4}"))
        };
        let tail = if is_censored { "; the costly ones without an end" } else { "" };
        let about =
            format!("printed is one more instance, {shift} standard deviations off; {instances} maps{tail}");
        let claim = claim("one_instance", settings);
        Scenario { criterion: "one_instance", truth, about, claim, made, world: Box::new(world), bounds }
    };
    let plain = Made::Plainly;
    let ordinary = |shift: f64| Bounds {
        false_for: Some(taken_for_ordinary(shift)),
        false_against: Some(0.05),
        ..Bounds::default()
    };
    // Only what is printed far above every instance of ours, ended or not, is refused by those without an end too.
    let censored = Bounds { false_against: Some(0.05), ..Bounds::default() };
    vec![
        scenario("true", 200, 0.0, plain, Bounds { right: Some(0.95), ..ordinary(0.0) }),
        scenario("true", 39, 0.0, plain, Bounds { right: Some(0.95), ..ordinary(0.0) }),
        scenario("false", 200, 6.0, plain, right(ordinary(6.0))),
        scenario("false by a little", 200, 1.0, plain, ordinary(1.0)),
        scenario("underpowered", 38, 6.0, plain, never_firm()),
        scenario("fitted", 200, 0.0, Made::Fitted, never_reproduced()),
        scenario("searched", 200, 0.0, Made::Searched, never_reproduced()),
        scenario("censored", 200, 0.0, plain, censored),
    ]
}

/// The share of a map's ten queries that is solved, its chance even over `low..low + 0.2`; printed at a chance that is `off`.
fn one_instance_of_shares() -> Vec<Scenario> {
    let settings = "select = { study = \"drawn\", problems = \"map\", contender = \"A\" }\nstatistic = \"solved_percent\"\n";
    let scenario = |truth, spread: f64, off: f64, bounds| {
        let world = move |stream: &mut Stream| {
            let mut sample = Sample::default();
            let chance = |stream: &mut Stream| 0.5 + spread * (stream.random::<f64>() - 0.5);
            for _ in 0..200 {
                sample.instance();
                let chance = chance(stream);
                queries(&mut sample, stream, "A", None, chance);
            }
            let printed = chance(stream) - off;
            let solved = queries(&mut Sample::default().begun(), stream, "A", None, printed);
            World::new(sample.records(), off == 0.0).printing(format!("{}", 10 * solved))
        };
        let about = format!(
            "a share of ten queries, 50 % give or take {} from map to map; printed {} lower; 200 maps",
            50.0 * spread,
            100.0 * off
        );
        let claim = claim("one_instance", settings);
        let made = Made::Plainly;
        Scenario { criterion: "one_instance", truth, about, claim, made, world: Box::new(world), bounds }
    };
    vec![
        scenario("true", 0.2, 0.0, Bounds { false_against: Some(0.05), ..Bounds::default() }),
        scenario(
            "underpowered",
            1.0,
            0.0,
            Bounds { false_for: Some(0.0), firm: Some(0.0), ..Bounds::default() },
        ),
    ]
}

/// Rows of shares along the sweep, each map with a level of its own; printed is one more row, so many standard deviations off.
fn rows() -> Vec<Scenario> {
    let cells: Vec<String> = SWEEP.iter().map(|value| format!("c{value}")).collect();
    let settings = format!(
        "select = {{ study = \"drawn\", problems = \"map\" }}\nrows = [{{ contender = \"A\", claims = {cells:?} }}]\nrefused_below = 0.05\n"
    );
    let cell = |id: &String| {
        format!("[[claim]]\nid = \"{id}\"\nat = \"here\"\nprinted = \"0\"\nuntestable = \"a cell\"\n")
    };
    let text = claim("row_one_instance", &settings) + &cells.iter().map(cell).collect::<String>();
    let scenario = |truth, instances: usize, off: f64, made, bounds| {
        let is_censored = truth == "censored";
        let world = move |stream: &mut Stream| {
            let mut sample = Sample::default();
            for _ in 0..instances {
                sample.instance();
                row(&mut sample, stream, if is_censored { 0.6 } else { 0.0 });
            }
            if is_censored {
                sample.spend();
            }
            let printed = row(&mut Sample::default().begun(), stream, off);
            let cells = ["c1", "c2", "c3", "c4"].into_iter().zip(printed);
            let printed = cells.map(|(id, solved)| (id, (10 * solved).to_string())).collect();
            World { printed, ..World::new(sample.records(), off == 0.0) }
        };
        let tail =
            if is_censored { "; ours 0.6 lower, the queries that are not solved without an end" } else { "" };
        let about =
            format!("printed is one more row, each cell's chance {off} lower; {instances} maps{tail}");
        Scenario {
            criterion: "row_one_instance",
            truth,
            about,
            claim: text.clone(),
            made,
            world: Box::new(world),
            bounds,
        }
    };
    let ordinary = Bounds { false_against: Some(0.1), ..Bounds::default() };
    vec![
        scenario("true", 200, 0.0, Made::Swept, right(ordinary)),
        scenario("true", 40, 0.0, Made::Swept, ordinary),
        scenario("false", 200, 0.6, Made::Swept, right(at_most(0.05))),
        scenario("false by a little", 200, 0.1, Made::Swept, ordinary),
        scenario("underpowered", 39, 0.6, Made::Swept, never_firm()),
        scenario("censored", 200, 0.0, Made::Swept, never_firm()),
        scenario("fitted", 200, 0.0, Made::SweptFitted, never_reproduced()),
        scenario("searched", 200, 0.0, Made::SweptSearched, never_reproduced()),
    ]
}

/// A row of one map: solved of ten at each point, rising from about 0.4 to 0.8, with a level of its own.
fn row(sample: &mut Sample, stream: &mut Stream, off: f64) -> Vec<u32> {
    let level = 0.2 * (stream.random::<f64>() - 0.5) - off;
    let chance = |value: i64| (0.3 + 0.125 * value as f64 + level).clamp(0.0, 1.0);
    SWEEP.iter().map(|value| queries(sample, stream, "A", Some(*value), chance(*value))).collect()
}

/// A solves more than B all along the sweep, by `more` of all queries.
fn curves() -> Vec<Scenario> {
    let settings = "select = { study = \"drawn\", problems = \"map\", contender = \"A\", against = \"B\" }\nis = \"higher\"\n";
    let scenario = |truth, instances: usize, more: f64, bounds| {
        let world = move |stream: &mut Stream| {
            let mut sample = Sample::default();
            for _ in 0..instances {
                sample.instance();
                row(&mut sample, stream, -more);
                for value in SWEEP {
                    queries(&mut sample, stream, "B", Some(value), 0.3 + 0.125 * value as f64);
                }
            }
            World::new(sample.records(), more > 0.0)
        };
        let about = format!(
            "A solves {:.0} points more than B at each of four points of a sweep; {instances} maps",
            100.0 * more
        );
        let claim = claim("lower", settings);
        let made = Made::Swept;
        Scenario { criterion: "lower", truth, about, claim, made, world: Box::new(world), bounds }
    };
    // All four points at once: neither end of a simultaneous band errs more often than both ends of one interval.
    let bounds = at_most(2.0 * one_end(40));
    vec![
        scenario("true", 40, 0.25, right(bounds)),
        scenario("false", 40, -0.25, right(bounds)),
        scenario("false by a little", 40, 0.0, bounds),
        scenario("underpowered", 5, 0.0, never_firm()),
    ]
}
