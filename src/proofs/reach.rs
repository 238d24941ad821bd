//! Which sums of squares whole numbers of a given count, sum and range have, exactly.
//!
//! Let `x` be `n` whole numbers with sum `S` and sum of squares `Q`. `Q` has the parity of `S` and is at least what
//! values as even as possible give. What more is needed:
//!
//! - Without ends, n = 2: `2Q − S²` is a square.
//! - Without ends, n = 4, S odd: nothing, since `4Q − S² ≡ 3 (mod 8)` is a sum of three odd squares (Gauss,
//!   *Disquisitiones* 293).
//! - Without ends, n = 4, S even: `Q − (S/2)²` is a sum of three squares, which is all but `4^k (8m + 7)` (Legendre).
//!   One representation turns into the other by `A = (s + t − u − v) / 2` and its like.
//! - Without ends, n = 5: nothing. A value `a` that makes `S − a` odd leaves four with an odd sum. It does if `5(a −
//!   S/5)² ≤ 4(5Q − S²)/5`, a span of length 2 or more unless `5Q − S² < 6.25`. The least `5Q − S²` for a sum is 0, 4
//!   or 6 and the next one larger by 10.
//! - Without ends, n > 5: nothing. A value of the most even vector leaves n − 1 with a sum of squares that is not below
//!   their least.
//!
//! *With ends.* No value is further from the mean than the root of `(n − 1)(Q/n − S²/n²)`; ends beyond that do not
//! matter. With values from 0 to w (after a shift): two equal values inside the range can move apart by one each, which
//! raises Q by 2. Values without such a pair have `wS − Q = Σ x(w − x) ≤ 1(w − 1) + … + (w − 1)1 = w(w² − 1)/6`. So
//! every Q of the right parity is met from the least on, until `wS − Q` is no more than that. What is left is searched,
//! value by value.

use std::collections::BTreeSet;

/// Whole numbers with a given count, sum and sum of squares, between two ends where they are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct SumQuery {
    /// How many.
    pub n: u64,
    /// Their sum.
    pub sum: i128,
    /// The sum of their squares.
    pub squares: i128,
    /// None is below the first or above the second.
    pub ends: [Option<i128>; 2],
}

/// A question with the values that its largest one can have and are not tried yet.
struct Open {
    query: SumQuery,
    next: i128,
    last: i128,
}

/// Whether there are such numbers; none if 128 bits or `steps`, which are used up, do not suffice.
pub fn is_met(query: SumQuery, steps: &mut u64) -> Option<bool> {
    if let Some(settled) = query.settled()? {
        return Some(settled);
    }
    let mut open = vec![query.opened()?];
    let mut seen = BTreeSet::new();
    while let Some(top) = open.last_mut() {
        if top.next < top.last {
            open.pop();
            continue;
        }
        *steps = steps.checked_sub(1)?;
        let left = top.query.without(top.next);
        top.next -= 1;
        match left.settled()? {
            Some(true) => return Some(true),
            None if seen.insert(left) => open.push(left.opened()?),
            Some(false) | None => {}
        }
    }
    Some(false)
}

impl SumQuery {
    /// What is left after the value `largest`, which no other exceeds.
    fn without(self, largest: i128) -> Self {
        Self {
            n: self.n - 1,
            sum: self.sum - largest,
            squares: self.squares - largest * largest,
            ends: [self.ends[0], Some(largest)],
        }
    }

    /// `n Q − S²`.
    fn spread(&self) -> Option<i128> {
        i128::from(self.n).checked_mul(self.squares)?.checked_sub(self.sum.checked_mul(self.sum)?)
    }

    /// The answer, if no search is needed. The outer none is for numbers that 128 bits do not hold.
    #[expect(clippy::option_option, reason = "not known yet and not computable are different answers")]
    fn settled(self) -> Option<Option<bool>> {
        let (least, most) = extremes(self.n, self.sum, self.ends)?;
        let is_odd = (self.squares - self.sum).rem_euclid(2) == 1;
        if is_odd || self.squares < least || most.is_some_and(|most| self.squares > most) {
            return Some(Some(false));
        }
        if self.squares == least || most == Some(self.squares) {
            return Some(Some(true));
        }
        let spread = self.spread()?;
        let are_apart = |twice: i128| twice.isqrt().pow(2) == twice;
        let settled = match self.n {
            1 => Some(false),
            2 if !are_apart(spread) => Some(false),
            // Half the difference on either side of the mean; the ends were looked at above.
            2 => Some(true),
            4 if self.sum % 2 == 0 && is_seven_shaped(spread / 4) => Some(false),
            3 => None,
            _ => (self.is_far_from_ends(spread)? || self.has_a_pair_inside()?).then_some(true),
        };
        Some(settled)
    }

