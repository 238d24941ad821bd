//! `replan pack`: a run for a reviewer, as one folder that needs no network.
//!
//! A pack is an RO-Crate: specs, input files, records, verdicts, tables and figures, the HTML page, and how to run it
//! again. It is laid out as a project, so every command of replan works inside it. `SHA256SUMS` has the hash of each
//! file, which `sha256sum --check` and `replan check PACK` verify.

use super::places::Places;
use super::progress::{doing, stop_flag};
use super::{Failure, How, Which, judge, render, report};
use crate::analysis::compare::stored_studies;
use crate::analysis::tabulated::texts_in;
use crate::analysis::verdict::Verdicts;
use base::hash::sha256;
use clap::Args;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};
use study::StudyError;
use study::manifest::Manifest;
use study::paper::{Paper, is_day};
use study::store::Staged;

/// Writes a pack.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Pack {
    #[command(flatten)]
    which: Which,
    /// The folder to write, which must be new or empty
    #[arg(long, value_name = "DIR")]
    to: PathBuf,
    /// The day of publication, as 2026-01-31
    #[arg(long, value_name = "DAY", value_parser = day)]
    date: String,
    /// The address of the licence; the LICENSE file of the project if absent
    #[arg(long, value_name = "URL")]
    license: Option<String>,
}

const EXAMPLES: &str = "Examples:
  replan pack zhang --to zhang-pack --date 2026-01-31";

/// The file with the hash of each other file.
const SUMS: &str = "SHA256SUMS";
/// The file that makes a folder an RO-Crate.
const METADATA: &str = "ro-crate-metadata.json";

/// The licence of replan itself, by its address.
const OWN_LICENSE: &str = concat!("https://spdx.org/licenses/", env!("CARGO_PKG_LICENSE"));

/// `text`, if it is a day.
pub(super) fn day(text: &str) -> Result<String, String> {
    if is_day(text) { Ok(text.to_owned()) } else { Err("a day as 2026-01-31 is accepted".to_owned()) }
}

impl Pack {
    /// The pack of `paper`, in the folder `to`.
    pub(super) fn new(paper: String, to: PathBuf, date: String, license: Option<String>) -> Self {
        Self { which: Which { paper, out: None }, to, date, license }
    }

    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let is_free = fs::read_dir(&self.to).map_or(true, |mut entries| entries.next().is_none());
        if !is_free {
            return Err(Failure::input(format!(
                "{} is not empty; a new folder is accepted",
                self.to.display()
            )));
        }
        let (places, paper) = super::load::open(&self.which, &How::plain(None))?;
        let verdicts = Verdicts::read(&places.runs)?;
        super::places::check_stored(&places.runs)?;
        // What the README promises a reviewer: verdicts follow from records, tables and figures from both.
        judge::check(&paper, How::plain(None).interpretation(&paper.choices)?, &places)?;
        render::check(&paper, &places, None, stop_flag())?;
        doing(&format!("{}: writing its page", paper.id));
        let page = tempfolder(&self.to)?;
        let written = report::write(&places, &page, false).1;
        let files = written.and_then(|()| files(&paper, &places, &page));
        // What is left of it does no harm but taking room.
        let _ = fs::remove_dir_all(&page);
        let mut files = files?;
        let license = self.license(&places, &files)?;
        files.insert("README.md".to_owned(), readme(&paper, &verdicts).into_bytes());
        let metadata = self.metadata(&paper, &verdicts, &license, &files, &makers(&places.runs)?);
        files.insert(METADATA.to_owned(), format!("{metadata:#}\n").into_bytes());
        let sums = files.iter().map(|(name, bytes)| format!("{}  {name}\n", sha256(bytes)));
        let sums = sums.collect::<Vec<_>>().concat();
        let mut staged = Staged::default();
        for (name, bytes) in &files {
            staged.add(&self.to.join(name), bytes)?;
        }
        staged.add(&self.to.join(SUMS), sums.as_bytes())?;
        staged.put()?;
        say!(
            "{} files of {} are in {}; `replan check {}` verifies them",
            files.len() + 1,
            paper.id,
            self.to.display(),
            self.to.display()
        );
        Ok(())
    }

    fn license(&self, places: &Places, files: &BTreeMap<String, Vec<u8>>) -> Result<String, Failure> {
        let own = files.contains_key("LICENSE").then(|| "LICENSE".to_owned());
        self.license.clone().or(own).ok_or_else(|| {
            let home = if places.home.as_os_str().is_empty() {
                ".".to_owned()
            } else {
                places.home.display().to_string()
            };
            Failure::input(format!("{home} has no LICENSE; `--license` with the address of one is accepted"))
        })
    }

    /// The crate's description.
    ///
    /// # Source
    /// RO-Crate 1.1, <https://w3id.org/ro/crate/1.1>.
    fn metadata(
        &self,
        paper: &Paper,
        verdicts: &Verdicts,
        license: &str,
        files: &BTreeMap<String, Vec<u8>>,
        makers: &str,
    ) -> Value {
        let reference = |id: &str| json!({ "@id": id });
        let part = |(name, bytes): (&String, &Vec<u8>)| {
            json!({
                "@id": encoded(name), "@type": "File", "name": name, "encodingFormat": format_of(name),
                "contentSize": bytes.len().to_string(), "sha256": sha256(bytes),
            })
        };
        let of = |folder: &str| -> Vec<Value> {
            files
                .keys()
                .filter(|name| name.starts_with(folder))
                .map(|name| reference(&encoded(name)))
                .collect()
        };
        let all: Vec<Value> = files.keys().map(|name| reference(&encoded(name))).collect();
        let title = &paper.source.title;
        let mut graph = vec![
            json!({
                "@id": METADATA, "@type": "CreativeWork", "about": reference("./"),
                "conformsTo": reference("https://w3id.org/ro/crate/1.1"),
            }),
            json!({
                "@id": "./", "@type": "Dataset", "name": format!("Reproduction of: {title}"),
                "description": format!(
                    "Specs, records, verdicts, tables and figures by which replan judges {} claims of the paper.",
                    verdicts.claims.len()
                ),
                "datePublished": self.date, "license": reference(license), "hasPart": all,
                "version": seal(verdicts), "mentions": reference("#run"), "isBasedOn": reference("#paper"),
            }),
            json!({
                "@id": "#replan", "@type": "SoftwareApplication", "name": "replan",
                "version": env!("CARGO_PKG_VERSION"), "license": reference(OWN_LICENSE),
            }),
            json!({
                "@id": "#run", "@type": "CreateAction", "name": verdicts.command, "description": makers,
                "instrument": reference("#replan"), "object": of("experiments/"), "result": of("data/runs/"),
            }),
        ];
        let mut about = json!({ "@id": "#paper", "@type": "ScholarlyArticle", "name": title });
        if let Some(authors) = &paper.source.authors {
            about["creditText"] = authors.as_str().into();
        }
        graph.push(about);
        let addresses = BTreeSet::from([OWN_LICENSE, license]).into_iter().filter(|one| *one != "LICENSE");
        let license = |one| json!({ "@id": one, "@type": "CreativeWork", "name": "Licence", "description": "A licence, by its address." });
        graph.extend(addresses.map(license));
        graph.extend(files.iter().map(part));
        json!({ "@context": "https://w3id.org/ro/crate/1.1/context", "@graph": graph })
    }
}

