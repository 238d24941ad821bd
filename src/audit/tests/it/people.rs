//! Tables as people write them: what is read, what is refused with its cause and place, and what is found.

use crate::report::audited;
use crate::wording::refused;
use replan_audit::output;
use replan_audit::reader::{Format, read, stub_line};
use replan_audit::report::{Class, Options, Report};

fn report(text: &str) -> Report {
    let format = if text.starts_with('|') { Format::Markdown } else { Format::Csv };
    audited(text, format, &Options { keeps_possible: true, ..Options::default() })
}

/// A Markdown table.
fn table(header: &str, rows: &[&str]) -> String {
    let rule = "|-".repeat(header.matches('|').count() + 1);
    let rows = rows.iter().fold(String::new(), |rows, row| rows + "| " + row + " |\n");
    format!("| {header} |\n{rule}|\n{rows}")
}

/// Check and class of every finding that is not possible.
fn found(text: &str) -> Vec<(&'static str, Class)> {
    let findings = report(text).findings;
    findings
        .iter()
        .filter(|found| found.class < Class::Possible)
        .map(|found| (found.check, found.class))
        .collect()
}

#[test]
fn a_share_without_its_first_0_is_read_and_one_without_its_last_digits_is_refused() {
    let shares =
        report(&table("planner | success [share of 24]", &["A | .042", "B | −.5", "C | +.500", "D | .51"]));
    let lines: Vec<(Class, &str)> = shares.findings.iter().map(|found| (found.class, &*found.text)).collect();
    assert_eq!(lines.len(), 4, "{lines:?}");
    assert!(lines[0].0 == Class::Possible && lines[0].1.starts_with("0.042 is printed by 1 ×"), "{lines:?}");
    assert!(lines[1].0 == Class::Impossible && lines[1].1.starts_with("-0.5 is outside"), "{lines:?}");
    assert!(lines[2].0 == Class::Possible && lines[2].1.starts_with("0.500 is printed by 12 ×"), "{lines:?}");
    assert!(lines[3].0 == Class::Impossible && lines[3].1.starts_with("0.51 is the mean of no"), "{lines:?}");
    let point = refused(&table("planner | success [share of 24]", &["A | .042", "B | 1."]), Format::Markdown);
    assert!(
        point.starts_with(
            "4:2: column `success`: `1.` ends in a point without digits behind it; write 1 or 1.0"
        ),
        "{point}"
    );
}

/// Cells of a column, each with the message about it.
const CELLS: [(&str, &str, &str); 26] = [
    ("success [% of 30]", "91.1*", "`91.1*` has the mark `*` behind it"),
    ("success [% of 30]", "91.1†", "`91.1†` has the mark `†` behind it"),
    ("success [% of 30]", "91.1^a", "`91.1^a` has the mark `^a` behind it"),
    ("success [% of 30]", "91.1<sup>2</sup>", "`91.1<sup>2</sup>` has the mark `<sup>2</sup>` behind it"),
    ("success [% of 30]", "~~91.1~~", "`~~91.1~~` is struck out"),
    ("success [% of 30]", "91.1 apples", "`91.1 apples` has `apples` behind it, a unit that is not known"),
    ("success (% of 30)", "91.1*", "`91.1*` has the mark `*` behind it"),
    ("time [mean, unit=s, n=5]", "1:23", "`1:23` is a time in minutes and seconds"),
    ("time [mean, unit=s, n=5]", "1:02:03", "`1:02:03` is a time in minutes and seconds, or in hours"),
    ("time [mean, unit=s, n=5]", "2m 5s", "`2m 5s` is a time in minutes and seconds"),
    ("time [mean, unit=s, n=5]", "1h 20min", "`1h 20min` is a time in minutes and seconds"),
    ("time [mean, unit=s, n=5]", "1h", "`1h` has the unit h, and its header the unit s"),
    ("time [mean, unit=s, n=5]", "3 h", "`3 h` has the unit h, and its header the unit s"),
    ("time [mean, unit=s, n=5]", "2 min", "`2 min` has the unit min, and its header the unit s"),
    ("time [mean, unit=s, n=5]", "100%", "`100%` has the unit %, and its header the unit s"),
    ("time [mean, unit=s, n=5]", "3.2–4.0", "`3.2–4.0` is a range and no printed value"),
    ("time [mean, unit=s, n=5]", "3.2 × 10^3", "`3.2 × 10^3` has a power of ten, which hides digits"),
    ("time [mean, unit=s, n=5]", "3.2·10⁻³", "`3.2·10⁻³` has a power of ten, which hides digits"),
    ("time (s)", "2m 5s", "`2m 5s` is a time in minutes and seconds"),
    ("nodes [mean, integers, n=10]", "1,234.5", "`1,234.5` has thousands separators"),
    ("nodes [mean, integers, n=10]", "1.234.567", "`1.234.567` has several points"),
    ("success [% of 30]", "96,7", "`96,7` has a decimal comma; write a point"),
    ("success [% of 30]", "29/30", ""),
    ("success [count of 25]", "29/30", "`29/30` is of 30, and the header says of 25"),
    ("success [count of 30]", "29/30 (96.7%)", "`29/30 (96.7%)` is a count and a percentage; say `% of 30`"),
    ("nodes [value]", "29/30", "`29/30` is 29 of 30; say `count of 30` in the header"),
];

