//! Traces for posthoc (posthoc-app.pathfinding.ai), one for each stored search on a grid.
//!
//! Version 1.4.0 of its format: events in their order, and a view that draws each as a cell. Our traces hold in which order cells
//! were opened and closed, and not from where: events have no parent. The y of posthoc points down and ours up, so rows are turned.

use crate::file_names::FileNames;
use replan::analysis::compare::StoredRun;
use replan::cli::Failure;
use serde_json::{Value, json};
use std::path::Path;
use study::key::Owner;
use study::store::{KeptTraces, Staged};

const VIEWS: &str = "version: 1.4.0

views:
  main:
    - $: rect
      fill: ${{ color[$.type] }}
      width: 1
      height: 1
      x: ${{ $.x }}
      y: ${{ $.y }}

pivot:
  x: ${{ $.x + 0.5 }}
  y: ${{ $.y + 0.5 }}
  scale: 1

events:
";

/// Stages a file for each search, and says how many there are.
///
/// # Errors
/// A damaged file of traces, no search on a grid, or the file system.
pub fn stage(staged: &mut Staged, out: &Path, folder: &Path, run: &StoredRun) -> Result<String, Failure> {
    let mut count = 0;
    let mut file_names = FileNames::default();
    for (study, (manifest, _)) in &run.studies {
        let mut traces = KeptTraces::stored(folder, study, &manifest.files)?;
        let owners: Vec<Owner> = traces.owners()?.into_iter().cloned().collect();
        for owner in owners {
            let Owner::Trial(key) = &owner else { continue };
            let on = traces.take(&Owner::from(&key.on))?;
            let size =
                on.iter().find(|trace| trace.name == "size_cells").and_then(|trace| trace.values.get(1));
            let Some(rows) = size.copied() else { continue };
            let own = traces.take(&owner)?;
            let points = |name: &str| {
                let trace = own.iter().find(|trace| trace.name == name);
                trace.into_iter().flat_map(|trace| trace.values.chunks(trace.width)).collect::<Vec<_>>()
            };
            let opened = ["opened_start_side", "opened_goal_side"].map(points);
            let events = events(&opened, &points("closings"), &points("path"), rows);
            if events.is_empty() {
                continue;
            }
            let names = study::name::Names::default();
            let name = format!("{study}/{}", names.trial(key));
            let lines: Vec<String> = events.iter().map(|event| format!("  - {event}\n")).collect();
            let file = out.join(file_names.next(&name, ".trace.yaml"));
            staged.add(&file, format!("{VIEWS}{}", lines.concat()).as_bytes())?;
            count += 1;
        }
    }
    if count == 0 {
        let paper = &run.name;
        return Err(Failure::input(format!(
            "`{paper}` has no stored search on a grid; a run whose studies `[[keep]]` traces of one is accepted"
        )));
    }
    Ok(format!("{count} traces for posthoc are"))
}

/// What happened in a search, in its order: each closing tells how many cells each side had opened by then.
fn events(opened: &[Vec<&[f64]>; 2], closings: &[&[f64]], path: &[&[f64]], rows: f64) -> Vec<Value> {
    let event = |kind: &str, point: &[f64]| {
        let (x, y) = (point[0], rows - 1.0 - point[1]);
        json!({ "type": kind, "id": format!("{},{}", point[0], point[1]), "x": x, "y": y })
    };
    let mut events = Vec::new();
    let ends = [("source", path.first()), ("destination", path.last())];
    events.extend(ends.into_iter().filter_map(|(kind, point)| Some(event(kind, point?))));
    let mut done = [0; 2];
    for closing in closings {
        for side in [0, 1] {
            let until = closing.get(3 + side).map_or(0, |count| *count as usize).min(opened[side].len());
            events.extend(
                opened[side][done[side].min(until)..until].iter().map(|cell| event("generating", cell)),
            );
            done[side] = done[side].max(until);
        }
        events.push(event("expanding", closing));
    }
    for side in [0, 1] {
        events.extend(opened[side][done[side]..].iter().map(|cell| event("generating", cell)));
    }
    let is_search = events.iter().any(|event| event["type"] == "generating");
    events.extend(path.iter().map(|point| event("solution", point)));
    if is_search { events } else { Vec::new() }
}
