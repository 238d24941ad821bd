//! Parquet files as records.
//!
//! A label that stands in many cells becomes one shared text: cells are numbered first, and keys are put together from the
//! numbers.

use super::describe::{CHOICE, SWEEP};
use crate::StudyError;
use crate::column::{self, Kind};
use crate::error::REMEDY;
use crate::key::{InstanceKey, InterpretationKey, Owner, SweepKey, SweepValue, Text, TrialKey};
use crate::parquet::FrameReader;
use crate::record::{Kept, PreprocessingRow, Row, Status, Timing, Values};
use engine::planner::{Trace, Value};
use polars::prelude::{AnyValue, Column, DataFrame, DataType, PolarsResult};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::panic::{self, AssertUnwindSafe, UnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Once};

/// Instances that several files of a study name.
#[derive(Default)]
pub struct Instances(BTreeMap<InstanceKey, Arc<InstanceKey>>);

impl Instances {
    fn shared(&mut self, key: InstanceKey) -> Arc<InstanceKey> {
        if let Some(known) = self.0.get(&key) {
            return known.clone();
        }
        let shared = Arc::new(key.clone());
        self.0.insert(key, shared.clone());
        shared
    }
}

/// Cells by number: equal cells have one number, and one value is kept of each.
struct Numbered<T> {
    numbers: Vec<usize>,
    values: Vec<T>,
}

impl<T: Ord + Clone> Numbered<T> {
    fn new(cells: impl Iterator<Item = T>) -> Self {
        let mut known = BTreeMap::new();
        let mut values = Vec::<T>::new();
        let mut numbers = Vec::new();
        // What came after each number the last time.
        let mut after: Vec<usize> = Vec::new();
        let mut last = 0;
        for cell in cells {
            // Rows follow each other in order: a cell mostly equals the one before, or goes on as it did when that stood last.
            if last < values.len() && values[last] == cell {
                numbers.push(last);
                continue;
            }
            let next = if last < after.len() { after[last] } else { last };
            let number = if next != last && values[next] == cell {
                next
            } else {
                *known.entry(cell.clone()).or_insert_with(|| {
                    values.push(cell);
                    after.push(values.len() - 1);
                    values.len() - 1
                })
            };
            after[last] = number;
            numbers.push(number);
            last = number;
        }
        Self { numbers, values }
    }

    fn map<U>(self, to: impl FnMut(T) -> U) -> Numbered<U> {
        Numbered { numbers: self.numbers, values: self.values.into_iter().map(to).collect() }
    }
}

impl<T: Clone> Numbered<T> {
    /// Each cell with that of `other` in the same row.
    fn with<U: Clone>(&self, other: &Numbered<U>) -> Numbered<(T, U)> {
        // A pair of numbers as one: a loop over these, which are cheap to compare, runs for every row of a file.
        let width = other.values.len();
        let pairs =
            Numbered::new(self.numbers.iter().zip(&other.numbers).map(|(one, two)| one * width + two));
        pairs.map(|pair| (self.values[pair / width].clone(), other.values[pair % width].clone()))
    }

    fn at(&self, row: usize) -> &T {
        &self.values[self.numbers[row]]
    }
}

/// A file that is not what was written.
pub fn touched(path: &Path, what: &str) -> StudyError {
    StudyError::Touched(format!("{}: {what}; {REMEDY}", path.display()))
}

/// The message about a file that polars cannot read.
pub const UNREADABLE: &str = "is no Parquet file that can be read";

/// The result of `read`; `None` if it panics. polars trusts the lengths in a file and panics at some wrong ones. The
/// caller reports that as an error, so the panic prints nothing on the terminal.
pub fn unpanicked<T>(read: impl FnOnce() -> T + UnwindSafe) -> Option<T> {
    static READING: AtomicUsize = AtomicUsize::new(0);
    static QUIET: Once = Once::new();
    QUIET.call_once(|| {
        let hook = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            // The standard library's own lines are where polars asks for a slice or a capacity that there is not.
            let is_theirs = |file: &str| file.contains("polars") || file.contains("/rustc/");
            let is_theirs = info.location().is_some_and(|at| is_theirs(at.file()));
            if READING.load(Ordering::SeqCst) == 0 || !is_theirs {
                hook(info);
            }
        }));
    });
    READING.fetch_add(1, Ordering::SeqCst);
    let done = catch_unwind(read);
    READING.fetch_sub(1, Ordering::SeqCst);
    done.ok()
}

