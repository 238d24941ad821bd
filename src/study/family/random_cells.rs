//! Random maps whose cells are blocked one by one.

use super::Entry;
use super::random_maps::{Framed as _, Obstacles, entry, settings};
use base::grid::{Blocking, Grid2, GridError, blocked_cells};
use base::seed::Stream;
use base::settings::{Faults, Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = entry::<RandomCells>(
    "random_cells",
    "random maps whose cells are blocked one by one, by chance, count or draws; a written start and goal are freed",
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
    /// The chance that a cell is blocked, or what `blocking` makes of it.
    blocked_share: f64,
    /// How cells are blocked; `independent` if absent.
    blocking: Option<BlockingSetting>,
    /// How many columns and rows along each side are a border without blocked cells; 0 if absent.
    #[schemars(range(max = 32_767))]
    border_cells: Option<u32>,
    /// How the border counts toward the share; `spared` if absent.
    border: Option<BorderSetting>,
    /// The rows that a start or goal that is drawn may lie in; `all` if absent.
    end_rows: Option<EndRows>,
});

/// The rows that a start or goal that is drawn may lie in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum EndRows {
    /// Those of the border too.
    All,
    /// Those inside the border.
    Inside,
}

/// How cells are blocked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum BlockingSetting {
    /// Each with the same chance.
    #[default]
    Independent,
    /// As many as the share comes to, rounded; all sets of so many alike.
    Count,
    /// Those hit by as many draws as the share comes to, rounded, each of any cell: fewer than the share, since some are hit again.
    Draws,
}

/// What the border is to the share of blocked cells.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum BorderSetting {
    /// The share is that of the cells inside it.
    #[default]
    Spared,
    /// The share is that of all cells; the cells inside make up for the free border.
    Counted,
    /// Its cells are blocked like any other and freed afterwards.
    Cleared,
}

impl RandomCells {
    /// How many cells a border has inside, and how many there are.
    fn counts(&self) -> [f64; 2] {
        let sides = self.frame().size_cells;
        let border = self.border_cells.unwrap_or(0);
        let area = |sides: [u32; 2]| sides.map(f64::from).iter().product();
        [area(sides.map(|side| side.saturating_sub(border.saturating_mul(2)))), area(sides)]
    }

    /// How cells are blocked, and which border is left out meanwhile.
    fn blocking(&self) -> (Blocking, u32) {
        let border = self.border.unwrap_or_default();
        let [inner, all] = self.counts();
        let (of, among) = match border {
            BorderSetting::Spared => (inner, inner),
            BorderSetting::Counted => (all, inner),
            BorderSetting::Cleared => (all, all),
        };
        let count = (self.blocked_share * of).round() as u32;
        let blocking = match self.blocking.unwrap_or_default() {
            BlockingSetting::Independent if of > among => {
                Blocking::Independent(self.blocked_share * of / among)
            }
            BlockingSetting::Independent => Blocking::Independent(self.blocked_share),
            BlockingSetting::Count => Blocking::Count(count),
            BlockingSetting::Draws => Blocking::Draws(count),
        };
        let left_out = if border == BorderSetting::Cleared { 0 } else { self.border_cells.unwrap_or(0) };
        (blocking, left_out)
    }

    /// Refuses a border that leaves no cell inside, and a share that the cells inside it cannot make up for.
    fn check_border(&self, settings: &Settings) -> Result<(), SettingsError> {
        let [inner, all] = self.counts();
        let border = self.border_cells.unwrap_or(0);
        if inner == 0.0 && border > 0 {
            let message = format!(
                "border_cells is {border}, and the border takes the whole map; less than half a side is accepted"
            );
            return Err(settings.error_at("border_cells", message));
        }
        let is_short = self.border == Some(BorderSetting::Counted) && self.blocked_share * all > inner;
        if is_short && self.blocking != Some(BlockingSetting::Draws) {
            let most = inner / all;
            let message = format!(
                "blocked_share is {}, and {most:.4} of all cells lie inside the border; up to that is accepted",
                self.blocked_share
            );
            return Err(settings.error_at("blocked_share", message));
        }
        Ok(())
    }
}

