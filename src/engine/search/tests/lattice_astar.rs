//! A* over a lattice with a wide neighbourhood: the specialisation is the general form.

use super::*;
use base::grid::{Columns, Offsets};
use std::collections::BTreeSet;
use world::space::{ArmRules, ArmWorld, HopRule, Obstacle};

const ORDERS: [Ties; 2] = [Ties::Fifo, Ties::Lifo];

fn neighbourhoods() -> Vec<Offsets> {
    let of_size = |radius: u8| [Offsets::square(radius), Offsets::disc(radius), Offsets::octagon(radius)];
    let large = [Offsets::octagon_on_corners(7), Offsets::square(8), Offsets::disc(20)];
    (1..=6).flat_map(of_size).chain(large).collect()
}

/// Hops that a rule of their own decides.
struct Hops<F>(F, [i32; 2]);

impl<F: Fn(u32, [i32; 2]) -> bool> Successors for Hops<F> {
    fn expands(&mut self, cell: u32) {
        self.1 = [cell as i32, i32::MAX];
    }

    fn kept(&mut self, cell: u32, dx: i32, reach: i32, free: u64) -> u64 {
        let [expected, before] = self.1;
        assert!(expected == cell as i32 && dx < before, "column {dx} of cell {cell} comes out of order");
        self.1[1] = dx;
        let is_kept = |bit: &i32| free >> bit & 1 == 1 && self.0(cell, [dx, reach - bit]);
        (0..=2 * reach).filter(is_kept).fold(0, |kept, bit| kept | 1 << bit)
    }
}

/// What a query and its lattice are.
struct Query<'a> {
    grid: &'a Grid2,
    offsets: &'a Offsets,
    spacing: f64,
    ends: [u32; 2],
    lower_open: bool,
    max_expansions: u64,
    /// What straight and diagonal steps count: the longer and the shorter of the ways along the axes, and the line.
    weights: [f64; 3],
}

/// The straight line; the ways along both axes; eight neighbours. The last two are inconsistent on wide neighbourhoods.
const HEURISTICS: [[f64; 3]; 3] =
    [[0.0, 0.0, 1.0], [1.0, 1.0, 0.0], [1.0, std::f64::consts::SQRT_2 - 1.0, 0.0]];

impl Query<'_> {
    fn h(&self) -> impl Fn(u32) -> f64 {
        let line = euclidean_to(self.grid, self.ends[1]);
        let spacing = self.spacing;
        let [longer, shorter, straight] = self.weights;
        let width = self.grid.width();
        let goal = self.grid.xy(self.ends[1]);
        move |cell| {
            let way = [(cell % width) as i32 - goal[0], (cell / width) as i32 - goal[1]]
                .map(i32::abs)
                .map(f64::from);
            let along = longer * way[0].max(way[1]) + shorter * way[0].min(way[1]);
            spacing * (along + straight * line(cell))
        }
    }

    fn general(
        &self,
        search: &mut Search<f64, Heap>,
        may_hop: impl Fn(u32, [i32; 2]) -> bool,
    ) -> (Report<f64>, ListScans) {
        let mut scans = ListScans::default();
        let terms = SideInputs {
            graph: &mut LatticeGraph::new(self.grid, self.offsets, self.spacing, may_hop),
            estimate: &Combined { h: self.h(), combine: sum },
            observer: &mut scans,
            update: Update { lower_open: self.lower_open, ..Update::default() },
        };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: self.max_expansions };
        let [start, goal] = self.ends;
        (search.run(terms, start, |cell| cell == goal, rules, &mut ()), scans)
    }

    fn special(
        &self,
        search: &mut LatticeAstar,
        columns: &Columns,
        successors: &mut impl Successors,
    ) -> (Report<f64>, ListScans) {
        let &Self { spacing, ends, lower_open, max_expansions, .. } = self;
        let h = self.h();
        search.run(LatticeQuery {
            columns,
            spacing,
            successors,
            h: |[x, y]: [u32; 2]| h(y * columns.width() + x),
            ends,
            lower_open,
            max_expansions,
        })
    }
}

/// What a query ended in, with the cost to the last bit.
fn result_bits(
    (report, scans): &(Report<f64>, ListScans),
) -> (Option<(&[u32], u64)>, bool, Counters, ListScans) {
    let route = report.outcome.route().map(|route| (&route.nodes[..], route.cost.to_bits()));
    (route, report.outcome == Outcome::BudgetSpent, report.counters, *scans)
}

