//! The numbers of a panel, series by series.

use super::{Along, MarkKind, Statistic, StatisticsPanel, claim};
use crate::analysis::context::Context;
use crate::analysis::criterion;
use crate::analysis::evidence::Run;
use crate::analysis::metric::Metric;
use crate::analysis::selection::Selection;
use crate::analysis::shown::{
    CostHistory, Curves, Distribution, Spread, best_over_time, geometric_means, mean_difference, mean_solved,
    median_point, numbers_along, of_all, savings_by_query, spreads_by_query,
};
use crate::analysis::statistic::{Estimate, Interval, OverallStatistic};
use crate::analysis::tabulated::mean_percent;
use crate::render::RenderError;
use crate::render::figure::{Scene, ask};
use engine::planner::Value;
use study::key::{SweepKey, SweepValue};
use study::record::{PreprocessingRow, Row};

/// What is drawn of one contender, group, study or set of instances.
#[derive(Default)]
pub(super) struct Series {
    pub(super) label: String,
    /// Its place, which gives it colour, marker and dash.
    pub(super) looks: usize,
    /// Its numbers; coordinates have what they are along first.
    pub(super) points: Vec<Point>,
    /// Single values.
    pub(super) dots: Vec<[f64; 2]>,
    /// Single instances' own curves.
    pub(super) curves: Vec<Vec<[f64; 2]>>,
    /// The printed row.
    pub(super) printed: Vec<[f64; 2]>,
    /// Where one more instance would lie with 95 % probability: what it is along, and the ends.
    pub(super) one_more: Vec<[f64; 3]>,
}

/// One number.
pub(super) struct Point {
    /// The number of the name that it is along.
    pub(super) place: usize,
    pub(super) at: [f64; 2],
    /// The intervals that are drawn.
    pub(super) ends: [Interval; 2],
    /// That of the number.
    pub(super) interval: Interval,
    pub(super) spread: Spread,
    /// How many instances it rests on.
    pub(super) n: usize,
}

impl Point {
    fn new(place: usize, at: [f64; 2], interval: Interval, n: usize) -> Self {
        let ends = [Interval::new(at[0], at[0]), interval];
        Self { place, at, ends, interval, spread: Spread::default(), n }
    }

    /// A number without an interval.
    pub(super) fn bare(at: [f64; 2]) -> Self {
        Self::new(0, at, Interval::new(at[1], at[1]), 1)
    }

    fn estimated(place: usize, along: f64, found: &Estimate) -> Self {
        Self::new(place, [along, found.value], found.interval, found.units)
    }

    /// That of what is less with one contender than with another: where two differ on no instance the value alone is drawn.
    fn of_reduction(place: usize, along: f64, found: &Estimate) -> Self {
        let point = Self::estimated(place, along, found);
        let bare = Self::bare(point.at);
        if found.is_agreed && found.value == 0.0 {
            Self { place, interval: point.interval, n: point.n, ..bare }
        } else {
            point
        }
    }
}

/// Columns of roadmaps in the order of their bars, and what they are called.
const REASONS: [(&str, &str); 9] = [
    ("edges", "joined"),
    ("rejected_branch", "other branch"),
    ("rejected_turn", "turns too far"),
    ("rejected_unreachable", "out of reach"),
    ("rejected_limits", "joint limits"),
    ("rejected_jump", "joint jumps"),
    ("rejected_speed", "joint too fast"),
    ("rejected_end", "ends in other angles"),
    ("rejected_contact", "contact"),
];
/// How many moments a curve over time has.
const MOMENTS: u32 = 50;
/// Nanoseconds in a second.
const NS_PER_S: f64 = 1e9;

fn count(row: &PreprocessingRow, column: &str) -> Option<f64> {
    row.values.get(column).map(Value::as_f64)
}

impl StatisticsPanel {
    /// Its series, in their order.
    ///
    /// # Errors
    /// What is not stored.
    pub(super) fn series(&self, scene: &Scene<'_>) -> Result<Vec<Series>, RenderError> {
        let by_contender = |points: &dyn Fn(&String) -> Series| -> Vec<Series> {
            self.contenders.iter().map(points).collect()
        };
        let found = match (self.statistic, &self.along) {
            (Statistic::Spreads | Statistic::Savings, _) => self.by_query(scene),
            (Statistic::Pairs, _) => self.pairs(scene),
            (Statistic::Distribution, _) => self.distributions(scene)?,
            (Statistic::OverTime, _) => by_contender(&|label| self.over_time(scene, label)),
            (_, Along::Metric(other)) => by_contender(&|label| self.crossed(scene, label, other)),
            (_, Along::Problems | Along::Contenders) => self.by_name(scene),
            (Statistic::Solved | Statistic::Distance, _) => self.along_sweep(scene),
            _ => by_contender(&|label| self.singles(scene, label)),
        };
        Ok(found)
    }

