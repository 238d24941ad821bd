//! How often whole verdicts are wrong: synthetic papers with choices, of known truth under each interpretation.
//!
//! Every interpretation gives a result of its own on each of two seeds: it speaks for the truth with the power of the sample, against
//! it as often as one end of an interval errs, and is open otherwise. A minority counts only if the second seed confirms it, and the
//! table of verdicts says what that amounts to.

use base::seed::{self, Stream};
use rand::RngExt as _;
use replan::analysis::across::combine::confirmed;
use replan::analysis::across::count::Group;
use replan::analysis::outcome::{Outcome, Polarity};
use replan::analysis::verdict_rule::{Column, Results};

/// Papers drawn for a truth.
const PAPERS: usize = 4000;

/// Interpretations of each, all with results of their own.
const INTERPRETATIONS: usize = 40;

/// How often one end of an interval lies on the wrong side of the truth.
const WRONG: f64 = 0.025;

/// Papers of one kind.
struct Kind {
    truth: &'static str,
    /// Of so many interpretations the claim is true, from the default on.
    true_under: usize,
    /// How often a sample shows the truth.
    power: f64,
    /// The first seed shows the contrary under the defaults.
    is_unlucky: bool,
    /// So many interpretations, from the default on, fit what the study is calibrated to. Others count unless the calibration, which errs
    /// as often as any outcome, refuses them.
    compatible: usize,
    /// Where verdicts may stand at most, as shares.
    most: &'static [(Column, f64)],
}

/// Papers whose claim is true under every interpretation, none of which is calibrated away.
const PLAIN: Kind = Kind {
    truth: "true under all",
    true_under: INTERPRETATIONS,
    power: 0.95,
    is_unlucky: false,
    compatible: INTERPRETATIONS,
    most: &[(Column::Against, 0.0), (Column::Depends, 0.05)],
};

const HALF: usize = INTERPRETATIONS / 2;

const KINDS: [Kind; 8] = [
    PLAIN,
    Kind {
        truth: "false under all",
        true_under: 0,
        most: &[(Column::For, 0.0), (Column::Depends, 0.05)],
        ..PLAIN
    },
    Kind {
        truth: "true under half",
        true_under: HALF,
        most: &[(Column::For, 0.0), (Column::Against, 0.0)],
        ..PLAIN
    },
    Kind {
        truth: "true under all but four",
        true_under: INTERPRETATIONS - 4,
        most: &[(Column::Against, 0.0)],
        ..PLAIN
    },
    Kind {
        truth: "true under all, samples of little power",
        power: 0.3,
        most: &[(Column::Against, 0.01)],
        ..PLAIN
    },
    Kind {
        truth: "false under all, samples of little power",
        true_under: 0,
        power: 0.3,
        most: &[(Column::For, 0.01)],
        ..PLAIN
    },
    Kind {
        truth: "true under all, the first seed of the defaults unlucky",
        is_unlucky: true,
        most: &[(Column::Against, 0.0), (Column::For, 0.0)],
        ..PLAIN
    },
    Kind {
        truth: "true under the half that fits a calibration",
        true_under: HALF,
        compatible: HALF,
        most: &[(Column::Against, 0.0), (Column::Depends, 0.3)],
        ..PLAIN
    },
];

impl Kind {
    /// What an interpretation gives on one seed.
    fn outcome(&self, place: usize, stream: &mut Stream) -> Outcome {
        let at: f64 = stream.random();
        match (at < self.power, at > 1.0 - WRONG, place < self.true_under) {
            (true, _, true) | (_, true, false) => Outcome::Holds,
            (true, _, false) | (_, true, true) => Outcome::Fails,
            (false, false, _) => Outcome::Open,
        }
    }

    /// How many papers stand in each column.
    fn tally(&self) -> [usize; 6] {
        let mut tally = [0; 6];
        for paper in 0..PAPERS {
            let mut stream = seed::stream(seed::derive(47, &[self.truth, &paper.to_string()]));
            let mut seed_of = || {
                (0..INTERPRETATIONS).map(|place| self.outcome(place, &mut stream)).collect::<Vec<Outcome>>()
            };
            let [mut first, second] = [seed_of(), seed_of()];
            if self.is_unlucky {
                first[0] = Outcome::Fails;
            }
            let group = |(interpretation, outcome): (usize, &Outcome)| Group {
                interpretation,
                interpretations: vec![interpretation],
                outcome: *outcome,
            };
            let mut groups: Vec<Group> = first.iter().enumerate().map(group).collect();
            groups.retain(|group| {
                let refused = if group.interpretation < self.compatible { WRONG } else { self.power };
                self.compatible == INTERPRETATIONS || stream.random::<f64>() > refused
            });
            let is_counted = groups.first().is_some_and(|group| group.interpretation == 0);
            let outcomes = confirmed(&groups, |group| Some(second[group.interpretation]));
            let results = Results {
                outcomes: &outcomes,
                default: if is_counted { first[0].polarity() } else { Polarity::Open },
                second: second[0].polarity(),
                chosen: None,
                states_size: false,
                is_unvaried: false,
            };
            let column = results.verdict().0.column();
            tally[Column::ALL.iter().position(|own| *own == column).unwrap()] += 1;
        }
        tally
    }
}

#[test]
fn no_verdict_errs_more_often_than_is_stated() {
    for kind in &KINDS {
        let tally = kind.tally();
        for (column, most) in kind.most {
            let count = tally[Column::ALL.iter().position(|own| own == column).unwrap()];
            assert!(count as f64 <= most * PAPERS as f64, "{}: {column:?} {count} of {PAPERS}", kind.truth);
        }
    }
}

#[test]
fn what_is_plainly_true_false_or_both_is_found_in_most_papers() {
    for (truth, column) in [(0, Column::For), (1, Column::Against), (2, Column::Depends)] {
        let count = KINDS[truth].tally()[Column::ALL.iter().position(|own| *own == column).unwrap()];
        assert!(count * 10 >= PAPERS * 9, "{}: {column:?} {count} of {PAPERS}", KINDS[truth].truth);
    }
}

/// The rates as a table.
pub fn table() -> String {
    let shown = [Column::For, Column::Depends, Column::Inconclusive, Column::Against];
    let mut text = format!(
        "| truth, of {INTERPRETATIONS} interpretations | {} |\n|---|---|---|---|---|\n",
        shown.map(Column::name).join(" | ")
    );
    for kind in &KINDS {
        let tally = kind.tally();
        let cell = |column: Column| {
            let count = tally[Column::ALL.iter().position(|own| *own == column).unwrap()];
            format!("{:.1}", 100.0 * count as f64 / PAPERS as f64)
        };
        text += &format!("| {} | {} |\n", kind.truth, shown.map(cell).join(" | "));
    }
    text
}
