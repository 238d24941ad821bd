//! What every planner and stage of the registry must do, on worlds of the kind it needs.
//!
//! Entries are taken from the registry; [`SETTINGS`] says with which settings each is tried. An entry without a
//! line there fails, and so does a kind of world without a sample in [`worlds`].

use crate::worlds::{Case, Subject, worlds};
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use replan::planner::{self, Build, Ending, Entry, Invalid, Plan, Planner, Request, Stage};
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
    ("astar_octile", &[""]),
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
    (
        "bspline",
        &[
            "control = 'steps'\nguarded = true\npoints_per_span = 2",
            "control = 'nodes'\nguarded = true\npoints_per_span = 5",
        ],
    ),
    (
        "chaos_astar",
        &[
            "region_shape = 'square'\nregion_radius_cells = 2\nneighbours = 16\ndrawn = 'each_expansion'\nsource = \
             'uniform'\ngoal_in_region = 'included'\nopen_node = 'lowered'\nties = 'fifo'",
            "region_shape = 'square'\nregion_radius_cells = 2\nneighbours = 20\ndrawn = 'once_per_run'\nsource = \
             'logistic'\ngoal_in_region = 'as_drawn'\nopen_node = 'never'\nties = 'lifo'",
        ],
    ),
    ("delete_inflections", &["line_of_sight = 'exact_interior'", "line_of_sight = 'closed_cells'"]),
    ("direct", &[""]),
    ("joint_astar", &["delta_deg = 12.0\nneighbours = 12"]),
    (
        "keynode_astar",
        &[
            "search = 'open_list'\ncluster = true\nlast_resort = true",
            "search = 'open_list'\ncluster = false\nlast_resort = false",
            "search = 'greedy'\ncluster = false\nlast_resort = false",
            "search = 'literal'\ncluster = false\nlast_resort = false",
        ],
    ),
    (
        "lattice26_astar",
        &[
            "checked = 'segments'\nties = 'fifo'",
            "checked = 'segments'\nties = 'larger_g'",
            "checked = 'nodes'\nties = 'lifo'",
        ],
    ),
    (
        "lattice_astar",
        &[
            "neighbourhood = { shape = 'square', radius_cells = 1 }\nopen_node = 'lowered'\nties = 'fifo'",
            "neighbourhood = { shape = 'disc', radius_cells = 2 }\nopen_node = 'lowered'\nties = 'larger_g'",
            "neighbourhood = { shape = 'square', radius_cells = 2 }\nopen_node = 'never'\nties = 'lifo'",
        ],
    ),
    (
        "posture",
        &[
            "adjust = true\nsign = 'down'\nclamp = 'floor'\ndistance = 'exact'\npose = 'inverse'\ndamping = 0.02\n\
             act_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 20\nbounds_rad = [0.2, 0.2, 0.1]\n\
             bounds = 'per_node'\nrecovery_rad = 0.02\nbranches = 'all'\ndiagnose = false",
            "adjust = true\nsign = 'as_printed'\nclamp = 'literal'\ndistance = 'exact'\npose = 'jacobian'\n\
             damping = 0.0\nact_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 5\n\
             bounds_rad = [0.2, 0.2, 0.1]\nbounds = 'from_start'\nrecovery_rad = 0.02\nbranches = 'clearest'\n\
             diagnose = true",
        ],
    ),
    (
        "roadmap_astar",
        &[
            "samples = 40\nneighbour_mm = 30.0\ncost = 'hops'\ngoal_shot = 'never'\npath = 'parents'",
            "samples = 40\nneighbour_mm = 30.0\ncost = 'length'\ngoal_shot = 'never'\npath = 'parents'",
            "samples = 40\nneighbour_mm = 30.0\ncost = 'hops'\ngoal_shot = 'before_expansion'\npath = 'parents'",
        ],
    ),
    ("shorten_best", &["least = 'length'", "least = 'nodes'"]),
    ("straighten", &["last = 'as_printed'", "last = 'goal'"]),
    ("straighten_from_previous", &["resume = 'last_joined'", "resume = 'first_refused'"]),
    ("visibility_edges", &["spacing_cm = 2.0"]),
];

/// Planners that have nothing to show but their path.
const WITHOUT_EXHIBITS: &[&str] =
    &["astar_octile", "direct", "keynode_astar", "lattice26_astar", "visibility_edges"];

