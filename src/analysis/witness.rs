//! Searches for maps on which a set of claims holds together.
//!
//! The maps of a paper may be lost. A search starts from a map drawn from its own seed and changes a few cells at a
//! time, as simulated annealing does. A change is kept if the numbers come nearer to the printed ones, and otherwise
//! with a chance that falls. A claim that holds on a map so found is attainable, never reproduced; a search that finds
//! none proves nothing. Searches are numbered, and each depends on the seed and its number alone. Of those that find a
//! map the first counts, whatever the number of threads.

mod walk;

use super::context::Context;
use super::criterion::{Attained, EXISTS};
use super::metric::Metric;
use base::grid::{CornerRule, Grid2, independent_cells};
use base::seed::{self, Stream};
use engine::planner::{Counts, Ending, Request, Value};
use engine::space::{LatticeWorld, World};
use proofs::exact::Print;
use rand::RngExt as _;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use study::contender::{Pipeline, SweepPoint};
use study::paper::Paper;
use study::record::Status;
use study::verification::{self, Guide};
use study::{Choice, Group, Inputs, Interpretation, Study, StudyError};
use walk::Walk;

/// Which interpretation maps are searched under.
#[derive(Debug, Clone)]
pub enum Under {
    /// This one.
    One(Interpretation),
    /// One that each search draws from the options that vote.
    Any,
}

/// A number that a map is to give: a claim's, or one named in the call.
#[derive(Debug, Clone)]
pub struct Wanted {
    /// What it is called: the claim's id, or the words of the call.
    pub name: String,
    /// The contender that it is a number of.
    pub contender: String,
    /// The contender that it is a reduction from, in per cent; `None` if it is no reduction.
    pub against: Option<String>,
    /// What is measured.
    pub metric: &'static Metric,
    /// What is printed.
    pub print: Print,
}

/// What is searched for.
pub struct WitnessSearch<'a> {
    /// The paper.
    pub paper: &'a Paper,
    /// The claims that must hold together.
    pub claims: Vec<String>,
    /// Numbers besides those of claims.
    pub besides: Vec<Wanted>,
    /// The study whose contenders and ends are taken …
    pub study: &'a Study,
    /// … and its problem group.
    pub group: &'a Group,
    /// Where input files are.
    pub inputs: &'a Inputs,
    /// Which interpretation.
    pub under: Under,
    /// The root of every search's seed.
    pub seed: u64,
    /// Most maps that one search looks at.
    pub maps: u32,
}

/// A map on which everything wanted holds.
#[derive(Debug, Clone)]
pub struct Witness {
    /// The search that found it.
    pub number: u32,
    /// The interpretation.
    pub interpretation: Interpretation,
    /// The map.
    pub grid: Grid2,
    /// How many maps the search had looked at.
    pub looked_at: u32,
}

/// What a claim's number is on a map.
#[derive(Debug, Clone)]
pub struct OnMap {
    /// The claim, or the words of the call that name the number.
    pub name: String,
    /// What is printed.
    pub printed: String,
    /// What the map gives, if both contenders found a path.
    pub value: Option<f64>,
    /// Whether they agree.
    pub holds: bool,
}

impl<'a> WitnessSearch<'a> {
    /// The study and problem group with one map of cells that all of `claims` are about.
    ///
    /// # Errors
    /// A message: a claim is unknown, prints no number that some trial may meet, or speaks of other maps than the first.
    pub fn place(paper: &'a Paper, claims: &[String]) -> Result<(&'a Study, &'a Group), String> {
        let point = Interpretation::new(&paper.choices, &BTreeMap::new())?;
        let numbers = numbers_of_claims(paper, &point, claims)?;
        let on_map = |group: &&Group| {
            group.family.name == "grid_map"
                && !group.is_drawn
                && group.points.len() == 1
                && group.instances == 1
        };
        for study in paper.studies.iter().filter(|study| study.searched) {
            let mut groups = study.groups.iter().filter(on_map);
            let all = |group: &&Group| numbers.iter().all(|one| one.looks_at(&study.name, &group.label));
            if let Some(group) = groups.find(all) {
                return Ok((study, group));
            }
        }
        Err(format!(
            "no study that is marked `searched` has one map that all of {} look at",
            claims.join(", ")
        ))
    }

