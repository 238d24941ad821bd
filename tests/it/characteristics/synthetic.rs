//! Papers that nobody wrote: a claim, a study, and records drawn from a distribution that is known.

use engine::planner::Value;
use replan::analysis::across::{self, Stored};
use replan::analysis::claims::judge;
use replan::analysis::evidence::{Evidence, default_point};
use replan::analysis::outcome::Outcome;
use replan::analysis::verdict::ClaimVerdict;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use study::Inputs;
use study::key::{InstanceKey, InterpretationKey, SweepKey, SweepValue, TrialKey};
use study::manifest::Manifest;
use study::paper::Paper;
use study::record::{Row, Status, Timing};
use study::store::Records;
use tempfile::TempDir;

/// The claim that is judged.
pub const ASKED: &str = "asked";

/// The values that the sweep takes, where a study has one.
pub const SWEEP: [i64; 4] = [1, 2, 3, 4];

/// How the study of a synthetic paper came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Made {
    /// As any.
    Plainly,
    /// Fitted to the claim.
    Fitted,
    /// Its inputs were searched for.
    Searched,
    /// With a sweep.
    Swept,
    /// With a sweep, fitted to the claim.
    SweptFitted,
    /// With a sweep, over inputs that were searched for.
    SweptSearched,
    /// With interpretations of a clock.
    Timed,
}

/// A paper with one claim that is asked, in a folder of its own.
pub struct Synthetic {
    _folder: TempDir,
    paper: Paper,
}

impl Synthetic {
    /// The paper whose claims are `claims`, as TOML, and whose study was made so.
    pub fn new(claims: &str, made: Made) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("synthetic");
        fs::create_dir_all(&place).unwrap();
        let paper = format!("[source]\ntitle = \"A synthetic paper\"\nours = true\n{claims}");
        fs::write(place.join("paper.toml"), paper).unwrap();
        fs::write(place.join("drawn.toml"), study(made)).unwrap();
        let inputs = Inputs::below(vec![Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()]);
        let paper = Paper::load(&place, &inputs).unwrap_or_else(|error| panic!("{error}\n{claims}"));
        Self { _folder: folder, paper }
    }

    /// The outcome of the claim that is asked, after `records`, where the paper prints these numbers, by claim.
    pub fn judged(&mut self, records: Records, printed: &[(&str, String)]) -> Outcome {
        self.judgement(records, printed).outcome
    }

    /// Makes its claims those of other authors.
    pub fn of_others(&mut self) {
        self.paper.source.ours = false;
    }

    /// All that is found of it.
    pub fn judgement(&mut self, records: Records, printed: &[(&str, String)]) -> ClaimVerdict {
        for (id, text) in printed {
            let claim = self.paper.claims.iter_mut().find(|claim| claim.id == *id).unwrap();
            claim.printed = Some(text.clone());
        }
        let stored = BTreeMap::from([("drawn".to_owned(), (manifest(), records))]);
        let evidence = Evidence::held(&self.paper, default_point(&self.paper), stored);
        let mut verdicts = judge(&evidence).unwrap();
        across::apply(&self.paper, &mut verdicts, &Stored::default());
        verdicts.claim(ASKED).unwrap().clone()
    }
}

fn study(made: Made) -> String {
    let head = match made {
        Made::Fitted | Made::SweptFitted => format!("fitted_to = [\"{ASKED}\"]\n"),
        Made::Searched | Made::SweptSearched => "searched = true\n".to_owned(),
        _ => String::new(),
    };
    let is_swept = matches!(made, Made::Swept | Made::SweptFitted | Made::SweptSearched);
    let settings = if is_swept { "" } else { "weight = 1, " };
    let contender = |label: &str| {
        format!(
            "[[contender]]\nlabel = \"{label}\"\nplanner = \"astar\"\nsettings = {{ {settings}ties = \"fifo\" }}\n"
        )
    };
    let group = |label: &str| {
        format!(
            "[[problems]]\nlabel = \"{label}\"\nfamily = \"random_cells\"\ninstances = 1_000\nsettings = {{ size_cells = [9, 9], \
             start = [0, 0], goal = [8, 8], blocked_share = 0.2, corner_rule = \"allow\" }}\n"
        )
    };
    let mut text = format!(
        "paper = \"synthetic\"\nquestion = \"None.\"\nseed = 1\n{head}[budget]\nexpansions = 1_000\n{}{}{}{}",
        group("map"),
        group("other"),
        contender("A"),
        contender("B")
    );
    if is_swept {
        text += &format!("[[sweep]]\nkey = \"weight\"\nstage = \"astar\"\nvalues = {SWEEP:?}\n");
    }
    if made == Made::Timed {
        text += "[timing]\nproblems = 1_000\nrepeats = 1\n";
    }
    text
}

