//! Holds the floors of every package's `lib.rs`: a module names only modules on lower floors. What a package may know
//! of another is held by the compiler, through its manifest.

use crate::source::{File, PACKAGES, files};
use std::collections::BTreeMap;
use std::path::Path;

/// Packages whose lib.rs stands on floors; the others are small, and their modules stand side by side.
const FLOORED: [&str; 4] = ["base", "engine", "replan", "world"];

/// Every module of `package` with its floor, 0 at the bottom.
fn floors(files: &[File], package: &str) -> BTreeMap<String, usize> {
    let is_root = |file: &&File| file.package() == package && file.path.ends_with("lib.rs");
    let root = files.iter().find(is_root).expect("a package has a lib.rs");
    let mut floors = BTreeMap::new();
    let mut floor = 0;
    for line in root.code.trim_start().lines() {
        match line.strip_prefix("pub mod ").and_then(|rest| rest.strip_suffix(';')) {
            Some(module) => {
                floors.insert(module.to_owned(), floor);
            }
            None => floor += 1,
        }
    }
    floors
}

/// The crate's top modules that `file` names in paths, with the line.
fn named(file: &File) -> Vec<(usize, String)> {
    let depth = file.modules().len();
    let mut inside = 0;
    let mut named = Vec::new();
    let mut start = 0;
    for (index, line) in file.code.lines().enumerate() {
        inside = match line {
            _ if line.starts_with("mod ") && line.ends_with('{') => 1,
            "}" => 0,
            _ => inside,
        };
        let to_root = "super::".repeat(depth + inside);
        for prefix in ["crate::", to_root.as_str()] {
            for (at, _) in line.match_indices(prefix) {
                let is_whole = prefix == "crate::" || !line[..at].ends_with("super::");
                let is_word = !line[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
                if is_whole && is_word {
                    let rest = &file.code[start + at + prefix.len()..];
                    named.extend(heads(rest).into_iter().map(|head| (index + 1, head)));
                }
            }
        }
        start += line.len() + 1;
    }
    named
}

/// The first names after a path's root: one, or those of a braced list.
fn heads(rest: &str) -> Vec<String> {
    let word = |text: &str| -> String {
        text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let Some(list) = rest.strip_prefix('{') else { return vec![word(rest)] };
    let mut depth = 1;
    let mut heads = vec![word(list)];
    for (at, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => heads.push(word(&list[at + 1..])),
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    heads.retain(|head| !head.is_empty());
    heads
}

/// Every way in which `files` break the floors.
fn violations(files: &[File], package: &str) -> Vec<String> {
    let floors = floors(files, package);
    let mut found = Vec::new();
    for file in files.iter().filter(|file| file.package() == package) {
        let Some(own) = file.modules().first().cloned() else { continue };
        let Some(floor) = floors.get(&own) else {
            found
                .push(format!("{}: module `{own}` is not in the lib.rs of `{package}`", file.path.display()));
            continue;
        };
        for (line, other) in named(file) {
            let place = format!("{}:{line}: `{own}` names `{other}`", file.path.display());
            match floors.get(&other) {
                _ if other == own => {}
                None if is_macro(files, package, &other) => {}
                None => found.push(format!("{place}, which is no module of lib.rs")),
                Some(below) if below >= floor => {
                    found.push(format!("{place}, which is not on a lower floor"));
                }
                Some(_) => {}
            }
        }
    }
    found
}

/// Whether `package` exports a macro with this name: it stands at the root, wherever it is written.
fn is_macro(files: &[File], package: &str, name: &str) -> bool {
    let head = format!("#[macro_export]\nmacro_rules! {name} {{");
    files.iter().any(|file| file.package() == package && file.code.contains(&head))
}

#[test]
fn modules_name_only_lower_floors() {
    let files = files();
    let named: usize = files.iter().map(|file| named(file).len()).sum();
    assert!(named > 200, "only {named} paths were read; the reader is blind");
    let found: Vec<String> = FLOORED.iter().flat_map(|package| violations(&files, package)).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn what_shows_results_computes_no_statistic() {
    let files = files();
    let names_it = |file: &File| {
        let mut words = file.code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        words.any(|word| word == "stats")
    };
    for (floor, may) in [("analysis", true), ("render", false), ("page", false), ("cli", false)] {
        let own = files.iter().filter(|file| file.modules().first().is_some_and(|own| own == floor));
        let own: Vec<&File> = own.collect();
        let naming = own.iter().filter(|file| names_it(file)).map(|file| file.path.display().to_string());
        let naming: Vec<String> = naming.collect();
        assert!(own.len() > 5, "the reader is blind: {} files of `{floor}`", own.len());
        assert_eq!(
            !naming.is_empty(),
            may,
            "`{floor}`: a statistic is analysis's, and these name them: {naming:?}"
        );
    }
}

#[test]
fn the_verifier_depends_on_base_alone() {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/verify/Cargo.toml");
    let manifest: toml::Table = std::fs::read_to_string(manifest).unwrap().parse().unwrap();
    let own = |name: &&String| PACKAGES.contains(&name.as_str());
    let found: Vec<&String> = manifest["dependencies"].as_table().unwrap().keys().filter(own).collect();
    assert_eq!(found, ["base"]);
}

#[test]
fn broken_floors_are_noticed_in_a_tree_made_up_for_it() {
    let engine = "//! Doc.\n\npub mod space;\npub mod shorten;\n\npub mod planner;\n";
    let lib = "//! Doc.\n\npub mod study;\n\npub mod cli;\n";
    let tree = |path: &str, text: &str| {
        let files = [File::new("engine/lib.rs", engine), File::new("lib.rs", lib), File::new(path, text)];
        [violations(&files, "engine"), violations(&files, "replan")].concat()
    };
    let planner = "`space` names `planner`";
    for (path, text, complaint) in [
        (
            "engine/space/mod.rs",
            "fn a() {\n    crate::planner::run();\n}",
            "engine/space/mod.rs:2: `space` names `planner`",
        ),
        ("engine/space/mod.rs", "use crate::shorten::tidy;", "which is not on a lower floor"),
        ("engine/space/mod.rs", "use super::planner::run;", planner),
        ("engine/space/lattice/tests.rs", "use super::super::super::planner::run;", planner),
        ("engine/space/lattice.rs", "mod tests {\n    use super::super::super::planner;\n}", planner),
        (
            "engine/space/lattice.rs",
            "use crate::{\n    space::World,\n    planner::{Plan, run},\n};",
            planner,
        ),
        (
            "study.rs",
            "use crate::cli::run;",
            "study.rs:1: `study` names `cli`, which is not on a lower floor",
        ),
        ("attic.rs", "", "module `attic` is not in the lib.rs of `replan`"),
        ("engine/attic.rs", "", "module `attic` is not in the lib.rs of `engine`"),
        ("cli.rs", "use crate::attic::x;", "`attic`, which is no module of lib.rs"),
    ] {
        let found = tree(path, text);
        assert!(found.len() == 1 && found[0].contains(complaint), "{path}\n{text}\n{found:?}");
    }
    for (path, text) in [
        ("engine/planner/mod.rs", "use crate::space::World; // not crate::attic"),
        ("engine/space/lattice.rs", "use super::World;\nmod tests {\n    use super::super::World;\n}"),
        ("study.rs", "use engine::{planner::Plan, space::World};"),
        ("cli.rs", "use crate::study::Study;\nconst TEXT: &str = \"crate::attic\";"),
    ] {
        assert_eq!(tree(path, text), [""; 0], "{path}\n{text}");
    }
}

#[test]
fn no_file_is_longer_than_800_lines() {
    let lines = |file: &File| file.code.lines().count();
    let long: Vec<_> =
        files().iter().filter(|file| lines(file) > 800).map(|file| file.path.clone()).collect();
    assert!(long.is_empty(), "{long:#?}");
}
