//! `replan witness`: searches maps on which a set of claims holds together.

use super::progress::{Bar, safe_point, stop_flag};
use super::{Failure, How, Which, load::load, places::Places};
use crate::analysis::metric;
use crate::analysis::witness::{OnMap, Under, Wanted, Witness as FoundWitness, WitnessSearch};
use base::grid::to_text_map;
use base::hash::sha256;
use base::settings::{Document, none_called};
use clap::Args;
use proofs::exact::Print;
use proofs::printed::Digits;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use study::paper::Paper;
use study::runner::Progress as _;
use study::store::write_whole;

/// Searches maps on which a set of claims holds together.
///
/// Every search starts from a random map of its own and changes a few cells at a time. The first that finds a map ends the
/// command, and the map is written with all that holds on it; searches that found none are remembered, so that the same
/// command goes on behind them.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Witness {
    /// A paper's name, or a folder that holds a paper.toml
    paper: String,
    /// Claims that must hold together, separated by commas; each about a number of one trial
    #[arg(long, value_name = "IDS", value_delimiter = ',', required = true)]
    claims: Vec<String>,
    /// Another number to meet, as in `A*:path_cost_cells=17.65`
    #[arg(long, value_name = "CONTENDER:METRIC=NUMBER")]
    also: Vec<String>,
    /// The interpretation to search under: `meeting=both_closed,ties=lifo`, or `any`; the defaults if absent
    #[arg(long, value_name = "OPTIONS")]
    with: Option<String>,
    /// Root of the seeds of all searches
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    seed: u64,
    /// Most searches
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..))]
    searches: u32,
    /// Most maps of one search
    #[arg(long, value_name = "N", default_value_t = 6000, value_parser = clap::value_parser!(u32).range(1..))]
    maps: u32,
    /// Write below this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  replan witness zhang --claims t1.astar.turn,t1.astar.cost,t1.astar.nodes
  replan witness zhang --claims t1.astar.turn --also 'A*:path_cost_cells=17.65'";

/// How many searches are begun between two looks at what was found.
const TOGETHER: u32 = 8;

/// What is remembered of searches that are over.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Done {
    /// Searches that found no map, from the first on.
    none_in: u32,
    /// Maps that they looked at.
    maps: u64,
}

