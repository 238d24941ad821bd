//! The states that a search over joint angles has reached.

use std::collections::BTreeMap;
use world::kinematics::AXES;

/// Whole multiples of the step, one a joint.
pub(super) type Cell = [i16; AXES];

/// The cells of a tile: two a joint, so that a state and all its neighbours lie in one tile or two along every joint.
const CELLS: usize = 1 << AXES;
const NONE: u32 = u32::MAX;

/// What is known of the cells of one tile.
struct Tile {
    /// The least cost with which each was reached, as the search adds it up; infinite if it was not.
    reached: [f64; CELLS],
    /// The number of each that was reached.
    numbers: [u32; CELLS],
    /// Those that the arm cannot stand at, a bit each.
    refused: u64,
}

/// What was reached so far.
pub(super) struct States {
    cells: Vec<Cell>,
    /// Where in `known` a tile is, by [`key`].
    places: BTreeMap<u128, u32>,
    known: Vec<Tile>,
}

/// The tiles around one state, each looked up once: a step's target is needed 728 times, and there are 64 of them.
pub(super) struct Around {
    /// The tile that holds the least neighbour along every joint.
    least: Cell,
    /// Its place, once it was looked up, and whether it was.
    places: [Option<u32>; CELLS],
}

impl Around {
    pub(super) fn new(cell: &Cell) -> Self {
        Self { least: cell.map(|steps| (steps - 1) >> 1), places: [None; CELLS] }
    }

    /// Which of the tiles holds `to`, a neighbour or the state itself.
    fn tile(&self, to: &Cell) -> usize {
        (0..AXES).fold(0, |code, i| code | usize::from(((to[i] >> 1) - self.least[i]).cast_unsigned()) << i)
    }
}

/// A tile as one number.
fn key(cell: &Cell) -> u128 {
    cell.iter().fold(0, |key, steps| key << 16 | u128::from((steps >> 1).cast_unsigned()))
}

/// Which cell of its tile it is.
fn slot(cell: &Cell) -> usize {
    (0..AXES).fold(0, |code, i| code | usize::from((cell[i] & 1).cast_unsigned()) << i)
}

impl States {
    /// The start alone, as number 0.
    pub(super) fn of_start() -> Self {
        let start: Cell = [0; AXES];
        let mut states = Self { cells: Vec::new(), places: BTreeMap::new(), known: Vec::new() };
        states.reach(start, 0.0, &mut Around::new(&start));
        states
    }

    pub(super) fn len(&self) -> usize {
        self.cells.len()
    }

    pub(super) fn cell(&self, number: u32) -> Cell {
        self.cells[number as usize]
    }

    /// The least cost with which `number` was reached.
    pub(super) fn reached(&self, number: u32) -> f64 {
        let cell = self.cells[number as usize];
        self.known[self.places[&key(&cell)] as usize].reached[slot(&cell)]
    }

    /// The tile of `to`, if anything is known of its cells.
    fn tile(&self, to: &Cell, around: &mut Around) -> Option<&Tile> {
        let place = around.places[around.tile(to)]
            .get_or_insert_with(|| self.places.get(&key(to)).copied().unwrap_or(NONE));
        self.known.get(*place as usize)
    }

    /// Whether going to `to` at the cost `reached` would be of use: never to one that was refused.
    pub(super) fn lowers(&self, to: &Cell, reached: f64, around: &mut Around) -> bool {
        self.tile(to, around)
            .is_none_or(|tile| tile.refused >> slot(to) & 1 == 0 && reached < tile.reached[slot(to)])
    }

    /// Whether `to` was reached, so that the arm can stand there.
    pub(super) fn is_reached(&self, to: &Cell, around: &mut Around) -> bool {
        self.tile(to, around).is_some_and(|tile| tile.numbers[slot(to)] != NONE)
    }

    /// The tile of `to`, in which something will be known.
    fn tile_mut(&mut self, to: &Cell, around: &mut Around) -> &mut Tile {
        let place = *self.places.entry(key(to)).or_insert_with(|| {
            self.known.push(Tile { reached: [f64::INFINITY; CELLS], numbers: [NONE; CELLS], refused: 0 });
            self.known.len() as u32 - 1
        });
        around.places[around.tile(to)] = Some(place);
        &mut self.known[place as usize]
    }

    /// Remembers that the arm cannot stand at `to`.
    pub(super) fn refuse(&mut self, to: &Cell, around: &mut Around) {
        self.tile_mut(to, around).refused |= 1 << slot(to);
    }

    /// The number of `to`, reached at a cost that is lower than any before.
    pub(super) fn reach(&mut self, to: Cell, reached: f64, around: &mut Around) -> u32 {
        let slot = slot(&to);
        let next = self.cells.len() as u32;
        let tile = self.tile_mut(&to, around);
        tile.reached[slot] = reached;
        let is_new = tile.numbers[slot] == NONE;
        if is_new {
            tile.numbers[slot] = next;
        }
        let number = tile.numbers[slot];
        self.cells.extend(is_new.then_some(to));
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_state_is_found_from_every_neighbour_as_in_a_plain_map() {
        let mut states = States::of_start();
        let mut plain = BTreeMap::from([([0_i16; AXES], 0.0)]);
        let mut refused = BTreeSet::new();
        let mut stream = base::seed::stream(7);
        let (mut at, mut lowered, mut kept): (Cell, _, _) = ([0; AXES], 0, 0);
        for _ in 0..20_000 {
            let mut around = Around::new(&at);
            for _ in 0..4 {
                let to: Cell = std::array::from_fn(|i| (at[i] + draw(&mut stream)).clamp(-2, 1));
                let cost = f64::from(draw(&mut stream)) + 3.0;
                let lowers = !refused.contains(&to) && plain.get(&to).is_none_or(|known| cost < *known);
                assert_eq!(states.lowers(&to, cost, &mut around), lowers, "{to:?}");
                assert_eq!(states.is_reached(&to, &mut around), plain.contains_key(&to), "{to:?}");
                if lowers && !plain.contains_key(&to) && draw(&mut stream) > 0 {
                    states.refuse(&to, &mut around);
                    refused.insert(to);
                } else if lowers {
                    let number = states.reach(to, cost, &mut around);
                    assert_eq!((states.cell(number), states.reached(number)), (to, cost));
                    plain.insert(to, cost);
                }
                (lowered, kept) = (lowered + usize::from(lowers), kept + usize::from(!lowers));
            }
            at = std::array::from_fn(|i| (at[i] + draw(&mut stream)).clamp(-2, 1));
        }
        assert_eq!(states.len(), plain.len());
        assert!(
            lowered > plain.len() && kept > refused.len() && !refused.is_empty(),
            "cells are lowered after they were reached"
        );
    }

    /// −1, 0 or 1.
    fn draw(stream: &mut impl rand::Rng) -> i16 {
        use rand::RngExt as _;
        stream.random_range(-1..2)
    }
}
