//! The database that Planner Arena reads.
//!
//! # Source
//! OMPL, `scripts/ompl_benchmark_statistics.py`, `readBenchmarkLog`: the tables and their columns.

use crate::benchmark::{Experiment, PlannerRuns, Property, STATUSES};
use rusqlite::{Connection, MAIN_DB, Result, ToSql, params, params_from_iter};
use std::collections::BTreeSet;

const TABLES: &str = "
CREATE TABLE experiments (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512), totaltime REAL, timelimit REAL,
  memorylimit REAL, runcount INTEGER, version VARCHAR(128), hostname VARCHAR(1024), cpuinfo TEXT, date DATETIME,
  seed VARCHAR(24), setup TEXT);
CREATE TABLE plannerConfigs (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512) NOT NULL, settings TEXT);
CREATE TABLE enums (name VARCHAR(512), value INTEGER, description TEXT, PRIMARY KEY (name, value));
CREATE TABLE runs (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, plannerid INTEGER,
  FOREIGN KEY (experimentid) REFERENCES experiments(id) ON DELETE CASCADE,
  FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE);
CREATE TABLE progress (runid INTEGER, time REAL, PRIMARY KEY (runid, time),
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
";

/// The bytes of a database with these experiments.
///
/// # Errors
/// What the database refuses.
pub fn database(experiments: &[Experiment]) -> Result<Vec<u8>> {
    let mut connection = Connection::open_in_memory()?;
    connection.execute_batch(TABLES)?;
    let planners = || experiments.iter().flat_map(|experiment| &experiment.planners);
    let properties: BTreeSet<&Property> = planners().flat_map(|planner| &planner.properties).collect();
    for Property { name, kind } in properties {
        connection.execute(&format!("ALTER TABLE runs ADD \"{name}\" {kind}"), [])?;
    }
    let transaction = connection.transaction()?;
    for (value, description) in STATUSES.iter().enumerate() {
        transaction
            .execute("INSERT INTO enums VALUES ('status', ?, ?)", params![value as i64, description])?;
    }
    for experiment in experiments {
        transaction.execute(
            "INSERT INTO experiments VALUES (NULL, ?, 0, 0, 0, ?, ?, 'unknown', ?, 'unknown', ?, ?)",
            params![
                experiment.name,
                experiment.most_runs() as i64,
                concat!("replan ", env!("CARGO_PKG_VERSION")),
                experiment.cpu,
                experiment.seed.to_string(),
                experiment.setup
            ],
        )?;
        let id = transaction.last_insert_rowid();
        for planner in &experiment.planners {
            add_runs(&transaction, id, planner)?;
        }
    }
    transaction.commit()?;
    connection.serialize(MAIN_DB).map(|data| data.to_vec())
}

/// Adds the runs of a planner, which is one of its name in all experiments.
fn add_runs(connection: &Connection, experiment: i64, planner: &PlannerRuns) -> Result<()> {
    let name = &planner.name;
    let known =
        connection.query_row("SELECT id FROM plannerConfigs WHERE name = ?", [name], |row| row.get(0));
    let id: i64 = match known {
        Err(rusqlite::Error::QueryReturnedNoRows) => {
            connection.execute("INSERT INTO plannerConfigs VALUES (NULL, ?, '')", [name])?;
            connection.last_insert_rowid()
        }
        other => other?,
    };
    let names = planner.properties.iter().map(|property| property.name.as_str());
    let columns = names.flat_map(|name| [", \"", name, "\""]).collect::<String>();
    let places = ", ?".repeat(planner.properties.len());
    let insert =
        format!("INSERT INTO runs (experimentid, plannerid{columns}) VALUES ({experiment}, {id}{places})");
    let mut insert = connection.prepare(&insert)?;
    for run in &planner.runs {
        let cells = planner.properties.iter().zip(run).map(|(property, value)| cell(property, *value));
        insert.execute(params_from_iter(cells))?;
    }
    Ok(())
}

/// A count as a whole number, so that readers see no `12.0`.
fn cell(property: &Property, value: Option<f64>) -> Box<dyn ToSql> {
    match value {
        Some(value) if property.kind != "REAL" => Box::new(value as i64),
        other => Box::new(other),
    }
}
