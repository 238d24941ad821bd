//! What a trial took that brought no valid path: a selection that asks for all ends counts it. Any other counts what the search did
//! where the path is refused.

use crate::across::Toy;
use replan::analysis::verdict::Estimate;

/// The mean of `selected` in a toy of which many maps have no path, and in which lines of sight cut corners.
fn mean(selected: &str) -> (Estimate, Vec<String>) {
    asked("within", "statistic = \"mean\", accepted = [0.0, 1e6]", selected)
}

/// What `criterion` with these settings finds of `selected` in that toy.
fn asked(criterion: &str, settings: &str, selected: &str) -> (Estimate, Vec<String>) {
    let text = format!(
        "check.{criterion} = {{ {settings}, select = {{ study = \"draws\", problems = \"drawn\", {selected} }} }}"
    );
    let own = "check.lower.select = { study = \"draws\", problems = \"drawn\", metric = \"expansions\", contender = \"A*\", against = \
               \"Two-sided\" }";
    let sight = ("line_of_sight = \"exact_interior\"", "line_of_sight = \"bresenham\"");
    let toy = Toy::unexplored(&[("blocked_share = 0.2", "blocked_share = 0.45"), (own, &text), sight]);
    toy.0.done(&["judge", "./toy"]);
    let judged = toy.claim("fewer");
    (judged.ours().unwrap().clone(), judged.findings[0].because.clone())
}

#[test]
fn what_ends_without_a_path_counts_only_where_all_ends_do() {
    let (solved, message) = mean("metric = \"expansions\", contender = \"A*\"");
    let (all, all_message) = mean("metric = \"expansions\", contender = \"A*\", all_ends = true");
    assert_eq!(all.n, 40, "every instance has an end");
    assert!((10..35).contains(&solved.n), "{} of 40 are solved", solved.n);
    assert!(solved.value > 0.0 && (all.value - solved.value).abs() > 0.5, "{} {}", solved.value, all.value);
    let mentions =
        |lines: &[String]| lines.iter().any(|line| line.contains("whether a path is found or not"));
    assert_eq!((mentions(&message), mentions(&all_message)), (false, true));
}

#[test]
fn a_search_counts_where_its_path_is_refused_and_the_path_does_not() {
    let n = |selected: &str| mean(selected).0.n;
    let [path, search] = ["path_cost_cells", "expansions"]
        .map(|metric| n(&format!("metric = \"{metric}\", contender = \"Lazy\"")));
    let solved_by_astar = n("metric = \"path_cost_cells\", contender = \"A*\"");
    assert!(path < search, "no path is refused: {path} of {search}");
    assert_eq!(search, solved_by_astar, "a search without a path counts");
}

#[test]
fn a_refused_path_that_gives_a_count_is_no_case_outside_of_a_claim() {
    let selected = |metric: &str| format!("metric = \"{metric}\", contender = \"Lazy\"");
    let above = "hits = \"above\", bound = 0.0, accepted = [0.5, 1.0]";
    for (metric, why) in [("expansions", "no path"), ("path_cost_cells", "not solved")] {
        let (with_number, _) = mean(&selected(metric));
        let (_, because) = asked("share", above, &selected(metric));
        let expected = format!("{} more cases are outside of the claim: {why}", 40 - with_number.n);
        assert!(because.join("; ").contains(&expected), "{expected}: {because:?}");
    }
}
