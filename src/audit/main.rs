//! The program `replan-audit`, which `replan audit` runs: is this table possible?
//!
//! Exit codes: 0 done; 1 the system refused; 2 wrong words on the command line or wrong input; 3 findings. A finding is
//! something that is impossible under the premises named, or a number or macro of a text to look at.

use base::{file, text};
use clap::Parser;
use replan_audit::input::Input;
use replan_audit::reader::{self, Format};
use replan_audit::report::{Options, Report, audit};
use replan_audit::table::Fault;
use replan_audit::witness::Budget;
use replan_audit::{claims, coverage, output};
use std::fs;
use std::io::{self, Write as _};
use std::num::NonZero;
use std::os::unix::fs::FileTypeExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Asks of a printed table, by arithmetic alone, whether any data could have given it.
#[derive(Parser)]
#[command(bin_name = "replan audit", version, after_help = EXAMPLES, max_term_width = 100)]
struct Audit {
    /// A table (CSV, Markdown, LaTeX) or relations (TOML); `-` for standard input
    #[arg(required_unless_present_any = ["list", "coverage"])]
    file: Option<PathBuf>,
    /// How the input is written; by its ending or looks if absent
    #[arg(long, value_name = "FORMAT", value_parser = ["csv", "md", "tex", "toml"])]
    format: Option<String>,
    /// Print the whole report, certificates included, as JSON
    #[arg(long)]
    json: bool,
    /// Show data that would print each possible number, at most this many vectors a number
    #[arg(long, value_name = "COUNT", num_args = 0..=1, default_missing_value = "20")]
    witness: Option<NonZero<usize>>,
    /// Try data in an order drawn from this seed: a sample, and not the first ones
    #[arg(long, value_name = "SEED", requires = "witness")]
    seed: Option<u64>,
    /// Steps that the search for data may take for each number
    #[arg(long, value_name = "STEPS", default_value_t = 100_000, requires = "witness")]
    budget: u64,
    /// Write the certificate of every impossible finding into this folder
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
    /// Write the table's header with every guess, to be corrected
    #[arg(long, value_name = "FILE")]
    stub: Option<PathBuf>,
    /// Print the table as `[[table]]` of a paper.toml, each number a claim, and audit nothing
    #[arg(long, conflicts_with_all = ["json", "witness", "certificates", "stub"])]
    to_claims: bool,
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
  replan audit results.md             its head: | method | success [% of 250] |
  replan audit results.csv --json
  replan audit table.tex --to-claims
  replan audit claims.toml --witness
  replan audit --coverage paper.tex --macros plots/zhang/numbers.tex
Exit code 3: something is impossible under the premises named, or a number is backed by no macro.";

/// Why the program ends without success: its exit code and what it says.
struct Failure(u8, String);

fn main() -> ExitCode {
    match Audit::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure(code, message)) => {
            // Nobody is left to read what standard error refuses.
            let _ = writeln!(io::stderr(), "replan: {message}");
            ExitCode::from(code)
        }
    }
}

impl Audit {
    fn run(self) -> Result<(), Failure> {
        if self.list {
            return print(&output::list());
        }
        if let (Some(text), Some(macros)) = (&self.coverage, &self.macros) {
            covered(text, macros)?;
        }
        self.file.as_deref().map_or(Ok(()), |file| self.audited(file))
    }

    /// Audits the tables and relations of `file`.
    fn audited(&self, file: &Path) -> Result<(), Failure> {
        let source = if file == Path::new("-") { "stdin".to_owned() } else { file.display().to_string() };
        let text = read(file)?;
        let by_ending = file.extension().and_then(|ending| Format::of_ending(&ending.to_string_lossy()));
        let given = self.format.as_deref().and_then(Format::of_ending);
        let format = given.or(by_ending).unwrap_or_else(|| Format::of_text(&text));
        let wrong = |faults: Vec<Fault>| {
            let lines: Vec<String> = faults.iter().map(|fault| format!("{source}:{fault}")).collect();
            Failure(2, lines.join("\n"))
        };
        let input = reader::read(&text, format).map_err(wrong)?;
        if self.to_claims {
            let tables = (1..).zip(&input.tables).map(|(number, table)| claims::toml(table, number));
            return print(&tables.collect::<Vec<_>>().join("\n"));
        }
        if let Some(stub) = &self.stub {
            let header = |table| format!("{}\n", reader::stub_line(table));
            write(stub, &input.tables.iter().map(header).collect::<String>())?;
        }
        let witness =
            self.witness.map(|most| Budget { most: most.get(), steps: self.budget, seed: self.seed });
        let skips_certificates = !self.json && self.certificates.is_none();
        let options =
            Options { keeps_possible: self.json, skips_certificates, witness, ..Options::default() };
        let report = audit(&input, &options).map_err(wrong)?;
        if let Some(folder) = &self.certificates {
            write_certificates(folder, &report)?;
        }
        if self.json {
            print(&format!("{:#}\n", output::json(&source, &input, &report)))?;
        } else {
            print(&lines(&source, &input, &report))?;
        }
        let are = match report.tally.values().map(|tally| tally.impossible).sum::<usize>() {
            0 => return Ok(()),
            1 => "1 finding is".to_owned(),
            found => format!("{found} findings are"),
        };
        Err(Failure(3, format!("{source}: {are} impossible under the premises named")))
    }
}

