//! A planner whose trials were recorded elsewhere: `replan import` writes them, and nothing here can run them.

use base::settings::Accepted;
use engine::planner::{Build, Counts, Ending, Entry, Invalid, Plan, Planner, Request};
use engine::space::WorldKind;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "recorded",
    about: "trials that were recorded elsewhere and imported, docs/AUTHORS_DATA.md",
    revision: 1,
    needs: WorldKind::Any,
    columns: &[
        "path_cost_cells",
        "turn_exterior_deg",
        "turn_interior_deg",
        "bends",
        "path_length_cm",
        "path_length_mm",
        "joint_travel_deg",
        "opened",
        "closed",
        "expansions",
        "generated",
        "iterations",
        "samples",
        "own_wall_ns",
    ],
    settings: Accepted::shape::<Recorded>(),
    example: "",
    build: Build::Planner(|settings| {
        let read: Recorded = settings.read()?;
        Ok(Box::new(read))
    }),
};

/// What installs what is missing.
const IMPORT: &str = "its trials are recorded elsewhere; `replan import` writes them";

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Recorded {}

impl Planner for Recorded {
    fn plan(&self, _request: &Request<'_>) -> Result<Plan, Invalid> {
        Ok(Plan {
            ending: Ending::Crashed,
            path: Vec::new(),
            cost: None,
            counts: Counts::new(),
            traces: Vec::new(),
            reason: Some(IMPORT.to_owned()),
        })
    }

    fn draws(&self) -> bool {
        true
    }

    fn lacks(&self) -> Option<String> {
        Some(IMPORT.to_owned())
    }
}
