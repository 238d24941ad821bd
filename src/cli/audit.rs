//! `replan audit`: is this table possible?

use super::{Failure, render};
use ::audit::input::Input;
use ::audit::reader::{self, Format};
use ::audit::report::{Options, Report};
use ::audit::witness::Budget;
use ::audit::{coverage, output};
use base::file;
use clap::Args;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// Asks of a printed table, by arithmetic alone, whether any data could have given it.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Audit {
    /// A table (CSV, Markdown) or relations (TOML); `-` for standard input
    #[arg(required_unless_present_any = ["list", "coverage"])]
    file: Option<PathBuf>,
    /// How the input is written; by its ending or looks if absent
    #[arg(long, value_name = "FORMAT", value_parser = ["csv", "md", "toml"])]
    format: Option<String>,
    /// Print the whole report, certificates included, as JSON
    #[arg(long)]
    json: bool,
    /// Show data behind what is possible, this many vectors a number at most
    #[arg(long, value_name = "COUNT", num_args = 0..=1, default_missing_value = "20")]
    witness: Option<NonZero<usize>>,
    /// Try data in an order drawn from this seed, for a sample instead of the first ones
    #[arg(long, value_name = "SEED", requires = "witness")]
    seed: Option<u64>,
    /// Steps that the search for data may take a number
    #[arg(long, value_name = "STEPS", default_value_t = 100_000, requires = "witness")]
    budget: u64,
    /// Write the certificate of every impossible finding into this folder
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
    /// Write the table's header with every guess, to be corrected
    #[arg(long, value_name = "FILE")]
    stub: Option<PathBuf>,
    /// List the checks and the items of annotations
    #[arg(long)]
    list: bool,
    /// Look for numbers in this LaTeX text that no macro backs, and for stale macros
    #[arg(long, value_name = "TEX", requires = "macros")]
    coverage: Option<PathBuf>,
    /// The macros that the text uses: plots/PAPER/numbers.tex or a copy of it
    #[arg(long, value_name = "TEX")]
    macros: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  replan audit results.md                       | method | success [% of 250] | time [mean s, n=250] |
  replan audit results.csv --json
  replan audit claims.toml --witness
  replan audit --coverage paper.tex --macros plots/zhang/numbers.tex
Exit code 3: something is impossible under the premises named, or a number is backed by no macro.";

impl Audit {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        if self.list {
            say!("{}", output::list().trim_end());
            return Ok(());
        }
        if let (Some(text), Some(macros)) = (&self.coverage, &self.macros) {
            covered(text, macros)?;
        }
        self.file.as_deref().map_or(Ok(()), |file| self.judged(file))
    }

    fn judged(&self, file: &Path) -> Result<(), Failure> {
        let source = if file == Path::new("-") { "stdin".to_owned() } else { file.display().to_string() };
        let text = read(file)?;
        let by_ending = file.extension().and_then(|ending| Format::of_ending(&ending.to_string_lossy()));
        let asked = self.format.as_deref().and_then(Format::of_ending);
        let format = asked.or(by_ending).unwrap_or_else(|| Format::of_text(&text));
        let told = |faults: Vec<audit::table::Fault>| {
            let lines: Vec<String> = faults.iter().map(|fault| format!("{source}:{fault}")).collect();
            Failure::input(lines.join("\n"))
        };
        let input = reader::read(&text, format).map_err(told)?;
        if let Some(stub) = &self.stub {
            let header = |table| format!("{}\n", reader::stub_line(table));
            write(stub, &input.tables.iter().map(header).collect::<String>())?;
        }
        let witness =
            self.witness.map(|most| Budget { most: most.get(), steps: self.budget, seed: self.seed });
        let skips_certificates = !self.json && self.certificates.is_none();
        let options =
            Options { keeps_possible: self.json, skips_certificates, witness, ..Options::default() };
        let report = audit::report::audit(&input, &options).map_err(told)?;
        if let Some(folder) = &self.certificates {
            write_certificates(folder, &report)?;
        }
        if self.json {
            say!("{:#}", output::json(&source, &input, &report));
        } else {
            say_lines(&source, &input, &report);
        }
        let are = match report.tally.values().map(|tally| tally.impossible).sum::<usize>() {
            0 => return Ok(()),
            1 => "1 finding is".to_owned(),
            found => format!("{found} findings are"),
        };
        Err(Failure::stale(format!("{source}: {are} impossible under the premises named")))
    }
}

