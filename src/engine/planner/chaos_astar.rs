//! A* over the tip positions of a planar arm that looks at a random part of a neighbourhood.

use super::pool::Pool;
use super::tips::{
    self, COLUMNS, Heuristic, OpenSetting, Posed, RegionSetting, RegionShape, TipSearch, TipSearchOptions,
    TipTies,
};
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::Successors;
use base::grid::{MAX_REACH_CELLS, Offsets};
use base::seed::{self, Stream};
use base::settings::Accepted;
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::{ArmWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "chaos_astar",
    about: "A* over an arm's tip positions; neighbours are some points of a region, drawn at random",
    revision: 1,
    needs: WorldKind::Arm,
    columns: COLUMNS,
    settings: Accepted::shape::<ChaosAstar>(),
    example: r#"
region_shape = "square"
region_radius_cells = 1
neighbours = 5
drawn = "each_expansion"
source = "uniform"
goal_in_region = "included"
open_node = "lowered"
ties = "fifo"
heuristic = "euclidean"
"#,
    build: Build::Planner(|settings| {
        let read: ChaosAstar = settings.read()?;
        let region = RegionSetting { shape: read.region_shape, radius_cells: read.region_radius_cells };
        let offsets = region.offsets();
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
    #[schemars(range(min = 1, max = MAX_REACH_CELLS))]
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
    ties: TipTies,
    /// The distance to the goal that is added to g.
    #[serde(default)]
    heuristic: Heuristic,
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
struct ChaosPart<'a> {
    world: &'a ArmWorld,
    region: &'a [[i32; 2]],
    read: ChaosAstar,
    goal: u32,
    numbers: Numbers,
    /// Indices into the region; those drawn stand first.
    order: Vec<usize>,
    /// Which steps of the region are tried: those of the column `dx` are the bits at `dx + reach`, from the highest on.
    tried: Vec<u64>,
    /// What was drawn first, for figures.
    first: Vec<[i32; 2]>,
}

impl ChaosPart<'_> {
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
        let Self { tried, order, region, read, .. } = self;
        let reach = i32::from(read.region_radius_cells);
        let at = |[dx, dy]: [i32; 2]| ((dx + reach) as usize, 1 << (reach - dy));
        tried.fill(0);
        let drawn = &order[..read.neighbours];
        for &index in drawn {
            let (column, bit) = at(region[index]);
            tried[column] |= bit;
        }
        let is_near = to_goal.iter().all(|d| d.abs() <= reach);
        if !is_near || read.goal_in_region == GoalInRegion::AsDrawn || !region.contains(&to_goal) {
            return;
        }
        let (column, bit) = at(to_goal);
        if tried[column] & bit == 0 {
            let last = drawn.last().expect("at least one neighbour is drawn");
            let (of_last, last) = at(region[*last]);
            tried[of_last] &= !last;
            tried[column] |= bit;
        }
    }
}

impl Successors for ChaosPart<'_> {
    fn expands(&mut self, cell: u32) {
        if self.first.is_empty() || self.read.drawn == Drawn::EachExpansion {
            self.draw();
        }
        let [[x, y], goal] = [cell, self.goal].map(|cell| self.world.grid().xy(cell));
        self.choose([goal[0] - x, goal[1] - y]);
    }

    #[inline]
    fn kept(&mut self, cell: u32, dx: i32, reach: i32, free: u64) -> u64 {
        self.world.hops(cell, dx, reach, free & self.tried[(dx + reach) as usize])
    }
}

