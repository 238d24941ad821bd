//! Where input files named by specs are found.

use base::file::missing;
use std::any::{Any, TypeId};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// Where input files named by specs are looked for, in order.
#[derive(Debug, Clone, Default)]
pub struct Inputs {
    /// Folders that relative paths start from.
    pub roots: Vec<PathBuf>,
    read: Arc<Mutex<BTreeMap<(TypeId, String), Arc<dyn Any + Send + Sync>>>>,
}

impl Inputs {
    /// Those below `roots`; nothing is read yet.
    pub fn below(roots: Vec<PathBuf>) -> Self {
        Self { roots, read: Arc::default() }
    }

    /// What `read` makes of the files and settings that `from` names, read once: many problems name the same robot and scene.
    ///
    /// # Errors
    /// Those of `read`; nothing is remembered then.
    pub(crate) fn once<T, E>(&self, from: String, read: impl FnOnce() -> Result<T, E>) -> Result<T, E>
    where
        T: Clone + Send + Sync + 'static,
    {
        let known = || self.read.lock().expect("nothing panics that holds it");
        let key = (TypeId::of::<T>(), from);
        if let Some(found) = known().get(&key).and_then(|found| found.downcast_ref::<T>()) {
            return Ok(found.clone());
        }
        let found = read()?;
        known().insert(key, Arc::new(found.clone()));
        Ok(found)
    }

    /// The first existing file called `name` below the roots.
    ///
    /// # Errors
    /// A message that lists every place looked at.
    pub fn locate(&self, name: &str) -> Result<PathBuf, String> {
        let tried: Vec<PathBuf> = self.roots.iter().map(|root| root.join(name)).collect();
        if let Some(file) = tried.iter().find(|path| path.is_file()) {
            return Ok(file.clone());
        }
        let found = |is: fn(&Path) -> bool| tried.iter().find(|path| is(path));
        let folder = found(Path::is_dir).map(|path| (path, "is a folder"));
        let other = || found(Path::exists).map(|path| (path, "is a device, a pipe or a socket"));
        let link = || found(Path::is_symlink).map(|path| (path, missing(path)));
        if let Some((path, what)) = folder.or_else(other).or_else(link) {
            let path = path.display();
            return Err(format!("input file `{name}` {what} ({path}); a regular file is accepted"));
        }
        let places: Vec<String> = tried.iter().map(|path| path.display().to_string()).collect();
        Err(format!("input file `{name}` does not exist; looked for {}", places.join(", ")))
    }

    /// The files that match `pattern` below the first root where any does, by their names from that root, in order. A `*` in the
    /// last part stands for anything.
    ///
    /// # Errors
    /// A message that lists every place looked at.
    pub fn list(&self, pattern: &str) -> Result<Vec<String>, String> {
        let (folder, name) = pattern.rsplit_once('/').map_or(("", pattern), |(folder, name)| (folder, name));
        let Some((before, after)) = name.split_once('*') else {
            return Err(format!("`{pattern}` has no `*` in its last part; `maps/*.map` is accepted"));
        };
        let fits = |name: &str| {
            name.len() >= before.len() + after.len() && name.starts_with(before) && name.ends_with(after)
        };
        for root in &self.roots {
            let entries = fs::read_dir(root.join(folder)).into_iter().flatten().flatten();
            let files = entries.filter(|entry| entry.path().is_file());
            let names = files.map(|entry| entry.file_name().to_string_lossy().into_owned());
            let prefix = if folder.is_empty() { String::new() } else { format!("{folder}/") };
            let mut found: Vec<String> =
                names.filter(|name| fits(name)).map(|name| format!("{prefix}{name}")).collect();
            if !found.is_empty() {
                found.sort();
                return Ok(found);
            }
        }
        let places: Vec<String> =
            self.roots.iter().map(|root| root.join(pattern).display().to_string()).collect();
        Err(format!("no file is `{pattern}`; looked for {}", places.join(", ")))
    }

    /// The name of `path` below the first root that it lies in: the same however the root's own path is spelled.
    pub fn spelled(&self, path: &Path) -> String {
        let below = self.roots.iter().find_map(|root| path.strip_prefix(root).ok());
        below.unwrap_or(path).display().to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_once_for_each_kind_of_value_and_a_failure_is_not_remembered() {
        let inputs = Inputs::below(Vec::new());
        let read = |from: &str, answer: Result<u8, ()>| inputs.once(from.to_owned(), || answer);
        assert_eq!(read("arm", Err(())), Err(()));
        assert_eq!(read("arm", Ok(1)), Ok(1));
        assert_eq!(read("arm", Ok(2)), Ok(1), "it was read again");
        assert_eq!(read("arm, longer", Ok(3)), Ok(3));
        assert_eq!(
            inputs.clone().once("arm".to_owned(), || Ok::<u16, ()>(4)),
            Ok(4),
            "another kind of value"
        );
    }
}
