//! The journal of a run: one line a finished unit, so that a killed run goes on where it stopped.
//!
//! The first line names what the run depends on. A later line is a checksum and a JSON object; reading stops at the
//! first line that is torn or damaged, and the file is cut there. It is where records wait for the end of the run: beyond
//! the first few megabytes they are on disk alone.

use super::traces::{GROUP_VALUES, sweep_of};
use super::write::Shape;
use crate::StudyError;
use crate::record::Batch;
use base::file::check_own;
use base::hash::sha256;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead as _, BufReader, ErrorKind, Read as _, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A journal that is open for writing.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    /// How long the file is.
    end: u64,
    /// Where each unit's line begins, and how long it is.
    lines: BTreeMap<usize, (u64, usize)>,
    /// Units whose records are in memory too.
    held: BTreeMap<usize, Batch>,
    /// How many more numbers may be kept in memory.
    room: usize,
    shape: Shape,
}

#[derive(Serialize)]
struct NewLine<'b> {
    unit: usize,
    batch: &'b Batch,
}

#[derive(Deserialize)]
struct Line {
    unit: usize,
    batch: Batch,
}

impl Journal {
    /// Where the journal of a run of `study` lies in `folder`.
    pub fn path(folder: &Path, study: &str) -> PathBuf {
        folder.join(format!("{study}.journal"))
    }

    /// Opens the journal at `path` for a run that depends on `key`, with the units it holds.
    ///
    /// A journal of another run is emptied: its units answer another question.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn open(path: &Path, key: &str) -> Result<Self, StudyError> {
        let io = |doing| StudyError::io(path, doing);
        let mut options = OpenOptions::new();
        options.create(true).read(true).write(true).truncate(false);
        let file = check_own(path).and_then(|()| options.open(path)).map_err(io("opening the journal"))?;
        let mut journal = Self::new(path.to_owned(), file);
        journal.read(key).map_err(io("reading the journal"))?;
        journal.file.set_len(journal.end).map_err(io("cutting the journal"))?;
        journal.file.seek(SeekFrom::End(0)).map_err(io("seeking in the journal"))?;
        if journal.end == 0 {
            journal.write(&format!("{key}\n"))?;
        }
        Ok(journal)
    }

    fn new(path: PathBuf, file: File) -> Self {
        let lines = BTreeMap::new();
        let held = BTreeMap::new();
        Self { path, file, end: 0, lines, held, room: GROUP_VALUES, shape: Shape::new(None) }
    }

    /// Finds the units of a journal for `key`, up to the first line that is not sound.
    fn read(&mut self, key: &str) -> io::Result<()> {
        let mut line = Vec::new();
        let mut reader = BufReader::new(self.file.try_clone()?);
        reader.read_until(b'\n', &mut line)?;
        if line != format!("{key}\n").as_bytes() {
            return Ok(());
        }
        self.end = line.len() as u64;
        loop {
            line.clear();
            reader.read_until(b'\n', &mut line)?;
            let Some(Line { unit, batch }) = parse(&line) else { return Ok(()) };
            self.lines.insert(unit, (self.end, line.len()));
            self.end += line.len() as u64;
            self.hold(unit, batch);
        }
    }

    /// Adds a finished unit.
    ///
    /// # Errors
    /// [`StudyError::Io`], for example when the disk is full; lines already written stay.
    pub fn append(&mut self, unit: usize, batch: Batch) -> Result<(), StudyError> {
        let json = serde_json::to_string(&NewLine { unit, batch: &batch })
            .expect("a batch holds nothing that JSON cannot");
        let begin = self.end;
        self.write(&format!("{} {json}\n", &sha256(json.as_bytes())[..16]))?;
        self.lines.insert(unit, (begin, (self.end - begin) as usize));
        self.hold(unit, batch);
        Ok(())
    }

    fn hold(&mut self, unit: usize, batch: Batch) {
        self.shape.sweep = self.shape.sweep.take().or_else(|| sweep_of(&batch.kept));
        self.shape.note(&batch.preprocessing);
        if let Some(room) = self.room.checked_sub(numbers(&batch)) {
            self.room = room;
            self.held.insert(unit, batch);
        }
    }

    /// The units that it holds.
    pub fn units(&self) -> impl ExactSizeIterator<Item = usize> {
        self.lines.keys().copied()
    }

    /// Whether it holds the unit.
    pub fn has(&self, unit: usize) -> bool {
        self.lines.contains_key(&unit)
    }

    /// What must be known of all of its records before the first is written.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Takes the records of a unit; none if it is not here.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn take(&mut self, unit: usize) -> Result<Option<Batch>, StudyError> {
        if let Some(batch) = self.held.remove(&unit) {
            return Ok(Some(batch));
        }
        let Some((begin, length)) = self.lines.get(&unit) else { return Ok(None) };
        let mut line = vec![0; *length];
        let read = self.file.seek(SeekFrom::Start(*begin)).and_then(|_| self.file.read_exact(&mut line));
        let parsed = read.and_then(|()| parse(&line).ok_or_else(|| ErrorKind::InvalidData.into()));
        let line = parsed.map_err(StudyError::io(&self.path, "reading the journal"))?;
        Ok(Some(line.batch))
    }

    /// Removes the journal: the run is over and its records are in place.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn remove(self) -> Result<(), StudyError> {
        drop(self.file);
        fs::remove_file(&self.path).map_err(StudyError::io(&self.path, "removing the journal"))
    }

    fn write(&mut self, line: &str) -> Result<(), StudyError> {
        self.file.write_all(line.as_bytes()).map_err(StudyError::io(&self.path, "writing the journal"))?;
        self.end += line.len() as u64;
        Ok(())
    }
}

