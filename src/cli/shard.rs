//! `replan shard`: a run cut into shards, and the script that runs them on one machine or many.

use super::consent::Consent;
use super::explorer::Explorer;
use super::one_shard;
use super::rounds::Round;
use super::run::check_is_run;
use super::sharded::Sharded;
use super::{Failure, How, confirm, explore};
use base::text::shell_word;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use study::manifest::MadeBy;
use study::plan::Plan;
use study::store::write_whole;

/// Cuts a run into shards.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Shard {
    /// A paper's name, or a folder that holds a paper.toml
    paper: String,
    #[command(flatten)]
    how: How,
    #[command(flatten)]
    consent: Consent,
    /// Split `replan explore` instead, round by round
    #[arg(long, conflicts_with_all = ["quick", "seed", "interpretations", "confirm"])]
    explore: bool,
    /// Split `replan confirm` instead, round by round
    #[arg(long, conflicts_with_all = ["quick", "seed", "interpretations"])]
    confirm: bool,
    /// The program that runs the shards
    #[arg(long)]
    engine: Engine,
    /// Number of shards
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    shards: u32,
    /// The folder for the shards, the plan and the script
    #[arg(long, value_name = "PARTS")]
    out: PathBuf,
    /// Where the script merges the parts; not for `--explore` and `--confirm`, which merge beside the default run
    #[arg(long, value_name = "DIR", required_unless_present_any = ["explore", "confirm"])]
    merge: Option<PathBuf>,
    /// Most tasks of a Slurm array; each runs several shards
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..))]
    tasks: u32,
}

const EXAMPLES: &str = "Examples:
  replan shard fu2018 --engine slurm --shards 200 --out parts --merge merged
  replan shard zhang --engine parallel --explore --out parts";

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Engine {
    /// A Python program on the package hyperqueue, for this machine or a server's workers
    Hyperqueue,
    /// An array job for sbatch
    Slurm,
    /// A line for GNU parallel
    Parallel,
}

impl Shard {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        MadeBy::here();
        let sharded = self.sharded()?;
        self.consent.check(sharded.studies_alone(), &sharded.places)?;
        let shards = self.shards as usize;
        let folder = sharded.folder(&self.out);
        let plan = Plan::agreed(&folder, &sharded.wanted(shards), &sharded.studies()?)?;
        let (name, template, start) = match self.engine {
            Engine::Hyperqueue => ("run_hyperqueue.py", include_str!("shard/hyperqueue.py"), "python3"),
            Engine::Slurm => ("run_slurm.sh", include_str!("shard/slurm.sh"), "bash"),
            Engine::Parallel => ("run_parallel.sh", include_str!("shard/parallel.sh"), "bash"),
        };
        let path = self.out.join(name);
        write_whole(&path, self.filled(template, &plan, &folder)?.as_bytes())?;
        say!("{} units in {shards} shards", plan.units());
        say!("to run them: {start} {}", path.display());
        Ok(())
    }

    /// What is cut.
    fn sharded(&self) -> Result<Sharded, Failure> {
        let of_round = |first, points: fn(&Explorer<'_>) -> _| {
            one_shard::sharded(&self.paper, self.how.threads, &self.out, first, points)
        };
        match (self.explore, self.confirm) {
            (true, _) => of_round(Round::First, explore::first_points),
            (_, true) => of_round(Round::Default, confirm::first_points),
            _ => {
                check_is_run(&self.out)?;
                Sharded::load(&self.paper, &self.how)
            }
        }
    }

    /// How many rounds there are at most: what is left of them over finds nothing to do.
    fn rounds(&self) -> usize {
        match (self.explore, self.confirm) {
            (true, _) => 3,
            (_, true) => 2,
            _ => 1,
        }
    }

    /// The script: `template` with what stands in capitals between `@` filled in.
    fn filled(&self, template: &str, plan: &Plan, folder: &Path) -> Result<String, Failure> {
        let shards = plan.shards;
        let here = std::env::current_dir()?;
        let program = std::env::current_exe()?;
        let threads = self.how.threads.unwrap_or(1);
        let number = match self.engine {
            Engine::Hyperqueue => "@K@",
            Engine::Slurm => "$shard",
            Engine::Parallel => "{}",
        };
        let mut run = plan.arguments(folder, &format!("{number}/{shards}"));
        run.extend(["--threads".to_owned(), threads.to_string()]);
        let mut merge = ["merge", &shown(&self.out)].map(str::to_owned).to_vec();
        if self.consent.is_large_allowed() {
            for words in [&mut run, &mut merge] {
                words.push("--allow-large".to_owned());
            }
        }
        merge.extend(self.merge.iter().flat_map(|out| ["--out".to_owned(), shown(out)]));
        let in_shell = |word: &String| {
            // The script itself fills the number in.
            if word.starts_with(number) { format!("\"{word}\"") } else { shell_word(word).into_owned() }
        };
        let words = |words: &[String]| match self.engine {
            Engine::Hyperqueue => serde_json::to_string(words).expect("words are texts"),
            Engine::Slurm | Engine::Parallel => words.iter().map(in_shell).collect::<Vec<_>>().join(" "),
        };
        let word = |word: String| match self.engine {
            Engine::Hyperqueue => serde_json::to_string(&word).expect("a word is a text"),
            Engine::Slurm | Engine::Parallel => shell_word(&word).into_owned(),
        };
        let pairs = [
            ("@NAME@", sharded_name(&self.paper)),
            ("@FOLDER@", word(shown(&here))),
            ("@PROGRAM@", word(shown(&program))),
            ("@PARTS@", word(shown(&self.out))),
            ("@RUN@", words(&run)),
            ("@MERGE@", words(&merge)),
            ("@ROUNDS@", self.rounds().to_string()),
            ("@SHARDS@", plan.shards.to_string()),
            ("@TASKS@", plan.shards.min(self.tasks as usize).to_string()),
            ("@THREADS@", threads.to_string()),
        ];
        Ok(pairs.iter().fold(template.to_owned(), |text, (mark, value)| text.replace(mark, value)))
    }
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

/// The paper's name as a job bears it.
fn sharded_name(paper: &str) -> String {
    let name = Path::new(paper)
        .file_name()
        .map_or_else(|| paper.to_owned(), |name| name.to_string_lossy().into_owned());
    study::slug(&name)
}