/// A Parquet file that was opened.
pub struct Stored {
    path: PathBuf,
    frame: DataFrame,
}

impl Stored {
    /// The frame in `bytes`, read from `path`.
    pub fn open(path: PathBuf, bytes: Vec<u8>) -> Result<Self, StudyError> {
        Self::read_by(path, || FrameReader::open(Cursor::new(bytes))?.frame())
    }

    /// The frame that `read` reads from `path`.
    pub fn read_by(
        path: PathBuf,
        read: impl FnOnce() -> PolarsResult<DataFrame> + UnwindSafe,
    ) -> Result<Self, StudyError> {
        match unpanicked(|| read().ok()).flatten() {
            Some(frame) => Ok(Self { path, frame }),
            None => Err(touched(&path, UNREADABLE)),
        }
    }

    /// What `made` makes of the frame: polars reads some of a file only when a cell is wanted.
    pub fn guarded<T>(&self, made: impl FnOnce(&Self) -> Result<T, StudyError>) -> Result<T, StudyError> {
        // Nothing that is left half-done by a panic is used again: the error ends the interpretation of the whole run.
        unpanicked(AssertUnwindSafe(|| made(self))).unwrap_or_else(|| Err(touched(&self.path, UNREADABLE)))
    }

    fn column(&self, name: &str) -> Result<&Column, StudyError> {
        self.frame.column(name).map_err(|_| touched(&self.path, &format!("has no column `{name}`")))
    }

    /// Whether some cell of the column called `name` is known.
    pub fn has_some(&self, name: &str) -> Result<bool, StudyError> {
        Ok(self.column(name)?.null_count() < self.frame.height())
    }

    fn wrong(&self, name: &str) -> StudyError {
        touched(&self.path, &format!("column `{name}` does not hold what it should"))
    }

    fn texts(&self, name: &str) -> Result<Numbered<Option<Text>>, StudyError> {
        let texts = self.column(name)?.str().map_err(|_| self.wrong(name))?;
        Ok(Numbered::new(texts.iter()).map(|text| text.map(Text::from)))
    }

    fn full_texts(&self, name: &str) -> Result<Numbered<Text>, StudyError> {
        let Numbered { numbers, values } = self.texts(name)?;
        let values = values.into_iter().map(|text| text.ok_or_else(|| self.wrong(name)));
        Ok(Numbered { numbers, values: values.collect::<Result<_, _>>()? })
    }

    fn maybe_wholes(&self, name: &str) -> Result<Vec<Option<u64>>, StudyError> {
        Ok(self.column(name)?.u64().map_err(|_| self.wrong(name))?.iter().collect())
    }

    fn wholes(&self, name: &str) -> Result<Vec<u64>, StudyError> {
        self.maybe_wholes(name)?.into_iter().map(|count| count.ok_or_else(|| self.wrong(name))).collect()
    }

