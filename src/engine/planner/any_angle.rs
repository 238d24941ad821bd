//! Settings, memory and plans that the any-angle planners share.

use super::lattice::{Posed, check_sight, sees};
use super::one_side::{Found, OneSided};
use super::pool::Pool;
use super::{Invalid, Plan, Planner, Request};
use crate::search::{AnyAngle, AnyAngleRules, Branching, BucketHeap, Observer, Seen, Sighted, Ties, When};
use crate::shorten::path_length;
use base::grid::Sight;
use base::settings::{Faults, Settings, SettingsError};
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
    line_of_sight: Sight,
    /// The order among equal f.
    #[serde(default)]
    ties: Ties,
    /// What the distance to the goal is multiplied by; 1 if absent. Below 1, more is expanded and paths tend to be shorter.
    #[schemars(range(min = 0))]
    weight: Option<f64>,
    /// Whether a closed node to which a better way is found is expanded again; only where `theta_star` looks at lines of sight.
    #[serde(default)]
    reopen: bool,
    /// How many neighbours a node has at most; `eight` if absent.
    branching: Option<Branching>,
    /// Which lines of sight are counted; those that are `looked_at` if absent.
    counted_sight: Option<CountedSetting>,
    #[serde(skip)]
    pool: Pool<AnyAngle<BucketHeap>>,
}

/// Which lines of sight are counted, as settings write it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum CountedSetting {
    /// Those that are looked at: a way that would not improve is not.
    LookedAt,
    /// One to every successor that is not closed, as the printed Theta* has it.
    Printed,
}

/// The planner that looks at lines of sight at the time `when`.
pub(super) fn built(settings: &Settings, when: When) -> Result<Box<dyn Planner>, SettingsError> {
    let read: AnyAngleSettings = settings.read()?;
    let mut faults = Faults::default();
    if when == When::Taken {
        let printed = read.counted_sight.filter(|counted| *counted == CountedSetting::Printed);
        for (key, is_set) in [("reopen", read.reopen), ("counted_sight", printed.is_some())] {
            if is_set {
                let message = format!("{key} is for lines of sight to successors; theta_star accepts it");
                faults.add(settings.error_at(key, message));
            }
        }
    }
    faults.done()?;
    Ok(Box::new(Timed { settings: read, when }))
}

/// An any-angle planner that looks at lines of sight at one time.
struct Timed {
    settings: AnyAngleSettings,
    when: When,
}

impl OneSided for Timed {
    type Cost = f64;

    fn search<O: Observer>(&self, posed: &Posed<'_>, expansions: u64, observer: &mut O) -> Found<f64> {
        let settings = &self.settings;
        let world = posed.world;
        let grid = posed.world.grid();
        let sight = settings.line_of_sight;
        let sees = |from: [i32; 2], to: [i32; 2]| sees(world, sight, from, to);
        let on = Sighted { grid, moves: world.moves(), sees };
        let rules = AnyAngleRules {
            when: self.when,
            weight: settings.weight.unwrap_or(1.0),
            reopens: settings.reopen,
            branching: settings.branching.unwrap_or_default(),
            counts_all: settings.counted_sight == Some(CountedSetting::Printed),
            max_expansions: expansions,
        };
        let mut search = settings.pool.any(|| AnyAngle::new(BucketHeap::new(settings.ties)));
        let Seen { report, sight_checks } = search.solve(&on, rules, [posed.start, posed.goal], observer);
        settings.pool.keep(search);
        Found { sight_checks: Some(sight_checks), ..report.into() }
    }
}

impl Planner for Timed {
    /// Its path lists corners alone.
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        check_sight(posed.world, self.settings.line_of_sight)?;
        let mut plan = self.planned(request, &posed);
        if self.settings.reopen && plan.cost.is_some() {
            // A way to a node on the path may have become shorter after the goal's g was added up.
            plan.cost = Some(path_length(&plan.path));
        }
        Ok(plan)
    }

    fn is_complete(&self) -> bool {
        self.settings.branching != Some(Branching::Four)
    }

    fn is_any_angle(&self) -> bool {
        true
    }
}
