//! Replays: stored trials on one problem, side by side and in step.

mod any_angle;
mod arm;
mod grid;
mod plane;

use super::{PageError, in_order};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::verdict::Verdicts;
use crate::render::figure;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use study::Group;
use study::Inputs;
use study::record::Row;

/// Trials on one problem.
#[derive(Serialize)]
pub struct Replay {
    /// The problem, with its study.
    pub title: String,
    /// The names of the trials, as `--trial` takes them.
    pub trials: Vec<String>,
    /// What is shown.
    #[serde(flatten)]
    scene: Shown,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Shown {
    AnyAngle(any_angle::Scene),
    Grid(grid::Scene),
    Plane(plane::Scene),
    Arm(arm::Scene),
}

impl Replay {
    /// It as JSON.
    pub fn json(&self) -> Vec<u8> {
        serde_json::to_vec(self).expect("texts and finite numbers")
    }
}

/// The trials of a problem that have something to show, each with its run.
struct Case<'r> {
    run: &'r Run<'r>,
    group: &'r Group,
    rows: Vec<&'r Row>,
}

/// Every replay of the paper, those first that a finding names or a figure draws.
///
/// # Errors
/// A family that cannot be built again.
pub fn all(evidence: &Evidence<'_>, verdicts: &Verdicts, inputs: &Inputs) -> Result<Vec<Replay>, PageError> {
    let findings = verdicts.claims.iter().flat_map(|judged| &judged.findings);
    let named: BTreeSet<&str> = findings.filter_map(|finding| finding.trial.as_deref()).collect();
    let mut ranked = Vec::new();
    for run in evidence.runs() {
        let drawn = figure::drawn(run.study, evidence.paper);
        let cases = cases(run);
        let made = in_order(&cases, |case| replay(evidence, case, inputs))?;
        for (case, replay) in cases.iter().zip(made) {
            let Some(replay) = replay else { continue };
            let group = case.group.label.clone();
            let instance = case.rows[0].instance();
            let is_named = replay.trials.iter().any(|trial| named.contains(trial.as_str()));
            let is_drawn = drawn.contains(&(group, instance));
            ranked.push((!is_drawn, !is_named, replay));
        }
    }
    ranked.sort_by_key(|(undrawn, unnamed, _)| (*undrawn, *unnamed));
    Ok(ranked.into_iter().map(|(.., replay)| replay).collect())
}

/// The problems with traces kept under the interpretation that claims are judged under, in the order of groups and draws.
fn cases<'r>(run: &'r Run<'r>) -> Vec<Case<'r>> {
    let mut cases = Vec::new();
    for group in &run.study.groups {
        let mut problems: BTreeMap<_, Vec<&Row>> = BTreeMap::new();
        for contender in &run.study.contenders {
            for row in run.rows(&group.label, &contender.label) {
                let is_first = row.key.repeat == 0 && run.traces(&row.key).next().is_some();
                if is_first {
                    let key = (row.instance(), row.query().to_owned(), row.key.sweep.clone());
                    problems.entry(key).or_default().push(row);
                }
            }
        }
        cases.extend(problems.into_values().map(|rows| Case { run, group, rows }));
    }
    cases
}

fn replay(evidence: &Evidence<'_>, case: &Case<'_>, inputs: &Inputs) -> Result<Option<Replay>, PageError> {
    let searched = any_angle::scene(case).map(Shown::AnyAngle).or_else(|| grid::scene(case).map(Shown::Grid));
    let scene = match searched.or_else(|| plane::scene(case).map(Shown::Plane)) {
        Some(scene) => Some(scene),
        None => arm::scene(evidence, case, inputs)?.map(Shown::Arm),
    };
    let sweep = case.rows[0].key.sweep.values().iter();
    let sweep: Vec<String> = sweep.map(|(setting, value)| format!(", {setting} = {value}")).collect();
    let sweep = sweep.concat();
    let title = format!("{}: {}{sweep}", case.run.study.name, case.run.problem(case.rows[0]));
    let trials = case.rows.iter().map(|row| case.run.trial(row)).collect();
    Ok(scene.map(|scene| Replay { title, trials, scene }))
}

/// What became of a trial, in words.
fn outcome_text(row: &Row) -> String {
    let lengths = [("path_cost_cells", "cells"), ("path_length_cm", "cm"), ("path_length_mm", "mm")];
    let length = lengths.iter().find_map(|(column, unit)| Some(format!("{:.2} {unit}", row.value(column)?)));
    match (row.is_solved(), length) {
        (true, Some(length)) => length,
        _ => row.status.to_string().replace('_', " "),
    }
}
