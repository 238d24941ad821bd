//! `replan compare`: two stored runs, or two contenders of one, beside each other.

use super::Failure;
use super::places::stored_run;
use super::progress::doing;
use super::verdicts::COLUMNS;
use crate::analysis::agreement::{Agreement, Encoding};
use crate::analysis::compare::{CompareOptions, Comparison, Gate, Outcome, Sides, StoredRun, compare};
use crate::render::{agreement, comparison};
use clap::Args;

/// Compares two stored runs.
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own on the command line")]
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Compare {
    /// A paper's name, a folder that holds a paper.toml, or a stored run: an earlier `--out` or its records
    first: String,
    /// The run to compare with
    #[arg(required_unless_present = "contenders", conflicts_with = "contenders")]
    second: Option<String>,
    /// Two contenders of the first run instead of two runs
    #[arg(long, num_args = 2, value_names = ["X", "Y"])]
    contenders: Vec<String>,
    /// Compare the verdicts of two encodings of one paper, not their records
    #[arg(long, requires = "second", conflicts_with_all = ["contenders", "studies", "metrics", "gates", "csv"])]
    verdicts: bool,
    /// Only this study; may be given several times
    #[arg(long = "study", value_name = "STUDY")]
    studies: Vec<String>,
    /// Only this metric; may be given several times
    #[arg(long = "metric", value_name = "METRIC")]
    metrics: Vec<String>,
    /// End with exit code 3 if the mean of a metric is worse by more than this
    #[arg(long = "gate", value_name = "METRIC ±N%")]
    gates: Vec<String>,
    /// End with exit code 3 also if a gate is undetermined
    #[arg(long, requires = "gates")]
    strict: bool,
    /// Print the changes as comma-separated values with all digits
    #[arg(long, group = "format")]
    csv: bool,
    /// Print everything as JSON
    #[arg(long, group = "format")]
    json: bool,
    /// Print tables of Markdown
    #[arg(long, group = "format")]
    markdown: bool,
}

const EXAMPLES: &str = "Examples:
  replan repro zhang --seed 9        a run to compare with, in target/replan/zhang-seed-9
  replan compare zhang target/replan/zhang-seed-9
  replan compare zhang --contenders 'A*' 'Improved A*' --study ensemble
  replan compare zhang ../their/zhang --verdicts
  replan compare before after --gate 'expansions +2%' --gate 'solved -1%'";

impl Compare {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        if let (true, Some(second)) = (self.verdicts, &self.second) {
            return self.compare_verdicts(second);
        }
        let gates = self
            .gates
            .iter()
            .map(|text| Gate::parse(text))
            .collect::<Result<_, _>>()
            .map_err(Failure::input)?;
        let options = CompareOptions { studies: self.studies.clone(), metrics: self.metrics.clone(), gates };
        doing("reading and comparing stored runs");
        let first = StoredRun::read(&stored_run(&self.first)?, &self.first)?;
        let second =
            self.second.as_ref().map(|name| StoredRun::read(&stored_run(name)?, name).map_err(Failure::from));
        let second = second.transpose()?;
        let sides = match (&second, &self.contenders[..]) {
            (Some(second), _) => Sides::Runs([&first, second]),
            (None, [one, other]) => Sides::Contenders(&first, [one, other]),
            (None, _) => {
                return Err(Failure::input(
                    "two runs are compared, or with --contenders two contenders of one",
                ));
            }
        };
        let found = compare(&sides, &options).map_err(Failure::input)?;
        self.print(&found);
        self.judge(&found)
    }

    /// Prints how the verdicts of both sides agree; a difference is no failure.
    fn compare_verdicts(&self, second: &str) -> Result<(), Failure> {
        let read = |name: &str| Ok::<_, Failure>(Encoding::read(name, &stored_run(name)?)?);
        let [one, other] = [read(&self.first)?, read(second)?];
        let agreement = Agreement::new([&one, &other]);
        let text = if self.json {
            serde_json::to_string_pretty(&agreement).expect("texts alone")
        } else {
            agreement::markdown(&agreement)
        };
        say!("{}", text.trim_end());
        Ok(())
    }

    fn print(&self, found: &Comparison) {
        let text = match () {
            () if self.csv => comparison::csv(found),
            () if self.json => {
                serde_json::to_string_pretty(found).expect("a comparison is texts and numbers") + "\n"
            }
            () if self.markdown => comparison::markdown(found),
            () => comparison::text(found, COLUMNS),
        };
        say!("{}", text.trim_end());
    }

    /// The exit code that the gates ask for.
    fn judge(&self, found: &Comparison) -> Result<(), Failure> {
        let count = |outcome: Outcome| found.gates.iter().filter(|gate| gate.outcome == outcome).count();
        let worse = count(Outcome::Worse);
        let open = count(Outcome::CannotTell);
        if worse == 0 && (open == 0 || !self.strict) {
            return Ok(());
        }
        let lines =
            found.gates.iter().filter(|gate| gate.outcome != Outcome::NotWorse).map(comparison::gate_line);
        Err(Failure::stale(format!(
            "{worse} of {} lines are worse than their gates allow, of {open} that are undetermined:\n  {}",
            found.gates.len(),
            lines.collect::<Vec<_>>().join("\n  ")
        )))
    }
}