/// Every file but those about the pack itself, by its name there.
fn files(paper: &Paper, places: &Places, page: &Path) -> Result<BTreeMap<String, Vec<u8>>, Failure> {
    let mut files = BTreeMap::new();
    let id = &paper.id;
    add_folder(&mut files, &format!("experiments/{id}/"), &places.folder)?;
    add_folder(&mut files, &format!("data/runs/{id}/"), &places.runs)?;
    add_folder(&mut files, &format!("plots/{id}/"), &places.plots)?;
    add_folder(&mut files, "page/", page)?;
    for study in stored_studies(&places.runs) {
        for name in Manifest::read(&places.runs, &study)?.inputs.keys() {
            let is_plain = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
            let path = places.inputs.locate(name).map_err(Failure::input)?;
            if path.starts_with(&places.folder) {
                continue;
            }
            if !is_plain {
                return Err(Failure::input(format!(
                    "input `{name}` lies outside of the project; a copy in the paper's folder is accepted"
                )));
            }
            files.insert(name.clone(), read(&path)?);
        }
    }
    let license = places.home.join("LICENSE");
    if license.is_file() {
        files.insert("LICENSE".to_owned(), read(&license)?);
    }
    add_named(&mut files, places)?;
    Ok(files)
}

/// Adds what the specs among `files` name and no record rests on: robots and scenes of other options, planners' files, sets of problems
/// of the cross-check. What an installation brings lies in `target` and is not packed.
fn add_named(files: &mut BTreeMap<String, Vec<u8>>, places: &Places) -> Result<(), Failure> {
    let mut left: Vec<String> =
        files.keys().filter(|name| name.starts_with("experiments/")).cloned().collect();
    while let Some(spec) = left.pop() {
        if Path::new(&spec).extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let text = String::from_utf8_lossy(&files[&spec]);
        let table: toml::Table = text.parse().unwrap_or_default();
        for name in table.values().flat_map(texts_in).map(str::to_owned) {
            let mut parts = Path::new(&name).components();
            let is_plain = name.contains('/') && parts.all(|part| matches!(part, Component::Normal(_)));
            if !is_plain || name.starts_with("target/") || files.contains_key(&name) {
                continue;
            }
            let found = places.inputs.locate(&name).ok();
            if let Some(path) = found.filter(|path| !path.starts_with(&places.folder)) {
                files.insert(name.clone(), read(&path)?);
                left.push(name);
            }
        }
    }
    Ok(())
}

