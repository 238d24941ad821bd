use super::*;
use base::seed;
use base::settings::{Settings, SettingsError};
use rand::RngExt as _;
use std::collections::{BTreeMap, VecDeque};
use world::geometry::Vec2;
use world::geometry::planar::ConvexPolygon;
use world::space::World;
use world::space::roadmap::{Counted, Local, Near, PlaneMap, Sample};

const SAMPLES: u32 = 40;
const RADIUS_MM: f64 = 28.0;
const ENDS: [[f64; 2]; 2] = [[5.0, 50.0], [95.0, 52.0]];

/// A roadmap between two walls with gaps.
fn world(number: u64) -> World {
    let mut stream = seed::stream(seed::derive(number, &["roadmap_astar"]));
    let wall = |a: [f64; 2], b: [f64; 2]| ConvexPolygon::rectangle(Vec2::from(a), Vec2::from(b)).unwrap();
    let map = PlaneMap::new(
        [100.0, 100.0],
        vec![wall([30.0, 0.0], [36.0, 65.0]), wall([62.0, 40.0], [68.0, 100.0])],
    );
    let mut samples = Vec::new();
    while samples.len() < SAMPLES as usize {
        let point = [stream.random_range(0.0..100.0), stream.random_range(0.0..100.0)];
        if map.refusal(point).is_none() {
            samples.push(Sample { config: point.to_vec(), drawn_after: samples.len() as u32 });
        }
    }
    World::Roadmap(Box::new(Roadmap::build(
        Local::Plane(map),
        samples,
        Near::Places(RADIUS_MM),
        Counted::Accepted,
    )))
}

fn built(text: &str) -> Result<Box<dyn Planner>, SettingsError> {
    let Build::Planner(build) = ENTRY.build else { panic!("a planner") };
    build(&Settings::composed("test", text.parse().unwrap()))
}

fn plan(world: &World, settings: &str) -> Plan {
    let text = format!("samples = {SAMPLES}\nneighbour_mm = {RADIUS_MM}\ncost = \"hops\"\n{settings}");
    planned(world, &text)
}

fn planned(world: &World, text: &str) -> Plan {
    let planner = built(text).unwrap();
    let [start, goal] = ENDS;
    let request = Request { world, start: &start, goal: &goal, expansions: 10_000, seed: 0, trace: true };
    planner.plan(&request).unwrap()
}

fn closed(plan: &Plan) -> &[f64] {
    &plan.traces.iter().find(|trace| trace.name == "closed").unwrap().values
}

fn count(plan: &Plan, column: &str) -> u64 {
    match plan.counts[column] {
        Value::Count(count) => count,
        Value::Real(_) => panic!("{column} is a count"),
    }
}

const NEVER: &str = "goal_shot = \"never\"\npath = \"parents\"";
const SHOTS: &str = "goal_shot = \"before_expansion\"\npath = \"parents\"";

#[test]
fn until_a_shot_succeeds_both_algorithms_search_alike() {
    let mut shorter = 0;
    let mut only_shots = 0;
    for number in 0..100 {
        let world = world(number);
        let never = plan(&world, NEVER);
        let shots = plan(&world, SHOTS);
        let all = closed(&never);
        let first = closed(&shots);
        let shared = first.len().min(all.len());
        assert_eq!(first[..shared], all[..shared], "roadmap {number}");
        let is_found = |plan: &Plan| plan.ending == Ending::Solved;
        assert!(is_found(&shots) || !is_found(&never), "roadmap {number}: only the original finds a path");
        assert!(first.len() <= all.len(), "roadmap {number}: shots search longer");
        shorter += u32::from(first.len() < all.len());
        only_shots += u32::from(is_found(&shots) && !is_found(&never));
    }
    assert!(
        shorter >= 20 && only_shots >= 5,
        "one-sided sample: {shorter} shorter, {only_shots} found by shots"
    );
}

#[test]
fn a_search_fails_exactly_where_start_and_goal_are_not_connected() {
    let mut failed = 0;
    let mut without_neighbours = 0;
    for number in 0..100 {
        let plan = plan(&world(number), NEVER);
        let is_found = plan.ending == Ending::Solved;
        assert_eq!(count(&plan, "connected") == 1, is_found, "roadmap {number}");
        let ends = [count(&plan, "start_links"), count(&plan, "goal_links")];
        assert!(!is_found || ends.iter().all(|links| *links > 0), "roadmap {number}: a path without an edge");
        failed += u32::from(!is_found);
        without_neighbours += u32::from(ends.contains(&0));
    }
    assert!((20..80).contains(&failed), "one-sided sample: {failed} of 100 fail");
    assert!(
        without_neighbours < failed,
        "{without_neighbours} of {failed} failures have an end without neighbours"
    );
}

