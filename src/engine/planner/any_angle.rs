//! What the any-angle planners share: their settings, their memory, their plans.

use super::lattice::{self, Posed, SightSetting, TiesSetting, sees};
use super::pool::Pool;
use super::{Invalid, Plan, Planner, Request, Value};
use crate::search::{AnyAngle, Closings, Heap, Observer, Seen, Sighted, VisitOrder, When};
use base::settings::{Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;

/// The columns that every any-angle search fills.
pub(super) const COLUMNS: &[&str] =
    &["opened", "opened_distinct", "closed", "expansions", "generated", "sight_checks"];

/// An any-angle planner with its settings.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct AnyAngleSettings {
    /// Which cells a line of sight must find free.
    line_of_sight: SightSetting,
    /// The order among equal f.
    #[serde(default)]
    ties: TiesSetting,
    #[serde(skip)]
    pool: Pool<AnyAngle<Heap>>,
}

/// The planner that looks at lines of sight at the time `when`.
pub(super) fn built(settings: &Settings, when: When) -> Result<Box<dyn Planner>, SettingsError> {
    let read: AnyAngleSettings = settings.read()?;
    Ok(Box::new(Timed { settings: read, when }))
}

/// An any-angle planner that looks at lines of sight at one time.
struct Timed {
    settings: AnyAngleSettings,
    when: When,
}

impl Planner for Timed {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        self.settings.plan(request, self.when)
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

impl AnyAngleSettings {
    /// The plan of a search that looks at lines of sight at the time `when`; its path lists corners alone.
    fn plan(&self, request: &Request<'_>, when: When) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let grid = posed.world.grid();
        let closings = Closings::default();
        let mut watching = (VisitOrder::default(), closings.one_side(0));
        let Seen { report, sight_checks } = if request.trace {
            self.search(&posed, request.expansions, when, &mut watching)
        } else {
            self.search(&posed, request.expansions, when, &mut ())
        };
        let mut traces = Vec::new();
        if request.trace {
            traces.push(lattice::cells(grid, "opened_start_side", &watching.0.opened));
            traces.push(lattice::closings(grid, closings));
        }
        let plan = lattice::plan(grid, &report.outcome, &[report.counters], traces);
        let mut plan = lattice::with_distinct(plan, report.counters.opened);
        plan.counts.insert("sight_checks", Value::Count(sight_checks));
        Ok(plan)
    }

    fn search(&self, posed: &Posed<'_>, expansions: u64, when: When, observer: &mut impl Observer) -> Seen {
        let world = posed.world;
        let grid = posed.world.grid();
        let sight = self.line_of_sight.into();
        let sees = |from: u32, to: u32| sees(world, sight, grid.xy(from), grid.xy(to));
        let on = Sighted { grid, moves: world.moves(), sees };
        let mut search = self.pool.any(|| AnyAngle::new(Heap::new(self.ties.into())));
        let seen = search.solve(&on, when, [posed.start, posed.goal], expansions, observer);
        self.pool.keep(search);
        seen
    }
}
