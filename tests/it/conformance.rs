//! What every planner and stage of the registry must do, on worlds of the kind it needs.
//!
//! Entries are taken from the registry; [`SETTINGS`] says with which settings each is tried. An entry without a
//! line there fails, and so does a kind of world without a sample in [`worlds`].

mod tried;

use crate::worlds::{Case, Subject, Truth, samples, worlds};
use base::settings::Settings;
use engine::planner::{self, Build, Ending, Entry, Invalid, Plan, Planner, Request, Stage};
use engine::space::WorldKind;
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;
use tried::{
    COUNTING, CUT_IN, DRIFT, FED_BY, FOLLOWING, LOOK_AT_POINTS, OFF, SETTINGS, WITHOUT_TRACES, is_among,
    names,
};

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

/// A planner on every world of its sample.
struct Tried {
    subject: Subject,
    /// Its plan and what is true of the query, world by world.
    plans: Vec<(&'static Case, Plan, Truth)>,
}

impl Tried {
    /// The world at this place of the sample of `kind`, and the plan on it.
    fn on(&self, kind: WorldKind, at: usize) -> (&'static Case, Plan) {
        let case = &worlds(kind)[at];
        let planned = || plan(self.subject.planner.as_ref(), case);
        (case, if kind == self.subject.entry.needs { self.plans[at].1.clone() } else { planned() })
    }
}

/// Every planner with each of its settings, on every world of its sample; planned once for all tests.
fn tried() -> &'static [Tried] {
    static TRIED: LazyLock<Vec<Tried>> = LazyLock::new(|| {
        let planners = planners();
        // No thread of the pool draws the worlds that another waits for.
        for subject in &planners {
            worlds(subject.entry.needs);
        }
        let on = |subject: Subject| {
            let planned = |case| (case, plan(subject.planner.as_ref(), case), case.truth(&subject));
            Tried { plans: worlds(subject.entry.needs).iter().map(planned).collect(), subject }
        };
        planners.into_par_iter().map(on).collect()
    });
    &TRIED
}

/// Every planner that searches, so that it has a budget and counters.
fn searching() -> impl Iterator<Item = &'static Tried> {
    tried().iter().filter(|tried| tried.subject.entry.columns.contains(&"expansions"))
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
        let alone = on(1, false);
        let together = on(2, false);
        let mut traced = on(2, true);
        let mut traces = 0;
        for plan in traced.iter_mut().flatten() {
            traces += std::mem::take(&mut plan.traces).len();
        }
        for (i, case) in cases.iter().enumerate() {
            assert_eq!(alone[i], together[i], "{name} on {}: 1 and 2 threads", case.name);
            assert_eq!(alone[i], traced[i], "{name} on {}: tracing changed the plan", case.name);
        }
        assert_eq!(traces == 0, WITHOUT_TRACES.contains(&entry.name), "{name}: {traces} traces");
    }
}

#[test]
fn a_plan_depends_on_the_seed_only_if_its_planner_says_that_it_draws() {
    let mut drawn = 0;
    for Subject { name, entry, planner, .. } in planners() {
        let with = |seed: u64| -> Vec<Result<Plan, Invalid>> {
            let request = |case| Request { seed, ..request(case, PLENTY, false) };
            worlds(entry.needs).iter().map(|case| planner.plan(&request(case))).collect()
        };
        let differs = with(5) != with(6);
        assert!(!differs || planner.draws(), "{name} says that it draws nothing");
        drawn += u32::from(differs);
    }
    assert!(drawn > 0, "no planner of the sample draws");
}

#[test]
fn planners_find_a_path_exactly_where_their_graph_has_one() {
    for Tried { subject, plans } in tried() {
        let mut solved = 0;
        let mut walled = 0;
        for (case, plan, truth) in plans {
            let what = format!("{} on {}", subject.name, case.name);
            let found = plan.ending == Ending::Solved;
            // Without a path, planners that sample go on until their budget is spent.
            let goes_on = samples(subject) && truth.optimum.is_none();
            assert!(plan.ending != Ending::BudgetSpent || goes_on, "{what}: the budget was spent");
            assert!(!found || truth.optimum.is_some(), "{what}: a path where there is none");
            assert!(!truth.is_exact || found == truth.optimum.is_some(), "{what}");
            assert_eq!((plan.path.is_empty(), plan.cost.is_none()), (!found, !found), "{what}");
            solved += usize::from(found);
            walled += usize::from(truth.optimum.is_none());
        }
        assert!(
            solved * 5 > plans.len() && walled * 20 > plans.len(),
            "{}: {solved} solved, {walled} walled off of {}",
            subject.name,
            plans.len()
        );
    }
}

