//! Whether each row of a printed table lists as many points as the text says; the points must be those that a study uses.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::context::Context;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use crate::analysis::selection_spec::Labels;
use crate::study::paper::TableRow;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Value;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "listed_points",
    about: "does each row of a printed table list as many points as stated? a study must use the same points",
    settings: Accepted::of::<Settings>(),
    example: r#"
points = 4
table = "table1"
study = "methods"
key = "obstacles_cm"
rows = { "Case 1" = "case 1", "Case 2" = "case 2" }
"#,
    build: |context| Ok(Box::new(ListedPoints::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// How many points the text says that each row lists.
    points: usize,
    /// The table; its cells are x and y in turn, dashes where nothing is printed.
    table: String,
    /// The study whose records are looked at.
    study: String,
    /// The setting of the study's problem groups that holds the same points.
    key: String,
    /// The problem group that each row is used in.
    rows: BTreeMap<String, String>,
}

struct ListedPoints {
    settings: Settings,
    /// Row and the number of points that it lists.
    found: Vec<(String, usize)>,
}

impl ListedPoints {
    fn new(context: &Context<'_>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let groups: Vec<String> = settings.rows.values().cloned().collect();
        let study = context.study("", &settings.study, &[])?;
        context.groups("rows", study, &Labels::Several(groups))?;
        let table = context.paper.tables.iter().find(|table| table.id == settings.table);
        let table = table.ok_or_else(|| {
            context.settings.error_at("table", format!("the paper has no table `{}`", settings.table))
        })?;
        let mut found = Vec::new();
        for row in &table.rows {
            let printed = points(row).map_err(|message| context.settings.error_at("table", message))?;
            if let Some(label) = settings.rows.get(&row.label) {
                let group = study.groups.iter().find(|group| group.label == *label);
                let used = group.and_then(|group| used(group.settings.table().get(&settings.key)?));
                if used.as_ref() != Some(&printed) {
                    let message = format!(
                        "row `{}` of table `{}` prints {printed:?}, but `{}` of problem group `{label}` is {used:?}",
                        row.label, table.id, settings.key
                    );
                    return Err(context.settings.error_at(&format!("rows.{}", row.label), message));
                }
            }
            found.push((row.label.clone(), printed.len()));
        }
        Ok(Self { settings, found })
    }
}

/// The points whose coordinates a row prints.
fn points(row: &TableRow) -> Result<Vec<[f64; 2]>, String> {
    let number = |cell: &String| cell.replace('−', "-").parse::<f64>().ok();
    let mut points = Vec::new();
    for pair in row.cells.chunks(2) {
        match (number(&pair[0]), pair.get(1).and_then(number)) {
            (Some(x), Some(y)) => points.push([x, y]),
            (None, None) => {}
            _ => return Err(format!("row `{}` prints half a point, {pair:?}", row.label)),
        }
    }
    Ok(points)
}

fn used(value: &Value) -> Option<Vec<[f64; 2]>> {
    let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    let point = |value: &Value| {
        let pair = value.as_array()?;
        Some([number(pair.first()?)?, number(pair.get(1)?)?])
    };
    value.as_array()?.iter().map(point).collect()
}

impl Rule for ListedPoints {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Settings { points, table, study, rows, .. } = &self.settings;
        let mut because: Vec<String> = self
            .found
            .iter()
            .map(|(row, count)| format!("{row} of {table} lists {count} points, and the text says {points}"))
            .collect();
        because.push(format!(
            "study {study} uses the points of {}, to the digit",
            rows.keys().map(String::as_str).collect::<Vec<_>>().join(" and ")
        ));
        let agrees = self.found.iter().all(|(_, count)| count == points);
        Found {
            outcome: Some(if agrees { Outcome::Holds } else { Outcome::Proved }),
            because,
            premises: vec![format!("the text speaks of every row of {table}, and a dash is no point")],
            ..Found::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_are_no_points_and_half_a_point_is_refused() {
        let row = |cells: &[&str]| TableRow {
            label: "r".to_owned(),
            contender: None,
            reduced_from: None,
            claims: Vec::new(),
            cells: cells.iter().map(|cell| (*cell).to_owned()).collect(),
        };
        assert_eq!(points(&row(&["−13", "35", "–", "–"])), Ok(vec![[-13.0, 35.0]]));
        assert!(points(&row(&["1", "–"])).unwrap_err().contains("half a point"));
        assert_eq!(used(&toml::toml! { a = [[1, 2.5]] }["a"]), Some(vec![[1.0, 2.5]]));
    }
}
