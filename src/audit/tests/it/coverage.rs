//! Numbers in a text that no macro backs, and stale macros.

use replan_audit::coverage::coverage;

const MACROS: &str = "% made by replan\n\\newcommand{\\nodes}{45} % nodes\n\\newcommand{\\cost}{13.40}\n";

fn lines(text: &str, current: Option<&str>) -> Vec<String> {
    coverage(text, MACROS, current).iter().map(ToString::to_string).collect()
}

#[test]
fn numbers_typed_by_hand_are_reported_and_macros_are_not() {
    let text = "\\documentclass[11pt]{article}\n\\begin{document}\nWe open \\nodes{} and not 69 nodes, cost 13.40.% 7\n\
                As Table~\\ref{tab:2} and \\cite[p.~3]{hart1968} say, A2 and $x_1$, $10^{3}$, 50\\,\\%.\n\
                \\includegraphics[width=0.5\\textwidth]{fig4}\\vspace{2pt} 12pt\n\\end{document}\n99\n";
    let found = lines(text, None);
    assert_eq!(
        found,
        [
            "3:26: 69 is backed by no macro",
            "3:41: 13.40 is typed by hand; macros of this value: \\cost",
            "4:68: 10 is backed by no macro",
            "4:77: 50 is backed by no macro"
        ]
    );
}

#[test]
fn numbers_in_words_in_cells_of_several_columns_and_in_own_macros_are_reported() {
    let text = "\\newcommand{\\mine}{69}\n\\newcommand{\\size}[1]{\\fontsize{#1}{9}}\n\\begin{document}\n\
                Twelve of \\multicolumn{2}{c}{88} and one \\textcolor{red!50}{77} in a 12cm gap, 12\\,345 or 1{,}234.\n\
                \\begin{tabular}{p{3cm}}\\def\\two{2}\\href{a.b/7}{6}\n\\end{document}\n";
    let found: Vec<String> =
        lines(text, None).iter().map(|line| line.split(" is ").next().unwrap().to_owned()).collect();
    let expected = ["4:1: Twelve", "4:30: 88", "4:61: 77", "4:70: 12", "4:80: 12345", "4:91: 1234"];
    assert_eq!(found[..2], ["1:1: 69", "5:1: 2"]);
    assert_eq!(found[2..8], expected);
    assert_eq!(found[8..], ["5:48: 6"]);
}

#[test]
fn fractions_ordinals_and_numbers_right_behind_a_command_are_reported() {
    let text = "A $\\frac12$, \\tfrac{3}{4} or \\frac{\\nodes}{7} of them.\n\\bf12 is the 3rd, the fourth and two thirds.\n\
                The first second counts; half $\\alpha2$. % typed: half\n";
    let found: Vec<String> =
        lines(text, None).iter().map(|line| line.split(" is ").next().unwrap().to_owned()).collect();
    let expected = [
        "1:4: 1/2",
        "1:14: 3/4",
        "1:44: 7",
        "2:4: 12",
        "2:14: 3",
        "2:23: fourth",
        "2:34: two",
        "2:38: thirds",
        "3:38: 2",
    ];
    assert_eq!(found, expected);
}

#[test]
fn a_macro_that_is_called_like_the_files_and_is_not_there_is_reported() {
    let file = "\\newcommand{\\zhangNodesOurs}{45}\n\\newcommand{\\zhangNodesPaper}{46}\n\\newcommand{\\zhangCostOurs}{13.40}\n";
    let message = |text: &str| coverage(text, file, None).iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(
        message("\\zhangNodesOurs{} of \\zhangNodesTheirs{}, \\alpha, \\zhang.\n"),
        ["1:22: \\zhangNodesTheirs is called like the macros of the file, and is not among them"]
    );
    assert_eq!(message("\\newcommand{\\zhangMine}{x}\\zhangMine"), [""; 0]);
    // Two names that share nothing say nothing about a third.
    assert_eq!(coverage("\\nodesOld", MACROS, None), []);
}

#[test]
fn what_a_comment_excuses_is_not_reported() {
    let text = "We compare two planners on 45 maps with 8 neighbours. % typed: two, 8\nTwo again. % typed\n";
    let expected =
        ["1:28: 45 is typed by hand; macros of this value: \\nodes", "2:1: Two is backed by no macro"];
    assert_eq!(lines(text, None), expected);
}

#[test]
fn a_macro_that_differs_from_the_current_value_is_stale() {
    let now = MACROS.replace("45", "46").replace("\\newcommand{\\cost}{13.40}\n", "");
    let found = lines("no numbers", Some(&now));
    let expected =
        ["3:1: \\cost is 13.40, but there is no such number now", "2:1: \\nodes is 45, but now it is 46"];
    assert_eq!(found, expected);
    let found = lines("\\newcommand{\\nodes}{44}", None);
    assert_eq!(found, ["1:1: \\nodes is 44, but now it is 45"]);
    assert_eq!(lines("\\nodes", Some(MACROS)), [""; 0]);
}
