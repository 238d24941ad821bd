//! The planar arm from outside: planners against the verifier, whose kinematics, distances and search are its own.

use crate::shapes::{HOPS, Placed, body, hops_of, obstacle, shaped};
use base::grid::CornerRule;
use base::seed;
use base::settings::Settings;
use engine::geometry::planar::Touch;
use engine::kinematics::planar_2r::{ElbowRule, Planar2r};
use engine::planner::{self, Build, Ending, Plan, Planner, Request, Value};
use engine::shorten::{TurnAngle, turn_sum_deg};
use engine::space::{ArmRules, ArmWorld, HopRule, TipLattice, World};
use rand::RngExt as _;
use std::collections::BTreeSet;
use verify::arm::{Answer, Case};

/// A workspace with a query, and the obstacles in it.
struct Posed {
    name: String,
    world: World,
    solids: Vec<Placed>,
    ends: [Vec<f64>; 2],
}

/// Workspaces on a lattice of 2 cm with random discs, squares, hexagons and triangles; both elbow rules, both hop rules, all corner rules.
fn sample(count: u64) -> Vec<Posed> {
    let pose = |number: u64| {
        let mut stream = seed::stream(seed::derive(2, &["arm", &number.to_string()]));
        let rules = ArmRules {
            arm: Planar2r::new(30.0, 20.0).unwrap(),
            elbow: [ElbowRule::NegativeQ2, ElbowRule::HigherElbow][(number / 2 % 2) as usize],
            lattice: TipLattice::new([-50.0, 50.0], [0.0, 50.0], 2.0).unwrap(),
            inner_radius_cm: 14.0,
            q2_limit_rad: f64::INFINITY,
            touch: Touch::Contact,
            corner_rule: [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny]
                [(number % 3) as usize],
            hop: HOPS[(number % 8) as usize],
        };
        let places: Vec<[f64; 2]> = (0..stream.random_range(2..6))
            .map(|_| {
                let angle = stream.random_range(0.0..std::f64::consts::PI);
                let radius = stream.random_range(20.0..48.0);
                [(radius * libm::cos(angle)).round(), (radius * libm::sin(angle)).round()]
            })
            .collect();
        let solids = shaped(number, places);
        let world = ArmWorld::new(rules, solids.iter().map(obstacle).collect());
        let free: Vec<u32> =
            (0..world.grid().cell_count()).filter(|&cell| world.grid().is_free(cell)).collect();
        let ends = [0, 1].map(|_| {
            let at: [f64; 2] = rules.lattice.point(free[stream.random_range(0..free.len())]).into();
            at.to_vec()
        });
        Posed {
            name: format!("workspace {number}, {solids:?}, {ends:?}"),
            world: World::Arm(world),
            solids,
            ends,
        }
    };
    (0..count).map(pose).collect()
}

impl Posed {
    fn plan(&self, planner: &dyn Planner, seed: u64) -> Plan {
        let [start, goal] = &self.ends;
        let request = Request { world: &self.world, start, goal, expansions: 100_000, seed, trace: false };
        planner.plan(&request).unwrap_or_else(|invalid| panic!("{}: {invalid}", self.name))
    }

    fn case(&self) -> Case<'_> {
        let rules = self.world.as_arm().unwrap().rules();
        Case {
            links_cm: [30.0, 20.0],
            higher_elbow: rules.elbow == ElbowRule::HigherElbow,
            low_cm: [-50.0, 0.0],
            step_cm: 2.0,
            size: [51, 26],
            inner_radius_cm: 14.0,
            touching_is_contact: true,
            corner_rule: rules.corner_rule,
            q2_limit_rad: rules.q2_limit_rad,
            hops: hops_of(rules.hop),
            bodies: self.solids.iter().map(body).collect(),
            start: &self.ends[0],
            goal: &self.ends[1],
        }
    }
}

fn build(name: &str, settings: &str) -> Result<Box<dyn Planner>, String> {
    let Build::Planner(build) = planner::find(name).unwrap().build else { panic!("`{name}` plans") };
    build(&Settings::composed("a test", toml::from_str(settings).unwrap())).map_err(|e| e.to_string())
}

fn lattice(shape: &str, radius: u8) -> Box<dyn Planner> {
    let region = format!("{{ shape = '{shape}', radius_cells = {radius} }}");
    build("lattice_astar", &format!("neighbourhood = {region}\nopen_node = 'lowered'\nties = 'fifo'"))
        .unwrap()
}

