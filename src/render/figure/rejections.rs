//! The fate of the pairs that roadmaps tried: shares by reason, mean over instances.

use super::{Entry, Kind, Scene, ask};
use crate::analysis::tabulated::mean_percent;
use crate::render::RenderError;
use crate::render::canvas::{Align, Stand, Type};
use crate::render::chart::marks::Note;
use crate::render::chart::rows::Bars;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Fill, TextSize, Width, series_color};
use base::settings::Accepted;
use engine::planner::Value;
use schemars::JsonSchema;
use serde::Deserialize;
use study::record::PreprocessingRow;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "rejections",
    about: "what became of the pairs of samples that roadmaps tried, by the first reason: mean share over instances",
    statistic: "Means over instances that have such pairs; {n}.",
    settings: Accepted::shape::<Rejections>(),
    example: r#"
problems = ["cell"]
"#,
    build: |settings, study, _paper| {
        let read: Rejections = settings.read()?;
        ask::known(settings, study, &read.problems, [])?;
        Ok(Box::new(read))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Rejections {
    /// The problem groups, by their labels.
    problems: Vec<String>,
}

/// Columns of roadmaps in the order of their bars, and what they are called.
const BARS: [(&str, &str); 9] = [
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

/// Pairs that are left out of a panel's whole, and its title.
const PANELS: [(&[&str], &str); 2] =
    [(&[], "of all pairs"), (&["rejected_branch"], "of pairs on one branch")];

fn count(row: &PreprocessingRow, column: &str) -> Option<f64> {
    row.values.get(column).map(Value::as_f64)
}

impl Rejections {
    fn rows<'s>(scene: &'s Scene<'_>, problems: &str) -> Vec<&'s PreprocessingRow> {
        scene.run.preprocessing(problems).collect()
    }

    /// The bars that any roadmap of the figure has pairs for, without those left out.
    fn bars(&self, scene: &Scene<'_>, left_out: &[&str]) -> Vec<(&'static str, &'static str)> {
        let is_met = |column: &str| {
            let mut rows = self.problems.iter().flat_map(|problems| Self::rows(scene, problems));
            rows.any(|row| count(row, column).is_some_and(|pairs| pairs > 0.0))
        };
        let kept = BARS.into_iter().filter(|(column, _)| !left_out.contains(column) && is_met(column));
        kept.collect()
    }

    fn panel(&self, scene: &Scene<'_>, left_out: &[&str], title: &str) -> Result<Panel, RenderError> {
        let named = self.bars(scene, left_out);
        let x = Axis::names("", named.iter().map(|(_, name)| *name));
        let mut panel = Panel::new(title, x, Axis::linear("share of pairs (%)", 0.0, 100.0)?);
        let width = 0.8 / self.problems.len() as f64;
        for (index, problems) in self.problems.iter().enumerate() {
            let rows = Self::rows(scene, problems);
            let all = |row: &&PreprocessingRow| {
                let out: f64 = left_out.iter().filter_map(|column| count(row, column)).sum();
                Some(count(row, "pairs")? - out)
            };
            let mut bars = Vec::new();
            for (place, (column, _)) in named.iter().enumerate() {
                // Where nothing was counted there is no share, and no bar.
                let Some(mean) = mean_percent(&rows, |row| count(row, column), all) else { continue };
                let left = place as f64 - 0.4 + index as f64 * width;
                bars.push([left, left + width, mean]);
                let set = Type::regular(TextSize::TICK).aligned(Align::Middle, Stand::Base);
                let at = [left + width / 2.0, mean];
                let text = format!("{mean:.1}");
                panel.add(Note { at, shift_pt: [0.0, -3.0], text, set });
            }
            let label = if self.problems.len() > 1 { problems.clone() } else { String::new() };
            panel.add(Bars { bars, fill: Fill::solid(series_color(index)), label });
        }
        Ok(panel)
    }
}

impl Kind for Rejections {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let panels = PANELS.map(|(left_out, title)| self.panel(scene, left_out, title));
        Sheet::new(Width::Double, PANELS.len(), 150.0).with(panels)
    }
}
