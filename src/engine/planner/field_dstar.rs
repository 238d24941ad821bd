//! Field D\* between corners of cells, as one search from start to goal.

use super::corners;
use super::lattice::{COLUMNS_DISTINCT, Posed, TiesSetting};
use super::pool::Pool;
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::{Heap, Interpolated};
use crate::space::WorldKind;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "field_dstar",
    about: "Field D*: costs are interpolated along edges of cells, over which its path leads anywhere; searched once",
    revision: 1,
    needs: WorldKind::CornerLattice,
    columns: COLUMNS_DISTINCT,
    settings: Accepted::shape::<FieldDstar>(),
    example: r#"
ties = "larger_g"
"#,
    build: Build::Planner(|settings| {
        let read: FieldDstar = settings.read()?;
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct FieldDstar {
    /// The order among equal f.
    ties: TiesSetting,
    #[serde(skip)]
    pool: Pool<Interpolated<Heap>>,
}

impl Planner for FieldDstar {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let ends = [posed.start, posed.goal];
        let mut search = self.pool.any(|| Interpolated::new(Heap::new(self.ties.into())));
        let on = corners::cornered(posed.world);
        let (field, traces) = corners::watched(request, &posed, |mut observer| {
            search.solve(&on, ends, request.expansions, &mut observer)
        });
        self.pool.keep(search);
        let mut plan = corners::plan(&posed, &field.report, traces);
        plan.path = field.path.into_iter().map(|at| at.to_vec()).collect();
        Ok(plan)
    }

    fn is_optimal(&self) -> bool {
        false
    }

    fn is_complete(&self) -> bool {
        true
    }

    fn is_any_angle(&self) -> bool {
        true
    }
}
