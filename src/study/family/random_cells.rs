//! Random maps whose cells are blocked independently.

use super::Entry;
use super::random_maps::{Framed as _, Obstacles, entry, settings};
use base::grid::{Grid2, GridError, independent_cells};
use base::seed::Stream;
use base::settings::{Settings, SettingsError};

/// The registry's entry.
pub static ENTRY: Entry = entry::<RandomCells>(
    "random_cells",
    "random maps whose cells are blocked independently; a written start and goal are freed",
    r#"
size_cells = [40, 40]
start = "drawn"
goal = { x = 39 }
queries = 2
blocked_share = 0.2
corner_rule = "allow"
"#,
);

settings!(RandomCells {
    /// The chance that a cell is blocked.
    blocked_share: f64,
});

impl Obstacles for RandomCells {
    fn map(&self, stream: &mut Stream, keep_free: &[u32]) -> Result<Grid2, GridError> {
        independent_cells(stream, self.frame().size_cells, self.blocked_share, keep_free)
    }

    fn blocked(&self) -> u64 {
        0
    }

    fn check(&self, settings: &Settings) -> Result<(), SettingsError> {
        if (0.0..1.0).contains(&self.blocked_share) {
            return Ok(());
        }
        let message = format!("blocked_share is {}; 0 to below 1 is accepted", self.blocked_share);
        Err(settings.error_at("blocked_share", message))
    }
}
