//! A paper: its bibliography, the inventory of everything it prints, its claims and its tables.
//!
//! The claims' checks stay tables here; they are understood on the floor that judges.

mod choices;
mod claim;
mod columns;
mod ids;
mod inventory;
mod reply;
mod report;
pub mod results;
mod rules;
mod table_spec;
mod tables;
mod withdrawn;

pub use self::claim::{Claim, Parts, TestRole, cells_named, printed_by};
use self::claim::{ClaimSpec, claim};
pub use self::rules::names_of;
pub use inventory::{InventoryRow, NumbersRow};
pub use reply::{Reply, is_day};
pub use report::{FIGURES, ReportSpec, filled};

use self::reply::ReplySpec;
use self::results::ResultsSpec;
use self::table_spec::TableSpec;
pub use self::tables::{PrintedCell, PrintedRow, PrintedTable};
pub use self::withdrawn::Withdrawn;
pub use super::spec::Digits;
use super::spec::{BudgetSpec, ChoiceSpec, ContenderSpec, ExploreSpec, ProblemsSpec};
use super::{Choice, Inputs, Interpretation, Shared, Study, StudyError, files};
use base::settings::{Accepted, Document, Faults};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What `paper.toml` may hold.
pub const FILE: Accepted = Accepted::shape::<PaperSpec>();

/// `paper.toml` as written.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PaperSpec {
    /// Where it was published.
    source: Source,
    /// What its chapter of the report shows.
    #[serde(default)]
    report: ReportSpec,
    /// How many numbered things the paper has, each with a row in the inventory; none if absent.
    #[serde(default)]
    prints: Prints,
    /// What it leaves open: each choice once, for all studies that it touches.
    #[serde(default, rename = "choice")]
    choices: Vec<ChoiceSpec>,
    /// How far that is explored.
    explore: Option<ExploreSpec>,
    /// The root of every seed when `replan confirm` runs a study once more; a study may set another.
    second_seed: Option<u64>,
    /// Limits on each trial of studies that say no others.
    budget: Option<BudgetSpec>,
    /// Groups of problems that groups of studies refer to by `like`.
    #[serde(default)]
    problems: Vec<ProblemsSpec>,
    /// Contenders that contenders of studies refer to by `like`.
    #[serde(default, rename = "contender")]
    contenders: Vec<ContenderSpec>,
    /// Everything that it prints, each with what answers it; without rows, nothing is compared with the paper's own list of prints.
    #[serde(default)]
    inventory: Vec<InventoryRow>,
    /// What it says.
    #[serde(default, rename = "claim")]
    claims: Vec<ClaimSpec>,
    /// Its own tables, whose cells are claims.
    #[serde(default, rename = "table")]
    tables: Vec<TableSpec>,
    /// Tables of our results.
    #[serde(default)]
    results: Vec<ResultsSpec>,
    /// What authors and others reply to verdicts: it stands beside them.
    #[serde(default, rename = "reply")]
    replies: Vec<ReplySpec>,
    /// Claims that it no longer has, with the reasons.
    #[serde(default)]
    withdrawn: Vec<Withdrawn>,
    /// By label of a contender, the series (colour, marker and dash) that it is drawn as in every figure.
    #[serde(default)]
    series: BTreeMap<String, usize>,
}

impl PaperSpec {
    /// What is left out and what holds there, for the manifests of the paper's studies.
    fn left_out(&self) -> Vec<String> {
        let prints = (self.prints == Prints::default()).then_some("paper: prints = nothing");
        let inventory = self.inventory.is_empty().then_some("paper: inventory = nothing");
        prints.into_iter().chain(inventory).map(str::to_owned).collect()
    }

    /// What it says for all studies.
    fn shared(&mut self, document: &Arc<Document>, faults: &mut Faults) -> Shared {
        let (groups, contenders) =
            Shared::models(std::mem::take(&mut self.problems), &self.contenders, document, faults);
        Shared {
            choices: Shared::choices(std::mem::take(&mut self.choices), document, faults),
            explore: self.explore.clone(),
            second_seed: self.second_seed,
            budget: self.budget,
            groups,
            contenders,
        }
    }
}