    /// The first of the searches with these numbers that finds a map.
    ///
    /// # Errors
    /// Those of contenders and families; [`StudyError::Interrupted`] never: a stopped search finds nothing.
    pub fn search_all(&self, numbers: Range<u32>, stop: &AtomicBool) -> Result<Option<Witness>, StudyError> {
        let found = numbers.into_par_iter().find_map_first(|number| self.search(number, stop).transpose());
        found.transpose()
    }

    /// What search `number` finds.
    ///
    /// # Errors
    /// As [`search_all`](Self::search_all).
    pub fn search(&self, number: u32, stop: &AtomicBool) -> Result<Option<Witness>, StudyError> {
        let names = [&self.paper.id, "witness", &self.claims.join(","), &number.to_string()];
        let mut stream = seed::stream(seed::derive(self.seed, &names));
        let interpretation = match &self.under {
            Under::One(point) => point.clone(),
            Under::Any => drawn(&self.paper.choices, &mut stream),
        };
        let ground = Ground::new(self, &interpretation, false)?;
        let share = stream.random_range(0.05..0.4);
        let start = independent_cells(&mut stream, ground.size, share, &ground.cells);
        let mut walk = Walk::new(&ground, start.expect("the size is that of a map"), &mut stream);
        for looked_at in 0..self.maps {
            if stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            if walk.distance == 0.0 && ground.is_verified(&walk.grid) {
                return Ok(Some(Witness { number, interpretation, grid: walk.grid, looked_at }));
            }
            walk.step(f64::from(looked_at) / f64::from(self.maps));
        }
        Ok(None)
    }

    /// The outcome on this map of every claim that looks at it, those of the call first.
    ///
    /// # Errors
    /// As [`search_all`](Self::search_all).
    pub fn holding(&self, witness: &Witness) -> Result<Vec<OnMap>, StudyError> {
        let ground = Ground::new(self, &witness.interpretation, true)?;
        let numbers = ground.numbers(&witness.grid);
        let others: Vec<String> = self.others();
        let wanted = ground.wanted.iter().cloned();
        let rest = wanted_of(self.paper, &witness.interpretation, self.study, &others).unwrap_or_default();
        let on_map = |wanted: Wanted| {
            let value = wanted.value(&numbers);
            let holds = value.is_some_and(|value| wanted.print.agrees(value));
            OnMap { printed: wanted.print.printed.to_string(), name: wanted.name, value, holds }
        };
        Ok(wanted.chain(rest).map(on_map).collect())
    }

    /// The other claims whose numbers are looked for on this map.
    fn others(&self) -> Vec<String> {
        let ids = self
            .paper
            .claims
            .iter()
            .filter(|claim| claim.printed.is_some() && claim.check(EXISTS.name).is_some());
        let ids = ids.map(|claim| claim.id.clone()).filter(|id| !self.claims.contains(id));
        ids.filter(|id| {
            Self::place(self.paper, std::slice::from_ref(id))
                .is_ok_and(|(study, group)| study.name == self.study.name && group.label == self.group.label)
        })
        .collect()
    }
}

/// The criterion `exists` of each claim.
fn numbers_of_claims<'a>(
    paper: &'a Paper,
    point: &'a Interpretation,
    claims: &[String],
) -> Result<Vec<Attained<'a>>, String> {
    let known = || paper.claims.iter().map(|claim| claim.id.as_str());
    let of = |id: &String| {
        let claim = paper.claim(id).ok_or_else(|| base::settings::none_called("claim", id, known()))?;
        let settings = claim.check(EXISTS.name).filter(|_| claim.printed.is_some());
        let settings =
            settings.ok_or_else(|| format!("claim `{id}` asks for no number that a trial may meet"))?;
        Attained::new(&Context { claim, settings, paper, point }).map_err(|error| error.to_string())
    };
    claims.iter().map(of).collect()
}