/// A* with a square of this radius and these further settings.
fn squares(radius: u8, more: &str) -> Box<dyn Planner> {
    let region = format!("{{ shape = 'square', radius_cells = {radius} }}");
    build("lattice_astar", &format!("neighbourhood = {region}\nopen_node = 'lowered'\n{more}")).unwrap()
}

fn chaos(changes: &str) -> Result<Box<dyn Planner>, String> {
    let plain = "region_shape = 'square'\nregion_radius_cells = 2\nneighbours = 12\ndrawn = 'each_expansion'\n\
        source = 'uniform'\ngoal_in_region = 'included'\nopen_node = 'lowered'\nties = 'fifo'";
    let mut table: toml::Table = toml::from_str(plain).unwrap();
    table.extend(toml::from_str::<toml::Table>(changes).unwrap());
    build("chaos_astar", &toml::to_string(&table).unwrap())
}

fn answer<'a>(plan: &'a Plan, planner: &'a dyn Planner) -> Answer<'a> {
    Answer { path: &plan.path, cost: plan.cost, steps: planner.steps(), optimal: planner.is_optimal() }
}

#[test]
fn lattice_astar_costs_what_the_verifier_finds_and_says_no_path_where_there_is_none() {
    let mut solved = 0;
    let mut shut = 0;
    let mut jumped = 0;
    for posed in sample(40) {
        for planner in [lattice("square", 1), lattice("square", 2), lattice("disc", 3), lattice("octagon", 2)]
        {
            let plan = posed.plan(planner.as_ref(), 0);
            let case = posed.case();
            match plan.ending {
                Ending::Solved => {
                    let audit = case.audit(&answer(&plan, planner.as_ref()));
                    let audit = audit.unwrap_or_else(|refusal| panic!("{}: {refusal}", posed.name));
                    assert!(audit.optimal_cm.is_some(), "{}", posed.name);
                    solved += 1;
                    jumped += u32::from(audit.unsafe_hops > 0);
                }
                Ending::NoPath => {
                    let refusal = case.refuse_no_path(planner.steps().unwrap());
                    assert_eq!(refusal, None, "{}", posed.name);
                    shut += 1;
                }
                other => panic!("{}: {other:?}, and the budget is ample", posed.name),
            }
        }
    }
    assert!(solved > 60 && shut > 4 && jumped > 4, "one-sided sample: {solved} {shut} {jumped}");
}

#[test]
fn chaos_astar_never_beats_its_whole_region_and_depends_on_its_seed_alone() {
    let mut longer = 0;
    let mut solved = 0;
    let mut lost = 0;
    let planner = chaos("").unwrap();
    let whole = lattice("square", 2);
    for posed in sample(12) {
        let truth = posed.plan(whole.as_ref(), 0);
        for seed in 0..4 {
            let plan = posed.plan(planner.as_ref(), seed);
            assert_eq!(plan, posed.plan(planner.as_ref(), seed), "{}, seed {seed}", posed.name);
            let (Some(cost), Some(least)) = (plan.cost, truth.cost) else {
                assert!(plan.cost.is_none(), "{}, seed {seed}: a path where there is none", posed.name);
                lost += u32::from(truth.cost.is_some());
                continue;
            };
            posed.case().audit(&answer(&plan, planner.as_ref())).unwrap();
            assert!(cost >= least - 1e-9, "{}, seed {seed}: {cost} beats {least}", posed.name);
            (solved, longer) = (solved + 1, longer + u32::from(cost > least + 1e-9));
        }
    }
    assert!(solved > 20 && longer > 5, "{solved} solved, {longer} longer, {lost} lost");
}

#[test]
fn with_all_points_drawn_chaos_astar_is_astar() {
    let whole = lattice("square", 2);
    for changes in ["neighbours = 24", "neighbours = 24\ndrawn = 'once_per_run'\nsource = 'logistic'"] {
        let planner = chaos(changes).unwrap();
        for posed in sample(8) {
            let (one, other) = (posed.plan(planner.as_ref(), 3), posed.plan(whole.as_ref(), 0));
            assert_eq!((one.path, one.counts), (other.path, other.counts), "{}", posed.name);
        }
    }
}

