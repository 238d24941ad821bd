//! The journal of a run: one line a finished unit, so that a killed run goes on where it stopped.
//!
//! The first line names what the run depends on. A later line is a checksum and a JSON object; reading stops at the
//! first line that is torn or damaged, and the file is cut there.

use crate::study::StudyError;
use crate::study::record::Batch;
use base::hash::sha256;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A journal that is open for writing.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
}

#[derive(Serialize, Deserialize)]
struct Line {
    unit: usize,
    batch: Batch,
}

impl Journal {
    /// Where the journal of a run of `study` lies in `folder`.
    pub fn path(folder: &Path, study: &str) -> PathBuf {
        folder.join(format!("{study}.journal"))
    }

    /// Opens the journal at `path` for a run that depends on `key`, and returns the units it holds.
    ///
    /// A journal of another run is emptied: its units answer another question.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn open(path: &Path, key: &str) -> Result<(Self, BTreeMap<usize, Batch>), StudyError> {
        let io = |doing| StudyError::io(path, doing);
        let text = fs::read(path).unwrap_or_default();
        let (kept_bytes, units) = read(&text, key);
        let options = OpenOptions::new().create(true).write(true).truncate(false).open(path);
        let mut file = options.map_err(io("opening the journal"))?;
        file.set_len(kept_bytes as u64).map_err(io("cutting the journal"))?;
        file.seek(SeekFrom::End(0)).map_err(io("seeking in the journal"))?;
        let mut journal = Self { path: path.to_owned(), file };
        if kept_bytes == 0 {
            journal.write(&format!("{key}\n"))?;
        }
        Ok((journal, units))
    }

    /// Adds a finished unit.
    ///
    /// # Errors
    /// [`StudyError::Io`], for example when the disk is full; lines already written stay.
    pub fn append(&mut self, unit: usize, batch: &Batch) -> Result<(), StudyError> {
        let json = serde_json::to_string(&Line { unit, batch: batch.clone() })
            .expect("a batch holds nothing that JSON cannot");
        self.write(&format!("{} {json}\n", &sha256(json.as_bytes())[..16]))
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
        self.file.write_all(line.as_bytes()).map_err(StudyError::io(&self.path, "writing the journal"))
    }
}

/// About how many units the journal of `study` in `folder` holds, without understanding it: a run may be at work on it.
pub fn journal_units(folder: &Path, study: &str) -> usize {
    let bytes = fs::read(Journal::path(folder, study)).unwrap_or_default();
    bytes.split(|byte| *byte == b'\n').count().saturating_sub(2)
}

/// The units in `text` if it is a journal for `key`, and how many of its bytes are sound.
fn read(text: &[u8], key: &str) -> (usize, BTreeMap<usize, Batch>) {
    let mut units = BTreeMap::new();
    let mut lines = text.split_inclusive(|byte| *byte == b'\n');
    let header = lines.next().unwrap_or_default();
    if header != format!("{key}\n").as_bytes() {
        return (0, units);
    }
    let mut sound = header.len();
    for line in lines {
        let Some(Line { unit, batch }) = parse(line) else { break };
        units.insert(unit, batch);
        sound += line.len();
    }
    (sound, units)
}

fn parse(line: &[u8]) -> Option<Line> {
    let line = str::from_utf8(line.strip_suffix(b"\n")?).ok()?;
    let (checksum, json) = line.split_once(' ')?;
    (sha256(json.as_bytes()).get(..16) == Some(checksum)).then(|| serde_json::from_str(json).ok())?
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::key::{DrawKey, Owner, ReadingKey};
    use crate::study::record::Kept;
    use engine::planner::Exhibit;

    fn batch(number: u32) -> Batch {
        let values = vec![f64::from(number) / 3.0, 0.1 + 0.2, f64::MIN_POSITIVE];
        let reading = ReadingKey::new(vec![("corners".into(), "cut".into())]);
        let of = Owner::Draw(DrawKey { group: "a".into(), draw: number, reading }.into());
        let exhibit = Exhibit { name: "path".to_owned(), width: 1, values };
        Batch { kept: vec![Kept { of, exhibit }], ..Batch::default() }
    }

    #[test]
    fn a_journal_cut_anywhere_gives_back_its_whole_lines_and_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.journal");
        let (mut journal, units) = Journal::open(&path, "key").unwrap();
        assert!(units.is_empty());
        for number in 0..3 {
            journal.append(number as usize, &batch(number)).unwrap();
        }
        let whole = fs::read(&path).unwrap();
        let mut counts = Vec::new();
        for cut in 0..=whole.len() {
            fs::write(&path, &whole[..cut]).unwrap();
            let (mut journal, units) = Journal::open(&path, "key").unwrap();
            assert!(units.iter().all(|(unit, found)| *found == batch(*unit as u32)), "cut at {cut}");
            let next = units.len();
            journal.append(next, &batch(next as u32)).unwrap();
            assert_eq!(Journal::open(&path, "key").unwrap().1.len(), next + 1, "cut at {cut}");
            counts.push(next);
        }
        assert_eq!((counts[0], counts[whole.len()]), (0, 3));
    }

    #[test]
    fn a_journal_of_another_run_or_with_a_damaged_line_is_not_believed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.journal");
        let (mut journal, _) = Journal::open(&path, "key").unwrap();
        journal.append(0, &batch(0)).unwrap();
        journal.append(1, &batch(1)).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, text.replacen("\"unit\":1", "\"unit\":2", 1)).unwrap();
        assert_eq!(Journal::open(&path, "key").unwrap().1.keys().collect::<Vec<_>>(), [&0]);
        assert!(Journal::open(&path, "another").unwrap().1.is_empty());
    }
    #[test]
    fn a_full_disk_is_told_with_the_journals_place() {
        let file = OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut journal = Journal { path: PathBuf::from("runs/a.journal"), file };
        let error = journal.append(0, &batch(0)).unwrap_err().to_string();
        assert!(error.starts_with("runs/a.journal: writing the journal: No space left on device"), "{error}");
    }
}
