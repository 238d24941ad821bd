//! Shares of solved queries by problem group and contender at one point of the sweeps, with intervals over draws; beside
//! them, if asked for, what each group differs by from one of them, draw by draw.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::draws::{differences_percent, posed, solved_percents};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::rows::Interval;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Dash, GREY, Stroke, Width, series_color, series_marker};
use crate::study::Study;
use crate::study::key::SweepKey;
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::{self, Resampling};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "share_bars",
    about: "shares of solved queries by problem group and contender at one point of the sweeps, and paired differences from one group",
    settings: Accepted::of::<Read>(),
    example: r#"
problems = ["cell"]
sweep = "samples=800"
printed = ["t2.original.800"]
"#,
    build: |settings, study, paper| {
        let read: Read = settings.read()?;
        let named: Vec<String> = read.problems.iter().chain(&read.against).cloned().collect();
        ask::known(settings, study, &named, &[])?;
        let printed = ask::all_printed(settings, paper, "printed", &read.printed)?;
        let sweep = ask::sweep(settings, study, &read.sweep)?;
        Ok(Box::new(ShareBars { contenders: labels(study), printed, read, sweep }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem groups, by their labels.
    problems: Vec<String>,
    /// The point of the sweeps that is shown, as `setting=value,…`; empty without sweeps.
    sweep: String,
    /// Claims whose printed shares are drawn as lines.
    #[serde(default)]
    printed: Vec<String>,
    /// The group that a second panel shows differences from.
    against: Option<String>,
}

struct ShareBars {
    read: Read,
    sweep: SweepKey,
    contenders: Vec<String>,
    printed: Vec<f64>,
}

fn labels(study: &Study) -> Vec<String> {
    study.contenders.iter().map(|contender| contender.label.clone()).collect()
}

impl ShareBars {
    fn is_single(&self) -> bool {
        self.read.problems.len() == 1
    }

    /// The rows from the top down: of a single problem group one a contender, else one a problem group, with how many of its
    /// queries could be posed if not all.
    fn names(&self, scene: &Scene<'_>) -> Vec<String> {
        if self.is_single() {
            return self.contenders.clone();
        }
        let named = |problems: &String| match posed(scene.run, problems) {
            [posed, all] if posed < all => format!("{problems} ({posed} of {all} groups posed)"),
            _ => problems.clone(),
        };
        self.read.problems.iter().map(named).collect()
    }

    /// A panel with the mean over draws of what `of` gives for each group and contender.
    fn fill(
        &self,
        scene: &Scene<'_>,
        panel: &mut Panel,
        is_keyed: bool,
        of: &dyn Fn(&str, &str) -> Vec<f64>,
    ) {
        let (is_single, count) = (self.is_single(), self.contenders.len());
        let rows = if is_single { count } else { self.read.problems.len() } as f64;
        let step = 0.7 / count as f64;
        for (i, problems) in self.read.problems.iter().enumerate() {
            for (j, contender) in self.contenders.iter().enumerate() {
                let seed = seed::derive(0, &["share_bars", problems, contender]);
                let plan = Resampling { resamples: 2000, level: 0.95, seed };
                let Some(found) = bootstrap::mean(&of(problems, contender), plan) else { continue };
                let from_top = if is_single { j as f64 } else { i as f64 - 0.35 + step * (j as f64 + 0.5) };
                let index = ask::series(scene, contender, if is_single { 0 } else { j });
                panel.add(Interval {
                    row: rows - 1.0 - from_top,
                    values: [found.interval.low, found.value, found.interval.high],
                    marker: series_marker(index),
                    color: series_color(index),
                    label: if is_single || !is_keyed { String::new() } else { contender.clone() },
                });
            }
        }
    }

    /// A vertical line through all rows.
    fn rule(panel: &mut Panel, at: f64, rows: usize, label: &str) {
        let stroke = Stroke::solid(GREY, 0.9).dashed(Dash::Dashed);
        let line = Line::through(vec![[at, -0.5], [at, rows as f64 - 0.5]], stroke);
        panel.add(line.labelled(label));
    }

    fn differences(&self, scene: &Scene<'_>, against: &str, rows: usize) -> Result<Panel, RenderError> {
        let axis = Axis::linear(format!("difference from “{against}” (points)"), -103.0, 103.0)?;
        let mut panel = Panel::new("", axis, Axis::names("", vec![String::new(); rows]));
        Self::rule(&mut panel, 0.0, rows, "");
        self.fill(scene, &mut panel, false, &|problems, contender| {
            differences_percent(scene.run, [against, problems], contender, &self.sweep)
        });
        Ok(panel)
    }
}

impl Kind for ShareBars {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let names = self.names(scene);
        let rows = names.len();
        let y = Axis::names("", names.into_iter().rev());
        let mut panel = Panel::new("", Axis::linear("groups solved (%)", -3.0, 103.0)?, y);
        for value in &self.printed {
            Self::rule(&mut panel, *value, rows, "printed");
        }
        self.fill(scene, &mut panel, true, &|problems, contender| {
            solved_percents(scene.run, problems, contender, &self.sweep)
        });
        let per_row = if self.is_single() { 15.0 } else { 6.0 + 5.0 * self.contenders.len() as f64 };
        let columns = 1 + usize::from(self.read.against.is_some());
        let mut sheet = Sheet::new(Width::Double, columns, (rows as f64 * per_row).max(60.0));
        sheet.add(panel);
        if let Some(against) = &self.read.against {
            sheet.add(self.differences(scene, against, rows)?);
        }
        Ok(sheet)
    }
}