    /// The columns whose names begin with `prefix`, without it.
    fn named<'a>(&'a self, prefix: &'a str) -> impl Iterator<Item = (&'a str, &'a Column)> {
        let columns = self.frame.columns().iter();
        columns.filter_map(move |column| Some((column.name().strip_prefix(prefix)?, column)))
    }

    fn values(&self) -> Result<Vec<Values>, StudyError> {
        let is_filled = |column: &column::Column| self.frame.column(column.name).is_ok();
        let filled = column::COLUMNS.iter().filter(|column| is_filled(column)).count();
        let mut rows: Vec<Values> = (0..self.frame.height()).map(|_| Values::with_capacity(filled)).collect();
        for (column, place) in column::COLUMNS.iter().zip(0..).filter(|(column, _)| is_filled(column)) {
            let stored = self.column(column.name)?;
            match column.kind {
                Kind::Count => {
                    let cells = stored.u64().map_err(|_| self.wrong(column.name))?;
                    fill(&mut rows, place, cells.iter().map(|cell| cell.map(Value::Count)));
                }
                Kind::Real => {
                    let cells = stored.f64().map_err(|_| self.wrong(column.name))?;
                    fill(&mut rows, place, cells.iter().map(|cell| cell.map(Value::Real)));
                }
            }
        }
        Ok(rows)
    }

    /// What names each row's instance.
    fn instances(&self, instances: &mut Instances) -> Result<Numbered<Arc<InstanceKey>>, StudyError> {
        let mut interpretations =
            Numbered { numbers: vec![0; self.frame.height()], values: vec![Vec::new()] };
        for (id, column) in self.named(CHOICE) {
            let id = Text::from(id);
            let options = self.full_texts(column.name())?;
            interpretations = interpretations.with(&options).map(|(mut interpretation, option)| {
                interpretation.push((id.clone(), option));
                interpretation
            });
        }
        let interpretations = interpretations.map(InterpretationKey::new);
        let numbers = Numbered::new(self.wholes("instance")?.into_iter());
        // Sweeps over settings of the problem stand before the instance's number.
        let posed = self.frame.columns().iter().take_while(|column| *column.name() != "instance");
        let swept =
            self.sweeps(posed.filter_map(|column| Some((column.name().strip_prefix(SWEEP)?, column))))?;
        let keys = self.full_texts("group")?.with(&swept).with(&numbers).with(&interpretations);
        Ok(keys.map(|(((group, sweep), instance), interpretation)| {
            instances.shared(InstanceKey { group, sweep, instance: instance as u32, interpretation })
        }))
    }

    /// The values of every row's sweeps that stand in these columns.
    fn sweeps<'c>(
        &self,
        columns: impl Iterator<Item = (&'c str, &'c Column)>,
    ) -> Result<Numbered<SweepKey>, StudyError> {
        let mut sweeps = Numbered { numbers: vec![0; self.frame.height()], values: vec![Vec::new()] };
        for (setting, column) in columns {
            let setting = Text::from(setting);
            sweeps = sweeps.with(&self.sweep(column)?).map(|(mut sweep, value)| {
                sweep.extend(value.map(|value| (setting.clone(), value)));
                sweep
            });
        }
        Ok(sweeps.map(SweepKey::new))
    }

    fn sweep(&self, column: &Column) -> Result<Numbered<Option<SweepValue>>, StudyError> {
        let wrong = |_| self.wrong(column.name());
        Ok(match column.dtype() {
            DataType::Boolean => {
                let cells = column.bool().map_err(wrong)?;
                Numbered::new(cells.iter().map(|cell| cell.map(SweepValue::Flag)))
            }
            DataType::Int64 => {
                let cells = column.i64().map_err(wrong)?;
                Numbered::new(cells.iter().map(|cell| cell.map(SweepValue::Whole)))
            }
            DataType::Float64 => {
                let cells = column.f64().map_err(wrong)?;
                Numbered::new(cells.iter().map(|cell| cell.map(SweepValue::Real)))
            }
            _ => self.texts(column.name())?.map(|text| text.map(SweepValue::Text)),
        })
    }

    /// What names each row, a trial or the preprocessed object itself.
    pub fn owners(&self, instances: &mut Instances) -> Result<Vec<Owner>, StudyError> {
        let on = self.instances(instances)?;
        let sweep = self.sweeps(self.named(SWEEP))?;
        let query = self.texts("query")?;
        let contender = self.texts("contender")?;
        let repeat = self.maybe_wholes("repeat")?;
        let owner = |row: usize| {
            let on = on.at(row).clone();
            let Some(contender) = contender.at(row).clone() else { return Ok(Owner::Instance(on)) };
            let repeat = repeat[row].ok_or_else(|| self.wrong("repeat"))? as u32;
            let query = query.at(row).clone();
            let sweep = sweep.at(row).clone();
            Ok(Owner::Trial(TrialKey { on, query, contender, sweep, repeat }))
        };
        (0..self.frame.height()).map(owner).collect()
    }

    fn trial_keys(&self, instances: &mut Instances) -> Result<Vec<TrialKey>, StudyError> {
        let owners = self.owners(instances)?.into_iter();
        let trial = |owner| match owner {
            Owner::Trial(key) => Ok(key),
            Owner::Instance(_) => Err(self.wrong("contender")),
        };
        owners.map(trial).collect()
    }

    /// The frame as comma-separated values under a head; what is unknown is empty. Lists of numbers are left out.
    pub fn csv(&self) -> String {
        let columns =
            self.frame.columns().iter().filter(|column| !matches!(column.dtype(), DataType::List(_)));
        let columns: Vec<&Column> = columns.collect();
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        let mut text = line(columns.iter().map(|column| quoted(column.name())).collect());
        for row in 0..self.frame.height() {
            let cell = |column: &&Column| column.get(row).map_or_else(|_| String::new(), |cell| shown(&cell));
            text += &line(columns.iter().map(cell).collect());
        }
        text
    }

    /// The frame as trials.
    pub fn trials(&self, instances: &mut Instances) -> Result<Vec<Row>, StudyError> {
        let keys = self.trial_keys(instances)?;
        let reason = self.texts("reason")?;
        let seed = self.maybe_wholes("seed")?;
        let Numbered { numbers, values } = self.full_texts("status")?;
        let values = values.iter().map(|name| Status::find(name).ok_or_else(|| self.wrong("status")));
        let status = Numbered { numbers, values: values.collect::<Result<Vec<_>, _>>()? };
        let rows = keys.into_iter().zip(self.values()?).enumerate();
        let row = |(row, (key, values))| Row {
            key,
            seed: seed[row],
            status: *status.at(row),
            reason: reason.at(row).as_deref().map(str::to_owned),
            values,
        };
        Ok(rows.map(row).collect())
    }

    /// The frame as preprocessed objects.
    pub fn preprocessing(&self, instances: &mut Instances) -> Result<Vec<PreprocessingRow>, StudyError> {
        let keys = self.instances(instances)?;
        let kind = self.full_texts("kind")?;
        let reason = self.texts("reason")?;
        let seed = self.wholes("seed")?;
        let row = |(row, values)| PreprocessingRow {
            key: keys.at(row).clone(),
            kind: kind.at(row).as_ref().to_owned(),
            seed: seed[row],
            reason: reason.at(row).as_deref().map(str::to_owned),
            values,
        };
        Ok(self.values()?.into_iter().enumerate().map(row).collect())
    }

    /// The frame as traces.
    pub fn traces(&self, instances: &mut Instances) -> Result<Vec<Kept>, StudyError> {
        let owners = self.owners(instances)?;
        let name = self.full_texts("name")?;
        let width = self.wholes("width")?;
        let lists = self.column("values")?.list().map_err(|_| self.wrong("values"))?.clone();
        let mut kept = Vec::new();
        for (row, owner) in owners.into_iter().enumerate() {
            let list = lists.get_as_series(row).ok_or_else(|| self.wrong("values"))?;
            let values = list.f64().map_err(|_| self.wrong("values"))?.into_no_null_iter().collect();
            let trace = Trace { name: name.at(row).as_ref().to_owned(), width: width[row] as usize, values };
            kept.push(Kept { owner, trace });
        }
        Ok(kept)
    }

    /// The frame as times.
    pub fn times(&self, instances: &mut Instances) -> Result<Vec<Timing>, StudyError> {
        let keys = self.trial_keys(instances)?;
        let session = self.wholes("session")?;
        let clock_repeat = self.wholes("clock_repeat")?;
        let plan_wall_ns = self.wholes("plan_wall_ns")?;
        let row = |(row, trial)| Timing {
            trial,
            session: session[row] as u32,
            clock_repeat: clock_repeat[row] as u32,
            plan_wall_ns: plan_wall_ns[row],
        };
        Ok(keys.into_iter().enumerate().map(row).collect())
    }
}

