//! The committed papers in a folder of their own, any file of which can be read in a damaged form.

use base::settings::Document;
use replan::analysis::claims;
use replan::cli::crosscheck;
use replan::render::{figure, results};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use study::paper::Paper;
use study::{Inputs, Study};
use tempfile::TempDir;

/// A file that can be damaged.
struct File {
    path: PathBuf,
    bytes: Vec<u8>,
    /// The paper it belongs to and, for an input, one of its studies that use it.
    paper: usize,
    role: Role,
}

/// How a file is read.
enum Role {
    Paper,
    Study(usize),
    Crosscheck,
    /// By the study of this number.
    Input(usize),
}

/// Every committed paper, loaded, with every file that it was loaded from.
pub struct Subject {
    root: TempDir,
    papers: RefCell<Vec<Paper>>,
    files: Vec<File>,
}

impl Subject {
    /// A copy of the committed papers and inputs.
    pub fn of_committed_papers() -> Self {
        let root = tempfile::tempdir().unwrap();
        let home = Path::new(env!("CARGO_MANIFEST_DIR"));
        for name in ["experiments", "data/robots", "data/scenes", "data/maps", "data/draws", "data/mbm"] {
            copy(&home.join(name), &root.path().join(name));
        }
        let mut folders: Vec<PathBuf> = fs::read_dir(root.path().join("experiments"))
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect();
        folders.sort();
        let load = |folder: &PathBuf| Paper::load(folder, &inputs(root.path(), folder)).unwrap();
        let papers: Vec<Paper> = folders.iter().map(load).collect();
        let files = papers.iter().enumerate().flat_map(|(paper, of)| files(root.path(), paper, of)).collect();
        Self { files, papers: RefCell::new(papers), root }
    }

    /// How many files there are.
    pub fn files(&self) -> usize {
        self.files.len()
    }

    /// The file whose path ends with `name`.
    pub fn find(&self, name: &str) -> usize {
        self.files.iter().position(|file| file.path.ends_with(name)).unwrap()
    }

    /// The path of a file below the copy.
    pub fn name(&self, file: usize) -> String {
        self.files[file].path.strip_prefix(self.root.path()).unwrap().display().to_string()
    }

    /// A file as it is committed.
    pub fn bytes(&self, file: usize) -> &[u8] {
        &self.files[file].bytes
    }

    /// Reads the paper of `file` as if the file held `bytes`; all else of the paper stays as it was loaded.
    pub fn read(&self, file: usize, bytes: &[u8]) -> Result<(), String> {
        let file = &self.files[file];
        fs::write(&file.path, bytes).unwrap();
        // Restored also if reading panics, so that one bad case does not damage the next.
        let _restored = Restored(file);
        let mut papers = self.papers.borrow_mut();
        let paper = &mut papers[file.paper];
        let load = |study: usize, paper: &Paper| {
            let path = paper.studies[study].document.path().to_owned();
            Study::load(&path, &inputs(self.root.path(), &paper.folder)).map_err(|e| e.to_string())
        };
        match file.role {
            Role::Crosscheck => crosscheck::Spec::open(&paper.folder).map(|_| ()).map_err(|e| e.to_string()),
            Role::Paper => {
                let document = Document::open(&file.path).map_err(|e| e.to_string())?;
                let damaged = Paper::with_studies(&paper.folder, &document, paper.studies.clone());
                validate(&damaged.map_err(|e| e.to_string())?)
            }
            Role::Input(study) => load(study, paper).map(|_| ()),
            Role::Study(study) => {
                let damaged = load(study, paper)?;
                let mut swap = Swap { paper, study, other: damaged };
                swap.turn();
                validate(swap.paper)
            }
        }
    }
}

/// A file that is written as it was when this is dropped.
struct Restored<'a>(&'a File);

impl Drop for Restored<'_> {
    fn drop(&mut self) {
        fs::write(&self.0.path, &self.0.bytes).unwrap();
    }
}

/// A study in another's place until this is dropped.
struct Swap<'a> {
    paper: &'a mut Paper,
    study: usize,
    other: Study,
}

impl Swap<'_> {
    fn turn(&mut self) {
        std::mem::swap(&mut self.paper.studies[self.study], &mut self.other);
    }
}

impl Drop for Swap<'_> {
    fn drop(&mut self) {
        self.turn();
    }
}

/// What `check` looks at once a paper is loaded.
pub(super) fn validate(paper: &Paper) -> Result<(), String> {
    claims::validate(paper)
        .and_then(|()| figure::validate(paper))
        .and_then(|()| results::validate(paper))
        .map_err(|error| error.to_string())
}

fn inputs(root: &Path, folder: &Path) -> Inputs {
    Inputs::below(vec![folder.to_owned(), root.to_owned()])
}

fn files(root: &Path, paper: usize, of: &Paper) -> Vec<File> {
    let file = |path: PathBuf, role| File { bytes: fs::read(&path).unwrap(), path, paper, role };
    let mut found = vec![file(of.folder.join("paper.toml"), Role::Paper)];
    let posed = of.folder.join("crosscheck.toml");
    found.extend(posed.is_file().then(|| file(posed, Role::Crosscheck)));
    let mut read: BTreeMap<PathBuf, usize> = BTreeMap::new();
    let default = replan::analysis::evidence::default_point(of);
    for (number, study) in of.studies.iter().enumerate() {
        found.push(file(study.document.path().to_owned(), Role::Study(number)));
        for (group, at) in study.posed() {
            let point = default.for_trials(&study.choices);
            let family = group.family(at, &point, &inputs(root, &of.folder)).unwrap();
            read.extend(family.inputs().iter().map(|path| (path.clone(), number)));
        }
    }
    found.extend(read.into_iter().map(|(path, study)| file(path, Role::Input(study))));
    found
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let (from, to) = (entry.path(), to.join(entry.file_name()));
        if from.is_dir() {
            copy(&from, &to);
        } else {
            fs::copy(&from, &to).unwrap();
        }
    }
}
