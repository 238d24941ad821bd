//! Random maps whose cells are blocked independently, with one start and one goal that are always free.

use super::{Entry, Family, Query};
use crate::grid::{Grid2, independent_cells};
use crate::planner::Invalid;
use crate::seed;
use crate::settings::{Settings, SettingsError};
use crate::space::WorldKind;
use crate::study::StudyError;
use crate::study::judge::LATTICE_COLUMNS;
use crate::study::prepared::{Prepared, lattice};
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "random_cells",
    about: "random maps whose cells are blocked independently; start and goal are freed",
    revision: 1,
    prepared: lattice::ENTRY.name,
    columns: LATTICE_COLUMNS,
    build: |settings, _inputs| {
        let read: RandomCells = settings.read()?;
        let keep_free = read.check(settings)?;
        let [start, goal] = [read.start, read.goal].map(|cell| cell.map(f64::from).to_vec());
        let queries = [Query { name: String::new(), start, goal }];
        Ok::<Box<dyn Family>, StudyError>(Box::new(Drawn { read, keep_free, queries }))
    },
};

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct RandomCells {
    size_cells: [u32; 2],
    start: [u32; 2],
    goal: [u32; 2],
    corner_rule: lattice::CornerSetting,
    blocked_share: f64,
}

impl RandomCells {
    fn check(&self, settings: &Settings) -> Result<[u32; 2], SettingsError> {
        if !(0.0..1.0).contains(&self.blocked_share) {
            let message = format!("blocked_share is {}; 0 to below 1 is accepted", self.blocked_share);
            return Err(settings.error(message));
        }
        let empty = Grid2::new(self.size_cells[0], self.size_cells[1])
            .map_err(|e| settings.error(format!("size_cells: {e}")))?;
        let cell = |what: &str, [x, y]: [u32; 2]| {
            empty.cell(x as i32, y as i32).ok_or_else(|| {
                let [width, height] = self.size_cells;
                let message =
                    format!("{what} is [{x}, {y}], outside the map; cells are 0..{width} by 0..{height}");
                settings.error(message)
            })
        };
        Ok([cell("start", self.start)?, cell("goal", self.goal)?])
    }
}

struct Drawn {
    read: RandomCells,
    keep_free: [u32; 2],
    queries: [Query; 1],
}

impl Family for Drawn {
    fn world(&self) -> WorldKind {
        WorldKind::Lattice
    }

    fn prepare(&self, seed: u64) -> Result<Prepared, Invalid> {
        let mut stream = seed::stream(seed);
        let grid =
            independent_cells(&mut stream, self.read.size_cells, self.read.blocked_share, &self.keep_free)
                .expect("the size was checked when the settings were read");
        lattice::prepare(grid, self.read.corner_rule, self.read.start, self.read.goal)
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }
}
