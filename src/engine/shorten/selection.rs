//! The cheapest way along a path that may leave out nodes.

/// The nodes of a path of `count` nodes whose legs cost least in sum, as indices in path order; both ends are kept.
///
/// `cost(i, j)` is what the leg from node i to a later node j costs, `None` if there is no such leg; legs between
/// neighbours must have a cost. Of selections that cost the same, legs start as early as they can.
///
/// # Panics
/// If a leg between neighbours has no cost.
pub fn least_selection(count: usize, mut cost: impl FnMut(usize, usize) -> Option<f64>) -> Vec<usize> {
    // The least cost to each node, and the node before it.
    let mut best: Vec<(f64, usize)> = vec![(0.0, 0)];
    for to in 1..count {
        let through = |from: usize| cost(from, to).map(|leg| (best[from].0 + leg, from));
        let legs = (0..to).filter_map(through);
        best.push(legs.min_by(|a, b| a.0.total_cmp(&b.0)).expect("legs between neighbours have a cost"));
    }
    let mut kept = Vec::new();
    let mut at = count;
    while at > 0 {
        at -= 1;
        kept.push(at);
        at = if at == 0 { 0 } else { best[at].1 + 1 };
    }
    kept.reverse();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;

    #[test]
    fn no_other_selection_costs_less() {
        let mut stream = seed::stream(seed::derive(5, &["least_selection"]));
        let mut greedy_lost = 0;
        for round in 0..300 {
            let count = stream.random_range(1..9_usize);
            let legs: Vec<Option<f64>> = (0..81)
                .map(|leg| {
                    let is_own = leg % 9 == leg / 9 + 1;
                    (is_own || stream.random_bool(0.5)).then(|| f64::from(stream.random_range(1..20_u32)))
                })
                .collect();
            let cost = |i: usize, j: usize| legs[i * 9 + j];
            let sum = |kept: &[usize]| kept.windows(2).map(|w| cost(w[0], w[1])).sum::<Option<f64>>();
            let kept = least_selection(count, cost);
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, count - 1), "round {round}");
            let inner = count.saturating_sub(2);
            let all = (0..1_usize << inner).map(|mask| {
                let mut nodes = vec![0];
                nodes.extend((0..inner).filter(|i| mask >> i & 1 == 1).map(|i| i + 1));
                nodes.extend((count > 1).then_some(count - 1));
                nodes
            });
            let least = all.filter_map(|nodes| sum(&nodes)).fold(f64::INFINITY, f64::min);
            assert_eq!(sum(&kept), Some(least), "round {round}");
            let greedy = crate::shorten::straightening(count, crate::shorten::LastNode::Goal, |i, j| {
                cost(i, j).is_some()
            });
            greedy_lost += u32::from(sum(&greedy) > Some(least));
        }
        assert!(greedy_lost > 50, "greedy straightening was worse only {greedy_lost} times");
    }
}
