//! The history of a paper's claims: what each of them meant when its data were run and judged.
//!
//! `history.toml` lies beside the runs and only grows: an entry is added where claims or records are others than in the entries
//! before it. Each entry ends in a seal, the SHA-256 of all text above it, so that an edit of an earlier one is found. A claim
//! is the same as long as its hash is ([`meaning`](super::meaning)), whatever it is called. Its data were seen if records of a
//! study that it asks had been stored before it changed.

use super::citation::{citation, version};
use super::meaning::{DIGITS, FORM, meanings};
use super::verdict::{ClaimVerdict, Verdicts};
use base::hash::sha256;
use base::settings::Document;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use study::StudyError;
use study::manifest::{MadeBy, Manifest};
use study::paper::Paper;
use study::store::{remove_temporaries, write_whole};

/// What stands above the first entry.
const HEAD: &str =
    "# What each claim meant when its data were run and judged. replan adds entries and changes none.\n";

/// What holds of a history whose first entry found stored runs and does not say where it takes claims over from.
const BEGINS_LATE: &str = "The history of claims begins with runs that were stored already: of earlier changes only what claims \
                           themselves say is known.";

/// How many changed claims a sentence names.
const LISTED: usize = 8;

/// What stands where no reason is given for a change.
const NO_REASON: &str = "changed after its data were seen, without a reason given";

/// The words for a change that the claim itself declared when the history began.
const BEFORE: &str = "entry 1, before it began";

/// How the last line of an entry begins.
const SEAL: &str = "# SHA-256 of the text above: ";

/// A `history.toml`, and what is known of each claim after its last entry.
#[derive(Debug, Clone, Default)]
pub struct History {
    text: String,
    entries: usize,
    form: u32,
    claims: BTreeMap<String, Known>,
    /// By study the hash of its records.
    records: BTreeMap<String, String>,
    remarks: Vec<String>,
    /// Claims that are gone after their data had been seen, each with the entry that says so.
    withdrawn: Vec<(String, usize)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    entry: Vec<Entry>,
}

#[derive(Serialize)]
struct NewFile<'e> {
    entry: [&'e Entry; 1],
}

/// What was new when a command ran or judged.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    number: usize,
    command: String,
    /// The git revision of the program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    git: Option<String>,
    /// The form of the claims' hashes.
    form: u32,
    /// Where it takes claims over from, if they do not come from the run itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    note: Option<String>,
    /// The last seal of an earlier history that is gone; stored verdicts rest on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    replaces: Option<String>,
    /// Claims that the paper no longer has.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    gone: Vec<String>,
    /// By study a hash of its records.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    records: BTreeMap<String, String>,
    /// New and changed claims whose data had not been seen, by id: the hash and the studies that it asks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    claims: BTreeMap<String, Stated>,
    /// Those whose data had been seen.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    after_data: BTreeMap<String, Stated>,
}

/// A claim in an entry: the hash of what it means, and behind it the studies that it asks.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(transparent)]
struct Stated(Vec<String>);

impl Stated {
    fn hash(&self) -> &str {
        self.0.first().map_or("", String::as_str)
    }

    fn studies(&self) -> impl Iterator<Item = &String> {
        self.0.iter().skip(1)
    }
}

/// A claim after some entry.
#[derive(Debug, Clone)]
struct Known {
    stated: Stated,
    /// Each change after its data had been seen, in words.
    changes: Vec<String>,
}

/// What is claimed and stored now.
struct Now {
    claims: BTreeMap<String, Stated>,
    /// The claims that give a reason for a change after a run.
    reasons: BTreeSet<String>,
    /// By study the hash of its records.
    records: BTreeMap<String, String>,
}

impl Now {
    /// What `paper` asks and what is stored of it in `folder`; a run that cannot be read is no record.
    fn new(paper: &Paper, folder: &Path) -> Self {
        let hash =
            |name: &String| Some(Manifest::read(folder, name).ok()?.records_hash()[..DIGITS].to_owned());
        let names = paper.studies.iter().map(|study| &study.name);
        let records = names.filter_map(|name| Some((name.clone(), hash(name)?))).collect();
        let changed = paper.claims.iter().filter(|claim| claim.changed_after_run.is_some());
        let reasons = changed.map(|claim| claim.id.clone()).collect();
        let stated = meanings(paper).into_iter().map(|(id, words)| (id, Stated(words)));
        Self { claims: stated.collect(), reasons, records }
    }
}