#[test]
fn a_cell_that_cannot_be_read_is_quoted_whole_with_its_cause() {
    for (header, cell, expected) in CELLS {
        let text = table(&format!("planner | {header}"), &[&format!("A | {cell}")]);
        if expected.is_empty() {
            assert_eq!(found(&text), [], "{text}");
            continue;
        }
        let fault = refused(&text, Format::Markdown);
        let name = header.split([' ', '[']).next().unwrap();
        assert!(
            fault.starts_with(&format!("3:2: column `{name}")) && fault.contains(expected),
            "{text}\n{fault}"
        );
    }
}

#[test]
fn quoted_thousands_and_decimal_commas_of_csv_are_refused_at_their_place() {
    let thousands = "planner,\"nodes [mean, integers, n=10]\"\nA,987.3\nB,\"1,234.5\"\n";
    let fault = refused(thousands, Format::Csv);
    assert!(fault.starts_with("3:2: column `nodes`: `1,234.5` has thousands separators"), "{fault}");
    let commas = "planner;success [% of 30]\nA;\"96,7\"\nB;91,1\n";
    let faults = read(commas, Format::Csv).unwrap_err();
    let lines: Vec<String> = faults.iter().map(ToString::to_string).collect();
    assert!(lines[0].starts_with("2:2: column `success`: `96,7` has a decimal comma"), "{lines:?}");
    assert!(lines[1].starts_with("3:2: column `success`: `91,1` has a decimal comma"), "{lines:?}");
}

#[test]
fn what_cannot_be_seen_in_a_cell_or_header_is_named() {
    for (mark, name) in [
        ('\u{200b}', "‹zero-width space›"),
        ('\u{200d}', "‹zero-width joiner›"),
        ('\u{ad}', "‹soft hyphen›"),
        ('\u{7}', "‹control character U+0007›"),
        ('\u{feff}', "‹byte-order mark›"),
        ('\u{202e}', "‹U+202E›"),
        ('\u{2060}', "‹word joiner›"),
    ] {
        let cell = refused(&format!("method,time [ms]\na,2{mark}\nb,3\n"), Format::Csv);
        assert!(cell.starts_with(&format!("2:2: column `time`: `2{name}` has `{name}` behind it")), "{cell}");
        let header = refused(&format!("method,time [me{mark}an ms]\na,2\n"), Format::Csv);
        assert!(header.contains(&format!("me{name}an")), "{header}");
    }
}

