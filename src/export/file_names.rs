//! Names of files for labels of any length and any letters.

use base::hash::sha256;
use std::collections::BTreeSet;

/// How many letters of a label a file keeps; file systems take 255 with what is put behind them.
const MOST: usize = 200;

/// The names that were given, so that no file replaces another.
#[derive(Default)]
pub struct FileNames {
    taken: BTreeSet<String>,
}

impl FileNames {
    /// The name of the file for `label`, with `ending`. A hash replaces the end of a long label, and distinguishes
    /// labels that are spelled alike.
    pub fn next(&mut self, label: &str, ending: &str) -> String {
        let mut stem = study::slug(label);
        if stem.len() > MOST || !self.taken.insert(stem.clone()) {
            stem.truncate(MOST);
            stem += &format!("-{}", &sha256(label.as_bytes())[..8]);
        }
        stem + ending
    }
}
