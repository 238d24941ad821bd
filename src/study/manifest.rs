//! Everything that a study's records depend on, so that a stored trial is reused only if none of it has changed.

mod hashes;
mod held;

pub use hashes::Hashes;

use super::checked::Study;
use super::choice::Interpretation;
use super::defaults::defaults;
use super::error::{REMEDY, StudyError};
use super::key::{InstanceKey, InterpretationKey, Text};
use super::name;
use super::runner::{BuiltStudy, SESSION};
use super::shard::{Portion, Shard};
use super::store::{Staged, part_path};
use base::hash::sha256;
use base::settings::Document;
use hashes::{changes, contender_hashes, hash_of, problem_hashes};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// What stands in `<study>.manifest.toml`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The study's name, without the paper's.
    pub study: String,
    /// The command that made the records.
    pub command: String,
    /// Cut down by `--quick`.
    pub quick: bool,
    /// The root of every seed.
    pub seed: u64,
    /// The choices that touch trials.
    pub choices: Vec<String>,
    /// The interpretations that were run: the option of each of the choices.
    pub interpretations: Vec<Vec<String>>,
    /// SHA-256 of what the spec asks to run; its comments, question and figures do not count.
    pub spec: String,
    /// One hash of everything below that trials depend on.
    pub depends: String,
    /// Contenders whose trials are bound to a clock: they were recorded, and are run again only with `--record`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recorded: Vec<String>,
    /// Where the records come from, if no run of ours made them: the file, and SHA-256 of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elsewhere: Option<String>,
    /// What the spec leaves out, with the value used.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub defaults: Vec<String>,
    /// The program and the machine.
    pub made_by: MadeBy,
    /// Which part of a run the records are, if it was cut into shards.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<Shard>,
    /// SHA-256 of every input file.
    pub inputs: BTreeMap<String, String>,
    /// Where clocks were read, and which.
    #[serde(default, rename = "session")]
    pub sessions: Vec<Session>,
    /// What each problem group depends on, at each point of the sweeps over it.
    pub problems: Hashes,
    /// What each contender depends on.
    pub contenders: Hashes,
    /// SHA-256 of each record file.
    pub files: BTreeMap<String, String>,
}

/// One session of the clock; times of different sessions are never pooled.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Session {
    /// Its number, from 1, as rows of times have it.
    pub number: u32,
    /// The git revision of the program.
    pub git: Option<String>,
    /// The compiler.
    pub rustc: Option<String>,
    /// The processor.
    pub cpu: Option<String>,
}

/// The program and the machine; what cannot be found out is absent.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MadeBy {
    /// The version of replan.
    pub replan: String,
    /// The git revision of the working tree.
    pub git: Option<String>,
    /// Whether the working tree had no changes when the command began, outputs of runs aside.
    pub clean: Option<bool>,
    /// The compiler.
    pub rustc: Option<String>,
    /// SHA-256 of Cargo.lock.
    pub lock: Option<String>,
    /// The processor.
    pub cpu: Option<String>,
}

impl Manifest {
    /// The manifest of `study` under `points`, without record files yet.
    ///
    /// # Errors
    /// [`StudyError::Io`] if an input file has gone.
    pub fn new(
        study: &Study,
        points: &[Interpretation],
        built: &BuiltStudy<'_>,
        command: String,
        quick: bool,
    ) -> Result<Self, StudyError> {
        let inputs = built.inputs()?;
        let choices = study.key_columns().choices;
        let interpretations = points.iter().map(|p| p.key(&study.choices));
        let option = |(_, option): &(Text, Text)| option.to_string();
        let interpretations = interpretations.map(|key| key.options().iter().map(option).collect()).collect();
        let problems = problem_hashes(study, points, built)?;
        let contenders = contender_hashes(study, points, built)?;
        let depends = sha256(format!("{quick}\n{problems:?}\n{contenders:?}").as_bytes());
        let made_by = MadeBy::here().clone();
        Ok(Self {
            study: study.name.clone(),
            command,
            quick,
            seed: study.seed,
            choices: choices.iter().map(ToString::to_string).collect(),
            interpretations,
            spec: study.run_hash(),
            depends,
            recorded: study.recorded().map(str::to_owned).collect(),
            elsewhere: None,
            defaults: defaults(study),
            sessions: study.timing.iter().map(|_| Session::here(&made_by)).collect(),
            made_by,
            shard: None,
            inputs,
            problems,
            contenders,
            files: BTreeMap::new(),
        })
    }