#[test]
fn numbers_that_a_header_without_annotation_stands_over_are_not_taken_for_labels() {
    for (header, cells, expected) in [
        ("ms", ["1e3", "2.5e3"], "3:2: column `ms`: `1e3` has an exponent, which hides digits"),
        ("plan (ms)", ["1e3", "2e3"], "3:2: column `plan (ms)`: `1e3` has an exponent"),
        ("result", ["1.2 × 10^3", "4 × 10^2"], "3:2: column `result`: `1.2 × 10^3` has a power of ten"),
        ("plan [ms]", ["10k", "12k"], "3:2: column `plan`: `10k` leaves digits out"),
        ("plan (ms)", ["<5", "<7"], "3:2: column `plan (ms)`: `<5` is a bound"),
        ("plan (ms)", ["3–4", "5–6"], "3:2: column `plan (ms)`: `3–4` is a range"),
        ("plan (ms)", ["1.5*", "2.5*"], "3:2: column `plan (ms)`: `1.5*` has the mark"),
        (
            "plan (ms)",
            ["1234567890123456", "1.0"],
            "3:2: column `plan (ms)`: `1234567890123456` has more than 15",
        ),
        (
            "plan (ms)",
            ["1.5", "50%"],
            "4:2: column `plan (ms)`: `50%` has the unit %, and its header the unit ms",
        ),
    ] {
        let rows = cells.map(|cell| format!("A | {cell}"));
        let text = table(&format!("planner | {header}"), &[&rows[0], &rows[1]]);
        let fault = refused(&text, Format::Markdown);
        assert!(fault.starts_with(expected), "{text}\n{fault}");
    }
    let labels = table("planner | version", &["A | 10k", "B | <5"]);
    assert_eq!(found(&labels), []);
}

#[test]
fn faults_beyond_the_first_fifty_are_counted() {
    let text =
        (0..300).fold("method,time\n".to_owned(), |text, row| text + &format!("m{row},fast{row}.1.\n"));
    let faults = read(&text.replacen("time", "time [mean]", 1), Format::Csv).unwrap_err();
    assert_eq!((faults.len(), faults[50].to_string().as_str()), (51, "52:2: 250 more faults like these"));
}

#[test]
fn a_fraction_is_a_count_and_its_percentage_is_held_against_it() {
    let beside = table(
        "planner | rate [% of 30]",
        &["A | 29/30 (96.7%)", "B | 28/30 (91.1%)", "C | 93.3 (28/30)", "D | 91.1"],
    );
    let wrong = report(&beside);
    let lines: Vec<(&str, Class, &str)> =
        wrong.findings.iter().map(|found| (&*found.name, found.class, &*found.text)).collect();
    assert_eq!(lines[0], ("rate of A", Class::Possible, "96.7 is 29 of 30, which is 96.667"));
    assert_eq!(lines[1], ("rate of B", Class::Signal, "91.1 is not 28 of 30, which is 93.333"));
    assert_eq!((lines[2].0, lines[2].1), ("rate of C", Class::Possible));
    assert_eq!((lines[3].0, lines[3].1), ("rate of D", Class::Impossible));
    let guessed = table("planner | success", &["A | 29/30", "B | 31/30"]);
    let input = read(&guessed, Format::Markdown).unwrap();
    assert_eq!(stub_line(&input.tables[0]), "| planner [label] | success [count of 30, higher is better] |");
    assert_eq!(found(&guessed), [("grim", Class::Signal)], "31 of 30, of a header that was guessed");
    let of = refused(&table("planner | success [of 30]", &["A | 29/30"]), Format::Markdown);
    assert!(
        of.starts_with(
            "1:2: `of 30` is no item of an annotation; accepted: `% of 30`, `share of 30` or `count of 30`"
        ),
        "{of}"
    );
}

