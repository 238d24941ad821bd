//! Statistics of trials: numbers along an axis, one series a contender, each drawn by marks, with what the paper prints.
//!
//! One axis of a panel is a number, the other says what it is along. The two, and whether a contender or problem group stands
//! beside, say which statistic it is ([`Statistic`]). Numbers come from [`analysis::shown`](crate::analysis::shown).

mod numbers;
mod panel;
mod table;

use super::{CurveLine, Curves, Entry, Kind, Scene, Shown, ask};
use crate::analysis::metric::{self, Metric};
use crate::render::RenderError;
use crate::render::chart::Sheet;
use crate::render::latex::Table;
use crate::render::style::Width;
use base::settings::{Accepted, AnyTable, Faults, Settings, SettingsError, none_called};
use schemars::JsonSchema;
use serde::Deserialize;
use study::key::SweepValue;
use study::paper::{Claim, Paper};
use study::{Study, column, sweeps_of};
use toml::Table as Toml;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "statistics",
    about: "numbers along names, a sweep, a column, a metric or time, by contender: lines, bands, points with intervals, boxes, bars, \
            single values; what is printed on top",
    statistic: "{n}.",
    settings: Accepted::shape::<Read>(),
    example: r#"
[[panels]]
x = "samples"
y = "solved"
problems = ["cell"]
contenders = ["Original A*", "Improved A*"]
printed = ["t2.original.", "t2.improved."]
"#,
    build: |settings, study, paper| Ok(Box::new(Statistics::new(settings, study, paper)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The keys of `panels` that hold in every panel without its own.
    #[serde(default)]
    #[schemars(with = "AnyTable")]
    every: Toml,
    /// The panels, in their order.
    panels: Vec<PanelSpec>,
    /// How many panels stand beside each other; all of them if absent.
    #[schemars(range(min = 1, max = 12))]
    columns: Option<usize>,
}

/// A panel. One of `x` and `y` is a number: `solved` (the share of queries), a metric, `pairs` (their share) or a claim whose criterion
/// `one_instance` says what is shown. The other is what it is along.
#[derive(Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields, default)]
struct PanelSpec {
    /// What stands above it.
    title: String,
    /// What stands along the horizontal axis: a sweep, a column of the problem, another metric, or `time`. Names are `problems`, `contenders`,
    /// `queries`, or `reasons` (what became of pairs of samples). It is the number if `y` is `problems`, `contenders` or `instances`.
    x: String,
    /// What stands along the vertical axis.
    y: String,
    /// The title of the axis that shows no numbers.
    axis: String,
    /// The problem groups, by their labels, taken together where they are not along an axis; all if absent.
    problems: Vec<String>,
    /// The contenders, by their labels; all if absent.
    contenders: Vec<String>,
    /// Contenders that do the same on every instance: they have no interval.
    certain: Vec<String>,
    /// The queries, by their names; all if absent.
    queries: Vec<String>,
    /// The points of the sweeps, as in a selection: `samples=800`; all if absent.
    sweep: Option<String>,
    /// The contender against which numbers are less, in per cent; of shares solved, the problem group from which they differ.
    against: Option<String>,
    /// Ratios to the contender `against` in place of what is less.
    ratio: bool,
    /// Studies that are compared, each a series of its first problem group.
    studies: Vec<String>,
    /// Shares solved in other studies, as lines across.
    levels: Vec<Level>,
    /// Claims whose numbers are drawn as lines; of ratios the two claims that form the ratio. Along a sweep also how the names of a
    /// printed row's claims begin (`t2.original.`), one for each contender.
    printed: Vec<String>,
    /// The sweep along a printed row; the panel shows how far its cells are from ours.
    row: Option<String>,
    /// Columns of pairs that do not count.
    leaves_out: Vec<String>,
    /// The last moment of `time`, in seconds.
    #[schemars(range(min = 0.01, max = 3600.0))]
    until_s: Option<f64>,
    /// How numbers are drawn; the usual way of the statistic if absent.
    marks: Vec<MarkKind>,
}

/// How numbers are drawn.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Debug)]
#[serde(rename_all = "snake_case")]
enum MarkKind {
    /// A line through them.
    Line,
    /// Their intervals as an area.
    Band,
    /// Points, where no band is drawn with their intervals.
    Point,
    /// Median, quartiles, 5 and 95 %.
    Box,
    /// Upright bars from zero.
    Bar,
    /// Single values, or the curves of single instances.
    Dots,
}

impl MarkKind {
    fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Band => "band",
            Self::Point => "point",
            Self::Box => "box",
            Self::Bar => "bar",
            Self::Dots => "dots",
        }
    }
}