/// A hop is refused by chance, one of six.
fn by_chance(from: u32, [dx, dy]: [i32; 2]) -> bool {
    let mixed = (u64::from(from) << 16 ^ (dx * 64 + dy) as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    !(mixed >> 32).is_multiple_of(6)
}

#[test]
fn the_specialised_search_has_the_path_cost_and_counters_of_the_general_one() {
    let mut solved = 0;
    let mut spent = 0;
    let mut lowered = 0;
    let mut count = 0;
    for offsets in neighbourhoods() {
        for ties in ORDERS {
            let mut special = LatticeAstar::new(&offsets, ties).unwrap();
            let mut general = Search::new(Heap::new(ties));
            // One memory for grids of many sizes.
            for case in cases(24, 0.45) {
                let columns = Columns::new(&case.grid);
                let mut costs = Vec::new();
                for (lower_open, max_expansions) in [(true, u64::MAX), (false, u64::MAX), (true, 5)] {
                    let spacing = if case.seed % 2 == 0 { 1.0 } else { 0.3 };
                    let grid = &case.grid;
                    let offsets = &offsets;
                    let ends = case.ends;
                    let weights = HEURISTICS[(case.seed / 2 % 3) as usize];
                    let query = Query { grid, offsets, spacing, ends, lower_open, max_expansions, weights };
                    let mut hops = Hops(by_chance, [0; 2]);
                    let (truth, got) = if case.seed % 3 == 0 {
                        let truth = query.general(&mut general, |_, _| true);
                        (truth, query.special(&mut special, &columns, &mut ()))
                    } else {
                        let truth = query.general(&mut general, by_chance);
                        (truth, query.special(&mut special, &columns, &mut hops))
                    };
                    assert_eq!(
                        result_bits(&got),
                        result_bits(&truth),
                        "seed {}, {ties:?}, {offsets:?}",
                        case.seed
                    );
                    solved += u32::from(got.0.outcome.route().is_some());
                    spent += u32::from(got.0.outcome == Outcome::BudgetSpent);
                    costs.push(got.0.outcome.route().map(|route| route.cost));
                    count += 1;
                }
                lowered += u32::from(costs[1] > costs[0] && costs[0].is_some());
            }
        }
    }
    assert!((count / 3..count).contains(&solved), "one-sided sample: {solved} of {count} solved");
    assert!(
        spent > 100 && lowered > 20,
        "{spent} of {count} spent their budget, {lowered} gained by lowering"
    );
}

/// The hops of an arm.
struct ArmHops<'a>(&'a ArmWorld);

impl Successors for ArmHops<'_> {
    fn kept(&mut self, cell: u32, dx: i32, reach: i32, free: u64) -> u64 {
        self.0.hops(cell, dx, reach, free)
    }
}

/// The obstacles of case 1.
const CASE_1: [[f64; 2]; 4] = [[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]];

fn workspace(hop: HopRule, corner_rule: CornerRule, places: [[f64; 2]; 4]) -> ArmWorld {
    let disc = |at: [f64; 2]| {
        Obstacle::Circle(world::geometry::planar::Circle::new(at.into(), 5.0).expect("a disc has a size"))
    };
    ArmWorld::new(ArmRules { corner_rule, ..reproduced_rules(hop) }, places.map(disc).to_vec())
}

const HOP_RULES: [HopRule; 3] = [HopRule::EndPoints, HopRule::Continuous, HopRule::TipLine];

#[test]
fn an_arm_hops_a_column_at_a_time_as_it_does_one_by_one() {
    let mut solved = 0;
    let mut refused = 0;
    for (hop, rule) in HOP_RULES.into_iter().flat_map(|hop| RULES.map(|rule| (hop, rule))) {
        // Two worlds, so that what one learns of its hops does not serve the other.
        let [world, other] = [0, 1].map(|_| workspace(hop, rule, CASE_1));
        let grid = world.grid();
        let seed = 7;
        let free: Vec<u32> = (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)).collect();
        let mut stream = seed::stream(seed);
        for offsets in [1, 2, 3, 4].map(Offsets::square).into_iter().chain([4, 6, 7].map(Offsets::disc)) {
            for ties in ORDERS {
                let mut special = LatticeAstar::new(&offsets, ties).unwrap();
                let mut general = Search::new(Heap::new(ties));
                for (draw, lower_open) in [true, true, true, false].into_iter().enumerate() {
                    let ends = [0, 1].map(|_| free[stream.random_range(0..free.len())]);
                    let offsets = &offsets;
                    let weights = HEURISTICS[draw % 3];
                    let spacing = 1.0;
                    let max_expansions = u64::MAX;
                    let query = Query { grid, offsets, spacing, ends, lower_open, max_expansions, weights };
                    let truth = query.general(&mut general, |from, by| other.may_step(from, by));
                    let got = query.special(&mut special, world.columns(), &mut ArmHops(&world));
                    assert_eq!(
                        result_bits(&got),
                        result_bits(&truth),
                        "seed {seed}, {hop:?}, {rule:?}, {ties:?}, draw {draw}, {ends:?}"
                    );
                    solved += u32::from(got.0.outcome.route().is_some());
                    let any = query.special(&mut special, world.columns(), &mut ());
                    refused += u32::from(any.0.counters != got.0.counters);
                }
            }
        }
    }
    assert!(solved > 250 && refused > 100, "{solved} solved, {refused} with hops refused");
}

