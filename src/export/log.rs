//! OMPL's benchmark log, as `ompl_benchmark_statistics.py` reads it.
//!
//! # Source
//! OMPL, `src/ompl/tools/benchmark/src/Benchmark.cpp`, `saveResultsToStream`.

use crate::benchmark::{Experiment, PlannerRuns, STATUSES};

/// The log of one experiment. Limits of time and memory are 0, since trials have a budget of expansions instead.
pub fn text(experiment: &Experiment) -> String {
    let version = env!("CARGO_PKG_VERSION");
    // The readers take the last word of this line for the name.
    let name = experiment.name.replace(' ', "_");
    let mut text =
        format!("replan version {version}\nExperiment {name}\nRunning on unknown\nStarting at unknown\n");
    text += &format!("<<<|\n{}|>>>\n<<<|\n{}\n|>>>\n", experiment.setup, experiment.cpu);
    text += &format!("{} is the random seed\n0 seconds per run\n0 MB per run\n", experiment.seed);
    text += &format!("{} runs per planner\n0 seconds spent to collect the data\n", experiment.most_runs());
    text += &format!("1 enum type\nstatus|{}\n", STATUSES.join("|"));
    text += &format!("{} planners\n", experiment.planners.len());
    text + &experiment.planners.iter().map(planner).collect::<String>()
}

fn planner(planner: &PlannerRuns) -> String {
    let properties =
        planner.properties.iter().map(|property| format!("{} {}\n", property.name, property.kind));
    let cell = |value: &Option<f64>| value.map_or_else(String::new, |value| value.to_string()) + "; ";
    let run = |values: &Vec<Option<f64>>| values.iter().map(cell).collect::<String>() + "\n";
    format!(
        "{}\n0 common properties\n{} properties for each run\n{}{} runs\n{}.\n",
        planner.name,
        planner.properties.len(),
        properties.collect::<String>(),
        planner.runs.len(),
        planner.runs.iter().map(run).collect::<String>()
    )
}
