//! Random maps whose cells are blocked independently, with one start and one goal that are always free.

use super::{Entry, Family, Query};
use crate::StudyError;
use crate::prepared::{Prepared, lattice};
use crate::verification::LATTICE_COLUMNS;
use base::grid::{Grid2, GridError, independent_cells};
use base::seed::{self, Stream};
use base::settings::{Accepted, Faults, Settings, SettingsError};
use engine::planner::Invalid;
use engine::space::{LatticeWorld, World, WorldKind};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "random_cells",
    about: "random maps whose cells are blocked independently; start and goal are freed",
    revision: 1,
    is_drawn: true,
    prepared: lattice::ENTRY.name,
    columns: LATTICE_COLUMNS,
    settings: Accepted::of::<RandomCells>(),
    example: r#"
size_cells = [30, 30]
start = [22, 15]
goal = [26, 28]
blocked_share = 0.2
corner_rule = "allow"
"#,
    build: |settings, _inputs| {
        let read: RandomCells = settings.read()?;
        let (share, mut faults) = (read.blocked_share, Faults::default());
        if !(0.0..1.0).contains(&share) {
            let message = format!("blocked_share is {share}; 0 to below 1 is accepted");
            faults.add(settings.error_at("blocked_share", message));
        }
        let draw =
            move |stream: &mut Stream, size, free: &[u32]| independent_cells(stream, size, share, free);
        let frame = (read.size_cells, read.start, read.goal, read.corner_rule);
        let drawn = faults.keep(Drawn::new(settings, frame, 0, draw));
        Ok::<Box<dyn Family>, StudyError>(Box::new(faults.or(drawn)?))
    },
};

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RandomCells {
    /// Columns and rows of the map.
    #[schemars(inner(range(max = 65_535)))]
    size_cells: [u32; 2],
    /// The column and row of the start cell, counted from 0 at the lower left.
    start: [u32; 2],
    /// The column and row of the goal cell, counted from 0 at the lower left.
    goal: [u32; 2],
    /// When a diagonal move past blocked cells is allowed.
    corner_rule: lattice::CornerSetting,
    /// The chance that a cell is blocked.
    blocked_share: f64,
}

/// What random maps share: size, start, goal and corner rule.
pub(super) type Frame = ([u32; 2], [u32; 2], [u32; 2], lattice::CornerSetting);

/// A family of random maps of one size with one start and one goal.
pub(super) struct Drawn<D> {
    frame: Frame,
    keep_free: [u32; 2],
    queries: [Query; 1],
    /// How many cells a draw's obstacles have at most, each counted by itself.
    blocked: u64,
    draw: D,
}

impl<D> Drawn<D>
where
    D: Fn(&mut Stream, [u32; 2], &[u32]) -> Result<Grid2, GridError> + Send + Sync,
{
    /// The family whose maps `draw` makes of a stream, the size and the cells that are kept free; its obstacles have up to
    /// `blocked` cells, each counted by itself.
    ///
    /// # Errors
    /// A size that no grid has, or start and goal as far as they are outside.
    pub(super) fn new(
        settings: &Settings,
        frame: Frame,
        blocked: u64,
        draw: D,
    ) -> Result<Self, SettingsError> {
        let ([width, height], start, goal, _) = frame;
        let empty = Grid2::new(width, height)
            .map_err(|e| settings.error_at("size_cells", format!("size_cells: {e}")))?;
        let cell = |what: &str, [x, y]: [u32; 2]| {
            empty.cell(x as i32, y as i32).ok_or_else(|| {
                let message =
                    format!("{what} is [{x}, {y}], outside the map; cells are 0..{width} by 0..{height}");
                settings.error_at(what, message)
            })
        };
        let mut faults = Faults::default();
        let ends = [("start", start), ("goal", goal)].map(|(what, at)| faults.keep(cell(what, at)));
        faults.done()?;
        let keep_free = ends.map(Option::unwrap_or_default);
        let [from, to] = [start, goal].map(|cell| cell.map(f64::from).to_vec());
        let queries = [Query { name: String::new(), start: from, goal: to }];
        Ok(Self { frame, keep_free, queries, blocked, draw })
    }

    fn map(&self, seed: u64) -> Grid2 {
        (self.draw)(&mut seed::stream(seed), self.frame.0, &self.keep_free)
            .expect("the size was checked when the settings were read")
    }
}

/// Refuses a range of whole numbers of cells that is empty or starts at 0.
pub(super) fn check_range(
    settings: &Settings,
    key: &str,
    [least, most]: [u32; 2],
) -> Result<(), SettingsError> {
    if 0 < least && least <= most {
        return Ok(());
    }
    let message = format!("{key} is [{least}, {most}]; [least, most] with 1 ≤ least ≤ most is accepted");
    Err(settings.error_at(key, message))
}

impl<D> Family for Drawn<D>
where
    D: Fn(&mut Stream, [u32; 2], &[u32]) -> Result<Grid2, GridError> + Send + Sync,
{
    fn world(&self) -> WorldKind {
        WorldKind::Lattice
    }

    fn prepare(&self, seed: u64) -> Result<Prepared, Invalid> {
        let (_, start, goal, corners) = self.frame;
        lattice::prepare(self.map(seed), corners, start, goal)
    }

    fn draw(&self, seed: u64) -> Result<World, Invalid> {
        // Start and goal are freed, so that no draw is invalid.
        Ok(World::Lattice(LatticeWorld::new(self.map(seed), self.frame.3.into())))
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn cells(&self) -> u64 {
        self.frame.0.map(u64::from).iter().product::<u64>() + self.blocked
    }
}
