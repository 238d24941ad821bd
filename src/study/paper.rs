//! A paper: its bibliography, the ledger of everything it prints, its claims and its tables.
//!
//! The claims' checks stay tables here; they are understood on the floor that judges.

mod findings;
pub mod results;
mod rules;
mod tables;

pub use findings::filled;

use self::results::ResultsSpec;
pub use self::tables::{OursSpec, TableRow, TableSpec};
pub use super::spec::Digits;
use super::{Inputs, Reading, Study, StudyError, files};
use base::settings::{Accepted, AnyTable, Document, Faults, Settings, SettingsError, Spanned};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Table;

/// What `paper.toml` may hold.
pub const FILE: Accepted = Accepted::of::<PaperSpec>();

/// `paper.toml` as written.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PaperSpec {
    /// Where it was published.
    source: Source,
    /// How many numbered things the paper has, each of which then needs a row in the ledger; none if absent.
    #[serde(default)]
    prints: Prints,
    /// Everything that it prints, and what answers it.
    #[serde(default)]
    ledger: Vec<LedgerRow>,
    /// What it says.
    #[serde(default, rename = "claim")]
    claims: Vec<ClaimSpec>,
    /// Its own tables, to be set beside ours.
    #[serde(default, rename = "table")]
    tables: Vec<TableSpec>,
    /// Tables of our results.
    #[serde(default)]
    results: Vec<ResultsSpec>,
    /// The series, of those that figures have, that a contender is drawn as wherever it is drawn, by its label.
    #[serde(default)]
    series: BTreeMap<String, usize>,
}

/// Where the paper was published, as far as its text says.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
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
    /// What was found, in a few sentences; the chapter opens with them, our number standing for each `{claim}`.
    #[serde(default)]
    pub findings: Vec<String>,
    /// What stands below every figure and table of results, if their inputs are not the paper's own.
    pub stand_ins: Option<String>,
}

/// How many numbered things the paper has.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Prints {
    /// Figures.
    #[schemars(range(max = 1000))]
    pub figures: u32,
    /// Tables.
    #[schemars(range(max = 1000))]
    pub tables: u32,
    /// Equations.
    #[schemars(range(max = 1000))]
    pub equations: u32,
}

/// One thing that the paper prints and what answers it.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
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

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ClaimSpec {
    /// Its name.
    id: Spanned<String>,
    /// Where it stands in the paper.
    at: String,
    /// The sentence, where it is not a number alone.
    says: Option<String>,
    /// The paper's own words, where they are given word for word.
    quote: Option<String>,
    /// The number as printed, digits and all.
    printed: Option<Spanned<String>>,
    /// The number's unit; absent if the paper gives none.
    unit: Option<String>,
    /// How the number's digits end, where the claim says so; otherwise the reading decides.
    digits: Option<Digits>,
    /// What the paper leaves out, if that makes it untestable; checks then only show what can be shown.
    untestable: Option<String>,
    /// Why it must hold whatever the paper says, if it must: it is then asserted, and no evidence for anything.
    theorem: Option<String>,
    /// What was changed in how it is judged after a run had been seen, and why.
    changed_after_run: Option<String>,
    /// How it is judged: the settings of each criterion, by the criterion's name.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, AnyTable>")]
    check: BTreeMap<String, Spanned<Table>>,
    /// What is shown beside it and decides nothing: the settings of criteria, by the criterion's name.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Vec<AnyTable>>")]
    shows: BTreeMap<String, Vec<Spanned<Table>>>,
    /// What arithmetic on printed numbers says of it: the settings of each rule, by the rule's name.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, AnyTable>")]
    rule: BTreeMap<String, Spanned<Table>>,
    /// The claims all of which the sentence says.
    #[serde(default)]
    all_of: Vec<Spanned<String>>,
    /// The claims some one of which the sentence says.
    #[serde(default)]
    any_of: Vec<Spanned<String>>,
    /// The claims one of which the sentence means, without saying which.
    #[serde(default)]
    means_one_of: Vec<Spanned<String>>,
    /// The claims that are the cells of this row of a table.
    #[serde(default)]
    cells: Vec<Spanned<String>>,
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
    /// The paper's own words, where they are given word for word.
    pub quote: Option<String>,
    /// The number as printed.
    pub printed: Option<String>,
    /// The number's unit; absent if the paper gives none.
    pub unit: Option<String>,
    /// How the number's digits end, where the claim says so; otherwise the reading decides.
    pub digits: Option<Digits>,
    /// What the paper leaves out, if that makes it untestable; checks then only show what can be shown.
    pub untestable: Option<String>,
    /// Why it must hold whatever the paper says, if it must: it is then asserted, and no evidence for anything.
    pub theorem: Option<String>,
    /// What was changed in how it is judged after a run had been seen, and why.
    pub changed_after_run: Option<String>,
    /// How it is judged, and what is shown beside: rules and criteria by name.
    asked: Vec<(Asked, String, Settings)>,
    /// The claims that it is made of.
    pub parts: Parts,
}