    /// One hash of all record files.
    pub fn records_hash(&self) -> String {
        sha256(format!("{:?}", self.files).as_bytes())
    }

    /// Turns it into the manifest of a portion of the run, which reads no clock, and gives the units of the portion.
    pub fn cut_to<'p>(&mut self, portion: &'p Portion) -> &'p BTreeSet<usize> {
        self.shard = Some(portion.shard.clone());
        self.sessions.clear();
        &portion.units
    }

    /// Where the manifest of `study` lies in `folder`.
    pub fn path(folder: &Path, study: &str) -> PathBuf {
        folder.join(format!("{study}.manifest.toml"))
    }

    /// Reads the manifest of `study` in `folder`.
    ///
    /// # Errors
    /// [`StudyError::Stored`] if there is none, [`StudyError::Touched`] if it cannot be understood.
    pub fn read(folder: &Path, study: &str) -> Result<Self, StudyError> {
        let path = Self::path(folder, study);
        let manifest = Self::read_unsealed(folder, study)?;
        check_seal(&path).map(|()| manifest)
    }

    /// As [`read`](Self::read), whatever its seal says: files that it names are held against their hashes all the same.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub(super) fn read_unsealed(folder: &Path, study: &str) -> Result<Self, StudyError> {
        let path = Self::path(folder, study);
        if !path.exists() {
            let missing = "no stored run; run the study first";
            return Err(if part_path(folder, study, "trials").exists() {
                StudyError::Touched(format!("{}: {missing}", path.display()))
            } else {
                StudyError::stored(&path, missing)
            });
        }
        Self::read_file(&path)
    }

    /// Reads the manifest in the file at `path`, without its seal.
    fn read_file(path: &Path) -> Result<Self, StudyError> {
        let read = Document::open(path).and_then(|document| document.read_stored());
        read.map_err(|error| StudyError::touched(error, REMEDY))
    }

    /// Reads a manifest that a killed run left beside its place; `None` if it is not whole.
    pub(super) fn read_left(path: &Path) -> Option<Self> {
        let manifest = Self::read_file(path).ok()?;
        check_seal(path).ok().map(|()| manifest)
    }

    /// Stages the manifest for `folder`.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn stage(&self, staged: &mut Staged, folder: &Path) -> Result<(), StudyError> {
        let text = toml::to_string(self).expect("a manifest is strings, numbers and tables of them");
        let sealed = format!("{SEAL}{}\n{text}", sha256(text.as_bytes()));
        staged.add(&Self::path(folder, &self.study), sealed.as_bytes())
    }

    /// Whether the run that `before` describes gave all that this one would give, times among it: a run that
    /// was put together of parts has none yet.
    pub fn is_as(&self, before: &Self) -> bool {
        self.gives() == before.gives()
    }

    /// The parts that say which trials and times the run gave, and under which defaults.
    fn gives(&self) -> impl PartialEq {
        let Self { spec, depends, recorded, defaults, choices, interpretations, shard, sessions, .. } = self;
        (spec, depends, recorded, defaults, choices, interpretations, shard, sessions.is_empty())
    }

    /// Whether trials ran under the interpretation.
    pub fn covers(&self, interpretation: &InterpretationKey) -> bool {
        self.place(interpretation).is_some()
    }

    /// The number of the interpretation.
    fn place(&self, interpretation: &InterpretationKey) -> Option<usize> {
        let options = interpretation.options();
        let is_same = |run: &Vec<String>| {
            run.len() == options.len() && run.iter().zip(options).all(|(run, (_, option))| **run == **option)
        };
        let are_choices = self.choices.len() == options.len()
            && self.choices.iter().zip(options).all(|(choice, (id, _))| **choice == **id);
        self.interpretations.iter().position(is_same).filter(|_| are_choices)
    }

    /// What the problem group of `on` depends on at its point of the sweeps, under its interpretation.
    pub fn problem(&self, on: &InstanceKey) -> Option<&str> {
        hash_of(&self.problems, &name::group(&on.group, &on.sweep), self.place(&on.interpretation)?)
    }

    /// What the contender called `label` depends on under the interpretation.
    pub fn contender(&self, interpretation: &InterpretationKey, label: &str) -> Option<&str> {
        hash_of(&self.contenders, label, self.place(interpretation)?)
    }

    /// How the settings of this study differ from those of `before`, each under its defaults.
    pub fn set_otherwise(&self, before: &Self) -> Vec<String> {
        let [first, second] = [before.seed, self.seed];
        let seeds = (first != second).then(|| format!("seed {first} and {second}"));
        let problems = changes("problem group", &self.problems, &before.problems, &[[0, 0]]);
        let contenders = changes("contender", &self.contenders, &before.contenders, &[[0, 0]]);
        seeds.into_iter().chain(problems).chain(contenders).collect()
    }

    /// Why stored trials of `before` cannot stand for those of this manifest: one sentence a reason.
    pub fn differs_from(&self, before: &Self) -> Vec<String> {
        let mut reasons = Vec::new();
        if self.quick != before.quick {
            reasons.push("one of the runs is quick and the other full".to_owned());
        }
        if self.choices != before.choices {
            reasons.push(format!(
                "the choices that touch trials are {}; they were {}",
                listed(&self.choices),
                listed(&before.choices)
            ));
            return reasons;
        }
        let theirs = |run: &Vec<String>| before.interpretations.iter().position(|other| other == run);
        let both: Vec<[usize; 2]> = self
            .interpretations
            .iter()
            .enumerate()
            .filter_map(|(ours, run)| Some([ours, theirs(run)?]))
            .collect();
        let new = self.interpretations.len() - both.len();
        if new > 0 {
            reasons.push(format!("{new} of {} interpretations are new", self.interpretations.len()));
        }
        for (what, ours, theirs) in [
            ("problem group", &self.problems, &before.problems),
            ("contender", &self.contenders, &before.contenders),
        ] {
            reasons.extend(changes(what, ours, theirs, &both));
        }
        reasons
    }
}

