//! A* over the tip positions of a planar arm that looks at a random part of a neighbourhood.

use super::lattice::TiesSetting;
use super::pool::Pool;
use super::tips::{self, COLUMNS, OpenSetting, Posed, RegionSetting, RegionShape, TipSearch};
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::Graph;
use crate::space::{ArmWorld, WorldKind};
use base::grid::Offsets;
use base::seed::{self, Stream};
use base::settings::Accepted;
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "chaos_astar",
    about: "A* over an arm's tip positions; neighbours are some points of a region, drawn at random",
    revision: 1,
    needs: WorldKind::Arm,
    columns: COLUMNS,
    settings: Accepted::of::<ChaosAstar>(),
    example: r#"
region_shape = "square"
region_radius_cells = 1
neighbours = 5
drawn = "each_expansion"
source = "uniform"
goal_in_region = "included"
open_node = "lowered"
ties = "fifo"
"#,
    build: Build::Planner(|settings| {
        let read: ChaosAstar = settings.read()?;
        let region = RegionSetting { shape: read.region_shape, radius_cells: read.region_radius_cells };
        let offsets = region.offsets(settings)?;
        let most = offsets.steps().len();
        if !(1..=most).contains(&read.neighbours) {
            let message = format!(
                "neighbours is {}; 1 to {most}, all points of the region, is accepted",
                read.neighbours
            );
            return Err(settings.error_at("neighbours", message));
        }
        Ok(Box::new(Ready { read, offsets, pool: Pool::default() }))
    }),
};

#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(deny_unknown_fields)]
struct ChaosAstar {
    /// The shape of the region that is drawn from.
    region_shape: RegionShape,
    /// Its radius, to the middle of a side.
    region_radius_cells: u8,
    /// How many are drawn.
    neighbours: usize,
    /// How often they are drawn.
    drawn: Drawn,
    /// What they are drawn with.
    source: Source,
    /// Whether a goal within the region takes the place of the point drawn last.
    goal_in_region: GoalInRegion,
    /// Whether a better way to an open node is taken.
    open_node: OpenSetting,
    /// The order among equal f.
    #[serde(default)]
    ties: TiesSetting,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Drawn {
    /// Anew at every expansion.
    EachExpansion,
    /// Once, and then kept for the whole run.
    OncePerRun,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Source {
    /// Evenly distributed numbers.
    Uniform,
    /// The logistic map.
    Logistic,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum GoalInRegion {
    /// It takes that place.
    Included,
    /// It does not; the points stay as they were drawn.
    AsDrawn,
}

struct Ready {
    read: ChaosAstar,
    offsets: Offsets,
    pool: Pool<TipSearch>,
}

/// Numbers in (0, 1).
struct Numbers {
    stream: Stream,
    source: Source,
    /// The state of the logistic map.
    x: f64,
}

impl Numbers {
    fn new(stream: Stream, source: Source) -> Self {
        Self { stream, source, x: 0.0 }
    }

    /// A number below `count`.
    fn below(&mut self, count: usize) -> usize {
        match self.source {
            Source::Uniform => self.stream.random_range(0..count),
            Source::Logistic => ((self.logistic() * count as f64) as usize).min(count - 1),
        }
    }

    /// The map x ← 4 x (1 − x), started anew from the stream where it has come to rest.
    fn logistic(&mut self) -> f64 {
        let next = 4.0 * self.x * (1.0 - self.x);
        let rests = !(next > 0.0 && next < 1.0) || next == self.x;
        self.x = if rests { self.stream.random_range(0.0..1.0) } else { next };
        self.x
    }
}

/// The free points among a part of the region that changes.
struct ChaosGraph<'a> {
    world: &'a ArmWorld,
    region: &'a [[i32; 2]],
    read: ChaosAstar,
    goal: u32,
    numbers: Numbers,
    /// Indices into the region; those drawn stand first.
    order: Vec<usize>,
    /// Which steps of the region are tried.
    is_tried: Vec<bool>,
    /// What was drawn first, for figures.
    first: Vec<[i32; 2]>,
}

impl ChaosGraph<'_> {
    /// Draws a part, in the order of the region.
    fn draw(&mut self) {
        let count = self.read.neighbours;
        for place in 0..count {
            let other = place + self.numbers.below(self.order.len() - place);
            self.order.swap(place, other);
        }
        if self.first.is_empty() {
            self.first = self.order[..count].iter().map(|&index| self.region[index]).collect();
        }
    }

    /// Marks the steps to be tried from a cell `to_goal` away from the goal.
    fn choose(&mut self, to_goal: [i32; 2]) {
        let drawn = &self.order[..self.read.neighbours];
        self.is_tried.fill(false);
        for &index in drawn {
            self.is_tried[index] = true;
        }
        let reach = i32::from(self.read.region_radius_cells);
        let is_near = to_goal.iter().all(|d| d.abs() <= reach);
        if !is_near || self.read.goal_in_region == GoalInRegion::AsDrawn {
            return;
        }
        if let Some(goal) = self.region.iter().position(|step| *step == to_goal)
            && !self.is_tried[goal]
        {
            let last = drawn.last().expect("at least one neighbour is drawn");
            self.is_tried[*last] = false;
            self.is_tried[goal] = true;
        }
    }
}

impl Graph for ChaosGraph<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.world.grid().cell_count() as usize
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        if self.first.is_empty() || self.read.drawn == Drawn::EachExpansion {
            self.draw();
        }
        let (grid, step_cm) = (self.world.grid(), self.world.rules().lattice.step_cm());
        let ([x, y], goal) = (grid.xy(node), grid.xy(self.goal));
        self.choose([goal[0] - x, goal[1] - y]);
        for (&[dx, dy], _) in self.region.iter().zip(&self.is_tried).filter(|(_, is_tried)| **is_tried) {
            let Some(to) = grid.cell(x + dx, y + dy) else { continue };
            if grid.is_free(to) && self.world.may_step(node, [dx, dy]) {
                visit(to, step_cm * f64::from(dx * dx + dy * dy).sqrt());
            }
        }
    }
}

impl Planner for Ready {
    fn draws(&self) -> bool {
        true
    }

    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let mut graph = ChaosGraph {
            world: posed.world,
            region: self.offsets.steps(),
            read: self.read,
            goal: posed.goal,
            numbers: Numbers::new(seed::stream(request.seed), self.read.source),
            order: (0..self.offsets.steps().len()).collect(),
            is_tried: vec![false; self.offsets.steps().len()],
            first: Vec::new(),
        };
        let mut search = self.pool.any(|| tips::search(self.read.ties));
        let (report, scans) =
            posed.search(&mut search, &mut graph, self.read.open_node.into(), request.expansions);
        self.pool.keep(search);
        let mut plan = posed.plan(&report, scans, request.trace);
        if request.trace {
            plan.exhibits.push(tips::steps("region", self.offsets.steps()));
            plan.exhibits.push(tips::steps("drawn", &graph.first));
        }
        Ok(plan)
    }

    fn is_optimal(&self) -> bool {
        false
    }

    fn is_complete(&self) -> bool {
        false
    }

    fn steps(&self) -> Option<&[[i32; 2]]> {
        Some(self.offsets.steps())
    }
}