/// The directions of a neighbourhood's steps, each by its shortest step.
fn directions(offsets: &Offsets) -> BTreeSet<[i32; 2]> {
    let factor = |a: i32, b: i32| (1..=a.abs().max(b.abs())).rev().find(|f| a % f == 0 && b % f == 0);
    offsets.steps().iter().map(|&[x, y]| [x, y].map(|part| part / factor(x, y).unwrap_or(1))).collect()
}

// A longer hop along a direction that hits nothing is a chain of its shortest hops, which are as long together and hit nothing.
#[test]
fn a_square_and_a_disc_with_as_many_points_give_paths_of_equal_length_where_hops_hit_nothing() {
    let seed = 48;
    let mut stream = seed::stream(seed);
    let (mut solved, mut shorter) = (0, 0);
    for (square, disc) in [(3, 4), (4, 5)] {
        let both = [Offsets::square(square), Offsets::disc(disc)];
        assert_eq!(both[0].steps().len(), both[1].steps().len());
        assert_eq!(directions(&both[0]), directions(&both[1]), "square {square}, disc {disc}");
        let mut searches = both
            .each_ref()
            .map(|offsets| LatticeAstar::new(offsets, Ties::Fifo).expect("first in first out"));
        for draw in 0..24 {
            let places = [0; 4].map(|_| [stream.random_range(-40.0..40.0), stream.random_range(10.0..45.0)]);
            let [swept, jumping] =
                [HopRule::TipLine, HopRule::EndPoints].map(|hop| workspace(hop, CornerRule::Allow, places));
            let grid = swept.grid();
            let free: Vec<u32> = (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)).collect();
            let ends = [0, 1].map(|_| free[stream.random_range(0..free.len())]);
            let mut costs = |world: &ArmWorld| {
                [0, 1].map(|of: usize| {
                    let query = Query {
                        grid,
                        offsets: &both[of],
                        spacing: 1.0,
                        ends,
                        lower_open: true,
                        max_expansions: u64::MAX,
                        weights: HEURISTICS[0],
                    };
                    let found = query.special(&mut searches[of], world.columns(), &mut ArmHops(world)).0;
                    found.outcome.route().map(|route| route.cost)
                })
            };
            let [of_square, of_disc] = costs(&swept).map(|cost| cost.unwrap_or(f64::INFINITY));
            let text = format!("seed {seed}, draw {draw}, {ends:?}: square {of_square}, disc {of_disc}");
            assert!(of_square == of_disc || (of_square - of_disc).abs() < 1e-9, "{text}");
            let [of_square, of_disc] = costs(&jumping).map(|cost| cost.unwrap_or(f64::INFINITY));
            solved += u32::from(of_disc.is_finite());
            shorter += u32::from(of_square < of_disc - 1e-9);
        }
    }
    assert!(
        solved > 24 && shorter > 0,
        "{solved} solved, the square shorter on {shorter} where hops may jump"
    );
}

#[test]
fn a_graph_by_columns_has_the_successors_of_one_by_steps_in_their_order() {
    for case in cases(60, 0.4) {
        let columns = Columns::new(&case.grid);
        let mut any = ();
        for offsets in neighbourhoods() {
            let mut by_columns = ColumnGraph::new(&columns, &offsets, 0.7, &mut any);
            let mut by_steps = LatticeGraph::new(&case.grid, &offsets, 0.7, |_, _| true);
            for cell in case.ends {
                let mut found = [Vec::new(), Vec::new()];
                by_columns.successors(cell, |to, cost| found[0].push((to, cost.to_bits())));
                by_steps.successors(cell, |to, cost| found[1].push((to, cost.to_bits())));
                assert_eq!(found[0], found[1], "seed {}, {cell}, {offsets:?}", case.seed);
            }
        }
    }
}

#[test]
fn what_the_specialised_search_does_not_know_is_refused() {
    assert!(LatticeAstar::new(&Offsets::square(1), Ties::LargerG).is_none());
    assert!(LatticeAstar::new(&Offsets::square(21), Ties::Fifo).is_none());
    assert!(LatticeAstar::new(&Offsets::square(20), Ties::Fifo).is_some());
}
