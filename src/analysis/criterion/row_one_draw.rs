//! Whether a printed row, as a whole, could be that of one more of our draws.

use super::{Criterion, Entry};
use crate::analysis::class::Outcome;
use crate::analysis::context::Context;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use crate::analysis::selection::{self, Draw, Selection, solved};
use crate::analysis::selection_spec::{Labels, SelectionSpec};
use crate::analysis::statistic::OfDraw;
use crate::analysis::verdict::Estimate;
use crate::study::Study;
use crate::study::contender::SweepPoint;
use audit::printed::Printed;
use base::settings::{Accepted, Faults, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::Rank;
use stats::rows::{distance_to_mean, monotone_probability};
use stats::summary::{mean, standard_deviation};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "row_one_draw",
    about: "is a printed row as near to our mean row as our own draws are, in shape and in level?",
    settings: Accepted::of::<Settings>(),
    example: r#"
of = { study = "length", problems = "cell", metric = "path_length_mm", whole_draws = true }
rows = [{ contender = "Improved A*", against = "Original A*", statistics = ["least", "greatest"], claims = ["length.least", "length.greatest"] }]
refused_below = 0.05
"#,
    build: |context| Ok(Box::new(RowOneDraw::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The trials that are looked at: study, problems and metric.
    of: SelectionSpec,
    /// One row, or several that come from one draw and are ranked as one.
    rows: Vec<RowSpec>,
    /// The row is refused if fewer than this share of our draws are as far from the mean row, or if its mean is as far out
    /// on one side: the size of either test.
    #[schemars(range(min = 0.0, max = 1.0))]
    refused_below: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RowSpec {
    /// The contender, by its label.
    contender: String,
    /// The contender that its savings are against.
    against: Option<String>,
    /// The statistic of each cell; without, the share of solved queries at each point of the study's sweep.
    #[serde(default)]
    statistics: Vec<OfDraw>,
    /// The claim that prints each cell.
    claims: Vec<String>,
}

/// One printed row.
struct Row<'a> {
    of: Selection<'a>,
    /// What each cell is.
    cells: Cells,
}

enum Cells {
    Statistics(Vec<OfDraw>),
    Sweep(Vec<SweepPoint>),
}

struct RowOneDraw<'a> {
    rows: Vec<Row<'a>>,
    printed: Vec<f64>,
    refused_below: f64,
}

impl<'a> RowOneDraw<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let (mut printed, mut faults) = (Vec::new(), Faults::default());
        let mut read = |(index, row): (usize, &RowSpec)| {
            let contender = Labels::One(row.contender.clone());
            let spec = SelectionSpec { contender, against: row.against.clone(), ..settings.of.clone() };
            let of = Selection::new(context, &spec)?;
            let (cells, count) = if row.statistics.is_empty() {
                let points = of.study.sweep_points();
                let count = points.len();
                (Cells::Sweep(points), count)
            } else {
                of.metric(context)?;
                (Cells::Statistics(row.statistics.clone()), row.statistics.len())
            };
            if row.claims.len() != count {
                let message = format!("the row has {} claims for {count} cells", row.claims.len());
                return Err(context.settings.error_at(&format!("rows.{index}.claims"), message));
            }
            for id in &row.claims {
                printed.push(context.printed_of(id)?.0);
            }
            Ok(Row { of, cells })
        };
        let rows: Vec<Row<'a>> =
            settings.rows.iter().enumerate().filter_map(|row| faults.keep(read(row))).collect();
        faults.done()?;
        if rows.is_empty() {
            return Err(context.settings.error_at("rows", "at least one row is needed"));
        }
        let printed = printed.iter().map(|cell: &Printed| cell.value()).collect();
        Ok(Self { rows, printed, refused_below: settings.refused_below })
    }
}

impl Row<'_> {
    /// The numbers of each cell, one a draw; draws that lack one are left out of all.
    fn values(&self, draws: &[Draw<'_>], unended_solved: bool) -> Vec<Vec<f64>> {
        let of_draw = |draw: &Draw<'_>| -> Option<Vec<f64>> {
            match &self.cells {
                Cells::Statistics(statistics) => statistics.iter().map(|of| of.of(draw)).collect(),
                Cells::Sweep(points) => {
                    points.iter().map(|point| share(draw, point, unended_solved)).collect()
                }
            }
        };
        draws.iter().filter_map(of_draw).collect()
    }
}

/// The share of a draw's queries that are solved at one point of the sweep, in per cent.
fn share(draw: &Draw<'_>, point: &SweepPoint, unended_solved: bool) -> Option<f64> {
    let at = draw.cases.iter().filter(|case| case.row.key.sweep == point.key);
    let (solved, all) = at.fold((0, 0), |(solved, all), case| {
        let is_solved = case.row.status == crate::study::record::Status::Solved;
        (solved + u32::from(is_solved || unended_solved && case.is_unended()), all + 1)
    });
    (all > 0).then(|| 100.0 * f64::from(solved) / f64::from(all))
}

