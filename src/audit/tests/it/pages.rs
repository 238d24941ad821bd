//! Holds the committed page of findings, and the certificates that `crosscheck/` verifies, to what the audit says now. With
//! `REPLAN_WRITE=1` in the environment both are written instead.

use replan_audit::checks::{Entry, REGISTRY};
use replan_audit::output;
use replan_audit::reader::{Format, read};
use replan_audit::report::{Class, Options, Report, audit};
use std::fs;
use std::path::{Path, PathBuf};

const PREAMBLE: &str = "# What the audit finds in public tables\n\n\
    The tests of the package `audit` write this page from the files in [docs/audit](audit). Do not edit it. A finding is a signal with \
    premises, not an accusation ([AUDIT.md](AUDIT.md)). If a premise does not hold, the finding falls with it. Possible numbers are only \
    counted; `replan audit --json` lists them.\n\n";

/// A file of the repository.
pub fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// The tables and relations of a paper, as committed.
pub fn printed(name: &str) -> String {
    fs::read_to_string(repository(&format!("docs/audit/{name}.toml"))).unwrap()
}

fn audited(name: &str) -> (String, Report) {
    let text = printed(name);
    let input = read(&text, Format::Toml).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
    let options = Options { keeps_possible: true, ..Options::default() };
    let about = text.split("\"\"\"").nth(1).unwrap_or_default().to_owned();
    (about, audit(&input, &options).unwrap_or_else(|faults| panic!("{name}: {faults:?}")))
}

/// Whether committed files are written instead of compared.
pub fn is_writing() -> bool {
    std::env::var_os("REPLAN_WRITE").is_some()
}

#[test]
fn the_page_of_public_tables_says_what_the_audit_finds() {
    let mut page = PREAMBLE.to_owned();
    for name in ["vamp", "curobo", "rdt", "zhang", "fu2018", "planar"] {
        let (about, report) = audited(name);
        page += &section(&format!("[{name}.toml](audit/{name}.toml)"), &about, &report);
    }
    let path = repository("docs/AUDIT_TABLES.md");
    if is_writing() {
        fs::write(&path, &page).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap() == page,
        "docs/AUDIT_TABLES.md is not what the audit finds; REPLAN_WRITE=1 writes it"
    );
}

#[test]
fn the_certificates_that_python_verifies_are_those_of_the_examples() {
    let folder = repository("crosscheck/tests/certificates");
    let (_, report) = audited("examples");
    let proved = report.findings.iter().filter_map(|finding| Some((finding, finding.certificate.as_ref()?)));
    let mut names = Vec::new();
    if is_writing() {
        fs::remove_dir_all(&folder).unwrap();
        fs::create_dir_all(&folder).unwrap();
    }
    for (index, (finding, certificate)) in proved.enumerate() {
        let name = format!("{:02}_{}.json", index + 1, finding.check);
        let text = format!("{certificate:#}\n");
        if is_writing() {
            fs::write(folder.join(&name), &text).unwrap();
        }
        assert!(
            fs::read_to_string(folder.join(&name)).unwrap() == text,
            "{name} is stale; REPLAN_WRITE=1 writes it"
        );
        names.push(name);
    }
    let stored = fs::read_dir(&folder).unwrap().count();
    assert_eq!(stored, names.len(), "{names:?}");
}

#[test]
fn the_page_on_checks_has_every_check_with_its_example_premises_mathematics_and_source() {
    let page = fs::read_to_string(repository("docs/AUDIT.md")).unwrap();
    let sections: Vec<&str> = page.split("\n### ").skip(1).collect();
    assert_eq!(sections.len(), REGISTRY.len());
    for (section, entry) in sections.into_iter().zip(REGISTRY) {
        let Entry { name, about, example, premises, source, .. } = entry;
        let head =
            format!("{name}\n\n{about}\n\n- refuses: `{example}`\n- premises: {premises}\n- mathematics: ");
        assert!(section.starts_with(&head), "docs/AUDIT.md should have\n### {head}");
        assert!(section.contains(&format!("\n- source: {source}\n")), "{name}: {source}");
    }
}

/// What is impossible, a signal or not checked, and what each check did, as a section of Markdown under `title`.
fn section(title: &str, about: &str, report: &Report) -> String {
    let mut text = format!("## {title}\n\n{}\n\n", about.trim());
    for finding in report.findings.iter().filter(|finding| finding.class < Class::Possible) {
        text += &format!("- **{}** (`{}`): {}\n", finding.class.name(), finding.check, finding.name);
        let mut lines: Vec<String> = finding.text.split("; ").map(str::to_owned).collect();
        lines.extend(finding.power.as_ref().map(|power| format!("the check {power}")));
        let mend = finding.mend.as_ref();
        lines.extend(
            mend.map(|mend| format!("least change: {} from {} to {}", mend.name, mend.from, mend.to)),
        );
        if !finding.follows.is_empty() {
            lines.push(format!("with it these are possible too: {}", finding.follows.join(", ")));
        }
        let premises = finding.premises.iter().flat_map(|premise| premise.split("; "));
        lines.extend(premises.map(|premise| format!("premise: {premise}")));
        for line in lines {
            text += &format!("  - {line}\n");
        }
    }
    text += "\nIn all:\n\n";
    for line in output::summary(report) {
        text += &format!("- {line}\n");
    }
    text + "\n"
}