impl History {
    /// Where it lies in the folder of a paper's runs.
    pub fn path(folder: &Path) -> PathBuf {
        folder.join("history.toml")
    }

    /// The history in `folder`; an empty one if there is none.
    ///
    /// # Errors
    /// [`StudyError::Touched`] if an entry was edited, or is gone although verdicts rest on it.
    pub fn read(folder: &Path) -> Result<Self, StudyError> {
        let path = Self::path(folder);
        if !path.exists() {
            return Ok(Self::default());
        }
        let touched = |what: &str| {
            let help =
                "put back the file as replan wrote it; without the file a new history begins, and says so";
            StudyError::Touched(format!("{}: {what}; {help}", path.display()))
        };
        let text =
            fs::read_to_string(&path).map_err(|error| touched(&format!("cannot be read ({error})")))?;
        let seals = seals(&text).ok_or_else(|| touched("an entry was edited or cut off"))?;
        let read = Document::new(&path, text.clone()).read_stored();
        let File { entry: entries } = read.map_err(|error| touched(&error.to_string()))?;
        if entries.len() != seals.len() {
            return Err(touched("an entry has no seal of its own"));
        }
        let replaced = entries.first().and_then(|first| first.replaces.as_deref());
        if judged_with(folder)
            .is_some_and(|seal| !seals.iter().copied().chain(replaced).any(|own| own == seal))
        {
            return Err(touched("entries are gone on which the stored verdicts rest"));
        }
        let mut history = Self::default();
        for entry in &entries {
            history.add(entry);
        }
        Ok(Self { text, ..history })
    }

    /// By id, the meaning of each claim after the last entry: its hash, and the studies whose trials it uses.
    pub fn meanings(&self) -> BTreeMap<String, Vec<String>> {
        self.claims.iter().map(|(id, known)| (id.clone(), known.stated.0.clone())).collect()
    }

    /// The form of these hashes.
    pub fn form(&self) -> u32 {
        self.form
    }

    /// The history in `folder`, with a new entry if the claims of `paper` or its stored runs have changed. The caller
    /// holds the folder's lock.
    ///
    /// # Errors
    /// Those of [`read`](Self::read) and of writing.
    pub fn note(paper: &Paper, folder: &Path, command: &str) -> Result<Self, StudyError> {
        Self::read(folder)?.noting(&Now::new(paper, folder), folder, command)
    }

    /// Begins the history in `folder` with the claims' meanings when shards of a run were planned, unless it has begun.
    /// Its last entry then shows what has changed since.
    ///
    /// # Errors
    /// As [`note`](Self::note).
    pub fn note_planned(
        claims: &BTreeMap<String, Vec<String>>,
        folder: &Path,
        command: &str,
    ) -> Result<(), StudyError> {
        let history = Self::read(folder)?;
        if history.entries > 0 {
            return Ok(());
        }
        let planned = |(id, words): (&String, &Vec<String>)| (id.clone(), Stated(words.clone()));
        let claims = claims.iter().map(planned).collect();
        let now = Now { claims, reasons: BTreeSet::new(), records: BTreeMap::new() };
        history.noting(&now, folder, command).map(drop)
    }

    /// Whether an entry is missing for what `paper` asks and its runs in `folder` store.
    pub fn lacks(&self, paper: &Paper, folder: &Path) -> bool {
        self.entry(&Now::new(paper, folder), "").is_some()
    }

    /// The verdicts in `folder`, as they were judged; without a history if that is gone.
    ///
    /// # Errors
    /// Those of [`Verdicts::read`] and of [`read`](Self::read).
    pub fn verdicts(folder: &Path) -> Result<Verdicts, StudyError> {
        let verdicts = Verdicts::read(folder)?;
        let history = Self::read(folder)?;
        let seal = history.seal().and(verdicts.history.clone());
        Ok(Verdicts { history: seal, ..verdicts })
    }

    /// Says in `verdicts` when claims of `paper` were changed, and which were withdrawn without a reason.
    pub fn apply(&self, verdicts: &mut Verdicts, paper: &Paper) {
        verdicts.history = self.seal().map(str::to_owned);
        verdicts.remarks.clone_from(&self.remarks);
        let is_unexplained = |gone: &&(String, usize)| !paper.explains_withdrawn(&gone.0);
        let unexplained = self.withdrawn.iter().filter(is_unexplained);
        verdicts.withdrawn = unexplained.map(|(id, entry)| format!("`{id}` (entry {entry})")).collect();
        for judged in &mut verdicts.claims {
            let known = self.claims.get(&judged.claim);
            judged.changes = known.map_or_else(Vec::new, |known| known.changes.clone());
        }
    }