#[test]
fn a_goal_that_is_the_start_is_reached_at_no_cost() {
    let mut wrong = Vec::new();
    // Every path of this one goes over a node of its lattice, there and back.
    let over_a_node = "lattice26_astar";
    for subject in planners().into_iter().filter(|subject| subject.entry.name != over_a_node) {
        for case in worlds(subject.entry.needs).iter().take(6) {
            let here = Request { goal: &case.start, ..request(case, PLENTY, true) };
            let plan = subject.planner.plan(&here);
            // A path in joint space is one of angles, and stays where it is all the same.
            let stays = |plan: &Plan| {
                plan.ending == Ending::Solved
                    && plan.path.first().is_some_and(|first| plan.path.iter().all(|at| at == first))
                    && plan.cost.is_none_or(|cost| cost == 0.0)
            };
            if !plan.as_ref().is_ok_and(stays) {
                wrong.push(format!("{} on {}: {plan:?}", subject.name, case.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_planner_is_refused_and_optimal_ones_cost_what_the_oracle_finds() {
    let mut above = BTreeMap::new();
    let mut excused = BTreeSet::new();
    for Tried { subject, plans } in tried() {
        for (case, plan, truth) in plans {
            let above = above.entry(case.world.kind()).or_insert(0);
            let Some((cost, optimum)) = plan.cost.zip(truth.optimum) else { continue };
            let what = format!("{} on {}", subject.name, case.name);
            if let Some(refusal) = case.refusal(plan, subject) {
                assert!(is_among(LOOK_AT_POINTS, subject.entry, &subject.settings), "{what}: {refusal}");
                excused.insert(subject.entry.name);
            }
            let may_undercut = subject.planner.is_any_angle();
            assert!(may_undercut || cost > optimum - 1e-9, "{what}: {cost} is below {optimum}");
            let is_above = cost > optimum + 1e-9;
            assert!(!subject.planner.is_optimal() || !is_above, "{what}: {cost} is above {optimum}");
            *above += usize::from(is_above);
        }
    }
    assert_eq!(excused, names(LOOK_AT_POINTS), "an exception that nothing needs is to be taken out");
    assert!(
        above.values().all(|above| *above > 10),
        "costs above the optimum by kind of world: {above:?}: the sample cannot tell optimal planners from others"
    );
}

#[test]
fn astar_expands_less_than_dijkstra_so_that_its_heuristic_is_not_zero() {
    let of = |index: usize| {
        let Build::Planner(build) = planner::find("astar").unwrap().build else { panic!("astar plans") };
        build(&settings("astar")[index]).unwrap()
    };
    let dijkstra = of(0);
    let astar = of(1);
    let [mut all, mut guided] = [0, 0];
    for case in worlds(WorldKind::Lattice) {
        all += count(&plan(dijkstra.as_ref(), case), "expansions");
        guided += count(&plan(astar.as_ref(), case), "expansions");
    }
    assert!(guided * 4 < all * 3, "{guided} expansions with the heuristic, {all} without");
}

#[test]
fn a_budget_is_kept_to_the_last_expansion() {
    for Tried { subject: Subject { name, planner, .. }, plans } in searching() {
        let mut spent = 0;
        for (case, free, _) in plans.iter().step_by(3) {
            let full = count(free, "expansions");
            for budget in BTreeSet::from([0, 1, 2, full / 2, full.saturating_sub(1), full, full + 1]) {
                let plan = planner.plan(&request(case, budget, false)).unwrap();
                let what = format!("{name} on {} with {budget} of {full} expansions", case.name);
                if budget > full {
                    assert_eq!(plan, *free, "{what}");
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
    for Tried { subject, plans } in searching() {
        let mut exhausted = 0;
        let mut is_counted = false;
        for (case, _, truth) in plans {
            let plan = subject.planner.plan(&request(case, PLENTY, true)).unwrap();
            let what = format!("{} on {}: {:?}", subject.name, case.name, plan.counts);
            for list in ["opened", "closed"] {
                let shown: Vec<_> = plan.traces.iter().filter(|e| e.name.starts_with(list)).collect();
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
            is_counted |= truth.reachable.is_some();
            if let (Ending::NoPath, Some((nodes, moves))) = (plan.ending, truth.reachable) {
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
fn feeding(entry: &Entry) -> impl Iterator<Item = &'static Tried> {
    let kind = FED_BY.iter().find(|(fed, _)| *fed == entry.name).map_or(entry.needs, |(_, kind)| *kind);
    searching().filter(move |Tried { subject, .. }| {
        subject.entry.needs == kind && !is_among(LOOK_AT_POINTS, subject.entry, &subject.settings)
    })
}

/// What the stage makes of a plan, which is the same with tracing and on two threads at once and keeps all counts.
fn tidied(tidier: &Tidier, posed: &Request<'_>, raw: &Plan, what: &str) -> Plan {
    let refine = |trace: bool| tidier.stage.refine(&Request { trace, ..*posed }, raw.clone());
    let (tidied, mut traced) = rayon::join(|| refine(false), || refine(true));
    traced.traces.clear();
    assert_eq!(tidied, traced, "{what}: tracing or threads changed the plan");
    let mut added = tidied.counts.clone();
    added.retain(|column, value| raw.counts.get(column) != Some(value));
    assert_eq!(tidied.counts.len() - added.len(), raw.counts.len(), "{what}: a count was replaced");
    assert!(added.keys().all(|column| tidier.entry.columns.contains(column)), "{what}: {added:?}");
    tidied
}

#[test]
fn stages_keep_ends_and_truth_without_lengthening() {
    let [mut drifted, mut gave_up, mut cut_in] = [const { BTreeSet::new() }; 3];
    for tidier in stages() {
        let Tidier { name, entry, settings, .. } = &tidier;
        let mut solved = 0;
        let mut better = 0;
        let follows = FOLLOWING.contains(&entry.name);
        let places = 0..worlds(entry.needs).len();
        for (tried, at) in feeding(entry).flat_map(|tried| places.clone().map(move |at| (tried, at))) {
            let (case, raw) = tried.on(entry.needs, at);
            let what = format!("{name} after {} on {}", tried.subject.name, case.name);
            let tidied = tidied(&tidier, &request(case, PLENTY, false), &raw, &what);
            let counts_only = COUNTING.contains(&entry.name);
            if counts_only || raw.ending != Ending::Solved {
                let counts = if counts_only { raw.counts.clone() } else { tidied.counts.clone() };
                assert_eq!(Plan { counts, ..tidied }, raw, "{what}: the plan was touched");
                continue;
            }
            solved += 1;
            if follows && tidied.ending == Ending::NoPath {
                assert_eq!((tidied.cost, tidied.path.len()), (None, 0), "{what}");
                gave_up.insert(entry.name);
                continue;
            }
            if let Some(refusal) = case.refusal_off_graph(&tidied) {
                assert!(is_among(CUT_IN, entry, settings), "{what}: {refusal}");
                cut_in.insert(entry.name);
            }
            let now = tidied.cost.unwrap();
            let before = raw.cost.unwrap();
            if now >= before + 1e-9 {
                assert!(is_among(DRIFT, entry, settings), "{what}: {now} from {before}");
                drifted.insert(entry.name);
            }
            better += usize::from(follows || now < before - 1e-9);
        }
        let is_off = is_among(OFF, entry, settings) || COUNTING.contains(&entry.name);
        let is_as_expected = if is_off { better == 0 } else { better * 4 > solved };
        assert!(is_as_expected, "{name}: {better} paths of {solved} were tidied");
    }
    let excepted = [names(DRIFT), FOLLOWING.iter().copied().collect(), names(CUT_IN)];
    assert_eq!([drifted, gave_up, cut_in], excepted, "an exception that nothing needs is to be taken out");
}
