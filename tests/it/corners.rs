//! Lattices whose vertices are corners of cells: planners of both kinds of lattice, and the laws of their lengths.

use crate::worlds::{Case, worlds};
use base::grid::{corners_see, parse_text_map};
use base::settings::Settings;
use engine::planner::{self, Build, Ending, Plan, Planner, Request, Stage};
use engine::space::{LatticeWorld, World, WorldKind};
use verify::lattice::{Answer, CornerCase};

fn settings(text: &str) -> Settings {
    Settings::composed("a test", toml::from_str(text).unwrap())
}

fn planner(name: &str, text: &str) -> Box<dyn Planner> {
    let Build::Planner(build) = planner::find(name).unwrap().build else { panic!("{name} plans") };
    build(&settings(text)).unwrap()
}

fn smoothing(from: &str) -> Box<dyn Stage> {
    let Build::Stage(build) = planner::find("post_smooth").unwrap().build else { panic!("a stage") };
    build(&settings(&format!("line_of_sight = 'exact_interior'\nfrom = '{from}'"))).unwrap()
}

fn request(case: &Case) -> Request<'_> {
    let Case { world, start, goal, .. } = case;
    Request { world, start, goal, expansions: 100_000, seed: 1, trace: false }
}

/// Why the verifier refuses the plan.
fn refusal(case: &Case, plan: &Plan, [in_graph, optimal]: [bool; 2]) -> Option<String> {
    let cells = case.world.as_lattice().unwrap().cells();
    let query = CornerCase::new(cells, [&case.start, &case.goal]);
    let least = query.least();
    if plan.ending == Ending::NoPath {
        return query.refuse_no_path(least);
    }
    query.refuse_path(
        &Answer { path: &plan.path, cost: plan.cost, in_graph, optimal, sight_corners: None },
        least,
    )
}

#[test]
fn planners_of_cells_plan_between_corners_too() {
    let sight = "line_of_sight = 'exact_interior'";
    let all = [
        ("astar", "heuristic = 'octile'\nties = 'larger_g'".to_owned()),
        ("astar_octile", String::new()),
        (
            "bidirectional",
            "weight = 'one'\nmeeting = 'optimal_stop'\nside = 'alternate'\nties = 'fifo'".to_owned(),
        ),
        ("theta_star", format!("{sight}\nties = 'smaller_g'")),
        ("theta_star", format!("{sight}\nweight = 0.5\nreopen = true")),
        ("lazy_theta_star", sight.to_owned()),
    ];
    for (name, text) in all {
        let planner = planner(name, &text);
        let mut solved = 0;
        for case in worlds(WorldKind::CornerLattice) {
            let plan = planner.plan(&request(case)).unwrap();
            let holds = [!planner.is_any_angle(), planner.is_optimal()];
            assert_eq!(refusal(case, &plan, holds), None, "{name} on {}", case.name);
            solved += usize::from(plan.ending == Ending::Solved);
        }
        assert!((90..150).contains(&solved), "{name}: {solved} of 150 solved");
    }
}

#[test]
fn no_path_is_shorter_than_the_visibility_graphs_nor_theta_stars_longer_than_the_grids() {
    let ties = "ties = 'smaller_g'";
    let sight = "line_of_sight = 'exact_interior'";
    let all = [
        planner("visibility_astar", &format!("{ties}\nvertices = 'convex'")),
        planner("theta_star", &format!("{sight}\n{ties}")),
        planner("ap_theta_star", ties),
        planner("field_dstar", ties),
        planner("astar", ties),
    ];
    let stages = [smoothing("start"), smoothing("goal")];
    let mut longer = [0; 4];
    for case in worlds(WorldKind::CornerLattice) {
        let plans: Vec<Plan> = all.iter().map(|planner| planner.plan(&request(case)).unwrap()).collect();
        let Some(shortest) = plans[0].cost else { continue };
        let costs: Vec<f64> = plans.iter().map(|plan| plan.cost.unwrap()).collect();
        assert!(costs.iter().all(|cost| *cost > shortest - 1e-9), "{}: {costs:?}", case.name);
        assert!(costs[1] < costs[4] + 1e-9, "{}: {costs:?}", case.name);
        for (count, cost) in longer.iter_mut().zip(&costs[1..]) {
            *count += u32::from(*cost > shortest + 1e-9);
        }
        for stage in &stages {
            let smooth = stage.refine(&request(case), plans[4].clone());
            assert!(smooth.cost.unwrap() < costs[4] + 1e-9, "{}: {smooth:?}", case.name);
            assert_eq!(refusal(case, &smooth, [false; 2]), None, "{}", case.name);
        }
    }
    assert!(longer[0] > 3 && longer[1] >= longer[0] && longer[3] > 40, "{longer:?}");
}

