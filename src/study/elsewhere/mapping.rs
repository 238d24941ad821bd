//! Which columns of a table are keys and metrics.

use super::{Table, Trial};
use crate::column::{self, Kind};
use crate::error::StudyError;
use crate::key::{InstanceKey, InterpretationKey, SweepKey, TrialKey};
use crate::record::{Row, Status, Values};
use base::settings::{Document, SettingsError, none_called};
use engine::planner::Value;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// Columns of a table, and what they are to be.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mapping {
    /// The problem group of each row.
    group: Source,
    /// The column that tells instances of a group apart: a map, a seed, a number.
    instance: String,
    /// The contender of each row.
    contender: Source,
    /// The column that counts a contender's trials on one instance, from 0; `None` if there is one.
    repeat: Option<String>,
    /// How each row ended; `None` if every row was solved.
    status: Option<StatusColumn>,
    /// By column of our records, the column it is read from.
    #[serde(default)]
    metric: BTreeMap<String, MetricColumn>,
}

/// A text of each row.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, untagged)]
enum Source {
    /// The same in every row.
    Is {
        /// The text.
        is: String,
    },
    /// That of a column.
    Column {
        /// The column's head in the file.
        column: String,
        /// By text of the column, what it is called here; the same where it is not listed.
        #[serde(default)]
        called: BTreeMap<String, String>,
    },
}

/// How rows ended.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct StatusColumn {
    /// The column's head in the file.
    column: String,
    /// By status (`solved`, `no_path`, `time_spent`, …), the texts that mean it.
    means: BTreeMap<String, Vec<String>>,
}

/// A number of each row.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MetricColumn {
    /// The column's head in the file.
    column: String,
    /// By how much it is multiplied to give our unit; 1 if absent.
    #[serde(default = "one")]
    times: f64,
}

fn one() -> f64 {
    1.0
}

/// Texts that say that there is no number.
const UNKNOWN: [&str; 8] = ["", "nan", "-nan", "inf", "-inf", "null", "none", "na"];

impl Mapping {
    /// The mapping in the TOML file at `path`.
    ///
    /// # Errors
    /// What is wrong with it, at its place.
    pub fn read(path: &Path) -> Result<Self, SettingsError> {
        let document = Document::open(path)?;
        let mapping: Self = document.read()?;
        for metric in mapping.metric.keys() {
            if column::find(metric).is_none() {
                let known = column::COLUMNS.iter().map(|column| column.name);
                return Err(document
                    .error_at_key(&["metric", metric], none_called("column of records", metric, known)));
            }
        }
        let statuses = mapping.status.iter().flat_map(|status| status.means.keys());
        for name in statuses {
            if Status::find(name).is_none() {
                let known = Status::ALL.map(Status::name);
                return Err(
                    document.error_at_key(&["status", "means", name], none_called("status", name, known))
                );
            }
        }
        Ok(mapping)
    }

    /// The mapping of a benchmark log whose experiment is called `group`: times in seconds become `own_wall_ns`. The metrics of
    /// `more` are read besides.
    pub fn of_log(
        group: &str,
        statuses: BTreeMap<String, Vec<String>>,
        has: impl Fn(&str) -> bool,
        more: Option<Self>,
    ) -> Self {
        let usual = [
            ("own_wall_ns", "time", 1e9),
            ("iterations", "iterations", 1.0),
            ("samples", "graph states", 1.0),
        ];
        let own = usual.into_iter().filter(|(_, column, _)| has(column));
        let own = own.map(|(metric, column, times)| {
            (metric.to_owned(), MetricColumn { column: column.to_owned(), times })
        });
        Self {
            group: Source::Is { is: group.to_owned() },
            instance: "run".to_owned(),
            contender: Source::Column { column: "planner".to_owned(), called: BTreeMap::new() },
            repeat: None,
            status: Some(StatusColumn { column: "status".to_owned(), means: statuses }),
            metric: own.chain(more.into_iter().flat_map(|more| more.metric)).collect(),
        }
    }

