//! A* that never lowers open nodes: the specialisation is the general form.

use super::*;

#[test]
fn the_specialised_search_has_the_lengths_of_the_general_one_up_to_its_bound() {
    let never = Update { lower_open: false, ..Update::default() };
    let mut solved = 0;
    let mut beyond = 0;
    let mut longer = 0;
    let mut count = 0;
    for case in cases(400, 0.35) {
        for ties in [Ties::Fifo, Ties::Lifo, Ties::LargerG] {
            let mut fast = FirstWayAstar::new(&case.moves, ties);
            let mut general = Search::new(Heap::new(ties));
            let mut stream = seed::stream(case.seed);
            // Several queries each, so that what one leaves behind could mislead the next.
            for query in 0..6 {
                let [start, goal] = [0, 1].map(|_| stream.random_range(0..case.grid.cell_count()));
                let [start, goal] = if query == 0 { case.ends } else { [start, goal] };
                let estimate = Combined { h: euclidean_to(&case.grid, goal), combine: sum };
                let terms = SideInputs {
                    graph: &mut GridGraph::new(&case.moves),
                    estimate: &estimate,
                    observer: &mut (),
                    update: never,
                };
                let truth = general.run(terms, start, |node| node == goal, Rules::default(), &mut ());
                let truth = truth.outcome.route().map(|route| route.cost);
                fast.aim(goal);
                let what = format!("seed {}, {ties:?}, {start} to {goal}", case.seed);
                assert_eq!(fast.length(start, 1_000_000), truth, "{what}");
                (solved, count) = (solved + u32::from(truth.is_some()), count + 1);
                let Some(length) = truth else { continue };
                let scaled = ScaledOctile::scaled(length);
                assert_eq!(fast.length(start, scaled), truth, "{what}: bounded by its own length");
                if let Some(below) = scaled.checked_sub(1) {
                    assert_eq!(fast.length(start, below), None, "{what}: bounded below its length");
                    beyond += 1;
                }
                let shortest = astar(&case.grid, &case.moves, [start, goal]);
                longer += u32::from(shortest.outcome.route().map(|route| route.cost) != truth);
            }
        }
    }
    assert!((count / 4..count).contains(&solved), "one-sided sample: {solved} of {count} solvable");
    assert!(beyond > 1_000 && longer > 100, "{beyond} bounds below a length, {longer} not shortest");
}

#[test]
fn lengths_found_backwards_are_those_of_every_order_among_equals() {
    let mut settled = 0;
    let mut longer = 0;
    let mut beyond = 0;
    let mut count = 0;
    for case in cases(100, 0.25) {
        let mut flood = OctileAstar::new(&case.moves).unwrap();
        let mut back = FirstWayBack::new(&case.moves);
        let orders = [Ties::Fifo, Ties::Lifo, Ties::LargerG];
        let mut forwards = orders.map(|ties| FirstWayAstar::new(&case.moves, ties));
        let mut shortest = Vec::new();
        back.begin(case.ends[0]);
        flood.flood(case.ends[0], 1_000_000, |cell, length| {
            back.set_length(cell, length);
            shortest.push((cell, length));
        });
        for (goal, least) in shortest {
            for most in [1_000_000, least + 408, least] {
                count += 1;
                let Ok(length) = back.length(goal, most) else { continue };
                for forwards in &mut forwards {
                    forwards.aim(goal);
                    let what = format!("seed {}, {:?} to {goal}, at most {most}", case.seed, case.ends);
                    assert_eq!(forwards.length(case.ends[0], most), length, "{what}");
                }
                settled += 1;
                longer += u32::from(length.is_some_and(|length| ScaledOctile::scaled(length) > least));
                beyond += u32::from(length.is_none());
            }
        }
    }
    assert!((count / 2..count).contains(&settled), "one-sided sample: {settled} of {count} settled");
    assert!(longer > 100 && beyond > 100, "{longer} are not shortest, {beyond} beyond their bounds");
}
