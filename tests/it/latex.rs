//! What is written for LaTeX compiles and fits; where there is no `pdflatex` this says so and checks nothing.

use crate::paper::Bench;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Every table and file of numbers below `plots`.
fn sources(plots: &Path) -> Vec<PathBuf> {
    let papers = fs::read_dir(plots).into_iter().flatten().flatten();
    let files = papers.flat_map(|paper| fs::read_dir(paper.path()).into_iter().flatten().flatten());
    let mut found: Vec<PathBuf> = files.map(|file| file.path()).collect();
    found.retain(|path| path.extension().is_some_and(|ending| ending == "tex"));
    found.sort();
    found
}

/// One bare article with all of `sources`, run through pdflatex; its log, or `None` without pdflatex.
fn compiled(sources: &[PathBuf], packages: &str) -> Option<(bool, String)> {
    let folder = tempfile::tempdir().unwrap();
    let mut text = format!("\\documentclass{{article}}\n\\usepackage{{{packages}}}\n\\begin{{document}}\n");
    for source in sources {
        let name = source.file_stem().unwrap().to_string_lossy();
        writeln!(text, "\\typeout{{FILE {}}}\\input{{{}}}\\clearpage", name, source.display()).unwrap();
    }
    fs::write(folder.path().join("all.tex"), text + "\\end{document}\n").unwrap();
    let mut command = Command::new("pdflatex");
    let arguments = ["-interaction=nonstopmode", "-halt-on-error", "all.tex"];
    let done =
        command.current_dir(folder.path()).args(arguments).env("max_print_line", "1000").output().ok()?;
    let log = String::from_utf8_lossy(&fs::read(folder.path().join("all.log")).unwrap()).into_owned();
    Some((done.status.success(), log))
}

#[test]
fn committed_tables_and_numbers_fit_a_bare_article() {
    let plots = Path::new(env!("CARGO_MANIFEST_DIR")).join("plots");
    let mut all = sources(&plots);
    assert!(all.len() > 10, "{all:?}");
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    all.extend(sources(&bench.at("target/replan/mini/plots")));
    let Some((is_done, log)) = compiled(&all, "booktabs,tabularx") else {
        eprintln!("skipped: there is no pdflatex here, so whether tables compile was not seen");
        return;
    };
    assert!(is_done, "{}", &log[log.len().saturating_sub(3000)..]);
    let wide: Vec<&str> = log.lines().filter(|line| line.starts_with("Overfull")).collect();
    assert!(wide.is_empty(), "too wide: {wide:#?}");
}