/// What a claim asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// A rule: arithmetic on printed numbers.
    Rule,
    /// A criterion that decides.
    Decides,
    /// A criterion that is shown and decides nothing.
    Shown,
}

/// The claims that a claim is made of; they count with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Parts {
    /// None.
    None,
    /// A sentence that says all of them.
    AllOf(Vec<String>),
    /// A sentence that says some one of them.
    AnyOf(Vec<String>),
    /// A sentence that means one of them and does not say which.
    MeansOneOf(Vec<String>),
    /// The cells of a row of a table.
    Cells(Vec<String>),
}

impl Parts {
    /// Their ids.
    pub fn ids(&self) -> &[String] {
        match self {
            Self::None => &[],
            Self::AllOf(ids) | Self::AnyOf(ids) | Self::MeansOneOf(ids) | Self::Cells(ids) => ids,
        }
    }
}

impl Claim {
    /// Every rule and criterion with its settings.
    pub fn asked(&self) -> impl Iterator<Item = (Asked, &str, &Settings)> {
        self.asked.iter().map(|(asked, name, settings)| (*asked, name.as_str(), settings))
    }

    /// Every criterion that decides or is shown, with its settings.
    pub fn criteria(&self) -> impl Iterator<Item = (&str, &Settings)> {
        let criteria = self.asked().filter(|(asked, ..)| *asked != Asked::Rule);
        criteria.map(|(_, name, settings)| (name, settings))
    }

    /// The settings of the criterion called `name` that it is judged by.
    pub fn check(&self, name: &str) -> Option<&Settings> {
        let mut decides = self.asked().filter(|(asked, own, _)| *asked == Asked::Decides && *own == name);
        decides.next().map(|(.., settings)| settings)
    }
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
    /// The series, of those that figures have, that a contender is drawn as wherever it is drawn, by its label.
    pub series: BTreeMap<String, usize>,
    /// Its studies, in the order of their names.
    pub studies: Vec<Study>,
    /// TOML files of its folder that are no studies, with the kind that each is.
    pub others: Vec<(PathBuf, &'static str)>,
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
        let mut faults = Faults::default();
        let spec = faults.keep(document.read::<PaperSpec>());
        let files = study_files(folder)?;
        let (studies, others) = read_files(&files, inputs, &mut faults)?;
        if files.len() == others.len() && faults.is_empty() {
            let what = "no study; a study is a TOML file beside paper.toml".to_owned();
            return Err(StudyError::Missing { path: folder.to_owned(), what });
        }
        let Some(spec) = spec else { return Err(faults.error().into()) };
        Self::assemble(folder, &document, spec, (studies, others), faults)
    }

    /// The paper in `folder` whose paper.toml is `document`, with studies that were loaded.
    ///
    /// # Errors
    /// As [`load`](Self::load), but for those of the studies.
    pub fn of(folder: &Path, document: &Arc<Document>, studies: Vec<Study>) -> Result<Self, StudyError> {
        Self::assemble(folder, document, document.read()?, (studies, Vec::new()), Faults::default())
    }