/// A share of solved queries as a line across the panel.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Level {
    /// The study.
    study: String,
    /// Its problem group, by its label.
    problems: String,
    /// Its contender, by its label.
    contender: String,
    /// What the line is called.
    label: String,
}

/// A statistic.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Statistic {
    Solved,
    Difference,
    Distance,
    Reductions,
    Savings,
    Spreads,
    Ratios,
    Singles,
    Failures,
    OverTime,
    Pairs,
    Distribution,
}

impl Statistic {
    /// What stands in captions.
    fn caption(self) -> &'static str {
        match self {
            Self::Solved | Self::Difference | Self::Distance => {
                "Means, 95 % intervals; unsolved queries count; {n}."
            }
            Self::Reductions => "Mean reductions where both solve, with 95 % bootstrap intervals; {n}.",
            Self::Savings | Self::Spreads => "Median, quartiles, 5–95 %, where all solve; {n}.",
            Self::Ratios => "Instances that both solve, and geometric means; {n}.",
            Self::Singles => "Single trials; {n}.",
            Self::Failures => "Single trials and medians, failures infinite; {n}.",
            Self::OverTime => {
                "Medians over queries with 95 % bootstrap intervals over instances. No path costs infinitely much; {n}."
            }
            Self::Pairs => "Means over instances that have such pairs; {n}.",
            Self::Distribution => "Outer hundredths cut; {n}.",
        }
    }

    /// The marks that it has where the spec names none, and those that it may have besides.
    fn marks(self, is_named: bool) -> [&'static [MarkKind]; 2] {
        use MarkKind::{Band, Bar, Box, Dots, Line, Point};
        match self {
            Self::Solved if !is_named => [&[Line, Band], &[Point, Dots]],
            Self::Solved | Self::Difference | Self::Reductions => [&[Point], &[]],
            Self::Distance => [&[Line, Point, Band], &[]],
            Self::Savings | Self::Spreads => [&[Box, Dots], &[]],
            Self::Ratios => [&[Line, Dots], &[Point]],
            Self::Singles => [&[Line, Point], &[Dots]],
            Self::Failures => [&[Point, Dots], &[]],
            Self::OverTime => [&[Line, Band], &[]],
            Self::Pairs => [&[Bar], &[]],
            Self::Distribution => [&[Line], &[]],
        }
    }
}