/// A row's distance to our mean row, and how many of our own draws, each against the mean of the others, are at least as
/// far.
struct Place {
    distance: f64,
    as_far: usize,
    draws: usize,
}

/// Where `row` stands among the draws whose values by cell are `cells`; none below three draws.
fn place(row: &[f64], cells: &[Vec<f64>]) -> Option<Place> {
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

/// On which side of our mean row a row lies.
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

impl RowOneDraw<'_> {
    /// The numbers of all cells of all rows, one list a cell.
    fn cells(&self, drawn: &[Vec<Draw<'_>>], unended_solved: bool) -> Vec<Vec<f64>> {
        let of_row = |(row, draws): (&Row<'_>, &Vec<Draw<'_>>)| {
            let values = row.values(draws, unended_solved);
            let width = values.first().map_or(0, Vec::len);
            (0..width).map(|cell| values.iter().map(|draw| draw[cell]).collect()).collect::<Vec<Vec<f64>>>()
        };
        self.rows.iter().zip(drawn).flat_map(of_row).collect()
    }

    /// Where the printed row stands, in shape and in level, its rank among our draws and itself, and what that says.
    fn placed(&self, cells: &[Vec<f64>]) -> Option<(Place, Level, f64, Outcome)> {
        let place = place(&self.printed, cells).filter(|_| cells.len() == self.printed.len())?;
        let level = Level::of(&self.printed, cells)?;
        let rank = (place.as_far + 1) as f64 / (place.draws + 1) as f64;
        let is_ordinary = rank.min(level.rank.p_two_sided()) >= self.refused_below;
        Some((place, level, rank, if is_ordinary { Outcome::Holds } else { Outcome::Fails }))
    }

    /// Fewest draws of which either test can refuse any row: the least two-sided rank is 2 / (n + 1).
    fn fewest(&self) -> usize {
        (2.0 / self.refused_below).floor() as usize
    }

    fn because(&self, place: &Place, level: &Level, rank: f64, cells: &[Vec<f64>]) -> Vec<String> {
        let who = self.rows.iter().map(|row| row.of.said()).collect::<Vec<_>>().join(" and ");
        let below = self.refused_below;
        let mut because = vec![
            format!(
                "{who}: the printed row is {:.2} standard deviations a cell from our mean row; {} of {} draws of ours, each against \
                 the others' mean, are as far (rank {rank:.3}; refused below {below}, so that an ordinary row is refused with \
                 probability {:.2} at most by both tests together)",
                place.distance,
                place.as_far,
                place.draws,
                2.0 * below
            ),
            level.said(below),
        ];
        let is_sweep = self.rows.iter().all(|row| matches!(row.cells, Cells::Sweep(_)));
        because.extend(monotone_probability(cells).filter(|_| self.rows.len() == 1 && is_sweep).map(|chance| {
            format!(
                "if each cell came from a draw of its own, a row that never falls would have probability {chance:.1e}: the printed row \
                 looks like one draw that grows"
            )
        }));
        because
    }
}

impl Criterion for RowOneDraw<'_> {
    fn find(&self, evidence: &Evidence<'_>) -> Found {
        let drawn: Vec<Vec<Draw<'_>>> = self.rows.iter().map(|row| row.of.draws(evidence)).collect();
        let cells = self.cells(&drawn, false);
        let Some((place, level, rank, outcome)) = self.placed(&cells) else {
            return Found::too_few(cells.iter().map(Vec::len).min().unwrap_or(0), self.fewest());
        };
        let unended: usize = drawn.iter().map(|draws| selection::unended(draws)).sum();
        let filled = (unended > 0).then(|| self.placed(&self.cells(&drawn, true))).flatten();
        // A level that passes the row's on the way could be its.
        let is_turned = filled.is_some_and(|(_, other, _, filled)| {
            filled != outcome || (level.difference < 0.0) != (other.difference < 0.0)
        });
        let (share, n) = (place.as_far as f64 / place.draws as f64, place.draws);
        let ours = Estimate::bare(share, "share of our draws at least as far from the mean row", n);
        let first = drawn.first().and_then(|draws| draws.first()?.cases.first());
        let trial = first.and_then(|case| Some(self.rows[0].of.run(evidence)?.trial(case.row)));
        Found {
            outcome: Some(outcome),
            censored: if is_turned { unended } else { 0 },
            ours: Some(ours.of_cases(solved(&drawn[0]))),
            trial,
            because: self.because(&place, &level, rank, &cells),
            units: "draws",
            needs: Some(self.fewest()).filter(|fewest| n < *fewest),
            ..Found::default()
        }
    }

    fn studies(&self) -> Vec<&Study> {
        self.rows.iter().map(|row| row.of.study).collect()
    }

    fn is_clock(&self) -> bool {
        self.rows.iter().any(|row| row.of.is_clock())
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
