use crate::analysis::claims::judge;
use crate::analysis::evidence::{Evidence, default_point};
use crate::analysis::verdict::{Finding, Verdict};
use crate::study::lock::Lock;
use crate::study::paper::Paper;
use crate::study::session::{Options, run};
use crate::study::{Inputs, ReadingChoice, runner::Unwatched};
use std::path::Path;
use std::sync::atomic::AtomicBool;

mod counted;

const HEAD: &str = "[source]\ntitle = 'a test'\n[prints]\nfigures = 0\ntables = 0\nequations = 0\n";

const STUDY: &str = "
paper = 'p'
question = 'q'
seed = 4
[budget]
expansions = 10_000
[quick]
replicates = 1
[explore]
sample = 2
[[problems]]
label = 'maps'
family = 'random_cells'
replicates = 60
settings = { size_cells = [30, 30], start = [22, 15], goal = [26, 28], blocked_share = 0.2, corner_rule = 'allow' }
[[contender]]
label = 'A*'
planner = 'astar'
settings = { weight = 1, ties = 'fifo' }
[[contender]]
label = 'Improved'
planner = 'bidirectional'
settings = { weight = 'falling', meeting = 'generated_any', side = 'alternate', ties = 'fifo' }
[[reading]]
id = 'nodes'
why = 'w'
default = 'opened'
option.opened = { metric = { nodes = 'opened' } }
option.closed = { metric = { nodes = 'closed' } }
[[reading]]
id = 'corners'
why = 'w'
default = 'allow'
option.allow = { problem = { corner_rule = 'allow' } }
option.forbid = { problem = { corner_rule = 'forbid_any' } }
[[reading]]
id = 'digits'
why = 'w'
default = 'unknown'
option.unknown = { digits = 'unknown' }
option.truncated = { digits = 'truncated' }
";

/// Loads the paper `p` in `folder`, runs its studies there, and hands over what was found.
fn with_run(folder: &Path, claims: &str, study: &str, then: impl FnOnce(&Paper, &Evidence<'_>)) {
    let home = folder.join("p");
    std::fs::create_dir_all(&home).unwrap();
    std::fs::write(home.join("paper.toml"), HEAD.to_owned() + claims).unwrap();
    std::fs::write(home.join("s.toml"), study).unwrap();
    let inputs = Inputs { roots: vec![home.clone()] };
    let paper = Paper::load(&home, &inputs).unwrap();
    let points = paper.studies[0].trial_points().unwrap();
    let options = Options {
        lock: &Lock::take(&folder.join("runs")).unwrap(),
        points: &points,
        inputs: &inputs,
        command: String::new(),
        claims: String::new(),
        quick: false,
        fresh: false,
        threads: Some(1),
        stop: &AtomicBool::new(false),
        progress: &Unwatched,
    };
    run(&paper.studies[0], &options).unwrap();
    let evidence = Evidence::read(&paper, default_point(&paper), options.lock.folder()).unwrap();
    then(&paper, &evidence);
}

fn under(evidence: &Evidence<'_>, reading: &str, option: &str) -> ReadingChoice {
    let choices = [(reading.to_owned(), option.to_owned())].into();
    ReadingChoice::new(&evidence.paper.readings(), &choices).unwrap()
}

fn finding(evidence: &Evidence<'_>, claim: &str, check: &str) -> Finding {
    let verdicts = judge(evidence).unwrap();
    let judged = verdicts.claim(claim).unwrap();
    judged.findings.iter().find(|finding| finding.check == check).unwrap().clone()
}

const RANKED: &str = "
[[claim]]
id = 'r'
at = 'x'
printed = '25.0'
[claim.check.row_among_draws]
metric = 'nodes'
contender = 'Improved'
against = 'A*'
sets = [{ label = 'all', study = 's', problems = ['maps'] }]
[claim.check.across_readings]
study = 's'
problems = ['maps']
metric = 'nodes'
contender = 'Improved'
against = 'A*'
";

#[test]
fn a_rank_is_what_counting_rows_gives_and_readings_change_it() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), RANKED, STUDY, |_, evidence| {
        let run = evidence.run("s").unwrap();
        let share = |column: &str| {
            let (base, other) = (run.rows("maps", "A*"), run.rows("maps", "Improved"));
            let cuts: Vec<f64> = base
                .iter()
                .zip(other)
                .filter_map(|(a, b)| {
                    Some(100.0 * (a.value(column)? - b.value(column)?) / a.value(column)?)
                        .filter(|_| a.value("path_cost_cells").is_some())
                })
                .collect();
            cuts.iter().filter(|cut| **cut < 25.1).count() as f64 / cuts.len() as f64
        };
        let found = finding(evidence, "r", "row_among_draws");
        let ours = found.ours.unwrap();
        assert!((ours.value - share("opened")).abs() < 1e-12, "{found:?}", found = found.because);
        assert!(found.verdict.is_none(), "a rank is no verdict");
        assert!((0.05..0.95).contains(&ours.value), "the printed number is no test: {}", ours.value);
        let [low, high] = ours.interval.unwrap();
        assert!(low < ours.value && ours.value < high);
        let closed = evidence.under(under(evidence, "nodes", "closed"));
        let other = finding(&closed, "r", "row_among_draws").ours.unwrap();
        assert!((other.value - share("closed")).abs() < 1e-12);
        assert_ne!(ours.value, other.value);
        let across = finding(evidence, "r", "across_readings");
        assert!(across.because[0].starts_with("6 readings were explored"), "{:?}", across.because);
    });
}

