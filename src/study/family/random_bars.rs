//! Random maps of bars one cell thick.

use super::Entry;
use super::random_maps::{Framed as _, Obstacles, check_range, entry, settings};
use base::grid::{Grid2, GridError, bars};
use base::seed::Stream;
use base::settings::{Settings, SettingsError};

/// The registry's entry.
pub static ENTRY: Entry = entry::<RandomBars>(
    "random_bars",
    "random maps of lying and standing bars one cell thick; a written start and goal are freed",
    r#"
size_cells = [40, 40]
start = [2, 3]
goal = [36, 37]
count = 38
length_cells = [3, 8]
corner_rule = "allow"
"#,
);

settings!(RandomBars {
    /// How many are drawn.
    #[schemars(range(max = 1_000_000))]
    count: u32,
    /// Least and most length.
    #[schemars(inner(range(min = 1)))]
    length_cells: [u32; 2],
});

impl Obstacles for RandomBars {
    fn map(&self, stream: &mut Stream, keep_free: &[u32]) -> Result<Grid2, GridError> {
        bars(stream, self.frame().size_cells, self.count, self.length_cells, keep_free)
    }

    fn blocked(&self) -> u64 {
        u64::from(self.count) * u64::from(self.length_cells[1])
    }

    fn check(&self, settings: &Settings) -> Result<(), SettingsError> {
        check_range(settings, "length_cells", self.length_cells)
    }
}
