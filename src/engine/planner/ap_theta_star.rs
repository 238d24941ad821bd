//! Angle-propagation Theta\* between corners of cells.
//!
//! # Source
//! Daniel, Nash, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, JAIR 39 (2010), section 6.

use super::corners;
use super::lattice::{COLUMNS_DISTINCT, Posed, TiesSetting};
use super::pool::Pool;
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::{AngleRanges, Heap};
use crate::space::WorldKind;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "ap_theta_star",
    about: "angle-propagation Theta*: ranges of angles, handed on as vertices are expanded, stand for lines of sight",
    revision: 1,
    needs: WorldKind::CornerLattice,
    columns: COLUMNS_DISTINCT,
    settings: Accepted::shape::<ApTheta>(),
    example: r#"
ties = "smaller_g"
"#,
    build: Build::Planner(|settings| {
        let read: ApTheta = settings.read()?;
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ApTheta {
    /// The order among equal f.
    ties: TiesSetting,
    #[serde(skip)]
    pool: Pool<AngleRanges<Heap>>,
}

impl Planner for ApTheta {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let ends = [posed.start, posed.goal];
        let mut search = self.pool.any(|| AngleRanges::new(Heap::new(self.ties.into())));
        let on = corners::cornered(posed.world);
        let (report, traces) = corners::watched(request, &posed, |mut observer| {
            search.solve(&on, ends, request.expansions, &mut observer)
        });
        self.pool.keep(search);
        Ok(corners::plan(&posed, &report, traces))
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
