//! Damaged files of a stored run, read as `judge` and `render` read them. A Parquet file is opened only if its hash is the
//! manifest's; for every other case its end, its footer or its pages are damaged and the manifest's hash changed too, so that the damage
//! reaches the reader.

use super::damage::{damaged, flipped};
use super::{cases, count, fault};
use base::hash::sha256;
use base::seed::{self, Stream};
use rand::RngExt as _;
use replan::analysis::claims;
use replan::analysis::evidence::{Evidence, default_point};
use replan::analysis::verdict::Verdicts;
use replan::render::output;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use study::paper::Paper;
use study::{Inputs, Interpretation};

const MANIFEST: &str = "scenarios.manifest.toml";

/// What `judge` and `render` do with what is stored in `folder`.
fn used(paper: &Paper, folder: &Path) -> Result<(), String> {
    let evidence = Evidence::read(paper, default_point(paper), folder).map_err(|e| e.to_string())?;
    claims::judge(&evidence).map_err(|e| e.to_string())?;
    let verdicts = Verdicts::read(folder).map_err(|e| e.to_string())?;
    Interpretation::new(&paper.choices, &verdicts.interpretation)
        .map_err(|e| format!("verdicts.toml: {e}"))?;
    let outputs = output::outputs(&evidence, &verdicts, None, &AtomicBool::new(false));
    let outputs = outputs.map_err(|e| format!("verdicts.toml: {e}"))?;
    output::chapter(&folder.join("report.md"), &evidence, &verdicts, folder, &outputs.undrawn)
        .map_err(|e| format!("verdicts.toml: {e}"))?;
    Ok(())
}

/// `bytes` of a file that is no text: some flipped, or the end gone.
fn broken(stream: &mut Stream, bytes: &[u8]) -> Vec<u8> {
    if stream.random_range(0..3) == 0 {
        return bytes[..stream.random_range(0..bytes.len())].to_vec();
    }
    flipped(stream, bytes.to_vec())
}

/// `bytes` of a Parquet file: some of its footer or of its pages flipped, or the end gone.
fn hidden(stream: &mut Stream, bytes: &[u8]) -> Vec<u8> {
    if stream.random_range(0..3) == 0 {
        return bytes[..stream.random_range(0..bytes.len())].to_vec();
    }
    let length = bytes[bytes.len() - 8..bytes.len() - 4].try_into().unwrap();
    let (pages, footer) = bytes.split_at(bytes.len() - 8 - u32::from_le_bytes(length) as usize);
    if stream.random_range(0..2) == 0 {
        return [flipped(stream, pages.to_vec()), footer.to_vec()].concat();
    }
    [pages.to_vec(), flipped(stream, footer.to_vec())].concat()
}

#[test]
fn no_damaged_file_of_a_stored_run_panics_and_every_refusal_names_a_file() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    let copy = tempfile::tempdir().unwrap();
    let inputs = Inputs::below(vec![home.to_owned()]);
    let paper = Paper::load(&home.join("experiments/movingai_sample"), &inputs).unwrap();
    let stored = fs::read_dir(home.join("data/runs/movingai_sample")).unwrap();
    let mut files: Vec<(PathBuf, Vec<u8>)> = stored
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some())
        .map(|path| (copy.path().join(path.file_name().unwrap()), fs::read(path).unwrap()))
        .collect();
    files.sort();
    let write = || files.iter().for_each(|(path, bytes)| fs::write(path, bytes).unwrap());
    write();
    used(&paper, copy.path()).unwrap();
    let mut faults = Vec::new();
    let mut accepted = 0;
    let cases = cases(|all| all / 5);
    let all = count(&cases);
    for case in cases {
        let mut stream = seed::stream(seed::derive(2025, &["stored", &case.to_string()]));
        let (path, bytes) = &files[stream.random_range(0..files.len())];
        let is_text = path.extension().is_some_and(|ending| ending == "toml");
        let is_hidden = !is_text && case % 2 == 0;
        let new = match () {
            () if is_text => damaged(&mut stream, bytes),
            () if is_hidden => hidden(&mut stream, bytes),
            () => broken(&mut stream, bytes),
        };
        fs::write(path, &new).unwrap();
        if is_hidden {
            let (manifest, text) = files.iter().find(|(path, _)| path.ends_with(MANIFEST)).unwrap();
            let text = String::from_utf8(text.clone()).unwrap();
            fs::write(manifest, text.replace(&sha256(bytes), &sha256(&new))).unwrap();
        }
        match fault(|| used(&paper, copy.path())) {
            Ok(is_accepted) => accepted += u64::from(is_accepted),
            Err(what) => faults.push(format!("case {case}, {}: {what}", path.display())),
        }
        write();
    }
    println!("{all} cases, {accepted} accepted");
    assert!(faults.is_empty(), "{} cases:\n{}", faults.len(), faults.join("\n"));
    assert!(accepted < all / 2, "{accepted} were accepted: what was damaged is not looked at");
}
