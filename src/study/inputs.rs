//! Where input files named by specs are found.

use std::path::{Path, PathBuf};

/// Where input files named by specs are looked for, in order.
#[derive(Debug, Clone, Default)]
pub struct Inputs {
    /// Folders that relative paths start from.
    pub roots: Vec<PathBuf>,
}

impl Inputs {
    /// The first existing file called `name` below the roots.
    ///
    /// # Errors
    /// A message that lists every place looked at.
    pub fn locate(&self, name: &str) -> Result<PathBuf, String> {
        let tried: Vec<PathBuf> = self.roots.iter().map(|root| root.join(name)).collect();
        if let Some(file) = tried.iter().find(|path| path.is_file()) {
            return Ok(file.clone());
        }
        if let Some(folder) = tried.iter().find(|path| path.is_dir()) {
            return Err(format!(
                "input file `{name}` is a folder ({}); a file is accepted",
                folder.display()
            ));
        }
        let places: Vec<String> = tried.iter().map(|path| path.display().to_string()).collect();
        Err(format!("input file `{name}` does not exist; looked for {}", places.join(", ")))
    }

    /// The name of `path` below the first root that it lies in: the same however the root's own path is spelled.
    pub fn spelled(&self, path: &Path) -> String {
        let below = self.roots.iter().find_map(|root| path.strip_prefix(root).ok());
        below.unwrap_or(path).display().to_string()
    }
}
