//! Lattices whose vertices are corners of cells: planners of both kinds of lattice, and the laws of their lengths.

use crate::worlds::{Case, worlds};
use base::grid::{Grid2, corners_see, parse_text_map};
use base::settings::Settings;
use engine::planner::{self, Build, Ending, Plan, Planner, Request, Stage};
use engine::space::{LatticeWorld, World, WorldKind};
use verify::lattice::{Answer, CornerCase};

/// The settings of Field D* beside its ties.
const FIELD: &str = "interpolates = 'opened'\nextraction = 'looks_ahead'";

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
    posed(&case.world, [&case.start, &case.goal])
}

fn posed<'a>(world: &'a World, [start, goal]: [&'a [f64]; 2]) -> Request<'a> {
    Request { world, start, goal, expansions: 100_000, seed: 1, trace: false }
}

/// Why the verifier refuses the plan.
fn refusal(case: &Case, plan: &Plan, holds: [bool; 2]) -> Option<String> {
    refusal_of(&request(case), plan, holds)
}

fn refusal_of(request: &Request<'_>, plan: &Plan, [in_graph, optimal]: [bool; 2]) -> Option<String> {
    let cells = request.world.as_lattice().unwrap().cells();
    let query = CornerCase::new(cells, [request.start, request.goal]);
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
        planner("field_dstar", &format!("{ties}\n{FIELD}")),
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
        planner("field_dstar", &format!("ties = 'larger_g'\n{FIELD}")),
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

/// The map and the ends of a case mirrored at a vertical line, at the diagonal, and with start and goal swapped.
fn views(case: &Case) -> [(&'static str, World, [Vec<f64>; 2]); 3] {
    let cells = case.world.as_lattice().unwrap().cells();
    let [width, height] = [cells.width(), cells.height()];
    let turned = |size: [u32; 2], to: &dyn Fn([u32; 2]) -> [u32; 2]| {
        let mut grid = Grid2::new(size[0], size[1]).unwrap();
        for cell in 0..cells.cell_count() {
            let [x, y] = to([cell % width, cell / width]);
            grid.set_blocked(y * size[0] + x, !cells.is_free(cell));
        }
        World::Lattice(LatticeWorld::of_corners(grid))
    };
    let ends = [&case.start, &case.goal];
    let flipped = ends.map(|at| vec![f64::from(width) - at[0], at[1]]);
    let exchanged = ends.map(|at| vec![at[1], at[0]]);
    [
        ("mirrored", turned([width, height], &|[x, y]| [width - 1 - x, y]), flipped),
        ("exchanged", turned([height, width], &|[x, y]| [y, x]), exchanged),
        ("swapped", turned([width, height], &|at| at), [case.goal.clone(), case.start.clone()]),
    ]
}

/// The exact planner finds paths of one length. The others break ties by the order of neighbours, which is not mirrored, and search
/// from the start: their lengths are the same on 95 % of mirrored maps, on 80 % of swapped ones, and within 5 % on all.
#[test]
fn a_mirrored_exchanged_or_swapped_query_has_a_path_as_short_or_nearly() {
    let sight = "line_of_sight = 'exact_interior'\nties = 'smaller_g'";
    let all = [
        ("visibility_astar", "ties = 'larger_g'\nvertices = 'all'", 0.0, [1.0; 3]),
        ("theta_star", sight, 0.05, [0.95, 0.95, 0.8]),
        ("lazy_theta_star", sight, 0.05, [0.95, 0.95, 0.8]),
        ("ap_theta_star", "ties = 'smaller_g'", 0.05, [0.95, 0.95, 0.8]),
        ("field_dstar", &format!("ties = 'larger_g'\n{FIELD}"), 0.05, [0.95, 0.95, 0.8]),
        ("astar", "ties = 'larger_g'", 0.0, [1.0; 3]),
    ];
    for (name, text, most, shares) in all {
        let planner = planner(name, text);
        let (mut same, mut solved) = ([0.0; 3], 0.0);
        for case in worlds(WorldKind::CornerLattice).iter().take(100) {
            let there = planner.plan(&request(case)).unwrap();
            for (count, (view, world, [start, goal])) in same.iter_mut().zip(&views(case)) {
                let what = format!("{name} on {}, {view}", case.name);
                let request = posed(world, [start, goal]);
                let back = planner.plan(&request).unwrap();
                assert_eq!(refusal_of(&request, &back, [false; 2]), None, "{what}");
                let apart = there.cost.zip(back.cost).map(|(a, b)| (a - b).abs() / a.max(1.0));
                assert_eq!(apart.is_some(), there.cost.is_some(), "{what}");
                assert!(apart.is_none_or(|apart| apart < most + 1e-9), "{what}: {apart:?}");
                *count += f64::from(u8::from(apart.is_some_and(|apart| apart < 1e-9)));
            }
            solved += f64::from(u8::from(there.cost.is_some()));
        }
        let are_same = same.iter().zip(shares).all(|(count, share)| *count >= share * solved);
        assert!(solved > 50.0 && are_same, "{name}: {same:?} of {solved} are as long");
    }
}

#[test]
fn a_line_of_sight_by_cells_is_refused_between_corners() {
    let case = &worlds(WorldKind::CornerLattice)[0];
    let invalid = planner("theta_star", "line_of_sight = 'closed_cells'").plan(&request(case)).unwrap_err();
    assert_eq!(invalid.0, "between corners of cells, line_of_sight = \"exact_interior\" is accepted");
}

/// The cases that a script of crosscheck/ writes.
fn written(file: &str) -> Vec<serde_json::Value> {
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/crosscheck").join(file);
    serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap()
}

/// The cells of the map of such a case.
fn cells_of(case: &serde_json::Value) -> Grid2 {
    let rows: Vec<&str> = case["map"].as_array().unwrap().iter().map(|row| row.as_str().unwrap()).collect();
    parse_text_map(&format!("{}\n", rows.join("\n"))).unwrap()
}

#[test]
fn planner_and_verifier_find_the_lengths_of_visibility_graphs_in_python() {
    // crosscheck/visibility_graphs.py writes them.
    let cases = written("visibility_graphs.json");
    let exact = planner("visibility_astar", "ties = 'larger_g'\nvertices = 'convex'");
    let [mut found, mut walled] = [0, 0];
    for (number, case) in cases.iter().enumerate() {
        let cells = cells_of(case);
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

#[test]
fn ap_theta_star_and_field_dstar_expand_and_find_what_plain_programs_in_python_do() {
    // crosscheck/any_angle.py writes them.
    let cases = written("any_angle.json");
    let mut all = vec![("ap_theta_star".to_owned(), planner("ap_theta_star", "ties = 'smaller_g'"))];
    for interpolates in ["opened", "expanded"] {
        for extraction in ["looks_ahead", "interpolated"] {
            let text =
                format!("ties = 'larger_g'\ninterpolates = '{interpolates}'\nextraction = '{extraction}'");
            let name = format!("field_dstar {interpolates} {extraction}");
            all.push((name, planner("field_dstar", &text)));
        }
    }
    for (name, planner) in &all {
        let [mut found, mut walled] = [0, 0];
        for (number, case) in cases.iter().enumerate() {
            let world = World::Lattice(LatticeWorld::of_corners(cells_of(case)));
            let goal = [0, 1].map(|axis: usize| case["goal"][axis].as_f64().unwrap());
            let plan = planner.plan(&posed(&world, [&[0.0; 2], &goal])).unwrap();
            let Some(truth) = case["found"][name.as_str()].as_array() else {
                assert_eq!(plan.ending, Ending::NoPath, "{name}, map {number}");
                walled += 1;
                continue;
            };
            let expansions = plan.counts["expansions"].as_f64();
            assert_eq!(Some(expansions), truth[0].as_f64(), "{name}, map {number}");
            let (cost, length) = (plan.cost.unwrap(), truth[1].as_f64().unwrap());
            assert!((cost - length).abs() < 1e-6, "{name}, map {number}: {cost} and {length}");
            found += 1;
        }
        assert!(found > 40 && walled > 2, "{name}: {found} found, {walled} walled off");
    }
}
