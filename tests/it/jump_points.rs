//! The planners by jump points before the verifier, on maps wider than a word of 64 bits.

use base::grid::{
    CornerRule, Grid2, independent_cells, maze, read_movingai_map, read_scenarios, rooms, streets,
};
use base::seed;
use base::settings::Settings;
use engine::planner::{self, Build, Ending, Planner, Request};
use engine::space::{LatticeWorld, World};
use rand::RngExt as _;
use std::path::Path;
use verify::lattice::{Answer, Case};

fn built(name: &str, settings: &str) -> Box<dyn Planner> {
    let Build::Planner(build) = planner::find(name).unwrap().build else { panic!("{name} plans") };
    build(&Settings::composed(name, toml::from_str(settings).unwrap())).unwrap()
}

fn planners() -> [Box<dyn Planner>; 2] {
    [built("jps", ""), built("jps_plus", "")]
}

/// Whether there is a path, held against the verifier's own search.
fn is_solved(planner: &dyn Planner, world: &World, [start, goal]: [u32; 2], what: &str) -> bool {
    let lattice = world.as_lattice().unwrap();
    let [start, goal] = [start, goal].map(|cell| lattice.grid().xy(cell).map(f64::from).to_vec());
    let request = Request { world, start: &start, goal: &goal, expansions: 1_000_000, seed: 0, trace: false };
    let plan = planner.plan(&request).unwrap();
    let case = Case { grid: lattice.grid(), corner_rule: lattice.corner_rule(), start: &start, goal: &goal };
    let optimum = case.optimal_cost(None);
    let refusal = match plan.ending {
        Ending::Solved => {
            let path = &plan.path[..];
            let cost = plan.cost;
            let answer = Answer { path, cost, in_graph: true, optimal: true, sight_corners: None };
            case.refuse_path(&answer, optimum)
        }
        Ending::NoPath => case.refuse_no_path(optimum),
        other => Some(format!("it ended as {other:?}")),
    };
    assert_eq!(refusal, None, "{what}, {:?}: {start:?} to {goal:?}", lattice.corner_rule());
    plan.ending == Ending::Solved
}

#[test]
fn the_verifier_accepts_every_answer_of_the_planners_by_jump_points() {
    let mut solved = 0;
    let mut unsolved = 0;
    for seed in 0..24 {
        let mut stream = seed::stream(seed);
        let size = [150, 90];
        let grid: Grid2 = match seed / 3 % 4 {
            0 => independent_cells(&mut stream, size, 0.35, &[]),
            1 => rooms(&mut stream, size, 14, 0.5),
            2 => streets(&mut stream, size, [5, 20], 3, 2),
            _ => maze(&mut stream, size),
        }
        .unwrap();
        let rule = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny][seed as usize % 3];
        let free: Vec<u32> = (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)).collect();
        let world = World::Lattice(LatticeWorld::new(grid, rule));
        for planner in planners() {
            for _ in 0..10 {
                let ends = [0, 1].map(|_| free[stream.random_range(0..free.len())]);
                let found = is_solved(planner.as_ref(), &world, ends, &format!("seed {seed}"));
                (solved, unsolved) = (solved + u32::from(found), unsolved + u32::from(!found));
            }
        }
    }
    assert!(solved > 200 && unsolved > 20, "one-sided sample: {solved} solved, {unsolved} not");
}

#[test]
fn the_verifier_accepts_their_paths_on_the_benchmark_sample() {
    let maps = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/maps");
    let grid = read_movingai_map(&maps.join("movingai_sample.map")).unwrap();
    let queries = read_scenarios(&maps.join("movingai_sample.scen"), &grid).unwrap();
    let world = World::Lattice(LatticeWorld::new(grid, CornerRule::ForbidAny));
    for planner in planners() {
        for query in &queries {
            let what = format!("line {}", query.line);
            assert!(is_solved(planner.as_ref(), &world, [query.start, query.goal], &what), "{what}");
        }
    }
}

#[test]
fn the_memory_that_was_prepared_is_a_count_and_an_unknown_setting_is_refused() {
    let world = World::Lattice(LatticeWorld::new(Grid2::new(512, 512).unwrap(), CornerRule::ForbidAny));
    let bytes = |name: &str| {
        let (start, goal) = (&[0.0, 0.0], &[511.0, 0.0]);
        let request = Request { world: &world, start, goal, expansions: 10, seed: 0, trace: false };
        built(name, "preparation = 'each_query'").plan(&request).unwrap().counts["preprocessing_bytes"]
            .as_f64()
    };
    // Four times 512 lines of 514 bits, each with walls beside it; and eight numbers of two bytes a cell.
    assert_eq!([bytes("jps"), bytes("jps_plus")], [4.0 * 512.0 * 9.0 * 16.0, 512.0 * 512.0 * 16.0]);
    let Build::Planner(build) = planner::find("jps").unwrap().build else { panic!("it plans") };
    let wrong = Settings::composed("a test", toml::from_str("preparation = 'never'").unwrap());
    let message = build(&wrong).err().unwrap().to_string();
    assert!(message.contains("\"never\"") && message.contains("\"each_query\""), "{message}");
}
