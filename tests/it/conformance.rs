//! What every planner and stage of the registry must do, on worlds of the kind it needs.
//!
//! Entries are taken from the registry; [`SETTINGS`] says with which settings each is tried. An entry without a
//! line there fails, and so does a kind of world without a sample in [`worlds`].

use crate::worlds::{Case, worlds};
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use replan::planner::{self, Build, Ending, Invalid, Plan, Planner, Request, Stage};
use replan::settings::Settings;
use replan::space::WorldKind;
use std::collections::BTreeSet;

/// The settings that each entry is tried with.
const SETTINGS: &[(&str, &[&str])] = &[
    (
        "astar",
        &[
            "weight = 0\nties = 'fifo'",
            "weight = 1\nties = 'fifo'",
            "weight = 1\nties = 'lifo'",
            "weight = 1\nties = 'larger_g'",
            "weight = 3\nties = 'fifo'",
        ],
    ),
    (
        "bidirectional",
        &[
            "weight = 'one'\nmeeting = 'optimal_stop'\nside = 'alternate'\nties = 'fifo'",
            "weight = 'one'\nmeeting = 'optimal_stop'\nside = 'smaller_f'\nties = 'larger_g'",
            "weight = 'one'\nmeeting = 'both_closed'\nside = 'smaller_f'\nties = 'lifo'",
            "weight = 'falling'\nmeeting = 'generated_any'\nside = 'alternate'\nties = 'fifo'",
            "weight = 'falling'\nmeeting = 'closed_by_other'\nside = 'alternate'\nties = 'fifo'",
        ],
    ),
    ("delete_inflections", &["line_of_sight = 'exact_interior'", "line_of_sight = 'closed_cells'"]),
];

/// Entries that these lattices cannot hold, and what does.
const ELSEWHERE: &[(&str, &str)] = &[
    ("astar_octile", "search: held to the general kernel in cost and every counter; it keeps no trace"),
    ("chaos_astar", "arm: held to the verifier on the planar arm"),
    ("direct", "space::roadmap and verify::cell: no sample of roadmaps stands here yet"),
    ("lattice_astar", "arm: held to the verifier on the planar arm"),
    ("roadmap_astar", "space::roadmap and verify::cell: no sample of roadmaps stands here yet"),
    ("straighten", "space::roadmap and verify::cell: no sample of roadmaps stands here yet"),
];

fn is_held_here(entry: &planner::Entry) -> bool {
    ELSEWHERE.iter().all(|(name, _)| *name != entry.name)
}

const PLENTY: u64 = 1_000_000;

fn settings(name: &str) -> Vec<Settings> {
    let (_, texts) = SETTINGS.iter().find(|(known, _)| *known == name).unwrap_or_else(|| {
        panic!("conformance::SETTINGS has no line for `{name}`; add one with settings that show what it does")
    });
    let read =
        |text: &&str| Settings::composed(format!("`{name}` with {text}"), toml::from_str(text).unwrap());
    texts.iter().map(read).collect()
}

/// Every planner with each of its settings, named, with the kind of world it needs.
fn planners() -> Vec<(String, WorldKind, Box<dyn Planner>)> {
    let mut built = Vec::new();
    for entry in planner::REGISTRY.iter().filter(|entry| is_held_here(entry)) {
        let Build::Planner(build) = entry.build else { continue };
        for settings in settings(entry.name) {
            let name = format!("{} {:?}", entry.name, settings.table());
            built.push((name, entry.needs, build(&settings).unwrap()));
        }
    }
    built
}

fn stages() -> Vec<(String, WorldKind, Box<dyn Stage>)> {
    let mut built = Vec::new();
    for entry in planner::REGISTRY.iter().filter(|entry| is_held_here(entry)) {
        let Build::Stage(build) = entry.build else { continue };
        for settings in settings(entry.name) {
            let name = format!("{} {:?}", entry.name, settings.table());
            built.push((name, entry.needs, build(&settings).unwrap()));
        }
    }
    built
}

fn request(case: &Case, expansions: u64, trace: bool) -> Request<'_> {
    Request { world: &case.world, start: &case.start, goal: &case.goal, expansions, seed: 5, trace }
}

fn plan(planner: &dyn Planner, case: &Case) -> Plan {
    planner.plan(&request(case, PLENTY, false)).unwrap_or_else(|invalid| panic!("{}: {invalid}", case.name))
}