#[test]
fn shares_of_one_column_are_all_in_per_cent_or_all_of_1() {
    let mixed = refused(&table("planner | success [% of 24]", &["A | 4.2%", "B | 0.042"]), Format::Markdown);
    assert!(
        mixed.starts_with(
            "4:2: column `success`: `0.042` has no % and is below 1, where `4.2%` is in per cent"
        ),
        "{mixed}"
    );
    let share =
        refused(&table("planner | success [share of 24]", &["A | 0.042", "B | 4.2%"]), Format::Markdown);
    assert!(
        share.starts_with("4:2: column `success`: `4.2%` is in per cent, and the header says shares of 1"),
        "{share}"
    );
    assert_eq!(found(&table("planner | success [% of 24]", &["A | 4.2%", "B | 50.0", "C | 0"])), []);
}

#[test]
fn a_multiple_of_the_best_in_brackets_is_not_guessed_to_be_a_deviation() {
    let rows = ["a | 22.7 (1.0) | 64.9 (1.10)", "b | 31.2 (1.37) | 59.0 (1.0)"];
    let text = table("name | time mean | time max", &rows);
    let input = read(&text, Format::Markdown).unwrap();
    let line = stub_line(&input.tables[0]);
    assert!(!line.contains("±sd"), "{line}");
    let unread = output::unread_spreads("t", &input);
    assert!(unread[0].starts_with("t:3:2: column `time mean`: what stands behind 22.7 (1.0) is not looked at; 1.0 is among them, as in multiples of the best"), "{unread:?}");
    assert!(
        unread[1].contains(
            "`time max`: what stands behind 64.9 (1.10) is not looked at; it stands beside no mean"
        ),
        "{unread:?}"
    );
    let spread = read(&text.replace("(1.0)", "(0.9)"), Format::Markdown).unwrap();
    assert!(stub_line(&spread.tables[0]).contains("±sd"));
    let annotated = "Name [label],Min [min, n=23, of=v],Max [max, n=23, of=v],Mean [mean, n=23, of=v],SD [sd, n=23, of=v]\n\
        a,22.72 (1.0),64.86 (1.10),38.97 (1.0),30.84 (3.33)\n";
    assert_eq!(
        found(annotated),
        [("sd_range", Class::Impossible)],
        "no 23 values from 22.72 to 64.86 spread so far"
    );
}

#[test]
fn a_reduction_above_100_per_cent_is_impossible_and_a_speed_up_by_it_is_not() {
    let relation = |keys: &str| {
        let text = format!("[[relation]]\nname = \"x\"\n{keys}");
        let report = audited(&text, Format::Toml, &Options { keeps_possible: true, ..Options::default() });
        report.findings[0].class
    };
    let times = "from = \"100.0\"\nto = \"26.5\"\n";
    assert_eq!(relation(&format!("check = \"reduction\"\npercent = \"278\"\n{times}")), Class::Impossible);
    let faster = "check = \"speedup\"\nbefore = \"100.0\"\nafter = \"26.5\"\ntimes = \"2.78\"\n";
    assert_eq!(relation(faster), Class::Possible);
    for (from, to, percent) in [("37", "3", "91.89"), ("12", "0", "100")] {
        let keys =
            format!("check = \"reduction\"\nfrom = \"{from}\"\nto = \"{to}\"\npercent = \"{percent}\"\n");
        assert_eq!(relation(&keys), Class::Possible, "{keys}");
    }
}

#[test]
fn a_header_in_latex_keeps_its_name() {
    let text = table(
        r"Planner | Success $\uparrow$ (\% of 30) | $t$ [ms] $\downarrow$ | $n$",
        &["A | 91.1 | 3.2 | 30"],
    );
    let input = read(&text, Format::Markdown).unwrap();
    assert_eq!(
        stub_line(&input.tables[0]),
        r"| Planner [label] | Success $\uparrow$ (\% of 30) [% of 30, higher is better] | $t$ $\downarrow$ [value, lower is better, unit=ms] | n [value] |"
    );
    assert_eq!(found(&text), [("grim", Class::Signal)]);
    let arrow = table(
        r"Planner | Success [% of 30] $\uparrow$ | cost [value] ↓",
        &["A | 93.3 | **5**", "B | **90.0** | 4"],
    );
    assert_eq!(
        found(&arrow),
        [("bold", Class::Signal), ("bold", Class::Signal)],
        "arrows say which way is better"
    );
}