/// A cell of a file of comma-separated values: numbers with all of their digits.
fn shown(cell: &AnyValue<'_>) -> String {
    match cell {
        AnyValue::Null => String::new(),
        AnyValue::String(text) => quoted(text),
        AnyValue::StringOwned(text) => quoted(text),
        AnyValue::Float64(real) => real.to_string(),
        other => other.to_string(),
    }
}

/// `text` as a cell of a file of comma-separated values, in quotes where it needs them. An apostrophe stands before each sign by
/// which a spreadsheet knows a formula: at the start, and behind what spreadsheets of other countries take for the end of a cell.
///
/// # Source
/// OWASP, *CSV Injection*, for the signs.
pub fn quoted(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    let mut begins = true;
    for sign in text.chars() {
        if begins && "=+-@\t\r＝＋－＠".contains(sign) {
            safe.push('\'');
        }
        begins = ";\t\r\n".contains(sign) || (begins && sign == '"');
        safe.push(sign);
    }
    if safe.contains([',', '"', '\n', '\r']) { format!("\"{}\"", safe.replace('"', "\"\"")) } else { safe }
}

fn fill(rows: &mut [Values], place: u16, cells: impl Iterator<Item = Option<Value>>) {
    for (row, cell) in rows.iter_mut().zip(cells) {
        if let Some(value) = cell {
            row.put(place, value);
        }
    }
}
