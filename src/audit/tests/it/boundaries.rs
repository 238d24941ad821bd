//! Inputs on either side of the line that a check draws, so that a line drawn a little elsewhere is noticed.

use crate::report::audited;
use replan_audit::reader::Format;
use replan_audit::report::{Class, Options};
/// What the check says of a relation or a sample of one input.
fn class(check: &str, text: &str) -> Class {
    let report = audited(text, Format::Toml, &Options { keeps_possible: true, ..Options::default() });
    let findings = report.findings.iter().filter(|finding| finding.check == check);
    findings.map(|finding| finding.class).min().unwrap_or_else(|| panic!("{check} does not look at {text}"))
}

/// What stands behind `[[relation]]` and its check, or behind `[[sample]]` and its name.
fn input(check: &str, keys: &str) -> String {
    match keys.strip_prefix("sample: ") {
        Some(keys) => format!("[[sample]]\nname = \"x\"\n{}\n", keys.replace("; ", "\n")),
        None => format!("[[relation]]\ncheck = \"{check}\"\n{}\n", keys.replace("; ", "\n")),
    }
}

/// A check, an input and its class.
const LINES: [(&str, &str, Class); 27] = [
    ("order", r#"sample: mean = "0.7"; min = "1.0""#, Class::Impossible),
    ("order", r#"sample: mean = "1.0"; min = "1.0""#, Class::Possible),
    ("order", r#"sample: mean = "2.0"; max = "1.9""#, Class::Possible),
    ("order", r#"sample: mean = "2.2"; max = "1.9""#, Class::Impossible),
    // n values from 0 to 2 with mean 1 have a deviation of 1, or of the root of 2 where it divides by n - 1 = 1.
    (
        "sd_range",
        r#"sample: is = "mean, n=2, population"; mean = "1.000"; sd = "1.414"; min = "0.000"; max = "2.000""#,
        Class::Impossible,
    ),
    (
        "sd_range",
        r#"sample: is = "mean, n=2, sample"; mean = "1.000"; sd = "1.414"; min = "0.000"; max = "2.000""#,
        Class::Possible,
    ),
    // The sum of the digits allows 100 %; the counts are 99, 100 and 101.
    (
        "shares_sum",
        r#"parts = ["10", "10", "10", "10", "10", "10", "10", "10", "10", "9"]; n = 100"#,
        Class::Impossible,
    ),
    (
        "shares_sum",
        r#"parts = ["10", "10", "10", "10", "10", "10", "10", "10", "10", "10"]; n = 100"#,
        Class::Possible,
    ),
    (
        "shares_sum",
        r#"parts = ["10", "10", "10", "10", "10", "10", "10", "10", "10", "11"]; n = 100"#,
        Class::Impossible,
    ),
    ("shares_sum", r#"parts = ["50.0", "50.0"]; n = 3"#, Class::Impossible),
    // No count of 300 is 0.10 %, and the others have counts to spare.
    ("shares_sum", r#"parts = ["0.10", "50", "50"]; n = 300"#, Class::Impossible),
    ("speedup", r#"times = "1.00"; before = "10.00"; after = "5.00"; means = "times""#, Class::Impossible),
    ("speedup", r#"times = "1.00"; before = "10.00"; after = "5.00"; means = "times more""#, Class::Possible),
    (
        "speedup",
        r#"times = "2.00"; before = "10.00"; after = "5.00"; means = "times more""#,
        Class::Impossible,
    ),
    ("speedup", r#"times = "2.00"; before = "10.00"; after = "5.00""#, Class::Possible),
    ("rises", r#"values = ["90.0", "88.0"]; anytime = "yes""#, Class::Impossible),
    ("rises", r#"values = ["90.0", "88.0"]; anytime = "no""#, Class::Signal),
    ("expansions", r#"value = "901"; free = 900"#, Class::Impossible),
    ("expansions", r#"value = "900"; free = 900"#, Class::Possible),
    ("expansions", r#"value = "-1"; free = 900"#, Class::Impossible),
    // 3 + 2√2 = 5.828, whichever axis is the longer one.
    ("path_bound", r#"value = "5.80"; from = "0:0"; to = "2:5"; moves = "eight""#, Class::Impossible),
    ("path_bound", r#"value = "5.80"; from = "0:0"; to = "5:2"; moves = "eight""#, Class::Impossible),
    ("path_bound", r#"value = "5.83"; from = "0:0"; to = "2:5"; moves = "eight""#, Class::Possible),
    ("path_bound", r#"value = "5.83"; from = "0:0"; to = "5:2"; moves = "eight""#, Class::Possible),
    // Agresti and Coull's lower end of 0 of 10 is below 0, and is printed as it is or as 0.
    ("interval", r#"low = "0.0"; high = "32.1"; k = 0; n = 10; method = "agresti_coull""#, Class::Possible),
    ("interval", r#"low = "-4.3"; high = "32.1"; k = 0; n = 10; method = "agresti_coull""#, Class::Possible),
    ("interval", r#"low = "0.0"; high = "32.1"; k = 0; n = 10; method = "wilson""#, Class::Signal),
];

#[test]
fn each_check_draws_its_line_where_the_mathematics_draws_it() {
    for (check, keys, expected) in LINES {
        assert_eq!(class(check, &input(check, keys)), expected, "{check}: {keys}");
    }
}

#[test]
fn a_length_with_cheap_diagonals_may_be_below_the_straight_line() {
    // Three diagonal moves of 1.4 are 4.2, and the straight line is 3√2.
    let message = |moves: &str| {
        let table = format!("| p | length [{moves}, from=0:0, to=3:3] |\n|-|-|\n| A | 4.20 |\n");
        audited(&table, Format::Markdown, &Options::default())
    };
    let cheap = message("a+b1.4");
    assert!(!cheap.has_impossible(), "{cheap:?}");
    assert_eq!(cheap.tally["lattice"].applied, 1);
    // Of one cause with `lattice`, which tells it.
    assert_eq!(message("a+b√2").tally["path_bound"].follows, 1);
}

#[test]
fn the_greatest_of_a_divisor_is_held_against_all_problems() {
    // If every quotient is 2 at least and no dividend is above 4, no divisor is above 2.
    let table = |greatest: &str| {
        let head = "| [statistic] | a [n=100] | b [n=100] | r [n=100, ratio=a/b] |\n|-|-|-|-|\n";
        let rows = format!("| min | 1.0 | 0.2 | 2.000 |\n| max | 4.000 | {greatest} | 9.0 |\n");
        format!("[[table]]\nname = \"t\"\ntext = \"\"\"\n{head}{rows}\"\"\"\n")
    };
    assert_eq!(class("ratio_label", &table("3.000")), Class::Impossible);
    assert_eq!(class("ratio_label", &table("2.000")), Class::Possible);
}