/// About how many numbers a batch takes the room of.
fn numbers(batch: &Batch) -> usize {
    /// How many numbers take the room of a record's names.
    const NAMES: usize = 24;
    let rows =
        batch.rows.iter().map(|row| &row.values).chain(batch.preprocessing.iter().map(|row| &row.values));
    let traces = batch.kept.iter().map(|kept| kept.trace.values.len());
    rows.map(|values| NAMES + 3 * values.iter().count()).chain(traces).sum()
}

/// About how many units the journal of `study` in `folder` holds, without understanding it: a run may be at work on it.
pub fn journal_units(folder: &Path, study: &str) -> usize {
    let path = Journal::path(folder, study);
    let bytes = check_own(&path).and_then(|()| fs::read(path)).unwrap_or_default();
    bytes.split(|byte| *byte == b'\n').count().saturating_sub(2)
}

fn parse(line: &[u8]) -> Option<Line> {
    let line = str::from_utf8(line.strip_suffix(b"\n")?).ok()?;
    let (checksum, json) = line.split_once(' ')?;
    (sha256(json.as_bytes()).get(..16) == Some(checksum)).then(|| serde_json::from_str(json).ok())?
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::key::{InstanceKey, InterpretationKey, Owner, SweepKey};
    use crate::record::Kept;
    use engine::planner::Trace;

    fn batch(number: u32) -> Batch {
        let values = vec![f64::from(number) / 3.0, 0.1 + 0.2, f64::MIN_POSITIVE];
        let interpretation = InterpretationKey::new(vec![("corners".into(), "cut".into())]);
        let sweep = SweepKey::default();
        let owner = Owner::Instance(
            InstanceKey { group: "a".into(), sweep, instance: number, interpretation }.into(),
        );
        let trace = Trace { name: "path".to_owned(), width: 1, values };
        Batch { kept: vec![Kept { owner, trace }], ..Batch::default() }
    }

    fn taken(journal: &mut Journal, unit: usize) -> Option<Batch> {
        journal.take(unit).unwrap()
    }

    #[test]
    fn records_that_there_is_no_room_for_come_back_from_disk() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.journal");
        let mut journal = Journal::open(&path, "key").unwrap();
        journal.room = 7;
        for number in [0, 1, 2, 3] {
            journal.append(number as usize, batch(number)).unwrap();
        }
        assert_eq!(journal.held.len(), 2, "three numbers each, and room for seven");
        for number in [3, 0, 2, 1] {
            assert_eq!(taken(&mut journal, number as usize), Some(batch(number)));
        }
        assert_eq!(taken(&mut journal, 4), None);
        journal.remove().unwrap();
        assert!(!path.exists());
    }

    #[test]
    fn a_journal_cut_anywhere_gives_back_its_whole_lines_and_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.journal");
        let mut journal = Journal::open(&path, "key").unwrap();
        assert_eq!(journal.units().len(), 0);
        for number in 0..3 {
            journal.append(number as usize, batch(number)).unwrap();
        }
        let whole = fs::read(&path).unwrap();
        let mut counts = Vec::new();
        for cut in 0..=whole.len() {
            fs::write(&path, &whole[..cut]).unwrap();
            let mut journal = Journal::open(&path, "key").unwrap();
            let next = journal.units().len();
            assert!(
                (0..next).all(|unit| taken(&mut journal, unit) == Some(batch(unit as u32))),
                "cut at {cut}"
            );
            journal.append(next, batch(next as u32)).unwrap();
            assert_eq!(Journal::open(&path, "key").unwrap().units().len(), next + 1, "cut at {cut}");
            counts.push(next);
        }
        assert_eq!((counts[0], counts[whole.len()]), (0, 3));
    }

    #[test]
    fn a_journal_of_another_run_or_with_a_damaged_line_is_not_believed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.journal");
        let mut journal = Journal::open(&path, "key").unwrap();
        journal.append(0, batch(0)).unwrap();
        journal.append(1, batch(1)).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, text.replacen("\"unit\":1", "\"unit\":2", 1)).unwrap();
        assert_eq!(Journal::open(&path, "key").unwrap().units().collect::<Vec<_>>(), [0]);
        assert_eq!(Journal::open(&path, "another").unwrap().units().len(), 0);
    }
    #[test]
    fn a_full_disk_is_reported_with_the_journals_place() {
        let file = OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut journal = Journal::new(PathBuf::from("runs/a.journal"), file);
        let error = journal.append(0, batch(0)).unwrap_err().to_string();
        assert!(error.starts_with("runs/a.journal: writing the journal: No space left on device"), "{error}");
    }
}
