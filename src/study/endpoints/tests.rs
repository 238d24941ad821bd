use super::*;
use crate::endpoints::{Pair, pairs};
use crate::geometry::planar::Touch;
use crate::grid::CornerRule;
use crate::kinematics::planar_2r::{ElbowRule, Planar2r};
use crate::space::{HopRule, TipLattice};
use std::collections::BTreeSet;

fn base() -> ArmRules {
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

fn cases() -> [Case; 2] {
    [
        Case { obstacles_cm: vec![[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]], hops: [29, 31] },
        Case { obstacles_cm: vec![[41.0, 10.0], [7.0, 40.0], [-16.0, 33.0]], hops: [17, 38] },
    ]
}

fn variant(text: &str) -> Variant {
    toml::from_str(&format!("label = 'v'\ndiameter_cm = 10\n{text}")).unwrap()
}

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
    let grids = variant("shape = 'free'").grids(&base(), &cases()).unwrap();
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
    let grids = variant("shape = 'free'").grids(&base(), &[bare]).unwrap();
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

    fn never_lowered(&self, grids: &[Moves], _: Ties) -> Vec<Pair> {
        vec![[grids.len() as u32; 2]]
    }
}

#[test]
fn every_variant_gets_its_own_answer_and_free_shapes_include_what_uniform_ones_give() {
    let uniform =
        ["circle", "square", "hexagon", "triangle"].map(|shape| variant(&format!("shape = '{shape}'")));
    let (free, never) =
        (variant("shape = 'free'"), variant("shape = 'circle'\nopen_node = 'never'\nties = 'lifo'"));
    let impossible = Variant { diameter_cm: -1.0, ..variant("shape = 'circle'") };
    let [circles, squares, hexagons, triangles] = &uniform;
    let variants = [circles, &impossible, squares, &free, hexagons, &never, triangles];
    let answers = answers(&Pairs, &base(), &cases(), &variants);
    assert!(answers[1].as_ref().unwrap_err().contains("-0.5"), "{:?}", answers[1]);
    assert_eq!(answers[5].as_ref().unwrap(), &[[2, 2]]);
    let of_free = answers[3].as_ref().unwrap();
    for (place, variant) in [(0, circles), (2, squares), (4, hexagons), (6, triangles)] {
        let grids = variant.grids(&base(), &cases()).unwrap();
        let alone = Pairs.shortest(&grids, Match::ByPlace).concat();
        assert_eq!(answers[place].as_ref().unwrap(), &alone, "{variant:?}");
        assert!(alone.iter().all(|pair| of_free.contains(pair)), "{variant:?}");
    }
    // Which four shapes there are decides the number: a square on its corner and a triangle 10 cm wide and high would make
    // it 30.
    assert_eq!(of_free.len(), 26);
}

#[test]
fn variants_of_free_shapes_have_shortest_paths_and_few_obstacles() {
    let free = variant("shape = 'free'");
    assert_eq!(free.fault(&cases()), None);
    let crowded = Case { obstacles_cm: vec![[0.0, 30.0]; 7], hops: [1, 0] };
    let fault = free.fault(&[crowded]).unwrap();
    assert_eq!(fault, "variant `v` leaves shapes open; up to 6 obstacles a case are accepted, not 7");
}
