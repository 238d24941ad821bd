//! Acceptance on the maps found for the zhang study, and laws that hold the drivers and specialisations together.

mod any_angle;
mod bidirectional;
mod cubic_astar;
mod jump;
mod lattice_astar;
mod octile;
mod one_way;
mod parts;
mod two_lists;
mod witness;

use super::*;
use base::grid::{CornerRule, Grid2, Moves, independent_cells};
use base::seed;
use rand::RngExt as _;
use world::geometry::planar::Touch;
use world::kinematics::planar_2r::{ElbowRule, Planar2r};
use world::space::{ArmRules, HopRule, TipLattice};

/// The rules of the reproduced planar workspace.
pub fn reproduced_rules(hop: HopRule) -> ArmRules {
    ArmRules {
        arm: Planar2r::new(30.0, 20.0).unwrap(),
        elbow: ElbowRule::NegativeQ2,
        lattice: TipLattice::new([-50.0, 50.0], [0.0, 50.0], 1.0).unwrap(),
        inner_radius_cm: 20.0,
        q2_limit_rad: f64::INFINITY,
        touch: Touch::Contact,
        corner_rule: CornerRule::Allow,
        hop,
    }
}

const RULES: [CornerRule; 3] = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny];

fn terms<'a, G, E>(graph: &'a mut G, estimate: &'a E, observer: &'a mut ()) -> SideInputs<'a, G, E, ()> {
    SideInputs { graph, estimate, observer, update: Update::default() }
}

/// One query of a search with the default rules.
fn solve<C: Cost, Q: Frontier>(
    search: &mut Search<C, Q>,
    graph: &mut impl Graph<Cost = C>,
    estimate: &impl Estimate<C>,
    [start, goal]: [u32; 2],
) -> Report<C> {
    search.run(terms(graph, estimate, &mut ()), start, |node| node == goal, Rules::default(), &mut ())
}

/// A* with the Euclidean distance and first-opened ties.
fn astar(grid: &Grid2, moves: &Moves, ends: [u32; 2]) -> Report<Octile> {
    let estimate = Combined { h: euclidean_to(grid, ends[1]), combine: sum };
    solve(&mut Search::new(Heap::new(Ties::Fifo)), &mut GridGraph::new(moves), &estimate, ends)
}

/// A random map and two of its free cells.
struct Case {
    seed: u64,
    rule: CornerRule,
    grid: Grid2,
    moves: Moves,
    ends: [u32; 2],
}

fn cases(count: u64, blocked_share: f64) -> impl Iterator<Item = Case> {
    (0..count).map(move |seed| {
        let mut stream = seed::stream(seed);
        let size_cells = [stream.random_range(2..24), stream.random_range(2..24)];
        let ends = [0, 1].map(|_| stream.random_range(0..size_cells[0] * size_cells[1]));
        let grid = independent_cells(&mut stream, size_cells, blocked_share, &ends).unwrap();
        let rule = RULES[seed as usize % 3];
        Case { seed, rule, moves: Moves::new(&grid, rule), grid, ends }
    })
}

/// Costs from `start` by relaxing every legal move until nothing changes: no frontier, no masks.
fn relaxed_costs(grid: &Grid2, rule: CornerRule, start: u32) -> Vec<f64> {
    let mut costs = vec![f64::INFINITY; grid.cell_count() as usize];
    costs[start as usize] = 0.0;
    loop {
        let mut changed = false;
        for cell in (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)) {
            let [x, y] = grid.xy(cell);
            for [dx, dy] in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [dx, dy])) {
                let Some(to) = grid.cell(x + dx, y + dy).filter(|&to| to != cell && grid.is_free(to)) else {
                    continue;
                };
                let blocked_flanks =
                    u8::from(!grid.is_free_xy(x + dx, y)) + u8::from(!grid.is_free_xy(x, y + dy));
                let limit = match rule {
                    CornerRule::Allow => 2,
                    CornerRule::ForbidBoth => 1,
                    CornerRule::ForbidAny => 0,
                };
                if dx != 0 && dy != 0 && blocked_flanks > limit {
                    continue;
                }
                let reached = costs[cell as usize] + f64::from(dx * dx + dy * dy).sqrt();
                if reached < costs[to as usize] - 1e-9 {
                    costs[to as usize] = reached;
                    changed = true;
                }
            }
        }
        if !changed {
            return costs;
        }
    }
}

/// Asserts that `route` walks legal moves between the ends and costs what they cost, which is returned.
fn walked(case: &Case, route: &Route<Octile>) -> f64 {
    assert_eq!([route.nodes[0], route.nodes[route.nodes.len() - 1]], case.ends, "seed {}", case.seed);
    let mut cost = Octile::ZERO;
    for pair in route.nodes.windows(2) {
        let step = case.moves.from_cell(pair[0]).find(|&(to, _)| to == pair[1]);
        let (_, diagonal) = step.unwrap_or_else(|| panic!("seed {}: {pair:?} is no move", case.seed));
        cost = cost.plus(if diagonal { Octile::DIAGONAL } else { Octile::STRAIGHT });
    }
    assert_eq!(cost, route.cost, "seed {}", case.seed);
    cost.value()
}