/// What a number is along.
#[derive(Clone, PartialEq, Debug)]
enum Along {
    Problems,
    Contenders,
    Queries,
    Reasons,
    Instances,
    Time,
    /// A sweep, or a column of the problem.
    Number(String),
    Metric(&'static Metric),
}

impl Along {
    /// Whether it is names, side by side.
    fn is_names(&self) -> bool {
        matches!(self, Self::Problems | Self::Contenders | Self::Queries | Self::Reasons)
    }
}

/// A panel, looked up.
struct StatisticsPanel {
    spec: PanelSpec,
    settings: Settings,
    statistic: Statistic,
    along: Along,
    metric: Option<&'static Metric>,
    /// Whether the number is along the horizontal axis.
    is_sideways: bool,
    problems: Vec<String>,
    contenders: Vec<String>,
    /// Printed numbers that are drawn as lines.
    rules: Vec<f64>,
    /// Printed rows, by contender: the sweep's value, and the number.
    rows: Vec<Vec<(SweepValue, f64)>>,
    /// All contenders of the figure, whose places give them their colours.
    order: Vec<String>,
}

struct Statistics {
    panels: Vec<StatisticsPanel>,
    columns: usize,
    /// How many instances the groups of a figure over time have.
    instances: u32,
}

impl Statistics {
    fn new(settings: &Settings, study: &Study, paper: &Paper) -> Result<Self, SettingsError> {
        let Read { every, panels, columns } = settings.read()?;
        let written = settings.table().get("panels").and_then(toml::Value::as_array);
        let mut made = Vec::new();
        let mut faults = Faults::default();
        for (index, own) in written.into_iter().flatten().filter_map(toml::Value::as_table).enumerate() {
            let mut table = every.clone();
            table.extend(own.clone());
            let keys = [format!("panels.{index}"), "every".to_owned()];
            let whose = format!("panel {}", index + 1);
            let own = Settings::of_parts(settings, &[&keys[0], &keys[1]], whose, table);
            made.extend(faults.keep(StatisticsPanel::new(own, study, paper)));
        }
        faults.done()?;
        let mut order: Vec<String> = Vec::new();
        for label in made.iter().flat_map(|panel| &panel.contenders) {
            if !order.contains(label) {
                order.push(label.clone());
            }
        }
        for panel in &mut made {
            panel.order.clone_from(&order);
        }
        let instances = study.groups.iter().map(|group| group.instances).max().unwrap_or(0);
        Ok(Self { columns: columns.unwrap_or(panels.len()), panels: made, instances })
    }
}

impl StatisticsPanel {
    fn new(settings: Settings, study: &Study, paper: &Paper) -> Result<Self, SettingsError> {
        let spec: PanelSpec = settings.read()?;
        let is_sideways = matches!(spec.y.as_str(), "problems" | "contenders" | "instances");
        let (along, number) = if is_sideways { (&spec.y, &spec.x) } else { (&spec.x, &spec.y) };
        let along = along_called(&settings, study, along, spec.ratio)?;
        if along == Along::Instances {
            claim(&settings, paper, number)?;
        }
        let is_share = ["solved", "pairs"].contains(&number.as_str()) || along == Along::Instances;
        let metric = (!is_share).then(|| ask::produced(&settings, study, number)).transpose()?;
        let statistic = statistic(&settings, &spec, &along, (number, metric))?;
        let named = |own: &[String], all: Vec<String>| if own.is_empty() { all } else { own.to_vec() };
        let groups = study.groups.iter().map(|group| group.label.clone()).collect();
        let problems = named(&spec.problems, groups);
        let contenders = named(&spec.contenders, study.labels());
        let of_groups = statistic == Statistic::Difference;
        let (group, contender) =
            if of_groups { (spec.against.as_ref(), None) } else { (None, spec.against.as_ref()) };
        let labels = spec.contenders.iter().chain(&spec.certain).chain(contender);
        ask::known(&settings, study, problems.iter().chain(group), labels)?;
        for query in &spec.queries {
            let first = problems.first().map_or("", String::as_str);
            ask::query(&settings, study, first, query, ("queries", query))?;
        }
        if let Some(text) = &spec.sweep {
            study
                .sweeps_called(&problems, std::slice::from_ref(text))
                .map_err(|(_, message)| settings.error_at("sweep", message).about(&sweeps_of(&study.name)))?;
        }
        let other = |name: &String| {
            let known = paper.studies.iter().map(|study| study.name.as_str());
            let missing = || {
                settings.error_about(&["studies", "levels.study"], name, none_called("study", name, known))
            };
            paper.study(name).ok_or_else(missing)
        };
        spec.studies.iter().try_for_each(|name| other(name).map(|_| ()))?;
        for level in &spec.levels {
            ask::known(&settings, other(&level.study)?, [&level.problems], [&level.contender])?;
        }
        let accepted = statistic.marks(along.is_names()).concat();
        if let Some(mark) = spec.marks.iter().find(|mark| !accepted.contains(mark)) {
            let accepted: Vec<&str> = accepted.iter().map(|mark| mark.name()).collect();
            let message = format!("`marks` has {}; accepted are {}", mark.name(), accepted.join(", "));
            return Err(settings.error_at("marks", message));
        }
        let order = Vec::new();
        let (rules, rows) = (Vec::new(), Vec::new());
        let mut panel = Self {
            spec,
            settings,
            statistic,
            along,
            metric,
            is_sideways,
            problems,
            contenders,
            rules,
            rows,
            order,
        };
        panel.read_printed(study, paper)?;
        Ok(panel)
    }

