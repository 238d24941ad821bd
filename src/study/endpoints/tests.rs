use super::*;
use crate::geometry::planar::Touch;
use crate::kinematics::planar_2r::{ElbowRule, Planar2r};
use crate::search::{
    Combined, FirstWayAstar, GridGraph, Heap, Rules, Search, Terms, Update, euclidean_to, sum,
};
use crate::space::{HopRule, TipLattice};

pub(super) fn base() -> ArmRules {
    ArmRules {
        arm: Planar2r::new(30.0, 20.0).unwrap(),
        elbow: ElbowRule::NegativeQ2,
        lattice: TipLattice::new([-50.0, 50.0], [0.0, 50.0], 1.0).unwrap(),
        inner_radius_cm: 20.0,
        touch: Touch::Contact,
        corner_rule: CornerRule::Allow,
        hop: HopRule::EndPoints,
    }
}

pub(super) fn cases() -> [Case; 2] {
    [
        Case { obstacles_cm: vec![[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]], hops: [29, 31] },
        Case { obstacles_cm: vec![[41.0, 10.0], [7.0, 40.0], [-16.0, 33.0]], hops: [17, 38] },
    ]
}

fn variant(text: &str) -> Variant {
    toml::from_str(&format!("label = 'v'\ndiameter_cm = 10\n{text}")).unwrap()
}

fn moves(variant: &Variant) -> [Moves; 2] {
    cases().map(|case| variant.world(&base(), &case, ShapeSetting::Circle).unwrap().eight_moves())
}

fn points(pairs: &[Pair]) -> Vec<[[f64; 2]; 2]> {
    let point = |cell: &u32| -> [f64; 2] { base().lattice.point(*cell).into() };
    pairs.iter().map(|[a, b]| [point(a), point(b)]).collect()
}

#[test]
fn circles_with_contact_forbidden_leave_the_two_pairs_that_two_other_programs_found() {
    let moves = moves(&variant("shape = 'circle'"));
    let found = pairs(&moves, &cases());
    assert_eq!(points(&found), [[[49.0, 3.0], [0.0, 45.0]], [[49.0, 3.0], [2.0, 45.0]]]);
}

#[test]
fn every_target_that_is_hit_has_a_pair_and_the_printed_one_is_among_them() {
    let moves = moves(&variant("shape = 'circle'"));
    let targets = Targets::new(&cases(), 1.0);
    let hits = targets.hits(&moves);
    let (mut checked, mut met) = (0, 0);
    for (a, first) in targets.lengths[0].iter().enumerate().step_by(7) {
        for (b, second) in targets.lengths[1].iter().enumerate().step_by(11) {
            let mut asked = cases();
            asked[0].hops = [first.straight, first.diagonal];
            asked[1].hops = [second.straight, second.diagonal];
            let is_hit = hits[a * targets.lengths[1].len() + b];
            assert_eq!(!pairs(&moves, &asked).is_empty(), is_hit, "{first:?} and {second:?}");
            (checked, met) = (checked + 1, met + usize::from(is_hit));
        }
    }
    assert!(checked > 20 && met < checked, "{met} of {checked}");
    let printed = targets.place(0, cases()[0].target()).zip(targets.place(1, cases()[1].target()));
    let (a, b) = printed.unwrap();
    assert!(hits[a * targets.lengths[1].len() + b]);
    assert!(hits.iter().filter(|hit| **hit).count() < targets.count());
}

#[test]
fn targets_have_hops_of_equal_parity() {
    let targets = Targets::new(&cases(), 2.0);
    let all = targets.lengths[0].iter().flat_map(|a| targets.lengths[1].iter().map(move |b| (a, b)));
    let consistent = all.filter(|(a, b)| a.straight % 2 == b.straight % 2).count();
    assert_eq!(targets.count(), consistent);
    assert!(consistent > 1_000);
}

