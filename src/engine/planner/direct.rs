//! One local path from start to goal and nothing else: the baseline that a roadmap has to beat.

use super::entry::planner;
use super::roadmap::{Posed, solved, unsolved};
use super::{Build, Counts, Ending, Entry, Invalid, Plan, Planner, Request};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "direct",
    about: "one local path from start to goal, however long, and no search",
    revision: 1,
    needs: WorldKind::Roadmap,
    columns: &[],
    settings: Accepted::shape::<Direct>(),
    example: "",
    build: Build::Planner(planner::<Direct>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Direct {}

impl Planner for Direct {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let Posed { map, start, goal } = Posed::new(request)?;
        Ok(match map.join(start, goal) {
            Ok(()) => solved(map, &[start, goal], Counts::new()),
            Err(_) => unsolved(Ending::NoPath, Counts::new()),
        })
    }

    fn is_optimal(&self) -> bool {
        true
    }
}