    /// Looks up what is printed: claims as they are, or the claims of a row along a sweep.
    fn read_printed(&mut self, study: &Study, paper: &Paper) -> Result<(), SettingsError> {
        for (index, id) in self.spec.printed.iter().enumerate() {
            let key = format!("printed.{index}");
            let sweep = self.spec.row.as_ref().or(match &self.along {
                Along::Number(name) => Some(name),
                _ => None,
            });
            let sweep = sweep.and_then(|name| study.sweeps.iter().find(|sweep| sweep.key == *name));
            let Some(sweep) = sweep.filter(|_| paper.claim(id).is_none()) else {
                self.rules.push(ask::printed(&self.settings, paper, &key, id)?);
                continue;
            };
            let cell = |value: SweepValue| {
                let printed = ask::printed(&self.settings, paper, &key, &format!("{id}{value}"))?;
                Ok((value, printed))
            };
            let cells = sweep.key_values().into_iter().flatten().map(cell);
            self.rows.push(cells.collect::<Result<_, SettingsError>>()?);
        }
        if let (Statistic::Ratios, [own, base]) = (self.statistic, &self.rules[..]) {
            self.rules = vec![own / base];
        }
        Ok(())
    }

    /// How its numbers are drawn.
    fn has(&self, mark: MarkKind) -> bool {
        let [usual, _] = self.statistic.marks(self.along.is_names());
        if self.spec.marks.is_empty() { usual.contains(&mark) } else { self.spec.marks.contains(&mark) }
    }
}

/// What `word` means along an axis.
fn along_called(
    settings: &Settings,
    study: &Study,
    word: &str,
    is_ratio: bool,
) -> Result<Along, SettingsError> {
    Ok(match word {
        "problems" => Along::Problems,
        "contenders" => Along::Contenders,
        "queries" => Along::Queries,
        "reasons" => Along::Reasons,
        "instances" => Along::Instances,
        "time" => Along::Time,
        _ if study.sweeps.iter().any(|sweep| sweep.key == word) => Along::Number(word.to_owned()),
        _ if is_ratio && column::find(word).is_some() => Along::Number(word.to_owned()),
        _ => Along::Metric(metric::find(word).ok_or_else(|| {
            let names = ["problems", "contenders", "queries", "reasons", "instances", "time"];
            let known = names.into_iter().chain(study.sweeps.iter().map(|sweep| sweep.key.as_str()));
            let message = none_called("axis", word, known) + ", and all metrics";
            settings.error_about(&["x", "y"], word, message).about(&sweeps_of(&study.name))
        })?),
    })
}

/// The statistic that the axes and `against` ask for.
fn statistic(
    settings: &Settings,
    spec: &PanelSpec,
    along: &Along,
    (number, metric): (&str, Option<&Metric>),
) -> Result<Statistic, SettingsError> {
    let is_against = spec.against.is_some();
    Ok(match (along, number, metric) {
        (Along::Number(_), "solved", _) if spec.row.is_some() => Statistic::Distance,
        (Along::Problems, "solved", _) if is_against => Statistic::Difference,
        (Along::Problems | Along::Contenders | Along::Number(_), "solved", _)
            if !is_against && !spec.ratio =>
        {
            Statistic::Solved
        }
        (Along::Reasons, "pairs", _) => Statistic::Pairs,
        (Along::Instances, _, _) => Statistic::Distribution,
        (Along::Contenders | Along::Metric(_), _, Some(_)) if is_against => Statistic::Reductions,
        (Along::Queries, _, Some(_)) if is_against => Statistic::Savings,
        (Along::Queries, _, Some(_)) => Statistic::Spreads,
        (Along::Number(_), _, Some(_)) if is_against && spec.ratio => Statistic::Ratios,
        (Along::Number(_), _, Some(_)) if !is_against && !spec.ratio => Statistic::Singles,
        (Along::Metric(_), _, Some(_)) if !is_against => Statistic::Failures,
        (Along::Time, _, Some(_)) if spec.until_s.is_some() => Statistic::OverTime,
        _ => {
            return Err(settings.error_at(
                "y",
                "no statistic is along these axes; accepted: `solved` along problems (also `against` one), contenders or a sweep; a metric \
                 along queries (also `against` a contender), contenders (`against` one), a sweep or another metric (also `against` one), time (with \
                 `until_s`), or with `ratio` along a sweep or a column; `pairs` along reasons; a claim along instances",
            ));
        }
    })
}

/// The claim called `id`, whose criterion `one_instance` says what is to be shown.
fn claim<'p>(settings: &Settings, paper: &'p Paper, id: &str) -> Result<&'p Claim, SettingsError> {
    let known = paper.claims.iter().map(|claim| claim.id.as_str());
    let missing = || settings.error_about(&["x", "y"], id, none_called("claim", id, known)).about("id");
    let claim = paper.claim(id).ok_or_else(missing)?;
    if claim.criteria().any(|(own, _)| own == "one_instance") {
        return Ok(claim);
    }
    let message = format!("claim `{id}` has no criterion `one_instance`, which says what is to be shown");
    Err(settings.error_about(&["x", "y"], id, message))
}