/// What `claims` want of contenders of `study` under the interpretation.
fn wanted_of(
    paper: &Paper,
    point: &Interpretation,
    study: &Study,
    claims: &[String],
) -> Result<Vec<Wanted>, String> {
    let of = |one: &Attained<'_>| {
        let contender = one.contender_of(study);
        let contender = contender
            .ok_or_else(|| format!("study `{}` lacks contenders of `{}`", study.name, one.claim()))?;
        Ok(Wanted {
            name: one.claim().to_owned(),
            contender: contender.to_owned(),
            against: one.against().map(str::to_owned),
            metric: one.metric(),
            print: one.print(),
        })
    };
    numbers_of_claims(paper, point, claims)?.iter().map(of).collect()
}

impl Wanted {
    fn value(&self, numbers: &BTreeMap<&str, Option<Counts>>) -> Option<f64> {
        if self.metric.at_most.is_some() {
            // The verifier knows the other column, the planner does not.
            return None;
        }
        let of = |label: &str| {
            let value = numbers.get(label)?.as_ref()?.get(self.metric.column)?;
            Some(Value::as_f64(*value) * self.metric.scale)
        };
        let other = of(&self.contender)?;
        match &self.against {
            None => Some(other),
            Some(base) => of(base).filter(|base| *base > 0.0).map(|base| 100.0 * (base - other) / base),
        }
    }

    /// How far a map is from it: 0 where it holds, otherwise at least [`UNMET`].
    fn distance(&self, numbers: &BTreeMap<&str, Option<Counts>>) -> f64 {
        let Some(value) = self.value(numbers) else { return 3.0 };
        if self.print.agrees(value) {
            return 0.0;
        }
        let printed = self.print.printed.value();
        UNMET + (value - printed).abs() / printed.abs().max(1.0)
    }
}

/// What one number that is missed costs, however near it is.
const UNMET: f64 = 0.05;

/// An option of every choice that votes there, with equal chance.
fn drawn(choices: &[Choice], stream: &mut Stream) -> Interpretation {
    let pick = |choice: &Choice, stream: &mut Stream| {
        let voting: Vec<&String> = choice.options.keys().filter(|option| choice.votes(option)).collect();
        let at = stream.random_range(0..voting.len().max(1));
        (choice.id.clone(), voting.get(at).copied().unwrap_or(&choice.default).clone())
    };
    let options = choices.iter().map(|choice| pick(choice, stream)).collect();
    Interpretation::new(choices, &options).expect("the options are the choices' own")
}

/// What of the interpretation changes the study's settings: choices of its own, and any along which the interpretation departs. The default of
/// an axis that only other studies have says nothing of this one, whose own settings stand.
fn laid_over(hunt: &WitnessSearch<'_>, interpretation: &Interpretation) -> Interpretation {
    let mut choices = hunt.paper.choices.clone();
    let is_own = |choice: &Choice| hunt.study.choices.iter().any(|own| own.id == choice.id);
    choices
        .retain(|choice| is_own(choice) || interpretation.options().get(&choice.id) != Some(&choice.default));
    interpretation.within(&choices)
}

/// What maps are tried on: contenders under one interpretation, ends and a corner rule.
struct Ground {
    wanted: Vec<Wanted>,
    pipelines: Vec<(String, Pipeline)>,
    corner_rule: CornerRule,
    size: [u32; 2],
    ends: [Vec<f64>; 2],
    /// Start and goal.
    cells: [u32; 2],
    expansions: u64,
}