#[test]
fn free_shapes_include_what_uniform_shapes_give() {
    let free = FreeShapes::find(&variant("shape = 'free'"), &base(), &cases()).unwrap();
    for shape in ShapeSetting::ALL {
        let variant = variant("shape = 'circle'");
        let moves = cases().map(|case| variant.world(&base(), &case, shape).unwrap().eight_moves());
        for pair in pairs(&moves, &cases()) {
            assert!(free.pairs.contains(&pair), "{shape:?}: {:?}", points(&[pair]));
        }
    }
    // Which four shapes there are decides the number: a square on its corner and a triangle 10 cm wide and high would make
    // it 30.
    assert_eq!(free.pairs.len(), 26, "{:?}", points(&free.pairs));
    assert!(free.candidates > free.pairs.len(), "nothing was left to try choice by choice");
}

/// The free hops where each obstacle of `case` has the shape that `choice` says, as worlds are built for planners.
fn chosen(case: &Case, choice: usize) -> Moves {
    let shape = |index: usize| ShapeSetting::ALL[choice / 4_usize.pow(index as u32) % 4];
    let obstacles = case.obstacles_cm.iter().enumerate();
    let obstacles = obstacles.map(|(index, at)| shape(index).obstacle(*at, 10.0).unwrap());
    ArmWorld::new(base(), obstacles.collect()).eight_moves()
}

#[test]
fn free_shapes_are_the_pairs_that_worlds_built_choice_by_choice_have() {
    let free = FreeShapes::find(&variant("shape = 'free'"), &base(), &cases()).unwrap().pairs;
    // Each pair has both lengths under some choice in each case …
    for case in &cases() {
        let mut met = vec![false; free.len()];
        for choice in 0..4_usize.pow(case.obstacles_cm.len() as u32) {
            let moves = chosen(case, choice);
            let mut search = search(&moves);
            for ([start, goal], met) in free.iter().zip(&mut met).filter(|(_, met)| !**met) {
                search.flood(*start, case.target(), |cell, cost| {
                    *met |= cell == *goal && cost == case.target();
                });
            }
        }
        assert!(met.iter().all(|met| *met), "{met:?}");
    }
    // … and pairs of mixed choices, drawn evenly, are all among them.
    let mut found = 0;
    for (one, two) in (0..12).map(|k| (21 * k + 5, 5 * k + 2)) {
        let moves = [chosen(&cases()[0], one), chosen(&cases()[1], two)];
        for pair in pairs(&moves, &cases()) {
            assert!(free.contains(&pair), "choices {one} and {two}: {:?}", points(&[pair]));
            found += 1;
        }
    }
    assert!(found > 0, "no choice that was drawn has a pair");
}

#[test]
fn drawn_shapes_of_one_obstacle_are_each_of_the_four_at_times() {
    let alone = cases().map(|case| Case { obstacles_cm: vec![case.obstacles_cm[1]], ..case });
    let masks = |moves: &Moves| (0..moves.cell_count()).map(|cell| moves.mask(cell)).collect::<Vec<u8>>();
    let uniform = variant("shape = 'circle'");
    let of_shape = |case: &Case, shape| masks(&uniform.world(&base(), case, shape).unwrap().eight_moves());
    let known = alone.each_ref().map(|case| ShapeSetting::ALL.map(|shape| of_shape(case, shape)));
    let mut seen = std::collections::BTreeSet::new();
    for seed in 0..40 {
        let free = variant("shape = 'free'");
        let drawn = drawn_moves(&free, &base(), &alone, &mut crate::seed::stream(seed)).unwrap();
        for (case, moves) in drawn.iter().enumerate() {
            let shape = known[case].iter().position(|known| *known == masks(moves));
            seen.insert((case, shape.unwrap_or_else(|| panic!("seed {seed}, case {case}: no known shape"))));
        }
    }
    assert_eq!(seen.len(), 8, "{seen:?}");
}

const ORDERS: [Ties; 3] = [Ties::Fifo, Ties::Lifo, Ties::LargerG];

