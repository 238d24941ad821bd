//! What a spec leaves out and what holds there, for the manifest: nobody has to look a default up to know what was run.

use super::checked::Study;
use super::spec::QuickSpec;
use base::settings::Settings;

/// Every default that `study` runs by, in the order of the spec: `contender `A*`, astar: ties = "fifo"`.
pub fn defaults(study: &Study) -> Vec<String> {
    let mut all = Vec::new();
    if study.quick == QuickSpec::default() {
        all.push(format!("quick: replicates = {}", study.quick.replicates));
    }
    let task = study.task_settings.clone().completed(study.task.settings);
    all.extend(said(&format!("task {}", study.task.name), &task));
    for group in &study.groups {
        all.extend(said(&format!("problem group `{}`, {}", group.label, group.family.name), &group.settings));
    }
    for contender in &study.contenders {
        for stage in &contender.stages {
            let whose = format!("contender `{}`, {}", contender.label, stage.entry.name);
            all.extend(said(&whose, &stage.settings));
        }
    }
    all
}

fn said(whose: &str, settings: &Settings) -> Vec<String> {
    settings.filled().map(|(key, value)| format!("{whose}: {key} = {value}")).collect()
}