#[test]
fn a_relation_without_check_is_named_with_its_other_keys() {
    let text = "\n[[relation]]\nkind = \"reduction\"\nname = \"x\"\nfrom = \"37\"\nto = \"3\"\npercent = \"91.89\"\n";
    let fault = refused(text, Format::Toml);
    assert_eq!(
        fault,
        "2: `check` is missing; no relation has `kind`; the name of a check is accepted, as check = \"ratio\""
    );
}

#[test]
fn a_guessed_column_of_n_is_used_and_gives_a_signal() {
    let text = table("planner | n | success", &["A | 40 | 87.3", "B | 40 | 87.5", "C | - | 12.1"]);
    assert_eq!(found(&text), [("grim", Class::Signal)]);
    let signal = report(&text).findings.into_iter().find(|found| found.class == Class::Signal).unwrap();
    assert!(
        signal.name == "success of A"
            && signal.premises.iter().any(|premise| premise.contains("was guessed")),
        "{signal:?}"
    );
    let counts = table("planner | problems | solved", &["A | 40 | 37", "B | 40 | 40", "C | 30 | 7"]);
    assert_eq!(found(&counts), [], "37 of 40, and no 37 %");
    assert_eq!(found(&counts.replace("| 7 |", "| 71 |")), [("grim", Class::Signal)], "71 % of 30");
    let header = stub_line(&read(&text, Format::Markdown).unwrap().tables[0]);
    let written = text.replace("| planner | n | success |", &header).replace("| C | - | 12.1 |\n", "");
    assert_eq!(
        found(&written),
        [("grim", Class::Impossible)],
        "the header that is proposed is the one that was used"
    );
}

#[test]
fn a_wrong_average_or_total_is_a_signal_and_a_right_one_is_none() {
    let rows = |word: &str, value: &str| {
        table(
            "planner | success [% of 250] | nodes [value]",
            &["A | 33.2 | 100", "B | 50.0 | 150", "C | 60.0 | 201", &format!("{word} | {value}")],
        )
    };
    for word in [
        "Average",
        "Mean",
        "Avg.",
        "**Average**",
        "mean:",
        "Average (3 maps)",
        "Mean over maps",
        "Ø",
        "Arithmetic mean",
        "Overall average",
        "Average†",
        "Average*",
    ] {
        assert_eq!(found(&rows(word, "47.7 | 150.3")), [], "{word}");
        assert_eq!(found(&rows(word, "49.2 | 150.3")), [("summary", Class::Signal)], "{word}");
        assert_eq!(found(&rows(word, "47.7 | 451")), [("summary", Class::Signal)], "{word}");
        assert_eq!(found(&rows(word, "72.0 | 150")), [("summary", Class::Signal)], "{word} above every row");
    }
    for word in ["Average (w/o C)", "Mean (geometric)", "Average over solved maps", "Mean of the other maps"]
    {
        assert_eq!(found(&rows(word, "41.6 | 125")), [], "{word} is right of A and B, or another mean");
    }
    for word in ["Total", "Sum", "TOTAL", "Subtotal"] {
        assert_eq!(found(&rows(word, "- | 451")), [], "{word}");
        assert_eq!(found(&rows(word, "- | 415")), [("summary", Class::Signal)], "{word}");
    }
    let means = |last: &str| table("method | time [ms]", &["a | 2.0", "b | 8.0", "c | 4.0", last]);
    assert_eq!(found(&means("Sum | 14.0")), []);
    assert_eq!(
        found(&means("Sum | 7.7")),
        [("summary", Class::Signal)],
        "between the least and the greatest"
    );
    assert_eq!(found(&means("Total | 7.7")), [], "perhaps the mean of all");
    let totals = |text: &str| output::totals("t", &read(text, Format::Markdown).unwrap());
    let named = "t:6:2: time of Total: 4.7 is the mean of the others, not their sum; it is taken as one";
    assert_eq!(totals(&means("Total | 4.7")), [named]);
    for plain in ["Total | 14.0", "Sum | 14.0", "Average | 4.7", "Total | -"] {
        assert_eq!(totals(&means(plain)), [""; 0], "{plain}");
    }
    assert_eq!(totals(&rows("Total", "47.7 | 451")), [""; 0], "shares have no sum");
    for right in ["47.7 | 451", "47.7 | 150.3"] {
        assert_eq!(found(&rows("Overall", right)), [], "{right}");
    }
    assert_eq!(found(&rows("Overall", "72.0 | 500")), [("summary", Class::Signal); 2]);
}

