//! What a study's records depend on, so that a stored trial is reused only if nothing of it has changed.

use super::checked::Study;
use super::contender::SweepPoint;
use super::error::StudyError;
use super::reading::ReadingChoice;
use super::runner::BuiltStudy;
use super::store::Staged;
use base::hash::sha256;
use base::settings::Document;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// What stands in `<study>.manifest.toml`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The study.
    pub study: String,
    /// The command that made the records.
    pub command: String,
    /// Cut down by `--quick`.
    pub quick: bool,
    /// The root of every seed.
    pub seed: u64,
    /// The readings that were run.
    pub readings: Vec<String>,
    /// SHA-256 of the spec.
    pub spec: String,
    /// SHA-256 of the paper's claims.
    pub claims: String,
    /// One hash of everything below that trials depend on.
    pub depends: String,
    /// The program and the machine.
    pub made_by: MadeBy,
    /// SHA-256 of every input file.
    pub inputs: BTreeMap<String, String>,
    /// What each problem group depends on, by reading and label.
    pub problems: BTreeMap<String, String>,
    /// What each contender depends on, by reading and label.
    pub contenders: BTreeMap<String, String>,
    /// SHA-256 of each record file.
    pub files: BTreeMap<String, String>,
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
        points: &[ReadingChoice],
        built: &BuiltStudy<'_>,
        claims: String,
        command: String,
        quick: bool,
    ) -> Result<Self, StudyError> {
        let mut inputs = BTreeMap::new();
        let folder = study.document.path().parent().unwrap_or(Path::new(""));
        for path in built.inputs() {
            let bytes = fs::read(&path).map_err(StudyError::io(&path, "reading an input file"))?;
            // A file of the paper's own folder is named from there, so that it is the same however the folder is spelled.
            let name = path.strip_prefix(folder).unwrap_or(&path);
            inputs.insert(name.display().to_string(), sha256(&bytes));
        }
        let problems = problem_hashes(study, points, &inputs);
        let contenders = contender_hashes(study, points);
        let depends = sha256(format!("{quick}\n{problems:?}\n{contenders:?}").as_bytes());
        Ok(Self {
            study: study.name.clone(),
            command,
            quick,
            seed: study.seed,
            readings: points.iter().map(|point| point.name().to_owned()).collect(),
            spec: sha256(study.document.text().as_bytes()),
            claims,
            depends,
            made_by: MadeBy::here().clone(),
            inputs,
            problems,
            contenders,
            files: BTreeMap::new(),
        })
    }

    /// Where the manifest of `study` lies in `folder`.
    pub fn path(folder: &Path, study: &str) -> PathBuf {
        folder.join(format!("{study}.manifest.toml"))
    }

    /// Reads the manifest of `study` in `folder`.
    ///
    /// # Errors
    /// [`StudyError::Stored`] if there is none or it cannot be understood.
    pub fn read(folder: &Path, study: &str) -> Result<Self, StudyError> {
        let path = Self::path(folder, study);
        if !path.exists() {
            return Err(StudyError::stored(&path, "no stored run; run the study first"));
        }
        Ok(Document::open(&path)?.read_stored()?)
    }

    /// Stages the manifest for `folder`.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn stage(&self, staged: &mut Staged, folder: &Path) -> Result<(), StudyError> {
        let text = toml::to_string(self).expect("a manifest is strings, numbers and tables of them");
        staged.add(&Self::path(folder, &self.study), text.as_bytes())
    }

    /// Why stored trials of `before` cannot stand for those of this manifest: one sentence a reason.
    pub fn differs_from(&self, before: &Self) -> Vec<String> {
        let mut reasons = Vec::new();
        for (what, ours, theirs) in [
            ("problem group", &self.problems, &before.problems),
            ("contender", &self.contenders, &before.contenders),
        ] {
            for (name, hash) in ours {
                match theirs.get(name) {
                    None => reasons.push(format!("{what} `{name}` is new")),
                    Some(other) if other != hash => reasons.push(format!("{what} `{name}` has changed")),
                    Some(_) => {}
                }
            }
            let gone = theirs.keys().filter(|name| !ours.contains_key(*name));
            reasons.extend(gone.map(|name| format!("{what} `{name}` is gone")));
        }
        if self.quick != before.quick {
            reasons.push("one of the runs is quick and the other full".to_owned());
        }
        reasons
    }
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
        let said = |program: &str, arguments: &[&str]| {
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
            git: said("git", &["rev-parse", "HEAD"]),
            clean: said("git", &status).map(|text| text.is_empty()),
            rustc: said("rustc", &["--version"]),
            lock: fs::read(folder.join("Cargo.lock")).ok().map(|bytes| sha256(&bytes)),
            cpu,
        }
    }
}

