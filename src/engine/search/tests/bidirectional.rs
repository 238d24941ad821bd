//! The bidirectional driver under every rule.

use super::*;

pub(super) const MEETINGS: [Meeting; 4] =
    [Meeting::GeneratedAny, Meeting::ClosedByOther, Meeting::BothClosed, Meeting::OptimalStop];

pub(super) fn rules(meeting: Meeting, choice: SideChoice) -> BidirectionalRules {
    BidirectionalRules {
        meeting,
        end: End::Expansion,
        choice,
        update: Update::default(),
        max_expansions: u64::MAX,
    }
}

fn run(case: &Case, rules: BidirectionalRules) -> BidirectionalReport<Octile> {
    let towards = |target| Combined { h: euclidean_to(&case.grid, target), combine: sum };
    let estimates = [towards(case.ends[1]), towards(case.ends[0])];
    let graph = &mut GridGraph::new(&case.moves);
    Bidirectional::new(Heap::default()).run(graph, &estimates, &mut [(), ()], case.ends, rules)
}

#[test]
fn every_rule_solves_what_can_be_solved_and_the_optimal_stop_is_optimal() {
    let mut solved = 0;
    let mut longer = [0; 4];
    let mut count = 0;
    for case in cases(400, 0.35) {
        let best = astar(&case.grid, &case.moves, case.ends).outcome.route().map(|route| route.cost.value());
        for (index, meeting) in MEETINGS.into_iter().enumerate() {
            for choice in [SideChoice::Alternate, SideChoice::SmallerF] {
                let report = run(&case, rules(meeting, choice));
                let place = format!("seed {}, {meeting:?}, {choice:?}", case.seed);
                let got = report.outcome.route().map(|route| walked(&case, route));
                assert_eq!(got.is_some(), best.is_some(), "{place}");
                let (Some(got), Some(best)) = (got, best) else { continue };
                assert!(got > best - 1e-9, "{place}: {got} below {best}");
                longer[index] += u32::from(got > best + 1e-9);
                let on_path = report.outcome.route().unwrap().nodes.contains(&report.meeting.unwrap());
                assert!(on_path, "{place}: the meeting node is not on the path");
            }
        }
        count += 1;
        solved += u32::from(best.is_some());
    }
    assert!((count / 4..count).contains(&solved), "one-sided sample: {solved} of {count} solvable");
    assert_eq!(longer[3], 0, "the optimal stop was longer {} times", longer[3]);
    assert!(longer[..3].iter().all(|&times| times > 2), "the other rules were longer {longer:?} times");
}

#[test]
fn sides_alternate_and_the_budget_holds_for_both_together() {
    for case in cases(60, 0.2) {
        let full = run(&case, rules(Meeting::BothClosed, SideChoice::Alternate));
        let made = full.sides.map(|side| side.expansions);
        if full.outcome.route().is_some() {
            assert!(made[0].abs_diff(made[1]) <= 1, "seed {}: {made:?}", case.seed);
        }
        let Some(max_expansions) = (made[0] + made[1]).checked_sub(1) else { continue };
        let limited = run(
            &case,
            BidirectionalRules { max_expansions, ..rules(Meeting::BothClosed, SideChoice::Alternate) },
        );
        if limited.outcome == Outcome::BudgetSpent {
            assert_eq!(limited.sides.map(|side| side.expansions).iter().sum::<u64>(), max_expansions);
            assert_eq!(limited.meeting, None);
        } else {
            // Under this rule the last expansion can only have been a dead end or the meeting itself.
            assert_eq!(limited.outcome, full.outcome, "seed {}", case.seed);
        }
    }
}

#[test]
fn closings_name_the_side_and_what_was_opened_by_then() {
    let mut both = 0;
    for case in cases(120, 0.2) {
        let rules = rules(Meeting::ClosedByOther, SideChoice::Alternate);
        let towards = |target| Combined { h: euclidean_to(&case.grid, target), combine: sum };
        let closings = Closings::default();
        let mut search = Bidirectional::new(Heap::default());
        let mut observers = [0, 1].map(|side| closings.one_side(side));
        let estimates = [towards(case.ends[1]), towards(case.ends[0])];
        let graph = &mut GridGraph::new(&case.moves);
        let report = search.run(graph, &estimates, &mut observers, case.ends, rules);
        let seed = case.seed;
        let closings = closings.all();
        for (place, Closing { node, side, opened }) in closings.iter().enumerate() {
            let by_then = |side: usize| &search.opened(side)[..opened[side] as usize];
            assert_eq!(*side as usize, place % 2, "seed {seed}: sides take turns");
            assert!(by_then(*side as usize).contains(node), "seed {seed}: closed before it was opened");
            let other = closings[..place].iter().filter(|one| one.side != *side);
            assert!(other.map(|one| one.node).all(|node| by_then(1 - *side as usize).contains(&node)));
        }
        for side in [0, 1] {
            let count = closings.iter().filter(|one| one.side == side).count() as u64;
            assert_eq!(count, report.sides[side as usize].closed, "seed {seed}");
        }
        both += u32::from(closings.len() > 10);
    }
    assert!(both > 30, "too few searches of some length: {both}");
}

#[test]
fn a_start_that_is_the_goal_is_met_at_once() {
    for case in cases(20, 0.2) {
        let case = Case { ends: [case.ends[0]; 2], ..case };
        for meeting in MEETINGS {
            let report = run(&case, rules(meeting, SideChoice::Alternate));
            let route = Route { nodes: vec![case.ends[0]], cost: Octile::ZERO };
            assert_eq!(report.outcome, Outcome::Solved(route), "seed {}, {meeting:?}", case.seed);
            assert_eq!(report.sides.map(|side| side.expansions), [0, 0]);
        }
    }
}
