use super::*;
use crate::geometry::Vec2;
use crate::geometry::planar::Circle;
use crate::kinematics::planar_2r::Planar2r;
use crate::search::{
    Combined, FirstWayAstar, GridGraph, Heap, Octile, Rules, ScaledOctile, Search, SideInputs, Ties, Update,
    euclidean_to, sum,
};
use crate::space::{ArmRules, ArmWorld, HopRule, Obstacle, TipLattice, reproduced_rules as rules};

/// The workspace with discs about `centers`.
fn world(rules: &ArmRules, centers: &[[f64; 2]], diameter_cm: f64) -> ArmWorld {
    let disc = |center: &[f64; 2]| Circle::new(Vec2::from(*center), diameter_cm / 2.0).unwrap();
    ArmWorld::new(*rules, centers.iter().map(|center| Obstacle::Circle(disc(center))).collect())
}

const LENGTHS: [Octile; 2] = [Octile { straight: 29, diagonal: 31 }, Octile { straight: 17, diagonal: 38 }];

fn scaled(lengths: [Octile; 2]) -> [u32; 2] {
    lengths.map(ScaledOctile::scaled)
}

fn worlds() -> [ArmWorld; 2] {
    let one: &[[f64; 2]] = &[[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]];
    let two: &[[f64; 2]] = &[[41.0, 10.0], [7.0, 40.0], [-16.0, 33.0]];
    [one, two].map(|centers| world(&rules(HopRule::EndPoints), centers, 10.0))
}

/// One grid a case.
fn grids() -> [Vec<Moves>; 2] {
    worlds().map(|world| vec![world.eight_moves()])
}

fn hits_of(targets: &Targets, grids: &[Vec<Moves>; 2], rule: Match) -> Vec<Vec<bool>> {
    targets.met(grids, rule).into_iter().map(|met| met.hits).collect()
}

fn points(pairs: &[Pair]) -> Vec<[[f64; 2]; 2]> {
    let point = |cell: &u32| -> [f64; 2] { rules(HopRule::EndPoints).lattice.point(*cell).into() };
    pairs.iter().map(|[a, b]| [point(a), point(b)]).collect()
}

#[test]
fn circles_with_contact_forbidden_leave_the_two_pairs_that_two_other_programs_found() {
    let found = pairs(&grids(), &scaled(LENGTHS), Match::ByPlace);
    assert_eq!(found.len(), 1);
    assert_eq!(points(&found[0]), [[[49.0, 3.0], [0.0, 45.0]], [[49.0, 3.0], [2.0, 45.0]]]);
}

#[test]
fn every_target_that_is_hit_has_a_pair_and_the_printed_one_is_among_them() {
    let grids = grids();
    let targets = Targets::new(LENGTHS, 1.0);
    let Met { hits, attainable } = &targets.met(&grids, Match::ByPlace)[0];
    let mut checked = 0;
    let mut met = 0;
    let mut attained = 0;
    for (a, first) in (0..).zip(&targets.lengths[0]).step_by(7) {
        for (b, second) in (0..).zip(&targets.lengths[1]).step_by(11) {
            let found = pairs(&grids, &scaled([*first, *second]), Match::ByPlace);
            let is_hit = hits[targets.number(a, b)];
            assert_eq!(!found[0].is_empty(), is_hit, "{first:?} and {second:?}");
            (checked, met) = (checked + 1, met + usize::from(is_hit));
            let has = |case: usize, length: &Octile| {
                let alone = [grids[case].clone()];
                !pairs(&alone, &[ScaledOctile::scaled(*length)], Match::ByPlace)[0].is_empty()
            };
            let is_attainable = first.straight % 2 == second.straight % 2 && has(0, first) && has(1, second);
            assert_eq!(attainable[targets.number(a, b)], is_attainable, "{first:?} and {second:?}");
            attained += usize::from(is_attainable);
        }
    }
    assert!(checked > 20 && met < attained && attained < checked, "{met} of {attained} of {checked}");
    let [one, two] = [0, 1].map(|case| targets.place(case, scaled(LENGTHS)[case]).unwrap());
    assert!(hits[targets.number(one, two)]);
    assert!(hits.iter().filter(|hit| **hit).count() < targets.count());
}

