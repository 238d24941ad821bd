//! Zhang's inflection-point deletion as a stage.

use super::lattice::lattice;
use super::{Build, Ending, Entry, Plan, Request, Stage};
use crate::shorten::{bends, inflection_deletion, path_length};
use crate::space::{LatticeWorld, WorldKind};
use base::grid::{CornerRule, Sight};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "delete_inflections",
    about: "from the goal backwards, drops bends while the line of sight to the bend before is free",
    revision: 2,
    needs: WorldKind::Lattice,
    columns: &[],
    settings: Accepted::of::<DeleteInflections>(),
    example: r#"
line_of_sight = "exact_interior"
"#,
    build: Build::Stage(|settings| {
        let read: DeleteInflections = settings.read()?;
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DeleteInflections {
    /// Which cells a line of sight must find free.
    line_of_sight: SightSetting,
}

#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum SightSetting {
    /// Cells whose interior the segment crosses; where it passes through the corner between two cells, neither is
    /// entered.
    ExactInterior,
    /// Cells that the segment touches at all: at a corner also the two that flank it.
    ClosedCells,
    /// Cells of Bresenham's line drawn from the first end to the second.
    Bresenham,
}

impl From<SightSetting> for Sight {
    fn from(setting: SightSetting) -> Self {
        match setting {
            SightSetting::ExactInterior => Self::ExactInterior,
            SightSetting::ClosedCells => Self::ClosedCells,
            SightSetting::Bresenham => Self::Bresenham,
        }
    }
}

impl Stage for DeleteInflections {
    fn refine(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        if plan.ending != Ending::Solved {
            return plan;
        }
        let world = lattice(request.world);
        let corners: Vec<[i32; 2]> =
            bends(&plan.path).into_iter().map(|i| [plan.path[i][0] as i32, plan.path[i][1] as i32]).collect();
        let sight = Sight::from(self.line_of_sight);
        let mut refused = Vec::new();
        let kept = inflection_deletion(corners.len(), |i, j| {
            let is_free = sees(world, sight, corners[i], corners[j]);
            if !is_free && request.trace {
                refused.extend([corners[i], corners[j]].concat().into_iter().map(f64::from));
            }
            is_free
        });
        if request.trace {
            let values = plan.path.concat();
            plan.exhibits.push(super::Exhibit { name: "raw_path".to_owned(), width: 2, values });
            plan.exhibits.push(super::Exhibit {
                name: "refused_sight".to_owned(),
                width: 4,
                values: refused,
            });
        }
        plan.path = kept.into_iter().map(|i| corners[i].map(f64::from).to_vec()).collect();
        plan.cost = Some(path_length(&plan.path));
        plan
    }
}

/// Whether the segment is free by the line of sight and cuts no corner that the world's rule forbids.
fn sees(world: &LatticeWorld, sight: Sight, from: [i32; 2], to: [i32; 2]) -> bool {
    let grid = world.grid();
    let is_free = |[x, y]: [i32; 2]| grid.is_free_xy(x, y);
    if !sight.all_cells(from, to, is_free) {
        return false;
    }
    let mut before: Option<[i32; 2]> = None;
    Sight::ExactInterior.all_cells(from, to, |cell| {
        let flanks = before.map(|[x, y]| [[cell[0], y], [x, cell[1]]]);
        let cuts = before.is_some_and(|[x, y]| x != cell[0] && y != cell[1]);
        before = Some(cell);
        let Some(flanks) = flanks.filter(|_| cuts) else { return true };
        match world.corner_rule() {
            CornerRule::Allow => true,
            CornerRule::ForbidBoth => flanks.into_iter().any(is_free),
            CornerRule::ForbidAny => flanks.into_iter().all(is_free),
        }
    })
}
