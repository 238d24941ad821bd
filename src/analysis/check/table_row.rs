//! Whether a printed row of shares, as a whole, could be one more of our draws.

use super::{Check, Entry};
use crate::analysis::draws::solved_percents;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use audit::printed::Printed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::Rank;
use stats::rows::{distance_to_mean, monotone_probability};
use stats::summary::{mean, standard_deviation};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "table_row",
    about: "is a printed row of solved shares as near to our mean curve as our own draws are?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "success"
problems = "cell"
refused_below = 0.05
rows = [
    { contender = "Original A*", claims = ["t2.original.100", "t2.original.200", "t2.original.300", "t2.original.400", "t2.original.500", "t2.original.600", "t2.original.700", "t2.original.800", "t2.original.900", "t2.original.1000", "t2.original.1100", "t2.original.1200", "t2.original.1300", "t2.original.1400", "t2.original.1500"] },
]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let problems = std::slice::from_ref(&settings.problems);
        let contenders: Vec<&str> = settings.rows.iter().map(|row| row.contender.as_str()).collect();
        let study = context.study(&settings.study, problems, &contenders)?;
        let mut printed = Vec::new();
        for row in &settings.rows {
            let (cells, points) = (row.claims.len(), study.sweep_points().len());
            if cells != points {
                let message =
                    format!("a row has {cells} claims; study `{}` sweeps {points} points", study.name);
                return Err(context.settings.error(message));
            }
            for id in &row.claims {
                printed.push(context.printed_of(id)?.0);
            }
        }
        let is_fitted = study.fitted_to.contains(&context.claim.id);
        Ok(Box::new(TableRow { settings, study, printed, is_fitted }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: String,
    /// One row, or several that come from one draw and are ranked as one.
    rows: Vec<RowOf>,
    /// The row is refused if fewer than this share of our draws are as far from the mean curve, or if its mean is as far
    /// out on one side.
    refused_below: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RowOf {
    /// The contender, by its label.
    contender: String,
    /// The claim of each cell, in the order of the study's sweep.
    claims: Vec<String>,
}

struct TableRow<'a> {
    settings: Settings,
    study: &'a Study,
    printed: Vec<Printed>,
    is_fitted: bool,
}

/// A row's distance to our mean curve, and how many of our own draws, each against the curve of the others, are
/// at least as far.
pub(super) struct Place {
    pub(super) distance: f64,
    pub(super) as_far: usize,
    pub(super) draws: usize,
}

/// Where `row` stands among the draws whose values by cell are `cells`; none below three draws.
pub(super) fn place(row: &[f64], cells: &[Vec<f64>]) -> Option<Place> {
    let draws = cells.iter().map(Vec::len).min().filter(|draws| *draws > 2)?;
    let curve = |left_out: Option<usize>| -> Option<(Vec<f64>, Vec<f64>)> {
        let kept = |cell: &Vec<f64>| -> Vec<f64> {
            cell.iter().enumerate().filter(|(i, _)| Some(*i) != left_out).map(|(_, y)| *y).collect()
        };
        let kept: Vec<Vec<f64>> = cells.iter().map(kept).collect();
        let means = kept.iter().map(|cell| mean(cell)).collect::<Option<_>>()?;
        // A cell at which all draws agree is given the spread of one query in ten of one draw in all.
        let least = 10.0 / (draws as f64).sqrt();
        let spreads =
            kept.iter().map(|cell| Some(standard_deviation(cell)?.max(least))).collect::<Option<_>>()?;
        Some((means, spreads))
    };
    let (means, spreads) = curve(None)?;
    let distance = distance_to_mean(row, &means, &spreads);
    let mut as_far = 0;
    for draw in 0..draws {
        let (means, spreads) = curve(Some(draw))?;
        let own: Vec<f64> = cells.iter().map(|cell| cell[draw]).collect();
        as_far += usize::from(distance_to_mean(&own, &means, &spreads) >= distance);
    }
    Some(Place { distance, as_far, draws })
}

/// On which side of our curve a row lies.
struct Level {
    /// Cells in which our mean is below the printed value, and in all.
    short: [usize; 2],
    /// The mean over cells of ours less printed.
    difference: f64,
    /// The row's mean among the means of our draws.
    rank: Rank,
    /// Draws that are at or above the row in every cell.
    dominating: usize,
}

impl Level {
    fn of(row: &[f64], cells: &[Vec<f64>]) -> Option<Self> {
        let means: Vec<f64> = cells.iter().map(|cell| mean(cell)).collect::<Option<_>>()?;
        let draws = cells.iter().map(Vec::len).min()?;
        let of_draw = |draw: usize| cells.iter().map(move |cell| cell[draw]);
        let levels: Vec<f64> =
            (0..draws).filter_map(|draw| mean(&of_draw(draw).collect::<Vec<_>>())).collect();
        let dominates = |draw: &usize| of_draw(*draw).zip(row).all(|(own, printed)| own >= *printed);
        Some(Self {
            short: [means.iter().zip(row).filter(|(own, printed)| own < printed).count(), row.len()],
            difference: mean(&means)? - mean(row)?,
            rank: Rank::of(mean(row)?, &levels),
            dominating: (0..draws).filter(dominates).count(),
        })
    }

    fn said(&self, refused_below: f64) -> String {
        let Self { short: [short, cells], difference, rank, dominating } = self;
        format!(
            "on which side: our mean is below the printed value in {short} of {cells} cells, by {difference:+.1} points on average; \
             the row's mean is at or above that of {} of {} draws (two-sided rank {:.3}, refused below {refused_below}); \
             {dominating} draws are at or above the printed row in every cell",
            rank.below + rank.equal,
            rank.draws(),
            rank.p_two_sided()
        )
    }
}

impl Check for TableRow<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, rows, refused_below } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let points = self.study.sweep_points();
        let wanted = rows.iter().flat_map(|row| points.iter().map(move |point| (&row.contender, point)));
        let cells: Vec<Vec<f64>> = evidence.run(study).map_or_else(Vec::new, |run| {
            wanted.map(|(contender, point)| solved_percents(run, problems, contender, &point.key)).collect()
        });
        let row: Vec<f64> = self.printed.iter().map(|printed| printed.value()).collect();
        let (Some(place), Some(level)) = (place(&row, &cells), Level::of(&row, &cells)) else {
            return finding.undecided("fewer than three draws were run");
        };
        // Among our draws and the row itself.
        let rank = (place.as_far + 1) as f64 / (place.draws + 1) as f64;
        finding.verdict = Some(match rank.min(level.rank.p_two_sided()) >= *refused_below {
            true if self.is_fitted => Verdict::Fitted,
            true => Verdict::Reproduced,
            false => Verdict::NotReproduced,
        });
        let contender = rows.iter().map(|row| row.contender.as_str()).collect::<Vec<_>>().join(" and ");
        finding.ours = Some(Estimate {
            value: place.as_far as f64 / place.draws as f64,
            interval: None,
            what: "share of our draws at least as far from the mean curve".to_owned(),
            n: place.draws,
        });
        finding.because.push(format!(
            "{contender}: the printed row is {:.2} standard deviations a cell from our mean curve; {} of {} draws of ours, each \
             against the others' curve, are as far (rank {rank:.3}; refused below {refused_below})",
            place.distance, place.as_far, place.draws
        ));
        finding.because.push(level.said(*refused_below));
        if let Some(chance) = monotone_probability(&cells).filter(|_| rows.len() == 1) {
            finding.because.push(format!(
                "if each cell came from a roadmap of its own, a row that never falls would have probability {chance:.1e}: the \
                 printed row looks like one roadmap that grows"
            ));
        }
        finding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_like_the_draws_is_near_and_an_opposite_one_is_far() {
        // Forty draws of three cells that rise from about 10 to about 90 with a spread of ten.
        let cells: Vec<Vec<f64>> = [10.0, 50.0, 90.0]
            .iter()
            .map(|middle| (0..40).map(|i| middle + f64::from(i * 7 % 21) - 10.0).collect())
            .collect();
        let near = place(&[12.0, 47.0, 93.0], &cells).unwrap();
        assert!(near.as_far > 25, "{} of {}", near.as_far, near.draws);
        let far = place(&[90.0, 50.0, 10.0], &cells).unwrap();
        assert_eq!((far.as_far, far.draws), (0, 40));
        assert!(place(&[0.0], &[vec![0.0, 1.0]]).is_none());
    }

    #[test]
    fn cells_without_spread_do_not_make_every_other_value_infinitely_far() {
        let cells = vec![vec![100.0; 50], (0..50).map(|i| f64::from(i % 11) * 10.0).collect()];
        let place = place(&[90.0, 50.0], &cells).unwrap();
        assert!(place.distance.is_finite() && place.distance > 1.0, "{}", place.distance);
    }
}