    fn assemble(
        folder: &Path,
        document: &Arc<Document>,
        spec: PaperSpec,
        (studies, others): Files,
        mut faults: Faults,
    ) -> Result<Self, StudyError> {
        let claims = spec.claims.iter().filter_map(|c| faults.keep(claim(document, c))).collect();
        let absolute = fs::canonicalize(folder).map_err(StudyError::io(folder, "opening the folder"))?;
        let paper = Self {
            id: absolute.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            folder: folder.to_owned(),
            source: spec.source,
            prints: spec.prints,
            ledger: spec.ledger,
            claims,
            tables: spec.tables,
            results: spec.results,
            series: spec.series,
            studies,
            others,
            document: document.clone(),
        };
        // Names that are missing because their file is wrong are no faults of those that use them.
        if faults.is_empty() {
            paper.check(&spec.claims, &mut faults);
        }
        faults.done()?;
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

    /// The figures of all its studies.
    fn figures(&self) -> impl Iterator<Item = &super::spec::FigureSpec> {
        self.studies.iter().flat_map(|study| &study.figures)
    }

    /// The names of all figures of its studies.
    pub fn figure_ids(&self) -> impl Iterator<Item = &str> {
        self.figures().map(|figure| figure.id.get_ref().as_str())
    }

    /// The names of all its tables, the paper's own and those of our results.
    pub fn table_ids(&self) -> impl Iterator<Item = &str> {
        let own = self.tables.iter().map(|table| table.id.as_str());
        let behind = self.figures().filter_map(|figure| figure.table.as_deref());
        own.chain(behind).chain(self.results.iter().map(|table| table.id.get_ref().as_str()))
    }

    /// The sentence or row that the claim called `id` is a part of, and with which it counts.
    pub fn whole_of(&self, id: &str) -> Option<&Claim> {
        self.claims.iter().find(|claim| claim.parts.ids().iter().any(|part| part == id))
    }

    /// The claim called `id`.
    pub fn claim(&self, id: &str) -> Option<&Claim> {
        self.claims.iter().find(|claim| claim.id == id)
    }
}

/// The studies of a paper's folder, and its other TOML files with the kind that each is.
type Files = (Vec<Study>, Vec<(PathBuf, &'static str)>);

fn read_files(files: &[PathBuf], inputs: &Inputs, faults: &mut Faults) -> Result<Files, StudyError> {
    let (mut studies, mut others) = (Vec::new(), Vec::new());
    for path in files {
        if let Ok(document) = Document::open(path)
            && let Some(kind) = files::other_than_study(&document)
        {
            faults.keep(files::validate(&document, kind));
            others.push((path.clone(), kind.name));
            continue;
        }
        match Study::load(path, inputs) {
            Ok(study) => studies.push(study),
            Err(StudyError::Settings(fault)) => faults.add(fault),
            Err(other) => return Err(other),
        }
    }
    Ok((studies, others))
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
    let parts = parts(document, spec)?;
    let asked = asked(document, spec);
    if asked.is_empty() && spec.untestable.is_none() && parts == Parts::None {
        let message = format!(
            "claim `{id}` needs `check`, `rule`, parts, or `untestable` with what the paper leaves out"
        );
        return Err(document.error(spec.id.span(), message));
    }
    Ok(Claim {
        id: id.clone(),
        at: spec.at.clone(),
        says: spec.says.clone(),
        quote: spec.quote.clone(),
        printed: spec.printed.as_ref().map(|printed| printed.get_ref().clone()),
        unit: spec.unit.clone(),
        digits: spec.digits,
        untestable: spec.untestable.clone(),
        theorem: spec.theorem.clone(),
        changed_after_run: spec.changed_after_run.clone(),
        asked,
        parts,
    })
}

fn asked(document: &Arc<Document>, spec: &ClaimSpec) -> Vec<(Asked, String, Settings)> {
    let one = |asked: Asked| {
        move |(name, table): (&String, &Spanned<Table>)| {
            (asked, name.clone(), Settings::written(document, table))
        }
    };
    let shown = spec.shows.iter().flat_map(|(name, tables)| tables.iter().map(move |table| (name, table)));
    let rules = spec.rule.iter().map(one(Asked::Rule));
    rules.chain(spec.check.iter().map(one(Asked::Decides))).chain(shown.map(one(Asked::Shown))).collect()
}

fn parts(document: &Arc<Document>, spec: &ClaimSpec) -> Result<Parts, SettingsError> {
    let kinds = [
        (&spec.all_of, Parts::AllOf as fn(Vec<String>) -> Parts),
        (&spec.any_of, Parts::AnyOf),
        (&spec.means_one_of, Parts::MeansOneOf),
        (&spec.cells, Parts::Cells),
    ];
    let mut given = kinds.into_iter().filter(|(ids, _)| !ids.is_empty());
    match (given.next(), given.next()) {
        (None, _) => Ok(Parts::None),
        (Some((ids, of)), None) => Ok(of(ids.iter().map(|id| id.get_ref().clone()).collect())),
        _ => {
            let message = format!(
                "claim `{}`: one of `all_of`, `any_of`, `means_one_of` and `cells` is accepted",
                spec.id.get_ref()
            );
            Err(document.error(spec.id.span(), message))
        }
    }
}
