//! A paper: its bibliography, the ledger of everything it prints, its claims and its tables.
//!
//! The claims' checks stay tables here; they are understood on the floor that judges.

pub mod results;

use self::results::ResultsSpec;
use super::{Inputs, Reading, Study, StudyError};
use crate::settings::{Document, Settings, SettingsError};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::{Spanned, Table};

/// `paper.toml` as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PaperSpec {
    source: Source,
    prints: Prints,
    #[serde(default)]
    ledger: Vec<LedgerRow>,
    #[serde(default, rename = "claim")]
    claims: Vec<ClaimSpec>,
    #[serde(default, rename = "table")]
    tables: Vec<TableSpec>,
    #[serde(default)]
    results: Vec<ResultsSpec>,
}

/// Where the paper was published, as far as its text says.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Title.
    pub title: String,
    /// Authors, if the text names them.
    pub authors: Option<String>,
    /// Journal, year, pages: what the text prints.
    pub published: Option<String>,
    /// What a reader must know about this reproduction as a whole.
    #[serde(default)]
    pub notes: Vec<String>,
}

/// How many numbered things the paper has.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Prints {
    /// Figures.
    pub figures: u32,
    /// Tables.
    pub tables: u32,
    /// Equations.
    pub equations: u32,
}

/// One thing that the paper prints and what answers it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LedgerRow {
    /// `Fig. 4`, `Table 1`, `Eq. 2`, or the place of a sentence.
    pub item: Spanned<String>,
    /// What it shows or says.
    pub says: String,
    /// Claims that answer it.
    #[serde(default)]
    pub claims: Vec<Spanned<String>>,
    /// Our figures and tables that stand beside it.
    #[serde(default)]
    pub figures: Vec<Spanned<String>>,
    /// Studies that carry it out.
    #[serde(default)]
    pub studies: Vec<Spanned<String>>,
    /// Why nothing can answer it.
    pub none: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ClaimSpec {
    id: Spanned<String>,
    at: String,
    says: Option<String>,
    printed: Option<Spanned<String>>,
    unit: Option<String>,
    digits: Option<Digits>,
    untestable: Option<String>,
    #[serde(default)]
    check: BTreeMap<String, Spanned<Table>>,
}

/// How a printed number's digits end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Digits {
    /// To the nearest.
    Rounded,
    /// Cut off.
    Truncated,
    /// Either.
    Unknown,
}

/// What the paper says.
#[derive(Debug, Clone)]
pub struct Claim {
    /// Its name.
    pub id: String,
    /// Where it stands in the paper.
    pub at: String,
    /// The sentence, where it is not a number alone.
    pub says: Option<String>,
    /// The number as printed.
    pub printed: Option<String>,
    /// The number's unit; absent if the paper gives none.
    pub unit: Option<String>,
    /// How the number's digits end, where the claim says so; otherwise the reading decides.
    pub digits: Option<Digits>,
    /// What the paper leaves out, if that makes it untestable.
    pub untestable: Option<String>,
    /// How it is judged: checks by name.
    pub checks: BTreeMap<String, Settings>,
}

/// One of the paper's tables, to be set beside ours.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableSpec {
    /// Its file name.
    pub id: String,
    /// What it shows.
    pub caption: String,
    /// The heads of its columns.
    pub columns: Vec<String>,
    /// Its rows.
    #[serde(rename = "row")]
    pub rows: Vec<TableRow>,
}

/// A row of a table.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableRow {
    /// Its head.
    pub label: String,
    /// The claim in each column.
    #[serde(default)]
    pub claims: Vec<Spanned<String>>,
    /// What stands in each column where the table holds no claims.
    #[serde(default)]
    pub cells: Vec<String>,
}

/// A checked paper with its studies.
#[derive(Debug)]
pub struct Paper {
    /// Its name: the folder's.
    pub id: String,
    /// Its folder.
    pub folder: PathBuf,
    /// Bibliography.
    pub source: Source,
    /// How many numbered things it has.
    pub prints: Prints,
    /// Everything it prints.
    pub ledger: Vec<LedgerRow>,
    /// What it says.
    pub claims: Vec<Claim>,
    /// Its tables.
    pub tables: Vec<TableSpec>,
    /// Tables of our own results.
    pub results: Vec<ResultsSpec>,
    /// Its studies, in the order of their names.
    pub studies: Vec<Study>,
    /// The file it was read from.
    pub document: Arc<Document>,
}

