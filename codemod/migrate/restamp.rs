//! One-off: explorations that were current before words were renamed are current after. Not for the repository.
use super::stored::{Exploration, Now};
use std::fs;
use std::path::Path;
use study::Inputs;
use study::paper::Paper;

#[test]
fn restamp() {
    let root = std::env::var("REPLAN_RESTAMP").unwrap();
    let root = Path::new(&root);
    for entry in fs::read_dir(root.join("experiments")).unwrap() {
        let folder = entry.unwrap().path();
        let name = folder.file_name().unwrap().to_string_lossy().into_owned();
        let runs = root.join("data/runs").join(&name);
        let paper = Paper::load(&folder, &Inputs { roots: vec![root.to_owned()] }).unwrap();
        let now = Now::new(&paper);
        for path in [Exploration::first(&runs), Exploration::second(&runs)] {
            let Some(mut found) = Exploration::read(&path).unwrap() else { continue };
            found.restamp(&now);
            let stale = found.stale(&now);
            println!("{}: {} claims, not there: {stale:?}", path.display(), found.claims.len());
            found.write(&path).unwrap();
        }
    }
}