impl Planner for Ready {
    fn draws(&self) -> bool {
        true
    }

    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let mut part = ChaosPart {
            world: posed.world,
            region: self.offsets.steps(),
            read: self.read,
            goal: posed.goal,
            numbers: Numbers::new(seed::stream(request.seed), self.read.source),
            order: (0..self.offsets.steps().len()).collect(),
            tried: vec![0; 2 * usize::from(self.read.region_radius_cells) + 1],
            first: Vec::new(),
        };
        let mut search = self.pool.any(|| TipSearch::new(&self.offsets, self.read.ties));
        let ChaosAstar { heuristic, open_node, .. } = self.read;
        let manner = TipSearchOptions { heuristic, open_node, expansions: request.expansions };
        let (report, scans) = posed.search(&mut search, &self.offsets, &mut part, manner);
        self.pool.keep(search);
        let mut plan = posed.plan(&report, scans, request.trace);
        if request.trace {
            plan.traces.push(tips::steps("region", self.offsets.steps()));
            plan.traces.push(tips::steps("drawn", &part.first));
        }
        Ok(plan)
    }

    fn steps(&self) -> Option<&[[i32; 2]]> {
        Some(self.offsets.steps())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::tests::reproduced_rules;
    use crate::search::{ColumnGraph, Graph as _};
    use world::space::HopRule;

    fn settings(drawn: Drawn, goal_in_region: GoalInRegion, source: Source) -> ChaosAstar {
        ChaosAstar {
            region_shape: RegionShape::Disc,
            region_radius_cells: 3,
            neighbours: 9,
            drawn,
            source,
            goal_in_region,
            open_node: OpenSetting::Lowered,
            ties: TipTies::Fifo,
            heuristic: Heuristic::Euclidean,
        }
    }

    /// What is drawn for each of `cells` in turn, with a near goal in place of what was drawn last.
    fn drawn_one_by_one(
        read: ChaosAstar,
        offsets: &Offsets,
        [seed, goal]: [u64; 2],
        cells: &[[i32; 2]],
    ) -> Vec<Vec<[i32; 2]>> {
        let mut numbers = Numbers::new(seed::stream(seed), read.source);
        let mut order = offsets.steps().to_vec();
        let mut once: Option<Vec<[i32; 2]>> = None;
        let goal = [goal as i32 % 101, goal as i32 / 101];
        let mut of_cell = |[x, y]: &[i32; 2]| {
            let mut drawn = once.clone().unwrap_or_else(|| {
                for place in 0..read.neighbours {
                    let other = place + numbers.below(order.len() - place);
                    order.swap(place, other);
                }
                order[..read.neighbours].to_vec()
            });
            if read.drawn == Drawn::OncePerRun {
                once = Some(drawn.clone());
            }
            let to_goal = [goal[0] - x, goal[1] - y];
            let is_new = offsets.steps().contains(&to_goal) && !drawn.contains(&to_goal);
            if read.goal_in_region == GoalInRegion::Included && is_new {
                drawn.pop();
                drawn.push(to_goal);
            }
            offsets.steps().iter().copied().filter(|step| drawn.contains(step)).collect()
        };
        cells.iter().map(&mut of_cell).collect()
    }

    #[test]
    fn the_steps_tried_are_those_drawn_with_a_near_goal_for_the_last() {
        let world = ArmWorld::new(reproduced_rules(HopRule::EndPoints), Vec::new());
        let offsets = Offsets::disc(3);
        let grid = world.grid();
        let goal = grid.cell(80, 20).unwrap();
        let at: Vec<[i32; 2]> = (0..40).map(|k| [76 + k % 8, 18 + k / 8]).collect();
        let mut goals = 0;
        for seed in 0..60 {
            let drawn = if seed % 2 == 0 { Drawn::EachExpansion } else { Drawn::OncePerRun };
            let near = if seed % 4 < 2 { GoalInRegion::Included } else { GoalInRegion::AsDrawn };
            let source = if seed % 3 == 0 { Source::Logistic } else { Source::Uniform };
            let read = settings(drawn, near, source);
            let mut part = ChaosPart {
                world: &world,
                region: offsets.steps(),
                read,
                goal,
                numbers: Numbers::new(seed::stream(seed), source),
                order: (0..offsets.steps().len()).collect(),
                tried: vec![0; 7],
                first: Vec::new(),
            };
            let mut graph = ColumnGraph::new(world.columns(), &offsets, 1.0, &mut part);
            let truth = drawn_one_by_one(read, &offsets, [seed, u64::from(goal)], &at);
            for ([x, y], steps) in at.iter().zip(truth) {
                let all = steps.iter().filter_map(|[dx, dy]| grid.cell(x + dx, y + dy));
                let truth: Vec<u32> = all.filter(|cell| grid.is_free(*cell)).collect();
                let mut found = Vec::new();
                graph.successors(grid.cell(*x, *y).unwrap(), |to, _| found.push(to));
                assert_eq!(found, truth, "seed {seed}, ({x}, {y})");
                goals += u32::from(found.contains(&goal));
            }
        }
        assert!((300..1_500).contains(&goals), "the goal was a successor {goals} times of 2400");
    }
}
