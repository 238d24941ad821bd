//! Instances of other families on which one planner's record lies in given bands, found by rejection.
//!
//! One instance tries maps in a written order until one is accepted: try `i` takes its family and its seed from the
//! instance's seed and `i`. Accepted instances are therefore independent and distributed as the mixture of the families,
//! given the bands. How many tries each took is recorded, so that acceptance rates are known, and may be listed in a
//! file ([`found`]): a listed draw is looked at again, but not the tries before it.

mod found;

use super::{Entry, Family, Query};
use crate::preprocessing::{Preprocessing, lattice};
use crate::verification::{LATTICE_COLUMNS, MEASURES};
use crate::{Inputs, StudyError, column};
use base::hash::sha256;
use base::seed;
use base::settings::{Accepted, AnyTable, Faults, Settings, SettingsError};
use engine::planner::{self, Build, Ending, Invalid, Planner, Request, Value};
use engine::space::{World, WorldKind};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use toml::{Table, Value as Toml};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "conditioned",
    about: "draws of other families, each with equal chance, on which one planner's record lies in given bands",
    instances: "maps",
    revision: 1,
    is_drawn: true,
    preprocessing: lattice::ENTRY.name,
    columns: LATTICE_COLUMNS,
    settings: Accepted::shape::<Conditioned>(),
    example: r#"