    /// The text that cites `judged`, one of `verdicts`; `None` if claims or records changed since it was judged.
    pub fn citation(&self, verdicts: &Verdicts, judged: &ClaimVerdict) -> Option<String> {
        let is_current = self.seal().is_some() && self.seal() == verdicts.history.as_deref();
        let known = self.claims.get(&judged.claim).filter(|_| is_current)?;
        Some(citation(verdicts, judged, &version(verdicts, judged, &known.stated.0)))
    }

    /// The seal of the last entry; `None` if there are no entries.
    fn seal(&self) -> Option<&str> {
        Some(self.text.trim_end().rsplit_once(SEAL)?.1)
    }

    /// The history with an entry for what is new `now`, written into `folder`; unchanged if nothing is new.
    fn noting(mut self, now: &Now, folder: &Path, command: &str) -> Result<Self, StudyError> {
        let Some(mut entry) = self.entry(now, command) else { return Ok(self) };
        entry.replaces = if self.entries == 0 { judged_with(folder) } else { None };
        let entry_text =
            toml::to_string(&NewFile { entry: [&entry] }).expect("an entry is texts and numbers");
        let head = if self.text.is_empty() { HEAD } else { "" };
        self.text += &format!("{head}\n{entry_text}\n");
        self.text += &format!("{SEAL}{}\n", sha256(self.text.as_bytes()));
        self.add(&entry);
        remove_temporaries(folder, "history");
        write_whole(&Self::path(folder), self.text.as_bytes())?;
        Ok(self)
    }

    /// The entry for what is new `now`; `None` if nothing is.
    fn entry(&self, now: &Now, command: &str) -> Option<Entry> {
        let is_first = self.entries == 0;
        let is_other_form = !is_first && self.form != FORM;
        let is_known = |id: &String, stated: &Stated| {
            let same = |known: &Known| known.stated.hash() == stated.hash();
            self.claims.get(id).map_or_else(|| self.claims.values().any(same), same)
        };
        let is_seen = |study: &String| self.records.contains_key(study) || now.records.contains_key(study);
        let mut claims = BTreeMap::new();
        let mut after_data = BTreeMap::new();
        for (id, stated) in &now.claims {
            let before = self.claims.get(id);
            if !is_other_form && before.is_some_and(|before| before.stated.hash() == stated.hash()) {
                continue;
            }
            let mut studies =
                before.iter().flat_map(|before| before.stated.studies()).chain(stated.studies());
            let is_after = if is_first {
                now.reasons.contains(id) && !now.records.is_empty()
            } else {
                !is_known(id, stated) && !is_other_form && studies.any(is_seen)
            };
            let list = if is_after { &mut after_data } else { &mut claims };
            list.insert(id.clone(), stated.clone());
        }
        let gone: Vec<String> =
            self.claims.keys().filter(|id| !now.claims.contains_key(*id)).cloned().collect();
        let is_new = |(study, hash): &(&String, &String)| self.records.get(*study) != Some(hash);
        let records: BTreeMap<String, String> =
            now.records.iter().filter(is_new).map(|(study, hash)| (study.clone(), hash.clone())).collect();
        let is_nothing = claims.is_empty() && after_data.is_empty() && gone.is_empty() && records.is_empty();
        let number = self.entries + 1;
        let command = command.to_owned();
        let git = MadeBy::here().git.clone();
        let form = FORM;
        let note = None;
        let replaces = None;
        let entry = Entry { number, command, git, form, note, replaces, gone, records, claims, after_data };
        (!is_nothing).then_some(entry)
    }