impl Ground {
    /// With the contenders that are wanted, or all of the study's.
    fn new(hunt: &WitnessSearch<'_>, interpretation: &Interpretation, all: bool) -> Result<Self, StudyError> {
        let refused = |message: String| StudyError::Settings(hunt.study.document.error_at("", message));
        let mut wanted = wanted_of(hunt.paper, interpretation, hunt.study, &hunt.claims).map_err(refused)?;
        wanted.extend(hunt.besides.iter().cloned());
        let labels: Vec<&String> =
            wanted.iter().flat_map(|one| std::iter::once(&one.contender).chain(&one.against)).collect();
        let mut pipelines = Vec::new();
        let laid = laid_over(hunt, interpretation);
        for contender in hunt.study.contenders.iter().filter(|own| all || labels.contains(&&own.label)) {
            pipelines.push((contender.label.clone(), contender.pipeline(&laid, &SweepPoint::default())?));
        }
        let family = hunt.group.family(&hunt.group.points[0], &laid, hunt.inputs)?;
        let world = family.draw(0).map_err(|invalid| refused(invalid.0))?;
        let lattice = world.as_lattice().expect("a map of cells is a lattice");
        let grid = lattice.grid();
        let query = &family.queries()[0];
        let ends = [query.start.clone(), query.goal.clone()];
        let cell = |end: &Vec<f64>| grid.cell(end[0] as i32, end[1] as i32).expect("ends lie on their map");
        Ok(Self {
            cells: [cell(&ends[0]), cell(&ends[1])],
            corner_rule: lattice.corner_rule(),
            size: [grid.width(), grid.height()],
            expansions: hunt.study.budget.expansions,
            wanted,
            pipelines,
            ends,
        })
    }

    fn world(&self, grid: &Grid2) -> World {
        World::Lattice(LatticeWorld::new(grid.clone(), self.corner_rule))
    }

    fn request<'r>(&'r self, world: &'r World) -> Request<'r> {
        let [start, goal] = &self.ends;
        Request { world, start, goal, expansions: self.expansions, seed: 0, trace: false }
    }

    /// What every contender's trial would measure on a map; nothing where it finds no path.
    fn numbers(&self, grid: &Grid2) -> BTreeMap<&str, Option<Counts>> {
        let world = self.world(grid);
        let request = self.request(&world);
        let counts = |pipeline: &Pipeline| {
            let mut plan = pipeline.plan(&request).ok().filter(|plan| plan.ending == Ending::Solved)?;
            plan.counts.extend(verification::measured(&plan.path));
            Some(plan.counts)
        };
        self.pipelines.iter().map(|(label, pipeline)| (label.as_str(), counts(pipeline))).collect()
    }

    /// Whether the verifier accepts what every contender returns on a map.
    fn is_verified(&self, grid: &Grid2) -> bool {
        let world = self.world(grid);
        let [start, goal] = self.ends.clone();
        let query = study::family::Query { name: String::new(), start, goal };
        let truth = verification::truth(&world, &query, &Guide::default());
        let request = self.request(&world);
        self.pipelines.iter().all(|(_, pipeline)| {
            let verified = |plan| verification::verify(&request, &plan, pipeline, &truth);
            pipeline.plan(&request).is_ok_and(|plan| verified(plan).outcome.0 == Status::Solved)
        })
    }

    fn distance(&self, grid: &Grid2) -> f64 {
        let numbers = self.numbers(grid);
        self.wanted.iter().map(|one| one.distance(&numbers)).sum()
    }

    /// The columns and rows that searches between the ends are likely to look at.
    fn near(&self) -> [Range<u32>; 2] {
        [0, 1].map(|axis: usize| {
            let [a, b] = [0, 1].map(|end: usize| self.ends[end][axis] as u32);
            a.min(b).saturating_sub(MARGIN_CELLS)..(a.max(b) + MARGIN_CELLS + 1).min(self.size[axis])
        })
    }
}

/// How far from the ends cells are changed.
const MARGIN_CELLS: u32 = 6;
