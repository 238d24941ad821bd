mod legs;

use super::*;
use base::grid::{CornerRule, Moves, independent_cells};
use base::seed::{Stream, derive, stream};
use base::settings::Settings;
use engine::planner::{Build, find};
use rand::RngExt as _;

fn pipeline(weight: &str) -> Pipeline {
    let Build::Planner(build) = find("astar").unwrap().build else { panic!("astar plans") };
    let text = format!("weight = {weight}\nties = 'fifo'");
    let planner = build(&Settings::composed("test", toml::from_str(&text).unwrap())).unwrap();
    Pipeline { planner, stages: Vec::new() }
}

/// A random lattice with two free ends.
fn posed(seed: u64) -> (World, Query) {
    let mut stream = stream(derive(seed, &["judge"]));
    let size = [stream.random_range(4..14_u32), stream.random_range(4..14_u32)];
    let ends: [[u32; 2]; 2] =
        [0, 1].map(|_| [stream.random_range(0..size[0]), stream.random_range(0..size[1])]);
    let keep = ends.map(|[x, y]| y * size[0] + x);
    let grid = independent_cells(&mut stream, size, 0.35, &keep).unwrap();
    let rule = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny][(seed % 3) as usize];
    let [start, goal] = ends.map(|cell| cell.map(f64::from).to_vec());
    (World::Lattice(LatticeWorld::new(grid, rule)), Query { name: String::new(), start, goal })
}

fn request<'a>(world: &'a World, query: &'a Query) -> Request<'a> {
    Request { world, start: &query.start, goal: &query.goal, expansions: 10_000, seed: 0, trace: false }
}

/// Whether `plan` is an optimal plan for `request`, by the table of legal moves and the cost `optimum`.
fn is_right(request: &Request<'_>, plan: &Plan, optimum: Option<f64>) -> bool {
    let lattice = request.world.as_lattice().unwrap();
    let (grid, moves): (_, &Moves) = (lattice.grid(), lattice.moves());
    let (Ending::Solved, Some(optimum), Some(cost)) = (plan.ending, optimum, plan.cost) else {
        return plan.ending == Ending::NoPath
            && optimum.is_none()
            && plan.path.is_empty()
            && plan.cost.is_none();
    };
    let is_cell = |p: &Vec<f64>| p.len() == 2 && p.iter().all(|x| x.fract() == 0.0);
    if !plan.path.iter().all(is_cell) {
        return false;
    }
    let cells: Vec<Option<u32>> = plan.path.iter().map(|p| grid.cell(p[0] as i32, p[1] as i32)).collect();
    let steps = cells.windows(2).map(|pair| {
        let (from, to) = (pair[0]?, pair[1]?);
        let (_, is_diagonal) = moves.from_cell(from).find(|(next, _)| *next == to)?;
        Some(if is_diagonal { std::f64::consts::SQRT_2 } else { 1.0 })
    });
    let Some(steps) = steps.collect::<Option<Vec<f64>>>() else { return false };
    let length: f64 = steps.iter().sum();
    plan.path.first().is_some_and(|p| p == request.start)
        && plan.path.last().is_some_and(|p| p == request.goal)
        && (length - cost).abs() < 1e-9
        && (length - optimum).abs() < 1e-9
}

/// How many ways of [`mutate`] there are.
const WAYS: usize = 17;