fn count(plan: &Plan, column: &str) -> u64 {
    plan.counts.get(column).unwrap_or_else(|| panic!("no `{column}` in {:?}", plan.counts)).as_f64() as u64
}

#[test]
fn every_line_of_settings_belongs_to_an_entry() {
    let names: BTreeSet<&str> = planner::REGISTRY.iter().map(|entry| entry.name).collect();
    let lines: BTreeSet<&str> =
        SETTINGS.iter().map(|(name, _)| *name).chain(ELSEWHERE.iter().map(|(name, _)| *name)).collect();
    assert_eq!(lines, names);
}

#[test]
fn an_outcome_depends_on_the_request_alone_and_not_on_threads_or_tracing() {
    for (name, kind, planner) in planners() {
        let cases = worlds(kind);
        let on = |threads: usize, trace: bool| -> Vec<Result<Plan, Invalid>> {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let plan = |case: &Case| planner.plan(&request(case, PLENTY, trace));
            pool.install(|| cases.par_iter().map(plan).collect())
        };
        let (alone, together) = (on(1, false), on(2, false));
        let mut traced = on(2, true);
        let mut exhibits = 0;
        for plan in traced.iter_mut().flatten() {
            exhibits += std::mem::take(&mut plan.exhibits).len();
        }
        for (i, case) in cases.iter().enumerate() {
            assert_eq!(alone[i], together[i], "{name} on {}: 1 and 2 threads", case.name);
            assert_eq!(alone[i], traced[i], "{name} on {}: tracing changed the plan", case.name);
        }
        assert!(exhibits > 0, "{name} keeps no exhibit");
    }
}

#[test]
fn complete_planners_find_a_path_exactly_where_there_is_one() {
    for (name, kind, planner) in planners() {
        let (mut solved, mut walled) = (0, 0);
        let cases = worlds(kind);
        for case in &cases {
            let plan = plan(planner.as_ref(), case);
            let found = plan.ending == Ending::Solved;
            assert_ne!(plan.ending, Ending::BudgetSpent, "{name} on {}", case.name);
            assert!(!planner.is_complete() || found == case.optimum.is_some(), "{name} on {}", case.name);
            assert_eq!(
                (plan.path.is_empty(), plan.cost.is_none()),
                (!found, !found),
                "{name} on {}",
                case.name
            );
            solved += usize::from(found);
            walled += usize::from(case.optimum.is_none());
        }
        assert!(
            solved * 5 > cases.len() && walled * 20 > cases.len(),
            "{name}: {solved} solved, {walled} walled off"
        );
    }
}

#[test]
fn no_planner_is_refused_and_optimal_ones_cost_what_the_verifier_finds() {
    let mut above = 0;
    for (name, kind, planner) in planners() {
        for case in worlds(kind) {
            let plan = plan(planner.as_ref(), &case);
            let Some((cost, optimum)) = plan.cost.zip(case.optimum) else { continue };
            assert_eq!(case.refusal(&plan, true, planner.is_optimal()), None, "{name} on {}", case.name);
            assert!(cost > optimum - 1e-9, "{name} on {}: {cost} is below {optimum}", case.name);
            assert!(!planner.is_optimal() || cost < optimum + 1e-9, "{name} on {}", case.name);
            above += usize::from(cost > optimum + 1e-9);
        }
    }
    assert!(
        above > 20,
        "only {above} costs above the optimum: the sample cannot tell optimal planners from others"
    );
}

#[test]
fn astar_expands_less_than_dijkstra_so_that_its_heuristic_is_not_zero() {
    let of = |index: usize| {
        let Build::Planner(build) = planner::find("astar").unwrap().build else { panic!("astar plans") };
        build(&settings("astar")[index]).unwrap()
    };
    let (dijkstra, astar) = (of(0), of(1));
    let [mut all, mut guided] = [0, 0];
    for case in worlds(WorldKind::Lattice) {
        all += count(&plan(dijkstra.as_ref(), &case), "expansions");
        guided += count(&plan(astar.as_ref(), &case), "expansions");
    }
    assert!(guided * 4 < all * 3, "{guided} expansions with the heuristic, {all} without");
}

