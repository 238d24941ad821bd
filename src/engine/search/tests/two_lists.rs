//! The bidirectional driver against a program with plain lists, under every rule.

use super::*;
use std::collections::BTreeSet;

/// One side as plain lists: nodes with their g, OPEN in the order in which nodes entered it.
struct Lists {
    target: u32,
    open: Vec<(u32, Octile)>,
    closed: Vec<(u32, Octile)>,
    opened: Vec<u32>,
    counters: Counters,
}

impl Lists {
    fn new(root: u32, target: u32) -> Self {
        let counters = Counters { opened: 1, peak_open: 1, ..Counters::default() };
        Self { target, open: vec![(root, Octile::ZERO)], closed: Vec::new(), opened: vec![root], counters }
    }

    fn key(&self, case: &Case, (node, g): (u32, Octile)) -> u64 {
        quantised(g.value() + euclidean_to(&case.grid, self.target)(node))
    }

    /// The place in OPEN of the least f, the first of equals.
    fn best(&self, case: &Case) -> Option<(usize, u64)> {
        self.open.iter().map(|entry| self.key(case, *entry)).enumerate().min_by_key(|(_, f)| *f)
    }

    fn g(&self, node: u32) -> Option<Octile> {
        self.open.iter().chain(&self.closed).find(|(known, _)| *known == node).map(|(_, g)| *g)
    }

    fn has_closed(&self, node: u32) -> bool {
        self.closed.iter().any(|(known, _)| *known == node)
    }

    fn receive(&mut self, node: u32, g: Octile) {
        self.counters.generated += 1;
        if self.has_closed(node) {
            return;
        }
        match self.open.iter_mut().find(|(known, _)| *known == node) {
            Some((_, known)) if g.compare(*known).is_lt() => *known = g,
            Some(_) => {}
            None => {
                self.open.push((node, g));
                self.opened.push(node);
                self.counters.opened += 1;
            }
        }
    }
}

/// Both sides, and the best meeting node so far with the cost of the path over it.
struct Two<'a> {
    case: &'a Case,
    meeting: Meeting,
    end: End,
    sides: [Lists; 2],
    met: Option<(u32, Octile)>,
}

impl<'a> Two<'a> {
    fn new(case: &'a Case, meeting: Meeting, end: End) -> Self {
        let [start, goal] = case.ends;
        let met = (start == goal).then_some((start, Octile::ZERO));
        Self { case, meeting, end, sides: [Lists::new(start, goal), Lists::new(goal, start)], met }
    }

    fn is_over(&self, f: [Option<u64>; 2]) -> bool {
        match self.met {
            Some((_, cost)) if self.meeting == Meeting::OptimalStop => {
                f.iter().any(|f| f.is_none_or(|f| f >= quantised(cost.value())))
            }
            Some(_) => true,
            None => self.sides.iter().zip(f).any(|(side, f)| f.is_none() && side.g(side.target).is_none()),
        }
    }

    fn note(&mut self, node: u32) {
        let [here, there] = [0, 1].map(|side| self.sides[side].g(node));
        let sum = here.zip(there).map(|(here, there)| here.plus(there));
        if let Some(sum) = sum.filter(|sum| self.met.is_none_or(|(_, best)| sum.compare(best).is_lt())) {
            self.met = Some((node, sum));
        }
    }

    /// Takes the entry `at` from OPEN of `side` and deals with it.
    fn step(&mut self, side: usize, at: usize) {
        let (node, g) = self.sides[side].open.remove(at);
        self.sides[side].closed.push((node, g));
        self.sides[side].counters.closed += 1;
        if self.meeting == Meeting::BothClosed && self.sides[1 - side].has_closed(node) {
            return self.note(node);
        }
        self.sides[side].counters.expansions += 1;
        for (to, diagonal) in self.case.moves.from_cell(node) {
            let step = if diagonal { Octile::DIAGONAL } else { Octile::STRAIGHT };
            self.sides[side].receive(to, g.plus(step));
            match self.meeting {
                Meeting::GeneratedAny | Meeting::OptimalStop => self.note(to),
                Meeting::ClosedByOther if self.sides[1 - side].has_closed(to) => self.note(to),
                Meeting::ClosedByOther | Meeting::BothClosed => {}
            }
            if self.end == End::Contact && self.meeting != Meeting::OptimalStop && self.met.is_some() {
                break;
            }
        }
        let Lists { counters, open, .. } = &mut self.sides[side];
        counters.peak_open = counters.peak_open.max(open.len() as u64);
    }

    fn run(mut self, choice: SideChoice) -> Self {
        let mut turn = 0;
        loop {
            let best = [0, 1].map(|side| self.sides[side].best(self.case));
            let f = best.map(|best| best.map(|(_, f)| f));
            let side = match (f, choice) {
                ([Some(_), None], _) => 0,
                ([None, Some(_)], _) => 1,
                ([Some(a), Some(b)], SideChoice::SmallerF) => usize::from(b < a),
                (_, _) => turn,
            };
            let Some((at, _)) = best[side].filter(|_| !self.is_over(f)) else { return self };
            self.step(side, at);
            turn = 1 - side;
        }
    }
}

#[test]
fn every_rule_opens_counts_and_meets_as_a_program_with_plain_lists_does() {
    let mut expansions = 0;
    for case in cases(150, 0.3) {
        for meeting in bidirectional::MEETINGS {
            let choices = [SideChoice::Alternate, SideChoice::SmallerF];
            let ends = [End::Expansion, End::Contact];
            for (choice, end) in choices.into_iter().flat_map(|choice| ends.map(|end| (choice, end))) {
                let place = format!("seed {}, {meeting:?}, {choice:?}, {end:?}", case.seed);
                let towards = |target| Combined { h: euclidean_to(&case.grid, target), combine: sum };
                let estimates = [towards(case.ends[1]), towards(case.ends[0])];
                let graph = &mut GridGraph::new(&case.moves);
                let mut search = Bidirectional::new(Heap::new(Ties::Fifo));
                let rules = BidirectionalRules { end, ..bidirectional::rules(meeting, choice) };
                let report = search.run(graph, &estimates, &mut [(), ()], case.ends, rules);
                let Two { sides, met, .. } = Two::new(&case, meeting, end).run(choice);
                assert_eq!(report.sides, sides.each_ref().map(|side| side.counters), "{place}");
                for (side, lists) in sides.iter().enumerate() {
                    assert_eq!(search.opened(side), lists.opened, "{place}, side {side}");
                }
                let opened: BTreeSet<u32> = sides.iter().flat_map(|lists| lists.opened.clone()).collect();
                assert_eq!(search.opened_distinct(), opened.len() as u64, "{place}");
                assert_eq!(report.meeting, met.map(|(node, _)| node), "{place}");
                assert_eq!(report.outcome.route().map(|r| r.cost), met.map(|(_, cost)| cost), "{place}");
                expansions += sides.iter().map(|side| side.counters.expansions).sum::<u64>();
            }
        }
    }
    assert!(expansions > 30_000, "only {expansions} expansions compared");
}
