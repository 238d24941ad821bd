//! Jump point search, online: JPS(B+P).
//!
//! Runs are scanned 64 cells at a time and intermediate jump points are pruned ([`JumpSearch`](crate::search::JumpSearch),
//! where counters and ties are defined). It plans under every corner rule. What it needs of a map are a byte a cell of
//! bits ([`JumpLines`]); `prepared_bytes` says how many there are. They are made in one pass over the map, once, or in
//! every query with `preparation = "each_query"`: a study that has both contenders finds the cost in their clock readings.
//!
//! # Source
//! Harabor & Grastien, *Online graph pruning for pathfinding on grid maps*, AAAI 2011; *Improving jump point search*,
//! ICAPS 2014, sections 4 and 5.

use super::jump_points::{COLUMNS, JumpPoints, Preparation};
use super::lattice::Posed;
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::space::{JumpLines, WorldKind};
use base::settings::Accepted;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "jps",
    about: "jump point search, online, with block-based scanning and intermediate pruning: least cost",
    revision: 1,
    needs: WorldKind::Lattice,
    columns: COLUMNS,
    settings: Accepted::of::<JumpPoints>(),
    example: "preparation = \"kept\"",
    build: Build::Planner(|settings| {
        let read: JumpPoints = settings.read()?;
        Ok(Box::new(Jps(read)))
    }),
};

struct Jps(JumpPoints);

impl Planner for Jps {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let made;
        let lines = match self.0.preparation {
            Preparation::Kept => posed.world.jump_lines(),
            Preparation::EachQuery => {
                made = JumpLines::new(posed.world);
                &made
            }
        };
        self.0.plan(&posed, request, lines, lines.bytes())
    }

    fn is_optimal(&self) -> bool {
        true
    }

    fn is_complete(&self) -> bool {
        true
    }
}
