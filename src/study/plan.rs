//! Plans: how the units of a paper's studies are cut into shards.
//!
//! A plan lies beside the parts of its run as `plan.toml`. Whoever comes first writes it. All others read it, so that merging
//! refuses what was cut otherwise.

use super::StudyError;
use super::lock::Lock;
use super::manifest::{MadeBy, Manifest};
use super::runner::BuiltStudy;
use super::shard::{Portion, Shard, shard_of};
use super::store::{journal_units, write_first};
use base::hash::sha256;
use base::settings::Document;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// How a run is cut into shards, and what it depends on, as the plan's file holds it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The paper, as the command line named it.
    pub paper: String,
    /// How many shards there are.
    pub shards: usize,
    /// Cut down by `--quick`.
    pub quick: bool,
    /// The root of every seed, if it is not the studies' own.
    pub seed: Option<u64>,
    /// The options of `--with`, if there were any.
    pub with: Option<String>,
    /// The program that the plan was made by, and with which its parts must run.
    pub made_by: MadeBy,
    /// Which round of an exploration or a confirmation it is, if it is no plain run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub round: Option<PlannedRound>,
    /// What each claim meant when the plan was made: its hash, and the studies that it asks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub claims: BTreeMap<String, Vec<String>>,
    /// The studies, in the order of their names.
    #[serde(rename = "study")]
    pub studies: Vec<PlannedStudy>,
}

/// A round of an exploration or a confirmation: its trials depend on the judgement after the round before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedRound {
    /// The command that runs it: `explore` or `confirm`.
    pub command: String,
    /// The name of the round, which is that of the plan's folder within the folder of all parts.
    pub name: String,
    /// The interpretations that run: the options of each that differ from the defaults.
    pub interpretations: Vec<BTreeMap<String, String>>,
}

/// One study of a plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedStudy {
    /// The study's name, without the paper's.
    pub name: String,
    /// The root of its seeds.
    pub seed: u64,
    /// SHA-256 of what its spec asks to run.
    pub spec: String,
    /// One hash of everything that its trials depend on.
    pub depends: String,
    /// How many units it has.
    pub units: usize,
}

/// The run that a plan is wanted for.
#[derive(Debug, Clone)]
pub struct Wanted {
    /// The paper, as the command line named it.
    pub paper: String,
    /// How many shards.
    pub shards: usize,
    /// Cut down by `--quick`.
    pub quick: bool,
    /// The root of every seed, if it is not the studies' own.
    pub seed: Option<u64>,
    /// The options of `--with`.
    pub with: Option<String>,
    /// The round of an exploration or a confirmation.
    pub round: Option<PlannedRound>,
    /// What each claim means now, for a plan that is made.
    pub claims: BTreeMap<String, Vec<String>>,
}

/// What is known of one shard from its folder alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// All of its records are in place.
    Done,
    /// Somebody is at work on it.
    Running,
    /// It was begun, and nobody is at work on it.
    Stopped,
    /// It was not begun.
    Waiting,
}

/// One shard's state and about how many of its units are done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progressed {
    /// Whether it is done, at work, stopped or waiting.
    pub state: State,
    /// Units that are done.
    pub units: usize,
}