impl Study {
    /// Reads and checks the study in `path`, with what the paper.toml beside it says for all studies.
    ///
    /// # Errors
    /// Every name that does not exist, every settings table that its entry does not understand, every label
    /// that is used twice. All come at once, each with file, line, column, the value found and the values accepted.
    pub fn load(path: &Path, inputs: &Inputs) -> Result<Self, StudyError> {
        let mut faults = Faults::default();
        let paper = path.with_file_name("paper.toml");
        let shared = if paper.is_file() {
            let document = Document::open(&paper)?;
            document.read::<PaperSpec>()?.shared(&document, &mut faults)
        } else {
            Shared::default()
        };
        let mut study = Self::gather(&Document::open(path)?, &shared, inputs, &mut faults)?;
        if let Some(study) = &mut study {
            study.build(inputs, &mut faults)?;
        }
        match study {
            Some(study) if faults.is_empty() => Ok(study),
            _ => Err(faults.error().into()),
        }
    }
}

/// Where the paper was published, as far as its text says.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The title as printed.
    pub title: String,
    /// Authors, if the text names them.
    pub authors: Option<String>,
    /// Journal, year, pages: what the text prints.
    pub published: Option<String>,
    /// What a reader must know about this reproduction as a whole.
    #[serde(default)]
    pub notes: Vec<String>,
    /// What stands below every figure and table of results, if their inputs are not the paper's own.
    pub stand_ins: Option<String>,
    /// Whether the claims are questions of our own: our clock then decides those about times. It does not decide a sentence about
    /// the authors' times.
    #[serde(default)]
    pub ours: bool,
}

/// How many numbered things the paper has.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Prints {
    /// Numbered figures.
    #[schemars(range(max = 1000))]
    pub figures: u32,
    /// Numbered tables.
    #[schemars(range(max = 1000))]
    pub tables: u32,
    /// Numbered equations.
    #[schemars(range(max = 1000))]
    pub equations: u32,
    /// Numbers in its result sections, tables and captions; the inventory lists each where it is printed.
    #[schemars(range(max = 10_000))]
    pub numbers: u32,
}

/// A checked paper with its studies.
#[derive(Debug)]
pub struct Paper {
    /// Its name: the folder's.
    pub id: String,
    /// The folder of its paper.toml.
    pub folder: PathBuf,
    /// Bibliography.
    pub source: Source,
    /// What its chapter of the report shows.
    pub report: ReportSpec,
    /// How many numbered things it has.
    pub prints: Prints,
    /// What it leaves open.
    pub choices: Vec<Choice>,
    /// How far that is explored; not at all if absent.
    pub explore: Option<ExploreSpec>,
    /// Everything it prints.
    pub inventory: Vec<InventoryRow>,
    /// What it claims, with the cells of its tables.
    pub claims: Vec<Claim>,
    /// The tables that it prints, with the claims that are their cells.
    pub tables: Vec<PrintedTable>,
    /// The claims that are cells of its tables, by their names.
    pub cells: Vec<String>,
    /// Tables of our own results.
    pub results: Vec<ResultsSpec>,
    /// What authors and others reply to verdicts.
    pub replies: Vec<Reply>,
    /// Claims that it no longer has, with the reasons.
    pub withdrawn: Vec<Withdrawn>,
    /// By label of a contender, the series (colour, marker and dash) that it is drawn as in every figure.
    pub series: BTreeMap<String, usize>,
    /// Its studies, in the order of their names.
    pub studies: Vec<Study>,
    /// TOML files of its folder that are no studies, with the kind that each is.
    pub others: Vec<(PathBuf, &'static str)>,
    /// The file it was read from.
    pub document: Arc<Document>,
    /// Where each claim stands among its claims.
    places: BTreeMap<String, usize>,
    /// The first claim that each part is a part of.
    wholes: BTreeMap<String, usize>,
}

/// The first place at which each id stands.
fn first_places<'a>(ids: impl Iterator<Item = (usize, &'a String)>) -> BTreeMap<String, usize> {
    let mut places = BTreeMap::new();
    for (place, id) in ids {
        places.entry(id.clone()).or_insert(place);
    }
    places
}

