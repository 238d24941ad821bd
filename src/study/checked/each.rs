//! Problem groups that stand for one group a file: a folder of maps in one line.

use super::super::inputs::Inputs;
use super::super::spec::ProblemsSpec;
use base::settings::{Document, Faults};
use std::path::Path;
use toml::{Table, Value};

/// What stands in a group's settings for the file.
const FILE: &str = "{file}";

/// The groups of a study, each that names files with `each` in as many as there are files.
pub(super) fn expanded(
    problems: Vec<ProblemsSpec>,
    document: &Document,
    inputs: &Inputs,
    faults: &mut Faults,
) -> Vec<ProblemsSpec> {
    let mut all = Vec::new();
    for (place, mut group) in problems.into_iter().enumerate() {
        let Some(pattern) = group.each.take_if(|_| group.like.is_none()) else {
            all.push(ProblemsSpec { place, ..group });
            continue;
        };
        match inputs.list(pattern.get_ref()) {
            Ok(files) => all.extend(files.iter().map(|file| of_file(&group, place, file))),
            Err(message) => faults.add(document.error(pattern.span(), message)),
        }
    }
    all
}

/// The group of one file, whose name its label ends in.
fn of_file(group: &ProblemsSpec, place: usize, file: &str) -> ProblemsSpec {
    let stem = Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
    let label = format!("{} {stem}", group.label.get_ref());
    ProblemsSpec {
        label: group.label.with(label),
        family: group.family.clone(),
        like: None,
        each: None,
        instances: group.instances,
        shared_instances: group.shared_instances.clone(),
        stage: group.stage.clone(),
        file: Some(file.to_owned()),
        place,
        settings: group.settings.clone(),
    }
}

/// `table` with the path of the file where it belongs.
pub(super) fn filled(table: &Table, file: &str) -> Table {
    let value = |value: &Value| match value {
        Value::String(text) => Value::String(text.replace(FILE, file)),
        Value::Table(inner) => Value::Table(filled(inner, file)),
        other => other.clone(),
    };
    table.iter().map(|(key, inner)| (key.clone(), value(inner))).collect()
}
