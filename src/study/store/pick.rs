//! Traces that are read on demand: the group of the file that holds them, and no other.

use super::read::{Instances, Stored};
use super::traces::{groups, read_group};
use super::{check, hash_of, part_path};
use crate::StudyError;
use crate::key::Owner;
use crate::parquet::FrameReader;
use crate::record::Kept;
use engine::planner::Trace;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The traces of one study's records.
#[derive(Debug, Default)]
pub struct KeptTraces {
    /// The file that holds them; `None` if they are in memory already.
    path: Option<PathBuf>,
    found: OnceLock<TraceIndex>,
    damage: OnceLock<String>,
}

/// Where each trace stands, and those that were read.
#[derive(Debug, Default)]
struct TraceIndex {
    /// Its group and its place there.
    places: BTreeMap<Owner, Vec<(usize, usize)>>,
    /// What each group of the file holds.
    groups: Vec<OnceLock<Vec<Trace>>>,
}

impl KeptTraces {
    /// The traces of a run that is in memory.
    pub fn held(kept: Vec<Kept>) -> Self {
        let mut places: BTreeMap<Owner, Vec<(usize, usize)>> = BTreeMap::new();
        let mut all = Vec::with_capacity(kept.len());
        for (place, Kept { owner, trace }) in kept.into_iter().enumerate() {
            places.entry(owner).or_default().push((0, place));
            all.push(trace);
        }
        let groups = vec![OnceLock::from(all)];
        Self { found: OnceLock::from(TraceIndex { places, groups }), ..Self::default() }
    }

    /// The traces of `study` in `folder`, whose file must have its hash among `hashes`; none of them is read yet.
    ///
    /// # Errors
    /// [`StudyError::Touched`].
    pub fn stored(folder: &Path, study: &str, hashes: &BTreeMap<String, String>) -> Result<Self, StudyError> {
        let path = part_path(folder, study, "traces");
        check(&path, &hash_of(&path)?, hashes.get("traces"))?;
        Ok(Self { path: Some(path), ..Self::default() })
    }

    /// The traces of `owner`, in the order in which they were kept; none where the file cannot be read
    /// ([`damage`](Self::damage)).
    pub fn owned_by<'s>(&'s self, owner: &Owner) -> impl Iterator<Item = &'s Trace> + use<'s> {
        let found = self.found();
        let places = found.places.get(owner).map_or(&[][..], Vec::as_slice);
        places.iter().filter_map(|(group, place)| {
            once(&found.groups[*group], || self.or_damage(|path| Self::group(path, *group))).get(*place)
        })
    }

    fn found(&self) -> &TraceIndex {
        once(&self.found, || self.or_damage(Self::find))
    }

    /// The traces of `owner`, of a file that is read from one end to the other: no other group stays in memory.
    ///
    /// # Errors
    /// [`StudyError::Touched`].
    pub fn take(&mut self, owner: &Owner) -> Result<Vec<Trace>, StudyError> {
        let traces = self.owned_by(owner).cloned().collect();
        if let Some(found) = self.found.get_mut() {
            let own = found.places.get(owner).and_then(|places| places.last()).map(|(group, _)| *group);
            for (number, group) in found.groups.iter_mut().enumerate() {
                if own.is_some_and(|own| own != number) {
                    group.take();
                }
            }
        }
        self.damage().map(|()| traces)
    }

    /// Whose they are, in the order of the file.
    ///
    /// # Errors
    /// [`StudyError::Touched`].
    pub fn owners(&self) -> Result<Vec<&Owner>, StudyError> {
        let found = self.found();
        let mut owners: Vec<(&(usize, usize), &Owner)> =
            found.places.iter().filter_map(|(owner, places)| Some((places.first()?, owner))).collect();
        owners.sort_unstable_by_key(|(place, _)| **place);
        self.damage().map(|()| owners.into_iter().map(|(_, owner)| owner).collect())
    }

    /// What was wrong with the file where it was read.
    ///
    /// # Errors
    /// [`StudyError::Touched`].
    pub fn damage(&self) -> Result<(), StudyError> {
        self.damage.get().map_or(Ok(()), |found| Err(StudyError::Touched(found.clone())))
    }

    /// How many groups are in memory.
    #[cfg(test)]
    pub fn in_memory(&self) -> usize {
        let groups = self.found.get().into_iter().flat_map(|found| &found.groups);
        groups.filter(|group| group.get().is_some()).count()
    }

    fn or_damage<T: Default>(&self, read: impl FnOnce(&Path) -> Result<T, StudyError>) -> T {
        let Some(path) = &self.path else { return T::default() };
        read(path).unwrap_or_else(|error| {
            self.damage.get_or_init(|| error.to_string());
            T::default()
        })
    }

    /// Whose the traces in the file at `path` are, without reading them.
    fn find(path: &Path) -> Result<TraceIndex, StudyError> {
        let mut found = TraceIndex::default();
        let file = File::open(path).map_err(StudyError::io(path, "opening the file"))?;
        let read = || FrameReader::open(file)?.columns(|name| name != "values");
        let stored = Stored::read_by(path.to_owned(), read)?;
        let mut owners = stored.guarded(|file| file.owners(&mut Instances::default()))?.into_iter();
        for (number, count) in groups(path)?.into_iter().enumerate() {
            for (place, owner) in owners.by_ref().take(count).enumerate() {
                found.places.entry(owner).or_default().push((number, place));
            }
            found.groups.push(OnceLock::new());
        }
        Ok(found)
    }

    fn group(path: &Path, group: usize) -> Result<Vec<Trace>, StudyError> {
        let kept = read_group(path, group, &mut Instances::default())?;
        Ok(kept.into_iter().map(|kept| kept.trace).collect())
    }
}

/// What is in `cell`, made if nothing is. Nothing is locked while `make` reads: polars waits for threads of its own, and rayon has
/// whoever waits take up other work, which may ask for the same. Two may read then; the first one's is kept.
fn once<T>(cell: &OnceLock<T>, make: impl FnOnce() -> T) -> &T {
    if let Some(found) = cell.get() {
        return found;
    }
    let made = make();
    cell.get_or_init(|| made)
}