#[test]
fn searches_from_outside_a_ball_find_the_pairs_that_searches_from_all_cells_do() {
    let grids = many();
    let wanted = [[10, 14], [9, 13], [12, 10]];
    let mut found_some = 0;
    for lengths in wanted.map(|[straight, diagonal]| scaled([Octile { straight, diagonal }; 2])) {
        let found = pairs(&grids, &lengths, Match::ByPlace);
        for place in [0, 40, 65] {
            let grids = alone(&grids, [place; 2]).concat();
            let distances = [0, 1].map(|case: usize| Small::shortest(&grids[case]));
            let cells = 0..grids[0].cell_count();
            let all = cells.clone().flat_map(|one| (one + 1..cells.end).map(move |other| [one, other]));
            let is_pair = |[one, other]: &Pair| {
                (0..2).all(|case| distances[case][*one as usize][*other as usize] == Some(lengths[case]))
            };
            assert_eq!(found[place], all.filter(is_pair).collect::<Vec<_>>(), "grid {place}, {lengths:?}");
            found_some += found[place].len();
        }
    }
    assert!(found_some > 20, "only {found_some} pairs");
    for (grids, lengths) in [(grids, scaled(Small::LENGTHS)), (self::grids(), scaled(LENGTHS))] {
        let cases = choices::batches(&grids, Match::ByPlace).remove(0).1;
        let can_be_left = |cell: &u32| grids.iter().flatten().any(|moves| moves.mask(*cell) != 0);
        let cells = (0..cases[0].cell_count()).filter(can_be_left).count();
        let starts = Starts::new(&cases, &lengths).cells().filter(can_be_left).count();
        assert!(starts < cells * 3 / 4, "{starts} searches for {cells} cells");
    }
}

#[test]
fn targets_have_hops_of_equal_parity() {
    let targets = Targets::new(LENGTHS, 2.0);
    let all = targets.lengths[0].iter().flat_map(|a| targets.lengths[1].iter().map(move |b| (a, b)));
    let consistent = all.filter(|(a, b)| a.straight % 2 == b.straight % 2).count();
    assert_eq!(targets.count(), consistent);
    assert!(consistent > 1_000);
}

/// What the grids of a case at `places` come to alone.
fn alone(grids: &[Vec<Moves>; 2], places: [usize; 2]) -> [Vec<Moves>; 2] {
    [0, 1].map(|case| vec![grids[case][places[case]].clone()])
}

/// Grids of a quarter of the workspace with a disc at different places: 70 in one case and in the other, so that one
/// search does not hold them. After six of them they come again.
fn many() -> [Vec<Moves>; 2] {
    let small = Small::new();
    let shifted = |case: usize| {
        let [x, y] = small.centers[case];
        let of_place = |place: usize| {
            let center = [x + (place % 3) as f64, y - (place % 2) as f64];
            world(&small.rules, &[center], 6.0).eight_moves()
        };
        (0..70).map(of_place).collect()
    };
    [shifted(0), shifted(1)]
}

#[test]
fn grids_matched_by_place_are_those_asked_one_at_a_time() {
    let grids = many();
    let targets = Targets::new(Small::LENGTHS, 0.75);
    let hits = hits_of(&targets, &grids, Match::ByPlace);
    let asked = [[10, 14], [9, 13], [12, 10]];
    let asked = asked.map(|[straight, diagonal]| scaled([Octile { straight, diagonal }; 2]));
    let found = asked.map(|lengths| pairs(&grids, &lengths, Match::ByPlace));
    let mut different = std::collections::BTreeSet::new();
    for place in [0, 31, 63, 64, 69] {
        let grids = alone(&grids, [place; 2]);
        for (lengths, found) in asked.iter().zip(&found) {
            assert_eq!(found.len(), 70);
            assert_eq!(found[place], pairs(&grids, lengths, Match::ByPlace)[0], "grid {place}, {lengths:?}");
            assert!(found[place].is_sorted());
            different.insert(found[place].clone());
        }
        assert!(hits[place] == hits_of(&targets, &grids, Match::ByPlace)[0], "grid {place}: other targets");
    }
    assert!(hits.len() == 70 && different.len() > 8, "only {} answers differ", different.len());
}