impl Plan {
    /// The plan in `folder`; made and left there if there is none.
    ///
    /// # Errors
    /// [`StudyError::Stored`] if there is one of another run.
    pub fn agreed(
        folder: &Path,
        wanted: &Wanted,
        studies: &[(BuiltStudy<'_>, Manifest)],
    ) -> Result<Self, StudyError> {
        let path = Self::path(folder);
        if !path.exists() {
            let text = toml::to_string(&Self::new(wanted, studies)).expect("a plan is texts and numbers");
            // Two may write at once; the first to be done is the one that all follow.
            write_first(&path, text.as_bytes())?;
        }
        let plan = Self::read(folder)?;
        plan.check(&path, wanted, studies)?;
        Ok(plan)
    }

    fn new(wanted: &Wanted, studies: &[(BuiltStudy<'_>, Manifest)]) -> Self {
        let planned = |(built, manifest): &(BuiltStudy<'_>, Manifest)| PlannedStudy {
            name: manifest.study.clone(),
            seed: manifest.seed,
            spec: manifest.spec.clone(),
            depends: manifest.depends.clone(),
            units: built.units().len(),
        };
        let Wanted { paper, shards, quick, seed, with, round, claims } = wanted.clone();
        let made_by = MadeBy::here().clone();
        let studies = studies.iter().map(planned).collect();
        Self { paper, shards, quick, seed, with, made_by, round, claims, studies }
    }

    /// The plan in `folder`.
    ///
    /// # Errors
    /// [`StudyError::Stored`] if there is none or it cannot be understood.
    pub fn read(folder: &Path) -> Result<Self, StudyError> {
        let path = Self::path(folder);
        if !path.exists() {
            return Err(StudyError::stored(
                &path,
                "no plan; `replan run PAPER --shard K/N --out` this folder makes one",
            ));
        }
        let plan: Self = Document::open(&path)?.read_stored()?;
        if plan.shards == 0 {
            return Err(StudyError::stored(&path, "`shards` is 0; at least 1 is accepted"));
        }
        Ok(plan)
    }

    /// Where the plan lies in `folder`.
    pub fn path(folder: &Path) -> PathBuf {
        folder.join("plan.toml")
    }

    /// SHA-256 of the plan.
    pub fn hash(&self) -> String {
        sha256(toml::to_string(self).expect("a plan is texts and numbers").as_bytes())
    }

    /// The shard of this number.
    pub fn shard(&self, number: usize) -> Shard {
        Shard { number, of: self.shards, plan: self.hash() }
    }

    /// Where the shard of this number keeps its part of the records in `folder`.
    pub fn part(&self, folder: &Path, number: usize) -> PathBuf {
        folder.join(format!("{number}-of-{}", self.shards))
    }

    /// The command that runs a shard into `folder`, where the plan lies: what follows the program's name.
    pub fn arguments(&self, folder: &Path, shard: &str) -> Vec<String> {
        // Rounds have folders of their own in that of all parts.
        let parts = if self.round.is_some() { folder.parent().unwrap_or(folder) } else { folder };
        let shard = ["--shard", shard].map(str::to_owned);
        [self.unsharded(Some(parts)), shard.to_vec()].concat()
    }

    /// The command that does the same whole, on one machine: what follows the program's name.
    pub fn unsharded(&self, out: Option<&Path>) -> Vec<String> {
        let command = self.round.as_ref().map_or("run", |round| &round.command);
        let mut words = [command, &self.paper].map(str::to_owned).to_vec();
        words.extend(out.iter().flat_map(|out| ["--out".to_owned(), out.display().to_string()]));
        if self.quick {
            words.push("--quick".to_owned());
        }
        words.extend(self.seed.iter().flat_map(|seed| ["--seed".to_owned(), seed.to_string()]));
        words.extend(self.with.iter().flat_map(|with| ["--with".to_owned(), with.clone()]));
        words
    }

    /// How many units there are.
    pub fn units(&self) -> usize {
        self.studies.iter().map(|study| study.units).sum()
    }

    /// How many of them the shard of this number runs.
    fn units_of(&self, number: usize) -> usize {
        (self.units() + self.shards - number) / self.shards
    }

    /// The shard of every unit of each study.
    pub fn cut(&self) -> Vec<Vec<usize>> {
        let mut shards = (0..).map(|unit| shard_of(unit, self.shards));
        self.studies.iter().map(|planned| shards.by_ref().take(planned.units).collect()).collect()
    }

    /// What of each study the shard of this number runs.
    pub fn portions(&self, number: usize) -> Vec<Portion> {
        let own = |shards: Vec<usize>| -> BTreeSet<usize> {
            shards
                .into_iter()
                .enumerate()
                .filter(|(_, shard)| *shard == number)
                .map(|(unit, _)| unit)
                .collect()
        };
        let portion = |shards| Portion { shard: self.shard(number), units: own(shards) };
        self.cut().into_iter().map(portion).collect()
    }

    /// Refuses a plan of another run than `wanted`.
    fn check(
        &self,
        path: &Path,
        wanted: &Wanted,
        studies: &[(BuiltStudy<'_>, Manifest)],
    ) -> Result<(), StudyError> {
        let mut other = Differences(Vec::new());
        let mut differs =
            |what: &str, planned: String, requested: String| other.note(what, &planned, &requested);
        let shown = |with: &Option<String>| with.clone().unwrap_or_else(|| "the default".to_owned());
        let names = |names: &mut dyn Iterator<Item = &str>| names.collect::<Vec<_>>().join(", ");
        differs("command", command(self.round.as_ref()), command(wanted.round.as_ref()));
        differs("shards", self.shards.to_string(), wanted.shards.to_string());
        differs("quick", self.quick.to_string(), wanted.quick.to_string());
        differs("options", shown(&self.with), shown(&wanted.with));
        differs(
            "studies",
            names(&mut self.studies.iter().map(|study| study.name.as_str())),
            names(&mut studies.iter().map(|(_, manifest)| manifest.study.as_str())),
        );
        for (planned, (_, manifest)) in self.studies.iter().zip(studies) {
            let of = |what: &str| format!("study {}: {what}", planned.name);
            differs(&of("seed"), planned.seed.to_string(), manifest.seed.to_string());
            differs(&of("spec"), brief(&planned.spec), brief(&manifest.spec));
            differs(&of("what trials depend on"), brief(&planned.depends), brief(&manifest.depends));
        }
        unlike(&self.made_by, MadeBy::here()).for_each(|[what, own, here]| other.note(&what, &own, &here));
        if other.0.is_empty() {
            return Ok(());
        }
        let other = other.0.join("; ");
        let reason = format!("the parts here are of another run: {other}; another folder is accepted");
        Err(StudyError::stored(path, reason))
    }

    /// What the folder of a part tells of its shard.
    pub fn progressed(&self, folder: &Path, number: usize) -> Progressed {
        let part = self.part(folder, number);
        let whole = |study: &&PlannedStudy| Manifest::path(&part, &study.name).exists();
        let units = self.units_of(number);
        if self.studies.iter().all(|study| whole(&study)) {
            return Progressed { state: State::Done, units };
        }
        // What a study has done stands in its journal until its records do.
        let done = |study: &PlannedStudy| {
            if whole(&study) { study.units / self.shards } else { journal_units(&part, &study.name) }
        };
        let state = match part.is_dir() {
            false => State::Waiting,
            true if Lock::is_held(&part) => State::Running,
            true => State::Stopped,
        };
        Progressed { state, units: self.studies.iter().map(done).sum::<usize>().min(units) }
    }
}

/// What a plan is of, in words.
fn command(round: Option<&PlannedRound>) -> String {
    let of = |round: &PlannedRound| {
        let interpretations = sha256(format!("{:?}", round.interpretations).as_bytes());
        let PlannedRound { command, name, interpretations: each } = round;
        format!(
            "`{command}`, round `{name}` under {} interpretations ({})",
            each.len(),
            brief(&interpretations)
        )
    };
    round.map_or_else(|| "`run`".to_owned(), of)
}

/// What differs from what is wanted.
struct Differences(Vec<String>);

impl Differences {
    fn note(&mut self, what: &str, found: &str, wanted: &str) {
        if found != wanted {
            self.0.push(format!("{what} {found}, not {wanted}"));
        }
    }
}

/// The difference between two programs whose records must not be mixed: its name, and its value in each.
pub fn unlike<'m>(one: &'m MadeBy, other: &'m MadeBy) -> impl Iterator<Item = [String; 3]> + use<'m> {
    let shown = |text: Option<&String>| text.map_or_else(|| "unknown".to_owned(), |text| brief(text));
    let pairs = [
        ("version", Some(&one.replan), Some(&other.replan)),
        ("revision", one.git.as_ref(), other.git.as_ref()),
        ("Cargo.lock", one.lock.as_ref(), other.lock.as_ref()),
    ];
    let differ = pairs.into_iter().filter(|(_, one, other)| one != other);
    differ.map(move |(what, one, other)| [what.to_owned(), shown(one), shown(other)])
}

/// So much of a hash as tells two apart.
pub fn brief(hash: &str) -> String {
    hash.chars().take(12).collect()
}
