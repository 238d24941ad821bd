//! Criteria that hold an interval of means, medians, ratios or slopes against a number: within, lower, trend, `least_of`.

use super::scenario::{Bounds, Scenario, World};
use super::synthetic::{End, Made, Sample};
use super::theory::{normal, one_end, one_end_of_median, one_end_of_skewed};
use base::seed::Stream;
use rand::RngExt as _;
use stats::proportion::normal_quantile;
use study::store::Records;

/// Instances of an ordinary study.
const MANY: usize = 30;

/// Fewest instances of which an interval decides.
const FEWEST: usize = 10;

/// Fewer than an interval decides by.
const TOO_FEW: usize = 5;

pub fn scenarios() -> Vec<Scenario> {
    [within(), within_of_one(), lower(), agreed(), clocked(), trend(), least_of()]
        .into_iter()
        .flatten()
        .collect()
}

/// Costs of A and B on `instances` maps: B's is lognormal, A's is `change` per cent more, give or take 10 % of B's.
fn paired(stream: &mut Stream, instances: usize, change: f64) -> Vec<(f64, f64)> {
    let one = |stream: &mut Stream| {
        let base = 100.0 * libm::exp(0.3 * normal(stream));
        (base, base * (1.0 + change / 100.0 + 0.1 * normal(stream)))
    };
    (0..instances).map(|_| one(stream)).collect()
}

/// By how many per cent the sum of A is below that of B.
fn reduction(pairs: &[(f64, f64)]) -> f64 {
    let sums = pairs.iter().fold([0.0, 0.0], |sum, (base, own)| [sum[0] + base, sum[1] + own]);
    100.0 * (1.0 - sums[1] / sums[0])
}

fn recorded(pairs: &[(f64, f64)]) -> Records {
    let mut sample = Sample::default();
    for (base, own) in pairs {
        sample.instance();
        sample.trial("A", End::At(*own));
        sample.trial("B", End::At(*base));
    }
    sample.records()
}

/// The same, where on a fifth of the maps A spends its budget and would cost three times as much as B.
fn spent(stream: &mut Stream, pairs: &[(f64, f64)]) -> Records {
    let mut sample = Sample::default();
    for (index, (base, own)) in pairs.iter().enumerate() {
        sample.instance();
        let is_hard = index == 0 || stream.random_range(0..5) == 0;
        sample.trial("A", if is_hard { End::Spent } else { End::At(*own) });
        sample.trial("B", End::At(*base));
    }
    sample.records()
}

const PAIRED: &str = "select = { study = \"drawn\", problems = \"map\", contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }\n";

fn claim(criterion: &str, settings: &str) -> String {
    format!(
        "[[claim]]\nid = \"asked\"\nat = \"here\"\nprinted = \"0\"\n[claim.check.{criterion}]\n{settings}"
    )
}

fn none() -> Bounds {
    Bounds::default()
}

fn at_most(bound: f64) -> Bounds {
    Bounds { false_for: Some(bound), false_against: Some(bound), ..none() }
}

/// What must never be firm.
pub fn never_firm() -> Bounds {
    Bounds { firm: Some(0.0), ..at_most(0.0) }
}

/// What must never be called reproduced, whatever it is called otherwise.
pub fn never_reproduced() -> Bounds {
    Bounds { reproduced: Some(0.0), ..none() }
}

/// A reduction that the paper prints as what its own maps gave: true is 20 %, the margin 10 points, `off` what was added.
fn printed_reduction(
    truth: &'static str,
    instances: usize,
    made: Made,
    off: f64,
    bounds: Bounds,
) -> Scenario {
    let world = move |stream: &mut Stream| {
        let printed = reduction(&paired(stream, instances, -20.0)) + off;
        let records = recorded(&paired(stream, instances, -20.0));
        World::new(records, (printed - 20.0).abs() <= 10.0).of_true_sign().printing(format!("{printed:.3}"))
    };
    let about = match off {
        0.0 => {
            format!("a reduction of 20 %, printed from {instances} other maps, margin 10; {instances} maps")
        }
        off => format!(
            "a reduction of 20 %, printed {off} more than {instances} other maps give, margin 10; {instances} maps"
        ),
    };
    let claim = claim("within", &format!("{PAIRED}statistic = \"reduction_percent\"\nmargin = 10.0\n"));
    Scenario { criterion: "within", truth, about, claim, made, world: Box::new(world), bounds }
}