/// Checks files beside the studies as the kinds that they are taken for, but for those with a fault that a study reported.
fn check_others(others: &[(PathBuf, &'static str)], faults: &mut Faults) {
    for (path, kind) in others.iter().filter(|(_, kind)| *kind != files::FOREIGN) {
        if !faults.are_in(path) {
            faults.keep(Document::open(path).and_then(|document| files::validate(&document, kind)));
        }
    }
}

impl Paper {
    /// Reads `paper.toml` and every study in `folder`.
    ///
    /// # Errors
    /// A missing folder or file, and everything that [`Study::load`] refuses; claims named twice, inventory rows that
    /// name what does not exist, gaps in the inventory's numbering.
    pub fn load(folder: &Path, inputs: &Inputs) -> Result<Self, StudyError> {
        Self::read(folder, inputs, true)
    }

    /// The same as it is written, for those who list it: nothing that its studies name is built, so that settings may be wrong
    /// and queries are unknown.
    ///
    /// # Errors
    /// As [`load`](Self::load), but for what building would show.
    pub fn outline(folder: &Path, inputs: &Inputs) -> Result<Self, StudyError> {
        Self::read(folder, inputs, false)
    }

    fn read(folder: &Path, inputs: &Inputs, builds: bool) -> Result<Self, StudyError> {
        let mut faults = Faults::default();
        let schema = |kind: &str| match kind {
            "paper" => (*FILE.schema()).clone(),
            other => files::schema(other),
        };
        let paper = Self::gather_all(folder, (inputs, builds), &schema, &mut faults)?;
        match paper {
            Some(paper) if faults.is_empty() => Ok(paper),
            _ => Err(faults.error().into()),
        }
    }

    /// The paper in `folder` as far as it can be read, if at all; every fault goes to `faults`. `schema` gives the
    /// schema of a kind of file.
    ///
    /// # Errors
    /// A missing folder or file.
    pub fn gather(
        folder: &Path,
        inputs: &Inputs,
        schema: &dyn Fn(&str) -> Value,
        faults: &mut Faults,
    ) -> Result<Option<Self>, StudyError> {
        Self::gather_all(folder, (inputs, true), schema, faults)
    }

    fn gather_all(
        folder: &Path,
        (inputs, builds): (&Inputs, bool),
        schema: &dyn Fn(&str) -> Value,
        faults: &mut Faults,
    ) -> Result<Option<Self>, StudyError> {
        let path = folder.join("paper.toml");
        if !path.is_file() {
            let what =
                "no such file; a paper is a folder with a paper.toml and one TOML file a study".to_owned();
            return Err(StudyError::Missing { path, what });
        }
        let files = files::beside(folder)?;
        let document = Document::open(&path)?;
        let read = document.validate(&schema("paper")).and_then(|()| document.read::<PaperSpec>());
        let mut spec = faults.keep(read);
        let shared = spec.as_mut().map(|spec| spec.shared(&document, faults)).unwrap_or_default();
        if spec.is_none() {
            // What studies lack may be written there.
            faults.unread("budget");
            faults.unread("choice");
            faults.unread("like");
        }
        let mut studies = Vec::new();
        let mut others = Vec::new();
        for path in &files {
            let Some(own) = faults.keep(Document::open(path)) else { continue };
            match files::kind_of(&own, &document) {
                files::STUDY => {
                    let mut study = Study::gather(&own, &shared, inputs, faults)?;
                    if let Some(study) = study.as_mut().filter(|_| builds) {
                        study.build(inputs, faults)?;
                    }
                    if study.as_ref().is_none_or(|study| study.contenders.is_empty()) && faults.are_in(path) {
                        faults.unread("contender");
                    }
                    studies.extend(study);
                }
                kind => others.push((path.clone(), kind)),
            }
        }
        check_others(&others, faults);
        shared.check_models(&document, &studies, faults);
        if files.len() == others.len() && faults.is_empty() {
            let what = "no study; a study is a TOML file beside paper.toml".to_owned();
            return Err(StudyError::Missing { path: folder.to_owned(), what });
        }
        let Some(spec) = spec else { return Ok(None) };
        Self::assemble(folder, &document, (spec, shared.choices), (studies, others), faults).map(Some)
    }

    /// The paper in `folder` whose paper.toml is `document`, with loaded `studies`.
    ///
    /// # Errors
    /// As [`load`](Self::load), but for those of the studies.
    pub fn with_studies(
        folder: &Path,
        document: &Arc<Document>,
        studies: Vec<Study>,
    ) -> Result<Self, StudyError> {
        let mut faults = Faults::default();
        let mut spec: PaperSpec = document.read()?;
        let choices = spec.shared(document, &mut faults).choices;
        let paper = Self::assemble(folder, document, (spec, choices), (studies, Vec::new()), &mut faults)?;
        faults.done()?;
        Ok(paper)
    }

    fn assemble(
        folder: &Path,
        document: &Arc<Document>,
        (spec, choices): (PaperSpec, Vec<Choice>),
        (mut studies, others): Files,
        faults: &mut Faults,
    ) -> Result<Self, StudyError> {
        for study in &mut studies {
            study.of_paper = spec.left_out();
        }
        let cells = tables::cell_ids(&spec.tables);
        let (mut claims, tables) = tables::printed(document, &spec.tables, &cells, faults);
        claims
            .extend(spec.claims.iter().enumerate().map(|claim| self::claim(document, claim, &cells, faults)));
        let places = first_places(claims.iter().map(|claim| &claim.id).enumerate());
        let parts = claims.iter().map(|claim| claim.parts.ids()).enumerate();
        let parts = parts.flat_map(|(place, ids)| ids.iter().map(move |part| (place, part)));
        let wholes = first_places(parts);
        let absolute = fs::canonicalize(folder).map_err(StudyError::io(folder, "opening the folder"))?;
        let mut paper = Self {
            id: absolute.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            folder: folder.to_owned(),
            source: spec.source,
            report: spec.report,
            prints: spec.prints,
            choices,
            explore: spec.explore,
            inventory: spec.inventory,
            claims,
            tables,
            cells,
            results: spec.results,
            replies: Vec::new(),
            withdrawn: spec.withdrawn,
            series: spec.series,
            studies,
            others,
            document: document.clone(),
            places,
            wholes,
        };
        paper.read_replies(&spec.replies, faults);
        paper.check_withdrawn(faults);
        paper.check(&spec.claims, &spec.tables, faults);
        Ok(paper)
    }

    /// The study called `name`.
    pub fn study(&self, name: &str) -> Option<&Study> {
        self.studies.iter().find(|study| study.name == name)
    }

    /// The interpretations that contenders depart to, each once.
    ///
    /// # Panics
    /// If a contender departs from a choice that the paper does not have: such a paper is refused when it is loaded.
    pub fn departures(&self) -> Vec<Interpretation> {
        let departing = self.studies.iter().flat_map(|study| &study.contenders);
        let all: BTreeSet<_> =
            departing.map(|own| &own.departs).filter(|departs| !departs.is_empty()).collect();
        let departed =
            |departs| Interpretation::new(&self.choices, departs).expect("the paper has these choices");
        all.into_iter().map(departed).collect()
    }

    /// The studies that the claim called `id`, its parts and theirs look at.
    pub fn studies_of(&self, id: &str) -> Vec<&Study> {
        let Some(claim) = self.claim(id) else { return Vec::new() };
        let own = claim.studies();
        let parts = claim.parts.ids().iter().flat_map(|part| self.studies_of(part));
        let named = self.studies.iter().filter(|study| own.contains(&study.name.as_str()));
        named.chain(parts).collect()
    }

    /// The options under which the paper may mean `claim`, which looks at `studies`, and that cannot be run: `corners =
    /// lost: why`.
    pub fn not_run(&self, claim: &Claim, studies: &[&Study]) -> Vec<String> {
        let inherited = |choice: &&Choice| {
            studies.iter().any(|study| study.choices.iter().any(|own| own.id == choice.id))
        };
        let mut found = Vec::new();
        for choice in self.choices.iter().filter(inherited) {
            let premise = claim.holds_when.get(&choice.id);
            let is_meant = |name: &str| premise.is_none_or(|options| options.iter().any(|own| own == name));
            let options = choice.not_run().filter(|(name, _)| is_meant(name));
            found.extend(options.map(|(name, why)| format!("{} = {name}: {why}", choice.id)));
        }
        found
    }

    /// The figures of all its studies.
    pub fn figures(&self) -> impl Iterator<Item = &super::spec::FigureSpec> {
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
        self.claims.get(*self.wholes.get(id)?)
    }

    /// The table of our results called `id`.
    pub fn results_called(&self, id: &str) -> Option<&ResultsSpec> {
        self.results.iter().find(|table| table.id.get_ref() == id)
    }

    /// The claim called `id`.
    pub fn claim(&self, id: &str) -> Option<&Claim> {
        self.claims.get(self.place_of(id)?)
    }

    /// Where the claim called `id` stands among the claims.
    pub fn place_of(&self, id: &str) -> Option<usize> {
        self.places.get(id).copied()
    }
}

/// The studies of a paper's folder, and its other TOML files with the kind that each is.
type Files = (Vec<Study>, Vec<(PathBuf, &'static str)>);