#[test]
fn a_budget_is_kept_to_the_last_expansion() {
    for (name, kind, planner) in planners() {
        let mut spent = 0;
        for case in worlds(kind).iter().step_by(3) {
            let free = plan(planner.as_ref(), case);
            let full = count(&free, "expansions");
            for budget in BTreeSet::from([0, 1, 2, full / 2, full.saturating_sub(1), full, full + 1]) {
                let plan = planner.plan(&request(case, budget, false)).unwrap();
                let what = format!("{name} on {} with {budget} of {full} expansions", case.name);
                if budget > full {
                    assert_eq!(plan, free, "{what}");
                } else if budget < full {
                    assert_eq!(plan.ending, Ending::BudgetSpent, "{what}");
                    assert_eq!((plan.cost, plan.path.len()), (None, 0), "{what}");
                    assert_eq!(count(&plan, "expansions"), budget, "{what}");
                    spent += 1;
                }
            }
        }
        assert!(spent > 50, "{name}: the budget was spent {spent} times only");
    }
}

#[test]
fn counters_are_what_the_world_saw() {
    for (name, kind, planner) in planners() {
        let mut exhausted = 0;
        for case in worlds(kind) {
            let plan = planner.plan(&request(&case, PLENTY, true)).unwrap();
            let what = format!("{name} on {}: {:?}", case.name, plan.counts);
            let opened: Vec<_> = plan.exhibits.iter().filter(|e| e.name.starts_with("opened")).collect();
            let points: usize = opened.iter().map(|e| e.values.len() / e.width).sum();
            assert_eq!(count(&plan, "opened"), points as u64, "{what}");
            for side in &opened {
                let distinct: BTreeSet<Vec<u64>> =
                    side.values.chunks(side.width).map(|p| p.iter().map(|x| x.to_bits()).collect()).collect();
                assert_eq!(distinct.len() * side.width, side.values.len(), "{what}: a node was opened twice");
            }
            assert!(count(&plan, "closed") <= count(&plan, "opened"), "{what}");
            if plan.ending == Ending::NoPath && opened.len() == 1 {
                let (nodes, moves) = case.reachable();
                let counted = ["opened", "closed", "expansions", "generated"].map(|c| count(&plan, c));
                assert_eq!(counted, [nodes, nodes, nodes, moves], "{what}");
                exhausted += 1;
            }
        }
        assert!(
            exhausted > 3 || name.starts_with("bidirectional"),
            "{name}: {exhausted} worlds were exhausted"
        );
    }
}

#[test]
fn a_start_or_goal_that_is_blocked_or_outside_is_invalid() {
    for (name, kind, planner) in planners() {
        let mut refused = 0;
        for case in worlds(kind).iter().take(20) {
            for (start, goal) in case.impossible() {
                let posed = Request { start: &start, goal: &goal, ..request(case, PLENTY, false) };
                let answer = planner.plan(&posed);
                assert!(answer.is_err(), "{name} on {}: {start:?} to {goal:?} gave {answer:?}", case.name);
                refused += 1;
            }
        }
        assert!(refused > 40, "{name}: {refused} impossible queries");
    }
}

#[test]
fn stages_keep_the_ends_and_the_truth_and_never_lengthen() {
    for (name, kind, stage) in stages() {
        let mut shorter = 0;
        let fitting =
            planners().into_iter().filter(|(_, needs, planner)| *needs == kind && planner.is_complete());
        let (_, _, planner) = fitting.into_iter().nth(1).expect("a stage's kind of world has a planner");
        for case in worlds(kind) {
            let raw = plan(planner.as_ref(), &case);
            let posed = request(&case, PLENTY, false);
            let tidied = stage.refine(&posed, raw.clone());
            assert_eq!(tidied, stage.refine(&posed, raw.clone()), "{name} on {}", case.name);
            if raw.ending != Ending::Solved {
                assert_eq!(tidied, raw, "{name} on {}: an unsolved plan was touched", case.name);
                continue;
            }
            assert_eq!(case.refusal(&tidied, false, false), None, "{name} on {}", case.name);
            assert!(tidied.cost.unwrap() < raw.cost.unwrap() + 1e-9, "{name} on {}", case.name);
            assert_eq!(tidied.counts, raw.counts, "{name} on {}", case.name);
            shorter += usize::from(tidied.cost.unwrap() < raw.cost.unwrap() - 1e-9);
        }
        assert!(shorter > 20, "{name}: shortened {shorter} paths only");
    }
}