/// The files that `text` includes, but for the file of macros.
fn included(text: &str, macros: &Path) -> Vec<String> {
    let lines = text.lines().map(|line| line.split('%').next().unwrap_or_default());
    let parts = lines.flat_map(|line| line.split('\\').skip(1));
    let named = parts.filter_map(|part| {
        let inside =
            ["input{", "include{", "subfile{"].iter().find_map(|command| part.strip_prefix(command))?;
        Some(inside.split('}').next()?.to_owned())
    });
    named.filter(|name| Path::new(name).file_stem() != macros.file_stem()).collect()
}

/// Tells what `text` holds that no macro backs, and which macros are not what the stored run gives now.
fn covered(text: &Path, macros: &Path) -> Result<(), Failure> {
    let given = read(macros)?;
    let current = match paper(&given) {
        Some(paper) => render::macros(paper)?,
        None => None,
    };
    if current.is_none() {
        let why = "whether its values are stale cannot be told; its first line must be as `replan render PAPER` writes it, \
                   \"% made by `replan render PAPER --only numbers`\", with a paper of this folder";
        say!("{}:1: {why}", macros.display());
    }
    let written = read(text)?;
    let unread = included(&written, macros);
    for file in &unread {
        say!("{}: `{file}` is included and was not read; ask about it by itself", text.display());
    }
    let remarks = coverage::coverage(&written, &given, current.as_deref());
    for remark in &remarks {
        let file = if remark.in_macros { macros } else { text };
        say!("{}:{remark}", file.display());
    }
    match remarks.len() + unread.len() + usize::from(current.is_none()) {
        0 => Ok(()),
        found => {
            Err(Failure::stale(format!("{}: {found} to look at: numbers, macros or files", text.display())))
        }
    }
}

/// The paper that macros were made for, which their first line names.
fn paper(macros: &str) -> Option<&str> {
    macros.lines().next()?.split_once("replan render ")?.1.split_whitespace().next()
}

fn write_certificates(folder: &Path, report: &Report) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| about(folder, &error))?;
    let proved = report.findings.iter().filter_map(|finding| Some((finding, finding.certificate.as_ref()?)));
    for (index, (finding, certificate)) in proved.enumerate() {
        let path = folder.join(format!("{:03}_{}_{}.json", index + 1, finding.place.line, finding.check));
        write(&path, &format!("{certificate:#}\n"))?;
    }
    Ok(())
}

/// Prints what was guessed, what nothing looked at, the findings and how many there are.
fn say_lines(source: &str, input: &Input, report: &Report) {
    let findings = report.findings.iter().map(|finding| output::line(source, finding));
    let remarks = output::guesses(source, input).into_iter().chain(output::unread_spreads(source, input));
    let lines = remarks.chain(output::unseen(source, report)).chain(findings);
    for line in lines.chain(output::summary(report)) {
        say!("{line}");
    }
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    fs::write(path, text).map_err(|error| about(path, &error))
}

fn about(path: &Path, error: &std::io::Error) -> Failure {
    Failure::new(1, format!("{}: {error}", path.display()))
}

fn read(path: &Path) -> Result<String, Failure> {
    let read = if path == Path::new("-") {
        file::read_all(&mut std::io::stdin().lock())
    } else {
        // A pipe is as good as a file here: `replan audit <(command)`.
        fs::File::open(path).and_then(|mut file| file::read_all(&mut file))
    };
    let bytes = read.map_err(|error| {
        Failure::input(format!("{}: {error}; a readable text file is expected", path.display()))
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        Failure::input(format!("{}: byte {at} is not UTF-8; UTF-8 text is expected", path.display()))
    })
}
