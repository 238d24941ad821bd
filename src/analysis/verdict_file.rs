//! The file that keeps verdicts: TOML, and a seal as its last line, so that an edit by hand is noticed.

use super::compare::stored_studies;
use super::verdict::Verdicts;
use base::hash::sha256;
use base::settings::{Document, SettingsError};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use study::StudyError;
use study::store::write_whole;

/// How the last line begins.
const SEAL: &str = "# SHA-256 of the text above: ";

impl Verdicts {
    /// Where they lie in the folder of a paper's runs.
    pub fn path(folder: &Path) -> PathBuf {
        folder.join("verdicts.toml")
    }

    /// Reads the verdicts in `folder`, as they were judged.
    ///
    /// # Errors
    /// [`StudyError::Stored`] if there are none, [`StudyError::Touched`] if they cannot be understood or are not what was written.
    pub fn read(folder: &Path) -> Result<Self, StudyError> {
        let document = open(folder)?;
        let verdicts = understood(&document)?;
        if sealed(text_above(document.text())) == document.text() {
            return Ok(verdicts);
        }
        let path = Self::path(folder);
        let what = "is not what replan wrote: its last line does not seal the text above it: edited, or of another version; \
                    `replan judge` writes it again";
        Err(StudyError::Touched(format!("{}: {what}", path.display())))
    }

    /// Reads the verdicts in `folder`, also edited ones, to compare them with those judged now.
    ///
    /// # Errors
    /// [`StudyError::Stored`] if there are none, [`StudyError::Touched`] if they cannot be understood.
    pub fn read_as_they_stand(folder: &Path) -> Result<Self, StudyError> {
        let document = open(folder)?;
        understood(&document)
    }

    /// Writes the verdicts into `folder`.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        write_whole(&Self::path(folder), self.text().as_bytes())
    }

    /// The verdicts as TOML under their seal.
    pub fn text(&self) -> String {
        sealed(&toml::to_string(self).expect("verdicts are strings, numbers and tables of them"))
    }
}

/// `text` with its seal.
fn sealed(text: &str) -> String {
    format!("{text}{SEAL}{}\n", sha256(text.as_bytes()))
}

/// What stands above the last line that begins as a seal; all of it if there is none.
fn text_above(text: &str) -> &str {
    text.rfind(SEAL).map_or(text, |at| &text[..at])
}

fn open(folder: &Path) -> Result<Arc<Document>, StudyError> {
    let path = Verdicts::path(folder);
    if !path.exists() {
        let missing = "no verdicts; run `replan judge` first";
        return Err(if stored_studies(folder).is_empty() {
            StudyError::stored(&path, missing)
        } else {
            StudyError::Touched(format!("{}: {missing}", path.display()))
        });
    }
    Document::open(&path).map_err(touched)
}

fn understood(document: &Document) -> Result<Verdicts, StudyError> {
    document.read_stored().map_err(touched)
}

fn touched(error: SettingsError) -> StudyError {
    StudyError::touched(error, "`replan judge` writes it again")
}