impl Paper {
    /// Reads `paper.toml` and every study in `folder`.
    ///
    /// # Errors
    /// A missing folder or file, and everything that [`Study::load`] refuses; claims named twice, ledger rows that
    /// name what does not exist, gaps in the ledger's numbering.
    pub fn load(folder: &Path, inputs: &Inputs) -> Result<Self, StudyError> {
        let path = folder.join("paper.toml");
        if !path.is_file() {
            let what =
                "no such file; a paper is a folder with a paper.toml and one TOML file a study".to_owned();
            return Err(StudyError::Missing { path, what });
        }
        let document = Document::open(&path)?;
        let spec: PaperSpec = document.read()?;
        let mut studies = Vec::new();
        for path in study_files(folder)? {
            studies.push(Study::load(&path, inputs)?);
        }
        let absolute = fs::canonicalize(folder).map_err(StudyError::io(folder, "opening the folder"))?;
        let paper = Self {
            id: absolute.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            folder: folder.to_owned(),
            source: spec.source,
            prints: spec.prints,
            ledger: spec.ledger,
            claims: spec.claims.iter().map(|c| claim(&document, c)).collect::<Result<_, _>>()?,
            tables: spec.tables,
            results: spec.results,
            studies,
            document,
        };
        paper.check(&spec.claims)?;
        Ok(paper)
    }

    /// The study called `name`.
    pub fn study(&self, name: &str) -> Option<&Study> {
        self.studies.iter().find(|study| study.name == name)
    }

    /// The readings of all studies.
    ///
    /// Studies may share a reading's name; they then mean the same by it, and the first one speaks for it.
    pub fn readings(&self) -> Vec<Reading> {
        let mut readings: Vec<Reading> = Vec::new();
        for reading in self.studies.iter().flat_map(|study| &study.readings) {
            if !readings.iter().any(|known| known.id == reading.id) {
                readings.push(reading.clone());
            }
        }
        readings
    }

    /// The names of all its tables, the paper's own and those of our results.
    pub fn table_ids(&self) -> impl Iterator<Item = &str> {
        let own = self.tables.iter().map(|table| table.id.as_str());
        own.chain(self.results.iter().map(|table| table.id.get_ref().as_str()))
    }

    /// The claim called `id`.
    pub fn claim(&self, id: &str) -> Option<&Claim> {
        self.claims.iter().find(|claim| claim.id == id)
    }

    fn check(&self, specs: &[ClaimSpec]) -> Result<(), SettingsError> {
        let mut seen = BTreeSet::new();
        for spec in specs {
            if !seen.insert(spec.id.get_ref()) {
                let message = format!("claim `{}` stands twice", spec.id.get_ref());
                return Err(self.document.error(spec.id.span(), message));
            }
        }
        let claims: BTreeSet<&str> = self.claims.iter().map(|claim| claim.id.as_str()).collect();
        let studies: BTreeSet<&str> = self.studies.iter().map(|study| study.name.as_str()).collect();
        let drawn =
            self.studies.iter().flat_map(|study| study.figures.iter().map(|f| f.id.get_ref().as_str()));
        let figures: BTreeSet<&str> = drawn.chain(self.table_ids()).collect();
        for row in &self.ledger {
            self.known("claim", &row.claims, &claims)?;
            self.known("figure or table", &row.figures, &figures)?;
            self.known("study", &row.studies, &studies)?;
            let answered = !(row.claims.is_empty() && row.figures.is_empty() && row.studies.is_empty());
            if answered == row.none.is_some() {
                let message = format!(
                    "ledger row `{}` needs claims, figures or studies that answer it, or `none` with the reason, and \
                     not both",
                    row.item.get_ref()
                );
                return Err(self.document.error(row.item.span(), message));
            }
        }
        for row in self.tables.iter().flat_map(|table| &table.rows) {
            self.known("claim", &row.claims, &claims)?;
        }
        self.check_tables()?;
        self.check_results()?;
        self.check_readings()?;
        self.check_numbering()
    }