fn listed(choices: &[String]) -> String {
    if choices.is_empty() { "none".to_owned() } else { choices.join(", ") }
}

impl Session {
    /// The one session of a run, on this machine.
    pub(super) fn here(made_by: &MadeBy) -> Self {
        let MadeBy { git, rustc, cpu, .. } = made_by.clone();
        Self { number: SESSION, git, rustc, cpu }
    }
}

/// How the first line of a manifest begins, which bears the SHA-256 of all lines below it.
const SEAL: &str = "# seal: ";

/// Refuses a manifest whose lines are not those that were sealed. One without a seal is of an older form.
fn check_seal(path: &Path) -> Result<(), StudyError> {
    let text = base::file::read_text(path).map_err(StudyError::io(path, "reading the manifest"))?;
    let Some((seal, rest)) = text.strip_prefix(SEAL).and_then(|text| text.split_once('\n')) else {
        return Ok(());
    };
    if sha256(rest.as_bytes()) == seal {
        return Ok(());
    }
    let place = path.display();
    Err(StudyError::Touched(format!("{place}: its lines are not those that its seal was made of; {REMEDY}")))
}

/// What a run itself writes does not make the tree that it runs from unclean.
const OUTPUTS: [&str; 3] = ["data/runs", "plots", "paper_repro.md"];

impl MadeBy {
    /// What is true at the first call, before this process has written anything.
    pub fn here() -> &'static Self {
        static HERE: OnceLock<MadeBy> = OnceLock::new();
        HERE.get_or_init(|| Self::found(Path::new(".")))
    }

    /// What is true of the program and of the working tree that `folder` lies in.
    fn found(folder: &Path) -> Self {
        let output_of = |program: &str, arguments: &[&str]| {
            let output = Command::new(program).args(arguments).current_dir(folder).output().ok()?;
            let text = String::from_utf8(output.stdout).ok()?.trim().to_owned();
            output.status.success().then_some(text)
        };
        let cpu = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
            let line = text.lines().find(|line| line.starts_with("model name"))?;
            Some(line.split_once(':')?.1.trim().to_owned())
        });
        let outputs = OUTPUTS.map(|path| format!(":(top,exclude){path}"));
        let mut status = vec!["status", "--porcelain", "--", ":(top)"];
        status.extend(outputs.iter().map(String::as_str));
        Self {
            replan: env!("CARGO_PKG_VERSION").to_owned(),
            git: output_of("git", &["rev-parse", "HEAD"]),
            clean: output_of("git", &status).map(|text| text.is_empty()),
            rustc: output_of("rustc", &["--version"]),
            lock: fs::read(folder.join("Cargo.lock")).ok().map(|bytes| sha256(&bytes)),
            cpu,
        }
    }
}

#[cfg(test)]
mod tests;
