//! `replan conformance`: tells the author of a planner from outside what of the protocol it breaks.

use super::places::home;
use super::progress::stop_flag;
use super::{Failure, counted};
use base::settings::Settings;
use clap::Args;
use engine::planner::{Build, Counts, Ending, Plan, Request};
use engine::space::World;
use external::message::{Hello, Limits, Seeding};
use external::world::Kind;
use external::{End, Process, Program, Query, Space, Talk, describe, greet, solve};
use study::family::{self, Query as Posed};
use study::record::Status;
use study::verification::{Guide, truth, verify};
use study::{Inputs, clock, contender::Pipeline, planner};

/// Tries a planner from outside on small worlds of the kinds that it names.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Conformance {
    /// Time limit of a query in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 2.0)]
    time_s: f64,
    /// Memory limit of each process in megabytes (address space)
    #[arg(long, value_name = "MB", default_value_t = 4096)]
    memory_mb: u64,
    /// The program and its arguments
    #[arg(required = true, last = true, value_name = "COMMAND")]
    command: Vec<String>,
}

const EXAMPLES: &str = "Examples:
  replan conformance -- python3 planner.py
  replan conformance --time-s 10 -- ./planner --fast";

/// Families that pose small problems, by the kind of world, with what is laid over their examples.
const WORLDS: [(Kind, &str, &str); 5] = [
    (Kind::Grid, "random_cells", "corner_rule = \"forbid_any\"\nvertices = \"centres\""),
    (Kind::PlanarArm, "arm_workspace", "obstacles_cm = [[-35, 20]]\nhop_check = \"continuous\""),
    (Kind::Cell, "cell_queries", "samples = 1\npath = \"joints\""),
    (Kind::Polyhedra, "random_polyhedra", ""),
    (Kind::Plane, "plane_queries", "samples = 1"),
];

/// How many queries are posed in a world.
const QUERIES: usize = 3;

impl Conformance {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        stop_flag();
        let limits = Limits { time_s: self.time_s, memory_mb: self.memory_mb, output_mb: 64 };
        let program = Program { command: self.command, limits, hello_s: 10.0 };
        let mut trial = Trial { program, broken: 0 };
        let Some(hello) = trial.hello()? else { return trial.verdict() };
        let mut solved = 0;
        for (kind, family, over) in WORLDS {
            if hello.worlds.contains(&kind) {
                match posed(family, over) {
                    Ok((world, queries)) => solved += trial.world(kind, &world, &queries, &hello),
                    Err(why) => say!("  passed over: no world of kind {kind} here: {why}"),
                }
            }
        }
        trial.keeps("some query is solved", (solved == 0).then(|| "none was".to_owned()));
        trial.verdict()
    }
}

/// A small world of the family, and queries in it.
fn posed(name: &str, over: &str) -> Result<(World, Vec<Posed>), String> {
    let entry = family::find(name).expect("the families of conformance are registered");
    let table = |text: &str| toml::from_str(text).expect("settings of conformance are TOML");
    let settings =
        Settings::composed("conformance", table(entry.example)).overlaid(&table(over), "conformance");
    let root = home(None).map_err(|failure| failure.message)?;
    let inputs = Inputs::below(vec![root]);
    let family = (entry.build)(&settings, &inputs).map_err(|error| error.to_string())?;
    let preprocessing =
        (0..100).find_map(|seed| family.prepare(seed).ok().map(|preprocessing| (seed, preprocessing)));
    let (seed, preprocessing) = preprocessing.ok_or("no instance can be posed")?;
    let queries = family.queries_for(seed).into_iter().take(QUERIES).collect();
    Ok((preprocessing.world, queries))
}

/// A program that is tried, and how many rules it broke.
struct Trial {
    program: Program,
    broken: usize,
}

impl Trial {
    /// Notes whether a rule is kept.
    fn keeps(&mut self, rule: &str, broken: Option<String>) {
        match broken {
            None => say!("  kept    {rule}"),
            Some(why) => {
                say!("  BROKEN  {rule}: {why}");
                self.broken += 1;
            }
        }
    }

    fn verdict(&self) -> Result<(), Failure> {
        match self.broken {
            0 => Ok(()),
            broken => Err(Failure::stale(format!(
                "broken: {} of docs/PLANNER_PROTOCOL.md",
                counted(broken, ["rule", "rules"])
            ))),
        }
    }

