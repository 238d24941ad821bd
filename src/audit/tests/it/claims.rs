//! Printed tables as claims: `--to-claims`, from LaTeX above all.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/claims")
}

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_replan-audit")).args(arguments).current_dir(folder()).output().unwrap()
}

#[test]
fn every_number_of_a_table_in_latex_becomes_a_claim_with_its_digits() {
    let done = run(&["table.tex", "--to-claims"]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let text = String::from_utf8(done.stdout).unwrap();
    assert_eq!(text, fs::read_to_string(folder().join("table.toml")).unwrap(), "{text}");
}

#[test]
fn the_same_table_in_markdown_gives_the_same_claims() {
    let folder = tempfile::tempdir().unwrap();
    let table = "# Costs on \\emph{simple} maps.\n\n| Planner | Cost (cells) | Time (ms) | Solved [%] |\n|-|-|-|-|\n| A* | 17.65 | 4.10 | 100 |\n\
                 | **Improved A*** | **13.40** | 3.2 ± 0.1 | 98.5 |\n| D* | – | 2.00 | 97.0 |\n";
    let file = folder.path().join("t.md");
    fs::write(&file, table).unwrap();
    let [markdown, latex] =
        [file.to_str().unwrap(), "table.tex"].map(|file| run(&[file, "--to-claims"]).stdout);
    assert_eq!(String::from_utf8(markdown).unwrap(), String::from_utf8(latex).unwrap());
}

#[test]
fn a_table_in_latex_is_audited_and_one_that_is_cut_off_is_refused_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("t.tex");
    let message = |text: &str| {
        fs::write(&file, text).unwrap();
        let done = run(&[file.to_str().unwrap()]);
        let both = [done.stdout, done.stderr].concat();
        (done.status.code(), String::from_utf8(both).unwrap())
    };
    let table = "\\begin{tabular}{lc}\nplanner & success [% of 250] \\\\\nA & 33.3 \\\\\nB & 33.2 \\\\\n\\end{tabular}\n";
    let (code, found) = message(&table.replace("% of", "\\% of"));
    assert_eq!(code, Some(3), "{found}");
    assert!(found.contains(":3:2: impossible: success of A: 33.3"), "{found}");
    let (code, found) =
        message(table.strip_suffix("\\end{tabular}\n").unwrap().replace("% of", "\\% of").as_str());
    assert_eq!(code, Some(2), "{found}");
    assert!(found.contains("the tabular has no `\\end{tabular}`"), "{found}");
    let (code, found) = message(&table.replace("% of", "\\% of").replace("B & 33.2", "B & 33.2 & 1"));
    assert_eq!(code, Some(2), "{found}");
    assert!(found.contains("t.tex:4: 3 cells, where the header has 2"), "{found}");
}