impl Obstacles for RandomCells {
    fn map(&self, stream: &mut Stream, keep_free: &[u32]) -> Result<Grid2, GridError> {
        let (blocking, left_out) = self.blocking();
        let mut grid = blocked_cells(stream, self.frame().size_cells, blocking, left_out, keep_free)?;
        let border = self.border_cells.unwrap_or(0) as i32;
        if self.border == Some(BorderSetting::Cleared) {
            let [width, height] = self.frame().size_cells.map(|side| side as i32);
            for cell in 0..grid.cell_count() {
                let [x, y] = grid.xy(cell);
                if x.min(y).min(width - 1 - x).min(height - 1 - y) < border {
                    grid.set_blocked(cell, false);
                }
            }
        }
        Ok(grid)
    }

    fn blocked(&self) -> u64 {
        0
    }

    fn rows_off(&self) -> u32 {
        self.border_cells.filter(|_| self.end_rows == Some(EndRows::Inside)).unwrap_or(0)
    }

    fn check(&self, settings: &Settings) -> Result<(), SettingsError> {
        let mut faults = Faults::default();
        faults.keep(self.check_border(settings));
        if !(0.0..1.0).contains(&self.blocked_share) {
            let message = format!("blocked_share is {}; 0 to below 1 is accepted", self.blocked_share);
            faults.add(settings.error_at("blocked_share", message));
        }
        faults.done()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Inputs;
    use crate::family::Family;

    fn build(more: &str) -> Result<Box<dyn Family>, String> {
        let table = format!("size_cells = [30, 20]\ngoal = {{ x = 29 }}\ncorner_rule = 'allow'\n{more}");
        let mut table: toml::Table = toml::from_str(&table).unwrap();
        table.entry("start").or_insert_with(|| toml::Value::from(vec![0, 0]));
        let settings = Settings::composed("a test", table);
        (ENTRY.build)(&settings, &Inputs::below(Vec::new())).map_err(|e| e.to_string())
    }

    #[test]
    fn the_share_is_one_of_the_cells_that_the_border_leaves_or_of_all() {
        // Of 600 cells 416 lie inside a border of two.
        for (more, blocked) in [
            ("blocked_share = 0.25", 104),
            ("blocked_share = 0.25\nborder = 'counted'", 150),
            ("blocked_share = 0.625\nborder = 'counted'", 375),
        ] {
            let family = build(&format!("blocking = 'count'\nborder_cells = 2\n{more}")).unwrap();
            for seed in 0..5 {
                let world = family.draw(seed).unwrap();
                let free = world.as_lattice().unwrap().cells().free_count();
                assert_eq!(free, 600 - blocked, "seed {seed}: {more}");
            }
        }
        let cleared = |border: &str| {
            let family = build(&format!("blocked_share = 0.5\nblocking = 'count'\n{border}")).unwrap();
            let world = family.draw(7).unwrap();
            let cells = world.as_lattice().unwrap().cells().clone();
            (0..600).filter(|cell| !cells.is_free(*cell)).collect::<Vec<_>>()
        };
        let inside = |cell: &u32| (2..28).contains(&(cell % 30)) && (2..18).contains(&(cell / 30));
        let mut all = cleared("");
        all.retain(inside);
        assert_eq!(cleared("border = 'cleared'\nborder_cells = 2"), all, "seed 7: the border alone is freed");
        assert!((150..290).contains(&all.len()), "seed 7: {}", all.len());
    }

    #[test]
    fn borders_shares_and_corner_rules_that_fit_no_map_are_refused_at_their_keys() {
        for (more, message) in [
            (
                "blocked_share = 0.1\nborder_cells = 10",
                "border_cells is 10, and the border takes the whole map",
            ),
            ("blocked_share = 0.7\nborder_cells = 2\nborder = 'counted'", "0.6933 of all cells lie inside"),
            ("blocked_share = 1.0", "blocked_share is 1; 0 to below 1 is accepted"),
        ] {
            let error = build(more).err().unwrap_or_default();
            assert!(error.contains(message), "{error}\nlacks\n{message}");
        }
        assert!(
            build("blocked_share = 0.7\nborder_cells = 2\nborder = 'counted'\nblocking = 'draws'").is_ok()
        );
        // Draws that hit a cell again block less than their share: no number of them blocks every cell.
        let error = build("blocked_share = 1.2\nblocking = 'draws'").err().unwrap_or_default();
        assert!(error.contains("blocked_share is 1.2; 0 to below 1 is accepted"), "{error}");
        let error = build("blocked_share = 0.1\nborder_cells = 9\nend_rows = 'inside'\nstart = { y = 2 }");
        let error = error.err().unwrap_or_default();
        assert!(error.contains("start has no row left inside the border"), "{error}");
        let at_corners =
            "size_cells = 3\nstart = [0, 0]\ngoal = [3, 4]\nblocked_share = 0.1\nvertices = 'corners'\n";
        let table = toml::from_str(&format!("{at_corners}corner_rule = 'forbid_any'")).unwrap();
        let settings = Settings::composed("a test", table);
        let error = (ENTRY.build)(&settings, &Inputs::below(Vec::new())).err().unwrap().to_string();
        for message in [
            "corner_rule = \"allow\" is accepted",
            "goal is [3, 4], outside the map; corners from [0, 0] to [3, 3] are accepted",
        ] {
            assert!(error.contains(message), "{error}\nlacks\n{message}");
        }
    }

    #[test]
    fn a_start_outside_and_a_goal_beyond_the_last_corner_are_refused_and_the_edge_is_accepted() {
        let at_corners = |more: &str| build(&format!("blocked_share = 0.1\nvertices = 'corners'\n{more}"));
        let error = at_corners("start = [31, 0]").err().unwrap_or_default();
        assert!(
            error.contains("start is [31, 0], outside the map; corners from [0, 0] to [30, 20] are accepted"),
            "{error}"
        );
        let error = at_corners("start = { x = 31 }").err().unwrap_or_default();
        let message =
            "x of start is from 31 to 31; the least and the greatest, both from 0 to 30, are accepted";
        assert!(error.contains(message), "{error}");
        let edge = at_corners("start = { x = 30, y = [1, 20] }").unwrap();
        assert_eq!(edge.queries_for(7).remove(0).start[0], 30.0);
    }

    #[test]
    fn a_goal_inside_the_border_lies_in_no_row_of_it() {
        let rows = |more: &str| {
            let at_corners = "blocked_share = 0.2\nborder_cells = 4\nvertices = 'corners'";
            let family = build(&format!("{at_corners}\n{more}")).unwrap();
            let row = |seed: u64| family.queries_for(seed).remove(0).goal[1] as u32;
            let rows: std::collections::BTreeSet<u32> = (0..200).map(row).collect();
            [rows.first().copied(), rows.last().copied()]
        };
        assert_eq!(rows(""), [Some(0), Some(20)]);
        assert_eq!(rows("end_rows = 'inside'"), [Some(4), Some(15)]);
    }

    #[test]
    fn at_corners_an_instance_starts_and_ends_where_a_free_cell_is() {
        let mut goals = std::collections::BTreeSet::new();
        let family = build("blocked_share = 0.4\nvertices = 'corners'").unwrap();
        for seed in 0..40 {
            let preprocessing = family.prepare(seed).unwrap();
            let lattice = preprocessing.world.as_lattice().unwrap();
            assert!(lattice.cells().is_free(0), "seed {seed}: the written start's cell is freed");
            let query = family.queries_for(seed).remove(0);
            assert_eq!(query.goal[0], 29.0, "seed {seed}");
            lattice.free_cell("goal", &query.goal).unwrap();
            goals.insert(query.goal[1] as u32);
        }
        assert!(goals.len() > 12 && goals.iter().all(|y| *y <= 20), "{goals:?}");
    }
}
