//! The defaults of everything that a spec leaves out, for the manifest: nobody has to look one up to know what was run.

use super::checked::Study;
use base::settings::Settings;
use toml::{Table, Value};

/// Every default that `study` runs by, in the order of the spec: `contender `A*`, astar: ties = "fifo"`.
pub fn defaults(study: &Study) -> Vec<String> {
    let mut all = study.of_paper.clone();
    let spec: Table = study.document.read_stored().unwrap_or_default();
    if spec.get("quick").is_none_or(|quick| quick.get("instances").is_none()) {
        all.push(format!("quick: instances = {}", study.quick.instances));
    }
    // What is like another may have its number from there.
    let instances =
        |label: &str| study.groups.iter().any(|group| group.label == label && group.instances > 1);
    let repeats = |label: &str| study.contenders.iter().any(|own| own.label == label && own.repeats > 1);
    let several: [&dyn Fn(&str) -> bool; 2] = [&instances, &repeats];
    let counted = [("problems", "problem group", "instances"), ("contender", "contender", "repeats")];
    for ((table, what, key), are_several) in counted.into_iter().zip(several) {
        let entries = spec.get(table).and_then(Value::as_array).into_iter().flatten();
        let without = entries.filter(|entry| entry.get(key).is_none());
        let labels = without.filter_map(|entry| entry.get("label")?.as_str());
        let labels = labels.filter(|label| !are_several(label));
        all.extend(labels.map(|label| format!("{what} `{label}`: {key} = 1")));
    }
    let task = study.task_settings.clone().completed(study.task.settings);
    all.extend(filled(&format!("task {}", study.task.name), &task));
    for group in &study.groups {
        let is_swept =
            |key: &str| study.sweeps.iter().any(|sweep| sweep.key == key && sweep.is_over(&group.label));
        let filled = group.settings.filled().filter(|(key, _)| !is_swept(key));
        let whose = format!("problem group `{}`, {}", group.label, group.family.name);
        all.extend(filled.map(|(key, value)| format!("{whose}: {key} = {value}")));
    }
    for contender in &study.contenders {
        for stage in &contender.stages {
            let whose = format!("contender `{}`, {}", contender.label, stage.entry.name);
            all.extend(filled(&whose, &stage.settings));
        }
    }
    all
}

fn filled(whose: &str, settings: &Settings) -> Vec<String> {
    settings.filled().map(|(key, value)| format!("{whose}: {key} = {value}")).collect()
}