/// The same, printed at the very end of the margin.
fn reduction_at_the_margin(truth: &'static str, instances: usize, off: f64, bounds: Bounds) -> Scenario {
    let world = move |stream: &mut Stream| {
        let records = recorded(&paired(stream, instances, -20.0));
        World::new(records, off < 10.0).of_true_sign().printing(format!("{:.3}", 20.0 + off))
    };
    let about = format!("a reduction of 20 %, printed as {:.2}, margin 10; {instances} maps", 20.0 + off);
    let claim = claim("within", &format!("{PAIRED}statistic = \"reduction_percent\"\nmargin = 10.0\n"));
    Scenario { criterion: "within", truth, about, claim, made: Made::Plainly, world: Box::new(world), bounds }
}

fn within() -> Vec<Scenario> {
    let right = |least: f64| Bounds { right: Some(least), ..at_most(one_end(MANY)) };
    let mut all = vec![
        printed_reduction("true", MANY, Made::Plainly, 0.0, right(0.9)),
        printed_reduction("false", MANY, Made::Plainly, 30.0, right(0.9)),
        reduction_at_the_margin("true by a little", MANY, 9.99, at_most(one_end(MANY))),
        reduction_at_the_margin("false by a little", MANY, 10.01, at_most(one_end(MANY))),
        reduction_at_the_margin("false by a little", FEWEST, 10.01, at_most(one_end(FEWEST))),
        reduction_at_the_margin("underpowered", TOO_FEW, 10.01, never_firm()),
        printed_reduction("fitted", MANY, Made::Fitted, 0.0, never_reproduced()),
        printed_reduction("searched", MANY, Made::Searched, 0.0, never_reproduced()),
    ];
    let world = |stream: &mut Stream| {
        let pairs = paired(stream, MANY, -20.0);
        World::new(spent(stream, &pairs), false).printing("20".to_owned())
    };
    all.push(Scenario {
        criterion: "within",
        truth: "censored",
        about: format!("a reduction of 20 % where A ends; on a fifth of {MANY} maps it spends its budget"),
        claim: claim("within", &format!("{PAIRED}statistic = \"reduction_percent\"\nmargin = 10.0\n")),
        made: Made::Plainly,
        world: Box::new(world),
        bounds: never_firm(),
    });
    all
}

/// A statistic of A alone whose truth is `truth`, accepted from it to three times it: at the end, and a little beyond.
fn at_the_end(
    statistic: &'static str,
    about: &'static str,
    (instances, truth): (usize, f64),
    drawn: fn(&mut Stream) -> End,
    bound: f64,
) -> [Scenario; 2] {
    [("true by a little", 1.0 - 1e-4), ("false by a little", 1.0 + 1e-4)].map(|(of, share)| {
        let world = move |stream: &mut Stream| {
            let mut sample = Sample::default();
            for _ in 0..instances {
                sample.instance();
                sample.trial("A", drawn(stream));
            }
            World::new(sample.records(), share < 1.0)
        };
        let settings = format!(
            "select = {{ study = \"drawn\", problems = \"map\", contender = \"A\", metric = \"path_cost_cells\" }}\nstatistic = \
             \"{statistic}\"\naccepted = [{:.6}, {:.6}]\n",
            truth * share,
            3.0 * truth
        );
        Scenario {
            criterion: "within",
            truth: of,
            about: format!("{about}; {instances} maps"),
            claim: claim("within", &settings),
            made: Made::Plainly,
            world: Box::new(world),
            bounds: at_most(bound),
        }
    })
}

/// Spread of the logarithm of a skewed cost, and what follows of its mean and skewness.
const LOG_SPREAD: f64 = 0.6;

fn skewed(stream: &mut Stream) -> f64 {
    50.0 * libm::exp(LOG_SPREAD * normal(stream))
}