    /// The names that its numbers are along.
    pub(super) fn names(&self, scene: &Scene<'_>, series: &[Series]) -> Vec<String> {
        match self.along {
            Along::Contenders => self.contenders.clone(),
            Along::Reasons => self.reasons(scene).iter().map(|(_, label)| (*label).to_owned()).collect(),
            Along::Queries => {
                let named = self.query_names(scene).into_iter().enumerate();
                let count =
                    |place| series.iter().flat_map(|one| &one.points).find(|point| point.place == place);
                named
                    .map(|(place, name)| match count(place) {
                        Some(point) => format!("{name} (n = {})", point.n),
                        None => name,
                    })
                    .collect()
            }
            // Each group with how many of its queries could be posed if not all.
            _ => {
                let named = |problems: &String| match scene.run.posed_queries(problems) {
                    [posed, all] if posed < all => format!("{problems} ({posed} of {all} groups posed)"),
                    _ => problems.clone(),
                };
                self.problems.iter().map(named).collect()
            }
        }
    }

    /// Where the series `index` of so many stands within a name.
    fn within(place: usize, index: usize, count: usize) -> f64 {
        place as f64 - 0.4 + 0.8 / count as f64 * (index as f64 + 0.5)
    }

    /// A series of a contender.
    fn of_contender(&self, scene: &Scene<'_>, label: &str, points: Vec<Point>) -> Series {
        let place = self.order.iter().position(|own| own == label).unwrap_or_default();
        Series {
            label: label.to_owned(),
            looks: ask::series(scene, label, place),
            points,
            ..Series::default()
        }
    }