const TRENDS: &str = "
[[claim]]
id = 'own'
at = 'x'
says = 's'
check.trend = { study = 's', problems = ['maps'], metric = 'opened', contender = 'A*', over = 'optimal_cost_cells', rising = true }
[[claim]]
id = 'saved'
at = 'x'
says = 's'
check.trend = { study = 's', problems = ['maps'], metric = 'opened', contender = 'Improved', against = 'A*', over = 'optimal_cost_cells', rising = true }
";

#[test]
fn a_trend_is_the_slope_of_a_metric_or_of_what_is_saved_of_anothers() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), TRENDS, STUDY, |_, evidence| {
        let run = evidence.run("s").unwrap();
        let slope = |points: &[(f64, f64)]| {
            let mean =
                |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
            let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
            mean(&|p| (p.0 - x) * (p.1 - y)) / mean(&|p| (p.0 - x) * (p.0 - x))
        };
        let solved = |contender: &str| {
            let rows = run.rows("maps", contender);
            let values = rows.iter().map(|row| {
                Some((
                    row.value("path_cost_cells").and(row.value("optimal_cost_cells"))?,
                    row.value("opened")?,
                ))
            });
            values.collect::<Vec<_>>()
        };
        let (base, other) = (solved("A*"), solved("Improved"));
        let own: Vec<_> = base.iter().flatten().copied().collect();
        let both = base.iter().zip(&other).filter_map(|(a, b)| Some(((*a)?, (*b)?)));
        let saved: Vec<_> = both.map(|((x, a), (_, b))| (x, 100.0 * (1.0 - b / a))).collect();
        for (claim, points) in [("own", own), ("saved", saved)] {
            let ours = finding(evidence, claim, "trend").ours.unwrap();
            assert!((ours.value - slope(&points)).abs() < 1e-9, "{claim}: {} of {points:?}", ours.value);
            assert!(ours.n == points.len() && ours.n > 30, "{claim}: {}", ours.n);
        }
        assert_eq!(
            finding(evidence, "own", "trend").verdict,
            Some(Verdict::Reproduced),
            "longer ways, more nodes"
        );
    });
}