#[test]
fn every_closed_vertex_is_traced_with_a_parent_that_sees_it() {
    let sight = "line_of_sight = 'exact_interior'\nties = 'smaller_g'";
    let all = [
        planner("theta_star", sight),
        planner("lazy_theta_star", sight),
        planner("ap_theta_star", "ties = 'smaller_g'"),
        planner("visibility_astar", "ties = 'larger_g'\nvertices = 'all'"),
        planner("field_dstar", "ties = 'larger_g'"),
        planner("astar", "ties = 'larger_g'"),
    ];
    let mut far = [0; 6];
    for case in worlds(WorldKind::CornerLattice) {
        let cells = case.world.as_lattice().unwrap().cells();
        for (count, planner) in far.iter_mut().zip(&all) {
            let plan = planner.plan(&Request { trace: true, ..request(case) }).unwrap();
            let trace = |name: &str| plan.traces.iter().find(|trace| trace.name == name).unwrap();
            let at = |row: &[f64]| [row[0] as i32, row[1] as i32];
            let closed: Vec<[i32; 2]> = trace("closings").values.chunks(5).map(at).collect();
            let parents: Vec<[i32; 2]> = trace("parents").values.chunks(2).map(at).collect();
            assert_eq!(closed.len(), parents.len(), "{}", case.name);
            for (place, (node, parent)) in closed.iter().zip(&parents).enumerate() {
                if place == 0 {
                    assert_eq!(node, parent, "{}: the start is its own parent", case.name);
                    continue;
                }
                assert!(closed[..place].contains(parent), "{}: {node:?} under {parent:?}", case.name);
                assert!(corners_see(cells, *parent, *node), "{}: {node:?} under {parent:?}", case.name);
                let apart = [0, 1].map(|axis: usize| (node[axis] - parent[axis]).abs());
                *count += u32::from(apart[0].max(apart[1]) > 1);
            }
        }
    }
    assert!(far[..4].iter().all(|count| *count > 50) && far[4..] == [0, 0], "{far:?}");
}

#[test]
fn a_mirrored_or_swapped_query_has_a_path_as_short() {
    let exact = planner("visibility_astar", "ties = 'larger_g'\nvertices = 'all'");
    let mut mirrored = 0;
    for case in worlds(WorldKind::CornerLattice).iter().take(60) {
        let cells = case.world.as_lattice().unwrap().cells();
        let width = cells.width();
        let mut flipped = cells.clone();
        for cell in 0..cells.cell_count() {
            let [x, y] = [cell % width, cell / width];
            flipped.set_blocked(y * width + width - 1 - x, !cells.is_free(cell));
        }
        let world = World::Lattice(LatticeWorld::of_corners(flipped));
        let flip = |at: &[f64]| vec![f64::from(width) - at[0], at[1]];
        let ends = [flip(&case.goal), flip(&case.start)];
        let there = exact.plan(&request(case)).unwrap();
        let back = exact.plan(&Request { world: &world, start: &ends[0], goal: &ends[1], ..request(case) });
        let back = back.unwrap();
        let same = there.cost.zip(back.cost).map(|(a, b)| (a - b).abs() < 1e-9);
        assert_eq!(same, there.cost.map(|_| true), "{}: {there:?}\n{back:?}", case.name);
        mirrored += u32::from(same.is_some());
    }
    assert!(mirrored > 30, "{mirrored}");
}

#[test]
fn a_line_of_sight_by_cells_is_refused_between_corners() {
    let case = &worlds(WorldKind::CornerLattice)[0];
    let invalid = planner("theta_star", "line_of_sight = 'closed_cells'").plan(&request(case)).unwrap_err();
    assert_eq!(invalid.0, "between corners of cells, line_of_sight = \"exact_interior\" is accepted");
}

#[test]
fn planner_and_verifier_find_the_lengths_of_visibility_graphs_in_python() {
    // crosscheck/visibility_graphs.py writes it.
    let file =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/crosscheck/visibility_graphs.json");
    let cases: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let exact = planner("visibility_astar", "ties = 'larger_g'\nvertices = 'convex'");
    let [mut found, mut walled] = [0, 0];
    for (number, case) in cases.as_array().unwrap().iter().enumerate() {
        let rows: Vec<&str> =
            case["map"].as_array().unwrap().iter().map(|row| row.as_str().unwrap()).collect();
        let cells = parse_text_map(&format!("{}\n", rows.join("\n"))).unwrap();
        let (start, goal) = ([0.0; 2], [f64::from(cells.width()), f64::from(cells.height())]);
        let least = CornerCase::new(&cells, [&start, &goal]).least().map(|least| least.shortest);
        let world = World::Lattice(LatticeWorld::of_corners(cells));
        let (start, goal) = (&start, &goal);
        let posed = Request { world: &world, start, goal, expansions: 100_000, seed: 1, trace: false };
        let cost = exact.plan(&posed).unwrap().cost;
        let truth = case["shortest"].as_f64();
        for (who, length) in [("the planner", cost), ("the verifier", least)] {
            let same = match (length, truth) {
                (Some(length), Some(truth)) => (length - truth).abs() < 1e-9,
                (length, truth) => length.is_none() && truth.is_none(),
            };
            assert!(same, "map {number}: {who} found {length:?} for {truth:?}");
        }
        *(if truth.is_some() { &mut found } else { &mut walled }) += 1;
    }
    assert!(found > 100 && walled > 10, "{found} found, {walled} walled off");
}