#[test]
fn grids_matched_freely_give_what_any_two_of_them_give() {
    let many = many();
    let targets = Targets::new(Small::LENGTHS, 0.75);
    let lengths = scaled(Small::LENGTHS);
    // All grids of one case and three of the other, so that every two can be tried alone.
    let grids = [many[0].clone(), [3, 32, 66].map(|place| many[1][place].clone()).to_vec()];
    let found = pairs(&grids, &lengths, Match::Freely);
    let hits = hits_of(&targets, &grids, Match::Freely);
    assert_eq!([found.len(), hits.len()], [1, 1]);
    let mut pairs_of_any = std::collections::BTreeSet::new();
    let mut hits_of_any = targets.none();
    for one in 0..6 {
        for two in 0..3 {
            let grids = alone(&grids, [one, two]);
            pairs_of_any.extend(pairs(&grids, &lengths, Match::ByPlace).concat());
            hits_of_any = union(hits_of_any, hits_of(&targets, &grids, Match::ByPlace).concat());
        }
    }
    assert_eq!(found[0], pairs_of_any.into_iter().collect::<Vec<_>>());
    assert!(hits[0] == hits_of_any, "other targets");
    let first = hits_of(&targets, &alone(&grids, [0, 0]), Match::ByPlace).concat();
    assert!(hits[0] != first, "one choice meets as many targets as all");
}

const ORDERS: [Ties; 3] = [Ties::Fifo, Ties::Lifo, Ties::LargerG];

/// The path length that the kernel's A* returns if it never lowers open nodes.
fn kernel_length(ties: Ties, world: &ArmWorld, moves: &Moves, [start, goal]: Pair) -> Option<Octile> {
    let estimate = Combined { h: euclidean_to(world.grid(), goal), combine: sum };
    let terms = SideInputs {
        graph: &mut GridGraph::new(moves),
        estimate: &estimate,
        observer: &mut (),
        update: Update { lower_open: false, reopen_closed: false },
    };
    let search = &mut Search::new(Heap::new(ties));
    let report = search.run(terms, start, |cell| cell == goal, Rules::default(), &mut ());
    report.outcome.route().map(|route| route.cost)
}

#[test]
fn where_open_nodes_are_never_lowered_lengths_between_many_pairs_are_the_kernels() {
    for (world, length) in worlds().into_iter().zip(scaled(LENGTHS)) {
        let moves = world.eight_moves();
        let most = length + 8 * ScaledOctile::STRAIGHT;
        let mut flood = search(&moves);
        let mut searches = ORDERS.map(|ties| (ties, FirstWayAstar::new(&moves, ties)));
        let mut checked = 0;
        let mut longer = 0;
        for goal in (0..moves.cell_count()).step_by(61) {
            for (_, search) in &mut searches {
                search.aim(goal);
            }
            let mut starts = Vec::new();
            flood.flood(goal, most, |cell, cost| starts.push((cell, cost)));
            for (start, shortest) in starts.into_iter().rev().step_by(13).take(60) {
                for (ties, search) in &mut searches {
                    let truth = kernel_length(*ties, &world, &moves, [start, goal]).unwrap();
                    let scaled = ScaledOctile::scaled(truth);
                    let expected = (scaled <= most).then_some(truth);
                    assert_eq!(search.length(start, most), expected, "{ties:?}, {start} to {goal}");
                    assert!(scaled >= shortest, "{ties:?}, {start} to {goal}: too short");
                    (checked, longer) = (checked + 1, longer + u32::from(scaled > shortest));
                }
            }
        }
        assert!(checked > 3_000 && longer > 300, "{longer} of {checked} are not shortest");
    }
}

/// A quarter of the reproduced workspace with one obstacle in each case, and the question about it.
struct Small {
    rules: ArmRules,
    centers: [[f64; 2]; 2],
    worlds: [ArmWorld; 2],
    moves: [Moves; 2],
    targets: Targets,
}

/// How far below a target shortest lengths may be there, in steps.
const EXCESS: f64 = 1.0;

/// The least shortest length from which a length may be met.
fn least(length: u32) -> u32 {
    length.saturating_sub(ScaledOctile::STRAIGHT)
}

impl Small {
    const LENGTHS: [Octile; 2] =
        [Octile { straight: 10, diagonal: 14 }, Octile { straight: 10, diagonal: 13 }];

    fn new() -> Self {
        let rules = ArmRules {
            arm: Planar2r::new(15.0, 10.0).unwrap(),
            lattice: TipLattice::new([-25.0, 25.0], [0.0, 25.0], 1.0).unwrap(),
            inner_radius_cm: 10.0,
            ..rules(HopRule::EndPoints)
        };
        let centers = [[0.0, 20.0], [10.0, 18.0]];
        let worlds = centers.map(|center| world(&rules, &[center], 6.0));
        let moves = worlds.each_ref().map(ArmWorld::eight_moves);
        Self { rules, centers, worlds, moves, targets: Targets::new(Self::LENGTHS, 0.75) }
    }

