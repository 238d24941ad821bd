//! One process at a time writes into a folder of runs.

use super::StudyError;
use base::file::check_own;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// The right to write into a folder of runs, from taking it until it is dropped.
#[derive(Debug)]
pub struct Lock {
    folder: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes the lock of `folder`, which is made if it does not exist.
    ///
    /// # Errors
    /// [`StudyError::Busy`] if another process holds it, [`StudyError::Io`] if the system refuses.
    pub fn take(folder: &Path) -> Result<Self, StudyError> {
        fs::create_dir_all(folder).map_err(StudyError::io(folder, "creating the folder"))?;
        let path = folder.join(".lock");
        let file = check_own(&path)
            .and_then(|()| File::create(&path))
            .map_err(StudyError::io(&path, "creating the lock"))?;
        match file.try_lock() {
            Ok(()) => Ok(Self { folder: folder.to_owned(), _file: file }),
            Err(TryLockError::WouldBlock) => Err(StudyError::Busy { path: folder.to_owned() }),
            Err(TryLockError::Error(e)) => Err(StudyError::io(&path, "locking")(e)),
        }
    }

    /// Whether a process holds the lock of `folder`.
    pub fn is_held(folder: &Path) -> bool {
        let path = folder.join(".lock");
        let file = check_own(&path).and_then(|()| File::open(path));
        file.is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
    }

    /// The folder that it locks.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}