/// Lists the numbers in `text` that no macro backs, and the macros whose value is not the current one.
fn covered(text: &Path, macros: &Path) -> Result<(), Failure> {
    let given = read(macros)?;
    let current = current(&given);
    let mut listed = String::new();
    if let Err(why) = &current {
        listed += &format!("{}:1: whether its values are stale is unknown; {why}\n", macros.display());
    }
    let written = read(text)?;
    let unread = included(&written, macros);
    for file in &unread {
        listed +=
            &format!("{}: `{file}` is included and was not read; ask about it by itself\n", text.display());
    }
    for remark in coverage::coverage(&written, &given, current.as_deref().ok()) {
        let file = if remark.in_macros { macros } else { text };
        listed += &format!("{}:{remark}\n", file.display());
    }
    print(&listed)?;
    match listed.lines().count() {
        0 => Ok(()),
        found => Err(Failure(3, format!("{}: {found} to look at: numbers, macros or files", text.display()))),
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

/// The macros that the paper's stored run gives now: those in its plots, if `replan` finds them current. Else why not.
fn current(macros: &str) -> Result<String, String> {
    let named = macros.lines().next().and_then(|line| line.split_once("replan render "));
    let paper = named.and_then(|(_, rest)| rest.split_whitespace().next());
    let Some(paper) = paper.filter(|paper| Path::new("experiments").join(paper).is_dir()) else {
        return Err("its first line must be as `replan render PAPER` writes it, \
                    \"% made by `replan render PAPER --only numbers`\", with a paper of this folder"
            .to_owned());
    };
    // `replan` says where it is to the programs that it runs.
    let beside =
        std::env::current_exe().map(|own| own.with_file_name("replan")).ok().filter(|it| it.is_file());
    let replan = std::env::var_os("REPLAN").map(PathBuf::from).or(beside).unwrap_or("replan".into());
    let mut check = Command::new(&replan);
    match check.args(["render", "--check", "--only", "numbers", "--", paper]).output() {
        Ok(checked) if checked.status.success() => {
            let path = format!("plots/{paper}/numbers.tex");
            fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))
        }
        Ok(checked) => {
            let message = String::from_utf8_lossy(&checked.stderr);
            Err(message.lines().last().unwrap_or_default().trim_start_matches("replan: ").to_owned())
        }
        Err(error) => Err(format!("`{}`, which checks them, cannot be run: {error}", replan.display())),
    }
}

/// What was guessed, what nothing looked at, the findings and how many there are, a line each.
fn lines(source: &str, input: &Input, report: &Report) -> String {
    let findings = report.findings.iter().map(|finding| output::line(source, finding));
    let remarks = output::guesses(source, input).into_iter().chain(output::unread_spreads(source, input));
    let remarks = remarks.chain(output::totals(source, input));
    let lines = remarks.chain(output::unseen(source, report)).chain(findings);
    lines.chain(output::summary(report)).map(|line| line + "\n").collect()
}

fn write_certificates(folder: &Path, report: &Report) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| refused(folder, &error))?;
    let proved = report.findings.iter().filter_map(|finding| Some((finding, finding.certificate.as_ref()?)));
    for (index, (finding, certificate)) in proved.enumerate() {
        let path = folder.join(format!("{:03}_{}_{}.json", index + 1, finding.place.line, finding.check));
        write(&path, &format!("{certificate:#}\n"))?;
    }
    Ok(())
}

/// Prints `text`; a reader that closed the pipe early (`head`) is no failure of ours.
fn print(text: &str) -> Result<(), Failure> {
    match io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure(1, format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    fs::write(path, text).map_err(|error| refused(path, &error))
}

fn refused(path: &Path, error: &io::Error) -> Failure {
    Failure(1, format!("{}: {error}", path.display()))
}

/// The file or pipe at `path`.
fn opened(path: &Path) -> io::Result<fs::File> {
    let kind = fs::metadata(path)?.file_type();
    if kind.is_file() || kind.is_fifo() {
        return fs::File::open(path);
    }
    Err(io::Error::other("it is a folder, a device or a socket; a regular file or a pipe is accepted"))
}

/// The text of a file, a pipe (`replan audit <(command)`) or standard input.
fn read(path: &Path) -> Result<String, Failure> {
    let bytes = if path == Path::new("-") {
        file::read_all(&mut io::stdin())
    } else {
        opened(path).and_then(|mut file| file::read_all(&mut file))
    };
    let text = bytes.map_err(|error| error.to_string()).and_then(text::decoded);
    text.map_err(|what| Failure(2, format!("{}: {what}", path.display())))
}