/// `plan` with one thing changed about its path, cost or ending.
fn mutate(plan: &Plan, way: usize, stream: &mut Stream) -> Plan {
    let mut plan = plan.clone();
    let at = if plan.path.is_empty() { 0 } else { stream.random_range(0..plan.path.len()) };
    let shift = [-1.0, 1.0][stream.random_range(0..2)];
    let axis = stream.random_range(0..2);
    let scale = |cost: Option<f64>, by: f64| cost.map(|cost| cost * by);
    match way {
        0 => plan.path.truncate(at),
        1 => drop(plan.path.drain(..at)),
        2 if !plan.path.is_empty() => drop(plan.path.remove(at)),
        3 if !plan.path.is_empty() => plan.path.insert(at, plan.path[at].clone()),
        4 if !plan.path.is_empty() => plan.path[at][axis] += shift,
        5 if !plan.path.is_empty() => plan.path[at][axis] += 0.5 * shift,
        6 if !plan.path.is_empty() => plan.path[at][axis] += 1000.0 * shift,
        7 if !plan.path.is_empty() => plan.path[at].truncate(1),
        8 => plan.path.reverse(),
        9 => plan.path.clear(),
        10 => plan.cost = scale(plan.cost, 1.0 + 1e-6 * shift),
        11 => plan.cost = plan.cost.map(|cost| cost + shift),
        12 => plan.cost = scale(plan.cost, f64::NAN),
        13 => plan.cost = None,
        14 => plan.ending = Ending::NoPath,
        15 => (plan.ending, plan.path, plan.cost) = (Ending::NoPath, Vec::new(), None),
        16 => (plan.ending, plan.path, plan.cost) = (Ending::BudgetSpent, Vec::new(), None),
        _ => {}
    }
    plan
}

#[test]
fn every_mutation_that_makes_a_plan_wrong_is_refused() {
    let pipeline = pipeline("1");
    let mut refused = [0; WAYS];
    let mut solved = 0;
    for seed in 0..300 {
        let (world, query) = posed(seed);
        let request = request(&world, &query);
        let truth = truth(&world, &query, &Guide::default());
        let plan = pipeline.planner.plan(&request).unwrap();
        let (status, reason) = verify(&request, &plan, &pipeline, &truth).outcome;
        assert!([Status::Solved, Status::NoPath].contains(&status), "seed {seed}: {status}, {reason:?}");
        assert!(is_right(&request, &plan, truth.optimal()), "seed {seed}: {plan:?}");
        solved += u32::from(status == Status::Solved);
        let mut stream = stream(derive(seed, &["mutation"]));
        for (way, count) in refused.iter_mut().enumerate() {
            let wrong = mutate(&plan, way, &mut stream);
            if is_right(&request, &wrong, truth.optimal()) {
                continue;
            }
            let verified = verify(&request, &wrong, &pipeline, &truth);
            assert_eq!(verified.outcome.0, Status::Rejected, "seed {seed}, way {way}: {wrong:?}\n{query:?}");
            assert!(!verified.values.contains_key("path_cost_cells"), "a refused path was measured");
            *count += 1;
        }
    }
    assert!((150..280).contains(&solved), "one-sided sample: {solved} of 300 solved");
    assert!(refused.iter().all(|count| *count > 100), "{refused:?}");
}

#[test]
fn a_path_claimed_where_there_is_none_is_refused() {
    let pipeline = pipeline("1");
    let mut claimed = 0;
    for seed in 0..300 {
        let (world, query) = posed(seed);
        let request = request(&world, &query);
        let truth = truth(&world, &query, &Guide::default());
        if truth.optimal().is_some() {
            continue;
        }
        let mut plan = pipeline.planner.plan(&request).unwrap();
        plan.ending = Ending::Solved;
        plan.path = vec![query.start.clone(), query.goal.clone()];
        plan.cost = Some(path_length(&plan.path));
        assert_eq!(verify(&request, &plan, &pipeline, &truth).outcome.0, Status::Rejected, "seed {seed}");
        claimed += 1;
    }
    assert!(claimed > 20, "{claimed}");
}

#[test]
fn a_detour_is_refused_of_an_optimal_planner_and_accepted_of_another() {
    let (optimal, greedy) = (pipeline("1"), pipeline("5"));
    let mut detours = 0;
    for seed in 0..300 {
        let (world, query) = posed(seed);
        let request = request(&world, &query);
        let truth = truth(&world, &query, &Guide::default());
        let plan = greedy.planner.plan(&request).unwrap();
        let Some((cost, least)) = plan.cost.zip(truth.optimal()) else { continue };
        if cost < least + 1e-9 {
            continue;
        }
        assert_eq!(verify(&request, &plan, &greedy, &truth).outcome.0, Status::Solved, "seed {seed}");
        assert_eq!(verify(&request, &plan, &optimal, &truth).outcome.0, Status::Rejected, "seed {seed}");
        detours += 1;
    }
    assert!(detours > 10, "{detours} detours");
}