    /// The trials in `table`, instances not numbered yet.
    pub(super) fn trials(&self, table: &Table) -> Result<Vec<Trial>, StudyError> {
        let [group, contender] = [&self.group, &self.contender].map(|source| source.reader(table));
        let (group, contender) = (group?, contender?);
        let instance = table.column(&self.instance)?;
        let repeat = self.repeat.as_ref().map(|head| table.column(head)).transpose()?;
        let status = self
            .status
            .as_ref()
            .map(|status| table.column(&status.column).map(|place| (place, status)))
            .transpose()?;
        let metrics = self.metric.iter().map(|(metric, from)| {
            let place = column::place(metric).expect("it was looked up when the mapping was read");
            Ok::<_, StudyError>((place, table.column(&from.column)?, from.times))
        });
        let metrics = metrics.collect::<Result<Vec<_>, _>>()?;
        let trial = |(line, cells): &(usize, Vec<String>)| {
            let wrong = |place: usize, message: String| {
                table.error(&format!("{}, column `{}`: {message}", table.place(*line), table.heads[place]))
            };
            let group = group(cells);
            let instance = cells[instance].clone();
            let contender = contender(cells);
            let names = [("group", &group), ("instance", &instance), ("contender", &contender)];
            if let Some((key, _)) = names.iter().find(|(_, name)| name.is_empty()) {
                return Err(table.error(&format!("{}: the {key} has no name", table.place(*line))));
            }
            let status = status.map_or(Ok(Status::Solved), |(place, status): (usize, &StatusColumn)| {
                status.status(&cells[place]).map_err(|message| wrong(place, message))
            })?;
            let mut values = Values::default();
            for (place, from, times) in &metrics {
                let number = number(&cells[*from]).map_err(|message| wrong(*from, message))?;
                let Some(number) = number else {
                    if self.status.is_none() {
                        return Err(wrong(
                            *from,
                            "holds no number; a `[status]` says which rows failed".to_owned(),
                        ));
                    }
                    continue;
                };
                values.put(*place, value(*place, number * times).map_err(|message| wrong(*from, message))?);
            }
            let repeat = repeat.map_or(Ok(0), |place| {
                cells[place]
                    .parse::<u32>()
                    .map_err(|_| wrong(place, format!("`{}` is no count from 0", cells[place])))
            })?;
            let on = Arc::new(InstanceKey {
                group: group.as_str().into(),
                sweep: SweepKey::default(),
                instance: 0,
                interpretation: InterpretationKey::default(),
            });
            let key = TrialKey {
                on,
                query: None,
                contender: contender.as_str().into(),
                sweep: SweepKey::default(),
                repeat,
            };
            let reason =
                (status != Status::Solved).then(|| "as its table says; recorded elsewhere".to_owned());
            Ok(Trial {
                line: *line,
                group,
                instance,
                contender,
                repeat,
                row: Row { key, seed: None, status, reason, values },
            })
        };
        table.rows.iter().map(trial).collect()
    }
}

impl Source {
    fn reader(&self, table: &Table) -> Result<Box<dyn Fn(&[String]) -> String + '_>, StudyError> {
        Ok(match self {
            Self::Is { is } => Box::new(move |_| is.clone()),
            Self::Column { column, called } => {
                let place = table.column(column)?;
                Box::new(move |cells| called.get(&cells[place]).unwrap_or(&cells[place]).clone())
            }
        })
    }
}

impl StatusColumn {
    fn status(&self, text: &str) -> Result<Status, String> {
        let found = self.means.iter().find(|(_, texts)| texts.iter().any(|known| known == text));
        found.and_then(|(name, _)| Status::find(name)).ok_or_else(|| {
            let known: Vec<&str> = self.means.values().flatten().map(String::as_str).collect();
            format!("`{text}` means no status; {} do", known.join(", "))
        })
    }
}

fn number(text: &str) -> Result<Option<f64>, String> {
    if UNKNOWN.contains(&text.to_lowercase().as_str()) {
        return Ok(None);
    }
    text.parse::<f64>()
        .ok()
        .filter(|number| number.is_finite())
        .map(Some)
        .ok_or_else(|| format!("`{text}` is no number"))
}

/// `number` as the column at `place` holds it.
fn value(place: u16, number: f64) -> Result<Value, String> {
    let column = &column::COLUMNS[usize::from(place)];
    match column.kind {
        Kind::Real => Ok(Value::Real(number)),
        Kind::Count if number >= 0.0 && number.fract() == 0.0 && number < 9e15 => {
            Ok(Value::Count(number as u64))
        }
        Kind::Count => Err(format!("{number} is no count, which `{}` holds", column.name)),
    }
}