    /// The trials on `groups` by `contender`, at the points of the sweeps that are shown.
    fn trials<'s>(&self, run: &Run<'s>, groups: &[String], contender: &str) -> Selection<'s> {
        let sweep = self.spec.sweep.as_ref();
        let met = sweep.and_then(|text| run.study.sweeps_called(groups, std::slice::from_ref(text)).ok());
        let queries = Some(self.spec.queries.clone()).filter(|queries| !queries.is_empty());
        let against = self.spec.against.clone().filter(|_| self.statistic != Statistic::Difference);
        let all = Selection::all(run.study, groups, &[contender.to_owned()]);
        Selection { sweep: met, metric: self.metric, query: queries, against, ..all }
    }

    /// How much less a metric is with a contender than with the one that it is held against, in per cent.
    fn reduction(&self, scene: &Scene<'_>, metric: &'static Metric, contender: &str) -> Option<Estimate> {
        let of = Selection { metric: Some(metric), ..self.trials(scene.run, &self.problems, contender) };
        of_all(OverallStatistic::ReductionPercent, &of, scene.evidence)
    }

    fn by_name(&self, scene: &Scene<'_>) -> Vec<Series> {
        let is_by_group = self.along == Along::Problems;
        let series = if is_by_group { self.contenders.clone() } else { vec![String::new()] };
        let of = |(index, label): (usize, &String)| {
            let names = if is_by_group { &self.problems } else { &self.contenders };
            let points = names.iter().enumerate().filter_map(|(place, name)| {
                let own = std::slice::from_ref(name);
                let (groups, contender) = if is_by_group { (own, label) } else { (&self.problems[..], name) };
                let found = self.estimate(scene, groups, contender)?;
                let within = Self::within(place, index, series.len());
                Some(if self.statistic == Statistic::Reductions {
                    Point::of_reduction(place, within, &found)
                } else if self.spec.certain.contains(contender) {
                    Point { place, ..Point::bare([within, found.value]) }
                } else {
                    Point::estimated(place, within, &found)
                })
            });
            self.of_contender(scene, label, points.collect())
        };
        series.iter().enumerate().map(of).collect()
    }

    /// What stands beside one name.
    fn estimate(&self, scene: &Scene<'_>, groups: &[String], contender: &str) -> Option<Estimate> {
        if self.statistic == Statistic::Reductions {
            return self.reduction(scene, self.metric?, contender);
        }
        let own = self.trials(scene.run, groups, contender);
        match &self.spec.against {
            Some(base) => {
                let base = self.trials(scene.run, std::slice::from_ref(base), contender);
                mean_difference([&base, &own], scene.evidence)
            }
            None => mean_solved(&own, scene.evidence),
        }
    }

    /// What whole instances give by query: every contender's values, or what each saves.
    fn numbers_by_query(&self, scene: &Scene<'_>, contenders: &[String]) -> Vec<(String, Vec<Spread>)> {
        let all = Selection { contenders: contenders.to_vec(), ..self.trials(scene.run, &self.problems, "") };
        let whole = Selection { whole_instances: true, ..all };
        if self.statistic == Statistic::Spreads {
            return spreads_by_query(&whole, scene.evidence);
        }
        let savings = savings_by_query(&whole, scene.evidence).into_iter();
        savings.map(|(name, saved)| (name, vec![saved])).collect()
    }

    /// The queries, and of savings all of them.
    pub(super) fn query_names(&self, scene: &Scene<'_>) -> Vec<String> {
        self.numbers_by_query(scene, &self.contenders).into_iter().map(|(name, _)| name).collect()
    }

    fn by_query(&self, scene: &Scene<'_>) -> Vec<Series> {
        let found = self.numbers_by_query(scene, &self.contenders);
        let count = found.first().map_or(0, |(_, spreads)| spreads.len());
        // What is saved is by the last contender.
        let shown = self.contenders.iter().skip(self.contenders.len().saturating_sub(count));
        let mut all: Vec<Series> = shown.map(|label| self.of_contender(scene, label, Vec::new())).collect();
        for (place, (_, spreads)) in found.into_iter().enumerate() {
            for (index, (series, spread)) in all.iter_mut().zip(spreads).enumerate() {
                let (Some(median), n) = (spread.median(), spread.values.len()) else { continue };
                let at = [Self::within(place, index, count), median];
                series
                    .points
                    .push(Point { spread, ..Point::new(place, at, Interval::new(median, median), n) });
            }
        }
        all
    }

    /// Where the number of a trial stands along the axis.
    fn place(&self, row: &Row) -> Option<f64> {
        let Along::Number(name) = &self.along else { return None };
        row.key.sweep.value(name).map_or_else(|| row.value(name), SweepValue::as_f64)
    }

    /// Every trial's number or its ratio to another's, and the geometric mean at each place.
    fn singles(&self, scene: &Scene<'_>, contender: &str) -> Series {
        let of = self.trials(scene.run, &self.problems, contender);
        let dots = numbers_along(&of, scene.evidence, |row| self.place(row));
        let means = geometric_means(&dots).into_iter().map(Point::bare).collect();
        Series { dots, ..self.of_contender(scene, contender, means) }
    }

    /// One metric against another: what is less of both, or every trial and the medians, failures infinite.
    fn crossed(&self, scene: &Scene<'_>, contender: &str, other: &'static Metric) -> Series {
        let Some(metric) = self.metric else { return Series::default() };
        if self.statistic == Statistic::Reductions {
            let both = self.reduction(scene, other, contender).zip(self.reduction(scene, metric, contender));
            let point = both.map(|(x, y)| {
                let (across, up) = (Point::of_reduction(0, 0.0, &x), Point::of_reduction(0, x.value, &y));
                Point { ends: [across.ends[1], up.ends[1]], ..up }
            });
            return self.of_contender(scene, contender, point.into_iter().collect());
        }
        let both = |row: &Row| {
            let value = |metric: &Metric| {
                if metric.is_given_by(row) { scene.run.value(row, metric) } else { Some(f64::INFINITY) }
            };
            Some([value(other)?, value(metric)?])
        };
        let of = self.trials(scene.run, &self.problems, contender);
        let rows = self.problems.iter().flat_map(|group| of.rows(scene.run, group, contender));
        let dots: Vec<[f64; 2]> = rows.filter_map(both).collect();
        let median = median_point(&dots).map(Point::bare).into_iter().collect();
        Series { dots, ..self.of_contender(scene, contender, median) }
    }

    /// The studies that are shown, each with its groups and what a series is called; of its own study each contender is one.
    fn along_sweep(&self, scene: &Scene<'_>) -> Vec<Series> {
        if self.spec.studies.is_empty() {
            let of = |(index, contender): (usize, &String)| {
                let mut series = self.of_contender(scene, contender, Vec::new());
                self.add_curve(scene, scene.run, &self.problems, contender, &mut series);
                let cells = self.rows.get(index).into_iter().flatten();
                series.printed =
                    cells.filter_map(|(value, printed)| Some([value.as_f64()?, *printed])).collect();
                series
            };
            return self.contenders.iter().enumerate().map(of).collect();
        }
        let runs = self.spec.studies.iter().filter_map(|name| scene.evidence.run(name));
        let of = |(looks, run): (usize, &Run<'_>)| {
            let groups: Vec<String> =
                run.study.groups.iter().take(1).map(|group| group.label.clone()).collect();
            let mut series = Series { label: groups.concat(), looks, ..Series::default() };
            self.add_curve(scene, run, &groups, &self.contenders[0], &mut series);
            series
        };
        runs.enumerate().map(of).collect()
    }

    /// The curve of one contender in one study.
    fn add_curve(
        &self,
        scene: &Scene<'_>,
        run: &Run<'_>,
        groups: &[String],
        contender: &str,
        series: &mut Series,
    ) {
        let Along::Number(sweep) = &self.along else { return };
        let all = self.trials(run, groups, contender);
        let keys: Vec<SweepKey> = all.sweep_points();
        let values = run.study.sweeps.iter().filter(|own| own.key == *sweep);
        let values = values.flat_map(|sweep| sweep.key_values().into_iter().flatten());
        let at = |value: &SweepValue, cell: Option<&SweepValue>| {
            let along = self.spec.row.as_deref().unwrap_or_default();
            let is_own = |key: &&SweepKey| {
                key.value(sweep) == Some(value) && cell.is_none_or(|cell| key.value(along) == Some(cell))
            };
            let own: Vec<SweepKey> = keys.iter().filter(is_own).cloned().collect();
            (!own.is_empty()).then(|| Selection { sweep: Some(own), ..all.clone() })
        };
        if self.statistic == Statistic::Distance {
            let row = &self.rows[0];
            let printed: Vec<f64> = row.iter().map(|(_, printed)| *printed).collect();
            let distance = |value: SweepValue| {
                let cells: Vec<Selection<'_>> =
                    row.iter().map(|(cell, _)| at(&value, Some(cell))).collect::<Option<_>>()?;
                let found = Curves::solved(&cells, scene.evidence).distance(&printed)?;
                Some(Point::estimated(0, value.as_f64()?, &found))
            };
            series.points = values.filter_map(distance).collect();
            return;
        }
        let (places, cells): (Vec<f64>, Vec<Selection<'_>>) =
            values.filter_map(|value| Some((value.as_f64()?, at(&value, None)?))).unzip();
        let curves = Curves::solved(&cells, scene.evidence);
        let n = curves.instances.len();
        series.points = match curves.band() {
            Some(found) => {
                let point = |(x, (mean, [low, high])): (f64, (f64, [f64; 2]))| {
                    Point::new(0, [x, mean], Interval::new(low, high), n)
                };
                places.iter().copied().zip(found.mean.into_iter().zip(found.band)).map(point).collect()
            }
            None => places.iter().zip(curves.means()).map(|(x, mean)| Point::bare([*x, mean])).collect(),
        };
        let one_more = curves.one_more().into_iter().flatten();
        series.one_more = places.iter().zip(one_more).map(|(x, range)| [*x, range.low, range.high]).collect();
        if self.has(MarkKind::Dots) {
            let curve =
                |shares: &Vec<f64>| places.iter().zip(shares).map(|(x, share)| [*x, *share]).collect();
            series.curves = curves.instances.iter().map(curve).collect();
        }
    }

    /// The mean share of another study's contender.
    pub(super) fn level(scene: &Scene<'_>, level: &super::Level) -> Result<f64, RenderError> {
        let missing =
            || RenderError::NotStored { what: format!("`{}` of `{}`", level.contender, level.study) };
        let run = scene.evidence.run(&level.study).ok_or_else(missing)?;
        let curves = Curves::solved(&[ask::trials(run, &level.problems, &level.contender)], scene.evidence);
        curves.means().first().copied().filter(|mean| mean.is_finite()).ok_or_else(missing)
    }

    /// The moments of a curve over time.
    pub(super) fn moments(&self) -> Vec<f64> {
        let until_s = self.spec.until_s.unwrap_or_default();
        (1..=MOMENTS).map(|moment| until_s * f64::from(moment) / f64::from(MOMENTS)).collect()
    }

    /// When a trial found what: its incumbents, and the path that it returned.
    fn found(&self, scene: &Scene<'_>, row: &Row) -> CostHistory {
        let kept = scene.run.trace(&row.key, "incumbents").filter(|kept| kept.width == 2);
        let mut found: CostHistory = kept.map(ask::points).unwrap_or_default();
        let value = self.metric.and_then(|metric| scene.run.value(row, metric));
        let returned = row.value("solve_wall_ns").zip(value).filter(|_| row.is_solved());
        found.extend(returned.map(|(ns, cost)| [ns / NS_PER_S, cost]));
        found
    }

    /// The median of the best cost by each moment, where it is finite.
    fn over_time(&self, scene: &Scene<'_>, contender: &str) -> Series {
        let rows: Vec<&Row> =
            self.problems.iter().flat_map(|group| scene.run.rows(group, contender)).collect();
        let of_instance = |rows: &[&Row]| rows.iter().map(|row| self.found(scene, row)).collect();
        let instances: Vec<Vec<CostHistory>> =
            rows.chunk_by(|a, b| a.key.on == b.key.on).map(of_instance).collect();
        let moments = self.moments();
        let medians = best_over_time(&instances, &moments);
        let points =
            moments.iter().zip(medians).filter_map(|(at, found)| Some(Point::estimated(0, *at, &found?)));
        self.of_contender(scene, contender, points.collect())
    }

    /// The reasons that any roadmap has pairs for, without those left out.
    fn reasons(&self, scene: &Scene<'_>) -> Vec<(&'static str, &'static str)> {
        let is_met = |column: &str| {
            let mut rows = self.problems.iter().flat_map(|problems| scene.run.preprocessing(problems));
            rows.any(|row| count(row, column).is_some_and(|pairs| pairs > 0.0))
        };
        let is_shown = |column: &str| !self.spec.leaves_out.iter().any(|out| out == column) && is_met(column);
        REASONS.into_iter().filter(|(column, _)| is_shown(column)).collect()
    }

    /// The mean share of pairs by reason; where nothing was counted there is none.
    fn pairs(&self, scene: &Scene<'_>) -> Vec<Series> {
        let reasons = self.reasons(scene);
        let of = |(index, group): (usize, &String)| {
            let rows: Vec<&PreprocessingRow> = scene.run.preprocessing(group).collect();
            let all = |row: &&PreprocessingRow| {
                let out: f64 = self.spec.leaves_out.iter().filter_map(|column| count(row, column)).sum();
                Some(count(row, "pairs")? - out)
            };
            let points = reasons.iter().enumerate().filter_map(|(place, (column, _))| {
                let mean = mean_percent(&rows, |row| count(row, column), all)?;
                let at = [Self::within(place, index, self.problems.len()), mean];
                Some(Point::new(place, at, Interval::new(mean, mean), rows.len()))
            });
            let label = if self.problems.len() > 1 { group.clone() } else { String::new() };
            Series { label, looks: index, points: points.collect(), ..Series::default() }
        };
        self.problems.iter().enumerate().map(of).collect()
    }

    /// For each set of the claim's instances, the share that lies below each number; and the printed number.
    fn distributions(&self, scene: &Scene<'_>) -> Result<Vec<Series>, RenderError> {
        let (paper, point) = (scene.evidence.paper, &scene.evidence.point);
        let claim = claim(&self.settings, paper, &self.spec.x)?;
        let context = Context { claim, settings: &self.settings, paper, point };
        let printed = context.print().ok().map(|print| print.printed.value());
        let sets = criterion::instances(&context, scene.evidence)?;
        let of = |(looks, set): (usize, &criterion::Instances)| {
            let found = Distribution::new(&set.values);
            let n = set.values.len();
            let points = found
                .steps
                .iter()
                .map(|[value, share]| Point::new(0, [*share, *value], Interval::new(*value, *value), n));
            Series {
                label: set.label.clone(),
                looks,
                points: points.collect(),
                dots: found.bulk.iter().map(|value| [0.0, *value]).collect(),
                printed: printed.iter().map(|printed| [0.0, *printed]).collect(),
                ..Series::default()
            }
        };
        Ok(sets.iter().enumerate().map(of).collect())
    }
}