/// The key of a problem group or contender under a reading.
pub fn key(point: &str, label: &str) -> String {
    if point == "default" { label.to_owned() } else { format!("{label} / {point}") }
}

fn problem_hashes(
    study: &Study,
    points: &[ReadingChoice],
    inputs: &BTreeMap<String, String>,
) -> BTreeMap<String, String> {
    let mut hashes = BTreeMap::new();
    for point in points {
        for group in &study.groups {
            let settings = point
                .over_problem()
                .fold(group.settings.clone(), |s, (over, origin)| s.overlaid(over, origin));
            let text = format!(
                "{} {} {} {} {:?} {} {} {} {:?} {:?} {:?} {inputs:?}",
                study.paper,
                study.name,
                study.seed,
                group.label,
                study.budget,
                study.task.name,
                study.task.revision,
                group.family.name,
                group.family.revision,
                (settings.table(), study.task_settings.table()),
                study.kept().filter(|trials| trials.problems == group.label).collect::<Vec<_>>(),
            );
            hashes.insert(key(point.name(), &group.label), sha256(text.as_bytes()));
        }
    }
    hashes
}

fn contender_hashes(study: &Study, points: &[ReadingChoice]) -> BTreeMap<String, String> {
    let mut hashes = BTreeMap::new();
    for point in points {
        for contender in &study.contenders {
            let sweeps: Vec<SweepPoint> = study.sweep_points();
            let mut text = format!("{} {}", contender.label, contender.repeats);
            for stage in &contender.stages {
                let entry = stage.entry;
                text += &format!("\n{} {}", entry.name, entry.revision);
                for sweep in &sweeps {
                    text += &format!(" {} {:?}", sweep.name, stage.effective(point, sweep).table());
                }
            }
            hashes.insert(key(point.name(), &contender.label), sha256(text.as_bytes()));
        }
    }
    hashes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_of_runs_leave_a_tree_clean_and_any_other_change_does_not() {
        let folder = tempfile::tempdir().unwrap();
        let git = |arguments: &[&str]| {
            let name = ["-c", "user.name=n", "-c", "user.email=e"];
            let mut command = Command::new("git");
            let done = command.current_dir(folder.path()).args(name).args(arguments).output().unwrap();
            assert!(done.status.success(), "{arguments:?}: {done:?}");
        };
        let write = |name: &str| {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, name).unwrap();
        };
        let clean = || MadeBy::found(folder.path()).clean;
        git(&["init", "--quiet"]);
        write("spec.toml");
        git(&["add", "."]);
        git(&["commit", "--quiet", "-m", "first"]);
        assert_eq!(clean(), Some(true));
        for output in ["data/runs/p/s.manifest.toml", "plots/p/fig1.svg", "paper_repro.md"] {
            write(output);
            assert_eq!(clean(), Some(true), "{output}");
        }
        assert_eq!(MadeBy::found(&folder.path().join("data/runs")).clean, Some(true), "seen from below");
        write("data/robots/r.toml");
        assert_eq!(clean(), Some(false));
        fs::remove_dir_all(folder.path().join("data/robots")).unwrap();
        fs::write(folder.path().join("spec.toml"), "changed").unwrap();
        assert_eq!(clean(), Some(false));
    }
}
