//! One-off: records of old names rewritten under new ones, by the writer of records. Not for the repository.
use super::read::{Instances, Stored};
use super::table::{self, DESCRIPTION};
use crate::key::KeyColumns;
use crate::parquet::FrameReader;
use base::hash::sha256;
use polars::prelude::DataFrame;
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

const PARTS: [(&str, &str); 4] = [("trials", "trials"), ("times", "times"), ("exhibits", "traces"), ("prepared", "preprocessing")];

fn new_name(old: &str) -> String {
    match old {
        "draw" => "instance".to_owned(),
        "prepared_bytes" => "preprocessing_bytes".to_owned(),
        other => other.strip_prefix("reading_").map_or_else(|| other.to_owned(), |id| format!("choice_{id}")),
    }
}

fn renamed(mut frame: DataFrame) -> DataFrame {
    let names: Vec<String> = frame.columns().iter().map(|column| new_name(column.name())).collect();
    frame.set_column_names(&names).unwrap();
    frame
}

/// The keys of a file beyond those that every study has; sweeps say whose setting they are in what was stored.
fn keys(stored: &str) -> KeyColumns {
    let stored: Vec<serde_json::Value> = serde_json::from_str(stored).unwrap();
    let mut keys = KeyColumns::default();
    for one in &stored {
        let name = one["name"].as_str().unwrap();
        let about = one["about"].as_str().unwrap();
        if let Some(setting) = name.strip_prefix("sweep_") {
            let of = about.rsplit_once("` of `").unwrap().1.split('`').next().unwrap();
            keys.sweeps.push((setting.into(), of.into()));
        }
        if let Some(id) = name.strip_prefix("reading_") {
            keys.choices.push(id.into());
        }
    }
    keys
}

/// The file as the program writes the records in it.
fn rewritten(part: &str, path: &Path, bytes: Vec<u8>) -> Vec<u8> {
    let mut reader = FrameReader::open(Cursor::new(bytes)).unwrap();
    let keys = keys(reader.entry(DESCRIPTION).unwrap());
    let frame = renamed(reader.frame().unwrap());
    let columns: Vec<&'static str> =
        frame.columns().iter().filter_map(|column| crate::column::find(column.name())).map(|column| column.name).collect();
    let stored = Stored::read_by(path.to_owned(), std::panic::AssertUnwindSafe(|| Ok(frame))).unwrap();
    let all = &mut Instances::default();
    match part {
        "trials" => table::to_parquet(table::trials(&stored.trials(all).unwrap(), &keys, &columns), &keys),
        "times" => table::to_parquet(table::times(&stored.times(all).unwrap(), &keys), &keys),
        "prepared" => table::to_parquet(table::preprocessing(&stored.preprocessing(all).unwrap(), &keys), &keys),
        _ => {
            let kept = stored.traces(all).unwrap();
            let mut out = Vec::new();
            let sweep = super::traces::sweep_of(&kept);
            let mut writer = super::traces::TraceWriter::new(&mut out, &keys, sweep, super::GROUP_VALUES).unwrap();
            for one in kept {
                writer.add(one).unwrap();
            }
            writer.finish().unwrap();
            out
        }
    }
}

fn manifests(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(manifests(&path));
        } else if path.to_string_lossy().ends_with(".manifest.toml") {
            found.push(path);
        }
    }
    found.sort();
    found
}

#[test]
fn migrate_runs() {
    for manifest in manifests(Path::new(&std::env::var("REPLAN_MIGRATE").unwrap())) {
        let study = manifest.file_name().unwrap().to_string_lossy().strip_suffix(".manifest.toml").unwrap().to_owned();
        let folder = manifest.parent().unwrap();
        let mut text = fs::read_to_string(&manifest).unwrap();
        let at = |part: &str| folder.join(format!("{study}.{part}.parquet"));
        for (old, new) in PARTS {
            if old != new && at(new).exists() {
                continue;
            }
            let bytes = fs::read(at(old)).unwrap();
            let hash = sha256(&bytes);
            assert!(text.contains(&format!("{old} = \"{hash}\"")), "{}: {old} is not what the manifest names", manifest.display());
            let made = rewritten(old, &at(old), bytes);
            text = text.replace(&format!("{old} = \"{hash}\""), &format!("{new} = \"{}\"", sha256(&made)));
            fs::write(at(new), made).unwrap();
            if old != new {
                fs::remove_file(at(old)).unwrap();
            }
        }
        // In the order of names, as manifests are written.
        let (head, files) = text.split_once("[files]\n").unwrap();
        let end = files.find("\n\n").map_or(files.len(), |end| end + 1);
        let mut lines: Vec<&str> = files[..end].lines().collect();
        lines.sort();
        let mut text = format!("{head}[files]\n{}\n{}", lines.join("\n"), &files[end..]);
        text = text.replacen("\naxes = ", "\nchoices = ", 1).replacen("\nreadings = ", "\ninterpretations = ", 1);
        text = text.replace(": replicates = ", ": instances = ");
        fs::write(&manifest, text).unwrap();
    }
}