#[test]
fn a_subset_has_its_size_and_every_point_of_the_region_is_drawn_sometime() {
    let posed = &sample(1)[0];
    for changes in ["source = 'uniform'", "source = 'logistic'", "drawn = 'once_per_run'"] {
        let planner = chaos(changes).unwrap();
        let mut seen = BTreeSet::new();
        for seed in 0..60 {
            let [start, goal] = &posed.ends;
            let request = Request { world: &posed.world, start, goal, expansions: 1, seed, trace: true };
            let plan = planner.plan(&request).unwrap();
            let drawn = plan.traces.iter().find(|trace| trace.name == "drawn").unwrap();
            let steps: BTreeSet<[i32; 2]> =
                drawn.values.chunks(2).map(|step| [step[0] as i32, step[1] as i32]).collect();
            assert_eq!(steps.len(), 12, "seed {seed}, {changes}");
            assert!(steps.iter().all(|step| planner.steps().unwrap().contains(step)));
            let generated = plan.counts["generated"];
            assert!(generated.as_f64() <= 12.0, "seed {seed}: {generated:?} of 12");
            seen.extend(steps);
        }
        assert_eq!(seen.len(), 24, "{changes}");
    }
}

#[test]
fn a_subset_larger_than_its_region_is_refused_with_what_is_accepted() {
    for (changes, expected) in [
        ("neighbours = 25", "neighbours is 25; 1 to 24, all points of the region, is accepted"),
        ("neighbours = 0", "neighbours is 0; 1 to 24"),
        ("region_shape = 'octagon'\nneighbours = 13", "neighbours is 13; 1 to 12"),
        ("region_radius_cells = 0", "`region_radius_cells` is 0; a whole number from 1 to 20 is accepted"),
    ] {
        let refused = chaos(changes).err().unwrap();
        assert!(refused.contains(expected), "{changes}: {refused}");
    }
}

#[test]
fn a_plan_that_is_tampered_with_is_refused() {
    let planner = lattice("square", 1);
    let mut tampered = 0;
    for posed in sample(30) {
        let plan = posed.plan(planner.as_ref(), 0);
        if plan.path.len() < 6 {
            continue;
        }
        let refuse = |change: &dyn Fn(&mut Plan)| {
            let mut changed = plan.clone();
            change(&mut changed);
            let refusal = posed.case().audit(&answer(&changed, planner.as_ref())).err();
            assert!(refusal.is_some(), "{}: {:?}", posed.name, changed.path);
        };
        refuse(&|plan| plan.cost = plan.cost.map(|cost| cost * 0.999));
        refuse(&|plan| plan.cost = plan.cost.map(|cost| cost * 1.001));
        refuse(&|plan| plan.cost = None);
        refuse(&|plan| drop(plan.path.pop()));
        refuse(&|plan| drop(plan.path.remove(0)));
        refuse(&|plan| drop(plan.path.remove(2)));
        refuse(&|plan| plan.path[2] = posed.solids[0].1.to_vec());
        refuse(&|plan| plan.path[2][0] += 0.5);
        refuse(&|plan| plan.path.insert(2, plan.path[2].clone()));
        tampered += 1;
    }
    assert!(tampered > 10, "only {tampered} plans were long enough");
}

#[test]
fn what_plain_lists_would_compare_is_what_counting_by_hand_gives() {
    // One row of three free points: the arm's tip goes two hops, nothing else is in reach.
    let rules = ArmRules {
        arm: Planar2r::new(30.0, 20.0).unwrap(),
        elbow: ElbowRule::NegativeQ2,
        lattice: TipLattice::new([30.0, 32.0], [10.0, 11.0], 1.0).unwrap(),
        inner_radius_cm: 0.0,
        q2_limit_rad: f64::INFINITY,
        touch: Touch::Contact,
        corner_rule: CornerRule::Allow,
        hop: HopRule::EndPoints,
    };
    let world = World::Arm(ArmWorld::new(rules, Vec::new()));
    let request = Request {
        world: &world,
        start: &[30.0, 10.0],
        goal: &[31.0, 10.0],
        expansions: 9,
        seed: 0,
        trace: false,
    };
    let plan = lattice("square", 1).plan(&request).unwrap();
    // The start is taken among 1; its 3 neighbours are looked up in 1 closed and 0, 1, 2 open nodes; then the goal is
    // the best of 3, which ends the search before it is taken.
    let count = |column: &str| plan.counts[column];
    assert_eq!(count("minimum_comparisons"), Value::Count(1));
    assert_eq!(count("membership_comparisons"), Value::Count(1 + 2 + 3));
    assert_eq!(count("list_operations"), Value::Count(7));
}