    /// A reading's name means the same in every study of the paper.
    fn check_readings(&self) -> Result<(), SettingsError> {
        for (study, reading) in self.studies.iter().flat_map(|s| s.readings.iter().map(move |r| (s, r))) {
            let all = self.readings();
            let first = all.iter().find(|known| known.id == reading.id).expect("every reading is listed");
            if first.default != reading.default || !first.options.keys().eq(reading.options.keys()) {
                let message = format!(
                    "reading `{}` has other options or another default in another study of the paper; one name must \
                     mean the same everywhere",
                    reading.id
                );
                return Err(study.document.error(0..0, message));
            }
        }
        Ok(())
    }

    fn check_tables(&self) -> Result<(), SettingsError> {
        for table in &self.tables {
            for row in &table.rows {
                let (claims, cells) = (row.claims.len(), row.cells.len());
                if claims.max(cells) != table.columns.len() || claims.min(cells) > 0 {
                    let message = format!(
                        "row `{}` of table `{}` has {claims} claims and {cells} cells; either are accepted, one for each of \
                         the {} columns",
                        row.label,
                        table.id,
                        table.columns.len()
                    );
                    let span = row.claims.first().map_or(0..0, Spanned::span);
                    return Err(self.document.error(span, message));
                }
            }
        }
        Ok(())
    }

    fn known(
        &self,
        what: &str,
        names: &[Spanned<String>],
        known: &BTreeSet<&str>,
    ) -> Result<(), SettingsError> {
        for name in names {
            if !known.contains(name.get_ref().as_str()) {
                let list: Vec<&str> = known.iter().copied().collect();
                let message =
                    format!("there is no {what} `{}`; there are {}", name.get_ref(), list.join(", "));
                return Err(self.document.error(name.span(), message));
            }
        }
        Ok(())
    }

    /// Every numbered figure, table and equation must have a row.
    fn check_numbering(&self) -> Result<(), SettingsError> {
        let items: BTreeSet<&str> = self.ledger.iter().map(|row| row.item.get_ref().as_str()).collect();
        for (kind, count) in
            [("Fig.", self.prints.figures), ("Table", self.prints.tables), ("Eq.", self.prints.equations)]
        {
            for number in 1..=count {
                let item = format!("{kind} {number}");
                if !items.contains(item.as_str()) {
                    let message =
                        format!("the ledger has no row for {item}; the paper has {count} of its kind");
                    return Err(self.document.error(0..0, message));
                }
            }
        }
        Ok(())
    }
}

/// Files of a paper's folder that are no studies: the paper itself, and what an independent judge is asked.
const NO_STUDIES: [&str; 2] = ["paper.toml", "crosscheck.toml"];

fn study_files(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let entries = fs::read_dir(folder).map_err(StudyError::io(folder, "listing the folder"))?;
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .filter(|path| path.file_name().is_some_and(|name| !NO_STUDIES.iter().any(|other| name == *other)))
        .collect();
    files.sort();
    Ok(files)
}

fn claim(document: &Arc<Document>, spec: &ClaimSpec) -> Result<Claim, SettingsError> {
    let id = spec.id.get_ref();
    if let Some(printed) = &spec.printed
        && printed.get_ref().parse::<f64>().is_err()
    {
        let message = format!(
            "claim `{id}`: printed is `{}`; the digits of one number as the paper prints them are accepted",
            printed.get_ref()
        );
        return Err(document.error(printed.span(), message));
    }
    if spec.check.is_empty() == spec.untestable.is_none() {
        let message =
            format!("claim `{id}` needs checks, or `untestable` with what the paper leaves out, not both");
        return Err(document.error(spec.id.span(), message));
    }
    let checks = spec.check.iter().map(|(name, table)| (name.clone(), Settings::written(document, table)));
    Ok(Claim {
        id: id.clone(),
        at: spec.at.clone(),
        says: spec.says.clone(),
        printed: spec.printed.as_ref().map(|printed| printed.get_ref().clone()),
        unit: spec.unit.clone(),
        digits: spec.digits,
        untestable: spec.untestable.clone(),
        checks: checks.collect(),
    })
}
