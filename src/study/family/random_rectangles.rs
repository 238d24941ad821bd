//! Random maps of filled rectangles.

use super::Entry;
use super::random_maps::{Framed as _, Obstacles, check_range, entry, settings};
use base::grid::{Grid2, GridError, rectangles};
use base::seed::Stream;
use base::settings::{Settings, SettingsError};

/// The registry's entry.
pub static ENTRY: Entry = entry::<RandomRectangles>(
    "random_rectangles",
    "random maps of filled rectangles that may overlap; a written start and goal are freed",
    r#"
size_cells = [40, 40]
start = [2, 3]
goal = { x = [30, 39], y = [30, 39] }
count = 8
side_cells = [2, 5]
corner_rule = "allow"
"#,
);

settings!(RandomRectangles {
    /// How many are drawn.
    #[schemars(range(max = 1_000_000))]
    count: u32,
    /// Least and most side.
    #[schemars(inner(range(min = 1, max = 65_535)))]
    side_cells: [u32; 2],
});

impl Obstacles for RandomRectangles {
    fn map(&self, stream: &mut Stream, keep_free: &[u32]) -> Result<Grid2, GridError> {
        rectangles(stream, self.frame().size_cells, self.count, self.side_cells, keep_free)
    }

    fn blocked(&self) -> u64 {
        let [width, height] = self.frame().size_cells;
        u64::from(self.count) * u64::from(self.side_cells[1].min(width.max(height))).pow(2)
    }

    fn check(&self, settings: &Settings) -> Result<(), SettingsError> {
        check_range(settings, "side_cells", self.side_cells)
    }
}
