//! A\* on the visibility graph of a map: start, goal and corners of blocked cells, joined where they see each other.
//!
//! Edges are found when a vertex is expanded, all at once; each other vertex counts as looked at.

use super::corners;
use super::entry::planner;
use super::lattice::{Posed, UPDATE};
use super::one_side::{Found, OneSided};
use super::pool::Pool;
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::{
    BucketHeap, Combined, Cornered, Graph, Observer, Rules, Search, SideInputs, Stop, Ties, euclidean_to, sum,
};
use base::grid::seen_corners;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "visibility_astar",
    about: "A* on the visibility graph over corners of blocked cells: a shortest path of any angle",
    revision: 1,
    needs: WorldKind::CornerLattice,
    columns: &["opened", "opened_distinct", "closed", "expansions", "generated", "sight_checks"],
    settings: Accepted::shape::<VisibilityAstar>(),
    example: r#"
ties = "larger_g"
vertices = "all"
"#,
    build: Build::Planner(planner::<VisibilityAstar>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct VisibilityAstar {
    /// The order among equal f.
    ties: Ties,
    /// Which corners of blocked cells are vertices.
    vertices: VerticesSetting,
    #[serde(skip)]
    pool: Pool<Search<f64, BucketHeap>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum VerticesSetting {
    /// All that touch a free cell.
    All,
    /// Those about which a shortest path can turn: they belong to one blocked cell, or to two that touch there.
    Convex,
}

impl VerticesSetting {
    /// The corners of this kind.
    fn vertices(self, on: &Cornered<'_>) -> Vec<u32> {
        let is_vertex = |corner: &u32| {
            let [x, y] = on.grid.xy(*corner);
            let around = [[x, y], [x - 1, y - 1], [x - 1, y], [x, y - 1]];
            let free = around.map(|[x, y]| on.cells.is_free_xy(x, y));
            match free.iter().filter(|is_free| **is_free).count() {
                0 | 4 => false,
                3 => true,
                2 => self == Self::All || free[0] == free[1],
                _ => self == Self::All,
            }
        };
        (0..on.grid.cell_count()).filter(is_vertex).collect()
    }
}

/// The graph; edges are those of the vertex in hand.
struct Visible<'a> {
    on: Cornered<'a>,
    /// The vertices of the graph, the goal among them.
    vertices: Vec<u32>,
    /// Where each corner stands among them, or [`NONE`].
    places: Vec<u32>,
    sight_checks: u64,
    /// The places of those that the vertex in hand sees.
    seen: Vec<u32>,
}

/// No vertex.
const NONE: u32 = u32::MAX;

impl<'a> Visible<'a> {
    fn new(on: Cornered<'a>, vertices: Vec<u32>) -> Self {
        let mut places = vec![NONE; on.grid.cell_count() as usize];
        for (place, vertex) in (0..).zip(&vertices) {
            places[*vertex as usize] = place;
        }
        Self { on, vertices, places, sight_checks: 0, seen: Vec::new() }
    }
}

impl Graph for Visible<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.on.grid.cell_count() as usize
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        let Self { on, vertices, places, seen, .. } = self;
        let is_own = places[node as usize] != NONE;
        self.sight_checks += vertices.len() as u64 - u64::from(is_own);
        seen.clear();
        seen_corners(on.cells, on.grid.xy(node), |[x, y]| {
            let corner = on.grid.cell(x, y).expect("a corner that is seen lies on the map");
            seen.extend(Some(places[corner as usize]).filter(|place| *place != NONE));
        });
        // In the order of vertices, which decides among equal ones.
        seen.sort_unstable();
        for to in seen.iter().map(|place| vertices[*place as usize]) {
            visit(to, euclidean_to(on.grid, to)(node));
        }
    }
}

impl OneSided for VisibilityAstar {
    type Cost = f64;

    fn search<O: Observer>(&self, posed: &Posed<'_>, expansions: u64, observer: &mut O) -> Found<f64> {
        let goal = posed.goal;
        let on = corners::cornered(posed.world);
        let mut vertices = self.vertices.vertices(&on);
        if !vertices.contains(&goal) {
            vertices.push(goal);
        }
        let estimate = Combined { h: euclidean_to(on.grid, goal), combine: sum };
        let mut graph = Visible::new(on, vertices);
        let mut search = self.pool.any(|| Search::new(BucketHeap::new(self.ties)));
        let terms = SideInputs { graph: &mut graph, estimate: &estimate, observer, update: UPDATE };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: expansions };
        let report = search.run(terms, posed.start, |corner| corner == goal, rules, &mut ());
        self.pool.keep(search);
        Found { sight_checks: Some(graph.sight_checks), ..report.into() }
    }
}

impl Planner for VisibilityAstar {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        Ok(self.planned(request, &Posed::new(request)?))
    }

    fn is_optimal(&self) -> bool {
        true
    }

    fn is_complete(&self) -> bool {
        true
    }

    fn is_any_angle(&self) -> bool {
        true
    }
}
