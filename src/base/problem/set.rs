//! Sets of problems, read once: a YAML or JSON file, or an archive (tar) of `MoveIt` scenes and requests.
//!
//! In an archive `DIR/scene0001.yaml` and `DIR/request0001.yaml` are one problem; folders and numbers are taken in order. A problem is parsed when it
//! is needed, so that a fault in one leaves the others.

use super::moveit::parse_moveit;
use super::{Expected, Problem, ProblemFile};
use crate::file;
use crate::settings::{Document, SettingsError};
use crate::text;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A set of problems.
#[derive(Debug)]
pub struct ProblemSet(Held);

#[derive(Debug)]
enum Held {
    File { file: ProblemFile, set: Option<String> },
    Archive(Vec<Pair>),
}

/// A scene and its request, each with its path; one may be missing.
#[derive(Debug, Default, Clone)]
struct Pair {
    scene: Option<(PathBuf, String)>,
    request: Option<(PathBuf, String)>,
}

impl ProblemSet {
    /// The set called `set` in the file at `path`; in an archive, the problems of the folders whose names begin with it, all if it is `None`.
    ///
    /// # Errors
    /// What is wrong with the file as a whole, at its place.
    pub fn open(path: &Path, set: Option<&str>) -> Result<Self, SettingsError> {
        if path.extension().is_none_or(|end| end != "tar") {
            let file = ProblemFile::parse(Document::open(path)?)?;
            file.count(set)?;
            return Ok(Self(Held::File { file, set: set.map(str::to_owned) }));
        }
        let fault = |reason: String| SettingsError::Unreadable { path: path.to_owned(), reason };
        let bytes = file::read(path).map_err(|error| fault(error.to_string()))?;
        let mut pairs: BTreeMap<(String, String), Pair> = BTreeMap::new();
        for (name, content) in entries(&bytes).map_err(fault)? {
            let (folder, stem) = name.rsplit_once('/').unwrap_or(("", name));
            let last = folder.rsplit('/').next().unwrap_or_default();
            if set.is_some_and(|set| !last.starts_with(set)) {
                continue;
            }
            let Some(stem) = stem.strip_suffix(".yaml").or_else(|| stem.strip_suffix(".yml")) else {
                continue;
            };
            let read = || {
                let text =
                    text::decoded(content.to_vec()).map_err(|error| fault(format!("{name}: {error}")))?;
                Ok::<_, SettingsError>((path.join(name), text))
            };
            if let Some(number) = stem.strip_prefix("scene") {
                pairs.entry((folder.to_owned(), number.to_owned())).or_default().scene = Some(read()?);
            } else if let Some(number) = stem.strip_prefix("request") {
                pairs.entry((folder.to_owned(), number.to_owned())).or_default().request = Some(read()?);
            }
        }
        if pairs.is_empty() {
            let of = set.map_or_else(String::new, |set| format!(" of a folder `{set}`"));
            return Err(fault(format!(
                "it holds no scene and no request{of}; scene0001.yaml and request0001.yaml are accepted"
            )));
        }
        Ok(Self(Held::Archive(pairs.into_values().collect())))
    }

    /// How many problems it holds.
    pub fn count(&self) -> usize {
        match &self.0 {
            Held::File { file, set } => file.count(set.as_deref()).unwrap_or_default(),
            Held::Archive(pairs) => pairs.len(),
        }
    }

    /// The name of the folder that the problem of this number lies in; `None` outside archives.
    pub fn folder(&self, index: usize) -> Option<&str> {
        let Held::Archive(pairs) = &self.0 else { return None };
        let pair = pairs.get(index)?;
        let (path, _) = pair.scene.as_ref().or(pair.request.as_ref())?;
        path.parent()?.file_name()?.to_str()
    }

    /// `message` about the end of the problem of this number that stands `at`.
    pub fn fault(&self, index: usize, at: Range<usize>, message: String) -> SettingsError {
        match &self.0 {
            Held::File { file, .. } => file.fault(at, message),
            Held::Archive(pairs) => {
                let request = pairs.get(index).and_then(|pair| pair.request.clone()).unwrap_or_default();
                document(&request).error(at, message)
            }
        }
    }

    /// The problem of this number, from 0.
    ///
    /// # Errors
    /// As those of a problem file; a scene without a request, or the other way round.
    pub fn problem(&self, index: usize, expected: &Expected<'_>) -> Result<Problem, SettingsError> {
        match &self.0 {
            Held::File { file, set } => file.problem(set.as_deref(), index, Some(expected)),
            Held::Archive(pairs) => {
                let pair = pairs.get(index).cloned().unwrap_or_default();
                match (&pair.scene, &pair.request) {
                    (Some(scene), Some(request)) => {
                        parse_moveit(&document(scene), &document(request), expected)
                    }
                    (Some(one), None) => {
                        Err(document(one).error(0..0, "the scene has no request; one is accepted"))
                    }
                    (None, Some(one)) => {
                        Err(document(one).error(0..0, "the request has no scene; one is accepted"))
                    }
                    (None, None) => Err(SettingsError::Unreadable {
                        path: PathBuf::new(),
                        reason: format!(
                            "problem {index} is requested; the set has {}, counted from 0",
                            pairs.len()
                        ),
                    }),
                }
            }
        }
    }
}

/// A scene or a request, to be read.
fn document((path, text): &(PathBuf, String)) -> Arc<Document> {
    Document::new(path, text.clone())
}

/// The regular files of an archive in the form of POSIX (ustar), by name.
fn entries(archive: &[u8]) -> Result<Vec<(&str, &[u8])>, String> {
    const BLOCK: usize = 512;
    let mut files = Vec::new();
    let mut at = 0;
    while let Some(header) = archive.get(at..at + BLOCK).filter(|header| header[0] != 0) {
        let field = |from: usize, to: usize| {
            let bytes = header[from..to].split(|byte| *byte == 0).next().unwrap_or_default();
            std::str::from_utf8(bytes)
                .map(str::trim)
                .map_err(|_| format!("byte {at}: a name or number is not UTF-8"))
        };
        let name = field(0, 100)?;
        let size = usize::from_str_radix(field(124, 136)?, 8).map_err(|_| {
            format!("byte {}: `{name}` has no size in octal digits; is it a tar archive?", at + 124)
        })?;
        let from = at + BLOCK;
        let content = from.checked_add(size).and_then(|to| archive.get(from..to));
        let content = content.ok_or_else(|| format!("it ends within `{name}`"))?;
        match header[156] {
            b'0' | 0 => files.push((name, content)),
            b'L' | b'K' | b'x' => {
                return Err(format!(
                    "byte {at}: a name is longer than 100 characters; shorter ones are accepted"
                ));
            }
            _ => {}
        }
        at = from + size.div_ceil(BLOCK) * BLOCK;
    }
    if archive.is_empty() || at == 0 {
        return Err("it is empty; a tar archive is accepted".to_owned());
    }
    Ok(files)
}