impl Kind for Statistics {
    fn statistic(&self) -> Option<&'static str> {
        self.panels.first().map(|panel| panel.statistic.caption())
    }

    fn shown(&self) -> Vec<Shown<'_>> {
        let mut shown = Vec::new();
        for panel in self.panels.iter().filter(|panel| panel.statistic == Statistic::OverTime) {
            for problems in &panel.problems {
                let of = |instance| Shown { problems, contenders: &panel.contenders, instance };
                shown.extend((0..self.instances).map(of));
            }
        }
        shown
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let all = self.panels.iter().map(|panel| panel.series(scene)).collect::<Result<Vec<_>, _>>()?;
        let rows = self.panels.iter().filter(|panel| panel.is_sideways && panel.along.is_names());
        let heights = rows.map(StatisticsPanel::rows_pt);
        let height =
            heights.reduce(f64::max).unwrap_or([200.0, 190.0, 150.0, 118.0][self.columns.clamp(1, 4) - 1]);
        // Ratios are compared, on one scale.
        let of_ratios =
            self.panels.iter().zip(&all).filter(|(panel, _)| panel.statistic == Statistic::Ratios);
        let ratios: Vec<f64> = of_ratios.flat_map(|(panel, all)| panel.values(all)).collect();
        let mut sheet = Sheet::new(Width::Double, self.columns, height);
        for (index, (panel, series)) in self.panels.iter().zip(&all).enumerate() {
            let is_first = index.is_multiple_of(self.columns);
            sheet = sheet.noted(panel.note(series));
            sheet.add(panel.drawn(scene, series, &ratios, is_first)?);
        }
        Ok(if self.panels.iter().any(|panel| panel.is_sideways) { sheet.level() } else { sheet })
    }

    fn curves(&self, scene: &Scene<'_>, caption: &str) -> Option<Curves> {
        let [panel] = &self.panels[..] else { return None };
        if panel.along.is_names() || !panel.has(MarkKind::Band) {
            return None;
        }
        panel.curves(&panel.series(scene).ok()?, caption)
    }

    fn table(&self, scene: &Scene<'_>, label: &str, caption: &str) -> Result<Option<Table>, RenderError> {
        let is_paired = |panel: &StatisticsPanel| {
            panel.along.is_names() && matches!(panel.statistic, Statistic::Reductions | Statistic::Savings)
        };
        if !self.panels.iter().any(is_paired) {
            return Ok(None);
        }
        table::table(&self.panels, scene, (label, caption)).map(Some)
    }
}
