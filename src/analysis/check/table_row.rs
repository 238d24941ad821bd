//! Whether a printed row of shares, as a whole, could be one more of our draws.

use super::{Check, Entry};
use crate::analysis::audit::printed::Printed;
use crate::analysis::draws::solved_percents;
use crate::analysis::evidence::Evidence;
use crate::analysis::stats::proportion::Rank;
use crate::analysis::stats::rows::{distance_to_mean, monotone_probability};
use crate::analysis::stats::summary::{mean, standard_deviation};
use crate::analysis::verdict::{Finding, Verdict};
use crate::study::Study;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "table_row",
    about: "is a printed row of solved shares as near to our mean curve as our own draws are?",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let problems = std::slice::from_ref(&settings.problems);
        let study = context.study(&settings.study, problems, &[&settings.contender])?;
        let printed = settings.claims.iter().map(|id| context.printed_of(id).map(|(printed, _)| printed));
        let printed: Vec<Printed> = printed.collect::<Result<_, _>>()?;
        if printed.len() != study.sweep_points().len() {
            let (cells, points) = (printed.len(), study.sweep_points().len());
            let message =
                format!("the row has {cells} claims; study `{}` sweeps {points} points", study.name);
            return Err(context.settings.error(message));
        }
        let is_fitted = study.fitted_to.contains(&context.claim.id);
        Ok(Box::new(TableRow { settings, study, printed, is_fitted }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    study: String,
    problems: String,
    contender: String,
    /// The claim of each cell, in the order of the study's sweep.
    claims: Vec<String>,
    /// The row is refused if fewer than this share of our draws are as far from the mean curve.
    refused_below: f64,
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

impl Check for TableRow<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, refused_below, .. } = &self.settings;
        let mut finding = Finding { check: ENTRY.name.to_owned(), ..Finding::default() };
        let points = self.study.sweep_points();
        let cells: Vec<Vec<f64>> = evidence.run(study).map_or_else(Vec::new, |run| {
            points.iter().map(|point| solved_percents(run, problems, contender, &point.name)).collect()
        });
        let row: Vec<f64> = self.printed.iter().map(|printed| printed.value()).collect();
        let Some(place) = place(&row, &cells) else {
            finding.verdict = Some(Verdict::Undecided);
            finding.because.push("fewer than three draws were run".to_owned());
            return finding;
        };
        // Among our draws and the row itself.
        let rank = (place.as_far + 1) as f64 / (place.draws + 1) as f64;
        finding.verdict = Some(match rank >= *refused_below {
            true if self.is_fitted => Verdict::Fitted,
            true => Verdict::Reproduced,
            false => Verdict::NotReproduced,
        });
        let share = Rank { below: place.draws - place.as_far, equal: place.as_far, above: 0 };
        let what = "share of our draws at least as far from the mean curve";
        finding.ours = Some(crate::analysis::verdict::Estimate {
            value: place.as_far as f64 / place.draws as f64,
            interval: None,
            what: what.to_owned(),
            n: share.draws(),
        });
        finding.because.push(format!(
            "{contender}: the printed row is {:.2} standard deviations a cell from our mean curve; {} of {} draws of ours, each \
             against the others' curve, are as far (rank {rank:.3}; refused below {refused_below})",
            place.distance, place.as_far, place.draws
        ));
        if let Some(chance) = monotone_probability(&cells) {
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