    /// The shortest lengths between all cells, by start and goal.
    fn shortest(moves: &Moves) -> Vec<Vec<Option<u32>>> {
        let mut flood = search(moves);
        let cells = moves.cell_count();
        let from = |start| {
            let mut costs = vec![None; cells as usize];
            flood.flood(start, u32::MAX / 2, |cell, cost| costs[cell as usize] = Some(cost));
            costs
        };
        (0..cells).map(from).collect()
    }

    /// Pairs with their shortest lengths. Those whose lengths are out of reach of every target cannot meet one: they are
    /// left out.
    fn pairs_in_reach(&self) -> Vec<(Pair, [u32; 2])> {
        let shortest = self.moves.each_ref().map(Self::shortest);
        let targets = &self.targets;
        let cells = self.moves[0].cell_count();
        let pairs = (0..cells).flat_map(|start| (0..cells).map(move |goal| [start, goal]));
        let with_costs = pairs.filter_map(|pair| {
            let cost = |case: usize| {
                shortest[case][pair[0] as usize][pair[1] as usize]
                    .filter(|cost| (least(targets.bounds(case)[0])..=targets.bounds(case)[1]).contains(cost))
            };
            Some((pair, [cost(0)?, cost(1)?]))
        });
        with_costs.collect()
    }

    /// The pairs that meet a target, with the kernel's lengths, and for how many these are not shortest.
    fn met(&self, ties: Ties, pairs: &[(Pair, [u32; 2])]) -> (Vec<([Octile; 2], Pair)>, usize) {
        let mut met = Vec::new();
        let mut longer = 0;
        for (pair, costs) in pairs {
            let lengths = [0, 1].map(|case| {
                let length = kernel_length(ties, &self.worlds[case], &self.moves[case], *pair);
                length.expect("the flood came to the goal")
            });
            let scaled = lengths.map(ScaledOctile::scaled);
            let is_target = |case: usize| self.targets.place(case, scaled[case]).is_some();
            if (0..2).all(|case| is_target(case) && costs[case] >= least(scaled[case])) {
                met.push((lengths, *pair));
                longer += usize::from(scaled != *costs);
            }
        }
        (met, longer)
    }
}

#[test]
fn where_open_nodes_are_never_lowered_pairs_and_targets_are_those_of_the_kernels_lengths() {
    let small = Small::new();
    let targets = &small.targets;
    let moves = &small.moves;
    let pairs = small.pairs_in_reach();
    let mut of_orders = Vec::new();
    for ties in ORDERS {
        let (met, longer) = small.met(ties, &pairs);
        let mut hits = targets.none();
        for (lengths, _) in &met {
            targets.mark(&mut hits, lengths.map(ScaledOctile::scaled));
        }
        let number = hits.iter().filter(|hit| **hit).count();
        assert!(longer > 20 && number > 20 && number < targets.count(), "{ties:?}: {longer}, {number}");
        assert!(
            NeverLowered::hits(targets, moves, EXCESS, &[ties]) == [hits.as_slice()],
            "{ties:?}: other targets"
        );
        for (lengths, _) in met.iter().step_by(met.len() / 4) {
            let found = NeverLowered::find(moves, &scaled(*lengths), EXCESS, &[ties]).remove(0);
            let pairs: Vec<Pair> =
                met.iter().filter(|(of, _)| of == lengths).map(|(_, pair)| *pair).collect();
            assert_eq!(found.pairs, pairs, "{ties:?}, {lengths:?}");
            assert!(found.candidates > pairs.len(), "{ties:?}: {} candidates", found.candidates);
            let together = NeverLowered::find(moves, &scaled(*lengths), EXCESS, &ORDERS);
            let place = ORDERS.iter().position(|order| *order == ties).unwrap();
            assert_eq!(together[place], found, "{ties:?}, {lengths:?}: beside other orders");
        }
        of_orders.push(hits);
    }
    assert!(NeverLowered::hits(targets, moves, EXCESS, &ORDERS) == of_orders, "beside other orders");
    assert!(of_orders[0] != of_orders[1], "the order among equals does not matter here");
    let shortest = hits_of(targets, &moves.each_ref().map(|moves| vec![moves.clone()]), Match::ByPlace);
    assert!(of_orders[0] != shortest[0], "shortest lengths meet the same targets");
}
