//! Data behind what is printed.

use replan_audit::witness::{Budget, Moments};
use std::collections::BTreeMap;

#[test]
fn the_search_finds_every_multiset_once() {
    // The oracle writes out all vectors of four values from 0 to 5.
    let mut all: BTreeMap<(i128, i128), std::collections::BTreeSet<Vec<i128>>> = BTreeMap::new();
    for code in 0..6_i128.pow(4) {
        let mut vector: Vec<i128> = (0..4).map(|place| code / 6_i128.pow(place) % 6).collect();
        vector.sort_unstable_by(|a, b| b.cmp(a));
        let moments = (vector.iter().sum(), vector.iter().map(|x| x * x).sum());
        all.entry(moments).or_default().insert(vector);
    }
    for sum in 0..=20 {
        for squares in 0..=100 {
            for seed in [None, Some(7)] {
                let mut budget = Budget { steps: 10_000, most: 100, seed };
                let mut found = Vec::new();
                let moments = Moments { n: 4, least: 0, most: 5, sum, squares };
                let is_all = moments.search(&mut budget, &mut |vector| {
                    found.push(vector.to_vec());
                    true
                });
                found.sort();
                let oracle: Vec<_> = all.get(&(sum, squares)).into_iter().flatten().cloned().collect();
                assert_eq!((is_all, found), (true, oracle), "{sum} {squares}");
            }
        }
    }
}