    /// What the program says of itself, if it does.
    fn hello(&mut self) -> Result<Option<Hello>, Failure> {
        let mut process =
            Process::start(&self.program).map_err(|error| Failure::new(4, error.to_string()))?;
        let greeted = greet(&mut process, &self.program);
        self.keeps("it says `hello` within ten seconds", greeted.as_ref().err().cloned());
        let Ok(hello) = greeted else { return Ok(None) };
        let kinds: Vec<String> = hello.worlds.iter().map(ToString::to_string).collect();
        say!("  {} {}, for {}", hello.name, hello.version, kinds.join(", "));
        let stays = (!process.quit()).then(|| "it had to be ended".to_owned());
        self.keeps("it ends within half a second after `quit`", stays);
        Ok(Some(hello))
    }

    /// Poses every query of one world; how many were solved by paths that the verifier accepts.
    fn world(&mut self, kind: Kind, world: &World, queries: &[Posed], hello: &Hello) -> usize {
        say!("{kind}");
        let mut solved = 0;
        let mut process = None;
        for (index, query) in queries.iter().enumerate() {
            let seed = index as u64 + 1;
            let talk = self.talk(&mut process, hello, world, query, seed);
            let what = format!("query {}", index + 1);
            if let End::Broken(why) = &talk.end {
                self.keeps(&format!("{what} ends with a result"), Some(why.clone()));
                continue;
            }
            let late = talk.end == End::TimeSpent && talk.wall_ns as f64 * 1e-9 > self.program.limits.time_s;
            let late = (talk.is_cut_off || late)
                .then(|| format!("{} s were not enough{}", self.program.limits.time_s, talk.hint()));
            self.keeps(&format!("{what} ends in time"), late);
            if talk.end == End::Solved {
                let refused = refusal(world, query, &talk);
                solved += usize::from(refused.is_none());
                self.keeps(&format!("{what} is solved and the verifier accepts its path"), refused);
            }
            if hello.deterministic {
                let again = self.talk(&mut None, hello, world, query, seed);
                let differs =
                    (again.path != talk.path).then(|| "another process gave another path".to_owned());
                self.keeps(&format!("{what} gives the same path again, as promised"), differs);
            }
        }
        solved
    }

    /// One conversation: in the process at hand if there is one and the planner can be seeded with every query.
    fn talk(
        &self,
        process: &mut Option<Process>,
        hello: &Hello,
        world: &World,
        query: &Posed,
        seed: u64,
    ) -> Talk {
        let mut own = match process.take() {
            Some(waiting) => waiting,
            None => match Process::start(&self.program) {
                Ok(mut fresh) => match greet(&mut fresh, &self.program) {
                    Ok(_) => fresh,
                    Err(why) => return Talk::broken(why),
                },
                Err(error) => return Talk::broken(error.to_string()),
            },
        };
        let data = describe(world, false).expect("these worlds are of the protocol");
        let posed = Query { id: seed, seed, world: data, start: &query.start, goal: &query.goal };
        let mut space = Space::new(world, false);
        let talk = solve(&mut own, posed, self.program.limits, &mut space, clock::now_ns);
        let is_sound = matches!(talk.end, End::Solved | End::NoPath | End::BudgetSpent) && !talk.is_cut_off;
        if hello.seeding == Seeding::Query && is_sound {
            *process = Some(own);
        }
        talk
    }
}

/// Why the verifier refuses the path; `None` if it does not.
fn refusal(world: &World, query: &Posed, talk: &Talk) -> Option<String> {
    let Posed { start, goal, .. } = query;
    let request = Request { world, start, goal, expansions: 1, seed: 0, trace: false };
    let path = talk.path.clone();
    let cost = talk.cost.or_else(|| Space::new(world, false).cost(&path));
    let counts = Counts::new();
    let traces = Vec::new();
    let plan = Plan { ending: Ending::Solved, path, cost, counts, traces, reason: None };
    let Build::Planner(build) = planner::external::ENTRY.build else { unreachable!("it is a planner") };
    let table = toml::from_str(NOBODY).expect("settings of conformance are TOML");
    let planner = build(&Settings::composed("conformance", table)).expect("its settings are complete");
    let pipeline = Pipeline { planner, stages: Vec::new() };
    match verify(&request, &plan, &pipeline, &truth(world, query, &Guide::default())).outcome {
        (Status::Solved, _) => None,
        (status, reason) => Some(format!("{status}: {}", reason.unwrap_or_default())),
    }
}

/// A planner from outside, used only for how its paths are verified.
const NOBODY: &str = "command = [\"none\"]\nfiles = []\nversion = \"\"\ntime_s = 1.0\nmemory_mb = 16\noutput_mb = 1\ninstall = \"\"\n";