#[test]
fn a_summary_of_counts_of_trials_or_of_a_method_called_mean_is_read_as_it_is_meant() {
    let rows = |word: &str, value: &str| {
        table(
            "planner | success [% of 250] | nodes [value]",
            &["A | 33.2 | 100", "B | 50.0 | 150", "C | 60.0 | 201", &format!("{word} | {value}")],
        )
    };
    let solved = |last: &str| table("map | solved", &["a | 10/20", "b | 15/20", last]);
    assert_eq!(found(&solved("Total | 25/40")), []);
    assert_eq!(found(&solved("Total | 26/40")), [("summary", Class::Signal)], "counts are not rounded");
    let counted = |n: &str, last: &str| {
        table(
            &format!("planner | {n} | time [mean, unit=ms]"),
            &["A | 10 | 1.0", "B | 90 | 2.0", &format!("Average | 100 | {last}")],
        )
    };
    for n in ["n", "# trials", "Runs"] {
        assert_eq!(found(&counted(n, "1.9")), [], "{n}: 100 is the sum, 1.9 the mean by trials");
        assert_eq!(found(&counted(n, "1.0")), [("summary", Class::Signal)], "{n}");
    }
    assert_eq!(found(&rows("Mean shift", "49.6 | 999")), [], "a method of its own");
    let related = "[[table]]\nname = \"t\"\ntext = \"\"\"\n| p | x [% of 250] |\n|-|-|\n| A | 33.2 |\n| B | 33.6 |\n| Mean | 33.4 |\n\"\"\"\n\
        [[relation]]\ncheck = \"grim\"\nvalue = \"t/Mean/x\"\nn = 250\nwhole = 100\n";
    let related = audited(related, Format::Toml, &Options::default());
    assert_eq!(related.findings.len(), 1, "what a relation asks is answered, of a summary as well");
    let average = report(&rows("Average", "49.2 | 150.3"))
        .findings
        .into_iter()
        .find(|found| found.class == Class::Signal)
        .unwrap();
    assert!(
        average.name == "success of Average"
            && average
                .text
                .starts_with("49.2 does not sum up the others: the mean of 3 is 47.6333 to 47.8333"),
        "{average:?}"
    );
}

