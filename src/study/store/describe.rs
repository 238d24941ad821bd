//! The meaning of each column of a file of records: name, unit and description, as the file itself carries them.

use crate::clock;
use crate::column;
use crate::key::KeyColumns;
use serde::{Deserialize, Serialize};

/// How columns of swept settings begin.
pub const SWEEP: &str = "sweep_";

/// How columns of choices begin.
pub const CHOICE: &str = "choice_";

/// The columns that name records and say how they came about; measured ones are those of [`column::COLUMNS`].
const KEYS: [(&str, Option<&str>, &str); 16] = [
    ("group", None, "label of the problem group"),
    ("instance", None, "which independent instance of the group, from 0: the unit of replication"),
    (
        "query",
        None,
        "query asked of the instance; null where an instance has one query only, and for a preprocessed object",
    ),
    ("contender", None, "label of the contender or of the variant; null for a preprocessed object"),
    (
        "repeat",
        None,
        "which of the contender's seeds, from 0; a variant has 0 and its findings count from 1; null for a preprocessed object",
    ),
    ("seed", None, "seed that the contender or the preprocessed object draws from"),
    (
        "status",
        None,
        "how the trial ended: solved, no_path, budget_spent, time_spent, rejected, invalid_problem or crashed",
    ),
    ("reason", None, "why it ended so; null if it is solved or built"),
    ("kind", None, "kind of preprocessed object"),
    ("name", None, "what the trace is, as figures ask for it"),
    ("width", None, "how many numbers make one point of the trace"),
    ("columns", None, "names of the numbers of a point, separated by commas; null where they are not named"),
    ("values", None, "numbers of the trace, point after point"),
    ("session", None, "session in which the clock was read, from 1; sessions are never pooled"),
    ("clock_repeat", None, "which choice of the clock in its session, from 0"),
    (clock::COLUMN, Some("ns"), clock::ABOUT),
];

/// What one column means.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Described {
    /// The column's name in the file.
    pub name: String,
    /// Its unit; none for what has none.
    pub unit: Option<String>,
    /// What it says.
    pub about: String,
}

/// What the column called `name` means in the records of a study with these keys; `None` if records have none such.
pub fn described(name: &str, keys: &KeyColumns) -> Option<Described> {
    let (unit, about) = meaning(name, keys)?;
    Some(Described { name: name.to_owned(), unit: unit.map(str::to_owned), about })
}

fn meaning(name: &str, keys: &KeyColumns) -> Option<(Option<&'static str>, String)> {
    if let Some((_, unit, about)) = KEYS.iter().find(|(key, ..)| *key == name) {
        return Some((*unit, (*about).to_owned()));
    }
    if let Some(column) = column::find(name) {
        return Some((column.unit(), column.about.to_owned()));
    }
    if let Some(setting) = name.strip_prefix(SWEEP) {
        if keys.posed.iter().any(|(key, _)| **key == *setting) {
            let about = format!(
                "value of the setting `{setting}` of the problem, which the study sweeps; null elsewhere"
            );
            return Some((None, about));
        }
        let (_, of) = keys.sweeps.iter().find(|(key, _)| **key == *setting)?;
        return Some((None, format!("value of the setting `{setting}` of `{of}`, which the study sweeps")));
    }
    let choice = name.strip_prefix(CHOICE)?;
    let is_read = keys.choices.iter().any(|id| **id == *choice);
    is_read.then(|| (None, format!("option taken of the choice `{choice}`")))
}
