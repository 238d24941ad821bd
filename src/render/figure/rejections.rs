//! What became of the pairs that roadmaps tried: shares by reason, mean over draws.

use super::{Entry, Kind, Scene, ask};
use crate::render::RenderError;
use crate::render::canvas::{Align, Stand, Type};
use crate::render::chart::marks::Note;
use crate::render::chart::rows::Bars;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Fill, TextSize, Width, series_color};
use crate::study::record::PreparedRow;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "rejections",
    about: "what became of the pairs of samples that roadmaps tried, by the first reason: mean share over draws",
    build: |settings, study, _paper| {
        let read: Rejections = settings.read()?;
        ask::known(settings, study, &read.problems, &[])?;
        Ok(Box::new(read))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Rejections {
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
    ("rejected_end", "other end"),
    ("rejected_contact", "contact"),
];

impl Kind for Rejections {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, 1, 150.0);
        let x = Axis::names("", BARS.map(|(_, name)| name));
        let mut panel = Panel::new("", x, Axis::linear("share of pairs (%)", 0.0, 100.0)?);
        let width = 0.8 / self.problems.len() as f64;
        for (index, problems) in self.problems.iter().enumerate() {
            let rows: Vec<&PreparedRow> =
                scene.run.records.batch.prepared.iter().filter(|row| row.group == *problems).collect();
            let share = |row: &&PreparedRow, column: &str| {
                let [part, all] = [column, "pairs"].map(|name| row.values.get(name).map(|v| v.as_f64()));
                Some(100.0 * part? / all.filter(|all| *all > 0.0)?)
            };
            let mut bars = Vec::new();
            for (place, (column, _)) in BARS.iter().enumerate() {
                let shares: Vec<f64> = rows.iter().filter_map(|row| share(row, column)).collect();
                let mean = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
                let left = place as f64 - 0.4 + index as f64 * width;
                bars.push([left, left + width, mean]);
                let set = Type::of(TextSize::TICK).aligned(Align::Middle, Stand::Base);
                let at = [left + width / 2.0, mean];
                panel.add(Note { at, shift_pt: [0.0, -3.0], text: format!("{mean:.1}"), set });
            }
            let label = if self.problems.len() > 1 { problems.clone() } else { String::new() };
            panel.add(Bars { bars, fill: Fill::solid(series_color(index)), label });
        }
        sheet.add(panel);
        Ok(sheet)
    }
}