#[test]
fn an_average_may_be_of_its_block_of_its_planner_or_weighted_by_trials() {
    let blocks = |second: &str, all: &str| {
        table(
            "map | time [value]",
            &[
                "a | 1.0",
                "b | 2.0",
                "Average | 1.5",
                "c | 5.0",
                "d | 6.0",
                &format!("Average | {second}"),
                &format!("Overall | {all}"),
            ],
        )
    };
    for second in ["5.5", "3.5"] {
        assert_eq!(found(&blocks(second, "3.5")), [], "{second}");
    }
    assert_eq!(found(&blocks("4.5", "3.5")), [("summary", Class::Signal)]);
    let planners = |last: &str| {
        table(
            "map | planner | time [value]",
            &[
                "a | A | 1.0",
                "a | B | 3.0",
                "b | A | 2.0",
                "b | B | 5.0",
                "Average | A | 1.5",
                &format!("Average | B | {last}"),
            ],
        )
    };
    assert_eq!(found(&planners("4.0")), []);
    assert_eq!(found(&planners("2.8")), [("summary", Class::Signal)]);
    let pooled = |rate: &str| {
        table(
            "map | runs [value] | success [% of runs]",
            &["a | 10 | 50.0", "b | 30 | 90.0", &format!("Average | 40 | {rate}")],
        )
    };
    for rate in ["70.0", "80.0"] {
        assert_eq!(found(&pooled(rate)), [], "{rate}");
    }
    assert_eq!(found(&pooled("75.0")), [("summary", Class::Signal)]);
    let spread = |last: &str| {
        table(
            "map | time [value]",
            &["a | 1.0", "b | 4.0", "c | 2.5", "Std. | 2.1", "Median | 2.5", &format!("Mean | {last}")],
        )
    };
    assert_eq!(found(&spread("2.5")), []);
    assert_eq!(found(&spread("2.9")), [("summary", Class::Signal)], "a deviation is no row to sum up");
    let first =
        |first: &str| table("map | time [value]", &[&format!("Average | {first}"), "a | 1.0", "b | 4.0"]);
    assert_eq!(found(&first("2.5")), []);
    assert_eq!(found(&first("3.5")), [("summary", Class::Signal)]);
    let gaps = table("map | time [value]", &["a | 1.0", "b | -", "c | 2.0", "Average | 40.0"]);
    assert_eq!(found(&gaps), [("summary", Class::Unchecked)], "a failure may count as anything");
    let line = |text: &str| report(text).findings.into_iter().find(|found| found.check == "summary").unwrap();
    let unread = line(&gaps);
    assert_eq!((unread.place.line, &*unread.text), (6, "not decided: line 4 has no number here"));
    let beside =
        table("planner | a (ms) | b (ms) | Average (ms)", &["A | 10.0 | | 40.0", "B | 1.0 | 3.0 | 2.0"]);
    assert_eq!(line(&beside).text, "not decided: column `b (ms)` has no number here");
    let below = |last: &str| table("map | time [value]", &["a | 1.0", "b | ", "c | 2.0", last]);
    assert_eq!(
        line(&below("Average | 40.0")).text,
        "not decided: line 4 has no number here, or begins a block"
    );
    assert_eq!(found(&below("Average | 1.5")), []);
    let heads =
        ["Easy | ", "a | 1.0", "b | 2.0", "Average | 1.5", "Hard | ", "c | 5.0", "d | 6.0", "Average | 4.0"];
    assert_eq!(found(&table("map | time [value]", &heads)), [("summary", Class::Signal)], "a head is no gap");
    let one = table("map | time [value]", &["a | -", "b | 2.0", "Average | 40.0"]);
    assert_eq!(line(&one).text, "not decided: line 3 has no number here");
    let speeds = table("map | speed-up [value]", &["a | 1.0", "b | 4.0", "Average | 2.0"]);
    assert_eq!(found(&speeds), [], "the geometric mean");
}

#[test]
fn an_average_that_is_the_geometric_or_the_harmonic_mean_is_no_signal() {
    let rows = |name: &str, last: &str| {
        let last = format!("{name} | {last}");
        table("map | time (ms) [value]", &["a | 1.0", "b | 10.0", "c | 40.0", &last])
    };
    for name in ["Average", "Mean", "Overall"] {
        for right in ["17.0", "7.4", "2.7"] {
            assert_eq!(found(&rows(name, right)), [], "{name} {right}");
        }
    }
    for wrong in ["6.5", "8.2", "2.0", "3.5", "16.0"] {
        assert_eq!(found(&rows("Average", wrong)), [("summary", Class::Signal)], "{wrong}");
    }
    assert_eq!(found(&rows("Total", "7.4")), [("summary", Class::Signal)], "a sum has one meaning");
    let columns = |last: &str| {
        table("planner | a (ms) | b (ms) | Average (ms)", &[&format!("A | 10.0 | 40.0 | {last}")])
    };
    for right in ["25.0", "20.0", "16.0"] {
        assert_eq!(found(&columns(right)), [], "{right}");
    }
    assert_eq!(found(&columns("22.0")), [("summary", Class::Signal)]);
    for (first, last) in [("0.0", "17.0"), ("-1.0", "7.4")] {
        let below =
            table("map | x [value]", &[&format!("a | {first}"), "b | 40.0", &format!("Average | {last}")]);
        assert_eq!(found(&below), [("summary", Class::Signal)], "{first} has no such mean");
    }
    let long: Vec<String> = (1..=900).map(|row| format!("r{row} | {row}.00")).collect();
    let long = |last: &str| {
        let rows: Vec<&str> = long.iter().map(String::as_str).chain([last]).collect();
        found(&table("map | x [value]", &rows))
    };
    // The geometric mean of 1 to 900 is e^(ln 900! / 900) = 332.68.
    assert_eq!(long("Average | 332.7"), []);
    assert_eq!(long("Average | 333.0"), [("summary", Class::Signal)]);
}