const AUDITED: &str = "
[[claim]]
id = 'count'
at = 'x'
printed = '69'
check.count_bound = { size = [30, 30], start = [22, 15], goal = [26, 28], optimum = [9, 4], metric = 'nodes', opened = 'opened', closed = 'closed' }
[[claim]]
id = 'seen'
at = 'x'
printed = '16.40'
check.sight_bound = { size = [30, 30], start = [28, 19], goal = [13, 16], optimum = [12, 4], because = 'b', of = 'length', under = { corners = ['allow'] } }
[[claim]]
id = 'seen.enough'
at = 'x'
printed = '16.53'
check.sight_bound = { size = [30, 30], start = [28, 19], goal = [13, 16], optimum = [12, 4], because = 'b', of = 'length', under = { corners = ['allow'] } }
[[claim]]
id = 'distance'
at = 'x'
printed = '15.30'
check.point_distance = { from = [28.5, 19.5], to = [13.5, 16.5] }
[[claim]]
id = 'length'
at = 'x'
printed = '13.40'
check.straight_line = { start = [22.0, 15.0], goal = [26.0, 28.0], size = [30, 30] }
[[claim]]
id = 'turn'
at = 'x'
printed = '229.17'
check.straight_line = { start = [22.0, 15.0], goal = [26.0, 28.0] }
[[claim]]
id = 'row'
at = 'x'
says = 'both'
check.joint_length_turn = { size = [30, 30], start = [22, 15], goal = [26, 28], length = 'length', turn = 'turn', metric = 'turn_exterior_deg', exterior = 'turn_exterior_deg', interior = 'turn_interior_deg', longest = 17.0 }
";

#[test]
fn proofs_hold_under_the_readings_they_are_proofs_under_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), AUDITED, &STUDY.replace("60\n", "2\n"), |_, evidence| {
        let verdict = |reading: &str, option: &str, claim: &str, check: &str| {
            finding(&evidence.under(under(evidence, reading, option)), claim, check).verdict
        };
        let impossible = Some(Verdict::Impossible);
        assert_eq!(verdict("nodes", "opened", "count", "count_bound"), None);
        assert_eq!(verdict("nodes", "closed", "count", "count_bound"), impossible);
        assert_eq!(verdict("corners", "allow", "seen", "sight_bound"), impossible);
        assert_eq!(verdict("corners", "forbid", "seen", "sight_bound"), None);
        assert_eq!(verdict("corners", "allow", "seen.enough", "sight_bound"), None);
        assert_eq!(verdict("digits", "unknown", "distance", "point_distance"), Some(Verdict::Reproduced));
        assert_eq!(verdict("digits", "truncated", "distance", "point_distance"), impossible);
        assert_eq!(verdict("nodes", "opened", "row", "joint_length_turn"), impossible);
        let moved = finding(evidence, "length", "straight_line");
        assert!(moved.because.iter().any(|line| line.contains("down to 12.3693")), "{:?}", moved.because);
        let joint = finding(evidence, "row", "joint_length_turn").because.join("\n");
        assert!(joint.contains("needs a length of 16.0375 at least"), "{joint}");
        assert!(joint.contains("interior angles: no path of up to 17 cells"), "{joint}");
    });
}

const PRINTED: &str = "
[[claim]]
id = 'o'
at = 'x'
says = 's'
check.oracle = { study = 's', problems = ['m'], contenders = ['fast'], metric = 'path_cost_cells', truth = 'printed_optimal_cells', within = 1e-4 }
";

const QUERY: &str = "
paper = 'p'
question = 'q'
seed = 1
[budget]
expansions = 1000
[quick]
replicates = 1
[[problems]]
label = 'm'
family = 'movingai'
settings = { map = 'm.map', scenarios = 'm.scen' }
[[contender]]
label = 'fast'
planner = 'astar_octile'
";

#[test]
fn an_oracle_refuses_what_is_too_short_as_what_is_too_long() {
    // From (0, 0) to (2, 0) around a wall two cells high, no corner cut: six straight moves.
    for (printed, verdict) in [
        ("6.00000000", Verdict::Reproduced),
        ("5.99980000", Verdict::NotReproduced),
        ("6.00020000", Verdict::NotReproduced),
        ("6.00009", Verdict::Reproduced),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let home = folder.path().join("p");
        std::fs::create_dir_all(&home).unwrap();
        std::fs::write(home.join("m.map"), "type octile\nheight 3\nwidth 3\nmap\n.@.\n.@.\n...\n").unwrap();
        let line = format!("version 1.0\n0\tm.map\t3\t3\t0\t0\t2\t0\t{printed}\n");
        std::fs::write(home.join("m.scen"), line).unwrap();
        with_run(folder.path(), PRINTED, QUERY, |_, evidence| {
            let found = finding(evidence, "o", "oracle");
            assert_eq!(found.verdict, Some(verdict), "{printed}: {:?}", found.because);
            assert_eq!(found.trial.is_some(), verdict == Verdict::NotReproduced);
        });
    }
}
