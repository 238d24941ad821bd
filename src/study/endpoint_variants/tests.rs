use super::*;
use base::grid::CornerRule;
use engine::geometry::planar::Touch;
use engine::kinematics::planar_2r::{ElbowRule, Planar2r};
use engine::length_inversion::{Pair, pairs};
use engine::space::{HopRule, TipLattice};
use std::collections::BTreeSet;

fn base() -> ArmRules {
    ArmRules {
        arm: Planar2r::new(30.0, 20.0).unwrap(),
        elbow: ElbowRule::NegativeQ2,
        lattice: TipLattice::new([-50.0, 50.0], [0.0, 50.0], 1.0).unwrap(),
        inner_radius_cm: 20.0,
        q2_limit_rad: f64::INFINITY,
        touch: Touch::Contact,
        corner_rule: CornerRule::Allow,
        hop: HopRule::EndPoints,
    }
}

fn cases() -> [Case; 2] {
    [
        Case { obstacles_cm: vec![[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]], hops: [29, 31] },
        Case { obstacles_cm: vec![[41.0, 10.0], [7.0, 40.0], [-16.0, 33.0]], hops: [17, 38] },
    ]
}

fn variant(text: &str) -> Variant {
    toml::from_str(&format!("label = 'v'\ndiameter_cm = 10\n{text}")).unwrap()
}

/// Each obstacle has any of the four shapes.
const FREE: &str = "shape = ['circle', 'square', 'hexagon', 'triangle']";

fn masks(moves: &Moves) -> Vec<u8> {
    (0..moves.cell_count()).map(|cell| moves.mask(cell)).collect()
}

/// The free hops where each obstacle of `case` has the shape that `choice` says, as worlds are built for planners.
fn chosen(case: &Case, choice: usize) -> Moves {
    let count = case.obstacles_cm.len() as u32;
    let shape = |index: u32| ShapeSetting::ALL[choice / 4_usize.pow(count - 1 - index) % 4];
    let obstacles =
        (0..).zip(&case.obstacles_cm).map(|(index, at)| shape(index).obstacle(*at, 10.0).unwrap());
    ArmWorld::new(base(), obstacles.collect()).eight_moves()
}

#[test]
fn grids_of_free_shapes_are_those_of_worlds_built_choice_by_choice() {
    let grids = variant(FREE).grids(&base(), &cases()).unwrap();
    for (case, grids) in cases().iter().zip(&grids) {
        assert_eq!(grids.len(), 4_usize.pow(case.obstacles_cm.len() as u32));
        let all: Vec<Vec<u8>> = grids.iter().map(masks).collect();
        for choice in (0..grids.len()).step_by(5) {
            assert!(all[choice] == masks(&chosen(case, choice)), "choice {choice}");
        }
        let different: BTreeSet<&Vec<u8>> = all.iter().collect();
        assert!(different.len() > grids.len() / 2, "only {} grids differ", different.len());
    }
    let bare = Case { obstacles_cm: Vec::new(), ..cases()[0].clone() };
    let grids = variant(FREE).grids(&base(), &[bare]).unwrap();
    assert_eq!(grids[0].len(), 1);
    assert!(masks(&grids[0][0]) == masks(&ArmWorld::new(base(), Vec::new()).eight_moves()));
}

/// The pairs of points that have the printed lengths.
struct Pairs;

impl Question for Pairs {
    type Answer = Vec<Pair>;

    fn shortest(&self, grids: &[Vec<Moves>], rule: Match) -> Vec<Vec<Pair>> {
        pairs(grids, &cases().each_ref().map(Case::target), rule)
    }

    fn never_lowered(&self, grids: &[Moves], ties: &[Ties]) -> Vec<Vec<Pair>> {
        // How many are asked for at once, and for which order.
        ties.iter()
            .map(|of| vec![[(grids.len() * ties.len()) as u32, u32::from(*of == Ties::Lifo)]])
            .collect()
    }
}