#[test]
fn a_summary_of_nothing_that_is_printed_is_not_checked() {
    let columns = table(
        "p | a (s) [value] | b (s) [value] | Total (s) [value]",
        &["A | - | - | 4.0", "B | 1.0 | 2.0 | 3.0"],
    );
    assert_eq!(found(&columns), [("summary", Class::Unchecked)]);
    let rows = table("p | t [value]", &["a | -", "b | -", "Average | 4.0"]);
    assert_eq!(found(&rows), [("summary", Class::Unchecked)]);
}

#[test]
fn a_column_called_average_or_total_is_held_against_those_before_it() {
    let columns = |word: &str, value: &str| {
        table(
            &format!("planner | nodes | map 1 [% of 30] | map 2 [% of 30] | {word} [% of 30]"),
            &[&format!("A | 7 | 50.0 | 93.3 | {value}")],
        )
    };
    assert_eq!(found(&columns("Average", "71.7")), []);
    assert_eq!(found(&columns("Average", "70.0")), [("summary", Class::Signal)]);
    let times = |total: &str| {
        table("planner | plan (s) | smooth (s) | Total (s)", &[&format!("A | 1.2 | 0.5 | {total}")])
    };
    assert_eq!(found(&times("1.7")), []);
    assert_eq!(found(&times("1.1")), [("summary", Class::Signal)]);
    let statistics = "planner,min,max,mean\nA,1.0,4.0,3.5\n";
    assert_eq!(found(statistics), [], "a mean of what is not printed");
}

#[test]
fn a_table_of_long_lattice_paths_ends_within_its_budget() {
    let rows: Vec<String> = (0..15).map(|row| format!("r{row} | 29{row:02}.1234567")).collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let far = report(&table("p | length [a+b√2, from=0:0, to=99999:99999]", &rows));
    assert_eq!((far.tally["lattice"].impossible, far.cut_short), (15, 0), "intervals alone decide");
    let open = report(&table("p | length [a+b√2, from=0:0, to=1:0]", &rows));
    assert_eq!(open.tally["lattice"].applied, 15);
    assert!(open.cut_short > 0, "{open:?}");
    let lines = output::unseen("t", &open);
    assert!(lines.iter().any(|line| line.starts_with("t: the budget is used up: ")), "{lines:?}");
}

#[test]
fn decisions_stay_open_when_the_cases_of_a_table_are_used_up() {
    let row = |text: String, row: u32| text + &format!("r{row},29{:02}.1234567\n", row % 100);
    let rows = (0..7000).fold(String::new(), row);
    let options = Options { skips_power: true, skips_certificates: true, ..Options::default() };
    let report = audited(&format!("p,length [a+b√2]\n{rows}"), Format::Csv, &options);
    let [first, .., last] = report.findings.as_slice() else { panic!("{:?}", report.tally) };
    assert_eq!((first.class, last.class), (Class::Impossible, Class::Unchecked));
    assert_eq!(
        last.text,
        "not decided: the table's budget of 100000000 cases is used up; audit its rows in several files"
    );
}