fn manifest() -> Manifest {
    Manifest {
        study: "drawn".to_owned(),
        command: "none".to_owned(),
        seed: 1,
        interpretations: vec![Vec::new()],
        ..Manifest::default()
    }
}

/// How a synthetic trial ended.
#[derive(Debug, Clone, Copy)]
pub enum End {
    /// Solved, with this cost.
    At(f64),
    /// Without a path.
    NoPath,
    /// With a path that the verifier refuses.
    Rejected,
    /// When the budget was spent.
    Spent,
    /// Not at all: the problem cannot be posed.
    Unposed,
}

impl End {
    /// Whether it was solved.
    pub fn is_at(self) -> bool {
        matches!(self, Self::At(_))
    }
}

/// Records in the making.
#[derive(Default)]
pub struct Sample {
    records: Records,
    on: Option<Arc<InstanceKey>>,
}

impl Sample {
    /// Begins the next instance.
    pub fn instance(&mut self) {
        self.instance_on("map");
    }

    /// Begins the next instance, of one of the two groups.
    pub fn instance_on(&mut self, group: &str) {
        let instance = self.on.as_ref().map_or(0, |on| on.instance + 1);
        let key = InstanceKey {
            group: group.into(),
            sweep: SweepKey::default(),
            instance,
            interpretation: InterpretationKey::default(),
        };
        self.on = Some(Arc::new(key));
    }

    /// It, with an instance begun: what becomes of its trials is asked of nobody.
    pub fn begun(mut self) -> Self {
        self.instance();
        self
    }

    /// A trial of `contender` on the instance.
    pub fn trial(&mut self, contender: &str, end: End) {
        self.query(contender, None, None, end);
    }

    /// A trial of `contender` on one of the instance's queries, at one value of the sweep.
    pub fn query(&mut self, contender: &str, query: Option<u32>, swept: Option<i64>, end: End) {
        let sweep = swept.map(|value| ("weight".into(), SweepValue::Whole(value)));
        let key = TrialKey {
            on: self.on.clone().unwrap(),
            query: query.map(|query| query.to_string().into()),
            contender: contender.into(),
            sweep: SweepKey::new(sweep.into_iter().collect()),
            repeat: 0,
        };
        let (status, value) = match end {
            End::At(value) => (Status::Solved, Some(value)),
            End::NoPath => (Status::NoPath, None),
            End::Rejected => (Status::Rejected, None),
            End::Spent => (Status::BudgetSpent, None),
            End::Unposed => (Status::InvalidProblem, None),
        };
        let values = value.into_iter().map(|value| ("path_cost_cells", Value::Real(value))).collect();
        self.records.batch.rows.push(Row { key, seed: Some(1), status, reason: None, values });
    }

    /// A trial of `contender` on the instance, with one of its seeds.
    pub fn seed(&mut self, contender: &str, repeat: u32, end: End) {
        self.trial(contender, end);
        self.records.batch.rows.last_mut().unwrap().key.repeat = repeat;
    }

    /// Gives the trial that was put last one more number.
    pub fn with(&mut self, column: &str, value: f64) {
        let row = self.records.batch.rows.last_mut().unwrap();
        row.values.extend([(column, Value::Real(value))]);
    }

    /// Lets every trial that was not solved have spent its budget.
    pub fn spend(&mut self) {
        for row in self.records.batch.rows.iter_mut().filter(|row| row.status == Status::NoPath) {
            row.status = Status::BudgetSpent;
        }
    }

    /// A time, for the trial that was put last.
    pub fn clock(&mut self, session: u32, plan_wall_ns: f64) {
        let trial = self.records.batch.rows.last().unwrap().key.clone();
        let plan_wall_ns = plan_wall_ns as u64;
        self.records.times.push(Timing { trial, session, clock_repeat: 0, plan_wall_ns });
    }

    /// The records.
    pub fn records(self) -> Records {
        self.records
    }
}