impl Witness {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let places = Places::find(&Which { paper: self.paper.clone(), out: None }, "")?;
        let how = How { quick: false, seed: None, with: self.options(), threads: None };
        let paper = load(&places, &how)?;
        let (study, group) = WitnessSearch::place(&paper, &self.claims).map_err(Failure::input)?;
        let under = match self.with.as_deref() {
            Some("any") => Under::Any,
            _ => Under::One(how.interpretation(&paper.choices)?),
        };
        let besides = self.also.iter().map(|text| besides(text, study)).collect::<Result<_, _>>()?;
        let claims = self.claims.clone();
        let seed = self.seed;
        let maps = self.maps;
        let hunt = WitnessSearch {
            paper: &paper,
            claims,
            besides,
            study,
            group,
            inputs: &places.inputs,
            under,
            seed,
            maps,
        };
        let out =
            self.out.clone().unwrap_or_else(|| places.home.join("target/replan/witness").join(&paper.id));
        let file = |end: &str| out.join(format!("{}.{end}", self.name(&paper)));
        if let Some(found) = self.searched(&hunt, &file("searches.toml"))? {
            return self.found(&hunt, &found, &file("map.txt"));
        }
        say!("none found in {} searches of {} maps each, {}", self.searches, self.maps, self.request());
        Ok(())
    }

    /// The options as other commands take them.
    fn options(&self) -> Option<String> {
        self.with.clone().filter(|with| with != "any")
    }

    /// The question, in words.
    fn request(&self) -> String {
        let also: Vec<String> = self.also.iter().map(|also| format!(", {also}")).collect();
        let also = also.concat();
        let under = self.with.as_deref().unwrap_or("default");
        format!("for {}{also}; interpretation {under}, seed {}", self.claims.join(", "), self.seed)
    }

    /// What sets these searches apart from all others, in a few letters: all that a search depends on.
    fn name(&self, paper: &Paper) -> String {
        let key = format!("{} {} {} maps", paper.id, self.request(), self.maps);
        sha256(key.as_bytes()).chars().take(12).collect()
    }

    /// Goes through the searches that are left; those that found none are remembered in `file`.
    fn searched(&self, hunt: &WitnessSearch<'_>, file: &Path) -> Result<Option<FoundWitness>, Failure> {
        let mut done = if file.exists() { Document::open(file)?.read_stored()? } else { Done::default() };
        let stop = stop_flag();
        let bar = Bar::default();
        let again = done.none_in.min(self.searches);
        if again > 0 {
            say!("{again} searches found none before");
        }
        bar.begin(&format!("searches of {} maps", self.maps), (self.searches - again) as usize);
        while done.none_in < self.searches {
            let end = self.searches.min(done.none_in + TOGETHER);
            let found = hunt.search_all(done.none_in..end, stop)?;
            if found.is_some() {
                bar.end();
                return Ok(found);
            }
            safe_point(stop, &format!("{} searches are remembered", done.none_in))?;
            (done.none_in..end).for_each(|_| bar.step());
            done = Done { none_in: end, maps: u64::from(end) * u64::from(self.maps) };
            write_whole(file, toml::to_string(&done).expect("numbers can be written").as_bytes())?;
        }
        bar.end();
        Ok(None)
    }

    /// Writes a map that was found, and says what holds on it.
    fn found(&self, hunt: &WitnessSearch<'_>, found: &FoundWitness, file: &Path) -> Result<(), Failure> {
        let holding = hunt.holding(found)?;
        let mut lines = vec![
            format!("search {} of seed {} found a map {}", found.number, self.seed, self.request()),
            format!(
                "maps looked at: {} in {} searches before, {} in this one",
                u64::from(found.number) * u64::from(self.maps),
                found.number,
                found.looked_at
            ),
            format!(
                "interpretation: {}; contenders and ends: study {}, {}",
                found.interpretation.name(),
                hunt.study.name,
                hunt.group.label
            ),
        ];
        lines.extend(holding.iter().map(line));
        let comments: Vec<String> = lines.iter().map(|line| format!("; {line}\n")).collect();
        let comments = comments.concat();
        write_whole(file, (comments + &to_text_map(&found.grid)).as_bytes())?;
        for line in &lines {
            say!("{line}");
        }
        say!("the map is in {}", file.display());
        Ok(())
    }
}

/// One number on a map, as a line.
fn line(on: &OnMap) -> String {
    let word = if on.holds { "holds" } else { "does not hold" };
    let value = on.value.map_or_else(|| "no path".to_owned(), |value| format!("{value:.4}"));
    format!("{word}: {}, printed {}, here {value}", on.name, on.printed)
}

/// The number that `text` asks for besides those of claims.
fn besides(text: &str, study: &study::Study) -> Result<Wanted, Failure> {
    let wrong = || Failure::input(format!("--also: `{text}` is not `CONTENDER:METRIC=NUMBER`"));
    let (contender, rest) = text.rsplit_once(':').ok_or_else(wrong)?;
    let (metric, number) = rest.split_once('=').ok_or_else(wrong)?;
    let labels = || study.contenders.iter().map(|own| own.label.as_str());
    if !labels().any(|label| label == contender) {
        return Err(Failure::input(format!("--also: {}", none_called("contender", contender, labels()))));
    }
    let known = metric::METRICS.iter().filter(|metric| metric.is_produced(&study.columns()));
    let known: Vec<_> = known.collect();
    let found = known.iter().find(|own| own.name == metric).ok_or_else(|| {
        Failure::input(format!("--also: {}", none_called("metric", metric, known.iter().map(|own| own.name))))
    })?;
    let printed = number
        .parse()
        .map_err(|error: proofs::printed::NotANumber| Failure::input(format!("--also: {error}")))?;
    Ok(Wanted {
        name: text.to_owned(),
        contender: contender.to_owned(),
        against: None,
        metric: found,
        print: Print { printed, digits: Digits::Unknown },
    })
}
