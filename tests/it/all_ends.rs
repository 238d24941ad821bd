//! What a trial took that found no path: a selection that asks for all ends counts it, any other does not.

use crate::across::Toy;
use replan::analysis::verdict::Estimate;

/// What `of` finds on mean in a toy of which many maps have no path.
fn mean(more: &str) -> (Estimate, Vec<String>) {
    let text = format!(
        "check.within = {{ statistic = \"mean\", accepted = [0.0, 1e6], select = {{ study = \"draws\", problems = \"drawn\", metric = \
         \"expansions\", contender = \"A*\"{more} }} }}"
    );
    let own = "check.lower.select = { study = \"draws\", problems = \"drawn\", metric = \"expansions\", contender = \"A*\", against = \
               \"Two-sided\" }";
    let toy = Toy::unexplored(&[("blocked_share = 0.2", "blocked_share = 0.45"), (own, &text)]);
    toy.0.done(&["judge", "./toy"]);
    let judged = toy.claim("fewer");
    (judged.ours().unwrap().clone(), judged.findings[0].because.clone())
}

#[test]
fn what_ends_without_a_path_counts_only_where_all_ends_do() {
    let (solved, message) = mean("");
    let (all, all_message) = mean(", all_ends = true");
    assert_eq!(all.n, 40, "every instance has an end");
    assert!((10..35).contains(&solved.n), "{} of 40 are solved", solved.n);
    assert!(solved.value > 0.0 && (all.value - solved.value).abs() > 0.5, "{} {}", solved.value, all.value);
    let mentions =
        |lines: &[String]| lines.iter().any(|line| line.contains("whether a path is found or not"));
    assert_eq!((mentions(&message), mentions(&all_message)), (false, true));
}