#[test]
fn a_heuristic_above_a_step_s_length_may_lengthen_paths_and_promises_nothing() {
    let longer = |radius: u8, heuristic: &str| {
        let planner = squares(radius, &format!("heuristic = '{heuristic}'"));
        let plain = squares(radius, "");
        let mut solved = 0;
        let mut longer = 0;
        for posed in sample(60) {
            let plan = posed.plan(planner.as_ref(), 0);
            let truth = posed.plan(plain.as_ref(), 0);
            assert_eq!(plan.cost.is_some(), truth.cost.is_some(), "{}", posed.name);
            let (Some(cost), Some(least)) = (plan.cost, truth.cost) else { continue };
            assert!(cost >= least - 1e-9, "{}: {cost} below {least}", posed.name);
            let audit = posed.case().audit(&answer(&plan, planner.as_ref()));
            audit.unwrap_or_else(|refusal| panic!("{}: {refusal}", posed.name));
            (solved, longer) = (solved + 1, longer + u32::from(cost > least + 1e-9));
        }
        assert!(solved > 20, "{solved} solved");
        (planner.is_optimal(), longer)
    };
    assert_eq!([longer(1, "euclidean"), longer(1, "octile"), longer(3, "euclidean")], [(true, 0); 3]);
    let promising_nothing = [longer(3, "octile"), longer(1, "manhattan"), longer(3, "manhattan")];
    assert!(promising_nothing.iter().all(|(is_optimal, _)| !is_optimal));
    assert!(promising_nothing.iter().any(|(_, longer)| *longer > 0), "{promising_nothing:?}");
}

#[test]
fn straight_ties_keep_the_length_and_turn_less() {
    let [straight, fifo] = ["straight", "fifo"].map(|ties| squares(1, &format!("ties = '{ties}'")));
    let turns = |plan: &Plan| turn_sum_deg(&plan.path, TurnAngle::Exterior);
    let mut less = 0;
    let mut more = 0;
    let mut sums = [0.0, 0.0];
    for posed in sample(60) {
        let [one, other] = [&straight, &fifo].map(|planner| posed.plan(planner.as_ref(), 0));
        let (Some(cost), Some(least)) = (one.cost, other.cost) else { continue };
        assert!((cost - least).abs() < 1e-9, "{}: {cost} and {least}", posed.name);
        let turned = [turns(&one), turns(&other)];
        (less, more) = (less + u32::from(turned[0] < turned[1]), more + u32::from(turned[0] > turned[1]));
        sums = [sums[0] + turned[0], sums[1] + turned[1]];
    }
    assert!(less > 10 && more * 4 < less && sums[0] < 0.7 * sums[1], "{less} less, {more} more, {sums:?}");
}

#[test]
fn the_rim_of_a_free_square_stands_for_all_of_it_and_paths_end_at_the_goal_all_the_same() {
    let [rim, all] = ["outer_where_free", "all"].map(|sets| squares(2, &format!("sets = '{sets}'")));
    assert!(!rim.is_optimal() && !rim.is_complete() && all.is_optimal());
    let mut solved = 0;
    let mut fewer = 0;
    let mut inner = 0;
    for posed in sample(60) {
        let [plan, truth] = [&rim, &all].map(|planner| posed.plan(planner.as_ref(), 0));
        let (Some(cost), Some(least)) = (plan.cost, truth.cost) else { continue };
        assert!(cost >= least - 1e-9, "{}: {cost} below {least}", posed.name);
        let audit = posed.case().audit(&answer(&plan, rim.as_ref()));
        audit.unwrap_or_else(|refusal| panic!("{}: {refusal}", posed.name));
        solved += 1;
        fewer += u32::from(plan.counts["generated"] != truth.counts["generated"]);
        // Before the last hop, a hop shorter than the rim starts where something is near.
        let grid = posed.world.as_arm().unwrap().grid();
        let cell = |at: &[f64]| [0, 1].map(|axis| ((at[axis] - [-50.0, 0.0][axis]) / 2.0).round() as i32);
        for hop in plan.path.windows(2).rev().skip(1) {
            let ([x, y], to) = (cell(&hop[0]), cell(&hop[1]));
            if (to[0] - x).abs().max((to[1] - y).abs()) < 2 {
                let is_free = (-2..=2).all(|dx| (-2..=2).all(|dy| grid.is_free_xy(x + dx, y + dy)));
                assert!(!is_free, "{}: a short hop from ({x}, {y})", posed.name);
                inner += 1;
            }
        }
    }
    assert!(solved > 20 && fewer > 5 && inner > 5, "{solved} solved, {fewer} otherwise, {inner} short hops");
}
