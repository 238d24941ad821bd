//! Lattices of square cells, some with the goal walled off.

use super::{Case, Posed, Subject, Truth};
use base::grid::{CornerRule, Grid2, independent_cells};
use base::seed;
use engine::planner::Plan;
use engine::space::{LatticeWorld, World};
use rand::RngExt as _;
use std::collections::BTreeSet;
use verify::lattice::{Answer, Case as Query, CornerCase, Least};

/// A map, and two cells that are free.
fn drawn(number: u64) -> (Grid2, [[u32; 2]; 2]) {
    let mut stream = seed::stream(seed::derive(1968, &["conformance", &number.to_string()]));
    let size = [stream.random_range(3..16), stream.random_range(3..16)];
    let ends: [[u32; 2]; 2] =
        [0, 1].map(|_| [stream.random_range(0..size[0]), stream.random_range(0..size[1])]);
    let keep = ends.map(|[x, y]| y * size[0] + x);
    let share = stream.random_range(0.1..0.55);
    let mut grid = independent_cells(&mut stream, size, share, &keep).unwrap();
    if number % 10 == 9 && ends[0] != ends[1] {
        wall_off(&mut grid, ends[1], keep[0]);
    }
    (grid, ends)
}

pub fn lattice(number: u64) -> Case {
    let rule = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny][(number % 3) as usize];
    let (grid, ends) = drawn(number);
    let size = [grid.width(), grid.height()];
    let [start, goal] = ends.map(|cell| cell.map(f64::from).to_vec());
    let optimum = Query { grid: &grid, corner_rule: rule, start: &start, goal: &goal }.optimal_cost(None);
    let name = format!("lattice {number}, {size:?} under {rule:?}, {start:?} to {goal:?}");
    let world = World::Lattice(LatticeWorld::new(grid, rule));
    Case { name, world, start, goal, posed: Posed::Lattice(optimum) }
}

/// From the lower left corner of one free cell to the upper right one of another.
pub fn corners(number: u64) -> Case {
    let (mut grid, [start, goal]) = drawn(number);
    if number % 10 == 9 {
        // Corners of a cell are shared with its neighbours: only rings of blocked cells close.
        wall_off(&mut grid, goal, u32::MAX);
    }
    let size = [grid.width(), grid.height()];
    let [start, goal] = [start, goal.map(|at| at + 1)].map(|corner| corner.map(f64::from).to_vec());
    let least = CornerCase::new(&grid, [&start, &goal]).least();
    let name = format!("corners {number}, {size:?}, {start:?} to {goal:?}");
    let world = World::Lattice(LatticeWorld::of_corners(grid));
    Case { name, world, start, goal, posed: Posed::Corners(least) }
}

/// What is true between corners: of a planner for them alone, which may go at any angle, that no path is shorter than the shortest.
pub fn truth_at_corners(least: Option<Least>, subject: &Subject) -> Truth {
    let optimum = least.map(|least| least.shortest);
    Truth { optimum, is_exact: subject.planner.is_complete(), reachable: None }
}

/// Why the verifier refuses `plan`'s path between corners.
pub fn refusal_at_corners(
    case: &Case,
    least: Option<Least>,
    plan: &Plan,
    [in_graph, optimal]: [bool; 2],
) -> Option<String> {
    let query = CornerCase::new(world(case).cells(), [&case.start, &case.goal]);
    let answer = Answer { path: &plan.path, cost: plan.cost, in_graph, optimal, sight_corners: None };
    query.refuse_path(&answer, least)
}

/// Blocks every cell around `goal` but `start`.
fn wall_off(grid: &mut Grid2, [x, y]: [u32; 2], start: u32) {
    for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
        if let Some(cell) = grid.cell(x as i32 + dx, y as i32 + dy)
            && (dx, dy) != (0, 0)
            && cell != start
        {
            grid.set_blocked(cell, true);
        }
    }
}

fn world(case: &Case) -> &LatticeWorld {
    case.world.as_lattice().expect("the sample holds lattices only")
}

/// What is true in the eight-connected graph that every planner of this kind searches.
pub fn truth(case: &Case, optimum: Option<f64>, subject: &Subject) -> Truth {
    // Of those that search from both ends or by jump points, no search takes every cell.
    let takes_all = !["bidirectional", "jps", "jps_plus"].contains(&subject.entry.name)
        && !subject.settings.table().contains_key("branching");
    Truth {
        optimum,
        is_exact: subject.planner.is_complete(),
        reachable: takes_all.then(|| reachable(world(case), &case.start)),
    }
}

/// How many nodes can be reached from the start, and how many moves leave them in all: counted cell by cell.
fn reachable(world: &LatticeWorld, start: &[f64]) -> (u64, u64) {
    let grid = world.grid();
    let rule = world.corner_rule();
    let mut seen = BTreeSet::new();
    let mut todo = vec![[start[0] as i32, start[1] as i32]];
    let mut moves = 0;
    while let Some([x, y]) = todo.pop() {
        if !seen.insert([x, y]) {
            continue;
        }
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let flanks = [grid.is_free_xy(x + dx, y), grid.is_free_xy(x, y + dy)];
            let fits = match rule {
                CornerRule::Allow => true,
                CornerRule::ForbidBoth => flanks[0] || flanks[1],
                CornerRule::ForbidAny => flanks[0] && flanks[1],
            };
            let is_legal = (dx, dy) != (0, 0) && grid.is_free_xy(x + dx, y + dy);
            if is_legal && (dx == 0 || dy == 0 || fits) {
                moves += 1;
                todo.push([x + dx, y + dy]);
            }
        }
    }
    (seen.len() as u64, moves)
}

/// Why the verifier refuses `plan`'s path.
pub fn refusal(
    case: &Case,
    optimum: Option<f64>,
    plan: &Plan,
    [in_graph, optimal]: [bool; 2],
) -> Option<String> {
    let grid = world(case).grid();
    let corner_rule = world(case).corner_rule();
    let query = Query { grid, corner_rule, start: &case.start, goal: &case.goal };
    let answer = Answer { path: &plan.path, cost: plan.cost, in_graph, optimal, sight_corners: None };
    query.refuse_path(&answer, optimum)
}

/// In an obstacle, outside, between cells, of another dimension.
pub fn impossible(case: &Case) -> Vec<Vec<f64>> {
    let grid = world(case).grid();
    let blocked = (0..grid.cell_count()).find(|cell| !grid.is_free(*cell));
    let mut points = vec![vec![-1.0, 0.0], vec![f64::from(grid.width()), 0.0], vec![0.5, 0.0], vec![0.0]];
    points.extend(blocked.map(|cell| grid.xy(cell).map(f64::from).to_vec()));
    points
}