    /// Whether no vector with these moments reaches the ends.
    fn is_far_from_ends(&self, spread: i128) -> Option<bool> {
        let n = i128::from(self.n);
        let furthest = spread.checked_mul(n - 1)?;
        for end in self.ends.into_iter().flatten() {
            let apart = self.sum.checked_sub(end.checked_mul(n)?)?;
            if apart.checked_mul(apart)? < furthest {
                return Some(false);
            }
        }
        Some(true)
    }

    /// Whether every vector with less spread has two equal values inside the range, so that it leads on to the next.
    fn has_a_pair_inside(&self) -> Option<bool> {
        let [Some(least), Some(most)] = self.ends else { return Some(false) };
        let n = i128::from(self.n);
        let width = most.checked_sub(least)?;
        let sum = self.sum.checked_sub(n.checked_mul(least)?)?;
        let shift = least.checked_mul(self.sum.checked_mul(2)?.checked_sub(n.checked_mul(least)?)?)?;
        let squares = self.squares.checked_sub(shift)?;
        let inside = width.checked_mul(width.checked_mul(width)?.checked_sub(1)?)? / 6;
        Some(width.checked_mul(sum)?.checked_sub(squares - 2)? > inside)
    }

    /// The values that the largest one can have: at least the mean, and no further from it than the spread allows.
    fn opened(self) -> Option<Open> {
        let n = i128::from(self.n);
        let reach = self.spread()?.checked_mul(n - 1)?.isqrt();
        let next = self.sum.checked_add(reach)?.div_euclid(n);
        let next = self.ends[1].map_or(next, |most| next.min(most));
        let mut last = -((-self.sum).div_euclid(n));
        // Below some largest value the others cannot be spread enough.
        let mut enough = next;
        while last < enough {
            let middle = last + (enough - last) / 2;
            let (_, most) = extremes(self.n, self.sum, [self.ends[0], Some(middle)])?;
            if most.is_none_or(|most| most >= self.squares) { enough = middle } else { last = middle + 1 }
        }
        Some(Open { query: self, next, last })
    }
}

/// Whether `c`, which is not negative, is `4^k (8m + 7)`: no sum of three squares.
fn is_seven_shaped(mut c: i128) -> bool {
    while c > 0 && c % 4 == 0 {
        c /= 4;
    }
    c % 8 == 7
}

/// The least and the greatest sum of squares of `n` whole numbers with this sum, between two ends where they are given.
/// The least is above the greatest if there are no such numbers. None if 128 bits do not suffice.
pub fn extremes(n: u64, sum: i128, [least, most]: [Option<i128>; 2]) -> Option<(i128, Option<i128>)> {
    let n = i128::from(n);
    let (base, rest) = divided(sum, n);
    if least.is_some_and(|least| base < least) || most.is_some_and(|most| base + i128::from(rest > 0) > most)
    {
        return Some((1, Some(0)));
    }
    let square = |x: i128| x.checked_mul(x);
    let even =
        square(base)?.checked_mul(n - rest)?.checked_add(square(base.checked_add(1)?)?.checked_mul(rest)?)?;
    // One end alone implies the other: all values but one stand at it.
    let rest_at = |end: i128| sum.checked_sub(end.checked_mul(n - 1)?);
    let [least, most] = match (least, most) {
        (None, None) => return Some((even, None)),
        (Some(least), None) => [least, rest_at(least)?],
        (None, Some(most)) => [rest_at(most)?, most],
        (Some(least), Some(most)) => [least, most],
    };
    if least == most {
        return Some((even, Some(even)));
    }
    // As many at the ends as the sum allows, and one between them.
    let above = sum.checked_sub(n.checked_mul(least)?)?;
    let (high, between) = divided(above, most - least);
    let mut spread = square(most)?.checked_mul(high)?;
    if high < n {
        let middle = square(least + between)?;
        spread = spread.checked_add(middle)?.checked_add(square(least)?.checked_mul(n - high - 1)?)?;
    }
    Some((even, Some(spread)))
}

