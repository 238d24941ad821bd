//! Where input files named by specs are found.

use std::path::PathBuf;

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
}