/// An entry, one of its settings, and the value under which a property is not asked of it.
type Exception = (&'static str, &'static str, &'static str);

/// As their papers print them, these look at points only: what is between them may be refused.
const LOOK_AT_POINTS: &[Exception] =
    &[("keynode_astar", "search", "literal"), ("lattice26_astar", "checked", "nodes")];

/// As printed, the walk may go round in circles until its budget is spent.
const CIRCLE: &[Exception] = &[("keynode_astar", "search", "literal")];

/// The tip drifts where joints follow the Jacobian, so that its path may be longer than the one it follows.
const DRIFT: &[Exception] = &[("posture", "pose", "jacobian")];

/// Stages that take the paths of another kind of world's planners: `posture` makes joint angles of a tip's path.
const FED_BY: &[(&str, WorldKind)] = &[("posture", WorldKind::Polyhedra)];

/// Stages that follow a path instead of shortening it, and have none to give where they cannot.
const FOLLOWING: &[&str] = &["posture"];

const PLENTY: u64 = 100_000;

fn settings(name: &str) -> Vec<Settings> {
    let (_, texts) = SETTINGS.iter().find(|(known, _)| *known == name).unwrap_or_else(|| {
        panic!("conformance::SETTINGS has no line for `{name}`; add one with settings that show what it does")
    });
    let read =
        |text: &&str| Settings::composed(format!("`{name}` with {text}"), toml::from_str(text).unwrap());
    texts.iter().map(read).collect()
}

/// Every planner with each of its settings.
fn planners() -> Vec<Subject> {
    let mut built = Vec::new();
    for entry in planner::REGISTRY {
        let Build::Planner(build) = entry.build else { continue };
        for settings in settings(entry.name) {
            let name = format!("{} {:?}", entry.name, settings.table());
            let planner = build(&settings).unwrap_or_else(|e| panic!("{name}: {e}"));
            built.push(Subject { name, entry, settings, planner });
        }
    }
    built
}

/// Every planner that searches, so that it has a budget and counters.
fn searching() -> Vec<Subject> {
    planners().into_iter().filter(|subject| subject.entry.columns.contains(&"expansions")).collect()
}

/// Whether an exception is made for the entry under these settings.
fn is_among(exceptions: &[Exception], entry: &Entry, settings: &Settings) -> bool {
    let is_set = |&(name, key, value): &Exception| {
        name == entry.name && settings.table().get(key).and_then(|found| found.as_str()) == Some(value)
    };
    exceptions.iter().any(is_set)
}

/// A stage with the settings that it was built from.
struct Tidier {
    name: String,
    entry: &'static Entry,
    settings: Settings,
    stage: Box<dyn Stage>,
}

fn stages() -> Vec<Tidier> {
    let mut built = Vec::new();
    for entry in planner::REGISTRY {
        let Build::Stage(build) = entry.build else { continue };
        for settings in settings(entry.name) {
            let name = format!("{} {:?}", entry.name, settings.table());
            let stage = build(&settings).unwrap_or_else(|e| panic!("{name}: {e}"));
            built.push(Tidier { name, entry, settings, stage });
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
fn every_line_of_settings_belongs_to_an_entry_and_every_entry_has_one() {
    let names: BTreeSet<&str> = planner::REGISTRY.iter().map(|entry| entry.name).collect();
    let lines: BTreeSet<&str> = SETTINGS.iter().map(|(name, _)| *name).collect();
    assert_eq!(lines, names);
}

#[test]
fn an_outcome_depends_on_the_request_alone_and_not_on_threads_or_tracing() {
    for Subject { name, entry, planner, .. } in planners() {
        let cases = worlds(entry.needs);
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
        assert_eq!(exhibits == 0, WITHOUT_EXHIBITS.contains(&entry.name), "{name}: {exhibits} exhibits");
    }
}

#[test]
fn planners_find_a_path_exactly_where_their_graph_has_one() {
    for subject in planners() {
        let (mut solved, mut walled) = (0, 0);
        let cases = worlds(subject.entry.needs);
        for case in cases {
            let (plan, truth) = (plan(subject.planner.as_ref(), case), case.truth(&subject));
            let what = format!("{} on {}", subject.name, case.name);
            let found = plan.ending == Ending::Solved;
            let may_circle = is_among(CIRCLE, subject.entry, &subject.settings);
            assert!(plan.ending != Ending::BudgetSpent || may_circle, "{what}: the budget was spent");
            assert!(!found || truth.optimum.is_some(), "{what}: a path where there is none");
            assert!(!truth.is_exact || found == truth.optimum.is_some(), "{what}");
            assert_eq!((plan.path.is_empty(), plan.cost.is_none()), (!found, !found), "{what}");
            solved += usize::from(found);
            walled += usize::from(truth.optimum.is_none());
        }
        assert!(
            solved * 5 > cases.len() && walled * 20 > cases.len(),
            "{}: {solved} solved, {walled} walled off of {}",
            subject.name,
            cases.len()
        );
    }
}

#[test]
fn no_planner_is_refused_and_optimal_ones_cost_what_the_oracle_finds() {
    let mut above = 0;
    for subject in planners() {
        for case in worlds(subject.entry.needs) {
            let (plan, truth) = (plan(subject.planner.as_ref(), case), case.truth(&subject));
            let Some((cost, optimum)) = plan.cost.zip(truth.optimum) else { continue };
            let what = format!("{} on {}", subject.name, case.name);
            let refusal = case.refusal(&plan, &subject);
            let is_excused = is_among(LOOK_AT_POINTS, subject.entry, &subject.settings);
            assert!(refusal.is_none() || is_excused, "{what}: {refusal:?}");
            assert!(cost > optimum - 1e-9, "{what}: {cost} is below {optimum}");
            assert!(
                !subject.planner.is_optimal() || cost < optimum + 1e-9,
                "{what}: {cost} is above {optimum}"
            );
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
        all += count(&plan(dijkstra.as_ref(), case), "expansions");
        guided += count(&plan(astar.as_ref(), case), "expansions");
    }
    assert!(guided * 4 < all * 3, "{guided} expansions with the heuristic, {all} without");
}

#[test]
fn a_budget_is_kept_to_the_last_expansion() {
    for Subject { name, entry, settings, planner } in searching() {
        let mut spent = 0;
        for case in worlds(entry.needs).iter().step_by(3) {
            let free = plan(planner.as_ref(), case);
            if free.ending == Ending::BudgetSpent && is_among(CIRCLE, entry, &settings) {
                continue;
            }
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
        assert!(spent > 30, "{name}: the budget was spent {spent} times only");
    }
}

#[test]
fn counters_are_what_the_world_saw() {
    for subject in searching() {
        let (mut exhausted, mut is_counted) = (0, false);
        for case in worlds(subject.entry.needs) {
            let plan = subject.planner.plan(&request(case, PLENTY, true)).unwrap();
            let what = format!("{} on {}: {:?}", subject.name, case.name, plan.counts);
            for list in ["opened", "closed"] {
                let shown: Vec<_> = plan.exhibits.iter().filter(|e| e.name.starts_with(list)).collect();
                let points: usize = shown.iter().map(|e| e.values.len() / e.width).sum();
                assert!(shown.is_empty() || count(&plan, list) == points as u64, "{what}: {points} {list}");
                for side in &shown {
                    let points = side.values.chunks(side.width);
                    let distinct: BTreeSet<Vec<u64>> =
                        points.map(|p| p.iter().map(|x| x.to_bits()).collect()).collect();
                    assert_eq!(distinct.len() * side.width, side.values.len(), "{what}: twice in {list}");
                }
            }
            let columns = subject.entry.columns;
            assert!(plan.counts.keys().all(|column| columns.contains(column)), "{what}: of {columns:?}");
            if columns.contains(&"closed") {
                assert!(count(&plan, "closed") <= count(&plan, "opened"), "{what}");
            }
            let reachable = case.truth(&subject).reachable;
            is_counted |= reachable.is_some();
            if let (Ending::NoPath, Some((nodes, moves))) = (plan.ending, reachable) {
                let counted = ["opened", "closed", "expansions", "generated"].map(|c| count(&plan, c));
                assert_eq!(counted, [nodes, nodes, nodes, moves], "{what}");
                exhausted += 1;
            }
        }
        assert!(exhausted > 3 || !is_counted, "{}: {exhausted} worlds were exhausted", subject.name);
    }
}

#[test]
fn a_start_or_goal_that_is_blocked_or_outside_is_invalid() {
    for Subject { name, entry, planner, .. } in planners() {
        let mut refused = 0;
        for case in worlds(entry.needs).iter().take(20) {
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

/// Every planner that searches, whose paths are accepted and are what the stage takes.
fn feeding(entry: &Entry) -> Vec<Subject> {
    let kind = FED_BY.iter().find(|(fed, _)| *fed == entry.name).map_or(entry.needs, |(_, kind)| *kind);
    let mut feeding = searching();
    feeding.retain(|s| s.entry.needs == kind && !is_among(LOOK_AT_POINTS, s.entry, &s.settings));
    feeding
}

#[test]
fn stages_keep_the_ends_and_the_truth_and_never_lengthen() {
    for Tidier { name, entry, settings, stage } in stages() {
        let (mut solved, mut better) = (0, 0);
        let feeding = feeding(entry);
        let (follows, drifts) = (FOLLOWING.contains(&entry.name), is_among(DRIFT, entry, &settings));
        for (subject, case) in feeding.iter().flat_map(|s| worlds(entry.needs).iter().map(move |c| (s, c))) {
            let raw = plan(subject.planner.as_ref(), case);
            let posed = request(case, PLENTY, false);
            let tidied = stage.refine(&posed, raw.clone());
            let what = format!("{name} after {} on {}", subject.name, case.name);
            assert_eq!(tidied, stage.refine(&posed, raw.clone()), "{what}");
            if raw.ending != Ending::Solved {
                assert_eq!(tidied, raw, "{what}: an unsolved plan was touched");
                continue;
            }
            solved += 1;
            let kept = raw.counts.iter().all(|(column, value)| tidied.counts.get(column) == Some(value));
            assert!(kept, "{what}: {:?} from {:?}", tidied.counts, raw.counts);
            if follows && tidied.ending == Ending::NoPath {
                assert_eq!((tidied.cost, tidied.path.len()), (None, 0), "{what}");
                continue;
            }
            assert_eq!(case.refusal_off_graph(&tidied), None, "{what}");
            let (now, before) = (tidied.cost.unwrap(), raw.cost.unwrap());
            assert!(now < before + 1e-9 || drifts, "{what}: {now} from {before}");
            better += usize::from(follows || now < before - 1e-9);
        }
        assert!(better * 4 > solved, "{name}: {better} paths of {solved} were tidied");
    }
}
