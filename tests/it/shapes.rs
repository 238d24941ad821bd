//! Obstacles of the planar arm in the planner's terms and in the verifier's.

use engine::space::{HopRule, Obstacle};
use study::preprocessing::workspace_map::ShapeSetting;
use verify::arm::{Body, Hops};

/// An obstacle: its shape, and where its centre is.
pub type Placed = (ShapeSetting, [f64; 2]);

/// Discs, squares, hexagons and triangles in turn, so that a sample of places has all of them.
pub fn shaped(number: u64, places: Vec<[f64; 2]>) -> Vec<Placed> {
    let shape = |index: usize| ShapeSetting::ALL[(number as usize + index) % ShapeSetting::ALL.len()];
    places.into_iter().enumerate().map(|(index, at)| (shape(index), at)).collect()
}

/// Whole numbers where the outline is exact; elsewhere no corner or side lies on a lattice point, where rounding decides.
fn diameter_cm(shape: ShapeSetting) -> f64 {
    if matches!(shape, ShapeSetting::Circle | ShapeSetting::Square) { 8.0 } else { 7.0 }
}

/// As a world takes it.
pub fn obstacle(&(shape, at): &Placed) -> Obstacle {
    shape.obstacle(at, diameter_cm(shape)).expect("a shape of this size can be made")
}

/// As the verifier takes it, with corners of its own.
pub fn body(&(shape, [x, y]): &Placed) -> Body {
    let radius = diameter_cm(shape) / 2.0;
    let half = radius * 0.75_f64.sqrt();
    let corners = match shape {
        ShapeSetting::Circle => return Body::disc([x, y], radius),
        ShapeSetting::Square => {
            vec![[-radius, -radius], [radius, -radius], [radius, radius], [-radius, radius]]
        }
        ShapeSetting::Hexagon => vec![
            [radius, 0.0],
            [radius / 2.0, half],
            [-radius / 2.0, half],
            [-radius, 0.0],
            [-radius / 2.0, -half],
            [radius / 2.0, -half],
        ],
        ShapeSetting::Triangle => vec![[0.0, radius], [-half, -radius / 2.0], [half, -radius / 2.0]],
        other => panic!("{other:?} is not drawn"),
    };
    Body::polygon(corners.into_iter().map(|[dx, dy]| [x + dx, y + dy]).collect())
}

/// What decides about hops, in turn; every one meets both elbow rules that change with every second number.
pub const HOPS: [HopRule; 8] = [
    HopRule::EndPoints,
    HopRule::Continuous,
    HopRule::EndPoints,
    HopRule::TipLine,
    HopRule::EndPoints,
    HopRule::TipLine,
    HopRule::EndPoints,
    HopRule::Continuous,
];

/// The same in the verifier's terms.
pub fn hops_of(rule: HopRule) -> Hops {
    match rule {
        HopRule::EndPoints => Hops::EndPoints,
        HopRule::Continuous => Hops::EvenJoints,
        HopRule::TipLine => Hops::TipLine,
    }
}
