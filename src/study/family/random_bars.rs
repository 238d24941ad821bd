//! Random maps of bars one cell thick, with one start and one goal that are always free.

use super::random_cells::{Drawn, check_range};
use super::{Entry, Family};
use crate::StudyError;
use crate::prepared::lattice;
use crate::verification::LATTICE_COLUMNS;
use base::grid::bars;
use base::seed::Stream;
use base::settings::{Accepted, Faults};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "random_bars",
    about: "random maps of lying and standing bars one cell thick; start and goal are freed",
    revision: 1,
    is_drawn: true,
    prepared: lattice::ENTRY.name,
    columns: LATTICE_COLUMNS,
    settings: Accepted::of::<RandomBars>(),
    example: r#"
size_cells = [30, 30]
start = [22, 15]
goal = [26, 28]
count = 38
length_cells = [3, 8]
corner_rule = "allow"
"#,
    build: |settings, _inputs| {
        let read: RandomBars = settings.read()?;
        let (count, range) = (read.count, read.length_cells);
        let mut faults = Faults::default();
        faults.keep(check_range(settings, "length_cells", range));
        let draw = move |stream: &mut Stream, size, free: &[u32]| bars(stream, size, count, range, free);
        let blocked = u64::from(count) * u64::from(range[1]);
        let frame = (read.size_cells, read.start, read.goal, read.corner_rule);
        let drawn = faults.keep(Drawn::new(settings, frame, blocked, draw));
        Ok::<Box<dyn Family>, StudyError>(Box::new(faults.or(drawn)?))
    },
};

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RandomBars {
    /// Columns and rows of the map.
    #[schemars(inner(range(max = 65_535)))]
    size_cells: [u32; 2],
    /// The column and row of the start cell, counted from 0 at the lower left.
    start: [u32; 2],
    /// The column and row of the goal cell, counted from 0 at the lower left.
    goal: [u32; 2],
    /// When a diagonal move past blocked cells is allowed.
    corner_rule: lattice::CornerSetting,
    /// How many are drawn.
    #[schemars(range(max = 1_000_000))]
    count: u32,
    /// Least and most length.
    #[schemars(inner(range(min = 1)))]
    length_cells: [u32; 2],
}