corner_rule = "allow"
planner = "astar"
planner_settings = { weight = 1, ties = "fifo" }
expansions = 56
tries = 100000
found = "data/draws/zhang_conditioned.txt"
given = { path_cost_cells = [14.65, 14.66] }
shared = { size_cells = [30, 30], start = [22, 15], goal = [26, 28] }
[[families]]
family = "random_cells"
settings = { blocked_share = 0.2 }
[[families]]
family = "random_rectangles"
settings = { count = 17, side_cells = [2, 5] }
"#,
    build: |settings, inputs| {
        let read: Conditioned = settings.read()?;
        read.check(settings)?;
        let families = read.families(settings, inputs)?;
        let planner = read.planner(settings)?;
        if families.iter().any(|family| family.draws_ends()) {
            let message = "`families` has families that draw a start or goal; written ones are accepted";
            return Err(settings.error_at("families", message).into());
        }
        let queries = families[0].queries().to_vec();
        if queries.len() != 1 || families.iter().any(|family| family.queries() != queries) {
            return Err(settings
                .error_at("families", "`families` has families with different queries, or more than one")
                .into());
        }
        let mut files: Vec<PathBuf> = families.iter().flat_map(|family| family.inputs().to_vec()).collect();
        let found = match &read.found {
            None => BTreeMap::new(),
            Some(name) => {
                let file = inputs.locate(name).map_err(|message| settings.error_at("found", message))?;
                let found = found::read(&file, &read.fingerprint())
                    .map_err(|message| settings.error_at("found", message))?;
                files.push(file);
                found
            }
        };
        Ok::<Box<dyn Family>, StudyError>(Box::new(Rejection {
            read,
            families,
            planner,
            queries,
            files,
            found,
        }))
    },
};

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Conditioned {
    /// The families that are drawn from.
    #[schemars(length(min = 1))]
    families: Vec<ConditionedFamily>,
    /// Settings that all of them share.
    #[schemars(with = "AnyTable")]
    shared: Table,
    /// The corner rule of all of them.
    corner_rule: String,
    /// The planner whose record decides.
    planner: String,
    /// The planner's settings.
    #[schemars(with = "AnyTable")]
    planner_settings: Table,
    /// Columns of the record with the least and the greatest value that are accepted.
    given: BTreeMap<String, [f64; 2]>,
    /// At most this many expansions a try.
    expansions: u64,
    /// At most this many tries an instance; an instance that is not accepted is an invalid problem.
    #[schemars(range(min = 1, max = 1_000_000_000))]
    tries: u64,
    /// A file with the number of tries that each draw took, so that they need not be tried again.
    found: Option<String>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ConditionedFamily {
    /// The family's name in the registry.
    family: String,
    /// Its settings besides the shared ones.
    #[schemars(with = "AnyTable")]
    settings: Table,
}

/// Revisions of planners that accept the tries which an earlier one accepts, each with that one: what was listed under it holds.
const ALIKE: [(&str, u32, u32); 1] = [("astar", 3, 2)];

/// The revision of a planner under which lists are sealed.
fn sealed_as(planner: &str, revision: u32) -> u32 {
    let alike = ALIKE.into_iter().find(|(name, later, _)| *name == planner && *later == revision);
    alike.map_or(revision, |(_, _, earlier)| earlier)
}

impl Conditioned {
    /// A hash of all that decides which try is accepted; a list of tries holds only for an equal hash.
    fn fingerprint(&self) -> String {
        let Self {
            families,
            shared,
            corner_rule,
            planner,
            planner_settings,
            given,
            expansions,
            tries: _,
            found: _,
        } = self;
        let revisions: Vec<Option<u32>> =
            families.iter().map(|one| super::find(&one.family).map(|entry| entry.revision)).collect();
        let revision = planner::find(planner).map(|entry| sealed_as(entry.name, entry.revision));
        // As lists were sealed from the first on.
        let family = |one: &ConditionedFamily| {
            format!("Of {{ family: {:?}, settings: {:?} }}", one.family, one.settings)
        };
        let families = families.iter().map(family).collect::<Vec<_>>().join(", ");
        let text = format!(
            "{} [{families}] {shared} {corner_rule} {planner} {planner_settings} {given:?} {expansions} {revisions:?} {revision:?}",
            ENTRY.revision
        );
        sha256(text.as_bytes())[..16].to_owned()
    }

    fn check(&self, settings: &Settings) -> Result<(), SettingsError> {
        let mut faults = Faults::default();
        for (name, [low, high]) in &self.given {
            if column::find(name).is_none() {
                let known: Vec<&str> = column::COLUMNS.iter().map(|column| column.name).collect();
                let message = format!("`given` names the column `{name}`; there are {}", known.join(", "));
                faults.add(settings.error_at(&format!("given.{name}"), message));
            }
            if low.is_nan() || high.is_nan() || low > high {
                let message = format!("`given.{name}` is [{low}, {high}]; [least, greatest] is accepted");
                faults.add(settings.error_at(&format!("given.{name}"), message));
            }
        }
        faults.done()
    }

    fn families(&self, settings: &Settings, inputs: &Inputs) -> Result<Vec<Box<dyn Family>>, StudyError> {
        let build = |(index, one): (usize, &ConditionedFamily)| {
            let entry = super::find(&one.family).ok_or_else(|| {
                let known: Vec<&str> = super::REGISTRY.iter().map(|entry| entry.name).collect();
                let message =
                    format!("there is no problem family `{}`; there are {}", one.family, known.join(", "));
                settings.error_at(&format!("families.{index}.family"), message)
            })?;
            let mut table = self.shared.clone();
            table.extend(one.settings.clone());
            table.insert("corner_rule".to_owned(), Toml::String(self.corner_rule.clone()));
            let whose = format!("`families` {}", one.family);
            let own = format!("families.{index}.settings");
            let family =
                (entry.build)(&Settings::of_parts(settings, &[&own, "shared", ""], whose, table), inputs)?;
            if family.world() == WorldKind::Lattice {
                Ok(family)
            } else {
                Err({
                    let message = format!("family `{}` poses no problems on a lattice", one.family);
                    settings.error_at(&format!("families.{index}.family"), message).into()
                })
            }
        };
        self.families.iter().enumerate().map(build).collect()
    }

    fn planner(&self, settings: &Settings) -> Result<Box<dyn Planner>, SettingsError> {
        let whose = format!("planner `{}`", self.planner);
        let table = Settings::of_parts(settings, &["planner_settings"], whose, self.planner_settings.clone());
        let entry = planner::find(&self.planner).filter(|entry| entry.needs == WorldKind::Lattice);
        match entry.map(|entry| entry.build) {
            Some(Build::Planner(build)) => build(&table),
            _ => {
                Err(settings
                    .error_at("planner", format!("there is no planner `{}` for a lattice", self.planner)))
            }
        }
    }
}

struct Rejection {
    read: Conditioned,
    families: Vec<Box<dyn Family>>,
    planner: Box<dyn Planner>,
    queries: Vec<Query>,
    files: Vec<PathBuf>,
    /// Tries by seed, where they are known.
    found: BTreeMap<u64, u64>,
}

impl Rejection {
    fn accepts(&self, world: &World) -> bool {
        let [query] = &self.queries[..] else { unreachable!("one query was wanted") };
        let request = Request {
            world,
            start: &query.start,
            goal: &query.goal,
            expansions: self.read.expansions,
            seed: 0,
            trace: false,
        };
        let Ok(plan) = self.planner.plan(&request) else { return false };
        if plan.ending != Ending::Solved {
            return false;
        }
        // Most tries miss the first band, and turns are dear: each value is taken when its band is looked at.
        let value = |name: &str| {
            let measured = || {
                let (_, value) = MEASURES.into_iter().find(|(own, _)| *own == name)?;
                Some(value(&plan.path))
            };
            plan.counts.get(name).copied().or_else(measured)
        };
        let is_inside = |(name, [low, high]): (&String, &[f64; 2])| {
            value(name).is_some_and(|value| (*low..=*high).contains(&value.as_f64()))
        };
        self.read.given.iter().all(is_inside)
    }
}

impl Family for Rejection {
    fn world(&self) -> WorldKind {
        WorldKind::Lattice
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        let mut stream = seed::stream(seed);
        let known = self.found.get(&seed).copied().unwrap_or(0);
        for tries in 1..=self.read.tries {
            let family = stream.random_range(0..self.families.len());
            // Half of the range of u64, as all seeds are.
            let seed = stream.random_range(0..=u64::MAX >> 1);
            if tries < known {
                continue;
            }
            if self.families[family].draw(seed).is_ok_and(|world| self.accepts(&world)) {
                let mut preprocessing = self.families[family].prepare(seed)?;
                preprocessing.values.insert("tries", Value::Count(tries));
                return Ok(preprocessing);
            }
        }
        Err(Invalid(format!("none of {} maps was accepted", self.read.tries)))
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn check_ends(&self) -> Result<(), SettingsError> {
        let mut faults = Faults::default();
        for family in &self.families {
            faults.keep(family.check_ends());
        }
        faults.done()
    }

    fn cells(&self) -> u64 {
        self.families.iter().map(|family| family.cells()).max().unwrap_or(1)
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.files
    }
}

#[cfg(test)]
mod tests;
