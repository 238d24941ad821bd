//! Problems that others posed: only the name of each is known, and trials on it are imported.

use super::{Entry, Family, Query};
use crate::StudyError;
use crate::preprocessing::{Preprocessing, lattice};
use base::grid::{CornerRule, Grid2, Vertices};
use base::settings::Accepted;
use engine::planner::Invalid;
use engine::space::WorldKind;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "recorded",
    about: "problems that others posed, whose trials were recorded elsewhere and imported, docs/AUTHORS_DATA.md",
    revision: 1,
    instances: "problems",
    is_drawn: true,
    preprocessing: lattice::ENTRY.name,
    columns: &[],
    settings: Accepted::shape::<Recorded>(),
    example: r#"
unit = "map"
"#,
    build: |settings, _| {
        let Recorded { unit } = settings.read()?;
        let query = Query { name: String::new(), start: vec![0.0, 0.0], goal: vec![1.0, 0.0] };
        Ok::<Box<dyn Family>, StudyError>(Box::new(Posed { unit, queries: [query] }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Recorded {
    /// What was drawn independently, in a word: a map, a roadmap, a seed.
    unit: String,
}

struct Posed {
    unit: String,
    queries: [Query; 1],
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        WorldKind::Lattice
    }

    /// Two free cells stand for a world that is not known.
    fn prepare(&self, _seed: u64) -> Result<Preprocessing, Invalid> {
        let cells = Grid2::new(2, 1).expect("two cells are within the limits");
        let world = lattice::world(cells, CornerRule::Allow, Vertices::Centres);
        lattice::prepare(world, self.queries.iter().map(Query::ends))
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn cells(&self) -> u64 {
        2
    }

    fn notes(&self) -> Vec<String> {
        vec![format!("an instance is a {} that others drew; trials were recorded elsewhere", self.unit)]
    }
}