/// Neighbours of each place, by the bits of its coordinates, start and goal included.
fn neighbours(world: &World) -> BTreeMap<Vec<u64>, Vec<Vec<f64>>> {
    let map = world.as_roadmap().unwrap();
    let nodes: Vec<u32> = (0..SAMPLES).chain(ENDS.map(|end| map.number("end", &end).unwrap())).collect();
    let near = |node: u32| {
        let others = nodes.iter().filter(move |other| **other != node);
        let linked = others
            .filter(move |other| map.gap_mm(node, **other) <= RADIUS_MM && map.join(node, **other).is_ok());
        linked.map(|other| map.config(*other)).collect()
    };
    nodes.iter().map(|node| (bits(&map.config(*node)), near(*node))).collect()
}

fn bits(config: &[f64]) -> Vec<u64> {
    config.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn a_blind_search_by_hops_takes_as_few_as_a_flood_and_a_sighted_one_does_not() {
    let mut found = 0;
    let mut more = 0;
    for number in 0..100 {
        let world = world(number);
        let near = neighbours(&world);
        let mut depth = BTreeMap::from([(bits(&ENDS[0]), 0)]);
        let mut queue = VecDeque::from([bits(&ENDS[0])]);
        while let Some(at) = queue.pop_front() {
            for next in &near[&at] {
                if !depth.contains_key(&bits(next)) {
                    depth.insert(bits(next), depth[&at] + 1);
                    queue.push_back(bits(next));
                }
            }
        }
        let blind = plan(&world, &format!("blind = true\n{NEVER}"));
        let hops = blind.path.len().checked_sub(1);
        assert_eq!(hops, depth.get(&bits(&ENDS[1])).copied(), "roadmap {number}");
        let sighted = plan(&world, NEVER);
        found += u32::from(hops.is_some());
        more += u32::from(sighted.path.len() > blind.path.len());
    }
    assert!(found >= 20 && more >= 5, "one-sided sample: {found} found, {more} with more hops");
}

#[test]
fn legs_of_the_closed_sequence_that_are_no_edges_are_counted() {
    let mut whole = 0;
    let mut broken = 0;
    for number in 0..100 {
        let world = world(number);
        let sequence = plan(&world, "goal_shot = \"never\"\npath = \"closed_sequence\"");
        if sequence.ending != Ending::Solved {
            continue;
        }
        let near = neighbours(&world);
        let is_edge = |pair: &[Vec<f64>]| near[&bits(&pair[0])].contains(&pair[1]);
        let last = sequence.path.len() - 1;
        let wanted = sequence.path[..last].windows(2).filter(|pair| !is_edge(pair)).count() as u64;
        assert_eq!(count(&sequence, "unjoined_legs"), wanted, "roadmap {number}");
        whole += u32::from(wanted == 0);
        broken += u32::from(wanted > 0);
    }
    assert!(whole >= 3 && broken >= 5, "one-sided sample: {whole} whole, {broken} broken");
}

/// What is found with all samples and the neighbours that `threshold` gives.
fn under(world: &World, threshold: &str) -> Plan {
    planned(world, &format!("samples = {SAMPLES}\n{threshold}\ncost = \"hops\"\n{NEVER}"))
}

#[test]
fn a_multiple_of_the_unit_is_the_threshold_of_as_many_millimetres() {
    let mut differ = 0;
    for number in 0..30 {
        let world = world(number);
        let planned = |threshold: &str| under(&world, threshold);
        let half = planned("neighbour_times = 0.5");
        assert_eq!(
            half.path,
            planned(&format!("neighbour_mm = {}", 0.5 * RADIUS_MM)).path,
            "roadmap {number}"
        );
        differ += u32::from(half.path != planned("neighbour_times = 1").path);
    }
    assert!(differ > 5, "{differ} of 30 differ");
    let both = built(&format!("samples = 9\nneighbour_mm = 9\nneighbour_times = 1\ncost = 'hops'\n{NEVER}"));
    assert!(both.err().unwrap().to_string().contains("exactly one of neighbour_mm and neighbour_times"));
}

#[test]
fn without_a_cost_the_distance_to_the_goal_alone_leads() {
    let mut more = 0;
    for number in 0..60 {
        let world = world(number);
        let by = |cost: &str| {
            let text = format!("samples = {SAMPLES}\nneighbour_mm = {RADIUS_MM}\ncost = \"{cost}\"\n{NEVER}");
            planned(&world, &text)
        };
        let (greedy, length) = (by("nothing"), by("length"));
        assert_eq!(greedy.ending, length.ending, "roadmap {number}");
        more += u32::from(count(&greedy, "expansions") < count(&length, "expansions"));
    }
    assert!(more > 5, "{more} of 60 searches are shorter by the distance alone");
}

#[test]
fn only_a_search_by_length_for_itself_promises_a_shortest_path() {
    let promises = |settings: &str| {
        let text = format!("samples = {SAMPLES}\nneighbour_mm = {RADIUS_MM}\n{settings}");
        built(&text).unwrap().is_optimal()
    };
    for (settings, expected) in [
        (format!("cost = 'length'\n{NEVER}"), true),
        (format!("cost = 'length'\nblind = true\n{NEVER}"), true),
        (format!("cost = 'hops'\n{NEVER}"), false),
        (format!("cost = 'hops'\nblind = true\n{NEVER}"), false),
        (format!("cost = 'length'\n{SHOTS}"), false),
        (format!("cost = 'length'\nnearest = 10\n{NEVER}"), false),
        ("cost = 'length'\ngoal_shot = 'from_start'\npath = 'parents'".to_owned(), false),
        ("cost = 'length'\ngoal_shot = 'never'\npath = 'closed_sequence'".to_owned(), false),
    ] {
        assert_eq!(promises(&settings), expected, "{settings}");
    }
}

#[test]
fn numbers_that_cannot_be_are_refused_by_name() {
    for (samples, neighbour_mm, more, expected) in [
        ("0", "28.0", "", "`samples` is 0; a whole number of 1 or more is accepted"),
        ("40", "0.0", "", "`neighbour_mm` is 0.0; a number above 0 is accepted"),
        ("40", "-1.0", "", "`neighbour_mm` is -1.0; a number above 0 is accepted"),
        ("40", "nan", "", "`neighbour_mm` is nan; a finite number above 0 is accepted"),
        ("40", "inf", "", "`neighbour_mm` is inf; a finite number above 0 is accepted"),
        ("40", "0.5", "", "neighbour_mm is 0.5; is it in metres? millimetres are accepted (0.5 m is 500 mm)"),
        (
            "40",
            "1.5",
            "",
            "neighbour_mm is 1.5; is it in metres? millimetres are accepted (1.5 m is 1500 mm)",
        ),
        ("40", "28.0", "nearest = 0", "`nearest` is 0; a whole number of 1 or more is accepted"),
    ] {
        let text =
            format!("samples = {samples}\nneighbour_mm = {neighbour_mm}\ncost = 'hops'\n{NEVER}\n{more}");
        let message = built(&text).err().expect(expected).to_string();
        assert!(message.contains(expected), "{expected}\nis missing in: {message}");
    }
}

#[test]
fn at_any_distance_the_whole_radius_counts_whatever_the_threshold() {
    let mut differ = 0;
    for number in 0..30 {
        let world = world(number);
        let planned = |threshold: &str| under(&world, threshold);
        let far = planned("neighbour_times = 0.3\nany_distance = true");
        assert_eq!(far.path, planned("neighbour_times = 1").path, "roadmap {number}");
        assert_eq!(
            planned("neighbour_times = 0.3\nany_distance = false").path,
            planned("neighbour_times = 0.3").path
        );
        differ += u32::from(far.path != planned("neighbour_times = 0.3").path);
    }
    assert!(differ > 5, "{differ} of 30 differ");
}

#[test]
fn what_a_roadmap_took_is_counted_and_the_plan_is_left_alone() {
    let world = world(0);
    let Build::Stage(build) = crate::planner::find("roadmap_cost").unwrap().build else { panic!("a stage") };
    let stage = build(&Settings::composed("test", toml::Table::new())).unwrap();
    let [start, goal] = ENDS;
    let request =
        Request { world: &world, start: &start, goal: &goal, expansions: 10_000, seed: 0, trace: false };
    let before = plan(&world, NEVER);
    let path = before.path.clone();
    let after = stage.refine(&request, before);
    assert_eq!(after.path, path);
    let World::Roadmap(map) = &world else { panic!("a roadmap") };
    assert!(map.tally().edges > 20 && map.tally().pairs > map.tally().edges);
    let counted =
        ["roadmap_pairs", "roadmap_edges", "roadmap_checked_states"].map(|name| count(&after, name));
    assert_eq!(counted, [map.tally().pairs, map.tally().edges, map.tally().checked]);
}