/// The path length that the kernel's A* returns if it never lowers open nodes.
fn kernel_length(ties: Ties, world: &ArmWorld, moves: &Moves, [start, goal]: Pair) -> Option<Octile> {
    let estimate = Combined { h: euclidean_to(world.grid(), goal), combine: sum };
    let terms = Terms {
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
    for case in cases() {
        let world = variant("shape = 'circle'").world(&base(), &case, ShapeSetting::Circle).unwrap();
        let moves = world.eight_moves();
        let most = case.target() + 8 * ScaledOctile::STRAIGHT;
        let mut flood = search(&moves);
        let mut searches = ORDERS.map(|ties| (ties, FirstWayAstar::new(&moves, ties)));
        let (mut checked, mut longer) = (0, 0);
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

/// A quarter of the reproduced workspace with one obstacle in each case, and what is asked of it.
struct Small {
    cases: [Case; 2],
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
    fn new() -> Self {
        let rules = ArmRules {
            arm: Planar2r::new(15.0, 10.0).unwrap(),
            lattice: TipLattice::new([-25.0, 25.0], [0.0, 25.0], 1.0).unwrap(),
            inner_radius_cm: 10.0,
            ..base()
        };
        let case = |at, hops| Case { obstacles_cm: vec![at], hops };
        let cases = [case([0.0, 20.0], [10, 14]), case([10.0, 18.0], [10, 13])];
        let variant = Variant { diameter_cm: 6.0, ..variant("shape = 'circle'") };
        let world = |case: &Case| variant.world(&rules, case, ShapeSetting::Circle).unwrap();
        let worlds = cases.each_ref().map(world);
        let moves = worlds.each_ref().map(ArmWorld::eight_moves);
        Self { targets: Targets::new(&cases, 0.75), cases, worlds, moves }
    }

    /// The shortest lengths between all cells, by start and goal.
    fn shortest(moves: &Moves) -> Vec<Vec<Option<u32>>> {
        let (mut flood, cells) = (search(moves), moves.cell_count());
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
                    .filter(|cost| (least(targets.lowest[case])..=targets.highest(case)).contains(cost))
            };
            Some((pair, [cost(0)?, cost(1)?]))
        });
        with_costs.collect()
    }

    /// The pairs that meet a target, with the kernel's lengths, and for how many these are not shortest.
    fn met(&self, ties: Ties, pairs: &[(Pair, [u32; 2])]) -> (Vec<([Octile; 2], Pair)>, usize) {
        let (mut met, mut longer) = (Vec::new(), 0);
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

    /// The cases with other printed lengths.
    fn asked(&self, lengths: &[Octile; 2]) -> [Case; 2] {
        [0, 1].map(|case| {
            let Octile { straight, diagonal } = lengths[case];
            Case { hops: [straight, diagonal], ..self.cases[case].clone() }
        })
    }
}

#[test]
fn where_open_nodes_are_never_lowered_pairs_and_targets_are_those_of_the_kernels_lengths() {
    let small = Small::new();
    let (targets, moves, pairs) = (&small.targets, &small.moves, small.pairs_in_reach());
    let mut of_orders = Vec::new();
    for ties in ORDERS {
        let (met, longer) = small.met(ties, &pairs);
        let mut hits = targets.none();
        for (lengths, _) in &met {
            targets.mark(&mut hits, lengths.map(ScaledOctile::scaled));
        }
        let number = hits.iter().filter(|hit| **hit).count();
        assert!(longer > 20 && number > 20 && number < targets.count(), "{ties:?}: {longer}, {number}");
        assert!(NeverLowered::hits(targets, moves, EXCESS, ties) == hits, "{ties:?}: other targets");
        for (lengths, _) in met.iter().step_by(met.len() / 4) {
            let found = NeverLowered::find(moves, &small.asked(lengths), EXCESS, ties);
            let pairs: Vec<Pair> =
                met.iter().filter(|(of, _)| of == lengths).map(|(_, pair)| *pair).collect();
            assert_eq!(found.pairs, pairs, "{ties:?}, {lengths:?}");
            assert!(found.candidates > pairs.len(), "{ties:?}: {} candidates", found.candidates);
        }
        of_orders.push(hits);
    }
    assert!(of_orders[0] != of_orders[1], "the order among equals does not matter here");
    assert!(of_orders[0] != targets.hits(moves), "shortest lengths meet the same targets");
}
