//! Orders in which the eight neighbours of a cell are generated.
//!
//! Where two open nodes have the same f, the one that was opened first is taken, so that this order decides between paths of
//! equal cost. Programs differ in it: two nested loops over the offsets, once around the compass, or the four straight
//! neighbours before the four diagonal ones. Each of the three comes in eight forms, one for each rotation and mirror of
//! the square; y counts up, as everywhere.

use super::DIRECTIONS;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The order of the eight neighbours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NeighbourOrder {
    /// For x from +1 down, for y from +1 down.
    #[default]
    XFallsYFalls,
    /// For x from +1 down, for y from -1 up.
    XFallsYRises,
    /// For x from -1 up, for y from +1 down.
    XRisesYFalls,
    /// For x from -1 up, for y from -1 up.
    XRisesYRises,
    /// For y from +1 down, for x from +1 down.
    YFallsXFalls,
    /// For y from +1 down, for x from -1 up.
    YFallsXRises,
    /// For y from -1 up, for x from +1 down.
    YRisesXFalls,
    /// For y from -1 up, for x from -1 up.
    YRisesXRises,
    /// Around the compass from north, clockwise.
    NorthClockwise,
    /// Around the compass from east, clockwise.
    EastClockwise,
    /// Around the compass from south, clockwise.
    SouthClockwise,
    /// Around the compass from west, clockwise.
    WestClockwise,
    /// Around the compass from north, counter-clockwise.
    NorthCounter,
    /// Around the compass from east, counter-clockwise.
    EastCounter,
    /// Around the compass from south, counter-clockwise.
    SouthCounter,
    /// Around the compass from west, counter-clockwise.
    WestCounter,
    /// North and on clockwise by quarter turns, then north-east and on.
    StraightNorthClockwise,
    /// East and on clockwise by quarter turns, then south-east and on.
    StraightEastClockwise,
    /// South and on clockwise by quarter turns, then south-west and on.
    StraightSouthClockwise,
    /// West and on clockwise by quarter turns, then north-west and on.
    StraightWestClockwise,
    /// North and on counter-clockwise by quarter turns, then north-west and on.
    StraightNorthCounter,
    /// East and on counter-clockwise by quarter turns, then north-east and on.
    StraightEastCounter,
    /// South and on counter-clockwise by quarter turns, then south-east and on.
    StraightSouthCounter,
    /// West and on counter-clockwise by quarter turns, then south-west and on.
    StraightWestCounter,
}

/// Around the compass from north, clockwise.
const CLOCKWISE: [[i32; 2]; 8] = [[0, 1], [1, 1], [1, 0], [1, -1], [0, -1], [-1, -1], [-1, 0], [-1, 1]];

impl NeighbourOrder {
    /// Every order, by its number.
    pub const ALL: [Self; 24] = [
        Self::XFallsYFalls,
        Self::XFallsYRises,
        Self::XRisesYFalls,
        Self::XRisesYRises,
        Self::YFallsXFalls,
        Self::YFallsXRises,
        Self::YRisesXFalls,
        Self::YRisesXRises,
        Self::NorthClockwise,
        Self::EastClockwise,
        Self::SouthClockwise,
        Self::WestClockwise,
        Self::NorthCounter,
        Self::EastCounter,
        Self::SouthCounter,
        Self::WestCounter,
        Self::StraightNorthClockwise,
        Self::StraightEastClockwise,
        Self::StraightSouthClockwise,
        Self::StraightWestClockwise,
        Self::StraightNorthCounter,
        Self::StraightEastCounter,
        Self::StraightSouthCounter,
        Self::StraightWestCounter,
    ];

    /// Its number among all, from 0.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The steps `[dx, dy]` to the neighbours, in this order.
    pub fn steps(self) -> [[i32; 2]; 8] {
        let place = self.index() % 8;
        if self.index() < 8 {
            return nested(place);
        }
        let around: [[i32; 2]; 8] =
            std::array::from_fn(|i| CLOCKWISE[(2 * (place % 4) + if place < 4 { i } else { 8 - i }) % 8]);
        if self.index() < 16 { around } else { std::array::from_fn(|i| around[2 * (i % 4) + i / 4]) }
    }

    /// The same order as places in [`DIRECTIONS`].
    pub fn bits(self) -> [u8; 8] {
        let bit = |step| DIRECTIONS.iter().position(|known| *known == step);
        self.steps().map(|step| bit(step).expect("every step is one of the eight") as u8)
    }
}

/// Two loops over the offsets: bit 2 of `place` puts y outside, bit 1 makes the outer offset rise, bit 0 the inner one.
fn nested(place: usize) -> [[i32; 2]; 8] {
    let offset = |i: usize, rises: bool| if rises { i as i32 - 1 } else { 1 - i as i32 };
    std::array::from_fn(|i| {
        // The fifth pair of offsets is no step.
        let i = if i < 4 { i } else { i + 1 };
        let [outer, inner] = [offset(i / 3, place & 2 != 0), offset(i % 3, place & 1 != 0)];
        if place & 4 != 0 { [inner, outer] } else { [outer, inner] }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_order_names_each_neighbour_once() {
        for order in NeighbourOrder::ALL {
            let steps: BTreeSet<[i32; 2]> = order.steps().into_iter().collect();
            assert_eq!(steps, DIRECTIONS.into_iter().collect(), "{order:?}");
            assert_eq!(NeighbourOrder::ALL[order.index()], order);
        }
        assert_eq!(NeighbourOrder::default().steps(), DIRECTIONS, "the order before there was a choice");
    }

    #[test]
    fn each_rotation_and_mirror_of_an_order_is_one_of_its_eight_forms() {
        let turns: [fn([i32; 2]) -> [i32; 2]; 8] = [
            |[x, y]| [x, y],
            |[x, y]| [-y, x],
            |[x, y]| [-x, -y],
            |[x, y]| [y, -x],
            |[x, y]| [-x, y],
            |[x, y]| [x, -y],
            |[x, y]| [y, x],
            |[x, y]| [-y, -x],
        ];
        for order in NeighbourOrder::ALL {
            let forms: BTreeSet<usize> = turns
                .iter()
                .map(|turn| {
                    let turned = order.steps().map(turn);
                    let form = NeighbourOrder::ALL.iter().position(|other| other.steps() == turned);
                    form.unwrap_or_else(|| panic!("no form of {order:?} is {turned:?}"))
                })
                .collect();
            let of_kind: BTreeSet<usize> = (0..8).map(|form| order.index() / 8 * 8 + form).collect();
            assert_eq!(forms, of_kind, "{order:?}");
        }
    }
}