/// Quotient and rest of a division, the rest not negative. 64 bits mostly suffice, and a processor divides these by itself.
fn divided(a: i128, by: i128) -> (i128, i128) {
    match (i64::try_from(a), i64::try_from(by)) {
        (Ok(a), Ok(by)) if by > 0 => (i128::from(a.div_euclid(by)), i128::from(a.rem_euclid(by))),
        _ => (a.div_euclid(by), a.rem_euclid(by)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All pairs of sum and sum of squares of `n` values from 0 to `width`, by writing them out one value at a time.
    fn written_out(n: u64, width: i128) -> BTreeSet<(i128, i128)> {
        let mut all = BTreeSet::from([(0, 0)]);
        for _ in 0..n {
            all = all.iter().flat_map(|(s, q)| (0..=width).map(move |x| (s + x, q + x * x))).collect();
        }
        all
    }

    #[test]
    fn within_a_range_exactly_the_sums_of_squares_that_occur_are_met() {
        let mut met = 0;
        let mut gaps = 0;
        for (n, width) in
            [(1, 9), (2, 14), (3, 14), (4, 12), (5, 11), (6, 9), (7, 8), (9, 6), (14, 4), (30, 3)]
        {
            let all = written_out(n, width);
            for shift in [0, -3] {
                for sum in 0..=i128::from(n) * width {
                    for squares in 0..=i128::from(n) * width * width {
                        let query = SumQuery {
                            n,
                            sum: sum + shift * i128::from(n),
                            squares: squares + 2 * shift * sum + i128::from(n) * shift * shift,
                            ends: [Some(shift), Some(width + shift)],
                        };
                        let expected = all.contains(&(sum, squares));
                        assert_eq!(is_met(query, &mut 100_000), Some(expected), "{query:?}");
                        let (least, most) = extremes(n, sum, [Some(0), Some(width)]).unwrap();
                        let is_plausible =
                            (squares - sum) % 2 == 0 && (least..=most.unwrap()).contains(&squares);
                        met += u32::from(expected);
                        gaps += u32::from(is_plausible && !expected);
                    }
                }
            }
        }
        assert!(met > 10_000 && gaps > 1000, "{met} met and {gaps} gaps");
    }

    #[test]
    fn without_ends_exactly_the_sums_of_squares_that_occur_are_met() {
        // With a sum of squares of 60 at most no value is above 7.
        for n in 1..=6_u64 {
            let mut all = BTreeSet::from([(0_i128, 0_i128)]);
            for _ in 0..n {
                let next = all.iter().flat_map(|(s, q)| (-7..=7_i128).map(move |x| (s + x, q + x * x)));
                all = next.filter(|(_, q)| *q <= 60).collect();
            }
            for sum in -20..=20 {
                for squares in 0..=60 {
                    let query = SumQuery { n, sum, squares, ends: [None, None] };
                    assert_eq!(is_met(query, &mut 10_000), Some(all.contains(&(sum, squares))), "{query:?}");
                }
            }
        }
    }

    #[test]
    fn one_end_alone_implies_the_other() {
        for n in 1..=4_u64 {
            let all = written_out(n, 12);
            for sum in 0..=12 {
                for squares in 0..=150 {
                    let expected = all.contains(&(sum, squares));
                    let up = SumQuery { n, sum, squares, ends: [Some(0), None] };
                    let down = SumQuery { n, sum: -sum, squares, ends: [None, Some(0)] };
                    for query in [up, down] {
                        assert_eq!(is_met(query, &mut 10_000), Some(expected), "{query:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn large_samples_take_few_steps() {
        for (n, sum, squares, ends) in [
            (699, 47_118, 5_000_000, [None, None]),
            (699, 47_118, 5_000_000, [Some(0), None]),
            (100_000, 300_000, 1_100_000, [Some(1), Some(5)]),
            (10, 1_000_000, 200_000_000_000, [Some(0), None]),
            (50, 600, 12_002, [Some(0), Some(25)]),
        ] {
            let mut steps = 1000;
            assert_eq!(
                is_met(SumQuery { n, sum, squares, ends }, &mut steps),
                Some(true),
                "{n} {sum} {squares}"
            );
        }
    }

    #[test]
    fn extremes_are_met_and_not_passed() {
        for n in 1..=4_u32 {
            for sum in -8..=12_i128 {
                let vectors = (0..6_i128.pow(n))
                    .map(|code| (0..n).map(|at| code / 6_i128.pow(at) % 6 - 2).collect::<Vec<_>>());
                let squares: Vec<i128> = vectors
                    .filter(|v| v.iter().sum::<i128>() == sum)
                    .map(|v| v.iter().map(|x| x * x).sum())
                    .collect();
                let (least, most) = extremes(u64::from(n), sum, [Some(-2), Some(3)]).unwrap();
                match (squares.iter().min(), squares.iter().max()) {
                    (Some(&low), Some(&high)) => assert_eq!((least, most), (low, Some(high)), "{n} {sum}"),
                    _ => assert!(least > most.unwrap(), "{n} {sum}"),
                }
            }
        }
    }
}