#[test]
fn every_variant_gets_its_own_answer_and_free_shapes_include_what_uniform_ones_give() {
    let uniform =
        ["circle", "square", "hexagon", "triangle"].map(|shape| variant(&format!("shape = '{shape}'")));
    let free = variant(FREE);
    let never = variant("shape = 'circle'\nopen_node = 'never'\nties = 'lifo'");
    let impossible = Variant { diameter_cm: -1.0, ..variant("shape = 'circle'") };
    let [circles, squares, hexagons, triangles] = &uniform;
    let never_fifo = variant("shape = 'circle'\nopen_node = 'never'\nties = 'fifo'");
    let elsewhere = variant("shape = 'square'\nopen_node = 'never'\nties = 'lifo'");
    let variants =
        [circles, &impossible, squares, &free, hexagons, &never, triangles, &elsewhere, &never_fifo];
    let answers = answers(&Pairs, &base(), &cases(), &variants);
    assert!(answers[1].as_ref().unwrap_err().contains("-0.5"), "{:?}", answers[1]);
    // The orders on the same grids are asked for together.
    for (place, answer) in [(5, [4, 1]), (7, [2, 1]), (8, [4, 0])] {
        assert_eq!(answers[place].as_ref().unwrap(), &[answer]);
    }
    let of_free = answers[3].as_ref().unwrap();
    for (place, variant) in [(0, circles), (2, squares), (4, hexagons), (6, triangles)] {
        let grids = variant.grids(&base(), &cases()).unwrap();
        let alone = Pairs.shortest(&grids, Match::ByPlace).concat();
        assert_eq!(answers[place].as_ref().unwrap(), &alone, "{variant:?}");
        assert!(alone.iter().all(|pair| of_free.contains(pair)), "{variant:?}");
    }
    // Which four shapes there are decides the number.
    assert_eq!(of_free.len(), 26);
}

#[test]
fn what_cannot_be_searched_or_told_apart_is_refused() {
    let free = variant(FREE);
    let crowded = Case { obstacles_cm: vec![[0.0, 30.0]; 7], hops: [1, 0] };
    let long = Case { hops: [5_000_000, 10], ..cases()[0].clone() };
    let named = |label: &str| Variant { label: label.to_owned(), ..variant("shape = 'circle'") };
    let swept = variant(&format!("{FREE}\nhop_check = 'continuous'"));
    let empty = variant("shape = []");
    let inverted = Variant { diameter_cm: -10.0, ..named("v") };
    let cases = cases().to_vec();
    for (cases, variants, part) in [
        (
            &[crowded][..],
            vec![free.clone()],
            "up to 4096 choices a case are accepted, not those of 4 shapes for 7",
        ),
        (&[long][..], vec![free.clone()], "hops is [5000000, 10]; at least one hop and at most 100000"),
        (&[][..], vec![free.clone()], "cases is empty; at least one is accepted"),
        (&cases[..], vec![], "variants is empty; at least one is accepted"),
        (
            &cases[..],
            vec![swept.clone()],
            "variant `v` leaves shapes open; hops are judged by their end points",
        ),
        (&cases[..], vec![inverted], "variant `v` (diameter_cm is -10): the circle's radius is -5"),
        (&cases[..], vec![empty], "variant `v` leaves shapes open; at least one shape"),
        (
            &cases[..],
            vec![named("a b"), named("a, b")],
            "variants `a b` and `a, b` have one name in records, `a-b`",
        ),
    ] {
        let (_, fault) = fault(cases, &variants).unwrap();
        assert!(fault.contains(part), "{fault}");
    }
    assert_eq!(fault(&cases, std::slice::from_ref(&free)), None);
}

#[test]
fn swept_free_shapes_unknown_shapes_and_a_wild_excess_are_refused() {
    let unknown = toml::from_str::<Variant>("label = 'v'\ndiameter_cm = 10\nshape = 'pentagon'");
    assert!(
        unknown.unwrap_err().to_string().contains("hexagon_turned, triangle, triangle_turned is accepted")
    );
    let continuous = ArmRules { hop: HopRule::Continuous, ..base() };
    assert!(variant(FREE).grids(&continuous, &cases()).unwrap_err().contains("judged by their end points"));
    assert_eq!(fault_of_excess(3.0), None);
    for excess in [-1.0, 50.0, 1e9, f64::NAN] {
        assert!(fault_of_excess(excess).unwrap().1.contains("0 and more, below 50"), "{excess}");
    }
}
