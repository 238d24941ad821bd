//! Whether each row of a printed table lists as many points as the text says; the points must be those that a study uses.

use super::{Entry, decided, rule};
use crate::analysis::context::Context;
use crate::analysis::selection_spec::Labels;
use crate::study::paper::TableRow;
use audit::proof;
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
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let listed = listed(context, &settings)?;
        let rows = settings.rows.keys().map(String::as_str).collect::<Vec<_>>().join(" and ");
        Ok(rule(move |_| {
            let Settings { points, table, study, .. } = &settings;
            let mut found = decided(proof::listed_points(table, &listed, *points));
            found.because.push(format!("study {study} uses the points of {rows}, to the digit"));
            found
        }))
    },
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

/// Every row of the table with how many points it lists; those that `settings` name must be what the study uses.
fn listed(context: &Context<'_>, settings: &Settings) -> Result<Vec<(String, usize)>, SettingsError> {
    let groups: Vec<String> = settings.rows.values().cloned().collect();
    let study = context.study("", &settings.study, &[])?;
    context.groups("rows", study, &Labels::Several(groups))?;
    let table = context.paper.tables.iter().find(|table| table.id == settings.table);
    let missing = || format!("the paper has no table `{}`", settings.table);
    let table = table.ok_or_else(|| context.settings.error_at("table", missing()))?;
    let mut listed = Vec::new();
    for row in &table.rows {
        let printed = points(row).map_err(|message| context.settings.error_at("table", message))?;
        listed.push((row.label.clone(), printed.len()));
        let Some(label) = settings.rows.get(&row.label) else { continue };
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
    Ok(listed)
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