    /// What is known after one more entry.
    fn add(&mut self, entry: &Entry) {
        self.entries += 1;
        let number = self.entries;
        if number == 1 && !entry.records.is_empty() && entry.note.is_none() {
            self.remarks.push(BEGINS_LATE.to_owned());
        }
        if entry.replaces.is_some() {
            self.remarks.push("An earlier history of claims was removed.".to_owned());
        }
        if number > 1 && self.form != entry.form {
            self.remarks.push(format!(
                "From entry {number} of `history.toml` on, claims are hashed in another form: a change of a claim just then does not \
                 show."
            ));
        }
        self.form = entry.form;
        let before = self.claims.clone();
        let mut gone: BTreeMap<&String, Known> =
            entry.gone.iter().filter_map(|id| Some((id, self.claims.remove(id)?))).collect();
        for (is_after, (id, stated)) in
            entry.claims.iter().map(|one| (false, one)).chain(entry.after_data.iter().map(|one| (true, one)))
        {
            let same = before.iter().find(|(_, known)| known.stated.hash() == stated.hash());
            let own = before.get(id).or_else(|| same.map(|(_, known)| known));
            let mut changes = own.map_or_else(Vec::new, |known| known.changes.clone());
            gone.retain(|_, known| known.stated.hash() != stated.hash());
            if is_after {
                changes.push(match own {
                    _ if number == 1 => BEFORE.to_owned(),
                    Some(known) => format!("entry {number}: {} to {}", known.stated.hash(), stated.hash()),
                    None => format!("entry {number}: written then, {}", stated.hash()),
                });
            }
            self.claims.insert(id.clone(), Known { stated: stated.clone(), changes });
        }
        let is_seen = |known: &Known| known.stated.studies().any(|study| self.records.contains_key(study));
        let withdrawn = gone.into_iter().filter(|(_, known)| is_seen(known));
        self.withdrawn.extend(withdrawn.map(|(id, _)| (id.clone(), number)));
        self.records.extend(entry.records.clone());
    }
}

impl ClaimVerdict {
    /// When and why its meaning was changed after its data had been seen; `None` if it was not.
    pub fn changed(&self) -> Option<String> {
        let is_told = |change: &&String| self.changed_after_run.is_none() || *change != BEFORE;
        let entries: Vec<&str> = self.changes.iter().filter(is_told).map(String::as_str).collect();
        let entries = (!entries.is_empty()).then(|| format!(" (`history.toml`: {})", entries.join("; ")));
        let why = self.changed_after_run.as_deref().or(entries.as_ref().map(|_| NO_REASON))?;
        Some(format!("{why}{}", entries.unwrap_or_default()))
    }
}

impl Verdicts {
    /// Warnings about claims that were changed or withdrawn after their data were seen, one sentence each.
    pub fn changed(&self) -> Vec<String> {
        let gone = self.history.is_none().then(|| {
            "No history of claims lies beside this run: whether a claim was changed after its data were seen is not known."
                .to_owned()
        });
        let is_unexplained =
            |judged: &&ClaimVerdict| judged.changed_after_run.is_none() && !judged.changes.is_empty();
        let unexplained =
            self.claims.iter().filter(is_unexplained).map(|judged| format!("`{}`", judged.claim));
        let changed = listed(
            "Changed after their data were seen, without a reason given",
            &unexplained.collect::<Vec<_>>(),
        );
        let withdrawn = listed("Withdrawn after their data were seen", &self.withdrawn);
        gone.into_iter().chain(self.remarks.iter().cloned()).chain(changed).chain(withdrawn).collect()
    }
}

/// A sentence that names the first of `all`; `None` if there are none.
fn listed(what: &str, all: &[String]) -> Option<String> {
    let first = all.iter().take(LISTED).cloned().collect::<Vec<String>>().join(", ");
    let rest = if all.len() > LISTED { format!(" and {} more", all.len() - LISTED) } else { String::new() };
    (!all.is_empty()).then(|| format!("{what}: {first}{rest}."))
}

/// The seal of each entry of `text`; `None` if one is not that of the text above it, or text stands behind the last.
fn seals(text: &str) -> Option<Vec<&str>> {
    let mut seals = Vec::new();
    let mut end = 0;
    for line in text.split_inclusive('\n') {
        if let Some(seal) = line.strip_prefix(SEAL) {
            let seal = seal.trim_end();
            (sha256(&text.as_bytes()[..end]) == seal).then(|| seals.push(seal))?;
        }
        end += line.len();
    }
    text.lines().last().is_some_and(|line| line.starts_with(SEAL)).then_some(seals)
}

/// The seal of the history that the verdicts in `folder` were judged with.
fn judged_with(folder: &Path) -> Option<String> {
    let text = fs::read_to_string(folder.join("verdicts.toml")).ok()?;
    let mut head = text.lines().take_while(|line| !line.starts_with('['));
    let seal = head.find_map(|line| line.strip_prefix("history = \""))?;
    Some(seal.trim_end_matches('"').to_owned())
}