/// The programs and processors that made the records in `runs`, in words.
fn makers(runs: &Path) -> Result<String, Failure> {
    let mut makers = BTreeSet::new();
    for study in stored_studies(runs) {
        let Manifest { made_by, elsewhere, .. } = Manifest::read(runs, &study)?;
        let revision = made_by.git.map(|git| format!("revision {git}"));
        let by = [Some(format!("replan {}", made_by.replan)), revision, made_by.rustc, made_by.cpu];
        let own = by.into_iter().flatten().collect::<Vec<_>>().join(", ");
        makers.insert(elsewhere.map_or(own, |file| format!("recorded elsewhere, in {file}")));
    }
    Ok(makers.into_iter().collect::<Vec<_>>().join("; "))
}

/// The version by which these verdicts can be cited; it changes whenever one of them does.
pub fn seal(verdicts: &Verdicts) -> String {
    sha256(verdicts.text().as_bytes())[..16].to_owned()
}

fn readme(paper: &Paper, verdicts: &Verdicts) -> String {
    let id = &paper.id;
    format!(
        "# {}\n\nOpen `page/{id}.html`: every claim with its verdict and its evidence. LaTeX tables and figures are in `plots/{id}/`.\n\n\
         Verdicts {}, by replan {}. {}\n\n    sha256sum --check SHA256SUMS        # the files are those of the pack\n    \
         replan check .                      # the same, with records and verdicts by their seals\n    \
         replan judge {id} --check            # the verdicts follow from the records\n    \
         replan repro {id} --fresh            # run every trial again\n",
        paper.source.title,
        seal(verdicts),
        env!("CARGO_PKG_VERSION"),
        verdicts.counts().verdicts()
    )
}

/// A folder beside the pack for the page, which is written by its own command.
fn tempfolder(to: &Path) -> Result<PathBuf, Failure> {
    let mut name = to.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.page", std::process::id()));
    let folder = to.with_file_name(name);
    fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// Adds every file below `folder` that is neither hidden nor half-written.
fn add_folder(files: &mut BTreeMap<String, Vec<u8>>, to: &str, folder: &Path) -> Result<(), Failure> {
    let Ok(entries) = fs::read_dir(folder) else { return Ok(()) };
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = entry.path();
        if name.starts_with('.') || path.extension().is_some_and(|ending| ending == "tmp") {
            continue;
        }
        if path.is_dir() {
            add_folder(files, &format!("{to}{name}/"), &path)?;
        } else {
            files.insert(format!("{to}{name}"), read(&path)?);
        }
    }
    Ok(())
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    Ok(base::file::read(path).map_err(StudyError::io(path, "reading the file"))?)
}

/// `name` as part of an address.
fn encoded(name: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/._-~".contains(&byte);
    let part = |byte: u8| if is_plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
    name.bytes().map(part).collect()
}

fn format_of(name: &str) -> &'static str {
    match name.rsplit_once('.').map_or("", |(_, ending)| ending) {
        "toml" => "application/toml",
        "parquet" => "application/vnd.apache.parquet",
        "json" => "application/json",
        "html" => "text/html",
        "md" => "text/markdown",
        "tex" => "application/x-tex",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "gz" => "application/gzip",
        "zip" => "application/zip",
        _ => "text/plain",
    }
}

/// Whether a pack is in `folder`.
pub fn is_pack(folder: &Path) -> bool {
    folder.join(SUMS).is_file() && folder.join(METADATA).is_file()
}

/// Verifies the pack in `folder`: each file by its hash, and records and verdicts by their seals.
///
/// # Errors
/// Every file that is gone, changed or added; a manifest or verdicts that are not what was sealed.
pub fn check(folder: &Path) -> Result<(), Failure> {
    let path = folder.join(SUMS);
    let sums = base::file::read_text(&path).map_err(StudyError::io(&path, "reading the hashes"))?;
    let mut found = Vec::new();
    let mut known = BTreeSet::from([SUMS.to_owned()]);
    for (number, line) in sums.lines().enumerate() {
        let Some((hash, name)) = line.split_once("  ") else {
            found.push(format!("{}:{}: is no hash with a name", path.display(), number + 1));
            continue;
        };
        let is_inside = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        match is_inside.then(|| base::file::read(&folder.join(name))) {
            Some(Ok(bytes)) if sha256(&bytes) == hash => {}
            Some(Ok(_)) => found.push(format!("{name}: is not the file that was packed")),
            Some(Err(error)) => found.push(format!("{name}: {error}")),
            None => {
                found.push(format!("{}:{}: names a file outside of the pack", path.display(), number + 1));
            }
        }
        known.insert(name.to_owned());
    }
    let mut there = BTreeMap::new();
    add_folder(&mut there, "", folder)?;
    found.extend(
        there.keys().filter(|name| !known.contains(*name)).map(|name| format!("{name}: was not packed")),
    );
    if !found.is_empty() {
        return Err(Failure::stale(format!(
            "{}: not as it was packed:\n  {}",
            folder.display(),
            found.join("\n  ")
        )));
    }
    for entry in fs::read_dir(folder.join("data/runs"))?.flatten() {
        super::places::check_stored(&entry.path()).map_err(Failure::in_check)?;
        Verdicts::read(&entry.path()).map_err(Failure::from).map_err(Failure::in_check)?;
    }
    say!("{}: {} files are as they were packed", folder.display(), known.len());
    Ok(())
}