fn within_of_one() -> Vec<Scenario> {
    let square = libm::exp(LOG_SPREAD * LOG_SPREAD);
    let mean = 50.0 * square.sqrt();
    let skewness = (square + 2.0) * (square - 1.0).sqrt();
    let failing = |stream: &mut Stream| {
        if stream.random_range(0..10) == 0 { End::NoPath } else { End::At(skewed(stream)) }
    };
    let median = 50.0 * libm::exp(LOG_SPREAD * normal_quantile(0.5 / 0.9));
    let about_mean = "the mean of a lognormal cost (skewness 2.3), at the end of what is accepted";
    let about_median = "the median of the same cost, a tenth without a path, at the end of what is accepted";
    let plain = |stream: &mut Stream| End::At(skewed(stream));
    [
        at_the_end("mean", about_mean, (MANY, mean), plain, one_end_of_skewed(MANY, skewness)),
        at_the_end("mean", about_mean, (200, mean), plain, one_end_of_skewed(200, skewness)),
        at_the_end("median", about_median, (MANY, median), failing, one_end_of_median(MANY)),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn lower_than(
    truth: &'static str,
    instances: usize,
    (change, by): (f64, f64),
    made: Made,
    bounds: Bounds,
) -> Scenario {
    let world = move |stream: &mut Stream| {
        let world = World::new(recorded(&paired(stream, instances, change)), change < -by);
        World { sign: change < 0.0, ..world }
    };
    let least = if by > 0.0 { format!(" by at least {by} %") } else { String::new() };
    let about = format!("A lower than B{least}; its change is {change} %; {instances} maps");
    let claim = claim("lower", &format!("{PAIRED}by_percent = {by:.1}\n"));
    Scenario { criterion: "lower", truth, about, claim, made, world: Box::new(world), bounds }
}

fn lower() -> Vec<Scenario> {
    let right = |least: f64| Bounds { right: Some(least), ..at_most(one_end(MANY)) };
    let plain = Made::Plainly;
    let mut all = vec![
        lower_than("true", MANY, (-8.0, 0.0), plain, right(0.9)),
        lower_than("false", MANY, (8.0, 0.0), plain, right(0.9)),
        lower_than("true by a little", MANY, (-0.01, 0.0), plain, at_most(one_end(MANY))),
        lower_than("false by a little", MANY, (0.0, 0.0), plain, at_most(one_end(MANY))),
        lower_than("false by a little", MANY, (-19.99, 20.0), plain, at_most(one_end(MANY))),
        lower_than("false by a little", FEWEST, (0.0, 0.0), plain, at_most(one_end(FEWEST))),
        lower_than("underpowered", TOO_FEW, (0.0, 0.0), plain, never_firm()),
        lower_than("fitted", MANY, (-8.0, 0.0), Made::Fitted, never_reproduced()),
        lower_than("searched", MANY, (-8.0, 0.0), Made::Searched, never_reproduced()),
    ];
    let world = |stream: &mut Stream| {
        let pairs = paired(stream, MANY, -8.0);
        World::new(spent(stream, &pairs), false)
    };
    all.push(Scenario {
        criterion: "lower",
        truth: "censored",
        about: format!("A's change is -8 % where it ends; on a fifth of {MANY} maps it spends its budget"),
        claim: claim("lower", PAIRED),
        made: plain,
        world: Box::new(world),
        bounds: never_firm(),
    });
    all
}

/// A costs what B costs, and half of it on one map in twenty: 2.5 % less on the whole, though the maps drawn may all agree.
fn agreed() -> Vec<Scenario> {
    let world = |holds: bool| {
        move |stream: &mut Stream| {
            let of = |stream: &mut Stream, base: f64| {
                if stream.random_range(0..20) == 0 { base / 2.0 } else { base }
            };
            let bases = paired(stream, MANY, 0.0).into_iter().map(|(base, _)| base);
            let pairs: Vec<_> = bases.map(|base| (base, of(stream, base))).collect();
            World::new(recorded(&pairs), holds)
        }
    };
    let drawn =
        format!("A costs as much as B, but half on one map in twenty; {MANY} maps, which may all agree");
    let of = |criterion, truth, label: &str, settings: &str, holds| Scenario {
        criterion,
        truth,
        about: format!("{label}; {drawn}"),
        claim: claim(criterion, &format!("{PAIRED}{settings}\n")),
        made: Made::Plainly,
        world: Box::new(world(holds)),
        bounds: at_most(0.025),
    };
    vec![
        of("lower", "true by a little", "A lower than B by at least 2 %", "by_percent = 2.0", true),
        of(
            "within",
            "false by a little",
            "A's sum is B's, give or take 1 %",
            "statistic = \"ratio\"\naccepted = [0.99, 1.01]",
            false,
        ),
    ]
}

/// Two contenders that take equally long, under a load that differs from one session of the clock to the next.
fn clocked() -> Vec<Scenario> {
    [(2, "two", never_firm()), (3, "three", at_most(2.0 * 0.125))].map(|(sessions, count, bounds)| {
        let world = move |stream: &mut Stream| {
            let loads: Vec<f64> = (0..sessions).map(|_| 1.0 + 0.1 * normal(stream)).collect();
            let mut sample = Sample::default();
            for (base, own) in paired(stream, MANY, 0.0) {
                sample.instance();
                for (label, time, is_own) in [("A", own, true), ("B", base, false)] {
                    sample.trial(label, End::At(1.0));
                    for (session, load) in (1..).zip(&loads) {
                        sample.clock(session, 1e4 * time * if is_own { *load } else { 1.0 });
                    }
                }
            }
            World::new(sample.records(), false)
        };
        let claim = claim("lower", &PAIRED.replace("path_cost_cells", "plan_time_ms"));
        let about = format!("times of our own clock in {count} sessions, each with a load of its own (10 %); A is no faster");
        let bounds = Bounds { false_against: None, ..bounds };
        let made = Made::Timed;
        let truth = "own clock";
        Scenario { criterion: "lower", truth, about, claim, made, world: Box::new(world), bounds }
    })
    .into()
}

/// A cost that grows by `slope` with the optimal one, which is spread evenly over 10, with noise of 10.
fn grows(truth: &'static str, instances: usize, slope: f64, made: Made, bounds: Bounds) -> Scenario {
    let is_censored = truth == "censored";
    let world = move |stream: &mut Stream| {
        let mut sample = Sample::default();
        for index in 0..instances {
            let place = 10.0 * stream.random::<f64>();
            let number = 100.0 + slope * place + 10.0 * normal(stream);
            sample.instance();
            // The hard ones are those that do not end.
            let is_spent = is_censored && (place > 7.0 || index == 0);
            sample.trial("A", if is_spent { End::Spent } else { End::At(number) });
            sample.with("optimal_cost_cells", place);
        }
        World::new(sample.records(), slope > 0.0 && !is_censored)
    };
    let settings = "select = { study = \"drawn\", problems = \"map\", contender = \"A\", metric = \"path_cost_cells\" }\nover = \
                    \"optimal_cost_cells\"\nrising = true\n";
    let tail = if is_censored { "; those beyond 7 spend their budget" } else { "" };
    let about =
        format!("a cost that grows by {slope} a cell over 10 cells, noise 10; {instances} maps{tail}");
    let claim = claim("trend", settings);
    Scenario { criterion: "trend", truth, about, claim, made, world: Box::new(world), bounds }
}

fn trend() -> Vec<Scenario> {
    let right = |least: f64| Bounds { right: Some(least), ..at_most(one_end(MANY)) };
    let plain = Made::Plainly;
    vec![
        grows("true", MANY, 3.0, plain, right(0.9)),
        grows("false", MANY, -3.0, plain, right(0.9)),
        grows("true by a little", MANY, 0.01, plain, at_most(one_end(MANY - 1))),
        grows("false by a little", MANY, 0.0, plain, at_most(one_end(MANY - 1))),
        grows("underpowered", TOO_FEW, 0.0, plain, never_firm()),
        grows("fitted", MANY, 3.0, Made::Fitted, never_reproduced()),
        grows("searched", MANY, 3.0, Made::Searched, never_reproduced()),
        grows("censored", MANY, 3.0, plain, never_firm()),
    ]
}

/// A contender that draws, on one map: its median is `share` of the other's, a tenth of its trials find no path.
fn least(truth: &'static str, instances: usize, share: f64, made: Made, bounds: Bounds) -> Scenario {
    let spent = if truth == "censored" { 6 } else { 0 };
    let world = move |stream: &mut Stream| {
        let mut sample = Sample::default();
        for _ in 0..instances {
            sample.instance();
            let is_spent = stream.random_range(0..10) < spent;
            sample.trial("A", if is_spent { End::Spent } else { End::At(share * skewed(stream)) });
            sample.trial("B", End::At(skewed(stream)));
        }
        World::new(sample.records(), share < 1.0 && spent == 0)
    };
    let settings = "select = { study = \"drawn\", problems = \"map\", metric = \"path_cost_cells\" }\nlower = \"A\"\nhigher = [\"B\"]\n";
    let tail = if spent > 0 { "; A spends its budget on six in ten" } else { "" };
    let about = format!("A's median is {share} of B's, each of a lognormal cost; {instances} seeds{tail}");
    let claim = claim("least_of", settings);
    Scenario { criterion: "least_of", truth, about, claim, made, world: Box::new(world), bounds }
}

fn least_of() -> Vec<Scenario> {
    let right = |least: f64| Bounds { right: Some(least), ..at_most(0.025) };
    let plain = Made::Plainly;
    vec![
        least("true", MANY, 0.5, plain, right(0.8)),
        least("false", MANY, 2.0, plain, right(0.8)),
        least("true by a little", MANY, 0.999, plain, at_most(0.025)),
        least("false by a little", MANY, 1.0, plain, at_most(0.025)),
        least("underpowered", 3, 1.0, plain, never_firm()),
        least("fitted", MANY, 0.5, Made::Fitted, never_reproduced()),
        least("searched", MANY, 0.5, Made::Searched, never_reproduced()),
        least("censored", MANY, 0.5, plain, never_firm()),
    ]
}
