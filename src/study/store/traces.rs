//! Traces on disk, written and read group by group: whoever puts parts together holds one group of each at a time.

use super::Traces;
use super::read::{Instances, Stored, UNREADABLE, touched, unpanicked};
use crate::StudyError;
use crate::key::{Owner, SweepKey};
use crate::parquet::FrameReader;
use crate::record::{Kept, Row};
use std::collections::VecDeque;
use std::fs::File;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// How many numbers a group holds, but for a trace that has more: 16 MB.
pub const GROUP_VALUES: usize = 1 << 21;

/// The sweep of the first trace that belongs to a trial.
pub fn sweep_of(kept: &[Kept]) -> Option<SweepKey> {
    kept.iter().find_map(|kept| match &kept.owner {
        Owner::Trial(key) => Some(key.sweep.clone()),
        Owner::Instance(_) => None,
    })
}

/// How many traces each group of the file at `path` has.
///
/// # Errors
/// [`StudyError::Touched`].
pub fn groups(path: &Path) -> Result<Vec<usize>, StudyError> {
    let file = File::open(path).map_err(StudyError::io(path, "opening the file"))?;
    let groups = unpanicked(|| FrameReader::open(file).ok().map(|file| file.groups().collect()));
    groups.flatten().ok_or_else(|| touched(path, UNREADABLE))
}

/// The traces in a group of the file at `path`.
///
/// # Errors
/// [`StudyError::Touched`].
pub fn read_group(path: &Path, group: usize, instances: &mut Instances) -> Result<Vec<Kept>, StudyError> {
    let file = File::open(path).map_err(StudyError::io(path, "opening the file"))?;
    let read = || FrameReader::open(file)?.group(group);
    Stored::read_by(path.to_owned(), read)?.guarded(|file| file.traces(instances))
}

/// A file of traces that is read from its beginning, one group at a time.
pub struct TraceReader {
    path: PathBuf,
    /// The groups that were not read yet.
    groups: Range<usize>,
    read: VecDeque<Kept>,
    instances: Instances,
}

impl TraceReader {
    /// The traces at `path`, a file that was found to be the one its manifest names.
    ///
    /// # Errors
    /// [`StudyError::Stored`].
    pub fn open(path: &Path) -> Result<Self, StudyError> {
        let groups = 0..groups(path)?.len();
        let path = path.to_owned();
        let read = VecDeque::new();
        let instances = Instances::default();
        Ok(Self { path, groups, read, instances })
    }

    /// The next trace, without taking it.
    ///
    /// # Errors
    /// [`StudyError::Stored`].
    pub fn peek(&mut self) -> Result<Option<&Kept>, StudyError> {
        while self.read.is_empty()
            && let Some(group) = self.groups.next()
        {
            self.read = read_group(&self.path, group, &mut self.instances)?.into();
        }
        Ok(self.read.front())
    }

    /// Takes what [`peek`](Self::peek) has shown.
    pub fn take(&mut self) -> Option<Kept> {
        self.read.pop_front()
    }

    /// Takes the next trace.
    ///
    /// # Errors
    /// [`StudyError::Stored`].
    pub fn next_one(&mut self) -> Result<Option<Kept>, StudyError> {
        self.peek()?;
        Ok(self.take())
    }

    /// All that it has left, on their way to another file of the study with these rows.
    ///
    /// # Errors
    /// [`StudyError::Stored`].
    pub fn all(mut self, rows: &[Row]) -> Result<Traces<'static>, StudyError> {
        let sweep = if self.has_trials()? { rows.first().map(|row| row.key.sweep.clone()) } else { None };
        let each = std::iter::from_fn(move || self.next_one().transpose());
        Ok(Traces { each: Box::new(each), sweep, group_values: GROUP_VALUES })
    }

    /// The error about faulty contents.
    pub fn wrong(&self, reason: &str) -> StudyError {
        touched(&self.path, reason)
    }

    /// Whether any of them belongs to a trial.
    ///
    /// # Errors
    /// [`StudyError::Stored`].
    pub fn has_trials(&self) -> Result<bool, StudyError> {
        let file = File::open(&self.path).map_err(StudyError::io(&self.path, "opening the file"))?;
        let read = || FrameReader::open(file)?.columns(|name| name == "contender");
        Stored::read_by(self.path.clone(), read)?.has_some("contender")
    }
}
